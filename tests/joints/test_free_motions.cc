// The motions each kind of joint leaves free (table 1 of Bauchau, Bottasso & Nikishkov 2001, and the kinds beyond it):
// how many there are, by three routes, and where they point. A free rigid body hangs on the ground by one joint at J,
// away from its centre, with a skew axis.

#include <samara/base/dense.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include "skew_axes.h"

using namespace samara;

namespace
{
  using namespace skew_axes;

  struct FreeMotions
  {
    std::string  entries;
    unsigned int n_free;
    /** Whether the body may move with the twist (velocity at J, spin) in inertial axes. */
    std::vector<std::pair<Vector3, Vector3>> free;
  };

  const Vector3 none = Vector3::Zero();

  std::map<std::string, FreeMotions>
  kinds()
  {
    const std::string axis = "set Axis = 1, 2, -2\n";
    return {{"revolute", {axis, 1, {{none, a}}}},
            {"prismatic", {axis, 1, {{a, none}}}},
            {"screw", {axis + "set Pitch = 0.3\n", 1, {{0.3 * a, a}}}},
            {"cylindrical", {axis, 2, {{a, none}, {none, a}}}},
            {"planar", {axis, 3, {{b, none}, {c, none}, {none, a}}}},
            {"spherical", {"", 3, {{none, a}, {none, b}, {none, c}}}},
            {"universal", {axis + "set Second axis = 2, 1, 2\n", 2, {{none, a}, {none, b}}}},
            {"skew universal", {axis + "set Second axis = 3, 3, 0\n", 2, {{none, a}, {none, a + b}}}},
            {"constant velocity", {axis, 2, {{none, b}, {none, c}}}},
            {"in line", {axis, 4, {{a, none}, {none, a}, {none, b}, {none, c}}}},
            {"in plane", {axis, 5, {{b, none}, {c, none}, {none, a}, {none, b}, {none, c}}}},
            {"rigid", {"set Reaction = true\n", 0, {}}},
            {"flexible joint",
             {axis + "set Axis 2 = 2, 1, 2\nset Stiffness = 7, 0, 5\nset Rotational stiffness = 0, 3, 0\n",
              3,
              {{b, none}, {none, a}, {none, c}}}}};
  }

  /** With @p used, all free motions are unknowns of the system too. */
  std::string
  body_on_joint(const std::string &kind, const std::string &entries, const bool used)
  {
    std::string text = R"(
set Analyses = modal
subsection Bodies
  subsection body
    set Type = rigid body
    set Mass = 2
    set Position = 1, 0.5, -0.3
    set Rotation = 0.3, -0.4, 0.5
    set Centre of mass = 0.1, 0.2, -0.1
    set Inertia = 0.3, 0.4, 0.5
  end
end
subsection Joints
  subsection j
    set Body A = ground
    set Body B = body.centre
    set Position = 0.4, -0.3, 0.2
    set Type = )" + kind +
                       "\n" + entries;
    const std::map<std::string, std::vector<std::string>> names = {{"revolute", {"rotation"}},
                                                                   {"prismatic", {"displacement"}},
                                                                   {"cylindrical", {"displacement", "rotation"}},
                                                                   {"planar",
                                                                    {"displacement 1", "displacement 2", "rotation"}},
                                                                   {"in line", {"displacement"}},
                                                                   {"in plane", {"displacement 1", "displacement 2"}},
                                                                   {"skew universal", {"rotation 1", "rotation 2"}},
                                                                   {"universal", {"rotation 1", "rotation 2"}}};
    if (used && names.count(kind) > 0)
      for (const auto &name : names.at(kind))
        text += "subsection " + name + "\n set Damper = 1e-12\n end\n";
    return text + "  end\nend\n";
  }

  /** Columns: motions of the body (velocity at J, spin, inertial axes) without strain that no constraint prevents. */
  Eigen::MatrixXd
  free_motions(const System &system)
  {
    State state = system.reference();
    state.held  = false;
    SparseMatrix K(system.layout.pattern);
    system.tangent(state, K);
    // rows of the constraints, and those of the springs that resist
    const int             n = system.layout.of_multiplier(0), m = system.layout.n_multipliers;
    Eigen::MatrixXd       A(m + n, n);
    const Eigen::MatrixXd dense = K.dense();
    A << dense.bottomLeftCorner(m, n), dense.topLeftCorner(n, n);
    const Eigen::MatrixXd kernel = FullLu(A, 1e-10).kernel();
    const Matrix3         D      = state.triad(1);
    Eigen::MatrixXd       result(6, kernel.cols());
    for (int k = 0; k < kernel.cols(); ++k)
      {
        const Vector3 spin = D * kernel.col(k).segment<3>(3);
        result.col(k) << Vector3(D * kernel.col(k).head<3>()) + spin.cross(J - state.position(1)), spin;
      }
    return result;
  }

  /** Number of motions without frequency; each is a double zero that is told once. */
  unsigned int
  zero_modes(Scene &scene)
  {
    unsigned int n = 0;
    for (const auto &mode : scene.modes())
      {
        EXPECT_TRUE(mode.is_free() || mode.frequency() > 1e-3);
        n += mode.is_free();
      }
    return n;
  }
} // namespace



TEST(FreeMotions, NumberOfEveryKind)
{
  for (const auto &[name, kind] : kinds())
    for (const bool used : {false, true})
      {
        Scene scene(body_on_joint(name, kind.entries, used));
        EXPECT_EQ(check_model(scene.system).n_free_motions, kind.n_free) << name << (used ? ", used" : "");
        EXPECT_EQ(free_motions(scene.system).cols(), static_cast<int>(kind.n_free)) << name << (used ? ", used" : "");
        EXPECT_EQ(zero_modes(scene), kind.n_free) << name << (used ? ", used" : "");
        EXPECT_TRUE(check_model(scene.system).redundant.empty()) << name;
      }
}



TEST(FreeMotions, DirectionsOfEveryKind)
{
  for (const auto &[name, kind] : kinds())
    {
      Scene                 scene(body_on_joint(name, kind.entries, true));
      const Eigen::MatrixXd motions = free_motions(scene.system);
      ASSERT_EQ(motions.cols(), static_cast<int>(kind.free.size())) << name;
      for (const auto &[velocity, spin] : kind.free)
        {
          Vector6 expected;
          expected << velocity, spin;
          const Eigen::VectorXd combination = PivotedQr(motions).solve(expected);
          EXPECT_LT((motions * combination - expected).norm(), 1e-12) << name << ": " << expected.transpose();
        }
    }
}



// A massless rod keeps the distance of two points: five motions, all but that along it.
TEST(FreeMotions, Distance)
{
  std::string text = body_on_joint("distance", "", false);
  text.replace(text.find("ground"), 6, "anchor.centre");
  text.replace(text.find("end\nsubsection Joints"),
               0,
               "  subsection anchor\n set Type = rigid body\n set Position = 0, 0, 2\n end\n");
  text.replace(text.rfind("end\n"),
               4,
               " subsection fix\n set Type = rigid\n set Body A = ground\n set Body B = anchor.centre\n end\nend\n");
  Scene scene(text);
  EXPECT_EQ(check_model(scene.system).n_free_motions, 5u);
  EXPECT_EQ(zero_modes(scene), 5u);
}



// Along a curve, and three rotations; springs in fixed axes hold as many directions as have stiffness.
TEST(FreeMotions, CurveAndFixedSprings)
{
  const auto count = [](const std::string &joints) {
    Scene scene("set Analyses = modal\nsubsection Bodies\n subsection bead\n set Type = rigid body\n set Mass = 1\n"
                " set Inertia = 1, 1, 1\n end\nend\nsubsection Joints\n" +
                joints + "end\n");
    const unsigned int n = check_model(scene.system).n_free_motions;
    EXPECT_EQ(zero_modes(scene), n) << joints;
    return n;
  };
  const std::string wire    = " subsection wire\n set Type = point on curve\n set Body A = ground\n set Body B = bead\n"
                              " set Expressions = s - 0.5, 0, (s - 0.5)^2\n end\n";
  const auto        springs = [](const std::string &stiffness) {
    return " subsection mount\n set Type = springs in fixed axes\n set Body A = ground\n set Body B = bead\n"
                  " set Stiffness = " +
           stiffness + "\n end\n";
  };
  EXPECT_EQ(count(wire), 4u);
  EXPECT_EQ(count(springs("5, 0, 3")), 4u);
  EXPECT_EQ(count(springs("5, 2, 3")), 3u);
  EXPECT_EQ(count(wire + springs("5, 0, 0")), 3u);
}



// Two wheels on the ground, and a gear between them: one motion instead of two, with spins 1 : n about their axes.
TEST(FreeMotions, GearCouplesTwo)
{
  std::string text = "set Analyses = modal\nsubsection Bodies\n";
  for (const std::string name : {"A", "B"})
    text += " subsection wheel " + name + "\n set Type = rigid body\n set Mass = 1\n set Inertia = 1, 1, 1\n end\n";
  text += "end\nsubsection Joints\n";
  for (const std::string name : {"A", "B"})
    text += " subsection " + name + "\n set Type = revolute\n set Body A = ground\n set Body B = wheel " + name +
            ".centre\n set Axis = " + (name == "A" ? "1, 0, 0" : "0, 3, 4") + "\n end\n";
  Scene two(text + "end\n");
  EXPECT_EQ(check_model(two.system).n_free_motions, 2u);
  Scene coupled(
    text + " subsection gear\n set Type = gear\n set Joint A = A\n set Joint B = B\n set Ratio = -2.5\n end\nend\n");
  EXPECT_EQ(check_model(coupled.system).n_free_motions, 1u);
  EXPECT_EQ(zero_modes(coupled), 1u);
  const auto    mode   = coupled.modes().at(0).shape;
  const Vector3 spin_A = mode.segment<3>(3).real(), spin_B = mode.segment<3>(9).real();
  EXPECT_LT((spin_B + 2.5 * spin_A(0) * Vector3(0, 0.6, 0.8)).norm(), 1e-9 * spin_A.norm());
  EXPECT_LT(spin_A.tail<2>().norm(), 1e-9 * spin_A.norm());
}



// A section without rotary inertia: a beam in flight may spin about its line, and no equation says how. An inertia, a
// damper, or a clamp does.
TEST(FreeMotions, WithoutInertia)
{
  const auto massless = [](const std::string &of_section, const std::string &more) {
    const Scene scene(R"(
subsection Sections
  subsection wire
    set Type = engineering constants
    set EA = 1e6
    set GA2 = 1e6
    set GA3 = 1e6
    set GJ = 10
    set EI2 = 10
    set EI3 = 10
    set Mass = 0.1
)" + of_section + R"(
  end
end
subsection Bodies
  subsection line
    set Type = beam
    set Points = 0, 0, 0; 3, 0, 4
    set Section = wire
    set Elements = 2
  end
end
)" + more);
    return check_model(scene.system).massless;
  };
  const std::string hinge = "subsection Joints\n subsection hinge\n set Type = revolute\n set Body A = ground\n"
                            " set Body B = line.start\n set Axis = 3, 0, 4\n",
                    end   = " end\nend\n";
  const std::vector<std::string> spin = {"line, turning about (0.6, 0, 0.8)"};
  EXPECT_EQ(massless("", ""), spin);
  EXPECT_EQ(massless("", hinge + end).size(), 1u);
  EXPECT_TRUE(massless("set I2 = 1e-9\nset I3 = 1e-9\n", "").empty());
  EXPECT_TRUE(massless("", hinge + " subsection rotation\n set Damper = 1e-3\n end\n" + end).empty());
}



// What is drawn of them moves with velocities that the constraints allow, and every motion is a combination of those.
TEST(FreeMotions, ShapesThatAreDrawn)
{
  for (const auto &[name, kind] : kinds())
    for (const bool used : {false, true})
      {
        Scene      scene(body_on_joint(name, kind.entries, used));
        const auto check = check_model(scene.system);
        ASSERT_EQ(check.shapes.size(), kind.n_free) << name;
        if (kind.n_free == 0)
          continue;
        Eigen::MatrixXd all(6, kind.n_free);
        for (unsigned int k = 0; k < kind.n_free; ++k)
          {
            State state = scene.system.reference();
            state.held  = false;
            std::copy_n(check.shapes[k].data(), 6, state.y.begin() + 6);
            std::copy_n(check.shapes[k].data() + 6, state.rates.size(), state.rates.begin());
            std::vector<double> rates(scene.system.layout.n_multipliers);
            scene.system.constraint_rates(state.point(), rates.data());
            for (const double rate : rates)
              EXPECT_LT(std::abs(rate), 1e-6 * check.shapes[k].norm()) << name;
            all.col(k) = check.shapes[k].head<6>();
          }
        EXPECT_EQ(FullLu(all).rank(), static_cast<int>(kind.n_free)) << name;
      }
}
