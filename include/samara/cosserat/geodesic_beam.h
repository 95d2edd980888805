#ifndef samara_cosserat_geodesic_beam_h
#define samara_cosserat_geodesic_beam_h

#include <samara/cosserat/beam.h>
#include <samara/cosserat/prototype.h>

namespace samara
{
  /**
   * A beam of two nodes an element whose triads turn about one axis from one node to the other, at a constant rate; an
   * example of a Prototype:
   *
   *     φ = log(D₀ᵀ D₁)     d(s) = D₀ exp(φ s/L)     K = φ/L     Γ = dᵀ x',   x linear, taken in the middle
   *
   * Interpolated triads are orthonormal, and strains do not change in rigid motions. They are not quadratic: steps in
   * time miss some energy, in proportion to h^(2 s). Triads of neighbouring nodes must be less than half a turn apart.
   *
   * Source: Crisfield & Jelenić, Objectivity of strain measures in the geometrically exact three-dimensional beam
   * theory and its finite-element implementation, Proc. R. Soc. A 455 (1999) 1125–1147.
   */
  class GeodesicBeam : public Prototype<GeodesicBeam, Beam, 1>
  {
  public:
    template <typename Number>
    void strains_of(const PrototypeElement<1> &element, const kernel::NodeValues<Number> *nodes, Number *e) const;
  };

  // its functions are compiled where the strains are
  extern template class Prototype<GeodesicBeam, Beam, 1>;
} // namespace samara

#endif
