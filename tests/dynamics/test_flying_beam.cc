// Flying beam in a plane ("spaghetti"), Simo & Vu-Quoc 1986: thrown by a force and a moment at one end.
//
// Reference: an independent staggered scheme, extrapolated, tests/reference/beams/flying_spaghetti_2d.csv, which
// gives its own error, 1e-5 m at first and up to 2e-3 m (t = 8). The moment begins with a jump; a front of curvature
// runs along the beam with sqrt(EI/rho I) = 3.2 m/s and is reflected. So nothing converges with more than about the
// first order, in mesh and step: doc/benchmarks/dynamics.md has what finer ones give, down to the error of the
// reference. A throw that begins and ends smoothly shows the orders: 2p of the mesh; of the steps 2s or 2s − 1 for s =
// 1, 2, and for s = 3 from s + 1, as of all schemes of this kind where stiff parts (here extension) follow a slow
// motion.

#include "motion.h"

using namespace samara;

namespace
{
  const std::vector<std::string> start_middle_and_end = {"beam.start.position x",
                                                         "beam.start.position y",
                                                         "beam.middle.position x",
                                                         "beam.middle.position y",
                                                         "beam.end.position x",
                                                         "beam.end.position y"};

  const ReferenceRow flying_beam[] = {
    {0.5, {5.44973586, -0.111935162, 3.11397284, 3.99472338, 0.0687583604, 7.96399555}, 2e-5},
    {1, {4.32682484, 0.40782683, 3.61012171, 3.99055903, 0.370244412, 7.79600289}, 2e-5},
    {1.5, {3.55636422, 1.67717066, 4.68573279, 4.08739493, 1.00309622, 7.43644776}, 5e-5},
    {2, {3.70724243, 3.24372553, 6.0654656, 4.00963542, 2.04189716, 6.87047739}, 1.4e-4},
    {2.5, {4.96308719, 4.4760045, 6.90152774, 3.22738377, 3.58317907, 6.11187724}, 2e-5},
    {3, {6.39055726, 5.66934518, 6.95970205, 2.47197099, 5.66320507, 5.31381224}, 2e-4},
    {4, {8.05524032, 8.05160796, 7.43233361, 3.11466461, 11.2233574, 3.3683028}, 5e-4},
    {5, {9.783636, 8.20378262, 11.7275649, 3.64901562, 8.0744244, 1.75884102}, 1e-3},
    {6, {11.994548, 5.83974486, 12.6801699, 2.34515, 12.7911634, 5.63511127}, 4e-4},
    {7, {16.20128, 3.65959188, 13.1403551, 3.41156774, 16.1024098, 7.33693489}, 6e-4},
    {8, {13.3321732, 1.03155939, 16.8908653, 3.69356877, 18.2138159, 8.44569368}, 2e-3},
    {9, {18.6628126, 6.07931113, 18.4180164, 2.22292005, 19.0637412, 6.14530448}, 8e-4},
    {10, {22.9706437, 6.41191557, 19.1119839, 3.79944904, 21.3248104, 3.60973516}, 1e-3}};

  std::vector<std::string>
  with_mesh(std::vector<std::string> overrides, const unsigned int degree, const unsigned int elements)
  {
    overrides.push_back("Bodies/beam/Degree = " + std::to_string(degree));
    overrides.push_back("Bodies/beam/Elements = " + std::to_string(elements));
    return overrides;
  }

  /** Until the end of a throw with the course of sin⁴. */
  std::vector<double>
  smooth_throw(std::vector<std::string> overrides, const unsigned int degree, const unsigned int elements)
  {
    overrides = with_mesh(overrides, degree, elements);
    overrides.push_back("Loads/throw/Force = t < 2.5 ? 8*sin(pi*t/2.5)^4 : 0, 0, 0");
    overrides.push_back("Loads/throw/Moment = 0, 0, t < 2.5 ? -80*sin(pi*t/2.5)^4 : 0");
    overrides.push_back("Dynamic/End time = 2.5");
    return Motion("flying_beam", overrides, start_middle_and_end).at(2.5);
  }

  double
  distance(const std::vector<double> &a, const std::vector<double> &b)
  {
    double distance = 0;
    for (unsigned int i = 0; i < a.size(); ++i)
      distance = std::max(distance, std::abs(a[i] - b[i]));
    return distance;
  }
} // namespace



TEST(FlyingBeam, FollowsTheReference)
{
  const Motion motion("flying_beam", with_mesh(integrator(3, 0.5, 0.05, "1e-10"), 3, 40), start_middle_and_end);
  for (const ReferenceRow &row : flying_beam)
    EXPECT_LT(motion.error(row.t, row.places), row.error + 5e-4) << "t = " << row.t;
}



TEST(FlyingBeam, KeepsEnergyInFreeFlight)
{
  const Motion motion("flying_beam", with_mesh(integrator(3, 1, 0.05, "1e-12"), 3, 10), start_middle_and_end);
  EXPECT_LT(std::abs(motion.budget.balance()), 1e-8); // of 540 J
  EXPECT_EQ(motion.budget.dissipated, 0);
  EXPECT_NEAR(motion.budget.loads, motion.budget.kinetic + motion.budget.strain, 1e-8);
  EXPECT_EQ(motion.report.n_steps, 200u) << "a step ends where the loads end";
}



TEST(FlyingBeam, ConvergesWithOrderTwiceTheDegreeIfThrownSmoothly)
{
  const auto         scheme    = integrator(3, 1, 0.05, "1e-11");
  const auto         reference = smooth_throw(scheme, 4, 20);
  const unsigned int coarse[]  = {0, 30, 10, 8, 5};
  for (unsigned int p = 1; p <= 4; ++p)
    {
      const double one = distance(smooth_throw(scheme, p, coarse[p]), reference),
                   two = distance(smooth_throw(scheme, p, 2 * coarse[p]), reference);
      EXPECT_NEAR(std::log2(one / two), 2. * p, 0.6) << "degree " << p << ", errors " << one << ", " << two;
    }
}



TEST(FlyingBeam, ConvergesWithTheOrderOfTheSchemeIfThrownSmoothly)
{
  const auto reference = smooth_throw(integrator(3, 1, 0.0125, "1e-12"), 3, 8);
  for (const Member &member : {Member{1, 1, 0.1}, Member{2, 1, 0.1}, Member{2, 0, 0.1}})
    member.expect_order(
      [&](const std::vector<std::string> &overrides) { return distance(smooth_throw(overrides, 3, 8), reference); });
  for (const double radius : {0.5, 1.})
    {
      const double one = distance(smooth_throw(integrator(3, radius, 0.2), 3, 8), reference),
                   two = distance(smooth_throw(integrator(3, radius, 0.1), 3, 8), reference);
      EXPECT_GT(std::log2(one / two), 3.9) << "spectral radius " << radius;
      EXPECT_LT(two, 1e-6);
    }
}
