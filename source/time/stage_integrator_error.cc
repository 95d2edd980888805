// What a step says about its own error: its neighbour in α, and the loads between the stages.
//
// The stage equations differentiated by α at the converged stages are one right-hand side for the matrices of Newton's
// method, the rank-one matrix of the family times the highest modes of the rates (doc/theory/step_control.md):
//
//     ∂r_k/∂α = −(w p)_k/(2(2s−1)) M u + B₀ᵀ C h p_k/(2(2s−1)) v,     u = Σ b_k p_k ẏ_k,  v = Σ b_k p_k ė_k
//
// and −(w p)_k/(2(2s−1)) Σ b_k p_k ż_k in the rows of the states of first order that count (CountedStates).

#include <samara/time/stage_integrator.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace samara
{
  namespace
  {
    /** Perturbed velocities differ by about this part of the largest: less is round-off, more is not linear. */
    constexpr double perturbation = 1e-5;

    /** Sweeps with old matrices until corrections are below this part; at most so many. */
    constexpr double       good_enough = 0.1;
    constexpr unsigned int most_sweeps = 6;

    /** How often what is not resolved is filtered out. */
    constexpr unsigned int filter_rounds = 3;
  } // namespace



  void
  StageIntegrator::estimate_error(const State &state, const double h, StepDifference &difference)
  {
    const std::vector<Stage>  kept             = stages;
    const std::vector<double> kept_q           = final_q;
    const std::vector<double> kept_coordinates = final_coordinates;
    is_exact                                   = !has_factors(h);
    if (!is_exact && !find_neighbour(state, h, kept, kept_q, difference))
      {
        is_exact = true;
        stages   = kept;
      }
    if (is_exact)
      {
        make_exact();
        find_neighbour(state, h, kept, kept_q, difference);
      }
    final_q           = kept_q;
    final_coordinates = kept_coordinates;
    project_neighbour(state, h, difference);
    stages = kept;
    if (system.layout.n_strains > 0 && !is_exact)
      {
        find_frequency(at_end(state, state.time + h), difference.neighbour);
        resolve(difference.neighbour, difference.resolved);
        if (!system.model.lengths.empty())
          resolve_at_end(state, h, difference);
      }
    if (find_load_defect(state, h))
      {
        if (is_exact)
          solve_exactly_for_increments(h);
        else if (!solve_for_increments(h))
          throw SingularMatrix(-1);
        difference.load      = sum_of_stages(dz_rate, h * tableau.b);
        difference.load_rate = sum_of_stages(dz_rate, final_weights);
      }
    is_exact = false;
  }



  std::vector<double>
  StageIntegrator::sum_of_stages(const std::vector<std::vector<double>> &values, const Eigen::VectorXd &weights) const
  {
    std::vector<double> sum(6 * (system.layout.n_nodes - 1), 0.);
    for (unsigned int k = 0; k < tableau.s; ++k)
      for (unsigned int i = 0; i < sum.size(); ++i)
        sum[i] += weights(k) * values[k][i];
    return sum;
  }



  void
  StageIntegrator::add_derivatives(const std::vector<Vector6> &u, const std::vector<double> &v, const double epsilon)
  {
    const Eigen::VectorXd w_p = tableau.w * tableau.p;
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        Stage &stage = stages[k];
        for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
          Eigen::Map<Vector6>(&stage.residual[system.layout.of_node(node)]) -=
            epsilon * w_p(k) * (system.model.nodes[node].inertia * u[node]);
        for (unsigned int i = 0; i < v.size(); ++i)
          {
            stress_increment[i] = epsilon * tableau.p(k) * v[i];
            stage.excess[i] += stress_increment[i];
          }
        strains_in_matrix(k).add_forces(stress_increment.data(), stage.residual.data());
        for (unsigned int i = 0; i < state_modes.size(); ++i)
          stage.residual[system.layout.of_state(i)] -= epsilon * w_p(k) * state_modes[i];
      }
  }



  double
  StageIntegrator::find_state_modes(const State &state, const double h)
  {
    state_modes.clear();
    double       largest = 0;
    const double factor  = 1 / (2 * (2. * tableau.s - 1));
    for (const CountedStates &group : counted)
      if (group.weight > 0)
        {
          state_modes.resize(system.layout.n_states, 0.);
          double change = 0, size = 0;
          for (unsigned int i = 0; i < group.states.size(); ++i)
            {
              const unsigned int j = group.states[i];
              for (unsigned int k = 0; k < tableau.s; ++k)
                state_modes[j] += factor * tableau.b(k) * tableau.p(k) * stages[k].state_rates[j];
              change += group.metric[i] * std::pow(h * state_modes[j], 2);
              size += group.metric[i] * std::pow(std::max(std::abs(state.states[j]), system.model.states[j].scale), 2);
            }
          if (size > 0)
            largest = std::max(largest, std::sqrt(change / size));
        }
    return largest;
  }



  void
  StageIntegrator::evaluate_difference(const State &state, const double h, const std::vector<Stage> &base)
  {
    move_stages(state, h);
    evaluate(state, h);
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        for (unsigned int i = 0; i < stages[k].residual.size(); ++i)
          stages[k].residual[i] -= base[k].residual[i];
        for (unsigned int i = 0; i < stages[k].excess.size(); ++i)
          stages[k].excess[i] -= base[k].excess[i];
      }
  }



  bool
  StageIntegrator::find_neighbour(const State               &state,
                                  const double               h,
                                  const std::vector<Stage>  &base,
                                  const std::vector<double> &base_q,
                                  StepDifference            &difference)
  {
    const unsigned int         s = tableau.s, n_nodes = system.layout.n_nodes;
    const double               factor = 1 / (2 * (2. * s - 1));
    const std::vector<double> &start  = admissible_velocities(state);
    std::vector<Vector6>       u(n_nodes);
    double                     squares = 0;
    for (unsigned int node = 1; node < n_nodes; ++node)
      {
        u[node] = factor * highest_mode(start, node, h);
        squares += h * h * u[node].dot(system.model.nodes[node].inertia * u[node]);
      }
    // stresses of h v
    std::vector<double> v(system.layout.n_strains, 0.);
    std::fill(rate_increment.begin(), rate_increment.end(), 0.);
    std::fill(strain_increment.begin(), strain_increment.end(), 0.);
    for (unsigned int k = 0; k < s; ++k)
      for (unsigned int i = 0; i < v.size(); ++i)
        strain_increment[i] += h * factor * tableau.b(k) * tableau.p(k) * stages[k].strain_rates[i];
    change_of_stresses(s / 2, strain_increment.data(), rate_increment.data(), v);
    squares += 2 * system.strain_energy(strain_increment.data());
    difference.neighbour.displacement.assign(6 * (n_nodes - 1), 0.);
    difference.neighbour.rate.assign(6 * n_nodes, 0.);
    const double of_states = find_state_modes(state, h);
    difference.states.assign(state_modes.size(), 0.);
    if (!(squares > 0) && !(of_states > 0))
      return true;

    // Newton's method for the neighbour, a little way off
    double epsilon = std::numeric_limits<double>::infinity(), total = 0, size = 0;
    if (squares > 0)
      epsilon = perturbation * std::sqrt(2 * std::max(kinetic_energy, energy_scale) / squares);
    if (of_states > 0)
      epsilon = std::min(epsilon, perturbation / of_states);
    for (unsigned int sweep = 0; sweep < most_sweeps && (sweep < 2 || size > good_enough * total); ++sweep)
      {
        if (sweep > 0)
          evaluate_difference(state, h, base);
        else
          for (Stage &stage : stages)
            {
              std::fill(stage.residual.begin(), stage.residual.end(), 0.);
              std::fill(stage.excess.begin(), stage.excess.end(), 0.);
            }
        add_derivatives(u, v, epsilon);
        size = is_exact ? solve_exactly(h) : solve(h);
        if (!std::isfinite(size))
          return false;
        correct_stresses();
        total += size;
      }
    move_stages(state, h);
    measure_neighbour(h, epsilon, base, base_q, u, difference);
    // sweeps whose last correction is more than half of their sum do not converge
    return size <= 0.5 * total;
  }



  void
  StageIntegrator::measure_neighbour(const double                h,
                                     const double                epsilon,
                                     const std::vector<Stage>   &base,
                                     const std::vector<double>  &base_q,
                                     const std::vector<Vector6> &u,
                                     StepDifference             &difference) const
  {
    const unsigned int s        = tableau.s;
    const double       of_start = final_weights.dot(tableau.p);
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const Eigen::Map<const Vector3> x(&final_q[12 * node]), x_base(&base_q[12 * node]);
        const Eigen::Map<const Matrix3> D(&final_q[12 * node + 3]), D_base(&base_q[12 * node + 3]);
        Eigen::Map<Vector6>             q(&difference.neighbour.displacement[6 * node - 6]),
          y(&difference.neighbour.rate[6 * node]);
        q << D_base.transpose() * (x - x_base) / epsilon, axial(D_base.transpose() * (D - D_base)) / epsilon;
        y = -of_start * h * u[node];
        for (unsigned int k = 0; k < s; ++k)
          y += final_weights(k) / epsilon *
               (Eigen::Map<const Vector6>(&stages[k].y[6 * node]) - Eigen::Map<const Vector6>(&base[k].y[6 * node]));
      }
    for (unsigned int i = 0; i < state_modes.size(); ++i)
      {
        difference.states[i] = -of_start * h * state_modes[i];
        for (unsigned int k = 0; k < s; ++k)
          difference.states[i] += final_weights(k) / epsilon * (stages[k].states[i] - base[k].states[i]);
      }
  }



  void
  StageIntegrator::project_neighbour(const State &state, const double h, StepDifference &difference)
  {
    const State end = at_end(state, state.time + h);
    if (!projection)
      projection = std::make_unique<Projection>(system);
    try
      {
        projection->increments(end, difference.neighbour.rate, difference.driven);
      }
    catch (const SingularMatrix &)
      {
        // something without mass moves freely: left as it is
        difference.driven.assign(end.y.size(), 0.);
      }
    difference.neighbour.rate.erase(difference.neighbour.rate.begin(), difference.neighbour.rate.begin() + 6);
  }



  std::vector<double>
  StageIntegrator::resolved_part(const std::vector<double> &displacement)
  {
    // (M + (hμ)² K)⁻¹ M under the constraints, for the real eigenvalue (twice for one stage), and for the complex pair
    const Layout       &layout = system.layout;
    const unsigned int  n      = displacement.size();
    std::vector<double> part   = displacement;
    const auto          masses = [&](auto &x, const auto &of) {
      x.assign(system.size(), 0.);
      for (unsigned int node = 1; node < layout.n_nodes; ++node)
        {
          using Vector = Eigen::Matrix<typename std::decay_t<decltype(of)>::value_type, 6, 1>;
          const Eigen::Map<const Vector> v(&of[6 * node - 6]);
          Eigen::Map<Vector>             Mv(&x[6 * node - 6]);
          Mv = system.model.nodes[node].inertia * v;
        }
    };
    std::vector<std::complex<double>> z;
    for (unsigned int round = 0; round < filter_rounds; ++round)
      for (const Factor &factor : factors)
        if (factor.real)
          for (unsigned int i = 0; i < (tableau.s == 1 ? 2 : 1); ++i)
            {
              masses(x_real, part);
              factor.real->solve(x_real.data());
              std::copy_n(x_real.begin(), n, part.begin());
            }
        else
          {
            z.assign(part.begin(), part.end());
            for (unsigned int i = 0; i < 2; ++i)
              {
                masses(x, z);
                factor.complex->solve(x.data());
                for (unsigned int j = 0; j < n; ++j)
                  z[j] = std::conj(x[j]);
              }
            for (unsigned int j = 0; j < n; ++j)
              part[j] = z[j].real();
          }
    return part;
  }



  void
  StageIntegrator::resolve(const StepDifference::Field &whole, StepDifference::Field &resolved)
  {
    resolved.displacement = resolved_part(whole.displacement);
    resolved.rate         = resolved_part(whole.rate);
    find_frequency(frozen, resolved); // for that configuration the rest is filtered out
  }



  void
  StageIntegrator::resolve_at_end(const State &state, const double h, StepDifference &difference)
  {
    // Newton's method goes on with what it has
    if (factors_at_end.empty())
      factors_at_end = new_factors();
    const State  kept_frozen    = frozen;
    const double kept_scales[]  = {factored_step, step_of_factors, extra_iterations};
    const auto   kept_n         = n_steps_with_factors;
    const auto   kept_gap_scale = gap_scale;
    std::swap(factors, factors_at_end);

    freeze(state, h);
    frozen.q           = final_q;
    frozen.coordinates = final_coordinates;
    frozen.time        = state.time + h;
    factorize(h);
    resolve(difference.neighbour, difference.resolved_at_end);

    std::swap(factors, factors_at_end);
    frozen               = kept_frozen;
    factored_step        = kept_scales[0];
    step_of_factors      = kept_scales[1];
    extra_iterations     = kept_scales[2];
    n_steps_with_factors = kept_n;
    gap_scale            = kept_gap_scale;
    Point<double> point  = frozen.point();
    point.multipliers    = no_multipliers.data();
    frozen_strains->renew(point);
    forget_columns();
  }



  void
  StageIntegrator::find_frequency(State at, StepDifference::Field &field)
  {
    // strains and kinetic energy of the rates
    std::fill(at.rates.begin(), at.rates.end(), 0.);
    std::copy(field.rate.begin(), field.rate.end(), at.y.begin() + 6);
    system.strain_rates(at.point(), strain_increment.data());
    const double strain  = system.strain_energy(strain_increment.data());
    double       kinetic = 0;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const Eigen::Map<const Vector6> y(&at.y[6 * node]);
        kinetic += 0.5 * y.dot(system.model.nodes[node].inertia * y);
      }
    field.frequency = kinetic > 0 ? std::sqrt(strain / kinetic) : 0.;
  }



  void
  StageIntegrator::add_loads(const double time, const double weight, Stage &stage)
  {
    Point<double> point = stage.point();
    point.time          = time;
    force.assign(system.size() + 6, 0.);
    system.add_loads(point, force.data());
    for (unsigned int i = 0; i < load_defect.size(); ++i)
      {
        load_defect[i] += weight * force[i];
        load_sum[i] += std::abs(weight * force[i]);
      }
  }



  bool
  StageIntegrator::find_load_defect(const State &state, const double h)
  {
    if (system.n_loads() == 0)
      return false;
    static const std::array<dealii::QGauss<1>, 3> finer = {
      {dealii::QGauss<1>(3), dealii::QGauss<1>(5), dealii::QGauss<1>(7)}};
    load_defect.assign(system.layout.of_multiplier(0), 0.);
    load_sum.assign(load_defect.size(), 0.);
    // where the middle of the step is
    Stage &middle = stages[(tableau.s - 1) / 2];
    for (unsigned int k = 0; k < tableau.s; ++k)
      add_loads(stages[k].time, -tableau.b(k), middle);
    const auto &rule = finer[tableau.s - 1];
    for (unsigned int i = 0; i < rule.size(); ++i)
      add_loads(state.time + h * rule.point(i)(0), rule.weight(i), middle);
    double largest = 0, defect = 0;
    for (unsigned int i = 0; i < load_defect.size(); ++i)
      {
        largest = std::max(largest, load_sum[i]);
        defect  = std::max(defect, std::abs(load_defect[i]));
      }
    // round-off of the quadratures, as of loads that do not change within the step
    if (!(defect > 1e-12 * largest))
      return false;
    for (Stage &stage : stages)
      {
        stage.residual.assign(system.size() + 6, 0.);
        std::copy(load_defect.begin(), load_defect.end(), stage.residual.begin());
      }
    return true;
  }
} // namespace samara
