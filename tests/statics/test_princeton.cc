// Straight cantilevers under dead end forces that bend in two directions and twist.
//
// References: Princeton beam, the model of Bauchau et al. (2016), derivable,
// tests/reference/beams/princeton_beam_exact_model.csv; composite cantilever of Wang, Sprague et al. (2017), the
// values of Kynema-FMB in tests/reference/beams/beamdyn_composite_cantilever.csv. Shooting with 30 digits confirms
// these to 15 digits, (-0.0902726627566, -0.0647488486259, 1.22973648292376); the other column of the file is 9e-12
// off.

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  Vector3
  vector(const Scene &scene, const std::string &probe)
  {
    return {scene.value(probe + " x"), scene.value(probe + " y"), scene.value(probe + " z")};
  }

  const Vector3 composite_reference(-0.0902726627566296, -0.0647488486259039, 1.22973648292371);

  Vector3
  composite(const unsigned int degree, const unsigned int elements)
  {
    Scene scene("prm/benchmarks/composite_cantilever.prm",
                {"Bodies/beam/Degree = " + std::to_string(degree),
                 "Bodies/beam/Elements = " + std::to_string(elements)});
    scene.equilibrium();
    return vector(scene, "beam.end.displacement");
  }
} // namespace



TEST(PrincetonBeam, EveryRowOfTheReference)
{
  struct Row
  {
    double  P, angle;
    Vector3 displacement, rotation;
  };
  const Row rows[] = {
    {4.448, 0, {-3.391439588e-05, 0, 0.005359539372}, {0, -0.01581838878, 0}},
    {4.448, 30, {-0.001916839679, 0.03994998597, 0.004751073378}, {0.005871772959, -0.01376382885, 0.1182406935}},
    {4.448, 60, {-0.005527197951, 0.06813009953, 0.002862209211}, {0.005742823133, -0.008015866233, 0.2019819895}},
    {4.448, 90, {-0.007260121247, 0.07808297697, 0}, {0, 0, 0.2316711867}},
    {8.896, 0, {-0.0001355800264, 0, 0.0107154022}, {0, -0.03162807164, 0}},
    {8.896, 30, {-0.007661002699, 0.07945722266, 0.01014725635}, {0.02330168759, -0.02790925254, 0.2368696088}},
    {8.896, 60, {-0.02047364984, 0.1299252602, 0.00665439017}, {0.02145351334, -0.01655960126, 0.3894816593}},
    {8.896, 90, {-0.02602480273, 0.1462618964, 0}, {0, 0, 0.4394454223}},
    {13.345, 0, {-0.0003048103977, 0, 0.01606512899}, {0, -0.04742392438, 0}},
    {13.345, 30, {-0.01716382607, 0.1179039223, 0.01677805373}, {0.05163038784, -0.04281477152, 0.355706917}},
    {13.345, 60, {-0.04120723632, 0.18192344, 0.01171649617}, {0.04370202783, -0.02577062527, 0.553959648}},
    {13.345, 90, {-0.0504066697, 0.2006952929, 0}, {0, 0, 0.612932591}}};
  for (const Row &row : rows)
    {
      Scene scene("prm/benchmarks/princeton_beam.prm",
                  {"Constants/P = " + std::to_string(row.P) + " N",
                   "Constants/angle = " + std::to_string(row.angle) + " deg"});
      scene.equilibrium();
      const Vector3 u = vector(scene, "beam.end.displacement") - row.displacement,
                    r = vector(scene, "beam.end.rotation") * M_PI / 180 - row.rotation;
      // the reference has ten digits
      EXPECT_LT(u.norm() / row.displacement.norm(), 1e-9) << row.P << " N at " << row.angle;
      EXPECT_LT(r.norm() / row.rotation.norm(), 1e-9) << row.P << " N at " << row.angle;
    }
}



TEST(CompositeCantilever, TwelveDigitsOfTheReference)
{
  for (const unsigned int p : {3, 4})
    {
      EXPECT_LT((composite(p, 24) - composite_reference).norm(), 2e-12) << "degree " << p;
    }
}



TEST(CompositeCantilever, ConvergesWithOrderTwiceTheDegree)
{
  const unsigned int coarse[] = {0, 16, 6, 3, 3};
  for (unsigned int p = 1; p <= 4; ++p)
    {
      const double one = (composite(p, coarse[p]) - composite_reference).norm(),
                   two = (composite(p, 2 * coarse[p]) - composite_reference).norm();
      EXPECT_NEAR(std::log2(one / two), 2. * p, 0.3) << "degree " << p;
    }
}
