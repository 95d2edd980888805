#include <samara/analysis/analysis.h>
#include <samara/analysis/negative_directions.h>
#include <samara/base/dense.h>
#include <samara/base/text.h>
#include <samara/solvers/equilibrate.h>
#include <samara/solvers/inertia.h>
#include <samara/solvers/linear.h>
#include <samara/solvers/newton.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <map>

namespace samara
{
  namespace
  {
    /** Beyond so many unknowns a factorisation of its own would be noticed. */
    constexpr int large_model = 20000;
    /** The stiffness of free motions is zero but for round-off, of which this much of the largest one is far above [1].
     */
    constexpr double lift = 1e-14;
    /** Of a direction's energies, without their signs: what is left of them is meant, not round-off [1]. */
    constexpr double meant = 1e-9;
    /** A tangent is symmetric if its geometric part differs no more from its transpose, relative to the largest entry
     * of that and to the largest stiffness [1]. */
    constexpr double symmetric = 1e-6, round_off_of_pivots = 1e-12;
    /** Directions that are looked at one by one. */
    constexpr int most_vectors = 24;



    /** The tangent K at a state, and what is measured with it: D, in parts of the model's size and rad. */
    class Tangent
    {
    public:
      Tangent(const System &system, const State &state);

      bool is_symmetric() const;

      /** How many negative eigenvalues K + shift κ D has among motions that obey the constraints, κ = max K_ii/D_ii. */
      std::optional<int> n_negative(double shift) const;
      /** The sign of det K among motions that obey the constraints; 0 if it is nearly singular. */
      int sign_of_determinant() const;

      /** The most negative of the directions of negative energy comes first. */
      Eigen::MatrixXd search(double shift, int n_vectors) const;

    private:
      const System       &system;
      const State        &state;
      const int           n, m;
      SparseMatrix        K;
      Eigen::VectorXd     D;
      double              kappa = 0;
      std::vector<double> scale;

      SparseMatrix    scaled(double shift) const;
      void            solve(const LinearSolver &solver, Eigen::MatrixXd &X) const;
      Eigen::MatrixXd orthonormal(const Eigen::MatrixXd &X) const;
    };



    /** Energies of directions by strains and geometric stiffness, which keep the digits of soft ones. */
    class Energies
    {
    public:
      Energies(const System &system, const State &state)
        : n(system.layout.n_kinematic())
        , geometric(system.layout.pattern)
        , strains(system.strain_rows(state))
      {
        system.tangent(state, geometric, false);
      }

      /** Combinations of orthonormal directions @p X whose energy is negative, as far as is meant, lowest first. */
      Eigen::MatrixXd negative_ones(const Eigen::MatrixXd &X) const;

    private:
      const int    n;
      SparseMatrix geometric;
      StrainRows   strains;

      /** Xᵀ K X, and the sums of its diagonal's parts without signs. */
      void add(const Eigen::MatrixXd &X, Eigen::MatrixXd &E, Eigen::VectorXd &sizes) const;
    };



    Tangent::Tangent(const System &system, const State &state)
      : system(system)
      , state(state)
      , n(system.layout.n_kinematic())
      , m(system.layout.n_multipliers)
      , K(system.layout.pattern)
      , D(n)
    {
      system.tangent(state, K);
      scale               = equilibrating_factors(K, 6);
      const double length = model_length(system.model);
      for (int i = 0; i < n; ++i)
        {
          D(i)        = system.layout.is_length(i) ? 1. / (length * length) : 1.;
          const int k = K.pattern->position(i, i);
          kappa       = std::max(kappa, k < 0 ? 0. : std::abs(K.values[k]) / D(i));
        }
    }



    bool
    Tangent::is_symmetric() const
    {
      // material is symmetric; what is not, such as a load that follows, may be small beside it
      SparseMatrix geometric(system.layout.pattern);
      system.tangent(state, geometric, false);
      const Pattern &pattern = *K.pattern;
      double         largest = 0, difference = 0;
      for (int j = 0; j < n; ++j)
        for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
          if (const int i = pattern.rows[k]; i < j)
            {
              const double a = geometric.values[k], b = geometric.values[pattern.position(j, i)];
              const double size = std::sqrt(D(i) * D(j));
              largest           = std::max({largest, std::abs(a) / size, std::abs(b) / size});
              difference        = std::max(difference, std::abs(a - b) / size);
            }
      return difference <= symmetric * largest + round_off_of_pivots * kappa;
    }



    SparseMatrix
    Tangent::scaled(const double shift) const
    {
      const Pattern &pattern = *K.pattern;
      SparseMatrix   A       = K;
      for (int i = 0; i < n; ++i)
        A.values[pattern.position(i, i)] += shift * kappa * D(i);
      for (int j = 0; j < pattern.size(); ++j)
        for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
          A.values[k] *= scale[pattern.rows[k]] * scale[j];
      return A;
    }



    std::optional<int>
    Tangent::n_negative(const double shift) const
    {
      const auto n_all = n_negative_eigenvalues(*K.pattern, scaled(shift).values);
      return n_all ? std::optional<int>(*n_all - (m - int(state.left_out.size()))) : std::nullopt;
    }



    int
    Tangent::sign_of_determinant() const
    {
      const auto solver = make_solver(K.pattern);
      try
        {
          solver->factorize(scaled(0.));
        }
      catch (const SingularMatrix &)
        {
          return 0;
        }
      if (!(solver->reciprocal_condition() > 1e-13))
        return 0;
      return (m - state.left_out.size()) % 2 == 0 ? solver->determinant_sign() : -solver->determinant_sign();
    }



    void
    Energies::add(const Eigen::MatrixXd &X, Eigen::MatrixXd &E, Eigen::VectorXd &sizes) const
    {
      const Pattern &pattern = *geometric.pattern;
      for (int j = 0; j < n; ++j)
        for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
          if (const int i = pattern.rows[k]; i < n && geometric.values[k] != 0.)
            {
              E += geometric.values[k] * X.row(i).transpose() * X.row(j);
              sizes += (geometric.values[k] * X.row(i).cwiseProduct(X.row(j))).cwiseAbs().transpose();
            }
      for (const auto &point : strains.points)
        {
          Eigen::MatrixXd e(point.size, X.cols());
          for (unsigned int i = 0; i < point.size; ++i)
            for (int c = 0; c < X.cols(); ++c)
              e(i, c) = strains.B.row_times(point.first_row + i, X.col(c).data());
          const Eigen::MatrixXd Ce = point.weight * strains.C(point) * e;
          E += e.transpose() * Ce;
          sizes += e.cwiseProduct(Ce).cwiseAbs().colwise().sum().transpose();
        }
    }



    Eigen::MatrixXd
    Energies::negative_ones(const Eigen::MatrixXd &X) const
    {
      const auto      p = X.cols();
      Eigen::MatrixXd E = Eigen::MatrixXd::Zero(p, p), of_each = E;
      Eigen::VectorXd sizes = Eigen::VectorXd::Zero(p);
      add(X, E, sizes);
      const Eigen::MatrixXd Z = X * symmetric_eigen(0.5 * (E + E.transpose())).vectors;
      sizes.setZero();
      add(Z, of_each, sizes);
      std::vector<int> negative;
      for (int c = 0; c < p; ++c)
        if (of_each(c, c) < -meant * sizes(c))
          negative.push_back(c);
      return Z(Eigen::all, negative);
    }



    /** The displacements that the forces D X bring, which obey the constraints. */
    void
    Tangent::solve(const LinearSolver &solver, Eigen::MatrixXd &X) const
    {
      std::vector<double> b(n + m);
      for (int c = 0; c < X.cols(); ++c)
        {
          std::fill(b.begin(), b.end(), 0.);
          for (int i = 0; i < n; ++i)
            b[i] = D(i) * X(i, c) * scale[i];
          solver.solve(b.data());
          for (int i = 0; i < n; ++i)
            X(i, c) = b[i] * scale[i];
        }
    }



    /** A basis of these vectors, as many as there are apart from round-off. */
    Eigen::MatrixXd
    Tangent::orthonormal(const Eigen::MatrixXd &X) const
    {
      const Eigen::MatrixXd        unit = X * X.colwise().norm().cwiseInverse().asDiagonal();
      const HermitianEigen<double> gram = symmetric_eigen(unit.transpose() * D.asDiagonal() * unit);
      std::vector<int>             kept;
      for (int c = 0; c < X.cols(); ++c)
        if (gram.values(c) > 1e-10 * gram.values(X.cols() - 1))
          kept.push_back(c);
      return unit * gram.vectors(Eigen::all, kept) * gram.values(kept).cwiseSqrt().cwiseInverse().asDiagonal();
    }



    Eigen::MatrixXd
    Tangent::search(const double shift, const int n_vectors) const
    {
      Eigen::MatrixXd X      = Eigen::MatrixXd::NullaryExpr(n, n_vectors, [](const auto i, const auto j) {
        return std::sin(1. + 1.3 * i + 2.1 * j * i + 0.7 * j);
      });
      const auto      solver = make_solver(K.pattern);
      solver->factorize(scaled(shift));
      for (unsigned int iteration = 0; iteration < 20; ++iteration)
        {
          solve(*solver, X);
          X = orthonormal(X);
        }
      return Energies(system, state).negative_ones(X);
    }



    /** @p suspected by the pivots; what of it is there goes into the result. */
    void
    find_directions(const System &system, const Tangent &tangent, const int suspected, NegativeDirections &result)
    {
      double shift = 1e-12;
      for (std::optional<int> left = suspected; left && *left > 0 && shift < 1e3; shift *= 10)
        left = tangent.n_negative(shift);
      const int vectors = std::min({suspected + 6, most_vectors, system.layout.n_kinematic()});
      // about a shift below all of them the stiffest are found, about zero the softest
      for (const double about : {shift, lift})
        {
          const Eigen::MatrixXd found = tangent.search(about, vectors);
          if (found.cols() > 0 && result.number == 0)
            result.worst = found.col(0);
          result.number = std::max<unsigned int>(result.number, found.cols());
          if (int(result.number) >= suspected)
            break;
        }
      result.is_least = result.number > 0 && int(result.number) < suspected;
    }



    /** Whether all that turns has one spin, and nothing that carries mass is at rest beside it. */
    NegativeDirections::Turning
    turning_of(const System &system, const State &state)
    {
      const auto spin = [&](const unsigned int node) -> Vector3 {
        return state.triad(node) * Eigen::Map<const Vector6>(&state.y[6 * node]).tail<3>();
      };
      Vector3 fastest = Vector3::Zero();
      for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
        if (spin(node).norm() > fastest.norm())
          fastest = spin(node);
      if (fastest.isZero(0.))
        return NegativeDirections::Turning::none;
      for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
        if ((spin(node) - fastest).norm() > 1e-9 * fastest.norm())
          return NegativeDirections::Turning::in_parts;
      return NegativeDirections::Turning::as_one;
    }
  } // namespace



  NegativeDirections
  negative_directions(const System &system, const State &state, const LinearSolver *large)
  {
    NegativeDirections result;
    const Layout      &layout = system.layout;
    if (system.size() == 0 || layout.n_states > 0 || !layout.nonholonomic.empty())
      return result;
    const int n_rows = layout.n_multipliers - state.left_out.size();
    if (system.size() > large_model && (!large || large->n_negative().value_or(n_rows) == n_rows))
      return result;
    result.turning = turning_of(system, state);
    if (result.turning == NegativeDirections::Turning::in_parts)
      return result;
    const Tangent tangent(system, state);
    if (!tangent.is_symmetric())
      {
        result.is_odd_only = tangent.sign_of_determinant() < 0;
        result.number      = result.is_odd_only ? 1 : 0;
        return result;
      }
    if (const auto suspected = tangent.n_negative(lift); suspected && *suspected > 0)
      find_directions(system, tangent, *suspected, result);
    return result;
  }



  std::vector<std::pair<double, std::string>>
  largest_first(const std::map<std::string, double> &shares)
  {
    std::vector<std::pair<double, std::string>> sorted;
    for (const auto &[name, share] : shares)
      sorted.emplace_back(share, name);
    std::sort(sorted.rbegin(), sorted.rend());
    return sorted;
  }



  std::string
  what_moves(const System &system, const Eigen::VectorXd &z)
  {
    const double                  length = model_length(system.model);
    std::map<std::string, double> share;
    double                        whole = 0, most = 0;
    int                           unknown = 0;
    const auto                    look    = [&](const int i, const std::string &name) {
      const double move = z(i) / system.layout.scale_of(i, length);
      share[name] += move * move;
      whole += move * move;
      if (std::abs(move) > most)
        {
          most    = std::abs(move);
          unknown = i;
        }
    };
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      for (int i = 0; i < 6; ++i)
        look(system.layout.of_node(node) + i, system.model.nodes[node].name);
    const auto  sorted = largest_first(share);
    std::string text;
    for (unsigned int k = 0; k < std::min<unsigned int>(4, sorted.size()); ++k)
      if (sorted[k].first > 0.02 * whole)
        text += (text.empty() ? "<" : ", <") + sorted[k].second + ">";
    const bool is_one = text.find(',') == std::string::npos;
    return text + (is_one ? " moves, most of all " : " move, most of all ") + system.layout.name_of(unknown);
  }



  std::string
  NegativeDirections::text(const System &system) const
  {
    const bool  one    = number == 1 && !is_least;
    std::string result = are_unstable() ? "the equilibrium is unstable, what disturbs it grows: " :
                                          "the equilibrium is unstable but for gyroscopic forces: ";
    if (is_odd_only)
      return result + "the determinant of its stiffness, which is not symmetric, is negative";
    result += "its stiffness is negative in " + std::string(is_least ? "at least " : "") + std::to_string(number) +
              (one ? " direction, in which " : " directions; in the most negative one ") + what_moves(system, worst);
    return result;
  }
} // namespace samara
