#ifndef samara_analysis_modal_h
#define samara_analysis_modal_h

#include <samara/analysis/analysis.h>
#include <samara/analysis/linearization.h>
#include <samara/analysis/mode_content.h>
#include <samara/analysis/mode_tracking.h>
#include <samara/analysis/moving_axes.h>
#include <samara/output/table.h>

namespace samara
{
  /**
   * Modes of small motions about the context's state (the paper, section 4.1; doc/theory/modes.md), an equilibrium at
   * rest or in steady rotation. A state that is none, because loads act on it that its stresses do not balance, is
   * refused.
   *
   * Writes modes.csv, or modes_<speed>.csv for each speed of a sweep and fan.csv with all of them, where modes keep
   * their number by their shape (MAC). Modes of rotors have names by their content, with a <Symmetry> patterns, too;
   * mode_<k>.pvd shows a mode moving. Each mode has an estimate of its error: above 1e-6 of the frequency it is warned
   * about, above 1e-2 refused.
   */
  class ModalAnalysis : public Analysis
  {
  public:
    void add_parameters(Parameters &prm) override;
    void run(Context &context) override;
    void finish(Context &context) override;

    std::vector<Mode>        modes;    ///< of the last run
    std::vector<ModeContent> contents; ///< of these; families alone without a <Symmetry>, none if nothing turns

  protected:
    /** A steady motion about which small motions have constant coefficients, in axes with these spins. */
    struct Steady
    {
      State                state;
      std::vector<Vector3> spins; ///< see Linearization; empty: axes turn with their nodes
      Linearization        linearization;
    };
    /** Find the modes, and refuse what has none. */
    Steady analyse(Context &context);

    // entries
    unsigned int n_modes = 10, n_animations = 4;
    double       shift = 0; ///< 0: found from the model
    bool         hold  = false;
    std::string  axes = "automatic", unsteady = "refuse", symmetry;

  private:
    ModeTracking              tracking;
    std::vector<unsigned int> branches;
    std::unique_ptr<Table>    fan;
    std::vector<double>       left; ///< twists of the steady motion in which the state was left: nobody's but its own

    /** Complain if the state is none of a steady motion: what would be frozen then? Returns whether it is one. */
    bool check_motion(const Context &context) const;
    /** Balance the stresses of @p state; throws NotConverged if it is no equilibrium. */
    void check_equilibrium(const System &system, State &state) const;
    /** How much the state that came in turns otherwise than in the steady motion, and which node most. */
    struct OtherMotion
    {
      double      spin  = 0; ///< [rad/s]
      std::string place = "";
    };
    static OtherMotion other_motion(const System &system, const State &steady, const std::vector<double> &twists);
    /** Modes belong to the steady motion: refuse them, or warn, where that makes a difference. */
    void check_other_motion(const Context &context, const OtherMotion &other) const;
    /** Nor to one in which joints are prescribed to move beside it: nothing here knows their rates. */
    void check_prescribed(const Context &context, const State &state) const;
    /** Nor do they belong to a state in which loads change as it turns. */
    void check_loads(const Context &context, const State &state) const;
    void refuse_unsteady(const Context &context, const std::string &why) const;
    void check_mass(const System &system, const Linearization &linearization) const;
    void find(const Context &context, const Linearization &linearization);
    void check_axes(const Context &context, const MovingAxes &seen) const;
    void check_errors(const Context &context) const;
    /** Say whether the stiffness is negative in a direction, and whether modes that were found grow. */
    void tell_instability(const Context &context, const Steady &steady) const;
    /** Number the modes by branches, and name them by what the repeated parts do in them, or by what each blade does.
     */
    void name(const Context &context, const Steady &steady);
    void name_families(const Context &context);
    void add_to_fan(const Context &context);
    void report(Context &context) const;
    /** As pictures, and on the page of the report: there at all speeds, as long as there is room. */
    void animate(const Context &context) const;
  };



  /** Share of each body in the kinetic energy of a mode, largest first. */
  std::vector<std::pair<std::string, double>> participation(const System &system, const Mode &mode);
} // namespace samara

#endif
