// From step to step: stops, corners of what is prescribed, steps without solution, steps that are too long.
//
// References: closed forms of a mass that bounces on a spring; the order of the scheme when a force has kinks; the end
// of a run, wherever its steps were cut.

#include <samara/base/errors.h>
#include <samara/time/stepper.h>

#include <gtest/gtest.h>

#include "systems.h"

using namespace samara;
using namespace samara::systems;

namespace
{
  const std::string downwards = "  subsection weight\n set Type = gravity\n set Acceleration = 0, 0, -9.81\n end\n";

  /** 2 kg on a vertical slide 0.5 m above a stop of 2e3 N/m. */
  std::string
  bouncing(const std::string &entries = "")
  {
    return model(rigid_body("a", "set Mass = 2\n set Inertia = 1, 1, 1\n"),
                 joint("slide",
                       "prismatic",
                       "set Body A = ground\n set Body B = a.centre\n" +
                         motion("displacement", " set Lower stop = -0.5\n set Stop stiffness = 2e3\n" + entries)),
                 downwards);
  }

  /** What a stepper did up to some time. */
  struct StepperCourse
  {
    State               state;
    std::vector<double> ends, sizes, touches; ///< times and sizes of steps, times of touches
    double              balance = 0, largest_energy = 0, viscous_loss = 0, dissipated = 0;
    unsigned int        n_failed = 0, n_rejected = 0;
  };

  StepperCourse
  course(const System &system, const State &start, Stepper &stepper, const double end)
  {
    StepperCourse result;
    result.state = start;
    while (result.state.time < end)
      {
        const double  from = result.state.time, before = energy_of(system, result.state);
        const Advance a     = stepper.advance(result.state, end);
        const double  after = energy_of(system, result.state);
        EXPECT_TRUE(a.step.converged);
        EXPECT_GT(result.state.time, from);
        EXPECT_NEAR(result.state.time - from, a.h, 1e-12);
        result.ends.push_back(result.state.time);
        result.sizes.push_back(a.h);
        for (const Touch &touch : a.step.touches)
          result.touches.push_back(touch.time);
        result.n_failed += a.n_failed;
        result.n_rejected += a.n_rejected;
        result.viscous_loss += a.step.viscous_loss;
        result.dissipated += a.step.dissipated;
        result.largest_energy = std::max({result.largest_energy, after, std::abs(a.step.work_of_loads)});
        result.balance        = std::max(result.balance,
                                  std::abs(after - before - a.step.work_of_loads - a.step.work_of_drives +
                                           a.step.viscous_loss + a.step.dissipated));
      }
    result.balance /= result.largest_energy;
    return result;
  }

  StepperCourse
  course(const System  &system,
         const State   &start,
         const Tableau &tableau,
         const double   h,
         const double   end,
         const double   tolerance = 1e-14)
  {
    StageIntegrator integrator(system, tableau, tolerance);
    Stepper         stepper(system, integrator, h, 1e-9);
    return course(system, start, stepper, end);
  }

  /** At rest in the reference configuration, or with the velocities the text gives. */
  State
  start_without_kick(const System &system)
  {
    return start_of({"", "", 0, 0}, system);
  }
} // namespace



// Free fall, exact for all schemes that do not dissipate; in contact −x = g/ω² (1 − cos ωt) + v/ω sin ωt, for 2/ω (π −
// atan(ω v/g)). Steps in which the contact begins or ends are of third order in the step.
TEST(Stops, BouncesOnAStop)
{
  const Scene  scene(bouncing());
  const double g = 9.81, fall = std::sqrt(2 * 0.5 / g), v = g * fall, w = std::sqrt(2e3 / 2),
               contact = 2 / w * (M_PI - std::atan(w * v / g)), period = 2 * fall + contact;
  const unsigned int n      = 5;
  double             coarse = 0;
  for (const double h : {0.004, 0.001})
    {
      const StepperCourse c = course(scene.system, scene.system.reference(), Tableau(3, 1.), h, n * period);
      ASSERT_EQ(c.touches.size(), 2 * n);
      EXPECT_EQ(c.n_failed, 0u);
      double error = 0;
      for (unsigned int i = 0; i < n; ++i)
        error = std::max({error,
                          std::abs(c.touches[2 * i] - i * period - fall),
                          std::abs(c.touches[2 * i + 1] - i * period - fall - contact)});
      EXPECT_LT(error, h > 0.002 ? 1e-4 : 1e-6);
      if (coarse > 0)
        {
          EXPECT_GT(std::log(coarse / error) / std::log(4), 2.5);
        }
      coarse = error;
      EXPECT_LT(c.balance, 1e-12);
      EXPECT_NEAR(total_energy(scene.system, c.state), 0, 1e-12 * c.largest_energy * n);
    }
}



// Whatever the scheme and the step, even one as long as the contact: no energy but what is said to be dissipated.
TEST(Stops, EnergyOfAllMembers)
{
  for (const std::string damping : {"", "set Stop damping = 3\n"})
    {
      const Scene scene(bouncing(damping));
      for_all_members([&](const Tableau &tableau) {
        for (const double h : {0.002, 0.013, 0.1})
          {
            SCOPED_TRACE("h = " + std::to_string(h));
            const StepperCourse c = course(scene.system, scene.system.reference(), tableau, h, 3.);
            EXPECT_LT(c.balance, 1e-12);
            EXPECT_GE(c.touches.size(), 1u);
            EXPECT_NEAR(total_energy(scene.system, c.state) + c.viscous_loss + c.dissipated,
                        0,
                        1e-10 * c.largest_energy);
            EXPECT_EQ(c.viscous_loss > 0, !damping.empty());
          }
      });
    }
}



// A pendulum between two stops of its angle.
TEST(Stops, TwoStops)
{
  const Scene scene(model(
    rigid_body("a", "set Mass = 2\n set Inertia = 1, 1, 1\n set Position = 1, 0, 0\n" + moving("0, 0, -2", "0, 2, 0")),
    joint("j",
          "revolute",
          "set Body A = ground\n set Body B = a.centre\n set Position = 0, 0, 0\n set Axis = 0, 1, 0\n" +
            motion("rotation", " set Lower stop = -0.1\n set Upper stop = 2.5\n set Stop stiffness = 500\n")),
    downwards));
  for_all_members([&](const Tableau &tableau) {
    const StepperCourse c = course(scene.system, start_without_kick(scene.system), tableau, 0.01, 5.);
    EXPECT_LT(c.balance, 1e-12);
    EXPECT_GE(c.touches.size(), 4u);
  });
}



// Two equal masses that touch at the same time.
TEST(Stops, TwoAtATime)
{
  const std::string slide = motion("displacement", " set Lower stop = -0.5\n set Stop stiffness = 2e3\n"),
                    body  = "set Mass = 2\n set Inertia = 1, 1, 1\n";
  const Scene         scene(model(rigid_body("a", body) + rigid_body("b", body),
                          joint("A", "prismatic", "set Body A = ground\n set Body B = a.centre\n" + slide) +
                            joint("B", "prismatic", "set Body A = ground\n set Body B = b.centre\n" + slide),
                          downwards));
  const StepperCourse c = course(scene.system, scene.system.reference(), Tableau(2, 1.), 0.01, 6.);
  EXPECT_LT(c.balance, 1e-12);
  EXPECT_NEAR(total_energy(scene.system, c.state), 0, 1e-10 * c.largest_energy);
  EXPECT_NEAR(c.state.coordinates[0], c.state.coordinates[1], 1e-9);
}



namespace
{
  /** v/ω + ix at t, from rest: the integral of exp(iω(t − τ)) f(τ)/(m ω), by Gauss' rule between corners. */
  std::complex<double>
  response(const std::function<double(double)> &f, const std::vector<double> &corners, const double t)
  {
    const double         w = 5, m = 2;
    const Tableau        gauss(3, 1.);
    std::complex<double> sum = 0;
    for (unsigned int i = 0; i + 1 < corners.size(); ++i)
      for (unsigned int j = 0; j < 200; ++j)
        for (unsigned int k = 0; k < 3; ++k)
          {
            const double h = (corners[i + 1] - corners[i]) / 200, tau = corners[i] + (j + gauss.c(k)) * h;
            sum += h * gauss.b(k) * f(tau) / (m * w) * std::polar(1., w * (t - tau));
          }
    return sum;
  }

  double
  distance_from(const State &state, const std::complex<double> expected)
  {
    return std::abs(std::complex<double>(state.rates[0] / 5, state.coordinates[0]) - expected);
  }
} // namespace



// Steps end at corners and jumps, go on with their size, and keep the order.
TEST(Corners, AreHitAndKeepTheOrder)
{
  const Scene               scene(pushed("table: 0.213 0; 0.5 40; 0.507 -20; 0.8 -20; 1.1 0"));
  const std::vector<double> corners = {0.213, 0.5, 0.507, 0.8, 1.1, 1.5};
  const auto                f       = [](const double t) {
    if (t < 0.5)
      return 40 * (t - 0.213) / 0.287;
    if (t < 0.507)
      return 40 - 60 * (t - 0.5) / 0.007;
    return t < 0.8 ? -20. : t < 1.1 ? -20 + 20 * (t - 0.8) / 0.3 : 0.;
  };
  const auto  expected = response(f, corners, 1.5);
  const State start    = scene.system.reference();
  for_all_members([&](const Tableau &tableau) {
    // what is left to a corner varies: sizes far apart show the orders nevertheless
    const double        h      = tableau.s == 1 ? (tableau.alpha > 0 ? 0.002 : 0.01) : tableau.s == 2 ? 0.02 : 0.08;
    const unsigned int  factor = tableau.s == 3 ? 4 : 8;
    const StepperCourse coarse = course(scene.system, start, tableau, h, 1.5),
                        fine   = course(scene.system, start, tableau, h / factor, 1.5);
    for (const StepperCourse &c : {coarse, fine})
      for (const double t : corners)
        {
          const auto is_there = [&](const double end) { return std::abs(end - t) < 1e-13; };
          EXPECT_TRUE(std::any_of(c.ends.begin(), c.ends.end(), is_there)) << t;
        }
    EXPECT_LT(coarse.balance, 1e-12);
    // no step is longer than it was asked to be, and after a corner they have their size again
    EXPECT_LE(*std::max_element(fine.sizes.begin(), fine.sizes.end()), h / factor * (1 + 1e-6));
    EXPECT_LE(fine.sizes.size(), 1.5 / h * factor + 7);
    const double error = distance_from(coarse.state, expected), finer = distance_from(fine.state, expected);
    EXPECT_NEAR(std::log(error / finer) / std::log(factor),
                tableau.alpha > 0 ? 2. * tableau.s - 1 : 2. * tableau.s,
                0.15)
      << finer;
    // steps that pass over corners do not have it
    const State over = run(scene.system, start, tableau, h / factor, std::lround(1.5 * factor / h)).state;
    if (tableau.s > 1)
      {
        EXPECT_GT(distance_from(over, expected), 100 * finer);
      }
  });
}



// A blow that is much shorter than the steps, which are chosen, is not passed over: they end where it begins and ends.
TEST(Corners, OfAShortBlowAreHitByAdaptiveSteps)
{
  const Scene              scene(pushed("t > 2.5 && t < 2.5001 ? 3e4 : 0"));
  const auto               force = [](const double t) { return t > 2.5 && t < 2.5001 ? 3e4 : 0.; };
  StageIntegrator          integrator(scene.system, Tableau(3, 0.5), 1e-12);
  StepController::Settings settings;
  settings.tolerance    = 1e-4;
  settings.largest_step = 0.5;
  Stepper             stepper(scene.system, integrator, 0.1, settings);
  const StepperCourse c = course(scene.system, scene.system.reference(), stepper, 3.);
  for (const double t : {2.5, 2.5001})
    EXPECT_NE(std::find(c.ends.begin(), c.ends.end(), t), c.ends.end()) << t;
  EXPECT_LT(distance_from(c.state, response(force, {2.5, 2.5001, 3.}, 3.)), 1e-2 * 0.3);
}



// A prescribed motion has corners, too: those of its rate, where the drive gives a blow.
TEST(Corners, OfPrescribedMotions)
{
  const Scene         scene(model(rigid_body("a", "set Mass = 2\n set Inertia = 1, 2, 3\n"),
                          joint("j",
                                "revolute",
                                "set Body A = ground\n set Body B = a.centre\n" +
                                  motion("rotation", " set Prescribed = table: 0.1 0; 0.33 1; 0.7 1\n"))));
  const StepperCourse c = course(scene.system, scene.system.reference(), Tableau(3, 0.5), 0.05, 1.);
  for (const double t : {0.1, 0.33, 0.7})
    EXPECT_NE(std::find(c.ends.begin(), c.ends.end(), t), c.ends.end()) << t;
  EXPECT_NEAR(c.state.coordinates[0], 1, 1e-12);
  EXPECT_LT(c.balance, 1e-12);
}



namespace
{
  /** Two bodies that tumble by many radians a step and are slowed down. */
  const std::string braked =
    model(rigid_body("a", offset + moving("0, 0, 0", "20, 10, -15")) + rigid_body("b", second),
          joint("A", "spherical", "set Body A = ground\n set Body B = a.pivot\n") +
            joint("B", "spherical", "set Body A = a.hinge\n set Body B = b.centre\n") +
            joint("brake A",
                  "flexible joint",
                  "set Body A = ground\n set Body B = a.pivot\n set Rotational damping = 2, 2, 2\n") +
            joint("brake B",
                  "flexible joint",
                  "set Body A = a.hinge\n set Body B = b.centre\n set Rotational damping = 0.5, 0.5, 0.5\n"));

  void
  expect_recovery(const Tableau &tableau, const double step = 0.4)
  {
    const Scene         scene(braked);
    const System       &system = scene.system;
    const StepperCourse c      = course(system, start_without_kick(system), tableau, step, 4., 1e-10);
    EXPECT_GT(c.n_failed, 0u);
    EXPECT_EQ(c.state.time, 4.);
    EXPECT_LT(*std::min_element(c.sizes.begin(), c.sizes.end()), 0.55 * step);
    EXPECT_NEAR(*std::max_element(c.sizes.end() - 6, c.sizes.end()), step, 1e-9);
    EXPECT_LT(c.balance, 1e-7); // of such long steps: doc/theory/integrators.md
  }
} // namespace



// Halved until there is a solution, and back to the step that is wanted when that is possible again. (With one stage
// these steps have a solution.)
TEST(Stepper, HalvesAndRecovers)
{
  for (const double rho : {1., 0.5, 0.})
    {
      SCOPED_TRACE("rho = " + std::to_string(rho));
      expect_recovery(Tableau(2, rho));
    }
}



// Where the iteration has gone astray, the next factorisation may meet a singular matrix: no solution, not an end.
TEST(Stepper, HalvesWhenTheMatrixIsSingular)
{
  EXPECT_NO_THROW(expect_recovery(Tableau(3, 0.5), 0.4));
}



// The state is that of the last good step if nothing helps, and the message says where and when.
TEST(Stepper, GivesUpAtTheSmallestStep)
{
  const Scene     scene(braked);
  const System   &system = scene.system;
  const State     start  = start_without_kick(system);
  State           state  = start;
  StageIntegrator integrator(system, Tableau(2, 0.5));
  Stepper         stepper(system, integrator, 1., 0.4);
  try
    {
      stepper.advance(state, 10.);
      FAIL() << "a step of a dozen radians has a solution";
    }
  catch (const NotConverged &problem)
    {
      const std::string text = problem.what();
      EXPECT_NE(text.find("t = 0 s"), std::string::npos) << text;
      EXPECT_NE(text.find("smallest step, 0.5 s"), std::string::npos) << text;
      // whatever the iteration, which goes astray, ends with: no law is to blame
      EXPECT_NE(text.find("the largest force left is at "), std::string::npos) << text;
    }
  EXPECT_EQ(state.q, start.q);
  EXPECT_EQ(state.y, start.y);
  EXPECT_EQ(state.time, 0);
}



// Adaptive: a first step that is too long is rejected, and the error is that which was asked for.
TEST(Stepper, RejectsAndRecovers)
{
  const Scene   scene(pushed("0"), {"Joints/slide/displacement/Rest = 0.2"});
  const System &system = scene.system;
  State         start  = system.reference();
  system.stresses(start, start.stress);
  for (const unsigned int s : {2, 3})
    for (const double rho : {1., 0.5, 0.})
      {
        SCOPED_TRACE("s = " + std::to_string(s) + ", rho = " + std::to_string(rho));
        StageIntegrator          integrator(system, Tableau(s, rho), 1e-14);
        StepController::Settings settings;
        // ten periods of ω = 5 about x = 0.2, from x = 0 to 0.4
        const double end = 4 * M_PI, tolerance = 1e-6;
        settings.tolerance = tolerance;
        settings.duration  = end;
        settings.length    = 0.2;
        Stepper             stepper(system, integrator, 1., settings);
        const StepperCourse c = course(system, start, stepper, end);
        EXPECT_GT(c.n_rejected, 0u);
        EXPECT_EQ(c.state.time, end);
        EXPECT_LT(c.balance, 1e-12);
        const double error = distance_from(c.state, 0.) / 0.4;
        EXPECT_GT(error, 0.2 * tolerance);
        EXPECT_LT(error, 2 * tolerance);
      }
}



// What is cut short at the end of a call goes on with the step before.
TEST(Stepper, EndsWhereItIsTold)
{
  const Scene     scene(pushed("sin(3*t)"));
  StageIntegrator integrator(scene.system, Tableau(3, 1.));
  Stepper         stepper(scene.system, integrator, 0.03, 1e-9);
  State           state = scene.system.reference();
  for (const double end : {0.1, 0.10001, 0.3, 0.31, 1.})
    {
      while (state.time < end)
        stepper.advance(state, end);
      EXPECT_EQ(state.time, end);
      EXPECT_NEAR(stepper.next_step, 0.03, 1e-15);
    }
  EXPECT_LT(distance_from(state, response([](const double t) { return std::sin(3 * t); }, {0, 1}, 1.)), 1e-9);
}



namespace
{
  /** Has no solution for steps that are longer than it likes. */
  class Refusing : public Integrator
  {
  public:
    Refusing(const System &system, const double longest)
      : longest(longest)
      , inner(system, Tableau(2, 1.), 1e-12)
    {}

    double longest;

    StepResult
    step(State &state, const double h) override
    {
      if (h <= longest)
        return inner.step(state, h);
      StepResult result;
      result.converged = false;
      return result;
    }

  private:
    StageIntegrator inner;
  };
} // namespace



// Each failure costs what many steps do: a length that fails again and again is left alone for longer and longer, and
// found again when it has a solution.
TEST(FixedSteps, ThatAreTooLongAreRemembered)
{
  const Scene  scene(bouncing());
  const double h = 1e-3;
  for (const double share : {0.9, 0.3})
    {
      SCOPED_TRACE(share);
      Refusing            integrator(scene.system, share * h);
      Stepper             stepper(scene.system, integrator, h, 1e-9);
      const State         start = scene.system.reference();
      const StepperCourse first = course(scene.system, start, stepper, 1.);
      EXPECT_LT(first.n_failed, 40u);
      EXPECT_NEAR(first.state.time, 1., 1e-12);
      integrator.longest         = 1;
      const StepperCourse second = course(scene.system, first.state, stepper, 2.);
      EXPECT_EQ(second.n_failed, 0u);
      EXPECT_NEAR(second.sizes.at(second.sizes.size() - 2), h, 1e-9); // the last one is what is left
    }
}
