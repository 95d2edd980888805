// The stages of a step: where they are, and how far their equations are from being satisfied.

#include <samara/base/dense.h>
#include <samara/base/threads.h>
#include <samara/rotation/nearest_rotation.h>
#include <samara/time/four_nodes.h>
#include <samara/time/stage_integrator.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace samara
{
  namespace
  {
    using Lane = Lanes<double>::type;

    /**
     * Solve A X = B by elimination without pivoting, all in place; A has a dominant diagonal for steps that have a
     * solution. False if a pivot is small or negative all the same.
     */
    template <int n, int m>
    bool
    eliminate(Lane (&A)[n][n + m])
    {
      // unrolled, as indices are constants then; GCC leaves loops of this size alone
#pragma GCC unroll 9
      for (int i = 0; i < n; ++i)
        {
          // without pivoting the matrix must be near the identity, as for small turns; else the caller takes Eigen's LU
          if (!(A[i][i].smallest() > 0.1))
            return false;
          const Lane inverse = Lane(1) / A[i][i];
#pragma GCC unroll 12
          for (int k = i + 1; k < n + m; ++k)
            A[i][k] *= inverse;
#pragma GCC unroll 9
          for (int j = i + 1; j < n; ++j)
#pragma GCC unroll 12
            for (int k = i + 1; k < n + m; ++k)
              A[j][k] -= A[j][i] * A[i][k];
        }
#pragma GCC unroll 9
      for (int i = n - 1; i > 0; --i)
#pragma GCC unroll 9
        for (int j = 0; j < i; ++j)
#pragma GCC unroll 3
          for (int k = n; k < n + m; ++k)
            A[j][k] -= A[j][i] * A[i][k];
      return true;
    }



    /** The same for one lane, with pivoting. */
    template <int n, int m>
    void
    eliminate_with_pivots(Lane (&A)[n][n + m], const int lane)
    {
      Eigen::MatrixXd matrix(n, n), right(n, m);
      for (int i = 0; i < n; ++i)
        for (int k = 0; k < n + m; ++k)
          (k < n ? matrix(i, k) : right(i, k - n)) = A[i][k].values[lane];
      const Eigen::MatrixXd result = solution(matrix, right);
      for (int i = 0; i < n; ++i)
        for (int k = 0; k < m; ++k)
          A[i][n + k].values[lane] = result(i, k);
    }



    /** Stage triads of four nodes: [D_1 … D_s] (I − h W) = [D_i … D_i], W with the blocks a_kl Ω~_l. */
    template <int s>
    void
    stage_triads(const Tableau &t, const double h, const Vec3<Lane> *spin, const Mat3<Lane> &D_start, Mat3<Lane> *D)
    {
      if constexpr (s == 1)
        {
          // D (I − r~) = D_i with r = h a Ω, in closed form: D = D_i (I + r~ + r rᵀ)/(1 + |r|²)
          const Vec3<Lane> r      = Lane(h * t.a(0, 0)) * spin[0];
          const Lane       factor = Lane(1) / (Lane(1) + r(0) * r(0) + r(1) * r(1) + r(2) * r(2));
          for (int i = 0; i < 3; ++i)
            {
              const Lane a = D_start(i, 0), b = D_start(i, 1), c = D_start(i, 2),
                         along = a * r(0) + b * r(1) + c * r(2);
              D[0](i, 0)       = factor * (a + b * r(2) - c * r(1) + along * r(0));
              D[0](i, 1)       = factor * (b + c * r(0) - a * r(2) + along * r(1));
              D[0](i, 2)       = factor * (c + a * r(1) - b * r(0) + along * r(2));
            }
        }
      else
        {
          // transposed: (−Ω~)ᵀ = Ω~
          constexpr int n    = 3 * s;
          const auto    fill = [&](Lane(&A)[n][n + 3]) {
            for (int k = 0; k < s; ++k)
              for (int l = 0; l < s; ++l)
                {
                  const Vec3<Lane> r           = Lane(h * t.a(k, l)) * spin[l];
                  const Lane       unit        = k == l ? 1. : 0.;
                  const Lane       block[3][3] = {{unit, -r(2), r(1)}, {r(2), unit, -r(0)}, {-r(1), r(0), unit}};
                  for (int i = 0; i < 3; ++i)
                    for (int j = 0; j < 3; ++j)
                      A[3 * k + i][3 * l + j] = block[i][j];
                }
            for (int k = 0; k < s; ++k)
              for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j)
                  A[3 * k + i][n + j] = D_start(j, i);
          };
          Lane A[n][n + 3];
          fill(A);
          if (!eliminate<n, 3>(A))
            {
              fill(A);
              for (int lane = 0; lane < 4; ++lane)
                eliminate_with_pivots<n, 3>(A, lane);
            }
          for (int k = 0; k < s; ++k)
            for (int i = 0; i < 3; ++i)
              for (int j = 0; j < 3; ++j)
                D[k](j, i) = A[3 * k + i][n + j];
        }
    }



    /** The product of a matrix and a vector, added. */
    void
    add_product(const Mat3<Lane> &A, const Lane &factor, const Vec3<Lane> &v, Vec3<Lane> &sum)
    {
      for (int i = 0; i < 3; ++i)
        sum(i) += factor * (A(i, 0) * v(0) + A(i, 1) * v(1) + A(i, 2) * v(2));
    }



    /** Places and triads. */
    void
    store(const FourNodes &nodes, const Vec3<Lane> &x, const Mat3<Lane> &D, std::vector<double> &q)
    {
      Lane lanes[12];
      std::copy_n(x.data(), 3, lanes);
      std::copy_n(D.data(), 9, lanes + 3);
      nodes.store(12, lanes, q);
    }



    /** Of a symmetric 6×6 matrix. */
    constexpr unsigned int n_in_triangle = 21;

    /** Its product with a vector, from the rows of its upper triangle. */
    void
    multiply_symmetric(const Lane *M, const Lane *x, Lane *result)
    {
      for (int i = 0; i < 6; ++i)
        result[i] = 0.;
      for (int i = 0; i < 6; ++i)
        {
          result[i] += *M++ * x[i];
          for (int j = i + 1; j < 6; ++j, ++M)
            {
              result[i] += *M * x[j];
              result[j] += *M * x[i];
            }
        }
    }



    /** Add factor · D Ω~ to @p sum: a row of it is that row of D crossed with Ω. */
    void
    add_rate_of_triad(const Mat3<Lane> &D, const Lane &factor, const Vec3<Lane> &spin, Mat3<Lane> &sum)
    {
      for (int i = 0; i < 3; ++i)
        {
          const Lane a = factor * D(i, 0), b = factor * D(i, 1), c = factor * D(i, 2);
          sum(i, 0) += b * spin(2) - c * spin(1);
          sum(i, 1) += c * spin(0) - a * spin(2);
          sum(i, 2) += a * spin(1) - b * spin(0);
        }
    }
  } // namespace



  template <int s>
  void
  StageIntegrator::move_nodes(const State &state, const double h)
  {
    const unsigned int n_nodes = system.layout.n_nodes;
    const auto         move    = [&](const unsigned int begin, const unsigned int end) {
      for (unsigned int first = 1 + 4 * begin; first < std::min(1 + 4 * end, n_nodes); first += 4)
        {
          const FourNodes nodes(first, n_nodes);
          Lane            start[12], y[s][6];
          nodes.load(12, state.q, start);
          const Vec3<Lane> x_start = Eigen::Map<const Vec3<Lane>>(start);
          const Mat3<Lane> D_start = Eigen::Map<const Mat3<Lane>>(start + 3);
          Vec3<Lane>       spin[s], velocity[s];
          Mat3<Lane>       D[s];
          for (int k = 0; k < s; ++k)
            {
              nodes.load(6, stages[k].y, y[k]);
              spin[k] = Eigen::Map<const Vec3<Lane>>(y[k] + 3);
            }
          stage_triads<s>(tableau, h, spin, D_start, D);

          Vec3<Lane> x_final = x_start;
          Mat3<Lane> D_final = D_start;
          for (int k = 0; k < s; ++k)
            {
              const Lane hb = h * tableau.b(k);
              velocity[k].setZero();
              add_product(D[k], Lane(1), Eigen::Map<const Vec3<Lane>>(y[k]), velocity[k]);
              for (int i = 0; i < 3; ++i)
                x_final(i) += hb * velocity[k](i);
              add_rate_of_triad(D[k], hb, spin[k], D_final);
            }
          for (int k = 0; k < s; ++k)
            {
              Vec3<Lane> x = x_start;
              for (int l = 0; l < s; ++l)
                for (int i = 0; i < 3; ++i)
                  x(i) += Lane(h * tableau.a(k, l)) * velocity[l](i);
              store(nodes, x, D[k], stages[k].q);
              if (turns)
                store(nodes, x, reciprocal_axes(D[k]), stages[k].reciprocal);
              if (turns && !air.is_empty())
                store(nodes, x, nearest_rotation(D[k]), stages[k].nearest);
            }
          store(nodes, x_final, D_final, final_q);
        }
    };
    parallel_for((n_nodes + 2) / 4, worth_threads, std::cref(move)); // a reference needs no memory of its own
  }



  void
  StageIntegrator::move_stages(const State &state, const double h)
  {
    const unsigned int s = tableau.s;
    for (auto &stage : stages)
      {
        stage.q.resize(state.q.size());
        std::copy_n(state.q.begin(), 12, stage.q.begin()); // the ground
        if (turns)
          std::copy_n(state.q.begin(), 12, stage.reciprocal.begin());
        if (!stage.nearest.empty())
          std::copy_n(state.q.begin(), 12, stage.nearest.begin());
        stage.coordinates = state.coordinates;
      }
    final_q.resize(state.q.size());
    std::copy_n(state.q.begin(), 12, final_q.begin());
    final_coordinates = state.coordinates;
    switch (s)
      {
        case 1:
          move_nodes<1>(state, h);
          break;
        case 2:
          move_nodes<2>(state, h);
          break;
        default:
          move_nodes<3>(state, h);
      }
    for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
      for (unsigned int k = 0; k < s; ++k)
        {
          for (unsigned int l = 0; l < s; ++l)
            stages[k].coordinates[i] += h * tableau.a(k, l) * stages[l].rates[i];
          final_coordinates[i] += h * tableau.b(k) * stages[k].rates[i];
        }
  }



  void
  StageIntegrator::find_excesses(const double h)
  {
    const unsigned int n_strains = system.layout.n_strains;
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        Stage &stage = stages[k];
        e            = e_start;
        for (unsigned int l = 0; l < tableau.s; ++l)
          for (unsigned int i = 0; i < n_strains; ++i)
            e[i] += h * tableau.a_alpha(k, l) * stages[l].strain_rates[i];
        for (unsigned int i = 0; i < products.size(); ++i)
          e[products[i].factor] = stage.factors[i];
        stage.excess.resize(n_strains);
        system.stresses(e.data(), stage.strain_rates.data(), stage.excess.data());
        for (unsigned int i = 0; i < n_strains; ++i)
          stage.excess[i] -= stage.stress[i];
      }
  }



  void
  StageIntegrator::evaluate_strain_rates(const double h)
  {
    for (auto &stage : stages)
      {
        stage.strain_rates.resize(system.layout.n_strains);
        system.strain_rates(stage.point(), stage.strain_rates.data());
      }
    find_products(products, tableau, h, e_start, stages);
  }



  void
  StageIntegrator::find_products(const std::vector<StrainProduct> &products,
                                 const Tableau                    &tableau,
                                 const double                      h,
                                 const std::vector<double>        &e_start,
                                 std::vector<Stage>               &stages)
  {
    // Gauss' rule: with e = e_i + h Σ a ė the sum h Σ b e ė is ½ (e_f² − e_i²), whatever the rates are
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        Stage &stage = stages[k];
        stage.factors.resize(products.size());
        for (unsigned int i = 0; i < products.size(); ++i)
          {
            const auto &p      = products[i];
            double      factor = e_start[p.factor];
            for (unsigned int l = 0; l < tableau.s; ++l)
              factor += h * tableau.a(k, l) * stages[l].strain_rates[p.factor];
            stage.factors[i]             = factor;
            stage.strain_rates[p.result] = factor * stage.strain_rates[p.factor] + stage.strain_rates[p.rest];
          }
      }
  }



  void
  StageIntegrator::change_of_stresses(const unsigned int   k,
                                      const double        *e,
                                      const double        *rates,
                                      std::vector<double> &stress) const
  {
    system.stresses(e, rates, stress.data());
    const Stage &stage = stages[k];
    for (unsigned int i = 0; i < products.size(); ++i)
      stress[products[i].factor] =
        stress[products[i].rest] * stage.factors[i] + stage.stress[products[i].rest] * e[products[i].factor];
  }



  void
  StageIntegrator::evaluate_constraints(const State &state, const double h)
  {
    for (auto &stage : stages)
      {
        stage.constraint_rates.resize(system.layout.n_multipliers);
        system.constraint_rates(stage.point(), stage.constraint_rates.data());
      }
    close_constraints(state, h);
  }



  void
  StageIntegrator::close_constraints(const State &state, const double h)
  {
    const unsigned int s = tableau.s, n_multipliers = system.layout.n_multipliers;
    if (n_multipliers == 0)
      return;
    std::fill(mean_rates.begin(), mean_rates.end(), 0.);
    for (unsigned int k = 0; k < s; ++k)
      for (unsigned int i = 0; i < n_multipliers; ++i)
        mean_rates[i] += tableau.b(k) * stages[k].constraint_rates[i];

    Point<double> end = stages[0].point();
    end.q             = final_q.data();
    end.reciprocal = end.nearest = nullptr;
    end.coordinates              = final_coordinates.data();
    final_states                 = state.states;
    for (unsigned int k = 0; k < s; ++k)
      for (unsigned int i = 0; i < final_states.size(); ++i)
        final_states[i] += final_weights(k) * (stages[k].states[i] - state.states[i]);
    end.states = final_states.data();
    end.time   = state.time + h;
    constraints_at_end.assign(system.size() + 6, 0.);
    system.add_gaps(end, constraints_at_end.data());
    // how often an angle has turned is what the rates say
    for (const auto i : system.layout.angles)
      {
        double &gap = constraints_at_end[system.layout.of_multiplier(i)];
        gap += 2 * M_PI * std::round((h * mean_rates[i] - gap) / (2 * M_PI));
      }
    for (auto &stage : stages)
      for (unsigned int i = 0; i < n_multipliers; ++i)
        {
          const int row       = system.layout.of_multiplier(i);
          stage.residual[row] = !is_active[i] ? 0. :
                                is_nonholonomic[i] ?
                                                stage.constraint_rates[i] :
                                                stage.constraint_rates[i] - mean_rates[i] + constraints_at_end[row] / h;
        }
    for (const auto &correction : system.layout.corrections)
      {
        const double force = force_of(correction, h);
        for (auto &stage : stages)
          stage.residual[system.layout.of_coordinate(correction.coordinate)] -=
            force * stage.rates[correction.coordinate];
      }
  }



  double
  StageIntegrator::force_of(const Layout::Correction &correction, const double h) const
  {
    const auto rate       = [&](const unsigned int k) { return stages[k].rates[correction.coordinate]; };
    const auto multiplier = [&](const unsigned int k) { return stages[k].multipliers[correction.multiplier]; };
    // less what the iteration has not closed yet: over a small turn a multiple of the gap would keep it from
    // converging. At the end the force does no work at all, not even over the round-off that is left of the gap
    constexpr double   closed  = 1e-13; // parts of the model's length, or rad
    const unsigned int i       = correction.multiplier;
    const double       gap     = constraints_at_end[system.layout.of_multiplier(i)];
    const bool         is_open = gap_scale[i] * std::abs(gap) > closed * length;
    return force_of<double>(
      tableau, h, unit_of(correction), rate, multiplier, mean_rates[i] - (is_open ? gap / h : 0.));
  }



  void
  StageIntegrator::make_inertias()
  {
    const unsigned int n_nodes = system.layout.n_nodes;
    inertias.clear();
    inertias.reserve(n_in_triangle * ((n_nodes + 2) / 4));
    for (unsigned int first = 1; first < n_nodes; first += 4)
      {
        const FourNodes nodes(first, n_nodes);
        for (int i = 0; i < 6; ++i)
          for (int j = i; j < 6; ++j)
            {
              Lane M;
              for (int l = 0; l < 4; ++l)
                M.values[l] = system.model.nodes[nodes[l]].inertia(i, j);
              inertias.push_back(M);
            }
      }
  }



  template <int s>
  void
  StageIntegrator::add_inertia(const State &state, const double h, double *const energies)
  {
    const unsigned int n_nodes = system.layout.n_nodes;
    const auto         add     = [&](const unsigned int begin, const unsigned int end) {
      for (unsigned int group = begin; group < end; ++group)
        {
          const FourNodes   nodes(1 + 4 * group, n_nodes);
          const Lane *const M = &inertias[n_in_triangle * group];
          Lane              start[6], y[s][6];
          nodes.load(6, state.y, start);
          for (int k = 0; k < s; ++k)
            nodes.load(6, stages[k].y, y[k]);
          Lane energy = 0.;
          for (int k = 0; k < s; ++k)
            {
              Lane acceleration[6], p[6], forces[6], r[6];
              for (int i = 0; i < 6; ++i)
                {
                  acceleration[i] = Lane(tableau.w(k, 0) / h) * (y[0][i] - start[i]);
                  for (int l = 1; l < s; ++l)
                    acceleration[i] += Lane(tableau.w(k, l) / h) * (y[l][i] - start[i]);
                }
              multiply_symmetric(M, y[k], p);
              if (turns)
                nodes.store(6, p, stages[k].momenta);
              multiply_symmetric(M, acceleration, forces);
              nodes.load_unknowns(stages[k].residual, r);
              Lane twice_energy = 0.;
              for (int i = 0; i < 6; ++i)
                {
                  r[i] += forces[i];
                  twice_energy += p[i] * y[k][i];
                }
              // −ad*_y p = (ω × l, ω × a + v × l) of the momenta l, a
              const Lane *const v = y[k], *const w = v + 3;
              for (int i = 0; i < 3; ++i)
                {
                  const int m = (i + 1) % 3, n = (i + 2) % 3;
                  r[i] += w[m] * p[n] - w[n] * p[m];
                  r[3 + i] += w[m] * p[3 + n] - w[n] * p[3 + m] + v[m] * p[n] - v[n] * p[m];
                }
              nodes.store_unknowns(r, stages[k].residual);
              energy += Lane(0.5 * tableau.b(k)) * twice_energy;
            }
          energies[group] = nodes.sum(energy);
        }
    };
    parallel_for((n_nodes + 2) / 4, worth_threads, std::cref(add)); // a reference needs no memory of its own
  }



  double
  StageIntegrator::add_inertia(const State &state, const double h)
  {
    thread_local std::vector<double> energies;
    energies.resize((system.layout.n_nodes + 2) / 4);
    switch (tableau.s)
      {
        case 1:
          add_inertia<1>(state, h, energies.data());
          break;
        case 2:
          add_inertia<2>(state, h, energies.data());
          break;
        default:
          add_inertia<3>(state, h, energies.data());
      }
    return std::accumulate(energies.begin(), energies.end(), 0.);
  }



  void
  StageIntegrator::find_state_rates(const State &state, const double h)
  {
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        stages[k].state_rates.assign(system.layout.n_states, 0.);
        for (unsigned int i = 0; i < system.layout.n_states; ++i)
          for (unsigned int l = 0; l < tableau.s; ++l)
            stages[k].state_rates[i] += tableau.w(k, l) / h * (stages[l].states[i] - state.states[i]);
      }
  }



  void
  StageIntegrator::evaluate(const State &state, const double h)
  {
    find_state_rates(state, h); // what is prescribed may ask for them
    // the iterated stress in its place; what it lacks, with the B of the matrices (mixed Newton)
    for (auto &stage : stages)
      {
        stage.residual.assign(system.size() + 6, 0.);
        stage.strain_rates.resize(system.layout.n_strains);
        stage.constraint_rates.resize(system.layout.n_multipliers);
        system.add_bonds_and_rates(stage.point(),
                                   stage.residual.data(),
                                   stage.strain_rates.data(),
                                   stage.constraint_rates.data());
        if (turns)
          find_powers(stage);
        system.add_loads_and_states(stage.point(), stage.residual.data());
      }
    find_products(products, tableau, h, e_start, stages);
    find_excesses(h);
    if (is_exact)
      use_strains_of_stages();
    for (unsigned int k = 0; k < tableau.s; ++k)
      strains_in_matrix(k).add_forces(stages[k].excess.data(), stages[k].residual.data());
    kinetic_energy = add_inertia(state, h);
    for (auto &stage : stages)
      for (unsigned int i = 0; i < system.layout.n_states; ++i)
        if (!system.model.states[i].is_algebraic)
          stage.residual[system.layout.of_state(i)] += stage.state_rates[i];
    evaluate_stops(h);
    evaluate_springs(h);
    if (!contacts.is_empty())
      evaluate_contacts(h);
    close_constraints(state, h);
    if (turns)
      take_work_back();
  }



  void
  StageIntegrator::find_powers(Stage &stage)
  {
    stage.powers.assign(rotation->n_sets(), 0.);
    rotation->add_powers_of_rows(stage.y.data(), stage.rates.data(), stage.residual.data(), stage.powers.data());
    rotation->subtract_powers_of_strains(stage.stress.data(), stage.strain_rates.data(), stage.powers.data());
  }



  void
  StageIntegrator::take_work_back()
  {
    for (Stage &stage : stages)
      {
        rotation->subtract_powers_of_constraints(stage.multipliers.data(),
                                                 stage.constraint_rates.data(),
                                                 stage.rates.data(),
                                                 stage.powers.data());
        rotation->take_back(stage.q.data(),
                            stage.reciprocal.data(),
                            stage.y.data(),
                            stage.momenta.data(),
                            stage.powers.data(),
                            stage.residual.data());
      }
  }
} // namespace samara
