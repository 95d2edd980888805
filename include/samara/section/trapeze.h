#ifndef samara_section_trapeze_h
#define samara_section_trapeze_h

#include <samara/rotation/rotation.h>

#include <string>

namespace samara
{
  class CrossSection;

  /**
   * What tension does to torsion (trapeze or Wagner effect). A fibre at the distance r from the shear centre becomes a
   * helix, longer by ½ r² K₁², so that the energy per length is
   *
   *     ½ eᵀ C e + ½ K₁² p·e + ⅛ q K₁⁴        p·e = ∫ σ₁₁ r² dA at small strains e, q = ∫ E₁ r⁴ dA
   *
   * The torsional stiffness under a tensile force N of an isotropic section is then GJ + N ∫r²dA / A; a strip b × t
   * with free ends has the moment GJ K₁ + E t b⁵ K₁³ / 360. E₁ is the modulus of a fibre that is free across.
   *
   * Sources: Wagner, 25 Jahre TH Danzig (1929) 329–343; Goodier, J. Appl. Mech. 17 (1950) 383–387; Hodges, Nonlinear
   * Composite Beam Theory (2006), 4.
   */
  struct Trapeze
  {
    Vector6 coupling  = Vector6::Zero(); ///< p, by Γ₁ Γ₂ Γ₃ K₁ K₂ K₃ [N m², N m³]
    double  stiffness = 0;               ///< q [N m⁴]; zero: the section has no such effect

    bool
    is_there() const
    {
      return stiffness != 0.;
    }
  };

  /** The least q for which the energy is positive with the stiffness @p C: p·C⁻¹p. */
  double least_stiffness(const Trapeze &trapeze, const Matrix6 &C);

  /** @p trapeze with a q above the least one by a thousandth: a thin ring has just the least. */
  Trapeze with_margin(Trapeze trapeze, const Matrix6 &C);

  /** Of a section that has been analysed. */
  Trapeze trapeze_of(const CrossSection &section);

  /** Place (y₂, y₃) about which a section turns under a torque, from its compliance [m]. */
  Eigen::Vector2d shear_centre(const Matrix6 &compliance);

  /** What is wrong with the numbers of @p what, "section <tip>"; "" if nothing is. */
  std::string fault_of(const Trapeze &trapeze, const Matrix6 &C, const std::string &what);
} // namespace samara

#endif
