#ifndef samara_aero_separation_h
#define samara_aero_separation_h

#include <samara/aero/airfoil_table.h>

#include <functional>

namespace samara
{
  /**
   * Flow that separates from the trailing edge, from the static lift c_l(α) of a section: with c_l,p = a (α − α₀) that
   * of attached flow, and the place f of separation, 1 at the trailing edge, after G. Kirchhoff
   *
   *     c_l = c_l,p ((1 + √f)/2)²,  f = (2 √(c_l/c_l,p) − 1)² where c_l/c_l,p is from ¼ to 1, 0 beyond
   *
   * a is the largest c_l/(α − α₀) within 15° of α₀. Lift at the place x of separation is c_l + (x − f) ∂c_l, with
   * ∂c_l = (c_l,p − c_l)/(1 − f): the mean of attached and fully separated flow, M. H. Hansen, M. Gaunaa & H. Aa.
   * Madsen, A Beddoes–Leishman type dynamic stall model in state-space and indicial formulations, Risø-R-1354 (2004).
   * Here c_l,p = ½ a sin 2(α − α₀), so that it ends with the plate.
   */
  class Separation
  {
  public:
    /** @throws std::invalid_argument if there is no angle without lift within 20° of zero, or no lift at all */
    explicit Separation(const std::function<double(double)> &lift);

    /** f and ∂c_l at the angle α, any number, with their slopes [1/rad]. */
    struct Value
    {
      double place, place_alpha, gain, gain_alpha;
    };
    Value at(double alpha) const;

    double zero_lift; ///< α₀

  private:
    AirfoilTable place, gain;
  };
} // namespace samara

#endif
