#ifndef samara_base_differentiation_h
#define samara_base_differentiation_h

#include <Eigen/Core>
#include <Sacado_Fad_SFad.hpp>

namespace samara
{
  /**
   * A number with its derivatives by @p n variables, for automatic differentiation of templates: Sacado's, forward.
   * Differentials of differentials hold second derivatives: x.dx(i).dx(j).
   */
  template <typename Number, int n>
  using Differential = Sacado::Fad::SFad<Number, n>;
} // namespace samara

namespace Eigen
{
  /** What Eigen must know of a number before vectors and matrices can have it as entries. */
  template <typename T, int n>
  struct NumTraits<Sacado::Fad::SFad<T, n>> : GenericNumTraits<Sacado::Fad::SFad<T, n>>
  {
    using Real       = Sacado::Fad::SFad<T, n>;
    using NonInteger = Real;
    using Nested     = Real;
    using Literal    = double;
    enum
    {
      IsComplex             = 0,
      IsInteger             = 0,
      IsSigned              = 1,
      RequireInitialization = 1,
      ReadCost              = n,
      AddCost               = n,
      MulCost               = 2 * n
    };
  };

  /** Plain numbers times such ones. */
  template <typename T, int n, typename Operation>
  struct ScalarBinaryOpTraits<double, Sacado::Fad::SFad<T, n>, Operation>
  {
    using ReturnType = Sacado::Fad::SFad<T, n>;
  };
  template <typename T, int n, typename Operation>
  struct ScalarBinaryOpTraits<Sacado::Fad::SFad<T, n>, double, Operation>
  {
    using ReturnType = Sacado::Fad::SFad<T, n>;
  };
} // namespace Eigen

#endif
