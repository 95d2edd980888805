// What a multiplier costs, in this family and in the schemes for comparison: the flap-lag blade in forward flight of
// prm/examples/floquet, whose multipliers are known to nine digits (tests/reference/README.md). A table for
// contrib/figures floquet.
//
// All schemes find the orbit and the map over a turn in the same way, by central differences of turns, as schemes have
// to of which only steps are known; the family does it by the exact tangents of its steps, too. All begin from the
// same orbit, and correct it until it closes. Seconds are those of the processor.

#include <samara/analysis/floquet.h>
#include <samara/base/dense.h>
#include <samara/input/catalogue.h>
#include <samara/time/projection.h>

#include "../scene.h"
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <complex>
#include <cstdio>

#include "cpu_seconds.h"

using namespace samara;

namespace
{
  const std::string          model = "prm/examples/floquet/flap_lag_forward_flight.prm";
  const std::complex<double> reference(-0.80629270692, 0.58838274462);

  constexpr double       newton_tolerance = 1e-12, closed = 1e-8;
  constexpr unsigned int most_corrections = 4;



  struct Scheme
  {
    std::string  name;
    double       spectral_radius;
    unsigned int n_stages;
    double       tolerance; ///< of steps of chosen size; 0: steps are fixed
    double       distance;  ///< of the differences
  };



  /** A scheme's map over a turn, by its steps alone. */
  class Turns
  {
  public:
    Turns(const System &system, const Scheme &scheme, const unsigned int n_steps, const double period)
      : system(system)
      , scheme(scheme)
      , n_steps(n_steps)
      , period(period)
      , projection(system)
    {}

    State
    march(const State &start)
    {
      const auto integrator = Catalogue().integrators->make(
        scheme.name, system, {scheme.spectral_radius, newton_tolerance, 50, scheme.tolerance, scheme.n_stages});
      State state = start;
      for (unsigned int i = 0; i < n_steps; ++i)
        if (!integrator->step(state, period / n_steps).converged)
          throw NotConverged("a step has no solution");
      projection.velocities(state);
      n_iterations += integrator->n_iterations;
      ++n_turns;
      return state;
    }

    /** The map in terms of the columns of @p basis, by differences. */
    Eigen::MatrixXd
    map(const State &start, const Eigen::MatrixXd &basis, const std::vector<double> &scales)
    {
      Eigen::MatrixXd result(basis.cols(), basis.cols());
      for (int j = 0; j < basis.cols(); ++j)
        {
          std::vector<double> x(basis.rows());
          for (unsigned int i = 0; i < x.size(); ++i)
            x[i] = basis(i, j) * scales[i];
          const State there = march(displaced(start, x, scheme.distance)),
                      back  = march(displaced(start, x, -scheme.distance));
          result.col(j)     = coordinates(back, there, basis, scales) / (2 * scheme.distance);
        }
      return result;
    }

    /** What leads from one state to another. */
    Eigen::VectorXd
    coordinates(const State               &from,
                const State               &to,
                const Eigen::MatrixXd     &basis,
                const std::vector<double> &scales) const
    {
      const std::vector<double> x = increment(system, from, to, true);
      Eigen::VectorXd           scaled(x.size());
      for (unsigned int i = 0; i < x.size(); ++i)
        scaled(i) = x[i] / scales[i];
      return basis.transpose() * scaled;
    }

    State
    displaced(const State &state, const std::vector<double> &x, const double factor)
    {
      State result = moved(system, state, x.data(), factor);
      projection.velocities(result);
      return result;
    }

    unsigned int n_turns = 0, n_iterations = 0;

  private:
    const System      &system;
    const Scheme       scheme;
    const unsigned int n_steps;
    const double       period;
    Projection         projection;
  };



  double
  error_of(const Eigen::MatrixXd &map)
  {
    double error = 1;
    for (const std::complex<double> &value : general_eigenvalues(map))
      error = std::min(error, std::abs(value - reference));
    return error;
  }



  void
  row(const Scheme      &scheme,
      const std::string &tangents,
      const unsigned int n_steps,
      const double       error,
      const double       gap,
      const unsigned int n_turns,
      const unsigned int n_iterations,
      const double       seconds)
  {
    std::printf("%s,%u,%g,%s,%u,%g,%.3e,%.1e,%u,%u,%.4f\n",
                scheme.name.c_str(),
                scheme.n_stages,
                scheme.spectral_radius,
                tangents.c_str(),
                n_steps,
                scheme.tolerance,
                error,
                gap,
                n_turns,
                n_iterations,
                seconds);
    std::fflush(stdout);
  }



  /** By differences of turns. */
  void
  by_differences(const Scheme &scheme, const unsigned int n_steps)
  {
    Scene scene(model);
    scene.equilibrium();
    auto &analysis = scene.analysis<FloquetAnalysis>();
    analysis.run(scene.context);
    const double period = 2 * M_PI;
    SectionMap   section(scene.system, {period, 36}, RepeatedParts(scene.system));
    section.settle(analysis.orbit, 1, 1);
    const Eigen::MatrixXd basis  = section.basis();
    const auto           &scales = section.scales();

    State           start = analysis.orbit;
    const double    begin = cpu_seconds();
    Turns           turns(scene.system, scheme, n_steps, period);
    Eigen::MatrixXd map;
    double          gap = 1;
    for (unsigned int i = 0; i <= most_corrections; ++i)
      {
        const Eigen::VectorXd lacking = turns.coordinates(start, turns.march(start), basis, scales);
        gap                           = lacking.norm();
        if (i > 0 && gap < closed)
          break;
        map = turns.map(start, basis, scales);
        const Eigen::VectorXd x =
          basis * solution(Eigen::MatrixXd::Identity(map.rows(), map.cols()) - map, lacking);
        std::vector<double> scaled(x.data(), x.data() + x.size());
        for (unsigned int k = 0; k < scaled.size(); ++k)
          scaled[k] *= scales[k];
        start = turns.displaced(start, scaled, 1);
      }
    map = turns.map(start, basis, scales);
    row(scheme, "differences", n_steps, error_of(map), gap, turns.n_turns, turns.n_iterations, cpu_seconds() - begin);
  }



  /** By the exact tangents of the steps: Floquet analysis as it is. */
  void
  by_tangents(const Scheme &scheme, const unsigned int n_steps)
  {
    Scene scene(model);
    scene.equilibrium();
    auto &analysis = scene.analysis<FloquetAnalysis>();
    analysis.run(scene.context);
    const double begin = cpu_seconds();
    SectionMap   section(scene.system,
                       {2 * M_PI, n_steps, scheme.n_stages, scheme.spectral_radius, newton_tolerance},
                       RepeatedParts(scene.system));
    section.settle(analysis.orbit, 1, closed);
    section.correct(most_corrections, closed);
    const FloquetModes modes = all_floquet_modes(section);
    double             error = 1;
    for (const auto &mode : modes.found)
      error = std::min(error, std::abs(mode.multiplier - reference));
    row(scheme, "exact", n_steps, error, section.gap.size, 0, section.map.n_iterations, cpu_seconds() - begin);
  }


  void
  by_both(const Scheme &scheme, const unsigned int n_steps, const bool has_tangents)
  {
    try
      {
        if (has_tangents)
          by_tangents(scheme, n_steps);
        by_differences(scheme, n_steps);
      }
    catch (const std::exception &problem)
      {
        std::fprintf(
          stderr, "%s, %u steps, tolerance %g: %s\n", scheme.name.c_str(), n_steps, scheme.tolerance, problem.what());
      }
  }
} // namespace



int
main()
{
  std::printf("scheme,stages,spectral radius,tangent,steps,tolerance,error,gap,turns,iterations,seconds\n");
  for (const double rho : {1., 0.5})
    for (const unsigned int s : {1, 2, 3})
      for (const unsigned int n : {12, 24, 48, 96, 192, 384})
        if (n <= (s == 1 ? 384u : s == 2 ? 192u : 96u))
          by_both({"family", rho, s, 0, 3e-5}, n, true);
  for (const auto &[name, rho] : {std::pair<std::string, double>{"generalised alpha", 1},
                                  {"generalised alpha", 0.5},
                                  {"trapezoidal", 1},
                                  {"energy decaying", 0}})
    for (const unsigned int n : {24, 48, 96, 192, 384, 768})
      by_both({name, rho, 1, 0, 3e-5}, n, false);
  // steps of its own: differences have to be larger than their noise
  for (const double tolerance : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9})
    by_both({"BDF index 2", 0.5, 1, tolerance, 1e-3}, 1, false);
}
