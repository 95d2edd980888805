#include <samara/base/dense.h>
#include <samara/base/errors.h>
#include <samara/solvers/eigen_system.h>
#include <samara/solvers/krylov_schur.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>

extern "C" void dtrsen_(const char *job,
                        const char *compq,
                        const int  *select,
                        const int  *n,
                        double     *t,
                        const int  *ldt,
                        double     *q,
                        const int  *ldq,
                        double     *wr,
                        double     *wi,
                        int        *m,
                        double     *s,
                        double     *sep,
                        double     *work,
                        const int  *lwork,
                        int        *iwork,
                        const int  *liwork,
                        int        *info);

namespace samara
{
  namespace
  {
    using Eigen::MatrixXd, Eigen::VectorXd;

    /** Sizes of eigenvalues that differ by less are the same, for who asks whether one was missed. */
    constexpr double same_size = 1e-6;

    /** The same of the two of a pair, which round-off may make different. */
    constexpr double same_for_pairs = 1e-12;

    /** Products behind a new start before it is asked whether anything as large is there, and the part of the distance
     * to it to which the residual of the next smaller value must have come down: at first Ritz values and their
     * residuals are small because what is large is a small part of a random start. @{ */
    constexpr unsigned int least_products_of_a_look = 6;
    constexpr double       share_of_distance        = 0.5;
    /** @} */

    /** Eigenvalues of the diagonal blocks of a real Schur form, one a column. */
    std::vector<std::complex<double>>
    values_of_blocks(const MatrixXd &T)
    {
      const int                         n = T.rows();
      std::vector<std::complex<double>> values(n);
      for (int i = 0; i < n; ++i)
        if (i + 1 < n && T(i + 1, i) != 0.)
          {
            const double mean = 0.5 * (T(i, i) + T(i + 1, i + 1)), half = 0.5 * (T(i, i) - T(i + 1, i + 1));
            const std::complex<double> root = std::sqrt(std::complex<double>(half * half + T(i, i + 1) * T(i + 1, i)));
            values[i]                       = mean + root;
            values[i + 1]                   = mean - root;
            ++i;
          }
        else
          values[i] = T(i, i);
      return values;
    }



    /**
     * A V = V S + v bᵀ + D Lᵀ with orthonormal (V, v), the first two terms as one matrix H = (S; bᵀ). Each time when
     * the iteration goes on from a random start, v and b of before are left behind as columns of D and L: of what had
     * converged they are the residual.
     */
    class KrylovSchur
    {
    public:
      KrylovSchur(const unsigned int                                     n,
                  const std::function<void(const double *x, double *y)> &apply,
                  const unsigned int                                     wanted,
                  const ArnoldiSettings                                 &settings)
        : n(n)
        , apply(apply)
        , wanted(wanted)
        , settings(settings)
        , m(std::min(n, std::max(settings.largest_basis, 2 * wanted + 10)))
        , V(n, m + 1)
        , H(MatrixXd::Zero(m + 1, m))
        , D(n, 0)
        , L(m, 0)
        , generator(n)
      {
        V.col(0) = random_vector(0);
      }

      EigenPairs
      find()
      {
        double smallest = -1; // of those that have converged once
        for (;;)
          {
            do
              expand();
            while (size < m && !is_worth_sorting(smallest >= 0));
            const bool         is_all = size == n;
            const unsigned int kept   = sort();
            if (const auto pairs = converged_pairs(kept))
              {
                const double now = std::abs(pairs->values.back());
                // all there is, or nothing larger beside it
                const bool is_complete = is_all || (smallest >= 0 && now <= smallest * (1 + same_size));
                if (is_complete && are_within_tolerance(*pairs))
                  return *pairs;
                smallest = now;
                truncate(kept);
                if (is_complete)
                  take_up();
                else
                  leave_behind(random_vector(size));
              }
            else if (size == m)
              truncate(kept + (m - kept) / 3);
            if (n_products >= settings.most_products)
              throw NotConverged("Arnoldi's method has not found " + std::to_string(wanted) + " eigenvalues of " +
                                 std::to_string(n) + " with " + std::to_string(n_products) + " products");
          }
      }

    private:
      const unsigned int                                    n;
      const std::function<void(const double *x, double *y)> apply;
      const unsigned int                                    wanted;
      const ArnoldiSettings                                 settings;
      const unsigned int                                    m; ///< the largest basis
      MatrixXd                                              V, H;
      MatrixXd                                              D, L;           ///< left behind, one column a start
      unsigned int                                          size       = 0; ///< of V, without v
      unsigned int                                          n_products = 0, n_of_look = 0; ///< the latter since a start
      std::mt19937                                          generator;

      /** Take from @p x what lies in the first vectors, twice, which is enough (Kahan; Parlett 1980). */
      VectorXd
      orthogonalize(VectorXd &x, const unsigned int n_vectors) const
      {
        VectorXd sum = VectorXd::Zero(n_vectors);
        for (unsigned int pass = 0; pass < 2; ++pass)
          {
            const VectorXd c = V.leftCols(n_vectors).transpose() * x;
            x.noalias() -= V.leftCols(n_vectors) * c;
            sum += c;
          }
        return sum;
      }

      /** Of unit norm, orthogonal to the first vectors; zero if these are all there are. */
      VectorXd
      random_vector(const unsigned int n_vectors)
      {
        if (n_vectors >= n)
          return VectorXd::Zero(n);
        std::uniform_real_distribution<double> number(-1., 1.);
        VectorXd                               x(n);
        for (double &x_i : x)
          x_i = number(generator);
        orthogonalize(x, n_vectors);
        return x.normalized();
      }

      void
      expand()
      {
        VectorXd y(n);
        apply(V.col(size).data(), y.data());
        ++n_products;
        ++n_of_look;
        if (!y.allFinite())
          throw NotConverged("Arnoldi's method: the operator gives what is not a number");
        const double before        = y.norm();
        H.col(size).head(size + 1) = orthogonalize(y, size + 1);
        H.col(size).tail(m - size).setZero();
        const double after = y.norm();
        ++size;
        if (size < n && after > 1e-14 * before)
          {
            H(size, size - 1) = after;
            V.col(size)       = y / after;
          }
        else
          V.col(size) = random_vector(size); // the space is invariant: go on elsewhere
      }

      /**
       * Whether the Ritz pairs that are wanted have converged; @p once_more: and what is beside them is smaller, by
       * more than its residuals tell. It is asked after every product, which costs more than the values of so small a
       * matrix.
       */
      bool
      is_worth_sorting(const bool once_more) const
      {
        if (size == n)
          return true;
        if (size <= wanted || (once_more && n_of_look < least_products_of_a_look))
          return false;
        const EigenSystem     spectrum  = eigen_system_of(H.topLeftCorner(size, size));
        const Eigen::VectorXd sizes     = spectrum.values.cwiseAbs(),
                              residuals = (H.row(size).head(size) * spectrum.vectors).cwiseAbs().transpose();
        std::vector<double> sorted(sizes.begin(), sizes.end());
        std::sort(sorted.rbegin(), sorted.rend());
        const double least = sorted[wanted - 1] * (1 - same_for_pairs);
        double       next = 0, residual = 0; // of what is largest beside them
        for (unsigned int i = 0; i < size; ++i)
          if (sizes(i) >= least)
            {
              if (residuals(i) > allowed_residual(spectrum.values(i)))
                return false;
            }
          else if (sizes(i) > next)
            {
              next     = sizes(i);
              residual = residuals(i);
            }
        return !once_more || residual < share_of_distance * (least - next);
      }

      /** Bring S to Schur form, the largest eigenvalues in front; returns how many: those wanted, pairs not torn. */
      unsigned int
      sort()
      {
        auto [T, U, was_found] = real_schur(H.topLeftCorner(size, size));
        if (!was_found)
          throw NotConverged("Arnoldi's method: no Schur form was found");
        const auto          values = values_of_blocks(T);
        std::vector<double> sizes;
        for (const auto &value : values)
          sizes.push_back(std::abs(value));
        std::sort(sizes.rbegin(), sizes.rend());
        const double     least = sizes[wanted - 1] * (1 - same_for_pairs);
        std::vector<int> select(size, 0);
        for (unsigned int i = 0; i < size; ++i)
          select[i] = std::abs(values[i]) >= least;
        for (unsigned int i = 0; i + 1 < size; ++i)
          if (T(i + 1, i) != 0.)
            select[i] = select[i + 1] = select[i] || select[i + 1];
        const int           size_of_T = size, n_numbers = size;
        int                 n_selected = 0, info = 0, n_integers = 1, integers[1];
        std::vector<double> real(size), imag(size), work(size);
        double              s = 0, sep = 0;
        dtrsen_("N",
                "V",
                select.data(),
                &size_of_T,
                T.data(),
                &size_of_T,
                U.data(),
                &size_of_T,
                real.data(),
                imag.data(),
                &n_selected,
                &s,
                &sep,
                work.data(),
                &n_numbers,
                integers,
                &n_integers,
                &info);
        if (info < 0)
          throw std::logic_error("dtrsen: argument " + std::to_string(-info));
        if (info > 0)
          throw NotConverged("Arnoldi's method: the largest eigenvalues cannot be brought to the front");
        const VectorXd b            = U.transpose() * H.row(size).head(size).transpose();
        H.topLeftCorner(size, size) = T;
        H.row(size).head(size)      = b.transpose();
        V.leftCols(size)            = (V.leftCols(size) * U).eval();
        L.topRows(size)             = (U.transpose() * L.topRows(size)).eval();
        return std::max<unsigned int>(n_selected, 1);
      }

      /** Of the first @p kept, if these have converged but for what is left behind; residuals count that, too. */
      std::optional<EigenPairs>
      converged_pairs(const unsigned int kept) const
      {
        const EigenSystem         spectrum = eigen_system_of(H.topLeftCorner(kept, kept));
        std::vector<unsigned int> order(kept);
        for (unsigned int i = 0; i < kept; ++i)
          order[i] = i;
        std::stable_sort(order.begin(), order.end(), [&](const unsigned int i, const unsigned int j) {
          return std::abs(spectrum.values(i)) > std::abs(spectrum.values(j)) * (1 + 1e-12);
        });
        EigenPairs pairs;
        pairs.vectors.resize(n, kept);
        pairs.n_products = n_products;
        pairs.projected  = H.topLeftCorner(kept, kept);
        for (unsigned int i = 0; i < kept; ++i)
          {
            const std::complex<double> value = spectrum.values(order[i]);
            const Eigen::VectorXcd     y     = spectrum.vectors.col(order[i]);
            const Eigen::VectorXcd     b     = H.row(size).head(kept) * y;
            if (b.norm() > allowed_residual(value))
              return {};
            pairs.values.push_back(value);
            pairs.residuals.push_back((V.col(size) * b + D * (L.topRows(kept).transpose() * y)).norm());
            pairs.vectors.col(i) = V.leftCols(kept) * y;
          }
        return pairs;
      }

      double
      allowed_residual(const std::complex<double> value) const
      {
        const double floor = std::numeric_limits<double>::epsilon() * H.norm();
        return std::max(settings.tolerance * std::abs(value), 10 * floor);
      }

      bool
      are_within_tolerance(const EigenPairs &pairs) const
      {
        for (unsigned int i = 0; i < pairs.values.size(); ++i)
          if (pairs.residuals[i] > allowed_residual(pairs.values[i]))
            return false;
        return true;
      }

      /** Go on from @p start, a unit vector orthogonal to V, in place of v. */
      void
      leave_behind(const VectorXd &start)
      {
        D.conservativeResize(Eigen::NoChange, D.cols() + 1);
        L.conservativeResize(Eigen::NoChange, L.cols() + 1);
        D.rightCols(1) = V.col(size);
        L.rightCols(1).setZero();
        L.rightCols(1).topRows(size) = H.row(size).head(size).transpose();
        H.row(size).setZero();
        V.col(size) = start;
        n_of_look   = 0;
      }

      /** Go on from what is largest of all that was left behind: d = V c + ρ v, so that S becomes S + c lᵀ, b = ρ l. */
      void
      take_up()
      {
        Eigen::Index largest;
        L.topRows(size).colwise().norm().maxCoeff(&largest);
        VectorXd       d = D.col(largest), l = L.col(largest).head(size);
        const VectorXd c   = orthogonalize(d, size);
        const double   rho = d.norm();
        L.col(largest).setZero();
        const bool is_in_space = !(rho > 1e-14); // of a unit vector: round-off
        leave_behind(is_in_space ? random_vector(size) : VectorXd(d / rho));
        H.topLeftCorner(size, size) += c * l.transpose();
        if (!is_in_space)
          H.row(size).head(size) = rho * l.transpose();
      }

      /** Keep the first @p n_kept Schur vectors, and v behind them; a pair that this would tear stays whole. */
      void
      truncate(unsigned int n_kept)
      {
        if (n_kept < size && H(n_kept, n_kept - 1) != 0.)
          ++n_kept;
        n_kept           = std::min(n_kept, m - 1);
        const VectorXd b = H.row(size).head(n_kept);
        const MatrixXd T = H.topLeftCorner(n_kept, n_kept);
        const VectorXd v = V.col(size);
        H.setZero();
        H.topLeftCorner(n_kept, n_kept) = T;
        H.row(n_kept).head(n_kept)      = b.transpose();
        V.col(n_kept)                   = v;
        size                            = n_kept;
        L.bottomRows(m - size).setZero();
      }
    };
  } // namespace



  EigenPairs
  arnoldi(const unsigned int                                     n,
          const std::function<void(const double *x, double *y)> &apply,
          const unsigned int                                     wanted,
          const ArnoldiSettings                                 &settings)
  {
    if (wanted == 0 || wanted > n)
      throw std::invalid_argument("there are not " + std::to_string(wanted) + " eigenvalues of an operator of size " +
                                  std::to_string(n));
    return KrylovSchur(n, apply, wanted, settings).find();
  }
} // namespace samara
