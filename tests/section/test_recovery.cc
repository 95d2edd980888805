/*
 * Problem:   stresses in sections of beams, and how near they are to failure
 * Reference: criteria in closed form for single stresses, Tsai & Wu and Hashin off the axes of the ply by their own
 *            formulas; bending and torsion of a rod and of a rectangle
 */

#include <samara/section/patches.h>
#include <samara/section/recovery.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>

using namespace samara;

namespace
{
  Strengths
  ply()
  {
    Strengths s;
    s.tensile     = {1500e6, 40e6, 50e6};
    s.compressive = {1200e6, 150e6, 160e6};
    s.shear       = {70e6, 80e6, 90e6}; // 12, 13, 23
    return s;
  }



  Vector6
  single(const int i, const double value)
  {
    Vector6 stress = Vector6::Zero();
    stress(i)      = value;
    return stress;
  }
} // namespace



TEST(Failure, SingleStressesFailAtTheirStrengths)
{
  const Strengths s = ply();
  for (int i = 0; i < 3; ++i)
    for (const double half : {0.5, 1., 2.})
      {
        const FailureIndices tension  = failure_indices(s, single(i, half * s.tensile(i))),
                             pressure = failure_indices(s, single(i, -half * s.compressive(i)));
        EXPECT_NEAR(tension.max_stress, half, 1e-12);
        EXPECT_NEAR(pressure.max_stress, half, 1e-12);
        EXPECT_NEAR(tension.tsai_wu, half, 1e-12);
        EXPECT_NEAR(pressure.tsai_wu, half, 1e-12);
        if (i < 2)
          {
            EXPECT_NEAR(tension.hashin, half, 1e-12) << i;
            EXPECT_NEAR(pressure.hashin, half, 1e-12) << i;
          }
        EXPECT_EQ(tension.von_mises, -1);
      }
  // Voigt order 23, 13, 12; Hashin has one strength for both planes along the fibre
  for (int i = 3; i < 6; ++i)
    for (const double sign : {1., -1.})
      {
        const double strength = s.shear(5 - i);
        EXPECT_NEAR(failure_indices(s, single(i, sign * strength)).max_stress, 1, 1e-12);
        EXPECT_NEAR(failure_indices(s, single(i, sign * strength)).tsai_wu, 1, 1e-12);
        EXPECT_NEAR(failure_indices(s, single(i, sign * (i == 3 ? s.shear(2) : s.shear(0)))).hashin, 1, 1e-12);
      }
}



TEST(Failure, IndicesAreTheLoadOverThatOfFailure)
{
  Vector6 stress;
  stress << 300e6, -30e6, 10e6, 12e6, -20e6, 25e6;
  const Strengths s = ply();
  for (const double scale : {0.1, 1., -1., 3.})
    {
      const FailureIndices one  = failure_indices(s, scale / std::abs(scale) * stress),
                           many = failure_indices(s, scale * stress);
      EXPECT_NEAR(many.tsai_wu, std::abs(scale) * one.tsai_wu, 1e-12);
      EXPECT_NEAR(many.hashin, std::abs(scale) * one.hashin, 1e-12);
      EXPECT_NEAR(many.max_stress, std::abs(scale) * one.max_stress, 1e-12);
      // the criterion itself at the load of failure
      const Vector6 x = scale * stress / many.tsai_wu;
      double        f = 0;
      for (int i = 0; i < 3; ++i)
        {
          const int    j  = (i + 1) % 3;
          const double Fi = 1 / (s.tensile(i) * s.compressive(i)), Fj = 1 / (s.tensile(j) * s.compressive(j));
          f += (1 / s.tensile(i) - 1 / s.compressive(i)) * x(i) + Fi * x(i) * x(i) - std::sqrt(Fi * Fj) * x(i) * x(j) +
               std::pow(x(5 - i) / s.shear(i), 2);
        }
      EXPECT_NEAR(f, 1, 1e-12);
    }
  // matrix pressure of Hashin at its load of failure
  Vector6 y;
  y << 0, -60e6, -20e6, 15e6, 5e6, 30e6;
  const Vector6 z   = y / failure_indices(s, y).hashin;
  const double  sum = z(1) + z(2), T = s.shear(2), Yc = s.compressive(1);
  EXPECT_NEAR((Yc * Yc / (4 * T * T) - 1) * sum / Yc + sum * sum / (4 * T * T) + (z(3) * z(3) - z(1) * z(2)) / (T * T) +
                (z(4) * z(4) + z(5) * z(5)) / (s.shear(0) * s.shear(0)),
              1,
              1e-12);
}



TEST(Failure, WhatIsNotKnownHasNoIndex)
{
  Strengths s;
  EXPECT_EQ(failure_indices(s, single(0, 1e9)).largest(), -1);
  s.tensile = {100, 0, 0};
  EXPECT_NEAR(failure_indices(s, single(0, 50)).max_stress, 0.5, 1e-15);
  EXPECT_EQ(failure_indices(s, single(0, 50)).tsai_wu, -1);
  EXPECT_EQ(failure_indices(s, single(0, -50)).max_stress, 0);
  s.yield = 200;
  EXPECT_NEAR(failure_indices(s, single(5, 100)).von_mises, std::sqrt(3.) / 2, 1e-15);
}



// Surfaces of a round bar in bending and in torsion, with few cells: M r/I and T r/J.
TEST(Recovery, SurfacesOfARoundBar)
{
  for (const auto &[elements, degree, tolerance] : {std::make_tuple(6, 3, 5e-3),
                                                    std::make_tuple(8, 3, 5e-3),
                                                    std::make_tuple(12, 3, 2e-3),
                                                    std::make_tuple(6, 4, 2e-3)})
    {
      const double      r = 0.02, I = M_PI / 4 * std::pow(r, 4);
      const SectionMesh mesh(ellipse_patches(r, r, elements / 2), degree, 1e-9);
      SectionMaterial   steel;
      steel.stiffness = elasticity::isotropic_stiffness(200e9, 0.3);
      const CrossSection    section(mesh, {steel});
      const SectionStresses stresses(section, mesh, {steel});
      const std::string     where = std::to_string(elements) + " elements of degree " + std::to_string(degree);
      EXPECT_NEAR(stresses.extremes(Vector6::Unit(4)).stress.cwiseAbs()(0) / (r / I), 1, tolerance) << where;
      EXPECT_NEAR(stresses.extremes(Vector6::Unit(4)).von_mises_stress / (r / I), 1, tolerance) << where;
      EXPECT_NEAR(stresses.extremes(Vector6::Unit(3)).von_mises_stress / (std::sqrt(3.) * r / (2 * I)), 1, tolerance)
        << where;
    }
}



// A cantilever under a force and a torque at its end; the probes see what the section forces make of it.
TEST(Recovery, StressesOfACantilever)
{
  Scene          scene(R"(
subsection Materials
  subsection steel
    set Type             = isotropic
    set E                = 200e9
    set Poisson ratio    = 0.3
    set Tensile strength = 400e6
    set Yield stress     = 250e6
  end
end
subsection Sections
  subsection rod
    set Type         = tube
    set Outer radius = 0.02
    set Material     = steel
    set Elements     = 12
  end
end
subsection Bodies
  subsection beam
    set Type    = beam
    set Points  = 0, 0, 0; 0, 0, 2
    set Section = rod
  end
end
subsection Joints
  subsection clamp
    set Type   = rigid
    set Body A = ground
    set Body B = beam.start
  end
end
subsection Loads
  subsection pull
    set Type   = point load
    set At     = beam.end
    set Force  = 0, 0, 1000
    set Moment = 3, 4, 0
  end
end
)");
  StaticAnalysis analysis;
  analysis.start(scene.context);
  analysis.run(scene.context);
  const auto probe = [&](const std::string &path) { return scene.input.model.probe(path).value(scene.context.state); };
  // the tension takes a part of the moment, as the beam is bent
  const double r = 0.02, A = M_PI * r * r, I = A * r * r / 4, tension = 1000 / A,
               bending = std::hypot(probe("beam.at 0.5.moment 2"), probe("beam.at 0.5.moment 3")) * r / I;
  EXPECT_NEAR(bending / (5 * r / I), 1, 0.1);
  EXPECT_NEAR(probe("beam.at 0.5.stress 11") / (tension + bending), 1, 2e-3);
  EXPECT_NEAR(probe("beam.middle.max stress index") / ((tension + bending) / 400e6), 1, 2e-3);
  EXPECT_NEAR(probe("beam.middle.von Mises index") / ((tension + bending) / 250e6), 1, 2e-3);
  EXPECT_NEAR(probe("beam.middle.stress 12") / (tension + bending), 0, 1e-3);
  EXPECT_THROW(probe("beam.middle.Tsai-Wu index"), std::invalid_argument);
  EXPECT_THROW(probe("beam.middle.stress 14"), std::invalid_argument);
}
