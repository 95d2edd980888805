// Contacts of groups in the stages: their forces, whether a step is accepted, and what the factors know of them.

#include <samara/time/stage_integrator.h>

namespace samara
{
  void
  StageIntegrator::evaluate_contacts(const double h)
  {
    points_of_stages.clear();
    for (const Stage &stage : stages)
      points_of_stages.push_back(stage.point());
    if (turns)
      return evaluate_contacts_that_turn(h);
    residuals_of_stages.clear();
    for (Stage &stage : stages)
      residuals_of_stages.push_back(stage.residual.data());
    contacts.evaluate(points_of_stages, final_q.data(), h, residuals_of_stages);
  }



  void
  StageIntegrator::evaluate_contacts_that_turn(const double h)
  {
    // bodies that touch need not be of one set: each set gets back what its own sides have done too much
    thread_local std::vector<std::vector<double>> forces;
    thread_local std::vector<double *>            seen, in_axes;
    forces.resize(2 * tableau.s);
    seen.clear();
    in_axes.clear();
    for (auto &one : forces)
      {
        one.assign(system.size() + 6, 0.);
        (seen.size() < tableau.s ? seen : in_axes).push_back(one.data());
      }
    contacts.evaluate(points_of_stages, final_q.data(), h, seen, in_axes);
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        Stage &stage = stages[k];
        for (unsigned int i = 0; i < stage.residual.size(); ++i)
          {
            stage.residual[i] += seen[k][i];
            seen[k][i] -= in_axes[k][i];
          }
        rotation->add_powers_of_rows(stage.y.data(), stage.rates.data(), seen[k], stage.powers.data());
      }
  }



  bool
  StageIntegrator::accept_contacts(StepResult &result)
  {
    constexpr double multiple_of_tolerance = 10; // as in the judgement of the whole account
    const double     allowed = multiple_of_tolerance * tolerance * std::max(energy_that_counts(), moved_energy);
    result.refusal           = contacts.refusal(points_of_stages, final_q.data(), allowed);
    return result.refusal.empty();
  }



  std::shared_ptr<const Pattern>
  StageIntegrator::with_couplings(const std::shared_ptr<const Pattern> &pattern)
  {
    std::vector<int> from;
    auto             wider = wider_pattern(*pattern, couplings, from);
    if (!entries_in_use.empty())
      for (int &i : from)
        i = i < 0 ? -1 : entries_in_use[i];
    entries_in_use = std::move(from);
    return wider;
  }



  void
  StageIntegrator::add_contacts_to_exact_matrix(const double h)
  {
    const auto fill = [&]() {
      bool is_complete = true;
      for (unsigned int k = 0; k < tableau.s; ++k)
        contacts.add_matrices(
          points_of_stages[k],
          [&](const unsigned int a, const unsigned int b, const Matrix6 &K, const Matrix6 &C) {
            if (a != 0 && b != 0)
              is_complete = exact->add_pair(k, a, b, K, C) && is_complete;
          },
          k);
      return is_complete;
    };
    if (fill())
      return;
    exact = std::make_unique<ExactStages>(system, tableau, contacts.couplings());
    exact->assemble(points_of_stages, h, is_active);
    add_slopes_of_stops(h);
    add_slopes_of_springs(h);
    fill();
  }



  void
  StageIntegrator::add_contacts_to_matrices()
  {
    // a pattern for all pairs that are near, made anew only when one of them that is touched is not in it
    const Layout &layout = system.layout;
    const auto    fill   = [&]() {
      bool is_complete = true;
      entries_of_pairs.clear();
      const Pattern &pattern = *real_matrix.pattern;
      contacts.add_matrices(frozen.point(),
                            [&](const unsigned int a, const unsigned int b, const Matrix6 &K, const Matrix6 &C) {
                              if (a == 0 || b == 0)
                                return;
                              for (int j = 0; j < 6; ++j)
                                {
                                  const int at = pattern.position(layout.of_node(a), layout.of_node(b) + j);
                                  is_complete  = is_complete && at >= 0;
                                  for (int i = 0; i < 6 && at >= 0; ++i)
                                    entries_of_pairs.push_back({at + i, K(i, j), C(i, j)});
                                }
                            });
      return is_complete;
    };
    if (fill())
      return;
    couplings = contacts.couplings();
    make_factors();
    fill();
  }
} // namespace samara
