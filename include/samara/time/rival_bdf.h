#ifndef samara_time_rival_bdf_h
#define samara_time_rival_bdf_h

#include <samara/time/projection.h>
#include <samara/time/rival_parts.h>

namespace samara
{
  /**
   * Backward differentiation formulas of variable order, 1 to 5, and step by IDA of SUNDIALS (Hindmarsh et al. 2005),
   * on one of two forms of the equations with an unknown position x and quaternion p for each node, D = D(p/|p|):
   *
   *     index 1                                        stabilised index 2 (Gear, Gupta & Leimkuhler 1985)
   *     Dᵀẋ = v, 2 Im(p̄ ṗ)/|p|² = Ω                    W ((Dᵀẋ, 2 Im(p̄ ṗ)/|p|²) − y) + Gᵀμ = 0
   *     M ẏ + f(q, y, t) + Gᵀλ = 0                     M ẏ + f(q, y, t) + Gᵀλ = 0
   *     d/dt (G y + ∂g/∂t) = 0                         g(q, t) = 0,   G y + ∂g/∂t = 0
   *
   * and Re(p̄ ṗ) = 0; W is M for nodes and 1 for joint coordinates. Index 1 has the accelerations' constraints alone:
   * errors of g and of its rate are never made good.
   *
   * IDA chooses its steps by the relative tolerance for positions, quaternions and velocities; multipliers are left out
   * of its tests. It goes on over many calls of step(), each of which ends one of its steps, and starts anew, with
   * order one, where step_back() or forget_history() has been called and at corners of what is prescribed.
   * `n_iterations` are IDA's nonlinear iterations, `n_factorizations` its Jacobian matrices, `n_steps` the calls.
   */
  class Bdf : public Integrator
  {
  public:
    enum class Form
    {
      index_1,
      stabilised_index_2
    };

    /** @throws std::runtime_error if IDA cannot be set up. */
    Bdf(const System &system, Form form, const IntegratorSettings &settings);
    ~Bdf() override;
    Bdf(const Bdf &)            = delete;
    Bdf &operator=(const Bdf &) = delete;

    StepResult step(State &state, double h) override;
    void       forget_history() override;
    void       step_back() override;

    unsigned int n_internal_steps = 0; ///< of IDA

  private:
    struct Ida; ///< the objects of SUNDIALS

    const System            &system;
    const Form               form;
    const IntegratorSettings settings;
    std::unique_ptr<Ida>     ida;
    rivals::Measure          measure;
    Projection               projection;
    rivals::PairMatrix       matrix;
    SparseMatrix             M, C, K, before, after;
    std::vector<bool>        is_active, is_nonholonomic;
    bool                     is_running = false;
    double                   last_time  = 0; ///< not beyond it: before a corner

    /** @name Places in IDA's vector @{ */
    const unsigned int n_poses; ///< x and p of all nodes
    unsigned int       n_kinematic, of_velocities, of_multipliers, of_second_multipliers, size;
    /** @} */

    State work; ///< the model's part at the point that is evaluated
    struct Jacobian
    {
      double               cj = 1;
      std::vector<double>  p;          ///< all of the vector where it was made
      std::vector<Matrix6> kinematics; ///< derivative of (Dᵀẋ, 2 Im(p̄ ṗ)/|p|²) by ζ
    } jacobian;

    void pack(const State &state, const std::vector<double> &accelerations, double *z, double *z_dot) const;
    void unpack(double time, const double *z, State &state) const;
    void start(State &state, double h);
    /** IDA's steps from @p now to @p end, with the work of trapezoids; false if it finds no way. */
    bool integrate(double end, State &now, rivals::Powers &work_done);
    void residual(double time, const double *z, const double *z_dot, double *r);
    void make_jacobian(double time, double cj, const double *z, const double *z_dot);
    /** The parts of it. Kinematic rows: by poses, and by velocities. @{ */
    void make_kinematic_blocks(double        cj,
                               const double *z,
                               const double *z_dot,
                               SparseMatrix &kinematics,
                               SparseMatrix &weights);
    /** Add G ad_y: how constraints change as nodes carry their frames along. */
    void add_change_of_constraints(SparseMatrix &change) const;
    void fill_matrix(double              cj,
                     double              dt,
                     const SparseMatrix &kinematics,
                     const SparseMatrix &weights,
                     const SparseMatrix &carried);
    /** @} */
    void solve(double *b) const;

    Vector6             rate_of_pose(const double *z, const double *z_dot, unsigned int node) const;
    std::vector<double> acceleration_constraints(const State &state, const std::vector<double> &y_dot) const;
    double              difference_time(const State &state) const;
    /** The state after dt on the path of constant twists. */
    State after_time(const State &state, double dt) const;
    /** Gᵀμ */
    std::vector<double> constraint_forces(const State &state, const double *mu) const;
  };



  /** With positions and velocities that obey the constraints. */
  class BdfIndex2 : public Bdf
  {
  public:
    BdfIndex2(const System &system, const IntegratorSettings &settings)
      : Bdf(system, Form::stabilised_index_2, settings)
    {}
  };

  /** With the constraints of accelerations alone. */
  class BdfIndex1 : public Bdf
  {
  public:
    BdfIndex1(const System &system, const IntegratorSettings &settings)
      : Bdf(system, Form::index_1, settings)
    {}
  };
} // namespace samara

#endif
