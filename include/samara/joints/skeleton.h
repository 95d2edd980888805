#ifndef samara_joints_skeleton_h
#define samara_joints_skeleton_h

#include <samara/joints/joint.h>

namespace samara
{
  /**
   * A joint to copy; doc/how_to/joint.md tells how. It is tested (tests/skeleton), but not in the catalogue.
   *
   * A pin in a slot: the pin of body B, along joint axis 3, slides in a slot of body A, along joint axis 1, and turns.
   *
   *     locked   d₂ = E₂ᴬ·Δ = 0   d₃ = E₃ᴬ·Δ = 0   E₃ᴬ·E₁ᴮ = 0   E₃ᴬ·E₂ᴮ = 0
   *     free     d₁ "displacement" [m], θ₃ "rotation" [rad], of B seen from A
   *
   * The slot has no ends: "Length" is for the picture only. Complains in initialize() about an axis that is zero and
   * about a slot of no length.
   */
  class SlottedPin : public Joint
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;
    void draw(const State &state, Drawing &drawing) const override;

  private:
    double length = 0.2;
  };
} // namespace samara

#endif
