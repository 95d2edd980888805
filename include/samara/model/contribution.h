#ifndef samara_model_contribution_h
#define samara_model_contribution_h

#include <samara/base/parameters.h>
#include <samara/model/drawing.h>
#include <samara/model/linear_strains.h>
#include <samara/model/matrix.h>
#include <samara/model/state.h>

#include <complex>
#include <functional>
#include <limits>
#include <memory>
#include <optional>

namespace samara
{
  class Model;
  class Layout;
  class StrainRows;

  /** A number that can be asked of a state: a column of the histories. */
  struct Probe
  {
    std::string                          name, unit;
    std::function<double(const State &)> value;
  };



  /**
   * Everything in a model: bodies, joints, loads. A contribution has a name, adds nodes, coordinates and multipliers to
   * the model, and then forces, constraints and their derivatives to the system.
   *
   * Its life: construct → add_parameters() → (parse) → initialize() → connect() → assembly. After connect() it is
   * constant: all that changes is in the State.
   *
   * What it computes (doc/theory/statics.md), with ζ the increments of nodes (twists in the nodes' frames), of joint
   * coordinates and multipliers:
   *
   * - strains e, quadratic in the coordinates, and stresses σ = C e + C_d ė, C and C_d constant;
   * - residual rows: Bᵀσ + Gᵀλ − loads for nodes and joint coordinates, constraints g for multipliers;
   * - tangent: the derivative of the residual with respect to ζ with δσ = C B ζ; damping: with respect to ζ̇, δσ = C_d B
   * ζ̇.
   *
   * Signs: the residual is internal minus applied force. Units: SI throughout.
   */
  class Contribution
  {
  public:
    virtual ~Contribution() = default;

    std::string name, kind;
    Parameters  parameters;

    /** There has been a complaint about it: it is not initialized, or not to its end, and must not be used. */
    bool is_faulty = false;

    /** Bind every entry this kind has in the input file to a variable. */
    virtual void
    add_parameters(Parameters &)
    {}

    /** Turn names into references, check values, add nodes and welds. Complaints go to the model. */
    virtual void initialize(Model &model) = 0;

    /**
     * Make a relative motion ("rotation", "displacement"; "" if there is only one) an unknown and return its number among
     * the model's coordinates; nothing if there is no such motion. To be called from initialize().
     */
    virtual std::optional<unsigned int>
    use_coordinate(Model &, const std::string & /*motion*/)
    {
      return {};
    }

    /** The relative motions among these that are rotations. */
    virtual std::vector<std::string>
    rotation_names() const
    {
      return {};
    }

    /** Take numbers for multipliers and strains, and say which unknowns are coupled. */
    virtual void
    connect(Layout &)
    {}

    /** @name Assembly; @p e and @p stress start at this contribution's own first strain, residuals are global. @{ */
    virtual unsigned int
    n_strains() const
    {
      return 0;
    }
    virtual void strains(const Point<double> &, double *) const {}
    virtual void strains(const Point<std::complex<double>> &, std::complex<double> *) const {}

    /** Rates of the strains, B times the velocities (y, rates) of the point. */
    virtual void strain_rates(const Point<double> &, double *) const {}

    /** σ = C e + C_d ė */
    virtual void stresses(const double * /*e*/, const double * /*rates*/, double * /*stress*/) const {}
    virtual void
    stresses(const std::complex<double> *, const std::complex<double> *, std::complex<double> *) const
    {}

    virtual void residual(const Point<double> &, double *) const {}
    virtual void residual(const Point<std::complex<double>> &, std::complex<double> *) const {}
    virtual void tangent(const Point<double> &, SparseMatrix &) const {}
    virtual void damping(const Point<double> &, SparseMatrix &) const {}

    /**
     * Offer B, C and C_d of all strains, for matrices in which stresses are unknowns. Whoever does leaves BᵀCB and
     * BᵀC_dB out of tangent() and damping() where the point is without material.
     */
    virtual void strain_rows(const Point<double> &, StrainRows &) const {}

    /** The rows of the residual that hold constraints, where only they are wanted; others may change, too. */
    virtual void
    constraints(const Point<double> &point, double *r) const
    {
      residual(point, r);
    }

    /** Rates of this contribution's constraints, ġ = G y + ∂g/∂t, into the global array of multipliers. */
    virtual void constraint_rates(const Point<double> &, double *) const {}
    /** The part ∂g/∂t alone. */
    virtual void constraint_time_rates(const Point<double> &, double *) const {}

    /** Give coordinates that are angles those of the nodes, in the turn nearest to what they are. */
    virtual void
    follow_angles(State &) const
    {}

    /** Whether the residual has loads in it besides σ and λ, and whether σ has viscous parts. */
    virtual bool
    has_loads() const
    {
      return false;
    }
    virtual bool
    has_damping() const
    {
      return false;
    }

    /** Potential energy of the loads that have one [J]; they count as loads otherwise. */
    virtual double
    potential_energy(const Point<double> &) const
    {
      return 0;
    }

    /** For repeated use of one B. By default strain_rates() and residual() do it; what has many strains can be faster. */
    virtual std::unique_ptr<LinearStrains> linear_strains() const;

    /** σᵀ ė, integrated [W]. */
    virtual double
    power(const double *stress, const double *rates) const
    {
      double sum = 0;
      for (unsigned int i = 0; i < n_strains(); ++i)
        sum += stress[i] * rates[i];
      return sum;
    }

    /** ½ eᵀ C e, integrated [J]. */
    virtual double
    strain_energy(const double * /*e*/) const
    {
      return 0;
    }
    /** @} */

    /**
     * First time in (from, to) where something this contribution prescribes has a corner or a jump; infinity if none.
     * Time steps end there.
     */
    virtual double
    next_corner(double /*from*/, double /*to*/) const
    {
      return std::numeric_limits<double>::infinity();
    }

    /** Add what the user says of this contribution's velocities at the start to the twists of its nodes. */
    virtual void
    add_initial_velocities(State &) const
    {}

    /** The probe for a path such as "middle.displacement y"; nothing if there is no such thing. */
    virtual std::optional<Probe>
    probe(const std::string &) const
    {
      return {};
    }

    /** What probe() understands, for messages and the documentation. */
    virtual std::vector<std::string>
    probe_names() const
    {
      return {};
    }

    virtual void
    draw(const State &, Drawing &) const
    {}

    /** Where the mesh is too coarse for this state and why, for a warning; empty if it is fine enough. */
    virtual std::string
    coarse_place(const State &) const
    {
      return {};
    }

    /** First strain of this contribution in the state's stress, set by the layout. */
    unsigned int first_strain = 0;
  };



  /**
   * Writes the virtual functions of a contribution for double and for std::complex<double> from the one template that
   * @p Derived has of each: strains_at, residual_at, stresses_of.
   */
  template <typename Derived, typename Base = Contribution>
  class Evaluated : public Base
  {
  public:
    void
    strains(const Point<double> &point, double *e) const override
    {
      self().strains_at(point, e);
    }
    void
    strains(const Point<std::complex<double>> &point, std::complex<double> *e) const override
    {
      self().strains_at(point, e);
    }
    void
    stresses(const double *e, const double *rates, double *stress) const override
    {
      self().stresses_of(e, rates, stress);
    }
    void
    stresses(const std::complex<double> *e, const std::complex<double> *r, std::complex<double> *stress) const override
    {
      self().stresses_of(e, r, stress);
    }
    void
    residual(const Point<double> &point, double *r) const override
    {
      self().residual_at(point, r);
    }
    void
    residual(const Point<std::complex<double>> &point, std::complex<double> *r) const override
    {
      self().residual_at(point, r);
    }

    /** Contributions without strains need not say so. */
    template <typename Number>
    void
    strains_at(const Point<Number> &, Number *) const
    {}
    template <typename Number>
    void
    stresses_of(const Number *, const Number *, Number *) const
    {}

  private:
    const Derived &
    self() const
    {
      return static_cast<const Derived &>(*this);
    }
  };
} // namespace samara

#endif
