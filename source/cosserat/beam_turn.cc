// Whether the elements of a beam are short enough for how they are bent.

#include <samara/base/text.h>
#include <samara/cosserat/beam.h>

#include <deal.II/base/polynomial.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Of the angles of an element of degree 1, 2, ..., for errors of about one per cent; see doc/theory/element.md. */
    constexpr std::array<double, highest_beam_degree> most_between_ends = {{0.25, 0.9, 1.6, 2.2, 2.7, 3.0}};
    constexpr double                                  most_unresolved   = 0.3;

    /** Of N (h/p)²/EI, for errors of about two per cent in frequencies of bending; see doc/theory/element.md. */
    constexpr double most_tension = 5;



    /** N d²/EI of the softest bending of a section with the strains @p e, between nodes at the distance @p d. */
    double
    tension_ratio(const Matrix6 &C, const Vector6 &e, const double d)
    {
      const double mean = 0.5 * (C(4, 4) + C(5, 5)), range = std::hypot(0.5 * (C(4, 4) - C(5, 5)), C(4, 5));
      return C.row(0).dot(e) * d * d / (mean - range);
    }
  } // namespace



  Beam::Turn
  Beam::turn(const unsigned int i, const State &state, const double *e) const
  {
    const ElementTable<1>              &t = *elements[i].table;
    const double                        h = cells[i].end - cells[i].start;
    const dealii::Polynomials::Legendre L(t.n_points - 1);
    Vector3                             highest = Vector3::Zero();
    for (unsigned int g = 0; g < t.n_points; ++g)
      highest +=
        t.weights(g) * L.value(t.points[g][0]) * Eigen::Map<const Vector3>(e + 6 * (elements[i].first_point + g) + 3);
    // the first two nodes of an element are its ends
    const Matrix3 R =
      elements[i].frames[0].triad(state.q.data()).transpose() * elements[i].frames[1].triad(state.q.data());
    return {std::acos(std::clamp(0.5 * (R.trace() - 1), -1., 1.)), t.n_points > 1 ? h * highest.norm() : 0.};
  }



  std::string
  Beam::range_of(const Cell &cell) const
  {
    const auto place = [&](const double s) { return number_to_text(std::round(1e4 * s / curve->length()) / 1e4); };
    return "beam <" + name + "> from " + place(cell.start) + " to " + place(cell.end);
  }



  std::string
  Beam::tensioned_place(const double *e) const
  {
    for (unsigned int i = 0; i < n_elements(); ++i)
      for (unsigned int k = 0; k < elements[i].table->n_points; ++k)
        {
          const unsigned int g        = elements[i].first_point + k;
          const double       distance = (cells[i].end - cells[i].start) / cells[i].degree,
                       ratio          = tension_ratio(materials[integration_points()[g].material].stiffness,
                                             Eigen::Map<const Vector6>(e + 6 * g),
                                             distance);
          if (ratio > most_tension)
            return range_of(cells[i]) +
                   ": for its tension N an element is long, N (h/p)^2/EI = " + number_to_text("%.3g", ratio) +
                   "; it is too soft in bending, and may seem unstable";
        }
    return "";
  }



  std::string
  Beam::coarse_place(const State &state) const
  {
    std::vector<double> e(n_strains());
    strains_at(state.point(), e.data());
    double       largest = 1;
    unsigned int worst   = 0;
    for (unsigned int i = 0; i < n_elements(); ++i)
      {
        const Turn   angles = turn(i, state, e.data());
        const double ratio =
          std::max(angles.between_ends / most_between_ends[cells[i].degree - 1], angles.unresolved / most_unresolved);
        if (ratio > largest)
          {
            largest = ratio;
            worst   = i;
          }
      }
    if (largest == 1)
      return tensioned_place(e.data());
    const auto  degrees = [](const double angle) { return std::to_string(std::lround(angle * 180 / M_PI)) + " deg"; };
    const Turn  angles  = turn(worst, state, e.data());
    const Cell &cell    = cells[worst];
    return range_of(cell) + ": an element of degree " + std::to_string(cell.degree) + " turns by " +
           degrees(angles.between_ends) + " between its ends, " + degrees(angles.unresolved) +
           " of it as the highest polynomial it has; that is more than it represents well";
  }
} // namespace samara
