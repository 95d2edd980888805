#include <samara/solvers/shift_invert.h>

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



  ShiftInvert::ShiftInvert(const LinearMotion &motion)
    : motion(motion)
    , n(motion.n_kinematic)
    , matrix(motion)
    , M(motion.M, n)
    , gyroscopic(motion.gyroscopic, n)
    , mass(n, 0.)
    , zeta_now(n)
  {
    for (unsigned int i = 0; i < n; ++i)
      if (const int k = motion.M.pattern->position(i, i); k >= 0)
        mass[i] = motion.M.values[k];
  }



  void
  ShiftInvert::set(const double shift, const double unit)
  {
    time_unit = unit;
    if (b.empty() || shift != matrix.shift())
      matrix.factorize(shift);
    b.resize(matrix.size());
  }



  void
  ShiftInvert::apply(const double *z, double *result) const
  {
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



  /** What multiplies δλ in the equations, seen by a left vector: yᵀ(2λM + Γ)ζ + (B y)ᵀ w C_d B ζ. */
  std::complex<double>
  ShiftInvert::slope(const std::complex<double> &lambda,
                     const Eigen::VectorXcd     &left,
                     const Eigen::VectorXcd     &zeta) const
  {
    Eigen::VectorXcd f = Eigen::VectorXcd::Zero(n);
    M.add_product(2. * lambda, zeta.data(), f.data());
    gyroscopic.add_product(std::complex<double>(1.), zeta.data(), f.data());
    std::complex<double> sum = (left.transpose() * f)(0);
    if (motion.strains.is_viscous())
      for (const auto &p : motion.strains.points)
        {
          Eigen::VectorXcd e(p.size), e_left(p.size);
          for (unsigned int i = 0; i < p.size; ++i)
            {
              e(i)      = motion.strains.B.row_times(p.first_row + i, zeta.data());
              e_left(i) = motion.strains.B.row_times(p.first_row + i, left.data());
            }
          sum += p.weight * (e_left.transpose() * (motion.strains.C_d(p) * e))(0);
        }
    return sum;
  }



  ShiftInvert::Judgement
  ShiftInvert::judge(const std::complex<double> &lambda, const Eigen::VectorXcd &zeta) const
  {
    // one more application gives the stresses and multipliers that belong to the mode
    const Eigen::VectorXcd f = right_side(lambda, zeta) * (lambda - shift());
    Eigen::VectorXcd       x = by_parts(f, [&](Eigen::VectorXd part) {
      matrix.solve(part.data());
      return part;
    });
    x.head(n)                = zeta;
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
    result.mass = std::abs(zeta.dot(Mz));
    result.error =
      result.lost / std::max(std::abs(slope(lambda, zeta.conjugate(), zeta)), std::abs(slope(lambda, zeta, zeta)));
    return result;
  }
} // namespace samara
