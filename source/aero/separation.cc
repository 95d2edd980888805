#include <samara/aero/separation.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** The angle nearest to zero without lift. */
    double
    zero_lift_angle(const std::function<double(double)> &lift)
    {
      constexpr double step = 0.25 * M_PI / 180, most = 20 * M_PI / 180;
      for (double a = 0; a < most; a += step)
        for (const double sign : {1., -1.})
          {
            double low = sign * a, high = sign * (a + step);
            if (lift(low) == 0)
              return low;
            if (lift(low) * lift(high) > 0)
              continue;
            for (unsigned int i = 0; i < 60; ++i)
              {
                const double middle                         = 0.5 * (low + high);
                (lift(middle) * lift(low) > 0 ? low : high) = middle;
              }
            return 0.5 * (low + high);
          }
      throw std::invalid_argument("a section with dynamic stall has an angle without lift within 20 degrees of zero");
    }

    /** The largest lift in parts of sin x cos x, x from the angle without lift. */
    double
    attached_slope(const std::function<double(double)> &lift, const double zero)
    {
      double slope = 0;
      for (double x = 0.5; x <= 15; x += 0.25)
        for (const double sign : {1., -1.})
          {
            const double at = sign * x * M_PI / 180;
            slope           = std::max(slope, lift(zero + at) / (0.5 * std::sin(2 * at)));
          }
      if (slope < 0.1)
        throw std::invalid_argument("a section with dynamic stall has lift that grows with the angle of attack");
      return slope;
    }
  } // namespace



  Separation::Separation(const std::function<double(double)> &lift)
  {
    zero_lift                = zero_lift_angle(lift);
    const double        zero = zero_lift, slope = attached_slope(lift, zero);
    constexpr unsigned  n = 720; // half a degree
    std::vector<double> angles(n + 1);
    Eigen::MatrixXd     f(n + 1, 1), g(n + 1, 1);
    for (unsigned int i = 0; i <= n; ++i)
      angles[i] = i == n ? M_PI : -M_PI + i * 2 * M_PI / n;
    // from the angle without lift to both sides: behind the first full separation all is separated
    const auto walk = [&](int i, const int step) {
      for (bool is_separated = false; i >= 0 && i <= static_cast<int>(n); i += step)
        {
          // Kirchhoff: lift is ¼ (1 + √f)² of the attached one, a quarter where all is separated
          const double x = angles[i] - zero, attached = 0.5 * slope * std::sin(2 * x), l = lift(angles[i]),
                       ratio = std::abs(x) < 1e-6 ? 1. : l / attached;
          is_separated       = is_separated || std::abs(x) > M_PI / 2 || ratio < 0.25;
          const double root  = is_separated ? 0. : std::min(1., 2 * std::sqrt(ratio) - 1);
          f(i, 0)            = root * root;
          // (attached − l)/(1 − f), which is this where Kirchhoff's relation holds
          g(i, 0) =
            is_separated ? (std::abs(x) > M_PI / 2 ? 0. : attached - l) : attached * (3 + root) / (4 * (1 + root));
        }
    };
    const int middle = std::lround((zero + M_PI) * n / (2 * M_PI));
    walk(middle, 1);
    walk(middle, -1);
    place = AirfoilTable(angles, {0.}, f);
    gain  = AirfoilTable(angles, {0.}, g);
  }



  Separation::Value
  Separation::at(const double alpha) const
  {
    const double wrapped = std::remainder(alpha, 2 * M_PI);
    const auto   f = place.at(wrapped, 0.), g = gain.at(wrapped, 0.);
    return {f.value, f.alpha, g.value, g.alpha};
  }
} // namespace samara
