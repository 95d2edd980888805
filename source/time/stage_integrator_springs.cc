// Nonlinear springs in the stages. Their forces F(d_k) are among the terms; here is what makes their work over a step
// exactly the loss of their energy (doc/theory/states.md):
//
//     f_k = F(d_k) + τ ḋ_k,     τ = Σ b_k (F_m − F(d_k)) ḋ_k / Σ b_k ḋ_k²,     F_m = (U_f − U_i)/(d_f − d_i)

#include <samara/time/stage_integrator.h>

#include <cmath>

namespace samara
{
  namespace
  {
    /** τ of a spring that is at @p start at the start, with the rates of its coordinate in the stages. */
    struct Correction
    {
      double                tau = 0, squares = 0;
      std::array<double, 3> rate{}, stretch{}, lack{}; ///< ḋ_k, d_k, F_m − F(d_k)
      SpringLaw::Mean       mean{0, 0};

      template <typename Stages>
      Correction(const Layout::NonlinearSpring &spring,
                 const Tableau                 &t,
                 const double                   start,
                 const Stages                  &stages,
                 const double                   h)
      {
        double end = start, power = 0;
        for (unsigned int k = 0; k < t.s; ++k)
          {
            rate[k]    = stages[k].rates[spring.coordinate];
            stretch[k] = stages[k].coordinates[spring.coordinate] + spring.offset;
            end += h * t.b(k) * rate[k];
          }
        mean = spring.law->mean(start, end);
        for (unsigned int k = 0; k < t.s; ++k)
          {
            lack[k] = mean.force - spring.law->force(stretch[k]);
            power += t.b(k) * lack[k] * rate[k];
            squares += t.b(k) * rate[k] * rate[k];
          }
        tau = squares > 0 ? power / squares : 0.;
      }
    };
  } // namespace



  void
  StageIntegrator::start_springs(const State &state)
  {
    stretches.clear();
    for (const auto &spring : system.layout.nonlinear_springs)
      stretches.push_back(state.coordinates[spring.coordinate] + spring.offset);
  }



  void
  StageIntegrator::evaluate_springs(const double h)
  {
    const auto &springs = system.layout.nonlinear_springs;
    for (unsigned int i = 0; i < springs.size(); ++i)
      {
        const Correction correction(springs[i], tableau, stretches[i], stages, h);
        for (unsigned int k = 0; k < tableau.s; ++k)
          stages[k].residual[system.layout.of_coordinate(springs[i].coordinate)] += correction.tau * correction.rate[k];
      }
  }



  void
  StageIntegrator::account_for_springs(const double h, StepResult &result) const
  {
    // that of the forces F(d_k) is among the loads
    const auto &springs = system.layout.nonlinear_springs;
    for (unsigned int i = 0; i < springs.size(); ++i)
      {
        const Correction correction(springs[i], tableau, stretches[i], stages, h);
        result.work_of_loads -= h * correction.tau * correction.squares;
      }
  }



  void
  StageIntegrator::add_slopes_of_springs(const double h)
  {
    const auto &springs = system.layout.nonlinear_springs;
    for (unsigned int i = 0; i < springs.size(); ++i)
      {
        const Tableau   &t = tableau;
        const Correction c(springs[i], t, stretches[i], stages, h);
        if (!(c.squares > 0))
          continue;
        const int row       = system.layout.of_coordinate(springs[i].coordinate);
        double    mean_rate = 0;
        for (unsigned int k = 0; k < t.s; ++k)
          mean_rate += t.b(k) * c.rate[k];
        for (unsigned int l = 0; l < t.s; ++l)
          {
            double change = t.b(l) * c.lack[l] + h * t.b(l) * mean_rate * c.mean.slope;
            for (unsigned int k = 0; k < t.s; ++k)
              change -= t.b(k) * c.rate[k] * h * t.a(k, l) * springs[i].law->stiffness(c.stretch[k]);
            const double of_tau = (change - 2 * c.tau * t.b(l) * c.rate[l]) / c.squares;
            for (unsigned int k = 0; k < t.s; ++k)
              exact->add(k, row, l, row, of_tau * c.rate[k] + (k == l ? c.tau : 0.));
          }
      }
  }
} // namespace samara
