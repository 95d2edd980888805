// The corrections of Newton's method.

#include <samara/time/four_nodes.h>
#include <samara/time/stage_integrator.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Without the search for infinities that the standard asks for. */
    std::complex<double>
    product(const std::complex<double> &a, const std::complex<double> &b)
    {
      return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
    }

    using Lane = FourNodes::Lane;

    Lane
    larger(const Lane &a, const Lane &b)
    {
      return Lane(a.values > b.values ? a.values : b.values);
    }

    double
    largest_of_lanes(const Lane &a)
    {
      return std::max({a.values[0], a.values[1], a.values[2], a.values[3]});
    }

    Lane
    square_of(const Lane *v)
    {
      return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    }



    /** Add twist(nodes, ·) to the twists @p all of nodes, lengths in parts of @p length; what is no number is returned.
     */
    template <typename Twist>
    double
    correct_twists(const Twist &twist, const double length, std::vector<double> &all, double &size, double &scale)
    {
      const unsigned int n_nodes = all.size() / 6;
      const Lane         factor  = 1 / (length * length);
      Lane               changes = 0., squares = 0., sum = 0.;
      for (unsigned int first = 1; first < n_nodes; first += 4)
        {
          const FourNodes nodes(first, n_nodes);
          Lane            d[6], y[6];
          twist(nodes, d);
          nodes.load(6, all, y);
          for (int i = 0; i < 6; ++i)
            y[i] += d[i];
          nodes.store(6, y, all);
          // (|v| + |ω|)²
          const Lane of_v = factor * square_of(d), of_spin = square_of(d + 3),
                     change = of_v + of_spin + Lane(2.) * sqrt(of_v * of_spin);
          sum += change;
          changes = larger(changes, change);
          squares = larger(squares, larger(factor * square_of(y), square_of(y + 3)));
        }
      size  = std::max(size, std::sqrt(largest_of_lanes(changes)));
      scale = std::max(scale, std::sqrt(largest_of_lanes(squares)));
      return sum.values[0] + sum.values[1] + sum.values[2] + sum.values[3];
    }
  } // namespace



  template <typename Twist>
  double
  StageIntegrator::correct_velocities(const double h, const Twist &twist)
  {
    // corrections are measured against the largest velocity, or one that would matter over the step, a thousandth of a
    // radian or of the length; those of multipliers against the largest, or a force whose work over the length is 1e-8
    // of the energy
    const Layout &layout = system.layout;
    double        size = 0, size_of_states = 0, scale = 1e-3 / h,
           largest_force     = 1e-8 * std::max(energy_scale, kinetic_energy) / length;
    previous_change_of_force = change_of_force;
    change_of_force          = 0;
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        Stage &stage = stages[k];
        if (const double all = correct_twists(
              [&](const FourNodes &nodes, Lane *d) { twist(k, nodes, d); }, length, stage.y, size, scale);
            !std::isfinite(all))
          return all;
        for (unsigned int i = 0; i < layout.n_coordinates; ++i)
          {
            const double d = dz_rate[k][layout.of_coordinate(i)], l = layout.scale_of(layout.of_coordinate(i), length);
            stage.rates[i] += d;
            size  = std::max(size, std::abs(d) / l);
            scale = std::max(scale, std::abs(stage.rates[i]) / l);
          }
        for (unsigned int i = 0; i < layout.n_states; ++i)
          {
            const double d = dz[k][layout.of_state(i)];
            if (!std::isfinite(d))
              return d;
            stage.states[i] += d;
            size_of_states =
              std::max(size_of_states, std::abs(d) / std::max(std::abs(stage.states[i]), system.model.states[i].scale));
          }
        for (unsigned int i = 0; i < layout.n_multipliers; ++i)
          {
            const double d = d_lambda[k][i];
            stage.multipliers[i] += d;
            change_of_force = std::max(change_of_force, std::abs(d));
            largest_force   = std::max(largest_force, std::abs(stage.multipliers[i]));
          }
      }
    if (largest_force > 0)
      change_of_force /= largest_force;
    return std::max(size / scale, size_of_states);
  }



  bool
  StageIntegrator::solve_for_increments(const double h)
  {
    apply_factors(h);
    if (!correct_for_stops(h))
      return false;
    collect_increments(h);
    return true;
  }



  void
  StageIntegrator::apply_factors(const double h)
  {
    const unsigned int n = system.size(), n_kinematic = system.layout.of_multiplier(0), s = tableau.s;
    for_factors([&](const unsigned int j) {
      const auto                &eigenvalue = tableau.eigenvalues[j];
      const std::complex<double> hm         = h * eigenvalue.mu;
      if (factors[j].real)
        {
          const double of_motion = -hm.real() * hm.real(), of_constraints = -hm.real();
          std::fill(x_real.begin(), x_real.end(), 0.);
          for (unsigned int k = 0; k < s; ++k)
            {
              const double  left = eigenvalue.left(k).real();
              const double *r    = stages[k].residual.data();
              for (unsigned int i = 0; i < n_kinematic; ++i)
                x_real[i] += of_motion * left * r[i];
              for (unsigned int i = n_kinematic; i < n; ++i)
                x_real[i] += of_constraints * left * r[i];
            }
          factors[j].real->solve(x_real.data());
        }
      else
        {
          for (unsigned int i = 0; i < n; ++i)
            {
              double real = 0, imag = 0;
              for (unsigned int k = 0; k < s; ++k)
                {
                  real += eigenvalue.left(k).real() * stages[k].residual[i];
                  imag += eigenvalue.left(k).imag() * stages[k].residual[i];
                }
              x[i] = product(i < n_kinematic ? -hm * hm : -hm, std::complex<double>(real, imag));
            }
          factors[j].complex->solve(x.data());
        }
    });
  }



  void
  StageIntegrator::collect_increments(const double h)
  {
    const unsigned int n = system.size(), n_kinematic = system.layout.of_multiplier(0), s = tableau.s;
    for (unsigned int k = 0; k < s; ++k)
      for (auto *const increments : {&dz[k], &dz_rate[k], &d_lambda[k]})
        std::fill(increments->begin(), increments->end(), 0.);

    // displacements ζ, their rates ζ/(hμ), multipliers; of a complex pair twice the real part
    for (unsigned int j = 0; j < factors.size(); ++j)
      {
        const auto                &eigenvalue = tableau.eigenvalues[j];
        const std::complex<double> hm         = h * eigenvalue.mu;
        for (unsigned int k = 0; k < s; ++k)
          if (factors[j].real)
            {
              const double right = eigenvalue.right(k).real(), rate = right / hm.real(), force = rate / hm.real();
              for (unsigned int i = 0; i < n_kinematic; ++i)
                {
                  dz[k][i] += right * x_real[i];
                  dz_rate[k][i] += rate * x_real[i];
                }
              for (unsigned int i = n_kinematic; i < n; ++i)
                d_lambda[k][i - n_kinematic] += force * x_real[i];
            }
          else
            {
              const std::complex<double> right = 2. * eigenvalue.right(k), rate = right / hm, force = rate / hm;
              for (unsigned int i = 0; i < n_kinematic; ++i)
                {
                  dz[k][i] += product(right, x[i]).real();
                  dz_rate[k][i] += product(rate, x[i]).real();
                }
              for (unsigned int i = n_kinematic; i < n; ++i)
                d_lambda[k][i - n_kinematic] += product(force, x[i]).real();
            }
      }
  }



  Vector6
  StageIntegrator::change_of_twist(const unsigned int k, const unsigned int node) const
  {
    const int                       i = system.layout.of_node(node);
    const Eigen::Map<const Vector6> zeta(&dz[k][i]), rate(&dz_rate[k][i]);
    const Eigen::Map<const Vector3> v(&frozen.y[6 * node]), w(&frozen.y[6 * node + 3]);
    Vector6                         change;
    change << rate.head<3>() + w.cross(zeta.head<3>()) + v.cross(zeta.tail<3>()),
      rate.tail<3>() + w.cross(zeta.tail<3>());
    return change;
  }



  double
  StageIntegrator::solve(const double h)
  {
    if (!solve_for_increments(h))
      return std::nan("");
    return correct_velocities(h, [&](const unsigned int k, const FourNodes &nodes, Lane *const change) {
      // change_of_twist()
      Lane zeta[6], rate[6], y[6];
      nodes.load_unknowns(dz[k], zeta);
      nodes.load_unknowns(dz_rate[k], rate);
      nodes.load(6, frozen.y, y);
      for (int i = 0; i < 3; ++i)
        {
          const int m = (i + 1) % 3, n = (i + 2) % 3;
          change[i]     = rate[i] + y[3 + m] * zeta[n] - y[3 + n] * zeta[m] + y[m] * zeta[3 + n] - y[n] * zeta[3 + m];
          change[3 + i] = rate[3 + i] + y[3 + m] * zeta[3 + n] - y[3 + n] * zeta[3 + m];
        }
    });
  }



  void
  StageIntegrator::solve_exactly_for_increments(const double h)
  {
    std::vector<Point<double>> points;
    d_exact.resize(tableau.s);
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        points.push_back(stages[k].point_of_matrices());
        d_exact[k] = stages[k].residual;
      }
    exact->assemble(points, h, is_active);
    add_slopes_of_stops(h);
    add_slopes_of_springs(h);
    if (!contacts.is_empty())
      add_contacts_to_exact_matrix(h);
    exact->solve(d_exact);
    ++n_factorizations;
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        exact->displacements(k, d_exact, dz[k], dz_rate[k]);
        std::copy_n(d_exact[k].begin() + system.layout.of_multiplier(0),
                    system.layout.n_multipliers,
                    d_lambda[k].begin());
      }
  }



  double
  StageIntegrator::solve_exactly(const double h)
  {
    solve_exactly_for_increments(h);
    return correct_velocities(h, [&](const unsigned int k, const FourNodes &nodes, Lane *const change) {
      nodes.load_unknowns(d_exact[k], change);
    });
  }



  void
  StageIntegrator::correct_stresses()
  {
    // δσ = (what the configuration has more) + C B ζ + C_d B ζ̇, B as in the matrices
    const Layout &layout  = system.layout;
    const auto    strains = [&](const unsigned int k, const std::vector<double> &z, std::vector<double> &e) {
      std::copy_n(z.begin(), 6 * (layout.n_nodes - 1), twists.begin() + 6);
      strains_in_matrix(k).strains(twists.data(), z.data() + layout.of_coordinate(0), e.data());
    };
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        Stage &stage = stages[k];
        strains(k, dz[k], strain_increment);
        if (system.is_viscous())
          strains(k, dz_rate[k], rate_increment);
        change_of_stresses(k, strain_increment.data(), rate_increment.data(), stress_increment);
        for (unsigned int i = 0; i < layout.n_strains; ++i)
          stage.stress[i] += stage.excess[i] + stress_increment[i];
      }
  }
} // namespace samara
