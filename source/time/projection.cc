#include <samara/solvers/part_without.h>
#include <samara/solvers/redundant_rows.h>
#include <samara/time/projection.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  Projection::Projection(const System &system)
    : system(system)
    , K(system.layout.pattern)
    , M(system.layout.pattern)
  {
    system.mass(M);
  }



  void
  Projection::make_solver_without()
  {
    if (solver && left_out == left_out_of_pattern)
      return;
    left_out_of_pattern = left_out;
    // 6×6 masses of nodes, those of coordinates, and constraints
    const Layout &layout   = system.layout;
    const int     n_twists = layout.of_coordinate(0), n_kinematic = layout.of_multiplier(0);
    PartOfPattern part = part_without(layout, *layout.pattern, left_out, [=](const int i, const int j) {
      const bool is_mass = i < n_twists && j < n_twists ? i / 6 == j / 6 : i == j;
      return is_mass || i >= n_kinematic || j >= n_kinematic;
    });
    pattern            = part.pattern;
    kept               = std::move(part.kept);
    saddle             = std::make_unique<SparseMatrix>(pattern);
    solver             = make_solver(pattern);
  }



  void
  Projection::factorize(const State &state, const double least_condition)
  {
    left_out = state.left_out;
    try
      {
        factorize_rows(state);
        if (system.layout.n_multipliers == 0 || solver->reciprocal_condition() > least_condition)
          return;
      }
    catch (const SingularMatrix &)
      {
        if (system.layout.n_multipliers == 0 || is_massless)
          throw;
      }
    // at a singular position more rows depend on others than are redundant: velocities that obey those obey all of them
    auto dependent = RedundantRows(system).dependent_here(state);
    is_massless    = dependent.size() <= left_out.size();
    if (!is_massless)
      left_out = std::move(dependent);
    factorize_rows(state);
  }



  void
  Projection::factorize_rows(const State &state)
  {
    make_solver_without();
    Point<double> free = state.point();
    free.held          = false;
    K.clear();
    system.add_constraint_tangent(free, K);
    const int n = system.layout.of_multiplier(0);
    for (int j = 0, k = 0; j < pattern->size(); ++j)
      for (; k < pattern->column_start[j + 1]; ++k)
        saddle->values[k] = (j < n && pattern->rows[k] < n ? M : K).values[kept[k]];
    // ż = g
    for (int i = system.layout.of_state(0); i < n; ++i)
      saddle->values[pattern->position(i, i)] = 1.;
    system.fix_left_out(left_out, *saddle);
    solver->factorize(*saddle);
  }



  std::vector<double>
  Projection::constraint_rates(const State &state) const
  {
    std::vector<double> rates(system.layout.n_multipliers);
    system.constraint_rates(state.point(), rates.data());
    for (const auto i : left_out)
      rates[i] = 0;
    return rates;
  }



  double
  Projection::velocities(State &state)
  {
    AssertDimension(state.y.size(), 6 * system.layout.n_nodes);
    if (system.layout.n_multipliers == 0)
      return 0;
    system.find_state_rates(state);
    factorize(state, 1e-14);
    return project(state);
  }



  void
  Projection::increments(const State &state, std::vector<double> &dy, std::vector<double> &driven)
  {
    State still = state;
    system.find_state_rates(still);
    std::fill(still.y.begin(), still.y.end(), 0.);
    std::fill(still.rates.begin(), still.rates.end(), 0.);
    State moved = still;
    moved.y     = dy;
    if (system.layout.n_multipliers > 0)
      {
        factorize(state, 1e-14);
        project(still);
        project(moved);
      }
    for (unsigned int i = 0; i < dy.size(); ++i)
      dy[i] = moved.y[i] - still.y[i];
    driven = still.y;
  }



  double
  Projection::project(State &state) const
  {
    const std::vector<double> rates = constraint_rates(state);
    std::vector<double>       b(system.size(), 0.);
    for (unsigned int i = 0; i < rates.size(); ++i)
      b[system.layout.of_multiplier(i)] = -rates[i];
    solver->solve(b.data());
    double change = 0, largest = 1e-300;
    for (unsigned int i = 6; i < state.y.size(); ++i)
      {
        // what was given counts, too: of something that cannot move at all, nothing is left
        largest = std::max(largest, std::abs(state.y[i]));
        state.y[i] += b[i - 6];
        change  = std::max(change, std::abs(b[i - 6]));
        largest = std::max(largest, std::abs(state.y[i]));
      }
    for (unsigned int i = 0; i < state.rates.size(); ++i)
      state.rates[i] += b[system.layout.of_coordinate(i)];
    return change / largest;
  }



  std::vector<double>
  Projection::constraint_rates_after(const State &state, const double dt) const
  {
    State moved = state;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        // constant twist: the screw motion exp(dt y)
        const Vector3 v = Eigen::Map<const Vector3>(&state.y[6 * node]),
                      w = Eigen::Map<const Vector3>(&state.y[6 * node + 3]);
        Eigen::Map<Vector3> x(&moved.q[12 * node]);
        Eigen::Map<Matrix3> D(&moved.q[12 * node + 3]);
        x += D * (dt * v + 0.5 * dt * dt * w.cross(v) + dt * dt * dt / 6 * w.cross(w.cross(v)));
        D = (D * rotation_of_vector(dt * w)).eval();
      }
    for (unsigned int i = 0; i < state.rates.size(); ++i)
      moved.coordinates[i] += dt * state.rates[i];
    for (unsigned int i = 0; i < state.states.size(); ++i)
      moved.states[i] += dt * state.state_rates[i];
    moved.time += dt;
    system.find_state_rates(moved);
    return constraint_rates(moved);
  }



  std::vector<double>
  Projection::accelerations(State &state)
  {
    factorize(state);
    return solve_for_accelerations(state);
  }



  void
  Projection::report(State &state)
  {
    system.find_state_rates(state);
    factorize(state);
    if (system.layout.n_multipliers > 0)
      project(state);
    system.stresses(state, state.stress);
    const std::vector<double> a = solve_for_accelerations(state);
    state.accelerations.assign(6, 0.);
    state.accelerations.insert(state.accelerations.end(), a.begin(), a.end());
  }



  std::vector<double>
  Projection::solve_for_accelerations(State &state) const
  {
    State forces = state;
    forces.held  = false;
    std::fill(forces.multipliers.begin(), forces.multipliers.end(), 0.);
    std::vector<double> r, b(system.size(), 0.);
    system.residual(forces, state.stress, r);
    for (int i = 0; i < system.layout.of_multiplier(0); ++i)
      b[i] = -r[i];

    // Ġ y by differences of fourth order over a time in which nothing turns by more than a thousandth
    double fastest = 1e-3;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      fastest = std::max(fastest, Eigen::Map<const Vector3>(&state.y[6 * node + 3]).norm());
    for (const double rate : state.rates)
      fastest = std::max(fastest, std::abs(rate));
    const double dt = 1e-3 / fastest;
    for (const auto &[steps, weight] : std::array<std::pair<double, double>, 4>{{{-2, 1}, {-1, -8}, {1, 8}, {2, -1}}})
      {
        const auto rates = constraint_rates_after(state, steps * dt);
        for (unsigned int i = 0; i < rates.size(); ++i)
          b[system.layout.of_multiplier(i)] -= weight * rates[i] / (12 * dt);
      }
    for (const auto i : system.released_multipliers())
      b[system.layout.of_multiplier(i)] = 0;
    solver->solve(b.data());
    for (unsigned int i = 0; i < system.layout.n_multipliers; ++i)
      state.multipliers[i] = b[system.layout.of_multiplier(i)];
    b.resize(system.layout.of_multiplier(0));
    return b;
  }
} // namespace samara
