// Equilibria from a state to the full load and speeds, in steps as large as Newton's method takes them.

#include <samara/analysis/progress.h>
#include <samara/analysis/static.h>
#include <samara/base/text.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** What turns further in a load step may have gone to another equilibrium than the load leads to [rad]. */
    constexpr double largest_turn = 1;
    /** The same of what turns against the sense of the path at an end of the step [rad]. */
    constexpr double largest_turn_back = 0.1;
    /** Fraction of the load in which a path turns by as much only if it has an end there [1]. */
    constexpr double step_of_jumps = 1e-12;
    /** Beyond a stability limit, what is farther than this is another branch, not the same one a little further on [1].
     */
    constexpr double distance_of_branches = 1e-3;
    /** Unknowns from which on an equilibrium may take long enough to say how far it is: there a second. */
    constexpr unsigned int worth_telling = 10000;

    /** The largest change between two states, in parts of the model's size or rad, and the unknown that has it. */
    std::pair<double, unsigned int>
    largest_change(const System &system, const State &from, const State &to)
    {
      const double                    length = model_length(system.model);
      std::pair<double, unsigned int> result = {0., 0};
      const auto                      look   = [&](const double change, const unsigned int unknown) {
        result = std::max(result, {std::abs(change), unknown});
      };
      for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
        {
          const Eigen::Map<const Vector3> x(&from.q[12 * node]), x_to(&to.q[12 * node]);
          const Eigen::Map<const Matrix3> D(&from.q[12 * node + 3]), D_to(&to.q[12 * node + 3]);
          look((x_to - x).norm() / length, system.layout.of_node(node));
          look((D_to - D).norm() / M_SQRT2, system.layout.of_node(node) + 3);
        }
      for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
        {
          const int unknown = system.layout.of_coordinate(i);
          look((to.coordinates[i] - from.coordinates[i]) / system.layout.scale_of(unknown, length), unknown);
        }
      return result;
    }

    /** How the unknowns grow with the load at an equilibrium, but for a positive factor; nothing if they may move. */
    std::vector<double>
    growth_with_load(const System &system, const State &state, ArcLength &method)
    {
      PathPoint point;
      point.state = state;
      system.stresses(state, point.state.stress);
      try
        {
          method.start(point);
        }
      catch (const SingularMatrix &)
        {
          return {};
        }
      return point.tangent;
    }
  } // namespace



  int
  StaticAnalysis::turned_too_far(const System &system, const State &from, const State &to, const bool by_load) const
  {
    std::vector<unsigned int> suspects;
    for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
      if (system.model.coordinate_units[i] == "rad" && system.model.prescribed.count(i) == 0)
        {
          const double turn = std::abs(to.coordinates[i] - from.coordinates[i]);
          if (turn > largest_turn)
            return i;
          if (turn > largest_turn_back)
            suspects.push_back(i);
        }
    if (suspects.empty() || !by_load)
      return -1;
    ArcLength method(system, *solver, load_weight, tolerance, max_iterations);
    for (const State *const state : {&from, &to})
      if (const auto growth = growth_with_load(system, *state, method); !growth.empty())
        for (const unsigned int i : suspects)
          if (growth[system.layout.of_coordinate(i)] * (to.coordinates[i] - from.coordinates[i]) < 0)
            return i;
    return -1;
  }



  /** The steps from the context's state to the full load and speeds. */
  class StaticAnalysis::LoadPath
  {
  public:
    LoadPath(StaticAnalysis &analysis, Context &context);
    void follow();

  private:
    StaticAnalysis            &analysis;
    Context                   &context;
    const System              &system;
    Newton                     newton;
    const std::vector<double> &speeds; ///< at the end
    std::vector<double>        start_speeds;
    const double               start_factor;
    const bool                 is_given; ///< the load factor, as an expression
    /** Between two speeds there may be no path; and nothing holds a start to what is unstressed elsewhere. */
    const bool is_between_speeds, at_rest;

    State              start;
    std::optional<int> sign_at_start;
    double             fraction            = 0, step, least_step;
    bool               has_looked_at_start = false;

    NewtonResult attempt(const State &from, double to_fraction, State &trial);
    double       next_fraction() const;
    void         look_for_limit(const State &trial, NewtonResult &result);
    bool         by_load() const;
    bool         is_released();
    void         look_at_turn(int turned, double next, const State &trial, NewtonResult &result);
    void         accept(double next, const State &trial, const NewtonResult &result);
    void         try_half(double next, const NewtonResult &result);
  };



  StaticAnalysis::LoadPath::LoadPath(StaticAnalysis &analysis, Context &context)
    : analysis(analysis)
    , context(context)
    , system(context.system)
    , newton(context.system, *analysis.solver, analysis.tolerance, analysis.max_iterations)
    , speeds(context.speeds)
    , start_speeds(context.speeds.size(), 0.)
    , start_factor(context.is_equilibrium ? context.state.factor : 0.)
    // an analysis that no file has asked for has no entries
    , is_given(analysis.parameters.has("Load factor") && analysis.parameters.is_set("Load factor"))
    , is_between_speeds(context.is_equilibrium && !context.sweep.empty())
    , at_rest(std::all_of(speeds.begin(), speeds.end(), [](const double w) { return w == 0.; }))
    , start(context.state)
    , step(1. / analysis.initial_steps)
    , least_step(analysis.smallest_step)
  {
    start.factor = start_factor;
    if (is_given && !at_rest)
      throw InputError(analysis.parameters.where("Load factor") +
                       ": with a steady rotation loads and speeds grow together; leave out the <Load factor>");
    if (!is_between_speeds)
      return;
    const auto here = std::find(context.sweep.begin(), context.sweep.end(), speeds.empty() ? 0. : speeds[0]);
    if (here != context.sweep.begin())
      start_speeds = context.speeds_at(*(here - 1));
  }



  void
  StaticAnalysis::LoadPath::follow()
  {
    while (fraction < 1.)
      {
        const double next = next_fraction();
        State        trial;
        NewtonResult result = attempt(context.state, next, trial);
        // between two speeds of a sweep there may be a critical one, where no path leads through: start afresh beyond
        // it
        if (!result.converged && next == 1. && start_speeds != speeds && start_factor == 1.)
          result = attempt(system.reference(), next, trial);
        look_for_limit(trial, result);
        const int turned = result.converged && !is_between_speeds ?
                             analysis.turned_too_far(system, context.state, trial, by_load()) :
                             -1;
        if (turned >= 0 && is_released())
          continue;
        if (turned >= 0)
          look_at_turn(turned, next, trial, result);
        if (result.failure == Failure::not_finite)
          analysis.give_up(context, result, fraction); // no other step helps
        if (result.converged)
          accept(next, trial, result);
        else
          try_half(next, result);
      }
  }



  double
  StaticAnalysis::LoadPath::next_fraction() const
  {
    const double end = is_given ? std::min(1., analysis.load_factor.next_corner(fraction, 1.)) : 1.;
    return fraction + 1.000001 * step > end ? end : fraction + step;
  }



  NewtonResult
  StaticAnalysis::LoadPath::attempt(const State &from, const double to_fraction, State &trial)
  {
    trial        = from;
    trial.time   = analysis.time;
    trial.held   = true;
    trial.factor = is_given ? analysis.load_factor(to_fraction) : start_factor + to_fraction * (1. - start_factor);
    std::vector<double> trial_speeds(speeds.size());
    for (unsigned int i = 0; i < speeds.size(); ++i)
      trial_speeds[i] = start_speeds[i] + to_fraction * (speeds[i] - start_speeds[i]);
    std::optional<Progress> progress;
    if (system.size() > worth_telling)
      progress.emplace(context.log,
                       "static",
                       "equilibrium at the load factor " + short_text(trial.factor),
                       context.page);
    const NewtonResult result = analysis.equilibrium(context, newton, trial, trial_speeds);
    analysis.n_iterations += result.iterations;
    return result;
  }



  void
  StaticAnalysis::LoadPath::look_for_limit(const State &trial, NewtonResult &result)
  {
    std::optional<Progress> progress;
    if (system.size() > worth_telling)
      progress.emplace(context.log, "static", "whether the equilibrium is stable", context.page);
    if (!result.converged || analysis.stability_limits != "stop" ||
        !analysis.is_beyond_limit(context, start, sign_at_start, trial))
      return;
    const auto [change, unknown] = largest_change(system, context.state, trial);
    const bool is_far            = change > distance_of_branches;
    result.fail(Failure::stability_limit,
                "a stability limit (limit point or bifurcation) is passed" +
                  (is_far ? ", <" + system.layout.name_of(unknown) + "> is on another branch" : std::string()));
    // one that the path may pass by closely: it is not given up before it has been followed
    if (is_far)
      least_step = 0.5 * step_of_jumps;
  }



  /** Whether nothing but the load grows. */
  bool
  StaticAnalysis::LoadPath::by_load() const
  {
    return at_rest && start_factor < 1 && !is_given;
  }



  /**
   * What does not grow with the load, as a spring away from its rest, moves at once: from there on it is followed.
   * Whether it does so at the start; that is the next equilibrium then.
   */
  bool
  StaticAnalysis::LoadPath::is_released()
  {
    if (fraction > 0 || has_looked_at_start)
      return false;
    has_looked_at_start = true;
    State              released;
    const NewtonResult at_start = attempt(context.state, step_of_jumps, released);
    if (!at_start.converged || analysis.turned_too_far(system, context.state, released, by_load()) < 0)
      return false;
    ++analysis.n_steps;
    fraction      = step_of_jumps;
    context.state = released;
    analysis.record(context, released, fraction, at_start);
    return true;
  }



  void
  StaticAnalysis::LoadPath::look_at_turn(const int turned, const double next, const State &trial, NewtonResult &result)
  {
    const bool jumps    = next - fraction <= step_of_jumps;
    const bool may_jump = analysis.stability_limits == "pass" || !at_rest;
    if (jumps && (fraction == 0 || may_jump))
      return;
    result.fail(jumps ? Failure::stability_limit : Failure::other,
                "<" + system.model.coordinates[turned] + "> turns by " +
                  short_text(trial.coordinates[turned] - context.state.coordinates[turned]) + " rad" +
                  (jumps ? " at once, past a stability limit (limit point or bifurcation)" : ""));
    least_step = 0.5 * step_of_jumps;
  }



  void
  StaticAnalysis::LoadPath::accept(const double next, const State &trial, const NewtonResult &result)
  {
    ++analysis.n_steps;
    fraction      = next;
    context.state = trial;
    analysis.record(context, trial, fraction, result);
    // Newton's method has not had to search: it may go twice as far (doc/theory/statics.md, load steps)
    if (result.iterations <= 8)
      step = is_given ? std::min(2 * step, 1. / analysis.initial_steps) : 2 * step;
  }



  void
  StaticAnalysis::LoadPath::try_half(const double next, const NewtonResult &result)
  {
    step = (next - fraction) / 2;
    context.log.line("  load step to " + short_text(next) + ": " + result.reason + "; trying " +
                     short_text(fraction + step));
    if (step < least_step)
      analysis.give_up(context, result, fraction);
  }



  void
  StaticAnalysis::follow_load(Context &context)
  {
    LoadPath(*this, context).follow();
  }
} // namespace samara
