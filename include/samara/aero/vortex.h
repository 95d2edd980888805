#ifndef samara_aero_vortex_h
#define samara_aero_vortex_h

#include <samara/base/value.h>

#include <Eigen/Dense>

#include <cmath>
#include <complex>
#include <vector>

namespace samara
{
  /** A vortex line of straight segments by the coordinates of its points [m], apart so that sums run over them fast. */
  template <typename Number>
  struct VortexLine
  {
    std::vector<Number> x, y, z;

    void
    resize(const unsigned int n)
    {
      x.resize(n);
      y.resize(n);
      z.resize(n);
    }
  };



  /**
   * The velocity at a place that a vortex line of unit circulation along it induces [1/m], by the law of Biot and
   * Savart with the core of G. H. Vatistas, V. Kozel & W. C. Mih (Exp. Fluids 11, 1991), n = 2: a straight line at the
   * distance h turns the air with h/(2π √(h⁴ + r_c⁴)). Of a segment L from p₁ to p₂, r_i = x − p_i,
   *
   *     v = r₁ × r₂ L·(r₁/|r₁| − r₂/|r₂|) / (4π √(|r₁ × r₂|⁴ + r_c⁴ |L|⁴))
   *
   * Zero at the points of the line themselves. Nothing is allocated.
   */
  template <typename Number>
  Eigen::Matrix<Number, 3, 1>
  induced_velocity(const Eigen::Matrix<Number, 3, 1> &at, const VortexLine<Number> &line, const double core)
  {
    using std::sqrt;
    const double        core_4 = core * core * core * core, least = 1e-24 * core * core + 1e-300;
    const Number *const x = line.x.data(), *const y = line.y.data(), *const z = line.z.data();
    const Number      at_x = at(0), at_y = at(1), at_z = at(2);
    Number            v_x(0), v_y(0), v_z(0);
    const std::size_t n = line.x.size();
    for (std::size_t i = 0; i + 1 < n; ++i)
      {
        const Number a_x = at_x - x[i], a_y = at_y - y[i], a_z = at_z - z[i];
        const Number b_x = at_x - x[i + 1], b_y = at_y - y[i + 1], b_z = at_z - z[i + 1];
        const Number l_x = a_x - b_x, l_y = a_y - b_y, l_z = a_z - b_z;
        const Number c_x = a_y * b_z - a_z * b_y, c_y = a_z * b_x - a_x * b_z, c_z = a_x * b_y - a_y * b_x;
        const Number c_2 = c_x * c_x + c_y * c_y + c_z * c_z, l_2 = l_x * l_x + l_y * l_y + l_z * l_z;
        const Number a     = 1. / sqrt(a_x * a_x + a_y * a_y + a_z * a_z + least),
                     b     = 1. / sqrt(b_x * b_x + b_y * b_y + b_z * b_z + least);
        const Number along = l_x * (a_x * a - b_x * b) + l_y * (a_y * a - b_y * b) + l_z * (a_z * a - b_z * b);
        const Number k     = along / sqrt(c_2 * c_2 + core_4 * l_2 * l_2 + 1e-300);
        v_x += k * c_x;
        v_y += k * c_y;
        v_z += k * c_z;
      }
    constexpr double per_turn = 1 / (4 * M_PI);
    return {v_x * per_turn, v_y * per_turn, v_z * per_turn};
  }
} // namespace samara

#endif
