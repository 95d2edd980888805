#ifndef samara_analysis_static_h
#define samara_analysis_static_h

#include <samara/analysis/analysis.h>
#include <samara/output/history.h>
#include <samara/output/pictures.h>
#include <samara/solvers/arc_length.h>
#include <samara/solvers/redundant_rows.h>

#include <ctime>
#include <limits>
#include <memory>
#include <optional>

namespace samara
{
  /**
   * Equilibrium under loads and steady rotations (the paper, section 4.1), followed from the context's state to the
   * full loads and speeds in steps as large as Newton's method takes them, or along the arc of the equilibrium path,
   * with the load factor as an unknown, through limit points and past bifurcations (ArcLength; doc/theory/statics.md).
   *
   * Writes static.csv (.h5) with the probes at each load step, static.pvd with the deformed model, and for a sweep
   * static_speeds.csv with the probes at each speed. A path by its arc writes static_path.csv, about its steps, and
   * static_limits.csv, with the probes at its limit points and bifurcations.
   */
  class StaticAnalysis : public Analysis
  {
  public:
    void add_parameters(Parameters &prm) override;
    void check(const std::vector<double> &rotor_speeds, Complaints &complaints) const override;
    void start(Context &context) override;
    void run(Context &context) override;
    void finish(Context &context) override;

    std::optional<Effort>
    effort() const override
    {
      if (n_steps == 0)
        return {};
      return Effort{double(n_steps), double(n_iterations), std::numeric_limits<double>::quiet_NaN()};
    }

    unsigned int         n_steps = 0, n_iterations = 0; ///< of the last run
    mutable unsigned int n_shown = 0; ///< equilibria of it whose stability was shown without factors of their own

    /** Unknowns from which on a factorisation costs as much as all else. */
    unsigned int large_model = 20000;

    /** Where the tangent matrix is singular on a path. */
    struct SingularPoint
    {
      bool  is_limit; ///< the load factor turns; else a bifurcation
      State state;
    };
    std::vector<SingularPoint> singular_points; ///< passed in the last run with Path = arc length

  private:
    // entries
    unsigned int initial_steps = 1, max_iterations = 30;
    double       tolerance = 1e-9, time = 0, smallest_step = 1e-4;
    std::string  stability_limits = "stop", path = "load";
    Expression   load_factor{"s"}; ///< if it is set
    double       largest_arc = 0.1, load_weight = 0, end_factor = 1, largest_factor = 10;
    unsigned int passages = 1, most_steps = 1000;

    std::clock_t                  processor_start = 0;
    bool                          has_told_motion = false; ///< why it is not steady; once in a sweep
    unsigned int                  n_negative_told = 0;     ///< directions of negative stiffness; each number once
    mutable bool                  is_shown_stable = false; ///< the last equilibrium, see is_stable_by_iteration()
    std::unique_ptr<LinearSolver> solver;
    std::unique_ptr<History>      history, speed_history, path_history, limits_history;
    std::unique_ptr<Pictures>     pictures;

    NewtonResult
    equilibrium(const Context &context, Newton &newton, State &state, const std::vector<double> &speeds) const;

    /** @name To the full load in steps, in static_load.cc @{ */
    class LoadPath;
    void follow_load(Context &context);
    /** @} */

    /**
     * Whether the factors at hand, of a state nearby, show that an equilibrium has no direction of negative stiffness:
     * n_positive_is_kept(). Tried in large models alone.
     */
    bool is_stable_by_iteration(const Context &context, const State &state) const;
    /** Sign of the tangent's determinant at an equilibrium; 0 where it says nothing, as for turning parts. */
    int stability_sign(const Context &context, const State &state) const;
    /**
     * Whether the equilibrium @p found is beyond a stability limit, seen from @p start, whose sign is found here if it
     * is needed.
     */
    bool is_beyond_limit(const Context      &context,
                         const State        &start,
                         std::optional<int> &sign_at_start,
                         const State        &found) const;
    /**
     * The number of an angle that turns so far from one equilibrium to the next that this may be none of the same path;
     * -1 if all is well. Angles that are unknown and not prescribed are looked at. If @p by_load, if nothing but the
     * load grows, it is known in which sense they go on. The solver keeps the matrix of @p to, if any.
     */
    int  turned_too_far(const System &system, const State &from, const State &to, bool by_load) const;
    void check_load_factor(const std::vector<double> &rotor_speeds, Complaints &complaints) const;

    /** @name Along the arc, in static_path.cc @{ */
    void add_path_parameters(Parameters &prm);
    void follow_path(Context &context);

    PathPoint start_of_path(Context &context, ArcLength &method);

    /** Whether the path is given up, with a warning, at a point with this load factor. */
    bool is_too_long(const Context &context, double factor) const;

    /** One step of the arc @p step from @p here, where rows to leave out are chosen; refuses what may be another path.
     */
    NewtonResult
    step_along(ArcLength &method, RedundantRows &redundant, PathPoint &here, double step, PathPoint &next) const;

    /** Tell and record the limit points and bifurcations between two points at the distance @p s. */
    void
    find_singular_points(Context &context, ArcLength &method, const PathPoint &from, const PathPoint &to, double s);

    /** The end of the path lies between two points: @p to becomes it. Returns its distance. */
    double find_end(Context &context, ArcLength &method, const PathPoint &from, PathPoint &to, double s);
    /** @} */

    CoarseMeshes meshes;

    void              record(Context &context, const State &state, double progress, const NewtonResult &result);
    void              tell_motion(const Context &context);
    void              tell_instability(const Context &context);
    void              tell_loads(const Context &context);
    void              tell_prescribed(const Context &context, const State &turning);
    [[noreturn]] void give_up(const Context &context, const NewtonResult &result, double fraction) const;
  };
} // namespace samara

#endif
