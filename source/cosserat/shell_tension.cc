// Whether cells of a shell are small enough for its tension: nodes have to resolve the length √(D/N), as in beams.

#include <samara/base/text.h>
#include <samara/cosserat/shell.h>

namespace samara
{
  namespace
  {
    /** Of N (h/p)²/D, as of beams; see doc/theory/shell.md. */
    constexpr double most_tension_of_cells = 5;



    /** Stiffness in bending of a laminate that is free to stretch, for κ₁₁ 2κ₁₂ κ₂₂ [N m]. */
    Matrix3
    free_bending(const Matrix6 &ABD)
    {
      const Matrix3 A = ABD.topLeftCorner<3, 3>(), B = ABD.topRightCorner<3, 3>(), D = ABD.bottomRightCorner<3, 3>();
      return D - B.transpose() * A.inverse() * B;
    }
  } // namespace



  std::string
  Shell::coarse_place(const State &state) const
  {
    std::vector<Matrix3> bending;
    for (const auto &laminate : laminates)
      bending.push_back(free_bending(laminate.ABD));
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
