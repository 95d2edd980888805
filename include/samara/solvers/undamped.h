#ifndef samara_solvers_undamped_h
#define samara_solvers_undamped_h

#include <samara/solvers/shift_invert.h>

#include <Eigen/Dense>

#include <optional>
#include <random>
#include <vector>

namespace samara
{
  /**
   * Eigenvalues θ = 1/(ω² + σ²) of largest size of (K + σ²M)⁻¹M for motions K φ = ω² M φ with constraints, by a block
   * Lanczos iteration whose basis is M-orthonormal, each vector against all others (Golub & Van Loan, section 10.3). It
   * takes solutions that are not refined: see undamped_modes().
   */
  class BlockLanczos
  {
  public:
    BlockLanczos(const ShiftInvert &op, unsigned int block);

    /** Let the basis have at least @p size vectors; false if no more of them have mass. */
    bool expand(unsigned int size);

    /** Add a random direction to the next block: for eigenvalues that are there more often than a block has vectors. */
    bool widen();

    /** Ritz values, largest first, and the M-norms of their residuals, of vectors of unit norm. */
    std::vector<double> values, residuals;

    /** The first @p n Ritz vectors. */
    Eigen::MatrixXd vectors(unsigned int n) const;

    unsigned int
    size() const
    {
      return m;
    }

  private:
    const ShiftInvert &op;
    const unsigned int n; ///< unknowns ζ
    unsigned int       block, m = 0;
    Eigen::MatrixXd    V, MV, H, E; ///< V: the basis and, behind it, the next block; OP V = V H + (next block) E
    Eigen::MatrixXd    small_vectors;
    std::mt19937       generator;

    Eigen::MatrixXd apply(const Eigen::Ref<const Eigen::MatrixXd> &Mx) const;
    bool            add_block();
    /** Make @p x, orthogonal to the basis, a column of the next block; @return its norm before, 0 if nothing was left.
     */
    double normalize(unsigned int column, Eigen::VectorXd x, double before, Eigen::Ref<Eigen::VectorXd> coefficients);
    bool   add_random(unsigned int column);
    void   reserve(unsigned int columns);
    void   solve_small();
  };



  /** A mode of an undamped motion. */
  struct UndampedMode
  {
    double                 square; ///< ω² [1/s²], of free motions round-off
    Eigen::VectorXd        zeta;
    ShiftInvert::Judgement judgement;
  };

  /**
   * The @p wanted modes of smallest ω² of an undamped motion, as the factors of @p op are symmetric; a few more where
   * the last is not alone. Half the unknowns and half the eigenvalues of the first-order form.
   *
   * The basis of the Lanczos iteration comes of solutions with a formed BᵀCB. Then all vectors wanted pass through the
   * refined solution with stresses as unknowns, V' = op(V), and Rayleigh's quotients V'ᵀM V and V'ᵀM V' find the modes
   * in it: errors of V come in squared. Nothing is missed: the pivots at a frequency behind the last one count all
   * below it.
   *
   * @return nothing where a motion grows, an error is estimated larger than 1e-9, or modes are missed all the same:
   * then the first-order form has to do.
   */
  std::optional<std::vector<UndampedMode>> undamped_modes(const ShiftInvert &op, unsigned int wanted);
} // namespace samara

#endif
