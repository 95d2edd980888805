#ifndef samara_time_stage_rotation_h
#define samara_time_stage_rotation_h

#include <samara/model/system.h>

#include <vector>

namespace samara
{
  /**
   * What makes steady rotation an equilibrium of a step (doc/theory/steady_rotation.md, "In time").
   *
   * In steady rotation the triads of a stage are D_k = S_k D_i with S_k = √r_k times a rotation across the axis, and 1
   * along it: they are not orthonormal. Strains and constraints are quadratic, so their forces on directors are F_k =
   * S_k F_i. Seen in the reciprocal triads, D_k⁻¹F_k = D_i⁻¹F_i, they stay what they are; D_kᵀF_k does not. The work
   * that D_k⁻¹ does too much is taken back by one number c_k of each set of bodies that hold one another:
   *
   *     … + N(D_k⁻ᵀ)ᵀ F_k − c_k M (y_k − ȳ) = 0      c_k = Σ yᵀ (N(D_k⁻ᵀ) − N(D_k))ᵀ F / Σ yᵀ M (y − ȳ)
   *
   * ȳ is the motion of the set's centre of mass where nothing holds the set, so that its momentum stays, else 0. c_k is
   * zero in steady rotation, and of the order of the scheme in other motions.
   */
  class StageRotation
  {
  public:
    /** @p state: any configuration of the model, without prestress that counts. */
    StageRotation(const System &system, const State &state);

    /**
     * Whether a step @p h [s] of @p s stages with the twists @p y, 6 a node, turns so far that triads of stages are not
     * orthonormal: 1 − r_k > @p part.
     */
    static bool counts(unsigned int s, double h, const std::vector<double> &y, double part);

    /** D⁻ᵀ of all nodes but the ground, whose directors are orthonormal; 12 numbers a node like @p q. */
    template <typename Number>
    static void set_reciprocal(const Number *q, unsigned int n_nodes, std::vector<Number> &reciprocal);

    /** The same with the rotations nearest to the triads, see Point::nearest. */
    template <typename Number>
    static void set_nearest(const Number *q, unsigned int n_nodes, std::vector<Number> &nearest);

    unsigned int
    n_sets() const
    {
      return is_free.size();
    }

    /** Add to the powers of all sets [W]: of the rows of nodes and coordinates of the residual @p r. */
    template <typename Number>
    void add_powers_of_rows(const Number *y, const Number *rates, const Number *r, Number *powers) const;

    /** @name Subtract what they ought to be @{ */
    void subtract_powers_of_strains(const double *stress, const double *strain_rates, double *powers) const; ///< Σ σᵀė
    /** Σ λ (ġ − ∂g/∂t): a row that prescribes a coordinate has its rate for G y. */
    void subtract_powers_of_constraints(const double *multipliers,
                                        const double *constraint_rates,
                                        const double *rates,
                                        double       *powers) const;
    /** @} */

    /** Add −c_k M (y − ȳ) to @p r, with the powers that are left; @p momenta: M y, 6 a node. */
    template <typename Number>
    void take_back(const Number *q,
                   const Number *reciprocal,
                   const Number *y,
                   const Number *momenta,
                   const Number *powers,
                   Number       *r) const;

  private:
    const System             &system;
    std::vector<unsigned int> set_of_node, set_of_coordinate, set_of_multiplier, set_of_strain;
    std::vector<bool>         is_free; ///< of sets: no row feels a displacement of all its bodies

    /** The momenta of @p momenta against those of the sets' centres of mass, where these are free. */
    template <typename Number>
    void subtract_mean_motion(const Number *q, const Number *reciprocal, const Number *momenta, Number *relative) const;
    void find_sets(const State &state);
    void find_free_sets(const State &state);
  };
} // namespace samara

#endif
