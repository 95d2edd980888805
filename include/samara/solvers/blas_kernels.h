#ifndef samara_solvers_blas_kernels_h
#define samara_solvers_blas_kernels_h

#include <string>

namespace samara
{
  /** What the processor has, and the system saves. */
  struct VectorUnits
  {
    bool avx2   = false; ///< with fused products
    bool avx512 = false; ///< with all that OpenBLAS uses of it

    static VectorUnits of_this_processor();
  };

  /**
   * The kernels of OpenBLAS, by the names of OPENBLAS_CORETYPE, that suit better than those in use; nothing if these
   * know AVX2, or the processor does not.
   */
  std::string better_kernels(const std::string &in_use, const VectorUnits &units);

  /** Which kernels have been replaced; none if the names are empty. */
  struct NewKernels
  {
    std::string before, now;
  };

  /**
   * OpenBLAS takes the kernels of an old processor, without AVX, for one that is newer than the library: half as fast.
   * They are chosen anew, by its own gotoblas_dynamic_init(), as if OPENBLAS_CORETYPE named better ones. Nothing is
   * done if that is set, with another BLAS, and if it has kernels of its time. This is done at the first call, once in
   * a process, while no other thread uses BLAS.
   */
  const NewKernels &use_kernels_of_processor();
} // namespace samara

#endif
