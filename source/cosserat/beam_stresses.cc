#include <samara/base/text.h>
#include <samara/cosserat/beam_stresses.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  std::shared_ptr<const SectionStresses>
  section_stresses_of(const AnalysedShape &shape, const Vector3 &curvature)
  {
    const auto analysis = shape.analyse(curvature);
    return std::make_shared<SectionStresses>(analysis->section, analysis->mesh, analysis->shape.materials);
  }



  SectionStresses::Extremes
  BeamStresses::extremes(const Vector6 &forces, const double helix) const
  {
    std::vector<std::pair<double, Extremes>> of_parts;
    for (const Part &part : parts)
      of_parts.emplace_back(part.of.section.weight, part.stresses->extremes(part.of.forces * forces, helix));
    return of_parts.size() == 1 ? of_parts[0].second : mean_of(of_parts);
  }



  std::string
  BeamStresses::disagreement(const Vector6 &forces, const double helix) const
  {
    constexpr double much = 0.1;
    if (parts.size() < 2)
      return "";
    const Extremes a = parts[0].stresses->extremes(parts[0].of.forces * forces, helix),
                   b = parts[1].stresses->extremes(parts[1].of.forces * forces, helix);
    const auto apart = [](const double x, const double y) {
      const double larger = std::max(x, y);
      return larger > 0 ? std::abs(x - y) / larger : 0.;
    };
    const double share =
      std::max(apart(a.von_mises_stress, b.von_mises_stress), apart(a.indices.largest(), b.indices.largest()));
    if (!(share > much))
      return "";
    const auto number = [](const double x) { return number_to_text("%.4g", x) + " Pa"; };
    return "its stations <" + parts[0].of.section.name + "> and <" + parts[1].of.section.name +
           "> are not of one kind, and their stresses under the strains there differ by " +
           number_to_text("%.0f", 100 * share) + " %: von Mises " + number(a.von_mises_stress) + " and " +
           number(b.von_mises_stress) +
           ". The mean by distance is told; give a section of the place itself as a station";
  }
} // namespace samara
