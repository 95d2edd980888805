#include <samara/analysis/moving_axes.h>
#include <samara/analysis/steady_loads.h>
#include <samara/base/disjoint_sets.h>
#include <samara/base/text.h>
#include <samara/solvers/frequency_scale.h>
#include <samara/solvers/redundant_rows.h>
#include <samara/solvers/steady_motion.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace samara
{
  namespace
  {
    bool
    are_parallel(const Vector3 &a, const Vector3 &b)
    {
      return a.cross(b).norm() <= 1e-9 * a.norm() * b.norm(); // spins are known to round-off of a steady motion
    }



    /** For each node a number that is the same for those that terms couple, the ground apart. */
    std::vector<unsigned int>
    coupled_nodes(const System &system)
    {
      const Pattern &pattern = *system.layout.pattern;
      DisjointSets   groups(pattern.size());
      for (int j = 0; j < pattern.size(); ++j)
        for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
          groups.join(pattern.rows[k], j);
      std::vector<unsigned int> result(system.layout.n_nodes, pattern.size());
      for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
        result[node] = groups.root_of(system.layout.of_node(node));
      return result;
    }



    /** Numbers between −1 and 1 without order, the same in each run. */
    Eigen::VectorXd
    without_order(const unsigned int n, const unsigned int seed)
    {
      Eigen::VectorXd x(n);
      unsigned int    number = seed;
      for (unsigned int i = 0; i < n; ++i)
        {
          number = 1664525u * number + 1013904223u;
          x(i)   = number / 2147483648. - 1.;
        }
      return x;
    }
  } // namespace



  namespace
  {
    /** Whether numbers are the same, but for 1e-11 of the largest. */
    bool
    are_equal(const std::vector<double> &a, const std::vector<double> &b)
    {
      double largest = 0, difference = 0;
      for (unsigned int i = 0; i < a.size(); ++i)
        {
          largest    = std::max(largest, std::abs(a[i]));
          difference = std::max(difference, std::abs(a[i] - b[i]));
        }
      return a.size() == b.size() && difference <= 1e-11 * largest;
    }



    /** S without its rows and columns of constraints. */
    std::vector<double>
    kinematic_part(const LinearMotion &motion)
    {
      const Pattern      &pattern = *motion.S.pattern;
      std::vector<double> result;
      for (unsigned int j = 0; j < motion.n_kinematic; ++j)
        for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
          if (pattern.rows[k] < static_cast<int>(motion.n_kinematic))
            result.push_back(motion.S.values[k]);
      return result;
    }



    /** BᵀCB and BᵀC_dB of one point's strains, by all columns of the nodes it touches. */
    std::vector<double>
    stiffness_and_viscosity(const StrainRows &strains, const unsigned int point)
    {
      const auto        &p     = strains.points[point];
      const unsigned int first = strains.B.start[p.first_row], last = strains.B.start[p.first_row + p.size];
      std::map<unsigned int, unsigned int> place; // of every six columns
      for (unsigned int k = first; k < last; ++k)
        place[strains.B.columns[k] / 6] = 0;
      unsigned int n = 0;
      for (auto &[six, where] : place)
        where = 6 * n++;
      Eigen::MatrixXd B = Eigen::MatrixXd::Zero(p.size, 6 * n);
      for (unsigned int i = 0; i < p.size; ++i)
        for (unsigned int k = strains.B.start[p.first_row + i]; k < strains.B.start[p.first_row + i + 1]; ++k)
          B(i, place.at(strains.B.columns[k] / 6) + strains.B.columns[k] % 6) += strains.B.values[k];
      std::vector<double> result;
      for (const Eigen::MatrixXd &C : {Eigen::MatrixXd(strains.C(p)), Eigen::MatrixXd(strains.C_d(p))})
        {
          const Eigen::MatrixXd product = B.transpose() * C * B;
          result.insert(result.end(), product.data(), product.data() + product.size());
        }
      return result;
    }



    /** The products of all pairs of entries of each row of G, summed by places; and Gᵀμ. */
    std::pair<std::map<std::pair<int, int>, double>, std::vector<double>>
    constraints_of(const LinearMotion &motion, const std::vector<double> &multipliers)
    {
      const Pattern                        &pattern = *motion.S.pattern;
      std::map<std::pair<int, int>, double> products;
      std::vector<double>                   forces(motion.n_kinematic, 0.);
      for (unsigned int i = 0; i < multipliers.size(); ++i)
        {
          const int column = motion.n_kinematic + i, first = pattern.column_start[column],
                    last = pattern.column_start[column + 1];
          for (int k = first; k < last; ++k)
            {
              if (pattern.rows[k] >= static_cast<int>(motion.n_kinematic))
                continue;
              forces[pattern.rows[k]] += multipliers[i] * motion.S.values[k];
              for (int l = first; l <= k; ++l)
                products[{pattern.rows[k], pattern.rows[l]}] += motion.S.values[k] * motion.S.values[l];
            }
        }
      return {products, forces};
    }



    /** Whether two moments have the same matrices, but for other combinations of the same constraints: GᵀG is the same.
     */
    bool
    are_equal(const LinearMotion &a, const LinearMotion &b, const std::vector<double> &multipliers)
    {
      if (!are_equal(a.gyroscopic.values, b.gyroscopic.values) || !are_equal(kinematic_part(a), kinematic_part(b)))
        return false;
      for (unsigned int point = 0; point < a.strains.points.size(); ++point)
        if (!are_equal(stiffness_and_viscosity(a.strains, point), stiffness_and_viscosity(b.strains, point)))
          return false;
      const auto [products, forces]             = constraints_of(a, multipliers);
      const auto [later_products, later_forces] = constraints_of(b, multipliers);
      std::vector<double> values, later_values;
      for (const auto &[place, value] : products)
        values.push_back(value);
      for (const auto &[place, value] : later_products)
        later_values.push_back(value);
      return are_equal(values, later_values) && are_equal(forces, later_forces);
    }
  } // namespace



  bool
  MovingAxes::need_no_proof(const State &state, const Linearization &motion, const std::string &which) const
  {
    const auto &ground  = state.motion[0];
    double      fastest = 0;
    for (const auto &m : state.motion)
      fastest = std::max(fastest, m.spin.norm());
    if (fastest == 0)
      return true;
    if (which == "fixed" || !turns_as_a_whole(system, state))
      return false;
    if ((ground.spin - state.motion.back().spin).norm() <= 1e-9 * fastest)
      return true;
    const State later = moved_on(system, state, times_to_look(state)[0]);
    return are_equal(motion, Linearization(system, later), state.multipliers);
  }



  MovingAxes::MovingAxes(const System        &system,
                         const State         &state,
                         const Linearization &motion,
                         const std::string   &which)
    : system(system)
  {
    if (need_no_proof(state, motion, which))
      return;
    add_moments(state);
    add_kinds(which);
    add_pieces();
    ShiftInvert op(motion);
    set_by_lowest_frequency(motion, op, {});
    shift = op.shift();
    for (unsigned int kind = 0; kind < kinds.size(); ++kind)
      look_at(kind);
    choose();
  }



  void
  MovingAxes::add_moments(const State &state)
  {
    moments.push_back({0., state});
    for (const double time : times_to_look(state))
      {
        State later = moved_on(system, state, time);
        if (!later.left_out.empty())
          RedundantRows(system).choose(later);
        later.held = true;
        balance_reactions(system, later); // they may turn
        later.held = state.held;
        moments.push_back({time, later});
      }
  }



  void
  MovingAxes::add_kinds(const std::string &which)
  {
    const auto          &motion  = moments[0].state.motion;
    double               fastest = 0;
    std::vector<Vector3> own;
    for (const auto &m : motion)
      {
        own.push_back(m.spin);
        fastest = std::max(fastest, m.spin.norm());
      }
    if (which != "fixed")
      kinds.push_back({"axes that turn with each part", own});
    if (which != "turning")
      kinds.push_back({"fixed axes", std::vector<Vector3>(own.size(), Vector3::Zero())});
    if (which != "automatic")
      return;
    std::vector<Vector3> seen;
    for (unsigned int node = 0; node < own.size(); ++node)
      {
        const auto is_this = [&](const Vector3 &spin) { return (spin - own[node]).norm() <= 1e-9 * fastest; };
        if (is_this(Vector3::Zero()) || std::any_of(seen.begin(), seen.end(), is_this))
          continue;
        seen.push_back(own[node]);
        kinds.push_back({"axes that all turn with <" + (node == 0 ? "ground" : system.model.nodes[node].name) + ">",
                         std::vector<Vector3>(own.size(), own[node])});
      }
  }



  void
  MovingAxes::add_pieces()
  {
    const auto                     &motion = moments[0].state.motion;
    const std::vector<unsigned int> number = coupled_nodes(system);
    std::map<unsigned int, Piece>   all;
    std::map<unsigned int, double>  fastest;
    for (unsigned int node = 1; node < motion.size(); ++node)
      {
        Piece &piece = all[number[node]];
        piece.nodes.push_back(node);
        if (motion[node].spin.norm() > fastest[number[node]])
          {
            fastest[number[node]] = motion[node].spin.norm();
            piece.name            = system.model.nodes[node].name;
          }
      }
    for (auto &[i, piece] : all)
      if (fastest[i] > 0 || motion[0].spin.norm() > 0)
        {
          piece.change.assign(kinds.size(), std::numeric_limits<double>::infinity());
          pieces.push_back(piece);
        }
  }



  /** From the axes of a node that turn at @p spins, and are its own at the state, to its own axes at a moment. */
  Matrix3
  MovingAxes::turn(const Moment &moment, const unsigned int node, const std::vector<Vector3> &spins) const
  {
    if (spins.empty())
      return Matrix3::Identity();
    return moment.state.triad(node).transpose() * rotation_of_vector(moment.time * spins[node]) *
           moments[0].state.triad(node);
  }



  namespace
  {
    /** Each node's displacement and rotation times @p turn(node), or its transposed. */
    template <typename Vector, typename Turn>
    void
    turn_all(const System &system, const Turn &turn, const bool back, Vector &x)
    {
      for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
        {
          const Matrix3 Q = back ? Matrix3(turn(node).transpose()) : turn(node);
          for (const unsigned int part : {0, 3})
            {
              auto u = x.template segment<3>(system.layout.of_node(node) + part);
              u      = (Q * u).eval();
            }
        }
    }
  } // namespace



  /** In units of the model, for shifts below and among its frequencies. */
  std::vector<Eigen::VectorXd>
  MovingAxes::responses(const Moment &moment, const std::vector<Vector3> &spins) const
  {
    const Linearization                     motion(system, moment.state, spins);
    const unsigned int                      n = motion.n_kinematic;
    const Eigen::Map<const Eigen::VectorXd> units(motion.units.data(), n);
    ShiftInvert                             op(motion);
    const auto                   turn_of = [&](const unsigned int node) { return turn(moment, node, spins); };
    std::vector<Eigen::VectorXd> result;
    for (const double sigma : {shift, 30 * shift})
      {
        op.set(sigma, sigma);
        Eigen::VectorXd zeta = without_order(n, 1).cwiseProduct(units),
                        v    = sigma * without_order(n, 2).cwiseProduct(units);
        turn_all(system, turn_of, false, zeta);
        turn_all(system, turn_of, false, v);
        Eigen::VectorXd z(2 * n), image(2 * n);
        z.head(n) = zeta.cwiseQuotient(units);
        op.momenta(v.data(), z.data() + n);
        op.apply(z.data(), image.data());
        Eigen::VectorXd response = image.head(n);
        turn_all(system, turn_of, true, response); // displacements and rotations of a node have one unit each
        result.push_back(response);
      }
    return result;
  }



  namespace
  {
    /** By how much of its size a vector's part at these nodes changes. */
    double
    change_of(const System                    &system,
              const std::vector<unsigned int> &nodes,
              const Eigen::VectorXd           &first,
              const Eigen::VectorXd           &later)
    {
      double difference = 0, size = 0;
      for (const unsigned int node : nodes)
        {
          const unsigned int row = system.layout.of_node(node);
          difference += (later - first).segment<6>(row).squaredNorm();
          size += first.segment<6>(row).squaredNorm();
        }
      return std::sqrt(difference / size);
    }
  } // namespace



  void
  MovingAxes::look_at(const unsigned int kind)
  {
    // where axes of this kind would turn across the spin of a node, they stay its own
    std::vector<Vector3> spins = kinds[kind].spins;
    std::vector<Piece *> to_see;
    for (auto &piece : pieces)
      {
        const auto spin_of = [&](const unsigned int node) { return moments[0].state.motion[node].spin; };
        if (std::all_of(piece.nodes.begin(), piece.nodes.end(), [&](const unsigned int node) {
              return are_parallel(spin_of(node), spins[node]);
            }))
          {
            if (!piece.is_proven())
              to_see.push_back(&piece);
          }
        else
          for (const unsigned int node : piece.nodes)
            spins[node] = spin_of(node);
      }
    if (to_see.empty())
      return;
    for (Piece *const piece : to_see)
      piece->change[kind] = 0;
    const auto first = responses(moments[0], spins);
    for (unsigned int m = 1; m < moments.size(); ++m)
      {
        const auto later = responses(moments[m], spins);
        for (unsigned int s = 0; s < first.size(); ++s)
          for (Piece *const piece : to_see)
            piece->change[kind] = std::max(piece->change[kind], change_of(system, piece->nodes, first[s], later[s]));
      }
    for (Piece *const piece : to_see)
      if (piece->change[kind] < piece->change[piece->kind])
        piece->kind = kind;
  }



  void
  MovingAxes::choose()
  {
    for (const auto &m : moments[0].state.motion)
      chosen.push_back(m.spin);
    for (const auto &piece : pieces)
      for (const unsigned int node : piece.nodes)
        chosen[node] = kinds[piece.kind].spins[node];
  }



  std::string
  MovingAxes::text() const
  {
    std::string text;
    for (unsigned int kind = 0; kind < kinds.size(); ++kind)
      if (std::any_of(pieces.begin(), pieces.end(), [&](const Piece &p) { return p.kind == kind; }))
        text += (text.empty() ? "" : ", some in ") + kinds[kind].name;
    return text;
  }



  std::string
  MovingAxes::text_of_change() const
  {
    const auto piece =
      std::find_if(pieces.begin(), pieces.end(), [](const Piece &candidate) { return !candidate.is_proven(); });
    if (piece == pieces.end())
      return "";
    std::string text;
    for (unsigned int kind = 0; kind < kinds.size(); ++kind)
      if (std::isfinite(piece->change[kind]))
        text += (text.empty() ? " by " : ", by ") + number_to_text("%.3g", 100 * piece->change[kind]) + " % in " +
                kinds[kind].name;
    return "<" + piece->name +
           "> with what it carries, or what carries it, is not alike in all directions across the axis: as parts turn, its "
           "response to forces changes" +
           text;
  }



  std::vector<double>
  MovingAxes::changes(const std::vector<Mode> &modes) const
  {
    std::vector<double> result(modes.size(), 0.);
    for (unsigned int m = 1; m < moments.size(); ++m)
      {
        const Linearization motion(system, moments[m].state, chosen);
        ShiftInvert         op(motion);
        op.set(shift, shift);
        const auto turn_of = [&](const unsigned int node) { return turn(moments[m], node, chosen); };
        for (unsigned int i = 0; i < modes.size(); ++i)
          if (!modes[i].is_free())
            {
              Eigen::VectorXcd shape = modes[i].shape;
              turn_all(system, turn_of, false, shape);
              result[i] = std::max(result[i], op.judge(modes[i].lambda, shape).error / modes[i].frequency());
            }
      }
    return result;
  }
} // namespace samara
