// Loads of surfaces: derivatives, power, closed forms, independence of meshes and of axes.

#include <samara/aero/surface.h>
#include <samara/time/stage_integrator.h>

#include "../complex_step.h"
#include "../scene.h"
#include <gtest/gtest.h>

#include "growth.h"
#include "models.h"

using namespace samara;
using namespace samara::aero_models;

namespace
{
  const std::string inflow = R"(
  subsection flow
    set Type      = prescribed inflow
    set Hub       = hub.off
    set Axis      = 0.1, -0.2, 1
    set Direction = 1, 1, 0
    set Radius    = 3.5
    set Velocity  = 2 + t, 0.5, -1
  end
)";
  const std::string shear  = "    set Shear exponent = 0.2\n    set Ground = -7\n    set Shear height = 5\n";

  const std::string entries = R"(
    set Chord         = 0.4 - 0.05*s
    set Quarter chord = 0.05 + 0.01*s
    set Twist         = 0.1 - 0.02*s
    set Airfoils      = plain at 0.5, full at 2.5
)";

  /** Largest error of tangent and damping matrix, relative, in a random state that moves. */
  double
  error_of_matrices(const std::string &model)
  {
    const Scene       scene(model);
    const ComplexStep step(scene.system, false, false, true);
    return std::max(step.error_of_tangent(), step.error_of_damping());
  }
} // namespace



TEST(Surface, DerivativesAgainstComplexSteps)
{
  // virtual mass goes with a surface that ends where elements end
  for (const std::string unsteady :
       {"quasi-steady", "two lags", "two lags\n    set Compressible lags = true", "dynamic stall"})
    for (const std::string more : {"    set Range = 0.3, 2.9\n", "    set Virtual mass = true\n"})
      {
        SCOPED_TRACE(unsteady + more);
        const std::string text = entries + "    set Unsteady = " + unsteady + "\n" + more;
        EXPECT_LT(error_of_matrices(blade(air("20, 5, -3"), text)), 1e-12);
        EXPECT_LT(error_of_matrices(blade(air("20, 5*cos(t), -3", shear) + inflow, text + "    set Inflow = flow\n")),
                  1e-12);
        // air from behind, and a mirrored section
        const std::string mirrored = "    set Upper side = 0, 0, -1\n    set Leading edge = 0.1, 1, 0\n";
        EXPECT_LT(error_of_matrices(blade(air("10, -30, 5"), text + mirrored)), 1e-12);
      }
}



// The same with coefficients of tables, before and beyond stall, Mach numbers between those of the table.
TEST(Surface, DerivativesWithTables)
{
  const std::string data = SAMARA_SOURCE_DIR "/prm/rotorcraft/",
                    tables =
                      "  subsection polars\n    set Type = AeroDyn\n    set File = " + data +
                      "nrel_5mw/DU21_A17.dat\n  end\n  subsection c81\n    set Type = C81\n    set File = " + data +
                      "xv15/64-X12.c81\n  end\n";
  const std::string head = "subsection Airfoils\n";
  for (const std::string wind : {"20, 5, -3", "5, 20, 30", "-30, 10, 8"})
    for (const std::string unsteady : {"quasi-steady", "two lags", "dynamic stall"})
      {
        SCOPED_TRACE(wind + ", " + unsteady);
        std::string text = blade(air(wind, "    set Speed of sound = 60\n"),
                                 "    set Chord = 0.4 - 0.05*s\n    set Quarter chord = 0.05 + 0.01*s\n"
                                 "    set Twist = 0.1 - 0.02*s\n    set Airfoils = polars at 0.5, c81 at 2.5\n"
                                 "    set Unsteady = " +
                                   unsteady + "\n");
        text.insert(text.find(head) + head.size(), tables);
        EXPECT_LT(error_of_matrices(text), 1e-12);
      }
}



// What the forces on the nodes do is what the air does.
TEST(Surface, PowerIsDual)
{
  for (const std::string virtual_mass : {"false", "true"})
    {
      Scene  scene(blade(air("20, 5, -3") + inflow,
                        "    set Chord = 0.4 - 0.05*s\n    set Quarter chord = 0.1\n    set Airfoils = full\n"
                         "    set Inflow = flow\n    set Virtual mass = " +
                          virtual_mass + "\n"));
      State &state = scene.context.state;
      // deformed as well
      std::vector<double> z(scene.system.size());
      for (unsigned int i = 0; i < z.size(); ++i)
        z[i] = 0.05 * std::sin(3. * i);
      scene.system.update(state, z);
      for (unsigned int i = 6; i < state.y.size(); ++i)
        state.y[i] = 3 * std::cos(2. * i);
      std::vector<double> r(scene.system.size() + 6, 0.);
      scene.system.add_loads(state.point(), r.data());
      double power = 0;
      for (unsigned int i = 6; i < state.y.size(); ++i)
        power -= r[i - 6] * state.y[i];
      EXPECT_GT(std::abs(power), 10.);
      EXPECT_NEAR(power, scene.value("it.power"), 1e-12 * std::abs(power));
    }
}



// A wing in steady flow, everything in closed form.
TEST(Surface, ClosedForms)
{
  const double alpha = 0.1, U = 30, c = 0.5, rho = 1.225, q = 0.5 * rho * U * U;
  Scene        scene(rigid_wing(air("30*cos(0.1), 0, 30*sin(0.1)"),
                         "    set Chord = 0.5\n    set Airfoils = plain\n    set Unsteady = quasi-steady\n"));
  const double lift = q * c * 4 * 2 * M_PI * std::sin(alpha) * std::cos(alpha), s = std::sin(alpha),
               drag = q * c * 4 * (0.01 + 0.02 * s + 0.5 * s * s), m = q * c * c * 4 * (-0.02 + 0.1 * s);
  EXPECT_NEAR(scene.value("it.force x"), drag * std::cos(alpha) - lift * s, 1e-12 * lift);
  EXPECT_NEAR(scene.value("it.force z"), lift * std::cos(alpha) + drag * s, 1e-12 * lift);
  EXPECT_NEAR(scene.value("it.force y"), 0., 1e-12 * lift);
  // nose up: the leading edge at −x goes up, about +y
  EXPECT_NEAR(scene.value("it.moment y"), m, 1e-12 * lift);
  EXPECT_NEAR(scene.value("it.moment x"), scene.value("it.force z") * 1., 1e-12 * lift);
  EXPECT_NEAR(scene.value("it.at 1.angle of attack"), alpha * 180 / M_PI, 1e-12);
  EXPECT_NEAR(scene.value("it.at 1.Mach"), U / 340.3, 1e-12);
}



// Flow along the span: no part of angle, Mach number and lift, ½ρcU c_d V along the line (doc/theory/aerodynamics.md).
TEST(Surface, FlowAlongTheSpan)
{
  const double      alpha = 0.1, U = 30, c = 0.5, rho = 1.225, s = std::sin(alpha);
  const std::string wing = "    set Chord = 0.5\n    set Airfoils = plain\n    set Unsteady = quasi-steady\n";
  const auto        with = [&](const double along, const std::string &entries) {
    return Scene(rigid_wing(air("30*cos(0.1), " + number_to_text(along) + ", 30*sin(0.1)"), entries));
  };
  const Scene  across = with(0, wing);
  const double lift = across.value("it.force z"), cd = 0.01 + 0.02 * s + 0.5 * s * s;
  for (const double V : {12., -40.})
    {
      const Scene swept = with(V, wing);
      for (const std::string probe : {"it.force x", "it.force z", "it.moment y", "it.at 1.Mach"})
        EXPECT_NEAR(swept.value(probe), across.value(probe), 1e-13 * lift) << probe;
      EXPECT_NEAR(swept.value("it.at 1.angle of attack"), alpha * 180 / M_PI, 1e-12);
      EXPECT_NEAR(swept.value("it.force y"), 0.5 * rho * c * U * cd * V * 4, 1e-12 * lift);
      EXPECT_NEAR(swept.value("it.moment z"), -swept.value("it.force x") * 1., 1e-12 * lift); // the middle is at y = 1
    }
  // a compressible section that stalls: the Mach number is that across the span
  const std::string full = "    set Chord = 0.5\n    set Airfoils = full\n    set Unsteady = quasi-steady\n";
  EXPECT_NEAR(with(100, full).value("it.force z"), with(0, full).value("it.force z"), 1e-12 * lift);
}



// A fin that stands up in a wind that grows with the height, u (z/z_r)^p above the ground: ½ρ c c_l ∫u² dz, one lever
// arm of its middle to the ground's.
TEST(Surface, WindThatGrowsWithTheHeight)
{
  const double u = 20, c = 0.5, rho = 1.225, ground = -2, z_r = 4, s = 3 / std::hypot(20., 3.);
  for (const double p : {0.5, 0.2})
    {
      std::string text    = rigid_wing(air("20, 3, 0",
                                        "    set Shear exponent = " + number_to_text(p) +
                                          "\n    set Ground = -2\n    set Shear height = 4\n"),
                                    "    set Chord = 0.5\n    set Airfoils = plain\n    set Unsteady = quasi-steady\n"
                                       "    set Stations = 10\n");
      const auto  replace = [&](const std::string &what, const std::string &by) {
        ASSERT_NE(text.find(what), std::string::npos);
        text.replace(text.find(what), what.size(), by);
      };
      replace("Line = 0, -1, 0; 0, 3, 0", "Line = 0, 0, 1; 0, 0, 5");
      replace("Upper side = 0, 0, 1", "Upper side = 0, 1, 0");
      const Scene scene(text);
      const auto  integral = [&](const double exponent) { // of the height to that power over the fin
        return (std::pow(5 - ground, exponent + 1) - std::pow(1 - ground, exponent + 1)) / (exponent + 1);
      };
      const double square = 1 + 9. / 400, cl = 2 * M_PI * s * 20 / std::hypot(20., 3.),
                   cd = 0.01 + 0.02 * s + 0.5 * s * s, q = 0.5 * rho * c * u * u * square / std::pow(z_r, 2 * p),
                   cosine = 20 / std::hypot(20., 3.), side = q * (cl * cosine + cd * s),
                   back  = q * (cd * cosine - cl * s);
      const double bound = p == 0.5 ? 1e-12 : 1e-9;
      EXPECT_NEAR(scene.value("it.force y"), side * integral(2 * p), bound * side * integral(2 * p)) << p;
      EXPECT_NEAR(scene.value("it.force x"), back * integral(2 * p), bound * side * integral(2 * p)) << p;
      // about the origin, which is 2 m above the ground
      EXPECT_NEAR(scene.value("it.moment x"),
                  -side * (integral(2 * p + 1) + ground * integral(2 * p)),
                  bound * 5 * side * integral(2 * p))
        << p;
    }
}



// Density, chord, offset, twist, lift factor say what they are called.
TEST(Surface, EntriesMeanWhatTheySay)
{
  const std::string usual = "    set Airfoils = plain\n    set Unsteady = quasi-steady\n";
  const auto        value = [&](const std::string &entries, const std::string &probe, const std::string &of_air = "") {
    return Scene(rigid_wing(air("30, 0, 0", of_air), usual + entries)).value(probe);
  };
  // twist is an angle of attack
  Scene twisted(rigid_wing(air("30, 0, 0"), usual + "    set Chord = 0.5\n    set Twist = 5 deg\n"));
  EXPECT_NEAR(twisted.value("it.at 2.angle of attack"), 5., 1e-12);
  const double lift = value("    set Chord = 0.5\n    set Twist = 0.1\n", "it.force z");
  EXPECT_NEAR(value("    set Chord = 0.5\n    set Twist = 0.1\n", "it.force z", "    set Density = 2.45\n"),
              2 * lift,
              1e-10);
  EXPECT_NEAR(value("    set Chord = 1\n    set Twist = 0.1\n", "it.force z"), 2 * lift, 1e-10);
  EXPECT_NEAR(value("    set Chord = 0.5\n    set Twist = 0.1\n    set Range = 1, 2\n", "it.force z"), lift / 4, 1e-10);
  EXPECT_NEAR(value("    set Chord = 0.5\n    set Twist = 0.1\n    set Lift factor = s < 1 ? 0 : 1\n", "it.force z"),
              0.75 * lift,
              1e-10);
  // an offset to the leading edge at −x: lift turns the nose up
  const double before = value("    set Chord = 0.5\n    set Twist = 0.1\n", "it.moment y"),
               after  = value("    set Chord = 0.5\n    set Twist = 0.1\n    set Quarter chord = 0.2\n", "it.moment y");
  EXPECT_NEAR(after - before,
              0.2 * std::cos(0.1) * lift +
                0.2 * std::sin(0.1) * value("    set Chord = 0.5\n    set Twist = 0.1\n", "it.force x"),
              1e-9 * lift);
}



// A straight beam that is not deformed has the same loads for any elements, but for the error of stations.
TEST(Surface, LoadsDoNotDependOnTheMesh)
{
  const auto forces = [](const std::string &mesh, const std::string &stations) {
    const Scene scene(R"(
subsection Sections
  subsection bar
    set Type         = tube
    set E            = 1e9
    set Density      = 800
    set Outer radius = 0.05
  end
end
subsection Bodies
  subsection wing
    set Type    = beam
    set Points  = 0, 0, 0; 0, 5, 0
    set Axis 2  = -1, 0, 0
    set Section = bar
)" + mesh + "  end\nend\n" +
                      airfoils() + subsection("Aerodynamics", air("40, 3, 2")) +
                      subsection("Surfaces", subsection("it", R"(
    set Body       = wing
    set Chord      = table: 0 0.5; 2.1 0.7; 5 0.3
    set Twist      = 0.1 - 0.02*s
    set Airfoils   = full
    set Upper side = 0, 0, 1
)" + stations)));
    return std::vector<double>{scene.value("it.force x"), scene.value("it.force z"), scene.value("it.moment x")};
  };
  const auto one = forces("    set Elements = 1\n", "    set Stations = 20\n");
  EXPECT_GT(one[1], 100.);
  for (const std::string mesh :
       {"    set Elements = 1\n", "    set Elements = 7\n", "    set Elements = 3\n    set Degree = 1\n"})
    for (const bool many : {false, true})
      {
        const auto other = forces(mesh, many ? "    set Stations = 40\n" : "");
        for (unsigned int i = 0; i < 3; ++i)
          EXPECT_NEAR(other[i], one[i], (many ? 1e-6 : 1e-4) * one[1]) << mesh;
      }
}



// The same wing turned, moved, flying instead of blown at; and its mirror image.
TEST(Surface, FramesAndMirrors)
{
  const std::string wing = "    set Chord = 0.5 - 0.02*s\n    set Twist = 0.1 + 0.01*s\n    set Airfoils = full\n"
                           "    set Unsteady = quasi-steady\n    set Quarter chord = 0.1\n";
  Scene             blown(rigid_wing(air("30, 4, 2"), wing)),
    flying(rigid_wing(air("0, 0, 0"), wing, "    set Velocity = -30, -4, -2\n"));
  flying.system.add_initial_velocities(flying.context.state);
  for (const std::string probe :
       {"it.force x", "it.force y", "it.force z", "it.moment x", "it.moment y", "it.moment z"})
    EXPECT_NEAR(blown.value(probe), flying.value(probe), 1e-11 * blown.value("it.force z")) << probe;
  EXPECT_NEAR(blown.value("it.power"), 0., 1e-12);
  EXPECT_LT(std::abs(flying.value("it.power") + 30 * flying.value("it.force x") + 4 * flying.value("it.force y") +
                     2 * flying.value("it.force z")),
            1e-9 * blown.value("it.force z"));

  // the mirror image at y = 0: the line runs to −y, and the upper side stays up
  std::string mirrored = rigid_wing(air("30, -4, 2"), wing);
  mirrored.replace(mirrored.find("0, -1, 0; 0, 3, 0"), 17, "0, 1, 0; 0, -3, 0");
  Scene mirror(mirrored);
  for (const auto &[probe, sign] : std::vector<std::pair<std::string, double>>{{"it.force x", 1},
                                                                               {"it.force y", -1},
                                                                               {"it.force z", 1},
                                                                               {"it.moment x", -1},
                                                                               {"it.moment y", 1},
                                                                               {"it.moment z", -1}})
    EXPECT_NEAR(mirror.value(probe), sign * blown.value(probe), 1e-11 * blown.value("it.force z")) << probe;
}



namespace
{
  /** A wing, a tail plane or a fin of the aircraft of prm/examples/aero/tail_plane.prm: chord, span, quarter chord. */
  struct Plane
  {
    double c, span, x; ///< x behind the mass centre [m]

    double
    lift(const double U) const // over the upwash [N s/m]
    {
      return 0.5 * 1.225 * U * c * span * 2 * M_PI;
    }
    double
    roll(const double U) const // the moment over the rate of roll [N m s]
    {
      return lift(U) * span * span / 12;
    }
    double
    damping(const double U) const // the couple of pitch or yaw, πρUb³ a length, over its rate [N m s]
    {
      return M_PI * 1.225 * U * c * c * c / 8 * span;
    }
  };

  /**
   * Eigenvalue of pitch and heave, or of yaw and sideslip, of planes without drag whose lift is zero in steady flight:
   * with K = Σk, K₃ = Σ k x₃, x₃ the place of three quarters of the chord, the angle of attack α and the rate r
   *
   *     α' = −K/m α + (1 − K₃/(mU)) r      r' = −(U Σ k x/I) α − (Σ (k x x₃ + πρUb³ × span)/I) r
   */
  std::complex<double>
  oscillation(const std::vector<Plane> &planes, const double U, const double m, const double I)
  {
    double K = 0, K3 = 0, Kx = 0, Kx3 = 0;
    for (const Plane &p : planes)
      {
        const double k = p.lift(U), x3 = p.x + 0.5 * p.c;
        K += k;
        K3 += k * x3;
        Kx += k * p.x;
        Kx3 += k * p.x * x3 + p.damping(U);
      }
    const double half = 0.5 * (K / m + Kx3 / I), square = K / m * Kx3 / I + Kx * U / I * (1 - K3 / (m * U));
    return -half + std::sqrt(std::complex<double>(half * half - square));
  }
} // namespace



// An aircraft with wing, tail plane and fin in free flight: short period, weathercock and roll, as modes and as a
// motion.
TEST(Surface, AircraftWithTailPlaneAndFin)
{
  const Plane wing{1.4, 10, -0.1}, tail{0.8, 3, 4.5}, fin{0.9, 1.6, 4.6};
  for (const double U : {30., 60.})
    {
      const std::string model = "prm/examples/aero/tail_plane.prm", speed = "Constants/U = " + number_to_text(U);
      Scene             scene(model, {speed});
      std::vector<std::complex<double>> found;
      for (const auto &mode : scene.modes())
        if (std::abs(mode.lambda) > 1e-3)
          found.push_back(mode.lambda);
      const auto short_period = oscillation({wing, tail}, U, 1200, 2600),
                 weathercock  = oscillation({fin}, U, 1200, 4000);
      const double roll       = -(wing.roll(U) + tail.roll(U) + fin.roll(U)) / 1800;
      ASSERT_EQ(found.size(), 3u);
      EXPECT_LT(std::abs(found[0] - weathercock), 1e-9 * std::abs(weathercock)) << found[0] << weathercock;
      EXPECT_LT(std::abs(found[1] - short_period), 1e-9 * std::abs(short_period)) << found[1] << short_period;
      EXPECT_LT(std::abs(found[2] - roll), 1e-9 * std::abs(roll)) << found[2] << roll;

      // a small pitching velocity: 2 s of it
      Scene  flying(model, {speed, "Bodies/aircraft/Angular velocity = 0, 1e-3, 0"});
      State &state = flying.context.state;
      flying.system.add_initial_velocities(state);
      state.held            = false;
      const auto          h = 0.02;
      StageIntegrator     integrator(flying.system, Tableau(3, 1.), 1e-12, 50);
      std::vector<double> angles;
      for (unsigned int i = 0; i < 60; ++i)
        {
          angles.push_back(flying.value("wing.at 5.angle of attack"));
          ASSERT_TRUE(integrator.step(state, h).converged);
        }
      EXPECT_LT(std::abs(growth_of(angles, h) - short_period), 1e-5 * std::abs(short_period)) << U;
    }
  // without its tail plane it turns over
  Scene  no_tail("prm/examples/aero/tail_plane.prm", {"Surfaces/tail plane/Lift factor = 0"});
  double largest = 0;
  for (const auto &mode : no_tail.modes())
    largest = std::max(largest, mode.lambda.real());
  EXPECT_NEAR(largest, oscillation({wing}, 60, 1200, 2600).real(), 1e-9);
  EXPECT_GT(largest, 0.1);
}



TEST(Surface, RefusesBadInput)
{
  const std::string good = "    set Chord = 0.5\n    set Airfoils = plain\n";
  const auto        of = [&](const std::string &entries) { return complaint_of(rigid_wing(air("1, 0, 0"), entries)); };
  EXPECT_EQ(of(good), "");
  EXPECT_NE(of("    set Chord = 0.5 - s\n    set Airfoils = plain\n").find("the chord must be positive"),
            std::string::npos);
  EXPECT_NE(of(good + "    set Range = 1, 5\n").find("between 0 and 4 m"), std::string::npos);
  EXPECT_NE(of(good + "    set Range = 2, 1\n").find("<Range>"), std::string::npos);
  EXPECT_NE(of(good + "    set Breaks = 7\n").find("outside of the surface"), std::string::npos);
  EXPECT_NE(of("    set Chord = 0.5\n    set Airfoils = plane\n").find("plain"), std::string::npos);
  EXPECT_NE(of("    set Chord = 0.5\n    set Airfoils = plain at 1, full at 0.5\n").find("order"), std::string::npos);
  EXPECT_NE(of(good + "    set Inflow = flow\n").find("flow"), std::string::npos);
  EXPECT_NE(complaint_of(rigid_wing("", good)).find("has no air"), std::string::npos);
  std::string along = rigid_wing(air("1, 0, 0"), good);
  along.replace(along.find("-1, 0, 0\n"), 8, "0, 1, 0");
  EXPECT_NE(complaint_of(along).find("direction of the reference line"), std::string::npos);
  std::string sideways = rigid_wing(air("1, 0, 0"), good);
  sideways.replace(sideways.find("Upper side = 0, 0, 1"), 20, "Upper side = 0, 1, 0");
  EXPECT_NE(complaint_of(sideways).find("neither up nor down"), std::string::npos);
}



// Virtual mass asks for stations, which there are none of where something else is wrong.
TEST(Surface, RefusesVirtualMassWithoutAir)
{
  const std::string said = complaint_of(R"(
subsection Bodies
  subsection hub
    set Type = rigid body
    set Mass = 1
    set Inertia = 1, 1, 1
  end
end
subsection Airfoils
  subsection a
    set Type = analytic
  end
end
subsection Surfaces
  subsection w
    set Body         = hub
    set Line         = 0, 0, 0; 1, 0, 0
    set Chord        = 0.1
    set Airfoils     = a
    set Virtual mass = true
  end
end
)");
  EXPECT_NE(said.find("air"), std::string::npos) << said;
}
