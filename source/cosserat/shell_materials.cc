// What a shell is made of.

#include <samara/cosserat/shell.h>
#include <samara/section/elasticity.h>
#include <samara/section/layup.h>

#include <stdexcept>

namespace samara
{
  void
  Shell::add_material_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    prm.add(
      "Layup",
      layup_name,
      "Name of the layup; the normal points from its first ply to its last, angles turn from axis 1 to axis 2. Or "
      "an isotropic material by the next four entries.");
    prm.add(
      "Transverse shear",
      transverse_shear,
      "By which rule the stiffness in transverse shear follows from the plies: that of equilibrium, or the asymptotic "
      "one, from the energy of second order in thickness over length.",
      Selection("equilibrium|asymptotic"));
    prm.add("E", E, "Young's modulus [Pa].", Double(0));
    prm.add("Poisson ratio", nu, "Poisson's ratio [1].", Double(-1, 0.5));
    prm.add("Density", density, "Density [kg/m^3].", Double(0));
    prm.add("Thickness", thickness_entry, "Thickness [m].", Double(0));
    prm.add("Offset", offset, "Of the middle of the thickness from the reference surface, along the normal [m].");
    prm.add("Damping",
            relaxation_time,
            "Stiffness-proportional damping: viscous stress is this time times the rate of elastic stress [s].",
            Double(0));
  }



  void
  Shell::make_laminate()
  {
    if (parameters.is_set("Layup"))
      {
        for (const std::string entry : {"E", "Poisson ratio", "Density", "Thickness"})
          if (parameters.is_set(entry))
            model->complaints.add(parameters.where(entry),
                                  "shell <" + name + "> has a <Layup>, which says what <" + entry + "> is");
        try
          {
            laminate =
              std::make_unique<Laminate>(model->find<Layup>(layup_name, "layup").laminae(),
                                         transverse_shear == "asymptotic" ? Laminate::TransverseShear::asymptotic :
                                                                            Laminate::TransverseShear::equilibrium);
          }
        catch (const std::invalid_argument &problem)
          {
            model->complaints.add(parameters.where("Layup"), problem.what());
          }
        return;
      }
    if (parameters.is_set("Transverse shear"))
      model->complaints.add(parameters.where("Transverse shear"),
                            "<Transverse shear> is of a <Layup>; an isotropic shell has 5/6");
    for (const auto &[entry, value] : {std::pair("E", E), std::pair("Thickness", thickness_entry)})
      if (value <= 0)
        model->complaints.add(parameters.where(entry),
                              "shell <" + name + "> needs a <Layup>, or <" + entry + "> above zero");
    if (nu <= -1 || nu >= 0.5)
      model->complaints.add(parameters.where("Poisson ratio"),
                            "Poisson's ratio of shell <" + name + "> must be above -1 and below 0.5");
    else if (E > 0 && thickness_entry > 0)
      laminate = std::make_unique<Laminate>(
        std::vector<Lamina>{{elasticity::isotropic_stiffness(E, nu), 0., thickness_entry, density}});
  }
} // namespace samara
