// KLU and MUMPS behind one interface: on the matrices of models, real and complex, with multipliers, all have
// the residual of round-off, the sign of the determinant that dense elimination finds, and name an unknown without a
// pivot.

#include <samara/analysis/dynamic.h>
#include <samara/base/dense.h>
#include <samara/solvers/linear.h>

#include <gtest/gtest.h>

#include "stage_matrix.h"

using namespace samara;

namespace
{
  const std::vector<Library> libraries = {Library::klu, Library::mumps, Library::automatic};

  std::string
  name_of(const Library library)
  {
    return library == Library::klu ? "KLU" : library == Library::mumps ? "MUMPS" : "automatic";
  }

  /** A joint of every kind, loops, a turning rotor; all redundant constraints left in place but those that are fixed.
   */
  const std::vector<std::string> models = {"prm/examples/first_model.prm",
                                           "prm/examples/universal.prm",
                                           "prm/examples/gear.prm",
                                           "prm/examples/flexible_joint.prm",
                                           "prm/benchmarks/swept_tip_dynamics.prm",
                                           "prm/rotorcraft/tail_rotor_transmission.prm"};

  /** Largest residual, relative to the terms of its own equation: that of a backward stable elimination is round-off.
   */
  template <typename Number>
  double
  residual(const Pattern &p, const std::vector<Number> &A, const std::vector<Number> &x, std::vector<Number> b)
  {
    std::vector<double> terms(p.size());
    double              largest_x = 0;
    for (const auto &value : x)
      largest_x = std::max(largest_x, std::abs(value));
    for (int i = 0; i < p.size(); ++i)
      terms[i] = std::abs(b[i]);
    for (int j = 0; j < p.size(); ++j)
      for (int k = p.column_start[j]; k < p.column_start[j + 1]; ++k)
        {
          b[p.rows[k]] -= A[k] * x[j];
          terms[p.rows[k]] += std::abs(A[k]) * largest_x;
        }
    double result = 0;
    for (int i = 0; i < p.size(); ++i)
      result = std::max(result, std::abs(b[i]) / terms[i]);
    return result;
  }

  std::vector<double>
  solution(const StageMatrix &stage, LinearSolver &solver, const double hm, std::vector<double> b)
  {
    SparseMatrix A(stage.pattern);
    A.values = stage.values(hm);
    solver.factorize(A);
    solver.solve(b.data());
    return b;
  }

  std::vector<std::complex<double>>
  solution(const StageMatrix                &stage,
           ComplexSolver                    &solver,
           const std::complex<double>        hm,
           std::vector<std::complex<double>> b)
  {
    solver.factorize(stage.values(hm));
    solver.solve(b.data());
    return b;
  }

  /** Solve with one matrix and, by the same solver, with another one: factors are then renewed. */
  void
  test_residuals(StageMatrix &stage, const std::string &what)
  {
    const auto b = stage.right_hand_side<double>();
    const auto c = stage.right_hand_side<std::complex<double>>();
    for (const auto library : libraries)
      {
        const auto real    = make_solver(stage.pattern, library);
        const auto complex = make_complex_solver(stage.pattern, library);
        for (const double h : {1e-2, 1.1e-2, 1e-4})
          {
            const std::complex<double> hm(0.25 * h, 0.14 * h);
            EXPECT_LT(residual(*stage.pattern, stage.values(h), solution(stage, *real, h, b), b), 1e-12)
              << name_of(library) << ", " << what << ", h = " << h;
            EXPECT_LT(residual(*stage.pattern, stage.values(hm), solution(stage, *complex, hm, c), c), 1e-12)
              << name_of(library) << ", " << what << ", complex, h = " << h;
          }
      }
  }

  std::shared_ptr<const Pattern>
  full_pattern(const int n)
  {
    auto pattern = std::make_shared<Pattern>();
    for (int j = 0; j <= n; ++j)
      pattern->column_start.push_back(n * j);
    for (int k = 0; k < n * n; ++k)
      pattern->rows.push_back(k % n);
    return pattern;
  }
} // namespace



TEST(Libraries, ResidualsAreRoundOff)
{
  for (const auto &model : models)
    {
      StageMatrix stage(model);
      test_residuals(stage, model);
    }
}



// A matrix may be worse conditioned than the one whose pivots are in use by itself, in other units: they serve. Or
// because a pivot has become small beside its row: solutions would miss some digits, and new pivots are found.
TEST(Libraries, OldPivotsServeWhereTheyAreExact)
{
  const int    n       = 8;
  const auto   pattern = full_pattern(n);
  SparseMatrix first(pattern);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      first.values[n * j + i] = i == j ? 4. : std::sin(1. + i + 3. * j);
  std::vector<double> b(n);
  for (int i = 0; i < n; ++i)
    b[i] = std::cos(2. * i);
  for (const auto library : libraries)
    for (const double small : {1e-4, 1e-5, 1e-6, 1e-8, 1e-12})
      for (const bool by_units : {true, false})
        {
          const auto solver = make_solver(pattern, library);
          solver->factorize(first);
          // any of them may be the first pivot
          for (int k = 0; k < n; ++k)
            {
              SparseMatrix other = first;
              for (int i = 0; i < n; ++i)
                other.values[n * k + i] *= by_units || i == k ? small : 1.;
              solver->factorize(other);
              std::vector<double> x = b;
              solver->solve(x.data());
              EXPECT_LT(residual(*pattern, other.values, x, b), 1e-13) // as is promised
                << name_of(library) << ", " << small << (by_units ? " of a column, " : " of a pivot, ") << k;
            }
        }
}



TEST(Libraries, LargeFactorsAreReadInOrder)
{
  // more entries than KLU keeps in its own order: 120 elements have 2000 unknowns with 31 entries in L and U
  StageMatrix stage("prm/examples/first_model.prm", {"Bodies/rod/Elements = 160", "Bodies/rod/Degree = 3"});
  ASSERT_GT(stage.pattern->size(), 2500);
  test_residuals(stage, "rod of 160 elements");
}



TEST(Libraries, SignOfTheDeterminantIsThatOfDenseElimination)
{
  unsigned int n_negative = 0, n_positive = 0;
  for (const auto &model : models)
    {
      const StageMatrix stage(model);
      SparseMatrix      A(stage.pattern);
      // with negative shifts the number of negative eigenvalues, and the sign, changes
      for (const double h : {1e-2, 3e-3, -2e-3, -5e-2})
        {
          A.values              = stage.values(h);
          Eigen::MatrixXd dense = A.dense();
          for (int i = 0; i < dense.rows(); ++i)
            dense.row(i) /= dense.row(i).cwiseAbs().maxCoeff();
          // complex pairs leave the sign of the product of eigenvalues as it is
          int sign = 1;
          for (const std::complex<double> &value : general_eigenvalues(dense))
            if (value.imag() == 0 && value.real() < 0)
              sign = -sign;
          (sign < 0 ? n_negative : n_positive)++;
          for (const auto library : libraries)
            {
              const auto solver = make_solver(stage.pattern, library);
              solver->factorize(A);
              EXPECT_EQ(solver->determinant_sign(), sign) << name_of(library) << ", " << model << ", h = " << h;
            }
        }
    }
  EXPECT_GT(n_negative, 3u);
  EXPECT_GT(n_positive, 3u);
}



TEST(Libraries, AnUnknownWithoutPivotIsNamed)
{
  for (const auto &model : models)
    {
      const StageMatrix stage(model);
      const Pattern    &p    = *stage.pattern;
      const int         lost = p.size() / 2;
      const auto        lose = [&](auto values) {
        for (int j = 0; j < p.size(); ++j)
          for (int k = p.column_start[j]; k < p.column_start[j + 1]; ++k)
            if (j == lost || p.rows[k] == lost)
              values[k] = 0.;
        return values;
      };
      for (const auto library : libraries)
        {
          const auto   real    = make_solver(stage.pattern, library);
          const auto   complex = make_complex_solver(stage.pattern, library);
          SparseMatrix A(stage.pattern);
          A.values = lose(stage.values(1e-2));
          try
            {
              real->factorize(A);
              ADD_FAILURE() << name_of(library) << " finds no singularity, " << model;
            }
          catch (const SingularMatrix &singular)
            {
              EXPECT_EQ(singular.unknown, lost) << name_of(library) << ", " << model;
            }
          try
            {
              complex->factorize(lose(stage.values(std::complex<double>(2.5e-3, 1.4e-3))));
              ADD_FAILURE() << name_of(library) << " finds no singularity, " << model << ", complex";
            }
          catch (const SingularMatrix &singular)
            {
              EXPECT_EQ(singular.unknown, lost) << name_of(library) << ", " << model << ", complex";
            }
          // the solver is of use afterwards
          A.values = stage.values(1e-2);
          EXPECT_NO_THROW(real->factorize(A)) << name_of(library) << ", " << model;
        }
    }
}



TEST(Libraries, ConditionOfANearlySingularMatrix)
{
  // [1 1; 1 1 + ε]: pivots 1 and ε; in the 1-norm |A| |A⁻¹| = (2 + ε)²/ε
  constexpr double epsilon = 1e-9;
  for (const auto library : libraries)
    {
      SparseMatrix A(full_pattern(2));
      A.values          = {1, 1, 1, 1 + epsilon, 0};
      const auto solver = make_solver(A.pattern, library);
      solver->factorize(A);
      EXPECT_GT(solver->reciprocal_condition(), 0.2 * epsilon) << name_of(library);
      EXPECT_LT(solver->reciprocal_condition(), 1.01 * epsilon) << name_of(library);
      // rows are scaled: units are no reason to complain
      for (const int k : {0, 2})
        A.values[k] *= 1e12;
      solver->factorize(A);
      EXPECT_GT(solver->reciprocal_condition(), 0.2 * epsilon) << name_of(library);
    }
}



TEST(Libraries, TheEntryChoosesForAllAnalyses)
{
  // the same motion from the same equilibrium, to round-off grown by the condition of the equations
  std::vector<double> reference;
  for (const auto library : libraries)
    {
      Scene scene("prm/rotorcraft/tail_rotor_transmission.prm",
                  {"Linear solver = " + name_of(library), "Dynamic/End time = 0.01", "Output/Pictures = false"});
      EXPECT_EQ(library_in_use(), library);
      scene.equilibrium();
      scene.analysis<DynamicAnalysis>().run(scene.context);
      if (reference.empty())
        reference = scene.context.state.q;
      double difference = 0;
      for (unsigned int i = 0; i < reference.size(); ++i)
        difference = std::max(difference, std::abs(scene.context.state.q[i] - reference[i]));
      EXPECT_LT(difference, 1e-7) << name_of(library);
    }
  Scene unsaid("prm/examples/first_model.prm");
  EXPECT_EQ(library_in_use(), Library::automatic);
}
