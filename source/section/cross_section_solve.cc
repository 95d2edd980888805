// Warping of a cross-section at unit section forces: one real and, for twisted or curved beams, one complex
// factorisation.

#include <samara/section/cross_section.h>

#include <samara/base/dense.h>

#include <Eigen/CholmodSupport>

#include <complex>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>
#include <type_traits>

namespace samara
{
  namespace
  {
    using Complex        = std::complex<double>;
    using ComplexColumns = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic>;

    /** P(θ) = E + θ (Cᵀ − C) − θ² M, the pinned unknowns held; positive definite for θ = 0, Hermitian for θ = i|k|. */
    template <typename Number>
    class Warping
    {
    public:
      Warping(const SectionMatrix     &E,
              const SectionMatrix     &C,
              const SectionMatrix     &M,
              const Number             theta,
              const std::vector<bool> &is_pinned)
      {
        const unsigned int                                n = E.rows();
        Eigen::SparseMatrix<Number, Eigen::ColMajor, int> lower(n, n);
        lower.reserve((E.nonZeros() + n) / 2);
        for (unsigned int j = 0; j < n; ++j)
          {
            // the pattern is symmetric: the row lists the column's entries in order
            lower.startVec(j);
            SectionMatrix::InnerIterator e(E, j), c(C, j), m(M, j);
            for (; e; ++e, ++c, ++m)
              {
                const unsigned int i = e.col();
                if (i < j || (i > j && (is_pinned[i] || is_pinned[j])))
                  continue;
                Number value = e.value();
                if (theta != Number(0) && !is_pinned[j])
                  value += theta * (c.value() - C.coeff(i, j)) - theta * theta * Number(m.value());
                lower.insertBack(i, j) = value;
              }
          }
        lower.finalize();
        factors.cholmod().print = 0; // what it finds is told here
        factors.compute(lower);
        if (factors.info() != Eigen::Success)
          throw std::invalid_argument(
            "the warping of the section has no positive energy: check the materials, that the curvature times the "
            "depth of the section is well below one, and that the walls are not as thin as round-off of their width");
      }

      /** About the smallest over the largest eigenvalue. */
      double
      condition()
      {
        return factors.condition();
      }

      Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>
      solve(const Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic> &b) const
      {
        return factors.solve(b);
      }

    private:
      using Library = Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<Number, Eigen::ColMajor, int>, Eigen::Lower>;
      struct Factors : Library
      {
        double
        condition()
        {
          return cholmod_rcond(this->m_cholmodFactor, &this->cholmod());
        }
      };
      Factors factors;
    };



    /** U with k~ U = U diag(θ), θ = (0, i|k|, −i|k|), the last two columns conjugate. */
    Eigen::Matrix3cd
    eigenvectors_of_skew(const Vector3 &k)
    {
      Eigen::Matrix3cd U = Eigen::Matrix3cd::Identity();
      if (k.norm() == 0)
        return U;
      const Vector3 n = k.normalized(), a = n.unitOrthogonal(), b = n.cross(a);
      U.col(0) = n.cast<Complex>();
      U.col(1) = (a.cast<Complex>() - Complex(0, 1) * b.cast<Complex>()) / std::sqrt(2.);
      U.col(2) = U.col(1).conjugate();
      return U;
    }

    /** The integrals of CrossSection, where they are. */
    struct WarpingIntegrals
    {
      const SectionMatrix                            &E, &C, &M;
      const Eigen::Matrix<double, Eigen::Dynamic, 6> &R, &L;
      const Matrix6                                  &A, &T;
    };

    struct UnitWarping
    {
      Eigen::Matrix<double, Eigen::Dynamic, 6> X;
      Matrix6                                  Y;
      double                                   condition;
    };



    /** (C − Cᵀ) x₁ + M x₂ for matrices of one pattern, in one pass. */
    ComplexColumns
    skew_times(const SectionMatrix &C, const ComplexColumns &x1, const SectionMatrix &M, const ComplexColumns &x2)
    {
      ComplexColumns result = ComplexColumns::Zero(x1.rows(), 1);
      for (unsigned int i = 0; i < x1.rows(); ++i)
        {
          SectionMatrix::InnerIterator m(M, i);
          for (SectionMatrix::InnerIterator c(C, i); c; ++c, ++m)
            {
              const unsigned int j = c.col();
              result(i) += c.value() * x1(j) + m.value() * x2(j);
              result(j) -= c.value() * x1(i);
            }
        }
      return result;
    }



    /** [P(θ), R + θL; (R − θL)ᵀ, A] (x, y) = (f, g) for one θ, 0 or i|k|, by the Schur complement of P. */
    template <typename Number>
    class BorderedWarping
    {
    public:
      using Columns = Eigen::Matrix<double, Eigen::Dynamic, 6>;

      BorderedWarping(const Warping<Number>             &P,
                      const std::array<unsigned int, 6> &pinned,
                      const Columns                     &R,
                      const Columns                     &L,
                      const Matrix6                     &A,
                      const Complex                      theta)
        : P(P)
        , pinned(pinned)
        , PB(inverse(without_pins(R.cast<Complex>() + theta * L.cast<Complex>())))
        , rows(without_pins(R.cast<Complex>() - theta * L.cast<Complex>()).transpose())
        , complement(A.cast<Complex>() - rows * PB)
      {}

      /** (x, y) */
      std::pair<ComplexColumns, ComplexColumns>
      solve(const ComplexColumns &f, const ComplexColumns &g) const
      {
        const ComplexColumns x0 = inverse(without_pins(f));
        const ComplexColumns y  = complement.solve(g - rows * x0);
        return {x0 - PB * y, y};
      }

    private:
      const Warping<Number>                    &P;
      const std::array<unsigned int, 6>        &pinned;
      const ComplexColumns                      PB, rows;
      const ComplexLu                           complement;

      ComplexColumns
      without_pins(ComplexColumns x) const
      {
        for (const auto i : pinned)
          x.row(i).setZero();
        return x;
      }

      ComplexColumns
      inverse(const ComplexColumns &b) const
      {
        if constexpr (std::is_same_v<Number, Complex>)
          return P.solve(b);
        else
          {
            ComplexColumns x(b.rows(), b.cols());
            x.real() = P.solve(b.real());
            if (b.imag().isZero(0.))
              x.imag().setZero();
            else
              x.imag() = P.solve(b.imag());
            return x;
          }
      }
    };



    UnitWarping
    warping_of(const WarpingIntegrals &of, const Vector3 &k, const std::array<unsigned int, 6> &pinned)
    {
      const auto &[E, C, M, R, L, A, T] = of;
      const unsigned int n              = E.rows();
      const double       kappa          = k.norm();
      std::vector<bool>  is_pinned(n, false);
      for (const auto i : pinned)
        is_pinned[i] = true;
      Warping<double>                                 straight(E, C, M, 0., is_pinned);
      const BorderedWarping<double>                   at_zero(straight, pinned, R, L, A, 0.);
      std::unique_ptr<const Warping<Complex>>         turning;
      std::unique_ptr<const BorderedWarping<Complex>> at_kappa;
      if (kappa > 0)
        {
          turning  = std::make_unique<Warping<Complex>>(E, C, M, Complex(0, kappa), is_pinned);
          at_kappa = std::make_unique<BorderedWarping<Complex>>(*turning, pinned, R, L, A, Complex(0, kappa));
        }

      // In the eigenvectors of T the equations of X and Y (doc/theory/cross_section.md) fall apart: moments are its
      // eigenvectors, forces depend on them by the last block of T, here W.
      const Eigen::Matrix3cd U        = eigenvectors_of_skew(k);
      const Complex          theta[3] = {0., Complex(0, kappa), Complex(0, -kappa)};
      const Eigen::Matrix3cd W        = U.adjoint() * T.bottomLeftCorner<3, 3>().cast<Complex>() * U;

      // unit moments, then unit forces, in the directions U; of a conjugate pair only the first is solved for
      ComplexColumns x_moment(n, 3), y_moment(6, 3), x_force(n, 3), y_force(6, 3);
      for (const bool forces : {false, true})
        for (unsigned int j = 0; j < 3; ++j)
          {
            ComplexColumns &x = forces ? x_force : x_moment, &y = forces ? y_force : y_moment;
            if (kappa > 0 && j == 2)
              {
                x.col(2) = x.col(1).conjugate();
                y.col(2) = y.col(1).conjugate();
                continue;
              }
            ComplexColumns f = ComplexColumns::Zero(n, 1), g = ComplexColumns::Zero(6, 1);
            if (!forces)
              g.bottomRows(3) = U.col(j);
            else
              {
                Eigen::Vector3cd with_theta = theta[j] * W.col(j);
                for (unsigned int i = 0; i < 3; ++i)
                  with_theta(i) += theta[i] * W(i, j);
                const ComplexColumns x1 = x_moment * W.col(j), x2 = x_moment * with_theta, y1 = y_moment * W.col(j);
                f            = skew_times(C, x1, M, x2) - L * y1;
                g.topRows(3) = U.col(j);
                g += L.transpose() * x1;
              }
            const auto solution = theta[j] == 0. ? at_zero.solve(f, g) : at_kappa->solve(f, g);
            x.col(j)            = solution.first;
            y.col(j)            = solution.second;
          }
      UnitWarping result;
      result.X.resize(n, 6);
      result.X.leftCols(3)  = (x_force * U.adjoint()).real();
      result.X.rightCols(3) = (x_moment * U.adjoint()).real();
      result.Y.leftCols(3)  = (y_force * U.adjoint()).real();
      result.Y.rightCols(3) = (y_moment * U.adjoint()).real();
      result.condition      = straight.condition();
      return result;
    }



    /** Numbers changed by up to a unit in their last place, at random. */
    void
    round_otherwise(double *const numbers, const std::ptrdiff_t n, std::mt19937 &random)
    {
      for (std::ptrdiff_t i = 0; i < n; ++i)
        numbers[i] *= 1 + std::numeric_limits<double>::epsilon() * (random() / (0.5 * std::mt19937::max()) - 1);
    }
  } // namespace



  void
  CrossSection::solve()
  {
    const UnitWarping found = warping_of({E, C, M, R, L, A, T}, k, pinned);
    X                       = found.X;
    Y                       = found.Y;
    // walls that are thin for their width are so soft in bending across that they feel the last places of E: where that
    // may matter the analysis is made once more with other ones
    constexpr double doubtful = 1e-9, largest = 1e-3;
    if (found.condition > doubtful)
      return;
    const Matrix6       F        = compliance_about_centre();
    const SectionMatrix E_before = E;
    const Columns       R_before = R;
    std::mt19937        random(1);
    round_otherwise(E.valuePtr(), E.nonZeros(), random);
    round_otherwise(R.data(), R.size(), random);
    const UnitWarping other = warping_of({E, C, M, R, L, A, T}, k, pinned);
    X                       = other.X;
    Y                       = other.Y;
    const Vector6 scale     = F.diagonal().cwiseSqrt().cwiseInverse();
    const double  change =
      (scale.asDiagonal() * (compliance_about_centre() - F) * scale.asDiagonal()).cwiseAbs().maxCoeff();
    if (!(change < largest))
      throw std::invalid_argument(
        "the analysis of the section is lost in round-off: its walls or plies are too thin for "
        "their width; give a lower <Degree>, more <Elements> or thicker plies");
    E = E_before;
    R = R_before;
    X = found.X;
    Y = found.Y;
  }
} // namespace samara
