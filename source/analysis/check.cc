#include <samara/analysis/check.h>
#include <samara/solvers/linear.h>
#include <samara/solvers/redundant_rows.h>

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

    /** More free motions are not counted: the search works with as many full vectors of @p n numbers. */
    int
    most_free_motions(const int n)
    {
      return n > 20000 ? 8 : 32;
    }

    /** Joints' motions are told by name in models of up to so many joints. */
    constexpr unsigned int few_joints = 1000;

    /** "model.prm:12: ", where a motion is prescribed that has a row in this combination. */
    std::string
    place_of_prescribed(const System &system, const Eigen::VectorXd &combination)
    {
      for (const auto &[coordinate, row] : system.model.prescribed)
        if (std::abs(combination(row)) > 1e-6 * combination.cwiseAbs().maxCoeff())
          for (const auto *c : system.layout.constraining)
            if (system.layout.multiplier_names[row].find("joint " + c->name + ", ") == 0)
              return c->parameters.where() + ": ";
      return "";
    }



    /** "a, b, c and 5 more" */
    std::string
    list_of_some(const std::vector<std::string> &names)
    {
      constexpr unsigned int most = 6;
      std::string            text;
      for (unsigned int i = 0; i < std::min<unsigned int>(most, names.size()); ++i)
        text += (i > 0 ? ", " : "") + names[i];
      return text + (names.size() > most ? " and " + std::to_string(names.size() - most) + " more" : "");
    }
  } // namespace



  void
  find_redundant(const System &system, ModelCheck &check)
  {
    State state = system.reference();
    state.left_out.clear();
    for (const auto &c : system.model.contributions)
      c->add_initial_velocities(state);
    RedundantRows rows(system);
    check.redundant_multipliers = rows.find(state);
    if (check.redundant_multipliers.empty())
      return;
    check.generic      = rows.generic_place();
    check.combinations = rows.combinations(check.generic);
    for (const int j : rows.contradictions(check.generic))
      check.contradictions.push_back(place_of_prescribed(system, check.combinations.col(j)) +
                                     "these constraints contradict each other: " + rows.names(check.combinations, j));
    for (const auto &loop : rows.loops(check.combinations))
      check.redundant.push_back(list_of_some(loop.joints) + ": " + std::to_string(loop.n_redundant) +
                                (loop.n_redundant == 1 ? " constraint says" : " constraints say") +
                                " what the others say already");
  }



  namespace
  {
    /** Names of the joints' motions, "flap 1 rotation", that change when the model moves by the small @p z. */
    std::vector<std::string>
    moving_joints(const System &system, const Eigen::VectorXd &z)
    {
      if (system.layout.constraining.size() > few_joints)
        return {};
      const State         start = system.reference();
      State               moved = start;
      std::vector<double> step(system.size(), 0.);
      std::copy(z.data(), z.data() + z.size(), step.begin());
      system.update(moved, step);
      std::vector<std::string> names;
      double                   largest = 0;
      std::vector<double>      changes;
      for (const auto *c : system.layout.constraining)
        for (const auto &name : c->probe_names())
          if (const auto probe = c->probe(name); probe && (probe->unit == "deg" || probe->unit == "m"))
            {
              names.push_back(c->name + " " + probe->name);
              changes.push_back(std::abs(probe->value(moved) - probe->value(start)) *
                                (probe->unit == "deg" ? M_PI / 180 : 1.));
              largest = std::max(largest, changes.back());
            }
      std::vector<std::string> moving;
      for (unsigned int i = 0; i < names.size(); ++i)
        if (changes[i] > 1e-3 * std::max(largest, 1e-3 * z.lpNorm<Eigen::Infinity>()))
          moving.push_back(names[i]);
      return moving;
    }



    /** What moves: up to four bodies, and joints if there are any that do. */
    std::string
    description(const System &system, const Eigen::VectorXd &z)
    {
      std::map<std::string, double> share;
      for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
        share[system.model.nodes[node].name] += z.segment<6>(system.layout.of_node(node)).squaredNorm();
      std::vector<std::pair<double, std::string>> sorted;
      for (const auto &[name, s] : share)
        sorted.emplace_back(s, name);
      std::sort(sorted.rbegin(), sorted.rend());
      std::string text;
      for (unsigned int k = 0; k < std::min<unsigned int>(4, sorted.size()); ++k)
        if (sorted[k].first > 1e-6 * sorted[0].first)
          text += (text.empty() ? "" : ", ") + sorted[k].second;
      const auto joints = moving_joints(system, 1e-3 * z / z.lpNorm<Eigen::Infinity>());
      return text + (joints.empty() ? "" : " at " + list_of_some(joints));
    }



    /** A basis of the same motions, each of which moves as little as possible. */
    Eigen::MatrixXd
    simplest_basis(const Eigen::MatrixXd &Z)
    {
      const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(Z.transpose());
      Eigen::MatrixXd                                   pivots(Z.cols(), Z.cols());
      for (int j = 0; j < Z.cols(); ++j)
        pivots.row(j) = Z.row(qr.colsPermutation().indices()(j));
      return Z * pivots.inverse();
    }
  } // namespace



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

    // inverse iteration on a block of vectors; those that strain nothing stay, all others fade or are told by their
    // energy
    const State state         = system.reference();
    const auto  strain_energy = [&](const Eigen::VectorXd &z) {
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
            const Eigen::MatrixXd B = D.asDiagonal() * X;
            std::vector<double>   b(system.size());
            for (int j = 0; j < block; ++j)
              {
                std::fill(b.begin(), b.end(), 0.);
                std::copy(B.col(j).data(), B.col(j).data() + n, b.begin());
                solver->solve(b.data());
                X.col(j) = Eigen::Map<Eigen::VectorXd>(b.data(), n);
              }
            // orthonormal in D
            const Eigen::VectorXd                 root = D.cwiseSqrt();
            Eigen::HouseholderQR<Eigen::MatrixXd> qr(root.asDiagonal() * X);
            X = root.cwiseInverse().asDiagonal() * (qr.householderQ() * Eigen::MatrixXd::Identity(n, block));
          }
        // Ritz vectors of the stiffness in the block, with violated constraints as stiff springs: where the block has
        // more columns than there are free motions, the others are round-off, which obeys no constraint
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
        if (!are_all && block < most_free_motions(n))
          continue;

        check.n_free_motions = zero.size();
        Eigen::MatrixXd free(n, zero.size());
        for (unsigned int j = 0; j < zero.size(); ++j)
          free.col(j) = Z.col(zero[j]);
        if (!zero.empty())
          free = simplest_basis(free);
        for (unsigned int j = 0; j < zero.size(); ++j)
          check.free_motions.push_back(description(system, free.col(j)));
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
    const Layout         &layout = system.layout;
    const Eigen::IOFormat vector(8, 0, ", ", ", ", "", "", "(", ")"), rows(8, 0, ", ", "\n                    ");
    std::ostringstream    out;
    out << file << ": no mistakes found\n"
        << "  unknowns          " << layout.n_unknowns() << ": 6 for each of " << layout.n_nodes - 1 << " nodes, "
        << layout.n_coordinates << " joint coordinates, " << layout.n_multipliers << " multipliers (constraints)\n"
        << "  total mass        " << mass.mass << " kg\n"
        << "  centre of mass    " << mass.centre.transpose().format(vector) << " m\n"
        << "  inertia about it  " << mass.inertia.format(rows) << " kg m^2\n"
        << "  free motions      " << n_free_motions;
    out << list_of(free_motions, "\n                    ");
    out << "\n  redundant         " << redundant_multipliers.size();
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
  ModelCheck::redundancy_text() const
  {
    std::string text = std::to_string(redundant_multipliers.size()) +
                       (redundant_multipliers.size() == 1 ? " constraint is" : " constraints are") +
                       " redundant and left out; motions do not depend on it, reactions are not unique there:";
    for (const auto &loop : redundant)
      text += "\n    " + loop;
    return text;
  }



  std::string
  ModelCheck::complaint() const
  {
    std::string text;
    for (const auto &combination : contradictions)
      text += (text.empty() ? "" : "\n") + combination;
    return text +
           "\n  Not all of them can hold while prescribed motions go on: leave out one of these, or give a joint of the "
           "loop more freedom (spherical or cylindrical instead of revolute).";
  }



  bool
  ModelCheck::mark(std::vector<Probe> &probes) const
  {
    bool is_any = false;
    if (redundant_multipliers.empty())
      return is_any;
    for (auto &probe : probes)
      for (int j = 0; j < combinations.cols(); ++j)
        {
          State with = generic, without = generic;
          for (unsigned int i = 0; i < with.multipliers.size(); ++i)
            {
              without.multipliers[i] = 0;
              with.multipliers[i]    = combinations(i, j);
            }
          if (std::abs(probe.value(with) - probe.value(without)) > 1e-6)
            {
              probe.unit += ", not unique";
              is_any = true;
              break;
            }
        }
    return is_any;
  }
} // namespace samara
