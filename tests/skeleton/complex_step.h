#ifndef samara_tests_skeleton_complex_step_h
#define samara_tests_skeleton_complex_step_h

#include <samara/model/system.h>

#include <algorithm>
#include <random>

namespace samara
{
  /**
   * The tangent of a model against a complex step through its residual, and its damping matrix against one through the
   * velocities, relative to the largest entry. Strains are quadratic and the constitutive law is linear, so both agree
   * to round-off in every state, be it an equilibrium or not.
   */
  class ComplexStep
  {
  public:
    /** A random state of the model, with triads that are not orthonormal: tangents must not rely on that. */
    explicit ComplexStep(const System &system)
      : system(system)
      , n(system.size())
      , state(system.reference())
    {
      std::mt19937                           random(7);
      std::uniform_real_distribution<double> number(-0.3, 0.3);
      std::vector<double>                    z(n);
      std::generate(z.begin(), z.end(), [&]() { return number(random); });
      system.update(state, z);
      for (unsigned int i = 12; i < state.q.size(); ++i)
        state.q[i] += 0.2 * number(random);
      state.time   = 0.4;
      state.factor = 0.8;
      system.stresses(state, state.stress);
    }

    double
    error_of_tangent() const
    {
      return error(false);
    }

    double
    error_of_damping() const
    {
      return error(true);
    }

  private:
    using Complex                = std::complex<double>;
    static constexpr double step = 1e-30;

    const System      &system;
    const unsigned int n;
    State              state;

    double
    error(const bool velocities) const
    {
      SparseMatrix A(system.layout.pattern);
      for (const auto &c : system.model.contributions)
        velocities ? c->damping(state.point(), A) : c->tangent(state.point(), A);
      const Eigen::MatrixXd dense     = A.dense();
      const unsigned int    n_columns = velocities ? system.layout.of_multiplier(0) : n;
      double                largest   = 0;
      for (unsigned int j = 0; j < n_columns; ++j)
        {
          const auto r = residual(Eigen::VectorXd::Unit(n, j), velocities);
          for (unsigned int i = 0; i < n; ++i)
            largest = std::max(largest, std::abs(r[i].imag() / step - dense(i, j)));
        }
      return largest / std::max(1., dense.cwiseAbs().maxCoeff());
    }

    /** The residual with the stress of the configuration, moved by i·step along z, or with velocities i·step z. */
    std::vector<Complex>
    residual(const Eigen::VectorXd &z, const bool velocities) const
    {
      const Layout        &layout = system.layout;
      std::vector<Complex> q(state.q.begin(), state.q.end()), y(6 * layout.n_nodes),
        coordinates(state.coordinates.begin(), state.coordinates.end()), rates(layout.n_coordinates),
        multipliers(state.multipliers.begin(), state.multipliers.end()), e(layout.n_strains), e_rates(layout.n_strains),
        stress(layout.n_strains), r(n + 6);
      std::vector<double> twists(6 * layout.n_nodes, 0.), real_rates(layout.n_strains);

      std::copy_n(z.data(), 6 * (layout.n_nodes - 1), twists.begin() + 6);
      if (!velocities)
        {
          for (unsigned int node = 1; node < layout.n_nodes; ++node)
            {
              const Vector6 zn = z.segment<6>(layout.of_node(node));
              const Matrix3 D  = state.triad(node);
              Eigen::Map<Vec3<Complex>>(&q[12 * node]) += Complex(0, step) * (D * zn.head<3>());
              Eigen::Map<Mat3<Complex>>(&q[12 * node + 3]) += Complex(0, step) * (D * skew(zn.tail<3>()));
            }
          for (unsigned int i = 0; i < layout.n_coordinates; ++i)
            coordinates[i] += Complex(0, step * z(layout.of_coordinate(i)));
          for (unsigned int i = 0; i < layout.n_multipliers; ++i)
            multipliers[i] += Complex(0, step * z(layout.of_multiplier(i)));
        }

      const Point<Complex> moved{q.data(),
                                 coordinates.data(),
                                 y.data(),
                                 rates.data(),
                                 multipliers.data(),
                                 stress.data(),
                                 state.time,
                                 state.factor,
                                 state.held};
      Point<double>        moving = state.point();
      moving.y                    = twists.data();
      moving.rates                = z.data() + layout.of_coordinate(0);
      for (const auto &c : system.model.contributions)
        {
          const unsigned int first = c->first_strain;
          c->strains(moved, e.data() + first);
          c->strain_rates(moving, real_rates.data() + first);
          for (unsigned int i = first; velocities && i < first + c->n_strains(); ++i)
            e_rates[i] = Complex(0, step * real_rates[i]);
          c->stresses(e.data() + first, e_rates.data() + first, stress.data() + first);
          c->residual(moved, r.data());
        }
      return r;
    }
  };
} // namespace samara

#endif
