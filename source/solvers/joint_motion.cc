// Motions that joints make: what is common, and rigid pieces. All nodes: joint_motion_nodes.cc.

#include <samara/base/dense.h>
#include <samara/solvers/joint_motion.h>
#include <samara/solvers/newton.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Unknowns of pieces up to which dense matrices are the faster way. */
    constexpr unsigned int most_dense_unknowns = 400;

    /** Relative errors that count as nothing: of rates, of strains. Configurations are known to 1e-9. */
    constexpr double no_rate = 1e-6;

    State
    unstressed(const State &from)
    {
      State state = from;
      state.held  = true;
      std::fill(state.stress.begin(), state.stress.end(), 0.);
      std::fill(state.multipliers.begin(), state.multipliers.end(), 0.);
      std::fill(state.y.begin(), state.y.end(), 0.);
      state.factor = 0; // loads do not resist the motion
      state.left_out.clear();
      return state;
    }
  } // namespace



  JointMotion::JointMotion(const System &system, const State &from, const std::vector<double> &speeds)
    : velocities(system.size(), 0.)
    , system(system)
    , state(unstressed(from))
    , K(system.layout.pattern)
    , held(system.layout.n_multipliers, 0.)
    , length(model_length(system.model))
  {
    const Model &model = system.model;
    rates              = system.relative_rates(state.q.data());
    is_driven.assign(rates.size(), false);
    unsigned int hold = 0;
    for (unsigned int i = 0; i < speeds.size(); ++i)
      if (const int coordinate = model.rotations[i].coordinate; coordinate >= 0)
        {
          held[model.holds[hold++]] = speeds[i];
          speed                     = std::max(speed, std::abs(speeds[i]));
          for (unsigned int r = 0; r < rates.size(); ++r)
            is_driven[r] = is_driven[r] || rates[r].name == model.coordinates[coordinate];
        }
    system.tangent(state, K);

    RigidPieces pieces(system, length);
    pieces.renew(state);
    if (pieces.n_unknowns() > most_dense_unknowns || !move_pieces(pieces))
      {
        // sparse factors bear no redundant rows
        state.left_out = from.left_out;
        system.tangent(state, K);
        move_nodes();
      }
    find_moving();
  }



  double
  JointMotion::value_of(const RelativeRate &rate) const
  {
    double sum = 0;
    if (rate.a > 0)
      sum += rate.on_a.dot(Eigen::Map<const Vector6>(&velocities[system.layout.of_node(rate.a)]));
    if (rate.b > 0)
      sum += rate.on_b.dot(Eigen::Map<const Vector6>(&velocities[system.layout.of_node(rate.b)]));
    return sum;
  }



  double
  JointMotion::line_moves(const RelativeRate &rate) const
  {
    if (rate.line == RelativeRate::none)
      return 1;
    if (rate.node == 0)
      return 0;
    const Eigen::Map<const Vector6> y(&velocities[system.layout.of_node(rate.node)]);
    const Matrix3                   D     = state.triad(rate.node);
    const Vector3                   spin  = D * y.tail<3>();
    double                          moved = spin.cross(rate.along).norm();
    if (rate.line == RelativeRate::axis)
      {
        const Vector3 v = D * y.head<3>() + spin.cross(rate.through - state.position(rate.node));
        moved += rate.along.cross(v).norm() / length;
      }
    return std::min(1., moved / speed);
  }



  std::vector<double>
  JointMotion::weights() const
  {
    std::vector<double> result;
    for (const auto &rate : rates)
      result.push_back(line_moves(rate));
    return result;
  }



  double
  JointMotion::renew_weights(std::vector<double> &weight, const double smallest) const
  {
    const std::vector<double> old    = weight;
    double                    change = 0;
    weight                           = weights();
    for (unsigned int r = 0; r < weight.size(); ++r)
      {
        weight[r] = std::max(smallest, weight[r]);
        change    = std::max(change, std::abs(weight[r] - old[r]));
      }
    return change;
  }



  void
  JointMotion::find_strain()
  {
    // component by component, against what velocities in disorder would strain
    const Layout       &layout = system.layout;
    std::vector<double> disorder(layout.n_kinematic());
    for (unsigned int i = 0; i < disorder.size(); ++i)
      disorder[i] = speed * layout.scale_of(i, length) * std::cos(1. + 2.4 * i);
    const auto stresses = [&](const std::vector<double> &y) {
      std::vector<double> twists(6 * layout.n_nodes, 0.), e(layout.n_strains, 0.), none(e), result(e);
      std::copy_n(y.begin(), twists.size() - 6, twists.begin() + 6);
      Point<double> point = state.point();
      point.y             = twists.data();
      point.rates         = y.data() + layout.of_coordinate(0);
      system.strain_rates(point, e.data());
      system.stresses(e.data(), none.data(), result.data());
      return result;
    };
    findings.strain = 0;
    findings.strained.clear();
    const std::vector<double> stress = stresses(velocities), stress_of_disorder = stresses(disorder);
    for (unsigned int i = 0; i < stress.size(); ++i)
      if (stress_of_disorder[i] != 0. && std::abs(stress[i] / stress_of_disorder[i]) > findings.strain)
        {
          findings.strain   = std::abs(stress[i] / stress_of_disorder[i]);
          findings.strained = layout.item_of_strain(i).name;
        }
    if (findings.strain <= no_rate)
      findings.strained.clear();
  }



  void
  JointMotion::find_moving()
  {
    for (const auto &rate : rates)
      if (std::abs(value_of(rate)) > no_rate * speed * (rate.in_metres ? length : 1.) && line_moves(rate) > no_rate)
        findings.moving.push_back(rate.name);
  }



  void
  JointMotion::contradict(const Eigen::VectorXd &residual) const
  {
    const double worst = residual.cwiseAbs().maxCoeff();
    std::string  names;
    for (int i = 0; i < residual.size(); ++i)
      if (std::abs(residual(i)) > 0.05 * worst)
        names += "\n  " + system.layout.name_of_multiplier(i);
    throw InputError(
      "steady rotation: the speeds contradict each other, or what turns is locked, at:" + names +
      "\n  Look for a gear between two joints whose speeds are both given, or for axes that are out of line.");
  }



  void
  JointMotion::constraints_of_pieces(const RigidPieces &pieces, Eigen::MatrixXd &G, Eigen::VectorXd &c) const
  {
    const Layout &layout = system.layout;
    G.setZero(layout.n_multipliers, pieces.n_unknowns());
    c                     = Eigen::Map<const Eigen::VectorXd>(held.data(), held.size());
    Eigen::VectorXd sizes = Eigen::VectorXd::Zero(G.rows()); // of the rows, before anything cancels
    const int       first = layout.of_multiplier(0), first_coordinate = layout.of_coordinate(0);
    for (int j = 0; j < layout.n_kinematic(); ++j)
      for (int k = K.pattern->column_start[j]; k < K.pattern->column_start[j + 1]; ++k)
        if (const int row = K.pattern->rows[k] - first; row >= 0 && K.values[k] != 0.)
          {
            const double g = K.values[k];
            if (j >= first_coordinate)
              {
                const unsigned int i = j - first_coordinate;
                G(row, pieces.column_of_coordinate(i)) += g * pieces.coordinate_unit(i);
                sizes(row) += std::abs(g * pieces.coordinate_unit(i));
              }
            else
              {
                pieces.add_twist(j / 6 + 1, g * Row6::Unit(j % 6), G, row);
                sizes(row) += std::abs(g) * (j % 6 < 3 ? length : 1.);
              }
          }
    for (int row = 0; row < G.rows(); ++row)
      if (const double size = G.row(row).norm(); size > 1e-9 * sizes(row))
        {
          G.row(row) /= size;
          c(row) /= size;
        }
      else
        {
          G.row(row).setZero(); // within one piece
          c(row) = 0;
        }
  }



  Eigen::MatrixXd
  JointMotion::strains_of_pieces(const RigidPieces &pieces) const
  {
    // √C B of all that is strained between pieces, column by column
    const StrainRows             rows = system.strain_rows(state, System::Part::between_pieces);
    std::vector<Eigen::MatrixXd> roots;
    unsigned int                 n_rows = 0;
    for (const auto &p : rows.points)
      {
        const HermitianEigen<double> eigen = symmetric_eigen(p.weight * rows.C(p));
        roots.push_back(eigen.values.cwiseMax(0.).cwiseSqrt().asDiagonal() * eigen.vectors.transpose());
        n_rows += p.size;
      }
    Eigen::MatrixXd B(n_rows, pieces.n_unknowns());
    for (unsigned int j = 0; j < pieces.n_unknowns(); ++j)
      {
        const std::vector<double> y = pieces.velocities(Eigen::VectorXd::Unit(pieces.n_unknowns(), j));
        for (unsigned int k = 0; k < rows.points.size(); ++k)
          {
            const auto     &p = rows.points[k];
            Eigen::VectorXd e(p.size);
            for (unsigned int i = 0; i < p.size; ++i)
              e(i) = rows.B.row_times(p.first_row + i, y.data());
            B.col(j).segment(p.first_row, p.size) = roots[k] * e;
          }
      }
    const double largest = n_rows > 0 ? B.rowwise().norm().maxCoeff() : 0.;
    return largest > 0 ? Eigen::MatrixXd(B / largest) : B;
  }



  Eigen::MatrixXd
  JointMotion::rates_of_pieces(const RigidPieces &pieces) const
  {
    Eigen::MatrixXd W = Eigen::MatrixXd::Zero(rates.size(), pieces.n_unknowns());
    for (unsigned int r = 0; r < rates.size(); ++r)
      {
        const double unit = rates[r].in_metres ? 1 / length : 1.;
        pieces.add_twist(rates[r].a, unit * rates[r].on_a.transpose(), W, r);
        pieces.add_twist(rates[r].b, unit * rates[r].on_b.transpose(), W, r);
      }
    return W;
  }



  bool
  JointMotion::move_pieces(const RigidPieces &pieces)
  {
    Eigen::MatrixXd G;
    Eigen::VectorXd c;
    constraints_of_pieces(pieces, G, c);
    const Eigen::MatrixXd W = rates_of_pieces(pieces);
    LevelByLevel          strict(pieces.n_unknowns());
    strict.add(G, c);
    const Eigen::VectorXd residual = G * strict.solution() - c;
    if (residual.size() > 0 && residual.cwiseAbs().maxCoeff() > no_rate * speed)
      {
        if (pieces.are_flexible())
          return false;
        contradict(residual);
      }
    strict.add(strains_of_pieces(pieces));
    const Eigen::MatrixXd open = strict.open();

    Eigen::MatrixXd carriers = Eigen::MatrixXd::Zero(0, pieces.n_unknowns());
    for (unsigned int r = 0; r < rates.size(); ++r)
      if (is_driven[r] && rates[r].a > 0 && pieces.column_of_node(rates[r].a) >= 0)
        {
          carriers.conservativeResizeLike(Eigen::MatrixXd::Zero(carriers.rows() + 6, carriers.cols()));
          carriers.block<6, 6>(carriers.rows() - 6, pieces.column_of_node(rates[r].a)).setIdentity();
        }

    std::vector<double> weight(rates.size(), 1.);
    // weights follow from the motion and the motion from them: one to three rounds (doc/theory/steady_rotation.md)
    for (unsigned int round = 0; round < 50; ++round)
      {
        LevelByLevel levels = strict;
        levels.add(Eigen::Map<Eigen::VectorXd>(weight.data(), weight.size()).asDiagonal() * W);
        findings.n_at_rest = levels.open().cols();
        levels.add(carriers);
        velocities = pieces.velocities(levels.solution());
        if (renew_weights(weight, 1e-6) < 1e-6)
          break;
      }
    find_strain();
    if (!findings.strained.empty() && pieces.are_flexible())
      return false;
    find_shared(W, open);
    return true;
  }



  void
  JointMotion::find_shared(const Eigen::MatrixXd &W, const Eigen::MatrixXd &open)
  {
    // directions that are open after the strains and change no rate about a moving line
    const std::vector<double> weight = weights();
    LevelByLevel              about_resting(open.cols());
    Eigen::MatrixXd           moving = W * open;
    for (unsigned int r = 0; r < rates.size(); ++r)
      if (weight[r] <= no_rate)
        moving.row(r).setZero();
    about_resting.add(moving);
    const Eigen::MatrixXd exchange = W * (open * about_resting.open());
    for (unsigned int r = 0; r < rates.size() && exchange.cols() > 0; ++r)
      if (std::abs(value_of(rates[r])) > no_rate * speed * (rates[r].in_metres ? length : 1.) &&
          exchange.row(r).cwiseAbs().maxCoeff() > no_rate)
        findings.shared.push_back(rates[r].name);
    if (findings.shared.size() < 2)
      findings.shared.clear();
  }
} // namespace samara
