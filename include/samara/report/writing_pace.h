#ifndef samara_report_writing_pace_h
#define samara_report_writing_pace_h

#include <chrono>
#include <ctime>

namespace samara
{
  /**
   * When the page of a run that goes on is written again: as often as its writing takes no more than a hundredth of the
   * run's processor time until then, and at most every two seconds. A page costs the more the more there is to show. So
   * the cost of the next one is that of the last one, and as much more as it grew from the one before, as time goes on,
   * but twice that of the last at most: what a page shows is bounded. The first page, written at once, has nothing in
   * it yet: the second is taken to cost twenty times as much.
   *
   * The share is kept, not hoped for: what has been spent is counted, and a page that cost more than expected delays
   * the next. Only the first page comes for nothing.
   */
  class WritingPace
  {
  public:
    /** Since the start of the process [s], by the clock on the wall and by that of the processor. */
    struct Time
    {
      double wall, processor;

      static Time
      now()
      {
        return {std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(),
                double(std::clock()) / CLOCKS_PER_SEC};
      }
    };

    static constexpr double share = 0.01, least_period = 2; // [1], [s]

    /** Whether it may be due, by the wall alone: asked each step. */
    bool
    may_be_due(const double wall) const
    {
      return n == 0 || wall >= last.wall + least_period;
    }

    bool is_due(const Time &now) const;

    /** A page was written from @p begin to @p end. */
    void wrote(const Time &begin, const Time &end);

    /** From the last writing to the next one, by the wall, as far as can be said now [s]. */
    double period() const;

    unsigned int n     = 0;            ///< pages written
    double       spent = 0, first = 0; ///< of the processor on all of them, and on the first [s]

  private:
    Time   last{0, 0};    ///< when the last one was done
    double cost      = 0; ///< of that [s]
    double growth    = 0; ///< of the cost [s] in a second of the processor
    double last_asks = 0; ///< processor time at which that was begun [s]
    double begun     = 0; ///< on the wall: the first one [s]

    /** Of the next page, at most, at this time of the processor. */
    double next_cost(double processor) const;
  };
} // namespace samara

#endif
