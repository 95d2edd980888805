// Whether cells of a shell are small enough: for its tension, where nodes have to resolve the length √(D/N) as in
// beams, and for how sharply it is folded.

#include <samara/base/text.h>
#include <samara/cosserat/shell.h>

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace samara
{
  namespace
  {
    /** Of N (h/p)²/D, as of beams; see doc/theory/shell.md. */
    constexpr double most_tension_of_cells = 5;

    /**
     * Of fold() [rad], as of beams; and where stability limits may be of the mesh: those of the structure that were
     * looked at are at 0.09 at most, those of the mesh at 0.17 and more. See doc/theory/shell.md.
     */
    constexpr double most_unresolved_fold = 0.3, most_unresolved_at_limits = 0.12;
  } // namespace



  double
  Shell::fold(const unsigned int cell, const State &state) const
  {
    const dealii::Polynomials::Legendre L(degree - 1);
    const unsigned int                  n_along = degree + 1;
    const dealii::QGauss<1>             gauss(n_along);
    VectorN                             e[most_nodes];
    element_strains(cell, state.q.data(), e[0].data());
    double largest = 0;
    for (unsigned int side = 0; side < 2; ++side)
      for (unsigned int line = 0; line < n_along; ++line)
        {
          // curvatures by the unit coordinate, which are of degree p − 1 along it; those about the normal do not fold
          Eigen::Vector2d highest = Eigen::Vector2d::Zero();
          for (unsigned int k = 0; k < n_along; ++k)
            {
              const unsigned int g        = side == 0 ? k + n_along * line : line + n_along * k;
              const LocalMap     tangents = integration_points()[elements[cell].first_point + g].T.inverse();
              highest += gauss.weight(k) * L.value(gauss.point(k)[0]) *
                         (tangents(side, 0) * e[g].segment<2>(3) + tangents(side, 1) * e[g].segment<2>(9));
            }
          largest = std::max(largest, highest.norm());
        }
    return largest;
  }



  std::string
  Shell::folded_place(const State &state, const double most) const
  {
    double       largest = 0;
    unsigned int worst   = 0;
    for (unsigned int i = 0; i < n_elements(); ++i)
      if (const double angle = fold(i, state); angle > largest)
        {
          largest = angle;
          worst   = i;
        }
    if (largest <= most)
      return "";
    return "shell <" + name + ">, " + mesh->name_of(worst) + ": it is bent by " +
           std::to_string(std::lround(largest * 180 / M_PI)) +
           " deg as the highest polynomial it has, more than it represents well. A fold there takes cells " +
           number_to_text("%.2g", largest / most_unresolved_at_limits) + " times as small";
  }



  std::string
  Shell::why_no_limit(const State &state) const
  {
    const std::string place = folded_place(state, most_unresolved_at_limits);
    return place.empty() ? "" : place + "; it catches at the ends of larger ones";
  }



  std::string
  Shell::coarse_place(const State &state) const
  {
    if (const std::string place = folded_place(state, most_unresolved_fold); !place.empty())
      return place;
    std::vector<Matrix3> bending;
    for (const auto &laminate : laminates)
      bending.push_back(laminate.free_bending());
    double       worst = most_tension_of_cells;
    unsigned int cell  = 0;
    for (unsigned int i = 0; i < n_elements(); ++i)
      for (unsigned int g = 0; g < table->n_points; ++g)
        {
          const unsigned int              index = elements[i].first_point + g;
          const auto                     &point = integration_points()[index];
          const Eigen::Map<const VectorN> stress(&state.stress[first_strain + n * index]);
          const LocalMap                  tangents = point.T.inverse(); // rows: along the sides, in local axes
          for (unsigned int side = 0; side < 2; ++side)
            {
              const double length = tangents.row(side).norm(), c = tangents(side, 0) / length,
                           s        = tangents(side, 1) / length;
              const double  tension = c * c * stress(0) + s * s * stress(7) + c * s * (stress(1) + stress(6));
              const Vector3 curved(c * c, 2 * c * s, s * s);
              const double  ratio =
                tension * length * length / (degree * degree) / curved.dot(bending[laminate_of(i)] * curved);
              if (ratio > worst)
                {
                  worst = ratio;
                  cell  = i;
                }
            }
        }
    if (worst <= most_tension_of_cells)
      return "";
    return "shell <" + name + ">, " + mesh->name_of(cell) +
           ": for its tension N a cell is long, N (h/p)^2/D = " + number_to_text("%.3g", worst) +
           "; it is too soft in bending, and may seem unstable";
  }
} // namespace samara
