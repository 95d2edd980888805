#include <samara/section/elasticity.h>

#include <samara/rotation/matrix6.h>

#include <stdexcept>
#include <string>

namespace samara
{
  namespace elasticity
  {
    namespace
    {
      constexpr int first_index[6]  = {0, 1, 2, 1, 0, 0};
      constexpr int second_index[6] = {0, 1, 2, 2, 2, 1};
    } // namespace



    Matrix6
    stiffness(const Orthotropic &m)
    {
      for (const double modulus : {m.E1, m.E2, m.E3, m.G12, m.G13, m.G23})
        if (!(modulus > 0))
          throw std::invalid_argument("moduli must be above zero");
      Matrix6 compliance = Matrix6::Zero();
      compliance.diagonal() << 1 / m.E1, 1 / m.E2, 1 / m.E3, 1 / m.G23, 1 / m.G13, 1 / m.G12;
      compliance(0, 1) = compliance(1, 0) = -m.nu12 / m.E1;
      compliance(0, 2) = compliance(2, 0) = -m.nu13 / m.E1;
      compliance(1, 2) = compliance(2, 1) = -m.nu23 / m.E2;
      if (!is_positive_definite(compliance))
        throw std::invalid_argument(
          "these moduli and Poisson ratios give no positive energy: the ratios are too large (|nu12| < sqrt(E1/E2), "
          "and likewise for the others and for all three together)");
      return positive_inverse(compliance);
    }



    Matrix6
    isotropic_stiffness(const double E, const double nu)
    {
      const double G = E / 2 / (1 + nu);
      return stiffness({E, E, E, G, G, G, nu, nu, nu});
    }



    Matrix6
    turn_of_stress(const Matrix3 &R)
    {
      // σ_ij = R_ik R_jl σ_kl, both orders of a shear stress together
      Matrix6 M;
      for (int a = 0; a < 6; ++a)
        for (int b = 0; b < 6; ++b)
          {
            const int i = first_index[a], j = second_index[a], k = first_index[b], l = second_index[b];
            M(a, b) = R(i, k) * R(j, l) + (k != l ? R(i, l) * R(j, k) : 0.);
          }
      return M;
    }



    Matrix6
    turned(const Matrix6 &C, const Matrix3 &R)
    {
      const Matrix6 M = turn_of_stress(R);
      return M * C * M.transpose();
    }
  } // namespace elasticity
} // namespace samara
