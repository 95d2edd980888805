#ifndef samara_cosserat_section_average_h
#define samara_cosserat_section_average_h

#include <samara/base/composite_rule.h>
#include <samara/rotation/rotation.h>

#include <functional>
#include <vector>

namespace samara
{
  /**
   * Means of a symmetric positive semidefinite 6×6 property f along an element, one for each point of its rule, for an
   * f with kinks or jumps in between:
   *
   *     f_g = 1/w_g ∫ L_g f dξ,   L_g the Lagrange polynomials of the points, ξ from 0 to 1.
   *
   * Σ w_g f_g p(ξ_g) = ∫ f p dξ for all polynomials p through the points: sums over the points are as good as for a
   * smooth f. Where f varies so much that a mean is less than a fiftieth of the plain one over the point's own share of
   * the element, which begins at the sum of the weights before it, as much of the plain ones is mixed in as it takes:
   * they are positive and have the same total.
   *
   * @param breaks where f has kinks, with 0 and 1
   */
  std::vector<Matrix6> section_averages(const std::vector<double>                  &points,
                                        const std::vector<double>                  &weights,
                                        const std::vector<double>                  &breaks,
                                        const std::function<Matrix6(double /*ξ*/)> &f);

  /** The rule by which those integrals are found: pieces between breaks, and within them where f changes much. */
  std::vector<RulePoint> section_rule(const std::vector<double> &breaks, const std::function<Matrix6(double /*ξ*/)> &f);
} // namespace samara

#endif
