// Newton's method with the exact matrix of all stages, for steps that do not converge with one matrix for all of them.

#include <samara/time/stage_integrator.h>

namespace samara
{
  void
  StageIntegrator::make_exact()
  {
    if (exact)
      return;
    exact = std::make_unique<ExactStages>(system, tableau);
    for (unsigned int k = 0; k < tableau.s; ++k)
      stage_strains.push_back(system.linear_strains());
  }



  bool
  StageIntegrator::iterate_exactly(const State &state, const double h, const bool again, StepResult &result)
  {
    make_exact();
    if (again)
      {
        ++n_exact_steps;
        step_of_factors = 0; // no good here
        previous_step   = 0; // the extrapolated start did not help
        predict(state, h);
      }
    is_exact       = true;
    bool converged = false;
    try
      {
        converged = iterate(state, h, 0.95, result); // the last means: whatever shrinks is welcome
      }
    catch (const SingularMatrix &)
      {
        // no solution nearby
      }
    is_exact = false;
    return converged;
  }



  bool
  StageIntegrator::has_many_contacts() const
  {
    constexpr unsigned int many = 150; // unknowns
    unsigned int           n    = 0;
    for (const Device &device : devices)
      if (const int stop = device.is_friction ? system.layout.frictions[device.number].stop : int(device.number);
          stop < 0 || gaps[stop] > 0)
        n += device.n_ports;
    return tableau.s * n > many;
  }



  void
  StageIntegrator::use_strains_of_stages()
  {
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        Point<double> point = stages[k].point_of_matrices();
        point.multipliers   = no_multipliers.data();
        stage_strains[k]->renew(point);
      }
  }
} // namespace samara
