#ifndef samara_aero_external_inflow_h
#define samara_aero_external_inflow_h

#include <samara/aero/inflow.h>
#include <samara/model/counted_states.h>

namespace samara
{
  /**
   * Inflow of a theory of one's own: places and loads of stations out, induced velocities in. Whoever derives from it
   * says how many states z there are, what velocity at a place a unit of each makes, and which value of z the loads ask
   * for; z follows that with a time constant,
   *
   *     v(x) = A(x, flow) z      τ ż_k = Σ_stations b_k(x, flow) F − z_k
   *
   * Everything is seen from the hub, axis 3 the thrust axis: x [m] from its centre; v [m/s]; F [N] the force of the
   * station's part of the blade along the thrust axis; the flow μ₁, μ₂ across the disk and λ_f against the thrust axis
   * of the air without the rotor [m/s], and the height above the ground. A and b are asked for in doubles and in
   * complex numbers with imaginary parts so small that their squares are lost: these are the derivatives, so that write
   * one template and decide by real parts. A place is that of a quarter chord; the hub may turn or not.
   *
   * HelicalWake is an example. How to register a kind: doc/theory/aerodynamics.md, "A wake of one's own".
   */
  class ExternalInflow : public Inflow, public Evaluated<ExternalInflow, StateEquation>, public HasCountedStates
  {
  public:
    template <typename Number>
    using Flow    = DiskCorrections::Flow<Number>;
    using Complex = std::complex<double>;

    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;
    void connect(Layout &layout) override;

    bool
    is_sum_of_shapes() const override
    {
      return false;
    }

    /** States of one unit together. */
    std::vector<CountedStates> counted_states() const override;

    /** A, column by column, 3 numbers for each state. @{ */
    virtual void velocities(const Vec3<double> &x, const Flow<double> &flow, double *A) const    = 0;
    virtual void velocities(const Vec3<Complex> &x, const Flow<Complex> &flow, Complex *A) const = 0;
    /** @} */

    /** b, a number for each state. @{ */
    virtual void drives(const Vec3<double> &x, const Flow<double> &flow, double *b) const    = 0;
    virtual void drives(const Vec3<Complex> &x, const Flow<Complex> &flow, Complex *b) const = 0;
    /** @} */

    /** Which of the numbers of the flow through the disk velocities() and drives() depend on: derivatives by the others
     * are not computed. */
    virtual bool
    sees(const unsigned int /*number*/) const
    {
      return true;
    }

    /** Told once of each station: its place in the reference configuration, and the length it stands for [m]. */
    virtual void
    add_station(const Vector3 & /*x*/, double /*length*/)
    {}

    /** v(x) */
    template <typename Number>
    Vec3<Number>
    velocity(const Vec3<Number> &x, const Flow<Number> &flow, const Number *z) const
    {
      thread_local std::vector<Number> A;
      A.resize(3 * states.size());
      velocities(x, flow, A.data());
      Vec3<Number> sum = Vec3<Number>::Zero();
      for (unsigned int k = 0; k < states.size(); ++k)
        for (unsigned int i = 0; i < 3; ++i)
          sum(i) += A[3 * k + i] * z[k];
      return sum;
    }

    /** Derivatives at a place, by complex steps: of v by x (3), flow (5) and z, of b by x and flow. */
    struct Derivatives
    {
      Eigen::Matrix<double, 3, 8>              velocity;
      Eigen::Matrix<double, 3, Eigen::Dynamic> by_states;
      Eigen::Matrix<double, Eigen::Dynamic, 8> drives;
    };
    Derivatives derivatives(const Vector3 &x, const Flow<double> &flow, const std::vector<double> &z) const;

    template <typename Number>
    void residual_at(const Point<Number> &point, Number *r) const;
    void tangent(const Point<double> &point, SparseMatrix &K) const override;

  protected:
    /** Name and unit of each state; to be known when the entries are read. @throws std::invalid_argument */
    virtual std::vector<std::pair<std::string, std::string>> names_of_states(Model &model) = 0;

  private:
    double                   time_constant = 0.1;
    Block                    block; ///< states
    std::vector<std::string> units; ///< of the states
  };

  extern template class Evaluated<ExternalInflow, StateEquation>;
} // namespace samara

#endif
