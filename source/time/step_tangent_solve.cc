// The equations of the stages, solved for what a change at the start of a step changes at its end.

#include <samara/base/errors.h>
#include <samara/time/algebraic_states.h>
#include <samara/time/step_tangent.h>

#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace samara
{
  namespace
  {
    /** Relative residual of the equations of stages that is needed: this, or ten times what is wanted. */
    constexpr double       needed_residual = 1e-10;
    constexpr unsigned int most_products   = 60;

    /**
     * Of velocities times the step, over changes of states in their scales, and the other way round: less is what
     * round-off leaves of a kind that does not feel the other. By its own size it would be all that counts.
     */
    constexpr double least_size = 1e-12;

    /** The same of multipliers over the largest of the others, in whatever units. */
    constexpr double least_multipliers = 1e-20;



    /** Sizes of velocities, states and multipliers in @p X, the unknowns of all stages of a step @p h. */
    void
    keep_apart_from_round_off(const System              &system,
                              const double               h,
                              const std::vector<double> &X,
                              std::array<double, 3>     &sizes)
    {
      const unsigned int n = system.size(), n_states = system.layout.n_states;
      double             of_states = 0, smallest_scale = std::numeric_limits<double>::infinity();
      for (unsigned int i = 0; i < n_states; ++i)
        {
          const double scale = system.model.states[i].scale;
          smallest_scale     = std::min(smallest_scale, scale);
          for (unsigned int k = system.layout.of_state(i); k < X.size(); k += n)
            of_states = std::max(of_states, std::abs(X[k]) / scale);
        }
      const double of_velocities = sizes[0] * h;
      if (n_states > 0)
        {
          sizes[0] = std::max(sizes[0], least_size * of_states / h);
          sizes[1] = std::max(sizes[1], least_size * of_velocities * smallest_scale);
        }
      if (sizes[2] < least_multipliers * std::max(sizes[0], sizes[1]))
        sizes[2] = 0;
    }
  } // namespace



  Eigen::MatrixXd
  StepTangent::change_products()
  {
    const auto     &products = integrator.products;
    Eigen::MatrixXd factors(products.size(), stages.size());
    for (unsigned int k = 0; k < stages.size(); ++k)
      for (unsigned int i = 0; i < products.size(); ++i)
        {
          const auto &p = products[i];
          factors(i, k) = change.start_strain[p.factor];
          for (unsigned int l = 0; l < stages.size(); ++l)
            factors(i, k) += h * tableau.a(k, l) * change.strain_rates[l][p.factor];
          change.strain_rates[k][p.result] = factors(i, k) * stages[k].strain_rates[p.factor] +
                                             stages[k].factors[i] * change.strain_rates[k][p.factor] +
                                             change.strain_rates[k][p.rest];
        }
    return factors;
  }



  void
  StepTangent::solve(const Vector &right, Vector &X)
  {
    struct Matrix
    {
      StepTangent   &tangent;
      mutable Vector x, r;

      /** Scaled unknowns on both sides, J preconditioned from the left. */
      void
      vmult(dealii::Vector<double> &to, const dealii::Vector<double> &from) const
      {
        for (unsigned int i = 0; i < x.size(); ++i)
          x[i] = from[i] * tangent.scale[i];
        ++tangent.n_products;
        tangent.residual(nullptr, x.data(), r);
        tangent.integrator.solve_stages(r, x);
        for (unsigned int i = 0; i < x.size(); ++i)
          to[i] = x[i] / tangent.scale[i];
      }
    };
    X.resize(right.size());
    integrator.solve_stages(right, X);
    // every kind of unknown counts by its own size
    const unsigned int n = system.size();
    scale.assign(X.size(), 1.);
    std::array<double, 3> sizes{};
    const auto            kind = [&](const unsigned int i) { return i < n_velocities ? 0 : i < n_positions ? 1 : 2; };
    const auto            unit = [&](const unsigned int i) {
      return i < n_velocities && system.layout.is_length(i) ? integrator.length : 1.;
    };
    for (unsigned int i = 0; i < X.size(); ++i)
      sizes[kind(i % n)] = std::max(sizes[kind(i % n)], std::abs(X[i]) / unit(i % n));
    keep_apart_from_round_off(system, h, X, sizes);
    for (unsigned int i = 0; i < X.size(); ++i)
      scale[i] = unit(i % n) * (sizes[kind(i % n)] > 0 ? sizes[kind(i % n)] : 1.);

    dealii::Vector<double> b(X.size()), solution(X.size());
    for (unsigned int i = 0; i < X.size(); ++i)
      b[i] = X[i] / scale[i];
    using Settings    = dealii::SolverGMRES<dealii::Vector<double>>::AdditionalData;
    const double size = b.l2_norm();
    if (size > 0)
      {
        dealii::SolverControl                       control(most_products, tolerance * size, false, false);
        dealii::SolverGMRES<dealii::Vector<double>> gmres(control, Settings(most_products + 2));
        Matrix                                      matrix{*this, X, {}};
        try
          {
            gmres.solve(matrix, solution, b, dealii::PreconditionIdentity());
          }
        catch (const dealii::SolverControl::NoConvergence &)
          {
            // round-off may be more than what is wanted
          }
        if (!(control.last_value() < std::max(needed_residual, 10 * tolerance) * size))
          throw NotConverged("the tangent of a step is not found: the equations of its stages are solved to " +
                             std::to_string(control.last_value() / size) + " only");
      }
    for (unsigned int i = 0; i < X.size(); ++i)
      X[i] = solution[i] * scale[i];
  }



  void
  StepTangent::apply(double *x)
  {
    const Layout      &layout = system.layout;
    const unsigned int s = tableau.s, n = system.size();
    Vector             right, X(s * n, 0.);
    residual(x, X.data(), right);
    for (double &r : right)
      r = -r;
    solve(right, X);

    // moves everything to where the solution leads, and looks at the constraints along it
    residual(x, X.data(), right, true);
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      {
        const Eigen::Map<const Matrix3> D(&end_q[12 * node + 3]), dD(&change.end_q[12 * node + 3]);
        Eigen::Map<Vector6>(x + layout.of_node(node))
          << D.transpose() * Eigen::Map<const Vector3>(&change.end_q[12 * node]),
          axial(D.transpose() * dD);
      }
    std::copy(change.end_coordinates.begin(), change.end_coordinates.end(), x + layout.of_coordinate(0));
    std::copy(change.end_states.begin(), change.end_states.end(), x + layout.of_state(0));
    for (const unsigned int i : algebraic_states(system.model))
      {
        const Eigen::VectorXd weights = values_at_end(tableau);
        x[layout.of_state(i)]         = 0;
        for (unsigned int k = 0; k < s; ++k)
          x[layout.of_state(i)] += weights(k) * X[k * n + layout.of_state(i)];
      }
    double *const velocities = x + n_positions;
    for (unsigned int i = 0; i < n_velocities; ++i)
      {
        const double from = velocities[i];
        for (unsigned int k = 0; k < s; ++k)
          velocities[i] += integrator.final_weights(k) * (X[k * n + i] - from);
      }
  }
} // namespace samara
