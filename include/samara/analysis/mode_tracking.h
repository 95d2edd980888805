#ifndef samara_analysis_mode_tracking_h
#define samara_analysis_mode_tracking_h

#include <samara/solvers/eigen.h>

#include <functional>
#include <limits>

namespace samara
{
  /**
   * Numbers modes of a sweep by their shapes: pairs with the largest mass-weighted assurance criterion
   * |φᴴMψ|²/(φᴴMφ ψᴴMψ) above 0.3 belong to one branch.
   *
   * Shapes of equal frequencies are arbitrary in the space they span: there those nearest to the branches so far are
   * taken, so that branches go through a crossing.
   *
   * Of a pair the member with Im λ ≥ 0 is told. Where the other one takes its place, as Im λ passes zero in turning
   * axes (or the band π/T of multipliers), the shape is the conjugate of that before, and so a branch that finds no
   * shape like its own takes up a conjugate one, if both are nearer to the axis than other branches have moved.
   */
  class ModeTracking
  {
  public:
    /** The branch of each mode, from 1; turns the shapes of equal frequencies. Im λ of multipliers are principal values
     * in [0, @p band], π/T [rad/s]. */
    std::vector<unsigned int>
    follow(std::vector<Mode> &modes, const SparseMatrix &M, double band = std::numeric_limits<double>::infinity());

  private:
    std::vector<Mode> previous; ///< in the order of branches

    void            turn_equal_modes(std::vector<Mode> &modes, const SparseMatrix &M) const;
    Eigen::MatrixXd criteria(const std::vector<Mode> &modes, const SparseMatrix &M, bool conjugate) const;
    void            pair(const Eigen::MatrixXd                                 &mac,
                         const std::function<bool(unsigned int, unsigned int)> &may_be,
                         std::vector<unsigned int>                             &branches,
                         std::vector<bool>                                     &taken) const;
  };
} // namespace samara

#endif
