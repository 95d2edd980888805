// Pages of the documentation that the program can check itself: the reference of the input language, and the first
// model of README.md.

#include <samara/program/program.h>

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  std::string
  content(const std::string &file)
  {
    std::ifstream     in(std::string(SAMARA_SOURCE_DIR) + "/" + file);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
  }

  /** Lines that are neither empty nor comments. */
  unsigned int
  lines_of_code(const std::string &file)
  {
    std::string text = content(file);
    for (auto at = text.find("/*"); at != std::string::npos; at = text.find("/*"))
      text.erase(at, text.find("*/", at) + 2 - at);
    std::istringstream in(text);
    unsigned int       n = 0;
    for (std::string line; std::getline(in, line);)
      n += line.substr(0, line.find("//")).find_first_not_of(' ') != std::string::npos;
    return n;
  }
} // namespace



TEST(Documentation, ReferenceIsUpToDate)
{
  std::ostringstream reference;
  print_reference(reference);
  EXPECT_EQ(reference.str(), content("doc/input_reference.md"))
    << "Write it anew: build/release/samara --parameters > doc/input_reference.md";
}



TEST(Documentation, EveryKindHasAReferenceOfItsOwn)
{
  const Catalogue catalogue;
  for (const auto &group : catalogue.groups)
    for (const auto &kind : group.kinds.kinds())
      {
        std::ostringstream reference;
        print_reference(reference, kind);
        EXPECT_EQ(reference.str().find("### " + kind + "\n"), 0u);
      }
  EXPECT_THROW(
    {
      std::ostringstream reference;
      print_reference(reference, "bem");
    },
    InputError);
}



// What a new joint, load, ... costs is said where one reads how it is made.
TEST(Documentation, PagesSayHowLongSkeletonsAre)
{
  for (const auto &[page, room] : {std::make_pair("joint", "joints"),
                                   std::make_pair("element", "cosserat"),
                                   std::make_pair("load", "loads"),
                                   std::make_pair("state", "states"),
                                   std::make_pair("analysis", "analysis"),
                                   std::make_pair("integrator", "time")})
    {
      const std::string  name = std::string(room) + "/skeleton";
      const unsigned int n = lines_of_code("include/samara/" + name + ".h") + lines_of_code("source/" + name + ".cc");
      EXPECT_NE(content("doc/how_to/" + std::string(page) + ".md").find(std::to_string(n) + " lines of code"),
                std::string::npos)
        << page << ": the skeleton has " << n << " lines of code";
    }
}



TEST(Documentation, ReadmeShowsTheFirstModel)
{
  EXPECT_NE(content("README.md").find("```\n" + content("prm/examples/first_model.prm") + "```"), std::string::npos);
}



// A clamped tube that bends under its weight, and its first pair of modes: Timoshenko's deflection, and Euler's
// frequency, of which shear and rotary inertia take less than half a per mille here.
TEST(Documentation, FirstModelRuns)
{
  Scene        scene("prm/examples/first_model.prm");
  const double E = 210e9, nu = 0.3, r = 0.01, L = 1, A = M_PI * r * r, I = M_PI / 4 * std::pow(r, 4);
  const double m = 7800 * A, q = m * 9.80665, GA = 6 * (1 + nu) / (7 + 6 * nu) * E / (2 * (1 + nu)) * A;

  scene.equilibrium();
  const double deflection = q * std::pow(L, 4) / (8 * E * I) + q * L * L / (2 * GA);
  EXPECT_NEAR(scene.value("rod.end.displacement z"), -deflection, 1e-5 * deflection);
  EXPECT_NEAR(scene.value("rod.start.moment 2"), q * L * L / 2, 1e-3 * q);

  const double omega = std::pow(1.8751040687, 2) * std::sqrt(E * I / m) / (L * L);
  EXPECT_NEAR(scene.modes()[0].frequency(), omega, 5e-4 * omega);
  EXPECT_NEAR(scene.modes()[1].frequency(), omega, 5e-4 * omega);
}
