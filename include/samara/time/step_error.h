#ifndef samara_time_step_error_h
#define samara_time_step_error_h

#include <samara/model/system.h>
#include <samara/time/state_error.h>

#include <vector>

namespace samara
{
  /**
   * What a step says about its own error, as displacements of all nodes at its end: six a node, in the nodes' frames,
   * and none of the ground [m, rad].
   */
  struct StepDifference
  {
    /** A displacement and its rate, and the frequency at which its rate would strain the model [rad/s]. */
    struct Field
    {
      std::vector<double> displacement, rate;
      double              frequency = 0;
    };
    Field               neighbour;       ///< ∂(q, y)/∂α: what the neighbour in α would have done
    Field               resolved;        ///< the part of it that the step resolves, by its middle; empty: everything is
    Field               resolved_at_end; ///< the same by its end; empty where that makes no difference
    std::vector<double> load, load_rate; ///< of the loads between the stages, and its rate; empty: there is nothing
    std::vector<double> driven;          ///< twists of all nodes, the ground's too, that prescribed motions enforce
    std::vector<double> states; ///< ∂z/∂α of all states of first order, by those that count; empty: none does
  };



  /**
   * The local error of a step of the integrator family, as a length: the largest over all nodes of √(|δx|² + ℓ²|δθ|²),
   * ℓ the radius of gyration of what the node carries, at most half of the distance to
   * the next node: farther away it is that one's displacement that tells (doc/theory/step_control.md).
   *
   *     e₁ = √(α² + φ² (h/τ)²) √(|δq|² + τ² |δv|²)         the neighbour in α; δv the rate of δq from step to step
   *     e₂ = κ/(4(2s+1)) (h|Ω|)^{2s+1} max(ℓ, |v|/|Ω|)     steady rotation, of which the neighbour says nothing; Ω
   *                                                        relative to prescribed rotations, which are exact at the
   *                                                        ends of steps
   *     e₃ = max(|δq|, τ |δv|)                             response to what loads do between the stages
   *
   * τ is the time scale of the motion that carries the error: of δq over δv, or of δv over its rate, if that is longer
   * and not longer than what strains. All are means over about a period, with a memory of exp(−t/2τ); so are δq and δv
   * where the error of the step itself is less, as errors of oscillations pass through zero.
   *
   * Vibration that is not resolved is wrong by twice its amplitude a = 2|δ|/ζ((h/τ)²) once, not in each step: e₁ is at
   * most 2a h/duration, but not less than it is for the resolved part alone, the larger of the two.
   */
  class StepError
  {
  public:
    /** The diagonal of the box of all nodes, with the ground's if there is one node only; 1 m if it is zero [m]. */
    static double length_of(const Model &model);

    StepError(const System &system, const Tableau &tableau);

    /** The largest over the nodes of the length of a displacement [m]. */
    double size(const std::vector<double> &displacement) const;

    /** The largest distance that a node has moved by since the reference configuration of the model [m]. */
    double largest_displacement(const State &state) const;

    /**
     * Local error of a step of length @p h to @p end, of a run of @p duration [m]. Nothing is remembered of it before
     * accept().
     */
    double of_step(const State &end, const StepDifference &difference, double h, double duration);
    void   accept();

    /**
     * How far a step of a rigid mechanism shifts what follows by the energy that it dissipates: with less energy a free
     * motion is late, more so with time [m].
     *
     *     e₄ = ½ |v| (remaining time) D/(2E),     D at most α |y|_M |δv|_M: what drives enforce loses nothing
     *
     * Half, as a motion that comes and goes is slower in the mean than where it loses most. E: @p energy, the largest
     * so far. 0 for models with springs or elastic bodies, which lose mostly vibration.
     */
    double
    shift(const State &end, const StepDifference &difference, double dissipated, double energy, double remaining) const;

    /** All that later steps depend on, for restarts. @{ */
    std::vector<double> memory() const;
    void                set_memory(const std::vector<double> &memory);
    /** @} */

    StateError of_states; ///< relative

  private:
    /** The time scale of what carries an error. */
    struct Scale
    {
      std::vector<double> last; ///< δv/h^{2s} of the last step
      double              step = 0, weight = 0, q_squares = 0, v_squares = 0, a_squares = 0;
      double              tau       = 0; ///< of the error [s]
      double              amplitude = 0; ///< that belongs to it, per ∂α [m]
    };

    const System             &system;
    const Tableau             tableau;
    const DissipationRelation relation;
    std::vector<double>       radius; ///< ℓ of each node
    Scale                     all, resolved, resolved_at_end, next_all, next_resolved, next_resolved_at_end;

    double advance(const Scale &from, const StepDifference::Field &field, double h, Scale &to) const;
    double rotation(const State &end, const std::vector<double> &driven, double h) const;
  };
} // namespace samara

#endif
