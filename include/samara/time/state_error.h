#ifndef samara_time_state_error_h
#define samara_time_state_error_h

#include <samara/model/counted_states.h>
#include <samara/model/system.h>
#include <samara/time/step_control.h>

#include <vector>

namespace samara
{
  /**
   * The local error of a step in the states of first order that count, relative (doc/theory/step_control.md). Of each
   * group of CountedStates
   *
   *     e = √(α² + φ² (h/τ)²) |δz|_P/max |z|_P         δz = ∂z/∂α, what the neighbour in α would have done
   *
   * as of an oscillator with 1/τ in the place of its frequency: what a step does to ż = λz is a function of hλ alone,
   * whatever the argument of λ is. τ is the time scale on which δz changes from step to step, a mean over about as
   * long; so is δz where that of the step itself is less.
   */
  class StateError
  {
  public:
    StateError(const System &system, const Tableau &tableau);

    /** The largest error of all groups; nothing is remembered of it before accept(). @p difference: δz of all states.
     */
    double of_step(const State &end, const std::vector<double> &difference, double h);
    void   accept();

    /** All that later steps depend on, for restarts. @{ */
    std::vector<double> memory() const;
    void                set_memory(std::vector<double>::const_iterator from);
    /** @} */

  private:
    struct Scale
    {
      std::vector<double> last; ///< δz/h^{2s} of the last step
      double              step = 0, weight = 0, squares = 0, change_squares = 0;
      double              tau = 0, largest = 0;
    };

    const double                     alpha;
    const unsigned int               order; ///< 2s
    const double                     phase;
    const std::vector<CountedStates> groups;
    std::vector<Scale>               scales, next;

    double advance(const CountedStates       &group,
                   const State               &end,
                   const std::vector<double> &difference,
                   double                     h,
                   const Scale               &from,
                   Scale                     &to) const;
  };
} // namespace samara

#endif
