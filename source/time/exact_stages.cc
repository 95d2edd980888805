#include <samara/base/dense.h>
#include <samara/time/exact_stages.h>
#include <samara/time/wider_pattern.h>

#include <algorithm>

namespace samara
{
  namespace
  {
    /** s × s blocks of one pattern. */
    std::shared_ptr<const Pattern>
    blocks_of(const Pattern &single, const unsigned int s)
    {
      auto      pattern = std::make_shared<Pattern>();
      const int n       = single.size();
      pattern->column_start.push_back(0);
      for (unsigned int l = 0; l < s; ++l)
        for (int j = 0; j < n; ++j)
          {
            for (unsigned int k = 0; k < s; ++k)
              for (int p = single.column_start[j]; p < single.column_start[j + 1]; ++p)
                pattern->rows.push_back(single.rows[p] + k * n);
            pattern->column_start.push_back(pattern->rows.size());
          }
      return pattern;
    }

    /** Of the step, by which rates along a motion are found as differences; exact for what is quadratic. */
    constexpr double part_of_step = 0.1;

    /** The pattern of a layout with more couplings. */
    std::shared_ptr<const Pattern>
    with_pairs(const System &system, const ExactStages::Couplings &couplings)
    {
      std::vector<int> from;
      return couplings.empty() ? system.layout.pattern : wider_pattern(*system.layout.pattern, couplings, from);
    }
  } // namespace



  ExactStages::ExactStages(const System &system, const Tableau &tableau, const Couplings &couplings)
    : system(system)
    , tableau(tableau)
    , single(with_pairs(system, couplings))
    , matrix(blocks_of(*single, tableau.s))
    , K(system.layout.pattern)
    , C(system.layout.pattern)
    , M(system.layout.pattern)
    , K_ahead(system.layout.pattern)
    , K_behind(system.layout.pattern)
    , x(tableau.s * system.size())
    , kinematics(system.layout.n_nodes - 1)
  {
    system.mass(M);
    const Pattern &pattern = *system.layout.pattern;
    for (int j = 0; j < pattern.size() && !couplings.empty(); ++j)
      for (int p = pattern.column_start[j]; p < pattern.column_start[j + 1]; ++p)
        in_single.push_back(single->position(pattern.rows[p], j));
  }



  int
  ExactStages::place(const unsigned int k, const int position, const unsigned int l, const unsigned int column) const
  {
    return place_in_single(k, place_of(position), l, column);
  }



  int
  ExactStages::place_in_single(const unsigned int k,
                               const int          position,
                               const unsigned int l,
                               const unsigned int column) const
  {
    // each column has the rows of all stages, one stage after the other
    const Pattern &p      = *single;
    const int      length = p.column_start[column + 1] - p.column_start[column];
    return tableau.s * (l * p.n_nonzeros() + p.column_start[column]) + k * length + position - p.column_start[column];
  }



  Eigen::MatrixXd
  ExactStages::displacement_of_node(const std::vector<Point<double>> &stages, const unsigned int node) const
  {
    // [δD_1 … δD_s] (I − h W) = [… h Σ_l a_kl D_l δΩ~_l …], W with the blocks a_kl Ω~_l in row l and column k
    const unsigned int   s = tableau.s;
    Eigen::MatrixXd      A = Eigen::MatrixXd::Identity(3 * s, 3 * s), U = Eigen::MatrixXd::Zero(6 * s, 6 * s);
    std::vector<Matrix3> D(s), inverse(s);
    std::vector<Vector3> v(s);
    for (unsigned int l = 0; l < s; ++l)
      {
        D[l]       = Eigen::Map<const Matrix3>(stages[l].q + 12 * node + 3);
        inverse[l] = D[l].inverse();
        v[l]       = Eigen::Map<const Vector3>(stages[l].y + 6 * node);
        for (unsigned int k = 0; k < s; ++k)
          A.block<3, 3>(3 * l, 3 * k) -=
            h * tableau.a(k, l) * skew(Vector3(Eigen::Map<const Vector3>(stages[l].y + 6 * node + 3)));
      }
    const Eigen::MatrixXd P = samara::inverse(A);
    for (unsigned int l = 0; l < s; ++l)
      for (unsigned int i = 0; i < 3; ++i)
        {
          Eigen::MatrixXd right(3, 3 * s);
          for (unsigned int k = 0; k < s; ++k)
            {
              U.block<3, 1>(6 * k, 6 * l + i) = h * tableau.a(k, l) * inverse[k] * D[l].col(i);
              right.middleCols<3>(3 * k)      = h * tableau.a(k, l) * D[l] * skew(Vector3::Unit(i));
            }
          const Eigen::MatrixXd dD = right * P;
          for (unsigned int k = 0; k < s; ++k)
            {
              Vector3 dx = Vector3::Zero();
              for (unsigned int j = 0; j < s; ++j)
                dx += h * tableau.a(k, j) * dD.middleCols<3>(3 * j) * v[j];
              U.block<3, 1>(6 * k, 6 * l + 3 + i)     = inverse[k] * dx;
              U.block<3, 1>(6 * k + 3, 6 * l + 3 + i) = axial(inverse[k] * dD.middleCols<3>(3 * k));
            }
        }
    return U;
  }



  void
  ExactStages::find_kinematics(const std::vector<Point<double>> &stages)
  {
    const unsigned int s = tableau.s;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        Kinematics &k = kinematics[node - 1];
        k.U           = displacement_of_node(stages, node);
        k.V           = Eigen::MatrixXd::Identity(6 * s, 6 * s);
        for (unsigned int l = 0; l < s; ++l)
          k.V.middleRows<6>(6 * l) -= ad(Eigen::Map<const Vector6>(stages[l].y + 6 * node)) * k.U.middleRows<6>(6 * l);
        k.U_alpha = k.U;
        for (unsigned int l = 0; l < s; ++l)
          for (unsigned int j = 0; j < s; ++j)
            k.U_alpha.middleRows<6>(6 * l) += h * (tableau.a_alpha(l, j) - tableau.a(l, j)) * k.V.middleRows<6>(6 * j);
      }
    of_coordinates.U       = h * tableau.a;
    of_coordinates.U_alpha = h * tableau.a_alpha;
    of_coordinates.V       = Eigen::MatrixXd::Identity(s, s);
    of_states              = {of_coordinates.U_alpha, of_coordinates.U_alpha, of_coordinates.V};
  }



  Point<double>
  ExactStages::moved(const Point<double> &stage, const double dt)
  {
    const Layout &layout = system.layout;
    moved_q.assign(stage.q, stage.q + 12 * layout.n_nodes);
    moved_coordinates.assign(stage.coordinates, stage.coordinates + layout.n_coordinates);
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      {
        const Eigen::Map<const Matrix3> D(stage.q + 12 * node + 3);
        const Eigen::Map<const Vector3> v(stage.y + 6 * node), spin(stage.y + 6 * node + 3);
        Eigen::Map<Vector3>(&moved_q[12 * node]) += dt * D * v;
        Eigen::Map<Matrix3>(&moved_q[12 * node + 3]) += dt * D * skew(Vector3(spin));
      }
    for (unsigned int i = 0; i < layout.n_coordinates; ++i)
      moved_coordinates[i] += dt * stage.rates[i];
    Point<double> result = stage;
    result.q             = moved_q.data();
    result.coordinates   = moved_coordinates.data();
    return result;
  }



  void
  ExactStages::constraints_moved(const Point<double> &stage, const double dt, SparseMatrix &result)
  {
    result.clear();
    system.add_constraint_tangent(moved(stage, dt), result);
  }



  void
  ExactStages::linearize(const Point<double> &stage)
  {
    const Layout &layout = system.layout;
    K.clear();
    C.clear();
    Point<double> at_fixed_stress = stage;
    at_fixed_stress.material      = false;
    system.add_tangent(at_fixed_stress, K);
    system.add_damping(at_fixed_stress, C);
    system.add_state_damping(C);
    // rows of constraints: G to C, Ġ to K. G N is quadratic in q, or nearly so, and differences along q̇ are its
    // derivative
    const double dt = part_of_step * h;
    constraints_moved(stage, dt, K_ahead);
    constraints_moved(stage, -dt, K_behind);
    const Pattern &pattern     = *K.pattern;
    const int      n_kinematic = layout.of_multiplier(0);
    for (int j = 0; j < n_kinematic; ++j)
      for (int p = pattern.column_start[j]; p < pattern.column_start[j + 1]; ++p)
        if (pattern.rows[p] >= n_kinematic)
          {
            C.values[p] = K.values[p];
            K.values[p] = (K_ahead.values[p] - K_behind.values[p]) / (2 * dt);
          }
  }



  void
  ExactStages::add_columns(const unsigned int k,
                           const unsigned int first,
                           const unsigned int width,
                           const Kinematics  &of)
  {
    // these columns have the same rows, those of constraints last
    const Pattern &p     = *K.pattern;
    const int      begin = p.column_start[first], n_rows = p.column_start[first + 1] - begin;
    const int      n_constraints =
      p.rows.begin() + begin + n_rows -
      std::lower_bound(p.rows.begin() + begin, p.rows.begin() + begin + n_rows, system.layout.of_multiplier(0));
    const int                               n_forces = n_rows - n_constraints;
    const Eigen::Map<const Eigen::MatrixXd> K_here(&K.values[begin], n_rows, width),
      C_here(&C.values[begin], n_rows, width);
    for (unsigned int l = 0; l < tableau.s; ++l)
      {
        const auto      block = [&](const Eigen::MatrixXd &A) { return A.block(width * k, width * l, width, width); };
        Eigen::MatrixXd change(n_rows, width);
        change.topRows(n_forces) =
          h * (K_here.topRows(n_forces) * block(of.U) + C_here.topRows(n_forces) * block(of.V));
        change.bottomRows(n_constraints) =
          K_here.bottomRows(n_constraints) * block(of.U) + C_here.bottomRows(n_constraints) * block(of.V);
        for (unsigned int j = 0; j < width; ++j)
          {
            const int start = p.column_start[first + j];
            for (int i = 0; i < n_rows; ++i)
              matrix.values[place(k, start + i, l, first + j)] += change(i, j) + tableau.w(k, l) * M.values[start + i];
          }
      }
  }



  void
  ExactStages::gather(const StrainRows            &rows,
                      const unsigned int           stage,
                      const double                 factor,
                      std::vector<Eigen::MatrixXd> Strains::Block::*which,
                      std::vector<Strains>                         &strains) const
  {
    const unsigned int n_in_nodes = system.layout.of_coordinate(0);
    for (unsigned int g = 0; g < rows.points.size(); ++g)
      {
        Strains                 &s = strains[g];
        const StrainRows::Point &p = rows.points[g];
        for (unsigned int i = 0; i < p.size; ++i)
          for (unsigned int k = rows.B.start[p.first_row + i]; k < rows.B.start[p.first_row + i + 1]; ++k)
            {
              const unsigned int column = rows.B.columns[k], width = column < n_in_nodes ? 6 : 1,
                                 first = column < n_in_nodes ? column - column % 6 : column;
              auto block =
                std::find_if(s.blocks.begin(), s.blocks.end(), [&](const auto &b) { return b.first == first; });
              if (block == s.blocks.end())
                {
                  const std::vector<Eigen::MatrixXd> none(tableau.s, Eigen::MatrixXd::Zero(p.size, width));
                  block = s.blocks.insert(s.blocks.end(), {first, width, none, none, {}});
                }
              ((*block).*which)[stage](i, column - first) += factor * rows.B.values[k];
            }
      }
  }



  void
  ExactStages::add_material(const std::vector<Point<double>> &stages)
  {
    const double            dt = part_of_step * h;
    std::vector<Strains>    strains;
    std::vector<StrainRows> rows;
    for (unsigned int l = 0; l < tableau.s; ++l)
      {
        rows.push_back(system.strain_rows(stages[l]));
        strains.resize(rows[l].points.size());
        gather(rows[l], l, 1., &Strains::Block::B, strains);
        for (const double side : {dt, -dt})
          gather(system.strain_rows(moved(stages[l], side)), l, 0.5 / side, &Strains::Block::B_dot, strains);
      }
    for (unsigned int g = 0; g < strains.size(); ++g)
      {
        strains[g].of = rows[0].points[g];
        add_material(rows, strains[g]);
      }
  }



  void
  ExactStages::add_material(const std::vector<StrainRows> &rows, Strains &strains)
  {
    const unsigned int s       = tableau.s;
    const Pattern     &pattern = *K.pattern;
    for (auto &block : strains.blocks)
      {
        const Kinematics &of = kinematics_of(block.first);
        const int         w  = block.width;
        for (unsigned int l = 0; l < s; ++l)
          for (unsigned int m = 0; m < s; ++m)
            block.rates.push_back(block.B[l] * of.V.block(w * l, w * m, w, w) +
                                  block.B_dot[l] * of.U.block(w * l, w * m, w, w));
      }
    for (const auto &columns : strains.blocks)
      for (unsigned int k = 0; k < s; ++k)
        for (unsigned int m = 0; m < s; ++m)
          {
            Eigen::MatrixXd change = Eigen::MatrixXd::Zero(strains.of.size, columns.width);
            for (unsigned int l = 0; l < s; ++l)
              change += h * tableau.a_alpha(k, l) * columns.rates[s * l + m];
            const Eigen::MatrixXd stress =
              h * strains.of.weight *
              (rows[k].C(strains.of) * change + rows[k].C_d(strains.of) * columns.rates[s * k + m]);
            for (const auto &of_rows : strains.blocks)
              {
                const Eigen::MatrixXd forces = of_rows.B[k].transpose() * stress;
                for (unsigned int j = 0; j < columns.width; ++j)
                  {
                    const int at = place(k, pattern.position(of_rows.first, columns.first + j), m, columns.first + j);
                    for (unsigned int i = 0; i < of_rows.width; ++i)
                      matrix.values[at + i] += forces(i, j);
                  }
              }
          }
  }



  void
  ExactStages::assemble(const std::vector<Point<double>> &stages, const double h, const std::vector<bool> &is_active)
  {
    this->h                = h;
    const Layout  &layout  = system.layout;
    const Pattern &pattern = *K.pattern;
    find_kinematics(stages);
    matrix.clear();
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        linearize(stages[k]);
        for (unsigned int node = 1; node < layout.n_nodes; ++node)
          {
            const int first = layout.of_node(node);
            add_columns(k, first, 6, kinematics[node - 1]);
            const Matrix6 gyroscopic = h * gyroscopic_tangent(system.model.nodes[node].inertia,
                                                              Eigen::Map<const Vector6>(stages[k].y + 6 * node));
            for (int j = 0; j < 6; ++j)
              for (int i = 0, at = place(k, pattern.position(first, first + j), k, first + j); i < 6; ++i)
                matrix.values[at + i] += gyroscopic(i, j);
          }
        for (int j = layout.of_coordinate(0); j < layout.of_multiplier(0); ++j)
          add_columns(k, j, 1, j < layout.of_state(0) ? of_coordinates : of_states);
        for (int j = layout.of_multiplier(0); j < pattern.size(); ++j)
          for (int p = pattern.column_start[j]; p < pattern.column_start[j + 1]; ++p)
            matrix.values[place(k, p, k, j)] += K.values[p];
      }
    add_material(stages);
    make_solver_of(is_active);
    for (unsigned int i = 0; i < active.size(); ++i)
      if (const int j = layout.of_multiplier(i); !active[i])
        for (unsigned int k = 0; k < tableau.s; ++k)
          matrix.values[place(k, pattern.position(j, j), k, j)] = 1;
  }



  void
  ExactStages::make_solver_of(const std::vector<bool> &is_active)
  {
    if (solver && is_active == active)
      return;
    active                 = is_active;
    const int  n           = system.size();
    const int  n_kinematic = system.layout.of_multiplier(0);
    const auto is_out      = [&](const int i) { return i % n >= n_kinematic && !active[i % n - n_kinematic]; };
    kept.clear();
    of_kept.reset();
    if (std::find(active.begin(), active.end(), false) == active.end())
      {
        solver = make_solver(matrix.pattern);
        return;
      }
    PartOfPattern part(*matrix.pattern, [&](const int i, const int j) { return i == j || (!is_out(i) && !is_out(j)); });
    kept    = std::move(part.kept);
    of_kept = std::make_unique<SparseMatrix>(part.pattern);
    solver  = make_solver(part.pattern);
  }



  void
  ExactStages::add(const unsigned int k,
                   const unsigned int i,
                   const unsigned int l,
                   const unsigned int j,
                   const double       value)
  {
    const bool is_force = i < static_cast<unsigned int>(system.layout.of_multiplier(0));
    matrix.values[place(k, K.pattern->position(i, j), l, j)] += is_force ? h * value : value;
  }



  bool
  ExactStages::add_pair(const unsigned int k,
                        const unsigned int a,
                        const unsigned int b,
                        const Matrix6     &K_pair,
                        const Matrix6     &C_pair)
  {
    const int         row = system.layout.of_node(a), first = system.layout.of_node(b);
    const Kinematics &of = kinematics[b - 1];
    for (unsigned int l = 0; l < tableau.s; ++l)
      {
        const Matrix6 change = h * (K_pair * of.U.block<6, 6>(6 * k, 6 * l) + C_pair * of.V.block<6, 6>(6 * k, 6 * l));
        for (int j = 0; j < 6; ++j)
          {
            const int position = single->position(row, first + j);
            if (position < 0)
              return false;
            const int at = place_in_single(k, position, l, first + j);
            for (int i = 0; i < 6; ++i)
              matrix.values[at + i] += change(i, j);
          }
      }
    return true;
  }



  void
  ExactStages::solve(std::vector<std::vector<double>> &residuals)
  {
    const unsigned int n = system.size(), n_kinematic = system.layout.of_multiplier(0);
    for (unsigned int k = 0; k < tableau.s; ++k)
      for (unsigned int i = 0; i < n; ++i)
        x[k * n + i] = (i < n_kinematic ? -h : -1.) * residuals[k][i];
    for (unsigned int i = 0; i < kept.size(); ++i)
      of_kept->values[i] = matrix.values[kept[i]];
    solver->factorize(of_kept ? *of_kept : matrix);
    solver->solve(x.data());
    for (unsigned int k = 0; k < tableau.s; ++k)
      for (unsigned int i = 0; i < n; ++i)
        residuals[k][i] = x[k * n + i] / (i < n_kinematic ? 1. : h);
  }



  void
  ExactStages::displacements(const unsigned int                      k,
                             const std::vector<std::vector<double>> &changes,
                             std::vector<double>                    &zeta_alpha,
                             std::vector<double>                    &zeta_rate) const
  {
    const Layout &layout = system.layout;
    const auto    add    = [&](const int first, const unsigned int width, const Kinematics &of) {
      const auto rows = [&](const Eigen::MatrixXd &A, const unsigned int l) {
        return A.block(width * k, width * l, width, width);
      };
      Eigen::Map<Eigen::VectorXd> alpha(&zeta_alpha[first], width), rate(&zeta_rate[first], width);
      alpha.setZero();
      rate.setZero();
      for (unsigned int l = 0; l < tableau.s; ++l)
        {
          const Eigen::Map<const Eigen::VectorXd> change(&changes[l][first], width);
          alpha += rows(of.U_alpha, l) * change;
          rate += rows(of.V, l) * change;
        }
    };
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      add(layout.of_node(node), 6, kinematics[node - 1]);
    for (int i = layout.of_coordinate(0); i < layout.of_multiplier(0); ++i)
      add(i, 1, i < layout.of_state(0) ? of_coordinates : of_states);
  }
} // namespace samara
