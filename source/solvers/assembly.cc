#include <samara/base/finite.h>
#include <samara/solvers/assembly.h>
#include <samara/solvers/newton.h>
#include <samara/solvers/row_scale.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** A joint coordinate has no place of its own to be near to: a weight that is nothing beside those of pieces. */
    constexpr double weight_of_coordinates = 1e-8;

    /** The vector of a rotation: its axis times its angle, at most half a turn [rad]. */
    Vector3
    rotation_vector(const Matrix3 &R)
    {
      const Eigen::AngleAxisd turn(R);
      return turn.angle() * turn.axis();
    }
  } // namespace



  Assembly::Assembly(const System &system, const std::vector<double> &weights, const std::vector<bool> &fixed)
    : system(system)
    , drawn([&] {
      // nothing moves and nothing pulls: the rows alone
      State state = system.reference();
      state.left_out.clear();
      return state;
    }())
    , length(model_length(system.model))
    , pieces(system, length)
    , target(system.layout.n_multipliers, 0.)
    , is_out(system.layout.n_multipliers, false)
    , scale(system.layout.n_multipliers, 0.)
    , per_length(system.layout.n_multipliers, 0.)
    , K(system.layout.pattern)
  {
    find_pieces(weights, fixed);
    for (const auto i : system.layout.nonholonomic)
      is_out[i] = true;
    drawn_coordinates = drawn.coordinates;
    place             = drawing();
    K.clear();
    system.add_constraint_tangent(drawn.point(), K);
    for (unsigned int i = 0; i < scale.size(); ++i)
      {
        scale[i]         = row_scale(system.layout, K, i, length) / length;
        const int column = system.layout.of_multiplier(i);
        for (int k = K.pattern->column_start[column]; k < K.pattern->column_start[column + 1]; ++k)
          if (const int unknown = K.pattern->rows[k]; unknown < system.layout.of_coordinate(0) && unknown % 6 == 0)
            per_length[i] = std::max(per_length[i], Eigen::Map<const Vector3>(&K.values[k]).norm());
      }
    read_coordinates();
    drawn_coordinates = place.coordinates;
  }



  Assembly::Place
  Assembly::drawing() const
  {
    Place at{{}, {}, drawn_coordinates};
    for (const auto &piece : of_piece)
      {
        at.turn.emplace_back(Matrix3::Identity());
        at.middle.push_back(piece.middle);
      }
    return at;
  }



  void
  Assembly::find_pieces(const std::vector<double> &weights, const std::vector<bool> &fixed)
  {
    const unsigned int n_nodes = system.layout.n_nodes;
    of_piece.resize((pieces.n_unknowns() - system.layout.n_coordinates) / 6 + 1);
    std::vector<std::vector<Vector3>> places(of_piece.size());
    std::vector<unsigned int>         n(of_piece.size(), 0);
    for (auto &piece : of_piece)
      piece.weight = 0;
    for (unsigned int node = 0; node < n_nodes; ++node)
      {
        Piece &piece = of_piece[piece_of_node(node)];
        piece.middle += drawn.position(node);
        ++n[piece_of_node(node)];
        piece.weight   = std::max(piece.weight, weights[node]);
        piece.is_fixed = piece.is_fixed || fixed[node];
      }
    for (const auto &item : system.model.items)
      if (const auto *const connection = dynamic_cast<const Connection *>(item.get()))
        for (const auto &frame : connection->connected_frames())
          places[piece_of_node(frame.node)].push_back(frame.position(drawn.q.data()));
    for (unsigned int node = 0; node < n_nodes; ++node) // an end that nothing holds counts, too
      places[piece_of_node(node)].push_back(drawn.position(node));
    of_piece[0].is_fixed = true;
    for (unsigned int p = 0; p < of_piece.size(); ++p)
      {
        Piece &piece = of_piece[p];
        piece.middle /= n[p];
        piece.weight = piece.weight > 0 ? piece.weight : 1.;
        for (const auto &x : places[p])
          piece.centre += x / places[p].size();
        for (const auto &x : places[p])
          piece.length += (x - piece.centre).squaredNorm() / places[p].size();
        // what is held at one place only has no length: a small one, so that it turns rather than moves
        piece.length = std::max(std::sqrt(piece.length), 1e-2 * length);
      }
    column.assign(pieces.n_unknowns(), -1);
    for (unsigned int p = 1; p < of_piece.size(); ++p)
      for (unsigned int i = 0; i < 6; ++i)
        if (!of_piece[p].is_fixed)
          column[6 * (p - 1) + i] = n_open++;
    for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
      column[pieces.column_of_coordinate(i)] = n_open++;
  }



  void
  Assembly::read_coordinates()
  {
    const Layout &layout        = system.layout;
    const auto   &all           = *K.pattern;
    const auto    touches_nodes = [&](const int of_row) {
      for (int k = all.column_start[of_row]; k < all.column_start[of_row + 1]; ++k)
        if (all.rows[k] < layout.of_coordinate(0) && K.values[k] != 0.)
          return true;
      return false;
    };
    for (unsigned int pass = 0; pass < 20; ++pass) // those of lengths are quadratic
      {
        const State         state = state_at(place);
        std::vector<double> r(system.size() + 6, 0.);
        system.add_gaps(state.point(), r.data());
        double change = 0;
        for (unsigned int c = 0; c < layout.n_coordinates; ++c)
          {
            // the one row that measures it
            const int        j = layout.of_coordinate(c);
            std::vector<int> rows;
            for (int k = all.column_start[j]; k < all.column_start[j + 1]; ++k)
              if (all.rows[k] >= layout.of_multiplier(0) && K.values[k] != 0. && touches_nodes(all.rows[k]))
                rows.push_back(k);
            if (rows.size() != 1)
              continue;
            const double step = -r[all.rows[rows[0]]] / K.values[rows[0]];
            place.coordinates[c] += step;
            change = std::max(change, std::abs(step));
          }
        K.clear();
        system.add_constraint_tangent(state_at(place).point(), K);
        if (!(change > 1e-14))
          break;
      }
    std::vector<double> r(system.size() + 6, 0.);
    system.add_gaps(state_at(place).point(), r.data());
    for (unsigned int i = 0; i < target.size(); ++i)
      if (!touches_nodes(layout.of_multiplier(i)))
        target[i] = r[layout.of_multiplier(i)];
  }



  State
  Assembly::state_at(const Place &at) const
  {
    State state       = drawn;
    state.coordinates = at.coordinates;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const unsigned int p = piece_of_node(node);
        if (of_piece[p].is_fixed)
          continue;
        Eigen::Map<Vector3>(&state.q[12 * node]) =
          at.middle[p] + at.turn[p] * (drawn.position(node) - of_piece[p].middle);
        Eigen::Map<Matrix3>(&state.q[12 * node + 3]) = at.turn[p] * drawn.triad(node);
      }
    return state;
  }



  Eigen::VectorXd
  Assembly::gaps_at(const State &state) const
  {
    std::vector<double> r(system.size() + 6, 0.);
    system.add_gaps(state.point(), r.data());
    Eigen::VectorXd g(target.size());
    for (unsigned int i = 0; i < target.size(); ++i)
      g(i) = is_out[i] ? 0. : scale[i] * (r[system.layout.of_multiplier(i)] - target[i]);
    return g;
  }



  Eigen::SparseMatrix<double>
  Assembly::rows_at(const State &state)
  {
    const Layout &layout = system.layout;
    pieces.renew(state);
    K.clear();
    system.add_constraint_tangent(state.point(), K);
    std::vector<Eigen::Triplet<double>> entries;
    for (unsigned int i = 0; i < target.size(); ++i)
      {
        const int j = layout.of_multiplier(i);
        for (int k = K.pattern->column_start[j]; k < K.pattern->column_start[j + 1] && !is_out[i]; ++k)
          {
            const int unknown = K.pattern->rows[k];
            if (unknown >= layout.n_kinematic())
              continue;
            if (unknown >= layout.of_coordinate(0))
              {
                const unsigned int c = unknown - layout.of_coordinate(0);
                entries.emplace_back(i,
                                     column[pieces.column_of_coordinate(c)],
                                     scale[i] * K.values[k] * pieces.coordinate_unit(c));
                continue;
              }
            const unsigned int node  = 1 + unknown / 6;
            const int          first = pieces.column_of_node(node);
            if (first < 0 || column[first] < 0)
              continue;
            const Matrix6 &T = pieces.twist_of_node(node);
            for (int l = 0; l < 6; ++l)
              entries.emplace_back(i, column[first + l], scale[i] * K.values[k] * T(unknown % 6, l));
          }
      }
    Eigen::SparseMatrix<double> G(target.size(), n_open);
    G.setFromTriplets(entries.begin(), entries.end());
    return G;
  }



  double
  Assembly::distance_at(const Place &at) const
  {
    double twice = 0;
    for (unsigned int p = 1; p < of_piece.size(); ++p)
      {
        const Piece  &piece = of_piece[p];
        const Vector3 arm = piece.centre - piece.middle, moved = at.middle[p] + at.turn[p] * arm - piece.centre;
        twice +=
          piece.weight * (moved.squaredNorm() + std::pow(piece.length, 2) * rotation_vector(at.turn[p]).squaredNorm());
      }
    return 0.5 * twice / (length * length);
  }



  Eigen::SparseMatrix<double>
  Assembly::weights_at(const Place &at) const
  {
    std::vector<Eigen::Triplet<double>> entries;
    for (unsigned int p = 1; p < of_piece.size(); ++p)
      {
        const Piece &piece = of_piece[p];
        if (piece.is_fixed)
          continue;
        // of (v/L, ω) at the middle of the nodes; ċ = v + ω × arm
        Matrix6                     W = Matrix6::Zero();
        Eigen::Matrix<double, 3, 6> of_centre;
        of_centre << Matrix3::Identity(), -skew((at.turn[p] * (piece.centre - piece.middle) / length).eval());
        W = of_centre.transpose() * of_centre;
        W.bottomRightCorner<3, 3>() += std::pow(piece.length / length, 2) * Matrix3::Identity();
        const int first = column[6 * (p - 1)];
        for (int j = 0; j < 6; ++j)
          for (int i = 0; i < 6; ++i)
            entries.emplace_back(first + i, first + j, piece.weight * W(i, j));
      }
    for (unsigned int c = 0; c < system.layout.n_coordinates; ++c)
      entries.emplace_back(column[pieces.column_of_coordinate(c)],
                           column[pieces.column_of_coordinate(c)],
                           weight_of_coordinates);
    Eigen::SparseMatrix<double> W(n_open, n_open);
    W.setFromTriplets(entries.begin(), entries.end());
    return W;
  }



  Eigen::VectorXd
  Assembly::gradient_at(const Place &at) const
  {
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(n_open);
    for (unsigned int p = 1; p < of_piece.size(); ++p)
      {
        const Piece &piece = of_piece[p];
        if (piece.is_fixed)
          continue;
        const Vector3 arm = at.turn[p] * (piece.centre - piece.middle), moved = at.middle[p] + arm - piece.centre;
        // the vector of a rotation is along its axis: the derivative of half its square is the vector itself
        const Vector3 turned = std::pow(piece.length, 2) * rotation_vector(at.turn[p]) + arm.cross(moved);
        gradient.segment<3>(column[6 * (p - 1)])     = piece.weight * moved / length;
        gradient.segment<3>(column[6 * (p - 1)] + 3) = piece.weight * turned / (length * length);
      }
    return gradient;
  }



  Assembly::Place
  Assembly::moved(const Place &from, const Eigen::VectorXd &step) const
  {
    Place to = from;
    for (unsigned int p = 1; p < of_piece.size(); ++p)
      if (!of_piece[p].is_fixed)
        {
          const int     first = column[6 * (p - 1)];
          const Vector3 turn  = step.segment<3>(first + 3);
          to.middle[p] += length * step.segment<3>(first);
          to.turn[p] = Eigen::Quaterniond(cayley<double>(turn) * from.turn[p]).normalized().toRotationMatrix();
        }
    for (unsigned int c = 0; c < system.layout.n_coordinates; ++c)
      to.coordinates[c] += pieces.coordinate_unit(c) * step(column[pieces.column_of_coordinate(c)]);
    State state = state_at(to);
    system.update(state, std::vector<double>(system.size(), 0.)); // angles count turns and follow the nodes
    to.coordinates = state.coordinates;
    return to;
  }



  bool
  Assembly::fits() const
  {
    const auto g = gaps_at(state_at(drawing()));
    return g.size() == 0 || g.lpNorm<Eigen::Infinity>() <= 1e-12; // of the model's size: no gap but round-off
  }



  double
  Assembly::distance() const
  {
    return length * std::sqrt(2 * distance_at(place));
  }



  Placement
  Assembly::motion_of(const unsigned int node) const
  {
    constexpr double   round_off_of_steps = 1e-14;
    const unsigned int p                  = piece_of_node(node);
    if (of_piece[p].is_fixed || ((place.turn[p] - Matrix3::Identity()).norm() < round_off_of_steps &&
                                 (place.middle[p] - of_piece[p].middle).norm() < round_off_of_steps * length))
      return {};
    return {place.turn[p], place.middle[p] - place.turn[p] * of_piece[p].middle};
  }
} // namespace samara
