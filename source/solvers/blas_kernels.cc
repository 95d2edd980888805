#include <samara/solvers/blas_kernels.h>

#include <dlfcn.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <set>

namespace samara
{
  namespace
  {
    constexpr const char *by_environment = "OPENBLAS_CORETYPE";

    template <typename Function>
    Function *
    function_of_library(const char *name)
    {
      return reinterpret_cast<Function *>(dlsym(RTLD_DEFAULT, name));
    }

    /** OpenBLAS, if kernels of more than one processor are in it. */
    struct OpenBlas
    {
      char *(*name)() = function_of_library<char *()>("openblas_get_corename");
      void (*quit)()  = function_of_library<void()>("gotoblas_dynamic_quit");
      void (*init)()  = function_of_library<void()>("gotoblas_dynamic_init");

      explicit operator bool() const
      {
        return name != nullptr && quit != nullptr && init != nullptr;
      }

      void
      choose(const std::string &kernels) const
      {
        setenv(by_environment, kernels.c_str(), 1);
        quit();
        init();
        unsetenv(by_environment);
      }
    };
  } // namespace



  VectorUnits
  VectorUnits::of_this_processor()
  {
    VectorUnits units;
#if defined(__x86_64__)
    __builtin_cpu_init();
    units.avx2   = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    units.avx512 = units.avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
                   __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
                   __builtin_cpu_supports("avx512vl");
#endif
    return units;
  }



  std::string
  better_kernels(const std::string &in_use, const VectorUnits &units)
  {
    // those without AVX2, but for AMD's with fused products of their own
    static const std::set<std::string> old  = {"katmai",
                                               "coppermine",
                                               "northwood",
                                               "banias",
                                               "prescott",
                                               "core2",
                                               "penryn",
                                               "dunnington",
                                               "nehalem",
                                               "athlon",
                                               "opteron",
                                               "opteron_sse3",
                                               "atom",
                                               "nano",
                                               "barcelona",
                                               "bobcat",
                                               "sandybridge"};
    std::string                        name = in_use;
    std::transform(name.begin(), name.end(), name.begin(), [](const unsigned char c) { return std::tolower(c); });
    if (old.count(name) == 0 || !units.avx2)
      return "";
    return units.avx512 ? "SkylakeX" : "Haswell";
  }



  namespace
  {
    NewKernels
    replace_kernels()
    {
      const OpenBlas library;
      if (!library || std::getenv(by_environment) != nullptr)
        return {};
      const std::string before  = library.name();
      const std::string kernels = better_kernels(before, VectorUnits::of_this_processor());
      if (kernels.empty())
        return {};
      library.choose(kernels);
      return {before, library.name()};
    }
  } // namespace



  const NewKernels &
  use_kernels_of_processor()
  {
    static const NewKernels once = replace_kernels();
    return once;
  }
} // namespace samara
