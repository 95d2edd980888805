// The skeletons of a load (point drag), a state (servo), an analysis (mass report) and an integrator (explicit
// midpoint), as those of test_skeletons.cc.

#include <samara/analysis/dynamic.h>
#include <samara/time/stage_integrator.h>

#include <cmath>
#include <fstream>

#include "scene.h"

using namespace samara;

namespace
{
  std::string
  section(const std::string &name, const std::string &object, const std::string &entries)
  {
    return "subsection " + name + "\n subsection " + object + "\n" + entries + "\n end\nend\n";
  }

  std::string
  dynamic(const std::string &entries)
  {
    return "set Analyses = dynamic\nsubsection Dynamic\n" + entries + "\nend\n";
  }

  const std::string drag  = " set Type = point drag\n set At = a.ear\n set Drag area = 1.5\n";
  const std::string servo = " set Type = servo\n set Unit = m\n set Signal = 10 m\n set Lag = 0.5 s\n"
                            " set Largest rate = 2 m/s\n";

  const std::string ball = R"(
subsection Bodies
  subsection ball
    set Type = rigid body
    set Mass = 2
    set Inertia = 1, 1, 1
    set Velocity = 30, 0, 40
  end
end
)";

  /** A body on an arm that swings about a slanted pin, in weight. */
  const std::string pendulum = R"(
subsection Bodies
  subsection bob
    set Type = rigid body
    set Mass = 3
    set Inertia = 0.3, 0.4, 0.5
    set Centre of mass = 0.4, 0.1, -0.3
    set Angular velocity = 0, 0.6, 0.8
  end
end
subsection Joints
  subsection pin
    set Type = revolute
    set Body A = ground
    set Body B = bob.centre
    set Axis = 0, 3, 4
  end
end
subsection Loads
  subsection weight
    set Type = gravity
  end
end
)";
} // namespace



TEST(LoadSkeleton, TangentsAgreeWithComplexStep)
{
  for (const std::string wind : {"", " set Wind = 3, -1, 2\n"})
    {
      const SmallScene  scene(two_blocks + section("Loads", "air", drag + wind));
      const ComplexStep check(scene.system, false, false, true);
      EXPECT_LT(check.error_of_tangent(), 2e-14) << wind;
      EXPECT_LT(check.error_of_damping(), 2e-14) << wind;
    }
}



// m v̇ = −½ ρ S v²: v = v₀/(1 + ½ ρ S v₀ t/m). What the drag does is work of a load.
TEST(LoadSkeleton, SlowsDownWhatFlies)
{
  SmallScene scene(
    dynamic(" set End time = 0.4\n set Step = 0.01\n set Newton tolerance = 1e-13") + ball +
    section("Loads", "air", " set Type = point drag\n set At = ball.centre\n set Drag area = 0.6\n set Density = 0.5"));
  auto &analysis = scene.analysis<DynamicAnalysis>();
  analysis.run(scene.context);
  const double v = 50 / (1 + 0.5 * 0.5 * 0.6 * 50 * 0.4 / 2);
  EXPECT_NEAR(scene.value("ball.centre.velocity x"), 0.6 * v, 1e-9);
  EXPECT_NEAR(scene.value("ball.centre.velocity y"), 0, 1e-12);
  EXPECT_NEAR(scene.value("ball.centre.velocity z"), 0.8 * v, 1e-9);
  EXPECT_NEAR(analysis.budget.loads, 0.5 * 2 * (v * v - 50 * 50), 1e-6);
}



// Drag is along the wind, with the square of its speed; a slide takes what is across, its spring the rest.
TEST(LoadSkeleton, WindHoldsASpring)
{
  SmallScene scene(R"(
subsection Bodies
  subsection sail
    set Type = rigid body
    set Mass = 1
  end
end
subsection Joints
  subsection slide
    set Type = prismatic
    set Body A = ground
    set Body B = sail.centre
    set Axis = 1, 0, 0
    subsection displacement
      set Spring = 50
    end
  end
end
)" + section("Loads", "air", " set Type = point drag\n set At = sail.centre\n set Drag area = 2\n set Wind = 3, 4, 0"));
  scene.find_equilibrium();
  EXPECT_NEAR(scene.value("slide.displacement"), 0.5 * 1.225 * 2 * 5 * 3 / 50, 1e-12);
}



TEST(LoadSkeleton, RefusesWhatIsSenseless)
{
  const std::string start = " set Type = point drag\n set Drag area = 1\n";
  EXPECT_TRUE(contains(complaint(two_blocks + section("Loads", "air", start)), "<At>"));
  EXPECT_TRUE(
    contains(complaint(two_blocks + section("Loads", "air", start + " set At = a.eer")), "did you mean <ear>?"));
  EXPECT_TRUE(contains(complaint(two_blocks + section("Loads", "air", drag + " set Density = -1")), "is not accepted"));
  EXPECT_EQ(complaint(two_blocks + section("Loads", "air", drag)), "");
}



TEST(StateSkeleton, TangentsAgreeWithComplexStep)
{
  const std::string follows =
    " set Type = servo\n set Unit = m\n set Signal = a.ear.position x + 0.3 s * a.ear.velocity y\n"
    " set Lag = 0.5 s\n set Largest rate = ";
  for (const std::string rate : {"100 m/s", "1e-3 m/s"})
    {
      const SmallScene  scene(two_blocks + section("States", "it", follows + rate));
      const ComplexStep check(scene.system, false, false, true);
      EXPECT_LT(check.error_of_tangent(), 2e-14) << rate;
      EXPECT_LT(check.error_of_damping(), 2e-14) << rate;
    }
}



// From 0 to 10 m with at most 2 m/s and a lag of 0.5 s: z = 2 t until 1 m is left, at 4.5 s, and then the lag alone.
TEST(StateSkeleton, GoesNoFasterThanItMay)
{
  const auto at = [](const std::string &time) {
    SmallScene scene(dynamic(" set Step = 0.02\n set Newton tolerance = 1e-13\n set End time = " + time) + two_blocks +
                     section("States", "it", servo));
    scene.analysis<DynamicAnalysis>().run(scene.context);
    return scene.value("it");
  };
  EXPECT_NEAR(at("4"), 8, 1e-10);
  EXPECT_NEAR(at("6"), 10 - std::exp(-3.), 1e-8);
}



TEST(StateSkeleton, RestsAtItsSignal)
{
  SmallScene scene(ball + section("States", "it", servo + " set Initial = 9.5 m\n") +
                   joint("clamp",
                         "set Type = revolute\n set Body A = ground\n set Body B = ball.centre\n"
                         "subsection rotation\n set Spring = 1\n end\n"));
  scene.find_equilibrium();
  EXPECT_NEAR(scene.value("it"), 10, 1e-12);
}



TEST(StateSkeleton, RefusesWhatIsSenseless)
{
  const auto said_to = [](const std::string &entries) {
    return complaint(two_blocks + section("States", "it", " set Type = servo\n" + entries));
  };
  EXPECT_TRUE(contains(said_to(" set Unit = metres\n set Signal = 1"), "is not an SI unit"));
  EXPECT_TRUE(contains(said_to(" set Unit = m\n"), "<Signal>"));
  EXPECT_TRUE(contains(said_to(" set Unit = m\n set Signal = 3 kg"), "Signal"));
  EXPECT_TRUE(contains(said_to(" set Unit = m\n set Signal = 1 m\n set Lag = 0"), "is not accepted"));
  EXPECT_EQ(complaint(two_blocks + section("States", "it", servo)), "");
}



// The blocks' inertias are about their centres, a's in axes that are turned: (m_a m_b/m) |d|² is what two masses have.
TEST(AnalysisSkeleton, MassOfTwoBlocks)
{
  SmallScene scene("set Analyses = mass\n" + two_blocks);
  auto      &report = scene.analysis<MassReport>();
  report.start(scene.context);
  report.run(scene.context);
  const Vector3 d(1, 0.2, -0.3);
  EXPECT_NEAR(report.last.mass, 5, 1e-15);
  EXPECT_LT((report.last.centre - 0.4 * d).norm(), 1e-15);
  const Matrix3 R = scene.context.state.triad(1);
  const Matrix3 J = R * Vector3(0.3, 0.4, 0.5).asDiagonal() * R.transpose() + 0.1 * Matrix3::Identity() +
                    1.2 * (d.squaredNorm() * Matrix3::Identity() - d * d.transpose());
  EXPECT_LT((report.last.inertia - J).norm(), 1e-14);

  SmallScene about("set Analyses = mass\nsubsection Mass\n set About = b.centre\nend\n" + two_blocks);
  auto      &other = about.analysis<MassReport>();
  other.run(about.context);
  const Vector3 e = 0.6 * d;
  EXPECT_LT((other.last.inertia - J - 5 * (e.squaredNorm() * Matrix3::Identity() - e * e.transpose())).norm(), 1e-14);
}



TEST(AnalysisSkeleton, WritesALineForEachSpeedAndRefusesWhatIsNotThere)
{
  SmallScene scene("set Analyses = mass\n" + two_blocks);
  auto      &report    = scene.analysis<MassReport>();
  scene.context.folder = scene.folder.path(".");
  report.start(scene.context);
  for (const double speed : {1., 2.})
    {
      scene.context.speeds = {speed};
      report.run(scene.context);
    }
  report.finish(scene.context);
  std::ifstream     file(scene.context.folder + "/mass.csv");
  std::stringstream text;
  text << file.rdbuf();
  const std::string lines = text.str();
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 3) << lines;

  SmallScene faulty("set Analyses = mass\nsubsection Mass\n set About = b.middle\nend\n" + two_blocks);
  try
    {
      faulty.analysis<MassReport>().run(faulty.context);
      ADD_FAILURE();
    }
  catch (const InputError &error)
    {
      EXPECT_TRUE(contains(error.what(), "model.prm:3")) << error.what();
    }
}



// Errors of positions and velocities fall by four with half the step; the energy account closes by definition.
TEST(IntegratorSkeleton, IsOfSecondOrder)
{
  const auto end = [](const std::string &step, const std::string &name) {
    SmallScene scene(dynamic(" set End time = 0.5\n set Integrator = " + name + "\n set Step = " + step) + pendulum);
    auto      &analysis = scene.analysis<DynamicAnalysis>();
    analysis.run(scene.context);
    EXPECT_LT(analysis.report.largest_balance, 1e-10);
    EXPECT_EQ(analysis.effort()->steps, std::lround(0.5 / std::stod(step)));
    std::vector<double> numbers = scene.context.state.q;
    numbers.insert(numbers.end(), scene.context.state.y.begin(), scene.context.state.y.end());
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(numbers.data(), numbers.size()));
  };
  const Eigen::VectorXd exact  = end("0.01", "family");
  const double          coarse = (end("0.01", "explicit midpoint") - exact).norm(),
               fine            = (end("0.005", "explicit midpoint") - exact).norm();
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1) << coarse << ", " << fine;
  EXPECT_LT(fine, 1e-3);
}



TEST(IntegratorSkeleton, IsNamedAndRefusesWhatItCannotDo)
{
  EXPECT_TRUE(
    contains(complaint(dynamic(" set Integrator = explicit midpoint\n set Step control = adaptive") + pendulum),
             "integrator <explicit midpoint>"));
  EXPECT_TRUE(contains(complaint(dynamic(" set Integrator = explicit middle") + pendulum), "explicit midpoint"));
  SmallScene scene(dynamic(" set Integrator = explicit midpoint") + two_blocks + section("States", "it", servo));
  try
    {
      scene.analysis<DynamicAnalysis>().run(scene.context);
      ADD_FAILURE();
    }
  catch (const InputError &error)
    {
      EXPECT_TRUE(contains(error.what(), "knows no states of first order; <family> does")) << error.what();
    }
}
