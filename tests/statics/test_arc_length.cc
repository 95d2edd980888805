// Equilibrium paths by their arc length: limit points, snap-through, bifurcations.
//
// References: the truss of two bars, closed form at its test. Lee's frame (Lee, Manuel and Rossow 1968) and the deep
// arch (Da Deppo and Schmidt 1975): limit points of the planar rod's exact equations by shooting, derivable, see
// doc/benchmarks/stability_snap_through.md. Euler's column: π² EI/L².

#include <samara/base/text.h>

#include <gtest/gtest.h>

#include "entries.h"

using namespace samara;

namespace
{
  const std::string lees_frame = "prm/benchmarks/stability/lees_frame.prm";
  const std::string deep_arch  = "prm/benchmarks/stability/deep_arch_path.prm";

  using Points = std::vector<StaticAnalysis::SingularPoint>;

  /** Follow the path that a scene asks for; the singular points on it. */
  const Points &
  follow(Scene &scene)
  {
    scene.equilibrium();
    return scene.analysis<StaticAnalysis>().singular_points;
  }

  double
  at(const Scene &scene, const std::string &probe, const StaticAnalysis::SingularPoint &point)
  {
    return scene.input.model.probe(probe).value(point.state);
  }

  /** Two bars between (∓1, 0) and the apex (0, 1/2), hinged at all three points, EA = 1, a force −P on the apex. */
  std::string
  truss(const double P)
  {
    const std::string bar   = "    set Type = beam\n    set Section = bar\n    set Elements = 1\n    set Degree = 1\n";
    const std::string hinge = "    set Type = revolute\n    set Axis = 0, 0, 1\n";
    return "set Analyses = static\n"
           "subsection Sections\n  subsection bar\n    set Type = engineering constants\n    set EA = 1\n    set GA2 = 1\n"
           "    set GA3 = 1\n    set GJ = 100\n    set EI2 = 100\n    set EI3 = 100\n    set Mass = 1\n  end\nend\n"
           "subsection Bodies\n"
           "  subsection left\n" +
           bar +
           "    set Points = -1, 0, 0; 0, 0.5, 0\n  end\n"
           "  subsection right\n" +
           bar +
           "    set Points = 0, 0.5, 0; 1, 0, 0\n  end\nend\n"
           "subsection Joints\n"
           "  subsection a\n" +
           hinge +
           "    set Body A = ground\n    set Body B = left.start\n  end\n"
           "  subsection b\n" +
           hinge +
           "    set Body A = ground\n    set Body B = right.end\n    set Position = 1, 0, 0\n  end\n"
           "  subsection apex\n" +
           hinge +
           "    set Body A = left.end\n    set Body B = right.start\n  end\nend\n"
           "subsection Loads\n  subsection force\n    set Type = point load\n    set At = left.end\n    set Force = 0, -" +
           number_to_text(P) +
           ", 0\n  end\nend\n"
           "subsection Static\n  set Path = arc length\n  set Load steps = 5\nend\n";
  }
} // namespace



// With the half width b = 1, bars of length L at first and l now, the apex at the height y, l² = b² + y²:
// P = 2 EA y (1/l − 1/L). It is greatest where l³ = b² L, and least at −y. Any mesh is exact.
TEST(ArcLength, TrussSnapsThroughAtTheClosedForm)
{
  const double L = std::sqrt(1.25), l = std::cbrt(L), y = std::sqrt(l * l - 1), P = 2 * y * (1 / l - 1 / L);
  for (const double weight : {0., 0.3})
    {
      Scene         scene(truss(2 * P), {"Static/Weight of the load = " + number_to_text(weight)});
      const Points &points = follow(scene);
      ASSERT_EQ(points.size(), 2u);
      for (const int k : {0, 1})
        {
          EXPECT_TRUE(points[k].is_limit);
          EXPECT_NEAR(points[k].state.factor, k == 0 ? 0.5 : -0.5, 1e-11);
          EXPECT_NEAR(at(scene, "left.end.displacement y", points[k]), (k == 0 ? y : -y) - 0.5, 1e-6);
        }
      // beyond both, at the whole force
      EXPECT_DOUBLE_EQ(scene.context.state.factor, 1.);
      const double y_end = scene.value("left.end.displacement y") + 0.5;
      EXPECT_NEAR(2 * y_end * (1 / std::sqrt(1 + y_end * y_end) - 1 / L), 2 * P, 1e-9);
      EXPECT_LT(y_end, -0.5);
    }
}



// Order 2p of the limit loads, as of all that energy measures.
TEST(ArcLength, LimitLoadsOfLeesFrameConvergeWithOrderTwiceTheDegree)
{
  const double       reference[] = {18.5445270944, -9.39248964035};
  const unsigned int coarse[]    = {0, 40, 20, 20, 10};
  for (unsigned int p = 1; p <= 4; ++p)
    {
      double error[2][2];
      for (const unsigned int k : {0, 1})
        {
          auto overrides = mesh("frame", p, coarse[p] << k);
          overrides.push_back("Static/Largest arc = 0.2");
          Scene         scene(lees_frame, overrides);
          const Points &points = follow(scene);
          ASSERT_EQ(points.size(), 2u);
          for (const unsigned int i : {0, 1})
            {
              EXPECT_TRUE(points[i].is_limit);
              error[i][k] = std::abs(20 * points[i].state.factor - reference[i]);
            }
        }
      for (const unsigned int i : {0, 1})
        EXPECT_NEAR(std::log2(error[i][0] / error[i][1]), 2. * p, 0.4) << "degree " << p << ", limit " << i + 1;
    }
}



TEST(ArcLength, LeesFrameHasTheLimitPointsOfTheExactEquations)
{
  Scene         scene(lees_frame, mesh("frame", 4, 40));
  const Points &points = follow(scene);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_NEAR(20 * points[0].state.factor, 18.5445270944, 2e-8);
  EXPECT_NEAR(20 * points[1].state.factor, -9.39248964035, 2e-8);
  EXPECT_NEAR(at(scene, "frame.load.displacement x", points[0]), 26.87832779, 1e-4);
  EXPECT_NEAR(at(scene, "frame.load.displacement y", points[0]), -48.75424047, 1e-4);
  EXPECT_NEAR(at(scene, "frame.load.displacement x", points[1]), 90.17700047, 1e-4);
  EXPECT_NEAR(at(scene, "frame.load.displacement y", points[1]), -58.22495785, 1e-4);
  // four iterations a step, and the search for the limit points: the constraint is linearised as the equilibrium is
  const auto &analysis = scene.analysis<StaticAnalysis>();
  EXPECT_LT(analysis.n_iterations, 7. * analysis.n_steps);
}



TEST(ArcLength, DeepArchPassesBothLimitPoints)
{
  Scene         scene(deep_arch, mesh("arch", 4, 48));
  const Points &points = follow(scene);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_NEAR(1000 * points[0].state.factor, 897.2891338, 1e-6);
  EXPECT_NEAR(1000 * points[1].state.factor, -73.04876023, 1e-6);
  EXPECT_NEAR(at(scene, "arch.middle.displacement x", points[0]), 61.14170984, 1e-4);
  EXPECT_NEAR(at(scene, "arch.middle.displacement y", points[0]), -113.7307344, 1e-4);
  EXPECT_NEAR(at(scene, "arch.middle.displacement x", points[1]), 57.06771797, 1e-4);
  EXPECT_NEAR(at(scene, "arch.middle.displacement y", points[1]), -122.0656124, 1e-4);
}



// As stiff out of its plane as in it, the arch would leave the plane: a bifurcation, that is reported; the path stays
// on the branch it is on. The load is where load control, too, sees the determinant change its sign.
TEST(ArcLength, DeepArchReportsThatItLeavesItsPlane)
{
  const std::vector<std::string> soft = {"Constants/stiff = 1e6", "Bodies/arch/Elements = 16"};
  Scene                          scene(deep_arch, soft);
  const Points                  &points = follow(scene);
  ASSERT_EQ(points.size(), 3u);
  EXPECT_FALSE(points[0].is_limit);
  EXPECT_TRUE(points[1].is_limit);
  EXPECT_TRUE(points[2].is_limit);

  auto by_load = soft;
  by_load.insert(by_load.end(), {"Static/Path = load", "Static/Smallest step = 1e-6"});
  Scene stopping(deep_arch, by_load);
  EXPECT_THROW(stopping.equilibrium(), NotConverged);
  EXPECT_NEAR(stopping.context.state.factor, points[0].state.factor, 3e-6);
}



TEST(ArcLength, ReportsTheBucklingLoadOfEulersColumn)
{
  Scene         scene("prm/benchmarks/euler_column.prm",
              {"Constants/P = 20", "Static/Path = arc length", "Static/Load steps = 10"});
  const Points &points = follow(scene);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_FALSE(points[0].is_limit);
  EXPECT_NEAR(20 * points[0].state.factor, M_PI * M_PI, 2e-5 * M_PI * M_PI);
  // the straight branch goes on
  EXPECT_DOUBLE_EQ(scene.context.state.factor, 1.);
  EXPECT_NEAR(scene.value("column.middle.displacement z"), 0., 1e-9);
}



// Where two modes buckle at once the determinant keeps its sign: nothing is reported. A limit of the method.
TEST(ArcLength, DoesNotSeeTwoBucklingModesAtTheSameLoad)
{
  const std::string cantilever =
    "set Analyses = static\n"
    "subsection Sections\n  subsection round\n    set Type = engineering constants\n"
    "    set EA = 1e7\n    set GA2 = 1e7\n    set GA3 = 1e7\n    set GJ = 100\n    set EI2 = 1\n"
    "    set EI3 = 1\n    set Mass = 1\n  end\nend\n"
    "subsection Bodies\n  subsection column\n    set Type = beam\n    set Points = 0, 0, 0; 1, 0, 0\n"
    "    set Section = round\n  end\nend\n"
    "subsection Joints\n  subsection foot\n    set Type = rigid\n    set Body A = ground\n"
    "    set Body B = column.start\n  end\nend\n"
    "subsection Loads\n  subsection force\n    set Type = point load\n    set At = column.end\n"
    "    set Force = -5, 0, 0\n  end\nend\n"
    "subsection Static\n  set Path = arc length\n  set Load steps = 10\nend\n";
  Scene both(cantilever), one(cantilever, {"Sections/round/EI3 = 10"});
  EXPECT_EQ(follow(both).size(), 0u);
  ASSERT_EQ(follow(one).size(), 1u);
  EXPECT_NEAR(5 * one.analysis<StaticAnalysis>().singular_points[0].state.factor, M_PI * M_PI / 4, 1e-4);
}



// Without limit points on the way the end is the equilibrium that load control finds.
TEST(ArcLength, EndsAtTheEquilibriumOfTheFullLoad)
{
  Scene by_load("prm/benchmarks/elastica.prm"), by_arc("prm/benchmarks/elastica.prm", {"Static/Path = arc length"});
  by_load.equilibrium();
  by_arc.equilibrium();
  EXPECT_DOUBLE_EQ(by_arc.context.state.factor, 1.);
  for (unsigned int i = 0; i < by_load.context.state.q.size(); ++i)
    EXPECT_NEAR(by_load.context.state.q[i], by_arc.context.state.q[i], 1e-9);
}



// P = 1 is on the path of Lee's frame three times: before the first limit point, between the two, behind the second.
TEST(ArcLength, EndsAtTheWantedPassageOfALoad)
{
  double down = 0;
  for (const unsigned int passage : {1, 2, 3})
    {
      Scene scene(lees_frame, {"Static/End load factor = 0.05", "Static/Passages = " + std::to_string(passage)});
      EXPECT_EQ(follow(scene).size(), passage - 1);
      EXPECT_DOUBLE_EQ(scene.context.state.factor, 0.05);
      std::vector<double> r;
      scene.system.residual(scene.context.state, scene.context.state.stress, r);
      for (unsigned int i = 0; i < scene.system.size(); ++i)
        EXPECT_NEAR(r[i], 0., 1e-6);
      const double x = scene.value("frame.load.displacement x");
      EXPECT_GT(x, down);
      down = x;
    }
}



TEST(ArcLength, EndsAfterTheMostStepsAndBeyondTheLargestLoadFactor)
{
  Scene steps(lees_frame, {"Static/Most steps = 3"});
  follow(steps);
  EXPECT_EQ(steps.analysis<StaticAnalysis>().n_steps, 3u);
  EXPECT_LT(steps.context.state.factor, 1.);
  Scene far(lees_frame, {"Static/Largest load factor = 0.5"});
  follow(far);
  EXPECT_GT(far.context.state.factor, 0.5);
  EXPECT_LT(far.context.state.factor, 0.9272);
  EXPECT_NE(far.stream.str().find("has not come to load factor 1"), std::string::npos);
}



TEST(ArcLength, RefusesPartsThatRotate)
{
  Scene scene("prm/benchmarks/spinning_rod.prm", {"Static/Path = arc length"});
  EXPECT_THROW(scene.equilibrium(), InputError);
}



// The distance is that of the configurations: √(Σ |x − x₀|²/L² + ½ |D − D₀|²) over the nodes, divided by √N.
TEST(ArcLength, StepsHaveTheLengthThatIsAskedFor)
{
  Scene         scene(lees_frame);
  const System &system = scene.system;
  const auto    solver = make_solver(system.layout.pattern);
  ArcLength     method(system, *solver);
  PathPoint     from, to;
  from.state        = system.reference();
  from.state.factor = 0;
  method.start(from);
  EXPECT_GT(from.slope, 0.);
  for (const double s : {0.01, 0.05})
    {
      ASSERT_TRUE(method.step(from, s, to).converged);
      double sum = 0;
      for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
        sum += (to.state.position(node) - from.state.position(node)).squaredNorm() / (2 * 120. * 120.) +
               0.5 * (to.state.triad(node) - from.state.triad(node)).squaredNorm();
      EXPECT_NEAR(std::sqrt(sum / (system.layout.n_nodes - 1)), s, 1e-10);
      // the tangent leads there to second order
      EXPECT_NEAR(to.state.factor, s * from.slope, 20 * s * s);
    }
}
