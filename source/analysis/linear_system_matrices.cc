#include <samara/analysis/linear_system_matrices.h>
#include <samara/base/dense.h>
#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/model/algebraic_states.h>
#include <samara/model/probe_needs.h>
#include <samara/time/increment.h>
#include <samara/time/projection.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    using Eigen::MatrixXd, Eigen::VectorXd;

    /** Of a basis of positions: a mass that is smaller than this, of the largest, is none. */
    constexpr double least_mass = 1e-13;

    /** Of differences of probes, in units of the motion: their errors are of its fourth power. */
    constexpr double step_of_outputs = 1e-3;



    /** M, Γ and K with all that materials add, in units of the motion; K also has the rows and columns of G. */
    struct DenseMotion
    {
      MatrixXd M, damping, K, G;

      explicit DenseMotion(const LinearMotion &motion)
        : M(motion.M.dense())
        , damping(motion.gyroscopic.dense())
        , K(motion.S.dense())
      {
        const int n = motion.n_kinematic;
        M.conservativeResize(n, n);
        damping.conservativeResize(n, n);
        G = K.bottomLeftCorner(K.rows() - n, n);
        K.conservativeResize(n, n);
        for (const auto &p : motion.strains.points)
          add_material(motion, p);
        const Eigen::Map<const VectorXd> units(motion.units.data(), n);
        for (auto *const A : {&M, &damping, &K})
          *A = units.asDiagonal() * *A * units.asDiagonal();
        G = G * units.asDiagonal();
      }

    private:
      /** Bᵀ w C B, Bᵀ w C_d B, and Bᵀ w C_d Ḃ, of the columns that the rows of a point have. */
      void
      add_material(const LinearMotion &motion, const StrainRows::Point &p)
      {
        const auto               &strains = motion.strains;
        std::vector<unsigned int> columns;
        const auto                take = [&](const SparseRows &rows) {
          for (unsigned int k = rows.start[p.first_row]; k < rows.start[p.first_row + p.size]; ++k)
            columns.push_back(rows.columns[k]);
        };
        take(strains.B);
        const bool has_rates = motion.B_dot.n_rows() > 0;
        if (has_rates)
          take(motion.B_dot);
        std::sort(columns.begin(), columns.end());
        columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
        const auto block = [&](const SparseRows &rows) {
          MatrixXd result = MatrixXd::Zero(p.size, columns.size());
          for (unsigned int i = 0; i < p.size; ++i)
            for (unsigned int k = rows.start[p.first_row + i]; k < rows.start[p.first_row + i + 1]; ++k)
              result(i, std::lower_bound(columns.begin(), columns.end(), rows.columns[k]) - columns.begin()) +=
                rows.values[k];
          return result;
        };
        const MatrixXd B = block(strains.B), C = p.weight * MatrixXd(strains.C(p)),
                       C_d = p.weight * MatrixXd(strains.C_d(p));
        MatrixXd stiffness = B.transpose() * C * B;
        if (has_rates)
          stiffness += B.transpose() * C_d * block(motion.B_dot);
        const MatrixXd viscosity = B.transpose() * C_d * B;
        for (unsigned int i = 0; i < columns.size(); ++i)
          for (unsigned int j = 0; j < columns.size(); ++j)
            {
              K(columns[i], columns[j]) += stiffness(i, j);
              damping(columns[i], columns[j]) += viscosity(i, j);
            }
      }
    };



    /** An orthonormal basis of what obeys the constraints, of the first @p n numbers. */
    MatrixXd
    positions_allowed(const MatrixXd &G, const int n)
    {
      MatrixXd rows = G.leftCols(n);
      for (int i = 0; i < rows.rows(); ++i)
        if (const double norm = rows.row(i).norm(); norm > 0)
          rows.row(i) /= norm;
      if (rows.rows() == 0)
        return MatrixXd::Identity(n, n);
      // rows have length one: a pivot below is a row that the others imply
      const PivotedQr qr(rows.transpose(), 1e-10);
      return qr.Q().rightCols(n - qr.rank());
    }



    /** Take out algebraic states: what they follow stands in their place. */
    void
    eliminate_algebraic(const System &system, MatrixXd &K, MatrixXd &damping)
    {
      std::vector<int> rows;
      for (const unsigned int i : algebraic_states(system.model))
        rows.push_back(system.layout.of_state(i));
      if (rows.empty())
        return;
      const MatrixXd                   K_rows = K(rows, Eigen::all), C_rows = damping(rows, Eigen::all);
      const FullLu                     of_rows(K_rows(Eigen::all, rows));
      const MatrixXd                   factors = K(Eigen::all, rows);
      if (!of_rows.is_invertible())
        throw NotConverged("linear system: what the state <" + system.layout.name_of(rows.front()) +
                           "> follows at once does not determine it");
      K -= factors * of_rows.solve(K_rows);
      damping -= factors * of_rows.solve(C_rows);
    }



    /** Numbers of states of first order that move, with rates of their own. */
    std::vector<unsigned int>
    moving_states(const LinearSystemSource &source)
    {
      std::vector<unsigned int> result;
      for (unsigned int i = 0; i < source.system.layout.n_states; ++i)
        if (!source.system.model.states[i].is_algebraic &&
            std::find(source.controls.begin(), source.controls.end(), i) == source.controls.end())
          result.push_back(i);
      return result;
    }



    /** The unknown whose share in the null vector of a singular mass is largest. */
    std::string
    massless_unknown(const System &system, const MatrixXd &basis, const VectorXd &direction)
    {
      Eigen::Index worst;
      VectorXd(basis * direction).cwiseAbs().maxCoeff(&worst);
      return system.layout.name_of(worst);
    }
  } // namespace



  void
  find_dynamics(const LinearSystemSource &source, LinearSystem &space, MatrixXd &basis)
  {
    const System &system = source.system;
    const Layout &layout = system.layout;
    DenseMotion   motion(source.linearization);
    const int     n = layout.n_kinematic();
    eliminate_algebraic(system, motion.K, motion.damping);
    basis             = positions_allowed(motion.G, n);
    const auto moving = moving_states(source);
    const int  m = basis.cols(), n_moving = moving.size(), size = 2 * m + n_moving, n_inputs = source.inputs.size();
    if (size > int(source.most_states))
      throw NotConverged("linear system: there are " + std::to_string(size) +
                         " states, and their matrices are dense; take fewer elements, or set more <Most states>");
    // rows and columns: z by its own scale
    MatrixXd Z = MatrixXd::Zero(motion.K.rows(), n_moving), U = MatrixXd::Zero(motion.K.rows(), n_inputs);
    for (int j = 0; j < n_moving; ++j)
      Z(layout.of_state(moving[j]), j) = 1;
    for (int j = 0; j < n_inputs; ++j)
      U(layout.of_state(source.inputs[j]), j) = 1. / system.model.states[source.inputs[j]].scale;
    MatrixXd P       = MatrixXd::Zero(motion.K.rows(), m);
    P.topRows(n)     = basis;
    const MatrixXd M = P.transpose() * motion.M * P;

    const HermitianEigen<double> of_mass = symmetric_eigen(M);
    if (m > 0 && !(of_mass.values(0) > least_mass * of_mass.values(m - 1)))
      throw NotConverged("linear system: something without mass moves, most at " +
                         massless_unknown(system, basis, of_mass.vectors.col(0)) +
                         ".\n  Give it a mass or an inertia; there is no acceleration that its forces make");
    const MatrixXd E       = Z.transpose() * motion.damping * Z;
    const Cholesky solve_M(M);
    const Lu       solve_E(E);

    const auto rates_of = [&](const MatrixXd &X, const MatrixXd &V) { // of displacements X and velocities V
      const MatrixXd f = motion.K * X + motion.damping * V;
      MatrixXd       result(m + n_moving, X.cols());
      result << (m > 0 ? MatrixXd(-solve_M.solve(P.transpose() * f)) : MatrixXd(0, X.cols())),
        (n_moving > 0 ? MatrixXd(-solve_E.solve(Z.transpose() * f)) : MatrixXd(0, X.cols()));
      return result;
    };
    // velocities of z stand in the equations of z alone
    space.n_positions = m;
    space.A           = MatrixXd::Zero(size, size);
    space.A.block(0, m, m, m).setIdentity();
    space.A.bottomLeftCorner(m + n_moving, m)         = rates_of(P, MatrixXd::Zero(P.rows(), m));
    space.A.block(m, m, m + n_moving, m)              = rates_of(MatrixXd::Zero(P.rows(), m), P);
    space.A.bottomRightCorner(m + n_moving, n_moving) = rates_of(Z, MatrixXd::Zero(P.rows(), n_moving));
    space.B                                           = MatrixXd::Zero(size, n_inputs);
    space.B.bottomRows(m + n_moving)                  = rates_of(U, MatrixXd::Zero(P.rows(), n_inputs));
    // from units of the motion to SI: states of first order by their scales
    for (int j = 0; j < n_moving; ++j)
      {
        const double scale = system.model.states[moving[j]].scale;
        space.A.row(2 * m + j) *= scale;
        space.A.col(2 * m + j) /= scale;
        space.B.row(2 * m + j) *= scale;
      }
  }



  namespace
  {
    /** The rate at which axes of a node turn in its own, of these spins: ζ̇ = η̇ − W η. */
    Vector6
    rate_by_axes(const State &state, const std::vector<Vector3> &spins, const unsigned int node, const Vector6 &zeta)
    {
      if (spins.empty())
        return Vector6::Zero();
      const Vector3 w = Eigen::Map<const Vector3>(&state.y[6 * node + 3]) - state.triad(node).transpose() * spins[node];
      Vector6       result;
      result << -w.cross(zeta.head<3>()), -w.cross(zeta.tail<3>());
      return result;
    }



    /** The increment of a state (increment.h) that a state vector x and inputs u are. */
    VectorXd
    increment_of_system(const LinearSystemSource        &source,
                        const MatrixXd                  &basis,
                        const std::vector<unsigned int> &moving,
                        const VectorXd                  &x,
                        const VectorXd                  &u)
    {
      const Layout                    &layout = source.system.layout;
      const int                        m = basis.cols(), n = layout.n_kinematic(), first = layout.of_multiplier(0);
      const Eigen::Map<const VectorXd> units(source.linearization.units.data(), n);
      VectorXd                         result = VectorXd::Zero(size_of_increment(layout));
      result.head(n)                          = units.cwiseProduct(basis * x.head(m));
      VectorXd rates                          = units.cwiseProduct(basis * x.segment(m, m));
      for (unsigned int node = 1; node < layout.n_nodes; ++node)
        {
          const int     row  = layout.of_node(node);
          const Vector6 zeta = result.segment<6>(row);
          rates.segment<6>(row) += rate_by_axes(source.state, source.spins, node, zeta) +
                                   ad(Eigen::Map<const Vector6>(&source.state.y[6 * node])) * zeta;
        }
      result.segment(first, n) = rates;
      for (unsigned int j = 0; j < moving.size(); ++j)
        result(layout.of_state(moving[j])) = x(2 * m + j);
      for (unsigned int j = 0; j < source.inputs.size(); ++j)
        result(layout.of_state(source.inputs[j])) = u(j);
      return result;
    }



    /** Values of probes in a state of motion, as they are reported. */
    class Outputs
    {
    public:
      Outputs(const System &system, const std::vector<Probe> &probes)
        : probes(probes)
        , needs(probes)
        , projection(system)
      {}

      VectorXd
      operator()(State state)
      {
        if (needs.velocities || needs.forces)
          projection.report(state, needs.forces);
        VectorXd y(probes.size());
        for (unsigned int i = 0; i < probes.size(); ++i)
          y(i) = probes[i].value(state);
        return y;
      }

    private:
      const std::vector<Probe> &probes;
      const ProbeNeeds          needs;
      Projection                projection;
    };
  } // namespace



  void
  find_outputs(const LinearSystemSource &source,
               const MatrixXd           &basis,
               const std::vector<Probe> &probes,
               LinearSystem             &space)
  {
    const System &system = source.system;
    const auto    moving = moving_states(source);
    const int     size = space.A.rows(), n_inputs = source.inputs.size();
    Outputs       values(system, probes);
    const auto    scales = scales_of_increment(system, 1.);
    const auto    change = [&](const VectorXd &x, const VectorXd &u) {
      const VectorXd z    = increment_of_system(source, basis, moving, x, u);
      double         most = 0;
      for (int i = 0; i < z.size(); ++i)
        most = std::max(most, std::abs(z(i)) / scales[i]);
      VectorXd sum = VectorXd::Zero(probes.size());
      if (!(most > 0))
        return sum;
      const double step = step_of_outputs / most;
      for (const int side : {1, -1})
        for (const int times : {1, 2})
          sum += side * (times == 1 ? 2. / 3 : -1. / 12) *
                 values(moved(system, source.state, z.data(), side * times * step));
      return VectorXd(sum / step);
    };
    space.output_values.clear();
    const VectorXd now = values(source.state);
    space.output_values.assign(now.data(), now.data() + now.size());
    space.C.resize(probes.size(), size);
    space.D.resize(probes.size(), n_inputs);
    for (int j = 0; j < size; ++j)
      space.C.col(j) = change(VectorXd::Unit(size, j), VectorXd::Zero(n_inputs));
    for (int j = 0; j < n_inputs; ++j)
      space.D.col(j) = change(VectorXd::Zero(size), VectorXd::Unit(n_inputs, j));
  }
} // namespace samara
