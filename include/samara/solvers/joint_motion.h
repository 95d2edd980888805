#ifndef samara_solvers_joint_motion_h
#define samara_solvers_joint_motion_h

#include <samara/solvers/level_by_level.h>
#include <samara/solvers/rigid_pieces.h>
#include <samara/solvers/steady_motion.h>

namespace samara
{
  /**
   * Velocities of all unknowns when joints turn at given speeds, see set_steady_motion(), at one configuration.
   *
   * Rigid pieces come first: level by level, dense, to round-off. If they cannot move so without strain, because
   * bearings are out of line or a bent shaft runs in three of them, or if there are too many, all nodes move freely:
   * the levels are then weights far apart in one sparse matrix, and proximal iterations take away what one has done to
   * the other.
   */
  class JointMotion
  {
  public:
    JointMotion(const System &system, const State &state, const std::vector<double> &speeds);

    std::vector<double>       velocities; ///< of all unknowns of the system: twists in the nodes' axes, rates
    std::vector<RelativeRate> rates;      ///< of all relative motions that constraints leave free
    SteadyMotion              findings;

    /** The value of a rate at these velocities [rad/s] or [m/s]. */
    double value_of(const RelativeRate &rate) const;

  private:
    const System       &system;
    State               state;     ///< without stress, loads and velocities
    SparseMatrix        K;         ///< material stiffness and constraints
    std::vector<double> held;      ///< right-hand sides of the constraints, one a multiplier
    std::vector<bool>   is_driven; ///< of the rates
    double              length, speed = 0;

    /** @name With rigid pieces @{ */
    /** Whether they can move so; throws if nothing else could either. */
    bool            move_pieces(const RigidPieces &pieces);
    void            constraints_of_pieces(const RigidPieces &pieces, Eigen::MatrixXd &G, Eigen::VectorXd &c) const;
    Eigen::MatrixXd strains_of_pieces(const RigidPieces &pieces) const;
    Eigen::MatrixXd rates_of_pieces(const RigidPieces &pieces) const;
    void            find_shared(const Eigen::MatrixXd &W, const Eigen::MatrixXd &open);
    /** @} */

    /** @name With all nodes @{ */
    void move_nodes();
    void solve_by_weights(const std::vector<double> &weights);
    /** Diagonal of K, and something small for what nothing holds against anything else. */
    std::vector<double> stiffness_against_others() const;
    /** The velocities that what is held leaves, with a small stiffness of rates and a smaller one of all motion. */
    void iterate_proximally(const SparseMatrix &of_rates, const SparseMatrix &of_all);
    void check_constraints() const;
    /** @} */

    /** @throws InputError naming the constraints where @p residual, relative to the size of the row, is large. */
    [[noreturn]] void contradict(const Eigen::VectorXd &residual) const;

    /** How fast the line of each rate moves, over the speed: its weight. */
    std::vector<double> weights() const;
    double              line_moves(const RelativeRate &rate) const;
    /** Find them anew, none below @p smallest; returns the largest change. */
    double renew_weights(std::vector<double> &weight, double smallest) const;

    void find_strain();
    void find_moving();
  };
} // namespace samara

#endif
