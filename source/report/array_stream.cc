#include <samara/report/array_stream.h>

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

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
      for (std::size_t i = 0; i < n; ++i)
        bytes[offset + b * n + i] = static_cast<char>(from[i * size + b]);
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
  ArrayStream::add_packed(const std::vector<float> &values, const std::size_t n_rows, const std::size_t n_columns)
  {
    constexpr float           largest = 65535;
    std::vector<float>        low(n_columns, 0.F), step(n_columns, 0.F);
    std::vector<std::int16_t> q(values.size());
    for (std::size_t c = 0; c < n_columns; ++c)
      {
        float high = n_rows > 0 ? values[c] : 0.F;
        low[c]     = high;
        for (std::size_t r = 0; r < n_rows; ++r)
          {
            low[c] = std::min(low[c], values[r * n_columns + c]);
            high   = std::max(high, values[r * n_columns + c]);
          }
        step[c] = (high - low[c]) / largest;
        for (std::size_t r = 0; r < n_rows && step[c] > 0; ++r)
          q[r * n_columns + c] = static_cast<std::int16_t>(
            std::min(65535L, std::lround((values[r * n_columns + c] - low[c]) / step[c])) - 32768);
        if (!(step[c] > 0)) // all are equal
          for (std::size_t r = 0; r < n_rows; ++r)
            q[r * n_columns + c] = -32768;
      }
    return "{\"q\":" + add(q, {n_rows, n_columns}) + ",\"low\":" + add(low, {n_columns}) +
           ",\"step\":" + add(step, {n_columns}) + "}";
  }



  std::string
  ArrayStream::deflated() const
  {
    // the best levels make it 2 % smaller and take longer by a half
    constexpr int level = 2;
    uLongf        n     = compressBound(bytes.size());
    std::string   result(n, '\0');
    if (compress2(reinterpret_cast<Bytef *>(result.data()),
                  &n,
                  reinterpret_cast<const Bytef *>(bytes.data()),
                  bytes.size(),
                  level) != Z_OK)
      throw std::runtime_error("There is no memory to compress the page of results.");
    result.resize(n);
    return result;
  }
} // namespace samara
