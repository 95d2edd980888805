// What a shell is made of.

#include <samara/base/text.h>
#include <samara/cosserat/shell.h>
#include <samara/section/elasticity.h>
#include <samara/section/layup.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace samara
{
  RegionLayup
  Value<RegionLayup>::read(const std::string &text, const std::string &, const Quantities &)
  {
    const auto words = split_top_level(text, ',');
    if (words.size() != 2 || words[0].empty() || words[1].empty())
      throw std::invalid_argument("the layup of a region is written <region, layup>, not <" + text + ">");
    return {words[0], words[1]};
  }



  std::string
  Value<RegionLayup>::write(const RegionLayup &value)
  {
    return value.region + ", " + value.layup;
  }



  PatternPointer
  Value<RegionLayup>::pattern()
  {
    return std::make_unique<dealii::Patterns::Anything>();
  }



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
      "Region layups",
      region_layups,
      "Layups of regions, the physical surfaces (Gmsh) or sets of elements (Abaqus) of a mesh file, or <patch 2>: "
      "skin, thin; cap, thick; ... A <Layup> beside them is that of the rest.");
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
    const bool has_layup = parameters.is_set("Layup"), has_layups = parameters.is_set("Patch layups"),
               has_regions = !region_layups.empty();
    if (has_layup || has_layups || has_regions)
      {
        const std::string given = has_layup ? "Layup" : has_layups ? "Patch layups" : "Region layups";
        for (const std::string entry : {"E", "Poisson ratio", "Density", "Thickness"})
          if (parameters.is_set(entry))
            model->complaints.add(parameters.where(entry),
                                  "shell <" + name + "> has " + (has_layup ? "a <" : "<") + given +
                                    ">, which says what <" + entry + "> is");
        if (has_layups && (has_layup || has_regions))
          return model->complaints.add(parameters.where("Patch layups"),
                                       "shell <" + name + "> has either a <Layup> or <Patch layups>" +
                                         (has_regions ? " or <Region layups>" : ""));
        if (has_layups && patch_layups.size() != patch_entries.size())
          return model->complaints.add(parameters.where("Patch layups"),
                                       "shell <" + name + "> has " + std::to_string(patch_entries.size()) +
                                         " <Patches>, and <Patch layups> for " + std::to_string(patch_layups.size()));
        for (const auto &layup : has_layup ? std::vector<std::string>{layup_name} : patch_layups)
          add_laminate(given, layup);
        for (const auto &of_region : region_layups)
          add_laminate("Region layups", of_region.layup);
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



  void
  Shell::distribute_laminates()
  {
    const unsigned int n_cells = mesh->cells.size();
    laminate_of_cell.clear();
    if (!patch_layups.empty())
      for (const auto &cell : mesh->cells)
        laminate_of_cell.push_back(cell.patch);
    if (region_layups.empty())
      return;
    // that of the rest, if there is one, comes first
    const unsigned int rest = layup_name.empty() ? 0 : 1;
    std::vector<int>   region_of(n_cells, -1);
    try
      {
        for (unsigned int r = 0; r < region_layups.size(); ++r)
          for (const unsigned int cell : cells_of(region_layups[r].region))
            {
              if (region_of[cell] >= 0)
                throw std::invalid_argument(mesh->name_of(cell) + " of shell <" + name + "> is in the regions <" +
                                            region_layups[region_of[cell]].region + "> and <" +
                                            region_layups[r].region + ">: which layup it has is not said");
              region_of[cell] = r;
            }
        for (unsigned int cell = 0; cell < n_cells; ++cell)
          if (region_of[cell] < 0 && rest == 0)
            throw std::invalid_argument(mesh->name_of(cell) + " of shell <" + name +
                                        "> is in none of the regions that have a layup: give one, or a <Layup> of the "
                                        "rest." +
                                        groups_of_file);
          else
            laminate_of_cell.push_back(region_of[cell] < 0 ? 0 : rest + region_of[cell]);
      }
    catch (const std::invalid_argument &problem)
      {
        model->complaints.add(parameters.where("Region layups"), problem.what());
      }
  }



  namespace
  {
    /** Stiffness of Γ₁₂ − Γ₂₁ over A₆₆: rotations about the normal follow those of the surface. */
    constexpr double beta = 0.1;

    /**
     * Stiffness of K₁₁ + K₂₂ over A₆₆ h²/12. On a plane this sum is γ₁₃,₂ − γ₂₃,₁, the curl of the shear strain, which
     * has no stiffness of its own: free edges consist of it (Mindlin). So much only makes the matrix definite.
     */
    constexpr double least_twist = 1e-8;

    /** The tension over A₆₆ up to which rotations about the normal are stable; see doc/theory/shell.md. */
    constexpr double tension_held = 0.01;
  } // namespace



  double
  Shell::stiffness_about_normal(const unsigned int cell) const
  {
    double a2 = 0, b2 = 0; // squares of the sides
    for (unsigned int a = 0; a < table->n_nodes; ++a)
      {
        const auto g = mesh->tangents(mesh->cells[cell], a);
        a2 += g[0].squaredNorm() / table->n_nodes;
        b2 += g[1].squaredNorm() / table->n_nodes;
      }
    const Laminate &l = laminates[laminate_of(cell)];
    const double    p = degree, A66 = l.ABD(1, 1);
    return A66 * std::max(beta * l.thickness * l.thickness / 12,
                          tension_held * (2 * p + 1) / (2 * p * p * p * (p + 1)) / (1 / a2 + 1 / b2));
  }



  unsigned int
  Shell::material_of(const unsigned int cell)
  {
    const unsigned int laminate     = laminate_of(cell);
    const double       about_normal = stiffness_about_normal(cell);
    // cells alike but for round-off share it
    const auto [found, is_new] = material_numbers.insert(
      {{laminate, std::lround(1e9 * std::log(about_normal))}, static_cast<unsigned int>(materials.size())});
    if (is_new)
      {
        const MatrixN C = stiffness(laminates[laminate], about_normal);
        materials.push_back({C, relaxation_time * C});
      }
    return found->second;
  }



  Shell::MatrixN
  Shell::stiffness(const Laminate &laminate, const double about_normal) const
  {
    // columns of Γ_αi and K_αi
    const auto gamma = [](const int alpha, const int i) { return 6 * (alpha - 1) + i - 1; };
    const auto K     = [](const int alpha, const int i) { return 6 * (alpha - 1) + 3 + i - 1; };

    // ε₁₁, γ₁₂, ε₂₂, κ₁₁, 2κ₁₂, κ₂₂, γ₁₃, γ₂₃ of the twelve strains, as in doc/theory/shell.md; the other four
    // follow below
    Eigen::Matrix<double, 8, n> plate = Eigen::Matrix<double, 8, n>::Zero();
    plate(0, gamma(1, 1))             = 1;
    plate(1, gamma(1, 2)) = plate(1, gamma(2, 1)) = 1;
    plate(2, gamma(2, 2))                         = 1;
    plate(3, K(1, 2))                             = 1;
    plate(4, K(2, 2))                             = 1;
    plate(4, K(1, 1))                             = -1;
    plate(5, K(2, 1))                             = -1;
    plate(6, gamma(1, 3))                         = 1;
    plate(7, gamma(2, 3))                         = 1;
    // strains of the middle from those of the reference surface
    plate.topRows<3>() += offset * plate.middleRows<3>(3);

    Eigen::Matrix<double, 8, 8> C = Eigen::Matrix<double, 8, 8>::Zero();
    C.topLeftCorner<6, 6>()       = laminate.ABD;
    C.bottomRightCorner<2, 2>()   = laminate.shear;
    MatrixN      result           = plate.transpose() * C * plate;
    const double drilling         = beta * laminate.ABD(1, 1);
    const double of_curvature     = least_twist * laminate.ABD(1, 1) * laminate.thickness * laminate.thickness / 12;
    VectorN      skew_membrane = VectorN::Zero(), twist = VectorN::Zero();
    skew_membrane(gamma(1, 2)) = 1;
    skew_membrane(gamma(2, 1)) = -1;
    twist(K(1, 1)) = twist(K(2, 2)) = 1;
    result += drilling * skew_membrane * skew_membrane.transpose() + of_curvature * twist * twist.transpose();
    result(K(1, 3), K(1, 3)) += about_normal;
    result(K(2, 3), K(2, 3)) += about_normal;
    return result;
  }



  unsigned int
  Shell::laminate_of(const unsigned int cell) const
  {
    return laminate_of_cell.empty() ? 0 : laminate_of_cell[cell];
  }



  Matrix6
  Shell::inertia(const Laminate &l) const
  {
    const double moment = l.mass_moment + offset * l.mass,
                 rotary = l.rotary_inertia + 2 * offset * l.mass_moment + offset * offset * l.mass;
    const Matrix3 c     = skew(Vector3(0, 0, moment));
    Matrix6       M;
    // about the normal as well: rotations about it have no other inertia
    M << l.mass * Matrix3::Identity(), -c, c, rotary * Matrix3::Identity();
    return M;
  }
} // namespace samara
