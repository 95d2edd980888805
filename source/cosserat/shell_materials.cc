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
    prm.add("Patch layups", patch_layups, "Names of the layups of all patches, one for each, in place of one layup.");
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
    prm.add("Layers in pictures",
            shows_layers,
            "Whether pictures also have each layer with its stresses in the axes of its material and its indices of "
            "failure: three surfaces, at its bottom, middle and top, as an object <NAME layers>.");
  }



  void
  Shell::make_laminates()
  {
    const bool has_layup = parameters.is_set("Layup"), has_layups = parameters.is_set("Patch layups");
    if (has_layup || has_layups)
      {
        const std::string given = has_layup ? "Layup" : "Patch layups";
        for (const std::string entry : {"E", "Poisson ratio", "Density", "Thickness"})
          if (parameters.is_set(entry))
            model->complaints.add(parameters.where(entry),
                                  "shell <" + name + "> has " + (has_layup ? "a <" : "<") + given +
                                    ">, which says what <" + entry + "> is");
        if (has_layup && has_layups)
          return model->complaints.add(parameters.where("Patch layups"),
                                       "shell <" + name + "> has either a <Layup> or <Patch layups>");
        if (has_layups && patch_layups.size() != patch_entries.size())
          return model->complaints.add(parameters.where("Patch layups"),
                                       "shell <" + name + "> has " + std::to_string(patch_entries.size()) +
                                         " <Patches>, and <Patch layups> for " + std::to_string(patch_layups.size()));
        for (const auto &layup : has_layup ? std::vector<std::string>{layup_name} : patch_layups)
          add_laminate(given, layup);
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
      {
        laminates.emplace_back(
          std::vector<Lamina>{{elasticity::isotropic_stiffness(E, nu), 0., thickness_entry, density}});
        strengths.emplace_back(1);
      }
  }



  void
  Shell::add_laminate(const std::string &entry, const std::string &layup)
  {
    try
      {
        const auto &plies = model->find<Layup>(layup, "layup");
        laminates.emplace_back(plies.laminae(),
                               transverse_shear == "asymptotic" ? Laminate::TransverseShear::asymptotic :
                                                                  Laminate::TransverseShear::equilibrium);
        strengths.emplace_back();
        for (const auto &ply : plies.plies())
          strengths.back().push_back(ply.material->strengths);
      }
    catch (const std::invalid_argument &problem)
      {
        model->complaints.add(parameters.where(entry), problem.what());
      }
  }
} // namespace samara
