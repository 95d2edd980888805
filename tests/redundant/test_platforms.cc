// Constraints that repeat each other in some positions only: a platform that hangs on equal parallel rods. As long as
// it swings without turning, three rods say all. When it turns while it swings, others say more, of second or higher
// order: rigid rods do not tell what happens then, and the run is refused by name. Loops that are only rounded go on.

#include <samara/base/errors.h>

#include "run.h"

using namespace samara;

namespace
{
  /**
   * Rods of 1 m, one at each place (x, y) of the platform, hung from above; ends at the ground are wrong by up to
   * @p error [m].
   */
  std::string
  platform(const std::vector<Vector3> &places,
           const std::string          &velocity,
           const std::string          &spin,
           const std::string          &stages,
           const double                error = 0)
  {
    std::ostringstream text;
    text.precision(17);
    text << "set Analyses = dynamic\nsubsection Bodies\nsubsection platform\n set Type = rigid body\n set Mass = 1\n"
         << " set Inertia = 0.1, 0.1, 0.2\n set Velocity = " << velocity << "\n set Angular velocity = " << spin
         << "\n set Frames = ";
    for (unsigned int i = 0; i < places.size(); ++i)
      text << (i > 0 ? ", " : "") << "corner" << i << " at " << places[i](0) << ' ' << places[i](1) << " 0";
    text << "\nend\nend\nsubsection Joints\n";
    for (unsigned int i = 0; i < places.size(); ++i)
      text << "subsection rod" << i << "\n set Type = distance\n set Body A = ground\n set Body B = platform.corner"
           << i << "\n set Position = " << places[i](0) + error * std::sin(1 + 3 * i) << ", "
           << places[i](1) + error * std::sin(2 + 5 * i) << ", " << 1 + error * std::sin(3 + 7 * i) << "\nend\n";
    text
      << "end\nsubsection Loads\n subsection weight\n set Type = gravity\n set Acceleration = 0, 0, -9.81\n end\nend\n"
      << "subsection Dynamic\n set End time = 1\n set Step = 0.01\n set Stages = " << stages << "\nend\n";
    return text.str();
  }

  const std::vector<Vector3> four      = {{0.5, 0.3, 0}, {-0.4, 0.35, 0}, {-0.5, -0.3, 0}, {0.55, -0.25, 0}},
                             rectangle = {{0.5, 0.3, 0}, {-0.5, 0.3, 0}, {-0.5, -0.3, 0}, {0.5, -0.3, 0}};

  std::vector<Vector3>
  hexagon()
  {
    std::vector<Vector3> places;
    for (unsigned int i = 0; i < 6; ++i)
      places.emplace_back(0.5 * std::cos(0.3 + i * M_PI / 3), 0.5 * std::sin(0.3 + i * M_PI / 3), 0);
    return places;
  }

  /** What the run was refused for; nothing if it was not. */
  std::string
  refusal(const std::string &model)
  {
    try
      {
        run_motion(model, "platform", {});
      }
    catch (const NotConverged &problem)
      {
        return problem.what();
      }
    return "";
  }

  /** Bricard's mechanism, each axis wrong by up to @p error [rad]. */
  std::vector<std::string>
  rounded_bricard(const double error)
  {
    const Vector3            axes[]    = {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
    std::vector<std::string> overrides = {"Joints/P5/Type = revolute", "Dynamic/End time = 3"};
    for (unsigned int i = 0; i < 6; ++i)
      {
        std::ostringstream text;
        text.precision(17);
        text << "Joints/P" << i << "/Axis = ";
        for (unsigned int k = 0; k < 3; ++k)
          text << (k > 0 ? ", " : "") << axes[i](k) + error * std::sin(1 + 3 * i + 7 * k);
        overrides.push_back(text.str());
      }
    return overrides;
  }
} // namespace



TEST(Platform, SwingsAsOnThreeRodsWhereItDoesNotTurn)
{
  for (const std::string stages : {"1", "2", "3"})
    for (const std::string velocity : {"0.01, 0.005, 0", "1, 0.5, 0"})
      {
        auto three = four;
        three.pop_back();
        const Outcome reference = run_motion(platform(three, velocity, "0, 0, 0", stages), "platform", {});
        for (const auto &places : {four, rectangle, hexagon()})
          {
            const Outcome run = run_motion(platform(places, velocity, "0, 0, 0", stages), "platform", {});
            EXPECT_EQ(run.n_redundant, places.size() - 3);
            EXPECT_LT(run.gap, 1e-9) << stages << ' ' << velocity;
            EXPECT_LT(run.error(reference), 1e-7) << stages << ' ' << velocity;
          }
      }
}



TEST(Platform, IsRefusedByNameWhereItTurns)
{
  for (const std::string stages : {"1", "2", "3"})
    for (const auto &places : {four, rectangle, hexagon()})
      for (const auto &[velocity, spin] : {std::pair<std::string, std::string>{"0.1, 0.05, 0", "0, 0, 0.1"},
                                           std::pair<std::string, std::string>{"1, 0.5, 0", "0, 0, 0.5"}})
        {
          const std::string text = refusal(platform(places, velocity, spin, stages));
          EXPECT_NE(text.find("in some positions only: joint rod"), std::string::npos)
            << stages << ' ' << places.size() << ' ' << velocity << ": " << text;
        }
}



TEST(Platform, IsRefusedIfRoundedAndByOtherIntegrators)
{
  const auto is_named = [](const std::string &model) {
    const std::string text = refusal(model);
    EXPECT_NE(text.find("in some positions only: joint rod"), std::string::npos) << text;
  };
  // it is not the rounding that grows
  is_named(platform(rectangle, "1, 0.5, 0", "0, 0, 0.5", "2", 1e-7));
  std::string model = platform(rectangle, "1, 0.5, 0", "0, 0, 0.5", "2");
  model.replace(model.find(" set Stages = 2"), 15, " set Integrator = generalised alpha");
  is_named(model);
}



TEST(Rounded, BricardTellsItsGapOrThatItIsAStructure)
{
  const std::string bricard = "prm/benchmarks/peers/bricard.prm", P3 = "bar 2.end";
  const Outcome     exact = run_motion(bricard, P3, rounded_bricard(0));
  EXPECT_EQ(exact.log.find("violated by up to"), std::string::npos) << exact.log;
  for (const double error : {1e-8, 1e-6, 1e-5})
    {
      const Outcome run = run_motion(bricard, P3, rounded_bricard(error));
      EXPECT_EQ(run.n_redundant, 1u);
      EXPECT_LT(run.gap, 10 * error);
      EXPECT_LT(run.error(exact), 100 * error);
      EXPECT_EQ(run.log.find("violated by up to") != std::string::npos, error > 1e-7) << run.log;
    }
}
