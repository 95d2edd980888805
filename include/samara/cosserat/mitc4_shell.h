#ifndef samara_cosserat_mitc4_shell_h
#define samara_cosserat_mitc4_shell_h

#include <samara/cosserat/prototype.h>
#include <samara/cosserat/shell.h>

namespace samara
{
  /**
   * A shell of four nodes an element whose transverse shear is taken at the middles of its sides, as in the MITC4 of
   * Dvorkin & Bathe; an example of a Prototype. Places and triads are interpolated linearly:
   *
   *     Γ_α = dᵀ x,_α     K_α = axial(dᵀ d,_α)     but Γ_α3 from γ_β = d₃ · x,_β along the unit coordinates β:
   *     γ₁ linear in the second coordinate through the middles of sides 2 and 3, γ₂ in the first through 0 and 1
   *
   * With the shear of the sides thin plates do not lock; membrane strains are not assumed, so that curved shells and
   * bending in the plane are stiff on coarse meshes. All strains are quadratic: steps in time keep energy.
   *
   * Source: Dvorkin & Bathe, A continuum mechanics based four-node shell element for general non-linear analysis,
   * Engineering Computations 1 (1984) 77–88; the strains are those of this program (doc/theory/shell.md), with triads
   * in place of directors.
   */
  class Mitc4Shell : public Prototype<Mitc4Shell, Shell, 1>
  {
  public:
    Mitc4Shell()
    {
      takes_any_cell = true;
    }

    template <typename Number>
    void strains_of(const PrototypeElement<2> &element, const kernel::NodeValues<Number> *nodes, Number *e) const;
  };

  // its functions are compiled where the strains are
  extern template class Prototype<Mitc4Shell, Shell, 1>;
} // namespace samara

#endif
