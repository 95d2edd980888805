#ifndef samara_tests_complex_step_h
#define samara_tests_complex_step_h

#include <samara/model/system.h>

#include <algorithm>
#include <random>

namespace samara
{
  /**
   * Derivatives of a model against complex steps, in a random state: Strains are quadratic and the constitutive law is
   * linear, so they agree to round-off in every state, be it an equilibrium or not.
   */
  class ComplexStep
  {
  public:
    /** Triads are not @p orthonormal unless wanted: tangents must not rely on that. Stops act if @p with_stops. */
    explicit ComplexStep(const System &system, const bool orthonormal = false, const bool with_stops = false)
      : system(system)
      , n(system.size())
      , state(system.reference())
    {
      std::mt19937                           random(7);
      std::uniform_real_distribution<double> number(-0.3, 0.3);
      std::vector<double>                    z(n);
      std::generate(z.begin(), z.end(), [&]() { return number(random); });
      system.update(state, z);
      for (unsigned int i = 12; i < state.q.size() && !orthonormal; ++i)
        state.q[i] += 0.2 * number(random);
      for (auto &lambda : state.multipliers)
        lambda = 5 * number(random);
      state.stops  = with_stops;
      state.time   = 0.4;
      state.factor = 0.8;
      system.stresses(state, state.stress);
    }

    /**
     * The tangent, δσ = C B ζ, against the derivative of the residual with σ = C e(q); relative to the largest entry.
     * Rows of nonholonomic constraints, whose residual is zero, against the rates b·y of unit velocities.
     */
    double
    error_of_tangent() const
    {
      return error(false);
    }

    /** The damping matrix against the derivative with respect to velocities. */
    double
    error_of_damping() const
    {
      return error(true);
    }

    /** The rates B y of the strains against the derivative of the strains, with some velocities. */
    double
    error_of_strain_rates() const
    {
      Eigen::VectorXd z(n);
      for (unsigned int i = 0; i < n; ++i)
        z(i) = std::sin(i + 1.);
      Motion moved(*this, z, false), moving(*this, z, true);
      double largest = 0;
      for (unsigned int i = 0; i < system.layout.n_strains; ++i)
        largest = std::max(largest, std::abs(moved.e[i].imag() - moving.e_rates[i].imag()) / step);
      return largest;
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
      const Layout         &layout    = system.layout;
      const Eigen::MatrixXd dense     = A.dense();
      const unsigned int    n_columns = velocities ? layout.of_multiplier(0) : n;
      double                largest   = 0;
      for (unsigned int j = 0; j < n_columns; ++j)
        {
          auto r = Motion(*this, Eigen::VectorXd::Unit(n, j), velocities).residual;
          if (!velocities)
            for (const auto i : layout.nonholonomic)
              {
                largest = std::max(largest, std::abs(r[layout.of_multiplier(i)]) / step);
                r[layout.of_multiplier(i)] = Complex(0, step * constraint_rates(j)[i]);
              }
          for (unsigned int i = 0; i < n; ++i)
            largest = std::max(largest, std::abs(r[i].imag() / step - dense(i, j)));
        }
      return largest / std::max(1., dense.cwiseAbs().maxCoeff());
    }

    /** The rates of all constraints for a unit velocity of unknown @p j, without ∂g/∂t; zero for multipliers. */
    std::vector<double>
    constraint_rates(const unsigned int j) const
    {
      const Layout       &layout = system.layout;
      std::vector<double> y(6 + n, 0.), rates(layout.n_multipliers), time_rates(layout.n_multipliers);
      y[6 + j]            = j < static_cast<unsigned int>(layout.of_multiplier(0)) ? 1. : 0.;
      Point<double> point = state.point();
      point.y             = y.data();
      point.rates         = y.data() + 6 + layout.of_coordinate(0);
      for (const auto *c : layout.constraining)
        {
          c->constraint_rates(point, rates.data());
          c->constraint_time_rates(point, time_rates.data());
        }
      for (unsigned int i = 0; i < rates.size(); ++i)
        rates[i] -= time_rates[i];
      return rates;
    }

    /** What follows from moving the configuration by i·step along z, or from velocities i·step z. */
    struct Motion
    {
      Motion(const ComplexStep &here, const Eigen::VectorXd &z, const bool velocities)
      {
        const System &system = here.system;
        const State  &state  = here.state;
        const Layout &layout = system.layout;
        q.assign(state.q.begin(), state.q.end());
        coordinates.assign(state.coordinates.begin(), state.coordinates.end());
        multipliers.assign(state.multipliers.begin(), state.multipliers.end());
        y.resize(6 * layout.n_nodes);
        rates.resize(layout.n_coordinates);
        for (auto *const values : {&e, &e_rates, &stress})
          values->resize(layout.n_strains);
        residual.resize(system.size() + 6);
        if (!velocities)
          move(here, z);

        std::vector<double> twists(6 * layout.n_nodes, 0.), real_rates(layout.n_strains);
        std::copy_n(z.data(), 6 * (layout.n_nodes - 1), twists.begin() + 6);
        Point<double> moving = state.point();
        moving.y             = twists.data();
        moving.rates         = z.data() + layout.of_coordinate(0);

        const Point<Complex> moved{q.data(),
                                   coordinates.data(),
                                   y.data(),
                                   rates.data(),
                                   multipliers.data(),
                                   stress.data(),
                                   state.time,
                                   state.factor,
                                   state.held,
                                   state.stops};
        for (const auto &c : system.model.contributions)
          {
            const unsigned int first = c->first_strain;
            c->strains(moved, e.data() + first);
            c->strain_rates(moving, real_rates.data() + first);
            for (unsigned int i = first; velocities && i < first + c->n_strains(); ++i)
              e_rates[i] = Complex(0, step * real_rates[i]);
            c->stresses(e.data() + first, e_rates.data() + first, stress.data() + first);
            c->residual(moved, residual.data());
          }
      }

      void
      move(const ComplexStep &here, const Eigen::VectorXd &z)
      {
        const Layout &layout = here.system.layout;
        for (unsigned int node = 1; node < layout.n_nodes; ++node)
          {
            const Vector6 zn = z.segment<6>(layout.of_node(node));
            const Matrix3 D  = here.state.triad(node);
            Eigen::Map<Vec3<Complex>>(&q[12 * node]) += Complex(0, step) * (D * zn.head<3>());
            Eigen::Map<Mat3<Complex>>(&q[12 * node + 3]) += Complex(0, step) * (D * skew(zn.tail<3>()));
          }
        for (unsigned int i = 0; i < layout.n_coordinates; ++i)
          coordinates[i] += Complex(0, step * z(layout.of_coordinate(i)));
        for (unsigned int i = 0; i < layout.n_multipliers; ++i)
          multipliers[i] += Complex(0, step * z(layout.of_multiplier(i)));
      }

      std::vector<Complex> q, coordinates, multipliers, y, rates, e, e_rates, stress, residual;
    };
  };
} // namespace samara

#endif
