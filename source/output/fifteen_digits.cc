#include <samara/output/fifteen_digits.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace samara
{
  namespace
  {
    constexpr int          n_digits        = 15;
    constexpr std::int64_t least_of_digits = 100000000000000; // 10^14

    /** A number is digits · 10^(exponent − 14), digits from 10^14 to less than 10^15. */
    struct Decimal
    {
      std::int64_t digits;
      int          exponent;
    };

    /** @p size · 10^k with 64 bits: those powers are exact, so that one or two roundings are all there is. */
    long double
    times_power_of_ten(const double size, const int k)
    {
      static const long double powers[] = {1e0L,  1e1L,  1e2L,  1e3L,  1e4L,  1e5L,  1e6L,  1e7L,  1e8L,  1e9L,
                                           1e10L, 1e11L, 1e12L, 1e13L, 1e14L, 1e15L, 1e16L, 1e17L, 1e18L, 1e19L,
                                           1e20L, 1e21L, 1e22L, 1e23L, 1e24L, 1e25L, 1e26L, 1e27L};
      constexpr int            largest  = 27;
      if (k < 0)
        return size / powers[-k];
      return k <= largest ? size * powers[k] : size * powers[largest] * powers[k - largest];
    }

    bool
    find_decimal(const double size, Decimal &decimal)
    {
      constexpr double smallest_size = 1e-38, largest_size = 1e40;
      if (LDBL_MANT_DIG < 64 || !(size > smallest_size && size < largest_size))
        return false;
      // the power of two from the bits; log10 2 = 1233/4096, rounded down
      std::uint64_t bits;
      std::memcpy(&bits, &size, sizeof bits);
      decimal.exponent   = (static_cast<int>(bits >> 52) - 1023) * 1233 >> 12;
      long double scaled = times_power_of_ten(size, n_digits - 1 - decimal.exponent);
      if (scaled >= 10 * static_cast<long double>(least_of_digits))
        scaled = times_power_of_ten(size, n_digits - 1 - ++decimal.exponent);
      decimal.digits = static_cast<std::int64_t>(scaled);
      // errors are 2⁻¹⁴ at most of each rounding
      constexpr double too_near = 1e-2;
      const auto       rest     = static_cast<double>(scaled - static_cast<long double>(decimal.digits));
      if (std::abs(rest - 0.5) < too_near)
        return false;
      decimal.digits += rest > 0.5;
      if (decimal.digits == 10 * least_of_digits)
        {
          decimal.digits = least_of_digits;
          ++decimal.exponent;
        }
      return decimal.digits >= least_of_digits;
    }

    /** The digits as characters; how many there are without zeros at the end. */
    int
    write_digits(std::int64_t digits, char *const to)
    {
      int n = 0;
      for (int i = n_digits - 1; i >= 0; --i, digits /= 10)
        {
          const int digit = digits % 10;
          to[i]           = '0' + digit;
          n               = n == 0 && digit != 0 ? i + 1 : n;
        }
      return n;
    }
  } // namespace



  char *
  write_fifteen_digits(const double number, char *to)
  {
    Decimal decimal;
    if (!find_decimal(std::abs(number), decimal))
      return nullptr;
    if (number < 0)
      *to++ = '-';
    char      all[n_digits];
    const int n = write_digits(decimal.digits, all), exponent = decimal.exponent;
    // as printf's %g: fixed, or with an exponent of two digits at least
    const bool is_fixed = exponent >= -4 && exponent < n_digits;
    if (is_fixed && exponent < 0)
      {
        *to++ = '0';
        *to++ = '.';
        to    = std::fill_n(to, -1 - exponent, '0');
        return std::copy_n(all, n, to);
      }
    const int before = is_fixed ? exponent + 1 : 1; // of the point; zeros at the end are still there
    to               = std::copy_n(all, before, to);
    if (n > before)
      {
        *to++ = '.';
        to    = std::copy(all + before, all + n, to);
      }
    if (is_fixed)
      return to;
    *to++              = 'e';
    *to++              = exponent < 0 ? '-' : '+';
    const int of_power = std::abs(exponent);
    *to++              = '0' + of_power / 10;
    *to++              = '0' + of_power % 10;
    return to;
  }
} // namespace samara
