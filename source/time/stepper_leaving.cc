// Steps that end where something leaves what held it.

#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/solvers/linear.h>
#include <samara/solvers/redundant_rows.h>
#include <samara/time/projection.h>
#include <samara/time/stepper.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace samara
{
  namespace
  {
    /** How exactly a step ends at an exit, in lengths of what has it. */
    constexpr double exactness = 1e-10;
  } // namespace



  void
  Stepper::find_exits()
  {
    for (const auto &item : system.model.items)
      if (const auto *const holds = dynamic_cast<const CanLeave *>(item.get()))
        {
          const CanLeave::Exits places = holds->exits();
          if (!std::isfinite(places.lower) && !std::isfinite(places.upper))
            continue;
          if (integrator.family() == nullptr)
            throw InputError(item->name + ": only the integrator of the family lets something leave its beam");
          exits.push_back({holds, places});
        }
  }



  double
  Stepper::Exit::beyond(const State &state) const
  {
    if (item->has_left(state))
      return -std::numeric_limits<double>::infinity();
    const double place = state.coordinates[places.coordinate];
    return std::max(place - places.upper, places.lower - place) / places.length;
  }



  double
  Stepper::farthest_beyond(const State &state) const
  {
    double farthest = -std::numeric_limits<double>::infinity();
    for (const Exit &exit : exits)
      farthest = std::max(farthest, exit.beyond(state));
    return farthest;
  }



  bool
  Stepper::stop_at_exits(State &state, double &h, Advance &result)
  {
    constexpr unsigned int most = 60;
    going.clear();
    double high = farthest_beyond(trial);
    if (!(high > exactness))
      return true;
    for (unsigned int i = 0; i < exits.size(); ++i)
      if (exits[i].beyond(trial) > exactness && exits[i].beyond(state) > -exactness)
        going.push_back(i);
    if (!going.empty())
      {
        integrator.step_back();
        let_go(going, state, result);
        going.clear();
        return false;
      }
    // the root of how far the end of the step is beyond: regula falsi, the end that stays twice counts half (Illinois)
    double before = 0, after = h, low = farthest_beyond(state), at = high;
    int    side = 0;
    for (unsigned int i = 0; i < most && !(std::abs(at) < exactness) && after - before > 1e-13 * after; ++i)
      {
        h = i % 8 == 7 ? 0.5 * (before + after) : before + (after - before) * low / (low - high);
        integrator.step_back();
        if (!has_solution(state, h, result))
          throw NotConverged("t = " + number_to_text(state.time) + " s: no solution before something leaves its beam");
        at = farthest_beyond(trial);
        if (at > 0)
          {
            after = h;
            high  = at;
            low *= side > 0 ? 0.5 : 1;
            side = 1;
          }
        else
          {
            before = h;
            low    = at;
            high *= side < 0 ? 0.5 : 1;
            side = -1;
          }
      }
    for (unsigned int i = 0; i < exits.size(); ++i)
      if (exits[i].beyond(trial) > -exactness)
        going.push_back(i);
    return true;
  }



  void
  Stepper::let_go(std::vector<unsigned int> those, State &state, Advance &result)
  {
    those.erase(std::remove_if(those.begin(),
                               those.end(),
                               [&](const unsigned int i) { return exits[i].beyond(state) < -exactness; }),
                those.end());
    if (!those.empty())
      {
        // at the end of a step velocities obey the constraints to its order only: free, they would stay so
        const double before = system.energy(state).kinetic;
        try
          {
            Projection(system).velocities(state);
          }
        catch (const SingularMatrix &)
          {
            // a position in which they are not determined: they stay as they are
          }
        lost += before - system.energy(state).kinetic;
        for (const unsigned int i : those)
          {
            exits[i].item->leave(state);
            result.left.push_back("t = " + number_to_text("%.9g", state.time) +
                                  " s: " + exits[i].item->text_of_leaving());
          }
        if (!state.left_out.empty())
          state.left_out = RedundantRows(system).find(state);
        integrator.forget_history();
      }
    if (&state == &trial && lost != 0)
      {
        result.step.dissipated += lost;
        result.step.energy = system.energy(state);
        lost               = 0;
      }
  }
} // namespace samara
