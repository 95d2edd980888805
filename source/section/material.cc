#include <samara/model/model.h>
#include <samara/rotation/matrix6.h>
#include <samara/section/material.h>
#include <samara/section/symmetric_matrix.h>

namespace samara
{
  using dealii::Patterns::Double;
  using dealii::Patterns::List;



  void
  Material::add_common(Parameters &prm, const bool is_isotropic)
  {
    const List        numbers(Double(0), 0, 3);
    const std::string directions = is_isotropic ? "" : ", along axes 1, 2, 3 of the material",
                      planes     = is_isotropic ? "" : ", in the planes 12, 13, 23 of the material";
    prm.add("Density", density, "Density [kg/m^3].", Double(0));
    prm.add("Tensile strength",
            tensile,
            "Largest tension" + directions + "; one number for all, or three; not given: not known [Pa].",
            numbers);
    prm.add("Compressive strength",
            compressive,
            "Largest pressure, above zero" + directions + "; one number or three [Pa].",
            numbers);
    prm.add("Shear strength", shear, "Largest shear stress" + planes + "; one number or three [Pa].", numbers);
    if (is_isotropic)
      prm.add("Yield stress", yield, "Largest von Mises stress; 0: not known [Pa].", Double(0));
  }



  bool
  Material::read_strength(const std::string         &entry,
                          const std::vector<double> &given,
                          Vector3                   &strength,
                          Model                     &model) const
  {
    if (given.empty())
      return true;
    if (given.size() == 2 || *std::min_element(given.begin(), given.end()) <= 0)
      {
        model.complaints.add(parameters.where(entry), "give one number or three for <" + entry + ">, all above zero");
        return false;
      }
    for (int i = 0; i < 3; ++i)
      strength(i) = given[given.size() == 3 ? i : 0];
    return true;
  }



  void
  Material::initialize(Model &model)
  {
    own.name            = name;
    own.density         = density;
    own.strengths.yield = yield;
    read_strength("Tensile strength", tensile, own.strengths.tensile, model);
    read_strength("Compressive strength", compressive, own.strengths.compressive, model);
    read_strength("Shear strength", shear, own.strengths.shear, model);
    try
      {
        own.stiffness = stiffness();
        // moduli differ by powers of ten: a matrix is judged by what is left when its diagonal is one
        const Vector6 scale = own.stiffness.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
        if (!scale.allFinite() || !(own.stiffness.diagonal().minCoeff() > 0) ||
            !(symmetric_eigenvalues6(scale.asDiagonal() * own.stiffness * scale.asDiagonal())(0) > 1e-12))
          throw std::invalid_argument("the stiffness of material <" + name + "> is not positive definite");
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where(blamed_entry()), problem.what());
      }
  }



  void
  IsotropicMaterial::add_parameters(Parameters &prm)
  {
    prm.add("E", E, "Young's modulus [Pa].", Double(0));
    prm.add("Poisson ratio", nu, "Poisson's ratio, above -1 and below 0.5 [1].", Double(-1, 0.5));
    add_common(prm, true);
  }



  Matrix6
  IsotropicMaterial::stiffness() const
  {
    if (!(E > 0))
      throw std::invalid_argument("material <" + name + "> needs an <E> above zero");
    return elasticity::isotropic_stiffness(E, nu);
  }



  std::string
  IsotropicMaterial::blamed_entry() const
  {
    return E > 0 ? "Poisson ratio" : "E";
  }



  void
  OrthotropicMaterial::add_parameters(Parameters &prm)
  {
    auto &m = given;
    prm.add("E1", m.E1, "Young's modulus along axis 1, that of the fibres [Pa].", Double(0));
    prm.add("E2", m.E2, "Along axis 2 [Pa].", Double(0));
    prm.add("E3", m.E3, "Along axis 3; not given: as E2 [Pa].", Double(0));
    prm.add("G12", m.G12, "Shear modulus [Pa].", Double(0));
    prm.add("G13", m.G13, "Shear modulus; not given: as G12 [Pa].", Double(0));
    prm.add("G23", m.G23, "Shear modulus; not given: E2/2/(1 + nu23) [Pa].", Double(0));
    prm.add("nu12", m.nu12, "Poisson's ratio: contraction along 2 under tension along 1 [1].");
    prm.add("nu13", m.nu13, "Contraction along 3 under tension along 1; not given: as nu12 [1].");
    prm.add("nu23", m.nu23, "Contraction along 3 under tension along 2 [1].");
    add_common(prm, false);
  }



  Matrix6
  OrthotropicMaterial::stiffness() const
  {
    elasticity::Orthotropic m = given;
    for (const std::string entry : {"E1", "E2", "G12"})
      if (!parameters.is_set(entry))
        throw std::invalid_argument("material <" + name + "> needs <" + entry + ">");
    if (!parameters.is_set("E3"))
      m.E3 = m.E2;
    if (!parameters.is_set("G13"))
      m.G13 = m.G12;
    if (!parameters.is_set("nu13"))
      m.nu13 = m.nu12;
    if (!parameters.is_set("G23"))
      m.G23 = m.E2 / 2 / (1 + m.nu23);
    return elasticity::stiffness(m);
  }



  std::string
  OrthotropicMaterial::blamed_entry() const
  {
    return "E1";
  }



  void
  AnisotropicMaterial::add_parameters(Parameters &prm)
  {
    prm.add("Stiffness",
            given_stiffness,
            "Stresses from strains in the order 11 22 33 23 13 12, shear strains doubled: 36 numbers by rows, or 21 of "
            "the upper triangle by rows [Pa].");
    prm.add("Compliance", given_compliance, "Its inverse instead: 36 or 21 numbers [1/Pa].");
    add_common(prm, false);
  }



  Matrix6
  AnisotropicMaterial::stiffness() const
  {
    if (given_stiffness.empty() == given_compliance.empty())
      throw std::invalid_argument("material <" + name + ">: give either <Stiffness> or <Compliance>");
    const Matrix6 A = symmetric_matrix(given_compliance.empty() ? given_stiffness : given_compliance);
    if (!given_compliance.empty() && std::abs(A.determinant()) == 0)
      throw std::invalid_argument("the compliance of material <" + name + "> has no inverse");
    return given_compliance.empty() ? A : inverse6(A);
  }



  std::string
  AnisotropicMaterial::blamed_entry() const
  {
    return given_compliance.empty() ? "Stiffness" : "Compliance";
  }
} // namespace samara
