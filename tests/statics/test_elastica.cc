// Cantilever under a dead end force.
//
// Reference: elastica (inextensible, rigid in shear), derivable, tests/reference/beams/elastica_tip_force.csv, with
// alpha = P L²/EI. What finite axial and shear stiffnesses change is in proportion to their compliance.

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  struct Row
  {
    double alpha, shortening, deflection, rotation;
  };

  const Row reference[] = {{0.25, 0.0041178184099766, 0.082745915354416, 0.12429244211364},
                           {1, 0.056433236283379, 0.3017207737998, 0.46135194971187},
                           {2, 0.16064172082516, 0.49345748039669, 0.78174983155656},
                           {5, 0.38762836072443, 0.71379152361189, 1.2153681176117},
                           {10, 0.55499559775874, 0.8106090248815, 1.4302855388216},
                           {15, 0.6352857803621, 0.84771567433227, 1.5018401541772}};

  Row
  tip_of_elastica(const double       alpha,
                  const std::string &rigid,
                  const unsigned int degree   = 4,
                  const unsigned int elements = 12)
  {
    Scene scene("prm/benchmarks/elastica.prm",
                {"Constants/alpha = " + std::to_string(alpha),
                 "Constants/rigid = " + rigid,
                 "Bodies/beam/Degree = " + std::to_string(degree),
                 "Bodies/beam/Elements = " + std::to_string(elements)});
    scene.equilibrium();
    return {alpha,
            -scene.value("beam.end.displacement x"),
            -scene.value("beam.end.displacement z"),
            scene.value("beam.end.rotation y") * M_PI / 180};
  }
} // namespace



TEST(Elastica, RowsOfTheReference)
{
  for (const Row &row : reference)
    {
      const Row computed = tip_of_elastica(row.alpha, "1e10");
      EXPECT_NEAR(computed.shortening / row.shortening, 1., 1e-7) << row.alpha;
      EXPECT_NEAR(computed.deflection / row.deflection, 1., 1e-8) << row.alpha;
      EXPECT_NEAR(computed.rotation / row.rotation, 1., 1e-8) << row.alpha;
    }
}



// The difference to the inextensible beam is that of the physics, in proportion to the compliance, at slendernesses
// (sqrt(12 EI/EA) = h/L) of 350, 3500 and 35000: a locking element would be worse for slender beams.
TEST(Elastica, DifferenceIsProportionalToAxialAndShearCompliance)
{
  const double exact = reference[3].deflection;
  const double e6 = tip_of_elastica(5, "1e6").deflection - exact, e8 = tip_of_elastica(5, "1e8").deflection - exact;
  EXPECT_NEAR(e6 / e8, 100., 0.1);
}



TEST(Elastica, DiscretisationErrorDoesNotDependOnSlenderness)
{
  for (unsigned int p = 1; p <= 4; ++p)
    {
      std::vector<double> errors;
      for (const std::string rigid : {"1.2e5", "1.2e7", "1.2e9"})
        errors.push_back(tip_of_elastica(5, rigid, p, 12 / p).deflection - tip_of_elastica(5, rigid, 4, 48).deflection);
      EXPECT_NEAR(errors[1] / errors[0], 1., 1e-2) << "degree " << p;
      EXPECT_NEAR(errors[2] / errors[0], 1., 1e-2) << "degree " << p;
    }
}
