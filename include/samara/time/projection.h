#ifndef samara_time_projection_h
#define samara_time_projection_h

#include <samara/model/system.h>
#include <samara/solvers/linear.h>

namespace samara
{
  /**
   * What is reported of a state of motion. The integrator's own velocities violate the velocity constraints by O(h^s)
   * and its stage multipliers are of first order; these have the order of the positions. They are never fed back.
   */
  class Projection
  {
  public:
    explicit Projection(const System &system);

    /**
     * Replace the velocities by the nearest ones, in the norm of the kinetic energy, with G y + ∂g/∂t = 0, and
     * algebraic states by those that belong to them. Returns the largest change of velocities relative to the largest,
     * before or after.
     * @throws SingularMatrix if something without mass can move freely.
     * @throws NotConverged if there are no such states.
     */
    double velocities(State &state);

    /**
     * Make the increment @p dy of the twists of @p state one that its constraints allow, the nearest in the norm of the
     * kinetic energy, and find the twists @p driven that prescribed motions enforce on the model, nearest to rest.
     * @throws SingularMatrix as above.
     */
    void increments(const State &state, std::vector<double> &dy, std::vector<double> &driven);

    /**
     * Multipliers and accelerations ẏ (nodal twists, rates of coordinates) from M ẏ + f + Gᵀλ = 0 with G ẏ + Ġ y = 0 at
     * the velocities of the state, which must obey the constraints.
     */
    std::vector<double> accelerations(State &state);

    /**
     * A state as it is reported: velocities projected, multipliers and accelerations as above. Its stresses have to be
     * those of its configuration, as integrators leave them; those of dampers follow the velocities. Without
     * @p with_forces only velocities and these stresses are found, and accelerations are not known.
     * @throws SingularMatrix if something without mass can move freely.
     */
    void report(State &state, bool with_forces = true);

  private:
    const System                 &system;
    std::unique_ptr<SparseMatrix> K;     ///< if there are unknowns; their columns alone are kept up
    std::vector<unsigned int>     bound; ///< nodes that constraints act on, or without an inverse of the mass
    struct FreeNode
    {
      unsigned int node;
      Matrix6      inverse; ///< of its mass
    };
    std::vector<FreeNode> free;     ///< all others: they are not in the matrix
    std::vector<int>      unknowns; ///< those of the saddle-point matrix
    struct Entry
    {
      int    at; ///< among the entries of K
      bool   is_mass;
      double mass;
    };
    std::vector<Entry>            entries; ///< of the saddle-point matrix
    std::unique_ptr<SparseMatrix> saddle;
    std::unique_ptr<LinearSolver> solver;

    const std::vector<unsigned int> released; ///< multipliers of angles that statics alone hold
    const std::vector<unsigned int> acting;   ///< multipliers on which forces depend

    std::vector<unsigned int> left_out_of_solver;
    std::vector<unsigned int> left_out; ///< in the present matrix: those of the state, at singular positions more
    bool                      is_massless = false; ///< something without mass moves freely, and no choice of rows helps
    std::vector<double> no_multipliers, moved_q, moved_coordinates, moved_states, moved_state_rates, rates, b, small_b;
    std::vector<double> r, loads; ///< what is left without accelerations: of all, or of all but loads where those act
    std::vector<double> rates_of_rows; ///< g̈ of the present state where nothing accelerates
    bool                rates_are_known = false;

    void   make_solver_without();
    void   factorize(const State &state, double least_condition = 0);
    void   factorize_rows(const State &state);
    void   sort_nodes();
    double project(State &state);
    /** The saddle-point matrix's solution for b: in the place of b. Without forces only what is bound moves. */
    void solve(bool with_forces = true);

    /** @name Accelerations, in b, and multipliers @{ */
    void solve_for_accelerations(State &state);
    /**
     * Residual without accelerations and reactions, once for all passes over loads that depend on reactions: with
     * all loads if none does, else without any.
     */
    void find_forces_but_loads(State &state);
    /** Where loads see these multipliers that act as known. */
    void find_accelerations(const Eigen::VectorXd &known, State &state);
    /** Second rates are exact, but for what laws of states prescribe. */
    void find_rates_of_rows(const State &state);
    /**
     * What laws of states prescribe changes its rate: by differences of fourth order over a time in which nothing turns
     * by more than a thousandth; with it, what changes with time alone, however fast that is.
     */
    void add_second_rates_of_laws(const State &state);
    /** @} */

    /** Where no state that laws of constraints name changes within dt, rates of states are not found any more. */
    void          forget_states_that_stay(const State &state, double dt);
    Point<double> later_at(const State &state, double by);
    /** All after @p dt straight along its velocities, with the rates that states have there. */
    Point<double> moved_by(const State &state, double dt);
    void          constraint_rates(const Point<double> &point, std::vector<double> &rates) const;
  };
} // namespace samara

#endif
