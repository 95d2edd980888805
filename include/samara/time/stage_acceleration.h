#ifndef samara_time_stage_acceleration_h
#define samara_time_stage_acceleration_h

#include <Eigen/Dense>

#include <deque>
#include <vector>

namespace samara
{
  /**
   * Anderson's acceleration of the iteration of a step with frozen factors (Walker & Ni, SIAM J. Numer. Anal. 49 (2011)
   * 1715–1735). Where x are all numbers that are iterated, x → g(x), and f = g(x) − x their corrections, the next x is
   *
   *     g_n − Σ γ_j (g_{j+1} − g_j),     |f_n − Σ γ_j (f_{j+1} − f_j)| smallest
   *
   * over the last iterations. The norm is that of the velocities alone: multipliers and stresses follow from them. What
   * converges slowly in steps that turn far are few directions, such as the spin of a light screw about its axis.
   */
  class StageAcceleration
  {
  public:
    /** Corrections that are remembered: 5 and 8 need as many iterations as 6. */
    static constexpr unsigned int depth = 6;

    /** Forget the iterations so far. */
    void begin();

    /** The numbers that are iterated; the parts of it that are velocities come first in every stage. */
    struct Part
    {
      double      *values;
      unsigned int size;
      bool         counts; ///< in the norm
    };

    /** What is about to be corrected. */
    void keep(const std::vector<Part> &parts);

    /**
     * Replace what is corrected by the combination, if there is one. The norm takes @p weights of the numbers that
     * count, one for each in their order.
     */
    void accelerate(const std::vector<Part> &parts, const std::vector<double> &weights);

  private:
    struct Difference
    {
      std::vector<double> image;      ///< g_{j+1} − g_j
      std::vector<double> correction; ///< f_{j+1} − f_j of what counts, weighted
    };
    std::deque<Difference> differences;
    std::vector<double>    before, last_image, last_correction, image, correction;
    Eigen::MatrixXd        products; ///< of the differences of corrections with one another

    void            add_difference();
    Eigen::VectorXd combination() const;
  };
} // namespace samara

#endif
