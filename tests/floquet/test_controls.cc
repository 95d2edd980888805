// Controls keep their values: what they are varied by is no motion, and has no multiplier.
//
// Reference: Mathieu's equation as in test_multipliers.cc; a mass on a spring and a damper in closed form.

#include <samara/analysis/floquet.h>
#include <samara/analysis/trim.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>

#include "floquet_models.h"

using namespace samara;

namespace
{
  const std::string shaken_mass = "prm/examples/trim/shaken_mass.prm";

  /** The pendulum with a control of its own. */
  std::string
  with_height()
  {
    const std::ifstream file(std::string(SAMARA_SOURCE_DIR) + "/" + floquet_models::pendulum);
    std::ostringstream  text;
    text << file.rdbuf()
         << "subsection States\n  subsection height\n    set Type = control\n    set Unit = m\n  end\nend\n";
    return text.str();
  }
} // namespace



// After trim on the same orbit: m = 2 kg, c = 20 N s/m, k = 200 N/m.
TEST(Controls, AreNoMultipliersOfWhatIsTrimmed)
{
  for (const std::string method : {"classical", "implicit"})
    {
      SCOPED_TRACE(method);
      Scene scene(shaken_mass);
      scene.analysis<TrimAnalysis>().run(scene.context);
      auto &floquet  = scene.analysis<FloquetAnalysis>();
      floquet.period = 2 * M_PI / 8;
      floquet.method = method;
      floquet.wanted = 2;
      floquet.run(scene.context);
      ASSERT_EQ(floquet.modes.size(), 1u);
      EXPECT_NEAR(std::abs(floquet.modes[0].multiplier), std::exp(-5 * floquet.period), 1e-9);
      EXPECT_NEAR(floquet.modes[0].frequency(), std::sqrt(75.), 1e-6);
      EXPECT_NE(scene.stream.str().find("the motion is stable"), std::string::npos) << scene.stream.str();
    }
}



// The motion of the hinge depends on a control, so that constraints do.
TEST(Controls, OfAPrescribedMotionAreNoMultipliers)
{
  for (const std::string method : {"classical", "implicit"})
    {
      SCOPED_TRACE(method);
      Scene scene(with_height(),
                  {"Joints/lift/displacement/Prescribed = height + q/2*(cos(2*t) - 1)",
                   "Floquet/Wanted = 2",
                   "Floquet/Method = " + method});
      auto &floquet = scene.analysis<FloquetAnalysis>();
      floquet.run(scene.context);
      ASSERT_EQ(floquet.modes.size(), 2u);
      EXPECT_LT(std::abs(floquet.modes[0].multiplier + 1.26394066521), 3e-8);
      EXPECT_LT(std::abs(floquet.modes[1].multiplier + 0.676167816003), 3e-8);
    }
}
