#include <samara/analysis/check.h>
#include <samara/analysis/controls.h>
#include <samara/analysis/linearization.h>
#include <samara/solvers/frequency_scale.h>
#include <samara/solvers/newton.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace samara
{
  namespace
  {
    /** The constant rate at which each node turns in its axes, of these @p spins, blockdiag(Ω~, Ω~). */
    Matrix6
    turning(const State &state, const std::vector<Vector3> &spins, const unsigned int node)
    {
      Matrix6 W               = Matrix6::Zero();
      W.topLeftCorner<3, 3>() = W.bottomRightCorner<3, 3>() =
        skew(Eigen::Map<const Vector6>(&state.y[6 * node]).tail<3>() - state.triad(node).transpose() * spins[node]);
      return W;
    }



    /** B += factor · A W, W block diagonal with one block for each node. */
    void
    add_times_turning(const System               &system,
                      const State                &state,
                      const std::vector<Vector3> &spins,
                      const double                factor,
                      const SparseMatrix         &A,
                      SparseMatrix               &B)
    {
      const Pattern &pattern = *A.pattern;
      for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
        {
          const Matrix6 W     = factor * turning(state, spins, node);
          const int     first = system.layout.of_node(node);
          // the six columns of a node have the same rows, as all couplings are by nodes
          const int                               n = pattern.column_start[first + 1] - pattern.column_start[first];
          const Eigen::Map<const Eigen::MatrixXd> a(&A.values[pattern.column_start[first]], n, 6);
          Eigen::Map<Eigen::MatrixXd>             b(&B.values[pattern.column_start[first]], n, 6);
          b += a * W;
        }
    }



    /** −B W, row by row. */
    SparseRows
    minus_times_turning(const System               &system,
                        const State                &state,
                        const std::vector<Vector3> &spins,
                        const SparseRows           &B)
    {
      const unsigned int n_nodal = system.layout.of_coordinate(0);
      SparseRows         result;
      for (unsigned int i = 0; i < B.n_rows(); ++i)
        {
          result.begin_row();
          for (unsigned int k = B.start[i]; k < B.start[i + 1]; ++k)
            if (B.columns[k] < n_nodal)
              {
                const unsigned int node = B.columns[k] / 6;
                const Matrix6      W    = turning(state, spins, node + 1);
                for (unsigned int j = 0; j < 6; ++j)
                  if (W(B.columns[k] % 6, j) != 0.)
                    result.add_entry(6 * node + j, -B.values[k] * W(B.columns[k] % 6, j));
              }
        }
      return result;
    }



    std::vector<double>
    units_of(const System &system)
    {
      const double        length = model_length(system.model);
      std::vector<double> units(system.layout.of_multiplier(0));
      for (unsigned int i = 0; i < units.size(); ++i)
        units[i] = system.layout.scale_of(i, length);
      return units;
    }



    /** The largest |Gᵀμ| of one unknown by its inertia, in the motion's units [1/s²]: of what S is a sum. */
    double
    acceleration_by_reactions(const LinearMotion &motion, const State &state)
    {
      const Pattern      &p = *motion.S.pattern;
      std::vector<double> force(motion.n_kinematic, 0.);
      for (int j = motion.n_kinematic; j < p.size(); ++j)
        for (int k = p.column_start[j]; k < p.column_start[j + 1]; ++k)
          if (p.rows[k] < static_cast<int>(motion.n_kinematic))
            force[p.rows[k]] += motion.S.values[k] * state.multipliers[j - motion.n_kinematic];
      double result = 0;
      for (unsigned int i = 0; i < motion.n_kinematic; ++i)
        if (const int k = motion.M.pattern->position(i, i); k >= 0 && motion.M.values[k] > 0.)
          result = std::max(result, std::abs(force[i]) / (motion.M.values[k] * motion.units[i]));
      return result;
    }



    /** Rows of what keeps its value in the equations of the system. */
    std::vector<unsigned int>
    rows_of_controls(const System &system)
    {
      std::vector<unsigned int> rows = states_of_controls(system);
      for (auto &row : rows)
        row = system.layout.of_state(row);
      return rows;
    }



    void
    clear_columns(const std::vector<unsigned int> &columns, SparseRows &B)
    {
      for (unsigned int k = 0; k < B.columns.size(); ++k)
        if (std::find(columns.begin(), columns.end(), B.columns[k]) != columns.end())
          B.values[k] = 0;
    }



    /** Make the equation of each control 0 = δz, and let nothing depend on it: it is no motion then. */
    void
    hold(const std::vector<unsigned int> &controls, LinearMotion &motion)
    {
      if (controls.empty())
        return;
      for (SparseMatrix *const A : {&motion.M, &motion.gyroscopic, &motion.S})
        for (const int i : controls)
          for (int k = A->pattern->column_start[i]; k < A->pattern->column_start[i + 1]; ++k)
            {
              A->values[k] = 0;
              // the pattern is symmetric
              A->values[A->pattern->position(i, A->pattern->rows[k])] = 0;
            }
      for (const int i : controls)
        motion.S.values[motion.S.pattern->position(i, i)] = 1;
      clear_columns(controls, motion.strains.B);
      clear_columns(controls, motion.B_dot);
    }
  } // namespace



  Linearization::Linearization(const System               &system,
                               const State                &state,
                               const std::vector<Vector3> &spins,
                               const Controls              controls)
    : LinearMotion{SparseMatrix(system.layout.pattern),
                   SparseMatrix(system.layout.pattern),
                   SparseMatrix(system.layout.pattern),
                   system.strain_rows(state),
                   {},
                   static_cast<unsigned int>(system.layout.of_multiplier(0)),
                   units_of(system)}
  {
    require_couplings(system);
    require_nearest_places(system, state);
    system.mass(M);
    system.damping(state, gyroscopic, false);
    system.tangent(state, S, false);
    acceleration = acceleration_by_reactions(*this, state);
    if (!spins.empty())
      turn_axes(system, state, spins);
    if (controls == Controls::held)
      hold(rows_of_controls(system), *this);
  }



  /** ζ = Rᵀη with R turning at W in the axes of η: ζ̇ = η̇ − Wη, ζ̈ = η̈ − 2Wη̇ + W²η. */
  void
  Linearization::turn_axes(const System &system, const State &state, const std::vector<Vector3> &spins)
  {
    SparseMatrix MW(system.layout.pattern);
    add_times_turning(system, state, spins, 1., M, MW);
    add_times_turning(system, state, spins, -1., gyroscopic, S);
    add_times_turning(system, state, spins, 1., MW, S);
    gyroscopic.add(-2., MW);
    if (strains.is_viscous())
      B_dot = minus_times_turning(system, state, spins, strains.B);
  }



  namespace
  {
    /** Stress resultants by the rows of B: w σ. */
    std::vector<double>
    resultants(const StrainRows &strains, const std::vector<double> &stress)
    {
      std::vector<double> q(strains.B.n_rows());
      for (const auto &p : strains.points)
        for (unsigned int i = 0; i < p.size; ++i)
          q[p.first_row + i] = p.weight * stress[p.first_strain + i];
      return q;
    }



    /** Σ |B_ik| in the motion's units: the size of a strain when nodes move by the model's size. */
    double
    size_of_row(const LinearMotion &motion, const unsigned int row)
    {
      const SparseRows &B    = motion.strains.B;
      double            size = 0;
      for (unsigned int k = B.start[row]; k < B.start[row + 1]; ++k)
        size += std::abs(B.values[k]) * motion.units[B.columns[k]];
      return size;
    }



    /**
     * The share of @p change in the strain energy of @p q, as if strains were not coupled. What is no more than 1e-8 of
     * the softest stiffness of its point does not count: as geometric stiffness it changes no mode, and may be
     * round-off.
     */
    double
    share_of_energy(const LinearMotion &motion, const std::vector<double> &change, const std::vector<double> &q)
    {
      const double epsilon = std::numeric_limits<double>::epsilon();
      double       part = 0, whole = 0;
      for (const auto &p : motion.strains.points)
        {
          const auto C       = motion.strains.C(p);
          double     softest = std::numeric_limits<double>::infinity();
          for (unsigned int i = 0; i < p.size; ++i)
            if (C(i, i) > 0)
              softest = std::min(softest, p.weight * C(i, i) * std::pow(size_of_row(motion, p.first_row + i), 2));
          for (unsigned int i = 0; i < p.size; ++i)
            if (C(i, i) > 0)
              {
                const unsigned int row = p.first_row + i;
                const double       k = p.weight * C(i, i), size = size_of_row(motion, row),
                             least = std::max(1e-8 * softest / size, 4 * epsilon * size * k);
                whole += q[row] * q[row] / k;
                if (std::abs(change[row]) > least)
                  part += change[row] * change[row] / k;
              }
        }
      return part > 0 ? part / whole : 0.;
    }



    /** Whether loads or inertia forces act: what is left of the residual without stresses and multipliers. */
    bool
    is_loaded(const System &system, State state)
    {
      std::vector<double> r;
      std::fill(state.multipliers.begin(), state.multipliers.end(), 0.);
      system.residual(state, std::vector<double>(system.layout.n_strains, 0.), r);
      return std::any_of(r.begin(), r.begin() + system.layout.n_kinematic(), [](const double f) { return f != 0.; });
    }
  } // namespace



  namespace
  {
    /** One step of the mixed Newton iteration from a state, and what it changes. */
    struct MixedStep
    {
      const Linearization motion;
      std::vector<double> x, change; ///< unknowns; stress resultants by the rows of B

      /** @param r the residual; @param lacking stresses beyond those of the strains, one a strain */
      MixedStep(const System &system, const State &at, const std::vector<double> &r, const std::vector<double> &lacking)
        : motion(system, at)
        , change(motion.strains.B.n_rows())
      {
        MixedMatrix matrix(motion);
        matrix.factorize(10 * frequency_scale(motion));
        x.assign(matrix.size(), 0.);
        std::transform(r.begin(), r.begin() + system.size(), x.begin(), [](const double r_i) { return -r_i; });
        // they keep what a trim has found, which is not what the file says
        for (const unsigned int row : rows_of_controls(system))
          x[row] = 0;
        matrix.add_strains_of(resultants(motion.strains, lacking).data(), x.data());
        matrix.solve(x.data());
        matrix.stresses(x.data(), change.data());
      }
    };



    /** The item whose stresses change most, by their energy. */
    std::string
    most_changed(const System &system, const MixedStep &step)
    {
      std::string name;
      double      most = 0;
      for (const auto &p : step.motion.strains.points)
        {
          const auto C      = step.motion.strains.C(p);
          double     energy = 0;
          for (unsigned int i = 0; i < p.size; ++i)
            if (C(i, i) > 0)
              energy += step.change[p.first_row + i] * step.change[p.first_row + i] / (p.weight * C(i, i));
          if (energy <= most)
            continue;
          most = energy;
          name = system.layout.item_of_strain(p.first_strain).name;
        }
      return name;
    }
  } // namespace



  Imbalance
  balance_stresses(const System &system, State &state)
  {
    State at = state;
    at.held  = true;
    std::vector<double> r, stress;
    system.residual(at, at.stress, r);
    system.stresses(at, stress);
    r.resize(system.size());
    if (stress == at.stress && std::all_of(r.begin(), r.end(), [](const double r_i) { return r_i == 0.; }))
      return {};
    for (unsigned int i = 0; i < stress.size(); ++i)
      stress[i] = at.stress[i] - stress[i];

    const MixedStep step(system, at, r, stress);
    const auto     &motion = step.motion;
    if (!is_loaded(system, at) && share_of_energy(motion, step.change, step.change) == 0.)
      return {}; // round-off in the places of nodes
    for (unsigned int i = 0; i < system.layout.n_multipliers; ++i)
      state.multipliers[i] += step.x[system.layout.of_multiplier(i)];
    for (const auto &p : motion.strains.points)
      for (unsigned int i = 0; i < p.size; ++i)
        state.stress[p.first_strain + i] += step.change[p.first_row + i] / p.weight;

    return {size_of_step(system, step.x, model_length(system.model), &state.states),
            share_of_energy(motion, step.change, resultants(motion.strains, state.stress)),
            most_changed(system, step)};
  }



  Imbalance
  balance_reactions(const System &system, State &state)
  {
    // the moments of drives that are free to move belong to the state
    State at = state;
    at.held  = true;
    std::vector<double> r;
    system.residual(at, at.stress, r);
    std::fill(r.begin() + system.layout.of_multiplier(0), r.end(), 0.);
    const MixedStep step(system, state, r, std::vector<double>(system.layout.n_strains, 0.));
    for (unsigned int i = 0; i < system.layout.n_multipliers; ++i)
      state.multipliers[i] += step.x[system.layout.of_multiplier(i)];
    return {size_of_step(system, step.x, model_length(system.model), &state.states),
            share_of_energy(step.motion, step.change, resultants(step.motion.strains, state.stress)),
            most_changed(system, step)};
  }
} // namespace samara
