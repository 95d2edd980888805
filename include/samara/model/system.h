#ifndef samara_model_system_h
#define samara_model_system_h

#include <samara/model/layout.h>
#include <samara/model/relative_motion.h>
#include <samara/model/strain_rows.h>

namespace samara
{
  /**
   * The assembled model, all that analyses see of it. No function here knows an element or a joint, and nobody else
   * goes over the terms of the equations.
   */
  class System
  {
  public:
    explicit System(Model &model);

    const Model &model;
    const Layout layout;

    unsigned int
    size() const
    {
      return layout.n_unknowns();
    }

    /** Deformations that count: all, or those between pieces that move as rigid bodies if nothing is strained. */
    enum class Part
    {
      all,
      between_pieces
    };

    /** The reference configuration, at rest and free of stress. */
    State reference() const;

    /** e(q) of all deformations. */
    void strains(const State &state, std::vector<double> &e) const;

    /** σ = C e(q) + C_d B y for the state's own configuration and velocities, without changing the state. */
    void stresses(const State &state, std::vector<double> &stress) const;
    /** The same with the strains of the state, where they are known. */
    void stresses(const State &state, const std::vector<double> &e, std::vector<double> &stress) const;

    /**
     * @name Terms of the equations at a point, see terms.h
     * Arrays are global: n_strains strains, rates of strains and stresses; n_multipliers rates of constraints; size() +
     * 6 rows of a residual, to which the terms are added. Inertia is not in them, and what the state leaves out is.
     * @{
     */
    template <typename Number>
    void strains(const Point<Number> &point, Number *e) const;
    void strain_rates(const Point<double> &point, double *rates) const;
    /** σ = C e + C_d ė */
    template <typename Number>
    void stresses(const Number *e, const Number *rates, Number *stress) const;

    /** All of them: Bᵀσ + Gᵀλ − f, g. */
    template <typename Number>
    void add_terms(const Point<Number> &point, Number *r) const;
    /** Its two parts: Bᵀσ + Gᵀλ and g, what holds bodies together; and −f of loads, with −g of states. @{ */
    template <typename Number>
    void add_bonds(const Point<Number> &point, Number *r) const;
    template <typename Number>
    void add_loads_and_states(const Point<Number> &point, Number *r) const;
    /** @} */
    /** add_bonds() without the gaps, and the rates of strains and constraints. */
    void
    add_bonds_and_rates(const Point<double> &point, double *r, double *strain_rates, double *constraint_rates) const;
    /** −f of the loads, or only of those without potential. */
    void add_loads(const Point<double> &point, double *r, bool with_potential = true) const;
    /** −f of load @p i of n_loads(). */
    void add_load(unsigned int i, const Point<double> &point, double *r) const;
    /** Gᵀλ and g. */
    void add_constraints(const Point<double> &point, double *r) const;
    /** g alone; rows of nodes and coordinates are not to be used. */
    void add_gaps(const Point<double> &point, double *r) const;
    /** ġ = G y + ∂g/∂t, and ∂g/∂t alone. */
    void constraint_rates(const Point<double> &point, double *rates) const;
    void constraint_time_rates(const Point<double> &point, double *rates) const;
    /** g̈ where no velocity changes, see Constraint::second_rates(). */
    void constraint_second_rates(const Point<double> &point, double *rates) const;

    /** ż = g(q, y, z, t) of all states of first order; those of a state into it. */
    void state_rates(const Point<double> &point, double *rates) const;
    void find_state_rates(State &state) const;

    /** Tangent, damping matrix of all terms, added; of constraints alone. */
    void add_tangent(const Point<double> &point, SparseMatrix &K, Part part = Part::all) const;
    void add_damping(const Point<double> &point, SparseMatrix &C) const;
    /** Of ż in the equations of states: ones on their diagonal. */
    void add_state_damping(SparseMatrix &C) const;
    void add_constraint_tangent(const Point<double> &point, SparseMatrix &K) const;

    /** ½ eᵀ C e [J] */
    double strain_energy(const double *e, Part part = Part::all) const;
    /** Subtract σᵀ ė of each deformation from the power [W] of the set of its strains. */
    void subtract_powers(const double                    *stress,
                         const double                    *rates,
                         const std::vector<unsigned int> &set_of_strain,
                         double                          *powers) const;
    /** Of each strain an unknown on which its deformation acts; that of the ground if there is no other. */
    std::vector<unsigned int> rows_of_strains(const State &state) const;
    /** Σ |σᵀ ė| over all deformations [W]. */
    double sum_of_powers(const double *stress, const double *rates) const;
    /** Power of the viscous stresses at these rates of strains [W]. */
    double viscous_power(const double *rates) const;
    /** Whose strains change at rates above @p bound [1/s] with some energy; null if there is none. */
    const Item *strained(const Point<double> &point, double bound) const;
    /** Of the loads that have one [J]. */
    double potential_energy(const Point<double> &point) const;

    bool
    is_viscous() const
    {
      return has_viscous;
    }
    unsigned int
    n_loads() const
    {
      return layout.forces.size();
    }
    const Item &
    item_of_load(const unsigned int i) const
    {
      return *layout.forces[i]->item;
    }

    /** The first time in (from, to) where something prescribed has a corner or a jump; infinity if there is none. */
    double next_corner(double from, double to) const;

    /** See Term::pieces(); empty if nothing switches. */
    void pieces(const Point<double> &point, std::vector<double> &result) const;

    /** B of all deformations, to be used many times. */
    std::unique_ptr<LinearStrains> linear_strains() const;
    /** @} */

    /** What is known of relative motions, of all items that say something, at the nodal coordinates @p q. */
    std::vector<RelativeRate> relative_rates(const double *q) const;
    /** Groups of nodes that each move as one rigid body if nothing is to be strained. */
    std::vector<std::vector<unsigned int>> rigid_nodes() const;

    /** The velocities that the user gives nodes at the start are added to the state's. */
    void add_initial_velocities(State &state) const;

    /** A picture of the model, or what of it differs from one to the next. */
    Drawing draw(const State &state, Drawing::Content content = Drawing::Content::everything) const;

    /**
     * Forces and constraints, r = Bᵀσ + Gᵀλ − loads − ad*_y(M y), g, with the stress given; the last six entries are
     * the force and moment on the ground, seen at the origin. Size size() + 6.
     */
    void residual(const State &state, const std::vector<double> &stress, std::vector<double> &r) const;

    /**
     * Its derivative with δσ = C B ζ, at the stress the state has (mixed Newton: not that of its configuration);
     * without material: at fixed stress, what strain_rows() holds is left out.
     */
    void tangent(const State &state, SparseMatrix &K, bool with_material = true) const;

    /** Derivative of the residual with respect to velocities; K and C refer to ζ̇ in axes turning with each node. */
    void damping(const State &state, SparseMatrix &C, bool with_material = true) const;

    /** B, C and C_d of all strains at the state. */
    StrainRows strain_rows(const State &state, Part part = Part::all) const;
    StrainRows strain_rows(const Point<double> &point, Part part = Part::all) const;
    void       mass(SparseMatrix &M) const;

    /**
     * Add the increments @p z (nodal twists, joint coordinates, multipliers) to the state; its stress becomes
     * C (e + B z), the stress of the linearised motion. Angles of joints become those of the nodes in the turn to which
     * 2 atan(z/2) leads, by which the increments turn the nodes: so they count turns, and never lose one.
     */
    void update(State &state, const std::vector<double> &z) const;

    /** Give every node the twist of its steady motion at its present place. */
    void update_twists(State &state) const;

    /** What reference() leaves out: constraints that others repeat, see find_redundant(). */
    void drop(const std::vector<unsigned int> &multipliers);

    /** Rows and columns of multipliers that are left out in a matrix of constraints: those of the identity. */
    void fix_left_out(const std::vector<unsigned int> &left_out, SparseMatrix &K) const;

    /** Multipliers that only held the angles of steady rotations for statics: motion is free of them. */
    std::vector<unsigned int> released_multipliers() const;

    const std::vector<unsigned int> &
    dropped_multipliers() const
    {
      return dropped;
    }

    struct Energy
    {
      double kinetic, strain;
    };
    Energy energy(const State &state) const;
    /** The same with the strains of the state, where they are known. */
    Energy energy(const State &state, const std::vector<double> &e) const;

    /** Total mass [kg], centre of mass [m], inertia about it [kg m²] in a configuration. */
    struct MassProperties
    {
      double  mass;
      Vector3 centre;
      Matrix3 inertia;
    };
    MassProperties mass_properties(const State &state) const;

  private:
    std::vector<unsigned int> dropped;
    bool                      has_viscous = false;

    /** All deformations, those that are faster together as one: for what is computed in every iteration. */
    std::vector<const Deformation *>                deformations;
    std::vector<std::shared_ptr<const Deformation>> joined_deformations;

    bool is_in(const Deformation &deformation, Part part) const;
  };
} // namespace samara

#endif
