#include <samara/base/threads.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/multithread_info.h>
#include <deal.II/base/parallel.h>

namespace samara
{
  void
  set_threads(const unsigned int n)
  {
    dealii::MultithreadInfo::set_thread_limit(n > 0 ? n : dealii::MultithreadInfo::n_cores());
  }



  unsigned int
  n_threads()
  {
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
