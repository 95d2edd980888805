#include <samara/aero/finite_state.h>
#include <samara/base/astray.h>
#include <samara/base/dense.h>

#include <array>
#include <cmath>
#include <complex>

namespace samara
{
  namespace
  {
    /** n!!, with (−1)!! = 0!! = 1 */
    double
    double_factorial(const int n)
    {
      double product = 1;
      for (int i = n; i > 1; i -= 2)
        product *= i;
      return product;
    }

    /** H_n^m of Peters, Boyd & He, J. AHS 34 (1989), whose notation these formulas have. */
    double
    H(const int n, const int m)
    {
      return double_factorial(n + m - 1) * double_factorial(n - m - 1) /
             (double_factorial(n + m) * double_factorial(n - m));
    }

    /** φ_n^m = r^m Σ c_j r^{2j} */
    std::vector<double>
    radial_polynomial(const int n, const int m)
    {
      std::vector<double> c;
      for (int q = m; q <= n - 1; q += 2)
        c.push_back(std::sqrt((2 * n + 1) * H(n, m)) * (((q - m) / 2) % 2 == 0 ? 1 : -1) * double_factorial(n + q) /
                    (double_factorial(q - m) * double_factorial(q + m) * double_factorial(n - q - 1)));
      return c;
    }

    /** What a pressure (m, n) induces of (r, j). */
    double
    gamma(const int r, const int m, const int j, const int n)
    {
      const double scale = std::sqrt(H(n, m) * H(j, r));
      if ((r + m) % 2 == 0)
        return (((n + j - 2 * r) / 2) % 2 == 0 ? 1 : -1) * 2 * std::sqrt((2. * n + 1) * (2 * j + 1)) /
               (scale * (j + n) * (j + n + 2) * ((j - n) * (j - n) - 1));
      if (std::abs(j - n) != 1)
        return 0;
      return M_PI / 2 * (r > m ? 1 : -1) / (scale * std::sqrt((2. * n + 1) * (2 * j + 1)));
    }

    /** ∫₀¹ P̄_n⁰(ν) dν with P̄_n⁰ = ν φ_n⁰, r² = 1 − ν²: the pressure of a uniform load has these parts. */
    double
    mean_of_pressure(const int n)
    {
      // ∫ ν (1 − ν²)^j dν = 1/(2(j + 1))
      const auto c   = radial_polynomial(n, 0);
      double     sum = 0;
      for (unsigned int j = 0; j < c.size(); ++j)
        sum += c[j] / (2. * (j + 1));
      return sum;
    }

    constexpr double pi = M_PI;
  } // namespace



  void
  FiniteStateInflow::add_shape(const unsigned int         m,
                               const std::vector<double> &c,
                               const double               mass,
                               const double               weight)
  {
    disk.shapes.push_back({m, false, c});
    apparent_mass.push_back(mass);
    load_weights.push_back(weight);
  }



  void
  FiniteStateInflow::add_sines()
  {
    const unsigned int n = size();
    sine_of.assign(n, -1);
    for (unsigned int i = 0; i < n; ++i)
      if (disk.shapes[i].m > 0)
        {
          sine_of[i] = size();
          disk.shapes.push_back({disk.shapes[i].m, true, disk.shapes[i].c});
          apparent_mass.push_back(apparent_mass[i]);
          load_weights.push_back(load_weights[i]);
        }
    u.resize(size(), 0.);
    stretch            = find_stretch();
    first_without_skew = inverse(influence(0., 0.)).row(0);
  }



  Eigen::MatrixXd
  FiniteStateInflow::find_stretch() const
  {
    Eigen::MatrixXd C = Eigen::MatrixXd::Zero(size(), size());
    for (unsigned int n = 0; n < size(); ++n)
      {
        const auto         &shape = disk.shapes[n];
        std::vector<double> left; // r φ', powers m, m + 2, ...
        for (unsigned int i = 0; i < shape.c.size(); ++i)
          left.push_back((shape.m + 2 * i) * shape.c[i]);
        for (unsigned int degree = left.size(); degree-- > 0;)
          for (unsigned int j = 0; j < size(); ++j)
            if (const auto &other = disk.shapes[j];
                other.m == shape.m && other.is_sine == shape.is_sine && other.c.size() == degree + 1)
              {
                C(j, n) = left[degree] / other.c[degree];
                for (unsigned int i = 0; i <= degree; ++i)
                  left[i] -= C(j, n) * other.c[i];
              }
      }
    return C;
  }



  FiniteStateInflow
  FiniteStateInflow::uniform()
  {
    FiniteStateInflow inflow;
    inflow.add_shape(0, {1.}, 8 / (3 * pi), 1 / pi);
    inflow.terms = {{0, 0, 0, false, false, 0.5, true}};
    inflow.u     = {1.};
    inflow.k     = 0.5;
    inflow.add_sines();
    return inflow;
  }



  FiniteStateInflow
  FiniteStateInflow::pitt_peters()
  {
    FiniteStateInflow inflow;
    inflow.add_shape(0, {1.}, 8 / (3 * pi), 1 / pi);
    inflow.add_shape(1, {1.}, 16 / (45 * pi), 1 / pi);
    // with 4/(1 + cos χ) = 2(1 + X²) and 4 cos χ/(1 + cos χ) = 2(1 − X²)
    const double b = 15 * pi / 64;
    inflow.terms   = {{0, 0, 0, false, false, 0.5, true},
                      {0, 1, 1, true, false, -b, true},
                      {1, 0, 1, false, false, b, false},
                      {1, 1, 0, false, false, 2., false},
                      {1, 1, 2, false, true, -2., false}};
    inflow.u       = {1., 0.};
    inflow.k       = 0.5;
    inflow.add_sines();
    return inflow;
  }



  FiniteStateInflow
  FiniteStateInflow::peters_he(const unsigned int harmonics, const unsigned int power, const bool first_state_alone)
  {
    if (power < harmonics)
      throw std::invalid_argument("the power is less than the highest harmonic");
    FiniteStateInflow                inflow;
    std::vector<std::pair<int, int>> mn;
    for (int m = 0; m <= static_cast<int>(harmonics); ++m)
      for (int n = m + 1; n <= static_cast<int>(power) + 1; n += 2)
        {
          mn.emplace_back(m, n);
          // t/2 stands on the right: half of (1 or 2)/(2π)
          inflow.add_shape(m, radial_polynomial(n, m), 2 / pi * H(n, m), (m == 0 ? 1 : 2) / (4 * pi));
          inflow.u.push_back(m > 0 ? 0. : first_state_alone ? (n == 1) : mean_of_pressure(n) / mean_of_pressure(1));
        }
    for (unsigned int a = 0; a < mn.size(); ++a)
      for (unsigned int b = 0; b < mn.size(); ++b)
        {
          const int    r = mn[a].first, m = mn[b].first;
          const double g = gamma(r, m, mn[a].second, mn[b].second);
          if (g == 0)
            continue;
          inflow.terms.push_back({a, b, static_cast<unsigned int>(std::abs(r - m)), r < m, false, g, r == 0});
          if (r > 0)
            inflow.terms.push_back(
              {a, b, static_cast<unsigned int>(m + r), false, true, std::min(r, m) % 2 == 0 ? g : -g, false});
        }
    inflow.k = 2 / std::sqrt(3.);
    inflow.add_sines();
    return inflow;
  }



  namespace
  {
    /** X^n, real and imaginary parts. */
    template <typename Number>
    std::pair<Number, Number>
    power_of(const Number &x, const Number &y, const unsigned int n)
    {
      Number re(1), im(0);
      for (unsigned int i = 0; i < n; ++i)
        {
          const Number next = re * x - im * y;
          im                = re * y + im * x;
          re                = next;
        }
      return {re, im};
    }
  } // namespace



  template <typename Number>
  void
  FiniteStateInflow::add_term(const Term &term, const Number &re, const Number &im, Matrix<Number> &A) const
  {
    // (a + ib) t or (a + ib) conj(t) with t = t_c + i t_s
    const Number a = term.factor * re, b = term.factor * im;
    const double sign     = term.of_conjugate ? -1 : 1;
    const int    row_sine = sine_of[term.row], column_sine = sine_of[term.column];
    A(term.row, term.column) += a;
    if (column_sine >= 0)
      A(term.row, column_sine) -= sign * b;
    if (term.real_part || row_sine < 0)
      return;
    A(row_sine, term.column) += b;
    if (column_sine >= 0)
      A(row_sine, column_sine) += sign * a;
  }



  template <typename Number>
  FiniteStateInflow::Matrix<Number>
  FiniteStateInflow::influence(const Number &x, const Number &y) const
  {
    Matrix<Number> L = Matrix<Number>::Zero(size(), size());
    for (const auto &term : terms)
      {
        const auto [re, im] = power_of(x, term.conjugate ? Number(-y) : y, term.power);
        add_term(term, re, im, L);
      }
    return L;
  }



  std::pair<Eigen::MatrixXd, Eigen::MatrixXd>
  FiniteStateInflow::influence_slopes(const double x, const double y) const
  {
    Eigen::MatrixXd by_x = Eigen::MatrixXd::Zero(size(), size()), by_y = by_x;
    for (const auto &term : terms)
      if (term.power > 0)
        {
          const double sign   = term.conjugate ? -1 : 1;
          const auto [re, im] = power_of(x, sign * y, term.power - 1);
          add_term(term, term.power * re, term.power * im, by_x);
          // i times it, or −i
          add_term(term, -sign * term.power * im, sign * term.power * re, by_y);
        }
    return {by_x, by_y};
  }



  namespace
  {
    /** A smooth |λ|. */
    template <typename Number>
    Number
    smooth_size(const Number &lambda, const double least)
    {
      using std::sqrt;
      return sqrt(lambda * lambda + least * least);
    }

    double
    real_of(const double x)
    {
      return x;
    }
    double
    real_of(const std::complex<double> &x)
    {
      return x.real();
    }

    // the least speed in V_T itself, where it must not be seen, in parts of that of |λ|
    constexpr double in_mean_flow = 1e-5;
  } // namespace



  void
  FiniteStateInflow::influence_along_skew(const double           X,
                                          const bool             of_sines,
                                          Eigen::MatrixXd       &L,
                                          Eigen::MatrixXd *const slope) const
  {
    std::array<double, 2 * DiskShapes::most_harmonics + 1> powers;
    powers[0] = 1;
    for (unsigned int i = 1; i < powers.size(); ++i)
      powers[i] = X * powers[i - 1];
    const int n_cosines = sine_of.size(), n = of_sines ? size() - n_cosines : n_cosines;
    L.setZero(n, n);
    if (slope != nullptr)
      slope->setZero(n, n);
    for (const auto &term : terms)
      {
        int    row = term.row, column = term.column;
        double value = term.factor * powers[term.power];
        if (of_sines)
          {
            row    = sine_of[row] - n_cosines;
            column = sine_of[column] - n_cosines;
            if (row < 0 || column < 0)
              continue;
            value = term.of_conjugate ? -value : value;
          }
        L(row, column) += value;
        if (slope != nullptr)
          (*slope)(row, column) += term.power * value;
      }
  }



  Eigen::VectorXd
  FiniteStateInflow::turned(const Eigen::VectorXd &z, const double c, const double s) const
  {
    Eigen::VectorXd result = z;
    for (unsigned int j = 0; j < sine_of.size(); ++j)
      if (const int k = sine_of[j]; k >= 0)
        {
          const auto [re, im] = power_of(c, s, disk.shapes[j].m);
          result(j)           = re * z(j) + im * z(k);
          result(k)           = re * z(k) - im * z(j);
        }
    return result;
  }



  template <typename Number>
  FiniteStateInflow::Flow<Number>
  FiniteStateInflow::at_mean_flow(const Number &nu, const Flight<Number> &flight, const double least) const
  {
    // V_T, the total flow; V_m, which carries harmonics away; X = tan(χ/2) of the skew of the wake
    using std::sqrt;
    Flow<Number> f;
    const Number mu2    = flight.mu_x * flight.mu_x + flight.mu_y * flight.mu_y;
    const double still  = in_mean_flow * least;
    f.nu                = nu;
    f.lambda            = flight.lambda_f + nu;
    f.V_T               = sqrt(mu2 + f.lambda * f.lambda + still * still);
    f.V_m               = (mu2 + f.lambda * (f.lambda + f.nu)) / f.V_T;
    const Number height = f.V_T + smooth_size(f.lambda, least);
    f.X_x               = flight.mu_x / height;
    f.X_y               = flight.mu_y / height;
    return f;
  }



  FiniteStateInflow::MeanFlow
  FiniteStateInflow::mean_flow(const Eigen::VectorXd &z, const Flight<double> &flight, const double least) const
  {
    thread_local Eigen::MatrixXd                      L, slope;
    thread_local Lu                                   lu;
    const double                                      mu        = std::hypot(flight.mu_x, flight.mu_y);
    const int                                         n_cosines = sine_of.size();
    MeanFlow                                          mean;
    if (mu > 0)
      {
        mean.c = flight.mu_x / mu;
        mean.s = flight.mu_y / mu;
      }
    const Eigen::VectorXd along = turned(z, mean.c, mean.s).head(n_cosines);
    // the start is that of a wake without skew
    mean.nu     = k * first_without_skew * z;
    double miss = 1e300;
    for (unsigned int i = 0; miss > 1e-12; ++i)
      {
        const auto   f    = at_mean_flow(mean.nu, flight, least);
        const double size = smooth_size(f.lambda, least), X = mu / (f.V_T + size);
        influence_along_skew(X, false, L, &slope);
        lu.compute(L);
        const Eigen::VectorXd y     = lu.solve(along);
        const double          found = k * y(0), by_lambda = (f.lambda / f.V_T + f.lambda / size) / (f.V_T + size);
        miss = std::abs(mean.nu - found) / (std::abs(mean.nu) + std::abs(found) + mu + in_mean_flow * least);
        if (i == 100 || !std::isfinite(miss))
          throw Astray("there is no mean inflow for these states: the wake goes neither up nor down");
        // dX/dν = −X times by_lambda
        mean.slope = X == 0 ? 1. : 1 - k * by_lambda * lu.solve(slope * y)(0);
        mean.nu -= (mean.nu - found) / mean.slope;
      }
    return mean;
  }



  namespace
  {
    Eigen::VectorXd
    real_parts(const Eigen::VectorXd &z)
    {
      return z;
    }
    Eigen::VectorXd
    real_parts(const Eigen::VectorXcd &z)
    {
      return z.real();
    }
  } // namespace



  Eigen::VectorXd
  FiniteStateInflow::loads_of(const Eigen::VectorXd &z, const Flow<double> &f, const MeanFlow &mean) const
  {
    thread_local Eigen::MatrixXd                      L;
    thread_local Lu                                   lu;
    const double                                      X         = std::hypot(f.X_x, f.X_y);
    const int                                         n_cosines = sine_of.size(), n_sines = size() - n_cosines;
    Eigen::VectorXd                                   y = turned(z, mean.c, mean.s);
    influence_along_skew(X, false, L);
    lu.compute(L);
    y.head(n_cosines) = lu.solve(y.head(n_cosines)).eval();
    if (n_sines > 0)
      {
        influence_along_skew(X, true, L);
        lu.compute(L);
        y.tail(n_sines) = lu.solve(y.tail(n_sines)).eval();
      }
    return turned(y, mean.c, -mean.s);
  }



  Eigen::VectorXcd
  FiniteStateInflow::loads_of(const Eigen::VectorXcd &z, const Flow<std::complex<double>> &f, const MeanFlow &) const
  {
    return solution(influence(f.X_x, f.X_y), z);
  }



  template <typename Number>
  FiniteStateInflow::Flow<Number>
  FiniteStateInflow::flow(const Vector<Number> &z,
                          const Flight<Number> &flight,
                          const double          radius,
                          const double          least) const
  {
    const Flight<double> real = {
      real_of(flight.mu_x), real_of(flight.mu_y), real_of(flight.lambda_f), real_of(flight.spin), flight.growth};
    const MeanFlow mean = mean_flow(real_parts(z), real, least);
    Flow<Number>   f    = at_mean_flow(Number(mean.nu), flight, least);
    if constexpr (!std::is_same_v<Number, double>)
      {
        // what is imaginary is right after one step with the slope of the solution
        const Number found = k * loads_of(z, f, mean)(0);
        f                  = at_mean_flow(Number(f.nu - (f.nu - found) / mean.slope), flight, least);
      }
    // R M ż = −V L⁻¹ z, V_T for the part of a uniform load u and V_m for the rest; stations add their loads
    f.y = loads_of(z, f, mean);
    f.rate.resize(size());
    for (unsigned int j = 0; j < size(); ++j)
      f.rate(j) = -(f.V_m * f.y(j) + (f.V_T - f.V_m) * u[j] * f.y(0)) / (radius * apparent_mass[j]);
    // axes that turn with the hub: a harmonic m that stands in space goes back by m ψ in them
    for (unsigned int j = 0; j < sine_of.size(); ++j)
      if (sine_of[j] >= 0)
        {
          const double m = disk.shapes[j].m;
          f.rate(j) += m * flight.spin * z(sine_of[j]);
          f.rate(sine_of[j]) -= m * flight.spin * z(j);
        }
    // shapes are functions of r/R: where R grows the flow that stands in the air has other amplitudes
    if (flight.growth != 0)
      f.rate += flight.growth * (stretch.template cast<Number>() * z);
    return f;
  }



  FiniteStateInflow::Derivatives
  FiniteStateInflow::derivatives(const Flow<double>    &f,
                                 const Eigen::VectorXd &z,
                                 const Flight<double>  &flight,
                                 const double           radius,
                                 const double           least) const
  {
    // columns: z, then μ_x, μ_y, λ_f
    const unsigned int                         n = size();
    const Eigen::MatrixXd                      L = influence(f.X_x, f.X_y);
    const Lu                                   lu(L);
    const auto [by_x, by_y]   = influence_slopes(f.X_x, f.X_y);
    const Eigen::VectorXd Y_x = lu.solve(by_x * f.y), Y_y = lu.solve(by_y * f.y);
    using Row                   = Eigen::RowVectorXd;
    const double size_of_lambda = smooth_size(f.lambda, least), height = f.V_T + size_of_lambda;
    const Row    dmu_x = Row::Unit(n + 3, n), dmu_y = Row::Unit(n + 3, n + 1), dlambda_f = Row::Unit(n + 3, n + 2);

    // dX = a + b dν
    const Row    dV_of_mu  = (flight.mu_x * dmu_x + flight.mu_y * dmu_y) / f.V_T;
    const double by_lambda = f.lambda / f.V_T + f.lambda / size_of_lambda;
    const Row    dheight   = dV_of_mu + by_lambda * dlambda_f;
    const Row    a_x = (dmu_x - f.X_x * dheight) / height, a_y = (dmu_y - f.X_y * dheight) / height;
    const double b_x = -f.X_x * by_lambda / height, b_y = -f.X_y * by_lambda / height;

    Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(n, n + 3);
    inverse.leftCols(n)     = lu.inverse();
    const Row dnu = k * (Row(inverse.row(0)) - Y_x(0) * a_x - Y_y(0) * a_y) / (1 + k * (Y_x(0) * b_x + Y_y(0) * b_y));
    const Eigen::MatrixXd dy = inverse - Y_x * (a_x + b_x * dnu) - Y_y * (a_y + b_y * dnu);

    const Row dlambda = dlambda_f + dnu, dV_T = dV_of_mu + f.lambda / f.V_T * dlambda,
              dV_m =
                (2 * (flight.mu_x * dmu_x + flight.mu_y * dmu_y) + (2 * f.lambda + f.nu) * dlambda + f.lambda * dnu) /
                  f.V_T -
                f.V_m / f.V_T * dV_T;
    Eigen::MatrixXd d(n, n + 3);
    for (unsigned int j = 0; j < n; ++j)
      d.row(j) = -(f.V_m * dy.row(j) + f.y(j) * dV_m + u[j] * ((f.V_T - f.V_m) * dy.row(0) + f.y(0) * (dV_T - dV_m))) /
                 (radius * apparent_mass[j]);

    Derivatives result;
    result.by_z                    = d.leftCols(n);
    result.by_flight               = Eigen::MatrixXd::Zero(n, 4);
    result.by_flight.leftCols<3>() = d.rightCols<3>();
    for (unsigned int j = 0; j < sine_of.size(); ++j)
      if (sine_of[j] >= 0)
        {
          const double m = disk.shapes[j].m;
          result.by_z(j, sine_of[j]) += m * flight.spin;
          result.by_z(sine_of[j], j) -= m * flight.spin;
          result.by_flight(j, 3) += m * z(sine_of[j]);
          result.by_flight(sine_of[j], 3) -= m * z(j);
        }
    if (flight.growth != 0)
      result.by_z += flight.growth * stretch;
    return result;
  }



  template FiniteStateInflow::Matrix<double> FiniteStateInflow::influence(const double &, const double &) const;
  template FiniteStateInflow::Flow<double>
  FiniteStateInflow::flow(const Vector<double> &, const Flight<double> &, double, double) const;
  template FiniteStateInflow::Flow<std::complex<double>> FiniteStateInflow::flow(const Vector<std::complex<double>> &,
                                                                                 const Flight<std::complex<double>> &,
                                                                                 double,
                                                                                 double) const;
} // namespace samara
