#ifndef samara_model_state_h
#define samara_model_state_h

#include <samara/rotation/rotation.h>

#include <vector>

namespace samara
{
  /** What friction has bent where a pair of a group touches: it comes with the touch, and goes with it (ContactGroup).
   */
  struct PairBristle
  {
    unsigned int group, bead, other; ///< numbers of the group, and of both sides in it
    unsigned int kind;               ///< of the sides, ContactGroup::kind_of()
    double       at_b, at_a;         ///< abscissae where lines touch [m]; 0 of others
    Vector3      deflection;         ///< of B against A, in the tangent plane, inertial components [m]
  };
  using PairBristles = std::vector<PairBristle>;



  /**
   * Where the system is evaluated: plain pointers, so that terms can be evaluated with any number type (double
   * in computations, std::complex<double> to check tangents). What an analysis does not have is a vector of zeros.
   */
  template <typename Number>
  struct Point
  {
    const Number *q           = nullptr; ///< 12 a node: x [m], d₁ d₂ d₃
    const Number *coordinates = nullptr; ///< joint coordinates [m] or [rad]
    const Number *y           = nullptr; ///< 6 a node: twist in the node's own frame [m/s, rad/s]
    const Number *rates       = nullptr; ///< of the joint coordinates
    const Number *states      = nullptr; ///< of first order
    const Number *state_rates = nullptr; ///< ż, where rates of constraints are asked for
    const Number *multipliers = nullptr; ///< [N] or [N m]
    const Number *stress      = nullptr; ///< section forces and the like, one a strain
    double        time        = 0;       ///< [s], of functions of time
    double        factor      = 1;       ///< of all loads and prescribed motions; the load steps of statics
    bool          held        = true;    ///< steady rotations hold their joints (statics), or leave them free
    bool          stops       = true;    ///< touched by the sign of their gap here; or left to who integrates in time
    bool          material = true; ///< whether tangent() and damping() hold what strain_rows() says: BᵀCB, BᵀC_dB

    const PairBristles *bristles = nullptr; ///< of groups of contacts, where they are known

    /**
     * 12 a node like q: the reciprocal directors D⁻ᵀ where triads are not orthonormal, as in stages of steps that turn;
     * what is x in q has no meaning. Null: directors are their own reciprocals.
     */
    const Number *reciprocal = nullptr;

    /** 12 a node like q, where these are: the rotations nearest to the triads, in which air is seen. Null: not known.
     */
    const Number *nearest = nullptr;

    /** In whose triads forces take their components that are linear in the directors (doc/theory/steady_rotation.md).
     */
    const Number *
    q_of_forces() const
    {
      return reciprocal != nullptr ? reciprocal : q;
    }
  };



  /** The point of what has the vectors of a state, see State and the stages of integrators. */
  template <typename Values>
  Point<double>
  point_of(const Values &v, const double time, const double factor, const bool held, const bool stops)
  {
    return {v.q.data(),
            v.coordinates.data(),
            v.y.data(),
            v.rates.data(),
            v.states.data(),
            v.state_rates.data(),
            v.multipliers.data(),
            v.stress.data(),
            time,
            factor,
            held,
            stops};
  }



  /** Everything that changes while a model moves. Sizes are fixed by the System. */
  struct State
  {
    std::vector<double> q, coordinates, y, rates, states, state_rates, multipliers, stress;

    /**
     * Steady rigid motion of each node, in the inertial frame: spin ω [rad/s] and velocity v [m/s] at the place x₀;
     * the nodal twist at x is y = (Dᵀ(v + ω×(x − x₀)), Dᵀω). All zero for a model at rest.
     */
    struct Motion
    {
      Vector3 spin = Vector3::Zero(), velocity = Vector3::Zero(), at = Vector3::Zero();
    };
    std::vector<Motion> motion;

    double time = 0, factor = 1;
    bool   held  = true;
    bool   stops = true; ///< see Point::stops

    /** ẏ, 6 a node, of the joint coordinates, and the rates of states; empty where they are not known. */
    std::vector<double> accelerations;

    /** Multipliers of rows that repeat what others say: kept at zero until others are chosen (RedundantRows). */
    std::vector<unsigned int> left_out;

    PairBristles bristles; ///< of the pairs of groups that touch; those that are not here are straight

    Vector3
    position(const unsigned int node) const
    {
      return Eigen::Map<const Vector3>(&q[12 * node]);
    }

    Matrix3
    triad(const unsigned int node) const
    {
      return Eigen::Map<const Matrix3>(&q[12 * node + 3]);
    }

    Point<double>
    point() const
    {
      Point<double> point = point_of(*this, time, factor, held, stops);
      point.bristles      = &bristles;
      return point;
    }
  };
} // namespace samara

#endif
