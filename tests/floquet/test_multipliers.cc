// Multipliers of periodic motions.
//
// Reference: Mathieu's equation, Hammond's rotor and the unsymmetric shaft, transition matrices of the linear equations
// by an integrator of the eighth order with relative tolerance 1e-12 (10 to 12 digits); a lag blade with a filtered
// damper, the roots of its characteristic polynomial.

#include <samara/analysis/floquet.h>

#include "../reference.h"
#include "../scene.h"
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "floquet_models.h"

using namespace samara;
using namespace floquet_models;

namespace
{
  std::string
  digits(const double number)
  {
    return number_to_text("%.17g", number);
  }



  /** The modes of a shipped model with other entries; largest multipliers first. */
  struct Floquet
  {
    Scene            scene;
    FloquetAnalysis &analysis;

    Floquet(const std::string &model, const std::vector<std::string> &overrides)
      : scene(model, overrides)
      , analysis(scene.analysis<FloquetAnalysis>())
    {
      if (scene.input.has_analysis("static"))
        scene.equilibrium();
      analysis.run(scene.context);
    }

    double
    largest() const
    {
      return std::abs(analysis.modes[0].multiplier);
    }
  };



  struct Mathieu
  {
    double a, q, c, re_1, im_1, re_2, im_2;

    std::vector<std::string>
    entries() const
    {
      return {"Constants/a = " + digits(a), "Constants/q = " + digits(q), "Constants/c = " + digits(c)};
    }
  };

  const Mathieu rows[] = {{0.5, 0.3, 0, -0.764437960809, -0.644697296468, -0.764437960809, 0.644697296468},
                          {1, 0.2, 0, -1.36711535556, 0, -0.731467169856, 0},
                          {1, 0.2, 0.05, -1.26394066521, 0, -0.676167816003, 0},
                          {1, 0.2, 0.2, -0.999319974312, 0, -0.533851123569, 0},
                          {2, 1, 0, -0.777324677088, -0.629099631528, -0.777324677088, 0.629099631528},
                          {4, 1, 0, 1.15704016664, 0, 0.864274230775, 0},
                          {4.2, 1, 0.02, 1.16026029126, 0, 0.809388526436, 0},
                          {9, 2, 0, -0.992219181365, -0.124503398071, -0.992219181365, 0.124503398071},
                          {0.2, 0.1, 0, 0.143427691452, -0.989660799125, 0.143427691452, 0.989660799125},
                          {3, 2, 0.1, 0.207705527238, -0.829012125969, 0.207705527238, 0.829012125969},
                          {-0.1, 0.8, 0, -0.126692119672, -0.991942088437, -0.126692119672, 0.991942088437},
                          {1, 3, 0, -18.5679327837, 0, -0.0538562914703, 0}};



  /** The largest error of a multiplier over its size; of a pair only one is found. */
  double
  error_of(const std::vector<FloquetMode> &modes, const Mathieu &row)
  {
    std::vector<std::complex<double>> expected = {{row.re_1, std::abs(row.im_1)}};
    if (row.im_1 == 0)
      expected.emplace_back(row.re_2, 0.);
    if (modes.size() != expected.size())
      return 1;
    double error = 0;
    for (unsigned int i = 0; i < expected.size(); ++i)
      error = std::max(error, std::abs(modes[i].multiplier - expected[i]) / std::abs(expected[i]));
    return error;
  }
} // namespace



TEST(Multipliers, OfMathieusEquation)
{
  for (const auto &row : rows)
    {
      Floquet     floquet(pendulum, row.entries());
      const auto &modes = floquet.analysis.modes;
      // of two the smaller has the absolute error of the larger
      EXPECT_LT(error_of(modes, row), row.q == 3 ? 1e-6 : 3e-8) << row.a << " " << row.q;
      const double size = std::hypot(row.re_1, row.im_1);
      EXPECT_NEAR(floquet.largest(), size, 1e-8 * size) << row.a << " " << row.q;
    }
}



TEST(Multipliers, ConvergeWithTheOrderOfTheScheme)
{
  const Mathieu &row = rows[6];
  for (const unsigned int s : {1, 2, 3})
    {
      double             before = 0, order = 0;
      const unsigned int few = s == 1 ? 48 : s == 2 ? 16 : 8;
      for (const unsigned int n : {few, 2 * few})
        {
          auto entries = row.entries();
          entries.push_back("Floquet/Stages = " + std::to_string(s));
          entries.push_back("Floquet/Steps = " + std::to_string(n));
          const double error = error_of(Floquet(pendulum, entries).analysis.modes, row);
          order              = std::log2(before / error);
          before             = error;
        }
      EXPECT_NEAR(order, 2 * s, 0.35) << "s = " << s;
    }
}



// All three methods; of the fast one frequencies are known but for four turns of the rotor, of the others for one.
TEST(Multipliers, OfHammondsRotor)
{
  const double Omega = 300 * M_PI / 30, T = 2 * M_PI / Omega;
  // growth rates, frequencies in (−Ω/2, Ω/2]
  const double expected[6][2] = {{-0.735185199, 9.97251584},
                                 {-1.87494238, 8.75569591},
                                 {-1.87494238, 8.75569591},
                                 {-2.66559819, 11.8974139},
                                 {-3.06720946, 11.7752438},
                                 {-4.13315346, 13.2757274}};
  for (const std::string method : {"fast", "implicit", "classical"})
    {
      Floquet     floquet(hammond, {"Floquet/Method = " + method});
      const auto &modes = floquet.analysis.modes;
      ASSERT_EQ(modes.size(), 6u) << method;
      EXPECT_NEAR(floquet.largest(), 0.8632620022, 1e-8) << method;
      for (unsigned int i = 0; i < 6; ++i)
        {
          EXPECT_NEAR(modes[i].growth(), expected[i][0], 3e-7) << method << i;
          EXPECT_NEAR(std::abs(std::arg(modes[i].multiplier)) / T, expected[i][1], 3e-6) << method << i;
        }
      // the airframe's largest part is not that of the principal value
      EXPECT_NEAR(modes[5].frequency(), 18.14019913, 3e-6) << method;
      EXPECT_EQ(modes[5].shares[0].first, "airframe");
    }
}



// The largest multiplier at speeds of the table, by the fast map.
TEST(Multipliers, OfHammondsRotorFromLowToHighSpeeds)
{
  for (const auto &row : reference_rows("stability/hammond_ground_resonance_all_dampers.csv"))
    {
      const double rpm = std::stod(row.at("rpm"));
      if (std::fmod(rpm, 50) != 0)
        continue;
      Floquet floquet(hammond, {"Constants/Omega = 2*pi*" + digits(rpm) + "/60 rad/s", "Floquet/Method = fast"});
      EXPECT_NEAR(floquet.largest(), std::stod(row.at("max_mu")), 1e-8) << rpm;
    }
}



// The multipliers of a turn are the fourth powers of those of the fast map, which the table has.
TEST(Multipliers, OfHammondsRotorAreFourthPowersOfTheFastMap)
{
  std::map<double, std::vector<std::complex<double>>> expected;
  for (const auto &row : reference_rows("rotor/hammond_fast_map.csv"))
    {
      const auto mu = std::pow(std::complex<double>(std::stod(row.at("mu_re")), std::stod(row.at("mu_im"))), 4);
      expected[std::stod(row.at("rpm"))].emplace_back(mu.real(), std::abs(mu.imag()));
    }
  EXPECT_EQ(expected.size(), 5u);
  for (auto &[rpm, multipliers] : expected)
    {
      Floquet     floquet(hammond, {"Constants/Omega = 2*pi*" + digits(rpm) + "/60 rad/s", "Floquet/Method = fast"});
      const auto &modes = floquet.analysis.modes;
      ASSERT_EQ(modes.size(), multipliers.size()) << rpm;
      for (const auto &mode : modes)
        {
          const std::complex<double> found(mode.multiplier.real(), std::abs(mode.multiplier.imag())); // of a pair
          const auto nearest = std::min_element(multipliers.begin(), multipliers.end(), [&](auto a, auto b) {
            return std::abs(a - found) < std::abs(b - found);
          });
          EXPECT_LT(std::abs(*nearest - found), 1e-8) << rpm;
          multipliers.erase(nearest);
        }
    }
}



// With the damper of one blade out of work nothing is repeated: the fast map is refused, the motion is unstable.
TEST(Multipliers, OfHammondsRotorWithADamperOutOfWork)
{
  Floquet floquet(hammond, {"Constants/out = 1", "Floquet/Method = classical", "Floquet/Steps = 24"});
  EXPECT_NEAR(floquet.largest(), 1.0124006861, 2e-8);
  EXPECT_EQ(floquet.analysis.modes[0].shares[0].first, "blade 1:blade");
  EXPECT_NE(floquet.scene.stream.str().find("the motion is unstable"), std::string::npos);

  // a blade that differs by its mass only, on its own hinge, so that names are all there
  Scene       other(hammond, {"Bodies/blade 3:blade/Inertia = 4, 300, 300"});
  auto       &analysis = other.analysis<FloquetAnalysis>();
  std::string said;
  try
    {
      analysis.run(other.context);
    }
  catch (const NotConverged &problem)
    {
      said = problem.what();
    }
  EXPECT_NE(said.find("the <Symmetry> is none"), std::string::npos) << said;
}



// All rows but those on the boundaries of the unstable band, 46.9 and 49.1 rad/s, where two multipliers meet and any
// error shows by its square root.
TEST(Multipliers, OfAnUnsymmetricShaft)
{
  unsigned int count = 0;
  for (const auto &row : reference_rows("stability/unsymmetric_shaft_jeffcott.csv"))
    {
      const double zeta = std::stod(row.at("zeta_ext")), Omega = std::stod(row.at("Omega"));
      if (Omega == 46.9 || Omega == 49.1)
        continue;
      // the damper turns the plane of the whirl by much in a step of 36
      Floquet floquet(shaft,
                      {"Constants/zeta = " + digits(zeta),
                       "Constants/Omega = " + digits(Omega),
                       std::string("Floquet/Steps = ") + (zeta < 0.01 ? "36" : "48"),
                       "Floquet/Method = classical"});
      EXPECT_NEAR(floquet.largest(), std::exp(std::stod(row.at("max_growth_1_s")) * 2 * M_PI / Omega), 1e-8)
        << zeta << " " << Omega;
      ++count;
    }
  EXPECT_EQ(count, 28u);
}



// What turns steadily and is damped by a state of first order has modes; its multipliers are exp(λ T).
TEST(Multipliers, OfASteadyMotionAreThoseOfItsModes)
{
  const std::vector<std::string> steady = {"Joints/lag/rotation/Moment = -400 N*m*s * filtered"};
  Scene                          scene(blade, steady);
  scene.equilibrium();
  const auto modes   = scene.modes();
  auto      &floquet = scene.analysis<FloquetAnalysis>();
  floquet.turns_of   = "shaft";
  floquet.run(scene.context);
  ASSERT_EQ(floquet.modes.size(), 2u);
  const double T = 2 * M_PI / 30;
  for (const auto &mode : floquet.modes)
    {
      double nearest = 1;
      for (const auto &m : modes)
        nearest = std::min(nearest, std::abs(std::exp(m.lambda * T) - mode.multiplier));
      EXPECT_LT(nearest, 1e-8);
      const auto   s = mode.exponent;
      const double I = 140, S = 40;
      EXPECT_LT(std::abs((I * s * s + 0.3 * S * 900) * (1. + 0.05 * s) + 400. * s) / (I * std::norm(s)), 1e-6);
    }
}



// Newton's method finds an orbit that is damped by a thousandth a turn.
TEST(Multipliers, OfFlapAndLagInForwardFlight)
{
  // advance ratio, cyclics; angles of flap and lag at azimuth 0; multipliers; rates of the angles
  const double table[][11] = {
    {0, 0, 0, 0.057711552275, -0.001492402819, -0.80726393347, 0.58921990213, 0.11146997518, 0.090659528672, 0, 0},
    {0.1,
     0.02,
     -0.03,
     0.057362246411,
     -0.0015843794402,
     -0.80669706451,
     0.58951593719,
     0.11173372208,
     0.090342323314,
     0.012121216594,
     -0.00036167655185},
    {0.2,
     0.02,
     -0.05,
     0.040093832432,
     -0.0016813273714,
     -0.80629270692,
     0.58838274462,
     0.11271183622,
     0.089314792615,
     0.013829143326,
     -1.6234086646e-05}};
  for (const auto &row : table)
    {
      Floquet     floquet(flap_lag,
                      {"Constants/mu = " + digits(row[0]),
                           "Constants/theta_c = " + digits(row[1]),
                           "Constants/theta_s = " + digits(row[2]),
                           "Floquet/Settle = 2",
                           "Floquet/Steps = 144"}); // with 96 the steps alone miss a multiplier by 7e-9
      const auto &modes = floquet.analysis.modes;
      ASSERT_EQ(modes.size(), 2u);
      EXPECT_LT(floquet.analysis.gap, 1e-9);
      EXPECT_LT(std::abs(modes[0].multiplier - std::complex<double>(row[5], row[6])), 1e-8) << row[0];
      EXPECT_LT(std::abs(modes[1].multiplier - std::complex<double>(row[7], row[8])), 1e-8) << row[0];
      const State &orbit = floquet.analysis.orbit;
      const auto  &names = floquet.scene.system.model.coordinates;
      const auto   flap  = std::find(names.begin(), names.end(), "flap.rotation") - names.begin(),
                 lag     = std::find(names.begin(), names.end(), "lag.rotation") - names.begin();
      EXPECT_NEAR(orbit.coordinates[flap], row[3], 1e-9) << row[0];
      EXPECT_NEAR(orbit.coordinates[lag], row[4], 1e-9) << row[0];
      EXPECT_NEAR(orbit.rates[flap], row[9], 1e-9) << row[0];
      EXPECT_NEAR(orbit.rates[lag], row[10], 1e-9) << row[0];
    }
}
