#ifndef samara_aero_airfoil_h
#define samara_aero_airfoil_h

#include <samara/model/model.h>

#include <complex>

namespace samara
{
  /** Coefficients of lift, drag and moment about the quarter chord (nose up), and derivatives by angle and Mach number.
   */
  struct Coefficients
  {
    double lift = 0, drag = 0, moment = 0;
    double lift_alpha = 0, drag_alpha = 0, moment_alpha = 0; ///< [1/rad]
    double lift_mach = 0, drag_mach = 0, moment_mach = 0;

    /** this + share (other − this) */
    Coefficients blended(const Coefficients &other, double share) const;
  };



  /** A section of a wing or a blade: coefficients as functions of the angle of attack α [rad] and the Mach number. */
  class Airfoil : public Item
  {
  public:
    /** At any angle, −π ≤ α ≤ π, and at any Mach number ≥ 0. */
    virtual Coefficients at(double alpha, double mach) const = 0;

    /** The Mach number beyond which coefficients are those at it, or as if the air were still incompressible. */
    virtual double
    highest_mach() const
    {
      return 0.9;
    }

    /**
     * lift_0, lift, drag, moment "at α, M": numbers that can be asked for, <airfoil>.lift at 5 0.3 with α in degrees.
     */
    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;
  };



  /**
   * In closed form. With x = α − α₀, linear or periodic,
   *
   *     c_l = a x            c_d = d₀ + d₁ x + d₂ x²            c_m = m₀ + m₁ x              linear
   *     c_l = a sin x cos x  c_d = d₀ + d₁ sin x + d₂ sin² x    c_m = m₀ + m₁ sin x          periodic
   *
   * a divided by √(1 − M²), M not above 0.9, where Prandtl and Glauert are wanted. With a stall angle α_s the
   * coefficients pass, within some width about ±α_s from α₀, to those of a plate with c_n = 2 sin α at half chord,
   * c_l = sin 2α, c_d = 2 sin² α, c_m = −½ sin α, with the share σ = s₁ + s₂ − s₁ s₂ of two logistic functions
   * s = 1/(1 + exp((α_s ∓ x)/width)) (R. W. Beard & T. W. McLain, Small Unmanned Aircraft, 2012, eq. 4.10).
   */
  class AnalyticAirfoil : public Airfoil
  {
  public:
    void         add_parameters(Parameters &prm) override;
    void         initialize(Model &model) override;
    Coefficients at(double alpha, double mach) const override;

  private:
    std::string         form       = "periodic";
    double              lift_slope = 2 * M_PI, zero_lift_angle = 0;
    std::vector<double> drag = {0.}, moment = {0.};
    bool                is_compressible = false;
    double              stall_angle = 0, stall_width = 2 * M_PI / 180;
  };
} // namespace samara

#endif
