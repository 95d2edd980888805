#include <samara/aero/airfoil.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace samara
{
  Coefficients
  Coefficients::blended(const Coefficients &other, const double share) const
  {
    const auto   mix = [share](const double a, const double b) { return a + share * (b - a); };
    Coefficients c;
    c.lift         = mix(lift, other.lift);
    c.drag         = mix(drag, other.drag);
    c.moment       = mix(moment, other.moment);
    c.lift_alpha   = mix(lift_alpha, other.lift_alpha);
    c.drag_alpha   = mix(drag_alpha, other.drag_alpha);
    c.moment_alpha = mix(moment_alpha, other.moment_alpha);
    c.lift_mach    = mix(lift_mach, other.lift_mach);
    c.drag_mach    = mix(drag_mach, other.drag_mach);
    c.moment_mach  = mix(moment_mach, other.moment_mach);
    return c;
  }



  std::optional<Probe>
  Airfoil::probe(const std::string &path) const
  {
    std::string        quantity, place, words[2], rest;
    double             alpha = 0, mach = 0;
    const bool         has_place = split_at(path, quantity, place);
    std::istringstream in(place);
    in >> words[0] >> words[1];
    if (!has_place || (in >> rest) || !text_to_number(words[0], alpha) || !text_to_number(words[1], mach) || mach < 0 ||
        std::abs(alpha) > 180)
      return {};
    double Coefficients::*what = quantity == "lift"   ? &Coefficients::lift :
                                 quantity == "drag"   ? &Coefficients::drag :
                                 quantity == "moment" ? &Coefficients::moment :
                                                        nullptr;
    if (what == nullptr)
      return {};
    return Probe{path, "1", [this, alpha, mach, what](const State &) { return at(alpha * M_PI / 180, mach).*what; }};
  }



  std::vector<std::string>
  Airfoil::probe_names() const
  {
    return {"lift at 5 0.3", "drag at 5 0.3", "moment at 5 0.3"};
  }



  void
  AnalyticAirfoil::add_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    prm.add(
      "Form",
      form,
      "How lift, drag and moment go on beyond small angles: periodic (a sin x cos x, polynomials of sin x) or linear "
      "(a x, polynomials of x), where x is the angle from that of zero lift.",
      Selection("periodic|linear"));
    prm.add("Lift slope", lift_slope, "a: slope of the lift coefficient [1/rad].");
    prm.add("Zero-lift angle", zero_lift_angle, "Angle of attack without lift [rad].");
    prm.add("Drag", drag, "Coefficients d0, d1, d2 of the drag polynomial, at most three [1].", List(Double(), 1, 3));
    prm.add("Moment",
            moment,
            "Coefficients m0, m1 of the moment about the quarter chord, nose up, at most two [1].",
            List(Double(), 1, 2));
    prm.add("Compressible",
            is_compressible,
            "Whether the lift slope grows with the Mach number as 1/sqrt(1 - M^2), M at most 0.9.");
    prm.add(
      "Stall angle",
      stall_angle,
      "Angle from that of zero lift at which the flow separates, and the section becomes a plate; 0: never [rad].",
      Double(0, M_PI / 2));
    prm.add("Stall width", stall_width, "Width of the passage from attached to separated flow [rad].", Double(1e-6));
  }



  void
  AnalyticAirfoil::initialize(Model &)
  {
    drag.resize(3, 0.);
    moment.resize(2, 0.);
  }



  namespace
  {
    /** A function value and its derivative. */
    struct WithSlope
    {
      double value, slope;
    };

    /** 1/(1 + exp(−x)) */
    WithSlope
    logistic(const double x)
    {
      const double s = x >= 0 ? 1 / (1 + std::exp(-x)) : std::exp(x) / (1 + std::exp(x));
      return {s, s * (1 - s)};
    }
  } // namespace



  Coefficients
  AnalyticAirfoil::at(const double alpha, const double mach) const
  {
    // the angle from that of zero lift, within half a turn
    const double x = std::remainder(alpha - zero_lift_angle, 2 * M_PI);
    const double s = std::sin(x), c = std::cos(x);
    const bool   is_linear = form == "linear";
    const double u = is_linear ? x : s, du = is_linear ? 1 : c;

    // Prandtl & Glauert, up to a Mach number behind which their factor is no longer of this flow
    constexpr double highest = 0.9;
    const double     M       = std::min(mach, highest);
    const double     growth  = is_compressible ? 1 / std::sqrt(1 - M * M) : 1;
    const double     shape = is_linear ? x : s * c, dshape = is_linear ? 1 : c * c - s * s;

    Coefficients k;
    k.lift         = lift_slope * growth * shape;
    k.lift_alpha   = lift_slope * growth * dshape;
    k.lift_mach    = is_compressible && mach < highest ? k.lift * M * growth * growth : 0.;
    k.drag         = drag[0] + drag[1] * u + drag[2] * u * u;
    k.drag_alpha   = (drag[1] + 2 * drag[2] * u) * du;
    k.moment       = moment[0] + moment[1] * u;
    k.moment_alpha = moment[1] * du;
    if (stall_angle == 0)
      return k;

    // beyond the stall a flat plate: a normal force of 2 sin α in the middle of the chord; both are blended by logistic
    // functions of the width of the stall
    const WithSlope s1 = logistic((x - stall_angle) / stall_width), s2 = logistic((-x - stall_angle) / stall_width);
    const double    share  = s1.value + s2.value - s1.value * s2.value;
    const double    dshare = (s1.slope * (1 - s2.value) - s2.slope * (1 - s1.value)) / stall_width;
    Coefficients    plate;
    plate.lift         = std::sin(2 * alpha);
    plate.lift_alpha   = 2 * std::cos(2 * alpha);
    plate.drag         = 2 * std::sin(alpha) * std::sin(alpha);
    plate.drag_alpha   = 2 * std::sin(2 * alpha);
    plate.moment       = -0.5 * std::sin(alpha);
    plate.moment_alpha = -0.5 * std::cos(alpha);
    Coefficients both  = k.blended(plate, share);
    both.lift_alpha += dshare * (plate.lift - k.lift);
    both.drag_alpha += dshare * (plate.drag - k.drag);
    both.moment_alpha += dshare * (plate.moment - k.moment);
    return both;
  }
} // namespace samara
