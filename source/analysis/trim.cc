// A search for trim: what the controls and targets are, where the motion starts, and what is said in the end.

#include <samara/analysis/period_of_rotors.h>
#include <samara/analysis/start_of_motion.h>
#include <samara/analysis/trim_path.h>
#include <samara/analysis/trim_run.h>
#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/model/algebraic_states.h>
#include <samara/solvers/newton.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    constexpr double no_limit = std::numeric_limits<double>::infinity();

    const std::string behind_a_section =
      "\n  A section of the <Symmetry> had been before, behind which parts took each other's places: what is among the "
      "<Turning> must lie about the axis, so that it is carried into itself, or be repeated";

    /** The unit of a probe as it is written in expressions, in SI; and what the probe's numbers are multiplied by. */
    std::pair<std::string, double>
    si_unit_of(const std::string &unit)
    {
      if (unit == "deg")
        return {"rad", M_PI / 180};
      std::string text = unit.empty() ? "1" : unit;
      std::replace(text.begin(), text.end(), ' ', '*');
      return {text, 1.};
    }
  } // namespace



  TrimAnalysis::Run::Run(TrimAnalysis &trim, Context &context)
    : trim(trim)
    , context(context)
    , system(context.system)
  {
    tolerance = trim.tolerance;
    find_controls();
    motion = make_motion(trim.n_steps);
    history.emplace(columns());
  }



  std::unique_ptr<PeriodicMotion>
  TrimAnalysis::Run::make_motion(const unsigned int n_steps)
  {
    // the fourth is for BDF alone
    const IntegratorSettings settings{
      trim.spectral_radius, trim.newton_tolerance, trim.max_iterations, 1e-4, trim.n_stages};
    return std::make_unique<PeriodicMotion>(context, trim.period, n_steps, settings, find_targets());
  }



  double
  TrimAnalysis::Run::turns() const
  {
    return double(motion->n_turns) / motion->n_sections() + (whole ? whole->n_turns : 0);
  }



  void
  TrimAnalysis::Run::find_controls()
  {
    const auto              &states = system.model.states;
    std::vector<std::string> names;
    for (const auto &s : states)
      names.push_back(s.name);
    for (const auto &given : trim.controls)
      {
        const auto at = std::find(names.begin(), names.end(), given.name);
        if (at == names.end())
          throw InputError(trim.parameters.where("Controls") + ": there is no state <" + given.name + ">" +
                           did_you_mean(given.name, names));
        const auto        i    = static_cast<unsigned int>(at - names.begin());
        const std::string unit = states[i].unit.empty() ? "1" : states[i].unit;
        try
          {
            controls.push_back({given.name,
                                unit,
                                i,
                                given.lower.in ? given.lower.in(unit) : -no_limit,
                                given.upper.in ? given.upper.in(unit) : no_limit,
                                states[i].scale});
          }
        catch (const std::invalid_argument &problem)
          {
            throw InputError(trim.parameters.where("Controls") + ": <" + given.name + ">: " + problem.what());
          }
        const Control &control = controls.back();
        const double   value   = context.state.states[i];
        if (!(control.lower <= value && value <= control.upper && control.lower < control.upper))
          throw InputError(trim.parameters.where("Controls") + ": <" + given.name + "> is " +
                           number_to_text("%.6g", value) + " " + unit + " at the start, outside of its limits");
      }
  }



  std::vector<PeriodAverage>
  TrimAnalysis::Run::find_targets()
  {
    std::vector<PeriodAverage> averages;
    targets.clear();
    for (unsigned int k = 0; k < trim.targets.size(); ++k)
      {
        const TrimTarget &given = trim.targets[k];
        std::string       entry = "Targets";
        try
          {
            const Probe probe         = system.model.probe(given.probe);
            const auto [unit, factor] = si_unit_of(probe.unit);
            if (probe.unit.find("unique") != std::string::npos)
              throw std::invalid_argument("it is not unique, as constraints are redundant there");
            Target target{given.probe, probe.unit, given.value.in(unit), 0., factor};
            if (given.part != PeriodAverage::mean)
              target.name = std::string(given.part == PeriodAverage::cosine ? "cos " : "sin ") +
                            std::to_string(given.harmonic) + " of " + given.probe;
            entry        = trim.scales.empty() ? entry : "Scales";
            target.scale = std::abs(trim.scales.empty() ? target.value : trim.scales[k].in(unit));
            if (trim.scales.empty() && target.value == 0 && unit == "rad")
              target.scale = 1;
            if (!(target.scale > 0))
              throw std::invalid_argument("its scale must not be zero");
            targets.push_back(target);
            averages.push_back({given.part, given.harmonic, probe});
          }
        catch (const std::invalid_argument &problem)
          {
            throw InputError(trim.parameters.where(entry) + ": <" + given.probe + ">: " + problem.what());
          }
      }
    return averages;
  }



  std::vector<std::string>
  TrimAnalysis::Run::columns() const
  {
    std::vector<std::string> result = {"turns", "periodicity", "miss"};
    for (const auto &control : controls)
      result.push_back(control.name + (control.unit == "1" ? "" : " [" + control.unit + "]"));
    for (const auto &target : targets)
      result.push_back(target.name + (target.unit == "1" || target.unit.empty() ? "" : " [" + target.unit + "]"));
    return result;
  }



  TrimAnalysis::Run::VectorX
  TrimAnalysis::Run::controls_of(const State &state) const
  {
    VectorX u(controls.size());
    for (unsigned int j = 0; j < controls.size(); ++j)
      u(j) = state.states[controls[j].state];
    return u;
  }



  void
  TrimAnalysis::Run::set_controls(State &state, const VectorX &values) const
  {
    for (unsigned int j = 0; j < controls.size(); ++j)
      state.states[controls[j].state] = values(j);
  }



  TrimAnalysis::Run::VectorX
  TrimAnalysis::Run::wanted() const
  {
    VectorX y(targets.size());
    for (unsigned int k = 0; k < targets.size(); ++k)
      y(k) = targets[k].value;
    return y;
  }



  TrimAnalysis::Run::VectorX
  TrimAnalysis::Run::averages_in_si(const std::vector<double> &averages) const
  {
    VectorX y(targets.size());
    for (unsigned int k = 0; k < targets.size(); ++k)
      y(k) = targets[k].factor * averages[k];
    return y;
  }



  double
  TrimAnalysis::Run::within_limits(const VectorX &u, const VectorX &du) const
  {
    double share = 1;
    for (unsigned int j = 0; j < controls.size(); ++j)
      if (const double room = (du(j) > 0 ? controls[j].upper : controls[j].lower) - u(j);
          std::abs(du(j)) > std::abs(room))
        share = std::min(share, room / du(j));
    return std::max(share, 0.);
  }



  void
  TrimAnalysis::Run::start()
  {
    // where laws do not fit the position at the start, what keeps still grows from zero in the first period
    State begin = context.state;
    begin.held  = false;
    begin.time  = trim.start_time;
    std::vector<double> r(system.size() + 6, 0.);
    system.add_gaps(begin.point(), r.data());
    for (const auto i : system.released_multipliers())
      r[system.layout.of_multiplier(i)] = 0;
    const double largest =
      system.layout.n_multipliers == 0 ?
        0. :
        std::abs(*std::max_element(r.begin() + system.layout.of_multiplier(0), r.end() - 6, [](double a, double b) {
          return std::abs(a) < std::abs(b);
        }));
    const bool grows = largest > 1e-6 * std::max(1., model_length(system.model));

    Context             from   = context;
    std::vector<double> values = begin.states, rates(values.size());
    system.state_rates(begin.point(), rates.data());
    for (const unsigned int i : algebraic_states(system.model))
      rates[i] = 1; // none of those that stay
    if (grows)
      for (unsigned int i = 0; i < rates.size(); ++i)
        if (rates[i] == 0)
          from.state.states[i] = 0;
    state = start_of_motion(from, {trim.parameters.where(), trim.start_time});
    require_controls(state);
    use_symmetry(state);
    const unsigned int n = motion->n_sections();
    for (unsigned int section = 0; section < trim.settle * n; ++section)
      {
        State      end = state;
        const auto f   = [&](State &now, const unsigned int step, const std::vector<double> &) {
          const double share = double(section * motion->steps_of_turn() + step + 1) / trim.n_steps;
          for (unsigned int i = 0; i < rates.size(); ++i)
            if (rates[i] == 0)
              now.states[i] = share * values[i];
        };
        try
          {
            motion->turn(end, grows && section < n ? f : PeriodicMotion::Observer());
          }
        catch (const NotConverged &problem)
          {
            if (!parts || section == 0)
              throw;
            throw NotConverged(problem.what() + behind_a_section);
          }
        motion->begin_again(state, end);
        state = end;
      }
  }



  void
  TrimAnalysis::Run::require_controls(const State &now) const
  {
    std::vector<double> rates(system.layout.n_states);
    system.state_rates(now.point(), rates.data());
    for (const auto &control : controls)
      if (rates[control.state] != 0)
        throw InputError(trim.parameters.where("Controls") + ": the state <" + control.name +
                         "> changes by itself; a control is one of the type <control>");
  }



  TrimAnalysis::Run::Look
  TrimAnalysis::Run::look(const State &from, const PeriodicMotion::Observer &observer)
  {
    if (turns() >= trim.most_turns)
      fail("it is not found in " + std::to_string(trim.most_turns) + " turns (<Most turns>)");
    Look result;
    result.start    = from;
    result.end      = from;
    result.averages = averages_in_si(motion->turn(result.end, observer));
    result.gap      = motion->gap(from, result.end);
    result.miss     = 0;
    for (unsigned int k = 0; k < targets.size(); ++k)
      if (const double miss = std::abs(result.averages(k) - targets[k].value) / targets[k].scale;
          !(miss <= result.miss))
        {
          result.miss         = miss;
          result.worst_target = k;
        }
    const auto largest     = motion->largest(result.gap);
    result.largest_gap     = largest.size;
    result.worst_gap       = largest.entry;
    const auto coordinates = result.end.coordinates;
    motion->begin_again(from, result.end);
    result.turned.resize(coordinates.size());
    for (unsigned int i = 0; i < coordinates.size(); ++i)
      if (!parts || parts->next_of_coordinate(i) == i)
        result.turned[i] = motion->n_sections() * (coordinates[i] - result.end.coordinates[i]);
    return result;
  }



  TrimAnalysis::Run::Look
  TrimAnalysis::Run::settled(State from)
  {
    Look result;
    for (unsigned int i = 0; i < trim.settle * motion->n_sections(); ++i)
      {
        result = look(from);
        from   = result.end;
      }
    return result;
  }



  bool
  TrimAnalysis::Run::is_trimmed(const Look &look) const
  {
    return look.size() < tolerance;
  }



  void
  TrimAnalysis::Run::go()
  {
    start();
    search();
  }



  void
  TrimAnalysis::Run::go_on(const State &near)
  {
    state     = near;
    VectorX u = controls_of(state);
    for (unsigned int j = 0; j < controls.size(); ++j)
      u(j) = std::clamp(u(j), controls[j].lower, controls[j].upper);
    set_controls(state, u);
    use_symmetry(state);
    search();
  }



  void
  TrimAnalysis::Run::search()
  {
    Look now = look(state);
    tell(now);
    check_symmetry(now);
    const Look found = without_drift(now);
    leave(found);
    write(found);
    const std::string of_section =
      motion->n_sections() > 1 ? " of 1/" + std::to_string(motion->n_sections()) + " turn" : "";
    context.log.line("trim: found in " + short_text(turns()) + " turns" +
                     (motion->n_applied > 0 ?
                        " and " + std::to_string(motion->n_applied) + " products with a tangent" + of_section :
                        std::string()) +
                     "; the orbit closes to " + number_to_text("%.1e", found.largest_gap) + ", " + text_of_miss(found));
    air.tell(context, "trim");
    for (unsigned int j = 0; j < controls.size(); ++j)
      context.log.line(
        "  " + controls[j].name + " = " + number_to_text("%.8g", trim.report.controls[j]) +
        (controls[j].unit == "1"   ? "" :
         controls[j].unit == "rad" ? " rad (" + number_to_text("%.6g", trim.report.controls[j] * 180 / M_PI) + " deg)" :
                                     " " + controls[j].unit));
  }



  void
  TrimAnalysis::run(Context &context)
  {
    Complaints complaints;
    check(context.sweep, complaints);
    complaints.throw_if_any();
    report = {};
    find_period(period, parameters, context);
    try
      {
        Run(*this, context).go();
      }
    catch (const NotConverged &problem)
      {
        if (continuation.empty() || !variant)
          throw;
        context.log.line(problem.what());
        Path(*this, context).go();
      }
  }
} // namespace samara
