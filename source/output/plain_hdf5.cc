#include <samara/output/plain_hdf5.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace samara
{
  namespace
  {
    static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "numbers are copied into files as they are");

    constexpr std::uint64_t undefined = ~std::uint64_t(0);

    /** Types of the messages of object headers. */
    enum class Message : unsigned char
    {
      dataspace   = 1,
      link_info   = 2,
      datatype    = 3,
      fill_value  = 5,
      link        = 6,
      data_layout = 8,
      group_info  = 10,
      attribute   = 12
    };

    /** The @p n lowest bytes of a number, the lowest first. */
    std::string
    bytes(const std::uint64_t number, const unsigned int n)
    {
      std::string result(n, '\0');
      for (unsigned int i = 0; i < n; ++i)
        result[i] = static_cast<char>(number >> (8 * i));
      return result;
    }



    /** Bytes given one by one. */
    std::string
    raw(const std::initializer_list<unsigned char> values)
    {
      return std::string(values.begin(), values.end());
    }

    // ---------------------------------------------------------------------------------------------------- checksum

    void
    mix(std::array<std::uint32_t, 3> &x)
    {
      constexpr unsigned int turns[] = {4, 6, 8, 16, 19, 4};
      for (unsigned int i = 0; i < 6; ++i)
        {
          std::uint32_t &a = x[i % 3], &b = x[(i + 1) % 3], &c = x[(i + 2) % 3];
          a -= c;
          a ^= c << turns[i] | c >> (32 - turns[i]);
          c += b;
        }
    }



    void
    mix_last(std::array<std::uint32_t, 3> &x)
    {
      constexpr unsigned int turns[] = {14, 11, 25, 16, 4, 14, 24};
      for (unsigned int i = 0; i < 7; ++i)
        {
          std::uint32_t &to = x[(i + 2) % 3], from = x[(i + 1) % 3];
          to ^= from;
          to -= from << turns[i] | from >> (32 - turns[i]);
        }
    }



    /** Bob Jenkins' lookup3 (hashlittle), which the format asks for. */
    std::string
    lookup3(const std::string &text)
    {
      std::array<std::uint32_t, 3> x;
      x.fill(0xdeadbeef + static_cast<std::uint32_t>(text.size()));
      for (std::size_t begin = 0; begin < text.size(); begin += 12)
        {
          const std::size_t n = std::min<std::size_t>(12, text.size() - begin);
          for (std::size_t i = 0; i < n; ++i)
            x[i / 4] += static_cast<std::uint32_t>(static_cast<unsigned char>(text[begin + i])) << (8 * (i % 4));
          if (begin + 12 < text.size())
            mix(x);
          else
            mix_last(x);
        }
      return bytes(x[2], 4);
    }

    // ----------------------------------------------------------------------------------------------------- messages

    std::string
    message(const Message type, const std::string &content)
    {
      if (content.size() > 0xffff)
        throw std::runtime_error("a name or text in it is longer than 64 kB");
      return raw({static_cast<unsigned char>(type)}) + bytes(content.size(), 2) + raw({0}) + content;
    }



    std::string
    object_header(const std::string &messages)
    {
      // version 2; the size of the messages has four bytes, nothing tells of times
      const std::string header = "OHDR" + raw({2, 2}) + bytes(messages.size(), 4) + messages;
      return header + lookup3(header);
    }



    std::string
    datatype_of(const PlainHdf5::Kind kind)
    {
      if (kind == PlainHdf5::Kind::character)
        // version 1, fixed point, signed, one byte; first bit and bits
        return raw({0x10, 0x08, 0, 0}) + bytes(1, 4) + bytes(0, 2) + bytes(8, 2);
      // version 1, floating point, first bit of the mantissa implied, sign in bit 63, eight bytes; first bit and bits,
      // place and size of exponent and mantissa, bias
      return raw({0x11, 0x20, 63, 0}) + bytes(8, 4) + bytes(0, 2) + bytes(64, 2) + raw({52, 11, 0, 52}) +
             bytes(1023, 4);
    }



    std::string
    attribute_message(const std::string &name, const std::string &text)
    {
      const std::uint64_t length = text.size() + 1; // with the final zero: HDF5 knows no texts of length 0
      // version 1, string, ends with a zero, UTF-8; version 2, scalar
      const std::string type = raw({0x13, 0x10, 0, 0}) + bytes(length, 4), space = raw({2, 0, 0, 0});
      return message(Message::attribute,
                     raw({3, 0}) + bytes(name.size() + 1, 2) + bytes(type.size(), 2) + bytes(space.size(), 2) +
                       raw({0}) + name + raw({0}) + type + space + text + raw({0}));
    }



    std::string
    link_message(const std::string &name, const std::uint64_t header)
    {
      // version 1; the length of the name has two bytes, the set of characters is told: UTF-8
      return message(Message::link, raw({1, 0x11, 1}) + bytes(name.size(), 2) + name + bytes(header, 8));
    }



    /** The names in a path, as the library understands it. */
    std::vector<std::string>
    names_in(const std::string &path)
    {
      std::vector<std::string> names;
      for (std::size_t begin = 0; begin <= path.size();)
        {
          const std::size_t end  = std::min(path.find('/', begin), path.size());
          const std::string name = path.substr(begin, end - begin);
          if (!name.empty() && name != ".")
            names.push_back(name);
          begin = end + 1;
        }
      return names;
    }
  } // namespace



  std::uint64_t
  PlainHdf5::Dataset::n_bytes() const
  {
    return size * (kind == Kind::real ? 8 : 1);
  }



  unsigned int
  PlainHdf5::add(const std::string  &path,
                 const Kind          kind,
                 const std::uint64_t size,
                 const std::string  &attribute,
                 const std::string  &text)
  {
    const std::vector<std::string> names = names_in(path);
    if (names.empty())
      throw std::runtime_error("<" + path + "> is no name of a dataset");
    unsigned int group = 0;
    for (unsigned int i = 0; i + 1 < names.size(); ++i)
      {
        if (groups[group].datasets.count(names[i]) > 0)
          throw std::runtime_error("<" + path + "> is in a dataset");
        const auto [member, is_new] = groups[group].groups.try_emplace(names[i], groups.size());
        group                       = member->second;
        if (is_new)
          groups.emplace_back();
      }
    if (groups[group].groups.count(names.back()) > 0 ||
        !groups[group].datasets.try_emplace(names.back(), datasets.size()).second)
      throw std::runtime_error("<" + path + "> is there twice");
    datasets.push_back({kind, size, attribute, text, 0, 0});
    return datasets.size() - 1;
  }



  std::string
  PlainHdf5::superblock(const std::uint64_t size) const
  {
    const std::string block = raw({0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n', 2, 8, 8, 0}) + bytes(0, 8) +
                              bytes(undefined, 8) + bytes(size, 8) + bytes(groups[0].header, 8);
    return block + lookup3(block);
  }



  std::string
  PlainHdf5::header_of(const Group &group) const
  {
    // links are in the header itself: there is neither a heap nor a tree of names
    std::string messages = message(Message::link_info, raw({0, 0}) + bytes(undefined, 8) + bytes(undefined, 8)) +
                           message(Message::group_info, raw({0, 0}));
    for (const auto &[name, index] : group.groups)
      messages += link_message(name, groups[index].header);
    for (const auto &[name, index] : group.datasets)
      messages += link_message(name, datasets[index].header);
    return object_header(messages);
  }



  std::string
  PlainHdf5::header_of(const Dataset &dataset) const
  {
    // one dimension; space is there late, filled with nothing; contiguous
    std::string messages =
      message(Message::dataspace, raw({2, 1, 0, 1}) + bytes(dataset.size, 8)) +
      message(Message::datatype, datatype_of(dataset.kind)) + message(Message::fill_value, raw({3, 0x0a})) +
      message(Message::data_layout,
              raw({3, 1}) + bytes(dataset.size > 0 ? dataset.place : undefined, 8) + bytes(dataset.n_bytes(), 8));
    if (!dataset.attribute.empty())
      messages += attribute_message(dataset.attribute, dataset.text);
    return object_header(messages);
  }



  std::string
  PlainHdf5::head()
  {
    // the length of a header does not depend on the places in it
    std::uint64_t end = superblock(0).size();
    for (Group &group : groups)
      {
        group.header = end;
        end += header_of(group).size();
      }
    for (Dataset &dataset : datasets)
      {
        dataset.header = end;
        end += header_of(dataset).size();
      }
    const std::uint64_t first = (end + 7) / 8 * 8;
    std::uint64_t       size  = first;
    for (Dataset &dataset : datasets)
      {
        dataset.place = size;
        size += (dataset.n_bytes() + 7) / 8 * 8;
      }
    std::string result = superblock(size);
    for (const Group &group : groups)
      result += header_of(group);
    for (const Dataset &dataset : datasets)
      result += header_of(dataset);
    result.resize(first, '\0');
    return result;
  }



  std::string
  PlainHdf5::image(const std::vector<std::string> &contents)
  {
    std::string result = head();
    for (unsigned int i = 0; i < datasets.size(); ++i)
      {
        result += contents[i];
        result.resize((result.size() + 7) / 8 * 8, '\0');
      }
    return result;
  }
} // namespace samara
