#include <samara/analysis/check.h>
#include <samara/solvers/linear.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace samara
{
  namespace
  {
    /** The tangent of the reference configuration: material stiffness, constraints and what is held. */
    SparseMatrix
    reference_tangent(const System &system, const bool held)
    {
      State state  = system.reference();
      state.held   = held;
      state.factor = 0;
      SparseMatrix K(system.layout.pattern);
      system.tangent(state, K);
      return K;
    }

    /** Up to this many constraints dense elimination takes less than a second. */
    constexpr int few_constraints = 300;

    /** More free motions are not counted: the search works with as many full vectors. */
    constexpr int most_free_motions = 32;

    /**
     * Whether sparse elimination of [I Gᵀ; G 0], the columns of Gᵀ normalised, finds no small pivot: then no constraint
     * repeats others. The cost is proportional to the size, that of the dense search is cubic.
     */
    bool
    is_certainly_independent(const System &system, SparseMatrix K)
    {
      const int           n = system.layout.of_multiplier(0);
      const Pattern      &p = *K.pattern;
      std::vector<double> scale(p.size(), 0.);
      for (int j = n; j < p.size(); ++j)
        {
          for (int k = p.column_start[j]; k < p.column_start[j + 1]; ++k)
            scale[j] += p.rows[k] < n ? K.values[k] * K.values[k] : 0.;
          if (!(scale[j] > 0))
            return false;
          scale[j] = 1 / std::sqrt(scale[j]);
        }
      for (int j = 0; j < p.size(); ++j)
        for (int k = p.column_start[j]; k < p.column_start[j + 1]; ++k)
          {
            const int i = p.rows[k];
            K.values[k] = (i < n) != (j < n) ? K.values[k] * scale[std::max(i, j)] : i == j && i < n ? 1. : 0.;
          }
      try
        {
          const auto solver = make_solver(K.pattern, Library::klu);
          solver->factorize(K);
          return solver->reciprocal_condition() > 1e-8;
        }
      catch (const SingularMatrix &)
        {
          return false;
        }
    }
  } // namespace



  void
  find_redundant(const System &system, ModelCheck &check)
  {
    const int n = system.layout.of_multiplier(0), m = system.layout.n_multipliers;
    if (m == 0)
      return;
    const SparseMatrix K = reference_tangent(system, true);
    if (m > few_constraints && (is_certainly_independent(system, K) || m > 2000))
      return;
    Eigen::MatrixXd Gt = Eigen::MatrixXd::Zero(n, m);
    for (int j = 0; j < m; ++j)
      {
        const int column = system.layout.of_multiplier(j);
        for (int k = K.pattern->column_start[column]; k < K.pattern->column_start[column + 1]; ++k)
          if (K.pattern->rows[k] < n)
            Gt(K.pattern->rows[k], j) = K.values[k];
        const double norm = Gt.col(j).norm();
        if (norm > 0)
          Gt.col(j) /= norm;
      }
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(Gt);
    qr.setThreshold(1e-9);
    const int rank = qr.rank();
    if (rank == m)
      return;
    const Eigen::MatrixXd R = qr.matrixR().topRows(rank);
    const Eigen::MatrixXd combination =
      R.leftCols(rank).triangularView<Eigen::Upper>().solve(R.rightCols(m - rank));
    const auto name = [&](const int k) {
      return system.layout.multiplier_names[qr.colsPermutation().indices()(k)];
    };
    for (int k = rank; k < m; ++k)
      {
        std::string text = name(k) + " repeats what";
        for (int i = 0; i < rank; ++i)
          if (std::abs(combination(i, k - rank)) > 1e-7)
            text += (text.back() == 't' ? " " : "; ") + name(i);
        check.redundant.push_back(text + (rank > 0 ? " say" : " nothing says"));
        check.redundant_multipliers.push_back(qr.colsPermutation().indices()(k));
      }
  }



  void
  find_free_motions(const System &system, ModelCheck &check)
  {
    const Layout &layout = system.layout;
    const int     n      = layout.of_multiplier(0);
    SparseMatrix  K      = reference_tangent(system, false);
    for (const auto i : check.redundant_multipliers)
      K.values[K.pattern->position(layout.of_multiplier(i), layout.of_multiplier(i))] = 1.;
    Eigen::VectorXd D(n);
    double          largest = 0;
    for (int i = 0; i < n; ++i)
      largest = std::max(largest, std::abs(K.values[K.pattern->position(i, i)]));
    for (int i = 0; i < n; ++i)
      {
        double &diagonal = K.values[K.pattern->position(i, i)];
        D(i)             = diagonal > 1e-9 * largest ? diagonal : std::max(largest, 1.);
        diagonal += 1e-9 * D(i);
      }
    const int       m       = layout.n_multipliers;
    Eigen::VectorXd G_scale = Eigen::VectorXd::Zero(m);
    for (int j = 0; j < m; ++j)
      {
        const int column = layout.of_multiplier(j);
        for (int k = K.pattern->column_start[column]; k < K.pattern->column_start[column + 1]; ++k)
          if (K.pattern->rows[k] < n)
            G_scale(j) += K.values[k] * K.values[k] / D(K.pattern->rows[k]);
        G_scale(j) = G_scale(j) > 0 ? 1. / std::sqrt(G_scale(j)) : 0.;
      }
    const auto solver = make_solver(layout.pattern);
    solver->factorize(K);

    // inverse iteration on a block of vectors; those that strain nothing stay, all others fade or are told by their energy
    const State    state = system.reference();
    const auto     strain_energy = [&](const Eigen::VectorXd &z) {
      std::vector<double> y(6 * layout.n_nodes, 0.), rates(layout.n_strains);
      std::copy(z.data(), z.data() + 6 * (layout.n_nodes - 1), y.begin() + 6);
      Point<double> point = state.point();
      point.y             = y.data();
      point.rates         = z.data() + layout.of_coordinate(0);
      double energy       = 0;
      for (const auto &c : system.model.contributions)
        {
          c->strain_rates(point, rates.data() + c->first_strain);
          energy += c->strain_energy(rates.data() + c->first_strain);
        }
      return energy;
    };
    for (int block = std::min(n, 8);; block = std::min(n, 2 * block))
      {
        Eigen::MatrixXd X = Eigen::MatrixXd::NullaryExpr(n, block, [](const auto i, const auto j) {
          return std::sin(1. + 1.3 * i + 2.1 * j * i + 0.7 * j);
        });
        for (unsigned int iteration = 0; iteration < 6; ++iteration)
          {
            const Eigen::MatrixXd      B    = D.asDiagonal() * X;
            std::vector<double>        b(system.size());
            for (int j = 0; j < block; ++j)
              {
                std::fill(b.begin(), b.end(), 0.);
                std::copy(B.col(j).data(), B.col(j).data() + n, b.begin());
                solver->solve(b.data());
                X.col(j) = Eigen::Map<Eigen::VectorXd>(b.data(), n);
              }
            // orthonormal in D
            const Eigen::VectorXd root = D.cwiseSqrt();
            Eigen::HouseholderQR<Eigen::MatrixXd> qr(root.asDiagonal() * X);
            X = root.cwiseInverse().asDiagonal() * (qr.householderQ() * Eigen::MatrixXd::Identity(n, block));
          }
        // Ritz vectors of the stiffness in the block, with violated constraints as stiff springs: where the block has more
        // columns than there are free motions, the others are round-off, which obeys no constraint
        Eigen::MatrixXd KX(n, block), GX(m, block);
        for (int j = 0; j < block; ++j)
          {
            std::vector<double> x(system.size(), 0.), y(system.size());
            std::copy(X.col(j).data(), X.col(j).data() + n, x.begin());
            K.multiply(x.data(), y.data());
            KX.col(j) = Eigen::Map<Eigen::VectorXd>(y.data(), n) - 1e-9 * D.cwiseProduct(X.col(j));
            GX.col(j) = Eigen::Map<Eigen::VectorXd>(y.data() + n, m).cwiseProduct(G_scale);
          }
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(X.transpose() * KX + GX.transpose() * GX);
        const Eigen::MatrixXd                                Z = X * ritz.eigenvectors();
        std::vector<int>                                     zero;
        for (int j = 0; j < block; ++j)
          if (strain_energy(Z.col(j)) < 1e-14 && std::abs(ritz.eigenvalues()(j)) < 1e-8)
            zero.push_back(j);
        const bool are_all = static_cast<int>(zero.size()) < block || block == n;
        if (!are_all && block < most_free_motions)
          continue;

        check.n_free_motions = zero.size();
        for (const int j : zero)
          {
            std::map<std::string, double> share;
            for (unsigned int node = 1; node < layout.n_nodes; ++node)
              share[system.model.nodes[node].name] += Z.col(j).segment<6>(layout.of_node(node)).squaredNorm();
            std::vector<std::pair<double, std::string>> sorted;
            for (const auto &[name, s] : share)
              sorted.emplace_back(s, name);
            std::sort(sorted.rbegin(), sorted.rend());
            std::string text;
            for (unsigned int k = 0; k < std::min<unsigned int>(4, sorted.size()); ++k)
              if (sorted[k].first > 1e-6 * sorted[0].first)
                text += (text.empty() ? "" : ", ") + sorted[k].second;
            check.free_motions.push_back(text);
          }
        if (!are_all)
          check.free_motions.push_back("others, which are not counted");
        return;
      }
  }



  namespace
  {
    /** One line for all motions of the same bodies. */
    std::string
    list_of(const std::vector<std::string> &motions, const std::string &indent)
    {
      std::string text;
      for (auto motion = motions.begin(); motion != motions.end(); ++motion)
        {
          const auto n = std::count(motions.begin(), motions.end(), *motion);
          if (std::find(motions.begin(), motion, *motion) == motion)
            text += indent + "moving: " + *motion + (n > 1 ? " (" + std::to_string(n) + " motions)" : "");
        }
      return text;
    }
  } // namespace



  ModelCheck
  check_model(const System &system)
  {
    ModelCheck check;
    check.mass = system.mass_properties(system.reference());
    find_redundant(system, check);
    find_free_motions(system, check);
    return check;
  }



  std::string
  ModelCheck::text(const System &system, const std::string &file) const
  {
    const Layout                &layout = system.layout;
    const Eigen::IOFormat        vector(8, 0, ", ", ", ", "", "", "(", ")"), rows(8, 0, ", ", "\n                    ");
    std::ostringstream           out;
    out << file << (redundant.empty() ? ": no mistakes found\n" : ": some constraints are redundant\n")
        << "  unknowns          " << layout.n_unknowns() << ": 6 for each of " << layout.n_nodes - 1 << " nodes, "
        << layout.n_coordinates << " joint coordinates, " << layout.n_multipliers << " multipliers (constraints)\n"
        << "  total mass        " << mass.mass << " kg\n"
        << "  centre of mass    " << mass.centre.transpose().format(vector) << " m\n"
        << "  inertia about it  " << mass.inertia.format(rows) << " kg m^2\n"
        << "  free motions      " << n_free_motions;
    out << list_of(free_motions, "\n                    ");
    out << "\n  redundant         " << redundant.size();
    for (const auto &constraint : redundant)
      out << "\n                    " << constraint;
    return out.str();
  }



  std::string
  ModelCheck::free_motions_text() const
  {
    return "In the reference configuration " + std::to_string(n_free_motions) +
           (n_free_motions == 1 ? " motion is" : " motions are") +
           " free, those of steady rotations among them:" + list_of(free_motions, "\n    ");
  }



  std::string
  ModelCheck::complaint(const std::string &file) const
  {
    std::string text = file + ": some constraints say what others say already; the reactions are then not determined:";
    for (const auto &constraint : redundant)
      text += "\n  " + constraint;
    return text + "\n  Give a joint of the loop more freedom (spherical or cylindrical instead of revolute), or "
                  "set Redundant constraints = drop.";
  }
} // namespace samara
