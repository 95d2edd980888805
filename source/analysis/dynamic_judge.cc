// Whether the energy account of a run closes, and how well its steps resolve the motion.

#include <samara/analysis/dynamic_parts.h>
#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/model/contact_group.h>
#include <samara/model/strain_rows.h>
#include <samara/solvers/newton.h>
#include <samara/time/increment.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace samara
{
  namespace
  {
    /** Of a step, and of all of a run, as multiples of the Newton tolerance: its estimate is good to such a factor. */
    constexpr double allowed_multiple = 10, most_allowed = 1e-3, round_off = 1e-12;

    /** Of the largest energy: what the steps may take of it, or leave open at a stop, without a word. */
    constexpr double silent_share = 1e-3;



    /**
     * What is open of the work of stops in a step: their work defects; and where dampers of stops begin or end within
     * the step, half of what these take, as they do so to first order alone.
     */
    double
    open_work_of_stops(const Layout &layout, const StepResult &step)
    {
      double open = step.work_defect;
      for (const auto &touch : step.touches)
        for (const auto &stop : step.touched_stops)
          if (stop.stop == touch.stop && stop.stop < layout.stops.size() && layout.stops[stop.stop].law.damping > 0)
            open += 0.5 * stop.loss;
      return open;
    }
  } // namespace



  bool
  account_closes(const double gap,
                 const double largest_energy,
                 const double n_steps,
                 const double newton_tolerance,
                 const double round_off_of_sum)
  {
    // what counts is the largest energy of all the run: a motion that begins slowly has little energy at first
    const double allowed = std::min(n_steps * (allowed_multiple * newton_tolerance + round_off), most_allowed);
    return gap <= allowed * largest_energy + n_steps * round_off_of_sum;
  }



  double
  round_off_of_strain_energy(const System &system, const State &state)
  {
    const StrainRows          rows   = system.strain_rows(state);
    const std::vector<double> scales = scales_of_increment(system, 1.);
    std::vector<double>       stress;
    system.stresses(state, stress);
    double sum = 0;
    for (const StrainRows::Point &p : rows.points)
      for (unsigned int i = 0; i < p.size; ++i)
        {
          double size = 0; // of the terms that the strain is the difference of
          for (unsigned int k = rows.B.start[p.first_row + i]; k < rows.B.start[p.first_row + i + 1]; ++k)
            size += std::abs(rows.B.values[k]) * scales[rows.B.columns[k]];
          sum += p.weight * std::abs(stress[p.first_strain + i]) * size;
        }
    return std::numeric_limits<double>::epsilon() * sum;
  }



  void
  DynamicAnalysis::set_energy_floor(const System &system)
  {
    double mass = 0;
    for (const auto &node : system.model.nodes)
      mass += node.inertia(0, 0);
    // a potential is known to round-off of what it is, however little of it changes
    energy_floor = std::max(0.5 * mass * std::pow(1e-6 * model_length(system.model) / (end_time - start_time), 2),
                            1e-4 * std::abs(budget.potential));
    report.largest_energy = std::max({report.largest_energy, energy_floor, budget.kinetic, 1e-3 * budget.strain});
    first_strain          = budget.strain;
  }



  void
  DynamicAnalysis::judge(const Context &context, const Advance &advance, const double time, const double balance_before)
  {
    report.largest_energy = std::max({report.largest_energy,
                                      budget.kinetic,
                                      std::abs(budget.strain - first_strain),
                                      std::abs(budget.loads),
                                      std::abs(budget.drives)});
    report.indicator      = std::max(report.indicator, advance.step.indicator);
    report.work_defect    = std::max(report.work_defect, open_work_of_stops(context.system.layout, advance.step));
    if (advance.step.unresolved_state >= 0 && report.n_unresolved++ == 0)
      {
        report.first_unresolved = time;
        report.unresolved_state = context.system.model.states[advance.step.unresolved_state].name;
      }
    // whatever the tolerance, a sum is not known better than its terms are
    const double terms = budget.kinetic + budget.strain + std::abs(budget.potential) + std::abs(budget.start) +
                         std::abs(budget.loads) + std::abs(budget.drives) + budget.viscous + budget.friction +
                         budget.dissipated;
    round_off_of_sum       = std::max(round_off_of_sum, 2 * std::numeric_limits<double>::epsilon() * terms);
    const double miss      = std::abs(budget.balance() - balance_before);
    report.largest_gap     = std::max(report.largest_gap, std::abs(budget.balance()));
    report.largest_balance = report.largest_gap > 0 ? report.largest_gap / report.largest_energy : 0.;
    ++n_judged;
    if (miss > report.largest_miss)
      {
        report.largest_miss = miss;
        report.worst_time   = time;
        report.worst_place  = context.system.layout.name_of(advance.step.worst);
        if (advance.step.worst_constraint >= 0)
          report.worst_place += "; of what holds that, most is transmitted by <" +
                                context.system.layout.name_of_multiplier(advance.step.worst_constraint) + ">";
      }
    report.does_close =
      std::isfinite(budget.balance()) &&
      account_closes(report.largest_gap, report.largest_energy, n_judged, newton_tolerance, round_off_of_sum);
  }



  void
  require_rows_left_out(RedundantRows &rows, const State &state)
  {
    if (state.left_out.empty())
      return;
    State there = state;
    rows.choose(there);
    if (const std::string objection = rows.objection(state, rows.gaps(state)); !objection.empty())
      throw NotConverged("t = " + number_to_text("%.6g", state.time) + " s: " + objection);
  }



  std::string
  DynamicAnalysis::resolution(const Integrator &integrator) const
  {
    if (!(report.largest_energy > energy_floor))
      return "";
    if (integrator.family() == nullptr)
      return " by construction: what the scheme loses or gains counts as its dissipation, " +
             number_to_text("%.3g", budget.dissipated) + " J";
    const DissipationRelation relation(*integrator.family());
    const double              Y    = relation.inverse(report.indicator / report.largest_energy);
    std::string               text = "\n  a step turns a body by up to " + number_to_text("%.2g", report.turn) +
                       " rad and the motion's oscillation by ";
    // beyond half a turn the energy of what oscillates says no more how fast it does
    text += Y < M_PI * M_PI ? "about " + number_to_text("%.2g", std::sqrt(Y)) + " rad, with an error of about " +
                                number_to_text("%.1e", Y > 0 ? relation.period_error(Y) : 0.) + " in a period" :
                              "more than half a turn: it is not resolved";
    if (report.length > 0)
      text += "; errors of steps add up to about " + number_to_text("%.1e", report.error / report.length) + " of " +
              number_to_text("%.3g", report.length) + " m";
    if (report.work_defect > 0)
      text += "; work defect of the stops up to " + number_to_text("%.1e", report.work_defect / report.largest_energy) +
              " of the largest energy a step";
    return text;
  }



  namespace
  {
    /** Whether any friction bends bristles. */
    bool
    has_bristles(const Layout &layout)
    {
      return std::any_of(layout.frictions.begin(),
                         layout.frictions.end(),
                         [](const auto &friction) { return friction.law.has_bristles(); }) ||
             std::any_of(layout.contact_groups.begin(), layout.contact_groups.end(), [](const auto *group) {
               return group->has_bristles();
             });
    }
  } // namespace



  std::string
  DynamicAnalysis::finer(const double excess, const double order) const
  {
    const bool   is_fixed = control == "fixed";
    const double value    = is_fixed ? step * std::pow(excess, -1 / order) : tolerance / excess,
                 unit     = std::pow(10., std::floor(std::log10(value))); // one digit, rounded down
    return std::string(is_fixed ? "a <Step>" : "a <Tolerance>") + " of about " +
           number_to_text("%.1g", unit * std::floor(value / unit)) + (is_fixed ? " s" : "") + " would do";
  }



  void
  DynamicAnalysis::tell_losses(const Context &context) const
  {
    if (!(report.largest_energy > energy_floor))
      return;
    const double part = budget.dissipated / report.largest_energy;
    // by the dissipation of a step, h^2s, of which there are 1/h; that of integrators without stages is of second order
    if (part > silent_share)
      context.log.warning("",
                          "the integrator has dissipated " + number_to_text("%.3g", budget.dissipated) + " J, " +
                            number_to_text("%.2g", 100 * part) +
                            " % of the largest energy: so much of the motion is lost to the steps, and to no damper; " +
                            finer(part / silent_share, is_family() ? 2. * n_stages - 1 : 2.) +
                            (is_family() ? ", and with <Spectral radius = 1> nothing is dissipated" : ""));
    const double defect = report.work_defect / report.largest_energy;
    if (defect > silent_share)
      context.log.warning("",
                          "contacts with stops are not resolved: within one step they would take or give " +
                            number_to_text("%.2g", defect) +
                            " of the largest energy. Energy is kept nevertheless, but " +
                            (defect > 0.1 ? "where the motion goes after a contact is arbitrary" :
                                            "the motion after a contact is off by up to as much") +
                            "; " + finer(defect / silent_share, 2.5)); // doc/theory/step_control.md
  }



  void
  DynamicAnalysis::tell_halved_steps(const Context &context) const
  {
    constexpr unsigned int few  = 3;   // at an impact, or where something jumps
    constexpr double       most = 0.9; // of the step, in the mean
    const double           mean = (context.state.time - start_time) / std::max(1u, report.n_steps);
    if (control != "fixed" || report.n_failed <= few || mean > most * step)
      return;
    const double wanted = step / std::pow(2., std::ceil(std::log2(step / mean)));
    context.log.warning("",
                        std::to_string(report.n_failed) +
                          " steps had no solution with their length, and were halved; " +
                          number_to_text("%.3g", 100 * mean / step) +
                          " % of the <Step> were made in the mean. A run with <Step = " +
                          number_to_text("%.3g", wanted) +
                          " s> takes no longer and is more exact; <Step control = adaptive> finds it by itself");
  }



  void
  DynamicAnalysis::conclude(const Context &context) const
  {
    if (control == "adaptive" && has_bristles(context.system.layout))
      context.log.warning(
        "",
        "adaptive steps do not look at bristles: where these bend, errors are larger than what errors "
        "of steps add up to, by hundreds of times after impacts. Compare with a hundredth of the "
        "<Tolerance>, or with a shorter <Step>");
    // what has died away after a few steps does not count any more
    constexpr unsigned int transient = 3;
    if (report.n_unresolved > transient)
      context.log.warning("",
                          "states of first order are not resolved in " + std::to_string(report.n_unresolved) +
                            " steps, the first at t = " + number_to_text("%.6g", report.first_unresolved) + " s, <" +
                            report.unresolved_state +
                            ">: they grow, oscillate or decay within a step, and what they do there is wrong by a "
                            "third or more. Take a smaller <Step>" +
                            (spectral_radius < 1 ? "" : ", or <Spectral radius> below 1 for what decays quickly"));
    // the energy of a good scheme oscillates a little, that of one beyond its limit of stability grows
    constexpr double allowed_gain = 1e-3;
    if (budget.dissipated < -allowed_gain * report.largest_energy)
      context.log.warning("",
                          "the integrator has made " + number_to_text("%.3g", -budget.dissipated) + " J of energy, " +
                            number_to_text("%.2g", -100 * budget.dissipated / report.largest_energy) +
                            " % of the largest, out of nothing: the motion is not to be trusted. Take a smaller "
                            "<Step>, or the integrator of the family, which cannot");
    tell_losses(context);
    tell_halved_steps(context);
    if (report.does_close)
      return;
    const std::string text =
      "dynamic analysis: the energy account does not close, " + number_to_text("%.2g", report.largest_balance) +
      " of the largest energy is missing, more than a Newton tolerance of " + number_to_text("%g", newton_tolerance) +
      " explains; most in the step from t = " + number_to_text("%.6g", report.worst_time) + " s on, " +
      number_to_text("%.2g", report.largest_miss / report.largest_energy) +
      ", where Newton's method left most work at " + report.worst_place;
    if (energy_balance == "warn")
      return context.log.warning("", text);
    throw NotConverged(text +
                       "\n  everything is written; try a smaller <Step> or <Newton tolerance>, or <Energy balance = "
                       "warn> to accept it");
  }
} // namespace samara
