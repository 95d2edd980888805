#ifndef samara_solvers_shift_invert_h
#define samara_solvers_shift_invert_h

#include <samara/base/tell_progress.h>
#include <samara/solvers/mixed_matrix.h>

#include <complex>
#include <limits>

namespace samara
{
  /**
   * (A − σB)⁻¹ B of the first-order form of a motion, with the states z = (ζ, p), p = M v divided by the diagonal of M
   * and a frequency ω₀ of the motion, v = ζ̇, in the motion's units; ν = 1/(λ − σ) are the eigenvalues. One application
   * solves
   *
   *     (S + σΓ + σ²M) ζ' + Bᵀq + Gᵀμ = −M v − (Γ + σM) ζ      v' = ζ + σ ζ'
   *     B ζ' + F w C_d Ḃ ζ' − F q     = −F w C_d B ζ           G ζ' = 0
   *
   * Velocities count by their momenta only: what has no mass would be a nilpotent part as large as the largest ν.
   */
  class ShiftInvert
  {
  public:
    /** @p listener hears what is done with it: tell(). */
    explicit ShiftInvert(const LinearMotion &motion, TellProgress listener = {});

    /** @throws SingularMatrix */
    void set(double shift, double time_unit);

    double
    shift() const
    {
      return matrix.shift();
    }
    unsigned int
    size() const
    {
      return 2 * n;
    }

    void apply(const double *z, double *result) const;

    /** Whether K φ = ω² M φ with symmetric K and M is all of the motion, and the factors are of a kind to count ω². */
    bool is_undamped() const;

    /** How far who works with it is. */
    void tell(const std::string &doing) const;

    const MixedMatrix &
    mixed() const
    {
      return matrix;
    }

    /** M ζ */
    Eigen::VectorXd mass_times(const Eigen::VectorXd &zeta) const;

    /** The second half of a state from velocities [m/s, rad/s]. */
    void momenta(const double *v, double *p) const;

    /**
     * The relative error of λ, and what the mode's motion does: estimate |δλ| [1/s], the scale φᴴMφ, the sum of |φ r|
     * that stands for the error of λ² φᴴMφ, and of |q Bφ|.
     */
    struct Judgement
    {
      double error, mass, lost, work;
    };
    /** @param gap the distance to the nearest other eigenvalue: near others the left vector must be known well */
    Judgement judge(const std::complex<double> &lambda,
                    const Eigen::VectorXcd     &zeta,
                    double                      gap = std::numeric_limits<double>::infinity()) const;

    /** Whether left vectors are the conjugate ones of each mode: there is neither dissipation nor a follower force. */
    bool
    has_conjugate_left_vectors() const
    {
      return is_symmetric || is_conservative;
    }

    /** The left vector of a mode, of as many numbers as @p zeta; the conjugate one if it is not found. */
    Eigen::VectorXcd left_vector_of(const std::complex<double> &lambda, const Eigen::VectorXcd &zeta) const;

    /** Displacements and rotations from the first half of a state. */
    Eigen::VectorXcd zeta(const Eigen::VectorXcd &z) const;

  private:
    /** The nonzero entries of a matrix, for products: mass and gyroscopic terms fill little of the system's pattern. */
    struct Entries
    {
      std::vector<int>    rows, columns;
      std::vector<double> values;

      Entries(const SparseMatrix &A, unsigned int n);

      template <typename Number>
      void
      add_product(const Number factor, const Number *x, Number *y) const
      {
        for (unsigned int k = 0; k < values.size(); ++k)
          y[rows[k]] += factor * values[k] * x[columns[k]];
      }

      template <typename Function>
      void
      for_all(const Function &f) const
      {
        for (unsigned int k = 0; k < values.size(); ++k)
          f(rows[k], columns[k], values[k]);
      }
    };

    const LinearMotion         &motion;
    const TellProgress          listener;
    const unsigned int          n;
    double                      time_unit = 1; ///< ω₀ [1/s]
    MixedMatrix                 matrix;
    Entries                     M, gyroscopic;
    std::vector<double>         mass;            ///< of each row: the largest entry of M, in the motion's units
    bool                        is_symmetric;    ///< M, Γ, S: x is a left vector of each mode
    bool                        has_no_rates;    ///< nothing but M, S, B and C, all symmetric
    bool                        is_conservative; ///< Γ antisymmetric, M, S symmetric: x̄ is one where λ is imaginary
    mutable std::vector<double> b, zeta_now;

    Eigen::VectorXcd right_side(const std::complex<double> &lambda, const Eigen::VectorXcd &zeta) const;
    std::complex<double>
    slope(const std::complex<double> &lambda, const Eigen::VectorXcd &left, const Eigen::VectorXcd &zeta) const;

    /** Of (ζ, μ, q): x̄ or x, whichever is nearer to a left vector, or a left vector if neither is near enough. */
    Eigen::VectorXcd left_vector(const std::complex<double> &lambda, const Eigen::VectorXcd &x, double gap) const;
    /** (ζ, μ, q) of a mode: one more application gives the multipliers and stresses that belong to it. */
    Eigen::VectorXcd with_multipliers(const Eigen::VectorXcd &f, const Eigen::VectorXcd &zeta) const;
  };
} // namespace samara

#endif
