// The ground carries what the loads do: the last six entries of the residual, the force and moment on the ground at the
// origin, against the resultants of the loads in the deformed configuration.
//
// Reference: equilibrium of the whole model, for every kind of load, through a weld and through a hinge.

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  std::string
  beam_with_block(const std::string &loads)
  {
    return R"(
subsection Sections
  subsection full
    set Type = matrices
    set Stiffness = 900, 1, .5, .2, .3, .1, 700, .4, .3, .2, .6, 600, .1, .5, .2, 3, .2, .1, 2, .3, 4
    set Inertia = 0.5, 0.5, 0.5, 0.01, 0.01, 0.01
  end
end
subsection Bodies
  subsection beam
    set Type = beam
    set Points = 0.2, 0.1, -0.3; 1.2, 0.1, 0.3; 1.4, 1.0, 0.3
    set Section = full
    set Elements = 6
  end
  subsection block
    set Type = rigid body
    set Mass = 0.3
    set Position = 1.4, 1.0, 0.3
    set Centre of mass = 0.1, 0.2, -0.1
    set Inertia = 0.1, 0.1, 0.1
    set Frames = hook at 1.6 1.3 0.2
  end
end
subsection Joints
  subsection hinge
    set Type = revolute
    set Body A = ground
    set Body B = beam.start
    set Position = 0.2, 0.1, -0.3
    set Axis = 0.3, 0.2, 1
    subsection rotation
      set Spring = 2
    end
  end
  subsection weld
    set Type = rigid
    set Body A = beam.end
    set Body B = block.centre
  end
end
subsection Loads
)" + loads +
           "\nend\n";
  }

  /** Force, then moment about the origin. */
  Vector6
  wrench(const Vector3 &force, const Vector3 &at, const Vector3 &moment = Vector3::Zero())
  {
    Vector6 w;
    w << force, at.cross(force) + moment;
    return w;
  }

  /** What the ground gets. */
  Vector6
  on_ground(const Scene &scene)
  {
    std::vector<double> r;
    const State        &state = scene.context.state;
    scene.system.residual(state, state.stress, r);
    return -Eigen::Map<const Vector6>(&r[scene.system.size()]);
  }

  void
  expect_balance(const Scene &scene, const Vector6 &applied)
  {
    EXPECT_LT((on_ground(scene) - applied).norm(), 1e-10 * applied.norm());
    EXPECT_GT(std::abs(scene.value("hinge.rotation")), 5.) << "the model has hardly moved";
  }
} // namespace



TEST(Reactions, DeadForceAndMomentOnAnArm)
{
  Scene scene(beam_with_block("subsection p\n set Type = point load\n set At = block.hook\n set Force = 1, -2, 1.5\n"
                              " set Moment = 0.3, 0.5, -0.8\n end"));
  const State &state = scene.equilibrium();
  const Frame  hook  = scene.system.model.frame("block.hook");
  expect_balance(scene, wrench({1, -2, 1.5}, hook.position(state.q.data()), {0.3, 0.5, -0.8}));
}



TEST(Reactions, FollowerForceAndMoment)
{
  Scene         scene(beam_with_block("subsection p\n set Type = point load\n set At = block.hook\n set Axes = body\n"
                                      " set Force = 1, 0.5, 1.5\n set Moment = 0.3, 0.5, -0.8\n end"));
  const State  &state = scene.equilibrium();
  const Frame   hook  = scene.system.model.frame("block.hook");
  const Matrix3 D     = hook.triad(state.q.data());
  expect_balance(scene, wrench(D * Vector3(1, 0.5, 1.5), hook.position(state.q.data()), D * Vector3(0.3, 0.5, -0.8)));
}



// The weight acts at the centre of mass.
TEST(Reactions, Gravity)
{
  Scene        scene(beam_with_block("subsection g\n set Type = gravity\n set Acceleration = 2, -6, -9\n end"));
  const State &state = scene.equilibrium();
  const auto   mass  = scene.system.mass_properties(state);
  EXPECT_NEAR(mass.mass, 0.3 + 0.5 * (std::sqrt(1.36) + std::sqrt(0.85)), 1e-12);
  expect_balance(scene, wrench(mass.mass * Vector3(2, -6, -9), mass.centre));
}



// So does a uniform load without the block; its resultant is the load per length times the length.
TEST(Reactions, UniformLineLoad)
{
  std::string text = beam_with_block("subsection q\n set Type = line load\n set Body = beam\n set Force = 1, 0.5, -2\n"
                                     " set Moment = 0.2, 0.3, 0.1\n end");
  text.replace(text.find("set Mass = 0.3"), 14, "set Mass = 0");
  text.replace(text.find("set Inertia = 0.1, 0.1, 0.1"), 27, "");
  Scene        scene(text);
  const State &state  = scene.equilibrium();
  const double length = std::sqrt(1.36) + std::sqrt(0.85);
  expect_balance(scene,
                 wrench(length * Vector3(1, 0.5, -2),
                        scene.system.mass_properties(state).centre,
                        length * Vector3(0.2, 0.3, 0.1)));
}



// In steady rotation Ω about z through (1, 2) the inertial forces have the resultant m Ω² times the way from the axis
// to the centre of mass.
TEST(Reactions, CentrifugalForce)
{
  Scene scene(beam_with_block("subsection r\n set Type = steady rotation\n set Speed = 1.5\n set Axis = 0, 0, 2\n"
                              " set Through = -1, -2, 0\n end"));
  const State  &state = scene.equilibrium();
  const auto    mass  = scene.system.mass_properties(state);
  const Vector3 arm(mass.centre(0) + 1, mass.centre(1) + 2, 0);
  const Vector6 w = on_ground(scene);
  EXPECT_LT((w.head<3>() - mass.mass * 2.25 * arm).norm(), 1e-10 * mass.mass * 2.25 * arm.norm());
  // about the axis the moment is zero
  EXPECT_NEAR(w(5) - (-1 * w(1) + 2 * w(0)), 0., 1e-10);
}
