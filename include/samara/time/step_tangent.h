#ifndef samara_time_step_tangent_h
#define samara_time_step_tangent_h

#include <samara/time/stage_integrator.h>

namespace samara
{
  /**
   * The exact tangent of a converged step of the integrator family, ∂x_{n+1}/∂x_n, applied to vectors: for Floquet's
   * theory and Lyapunov exponents (doc/theory/integrators.md). Made by StageIntegrator::linearize().
   *
   * An increment of a state is x = (ζ, δc, δz, δy, δċ): twists ζ that move nodes, in their own frames, 6 a node without
   * the ground; joint coordinates; states of first order; changes of the nodal twists, and of the rates of coordinates.
   * Multipliers and stresses are not in it: the next step depends on them only as a place to begin. Time is kept. Rows
   * of constraints hold as in the step: whatever x is, its image obeys the constraints on positions at the end.
   *
   * The equations of the stages are R(X; x) = 0, so that J δX = −R_x x. Products with J and R_x are exact: strains are
   * quadratic, and residuals are evaluated at complex numbers; rates of constraints are differentiated by central
   * differences of sixth order, which are checked. The factors that the integrator has, of whichever configuration,
   * precondition GMRES. No matrix is formed, none is factorised.
   *
   * The integrator must live as long, and its system. It may take other steps meanwhile.
   */
  class StepTangent
  {
  public:
    /** Numbers in an increment of a state. */
    unsigned int
    size() const
    {
      return n_positions + n_velocities;
    }

    /** Where in it the positions (ζ, δc, δz) end and the velocities (δy, δċ) begin. */
    unsigned int
    first_velocity() const
    {
      return n_positions;
    }

    /**
     * Replace the increment at the start of the step by that at its end.
     * @throws NotConverged if the linear equations of the stages cannot be solved to 1e-10 or ten times the tolerance,
     * as where the factors are of other rows left out, or something prescribed is not smooth.
     */
    void apply(double *x);

    /** Relative residual of the linear equations of the stages that is enough; less is round-off. */
    double tolerance = 1e-13;

    unsigned int n_products = 0; ///< with the matrix of the stages, in all applications so far

  private:
    friend class StageIntegrator;
    using Stage  = StageIntegrator::Stage;
    using Vector = std::vector<double>;

    /** @p start: the state at which the integrator's last step began. */
    StepTangent(StageIntegrator &integrator, const State &start, double h);

    StageIntegrator    &integrator;
    const System       &system;
    const Tableau      &tableau;
    const double        h;
    const State         start;
    const unsigned int  n_positions, n_velocities;
    std::vector<Stage>  stages; ///< with the stresses of their configurations
    Vector              end_q, end_coordinates, end_states, mean_rates;
    std::vector<bool>   is_active;
    const bool          turns;    ///< whether forces are seen in reciprocal triads, see StageRotation
    std::vector<Vector> q_rates;  ///< q̇ at the stages, 12 a node
    std::vector<double> inverses; ///< of the matrices of each node's stage triads, (3s)² a node
    Vector              scale;    ///< of the unknowns of the stages, for the norm of GMRES

    /** Derivatives along one direction of all that follows from it. */
    struct Motion
    {
      std::vector<Vector> q, q_rates, coordinates, state_rates, strain_rates, stress, constraint_rates;
      Vector              end_q, end_coordinates, end_states, start_strain, gaps;
    };
    Motion change;

    // work space
    std::vector<std::complex<double>> z_q, z_coordinates, z_y, z_rates, z_states, z_state_rates, z_multipliers,
      z_stress, z_strain, z_strain_2, z_residual, z_reciprocal, z_nearest, z_momenta, z_powers;
    Vector e, momenta, moved_q, moved_coordinates, moved_y, moved_rates, moved_states, moved_state_rates;

    /**
     * R_x x + J X: the change of the residuals of all stages, in the order of the layout; @p x null: zero. If @p
     * checks, constraints that are not smooth along it are refused.
     */
    void residual(const double *x, const double *X, Vector &result, bool checks = false);
    /** M times twists, 6 a node without the ground; 6 a node with it, zero there. */
    void find_momenta(const double *twists, Vector &momenta) const;
    void move_nodes(const double *x, const double *X);
    void move_others(const double *x, const double *X);
    void find_stresses(const double *x, const double *X);
    /** Rates of products of strains from those of the others; returns the changes of their factors, a column a stage.
     */
    Eigen::MatrixXd change_products();
    /** Of ġ of stage @p k, or with stages.size(), of g at the end. */
    void differentiate_constraints(unsigned int k, const double *X, Vector &result, bool checks);
    /** Values of what differentiate_constraints() differentiates, @p step along the direction. */
    void constraints_at(unsigned int k, const double *X, double step, Vector &result);
    void add_terms(unsigned int k, const double *X, double *r);
    /** The same of what StageRotation takes back, from the residual at @p point that holds the bonds alone. */
    void take_work_back(unsigned int k, const double *X, const Point<std::complex<double>> &point);
    void add_inertia(unsigned int k, const double *x, const double *X, double *r) const;
    void add_corrections(const double *X, Vector &result) const;
    /** What keeps the energy of nonlinear springs; their forces are among the terms. */
    void add_springs(const double *x, const double *X, Vector &result) const;
    void solve(const Vector &right, Vector &X);

    Eigen::Map<const Vector6>
    of_node(const double *X, const unsigned int k, const unsigned int node) const
    {
      return Eigen::Map<const Vector6>(X + k * system.size() + system.layout.of_node(node));
    }
  };
} // namespace samara

#endif
