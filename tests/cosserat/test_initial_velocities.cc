// What bodies say of their velocities at the start. The velocity of a rigid motion at x is V + ω × (x − x₀) at all
// points of all bodies that take part, in the state as it stands: large displacements, beams that are bent. Exact,
// 1e-12.

#include <gtest/gtest.h>

#include "bodies.h"

using namespace samara;

namespace
{
  const std::string moving = "set Velocity = 3, -4, 5\n set Angular velocity = 0.7, -0.6, 0.9\n";
  const Vector3     V(3, -4, 5), w(0.7, -0.6, 0.9);

  /** Move everything far, bend beams, and give all nodes the twists of a steady motion. */
  void
  disturb(Scene &scene)
  {
    State              &state = scene.context.state;
    std::vector<double> z(scene.system.size());
    for (unsigned int i = 0; i < z.size(); ++i)
      z[i] = 0.4 * std::sin(1.7 * i + 0.3);
    for (auto &motion : state.motion)
      motion = {{0.1, 0.2, 0.3}, {-1, 2, 1}, {0.5, 0.5, 0.5}};
    scene.system.update(state, z);
  }

  void
  start(Scene &scene)
  {
    scene.system.add_initial_velocities(scene.context.state);
  }

  void
  expect_rigid_motion(const Scene                    &scene,
                      const std::vector<std::string> &points,
                      const std::string              &about,
                      const Vector3                  &velocity,
                      const Vector3                  &spin)
  {
    const Vector3 x0 = vector_of(scene, about + ".position");
    for (const auto &point : points)
      {
        const Vector3 v = velocity + spin.cross(vector_of(scene, point + ".position") - x0);
        EXPECT_LT((vector_of(scene, point + ".velocity") - v).norm(), 1e-12) << point;
        EXPECT_LT((vector_of(scene, point + ".angular velocity") - spin).norm(), 1e-12) << point;
      }
  }

  TEST(InitialVelocities, OfWeldedBodiesByEitherOne)
  {
    for (const std::string which : {"ball", "plate"})
      {
        Scene scene(bodies(which == "ball" ? moving : "", which == "plate" ? moving : "", ""));
        disturb(scene);
        const Vector3 before = vector_of(scene, "rod.end.velocity");
        start(scene);
        expect_rigid_motion(scene, points_of_bodies, which + ".centre", V, w);
        EXPECT_EQ(vector_of(scene, "rod.end.velocity"), before) << "of a body that is not asked to move";
      }
  }



  TEST(InitialVelocities, OfBeams)
  {
    for (const std::string rigid : {"", "set Rigid = true\n"})
      {
        Scene scene(bodies("", "", moving + rigid));
        disturb(scene);
        start(scene);
        expect_rigid_motion(scene, points_of_rod, "rod.start", V, w);
      }
    // a body that is welded to the beam goes with it
    Scene scene(bodies("", "", moving, weld_rod_to_plate));
    disturb(scene);
    start(scene);
    expect_rigid_motion(scene, points_of_rod, "rod.start", V, w);
    expect_rigid_motion(scene, points_of_bodies, "rod.start", V, w);
  }



  /** By König's theorem for the whole model. */
  TEST(InitialVelocities, HaveTheKineticEnergyOfARigidMotion)
  {
    Scene scene(bodies("", "", moving, weld_rod_to_plate));
    start(scene);
    const auto    m        = scene.system.mass_properties(scene.context.state);
    const Vector3 v        = V + w.cross(m.centre - Vector3(0.5, 0, 0));
    const double  expected = 0.5 * m.mass * v.squaredNorm() + 0.5 * w.dot(m.inertia * w);
    EXPECT_NEAR(scene.system.energy(scene.context.state).kinetic / expected, 1, 1e-13);
  }



  TEST(InitialVelocities, OneEntryIsEnough)
  {
    Scene shifted(bodies("set Velocity = 3, -4, 5\n", "", "set Angular velocity = 0.7, -0.6, 0.9\n"));
    disturb(shifted);
    start(shifted);
    expect_rigid_motion(shifted, points_of_bodies, "ball.centre", V, Vector3::Zero());
    expect_rigid_motion(shifted, points_of_rod, "rod.start", Vector3::Zero(), w);
  }



  TEST(InitialVelocities, ReplaceThoseOfTheState)
  {
    Scene scene(bodies("", "", ""));
    disturb(scene);
    const auto before = scene.context.state.y;
    start(scene);
    EXPECT_EQ(scene.context.state.y, before) << "nothing is said";

    Scene at_rest(bodies("", "set Velocity = 0, 0, 0\n", "set Angular velocity = 0, 0, 0\n"));
    disturb(at_rest);
    EXPECT_GT(at_rest.system.energy(at_rest.context.state).kinetic, 1);
    start(at_rest);
    EXPECT_EQ(at_rest.system.energy(at_rest.context.state).kinetic, 0);

    // of two bodies on one node, the second counts
    Scene twice(bodies("set Velocity = 1, 1, 1\n", moving, ""));
    start(twice);
    expect_rigid_motion(twice, points_of_bodies, "plate.centre", V, w);
  }



  TEST(InitialVelocities, DoNotMoveTheGround)
  {
    Scene scene(bodies("", "", "set Angular velocity = 0.7, -0.6, 0.9\n", weld_rod_to_ground));
    start(scene);
    EXPECT_EQ(Vector3(vector_of(scene, "rod.start.velocity")), Vector3::Zero());
    EXPECT_EQ(Vector3(vector_of(scene, "rod.start.angular velocity")), Vector3::Zero());
    EXPECT_LT((vector_of(scene, "rod.end.angular velocity") - w).norm(), 1e-13);

    const auto refuses = [](const std::string &plate, const std::string &rod, const std::string &words) {
      try
        {
          Scene scene(bodies("", plate, rod, weld_rod_to_ground + (plate.empty() ? "" : R"(
            subsection foot
              set Type = rigid
              set Body A = ground
              set Body B = ball.tip
            end
)")));
          ADD_FAILURE() << words;
        }
      catch (const InputError &error)
        {
          EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
        }
    };
    refuses("", moving, "beam <rod> is welded to the ground there and cannot have a velocity");
    refuses(moving, "", "rigid body <plate> is welded to the ground there and cannot have a velocity");
    refuses("",
            "set Rigid = true\n" + moving,
            "beam <rod> is welded to the ground and cannot have an angular velocity");
  }
} // namespace
