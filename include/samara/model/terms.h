#ifndef samara_model_terms_h
#define samara_model_terms_h

#include <samara/model/linear_strains.h>
#include <samara/model/matrix.h>

#include <complex>
#include <limits>
#include <memory>
#include <vector>

/**
 * @file
 * The terms of the equations of motion. Items add them to the layout; System alone goes over them.
 *
 *     residual        r = Bᵀσ + Gᵀλ − f      of nodes and joint coordinates
 *                     −g_z                   of states of first order, ż = g_z
 *                     g                      of multipliers
 *
 * with the stresses σ of Deformations, the multipliers λ of Constraints and the Forces f. A tangent is the derivative
 * of the residual by the increments ζ of nodes (twists in the nodes' frames), coordinates and multipliers with δσ = C B
 * ζ; a damping matrix that by their rates ζ̇, with δσ = C_d B ζ̇ (doc/theory/statics.md).
 *
 * Signs: the residual is internal minus applied force. Units: SI throughout. Residuals and matrices are global.
 */

namespace samara
{
  class Item;
  class StrainRows;

  /** What all terms have. After Layout has taken it, a term is constant. */
  class Term
  {
  public:
    virtual ~Term() = default;

    /** Whose term it is, for messages. */
    const Item *item = nullptr;

    /** Add the term to the residual. */
    virtual void residual(const Point<double> &, double *r) const                             = 0;
    virtual void residual(const Point<std::complex<double>> &, std::complex<double> *r) const = 0;

    virtual void
    tangent(const Point<double> &, SparseMatrix &) const
    {}
    virtual void
    damping(const Point<double> &, SparseMatrix &) const
    {}

    /**
     * On which of their pieces laws of the state are that switch, by comparisons, abs(), min(), …: appended to @p
     * pieces. Time steps end where any of them changes.
     */
    virtual void
    pieces(const Point<double> &, std::vector<double> & /*pieces*/) const
    {}

    /**
     * First time in (from, to) where something this term prescribes has a corner or a jump; infinity if none. Time
     * steps end there.
     */
    virtual double
    next_corner(double /*from*/, double /*to*/) const
    {
      return std::numeric_limits<double>::infinity();
    }
  };



  /**
   * Strains e, quadratic in the coordinates, and stresses σ = C e + C_d ė, C and C_d constant; the residual is Bᵀσ with
   * the stress of the point. All pointers to strains and stresses start at the term's own first one.
   */
  class Deformation : public Term
  {
  public:
    /** Of its strains among those of the state, set by the layout. */
    unsigned int first_strain = 0;

    virtual unsigned int n_strains() const = 0;

    virtual void strains(const Point<double> &, double *) const                             = 0;
    virtual void strains(const Point<std::complex<double>> &, std::complex<double> *) const = 0;

    /** Rates of the strains, B times the velocities (y, rates) of the point. */
    virtual void strain_rates(const Point<double> &, double *) const = 0;

    /** σ = C e + C_d ė */
    virtual void stresses(const double * /*e*/, const double * /*rates*/, double * /*stress*/) const                = 0;
    virtual void stresses(const std::complex<double> *, const std::complex<double> *, std::complex<double> *) const = 0;

    /** ½ eᵀ C e, integrated [J]. */
    virtual double strain_energy(const double *e) const = 0;

    /** σᵀ ė, integrated [W]. */
    virtual double
    power(const double *stress, const double *rates) const
    {
      double sum = 0;
      for (unsigned int i = 0; i < n_strains(); ++i)
        sum += stress[i] * rates[i];
      return sum;
    }

    /** Whether C_d is not zero. */
    virtual bool
    is_viscous() const
    {
      return false;
    }

    /** For repeated use of one B. By default strain_rates() and residual() do it; what has many strains can be faster.
     */
    virtual std::unique_ptr<LinearStrains> linear_strains() const;

    /**
     * This one and others of its kind among @p terms as one deformation, where they are computed faster together: they
     * are taken out of @p terms. Null, and nothing is changed, where they are not. Strains keep their places: the first
     * strain of what is returned is 0, the first of the layout. It is for strains, their rates, stresses, the residual
     * and linear_strains().
     */
    virtual std::unique_ptr<Deformation>
    joined(std::vector<const Deformation *> & /*terms*/) const
    {
      return nullptr;
    }

    /**
     * Offer B, C and C_d of all strains, for matrices in which stresses are unknowns. Whoever does leaves BᵀCB and
     * BᵀC_dB out of tangent() and damping() where the point is without material.
     */
    virtual void
    strain_rows(const Point<double> &, StrainRows &) const
    {}

    /** strain_rates() and residual() of one point, where both are wanted. */
    virtual void
    strain_rates_and_residual(const Point<double> &point, double *rates, double *r) const
    {
      strain_rates(point, rates);
      residual(point, r);
    }
  };



  /**
   * Constraints with multipliers. The residual is Gᵀλ in the rows of nodes and coordinates and g in those of the
   * multipliers; 0 for constraints on velocities alone, whose tangent row is what they prescribe
   * (Layout::nonholonomic).
   */
  class Constraint : public Term
  {
  public:
    /** The rows that hold g, where only they are wanted; others may change, too. */
    virtual void
    constraints(const Point<double> &point, double *r) const
    {
      residual(point, r);
    }

    /**
     * ġ = G y + ∂g/∂t, into the global array of multipliers. Places alone say what it is: of reciprocal axes it may
     * only ask whether the point has them, where a rate is defined otherwise then.
     */
    virtual void rates(const Point<double> &, double *) const = 0;

    /** residual() and rates() of one point, where g itself is not wanted: its rows of @p r are left undefined. */
    virtual void
    forces_and_rates(const Point<double> &point, double *r, double *all_rates) const
    {
      residual(point, r);
      rates(point, all_rates);
    }

    /** The part ∂g/∂t alone: of rows that are among Model::prescribed. */
    virtual void
    time_rates(const Point<double> &, double *) const
    {}

    /** Give coordinates that are angles those of the nodes, in the turn nearest to what they are. */
    virtual void
    follow_angles(State &) const
    {}

    /**
     * g̈ where no velocity changes, Ġ y + d(∂g/∂t)/dt: nodes move along y, coordinates along their rates. Into the
     * global array of multipliers, which is zero before. NaN of what a law of states prescribes, whose states move,
     * too.
     */
    virtual void second_rates(const Point<double> &, double *) const = 0;
  };



  /** Loads: the residual is −f(q, y, t). */
  class Force : public Term
  {
  public:
    /** Whether its work is the loss of a potential. */
    virtual bool
    has_potential() const
    {
      return false;
    }
    virtual double
    potential_energy(const Point<double> &) const // [J]
    {
      return 0;
    }
  };



  /**
   * Equations of states of first order, ż = g(q, y, z, t): the residual of their rows is −g. Where nothing moves in
   * time they say g = 0.
   */
  class StateEquation : public Term
  {};



  /** Writes the residual of a term for double and std::complex<double> from the template @p Derived has, residual_at.
   */
  template <typename Derived, typename Base>
  class Evaluated : public Base
  {
  public:
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

  protected:
    const Derived &
    self() const
    {
      return static_cast<const Derived &>(*this);
    }
  };



  /** The same for strains and stresses from strains_at and stresses_of. */
  template <typename Derived>
  class EvaluatedDeformation : public Evaluated<Derived, Deformation>
  {
  public:
    void
    strains(const Point<double> &point, double *e) const override
    {
      this->self().strains_at(point, e);
    }
    void
    strains(const Point<std::complex<double>> &point, std::complex<double> *e) const override
    {
      this->self().strains_at(point, e);
    }
    void
    stresses(const double *e, const double *rates, double *stress) const override
    {
      this->self().stresses_of(e, rates, stress);
    }
    void
    stresses(const std::complex<double> *e, const std::complex<double> *r, std::complex<double> *stress) const override
    {
      this->self().stresses_of(e, r, stress);
    }
  };
} // namespace samara

#endif
