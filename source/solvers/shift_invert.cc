#include <samara/base/interrupt.h>
#include <samara/solvers/shift_invert.h>

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

#include <algorithm>
#include <cmath>

namespace samara
{
  ShiftInvert::Entries::Entries(const SparseMatrix &A, const unsigned int n)
  {
    for (unsigned int j = 0; j < n; ++j)
      for (int k = A.pattern->column_start[j]; k < A.pattern->column_start[j + 1]; ++k)
        if (A.values[k] != 0. && A.pattern->rows[k] < static_cast<int>(n))
          {
            rows.push_back(A.pattern->rows[k]);
            columns.push_back(j);
            values.push_back(A.values[k]);
          }
  }



  namespace
  {
    /** Whether a_ij = sign a_ji in the first @p n rows, to 1e-9 of the largest of them and @p round_off. */
    bool
    is_mirrored(const SparseMatrix &A, const double sign, const unsigned int n, const double round_off = 0)
    {
      double largest = 0, difference = 0;
      for (unsigned int j = 0; j < n; ++j)
        for (int k = A.pattern->column_start[j]; k < A.pattern->column_start[j + 1]; ++k)
          if (const int i = A.pattern->rows[k]; A.values[k] != 0. && i < static_cast<int>(n))
            {
              const int other = A.pattern->position(j, i);
              largest         = std::max(largest, std::abs(A.values[k]));
              difference      = std::max(difference, std::abs(A.values[k] - sign * (other < 0 ? 0. : A.values[other])));
            }
      return difference <= 1e-9 * largest + round_off;
    }

    /** Whether Gᵀ is that of G, and multipliers have nothing else. */
    bool
    has_mirrored_constraints(const LinearMotion &motion)
    {
      const Pattern &p = *motion.S.pattern;
      for (int j = motion.n_kinematic; j < p.size(); ++j)
        for (int k = p.column_start[j]; k < p.column_start[j + 1]; ++k)
          {
            const double a     = motion.S.values[k];
            const int    i     = p.rows[k];
            const int    other = p.position(j, i);
            if (i >= static_cast<int>(motion.n_kinematic) ?
                  a != 0. :
                  !(std::abs(a - motion.S.values[other]) <= 1e-12 * std::abs(a)))
              return false;
          }
      return true;
    }

    /** The largest stiffness of a strain for an unknown. */
    double
    largest_stiffness(const LinearMotion &motion)
    {
      const SparseRows &B      = motion.strains.B;
      double            result = 0;
      for (const auto &p : motion.strains.points)
        {
          const auto C = motion.strains.C(p);
          for (unsigned int i = 0; i < p.size; ++i)
            for (unsigned int k = B.start[p.first_row + i]; k < B.start[p.first_row + i + 1]; ++k)
              result = std::max(result, p.weight * std::abs(C(i, i)) * B.values[k] * B.values[k]);
        }
      return result;
    }
  } // namespace



  ShiftInvert::ShiftInvert(const LinearMotion &motion, TellProgress listener)
    : motion(motion)
    , listener(std::move(listener))
    , n(motion.n_kinematic)
    , matrix(motion)
    , M(motion.M, n)
    , gyroscopic(motion.gyroscopic, n)
    , mass(n, 0.)
    , zeta_now(n)
  {
    // not the diagonal: where that is round-off of zero, as the inertia of a line about itself in turned axes, what
    // stands beside it is much larger
    M.for_all([&](const int i, const int j, const double a) {
      mass[i] = std::max(mass[i], std::abs(a) * motion.units[j] / motion.units[i]);
    });
    // the geometric stiffness of a shell without stress is round-off of its stresses
    const bool S_is = is_mirrored(motion.S, 1., n, 1e-14 * largest_stiffness(motion));
    is_symmetric    = S_is && is_mirrored(motion.gyroscopic, 1., n) && motion.B_dot.n_rows() == 0;
    is_conservative = S_is && is_mirrored(motion.gyroscopic, -1., n) && !motion.strains.is_viscous();
    has_no_rates    = is_conservative && gyroscopic.values.empty() && motion.B_dot.n_rows() == 0 &&
                   is_mirrored(motion.M, 1., n) && has_mirrored_constraints(motion);
  }



  void
  ShiftInvert::tell(const std::string &doing) const
  {
    if (listener)
      listener(doing);
  }



  bool
  ShiftInvert::is_undamped() const
  {
    return has_no_rates && matrix.has_inertia();
  }



  Eigen::VectorXd
  ShiftInvert::mass_times(const Eigen::VectorXd &zeta) const
  {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(n);
    M.add_product(1., zeta.data(), result.data());
    return result;
  }



  void
  ShiftInvert::set(const double shift, const double unit)
  {
    time_unit = unit;
    if (b.empty() || shift != matrix.shift())
      {
        tell("factors of the matrix of " + std::to_string(matrix.size()) + " unknowns");
        matrix.factorize(shift);
      }
    b.resize(matrix.size());
  }



  void
  ShiftInvert::apply(const double *z, double *result) const
  {
    throw_if_interrupted();
    const double sigma = shift();
    std::fill(b.begin(), b.end(), 0.);
    for (unsigned int i = 0; i < n; ++i)
      {
        zeta_now[i] = motion.units[i] * z[i];
        b[i]        = -mass[i] * time_unit * motion.units[i] * z[n + i];
      }
    M.add_product(-sigma, zeta_now.data(), b.data());
    gyroscopic.add_product(-1., zeta_now.data(), b.data());
    matrix.add_viscous_part(zeta_now.data(), b.data());
    matrix.solve(b.data());
    for (unsigned int i = 0; i < n; ++i)
      {
        result[i] = b[i] / motion.units[i];
        zeta_now[i] += sigma * b[i]; // v'
      }
    momenta(zeta_now.data(), result + n);
  }



  void
  ShiftInvert::momenta(const double *v, double *p) const
  {
    std::fill(p, p + n, 0.);
    M.add_product(1., v, p);
    for (unsigned int i = 0; i < n; ++i)
      p[i] = mass[i] > 0 ? p[i] / (mass[i] * time_unit * motion.units[i]) : 0.;
  }



  Eigen::VectorXcd
  ShiftInvert::zeta(const Eigen::VectorXcd &z) const
  {
    return z.head(n).cwiseProduct(
      Eigen::Map<const Eigen::VectorXd>(motion.units.data(), n).cast<std::complex<double>>());
  }



  namespace
  {
    /** f for the real and for the imaginary part. */
    template <typename Function>
    Eigen::VectorXcd
    by_parts(const Eigen::VectorXcd &x, const Function &f)
    {
      const Eigen::VectorXd re = f(Eigen::VectorXd(x.real())), im = f(Eigen::VectorXd(x.imag()));
      Eigen::VectorXcd      result(re.size());
      result.real() = re;
      result.imag() = im;
      return result;
    }
  } // namespace



  /** Of the equations above for the state (ζ, λ ζ). */
  Eigen::VectorXcd
  ShiftInvert::right_side(const std::complex<double> &lambda, const Eigen::VectorXcd &zeta) const
  {
    Eigen::VectorXcd f = by_parts(zeta, [&](const Eigen::VectorXd &x) {
      Eigen::VectorXd part = Eigen::VectorXd::Zero(matrix.size());
      matrix.add_viscous_part(x.data(), part.data());
      return part;
    });
    M.add_product(-(lambda + shift()), zeta.data(), f.data());
    gyroscopic.add_product(std::complex<double>(-1.), zeta.data(), f.data());
    return f;
  }



  /** What multiplies δλ in the equations, seen by a left vector of (ζ, μ, q): yᵀ(2λM + Γ)ζ + y_qᵀ F w C_d B ζ. */
  std::complex<double>
  ShiftInvert::slope(const std::complex<double> &lambda,
                     const Eigen::VectorXcd     &left,
                     const Eigen::VectorXcd     &zeta) const
  {
    return -(left.transpose() * right_side(2. * lambda - shift(), zeta))(0);
  }



  Eigen::VectorXcd
  ShiftInvert::left_vector(const std::complex<double> &lambda, const Eigen::VectorXcd &x, const double gap) const
  {
    using Complex                    = std::complex<double>;
    const auto             slope_of  = [&](const Eigen::VectorXcd &y) { return std::abs(slope(lambda, y, x.head(n))); };
    const Eigen::VectorXcd conjugate = x.conjugate();
    const Eigen::VectorXcd near      = slope_of(conjugate) >= slope_of(x) ? conjugate : x;
    if (is_symmetric || (is_conservative && std::abs(lambda.real()) < 1e-8 * std::abs(lambda)))
      return near;

    // the equations at λ
    std::vector<Eigen::Triplet<Complex>> entries;
    const auto                           add = [&](const Complex &factor) {
      return [&entries, factor](const int i, const int j, const double a) { entries.emplace_back(i, j, factor * a); };
    };
    const Complex distance = lambda - shift();
    matrix.for_entries(add(1.));
    matrix.for_viscous_entries(add(distance));
    M.for_all(add(distance * (lambda + shift())));
    gyroscopic.for_all(add(distance));
    Eigen::SparseMatrix<Complex> T(matrix.size(), matrix.size());
    T.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SparseMatrix<Complex> T_transposed = T.transpose();

    // by how much λ would have to differ for it to be one
    const double departure = x.cwiseAbs().dot(Eigen::VectorXcd(T_transposed * near).cwiseAbs()) / slope_of(near);
    if (departure < std::max(0.3 * gap, 1e-8 * std::abs(lambda)))
      return near;
    Eigen::SparseLU<Eigen::SparseMatrix<Complex>, Eigen::COLAMDOrdering<int>> solver;
    solver.compute(T_transposed);
    Eigen::VectorXcd y = near;
    for (unsigned int iteration = 0; iteration < 2 && solver.info() == Eigen::Success; ++iteration)
      y = Eigen::VectorXcd(solver.solve(y)).normalized();
    return solver.info() == Eigen::Success && y.allFinite() ? y : near;
  }



  Eigen::VectorXcd
  ShiftInvert::with_multipliers(const Eigen::VectorXcd &f, const Eigen::VectorXcd &zeta) const
  {
    Eigen::VectorXcd x = by_parts(f, [&](Eigen::VectorXd part) {
      matrix.solve(part.data());
      return part;
    });
    x.head(n)          = zeta;
    return x;
  }



  Eigen::VectorXcd
  ShiftInvert::left_vector_of(const std::complex<double> &lambda, const Eigen::VectorXcd &zeta) const
  {
    constexpr double at_any_distance = 0;
    return left_vector(lambda, with_multipliers(right_side(lambda, zeta) * (lambda - shift()), zeta), at_any_distance)
      .head(n);
  }



  ShiftInvert::Judgement
  ShiftInvert::judge(const std::complex<double> &lambda, const Eigen::VectorXcd &zeta, const double gap) const
  {
    const Eigen::VectorXcd f = right_side(lambda, zeta) * (lambda - shift()), x = with_multipliers(f, zeta);
    const Eigen::VectorXcd r = by_parts(x,
                                        [&](const Eigen::VectorXd &part) {
                                          Eigen::VectorXd product(matrix.size());
                                          matrix.multiply(part.data(), product.data());
                                          return product;
                                        }) -
                               f;
    const Eigen::VectorXcd q = by_parts(x, [&](const Eigen::VectorXd &part) {
      Eigen::VectorXd stress(motion.strains.B.n_rows());
      matrix.stresses(part.data(), stress.data());
      return stress;
    });
    Judgement              result{0, 0, x.cwiseAbs().dot(r.cwiseAbs()), 0};
    for (unsigned int i = 0; i < motion.strains.B.n_rows(); ++i)
      result.work += std::abs(q(i) * motion.strains.B.row_times(i, zeta.data()));
    Eigen::VectorXcd Mz = Eigen::VectorXcd::Zero(n);
    M.add_product(std::complex<double>(1.), zeta.data(), Mz.data());
    result.mass                 = std::abs(zeta.dot(Mz));
    const Eigen::VectorXcd left = left_vector(lambda, x, gap);
    result.error                = left.cwiseAbs().dot(r.cwiseAbs()) / std::abs(slope(lambda, left, zeta));
    return result;
  }
} // namespace samara
