// The stages of a step: where they are, and how far their equations are from being satisfied.

#include <samara/time/stage_integrator.h>

#include <cmath>

namespace samara
{
  namespace
  {
    /**
     * Solve A X = B by elimination without pivoting, all in place; A has a dominant diagonal for steps that have a
     * solution. False if a pivot is small all the same.
     */
    template <int n, int m>
    bool
    eliminate(double (&A)[n][n + m])
    {
      for (int i = 0; i < n; ++i)
        {
          if (!(std::abs(A[i][i]) > 0.1))
            return false;
          const double inverse = 1 / A[i][i];
          for (int k = i + 1; k < n + m; ++k)
            A[i][k] *= inverse;
          for (int j = i + 1; j < n; ++j)
            for (int k = i + 1; k < n + m; ++k)
              A[j][k] -= A[j][i] * A[i][k];
        }
      for (int i = n - 1; i > 0; --i)
        for (int j = 0; j < i; ++j)
          for (int k = n; k < n + m; ++k)
            A[j][k] -= A[j][i] * A[i][k];
      return true;
    }



    /** Stage triads: [D_1 … D_s] (I − h W) = [D_i … D_i], W with the blocks a_kl Ω~_l. */
    template <int s>
    void
    stage_triads(const Tableau &t, const double h, const Vector3 *spin, const Matrix3 &D_start, Matrix3 *D)
    {
      if constexpr (s == 1)
        {
          // D (I − r~) = D_i with r = h a Ω, in closed form
          const Vector3 r       = h * t.a(0, 0) * spin[0];
          const Matrix3 inverse = (Matrix3::Identity() + skew(r) + r * r.transpose()) / (1 + r.squaredNorm());
          D[0].noalias()        = D_start * inverse;
        }
      else
        {
          // transposed: (−Ω~)ᵀ = Ω~
          constexpr int n     = 3 * s;
          const auto    block = [&](const int k, const int l) -> Matrix3 {
            return h * t.a(k, l) * skew(spin[l]) + (k == l ? 1. : 0.) * Matrix3::Identity();
          };
          double A[n][n + 3];
          for (int k = 0; k < s; ++k)
            {
              for (int l = 0; l < s; ++l)
                {
                  const Matrix3 a_kl = block(k, l);
                  for (int i = 0; i < 3; ++i)
                    for (int j = 0; j < 3; ++j)
                      A[3 * k + i][3 * l + j] = a_kl(i, j);
                }
              for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j)
                  A[3 * k + i][n + j] = D_start(j, i);
            }
          if (eliminate<n, 3>(A))
            for (int k = 0; k < s; ++k)
              for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j)
                  D[k](j, i) = A[3 * k + i][n + j];
          else
            {
              Eigen::Matrix<double, n, n> matrix;
              for (int k = 0; k < s; ++k)
                for (int l = 0; l < s; ++l)
                  matrix.template block<3, 3>(3 * k, 3 * l) = block(k, l);
              const Eigen::Matrix<double, n, 3> solution =
                matrix.partialPivLu().solve(D_start.transpose().template replicate<s, 1>().eval());
              for (int k = 0; k < s; ++k)
                D[k] = solution.template middleRows<3>(3 * k).transpose();
            }
        }
    }
  } // namespace



  void
  StageIntegrator::move_stages(const State &state, const double h)
  {
    const unsigned int s = tableau.s;
    for (auto &stage : stages)
      {
        stage.q           = state.q;
        stage.coordinates = state.coordinates;
      }
    final_q           = state.q;
    final_coordinates = state.coordinates;
    Vector3 spin[3], velocity[3];
    Matrix3 D[3];
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const Matrix3 D_start = state.triad(node);
        for (unsigned int k = 0; k < s; ++k)
          spin[k] = Eigen::Map<const Vector3>(&stages[k].y[6 * node + 3]);
        switch (s)
          {
            case 1:
              stage_triads<1>(tableau, h, spin, D_start, D);
              break;
            case 2:
              stage_triads<2>(tableau, h, spin, D_start, D);
              break;
            default:
              stage_triads<3>(tableau, h, spin, D_start, D);
          }
        for (unsigned int k = 0; k < s; ++k)
          velocity[k] = D[k] * Eigen::Map<const Vector3>(&stages[k].y[6 * node]);
        Eigen::Map<Vector3> x_final(&final_q[12 * node]);
        Eigen::Map<Matrix3> D_final(&final_q[12 * node + 3]);
        for (unsigned int k = 0; k < s; ++k)
          {
            Eigen::Map<Vector3> x(&stages[k].q[12 * node]);
            for (unsigned int l = 0; l < s; ++l)
              x += h * tableau.a(k, l) * velocity[l];
            Eigen::Map<Matrix3>(&stages[k].q[12 * node + 3]) = D[k];
            x_final += h * tableau.b(k) * velocity[k];
            D_final += h * tableau.b(k) * D[k] * skew(spin[k]);
          }
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
  StageIntegrator::evaluate_stresses(const double h)
  {
    const unsigned int n_strains = system.layout.n_strains;
    for (auto &stage : stages)
      {
        stage.strain_rates.resize(n_strains);
        for (const auto &c : system.model.contributions)
          c->strain_rates(stage.point(), stage.strain_rates.data() + c->first_strain);
      }
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        Stage &stage = stages[k];
        e            = e_start;
        for (unsigned int l = 0; l < tableau.s; ++l)
          for (unsigned int i = 0; i < n_strains; ++i)
            e[i] += h * tableau.a_alpha(k, l) * stages[l].strain_rates[i];
        stage.excess.resize(n_strains);
        for (const auto &c : system.model.contributions)
          c->stresses(e.data() + c->first_strain,
                      stage.strain_rates.data() + c->first_strain,
                      stage.excess.data() + c->first_strain);
        for (unsigned int i = 0; i < n_strains; ++i)
          stage.excess[i] -= stage.stress[i];
      }
  }



  void
  StageIntegrator::evaluate_constraints(const State &state, const double h)
  {
    const unsigned int s = tableau.s, n_multipliers = system.layout.n_multipliers;
    if (n_multipliers == 0)
      return;
    std::fill(mean_rates.begin(), mean_rates.end(), 0.);
    for (unsigned int k = 0; k < s; ++k)
      {
        Stage &stage = stages[k];
        stage.constraint_rates.assign(n_multipliers, 0.);
        for (const auto *c : system.layout.constraining)
          c->constraint_rates(stage.point(), stage.constraint_rates.data());
        for (unsigned int i = 0; i < n_multipliers; ++i)
          mean_rates[i] += tableau.b(k) * stage.constraint_rates[i];
      }

    Point<double> end = stages[0].point();
    end.q             = final_q.data();
    end.coordinates   = final_coordinates.data();
    end.time          = state.time + h;
    constraints_at_end.assign(system.size() + 6, 0.);
    for (const auto *c : system.layout.constraining)
      c->constraints(end, constraints_at_end.data());
    for (auto &stage : stages)
      for (unsigned int i = 0; i < n_multipliers; ++i)
        {
          const int row       = system.layout.of_multiplier(i);
          stage.residual[row] = !is_active[i] ? 0. :
                                is_nonholonomic[i] ?
                                                stage.constraint_rates[i] :
                                                stage.constraint_rates[i] - mean_rates[i] + constraints_at_end[row] / h;
        }
    if (system.layout.corrections.empty())
      return;
    Point<double> start = stages[0].point();
    start.q             = state.q.data();
    start.coordinates   = state.coordinates.data();
    start.time          = state.time;
    constraints_at_start.assign(system.size() + 6, 0.);
    for (const auto *c : system.layout.constraining)
      c->residual(start, constraints_at_start.data());
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
    // where the coordinate turns less than this a step, ρ is a quotient of round-off, and the work not worth mentioning
    constexpr double least_turn = 1e-8;
    double           lambda = 0, squares = 0;
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        lambda += tableau.b(k) * stages[k].multipliers[correction.multiplier];
        squares += tableau.b(k) * std::pow(h * stages[k].rates[correction.coordinate], 2);
      }
    const double rho =
      h * h * mean_rates[correction.multiplier] * squares / (squares * squares + std::pow(least_turn, 4));
    return lambda * rho;
  }



  void
  StageIntegrator::evaluate(const State &state, const double h)
  {
    evaluate_stresses(h);
    kinetic_energy = 0;
    for (unsigned int k = 0; k < tableau.s; ++k)
      {
        // the iterated stress in its place; what it lacks, with the B of the matrices (mixed Newton)
        Stage &stage = stages[k];
        stage.residual.assign(system.size() + 6, 0.);
        for (unsigned int i = 0; i < frozen_strains.size(); ++i)
          {
            const Contribution &c = *system.model.contributions[i];
            c.residual(stage.point(), stage.residual.data());
            if (frozen_strains[i])
              frozen_strains[i]->add_forces(stage.excess.data() + c.first_strain, stage.residual.data());
          }
        for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
          {
            const Matrix6                  &inertia = system.model.nodes[node].inertia;
            const Eigen::Map<const Vector6> y(&stage.y[6 * node]), y_start(&state.y[6 * node]);
            Vector6                         acceleration = Vector6::Zero();
            for (unsigned int l = 0; l < tableau.s; ++l)
              acceleration += tableau.w(k, l) / h * (Eigen::Map<const Vector6>(&stages[l].y[6 * node]) - y_start);
            const Vector6 momentum = inertia * y;
            kinetic_energy += 0.5 * tableau.b(k) * momentum.dot(y);
            Eigen::Map<Vector6>(&stage.residual[system.layout.of_node(node)]) +=
              inertia * acceleration - ad_star<double>(y, momentum);
          }
      }
    evaluate_constraints(state, h);
  }
} // namespace samara
