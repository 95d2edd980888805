#ifndef samara_model_layout_h
#define samara_model_layout_h

#include <samara/base/contact_law.h>
#include <samara/base/friction_law.h>
#include <samara/model/model.h>
#include <samara/model/terms.h>

namespace samara
{
  class ContactGroup;

  /**
   * The numbering of all unknowns: 6 twists of each node but the ground, joint coordinates, states of first order,
   * multipliers; the six of the ground follow behind the last unknown, where residuals collect the total reaction of
   * the ground.
   */
  class Layout
  {
  public:
    Layout(Model &model);

    const Model &model;

    unsigned int n_nodes = 0, n_coordinates = 0, n_states = 0, n_multipliers = 0, n_strains = 0;

    unsigned int
    n_unknowns() const
    {
      return of_multiplier(n_multipliers);
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
    of_state(const unsigned int i) const
    {
      return 6 * (n_nodes - 1) + n_coordinates + i;
    }
    int
    of_multiplier(const unsigned int i) const
    {
      return 6 * (n_nodes - 1) + n_coordinates + n_states + i;
    }
    /** Of what moves: twists and joint coordinates. */
    int
    n_kinematic() const
    {
      return of_state(0);
    }

    /** Whether an unknown of what moves is a displacement [m], not a rotation. */
    bool
    is_length(const int unknown) const
    {
      return unknown < of_coordinate(0) ? unknown % 6 < 3 : model.coordinate_units[unknown - of_coordinate(0)] == "m";
    }

    /** In what an unknown is measured: "m", "rad", the unit of a state. Multipliers have that of what they hold: "". */
    std::string unit_of(int unknown) const;

    /**
     * The size of an unknown that matters, in its unit: @p length [m] of displacements, 1 of rotations, the scale of a
     * state. Not of multipliers: row_scale() says what theirs are.
     */
    double
    scale_of(const int unknown, const double length) const
    {
      return unknown < of_state(0) ? (is_length(unknown) ? length : 1.) : model.states[unknown - of_state(0)].scale;
    }

    /** @name For Item::connect() @{ */
    /** Take a term of an item. */
    void add(const Item &item, Deformation &term);
    void add(const Item &item, Constraint &term);
    void add(const Item &item, Force &term);
    void add(const Item &item, StateEquation &term);

    /**
     * Numbers for as many multipliers as there are parts, "axis 2", "" if the item has one row; returns the first. The
     * owner is the item of the file, also of rows that an attachment of it adds.
     */
    unsigned int add_multipliers(const Item &owner, const std::vector<std::string> &parts);

    /** Declare that these unknowns are coupled; the block is filled when the layout is complete. */
    void couple(Block                           &block,
                const std::vector<Frame>        &resolved_frames,
                const std::vector<unsigned int> &coordinates = {},
                const std::vector<unsigned int> &multipliers = {},
                const std::vector<unsigned int> &states      = {});

    /** Do something, such as couple(), when all multipliers have numbers. */
    void when_numbered(const std::function<void()> &action);
    /** @} */

    /** Whose row it is: for messages, and for whoever asks what belongs together. Names of items may be anything. */
    struct Row
    {
      const Item *owner; ///< the item of the file; never null
      std::string part;  ///< "axis 2", "prescribed rotation"; empty if the item has one row
    };
    std::vector<Row> rows_of_multipliers;

    const Item &
    owner_of_multiplier(const unsigned int i) const
    {
      return *rows_of_multipliers[i].owner;
    }

    /** "joint hinge, axis 2": for people alone. */
    std::string name_of_multiplier(unsigned int i) const;

    /** Multipliers that laws depend on: forces and moments of joints. */
    std::vector<unsigned int> multipliers_in_laws;

    /**
     * A constraint that is not quadratic: its force gets a correction along the rate of a coordinate, so that it does
     * no work over a step (doc/theory/integrators.md).
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
     * it is touched, a force by its law against growing g, never pulling.
     */
    struct Stop
    {
      unsigned int coordinate;
      double       place, side; ///< [m] or [rad]; side 1 for an upper stop, -1 for a lower one
      ContactLaw   law;
      bool         is_load; ///< its energy is a potential of the loads, not strain energy
      std::string  name;    ///< for messages: "joint hinge, upper stop of the rotation"
    };
    std::vector<Stop> stops;

    /**
     * Dry friction against the rates of one to three joint coordinates, which together are a slip: w = arm times the
     * rates. The normal force is that of a stop or the size of the reactions of some multipliers, and a preload.
     * Where the law has bristles, their deflections [m] along the coordinates are states of first order. In steps they
     * follow from the slips; the integrator sets them.
     */
    struct Friction
    {
      std::vector<unsigned int> coordinates;
      std::vector<unsigned int> states;  ///< of the bristles, one a coordinate; empty: there are none
      double                    arm = 1; ///< radius of what turns [m]; 1 for displacements
      FrictionLaw               law;
      int                       stop = -1; ///< number in stops; -1: none
      std::vector<unsigned int> multipliers;
      double                    preload = 0; ///< [N], not negative
      std::string               name;        ///< for messages: "joint hinge, friction of the rotation"
      const Item               *owner = nullptr; ///< whose it is; set when it is added
    };
    std::vector<Friction> frictions;

    /** A nonlinear spring of a joint coordinate, whose energy steps keep exactly. Its force is among the forces. */
    struct NonlinearSpring
    {
      unsigned int     coordinate;
      double           offset; ///< what the law depends on is the coordinate and this
      const SpringLaw *law;
    };
    std::vector<NonlinearSpring> nonlinear_springs;

    /** Groups of bodies any of which may touch: forces between pairs that are searched for (contact_group.h). */
    std::vector<const ContactGroup *> contact_groups;

    /**
     * Multipliers of constraints on velocities alone, b(q) y = 0 (rolling): only constraint_rates() says what they are.
     * Their rows of the residual are zero, those of the tangent hold b: in statics increments obey them.
     */
    std::vector<unsigned int> nonholonomic;

    /** The items that have constraints. */
    std::vector<const Item *> joints;

    /** Whose strain it is. */
    const Item &item_of_strain(unsigned int strain) const;

    /** What an unknown is, for messages: "shaft 1, node 3 at (2, 0, 0): rotation about d1". */
    std::string name_of(unsigned int unknown) const;

    std::shared_ptr<const Pattern> pattern;

  private:
    friend class System; // that alone goes over terms
    std::vector<const Deformation *>   deformations;
    std::vector<const Constraint *>    constraints;
    std::vector<const Force *>         forces;
    std::vector<const StateEquation *> state_equations;

    struct Coupling
    {
      Block                    *block;
      std::vector<Frame>        frames;
      std::vector<unsigned int> coordinates, states, multipliers;
    };
    std::vector<Coupling>              couplings;
    std::vector<std::function<void()>> actions; ///< for when all multipliers have numbers

    void number_rows(const Coupling &coupling) const;
    void make_pattern();
    void find_positions(Block &block) const;
  };
} // namespace samara

#endif
