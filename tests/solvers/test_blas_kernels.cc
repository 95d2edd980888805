/*
 * Problem:   kernels of OpenBLAS for a processor that it does not know
 * Reference: products of whole numbers, which are exact with any kernel
 */

#include <samara/solvers/blas_kernels.h>

#include <deal.II/lac/lapack_templates.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

using namespace samara;

namespace
{
  /** Largest error of A Bᵀ, n × n, of whole numbers. */
  double
  error_of_product(const int n)
  {
    std::vector<double> a(n * n), b(n * n), c(n * n, 0.);
    for (int i = 0; i < n * n; ++i)
      {
        a[i] = (7 * i) % 11 - 5;
        b[i] = (5 * i) % 13 - 6;
      }
    const dealii::types::blas_int size = n;
    const double                  one = 1, zero = 0;
    dealii::gemm("N", "T", &size, &size, &size, &one, a.data(), &size, b.data(), &size, &zero, c.data(), &size);
    double error = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        {
          double sum = 0;
          for (int k = 0; k < n; ++k)
            sum += a[i + k * n] * b[j + k * n];
          error = std::max(error, std::abs(sum - c[i + j * n]));
        }
    return error;
  }
} // namespace



TEST(BlasKernels, OldOnesAreReplacedByThoseOfTheProcessor)
{
  const VectorUnits none, avx2{true, false}, avx512{true, true};
  EXPECT_EQ(better_kernels("Prescott", avx512), "SkylakeX");
  EXPECT_EQ(better_kernels("PRESCOTT", avx2), "Haswell");
  EXPECT_EQ(better_kernels("Sandybridge", avx2), "Haswell");
  EXPECT_EQ(better_kernels("Prescott", none), "");
  for (const char *const of_its_time : {"Haswell", "SkylakeX", "Cooperlake", "Zen", "Sapphirerapids", "armv8", ""})
    EXPECT_EQ(better_kernels(of_its_time, avx512), "");
}



TEST(BlasKernels, MultiplyWhenTheyHaveBeenReplaced)
{
  EXPECT_EQ(error_of_product(70), 0);
  const NewKernels &kernels = use_kernels_of_processor();
  EXPECT_EQ(error_of_product(70), 0);
  if (kernels.now.empty())
    GTEST_SKIP() << "the BLAS here is another, or its kernels suit the processor, or OPENBLAS_CORETYPE is set";
  EXPECT_NE(better_kernels(kernels.before, VectorUnits::of_this_processor()), "");
  EXPECT_EQ(better_kernels(kernels.now, VectorUnits::of_this_processor()), "");
  EXPECT_EQ(std::getenv("OPENBLAS_CORETYPE"), nullptr) << "programs that are started would have it";
  EXPECT_EQ(&use_kernels_of_processor(), &kernels);
}
