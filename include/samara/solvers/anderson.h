#ifndef samara_solvers_anderson_h
#define samara_solvers_anderson_h

#include <Eigen/Dense>

#include <vector>

namespace samara
{
  /**
   * Anderson's acceleration of a fixed-point iteration x → g(x) (Walker & Ni, SIAM J. Numer. Anal. 49 (2011)
   * 1715–1735). With the corrections f = g(x) − x the next x is
   *
   *     g_n − Σ γ_j (g_{j+1} − g_j),     |f_n − Σ γ_j (f_{j+1} − f_j)| smallest
   *
   * over the last iterations. It converges also where plain iteration does not, if few directions are to blame. In
   * steps that turn far these are such as the spin of a light screw about its axis.
   */
  class Anderson
  {
  public:
    /** Corrections that are remembered: in steps 5 and 8 need as many iterations as 6. */
    static constexpr unsigned int depth = 6;

    /** Forget the iterations so far. */
    void begin();

    /** Numbers that are iterated. */
    struct Part
    {
      double      *values;
      unsigned int size;
      bool         counts; ///< in the norm; what does not follows from what does
    };

    /** What is about to be corrected. */
    void keep(const std::vector<Part> &parts);

    /**
     * Replace what is corrected by the combination, if there is one. The norm takes @p weights of the numbers that
     * count, one for each in their order.
     */
    void accelerate(const std::vector<Part> &parts, const std::vector<double> &weights);

    /** The next x where all numbers count alike; @p g: g(x). */
    Eigen::VectorXd next(Eigen::VectorXd x, Eigen::VectorXd g);

  private:
    using Factors = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, depth, 1>;
    using Gram    = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, depth, depth>;

    unsigned int        n_differences = 0, oldest = 0;
    Eigen::MatrixXd     images, corrections; ///< columns g_{j+1} − g_j, and f_{j+1} − f_j of what counts, weighted
    Gram                products = Gram::Zero(depth, depth); ///< of the differences of corrections with one another
    Eigen::VectorXd     image, correction, last_image, last_correction;
    std::vector<double> before, ones;

    void           add_difference();
    Factors        combination() const;
    static Factors solve(Gram A, Factors b);
  };
} // namespace samara

#endif
