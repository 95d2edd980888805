#include <samara/base/text.h>
#include <samara/cosserat/section_loft.h>
#include <samara/model/drawing.h>
#include <samara/rotation/matrix6.h>
#include <samara/section/symmetric_matrix.h>

#include <cmath>

namespace samara
{
  std::vector<Eigen::Vector2d>
  drawn_outline(const std::vector<double> &radii, const Matrix6 &C)
  {
    if (radii.size() == 2)
      return ellipse_outline(radii[0], radii[1]);
    // of a full ellipse I/A = r²/4
    const auto radius = [&](const double EI) { return C(0, 0) > 0 && EI > 0 ? 2 * std::sqrt(EI / C(0, 0)) : 0.01; };
    return ellipse_outline(radius(C(5, 5)), radius(C(4, 4)));
  }



  std::vector<Eigen::Vector2d>
  interpolate(const std::vector<Eigen::Vector2d> &a, const std::vector<Eigen::Vector2d> &b, const double w)
  {
    std::vector<Eigen::Vector2d> result = a;
    if (a.size() == b.size())
      for (unsigned int i = 0; i < a.size(); ++i)
        result[i] = (1 - w) * a[i] + w * b[i];
    return result;
  }



  SectionValues
  interpolate(const SectionValues &a, const SectionValues &b, const double w)
  {
    return {(1 - w) * a.stiffness + w * b.stiffness,
            (1 - w) * a.inertia + w * b.inertia,
            interpolate(a.outline, b.outline, w),
            {(1 - w) * a.trapeze.coupling + w * b.trapeze.coupling,
             (1 - w) * a.trapeze.stiffness + w * b.trapeze.stiffness}};
  }



  std::unique_ptr<const SectionLoft>
  Section::loft_to(const Section &) const
  {
    return nullptr;
  }



  void
  Section::initialize(Model &model)
  {
    check(model);
  }



  void
  Section::check(Model &model) const
  {
    for (const double x : {0., 1.})
      if (const std::string fault = fault_of(at(x, Vector3::Zero()), "section <" + name + ">"); !fault.empty())
        return model.complaints.add(parameters.where(), fault);
  }



  std::string
  fault_of(const SectionValues &values, const std::string &what)
  {
    // written so that what is not a number is a fault, too; scaled, so that it is the same in all units
    const Vector6 diagonal = values.stiffness.diagonal();
    const Vector6 scale    = diagonal.cwiseAbs().cwiseSqrt().cwiseInverse();
    const Matrix6 scaled   = scale.asDiagonal() * values.stiffness * scale.asDiagonal();
    if (!(diagonal.minCoeff() > 0.) || !(symmetric_eigenvalues6(scaled)(0) > 0.))
      return "the stiffness of " + what +
             " is not positive definite: every one of EA, GA2, GA3, GJ, EI2, EI3 must be positive, and couplings must be "
             "small enough";
    if (!(symmetric_eigenvalues6(values.inertia)(0) >= -1e-12 * values.inertia.norm()))
      return "the inertia of " + what + " is not positive semidefinite";
    return fault_of(values.trapeze, values.stiffness, what);
  }



  void
  EngineeringConstants::add_parameters(Parameters &prm)
  {
    using dealii::Patterns::Double;
    using dealii::Patterns::List;
    const List two(Double(), 2, 2);
    prm.add("EA", EA, "Axial stiffness [N].", Double(0));
    prm.add("GA2", GA2, "Shear stiffness in direction 2, shear factor included [N].", Double(0));
    prm.add("GA3", GA3, "Shear stiffness in direction 3, shear factor included [N].", Double(0));
    prm.add("GJ", GJ, "Torsional stiffness [N*m^2].", Double(0));
    prm.add("EI2", EI2, "Stiffness in bending about axis 2 (curvature K2) [N*m^2].", Double(0));
    prm.add("EI3", EI3, "Stiffness in bending about axis 3 (curvature K3) [N*m^2].", Double(0));
    prm.add("EI23", EI23, "Coupling of the two bendings: M2 = EI2 K2 + EI23 K3 [N*m^2].");
    prm.add("Shear centre", shear_centre, "Its coordinates 2 and 3 in the section [m].", two);
    prm.add("Tension centre", tension_centre, "Its coordinates 2 and 3 in the section [m].", two);
    prm.add("Mass", mass, "Mass per length [kg/m].", Double(0));
    prm.add("Mass centre", mass_centre, "Its coordinates 2 and 3 in the section [m].", two);
    prm.add("I2", I2, "Mass moment of inertia per length about axis 2 through the mass centre [kg*m].", Double(0));
    prm.add("I3", I3, "Mass moment of inertia per length about axis 3 through the mass centre [kg*m].", Double(0));
    prm.add("I23", I23, "Mass product of inertia per length, integral of density y2 y3 [kg*m].");
    prm.add("Drawn radii",
            drawn_radii,
            "Half axes along 2 and 3 of the ellipse that is drawn; default: from EI/EA [m].");
    prm.add("Trapeze coupling",
            trapeze_coupling,
            "Integral of E r^2 over the section, r from the shear centre: tension stiffens torsion by that times the "
            "strain of the tension centre [N*m^2].",
            Double(0));
    prm.add("Trapeze stiffness",
            trapeze_stiffness,
            "Integral of E r^4 over the section, which belongs to <Trapeze coupling> [N*m^4].",
            Double(0));
  }



  SectionValues
  EngineeringConstants::values() const
  {
    Matrix6 centres = Matrix6::Identity(); // from strains of the reference line to those of the centres
    centres(0, 4)   = tension_centre[1];
    centres(0, 5)   = -tension_centre[0];
    centres(1, 3)   = -shear_centre[1];
    centres(2, 3)   = shear_centre[0];
    Matrix6 C       = Vector6(EA, GA2, GA3, GJ, EI2, EI3).asDiagonal();
    C(4, 5) = C(5, 4) = EI23;

    SectionValues v;
    v.stiffness = centres.transpose() * C * centres;

    // about the mass centre; then parallel axes take it to the reference line
    Matrix3 J;
    J << I2 + I3, 0, 0, 0, I2, -I23, 0, -I23, I3;
    v.inertia.topLeftCorner<3, 3>()     = mass * Matrix3::Identity();
    v.inertia.bottomRightCorner<3, 3>() = J;
    const Matrix6 T                     = twist_transfer({0, mass_centre[0], mass_centre[1]}, Matrix3::Identity());
    v.inertia                           = T.transpose() * v.inertia * T;

    v.outline = drawn_outline(drawn_radii, v.stiffness);
    v.trapeze = {trapeze_coupling * centres.row(0).transpose(), trapeze_stiffness};
    return v;
  }



  void
  EngineeringSection::add_parameters(Parameters &prm)
  {
    constants.add_parameters(prm);
  }



  SectionValues
  EngineeringSection::at(const double, const Vector3 &) const
  {
    return constants.values();
  }



  void
  MatrixSection::add_parameters(Parameters &prm)
  {
    prm.add(
      "Stiffness",
      stiffness,
      "6x6 matrix, SI units, order Gamma1 Gamma2 Gamma3 K1 K2 K3: 36 numbers by rows, 21 of the upper triangle by "
      "rows, or 6 of the diagonal.");
    prm.add("Compliance", compliance, "Its inverse, instead of the stiffness: 36, 21 or 6 numbers, SI units.");
    prm.add(
      "Inertia",
      inertia,
      "6x6 matrix per length about the reference line, rows (m I, -m c~) and (m c~, J), SI units: 36, 21 or 6 numbers.");
    prm.add("Drawn radii",
            drawn_radii,
            "Half axes along 2 and 3 of the ellipse that is drawn; default: from EI/EA [m].");
    prm.add(
      "Trapeze coupling",
      trapeze_coupling,
      "Torsional stiffness that tension adds, per strain: six numbers for Gamma1 Gamma2 Gamma3 K1 K2 K3, the first "
      "one being the integral of E r^2 over the section, SI units.",
      dealii::Patterns::List(dealii::Patterns::Double(), 0, 6));
    prm.add("Trapeze stiffness",
            trapeze_stiffness,
            "Integral of E r^4 over the section, which belongs to <Trapeze coupling> [N*m^4].",
            dealii::Patterns::Double(0));
  }



  void
  MatrixSection::initialize(Model &model)
  {
    std::string given = compliance.empty() ? "Stiffness" : "Compliance";
    try
      {
        if (stiffness.empty() == compliance.empty())
          throw std::invalid_argument("give either <Stiffness> or <Compliance>");
        values.stiffness = symmetric_matrix(stiffness.empty() ? compliance : stiffness);
        if (stiffness.empty())
          values.stiffness = inverse6(values.stiffness);
        values.outline = drawn_outline(drawn_radii, values.stiffness);
        if (!inertia.empty())
          values.inertia = symmetric_matrix(inertia);
        given                    = "Trapeze coupling";
        values.trapeze.stiffness = trapeze_stiffness;
        if (trapeze_coupling.size() == 6)
          values.trapeze.coupling = Eigen::Map<const Vector6>(trapeze_coupling.data());
        else if (!trapeze_coupling.empty())
          throw std::invalid_argument("<Trapeze coupling> has six numbers, not " +
                                      std::to_string(trapeze_coupling.size()));
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where(given), problem.what());
        return;
      }
    check(model);
  }



  SectionValues
  MatrixSection::at(const double, const Vector3 &) const
  {
    return values;
  }
} // namespace samara
