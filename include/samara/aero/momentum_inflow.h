#ifndef samara_aero_momentum_inflow_h
#define samara_aero_momentum_inflow_h

#include <samara/aero/finite_state.h>
#include <samara/aero/inflow.h>
#include <samara/model/counted_states.h>
#include <samara/model/doubts.h>

#include <cmath>

namespace samara
{
  /**
   * Inflow whose states obey momentum theory, see FiniteStateInflow: what the surfaces that name it push against the
   * air along the thrust axis drives it, the flow of wind and flight through the disk carries it away.
   *
   * Momentum theory has no stream tube where the rotor descends into its own wake, −2 < λ_f/ν_h < 0 with ν_h the flow
   * of hover under the same thrust: results are smooth there and not to be trusted, and there is a doubt beyond −0.3.
   */
  class MomentumInflow : public Inflow, public Evaluated<MomentumInflow, StateEquation>, public HasCountedStates
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;
    void connect(Layout &layout) override;

    template <typename Number>
    void residual_at(const Point<Number> &point, Number *r) const;
    void tangent(const Point<double> &point, SparseMatrix &K) const override;
    void damping(const Point<double> &point, SparseMatrix &C) const override;

    std::vector<Doubt> doubts(const State &state) const override;

    /** By the energy of the air, ½ρR³ Σ M_k z_k²/load_weights[k]; a flow without mass has none. */
    std::vector<CountedStates> counted_states() const override;

  protected:
    virtual FiniteStateInflow make() const = 0;

    /** Entry for the mass of the mean flow. */
    void add_apparent_mass(Parameters &prm);

    double mean(const State &state) const override;

  private:
    FiniteStateInflow theory;
    double            initial       = 0;
    double            apparent_mass = 0;
    bool              gives_mass    = false; ///< whether there is the entry for it
    bool              is_algebraic  = false; ///< the mean flow, without mass
    std::string       ground_effect = "none";
    Block             block; ///< hub, states

    /** Speed below which air counts as still [m/s]. */
    double least_speed() const;
    double still_speed(const Point<double> &point) const;

    template <typename Number>
    FiniteStateInflow::Vector<Number> values(const Point<Number> &point) const;
    template <typename Number>
    FiniteStateInflow::Flight<Number> flight(const Point<Number> &point) const;

    /**
     * Where the model turns steadily, amplitudes of harmonics are constant in axes that turn with the blades alone.
     * @throws InputError if blades turn and the hub does not turn with them
     */
    void check_axes(const Point<double> &point) const;

    /** K without what follows from twists, and C; 6 columns of the hub, then states. */
    void differentiate(const Point<double> &point, Eigen::MatrixXd &K, Eigen::MatrixXd &C) const;
  };



  /**
   * The mean flow alone, of H. Glauert. It follows the thrust with the time constant M R/(2 V_T), M its apparent mass:
   * that of a rigid disk, or zero, where momentum theory holds at once: T = 2ρA V_T ν, an algebraic state.
   */
  class UniformInflow : public MomentumInflow
  {
  public:
    void
    add_parameters(Parameters &prm) override
    {
      MomentumInflow::add_parameters(prm);
      add_apparent_mass(prm);
    }

  protected:
    FiniteStateInflow
    make() const override
    {
      return FiniteStateInflow::uniform();
    }
  };



  class PittPetersInflow : public MomentumInflow
  {
  public:
    void
    add_parameters(Parameters &prm) override
    {
      MomentumInflow::add_parameters(prm);
      add_apparent_mass(prm);
    }

  protected:
    FiniteStateInflow
    make() const override
    {
      return FiniteStateInflow::pitt_peters();
    }
  };



  class PetersHeInflow : public MomentumInflow
  {
  public:
    void add_parameters(Parameters &prm) override;

  protected:
    FiniteStateInflow
    make() const override
    {
      return FiniteStateInflow::peters_he(harmonics, power, mass_flow == "first state");
    }

  private:
    unsigned int harmonics = 4, power = 8;
    std::string  mass_flow = "uniform load";
  };

  extern template class Evaluated<MomentumInflow, StateEquation>;
} // namespace samara

#endif
