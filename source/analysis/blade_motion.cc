#include <samara/analysis/blade_motion.h>

#include <cmath>

namespace samara
{
  namespace
  {
    /** That counts when signs are compared, of the largest. */
    constexpr double least_motion = 0.1;
  } // namespace



  Vector3
  centre_of_mass(const Matrix6 &inertia)
  {
    const double m = inertia(0, 0);
    if (!(m > 0))
      return Vector3::Zero();
    const Matrix3 c = -inertia.topRightCorner<3, 3>() / m; // m c~ stands beside the mass
    return {c(2, 1), c(0, 2), c(1, 0)};
  }



  double
  energy_of_node(const System &system, const Eigen::VectorXcd &x, const unsigned int node)
  {
    const Eigen::Matrix<std::complex<double>, 6, 1> z = x.segment<6>(system.layout.of_node(node));
    return (z.adjoint() * system.model.nodes[node].inertia * z)(0, 0).real();
  }



  unsigned int
  parts_of_alternating_sign(const std::vector<std::complex<double>> &motion)
  {
    std::complex<double> greatest = 0;
    for (const auto &value : motion)
      if (std::abs(value) > std::abs(greatest))
        greatest = value;
    unsigned int n      = 1;
    double       before = 0;
    for (const auto &value : motion)
      {
        const double now = std::abs(greatest) > 0 ? (value / greatest).real() : 0.;
        if (std::abs(now) < least_motion)
          continue;
        n += now * before < 0;
        before = now;
      }
    return n;
  }
} // namespace samara
