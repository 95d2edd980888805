#include <samara/analysis/analysis.h>
#include <samara/analysis/steady_loads.h>
#include <samara/base/text.h>
#include <samara/solvers/linear.h>
#include <samara/solvers/newton.h>
#include <samara/solvers/redundant_rows.h>
#include <samara/solvers/steady_motion.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Forces of nodes and coordinates by rows of the system, and their sizes [N]. */
    struct Forces
    {
      const System       &system;
      const double        length;
      std::vector<double> r;

      explicit Forces(const System &system)
        : system(system)
        , length(model_length(system.model))
        , r(system.size() + 6, 0.)
      {}

      void
      add_all_loads(const State &state)
      {
        system.add_loads(state.point(), r.data());
      }

      void
      add_inertia_forces(const State &state)
      {
        for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
          {
            const Eigen::Map<const Vector6> y(&state.y[6 * node]);
            Eigen::Map<Vector6>(&r[system.layout.of_node(node)]) -=
              ad_star<double>(y, system.model.nodes[node].inertia * y);
          }
      }

      void
      subtract(const Forces &other)
      {
        for (unsigned int i = 0; i < r.size(); ++i)
          r[i] -= other.r[i];
      }

      /** The largest force, or moment over the length of the model: its size, and the first row of its vector. */
      std::pair<double, unsigned int>
      largest() const
      {
        std::pair<double, unsigned int> most = {0., 0};
        const auto                      see  = [&](const double size, const unsigned int row) {
          if (size > most.first)
            most = {size, row};
        };
        for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
          for (const unsigned int part : {0, 3})
            {
              const unsigned int row = system.layout.of_node(node) + part;
              see(Eigen::Map<const Vector3>(&r[row]).norm() / (part == 0 ? 1. : length), row);
            }
        for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
          see(std::abs(r[system.layout.of_coordinate(i)]) / (system.model.coordinate_units[i] == "m" ? 1. : length),
              system.layout.of_coordinate(i));
        return most;
      }
    };



    /** Note the largest change of loads from one state to another. */
    void
    find_change(const System &system, const State &from, const State &to, const double reference, ChangingLoads &result)
    {
      Forces change(system), before(system);
      change.add_all_loads(to);
      before.add_all_loads(from);
      change.subtract(before);
      const auto [size, row] = change.largest();
      if (!(size > result.share * reference))
        return;
      const unsigned int coordinate = system.layout.of_coordinate(0);
      const bool         at_node    = row < coordinate;
      result.share                  = reference > 0 ? std::min(1., size / reference) : 1.;
      result.is_moment              = !system.layout.is_length(row);
      result.force                  = result.is_moment ? size * change.length : size;
      result.body = at_node ? system.model.nodes[row / 6 + 1].name : system.model.coordinates[row - coordinate];
      // below that no load changes to speak of, and reactions say why the equilibrium does
      double most = 0;
      if (result.share > 1e-6)
        for (unsigned int i = 0; i < system.n_loads(); ++i)
          {
            Forces own(system), own_before(system);
            system.add_load(i, to.point(), own.r.data());
            system.add_load(i, from.point(), own_before.r.data());
            own.subtract(own_before);
            const double part = at_node ? Eigen::Map<const Vector3>(&own.r[row]).norm() : std::abs(own.r[row]);
            if (part > most)
              {
                most        = part;
                result.load = system.item_of_load(i).name;
              }
          }
    }



    /** Whether states of first order, at rest in one state of the model, would not be in the other. */
    bool
    state_rates_change(const System &system, const State &from, const State &to)
    {
      std::vector<double> before(system.layout.n_states), after(before);
      system.state_rates(from.point(), before.data());
      system.state_rates(to.point(), after.data());
      double fastest = 0;
      for (const auto &motion : from.motion)
        fastest = std::max(fastest, motion.spin.norm());
      for (unsigned int i = 0; i < before.size(); ++i)
        if (std::abs(after[i] - before[i]) > 1e-9 * fastest * system.model.states[i].scale)
          return true;
      return false;
    }



    /** Look at the imbalance of a state, and keep what is larger. */
    void
    keep_larger(const System &system, State turned, Imbalance &largest)
    {
      try
        {
          const Imbalance here = balance_reactions(system, turned);
          // limits of an equilibrium are 1e-5 of the size and 1e-4 of the energy: a factor of ten makes them one
          // measure
          if (std::max(10 * here.step, here.stress) > std::max(10 * largest.step, largest.stress))
            largest = here;
        }
      catch (const SingularMatrix &)
        {} // the state itself is singular: who looks for modes or stresses says where
    }
  } // namespace



  std::vector<double>
  times_to_look(const State &state)
  {
    double fastest = 0;
    for (const auto &m : state.motion)
      fastest = std::max(fastest, m.spin.norm());
    double slowest = fastest;
    for (const auto &m : state.motion)
      if (m.spin.norm() > 1e-3 * fastest) // slower is round-off, or so slow that its turn says nothing of the others'
        slowest = std::min(slowest, m.spin.norm());
    std::vector<double> times;
    if (fastest > 0)
      times = {1. / fastest, 2.4 / fastest};
    if (slowest < 0.3 * fastest)
      times.push_back(2.4 / slowest);
    return times;
  }



  ChangingLoads
  changing_loads(const System &system, const State &state)
  {
    ChangingLoads result;
    const auto    times = times_to_look(state);
    if (times.empty())
      return result;
    Forces loads(system), inertia(system), all(system);
    loads.add_all_loads(state);
    inertia.add_inertia_forces(state);
    const double reference = std::max(loads.largest().first, inertia.largest().first);
    State        held      = state;
    held.held              = true;
    system.residual(held, held.stress, all.r);
    for (const double time : times)
      {
        State turned = moved_on(system, state, time);
        find_change(system, state, turned, reference, result);
        turned.held = true;
        Forces changed(system);
        system.residual(turned, turned.stress, changed.r);
        changed.subtract(all);
        if (changed.largest().first <= 1e-9 * reference && !state_rates_change(system, state, turned))
          continue; // not even reactions change
        if (!turned.left_out.empty())
          RedundantRows(system).choose(turned);
        keep_larger(system, turned, result.imbalance);
        turned.held = state.held;
        if (!turned.held && result.imbalance.step <= 1e-7) // steady for statics: is it so without the drives' moments?
          keep_larger(system, turned, result.drives);
      }
    return result;
  }



  std::string
  ChangingLoads::text() const
  {
    const std::string what = share > 1e-6 ?
                               ", as <" + load + "> changes by up to " + short_text(force) +
                                 (is_moment ? " N m" : " N") + " on <" + body + ">, seen in its own axes" :
                               "; a rotor is out of balance, or a support is not the same in all directions";
    // the limits of statics (doc/theory/steady_rotation.md): what is left below them is the drives' alone
    if (imbalance.step <= 1e-7 && imbalance.stress <= 1e-8)
      return "the moment of a drive would have to change with the azimuth" + what;
    return "the equilibrium changes as parts turn" +
           (imbalance.worst.empty() ? "" : ", most that of <" + imbalance.worst + ">") + ": by " +
           short_text(imbalance.step) + " of the model's size or rad, with " + short_text(100 * imbalance.stress) +
           " % of the strain energy" + what;
  }
} // namespace samara
