#ifndef samara_base_dense_h
#define samara_base_dense_h

#include <Eigen/Dense>

#include <complex>
#include <vector>

namespace samara
{
  /**
   * Decompositions of dense matrices. Eigen does them; it is compiled once, in dense.cc, as its templates would otherwise
   * take a third of the time of every source that asks for one. contrib/check_layers refuses them elsewhere. Those of
   * 6 x 6 matrices are in rotation/matrix6.h; inverses and determinants of 2 x 2 and 3 x 3 ones are written out by Eigen
   * and may stand anywhere.
   */

  /** What a real or complex matrix, or an expression of one, is taken as. @{ */
  using RealMatrix    = Eigen::Ref<const Eigen::MatrixXd>;
  using ComplexMatrix = Eigen::Ref<const Eigen::MatrixXcd>;
  /** @} */

  /** Eigenvalues in ascending order, and orthonormal vectors as columns. */
  template <typename Number>
  struct HermitianEigen
  {
    Eigen::VectorXd                                        values;
    Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic> vectors;
    bool                                                   was_found = true; ///< the iteration has converged
  };

  /** Of a symmetric matrix, of which the lower triangle is read. */
  HermitianEigen<double> symmetric_eigen(const Eigen::MatrixXd &A);

  /** The eigenvalues alone. */
  Eigen::VectorXd symmetric_eigenvalues(const RealMatrix &A);
  Eigen::VectorXd symmetric_eigenvalues(const ComplexMatrix &A);

  /** A x = λ M x of symmetric matrices, M positive definite; Xᵀ M X = 1. */
  HermitianEigen<double>               symmetric_eigen(const RealMatrix &A, const RealMatrix &M);
  HermitianEigen<std::complex<double>> symmetric_eigen(const ComplexMatrix &A, const ComplexMatrix &M);



  /** Eigenvalues, and their vectors as columns of length one. A complex pair stands together, the positive imaginary part
   * first; the two of a real matrix are conjugate to the last bit. */
  struct EigenSystem
  {
    Eigen::VectorXcd values;
    Eigen::MatrixXcd vectors;
  };

  /** Of a square real matrix, as Eigen finds them: see solvers/eigen_system.h for real ones that are there several times. */
  EigenSystem general_eigen(const Eigen::MatrixXd &A);

  /** The eigenvalues alone. */
  Eigen::VectorXcd general_eigenvalues(const Eigen::MatrixXd &A);

  /** α/β of A x = λ B x of square real matrices; infinite where B is singular. */
  Eigen::VectorXcd general_eigenvalues(const Eigen::MatrixXd &A, const Eigen::MatrixXd &B);



  /** A = U T Uᴴ, T upper triangular; a real T has 2 x 2 blocks for complex pairs. */
  template <typename Matrix>
  struct Schur
  {
    Matrix T, U;
    bool   was_found = true; ///< the iteration has converged
  };

  Schur<Eigen::MatrixXd>  real_schur(const Eigen::MatrixXd &A);
  Schur<Eigen::MatrixXcd> complex_schur(const Eigen::MatrixXd &A);



  /** A = U diag(sizes) Vᵀ, sizes descending; U and V are square. */
  struct SingularValues
  {
    Eigen::MatrixXd U;
    Eigen::VectorXd sizes;
    Eigen::MatrixXd V;
  };

  SingularValues singular_values(const Eigen::MatrixXd &A);



  /** Exponential and principal logarithm of a square matrix. */
  Eigen::MatrixXd exponential(const Eigen::MatrixXd &A);
  Eigen::MatrixXd logarithm(const Eigen::MatrixXd &A);



  /** Gauss's elimination with row pivots, for square matrices that are regular. */
  template <typename Number>
  class LuFactors
  {
  public:
    using Matrix = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;

    LuFactors() = default;
    explicit LuFactors(const Matrix &A);

    /** Takes memory only where @p A is larger than those before. */
    void compute(const Matrix &A);

    Matrix solve(const Eigen::Ref<const Matrix> &B) const;
    Matrix inverse() const;

  private:
    Eigen::PartialPivLU<Matrix> factors;
  };

  using Lu        = LuFactors<double>;
  using ComplexLu = LuFactors<std::complex<double>>;

  /** The inverse of a square matrix that is regular. */
  Eigen::MatrixXd  inverse(const RealMatrix &A);
  Eigen::MatrixXcd inverse(const ComplexMatrix &A);

  /** The solution of A X = B for regular A, a column for each of B. */
  Eigen::MatrixXd  solution(const RealMatrix &A, const RealMatrix &B);
  Eigen::MatrixXcd solution(const ComplexMatrix &A, const ComplexMatrix &B);



  /** Gauss's elimination with rows and columns as pivots, which tells the rank of any matrix. */
  class FullLu
  {
  public:
    /** Pivots below @p threshold times the largest are zero; 0 for what round-off leaves. */
    explicit FullLu(const Eigen::MatrixXd &A, double threshold = 0);

    int             rank() const;
    bool            is_invertible() const;
    Eigen::MatrixXd kernel() const; ///< a basis, as columns; without any where the rank is full
    Eigen::MatrixXd solve(const RealMatrix &B) const;

  private:
    Eigen::FullPivLU<Eigen::MatrixXd> factors;
  };



  /** A P = Q R by Householder's reflections, the largest remaining column first. */
  class PivotedQr
  {
  public:
    /** Pivots below @p threshold times the largest are zero; 0 for what round-off leaves. */
    explicit PivotedQr(const Eigen::MatrixXd &A, double threshold = 0);

    int             rank() const;
    double          pivot(int k) const;           ///< |R_kk|
    int             column(int k) const;          ///< the column of A that is the k-th pivot
    Eigen::MatrixXd Q() const;                    ///< square
    Eigen::MatrixXd leading(int n) const;         ///< the first n columns of Q
    Eigen::MatrixXd solve(const RealMatrix &B) const; ///< least squares

  private:
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors;
  };

  /** The square Q of the same decomposition of a complex matrix. */
  Eigen::MatrixXcd pivoted_q(const Eigen::MatrixXcd &A);

  /** Q of A = Q R, as many columns as A has, in their order. */
  Eigen::MatrixXd orthonormal_columns(const Eigen::MatrixXd &A);



  /** Solutions of least norm of A x = b, whatever the rank of A. */
  class MinimumNorm
  {
  public:
    /** Pivots below @p threshold times the largest are zero. */
    MinimumNorm(const Eigen::MatrixXd &A, double threshold);

    Eigen::MatrixXd solve(const RealMatrix &B) const;
    Eigen::MatrixXd null_space() const; ///< orthonormal columns

  private:
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> factors;
  };



  /** A = L Lᴴ of a positive definite matrix. */
  template <typename Number>
  class CholeskyFactors
  {
  public:
    using Matrix = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;

    explicit CholeskyFactors(const Matrix &A);

    bool            is_positive() const; ///< positive definite; nothing else may be asked otherwise
    Eigen::VectorXd pivots() const;      ///< the diagonal of L
    Matrix          upper() const;       ///< Lᴴ
    Matrix          solve(const Eigen::Ref<const Matrix> &B) const;
    Matrix          solve_lower(const Eigen::Ref<const Matrix> &B) const; ///< L⁻¹ B
    Matrix          solve_upper(const Eigen::Ref<const Matrix> &B) const; ///< L⁻ᴴ B

  private:
    Eigen::LLT<Matrix> factors;
  };

  using Cholesky        = CholeskyFactors<double>;
  using ComplexCholesky = CholeskyFactors<std::complex<double>>;

  /** A = Pᵀ L D Lᵀ P of a symmetric matrix that need not be positive. */
  class SymmetricSolve
  {
  public:
    explicit SymmetricSolve(const Eigen::MatrixXd &A);

    Eigen::MatrixXd solve(const RealMatrix &B) const;

  private:
    Eigen::LDLT<Eigen::MatrixXd> factors;
  };
} // namespace samara

#endif
