// The matrices of a time step, M + hμ C + (hμ)² K with rows and columns of constraints as they are, over steps from
// 1e-7 to 1 s: constraints make their condition depend on the step no more than inertia and stiffness do without them.
// With displacements and forces as unknowns, M/h² + K and G, a factor of 1e14 would be in it (doc/benchmarks/sizes.md).

#include <samara/solvers/linear.h>

#include <gtest/gtest.h>

#include "stage_matrix.h"

using namespace samara;

namespace
{
  const std::vector<double> steps = {1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1};

  /** Reciprocal condition number with rows and columns scaled by their largest entries. */
  double
  condition(const std::shared_ptr<const Pattern> &pattern, const std::vector<double> &values)
  {
    SparseMatrix A(pattern);
    A.values          = values;
    const auto solver = make_solver(pattern, Library::mumps);
    solver->factorize(A);
    return solver->reciprocal_condition();
  }

  /** The same with each constraint measured against the inertia and stiffness it works on: G D⁻¹ Gᵀ has ones on its
   * diagonal. */
  double
  condition_with_scaled_constraints(const StageMatrix &stage, std::vector<double> values)
  {
    const Pattern      &p           = *stage.pattern;
    const int           n_kinematic = stage.scene.system.layout.of_multiplier(0);
    std::vector<double> scale(p.size());
    for (int i = 0; i < n_kinematic; ++i)
      {
        const double diagonal = std::abs(values[p.position(i, i)]);
        scale[i]              = diagonal > 0 ? 1 / std::sqrt(diagonal) : 1;
      }
    for (int j = n_kinematic; j < p.size(); ++j)
      {
        double sum = 0;
        for (int k = p.column_start[j]; k < p.column_start[j + 1]; ++k)
          if (p.rows[k] < n_kinematic)
            sum += std::pow(values[k] * scale[p.rows[k]], 2);
        scale[j] = sum > 0 ? 1 / std::sqrt(sum) : 1;
      }
    for (int j = 0; j < p.size(); ++j)
      for (int k = p.column_start[j]; k < p.column_start[j + 1]; ++k)
        values[k] *= scale[j] * scale[p.rows[k]];
    return condition(stage.pattern, values);
  }
} // namespace



TEST(Condition, OfMechanismsDoesNotDependOnTheStep)
{
  for (const std::string model : {"prm/benchmarks/dynamics/slider_crank.prm", "prm/examples/revolute.prm"})
    {
      const StageMatrix stage(model);
      const double      reference = condition(stage.pattern, stage.values(steps[0]));
      EXPECT_GT(reference, 1e-4) << model;
      for (const double h : steps)
        if (h < 0.1)
          {
            const double c = condition(stage.pattern, stage.values(h));
            EXPECT_GT(c, 0.5 * reference) << model << ", h = " << h;
            EXPECT_LT(c, 2 * reference) << model << ", h = " << h;
          }
    }
}



TEST(Condition, ScalingOfConstraintsWouldBringNothing)
{
  // where stiffness outweighs inertia the condition becomes that of the stiffness; it is not the constraints'
  for (const std::string model :
       {"prm/benchmarks/rotating_beam_hinged.prm", "prm/benchmarks/dynamics/slider_crank.prm"})
    {
      const StageMatrix stage(model);
      for (const double h : steps)
        {
          const auto   values = stage.values(h);
          const double scaled = condition_with_scaled_constraints(stage, values);
          if (scaled < 1e-12)
            continue; // both are round-off
          EXPECT_GT(condition(stage.pattern, values), 0.2 * scaled) << model << ", h = " << h;
        }
    }
}



TEST(Condition, UnscaledMultipliersWouldDependOnTheStep)
{
  // the counter-example that the first test would find: M/h² + C/h + K with G as it is, neither rows nor columns
  // scaled; pivots of KLU, which scales rows only, spread as 1/h²
  const StageMatrix stage("prm/benchmarks/dynamics/slider_crank.prm");
  const Pattern    &p           = *stage.pattern;
  const int         n_kinematic = stage.scene.system.layout.of_multiplier(0);
  const auto        rcond       = [&](const double h) {
    SparseMatrix A(stage.pattern);
    A.values = stage.values(h);
    for (int j = 0; j < n_kinematic; ++j)
      for (int k = p.column_start[j]; k < p.column_start[j + 1]; ++k)
        if (p.rows[k] < n_kinematic)
          A.values[k] /= h * h;
    const auto solver = make_solver(stage.pattern, Library::klu);
    solver->factorize(A);
    return solver->reciprocal_condition();
  };
  EXPECT_LT(rcond(1e-5), 1e-4 * rcond(1e-2));
}
