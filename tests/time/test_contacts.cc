// Contacts with laws that are not linear, of stops and between bodies: work to round-off, restitution, and motions.
//
// References: energies of the laws; the integral of Hunt and Crossley's equation of one body; binary collisions of
// equal balls; momenta of free bodies; closed forms of a gear that rattles and of a rod's impact.

#include <gtest/gtest.h>

#include <random>

#include "contact_motion.h"
#include "slopes.h"

using namespace samara;
using namespace samara::systems;

namespace
{
  /** A random law, gap and rates, at scales that vary by many orders. */
  struct RandomContact
  {
    Layout::Stop          stop;
    double                gap = 0, h = 1;
    std::array<double, 3> rates{};

    RandomContact(std::mt19937 &random, const unsigned int kind)
    {
      std::uniform_real_distribution<double> number(-1, 1);
      const auto scale  = [&](const double decades) { return std::pow(10., decades * number(random)); };
      h                 = 1e-3 * scale(2);
      const double rate = scale(3);
      stop              = {0, 0., 1., {}, true, ""};
      if (kind < 4)
        stop.law = {
          scale(5), kind == 3 ? scale(3) : 0., 1 + 1.5 * std::abs(number(random)), kind == 1 ? scale(1) : 0., nullptr};
      else
        stop.law.expression = std::make_shared<SpringLaw>(Expression("1e4*s + 1e6*s^2 + 1e5*max(s - 1e-3, 0)"), 0.);
      if (kind == 2)
        stop.law = {scale(5), 0, 1, scale(1), nullptr};
      gap = number(random) * h * rate * scale(0.5);
      for (double &r : rates)
        r = rate * number(random);
      if (number(random) > 0.5)
        rates = {{rates[0], rates[0], rates[0]}};
    }

    StopForces
    forces(const Tableau &t) const
    {
      return stop_forces(stop, t, gap, rates.data(), h);
    }
  };

  /** The two spheres of RandomContact alone. */
  std::string
  ball_on_plane(const std::string &entries)
  {
    return joint("floor",
                 "ball on plane",
                 "set Body A = ground\n set Body B = a.centre\n set Radius = 0.1\n set Axis = 0, 0, 1\n" + entries);
  }
} // namespace



// h Σ b f ġ = U_f − U_i + loss for any power, expression, and damping; the loss is not negative.
TEST(ContactLaws, WorkIsExact)
{
  std::mt19937 random(1);
  for (unsigned int s = 1; s <= 3; ++s)
    {
      const Tableau t(s, 0.5);
      unsigned int  n_touched = 0, n_lossy = 0;
      for (unsigned int i = 0; i < 4000; ++i)
        {
          const RandomContact c(random, i % 5);
          const auto          f    = c.forces(t);
          double              work = 0, size = 0, change = 0;
          for (unsigned int k = 0; k < s; ++k)
            {
              const double w = c.h * t.b(k) * f.force[k] * c.rates[k];
              work += w;
              change += c.h * t.b(k) * c.rates[k];
              size += std::abs(w);
            }
          const double start = c.stop.law.energy(c.gap), end = c.stop.law.energy(c.gap + change);
          size += start + end;
          EXPECT_NEAR(work, end - start + f.loss, 2e-13 * size) << i;
          EXPECT_NEAR(f.elastic, end - start, 2e-13 * size) << i;
          EXPECT_GE(f.loss, 0.);
          n_touched += f.is_touched;
          n_lossy += f.loss > 0;
        }
      EXPECT_GT(n_touched, 2000u);
      EXPECT_GT(n_lossy, 500u);
    }
}



TEST(ContactLaws, SlopeIsTheDerivative)
{
  std::mt19937 random(2);
  for (unsigned int s = 1; s <= 3; ++s)
    {
      const Tableau t(s, 0.5);
      unsigned int  n_good = 0, n = 0;
      for (unsigned int i = 0; i < 400; ++i)
        {
          const RandomContact c(random, i % 4);
          if (!c.forces(t).is_touched)
            continue;
          ++n;
          n_good += has_slopes(c, t, 1e-4);
        }
      EXPECT_GE(n_good, n - n / 50); // all but those within the difference of a corner
      EXPECT_GT(n, 200u);
    }
}



// At rest to round-off on a contact that hardly changes: the mean slope has no cancellation, nothing stalls.
TEST(ContactLaws, TinyRatesMakeNoForces)
{
  const Tableau t(2, 1.);
  for (const double exponent : {1., 1.5, 3.})
    for (const double rate : {1e-8, 1e-12, 1e-16, 0.})
      {
        const Layout::Stop stop{0, 0., 1., {1e9, 0, exponent, 0, nullptr}, true, ""};
        const double       rates[3] = {rate, -0.7 * rate, 0}, gap = 1e-4;
        const auto         f = stop_forces(stop, t, gap, rates, 1e-3);
        for (unsigned int k = 0; k < 2; ++k)
          EXPECT_NEAR(f.force[k] / stop.law.force(gap), 1, 1e-6 * (rate / 1e-8) + 1e-14);
      }
}



// The exact integral of one body's equation against the first terms of its series, and where it ends.
TEST(ContactLaws, FactorFromRestitution)
{
  EXPECT_EQ(hunt_crossley_factor(1, 2), 0);
  EXPECT_NEAR(hunt_crossley_factor(0.999, 2) / (3 * 0.001 / (2 * 2)), 1, 2e-3);
  EXPECT_NEAR(hunt_crossley_factor(1 - 1e-9, 1) / 1.5e-9, 1, 1e-6);
  for (const double e : {0.9, 0.5, 0.1})
    {
      const double a = hunt_crossley_factor(e, 1);
      EXPECT_NEAR(hunt_crossley_factor(e, 5), a / 5, 1e-14 * a);
      EXPECT_NEAR(a - std::log(1 + a), -e * a - std::log(1 - e * a), 1e-12 * a);
    }
}



// A body against a stop and a ball against a plane come back with e v, whatever the law.
TEST(Contacts, RestitutionOfOneBody)
{
  for (const std::string law : {"1", "1.5", "force"})
    for (const double e : {0.9, 0.5, 0.2})
      {
        const auto entries = [&](const std::string &a, const std::string &b, const std::string &f) {
          return " set " + (law == "force" ? f + " = 1e5*s + 1e8*s^3\n" :
                                             a + "tiffness = 1e6\n set " + b + "xponent = " + law + "\n");
        };
        const std::string at_stop = entries("Stop s", "Stop e", "Stop force") +
                                    " set Stop restitution = " + number_of(e) + "\n set Stop speed = 2\n",
                          at_plane = entries("S", "E", "Force") + " set Restitution = " + number_of(e) +
                                     "\n set Impact speed = 2\n";
        const Scene slider(model(ball("a", 0.1, {0, 0, 0}, {0, 0, -2}, {0, 0, 0}),
                                 joint("j",
                                       "prismatic",
                                       "set Body A = ground\n set Body B = a.centre\n set Axis = 0, 0, 1\n" +
                                         motion("displacement", " set Lower stop = -0.004\n" + at_stop)))),
          flying(model(ball("a", 0.1, {0, 0, 0}, {0, 0, -2}, {0, 0, 0}),
                       ball_on_plane(" set Position = 0, 0, -0.104\n" + at_plane)));
        for (const Scene *scene : {&slider, &flying})
          {
            const auto r = contact_motion(scene->system, Tableau(3, 1.), 2e-4, 0.08);
            EXPECT_NEAR(r.state.y[8] / 2, e, 1e-3 * e) << law << ", e = " << e;
            EXPECT_LT(r.drift, 1e-12);
            EXPECT_EQ(r.least_loss, 0);
            EXPECT_EQ(r.n_failed, 0u);
          }
      }
}



// A ball bounces on Hertz' floor: energy to round-off without dissipation, for steps of a fifth of the contact to many
// contacts; never up with it.
TEST(Contacts, BouncingBallKeepsItsEnergy)
{
  for (const std::string exponent : {"1", "1.5"})
    for (const double k : {1e5, 1e8})
      {
        const Scene scene(
          model(ball("a", 0.1, {0, 0, 0.3}, {0.1, 0.2, 0}, {1, 2, 3}),
                ball_on_plane(" set Stiffness = " + number_of(k) + "\n set Exponent = " + exponent + "\n"),
                gravity));
        for (const auto &[s, rho] :
             {std::make_pair(1, 1.), std::make_pair(2, 1.), std::make_pair(3, 1.), std::make_pair(2, 0.5)})
          {
            const auto r = contact_motion(scene.system, Tableau(s, rho), 4e-3, 1.5);
            EXPECT_LT(r.drift, k > 1e6 ? 1e-11 : 3e-14) << exponent << ", " << k << ", s = " << s;
            EXPECT_LT(r.up, k > 1e6 ? 1e-11 : 3e-14);
          }
      }
}



// Equal balls in a row, apart from each other: each hands on its speed, the last flies off with all of it.
TEST(Contacts, NewtonsCradle)
{
  std::string    bodies, joints;
  const double   r       = 0.1;
  const unsigned n_balls = 5;
  for (unsigned int i = 0; i < n_balls; ++i)
    bodies += ball("b" + std::to_string(i), r, {0.22 * i, 0, 0}, {i == 0 ? 1. : 0., 0, 0}, {0, 0, 0});
  for (unsigned int i = 0; i + 1 < n_balls; ++i)
    joints += joint("c" + std::to_string(i),
                    "ball on ball",
                    "set Body A = b" + std::to_string(i) + ".centre\n set Body B = b" + std::to_string(i + 1) +
                      ".centre\n set Radius A = 0.1\n set Radius = 0.1\n set Stiffness = 1e7\n set Exponent = 1.5\n");
  const Scene scene(model(bodies, joints));
  for (const unsigned int s : {2, 3})
    {
      const auto   m     = contact_motion(scene.system, Tableau(s, 1.), 5e-4, 0.2);
      const double speed = m.state.y[6 * n_balls];
      EXPECT_NEAR(speed, 1, s == 2 ? 1e-3 : 1e-5);
      EXPECT_LT(m.drift, 1e-12);
      for (unsigned int i = 1; i < n_balls; ++i)
        EXPECT_NEAR(m.state.y[6 * i], 0, 2e-2);
    }
}



// Two free balls that spin meet off their centres, with friction: momentum and angular momentum stay, the loss is one.
// The same seen from a frame that is turned and moved, and with the two bodies in the other order.
TEST(Contacts, FreeBodiesKeepTheirMomenta)
{
  const auto two = [](const bool in_order) {
    return model(ball("a", 0.1, {0, 0, 0}, {1, 0, 0}, {3, -2, 5}) +
                   ball("b", 0.2, {0.4, 0.12, 0.05}, {-1, 0.1, 0}, {-4, 1, 2}),
                 joint("c",
                       "ball on ball",
                       std::string("set Body A = ") + (in_order ? "a" : "b") + ".centre\n set Body B = " +
                         (in_order ? "b" : "a") + ".centre\n set Radius A = " + (in_order ? "0.1" : "0.2") +
                         "\n set Radius = " + (in_order ? "0.2" : "0.1") +
                         "\n set Stiffness = 1e6\n set Exponent = 1.5\n set Restitution = 0.7\n set Impact speed = 2\n"
                         " set Friction = 0.4\n set Sticking speed = 1e-3\n"));
  };
  Vector6 first = Vector6::Zero();
  for (const bool in_order : {true, false})
    {
      const Scene   scene(two(in_order));
      const Vector6 start = momentum_of(scene.system, start_of({"", "", 0, 0}, scene.system));
      const auto    m     = contact_motion(scene.system, Tableau(3, 1.), 5e-4, 0.3);
      EXPECT_LT((momentum_of(scene.system, m.state) - start).norm(), 1e-11);
      EXPECT_LT(m.drift, 1e-12);
      EXPECT_GT(m.friction_loss, 0.01);
      EXPECT_GT(m.viscous_loss, 0.05);
      EXPECT_EQ(m.least_loss, 0);
      if (in_order)
        first = Eigen::Map<const Vector6>(&m.state.y[6]);
      else
        EXPECT_LT((first - Eigen::Map<const Vector6>(&m.state.y[6])).norm(), 1e-7);
    }
}



// Balls inside of a hollow ball and of a tube that turn and fly themselves: energy with its losses to round-off.
TEST(Contacts, InsideOfHollowBodies)
{
  for (const std::string kind : {"ball on ball", "ball on cylinder"})
    {
      const Scene scene(
        model(ball("a", 0.5, {0, 0, 0}, {0, 0.1, 0}, {1, 2, 1}) +
                ball("b", 0.1, {0.2, 0.1, 0}, {1, -1, 0.4}, {0, 3, 0}),
              joint("c",
                    kind,
                    "set Body A = a.centre\n set Body B = b.centre\n set Radius A = 0.5\n set Radius = 0.1\n"
                    " set Side = inside\n set Stiffness = 1e5\n set Friction = 0.3\n set Sticking speed = 1e-2\n"
                    " set Axis = 0.2, 0.1, 1\n")));
      for (const unsigned int s : {2, 3})
        {
          const auto m = contact_motion(scene.system, Tableau(s, 1.), 1e-3, 1.);
          EXPECT_LT(m.drift, 1e-11) << kind;
          EXPECT_GT(m.friction_loss, 0.01) << kind;
          EXPECT_EQ(m.least_loss, 0);
        }
    }
}



// Two wheels with a play between their teeth, the first one flying to and fro in it: in each contact the relative speed
// turns round, and the mean speed stays. With equal inertias and ratio -1 the momentum is that of θ_B − θ_A.
TEST(Contacts, RattlingGear)
{
  const double b = 0.02, k = 1e5, w = 1;
  const auto   wheel = [](const std::string &name, const std::string &x, const std::string &spin) {
    return rigid_body(name,
                      "set Mass = 1\n set Inertia = 1, 1, 1\n set Position = " + x + ", 0, 0\n" +
                        moving("0, 0, 0", "0, 0, " + spin));
  };
  const Scene scene(
    model(wheel("a", "0", "1") + wheel("b", "1", "0"),
          joint("on a", "revolute", "set Body A = ground\n set Body B = a.centre\n set Axis = 0, 0, 1\n") +
            joint("on b", "revolute", "set Body A = ground\n set Body B = b.centre\n set Axis = 0, 0, 1\n") +
            joint("teeth",
                  "gear",
                  "set Joint A = on a\n set Joint B = on b\n set Ratio = -1\n set Backlash = " + number_of(b) +
                    "\n set Mesh stiffness = " + number_of(k) + "\n")));
  // δ = θ_B + θ_A: reduced inertia ½, contact of half a period π √(1/(2k)), flights of b/w
  const double period = 2 * (b / w + M_PI * std::sqrt(1 / (2 * k)));
  for (const unsigned int s : {2, 3})
    {
      const auto m = contact_motion(scene.system, Tableau(s, 1.), period / 400, 5 * period);
      EXPECT_LT(m.drift, 1e-12);
      // after whole periods as at the start, but for the mean turn of θ_B − θ_A
      EXPECT_NEAR(m.state.coordinates[2], 0, 2e-5);
      EXPECT_NEAR(m.state.y[6 + 5], w, 1e-6);
      EXPECT_NEAR(m.state.y[12 + 5], 0, 1e-6);
    }
}



// A rod that flies with v against a wall: a wave runs to its far end and back in 2 L/c, meanwhile the force is v √(EA
// ρA); then it flies off with v and without strain. St. Venant's closed form, for a wall much stiffer than the rod.
TEST(Contacts, ImpactOfARod)
{
  const double EA = 1e4, v = 1, duration = 0.02, force = v * std::sqrt(EA);
  const Scene  scene(
    "subsection Sections\n subsection s\n set Type = engineering constants\n set EA = 1e4\n set GA2 = 1e4\n"
     " set GA3 = 1e4\n set GJ = 10\n set EI2 = 10\n set EI3 = 10\n set Mass = 1\n set I2 = 0.01\n set I3 = 0.01\n"
     " end\nend\nsubsection Bodies\n subsection rod\n set Type = beam\n set Points = 0, 0, 0; 1, 0, 0\n"
     " set Elements = 40\n set Degree = 1\n set Section = s\n set Velocity = -1, 0, 0\n end\nend\n"
     "subsection Joints\n subsection wall\n set Type = ball on plane\n set Body A = ground\n"
     " set Body B = rod.start\n set Axis = 1, 0, 0\n set Radius = 0.01\n set Position = -0.011, 0, 0\n"
     " set Stiffness = 1e7\n end\nend\n");
  const auto momentum = [&](const State &state) {
    double sum = 0;
    for (unsigned int node = 1; node < scene.system.layout.n_nodes; ++node)
      sum += scene.input.model.nodes[node].inertia(0, 0) * state.y[6 * node];
    return sum;
  };
  double       impulse = 0, before = -v, mean = 0, release = 0;
  unsigned int n = 0;
  const auto   m =
    contact_motion(scene.system, Tableau(2, 0.5), 1e-4, 0.03, [&](const State &state, const StepResult &step) {
      const double now = momentum(state);
      if (state.time > 0.006 && state.time < 0.016) // gap 0.001: it touches at 0.001 s
        {
          mean += (now - before) / 1e-4;
          ++n;
        }
      impulse += now - before;
      before = now;
      for (const Touch &touch : step.touches)
        release = touch.begins ? release : touch.time;
    });
  EXPECT_NEAR(mean / n / force, 1, 0.02);
  EXPECT_NEAR(impulse / 2, v, 0.02);
  EXPECT_NEAR(release - 0.001, duration, 0.05 * duration);
  EXPECT_LT(m.up, 1e-11);
}



// A ball that would be behind another one after a step has no step: it is halved until the two meet.
TEST(Contacts, NothingPassesUnseen)
{
  const Scene scene(
    model(ball("a", 0.1, {0, 0, 0}, {500, 0, 0}, {0, 0, 0}) + ball("b", 0.1, {12.3, 0.001, 0}, {0, 0, 0}, {0, 0, 0}),
          joint("c",
                "ball on ball",
                "set Body A = a.centre\n set Body B = b.centre\n set Radius A = 0.1\n set Radius = 0.1\n"
                " set Stiffness = 1e10\n set Exponent = 1.5\n")));
  for (const unsigned int s : {1, 2, 3})
    {
      const auto m = contact_motion(scene.system, Tableau(s, 1.), 0.05, 0.1);
      EXPECT_NEAR(m.state.y[12], 500, 5) << s;
      EXPECT_NEAR(m.state.y[6], 0, 5) << s;
      EXPECT_LT(m.drift, 1e-9) << s;
      EXPECT_GT(m.n_failed, 0u) << s;
    }
}



// A hinged beam that turns falls on a stop with its end, bends over it and flies off: against steps so short that the
// touch and the release, at 2.5 and 34 ms, are resolved. No step looks for them.
TEST(Contacts, BendingBeamOnAStop)
{
  const Scene scene(
    "subsection Sections\n subsection s\n set Type = tube\n set E = 2e9\n set Density = 1000\n set Outer radius = 0.02\n"
    " end\nend\nsubsection Bodies\n subsection rod\n set Type = beam\n set Section = s\n"
    " set Points = 0, 0, 0; 1, 0, 0\n set Elements = 2\n set Degree = 3\n set Angular velocity = 0, 2, 0\n end\nend\n"
    "subsection Joints\n subsection hinge\n set Type = revolute\n set Body A = ground\n set Body B = rod.start\n"
    " set Axis = 0, 1, 0\n end\n subsection stop\n set Type = ball on plane\n set Body A = ground\n"
    " set Body B = rod.end\n set Axis = 0, 0, 1\n set Radius = 0.02\n set Position = 0, 0, -0.025\n"
    " set Stiffness = 1e5\n set Exponent = 1.5\n end\nend\n");
  const unsigned int n      = scene.system.layout.n_nodes;
  const auto         motion = [&](const unsigned int s, const double h) {
    const auto m = contact_motion(scene.system, Tableau(s, 1.), h, 0.05);
    EXPECT_LT(m.drift, 1e-11) << s << ", " << h;
    return m.state;
  };
  const State reference = motion(3, 1.25e-4);
  const auto  error     = [&](const unsigned int s, const double h) {
    const State state = motion(s, h);
    double      most  = 0;
    for (unsigned int node = 1; node < n; ++node)
      most = std::max(most, (state.position(node) - reference.position(node)).norm());
    return most;
  };
  EXPECT_GT(reference.y[6 * (n - 1) + 2], 1.); // it has been thrown back
  const std::array<double, 3> coarse = {{error(1, 1e-3), error(2, 1e-3), error(3, 1e-3)}},
                              fine   = {{error(1, 2.5e-4), error(2, 2.5e-4), error(3, 5e-4)}};
  EXPECT_LT(fine[0], 1e-4);
  EXPECT_LT(fine[1], 1e-6);
  EXPECT_LT(fine[2], 3e-7);
  for (const unsigned int i : {0, 1, 2})
    EXPECT_LT(fine[i], coarse[i] / 5) << i;
}



// A tippe top: friction at one point turns it over, and Jellett's integral, the angular momentum times the vector from
// the centre of mass to the contact, is constant whatever the friction and the contact's force do.
TEST(Contacts, TippeTop)
{
  const Scene scene("prm/examples/tippe_top.prm");
  const auto  jellett = [&](const State &state) {
    const Matrix3 D = state.triad(1);
    const Vector3 c(0, 0, -2e-3), w = Eigen::Map<const Vector3>(&state.y[9]), J(1.5e-6, 1.5e-6, 1.6e-6);
    return (D * J.cwiseProduct(w)).dot(Vector3(0, 0, -15e-3) - D * c);
  };
  double     start = 0, change = 0, last = 1;
  const auto m = contact_motion(scene.system, Tableau(3, 0.5), 2e-3, 2.5, [&](const State &state, const StepResult &) {
    start  = start == 0 ? jellett(state) : start;
    change = std::max(change, std::abs(jellett(state) / start - 1));
    last   = state.triad(1)(2, 2);
  });
  EXPECT_LT(last, -0.9);
  EXPECT_LT(change, 1e-3);
  EXPECT_LT(m.up, 1e-10);
  EXPECT_EQ(m.least_loss, 0);
}



// A hundred balls in a row that are pressed together are let go: so many contacts at once are solved with the sparse
// matrix of all stages. Energy, momentum, and the symmetry of the row.
TEST(Contacts, ManyAtOnce)
{
  const unsigned int n = 100;
  std::string        bodies, joints;
  for (unsigned int i = 0; i < n; ++i)
    bodies += ball("b" + std::to_string(i), 0.1, {0.1999 * i, 0, 0}, {0, 0, 0}, {0, 0, 0});
  for (unsigned int i = 0; i + 1 < n; ++i)
    joints += joint("c" + std::to_string(i),
                    "ball on ball",
                    "set Body A = b" + std::to_string(i) + ".centre\n set Body B = b" + std::to_string(i + 1) +
                      ".centre\n set Radius A = 0.1\n set Radius = 0.1\n set Stiffness = 1e7\n set Exponent = 1.5\n");
  const Scene  scene(model(bodies, joints));
  const auto   m   = contact_motion(scene.system, Tableau(2, 1.), 1e-3, 0.02);
  const double all = (n - 1) * 1e7 / 2.5 * std::pow(1e-4, 2.5);
  double       sum = 0, energy = 0;
  for (unsigned int i = 1; i <= n; ++i)
    {
      sum += m.state.y[6 * i];
      energy += 0.5 * std::pow(m.state.y[6 * i], 2);
      EXPECT_NEAR(m.state.y[6 * i], -m.state.y[6 * (n + 1 - i)], 1e-10);
    }
  EXPECT_NEAR(sum, 0, 1e-12);
  EXPECT_GT(energy, 0.1 * all);
  EXPECT_LT(energy, all);
  EXPECT_LT(m.drift, 1e-11);
  EXPECT_EQ(m.n_failed, 0u);
  EXPECT_EQ(m.n_exact, 0u);
}
