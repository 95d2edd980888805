#include <samara/base/errors.h>
#include <samara/solvers/eigen.h>
#include <samara/solvers/linear.h>

#include <AnasaziBasicEigenproblem.hpp>
#include <AnasaziBlockKrylovSchurSolMgr.hpp>
#include <AnasaziEpetraAdapter.hpp>
#include <Epetra_Map.h>
#include <Epetra_MultiVector.h>
#include <Epetra_Operator.h>
#include <Epetra_SerialComm.h>

#include <algorithm>

namespace samara
{
  namespace
  {
    /** The nonzero entries of a matrix, for products: mass and damping fill little of the system's pattern. */
    struct Entries
    {
      std::vector<int>    rows, columns;
      std::vector<double> values;

      explicit Entries(const SparseMatrix &A)
      {
        for (int j = 0; j < A.pattern->size(); ++j)
          for (int k = A.pattern->column_start[j]; k < A.pattern->column_start[j + 1]; ++k)
            if (A.values[k] != 0.)
              {
                rows.push_back(A.pattern->rows[k]);
                columns.push_back(j);
                values.push_back(A.values[k]);
              }
      }

      void
      add_product(const double factor, const double *x, double *y) const
      {
        for (unsigned int k = 0; k < values.size(); ++k)
          y[rows[k]] += factor * values[k] * x[columns[k]];
      }
    };



    /**
     * (A − σB)⁻¹ B of the first-order form with the states z = (ζ, v):
     * v' − σζ' = ζ and −(K + σC + σ²M) ζ' − Gᵀμ = M v + (C + σM) ζ, G ζ' = 0.
     */
    class ShiftInvert : public Epetra_Operator
    {
    public:
      ShiftInvert(const SparseMatrix &M,
                  const SparseMatrix &C,
                  const SparseMatrix &K,
                  const unsigned int  n,
                  const double        shift)
        : n(n)
        , shift(shift)
        , M(M)
        , C(C)
        , solver(make_solver(K.pattern))
        , b(K.pattern->size())
        , map(static_cast<int>(2 * n), 0, communicator)
      {
        SparseMatrix saddle = K;
        saddle.add(shift, C);
        saddle.add(shift * shift, M);
        solver->factorize(saddle);
      }

      void
      apply(const double *z, double *result) const
      {
        std::fill(b.begin(), b.end(), 0.);
        M.add_product(-1., z + n, b.data());
        C.add_product(-1., z, b.data());
        M.add_product(-shift, z, b.data());
        solver->solve(b.data());
        for (unsigned int i = 0; i < n; ++i)
          {
            result[i]     = b[i];
            result[n + i] = z[i] + shift * b[i];
          }
      }

      /** @name Epetra_Operator @{ */
      int
      Apply(const Epetra_MultiVector &X, Epetra_MultiVector &Y) const override
      {
        for (int j = 0; j < X.NumVectors(); ++j)
          apply(X[j], Y[j]);
        return 0;
      }
      int
      SetUseTranspose(bool) override
      {
        return -1;
      }
      int
      ApplyInverse(const Epetra_MultiVector &, Epetra_MultiVector &) const override
      {
        return -1;
      }
      double
      NormInf() const override
      {
        return 0;
      }
      const char *
      Label() const override
      {
        return "shift-invert of the linearised motion";
      }
      bool
      UseTranspose() const override
      {
        return false;
      }
      bool
      HasNormInf() const override
      {
        return false;
      }
      const Epetra_Comm &
      Comm() const override
      {
        return communicator;
      }
      const Epetra_Map &
      OperatorDomainMap() const override
      {
        return map;
      }
      const Epetra_Map &
      OperatorRangeMap() const override
      {
        return map;
      }
      /** @} */

      const unsigned int n;
      const double       shift;

    private:
      Entries                       M, C;
      std::unique_ptr<LinearSolver> solver;
      mutable std::vector<double>   b;
      Epetra_SerialComm             communicator;
      Epetra_Map                    map;
    };



    void
    add_mode(std::vector<Mode> &modes, const std::complex<double> &nu, const double shift, const Eigen::VectorXcd &z)
    {
      Mode mode;
      mode.lambda = shift + 1. / nu;
      if (mode.lambda.imag() < 0)
        return; // its conjugate stands for both
      mode.shape = z / z.norm();
      modes.push_back(mode);
    }



    /** An orthonormal basis of the motions that obey the constraints, G ζ = 0. */
    Eigen::MatrixXd
    admissible(const SparseMatrix &K, const unsigned int n)
    {
      const Eigen::MatrixXd Gt = K.dense().topRightCorner(n, K.pattern->size() - n);
      if (Gt.cols() == 0)
        return Eigen::MatrixXd::Identity(n, n);
      const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(Gt);
      return Eigen::MatrixXd(qr.householderQ()).rightCols(n - qr.rank());
    }



    /**
     * All modes by the dense matrix of the same operator in a basis of the admissible motions. Without this projection the
     * infinite eigenvalues of the constraints, which are threefold defective, would come out as large finite ones.
     */
    std::vector<Mode>
    dense_modes(const SparseMatrix &M, const SparseMatrix &C, const SparseMatrix &K, const unsigned int n, const double shift)
    {
      const Eigen::MatrixXd Z = admissible(K, n);
      const unsigned int    m = Z.cols();
      if (m == 0)
        return {};
      const auto reduced      = [&](const SparseMatrix &A) -> Eigen::MatrixXd {
        return Z.transpose() * A.dense().topLeftCorner(n, n) * Z;
      };
      const Eigen::MatrixXd Mr = reduced(M), Cr = reduced(C);
      const Eigen::PartialPivLU<Eigen::MatrixXd> lu(reduced(K) + shift * Cr + shift * shift * Mr);
      Eigen::MatrixXd                            A(2 * m, 2 * m);
      A << -lu.solve(Cr + shift * Mr), -lu.solve(Mr), Eigen::MatrixXd::Identity(m, m), Eigen::MatrixXd::Zero(m, m);
      A.bottomRows(m) += shift * A.topRows(m);
      const Eigen::EigenSolver<Eigen::MatrixXd> eigen(A);
      // what has no mass is twice defective at zero: its eigenvalues are there to the root of round-off
      const double      zero = 1e-7 * eigen.eigenvalues().cwiseAbs().maxCoeff();
      std::vector<Mode> modes;
      for (unsigned int i = 0; i < 2 * m; ++i)
        if (std::abs(eigen.eigenvalues()(i)) > zero)
          add_mode(modes, eigen.eigenvalues()(i), shift, Z * eigen.eigenvectors().col(i).head(m));
      return modes;
    }



    std::vector<Mode>
    krylov_modes(const Teuchos::RCP<ShiftInvert> &op, const unsigned int n_modes, const unsigned int n_blocks, const unsigned int attempt)
    {
      using MV      = Epetra_MultiVector;
      using Problem = Anasazi::BasicEigenproblem<double, MV, Epetra_Operator>;

      // a start vector with all modes in it and, after one application, without the infinite ones
      auto start = Teuchos::rcp(new MV(op->OperatorDomainMap(), 1));
      for (unsigned int i = 0; i < 2 * op->n; ++i)
        (*start)[0][i] = std::sin(1. + (1.7 + 0.3 * attempt) * i);
      MV copy(*start);
      op->Apply(copy, *start);

      auto problem = Teuchos::rcp(new Problem(op, start));
      problem->setHermitian(false);
      problem->setNEV(2 * n_modes);
      problem->setProblem();

      Teuchos::ParameterList parameters;
      parameters.set("Which", std::string("LM"));
      parameters.set("Block Size", 1);
      parameters.set("Num Blocks", static_cast<int>(n_blocks));
      parameters.set("Maximum Restarts", 200);
      parameters.set("Convergence Tolerance", 1e-10);
      parameters.set("Verbosity", static_cast<int>(Anasazi::Errors));
      Anasazi::BlockKrylovSchurSolMgr<double, MV, Epetra_Operator> manager(problem, parameters);
      if (manager.solve() != Anasazi::Converged)
        throw NotConverged("the Arnoldi iteration did not find all " + std::to_string(n_modes) +
                           " modes; ask for fewer or move the shift nearer to them");

      const auto       &solution = problem->getSolution();
      const MV         &vectors  = *solution.Evecs;
      std::vector<Mode> modes;
      for (int i = 0; i < solution.numVecs; ++i)
        {
          // index 0: a real one; 1: real part of a pair, imaginary part next; -1: the conjugate
          const int              index = solution.index[i];
          const int              real  = index == -1 ? i - 1 : i;
          Eigen::VectorXcd       z     = Eigen::Map<const Eigen::VectorXd>(vectors[real], op->n).cast<std::complex<double>>();
          const std::complex<double> nu(solution.Evals[i].realpart, solution.Evals[i].imagpart);
          if (index != 0)
            z += std::complex<double>(0, index) * Eigen::Map<const Eigen::VectorXd>(vectors[real + 1], op->n);
          add_mode(modes, nu, op->shift, z);
        }
      return modes;
    }
  } // namespace



  std::vector<Mode>
  find_modes(const SparseMatrix &M,
             const SparseMatrix &C,
             const SparseMatrix &K,
             const unsigned int  n_kinematic,
             const unsigned int  n_modes,
             const double        shift)
  {
    const auto         op       = Teuchos::rcp(new ShiftInvert(M, C, K, n_kinematic, shift));
    const unsigned int n_blocks = std::max(4 * n_modes, 30u);
    std::vector<Mode>  modes;
    bool               found = false;
    // the Schur form of nearly equal eigenvalues cannot always be sorted (LAPACK trexc), and a Krylov space of one start vector
    // finds equal ones by round-off only: then from another start vector
    for (unsigned int attempt = 0; attempt < 3 && !found && n_kinematic > std::max(n_blocks, 60u); ++attempt)
      try
        {
          modes = krylov_modes(op, n_modes, n_blocks + 12 * attempt, attempt);
          found = true;
        }
      catch (const std::exception &)
        {
          continue; // LAPACK's complaint, or no convergence
        }
    // where the Krylov space would be most of the space anyway, dense matrices are simpler and complete
    if (!found && n_kinematic > 1500)
      throw NotConverged("the Arnoldi iteration cannot separate nearly equal eigenvalues; ask for fewer or more modes, or move the "
                         "shift");
    if (!found)
      modes = dense_modes(M, C, K, n_kinematic, shift);
    std::sort(modes.begin(), modes.end(), [](const Mode &a, const Mode &b) { return std::abs(a.lambda) < std::abs(b.lambda); });
    if (modes.size() > n_modes)
      modes.resize(n_modes);
    return modes;
  }
} // namespace samara
