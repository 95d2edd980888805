// Stops and friction in the stages: their forces, and what they do to the corrections of Newton's method.
//
// The factors know nothing of them. With the compliance of the rest at their ports, W = P A⁻¹ Pᵀ, the forces that
// belong to a correction are solved for exactly, stage by stage, however stiff they are and whichever of them open or
// close, stick or slip:
//
//     η = η₀ − W (f(u + η) − f(u)),     u rates and multipliers at the ports, η₀ their correction that the factors
//     give.

#include <samara/base/dense.h>
#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/model/pressing.h>
#include <samara/time/stage_integrator.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  void
  StageIntegrator::make_devices()
  {
    const Layout &layout = system.layout;
    const auto    add    = [&](const bool is_friction, const unsigned int number, const auto &add_ports) {
      devices.push_back({static_cast<unsigned int>(ports.size()), 0, is_friction, number});
      add_ports();
      devices.back().n_ports = ports.size() - devices.back().first_port;
    };
    for (unsigned int i = 0; i < layout.stops.size(); ++i)
      add(false, i, [&]() {
        ports.push_back({layout.of_coordinate(layout.stops[i].coordinate), layout.stops[i].side, false, true});
      });
    for (unsigned int i = 0; i < layout.frictions.size(); ++i)
      add(true, i, [&]() {
        const Layout::Friction &friction = layout.frictions[i];
        for (const auto coordinate : friction.coordinates)
          ports.push_back({layout.of_coordinate(coordinate), 1., false, true});
        if (friction.stop >= 0)
          {
            Port gap      = ports[friction.stop];
            gap.has_force = false;
            ports.push_back(gap);
          }
        for (const auto multiplier : friction.multipliers)
          ports.push_back({layout.of_multiplier(multiplier), 1., true, false});
        devices.back().pressing = pressing_of(layout, friction);
      });
    for (const Device &device : devices)
      values_of_ports.resize(std::max<std::size_t>(values_of_ports.size(), tableau.s * device.n_ports));
    columns.resize(layout.n_coordinates);
    free_changes.resize(tableau.s * ports.size());
    device_forces_now.setZero(tableau.s * ports.size());
  }



  const double *
  StageIntegrator::port_values(const Device &device) const
  {
    Assert(tableau.s * device.n_ports <= values_of_ports.size(),
           dealii::ExcIndexRange(tableau.s * device.n_ports, 0, values_of_ports.size() + 1));
    for (unsigned int p = 0; p < device.n_ports; ++p)
      for (unsigned int k = 0; k < tableau.s; ++k)
        values_of_ports[tableau.s * p + k] = port_value(ports[device.first_port + p], k);
    return values_of_ports.data();
  }



  double
  StageIntegrator::port_value(const Port &port, const unsigned int k) const
  {
    return port.side * (port.is_multiplier ? stages[k].multipliers[port.row - system.layout.of_multiplier(0)] :
                                             stages[k].rates[port.row - system.layout.of_coordinate(0)]);
  }



  void
  StageIntegrator::start_stops(const State &state)
  {
    const Layout &layout = system.layout;
    if (layout.stops.empty() && layout.frictions.empty())
      return;
    if (devices.empty())
      make_devices();
    states_at_start = state.states;
    gaps.resize(layout.stops.size());
    stop_forces_now.resize(gaps.size());
    for (unsigned int i = 0; i < gaps.size(); ++i)
      gaps[i] = layout.stops[i].side * (state.coordinates[layout.stops[i].coordinate] - layout.stops[i].place);
    for (const auto &friction : layout.frictions)
      for (const auto multiplier : friction.multipliers)
        if (!is_active[multiplier])
          throw NotConverged("t = " + number_to_text("%.6g", state.time) + " s: " + friction.name +
                             " depends on a reaction that is not unique, <" + layout.name_of_multiplier(multiplier) +
                             ">: constraints are redundant there. Take away those that repeat others");
  }



  void
  StageIntegrator::device_forces(const Device               &device,
                                 const double               *values,
                                 const double                h,
                                 Eigen::Ref<Eigen::VectorXd> force,
                                 Eigen::MatrixXd            *slopes) const
  {
    if (device.is_friction)
      return friction_forces(device, values, h, force, slopes);
    const StopForces f = stop_forces(system.layout.stops[device.number], tableau, gaps[device.number], values, h);
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        force(k) = f.force[k];
        if (slopes != nullptr)
          for (unsigned int l = 0; l < tableau.s; ++l)
            (*slopes)(k, l) = f.slope[k][l];
      }
  }



  void
  StageIntegrator::evaluate_stops(const double h)
  {
    for (unsigned int i = 0; i < devices.size(); ++i)
      {
        const Device &device = devices[i];
        const auto    force  = device_forces_now.segment(tableau.s * device.first_port, tableau.s * device.n_ports);
        if (device.is_friction)
          {
            friction_forces(device, port_values(device), h, force, nullptr);
          }
        else
          {
            stop_forces_now[i] = stop_forces(system.layout.stops[i], tableau, gaps[i], port_values(device), h);
            for (unsigned int k = 0; k < tableau.s; ++k)
              device_forces_now(tableau.s * device.first_port + k) = stop_forces_now[i].force[k];
          }
        for (unsigned int p = device.first_port; p < device.first_port + device.n_ports; ++p)
          if (ports[p].has_force)
            for (unsigned int k = 0; k < tableau.s; ++k)
              stages[k].residual[ports[p].row] += ports[p].side * device_forces_now(tableau.s * p + k);
      }
    move_bristles(h);
  }



  const StageIntegrator::Column &
  StageIntegrator::column(const unsigned int coordinate)
  {
    Column &c = columns[coordinate];
    if (c.is_known)
      return c;
    c.is_known = true;
    for (const Factor &factor : factors)
      if (factor.real)
        {
          c.real.assign(system.size(), 0.);
          c.real[system.layout.of_coordinate(coordinate)] = 1;
          factor.real->solve(c.real.data());
        }
      else
        {
          c.complex.assign(system.size(), 0.);
          c.complex[system.layout.of_coordinate(coordinate)] = 1;
          factor.complex->solve(c.complex.data());
        }
    return c;
  }



  void
  StageIntegrator::forget_columns()
  {
    for (Column &c : columns)
      c.is_known = false;
  }



  /** η₀ of a port in stage k. */
  double
  StageIntegrator::free_change(const Port &port, const unsigned int k, const double h) const
  {
    double change = 0;
    for (unsigned int j = 0; j < factors.size(); ++j)
      {
        const auto                &eigenvalue = tableau.eigenvalues[j];
        const std::complex<double> hm = h * eigenvalue.mu, unit = port.is_multiplier ? hm * hm : hm;
        change += factors[j].real ? eigenvalue.right(k).real() / unit.real() * x_real[port.row] :
                                    2 * (eigenvalue.right(k) / unit * x[port.row]).real();
      }
    return port.side * change;
  }



  /** Set the block of W between two ports: what changes at a by forces at b. */
  void
  StageIntegrator::compliance(const Port &a, const Port &b, const double h, Eigen::Ref<Eigen::MatrixXd> W)
  {
    W.setZero();
    if (!b.has_force)
      return;
    const Column &c = column(b.row - system.layout.of_coordinate(0));
    for (unsigned int j = 0; j < factors.size(); ++j)
      {
        const auto                &eigenvalue = tableau.eigenvalues[j];
        const std::complex<double> unit       = a.is_multiplier ? 1. : h * eigenvalue.mu;
        if (factors[j].real)
          W += unit.real() * c.real[a.row] * (eigenvalue.right * eigenvalue.left.transpose()).real();
        else
          W += 2 * (unit * c.complex[a.row] * eigenvalue.right * eigenvalue.left.transpose()).real();
      }
    W *= a.side * b.side;
  }



  void
  StageIntegrator::use_ports_of_touched(const double h)
  {
    const unsigned int s = tableau.s;
    touched_ports.clear();
    for (const auto i : touched)
      for (unsigned int p = 0; p < devices[i].n_ports; ++p)
        touched_ports.push_back(devices[i].first_port + p);
    const unsigned int n = s * touched_ports.size();
    touched_free.resize(n);
    touched_compliance.resize(n, n);
    for (unsigned int i = 0; i < touched_ports.size(); ++i)
      {
        for (unsigned int k = 0; k < s; ++k)
          touched_free(s * i + k) = free_changes[s * touched_ports[i] + k];
        for (unsigned int j = 0; j < touched_ports.size(); ++j)
          compliance(ports[touched_ports[i]], ports[touched_ports[j]], h, touched_compliance.block(s * i, s * j, s, s));
      }
  }



  bool
  StageIntegrator::find_stop_forces(const double h, const bool from_free)
  {
    constexpr unsigned int max_iterations = 30;
    const unsigned int     s = tableau.s, n = s * touched_ports.size();
    // what would not be noticed in a step counts as small, as in the corrections of all unknowns
    double          scale = 1e-3 / h, size = 0;
    const auto      unit = [&](const Port &port) { return system.layout.scale_of(port.row, length); };
    Eigen::VectorXd values(n);
    Eigen::MatrixXd slopes;
    port_changes = from_free ? touched_free : Eigen::VectorXd::Zero(n).eval();
    force_changes.resize(n);
    touched_slopes.setZero(n, n);
    for (unsigned int iteration = 0; iteration < max_iterations; ++iteration)
      {
        for (unsigned int i = 0; i < touched_ports.size(); ++i)
          for (unsigned int k = 0; k < s; ++k)
            {
              const Port &port  = ports[touched_ports[i]];
              values(s * i + k) = port_value(port, k) + port_changes(s * i + k);
              if (!port.is_multiplier)
                scale = std::max(scale, std::abs(values(s * i + k)) / unit(port));
            }
        unsigned int first = 0;
        for (const auto i : touched)
          {
            const Device      &device = devices[i];
            const unsigned int m      = s * device.n_ports;
            slopes.setZero(m, m);
            device_forces(device, values.data() + first, h, force_changes.segment(first, m), &slopes);
            force_changes.segment(first, m) -= device_forces_now.segment(s * device.first_port, m);
            touched_slopes.block(first, first, m, m) = slopes;
            first += m;
          }
        touched_matrix.noalias() = touched_compliance * touched_slopes;
        touched_matrix.diagonal().array() += 1;
        const Eigen::VectorXd change =
          solution(touched_matrix, touched_free - port_changes - touched_compliance * force_changes);
        if (!change.allFinite())
          return false;
        size = 0;
        for (unsigned int i = 0; i < touched_ports.size(); ++i)
          if (const Port &port = ports[touched_ports[i]]; !port.is_multiplier)
            size = std::max(size, change.segment(s * i, s).lpNorm<Eigen::Infinity>() / unit(port));
        port_changes += change;
        // Forces belong to the change itself, not to rates that are rounded: of these, stiff stops make forces with
        // errors k h ε|ġ|, of which the compliance makes rates with errors k h² ε|ġ|/m.
        force_changes.noalias() += touched_slopes * change;
        if (size < 1e-15 * scale || (iteration > 3 && size < 1e-11 * scale))
          return true;
      }
    return size < 1e-9 * scale;
  }



  bool
  StageIntegrator::acts(const Device &device, const double *values, const double h) const
  {
    return device.is_friction ||
           stop_forces(system.layout.stops[device.number], tableau, gaps[device.number], values, h).is_touched;
  }



  /** Forces of those that are touched may bring others into touch. */
  void
  StageIntegrator::find_further_touches(const double h)
  {
    const unsigned int    s = tableau.s;
    std::vector<bool>     is_touched(devices.size(), false);
    std::array<double, 3> rates;
    Eigen::MatrixXd       W(s, s);
    for (const auto i : touched)
      is_touched[i] = true;
    for (unsigned int i = 0; i < gaps.size(); ++i)
      if (!is_touched[i])
        {
          const Port &port = ports[devices[i].first_port];
          for (unsigned int k = 0; k < s; ++k)
            rates[k] = port_value(port, k) + free_changes[s * devices[i].first_port + k];
          for (unsigned int j = 0; j < touched_ports.size(); ++j)
            if (ports[touched_ports[j]].has_force)
              {
                compliance(port, ports[touched_ports[j]], h, W);
                const Eigen::VectorXd change = W * force_changes.segment(s * j, s);
                for (unsigned int k = 0; k < s; ++k)
                  rates[k] -= change(k);
              }
          if (acts(devices[i], rates.data(), h))
            {
              touched.push_back(i);
              is_touched[i] = true;
            }
        }
    for (unsigned int i = gaps.size(); i < devices.size(); ++i)
      if (const int stop = system.layout.frictions[devices[i].number].stop;
          !is_touched[i] && (stop < 0 || is_touched[stop]))
        touched.push_back(i);
  }



  bool
  StageIntegrator::correct_for_stops(const double h)
  {
    const unsigned int s = tableau.s;
    if (devices.empty())
      return true;
    for (unsigned int p = 0; p < ports.size(); ++p)
      for (unsigned int k = 0; k < s; ++k)
        free_changes[s * p + k] = free_change(ports[p], k, h);
    touched.clear();
    touched_ports.clear();
    for (unsigned int i = 0; i < gaps.size(); ++i)
      if (stop_forces_now[i].is_touched)
        touched.push_back(i);
    find_further_touches(h);
    for (unsigned int n_before = 0; touched.size() > n_before; find_further_touches(h))
      {
        n_before = touched.size();
        use_ports_of_touched(h);
        if (!find_stop_forces(h, false) && !find_stop_forces(h, true))
          return false;
      }
    add_stop_reactions(h);
    return true;
  }



  void
  StageIntegrator::add_stop_reactions(const double h)
  {
    const unsigned int s = tableau.s;
    for (unsigned int i = 0; i < touched_ports.size(); ++i)
      {
        const Port &port = ports[touched_ports[i]];
        if (!port.has_force)
          continue;
        const Column &c = column(port.row - system.layout.of_coordinate(0));
        for (unsigned int j = 0; j < factors.size(); ++j)
          {
            const auto                &eigenvalue = tableau.eigenvalues[j];
            const std::complex<double> hm         = h * eigenvalue.mu;
            std::complex<double>       force      = 0;
            for (unsigned int k = 0; k < s; ++k)
              force += eigenvalue.left(k) * force_changes(s * i + k);
            force *= port.side * hm * hm;
            if (factors[j].real)
              for (unsigned int m = 0; m < x_real.size(); ++m)
                x_real[m] -= force.real() * c.real[m];
            else
              for (unsigned int m = 0; m < x.size(); ++m)
                x[m] -= force * c.complex[m];
          }
      }
  }



  void
  StageIntegrator::add_slopes_of_stops(const double h)
  {
    Eigen::MatrixXd slopes;
    Eigen::VectorXd force;
    for (const Device &device : devices)
      {
        const unsigned int n = tableau.s * device.n_ports;
        slopes.setZero(n, n);
        force.resize(n);
        device_forces(device, port_values(device), h, force, &slopes);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            {
              const Port &row    = ports[device.first_port + i / tableau.s],
                         &column = ports[device.first_port + j / tableau.s];
              if (slopes(i, j) != 0) // multipliers are unknowns as h δλ
                exact->add(i % tableau.s,
                           row.row,
                           j % tableau.s,
                           column.row,
                           row.side * column.side * slopes(i, j) / (column.is_multiplier ? h : 1.));
            }
      }
  }



  void
  StageIntegrator::account_for_stops(const State &state, const double h, StepResult &result)
  {
    for (unsigned int i = 0; i < gaps.size(); ++i)
      {
        const double *const rates  = port_values(devices[i]);
        const StopForces    forces = stop_forces(system.layout.stops[i], tableau, gaps[i], rates, h);
        if (!forces.is_touched)
          continue;
        result.viscous_loss += forces.loss;
        if (system.layout.stops[i].is_load)
          result.work_of_loads -= forces.elastic;
        result.work_defect += std::abs(forces.work_defect);
        result.touched_stops.push_back({i, forces.depth, forces.loss, gaps[i] > 0});
        add_touches(i, tableau, gaps[i], rates, state.time, h, result.touches);
      }
    account_for_friction(h, result);
  }
} // namespace samara
