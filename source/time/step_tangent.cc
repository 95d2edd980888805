// What a change at the start of a step, and of its stages, changes in the equations of the stages.

#include <samara/base/dense.h>
#include <samara/base/errors.h>
#include <samara/time/step_tangent.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace samara
{
  namespace
  {
    using Complex = std::complex<double>;

    constexpr double epsilon = 1e-30; ///< of complex steps

    /** Motions [rad, lengths of the model, scales of states] in a difference of constraints. */
    constexpr double step_of_differences = 5e-3;
    constexpr double agreement           = 1e-9; ///< of differences with one step and with half of it



    /** value + iε change */
    void
    shift(const std::vector<double> &value, const double *change, std::vector<Complex> &z)
    {
      z.resize(value.size());
      for (std::size_t i = 0; i < value.size(); ++i)
        z[i] = {value[i], epsilon * change[i]};
    }



    void
    shift(const std::vector<double> &value, const std::vector<double> &change, std::vector<Complex> &z)
    {
      shift(value, change.data(), z);
    }



    /** to += factor * from */
    void
    add(const double factor, const std::vector<double> &from, std::vector<double> &to)
    {
      for (std::size_t i = 0; i < to.size(); ++i)
        to[i] += factor * from[i];
    }



    double
    largest(const std::vector<double> &values)
    {
      double result = 0;
      for (const double value : values)
        result = std::max(result, std::abs(value));
      return result;
    }



    /** q̇ of a node, 12 numbers: D v, D Ω~. */
    void
    rates_of_node(const double *q, const double *y, double *q_rates)
    {
      const Eigen::Map<const Matrix3> D(q + 3);
      Eigen::Map<Vector3>(q_rates).noalias()     = D * Eigen::Map<const Vector3>(y);
      Eigen::Map<Matrix3>(q_rates + 3).noalias() = D * skew(Eigen::Map<const Vector3>(y + 3));
    }
  } // namespace



  StepTangent::StepTangent(StageIntegrator &integrator, const State &start, const double h)
    : integrator(integrator)
    , system(integrator.system)
    , tableau(integrator.tableau)
    , h(h)
    , start(start)
    , n_positions(system.layout.of_multiplier(0))
    , n_velocities(system.layout.n_kinematic())
    , stages(integrator.stages)
    , end_q(integrator.final_q)
    , end_coordinates(integrator.final_coordinates)
    , end_states(start.states)
    , mean_rates(integrator.mean_rates)
    , is_active(integrator.is_active)
    , turns(integrator.turns)
  {
    const unsigned int s = tableau.s, n_nodes = system.layout.n_nodes;
    for (unsigned int k = 0; k < s; ++k)
      for (unsigned int i = 0; i < end_states.size(); ++i)
        end_states[i] += integrator.final_weights(k) * (stages[k].states[i] - start.states[i]);

    // the matrices of the stage triads: [δD_1 … δD_s] (I − h W) = …, W with the blocks a_kl Ω~_l in row l and column k
    inverses.resize(std::size_t(9) * s * s * n_nodes);
    for (unsigned int node = 1; node < n_nodes; ++node)
      {
        Eigen::MatrixXd A = Eigen::MatrixXd::Identity(3 * s, 3 * s);
        for (unsigned int l = 0; l < s; ++l)
          for (unsigned int k = 0; k < s; ++k)
            A.block<3, 3>(3 * l, 3 * k) -=
              h * tableau.a(k, l) * skew(Eigen::Map<const Vector3>(&stages[l].y[6 * node + 3]));
        Eigen::Map<Eigen::MatrixXd>(&inverses[std::size_t(9) * s * s * node], 3 * s, 3 * s) = inverse(A);
      }

    Vector strains;
    system.strains(start, strains);
    change.q_rates = change.q = q_rates = std::vector<Vector>(s, Vector(12 * n_nodes, 0.));
    change.strain_rates = change.stress = std::vector<Vector>(s, Vector(system.layout.n_strains));
    change.coordinates                  = std::vector<Vector>(s, Vector(system.layout.n_coordinates));
    change.state_rates                  = std::vector<Vector>(s, Vector(system.layout.n_states));
    change.constraint_rates             = std::vector<Vector>(s);
    change.end_q.assign(12 * n_nodes, 0.);
    change.start_strain.assign(system.layout.n_strains, 0.);
    // a step that converged as predicted leaves those of the last correction but one
    for (auto &stage : stages)
      {
        system.strain_rates(stage.point(), stage.strain_rates.data());
        system.constraint_rates(stage.point(), stage.constraint_rates.data());
        if (turns)
          find_momenta(stage.y.data() + 6, stage.momenta);
      }
    StageIntegrator::find_products(integrator.products, tableau, h, strains, stages);
    for (unsigned int k = 0; k < s; ++k)
      {
        // the stresses that belong to the configurations, not those that Newton's method has come to
        e = strains;
        for (unsigned int l = 0; l < s; ++l)
          add(h * tableau.a_alpha(k, l), stages[l].strain_rates, e);
        for (unsigned int i = 0; i < integrator.products.size(); ++i)
          e[integrator.products[i].factor] = stages[k].factors[i];
        system.stresses(e.data(), stages[k].strain_rates.data(), stages[k].stress.data());
        for (unsigned int node = 1; node < n_nodes; ++node)
          rates_of_node(&stages[k].q[12 * node], &stages[k].y[6 * node], &q_rates[k][12 * node]);
      }
  }



  void
  StepTangent::find_momenta(const double *twists, Vector &momenta) const
  {
    const unsigned int n_nodes = system.layout.n_nodes;
    momenta.resize(6 * n_nodes);
    for (unsigned int node = 1; node < n_nodes; ++node)
      Eigen::Map<Vector6>(&momenta[6 * node]).noalias() =
        system.model.nodes[node].inertia * Eigen::Map<const Vector6>(twists + 6 * (node - 1));
  }



  void
  StepTangent::move_nodes(const double *x, const double *X)
  {
    const unsigned int s = tableau.s;
    Eigen::MatrixXd    right(3, 3 * s), dD(3, 3 * s);
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const int                       at = system.layout.of_node(node);
        const Eigen::Map<const Matrix3> D_start(&start.q[12 * node + 3]);
        Vector3                         dx_start = Vector3::Zero();
        Matrix3                         dD_start = Matrix3::Zero();
        if (x != nullptr)
          {
            dx_start = D_start * Eigen::Map<const Vector3>(x + at);
            dD_start = D_start * skew(Eigen::Map<const Vector3>(x + at + 3));
          }
        const auto D = [&](const unsigned int k) { return Eigen::Map<const Matrix3>(&stages[k].q[12 * node + 3]); };
        for (unsigned int k = 0; k < s; ++k)
          {
            right.middleCols<3>(3 * k) = dD_start;
            for (unsigned int l = 0; l < s; ++l)
              right.middleCols<3>(3 * k) += h * tableau.a(k, l) * D(l) * skew(Vector3(of_node(X, l, node).tail<3>()));
          }
        dD.noalias() =
          right * Eigen::Map<const Eigen::MatrixXd>(&inverses[std::size_t(9) * s * s * node], 3 * s, 3 * s);
        for (unsigned int k = 0; k < s; ++k)
          {
            // of q̇ = (D v, D Ω~)
            const Matrix3                   dD_k = dD.middleCols<3>(3 * k);
            const Eigen::Map<const Vector6> y(&stages[k].y[6 * node]);
            const Vector6                   dy                 = of_node(X, k, node);
            Eigen::Map<Vector3>(&change.q_rates[k][12 * node]) = dD_k * y.head<3>() + D(k) * dy.head<3>();
            Eigen::Map<Matrix3>(&change.q_rates[k][12 * node + 3]) =
              dD_k * skew(y.tail<3>()) + D(k) * skew(dy.tail<3>());
            Eigen::Map<Matrix3>(&change.q[k][12 * node + 3]) = dD_k;
          }
        Eigen::Map<Vector3> x_end(&change.end_q[12 * node]);
        Eigen::Map<Matrix3> D_end(&change.end_q[12 * node + 3]);
        x_end = dx_start;
        D_end = dD_start;
        for (unsigned int k = 0; k < s; ++k)
          {
            Eigen::Map<Vector3> x_k(&change.q[k][12 * node]);
            x_k = dx_start;
            for (unsigned int l = 0; l < s; ++l)
              x_k += h * tableau.a(k, l) * Eigen::Map<const Vector3>(&change.q_rates[l][12 * node]);
            x_end += h * tableau.b(k) * Eigen::Map<const Vector3>(&change.q_rates[k][12 * node]);
            D_end += h * tableau.b(k) * Eigen::Map<const Matrix3>(&change.q_rates[k][12 * node + 3]);
          }
      }
  }



  void
  StepTangent::move_others(const double *x, const double *X)
  {
    const Layout      &layout = system.layout;
    const unsigned int s = tableau.s, n = system.size();
    change.end_coordinates.assign(layout.n_coordinates, 0.);
    change.end_states.assign(layout.n_states, 0.);
    for (unsigned int i = 0; i < layout.n_coordinates; ++i)
      {
        const double from         = x != nullptr ? x[layout.of_coordinate(i)] : 0.;
        const auto   rate         = [&](const unsigned int l) { return X[l * n + layout.of_coordinate(i)]; };
        change.end_coordinates[i] = from;
        for (unsigned int k = 0; k < s; ++k)
          {
            change.coordinates[k][i] = from;
            for (unsigned int l = 0; l < s; ++l)
              change.coordinates[k][i] += h * tableau.a(k, l) * rate(l);
            change.end_coordinates[i] += h * tableau.b(k) * rate(k);
          }
      }
    for (unsigned int i = 0; i < layout.n_states; ++i)
      {
        const double from    = x != nullptr ? x[layout.of_state(i)] : 0.;
        const auto   moved   = [&](const unsigned int l) { return X[l * n + layout.of_state(i)] - from; };
        change.end_states[i] = from;
        for (unsigned int k = 0; k < s; ++k)
          {
            change.state_rates[k][i] = 0;
            for (unsigned int l = 0; l < s; ++l)
              change.state_rates[k][i] += tableau.w(k, l) / h * moved(l);
            change.end_states[i] += integrator.final_weights(k) * moved(k);
          }
      }
  }



  void
  StepTangent::find_stresses(const double *x, const double *X)
  {
    const Layout      &layout = system.layout;
    const unsigned int s = tableau.s, n = system.size();
    z_strain.resize(layout.n_strains);
    z_strain_2.resize(layout.n_strains);
    const auto strains = [&](const Stage &stage, std::vector<Complex> &result) {
      Point<Complex> point;
      point.q           = z_q.data();
      point.coordinates = z_coordinates.data();
      point.time        = stage.time;
      system.strains(point, result.data());
    };
    std::fill(change.start_strain.begin(), change.start_strain.end(), 0.);
    if (x != nullptr)
      {
        moved_q.assign(12 * layout.n_nodes, 0.);
        for (unsigned int node = 1; node < layout.n_nodes; ++node)
          rates_of_node(&start.q[12 * node], x + layout.of_node(node), &moved_q[12 * node]);
        shift(start.q, moved_q, z_q);
        shift(start.coordinates, x + layout.of_coordinate(0), z_coordinates);
        strains(stages[0], z_strain);
        for (unsigned int i = 0; i < layout.n_strains; ++i)
          change.start_strain[i] = z_strain[i].imag() / epsilon;
      }
    // ė = (e(q + τ q̇) − e(q − τ q̇))/(2τ) for any τ, as strains are quadratic
    const double tau = h;
    for (unsigned int k = 0; k < s; ++k)
      {
        const double *const rate_changes = X + k * n + layout.of_coordinate(0);
        for (const double side : {tau, -tau})
          {
            z_q.resize(stages[k].q.size());
            for (std::size_t i = 0; i < z_q.size(); ++i)
              z_q[i] = {stages[k].q[i] + side * q_rates[k][i],
                        epsilon * (change.q[k][i] + side * change.q_rates[k][i])};
            z_coordinates.resize(layout.n_coordinates);
            for (unsigned int i = 0; i < layout.n_coordinates; ++i)
              z_coordinates[i] = {stages[k].coordinates[i] + side * stages[k].rates[i],
                                  epsilon * (change.coordinates[k][i] + side * rate_changes[i])};
            strains(stages[k], side > 0 ? z_strain : z_strain_2);
          }
        for (unsigned int i = 0; i < layout.n_strains; ++i)
          change.strain_rates[k][i] = (z_strain[i].imag() - z_strain_2[i].imag()) / (2 * tau * epsilon);
      }
    const auto           &products = integrator.products;
    const Eigen::MatrixXd factors  = change_products();
    for (unsigned int k = 0; k < s; ++k)
      {
        e = change.start_strain;
        for (unsigned int l = 0; l < s; ++l)
          add(h * tableau.a_alpha(k, l), change.strain_rates[l], e);
        system.stresses(e.data(), change.strain_rates[k].data(), change.stress[k].data());
        for (unsigned int i = 0; i < products.size(); ++i)
          change.stress[k][products[i].factor] = change.stress[k][products[i].rest] * stages[k].factors[i] +
                                                 stages[k].stress[products[i].rest] * factors(i, k);
      }
  }



  void
  StepTangent::constraints_at(const unsigned int k, const double *X, const double step, Vector &result)
  {
    const Layout &layout = system.layout;
    const bool    at_end = k == stages.size();
    const Stage  &stage  = stages[at_end ? 0 : k];
    const auto    moved  = [&](const Vector &value, const double *by, Vector &to) {
      to = value;
      for (std::size_t i = 0; i < to.size(); ++i)
        to[i] += step * by[i];
    };
    moved(at_end ? end_q : stage.q, (at_end ? change.end_q : change.q[k]).data(), moved_q);
    moved(at_end ? end_coordinates : stage.coordinates,
          (at_end ? change.end_coordinates : change.coordinates[k]).data(),
          moved_coordinates);
    Point<double> point = stage.point_of_matrices();
    point.q             = moved_q.data();
    point.coordinates   = moved_coordinates.data();
    if (at_end)
      {
        moved(end_states, change.end_states.data(), moved_states);
        point.states = moved_states.data();
        point.time   = start.time + h;
        Vector r(system.size() + 6, 0.);
        system.add_gaps(point, r.data());
        result.assign(r.begin() + layout.of_multiplier(0), r.begin() + system.size());
        return;
      }
    const double *const of_stage = X + k * system.size();
    moved_y                      = stage.y;
    for (unsigned int i = 6; i < moved_y.size(); ++i)
      moved_y[i] += step * of_stage[i - 6];
    moved(stage.rates, of_stage + layout.of_coordinate(0), moved_rates);
    moved(stage.states, of_stage + layout.of_state(0), moved_states);
    moved(stage.state_rates, change.state_rates[k].data(), moved_state_rates);
    point.y           = moved_y.data();
    point.rates       = moved_rates.data();
    point.states      = moved_states.data();
    point.state_rates = moved_state_rates.data();
    if (turns)
      point.reciprocal = stage.reciprocal.data(); // that there are some is all that rates look at
    result.assign(layout.n_multipliers, 0.);
    system.constraint_rates(point, result.data());
  }



  void
  StepTangent::differentiate_constraints(const unsigned int k, const double *X, Vector &result, const bool checks)
  {
    const Layout &layout = system.layout;
    const bool    at_end = k == stages.size();
    // positions move by as much as does not matter; without any, everything is linear
    double        motion = 0;
    const Vector &q = at_end ? change.end_q : change.q[k], &c = at_end ? change.end_coordinates : change.coordinates[k];
    for (unsigned int i = 12; i < q.size(); ++i)
      motion = std::max(motion, std::abs(q[i]) / (i % 12 < 3 ? integrator.length : 1.));
    for (unsigned int i = 0; i < c.size(); ++i)
      motion = std::max(motion, std::abs(c[i]) / layout.scale_of(layout.of_coordinate(i), integrator.length));
    for (unsigned int i = 0; i < layout.n_states; ++i)
      motion = std::max(motion,
                        std::abs(at_end ? change.end_states[i] : X[k * system.size() + layout.of_state(i)]) /
                          system.model.states[i].scale);
    double speed = 0;
    for (unsigned int i = 0; !at_end && i < n_velocities; ++i)
      speed = std::max(speed, std::abs(X[k * system.size() + i]));
    motion = std::max(motion, 1e-3 * h * speed);
    result.assign(layout.n_multipliers, 0.);
    if (!(motion > 0))
      return;

    // central differences of sixth order, (3/4, −3/20, 1/60), with two steps that must agree
    static const std::array<double, 3> weights = {{0.75, -0.15, 1. / 60}};
    Vector                             values, finer(layout.n_multipliers, 0.);
    for (const bool is_finer : {false, true})
      {
        if (is_finer && !checks)
          return;
        const double step = (is_finer ? 0.5 : 1.) * step_of_differences / motion;
        for (int j = 1; j <= 3; ++j)
          for (const int side : {1, -1})
            {
              constraints_at(k, X, side * j * step, values);
              add(side * weights[j - 1] / step, values, is_finer ? finer : result);
            }
      }
    // what cancels is judged by what it is made of
    const double of_terms = at_end ? motion : speed + motion * largest(stages[k].y), length = integrator.length;
    double       error = 0;
    for (unsigned int i = 0; i < layout.n_multipliers; ++i)
      if (is_active[i])
        error = std::max(error, std::abs(finer[i] - result[i]));
    if (error > agreement * std::max(largest(result), of_terms * (1 + length + length * length)))
      throw NotConverged("a constraint is not smooth enough at the step to be linearised");
  }



  void
  StepTangent::add_terms(const unsigned int k, const double *X, double *r)
  {
    const Layout       &layout   = system.layout;
    const Stage        &stage    = stages[k];
    const double *const of_stage = X + k * system.size();
    shift(stage.q, change.q[k], z_q);
    shift(stage.coordinates, change.coordinates[k], z_coordinates);
    z_y.assign(stage.y.begin(), stage.y.end());
    for (unsigned int i = 6; i < z_y.size(); ++i)
      z_y[i] = {stage.y[i], epsilon * of_stage[i - 6]};
    shift(stage.rates, of_stage + layout.of_coordinate(0), z_rates);
    shift(stage.states, of_stage + layout.of_state(0), z_states);
    shift(stage.state_rates, change.state_rates[k], z_state_rates);
    shift(stage.multipliers, of_stage + layout.of_multiplier(0), z_multipliers);
    shift(stage.stress, change.stress[k], z_stress);
    Point<Complex> point;
    point.q           = z_q.data();
    point.coordinates = z_coordinates.data();
    point.y           = z_y.data();
    point.rates       = z_rates.data();
    point.states      = z_states.data();
    point.state_rates = z_state_rates.data();
    point.multipliers = z_multipliers.data();
    point.stress      = z_stress.data();
    point.time        = stage.time;
    point.held        = false;
    point.stops       = stage.stops;
    z_residual.assign(system.size() + 6, Complex());
    if (turns)
      {
        StageRotation::set_reciprocal(z_q.data(), layout.n_nodes, z_reciprocal);
        point.reciprocal = z_reciprocal.data();
        if (!stage.nearest.empty())
          {
            StageRotation::set_nearest(z_q.data(), layout.n_nodes, z_nearest);
            point.nearest = z_nearest.data();
          }
      }
    system.add_bonds(point, z_residual.data());
    if (turns)
      take_work_back(k, X, point);
    system.add_loads_and_states(point, z_residual.data());
    for (int i = 0; i < layout.of_multiplier(0); ++i)
      r[i] += z_residual[i].imag() / epsilon;
  }



  void
  StepTangent::take_work_back(const unsigned int k, const double *X, const Point<Complex> &point)
  {
    const StageRotation &rotation   = *integrator.rotation;
    const Stage         &stage      = stages[k];
    const double *const  of_stage   = X + k * system.size();
    const double *const  multiplier = of_stage + system.layout.of_multiplier(0);
    z_powers.assign(rotation.n_sets(), Complex());
    rotation.add_powers_of_rows(point.y, point.rates, z_residual.data(), z_powers.data());
    // what is subtracted is bilinear
    Vector values(rotation.n_sets(), 0.), changes(rotation.n_sets(), 0.);
    rotation.subtract_powers_of_strains(stage.stress.data(), stage.strain_rates.data(), values.data());
    rotation.subtract_powers_of_strains(change.stress[k].data(), stage.strain_rates.data(), changes.data());
    rotation.subtract_powers_of_strains(stage.stress.data(), change.strain_rates[k].data(), changes.data());
    rotation.subtract_powers_of_constraints(stage.multipliers.data(),
                                            stage.constraint_rates.data(),
                                            stage.rates.data(),
                                            values.data());
    rotation.subtract_powers_of_constraints(multiplier,
                                            stage.constraint_rates.data(),
                                            stage.rates.data(),
                                            changes.data());
    rotation.subtract_powers_of_constraints(stage.multipliers.data(),
                                            change.constraint_rates[k].data(),
                                            of_stage + system.layout.of_coordinate(0),
                                            changes.data());
    for (unsigned int set = 0; set < values.size(); ++set)
      z_powers[set] += Complex(values[set], epsilon * changes[set]);
    find_momenta(of_stage, momenta);
    shift(stage.momenta, momenta, z_momenta);
    rotation.take_back(point.q, point.reciprocal, point.y, z_momenta.data(), z_powers.data(), z_residual.data());
  }



  void
  StepTangent::add_inertia(const unsigned int k, const double *x, const double *X, double *r) const
  {
    const Layout &layout = system.layout;
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      {
        const int                       at = layout.of_node(node);
        const Matrix6                  &M  = system.model.nodes[node].inertia;
        const Eigen::Map<const Vector6> y(&stages[k].y[6 * node]);
        const Vector6                   dy   = of_node(X, k, node);
        Vector6                         from = Vector6::Zero(), acceleration = Vector6::Zero();
        if (x != nullptr)
          from = Eigen::Map<const Vector6>(x + n_positions + at);
        for (unsigned int l = 0; l < tableau.s; ++l)
          acceleration += tableau.w(k, l) / h * (of_node(X, l, node) - from);
        Eigen::Map<Vector6>(r + at) += M * acceleration - ad_star<double>(dy, M * y) - ad_star<double>(y, M * dy);
      }
    for (unsigned int i = 0; i < layout.n_states; ++i)
      if (!system.model.states[i].is_algebraic)
        r[layout.of_state(i)] += change.state_rates[k][i];
  }



  void
  StepTangent::add_corrections(const double *X, Vector &result) const
  {
    const Layout      &layout = system.layout;
    const unsigned int s = tableau.s, n = system.size();
    Vector             mean_changes(layout.n_multipliers, 0.);
    for (unsigned int k = 0; k < s; ++k)
      add(tableau.b(k), change.constraint_rates[k], mean_changes);
    for (unsigned int k = 0; k < s; ++k)
      for (unsigned int i = 0; i < layout.n_multipliers; ++i)
        result[k * n + layout.of_multiplier(i)] =
          !is_active[i]                 ? 0. :
          integrator.is_nonholonomic[i] ? change.constraint_rates[k][i] :
                                          change.constraint_rates[k][i] - mean_changes[i] + change.gaps[i] / h;
    for (const auto &correction : layout.corrections)
      {
        const auto rate = [&](const unsigned int k) {
          return Complex(stages[k].rates[correction.coordinate],
                         epsilon * X[k * n + layout.of_coordinate(correction.coordinate)]);
        };
        const auto multiplier = [&](const unsigned int k) {
          return Complex(stages[k].multipliers[correction.multiplier],
                         epsilon * X[k * n + layout.of_multiplier(correction.multiplier)]);
        };
        const Complex mean(mean_rates[correction.multiplier], epsilon * mean_changes[correction.multiplier]);
        const Complex force =
          StageIntegrator::force_of<Complex>(tableau, h, integrator.unit_of(correction), rate, multiplier, mean);
        for (unsigned int k = 0; k < s; ++k)
          result[k * n + layout.of_coordinate(correction.coordinate)] -= (force * rate(k)).imag() / epsilon;
      }
  }



  void
  StepTangent::residual(const double *x, const double *X, Vector &result, const bool checks)
  {
    const unsigned int s = tableau.s, n = system.size();
    result.assign(s * n, 0.);
    move_nodes(x, X);
    move_others(x, X);
    find_stresses(x, X);
    for (unsigned int k = 0; k < s; ++k)
      {
        differentiate_constraints(k, X, change.constraint_rates[k], checks);
        add_terms(k, X, &result[k * n]);
        add_inertia(k, x, X, &result[k * n]);
      }
    differentiate_constraints(s, X, change.gaps, checks);
    add_corrections(X, result);
    add_springs(x, X, result);
  }
} // namespace samara
