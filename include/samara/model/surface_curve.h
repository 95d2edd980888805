#ifndef samara_model_surface_curve_h
#define samara_model_surface_curve_h

#include <samara/model/model.h>

#include <string>
#include <vector>

namespace samara
{
  /**
   * A piece of a line along which something slides. Without shares it goes through its frames, by Lagrange's
   * polynomials through their abscissae. With shares it goes through points that are none of its frames: at the
   * abscissa s_k the frame a has the share w_ak, and the line is Σ_k L_k(S) Σ_a w_ak x_a.
   */
  struct LinePiece : public Span
  {
    Eigen::MatrixXd shares; ///< (frame, point); empty if the frames are the points

    LinePiece() = default;
    explicit LinePiece(const Span &span)
      : Span(span)
    {}
  };



  /** A body with a surface on which there are curves. */
  class HasCurves
  {
  public:
    virtual ~HasCurves() = default;

    /**
     * The pieces of a curve, one behind the other with abscissae that run on: one that has a name, "line u 0.3", or
     * "from a to b", straight in the coordinates of a patch.
     * @throws std::invalid_argument with what is wrong.
     */
    virtual std::vector<LinePiece> curve(const std::string &path) const = 0;
  };
} // namespace samara

#endif
