#ifndef samara_aero_finite_state_h
#define samara_aero_finite_state_h

#include <samara/aero/disk_shapes.h>

#include <Eigen/Dense>

#include <cmath>
#include <complex>
#include <vector>

namespace samara
{
  /**
   * Inflow in a finite number of states, z_n^m = α_n^m + i β_n^m of shapes φ_n^m(r) cos mψ and φ_n^m(r) sin mψ:
   *
   *     R M ż + 𝒱 L⁻¹ z = t        𝒱 y = V_m y + (V_T − V_m) u y₁        y = L⁻¹ z
   *     V_T = √(|μ|² + λ²),  λ = λ_f + ν,  V_m = (|μ|² + λ(λ + ν))/V_T,  ν = k y₁
   *
   * with the flow of the undisturbed air in the hub's axes, μ [m/s] in the disk, complex, in the direction it goes, and
   * λ_f [m/s] through the disk, against the thrust axis. ν is the mean flow: in the steady state thrust/(2ρ π R² V_T),
   * whatever the number of states. t are loads of the shapes, t = (weights) Σ F φ/(ρR²).
   *
   * L depends on the skew of the wake, X = tan(χ/2) in the complex direction in which it goes,
   * X = μ/(V_T + |λ|): a polynomial in X and its conjugate, smooth in hover and for any direction of flight.
   *
   * Everything is in body axes; z of axes that turn with Ω about the thrust axis changes by m Ω (β, −α) in addition. In
   * a disk whose radius changes the air at a place is what the equations are of, ż − (Ṙ/R) C z in place of ż: r φ_n' =
   * Σ_j C_jn φ_j.
   */
  class FiniteStateInflow
  {
  public:
    /** V_T is no part of L: one state, ν alone. M = 8/(3π), H. Glauert's mean flow in the steady state. */
    static FiniteStateInflow uniform();

    /**
     * Three states, ν₀ + r (ν_c cos ψ + ν_s sin ψ): D. M. Pitt & D. A. Peters, Vertica 5 (1981); M₀ = 8/(3π), that of a
     * rigid disk.
     */
    static FiniteStateInflow pitt_peters();

    /**
     * Harmonics m = 0 ... @p harmonics, and of each the shapes whose radial polynomials have a degree of at most @p
     * power: D. A. Peters, D. D. Boyd & C. J. He, J. Am. Helicopter Soc. 34(4) (1989); C. J. He, thesis, Georgia
     * Institute of Technology (1989). The pressure of a uniform load sees V_T, what deviates from it V_m; with
     * @p first_state_alone, as the literature has it, the first state alone sees V_T.
     */
    static FiniteStateInflow peters_he(unsigned int harmonics, unsigned int power, bool first_state_alone = false);

    DiskShapes disk;
    /** Of the equations: M; t_k = load_weights[k] Σ F φ_k/(ρR²). */
    std::vector<double> apparent_mass, load_weights;

    unsigned int
    size() const
    {
      return disk.shapes.size();
    }

    /** Where the rotor is in the air, and how its axes turn about the thrust axis. */
    template <typename Number>
    struct Flight
    {
      Number mu_x, mu_y, lambda_f, spin; ///< [m/s], [rad/s]
      double growth = 0;                 ///< Ṙ/R [1/s]
    };

    template <typename Number>
    using Vector = Eigen::Matrix<Number, Eigen::Dynamic, 1>;
    template <typename Number>
    using Matrix = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;

    /** What follows from states z and flight. */
    template <typename Number>
    struct Flow
    {
      Number         nu, V_T, V_m, lambda, X_x, X_y;
      Vector<Number> y;    ///< L⁻¹ z
      Vector<Number> rate; ///< ż without loads: −𝒱 y/(RM), and the spin of the axes
    };

    /**
     * @p least_speed [m/s] keeps V_T from being zero in air at rest, and |λ| smooth.
     * @throws Astray if there is no mean flow ν for these states
     */
    template <typename Number>
    Flow<Number> flow(const Vector<Number> &z, const Flight<Number> &flight, double radius, double least_speed) const;

    /** Derivatives of Flow::rate: by z, and by μ_x, μ_y, λ_f and the spin, a column each. */
    struct Derivatives
    {
      Eigen::MatrixXd by_z, by_flight;
    };
    Derivatives derivatives(const Flow<double>    &flow,
                            const Eigen::VectorXd &z,
                            const Flight<double>  &flight,
                            double                 radius,
                            double                 least_speed) const;

    /** C of the radius that changes. */
    Eigen::MatrixXd stretch;

    /** L at the skew X; real. */
    template <typename Number>
    Matrix<Number> influence(const Number &X_x, const Number &X_y) const;

  private:
    /** An element (r, m) of L: X^p conj(X)^q t of the load to the state, or of the conjugate of the load. */
    struct Term
    {
      unsigned int row, column;  ///< of the cosines
      unsigned int power;        ///< of X or its conjugate
      bool         conjugate;    ///< of X
      bool         of_conjugate; ///< of the load
      double       factor;
      bool         real_part; ///< alone: of harmonic 0
    };
    std::vector<Term>   terms;
    std::vector<int>    sine_of; ///< the number of the sine for each cosine; negative: none
    std::vector<double> u;
    double              k = 1;

    Eigen::RowVectorXd first_without_skew; ///< row of L(0)⁻¹: y₁ of a wake without skew

    void add_shape(unsigned int m, const std::vector<double> &c, double apparent_mass, double load_weight);
    void add_sines();

    /** C, by comparing powers of r from the highest. */
    Eigen::MatrixXd find_stretch() const;

    /** Adds factor X^power of a term to A. */
    template <typename Number>
    void add_term(const Term &term, const Number &re, const Number &im, Matrix<Number> &A) const;

    /**
     * The cosines' part of L, or the sines', in axes along the skew of the wake: X is real there, and neither sees the
     * other. Where @p slope is given, also X ∂L/∂X.
     */
    void influence_along_skew(double X, bool of_sines, Eigen::MatrixXd &L, Eigen::MatrixXd *slope = nullptr) const;

    /** States in axes along the direction (c, s) from those in body axes; for s < 0 the way back. */
    Eigen::VectorXd turned(const Eigen::VectorXd &z, double c, double s) const;

    /** What has one solution for all states z: ν = k y₁(X(ν)), by Newton's method. */
    struct MeanFlow
    {
      double nu    = 0;
      double slope = 1;    ///< of ν − k y₁(X(ν)) by ν
      double c = 1, s = 0; ///< direction of μ
    };
    /** @throws NotConverged */
    MeanFlow mean_flow(const Eigen::VectorXd &z, const Flight<double> &flight, double least_speed) const;

    /** y = L⁻¹ z, of real numbers in axes along the skew of the wake. @{ */
    Eigen::VectorXd loads_of(const Eigen::VectorXd &z, const Flow<double> &flow, const MeanFlow &mean) const;
    Eigen::VectorXcd
    loads_of(const Eigen::VectorXcd &z, const Flow<std::complex<double>> &flow, const MeanFlow &mean) const;
    /** @} */

    /** All that follows from ν but y and the rate. */
    template <typename Number>
    Flow<Number> at_mean_flow(const Number &nu, const Flight<Number> &flight, double least_speed) const;

    /** dL/dX_x and dL/dX_y */
    std::pair<Eigen::MatrixXd, Eigen::MatrixXd> influence_slopes(double X_x, double X_y) const;
  };
} // namespace samara

#endif
