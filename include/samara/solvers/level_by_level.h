#ifndef samara_solvers_level_by_level_h
#define samara_solvers_level_by_level_h

#include <samara/rotation/rotation.h>

namespace samara
{
  /**
   * Least squares in order: each level |A x − b| is made as small as those before it leave it, in the null space of all
   * of them. Unknowns are dense; the null space shrinks from level to level, and so does the work.
   */
  class LevelByLevel
  {
  public:
    /** Nothing is known of @p n unknowns; the solution is zero. */
    explicit LevelByLevel(unsigned int n);

    /**
     * Add the level @p A x = @p b. Rows should be of similar size: what is below @p rank_tolerance of the largest
     * column, and of 1, counts as nothing.
     */
    void add(const Eigen::MatrixXd &A, const Eigen::VectorXd &b);
    /** The level A x = 0. */
    void add(const Eigen::MatrixXd &A);

    /** The solution that is smallest in what no level says anything of. */
    const Eigen::VectorXd &
    solution() const
    {
      return x;
    }

    /** An orthonormal basis of what the levels have left open. */
    const Eigen::MatrixXd &
    open() const
    {
      return N;
    }

    static constexpr double rank_tolerance = 1e-8;

  private:
    Eigen::VectorXd x;
    Eigen::MatrixXd N;
  };
} // namespace samara

#endif
