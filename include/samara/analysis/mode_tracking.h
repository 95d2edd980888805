#ifndef samara_analysis_mode_tracking_h
#define samara_analysis_mode_tracking_h

#include <samara/solvers/eigen.h>

namespace samara
{
  /**
   * Numbers modes of a sweep by their shapes: pairs with the largest mass-weighted assurance criterion
   * |φᴴMψ|²/(φᴴMφ ψᴴMψ) above 0.3 belong to one branch.
   *
   * Shapes of equal frequencies are arbitrary in the space they span: there those nearest to the branches so far are
   * taken, so that branches go through a crossing.
   */
  class ModeTracking
  {
  public:
    /** The branch of each mode, from 1; turns the shapes of equal frequencies. */
    std::vector<unsigned int> follow(std::vector<Mode> &modes, const SparseMatrix &M);

  private:
    std::vector<Mode> previous; ///< in the order of branches

    void turn_equal_modes(std::vector<Mode> &modes, const SparseMatrix &M) const;
  };
} // namespace samara

#endif
