#include <samara/base/text.h>
#include <samara/rotation/matrix6.h>
#include <samara/section/cross_section.h>
#include <samara/section/trapeze.h>

#include <algorithm>

namespace samara
{
  namespace
  {
    constexpr double margin_of_energy = 1e-3;
  }



  double
  least_stiffness(const Trapeze &trapeze, const Matrix6 &C)
  {
    // strains and moments have different units: scaled to a diagonal of ones
    const Vector6 scale = C.diagonal().cwiseSqrt().cwiseInverse();
    const Matrix6 unit  = scale.asDiagonal() * C * scale.asDiagonal();
    const Vector6 p     = scale.asDiagonal() * trapeze.coupling;
    return p.dot(symmetric_solution(unit, p));
  }



  Trapeze
  with_margin(Trapeze trapeze, const Matrix6 &C)
  {
    if (trapeze.is_there())
      trapeze.stiffness = std::max(trapeze.stiffness, (1 + margin_of_energy) * least_stiffness(trapeze, C));
    return trapeze;
  }



  Eigen::Vector2d
  shear_centre(const Matrix6 &compliance)
  {
    // Γ₂ − y₃ K₁ = Γ₃ + y₂ K₁ = 0 under a torque
    return Eigen::Vector2d(-compliance(2, 3), compliance(1, 3)) / compliance(3, 3);
  }



  Trapeze
  trapeze_of(const CrossSection &section)
  {
    const Eigen::Vector2d centre    = shear_centre(section.compliance);
    Vector6               of_forces = Vector6::Zero();
    Trapeze               result;
    for (const auto &point : section.points())
      {
        const double r2 = (Eigen::Vector2d(point.place[0], point.place[1]) - centre).squaredNorm();
        of_forces += point.weight * r2 * (point.C.row(0) * point.strain).transpose();
        result.stiffness += point.weight * r2 * point.helix;
      }
    result.coupling = section.stiffness * of_forces;
    return with_margin(result, section.stiffness);
  }



  std::string
  fault_of(const Trapeze &trapeze, const Matrix6 &C, const std::string &what)
  {
    if (!trapeze.is_there())
      return trapeze.coupling.isZero(0.) ?
               "" :
               what + " has a <Trapeze coupling> and no <Trapeze stiffness>, the integral of "
                      "E r^4 over the section; a thin strip has 1.8 times coupling^2 / EA, a "
                      "disc 1.34 times";
    if (trapeze.coupling.isZero(0.))
      return what + " has a <Trapeze stiffness> and no <Trapeze coupling>, the integral of E r^2 over the section";
    const double least = least_stiffness(trapeze, C);
    if (!(trapeze.stiffness >= least))
      return "the <Trapeze stiffness> of " + what + " must be " + number_to_text("%.6g", least) +
             " N*m^4 at least, coupling^2 / EA, or torsion would set energy free";
    return "";
  }
} // namespace samara
