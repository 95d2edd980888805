// Rows left out that do not hold: by rounded places and axes, or because they do not repeat what others say.

#include <samara/base/text.h>
#include <samara/solvers/redundant_rows.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Gaps that Newton's method leaves, in parts of the model's size, and how much more than of the rows kept. */
    constexpr double round_off = 1e-9, amplification = 10;

    /**
     * What rounded places and axes may change along the motion, in multiples of what they are in the reference
     * position: the distance from the span, and the gap. Bricard's mechanism with axes rounded in many ways has gaps of
     * 4 to 9 times.
     */
    constexpr double change_of_distance = 10, gap_by_distance = 50;

    /** No rounding that passes for redundant makes more, in parts of the model's size. */
    constexpr double most = 2e-4;
  } // namespace



  void
  RedundantRows::measure_rounding(const State &state)
  {
    rounding           = {};
    rounding.is_known  = true;
    const auto measure = [&](State at, const bool closes) {
      try
        {
          if (closes)
            close(at, at.left_out);
          assemble(at);
          factorize(at.left_out);
          find_combinations(at.left_out);
        }
      catch (const SingularMatrix &)
        {
          return false;
        }
      rounding.gap          = gaps(at).left_out;
      rounding.independence = rounding.gap / length;
      for (int j = 0; j < X.cols(); ++j)
        rounding.independence =
          std::max(rounding.independence, independence[j] / std::max(1., X.col(j).lpNorm<Eigen::Infinity>()));
      return std::isfinite(rounding.independence) && X.cwiseAbs().maxCoeff() < singular;
    };
    State given    = system.reference();
    given.left_out = state.left_out;
    given.held     = state.held;
    if (!measure(given, true) && !measure(state, false))
      rounding.independence = rounding.gap = 0;
  }



  RedundantRows::Gaps
  RedundantRows::gaps(const State &state, const std::vector<double> &g) const
  {
    std::vector<bool> is_left_out(m, false), is_released(m, false);
    for (const auto i : state.left_out)
      is_left_out[i] = true;
    if (!state.held)
      for (const auto i : system.released_multipliers())
        is_released[i] = true;
    Gaps result;
    for (int i = 0; i < m; ++i)
      if (const double gap = std::abs(scaled(i, g[n + i])); is_left_out[i])
        {
          if (gap > result.left_out)
            {
              result.left_out = gap;
              result.worst    = i;
            }
        }
      else if (!is_released[i])
        result.kept = std::max(result.kept, gap);
    return result;
  }



  RedundantRows::Gaps
  RedundantRows::gaps(const State &state) const
  {
    std::vector<double> g(n + m + 6, 0.);
    system.add_gaps(state.point(), g.data());
    return gaps(state, g);
  }



  double
  RedundantRows::round_off_of(const Gaps &gaps) const
  {
    return round_off * length + amplification * gaps.kept;
  }



  double
  RedundantRows::allowed(const Gaps &gaps) const
  {
    return std::min(most * length, round_off_of(gaps) + gap_by_distance * rounding.independence * length);
  }



  bool
  RedundantRows::are_explained(const Gaps &gaps) const
  {
    // what rounded places made when it was looked at last need not be looked at again
    return gaps.left_out <= std::min(allowed(gaps), std::max(round_off_of(gaps), 2 * rounding.gap));
  }



  std::string
  RedundantRows::objection(const State &state, const Gaps &gaps)
  {
    if (are_explained(gaps))
      return "";
    const Eigen::MatrixXd of_rows = combinations(state);
    const int    j       = std::find(state.left_out.begin(), state.left_out.end(), gaps.worst) - state.left_out.begin();
    const double largest = X.col(j).lpNorm<Eigen::Infinity>(), distance = independence[j] / std::max(1., largest);
    const bool   repeats = distance <= std::max(exact, change_of_distance * rounding.independence);
    if (gaps.left_out <= allowed(gaps) && (repeats || !(largest < singular)))
      {
        rounding.gap = gaps.left_out;
        return "";
      }
    const std::string joints = names(of_rows, j);
    if (repeats)
      return "these constraints contradict each other: " + joints +
             ".\n  Not all of them can hold. Give a joint of the loop more freedom, or look at what is prescribed";
    return "these constraints repeat each other in some positions only: " + joints +
           ".\n  What was left out there is violated by " + number_to_text("%.1e", gaps.left_out) +
           " m now. In such positions rigid parts do not tell what moves and what does not: leave out the constraints that "
           "are too many, or make parts elastic; if all should agree everywhere, give all digits of places and axes";
  }
} // namespace samara
