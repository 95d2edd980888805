// Loops whose places and axes are rounded: those that nearly close move, and say by how much they do not; those that do
// not are named. And what is found of many combinations at once.

#include <samara/analysis/near_redundancy.h>
#include <samara/solvers/redundant_rows.h>

#include "run.h"

using namespace samara;

namespace
{
  /** A four-bar linkage of revolutes, one axis of which is turned by @p error [rad] about the first. */
  std::string
  four_bar(const double error, const double angle = 1)
  {
    const Vector3      foot(0, 0, 0), heel(1.2, 0, 0), knee(std::cos(angle), std::sin(angle), 0);
    const Vector3      to = heel - knee, along = to.normalized();
    const double       base = 1.3 * 1.3 - 0.9 * 0.9 + to.squaredNorm(), a = base / (2 * to.norm());
    const Vector3      elbow = knee + a * along + std::sqrt(1.3 * 1.3 - a * a) * Vector3(-along(1), along(0), 0);
    std::ostringstream text;
    text.precision(17);
    const auto bar = [&](const char *name, const Vector3 &from, const Vector3 &end) {
      const Vector3 middle = 0.5 * (from + end);
      text << "subsection " << name << "\n set Type = rigid body\n set Mass = 1\n set Inertia = 0.1, 0.1, 0.1\n"
           << " set Position = " << middle(0) << ", " << middle(1) << ", " << middle(2) << "\nend\n";
    };
    const auto hinge = [&](const char *name, const char *A, const char *B, const Vector3 &at, const double tilt) {
      text << "subsection " << name << "\n set Type = revolute\n set Body A = " << A << "\n set Body B = " << B
           << "\n set Position = " << at(0) << ", " << at(1) << ", 0\n set Axis = " << std::sin(tilt) << ", 0, "
           << std::cos(tilt) << "\nend\n";
    };
    text << "set Analyses = dynamic\nsubsection Bodies\n";
    bar("crank", foot, knee);
    bar("coupler", knee, elbow);
    bar("rocker", elbow, heel);
    text << "end\nsubsection Joints\n";
    hinge("foot", "ground", "crank", foot, 0);
    hinge("knee", "crank", "coupler", knee, error);
    hinge("elbow", "coupler", "rocker", elbow, 0);
    hinge("heel", "rocker", "ground", heel, 0);
    text
      << "end\nsubsection Loads\n subsection weight\n set Type = gravity\n set Acceleration = 0, -9.81, 0\n end\nend\n"
      << "subsection Dynamic\n set End time = 1\n set Step = 0.01\n set Stages = 2\nend\n";
    return text.str();
  }

  /** A parallelogram whose coupler is a beam: only if that were rigid, constraints would repeat each other. */
  const std::string flexible =
    "set Analyses = dynamic\nsubsection Sections\nsubsection s\n set Type = tube\n set E = 7e10\n set Density = 2700\n"
    " set Outer radius = 0.02\nend\nend\nsubsection Bodies\n"
    "subsection left\n set Type = rigid body\n set Mass = 1\n set Inertia = 0.1, 0.1, 0.1\n set Position = 0.25, 0.4, 0\nend\n"
    "subsection right\n set Type = rigid body\n set Mass = 1\n set Inertia = 0.1, 0.1, 0.1\n set Position = 1.25, 0.4, 0\nend\n"
    "subsection beam\n set Type = beam\n set Points = 0.5, 0.8, 0; 1.5, 0.8, 0\n set Section = s\n set Elements = 4\nend\n"
    "end\nsubsection Joints\n"
    "subsection foot\n set Type = revolute\n set Body A = ground\n set Body B = left\n set Position = 0, 0, 0\nend\n"
    "subsection heel\n set Type = revolute\n set Body A = ground\n set Body B = right\n set Position = 1, 0, 0\nend\n"
    "subsection knee\n set Type = revolute\n set Body A = left\n set Body B = beam.start\n set Position = 0.5, 0.8, 0\nend\n"
    "subsection elbow\n set Type = revolute\n set Body A = beam.end\n set Body B = right\n set Position = 1.5, 0.8, 0\nend\n"
    "end\nsubsection Loads\n subsection weight\n set Type = gravity\n set Acceleration = 0, -9.81, 0\n end\nend\n"
    "subsection Dynamic\n set End time = 0.5\n set Step = 0.01\n set Stages = 2\nend\n";

  std::string
  near(const std::string &model)
  {
    const Scene scene(model);
    return nearly_redundant_text(scene.system, scene.system.dropped_multipliers());
  }
} // namespace



TEST(Rounded, ALittleMovesAsIfItWereNot)
{
  const Outcome exact = run_motion(four_bar(0), "coupler", {}), rounded = run_motion(four_bar(3e-6), "coupler", {});
  EXPECT_EQ(exact.n_redundant, 3u);
  EXPECT_EQ(rounded.n_redundant, 3u);
  EXPECT_LT(rounded.error(exact), 1e-4);
  EXPECT_GT(rounded.gap, 1e-8);
  EXPECT_LT(rounded.gap, 1e-5);
  EXPECT_NE(rounded.log.find("violated by up to"), std::string::npos) << rounded.log;
  EXPECT_EQ(exact.log.find("violated by up to"), std::string::npos) << exact.log;
  EXPECT_EQ(near(four_bar(0)), "");
  EXPECT_EQ(near(four_bar(3e-6)), "");
}



TEST(Rounded, MoreIsAStructureAndNamed)
{
  const std::string text = near(four_bar(2e-4));
  EXPECT_NE(text.find("nearly say"), std::string::npos) << text;
  for (const std::string joint : {"joint foot", "joint knee", "joint elbow", "joint heel"})
    EXPECT_NE(text.find(joint), std::string::npos) << text;
}



// All bars nearly in line: rows are nearly dependent there, and no more a little further on.
TEST(Rounded, NearASingularPositionNothingIsSaid)
{
  EXPECT_EQ(near("prm/benchmarks/dynamics/four_bar.prm"), "");
  EXPECT_EQ(near("prm/benchmarks/peers/bricard.prm"), "");
  for (const double angle : {1e-2, 1e-3, 1e-4, 1e-5, 0.})
    {
      const double       c = std::cos(angle), s = std::sin(angle);
      std::ostringstream text;
      text.precision(17);
      const auto bar = [&](const char *name, const double x, const double y) {
        text << "subsection " << name << "\n set Type = rigid body\n set Mass = 1\n set Inertia = 0.1, 0.1, 0.1\n"
             << " set Position = " << x << ", " << y << ", 0\nend\n";
      };
      const auto joint = [&](const char *name, const char *type, const char *A, const char *B, double x, double y) {
        text << "subsection " << name << "\n set Type = " << type << "\n set Body A = " << A << "\n set Body B = " << B
             << "\n set Position = " << x << ", " << y << ", 0\nend\n";
      };
      text << "subsection Bodies\n";
      bar("left", c / 2, s / 2);
      bar("right", 1 + c / 2, s / 2);
      bar("coupler", 0.5 + c, s);
      text << "end\nsubsection Joints\n";
      joint("foot", "revolute", "ground", "left", 0, 0);
      joint("heel", "revolute", "ground", "right", 1, 0);
      joint("knee", "cylindrical", "left", "coupler", c, s);
      joint("elbow", "spherical", "coupler", "right", 1 + c, s);
      text << "end\n";
      EXPECT_EQ(near(text.str()), "") << angle;
    }
}



// Combinations that share no row are found by one solution.
TEST(Rounded, CombinationsAtOnceAreThoseOneByOne)
{
  Scene scene(
    "prm/benchmarks/dynamics/four_bar.prm",
    {"Joints/B1/Type = revolute", "Joints/B2/Type = revolute", "Dynamic/End time = 1.2", "Dynamic/Step = 0.02"});
  RedundantRows rows(scene.system);
  auto         &dynamic = scene.analysis<DynamicAnalysis>();
  unsigned int  n       = 0;
  dynamic.observer      = [&](const State &state) {
    RedundantRows         alone(scene.system);
    const Eigen::MatrixXd X = alone.combinations(state), Y = rows.combinations(state);
    ASSERT_EQ(X.cols(), 6);
    EXPECT_LT((X - Y).cwiseAbs().maxCoeff(), 1e-6 * X.cwiseAbs().maxCoeff()) << state.time;
    ++n;
  };
  dynamic.start(scene.context);
  dynamic.run(scene.context);
  EXPECT_GT(n, 30u);
}



TEST(FlexibleLoop, HasNoRedundantRowsAndOneFreeMotion)
{
  const Scene      scene(flexible);
  const ModelCheck check = check_model(scene.system);
  EXPECT_TRUE(check.redundant_multipliers.empty());
  ASSERT_EQ(check.n_free_motions, 1u);
  EXPECT_NE(check.free_motions[0].find("foot rotation"), std::string::npos) << check.free_motions[0];
  EXPECT_EQ(near(flexible), "");
  const Outcome run = run_motion(flexible, "right", {});
  EXPECT_LT(run.gap, 1e-9);
  EXPECT_LT(run.balance, 1e-8);
  EXPECT_EQ(run.n_failed, 0u);
}
