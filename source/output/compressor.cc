#include <samara/output/compressor.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

namespace samara
{
  namespace
  {
    /** Runs are written as such if they are that long in the mean; values have that many bytes at most. */
    constexpr std::size_t least_run = 4, most_bytes = 64, runs_tried = 64;

    /** What is tried of an array, and the part it must shrink to so that the library compresses all of it. */
    constexpr std::size_t bytes_tried = 4096;
    constexpr double      worthwhile  = 0.6;
    constexpr std::size_t least_copy = 3, most_per_copy = 258, most_stored = 65535;

    /** The header of a stream of zlib: deflate, a window of 32 kB, the fastest of four levels. */
    constexpr std::array<unsigned char, 2> begin_of_stream = {{0x78, 0x01}};



    /** Bits of deflate from the lowest on, and the fixed Huffman codes, whose highest bits come first. */
    class Bits
    {
    public:
      explicit Bits(std::vector<unsigned char> &bytes)
        : bytes(bytes)
        , n_bytes(bytes.size())
      {}

      /** The only one, with fixed codes. */
      void
      begin_block()
      {
        make_room(8);
        add(1 | 1 << 1, 3);
      }

      /** At most 32 of them; there is room for them. */
      void
      add(const std::uint32_t value, const unsigned int n)
      {
        waiting |= std::uint64_t(value) << n_waiting;
        n_waiting += n;
        if (n_waiting < 32)
          return;
        for (unsigned int i = 0; i < 4; ++i)
          bytes[n_bytes + i] = waiting >> 8 * i & 255;
        n_bytes += 4;
        waiting >>= 32;
        n_waiting -= 32;
      }

      /** One of @p size bytes, that many times. */
      void
      add_value(const unsigned char *const value, const std::size_t size, const std::size_t times)
      {
        // nine bits a literal at most, and 31 a copy
        make_room(2 * size + 4 * (times * size / most_per_copy + 2) + 4 * least_copy);
        for (std::size_t j = 0; j < size; ++j)
          add_literal(value[j]);
        for (std::size_t done = size; done < times * size;)
          {
            const std::size_t n = std::min(times * size - done, most_per_copy);
            if (n >= least_copy)
              add_copy(n, size);
            else
              for (std::size_t j = 0; j < n; ++j)
                add_literal(value[(done + j) % size]);
            done += n;
          }
      }

      /** Nothing can follow. */
      void
      end_block()
      {
        make_room(16);
        add(0, 7);
        for (; n_waiting > 0; n_waiting -= std::min(n_waiting, 8u), waiting >>= 8)
          bytes[n_bytes++] = waiting & 255;
        bytes.resize(n_bytes);
      }

    private:
      struct Code
      {
        std::uint32_t bits;
        unsigned int  n;
      };
      struct Split
      {
        unsigned int code, n_extra, extra;
      };

      std::vector<unsigned char> &bytes; ///< with room behind those that are written
      std::size_t                 n_bytes;
      std::uint64_t               waiting     = 0;
      unsigned int                n_waiting   = 0;
      unsigned int                last_length = 0, last_distance = 0; ///< of the last copy, and its code
      Code                        last_copy = {0, 0};

      void
      make_room(const std::size_t n)
      {
        if (bytes.size() < n_bytes + n)
          bytes.resize(2 * n_bytes + n);
      }

      void
      add_literal(const unsigned int byte)
      {
        static const std::array<Code, 256> codes = codes_of_literals();
        add(codes[byte].bits, codes[byte].n);
      }

      /** The bytes from @p distance ahead of here, at least 3 of them. */
      void
      add_copy(const unsigned int length, const unsigned int distance)
      {
        // outlines of a series mostly have one number of corners
        if (length != last_length || distance != last_distance)
          last_copy = code_of_copy(length, distance);
        last_length   = length;
        last_distance = distance;
        add(last_copy.bits, last_copy.n);
      }

      static Code
      code_of_copy(const unsigned int length, const unsigned int distance)
      {
        // lengths 3 … 10, then four codes for each number of extra bits; distances 1 … 4, then two
        const auto [code, extra, rest]       = split(length - 3, 4);
        const auto [of_place, extra_2, more] = split(distance - 1, 2);
        Code       result = length == most_per_copy ? code_of_symbol(285) : code_of_symbol(257 + code);
        const auto append = [&result](const std::uint32_t value, const unsigned int n) {
          result.bits |= value << result.n;
          result.n += n;
        };
        if (length != most_per_copy)
          append(rest, extra);
        append(reversed(of_place, 5), 5);
        append(more, extra_2);
        return result;
      }

      static std::uint32_t
      reversed(std::uint32_t value, const unsigned int n)
      {
        std::uint32_t result = 0;
        for (unsigned int i = 0; i < n; ++i, value >>= 1)
          result = result << 1 | (value & 1);
        return result;
      }

      static Code
      code_of_symbol(const unsigned int symbol)
      {
        const unsigned int n     = symbol < 144 ? 8 : symbol < 256 ? 9 : symbol < 280 ? 7 : 8;
        const unsigned int first = symbol < 144 ? 0x30 : symbol < 256 ? 0x190 - 144 : symbol < 280 ? -256u : 0xc0 - 280;
        return {reversed(first + symbol, n), n};
      }

      static std::array<Code, 256>
      codes_of_literals()
      {
        std::array<Code, 256> codes;
        for (unsigned int i = 0; i < 256; ++i)
          codes[i] = code_of_symbol(i);
        return codes;
      }

      /** Of @p value, where the first 2 @p group codes have no extra bits, and each further group one more. */
      static Split
      split(const unsigned int value, const unsigned int group)
      {
        if (value < 2 * group)
          return {value, 0, 0};
        unsigned int extra = 1;
        while (value >> extra >= 2 * group)
          ++extra;
        return {group * extra + (value >> extra), extra, value & ((1u << extra) - 1)};
      }
    };



    /** Adler's checksum of values that come several times. */
    class Checksum
    {
    public:
      void
      add(const unsigned char *const value, const std::uint64_t n, const std::uint64_t times)
      {
        // b grows by a after each byte
        std::uint64_t sum = 0, weighted = 0;
        for (unsigned int i = 0; i < n; ++i)
          {
            sum += value[i];
            weighted += (n - i) * value[i];
          }
        // products of so many stay below 2⁶⁴, so that one remainder will do
        constexpr std::uint64_t at_once = 65535;
        for (std::uint64_t left = times; left > 0;)
          {
            const std::uint64_t t = std::min(left, at_once);
            b                     = (b + n * t * a + t * weighted + t * (t - 1) / 2 * n * sum) % base;
            a                     = (a + t * sum) % base;
            left -= t;
          }
      }

      std::uint32_t
      value() const
      {
        return b << 16 | a;
      }

    private:
      static constexpr std::uint64_t base = 65521;
      std::uint64_t                  a = 1, b = 0;
    };



    /** How many times the first value comes in a row. */
    template <typename Word>
    std::size_t
    length_of_run(const unsigned char *const value, const unsigned char *const end, const std::size_t size)
    {
      const auto word = [](const unsigned char *const at) {
        Word result;
        std::memcpy(&result, at, sizeof(Word));
        return result;
      };
      const unsigned char *next = value + size;
      while (next < end && word(next) == word(next - size))
        next += sizeof(Word);
      return (next - value) / size;
    }



    void
    add_checksum(const std::uint32_t sum, std::vector<unsigned char> &bytes)
    {
      for (const unsigned int shift : {24, 16, 8, 0})
        bytes.push_back(sum >> shift & 255);
    }
  } // namespace



  Compressor::Compressor()
  {
    if (deflateInit(&stream, Z_BEST_SPEED) != Z_OK)
      throw std::runtime_error("no memory to compress pictures");
  }



  Compressor::~Compressor()
  {
    deflateEnd(&stream);
  }



  const std::vector<unsigned char> &
  Compressor::operator()(const void *const values, const std::size_t n_values, const std::size_t size)
  {
    Assert(size > 0, dealii::ExcMessage("Values have a size."));
    const auto *const bytes   = static_cast<const unsigned char *>(values);
    const std::size_t n_bytes = n_values * size;
    if (size <= most_bytes && n_values > 0 && write_runs(bytes, n_values, size))
      return compressed;
    if (n_bytes <= bytes_tried || shrinks(bytes, n_bytes))
      deflate_bytes(bytes, n_bytes);
    else
      store(bytes, n_bytes);
    return compressed;
  }



  void
  Compressor::deflate_bytes(const unsigned char *const bytes, const std::size_t n_bytes)
  {
    deflateReset(&stream);
    compressed.resize(deflateBound(&stream, n_bytes));
    stream.next_in   = const_cast<Bytef *>(bytes); // zlib only reads it
    stream.avail_in  = n_bytes;
    stream.next_out  = compressed.data();
    stream.avail_out = compressed.size();
    if (deflate(&stream, Z_FINISH) != Z_STREAM_END)
      throw std::runtime_error("no memory to compress a picture");
    compressed.resize(stream.total_out);
  }



  bool
  Compressor::shrinks(const unsigned char *const bytes, const std::size_t n_bytes)
  {
    // from the middle: the beginning may be a small object of another kind
    deflate_bytes(bytes + (n_bytes - bytes_tried) / 2, bytes_tried);
    return double(compressed.size()) < worthwhile * double(bytes_tried);
  }



  void
  Compressor::store(const unsigned char *const bytes, const std::size_t n_bytes)
  {
    compressed.assign(begin_of_stream.begin(), begin_of_stream.end());
    compressed.reserve(n_bytes + 5 * (n_bytes / most_stored + 1) + 6);
    for (std::size_t begin = 0; begin == 0 || begin < n_bytes;
         begin += most_stored) // there is a last block in any case
      {
        const std::size_t   n   = std::min(most_stored, n_bytes - begin);
        const unsigned char low = n & 255, high = n >> 8 & 255;
        const unsigned char of_block[] = {
          begin + n == n_bytes, low, high, static_cast<unsigned char>(~low), static_cast<unsigned char>(~high)};
        compressed.insert(compressed.end(), std::begin(of_block), std::end(of_block));
        compressed.insert(compressed.end(), bytes + begin, bytes + begin + n);
      }
    add_checksum(adler32_z(1, bytes, n_bytes), compressed);
  }



  bool
  Compressor::write_runs(const unsigned char *const bytes, const std::size_t n_values, const std::size_t size)
  {
    compressed.assign(begin_of_stream.begin(), begin_of_stream.end());
    Bits     bits(compressed);
    Checksum checksum;
    bits.begin_block();
    const unsigned char *const end    = bytes + n_values * size;
    std::size_t                n_runs = 0;
    for (const unsigned char *value = bytes; value < end;)
      {
        const std::size_t times = size % sizeof(std::uint32_t) == 0 ? length_of_run<std::uint32_t>(value, end, size) :
                                                                      length_of_run<char>(value, end, size);
        ++n_runs;
        bits.add_value(value, size, times);
        checksum.add(value, size, times);
        value += times * size;
        const std::size_t n_done = (value - bytes) / size;
        if (n_done < least_run * n_runs && (n_runs > runs_tried || value == end))
          return false;
      }
    bits.end_block();
    add_checksum(checksum.value(), compressed);
    return true;
  }



  const std::vector<unsigned char> &
  Compressor::repeated(const void *const values, const std::vector<unsigned int> &times, const std::size_t size)
  {
    Assert(size > 0 && size <= most_bytes, dealii::ExcMessage("Values have a size, which is small."));
    compressed.assign(begin_of_stream.begin(), begin_of_stream.end());
    Bits     bits(compressed);
    Checksum checksum;
    bits.begin_block();
    const auto *value = static_cast<const unsigned char *>(values);
    for (std::size_t i = 0; i < times.size();)
      {
        std::size_t n    = times[i];
        const auto *next = value + size;
        for (++i; i < times.size() && std::memcmp(next, value, size) == 0; next += size)
          n += times[i++];
        if (n > 0)
          {
            bits.add_value(value, size, n);
            checksum.add(value, size, n);
          }
        value = next;
      }
    bits.end_block();
    add_checksum(checksum.value(), compressed);
    return compressed;
  }



  const std::vector<unsigned char> &
  Compressor::as_they_are(const void *const values, const std::size_t n_bytes)
  {
    store(static_cast<const unsigned char *>(values), n_bytes);
    return compressed;
  }



  void
  add_base64(const unsigned char *const bytes, const std::size_t n, std::string &text)
  {
    // two letters, those of twelve bits, at a time
    static const std::array<std::array<char, 2>, 4096> pairs = [] {
      const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
      std::array<std::array<char, 2>, 4096> result;
      for (unsigned int i = 0; i < 4096; ++i)
        result[i] = {{letters[i >> 6], letters[i & 63]}};
      return result;
    }();
    const std::size_t begin = text.size();
    text.resize(begin + (n + 2) / 3 * 4);
    char             *to  = &text[begin];
    const std::size_t all = n - n % 3;
    for (std::size_t i = 0; i < all; i += 3, to += 4)
      {
        const std::uint32_t group = bytes[i] << 16 | bytes[i + 1] << 8 | bytes[i + 2];
        std::memcpy(to, pairs[group >> 12].data(), 2);
        std::memcpy(to + 2, pairs[group & 4095].data(), 2);
      }
    if (all == n)
      return;
    const std::uint32_t group = bytes[all] << 16 | (n - all > 1 ? bytes[all + 1] << 8 : 0);
    std::memcpy(to, pairs[group >> 12].data(), 2);
    std::memcpy(to + 2, pairs[group & 4095].data(), 2);
    if (n - all < 2)
      to[2] = '=';
    to[3] = '=';
  }
} // namespace samara
