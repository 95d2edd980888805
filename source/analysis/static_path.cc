#include <samara/analysis/static.h>
#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/model/doubts.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    // a step takes about as many iterations; its ends are no further than 25 degrees from its chord
    constexpr double wanted_iterations = 5, smallest_cosine = 0.9;
  } // namespace



  void
  StaticAnalysis::add_path_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    prm.add(
      "Path",
      path,
      "What grows from step to step: the load, up to a limit point; or the arc length of the path of equilibria, with "
      "the load factor as an unknown, through limit points.",
      Selection("load|arc length"));
    prm.add(
      "Largest arc",
      largest_arc,
      "Longest step on a path by its arc length: root mean square, over the nodes, of displacements relative to the size "
      "of the model and rotations [1].",
      Double(0));
    prm.add("Weight of the load",
            load_weight,
            "Of the load factor in the arc length; 0: displacements alone [1].",
            Double(0));
    prm.add("End load factor", end_factor, "A path by its arc length ends where the load factor has this value [1].");
    prm.add("Passages", passages, "How often it has this value until the path ends.", Integer(1));
    prm.add("Largest load factor",
            largest_factor,
            "A path ends, too, where the load factor is beyond, up or down [1].",
            Double(0));
    prm.add("Most steps", most_steps, "A path ends, too, after so many steps.", Integer(1));
  }



  PathPoint
  StaticAnalysis::start_of_path(Context &context, ArcLength &method)
  {
    for (const double speed : context.speeds)
      if (speed != 0.)
        throw InputError(
          "Path = arc length in subsection Static follows loads at rest; parts that rotate need Path = load");
    PathPoint point;
    point.state        = context.state;
    point.state.time   = time;
    point.state.held   = true;
    point.state.factor = context.is_equilibrium ? context.state.factor : 0.;
    Newton             newton(context.system, *solver, tolerance, max_iterations);
    const NewtonResult result = newton.solve(point.state);
    n_iterations += result.iterations;
    if (!result.converged)
      give_up(context, result, 0);
    try
      {
        method.start(point);
      }
    catch (const SingularMatrix &singular)
      {
        NewtonResult free;
        free.fail(Failure::singular, "the tangent matrix is singular");
        free.worst = std::max(0, singular.unknown);
        give_up(context, free, 0);
      }
    return point;
  }



  bool
  StaticAnalysis::is_too_long(const Context &context, const double factor) const
  {
    if (n_steps < most_steps && std::abs(factor) <= largest_factor)
      return false;
    context.log.warning("static",
                        "the path has not come to load factor " + short_text(end_factor) + " but ends at " +
                          short_text(factor) + " after " + std::to_string(n_steps) +
                          " steps; what follows starts from there");
    return true;
  }



  NewtonResult
  StaticAnalysis::step_along(ArcLength     &method,
                             RedundantRows &redundant,
                             PathPoint     &here,
                             const double   step,
                             PathPoint     &next) const
  {
    redundant.choose(here.state);
    NewtonResult result = method.step(here, step, next);
    if (result.converged && !next.state.left_out.empty())
      if (const auto objection = redundant.objection(next.state, redundant.gaps(next.state)); !objection.empty())
        result.fail(Failure::rows_left_out, objection);
    if (result.converged && next.cosine < smallest_cosine)
      result.fail(Failure::other, "the path turns too much, or this is another one");
    // a limit point alone changes both signs; a bifurcation together with it hides in the determinant
    if (result.converged && next.slope * here.slope < 0 && next.sign == here.sign &&
        step > 100 * smallest_step * largest_arc)
      result.fail(Failure::other, "a limit point and a bifurcation are close together");
    return result;
  }



  void
  StaticAnalysis::follow_path(Context &context)
  {
    ArcLength     method(context.system, *solver, load_weight, tolerance, max_iterations);
    PathPoint     here = start_of_path(context, method), next;
    double        step = std::min(largest_arc, 1. / (initial_steps * std::abs(here.slope))), arc = 0;
    unsigned int  n_passed = 0;
    RedundantRows redundant(context.system);
    context.state = here.state;
    // away from zero factor: towards the end that is asked for
    if ((end_factor - here.state.factor) * here.slope < 0)
      {
        here.slope = -here.slope;
        for (auto &t : here.tangent)
          t = -t;
      }

    bool is_end = false;
    while (!is_end && !is_too_long(context, here.state.factor))
      {
        NewtonResult result = step_along(method, redundant, here, step, next);
        if (!result.converged)
          {
            step /= 2;
            context.log.line("  arc of " + short_text(2 * step) + ": " + result.reason + "; trying " +
                             short_text(step));
            if (step < smallest_step * largest_arc)
              give_up(context, result, here.state.factor);
            continue;
          }

        double taken = step;
        if ((next.state.factor - end_factor) * (here.state.factor - end_factor) <= 0 &&
            here.state.factor != end_factor && ++n_passed == passages)
          {
            taken  = find_end(context, method, here, next, step);
            is_end = true;
          }
        find_singular_points(context, method, here, next, taken);
        ++n_steps;
        arc += taken;
        context.state     = next.state;
        result.iterations = next.iterations;
        record(context, next.state, arc, result);
        if (path_history)
          path_history->add({arc, next.state.factor, taken, double(next.iterations), double(next.sign)});
        std::swap(here, next);
        step = std::min(largest_arc, step * std::clamp(std::sqrt(wanted_iterations / result.iterations), 0.5, 2.));
      }
    n_iterations += method.n_iterations;
  }



  double
  StaticAnalysis::find_end(Context &context, ArcLength &method, const PathPoint &from, PathPoint &to, const double s)
  {
    const auto   missing = [&](const PathPoint &p) { return p.state.factor - end_factor; };
    const double before = missing(from), after = missing(to);
    if (after == 0.)
      return s;
    // near enough for Newton's method at the given factor to find the same point of the path
    const double taken = method.locate(from, s, before, after, 1e-9, missing, to);
    Newton       newton(context.system, *solver, tolerance, max_iterations);
    to.state.factor           = end_factor;
    const NewtonResult result = taken < 0 ? NewtonResult() : newton.solve(to.state);
    n_iterations += result.iterations;
    if (!result.converged)
      give_up(context, result, from.state.factor);
    return taken;
  }



  void
  StaticAnalysis::find_singular_points(Context         &context,
                                       ArcLength       &method,
                                       const PathPoint &from,
                                       const PathPoint &to,
                                       const double     s)
  {
    const bool is_limit = from.slope * to.slope < 0;
    if (!is_limit && from.sign == to.sign)
      return;
    // the limit load is of second order in the slope, and so exact to round-off; a bifurcation is known to 1e-5 of the
    // step
    PathPoint    point;
    const double at = is_limit ?
                        method.locate(
                          from, s, from.slope, to.slope, 1e-7, [](const PathPoint &p) { return p.slope; }, point) :
                        method.locate_change_of_sign(from, s, 1e-5, point);
    if (at < 0)
      point = to; // passed, but not found more closely
    singular_points.push_back({is_limit, point.state});
    context.log.line(std::string("  static: ") + (is_limit ? "limit point" : "bifurcation") + " at load factor " +
                     number_to_text(point.state.factor) + (at < 0 ? ", about" : ""));
    if (limits_history)
      {
        std::vector<double> row = {is_limit ? 1. : 2., point.state.factor};
        for (const auto &probe : context.probes)
          row.push_back(probe.value(point.state));
        limits_history->add(row);
      }
    for (const auto &item : context.system.model.items)
      if (const auto *const doubtful = dynamic_cast<const Doubtful *>(item.get()))
        if (const std::string why = doubtful->why_no_limit(point.state); !why.empty())
          throw NotConverged("the path ends at load factor " + number_to_text("%.6g", point.state.factor) +
                             ": what is found there is likely to be none of the structure but of its mesh. " + why +
                             ". Give it more <Elements>");
  }
} // namespace samara
