#ifndef samara_base_threads_h
#define samara_base_threads_h

#include <functional>

namespace samara
{
  /**
   * Use at most @p n threads in all that follows, 0: as many as there are processors. Results do not depend on it:
   * sums are made in the same order.
   */
  void set_threads(unsigned int n);

  unsigned int n_threads();

  /**
   * Call @p f(begin, end) for parts of the range [0, n), on several threads if there are at least @p worthwhile
   * indices; at once, in one part, if not. What @p f does for one index must not touch what it does for another.
   * An exception thrown in @p f reaches the caller.
   */
  void parallel_for(unsigned int n, unsigned int worthwhile, const std::function<void(unsigned int, unsigned int)> &f);
} // namespace samara

#endif
