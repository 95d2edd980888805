// Dampers, gravity and pressure as laws of the state, and a load with a potential, against closed forms.

#include "../scene.h"
#include <gtest/gtest.h>

#include <regex>

#include "scenes.h"
#include "started.h"

using namespace samara;

namespace
{
  /** Run from the start to @p end in @p n steps of three stages. */
  State
  run_to(const System &system, const double end, const unsigned int n)
  {
    StageIntegrator integrator(system, Tableau(3, 1.), 1e-13);
    State           state = started(system);
    for (unsigned int i = 0; i < n; ++i)
      EXPECT_TRUE(integrator.step(state, end / n).converged);
    return state;
  }
} // namespace



// m v̇ = −c |v| v and m v̇ = −c t v from v = 1 m/s, m = 2 kg.
TEST(LawsOfLoads, Dampers)
{
  const double t = 1.5;
  const Scene  drag(on_a_slide("", "set Damper = 3 N*s^2/m^2 * abs(slide.displacement rate)"));
  EXPECT_NEAR(run_to(drag.system, t, 40).rates[0], 1 / (1 + 3 * t / 2), 1e-10);
  const Scene growing(on_a_slide("", "set Damper = 3 N/m * t\n set Force = 0"));
  EXPECT_NEAR(run_to(growing.system, t, 40).rates[0], std::exp(-3 * t * t / 4), 1e-10);
  // a force beside it, a number that constants make
  const Scene both(on_a_slide("", "set Damper = 2 N*s/m + 0 N*s/m^2*slide.displacement\n set Force = 5 N"));
  EXPECT_NEAR(run_to(both.system, t, 40).rates[0], 2.5 - 1.5 * std::exp(-t), 1e-10);
  EXPECT_NE(complaint_of(on_a_slide("", "set Damper = 1 - 2")).find("must not be negative"), std::string::npos);
  EXPECT_NE(complaint_of(on_a_slide("", "set Damper = m.displacement q")).find("<q> is neither"), std::string::npos);
}



// A field that grows with the height is a spring: K d = −m (g + s d), m ω² = K + m s.
TEST(LawsOfLoads, Gravity)
{
  const double m = 2, K = 50, g = 9, s = 4;
  Scene        scene("set Analyses = static, modal\nsubsection Modal\n set Modes = 1\nend\n" +
              on_a_slide("", "set Spring = 50") +
              "subsection Loads\n subsection weight\n set Type = gravity\n"
                     " set Acceleration = 0, 0, -9 m/s^2 - 4 m/s^2 / 1 m * slide.displacement\n end\nend\n");
  scene.equilibrium();
  EXPECT_NEAR(scene.value("slide.displacement"), -m * g / (K + m * s), 1e-12);
  EXPECT_NEAR(scene.modes()[0].frequency(), std::sqrt((K + m * s) / m), 1e-9);
}



// Pressure that falls as a stiff square plate of 1 m² gives way, and by how fast: K d = A (p − k d), m λ² + A c λ + K +
// A k.
TEST(LawsOfLoads, Pressure)
{
  const double      m = 2, K = 50, p = 5, k = 30, c = 3;
  const std::string plate = "subsection Bodies\n subsection plate\n set Type = shell\n set Patches = u, v, 0\n"
                            " set Elements = 1, 1\n set Degree = 2\n set E = 1e9\n set Poisson ratio = 0.3\n"
                            " set Thickness = 0.1\n set Rigid = true\n set Frames = corner at 0 0\n end\n",
                    glue  = "subsection Joints\n subsection glue\n set Type = rigid\n set Body A = m.centre\n"
                            " set Body B = plate.corner\n end\n",
                    load  = "subsection Loads\n subsection p\n set Type = pressure\n set Body = plate\n"
                            " set Pressure = 5 Pa - 30 Pa/m * slide.displacement - 3 Pa*s/m * slide.displacement rate\n"
                            " end\nend\n";
  const std::string bead =
    std::regex_replace(on_a_slide("", "set Spring = 50"), std::regex("subsection Bodies\n"), plate);
  Scene scene("set Analyses = static, modal\nsubsection Modal\n set Modes = 1\nend\n" +
              std::regex_replace(bead, std::regex("subsection Joints\n"), glue) + load);
  scene.equilibrium();
  EXPECT_NEAR(scene.value("slide.displacement"), p / (K + k), 1e-12);
  const std::complex<double> lambda = scene.modes()[0].lambda;
  EXPECT_LT(std::abs(m * lambda * lambda + c * lambda + K + k), 1e-8 * (K + k));
}



// Of a planet on an ellipse, drawn by a law of the distance that says it has a potential: after n turns it is where it
// was.
TEST(LawsOfLoads, AForceOfGravitationHasAPotential)
{
  const double  mu = 4, r = 1, v = 2.3; // m³/s², m, m/s at the point next to the sun
  const double  a = 1 / (2 / r - v * v / mu), period = 2 * M_PI * std::sqrt(a * a * a / mu);
  Scene         scene(R"(
subsection Bodies
  subsection planet
    set Type = rigid body
    set Mass = 2
    set Inertia = 1, 1, 1
    set Position = 1, 0, 0
    set Velocity = 0, 2.3, 0
  end
end
subsection Joints
  subsection ray
    set Type = spring
    set Body A = ground
    set Position = 0, 0, 0
    set Body B = planet.centre
    subsection length
      set Spring force = 2 kg * 4 m^3/s^2 / ray.length^2
    end
  end
end
)");
  const System &system = scene.system;
  const State   end    = run_to(system, period, 160);
  EXPECT_NEAR(end.q[12], r, 2e-7);
  EXPECT_NEAR(end.q[13], 0, 2e-6);
  // in long steps it is elsewhere, and has its energy all the same
  StageIntegrator integrator(system, Tableau(1, 1.), 1e-14);
  State           state  = started(system);
  const double    start  = total_energy(system, state);
  double          change = 0;
  for (unsigned int i = 0; i < 30; ++i)
    {
      ASSERT_TRUE(integrator.step(state, period / 20).converged);
      change = std::max(change, std::abs(total_energy(system, state) / start - 1));
    }
  EXPECT_LT(change, 3e-13);
}
