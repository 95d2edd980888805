#ifndef samara_section_elasticity_h
#define samara_section_elasticity_h

#include <samara/rotation/rotation.h>

namespace samara
{
  /**
   * Linear elasticity in Voigt order 11 22 33 23 13 12, shear strains doubled: σ = C ε, C 6×6 symmetric, positive
   * definite [Pa].
   */
  namespace elasticity
  {
    /** Nine constants of an orthotropic material; ν_ij: contraction along j under tension along i [Pa, 1]. */
    struct Orthotropic
    {
      double E1, E2, E3, G12, G13, G23, nu12, nu13, nu23;
    };

    /** @throws std::invalid_argument if the matrix is not positive definite, with what is wrong. */
    Matrix6 stiffness(const Orthotropic &material);
    Matrix6 isotropic_stiffness(double E, double nu);

    /** Stresses σ = M σ_m in axes in which the columns of @p R are the axes of the material (Bond 1943). */
    Matrix6 turn_of_stress(const Matrix3 &R);

    /** The stiffness in these axes, M C Mᵀ. */
    Matrix6 turned(const Matrix6 &C, const Matrix3 &R);
  } // namespace elasticity
} // namespace samara

#endif
