#ifndef samara_time_stage_integrator_h
#define samara_time_stage_integrator_h

#include <samara/model/strain_products.h>
#include <samara/solvers/anderson.h>
#include <samara/solvers/linear.h>
#include <samara/solvers/redundant_rows.h>
#include <samara/time/exact_stages.h>
#include <samara/time/four_nodes.h>
#include <samara/time/integrator.h>
#include <samara/time/projection.h>
#include <samara/time/stage_bristles.h>
#include <samara/time/stage_contacts.h>
#include <samara/time/stage_history.h>
#include <samara/time/stage_rotation.h>
#include <samara/time/stage_stops.h>
#include <samara/time/tableau.h>
#include <samara/time/wider_pattern.h>

#include <cmath>

namespace samara
{
  class HasPressing;
  class StepTangent;

  /**
   * One step of the integrator family in nodal-frame twists, over the assembled system only:
   *
   *     Q_k = q_i + h Σ a_kl N(Q_l) y_l
   *     M Σ w_kl (y_l − y_i)/h = ad*_{y_k} M y_k − N(Q_k)ᵀ [ B(Q_k)ᵀ σ_k + G(Q_k)ᵀ λ_k − f ]
   *     σ_k = C ( e(q_i) + h Σ a_α,kl B(Q_l) y_l ) + C_d B(Q_k) y_k
   *     Σ w_kl (z_l − z_i)/h = g(Q_k, y_k, z_k, t_k)         states of first order
   *     ġ(Q_k, y_k, t_k) − Σ b_l ġ_l + g(q_f, t_f)/h = 0        b(Q_k) y_k = 0 if nonholonomic
   *
   * The last line is one rule for all constraints: for quadratic ones Σ b_l ġ_l = (g_f − g_i)/h, so that it reads
   * ġ_k + g_i/h = 0; for others it says that g vanishes at the end of the step and that all stages have the same rate.
   * Constraints that are not quadratic nor driven get the force −λ̄ ρ θ̇_k along their coordinate, with λ̄ = Σ b λ and
   * ρ = Σ b ġ/Σ b θ̇²: then they do no work (design notes, 5.3, with the weights b for any s).
   *
   * Energy: E_f − E_i = work of loads and drives − viscous loss − D, D = h² α/(2(2s−1)) |Σ b_k p_k (ẏ_k, ė_k)|².
   *
   * Newton's method is simplified and mixed (doc/theory/integrators.md): y, σ and λ are iterated, with the tangent of
   * one frozen configuration. In the eigenvectors of a_α its matrices are M + hμ C + (hμ)² K, those of the modal
   * analysis: one real factorisation for s = 1, one complex for s = 2, one of each for s = 3. As the frames turn with
   * the bodies, they serve for many steps; they are renewed in the middle of a step when Newton's method slows down. A
   * step that does not converge so is tried again with the exact matrix of all stages before it is given up.
   */
  class StageIntegrator : public Integrator
  {
  public:
    /**
     * @p tolerance: of Newton's method, change of velocities relative to the largest; velocities below
     * 1e-3 (model length, or rad) per step do not count as large.
     */
    StageIntegrator(const System  &system,
                    const Tableau &tableau,
                    double         tolerance      = 1e-10,
                    unsigned int   max_iterations = 50);

    StageIntegrator(const System &system, const IntegratorSettings &settings)
      : StageIntegrator(system,
                        Tableau(settings.n_stages, settings.spectral_radius),
                        settings.newton_tolerance,
                        settings.max_iterations)
    {}

    static constexpr IntegratorAbilities abilities = {true, true, true, true};

    StepResult step(State &state, double h) override;
    void       forget_history() override;
    void       step_back() override;

    /**
     * The exact tangent of the last step, which converged and began at @p start, see step_tangent.h. Its products are
     * as exact as the step is converged: ask for a tolerance of 1e-13 or so. There is one factorisation, if the step
     * has left no factors of its size.
     *
     * @throws NotConverged if a stop is touched in the step: it has no derivative where it opens or closes.
     */
    std::unique_ptr<StepTangent> linearize(const State &start);

    /** Give memory back that only further steps need: matrices, not their factors, and the stages of earlier steps. */
    void forget_matrices();

    const Tableau *
    family() const override
    {
      return &tableau;
    }

    Remarks
    remarks() const override
    {
      return {n_exact_steps, n_exchanges(), largest_gap_left_out, worst_left_out};
    }

    const Tableau tableau;

    /** @name For reports @{ */
    unsigned int n_exact_steps        = 0; ///< steps repeated with the exact matrix of all stages
    unsigned int n_evaluations        = 0; ///< of all forces at all stages, for Newton's method
    double       largest_gap_left_out = 0; ///< of a row left out, as a length [m]
    unsigned int worst_left_out       = 0; ///< its multiplier
    unsigned int
    n_exchanges() const
    {
      return redundant ? redundant->n_exchanges : 0;
    }
    unsigned int
    n_checks() const
    {
      return redundant ? redundant->n_checks : 0;
    }
    /** @} */

  private:
    friend class StepTangent;
    const System &system;
    const double  tolerance;
    unsigned int  max_iterations;
    double        length;

    /** What is computed at a stage. */
    struct Stage
    {
      std::vector<double> q, coordinates, y, rates, states, state_rates, multipliers;
      std::vector<double> stress; ///< σ_k as iterated
      std::vector<double> excess; ///< what the configuration's stress has more than it
      std::vector<double> strain_rates, residual, constraint_rates;
      std::vector<double> factors;    ///< of strain products, as the stages integrate them
      std::vector<double> reciprocal; ///< triads of forces in steps that turn, else empty; see StageRotation
      std::vector<double> nearest;    ///< rotations in steps that turn in air, else empty; see Point::nearest
      std::vector<double> momenta;    ///< M y in steps that turn, 6 a node
      std::vector<double> powers;     ///< of its sets: of the forces in them [W]
      double              time;
      bool                stops = false; ///< these act in all stages at once

      Point<double>
      point() const
      {
        Point<double> point = point_of(*this, time, 1., false, stops);
        if (!reciprocal.empty())
          point.reciprocal = reciprocal.data();
        if (!nearest.empty())
          point.nearest = nearest.data();
        return point;
      }

      /** Of what does not ask for forces, but for their derivatives with directors as they are. */
      Point<double>
      point_of_matrices() const
      {
        Point<double> result = point();
        result.reciprocal = result.nearest = nullptr;
        return result;
      }
    };
    std::vector<Stage> stages;

    std::unique_ptr<StageRotation> rotation;      ///< made by the first step that turns
    bool                           turns = false; ///< whether this one does

    /** Whether the step turns, and what that needs. */
    void start_rotation(const State &state, double h);
    /** Powers of the rows of a stage that hold bodies together, less those of the strains. */
    void find_powers(Stage &stage);
    /** Take the work of the reciprocal triads back in all stages. */
    void take_work_back();

    const std::vector<StrainProduct> products = strain_products(system.model); ///< strains that are not quadratic

    /** A factorisation for one eigenvalue of the tableau, real or complex. */
    struct Factor
    {
      std::unique_ptr<LinearSolver>  real;
      std::unique_ptr<ComplexSolver> complex;
    };
    std::vector<Factor> factors;
    std::vector<Factor> factors_at_end;       ///< of the same pattern; only where models have springs between points
    double              energy_scale    = 0;  ///< at the start of the step
    double              kinetic_energy  = 0;  ///< mean of the stages
    double              moved_energy    = 0;  ///< kinetic, and what strain energy has changed by
    double              first_strain    = -1; ///< energy at the first step; negative: not known
    double              factored_step   = 0;  ///< step size of the factors; 0: to be made anew
    double              step_of_factors = 0;  ///< the same of those that there are; 0: none
    State               frozen;               ///< at which they were made
    std::unique_ptr<LinearStrains> frozen_strains; ///< of the same configuration
    unsigned int                   n_steps_with_factors = 0, fresh_iterations = 0;
    double                         extra_iterations = 0;   ///< more than with fresh factors
    unsigned int n_steps_anew = 0, n_steps_to_go_anew = 0; ///< steps that begin with new factors, in all and to come
    SparseMatrix C, K;                                     // of large models gone after a factorisation
    /** Of the mass matrix, where it is not zero, and where that is in the pattern of the factors. */
    struct MassEntry
    {
      unsigned int at;
      double       value;
    };
    std::vector<MassEntry> mass;
    /** Of four nodes at once their inertias, rows of the upper triangles. */
    std::vector<FourNodes::Lane> inertias;
    std::vector<double>          gap_scale; ///< of multipliers, see row_scale(); 1 where that is 0
    std::vector<bool>            is_nonholonomic;
    std::vector<bool>            is_active; ///< multipliers: neither released nor left out

    std::unique_ptr<ExactStages>                exact;            ///< the exact matrix, made when it is needed first
    bool                                        is_exact = false; ///< whether it is in use
    std::vector<std::unique_ptr<LinearStrains>> stage_strains;    ///< for it

    std::unique_ptr<RedundantRows> redundant; ///< made when a state has rows left out
    std::vector<unsigned int>      left_out;  ///< those that are not active in this step

    std::vector<double> e_start, final_q, final_coordinates, final_states, constraints_at_end;
    std::vector<double> e_end;                  ///< strains where the last step ended; empty: not known
    System::Energy      energy_at_end = {0, 0}; ///< the same
    std::vector<double> y_at_end;               ///< with these velocities

    /** Velocities, and states, at the start and the stages of the last step, and whether extrapolating them was a good
     * start. */
    std::vector<std::vector<double>> previous;
    double                           previous_step = 0;
    double                           offset        = 1; ///< 0 after step_back(): where the next step begins
    bool                             extrapolates  = false;
    StageHistory                     velocity_history, rate_history, stress_history, multiplier_history;

    // work space
    std::vector<std::complex<double>> x, matrix;
    SparseMatrix                      real_matrix;
    std::vector<int>                  entries_in_use; ///< of the system's pattern, in that of the factors; empty: all
    std::vector<unsigned int>         constraint_entries; ///< in the pattern of the factors
    Eigen::VectorXd                   final_weights;      ///< y_f = y_i + Σ final_weights_k (y_k − y_i)
    Eigen::VectorXd                   mode_weights;       ///< h Σ b_k p_k ẏ_k = Σ mode_weights_k (y_k − y_i)
    std::vector<double>               x_real, x_rates, x_states, e, mean_rates, no_multipliers, time_rates, force;
    std::vector<std::vector<double>>  dz, dz_rate, d_lambda; ///< increments of the stages
    std::vector<std::vector<double>>  d_exact;               ///< those of the exact matrix, or residuals for it
    std::vector<double>               extrapolated;
    std::vector<double>               twists, strain_increment, rate_increment, stress_increment;

    /** Whether factors made for the step @p of serve for the step @p h. */
    static bool
    is_step(const double of, const double h)
    {
      return std::abs(of / h - 1) < 1e-9;
    }
    bool
    has_factors(const double h) const
    {
      return is_step(step_of_factors, h);
    }
    /** What is computed of the start of a step, and where Newton's method begins. */
    void start_step(State &state, double h);
    /** Whether a step that converged is one: its account, contacts, lengths and rows left out. */
    bool accept_stages(const State &state, double h, StepResult &result);

    /** @name Newton's method (stage_integrator_attempts.cc) @{ */
    struct Progress;
    enum class Verdict
    {
      converged,
      failed,
      open
    };
    /** With old factors, new ones, or the exact matrix. */
    bool find_stages(const State &state, double h, StepResult &result);
    bool find_with_new_factors(const State &state, double h, StepResult &result);
    /** Whether the next correction would be too small to count, without an evaluation of all forces. */
    bool    converges_unseen(const Progress &progress, const State &state, double h);
    Verdict judge_residuals(Progress &progress, double h) const;
    /** With the factors there are; gives up if corrections shrink by less than the factor @p slow. */
    bool iterate(const State &state, double h, double slow, StepResult &result);
    void judge_factors(unsigned int iterations);
    /** Whether the iteration may be accelerated: what stops, rubs, touches or switches changes sides, which a
     * combination of iterations does not know. */
    bool can_accelerate() const;
    /** All that is iterated. */
    std::vector<Anderson::Part> iterated_parts();
    Anderson                    acceleration;
    std::vector<double>         acceleration_weights; ///< of velocities, as they are measured
    /** @} */
    void predict(const State &state, double h);
    void extrapolate(double x, std::vector<double> &y, std::vector<double> &rates, std::vector<double> &states) const;
    void remember(const State &state, double h);
    void remember_stages(const State &state, double h);
    void forget_stages();
    void freeze(const State &state, double h);
    void factorize(double h);
    /** Fill the matrices of all factors: M + hμ C + (hμ)² K. */
    void combine_matrices(double h);
    /** The values of one of them. */
    template <typename Number>
    void combine(const Number &hm, std::vector<Number> &values) const;
    /** Make solvers for a pattern without the rows left out, of their values there are none yet. */
    void make_factors();

    /** One for each eigenvalue, without values. */
    std::vector<Factor> new_factors() const;
    void                move_stages(const State &state, double h);
    template <int s>
    void move_nodes(const State &state, double h);
    void evaluate(const State &state, double h);
    /** What the configurations' stresses have more than the iterated ones, from the rates of the strains. */
    void find_excesses(double h);
    /** Rates of the strains in all stages. */
    void evaluate_strain_rates(double h);
    /** The same for @p stages of a step from the strains @p e_start: products follow from the other rates. */
    static void find_products(const std::vector<StrainProduct> &products,
                              const Tableau                    &tableau,
                              double                            h,
                              const std::vector<double>        &e_start,
                              std::vector<Stage>               &stages);
    /** Stresses of changes of strains in stage @p k, linearised there. */
    void change_of_stresses(unsigned int k, const double *e, const double *rates, std::vector<double> &stress) const;
    void make_inertias();
    /** Add the inertial forces of all stages to their residuals; returns the mean kinetic energy. */
    double add_inertia(const State &state, double h);
    template <int s>
    void add_inertia(const State &state, double h, double *energies);
    /** From this many groups of four nodes on threads are faster. */
    static constexpr unsigned int worth_threads = 200;
    /** Rates of the states of first order at the stages. */
    void                          find_state_rates(const State &state, double h);
    void                          evaluate_constraints(const State &state, double h);
    /** The same where the rates of constraints are known: rows of multipliers, so that the step ends without gaps. */
    void close_constraints(const State &state, double h);
    /** Work that the residuals of the last evaluation would add to the energy, and a bound where none cancel. */
    struct EnergyError
    {
      double sum, bound;
    };
    EnergyError energy_error(double h) const;
    /** Whether forces of a converged step need not be evaluated: no account nor estimate looks at them. */
    bool can_predict() const;
    /** Evaluate what the account of a step looks at; whether constraints hold. */
    bool confirm_without_forces(const State &state, double h);
    /** Largest gap of a converged step, as a length [m]. */
    double
    allowed_gap() const
    {
      return std::max(1e-9, 10 * tolerance) * length;
    }
    /** What it is measured by: the energy that moves. Of one that only prestresses, a thousandth counts. */
    double energy_that_counts() const;
    double change_of_force          = 0,
           previous_change_of_force = 0; ///< of multipliers by corrections, relative to the largest
    /** Violation of constraints, at the end or by velocities over the step, as a length [m]. */
    double largest_gap(double h) const;
    /** λ̄ ρ, the force of a correction per rate. */
    double force_of(const Layout::Correction &correction, double h) const;
    /**
     * The same from functions rate(k) and multiplier(k) of the stages, and the mean rate of the constraint; @p unit is
     * the size of the coordinate that matters, 1 of an angle and the model's length of a slide.
     */
    template <typename Number, typename Rate, typename Multiplier>
    static Number force_of(const Tableau    &tableau,
                           double            h,
                           double            unit,
                           const Rate       &rate,
                           const Multiplier &multiplier,
                           const Number     &mean_rate);
    double
    unit_of(const Layout::Correction &correction) const
    {
      return system.layout.scale_of(system.layout.of_coordinate(correction.coordinate), length);
    }
    /** Increments of the stages from their residuals: dz, dz_rate, d_lambda; false without a solution for the stops. */
    bool solve_for_increments(double h);
    /** Solve with the factors for the residuals; increments from the solutions. @{ */
    void apply_factors(double h);
    void collect_increments(double h);
    /** @} */
    /** Twist by which a node's increments change its velocity in stage @p k: δy = ζ̇ + ad_y ζ. */
    Vector6 change_of_twist(unsigned int k, unsigned int node) const;
    /** An approximation of the unknowns X of all stages with J X = r, for one factorisation: see StepTangent. */
    void   solve_stages(const std::vector<double> &r, std::vector<double> &X);
    double solve(double h);

    /**
     * @name Stops and friction; gaps at the start, forces of the last evaluation (stage_integrator_stops.cc)
     * @{
     */
    std::vector<double>     gaps;
    std::vector<StopForces> stop_forces_now;

    /** An unknown that forces of stops and of friction depend on, in all stages: a rate, or a multiplier. */
    struct Port
    {
      int    row;  ///< of the unknown
      double side; ///< its sign
      bool   is_multiplier, has_force;
    };
    /** What acts at some ports: a stop, or the friction of some slip. */
    struct Device
    {
      unsigned int first_port, n_ports;
      bool         is_friction;
      unsigned int number; ///< in Layout::stops or Layout::frictions

      const HasPressing *pressing = nullptr; ///< of a friction: who says how its reactions press
    };
    std::vector<Port>   ports;
    std::vector<Device> devices; ///< stops first
    std::vector<double> free_changes;

    /** Answers of the factors to unit forces on joint coordinates. */
    struct Column
    {
      bool                              is_known = false;
      std::vector<double>               real;
      std::vector<std::complex<double>> complex;
    };
    std::vector<Column>         columns;
    std::vector<unsigned int>   touched, touched_ports; ///< devices that act, and their ports
    Eigen::VectorXd             device_forces_now;      ///< of all ports
    mutable std::vector<double> values_of_ports;        ///< of one device, as long as that of the most ports needs
    std::vector<double>         states_at_start;        ///< deflections of bristles among them
    Eigen::VectorXd             touched_free, port_changes, force_changes;
    Eigen::MatrixXd             touched_compliance, touched_slopes, touched_matrix;

    void          make_devices();
    void          start_stops(const State &state);
    void          evaluate_stops(double h);
    const Column &column(unsigned int coordinate);
    void          forget_columns();
    const double *port_values(const Device &device) const; ///< number s p + k: port p, stage k; until the next call
    double        port_value(const Port &port, unsigned int k) const;
    double        free_change(const Port &port, unsigned int k, double h) const;
    void          compliance(const Port &a, const Port &b, double h, Eigen::Ref<Eigen::MatrixXd> W);
    bool          acts(const Device &device, const double *values, double h) const;
    void          device_forces(const Device               &device,
                                const double               *values,
                                double                      h,
                                Eigen::Ref<Eigen::VectorXd> force,
                                Eigen::MatrixXd            *slopes) const;
    void          friction_forces(const Device               &device,
                                  const double               *values,
                                  double                      h,
                                  Eigen::Ref<Eigen::VectorXd> force,
                                  Eigen::MatrixXd            *slopes) const;
    BristleForces
    bristles_of(const Device &device, const double *values, const double *normal, double h, bool with_slopes) const;
    BristleForces bristles_now(const Device &device, double h) const;
    /** Set the states that are deflections of bristles, in all stages. */
    void move_bristles(double h);
    void
    normal_forces(const Device &device, const double *values, double h, double *normal, Eigen::MatrixXd *slopes) const;
    void use_ports_of_touched(double h);
    bool find_stop_forces(double h, bool from_free);
    void find_further_touches(double h);
    bool correct_for_stops(double h);
    void add_stop_reactions(double h);
    void account_for_stops(const State &state, double h, StepResult &result);
    void account_for_friction(double h, StepResult &result) const;
    /** @} */

    /** @name Groups of contacts (stage_integrator_contacts.cc) @{ */
    StageContacts              contacts;
    StageContacts::Couplings   couplings;        ///< of nodes, that the pattern of the factors has besides the layout's
    std::vector<Point<double>> points_of_stages; ///< at the last evaluation
    std::vector<double *>      residuals_of_stages;
    /** What the matrices of the factors have of pairs: entries, with what goes with K and C there. */
    struct EntryOfPairs
    {
      int    at;
      double K, C;
    };
    std::vector<EntryOfPairs>      entries_of_pairs;
    void                           evaluate_contacts(double h);
    void                           evaluate_contacts_that_turn(double h);
    bool                           accept_contacts(StepResult &result);
    void                           add_contacts_to_matrices();
    void                           add_contacts_to_exact_matrix(double h);
    unsigned int                   n_exact_for_contacts = 0; ///< steps to come that begin with the exact matrix
    std::shared_ptr<const Pattern> with_couplings(const std::shared_ptr<const Pattern> &pattern);
    /** @} */

    /** @name Nonlinear springs: stretches at the start, and what keeps their energy (stage_integrator_springs.cc) @{ */
    std::vector<double> stretches;
    void                start_springs(const State &state);
    void                evaluate_springs(double h);
    void                account_for_springs(double h, StepResult &result) const;
    void                add_slopes_of_springs(double h);
    /** @} */

    void   solve_exactly_for_increments(double h);
    double solve_exactly(double h);
    void   make_exact();
    void   add_slopes_of_stops(double h);
    /**
     * A step with the exact matrix of all stages: in place of the factors, as a repetition, or for its own sake where
     * many contacts act: it is sparse, the system of what is touched is not.
     */
    bool iterate_exactly(const State &state, double h, bool again, StepResult &result);
    /** Whether that system is so large that the exact matrix costs less. */
    bool has_many_contacts() const;
    void use_strains_of_stages();
    /** B as in the matrix of stage @p k. */
    const LinearStrains &
    strains_in_matrix(const unsigned int k) const
    {
      return is_exact ? *stage_strains[k] : *frozen_strains;
    }
    /** Add increments to the stages, twist(k, node) to twists; returns their size relative to the largest velocity. */
    template <typename Twist>
    double correct_velocities(double h, const Twist &twist);
    /** Call f(j) for the factors j, side by side if they are large. */
    void for_factors(const std::function<void(unsigned int)> &f) const;
    void correct_stresses();
    /**
     * Whether the kinetic energy comes from somewhere. In singular positions, all equations are satisfied by velocities
     * as large as one likes: no solution, whatever Newton's method says.
     */
    bool has_sources(const StepResult &result, double h) const;
    /** Of everything, at this speed. */
    double energy_of_moving(double speed) const;
    /** Where the step ends; velocities, multipliers and stresses are those of its start. */
    State at_end(const State &state, double time) const;
    /** Choose the rows to leave out in this step. */
    void choose_rows(State &state);
    /** @throws NotConverged if the step leads to where rows left out are violated: they contradict the others. */
    void check_rows_left_out(const State &state);
    /** Those of the state, made to obey the constraints. */
    const std::vector<double>  &admissible_velocities(const State &state);
    std::unique_ptr<Projection> projection; ///< for these
    State                       admissible;
    /** @name The energy account of a step (stage_integrator_account.cc) @{ */
    const AirOfSystem air;
    void              account(const State &state, double h, StepResult &result);
    void              account_for_loads(double h, StepResult &result);
    void              account_for_drives(double h, StepResult &result);
    void              account_for_dissipation(const State &state, double h, StepResult &result);
    /** @} */
    /** The state of first order that the step resolves least, of those it does not resolve; -1 if there is none. */
    int                 unresolved_state(const State &state, double h);
    std::vector<double> largest_states; ///< that there were
    /** Find where what acts is no number, for messages. */
    void find_infinite(StepResult &result) const;
    /** Tell where Newton's method has left most work, for messages. */
    void find_worst(StepResult &result) const;
    /** Σ b_k p_k ẏ_k of a node, for velocities @p start at the start of the step. */
    Vector6 highest_mode(const std::vector<double> &start, unsigned int node, double h) const;

    /** @name What a step says about its error (stage_integrator_error.cc) @{ */
    std::vector<double>              load_defect, load_sum;
    const std::vector<CountedStates> counted;     ///< groups of states of first order
    const bool                       switches;    ///< whether laws have pieces, see Term::pieces()
    std::vector<double>              state_modes; ///< of those states 1/(2(2s−1)) Σ b_k p_k ż_k, zero of others
    /** Find state_modes, and how much they are of the states over the step; relative. */
    double find_state_modes(const State &state, double h);
    void   estimate_error(const State &state, double h, StepDifference &difference);
    /** False if Newton's method does not find the neighbour with the matrix in use. */
    bool find_neighbour(const State               &state,
                        double                     h,
                        const std::vector<Stage>  &base,
                        const std::vector<double> &base_q,
                        StepDifference            &difference);
    /** What the neighbour, @p epsilon away, ends with, less what the step does. */
    void measure_neighbour(double                      h,
                           double                      epsilon,
                           const std::vector<Stage>   &base,
                           const std::vector<double>  &base_q,
                           const std::vector<Vector6> &u,
                           StepDifference             &difference) const;
    /** Velocities that the constraints allow at the end, and those that drives enforce there. */
    void project_neighbour(const State &state, double h, StepDifference &difference);
    /** Derivatives of the residuals and excesses by α, times @p epsilon; @p v are stresses. */
    void add_derivatives(const std::vector<Vector6> &u, const std::vector<double> &v, double epsilon);
    /** Residuals and excesses of the stages as they are now, less those of @p base. */
    void evaluate_difference(const State &state, double h, const std::vector<Stage> &base);
    /** The part of a field that the step resolves, by the factors there are. */
    void resolve(const StepDifference::Field &whole, StepDifference::Field &resolved);
    /**
     * The same by factors for where the step ends. A spring between points turns against the axes of what it holds: the
     * direction in which it is stiff halfway is not that at the end, and rates there would not be without its
     * vibration.
     */
    void resolve_at_end(const State &state, double h, StepDifference &difference);
    /** Of the rates in @p field, where nodes are as @p at says. */
    void                find_frequency(State at, StepDifference::Field &field);
    bool                find_load_defect(const State &state, double h);
    void                add_loads(double time, double weight, Stage &stage);
    std::vector<double> sum_of_stages(const std::vector<std::vector<double>> &values,
                                      const Eigen::VectorXd                  &weights) const;
    std::vector<double> resolved_part(const std::vector<double> &displacement);
    /** @} */
    void finish(State &state, double h);
  };



  template <typename Number, typename Rate, typename Multiplier>
  Number
  StageIntegrator::force_of(const Tableau    &tableau,
                            const double      h,
                            const double      unit,
                            const Rate       &rate,
                            const Multiplier &multiplier,
                            const Number     &mean_rate)
  {
    // where the coordinate turns less than this a step, in units, ρ is a quotient of small numbers, and the work not
    // worth mentioning; of one stage it has a limit, as the error of the mean rate goes with the turn: less will do
    const double least_turn = tableau.s == 1 ? 1e-8 : 1e-7;
    Number       lambda = 0, squares = 0;
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        const Number turn = h / unit * rate(k);
        lambda += tableau.b(k) * multiplier(k);
        squares += tableau.b(k) * (turn * turn);
      }
    const double per_unit = h / unit;
    return lambda * (per_unit * per_unit * mean_rate * squares / (squares * squares + std::pow(least_turn, 4)));
  }
} // namespace samara

#endif
