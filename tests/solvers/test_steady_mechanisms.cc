// Steady motions of rotors, shafts and gears, speed of the drive 1 rad/s. Numbers are those of kinematics: speeds of
// gear trains and of bearings one against the other are closed forms, the universal joint's are cos α and 1/cos α,
// those of the tilted swash-plate and of the four-bar were found by an independent program (Python, twists of bodies,
// singular value decompositions; four digits).

#include <gtest/gtest.h>

#include "mechanism.h"

using namespace samara;

namespace
{
  constexpr double exact = 1e-12;

  Mechanism
  shaft(const double speed = 1)
  {
    return Mechanism().body("hub", {0, 0, 1}).revolute("shaft", "ground", "hub", {0, 0, 0}).drive("shaft", speed);
  }

  Mechanism
  articulated(Mechanism m = shaft())
  {
    m.body("lag block", {.1, 0, 1}).body("flap block", {.15, 0, 1}).body("blade", {.2, 0, 1});
    return m.revolute("lag", "hub", "lag block", {.1, 0, 1})
      .revolute("flap", "lag block", "flap block", {.15, 0, 1}, {0, 1, 0})
      .revolute("pitch", "flap block", "blade", {.2, 0, 1}, {1, 0, 0});
  }

  /** A slider and a universal joint under a bearing, links from its upper plate to the horns of hinged blades. */
  struct SwashPlate
  {
    bool         scissors = true, cyclic_is_free = false, rods = false;
    double       tilt = 0, link = 0.5;
    unsigned int n_blades = 4;

    Mechanism
    model() const
    {
      Mechanism    m = shaft();
      const double z = 1 - link, nx = std::sin(tilt), nz = std::cos(tilt);
      std::string  feet;
      const auto   foot = [&](const unsigned int k) -> Point3 {
        const double phi = 2 * M_PI * k / n_blades, c = std::cos(phi), s = std::sin(phi);
        const double x = .28 * c + .18 * s, y = .28 * s - .18 * c;
        return {x, y, z - x * nx / nz}; // in the plane of the plate
      };
      const auto frame = [](const std::string &name, const Point3 &x) {
        return name + " at " + Mechanism::number(x[0]) + " " + Mechanism::number(x[1]) + " " + Mechanism::number(x[2]);
      };
      for (unsigned int k = 0; k < n_blades; ++k)
        feet += (k > 0 ? ", " : "") + frame("foot " + std::to_string(k), foot(k));
      m.body("slider", {0, 0, z}).body("lower", {0, 0, z}).body("upper", {0, 0, z}, feet);
      m.joint(
        "collective", "prismatic", "ground", "slider", Mechanism::place({0, 0, z}) + Mechanism::hold("displacement"));
      m.universal("cyclic", "slider", "lower", {0, 0, z}, {1, 0, 0}, {0, 1, 0}, !cyclic_is_free);
      m.revolute("bearing", "lower", "upper", {0, 0, z}, {nx, 0, nz});
      for (unsigned int k = 0; k < n_blades; ++k)
        {
          const std::string n   = std::to_string(k);
          const double      phi = 2 * M_PI * k / n_blades, c = std::cos(phi), s = std::sin(phi);
          const Point3      low = foot(k), horn = {.28 * c + .18 * s, .28 * s - .18 * c, 1};
          m.body("flapper " + n, {.28 * c, .28 * s, 1}).body("blade " + n, {.4 * c, .4 * s, 1}, frame("horn", horn));
          m.revolute("flap " + n, "hub", "flapper " + n, {.28 * c, .28 * s, 1}, {-s, c, 0});
          m.revolute("pitch " + n, "flapper " + n, "blade " + n, {.4 * c, .4 * s, 1}, {c, s, 0});
          if (rods)
            m.joint("link " + n, "distance", "upper.foot " + n, "blade " + n + ".horn", "");
          else
            m.body("link " + n, low)
              .universal("low " + n, "upper", "link " + n, low, {c, s, 0}, {-s, c, 0})
              .joint("ball " + n, "spherical", "link " + n, "blade " + n, Mechanism::place(horn));
        }
      if (scissors)
        {
          m.body("arm 1", {.2, 0, z + .2}).body("arm 2", {.3, 0, z + .1});
          m.revolute("elbow 1", "hub", "arm 1", {.05, 0, z + .3}, {0, 1, 0});
          m.revolute("elbow 2", "arm 1", "arm 2", {.25, 0, z + .15}, {0, 1, 0});
          m.joint("arm ball", "spherical", "arm 2", "upper", Mechanism::place({.1, 0, z - .1 * nx / nz}));
        }
      return m;
    }
  };

  void
  expect_spin(const Moving &m, const std::string &body, const Vector3 &spin, const double tolerance = exact)
  {
    EXPECT_LT((m.spin(body) - spin).norm(), tolerance) << body << " " << m.spin(body).transpose();
  }

  /** All relative motions but these are at rest. */
  void
  expect_rest_but(const Moving &m, const std::vector<std::string> &moving, const double tolerance = exact)
  {
    for (const auto &[name, rate] : m.rates)
      {
        const bool moves = std::find(moving.begin(), moving.end(), name) != moving.end();
        EXPECT_NEAR(moves ? 0 : rate, 0, tolerance) << name;
      }
  }
} // namespace



TEST(SteadyMechanisms, HingedBladesTurnWithTheirHub)
{
  const Moving m(articulated());
  for (const std::string body : {"hub", "lag block", "flap block", "blade"})
    expect_spin(m, body, {0, 0, 1});
  expect_rest_but(m, {"shaft.rotation"});
  EXPECT_TRUE(m.motion.findings.is_steady());
  EXPECT_NEAR(m.scene.value("blade.velocity y"), .2, exact);
}



TEST(SteadyMechanisms, TeeteringAndGimballedRotors)
{
  for (const std::string kind : {"teeter", "universal", "ball"})
    {
      Mechanism m = shaft().body("rotor", {0, 0, 1});
      if (kind == "teeter")
        m.revolute("on hub", "hub", "rotor", {0, 0, 1}, {0, 1, 0});
      else if (kind == "universal")
        m.universal("on hub", "hub", "rotor", {0, 0, 1}, {1, 0, 0}, {0, 1, 0});
      else
        m.joint("on hub", "spherical", "hub", "rotor", Mechanism::place({0, 0, 1}));
      const Moving moving(m);
      expect_spin(moving, "rotor", {0, 0, 1});
      expect_rest_but(moving, {"shaft.rotation"});
      EXPECT_TRUE(moving.motion.findings.is_steady()) << kind;
    }
}



// A free wheel is a hinge: held while the engine drives, free while the rotor overruns it, each with its own drive. A rotor
// that is slower than the engine that drives it contradicts the held one.
TEST(SteadyMechanisms, FreeWheel)
{
  const auto model = [](const bool drives, const double rotor) {
    Mechanism m = Mechanism().body("engine", {0, 0, 0}).body("hub", {0, 0, 1}).body("blade", {.2, 0, 1});
    m.revolute("engine", "ground", "engine", {0, 0, 0}).drive("engine", 1);
    m.joint("wheel",
            "revolute",
            "engine",
            "hub",
            Mechanism::place({0, 0, .5}) + (drives ? Mechanism::hold("rotation") : std::string()));
    m.joint("bearing", "cylindrical", "ground", "hub", Mechanism::place({0, 0, 1}));
    m.revolute("flap", "hub", "blade", {.2, 0, 1}, {0, 1, 0});
    return rotor == 0 ? m : m.drive("bearing", rotor);
  };
  const Moving driving(model(true, 0)), overrunning(model(false, 2));
  expect_spin(driving, "blade", {0, 0, 1}, 1e-9);
  EXPECT_NEAR(driving.rates.at("wheel.rotation"), 0, 1e-9);
  expect_spin(overrunning, "blade", {0, 0, 2}, 1e-9);
  EXPECT_NEAR(overrunning.rates.at("wheel.rotation"), 1, 1e-9);
  EXPECT_TRUE(driving.motion.findings.is_steady());
  EXPECT_TRUE(overrunning.motion.findings.is_steady());
  EXPECT_THROW(Moving(model(true, .5)), InputError);
}



TEST(SteadyMechanisms, SwashPlates)
{
  SwashPlate with_scissors, free_cyclic, without, long_links, rods;
  free_cyclic.cyclic_is_free = true;
  without.scissors = long_links.scissors = rods.scissors = false;
  long_links.n_blades                                    = 2;
  long_links.link                                        = 3;
  rods.rods                                              = true;
  for (const SwashPlate &plate : {with_scissors, free_cyclic, without, long_links, rods})
    {
      const Moving m(plate.model());
      SCOPED_TRACE("scissors " + std::to_string(plate.scissors) + ", blades " + std::to_string(plate.n_blades) +
                   ", rods " + std::to_string(plate.rods) + ", cyclic free " + std::to_string(plate.cyclic_is_free));
      expect_spin(m, "lower", {0, 0, 0}, 1e-9);
      expect_spin(m, "upper", {0, 0, 1}, 1e-9);
      EXPECT_NEAR(m.rates.at("bearing.rotation"), 1, 1e-9);
      expect_rest_but(m, {"shaft.rotation", "bearing.rotation"}, 1e-9);
      EXPECT_TRUE(m.motion.findings.is_steady());
    }
}



TEST(SteadyMechanisms, TiltedSwashPlateIsNotSteady)
{
  SwashPlate plate;
  plate.tilt = 0.1;
  const Moving m(plate.model());
  EXPECT_FALSE(m.motion.findings.is_steady());
  const RateRange bearing = m.range("bearing.rotation"), pitch = m.range("pitch 0.rotation"),
                  arm = m.range("elbow 1.rotation");
  EXPECT_NEAR(bearing.lowest, .995, 5e-4);
  EXPECT_NEAR(bearing.highest, 1.005, 5e-4);
  EXPECT_NEAR(pitch.lowest, -.188, 2e-3);
  EXPECT_NEAR(pitch.highest, .188, 2e-3);
  EXPECT_NEAR(arm.highest, .03, 5e-3);
}



TEST(SteadyMechanisms, MastMountedSightStaysBehind)
{
  Mechanism m = articulated().body("sight", {0, 0, 1.5}).revolute("hub bearing", "hub", "sight", {0, 0, 1.2});
  m.elastic("stand pipe", "ground", "sight", {0, 0, 1});
  const Moving moving(m);
  expect_spin(moving, "sight", {0, 0, 0});
  expect_spin(moving, "blade", {0, 0, 1});
  EXPECT_NEAR(moving.rates.at("hub bearing.rotation"), -1, exact);
  EXPECT_TRUE(moving.motion.findings.is_steady());
}



TEST(SteadyMechanisms, UniversalJointOnABend)
{
  const auto bent = [](const double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    Mechanism    m = shaft().body("out", {.5 * s, 0, 1 + .5 * c});
    m.universal("cross", "hub", "out", {0, 0, 1}, {0, 1, 0}, {c, 0, -s});
    return m.revolute("out bearing", "ground", "out", {.5 * s, 0, 1 + .5 * c}, {s, 0, c});
  };
  const Moving straight(bent(0)), at_30(bent(M_PI / 6));
  EXPECT_TRUE(straight.motion.findings.is_steady());
  EXPECT_NEAR(straight.rates.at("out bearing.rotation"), 1, exact);
  EXPECT_FALSE(at_30.motion.findings.is_steady());
  const RateRange out = at_30.range("out bearing.rotation");
  EXPECT_NEAR(out.lowest, std::cos(M_PI / 6), 1e-4);
  EXPECT_NEAR(out.highest, 1 / std::cos(M_PI / 6), 1e-4);
  EXPECT_NE(why_not_steady(at_30.scene.system, at_30.scene.context.state, {1.}, at_30.motion.findings)
              .find("<out bearing.rotation>"),
            std::string::npos);
}



TEST(SteadyMechanisms, GearedTailShaft)
{
  const auto tail = [](const double second) {
    Mechanism m = articulated().body("tail", {-1, 0, 1}).revolute("tail", "ground", "tail", {-1, 0, 1}, {0, 1, 0});
    m.gear("gear", "shaft", "tail", 5).body("tail blade", {-1, 0, 1.1});
    m.revolute("tail flap", "tail", "tail blade", {-1, 0, 1.1}, {1, 0, 0});
    return second == 0 ? m : m.drive("tail", second);
  };
  for (const double second : {0., 5.})
    {
      const Moving m(tail(second));
      expect_spin(m, "tail", {0, 5, 0});
      expect_spin(m, "tail blade", {0, 5, 0});
      expect_spin(m, "blade", {0, 0, 1});
      EXPECT_TRUE(m.motion.findings.is_steady());
    }
  try
    {
      const Moving m(tail(4.));
      FAIL() << "4 and 5 at once";
    }
  catch (const InputError &problem)
    {
      const std::string text = problem.what();
      for (const std::string name : {"gear gear", "drive of shaft", "drive of tail"})
        EXPECT_NE(text.find(name), std::string::npos) << text;
    }
}



TEST(SteadyMechanisms, PlanetaryGear)
{
  // sun of radius 1, planets of 0.5, ring of 2 that is fixed
  Mechanism m = Mechanism().body("sun", {0, 0, 0}).body("carrier", {0, 0, 0});
  m.revolute("sun", "ground", "sun", {0, 0, 0}).revolute("carrier", "ground", "carrier", {0, 0, 0});
  m.revolute("sun in carrier", "carrier", "sun", {0, 0, 0}).drive("sun", 1);
  for (unsigned int k = 0; k < 3; ++k)
    {
      const std::string n = "planet " + std::to_string(k);
      const Point3      x = {1.5 * std::cos(2 * M_PI * k / 3), 1.5 * std::sin(2 * M_PI * k / 3), 0};
      m.body(n, x).revolute(n, "carrier", n, x);
      m.gear("inner " + n, "sun in carrier", n, -2).gear("outer " + n, "carrier", n, -4);
    }
  const Moving moving(m);
  expect_spin(moving, "carrier", {0, 0, 1. / 3});
  for (const std::string n : {"planet 0", "planet 1", "planet 2"})
    EXPECT_NEAR(moving.rates.at(n + ".rotation"), -4. / 3, exact);
  // axes of planets move, at constant rates
  EXPECT_EQ(moving.motion.findings.moving.size(), 3u);
  const RateRange planet = moving.range("planet 0.rotation");
  EXPECT_NEAR(planet.lowest, -4. / 3, 1e-9);
  EXPECT_NEAR(planet.highest, -4. / 3, 1e-9);
}



TEST(SteadyMechanisms, FourBarIsNotSteady)
{
  Mechanism m = Mechanism().body("crank", {0, 0, 0}).body("rod", {0, .3, 0}).body("rocker", {1, .8, 0});
  m.revolute("a", "ground", "crank", {0, 0, 0}).revolute("b", "crank", "rod", {0, .3, 0});
  m.revolute("c", "rod", "rocker", {1, .8, 0}).revolute("d", "ground", "rocker", {1, 0, 0}).drive("a", 1);
  const Moving moving(m);
  EXPECT_FALSE(moving.motion.findings.is_steady());
  const RateRange b = moving.range("b.rotation");
  EXPECT_NEAR(b.lowest, -1.429, 5e-3);
  EXPECT_NEAR(b.highest, -.728, 2e-3);
}



TEST(SteadyMechanisms, CounterRotatingPair)
{
  for (const bool is_free : {false, true})
    {
      Mechanism m = Mechanism().body("fuselage", {0, 0, -1});
      if (!is_free)
        m.elastic("mount", "ground", "fuselage", {0, 0, -1});
      for (const auto &[n, z, speed] :
           {std::make_tuple(std::string("upper"), 1., 1.), std::make_tuple(std::string("lower"), .5, -1.)})
        {
          m.body(n, {0, 0, z}).revolute(n, "fuselage", n, {0, 0, z}).drive(n, speed);
          m.body(n + " blade", {.2, 0, z}).revolute(n + " flap", n, n + " blade", {.2, 0, z}, {0, 1, 0});
        }
      const Moving moving(m);
      expect_spin(moving, "fuselage", {0, 0, 0});
      for (const std::string n : {"upper", "upper blade"})
        expect_spin(moving, n, {0, 0, 1});
      for (const std::string n : {"lower", "lower blade"})
        expect_spin(moving, n, {0, 0, -1});
      EXPECT_TRUE(moving.motion.findings.is_steady());
      EXPECT_EQ(moving.motion.findings.n_at_rest, is_free ? 6u : 0u);
    }
}



// A sleeve between two bearings: nothing says which of them turns.
TEST(SteadyMechanisms, SleeveIsShared)
{
  Mechanism m = Mechanism().body("sleeve", {0, 0, 0}).body("hub", {0, 0, 0});
  m.revolute("outer", "ground", "sleeve", {0, 0, 0}).revolute("inner", "sleeve", "hub", {0, 0, 0});
  m.revolute("drive", "ground", "hub", {0, 0, 1}).drive("drive", 1);
  const Moving moving(m);
  EXPECT_NEAR(moving.rates.at("outer.rotation"), .5, exact);
  EXPECT_NEAR(moving.rates.at("inner.rotation"), .5, exact);
  EXPECT_EQ(moving.motion.findings.shared, (std::vector<std::string>{"outer.rotation", "inner.rotation"}));
}



// More pieces than dense matrices are good for: a rotor of 40 blades, 3 bodies each, on a sprung mount.
TEST(SteadyMechanisms, ManyBlades)
{
  Mechanism m =
    Mechanism().body("mount", {0, 0, .5}).body("hub", {0, 0, 1}).elastic("spring", "ground", "mount", {0, 0, 0});
  m.revolute("shaft", "mount", "hub", {0, 0, 1}).drive("shaft", 1);
  for (unsigned int k = 0; k < 40; ++k)
    {
      const std::string n   = std::to_string(k);
      const double      phi = 2 * M_PI * k / 40, c = std::cos(phi), s = std::sin(phi);
      m.body("lag " + n, {.1 * c, .1 * s, 1}).body("flap " + n, {.2 * c, .2 * s, 1}).body("blade " + n, {c, s, 1});
      m.revolute("lag hinge " + n, "hub", "lag " + n, {.1 * c, .1 * s, 1});
      m.revolute("flap hinge " + n, "lag " + n, "flap " + n, {.2 * c, .2 * s, 1}, {-s, c, 0});
      m.revolute("pitch hinge " + n, "flap " + n, "blade " + n, {.3 * c, .3 * s, 1}, {c, s, 0});
    }
  const Moving moving(m);
  ASSERT_GT(6 * (moving.scene.system.layout.n_nodes - 1), 400u);
  for (const std::string body : {"hub", "lag 0", "flap 13", "blade 29"})
    expect_spin(moving, body, {0, 0, 1}, 1e-8);
  expect_spin(moving, "mount", {0, 0, 0}, 1e-8);
  EXPECT_TRUE(moving.motion.findings.is_steady());
}



// The same rotor a millimetre large, at another place, turned in space, at another speed.
TEST(SteadyMechanisms, UnitsPlacesAndDirections)
{
  for (const double size : {1e-3, 1., 1e3})
    {
      const double s = size;
      Mechanism    m = Mechanism()
                      .body("hub", {7 * s, 0, 3 * s})
                      .body("block", {7 * s, .1 * s, 3 * s})
                      .body("blade", {7 * s, .2 * s, 3 * s});
      m.revolute("shaft", "ground", "hub", {7 * s, 0, 3 * s}, {1, 0, 0}).drive("shaft", 1e3);
      m.revolute("lag", "hub", "block", {7 * s, .1 * s, 3 * s}, {1, 0, 0});
      m.revolute("flap", "block", "blade", {7 * s, .2 * s, 3 * s}, {0, 0, 1});
      const Moving moving(m);
      expect_spin(moving, "blade", {1e3, 0, 0}, 1e-9);
      EXPECT_NEAR(moving.scene.value("blade.velocity z"), 200 * s, 1e-9 * 200 * s);
    }
}
