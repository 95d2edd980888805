#ifndef samara_model_system_h
#define samara_model_system_h

#include <samara/model/model.h>

namespace samara
{
  /**
   * The numbering of all unknowns: 6 twists of each node but the ground, joint coordinates, multipliers; the six of the
   * ground follow behind the last unknown, where residuals collect the total reaction of the ground.
   */
  class Layout
  {
  public:
    Layout(Model &model);

    const Model &model;

    unsigned int n_nodes = 0, n_coordinates = 0, n_multipliers = 0, n_strains = 0;

    unsigned int
    n_unknowns() const
    {
      return 6 * (n_nodes - 1) + n_coordinates + n_multipliers;
    }
    /** First of the six unknowns of a node. */
    int
    of_node(const unsigned int node) const
    {
      return node == 0 ? n_unknowns() : 6 * (node - 1);
    }
    int
    of_coordinate(const unsigned int i) const
    {
      return 6 * (n_nodes - 1) + i;
    }
    int
    of_multiplier(const unsigned int i) const
    {
      return 6 * (n_nodes - 1) + n_coordinates + i;
    }

    /** @name For Contribution::connect() @{ */
    /** Numbers for as many multipliers as there are names; returns the first. */
    unsigned int add_multipliers(const std::vector<std::string> &names);

    /** Declare that these unknowns are coupled; the block is filled when the layout is complete. */
    void couple(Block                           &block,
                const std::vector<Frame>        &resolved_frames,
                const std::vector<unsigned int> &coordinates = {},
                const std::vector<unsigned int> &multipliers = {});
    /** @} */

    std::vector<std::string> multiplier_names;

    /**
     * A constraint that is not quadratic: its force gets a correction along the rate of a coordinate, so that it does no
     * work over a step (doc/theory/integrators.md).
     */
    struct Correction
    {
      unsigned int multiplier, coordinate;
    };
    std::vector<Correction> corrections;

    /** Multipliers of constraints that hold but for whole turns: θ − atan2(s, c) = 0. */
    std::vector<unsigned int> angles;

    /**
     * What presses on a joint coordinate from one side only: with the gap g = side (coordinate − place), positive where
     * it is touched, the force k g⁺ + c ġ against growing g, never pulling.
     */
    struct Stop
    {
      unsigned int coordinate;
      double       place, side;        ///< [m] or [rad]; side 1 for an upper stop, -1 for a lower one
      double       stiffness, damping; ///< k [N/m] or [N m/rad], c [N s/m] or [N m s/rad]
      std::string  name;               ///< for messages: "joint hinge, upper stop of the rotation"
    };
    std::vector<Stop> stops;

    /**
     * Multipliers of constraints on velocities alone, b(q) y = 0 (rolling): only constraint_rates() says what they are.
     * Their rows of the residual are zero, those of the tangent hold b: in statics increments obey them.
     */
    std::vector<unsigned int> nonholonomic;

    /** The contributions that have multipliers. */
    std::vector<const Contribution *> constraining;

    /** What an unknown is, for messages: "shaft 1, node 3 at (2, 0, 0): rotation about d1". */
    std::string name_of(unsigned int unknown) const;

    std::shared_ptr<const Pattern> pattern;

  private:
    struct Coupling
    {
      Block                    *block;
      std::vector<Frame>        frames;
      std::vector<unsigned int> coordinates, multipliers;
    };
    std::vector<Coupling> couplings;

    void number_rows(const Coupling &coupling) const;
    void make_pattern();
    void find_positions(Block &block) const;
  };



  /**
   * The assembled model, all that analyses see of it. No function here knows an element or a joint.
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

    /** The reference configuration, at rest and free of stress. */
    State reference() const;

    /** e(q) of all contributions. */
    void strains(const State &state, std::vector<double> &e) const;

    /** σ = C e(q) + C_d B y for the state's own configuration and velocities, without changing the state. */
    void stresses(const State &state, std::vector<double> &stress) const;
    /** The same with the strains of the state, where they are known. */
    void stresses(const State &state, const std::vector<double> &e, std::vector<double> &stress) const;

    /**
     * Forces and constraints, r = Bᵀσ + Gᵀλ − loads − ad*_y(M y), g, with the stress given; the last six entries are the
     * force and moment on the ground, seen at the origin. Size size() + 6.
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
    StrainRows strain_rows(const State &state) const;
    void mass(SparseMatrix &M) const;

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
  };
} // namespace samara

#endif
