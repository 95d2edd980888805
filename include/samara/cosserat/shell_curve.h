#ifndef samara_cosserat_shell_curve_h
#define samara_cosserat_shell_curve_h

#include <samara/cosserat/shell_mesh.h>

#include <string>
#include <vector>

namespace samara
{
  /**
   * A curve on a patch of a shell as users write it, "rail at 0.1 + 0.8*s, 0.5 + 0.2*sin(pi*s)" or, on another patch
   * than the first, "rail of patch 2 at ...": u and v as functions of s from 0 to 1.
   */
  struct ShellCurve
  {
    std::string  name;
    unsigned int patch = 0;
    Expression   u, v;
  };

  template <>
  struct Value<ShellCurve>
  {
    static constexpr char separator = ';';
    static constexpr bool has_unit  = false;

    static ShellCurve     read(const std::string &text, const std::string &unit, const Quantities &quantities);
    static std::string    write(const ShellCurve &value);
    static PatternPointer pattern();
  };



  /** What a curve has of one cell. */
  struct CurveInCell
  {
    unsigned int        cell;
    std::vector<double> abscissae; ///< of points on it, its ends among them [m]
    Eigen::MatrixXd     shares;    ///< of the nodes of the cell in them, (node, point)
  };

  /**
   * Take a curve apart where it goes over from one cell to another. In each cell it becomes a polynomial of its arc
   * length: points at Chebyshev's places, so many that shape functions along the curve are met to 1e-9. Straight lines
   * on flat patches of parallelograms are met exactly.
   * @throws std::invalid_argument where the curve leaves the patch, stands still, has a corner, or bends so much within
   * a cell that thirty-odd points do not follow it.
   */
  std::vector<CurveInCell> pieces_of(const ShellCurve &curve, const ShellMesh &mesh, const ElementTable<2> &table);
} // namespace samara

#endif
