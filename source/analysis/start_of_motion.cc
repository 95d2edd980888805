// Where a run begins: velocities of the steady motion and of bodies, made to obey the constraints.

#include <samara/analysis/start_of_motion.h>
#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/model/initial_motion.h>
#include <samara/solvers/newton.h>
#include <samara/solvers/redundant_rows.h>
#include <samara/solvers/steady_motion.h>
#include <samara/time/projection.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Velocities that belong to a model turning as a whole were not possible with the ground at rest: say where. */
    void
    refuse_turning_ground(const Context       &context,
                          const StartOfMotion &how,
                          const State         &given,
                          const State         &projected,
                          const double         change)
    {
      const System &system    = context.system;
      const auto   &rotations = system.model.rotations;
      unsigned int  i         = 0;
      while (i < rotations.size() && (rotations[i].coordinate >= 0 || context.speeds[i] == 0.))
        ++i;
      if (i == rotations.size())
        return;
      // more than round-off of the velocities that files give with six digits
      std::string where;
      if (change > 1e-6)
        {
          std::vector<double> rates(system.layout.n_multipliers);
          system.constraint_rates(given.point(), rates.data());
          const auto worst =
            std::max_element(rates.begin(), rates.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
          where = system.layout.name_of_multiplier(worst - rates.begin());
        }
      else if (const auto *const c = system.strained(projected.point(), 1e-6 * std::abs(context.speeds[i])))
        where = "<" + c->name + ">, which would be strained";
      else
        return;
      throw InputError(
        how.where + ": steady rotation <" + rotations[i].name +
        "> turns the whole model; in the dynamic analysis the ground stands still, and what is fixed to it cannot go on "
        "turning: " +
        where +
        ".\n  Put a revolute between the ground and what turns, and let the steady rotation turn that <Joint>.");
    }



    /** Positions must obey the constraints at the start. */
    void
    check_positions(const System &system, const State &state)
    {
      std::vector<double> r(system.size() + 6, 0.);
      system.add_gaps(state.point(), r.data());
      for (const auto i : system.released_multipliers())
        r[system.layout.of_multiplier(i)] = 0;
      const double length = model_length(system.model);
      for (unsigned int i = 0; i < system.layout.n_multipliers; ++i)
        if (const double gap = std::abs(r[system.layout.of_multiplier(i)]); gap > 1e-6 * std::max(1., length))
          throw InputError(
            system.layout.name_of_multiplier(i) + ": the constraint is violated by " + number_to_text("%.3g", gap) +
            " at the start; let a static analysis find a position that obeys it: <Analyses = static, dynamic>");
    }



    /** Whether anything moves by more than round-off [lengths of the model/s, rad/s]. */
    bool
    moves(const System &system, const State &state)
    {
      constexpr double round_off = 1e-12;
      const double     length    = model_length(system.model);
      for (unsigned int i = 6; i < state.y.size(); ++i)
        if (std::abs(state.y[i]) > round_off * (i % 6 < 3 ? length : 1.))
          return true;
      return false;
    }



    /** Velocities are made to obey the constraints. */
    void
    make_admissible(const Context &context, const StartOfMotion &how, State &state)
    {
      const System &system = context.system;
      Projection    projection(system);
      const State   given  = state;
      double        change = 0;
      try
        {
          change = projection.velocities(state);
        }
      catch (const SingularMatrix &problem)
        {
          throw InputError("something without mass can move freely" +
                           (problem.unknown >= 0 ? ": " + system.layout.name_of(problem.unknown) : std::string()) +
                           "; the dynamic analysis needs a mass or an inertia there");
        }
      refuse_turning_ground(context, how, given, state, change);
      if (change > 1e-6 && (moves(system, state) || moves(system, given)))
        {
          unsigned int worst = 6;
          for (unsigned int i = 6; i < state.y.size(); ++i)
            if (std::abs(state.y[i] - given.y[i]) > std::abs(state.y[worst] - given.y[worst]))
              worst = i;
          const std::string text =
            "the velocities at the start do not obey the constraints: those that do are different by " +
            number_to_text("%.3g", 100 * change) + " % of the largest, most at " + system.layout.name_of(worst - 6);
          if (how.refuses)
            throw InputError(text);
          context.log.warning("", text + "; they are used");
        }
    }
  } // namespace



  State
  start_of_motion(const Context &context, const StartOfMotion &how)
  {
    const System &system = context.system;
    State         state  = context.state;
    if (!context.is_equilibrium && !state.held)
      {
        // a motion goes on
        if (std::abs(how.time - state.time) > 1e-9 * std::max(1., std::abs(state.time)))
          throw InputError(how.where + ": the motion before it has come to t = " + number_to_text("%.9g", state.time) +
                           " s; give this <Start time>, at which it goes on");
        check_positions(system, state);
        return state;
      }
    if (context.is_equilibrium && state.factor != 1)
      context.log.warning("",
                          "the static analysis has ended at the load factor " + short_text(state.factor) +
                            "; the motion starts there, and with all loads");
    state.held   = false;
    state.factor = 1;
    state.time   = how.time;
    if (State deformed = state; add_initial_displacements(system, deformed))
      {
        if (context.is_equilibrium)
          throw InputError(how.where +
                           ": a beam has a field of displacements at the start, and the static analysis before the "
                           "dynamic one says how it is deformed, too; leave out one of them");
        state = deformed;
      }
    if (!context.is_equilibrium)
      set_steady_motion(system, state, context.speeds);
    // of a model that turns as a whole the ground stops, and nothing else
    std::fill_n(state.y.begin(), 6, 0.);
    system.add_initial_velocities(state);

    // other rows are redundant when rotations are no longer held
    if (how.is_family && !system.released_multipliers().empty())
      state.left_out = RedundantRows(system).find(state);

    check_positions(system, state);
    make_admissible(context, how, state);
    system.stresses(state, state.stress);
    return state;
  }



  State
  motion_or_start(const Context &context, const StartOfMotion &how)
  {
    return !context.is_equilibrium && !context.state.held ? context.state : start_of_motion(context, how);
  }
} // namespace samara
