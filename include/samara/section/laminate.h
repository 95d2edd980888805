#ifndef samara_section_laminate_h
#define samara_section_laminate_h

#include <samara/section/section_mesh.h>

#include <string>

namespace samara
{
  /** A layer of a laminate. */
  struct Lamina
  {
    Matrix6 stiffness = Matrix6::Zero(); ///< in the axes of the material, Voigt order 11 22 33 23 13 12 [Pa]
    double  angle     = 0;               ///< of the fibre from axis 1 towards axis 2 of the laminate [rad]
    double  thickness = 0;               ///< [m]
    double  density   = 0;               ///< [kg/m³]
  };



  /**
   * The stiffness of a laminate by warping of dimension 1, through the thickness z from bottom to top, z = 0 at the
   * middle. Plate strains in the order of this program's shells:
   *
   *     (ε₁₁ γ₁₂ ε₂₂ | κ₁₁ 2κ₁₂ κ₂₂),   ε(z) = ε + z κ,      forces N (per length) [N/m] and moments M [N]
   *
   * The warping that minimises the energy at constant plate strains leaves σ₁₃ = σ₂₃ = σ₃₃ = 0 at each point: the
   * membrane and bending stiffness is that of classical lamination, integrated exactly through each ply.
   *
   * Transverse shear (γ₁₃ γ₂₃) by equilibrium (Rohwer 1988; Rolfes & Rohwer 1997): the shear stresses that balance
   * bending stresses of slowly varying moments, τ(z) = f(z) Q with f = −∫ (σ₁₁ σ₁₂; σ₁₂ σ₂₂), have the energy ½ Qᵀ G⁻¹
   * Q, G⁻¹ = ∫ fᵀ g⁻¹ f dz, g the stiffness of the ply. A homogeneous plate has 5/6 exactly.
   *
   * Or by the asymptotic rule (Sutyrin 1997; Yu, Hodges & Volovoi 2002): the plate of Reissner's kind whose energy is
   * nearest to that of second order in thickness over length, by least squares over the terms of the energy, each
   * relative to the diagonal of ABD. What a shift of the reference plane explains is left out of it.
   */
  class Laminate
  {
  public:
    enum class TransverseShear
    {
      equilibrium,
      asymptotic
    };

    /** From the bottom. @throws std::invalid_argument without laminae, or if one has no thickness or no positive
     * energy, or if the asymptotic rule finds none. */
    explicit Laminate(const std::vector<Lamina> &laminae, TransverseShear rule = TransverseShear::equilibrium);

    double          thickness = 0;
    Matrix6         ABD;                                 ///< in the order above
    Eigen::Matrix2d shear;                               ///< G of (γ₁₃ γ₂₃) [N/m]
    double          mass        = 0;                     ///< per area [kg/m²]
    double          mass_moment = 0, rotary_inertia = 0; ///< ∫ρ z, ∫ρ z² [kg/m, kg]

    /**
     * Voigt stresses at the height @p z of the lamina @p index in the laminate's axes [Pa], from plate strains and
     * shear forces Q [N/m]; σ₃₃, which is smaller than these, is zero: see stress_across().
     */
    Vector6 stress(unsigned int index, double z, const Vector6 &strains, const Eigen::Vector2d &Q) const;

    /** Bending stiffness, for κ₁₁ 2κ₁₂ κ₂₂, if the middle is free to stretch [N m]. */
    Matrix3 free_bending() const;

    /**
     * For bending along each direction α: what the warping of the section by shear adds to the stress along α in the
     * outer faces, over what bending has there, as a multiple of the energy of shear over that of bending. With γ(z) =
     * g⁻¹ f(z) Q the section warps by w = ∫γ dz, less what a shift and a turn of it explain, so that stresses along α
     * change by w Q,α; Q,α = −k² M in a wave of k. 1/6 if homogeneous, more where soft plies lie between stiff ones.
     */
    Eigen::Vector2d warping = Eigen::Vector2d::Zero();

    /** What the stress across the laminae follows from beside plate strains: a balance along the normal. */
    struct Across
    {
      /** ∇Q: the divergence of a shear stress f_αγ(z) Q_γ is the sum of f_αγ times these, (α, γ) [N/m²]. */
      Eigen::Matrix2d shear_gradient = Eigen::Matrix2d::Zero();
      Vector3         curvature      = Vector3::Zero(); ///< e_α · n,β of the normal n: 11, 12 + 21, 22 [1/m]
      double          bottom = 0, top = 0;              ///< pressures against the two faces [Pa]
      double          inertia = 0; ///< mass per area times the acceleration less gravity, along the normal [Pa]

      /** Change the divergence of the shear force so that all this is in balance with the membrane forces @p N. */
      void balance(const Vector3 &N);
    };

    /**
     * σ₃₃ at the height @p z of the lamina @p index [Pa], of what is in balance:
     *
     *     σ₃₃,₃ = −(f_αγ Q_γ)|α + σ_αβ (e_α · n,β) + ρ (a₃ − g₃)      σ₃₃ = −(bottom), −(top) at the faces
     *
     * to the first order of thickness over radius. Without density, inertia is spread evenly.
     */
    double stress_across(unsigned int index, double z, const Vector6 &strains, const Across &across) const;

    /** The same in the axes of the lamina's material. */
    Vector6 stress_in_material(unsigned int index, const Vector6 &stress) const;

    /** Heights of the bottom and of the top of a lamina [m]. */
    std::array<double, 2> heights(unsigned int index) const;

  private:
    /** From the bottom to a height: of f, of the stiffness and of that times z in plane, the part of the mass. */
    struct Integrals
    {
      Eigen::Matrix2d f         = Eigen::Matrix2d::Zero();
      Matrix3         stiffness = Matrix3::Zero(), moment = Matrix3::Zero();
      double          mass = 0; ///< of the thickness without density
    };

    struct Layer
    {
      Matrix6         stiffness; ///< in the laminate's axes
      Matrix3         reduced;   ///< in plane, order 11 12 22, at σ₃₃ = 0
      Eigen::Matrix2d shear;     ///< g, order 13 23
      Matrix3         axes;      ///< columns: those of the material
      double          bottom, top;
      double          density;
      Eigen::Matrix2d f_at_bottom = Eigen::Matrix2d::Zero(); ///< shear stresses of unit shear forces
      Integrals       below;
    };
    std::vector<Layer>          layers;
    Eigen::Matrix<double, 6, 2> unit_moments; ///< plate strains of unit M₁₁ and M₂₂

    Eigen::Matrix2d shear_stresses(const Layer &layer, double z) const;
    Integrals       integrals(const Layer &layer, double z) const;
    void            find_membrane_and_bending();
    void            find_shear();
    double          warping_along(unsigned int alpha) const;
    void            find_asymptotic_shear();
  };



  /**
   * The angles of a layup in its usual shorthand [degrees], first one first: plies separated by `/`, `±45` or `+-45`
   * for two plies, `45_3` for three, `[...]_2` for a sequence twice, `[...]s` and `[...]_2s` for a symmetric one, a bar
   * before the last ply as `0~` for a middle ply that is not repeated.
   *
   * @throws std::invalid_argument with the place of what is not understood.
   */
  std::vector<double> layup_angles(const std::string &text);
} // namespace samara

#endif
