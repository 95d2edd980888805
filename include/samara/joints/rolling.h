#ifndef samara_joints_rolling_h
#define samara_joints_rolling_h

#include <samara/joints/joint.h>

namespace samara
{
  /**
   * A ball of radius R [m], fixed to body B with its centre at the place x_B of that frame, rolls without slipping on a
   * plane of body A: the one through "Position" and normal to axis 3, which points to the side of the ball. Both bodies
   * may move.
   *
   *     locked    E₃ᴬ·Δ = R                      Δ = x_B − x_A from "Position" to the centre
   *     no slip   E_iᴬ·w = 0, i = 1, 2           w the velocity of the ball at the contact x_B − R E₃ᴬ, against body A
   * there
   *
   * The ball may spin about axis 3. It is held to the plane, whichever way the force goes: "force 3" is negative if it
   * would lift off. Complains about a radius that is not above zero, and about a centre that is not R away from the
   * plane in the reference configuration.
   */
  class RollingBall : public Joint
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;
    void draw(const State &state, Drawing &drawing) const override;

    /**
     * "force 1" ... "force 3": of A on B at the contact, in the axes of A; "displacement 1", "displacement 2": the
     * contact in the axes of A, from "Position".
     */
    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;

  protected:
    void place(Model &model, const Frame &body_a, const Frame &body_b) override;

  private:
    double radius = 0;
  };



  /**
   * A knife edge: a skate, an ice blade, a wheel that does not slip sideways. Its place x_B, fixed to body B, does not
   * move along axis 1 of B, across the blade, against the material of body A at the same place:
   *
   *     no slip   E₁ᴮ·w = 0
   *
   * This one velocity is all it prevents; what keeps the blade on a surface and upright is another joint, "planar" for
   * example. Probe "force 1": of A on B, along axis 1 of B.
   */
  class KnifeEdge : public Joint
  {
  public:
    void add_parameters(Parameters &prm) override;
    void be_moved(const MotionOf &motion_of) override;
    void draw(const State &state, Drawing &drawing) const override;

  protected:
    Matrix3 axes() const override;
  };
} // namespace samara

#endif
