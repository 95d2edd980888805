#include <samara/model/strain_products.h>
#include <samara/time/rival_energy_decaying.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace samara
{
  EnergyDecaying::EnergyDecaying(const System &system, const IntegratorSettings &settings)
    : system(system)
    , settings(settings)
    , alpha((1 - settings.spectral_radius) / (1 + settings.spectral_radius))
    , measure(system)
    , matrix(system.layout.pattern)
    , M(system.layout.pattern)
    , C(system.layout.pattern)
    , K(system.layout.pattern)
    , is_active(rivals::active_multipliers(system))
    , is_nonholonomic(rivals::nonholonomic_multipliers(system))
    , frozen_strains(system.linear_strains())
  {
    if (!strain_products(system.model).empty())
      throw std::invalid_argument(
        "energy decaying: tension that stiffens torsion (<Trapeze effect>, <Trapeze coupling>) "
        "is not among its strains; take the integrator <family>, or a section without it");
    system.mass(M);
    for (const auto &node : system.model.nodes)
      {
        const Matrix3 coupling = node.inertia.bottomLeftCorner<3, 3>(), linear = node.inertia.topLeftCorner<3, 3>();
        const double  mass = linear.trace() / 3;
        if ((linear - mass * Matrix3::Identity()).norm() > 1e-9 * mass)
          throw std::invalid_argument("energy decaying: " + node.name +
                                      " has different masses in different directions");
        const Vector3 centre = mass > 0 ? Vector3(axial(coupling) / mass) : Vector3::Zero();
        masses.push_back({mass, centre, node.inertia.bottomRightCorner<3, 3>() + mass * skew(centre) * skew(centre)});
      }
  }



  void
  EnergyDecaying::forget_history()
  {
    factored_step = 0;
  }



  void
  EnergyDecaying::predict(const State &state, const double h)
  {
    const unsigned int n = system.layout.n_nodes;
    j.end = f.end = state;
    j.end.multipliers.assign(system.layout.n_multipliers, 0.);
    // before a corner, what is prescribed has its value of before
    const double end = state.time + h, tiny = 1e-6 * h;
    f.end.time = rivals::is_corner(system, end, tiny) ? end - tiny : end;
    V_start.assign(n, Vector3::Zero());
    for (unsigned int node = 1; node < n; ++node)
      {
        const Eigen::Map<const Vector3> v(&state.y[6 * node]), spin(&state.y[6 * node + 3]);
        V_start[node] = state.triad(node) * (v + spin.cross(masses[node].centre));
        rivals::move(f.end, node, h * Eigen::Map<const Vector6>(&state.y[6 * node]));
      }
    for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
      f.end.coordinates[i] += h * state.rates[i];
    for (auto *const stage : {&j, &f})
      {
        stage->mean = state;
        stage->excess.assign(system.layout.n_strains, 0.);
        stage->V.assign(n, Vector3::Zero());
        stage->W.assign(n, Vector3::Zero());
        stage->spin.assign(n, Vector3::Zero());
        stage->rates.assign(system.layout.n_coordinates, 0.);
      }
    f.mean.time = state.time + 0.5 * h;
    f.stress    = state.stress;
    j.stress.assign(system.layout.n_strains, 0.);
    system.strains(state, e_start);
  }



  void
  EnergyDecaying::mean_of(const State &state, const double over_h, Stage &stage) const
  {
    for (unsigned int i = 0; i < state.q.size(); ++i)
      stage.mean.q[i] = 0.5 * (state.q[i] + stage.end.q[i]);
    for (unsigned int i = 0; i < state.coordinates.size(); ++i)
      {
        stage.mean.coordinates[i] = 0.5 * (state.coordinates[i] + stage.end.coordinates[i]);
        stage.mean.rates[i]       = over_h * (stage.end.coordinates[i] - state.coordinates[i]);
      }
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const Vector3 &centre = masses[node].centre;
        const Matrix3  D_i = state.triad(node), D = stage.end.triad(node);
        const Vector3  u = over_h * (stage.end.position(node) - state.position(node));
        stage.W[node]    = u + over_h * ((D - D_i) * centre);
        // not orthonormal: N(q) y must be the difference exactly
        Eigen::Map<Vector6>(&stage.mean.y[6 * node]) << stage.mean.triad(node).inverse() * u,
          over_h * inverse_cayley(D_i.transpose() * D);
      }
    stage.mean.multipliers = stage.end.multipliers;
  }



  void
  EnergyDecaying::means(const State &state, const double h)
  {
    mean_of(state, 1 / h, f);
    mean_of(state, -6 / h, j);
    // ½ (Y_j + Y_f) and Y_f − α Y_j − (1 − α) Y_i are known by now
    const auto solve = [&](const auto &mean, const auto &bracket, const auto &start, auto &y_j, auto &y_f) {
      y_j = (2 * mean - bracket - (1 - alpha) * start) / (1 + alpha);
      y_f = 2 * mean - y_j;
    };
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        solve(f.W[node], j.W[node], V_start[node], j.V[node], f.V[node]);
        const Vector3 mean    = Eigen::Map<const Vector3>(&f.mean.y[6 * node + 3]),
                      bracket = Eigen::Map<const Vector3>(&j.mean.y[6 * node + 3]),
                      start   = Eigen::Map<const Vector3>(&state.y[6 * node + 3]);
        solve(mean, bracket, start, j.spin[node], f.spin[node]);
      }
    for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
      solve(f.mean.rates[i], j.mean.rates[i], state.rates[i], j.rates[i], f.rates[i]);
  }



  std::vector<double>
  EnergyDecaying::loads(const State &state) const
  {
    std::vector<double> force(system.size() + 6, 0.);
    system.add_loads(state.point(), force.data());
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const Matrix3       D = state.triad(node).transpose().inverse();
        Eigen::Map<Vector3> F(&force[6 * (node - 1)]), moment(&force[6 * (node - 1) + 3]);
        F      = (D * F).eval();
        moment = (D * moment).eval();
      }
    return force;
  }



  void
  EnergyDecaying::rotate_to(const State &frames, std::vector<double> &force) const
  {
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const Matrix3       D = frames.triad(node);
        Eigen::Map<Vector3> F(&force[6 * (node - 1)]), moment(&force[6 * (node - 1) + 3]);
        F      = (D.transpose() * F).eval();
        moment = (D.transpose() * moment).eval();
      }
  }



  void
  EnergyDecaying::evaluate_stage(const State &state, const double h, const std::vector<double> &strains, Stage &stage)
  {
    // stresses of the strains and of the rates of the mean motion; forces and constraints
    const Layout       &layout = system.layout;
    std::vector<double> rates(layout.n_strains, 0.), at_end(system.size() + 6, 0.);
    stage.r.assign(system.size() + 6, 0.);
    system.strain_rates(stage.mean.point(), rates.data());
    system.stresses(strains.data(), rates.data(), stage.excess.data());
    for (unsigned int i = 0; i < layout.n_strains; ++i)
      stage.excess[i] -= stage.stress[i];
    stage.mean.stress = stage.stress;
    system.add_terms(stage.mean.point(), stage.r.data());
    system.add_constraints(stage.end.point(), at_end.data());
    const std::vector<double> constraint_rates = rivals::constraint_rates(system, stage.mean);
    const bool                is_j             = &stage == &j;
    for (unsigned int i = 0; i < layout.n_multipliers; ++i)
      {
        const int row = layout.of_multiplier(i);
        stage.r[row]  = !is_active[i]      ? 0. :
                        is_nonholonomic[i] ? constraint_rates[i] * (is_j ? -h / 6 : h) :
                                             at_end[row];
      }

    const double factor = is_j ? -6 / h : 1 / h;
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      {
        const NodalMass                &m = masses[node];
        const Eigen::Map<const Vector3> spin_start(&state.y[6 * node + 3]), mean_spin(&stage.mean.y[6 * node + 3]);
        const Vector3                   carried = is_j ? Vector3(0.5 * (spin_start + stage.spin[node])) : mean_spin;
        const Vector3 force = stage.mean.triad(node).transpose() * (factor * m.mass * (stage.V[node] - V_start[node]));
        Eigen::Map<Vector3> r_force(&stage.r[6 * (node - 1)]), r_moment(&stage.r[6 * (node - 1) + 3]);
        r_force += force;
        r_moment += factor * (m.inertia * (stage.spin[node] - spin_start)) - (m.inertia * carried).cross(mean_spin) +
                    m.centre.cross(force);
      }
  }



  void
  EnergyDecaying::evaluate(const State &state, const double h)
  {
    means(state, h);
    for (auto *const stage : {&j, &f})
      system.strains(stage->end, stage->strains);
    std::vector<double> mean(e_start.size()), bracket(e_start.size());
    for (unsigned int i = 0; i < mean.size(); ++i)
      {
        mean[i]    = 0.5 * (j.strains[i] + f.strains[i]);
        bracket[i] = f.strains[i] - alpha * j.strains[i] - (1 - alpha) * e_start[i];
      }
    evaluate_stage(state, h, mean, f);
    evaluate_stage(state, h, bracket, j);

    // the loads of the second equation are a difference, too
    if (system.n_loads() > 0)
      {
        const std::vector<double> at_f = loads(f.end), at_j = loads(j.end), at_i = loads(state),
                                  counted = loads(j.mean);
        std::vector<double> difference(counted.size());
        for (unsigned int i = 0; i < difference.size(); ++i)
          difference[i] = at_f[i] - alpha * at_j[i] - (1 - alpha) * at_i[i] - counted[i];
        rotate_to(j.mean, difference);
        for (int i = 0; i < system.layout.of_multiplier(0); ++i)
          j.r[i] += difference[i];
      }
  }



  void
  EnergyDecaying::find_middle(const State &state)
  {
    middle.assign(system.layout.n_nodes, Matrix3::Identity());
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const Matrix3 D = state.triad(node);
        middle[node]    = D * rotation_of_vector(0.5 * vector_of_rotation(D.transpose() * f.end.triad(node)));
      }
  }



  void
  EnergyDecaying::factorize(const double h)
  {
    // forces in the middle of the step, without velocities: those are inertial here
    frozen = f.mean;
    std::fill(frozen.y.begin(), frozen.y.end(), 0.);
    std::fill(frozen.rates.begin(), frozen.rates.end(), 0.);
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      Eigen::Map<Matrix3>(&frozen.q[12 * node + 3]) = middle[node];
    system.tangent(frozen, K);
    system.damping(frozen, C);
    std::fill(frozen.multipliers.begin(), frozen.multipliers.end(), 0.);
    frozen_strains->renew(frozen.point());
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        Matrix6 inertia                   = Matrix6::Zero();
        inertia.bottomRightCorner<3, 3>() = masses[node].inertia;
        rivals::add_to_node(C,
                            system.layout,
                            node,
                            gyroscopic_tangent(inertia, Eigen::Map<const Vector6>(&f.mean.y[6 * node])));
      }
    // unknowns: displacements and multipliers of j, then of f
    const int    n = system.layout.of_multiplier(0);
    const double a = 1 / (h * h * (1 + alpha));
    const auto   blocks =
      [&](const unsigned int row, const unsigned int column, const double m, const double c, const double k) {
        matrix.add(row, column, [&](const int i, const int l, const int position) {
          if (i < n && l < n)
            return m * M.values[position] + c * C.values[position] + k * K.values[position];
          return row == column ? K.values[position] : 0.;
        });
      };
    // by means(), V_j = (2 u_f + 6 u_j)/(h (1 + α)) and V_f = 2 u_f/h − V_j, behind the factors −6/h and 1/h of both
    // rows
    matrix.clear();
    blocks(1, 1, 2 * alpha * a, 1 / h, 0.5);
    blocks(1, 0, -6 * a, 0, 0.5);
    blocks(0, 1, -12 * a, 0, 1);
    blocks(0, 0, -36 * a, -6 / h, -alpha);
    matrix.factorize();
    factored_step = h;
  }



  double
  EnergyDecaying::correct(const double h)
  {
    const unsigned int  n = system.size();
    std::vector<double> x(2 * n);
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        // rows of j in the frames of the middle
        const Matrix3       Q = middle[node].transpose() * j.mean.triad(node);
        Eigen::Map<Vector3> F(&j.r[6 * (node - 1)]), moment(&j.r[6 * (node - 1) + 3]);
        F      = (Q * F).eval();
        moment = (Q * moment).eval();
      }
    // the stresses that are missing act where the matrix was made (doc/theory/integrators.md)
    for (auto *const stage : {&j, &f})
      {
        const int                 n_forces = system.layout.of_multiplier(0);
        const std::vector<double> constraints(stage->r.begin() + n_forces, stage->r.end());
        frozen_strains->add_forces(stage->excess.data(), stage->r.data());
        std::copy(constraints.begin(), constraints.end(), stage->r.begin() + n_forces);
      }
    for (unsigned int i = 0; i < n; ++i)
      {
        x[i]     = -j.r[i];
        x[n + i] = -f.r[i];
      }
    matrix.solve(x.data());
    std::vector<double> z(n), rates(n);
    for (unsigned int i = 0; i < n; ++i)
      {
        z[i]     = 0.5 * (x[i] + x[n + i]);
        rates[i] = x[n + i] / h;
      }
    correct_stresses(z, rates, f);
    for (unsigned int i = 0; i < n; ++i)
      {
        z[i]     = x[n + i] - alpha * x[i];
        rates[i] = -6 / h * x[i];
      }
    correct_stresses(z, rates, j);
    correct_end(x.data(), j);
    correct_end(x.data() + n, f);
    return std::max(size_of_velocities(x.data() + n, h), size_of_multipliers(x));
  }



  double
  EnergyDecaying::size_of_velocities(const double *const zeta, const double h) const
  {
    State changes = f.mean;
    for (unsigned int i = 0; i < 6 * (system.layout.n_nodes - 1); ++i)
      changes.y[6 + i] = zeta[i] / h;
    for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
      changes.rates[i] = zeta[system.layout.of_coordinate(i)] / h;
    // velocities that turn or move by less than a thousandth in a step are too small to be a measure
    return measure.largest(changes.y, changes.rates) / std::max(1e-3 / h, measure.largest(f.mean.y, f.mean.rates));
  }



  double
  EnergyDecaying::size_of_multipliers(const std::vector<double> &x) const
  {
    // forces across the constraints leave the velocities as they are: multipliers have to converge, too
    double change = 0, largest = 0;
    for (const auto *const stage : {&j, &f})
      for (unsigned int i = 0; i < system.layout.n_multipliers; ++i)
        {
          change  = std::max(change, std::abs(x[(stage == &f ? system.size() : 0) + system.layout.of_multiplier(i)]));
          largest = std::max(largest, std::abs(stage->end.multipliers[i]));
        }
    return largest > 0 ? std::sqrt(settings.newton_tolerance) * change / largest : 0.;
  }



  void
  EnergyDecaying::correct_end(const double *const zeta, Stage &stage) const
  {
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        Eigen::Map<const Vector3> u(zeta + 6 * (node - 1)), phi(zeta + 6 * (node - 1) + 3);
        Eigen::Map<Vector3>       x_end(&stage.end.q[12 * node]);
        Eigen::Map<Matrix3>       D(&stage.end.q[12 * node + 3]);
        x_end += middle[node] * u;
        D = renormalised(D * cayley<double>(D.transpose() * (middle[node] * phi)));
      }
    for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
      stage.end.coordinates[i] += zeta[system.layout.of_coordinate(i)];
    for (unsigned int i = 0; i < system.layout.n_multipliers; ++i)
      stage.end.multipliers[i] += zeta[system.layout.of_multiplier(i)];
  }



  void
  EnergyDecaying::correct_stresses(const std::vector<double> &z, const std::vector<double> &rates, Stage &stage) const
  {
    const Layout       &layout = system.layout;
    std::vector<double> twists(6 * layout.n_nodes, 0.), e(layout.n_strains, 0.), e_rates(e), change(e);
    const auto          strains = [&](const std::vector<double> &increments, std::vector<double> &result) {
      std::copy_n(increments.begin(), 6 * (layout.n_nodes - 1), twists.begin() + 6);
      frozen_strains->strains(twists.data(), increments.data() + layout.of_coordinate(0), result.data());
    };
    strains(z, e);
    strains(rates, e_rates);
    system.stresses(e.data(), e_rates.data(), change.data());
    for (unsigned int i = 0; i < layout.n_strains; ++i)
      stage.stress[i] += stage.excess[i] + change[i];
  }



  StepResult
  EnergyDecaying::find_stages(const State &begin, const double h)
  {
    constexpr double    slow = 0.3;
    StepResult          result;
    rivals::Corrections corrections(factored_step > 0 && std::abs(factored_step / h - 1) < 1e-6,
                                    slow,
                                    settings.newton_tolerance);
    predict(begin, h);
    while (result.iterations < settings.max_iterations && !result.converged)
      {
        evaluate(begin, h);
        find_middle(begin);
        if (corrections.need_factors())
          {
            factorize(h);
            ++n_factorizations;
          }
        result.last_correction = correct(h);
        ++result.iterations;
        ++n_iterations;
        const auto verdict = corrections.judge(result.last_correction);
        if (verdict == rivals::Corrections::Verdict::diverged)
          break;
        if (verdict == rivals::Corrections::Verdict::again)
          predict(begin, h);
        result.converged = verdict == rivals::Corrections::Verdict::converged;
      }
    return result;
  }



  double
  EnergyDecaying::energy_of_jump(const State &begin)
  {
    double energy = 0;
    system.strains(j.end, j.strains);
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const Vector3 spin = j.spin[node] - Eigen::Map<const Vector3>(&begin.y[6 * node + 3]);
        energy +=
          0.5 * alpha *
          (masses[node].mass * (j.V[node] - V_start[node]).squaredNorm() + spin.dot(masses[node].inertia * spin));
      }
    for (unsigned int i = 0; i < e_start.size(); ++i)
      j.strains[i] -= e_start[i];
    return energy + alpha * system.strain_energy(j.strains.data());
  }



  StepResult
  EnergyDecaying::step(State &state, const double h)
  {
    State begin       = state;
    begin.held        = false;
    StepResult result = find_stages(begin, h);
    if (!result.converged)
      {
        result.worst  = rivals::largest_of(f.r, system.layout.of_multiplier(0));
        factored_step = 0;
        return result;
      }
    means(begin, h);
    jump_energy = energy_of_jump(begin);

    State after = f.end;
    after.time  = begin.time + h;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      Eigen::Map<Vector6>(&after.y[6 * node])
        << after.triad(node).transpose() * f.V[node] - f.spin[node].cross(masses[node].centre),
        f.spin[node];
    after.rates = f.rates;
    system.stresses(after, after.stress);
    // powers of the mean motion
    rivals::Powers work;
    work.add(h, rivals::powers(system, f.mean));
    rivals::account(system, state, after, work, result);
    state = after;
    ++n_steps;
    return result;
  }
} // namespace samara
