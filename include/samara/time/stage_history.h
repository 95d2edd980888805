#ifndef samara_time_stage_history_h
#define samara_time_stage_history_h

#include <array>
#include <vector>

namespace samara
{
  /**
   * What the stages of the last steps had, steps of one length, and what those of the next will have by it.
   *
   * Each number is extrapolated from the same stage of the steps before. So errors of stages, of which multipliers have
   * some of the first order in the step, are extrapolated, too, for they go on smoothly from step to step. The order is
   * that with which the number would have been nearest in the last step, or none, if another guess was nearer. That is
   * found for each number by itself, so that no units are compared: what vibrates and is not resolved is left alone.
   * Where that holds for most of them, nothing is remembered for some time.
   */
  class StageHistory
  {
  public:
    /** Orders are one less. */
    static constexpr unsigned int most_steps = 5;

    explicit StageHistory(const unsigned int n_stages)
      : stages(n_stages)
    {}

    /** Of nothing: the next step is the first, or has another length. */
    void
    forget()
    {
      n_steps = 0;
    }

    /** Put what stage @p k of the next step may have in the place of @p values, a guess of another kind. */
    void extrapolate(unsigned int k, std::vector<double> &values) const;

    /** Whether nothing is remembered at present: guesses are not looked at. */
    bool
    pauses() const
    {
      return n_steps > most_steps;
    }

    /** What stage @p k has had, and the guess of another kind; of all stages, beginning with the first. */
    void remember(unsigned int k, const std::vector<double> &values, const std::vector<double> &otherwise);

  private:
    struct Stage
    {
      std::array<std::vector<double>, most_steps> values; ///< of steps, the last one first
      std::vector<double>                         order;  ///< that was best; 0: the other guess
    };
    std::vector<Stage> stages;
    unsigned int       n_steps = 0; ///< that are known; beyond most_steps: so many to come that are not looked at
  };
} // namespace samara

#endif
