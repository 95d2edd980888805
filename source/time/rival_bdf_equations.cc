#include <samara/time/rival_bdf.h>

#include <algorithm>
#include <array>
#include <cmath>

// The equations that IDA solves and the matrix of their linearisation.

namespace samara
{
  namespace
  {
    Eigen::Quaterniond
    quaternion(const double *const z, const unsigned int node)
    {
      const double *const p = z + 7 * (node - 1) + 3;
      return {p[0], p[1], p[2], p[3]}; // the scalar first
    }

    /** p̄ r/|p|² */
    Eigen::Quaterniond
    divided(const Eigen::Quaterniond &p, const Eigen::Quaterniond &r)
    {
      Eigen::Quaterniond result = p.conjugate() * r;
      result.coeffs() /= p.squaredNorm();
      return result;
    }
  } // namespace



  void
  Bdf::pack(const State &state, const std::vector<double> &accelerations, double *const z, double *const z_dot) const
  {
    const Layout &layout = system.layout;
    std::fill(z, z + size, 0.);
    std::fill(z_dot, z_dot + size, 0.);
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      {
        const unsigned int       i = 7 * (node - 1);
        const Matrix3            D = state.triad(node);
        const Eigen::Quaterniond p(D);
        const Vector3            v     = Eigen::Map<const Vector3>(&state.y[6 * node]),
                      spin             = Eigen::Map<const Vector3>(&state.y[6 * node + 3]);
        const Eigen::Quaterniond p_dot = p * Eigen::Quaterniond(0, 0.5 * spin(0), 0.5 * spin(1), 0.5 * spin(2));
        Eigen::Map<Vector3>(z + i)     = state.position(node);
        Eigen::Map<Vector3>(z_dot + i) = D * v;
        Eigen::Map<Eigen::Vector4d>(z + i + 3) << p.w(), p.vec();
        Eigen::Map<Eigen::Vector4d>(z_dot + i + 3) << p_dot.w(), p_dot.vec();
      }
    for (unsigned int i = 0; i < layout.n_coordinates; ++i)
      {
        z[n_poses + i]     = state.coordinates[i];
        z_dot[n_poses + i] = state.rates[i];
      }
    std::copy(state.y.begin() + 6, state.y.end(), z + of_velocities);
    std::copy(state.rates.begin(), state.rates.end(), z + of_velocities + state.y.size() - 6);
    std::copy(accelerations.begin(), accelerations.end(), z_dot + of_velocities);
    std::copy(state.multipliers.begin(), state.multipliers.end(), z + of_multipliers);
  }



  void
  Bdf::unpack(const double time, const double *const z, State &state) const
  {
    const Layout &layout = system.layout;
    state.time           = time;
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      {
        Eigen::Map<Vector3>(&state.q[12 * node])     = Eigen::Map<const Vector3>(z + 7 * (node - 1));
        Eigen::Map<Matrix3>(&state.q[12 * node + 3]) = quaternion(z, node).normalized().toRotationMatrix();
      }
    std::copy_n(z + n_poses, layout.n_coordinates, state.coordinates.begin());
    std::copy_n(z + of_velocities, state.y.size() - 6, state.y.begin() + 6);
    std::copy_n(z + of_velocities + state.y.size() - 6, layout.n_coordinates, state.rates.begin());
    std::copy_n(z + of_multipliers, layout.n_multipliers, state.multipliers.begin());
  }



  Vector6
  Bdf::rate_of_pose(const double *const z, const double *const z_dot, const unsigned int node) const
  {
    Vector6 rate;
    rate << work.triad(node).transpose() * Eigen::Map<const Vector3>(z_dot + 7 * (node - 1)),
      2 * divided(quaternion(z, node), quaternion(z_dot, node)).vec();
    return rate;
  }



  State
  Bdf::after_time(const State &state, const double dt) const
  {
    State moved = state;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      rivals::move(moved, node, dt * Eigen::Map<const Vector6>(&state.y[6 * node]));
    for (unsigned int i = 0; i < state.rates.size(); ++i)
      moved.coordinates[i] += dt * state.rates[i];
    moved.time += dt;
    return moved;
  }



  double
  Bdf::difference_time(const State &state) const
  {
    // nothing turns by more than a thousandth
    double fastest = 1e-3;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      fastest = std::max(fastest, Eigen::Map<const Vector3>(&state.y[6 * node + 3]).norm());
    for (const double rate : state.rates)
      fastest = std::max(fastest, std::abs(rate));
    return 1e-3 / fastest;
  }



  std::vector<double>
  Bdf::acceleration_constraints(const State &state, const std::vector<double> &y_dot) const
  {
    // the rates of the constraints on the path with constant ẏ, by differences of fourth order
    const double        dt = difference_time(state);
    std::vector<double> result(system.layout.n_multipliers, 0.);
    for (const auto &[steps, weight] : std::array<std::pair<double, double>, 4>{{{-2, 1}, {-1, -8}, {1, 8}, {2, -1}}})
      {
        State moved = after_time(state, steps * dt);
        for (unsigned int i = 6; i < state.y.size(); ++i)
          moved.y[i] += steps * dt * y_dot[i - 6];
        for (unsigned int i = 0; i < state.rates.size(); ++i)
          moved.rates[i] += steps * dt * y_dot[system.layout.of_coordinate(i)];
        const std::vector<double> rates = rivals::constraint_rates(system, moved);
        for (unsigned int i = 0; i < rates.size(); ++i)
          result[i] += weight * rates[i] / (12 * dt);
      }
    return result;
  }



  std::vector<double>
  Bdf::constraint_forces(const State &state, const double *const mu) const
  {
    const std::vector<double> zeros(system.layout.n_multipliers, 0.);
    std::vector<double>       with(system.size() + 6, 0.), without(system.size() + 6, 0.);
    Point<double>             point = state.point();
    point.multipliers               = zeros.data();
    system.add_constraints(point, without.data());
    point.multipliers = mu;
    system.add_constraints(point, with.data());
    for (unsigned int i = 0; i < with.size(); ++i)
      with[i] -= without[i];
    return with;
  }



  void
  Bdf::residual(const double time, const double *const z, const double *const z_dot, double *const r)
  {
    const Layout &layout = system.layout;
    const int     n      = layout.of_multiplier(0);
    unpack(std::min(time, last_time), z, work);
    std::vector<double> force;
    system.stresses(work, work.stress);
    system.residual(work, work.stress, force);
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      Eigen::Map<Vector6>(&force[6 * (node - 1)]) +=
        system.model.nodes[node].inertia * Eigen::Map<const Vector6>(z_dot + of_velocities + 6 * (node - 1));
    std::copy_n(force.begin(), n, r + of_velocities);

    const bool                is_index_1 = form == Form::index_1;
    const std::vector<double> forces_of_mu =
      is_index_1 ? std::vector<double>(n, 0.) : constraint_forces(work, z + of_second_multipliers);
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      {
        const unsigned int  i = 7 * (node - 1);
        Vector6             d = rate_of_pose(z, z_dot, node) - Eigen::Map<const Vector6>(&work.y[6 * node]);
        Eigen::Map<Vector6> row(r + i);
        row =
          is_index_1 ?
            d :
            Vector6(system.model.nodes[node].inertia * d + Eigen::Map<const Vector6>(&forces_of_mu[6 * (node - 1)]));
        r[i + 6] = divided(quaternion(z, node), quaternion(z_dot, node)).w();
      }
    for (unsigned int i = 0; i < layout.n_coordinates; ++i)
      r[n_poses + i] = z_dot[n_poses + i] - work.rates[i] + forces_of_mu[layout.of_coordinate(i)];

    if (is_index_1)
      {
        const std::vector<double> rows =
          acceleration_constraints(work, std::vector<double>(z_dot + of_velocities, z_dot + of_velocities + n));
        for (unsigned int i = 0; i < layout.n_multipliers; ++i)
          r[of_multipliers + i] = is_active[i] ? rows[i] : z[of_multipliers + i];
        return;
      }
    const std::vector<double> rates = rivals::constraint_rates(system, work);
    for (unsigned int i = 0; i < layout.n_multipliers; ++i)
      {
        r[of_multipliers + i] = is_active[i] ? rates[i] : z[of_multipliers + i];
        r[of_second_multipliers + i] =
          is_active[i] && !is_nonholonomic[i] ? force[layout.of_multiplier(i)] : z[of_second_multipliers + i];
      }
  }



  void
  Bdf::make_kinematic_blocks(const double        cj,
                             const double *const z,
                             const double *const z_dot,
                             SparseMatrix       &kinematics,
                             SparseMatrix       &weights)
  {
    const Layout &layout = system.layout;
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      {
        const Vector6 rate = rate_of_pose(z, z_dot, node);
        Matrix6       E    = cj * Matrix6::Identity();
        E.topRightCorner<3, 3>() += skew(rate.head<3>());
        E.bottomRightCorner<3, 3>() += 0.5 * skew(rate.tail<3>());
        jacobian.kinematics[node] = E;
        const Matrix6 weight = form == Form::index_1 ? Matrix6(Matrix6::Identity()) : system.model.nodes[node].inertia;
        rivals::add_to_node(kinematics, layout, node, weight * E);
        rivals::add_to_node(weights, layout, node, weight);
      }
    for (unsigned int i = 0; i < layout.n_coordinates; ++i)
      {
        const int row      = layout.of_coordinate(i);
        const int position = layout.pattern->position(row, row);
        kinematics.values[position] += cj;
        weights.values[position] += 1;
      }
  }



  void
  Bdf::add_change_of_constraints(SparseMatrix &change) const
  {
    // G ad_y: the columns of a node have their rows in common
    const Layout &layout = system.layout;
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      {
        const Matrix6 A     = ad(Eigen::Map<const Vector6>(&work.y[6 * node]));
        const int     first = layout.of_node(node), start = K.pattern->column_start[first],
                  length = K.pattern->column_start[first + 1] - start;
        for (int k = 0; k < length; ++k)
          for (int a = 0; a < 6; ++a)
            for (int b = 0; b < 6; ++b)
              change.values[start + b * length + k] += K.values[start + a * length + k] * A(a, b);
      }
  }



  void
  Bdf::fill_matrix(const double        cj,
                   const double        dt,
                   const SparseMatrix &kinematics,
                   const SparseMatrix &weights,
                   const SparseMatrix &carried)
  {
    const int  n               = system.layout.of_multiplier(0);
    const bool is_index_1      = form == Form::index_1;
    const auto is_inactive_row = [&](const int row) { return row >= n && !is_active[row - n]; };
    matrix.clear();
    matrix.add(0, 0, [&](const int i, const int j, const int k) {
      if (i < n && j < n)
        return kinematics.values[k];
      if (is_index_1 || is_inactive_row(i) || is_inactive_row(j) || (i >= n && is_nonholonomic[i - n]))
        return i == j ? 1. : 0.;
      return K.values[k];
    });
    matrix.add(0, 1, [&](const int i, const int j, const int k) { return i < n && j < n ? -weights.values[k] : 0.; });
    matrix.add(1, 0, [&](const int i, const int j, const int k) {
      if (i < n && j < n)
        return K.values[k];
      // the rates of constraints by positions
      if (i >= n && j < n && !is_inactive_row(i) && !is_index_1)
        return (after.values[k] - before.values[k]) / (2 * dt) - carried.values[k];
      return 0.;
    });
    matrix.add(1, 1, [&](const int i, const int j, const int k) {
      if (i < n && j < n)
        return cj * M.values[k] + C.values[k];
      if (is_inactive_row(i) || is_inactive_row(j))
        return i == j ? 1. : 0.;
      if (i >= n && j < n && is_index_1)
        return cj * K.values[k] + (after.values[k] - before.values[k]) / dt - carried.values[k];
      return K.values[k];
    });
  }



  void
  Bdf::make_jacobian(const double time, const double cj, const double *const z, const double *const z_dot)
  {
    const Layout &layout = system.layout;
    unpack(std::min(time, last_time), z, work);
    system.stresses(work, work.stress);
    jacobian.cj = cj;
    jacobian.p.assign(z, z + n_poses);
    jacobian.kinematics.assign(layout.n_nodes, Matrix6::Zero());

    // forces by positions, and by velocities, in the nodes' frames
    State at_rest = work;
    std::fill(at_rest.y.begin(), at_rest.y.end(), 0.);
    system.tangent(at_rest, K);
    system.damping(at_rest, C);
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      rivals::add_to_node(C,
                          layout,
                          node,
                          gyroscopic_tangent(system.model.nodes[node].inertia,
                                             Eigen::Map<const Vector6>(&work.y[6 * node])));
    // change of G along the motion
    const double dt = difference_time(work);
    for (const double sign : {-1., 1.})
      {
        State moved = after_time(work, sign * dt);
        std::fill(moved.y.begin(), moved.y.end(), 0.);
        std::fill(moved.multipliers.begin(), moved.multipliers.end(), 0.);
        system.tangent(moved, sign < 0 ? before : after);
      }
    SparseMatrix kinematics(layout.pattern), weights(layout.pattern), carried(layout.pattern);
    make_kinematic_blocks(cj, z, z_dot, kinematics, weights);
    add_change_of_constraints(carried);
    fill_matrix(cj, dt, kinematics, weights, carried);
    matrix.factorize();
    ++n_factorizations;
  }



  void
  Bdf::solve(double *const b) const
  {
    const Layout       &layout = system.layout;
    const unsigned int  n = system.size(), n_velocities = layout.of_multiplier(0);
    const bool          is_index_1 = form == Form::index_1;
    std::vector<double> x(2 * n, 0.);
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      {
        const Eigen::Map<const Vector6> row(b + 7 * (node - 1));
        std::copy_n(row.data(), 6, x.begin() + 6 * (node - 1));
      }
    std::copy_n(b + n_poses, layout.n_coordinates, x.begin() + layout.of_coordinate(0));
    std::copy_n(b + of_velocities, n_velocities, x.begin() + n);
    for (unsigned int i = 0; i < layout.n_multipliers; ++i)
      {
        x[n + n_velocities + i] = b[of_multipliers + i];
        if (!is_index_1)
          x[n_velocities + i] = b[of_second_multipliers + i];
      }
    matrix.solve(x.data());
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      {
        const unsigned int       i       = 7 * (node - 1);
        const Eigen::Quaterniond p       = quaternion(jacobian.p.data(), node);
        const Vector3            u       = Eigen::Map<const Vector3>(&x[6 * (node - 1)]),
                      phi                = Eigen::Map<const Vector3>(&x[6 * (node - 1) + 3]);
        const double             stretch = b[i + 6] / jacobian.cj;
        const Eigen::Quaterniond d       = p * Eigen::Quaterniond(stretch, 0.5 * phi(0), 0.5 * phi(1), 0.5 * phi(2));
        Eigen::Map<Vector3>(b + i)       = p.normalized().toRotationMatrix() * u;
        Eigen::Map<Eigen::Vector4d>(b + i + 3) << d.w(), d.vec();
      }
    std::copy_n(x.begin() + layout.of_coordinate(0), layout.n_coordinates, b + n_poses);
    std::copy_n(x.begin() + n, n_velocities, b + of_velocities);
    for (unsigned int i = 0; i < layout.n_multipliers; ++i)
      {
        b[of_multipliers + i] = x[n + n_velocities + i];
        if (!is_index_1)
          b[of_second_multipliers + i] = x[n_velocities + i];
      }
  }
} // namespace samara
