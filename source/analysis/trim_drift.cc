// Motions that drift to their orbit: each turn comes back nearly as it was, and the orbit is far away all the same.

#include <samara/analysis/trim_run.h>
#include <samara/base/text.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace samara
{
  namespace
  {
    /** What an orbit may be away by, in tolerances, and what its distance shall be reduced to. @{ */
    constexpr double allowed_distance = 10, wanted_distance = 3;
    /** @} */

    /** In tolerances: a gap of which this much is left after a turn would have to last for a thousand turns to matter.
     */
    constexpr double negligible_gap = 0.01;

    constexpr unsigned int most_turns_of_drift = 3; ///< that are looked at

    /** Of the equations of a step of Newton's method that is looked at, so that what drifts is not lost in them. */
    constexpr double forcing_of_drift = 1e-4;

    /** Of a gap, what another step of Newton's method shall leave of it. */
    constexpr double left_by_another_step = 0.1;

    constexpr unsigned int most_rounds        = 5;
    constexpr double       smallest_tolerance = 1e-13;
  } // namespace



  double
  TrimAnalysis::Run::distance_of_orbit(State now)
  {
    PeriodicMotion &of_turn  = parts ? *whole : *motion;
    auto            gap      = gap_behind;
    double          distance = 0;
    for (unsigned int turn = 0; turn < most_turns_of_drift; ++turn)
      {
        const double largest = of_turn.largest(gap).size;
        if (largest < negligible_gap * trim.tolerance)
          return distance;
        // x away from its orbit a turn leaves the gap g = (1 − Φ) x, and the next one Φ g: where Φ g is nearly g, x is
        // |g| |g|/|g − Φ g|; what dies away fast hides it in the first turns
        const State start = now;
        of_turn.turn(now);
        const auto next = of_turn.gap(start, now);
        of_turn.begin_again(start, now);
        double size = 0, change = 0, left = 0;
        for (unsigned int i = 0; i < gap.size(); ++i)
          {
            const double g = gap[i] / of_turn.scales[i], behind = next[i] / of_turn.scales[i];
            size += g * g;
            change += (g - behind) * (g - behind);
            left += behind * behind;
          }
        distance = std::max(distance, largest * std::sqrt(size / std::max(change, std::numeric_limits<double>::min())));
        // a gap that shrinks, as of a slow memory, changes by less than itself
        if (change > size && left > 0.25 * size)
          return distance; // round-off, or what swings for long: it hides nothing that another turn would show
        gap = next;
      }
    return distance;
  }



  double
  TrimAnalysis::Run::size_of_newton_step(const Look &found)
  {
    return newton_step(found, residual(found), forcing_of_drift).cwiseAbs().maxCoeff();
  }



  TrimAnalysis::Run::Look
  TrimAnalysis::Run::without_drift(const Look &now)
  {
    Look found = by_method(now);
    for (unsigned int round = 0;; ++round)
      {
        std::string why;
        const auto  there = confirm(found, why);
        if (!there && round == 0 && trim.method == "Newton-Krylov" && found.size() > smallest_tolerance)
          {
            // what dies away slowly shows only now: nearer to the orbit by another step
            tolerance = std::max(smallest_tolerance, left_by_another_step * found.size());
            context.log.line("trim: it closes to " + number_to_text("%.1e", found.largest_gap) +
                             ", and the whole period behind does not yet; on to " + number_to_text("%.1e", tolerance));
            found = by_method(found);
            continue;
          }
        if (!there)
          fail(why);
        const State &end      = *there;
        double       distance = distance_of_orbit(end);
        if (distance > allowed_distance * trim.tolerance && trim.method == "Newton-Krylov")
          distance = size_of_newton_step(found);
        if (!(distance > allowed_distance * trim.tolerance))
          {
            if (parts)
              found.end = end; // a motion of its own numbers, with the multipliers that belong to it
            return found;
          }
        tolerance = std::min(0.3 * found.size(), tolerance * wanted_distance * trim.tolerance / distance);
        if (round == most_rounds || tolerance < smallest_tolerance)
          fail("the motion comes back, but drifts: its orbit is about " + number_to_text("%.1e", distance) +
               " of the scales away, more than the <Tolerance>, and turns do not lead there");
        context.log.line("trim: the motion drifts: it closes to " + number_to_text("%.1e", found.largest_gap) +
                         ", but its orbit is about " + number_to_text("%.1e", distance) +
                         " of the scales away; on to " + number_to_text("%.1e", tolerance));
        found = by_method(found);
      }
  }
} // namespace samara
