// What integrators do to the energy: stories of doc/benchmarks/stability.md in short.
//
// References: energies of the start, that nothing but the integrator changes; the tension of a rigid pendulum,
// m (v² − g y)/L; 1/(1 + N z²) of the energy after N steps of z radians for inertial velocities (doc/theory/rivals.md).

#include "trial.h"

using namespace samara;

namespace
{
  struct Pendulum
  {
    Trial  trial;
    double change, tension; ///< of the energy at the end; rms of the error of the tension in the second half; relative

    explicit Pendulum(const std::string &fast, const std::vector<std::string> &method)
      : trial("stability/stiff_spring_pendulum",
              method + std::vector<std::string>{"Constants/fast = " + fast, "Dynamic/Smallest step = 1e-3"},
              {"bob.position y", "bob.velocity x", "bob.velocity y", "coil.force"})
      , change(0)
      , tension(0)
    {
      if (!trial.motion)
        return;
      change            = (trial.energy() - trial.motion->budget.start) / (trial.motion->budget.start + 9.81);
      double      error = 0, whole = 0;
      const auto &v = trial.motion->values;
      for (unsigned int i = v.size() / 2; i < v.size(); ++i)
        {
          const double rigid = v[i][1] * v[i][1] + v[i][2] * v[i][2] - 9.81 * v[i][0];
          error += std::pow(v[i][3] - rigid, 2);
          whole += rigid * rigid;
        }
      tension = std::sqrt(error / whole);
    }
  };

  double
  left_of_the_blade(const std::vector<std::string> &method, const std::string &revolutions = "2")
  {
    const Trial trial("stability/spinning_blade",
                      method +
                        std::vector<std::string>{"Constants/revolutions = " + revolutions, "Analyses = dynamic"});
    return trial.motion ? trial.left() : std::nan("");
  }
} // namespace



// Without dissipation the energy stays but the force rings, more than the tension itself; with it, the force is that
// of a rod at any stiffness.
TEST(StiffSpringPendulum, FamilyRingsOrDecays)
{
  for (const std::string fast : {"1", "1e3", "1e5"})
    {
      SCOPED_TRACE("h omega = " + fast);
      const Pendulum one(fast, family(1, 1)), two(fast, family(2, 1)), three(fast, family(2, 0)),
        four(fast, family(3, 0.5));
      for (const Pendulum *p : {&one, &two, &three, &four})
        ASSERT_TRUE(p->trial.motion) << p->trial.failure;
      EXPECT_NEAR(one.change, 0, 1e-8);
      EXPECT_NEAR(two.change, 0, 1e-8);
      EXPECT_LT(three.change, 0);
      EXPECT_GT(three.change, -0.04);
      EXPECT_LT(four.change, 0);
      EXPECT_GT(four.change, -1e-3);
      if (fast != "1")
        {
          EXPECT_GT(one.tension, 1);
          EXPECT_GT(two.tension, 1);
          EXPECT_LT(three.tension, 0.06);
          EXPECT_LT(four.tension, 1e-3);
        }
    }
}



// The trapezoidal rule, and generalised α without dissipation, gain until there is no solution, as soon as the
// vibration is not resolved; with dissipation generalised α holds.
TEST(StiffSpringPendulum, Rivals)
{
  for (const std::string name : {"trapezoidal", "generalised alpha"})
    {
      const Pendulum resolved("3", rival(name)), stiff("1e3", rival(name));
      ASSERT_TRUE(resolved.trial.motion) << name;
      EXPECT_NEAR(resolved.change, 0, 0.05) << name;
      EXPECT_FALSE(stiff.trial.motion) << name;
    }
  const Pendulum damped("1e3", rival("generalised alpha", 0.5));
  ASSERT_TRUE(damped.trial.motion);
  EXPECT_LT(damped.tension, 0.02);
  EXPECT_LT(damped.change, -0.03); // it pays more for it than the family with the same radius, 4e-6
}



// Steady rotation is lost by inertial velocities and by nothing in the nodes' frames.
TEST(SpinningBlade, EnergyAtFiveDegreesAStep)
{
  const double z = M_PI / 36;
  EXPECT_NEAR(left_of_the_blade(rival("energy decaying", 0), "1"), 1 / (1 + 72 * z * z), 0.02);
  EXPECT_LT(left_of_the_blade(rival("energy decaying", 0.5), "1"), 0.5);
  EXPECT_NEAR(left_of_the_blade(family(2, 1)), 1, 1e-9);
  for (const std::vector<std::string> &method : {family(2, 0), family(3, 0.5)})
    EXPECT_NEAR(left_of_the_blade(method), 1 - 1.25e-5, 1e-7); // the stretching that it starts without
  EXPECT_LT(left_of_the_blade({"Dynamic/Integrator = BDF index 2"}, "1"), 0.97);
}



// From the steady state nothing is lost by any method in the nodes' frames, whatever it dissipates.
TEST(SpinningBlade, SteadyStateStays)
{
  for (const std::vector<std::string> &method : {family(2, 0), family(3, 0.5), rival("generalised alpha", 0)})
    {
      Scene scene("prm/benchmarks/stability/spinning_blade.prm",
                  method + std::vector<std::string>{"Constants/revolutions = 10"});
      scene.equilibrium();
      auto &dynamics = scene.analysis<DynamicAnalysis>();
      dynamics.start(scene.context);
      dynamics.run(scene.context);
      const auto &budget = dynamics.budget;
      EXPECT_EQ(dynamics.report.n_steps, 720u);
      EXPECT_NEAR((budget.kinetic + budget.strain) / budget.start, 1, 1e-10);
    }
}



// Loss in two seconds of the slider-crank without weight, about two revolutions.
TEST(SliderCrank, Losses)
{
  const auto lost = [](const std::vector<std::string> &method, const std::string &step) {
    const Trial trial("dynamics/slider_crank",
                      method + std::vector<std::string>{"Loads/weight/Acceleration = 0, 0, 0",
                                                        "Dynamic/End time = 2",
                                                        "Dynamic/Newton tolerance = 1e-10",
                                                        "Dynamic/Step = " + step});
    return trial.motion ? 1 - trial.left() : std::nan("");
  };
  EXPECT_NEAR(lost(family(1, 1), "0.01"), 0, 1e-8);
  EXPECT_NEAR(lost(family(2, 1), "0.01"), 0, 1e-8);
  const double two = lost(family(2, 0), "0.01"), three = lost(family(3, 0.5), "0.01"),
               alpha    = lost(rival("generalised alpha", 0.5), "0.01"),
               decaying = lost(rival("energy decaying", 0), "0.01");
  EXPECT_NEAR(std::log2(two / lost(family(2, 0), "0.005")), 3, 0.3);
  EXPECT_LT(two, alpha / 2);
  EXPECT_LT(three, alpha / 100);
  EXPECT_GT(decaying, 0.3);
  EXPECT_NEAR(std::log2(decaying / lost(rival("energy decaying", 0), "0.005")), 0.6, 0.4);
}
