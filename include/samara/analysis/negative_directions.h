#ifndef samara_analysis_negative_directions_h
#define samara_analysis_negative_directions_h

#include <samara/model/system.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace samara
{
  class LinearSolver;

  /**
   * Directions in which the stiffness of an equilibrium is negative: in which forces push what has moved further away
   * (doc/theory/statics.md). The axes turn with the nodes, the forces of a steady rotation belong to the stiffness.
   */
  struct NegativeDirections
  {
    unsigned int    number      = 0;
    bool            is_least    = false; ///< there are more that have not been looked at one by one
    bool            is_odd_only = false; ///< the tangent is not symmetric: their number is odd, not more is known
    Eigen::VectorXd worst; ///< the most negative one, of twists [m, rad] and coordinates; empty if odd_only

    /** How the system turns: a stiffness alone decides only where nothing does. */
    enum class Turning
    {
      none,    ///< what has negative stiffness is unstable
      as_one,  ///< an odd number is unstable; gyroscopic forces may hold an even number
      in_parts ///< the stiffness may change as parts turn: none are looked for
    } turning = Turning::none;

    /** Whether motions must grow, whatever gyroscopic forces do. */
    bool
    are_unstable() const
    {
      return number > 0 && (turning == Turning::none || (number % 2 == 1 && !is_least));
    }

    /** "the equilibrium is unstable: its stiffness is negative in 2 directions; in the ..." */
    std::string text(const System &system) const;
  };

  /**
   * Those of the symmetric tangent among motions that obey the constraints: the negative eigenvalues of the saddle
   * matrix less the number of multipliers. Free motions are none of them: each direction is confirmed by its own
   * energy, far above round-off, from strains and geometric stiffness. If the tangent is not symmetric, as with loads
   * that follow, the sign of its determinant is looked at. None are looked for in models with states of first order or
   * rolling, nor where parts turn differently: the stiffness of one moment decides nothing there.
   *
   * @param state an equilibrium with its stresses and multipliers
   * @param large the solver of a static analysis with factors of the tangent at the state, if any: in large models its
   * pivots are counted, or nothing is done.
   */
  NegativeDirections negative_directions(const System &system, const State &state, const LinearSolver *large = nullptr);

  /** Shares with their names, the largest first. */
  std::vector<std::pair<double, std::string>> largest_first(const std::map<std::string, double> &shares);

  /** "<blade>, <hub> move, most of all blade at (0, 0, 1), rotation 2", of increments @p z of twists and coordinates
   * [m, rad]. */
  std::string what_moves(const System &system, const Eigen::VectorXd &z);
} // namespace samara

#endif
