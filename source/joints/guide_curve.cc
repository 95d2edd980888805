#include <samara/base/text.h>
#include <samara/joints/guide_curve.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace samara
{
  namespace
  {
    constexpr unsigned int n_pieces = 1000;
  }



  GuideCurve::GuideCurve(const std::array<Expression, 3> &expressions)
    : expressions(expressions)
    , arc_lengths(1, 0.)
  {
    for (unsigned int i = 0; i < n_pieces; ++i)
      {
        const double a = double(i) / n_pieces, b = double(i + 1) / n_pieces, piece = distance(a, b);
        if (!std::isfinite(piece) || !(piece > 0))
          throw std::invalid_argument("the curve stands still, or is not finite, at s = " + number_to_text(a));
        arc_lengths.push_back(arc_lengths.back() + piece);
      }
    // a formula may switch without a corner, as |s|³ does: what counts is the slope on both sides
    for (const auto &f : expressions)
      for (double s = f.next_corner(0., 1.); s < 1.; s = f.next_corner(s, 1.))
        {
          const double h = 1e-9;
          if (std::abs(f.derivative(s + h) - f.derivative(s - h)) > 1e-6 * (length() + std::abs(f.derivative(s + h))) ||
              std::abs(f(s + h) - f(s - h)) > 1e-6 * length())
            throw std::invalid_argument("the curve has a corner at s = " + number_to_text(s) + "; it must be smooth");
        }
    for (unsigned int i = 0; i <= n_pieces; ++i)
      if (derivative(double(i) / n_pieces).norm() < 1e-6 * length())
        throw std::invalid_argument("the curve stands still at s = " + number_to_text(double(i) / n_pieces));
    closed = (position(1) - position(0)).norm() < 1e-9 * length() &&
             (derivative(1).normalized() - derivative(0).normalized()).norm() < 1e-6;
  }



  Vector3
  GuideCurve::position(const double s) const
  {
    return {expressions[0](s), expressions[1](s), expressions[2](s)};
  }



  Vector3
  GuideCurve::derivative(const double s) const
  {
    return {expressions[0].derivative(s), expressions[1].derivative(s), expressions[2].derivative(s)};
  }



  Vector3
  GuideCurve::second_derivative(const double s) const
  {
    return {expressions[0].second_derivative(s),
            expressions[1].second_derivative(s),
            expressions[2].second_derivative(s)};
  }



  double
  GuideCurve::distance(const double a, const double b) const
  {
    // the four-point Gauss rule
    static const double x[] = {0.3399810435848563, 0.8611363115940526}, w[] = {0.6521451548625461, 0.3478548451374538};
    double              sum = 0;
    for (unsigned int k = 0; k < 2; ++k)
      for (const int sign : {-1, 1})
        sum += w[k] * derivative(0.5 * (a + b) + sign * x[k] * 0.5 * (b - a)).norm();
    return 0.5 * (b - a) * sum;
  }



  double
  GuideCurve::parameter(const double sigma) const
  {
    const auto   next = std::upper_bound(arc_lengths.begin() + 1, arc_lengths.end() - 1, sigma);
    const auto   i    = next - arc_lengths.begin() - 1;
    const double a    = double(i) / n_pieces;
    double       s    = a + (sigma - arc_lengths[i]) / (arc_lengths[i + 1] - arc_lengths[i]) / n_pieces;
    // Newton's method from linear interpolation in one of a thousand pieces: quadratic from there, four are enough
    for (unsigned int iteration = 0; iteration < 4; ++iteration)
      s -= (arc_lengths[i] + distance(a, s) - sigma) / derivative(s).norm();
    return s;
  }



  GuideCurve::At
  GuideCurve::at(const double sigma) const
  {
    const double  L      = length();
    const double  within = closed ? sigma - L * std::floor(sigma / L) : std::min(L, std::max(0., sigma));
    const double  s      = parameter(within);
    const Vector3 d = derivative(s), t = d / d.norm(), dd = second_derivative(s);
    // straight on beyond the ends; else the curvature d²x/dσ², what x'' has across the tangent over |x'|²
    if (within != sigma && !closed)
      return {position(s) + (sigma - within) * t, t, Vector3::Zero()};
    return {position(s), t, (dd - dd.dot(t) * t) / d.squaredNorm()};
  }



  double
  GuideCurve::nearest(const Vector3 &x) const
  {
    double       best = 0, least = (position(0) - x).norm();
    const double n = 10. * n_pieces;
    for (double i = 1; i <= n; ++i)
      if (const double distance = (position(i / n) - x).norm(); distance < least)
        {
          least = distance;
          best  = i / n;
        }
    // arc length of the sample, then Newton's method for (x(σ) − x)·t = 0, which is kept near
    const auto   piece = std::min<unsigned int>(n_pieces - 1, static_cast<unsigned int>(best * n_pieces));
    double       sigma = arc_lengths[piece] + distance(double(piece) / n_pieces, best);
    const double start = sigma, reach = 2 * length() / n;
    for (unsigned int iteration = 0; iteration < 20; ++iteration)
      {
        const At     here  = at(sigma);
        const double slope = 1 + (here.x - x).dot(here.curvature);
        if (std::abs(slope) < 1e-6)
          break;
        sigma -= (here.x - x).dot(here.tangent) / slope;
        sigma = std::min(start + reach, std::max(start - reach, sigma));
      }
    return closed ? sigma : std::min(length(), std::max(0., sigma));
  }
} // namespace samara
