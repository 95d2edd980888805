// What makes steady rotation an equilibrium of a step: reciprocal triads of stages, and the work that is taken back.

#include <samara/base/disjoint_sets.h>
#include <samara/rotation/nearest_rotation.h>
#include <samara/time/stage_rotation.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /**
     * The largest |1 − r_k| of the stages as a function of y = (hω)²: √r_k is the length that the stages of Gauss give
     * a unit vector which turns with ω. It is r = 1/(1 + y/4) for one stage; of three, the middle one is the shortest.
     */
    double
    shortening(const unsigned int s, const double y)
    {
      switch (s)
        {
          case 1:
            return 0.25 * y / (1 + 0.25 * y);
          case 2:
            return y * y / 144 / (1 + y / 12 + y * y / 144);
          default:
            return y * y * (1. / 960 + y / 14400) / (1 + y / 20 + y * y / 600 + y * y * y / 14400);
        }
    }

    /** Part of the largest rate of a row by which a set that is displaced as a whole may seem to be held: round-off. */
    constexpr double held = 1e-8;
  } // namespace



  StageRotation::StageRotation(const System &system, const State &state)
    : system(system)
  {
    find_sets(state);
    find_free_sets(state);
  }



  bool
  StageRotation::counts(const unsigned int s, const double h, const std::vector<double> &y, const double part)
  {
    double fastest = 0;
    for (std::size_t i = 6; i < y.size(); i += 6)
      fastest = std::max(fastest, y[i + 3] * y[i + 3] + y[i + 4] * y[i + 4] + y[i + 5] * y[i + 5]);
    return shortening(s, h * h * fastest) > part;
  }



  namespace
  {
    /** @p axes of the triads of all nodes but the ground, with 12 numbers a node like @p q. */
    template <typename Number, typename Axes>
    void
    set_axes(const Number *q, const unsigned int n_nodes, const Axes &axes, std::vector<Number> &result)
    {
      result.resize(12 * n_nodes, Number(0));
      std::copy_n(q, 12, result.begin()); // the ground
      for (unsigned int node = 1; node < n_nodes; ++node)
        Eigen::Map<Mat3<Number>>{result.data() + 12 *node + 3} =
          axes(Mat3<Number>(Eigen::Map<const Mat3<Number>>(q + 12 * node + 3)));
    }

    template <typename Number>
    Number
    sum_of_products(const unsigned int n, const Number *a, const Number *b)
    {
      using Vector = Eigen::Map<const Eigen::Matrix<Number, Eigen::Dynamic, 1>>;
      return Vector(a, n).cwiseProduct(Vector(b, n)).sum();
    }
  } // namespace



  template <typename Number>
  void
  StageRotation::set_reciprocal(const Number *q, const unsigned int n_nodes, std::vector<Number> &reciprocal)
  {
    set_axes(
      q, n_nodes, [](const Mat3<Number> &D) { return reciprocal_axes(D); }, reciprocal);
  }



  template <typename Number>
  void
  StageRotation::set_nearest(const Number *q, const unsigned int n_nodes, std::vector<Number> &nearest)
  {
    set_axes(
      q, n_nodes, [](const Mat3<Number> &D) { return nearest_rotation(D); }, nearest);
  }



  void
  StageRotation::find_sets(const State &state)
  {
    // what a row of a constraint, or the stiffness of anything, couples belongs together; states of first order do not
    const Layout      &layout      = system.layout;
    const unsigned int first_state = layout.of_state(0), end_of_states = layout.of_multiplier(0);
    const auto         is_state = [&](const unsigned int i) { return i >= first_state && i < end_of_states; };
    DisjointSets       groups(layout.n_unknowns());
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      for (unsigned int i = 1; i < 6; ++i)
        groups.join(layout.of_node(node) + i, layout.of_node(node));
    const Pattern &pattern = *layout.pattern;
    for (unsigned int j = 0; j < layout.n_unknowns(); ++j)
      for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
        if (const unsigned int i = pattern.rows[k]; i < layout.n_unknowns() && !is_state(i) && !is_state(j))
          groups.join(i, j);
    std::vector<int> numbers(layout.n_unknowns(), -1);
    const auto       set_of = [&](const unsigned int unknown) -> unsigned int {
      int &number = numbers[groups.root_of(unknown)];
      if (number < 0)
        {
          number = is_free.size();
          is_free.push_back(true);
        }
      return number;
    };
    set_of_node.assign(layout.n_nodes, 0);
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      set_of_node[node] = set_of(layout.of_node(node));
    for (unsigned int i = 0; i < layout.n_coordinates; ++i)
      set_of_coordinate.push_back(set_of(layout.of_coordinate(i)));
    for (unsigned int i = 0; i < layout.n_multipliers; ++i)
      set_of_multiplier.push_back(set_of(layout.of_multiplier(i)));
    for (const unsigned int row : system.rows_of_strains(state))
      set_of_strain.push_back(row < layout.n_unknowns() ? set_of(row) : 0);
    if (is_free.empty())
      is_free.push_back(false); // nothing can move
  }



  void
  StageRotation::find_free_sets(const State &state)
  {
    // displacements of all bodies by one direction, and, to measure what they cause, motions without any order
    const Layout       &layout = system.layout;
    std::vector<double> rates(layout.n_strains + layout.n_multipliers), y(6 * layout.n_nodes, 0.),
      of_time(layout.n_multipliers, 0.), of_coordinates(layout.n_coordinates, 0.), most(n_sets(), 0.),
      most_of_displacements(n_sets(), 0.);
    Point<double> point = state.point();
    point.held          = false;
    point.y             = y.data();
    point.rates         = of_coordinates.data();
    system.constraint_time_rates(point, of_time.data());
    const auto see = [&](std::vector<double> &most_of_sets) {
      system.strain_rates(point, rates.data());
      system.constraint_rates(point, rates.data() + layout.n_strains);
      const auto add = [&](const unsigned int set, const double rate) {
        most_of_sets[set] = std::max(most_of_sets[set], std::abs(rate));
      };
      for (unsigned int i = 0; i < layout.n_strains; ++i)
        add(set_of_strain[i], rates[i]);
      for (unsigned int i = 0; i < layout.n_multipliers; ++i)
        add(set_of_multiplier[i], rates[layout.n_strains + i] - of_time[i]);
    };
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      for (unsigned int i = 0; i < 6; ++i)
        y[6 * node + i] = std::sin(1. + 7. * node + 3. * i);
    see(most);
    for (unsigned int i = 0; i < 3; ++i)
      {
        for (unsigned int node = 1; node < layout.n_nodes; ++node)
          Eigen::Map<Vector6>(&y[6 * node]) << state.triad(node).row(i).transpose(), Vector3::Zero();
        see(most_of_displacements);
      }
    for (unsigned int set = 0; set < n_sets(); ++set)
      is_free[set] = is_free[set] && !(most_of_displacements[set] > held * most[set]);
  }



  template <typename Number>
  void
  StageRotation::add_powers_of_rows(const Number *y, const Number *rates, const Number *r, Number *powers) const
  {
    const Layout       &layout = system.layout;
    const unsigned int  n = 6 * (layout.n_nodes - 1), n_coordinates = layout.n_coordinates;
    const Number *const of_coordinates = r + layout.of_coordinate(0);
    if (n_sets() == 1) // as most models are: two products of all numbers
      {
        powers[0] += sum_of_products(n, y + 6, r) + sum_of_products(n_coordinates, rates, of_coordinates);
        return;
      }
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      powers[set_of_node[node]] += sum_of_products(6, y + 6 * node, r + 6 * (node - 1));
    for (unsigned int i = 0; i < n_coordinates; ++i)
      powers[set_of_coordinate[i]] += rates[i] * of_coordinates[i];
  }



  void
  StageRotation::subtract_powers_of_strains(const double *stress, const double *strain_rates, double *powers) const
  {
    system.subtract_powers(stress, strain_rates, set_of_strain, powers);
  }



  void
  StageRotation::subtract_powers_of_constraints(const double *multipliers,
                                                const double *constraint_rates,
                                                const double *rates,
                                                double       *powers) const
  {
    const unsigned int n = set_of_multiplier.size();
    if (n_sets() == 1)
      powers[0] -= sum_of_products(n, multipliers, constraint_rates);
    else
      for (unsigned int i = 0; i < n; ++i)
        powers[set_of_multiplier[i]] -= multipliers[i] * constraint_rates[i];
    for (const auto &[coordinate, i] : system.model.prescribed)
      powers[set_of_multiplier[i]] += multipliers[i] * (constraint_rates[i] - rates[coordinate]);
  }



  template <typename Number>
  void
  StageRotation::subtract_mean_motion(const Number *q,
                                      const Number *reciprocal,
                                      const Number *momenta,
                                      Number       *relative) const
  {
    // the velocity of the centre of mass: (Σ D m D⁻¹) V = Σ D p, m and p of a node in its own axes
    const unsigned int n_nodes = system.layout.n_nodes;
    const auto         triad   = [](const Number *at, const unsigned int node) {
      return Eigen::Map<const Mat3<Number>>(at + 12 * node + 3);
    };
    const auto mass_of = [&](const unsigned int node) {
      return Eigen::Matrix<Number, 6, 3>(
        system.model.nodes[node].inertia.template leftCols<3>().template cast<Number>());
    };
    static thread_local std::vector<Vec3<Number>> V, momentum;
    static thread_local std::vector<Mat3<Number>> mass;
    V.assign(n_sets(), Vec3<Number>::Zero());
    momentum.assign(n_sets(), Vec3<Number>::Zero());
    mass.assign(n_sets(), Mat3<Number>::Zero());
    for (unsigned int node = 1; node < n_nodes; ++node)
      if (const unsigned int set = set_of_node[node]; is_free[set])
        {
          const Mat3<Number> D = triad(q, node);
          momentum[set] += D * Eigen::Map<const Vec3<Number>>(momenta + 6 * node);
          mass[set] += D * mass_of(node).template topRows<3>() * triad(reciprocal, node).transpose();
        }
    for (unsigned int set = 0; set < n_sets(); ++set)
      if (is_free[set] && std::real(mass[set].trace()) > 0)
        V[set] = reciprocal_axes(mass[set]).transpose() * momentum[set];
    for (unsigned int node = 1; node < n_nodes; ++node)
      if (const unsigned int set = set_of_node[node]; is_free[set])
        Eigen::Map<Vec6<Number>>(relative + 6 * node) -=
          mass_of(node) * Vec3<Number>(triad(reciprocal, node).transpose() * V[set]);
  }



  template <typename Number>
  void
  StageRotation::take_back(const Number *q,
                           const Number *reciprocal,
                           const Number *y,
                           const Number *momenta,
                           const Number *powers,
                           Number       *r) const
  {
    const unsigned int                      n_nodes = system.layout.n_nodes;
    static thread_local std::vector<Number> of_free, weights;
    if (std::find(is_free.begin(), is_free.end(), true) != is_free.end())
      {
        of_free.assign(momenta, momenta + 6 * n_nodes);
        subtract_mean_motion(q, reciprocal, momenta, of_free.data());
        momenta = of_free.data();
      }
    weights.assign(n_sets(), Number(0));
    for (unsigned int node = 1; node < n_nodes; ++node)
      weights[set_of_node[node]] += sum_of_products(6, momenta + 6 * node, y + 6 * node);
    for (unsigned int set = 0; set < n_sets(); ++set)
      weights[set] = std::real(weights[set]) > 0 ? Number(powers[set] / weights[set]) : Number(0); // c_k
    for (unsigned int node = 1; node < n_nodes; ++node)
      {
        const Number c = weights[set_of_node[node]];
        for (unsigned int i = 0; i < 6; ++i)
          r[6 * (node - 1) + i] -= c * momenta[6 * node + i];
      }
  }



  template void StageRotation::set_reciprocal(const double *, unsigned int, std::vector<double> &);
  template void StageRotation::set_nearest(const double *, unsigned int, std::vector<double> &);
  template void StageRotation::add_powers_of_rows(const double *, const double *, const double *, double *) const;
  template void StageRotation::take_back(const double *,
                                         const double *,
                                         const double *,
                                         const double *,
                                         const double *,
                                         double *) const;

  using Complex = std::complex<double>;
  template void StageRotation::set_reciprocal(const Complex *, unsigned int, std::vector<Complex> &);
  template void StageRotation::set_nearest(const Complex *, unsigned int, std::vector<Complex> &);
  template void StageRotation::add_powers_of_rows(const Complex *, const Complex *, const Complex *, Complex *) const;
  template void StageRotation::take_back(const Complex *,
                                         const Complex *,
                                         const Complex *,
                                         const Complex *,
                                         const Complex *,
                                         Complex *) const;
} // namespace samara
