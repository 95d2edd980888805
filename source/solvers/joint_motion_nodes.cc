// Motions that joints make, where rigid pieces cannot follow them or are too many: all nodes move.

#include <samara/solvers/joint_motion.h>
#include <samara/solvers/linear.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Orders of magnitude from one level to the next, and the smallest weight of a rate within its level. */
    constexpr double below_strains = 1e-7, below_rates = 1e-12, smallest_weight = 0.03;

    /** Add k g gᵀ, g on the twists of two nodes. */
    void
    add_square(const Layout &layout, const RelativeRate &rate, const double k, SparseMatrix &A)
    {
      for (const unsigned int node_j : {rate.a, rate.b})
        for (const unsigned int node_i : {rate.a, rate.b})
          {
            if (node_i == 0 || node_j == 0)
              continue;
            const Vector6 &g_i = node_i == rate.a ? rate.on_a : rate.on_b,
                          &g_j = node_j == rate.a ? rate.on_a : rate.on_b;
            for (int j = 0; j < 6; ++j)
              {
                const int position = A.pattern->position(layout.of_node(node_i), layout.of_node(node_j) + j);
                for (int i = 0; i < 6; ++i)
                  A.values[position + i] += k * g_i(i) * g_j(j);
              }
          }
    }
  } // namespace



  void
  JointMotion::move_nodes()
  {
    std::vector<double> weight(rates.size(), 1.);
    // weights follow from the motion and the motion from them: one to three rounds (doc/theory/steady_rotation.md)
    for (unsigned int round = 0; round < 5; ++round)
      {
        solve_by_weights(weight);
        if (renew_weights(weight, smallest_weight) < 1e-3)
          break;
      }
    find_strain();
  }



  std::vector<double>
  JointMotion::stiffness_against_others() const
  {
    const unsigned int  n = system.layout.of_multiplier(0);
    std::vector<double> stiffness(n);
    double              largest = 0;
    for (unsigned int i = 0; i < n; ++i)
      largest = std::max(largest, stiffness[i] = K.values[K.pattern->position(i, i)]);
    for (auto &k : stiffness)
      k = k > 0 ? k : std::max(1e-6 * largest, 1.);
    return stiffness;
  }



  void
  JointMotion::solve_by_weights(const std::vector<double> &weight)
  {
    AssertDimension(weight.size(), rates.size());
    const Layout             &layout    = system.layout;
    const unsigned int        n         = layout.of_multiplier(0);
    const std::vector<double> stiffness = stiffness_against_others();
    // what moves against anything else is held by a small stiffness, and what moves at all by one far smaller
    SparseMatrix of_rates(layout.pattern), of_all(layout.pattern);
    for (unsigned int i = 0; i < n; ++i)
      of_all.values[K.pattern->position(i, i)] = below_rates * stiffness[i];
    for (unsigned int r = 0; r < rates.size(); ++r)
      {
        double k = 0, squares = 0;
        for (const auto &[node, g] :
             {std::make_pair(rates[r].a, rates[r].on_a), std::make_pair(rates[r].b, rates[r].on_b)})
          for (int i = 0; i < 6 && node > 0; ++i)
            {
              k += g(i) * g(i) * stiffness[layout.of_node(node) + i];
              squares += g(i) * g(i);
            }
        if (squares > 0)
          add_square(layout, rates[r], below_strains * weight[r] * weight[r] * k / squares, of_rates);
      }
    iterate_proximally(of_rates, of_all);
    check_constraints();
  }



  void
  JointMotion::iterate_proximally(const SparseMatrix &of_rates, const SparseMatrix &of_all)
  {
    const Layout      &layout = system.layout;
    const unsigned int n      = layout.of_multiplier(0);
    SparseMatrix       A      = K;
    A.add(1., of_rates);
    A.add(1., of_all);
    const auto solver = make_solver(layout.pattern);
    try
      {
        solver->factorize(A);
      }
    catch (const SingularMatrix &singular)
      {
        throw InputError("steady rotation: what turns is locked, or a constraint is there twice" +
                         (singular.unknown < 0 ? std::string() : ": " + layout.name_of(singular.unknown)));
      }
    // the smallest of what holds is taken away first, then both
    std::vector<double> b(system.size(), 0.), from_rates(system.size(), 0.);
    velocities.assign(system.size(), 0.);
    for (const bool both : {false, true})
      for (unsigned int iteration = 0; iteration < 100; ++iteration)
        {
          of_all.multiply(velocities.data(), b.data());
          if (both)
            of_rates.multiply(velocities.data(), from_rates.data());
          for (unsigned int i = 0; i < n; ++i)
            b[i] += from_rates[i];
          for (unsigned int i = 0; i < layout.n_multipliers; ++i)
            b[layout.of_multiplier(i)] = held[i];
          solver->solve(b.data());
          double change = 0, size = 0;
          for (unsigned int i = 0; i < n; ++i)
            {
              change = std::max(change, std::abs(b[i] - velocities[i]));
              size   = std::max(size, std::abs(b[i]));
            }
          velocities = b;
          if (change <= 1e-12 * size)
            break;
        }
  }



  void
  JointMotion::check_constraints() const
  {
    // what constraints are not obeyed, relative to the size of their rows
    const Layout       &layout = system.layout;
    std::vector<double> y      = velocities, r(system.size());
    std::fill(y.begin() + layout.of_multiplier(0), y.end(), 0.);
    K.multiply(y.data(), r.data());
    Eigen::VectorXd residual(layout.n_multipliers);
    for (unsigned int i = 0; i < layout.n_multipliers; ++i)
      {
        const int column = layout.of_multiplier(i);
        double    size   = 0;
        for (int k = K.pattern->column_start[column]; k < K.pattern->column_start[column + 1]; ++k)
          size = std::max(size, std::abs(K.values[k]));
        residual(i) = size > 0 ? (r[column] - held[i]) / size : 0.;
      }
    if (residual.size() > 0 && residual.cwiseAbs().maxCoeff() > 1e-6 * speed * std::max(1., length))
      contradict(residual);
  }
} // namespace samara
