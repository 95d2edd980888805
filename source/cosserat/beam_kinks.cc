// What elements of a beam lack where something acts within one of them.

#include <samara/cosserat/beam.h>
#include <samara/rotation/matrix6.h>

#include <deal.II/base/polynomial.h>

#include <algorithm>

namespace samara
{
  namespace
  {
    /**
     * Σ (∫₀^ξ φ_k)² over k ≥ p, φ_k the polynomials of Legendre that are orthonormal on (0, 1): a moment that jumps at
     * ξ has them all, moments of an element of degree @p p those up to p − 1. The sum over all k ≥ 1 is ξ (1 − ξ).
     */
    double
    unresolved_part(const double xi, const unsigned int p)
    {
      double sum = xi * (1 - xi);
      for (unsigned int k = 1; k < p; ++k)
        {
          // on (0, 1) the integral of φ_k from 0 on is (P_k+1 − P_k−1)/(2 √(2k + 1)), and L_k = √(2k + 1) P_k
          const dealii::Polynomials::Legendre above(k + 1), below(k - 1);
          const double integral = (above.value(xi) / std::sqrt(2. * k + 3) - below.value(xi) / std::sqrt(2. * k - 1)) /
                                  (2 * std::sqrt(2. * k + 1));
          sum -= integral * integral;
        }
      return std::max(0., sum);
    }
  } // namespace



  double
  Beam::lacking(const double S, const Vector6 &wrench) const
  {
    if (n_elements() == 0)
      return 0; // rigid
    const auto         behind = std::find_if(cells.begin(), cells.end(), [&](const Cell &c) { return S < c.end; });
    const unsigned int i      = std::min<unsigned int>(behind - cells.begin(), cells.size() - 1);
    const double       h = cells[i].end - cells[i].start, xi = std::clamp((S - cells[i].start) / h, 0., 1.);
    // the material of the nearest point of integration
    const ElementTable<1> &t     = *elements[i].table;
    unsigned int           point = 0;
    for (unsigned int g = 1; g < t.n_points; ++g)
      if (std::abs(t.points[g][0] - xi) < std::abs(t.points[point][0] - xi))
        point = g;
    const Matrix6 &C = materials[integration_points()[elements[i].first_point + point].material].stiffness;
    Vector6        jump(wrench);
    jump(1) = jump(2) = 0;
    return h * unresolved_part(xi, cells[i].degree) * jump.dot(symmetric_solution(C, jump));
  }



  double
  Beam::elastic_energy(const State &state) const
  {
    std::vector<double> e(n_strains());
    strains_at(state.point(), e.data());
    return strain_energy(e.data());
  }
} // namespace samara
