#ifndef samara_tests_benchmarks_cpu_seconds_h
#define samara_tests_benchmarks_cpu_seconds_h

#include <ctime>

namespace samara
{
  /** Time of the processor that this process has had, all threads [s]. */
  inline double
  cpu_seconds()
  {
    timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
  }
} // namespace samara

#endif
