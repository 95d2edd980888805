#ifndef samara_analysis_repeated_parts_h
#define samara_analysis_repeated_parts_h

#include <samara/model/system.h>

#include <string>
#include <vector>

namespace samara
{
  /** "blade 1, blade 2; lag 1, lag 2": groups of names between semicolons, as a <Symmetry> is written. */
  std::vector<std::vector<std::string>> groups_of_names(const std::string &text);



  /**
   * A model of which something is there Q times and comes round: after a part of the period, T/Q, each of the repeated
   * parts is where the next one was and moves as that did. The renumbering P takes the state there to that at the start
   * (design: the fast map): what belongs to part k becomes that of part k + 1, of the last one that of the first. All
   * else stays, and of what turns without being repeated the axes turn back.
   *
   * The numbers of a node are along its own axes, so that P turns them by what its axes at the end differ from those of
   * the node it becomes at the start: nothing for parts that carry their axes along, 2π/Q for a hub, and for parts
   * whose axes were all alike when the model was built, −2π/Q.
   */
  class RepeatedParts
  {
  public:
    /** Nothing is repeated. */
    explicit RepeatedParts(const System &system);

    /**
     * @p groups: names of what is repeated, "blade 1", "blade 2", …; "lag 1", "lag 2", …, each in the order in which
     * they come to the same place, part k where k + 1 was. Nodes, joint coordinates and states belong to the part whose
     * name theirs contains. @p turning: names of objects that turn with them and are not repeated; of subsystems, or a
     * word of names, where no object is called so.
     * @throws std::invalid_argument saying which name has no counterpart, or belongs to nothing
     */
    RepeatedParts(const System                                &system,
                  const std::vector<std::vector<std::string>> &groups,
                  const std::vector<std::string>              &turning);

    /** Q */
    unsigned int
    n() const
    {
      return n_parts;
    }

    /** The node that a node becomes; itself if it is not repeated. */
    unsigned int
    next_of_node(const unsigned int node) const
    {
      return node_becomes[node];
    }

    /** The same of joint coordinates and of states of first order. @{ */
    unsigned int
    next_of_coordinate(const unsigned int i) const
    {
      return coordinate_becomes[i];
    }
    unsigned int
    next_of_state(const unsigned int i) const
    {
      return state_becomes[i];
    }
    /** @} */

    /** Whether a node turns with the repeated parts and is none of them. */
    bool
    only_turns(const unsigned int node) const
    {
      return node_turns[node] && node_becomes[node] == node;
    }

    /** Axes are taken from these states, a Q-th of a period from each other. */
    void align(const State &start, const State &end);

    /**
     * Axes are those of the model as it was built, turned by a Q-th of a turn: by the rotation that takes each part to
     * the place of the next one. So they do not depend on a motion that is not yet periodic. @p moving tells about
     * which axis and in which sense things turn.
     * @throws std::invalid_argument saying what is not where the next part is, or that the order is another
     */
    void align_as_built(const State &moving);

    /**
     * P of a state, or P⁻¹: what belongs to a part belongs to the next one, what turns is turned back. Time stays, and
     * so do multipliers, which have no parts here: a place to begin for who solves for them. To be called after
     * align_as_built().
     */
    State renumbered(const State &state, bool forward = true) const;

    /** Whether a joint coordinate is one that turns and is not repeated. */
    bool
    coordinate_only_turns(const unsigned int i) const
    {
      return coordinate_turns[i] && coordinate_becomes[i] == i;
    }

    /** P x and P⁻¹ x, for increments as those of StepTangent. @{ */
    void apply(double *x) const;
    void apply_inverse(double *x) const;
    /** @} */

    /**
     * What lacks to start = P(end), as an increment; whole turns of angles do not count, of what is repeated or turning
     * neither do their Q-th parts. To be called after align().
     */
    std::vector<double> gap(const State &start, const State &end) const;

  private:
    /** P x, or P⁻¹ x. */
    void exchange(double *x, bool forward) const;

    /** What is named among what turns: nodes, and rotations of joints. @throws std::invalid_argument if nothing is */
    void find_turning(const std::string &part);

    /** Mean of the angular velocities of the repeated nodes, in inertial axes of the model as built [rad/s]. */
    Vector3 spin_of_parts(const State &moving) const;

    /** The rotation that takes each part to the next one where the model was built, and whether it does. @{ */
    Matrix3 turn_as_built(const State &moving) const;
    void    require_places(const Matrix3 &turn) const;
    /** @} */

    const System             &system;
    unsigned int              n_parts = 1;
    std::vector<unsigned int> node_becomes, coordinate_becomes, state_becomes;
    std::vector<bool>         node_turns, coordinate_turns; ///< by a Q-th of a turn
    std::vector<double>       turns_by; ///< a coordinate in a Q-th of the period; 0 of what does not turn
    std::vector<Matrix3>      axes;     ///< of each node at the end, as seen from those of what it becomes at the start
  };
} // namespace samara

#endif
