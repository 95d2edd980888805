#include <samara/base/dense.h>
#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/time/algebraic_states.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Steps of Newton's method, and halves of one. */
    constexpr unsigned int most_steps_of_algebraic = 100, most_halves = 40;

    /** In parts of a state: the step of differences, which is the part of an error that a step of Newton's method
     * leaves, and a change behind which one more step would be round-off. */
    constexpr double step_of_slopes = 1e-7, last_change = 1e-8;



    /** g of algebraic states in motion. */
    Eigen::VectorXd
    gaps_of(const System &system, const std::vector<unsigned int> &algebraic, const State &state)
    {
      std::vector<double> of_states(system.layout.n_states);
      Point<double>       point = state.point();
      point.held                = false;
      system.state_rates(point, of_states.data());
      Eigen::VectorXd g(algebraic.size());
      for (unsigned int i = 0; i < algebraic.size(); ++i)
        g(i) = of_states[algebraic[i]];
      return g;
    }



    /** ∂g/∂z by differences; @p g at the state. */
    Eigen::MatrixXd
    slopes_of(const System                    &system,
              const std::vector<unsigned int> &algebraic,
              State                            state,
              const Eigen::VectorXd           &sizes,
              const Eigen::VectorXd           &g)
    {
      Eigen::MatrixXd slopes(g.size(), g.size());
      for (unsigned int j = 0; j < algebraic.size(); ++j)
        {
          const double z = state.states[algebraic[j]], dz = step_of_slopes * sizes(j);
          state.states[algebraic[j]] = z + dz;
          slopes.col(j)              = (gaps_of(system, algebraic, state) - g) / dz;
          state.states[algebraic[j]] = z;
        }
      return slopes;
    }
  } // namespace



  Eigen::VectorXd
  values_at_end(const Tableau &tableau)
  {
    const auto     &c      = tableau.c;
    Eigen::VectorXd result = Eigen::VectorXd::Ones(c.size());
    for (int k = 0; k < c.size(); ++k)
      for (int m = 0; m < c.size(); ++m)
        if (m != k)
          result(k) *= (1 - c(m)) / (c(k) - c(m));
    return result;
  }



  void
  find_algebraic_states(const System &system, State &state)
  {
    const auto algebraic = algebraic_states(system.model);
    if (algebraic.empty())
      return;
    const unsigned int n = algebraic.size();
    Eigen::VectorXd    sizes(n), from(n);
    double             change = 1;
    for (unsigned int step = 0; change > last_change; ++step)
      {
        const Eigen::VectorXd g = gaps_of(system, algebraic, state);
        for (unsigned int i = 0; i < n; ++i)
          {
            from(i)  = state.states[algebraic[i]];
            sizes(i) = std::max(std::abs(from(i)), system.model.states[algebraic[i]].scale);
          }
        const Eigen::VectorXd dz = FullLu(slopes_of(system, algebraic, state, sizes, g)).solve(-g);
        change                   = dz.cwiseQuotient(sizes).lpNorm<Eigen::Infinity>();
        if (step == most_steps_of_algebraic || !std::isfinite(change))
          throw NotConverged("t = " + number_to_text("%.6g", state.time) + " s: no value of <" +
                             system.model.states[algebraic.front()].name +
                             "> belongs to the motion at once, or one that is far from the last; let it follow with a "
                             "delay");
        double part = 1;
        for (unsigned int halves = 0;; ++halves, part *= 0.5)
          {
            for (unsigned int i = 0; i < n; ++i)
              state.states[algebraic[i]] = from(i) + part * dz(i);
            if (change <= last_change || halves == most_halves || gaps_of(system, algebraic, state).norm() < g.norm())
              break;
          }
      }
  }
} // namespace samara
