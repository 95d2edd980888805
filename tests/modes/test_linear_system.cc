// Linear state spaces from controls to probes.
//
// Reference: transfer functions in closed form; motions in time by the integrator family.

#include <samara/analysis/linear_system.h>
#include <samara/base/dense.h>
#include <samara/time/period_map.h>

#include "../hdf5_layout.h"
#include <gtest/gtest.h>

#include <filesystem>

#include "modes.h"

using namespace samara;

namespace
{
  using Complex = std::complex<double>;

  /** A shipped model, whose first state is a control. */
  std::string
  with_control(const std::string &file, const std::string &name, const std::string &unit)
  {
    const std::ifstream in(std::string(SAMARA_SOURCE_DIR) + "/" + file);
    std::ostringstream  text;
    text << in.rdbuf();
    std::string       result = text.str();
    const std::string states = "subsection States\n";
    return result.insert(result.find(states) + states.size(),
                         "  subsection " + name + "\n    set Type = control\n    set Unit = " + unit + "\n  end\n");
  }

  /** A blade on a lag hinge that turns, with a filtered damper, and a torque on the hinge. */
  std::string
  blade_with_torque()
  {
    return with_control("prm/examples/laws/lag_damper.prm", "torque", "N*m");
  }

  const std::vector<std::string> by_torque = {"Joints/lag/rotation/Moment = -400 N*m*s * filtered + torque"};

  void
  look_at(Scene &scene, const std::vector<std::string> &probes)
  {
    for (const auto &probe : probes)
      scene.context.probes.push_back(scene.input.model.probe(probe));
  }

  std::string
  refusal_of(const std::string &model, const std::vector<std::string> &overrides)
  {
    try
      {
        Scene scene(model, overrides);
        scene.analysis<LinearSystemAnalysis>().run(scene.context);
      }
    catch (const std::runtime_error &problem)
      {
        return problem.what();
      }
    return "";
  }
} // namespace



// m x'' + c x' + k x = F with m = 2 kg, c = 20 N s/m, k = 200 N/m; the acceleration follows the force at once.
TEST(LinearSystems, OfAMassOnASpring)
{
  Scene scene("prm/examples/trim/shaken_mass.prm", {});
  look_at(scene, {"slide.displacement", "mass.velocity x", "mass.acceleration x"});
  auto &analysis = scene.analysis<LinearSystemAnalysis>();
  analysis.run(scene.context);
  const LinearSystem &space = analysis.space;
  EXPECT_EQ(space.A.rows(), 2);
  EXPECT_EQ(space.inputs, (std::vector<std::string>{"bias", "cosine", "sine"}));
  const std::vector<double> omega = {0., 3., 10., 200.};
  const auto                all   = space.responses(omega);
  for (unsigned int k = 0; k < omega.size(); ++k)
    {
      const Complex s(0, omega[k]), H = 1. / (2. * s * s + 20. * s + 200.);
      EXPECT_LT(std::abs(all[k](0, 0) - H), 1e-9 * std::abs(H));
      EXPECT_LT(std::abs(all[k](1, 0) - s * H), 1e-9 * std::abs(H) * (1 + omega[k]));
      EXPECT_LT(std::abs(all[k](2, 0) - s * s * H), 1e-8 * (std::abs(s * s * H) + 1e-3));
      EXPECT_LT(std::abs(all[k](0, 1) - H), 1e-9 * std::abs(H)); // cosine*cos(omega t) at t = 0
      EXPECT_LT(std::abs(all[k](0, 2)), 1e-9 * std::abs(H));
    }
}



// (I s² + 0.3 S Ω² + 400 s/(1 + 0.05 s)) θ = M, seen in degrees; the filter is a state of first order.
TEST(LinearSystems, OfABladeThatTurns)
{
  Scene scene(blade_with_torque(), by_torque);
  look_at(scene, {"lag.rotation", "filtered"});
  scene.equilibrium();
  auto &analysis = scene.analysis<LinearSystemAnalysis>();
  analysis.run(scene.context);
  const LinearSystem &space = analysis.space;
  ASSERT_EQ(space.A.rows(), 3);
  const std::vector<double> omega = {0.1, 5., 8.7, 100.};
  const auto                all   = space.responses(omega);
  for (unsigned int k = 0; k < omega.size(); ++k)
    {
      const Complex s(0, omega[k]), filter = s / (1. + 0.05 * s),
                                    H = 1. / (140. * s * s + 0.3 * 40 * 900 + 400. * filter);
      EXPECT_LT(std::abs(all[k](0, 0) * M_PI / 180. - H), 1e-8 * std::abs(H)) << omega[k];
      EXPECT_LT(std::abs(all[k](1, 0) - filter * H), 1e-8 * std::abs(filter * H)) << omega[k];
    }

  // a step of the torque, in time
  const double T = 0.7, step = 0.5;
  PeriodMap    map(scene.system, PeriodSettings{T, 280, 3, 1., 1e-12, 50});
  State        start = scene.context.state;
  start.held         = false;
  ASSERT_EQ(scene.system.model.states[0].name, "torque");
  start.states[0] += step;
  const State           end = map.march(start);
  const Eigen::MatrixXd e   = exponential(space.A * T);
  const Eigen::VectorXd x = solution(space.A, (e - Eigen::MatrixXd::Identity(3, 3)) * space.B.col(0) * step);
  for (unsigned int i = 0; i < 2; ++i)
    {
      const double expected = space.C.row(i) * x;
      EXPECT_NEAR(scene.context.probes[i].value(end) - space.output_values[i], expected, 1e-6 * std::abs(expected));
    }
}



// Driven for so long that its start is forgotten, the blade follows with the amplitude and the phase of the response.
TEST(LinearSystems, ResponseIsThatOfARunInTime)
{
  const double omega = 12, torque = 2, T = 2 * M_PI / omega;
  Scene        scene(blade_with_torque(), by_torque);
  look_at(scene, {"lag.rotation", "filtered"});
  scene.equilibrium();
  auto &analysis = scene.analysis<LinearSystemAnalysis>();
  analysis.run(scene.context);
  const Eigen::MatrixXcd H = analysis.space.responses({omega})[0];

  Scene driven(blade_with_torque(), {"Joints/lag/rotation/Moment = -400 N*m*s * filtered + 2 N*m*cos(12 rad/s*t)"});
  look_at(driven, {"lag.rotation", "filtered"});
  driven.equilibrium();
  State                     start = driven.context.state;
  const unsigned int        n     = 48;
  std::vector<Complex>      sums(2, 0.);
  const std::vector<double> at_rest = {driven.context.probes[0].value(start), driven.context.probes[1].value(start)};
  start.held                        = false;
  start = PeriodMap(driven.system, PeriodSettings{40 * T, 40 * n, 3, 1., 1e-12, 50}).march(start);
  PeriodMap step(driven.system, PeriodSettings{T / n, 1, 3, 1., 1e-12, 50});
  for (unsigned int k = 0; k < n; ++k)
    {
      for (unsigned int i = 0; i < 2; ++i)
        sums[i] += 2. / n * (driven.context.probes[i].value(start) - at_rest[i]) * std::polar(1., -omega * start.time);
      start = step.march(start);
    }
  for (unsigned int i = 0; i < 2; ++i)
    EXPECT_LT(std::abs(sums[i] - H(i, 0) * torque), 1e-5 * std::abs(H(i, 0) * torque)) << i << sums[i] << H(i, 0);
}



// Poles are those of the modes, also of beams that turn, with their viscosity.
TEST(LinearSystems, HaveThePolesOfModes)
{
  const std::string arm = R"(
set Analyses = static, modal
subsection Sections
  subsection s
    set Type = engineering constants
    set EA = 1e6
    set GA2 = 1e5
    set GA3 = 1e5
    set GJ = 50
    set EI2 = 40
    set EI3 = 90
    set Mass = 1
    set I2 = 1e-3
    set I3 = 1e-3
  end
end
subsection States
  subsection push
    set Type = control
    set Unit = N
  end
end
subsection Bodies
  subsection arm
    set Type = beam
    set Points = 0, 0, 0; 1, 0, 0
    set Axis 2 = 0, 1, 0
    set Elements = 1
    set Section = s
    set Damping ratio = 0.02
    set Damping frequency = 20
  end
end
subsection Joints
  subsection root
    set Type = rigid
    set Body A = ground
    set Body B = arm.start
  end
end
subsection Loads
  subsection turning
    set Type = steady rotation
    set Axis = 0, 0, 1
    set Speed = 8
  end
  subsection tip
    set Type = point load
    set At = arm.end
    set Force = 0, 0, push
  end
end
subsection Modal
  set Modes = 4
end
)";
  Scene             scene(arm);
  look_at(scene, {"arm.end.displacement z"});
  scene.equilibrium();
  const auto modes    = scene.modes();
  auto      &analysis = scene.analysis<LinearSystemAnalysis>();
  analysis.run(scene.context);
  const Eigen::VectorXcd poles = general_eigenvalues(analysis.space.A);
  for (const auto &mode : modes)
    // a free one is the control, which keeps its value
    EXPECT_TRUE(mode.is_free() || (poles.array() - mode.lambda).abs().minCoeff() < 1e-8 * mode.frequency());
  // slow pushes meet the stiffness: that of statics
  const double static_response = analysis.space.responses({0.})[0](0, 0).real();
  Scene        pushed(arm, {"States/push/Value = 0.001"});
  pushed.equilibrium();
  EXPECT_NEAR(pushed.value("arm.end.displacement z"), 0.001 * static_response, 1e-7 * 0.001 * static_response);
}



TEST(LinearSystems, AreReadBackFromTheirFile)
{
  const std::string folder = "linear_system_" + std::to_string(getpid());
  std::filesystem::create_directory(folder);
  Scene scene(blade_with_torque(), by_torque);
  look_at(scene, {"lag.rotation", "filtered"});
  scene.equilibrium();
  scene.context.folder = folder;
  auto &analysis       = scene.analysis<LinearSystemAnalysis>();
  analysis.run(scene.context);
  {
    const PlainFile     file(folder + "/linear_system.h5");
    const LinearSystem &space = analysis.space;
    EXPECT_EQ(
      file.names(),
      (std::set<std::string>{
        "A", "B", "C", "D", "input values", "output values", "inputs", "input units", "outputs", "output units"}));
    ASSERT_EQ(space.C.rows(), 2);
    ASSERT_EQ(space.C.cols(), 3);
    EXPECT_NE(space.A, space.A.transpose()); // so that a transposed one would be seen
    EXPECT_EQ(file.matrix("A"), space.A);
    EXPECT_EQ(file.matrix("B"), space.B);
    EXPECT_EQ(file.matrix("C"), space.C);
    EXPECT_EQ(file.matrix("D"), space.D);
    EXPECT_EQ(file.matrix("output values").col(0),
              Eigen::Map<const Eigen::VectorXd>(space.output_values.data(), space.output_values.size()));
    EXPECT_EQ(file.texts("inputs"), space.inputs);
    EXPECT_EQ(file.texts("outputs"), (std::vector<std::string>{"lag.rotation", "filtered"}));
    EXPECT_EQ(file.texts("output units"), space.output_units);
    EXPECT_EQ(file.texts("input units"), (std::vector<std::string>{"N*m"}));
  }
  std::filesystem::remove_all(folder);
}



// What nothing can move has no states, but the clamp carries the push at once: y = D u.
TEST(LinearSystems, OfWhatNothingMoves)
{
  Scene scene("subsection States\n subsection push\n set Type = control\n set Unit = N\n end\nend\n"
              "subsection Bodies\n subsection mass\n set Type = rigid body\n set Mass = 2 kg\n set Inertia = 1, 1, 1\n end\nend\n"
              "subsection Joints\n subsection clamp\n set Type = rigid\n set Body A = ground\n set Body B = mass.centre\n"
              " set Reaction = true\n end\nend\n"
              "subsection Loads\n subsection hand\n set Type = point load\n set At = mass.centre\n set Force = push, 0, 0\n"
              " end\nend\n",
              {});
  look_at(scene, {"mass.displacement x", "clamp.force 1", "clamp.force 2", "clamp.force 3"});
  auto &analysis = scene.analysis<LinearSystemAnalysis>();
  analysis.run(scene.context);
  const LinearSystem &space = analysis.space;
  EXPECT_EQ(space.A.rows(), 0);
  ASSERT_EQ(space.D.rows(), 4);
  EXPECT_NEAR(space.D(0, 0), 0, 1e-12);
  EXPECT_NEAR(space.D.col(0).norm(), 1, 1e-9);
  const auto at_3 = space.responses({3.});
  ASSERT_EQ(at_3.size(), 1);
  EXPECT_NEAR(std::abs(at_3[0].norm() - 1), 0, 1e-9);
}



TEST(LinearSystems, WhatHasNone)
{
  const auto has = [](const std::string &text, const std::string &piece) {
    return text.find(piece) != std::string::npos;
  };
  const std::string mass = "prm/examples/trim/shaken_mass.prm";
  std::string       text = refusal_of(mass,
                                {"Analyses = linear system",
                                       "Joints/slide/displacement/Prescribed = 1e-3*bias",
                                       "Joints/slide/displacement/Force = 0"});
  EXPECT_TRUE(has(text, "prescribes a motion")) << text;
  text = refusal_of("prm/examples/first_model.prm", {"Analyses = linear system"});
  EXPECT_TRUE(has(text, "no inputs")) << text;
  text = refusal_of(mass, {"Analyses = linear system", "Bodies/mass/Mass = 0", "Bodies/mass/Inertia = 0, 0, 0"});
  EXPECT_TRUE(has(text, "mass")) << text;
}
