#include <samara/analysis/floquet.h>
#include <samara/analysis/period_of_rotors.h>
#include <samara/analysis/progress.h>
#include <samara/analysis/slow_modes.h>
#include <samara/analysis/start_of_motion.h>
#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/report/report_page.h>
#include <samara/time/projection.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** In a period, of a rotation that is free in motion and was held in statics. */
    constexpr double speed_that_may_change = 1e-2;



    /** Gaps below which a motion is not let settle further, and above which one is warned about. @{ */
    constexpr double settled_gap = 1e-10, doubtful_gap = 1e-6;
    /** @} */

    /** What a change carried on may be different by from what multipliers were found of. */
    constexpr double allowed_difference = 1e-6;

    /** Of residuals, where none is given: with few columns slow modes come to theirs. @{ */
    constexpr double tolerance_of_largest = 1e-7, tolerance_of_slow_modes = 1e-5;
    /** @} */

    /**
     * Where the largest multipliers are wanted, equations of steps are solved to this part of their residuals: each
     * decade costs one product with the matrix of the stages, and it is an error of the map that all multipliers have.
     * Those smaller than the largest by more than the second number need more.
     * @{
     */
    constexpr double share_of_steps = 1e-3, least_of_largest = 1e-2;
    /** @} */

    /** Up to this many columns all of them are cheaper than Arnoldi's method. */
    constexpr int most_columns = 60;



    /** Does @p work with the map while the log says how far that is. */
    template <typename Work>
    void
    listen(const Context &context, SectionMap &map, const Work &work)
    {
      Progress progress(context.log, "floquet", "the motion over a period", context.page);
      map.listener = progress.teller();
      try
        {
          work();
        }
      catch (...)
        {
          map.listener = {};
          throw;
        }
      map.listener = {};
    }



    /** How far Newton's method has led away from the motion that had settled: it may have found another one. */
    void
    tell_corrections(const Context &context, const SectionMap &map, const State &settled)
    {
      if (map.n_corrections == 0)
        return;
      const auto         x           = increment(context.system, settled, map.map.states().front(), true);
      const auto        &scales      = map.scales();
      unsigned int       most        = 0;
      const auto         size        = [&](const unsigned int i) { return std::abs(x[i]) / scales[i]; };
      const unsigned int n_positions = context.system.layout.of_multiplier(0);
      for (unsigned int i = 0; i < x.size(); ++i)
        if (size(i) > size(most))
          most = i;
      if (size(most) < doubtful_gap)
        return;
      context.log.line("floquet: " + std::to_string(map.n_corrections) + " correction" +
                       (map.n_corrections > 1 ? "s have" : " has") + " moved the start by up to " +
                       number_to_text("%.1e", size(most)) + " of the scales (" +
                       context.system.layout.name_of(most < n_positions ? most : most - n_positions) + ")");
    }



    /**
     * A rotation that statics held and nothing holds in motion is told of before periods are run that lead nowhere.
     * @throws InputError if its speed changes and nothing can bring it back
     */
    void
    check_rotations_let_go(const Context &context, const std::string &where, const State &first, const double T)
    {
      const System &system = context.system;
      if (!context.is_equilibrium || system.released_multipliers().empty())
        return;
      std::vector<double> rates;
      try
        {
          State state = first;
          rates       = Projection(system).accelerations(state);
        }
      catch (const SingularMatrix &)
        {
          return; // steps say where
        }
      double      most = speed_that_may_change;
      std::string worst;
      // of what statics held: joints that only follow have rates of round-off, or swing
      for (const auto &rotation : system.model.rotations)
        {
          if (rotation.coordinate < 0 || first.rates[rotation.coordinate] == 0)
            continue;
          const double change =
            std::abs(rates[system.layout.of_coordinate(rotation.coordinate)] * T / first.rates[rotation.coordinate]);
          if (!(change > most))
            continue;
          most  = change;
          worst = system.model.coordinates[rotation.coordinate];
        }
      if (worst.empty())
        return;
      const std::string text = "nothing holds the speed of <" + worst + "> as statics did: it changes by " +
                               (most < 1 ? number_to_text("%.2g", 100 * most) + " %" : "more than itself") +
                               " in the first period, and a motion that gets slower or faster does not repeat itself; "
                               "let the rotation be <Prescribed>";
      if (!context.system.model.laws_name_states)
        throw InputError(where + ": " + text);
      context.log.warning("floquet", text + ", unless a controller brings it back");
    }
  } // namespace



  void
  FloquetAnalysis::add_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    prm.add("Period", period, "Of the motion; 0: a turn of <Turns of>, or of the steady rotation [s].", Double(0));
    prm.add("Turns of",
            turns_of,
            "Joint whose rotation tells the period: that of its <Turns> at the speed that it has at the start.");
    prm.add("Turns", turns, "Turns of that joint in a period [1].", Double(0));
    prm.add("Steps", n_steps, "Steps a period.", Integer(1));
    prm.add("Stages",
            n_stages,
            "Stages of the integrator, 1 to 3: multipliers converge with the order 2 s for spectral radius 1.",
            Integer(1, 3));
    prm.add(
      "Spectral radius",
      spectral_radius,
      "At infinite frequency: 1 adds no damping; less takes away what the steps do not resolve, and adds damping to "
      "what they do, which is told [1].",
      Double(0, 1));
    prm.add("Newton tolerance", newton_tolerance, "Of the steps of the orbit, see dynamic analysis [1].", Double(0));
    prm.add("Iterations", max_iterations, "Most Newton iterations with one factorisation.", Integer(2));
    prm.add("Settle",
            most_periods,
            "Most periods that the motion is given to become periodic by itself; it is stopped when it is.",
            Integer(1));
    prm.add("Corrections",
            most_corrections,
            "Most steps of Newton's method on periodicity, if the motion has not become periodic by itself.",
            Integer(0));
    prm.add(
      "Largest gap",
      largest_gap,
      "What a motion may lack to periodicity, parts of the model's length, radians and the largest speed; more is "
      "refused [1].",
      Double(0));
    prm.add(
      "Method",
      method,
      "implicit: the largest multipliers by Arnoldi's method; fast: those of the part of a period in which repeated "
      "parts take each other's places; classical: all, from all columns of the map over the period; automatic: fast "
      "with a <Symmetry>, and all columns where they are few.",
      Selection("automatic|implicit|fast|classical"));
    prm.add("Wanted", wanted, "Number of multipliers, largest first; of a pair both count.", Integer(1));
    prm.add(
      "Highest frequency",
      highest_frequency,
      "Modes up to this |lambda|, as the model linearised at the start has them, are found in place of those with the "
      "largest multipliers, which of elastic rotors are what the steps do not resolve; 0: the latter [rad/s].",
      Double(0));
    prm.add("Tolerance",
            tolerance,
            "Of what is found by iteration: residual relative to each multiplier; 0: 1e-7, of slow modes 1e-5 [1].",
            Double(0, 1));
    prm.add(
      "Symmetry",
      symmetry,
      "Names of repeated parts, each where the next one was a part of the period before, groups behind semicolons: "
      "blade 1, blade 2; lag 1, lag 2. Belongs to a part what has its name in its own.");
    prm.add("Turning", turning, "Names of bodies and joints that turn with the repeated parts and are not repeated.");
    prm.add("Animations", n_animations, "Number of modes for which a moving picture is written.", Integer(0));
  }



  void
  FloquetAnalysis::check(const std::vector<double> &, Complaints &complaints) const
  {
    const auto complain = [&](const std::string &entry, const std::string &text) {
      complaints.add(parameters.where(entry), text);
    };
    if (period > 0 ? !turns_of.empty() : turns_of.empty() && parameters.is_set("Period"))
      complain("Period", "give either the <Period>, or the joint <Turns of> which make one");
    if (!(turns > 0))
      complain("Turns", "the <Turns> in a period must be positive");
    if (!(newton_tolerance > 0))
      complain("Newton tolerance", "the <Newton tolerance> must be positive");
    if (method == "classical" && highest_frequency > 0)
      complain("Highest frequency", "<Method = classical> finds all multipliers; leave out the <Highest frequency>");
    if (method == "fast" && symmetry.empty())
      complain("Method", "the fast map needs the <Symmetry>: which parts are repeated");
    if (groups().empty() && !turning.empty())
      complain("Turning", "<Turning> belongs to a <Symmetry>: which parts are repeated");
    if (const auto g = groups(); !g.empty() && n_steps % g[0].size() != 0)
      complain("Steps", "the <Steps> must be a multiple of the " + std::to_string(g[0].size()) + " repeated parts");
  }



  std::vector<std::vector<std::string>>
  FloquetAnalysis::groups() const
  {
    return groups_of_names(symmetry);
  }



  bool
  FloquetAnalysis::is_by_sections() const
  {
    return !groups().empty() && (method == "fast" || method == "automatic");
  }



  void
  FloquetAnalysis::start(Context &)
  {
    of_speeds.reset();
    tracking = {};
  }



  State
  FloquetAnalysis::first_state(const Context &context) const
  {
    // in a sweep a motion with another speed than that of its row would be a wrong result
    return motion_or_start(context, {parameters.where(), 0., true, !context.sweep.empty()});
  }



  double
  FloquetAnalysis::period_at(const Context &context, const State &state) const
  {
    if (turns_of.empty())
      {
        double of_motion = period;
        find_period(of_motion, parameters, context);
        return of_motion;
      }
    const Model &model = context.system.model;
    // those that are no rotations have no turns
    auto names = model.coordinates;
    for (unsigned int i = 0; i < names.size(); ++i)
      if (model.coordinate_units[i] != "rad")
        names[i].clear();
    auto found = std::find(names.begin(), names.end(), turns_of);
    if (found == names.end())
      found = std::find(names.begin(), names.end(), turns_of + ".rotation");
    if (found == names.end())
      throw InputError(parameters.where("Turns of") + ": <" + turns_of +
                       "> is no rotation of a joint that is prescribed, has a spring, or is asked for" +
                       did_you_mean(turns_of, model.coordinates));
    const double rate = std::abs(state.rates[found - names.begin()]);
    double       most = 0;
    for (unsigned int i = 0; i < names.size(); ++i)
      if (!names[i].empty())
        most = std::max(most, std::abs(state.rates[i]));
    // what does not turn has a rate of round-off of those that do
    if (!(rate > 1e-9 * most))
      throw InputError(parameters.where("Turns of") + ": <" + turns_of + "> does not turn at the start");
    return turns * 2 * M_PI / rate;
  }



  RepeatedParts
  FloquetAnalysis::repeated_parts(const System &system) const
  {
    if (groups().empty())
      return RepeatedParts(system);
    try
      {
        return RepeatedParts(system, groups(), turning);
      }
    catch (const std::invalid_argument &problem)
      {
        if (!is_by_sections())
          return RepeatedParts(system); // they would only name modes
        throw InputError(parameters.where("Symmetry") + ": " + problem.what());
      }
  }



  void
  FloquetAnalysis::run(Context &context)
  {
    Complaints complaints;
    check(context.sweep, complaints);
    complaints.throw_if_any();
    const System &system = context.system;
    const State   first  = first_state(context);
    const double  T      = period_at(context, first);
    check_rotations_let_go(context, parameters.where(), first, T);
    const RepeatedParts named = repeated_parts(system), parts = is_by_sections() ? named : RepeatedParts(system);
    SectionMap          map(system,
                   {T / parts.n(), n_steps / parts.n(), n_stages, spectral_radius, newton_tolerance, max_iterations},
                   parts);
    try
      {
        State settled;
        listen(context, map, [&]() {
          map.settle(first, most_periods, settled_gap);
          settled = map.map.states().front();
          map.correct(most_corrections, settled_gap);
        });
        tell_corrections(context, map, settled);
        check_gap(context, map);
        check_corners(context, map);
        check_switches(context, map);
        FloquetModes found;
        listen(context, map, [&]() {
          map.begin("whether the motion is periodic behind the period, too", std::max(1u, parts.n() - 1));
          check_behind(map, map.difference_behind());
          found = find(map);
          if (found.found.empty())
            throw NotConverged("floquet analysis: nothing moves that could grow or decay");
          map.begin("harmonics and names of " + std::to_string(found.found.size()) + " modes");
          describe(map, named, found, found.n_looked_for > 0 ? found.found.size() : wanted);
        });
        gap       = map.gap.size;
        orbit     = map.map.states().front();
        n_columns = found.n_columns;
        modes     = found.found;
        report(context, found, T);
      }
    catch (const NotConverged &problem)
      {
        const std::string text = problem.what();
        throw NotConverged(text.find("floquet analysis") == 0 ? text : "floquet analysis: " + text);
      }
    if (!context.sweep.empty())
      add_to_speeds(context, T);
    if ((context.pictures || (context.page != nullptr && context.page->draws())) && context.is_shown() &&
        !context.folder.empty())
      animate(context, map);
  }



  void
  FloquetAnalysis::check_gap(Context &context, const SectionMap &map) const
  {
    const std::string text = "the motion lacks " + number_to_text("%.1e", map.gap.size) + " to periodicity after " +
                             short_text(double(map.n_sections_run) / map.repeated().n()) + " periods and " +
                             std::to_string(map.n_corrections) + " corrections, most at " +
                             context.system.layout.name_of(map.gap.unknown);
    if (!(map.gap.size <= largest_gap))
      {
        keep_motion(context, map);
        throw NotConverged(
          "floquet analysis: " + text +
          (context.folder.empty() ? "" :
                                    "; floquet_orbit.csv has its last " +
                                      std::string(map.repeated().n() > 1 ? "part of a period" : "period")) +
          ".\n  Multipliers belong to a motion that repeats itself. Is the period right? Damping lets it settle in more "
          "periods (<Settle>); what is unstable never does by itself: begin nearer to the periodic motion" +
          (map.repeated().n() > 1 ?
             ". Parts that are not alike, in another order, or <Turning> ones that are not named, "
             "look like this, too: try Method = implicit" :
             "") +
          ".");
      }
    if (map.gap.size > doubtful_gap)
      context.log.warning("floquet",
                          text + "; multipliers lack as much, and more where that dies away slowly: then the periodic "
                                 "motion is far away");
  }



  void
  FloquetAnalysis::check_behind(const SectionMap &map, const double difference) const
  {
    // where the orbit has a gap the map behind it is another one by about as much, times the curvature of the motion
    if (difference <= allowed_difference + 100 * map.gap.size)
      return;
    const std::string by = number_to_text("%.1e", difference) + " of its size";
    if (map.repeated().n() > 1)
      throw NotConverged(
        "floquet analysis: the <Symmetry> is none: a change of the motion is different by " + by +
        " after a part of the period from what the repeated parts say.\n  All of them must be alike, in "
        "the order in which they come round, what carries them too; if they are not, set Method = "
        "implicit.");
    throw NotConverged("floquet analysis: the motion is periodic, but it, or a change of it, is different by " + by +
                       " in the next period.\n  Is the period right? Something that depends on time does not repeat "
                       "itself with it.");
  }



  void
  FloquetAnalysis::check_corners(const Context &context, const SectionMap &map) const
  {
    const auto  &states = map.map.states();
    const double begin = states.front().time, end = states.back().time, h = (end - begin) / (states.size() - 1);
    for (double t = context.system.next_corner(begin, end); t < end; t = context.system.next_corner(t, end))
      if (std::abs(std::remainder(t - begin, h)) > 1e-9 * h)
        return context.log.warning(
          "floquet",
          "something prescribed has a corner or a jump at t = " + number_to_text("%.6g", t) +
            " s, within a step: multipliers converge slowly there; take <Steps> that end at it");
  }



  void
  FloquetAnalysis::check_switches(const Context &context, const SectionMap &map) const
  {
    std::vector<double> first, now;
    context.system.pieces(map.map.states().front().point(), first);
    for (const auto &state : map.map.states())
      {
        now.clear();
        context.system.pieces(state.point(), now);
        if (now != first)
          return context.log.warning(
            "floquet",
            "a law switches at about t = " + number_to_text("%.6g", state.time) +
              " s: if it jumps there, multipliers lack what the jump does; if it has a corner, "
              "they converge slowly with the <Steps>");
      }
  }



  FloquetModes
  FloquetAnalysis::find(SectionMap &map) const
  {
    // as many as the constraints leave; more where these are redundant
    const Layout &layout = map.system.layout;
    const int     n      = layout.n_kinematic() + layout.of_multiplier(0) - 2 * int(layout.n_multipliers);
    if (method == "classical" || (method != "implicit" && n <= most_columns))
      return all_floquet_modes(map);
    if (highest_frequency > 0)
      return slow_floquet_modes(map, {highest_frequency, tolerance > 0 ? tolerance : tolerance_of_slow_modes});
    // what is found beyond those that there are is round-off
    if (int(wanted) >= n)
      return all_floquet_modes(map);
    const double residuals = tolerance > 0 ? tolerance : tolerance_of_largest,
                 exact     = map.map.settings.tangent_tolerance;
    FloquetModes result    = largest_floquet_modes(map, wanted, residuals, std::max(exact, share_of_steps * residuals));
    if (!result.found.empty() &&
        std::abs(result.found.back().of_section) < least_of_largest * std::abs(result.found[0].of_section))
      result = largest_floquet_modes(map, wanted, residuals, exact);
    return result;
  }
} // namespace samara
