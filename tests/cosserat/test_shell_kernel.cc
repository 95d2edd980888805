// The kernel is written once for dimension 1 and 2. Shells are not offered to users yet; here the same code makes a curved
// patch of shell elements, and what must hold for any C is checked: rigid motions are free of strain and of force, and
// they are the only ones (the line-reduced assumed strain has exactly six zero modes, plain reduced integration more).

#include <samara/cosserat/cosserat.h>

#include <samara/base/dense.h>

#include <gtest/gtest.h>

using namespace samara;

namespace
{
  /** A square of a cylindrical surface of radius 2, one element, with a stiffness that couples everything. */
  class Patch : public Cosserat<2>
  {
  public:
    explicit Patch(const unsigned int degree)
    {
      table = std::make_shared<ElementTable<2>>(degree);
    }

    void
    initialize(Model &model) override
    {
      MatrixN A = MatrixN::NullaryExpr([](const auto i, const auto j) { return std::sin(1. + 3 * i + 5 * j); });
      materials.push_back({MatrixN(A * A.transpose() + MatrixN::Identity()), MatrixN::Zero()});
      std::vector<Frame> frames;
      for (const auto &xi : table->nodes)
        {
          const double angle = 0.4 * xi[0];
          Matrix3      D;
          D.col(0) = Vector3(std::cos(angle), 0, -std::sin(angle));
          D.col(1) = Vector3::UnitY();
          D.col(2) = Vector3(std::sin(angle), 0, std::cos(angle));
          frames.push_back(
            model.add_node(name, Vector3(2 * std::sin(angle), 0.9 * xi[1] + 0.1 * xi[0], 2 * std::cos(angle)), D));
        }
      add_element(model, frames, std::vector<unsigned int>(table->n_points, 0));
    }

    Frame
    frame(const std::string &) const override
    {
      return elements[0].frames[0];
    }
    std::vector<std::string>
    points() const override
    {
      return {};
    }
  };

  struct PatchModel
  {
    Model                   model;
    std::unique_ptr<System> system;

    explicit PatchModel(const unsigned int degree)
    {
      model.items.push_back(std::make_unique<Patch>(degree));
      model.items[0]->initialize(model);
      system = std::make_unique<System>(model);
    }
  };

  /** Turned by two radians about a skew axis, and displaced. */
  State
  moved_rigidly(const System &system)
  {
    State         state = system.reference();
    const Matrix3 R     = rotation_of_vector({1.2, -1.1, 1.2});
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        Eigen::Map<Vector3> x(&state.q[12 * node]);
        Eigen::Map<Matrix3> D(&state.q[12 * node + 3]);
        x = (R * x + Vector3(3, -2, 5)).eval();
        D = (R * D).eval();
      }
    return state;
  }
} // namespace



TEST(ShellKernel, RigidMotionsAreFreeOfStrainAndForce)
{
  for (const unsigned int p : {1, 2, 3, 4})
    {
      PatchModel          patch(p);
      State               state = moved_rigidly(*patch.system);
      std::vector<double> e, r;
      patch.system->strains(state, e);
      for (const double strain : e)
        EXPECT_NEAR(strain, 0., 1e-12);
      patch.system->stresses(state, state.stress);
      patch.system->residual(state, state.stress, r);
      for (const double force : r)
        EXPECT_NEAR(force, 0., 1e-10);
    }
}



TEST(ShellKernel, HasExactlySixZeroModes)
{
  for (const unsigned int p : {1, 2, 3})
    {
      PatchModel   patch(p);
      SparseMatrix K(patch.system->layout.pattern);
      State        state = moved_rigidly(*patch.system);
      patch.system->tangent(state, K);
      const Eigen::MatrixXd dense = K.dense();
      EXPECT_LT((dense - dense.transpose()).norm(), 1e-12 * dense.norm());
      const Eigen::VectorXd values = symmetric_eigenvalues(dense);
      EXPECT_LT(values.head<6>().cwiseAbs().maxCoeff(), 1e-12 * values.maxCoeff()) << "p = " << p;
      EXPECT_GT(values(6), 1e-9 * values.maxCoeff()) << "p = " << p;
    }
}



TEST(ShellKernel, TangentIsTheDerivativeOfTheResidual)
{
  PatchModel    patch(2);
  const System &system = *patch.system;
  State         state  = system.reference();
  std::vector<double> z(system.size()), r0, r1, stress;
  for (unsigned int i = 0; i < z.size(); ++i)
    z[i] = 0.1 * std::sin(1.3 * i + 0.2);
  system.update(state, z);
  system.stresses(state, state.stress);
  SparseMatrix K(system.layout.pattern);
  system.tangent(state, K);

  // central differences of fourth order; the complex step of the whole catalogue is in tests/model
  for (unsigned int i = 0; i < z.size(); ++i)
    z[i] = std::cos(0.7 * i);
  std::vector<double>   Kz(system.size());
  Eigen::VectorXd       derivative = Eigen::VectorXd::Zero(system.size());
  K.multiply(z.data(), Kz.data());
  const double h = 1e-3;
  for (const auto &[steps, weight] : std::vector<std::pair<double, double>>{{-2, 1}, {-1, -8}, {1, 8}, {2, -1}})
    {
      State               moved = state;
      std::vector<double> dz(z);
      for (auto &value : dz)
        value *= steps * h;
      system.update(moved, dz);
      system.stresses(moved, stress);
      system.residual(moved, stress, r1);
      for (unsigned int i = 0; i < system.size(); ++i)
        derivative(i) += weight * r1[i] / (12 * h);
    }
  for (unsigned int i = 0; i < system.size(); ++i)
    EXPECT_NEAR(derivative(i), Kz[i], 1e-7 * Eigen::Map<Eigen::VectorXd>(Kz.data(), Kz.size()).cwiseAbs().maxCoeff());
}
