#ifndef samara_tests_time_measured_h
#define samara_tests_time_measured_h

// What is measured of a motion, of whatever system: energy, momentum, gaps, over a row of steps.

#include <samara/time/stage_integrator.h>

#include "../momentum.h"
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  /** What a row of steps did. */
  struct Record
  {
    State        state;
    unsigned int n_steps       = 0; ///< fewer than asked for if one was not solved
    double       balance       = 0; ///< most energy that the account of a step leaves, relative to the largest energy
    double       energy        = 0; ///< the largest
    double       work_of_loads = 0, work_of_drives = 0, viscous_loss = 0, dissipated = 0; ///< in all
    double       least_dissipated = 0;                                                    ///< in a step
    double       gap = 0, skewness = 0; ///< largest violation of a constraint; of DᵀD = I
  };

  inline double
  energy_of(const System &system, const State &state)
  {
    const auto e = system.energy(state);
    return e.kinetic + e.strain;
  }

  inline double
  potential_of(const System &system, const State &state)
  {
    return system.potential_energy(state.point());
  }

  inline double
  total_energy(const System &system, const State &state)
  {
    return energy_of(system, state) + potential_of(system, state);
  }

  inline double
  largest_gap(const System &system, const State &state)
  {
    std::vector<double> r(system.size() + 6, 0.);
    State               free = state;
    free.held                = false;
    system.add_gaps(free.point(), r.data());
    double gap = 0;
    for (unsigned int i = 0; i < system.layout.n_multipliers; ++i)
      gap = std::max(gap, std::abs(r[system.layout.of_multiplier(i)]));
    return gap;
  }

  inline double
  largest_skewness(const System &system, const State &state)
  {
    double largest = 0;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const Matrix3 D = state.triad(node);
        largest         = std::max(largest, (D.transpose() * D - Matrix3::Identity()).cwiseAbs().maxCoeff());
      }
    return largest;
  }

  /** Make @p n steps of size @p h; @p afresh: each with new factors, as far as Newton's method can get. */
  inline Record
  run(const System      &system,
      const State       &start,
      Integrator        &integrator,
      const double       h,
      const unsigned int n,
      const bool         afresh = false)
  {
    Record record;
    record.state  = start;
    double before = energy_of(system, start), imbalance = 0;
    record.energy = before;
    for (; record.n_steps < n; ++record.n_steps)
      {
        if (afresh)
          integrator.forget_history();
        const StepResult step = integrator.step(record.state, h);
        if (!step.converged)
          break;
        const double after = energy_of(system, record.state);
        record.energy = std::max({record.energy, after, std::abs(step.work_of_loads), std::abs(step.work_of_drives)});
        imbalance     = std::max(imbalance,
                             std::abs(after - before - step.work_of_loads - step.work_of_drives + step.viscous_loss +
                                      step.dissipated));
        before        = after;
        record.work_of_loads += step.work_of_loads;
        record.work_of_drives += step.work_of_drives;
        record.viscous_loss += step.viscous_loss;
        record.dissipated += step.dissipated;
        record.least_dissipated = std::min(record.least_dissipated, step.dissipated);
        record.gap              = std::max(record.gap, largest_gap(system, record.state));
        record.skewness         = std::max(record.skewness, largest_skewness(system, record.state));
      }
    record.balance = imbalance / record.energy;
    return record;
  }

  inline Record
  run(const System      &system,
      const State       &start,
      const Tableau     &tableau,
      const double       h,
      const unsigned int n,
      const bool         afresh = false)
  {
    StageIntegrator integrator(system, tableau, 1e-14);
    return run(system, start, integrator, h, n, afresh);
  }

  /** Relative distance of two vectors. */
  inline double
  distance(const std::vector<double> &a, const std::vector<double> &b)
  {
    double square = 0, norm = 0;
    for (unsigned int i = 0; i < b.size(); ++i)
      {
        square += std::pow(a[i] - b[i], 2);
        norm += std::pow(b[i], 2);
      }
    return norm > 0 ? std::sqrt(square / norm) : std::sqrt(square);
  }

  /** Call @p check with every s and ρ∞ = 1, ½, 0. */
  template <typename Check>
  void
  for_all_members(const Check &check)
  {
    for (const unsigned int s : {1, 2, 3})
      for (const double rho : {1., 0.5, 0.})
        {
          SCOPED_TRACE("s = " + std::to_string(s) + ", rho = " + std::to_string(rho));
          check(Tableau(s, rho));
        }
  }
} // namespace samara

#endif
