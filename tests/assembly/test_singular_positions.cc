// Singular positions on the way are recognised, however long the steps: when, and by which joints.

#include <samara/analysis/dynamic.h>
#include <samara/analysis/near_redundancy.h>

#include <gtest/gtest.h>

#include "drawings.h"

using namespace samara;
using namespace drawings;

namespace
{
  /** A parallelogram of bars of length 1 on a base of length 1, its crank at an angle of 60 degrees, turning with @p
   * speed. */
  std::string
  parallelogram(const std::string &last, const double rocker, const std::string &speed)
  {
    const double c = 0.5, s = std::sqrt(0.75);
    return "set Analyses = dynamic\nsubsection Bodies\n" + bar("crank", "foot", {0, 0, 0}, "end", {c, s, 0}) +
           bar("coupler", "start", {c, s, 0}, "end", {1 + c, s, 0}) +
           bar("rocker", "foot", {1, 0, 0}, "end", {1 + rocker * c, rocker * s, 0}) + "end\nsubsection Joints\n" +
           joint(
             "A", "revolute", "ground", "crank.foot", " subsection rotation\n set Prescribed = " + speed + "\n end\n") +
           joint("B", "revolute", "crank.end", "coupler.start") + joint("C", last, "coupler.end", "rocker.end") +
           joint("D", "revolute", "ground", "rocker.foot") +
           "end\nsubsection Dynamic\n set End time = 1\n set Step = 0.0173\nend\n";
  }

  /** What passes zero in the course of a motion that is given, not computed. */
  std::vector<SingularPositions::Passing>
  passings_of(Scene &scene, const std::function<State(double)> &at, const double step)
  {
    SingularPositions singular(scene.system);
    for (double t = 0; t < 1; t += step)
      singular.look(at(t));
    return singular.passings;
  }

  /** All bodies of the parallelogram at the crank's angle @p a. */
  State
  at_angle(const Scene &scene, const double a, const double t)
  {
    State      state = scene.system.reference();
    const auto place = [&](const unsigned int node, const Vector3 &x, const double turn) {
      Eigen::Map<Vector3>(&state.q[12 * node])     = x;
      Eigen::Map<Matrix3>(&state.q[12 * node + 3]) = Eigen::AngleAxisd(turn, Vector3::UnitZ()).toRotationMatrix();
    };
    const Vector3 half = 0.5 * Vector3(std::cos(a), std::sin(a), 0);
    place(1, half, a - M_PI / 3);
    place(2, 2 * half + Vector3(0.5, 0, 0), 0);
    place(3, half + Vector3(1, 0, 0), a - M_PI / 3);
    state.coordinates.assign(state.coordinates.size(), a - M_PI / 3);
    state.time = t;
    return state;
  }
} // namespace



// All bars are in one line where the crank is at 180 and at 360 degrees: with its angle given the coupler may turn
// either way.
TEST(SingularPositions, TimesOfAParallelogram)
{
  for (const double step : {1e-3, 0.011, 0.03})
    {
      Scene scene(parallelogram("spherical", 1, "7*t"));
      scene.context.state = scene.system.reference();
      const auto left_out = scene.without_redundant().left_out;
      const auto passings = passings_of(
        scene,
        [&](const double t) {
          State state    = at_angle(scene, M_PI / 3 + 7 * t, t);
          state.left_out = left_out;
          return state;
        },
        step);
      ASSERT_EQ(passings.size(), 2u) << step;
      EXPECT_NEAR(passings[0].time, (M_PI - M_PI / 3) / 7, 2e-3);
      EXPECT_NEAR(passings[1].time, (2 * M_PI - M_PI / 3) / 7, 2e-3);
      for (const std::string joint : {"joint B", "joint C", "joint D"})
        EXPECT_NE(passings[0].joints.find(joint), std::string::npos) << passings[0].joints;
    }
}



// Seen in a run, and said there.
TEST(SingularPositions, ToldByARun)
{
  Scene scene("prm/benchmarks/dynamics/four_bar.prm", {"Dynamic/End time = 3", "Dynamic/Step = 0.01"});
  auto &dynamics = scene.analysis<DynamicAnalysis>();
  dynamics.start(scene.context);
  dynamics.run(scene.context);
  const std::string said = scene.stream.str();
  EXPECT_NE(said.find("singular positions are passed"), std::string::npos) << said;
}



// Nothing passes where nothing moves.
TEST(SingularPositions, NoneAtRest)
{
  const std::string fine = four_bar(Bars{1, 0.7, 0, true}, 0.5, "set Gaps = closed");
  Scene             scene(fine);
  SingularPositions singular(scene.system);
  State             state = scene.without_redundant();
  for (unsigned int i = 0; i < 20; ++i)
    {
      state.time = i;
      singular.look(state);
    }
  EXPECT_TRUE(singular.passings.empty());
  EXPECT_EQ(singular.text(), "");
}
