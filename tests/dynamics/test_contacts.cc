// The table of contacts: a ball between a stop without and one with a damper, closed forms of its times and losses.

#include <samara/analysis/dynamic.h>

#include "../output/scratch_folder.h"
#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

using namespace samara;

namespace
{
  /** A mass of 1 kg that flies at 1 m/s to a spring at 0.01 m, back to one at −0.02 m with a damper, and so on. */
  std::string
  ball(const double end, const double k, const double c)
  {
    const auto number = [](const double x) { return std::to_string(x); };
    return "set Analyses = dynamic\nsubsection Bodies\n subsection b\n set Type = rigid body\n set Mass = 1\n"
           " set Inertia = 1, 1, 1\n set Velocity = 1, 0, 0\n end\nend\n"
           "subsection Joints\n subsection j\n set Type = prismatic\n set Body A = ground\n set Body B = b\n"
           " set Axis = 1, 0, 0\n subsection displacement\n set Upper stop = 0.01\n set Lower stop = -0.02\n"
           " set Stop stiffness = " +
           number(k) + "\n set Stop damping = " + number(c) +
           "\n end\n end\nend\nsubsection Output\n set Probes = j.displacement\n set Pictures = false\nend\n"
           "subsection Dynamic\n set Step = 1e-4\n set Spectral radius = 1\n set End time = " +
           number(end) + "\nend\n";
  }

  std::vector<std::string>
  lines_of(const std::string &file)
  {
    std::ifstream            in(file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);)
      lines.push_back(line);
    return lines;
  }

  void
  run_into(Scene &scene, const std::string &folder, const bool restart = false)
  {
    scene.context.folder  = folder;
    scene.context.probes  = scene.input.make_probes();
    scene.context.restart = restart;
    scene.context.used    = scene.input.used();
    scene.analysis<DynamicAnalysis>().run(scene.context);
  }
} // namespace



// Onset after the free flight, half a period of contact with the depth v √(m/k), the flight back at the same speed.
TEST(Contacts, TimesAndDepths)
{
  const ScratchFolder folder;
  const double        k = 1e5, T = M_PI / std::sqrt(k), depth = 1 / std::sqrt(k);
  Scene               scene(ball(0.0598, k, 0));
  run_into(scene, folder.path);
  const auto &contacts = scene.analysis<DynamicAnalysis>().contacts.all();
  // the second contact is at 0.01 + T + 0.03 = 0.04993, over at 0.05987
  ASSERT_EQ(contacts.size(), 2u);
  EXPECT_NEAR(contacts[0].onset, 0.01, 1e-9);
  EXPECT_NEAR(contacts[0].release, 0.01 + T, 1e-6);
  EXPECT_NEAR(contacts[0].depth, depth, 1e-4 * depth);
  EXPECT_FALSE(contacts[0].is_touched);
  EXPECT_NEAR(contacts[1].onset, 0.04 + T, 1e-6);
  EXPECT_TRUE(contacts[1].is_touched);
  EXPECT_EQ(contacts[0].loss, 0.);
  const std::string upper = "joint j, upper stop of the displacement",
                    lower = "joint j, lower stop of the displacement";
  const auto rows         = lines_of(folder.path + "/dynamic_stops.csv");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0], "stop,onset [s],release [s],depth [m or rad],damper loss [J]");
  EXPECT_EQ(rows[1].find("\"" + upper + "\",0.0"), 0u) << rows[1];
  EXPECT_EQ(rows[2].find("\"" + lower + "\",0.0499"), 0u) << rows[2];
  EXPECT_NE(rows[2].find(",nan,"), std::string::npos) << "not left at the end: " << rows[2];
  EXPECT_NE(scene.analysis<DynamicAnalysis>().contacts.summary(scene.system.layout).find(upper + ": touched once"),
            std::string::npos);
}



// All losses of the energy account are those of contacts; a run that goes on has the table of one that does not stop.
TEST(Contacts, LossesAndRestart)
{
  const ScratchFolder folder;
  const std::string   whole = folder.path + "/whole", parts = folder.path + "/parts";
  const double        k = 1e5, c = 60;
  Scene               once(ball(0.2, k, c));
  run_into(once, whole);
  const auto &dynamic = once.analysis<DynamicAnalysis>();
  double      loss    = 0;
  for (const auto &contact : dynamic.contacts.all())
    {
      EXPECT_GT(contact.loss, 0.);
      loss += contact.loss;
    }
  EXPECT_GE(dynamic.contacts.all().size(), 3u);
  EXPECT_NEAR(loss, dynamic.budget.viscous, 1e-12);
  EXPECT_GT(loss, 0.1);

  Scene first(ball(0.0549, k, c)); // within the second contact
  first.analysis<DynamicAnalysis>().fresh_every = 100;
  run_into(first, parts);
  Scene second(ball(0.2, k, c));
  run_into(second, parts, true);
  const auto a = lines_of(whole + "/dynamic_stops.csv"), b = lines_of(parts + "/dynamic_stops.csv");
  ASSERT_EQ(a.size(), b.size());
  for (unsigned int i = 0; i < a.size(); ++i)
    EXPECT_EQ(a[i].substr(0, 60), b[i].substr(0, 60));
}



// A touch that begins and ends within a step, one that was there at the start, one that round-off ends.
TEST(Contacts, StepsInAllOrders)
{
  Contacts   contacts;
  StepResult step;
  step.touched_stops = {{0, 0.1, 1., true}, {1, 0.2, 2., false}};
  step.touches       = {{0, 0.5, false}, {0, 0.7, true}, {1, 0.3, true}, {1, 0.4, false}};
  contacts.add(step, 0, 1);
  StepResult none;
  contacts.add(none, 1, 2);
  const auto &all = contacts.all();
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].onset, 0.);
  EXPECT_EQ(all[0].release, 0.5);
  EXPECT_EQ(all[0].loss, 1.);
  EXPECT_EQ(all[1].onset, 0.7);
  EXPECT_EQ(all[1].release, 1.);
  EXPECT_EQ(all[2].onset, 0.3);
  EXPECT_EQ(all[2].depth, 0.2);
  Contacts again;
  again.set_numbers(contacts.to_numbers());
  EXPECT_EQ(again.to_numbers(), contacts.to_numbers());
}



// The shipped rotor that is braked: a rigid blade on its hinge droops by g/(Ω² (e + 2 L/3)), and meets its stop where
// that is 2 degrees; at rest the stop holds it with m g L/2, and its tip hangs lower than the hinge by the stop's and
// the beam's bending.
TEST(Contacts, DroopStop)
{
  Scene        scene("prm/rotorcraft/droop_stop.prm");
  const double e = 0.15, L = 3.85, g = 9.80665, droop = 2 * M_PI / 180, brake = 10, start = 25,
               speed = std::sqrt(g / (droop * (e + 2 * L / 3))), m = 4, moment = m * g * L * L / 2;
  double sum_moment = 0, sum_tip = 0, n = 0;
  auto  &dynamics   = scene.analysis<DynamicAnalysis>();
  dynamics.observer = [&](const State &state) {
    if (state.time < brake + 0.5)
      return;
    sum_moment += scene.input.model.probe("blade:flap.moment 3").value(state);
    sum_tip += scene.input.model.probe("blade.end.position z").value(state);
    ++n;
  };
  scene.equilibrium();
  dynamics.start(scene.context);
  dynamics.run(scene.context);
  const auto &touches = dynamics.contacts.all();
  ASSERT_EQ(touches.size(), 1u);
  EXPECT_NEAR(touches[0].onset, brake * (1 - speed / start), 0.05);
  EXPECT_NEAR(sum_moment / n / moment, 1, 0.02);
  const double sag = m * g * std::pow(L, 4) / (8 * 4e4) + m * g * L * L / 2 / 1e7;
  EXPECT_NEAR(sum_tip / n, -L * (droop + moment / 2e5) - sag, 2e-3);
  EXPECT_LT(std::abs(dynamics.budget.balance()),
            1e-9 * scene.context.system.energy(scene.context.state).kinetic + 1e-4);
}
