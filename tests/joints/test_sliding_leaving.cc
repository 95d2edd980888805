// What slides along a beam and leaves it at its end: flights against closed forms, momenta and energy, and what is
// refused.

#include <samara/analysis/dynamic.h>

#include "../momentum.h"
#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  const std::string slender = "subsection Sections\n subsection s\n set Type = engineering constants\n set EA = 400\n"
                              " set GA2 = 400\n set GA3 = 400\n set GJ = 8\n set EI2 = 8\n set EI3 = 8\n set Mass = 1\n"
                              " set I2 = 0.01\n set I3 = 0.01\n end\nend\n";

  /** A rod of 1 m on a hinge, and a bead of 0.5 kg at 0.2 m on it; what is said of the rod, the hinge, the slider and
   * its displacement, and how it moves. */
  struct Launcher
  {
    std::string  rod = " set Rigid = true\n set Elements = 1\n", turning = " set Prescribed = 3*t\n";
    std::string  kind = "point", slider, displacement, bead = " set Velocity = 0, 0.6, 0\n", rest, place = "0.2, 0, 0";
    double       end = 1, step = 0.1;
    unsigned int stages = 3;

    std::string
    text() const
    {
      return slender + "subsection Bodies\n subsection rod\n set Type = beam\n set Section = s\n" +
             " set Points = 0, 0, 0; 1, 0, 0\n" + rod +
             " end\n subsection bead\n set Type = rigid body\n set Mass = 0.5\n set Inertia = 0.1, 0.1, 0.1\n"
             " set Position = " +
             place + "\n" + bead + " end\nend\nsubsection Joints\n" +
             (turning.empty() ?
                "" :
                " subsection hinge\n set Type = revolute\n set Body A = ground\n set Body B = rod.start\n"
                " set Axis = 0, 0, 1\n subsection rotation\n" +
                  turning + " end\n end\n") +
             " subsection slide\n set Type = sliding " + kind +
             "\n set Body A = rod\n set Body B = bead\n set At the ends = leave\n" + slider +
             " subsection displacement\n" + displacement + " end\n end\n" + rest + "end\nset Analyses = dynamic\n" +
             "subsection Dynamic\n set End time = " + number_to_text(end) + "\n set Step = " + number_to_text(step) +
             "\n set Stages = " + std::to_string(stages) +
             "\n set Spectral radius = 1\n set Newton tolerance = 1e-12\nend\n";
    }

    std::unique_ptr<Scene>
    fly() const
    {
      auto  scene    = std::make_unique<Scene>(text());
      auto &analysis = scene->analysis<DynamicAnalysis>();
      analysis.start(scene->context);
      analysis.run(scene->context);
      return scene;
    }
  };

  Vector3
  place_of_bead(const Scene &scene)
  {
    return {scene.value("bead.position x"), scene.value("bead.position y"), scene.value("bead.position z")};
  }

  void
  expect_to_refuse(const Launcher &launcher, const std::string &because)
  {
    try
      {
        Scene scene(launcher.text());
        FAIL() << because;
      }
    catch (const std::exception &problem)
      {
        EXPECT_NE(std::string(problem.what()).find(because), std::string::npos) << problem.what();
      }
  }
} // namespace



// r = r₀ cosh Ωt on a rod that turns with Ω, until it is as far out as the rod is long; from there on straight, with
// the velocities that it has along and across the rod.
TEST(Leaving, BeadFliesOffATurningRod)
{
  const double  Omega = 3, r = 0.2, T = 1, t = std::acosh(1 / r) / Omega, v = r * Omega * std::sinh(Omega * t);
  const Vector3 along(std::cos(Omega * t), std::sin(Omega * t), 0), across(-along(1), along(0), 0);
  const Vector3 exact = along + (T - t) * (v * along + Omega * across);
  for (const unsigned int s : {1, 2, 3})
    {
      std::vector<double> errors;
      for (const double h : {0.1, 0.05})
        {
          Launcher launcher;
          launcher.end     = T;
          launcher.step    = h;
          launcher.stages  = s;
          const auto scene = launcher.fly();
          errors.push_back((place_of_bead(*scene) - exact).norm());
          EXPECT_EQ(scene->value("slide.attached"), 0);
          EXPECT_EQ(scene->value("slide.arc length"), 1);
          EXPECT_EQ(scene->value("slide.displacement rate"), 0);
          EXPECT_EQ(scene->value("slide.force"), 0);
          EXPECT_LT(scene->analysis<DynamicAnalysis>().report.largest_balance, 1e-11);
        }
      EXPECT_LT(errors[1], s == 1 ? 1e-2 : s == 2 ? 3e-5 : 1e-8) << s << " stages";
      EXPECT_GT(std::log2(errors[0] / errors[1]), 2. * s - 0.5) << s << " stages: " << errors[0];
    }
}



// A soft rod and a sleeve on it, both free in space: momentum and moment of momentum stay, across ends of elements and
// the end of the rod; what is told of the sleeve is that it has left at the start of the rod.
TEST(Leaving, MomentaOfWhatIsFree)
{
  Launcher launcher;
  launcher.rod     = " set Elements = 3\n set Degree = 2\n set Angular velocity = 0, 0, 2\n";
  launcher.turning = "";
  launcher.kind    = "sleeve";
  launcher.bead    = " set Velocity = -0.8, 0.4, 0\n set Angular velocity = 1, 0, 2\n";
  launcher.end     = 0.8;
  launcher.step    = 0.01;
  Scene scene(launcher.text());
  auto &analysis = scene.analysis<DynamicAnalysis>();
  analysis.start(scene.context);
  Vector6      first    = Vector6::Zero();
  unsigned int n_on_rod = 0, n_free = 0;
  double       worst = 0;
  analysis.observer  = [&](const State &state) {
    if (n_on_rod == 0)
      first = momentum_of(scene.system, state);
    ++(scene.input.model.probe("slide.attached").value(state) > 0 ? n_on_rod : n_free);
    worst = std::max(worst, (momentum_of(scene.system, state) - first).norm() / first.norm());
  };
  analysis.run(scene.context);
  EXPECT_GT(n_on_rod, 15u);
  EXPECT_GT(n_free, 15u);
  EXPECT_LT(worst, 1e-6); // of the scheme, which turns with the nodes
  EXPECT_EQ(scene.value("slide.arc length"), 0);
  EXPECT_LT(analysis.report.largest_balance, 1e-10);
}



// The example, a flexible boom, is near the rigid one, and its energy account closes.
TEST(Leaving, Example)
{
  Scene scene("prm/examples/leaving.prm");
  auto &analysis = scene.analysis<DynamicAnalysis>();
  analysis.start(scene.context);
  analysis.run(scene.context);
  EXPECT_EQ(scene.value("slider.attached"), 0);
  const double  Omega = 3, t = std::acosh(5) / Omega, v = 0.2 * Omega * std::sinh(Omega * t);
  const Vector3 along(std::cos(Omega * t), std::sin(Omega * t), 0), across(-along(1), along(0), 0);
  EXPECT_LT((place_of_bead(scene) - along - (1 - t) * (v * along + Omega * across)).norm(), 0.02);
  EXPECT_LT(analysis.report.largest_balance, 1e-8);
  EXPECT_NE(scene.stream.str().find("<bead> has left <boom>"), std::string::npos);
}



// Pushed out by a drive on a turning rod, with its axes held: at 0.4 s it lets go of all of them, flies straight and
// goes on turning with Ω. What the drive has done is the energy that the bead has then.
TEST(Leaving, PrescribedSlidingEnds)
{
  Launcher launcher;
  launcher.kind         = "prismatic";
  launcher.displacement = " set Prescribed = 2*t\n";
  launcher.bead         = " set Velocity = 2, 0.6, 0\n set Angular velocity = 0, 0, 3\n";
  launcher.end          = 0.7;
  launcher.step         = 0.03; // no step would end there
  const auto    scene   = launcher.fly();
  const double  t = 0.4, T = 0.7, Omega = 3;
  const Vector3 along(std::cos(Omega * t), std::sin(Omega * t), 0), across(-along(1), along(0), 0);
  EXPECT_LT((place_of_bead(*scene) - (along + (T - t) * (2 * along + Omega * across))).norm(), 1e-8);
  EXPECT_NEAR(scene->value("bead.rotation z") * M_PI / 180, Omega * T, 1e-8);
  EXPECT_NEAR(scene->value("slide.displacement"), 0.8, 1e-15);
  const auto &analysis = scene->analysis<DynamicAnalysis>();
  EXPECT_NEAR(analysis.budget.drives, 0.5 * 0.5 * Omega * Omega * (1 - 0.04), 1e-8);
  EXPECT_LT(analysis.report.largest_balance, 1e-10);
}



// A bead that rests at the end of the rod leaves when that begins to turn, at once; a stop at the start keeps another
// one, which comes back from it and leaves at the other end.
TEST(Leaving, FromTheEndAndFromAStop)
{
  Launcher at_end;
  at_end.place      = "1, 0, 0";
  at_end.bead       = "";
  at_end.turning    = " set Prescribed = t^2\n";
  at_end.end        = 0.5;
  const auto thrown = at_end.fly();
  EXPECT_EQ(thrown->value("slide.attached"), 0);
  EXPECT_LT((place_of_bead(*thrown) - Vector3::UnitX()).norm(), 1e-12);

  Launcher stopped;
  stopped.turning      = " set Prescribed = 0*t\n";
  stopped.bead         = " set Velocity = -2, 0, 0\n";
  stopped.displacement = " set Lower stop = -0.1\n set Stop stiffness = 1e5\n";
  stopped.step         = 1e-3;
  const auto scene     = stopped.fly();
  // half a period of the stop, π √(m/k)
  EXPECT_NEAR(place_of_bead(*scene)(0), 0.1 + 2 * (1 - 0.05 - M_PI * std::sqrt(0.5 / 1e5)), 1e-3);
  EXPECT_EQ(scene->value("slide.attached"), 0);
  EXPECT_EQ(scene->value("slide.arc length"), 1);
}



// A law that pulls by how far the bead has slid knows that it has left, not where the unknown is kept.
TEST(Leaving, LawsSeeWhereItLeft)
{
  Launcher launcher;
  launcher.rest = " subsection tower\n set Type = revolute\n set Body A = ground\n set Body B = wheel\n"
                  " subsection rotation\n set Moment = slide.displacement\n end\n end\n";
  launcher.bead += " end\n subsection wheel\n set Type = rigid body\n set Mass = 1\n set Inertia = 1, 1, 1\n";
  launcher.turning = " set Prescribed = 0*t\n";
  launcher.bead    = " set Velocity = 4, 0, 0\n" + launcher.bead.substr(launcher.bead.find(" end"));
  launcher.step    = 0.01;
  const auto scene = launcher.fly();
  // α = 4 t until 0.2 s, 0.8 from there on: ω = 0.08 + 0.8 · 0.8
  EXPECT_NEAR(scene->value("tower.rotation rate"), 0.72, 1e-9);
}



TEST(Leaving, IsRefused)
{
  Launcher sprung;
  sprung.displacement = " set Spring = 10\n";
  expect_to_refuse(sprung, "would hold what has left it");

  Launcher enclosed;
  enclosed.displacement = " set Lower stop = -0.1\n set Upper stop = 0.5\n set Stop stiffness = 1e5\n";
  expect_to_refuse(enclosed, "nothing leaves");

  Launcher stuck;
  stuck.displacement = " set Friction = 0.1\n set Friction preload = 10\n set Bristle stiffness = 1e5\n";
  expect_to_refuse(stuck, "bristles keep what they have stored");

  Launcher buffered;
  buffered.rest = " subsection between\n set Type = buffer\n set Joint A = slide\n set Joint B = slide\n"
                  " set Stiffness = 1e5\n end\n";
  expect_to_refuse(buffered, "a buffer would go on holding it");
}
