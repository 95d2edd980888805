// Angles of joints in statics: the angle that is told, that springs feel and gears and screws hand on, is that by which
// the bodies have turned, however large the load steps are. Expected: closed forms, to Newton's tolerance; the angle
// between two bodies from their triads, which know it but for whole turns.

#include <samara/analysis/dynamic.h>
#include <samara/analysis/static.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <random>

using namespace samara;

namespace
{
  constexpr double full_turn = 2 * M_PI;

  /** How far two angles are apart but for whole turns. */
  double
  apart(const double a, const double b)
  {
    return std::abs(std::remainder(a - b, full_turn));
  }

  std::string
  text(const double number)
  {
    std::ostringstream out;
    out.precision(17);
    out << number;
    return out.str();
  }

  std::string
  text(const Vector3 &v)
  {
    return text(v(0)) + ", " + text(v(1)) + ", " + text(v(2));
  }



  /** A body of 1 kg at (1, 0, 0) on a hinge about the axis y at the origin, with a spring, under gravity. */
  struct HingeWithSpring
  {
    double weight, stiffness, rest;

    std::string
    model(const unsigned int load_steps) const
    {
      return "set Analyses = static\nsubsection Bodies\n subsection b\n set Type = rigid body\n set Mass = 1\n set Inertia = .1, .1, .1\n"
             " set Position = 1, 0, 0\n end\nend\nsubsection Joints\n subsection h\n set Type = revolute\n"
             " set Body A = ground\n set Body B = b\n set Position = 0, 0, 0\n set Axis = 0, 1, 0\n"
             " subsection rotation\n set Spring = " +
             text(stiffness) + "\n set Rest = " + text(rest) +
             "\n end\n end\nend\nsubsection Loads\n subsection g\n set Type = gravity\n set Acceleration = 0, 0, " +
             text(-weight) + "\n end\nend\nsubsection Static\n set Load steps = " + std::to_string(load_steps) +
             "\n set Stability limits = " + (load_steps < 10 ? "pass" : "stop") + "\nend\n";
    }

    /** The height of the body is −sin θ. */
    double
    moment(const double angle, const double factor) const
    {
      return stiffness * (angle - rest) - factor * weight * std::cos(angle);
    }

    /** The equilibrium that grows out of the unloaded one; nothing if it comes near a limit point, where load
     * steps must be short.
     */
    std::optional<double>
    followed() const
    {
      double             angle   = rest;
      const unsigned int n_steps = 4000;
      for (unsigned int i = 1; i <= n_steps; ++i)
        {
          const double factor = double(i) / n_steps;
          for (double change = 1; std::abs(change) > 1e-13;)
            {
              const double slope = stiffness + factor * weight * std::sin(angle);
              change             = -moment(angle, factor) / slope;
              if (slope < 0.6 * stiffness || std::abs(change) > 0.2)
                return {};
              angle += change;
            }
        }
      return angle;
    }
  };
} // namespace



// The equation had the root θ + π, too: hinges stood half a turn beside their bodies, or whole ones. Large load steps
// arrive at some equilibrium, short ones at that which grows out of the unloaded one.
TEST(Angles, HingeWithSpringUnderGrowingWeight)
{
  std::mt19937 random(1);
  const auto   number = [&](const double a, const double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  unsigned int n_followed = 0;
  for (unsigned int i = 0; i < 500; ++i)
    {
      const HingeWithSpring hinge{(i % 2 == 0 ? 1 : -1) * std::pow(10, number(0, 3)),
                                  std::pow(10, number(-1, 3)),
                                  number(-3, 3)};
      const auto            followed = hinge.followed();
      for (const unsigned int load_steps : {4, 4000})
        {
          if (load_steps == 4000 && !followed)
            continue;
          Scene         scene(hinge.model(load_steps));
          const State  &state = scene.equilibrium();
          const Matrix3 D     = state.triad(1);
          const double  told  = scene.value("h.rotation") * M_PI / 180;
          EXPECT_LT(apart(told, std::atan2(-D(2, 0), D(0, 0))), 1e-8) << "case " << i;
          EXPECT_LT(std::abs(hinge.moment(told, 1)), 1e-7 * (std::abs(hinge.weight) + hinge.stiffness)) << "case " << i;
          if (load_steps == 4000)
            {
              ++n_followed;
              EXPECT_NEAR(told, *followed, 1e-7)
                << "weight " << hinge.weight << ", stiffness " << hinge.stiffness << ", rest " << hinge.rest;
            }
        }
    }
  EXPECT_GT(n_followed, 300u);
}



// A spring away from its rest turns the body at once, whatever the load; the load then turns it back. The load step is not
// halved until it is nothing.
TEST(Angles, SpringThatGoesToItsRestAtOnce)
{
  for (const double weight : {10., -10.})
    {
      const HingeWithSpring hinge{weight, 50, weight > 0 ? -0.95 : 0.95};
      Scene                 scene(hinge.model(1));
      scene.equilibrium();
      EXPECT_LE(scene.analysis<StaticAnalysis>().n_steps, 2u);
      EXPECT_NEAR(scene.value("h.rotation") * M_PI / 180, *hinge.followed(), 1e-7);
    }
}


namespace
{
  /** Random axes and numbers, the same in each run. */
  class Random
  {
  public:
    double
    operator()(const double a, const double b)
    {
      return std::uniform_real_distribution<double>(a, b)(engine);
    }

    Vector3
    axis()
    {
      Vector3 v;
      do
        v = Vector3((*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1));
      while (v.norm() < 0.1 || v.norm() > 1);
      return v.normalized();
    }

  private:
    std::mt19937 engine{2};
  };

  Matrix3
  rotation(const double angle, const Vector3 &axis)
  {
    return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  }

  std::string
  body(const std::string &name, const Vector3 &x)
  {
    return " subsection " + name +
           "\n set Type = rigid body\n set Mass = 1\n set Inertia = .1, .2, .3\n set Position = " + text(x) +
           "\n end\n";
  }

  std::string
  unclosed_joint(const std::string &name,
                 const std::string &kind,
                 const std::string &a,
                 const std::string &b,
                 const Vector3     &at)
  {
    return " subsection " + name + "\n set Type = " + kind + "\n set Body A = " + a + "\n set Body B = " + b +
           "\n set Position = " + text(at) + "\n";
  }

  std::string
  spring(const std::string &motion, const double stiffness, const double rest, const double moment)
  {
    return " subsection " + motion + "\n set Spring = " + text(stiffness) + "\n set Rest = " + text(rest) +
           "\n set Moment = " + text(moment) + "\n end\n";
  }
} // namespace



// k (θ − θ₀) = M wherever the axes point: one solution, as many turns away as one likes.
TEST(Angles, ChainsOfHingesAndUniversalJoints)
{
  Random number;
  for (unsigned int i = 0; i < 100; ++i)
    {
      double k[4], rest[4], M[4], expected[4];
      for (unsigned int j = 0; j < 4; ++j)
        {
          k[j]        = std::pow(10, number(-1, 3));
          rest[j]     = number(-3, 3);
          expected[j] = rest[j] + number(-15, 15);
          M[j]        = k[j] * (expected[j] - rest[j]);
        }
      const Vector3 a = number.axis(), b = number.axis(), first = number.axis(),
                    second = first.cross(number.axis()).normalized(), at_a(0, 0, 0), at_u(1, 0, 0), at_b(1, 1, 0);
      Scene scene(
        "set Analyses = static\nsubsection Bodies\n" + body("1", {0.5, 0, 0}) + body("2", {1, 0.5, 0}) +
        body("3", {1, 1, 0.5}) + "end\nsubsection Joints\n" + unclosed_joint("a", "revolute", "ground", "1", at_a) +
        " set Axis = " + text(a) + "\n" + spring("rotation", k[0], rest[0], M[0]) + " end\n" +
        unclosed_joint("u", "universal", "1", "2", at_u) + " set Axis = " + text(first) +
        "\n set Second axis = " + text(second) + "\n" + spring("rotation 1", k[1], rest[1], M[1]) +
        spring("rotation 2", k[2], rest[2], M[2]) + " end\n" + unclosed_joint("b", "revolute", "2", "3", at_b) +
        " set Axis = " + text(b) + "\n" + spring("rotation", k[3], rest[3], M[3]) +
        " end\nend\nsubsection Static\n set Load steps = " + std::to_string(1 + i % 4) + "\nend\n");
      const State &state = scene.equilibrium();
      unsigned int j     = 0;
      for (const std::string path : {"a.rotation", "u.rotation 1", "u.rotation 2", "b.rotation"})
        EXPECT_NEAR(scene.value(path) * M_PI / 180, expected[j++], 1e-7) << "case " << i << ", " << path;
      Matrix3 D = rotation(expected[0], a);
      EXPECT_LT((state.triad(1) - D).norm(), 1e-7) << "case " << i;
      D = D * rotation(expected[1], first) * rotation(expected[2], second);
      EXPECT_LT((state.triad(2) - D).norm(), 1e-7) << "case " << i;
      D = D * rotation(expected[3], b);
      EXPECT_LT((state.triad(3) - D).norm(), 1e-7) << "case " << i;
    }
}



// A weight G on a screw with a spring: k (θ − θ₀) + G p = 0 and d = p θ.
TEST(Angles, WeightOnAScrew)
{
  Random number;
  for (unsigned int i = 0; i < 100; ++i)
    {
      const double k = std::pow(10, number(-1, 3)), rest = number(-3, 3), p = number(-0.2, 0.2),
                   angle = number(-25, 25), weight = -k * (angle - rest) / p;
      const Vector3 axis = number.axis();
      Scene scene("set Analyses = static\nsubsection Bodies\n" + body("b", {0.5, 0, 0}) + "end\nsubsection Joints\n" +
                  unclosed_joint("s", "screw", "ground", "b", {0, 0, 0}) + " set Axis = " + text(axis) +
                  "\n set Pitch = " + text(p) + "\n" + spring("rotation", k, rest, 0) +
                  " end\nend\nsubsection Loads\n subsection g\n set Type = gravity\n set Acceleration = " +
                  text(Vector3(-weight * axis)) + "\n end\nend\n");
      // the weight acts along the axis: it has no moment about it
      const State &state = scene.equilibrium();
      EXPECT_NEAR(scene.value("s.rotation") * M_PI / 180, angle, 1e-7) << "case " << i;
      EXPECT_NEAR(scene.value("s.displacement"), p * angle, 1e-7) << "case " << i;
      EXPECT_LT((state.triad(1) - rotation(angle, axis)).norm(), 1e-7) << "case " << i;
    }
}



// A moment M on the second wheel of a gear of ratio n, a spring on the first: k (θ − θ₀) = n M, and n θ at the second.
TEST(Angles, Gears)
{
  Random number;
  for (unsigned int i = 0; i < 100; ++i)
    {
      const double k = std::pow(10, number(-1, 3)), rest = number(-3, 3), n = number(-4, 4), angle = number(-10, 10),
                   M  = k * (angle - rest) / n;
      const Vector3 a = number.axis(), b = number.axis();
      Scene scene("set Analyses = static\nsubsection Bodies\n" + body("1", {0.5, 0, 0}) + body("2", {1, 0.5, 0}) +
                  "end\nsubsection Joints\n" + unclosed_joint("a", "revolute", "ground", "1", {0, 0, 0}) +
                  " set Axis = " + text(a) + "\n" + spring("rotation", k, rest, 0) + " end\n" +
                  unclosed_joint("b", "revolute", "ground", "2", {1, 0, 0}) + " set Axis = " + text(b) +
                  "\n subsection rotation\n set Moment = " + text(M) +
                  "\n end\n end\n subsection g\n set Type = gear\n set Joint A = a\n set Joint B = b\n set Ratio = " +
                  text(n) + "\n end\nend\n");
      const State &state = scene.equilibrium();
      EXPECT_NEAR(scene.value("a.rotation") * M_PI / 180, angle, 1e-7) << "case " << i;
      EXPECT_NEAR(scene.value("b.rotation") * M_PI / 180, n * angle, 1e-7) << "case " << i;
      EXPECT_LT((state.triad(1) - rotation(angle, a)).norm(), 1e-7) << "case " << i;
      EXPECT_LT((state.triad(2) - rotation(n * angle, b)).norm(), 1e-7) << "case " << i;
    }
}



// Turns that are prescribed, and a spring beyond them that must not feel them.
TEST(Angles, SeveralTurnsPrescribed)
{
  for (const double turns : {0.5, -1., 3.25, -7.5})
    {
      Scene scene("set Analyses = static\nsubsection Bodies\n" + body("1", {0.5, 0, 0}) + body("2", {1, 0.5, 0}) +
                  "end\nsubsection Joints\n" + unclosed_joint("a", "revolute", "ground", "1", {0, 0, 0}) +
                  " set Axis = 0, 0, 1\n subsection rotation\n set Prescribed = " + text(turns * full_turn) +
                  "\n end\n end\n" + unclosed_joint("b", "revolute", "1", "2", {1, 0, 0}) + " set Axis = 0, 0, 1\n" +
                  spring("rotation", 2, 0.3, 5) + " end\nend\n");
      const State &state = scene.equilibrium();
      EXPECT_NEAR(scene.value("a.rotation"), 360 * turns, 1e-6);
      EXPECT_NEAR(scene.value("b.rotation") * M_PI / 180, 2.8, 1e-8);
      EXPECT_LT((state.triad(2) - rotation(turns * full_turn + 2.8, Vector3::UnitZ())).norm(), 1e-8);
    }
}



// A torsion pendulum that swings by six turns to either side, up to 1.2 rad a step: θ = ω₀/ν sin ν t, ν² = k/J.
TEST(Angles, TurnsAreCountedInMotion)
{
  const double J = 0.3, nu = 2, amplitude = 6 * full_turn, end = 7;
  for (const int s : {1, 2, 3})
    {
      Scene  scene("set Analyses = dynamic\nsubsection Bodies\n subsection b\n set Type = rigid body\n set Mass = 1\n"
                   " set Inertia = 0.3, 0.3, 0.3\n set Angular velocity = 0, 0, " +
                  text(amplitude * nu) + "\n end\nend\nsubsection Joints\n" +
                  unclosed_joint("h", "revolute", "ground", "b", {0, 0, 0}) + spring("rotation", J * nu * nu, 0, 0) +
                  " end\nend\nsubsection Dynamic\n set End time = " + text(end) +
                  "\n set Stages = " + std::to_string(s) + "\n set Spectral radius = 1\n set Step = " +
                  (s == 1 ? "0.0005" :
                    s == 2 ? "0.008" :
                             "0.016") +
                  "\nend\n");
      auto  &dynamics = scene.analysis<DynamicAnalysis>();
      double largest = 0, error = 0, phase = 0;
      dynamics.observer = [&](const State &state) {
        const double angle = scene.input.model.probe("h.rotation").value(state) * M_PI / 180;
        const auto   D     = state.triad(1);
        largest            = std::max(largest, angle);
        error              = std::max(error, std::abs(angle - amplitude * std::sin(nu * state.time)));
        phase              = std::max(phase, apart(angle, std::atan2(D(1, 0), D(0, 0))));
      };
      dynamics.start(scene.context);
      dynamics.run(scene.context);
      EXPECT_GT(largest, 0.99 * amplitude);
      EXPECT_LT(phase, 1e-9) << s << " stages";
      EXPECT_LT(error, 0.1) << s << " stages";
    }
}



// Nothing but a probe uses the angle of a wheel that spins freely: it counts turns all the same, and has a rate.
TEST(Angles, ProbedAnglesCountTurns)
{
  Scene scene("set Analyses = dynamic\nsubsection Bodies\n subsection b\n set Type = rigid body\n set Mass = 1\n"
              " set Inertia = 0.3, 0.3, 0.3\n set Angular velocity = 0, 0, 20\n end\nend\nsubsection Joints\n" +
              unclosed_joint("h", "revolute", "ground", "b", {0, 0, 0}) +
              " end\nend\nsubsection Dynamic\n set End time = 1\n set Step = 0.05\n set Spectral radius = 1\nend\n"
              "subsection Output\n set Probes = h.rotation, h.rotation rate\nend\n");
  auto &dynamics = scene.analysis<DynamicAnalysis>();
  dynamics.start(scene.context);
  dynamics.run(scene.context);
  EXPECT_NEAR(scene.value("h.rotation"), 20 * 180 / M_PI, 0.2);
  EXPECT_NEAR(scene.value("h.rotation rate"), 20., 1e-9);
}
