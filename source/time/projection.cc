#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/rotation/matrix6.h>
#include <samara/solvers/anderson.h>
#include <samara/solvers/redundant_rows.h>
#include <samara/time/algebraic_states.h>
#include <samara/time/differences.h>
#include <samara/time/projection.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    using differences::difference;
    using differences::largest_of;
    using differences::limit_of_differences;
    using differences::Values;



    /** Of first order, that constraints depend on. */
    std::vector<int>
    states_of_constraints(const Layout &layout)
    {
      const Pattern   &pattern = *layout.pattern;
      std::vector<int> states;
      for (int j = layout.of_multiplier(0); j < pattern.size() && layout.n_states > 0; ++j)
        for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
          if (const int i = pattern.rows[k]; i >= layout.of_state(0) && i < layout.of_multiplier(0))
            states.push_back(i - layout.of_state(0));
      return states;
    }



    /** On which forces depend: those of signals in laws, and those that press where something rubs. */
    std::vector<unsigned int>
    multipliers_that_act(const Layout &layout)
    {
      std::vector<unsigned int> result = layout.multipliers_in_laws;
      for (const auto &friction : layout.frictions)
        result.insert(result.end(), friction.multipliers.begin(), friction.multipliers.end());
      std::sort(result.begin(), result.end());
      result.erase(std::unique(result.begin(), result.end()), result.end());
      return result;
    }



    Eigen::VectorXd
    values_of(const std::vector<unsigned int> &multipliers, const std::vector<double> &all)
    {
      Eigen::VectorXd result(multipliers.size());
      for (unsigned int i = 0; i < multipliers.size(); ++i)
        result(i) = all[multipliers[i]];
      return result;
    }
  } // namespace



  Projection::Projection(const System &system)
    : system(system)
    , released(system.released_multipliers())
    , acting(multipliers_that_act(system.layout))
    , no_multipliers(system.layout.n_multipliers, 0.)
  {
    sort_nodes();
  }



  void
  Projection::sort_nodes()
  {
    const Layout     &layout = system.layout;
    std::vector<bool> is_bound(layout.n_nodes, false);
    for (int j = layout.of_multiplier(0); j < layout.pattern->size(); ++j)
      for (int k = layout.pattern->column_start[j]; k < layout.pattern->column_start[j + 1]; ++k)
        if (const int i = layout.pattern->rows[k]; i < layout.of_coordinate(0))
          is_bound[1 + i / 6] = true;
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      {
        const Matrix6 &mass = system.model.nodes[node].inertia;
        // where there is none, to round-off, elimination shall say so
        if (is_bound[node] || !(symmetric_rcond(mass) > 1e-14))
          bound.push_back(node);
        else
          free.push_back({node, symmetric_inverse(mass)});
      }
  }



  void
  Projection::make_solver_without()
  {
    if (solver && left_out == left_out_of_solver)
      return;
    left_out_of_solver = left_out;
    // what is bound, by ascending numbers; free nodes know their increments, states theirs
    const Layout &layout   = system.layout;
    const int     n_twists = layout.of_coordinate(0), n_kinematic = layout.of_multiplier(0);
    unknowns.clear();
    for (const auto node : bound)
      for (unsigned int i = 0; i < 6; ++i)
        unknowns.push_back(layout.of_node(node) + i);
    for (unsigned int i = 0; i < layout.n_coordinates; ++i)
      unknowns.push_back(layout.of_coordinate(i));
    std::vector<bool> is_out(layout.n_multipliers, false);
    for (const auto i : left_out)
      is_out[i] = true;
    for (unsigned int i = 0; i < layout.n_multipliers; ++i)
      if (!is_out[i])
        unknowns.push_back(layout.of_multiplier(i));
    std::vector<int> number(system.size(), -1);
    for (unsigned int i = 0; i < unknowns.size(); ++i)
      number[unknowns[i]] = i;

    // 6×6 masses of nodes, those of coordinates, and constraints
    SparseMatrix M(layout.pattern);
    system.mass(M);
    auto pattern = std::make_shared<Pattern>();
    pattern->column_start.push_back(0);
    entries.clear();
    for (const int j : unknowns)
      {
        for (int k = layout.pattern->column_start[j]; k < layout.pattern->column_start[j + 1]; ++k)
          {
            const int  i       = layout.pattern->rows[k];
            const bool is_mass = i < n_kinematic && j < n_kinematic;
            if (number[i] < 0 || (is_mass && i != j && (i >= n_twists || j >= n_twists || i / 6 != j / 6)))
              continue;
            pattern->rows.push_back(number[i]);
            entries.push_back({k, is_mass, is_mass ? M.values[k] : 0.});
          }
        pattern->column_start.push_back(pattern->rows.size());
      }
    saddle = std::make_unique<SparseMatrix>(pattern);
    solver = make_solver(saddle->pattern);
  }



  void
  Projection::factorize(const State &state, const double least_condition)
  {
    left_out = state.left_out;
    // below the least condition asked for a few digits of the solution are left: the state is taken for singular
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
    if (unknowns.empty())
      return;
    Point<double> point = state.point();
    point.held          = false;
    point.multipliers   = no_multipliers.data(); // the rows alone
    if (!K)
      K = std::make_unique<SparseMatrix>(system.layout.pattern);
    // the other columns are many, and never read
    const auto &start = K->pattern->column_start;
    for (const int j : unknowns)
      std::fill(K->values.begin() + start[j], K->values.begin() + start[j + 1], 0.);
    system.add_constraint_tangent(point, *K);
    for (unsigned int k = 0; k < entries.size(); ++k)
      saddle->values[k] = entries[k].is_mass ? entries[k].mass : K->values[entries[k].at];
    try
      {
        solver->factorize(*saddle);
      }
    catch (const SingularMatrix &singular)
      {
        throw SingularMatrix(singular.unknown < 0 ? -1 : unknowns[singular.unknown]);
      }
  }



  void
  Projection::constraint_rates(const Point<double> &point, std::vector<double> &rates) const
  {
    rates.resize(system.layout.n_multipliers);
    system.constraint_rates(point, rates.data());
    for (const auto i : left_out)
      rates[i] = 0;
  }



  void
  Projection::solve(const bool with_forces)
  {
    small_b.resize(unknowns.size());
    for (unsigned int i = 0; i < unknowns.size(); ++i)
      small_b[i] = b[unknowns[i]];
    if (!unknowns.empty())
      solver->solve(small_b.data());
    for (const auto &[node, inverse] : free)
      if (with_forces)
        {
          Eigen::Map<Vector6> of_node(&b[system.layout.of_node(node)]);
          of_node = (inverse * of_node).eval();
        }
    std::fill(b.begin() + system.layout.of_state(0), b.end(), 0.);
    for (unsigned int i = 0; i < unknowns.size(); ++i)
      b[unknowns[i]] = small_b[i];
  }



  double
  Projection::velocities(State &state)
  {
    AssertDimension(state.y.size(), 6 * system.layout.n_nodes);
    double change = 0;
    if (system.layout.n_multipliers > 0)
      {
        system.find_state_rates(state);
        factorize(state, 1e-14);
        change = project(state);
      }
    find_algebraic_states(system, state);
    return change;
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
  Projection::project(State &state)
  {
    constraint_rates(state.point(), rates);
    b.assign(system.size(), 0.);
    for (unsigned int i = 0; i < rates.size(); ++i)
      b[system.layout.of_multiplier(i)] = -rates[i];
    solve(false);
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



  Point<double>
  Projection::moved_by(const State &state, const double dt)
  {
    // a straight path will do for the derivative
    moved_q           = state.q;
    moved_coordinates = state.coordinates;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const Vector3 v = Eigen::Map<const Vector3>(&state.y[6 * node]),
                      w = Eigen::Map<const Vector3>(&state.y[6 * node + 3]);
        const Eigen::Map<const Matrix3> D(&state.q[12 * node + 3]);
        Eigen::Map<Vector3>(&moved_q[12 * node]) += dt * D * v;
        Eigen::Map<Matrix3>(&moved_q[12 * node + 3]) += dt * D * skew(w);
      }
    for (unsigned int i = 0; i < state.rates.size(); ++i)
      moved_coordinates[i] += dt * state.rates[i];
    moved_states = state.states;
    for (unsigned int i = 0; i < moved_states.size(); ++i)
      moved_states[i] += dt * state.state_rates[i];
    Point<double> moved = state.point();
    moved.q             = moved_q.data();
    moved.coordinates   = moved_coordinates.data();
    moved.states        = moved_states.data();
    system.state_rates(moved, moved_state_rates.data());
    moved.state_rates = moved_state_rates.data();
    return moved;
  }



  std::vector<double>
  Projection::accelerations(State &state)
  {
    factorize(state);
    solve_for_accelerations(state);
    return {b.begin(), b.begin() + system.layout.of_multiplier(0)};
  }



  void
  Projection::report(State &state, const bool with_forces)
  {
    state.accelerations.clear();
    if (with_forces || system.layout.n_multipliers > 0)
      factorize(state);
    if (system.layout.n_multipliers > 0)
      {
        system.find_state_rates(state);
        project(state);
      }
    find_algebraic_states(system, state);
    if (system.is_viscous())
      system.stresses(state, state.stress);
    if (!with_forces)
      return;
    solve_for_accelerations(state);
    state.accelerations.assign(6 + system.layout.of_multiplier(0), 0.);
    std::copy_n(b.begin(), system.layout.of_multiplier(0), state.accelerations.begin() + 6);
  }



  void
  Projection::solve_for_accelerations(State &state)
  {
    const Eigen::VectorXd of_integrator = values_of(acting, state.multipliers);
    find_forces_but_loads(state);
    rates_are_known = false;
    if (acting.empty())
      return find_accelerations(of_integrator, state);
    // forces depend on reactions, which depend on them: a fixed point, from those of the integrator on
    constexpr unsigned int most_passes = 100;
    constexpr double       precision   = 1e-12;
    Anderson               anderson;
    Eigen::VectorXd        known = of_integrator;
    for (unsigned int pass = 0; pass < most_passes; ++pass)
      {
        find_accelerations(known, state);
        const Eigen::VectorXd found   = values_of(acting, state.multipliers);
        double                largest = 0;
        for (const double lambda : state.multipliers)
          largest = std::max(largest, std::abs(lambda));
        if (!((found - known).lpNorm<Eigen::Infinity>() > precision * largest))
          return;
        known = anderson.next(known, found);
        // rates of states that know reactions are others in each pass, and rows may know them
        if (!system.layout.multipliers_in_laws.empty())
          rates_are_known = false;
      }
    if (!system.layout.multipliers_in_laws.empty())
      throw NotConverged(
        "t = " + number_to_text("%.6g", state.time) +
        " s: forces of joints that laws depend on are not found, for they depend on these laws too much");
    // what rubs may have no accelerations, or several (Painlevé): those for the reactions of the step are told
    find_accelerations(of_integrator, state);
  }



  Point<double>
  Projection::later_at(const State &state, const double by)
  {
    Point<double> point = state.point();
    point.time += by;
    if (moved_state_rates.empty())
      return point;
    system.state_rates(point, moved_state_rates.data());
    point.state_rates = moved_state_rates.data();
    return point;
  }



  void
  Projection::forget_states_that_stay(const State &state, const double dt)
  {
    // rates of states are dear where there is air; laws of constraints name few states, and most of those are controls,
    // which are still
    const auto states_in_laws = states_of_constraints(system.layout);
    const auto is_still       = [&](const Values &rates) {
      return std::all_of(states_in_laws.begin(), states_in_laws.end(), [&](const int i) { return rates[i] == 0; });
    };
    bool all_still = is_still(state.state_rates);
    moved_state_rates.assign(system.layout.n_states, 0.);
    for (unsigned int i = 0; i < 2 && all_still && !states_in_laws.empty(); ++i)
      {
        const double by = i == 0 ? -dt : dt;
        moved_by(state, by);
        all_still = is_still(moved_state_rates);
        later_at(state, by);
        all_still = all_still && is_still(moved_state_rates);
      }
    if (all_still)
      moved_state_rates.clear();
  }



  void
  Projection::add_second_rates_of_laws(const State &state)
  {
    // nothing turns by more than a thousandth in the time of the differences; what is slower than 1e-3 1/s counts as
    // such
    double fastest = 1e-3;
    for (unsigned int i = 0; i < state.y.size(); i += 6)
      fastest = std::max(fastest, Eigen::Map<const Vector3>(&state.y[i + 3]).norm());
    for (const double rate : state.rates)
      fastest = std::max(fastest, std::abs(rate));
    const double dt = 1e-3 / fastest;
    forget_states_that_stay(state, dt);
    const auto rates_at = [&](const Point<double> &point) {
      Values rates(system.layout.n_multipliers);
      system.constraint_time_rates(point, rates.data());
      return rates;
    };
    std::vector<unsigned int> by_laws;
    for (unsigned int i = 0; i < rates_of_rows.size(); ++i)
      if (std::isnan(rates_of_rows[i]))
        {
          by_laws.push_back(i);
          rates_of_rows[i] = 0;
        }
    const auto add = [&](const Values &change) {
      for (const auto i : by_laws)
        rates_of_rows[i] += change[i];
    };
    if (!moved_state_rates.empty())
      add(difference(dt, [&](const double by) { return rates_at(moved_by(state, by)); }));
    const auto of_time = [&](const double by) { return rates_at(later_at(state, by)); };
    // a constant speed is one at all times, of which some at uneven distances stand for all
    const Values now       = of_time(0);
    bool         is_steady = true;
    for (const double part : {-2., -1., -0.367, 0.123, 0.719, 1., 2.})
      is_steady = is_steady && of_time(part * dt) == now;
    if (!is_steady)
      add(limit_of_differences(dt, state.time, largest_of(now), of_time));
  }



  void
  Projection::find_rates_of_rows(const State &state)
  {
    rates_of_rows.resize(system.layout.n_multipliers);
    system.constraint_second_rates(state.point(), rates_of_rows.data());
    if (std::any_of(rates_of_rows.begin(), rates_of_rows.end(), [](const double rate) { return std::isnan(rate); }))
      add_second_rates_of_laws(state);
    for (const auto i : left_out)
      rates_of_rows[i] = 0;
    for (const auto i : released)
      rates_of_rows[i] = 0;
    rates_are_known = true;
  }



  void
  Projection::find_forces_but_loads(State &state)
  {
    const bool was_held = state.held;
    state.held          = false;
    // laws of reactions need not know what none at all would do
    if (acting.empty())
      std::fill(state.multipliers.begin(), state.multipliers.end(), 0.);
    system.find_state_rates(state);
    system.residual(state, state.stress, r);
    if (!acting.empty())
      {
        loads.assign(r.size(), 0.);
        system.add_loads(state.point(), loads.data());
        system.add_constraints(state.point(), loads.data());
        for (unsigned int i = 0; i < r.size(); ++i)
          r[i] -= loads[i];
      }
    state.held = was_held;
  }



  void
  Projection::find_accelerations(const Eigen::VectorXd &known, State &state)
  {
    const int n_moving = system.layout.of_multiplier(0);
    b.assign(system.size(), 0.);
    for (int i = 0; i < n_moving; ++i)
      b[i] = -r[i];
    if (!acting.empty())
      {
        const bool was_held = state.held;
        state.held          = false;
        std::fill(state.multipliers.begin(), state.multipliers.end(), 0.);
        for (unsigned int i = 0; i < acting.size(); ++i)
          state.multipliers[acting[i]] = known(i);
        system.find_state_rates(state);
        std::fill(loads.begin(), loads.end(), 0.);
        system.add_loads(state.point(), loads.data());
        for (int i = 0; i < n_moving; ++i)
          b[i] -= loads[i];
        state.held = was_held;
      }
    if (!rates_are_known)
      find_rates_of_rows(state);
    for (unsigned int i = 0; i < rates_of_rows.size(); ++i)
      b[system.layout.of_multiplier(i)] = -rates_of_rows[i];
    // rates of states are known, and in Ġ y already
    std::fill_n(b.begin() + system.layout.of_state(0), system.layout.n_states, 0.);
    solve();
    std::copy(state.state_rates.begin(), state.state_rates.end(), b.begin() + system.layout.of_state(0));
    std::copy_n(b.begin() + n_moving, system.layout.n_multipliers, state.multipliers.begin());
  }
} // namespace samara
