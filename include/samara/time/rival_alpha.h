#ifndef samara_time_rival_alpha_h
#define samara_time_rival_alpha_h

#include <samara/time/projection.h>
#include <samara/time/rival_parts.h>

namespace samara
{
  /**
   * The generalised-α method on the group of the nodal frames, index 3 (Brüls, Cardona & Arnold 2012):
   *
   *     q' = q exp(Δ),   Δ = h y + h² (½ − β) a + h² β a',   y' = y + h (1 − γ) a + h γ a'
   *     (1 − α_m) a' + α_m a = (1 − α_f) ẏ' + α_f ẏ
   *     M ẏ' + f(q', y', t') + Gᵀλ' = 0,   g(q', t') = 0
   *
   * with γ = ½ + α_f − α_m, β = ¼ (γ + ½)². Rows b(q) y = 0 (rolling) are satisfied by y'.
   *
   * Start (Arnold, Brüls & Cardona 2015): a = ẏ + (α_m − α_f) h ÿ, and velocities with the error that the positions of
   * the next step need to obey the constraints, G δy = h² G ((1/6 − β − (α_m − α_f)/2) ÿ + ad_y ẏ/12). Without it the
   * multipliers are of first order for some steps. ÿ is a difference of accelerations a little later; where
   * h² |ÿ| > ½ |y| + h |ẏ| the step resolves no such thing, and the start is a = ẏ.
   *
   * It starts anew at corners of what is prescribed, and if the step changes.
   */
  class GeneralisedAlpha : public Integrator
  {
  public:
    struct Coefficients
    {
      double alpha_m, alpha_f, gamma, beta;
    };

    /** Of second order with spectral radius ρ∞ at infinite frequency (Chung & Hulbert 1993). */
    static Coefficients of_spectral_radius(double rho);

    /** α_m = α_f = 0, γ = ½, β = ¼: Newmark's method without dissipation, the trapezoidal rule. */
    static Coefficients trapezoidal();

    /** @p corrected_start: as above; otherwise a = ẏ and the velocities as they are. */
    GeneralisedAlpha(const System             &system,
                     const Coefficients       &coefficients,
                     bool                      corrected_start,
                     const IntegratorSettings &settings);

    /** Of this spectral radius, with the corrected start. */
    GeneralisedAlpha(const System &system, const IntegratorSettings &settings);

    StepResult step(State &state, double h) override;
    void       forget_history() override;
    void       step_back() override;

  private:
    const System            &system;
    const Coefficients       c;
    const bool               corrected_start;
    const IntegratorSettings settings;

    rivals::Measure               measure;
    Projection                    projection;
    std::unique_ptr<LinearSolver> solver;
    SparseMatrix                  M, C, K;
    double                        factored_step = 0; ///< of the factors; 0: none
    std::vector<bool>             is_active, is_nonholonomic;

    /** What belongs to a time besides the state; numbered like the unknowns. */
    struct History
    {
      double              h = 0; ///< step it was made with; 0: there is none
      std::vector<double> a, y_dot;
    };
    History now, next;
    bool    is_pending = false; ///< `next` belongs to the state, unless the step is taken back

    /** Velocities and accelerations on the way. */
    struct Iterate
    {
      State               state;
      std::vector<double> increment, y_dot, a, residual;
    };

    void start(State &state, double h);
    /** Of a motion that goes on from the state with its accelerations; what they become after the time @p dt. */
    std::vector<double> accelerations_after(const State &state, double dt);
    /** Velocities whose constraint rates are those that the given @p change of velocities makes. */
    std::vector<double> with_change_of_rates(const State &state, const std::vector<double> &change);
    /** Newton's method for the end of a step. */
    StepResult find_end(const State &begin, double h, double evaluation_time, Iterate &iterate);
    void       predict(const State &state, double h, Iterate &iterate) const;
    void       configure(const State &state, Iterate &iterate) const;
    void       evaluate(double h, double evaluation_time, Iterate &iterate) const;
    void       factorize(double h, const Iterate &iterate);
    /** Solve and correct; returns the size of the correction of velocities, or of multipliers in its proportion. */
    double correct(double h, Iterate &iterate) const;

    std::vector<double> velocities(const State &state) const;
    void                set_velocities(State &state, const std::vector<double> &v) const;
  };



  /** The same with GeneralisedAlpha::trapezoidal(), started with velocities as they are. */
  class TrapezoidalRule : public GeneralisedAlpha
  {
  public:
    TrapezoidalRule(const System &system, const IntegratorSettings &settings);
  };
} // namespace samara

#endif
