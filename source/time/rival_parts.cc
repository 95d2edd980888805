#include <samara/solvers/newton.h>
#include <samara/time/rival_parts.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace rivals
  {
    void
    move(State &state, const unsigned int node, const Vector6 &z)
    {
      // exponential of a screw motion; series where the quotients lose digits, exact to 1e-14 below the limit
      const Vector3 v = z.head<3>(), w = z.tail<3>();
      const double  angle = w.norm(), square = angle * angle;
      const double  a = angle > 1e-3 ? (1 - std::cos(angle)) / square : 0.5 - square / 24,
                   b  = angle > 1e-3 ? (angle - std::sin(angle)) / (square * angle) : 1. / 6 - square / 120;
      Eigen::Map<Vector3> x(&state.q[12 * node]);
      Eigen::Map<Matrix3> D(&state.q[12 * node + 3]);
      x += D * (v + a * w.cross(v) + b * w.cross(w.cross(v)));
      D = renormalised(D * rotation_of_vector(w));
    }



    Vector6
    change_of_exponent(const Vector6 &z, const Vector6 &zeta)
    {
      // Bernoulli's numbers, 1, 1/2, 1/12
      const Matrix6 A     = ad(z);
      const Vector6 once  = A * zeta;
      const Vector6 twice = A * once;
      return zeta + 0.5 * once + twice / 12;
    }



    void
    add_to_node(SparseMatrix &A, const Layout &layout, const unsigned int node, const Matrix6 &block)
    {
      const int first = layout.of_node(node);
      for (int j = 0; j < 6; ++j)
        {
          const int position = A.pattern->position(first, first + j);
          for (int i = 0; i < 6; ++i)
            A.values[position + i] += block(i, j);
        }
    }



    std::vector<double>
    constraint_rates(const System &system, const State &state)
    {
      std::vector<double> rates(system.layout.n_multipliers);
      system.constraint_rates(state.point(), rates.data());
      for (const auto i : state.left_out)
        rates[i] = 0;
      for (const auto i : system.released_multipliers())
        rates[i] = 0;
      return rates;
    }



    std::vector<bool>
    active_multipliers(const System &system)
    {
      std::vector<bool> is_active(system.layout.n_multipliers, true);
      for (const auto i : system.released_multipliers())
        is_active[i] = false;
      for (const auto i : system.dropped_multipliers())
        is_active[i] = false;
      return is_active;
    }



    std::vector<bool>
    nonholonomic_multipliers(const System &system)
    {
      std::vector<bool> is_nonholonomic(system.layout.n_multipliers, false);
      for (const auto i : system.layout.nonholonomic)
        is_nonholonomic[i] = true;
      return is_nonholonomic;
    }



    bool
    is_corner(const System &system, const double time, const double width)
    {
      return system.next_corner(time - width, time + width) < time + width;
    }



    Measure::Measure(const System &system)
      : length(model_length(system.model))
      , system(system)
    {}



    double
    Measure::largest(const std::vector<double> &y, const std::vector<double> &rates) const
    {
      double size = 0;
      for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
        {
          const Eigen::Map<const Vector3> v(&y[6 * node]), w(&y[6 * node + 3]);
          const double                    s = v.norm() / length + w.norm();
          if (!std::isfinite(s))
            return s;
          size = std::max(size, s);
        }
      for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
        size = std::max(size, std::abs(rates[i]) / system.layout.scale_of(system.layout.of_coordinate(i), length));
      return size;
    }



    Corrections::Verdict
    Corrections::judge(const double size)
    {
      // ten times the largest velocity: the iteration leads away. Old factors get a second chance with new ones
      if (!std::isfinite(size) || size > 10)
        {
          if (is_fresh)
            return Verdict::diverged;
          is_fresh = is_missing = true;
          last                  = 0;
          return Verdict::again;
        }
      // linear convergence: what is still missing is about size · rate/(1 − rate)
      const double rate = last > 0 ? std::max(size / last, 0.05) : 0.5;       // the first one may be too good
      if ((rate < 1 && size * rate / (1 - rate) < tolerance) || size < 1e-13) // the latter is round-off
        return Verdict::converged;
      if (last > 0 && rate > slow)
        is_fresh = is_missing = true; // Newton's method proper from here
      last = size;
      return Verdict::go_on;
    }



    unsigned int
    largest_of(const std::vector<double> &values, const unsigned int n)
    {
      AssertIndexRange(n, values.size() + 1);
      const auto smaller = [](const double a, const double b) { return std::abs(a) < std::abs(b); };
      return std::max_element(values.begin(), values.begin() + n, smaller) - values.begin();
    }



    Powers
    powers(const System &system, const State &state)
    {
      const Layout       &layout = system.layout;
      Powers              result;
      std::vector<double> force(system.size() + 6, 0.), rates(layout.n_strains);
      system.add_loads(state.point(), force.data(), false);
      if (system.is_viscous())
        {
          system.strain_rates(state.point(), rates.data());
          result.viscous = system.viscous_power(rates.data());
        }
      for (unsigned int i = 0; i < 6 * (layout.n_nodes - 1); ++i)
        result.loads -= force[i] * state.y[6 + i];
      for (unsigned int i = 0; i < layout.n_coordinates; ++i)
        result.loads -= force[layout.of_coordinate(i)] * state.rates[i];

      result.air = AirOfSystem(system).powers(state.point());

      // a constraint does the work −λ·Gy = λ·∂g/∂t
      const std::vector<bool> is_active = active_multipliers(system);
      std::vector<double>     time_rates(layout.n_multipliers);
      system.constraint_time_rates(state.point(), time_rates.data());
      for (unsigned int i = 0; i < layout.n_multipliers; ++i)
        if (is_active[i])
          result.drives += state.multipliers[i] * time_rates[i];
      return result;
    }



    void
    account(const System &system, const State &before, const State &after, const Powers &work, StepResult &result)
    {
      const auto start = system.energy(before), end = system.energy(after);
      result.work_of_loads =
        work.loads + system.potential_energy(before.point()) - system.potential_energy(after.point());
      result.air            = work.air;
      result.work_of_drives = work.drives;
      result.viscous_loss   = work.viscous;
      result.dissipated     = start.kinetic + start.strain - end.kinetic - end.strain + result.work_of_loads +
                          result.work_of_drives - result.viscous_loss;
    }



    void
    account(const System &system, const State &before, const State &after, StepResult &result)
    {
      const double h = after.time - before.time;
      Powers       work;
      work.add(0.5 * h, powers(system, before));
      work.add(0.5 * h, powers(system, after));
      account(system, before, after, work, result);
    }



    namespace
    {
      std::shared_ptr<const Pattern>
      doubled(const Pattern &single)
      {
        auto      pattern = std::make_shared<Pattern>();
        const int n       = single.size();
        pattern->column_start.push_back(0);
        for (int j = 0; j < 2 * n; ++j)
          {
            for (int shift : {0, n})
              for (int k = single.column_start[j % n]; k < single.column_start[j % n + 1]; ++k)
                pattern->rows.push_back(single.rows[k] + shift);
            pattern->column_start.push_back(pattern->rows.size());
          }
        return pattern;
      }
    } // namespace



    PairMatrix::PairMatrix(const std::shared_ptr<const Pattern> &pattern)
      : single(pattern)
      , matrix(doubled(*pattern))
      , solver(make_solver(matrix.pattern))
    {}



    void
    PairMatrix::clear()
    {
      matrix.clear();
    }
  } // namespace rivals
} // namespace samara
