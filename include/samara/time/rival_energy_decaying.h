#ifndef samara_time_rival_energy_decaying_h
#define samara_time_rival_energy_decaying_h

#include <samara/time/rival_parts.h>

namespace samara
{
  /**
   * The two-stage energy decaying scheme in its textbook form (Bauchau & Theron 1996; Bauchau & Bottasso 1999; tunable:
   * Bottasso & Borri 1998), with Y the inertial velocities of the mass centres, spins in the nodes' frames and strains:
   *
   *     Y_f = Y_i + h A(½(q_i + q_f)) ½ (Y_j + Y_f)
   *     Y_j = Y_i − (h/6) A(½(q_i + q_j)) [Y_f − α Y_j − (1 − α) Y_i],     α = (1 − ρ∞)/(1 + ρ∞)
   *
   * The same A makes positions of velocities, so that strains and quadratic constraints are those of q_f and q_j:
   * g(q_f) = 0 and g(q_j) = 0, and |Y_f|² = |Y_i|² − α |Y_j − Y_i|² in the norm of the energy without loads. Order 3
   * (4 if α = 0) for linear systems, 2 for others. Velocities at the end are not made to obey the constraints.
   *
   * Loads enter as the mean configuration has them at mid-step, and in the second line as the bracket says.
   * Constraints of free angles are not quadratic: there constraint forces work. Multipliers are means over the step.
   */
  class EnergyDecaying : public Integrator
  {
  public:
    /** @throws std::invalid_argument if a node's inertia is not that of a body: the mass must be the same in all
     * directions. */
    EnergyDecaying(const System &system, const IntegratorSettings &settings);

    StepResult step(State &state, double h) override;
    void       forget_history() override;

    /** ½ α |Y_j − Y_i|² of the last step [J]. */
    double jump_energy = 0;

  private:
    const System            &system;
    const IntegratorSettings settings;
    const double             alpha;

    /** Inertia of a node about its mass centre, at @p centre in the node's frame. */
    struct NodalMass
    {
      double  mass;
      Vector3 centre;
      Matrix3 inertia;
    };
    std::vector<NodalMass> masses;

    rivals::Measure    measure;
    rivals::PairMatrix matrix;
    SparseMatrix       M, C, K;
    double             factored_step = 0;
    std::vector<bool>  is_active, is_nonholonomic;

    /** A stage: its configuration, the mean of it and the start, and the velocities. */
    struct Stage
    {
      State                end, mean;      ///< mean.y, mean.rates: what leads from the start to the end
      std::vector<double>  strains;        ///< at the end
      std::vector<double>  stress, excess; ///< of mean or bracket, as iterated; what the strains have more than it
      std::vector<Vector3> V, W;           ///< of mass centres: at the end of the stage, and of the mean (inertial)
      std::vector<Vector3> spin;           ///< at the end of the stage
      std::vector<double>  rates, r;       ///< rates at the end of the stage; residual
    };
    Stage                j, f;
    std::vector<Vector3> V_start;
    std::vector<double>  e_start;
    std::vector<Matrix3> middle; ///< orthonormal triads in the middle of the step

    State                          frozen;         ///< where the matrix was made, without multipliers
    std::unique_ptr<LinearStrains> frozen_strains; ///< where the matrix was made

    void predict(const State &state, double h);
    void means(const State &state, double h);
    void mean_of(const State &state, double over_h, Stage &stage) const;
    void evaluate(const State &state, double h);
    void evaluate_stage(const State &state, double h, const std::vector<double> &strains, Stage &stage);
    void factorize(double h);
    /** Solve and correct both stages; returns the size of the correction. */
    double correct(double h);
    /** Move the end of a stage by the part @p zeta of the solution that belongs to it. */
    void correct_end(const double *zeta, Stage &stage) const;
    /** Of a correction, relative to the largest: of velocities by @p zeta of f, of multipliers by all of it. @{ */
    double size_of_velocities(const double *zeta, double h) const;
    double size_of_multipliers(const std::vector<double> &x) const;
    /** @} */
    /** Newton's method for both stages. */
    StepResult find_stages(const State &begin, double h);
    /** ½ α |Y_j − Y_i|² [J]; makes the strains of j differences. */
    double energy_of_jump(const State &begin);
    /** δσ = (what the strains have more) + C B z + C_d B ż, with the B of the matrix (mixed Newton). */
    void correct_stresses(const std::vector<double> &z, const std::vector<double> &rates, Stage &stage) const;
    void find_middle(const State &state);

    /** Forces of loads alone, node by node in inertial components. */
    std::vector<double> loads(const State &state) const;
    void                rotate_to(const State &frames, std::vector<double> &force) const;
  };
} // namespace samara

#endif
