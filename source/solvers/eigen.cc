#include <samara/base/errors.h>
#include <samara/solvers/arnoldi.h>
#include <samara/solvers/eigen.h>
#include <samara/solvers/frequency_scale.h>
#include <samara/solvers/shift_invert.h>

#include <algorithm>
#include <numeric>

namespace samara
{
  namespace
  {
    using Complex = std::complex<double>;

    /** An eigenvalue of the shifted problem and its ζ. */
    struct EigenPair
    {
      Complex          lambda;
      Eigen::VectorXcd zeta;
    };



    /** An orthonormal basis of the motions that obey the constraints, G ζ = 0, in the motion's units. */
    Eigen::MatrixXd
    admissible(const LinearMotion &motion)
    {
      const unsigned int n  = motion.n_kinematic;
      Eigen::MatrixXd    Gt = motion.S.dense().topRightCorner(n, motion.S.pattern->size() - n);
      for (unsigned int i = 0; i < n; ++i)
        Gt.row(i) *= motion.units[i];
      if (Gt.cols() == 0)
        return Eigen::MatrixXd::Identity(n, n);
      for (int j = 0; j < Gt.cols(); ++j)
        if (Gt.col(j).norm() > 0)
          Gt.col(j).normalize();
      Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(Gt);
      qr.setThreshold(1e-12);
      return Eigen::MatrixXd(qr.householderQ()).rightCols(n - qr.rank());
    }



    /**
     * All modes by the columns of the operator in a basis of the admissible motions. Without it the infinite
     * eigenvalues of the constraints, which are threefold defective, would come out as large finite ones.
     */
    std::vector<EigenPair>
    dense_pairs(const LinearMotion &motion, const ShiftInvert &op)
    {
      const unsigned int    n = motion.n_kinematic;
      const Eigen::MatrixXd Z = admissible(motion);
      const unsigned int    m = Z.cols();
      Eigen::MatrixXd       A(2 * m, 2 * m);
      Eigen::VectorXd       z(2 * n), image(2 * n);
      for (unsigned int j = 0; j < 2 * m; ++j)
        {
          z.setZero();
          z.segment(j < m ? 0 : n, n) = Z.col(j % m);
          op.apply(z.data(), image.data());
          A.col(j) << Z.transpose() * image.head(n), Z.transpose() * image.tail(n);
        }
      if (m == 0)
        return {};
      const Eigen::EigenSolver<Eigen::MatrixXd> eigen(A);
      // what has no mass is twice defective at zero: its eigenvalues are there to the root of round-off
      const double           zero = 1e-9 * eigen.eigenvalues().cwiseAbs().maxCoeff();
      std::vector<EigenPair> pairs;
      for (unsigned int i = 0; i < 2 * m; ++i)
        if (std::abs(eigen.eigenvalues()(i)) > zero)
          pairs.push_back({op.shift() + 1. / eigen.eigenvalues()(i),
                           op.zeta(Z.cast<Complex>() * eigen.eigenvectors().col(i).head(m))});
      return pairs;
    }



    /** The least number from @p wanted on of the largest values with which no complex pair is parted. */
    unsigned int
    closed(const std::vector<Complex> &values, const unsigned int wanted)
    {
      int balance = 0;
      for (unsigned int k = 0; k < values.size(); ++k)
        {
          if (k >= wanted && balance == 0)
            return k;
          if (values[k].imag() != 0.)
            balance += values[k].imag() > 0 ? 1 : -1;
        }
      return values.size();
    }



    /** Whether the residuals of the first @p k eigenvalues are near round-off. */
    bool
    have_converged(const Arnoldi &arnoldi, const unsigned int k)
    {
      for (unsigned int i = 0; i < k; ++i)
        if (!(arnoldi.residuals[i] < 1e-11 * std::abs(arnoldi.values[i]) + 1e-14 * std::abs(arnoldi.values[0])))
          return false;
      return true;
    }



    std::vector<EigenPair>
    pairs_of(const ShiftInvert &op, const Arnoldi &arnoldi, const unsigned int k)
    {
      std::vector<EigenPair> pairs;
      for (unsigned int i = 0; i < k; ++i)
        pairs.push_back({op.shift() + 1. / arnoldi.values[i], op.zeta(arnoldi.vector(i))});
      return pairs;
    }



    std::vector<EigenPair>
    krylov_pairs(const ShiftInvert &op, const unsigned int wanted, const unsigned int largest_basis)
    {
      Arnoldi      arnoldi([&](const double *x, double *y) { op.apply(x, y); }, op.size(), 2);
      double       smallest_before = 0;
      unsigned int k               = 0;
      for (unsigned int m = 2 * wanted + 16; m <= largest_basis; m += wanted / 2 + 12)
        {
          arnoldi.expand(m);
          k = closed(arnoldi.values, wanted);
          if (!have_converged(arnoldi, k))
            continue;
          const double smallest = std::abs(arnoldi.values[k - 1]);
          if (arnoldi.largest_missed(12) <= smallest || std::abs(smallest - smallest_before) < 1e-6 * smallest)
            return pairs_of(op, arnoldi, k);
          smallest_before = smallest;
          arnoldi.widen();
        }
      // what is far below the largest one may be infinite eigenvalues, seen through round-off, that converge to nothing
      while (k > 0 && std::abs(arnoldi.values[k - 1]) < 1e-6 * std::abs(arnoldi.values[0]))
        --k;
      if (k > 0 && k < wanted && have_converged(arnoldi, k))
        return pairs_of(op, arnoldi, k);
      throw NotConverged(
        "the Arnoldi iteration did not find all modes; ask for fewer or more, or move the <Shift> nearer "
        "to them");
    }



    /** No more eigenvalues are finite than twice the unknowns with mass, if nothing is viscous. */
    unsigned int
    most_eigenvalues(const LinearMotion &motion)
    {
      unsigned int n = 0;
      for (unsigned int i = 0; i < motion.n_kinematic; ++i)
        {
          const int k = motion.M.pattern->position(i, i);
          n += motion.strains.is_viscous() || (k >= 0 && motion.M.values[k] != 0.);
        }
      return 2 * n;
    }



    /** One real shape for each independent motion among those that are there twice at λ = 0. */
    void
    add_free_motions(const std::vector<Eigen::VectorXcd> &shapes, const LinearMotion &motion, std::vector<Mode> &modes)
    {
      if (shapes.empty())
        return;
      const Eigen::Map<const Eigen::VectorXd> units(motion.units.data(), motion.n_kinematic);
      Eigen::MatrixXd                         all(motion.n_kinematic, 2 * shapes.size());
      for (unsigned int i = 0; i < shapes.size(); ++i)
        {
          const Eigen::VectorXcd x = shapes[i].cwiseQuotient(units.cast<Complex>());
          all.col(2 * i)           = x.real() / x.norm();
          all.col(2 * i + 1)       = x.imag() / x.norm();
        }
      Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(all);
      qr.setThreshold(1e-4);
      const Eigen::MatrixXd Q = Eigen::MatrixXd(qr.householderQ() * Eigen::MatrixXd::Identity(all.rows(), qr.rank()));
      for (int i = 0; i < Q.cols(); ++i)
        modes.push_back({0., Q.col(i).cwiseProduct(units).normalized().cast<Complex>(), 0.});
    }



    /** What of the eigenvalues are modes: one of each pair, nothing that moves no mass, free motions once. */
    Modes
    select(const std::vector<EigenPair> &pairs,
           const LinearMotion           &motion,
           const ShiftInvert            &op,
           const double                  frequency)
    {
      Modes                         modes;
      std::vector<Eigen::VectorXcd> free;
      for (const auto &pair : pairs)
        {
          if (pair.lambda.imag() < 0)
            continue; // its conjugate stands for both
          const auto   judgement = op.judge(pair.lambda, pair.zeta);
          const double size      = std::abs(pair.lambda);
          if (size < 3e-8 * frequency ||
              (size < 1e-5 * frequency && size * size * judgement.mass <= 100 * judgement.lost))
            free.push_back(pair.zeta);
          else if (!(judgement.error > 1e-2 * size && size * size * judgement.mass < 0.1 * judgement.work))
            modes.found.push_back({pair.lambda, pair.zeta.normalized(), judgement.error / size});
        }
      add_free_motions(free, motion, modes.found);
      std::stable_sort(modes.found.begin(), modes.found.end(), [](const Mode &a, const Mode &b) {
        return std::abs(a.lambda) < std::abs(b.lambda);
      });
      return modes;
    }
  } // namespace



  namespace
  {
    Modes
    modes_near_shift(const LinearMotion &motion,
                     const ShiftInvert  &op,
                     const unsigned int  n_modes,
                     const double        frequency)
    {
      const unsigned int n = motion.n_kinematic, wanted = std::min(2 * n_modes, most_eigenvalues(motion));
      // where the Krylov space would be most of the space anyway, dense matrices are simpler and complete
      const bool is_small = n <= std::max(2 * wanted, 60u);
      const auto pairs =
        is_small ? dense_pairs(motion, op) : krylov_pairs(op, wanted, std::min(2 * n - 20, 8 * wanted + 100));
      return select(pairs, motion, op, frequency);
    }



    void
    sort(std::vector<Mode> &modes)
    {
      std::stable_sort(modes.begin(), modes.end(), [](const Mode &a, const Mode &b) {
        return std::abs(a.lambda) < std::abs(b.lambda);
      });
    }



    /** Frequencies far below the shift σ are known to ε (σ/λ)² only: see them again from a shift of their own. */
    void
    look_again_at_low_modes(const LinearMotion &motion, ShiftInvert &op, const double frequency, Modes &modes)
    {
      const auto is_doubtful = [&](const Mode &mode) {
        return !mode.is_free() && mode.frequency() < 1e-2 * modes.shift && mode.error > 1e-8;
      };
      const auto lowest = std::find_if(modes.found.begin(), modes.found.end(), is_doubtful);
      if (lowest == modes.found.end())
        return;
      const double       size  = lowest->frequency();
      const unsigned int n_low = std::count_if(modes.found.begin(), modes.found.end(), [&](const Mode &mode) {
        return mode.frequency() < 1e-2 * modes.shift;
      });
      op.set(0.3 * size, size);
      for (const Mode &better : modes_near_shift(motion, op, n_low + 1, frequency).found)
        {
          const auto nearest =
            std::min_element(modes.found.begin(), modes.found.end(), [&](const Mode &a, const Mode &b) {
              return std::abs(a.lambda - better.lambda) < std::abs(b.lambda - better.lambda);
            });
          if (is_doubtful(*nearest) && better.error < nearest->error)
            *nearest = better;
        }
      sort(modes.found);
    }
  } // namespace



  Modes
  find_modes(const LinearMotion &motion, const unsigned int n_modes, const std::optional<double> shift)
  {
    ShiftInvert  op(motion);
    const double frequency = set_by_lowest_frequency(motion, op, shift);
    Modes        modes     = modes_near_shift(motion, op, n_modes, frequency);
    modes.shift            = op.shift();
    if (!shift)
      look_again_at_low_modes(motion, op, frequency, modes);
    modes.is_all = modes.found.size() < n_modes;
    if (modes.found.size() <= n_modes)
      return modes;
    if (shift)
      std::stable_sort(modes.found.begin(), modes.found.end(), [&](const Mode &a, const Mode &b) {
        return std::abs(a.lambda - *shift) < std::abs(b.lambda - *shift);
      });
    modes.found.resize(n_modes);
    sort(modes.found);
    return modes;
  }
} // namespace samara
