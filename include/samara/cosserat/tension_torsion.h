#ifndef samara_cosserat_tension_torsion_h
#define samara_cosserat_tension_torsion_h

#include <samara/cosserat/cosserat.h>
#include <samara/model/strain_products.h>
#include <samara/section/trapeze.h>

namespace samara
{
  /**
   * What tension does to the torsion of a beam (Trapeze): one energy more at each of its points of integration,
   *
   *     ½ q f²       f = ½ κ² + γ,   κ = K₁,   γ = p·e/q
   *
   * beside the beam's own with the stiffness C − p pᵀ/q, so that both together are ½ eᵀ C e + ½ κ² p·e + ⅛ q κ⁴.
   * Strains of a point are κ [1/m], γ and f [1/m²], stresses σ_κ = s κ, s = q f and nothing, so that Bᵀσ with the rows
   * of κ and γ alone is the force. f is no quadratic strain: it is a product (StrainProduct), and steps keep its energy
   * because they integrate κ κ̇ as exactly as κ̇.
   */
  class TensionTorsion : public EvaluatedDeformation<TensionTorsion>
  {
  public:
    /** @p of_material: of each material of the @p beam, which have the stiffness C − p pᵀ/q. */
    TensionTorsion(const Cosserat<1> &beam, const std::vector<Trapeze> &of_material);

    void add_products(std::vector<StrainProduct> &products) const;

    unsigned int n_strains() const override;
    void         strain_rates(const Point<double> &point, double *rates) const override;
    void         tangent(const Point<double> &point, SparseMatrix &K) const override;
    void         strain_rows(const Point<double> &point, StrainRows &rows) const override;
    double       strain_energy(const double *e) const override;
    double       power(const double *stress, const double *rates) const override;

    template <typename Number>
    void strains_at(const Point<Number> &point, Number *e) const;
    template <typename Number>
    void stresses_of(const Number *e, const Number *rates, Number *stress) const;
    template <typename Number>
    void residual_at(const Point<Number> &point, Number *r) const;

    /** The section forces that @p stress of all strains of the model means at integration point @p g [N, N m]. */
    Vector6 section_forces(unsigned int g, const double *stress) const;

    /** The part of them that belongs to no small strain but to helical fibres: s κ, and ½ κ² p [N, N m]. */
    Vector6 helical_forces(unsigned int g, const double *stress, double twist) const;

  private:
    const Cosserat<1>         &beam;
    const std::vector<Trapeze> of_material;
    std::vector<Vector6>       ratios; ///< p/q of them; zero where there is none

    static constexpr unsigned int of_twist = 0, of_rest = 1, of_both = 2, n = 3; ///< strains of a point

    const Trapeze &trapeze(unsigned int g) const;
    const Vector6 &ratio(unsigned int g) const;

    /** Section forces of all points, for the beam's own functions. */
    template <typename Number>
    const std::vector<Number> &all_section_forces(const Number *stress) const;
  };

  extern template class Evaluated<TensionTorsion, Deformation>;
  extern template class EvaluatedDeformation<TensionTorsion>;
} // namespace samara

#endif
