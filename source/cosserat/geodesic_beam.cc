#include <samara/cosserat/geodesic_beam.h>

namespace samara
{
  namespace
  {
    /** Number without its derivatives, which decides between a series and the function. */
    template <typename Number>
    double
    magnitude(const Number &x)
    {
      using std::abs;
      if constexpr (std::is_same_v<Number, double> || std::is_same_v<Number, std::complex<double>>)
        return abs(x);
      else
        return magnitude(x.val());
    }

    /** Below this both functions are summed: they are smooth at 0, but roots are not. */
    constexpr double near_zero = 0.05;

    /** atan(√x)/√x = 1 − x/3 + x²/5 − … */
    template <typename Number>
    Number
    arc_over_tangent(const Number &x)
    {
      using std::atan;
      using std::sqrt;
      if (magnitude(x) > near_zero)
        {
          const Number t = sqrt(x);
          return atan(t) / t;
        }
      Number sum = 0.;
      for (int k = 12; k >= 0; --k)
        sum = 1. / (2 * k + 1) - x * sum;
      return sum;
    }

    /** sin(√x)/√x = 1 − x/6 + … */
    template <typename Number>
    Number
    sine_over_angle(const Number &x)
    {
      using std::sin;
      using std::sqrt;
      if (magnitude(x) > near_zero)
        {
          const Number t = sqrt(x);
          return sin(t) / t;
        }
      Number sum = 0.;
      for (int k = 6; k >= 0; --k)
        sum = 1. - x / double((2 * k + 2) * (2 * k + 3)) * sum;
      return sum;
    }

    /** φ with R = exp(φ), by the quaternion (q₀, q): tan(|φ|/2) = |q|/q₀. */
    template <typename Number>
    Vec3<Number>
    logarithm(const Mat3<Number> &R)
    {
      using std::sqrt;
      const Number       q_0 = Number(0.5) * sqrt(Number(1. + R(0, 0) + R(1, 1) + R(2, 2)));
      const Vec3<Number> q   = axial(R) / Number(2. * q_0);
      const Vec3<Number> t   = q / q_0;
      return t * Number(2. * arc_over_tangent<Number>(dot(t, t)));
    }

    /** exp(φ) = I + sin|φ|/|φ| φ~ + ½ (sin(|φ|/2)/(|φ|/2))² φ~φ~ */
    template <typename Number>
    Mat3<Number>
    exponential(const Vec3<Number> &phi)
    {
      const Number       x = dot(phi, phi), half = sine_over_angle<Number>(Number(0.25 * x));
      const Mat3<Number> s = skew(phi);
      return Mat3<Number>::Identity() + s * sine_over_angle<Number>(x) + s * s * Number(0.5 * half * half);
    }
  } // namespace



  template <typename Number>
  void
  GeodesicBeam::strains_of(const PrototypeElement<1> &element, const kernel::NodeValues<Number> *nodes, Number *e) const
  {
    const double       per_length = element.slope(0, 1, 0); // 1/L
    const Mat3<Number> R          = nodes[0].D.transpose() * nodes[1].D;
    const Vec3<Number> phi        = logarithm<Number>(R);
    const Mat3<Number> d          = nodes[0].D * exponential<Number>(Vec3<Number>(phi * Number(0.5)));
    const Vec3<Number> slope      = (nodes[1].x - nodes[0].x) * Number(per_length);
    const Vec3<Number> gamma      = d.transpose() * slope;
    for (int k = 0; k < 3; ++k)
      {
        e[k]     = gamma(k);
        e[3 + k] = phi(k) * per_length;
      }
  }



  template class Prototype<GeodesicBeam, Beam, 1>;
} // namespace samara
