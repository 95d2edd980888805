#include <samara/base/dense.h>
#include <samara/base/interrupt.h>
#include <samara/solvers/undamped.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace samara
{
  BlockLanczos::BlockLanczos(const ShiftInvert &op, const unsigned int block)
    : op(op)
    , n(op.size() / 2)
    , block(block)
    , H(0, 0)
    , E(block, 0)
    , generator(block)
  {}



  /** Columns (K + σ²M)⁻¹ (M x). */
  Eigen::MatrixXd
  BlockLanczos::apply(const Eigen::Ref<const Eigen::MatrixXd> &Mx) const
  {
    throw_if_interrupted();
    Eigen::MatrixXd b = Eigen::MatrixXd::Zero(op.mixed().n_condensed(), Mx.cols());
    b.topRows(n)      = Mx;
    op.mixed().solve_condensed(b.data(), b.cols());
    return b.topRows(n);
  }



  void
  BlockLanczos::reserve(const unsigned int columns)
  {
    if (V.cols() >= static_cast<int>(columns))
      return;
    const int enough = std::max<int>(columns + block, 3 * V.cols() / 2);
    V.conservativeResize(n, enough);
    MV.conservativeResize(n, enough);
  }



  double
  BlockLanczos::normalize(const unsigned int          column,
                          Eigen::VectorXd             x,
                          const double                before,
                          Eigen::Ref<Eigen::VectorXd> coefficients)
  {
    // what is new in it may be little: then it is made orthogonal to the rest of the basis once more
    Eigen::VectorXd Mx;
    double          norm = 0;
    for (unsigned int pass = 0; pass < 3; ++pass)
      {
        Mx                         = op.mass_times(x);
        norm                       = std::sqrt(std::max(0., x.dot(Mx)));
        const unsigned int    from = norm < 1e-2 * before ? 0 : m;
        const Eigen::VectorXd c    = MV.middleCols(from, column - from).transpose() * x;
        if (pass > 0 && c.norm() <= 1e-15 * norm)
          break;
        x.noalias() -= V.middleCols(from, column - from) * c;
        coefficients.segment(from, column - from) += c;
      }
    Mx   = op.mass_times(x);
    norm = std::sqrt(std::max(0., x.dot(Mx)));
    if (!(norm > 1e-14 * before))
      return 0;
    V.col(column)  = x / norm;
    MV.col(column) = Mx / norm;
    return norm;
  }



  // Two applications leave nothing of what has no mass.
  bool
  BlockLanczos::add_random(const unsigned int column)
  {
    std::uniform_real_distribution<double> number(-1., 1.);
    for (unsigned int trial = 0; trial < 3; ++trial)
      {
        Eigen::MatrixXd x(n, 1);
        for (unsigned int i = 0; i < n; ++i)
          x(i, 0) = number(generator);
        for (unsigned int i = 0; i < 2; ++i)
          {
            x = apply(op.mass_times(x.col(0)));
            x /= std::max(x.norm(), std::numeric_limits<double>::min());
          }
        const double before = std::sqrt(std::max(0., x.col(0).dot(op.mass_times(x.col(0)))));
        for (unsigned int pass = 0; pass < 2; ++pass)
          x -= V.leftCols(column) * (MV.leftCols(column).transpose() * x);
        Eigen::VectorXd unused = Eigen::VectorXd::Zero(column);
        if (before > 0 && normalize(column, x.col(0), before, unused) > 1e-8 * before)
          return true;
      }
    return false;
  }



  bool
  BlockLanczos::add_block()
  {
    reserve(m + 2 * block);
    if (m == 0)
      for (unsigned int j = 0; j < block; ++j)
        if (!add_random(j))
          return false;
    const unsigned int old = m, next = m + block;
    Eigen::MatrixXd    larger = Eigen::MatrixXd::Zero(next, next), images = apply(MV.middleCols(m, block));
    larger.topLeftCorner(m, m)        = H;
    larger.bottomLeftCorner(block, m) = E;
    E                                 = Eigen::MatrixXd::Zero(block, next);
    m                                 = next;
    std::vector<double> before(block);
    for (unsigned int j = 0; j < block; ++j)
      before[j] = std::sqrt(std::max(0., images.col(j).dot(op.mass_times(images.col(j)))));
    for (unsigned int pass = 0; pass < 2; ++pass)
      {
        const Eigen::MatrixXd c = MV.leftCols(next).transpose() * images;
        images.noalias() -= V.leftCols(next) * c;
        larger.middleCols(old, block) += c;
      }
    for (unsigned int j = 0; j < block; ++j)
      {
        Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(next + j);
        E(j, old + j)                = normalize(next + j, images.col(j), before[j], coefficients);
        larger.col(old + j) += coefficients.head(next);
        E.col(old + j).head(j) = coefficients.tail(j);
        if (E(j, old + j) == 0. && !add_random(next + j))
          return false;
      }
    H = larger;
    return true;
  }



  bool
  BlockLanczos::expand(const unsigned int size)
  {
    while (m < size)
      if (!add_block())
        return false;
    solve_small();
    return true;
  }



  bool
  BlockLanczos::widen()
  {
    ++block;
    E.conservativeResize(block, Eigen::NoChange);
    E.bottomRows(1).setZero();
    reserve(m + 2 * block);
    return add_random(m + block - 1);
  }



  void
  BlockLanczos::solve_small()
  {
    const HermitianEigen<double> eigen = symmetric_eigen(0.5 * (H + H.transpose()));
    std::vector<unsigned int>    order(m);
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](const unsigned int a, const unsigned int b) {
      return std::abs(eigen.values(a)) > std::abs(eigen.values(b));
    });
    values.clear();
    residuals.clear();
    small_vectors.resize(m, m);
    for (unsigned int i = 0; i < m; ++i)
      {
        values.push_back(eigen.values(order[i]));
        small_vectors.col(i) = eigen.vectors.col(order[i]);
        residuals.push_back((E * small_vectors.col(i)).norm());
      }
  }



  Eigen::MatrixXd
  BlockLanczos::vectors(const unsigned int n_vectors) const
  {
    return V.leftCols(m) * small_vectors.leftCols(n_vectors);
  }



  namespace
  {
    constexpr unsigned int of_columns = 4; ///< that are solved for together

    /** Modes in the space of refined solutions of some vectors, smallest ω² first. */
    struct RefinedModes
    {
      Eigen::MatrixXd x; ///< (ζ, μ, s) of (K + σ²M) ζ = (ω² + σ²) M ζ
      Eigen::VectorXd squares;

      RefinedModes(const ShiftInvert &op, const Eigen::MatrixXd &V)
      {
        const unsigned int n = V.rows(), m = V.cols();
        Eigen::MatrixXd    MV(n, m), MX(n, m);
        x = Eigen::MatrixXd::Zero(op.mixed().size(), m);
        for (unsigned int j = 0; j < m; ++j)
          x.col(j).head(n) = MV.col(j) = op.mass_times(V.col(j));
        for (unsigned int j = 0; j < m; j += of_columns)
          op.mixed().solve(x.col(j).data(), std::min(of_columns, m - j));
        for (unsigned int j = 0; j < m; ++j)
          MX.col(j) = op.mass_times(x.col(j).head(n));
        const Eigen::MatrixXd K = x.topRows(n).transpose() * MV, M = x.topRows(n).transpose() * MX;
        // M is turned by its scale and K by M's Cholesky factor: vectors of modes far apart differ much in size
        const Eigen::VectorXd        d     = M.diagonal().cwiseSqrt().cwiseInverse();
        const Eigen::MatrixXd        D     = d.asDiagonal();
        const HermitianEigen<double> eigen = symmetric_eigen(0.5 * D * (K + K.transpose()) * D, D * M * D);
        squares                            = eigen.values.array() - op.shift() * op.shift();
        x                                  = x * (D * eigen.vectors);
      }
    };



    /** The first modes, each with what ShiftInvert::judge() says of it. */
    std::vector<UndampedMode>
    judged(const ShiftInvert &op, const RefinedModes &modes, const unsigned int n_modes)
    {
      const unsigned int        n = op.size() / 2, size = op.mixed().size();
      std::vector<UndampedMode> result;
      Eigen::MatrixXd           r(size, of_columns);
      for (unsigned int first = 0; first < n_modes; first += of_columns)
        {
          const unsigned int columns = std::min(of_columns, n_modes - first);
          op.mixed().multiply(modes.x.col(first).data(), r.data(), columns);
          for (unsigned int c = 0; c < columns; ++c)
            {
              const double          square = modes.squares(first + c);
              const auto            x      = modes.x.col(first + c);
              const Eigen::VectorXd zeta = x.head(n), Mz = op.mass_times(zeta);
              r.col(c).head(n) -= (square + op.shift() * op.shift()) * Mz;
              ShiftInvert::Judgement j{0,
                                       zeta.dot(Mz),
                                       x.cwiseAbs().dot(r.col(c).cwiseAbs()),
                                       op.mixed().work(x.data())};
              j.error = j.lost / (2 * std::sqrt(std::abs(square)) * j.mass);
              result.push_back({square, zeta, j});
            }
        }
      return result;
    }



    /** How many Ritz values, @p wanted or more, have converged and stand apart from the next; 0 if too few have. */
    unsigned int
    converged_and_apart(const BlockLanczos &lanczos, const unsigned int wanted)
    {
      constexpr double small = 1e-10, apart = 1e-5;
      for (unsigned int i = 0; i + 1 < lanczos.size(); ++i)
        {
          const double theta = lanczos.values[i];
          if (!(lanczos.residuals[i] <= small * theta + 1e-14 * lanczos.values[0]) || theta <= 0)
            return 0;
          if (i + 1 >= wanted && lanczos.values[i + 1] < (1 - apart) * theta)
            return i + 1;
        }
      return 0;
    }



    /** Behind the first @p n eigenvalues, before the next. */
    double
    square_behind(const BlockLanczos &lanczos, const unsigned int n, const double sigma)
    {
      const double last = 1 / lanczos.values[n - 1], next = 1 / lanczos.values[n];
      return last + std::min(0.1 * (next - last), 1e-3 * last) - sigma * sigma;
    }



    /** Whether any motion grows, which has two real eigenvalues, or is known too badly. */
    bool
    is_doubtful(const std::vector<UndampedMode> &modes, const double sigma)
    {
      return std::any_of(modes.begin(), modes.end(), [&](const UndampedMode &mode) {
        const double size = std::sqrt(std::abs(mode.square));
        const bool   is_free =
          std::abs(mode.square) * mode.judgement.mass <= 100 * mode.judgement.lost && size < 1e-3 * sigma;
        return !is_free && (mode.square < 0 || !(mode.judgement.error <= 1e-9 * size));
      });
    }
  } // namespace



  std::optional<std::vector<UndampedMode>>
  undamped_modes(const ShiftInvert &op, const unsigned int wanted)
  {
    constexpr unsigned int beside = 4; ///< vectors beside those that are wanted, which make these better
    BlockLanczos           lanczos(op, of_columns);
    const unsigned int     most = std::min(op.size() / 4, 6 * wanted + 100);
    for (unsigned int m = 2 * wanted + 20, looks = 0; m <= most; m += wanted / 2 + 8)
      {
        op.tell("basis of " + std::to_string(m) + " vectors, at most " + std::to_string(most) + ", for " +
                std::to_string(wanted) + " modes");
        if (!lanczos.expand(m))
          return std::nullopt;
        const unsigned int n = converged_and_apart(lanczos, wanted);
        if (n == 0)
          continue;
        op.tell("count of the modes below the last of " + std::to_string(n));
        const auto count = op.mixed().n_squares_below(square_behind(lanczos, n, op.shift()));
        if (!count || *count < n || looks == 3)
          return std::nullopt;
        if (*count > n)
          {
            ++looks;
            if (!lanczos.widen())
              return std::nullopt;
            continue;
          }
        op.tell("refinement of " + std::to_string(n) + " modes");
        RefinedModes refined(op, lanczos.vectors(std::min(n + beside, lanczos.size())));
        auto         modes = judged(op, refined, n);
        if (is_doubtful(modes, op.shift()))
          {
            refined = RefinedModes(op, refined.x.topRows(op.size() / 2));
            modes   = judged(op, refined, n);
          }
        return is_doubtful(modes, op.shift()) ? std::nullopt : std::make_optional(std::move(modes));
      }
    return std::nullopt;
  }
} // namespace samara
