// Stops in the stages of a step: work to round-off whatever the rates, and motions through many contacts.
//
// References: the energy of U = ½ k (g⁺)²; closed forms of a mass on a spring (contact, restitution, rest on a stop);
// the order of the scheme; energies of the chattering mechanisms the method was measured with.

#include <samara/time/stepper.h>

#include <gtest/gtest.h>

#include <random>

#include "random_mechanisms.h"
#include "slopes.h"

using namespace samara;
using namespace samara::systems;

namespace
{
  double
  energy_of_stop(const Layout::Stop &stop, const double gap)
  {
    return stop.law.energy(gap);
  }

  /** A random stop, gap and rates, at scales of gaps, rates and steps that vary by ten orders. */
  struct RandomStop
  {
    Layout::Stop          stop;
    double                gap = 0, h = 1;
    std::array<double, 3> rates{};

    RandomStop(std::mt19937 &random, const double damping)
    {
      std::uniform_real_distribution<double> number(-1, 1);
      const auto scale  = [&](const double decades) { return std::pow(10., decades * number(random)); };
      h                 = 1e-3 * scale(2);
      const double rate = scale(6);
      stop              = {0, 0., 1., {scale(5), damping, 1, 0, nullptr}, false, ""};
      gap               = number(random) * h * rate * scale(0.5);
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

    double
    mean(const Tableau &t, const std::array<double, 3> &f) const
    {
      double sum = 0;
      for (unsigned int k = 0; k < t.s; ++k)
        sum += t.b(k) * f[k];
      return sum;
    }
  };
} // namespace



// h Σ b f ġ = U_f − U_i + loss, and the loss is not negative.
TEST(StopForces, WorkIsExact)
{
  std::mt19937 random(1);
  for (unsigned int s = 1; s <= 3; ++s)
    {
      const Tableau t(s, 0.5);
      unsigned int  n_touched = 0, n_lossy = 0;
      for (unsigned int i = 0; i < 4000; ++i)
        {
          const RandomStop sample(random, i % 2 == 0 ? 0. : 3.);
          const auto       f      = sample.forces(t);
          const double     change = sample.h * sample.mean(t, sample.rates);
          double           work = 0, size = 0;
          for (unsigned int k = 0; k < s; ++k)
            {
              const double w = sample.h * t.b(k) * f.force[k] * sample.rates[k];
              work += w;
              size += std::abs(w);
            }
          const double start = energy_of_stop(sample.stop, sample.gap),
                       end   = energy_of_stop(sample.stop, sample.gap + change);
          size += start + end;
          EXPECT_NEAR(work, end - start + f.loss, 1e-13 * size);
          EXPECT_GE(f.loss, 0.);
          EXPECT_TRUE(f.is_touched || size == 0.);
          n_touched += f.is_touched;
          n_lossy += f.loss > 0;
        }
      EXPECT_GT(n_touched, 2000u);
      EXPECT_GT(n_lossy, 500u);
    }
}



TEST(StopForces, SlopeIsTheDerivative)
{
  std::mt19937 random(2);
  for (unsigned int s = 1; s <= 3; ++s)
    {
      const Tableau t(s, 0.5);
      unsigned int  n_good = 0, n = 0;
      for (unsigned int i = 0; i < 500; ++i)
        {
          const RandomStop sample(random, i % 2 == 0 ? 0. : 3.);
          if (!sample.forces(t).is_touched)
            continue;
          ++n;
          n_good += has_slopes(sample, t, 1e-5); // where the damper is cut both are zero
        }
      // all but those within the difference of a corner
      EXPECT_GE(n_good, n - 3);
      EXPECT_GT(n, 250u);
    }
}



// It does not pull unless the correction for the work does; where it is touched all the time there is none.
TEST(StopForces, DamperDoesNotPull)
{
  const Tableau      t(2, 1.);
  const Layout::Stop stop{0, 0., 1., {100., 1e4, 1, 0, nullptr}, false, ""};
  const double       leaving[3] = {-0.1, -0.1, 0}, pressing[3] = {0.1, 0.1, 0};
  const auto         f = stop_forces(stop, t, 1., leaving, 0.1), g = stop_forces(stop, t, 1., pressing, 0.1);
  for (unsigned int k = 0; k < 2; ++k)
    {
      EXPECT_EQ(f.force[k], 0.);
      EXPECT_NEAR(g.force[k], 100. * (1 + 0.01 * t.c(k)) + 1e4 * 0.1, 1e-10);
    }
  EXPECT_NEAR(f.loss, 0.5 * 100. * (1 - 0.99 * 0.99), 1e-12);
  EXPECT_EQ(g.work_defect, 0.);
}



// A parabola that touches twice, g = −0.05 + 0.5 t − 0.5 t².
TEST(StopForces, TouchesAreFound)
{
  const Tableau      t(2, 1.);
  const double       rates[3] = {0.5 - t.c(0), 0.5 - t.c(1), 0};
  std::vector<Touch> touches;
  add_touches(7, t, -0.05, rates, 10., 1., touches);
  ASSERT_EQ(touches.size(), 2u);
  EXPECT_NEAR(touches[0].time, 10.5 - std::sqrt(0.15), 1e-12);
  EXPECT_NEAR(touches[1].time, 10.5 + std::sqrt(0.15), 1e-12);
  EXPECT_TRUE(touches[0].begins && !touches[1].begins);
  EXPECT_EQ(touches[0].stop, 7u);
}



// ------------------------------------------------------------------ motions

namespace
{
  std::string
  number(const double x)
  {
    char text[40];
    std::snprintf(text, sizeof text, "%.15g", x);
    return text;
  }

  std::string
  stops(const std::string &motion_name, const double k, const std::string &entries, const double damping = 0)
  {
    return motion(motion_name,
                  entries + " set Stop stiffness = " + number(k) + "\n set Stop damping = " + number(damping) + "\n");
  }

  std::string
  ball_on_line(const std::string &name, const double x, const std::string &entries = "")
  {
    return rigid_body(name,
                      "set Mass = 1\n set Inertia = 1, 1, 1\n set Position = " + number(x) + ", 0, 0\n" + entries);
  }

  /** Five balls in a row between two walls, four of them touching, the first one flying against them. */
  std::string
  cradle(const double k)
  {
    std::string bodies, joints;
    for (unsigned int i = 0; i < 5; ++i)
      {
        const std::string me = "b" + std::to_string(i);
        bodies += ball_on_line(me, 1. + i, i == 0 ? moving("1, 0, 0", "0, 0, 0") : "");
        joints += joint("j" + std::to_string(i),
                        "prismatic",
                        "set Body A = " + (i == 0 ? "ground" : "b" + std::to_string(i - 1) + ".centre") +
                          "\n set Body B = " + me + ".centre\n set Axis = 1, 0, 0\n" +
                          stops("displacement",
                                k,
                                i == 0 ? " set Lower stop = -0.05\n" :
                                i == 1 ? " set Lower stop = -0.01\n" :
                                         " set Lower stop = 0\n"));
      }
    joints += joint("wall",
                    "spring",
                    "set Body A = ground\n set Body B = b4.centre\n" + stops("length", k, " set Upper stop = 5.05\n"));
    return model(bodies, joints);
  }

  /** A double pendulum between stops of both angles and of the distance of its end. */
  std::string
  pendulum(const double k)
  {
    const double l = 0.5, a = 0.1, b = -0.3, w_a = 4, w_b = -5;
    const double x = l * std::sin(a), z = -l * std::cos(a), vx = l * std::cos(a) * w_a, vz = l * std::sin(a) * w_a;
    const auto   body =
      [&](
        const std::string &name, const double px, const double pz, const double v, const double w, const double spin) {
        return rigid_body(name,
                          "set Mass = 1\n set Inertia = 1e-3, 1e-3, 1e-3\n set Position = " + number(px) + ", 0, " +
                            number(pz) + "\n" + moving(number(v) + ", 0, " + number(w), "0, " + number(-spin) + ", 0"));
      };
    return model(
      body("a", x, z, vx, vz, w_a) +
        body(
          "b", x + l * std::sin(b), z - l * std::cos(b), vx + l * std::cos(b) * w_b, vz + l * std::sin(b) * w_b, w_b),
      joint("A",
            "revolute",
            "set Body A = ground\n set Body B = a.centre\n set Position = 0, 0, 0\n set Axis = 0, 1, 0\n" +
              stops("rotation", 0.25 * k, " set Lower stop = -0.2\n set Upper stop = 0.3\n")) +
        joint("B",
              "revolute",
              "set Body A = a.centre\n set Body B = b.centre\n set Position = " + number(x) + ", 0, " + number(z) +
                "\n set Axis = 0, 1, 0\n" +
                stops("rotation", 0.25 * k, " set Lower stop = -0.1\n set Upper stop = 0.7\n")) +
        joint("cord",
              "spring",
              "set Body A = ground\n set Body B = b.centre\n" + stops("length", k, " set Upper stop = 0.985\n")),
      gravity);
  }

  /** A block that turns while it falls on @p n supports along its lower side; cords from a place far above. */
  std::string
  block(const double k, const unsigned int n, const double damping = 0)
  {
    const double w = 0.3, height = 0.6, H = 10;
    std::string  frames,
      joints = joint("plane",
                     "planar",
                     "set Body A = ground\n set Body B = a.centre\n set Axis = 0, 1, 0\n set Axis 1 = 1, 0, 0\n" +
                       (damping > 0 ? motion("displacement 1", spring("25", "10")) : ""));
    for (unsigned int i = 0; i < n; ++i)
      {
        const double x = n == 1 ? 0. : w * (2. * i / (n - 1) - 1);
        frames += (i > 0 ? ", p" : "p") + std::to_string(i) + " at " + number(x) + " 0 " + number(-H);
        joints += joint("support " + std::to_string(i),
                        "spring",
                        "set Body A = ground\n set Body B = a.p" + std::to_string(i) + "\n" +
                          stops("length", k, " set Upper stop = " + number(std::hypot(H + 0.03, x)) + "\n", damping));
      }
    return model(rigid_body("a",
                            "set Mass = 1\n set Inertia = 0.15, 0.15, 0.15\n set Position = 0, 0, " +
                              number(height - H) + "\n set Frames = " + frames + "\n" + moving("0, 0, 0", "0, 0.4, 0")),
                 joints,
                 gravity);
  }

  /** What a stepper did up to some time, energies relative to the largest. */
  struct StoppedMotion
  {
    State        state;
    double       drift = 0, up = 0, viscous_loss = 0, dissipated = 0, largest = 0, least_step = 1e300;
    unsigned int n_steps = 0, n_failed = 0, n_rejected = 0, n_touches = 0, n_iterations = 0;
  };

  StoppedMotion
  run_to(const System &system, Integrator &integrator, Stepper &stepper, const double end)
  {
    StoppedMotion run;
    run.state           = start_of({"", "", 0, 0}, system);
    const auto   total  = [&]() { return energy_of(system, run.state) + potential_of(system, run.state); };
    const double start  = total();
    double       before = start;
    run.largest         = energy_of(system, run.state);
    while (run.state.time < end)
      {
        const Advance a = stepper.advance(run.state, end);
        run.viscous_loss += a.step.viscous_loss;
        run.dissipated += a.step.dissipated;
        run.largest    = std::max(run.largest, energy_of(system, run.state));
        run.drift      = std::max(run.drift, std::abs(total() + run.viscous_loss + run.dissipated - start));
        run.up         = std::max(run.up, total() - before);
        before         = total();
        run.least_step = std::min(run.least_step, a.h);
        run.n_failed += a.n_failed;
        run.n_rejected += a.n_rejected;
        run.n_touches += a.step.touches.size();
        ++run.n_steps;
      }
    run.n_iterations = integrator.n_iterations;
    run.drift /= run.largest;
    run.up /= run.largest;
    return run;
  }

  StoppedMotion
  run_to(const System &system, const Tableau &tableau, const double h, const double end, const double tolerance = 1e-13)
  {
    StageIntegrator integrator(system, tableau, tolerance);
    Stepper         stepper(system, integrator, h, 1e-9);
    return run_to(system, integrator, stepper, end);
  }

  double
  position(const State &state, const unsigned int node, const unsigned int i)
  {
    return state.position(node)(i);
  }
} // namespace



// Energy through many contacts at once, from stops that a step resolves to such that are shorter than a thousandth of
// it. The bounds are those that force times round-off of the positions leaves.
TEST(Stops, KeepTheEnergyWhateverTheirStiffness)
{
  struct Case
  {
    std::string                        name;
    std::function<std::string(double)> text;
    double                             h, end;
  };
  for (const Case &c : {Case{"cradle", cradle, 4e-3, 0.15},
                        Case{"pendulum", pendulum, 8e-3, 0.4},
                        Case{"block on two", [](const double k) { return block(k, 2); }, 8e-3, 0.6},
                        Case{"block on ten", [](const double k) { return block(k, 10); }, 8e-3, 0.6}})
    for (const double k : {1e6, 1e9, 1e12})
      {
        const Scene scene(c.text(k));
        for (const auto &[s, rho] : {std::make_pair(2, 1.), std::make_pair(2, 0.5), std::make_pair(3, 1.)})
          {
            SCOPED_TRACE(c.name + ", k = " + number(k) + ", s = " + std::to_string(s) + ", rho = " + number(rho));
            const StoppedMotion r     = run_to(scene.system, Tableau(s, rho), c.h, c.end);
            const double        bound = k < 1e7 ? 1e-11 : k < 1e10 ? 5e-11 : 2e-9;
            EXPECT_LT(r.drift, bound);
            EXPECT_LT(r.up, bound);
            EXPECT_GT(r.n_touches, 0u);
            EXPECT_LT(r.n_steps, 3 * c.end / c.h);
            EXPECT_LT(r.n_iterations, 15 * r.n_steps);
          }
      }
}



// A mass on a stop that a step resolves to a part of the contact's duration π √(m/k): exact without dissipation; with
// it the contact has a restitution of its own, here the least of 24 phases of the touch.
TEST(Stops, Restitution)
{
  const double k = 1e6, T = M_PI * std::sqrt(1 / k), gap = 1e-3;
  const Scene  scene(model(ball_on_line("a", 1, moving("-1, 0, 0", "0, 0, 0")),
                          joint("j",
                                "prismatic",
                                "set Body A = ground\n set Body B = a.centre\n set Axis = 1, 0, 0\n" +
                                  stops("displacement", k, " set Lower stop = " + number(-gap) + "\n"))));
  const auto   least = [&](const unsigned int s, const double rho, const double part) {
    double smallest = 1e300;
    for (unsigned int i = 0; i < 24; ++i)
      {
        // so that the touch is at any fraction of a step
        const double        h = gap / (std::floor(gap / (part * T)) + 1 + i / 24.);
        const StoppedMotion r = run_to(scene.system, Tableau(s, rho), h, h * std::ceil((gap + 2 * T) / h + 2));
        smallest              = std::min(smallest, r.state.rates[0]);
        EXPECT_EQ(r.n_failed, 0u);
        if (rho == 1)
          {
            EXPECT_NEAR(r.state.rates[0], 1, 1e-10);
          }
      }
    return smallest;
  };
  for (const double part : {0.25, 1., 4.})
    for (const unsigned int s : {1, 2, 3})
      least(s, 1., part);
  EXPECT_GT(least(2, 0.5, 0.25), 0.99);
  EXPECT_GT(least(3, 0.5, 0.5), 0.99);
  EXPECT_LT(least(3, 0.5, 0.5), 1);
}



// With dampers a block comes to rest on its supports: n ½ k (m g/(n k))² of energy, no motion, and nothing that stalls.
TEST(Stops, ComeToRest)
{
  for (const unsigned int n : {2, 10})
    for (const unsigned int s : {2, 3})
      {
        SCOPED_TRACE("n = " + std::to_string(n) + ", s = " + std::to_string(s));
        const double        k = 1e5;
        const Scene         scene(block(k, n, 200));
        const StoppedMotion r     = run_to(scene.system, Tableau(s, 0.5), 4e-3, 6.);
        double              speed = 0;
        for (const double v : r.state.y)
          speed = std::max(speed, std::abs(v));
        EXPECT_LT(speed, 1e-9);
        EXPECT_LT(r.drift, 1e-11);
        EXPECT_LE(r.n_failed, 4u);
        EXPECT_NEAR(energy_of(scene.system, r.state) / (n * 0.5 * k * std::pow(9.81 / (n * k), 2)), 1, 0.002);
      }
}



// Adaptive steps see contacts by their work defect: errors follow the tolerance, also without dissipation.
TEST(Stops, AdaptiveStepsResolveContacts)
{
  const Scene         scene(pendulum(1e5));
  const StoppedMotion exact = run_to(scene.system, Tableau(3, 1.), 2e-5, 0.4);
  for (const unsigned int s : {2, 3})
    for (const double rho : {1., 0.5})
      {
        SCOPED_TRACE("s = " + std::to_string(s) + ", rho = " + number(rho));
        double before = 1e300;
        for (const double tolerance : {1e-3, 1e-4, 1e-5})
          {
            StageIntegrator          integrator(scene.system, Tableau(s, rho), 1e-12);
            StepController::Settings settings;
            settings.tolerance    = tolerance;
            settings.largest_step = 0.02;
            Stepper             stepper(scene.system, integrator, 8e-3, settings);
            const StoppedMotion r     = run_to(scene.system, integrator, stepper, 0.4);
            const double        error = std::hypot(position(r.state, 2, 0) - position(exact.state, 2, 0),
                                            position(r.state, 2, 2) - position(exact.state, 2, 2));
            EXPECT_LT(error, 100 * tolerance);
            EXPECT_LT(error, before);
            EXPECT_LT(r.drift, 1e-10);
            EXPECT_LT(r.n_steps, 2000u);
            before = std::max(error, 1e-6);
          }
      }
}



// Trees of one to five bodies with all kinds of motions between stops, from soft to hard, with the default settings:
// bench_random_stops has two hundred of them. Numbers 145 and 1006 come near singular positions, where corrections of
// velocities shrink while reactions go astray.
TEST(Stops, RandomMechanisms)
{
  unsigned int              n_touches = 0;
  std::vector<unsigned int> seeds{145, 1006};
  for (unsigned int seed = 0; seed < 20; ++seed)
    seeds.push_back(seed);
  for (const unsigned int seed : seeds)
    {
      const RandomMechanism mechanism(seed, true);
      SCOPED_TRACE(mechanism.name());
      const Course c = course_of(mechanism, seed < 20 ? 30 : 50);
      EXPECT_TRUE(c.is_finished) << c.problem;
      EXPECT_LT(c.balance, 1e-9);
      EXPECT_LT(c.gap, 1e-8);
      EXPECT_GT(c.least_loss, -1e-14);
      n_touches += c.n_touches;
    }
  EXPECT_GT(n_touches, 100u);
}



// A drive pulls a rod beyond its dead centre: speeds grow without bounds, whatever the step, at the same time. The
// message names the loop.
TEST(Stops, DeadCentresAreNamed)
{
  const Course c = course_of(RandomMechanism(337, true), 50);
  EXPECT_FALSE(c.is_finished);
  EXPECT_NE(c.problem.find("t = 0.196335 s"), std::string::npos) << c.problem; // of a hundredth of the step, too
  EXPECT_NE(c.problem.find("joint rod"), std::string::npos) << c.problem;
  EXPECT_NE(c.problem.find("prescribed"), std::string::npos) << c.problem;
}
