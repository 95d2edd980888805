// What must not depend on how a problem is put: place and direction of the model in space, rigid motions, and the path
// on which the loads are applied. Model: a curved, twisted beam with a fully coupled section and a second one with a
// corner, under dead and follower loads.

#include <samara/base/text.h>

#include <gtest/gtest.h>

#include "entries.h"

using namespace samara;

namespace
{
  /** The model turned by @p Q and then moved by @p c. */
  std::string
  turned_and_moved(const Matrix3 &Q, const Vector3 &c)
  {
    const auto at = [&](const double x, const double y, const double z) { return text_of(Q * Vector3(x, y, z) + c); };
    const auto direction = [&](const double x, const double y, const double z) {
      return text_of(Q * Vector3(x, y, z));
    };
    return "set Analyses = static\nsubsection Sections\n subsection full\n set Type = matrices\n"
           " set Stiffness = 900, 1, .5, .2, .3, .1, 700, .4, .3, .2, .6, 600, .1, .5, .2, 3, .2, .1, 2, .3, 4\n end\nend\n"
           "subsection Bodies\n subsection curved\n set Type = beam\n set Shape = arc\n set Twist = 0.4*s\n"
           " set Section = full\n set Elements = 6\n set Degree = 3\n set Points = " +
           at(0, 0, 0) + "; " + at(0.6, 0.2, 0.1) + "; " + at(1, 0.6, 0) + "\n set Axis 2 = " + direction(0, 1, 0.3) +
           "\n end\n subsection angled\n set Type = beam\n set Section = full\n set Elements = 6\n set Degree = 3\n" +
           " set Points = " + at(1, 0.6, 0) + "; " + at(1.5, 0.6, 0.2) + "; " + at(1.5, 1.1, 0.4) +
           "\n set Axis 2 = " + direction(0.1, 0.2, 1) + "\n end\nend\n" +
           "subsection Joints\n subsection clamp\n set Type = rigid\n set Body A = ground\n set Body B = curved.start\n end\n" +
           " subsection weld\n set Type = rigid\n set Body A = curved.end\n set Body B = angled.start\n end\nend\n" +
           "subsection Loads\n subsection tip\n set Type = point load\n set At = angled.end\n set Force = " +
           direction(0.5, -0.7, 0.9) + "\n set Moment = " + direction(0.2, 0.4, -0.5) +
           "\n end\n subsection follower\n set Type = point load\n set At = curved.end\n set Axes = body\n" +
           " set Force = 0.6*t, 0.9*t, 1.1*t\n set Moment = 0.5*t, -0.4*t, 0.8*t\n end\n" +
           " subsection line\n set Type = line load\n set Body = curved\n set Force = " + direction(0.3, 0.2, -0.8) +
           "\n end\nend\nsubsection Static\nend\n";
  }

  const std::vector<std::string> time_1 = {"Static/Time = 1"};

  Matrix3
  some_rotation()
  {
    return rotation_of_vector({1.1, -2.3, 0.7});
  }

  std::vector<double>
  strains(const Scene &scene)
  {
    std::vector<double> e;
    scene.system.strains(scene.context.state, e);
    return e;
  }

  /** Largest difference, relative to the largest value. */
  double
  difference(const std::vector<double> &a, const std::vector<double> &b)
  {
    const Eigen::Map<const Eigen::VectorXd> A(a.data(), a.size()), B(b.data(), b.size());
    return (A - B).cwiseAbs().maxCoeff() / A.cwiseAbs().maxCoeff();
  }

  /** Turn all nodes, the ground too, by @p Q about the origin and move them by @p c. */
  void
  move(State &state, const Matrix3 &Q, const Vector3 &c)
  {
    for (unsigned int i = 0; i < state.q.size(); i += 12)
      {
        Eigen::Map<Vector3> x(&state.q[i]);
        Eigen::Map<Matrix3> D(&state.q[i + 3]);
        x = (Q * x + c).eval();
        D = (Q * D).eval();
      }
  }
} // namespace



TEST(Invariance, ModelTurnedAndMoved)
{
  const Matrix3 Q = some_rotation();
  const Vector3 c(3, -2, 5);
  Scene first(turned_and_moved(Matrix3::Identity(), Vector3::Zero()), time_1), second(turned_and_moved(Q, c), time_1);
  first.equilibrium();
  second.equilibrium();
  const auto e = strains(first);
  EXPECT_LT(difference(e, strains(second)), 1e-12);
  // the loads were large
  EXPECT_GT(*std::max_element(e.begin(), e.end()), 0.3);
  const Vector3 u(first.value("angled.end.displacement x"),
                  first.value("angled.end.displacement y"),
                  first.value("angled.end.displacement z")),
    v(second.value("angled.end.displacement x"),
      second.value("angled.end.displacement y"),
      second.value("angled.end.displacement z"));
  EXPECT_LT((Q * u - v).norm(), 1e-12 * u.norm());
}



TEST(Invariance, RigidMotionDoesNotStrain)
{
  Scene scene(turned_and_moved(Matrix3::Identity(), Vector3::Zero()), time_1);
  State turned = scene.system.reference();
  move(turned, some_rotation(), {3, -2, 5});
  std::vector<double> e;
  scene.system.strains(turned, e);
  for (const double strain : e)
    EXPECT_NEAR(strain, 0., 1e-13);
  EXPECT_LT(scene.system.energy(turned).strain, 1e-23);

  // nor does it change strains that are there
  scene.equilibrium();
  const auto   before = strains(scene);
  const double energy = scene.system.energy(scene.context.state).strain;
  move(scene.context.state, some_rotation(), {3, -2, 5});
  EXPECT_LT(difference(before, strains(scene)), 1e-12);
  EXPECT_NEAR(scene.system.energy(scene.context.state).strain / energy, 1., 1e-13);
}



TEST(Invariance, NumberOfLoadSteps)
{
  const auto model_text = turned_and_moved(Matrix3::Identity(), Vector3::Zero());
  Scene      once(model_text, time_1);
  once.equilibrium();
  for (const unsigned int n : {3, 17, 50})
    {
      Scene often(model_text, {"Static/Time = 1", "Static/Load steps = " + std::to_string(n)});
      often.equilibrium();
      EXPECT_GT(often.analysis<StaticAnalysis>().n_steps, once.analysis<StaticAnalysis>().n_steps);
      EXPECT_LT(difference(strains(once), strains(often)), 1e-12) << n << " load steps";
    }
}



// The dead loads first and the follower in six steps after them, against all at once.
TEST(Invariance, OrderOfLoads)
{
  const auto model_text = turned_and_moved(Matrix3::Identity(), Vector3::Zero());
  Scene      at_once(model_text, time_1);
  at_once.equilibrium();
  Scene dead_only(model_text, {"Static/Time = 0"});
  State state = dead_only.equilibrium();
  EXPECT_GT(difference(strains(at_once), strains(dead_only)), 0.1) << "the follower does nothing";
  for (const std::string time : {"0.2", "0.4", "0.6", "0.8", "1"})
    {
      Scene next(model_text, {"Static/Time = " + time});
      next.context.state          = state;
      next.context.is_equilibrium = true;
      state                       = next.equilibrium();
    }
  std::vector<double> e;
  at_once.system.strains(state, e);
  EXPECT_LT(difference(strains(at_once), e), 1e-12);
}



// Curves of all kinds with twist and a coupled section: the reference configuration is in equilibrium.
TEST(Invariance, UnloadedModelsAreInEquilibrium)
{
  for (const std::string shape : {"Shape = arc\n set Points = 0, 0, 0; 1, 0.5, 0.2; 1, 2, 1",
                                  "Points = 0, 0, 0; 1, 0.5, 0.2; 1, 2, 1; 0, 2, 0",
                                  "Shape = expressions\n set Expressions = cos(4*s), sin(4*s), s^2"})
    {
      Scene scene(
        "subsection Sections\n subsection full\n set Type = matrices\n"
        " set Stiffness = 9, 1, .5, .2, .3, .1, 7, .4, .3, .2, .6, 6, .1, .5, .2, 3, .2, .1, 2, .3, 4\n end\nend\n"
        "subsection Bodies\n subsection b\n set Type = beam\n set Section = full\n set Twist = s + 0.3*s^2\n set " +
        shape + "\n end\nend\n");
      State               state = scene.system.reference();
      std::vector<double> r;
      scene.system.stresses(state, state.stress);
      scene.system.residual(state, state.stress, r);
      for (const double force : r)
        EXPECT_NEAR(force, 0., 1e-12) << shape;
      EXPECT_LT(scene.system.energy(state).strain, 1e-24) << shape;
    }
}
