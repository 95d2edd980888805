// Three ways to trim: Newton's method on periodicity and targets, and two auto-pilots.

#include <samara/analysis/trim_run.h>
#include <samara/base/dense.h>
#include <samara/base/errors.h>
#include <samara/base/text.h>

#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/vector.h>

#include <cmath>

namespace samara
{
  namespace
  {
    constexpr double difference_step = 1e-4; ///< of products with the Jacobian, in scales

    /** Of the linear equations, relative to their right side, never absolute. @{ */
    constexpr double loosest_forcing = 0.1, tightest_forcing = 1e-4, forcing_of_differences = 1e-2;
    /** @} */

    /** Of the steps' own equations in products with tangents, below what is asked of the sum. */
    constexpr double share_of_forcing = 1e-5;

    /** Of an image over its size: what is left of it across the images before, if it is to tell anything new. */
    constexpr double least_news = 0.05;

    /** After so many turns without a tangent one after another none is looked for any more: it costs a turn. */
    constexpr unsigned int most_turns_without_tangent = 3;

    const std::string beyond_limits = "the targets lie beyond the limits of the controls";

    constexpr double       shortest_step     = 1. / 64; ///< of Newton's method
    constexpr unsigned int most_newton_steps = 50;



    /** x by A x = b to @p forcing |b|, or as far as @p most products lead, which is no fault of an inexact method. */
    template <typename Matrix, typename Preconditioner>
    dealii::Vector<double>
    gmres(const Matrix                 &A,
          const dealii::Vector<double> &b,
          const double                  forcing,
          const unsigned int            most,
          const Preconditioner         &preconditioner)
    {
      using Settings = dealii::SolverGMRES<dealii::Vector<double>>::AdditionalData;
      dealii::Vector<double>                      x(b.size());
      dealii::SolverControl                       control(most, forcing * b.l2_norm(), false, false);
      dealii::SolverGMRES<dealii::Vector<double>> solver(control, Settings(most + 2, true));
      try
        {
          solver.solve(A, x, b, preconditioner);
        }
      catch (const dealii::SolverControl::NoConvergence &)
        {}
      return x;
    }



    /**
     * Nearly the inverse of a matrix of which J u = q was known at another place, q orthonormal: q becomes u, and what
     * is across all q becomes what is across all u, by the least rotation. (Left as it is, it could be among the u:
     * the whole would be singular.)
     */
    class NearlyInverse
    {
    public:
      NearlyInverse(const std::vector<Eigen::VectorXd> &u, const std::vector<Eigen::VectorXd> &q)
      {
        if (u.empty())
          return;
        const unsigned int n = u[0].size(), m = u.size();
        U.resize(n, m);
        Q.resize(n, m);
        for (unsigned int i = 0; i < m; ++i)
          {
            U.col(i) = u[i];
            Q.col(i) = q[i];
          }
        const Eigen::MatrixXd V = orthonormal_columns(U);
        // principal directions: pairs of which each turns in a plane of its own
        const SingularValues  svd = singular_values(V.transpose() * Q);
        const Eigen::MatrixXd v = V * svd.U, w = Q * svd.V;
        from.resize(n, m);
        to.resize(n, m);
        unsigned int n_planes = 0;
        for (unsigned int i = 0; i < m; ++i)
          {
            const double          cosine = svd.sizes(i);
            const Eigen::VectorXd across = v.col(i) - cosine * w.col(i);
            const double          sine   = across.norm();
            if (sine < 1e-8) // one direction in both spaces: nothing to turn
              continue;
            from.col(n_planes) = across / sine;
            to.col(n_planes++) = cosine * across / sine - sine * w.col(i);
          }
        from.conservativeResize(n, n_planes);
        to.conservativeResize(n, n_planes);
      }

      void
      vmult(dealii::Vector<double> &result, const dealii::Vector<double> &x) const
      {
        result = x;
        if (U.cols() == 0)
          return;
        Eigen::Map<Eigen::VectorXd> y(result.begin(), result.size());
        const Eigen::VectorXd       known = Q.transpose() * y;
        y -= Q * known;
        const Eigen::VectorXd turned = from.transpose() * y;
        y += (to - from) * turned + U * known;
      }

    private:
      Eigen::MatrixXd U, Q, from, to; ///< the rotation leads from one to the other
    };
  } // namespace



  TrimAnalysis::Run::Look
  TrimAnalysis::Run::by_method(const Look &now)
  {
    return trim.method == "Newton-Krylov" ? newton_krylov(now) :
           trim.method == "discrete"      ? discrete(now) :
                                            auto_pilot(now);
  }



  TrimAnalysis::Run::VectorX
  TrimAnalysis::Run::residual(const Look &look) const
  {
    VectorX r(look.gap.size());
    for (unsigned int i = 0; i < r.size(); ++i)
      r(i) = look.gap[i] / motion->scales[i];
    for (unsigned int k = 0; k < targets.size(); ++k)
      r(system.layout.of_state(controls[k].state)) = (look.averages(k) - targets[k].value) / targets[k].scale;
    return r;
  }



  State
  TrimAnalysis::Run::moved(const State &from, const VectorX &x, const double factor) const
  {
    std::vector<double> increment(x.size());
    for (unsigned int i = 0; i < x.size(); ++i)
      increment[i] = x(i) * motion->scales[i];
    return samara::moved(system, from, increment.data(), factor);
  }



  TrimAnalysis::Run::VectorX
  TrimAnalysis::Run::by_difference(const Look &now, const VectorX &r, const VectorX &direction)
  {
    const double step = difference_step / direction.norm();
    return (residual(look(moved(now.start, direction, step))) - r) / step;
  }



  TrimAnalysis::Run::VectorX
  TrimAnalysis::Run::by_tangent(const VectorX &direction)
  {
    VectorX             result(direction.size());
    std::vector<double> x(direction.size());
    for (unsigned int i = 0; i < x.size(); ++i)
      x[i] = direction(i) * motion->scales[i];
    const VectorX averages = averages_in_si(motion->apply(x.data()));
    for (unsigned int i = 0; i < x.size(); ++i)
      result(i) = x[i] / motion->scales[i] - direction(i);
    for (unsigned int k = 0; k < targets.size(); ++k)
      result(system.layout.of_state(controls[k].state)) = averages(k) / targets[k].scale;
    return result;
  }



  TrimAnalysis::Run::VectorX
  TrimAnalysis::Run::newton_step(const Look &now, const VectorX &r, const double forcing)
  {
    if (n_without_tangent < most_turns_without_tangent)
      try
        {
          motion->linearize(now.start, share_of_forcing * forcing);
          const VectorX x = solve([this](const VectorX &direction) { return by_tangent(direction); }, r, forcing);
          if (n_without_tangent > 0)
            context.log.line("trim: products by tangents again");
          n_without_tangent = 0;
          return x;
        }
      catch (const NotConverged &problem)
        {
          if (++n_without_tangent == 1)
            context.log.line(std::string("trim: products by differences of turns, as the tangent is not there: ") +
                             problem.what());
        }
    known           = {}; // of differences too many digits are lost where images are small
    const VectorX x = solve([&](const VectorX &direction) { return by_difference(now, r, direction); },
                            r,
                            std::min(forcing, forcing_of_differences));
    known           = {};
    return x;
  }



  TrimAnalysis::Run::VectorX
  TrimAnalysis::Run::solve(const std::function<VectorX(const VectorX &)> &product,
                           const VectorX                                 &r,
                           const double                                   forcing)
  {
    Known now; // directions and their images as they are, in the order of products
    struct Jacobian
    {
      const std::function<VectorX(const VectorX &)> &product;
      Known                                         &now;

      void
      vmult(dealii::Vector<double> &to, const dealii::Vector<double> &v) const
      {
        const Eigen::Map<const VectorX> direction(v.begin(), v.size());
        to = 0.;
        if (!(direction.norm() > 0))
          return; // GMRES starts at zero
        now.u.emplace_back(direction);
        now.q.push_back(product(direction));
        Eigen::Map<VectorX>(to.begin(), to.size()) = now.q.back();
      }
    };
    dealii::Vector<double> b(r.size());
    for (unsigned int i = 0; i < b.size(); ++i)
      b[i] = -r(i);
    const auto x = gmres(
      Jacobian{product, now}, b, forcing, trim.most_products * motion->n_sections(), NearlyInverse(known.u, known.q));
    remember(now);
    return Eigen::Map<const VectorX>(x.begin(), x.size());
  }



  void
  TrimAnalysis::Run::remember(const Known &products)
  {
    Known      all;
    const auto add = [&](VectorX u, VectorX q) {
      const double size = q.norm();
      for (int pass = 0; pass < 2; ++pass)
        for (unsigned int i = 0; i < all.q.size(); ++i)
          {
            const double part = all.q[i].dot(q);
            q -= part * all.q[i];
            u -= part * all.u[i];
          }
      if (const double left = q.norm(); left > least_news * size)
        {
          all.q.emplace_back(q / left);
          all.u.emplace_back(u / left);
        }
    };
    for (const Known *const from : {&products, static_cast<const Known *>(&known)})
      for (unsigned int i = 0; i < from->q.size() && all.q.size() < trim.most_products * motion->n_sections(); ++i)
        add(from->u[i], from->q[i]);
    known = all;
  }



  TrimAnalysis::Run::Look
  TrimAnalysis::Run::newton_krylov(Look now)
  {
    double before = 0;
    for (unsigned int iteration = 0; !is_trimmed(now); ++iteration)
      {
        const VectorX r = residual(now);
        if (iteration == most_newton_steps)
          fail("Newton's method has not found it in " + std::to_string(most_newton_steps) + " steps");
        const double forcing = std::clamp(r.norm(), tightest_forcing, loosest_forcing);
        VectorX      dx = newton_step(now, r, forcing), u = controls_of(now.start), du(u.size());
        for (unsigned int j = 0; j < controls.size(); ++j)
          du(j) = dx(system.layout.of_state(controls[j].state)) * controls[j].scale;
        double step = within_limits(u, du);
        if (step < shortest_step && !at_limits(u).empty())
          fail(beyond_limits);
        if (step < shortest_step)
          fail_with_reason(now, "Newton's method asks for controls far beyond their limits");
        for (;; step /= 2)
          {
            if (step < shortest_step)
              fail_with_reason(now, "Newton's method finds nothing better");
            Look next;
            try
              {
                next = look(moved(now.start, dx, step));
              }
            catch (const NotConverged &)
              {
                if (turns() >= trim.most_turns)
                  throw;
                continue; // no motion goes on from there
              }
            // a tenth of what the linear model promises
            if (residual(next).norm() < (1 - 0.1 * step) * r.norm() || is_trimmed(next))
              {
                before = r.norm();
                now    = next;
                break;
              }
            // round-off is all that is left
            if (r.norm() < 1e-4 && r.norm() > 0.5 * before && before > 0)
              fail_with_reason(now, "Newton's method has come to a standstill");
          }
        tell(now);
      }
    return now;
  }



  Eigen::MatrixXd
  TrimAnalysis::Run::control_matrix(const Look &now)
  {
    const unsigned int n = controls.size();
    Eigen::MatrixXd    J(n, n);
    const VectorX      u = controls_of(now.end);
    // what has not yet settled is the same in all of them
    const VectorX unchanged = settled(now.end).averages;
    for (unsigned int j = 0; j < n; ++j)
      {
        const bool   is_room = u(j) + controls[j].scale <= controls[j].upper;
        const double change  = is_room ? controls[j].scale : -controls[j].scale;
        State        from    = now.end;
        set_controls(from, u + change * VectorX::Unit(n, j));
        J.col(j) = (settled(from).averages - unchanged) / change;
      }
    return J;
  }



  TrimAnalysis::Run::VectorX
  TrimAnalysis::Run::solve(const Eigen::MatrixXd &J, const VectorX &y) const
  {
    // rows and columns in their scales, for the choice of pivots
    const unsigned int n      = controls.size();
    Eigen::MatrixXd    scaled = J;
    VectorX            b      = y;
    for (unsigned int k = 0; k < n; ++k)
      {
        b(k) /= targets[k].scale;
        for (unsigned int j = 0; j < n; ++j)
          scaled(k, j) *= controls[j].scale / targets[k].scale;
      }
    VectorX x = FullLu(scaled).solve(b);
    for (unsigned int j = 0; j < n; ++j)
      x(j) *= controls[j].scale;
    return x;
  }



  TrimAnalysis::Run::Look
  TrimAnalysis::Run::discrete(Look now)
  {
    now = settled(now.end);
    tell(now);
    if (is_trimmed(now))
      return now;
    Eigen::MatrixXd J = control_matrix(now);
    while (!is_trimmed(now))
      {
        if (const std::string fault = fault_of(J); !fault.empty())
          fail(fault);
        if (now.miss < 0.1 * tolerance) // another step of the controls would only disturb the motion
          {
            // targets are met, the motion is still settling
            now = settled(now.end);
            tell(now);
            continue;
          }
        const VectorX u = controls_of(now.start), wish = solve(J, wanted() - now.averages),
                      du = within_limits(u, wish) * wish;
        if (du.norm() < 1e-3 * wish.norm()) // limits leave a thousandth of the way
          fail("controls have come to their limits: targets lie beyond them, or motions take longer to settle than the "
               "<Settle> periods in which they are looked at");
        State from = now.end;
        set_controls(from, u + du);
        const Look next = settled(from);
        // Broyden: the least change of J for which it says what has happened, in scales
        VectorX share = du;
        for (unsigned int j = 0; j < controls.size(); ++j)
          share(j) /= controls[j].scale * controls[j].scale;
        // and only where it has said most of it, as what is still settling is no effect of controls; or where it has
        // led away, so that it was wrong
        const VectorX foreseen = J * du, surprise = next.averages - now.averages - foreseen;
        const auto    scaled = [&](VectorX y) {
          for (unsigned int k = 0; k < targets.size(); ++k)
            y(k) /= targets[k].scale;
          return y.norm();
        };
        if (scaled(surprise) < 0.5 * scaled(foreseen) ||
            scaled(next.averages - wanted()) > scaled(now.averages - wanted()))
          J += surprise * share.transpose() / share.dot(du);
        now = next;
        tell(now);
      }
    return now;
  }



  TrimAnalysis::Run::Look
  TrimAnalysis::Run::auto_pilot(Look now)
  {
    now = settled(now.end);
    tell(now);
    if (is_trimmed(now))
      return now;
    const Eigen::MatrixXd J = control_matrix(now);
    if (const std::string fault = fault_of(J); !fault.empty())
      fail(fault);
    const double        share = 1. / (trim.n_steps * trim.time_constant); // of a period, over the time constant
    std::deque<VectorX> window;                                           // the last period
    const auto          pilot = [&](State &state, unsigned int, const std::vector<double> &values) {
      VectorX y(targets.size());
      for (unsigned int k = 0; k < targets.size(); ++k)
        y(k) = targets[k].factor * motion->weighted(k, values, state.time) / trim.n_steps;
      window.push_back(y);
      if (window.size() < motion->steps_of_turn())
        return;
      if (window.size() > motion->steps_of_turn())
        window.pop_front();
      VectorX sum = VectorX::Zero(targets.size());
      for (const auto &part : window)
        sum += part;
      VectorX u = controls_of(state) + share * solve(J, wanted() - sum);
      for (unsigned int j = 0; j < controls.size(); ++j)
        u(j) = std::min(std::max(u(j), controls[j].lower), controls[j].upper);
      set_controls(state, u);
    };
    do
      {
        now = look(now.end, pilot);
        tell(now);
      }
    while (!is_trimmed(now));
    // what was found is confirmed with controls that keep still
    return look(now.end);
  }
} // namespace samara
