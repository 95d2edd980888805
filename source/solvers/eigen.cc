#include <samara/base/dense.h>
#include <samara/base/errors.h>
#include <samara/solvers/arnoldi.h>
#include <samara/solvers/eigen.h>
#include <samara/solvers/frequency_scale.h>
#include <samara/solvers/shift_invert.h>
#include <samara/solvers/undamped.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace samara
{
  namespace
  {
    using Complex = std::complex<double>;

    /** An eigenvalue of the shifted problem and its ζ. */
    struct EigenPair
    {
      Complex                               lambda;
      Eigen::VectorXcd                      zeta;
      std::optional<ShiftInvert::Judgement> judgement = {}; ///< if it is known already
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
      // columns have length one: a pivot below is a constraint that the others imply
      const PivotedQr qr(Gt, 1e-12);
      return qr.Q().rightCols(n - qr.rank());
    }



    /** An orthonormal basis of the momenta of these motions. */
    Eigen::MatrixXd
    momenta_of(const LinearMotion &motion, const ShiftInvert &op, const Eigen::MatrixXd &Z)
    {
      Eigen::MatrixXd P(Z.rows(), Z.cols());
      for (int j = 0; j < Z.cols(); ++j)
        {
          const Eigen::VectorXd v =
            Z.col(j).cwiseProduct(Eigen::Map<const Eigen::VectorXd>(motion.units.data(), Z.rows()));
          op.momenta(v.data(), P.col(j).data());
        }
      const PivotedQr qr(P, 1e-12);
      return qr.leading(qr.rank());
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
      if (m == 0)
        return {};
      const Eigen::MatrixXd P    = momenta_of(motion, op, Z);
      const unsigned int    size = m + P.cols();
      Eigen::MatrixXd       A(size, size);
      Eigen::VectorXd       z(2 * n), image(2 * n);
      for (unsigned int j = 0; j < size; ++j)
        {
          z.setZero();
          if (j < m)
            z.head(n) = Z.col(j);
          else
            z.tail(n) = P.col(j - m);
          op.apply(z.data(), image.data());
          A.col(j) << Z.transpose() * image.head(n), P.transpose() * image.tail(n);
        }
      const EigenSystem eigen = general_eigen(A);
      // what has no mass is twice defective at zero: its eigenvalues are there to the root of round-off
      const double           zero = 1e-9 * eigen.values.cwiseAbs().maxCoeff();
      std::vector<EigenPair> pairs;
      for (unsigned int i = 0; i < size; ++i)
        if (std::abs(eigen.values(i)) > zero)
          pairs.push_back(
            {op.shift() + 1. / eigen.values(i), op.zeta(Z.cast<Complex>() * eigen.vectors.col(i).head(m))});
      // Free motions are there twice at zero, all at the same place: computed eigenvectors need not span them.
      if (op.shift() != 0.)
        {
          // λ = 0 is ν = −1/σ: vectors of the kernel of A + I/σ
          const Eigen::MatrixXd kernel = FullLu(A + Eigen::MatrixXd::Identity(size, size) / op.shift(), 1e-10).kernel();
          for (int k = 0; k < kernel.cols(); ++k)
            pairs.push_back({0., op.zeta(Z.cast<Complex>() * kernel.col(k).head(m).cast<Complex>())});
        }
      return pairs;
    }



    /** Leading eigenvalues of a basis. */
    struct Leading
    {
      std::vector<unsigned int> converged; ///< their residuals are near round-off; a complex pair is never parted
      unsigned int n_converging = 0, n_stray = 0; ///< others before the last of them: residuals below and above 1e-4
    };

    /** The first @p wanted that have converged, or all that are not far below the largest one. */
    Leading
    leading(const Arnoldi &arnoldi, const unsigned int wanted, const double smallest)
    {
      Leading result;
      int     balance = 0;
      for (unsigned int i = 0; i < arnoldi.size() && (result.converged.size() < wanted || balance != 0); ++i)
        {
          const Complex nu = arnoldi.values[i];
          if (std::abs(nu) < smallest * std::abs(arnoldi.values[0]))
            break;
          if (arnoldi.residuals[i] < 1e-11 * std::abs(nu) + 1e-14 * std::abs(arnoldi.values[0]))
            {
              result.converged.push_back(i);
              balance += nu.imag() > 0 ? 1 : (nu.imag() < 0 ? -1 : 0);
            }
          else
            ++(arnoldi.residuals[i] < 1e-4 * std::abs(nu) ? result.n_converging : result.n_stray);
        }
      return result;
    }



    std::vector<EigenPair>
    pairs_of(const ShiftInvert &op, const Arnoldi &arnoldi, const std::vector<unsigned int> &which)
    {
      std::vector<EigenPair> pairs;
      for (const unsigned int i : which)
        pairs.push_back({op.shift() + 1. / arnoldi.values[i], op.zeta(arnoldi.vector(i))});
      return pairs;
    }



    /**
     * The eigenvalues that a basis of at most @p largest_basis vectors finds; nothing if they do not converge. What
     * infinite eigenvalues leave in round-off has a few Ritz values, anywhere, that never converge: they may stand
     * aside when all else stays as it is from one round to the next.
     */
    std::vector<EigenPair>
    krylov_pairs(const ShiftInvert &op,
                 const unsigned int wanted,
                 const unsigned int largest_basis,
                 const unsigned int block)
    {
      Arnoldi arnoldi([&](const double *x, double *y) { op.apply(x, y); }, op.size(), block);
      double  smallest_before = 0, smallest_checked = 0;
      for (unsigned int m = 2 * wanted + 16; m <= largest_basis; m += wanted / 2 + 12)
        {
          op.tell("basis of " + std::to_string(m) + " vectors, at most " + std::to_string(largest_basis) + ", for " +
                  std::to_string(wanted) + " eigenvalues");
          arnoldi.expand(m);
          const Leading found = leading(arnoldi, wanted, 0.);
          if (found.converged.size() < wanted || found.n_converging > 0 || found.n_stray > 4)
            continue;
          const auto   equal    = [](const double a, const double b) { return std::abs(a - b) < 1e-6 * a; };
          const double smallest = std::abs(arnoldi.values[found.converged.back()]);
          const bool   is_still = equal(smallest, smallest_before);
          smallest_before       = smallest;
          if (found.n_stray > 0 && !is_still)
            continue;
          if (equal(smallest, smallest_checked) || arnoldi.largest_missed(12) <= smallest)
            return pairs_of(op, arnoldi, found.converged);
          smallest_checked = smallest;
          arnoldi.widen();
        }
      // where few unknowns have mass the rest may be infinite eigenvalues, far below the largest one
      const Leading found = leading(arnoldi, wanted, 1e-6);
      if (found.n_converging == 0 && found.n_stray == 0)
        return pairs_of(op, arnoldi, found.converged);
      return {};
    }



    /** Equal parts, such as blades, have each eigenvalue many times: what narrow blocks do not find wider ones do. */
    std::vector<EigenPair>
    krylov_pairs(const ShiftInvert &op, const unsigned int wanted)
    {
      for (const unsigned int block : {2, 4, 6, 12})
        {
          const unsigned int most  = std::min(op.size() - 4 * block, (block == 12 ? 8 : 4) * wanted + 100);
          const auto         pairs = krylov_pairs(op, wanted, most, block);
          if (!pairs.empty())
            return pairs;
        }
      throw NotConverged(
        "the Arnoldi iteration did not find all modes; ask for fewer or more, or move the <Shift> nearer "
        "to them");
    }



    /** Modes of lowest frequency of an undamped motion; those of another are nothing. */
    std::vector<EigenPair>
    undamped_pairs(const ShiftInvert &op, const unsigned int n_modes)
    {
      std::vector<EigenPair> pairs;
      if (op.is_undamped())
        if (const auto modes = undamped_modes(op, n_modes))
          for (const auto &mode : *modes)
            pairs.push_back({Complex(0., std::sqrt(std::abs(mode.square))), mode.zeta.cast<Complex>(), mode.judgement});
      return pairs;
    }



    /** How many constraints there are: rows of multipliers that hold something. Redundant ones are left out before. */
    unsigned int
    n_constraints(const LinearMotion &motion)
    {
      const Pattern &p = *motion.S.pattern;
      unsigned int   n = 0;
      for (int j = motion.n_kinematic; j < p.size(); ++j)
        for (int k = p.column_start[j]; k < p.column_start[j + 1]; ++k)
          if (p.rows[k] < static_cast<int>(motion.n_kinematic) && motion.S.values[k] != 0.)
            {
              ++n;
              break;
            }
      return n;
    }



    /**
     * No more eigenvalues are finite than two for each unknown with mass and, if nothing is viscous, one for each of
     * the others whose rate counts: states of first order; and none than two for each motion that constraints leave.
     */
    unsigned int
    most_eigenvalues(const LinearMotion &motion)
    {
      const bool   is_viscous = motion.strains.is_viscous();
      unsigned int n          = 0;
      for (unsigned int i = 0; i < motion.n_kinematic; ++i)
        {
          const int k = motion.M.pattern->position(i, i);
          if (is_viscous || (k >= 0 && motion.M.values[k] != 0.))
            n += 2;
          else if (k >= 0 && motion.gyroscopic.values[k] != 0.)
            n += 1;
        }
      return std::min(n, 2 * (motion.n_kinematic - std::min(motion.n_kinematic, n_constraints(motion))));
    }



    /**
     * How far a shape, in the motion's units, is from one that any forces of its own leave where it is: with ζ̇ = 0 one
     * application gives −ζ/σ of it. An aircraft that drifts sideways does so because it has yawed: yaw, which its fin
     * resists, is no free motion, and drift, which is there twice at λ = 0, brings it along.
     */
    double
    departure_from_rest(const ShiftInvert &op, const Eigen::VectorXd &shape)
    {
      Eigen::VectorXd z = Eigen::VectorXd::Zero(op.size()), result = z;
      z.head(shape.size()) = shape;
      op.apply(z.data(), result.data());
      return (op.shift() * result + z).norm() / z.norm();
    }



    /**
     * One real shape for each independent motion among those that are there twice at λ = 0. Round-off moves these
     * eigenvalues apart, and their shapes near each other: of one motion the others may hold 1e-5 only. What is as
     * little is a motion if nothing is strained in it, and nothing resists it.
     */
    void
    add_free_motions(const std::vector<Eigen::VectorXcd> &shapes,
                     const LinearMotion                  &motion,
                     const ShiftInvert                   &op,
                     const double                         frequency,
                     std::vector<Mode>                   &modes)
    {
      constexpr double surely_independent = 1e-4, round_off = 1e-10, low = 1e-4, at_rest = 1e-3;
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
      const PivotedQr       qr(all, round_off);
      const Eigen::MatrixXd Q = qr.leading(qr.rank());
      for (int i = 0; i < Q.cols(); ++i)
        {
          const Eigen::VectorXcd shape = Q.col(i).cwiseProduct(units).normalized().cast<Complex>();
          if (qr.pivot(i) <= surely_independent * qr.pivot(0))
            {
              const auto judgement = op.judge(0., shape);
              if (!(judgement.work <= low * frequency * low * frequency * judgement.mass) ||
                  departure_from_rest(op, Q.col(i)) > at_rest)
                continue;
            }
          modes.push_back({0., shape, 0.});
        }
    }



    double
    distance_to_nearest(const EigenPair &pair, const std::vector<EigenPair> &pairs)
    {
      double distance = std::numeric_limits<double>::infinity();
      for (const auto &other : pairs)
        if (&other != &pair)
          distance = std::min(distance, std::abs(other.lambda - pair.lambda));
      return distance;
    }



    /**
     * A real eigenvalue that is there several times comes out of round-off as pairs whose imaginary part is nothing.
     * Each of the two is a mode of its own then: their vectors u ± i v span the plane of u and v.
     */
    EigenPair
    real_one_of(const EigenPair &pair)
    {
      constexpr double round_off = 1e-10;
      if (pair.lambda.imag() == 0 || std::abs(pair.lambda.imag()) > round_off * std::abs(pair.lambda.real()))
        return pair;
      // of pairs that are real to its own round-off Eigen gives u and v as vectors
      const Eigen::VectorXd u = pair.zeta.real(), v = pair.zeta.imag();
      const bool            is_first = pair.lambda.imag() > 0 || !(v.norm() > round_off * u.norm());
      return {pair.lambda.real(), (is_first ? u : v).cast<Complex>(), pair.judgement};
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
      for (const auto &one : pairs)
        {
          op.tell("error of eigenvalue " + std::to_string(&one - pairs.data() + 1) + " of " +
                  std::to_string(pairs.size()));
          const EigenPair pair = real_one_of(one);
          if (pair.lambda.imag() < 0)
            continue; // its conjugate stands for both
          const auto judgement =
            pair.judgement ? *pair.judgement : op.judge(pair.lambda, pair.zeta, distance_to_nearest(one, pairs));
          const double size = std::abs(pair.lambda);
          if (size < 3e-8 * frequency ||
              (size < 1e-5 * frequency && size * size * judgement.mass <= 100 * judgement.lost))
            free.push_back(pair.zeta);
          else if (!(judgement.error > 1e-2 * size && size * size * judgement.mass < 0.1 * judgement.work))
            modes.found.push_back({pair.lambda, pair.zeta.normalized(), judgement.error / size});
        }
      add_free_motions(free, motion, op, frequency, modes.found);
      std::stable_sort(modes.found.begin(), modes.found.end(), [](const Mode &a, const Mode &b) {
        return std::abs(a.lambda) < std::abs(b.lambda);
      });
      return modes;
    }
  } // namespace



  namespace
  {
    /** Unknowns up to which all modes are found where Krylov's space fails: a second. */
    constexpr unsigned int most_for_dense = 400;

    /** Estimated errors, relative, beyond which a mode is none. */
    constexpr double lost_in_round_off = 1e-2;



    Modes
    modes_near_shift(const LinearMotion &motion,
                     const ShiftInvert  &op,
                     const unsigned int  n_modes,
                     const double        frequency)
    {
      const unsigned int n = motion.n_kinematic, most = most_eigenvalues(motion), wanted = std::min(2 * n_modes, most);
      // where the Krylov space would be most of the space anyway, dense matrices are simpler and complete
      const auto dense = [&]() { return select(dense_pairs(motion, op), motion, op, frequency); };
      if (n <= std::max(2 * wanted, 60u) || (wanted == most && n <= most_for_dense))
        return dense();
      // what cannot be found there may not be there: more is asked for than constraints leave
      const bool can_be_dense = n <= most_for_dense;
      try
        {
          auto pairs = undamped_pairs(op, std::min(n_modes, (most + 1) / 2));
          if (pairs.empty())
            pairs = krylov_pairs(op, wanted);
          const Modes modes = select(pairs, motion, op, frequency);
          const bool  lost  = std::any_of(modes.found.begin(), modes.found.end(), [](const Mode &mode) {
            return mode.error > lost_in_round_off;
          });
          if (!lost || !can_be_dense)
            return modes;
        }
      catch (const NotConverged &)
        {
          if (!can_be_dense)
            throw;
        }
      return dense();
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
  find_modes(const LinearMotion         &motion,
             const unsigned int          n_modes,
             const std::optional<double> shift,
             const TellProgress         &tell)
  {
    ShiftInvert  op(motion, tell);
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



  void
  find_left_vectors(const LinearMotion &motion, std::vector<Mode> &modes)
  {
    ShiftInvert op(motion);
    if (modes.empty() || op.has_conjugate_left_vectors())
      return;
    set_by_lowest_frequency(motion, op, {});
    for (Mode &mode : modes)
      if (!mode.is_free())
        mode.left = op.left_vector_of(mode.lambda, mode.shape);
  }
} // namespace samara
