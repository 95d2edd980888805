// Numbers of records, written in a quick way. The reference is std::to_chars in its general form with 15 digits: the
// same characters, wherever the quick way answers at all, which it nearly always does.

#include <samara/output/fifteen_digits.h>

#include <gtest/gtest.h>

#include <cfloat>
#include <charconv>
#include <cmath>
#include <random>
#include <string>

using namespace samara;

namespace
{
  std::string
  expected(const double x)
  {
    char buffer[64];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::general, 15).ptr};
  }

  /** Whether the quick way has an answer; it is the right one. */
  bool
  is_answered(const double x)
  {
    char        buffer[64];
    char *const end = write_fifteen_digits(x, buffer);
    if (end == nullptr)
      return false;
    EXPECT_EQ(std::string(buffer, end), expected(x));
    return true;
  }
} // namespace



TEST(FifteenDigits, AsTheLibraryWritesThem)
{
  std::mt19937_64                        random(7);
  std::uniform_real_distribution<double> part(-1, 1), power(-37, 39);
  unsigned int                           n_answered = 0;
  constexpr unsigned int                 n          = 30000;
  for (unsigned int i = 0; i < n; ++i)
    n_answered += is_answered(part(random) * std::pow(10., power(random)));
  if (LDBL_MANT_DIG >= 64)
    EXPECT_GT(n_answered, 0.95 * n);
}



// Whole and short numbers, powers of ten and of two and their neighbours, those that end with five behind the fifteenth
// digit, float numbers, and what the quick way leaves to the library.
TEST(FifteenDigits, AtTheEdges)
{
  for (int k = -45; k <= 45; ++k)
    for (const double factor : {1., 9.99999999999999, 9.999999999999995, 1.000000000000005, 2.5, 1.234567890123455})
      {
        const double x = factor * std::pow(10., k);
        for (const double y : {x, -x, std::nextafter(x, 0.), std::nextafter(x, HUGE_VAL), double(float(x))})
          is_answered(y);
      }
  for (int k = -140; k <= 140; ++k)
    is_answered(std::ldexp(1., k));
  for (int i = -3000; i < 3000; ++i)
    for (const double unit : {1., 0.1, 0.001, 1e-7, 1e9})
      is_answered(i * unit);
  for (const double x : {0., -0., double(INFINITY), double(NAN), 5e-324, 1e300})
    EXPECT_FALSE(is_answered(x));
}
