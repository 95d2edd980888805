#ifndef samara_solvers_newton_h
#define samara_solvers_newton_h

#include <samara/model/system.h>
#include <samara/solvers/linear.h>
#include <samara/solvers/redundant_rows.h>

namespace samara
{
  /** Why there is no equilibrium, as far as advice depends on it. */
  enum class Failure
  {
    none,
    no_convergence,
    not_finite,      ///< what acts is no number
    singular,        ///< the matrix
    rows_left_out,   ///< redundant constraints do not agree
    stability_limit, ///< passed, found by who asks for equilibria
    other
  };

  struct NewtonResult
  {
    bool         converged  = false;
    unsigned int iterations = 0;
    double       last_step  = 0; ///< largest displacement relative to the size of the model, or rotation
    double       residual   = 0; ///< largest force left [N] or [N m]
    unsigned int worst      = 0; ///< the unknown where it is
    Failure      failure    = Failure::none;
    std::string  reason; ///< in words, if not converged

    /** It has not converged; why, by kind and in words. */
    void
    fail(const Failure kind, const std::string &words)
    {
      converged = false;
      failure   = kind;
      reason    = words;
    }
  };



  /** What has converged to a length below zero has not: a root that no state has, see Model::lengths. */
  void refuse_negative_length(const System &system, const State &state, NewtonResult &result);



  /**
   * Equilibrium of a system at fixed load factor by mixed Newton iterations (Magisano et al. 2017): the stress is an
   * unknown at each point, condensed there. Residuals use the stress of the configuration, tangents the stress of the
   * last linearisation, so that stiff axial and shear strains do not spoil the geometric stiffness of large steps.
   */
  class Newton
  {
  public:
    Newton(const System &system, LinearSolver &solver, double tolerance = 1e-9, unsigned int max_iterations = 30);

    /** Iterate from @p state. On success its stress is that of its configuration. */
    NewtonResult solve(State &state);

    unsigned int n_iterations = 0; ///< of all calls, for reports

  private:
    const System                  &system;
    LinearSolver                  &solver;
    const double                   tolerance;
    const unsigned int             max_iterations;
    double                         length; // of the model, to make displacements comparable with rotations
    SparseMatrix                   K;
    std::vector<double>            stress, residual, step;
    std::unique_ptr<RedundantRows> redundant; ///< made when a state has rows left out

    void find_worst(NewtonResult &result) const;
    /** A row left out that does not hold contradicts others; then there is no solution. */
    void check_rows_left_out(const State &state, NewtonResult &result);
  };

  /**
   * Largest displacement of a node in @p step, relative to @p length, or rotation; joint coordinates likewise. States
   * of first order change by parts of their scale, or of what they are in @p states, before or after the step, if that
   * is more.
   */
  double size_of_step(const System              &system,
                      const std::vector<double> &step,
                      double                     length,
                      const std::vector<double> *states = nullptr);

  /** Diagonal of the box around the reference positions of all nodes; 1 for a single node at the origin. */
  double model_length(const Model &model);
} // namespace samara

#endif
