// The skeletons of a joint (slotted pin) and of an element (strut) that are there to be copied. They are not in the
// catalogue; the tests add them to one of their own. What a new kind should be tested for: tangents, a closed form, and
// each mistake that it refuses.

#include "scene.h"

using namespace samara;

namespace
{
  const std::string slot = "set Type = slotted pin\n set Body A = a.ear\n set Body B = b.ear\n set Axis = 1, 2, 3\n"
                           " set Gap = allowed\n";
  const std::string line = "set Type = strut\n set Point A = a.ear\n set Point B = b.ear\n set EA = 7\n";
} // namespace



TEST(Skeletons, TangentsAgreeWithComplexStep)
{
  const std::string spring = "set Spring = 2\n set Damper = 0.3\n set Rest = 0.1\n end\n";
  for (const std::string &text :
       {joint("slot", slot),
        joint("slot", slot + "subsection displacement\n" + spring + "subsection rotation\n" + spring),
        joint("strut", line + "set Length = 0.7\n set Damping = 0.2\n")})
    {
      const SmallScene  scene(two_blocks + text);
      const ComplexStep check(scene.system);
      EXPECT_LT(check.error_of_tangent(), 2e-14) << text;
      EXPECT_LT(check.error_of_damping(), 2e-14) << text;
    }
}



// A pin pushed along the slot against a spring, and turned against another: d = F/k and θ = M/k, and nothing else
// moves.
TEST(Skeletons, SlottedPinSlidesAndTurns)
{
  SmallScene scene(R"(
subsection Bodies
  subsection pin
    set Type = rigid body
    set Mass = 1
  end
end
subsection Joints
  subsection slot
    set Type = slotted pin
    set Body A = ground
    set Body B = pin.centre
    set Axis = 0, 0, 1
    set Axis 1 = 1, 1, 0
    subsection displacement
      set Spring = 50
    end
    subsection rotation
      set Spring = 4
    end
  end
end
subsection Loads
  subsection push
    set Type = point load
    set At = pin.centre
    set Force = 10, 0, 3
    set Moment = 0, 0, 2
  end
end
)");
  scene.find_equilibrium();
  const double along_the_slot = 10 / std::sqrt(2.) / 50;
  EXPECT_NEAR(scene.value("slot.displacement"), along_the_slot, 1e-14);
  EXPECT_NEAR(scene.value("slot.rotation"), 0.5 * 180 / M_PI, 1e-12);
  EXPECT_NEAR(scene.value("pin.displacement x"), along_the_slot / std::sqrt(2.), 1e-14);
  EXPECT_NEAR(scene.value("pin.displacement y"), along_the_slot / std::sqrt(2.), 1e-14);
  EXPECT_NEAR(scene.value("pin.displacement z"), 0, 1e-14);
  // with which the slot holds the pin; joint axis 2 is (-1, 1, 0)/√2, and 1 and 3 are those of the springs
  EXPECT_NEAR(scene.value("slot.force 1"), -50 * along_the_slot, 1e-12);
  EXPECT_NEAR(scene.value("slot.force 2"), 10 / std::sqrt(2.), 1e-12);
  EXPECT_NEAR(scene.value("slot.force 3"), -3, 1e-12);
  EXPECT_NEAR(scene.value("slot.moment 1"), 0, 1e-12);
  EXPECT_NEAR(scene.value("slot.moment 2"), 0, 1e-12);
  EXPECT_NEAR(scene.value("slot.moment 3"), -2, 1e-12);
}



TEST(Skeletons, SlottedPinRefusesWhatIsSenseless)
{
  EXPECT_TRUE(contains(complaint(two_blocks + joint("slot", slot + "set Length = 0\n")), "must have a length"));
  EXPECT_TRUE(contains(complaint(two_blocks + joint("slot", slot + "set Axis 1 = 0, 0\n")), "3 values are wanted"));
  EXPECT_EQ(complaint(two_blocks + joint("slot", slot)), "");
}



// A weight of mass m on a slide hangs on a strut of length L. With λ = l/L the force is EA λ(λ² − 1)/2.
TEST(Skeletons, StrutHoldsAWeight)
{
  const double EA = 500, L = 2, m = 3, mass_per_length = 0.4, g = 9.80665;
  SmallScene   scene(R"(
subsection Bodies
  subsection weight
    set Type = rigid body
    set Mass = 3
    set Inertia = 1, 1, 1
    set Position = 0, 0, -2
  end
end
subsection Joints
  subsection slide
    set Type = prismatic
    set Body A = ground
    set Body B = weight.centre
  end
  subsection strut
    set Type = strut
    set Point A = ground
    set Point B = weight.centre
    set EA = 500
    set Mass = 0.4
    set Damping = 0.001
  end
end
subsection Loads
  subsection gravity
    set Type = gravity
  end
end
)");

  // modes of the strut free of stress: stiffness EA/L, half of its mass moves; damping ratio ω τ / 2
  ModalAnalysis modal;
  scene.context.state.factor = 0;
  modal.run(scene.context);
  scene.context.state.factor = 1;
  const double omega         = std::sqrt(EA / L / (m + 0.5 * mass_per_length * L));
  ASSERT_GE(modal.modes.size(), 1u);
  EXPECT_NEAR(modal.modes[0].frequency(), omega, 1e-9 * omega);
  EXPECT_NEAR(modal.modes[0].damping_ratio(), 0.5 * omega * 0.001, 1e-9);

  scene.find_equilibrium();
  const double weight  = (m + 0.5 * mass_per_length * L) * g;
  double       stretch = 1;
  for (unsigned int i = 0; i < 50; ++i)
    stretch -= (EA * stretch * (stretch * stretch - 1) / 2 - weight) / (EA * (3 * stretch * stretch - 1) / 2);
  EXPECT_NEAR(scene.value("weight.displacement z"), -L * (stretch - 1), 1e-12);
  EXPECT_NEAR(scene.value("strut.force"), weight, 1e-10);
  EXPECT_NEAR(scene.value("strut.strain"), (stretch * stretch - 1) / 2, 1e-13);
  EXPECT_NEAR(scene.system.energy(scene.context.state).strain,
              EA * L * std::pow((stretch * stretch - 1) / 2, 2) / 2,
              1e-10);
}



TEST(Skeletons, StrutRefusesWhatIsSenseless)
{
  const std::string start = "set Type = strut\n set EA = 1\n set Point A = a.ear\n set Point B = ";
  EXPECT_TRUE(contains(complaint(two_blocks + joint("strut", start + "b.eer\n")), "did you mean <ear>?"));
  EXPECT_TRUE(contains(complaint(two_blocks + joint("strut", start + "a.centre\n")), "connects a body to itself"));
  EXPECT_TRUE(contains(complaint(two_blocks + joint("strut",
                                                    "set Type = strut\n set Point A = ground\n"
                                                    " set Point B = a.centre\n")),
                       "coincide"));
  EXPECT_TRUE(contains(complaint(two_blocks + joint("strut", start + "b.ear\n set Length = -1\n")), "is not accepted"));
  EXPECT_EQ(complaint(two_blocks + joint("strut", start + "b.ear\n")), "");
}
