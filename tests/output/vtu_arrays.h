#ifndef samara_tests_output_vtu_arrays_h
#define samara_tests_output_vtu_arrays_h

#include <deal.II/base/utilities.h>

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

/** The value of an XML attribute in the first tag that begins with @p tag. */
inline std::string
attribute(const std::string &text, const std::string &tag, const std::string &name)
{
  const std::size_t begin = text.find(tag);
  if (begin == std::string::npos)
    return "no " + tag;
  const std::size_t value = text.find(name + "=\"", begin) + name.size() + 2;
  return text.substr(value, text.find('"', value) - value);
}



/** The numbers of a data array of one block. */
template <typename Number>
std::vector<Number>
numbers_of(const std::string &text, const std::string &array)
{
  const std::size_t at    = text.find("Name=\"" + array + "\"");
  const std::size_t begin = text.find_first_not_of(" \n", text.find('>', at) + 1);
  const std::string data  = text.substr(begin, text.find_first_of(" \n<", begin) - begin);

  // The header of one block has 4 numbers, 16 bytes, 24 letters of base64.
  const auto    header_bytes = dealii::Utilities::decode_base64(data.substr(0, 24));
  std::uint32_t header[4];
  std::memcpy(header, header_bytes.data(), sizeof(header));
  EXPECT_EQ(header[0], 1u) << array;

  const auto          bytes  = dealii::Utilities::decode_base64(data.substr(24));
  uLongf              length = header[1];
  std::vector<Number> numbers(length / sizeof(Number));
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef *>(numbers.data()), &length, bytes.data(), header[3]), Z_OK) << array;
  return numbers;
}

#endif
