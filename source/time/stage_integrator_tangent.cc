// What the tangent of a step needs of the integrator (step_tangent.h).

#include <samara/base/errors.h>
#include <samara/time/step_tangent.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace samara
{
  std::unique_ptr<StepTangent>
  StageIntegrator::linearize(const State &start)
  {
    AssertThrow(previous_step > 0 && offset == 1, dealii::ExcMessage("There is no step to be linearised."));
    AssertThrow(!wants_estimates, dealii::ExcMessage("Estimates of errors change the stages of a step."));
    AssertThrow(std::equal(start.y.begin(), start.y.end(), previous[0].begin()),
                dealii::ExcMessage("The last step did not begin at this state."));
    const double h = previous_step;
    if (std::any_of(stop_forces_now.begin(), stop_forces_now.end(), [](const auto &stop) { return stop.is_touched; }))
      throw NotConverged("a stop is touched in the step that is to be linearised");
    if (const std::string pair = contacts.touched(); !pair.empty())
      throw NotConverged(pair + " touch in the step that is to be linearised");
    if (!system.layout.frictions.empty())
      throw NotConverged("dry friction in a step is not linearised");
    if (!has_factors(h))
      {
        freeze(start, h);
        try
          {
            factorize(h);
          }
        catch (const SingularMatrix &)
          {
            throw NotConverged("the step that is to be linearised has a singular matrix");
          }
      }
    return std::unique_ptr<StepTangent>(new StepTangent(*this, start, h));
  }



  void
  StageIntegrator::solve_stages(const std::vector<double> &r, std::vector<double> &X)
  {
    const Layout      &layout = system.layout;
    const unsigned int n      = system.size();
    for (unsigned int k = 0; k < tableau.s; ++k)
      std::copy_n(r.begin() + k * n, n, stages[k].residual.begin());
    apply_factors(step_of_factors);
    collect_increments(step_of_factors);
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        double *const to = &X[k * n];
        for (unsigned int node = 1; node < layout.n_nodes; ++node)
          Eigen::Map<Vector6>(to + layout.of_node(node)) = -change_of_twist(k, node);
        for (int i = layout.of_coordinate(0); i < layout.of_state(0); ++i)
          to[i] = -dz_rate[k][i];
        for (int i = layout.of_state(0); i < layout.of_multiplier(0); ++i)
          to[i] = -dz[k][i];
        for (unsigned int i = 0; i < layout.n_multipliers; ++i)
          to[layout.of_multiplier(i)] = -d_lambda[k][i];
      }
  }
} // namespace samara
