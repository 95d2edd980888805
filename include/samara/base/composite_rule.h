#ifndef samara_base_composite_rule_h
#define samara_base_composite_rule_h

#include <vector>

namespace samara
{
  /** A point of a quadrature rule. */
  struct RulePoint
  {
    double x, weight;
  };

  /**
   * Gauss's rule with @p n points on each piece between neighbours of the increasing numbers @p breaks: exact for what
   * is a polynomial of degree 2n − 1 on each of them, wherever it jumps at a break.
   */
  std::vector<RulePoint> composite_rule(const std::vector<double> &breaks, unsigned int n);

  /** Value at @p x of the Lagrange polynomial that is 1 at node @p a and 0 at the other @p nodes. */
  double lagrange(const std::vector<double> &nodes, unsigned int a, double x);
} // namespace samara

#endif
