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
    std::vector<double> abscissae(1, 0.);
    for (const auto &element : beam.mesh())
      {
        const double start = abscissae.back();
        abscissae.push_back(0.5 * (start + element.end));
        abscissae.push_back(element.end);
      }

    // one analysis for all places of the same section with the same curvature, but for round-off of the latter
    std::vector<Beam::Station> known;
    for (const double x : abscissae)
      {
        const auto here    = beam.station(state, point_at(x));
        const auto is_here = [&](const auto &other) {
          return other.section == here.section && (other.curvature - here.curvature).norm() * beam.length() <=
                                                    1e-6 * (1 + here.curvature.norm() * beam.length());
        };
        const auto same = std::find_if(known.begin(), known.end(), is_here);
        if (same == known.end())
          {
            const auto analysis = here.section->analyse(here.curvature);
            places.push_back(
              {x, std::make_shared<SectionStresses>(analysis->section, analysis->mesh, analysis->shape.materials)});
            // of all materials: the largest index of some says nothing of the others
            for (const auto &material : analysis->shape.materials)
              if (index_of(failure_indices(material.strengths, Vector6::Zero())) < 0)
                throw std::invalid_argument("section <" + here.section->name + "> of beam <" + beam.name +
                                            "> has a material, <" + material.name +
                                            ">, without strengths that the criterion <" + criterion + "> needs");
          }
        else
          places.push_back({x, places[same - known.begin()].stresses});
        known.push_back(here);
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
        const auto   there = beam.station(state, point_at(place.x));
        const double index = index_of(place.stresses->extremes(there.linear_forces, there.helix).indices);
        if (!found || index > found->index)
          found = Found{state.time, place.x, index, there};
      }
  }
} // namespace samara
