// Nonlinear springs of joints: their energy in time, their stiffness in statics and modes, and what is refused.

#include <samara/base/spring_law.h>

#include "../complex_step.h"
#include "../orders.h"
#include <gtest/gtest.h>

#include "scenes.h"
#include "started.h"

using namespace samara;

namespace
{
  /** The largest change of energy and numerical dissipation, by the energy at the start, over @p n steps. */
  double
  drift(const System &system, const Tableau &tableau, const double h, const unsigned int n)
  {
    StageIntegrator integrator(system, tableau, 1e-14);
    State           state = started(system);
    const double    start = total_energy(system, state);
    double          lost = 0, most = 0;
    for (unsigned int i = 0; i < n; ++i)
      {
        const StepResult step = integrator.step(state, h);
        EXPECT_TRUE(step.converged);
        lost += step.dissipated + step.viscous_loss;
        most = std::max(most, std::abs(total_energy(system, state) + lost - start) / start);
      }
    return most;
  }

  const std::string hardening = "set Spring force = 50*slide.displacement + 2000*slide.displacement^3",
                    as_a_law  = "set Force = -50*slide.displacement - 2000*slide.displacement^3",
                    sinking   = "set Spring force = 3*sinh(4*slide.displacement) + 20*tanh(slide.displacement/0.05)",
                    with_play = "set Spring force = deadband(800*slide.displacement, 20) + 2*slide.displacement";
} // namespace



// Against closed forms: energies of polynomials, means without cancellation, corners within.
TEST(NonlinearSprings, EnergiesAreIntegrals)
{
  const SpringLaw cubic(ScalarFunction("50*x + 2000*x^3", "x"), 0.1), kinked(ScalarFunction("deadband(x, 1)", "x"), 0),
    steep(ScalarFunction("1/(1.001 - x)", "x"), 0);
  const auto U = [](const double x) { return 25 * x * x + 500 * std::pow(x, 4); };
  for (const double x : {-0.3, 0.1, 0.7})
    EXPECT_NEAR(cubic.energy(x), U(x) - U(0.1), 1e-14 * U(0.7));
  EXPECT_NEAR(cubic.mean(0.2, 0.2 + 1e-12).force, 50 * 0.2 + 2000 * 0.008, 1e-9);
  EXPECT_NEAR(cubic.mean(-0.1, 0.3).force, (U(0.3) - U(-0.1)) / 0.4, 1e-13);
  const double h = 1e-5;
  EXPECT_NEAR(cubic.mean(-0.1, 0.3).slope,
              (cubic.mean(-0.1, 0.3 + h).force - cubic.mean(-0.1, 0.3 - h).force) / (2 * h),
              1e-6);
  EXPECT_NEAR(cubic.mean(0.2, 0.2).slope, 0.5 * (50 + 6000 * 0.04), 1e-12);
  EXPECT_DOUBLE_EQ(kinked.energy(3), 2);
  EXPECT_DOUBLE_EQ(kinked.energy(-3), 2);
  EXPECT_DOUBLE_EQ(kinked.mean(3, -1.5).force, (0.125 - 2) / -4.5);
  EXPECT_NEAR(steep.energy(1), std::log(1.001 / 0.001), 1e-12);
}



// The statement that a law in Force does not have: energy and dissipation are kept to round-off for every member and
// step.
TEST(NonlinearSprings, KeepTheirEnergy)
{
  for (const auto &text : {hardening, sinking})
    for (const double h : {0.02, 0.2})
      {
        const Scene scene(on_a_slide("", text));
        for_all_members([&](const Tableau &tableau) { EXPECT_LT(drift(scene.system, tableau, h, 40), 1e-13) << h; });
      }
  const Scene law(on_a_slide("", as_a_law));
  EXPECT_GT(drift(law.system, Tableau(1, 1.), 0.2, 40), 1e-3);
}



// With corners the work is exact, too, within a step and where steps end at them.
TEST(NonlinearSprings, KeepTheirEnergyAcrossCorners)
{
  const Scene scene(on_a_slide("", with_play));
  for_all_members([&](const Tableau &tableau) { EXPECT_LT(drift(scene.system, tableau, 0.03, 40), 1e-13); });
}



TEST(NonlinearSprings, Orders)
{
  const Scene   scene(on_a_slide("", hardening));
  const System &system = scene.system;
  const auto    end_of = [&](const Tableau &tableau, const unsigned int n) {
    return run(system, started(system), tableau, 1. / n, n).state.coordinates;
  };
  const auto exact = end_of(Tableau(3, 1.), 640);
  expect_orders({{1, 1, 80, 2}, {2, 1, 80, 4}, {2, 0, 80, 3}, {3, 1, 40, 6}, {3, 0, 40, 5}}, exact, 0.4, end_of);
}



// Three hundred times stiffer at its end, by a table: Newton's method finds its steps, and the energy closes.
TEST(NonlinearSprings, OfTables)
{
  for (const std::string kind : {"", ", cubic"})
    {
      const Scene scene("prm/examples/laws/bump_stop.prm",
                        {"Joints/strut/displacement/Spring force = table(\"" SAMARA_SOURCE_DIR
                         "/prm/examples/laws/bump_stop.csv\", strut.displacement" +
                         kind + ")"});
      EXPECT_LT(drift(scene.system, Tableau(2, 1.), 0.01, 100), 1e-13);
    }
}



TEST(NonlinearSprings, TangentsAreDerivatives)
{
  for (const auto &text : {hardening, sinking, std::string("set Spring = 3\n set ") + with_play.substr(4)})
    {
      const Scene       scene(on_a_slide("", text));
      const ComplexStep moving(scene.system, true, false, true);
      EXPECT_LT(moving.error_of_tangent(), 1e-13);
      EXPECT_LT(moving.error_of_damping(), 1e-13);
    }
}



// They hold from the first load step on, and modes are those of the slope.
TEST(NonlinearSprings, StaticsAndModes)
{
  Scene scene(
    "set Analyses = static, modal\nsubsection Modal\n set Modes = 1\nend\nsubsection Static\n set Load steps = 4\n"
    "end\n" +
    on_a_slide("", hardening) + "subsection Loads\n subsection weight\n set Type = gravity\n end\nend\n");
  scene.equilibrium();
  const double d = scene.value("slide.displacement");
  EXPECT_NEAR(50 * d + 2000 * d * d * d, -2 * 9.80665, 1e-9);
  EXPECT_NEAR(scene.modes()[0].lambda.imag(), std::sqrt((50 + 6000 * d * d) / 2), 1e-9);
}



// Lengths and angles: a pendulum with a moment that is no multiple of its angle, a rubber band.
TEST(NonlinearSprings, OfAnglesAndLengths)
{
  const std::string bodies =
    "subsection Bodies\n" +
    systems::rigid_body(
      "bar",
      "set Mass = 2\n set Position = 0.5, 0, 0\n set Inertia = 0.1, 0.2, 0.3\n set Frames = tip at 1 0 0\n"
      " set Angular velocity = 0, 3, 0\n set Velocity = 0, 0, -1.5\n") +
    "end\nsubsection Joints\n";
  const std::string hinge =
    systems::joint("h",
                   "revolute",
                   "set Axis = 0, 1, 0\n set Body A = ground\n set Body B = bar.centre\n set Position = 0, 0, 0\n" +
                     systems::motion("rotation", "set Spring moment = 30*sin(2*h.rotation)\n"));
  const std::string band =
    systems::joint("band",
                   "spring",
                   "set Body A = ground\n set Body B = bar.tip\n set Position = 1, 0, 2\n" +
                     systems::motion("length", "set Spring force = 9*(band.length^2 - 1/band.length)\n"));
  const Scene both(bodies + hinge + band + "end\n");
  for_all_members([&](const Tableau &tableau) { EXPECT_LT(drift(both.system, tableau, 0.05, 40), 2e-13); });
  // ∫ 30 sin 2θ and ∫ 9 (l² − 1/l) from where they are in the reference configuration
  StageIntegrator integrator(both.system, Tableau(2, 1.));
  State           state = started(both.system);
  integrator.step(state, 0.1);
  const double angle = state.coordinates[0], l = 2 + state.coordinates[1];
  EXPECT_NEAR(both.system.potential_energy(state.point()),
              15 * (1 - std::cos(2 * angle)) + 3 * (l * l * l - 8) - 9 * std::log(l / 2),
              1e-12);
}



TEST(NonlinearSprings, DependOnTheirOwnMotionAlone)
{
  for (const std::string wrong : {"5*slide.displacement rate",
                                  "5*m.position z",
                                  "5*slide.displacement + t",
                                  "5*slide.displacement*sin(t)",
                                  "slide.displacement + m.position z",
                                  "3*t",
                                  "7"})
    {
      const std::string problem = complaint_of(on_a_slide("", "set Spring force = " + wrong));
      EXPECT_NE(problem.find("<Spring force> of joint <slide>"), std::string::npos) << wrong << ": " << problem;
    }
  // a number that changes with the state is not a number: where it may stand is said
  EXPECT_NE(complaint_of(on_a_slide("", "set Spring = 50 + 2000*slide.displacement^2")).find("Spring force"),
            std::string::npos);
}



// A force that is less exact than what is asked for, as it is a small difference: the means are found all the same.
TEST(NonlinearSprings, ForcesWithRoundOff)
{
  const SpringLaw law(ScalarFunction("1000*(exp(x) - 1)", "x"), 0);
  for (const double x : {1e-4, 1e-7, 1e-10})
    EXPECT_NEAR(law.mean(0, x).force, 1000 * x * (1. / 2 + x / 6 + x * x / 24), 1e-12) << x;
}
