#include <samara/report/array_stream.h>

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <type_traits>

namespace samara
{
  std::string
  json_text(const std::string &text)
  {
    std::string result = "\"";
    for (const unsigned char c : text)
      if (c == '"' || c == '\\')
        {
          result += '\\';
          result += c;
        }
      else if (c < 0x20 || c == '<')
        {
          char escape[8];
          std::snprintf(escape, sizeof escape, "\\u%04x", c);
          result += escape;
        }
      else
        result += c;
    return result + '"';
  }



  std::string
  json_number(const double number)
  {
    if (!std::isfinite(number))
      return "null";
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", number);
    for (char &c : text)
      if (c == ',') // of some locales
        c = '.';
    return text;
  }



  template <typename Number>
  std::string
  ArrayStream::append(const char *kind, const std::vector<Number> &values, const std::vector<std::size_t> &shape)
  {
    const std::size_t          size = sizeof(Number), n = values.size(), offset = bytes.size();
    const unsigned char *const from = reinterpret_cast<const unsigned char *>(values.data());
    bytes.resize(offset + n * size);
    for (std::size_t b = 0; b < size; ++b)
      {
        for (std::size_t i = 0; i < n; ++i)
          bytes[offset + b * n + i] = static_cast<char>(from[i * size + b]);
        // columns of places have others like them, which the search for repeated bytes finds; histories have not
        pieces.push_back({offset + (b + 1) * n, std::is_same_v<Number, double>});
      }
    std::string json = std::string("{\"k\":\"") + kind + "\",\"s\":[";
    for (std::size_t d = 0; d < shape.size(); ++d)
      json += (d > 0 ? "," : "") + std::to_string(shape[d]);
    return json + "],\"o\":" + std::to_string(offset) + "}";
  }



  std::string
  ArrayStream::add(const std::vector<float> &values, const std::vector<std::size_t> &shape)
  {
    return append("f4", values, shape);
  }



  std::string
  ArrayStream::add(const std::vector<double> &values, const std::vector<std::size_t> &shape)
  {
    return append("f8", values, shape);
  }



  std::string
  ArrayStream::add(const std::vector<std::int16_t> &values, const std::vector<std::size_t> &shape)
  {
    return append("i2", values, shape);
  }



  std::string
  ArrayStream::add(const std::vector<std::uint32_t> &values, const std::vector<std::size_t> &shape)
  {
    return append("u4", values, shape);
  }



  std::string
  ArrayStream::add(const std::vector<std::uint8_t> &values, const std::vector<std::size_t> &shape)
  {
    return append("u1", values, shape);
  }



  std::string
  ArrayStream::add_packed(const std::vector<float> &values,
                          const std::size_t         n_rows,
                          const std::size_t         n_columns,
                          const std::vector<float> &largest_steps)
  {
    constexpr double           most = 65535, finer = 256;
    std::vector<float>         low(n_columns, 0.F), step(n_columns, 0.F);
    std::vector<std::int16_t>  q(values.size());
    std::vector<std::uint8_t>  fine;
    std::vector<std::uint32_t> of;
    for (std::size_t c = 0; c < n_columns && n_rows > 0; ++c)
      {
        float high = values[c];
        low[c]     = high;
        for (std::size_t r = 0; r < n_rows; ++r)
          {
            low[c] = std::min(low[c], values[r * n_columns + c]);
            high   = std::max(high, values[r * n_columns + c]);
          }
        step[c] = static_cast<float>((double(high) - low[c]) / most);
        // a range below the smallest normal number is none
        if (!(step[c] >= std::numeric_limits<float>::min()))
          step[c] = 0;
        const bool is_fine = c < largest_steps.size() && step[c] > largest_steps[c];
        if (is_fine)
          of.push_back(static_cast<std::uint32_t>(c));
        for (std::size_t r = 0; r < n_rows; ++r)
          {
            // in steps, with a part of one where that is kept
            const double steps = step[c] > 0 ? (double(values[r * n_columns + c]) - low[c]) / step[c] : 0.,
                         whole = std::min(most, is_fine ? std::floor(steps) : std::round(steps));
            q[c * n_rows + r]  = static_cast<std::int16_t>(std::lround(whole) - 32768);
            if (is_fine)
              fine.push_back(static_cast<std::uint8_t>(std::min(finer - 1, std::round(finer * (steps - whole)))));
          }
      }
    return "{\"q\":" + add(q, {n_columns, n_rows}) + ",\"low\":" + add(low, {n_columns}) +
           ",\"step\":" + add(step, {n_columns}) +
           (of.empty() ? std::string() :
                         ",\"fine\":" + add(fine, {of.size(), n_rows}) + ",\"of\":" + add(of, {of.size()})) +
           "}";
  }



  namespace
  {
    /**
     * Whether bytes look like noise, which no compressor makes smaller but takes long over: the low bytes of histories.
     * All values, and all differences of neighbours, come about as often as each other in a piece from the middle.
     */
    bool
    is_noise(const char *const from, const std::size_t n)
    {
      constexpr std::size_t n_tried = 4096;
      constexpr double      most    = 7.8; // bits of information in a byte; of noise as long, 7.95
      if (n < n_tried)
        return false;
      const unsigned char *const      tried = reinterpret_cast<const unsigned char *>(from) + (n - n_tried) / 2;
      std::array<unsigned short, 256> values{}, differences{};
      for (std::size_t i = 0; i < n_tried; ++i)
        {
          ++values[tried[i]];
          ++differences[(tried[i] - tried[i == 0 ? 0 : i - 1]) & 255];
        }
      const auto bits = [](const std::array<unsigned short, 256> &counts) {
        double sum = 0;
        for (const unsigned short count : counts)
          if (count > 0)
            sum -= count * std::log2(double(count) / n_tried);
        return sum / n_tried;
      };
      return bits(values) > most && bits(differences) > most;
    }
  } // namespace



  std::string
  ArrayStream::deflated() const
  {
    // higher levels make it 1 % smaller and take longer by a half
    constexpr int         level = 1, as_it_is = 0;
    constexpr std::size_t of_a_change = 32; // of the level: the block before ends, and an empty one begins
    z_stream              stream{};
    if (deflateInit(&stream, level) != Z_OK)
      throw std::runtime_error("There is no memory to compress the page of results.");
    std::string result(compressBound(bytes.size()) + of_a_change * (pieces.size() + 1), '\0');
    stream.next_out   = reinterpret_cast<Bytef *>(result.data());
    stream.avail_out  = static_cast<uInt>(result.size());
    std::size_t begin = 0;
    bool        works = result.size() <= std::numeric_limits<uInt>::max();
    for (const auto &[end, may_be_noise] : pieces)
      {
        works           = works && deflateParams(&stream,
                                       may_be_noise && is_noise(bytes.data() + begin, end - begin) ? as_it_is : level,
                                       Z_DEFAULT_STRATEGY) == Z_OK;
        stream.next_in  = reinterpret_cast<Bytef *>(const_cast<char *>(bytes.data() + begin));
        stream.avail_in = static_cast<uInt>(end - begin);
        works           = works && (end == begin || (deflate(&stream, Z_NO_FLUSH) == Z_OK && stream.avail_in == 0));
        begin           = end;
      }
    works = works && deflate(&stream, Z_FINISH) == Z_STREAM_END;
    result.resize(stream.total_out);
    deflateEnd(&stream);
    if (!works)
      throw std::runtime_error("The page of results cannot be compressed.");
    return result;
  }
} // namespace samara
