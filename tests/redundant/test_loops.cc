// Loops with redundant rows: driven, rolling, flexible, in statics and modes; contradictions; reactions that are not
// unique.

#include <samara/solvers/redundant_rows.h>
#include <samara/time/stage_integrator.h>

#include "run.h"

using namespace samara;

namespace
{
  std::string
  bar(const std::string &name, const Vector3 &from, const Vector3 &to, const std::string &entries = "")
  {
    const auto text = [](const Vector3 &v, const std::string &between) {
      std::ostringstream out;
      out.precision(17);
      out << v(0) << between << v(1) << between << v(2);
      return out.str();
    };
    return "subsection " + name +
           "\n set Type = rigid body\n set Mass = 1\n set Inertia = 1/12, 1/12, 1/12\n set Position = " +
           text(0.5 * (from + to), ", ") + "\n set Frames = a at " + text(from, " ") + ", b at " + text(to, " ") +
           "\n" + entries + "end\n";
  }

  std::string
  revolute(const std::string &name, const std::string &a, const std::string &b, const std::string &entries = "")
  {
    return "subsection " + name + "\n set Type = revolute\n set Body A = " + a + "\n set Body B = " + b + "\n" +
           entries + "end\n";
  }

  std::string
  driven(const std::string &motion)
  {
    return " subsection rotation\n set Prescribed = " + motion + "\n end\n";
  }

  const std::string weight =
    "subsection Loads\n subsection weight\n set Type = gravity\n set Acceleration = 0, -9.81, 0\n end\nend\n";

  /** Cranks at an angle to x, a coupler of 1 m; entries of the two feet. */
  std::string
  parallelogram(const double       angle,
                const std::string &foot    = "",
                const std::string &heel    = "",
                const std::string &crank   = "",
                const std::string &coupler = "",
                const std::string &step    = "0.01")
  {
    const Vector3 c(std::cos(angle), std::sin(angle), 0), x(1, 0, 0);
    return "set Analyses = dynamic\nsubsection Bodies\n" + bar("left", Vector3::Zero(), c, crank) +
           bar("right", x, x + c, crank) + bar("coupler", c, x + c, coupler) + "end\nsubsection Joints\n" +
           revolute("foot", "ground", "left.a", foot) + revolute("heel", "ground", "right.a", heel) +
           revolute("knee", "left.b", "coupler.a") + revolute("elbow", "coupler.b", "right.b") + "end\n" + weight +
           "subsection Dynamic\n set End time = 2\n set Step = " + step +
           "\n set Stages = 3\n set Spectral radius = 1\nend\n";
  }

  std::string
  bricard_on_springs()
  {
    std::ifstream     file(std::string(SAMARA_SOURCE_DIR) + "/prm/benchmarks/peers/bricard.prm");
    std::stringstream text;
    text << file.rdbuf();
    std::string model = text.str();
    for (const std::string joint : {"P0", "P2"})
      model.insert(model.find("  end", model.find("subsection " + joint + "\n")),
                   "    subsection rotation\n      set Spring = 40\n    end\n");
    return model;
  }



  ModelCheck
  redundancy(const Scene &scene)
  {
    ModelCheck check;
    find_redundant(scene.system, check);
    return check;
  }
} // namespace



// All bars lie in one line at the start: one more row is dependent there, and only there. θ'' 5/3 = −2 g cos θ.
TEST(Redundant, StartInASingularPosition)
{
  const Outcome run = run_motion(parallelogram(0,
                                               "",
                                               "",
                                               " set Velocity = 0, -1, 0\n set Angular velocity = 0, 0, -2\n",
                                               " set Velocity = 0, -2, 0\n"),
                                 "coupler",
                                 {});
  EXPECT_EQ(run.n_redundant, 3u);
  EXPECT_LT(run.gap, 1e-9);
  EXPECT_LT(run.balance, 1e-8);
  double       angle = 0, rate = -2;
  const double h = 1e-5;
  for (int i = 0; i < 200000; ++i)
    {
      // Störmer and Verlet
      rate -= 0.5 * h * 1.2 * 9.81 * std::cos(angle);
      angle += h * rate;
      rate -= 0.5 * h * 1.2 * 9.81 * std::cos(angle);
    }
  const Vector3 expected(0.5 + std::cos(angle), std::sin(angle), 0);
  EXPECT_LT((run.places.at(2000) - expected).norm(), 1e-6) << run.places.at(2000).transpose();
}



TEST(Redundant, EveryFirstChoiceWillDo)
{
  Scene         scene("prm/benchmarks/peers/bricard.prm",
              {"Joints/P5/Type = revolute", "Dynamic/End time = 3", "Dynamic/Stages = 2"});
  RedundantRows rows(scene.system);
  State         start = scene.system.reference();
  ASSERT_EQ(start.left_out.size(), 1u);
  rows.find(start);
  const Eigen::MatrixXd X         = redundancy(scene).combinations;
  auto                 &dynamic   = scene.analysis<DynamicAnalysis>();
  double                gap       = 0;
  unsigned int          n_choices = 0;
  dynamic.observer                = [&](const State &state) { gap = std::max(gap, gap_of(scene.system, state)); };
  for (unsigned int i = 0; i < scene.system.layout.n_multipliers; i += 2)
    if (std::abs(X(i, 0)) > 1e-3 * X.cwiseAbs().maxCoeff())
      {
        scene.context.state          = start;
        scene.context.state.left_out = {i};
        dynamic.run(scene.context);
        EXPECT_EQ(dynamic.report.n_failed, 0u) << i;
        EXPECT_LT(dynamic.report.largest_balance, 1e-8) << i;
        ++n_choices;
      }
  EXPECT_GT(n_choices, 5u);
  EXPECT_LT(gap, 1e-9);
}



// Both cranks are driven, alike: the second drive is redundant, too. The coupler goes round as prescribed.
TEST(Redundant, TwoDrivesAlike)
{
  const std::string drive = driven("t^2");
  const Outcome     run   = run_motion(parallelogram(0.5 * M_PI, drive, drive), "coupler", {});
  EXPECT_EQ(run.n_redundant, 4u);
  EXPECT_LT(run.gap, 1e-9);
  const double angle = 0.5 * M_PI + 4;
  EXPECT_LT((run.places.at(2000) - Vector3(0.5 + std::cos(angle), std::sin(angle), 0)).norm(), 1e-7);
}



TEST(Redundant, TwoDrivesThatContradictEachOther)
{
  const Scene scene(parallelogram(0.5 * M_PI, driven("t^2"), driven("2*t^2")));
  const auto  check = redundancy(scene);
  ASSERT_EQ(check.contradictions.size(), 1u);
  EXPECT_NE(check.contradictions[0].find("prescribed rotation); joint heel ("), std::string::npos)
    << check.contradictions[0];
  EXPECT_NE(check.complaint().find(".prm:"), std::string::npos) << check.complaint();
  // what begins to contradict later ends the run
  const std::string later = "(t < 0.5 ? t : 2*t - 0.5)";
  try
    {
      run_motion(parallelogram(0.5 * M_PI, driven("t"), driven(later)), "coupler", {});
      FAIL() << "the contradiction was not seen";
    }
  catch (const NotConverged &problem)
    {
      EXPECT_NE(std::string(problem.what()).find("contradict each other"), std::string::npos) << problem.what();
    }
}



// A drive that has no part in the loop contradicts nothing, round-off or not.
TEST(Redundant, ADriveElsewhereContradictsNothing)
{
  std::string text = parallelogram(0.3 * M_PI);
  text.insert(text.find("end\nsubsection Joints"),
              bar("arm", Vector3(std::cos(0.3 * M_PI), std::sin(0.3 * M_PI), 0), Vector3(0.9, 1.3, 0)));
  text.insert(text.find("end\nsubsection Loads"),
              revolute("again", "ground", "left.a") + revolute("shoulder", "left.b", "arm.a", driven("0.3*sin(2*t)")));
  Scene scene(text);
  EXPECT_EQ(redundancy(scene).redundant_multipliers.size(), 8u);
  EXPECT_TRUE(redundancy(scene).contradictions.empty());
}



// A ball rolls between the floor and a lid that a planar joint holds: its distance to both is said once too often. It
// rolls half as fast as the lid: (M + m/4 + J/(4 r²)) a = M g + m g/2, g along x.
TEST(Redundant, BallBetweenFloorAndLid)
{
  const Outcome run = run_motion(
    "set Analyses = dynamic\nsubsection Bodies\n"
    "subsection lid\n set Type = rigid body\n set Mass = 2\n set Inertia = 1, 1, 1\n set Position = 0, 0, 0.6\n end\n"
    "subsection ball\n set Type = rigid body\n set Mass = 3\n set Inertia = 0.1, 0.1, 0.1\n set Position = 0, 0, 0.3\n end\n"
    "end\nsubsection Joints\n"
    "subsection guide\n set Type = planar\n set Body A = ground\n set Body B = lid.centre\n set Axis 1 = 1, 0, 0\n set Axis = 0, 0, 1\n end\n"
    "subsection floor\n set Type = rolling ball\n set Body A = ground\n set Body B = ball.centre\n set Radius = 0.3\n end\n"
    "subsection top\n set Type = rolling ball\n set Body A = lid.centre\n set Body B = ball.centre\n set Radius = 0.3\n set Axis = 0, 0, -1\n end\n"
    "end\nsubsection Loads\n subsection pull\n set Type = gravity\n set Acceleration = 2, 0, 0\n end\nend\n"
    "subsection Dynamic\n set End time = 1\n set Step = 0.02\n set Stages = 2\n end\n",
    "lid",
    {});
  EXPECT_EQ(run.n_redundant, 1u);
  EXPECT_LT(run.gap, 1e-9);
  const double acceleration = (2 * 2. + 3 * 1.) / (2 + 3 / 4. + 0.1 / (4 * 0.09));
  EXPECT_NEAR(run.places.at(1000)(0), 0.5 * acceleration, 1e-6);
}



// A spring at the ground: equilibrium and mode are those of the mechanism with a cylindrical joint.
// three rows of each loop, and no joint loses more than two: factors are as sparse as those of the plane model
TEST(Redundant, RowsLeftOutAreSpreadOverTheLoop)
{
  const Scene scene("prm/benchmarks/dynamics/four_bar.prm", {"Joints/B1/Type = revolute", "Joints/B2/Type = revolute"});
  std::map<std::string, unsigned int> n_left_out;
  for (const auto i : scene.context.state.left_out)
    ++n_left_out[scene.system.layout.owner_of_multiplier(i).title()];
  EXPECT_EQ(scene.context.state.left_out.size(), 6U);
  for (const auto &[joint, n] : n_left_out)
    EXPECT_LE(n, 2U) << joint;
}



TEST(Redundant, CombinationsThatChangeLittleAreSeldomLookedAt)
{
  const Scene     scene(parallelogram(1));
  StageIntegrator integrator(scene.system, Tableau(2, 1.));
  State           state  = scene.context.state;
  double          turned = 0;
  for (unsigned int i = 0; i < 200; ++i)
    {
      const Matrix3 before = state.triad(1);
      ASSERT_TRUE(integrator.step(state, 0.01).converged);
      turned += (state.triad(1) - before).norm() / std::sqrt(2.);
    }
  EXPECT_GT(turned, 3);
  EXPECT_LT(integrator.n_checks(), turned / 0.15);
}



TEST(Redundant, StaticsAndModesOfBricard)
{
  std::vector<double> heights, frequencies, forces;
  for (const std::string joint : {"revolute", "cylindrical"})
    {
      Scene scene(bricard_on_springs(), {"Joints/P5/Type = " + joint});
      EXPECT_EQ(scene.context.state.left_out.size(), joint == "revolute" ? 1u : 0u);
      const State &state = scene.equilibrium();
      EXPECT_LT(gap_of(scene.system, state), 1e-10);
      heights.push_back(scene.value("bar 3.end.displacement y"));
      frequencies.push_back(scene.modes().at(0).frequency());
    }
  EXPECT_GT(std::abs(heights[1]), 0.01);
  EXPECT_NEAR(heights[0], heights[1], 1e-9);
  EXPECT_NEAR(frequencies[0], frequencies[1], 1e-8 * frequencies[1]);
}



// Reactions normal to the plane are not unique, those in it are. Those of least norm are in equilibrium, and not
// longer.
TEST(Redundant, ReactionsOfLeastNorm)
{
  Scene              scene(parallelogram(0.4 * M_PI, " subsection rotation\n set Spring = 30\n end\n"),
              {"Loads/weight/Acceleration = 0, -9.81, 3"});
  State              state = scene.equilibrium();
  auto               check = redundancy(scene);
  std::vector<Probe> probes;
  for (const std::string name : {"foot.force 1", "foot.force 3", "heel.moment 1", "coupler.position x"})
    probes.push_back(scene.input.model.probe(name));
  EXPECT_TRUE(check.mark(probes));
  EXPECT_EQ(probes[0].unit, "N");
  EXPECT_EQ(probes[1].unit, "N, not unique");
  EXPECT_EQ(probes[2].unit, "N m, not unique");
  EXPECT_EQ(probes[3].unit, "m");

  const auto in_equilibrium = [&](const State &at) {
    State all = at;
    all.left_out.clear();
    std::vector<double> stress, r;
    scene.system.stresses(all, stress);
    scene.system.residual(all, stress, r);
    double largest = 0;
    for (unsigned int i = 0; i < scene.system.size(); ++i)
      largest = std::max(largest, std::abs(r[i]));
    return largest;
  };
  State least = state;
  RedundantRows(scene.system).make_least(least);
  EXPECT_LT(in_equilibrium(state), 1e-8);
  EXPECT_LT(in_equilibrium(least), 1e-8);
  // in the units of the rows: N, and N m divided by the size of the model
  const auto norm = [](const State &at) {
    return Eigen::Map<const Eigen::VectorXd>(at.multipliers.data(), at.multipliers.size()).norm();
  };
  EXPECT_LT(norm(least), 0.999 * norm(state));
}
