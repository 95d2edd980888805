/*
 * Problem:   tension stiffens torsion (Trapeze)
 * Reference: closed forms. A strip b × t with free ends: M₁ = GJ κ + N I_p/A κ + E t b⁵/360 κ³ (Green 1937; Timoshenko,
 *            Strength of Materials II), shortening I_p κ²/(2A); torsional waves of a bar under tension; torsion of a
 *            rotating blade by Galerkin with eight sines; stresses E (ε + ½ r² κ²).
 */

#include <samara/base/dense.h>
#include <samara/cosserat/beam.h>
#include <samara/cosserat/section_file.h>
#include <samara/cosserat/section_kinds.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>

using namespace samara;

namespace
{
  constexpr double chord = 0.1, depth = 0.004, Young = 7e10, rho = 2700, span = 2;

  const std::string metal_of_strip = "subsection Materials\n subsection metal\n set Type = isotropic\n set E = 7e10\n"
                                     " set Poisson ratio = 0.3\n set Density = 2700\n end\nend\n",
                    strip_section =
                      " set Type = rectangle\n set Width 2 = 0.1\n set Width 3 = 0.004\n set Trapeze effect = true\n",
                    by_E        = " set E = 7e10\n set Density = 2700\n",
                    by_material = " set Material = metal\n set Degree = 3\n set Elements = 12\n";

  /** A cantilever along x with the section, and more subsections. */
  std::string
  cantilever(const std::string &section, const std::string &rest, const std::string &more_of_beam = "")
  {
    return metal_of_strip + "subsection Sections\n subsection s\n" + section +
           " end\nend\nsubsection Bodies\n subsection bar\n set Type = beam\n set Points = 0, 0, 0; 2, 0, 0\n"
           " set Axis 2 = 0, 1, 0\n set Section = s\n set Elements = 4\n set Degree = 3\n" +
           more_of_beam +
           " end\nend\nsubsection Joints\n subsection root\n set Type = rigid\n set Body A = ground\n"
           " set Body B = bar.start\n end\nend\n" +
           rest;
  }

  std::string
  pulled_and_twisted(const double N, const double M)
  {
    return "subsection Loads\n subsection pull\n set Type = point load\n set At = bar.end\n set Force = " +
           std::to_string(N) + ", 0, 0\n set Moment = " + std::to_string(M) + ", 0, 0\n end\nend\n";
  }

  SectionValues
  values_of(const std::string &section)
  {
    const Scene scene(cantilever(section, ""));
    return scene.input.model.find<Section>("s", "section").at(0, Vector3::Zero());
  }

  /** Of the first mode that turns about the bar. */
  double
  torsional_frequency(Scene &scene)
  {
    scene.equilibrium();
    for (const auto &mode : scene.modes())
      {
        double part = 0, all = 0;
        for (unsigned int node = 1; node < scene.system.layout.n_nodes; ++node)
          {
            const auto z = mode.shape.segment<6>(scene.system.layout.of_node(node));
            part += std::norm(z(3));
            all += z.squaredNorm();
          }
        if (part > 0.9 * all)
          return mode.frequency();
      }
    throw std::runtime_error("no mode turns about the bar");
  }
} // namespace



TEST(Trapeze, NumbersOfShapes)
{
  const double I = depth * std::pow(chord, 3) / 12 + chord * std::pow(depth, 3) / 12,
               q =
                 chord * depth * (std::pow(chord, 4) / 80 + std::pow(chord * depth, 2) / 72 + std::pow(depth, 4) / 80);
  for (const auto &kind : {by_E, by_material})
    {
      const SectionValues v = values_of(strip_section + kind);
      EXPECT_NEAR(v.trapeze.coupling(0), Young * I, 1e-6 * Young * I) << kind;
      EXPECT_NEAR(v.trapeze.stiffness, Young * q, 1e-6 * Young * q) << kind;
      EXPECT_LT(v.trapeze.coupling.tail<5>().norm(), 1e-6 * Young * I) << kind;
    }
  // away from the reference line it stretches with the tension centre, and turns about its own
  const Trapeze off = values_of(strip_section + by_material + " set Position = 0.3, -0.2\n").trapeze;
  EXPECT_NEAR(off.coupling(0), Young * I, 1e-5 * Young * I);
  EXPECT_NEAR(off.coupling(4), -0.2 * Young * I, 1e-5 * Young * I);
  EXPECT_NEAR(off.coupling(5), -0.3 * Young * I, 1e-5 * Young * I);
  EXPECT_NEAR(off.stiffness, Young * q, 1e-5 * Young * q);
  // all of a thin ring is at one distance: the least stiffness there is, and a little more
  const SectionValues ring =
    values_of(" set Type = tube\n set E = 1\n set Density = 1\n set Outer radius = 1\n set Inner radius = 0.9999\n"
              " set Trapeze effect = true\n");
  EXPECT_NEAR(ring.trapeze.stiffness / (ring.stiffness(0, 0) * std::pow(0.99995, 4)), 1.001, 1e-6);
  EXPECT_EQ(values_of(" set Type = rectangle\n set Width 2 = 1\n set Width 3 = 1\n" + by_E).trapeze.stiffness, 0.);
}



TEST(Trapeze, StripUnderTensionAndTorque)
{
  const SectionValues v = values_of(strip_section + by_E);
  const double        A = chord * depth, p = v.trapeze.coupling(0), GJ = v.stiffness(3, 3),
               cubic = (v.trapeze.stiffness - p * p / (Young * A)) / 2;
  EXPECT_NEAR(cubic, Young * depth * std::pow(chord, 5) / 360, 0.01 * cubic);
  for (const double N : {0., 20000.})
    {
      Scene scene(cantilever(strip_section + by_E, pulled_and_twisted(N, 40)));
      scene.equilibrium();
      const auto   value = [&](const char *const name) { return scene.value(name); };
      const double kappa = value("bar.at 0.3.curvature 1"), strain = value("bar.at 0.3.strain 1");
      EXPECT_GT(kappa, 0.5);
      EXPECT_NEAR(GJ * kappa + N / A * p / Young * kappa + cubic * std::pow(kappa, 3), 40, 1e-5 * 40);
      EXPECT_NEAR(strain, N / (Young * A) - p / (Young * A) * kappa * kappa / 2, 1e-9);
      EXPECT_NEAR(value("bar.at 0.3.moment 1"), 40, 4e-4);
      EXPECT_NEAR(value("bar.at 0.3.force 1"), N, 1e-4);
    }
}



// Fibres at the edges are longer than the middle by half the square of their slope, that of torsion is in planes
// across.
TEST(Trapeze, StressesOfATwistedStrip)
{
  Scene scene(cantilever(strip_section + by_material, pulled_and_twisted(0, 40)));
  scene.equilibrium();
  const double kappa = scene.value("bar.at 0.3.curvature 1"), strain = scene.value("bar.at 0.3.strain 1");
  const double corner = (chord * chord + depth * depth) / 4, expected = Young * (strain + corner * kappa * kappa / 2);
  EXPECT_GT(expected, 1e7);
  EXPECT_NEAR(scene.value("bar.at 0.3.stress 11"), expected, 1e-5 * expected);
}



TEST(Trapeze, FrequencyUnderTension)
{
  const SectionValues v = values_of(strip_section + by_E);
  const double        N = 20000, polar = rho * (depth * std::pow(chord, 3) + chord * std::pow(depth, 3)) / 12,
               stiffness = v.stiffness(3, 3) + N * polar / rho / (chord * depth),
               omega     = M_PI / (2 * span) * std::sqrt(stiffness / polar);
  EXPECT_GT(stiffness, 1.25 * v.stiffness(3, 3));
  Scene scene(cantilever(strip_section + by_E, pulled_and_twisted(N, 0) + "subsection Modal\n set Modes = 20\nend\n"));
  EXPECT_NEAR(torsional_frequency(scene), omega, 1e-5 * omega);
}



// (GJ φ')' + (½ ρ I_p Ω² (L² − x²) φ')' − ρ (I_3 − I_2) Ω² φ + ρ I_p ω² φ = 0
TEST(Trapeze, RotatingBlade)
{
  const double Omega = 100, I_3 = depth * std::pow(chord, 3) / 12, I_2 = chord * std::pow(depth, 3) / 12,
               GJ   = values_of(strip_section + by_E).stiffness(3, 3);
  constexpr int   n = 8, n_points = 4000;
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n), M = K;
  for (int g = 0; g < n_points; ++g)
    {
      const double    x = span * (g + 0.5) / n_points, w = span / n_points;
      Eigen::VectorXd phi(n), slope(n);
      for (int i = 0; i < n; ++i)
        {
          const double k = (2 * i + 1) * M_PI / (2 * span);
          phi(i)         = std::sin(k * x);
          slope(i)       = k * std::cos(k * x);
        }
      K += w * (GJ + 0.5 * rho * (I_2 + I_3) * Omega * Omega * (span * span - x * x)) * slope * slope.transpose() +
           w * rho * (I_3 - I_2) * Omega * Omega * phi * phi.transpose();
      M += w * rho * (I_2 + I_3) * phi * phi.transpose();
    }
  const double      omega = std::sqrt(symmetric_eigen(K, M).values(0));
  const std::string rotor =
    "subsection Loads\n subsection rotor\n set Type = steady rotation\n set Speed = 100\n end\nend\n"
    "subsection Modal\n set Modes = 20\nend\n";
  Scene scene(cantilever(strip_section + by_E, rotor));
  EXPECT_NEAR(torsional_frequency(scene), omega, 1e-3 * omega);
  Scene without(cantilever(" set Type = rectangle\n set Width 2 = 0.1\n set Width 3 = 0.004\n" + by_E, rotor));
  EXPECT_LT(torsional_frequency(without), 0.95 * omega);
}



// Shells know nothing of it, and have it: what rotation adds to the square of the frequency of torsion is the same. At
// rest the clamped root, where the strip cannot warp, makes 2 % of it.
TEST(Trapeze, IsThatOfAShell)
{
  const auto shell = [](const std::string &speed) {
    Scene scene(
      "subsection Bodies\n subsection bar\n set Type = shell\n set Patches = 2*u, 0.1*(v - 0.5), 0\n"
      " set Elements = 6, 1\n set Degree = 4\n set E = 7e10\n set Poisson ratio = 0.3\n set Thickness = 0.004\n"
      " set Density = 2700\n end\nend\nsubsection Joints\n subsection root\n set Type = support\n"
      " set Along = bar.edge u0\n set Fixed = displacement 1, displacement 2, displacement 3, rotation 1, rotation 2,"
      " rotation 3\n end\nend\nsubsection Loads\n subsection rotor\n set Type = steady rotation\n set Speed = " +
      speed + "\n end\nend\nsubsection Modal\n set Modes = 8\nend\n");
    return torsional_frequency(scene);
  };
  const auto beam = [](const std::string &speed) {
    Scene scene(cantilever(strip_section + by_E,
                           "subsection Loads\n subsection rotor\n set Type = steady rotation\n set Speed = " + speed +
                             "\n end\nend\nsubsection Modal\n set Modes = 20\nend\n"));
    return torsional_frequency(scene);
  };
  const double of_shell = std::pow(shell("100"), 2) - std::pow(shell("0"), 2),
               of_beam  = std::pow(beam("100"), 2) - std::pow(beam("0"), 2);
  EXPECT_NEAR(of_shell, of_beam, 0.01 * of_beam);
  EXPECT_GT(of_beam, 1.8e4); // 1e4 of it without
}



TEST(Trapeze, IsReadBackFromFiles)
{
  const SectionFile file{"s", Vector3::Zero(), values_of(strip_section + by_material)};
  const Trapeze     of_shape = file.values.trapeze;
  std::ofstream("trapeze_section.txt") << file.write(16);
  const Trapeze of_file = SectionFile::read("trapeze_section.txt").values.trapeze;
  std::remove("trapeze_section.txt");
  EXPECT_EQ(of_file.coupling, of_shape.coupling);
  EXPECT_EQ(of_file.stiffness, of_shape.stiffness);
}
