/*
 * Problem:   sections of a model by shape and material, as beams use them
 * Reference: independent section analyses and closed forms (tests/reference/sections); a shape that is the same body
 * given in another way; the twisted rectangle of closed form. Deflections: Euler–Bernoulli with the section's numbers.
 */

#include <samara/cosserat/section_kinds.h>
#include <samara/rotation/matrix6.h>
#include <samara/section/section_constants.h>

#include "../benchmarks/cpu_seconds.h"
#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>

#include "stiffness.h"

using namespace samara;

namespace
{
  const std::string metals_and_plies = R"(
subsection Materials
  subsection metal
    set Type          = isotropic
    set E             = 100
    set Poisson ratio = 0.2
    set Density       = 3
  end
  subsection soft
    set Copy of = metal
    set E       = 10
  end
  subsection epoxy
    # AS4/3501-6 in psi, as in the files of the boxes
    set Type = orthotropic
    set E1   = 20.59e6
    set E2   = 1.42e6
    set G12  = 0.87e6
    set G23  = 0.696e6
    set nu12 = 0.42
    set nu23 = 0.42
    set Density = 1
  end
end
subsection Layups
  subsection six_15
    set Material      = epoxy
    set Angles        = 15_6
    set Ply thickness = 0.005
  end
  subsection steps
    set Copy of = six_15
    set Angles  = [0/30]_3
  end
  subsection cross
    set Copy of = six_15
    set Angles  = [0/90]_3
  end
  subsection six_0
    set Copy of = six_15
    set Angles  = 0_6
  end
  subsection hybrid
    set Plies = metal, 0, 0.05; soft, 0, 0.05
  end
end
)";



  /** A model with a section <s>, and a beam on it with further entries. */
  std::string
  model(const std::string &section, const std::string &of_beam = "    set Points = 0, 0, 0; 10, 0, 0\n")
  {
    return metals_and_plies + "subsection Sections\n  subsection s\n" + section +
           "  end\nend\nsubsection Bodies\n  subsection beam\n    set Type = beam\n    set Section = s\n" + of_beam +
           "  end\nend\n";
  }



  SectionValues
  values_of_section(const std::string &section, const Vector3 &curvature = Vector3::Zero())
  {
    const Scene scene(model(section));
    return scene.input.model.find<Section>("s", "section").at(0, curvature);
  }



  const std::string box_entries =
    "    set Type     = box\n    set Width 2  = 0.953\n    set Width 3  = 0.530\n    set Elements = 10\n";
} // namespace



TEST(SectionKinds, BoxesAgreeWithAllTheirCouplings)
{
  EXPECT_LT(difference(values_of_section(box_entries + "    set Layup = six_15\n").stiffness,
                       reference_stiffness("boxbeam_CUS_15_6")),
            2e-4);
  EXPECT_LT(difference(values_of_section(box_entries + "    set Layup = steps\n").stiffness,
                       reference_stiffness("boxbeam_CUS_0_30_3")),
            2e-4);
  EXPECT_LT(difference(values_of_section(box_entries + "    set Layup = six_0\n    set Layup of right = cross\n"
                                                       "    set Layup of left = cross\n")
                         .stiffness,
                       reference_stiffness("boxbeam_crossply_0_90")),
            2e-4);
}



TEST(SectionKinds, SolidShapesAgreeWithTheLists)
{
  EXPECT_LT(difference(values_of_section("    set Type = rectangle\n    set Width 2 = 0.1\n    set Width 3 = 0.1\n"
                                         "    set Material = metal\n")
                         .stiffness,
                       reference_stiffness("becas_S1_square")),
            5e-5);
  EXPECT_LT(difference(values_of_section(
                         "    set Type = tube\n    set Outer radius = 0.1\n    set Inner radius = 0.09\n"
                         "    set Material = metal\n")
                         .stiffness,
                       reference_stiffness("becas_C1_cylinder")),
            1e-5);
  // two materials side by side are a strip of two plies that is turned: the first ply comes to lie at -2
  EXPECT_LT(difference(values_of_section("    set Type = rectangle\n    set Width 2 = 0.1\n    set Layup = hybrid\n"
                                         "    set Rotation = -90 deg\n    set Elements per ply = 6\n")
                         .stiffness,
                       reference_stiffness("becas_S2_two_materials")),
            3e-4);
  for (const auto &row : reference_rows("sections/isotropic_sections.csv"))
    if (row.at("section") == "ellipse semi-axes x=2 y=1" && row.at("nu") == "0.3")
      {
        const Matrix6 K = values_of_section("    set Type = ellipse\n    set Radius 2 = 2\n    set Radius 3 = 1\n"
                                            "    set Material = metal\n")
                            .stiffness;
        const double G = 100 / 2.4;
        EXPECT_NEAR(K(3, 3) / G / std::stod(row.at("J_exact")), 1, 1e-6);
      }
}



// A rod of one material is a disc, whose numbers are known.
TEST(SectionKinds, RodHasClosedForms)
{
  const SectionValues v = values_of_section(
    "    set Type = tube\n    set Outer radius = 0.2\n    set Material = metal\n    set Elements = 12\n");
  const double A = M_PI * 0.04, I = M_PI * std::pow(0.2, 4) / 4, G = 100 / 2.4;
  EXPECT_NEAR(v.stiffness(0, 0) / (100 * A), 1, 1e-6);
  EXPECT_NEAR(v.stiffness(3, 3) / (2 * G * I), 1, 1e-6);
  EXPECT_NEAR(v.stiffness(4, 4) / (100 * I), 1, 1e-6);
  EXPECT_NEAR(v.inertia(0, 0) / (3 * A), 1, 1e-6);
  EXPECT_NEAR(v.inertia(3, 3) / (6 * I), 1, 1e-6);
}



// An I and a C without couplings: areas and second moments by rectangles, the shear centre of a thin channel by its
// formula.
// Said in two ways, by E and by material: where shear factors differ it is told, with those that the analysis has.
TEST(SectionKinds, ShearFactorsOfTheEnergyAreTold)
{
  const std::string by_E        = "    set E = 260\n    set Poisson ratio = 0.3\n    set Density = 1\n",
                    by_material = "    set Material = nu_03\n    set Elements = 12\n";
  const auto with_material      = [](std::string text) {
    const std::string head = "subsection Materials\n";
    return text.insert(text.find(head) + head.size(),
                       "  subsection nu_03\n    set Type = isotropic\n    set E = 260\n    set Poisson ratio = 0.3\n"
                            "    set Density = 1\n  end\n");
  };
  for (const std::string shape : {"    set Type = rectangle\n    set Width 2 = 2\n    set Width 3 = 1\n",
                                  "    set Type = tube\n    set Outer radius = 1\n    set Inner radius = 0.9\n",
                                  "    set Type = tube\n    set Outer radius = 1\n"})
    {
      const Scene   told(model(shape + by_E)), analysed(with_material(model(shape + by_material)));
      const Matrix6 C    = analysed.input.model.find<Section>("s", "section").at(0, Vector3::Zero()).stiffness;
      const auto remarks = dynamic_cast<const HasRemarks &>(told.input.model.find<Section>("s", "section")).remarks();
      ASSERT_EQ(remarks.size(), 1u) << shape;
      const double GA = C(0, 0) / 2.6;
      EXPECT_NE(remarks[0].text.find(": " + number_to_text("%.4g", C(1, 1) / GA) + " and " +
                                     number_to_text("%.4g", C(2, 2) / GA)),
                std::string::npos)
        << remarks[0].text << C(1, 1) / GA << " " << C(2, 2) / GA;
    }
}



TEST(SectionKinds, IAndCHaveTheirRectangles)
{
  const std::string I =
    "    set Type = I\n    set Height = 0.2\n    set Lower width = 0.1\n    set Lower thickness = 0.01\n"
    "    set Web thickness = 0.006\n    set Material = metal\n";
  const Matrix6 K = values_of_section(I).stiffness;
  const double  A = 2 * 0.1 * 0.01 + 0.18 * 0.006, I2 = (0.1 * std::pow(0.2, 3) - 0.094 * std::pow(0.18, 3)) / 12,
               I3 = (2 * 0.01 * std::pow(0.1, 3) + 0.18 * std::pow(0.006, 3)) / 12;
  EXPECT_NEAR(K(0, 0) / (100 * A), 1, 1e-9);
  EXPECT_NEAR(K(4, 4) / (100 * I2), 1, 1e-9);
  EXPECT_NEAR(K(5, 5) / (100 * I3), 1, 1e-9);
  const Matrix6 unequal =
    values_of_section(I + "    set Upper width = 0.05\n    set Upper thickness = 0.02\n").stiffness;
  EXPECT_NEAR(unequal(0, 0) / 100, 0.1 * 0.01 + 0.05 * 0.02 + 0.17 * 0.006, 1e-9);
  // E A y₃ of the parts
  EXPECT_NEAR(unequal(0, 4) / 100, 0.1 * 0.01 * -0.095 + 0.05 * 0.02 * 0.09 + 0.17 * 0.006 * (-0.005), 1e-9);

  const SectionValues    C = values_of_section("    set Type = C\n    set Height = 0.2\n    set Width = 0.1\n"
                                               "    set Flange thickness = 0.002\n    set Web thickness = 0.002\n"
                                               "    set Material = metal\n");
  const SectionConstants c(inverse6(C.stiffness), C.inertia);
  const double           h = 0.198, b = 0.099; // between the middles of the walls
  EXPECT_NEAR(c.shear_centre(0), 0.001 - 3 * b * b / (h + 6 * b), 2e-4);
  EXPECT_NEAR(c.shear_centre(1), 0, 1e-9);
  EXPECT_NEAR(c.EA / 100, 0.2 * 0.002 + 2 * 0.098 * 0.002, 1e-9);
  EXPECT_NEAR(c.mass_centre(0), c.tension_centre(0), 1e-9);
  EXPECT_GT(c.mass_centre(0), 0.02);
}



// The same body, moved and turned, is the same section seen from another reference line.
TEST(SectionKinds, PositionAndRotationMoveTheBody)
{
  const SectionValues own   = values_of_section(box_entries + "    set Layup = steps\n"),
                      moved = values_of_section(
                        box_entries +
                        "    set Layup = steps\n    set Position = 0.3, -0.2\n    set Rotation = 40 deg\n");
  const double  a = 40 * M_PI / 180;
  const Matrix3 R = rotation_of_vector({a, 0, 0});
  // a strain of the new line is one of the old: γ' = Rᵀ(γ + κ × x), κ' = Rᵀκ
  Matrix6 T                   = Matrix6::Zero();
  T.topLeftCorner<3, 3>()     = R.transpose();
  T.bottomRightCorner<3, 3>() = R.transpose();
  T.topRightCorner<3, 3>()    = -R.transpose() * skew(Vector3(0, 0.3, -0.2));
  EXPECT_LT(difference(moved.stiffness, T.transpose() * own.stiffness * T), 1e-8);
  EXPECT_LT(difference(moved.inertia + Matrix6::Identity() * 1e-9,
                       T.transpose() * own.inertia * T + Matrix6::Identity() * 1e-9),
            1e-8);
}



TEST(SectionKinds, BeamGivesItsTwistAndCurvature)
{
  const std::string strip =
    "    set Type = rectangle\n    set Width 2 = 1\n    set Width 3 = 0.1\n    set Material = metal\n"
    "    set Degree = 4\n";
  // pretwisted rectangle: tension and torsion are coupled by E (I_p − J) k₁
  const Scene twisted(
    model(strip, "    set Points = 0, 0, 0; 20, 0, 0\n    set Twist = 0.01*s\n    set Elements = 2\n"));
  const auto &section = twisted.input.model.find<AnalysedSection>("s", "section");
  ASSERT_EQ(section.curvatures().size(), 2u) << "that of the beam, and none";
  EXPECT_NEAR(section.curvatures()[1](0), 0.01, 1e-9);
  EXPECT_NEAR(section.curvatures()[1].tail<2>().norm(), 0, 1e-9);
  for (const auto &row : reference_rows("sections/pretwisted_rectangle.csv"))
    if (row.at("t") == "0.1" && row.at("nu") == "0")
      {
        // ν = 0.2 here; the coupling depends on it by less than 1e-5
        EXPECT_NEAR(section.at(0, section.curvatures()[1]).stiffness(0, 3) / 100 / 0.01 /
                      std::stod(row.at("K14_over_k1")),
                    1,
                    1e-5);
      }

  // ... and of a ring of radius 4, whose beam has the curvature 1/4 about axis 3 or 2
  const Scene ring(
    model(strip, "    set Shape = arc\n    set Points = 4, 0, 0; 0, 4, 0; -4, 0, 0\n    set Elements = 3\n"));
  const auto curvatures = ring.input.model.find<AnalysedSection>("s", "section").curvatures();
  ASSERT_EQ(curvatures.size(), 2u);
  EXPECT_NEAR(curvatures[1].norm(), 0.25, 1e-7);
  EXPECT_NEAR(curvatures[1](0), 0, 1e-9);

  const Scene without(model(strip + "    set Initial curvature = none\n",
                            "    set Points = 0, 0, 0; 20, 0, 0\n    set Twist = 0.01*s\n"));
  EXPECT_EQ(without.input.model.find<AnalysedSection>("s", "section").curvatures().size(), 1u);
}



// Golovin's bar, bent as a beam: the rotation of its end is M L times the compliance of the curved section.
TEST(SectionKinds, CurvedBeamBendsAsGolovinSays)
{
  for (const auto &row : reference_rows("sections/curved_bar_pure_bending.csv"))
    if (row.at("d_over_R") == "0.5")
      {
        Scene          scene(R"(
subsection Materials
  subsection metal
    set Type          = isotropic
    set E             = 1e6
    set Poisson ratio = 0
    set Density       = 1
  end
end
subsection Sections
  subsection s
    set Type     = rectangle
    set Width 2  = 1
    set Width 3  = 0.4
    set Material = metal
    set Degree   = 5
  end
end
subsection Bodies
  subsection beam
    set Type     = beam
    set Shape    = arc
    set Points   = 2, 0, 0; 1.4142135623730951, 1.4142135623730951, 0; 0, 2, 0
    set Section  = s
    set Elements = 4
    set Degree   = 4
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
  subsection couple
    set Type   = point load
    set At     = beam.end
    set Moment = 0, 0, 1e-3
  end
end
)");
        StaticAnalysis analysis;
        analysis.start(scene.context);
        analysis.run(scene.context);
        const double angle = scene.input.model.probe("beam.end.rotation z").value(scene.context.state) * M_PI / 180;
        EXPECT_NEAR(angle / (1e-3 * M_PI * std::stod(row.at("F66")) / 1e6), 1, 1e-6);
      }
}



TEST(SectionKinds, SayWhatIsWrong)
{
  const auto says = [](const std::string &section, const std::string &wanted) {
    const std::string text = complaint_of(model(section));
    EXPECT_NE(text.find(wanted), std::string::npos) << section << text;
    EXPECT_NE(text.find(".prm:"), std::string::npos) << text;
    EXPECT_EQ(text.find("beam"), std::string::npos) << "a section is one mistake, however many beams have it: " << text;
  };
  const std::string rectangle = "    set Type = rectangle\n    set Width 2 = 1\n";
  says(rectangle + "    set Material = metal\n", "<Width 3>");
  says(rectangle + "    set Width 3 = 1\n    set Material = metall\n", "metal");
  says(rectangle + "    set Width 3 = 1\n    set Material = metal\n    set E = 3\n", "<E> has no effect");
  says(rectangle + "    set Width 3 = 1\n    set E = 3\n    set Degree = 3\n", "belongs to the analysis");
  says(rectangle + "    set Width 3 = 1\n    set Layup = hybrid\n", "a layup has its thickness");
  says(rectangle + "    set Layup = hybrid\n    set Material = metal\n", "either <Material> or <Layup>");
  says(rectangle + "    set Layup = hybrit\n", "hybrid");
  says(box_entries, "needs a <Layup>, or a <Material> and <Thickness>");
  says(box_entries + "    set Material = metal\n", "<Thickness>");
  says(box_entries + "    set Material = metal\n    set Thickness = 0.265\n", "too thick");
  says(box_entries + "    set Layup = six_15\n    set Thickness = 0.1\n", "both given");
  says("    set Type = tube\n    set Outer radius = 0.02\n    set Layup = six_15\n", "thicker than the tube");
  says("    set Type = tube\n    set Outer radius = 1\n    set Inner radius = 1\n    set Material = metal\n",
       "smaller than");
  says("    set Type = ellipse\n    set Radius 2 = 1\n    set Material = metal\n", "<Radius 3>");
  const std::string I =
    "    set Type = I\n    set Height = 0.2\n    set Lower width = 0.1\n    set Lower thickness = 0.01\n"
    "    set Material = metal\n";
  says(I + "    set Web thickness = 0.1\n", "thinner");
  says(I + "    set Web thickness = 0.01\n    set Upper thickness = 0.19\n", "nothing is left");
  says("    set Type = C\n    set Height = 0.2\n    set Width = 0.1\n    set Flange thickness = 0.1\n"
       "    set Web thickness = 0.002\n    set Material = metal\n",
       "nothing is left");
}



// What was found is kept by content, for all models of the program; no change of content is overlooked.
TEST(SectionKinds, WhatWasFoundIsKept)
{
  const auto timed = [](const std::string &section, SectionValues &values) {
    const double start = cpu_seconds();
    values             = values_of_section(section);
    return cpu_seconds() - start;
  };
  const std::string box = "    set Type = box\n    set Width 2 = 0.7\n    set Width 3 = 0.4\n    set Layup = steps\n"
                          "    set Elements = 24\n";
  SectionValues     first, second;
  const double      seconds = timed(box, first);
  EXPECT_LT(timed(box, second), 0.5 * seconds);
  EXPECT_EQ(first.stiffness, second.stiffness);
  const std::string small =
    "    set Type = rectangle\n    set Width 2 = 0.7\n    set Layup = steps\n    set Elements = 2\n"
    "    set Degree = 2\n";
  const Matrix6 own = values_of_section(small).stiffness;
  for (const std::string change : {"    set Width 2 = 0.70001\n",
                                   "    set Layup = cross\n",
                                   "    set Degree = 3\n",
                                   "    set Elements = 3\n",
                                   "    set Position = 1e-5, 0\n",
                                   "    set Rotation = 0.001\n"})
    {
      std::string changed = small;
      const auto  entry   = change.substr(0, change.find('='));
      if (const auto at = changed.find(entry); at != std::string::npos)
        changed.erase(at, changed.find('\n', at) + 1 - at);
      EXPECT_GT(difference(values_of_section(changed + change).stiffness, own), 1e-7) << change;
    }
}



TEST(SectionKinds, TooMuchTwistOfABeamIsToldOfTheBeam)
{
  const std::string text =
    complaint_of(model("    set Type = rectangle\n    set Width 2 = 1\n    set Width 3 = 0.1\n"
                       "    set Material = metal\n",
                       "    set Shape = arc\n    set Points = 0.4, 0, 0; 0, 0.4, 0; -0.4, 0, 0\n"));
  EXPECT_NE(text.find("section <s> in beam <beam>: the curvature"), std::string::npos) << text;
}
