// Small displacements: answers of linear theory, by one linear solution about the reference configuration, so that what
// is of second order in the loads does not spoil the comparison.
//
// References: closed forms by Castigliano's theorem, stated at each test. With statically determinate loads at nodes
// and p ≥ 2 straight beams are exact; for a load along the beam and for curved beams the order is 2p.

#include <samara/solvers/linear.h>

#include <gtest/gtest.h>

#include "entries.h"

using namespace samara;

namespace
{
  /** Displacements and rotations at full load as linear theory gives them. */
  class Linear
  {
  public:
    explicit Linear(const std::string &source, const std::vector<std::string> &overrides = {})
      : scene(source, overrides)
      , y(6 * scene.system.layout.n_nodes, 0.)
    {
      const System       &system = scene.system;
      State               state  = system.reference();
      std::vector<double> r;
      system.residual(state, state.stress, r);
      state.factor = 0; // without the geometric stiffness of the loads
      SparseMatrix K(system.layout.pattern);
      system.tangent(state, K);
      const auto solver = make_solver(system.layout.pattern);
      solver->factorize(K);
      solver->solve(r.data());
      for (unsigned int i = 0; i < 6 * (system.layout.n_nodes - 1); ++i)
        y[6 + i] = -r[i];
    }

    /** Displacement, then rotation [rad], of a point in inertial axes. */
    Vector6
    at(const std::string &point) const
    {
      const Frame   frame = scene.system.model.frame(point);
      const State   state = scene.system.reference();
      const Matrix3 D     = frame.triad(state.q.data());
      const Vector6 local = frame.twist(y.data());
      Vector6       result;
      result << D * local.head<3>(), D * local.tail<3>();
      return result;
    }

  private:
    Scene               scene;
    std::vector<double> y;
  };

  /** A clamped polyline with different stiffnesses in all directions and a force at the end of the body @p loaded. */
  std::string
  frame_of(const std::string &points, const std::string &force, const std::string &centres = "")
  {
    return "subsection Sections\n subsection s\n set Type = engineering constants\n set EA = 50\n set GA2 = 20\n"
           " set GA3 = 30\n set GJ = 2\n set EI2 = 3\n set EI3 = 5\n set Mass = 1\n" +
           centres +
           "\n end\nend\nsubsection Bodies\n subsection beam\n set Type = beam\n set Section = s\n set Points = " +
           points +
           "\n set Axis 2 = 0, 1, 0\n set Elements = 5\n end\n#bodies\nend\nsubsection Joints\n subsection clamp\n" +
           " set Type = rigid\n set Body A = ground\n set Body B = beam.start\n end\n#joints\nend\n" +
           "subsection Loads\n subsection p\n set Type = point load\n set At = beam.end\n set Force = " + force +
           "\n end\nend\n";
  }
} // namespace



// w(x) = q x² (6 L² − 4 L x + x²)/(24 EI) + q (L x − x²/2)/GA, θ(L) = q L³/(6 EI)
TEST(LinearTheory, UniformLoad)
{
  const double L = 10, EI = 1e4, GA = 1e4, q = 1e-3;
  for (const unsigned int p : {2, 3, 4, 5, 6})
    {
      auto overrides = mesh("beam", p, 3);
      overrides.push_back("Bodies/beam/Frames = A at 0.25, B at 0.5");
      const Linear linear("prm/benchmarks/uniform_load.prm", overrides);
      for (const auto &[point, x] : {std::make_pair("beam.A", 0.25 * L), {"beam.B", 0.5 * L}, {"beam.end", L}})
        {
          const double w = q * x * x * (6 * L * L - 4 * L * x + x * x) / (24 * EI) + q * (L * x - x * x / 2) / GA;
          EXPECT_NEAR(-linear.at(point)(2) / w, 1., 1e-11) << point << ", degree " << p;
        }
      EXPECT_NEAR(linear.at("beam.end")(4) / (q * L * L * L / (6 * EI)), 1., 1e-11) << "degree " << p;
    }
}



// q cos(k s), k = π/(2 L), exact for p ≥ 3: tip q/(k EI) (L³/3 − 1/k³) + q/(k GA) (L − 1/k).
TEST(LinearTheory, LineLoadConvergesWithOrderTwiceTheDegree)
{
  const double       L = 10, k = M_PI / (2 * L);
  const double       exact    = 1e-7 / k * (L * L * L / 3 - 1 / (k * k * k) + L - 1 / k);
  const unsigned int coarse[] = {0, 8, 2, 2, 1};
  for (unsigned int p = 1; p <= 4; ++p)
    {
      double error[2];
      for (const unsigned int i : {0, 1})
        {
          auto overrides = mesh("beam", p, coarse[p] << i);
          overrides.push_back("Loads/weight/Variation = cos(pi*s/20)");
          error[i] = std::abs(-Linear("prm/benchmarks/uniform_load.prm", overrides).at("beam.end")(2) / exact - 1);
        }
      if (p > 2)
        EXPECT_LT(std::max(error[0], error[1]), 1e-11) << "degree " << p;
      else
        EXPECT_NEAR(std::log2(error[0] / error[1]), 2. * p, 0.3) << "degree " << p;
    }
}



// q on a < s < b alone: tip q/(6 EI) [L s³ − s⁴/4] + q/(2 GA) [s²], θ = q (b³ − a³)/(6 EI); a and b anywhere. Exact for
// p ≥ 3, or for p = 2 where elements end at the jumps; otherwise of order 2p, from the element with the jump.
TEST(LinearTheory, LineLoadThatJumps)
{
  const double L = 10, EI = 1e4, GA = 1e4, q = 1e-3, a = 3.1, b = 7.4;
  const auto   at        = [&](const double s) { return L * s * s * s - s * s * s * s / 4; };
  const double tip       = q / (6 * EI) * (at(b) - at(a)) + q / (2 * GA) * (b * b - a * a);
  const double rotation  = q / (6 * EI) * (b * b * b - a * a * a);
  const auto   with_load = [](std::vector<std::string> overrides) {
    overrides.push_back("Loads/weight/Variation = s >= 3.1 && s <= 7.4 ? 1 : 0");
    return overrides;
  };
  const auto error_of_tip = [&](const std::vector<std::string> &overrides) {
    return std::abs(-Linear("prm/benchmarks/uniform_load.prm", with_load(overrides)).at("beam.end")(2) / tip - 1);
  };
  for (const unsigned int p : {2, 3, 4})
    for (const unsigned int n : {1, 2, 3, 5})
      {
        const Linear linear("prm/benchmarks/uniform_load.prm", with_load(mesh("beam", p, n)));
        EXPECT_NEAR(linear.at("beam.end")(4) / rotation, 1., 1e-11) << "degree " << p << ", " << n << " elements";
        if (p > 2)
          {
            EXPECT_NEAR(-linear.at("beam.end")(2) / tip, 1., 1e-11) << "degree " << p << ", " << n << " elements";
          }
      }
  EXPECT_LT(error_of_tip({"Bodies/beam/Mesh = 2 to 0.31, 2 to 0.74, 2 to 1"}), 1e-11);
  for (const unsigned int p : {1, 2})
    {
      // the jump stays where it is in its element
      const double errors[] = {error_of_tip(mesh("beam", p, 10)), error_of_tip(mesh("beam", p, 70))};
      EXPECT_NEAR(std::log(errors[0] / errors[1]) / std::log(7.), 2. * p, 0.8) << "degree " << p;
    }
}



// Triangular load q (1 − s/L): q L⁴/(30 EI) + q L²/(6 GA). Moment per length m about −y: m L³/(3 EI), θ = m L²/(2 EI).
TEST(LinearTheory, VaryingLoadAndDistributedMoment)
{
  for (const unsigned int p : {3, 4})
    {
      auto overrides = mesh("beam", p, 3);
      overrides.push_back("Loads/weight/Variation = 1 - s/10");
      EXPECT_NEAR(-Linear("prm/benchmarks/uniform_load.prm", overrides).at("beam.end")(2) /
                    (1e-3 * (1e4 / 30e4 + 1e2 / 6e4)),
                  1.,
                  1e-11)
        << "degree " << p;
      overrides = mesh("beam", p, 3);
      overrides.push_back("Loads/weight/Force = 0, 0, 0");
      overrides.push_back("Loads/weight/Moment = 0, -1e-3, 0");
      const Vector6 u = Linear("prm/benchmarks/uniform_load.prm", overrides).at("beam.end");
      EXPECT_NEAR(u(2) / (1e-3 * 1e3 / 3e4), 1., 1e-11) << "degree " << p;
      EXPECT_NEAR(-u(4) / (1e-3 * 1e2 / 2e4), 1., 1e-11) << "degree " << p;
    }
}



// Two legs in the x–y plane, a = 3 along x, b = 2 along y. Out of the plane a³/(3 EI₂) + b³/(3 EI₂) + b² a/GJ +
// (a + b)/GA₃; along the first leg b³/(3 EI₃) + a b²/EI₃ + a/EA + b/GA₂.
TEST(LinearTheory, FrameWithACorner)
{
  const std::string points = "0, 0, 0; 3, 0, 0; 3, 2, 0";
  for (const unsigned int p : {2, 3, 4})
    {
      const std::vector<std::string> degree = {"Bodies/beam/Degree = " + std::to_string(p)};
      EXPECT_NEAR(Linear(frame_of(points, "0, 0, 1"), degree).at("beam.end")(2),
                  27 / 9. + 8 / 9. + 12 / 2. + 5 / 30.,
                  1e-10);
      EXPECT_NEAR(Linear(frame_of(points, "1, 0, 0"), degree).at("beam.end")(0),
                  8 / 15. + 12 / 5. + 3 / 50. + 2 / 20.,
                  1e-10);
    }
}



// A third leg, c = 1.5 along z, loaded along y; its axes are those of the second turned about x, so that d₃ is along
// −y: c³/(3 EI₂) + c² b/EI₂ + c² a/GJ + a³/(3 EI₃) + a/GA₂ + c/GA₃ + b/EA.
TEST(LinearTheory, FrameInSpace)
{
  const double a = 3, b = 2, c = 1.5;
  EXPECT_NEAR(Linear(frame_of("0, 0, 0; 3, 0, 0; 3, 2, 0; 3, 2, 1.5", "0, 1, 0")).at("beam.end")(1),
              c * c * c / 9 + c * c * b / 3 + c * c * a / 2 + a * a * a / 15 + a / 20 + c / 30 + b / 50,
              1e-11);
}



// A force at the shear centre (0.1, −0.2) does not twist, wherever the tension centre is; P L³/(3 EI₂) + P L/GA₃.
TEST(LinearTheory, ForceAtTheShearCentreDoesNotTwist)
{
  std::string text =
    frame_of("0, 0, 0; 4, 0, 0", "0, 0, 1", "set Shear centre = 0.1, -0.2\n set Tension centre = -0.3, 0.4");
  const auto replace = [&](const std::string &a, const std::string &b) { text.replace(text.find(a), a.size(), b); };
  replace("#bodies",
          " subsection plate\n set Type = rigid body\n set Mass = 1\n set Inertia = 1, 1, 1\n set Position = 4, 0, 0\n"
          " set Frames = shear at 4 0.1 -0.2\n end");
  replace("#joints", " subsection w\n set Type = rigid\n set Body A = beam.end\n set Body B = plate.centre\n end");
  replace("At = beam.end", "At = plate.shear");
  const Vector6 u = Linear(text).at("beam.end");
  EXPECT_NEAR(u(3), 0., 1e-12);
  EXPECT_NEAR(u(2), 64 / 9. + 4 / 30., 1e-11);
  EXPECT_NEAR(u(4), -16 / 6., 1e-11);
}



// Extension/force = S (R² cos²a/GJ + R² sin²a/EI + sin²a/EA + cos²a/GA), exact for any pitch; expected order 2p.
TEST(LinearTheory, HelicalSpring)
{
  const double R = 0.05, H = 0.1, n = 3, S = std::hypot(2 * M_PI * n * R, H), s2 = std::pow(H / S, 2), c2 = 1 - s2,
               exact          = 1e-4 * S * (R * R * (c2 / 0.8 + s2) + s2 / 6e5 + c2 / 2e5);
  const unsigned int coarse[] = {0, 96, 24, 16, 8}; // finer ones meet round-off at 1e-9
  for (unsigned int p = 1; p <= 4; ++p)
    {
      double error[2];
      for (const unsigned int k : {0, 1})
        error[k] = std::abs(
          Linear("prm/benchmarks/helical_spring.prm", mesh("spring", p, coarse[p] << k)).at("arm.centre")(2) / exact -
          1);
      EXPECT_NEAR(std::log2(error[0] / error[1]), 2. * p, 0.3) << "degree " << p;
    }
}
