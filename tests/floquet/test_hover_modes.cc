/*
 * Problem:   modes of random rotors in hover, and modes that are there twice, among those below a frequency
 * Reference: modal analysis of the same equilibrium, but for the error of the steps; all columns of the same map
 */

#include <samara/analysis/floquet.h>
#include <samara/base/errors.h>

#include "../said_by.h"
#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "floquet_models.h"

using namespace samara;

namespace
{
  constexpr double damped_to_round_off = 1e-8; ///< over the section

  /** Two or three blades on lag hinges, or flap and lag hinges, in their own inflow, on a support that gives way. */
  std::string
  rotor_in_hover(const unsigned int seed)
  {
    std::mt19937 generator(seed);
    const auto   between = [&](const double a, const double b) {
      return number_to_text("%.9g", std::uniform_real_distribution<double>(a, b)(generator));
    };
    const auto one_of = [&](const std::vector<std::string> &all) {
      return all[std::uniform_int_distribution<std::size_t>(0, all.size() - 1)(generator)];
    };
    const std::string speed = between(20, 40), radius = between(4, 6), flapwise = between(3e4, 1e5),
                      hinge =
                        one_of({"revolute\n set Axis = 0, 0, 1\n subsection rotation",
                                "universal\n set Axis = 0, 1, 0\n set Second axis = 0, 0, 1\n subsection rotation 2"}),
                      inflow =
                        one_of({"Pitt-Peters inflow\n", "Peters-He inflow\n set Harmonics = 2\n set Power = 4\n"});
    std::string text = "set Analyses = static, modal, floquet\n";
    text += "subsection Sections\n subsection blade\n set Type = engineering constants\n set EA = 5e7\n set GA2 = 2e7\n"
            " set GA3 = 1e7\n set GJ = " +
            between(3e5, 1e6) + "\n set EI2 = " + flapwise + "\n set EI3 = " + flapwise + "*" + between(3, 20) +
            "\n set Mass = " + between(5, 9) + "\n set I2 = 0.01\n set I3 = 0.03\n end\nend\n";
    text += "subsection Bodies\n subsection airframe\n set Type = rigid body\n set Mass = 900\n"
            " set Inertia = 300, 300, 300\n end\n"
            " subsection hub\n set Type = rigid body\n set Mass = 10\n set Inertia = 1, 1, 1\n end\nend\n";
    text +=
      "subsection Joints\n subsection support\n set Type = prismatic\n set Body A = ground\n set Body B = airframe\n"
      " subsection displacement\n set Spring = 900*" +
      between(20, 60) + "^2\n set Damper = 900*" + between(0.5, 3) +
      "\n end\n end\n subsection shaft\n set Type = revolute\n set Body A = airframe\n set Body B = hub\n"
      " subsection rotation\n set Prescribed = " +
      speed + "*t\n end\n end\nend\n";
    text += "subsection Subsystems\n subsection blade\n set Copies = " + one_of({"2", "3"}) +
            " about z\n subsection Bodies\n subsection blade\n set Type = beam\n set Points = 0.3, 0, 0; " + radius +
            ", 0, 0\n set Axis 2 = 0, 1, 0\n set Elements = 1\n set Degree = 3\n set Section = blade\n"
            " set Damping ratio = " +
            between(0.005, 0.03) +
            "\n set Damping frequency = 30\n end\n end\n"
            " subsection Joints\n subsection lag\n set Body A = hub\n set Body B = blade.start\n"
            " set Position = 0.3, 0, 0\n set Type = " +
            hinge + "\n set Damper = " + between(500, 2000) +
            "\n end\n end\n end\n"
            " subsection Surfaces\n subsection wing\n set Body = blade\n set Leading edge = 0, 1, 0\n set Chord = " +
            between(0.2, 0.4) + "\n set Twist = " + between(4, 10) +
            " deg\n set Airfoils = section\n set Unsteady = quasi-steady\n set Inflow = flow\n set Stations = 4\n"
            " end\n end\n end\nend\n";
    text += "subsection Airfoils\n subsection section\n set Type = analytic\n set Drag = 0.01, 0, 0.5\n end\nend\n";
    text +=
      "subsection Aerodynamics\n subsection air\n set Type = air\n end\n subsection flow\n set Hub = hub\n set Radius = " +
      radius + "\n set Type = " + inflow + " end\nend\n";
    text +=
      "subsection Loads\n subsection turning\n set Type = steady rotation\n set Joint = shaft\n set Speed = " + speed +
      "\n end\nend\nsubsection Modal\n set Modes = 40\nend\n";
    text += "subsection Floquet\n set Turns of = shaft\n set Steps = 18\n set Stages = 2\n set Spectral radius = " +
            one_of({"0", "0.5", "0.8"}) + "\n set Highest frequency = " + between(50, 80) +
            "\n set Method = implicit\n set Animations = 0\nend\n";
    return text;
  }

  std::vector<FloquetMode>
  floquet_modes_of(Scene &scene)
  {
    auto &floquet = scene.analysis<FloquetAnalysis>();
    floquet.run(scene.context);
    return floquet.modes;
  }

  /** Of modes the nearest to λ that is not taken yet: by the multiplier, which tells of frequencies but for turns. */
  double
  take_nearest(const std::complex<double> multiplier, std::vector<std::complex<double>> &left)
  {
    double       least = std::numeric_limits<double>::infinity();
    std::size_t  which = 0;
    const double size  = std::abs(multiplier);
    for (std::size_t i = 0; i < left.size(); ++i)
      for (const auto &value : {left[i], std::conj(left[i])})
        if (const double distance = std::abs(value - multiplier) / size; distance < least)
          {
            least = distance;
            which = i;
          }
    if (!left.empty())
      left.erase(left.begin() + which);
    return least;
  }
} // namespace



// Steps with ρ < 1 damp fast modes less than air damps slow ones: none of these may be missing, and none stands in its
// place. Modal analysis knows all of them.
TEST(HoverModes, SlowOnesAreThoseOfModalAnalysisOneByOne)
{
  for (unsigned int seed = 1; seed <= 10; ++seed)
    {
      SCOPED_TRACE(seed);
      const std::string text = rotor_in_hover(seed);
      Scene             scene(text);
      scene.equilibrium();
      const std::vector<Mode>           modal   = scene.modes();
      auto                             &floquet = scene.analysis<FloquetAnalysis>();
      const auto                        found   = floquet_modes_of(scene);
      const double                      highest = std::stod(text.substr(text.find("Highest frequency = ") + 20));
      const double                      T       = 2 * M_PI / std::abs(scene.context.speeds.at(0));
      std::vector<std::complex<double>> left;
      for (const auto &mode : found)
        left.push_back(mode.multiplier);
      ASSERT_GT(modal.back().frequency(), highest);
      unsigned int n = 0;
      for (const auto &mode : modal)
        {
          const std::complex<double> multiplier = std::exp(mode.lambda * T);
          // at the very limit either is right
          if (mode.frequency() > 0.98 * highest || std::abs(multiplier) < damped_to_round_off)
            continue;
          ++n;
          const double distance = take_nearest(multiplier, left);
          // what the steps are off by: of real exponents 0.3 %, of others what is estimated of modes as fast as this
          double allowed = std::max(1e-3, 3e-3 * std::abs(mode.lambda) * T);
          for (const auto &other : found)
            if (other.rate <= 1.05 * mode.frequency())
              allowed = std::max(allowed, 6 * std::abs(other.scheme_error) * T);
          EXPECT_LT(distance, allowed) << mode.lambda;
        }
      EXPECT_GT(n, 5u);
      for (const auto &mode : floquet.modes)
        EXPECT_LT(std::hypot(mode.growth(), mode.frequency()), 1.1 * highest);
      // nor is one told that the whole map does not have
      Scene all(text, {"Floquet/Method = classical", "Floquet/Highest frequency = 0", "Floquet/Wanted = 500"});
      all.equilibrium();
      std::vector<std::complex<double>> of_all;
      for (const auto &mode : floquet_modes_of(all))
        of_all.push_back(mode.multiplier);
      for (const auto &mode : found)
        EXPECT_LT(take_nearest(mode.multiplier, of_all), 1e-3) << mode.exponent;
    }
}



// Equal pendulums on one hinge that is moved: Mathieu's two real multipliers, each as often as there are pendulums.
TEST(HoverModes, RealOnesThatAreThereTwiceAreTold)
{
  std::ostringstream shipped;
  shipped << std::ifstream(std::string(SAMARA_SOURCE_DIR) + "/" + floquet_models::pendulum).rdbuf();
  std::string text  = shipped.str();
  const auto  twice = [&](const std::string &from, const std::string &to, const std::string &name) {
    const auto  first = text.find("  subsection " + from), last = text.find(to, first);
    std::string copy = text.substr(first, last - first);
    for (auto at = copy.find(name); at != std::string::npos; at = copy.find(name, at + name.size() + 2))
      copy.replace(at, name.size(), name + " 2");
    text.insert(last, copy);
  };
  twice("bob", "end\n\nsubsection Joints", "bob");
  twice("hinge", "end\n\nsubsection Loads", "hinge");
  const auto at = text.rfind("set Body B = bob\n"), second = text.find("subsection hinge 2");
  ASSERT_GT(at, second);
  text.replace(at, 17, "set Body B = bob 2\n");
  for (const double tolerance : {1e-3, 1e-6})
    {
      Scene      scene(text,
                  {"Floquet/Highest frequency = 5",
                        "Floquet/Steps = 24",
                        "Floquet/Method = implicit",
                        "Floquet/Tolerance = " + std::to_string(tolerance)});
      const auto modes = floquet_modes_of(scene);
      ASSERT_EQ(modes.size(), 4u) << scene.stream.str();
      for (const unsigned int i : {0, 1})
        EXPECT_LT(std::abs(modes[i].multiplier + 1.26394066521), 1e-5);
      for (const unsigned int i : {2, 3})
        EXPECT_LT(std::abs(modes[i].multiplier + 0.676167816003), 1e-5);
    }
}



// Joints that only follow have speeds of round-off, which nothing has to hold.
TEST(HoverModes, AForgottenDriveIsNamed)
{
  std::string text  = rotor_in_hover(1);
  const auto  first = text.find(" subsection rotation\n set Prescribed"), last = text.find(" end\n", first) + 5;
  text.erase(first, last - first);
  Scene scene(text);
  scene.equilibrium();
  const std::string said = said_by<InputError>([&]() { floquet_modes_of(scene); });
  EXPECT_NE(said.find("nothing holds the speed of <shaft.rotation> as statics did"), std::string::npos) << said;
  EXPECT_EQ(said.find("e+"), std::string::npos) << said;
}
