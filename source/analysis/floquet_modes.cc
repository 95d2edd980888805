#include <samara/analysis/floquet_modes.h>
#include <samara/base/dense.h>
#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/solvers/eigen_system.h>
#include <samara/solvers/krylov_schur.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace samara
{
  namespace
  {
    using Complex = std::complex<double>;

    /** Images of the basis that leave the space it spans by more are none of the map over a period. */
    constexpr double allowed_remainder = 1e-6;

    /** From one; what is nearer may be one, along which there are orbits everywhere. */
    constexpr double least_distance_from_one = 1e-6;

    /** Multipliers smaller than this, over the size of the map, are round-off of it. */
    constexpr double round_off_of_multipliers = 1e-12;



    /** What exp(λt) has in place of the exponent λ when it is computed by steps of h. */
    Complex
    error_of_scheme(const Tableau &tableau, const Complex lambda, const double h)
    {
      const Complex    z = lambda * h;
      Eigen::MatrixXcd A(tableau.s, tableau.s);
      Eigen::VectorXcd b(tableau.s);
      for (unsigned int k = 0; k < tableau.s; ++k)
        {
          b(k) = tableau.b(k);
          for (unsigned int l = 0; l < tableau.s; ++l)
            A(k, l) = (k == l ? 1. : 0.) - z * tableau.a_alpha(k, l);
        }
      const Complex R = 1. + z * (b.transpose() * solution(A, Eigen::VectorXcd::Ones(tableau.s)))(0, 0);
      // arg R lies within a turn of ωh
      const double beyond = std::remainder(std::arg(R) - z.imag(), 2 * M_PI);
      return Complex(std::log(std::abs(R)) - z.real(), beyond) / h;
    }



    void
    apply_scaled(SectionMap &map, const double *x, double *y)
    {
      const auto         &scale = map.scales();
      std::vector<double> z(scale.size());
      for (unsigned int i = 0; i < z.size(); ++i)
        z[i] = x[i] * scale[i];
      map.apply(z.data());
      for (unsigned int i = 0; i < z.size(); ++i)
        y[i] = z[i] / scale[i];
    }



    /** Only one of each pair. */
    bool
    is_wanted(const Complex value)
    {
      return value.imag() >= 0;
    }



    /** ζᴴ M ζ of a node's increments, or of what begins at @p first. */
    double
    energy_of(const System &system, const Eigen::VectorXcd &shape, const unsigned int node, const int first = 0)
    {
      const Eigen::Matrix<Complex, 6, 1> z = shape.segment<6>(first + system.layout.of_node(node));
      return (z.adjoint() * system.model.nodes[node].inertia * z)(0, 0).real();
    }



    /** |c|² of a shape, for finding which part is largest: in kinetic energy, or of states where nothing has any. */
    double
    size_of(const SectionMap &map, const Eigen::VectorXcd &shape, const bool by_energy)
    {
      double sum = 0;
      if (by_energy)
        for (unsigned int node = 1; node < map.system.layout.n_nodes; ++node)
          sum += energy_of(map.system, shape, node);
      else
        for (unsigned int i = 0; i < map.map.first_velocity(); ++i)
          sum += std::norm(shape(i) / map.scales()[i]);
      return sum;
    }



    std::vector<std::pair<std::string, double>>
    sorted_shares(const std::map<std::string, double> &energies)
    {
      double total = 0;
      for (const auto &[name, energy] : energies)
        total += energy;
      std::vector<std::pair<std::string, double>> shares;
      for (const auto &[name, energy] : energies)
        shares.emplace_back(name, total > 0 ? energy / total : 0.);
      std::stable_sort(shares.begin(), shares.end(), [](const auto &a, const auto &b) { return a.second > b.second; });
      return shares;
    }



    /** A mode at all steps of the period without its principal exponent: p(t) times a harmonic of the period. */
    std::vector<Eigen::VectorXcd>
    periodic_part(SectionMap &map, const FloquetMode &mode, const Complex principal)
    {
      const double                  h = map.map.settings.period / map.map.settings.n_steps;
      std::vector<Eigen::VectorXcd> result(map.map.settings.n_steps * map.repeated().n());
      map.follow(mode.shape, mode.of_section, [&](const unsigned int i, const Eigen::VectorXcd &increment) {
        result[i] = increment * std::exp(-principal * (i * h));
      });
      return result;
    }



    /** Shares of bodies in the kinetic energy, and the rate of the mode. */
    void
    find_shares(const SectionMap &map, const std::vector<Eigen::VectorXcd> &periodic, FloquetMode &mode)
    {
      std::map<std::string, double> energies;
      double                        displacements = 0, velocities = 0;
      for (const auto &increment : periodic)
        for (unsigned int node = 1; node < map.system.layout.n_nodes; ++node)
          {
            const double energy = energy_of(map.system, increment, node);
            energies[map.system.model.nodes[node].name] += energy;
            displacements += energy;
            velocities += energy_of(map.system, increment, node, map.map.first_velocity());
          }
      mode.rate   = displacements > 0 ? std::sqrt(velocities / displacements) : 0.;
      mode.shares = sorted_shares(energies);
    }



    /** The harmonic of the period that is largest in a mode: λ of the section's principal value plus i m 2π/T. */
    int
    largest_harmonic(const SectionMap                    &map,
                     const std::vector<Eigen::VectorXcd> &periodic,
                     const FloquetMode                   &mode,
                     const Complex                        principal)
    {
      const unsigned int n         = periodic.size();
      const double       h         = map.map.settings.period / map.map.settings.n_steps;
      const bool         by_energy = !mode.shares.empty() && mode.shares[0].second > 0;
      const int          most      = (int(n) - 1) / 2;
      int                result    = 0;
      double             largest   = -1;
      for (int m = -most; m <= most; ++m)
        {
          Eigen::VectorXcd part = Eigen::VectorXcd::Zero(mode.shape.size());
          for (unsigned int i = 0; i < n; ++i)
            part += std::polar(1. / n, -2 * M_PI * m * double(i) / n) * periodic[i];
          // of equal ones, as in pairs, that of the lower frequency
          const double size =
            size_of(map, part, by_energy) * (1 - 1e-9 * std::abs(principal.imag() * h * n / (2 * M_PI) + m) / n);
          if (size > largest)
            {
              largest = size;
              result  = m;
            }
        }
      return result;
    }
  } // namespace



  FloquetMode
  mode_of(const SectionMap &map, const Complex value, const Eigen::VectorXcd &scaled_shape, const double residual)
  {
    FloquetMode mode;
    mode.of_section = value;
    mode.multiplier = std::pow(value, int(map.repeated().n()));
    mode.shape      = scaled_shape.normalized();
    for (int i = 0; i < mode.shape.size(); ++i)
      mode.shape(i) *= map.scales()[i];
    mode.residual = std::abs(value) > 0 ? residual / std::abs(value) : residual;
    return mode;
  }



  void
  put_in_order(FloquetModes &modes, const double size)
  {
    auto &found = modes.found;
    std::stable_sort(found.begin(), found.end(), [](const FloquetMode &a, const FloquetMode &b) {
      // equal to round-off: pairs, and modes of equal parts, stay in the order in which they were found
      return std::abs(a.of_section) > std::abs(b.of_section) * (1 + 1e-12);
    });
    while (!found.empty() && std::abs(found.back().of_section) <= round_off_of_multipliers * size)
      {
        found.pop_back();
        ++modes.n_vanishing;
      }
  }



  void
  estimate_errors(const SectionMap      &map,
                  const Eigen::MatrixXd &projected,
                  const double           tolerance_of_steps,
                  FloquetModes          &modes)
  {
    Eigen::VectorXcd values(modes.found.size());
    double           change = 0, nearest = 1;
    for (unsigned int i = 0; i < modes.found.size(); ++i)
      {
        values(i) = modes.found[i].of_section;
        change    = std::max(change, modes.found[i].residual * std::abs(values(i)));
        nearest   = std::min(nearest, std::abs(1. - values(i)));
      }
    // a gap g leaves the orbit away by (1 − Φ)⁻¹ g, and the map is as much another one
    const double away    = map.gap.size / std::max(nearest, least_distance_from_one),
                 size    = projected.cwiseAbs().maxCoeff();
    change               = std::max(change, (away + map.map.settings.newton_tolerance + tolerance_of_steps) * size);
    const auto distances = changes_of_values(projected, values, change);
    for (unsigned int i = 0; i < modes.found.size(); ++i)
      modes.found[i].error = map.repeated().n() * distances(i) / std::abs(values(i));
  }



  FloquetModes
  all_floquet_modes(SectionMap &map)
  {
    const Eigen::MatrixXd B = map.basis();
    Eigen::MatrixXd       images(B.rows(), B.cols());
    map.begin("all columns of the map", B.cols());
    for (int j = 0; j < B.cols(); ++j)
      apply_scaled(map, B.col(j).data(), images.col(j).data());
    const Eigen::MatrixXd A         = B.transpose() * images;
    const double          remainder = (images - B * A).norm() / std::max(images.norm(), 1e-300);
    if (!(remainder < allowed_remainder))
      throw NotConverged("floquet analysis: changes that constraints allow become such that they do not, by " +
                         number_to_text("%.1e", remainder) +
                         " of their size.\n  Take more <Steps>, or let the motion settle better");
    const EigenSystem spectrum = eigen_system_of(A);
    FloquetModes      result;
    result.n_columns = B.cols();
    result.is_all    = true;
    for (int i = 0; i < A.cols(); ++i)
      if (const Complex value = spectrum.values(i); is_wanted(value))
        {
          // with what leaves the space of the basis, which (A y − σ y) would not show
          const Eigen::VectorXcd y = spectrum.vectors.col(i).normalized(), shape = B * y;
          result.found.push_back(mode_of(map, value, shape, (images * y - value * shape).norm()));
        }
    put_in_order(result, A.norm());
    estimate_errors(map, A, map.map.settings.tangent_tolerance, result);
    return result;
  }



  FloquetModes
  largest_floquet_modes(SectionMap        &map,
                        const unsigned int wanted,
                        const double       tolerance,
                        const double       tolerance_of_steps)
  {
    map.map.set_tolerance(tolerance_of_steps);
    const unsigned int n = map.map.size();
    ArnoldiSettings    settings;
    settings.tolerance     = tolerance;
    settings.most_products = 1000;
    EigenPairs pairs;
    map.begin("the largest " + std::to_string(std::min(wanted, n)) + " multipliers", settings.most_products);
    try
      {
        pairs = arnoldi(
          n, [&](const double *x, double *y) { apply_scaled(map, x, y); }, std::min(wanted, n), settings);
      }
    catch (const NotConverged &problem)
      {
        // with spectral radius 1 all that is stiff has a multiplier near one
        throw NotConverged(
          std::string(problem.what()) +
          ": the largest multipliers lie in a crowd, as those of what bends fast and is hardly damped. "
          "Ask for slow modes, <Highest frequency>, or damp what the steps do not resolve, "
          "<Spectral radius> below 1");
      }
    FloquetModes result;
    result.n_columns = pairs.n_products;
    for (unsigned int i = 0; i < pairs.values.size(); ++i)
      if (is_wanted(pairs.values[i]))
        result.found.push_back(mode_of(map, pairs.values[i], pairs.vectors.col(i), pairs.residuals[i]));
    put_in_order(result, std::abs(pairs.values[0]));
    estimate_errors(map, pairs.projected, tolerance_of_steps, result);
    return result;
  }



  void
  describe(SectionMap &map, const RepeatedParts &parts, FloquetModes &modes, const unsigned int n)
  {
    const double section = map.map.settings.period, T = section * map.repeated().n(),
                 h = section / map.map.settings.n_steps;
    const Tableau        tableau(map.map.settings.n_stages, map.map.settings.spectral_radius);
    const ContentOfModes contents(map.system, parts, map.map.states());
    modes.found.resize(std::min<std::size_t>(n, modes.found.size()));
    for (auto &mode : modes.found)
      {
        const Complex principal = std::log(mode.of_section) / section;
        const auto    periodic  = periodic_part(map, mode, principal);
        find_shares(map, periodic, mode);
        const double frequency = principal.imag() + largest_harmonic(map, periodic, mode, principal) * 2 * M_PI / T;
        mode.exponent          = {principal.real(), std::abs(frequency)};
        mode.content           = contents.of(periodic, frequency);
        // velocities at the ends of steps are less exact than frequencies; they are needed only where these are aliases
        mode.rate         = mode.rate * h < M_PI ? mode.frequency() : std::max(mode.rate, mode.frequency());
        mode.scheme_error = error_of_scheme(tableau, {mode.growth(), mode.rate}, h);
      }
  }
} // namespace samara
