// What is reported of a motion, and what steps leave out that nobody looks at.

#include <samara/model/probe_needs.h>

#include <gtest/gtest.h>

#include <cmath>

#include "systems.h"

using namespace samara;
using namespace samara::systems;

namespace
{
  /** All probes of all that a model has, with those along beams, which are not listed. */
  std::vector<Probe>
  all_probes(const Model &model)
  {
    std::vector<Probe> probes;
    for (const auto &item : model.items)
      {
        std::vector<std::string> names = item->probe_names();
        for (const std::string quantity :
             {"position x", "rotation y", "angle 2", "velocity z", "angular velocity y", "acceleration x", "moment 2"})
          names.push_back("0.3 m." + quantity);
        for (const auto &name : names)
          if (const auto probe = item->probe(name))
            {
              probes.push_back(*probe);
              probes.back().name = item->name + "." + name;
            }
      }
    return probes;
  }

  /** A state as it is reported, as far as a probe looks at it. */
  State
  reported_for(const Probe &probe, const System &system, const State &state)
  {
    const ProbeNeeds needs({probe});
    State            reported = state;
    if (needs.forces || needs.velocities)
      Projection(system).report(reported, needs.forces);
    return reported;
  }
} // namespace



// What a probe does not look at is not computed for it: its value is the same number. Of each kind there are some.
TEST(Reports, WhatProbesNeed)
{
  unsigned int n_of_places = 0, n_of_velocities = 0, n_of_forces = 0;
  for_all_systems([&](const MovingSystem &what, const System &system, const State &start) {
    State state = start;
    // one stage with dissipation: velocities of the integrator violate constraints
    StageIntegrator integrator(system, Tableau(1, 0.), 1e-12);
    for (unsigned int i = 0; i < 3; ++i)
      ASSERT_TRUE(integrator.step(state, what.h).converged);
    State full = state;
    Projection(system).report(full);
    for (const Probe &probe : all_probes(system.model))
      {
        EXPECT_EQ(probe.value(reported_for(probe, system, state)), probe.value(full))
          << what.name << ": " << probe.name;
        const ProbeNeeds needs({probe});
        ++(needs.forces ? n_of_forces : needs.velocities ? n_of_velocities : n_of_places);
      }
  });
  EXPECT_GT(n_of_places, 100u);
  EXPECT_GT(n_of_velocities, 100u);
  EXPECT_GT(n_of_forces, 100u);
}



// A shaft driven at a constant speed turns another by a universal joint. With angles of revolute and cylindrical joints
// among the unknowns, rows of constraints are not quadratic. The acceleration that is reported at each position, and
// the moment of the drive, are those of Cardan's joint in closed form, α = ω² cos β sin² β sin 2θ/(1 − sin² β sin² θ)²:
// the second rates of rows are exact.
TEST(Reports, AccelerationsOfCardansJoint)
{
  constexpr double  speed = 7, beta = M_PI / 6, J = 0.1;
  const std::string body = "    set Mass = 1\n    set Inertia = 0.1, 0.1, 0.1\n";
  Scene             scene(
    "subsection Bodies\n" + rigid_body("first", body) + rigid_body("second", body) + "end\nsubsection Joints\n" +
    joint("drive",
          "revolute",
          "    set Body A = ground\n    set Body B = first\n" + motion("rotation", "set Prescribed = 7*t\n")) +
    joint("bearing",
          "cylindrical",
          "    set Body A = ground\n    set Body B = second\n    set Axis = sin(30 deg), 0, cos(30 deg)\n") +
    joint("cross",
          "universal",
          "    set Body A = first\n    set Body B = second\n    set Axis = 0, 1, 0\n"
                      "    set Second axis = cos(30 deg), 0, -sin(30 deg)\n") +
    "end\nsubsection Output\n  set Probes = drive.rotation, bearing.rotation, drive.moment 3\nend\n");
  const System   &system = scene.system;
  State           state  = start_of({"", "", 0, 0}, system);
  StageIntegrator integrator(system, Tableau(3, 1.), 1e-12);
  const auto      moment = scene.input.model.find<Item>("drive", "joint").probe("moment 3");
  ASSERT_TRUE(moment);
  for (unsigned int i = 0; i < 60; ++i)
    {
      ASSERT_TRUE(integrator.step(state, 0.02).converged);
      State reported = state;
      Projection(system).report(reported);
      const double theta = speed * state.time, s = std::sin(beta) * std::sin(theta),
                   velocity     = speed * std::cos(beta) / (1 - s * s),
                   acceleration = speed * speed * std::cos(beta) * std::pow(std::sin(beta), 2) * std::sin(2 * theta) /
                                  std::pow(1 - s * s, 2);
      // components along the axis of the second shaft, in its own frame
      const Vector3 axis(std::sin(beta), 0, std::cos(beta));
      EXPECT_NEAR(axis.dot(Eigen::Map<const Vector3>(&reported.y[6 * 2 + 3])), velocity, 1e-11);
      EXPECT_NEAR(axis.dot(Eigen::Map<const Vector3>(&reported.accelerations[6 * 2 + 3])), acceleration, 1e-9);
      EXPECT_NEAR(moment->value(reported), J * acceleration * velocity / speed, 1e-10);
    }
}



// A body whose centre of mass goes round a hinge that is driven slowly, fast, and by little very fast. The force of the
// hinge is that of a pendulum, m r θ̇² and m r θ̈, its moment (J + m r²) θ̈: to round-off, as the second rates of what is
// prescribed are exact whatever their time scale is.
TEST(Reports, ForcesOfADrivenPendulum)
{
  constexpr double m = 2, r = 0.7, J = 0.3;
  struct Drive
  {
    std::string text;
    double      steady, amplitude, frequency;
  };
  for (const Drive &drive : {Drive{"3*t", 3, 0, 1},
                             Drive{"0.2*t + 0.5*sin(2*t)", 0.2, 0.5, 2},
                             Drive{"0.3*sin(40*t)", 0, 0.3, 40},
                             Drive{"t + 1e-5*sin(1e4*t)", 1, 1e-5, 1e4}})
    {
      Scene scene(
        "subsection Bodies\n" +
        rigid_body("bob", "    set Mass = 2\n    set Inertia = 0.3, 0.3, 0.3\n    set Position = 0.7, 0, 0\n") +
        "end\nsubsection Joints\n" +
        joint("hinge",
              "revolute",
              "    set Body A = ground\n    set Body B = bob\n    set Position = 0, 0, 0\n" +
                motion("rotation", "set Prescribed = " + drive.text + "\n")) +
        "end\n");
      const System   &system = scene.system;
      State           state  = start_of({"", "", 0, 0}, system);
      StageIntegrator integrator(system, Tableau(3, 1.), 1e-13);
      const double    h = std::min(0.02, 0.1 / drive.frequency);
      for (unsigned int i = 0; i < 20; ++i)
        {
          ASSERT_TRUE(integrator.step(state, h).converged);
          State reported = state;
          Projection(system).report(reported);
          const double phase        = drive.frequency * state.time,
                       theta        = drive.steady * state.time + drive.amplitude * std::sin(phase),
                       speed        = drive.steady + drive.amplitude * drive.frequency * std::cos(phase),
                       acceleration = -drive.amplitude * drive.frequency * drive.frequency * std::sin(phase);
          const Vector3 outward(std::cos(theta), std::sin(theta), 0), forward(-std::sin(theta), std::cos(theta), 0),
            force            = m * r * (acceleration * forward - speed * speed * outward);
          const Item  &hinge = scene.input.model.find<Item>("hinge", "joint");
          const double size  = m * r * (std::abs(acceleration) + speed * speed) + 1;
          for (unsigned int k = 0; k < 2; ++k)
            EXPECT_NEAR(hinge.probe("force " + std::to_string(k + 1))->value(reported), force(k), 1e-11 * size)
              << drive.text;
          EXPECT_NEAR(hinge.probe("moment 3")->value(reported), (J + m * r * r) * acceleration, 1e-11 * size)
            << drive.text;
        }
    }
}



// A matrix of constraints that is filled again and again: the last report is that of a projection that knows nothing
// of those before, when rows are left out and taken in between, too.
TEST(Reports, OnePositionAfterTheOther)
{
  Scene scene("prm/benchmarks/dynamics/four_bar.prm", {"Joints/B1/Type = revolute", "Joints/B2/Type = revolute"});
  const System   &system = scene.system;
  State           state  = start_of({"", "", 0, 0}, system);
  StageIntegrator integrator(system, Tableau(2, 0.5), 1e-12);
  Projection      projection(system);
  ASSERT_FALSE(state.left_out.empty());
  for (unsigned int i = 0; i < 60; ++i)
    {
      ASSERT_TRUE(integrator.step(state, 0.02).converged);
      State used = state, fresh = state;
      projection.report(used);
      Projection(system).report(fresh);
      EXPECT_LT(distance(used.y, fresh.y), 1e-12);
      EXPECT_LT(distance(used.accelerations, fresh.accelerations), 1e-9);
    }
}



// Steps whose corrections shrink as they should are not evaluated once more to say so, and are as good: the energy of
// each is accounted for within the tolerance of Newton's method, and they end where steps end that are evaluated.
TEST(Reports, NoEvaluationOnlyToConfirm)
{
  constexpr double       tolerance = 1e-8;
  constexpr unsigned int n         = 20;
  unsigned int           n_steps = 0, n_confirmed = 0;
  for_all_systems([&](const MovingSystem &what, const System &system, const State &start) {
    SCOPED_TRACE(what.name);
    for_all_members([&](const Tableau &tableau) {
      StageIntegrator integrator(system, tableau, tolerance), exact(system, tableau, 1e-13);
      const Record    r = run(system, start, integrator, what.h, n), e = run(system, start, exact, what.h, n);
      ASSERT_EQ(r.n_steps, n);
      ASSERT_EQ(e.n_steps, n);
      EXPECT_LT(r.balance, 2 * tolerance);
      EXPECT_LT(distance(r.state.q, e.state.q), 100 * tolerance);
      EXPECT_LT(distance(r.state.y, e.state.y), 1000 * tolerance);
      n_steps += n;
      n_confirmed += integrator.n_evaluations - std::min(integrator.n_evaluations, integrator.n_iterations);
    });
  });
  EXPECT_LT(n_confirmed, 0.7 * n_steps);
}
