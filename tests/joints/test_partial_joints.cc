// Joints that hold less than a lower pair, against closed forms: constant velocity at any angle, a bead on a cycloid,
// which swings with one frequency whatever its amplitude, forces and momenta, and what is refused.

#include <samara/analysis/dynamic.h>
#include <samara/model/signal.h>

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  /** Two shafts with a bend @p bend [rad], the first turned by @p angle [rad], as in
   * prm/examples/constant_velocity.prm. */
  Vector3
  rotation_of_second(const std::string &kind, const double bend, const double angle)
  {
    const std::string        axis      = "sin(" + std::to_string(bend) + "), 0, cos(" + std::to_string(bend) + ")";
    std::string              text      = "prm/examples/constant_velocity.prm";
    std::vector<std::string> overrides = {"Joints/drive/rotation/Prescribed = " + std::to_string(angle),
                                          "Joints/bend/Second axis = " + (kind == "universal" ? "0, 1, 0" : axis),
                                          "Joints/bearing/Axis = " + axis,
                                          "Static/Load steps = 8",
                                          "Bodies/second/Frames = tip at " + std::to_string(std::sin(bend)) + " 0 " +
                                            std::to_string(std::cos(bend)),
                                          "Joints/bearing/Gap = allowed"};
    if (kind == "universal")
      {
        overrides.push_back("Joints/bend/Type = universal");
        overrides.push_back("Joints/bend/Axis = 1, 0, 0");
      }
    Scene scene(text, overrides);
    scene.equilibrium();
    return M_PI / 180 *
           Vector3(scene.value("second.rotation x"),
                   scene.value("second.rotation y"),
                   scene.value("second.rotation z"));
  }

  const double r = 0.5, g_of_bead = 9.80665;

  /** A bead on a cycloid x = r (θ + sin θ), z = r (1 − cos θ), at θ = @p start at rest; θ goes from -2.8 to 2.8. */
  std::string
  bead(const double start, const double step, const unsigned int stages)
  {
    const auto        text  = [](const double x) { return number_to_text(x); };
    const std::string theta = "(5.6*s - 2.8)";
    return "set Analyses = dynamic\nsubsection Bodies\n subsection bead\n set Type = rigid body\n set Mass = 2\n"
           " set Inertia = 1, 1, 1\n set Position = " +
           text(r * (start + std::sin(start))) + ", 0, " + text(r * (1 - std::cos(start))) +
           "\n end\nend\nsubsection Joints\n subsection wire\n set Type = point on curve\n set Body A = ground\n set Body B = bead\n"
           " set Expressions = 0.5*(" +
           theta + " + sin" + theta + "), 0, 0.5*(1 - cos" + theta +
           ")\n end\nend\nsubsection Loads\n subsection weight\n set Type = gravity\n end\nend\nsubsection Dynamic\n"
           " set End time = 2\n set Spectral radius = 1\n set Step = " +
           text(step) + "\n set Stages = " + std::to_string(stages) + "\nend\n";
  }
} // namespace



TEST(PartialJoints, ConstantVelocityAtAnyAngle)
{
  for (const double bend : {0.2, 0.61, 1.2})
    for (const double angle : {0.3, 1.1, 2.5})
      {
        const Vector3 axis(std::sin(bend), 0, std::cos(bend));
        EXPECT_LT((rotation_of_second("constant velocity", bend, angle) - angle * axis).norm(), 2e-6)
          << bend << ", " << angle;
      }
  // a universal joint does not do that: tan of one angle is that of the other times the cosine of the bend
  const double turned = rotation_of_second("universal", 0.61, 0.7).norm();
  EXPECT_GT(std::abs(turned - 0.7), 0.05);
}



// Huygens: the arc length σ from the lowest point obeys σ̈ = −g/(4 r) σ, whatever the amplitude. Energy is kept to
// round-off though the constraints are not quadratic, and the order is 2 s.
TEST(PartialJoints, BeadOnACycloid)
{
  const double omega = std::sqrt(g_of_bead / (4 * r)), amplitude = 4 * r * std::sin(0.5 * 2.4);
  for (const unsigned int stages : {1, 2, 3})
    {
      std::vector<double> errors, errors_of_rate;
      for (const double step : {0.1, 0.05})
        {
          Scene scene(bead(2.4, step, stages), {"Dynamic/Newton tolerance = 1e-13"});
          auto &dynamic = scene.analysis<DynamicAnalysis>();
          dynamic.start(scene.context);
          dynamic.run(scene.context);
          errors.push_back(std::abs(scene.value("wire.displacement") - amplitude * (std::cos(omega * 2) - 1)));
          errors_of_rate.push_back(
            std::abs(scene.value("wire.displacement rate") + amplitude * omega * std::sin(omega * 2)));
          const double v_x = scene.value("bead.velocity x"), v_z = scene.value("bead.velocity z"),
                       energy = v_x * v_x + v_z * v_z + 2 * g_of_bead * scene.value("bead.position z");
          EXPECT_NEAR(energy, 2 * g_of_bead * r * (1 - std::cos(2.4)), 1e-8);
        }
      EXPECT_LT(errors[1], errors[0] * std::pow(0.5, 2. * stages - 0.5)) << stages << " stages: " << errors[0];
      EXPECT_LT(errors[1], stages == 1 ? 5e-2 : 1e-3);
      EXPECT_LT(errors_of_rate[1], stages == 1 ? 5e-2 : 2e-3); // not yet projected, as those of the output are
    }
}



// A bead on a closed curve goes round and round with the speed it has: a circle of radius 0.5 m in a plane that is no
// plane of the axes, given with another speed along s. It starts anywhere on it.
TEST(PartialJoints, BeadGoesRound)
{
  const std::string angle = "(2*pi*s + 0.4*sin(2*pi*s))", inclined = "sqrt(0.5)*0.5*sin" + angle;
  const double      start = 0.8, v = 11;
  const auto        place = [](const double angle) {
    return Vector3(0.5 * std::cos(angle),
                   std::sqrt(0.5) * 0.5 * std::sin(angle),
                   std::sqrt(0.5) * 0.5 * std::sin(angle));
  };
  const auto text_of = [](const Vector3 &x) {
    return number_to_text(x(0)) + ", " + number_to_text(x(1)) + ", " + number_to_text(x(2));
  };
  const Vector3 tangent = (place(start + 1e-3) - place(start - 1e-3)).normalized();
  Scene scene("set Analyses = dynamic\nsubsection Bodies\n subsection bead\n set Type = rigid body\n set Mass = 2\n"
              " set Inertia = 1, 1, 1\n set Position = " +
              text_of(place(start)) + "\n set Velocity = " + text_of(v * tangent) +
              "\n end\nend\nsubsection Joints\n subsection wire\n set Type = point on curve\n set Body A = ground\n"
              " set Body B = bead\n set Expressions = 0.5*cos" +
              angle + ", " + inclined + ", " + inclined +
              "\n end\nend\nsubsection Dynamic\n set End time = 2\n set Step = 0.01\n set Spectral radius = 1\nend\n");
  auto &dynamic = scene.analysis<DynamicAnalysis>();
  dynamic.start(scene.context);
  dynamic.run(scene.context);
  EXPECT_NEAR(std::hypot(scene.value("bead.velocity x"),
                         scene.value("bead.velocity y"),
                         scene.value("bead.velocity z")),
              v,
              1e-8 * v);
  EXPECT_NEAR(scene.value("wire.displacement rate"), v, 1e-5 * v);
  const double displacement = scene.value("wire.displacement");
  EXPECT_NEAR(displacement, 2 * v, 1e-4 * v);
  EXPECT_NEAR(scene.value("wire.arc length"), displacement + 0.5 * start, 1e-10);
  const Vector3 expected = place(start + displacement / 0.5);
  EXPECT_NEAR(scene.value("bead.position x"), expected(0), 1e-9);
  EXPECT_NEAR(scene.value("bead.position z"), expected(2), 1e-9);
  EXPECT_NEAR(scene.value("wire.force"), 2 * v * v / 0.5, 5.);
}



// Two free bodies, one of them with a curve: energy, momentum and moment of momentum stay.
TEST(PartialJoints, CurveOnAMovingBody)
{
  const auto body = [](const std::string &name, const std::string &more) {
    return " subsection " + name + "\n set Type = rigid body\n set Mass = 2\n set Inertia = 1, 1.5, 2\n" + more +
           " end\n";
  };
  const auto momenta_at = [&](const std::string &end_time, double &displacement) {
    Scene scene("set Analyses = dynamic\nsubsection Bodies\n" +
                body("a", " set Position = 0.3, 0.2, 0.5\n set Angular velocity = 0.5, -1, 2\n") +
                body("b", " set Position = 1, 1, 1\n set Frames = eye at 0.5 0.25 0.1\n set Velocity = 0, 1, 0\n") +
                "end\nsubsection Joints\n subsection wire\n set Type = point on curve\n set Body A = a\n"
                " set Body B = b.eye\n set Expressions = s, s^2, 0.1*exp(s - 0.5)\n end\nend\nsubsection Dynamic\n"
                " set End time = " +
                end_time + "\n set Step = 0.05\n set Spectral radius = 1\nend\n");
    auto &dynamic = scene.analysis<DynamicAnalysis>();
    dynamic.start(scene.context);
    dynamic.run(scene.context);
    displacement = scene.value("wire.displacement");
    // the centres of mass are the nodes, and the axes of the bodies those of their inertia
    Eigen::Matrix<double, 7, 1> sum = Eigen::Matrix<double, 7, 1>::Zero();
    for (const unsigned int node : {1, 2})
      {
        const State  &state = scene.context.state;
        const Matrix3 D     = state.triad(node);
        const Vector3 u(&state.y[6 * node]), w(&state.y[6 * node + 3]), p = 2 * D * u,
                                                                        l = Vector3(1, 1.5, 2).cwiseProduct(w);
        sum.head<3>() += p;
        sum.segment<3>(3) += D * l + state.position(node).cross(p);
        sum(6) += 0.5 * (2 * u.squaredNorm() + w.dot(l));
      }
    return sum;
  };
  double     first = 0, last = 0;
  const auto before = momenta_at("0.05", first), after = momenta_at("1", last);
  EXPECT_GT(std::abs(last - first), 0.05);
  EXPECT_LT((after - before).head<6>().norm(), 1e-8 * before.norm());
  EXPECT_NEAR(after(6), before(6), 1e-8 * before(6));
}



namespace
{
  /** Two free bodies, one of them with a curve: what @p moved by, and in lengths of so many metres. */
  double
  slide_on_a_moving_body(const Vector3 &moved, const double metre)
  {
    const auto vector = [&](const double x, const double y, const double z, const double unit) {
      return number_to_text(unit * x) + ", " + number_to_text(unit * y) + ", " + number_to_text(unit * z);
    };
    const auto body = [&](const std::string &name, const Vector3 &x, const std::string &more) {
      const Vector3 place = x + moved;
      return " subsection " + name +
             "\n set Type = rigid body\n set Mass = 2\n set Inertia = " + vector(1, 1.5, 2, metre * metre) +
             "\n set Position = " + vector(place(0), place(1), place(2), metre) + "\n" + more + " end\n";
    };
    const auto curve = [&](const double at, const std::string &more) {
      return number_to_text(metre * at) + " + " + number_to_text(metre) + "*(" + more + ")";
    };
    Scene scene(
      "set Analyses = dynamic\nsubsection Bodies\n" +
      body("a", {0.3, 0.2, 0.5}, " set Angular velocity = 0.5, -1, 2\n") +
      body("b", {0.5, 0.25, 0.1}, " set Velocity = " + vector(0, 1, 0, metre) + "\n") +
      "end\nsubsection Joints\n subsection wire\n set Type = point on curve\n set Body A = a\n"
      " set Body B = b\n set Expressions = " +
      curve(moved(0), "s") + ", " + curve(moved(1), "s^2") + ", " + curve(moved(2), "0.1*exp(s - 0.5)") +
      "\n end\nend\nsubsection Dynamic\n set End time = 1\n set Step = 0.1\n set Newton tolerance = 1e-13\nend\n");
    auto &dynamic = scene.analysis<DynamicAnalysis>();
    dynamic.start(scene.context);
    dynamic.run(scene.context);
    EXPECT_LT(dynamic.report.largest_balance, 1e-10);
    return scene.value("wire.displacement") / metre;
  }
} // namespace



// Steps are not small here, and do the same wherever the model is, and in whatever unit of length.
TEST(PartialJoints, CurvesDoNotKnowWhereTheModelIs)
{
  const double here = slide_on_a_moving_body({0, 0, 0}, 1);
  EXPECT_GT(std::abs(here), 0.05);
  EXPECT_NEAR(slide_on_a_moving_body({3, -8, 5}, 1), here, 1e-9);
  EXPECT_NEAR(slide_on_a_moving_body({0, 0, 0}, 1e-6), here, 1e-8);
  EXPECT_NEAR(slide_on_a_moving_body({0, 0, 0}, 1e3), here, 1e-8);
}



// A corner is one in all units.
TEST(PartialJoints, CornersOfCurvesAreRefused)
{
  for (const std::string unit : {"1", "1e-7", "1e6"})
    {
      std::string refusal;
      try
        {
          Scene scene(
            "subsection Bodies\n subsection b\n set Type = rigid body\n set Mass = 1\n set Inertia = 1, 1, 1\n end\nend\n"
            "subsection Joints\n subsection wire\n set Type = point on curve\n set Body A = ground\n"
            " set Body B = b\n set Expressions = " +
            unit + "*s, " + unit + "*abs(s - 0.3) - " + unit + "*0.3, 0\n end\nend\n");
        }
      catch (const std::exception &problem)
        {
          refusal = problem.what();
        }
      EXPECT_NE(refusal.find("has a corner at s = 0.3"), std::string::npos) << unit << ": " << refusal;
    }
}



// Beyond its end a curve goes on straight, and along the axes that are asked for the force is what they say.
TEST(PartialJoints, BeyondTheEndOfACurve)
{
  const std::string text =
    "set Analyses = dynamic\nsubsection Bodies\n subsection bead\n set Type = rigid body\n set Mass = 2\n"
    " set Inertia = 1, 1, 1\n set Velocity = 3, 0, 4\n end\nend\nsubsection Joints\n subsection wire\n"
    " set Type = point on curve\n set Body A = ground\n set Body B = bead\n set Axis = 4, 0, -3\n"
    " set Axis 1 = 0, 1, 0\n set Expressions = 3*s, 0, 4*s\n end\nend\nsubsection Loads\n"
    " subsection push\n set Type = point load\n set At = bead\n set Force = 4, 5, -3\n end\nend\n"
    "subsection Dynamic\n set End time = 2\n set Step = 0.1\nend\n";
  Scene scene(text);
  auto &dynamic = scene.analysis<DynamicAnalysis>();
  dynamic.start(scene.context);
  dynamic.run(scene.context);
  EXPECT_NEAR(scene.value("wire.displacement"), 10, 1e-10);
  EXPECT_NEAR(scene.value("bead.position z"), 8, 1e-10);
  EXPECT_NEAR(scene.value("wire.force 1"), -5, 1e-9);
  EXPECT_NEAR(scene.value("wire.force 2"), 0, 1e-9);
  EXPECT_NEAR(scene.value("wire.force 3"), -5, 1e-9);
}



// Shafts with a bend that turn freely: both keep the speed for turns; and the drive of a steady rotation turns both.
TEST(PartialJoints, ConstantVelocityInMotion)
{
  std::ifstream     file(SAMARA_SOURCE_DIR "/prm/examples/constant_velocity.prm");
  std::stringstream content;
  content << file.rdbuf();
  std::string text = content.str();
  text.erase(text.find("set Prescribed = 40 deg"), 23);
  const Vector3 axis(std::sin(35 * M_PI / 180), 0, std::cos(35 * M_PI / 180));
  const auto    expect_speed = [&](const Scene &scene, const double speed) {
    for (unsigned int i = 0; i < 3; ++i)
      EXPECT_NEAR(scene.value(std::string("second.angular velocity ") + "xyz"[i]), speed * axis(i), 1e-8);
  };
  Scene scene(text + "subsection Dynamic\n set End time = 4\n set Step = 0.05\nend\n",
              {"Analyses = dynamic",
               "Bodies/first/Angular velocity = 0, 0, 3",
               "Bodies/second/Angular velocity = 3*sin(35 deg), 0, 3*cos(35 deg)"});
  auto &dynamic = scene.analysis<DynamicAnalysis>();
  dynamic.start(scene.context);
  dynamic.run(scene.context);
  expect_speed(scene, 3);

  Scene turning(text + "subsection Loads\n subsection turning\n set Type = steady rotation\n set Joint = drive\n"
                       " set Speed = 7\n end\nend\n");
  turning.equilibrium();
  expect_speed(turning, 7);
  // where the bend stands still is not known to what looks for steady motions; with a universal joint rates would vary
  EXPECT_NE(turning.stream.str().find("rates are constant"), std::string::npos);
}



namespace
{
  /** A force and a moment of a joint on its second body, of two free ones, about the place of the joint there;
   * inertial. */
  std::pair<Vector3, Vector3>
  wrench_on_b(const Scene &scene, const State &state, const Vector3 &place)
  {
    std::vector<double> r(scene.system.size() + 6, 0.);
    scene.system.add_constraints(state.point(), r.data());
    const int     i = scene.system.layout.of_node(2);
    const Matrix3 D = state.triad(2);
    const Vector3 f = -D * Eigen::Map<const Vector3>(&r[i]), m = -D * Eigen::Map<const Vector3>(&r[i + 3]);
    return {f, m + (state.position(2) - place).cross(f)};
  }
} // namespace



// Forces and moments of A on B, of any multipliers in any state, as probes and as signals for laws; they have no power
// in motions that the joint allows, which the tangent says.
TEST(PartialJoints, ForcesAndMoments)
{
  const Vector3 a3 = Vector3(1, 2, 2) / 3., a1 = Vector3(2, 1, -2) / 3.;
  for (const std::string kind : {"constant velocity", "in line", "in plane"})
    {
      Scene scene(
        "subsection Bodies\n subsection a\n set Type = rigid body\n set Mass = 3\n set Inertia = 1, 2, 2.5\n"
        " set Position = 0.2, -0.1, 0.4\n end\n subsection b\n set Type = rigid body\n set Mass = 2\n"
        " set Inertia = 1, 1.5, 2\n set Position = 1, 0.7, 0.3\n set Frames = joint at 0.8 0.9 0.5\n end\nend\n"
        "subsection Joints\n subsection j\n set Body A = a\n set Body B = b.joint\n set Axis = 1, 2, 2\n"
        " set Axis 1 = 2, 1, -2\n set Type = " +
        kind + "\n end\nend\n");
      const State         start = scene.system.reference();
      State               state = start;
      std::vector<double> z(scene.system.size());
      for (unsigned int i = 0; i < z.size(); ++i)
        z[i] = 0.4 * std::sin(1.3 * i + 0.2);
      scene.system.update(state, z);
      for (unsigned int i = 0; i < state.multipliers.size(); ++i)
        state.multipliers[i] = 3 - 2. * i;
      const Matrix3 turn         = state.triad(1) * start.triad(1).transpose(),
                    turn_b       = state.triad(2) * start.triad(2).transpose();
      const Vector3 place        = state.position(2) + turn_b * (Vector3(0.8, 0.9, 0.5) - start.position(2));
      const auto [force, moment] = wrench_on_b(scene, state, place);
      const Vector3 axes[]       = {turn * a1, turn * a3.cross(a1), turn * a3};
      for (unsigned int i = 0; i < 3; ++i)
        for (const bool is_moment : {false, true})
          {
            const std::string name     = (is_moment ? "j.moment " : "j.force ") + std::to_string(i + 1);
            const double      expected = axes[i].dot(is_moment ? moment : force);
            const bool        is_there = is_moment          ? kind == "constant velocity" :
                                         kind != "in plane" ? kind != "in line" || i < 2 :
                                                              i == 2;
            if (!is_there)
              {
                EXPECT_NEAR(expected, 0, 1e-14) << kind << name;
                EXPECT_THROW(scene.input.model.probe(name), std::invalid_argument) << kind << name;
                continue;
              }
            EXPECT_NEAR(scene.input.model.probe(name).value(state), expected, 1e-14) << kind << name;
            const auto signal = scene.input.model.signal(name);
            signal->resolve(scene.input.model);
            EXPECT_NEAR(signal->value(state.point()), expected, 1e-14) << kind << name;
          }
      if (kind == "constant velocity") // where it holds, the moment is along E₃ᴬ + E₃ᴮ
        {
          State bent = start;
          z.assign(z.size(), 0.);
          const Vector3 tilt = start.triad(2).transpose() * a3.cross(Vector3(0.3, -0.4, 0.1));
          for (unsigned int i = 0; i < 3; ++i)
            z[scene.system.layout.of_node(2) + 3 + i] = tilt(i);
          scene.system.update(bent, z);
          bent.multipliers     = state.multipliers;
          const Matrix3 turned = bent.triad(2) * start.triad(2).transpose();
          const Vector3 sum    = a3 + turned * a3,
                        m      = wrench_on_b(scene, bent, Vector3::Zero()).second -
                            (bent.position(2) + turned * (Vector3(0.8, 0.9, 0.5) - start.position(2)))
                              .cross(wrench_on_b(scene, bent, Vector3::Zero()).first);
          EXPECT_GT(m.norm(), 1.);
          EXPECT_LT(m.cross(sum).norm(), 1e-13);
        }
    }
}



TEST(PartialJoints, RefusedShafts)
{
  const auto with = [](const std::string &entries) {
    return complaint_of(
      "subsection Bodies\n subsection a\n set Type = rigid body\n set Mass = 1\n set Inertia = 1, 1, 1\n end\nend\n"
      "subsection Joints\n subsection j\n set Body A = ground\n set Body B = a\n" +
      entries + " end\nend\n");
  };
  const std::string bend = "set Type = constant velocity\n set Axis = 0, 0, 1\n set Second axis = ",
                    skew = "set Type = skew universal\n";
  EXPECT_EQ(with(bend + "1, 0, 1\n"), "");
  EXPECT_NE(with(bend + "0, 0, -1\n").find("point against each other"), std::string::npos);
  EXPECT_EQ(with(skew + "set Axis = 1, 0, 0\n set Second axis = 1, 0.1, 0\n"), "");
  EXPECT_NE(with(skew + "set Axis = 1, 0, 0\n set Second axis = 2, 0, 0\n"), "");
  EXPECT_NE(with(skew + "set Axis = 1, 0, 0\n set Second axis = 0, 0, 0\n"), "");
  EXPECT_NE(with("set Type = in line\n set Axis = 0, 0, 0\n").find("direction must not be zero"), std::string::npos);
}



TEST(PartialJoints, RefusedCurves)
{
  const auto with = [](const std::string &expressions) {
    std::string text = bead(0, 0.1, 1);
    const auto  at   = text.find("set Expressions = ") + 18;
    text.replace(at, text.find('\n', at) - at, expressions);
    return complaint_of(text);
  };
  EXPECT_EQ(with("s - 0.5, 0, 0"), "");
  EXPECT_NE(with("s + 0.5, 0, 0").find("the curve is 0.5 m away from <bead>"), std::string::npos);
  EXPECT_NE(with("abs(s - 0.5), 0, s - 0.5").find("corner"), std::string::npos);
  EXPECT_NE(with("(s - 0.5)^3, 0, 0").find("stands still"), std::string::npos);
  EXPECT_NE(with("0, 0, 0").find("stands still"), std::string::npos);
  EXPECT_NE(with("1/(s - 0.25), 0, 0"), "");
}
