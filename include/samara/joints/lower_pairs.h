#ifndef samara_joints_lower_pairs_h
#define samara_joints_lower_pairs_h

#include <samara/joints/joint.h>
#include <samara/joints/thread_friction.h>
#include <samara/joints/vector_friction.h>

namespace samara
{
  /**
   * The six lower pairs (the paper, table 1 and fig. 2) with joint axis 3 along "Axis". Each kind only says which
   * relative displacements d₁ d₂ d₃ and rotations θ₁ θ₂ θ₃ stay zero, and names those that can be used.
   */

  /** θ₃ free. */
  class Revolute : public Joint
  {
  public:
    void add_parameters(Parameters &prm) override;
  };

  /** d₃ free. */
  class Prismatic : public Joint
  {
  public:
    void add_parameters(Parameters &prm) override;
  };

  /** θ₃ free, d₃ = p θ₃ with the pitch p [m/rad]; "thread" holds the friction of its flanks. */
  class Screw : public Joint
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;
    void connect(Layout &layout) override;

  private:
    ThreadFriction thread;
  };

  /** d₃ and θ₃ free. */
  class Cylindrical : public Joint
  {
  public:
    void add_parameters(Parameters &prm) override;
  };

  /** A joint with friction against motions that have a common slip: in a plane, of a ball. */
  class RubbingJoint : public Joint
  {
  public:
    void initialize(Model &model) override;
    void connect(Layout &layout) override;

  protected:
    VectorFriction plane{VectorFriction::Of::plane}, ball{VectorFriction::Of::ball};
  };

  /** d₁, d₂ and θ₃ free: B slides on the plane normal to axis 3; "displacement" holds the friction against both. */
  class Planar : public RubbingJoint
  {
  public:
    void add_parameters(Parameters &prm) override;
  };

  /** All rotations free; "rotation" holds the friction against all of them. */
  class Spherical : public RubbingJoint
  {
  public:
    void add_parameters(Parameters &prm) override;
    void add_relative_rates(const double *q, std::vector<RelativeRate> &rates) const override;
  };
} // namespace samara

#endif
