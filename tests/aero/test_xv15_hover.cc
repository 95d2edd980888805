// The rotor of the XV-15 in hover against two measurements (doc/applications/xv15_hover.md).

#include "../reference.h"
#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>

using namespace samara;

namespace
{
  /** Measured C_P at a C_T: a power law through all that was measured within 0.0015 of it; of the run of that number,
   * or of all. */
  double
  measured_power(const std::string &file, const double C_T, const std::string &run = "")
  {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const auto &row : reference_rows("rotorcraft/" + file))
      if (const double T = std::stod(row.at("CT")), P = std::stod(row.at("CP"));
          std::abs(T - C_T) < 0.0015 && (run.empty() || row.at("run") == run))
        {
          const double a = std::log(T / C_T), b = std::log(P);
          n += 1;
          x += a;
          y += b;
          xx += a * a;
          xy += a * b;
        }
    EXPECT_GE(n, 4) << file << " at " << C_T;
    return std::exp((y * xx - x * xy) / (n * xx - x * x));
  }
} // namespace



// Power is within 5 % of the test at the same tip speed up to C_T = 0.010, and not far outside of both.
TEST(XV15, PowerInHover)
{
  const double R = 12.5 * 0.3048, tip = 769.4 * 0.3048, area = M_PI * R * R, rho = 1.225;
  double       last = 0;
  for (const double angle : {4.3, 6.5, 8.5, 10.5})
    {
      Scene scene("prm/rotorcraft/xv15_hover.prm", {"Constants/theta75 = " + number_to_text(angle) + " deg"});
      scene.equilibrium();
      const double T = scene.value("flow.thrust"), P = scene.value("flow.power"), C_T = T / (rho * area * tip * tip),
                   C_P = P / (rho * area * tip * tip * tip);
      EXPECT_GT(C_T, last + 0.001);
      last                      = C_T;
      const double oarf         = measured_power("xv15_hover_oarf.csv", C_T, "15");
      const double wright_field = measured_power("xv15_hover_wadc_cr177436.csv", C_T);
      EXPECT_LT(C_P, 1.03 * std::max(oarf, wright_field)) << C_T;
      EXPECT_GT(C_P, 0.97 * std::min(oarf, wright_field)) << C_T;
      EXPECT_NEAR(C_P, oarf, 0.05 * oarf) << C_T;
      EXPECT_NEAR(scene.value("flow.figure of merit"), std::pow(C_T, 1.5) / (std::sqrt(2.) * C_P), 1e-9);
      EXPECT_NEAR(scene.value("flow.induced power") + scene.value("flow.profile power"), P, 1e-6 * P);
    }
  EXPECT_GT(last, 0.01);
}
