// Stops in the stages: their forces, and what they do to the corrections of Newton's method.
//
// The factors know nothing of stops. With the compliance of the rest at the stops, W = P A⁻¹ Pᵀ, the forces that belong
// to a correction are solved for exactly, stage by stage, however stiff they are and whichever of them open or close:
//
//     η = η₀ − W (f(ġ + η) − f(ġ)),     η₀ the correction of the gaps' rates that the factors give.

#include <samara/time/stage_integrator.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  const double *
  StageIntegrator::gap_rates(const unsigned int i, double *const rates) const
  {
    const Layout::Stop &stop = system.layout.stops[i];
    for (unsigned int k = 0; k < tableau.s; ++k)
      rates[k] = stop.side * stages[k].rates[stop.coordinate];
    return rates;
  }



  void
  StageIntegrator::start_stops(const State &state)
  {
    const auto &stops = system.layout.stops;
    gaps.resize(stops.size());
    stop_forces_now.resize(stops.size());
    free_rates.resize(tableau.s * stops.size());
    columns.resize(system.layout.n_coordinates);
    for (unsigned int i = 0; i < stops.size(); ++i)
      gaps[i] = stops[i].side * (state.coordinates[stops[i].coordinate] - stops[i].place);
  }



  void
  StageIntegrator::evaluate_stops(const double h)
  {
    double rates[3];
    for (unsigned int i = 0; i < gaps.size(); ++i)
      {
        const Layout::Stop &stop = system.layout.stops[i];
        stop_forces_now[i]       = stop_forces(stop, tableau, gaps[i], gap_rates(i, rates), h);
        for (unsigned int k = 0; k < tableau.s; ++k)
          stages[k].residual[system.layout.of_coordinate(stop.coordinate)] += stop.side * stop_forces_now[i].force[k];
      }
  }



  const StageIntegrator::Column &
  StageIntegrator::column(const unsigned int coordinate)
  {
    Column &c = columns[coordinate];
    if (c.is_known)
      return c;
    c.is_known = true;
    for (const Factor &factor : factors)
      if (factor.real)
        {
          c.real.assign(system.size(), 0.);
          c.real[system.layout.of_coordinate(coordinate)] = 1;
          factor.real->solve(c.real.data());
        }
      else
        {
          c.complex.assign(system.size(), 0.);
          c.complex[system.layout.of_coordinate(coordinate)] = 1;
          factor.complex->solve(c.complex.data());
        }
    return c;
  }



  void
  StageIntegrator::forget_columns()
  {
    for (Column &c : columns)
      c.is_known = false;
  }



  /** η₀ of stop i in stage k. */
  double
  StageIntegrator::free_rate(const unsigned int i, const unsigned int k, const double h) const
  {
    const Layout::Stop &stop = system.layout.stops[i];
    const int           row  = system.layout.of_coordinate(stop.coordinate);
    double              rate = 0;
    for (unsigned int j = 0; j < factors.size(); ++j)
      {
        const auto                &eigenvalue = tableau.eigenvalues[j];
        const std::complex<double> hm         = h * eigenvalue.mu;
        rate += factors[j].real ? eigenvalue.right(k).real() / hm.real() * x_real[row] :
                                  2 * (eigenvalue.right(k) / hm * x[row]).real();
      }
    return stop.side * rate;
  }



  /** Add the block of W between the stops a and b: rates of the gap of a by forces of b. */
  void
  StageIntegrator::compliance(const unsigned int a, const unsigned int b, const double h, Eigen::Ref<Eigen::MatrixXd> W)
  {
    const Layout::Stop &stop_a = system.layout.stops[a], &stop_b = system.layout.stops[b];
    const Column       &c   = column(stop_b.coordinate);
    const int           row = system.layout.of_coordinate(stop_a.coordinate);
    W.setZero();
    for (unsigned int j = 0; j < factors.size(); ++j)
      {
        const auto                &eigenvalue = tableau.eigenvalues[j];
        const std::complex<double> hm         = h * eigenvalue.mu;
        if (factors[j].real)
          W += hm.real() * c.real[row] * (eigenvalue.right * eigenvalue.left.transpose()).real();
        else
          W += 2 * (hm * c.complex[row] * eigenvalue.right * eigenvalue.left.transpose()).real();
      }
    W *= stop_a.side * stop_b.side;
  }



  bool
  StageIntegrator::find_stop_forces(const double h, const bool from_free)
  {
    constexpr unsigned int max_iterations = 30;
    const unsigned int     s = tableau.s, n = s * touched.size();
    double                 rates[3];
    // what would not be noticed in a step counts as small, as in the corrections of all unknowns
    double     scale = 1e-3 / h, size = 0;
    const auto unit = [&](const unsigned int i) {
      return system.model.coordinate_units[system.layout.stops[touched[i]].coordinate] == "m" ? length : 1.;
    };
    StopForces forces;
    rate_changes = from_free ? stop_free : Eigen::VectorXd::Zero(n).eval();
    force_changes.resize(n);
    stop_slopes.setZero(n, n);
    for (unsigned int iteration = 0; iteration < max_iterations; ++iteration)
      {
        for (unsigned int i = 0; i < touched.size(); ++i)
          {
            gap_rates(touched[i], rates);
            for (unsigned int k = 0; k < s; ++k)
              scale = std::max(scale, std::abs(rates[k] += rate_changes(s * i + k)) / unit(i));
            forces = stop_forces(system.layout.stops[touched[i]], tableau, gaps[touched[i]], rates, h);
            for (unsigned int k = 0; k < s; ++k)
              {
                force_changes(s * i + k) = forces.force[k] - stop_forces_now[touched[i]].force[k];
                for (unsigned int l = 0; l < s; ++l)
                  stop_slopes(s * i + k, s * i + l) = forces.slope[k][l];
              }
          }
        stop_matrix.noalias() = stop_compliance * stop_slopes;
        stop_matrix.diagonal().array() += 1;
        const Eigen::VectorXd change =
          stop_matrix.partialPivLu().solve(stop_free - rate_changes - stop_compliance * force_changes);
        if (!change.allFinite())
          return false;
        size = 0;
        for (unsigned int i = 0; i < touched.size(); ++i)
          size = std::max(size, change.segment(s * i, s).lpNorm<Eigen::Infinity>() / unit(i));
        rate_changes += change;
        // Forces belong to the change itself, not to rates that are rounded: of these, stiff stops make forces with
        // errors k h ε|ġ|, of which the compliance makes rates with errors k h² ε|ġ|/m.
        force_changes.noalias() += stop_slopes * change;
        if (size < 1e-15 * scale || (iteration > 3 && size < 1e-11 * scale))
          return true;
      }
    return size < 1e-9 * scale;
  }



  bool
  StageIntegrator::correct_for_stops(const double h)
  {
    const unsigned int s = tableau.s;
    if (gaps.empty())
      return true;
    double     rates[3];
    const auto is_touched = [&](const unsigned int i) {
      gap_rates(i, rates);
      for (unsigned int k = 0; k < s; ++k)
        rates[k] += free_rates[s * i + k];
      return stop_forces_now[i].is_touched ||
             stop_forces(system.layout.stops[i], tableau, gaps[i], rates, h).is_touched;
    };
    touched.clear();
    for (unsigned int i = 0; i < gaps.size(); ++i)
      {
        for (unsigned int k = 0; k < s; ++k)
          free_rates[s * i + k] = free_rate(i, k, h);
        if (is_touched(i))
          touched.push_back(i);
      }
    for (unsigned int n_before = 0; touched.size() > n_before;)
      {
        // forces of those that are touched may bring others into touch
        n_before             = touched.size();
        const unsigned int n = s * touched.size();
        stop_free.resize(n);
        stop_compliance.resize(n, n);
        for (unsigned int i = 0; i < touched.size(); ++i)
          {
            for (unsigned int k = 0; k < s; ++k)
              stop_free(s * i + k) = free_rates[s * touched[i] + k];
            for (unsigned int j = 0; j < touched.size(); ++j)
              compliance(touched[i], touched[j], h, stop_compliance.block(s * i, s * j, s, s));
          }
        if (!find_stop_forces(h, false) && !find_stop_forces(h, true))
          return false;
        for (unsigned int i = 0; i < gaps.size(); ++i)
          if (std::find(touched.begin(), touched.begin() + n_before, i) == touched.begin() + n_before)
            {
              gap_rates(i, rates);
              Eigen::MatrixXd W(s, s);
              for (unsigned int k = 0; k < s; ++k)
                rates[k] += free_rates[s * i + k];
              for (unsigned int j = 0; j < n_before; ++j)
                {
                  compliance(i, touched[j], h, W);
                  const Eigen::VectorXd change = W * force_changes.segment(s * j, s);
                  for (unsigned int k = 0; k < s; ++k)
                    rates[k] -= change(k);
                }
              if (stop_forces(system.layout.stops[i], tableau, gaps[i], rates, h).is_touched)
                touched.push_back(i);
            }
      }
    add_stop_reactions(h);
    return true;
  }



  void
  StageIntegrator::add_stop_reactions(const double h)
  {
    const unsigned int s = tableau.s;
    for (unsigned int i = 0; i < touched.size(); ++i)
      {
        const Layout::Stop &stop = system.layout.stops[touched[i]];
        const Column       &c    = column(stop.coordinate);
        for (unsigned int j = 0; j < factors.size(); ++j)
          {
            const auto                &eigenvalue = tableau.eigenvalues[j];
            const std::complex<double> hm         = h * eigenvalue.mu;
            std::complex<double>       force      = 0;
            for (unsigned int k = 0; k < s; ++k)
              force += eigenvalue.left(k) * force_changes(s * i + k);
            force *= stop.side * hm * hm;
            if (factors[j].real)
              for (unsigned int m = 0; m < x_real.size(); ++m)
                x_real[m] -= force.real() * c.real[m];
            else
              for (unsigned int m = 0; m < x.size(); ++m)
                x[m] -= force * c.complex[m];
          }
      }
  }



  void
  StageIntegrator::account_for_stops(const State &state, const double h, StepResult &result)
  {
    double rates[3];
    for (unsigned int i = 0; i < gaps.size(); ++i)
      {
        gap_rates(i, rates);
        const StopForces forces = stop_forces(system.layout.stops[i], tableau, gaps[i], rates, h);
        if (!forces.is_touched)
          continue;
        result.viscous_loss += forces.loss;
        result.work_defect += std::abs(forces.work_defect);
        result.touched_stops.push_back({i, forces.depth, forces.loss, gaps[i] > 0});
        add_touches(i, tableau, gaps[i], rates, state.time, h, result.touches);
      }
  }
} // namespace samara
