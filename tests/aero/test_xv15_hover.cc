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



namespace
{
  /** Of a blade that is coned by 2.5 degrees, (π/16) ρ ∫ c³ V (Ω sin β)² dr, V = Ωr cos β, with the chord of the file.
   */
  double
  power_of_coning(const double R, const double spin)
  {
    const std::vector<std::pair<double, double>> chords = {
      {0., 0.4329}, {0.33337, 0.4329}, {0.4572, 0.4285}, {0.6858, 0.3994}, {0.9525, 0.3556}, {3.81, 0.3557}};
    const double cone = 2.5 * M_PI / 180, turning = spin * std::sin(cone);
    double       sum = 0;
    for (unsigned int i = 0; i + 1 < chords.size(); ++i)
      for (unsigned int k = 0; k < 1000; ++k)
        {
          const double share = (k + 0.5) / 1000, r = chords[i].first + share * (chords[i + 1].first - chords[i].first),
                       c = chords[i].second + share * (chords[i + 1].second - chords[i].second);
          sum += c * c * c * spin * r * (chords[i + 1].first - chords[i].first) / 1000;
        }
    EXPECT_NEAR(chords.back().first, R, 1e-3);
    return M_PI / 16 * 1.225 * turning * turning * std::cos(cone) * sum;
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
      const double T = scene.value("hub:flow.thrust"), P = scene.value("hub:flow.power"), C_T = T / (rho * area * tip * tip),
                   C_P = P / (rho * area * tip * tip * tip);
      EXPECT_GT(C_T, last + 0.001);
      last                      = C_T;
      const double oarf         = measured_power("xv15_hover_oarf.csv", C_T, "15");
      const double wright_field = measured_power("xv15_hover_wadc_cr177436.csv", C_T);
      EXPECT_LT(C_P, 1.03 * std::max(oarf, wright_field)) << C_T;
      EXPECT_GT(C_P, 0.97 * std::min(oarf, wright_field)) << C_T;
      EXPECT_NEAR(C_P, oarf, 0.05 * oarf) << C_T;
      EXPECT_NEAR(scene.value("hub:flow.figure of merit"), std::pow(C_T, 1.5) / (std::sqrt(2.) * C_P), 1e-9);
      // the rest is what the couple of coned blades takes, which turn about themselves
      const double spin = tip / R, couple = 3 * power_of_coning(R, spin);
      EXPECT_NEAR(P - scene.value("hub:flow.induced power") - scene.value("hub:flow.profile power"), couple, 0.02 * couple);
    }
  EXPECT_GT(last, 0.01);
}
