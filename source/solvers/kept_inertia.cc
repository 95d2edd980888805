#include <samara/solvers/kept_inertia.h>

#include <Eigen/Core>

#include <cmath>
#include <random>

namespace samara
{
  namespace
  {
    /** Iterations before the speed of convergence is judged. */
    constexpr unsigned int before_judging = 3;



    /** y = (A + Aᵀ) x / 2 */
    void
    multiply_symmetric_part(const SparseMatrix &A, const Eigen::VectorXd &x, Eigen::VectorXd &y)
    {
      const Pattern &pattern = *A.pattern;
      y.setZero(x.size());
      for (int j = 0; j < pattern.size(); ++j)
        {
          const double half  = 0.5 * x[j];
          double       along = 0;
          for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
            {
              const int i = pattern.rows[k];
              y[i] += A.values[k] * half;
              along += A.values[k] * x[i];
            }
          y[j] += 0.5 * along;
        }
    }



    /** C S Cᵀ + 2 N */
    class Congruent
    {
    public:
      Congruent(const SymmetricFactors &factors, const SparseMatrix &A)
        : factors(factors)
        , A(A)
      {}

      void
      multiply(const Eigen::VectorXd &p, Eigen::VectorXd &product)
      {
        displacement = p;
        factors.backward_half(displacement.data());
        multiply_symmetric_part(A, displacement, product);
        factors.forward_half(product.data());
        for (int i = 0; i < p.size(); ++i)
          if (factors.is_negative(i))
            product[i] += 2 * p[i];
      }

    private:
      const SymmetricFactors &factors;
      const SparseMatrix     &A;
      Eigen::VectorXd         displacement;
    };
  } // namespace



  KeptInertia
  n_positive_is_kept(const SymmetricFactors &factors,
                     const SparseMatrix     &A,
                     const double            probability,
                     const unsigned int      most_iterations,
                     const unsigned int      seed)
  {
    KeptInertia                      result;
    const int                        n = A.pattern->size();
    std::mt19937_64                  generator(seed);
    std::normal_distribution<double> number;
    Eigen::VectorXd                  r(n);
    for (double &x : r)
      x = number(generator);
    // a coordinate of an even distribution on the unit sphere has a density of at most sqrt(n / 2 pi)
    const double    enough = probability / std::sqrt(2. * n / M_PI);
    const double    whole  = r.squaredNorm();
    Congruent       congruent(factors, A);
    Eigen::VectorXd p = r, product(n);
    for (double square = whole; result.iterations < most_iterations;)
      {
        congruent.multiply(p, product);
        ++result.iterations;
        const double curvature = p.dot(product);
        if (!(curvature > 0) || !std::isfinite(curvature))
          return result;
        r -= square / curvature * product;
        const double next = r.squaredNorm();
        p                 = r + next / square * p;
        square            = next;
        result.residual   = std::sqrt(square / whole);
        if (result.residual <= enough)
          {
            result.is_shown = true;
            return result;
          }
        // at this speed it would take too long
        if (result.iterations >= before_judging &&
            std::pow(result.residual, double(most_iterations) / result.iterations) > enough)
          return result;
      }
    return result;
  }
} // namespace samara
