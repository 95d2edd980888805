#ifndef samara_analysis_moving_axes_h
#define samara_analysis_moving_axes_h

#include <samara/analysis/linearization.h>
#include <samara/solvers/eigen.h>

#include <string>
#include <vector>

namespace samara
{
  /**
   * The axes in which the small motions of a steady motion have constant coefficients, found by looking.
   *
   * Where parts turn against each other, coefficients are constant in few axes, or in none. For each piece of the
   * model, parts that act on each other otherwise than by the ground, three kinds are looked at, in this order: axes
   * that turn with each node; fixed ones; axes in which the whole piece is seen from one of its turning parts, or from
   * the ground where this turns. In each, the response to the same forces is found at the state and at later moments of
   * its motion. Axes are proven if no response changes by more than 1e-6. Where none are, those are taken in which it
   * changes least.
   *
   * A model that turns as a whole, with the ground, needs no proof. If the ground stands still, the matrices themselves
   * are compared first: what turns in stiff bearings has the same ones at all moments.
   */
  class MovingAxes
  {
  public:
    /**
     * @param state with multipliers that balance it
     * @param motion about this state, each node in its own axes
     * @param which "automatic", "turning" or "fixed": the latter two are taken whether proven or not
     * @throws SingularMatrix
     */
    MovingAxes(const System &system, const State &state, const Linearization &motion, const std::string &which);

    /** Of the axes of each node, in the inertial frame [rad/s]; empty: each turns with its node. */
    const std::vector<Vector3> &
    spins() const
    {
      return chosen;
    }

    /** Whether there was something to prove. */
    bool
    are_looked_at() const
    {
      return !moments.empty();
    }

    /** In words which axes these are. */
    std::string text() const;

    /** In words what changes in which axes, and by how much of the response to forces. */
    std::string text_of_change() const;

    /**
     * For each mode about the state, in these axes: how far λ is off, |δλ|/|λ|, in the equations of later moments. Free
     * motions are not looked at.
     */
    std::vector<double> changes(const std::vector<Mode> &modes) const;

  private:
    const System &system;

    struct Moment
    {
      double time;
      State  state;
    };
    std::vector<Moment> moments; ///< the state itself, and later ones

    struct Kind
    {
      std::string          name;
      std::vector<Vector3> spins;
    };
    struct Piece
    {
      std::string               name; ///< of its fastest part
      std::vector<unsigned int> nodes;
      std::vector<double> change; ///< of the response, by kinds [1]; infinite if axes would turn across a node's spin
      unsigned int        kind = 0;

      bool
      is_proven() const
      {
        return change[kind] <= 1e-6;
      }
    };
    std::vector<Kind>    kinds;
    std::vector<Piece>   pieces; ///< those in which something turns
    std::vector<Vector3> chosen;
    double               shift = 0; ///< below the frequencies [1/s]

    bool need_no_proof(const State &state, const Linearization &motion, const std::string &which) const;
    void add_moments(const State &state);
    void add_kinds(const std::string &which);
    void add_pieces();
    void look_at(unsigned int kind);
    void choose();

    Matrix3                      turn(const Moment &moment, unsigned int node, const std::vector<Vector3> &spins) const;
    std::vector<Eigen::VectorXd> responses(const Moment &moment, const std::vector<Vector3> &spins) const;
  };
} // namespace samara

#endif
