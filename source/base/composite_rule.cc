#include <samara/base/composite_rule.h>

#include <deal.II/base/quadrature_lib.h>

namespace samara
{
  std::vector<RulePoint>
  composite_rule(const std::vector<double> &breaks, const unsigned int n)
  {
    const dealii::QGauss<1> rule(n);
    std::vector<RulePoint>  points;
    for (unsigned int i = 0; i + 1 < breaks.size(); ++i)
      for (unsigned int g = 0; g < n; ++g)
        points.push_back(
          {breaks[i] + (breaks[i + 1] - breaks[i]) * rule.point(g)[0], (breaks[i + 1] - breaks[i]) * rule.weight(g)});
    return points;
  }



  double
  lagrange(const std::vector<double> &nodes, const unsigned int a, const double x)
  {
    double value = 1;
    for (unsigned int b = 0; b < nodes.size(); ++b)
      if (b != a)
        value *= (x - nodes[b]) / (nodes[a] - nodes[b]);
    return value;
  }
} // namespace samara
