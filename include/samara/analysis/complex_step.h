#ifndef samara_analysis_complex_step_h
#define samara_analysis_complex_step_h

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
    /**
     * Triads are not @p orthonormal unless wanted: tangents must not rely on that. Stops act if @p with_stops. Nodes
     * and coordinates move if @p moves: what depends on velocities is looked at where they are not zero.
     */
    explicit ComplexStep(const System &system,
                         const bool    orthonormal = false,
                         const bool    with_stops  = false,
                         const bool    moves       = false)
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
      for (auto &z : state.states)
        z = number(random);
      for (unsigned int i = 6; i < state.y.size() && moves; ++i)
        state.y[i] = number(random);
      for (unsigned int i = 0; i < state.rates.size() && moves; ++i)
        state.rates[i] = number(random);
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

    /** Row and column of the largest error that was found last. */
    mutable unsigned int worst_row = 0, worst_column = 0;

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
      velocities ? system.add_damping(state.point(), A) : system.add_tangent(state.point(), A);
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
                largest                    = std::max(largest, std::abs(r[layout.of_multiplier(i)]) / step);
                r[layout.of_multiplier(i)] = Complex(0, step * constraint_rates(j)[i]);
              }
          for (unsigned int i = 0; i < n; ++i)
            if (const double error = std::abs(r[i].imag() / step - dense(i, j)); !(error <= largest))
              {
                largest      = error;
                worst_row    = i;
                worst_column = j;
              }
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
      system.constraint_rates(point, rates.data());
      system.constraint_time_rates(point, time_rates.data());
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
        states.assign(state.states.begin(), state.states.end());
        y.assign(state.y.begin(), state.y.end());
        rates.assign(state.rates.begin(), state.rates.end());
        for (auto *const values : {&e, &e_rates, &stress})
          values->resize(layout.n_strains);
        residual.resize(system.size() + 6);
        if (!velocities)
          move(here, z);
        else
          {
            for (unsigned int i = 6; i < y.size(); ++i)
              y[i] += Complex(0, step * z(i - 6));
            for (unsigned int i = 0; i < rates.size(); ++i)
              rates[i] += Complex(0, step * z(layout.of_coordinate(i)));
          }

        std::vector<double> twists(6 * layout.n_nodes, 0.), real_rates(layout.n_strains);
        std::copy_n(z.data(), 6 * (layout.n_nodes - 1), twists.begin() + 6);
        Point<double> moving = state.point();
        moving.y             = twists.data();
        moving.rates         = z.data() + layout.of_coordinate(0);

        const Point<Complex> moved{q.data(),
                                   coordinates.data(),
                                   y.data(),
                                   rates.data(),
                                   states.data(),
                                   nullptr,
                                   multipliers.data(),
                                   stress.data(),
                                   state.time,
                                   state.factor,
                                   state.held,
                                   state.stops};
        system.strains(moved, e.data());
        system.strain_rates(moving, real_rates.data());
        for (unsigned int i = 0; velocities && i < layout.n_strains; ++i)
          e_rates[i] = Complex(0, step * real_rates[i]);
        system.stresses(e.data(), e_rates.data(), stress.data());
        system.add_terms(moved, residual.data());
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
            // δy = ζ̇ + ad_y ζ, in axes that turn with the node
            const Eigen::Map<const Vector6> y_n(&here.state.y[6 * node]);
            Eigen::Map<Vec6<Complex>>(&y[6 * node]) += Complex(0, step) * (ad(y_n) * zn);
          }
        for (unsigned int i = 0; i < layout.n_coordinates; ++i)
          coordinates[i] += Complex(0, step * z(layout.of_coordinate(i)));
        for (unsigned int i = 0; i < layout.n_states; ++i)
          states[i] += Complex(0, step * z(layout.of_state(i)));
        for (unsigned int i = 0; i < layout.n_multipliers; ++i)
          multipliers[i] += Complex(0, step * z(layout.of_multiplier(i)));
      }

      std::vector<Complex> q, coordinates, states, multipliers, y, rates, e, e_rates, stress, residual;
    };
  };
} // namespace samara

#endif
