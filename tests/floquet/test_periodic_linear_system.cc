/*
 * Problem:   state spaces about periodic motions
 * Reference: multipliers of Mathieu's equation (test_multipliers.cc); motions in time; modes of Hammond's rotor
 */

#include <samara/analysis/floquet.h>
#include <samara/analysis/periodic_linear_system.h>
#include <samara/base/dense.h>
#include <samara/base/errors.h>

#include "../hdf5_layout.h"
#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "floquet_models.h"

using namespace samara;
using namespace floquet_models;

namespace
{
  std::string
  with(const std::string &model, const std::string &more)
  {
    std::ostringstream text;
    text << std::ifstream(std::string(SAMARA_SOURCE_DIR) + "/" + model).rdbuf() << more;
    return text.str();
  }

  const std::string pushed = R"(
subsection States
  subsection push
    set Type = control
    set Unit = N*m
  end
end
subsection Periodic linear system
  set Period  = pi
  set Samples = 12
  set Steps   = 3
end
subsection Output
  set Probes = hinge.rotation, hinge.moment 3, bob.centre of mass.acceleration x
end
)";

  PeriodicLinearSystem
  space_of(Scene &scene)
  {
    scene.context.probes = scene.input.make_probes();
    auto &analysis       = scene.analysis<PeriodicLinearSystemAnalysis>();
    analysis.run(scene.context);
    return analysis.space;
  }
} // namespace



// The product of the samples is the map over the period, and a moment that is put on for a period moves the pendulum as
// in time.
TEST(PeriodicLinearSystem, PendulumOnAMovingHinge)
{
  const std::string              model   = with(pendulum, pushed);
  const std::vector<std::string> entries = {"Analyses = periodic linear system", "Joints/hinge/rotation/Moment = push"};
  Scene                          scene(model, entries);
  const auto                     space       = space_of(scene);
  const auto                     multipliers = space.multipliers();
  ASSERT_EQ(multipliers.size(), 2u);
  EXPECT_NEAR(multipliers[0].real(), -1.26394066521, 1e-7);
  EXPECT_NEAR(multipliers[1].real(), -0.676167816003, 1e-7);

  const double    u = 1e-5;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2);
  for (const auto k : {0u, 1u, 2u, 3u, 4u})
    x = space.A[k] * x + space.B[k] * u;
  const Eigen::VectorXd y = space.C[5] * x + space.D[5] * u;

  Scene     march(model, entries);
  PeriodMap map(march.system, {5 * M_PI / 12, 60, 3, 1.});
  State     state = scene.analysis<PeriodicLinearSystemAnalysis>().orbit;
  state.states[0] = u;
  state           = map.march(state);
  Projection(march.system).report(state, true);
  march.context.state = state;
  EXPECT_NEAR(y(0), march.value("hinge.rotation"), 1e-6 * std::abs(y(0)));
  EXPECT_NEAR(y(1), march.value("hinge.moment 3"), 1e-5 * std::abs(y(1)));
  EXPECT_NEAR(y(2), march.value("bob.centre of mass.acceleration x"), 1e-5 * std::abs(y(2)));
  EXPECT_GT(std::abs(y(0)), 0.1 * u);
}



// On a hinge that stands still, seen over a period all the same: θ = M/(I (a − ω² + i c ω)), I = 0.5 kg m².
TEST(PeriodicLinearSystem, FrequencyResponseOfTheMean)
{
  const std::string folder = "response_of_the_mean_" + std::to_string(getpid());
  std::filesystem::create_directory(folder);
  Scene scene(with(pendulum, pushed),
              {"Analyses = periodic linear system",
               "Constants/q = 0",
               "Constants/c = 0.2",
               "Joints/hinge/rotation/Moment = push",
               "Periodic linear system/Lowest frequency = 0.1",
               "Periodic linear system/Highest frequency = 10",
               "Periodic linear system/Frequencies = 3",
               "Output/Probes = hinge.rotation"});
  scene.context.folder = folder;
  space_of(scene);
  std::ifstream in(folder + "/frequency_response.csv");
  std::string   line;
  std::getline(in, line);
  for (const double omega : {0.1, 1., 10.})
    {
      ASSERT_TRUE(std::getline(in, line)) << omega;
      std::istringstream       words(line);
      std::vector<std::string> cells(8);
      for (auto &cell : cells)
        std::getline(words, cell, ',');
      EXPECT_NEAR(std::stod(cells[0]), omega, 1e-9);
      const std::complex<double> H(std::stod(cells[4]), std::stod(cells[5])),
        expected = 180 / M_PI / (0.5 * std::complex<double>(1 - omega * omega, 0.2 * omega));
      EXPECT_LT(std::abs(H - expected), 1e-6 * std::abs(expected)) << line;
    }
  EXPECT_FALSE(std::getline(in, line));
  std::filesystem::remove_all(folder);
}



// Matrices of the samples lie below each other; what is complex is two columns.
TEST(PeriodicLinearSystem, IsReadBackFromItsFile)
{
  const std::string folder = "periodic_linear_system_" + std::to_string(getpid());
  std::filesystem::create_directory(folder);
  Scene scene(with(pendulum, pushed), {"Analyses = periodic linear system", "Joints/hinge/rotation/Moment = push"});
  scene.context.folder = folder;
  const auto space     = space_of(scene);
  {
    const PlainFile file(folder + "/periodic_linear_system.h5");
    EXPECT_EQ(file.names(),
              (std::set<std::string>{"A",
                                     "B",
                                     "C",
                                     "D",
                                     "averaged A",
                                     "averaged B",
                                     "averaged C",
                                     "averaged D",
                                     "times",
                                     "multipliers",
                                     "input values",
                                     "output values",
                                     "inputs",
                                     "input units",
                                     "outputs",
                                     "output units"}));
    const Eigen::MatrixXd A = file.matrix("A"), B = file.matrix("B"), C = file.matrix("C"),
                          times = file.matrix("times");
    ASSERT_EQ(A.rows(), 24);
    ASSERT_EQ(times.rows(), 12);
    for (unsigned int k = 0; k < 12; ++k)
      {
        EXPECT_EQ(A.middleRows(2 * k, 2), space.A[k]) << k;
        EXPECT_EQ(B.middleRows(2 * k, 2), space.B[k]) << k;
        EXPECT_EQ(C.middleRows(3 * k, 3), space.C[k]) << k;
        EXPECT_NEAR(times(k, 0), k * M_PI / 12, 1e-12);
      }
    const Eigen::MatrixXd multipliers = file.matrix("multipliers");
    ASSERT_EQ(multipliers.cols(), 2);
    EXPECT_NEAR(multipliers(0, 0), -1.26394066521, 1e-7);
    EXPECT_EQ(multipliers(0, 1), 0);
    EXPECT_EQ(file.texts("inputs"), (std::vector<std::string>{"push"}));
    EXPECT_EQ(file.texts("outputs").size(), 3u);
  }
  std::filesystem::remove_all(folder);
}



// In steady rotation multiblade coordinates make the coefficients constant: then the mean has the multipliers of the
// period.
TEST(PeriodicLinearSystem, RotorInMultibladeCoordinates)
{
  const std::string model = with(hammond, R"(
subsection Periodic linear system
  set Period  = 2*pi/Omega
  set Samples = 24
  set Symmetry = blade 1, blade 2, blade 3, blade 4
  set Turning  = hub, shaft
end
)");
  Scene             scene(model, {"Analyses = periodic linear system"});
  const auto        space = space_of(scene);
  EXPECT_EQ(space.A[0].rows(), 12);
  EXPECT_LT(space.variation(), 1e-6);
  ASSERT_EQ(space.averaged.A.rows(), 12);
  EXPECT_NEAR(std::exp(general_eigenvalues(space.averaged.A).real().maxCoeff() * space.period), 0.86326, 1e-5);
  EXPECT_NEAR(std::abs(space.multipliers()[0]), 0.86326, 1e-5);

  Scene plain(
    model,
    {"Analyses = periodic linear system", "Periodic linear system/Symmetry =", "Periodic linear system/Turning ="});
  EXPECT_GT(space_of(plain).variation(), 1e-3);

  // in another order they are none
  Scene disorder(model,
                 {"Analyses = periodic linear system",
                  "Periodic linear system/Symmetry = blade 1, blade 4, blade 3, blade 2"});
  EXPECT_GT(space_of(disorder).variation(), 1e-3);
}



TEST(PeriodicLinearSystem, Refusals)
{
  const auto failure = [](const std::vector<std::string> &more) {
    std::vector<std::string> entries = {"Analyses = periodic linear system"};
    entries.insert(entries.end(), more.begin(), more.end());
    try
      {
        Scene scene(with(pendulum, pushed), entries);
        space_of(scene);
      }
    catch (const std::exception &problem)
      {
        return std::string(problem.what());
      }
    return std::string();
  };
  const auto has = [](const std::string &text, const std::string &part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(failure({"Joints/lift/displacement/Prescribed = push/(1 N)"}), "prescribes a motion"));
  EXPECT_TRUE(has(failure({"Joints/hinge/rotation/Prescribed = 0"}), "nothing can move"));
  EXPECT_TRUE(has(failure({"Periodic linear system/Period = 3 s"}), "periodicity"));
  EXPECT_TRUE(has(failure({"Periodic linear system/Inputs = pull"}), "<pull> is no state of type <control>"));
  EXPECT_TRUE(has(failure({"Periodic linear system/Most states = 1"}), "more than 1"));
  EXPECT_TRUE(has(failure({"Periodic linear system/Period = 0"}), "must be positive"));
}
