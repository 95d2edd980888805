#include <samara/section/section_constants.h>

#include <samara/rotation/matrix6.h>

namespace samara
{
  namespace
  {
    SectionConstants::Principal
    principal_of(const Eigen::Matrix2d &A)
    {
      const Eigen::Vector2d       values = symmetric_eigenvalues2(A);
      SectionConstants::Principal result;
      result.smaller = values(0);
      result.larger  = values(1);
      // of a section that has none, or nearly, the angle would be noise
      if (result.larger - result.smaller > 1e-9 * result.larger)
        {
          const Eigen::Vector2d axis = symmetric_eigenvectors2(A).col(1);
          result.angle               = std::atan2(axis(1), axis(0));
          if (result.angle > M_PI / 2 * (1 + 1e-12))
            result.angle -= M_PI;
          if (result.angle <= -M_PI / 2 * (1 - 1e-12))
            result.angle += M_PI;
        }
      return result;
    }
  } // namespace



  SectionConstants::SectionConstants(const Matrix6 &F, const Matrix6 &inertia)
  {
    shear_centre = {-F(3, 2) / F(3, 3), F(3, 1) / F(3, 3)};
    GJ           = 1 / F(3, 3);

    // a force at (y₂, y₃) has the moments M₂ = y₃ F, M₃ = −y₂ F; no bending: F₅₁ + F₅₅ y₃ − F₅₆ y₂ = 0, and for K₃
    const Eigen::Matrix2d F_bending = F.bottomRightCorner<2, 2>();
    bending                         = F_bending.inverse();
    const Eigen::Vector2d moment    = -bending * F.block<2, 1>(4, 0);
    tension_centre                  = {-moment(1), moment(0)};
    EA                              = 1 / (F(0, 0) + F.block<1, 2>(0, 4) * moment);
    principal_bending               = principal_of(bending);

    // a shear force at the shear centre has the torque that leaves K₁ = 0
    const Eigen::Matrix2d F_shear = F.block<2, 2>(1, 1) - F.block<2, 1>(1, 3) * F.block<1, 2>(3, 1) / F(3, 3);
    shear                         = F_shear.inverse();
    principal_shear               = principal_of(shear);

    mass = inertia(0, 0);
    mass_centre.setZero();
    moments.setZero();
    if (mass > 0)
      {
        mass_centre = Eigen::Vector2d(-inertia(0, 5), inertia(0, 4)) / mass;
        const Eigen::Vector2d c(mass_centre(1), -mass_centre(0));
        moments = inertia.bottomRightCorner<2, 2>() - mass * c * c.transpose();
      }
    principal_moments = principal_of(moments);
  }


  std::vector<SectionConstants::Named>
  SectionConstants::list() const
  {
    constexpr double degrees = 180 / M_PI;
    const auto       angle   = [](const std::string &name, const Principal &axes) {
      return Named{"angle of larger " + name,
                   "deg",
                   axes.angle * degrees,
                   axes.larger - axes.smaller < 1e-6 * axes.larger};
    };
    return {{"EA", "N", EA},
            {"GJ", "N m^2", GJ},
            {"larger EI", "N m^2", principal_bending.larger},
            {"smaller EI", "N m^2", principal_bending.smaller},
            angle("EI", principal_bending),
            {"larger GA", "N", principal_shear.larger},
            {"smaller GA", "N", principal_shear.smaller},
            angle("GA", principal_shear),
            {"tension centre 2", "m", tension_centre(0)},
            {"tension centre 3", "m", tension_centre(1)},
            {"shear centre 2", "m", shear_centre(0)},
            {"shear centre 3", "m", shear_centre(1)},
            {"mass", "kg/m", mass},
            {"mass centre 2", "m", mass_centre(0)},
            {"mass centre 3", "m", mass_centre(1)},
            {"larger I", "kg m", principal_moments.larger},
            {"smaller I", "kg m", principal_moments.smaller},
            angle("I", principal_moments)};
  }
} // namespace samara
