#ifndef samara_joints_partial_joints_h
#define samara_joints_partial_joints_h

#include <samara/joints/lower_pairs.h>
#include <samara/joints/other_joints.h>

namespace samara
{
  /**
   * A point of B stays on a line of A, through "Position" along "Axis" (joint axis 3): d₁ = d₂ = 0. "displacement" is
   * d₃; all rotations are free, and "rotation" holds the friction against them.
   */
  class InLine : public RubbingJoint
  {
  public:
    void add_parameters(Parameters &prm) override;
    void add_relative_rates(const double *q, std::vector<RelativeRate> &rates) const override;
  };



  /**
   * A point of B stays on a plane of A, normal to "Axis" (joint axis 3): d₃ = 0. "displacement 1, 2" are d₁ and d₂, and
   * "displacement" and "rotation" hold the friction against both, and against all rotations.
   */
  class InPlane : public RubbingJoint
  {
  public:
    void add_parameters(Parameters &prm) override;
    void add_relative_rates(const double *q, std::vector<RelativeRate> &rates) const override;
  };



  /**
   * Two shafts along joint axis 3 that bend against each other and turn with the same speed whatever the bend: a ball
   * joint that does not twist,
   *
   *     E₁ᴬ·E₂ᴮ − E₂ᴬ·E₁ᴮ = 0
   *
   * E₃ᴬ is along "Axis", E₃ᴮ along "Second axis", if the shafts have a bend in the reference configuration. The axis of
   * the relative rotation is normal to both, and the balls of a Rzeppa joint are in the plane that halves their angle.
   * The moment is along E₃ᴬ + E₃ᴮ: "moment 1, 2, 3" are its components along the axes of A. Without sense at a bend of
   * half a turn.
   *
   * "rotation" holds the friction against both motions that are free, the bend and the turning of its plane, by the
   * relative angular velocity ω_B − ω_A, as of a ball joint; the balls are on the "Friction radius" r. They are pressed
   * by the force at the centre and by M/(r cos(β/2)) = 2 |λ|/r of the moment M = 2 λ cos(β/2) at the bend β, as their
   * grooves lean by β/2 against the plane in which the balls are.
   */
  class ConstantVelocity : public RubbingJoint
  {
  public:
    void add_parameters(Parameters &prm) override;
    void be_moved(const MotionOf &motion_of) override;
    void add_relative_rates(const double *q, std::vector<RelativeRate> &rates) const override;

    /** The force at the centre, and the moment. @{ */
    bool                  presses(const Layout::Friction &friction) const override;
    PressingParts<double> pressing_parts(const Layout::Friction &friction, const Point<double> &point) const override;
    PressingParts<std::complex<double>> pressing_parts(const Layout::Friction            &friction,
                                                       const Point<std::complex<double>> &point) const override;
    /** @} */

  protected:
    void place(Model &model, const Frame &body_a, const Frame &body_b) override;
    void add_pressing(std::vector<unsigned int> &multipliers) const override;

  private:
    Vector3 second_axis = Vector3::Zero();
  };



  /**
   * Two hinges whose axes meet at an angle α that need not be right: E₁ᴬ·E₂ᴮ = cos α, axis 1 of A along "Axis", axis 2
   * of B along "Second axis". "rotation 1" is about the first, "rotation 2" about the second.
   */
  class SkewUniversal : public Universal
  {
  protected:
    std::string
    angle_of_axes() const override
    {
      return "not along the first";
    }
    Matrix3 axes() const override;
    void    place(Model &model, const Frame &body_a, const Frame &body_b) override;
  };
} // namespace samara

#endif
