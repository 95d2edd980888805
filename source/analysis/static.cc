#include <samara/analysis/check.h>
#include <samara/analysis/integrating_states.h>
#include <samara/analysis/line_of_air.h>
#include <samara/analysis/negative_directions.h>
#include <samara/analysis/prescribed_motion.h>
#include <samara/analysis/static.h>
#include <samara/analysis/steady_loads.h>
#include <samara/base/text.h>
#include <samara/report/report_page.h>
#include <samara/solvers/anderson.h>
#include <samara/solvers/equilibrate.h>
#include <samara/solvers/kept_inertia.h>
#include <samara/solvers/steady_motion.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    std::vector<double>
    values_of(const Context &context, const State &state, const double first)
    {
      std::vector<double> row(1, first);
      for (const auto &probe : context.probes)
        row.push_back(probe.value(state));
      return row;
    }

    std::vector<std::pair<std::string, std::string>>
    columns_of(const Context &context, const std::string &name, const std::string &unit)
    {
      std::vector<std::pair<std::string, std::string>> columns = {{name, unit}};
      for (const auto &probe : context.probes)
        columns.emplace_back(probe.name, probe.unit);
      return columns;
    }

    /** What moves in the motion that the factors of a nearly singular tangent resist least: that which any load
     * excites. */
    std::string
    softest_motion(const System &system, const LinearSolver &solver)
    {
      Eigen::VectorXd z(system.size());
      for (int i = 0; i < z.size(); ++i)
        z(i) = std::cos(1. + 2. * i * i); // a load in all directions that nothing in a model is orthogonal to
      for (int pass = 0; pass < 2; ++pass)
        {
          solver.solve(z.data());
          if (!z.allFinite() || z.isZero(0))
            return "something moves";
          z /= z.lpNorm<Eigen::Infinity>();
        }
      return what_moves(system, z);
    }
  } // namespace



  void
  StaticAnalysis::start(Context &context)
  {
    processor_start = std::clock();
    has_told_motion = false;
    n_negative_told = 0;
    solver          = make_solver(context.system.layout.pattern);
    for (auto *const old : {&history, &speed_history, &path_history, &limits_history})
      old->reset(); // of a sweep before
    pictures.reset();
    if (context.folder.empty())
      return;
    history = std::make_unique<History>(context.folder, "static", columns_of(context, "load factor", "1"));
    if (!context.sweep.empty())
      speed_history = std::make_unique<History>(context.folder, "static_speeds", columns_of(context, "speed", "rad/s"));
    if (path == "arc length")
      {
        path_history =
          std::make_unique<History>(context.folder,
                                    "static_path",
                                    std::vector<std::pair<std::string, std::string>>{{"arc length", "1"},
                                                                                     {"load factor", "1"},
                                                                                     {"step", "1"},
                                                                                     {"iterations", "1"},
                                                                                     {"sign of the determinant", "1"}});
        auto columns = columns_of(context, "load factor", "1");
        columns.insert(columns.begin(), {"1 limit point 2 bifurcation", "1"});
        limits_history = std::make_unique<History>(context.folder, "static_limits", columns);
      }
    if (context.pictures)
      pictures = std::make_unique<Pictures>(context.folder, "static");
  }



  NewtonResult
  StaticAnalysis::equilibrium(const Context             &context,
                              Newton                    &newton,
                              State                     &state,
                              const std::vector<double> &speeds) const
  {
    const auto &rotations = context.system.model.rotations;
    const bool  at_joints =
      std::any_of(rotations.begin(), rotations.end(), [](const auto &r) { return r.coordinate >= 0; });
    set_steady_motion(context.system, state, speeds);
    NewtonResult total = newton.solve(state);
    if (!at_joints)
      return total;

    // axes of joints follow their deformed supports: until the motion no longer changes with the configuration
    Anderson        anderson;
    Eigen::VectorXd motion = steady_motion_vector(context.system, state);
    for (unsigned int pass = 0; pass < 30 && total.converged; ++pass)
      {
        set_steady_motion(context.system, state, speeds);
        const Eigen::VectorXd seen = steady_motion_vector(context.system, state);
        if ((seen - motion).norm() <= 1e-10 * seen.norm()) // doc/theory/steady_rotation.md, the equilibrium
          return total;
        motion = anderson.next(motion, seen);
        set_steady_motion_vector(context.system, state, motion);
        const NewtonResult result = newton.solve(state);
        total.converged           = result.converged;
        total.failure             = result.failure;
        total.reason              = result.reason;
        total.residual            = result.residual;
        total.worst               = result.worst;
        total.iterations += result.iterations;
      }
    if (!total.converged)
      return total;
    total.fail(Failure::other, "the steady motion does not settle");
    return total;
  }



  bool
  StaticAnalysis::is_stable_by_iteration(const Context &context, const State &state) const
  {
    const System &system = context.system;
    const Layout &layout = system.layout;
    if (system.size() <= large_model || layout.n_states > 0 || !layout.nonholonomic.empty() ||
        !state.left_out.empty() ||
        std::any_of(context.speeds.begin(), context.speeds.end(), [](const double w) { return w != 0.; }))
      return false;
    const SymmetricFactors *const factors = symmetric_factors_of(*solver);
    if (!factors || factors->n_negative_pivots != int(layout.n_multipliers))
      return false;
    SparseMatrix K(layout.pattern);
    State        at = state;
    system.stresses(at, at.stress);
    system.tangent(at, K);
    return n_positive_is_kept(*factors, K).is_shown;
  }



  int
  StaticAnalysis::stability_sign(const Context &context, const State &state) const
  {
    for (const double speed : context.speeds)
      if (speed != 0.)
        return 0;
    SparseMatrix K(context.system.layout.pattern);
    State        at = state;
    context.system.stresses(at, at.stress);
    context.system.tangent(at, K);
    equilibrate(K); // else units decide what is singular
    try
      {
        solver->factorize(K);
      }
    catch (const SingularMatrix &)
      {
        return 0; // free to move: nothing can be said
      }
    // of a matrix that is singular to round-off the sign is an accident
    return solver->reciprocal_condition() > 1e-18 ? solver->determinant_sign() : 0;
  }



  namespace
  {
    /** Whether nothing but elastic strains and constraints could push at @p start, which is free of stress. */
    bool
    is_free_of_forces(const Context &context, const State &start)
    {
      const Layout &layout = context.system.layout;
      return !context.is_equilibrium && layout.n_states == 0 && layout.stops.empty() && layout.frictions.empty() &&
             layout.nonlinear_springs.empty() && layout.contact_groups.empty() && layout.nonholonomic.empty() &&
             std::all_of(start.stress.begin(), start.stress.end(), [](const double s) { return s == 0.; }) &&
             std::all_of(start.multipliers.begin(), start.multipliers.end(), [](const double l) { return l == 0.; });
    }
  } // namespace



  bool
  StaticAnalysis::is_beyond_limit(const Context      &context,
                                  const State        &start,
                                  std::optional<int> &sign_at_start,
                                  const State        &found) const
  {
    const Layout &layout         = context.system.layout;
    const int     sign_if_stable = (layout.n_multipliers - found.left_out.size()) % 2 == 0 ? 1 : -1;
    // without constraints the unloaded model is stable, all eigenvalues positive, or free to move; of a large one with
    // constraints, too, this is taken for granted, as a look at its matrix costs as much as all else
    const bool is_stable_at_start = layout.n_multipliers == 0 ?
                                      !context.is_equilibrium :
                                      context.system.size() > large_model && is_free_of_forces(context, start);
    // Newton's factors, of the found state or of one before it
    const bool has_factors_nearby = sign_at_start || is_stable_at_start;
    if (!has_factors_nearby)
      sign_at_start = stability_sign(context, start);
    // Newton's last tangent will not do: displacements below its tolerance may go with another stress
    is_shown_stable = has_factors_nearby && is_stable_by_iteration(context, found);
    n_shown += is_shown_stable;
    const int sign = is_shown_stable ? sign_if_stable : stability_sign(context, found);
    if (!sign_at_start)
      {
        if (sign == sign_if_stable)
          return false;
        sign_at_start = stability_sign(context, start);
        stability_sign(context, found); // the solver keeps the matrix of the equilibrium
      }
    return *sign_at_start != 0 && sign != *sign_at_start;
  }



  void
  StaticAnalysis::run(Context &context)
  {
    if (!solver)
      start(context); // who runs it once need not
    n_steps = n_iterations = n_shown = 0;
    is_shown_stable                  = false;
    singular_points.clear();
    require_couplings(context.system, true);
    if (path == "arc length")
      follow_path(context);
    else
      follow_load(context);
    require_nearest_places(context.system, context.state);
    context.is_equilibrium = true;
    tell_motion(context);
    tell_instability(context);
    meshes.conclude(context, "static");
    State reported = context.state;
    if (context.least_norm && !reported.left_out.empty())
      RedundantRows(context.system).make_least(reported);
    if (context.sweep.empty())
      {
        LineOfAir air;
        air.add(context.system, context.state);
        air.tell(context, "static");
      }
    if (speed_history)
      speed_history->add(values_of(context, reported, context.speeds.empty() ? 0. : context.speeds[0]));
    const double condition = solver->reciprocal_condition();
    // below round-off: where it is merely small, as of slender beams, nothing is wrong
    if (condition < 1e-17)
      context.log.warning(
        "static",
        "the tangent matrix is nearly singular (reciprocal condition number " + short_text(condition) +
          "): " + softest_motion(context.system, *solver) +
          " against hardly any force. Is this motion free, for want of a joint or a spring that holds "
          "it, or is a stability limit near?");
  }



  void
  StaticAnalysis::tell_motion(const Context &context)
  {
    if (has_told_motion)
      return;
    State              turning = context.state;
    const SteadyMotion motion  = set_steady_motion(context.system, turning, context.speeds);
    has_told_motion            = !motion.is_steady() || !motion.shared.empty() || motion.n_at_rest > 0;
    if (!motion.is_steady())
      context.log.warning("static",
                          "parts do not turn steadily: " +
                            why_not_steady(context.system, turning, context.speeds, motion) +
                            "; this is the equilibrium of one azimuth, with the speeds that parts have there");
    else
      {
        tell_loads(context);
        tell_prescribed(context, turning);
      }
    if (!motion.shared.empty())
      {
        std::string names;
        for (const auto &name : motion.shared)
          names += (names.empty() ? "<" : ", <") + name + ">";
        context.log.warning("static", "nothing says how the turning is shared between " + names + ": hold one of them");
      }
    if (motion.n_at_rest > 0)
      context.log.line("  static: " + std::to_string(motion.n_at_rest) +
                       " rigid motions that nothing relates to a drive or the ground; they are taken to be at rest");
  }



  namespace
  {
    /** Whether pivots of symmetric factors of the tangent show that nothing is unstable; factors are made in the
     * solver's order unless they @p are_there. */
    bool
    is_stable_by_pivots(const Context &context, const bool are_there, LinearSolver &solver)
    {
      if (!solver.n_negative())
        return false; // these factors do not show it
      if (!are_there)
        {
          SparseMatrix K(context.system.layout.pattern);
          context.system.tangent(context.state, K);
          try
            {
              solver.factorize(K);
            }
          catch (const SingularMatrix &)
            {
              return false;
            }
        }
      return solver.n_negative() == int(context.system.layout.n_multipliers - context.state.left_out.size());
    }
  } // namespace



  void
  StaticAnalysis::tell_instability(const Context &context)
  {
    // at rest the tangent here has been factorised already, for the sign that tells of limits
    const bool at_rest =
                 std::all_of(context.speeds.begin(), context.speeds.end(), [](const double w) { return w == 0.; }),
               are_there = at_rest && path == "load" && stability_limits == "stop";
    NegativeDirections negative;
    if (is_shown_stable)
      ; // none
    else if (context.system.size() > large_model || !is_stable_by_pivots(context, are_there, *solver))
      negative = negative_directions(context.system, context.state, solver.get());
    if (negative.number == n_negative_told)
      return; // of a sweep each number once
    n_negative_told = negative.number;
    if (negative.number == 0)
      return;
    std::string text = negative.text(context.system);
    if (!context.sweep.empty())
      text = "at " + short_text(context.speeds[0]) + " rad/s " + text;
    if (negative.turning == NegativeDirections::Turning::as_one && !negative.are_unstable())
      text += ". Analyses = static, modal tells whether they hold it";
    if (negative.are_unstable())
      text +=
        ". Look for a stable one: less load, a small imperfection that shows the way to it, Path = arc length from the "
        "load where it is stable; if it moves to and fro from node to node, a finer mesh";
    context.log.warning("static", text);
  }



  void
  StaticAnalysis::tell_loads(const Context &context)
  {
    State state               = context.state;
    state.held                = false; // a drive whose moment changes does not turn steadily
    const ChangingLoads loads = changing_loads(context.system, state);
    if (loads.are_steady())
      return;
    has_told_motion = true;
    context.log.warning("static", loads.text() + "; this is the equilibrium of one azimuth, as if it stayed");
  }



  void
  StaticAnalysis::tell_prescribed(const Context &context, const State &turning)
  {
    double fastest = 0;
    for (const double speed : context.speeds)
      fastest = std::max(fastest, std::abs(speed));
    if (const std::string text = about_stopped_rotor(context.system, turning, "this is the equilibrium"); !text.empty())
      {
        has_told_motion = true;
        context.log.warning("static", text);
      }
    if (fastest == 0)
      return;
    const PrescribedMotion other =
      prescribed_beside(context.system, turning, {0., 0.1 / fastest, 1 / fastest, 2.4 / fastest});
    if (!(other.rate > 1e-9 * fastest))
      return;
    has_told_motion = true;
    context.log.warning("static",
                        "<" + other.name + "> is prescribed to move, with up to " + short_text(other.rate) +
                          " rad/s or lengths of the model per second, beside the steady rotation; this is the "
                          "equilibrium of one moment, as if it kept still there");
  }



  void
  StaticAnalysis::record(Context &context, const State &state, const double progress, const NewtonResult &result)
  {
    require_finite_state(context.system, state);
    const std::string what = path == "arc length" ?
                               "load factor " + short_text(state.factor) + " at the arc " + short_text(progress) :
                             state.factor == 1. && progress == 1. ? "full load" :
                                                                    short_text(100 * state.factor) + " % of the load";
    context.log.line("  static: " + what +
                     (context.speeds.empty() ? "" : ", " + short_text(context.speeds[0]) + " rad/s") + ", " +
                     std::to_string(result.iterations) + " iterations, " +
                     short_text(double(std::clock() - processor_start) / CLOCKS_PER_SEC) + " s of the processor");
    State reported = state;
    if (context.least_norm && !reported.left_out.empty())
      RedundantRows(context.system).make_least(reported);
    meshes.check(context, state, "static, " + what);
    if (history)
      history->add(values_of(context, reported, state.factor));
    // of a sweep one at each speed
    if (!(context.sweep.empty() || progress == 1.))
      return;
    const double      at         = context.sweep.empty() ? progress : context.speeds[0];
    const std::string series     = context.sweep.empty() ? "static" : "static_speeds";
    const bool        is_on_page = context.page != nullptr && context.page->wants(series);
    std::optional<Drawing> whole;
    if (pictures)
      whole = context.system.draw(reported);
    const auto draw = [&](const Drawing::Content content) { return context.system.draw(reported, content); };
    if (is_on_page)
      context.page->add(series, at, whole ? ReportPage::of(*whole) : draw);
    if (pictures)
      pictures->add(std::move(*whole), at);
    if (context.page != nullptr)
      context.page->watch("static, " + what);
  }



  void
  StaticAnalysis::give_up(const Context &context, const NewtonResult &result, const double fraction) const
  {
    const std::string place = context.system.layout.name_of(result.worst);
    const std::string place_on_path =
      path == "arc length" ? "load factor " + short_text(fraction) : short_text(100 * fraction) + " % of the load";
    std::string text = "static analysis: no equilibrium found beyond " + place_on_path + ": " + result.reason + ".\n";
    if (result.failure == Failure::stability_limit)
      {
        // a step that passes two limits leaves the sign of the determinant as it was
        const NegativeDirections negative = negative_directions(context.system, context.state);
        text += negative.are_unstable() ?
                  "  At that load, too, " + negative.text(context.system) +
                    ". A step has passed an even number of limits: more <Load steps> find the first. " :
                  "  The equilibrium is stable up to there. ";
        text +=
          "Set Path = arc length in subsection Static to follow the path beyond, or Stability limits = pass to go on to "
          "whatever equilibrium is found there.";
      }
    else if (result.failure == Failure::rows_left_out)
      ; // all is said
    else if (result.failure == Failure::not_finite)
      text += "  Look at the functions of time, the tables and the values at: " + place;
    else if (result.failure == Failure::singular)
      {
        text +=
          "  No stiffness is found for: " + place +
          ".\n  Something can move freely there: clamp it, hold its joint by a spring or a prescribed motion, or remove "
          "a constraint that is there twice.";
        if (const auto states = integrating_states(context.system, context.state); !states.empty())
          text += "\n  No rate depends on these states of first order: " + join(states, ", ") +
                  ". Integrals have a value at rest only if forces depend on them.";
      }
    else
      {
        if (result.residual > 0)
          text +=
            "  The largest unbalanced force, " + short_text(result.residual) + " (N or N m), is at: " + place + ".\n";
        text +=
          "  Try more <Load steps>, a finer mesh there, or check units and stiffnesses of what is attached; near a "
          "limit point of the load no equilibrium exists beyond it (Path = arc length passes it).";
      }
    throw NotConverged(text);
  }



  void
  StaticAnalysis::finish(Context &)
  {
    if (history)
      history->finish();
    if (pictures)
      pictures->finish();
    for (const auto &other : {&speed_history, &path_history, &limits_history})
      if (*other)
        (*other)->finish();
  }
} // namespace samara
