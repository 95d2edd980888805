#ifndef samara_analysis_static_h
#define samara_analysis_static_h

#include <samara/analysis/analysis.h>
#include <samara/output/history.h>
#include <samara/output/pictures.h>
#include <samara/solvers/newton.h>

#include <memory>

namespace samara
{
  /**
   * Equilibrium under loads and steady rotations (the paper, section 4.1), followed from the context's state to the full
   * loads and speeds in steps as large as Newton's method takes them.
   *
   * Writes static.csv (.h5) with the probes at each load step, static.pvd with the deformed model, and for a sweep
   * static_speeds.csv with the probes at each speed.
   */
  class StaticAnalysis : public Analysis
  {
  public:
    void add_parameters(Parameters &prm) override;
    void start(Context &context) override;
    void run(Context &context) override;
    void finish(Context &context) override;

    unsigned int n_steps = 0, n_iterations = 0; ///< of the last run

  private:
    // entries
    unsigned int initial_steps = 1, max_iterations = 30;
    double       tolerance = 1e-9, time = 0, smallest_step = 1e-4;
    std::string  stability_limits = "stop";

    std::unique_ptr<LinearSolver> solver;
    std::unique_ptr<History>      history, speed_history;
    std::unique_ptr<Pictures>     pictures;

    NewtonResult equilibrium(const Context &context, Newton &newton, State &state, const std::vector<double> &speeds) const;
    /** Sign of the tangent's determinant at an equilibrium; 0 where it says nothing, as for turning parts. */
    int  stability_sign(const Context &context, const State &state) const;
    void record(Context &context, const State &state, double fraction, const NewtonResult &result);
    [[noreturn]] void give_up(const Context &context, const NewtonResult &result, double fraction) const;
  };
} // namespace samara

#endif
