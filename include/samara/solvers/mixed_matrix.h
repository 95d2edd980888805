#ifndef samara_solvers_mixed_matrix_h
#define samara_solvers_mixed_matrix_h

#include <samara/model/strain_rows.h>
#include <samara/solvers/eliminated_points.h>
#include <samara/solvers/linear.h>

#include <Eigen/SparseCore>

#include <functional>
#include <optional>

namespace samara
{
  /**
   * Small motions about a state, with the stress resultants q = w σ of all points as unknowns of their own:
   *
   *     M ζ̈ + Γ ζ̇ + S ζ + Bᵀ q + Gᵀ μ = 0,    q = w (C B ζ + C_d (B ζ̇ + Ḃ ζ)),    G ζ = 0
   *
   * M, Γ and S have the pattern of the system, G and Gᵀ stand in S; the first n_kinematic unknowns are ζ, then follow
   * the μ. S is the geometric stiffness, Γ what is gyroscopic: neither holds a material.
   */
  struct LinearMotion
  {
    SparseMatrix        M, gyroscopic, S;
    StrainRows          strains;
    SparseRows          B_dot; ///< Ḃ, where axes stand still and materials are viscous; otherwise empty
    unsigned int        n_kinematic;
    std::vector<double> units; ///< of ζ: the model's size for displacements [m], 1 for rotations
    double              acceleration = 0; ///< the largest that reactions alone would give, in these units [1/s²]
  };



  /**
   * The matrix of such a motion at the shift σ [1/s], factorised:
   *
   *     [ S + σΓ + σ²M   Bᵀ   Gᵀ ] [ζ]   [f]
   *     [ B              −F    0 ] [q] = [e]        F = (w (C + σ C_d))⁻¹
   *     [ G               0    0 ] [μ]   [0]
   *
   * No product BᵀCB is formed: in it soft strains lose what stiff ones round, ε GA L²/EI n² of the lowest modes.
   * Stresses without stiffness are left out. Each solution is refined once with the residual of these rows.
   *
   * Points of more than six strains, those of shells, of which there are many with many unknowns each, are eliminated
   * before the factorisation, BᵀF⁻¹B; what rounds there the refinement makes good as long as bending is not 1e12 times
   * softer than the membrane over an element.
   */
  class MixedMatrix
  {
  public:
    explicit MixedMatrix(const LinearMotion &motion);

    /** @throws SingularMatrix whose unknown is one of ζ, μ, or -1 */
    void factorize(double shift);

    /** Unknowns ζ, μ, and then stresses in coordinates of the matrix. */
    unsigned int
    size() const
    {
      return n + n_stresses;
    }

    /** Of these, ζ and μ. */
    unsigned int
    n_condensed() const
    {
      return n;
    }

    /** For a state (ζ, v): minus F w C_d B ζ is the right-hand side of the strains, behind the first n of @p b. */
    void add_viscous_part(const double *zeta, double *b) const;

    /** Add F q to the right-hand side of the strains: those that go with the stress resultants @p q. */
    void add_strains_of(const double *q, double *b) const;

    /** Give f every entry (row, column, value) of the matrix, and of F w C_d B, what add_viscous_part() subtracts. */
    void for_entries(const std::function<void(int, int, double)> &f) const;
    void for_viscous_entries(const std::function<void(int, int, double)> &f) const;

    /** Replace right-hand sides by solutions, one behind the other; size() numbers each. */
    void solve(double *b, unsigned int n_columns = 1) const;

    /** The same without refinement, where strains have no right-hand side and stresses are not asked for: (ζ, μ) only.
     */
    void solve_condensed(double *b, unsigned int n_columns) const;

    /** A x, the left-hand side of the equations. */
    void multiply(const double *x, double *y, unsigned int n_columns = 1) const;

    /** Whether factors are symmetric and count negative eigenvalues, and points are eliminated: large shells. */
    bool has_inertia() const;

    /**
     * Of motions without damping and gyroscopic terms: the number of ω² between −σ² and @p square, by the signs of the
     * pivots at both (Sylvester), with factors that are made for it; nothing where it cannot be told.
     */
    std::optional<unsigned int> n_squares_below(double square) const;

    /** q of all strains, in the order of the rows of B, from a solution. */
    void stresses(const double *solution, double *q) const;

    /** The sum of |s F s| over all strains. */
    double work(const double *solution) const;

    double
    shift() const
    {
      return sigma;
    }

    mutable unsigned int n_solutions = 0; ///< for reports

  private:
    /** Coordinates s of a point's stresses, q = T s, those without stiffness left out, and their flexibility. */
    struct Point
    {
      unsigned int    first;      ///< among the stresses of the matrix
      Eigen::MatrixXd T, FT;      ///< FT: F T⁺, strains from q
      Eigen::MatrixXd F, viscous; ///< viscous: F T⁺ w C_d
    };

    const LinearMotion           &motion;
    unsigned int                  n; ///< of ζ and μ
    unsigned int                  n_stresses = 0;
    double                        sigma      = 0;
    std::vector<Point>            points;
    SparseRows                    rows; ///< Tᵀ B of the points that are not eliminated
    EliminatedPoints              eliminated;
    std::vector<int>              place;      ///< of each unknown among those that are left; negative: eliminated
    unsigned int                  n_left = 0; ///< after the elimination
    std::unique_ptr<SparseMatrix> A;          ///< of what is left, as assembled, without the points that are eliminated
    std::unique_ptr<SparseMatrix> condensed;  ///< with them; null if there are none
    std::vector<double>           scale;
    std::unique_ptr<LinearSolver> solver;
    mutable std::vector<double>   solution, left, product;

    void  reduce_points();
    Point reduced(const StrainRows::Point &p) const;
    void  add_rows(const StrainRows::Point &p, const Point &reduced);
    void  assemble();
    void  assemble_rows(std::vector<Eigen::Triplet<double>> &entries) const;

    bool is_eliminated(const StrainRows::Point &p, const Point &reduced) const;
    void add_shifted(const Pattern &pattern, std::vector<double> &values, double of_mass) const;
    void factorize_scaled(LinearSolver &by, const SparseMatrix &matrix) const;
    /** Of (ζ, μ, s), @p length numbers a column. */
    void solve_left(double *b, unsigned int n_columns, std::size_t length) const;
    void add_product_left(double factor, const double *x, double *y, unsigned int n_columns) const;
  };
} // namespace samara

#endif
