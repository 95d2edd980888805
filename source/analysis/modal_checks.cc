// What has no modes, or other ones than those that are found: it is refused, or told.

#include <samara/analysis/controls.h>
#include <samara/analysis/modal.h>
#include <samara/analysis/prescribed_motion.h>
#include <samara/analysis/steady_loads.h>
#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/solvers/newton.h>
#include <samara/solvers/steady_motion.h>

#include <algorithm>
#include <limits>

namespace samara
{
  bool
  ModalAnalysis::check_motion(const Context &context) const
  {
    State              turning = context.state;
    const SteadyMotion motion  = set_steady_motion(context.system, turning, context.speeds);
    if (motion.is_steady())
      return true;
    const std::string why =
      "parts do not turn steadily: " + why_not_steady(context.system, turning, context.speeds, motion);
    refuse_unsteady(context, why);
    return false;
  }



  ModalAnalysis::OtherMotion
  ModalAnalysis::other_motion(const System &system, const State &steady, const std::vector<double> &twists)
  {
    OtherMotion result;
    // nothing has moved yet: velocities at the start belong to a dynamic analysis
    if (std::all_of(twists.begin(), twists.end(), [](const double v) { return v == 0.; }))
      return result;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const auto spin_of = [&](const std::vector<double> &y) {
          return Eigen::Map<const Vector6>(&y[6 * node]).tail<3>();
        };
        const double difference = (spin_of(twists) - spin_of(steady.y)).norm();
        if (difference > result.spin)
          {
            const std::string unknown = system.layout.name_of(system.layout.of_node(node));
            result                    = {difference, unknown.substr(0, unknown.rfind(", "))};
          }
      }
    return result;
  }



  void
  ModalAnalysis::check_other_motion(const Context &context, const OtherMotion &other) const
  {
    constexpr double allowed = 1e-3; // of a mode's frequency: what gyroscopic terms of that spin change
    for (const auto &mode : modes)
      if (mode.frequency() > 0 && other.spin > allowed * mode.frequency())
        {
          const std::string why = "the state before moves otherwise than steadily, " + other.place + " turns with " +
                                  short_text(other.spin) + " rad/s more or less than the rotations of the model say";
          if (unsteady == "refuse")
            refuse_unsteady(context, why);
          return context.log.warning("modal", why + "; modes have no gyroscopic terms of that");
        }
  }



  void
  ModalAnalysis::check_prescribed(const Context &context, const State &state) const
  {
    constexpr double    allowed = 1e-6; // of a mode's frequency
    std::vector<double> times   = times_to_look(state);
    const bool          turns   = !times.empty();
    times.insert(times.begin(), 0.);
    double slowest = std::numeric_limits<double>::infinity();
    for (const auto &mode : modes)
      if (mode.frequency() > 0)
        {
          slowest = std::min(slowest, mode.frequency());
          times.insert(times.end(), {1. / mode.frequency(), 2.4 / mode.frequency()});
        }
    const PrescribedMotion other = prescribed_beside(context.system, state, times);
    if (!(other.rate > allowed * slowest))
      return;
    const std::string why =
      "<" + other.name + "> is prescribed to move, with up to " + short_text(other.rate) +
      (turns ? " rad/s, beside the steady rotation" : " rad/s or lengths of the model per second");
    if (turns)
      refuse_unsteady(context, why);
    else if (const std::string text = about_stopped_rotor(context.system, state, "these are the modes"); !text.empty())
      context.log.warning("modal", text);
    else
      context.log.line("  modal: " + why + "; modes are those while it is held where it is");
  }



  void
  ModalAnalysis::check_loads(const Context &context, const State &state) const
  {
    const ChangingLoads loads = changing_loads(context.system, state);
    if (loads.change_modes())
      refuse_unsteady(context, loads.text());
  }



  void
  ModalAnalysis::refuse_unsteady(const Context &context, const std::string &why) const
  {
    if (unsteady == "refuse")
      throw InputError(
        (parameters.where().empty() ? "" : parameters.where() + ": ") + "modal analysis: " + why +
        ".\n  Modes belong to a motion that stays as it is. If they are wanted for the moment nevertheless, set "
        "Unsteady motion = allow in subsection Modal.");
    context.log.line("  modal: " + why + "; modes are those of this moment");
  }



  void
  ModalAnalysis::check_equilibrium(const System &system, State &state) const
  {
    Imbalance imbalance;
    try
      {
        imbalance = balance_stresses(system, state);
      }
    catch (const SingularMatrix &)
      {
        return; // find() says where
      }
    if (imbalance.is_large())
      throw NotConverged(
        "modal analysis: the state is not an equilibrium: loads or inertia forces act that its stresses do not "
        "balance.\n  Modes would be those of a state that does not last. Find the equilibrium first: set Analyses = "
        "static, modal; or leave the loads out.");
  }



  void
  ModalAnalysis::check_mass(const System &system, const Linearization &linearization) const
  {
    const auto &values      = linearization.M.values;
    const bool  is_massless = std::all_of(values.begin(), values.end(), [](const double m) { return m == 0.; });
    if (is_massless && system.layout.n_states == states_of_controls(system).size())
      throw NotConverged(
        "modal analysis: nothing that can move has mass.\n  Give the sections a density or mass, or the "
        "rigid bodies a mass.");
  }



  namespace
  {
    /** Of |λ|: modes that change by less are worth their name; what is left out is told. */
    constexpr double little = 0.05;

    /** How modes of a moment differ from those of others; empty if they do not. */
    std::string
    text_of_changes(const std::vector<Mode> &modes, const std::vector<double> &changes)
    {
      unsigned int n = 0, most = 0;
      for (unsigned int i = 0; i < modes.size(); ++i)
        // what the estimate of the error allows is no change (doc/theory/modes.md, parts that turn against each other)
        if (!(changes[i] <= 1e-5 + 10 * modes[i].error))
          {
            ++n;
            if (!(changes[i] <= changes[most]))
              most = i;
          }
      if (n == 0)
        return "";
      return std::to_string(n) + " of " + std::to_string(modes.size()) + " modes of this moment do not last: mode " +
             std::to_string(most + 1) + " at " + short_text(modes[most].frequency()) + " rad/s changes " +
             (changes[most] < 1 ? "by up to " + number_to_text("%.2g", 100 * changes[most]) + " %" :
                                  "by more than itself");
    }
  } // namespace



  void
  ModalAnalysis::check_axes(const Context &context, const MovingAxes &seen) const
  {
    if (!seen.are_looked_at())
      return;
    const std::vector<double> changes  = seen.changes(modes);
    const std::string         of_modes = text_of_changes(modes, changes), of_all = seen.text_of_change();
    if (of_modes.empty() && of_all.empty())
      {
        context.log.line("  modal: coefficients are constant in " + seen.text());
        return;
      }
    const std::string why = of_all + (of_all.empty() || of_modes.empty() ? "" : "; ") + of_modes;
    const bool        changes_little =
      std::all_of(changes.begin(), changes.end(), [](const double change) { return change <= little; });
    const std::string about_support = "If what carries the turning parts is alike in all directions, draw it as one "
                                      "joint, planar with springs in fixed axes, not as two slides.";
    if (axes != "automatic")
      context.log.warning("modal", why);
    else if (unsteady == "refuse")
      throw InputError(
        (parameters.where().empty() ? "" : parameters.where() + ": ") + "modal analysis: " + why +
        ".\n  Coefficients are periodic: there are no modes, but multipliers of a periodic motion, which "
        "Analyses = floquet finds. " +
        (changes_little ?
           "For modes of this moment set Axes = turning or Axes = fixed in subsection Modal, or Unsteady "
           "motion = allow for axes in which least changes." :
           about_support + " Modes of this moment, by the entries Axes and Unsteady motion of Modal, would be wrong by "
                           "as much as this."));
    else if (changes_little)
      context.log.line("  modal: " + why + "; modes are those of this moment in " + seen.text());
    else
      context.log.warning("modal",
                          why + "; modes are those of this moment in " + seen.text() +
                            ", and wrong by as much: Analyses = floquet finds those of the motion. " + about_support);
  }



  void
  ModalAnalysis::check_errors(const Context &context) const
  {
    for (unsigned int i = 0; i < modes.size(); ++i)
      {
        const std::string text = "mode " + std::to_string(i + 1) + " at " + short_text(modes[i].frequency()) +
                                 " rad/s has an estimated error of " + short_text(100 * modes[i].error) + " %";
        // beyond 1 % a mode is no result; above 1e-6, where 1e-14 is usual, the model is worth a look
        if (!(modes[i].error < 1e-2))
          throw NotConverged(
            "modal analysis: " + text +
            ".\n  It is lost in round-off. Set the <Shift> to about its frequency, ask for fewer modes, or "
            "look for stiffnesses and masses that differ by many orders of magnitude.");
        if (modes[i].error > 1e-6)
          context.log.warning("modal", text + "; set the <Shift> to about its frequency, or ask for fewer modes");
      }
  }
} // namespace samara
