// 45 degree bend of Bathe and Bolourchi (1979).
//
// Reference: shooting on the exact equations of the rod, derivable, tests/reference/beams/bathe_45deg_bend.csv, for
// four conventions about shear and torsion stiffness. Expected order 2p, on a curved beam.

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  Vector3
  tip_of_bend(const std::vector<std::string> &overrides,
              const unsigned int              degree   = 4,
              const unsigned int              elements = 12)
  {
    std::vector<std::string> all = overrides;
    all.push_back("Bodies/bend/Degree = " + std::to_string(degree));
    all.push_back("Bodies/bend/Elements = " + std::to_string(elements));
    Scene scene("prm/benchmarks/bend_45.prm", all);
    scene.equilibrium();
    return {scene.value("bend.end.position x"), scene.value("bend.end.position y"), scene.value("bend.end.position z")};
  }

  struct Variant
  {
    std::string              name;
    std::vector<std::string> overrides;
    Vector3                  end_300, end_450, end_600;
    double                   tolerance = 1e-8; ///< the reference has twelve digits
  };

  const Variant variants[] = {{"Simo and Vu-Quoc",
                               {},
                               {22.2447809453, 58.7791224896, 40.1918916703},
                               {18.5081789254, 52.2385580112, 48.5029273441},
                               {15.684800534, 47.1504385736, 53.4748587918}},
                              {"BeamDyn",
                               {"Constants/GA = 5e6*5/6", "Constants/EI = 8.333e5", "Constants/GJ = 8.333e5"},
                               {22.2443415458, 58.7783138614, 40.1932664428},
                               {18.5076751469, 52.2375693328, 48.5042421389},
                               {15.6842988717, 47.1493813329, 53.4761081403}},
                              // its torsion constant is given by seven digits: 5e-8 m⁴ make 6e-7 m
                              {"Saint-Venant torsion",
                               {"Constants/GA = 5e6*5/6", "Constants/GJ = 5e6*0.140577014955155"},
                               {22.1125137743, 58.5357091829, 40.4807574411},
                               {18.3691630104, 51.9694245192, 48.7053489856},
                               {15.5576762095, 46.8915863341, 53.6079863467},
                               6e-7},
                              {"rigid in shear",
                               {"Constants/GA = 1e12"},
                               {22.2452885361, 58.7802482902, 40.1893884327},
                               {18.5087491568, 52.2400388215, 48.5001065481},
                               {15.6853557739, 47.1521502091, 53.4717629655}}};
} // namespace



TEST(Bend45, EveryVariantOfTheReference)
{
  for (const Variant &variant : variants)
    for (const auto &[P, reference] :
         {std::make_pair("300", variant.end_300), {"450", variant.end_450}, {"600", variant.end_600}})
      {
        auto overrides = variant.overrides;
        overrides.push_back(std::string("Constants/P = ") + P);
        const Vector3 error = tip_of_bend(overrides) - reference;
        EXPECT_LT(error.norm(), variant.tolerance) << variant.name << ", P = " << P;
      }
}



TEST(Bend45, ConvergesWithOrderTwiceTheDegree)
{
  const Vector3      reference = variants[0].end_600;
  const unsigned int coarse[]  = {0, 24, 8, 4, 6};
  for (unsigned int p = 1; p <= 4; ++p)
    {
      const double one = (tip_of_bend({}, p, coarse[p]) - reference).norm(),
                   two = (tip_of_bend({}, p, 2 * coarse[p]) - reference).norm();
      EXPECT_NEAR(std::log2(one / two), 2. * p, 0.3) << "degree " << p;
    }
}
