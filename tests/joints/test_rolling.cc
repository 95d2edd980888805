// Rolling ball and knife edge: constraints on velocities, the forces that enforce them, equilibria and modes. Closed
// forms, from the velocities of the material of both bodies at one place.

#include <samara/model/drawing.h>

#include <samara/base/dense.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <random>

using namespace samara;

namespace
{
  const double  radius = 0.3;
  const Vector3 normal = Vector3(1, 2, 2) / 3., near_1(1, 0, 0);

  /** Two free bodies; the joint is at corners of them, not at their nodes. */
  std::string
  two_bodies(const std::string &joint)
  {
    return "subsection Bodies\n subsection table\n set Type = rigid body\n set Mass = 3\n set Inertia = 1, 2, 2.5\n"
           " set Position = 0.2, -0.1, 0.4\n set Rotation = 0.3, -0.2, 0.5\n set Frames = corner at 0.5 0.1 -0.2\n end\n"
           " subsection ball\n set Type = rigid body\n set Mass = 2\n set Inertia = 1, 1.5, 2\n"
           " set Position = 1, 0.7, 0.3\n set Rotation = -0.6, 0.4, 0.1\n set Frames = middle at 0.8 0.9 0.5\n end\nend\n"
           "subsection Joints\n subsection j\n set Body A = table.corner\n set Body B = ball.middle\n" +
           joint + " end\nend\n";
  }

  const std::string ball = "set Type = rolling ball\nset Axis = 1, 2, 2\nset Axis 1 = 1, 0, 0\nset Radius = 0.3\n";

  /** The system somewhere, with some velocities and multipliers. */
  struct Somewhere
  {
    explicit Somewhere(const std::string &joint)
      : scene(two_bodies(joint))
      , start(scene.system.reference())
      , state(start)
      , rates(scene.system.layout.n_multipliers)
    {
      std::mt19937                           random(3);
      std::uniform_real_distribution<double> number(-1., 1.);
      std::vector<double>                    z(scene.system.size());
      std::generate(z.begin(), z.end(), [&]() { return number(random); });
      scene.system.update(state, z);
      std::generate(state.y.begin() + 6, state.y.end(), [&]() { return number(random); });
    }

    Scene               scene;
    State               start, state;
    std::vector<double> rates;

    /** Where a point of a body is now that was at @p x. */
    Vector3
    moved(const unsigned int node, const Vector3 &x) const
    {
      return state.position(node) + turn(node) * (x - start.position(node));
    }

    /** The rotation of a body since the start. */
    Matrix3
    turn(const unsigned int node) const
    {
      return state.triad(node) * start.triad(node).transpose();
    }

    /** Of the material of a body at the place @p x. */
    Vector3
    velocity(const unsigned int node, const Vector3 &x) const
    {
      return state.triad(node) * Eigen::Map<const Vector3>(&state.y[6 * node]) +
             spin(node).cross(x - state.position(node));
    }

    Vector3
    spin(const unsigned int node) const
    {
      return state.triad(node) * Eigen::Map<const Vector3>(&state.y[6 * node + 3]);
    }

    /** Let a body spin and a point of it have a velocity. */
    void
    set_velocity(const unsigned int node, const Vector3 &x, const Vector3 &v, const Vector3 &spin)
    {
      const Matrix3 D = state.triad(node);
      Eigen::Map<Vector6>(&state.y[6 * node]) << D.transpose() * (v + spin.cross(state.position(node) - x)),
        D.transpose() * spin;
    }

    const std::vector<double> &
    constraint_rates()
    {
      scene.system.constraint_rates(state.point(), rates.data());
      return rates;
    }

    /** Force and moment about @p x of the joint on a body. */
    std::pair<Vector3, Vector3>
    wrench(const unsigned int node, const Vector3 &x) const
    {
      std::vector<double> r(scene.system.size() + 6, 0.);
      scene.system.add_constraints(state.point(), r.data());
      const Matrix3 D = state.triad(node);
      const int     i = scene.system.layout.of_node(node);
      const Vector3 f = -D * Eigen::Map<const Vector3>(&r[i]), m = -D * Eigen::Map<const Vector3>(&r[i + 3]);
      return {f, m + (state.position(node) - x).cross(f)};
    }
  };

  const unsigned int A = 1, B = 2;
  const Vector3      middle(0.8, 0.9, 0.5); // of the ball, and the place of the blade

  std::string
  complaint(const std::string &joint)
  {
    return complaint_of(two_bodies(joint));
  }
} // namespace



// Rows 2 and 3: the velocity of the ball at the contact against the table, along two tangents fixed to the table.
TEST(RollingBall, SlipIsOfTheMaterialAtTheContact)
{
  Somewhere     at(ball);
  const Matrix3 E       = at.turn(A) * triad_about(normal, near_1);
  const Vector3 contact = at.moved(B, middle) - radius * E.col(2);
  const Vector3 slip    = at.velocity(B, contact) - at.velocity(A, contact);
  EXPECT_GT(slip.norm(), 0.1);
  EXPECT_NEAR(at.constraint_rates()[1], slip.dot(E.col(0)), 1e-14);
  EXPECT_NEAR(at.constraint_rates()[2], slip.dot(E.col(1)), 1e-14);
  ASSERT_EQ(at.scene.system.layout.nonholonomic, (std::vector<unsigned int>{1, 2}));
  ASSERT_EQ(at.scene.system.layout.n_multipliers, 3u);
}



// v = v_A + ω × R n: the ball spins as it likes, on a table that moves as it likes, with the contact a radius away.
TEST(RollingBall, Kinematics)
{
  Somewhere at(ball);
  at.state              = at.start;
  const Vector3 contact = middle - radius * normal;
  for (const bool table_moves : {false, true})
    {
      const Vector3 v_A = table_moves ? Vector3(1, -2, 0.5) : Vector3::Zero().eval(), w_A(0.7, 0.2, -1), w(3, -1, 2);
      at.set_velocity(A, contact, v_A, table_moves ? w_A : Vector3::Zero().eval());
      at.set_velocity(B, middle, v_A + w.cross(radius * normal), w);
      for (const double rate : at.constraint_rates())
        EXPECT_NEAR(rate, 0, 1e-14);
      // slip along a tangent is told by it, and lifting off by the distance
      const Vector3 E1 = triad_about(normal, near_1).col(0);
      at.set_velocity(B, middle, v_A + w.cross(radius * normal) + 0.5 * E1 + 0.25 * normal, w);
      EXPECT_NEAR(at.constraint_rates()[0], 0.25, 1e-14);
      EXPECT_NEAR(at.constraint_rates()[1], 0.5, 1e-14);
      EXPECT_NEAR(at.constraint_rates()[2], 0, 1e-14);
    }
}



// One force at the contact, on the table its opposite; the probes are its components in the axes of the table.
TEST(RollingBall, ForceActsAtTheContact)
{
  Somewhere at(ball);
  at.state.multipliers  = {5, -3, 2};
  const Matrix3 E       = at.turn(A) * triad_about(normal, near_1);
  const Vector3 contact = at.moved(B, middle) - radius * E.col(2), expected = -E * Vector3(-3, 2, 5);
  const auto [force, moment]     = at.wrench(B, contact);
  const auto [reaction, counter] = at.wrench(A, contact);
  EXPECT_LT((force - expected).norm(), 1e-14);
  EXPECT_LT(moment.norm(), 1e-14);
  EXPECT_LT((reaction + expected).norm(), 1e-14);
  EXPECT_LT(counter.norm(), 1e-14);
  for (unsigned int i = 0; i < 3; ++i)
    EXPECT_NEAR(at.scene.input.model.probe("j.force " + std::to_string(i + 1)).value(at.state),
                E.col(i).dot(force),
                1e-14);
  EXPECT_THROW(at.scene.input.model.probe("j.moment 3"), std::invalid_argument);
}



// Whatever the multipliers are, their forces have no power at velocities that obey the constraints, b y = 0.
TEST(RollingBall, ForcesHaveNoPower)
{
  for (const std::string &joint : {ball, std::string("set Type = knife edge\nset Axis = 1, 2, 2\n")})
    {
      Somewhere          at(joint);
      const unsigned int m = at.rates.size();
      Eigen::MatrixXd    b(m, 12);
      for (unsigned int j = 0; j < 12; ++j)
        {
          std::fill(at.state.y.begin(), at.state.y.end(), 0.);
          at.state.y[6 + j] = 1;
          b.col(j)          = Eigen::Map<const Eigen::VectorXd>(at.constraint_rates().data(), m);
        }
      for (unsigned int i = 0; i < m; ++i)
        at.state.multipliers[i] = 3. - 2. * i;
      std::vector<double> r(at.scene.system.size() + 6, 0.);
      at.scene.system.add_constraints(at.state.point(), r.data());
      const Eigen::MatrixXd admissible = FullLu(b).kernel();
      ASSERT_EQ(admissible.cols(), 12 - static_cast<int>(m));
      EXPECT_LT((admissible.transpose() * Eigen::Map<const Eigen::VectorXd>(r.data(), 12)).norm(), 1e-13);
      EXPECT_GT(Eigen::Map<const Eigen::VectorXd>(r.data(), 12).norm(), 1.);
    }
}



namespace
{
  /** A solid ball of 5 kg on a floor, held by springs at its centre, with its weight. */
  std::string
  held_ball(const double rotational_stiffness, const std::string &force)
  {
    std::ostringstream text;
    text
      << "subsection Bodies\n subsection ball\n set Type = rigid body\n set Mass = 5\n set Position = 2, 1, 0.3\n"
         " set Inertia = 0.18, 0.18, 0.18\n end\nend\nsubsection Joints\n subsection floor\n set Type = rolling ball\n"
         " set Body A = ground\n set Body B = ball.centre\n set Axis 1 = 1, 0, 0\n set Radius = 0.3\n"
         " set Position = 0, 0, 0\n end\n"
         " subsection springs\n set Type = flexible joint\n set Body A = ground\n set Body B = ball.centre\n"
         " set Axis = 1, 0, 0\n set Axis 2 = 0, 1, 0\n set Stiffness = 70, 70, 0\n set Rotational stiffness = 0, "
      << rotational_stiffness
      << ", 4.5\n end\nend\nsubsection Loads\n subsection weight\n set Type = gravity\n set Acceleration = 0, 0, -10\n end\n"
         " subsection push\n set Type = point load\n set At = ball.centre\n set Force = "
      << force << "\n end\nend\n";
    return text.str();
  }
} // namespace



// A small push F: the ball rolls by x, turning by x/R against a torsional spring, F = k x + k_r x/R²; the floor holds
// it back with k_r x/R², and carries its weight. The contact is told from the origin of the plane.
TEST(RollingBall, Equilibrium)
{
  Scene scene(held_ball(6.3, "1e-4, 0, 0"));
  scene.equilibrium();
  const double x = 1e-4 / (70 + 6.3 / 0.09);
  EXPECT_NEAR(scene.value("ball.displacement x"), x, 1e-9 * x);
  EXPECT_NEAR(scene.value("ball.displacement z"), 0, 1e-15);
  EXPECT_NEAR(scene.value("ball.rotation y") * M_PI / 180, x / 0.3, 1e-9 * x);
  EXPECT_NEAR(scene.value("floor.force 1"), -6.3 * x / 0.09, 1e-13);
  EXPECT_NEAR(scene.value("floor.force 2"), 0, 1e-13);
  EXPECT_NEAR(scene.value("floor.force 3"), 50, 1e-12);
  EXPECT_NEAR(scene.value("floor.displacement 1"), 2 + x, 1e-13);
  EXPECT_NEAR(scene.value("floor.displacement 2"), 1, 1e-13);
}



// Rolling adds J/R² = 2/5 m to the mass: ω² = k / (7/5 m), in both directions; spinning on the spot, ω² = k_r / J.
TEST(RollingBall, Modes)
{
  Scene scene(held_ball(0, "0, 0, 0"));
  scene.equilibrium();
  const auto &modes = scene.modes();
  ASSERT_EQ(modes.size(), 3u);
  EXPECT_NEAR(modes[0].frequency(), std::sqrt(70 / (1.4 * 5)), 1e-9);
  EXPECT_NEAR(modes[1].frequency(), std::sqrt(70 / (1.4 * 5)), 1e-9);
  EXPECT_NEAR(modes[2].frequency(), std::sqrt(4.5 / 0.18), 1e-9);
}



// Without a position the plane is put below the ball.
TEST(RollingBall, PlaneBelowTheBall)
{
  Scene scene(two_bodies(ball));
  EXPECT_NEAR(scene.value("j.displacement 1"), 0, 1e-15);
  EXPECT_NEAR(scene.value("j.displacement 2"), 0, 1e-15);
  std::vector<double> r;
  scene.system.residual(scene.context.state, scene.context.state.stress, r);
  EXPECT_NEAR(r[scene.system.layout.of_multiplier(0)], 0, 1e-14);
}



TEST(RollingBall, Drawing)
{
  const Scene scene(two_bodies(ball));
  Drawing     drawing(&scene.input.model);
  scene.input.model.items.back()->draw(scene.context.state, drawing);
  ASSERT_EQ(drawing.objects, std::vector<std::string>{"j"});
  double lowest = 0, highest = 0;
  for (const auto &corner : drawing.corners)
    {
      lowest  = std::min(lowest, normal.dot(corner.x - middle));
      highest = std::max(highest, normal.dot(corner.x - middle));
    }
  EXPECT_NEAR(highest, radius, 0.02 * radius);
  EXPECT_LT(lowest, -radius);
  EXPECT_NEAR(lowest, -radius, 0.05 * radius);
}



TEST(RollingBall, RefusesWhatIsSenseless)
{
  const auto refused = [](const std::string &joint, const std::string &words) {
    const std::string text = complaint(joint);
    EXPECT_NE(text.find(words), std::string::npos) << joint << text;
  };
  refused("set Type = rolling ball\n", "<Radius> must be given");
  refused("set Type = rolling ball\nset Radius = 0\n", "must have a radius above zero");
  refused(ball + "set Position = 0, 0, 0\n",
          "m above the plane (to the side where <Axis> points), not its radius, 0.3 m");
  // a plane that faces away
  refused(ball + "set Position = 0.9, 1.1, 0.7\n", "the centre of the ball is -0.");
  refused("set Type = rolling ball\nset Radius = 1\nset Axis = 0, 0, 0\n", "a direction must not be zero");
  // a hundred metres away and exact but for round-off
  EXPECT_EQ(complaint(ball + "set Position = 0.7, 100.7, -99.7\n"), "");
  EXPECT_EQ(complaint(ball), "");
}



// The velocity of the blade across itself, in axes of the body with the blade, against the table below it.
TEST(KnifeEdge, VelocityIsOfTheMaterialAtTheBlade)
{
  for (const std::string place : {"", "set Position = 0.1, 1.2, -0.4\n"})
    {
      Somewhere     at("set Type = knife edge\nset Axis = 1, 2, 2\n" + place);
      const Vector3 x      = at.moved(B, place.empty() ? middle : Vector3(0.1, 1.2, -0.4));
      const Vector3 across = at.turn(B) * normal;
      EXPECT_NEAR(at.constraint_rates().at(0), across.dot(at.velocity(B, x) - at.velocity(A, x)), 1e-14);
      ASSERT_EQ(at.scene.system.layout.nonholonomic, std::vector<unsigned int>{0});
    }
}



TEST(KnifeEdge, ForceActsAcrossTheBlade)
{
  Somewhere at("set Type = knife edge\nset Axis = 1, 2, 2\n");
  at.state.multipliers = {4};
  const Vector3 x = at.moved(B, middle), expected = -4 * at.turn(B) * normal;
  const auto [force, moment]     = at.wrench(B, x);
  const auto [reaction, counter] = at.wrench(A, x);
  EXPECT_LT((force - expected).norm(), 1e-14);
  EXPECT_LT(moment.norm(), 1e-14);
  EXPECT_LT((reaction + expected).norm(), 1e-14);
  EXPECT_LT(counter.norm(), 1e-14);
  EXPECT_NEAR(at.scene.input.model.probe("j.force 1").value(at.state), -4, 1e-15);
  EXPECT_THROW(at.scene.input.model.probe("j.force 2"), std::invalid_argument);
}



namespace
{
  /** A sledge on the plane z = 0 with its centre of mass 0.8 m ahead of the blade, which points along x. */
  const std::string sledge =
    "subsection Bodies\n subsection sledge\n set Type = rigid body\n set Mass = 3\n set Inertia = 1, 1, 0.5\n"
    " set Position = 0.8, 0, 0\n end\nend\nsubsection Joints\n subsection ice\n set Type = planar\n set Body A = ground\n"
    " set Body B = sledge.centre\n set Axis 1 = 1, 0, 0\n subsection displacement 1\n set Spring = 12\n end\n"
    " subsection rotation\n set Spring = 20\n end\n end\n subsection blade\n set Type = knife edge\n set Body A = ground\n"
    " set Body B = sledge.centre\n set Position = 0, 0, 0\n set Axis = 0, 1, 0\n end\nend\n";
} // namespace



// It turns about the blade and slides along it: ω² = k_θ/(J + m a²), ω² = k/m.
TEST(KnifeEdge, Modes)
{
  Scene       scene(sledge);
  const auto &modes = scene.modes();
  ASSERT_EQ(modes.size(), 2u);
  EXPECT_NEAR(modes[0].frequency(), 2., 1e-10);
  EXPECT_NEAR(modes[1].frequency(), std::sqrt(20 / (0.5 + 3 * 0.64)), 1e-10);
}



// A small side force is held by the blade, its moment about it by the spring.
TEST(KnifeEdge, Equilibrium)
{
  Scene scene(sledge + "subsection Loads\n subsection push\n set Type = point load\n set At = sledge.centre\n"
                       " set Force = 0, 1e-4, 0\n end\nend\n");
  scene.equilibrium();
  const double theta = 0.8e-4 / 20;
  EXPECT_NEAR(scene.value("ice.rotation") * M_PI / 180, theta, 1e-9 * theta);
  EXPECT_NEAR(scene.value("sledge.displacement y"), 0.8 * theta, 1e-9 * theta);
  EXPECT_NEAR(scene.value("blade.force 1"), -1e-4, 1e-12);
}



TEST(KnifeEdge, RefusesWhatIsSenseless)
{
  EXPECT_NE(complaint("set Type = knife edge\nset Axis = 0, 0, 0\n").find("a direction must not be zero"),
            std::string::npos);
  EXPECT_EQ(complaint("set Type = knife edge\n"), "");
}
