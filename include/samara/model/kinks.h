#ifndef samara_model_kinks_h
#define samara_model_kinks_h

#include <samara/model/state.h>

namespace samara
{
  /** A body of elements whose section forces are polynomials: they have no jump where something acts within one. */
  class HasKinks
  {
  public:
    virtual ~HasKinks() = default;

    /**
     * What is too stiff at the abscissa @p S [m] for a wrench (n, m) [N, N m] in the section's axes there: λᵀ F λ, F the
     * compliance that elements lack, twice the energy that the body would have more [J]. Forces across the line are
     * left out, which is of third order in the length of elements. Source: doc/theory/sliding.md.
     */
    virtual double lacking(double S, const Vector6 &wrench) const = 0;

    /** [J] */
    virtual double elastic_energy(const State &state) const = 0;
  };
} // namespace samara

#endif
