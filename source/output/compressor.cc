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
      {}

      void
      add(const std::uint32_t value, const unsigned int n)
      {
        waiting |= std::uint64_t(value) << n_waiting;
        n_waiting += n;
        while (n_waiting >= 8)
          {
            bytes.push_back(waiting & 255);
            waiting >>= 8;
            n_waiting -= 8;
          }
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
        // lengths 3 … 10, then four codes for each number of extra bits; distances 1 … 4, then two
        const auto [code, extra, rest]       = split(length - 3, 4);
        const auto [of_place, extra_2, more] = split(distance - 1, 2);
        const Code length_code = length == most_per_copy ? code_of_symbol(285) : code_of_symbol(257 + code);
        add(length_code.bits, length_code.n);
        if (length != most_per_copy)
          add(rest, extra);
        add(reversed(of_place, 5), 5);
        add(more, extra_2);
      }

      /** One of @p size bytes, that many times. */
      void
      add_value(const unsigned char *const value, const std::size_t size, const std::size_t times)
      {
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

      void
      end_block()
      {
        add(0, 7);
        if (n_waiting > 0)
          add(0, 8 - n_waiting);
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

      std::vector<unsigned char> &bytes;
      std::uint64_t               waiting   = 0;
      unsigned int                n_waiting = 0;

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
      add(const unsigned char *value, const std::uint64_t n, const std::uint64_t times)
      {
        // b grows by a after each byte
        std::uint64_t sum = 0, weighted = 0;
        for (unsigned int i = 0; i < n; ++i)
          {
            sum += value[i];
            weighted += (n - i) * value[i];
          }
        const std::uint64_t t = times % base, pairs = (times % 2 == 0 ? times / 2 % base * ((times - 1) % base) :
                                                                        times % base * ((times - 1) / 2 % base)) %
                                                      base;
        b = (b + n * t % base * a + t * (weighted % base) + pairs * (n * sum % base)) % base;
        a = (a + t * (sum % base)) % base;
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
    for (std::size_t begin = 0; begin < n_bytes; begin += most_stored)
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
    bits.add(1 | 1 << 1, 3); // the last block, with fixed codes
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



  void
  add_base64(const unsigned char *const bytes, const std::size_t n, std::string &text)
  {
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t begin     = text.size();
    text.resize(begin + (n + 2) / 3 * 4);
    char *to = &text[begin];
    for (std::size_t i = 0; i < n; i += 3, to += 4)
      {
        const unsigned int in_group = n - i < 3 ? n - i : 3;
        std::uint32_t      group    = bytes[i] << 16;
        if (in_group > 1)
          group |= bytes[i + 1] << 8;
        if (in_group > 2)
          group |= bytes[i + 2];
        to[0] = letters[group >> 18];
        to[1] = letters[group >> 12 & 63];
        to[2] = in_group > 1 ? letters[group >> 6 & 63] : '=';
        to[3] = in_group > 2 ? letters[group & 63] : '=';
      }
  }
} // namespace samara
