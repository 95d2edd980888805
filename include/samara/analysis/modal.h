#ifndef samara_analysis_modal_h
#define samara_analysis_modal_h

#include <samara/analysis/analysis.h>
#include <samara/output/table.h>
#include <samara/solvers/eigen.h>

namespace samara
{
  /** Matrices of the motion about a state: M ζ̈ + C ζ̇ + (K ζ + Gᵀμ) = 0, G ζ = 0, all with the pattern of the system. */
  struct Linearization
  {
    SparseMatrix M, C, K;

    /**
     * About @p state, in axes that turn with the nodes. With @p fixed_axes the increments of turning nodes are seen in
     * axes that stand still, which makes parts turning against others comparable: the matrices are those of the moment,
     * and constant if what turns is axisymmetric.
     */
    Linearization(const System &system, const State &state, bool fixed_axes);
  };



  /**
   * Modes of small motions about the context's state (the paper, section 4.1; doc/theory/modes.md), an equilibrium at
   * rest or in steady rotation.
   *
   * Writes modes.csv, or modes_<speed>.csv for each speed of a sweep and fan.csv with all of them, where modes keep
   * their number by their shape (MAC); mode_<k>.pvd shows a mode moving.
   */
  class ModalAnalysis : public Analysis
  {
  public:
    void add_parameters(Parameters &prm) override;
    void run(Context &context) override;
    void finish(Context &context) override;

    std::vector<Mode> modes; ///< of the last run

  private:
    // entries
    unsigned int n_modes = 10, n_animations = 4;
    double       shift = 1;
    bool         hold  = false;
    std::string  axes = "automatic", unsteady = "refuse";

    std::vector<Mode>         previous; ///< of the speed before, in the order of branches
    std::vector<unsigned int> branches;
    std::unique_ptr<Table>    fan;

    /** Complain if the state is none of a steady motion: what would be frozen then? */
    void check_motion(const Context &context) const;
    void track(const Linearization &linearization);
    void report(Context &context) const;
    void animate(const Context &context, unsigned int k) const;
  };



  /** Share of each body in the kinetic energy of a mode, largest first. */
  std::vector<std::pair<std::string, double>> participation(const System &system, const Mode &mode);
} // namespace samara

#endif
