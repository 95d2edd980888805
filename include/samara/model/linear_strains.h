#ifndef samara_model_linear_strains_h
#define samara_model_linear_strains_h

#include <samara/model/state.h>

namespace samara
{
  /**
   * Strains linearised about one configuration, B, for many uses: e = B ζ and the forces Bᵀσ. An
   * iteration whose matrices were made there needs the same B (mixed Newton, doc/theory/integrators.md).
   */
  class LinearStrains
  {
  public:
    virtual ~LinearStrains() = default;

    /** Take B at @p point, whose multipliers must be zero, and which must stay as it is until the next call. */
    virtual void renew(const Point<double> &point) = 0;

    /** e = B (y, rates), starting at the deformation's own first strain. */
    virtual void strains(const double *y, const double *rates, double *e) const = 0;

    /** Add Bᵀσ to the global @p r; @p stress starts at the deformation's own first strain. */
    virtual void add_forces(const double *stress, double *r) const = 0;
  };
} // namespace samara

#endif
