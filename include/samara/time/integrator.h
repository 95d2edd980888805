#ifndef samara_time_integrator_h
#define samara_time_integrator_h

#include <samara/model/system.h>
#include <samara/solvers/linear.h>
#include <samara/time/tableau.h>

namespace samara
{
  /** What a step did. Energies in J over the step. */
  struct StepResult
  {
    bool         converged  = false;
    unsigned int iterations = 0;
    double       dissipated = 0; ///< numerically, D ≥ 0
    double       work_of_loads = 0, viscous_loss = 0;
    double       work_of_drives = 0; ///< of constraints that depend on time; zero to round-off for all others
    double       last_correction = 0; ///< size of the last Newton correction of displacements, relative
    unsigned int worst = 0; ///< unknown with the largest force left, if not converged
  };



  /**
   * One step of the integrator family in nodal-frame twists, over the assembled system only:
   *
   *     Q_k = q_i + h Σ a_kl N(Q_l) y_l
   *     M Σ w_kl (y_l − y_i)/h = ad*_{y_k} M y_k − N(Q_k)ᵀ [ B(Q_k)ᵀ σ_k + G(Q_k)ᵀ λ_k − f ]
   *     σ_k = C ( e(q_i) + h Σ a_α,kl B(Q_l) y_l ) + C_d B(Q_k) y_k
   *     ġ(Q_k, y_k, t_k) − Σ b_l ġ_l + g(q_f, t_f)/h = 0
   *
   * The last line is one rule for all constraints: for quadratic ones Σ b_l ġ_l = (g_f − g_i)/h, so that it reads
   * ġ_k + g_i/h = 0; for others it says that g vanishes at the end of the step and that all stages have the same rate.
   * Constraints that are not quadratic nor driven get the force −λ̄ ρ θ̇_k along their coordinate, with λ̄ = Σ b λ and
   * ρ = Σ b ġ/Σ b θ̇²: then they do no work (design notes, 5.3, with the weights b for any s).
   *
   * Energy: E_f − E_i = work of loads and drives − viscous loss − D, D = h² α/(2(2s−1)) |Σ b_k p_k (ẏ_k, ė_k)|².
   *
   * Newton's method is simplified: with increments ζ = displacement in the nodes' frames instead of δy, the linearised
   * stages are M + hμ C + (hμ)² K, the matrices of the modal analysis, one for each eigenvalue μ of a_α: one real
   * factorisation for s = 1, one complex for s = 2, one of each for s = 3. They are kept while Newton converges quickly,
   * as the frames turn with the bodies.
   */
  class Integrator
  {
  public:
    Integrator(const System &system, const Tableau &tableau, double tolerance = 1e-11, unsigned int max_iterations = 50);

    /** Advance @p state by @p h; it is unchanged if the result says not converged. */
    StepResult step(State &state, double h);

    /** To be called when the state has been changed from outside. */
    void forget_history();

    unsigned int n_steps = 0, n_iterations = 0, n_factorizations = 0; ///< for reports

    const Tableau tableau;

  private:
    const System &system;
    const double  tolerance;
    unsigned int  max_iterations;
    double        length;

    /** What is computed at a stage. */
    struct Stage
    {
      std::vector<double> q, coordinates, y, rates, multipliers, strain_rates, stress, residual, constraint_rates;
      double              time;

      Point<double>
      point() const
      {
        return {q.data(), coordinates.data(), y.data(), rates.data(), multipliers.data(), stress.data(), time, 1., false};
      }
    };
    std::vector<Stage> stages;

    /** A factorisation for one eigenvalue of the tableau, real or complex. */
    struct Factor
    {
      std::unique_ptr<LinearSolver>  real;
      std::unique_ptr<ComplexSolver> complex;
    };
    std::vector<Factor> factors;
    double              factored_step = 0;  ///< step size of the factors; 0: none
    std::vector<double> factored_y;         ///< twists at which they were made
    SparseMatrix        M, C, K;
    std::vector<bool>   is_constraint_entry;
    std::vector<bool>   is_active; ///< multipliers: neither released nor dropped

    std::vector<double>              e_start, final_q, final_coordinates, constraints_at_end;
    std::vector<std::vector<double>> previous_y; ///< of the stages of the last step, and its start
    double                           previous_step = 0;

    bool   iterate(const State &state, double h, StepResult &result, bool fresh);
    void   predict(const State &state, double h);
    void   factorize(const State &state, double h);
    void   move_stages(const State &state, double h);
    void   evaluate(const State &state, double h);
    double correct(const State &state, double h);
    void   finish(State &state, double h, StepResult &result);
    void   account(const State &state, double h, StepResult &result);
  };
} // namespace samara

#endif
