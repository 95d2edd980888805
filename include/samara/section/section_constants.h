#ifndef samara_section_section_constants_h
#define samara_section_section_constants_h

#include <samara/rotation/rotation.h>

#include <string>
#include <vector>

namespace samara
{
  /**
   * What engineers call the numbers in the compliance F and the inertia of a section. Each stiffness is that against
   * one force alone, all others being zero: the section is free to do what its couplings want.
   */
  struct SectionConstants
  {
    /**
     * @param compliance strains (Γ₁ Γ₂ Γ₃ K₁ K₂ K₃) of unit forces (F₁ F₂ F₃ M₁ M₂ M₃)
     * @param inertia [m I, −m c~; m c~, J] per length; without mass what concerns it is zero
     */
    SectionConstants(const Matrix6 &compliance, const Matrix6 &inertia);

    /** Two stiffnesses and where they are, of a symmetric 2×2 matrix. */
    struct Principal
    {
      double larger = 0, smaller = 0;
      double angle = 0; ///< of the axis of the larger one from axis 2 towards axis 3, in (−π/2, π/2] [rad]
    };

    Eigen::Vector2d shear_centre;   ///< (x₂, x₃) where a transverse force does not twist the section [m]
    Eigen::Vector2d tension_centre; ///< (x₂, x₃) where an axial force does not bend the section [m]
    Eigen::Vector2d mass_centre;    ///< [m]

    double EA; ///< against a force at the tension centre [N]
    double GJ; ///< against torsion [N m²]

    /** Bending moments (M₂ M₃) from (K₂ K₃) without other forces than moments [N m²]. */
    Eigen::Matrix2d bending;
    Principal       principal_bending;

    /** Shear forces (F₂ F₃), acting at the shear centre, from (Γ₂ Γ₃) of the reference line [N]. */
    Eigen::Matrix2d shear;
    Principal       principal_shear;

    double          mass;    ///< [kg/m]
    Eigen::Matrix2d moments; ///< ∫ρ of (y₃², −y₂y₃; −y₂y₃, y₂²) about the mass centre [kg m]
    Principal       principal_moments;

    /** A number as people read it. */
    struct Named
    {
      std::string name, unit;
      double      number;
      bool        is_vague = false; ///< an angle of axes that are principal axes in nearly all directions
    };
    /** All of them, angles in degrees. */
    std::vector<Named> list() const;
  };
} // namespace samara

#endif
