// Free sides of the cells of a section on which corners of other cells lie.

#include <samara/section/section_mesh.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

namespace samara
{
  namespace
  {
    using Place      = dealii::Point<2>;
    using CellOfMesh = dealii::Triangulation<2>::active_cell_iterator;

    /** Along a direction that no mesh has. */
    double
    along_no_side(const Place &x)
    {
      return x[0] + 0.3719 * x[1];
    }

    /** Sides of a single cell: each vertex with those at the other ends. */
    using FreeSides = std::map<unsigned int, std::vector<unsigned int>>;

    /** Whether other free sides lead from one end of a side to the other one, over corners that lie on it. */
    bool
    is_bridged(const FreeSides &sides, const unsigned int from, const unsigned int to, std::set<unsigned int> on_it)
    {
      std::vector<unsigned int> reached(1, from);
      while (!reached.empty())
        {
          const unsigned int at = reached.back();
          reached.pop_back();
          for (const unsigned int next : sides.at(at))
            {
              if (next == to && at != from)
                return true;
              if (on_it.erase(next) > 0)
                reached.push_back(next);
            }
        }
      return false;
    }
  } // namespace



  bool
  SectionMesh::lies_on(const CellOfMesh &cell, const unsigned int face, const Place &place, double &share) const
  {
    constexpr double on = 1e-6; // of the side
    const auto       at = [&](const double t) {
      return mapping.transform_unit_to_real_cell(cell, face < 2 ? Place(face % 2, t) : Place(t, face % 2));
    };
    const double length = cell->face(face)->vertex(0).distance(cell->face(face)->vertex(1));
    // the nearest place of a side that is curved: a parabola's tangent by its chord is exact
    constexpr unsigned int steps = 6;
    constexpr double       chord = 0.1;
    for (unsigned int i = 0; i < steps; ++i)
      {
        const dealii::Tensor<1, 2> tangent = (at(share + chord) - at(share - chord)) / (2 * chord);
        share += std::max(-0.5, std::min(0.5, (place - at(share)) * tangent / tangent.norm_square()));
        if (share < -0.5 || share > 1.5)
          return false;
      }
    return share > on && share < 1 - on && place.distance(at(share)) < on * length;
  }



  void
  SectionMesh::check_sides(const bool has_numbers)
  {
    FreeSides                                    sides;
    std::vector<std::pair<double, unsigned int>> corners; // along the direction
    std::map<unsigned int, Place>                places;
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->at_boundary(f))
          for (const unsigned int v : {0u, 1u})
            {
              const unsigned int number = cell->face(f)->vertex_index(v);
              sides[number].push_back(cell->face(f)->vertex_index(1 - v));
              places[number] = cell->face(f)->vertex(v);
            }
    for (const auto &[number, place] : places)
      corners.emplace_back(along_no_side(place), number);
    std::sort(corners.begin(), corners.end());

    std::set<unsigned int> touching;
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->at_boundary(f))
          {
            const unsigned int         from = cell->face(f)->vertex_index(0), to = cell->face(f)->vertex_index(1);
            const Place                a = places.at(from), b = places.at(to);
            const dealii::Tensor<1, 2> side = b - a;
            // as far beside its ends as curved sides bulge
            const double           bulge = degree > 1 ? 0.5 * side.norm() : 0;
            std::set<unsigned int> on_it;
            for (auto x = std::lower_bound(corners.begin(),
                                           corners.end(),
                                           std::make_pair(std::min(along_no_side(a), along_no_side(b)) - bulge, 0u));
                 x != corners.end() && x->first <= std::max(along_no_side(a), along_no_side(b)) + bulge;
                 ++x)
              {
                const dealii::Tensor<1, 2> way   = places.at(x->second) - a;
                double                     share = way * side / side.norm_square();
                if (x->second != from && x->second != to && (way - share * side).norm() <= bulge + 1e-5 * side.norm() &&
                    lies_on(cell, f, places.at(x->second), share))
                  on_it.insert(x->second);
              }
            if (on_it.empty())
              continue;
            if (!has_numbers || is_bridged(sides, from, to, on_it))
              throw std::invalid_argument(
                "the corner of another cell lies on a side of " + name_of(cells[cell->active_cell_index()]) +
                ", between its ends: cells must meet with whole sides, or they do not hang together");
            touching.insert(on_it.begin(), on_it.end());
          }
    n_touching = touching.size();
  }
} // namespace samara
