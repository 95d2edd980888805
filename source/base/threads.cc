#include <samara/base/threads.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/multithread_info.h>
#include <deal.II/base/parallel.h>

#include <atomic>
#include <mutex>

// of OpenMP, which CHOLMOD uses
extern "C" void omp_set_max_active_levels(int);

namespace samara
{
  namespace
  {
    /** A pool of threads takes milliseconds to start: it is made where it is used first. */
    std::atomic<unsigned int> wanted{0}, in_force{0};

    void
    start_threads()
    {
      static std::mutex                 mutex;
      const std::lock_guard<std::mutex> guard(mutex);
      if (in_force == wanted)
        return;
      const unsigned int n = wanted;
      dealii::MultithreadInfo::set_thread_limit(n);
      in_force = n;
    }
  } // namespace



  void
  set_threads(const unsigned int n)
  {
    wanted = n > 0 ? n : dealii::MultithreadInfo::n_cores();
    // With one thread libraries have one, too: threads of theirs are not there in a process that is forked from this one,
    // and are waited for without end.
    omp_set_max_active_levels(wanted == 1 ? 0 : 1);
    if (wanted == 1)
      start_threads();
  }



  unsigned int
  n_threads()
  {
    if (in_force != wanted)
      start_threads();
    return dealii::MultithreadInfo::n_threads();
  }



  void
  parallel_for(const unsigned int                                     n,
               const unsigned int                                     worthwhile,
               const std::function<void(unsigned int, unsigned int)> &f)
  {
    Assert(f != nullptr, dealii::ExcMessage("There is nothing to call."));
    if (n < worthwhile || n_threads() == 1)
      return f(0, n);
    // a few parts a thread even out what other programs take away
    dealii::parallel::apply_to_subranges(0u, n, f, std::max(1u, n / (4 * n_threads())));
  }
} // namespace samara
