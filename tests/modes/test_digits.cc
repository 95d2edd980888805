// Frequencies of slender beams, of very small and of very large ones, to all the digits the mesh allows.
//
// Exact: the cantilever of Timoshenko without rotary inertia, EI w'''' + (μω²EI/GA) w'' − μω² w = 0, by the determinant
// of its boundary conditions below; the rotating one, flap at Ω = 12 √(EI/μL⁴), by power series in
// 40 digits (Wright et al. 1982 give 13.1702).

#include <gtest/gtest.h>

#include "modes.h"

using namespace samara;

namespace
{
  /** The lowest frequency of a cantilever with L = EI = μ = 1 and the shear stiffness GA. */
  double
  timoshenko(const double GA)
  {
    using Real             = long double;
    const auto determinant = [&](const Real omega) {
      // γ = w' − θ, GA γ' = −s w, θ' = w'' + k w; w = P (cosh − cos) + Q (sinh/α − sin/β), θ = P (α sinh + β sin) + Q
      // (cosh − cos)
      const Real s = omega * omega, k = s / GA, root = std::sqrt(k * k / 4 + s), a = std::sqrt(root - k / 2),
                 b = std::sqrt(root + k / 2), alpha = a + k / a, beta = b - k / b;
      const Real C = std::cosh(a), S = std::sinh(a), c = std::cos(b), z = std::sin(b);
      // θ' and γ/k at x = 1
      const Real m_P = alpha * a * C + beta * b * c, m_Q = a * S + b * z;
      const Real v_P = -S / a + z / b, v_Q = -C / (a * alpha) - c / (b * beta);
      return m_P * v_Q - m_Q * v_P;
    };
    Real low = 2, high = 3.6;
    if (determinant(low) * determinant(high) > 0)
      throw std::logic_error("no root");
    for (unsigned int i = 0; i < 100; ++i)
      {
        const Real middle                                          = (low + high) / 2;
        (determinant(low) * determinant(middle) <= 0 ? high : low) = middle;
      }
    return static_cast<double>(low);
  }

  std::string
  cantilever_of_length(const std::string &ratio, const double L = 1, const std::string &more = "")
  {
    const std::string l = exact(L);
    return "set Analyses = modal\nsubsection Sections\n subsection s\n set Type = engineering constants\n set EA = 3*" +
           ratio + "/" + l + "^2\n set GA2 = " + ratio + "/" + l + "^2\n set GA3 = " + ratio + "/" + l +
           "^2\n set GJ = 0.8\n set EI2 = 1\n set EI3 = 1\n set Mass = 1\n end\nend\nsubsection Bodies\n subsection beam\n"
           " set Type = beam\n set Points = 0, 0, 0; " +
           l +
           ", 0, 0\n set Section = s\n set Elements = 16\n set Degree = 4\n end\nend\nsubsection Joints\n subsection clamp\n"
           " set Type = rigid\n set Body A = ground\n set Body B = beam.start\n end\nend\n" +
           more + "subsection Modal\n set Modes = 4\nend\n";
  }
} // namespace



TEST(Digits, SlendernessOfTimoshenkosCantilever)
{
  for (const std::string ratio : {"1e2", "1e4", "1e7", "1e10", "1e14"})
    {
      Scene        scene(cantilever_of_length(ratio));
      const double expected = timoshenko(std::stod(ratio));
      const auto  &modes    = scene.modes();
      for (unsigned int i : {0, 1})
        {
          EXPECT_NEAR(modes.at(i).frequency() / expected, 1., 1e-10) << "GA L^2/EI = " << ratio;
          EXPECT_LT(modes[i].error, 1e-12);
          EXPECT_LT(std::abs(modes[i].damping_ratio()), 1e-12);
        }
      EXPECT_NEAR(modes[1].frequency() / modes[0].frequency(), 1., 1e-12);
    }
}



// The stresses that stretch a turning blade come from balance, not from strains, which know 16 digits of GA or EA.
TEST(Digits, SlendernessOfATurningBlade)
{
  const std::pair<std::string, double> cases[] = {{"1e10", 13.170150483016214}, {"1e14", 13.170150487505728}};
  for (const auto &[ratio, expected] : cases)
    {
      Scene scene(cantilever_of_length(
        ratio, 1, "subsection Loads\n subsection r\n set Type = steady rotation\n set Speed = 12\n end\nend\n"));
      scene.equilibrium();
      const auto flap = frequencies(scene, 2), lag = frequencies(scene, 1);
      // the blade stretches, by less than this
      const double stretch = 144 / (3 * std::stod(ratio));
      EXPECT_NEAR(flap.at(0) / expected, 1., 1e-10 + 0.2 * stretch) << ratio;
      EXPECT_NEAR(lag.at(0) / std::sqrt(expected * expected - 144), 1., 5e-10 + 1.2 * stretch) << ratio;
    }
}



TEST(Digits, Sizes)
{
  const double expected = timoshenko(2e4);
  for (const double L : {1e-9, 1e-6, 1e-3, 1., 1e3})
    {
      Scene scene(cantilever_of_length("2e4", L));
      EXPECT_NEAR(scene.modes().at(0).frequency() * L * L / expected, 1., 1e-10) << L;
      EXPECT_LT(std::abs(scene.modes()[0].damping_ratio()), 1e-12) << L;
    }
}



// A round rod vibrates alike in both directions, bent by its weight only by little.
TEST(Digits, EqualFrequenciesOfTheFirstModel)
{
  Scene scene("prm/examples/first_model.prm");
  scene.equilibrium();
  const auto &modes = scene.modes();
  // the sag of 0.9 mm parts them: by (sag/L)², not by round-off
  EXPECT_NEAR(modes.at(0).frequency() / modes.at(1).frequency(), 1., 1e-5);
  Scene straight("prm/examples/first_model.prm", {"Loads/weight/Acceleration = 0, 0, 0"});
  straight.equilibrium();
  EXPECT_NEAR(straight.modes().at(0).frequency() / straight.modes().at(1).frequency(), 1., 1e-12);
}
