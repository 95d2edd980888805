#include <samara/base/text.h>
#include <samara/cosserat/analysed_section.h>
#include <samara/recovery/largest_stress.h>

#include <algorithm>

namespace samara
{
  namespace
  {
    std::string
    point_at(const double x)
    {
      return "at " + number_to_text(x);
    }
  } // namespace



  void
  LargestStress::find_places(const State &state)
  {
    // one analysis for all places of the same section with the same curvature, but for round-off of the latter
    struct Known
    {
      std::shared_ptr<const AnalysedShape>   shape;
      Vector3                                curvature;
      std::shared_ptr<const SectionStresses> stresses;
    };
    std::vector<Known> known;
    const auto         stresses_there = [&](const StressedSection &section, const Vector3 &curvature) {
      const auto is_it = [&](const Known &other) {
        return other.shape == section.shape &&
               (other.curvature - curvature).norm() * beam.length() <= 1e-6 * (1 + curvature.norm() * beam.length());
      };
      if (const auto same = std::find_if(known.begin(), known.end(), is_it); same != known.end())
        return same->stresses;
      // of all materials: the largest index of some says nothing of the others
      for (const auto &material : section.shape->shape.materials)
        if (index_of(failure_indices(material.strengths, Vector6::Zero())) < 0)
          throw std::invalid_argument("section <" + section.name + "> of beam <" + beam.name + "> has a material, <" +
                                      material.name + ">, without strengths that the criterion <" + criterion +
                                      "> needs");
      known.push_back({section.shape, curvature, section_stresses_of(*section.shape, curvature)});
      return known.back().stresses;
    };
    std::string at_last_end;
    const auto  add = [&](const double x, const double inside) {
      const auto here   = beam.station(state, point_at(x), inside);
      const bool is_new = x >= inside || here.parts[0].section.name != at_last_end; // else it was an element's end
      at_last_end       = here.parts[0].section.name;
      if (!is_new)
        return;
      std::vector<BeamStresses::Part> parts;
      for (const StressPart &part : here.parts)
        parts.push_back({part, stresses_there(part.section, here.curvature)});
      places.push_back({x, inside, std::make_shared<BeamStresses>(parts)});
    };
    double start = 0;
    for (const auto &element : beam.mesh())
      {
        const double middle = 0.5 * (start + element.end);
        for (const double x : {start, middle, element.end})
          add(x, middle);
        start = element.end;
      }
  }



  double
  LargestStress::index_of(const FailureIndices &i) const
  {
    return criterion == "max stress" ? i.max_stress :
           criterion == "Tsai-Wu"    ? i.tsai_wu :
           criterion == "Hashin"     ? i.hashin :
           criterion == "von Mises"  ? i.von_mises :
                                       i.largest();
  }



  void
  LargestStress::look(const State &state)
  {
    if (places.empty())
      {
        find_places(state);
        first_time = state.time;
      }
    last_time = state.time;
    for (const auto &place : places)
      {
        const auto   there = beam.station(state, point_at(place.x), place.inside);
        const double index = index_of(place.stresses->extremes(there.linear_forces, there.helix).indices);
        if (!found || index > found->index)
          found = Found{state.time, place.x, index, there};
      }
  }
} // namespace samara
