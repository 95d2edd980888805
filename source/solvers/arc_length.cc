#include <samara/base/astray.h>
#include <samara/solvers/arc_length.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  ArcLength::ArcLength(const System      &system,
                       LinearSolver      &solver,
                       const double       load_weight,
                       const double       tolerance,
                       const unsigned int max_iterations)
    : system(system)
    , solver(solver)
    , weight(load_weight)
    , tolerance(tolerance)
    , max_iterations(max_iterations)
    , length(model_length(system.model))
    , K(system.layout.pattern)
  {}



  double
  ArcLength::distance_squared(const State &state, const State &base) const
  {
    double sum = 0;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      sum += (state.position(node) - base.position(node)).squaredNorm() / (length * length) +
             0.5 * (state.triad(node) - base.triad(node)).squaredNorm();
    return sum / (system.layout.n_nodes - 1) + std::pow(weight * (state.factor - base.factor), 2);
  }



  void
  ArcLength::find_gradient(const State &state, const State &base, std::vector<double> &g) const
  {
    g.assign(system.size(), 0.);
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        Eigen::Map<Vector6> g_node(&g[system.layout.of_node(node)]);
        const Matrix3       D = state.triad(node);
        // ½ |D − D₀|² = 3 − tr(D₀ᵀ D), and tr(A θ~) = −2 axial(A)·θ
        g_node.head<3>() = D.transpose() * (state.position(node) - base.position(node)) / (length * length);
        g_node.tail<3>() = axial(base.triad(node).transpose() * D);
        g_node /= system.layout.n_nodes - 1;
      }
  }



  double
  ArcLength::norm(const std::vector<double> &z) const
  {
    double sum = 0;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const Eigen::Map<const Vector6> twist(&z[system.layout.of_node(node)]);
        sum += twist.head<3>().squaredNorm() / (length * length) + twist.tail<3>().squaredNorm();
      }
    return std::sqrt(sum / (system.layout.n_nodes - 1));
  }



  void
  ArcLength::find_load(const State &state)
  {
    // without stresses and multipliers, which would only add round-off
    State at = state;
    at.multipliers.assign(at.multipliers.size(), 0.);
    stress.assign(at.stress.size(), 0.);
    at.factor = 0;
    system.residual(at, stress, load);
    at.factor = 1;
    system.residual(at, stress, residual);
    load.resize(system.size());
    for (unsigned int i = 0; i < system.size(); ++i)
      load[i] -= residual[i];
  }



  void
  ArcLength::factorize(const State &state)
  {
    system.tangent(state, K);
    solver.factorize(K);
  }



  void
  ArcLength::find_tangent(PathPoint &point, const PathPoint *behind)
  {
    find_load(point.state);
    point.tangent = load;
    solver.solve(point.tangent.data());
    const double size = std::hypot(norm(point.tangent), weight);
    if (!(size > 0) || !std::isfinite(size))
      throw SingularMatrix(-1);

    double along = 1;
    if (behind != nullptr)
      {
        // the step that led here, seen from both ends: the path goes on in its sense
        const double df       = weight * weight * (point.state.factor - behind->state.factor);
        const double s        = std::sqrt(distance_squared(point.state, behind->state));
        double       at_start = df * behind->slope;
        along                 = df;
        find_gradient(behind->state, point.state, gradient);
        for (unsigned int i = 0; i < system.size(); ++i)
          at_start -= gradient[i] * behind->tangent[i];
        find_gradient(point.state, behind->state, gradient);
        for (unsigned int i = 0; i < system.size(); ++i)
          along += gradient[i] * point.tangent[i];
        point.cosine = std::min(at_start, std::abs(along) / size) / s;
      }
    point.slope = (along < 0 ? -1 : 1) / size;
    for (auto &t : point.tangent)
      t *= point.slope;
    point.sign      = solver.determinant_sign();
    point.condition = solver.reciprocal_condition();
  }



  void
  ArcLength::start(PathPoint &point)
  {
    factorize(point.state);
    find_tangent(point, nullptr);
  }



  double
  ArcLength::solve_for_increment(const PathPoint &from, const double s, const State &state)
  {
    find_load(state);
    find_gradient(state, from.state, gradient);
    factorize(state);
    system.stresses(state, stress);
    system.residual(state, stress, residual);
    for (unsigned int i = 0; i < system.size(); ++i)
      increment[i] = -residual[i];
    solver.solve(increment.data());
    solver.solve(load.data());

    // half of the constraint, linearised: the load factor follows from it
    const double df0  = state.factor - from.state.factor;
    double       rest = 0.5 * (distance_squared(state, from.state) - s * s), rate = weight * weight * df0;
    for (unsigned int i = 0; i < system.size(); ++i)
      {
        rest += gradient[i] * increment[i];
        rate += gradient[i] * load[i];
      }
    const double df = -rest / rate;
    for (unsigned int i = 0; i < system.size(); ++i)
      increment[i] += df * load[i];
    return df;
  }



  void
  ArcLength::iterate(const PathPoint &from, const double s, PathPoint &to, NewtonResult &result)
  {
    double smallest = 1e300;
    while (result.iterations < max_iterations)
      {
        const double df = solve_for_increment(from, s, to.state);
        ++result.iterations;
        ++n_iterations;
        result.last_step = size_of_step(system, increment, length, &to.state.states);
        // ten radians or sizes of the model, or a thousand times the smallest after some: it leads nowhere
        if (!std::isfinite(result.last_step) || result.last_step > 10. ||
            (result.iterations > 8 && result.last_step > 1e3 * smallest))
          {
            result.fail(Failure::no_convergence, "the iterations diverge");
            return;
          }
        smallest = std::min(smallest, result.last_step);
        to.state.factor += df;
        system.update(to.state, increment);
        if (result.last_step < tolerance)
          {
            system.stresses(to.state, to.state.stress);
            factorize(to.state);
            find_tangent(to, &from);
            to.iterations    = result.iterations;
            result.converged = true;
            refuse_negative_length(system, to.state, result);
            return;
          }
      }
    result.fail(Failure::no_convergence, "no convergence in " + std::to_string(max_iterations) + " iterations");
  }



  NewtonResult
  ArcLength::step(const PathPoint &from, const double s, PathPoint &to)
  {
    Assert(s > 0, dealii::ExcMessage("A step along a path goes forward."));
    AssertDimension(from.tangent.size(), system.size());
    NewtonResult result;
    to.state = from.state;
    increment.resize(system.size());
    for (unsigned int i = 0; i < system.size(); ++i)
      increment[i] = s * from.tangent[i];
    to.state.factor += s * from.slope;
    system.update(to.state, increment);
    try
      {
        iterate(from, s, to, result);
      }
    catch (const SingularMatrix &singular)
      {
        result.fail(Failure::singular, "the tangent matrix is singular");
        result.worst = std::max(0, singular.unknown);
      }
    catch (const Astray &why)
      {
        result.fail(Failure::no_convergence, why.what());
      }
    return result;
  }



  double
  ArcLength::locate(const PathPoint                                &from,
                    const double                                    s,
                    const double                                    at_start,
                    const double                                    at_end,
                    const double                                    precision,
                    const std::function<double(const PathPoint &)> &function,
                    PathPoint                                      &found)
  {
    double       a = 0, b = s, f_a = at_start, f_b = at_end;
    const double small = precision * std::max(std::abs(at_start), std::abs(at_end));
    for (unsigned int i = 0; i < 50; ++i)
      {
        const double c = (a * f_b - b * f_a) / (f_b - f_a);
        if (!step(from, c, found).converged)
          return -1;
        const double f_c = function(found);
        if (std::abs(f_c) <= small || std::abs(b - a) < 1e-12 * std::abs(s))
          return c;
        // the end that stays twice counts half (Illinois rule): both ends come near, and faster than by halves
        if (f_c * f_b < 0)
          {
            a   = b;
            f_a = f_b;
          }
        else
          f_a /= 2;
        b   = c;
        f_b = f_c;
      }
    return -1;
  }



  double
  ArcLength::locate_change_of_sign(const PathPoint &from, const double s, const double precision, PathPoint &found)
  {
    double a = 0, b = s;
    while (b - a > precision * s)
      {
        const double c = 0.5 * (a + b);
        if (!step(from, c, found).converged)
          return -1;
        (found.sign == from.sign ? a : b) = c;
      }
    return 0.5 * (a + b);
  }
} // namespace samara
