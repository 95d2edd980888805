// Beams in groups of contacts: nearest places on lines, stations on surfaces.
//
// References: places of circle and line; energies, with the potential of a search of its own; momenta of free bodies;
// Euler's and Eytelwein's formula of the rope on a drum.

#include <samara/model/contact_group.h>

#include <gtest/gtest.h>

#include "contact_motion.h"

using namespace samara;
using namespace samara::systems;

namespace
{
  const std::string tube_section =
    "subsection Sections\n subsection s\n set Type = tube\n set E = 2e9\n set Density = 1000\n"
    " set Outer radius = 0.02\n end\nend\n";

  std::string
  beam_of(const std::string &name, const std::string &points, const std::string &more)
  {
    return "  subsection " + name + "\n set Type = beam\n set Section = s\n set Points = " + points + "\n" + more +
           " end\n";
  }

  std::string
  lines_model(const std::string &bodies, const std::string &entries)
  {
    return tube_section + model(bodies, joint("touching", "contacts", entries));
  }

  struct Bounds
  {
    double touch;    ///< energy of the contact at least, at some time [J]
    double drift;    ///< of the energy, at most
    double momentum; ///< the same, linear, relative
  };

  /** What flies in space keeps energy and momentum while it touches and rubs. */
  void
  expect_flight(const Scene &scene, const double h, const double T, const Bounds &bounds)
  {
    const auto   &group = *scene.system.layout.contact_groups.at(0);
    const Vector6 start = momentum_of(scene.system, start_of({"", "", 0, 0}, scene.system));
    double        most  = 0;
    const auto    run   = contact_motion(
      scene.system,
      Tableau(3, 1.),
      h,
      T,
      [&](const State &state, const StepResult &) { most = std::max(most, group.energy(state.q.data())); },
      1e-10);
    EXPECT_GT(most, bounds.touch);
    EXPECT_LT(run.drift, bounds.drift);
    EXPECT_GT(run.friction_loss, 1e-4);
    EXPECT_LT((momentum_of(scene.system, run.state) - start).head<3>().norm(),
              bounds.momentum * start.head<3>().norm());
  }
} // namespace



// A half circle of two elements and a line across it are near at two places, which are found from either piece.
TEST(ContactLines, BothPlacesOfACurve)
{
  const Scene scene(
    lines_model(beam_of("bow", "-1, 0, 0; 0, 1, 0; 1, 0, 0", "set Shape = arc\n set Elements = 2\n set Degree = 4\n") +
                  beam_of("rod", "-1.5, 0.5, 0.1; 1.5, 0.5, 0.1", "set Elements = 1\n"),
                "set Beams = bow radius 0.06, rod radius 0.06\n set Stiffness = 1e4\n set Overlap = allowed\n"));
  const auto                     &group = *scene.system.layout.contact_groups.at(0);
  const State                     state = scene.system.reference();
  std::vector<ContactGroup::Pair> pairs;
  ContactGroup::Margins           margins;
  group.find_pairs(state.q.data(), state.y.data(), 0, pairs, margins);
  ASSERT_EQ(pairs.size(), 2u);
  for (unsigned int i = 0; i < 2; ++i)
    {
      // the nearest place of the circle is at the angle asin(0.5) from its ends
      const double s = i == 0 ? M_PI / 6 : M_PI - M_PI / 6;
      EXPECT_NEAR(pairs[i].nearest.b.s, s, 2e-3);
      EXPECT_NEAR(pairs[i].nearest.a.s, 1.5 - std::cos(s), 2e-3);
      EXPECT_NEAR(group.gap(pairs[i], state.q.data()), 0.02, 2e-4);
    }
  EXPECT_NEAR(group.energy(state.q.data()), 1e4 * 0.02 * 0.02, 2e-2 * 4);
}



// Beams that cross and meet, far from their middles, so that places move along both: energy and momentum.
TEST(ContactLines, BeamsThatMeet)
{
  const Scene scene(lines_model(
    beam_of("a", "-0.5, 0, 0; 0.5, 0, 0", "set Elements = 2\n set Velocity = 0.2, 0, 1\n") +
      beam_of("b", "0.1, -0.3, 0.05; 0.3, 0.7, 0.05", "set Elements = 3\n set Angular velocity = 0.5, 0, 0\n"),
    "set Beams = a radius 0.02, b radius 0.02\n set Stiffness = 1e5\n set Exponent = 1.5\n"
    " set Friction = 0.3\n set Sticking speed = 0.01\n"));
  expect_flight(scene, 5e-4, 0.03, {0.01, 1e-8, 1e-9});
}



// A bow falls on a rod with one end first: while it is pressed there a second place comes. Coarse steps are halved
// where one has no predecessor, and no energy comes from nothing.
TEST(ContactLines, SecondPlaceWhilePressed)
{
  const Scene scene(
    lines_model(beam_of("bow",
                        "-0.5, 0, 0.09; 0, 0, 0.33; 0.5, 0, 0.1",
                        "set Shape = arc\n set Elements = 3\n set Velocity = 0, 0, -5\n") +
                  beam_of("rod", "-0.7, 0.05, 0; 0, -0.05, 0.05; 0.7, 0.05, 0", "set Shape = arc\n set Elements = 2\n"),
                "set Beams = bow radius 0.02, rod radius 0.02\n set Stiffness = 1e5\n set Exponent = 1.5\n"));
  const auto &group = *scene.system.layout.contact_groups.at(0);
  double      most  = 0;
  const auto  run   = contact_motion(
    scene.system,
    Tableau(2, 1.),
    5e-3,
    0.03,
    [&](const State &state, const StepResult &) { most = std::max(most, group.energy(state.q.data())); },
    1e-9);
  EXPECT_GT(most, 0.1);
  EXPECT_LT(run.drift, 1e-7);
}



// A drum that flies faster than its own size a step against a beam at rest: both are thrown, and nothing is made.
TEST(ContactLines, MovingDrumMeetsABeam)
{
  const std::string bodies =
    rigid_body("drum",
               "set Mass = 50\n set Inertia = 5, 5, 5\n set Position = 0, 0, -1\n" + moving("0, 0, 30", "0, 0, 0")) +
    beam_of("rod", "-0.5, 0.1, 0; 0.5, 0.1, 0", "set Elements = 3\n");
  const Scene   scene(lines_model(bodies,
                                "set Beams = rod radius 0.02\n set Line stiffness = 1e7\n set Stations = 3\n"
                                  " set Cylinders = drum at 0 0 -1 axis 0 1 0 radius 0.2\n"));
  const auto   &group = *scene.system.layout.contact_groups.at(0);
  const Vector6 start = momentum_of(scene.system, start_of({"", "", 0, 0}, scene.system));
  double        most  = 0;
  const auto    run   = contact_motion(
    scene.system,
    Tableau(2, 1.),
    0.02,
    0.04,
    [&](const State &state, const StepResult &) { most = std::max(most, group.energy(state.q.data())); },
    1e-9);
  EXPECT_GT(most, 1.);
  EXPECT_LT(run.drift, 1e-6);
  EXPECT_LT((momentum_of(scene.system, run.state) - start).head<3>().norm(), 1e-4 * start.head<3>().norm());
  EXPECT_LT(run.state.y[8], 30.);
}



// A cantilever sinks on a rigid rod across it, anywhere within an element: the reaction of a prop under an even load.
TEST(ContactLines, BeamOnARod)
{
  const double a = 0.63, L = 1, w = M_PI * 0.02 * 0.02 * 1000 * 9.80665;
  Scene        scene("prm/examples/beam_on_rod.prm");
  scene.equilibrium();
  EXPECT_NEAR(scene.value("touching.bar.force z") / (-w * (6 * L * L - 4 * a * L + a * a) / (8 * a)), 1, 0.01);
}



// A rod that flies and turns strikes a beam with its round end and with its side, a ball strikes the rod: energy and
// momentum.
TEST(ContactLines, RodsThatFly)
{
  const std::string bodies =
    rigid_body(
      "stick",
      "set Mass = 2\n set Inertia = 0.02, 0.1, 0.1\n set Position = 0.1, 0.05, 0.3\n set Centre of mass = 0.05, 0, 0\n" +
        moving("0, 0, -3", "1, 4, 2")) +
    ball("a", 0.05, {-0.1, 0.3, 0.3}, {0, -4, -3}, {0, 0, 0}) +
    beam_of("rod", "-0.5, 0, 0; 0.5, 0.1, 0", "set Elements = 3\n");
  const Scene scene(lines_model(bodies,
                                "set Balls = a radius 0.05\n set Beams = rod radius 0.02\n set Stiffness = 1e6\n"
                                " set Exponent = 1.5\n set Friction = 0.2\n set Sticking speed = 0.05\n"
                                " set Rods = stick from -0.2 0.05 0.3 to 0.4 0.15 0.35 radius 0.03\n"));
  expect_flight(scene, 1e-3, 0.15, {0.1, 1e-7, 1e-8});
}



// Beams side by side have no nearest places: a run ends there, and says why.
TEST(ContactLines, ParallelBeamsAreRefused)
{
  const Scene scene(lines_model(beam_of("a", "-0.5, 0, 0; 0.5, 0, 0", "set Elements = 1\n set Velocity = 0, 0, 1\n") +
                                  beam_of("b", "-0.5, 0, 0.05; 0.5, 0, 0.05", "set Elements = 1\n"),
                                "set Beams = a radius 0.02, b radius 0.02\n set Stiffness = 1e5\n"));
  try
    {
      contact_motion(scene.system, Tableau(2, 1.), 2e-3, 0.1);
      ADD_FAILURE() << "they went through each other";
    }
  catch (const NotConverged &problem)
    {
      EXPECT_NE(std::string(problem.what()).find("parallel"), std::string::npos) << problem.what();
    }
}



// Neither have they modes.
TEST(ContactLines, ParallelBeamsHaveNoModes)
{
  const auto clamp = [](const std::string &name) {
    return joint("clamp " + name, "rigid", "set Body A = ground\n set Body B = " + name + ".start\n");
  };
  Scene scene(
    tube_section +
    model(beam_of("a", "-0.5, 0, 0; 0.5, 0, 0", "set Elements = 1\n") +
            beam_of("b", "-0.5, 0, 0.0399; 0.5, 0, 0.0399", "set Elements = 1\n"),
          clamp("a") + clamp("b") +
            joint("touching",
                  "contacts",
                  "set Beams = a radius 0.02, b radius 0.02\n set Stiffness = 1e3\n set Overlap = allowed\n")));
  try
    {
      scene.modes();
      ADD_FAILURE() << "modes of what is not determined";
    }
  catch (const NotConverged &problem)
    {
      EXPECT_NE(std::string(problem.what()).find("parallel"), std::string::npos) << problem.what();
    }
}



// The rope on a turning drum in statics: exp(μ π R/(R + r)) times the weight at the hold. Friction acts at the surface
// of the drum, the force of the rope on its line.
TEST(ContactLines, Eytelwein)
{
  Scene scene("prm/examples/rope_on_drum.prm");
  scene.equilibrium();
  double square = 0;
  for (const std::string component : {"1", "2", "3"})
    square += std::pow(scene.value("hold.force " + component), 2);
  EXPECT_NEAR(std::sqrt(square) / 100, std::exp(0.3 * M_PI * 200 / 201), 2e-3);
}



// A ball rolls down a flexible beam from element to element: their ends are no places of their own, and a ball that is
// pressed into the inner side of a kink of the mesh does not get a second one.
TEST(ContactLines, BallRollsAcrossElements)
{
  const Scene scene(
    tube_section +
    model(beam_of("rail", "0, 0, 0.3; 0.5, 0, 0.05; 1, 0, 0", "set Shape = arc\n set Elements = 7\n set Degree = 2\n") +
            ball("a", 0.05, {0.12, 0, 0.31}, {0, 0, 0}, {0, 0, 0}),
          joint("clamp", "rigid", "set Body A = ground\n set Body B = rail.start\n") +
            joint("touching",
                  "contacts",
                  "set Balls = a\n set Ball radius = 0.05\n set Beams = rail radius 0.02\n set Stiffness = 1e5\n"
                  " set Exponent = 1.5\n set Restitution = 0.5\n set Impact speed = 1\n set Friction = 0.3\n"
                  " set Sticking speed = 0.02\n"),
          gravity));
  const auto         run = contact_motion(scene.system, Tableau(2, 0.5), 2e-3, 0.5, nullptr, 1e-9);
  const unsigned int a   = scene.system.layout.n_nodes - 1;
  EXPECT_GT(run.state.position(a)(0), 0.45); // beyond three ends
  EXPECT_GT(run.state.position(a)(2), 0.0);
  EXPECT_LT(run.drift, 1e-6);
}
