#ifndef samara_solvers_anderson_h
#define samara_solvers_anderson_h

#include <samara/base/dense.h>

#include <Eigen/Dense>

#include <deque>

namespace samara
{
  /**
   * Anderson acceleration of a fixed-point iteration x = g(x): the next x is the combination of the last few g(x) whose
   * residuals g(x) − x combine to the smallest one (Walker & Ni 2011). Converges also where plain iteration does not, if
   * few directions are to blame.
   */
  class Anderson
  {
  public:
    explicit Anderson(const unsigned int depth = 6)
      : depth(depth)
    {}

    Eigen::VectorXd
    next(const Eigen::VectorXd &x, const Eigen::VectorXd &g)
    {
      images.push_back(g);
      residuals.push_back(g - x);
      if (images.size() > depth + 1)
        {
          images.pop_front();
          residuals.pop_front();
        }
      const unsigned int m = images.size() - 1;
      if (m == 0)
        return g;
      Eigen::MatrixXd dF(x.size(), m), dG(x.size(), m);
      for (unsigned int k = 0; k < m; ++k)
        {
          dF.col(k) = residuals[k + 1] - residuals[k];
          dG.col(k) = images[k + 1] - images[k];
        }
      return g - dG * PivotedQr(dF).solve(residuals.back());
    }

  private:
    unsigned int                depth;
    std::deque<Eigen::VectorXd> images, residuals;
  };
} // namespace samara

#endif
