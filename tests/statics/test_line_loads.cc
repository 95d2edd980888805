// Loads per length that jump, have corners or narrow peaks, wherever elements end.
//
// References: resultants by quadrature of their own; large displacements under a load that follows the section by the
// exact equations of the rod, integrated here from the free end, where force and moment are zero:
//
//     x' = R (e₁ + Γ),  R' = R K~,  n' = −p R f,  m' = −x' × n,  (Γ, K) = C⁻¹ (Rᵀn, Rᵀm)

#include <samara/base/composite_rule.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <random>

using namespace samara;

namespace
{
  /** A cantilever of length 2 along x with a load along it, in elements that end at 0.3 L and 0.8 L too or not. */
  std::string
  cantilever(const std::string &load, const std::string &mesh)
  {
    return "subsection Sections\n subsection s\n set Type = engineering constants\n set EA = 50\n set GA2 = 20\n"
           " set GA3 = 30\n set GJ = 2\n set EI2 = 3\n set EI3 = 5\n set Mass = 1\n end\nend\n"
           "subsection Bodies\n subsection beam\n set Type = beam\n set Section = s\n set Points = 0, 0, 0; 2, 0, 0\n"
           " set Axis 2 = 0, 1, 0\n " +
           mesh +
           "\n end\nend\nsubsection Joints\n subsection clamp\n set Type = rigid\n set Body A = ground\n"
           " set Body B = beam.start\n set Reaction = true\n end\nend\n"
           "subsection Loads\n subsection q\n set Type = line load\n set Body = beam\n " +
           load + "\n end\nend\n";
  }

  const std::string part = "set Variation = s < 0.6 ? 0 : s < 1.6 ? 1 : 0\n";
} // namespace



// ∫ p d f ds and ∫ x × p d f + p d m ds with x = Σ N x_a, d = Σ N D_a (d = 1 for dead loads), in a state of its own.
TEST(LineLoads, ResultantsAreThoseOfTheInterpolatedLine)
{
  const std::string variation = "s < 0.37 ? 2 : s < 1.1 ? -1 + s^2 : abs(s - 1.7)";
  const auto        p         = [](const double s) { return s < 0.37 ? 2 : s < 1.1 ? -1 + s * s : std::abs(s - 1.7); };
  const Vector3     f(1, -2, 3), m(0.5, 1, -0.7);
  for (const std::string axes : {"inertial", "body"})
    for (const std::string degree : {"1", "2", "3", "4"})
      {
        const Scene  scene(cantilever("set Force = 1, -2, 3\n set Moment = 0.5, 1, -0.7\n set Axes = " + axes +
                                       "\n set Variation = " + variation,
                                     "set Elements = 2\n set Degree = " + degree));
        State        state = scene.system.reference();
        std::mt19937 random(3);
        std::uniform_real_distribution<double> uniform(-1, 1);
        for (unsigned int node = 1; node < scene.system.layout.n_nodes; ++node)
          {
            const Vector3 turn(uniform(random), uniform(random), uniform(random));
            for (unsigned int i = 0; i < 3; ++i)
              state.q[12 * node + i] += 0.2 * uniform(random);
            Eigen::Map<Matrix3>(&state.q[12 * node + 3]) = rotation_of_vector(turn);
          }
        // what the residual of the load does at the nodes
        std::vector<double> r(scene.system.size() + 6, 0.);
        for (unsigned int i = 0; i < scene.system.n_loads(); ++i)
          if (scene.system.item_of_load(i).name == "q")
            scene.system.add_load(i, state.point(), r.data());
        Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
        for (unsigned int node = 1; node < scene.system.layout.n_nodes; ++node)
          {
            const double *const at  = &r[scene.system.layout.of_node(node)];
            const Vector3       f_a = -state.triad(node) * Eigen::Map<const Vector3>(at);
            force += f_a;
            moment += state.position(node).cross(f_a) - state.triad(node) * Eigen::Map<const Vector3>(at + 3);
          }
        Vector3 force_expected = Vector3::Zero(), moment_expected = Vector3::Zero();
        for (const auto &span : dynamic_cast<const Body &>(*scene.system.model.items[1]).spans())
          for (const auto &[s, ds] : composite_rule({0, 0.37, 1, 1.1, 1.7, 2}, 12))
            if (s > span.start && s < span.end)
              {
                Vector3 x = Vector3::Zero();
                Matrix3 d = Matrix3::Zero();
                for (unsigned int a = 0; a < span.frames.size(); ++a)
                  {
                    const Frame  frame = scene.system.model.resolved(span.frames[a]);
                    const double N     = lagrange(span.abscissae, a, s);
                    x += N * frame.position(state.q.data());
                    d += N * frame.triad(state.q.data());
                  }
                if (axes == "inertial")
                  d.setIdentity();
                force_expected += p(s) * ds * d * f;
                moment_expected += p(s) * ds * (x.cross(d * f) + d * m);
              }
        EXPECT_LT((force - force_expected).norm(), 1e-12) << axes << ", degree " << degree;
        EXPECT_LT((moment - moment_expected).norm(), 1e-12) << axes << ", degree " << degree;
      }
}



// ∫ exp(−((s − 1.1)/0.005)²) ds = 0.005 √π, in a single element that is 400 times as long; ∫ √s ds = 2^(5/2)/3.
TEST(LineLoads, PeaksAndRootsAreIntegrated)
{
  for (const auto &[variation, exact] :
       {std::make_pair("exp(-((s - 1.1)/0.005)^2)", 0.005 * std::sqrt(M_PI)), {"sqrt(s)", 4 * std::sqrt(2.) / 3}})
    {
      Scene scene(cantilever("set Force = 1e-3, 0, 0\n set Variation = " + std::string(variation), "set Elements = 1"));
      scene.equilibrium();
      EXPECT_NEAR(std::abs(scene.value("clamp.force 1")) / 1e-3 / exact, 1, 1e-9) << variation;
    }
}



TEST(LineLoads, FollowerWithAJumpConvergesWithOrderTwiceTheDegree)
{
  const Vector3 f(0, 0, 1.5);
  Matrix6       compliance = Matrix6::Zero();
  compliance.diagonal() << 1 / 50., 1 / 20., 1 / 30., 1 / 2., 1 / 3., 1 / 5.;
  using Values          = Eigen::Matrix<double, 3, 6>; // x, R, n, m
  const auto derivative = [&](const double p, const Values &y) {
    const Matrix3 R = y.middleCols<3>(1);
    Vector6       stress;
    stress << R.transpose() * y.col(4), R.transpose() * y.col(5);
    const Vector6 e = compliance * stress;
    Values        d;
    d.col(0)           = R * (Vector3::UnitX() + e.head<3>());
    d.middleCols<3>(1) = R * skew(e.tail<3>().eval());
    d.col(4)           = -p * (R * f);
    d.col(5)           = -d.col(0).cross(y.col(4));
    return d;
  };
  Values y = Values::Zero();
  y.middleCols<3>(1).setIdentity();
  for (const auto &[from, to, p] : {std::array<double, 3>{2, 1.6, 0}, {1.6, 0.6, 1}, {0.6, 0, 0}})
    for (unsigned int i = 0; i < 2000; ++i)
      {
        const double h  = (to - from) / 2000;
        const Values k1 = derivative(p, y), k2 = derivative(p, y + h / 2 * k1), k3 = derivative(p, y + h / 2 * k2),
                     k4 = derivative(p, y + h * k3);
        y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      }
  const Matrix3 clamp = y.middleCols<3>(1);
  const Vector3 exact = -clamp.transpose() * y.col(0); // of the end, seen from the clamp

  for (const unsigned int p : {1, 2, 3})
    {
      double error[2];
      for (const unsigned int i : {0, 1})
        {
          // elements end at the jumps
          std::string        mesh = "set Mesh = ";
          const unsigned int n    = (p == 1 ? 8u : p == 2 ? 2u : 1u) << i;
          double             from = 0;
          for (const double to : {0.3, 0.8, 1.})
            {
              for (unsigned int k = 1; k <= n; ++k)
                mesh +=
                  (from + k == 1 ? "" : ", ") + std::to_string(p) + " to " + std::to_string(from + (to - from) * k / n);
              from = to;
            }
          Scene scene(cantilever("set Force = 0, 0, 1.5\n set Axes = body\n " + part, mesh));
          scene.equilibrium();
          error[i] = (Vector3(scene.value("beam.end.position x"),
                              scene.value("beam.end.position y"),
                              scene.value("beam.end.position z")) -
                      exact)
                       .norm();
        }
      EXPECT_NEAR(std::log2(error[0] / error[1]), 2. * p, 0.4) << "degree " << p << ", error " << error[1];
    }
}
