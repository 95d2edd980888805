// What presses where joints rub: threads, guides that are pressed at their ends, balls of constant velocity joints.
// References: wedges and levers of textbooks.

#include <gtest/gtest.h>

#include <array>

#include "rubbing.h"

using namespace samara;
using namespace samara::systems;

namespace
{
  constexpr double thread_radius = 0.01, thread_inertia = 1e-4; ///< of a nut of 1 kg

  /** A nut of 1 kg on a thread along z with tan λ = 0.2, under its weight. */
  std::string
  nut_on_thread(const double       mu,
                const double       flank,
                const double       epsilon,
                const std::string &more  = "",
                const int          sense = 1)
  {
    const std::string J = number_of(thread_inertia);
    return model(rigid_body("nut",
                            "set Mass = 1\n set Inertia = " + J + ", " + J + ", " + J + "\n" +
                              (more.empty() ? "" : moving("0, 0, 1e-3", "0, 0, " + number_of(sense * 0.5)))),
                 joint("j",
                       "screw",
                       "set Body A = ground\n set Body B = nut.centre\n set Axis = 0, 0, 1\n set Pitch = " +
                         number_of(sense * 0.2 * thread_radius) + "\n" +
                         motion("thread",
                                " set Friction = " + number_of(mu) +
                                  "\n set Radius = 0.01\n set Flank angle = " + number_of(flank) + "\n" +
                                  (epsilon > 0 ? " set Sticking speed = " + number_of(epsilon) + "\n" :
                                                 " set Bristle stiffness = 1e7\n")) +
                         more),
                 gravity);
  }

  /** μ/cos β_n, by which the force along the axis of a thread with that lead presses. */
  double
  coefficient_on_flank(const double mu, const double flank, const double lead)
  {
    return mu * std::sqrt(1 + std::pow(std::tan(flank) * std::cos(lead), 2));
  }

  double
  multiplier_named(const System &system, const State &state, const std::string &name)
  {
    for (unsigned int i = 0; i < state.multipliers.size(); ++i)
      if (system.layout.name_of_multiplier(i) == name)
        return state.multipliers[i];
    ADD_FAILURE() << name;
    return 0;
  }

  /** A bracket of 1 kg on a guide along x, 0.1 m long, with hooks beside its axis. */
  std::string
  bracket(const std::string &loads, const std::string &friction = " set Friction = 0.2\n set Sticking speed = 1e-6\n")
  {
    return model(rigid_body("a",
                            "set Mass = 1\n set Inertia = 1, 1, 1\n set Frames = hook at 0 0.2 0, far at 0 0.3 0\n"),
                 joint("guide",
                       "prismatic",
                       "set Body A = ground\n set Body B = a.centre\n set Axis = 1, 0, 0\n set Bearing length = 0.1\n" +
                         motion("displacement", friction)),
                 loads);
  }

  std::string
  load_at(const std::string &name,
          const std::string &at,
          const std::string &force,
          const std::string &moment = "0, 0, 0")
  {
    return " subsection " + name + "\n set Type = point load\n set At = " + at + "\n set Force = " + force +
           "\n set Moment = " + moment + "\n end\n";
  }
} // namespace



// A weight W on a thread: where tan λ > μ/cos β_n it turns down, as a block on the slope λ whose motion along the
// helix has the nut's inertia, too; else it creeps like one that sticks.
TEST(Pressing, ThreadLocksItself)
{
  const double tan_lead = 0.2, lead = std::atan(tan_lead), s = std::sin(lead), c = std::cos(lead), epsilon = 1e-6,
               T = 0.1;
  struct Case
  {
    double mu, flank;
  };
  for (const auto &[mu, flank] : {Case{0.1, 0.}, {0.19, 0.}, {0.19, 0.2}, {0.21, 0.}, {0.19, 0.5}})
    {
      SCOPED_TRACE("mu = " + number_of(mu) + ", flank " + number_of(flank));
      const double on_flank = coefficient_on_flank(mu, flank, lead);
      const Scene  scene(nut_on_thread(mu, flank, epsilon));
      for (const unsigned int stages : {1, 2, 3})
        {
          const auto m =
            contact_motion(scene.system, Tableau(stages, stages == 1 && on_flank < tan_lead ? 1. : 0.5), 2e-3, T);
          EXPECT_LT(m.drift * m.largest, 1e-13);
          EXPECT_GE(m.least_loss, 0);
          if (on_flank < tan_lead)
            {
              // along the helix and across it: m d̈ and J θ̈ by N and μ N
              const double ratio = thread_radius * thread_radius / thread_inertia,
                           N     = g_n / (c + on_flank * s + ratio * s * (tan_lead - on_flank)),
                           a     = -N / c * ratio * (tan_lead - on_flank) * c;
              EXPECT_NEAR(m.state.rates[0] / (a * s * T), 1, 2e-3) << stages;
              EXPECT_NEAR(m.friction_loss / (on_flank * N * a * -0.5 * T * T), 1, 5e-3) << stages;
            }
          else
            {
              const double creep = epsilon * tan_lead / std::sqrt(on_flank * on_flank - tan_lead * tan_lead);
              EXPECT_NEAR(m.state.rates[2] / -creep, 1, 1e-6) << stages;
              EXPECT_NEAR(m.state.rates[0], s * m.state.rates[2], 1e-15);
            }
        }
    }
}



// Torques that lift and lower a weight evenly: W r tan(φ ± λ); a left-handed thread turns the other way.
TEST(Pressing, TorqueOnAThread)
{
  const double mu = 0.15, flank = 0.26, lead = std::atan(0.2), phi = std::atan(coefficient_on_flank(mu, flank, lead));
  for (const int sense : {1, -1})
    for (const bool lifts : {true, false})
      for (const double epsilon : {1e-7, 0.})
        {
          const double rate = (lifts ? 1 : -1) * sense * 0.5;
          std::string  text = nut_on_thread(
            mu, flank, epsilon, motion("rotation", " set Prescribed = " + number_of(rate) + "*t\n"), sense);
          if (!lifts)
            {
              const std::string up = moving("0, 0, 1e-3", "0, 0, " + number_of(sense * 0.5));
              text.replace(text.find(up), up.size(), moving("0, 0, -1e-3", "0, 0, " + number_of(rate)));
            }
          const Scene  scene(text);
          const auto   m      = contact_motion(scene.system, Tableau(2, 0.5), 5e-3, 0.05);
          const double torque = multiplier_named(scene.system, m.state, "joint j, prescribed rotation");
          // a torque against the motion is a positive multiplier
          EXPECT_NEAR(torque / (-sense * g_n * thread_radius * (lifts ? std::tan(phi + lead) : -std::tan(phi - lead))),
                      1,
                      epsilon > 0 ? 1e-6 : 1e-4)
            << sense << lifts << epsilon;
          EXPECT_GE(m.least_loss, 0);
        }
}



// A bracket that is pulled beside its guide: the moment is held by forces at the ends of the guide, N = 2 P a/L. With
// 2 μ a/L > 1 it jams however strong the pull is.
TEST(Pressing, GuidePulledBesideItsAxis)
{
  const double L = 0.1, mu = 0.2, T = 0.2;
  for (const unsigned int s : {1, 2, 3})
    {
      const Scene slides(bracket(load_at("pull", "a.hook", "1, 0, 0"))),
        jams(bracket(load_at("pull", "a.far", "1, 0, 0")));
      const auto   m = contact_motion(slides.system, Tableau(s, s == 1 ? 1. : 0.5), 0.01, T);
      const double a = 1 - mu * 2 * 0.2 / L;
      EXPECT_NEAR(m.state.coordinates[0] / (0.5 * a * T * T), 1, 1e-4) << s;
      EXPECT_NEAR(m.friction_loss / ((1 - a) * 0.5 * a * T * T), 1, 1e-4) << s;
      // the work of the pull of 1 N
      EXPECT_NEAR(m.state.coordinates[0] - m.friction_loss - m.dissipated - 0.5 * std::pow(m.state.rates[0], 2),
                  0,
                  1e-12);
      EXPECT_GE(m.least_loss, 0);
      const auto stuck = contact_motion(jams.system, Tableau(s, 0.5), 0.01, T);
      EXPECT_NEAR(stuck.state.rates[0] / (1e-6 / std::sqrt(1.2 * 1.2 - 1)), 1, 1e-4) << s; // w/√(w² + ε²) = 1/1.2
    }
}



// A force across the guide and a moment: of both ends |F/2 ± M × E/L|, in one plane the larger one of F and 2 M/L,
// across each other 2 √((F/2)² + (M/L)²). A hinge pin and a sleeve on a stiff beam are guides, too.
TEST(Pressing, ForceAndMoment)
{
  const double L = 0.1, mu = 0.2, T = 0.1, M = 0.2;
  const auto   slowed = [&](const std::string &across) {
    const Scene scene(bracket(load_at("pull", "a.hook", "1, 0, 0") + load_at("across", "a.centre", across) +
                              load_at("along", "a.centre", "5, 0, 0")));
    const auto  m = contact_motion(scene.system, Tableau(2, 0.5), 0.01, T);
    return (6 - m.state.coordinates[0] / (0.5 * T * T)) / mu;
  };
  EXPECT_NEAR(slowed("0, 3, 0"), 2 * M / L, 1e-3);
  EXPECT_NEAR(slowed("0, -6, 0"), 6, 1e-3);
  EXPECT_NEAR(slowed("0, 0, 6"), 2 * std::hypot(3, M / L), 1e-3);

  const Scene pin(
    model(rigid_body("a", "set Mass = 1\n set Inertia = 1, 1, 1\n" + moving("0, 0, 0", "0, 0, 2")),
          joint("hinge",
                "revolute",
                "set Body A = ground\n set Body B = a.centre\n set Axis = 0, 0, 1\n set Bearing length = 0.1\n" +
                  motion("rotation", " set Friction = 0.2\n set Friction radius = 0.02\n set Sticking speed = 1e-7\n")),
          load_at("tilt", "a.centre", "0, 0, 0", "3, 4, 0")));
  const auto turned = contact_motion(pin.system, Tableau(2, 0.5), 0.01, T);
  EXPECT_NEAR((2 - turned.state.rates[0]) / T, mu * 0.02 * 2 * 5 / L, 1e-5);

  const Scene sleeve(
    "subsection Sections\n subsection s\n set Type = engineering constants\n set EA = 1e9\n set GA2 = 1e9\n set GA3 = 1e9\n"
    " set GJ = 1e8\n set EI2 = 1e8\n set EI3 = 1e8\n set Mass = 1\n set I2 = 0.1\n set I3 = 0.1\n end\nend\n" +
    model(
      "  subsection rail\n set Type = beam\n set Section = s\n set Points = 0, 0, 0; 1, 0, 0\n set Elements = 1\n end\n" +
        rigid_body(
          "a", "set Mass = 1\n set Inertia = 1, 1, 1\n set Position = 0.3, 0, 0\n set Frames = hook at 0.3 0.2 0\n"),
      joint("clamp", "rigid", "set Body A = ground\n set Body B = rail.start\n") +
        joint("j",
              "sliding prismatic",
              "set Body A = rail\n set Body B = a.centre\n set Bearing length = 0.1\n" +
                motion("displacement", " set Friction = 0.2\n set Sticking speed = 1e-6\n")),
      load_at("pull", "a.hook", "1, 0, 0") + load_at("across", "a.centre", "5, 0, 6")));
  const auto slid = contact_motion(sleeve.system, Tableau(3, 0.5), 0.02, T, nullptr, 1e-10);
  EXPECT_NEAR((6 - slid.state.coordinates[0] / (0.5 * T * T)) / mu, 2 * std::hypot(3, M / L), 1e-2);
}



// Two shafts at a bend β, driven and braked evenly. Balls on the radius r are pressed by the force F at the centre and
// by M/(r cos β/2) of the moment M that the joint transmits along the line that halves the angle; they rub against the
// relative angular velocity, 2 Ω sin β/2, which is normal to that line.
TEST(Pressing, BallsOfAConstantVelocityJoint)
{
  const double      bend = 0.6, mu = 0.2, r = 0.05, d = 0.8, brake = 3, speed = 5;
  const double      s = std::sin(bend / 2), c = std::cos(bend / 2);
  const std::string second = number_of(std::sin(bend)) + ", 0, " + number_of(std::cos(bend));
  const auto        along  = [&](const double size) {
    return number_of(size * std::sin(bend)) + ", 0, " + number_of(size * std::cos(bend));
  };
  const std::string round = "set Mass = 1\n set Inertia = 0.1, 0.1, 0.1\n";
  const Scene       scene(model(
    rigid_body("A", round + moving("0, 0, 0", "0, 0, " + number_of(speed))) +
      rigid_body("B",
                 round + " set Frames = far at " + number_of(d * std::sin(bend)) + " 0 " +
                   number_of(d * std::cos(bend)) + "\n" + moving("0, 0, 0", along(speed))),
    joint("drive",
          "revolute",
          "set Body A = ground\n set Body B = A.centre\n set Axis = 0, 0, 1\n" +
            motion("rotation", " set Prescribed = " + number_of(speed) + "*t\n")) +
      joint("j",
            "constant velocity",
            "set Body A = A.centre\n set Body B = B.centre\n set Axis = 0, 0, 1\n set Second axis = " + second + "\n" +
              motion("rotation", " set Friction = 0.2\n set Friction radius = 0.05\n set Sticking speed = 1e-7\n")) +
      joint("bearing", "in line", "set Body A = ground\n set Body B = B.far\n set Axis = " + second + "\n"),
    load_at("brake", "B.centre", "0, 0, 0", along(-brake))));
  // M c − m s = brake, m = μ (r F + M/c), F = (M s + m c)/d of the bearing that holds the bending moment
  Eigen::Matrix2d A;
  A << c, -s, -mu * (r * s / d + 1 / c), 1 - mu * r * c / d;
  const Eigen::Vector2d moments = A.inverse() * Eigen::Vector2d(brake, 0);
  const double          driven = moments(0) * c + moments(1) * s, T = 0.05;
  for (const unsigned int stages : {2, 3})
    {
      const auto m = contact_motion(scene.system, Tableau(stages, 0.5), 0.01, T);
      EXPECT_NEAR(-multiplier_named(scene.system, m.state, "joint drive, prescribed rotation") / driven, 1, 1e-4)
        << stages;
      EXPECT_NEAR(m.friction_loss / (moments(1) * 2 * speed * s * T), 1, 1e-4) << stages;
      EXPECT_NEAR(m.work_of_drives - m.friction_loss - m.dissipated, brake * speed * T, 1e-6) << stages;
      EXPECT_GE(m.least_loss, 0) << stages;
    }
}



// A bead without weight round a hoop, N = m v²/R across it: v = v₀/(1 + μ v₀ t/R); with a preload on a straight wire it
// stops after v₀²/(2 μ N).
TEST(Pressing, BeadOnAWire)
{
  const double R = 0.5, v = 2, mu = 0.3, T = 0.6;
  const auto   wire = [&](const std::string &curve, const std::string &along) {
    return model(rigid_body("bead",
                            "set Mass = 1\n set Inertia = 1, 1, 1\n set Position = 0.5, 0, 0\n" +
                              moving("0, 2, 0", "0, 0, 0")),
                 joint("j",
                       "point on curve",
                       "set Body A = ground\n set Body B = bead\n set Expressions = " + curve + "\n" +
                         motion("displacement", " set Friction = 0.3\n" + along)));
  };
  for (const unsigned int stages : {1, 2, 3})
    {
      const Scene  hoop(wire("0.5*cos(2*pi*s), 0.5*sin(2*pi*s), 0", " set Sticking speed = 1e-6\n"));
      const auto   m     = contact_motion(hoop.system, Tableau(stages, 1.), 0.01, T);
      const double bound = stages == 1 ? 1e-3 : 4e-5;
      EXPECT_NEAR(m.state.coordinates[0], R * std::log(1 + mu * v * T / R) / mu, bound) << stages;
      EXPECT_NEAR(m.friction_loss / (2 - 2 / std::pow(1 + mu * v * T / R, 2)), 1, bound) << stages;
      EXPECT_LT(m.drift, 1e-12) << stages;
      EXPECT_GE(m.least_loss, 0) << stages;
    }
  for (const std::string sticking : {" set Sticking speed = 1e-6\n", " set Bristle stiffness = 1e6\n"})
    {
      const Scene straight(wire("0.5, 4*s - 1, 0", sticking + " set Friction preload = 10\n"));
      const auto  m = contact_motion(straight.system, Tableau(2, 0.5), 5e-3, 1.);
      EXPECT_NEAR(m.state.coordinates[0], v * v / (2 * mu * 10), 2e-3) << sticking;
      EXPECT_LT(std::abs(m.state.rates[0]), 1e-5) << sticking;
    }
}



namespace
{
  /** A body of 1 kg that slides along a rigid beam, with J = m r² about the axis of the beam for r = 0.1 m. */
  std::string
  on_rigid_beam(const std::string &kind,
                const std::string &points,
                const std::string &body,
                const std::string &entries,
                const std::string &more  = "",
                const std::string &loads = "")
  {
    return "subsection Sections\n subsection s\n set Type = tube\n set E = 2e11\n set Density = 7800\n"
           " set Outer radius = 0.01\n end\nend\n" +
           model("  subsection rail\n set Type = beam\n set Section = s\n set Rigid = true\n set Elements = 4\n"
                 " set Axis 2 = 0.3, 0.5, 1\n" +
                   points + " end\n" + rigid_body("a", "set Mass = 1\n" + body),
                 joint("clamp", "rigid", "set Body A = ground\n set Body B = rail.start\n") +
                   joint("j", kind, "set Body A = rail\n set Body B = a.centre\n" + entries) + more,
                 loads);
  }
} // namespace



// A sleeve that slides and turns, pressed by N alone, with J = m r²: friction acts against the slip of both, w = (v, r
// ω), which is slowed by μ N/m in its own direction.
TEST(Pressing, SleeveThatTurns)
{
  const double mu = 0.2, N = 5, T = 0.5, slip = std::hypot(0.6, 0.8), part = 1 - mu * N * T / slip;
  for (const std::string sticking : {" set Sticking speed = 1e-7\n", " set Bristle stiffness = 1e7\n"})
    {
      const Scene scene(on_rigid_beam(
        "sliding sleeve",
        " set Points = 0, 0, 0; 2, 0, 0\n",
        "set Inertia = 0.01, 1, 1\n set Position = 0.3, 0, 0\n" + moving("0.6, 0, 0", "8, 0, 0"),
        motion("displacement",
               " set Friction = 0.2\n set Friction preload = 5\n set Friction radius = 0.1\n" + sticking)));
      for (const unsigned int stages : {2, 3})
        {
          const auto m = contact_motion(scene.system, Tableau(stages, 0.5), 0.01, T);
          EXPECT_NEAR(m.state.rates[0] / (0.6 * part), 1, 1e-4) << stages << sticking;
          EXPECT_NEAR(m.state.rates[1] / (0.8 * part), 1, 1e-4) << stages << sticking;
          EXPECT_NEAR(m.friction_loss / (0.5 * (1 - part * part)), 1, 1e-3) << stages << sticking;
          EXPECT_GE(m.least_loss, -1e-12) << stages << sticking;
        }
    }
}



// What turns on a point of a beam is slowed by μ N r/J. On an arc it turns against the sections by sliding alone:
// driven along with v, and so heavy that it does not turn, it loses μ N r v/R of power.
TEST(Pressing, PointThatTurns)
{
  const std::string rubs = motion("rotation",
                                  " set Friction = 0.2\n set Friction radius = 0.03\n set Friction preload = 5\n"
                                  " set Sticking speed = 1e-7\n");
  const Scene       spins(
    on_rigid_beam("sliding point",
                  " set Points = 0, 0, 0; 2, 0, 0\n",
                  "set Inertia = 0.02, 0.02, 0.02\n set Position = 0.3, 0, 0\n" + moving("0.5, 0, 0", "2, 1, 2"),
                  rubs));
  const auto   m    = contact_motion(spins.system, Tableau(2, 0.5), 0.01, 0.5);
  const double left = 1 - 0.2 * 5 * 0.03 / 0.02 * 0.5 / 3;
  EXPECT_NEAR(Eigen::Map<const Vector3>(&m.state.rates[1]).norm() / (3 * left), 1, 1e-4);
  EXPECT_NEAR(m.state.rates[1] / (2 * left), 1, 1e-4); // about the beam
  EXPECT_NEAR(m.state.rates[0] / 0.5, 1, 1e-4);
  EXPECT_NEAR(m.friction_loss / (0.5 * 0.02 * 9 * (1 - left * left)), 1, 1e-3);

  const double v = 0.5, T = 0.4;
  const Scene  driven(
    on_rigid_beam("sliding point",
                  " set Shape = arc\n set Degree = 4\n"
                   " set Points = 1, 0, 0; 0.70710678118654752, 0.70710678118654752, 0; 0, 1, 0\n",
                  "set Inertia = 1e6, 1e6, 1e6\n set Position = 1, 0, 0\n" + moving("0, 0.5, 0", "0, 0, 0"),
                  rubs + motion("displacement", " set Prescribed = 0.5*t\n")));
  for (const unsigned int stages : {1, 2, 3})
    {
      const auto   run    = contact_motion(driven.system, Tableau(stages, 1.), 0.01, T, nullptr, 1e-10);
      const double normal = 5 + v * v;
      EXPECT_NEAR(run.friction_loss / (0.2 * normal * 0.03 * v * T), 1, 1e-3) << stages;
      EXPECT_GE(run.least_loss, 0) << stages;
    }
}



// The nut of ThreadLocksItself on a beam: the same lead, 500 rad/m, and the same closed forms.
TEST(Pressing, ThreadOfANutOnABeam)
{
  const double tan_lead = 0.2, lead = std::atan(tan_lead), s = std::sin(lead), c = std::cos(lead), epsilon = 1e-6,
               T = 0.1, r = thread_radius, flank = 0.2;
  for (const double mu : {0.1, 0.21})
    for (const int sense : {1, -1})
      {
        const double      on_flank = coefficient_on_flank(mu, flank, lead);
        const std::string J        = number_of(thread_inertia);
        const Scene       scene(on_rigid_beam("sliding screw",
                                        " set Points = 0, 0, -1; 0, 0, 1\n",
                                        "set Inertia = " + J + ", " + J + ", " + J + "\n",
                                        "set Turn per length = " + number_of(sense * 500) + "\n" +
                                          motion("thread",
                                                 " set Friction = " + number_of(mu) +
                                                   "\n set Radius = 0.01\n set Flank angle = " + number_of(flank) +
                                                   "\n set Sticking speed = 1e-6\n"),
                                        "",
                                        gravity));
        for (const unsigned int stages : {2, 3})
          {
            const auto m = contact_motion(scene.system, Tableau(stages, 0.5), 2e-3, T, nullptr, 1e-11);
            EXPECT_GE(m.least_loss, 0) << stages;
            if (on_flank < tan_lead)
              {
                const double ratio = r * r / thread_inertia,
                             N     = g_n / (c + on_flank * s + ratio * s * (tan_lead - on_flank)),
                             a     = -N / c * ratio * (tan_lead - on_flank) * c;
                EXPECT_NEAR(m.state.rates[0] / (a * s * T), 1, 2e-3) << stages << sense;
                EXPECT_NEAR(m.friction_loss / (on_flank * N * a * -0.5 * T * T), 1, 5e-3) << stages << sense;
              }
            else
              EXPECT_NEAR(m.state.rates[1] * std::sqrt(on_flank * on_flank - tan_lead * tan_lead) /
                            (-epsilon * tan_lead),
                          1,
                          1e-5)
                << stages << sense;
          }
      }
}



// Teeth of the efficiency η: where A drives J_A α = T − |n| M/η and J_B |n| α = M − B; where B drives, M (2 − 1/η) |n|
// arrives at A. Below one half B cannot drive.
TEST(Pressing, EfficiencyOfTeeth)
{
  const double J_a = 0.02, J_b = 0.5, ratio = 0.25, T = 0.4;
  const auto   gears =
    [&](const double efficiency, const double torque_a, const double torque_b, const std::string &mesh) {
      const std::string a = number_of(J_a), b = number_of(J_b);
      return Scene(model(
        rigid_body("A", "set Mass = 1\n set Inertia = " + a + ", " + a + ", " + a + "\n") +
          rigid_body("B", "set Mass = 1\n set Position = 1, 0, 0\n set Inertia = " + b + ", " + b + ", " + b + "\n"),
        joint("a", "revolute", "set Body A = ground\n set Body B = A.centre\n") +
          joint("b", "revolute", "set Body A = ground\n set Body B = B.centre\n") +
          joint("g",
                "gear",
                "set Joint A = a\n set Joint B = b\n set Ratio = -0.25\n set Efficiency = " + number_of(efficiency) +
                  "\n set Pitch radius = 0.05\n set Sticking speed = 1e-7\n" + mesh),
        load_at("t", "A.centre", "0, 0, 0", "0, 0, " + number_of(torque_a)) +
          load_at("u", "B.centre", "0, 0, 0", "0, 0, " + number_of(torque_b))));
    };
  for (const double eta : {0.9, 0.6})
    for (const bool a_drives : {true, false})
      {
        const Scene scene = gears(eta, a_drives ? 1 : 0, a_drives ? 1 : 8, "");
        // the moment on B is M = J_B n α ± its load, of the opposite sense
        const double part  = a_drives ? 1 / eta : 2 - 1 / eta,
                     alpha = a_drives ? (1 - ratio * 1 * part) / (J_a + ratio * ratio * J_b * part) :
                                        -ratio * 8 * part / (J_a + ratio * ratio * J_b * part),
                     M     = std::abs(J_b * ratio * alpha + (a_drives ? 1 : 8));
        for (const unsigned int stages : {1, 2, 3})
          {
            const auto m = contact_motion(scene.system, Tableau(stages, stages == 1 ? 1. : 0.5), 0.01, T);
            EXPECT_NEAR(m.state.rates[0] / (alpha * T), 1, stages == 1 ? 5e-3 : 1e-4) << eta << a_drives << stages;
            EXPECT_NEAR(m.friction_loss / ((1 / eta - 1) * ratio * M * std::abs(alpha) * 0.5 * T * T),
                        1,
                        stages == 1 ? 5e-3 : 1e-3)
              << eta << a_drives << stages;
            EXPECT_GE(m.least_loss, 0);
          }
      }
  const Scene locked = gears(0.4, 0, 8, "");
  EXPECT_LT(std::abs(contact_motion(locked.system, Tableau(2, 0.5), 0.01, T).state.rates[0]), 1e-5);
  // with a play the teeth first meet: they rattle, and lose energy
  const Scene rattles = gears(
    0.9, 1, 1, " set Backlash = 0.01\n set Mesh stiffness = 1e4\n set Mesh restitution = 0.5\n set Mesh speed = 1\n");
  const auto   m     = contact_motion(rattles.system, Tableau(3, 0.5), 2e-4, T);
  const double alpha = (1 - ratio / 0.9) / (J_a + ratio * ratio * J_b / 0.9);
  EXPECT_NEAR(m.state.rates[0] / (alpha * T), 1, 0.02);
  EXPECT_GE(m.least_loss, 0);
}



// A pin that rubs is pressed by its own reactions, whatever joints come later: what sticks is a damper μ N r²/ε.
TEST(Pressing, OtherJointsDoNotTouchAPin)
{
  const std::string pin = joint(
                      "pin",
                      "revolute",
                      "set Body A = ground\n set Body B = a.centre\n set Axis = 1, 0, 0\n set Axis 1 = 0, 0, 1\n" +
                        motion("rotation", " set Friction = 0.2\n set Friction radius = 0.05\n")),
                    slider = joint("j",
                                   "point on curve",
                                   "set Body A = ground\n set Body B = bead\n set Expressions = 0, 0, s - 0.5\n"
                                   " subsection displacement\n set Friction = 0.1\n end\n"),
                    both   = joint("j", "constant velocity", "set Body A = ground\n set Body B = bead\n");
  for (const std::string &other : {slider, both})
    {
      const Scene scene(model(rigid_body("a", "set Mass = 2\n set Inertia = 0.1, 0.1, 0.1\n") +
                                rigid_body("bead", "set Mass = 1\n set Inertia = 1, 1, 1\n"),
                              pin + other,
                              gravity));
      State       state = scene.system.reference();
      for (unsigned int i = 0; i < state.multipliers.size(); ++i)
        if (scene.system.layout.name_of_multiplier(i).find("joint pin, displacement") == 0)
          state.multipliers[i] = scene.system.layout.name_of_multiplier(i).back() == '1' ? 3 : 4;
      SparseMatrix C(scene.system.layout.pattern);
      scene.system.damping(state, C);
      const int at = scene.system.layout.of_coordinate(0);
      EXPECT_NEAR(C.dense()(at, at) / (0.2 * std::sqrt(3 * 3 + 2 * 4 * 4) * 0.05 * 0.05 / 1e-4), 1, 1e-12);
    }
}
