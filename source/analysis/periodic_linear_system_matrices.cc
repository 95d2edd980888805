// Matrices of state spaces about periodic motions, from the exact tangents of the steps.

#include <samara/analysis/periodic_linear_system.h>
#include <samara/analysis/periodic_motion.h>
#include <samara/base/dense.h>
#include <samara/base/errors.h>
#include <samara/base/interrupt.h>
#include <samara/base/text.h>
#include <samara/time/projection.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Images that leave the space of the next sample by more are those of inputs that prescribe motions. */
    constexpr double allowed_rest = 1e-6;

    /** A sample of which logarithms are taken holds less than this of half a cycle, and leaves more than that. @{ */
    constexpr double largest_angle = 0.95, smallest_rest = 1e-10;
    /** @} */
  } // namespace



  std::vector<std::complex<double>>
  PeriodicLinearSystem::multipliers() const
  {
    Eigen::MatrixXd product = A.front();
    for (unsigned int k = 1; k < A.size(); ++k)
      product = A[k] * product;
    const Eigen::VectorXcd            values = general_eigenvalues(product);
    std::vector<std::complex<double>> result(values.data(), values.data() + values.size());
    std::stable_sort(result.begin(), result.end(), [](const auto &a, const auto &b) {
      return std::abs(a) > std::abs(b);
    });
    return result;
  }



  double
  PeriodicLinearSystem::variation() const
  {
    Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(A[0].rows(), A[0].cols());
    for (const auto &a : A)
      mean += a / A.size();
    double most = 0;
    for (const auto &a : A)
      most = std::max(most, (a - mean).norm());
    return most / (mean - Eigen::MatrixXd::Identity(mean.rows(), mean.cols())).norm();
  }



  void
  PeriodicLinearSystemAnalysis::find_bases(SectionMap                   &whole,
                                           const std::vector<State>     &states,
                                           const Multiblade             &multiblade,
                                           std::vector<Eigen::MatrixXd> &bases,
                                           std::vector<Eigen::MatrixXd> &transformations) const
  {
    for (unsigned int k = 0; k < n_samples; ++k)
      {
        const Eigen::MatrixXd own = whole.basis_at(states[k]);
        if (own.cols() == 0)
          throw NotConverged("periodic linear system: nothing can move that is not prescribed");
        if (own.cols() > int(most_states))
          throw NotConverged("periodic linear system: there are " + std::to_string(own.cols()) + " states, more than " +
                             std::to_string(most_states) + " (<Most states>)");
        transformations.push_back(multiblade.at(states[k], 2 * M_PI * states[k].time / period));
        const Eigen::MatrixXd allowed = transformations[k] * own;
        if (k == 0)
          {
            bases.push_back(allowed);
            continue;
          }
        if (allowed.cols() != bases[0].cols())
          throw NotConverged(
            "periodic linear system: the constraints leave different numbers of motions along the way");
        // of all orthonormal bases of this space the one nearest to the first: it comes back with the motion
        const SingularValues svd = singular_values(allowed.transpose() * bases[0]);
        bases.push_back(allowed * (svd.U * svd.V.transpose()));
      }
    // back to increments as they are marched
    for (unsigned int k = 0; k < n_samples; ++k)
      bases[k] = transformations[k].transpose() * bases[k];
  }



  void
  PeriodicLinearSystemAnalysis::find_dynamics(const System                       &system,
                                              const std::vector<double>          &scale,
                                              PeriodMap                          &sample,
                                              const std::vector<State>           &states,
                                              const std::vector<Eigen::MatrixXd> &bases,
                                              const std::vector<unsigned int>    &numbers)
  {
    const Eigen::Map<const Eigen::VectorXd> s(scale.data(), scale.size());
    const unsigned int                      n = bases[0].cols();
    for (unsigned int k = 0; k < n_samples; ++k)
      {
        throw_if_interrupted();
        sample.linearize(states[k]);
        const Eigen::MatrixXd &next = bases[(k + 1) % n_samples];
        Eigen::MatrixXd        A(n, n), B(n, numbers.size());
        const auto             image = [&](Eigen::VectorXd x) {
          sample.apply(x.data());
          return Eigen::VectorXd(x.cwiseQuotient(s));
        };
        for (unsigned int j = 0; j < n; ++j)
          A.col(j) = next.transpose() * image(s.cwiseProduct(bases[k].col(j)));
        for (unsigned int j = 0; j < numbers.size(); ++j)
          {
            const unsigned int entry = system.layout.of_state(numbers[j]);
            Eigen::VectorXd    y     = image(Eigen::VectorXd::Unit(s.size(), entry));
            const double       size  = y.norm();
            y(entry)                 = 0;
            B.col(j)                 = next.transpose() * y;
            if ((y - next * B.col(j)).norm() > allowed_rest * size)
              throw InputError(
                parameters.where("Inputs") + ": <" + system.model.states[numbers[j]].name +
                "> prescribes a motion, whose acceleration would be an input, too.\n  Let it be the rest "
                "angle of a spring and a damper, or of a state that follows it: an actuator has both");
          }
        space.A.push_back(A);
        space.B.push_back(B);
      }
  }



  void
  PeriodicLinearSystemAnalysis::find_outputs(const Context                      &context,
                                             const std::vector<double>          &scale,
                                             const std::vector<State>           &states,
                                             const std::vector<Eigen::MatrixXd> &bases,
                                             const std::vector<unsigned int>    &numbers)
  {
    const System              &system = context.system;
    std::vector<PeriodAverage> probes;
    for (const auto &probe : context.probes)
      {
        probes.push_back({PeriodAverage::mean, 0, probe});
        space.outputs.push_back(probe.name);
        space.output_units.push_back(probe.unit);
      }
    for (const unsigned int i : numbers)
      {
        space.inputs.push_back(system.model.states[i].name);
        space.input_units.push_back(system.model.states[i].unit);
        space.input_values.push_back(states[0].states[i]);
      }
    // the fourth is for BDF alone
    const IntegratorSettings settings{spectral_radius, newton_tolerance, max_iterations, 1e-4, n_stages};
    const PeriodicMotion     motion(context, period, n_samples, settings, probes);
    Projection               projection(system);
    const unsigned int       m = probes.size(), n = bases[0].cols();
    space.output_values.resize(n_samples, m);
    const auto change = [&](const State &state, const Eigen::VectorXd &x) {
      const auto y = motion.change_of_values(state, x.data(), projection);
      return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(y.data(), y.size()));
    };
    const Eigen::Map<const Eigen::VectorXd> s(scale.data(), scale.size());
    for (unsigned int k = 0; k < n_samples; ++k)
      {
        const auto y               = motion.values(states[k], projection);
        space.output_values.row(k) = Eigen::Map<const Eigen::RowVectorXd>(y.data(), m);
        Eigen::MatrixXd C(m, n), D(m, numbers.size());
        for (unsigned int j = 0; j < n; ++j)
          C.col(j) = change(states[k], s.cwiseProduct(bases[k].col(j)));
        for (unsigned int j = 0; j < numbers.size(); ++j)
          D.col(j) = change(states[k], Eigen::VectorXd::Unit(s.size(), system.layout.of_state(numbers[j])));
        space.C.push_back(C);
        space.D.push_back(D);
      }
  }



  void
  PeriodicLinearSystemAnalysis::find_averages()
  {
    const unsigned int n = space.A[0].rows(), m = space.B[0].cols();
    LinearSystem      &mean = space.averaged;
    Eigen::MatrixXd    sum  = Eigen::MatrixXd::Zero(n + m, n + m);
    for (unsigned int k = 0; k < n_samples; ++k)
      {
        // inputs that keep still are states: the logarithm of both together
        Eigen::MatrixXd both          = Eigen::MatrixXd::Identity(n + m, n + m);
        both.topLeftCorner(n, n)      = space.A[k];
        both.topRightCorner(n, m)     = space.B[k];
        const Eigen::VectorXcd values = general_eigenvalues(space.A[k]);
        for (const std::complex<double> value : values)
          if (std::abs(value) < smallest_rest || std::abs(std::arg(value)) > largest_angle * M_PI)
            return;
        sum += logarithm(both) * (n_samples / period) / n_samples;
      }
    mean.inputs       = space.inputs;
    mean.outputs      = space.outputs;
    mean.input_units  = space.input_units;
    mean.output_units = space.output_units;
    mean.A            = sum.topLeftCorner(n, n);
    mean.B            = sum.topRightCorner(n, m);
    mean.C            = Eigen::MatrixXd::Zero(space.C[0].rows(), n);
    mean.D            = Eigen::MatrixXd::Zero(space.C[0].rows(), m);
    for (unsigned int k = 0; k < n_samples; ++k)
      {
        mean.C += space.C[k] / n_samples;
        mean.D += space.D[k] / n_samples;
      }
  }
} // namespace samara
