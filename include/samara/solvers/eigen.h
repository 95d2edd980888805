#ifndef samara_solvers_eigen_h
#define samara_solvers_eigen_h

#include <samara/base/tell_progress.h>
#include <samara/solvers/mixed_matrix.h>

#include <complex>
#include <optional>
#include <vector>

namespace samara
{
  /** A solution ζ(t) = Re[shape exp(λ t)] of the linearised motion. */
  struct Mode
  {
    std::complex<double> lambda;    ///< exactly zero for a free motion
    Eigen::VectorXcd     shape;     ///< increments of nodal twists and joint coordinates, unit 2-norm
    double               error = 0; ///< estimate of |δλ|/|λ|, see find_modes()
    Eigen::VectorXcd     left  = {}; ///< y of yᵀ(λ²M + λΓ + K) = 0, any length; empty: not found, see find_left_vectors()

    /** |λ| [rad/s] for oscillating modes; for the others, |λ| too: the rate of growth or decay. */
    double
    frequency() const
    {
      return std::abs(lambda);
    }
    double
    damping_ratio() const
    {
      return std::abs(lambda) > 0 ? -lambda.real() / std::abs(lambda) : 0.;
    }
    bool
    is_free() const
    {
      return lambda == 0.;
    }
  };

  struct Modes
  {
    std::vector<Mode> found;          ///< sorted by |λ|
    double            shift  = 0;     ///< [1/s]
    bool              is_all = false; ///< fewer than wanted: nothing else moves mass
  };



  /**
   * The @p n_modes modes of a motion nearest to the real @p shift [1/s]; without one, those of lowest frequency.
   *
   * By shift-invert Arnoldi on the first-order form with one factorisation of the mixed matrix; the infinite
   * eigenvalues of constraints fall to zero there. Small systems take the dense matrix of the same operator. The unit
   * of time follows from the lowest frequency, the shift is 0.3 of it if none is given.
   *
   * The error of a mode is first order in the residual of the mixed equations, |xᵀr| ≤ Σ|xᵢrᵢ|, by the left vector x̄ or
   * x of motions without and with dissipation; no factor and no product BᵀCB enters it. What is zero to round-off, and
   * far below all frequencies, is a free motion, given once each with λ = 0. Of a complex pair only the one with
   * positive imaginary part is returned.
   *
   * @p tell hears how far the search is.
   *
   * @throws SingularMatrix if the shift is an eigenvalue, NotConverged if the Arnoldi iteration does not find them.
   */
  Modes find_modes(const LinearMotion   &motion,
                   unsigned int          n_modes,
                   std::optional<double> shift,
                   const TellProgress   &tell = {});

  /**
   * Sets the left vectors of @p modes where they are not the conjugate shapes, as they are without dissipation and
   * follower forces. Equal modes get those nearest to their conjugate shapes.
   */
  void find_left_vectors(const LinearMotion &motion, std::vector<Mode> &modes);
} // namespace samara

#endif
