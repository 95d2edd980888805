#include <samara/time/stage_history.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Part of the error of a lower order, or of the other guess, that one more has to come down to: what is noise is
     * nearer by accident now and then, and would be amplified. */
    constexpr double worth_an_order = 0.5;

    /** Where half of all errors of extrapolation are smaller than this part of those of the other guess it is worth its
     * while; elsewhere nothing is remembered for so many steps. */
    constexpr double       worth_remembering = 0.4;
    constexpr unsigned int pause             = 20;

    /** Of models with more numbers a stage, which memory counts for, fewer steps are kept, and orders end with the
     * second. */
    constexpr std::size_t  worth_sparing = 20000;
    constexpr unsigned int few_steps     = 3;

    unsigned int
    steps_kept(const std::size_t n_values)
    {
      return n_values > worth_sparing ? few_steps : StageHistory::most_steps;
    }

    /** Values of the steps before, the last one first; nowhere overlapping. */
    using Past = const double *__restrict__;

    /** What a polynomial of the given order through them goes on with. @{ */
    double
    line(const double a, const double b)
    {
      return 2 * a - b;
    }
    double
    parabola(const double a, const double b, const double c)
    {
      return 3 * (a - b) + c;
    }
    double
    cubic(const double a, const double b, const double c, const double d)
    {
      return 4 * (a + c) - 6 * b - d;
    }
    double
    quartic(const double a, const double b, const double c, const double d, const double e)
    {
      return 5 * (a - d) - 10 * (b - c) + e;
    }
    /** @} */



    /**
     * For each of n numbers the order that came nearest to @p values, of those that so many steps allow, 0 if none is
     * much nearer than @p otherwise. Without a branch, so that it takes vector registers. Returns whether it is
     * worth its while.
     */
    bool
    choose(const std::size_t                                           n,
           const Past                                                  values,
           const Past                                                  otherwise,
           const std::array<const double *, StageHistory::most_steps> &past,
           const unsigned int                                          n_steps,
           double *const __restrict__ orders)
    {
      const Past   a = past[0], b = past[1], c = past[2], d = past[3], e = past[4];
      const double far[]   = {0, n_steps > 2 ? 0. : HUGE_VAL, n_steps > 3 ? 0. : HUGE_VAL, n_steps > 4 ? 0. : HUGE_VAL};
      std::size_t  n_small = 0, n_changing = 0; // what does not change has no error at all
      for (std::size_t i = 0; i < n; ++i)
        {
          const double at_first = std::abs(values[i] - otherwise[i]);
          double       least = worth_an_order * at_first, best = 0, error_of_best = at_first;
          const auto   judge = [&](const double order, const double error) {
            const double next      = worth_an_order * error;
            const bool   is_nearer = error < least;
            best                   = is_nearer ? order : best;
            error_of_best          = is_nearer ? error : error_of_best;
            least                  = is_nearer ? next : least;
          };
          judge(1, std::abs(values[i] - line(a[i], b[i])));
          judge(2, far[1] + std::abs(values[i] - parabola(a[i], b[i], c[i])));
          judge(3, far[2] + std::abs(values[i] - cubic(a[i], b[i], c[i], d[i])));
          judge(4, far[3] + std::abs(values[i] - quartic(a[i], b[i], c[i], d[i], e[i])));
          orders[i] = best;
          n_small += error_of_best < worth_remembering * at_first;
          n_changing += at_first > 0;
        }
      return 2 * n_small > n_changing;
    }
    /** Of steps that are not kept there is the last one: nothing that is made of it is used. */
    std::array<const double *, StageHistory::most_steps>
    past_of(const std::array<std::vector<double>, StageHistory::most_steps> &values)
    {
      std::array<const double *, StageHistory::most_steps> past;
      for (unsigned int j = 0; j < past.size(); ++j)
        past[j] = values[values[j].empty() ? 0 : j].data();
      return past;
    }
  } // namespace



  void
  StageHistory::extrapolate(const unsigned int k, std::vector<double> &values) const
  {
    if (n_steps < 2 || pauses())
      return;
    const Stage &stage = stages[k];
    const auto   past  = past_of(stage.values);
    const Past   a = past[0], b = past[1], c = past[2], d = past[3], e = past[4];
    const double *const __restrict__ orders = stage.order.data();
    double *const __restrict__ to           = values.data();
    for (std::size_t i = 0; i < values.size(); ++i)
      {
        const double order = orders[i], first = line(a[i], b[i]), second = parabola(a[i], b[i], c[i]),
                     third = cubic(a[i], b[i], c[i], d[i]), fourth = quartic(a[i], b[i], c[i], d[i], e[i]);
        double value = to[i];
        value        = order > 0.5 ? first : value;
        value        = order > 1.5 ? second : value;
        value        = order > 2.5 ? third : value;
        to[i]        = order > 3.5 ? fourth : value;
      }
  }



  void
  StageHistory::remember(const unsigned int k, const std::vector<double> &values, const std::vector<double> &otherwise)
  {
    const bool is_last = k + 1 == stages.size();
    if (pauses())
      {
        if (is_last && --n_steps == most_steps)
          n_steps = 0;
        return;
      }
    Stage             &stage  = stages[k];
    const unsigned int n_kept = steps_kept(values.size());
    stage.order.assign(values.size(), 0.);
    bool is_worth_it = true;
    if (n_steps > 1)
      is_worth_it =
        choose(values.size(), values.data(), otherwise.data(), past_of(stage.values), n_steps, stage.order.data());
    else
      for (unsigned int j = 0; j < n_kept; ++j)
        stage.values[j].resize(values.size(), 0.);
    std::rotate(stage.values.begin(), stage.values.begin() + n_kept - 1, stage.values.begin() + n_kept);
    stage.values[0] = values;
    if (!is_last)
      return;
    if (n_steps < n_kept || is_worth_it)
      {
        n_steps = std::min(n_steps + 1, n_kept);
        return;
      }
    n_steps = most_steps + pause;
    if (n_kept < most_steps)
      for (Stage &of_pause : stages)
        of_pause = Stage();
  }
} // namespace samara
