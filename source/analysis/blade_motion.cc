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



  std::complex<double>
  product_of_node(const System &system, const Eigen::VectorXcd &y, const Eigen::VectorXcd &x, const unsigned int node)
  {
    const Eigen::Matrix<std::complex<double>, 6, 1> a = y.segment<6>(system.layout.of_node(node)),
                                                    b = x.segment<6>(system.layout.of_node(node));
    return (a.transpose() * system.model.nodes[node].inertia * b)(0, 0);
  }



  Weighing::Weighing(const System &system, const Eigen::VectorXcd &x, const Eigen::VectorXcd &known)
    : y(x.conjugate())
  {
    if (known.size() == 0)
      return;
    std::complex<double> sum   = 0;
    double               right = 0, left = 0;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        sum += product_of_node(system, known, x, node);
        right += product_of_node(system, x.conjugate(), x, node).real();
        left += product_of_node(system, known.conjugate(), known, node).real();
      }
    // below this the two look at different things: an inflow that dies away moves the blades, which do not move it
    constexpr double least = 0.1;
    if (!(std::abs(sum) > least * std::sqrt(right * left)))
      return;
    y     = known;
    phase = std::conj(sum) / std::abs(sum);
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
