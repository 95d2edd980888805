// The way from the drawing to where there is no gap, and from there to the nearest such place.

#include <samara/solvers/assembly.h>
#include <samara/solvers/from_eigen.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Gaps that are none [parts of the model's length], and what is left of them where round-off ends. */
    constexpr double no_gap = 1e-10, smallest_gap = 1e-15;

    /** Of the matrix where rows depend on each other: far below all that is independent. */
    constexpr double smallest_mu = 1e-13;

    /** No body turns further [rad], or moves further [of the model's length], in one step. */
    constexpr double longest_step = 0.3;

    /** Starts beside the drawing. */
    constexpr unsigned int n_other_starts = 12;

    /** A number between −1 and 1, the same on all machines. */
    double
    next_random(unsigned int &seed)
    {
      seed = 1664525u * seed + 1013904223u;
      return seed / 2147483648. - 1.;
    }
  } // namespace



  Eigen::VectorXd
  Assembly::solve(const Eigen::SparseMatrix<double> &W,
                  const Eigen::SparseMatrix<double> &G,
                  const double                       mu,
                  const Eigen::VectorXd             &a,
                  const Eigen::VectorXd             &b)
  {
    const int                           n = n_open, m = G.rows();
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < n; ++j)
      {
        for (Eigen::SparseMatrix<double>::InnerIterator e(W, j); e; ++e)
          entries.emplace_back(e.row(), j, e.value());
        for (Eigen::SparseMatrix<double>::InnerIterator e(G, j); e; ++e)
          {
            entries.emplace_back(n + e.row(), j, e.value());
            entries.emplace_back(j, n + e.row(), e.value());
          }
      }
    for (int i = 0; i < m; ++i)
      entries.emplace_back(n + i, n + i, -mu);
    Eigen::SparseMatrix<double> A(n + m, n + m);
    A.setFromTriplets(entries.begin(), entries.end());
    const auto matrix = from_eigen(A);
    if (!solver || matrix->pattern->rows != pattern->rows || matrix->pattern->column_start != pattern->column_start)
      {
        pattern = matrix->pattern;
        solver  = make_solver(pattern, Library::klu, Ordering::columns);
      }
    SparseMatrix on_pattern(pattern); // the solver knows its own by its place
    on_pattern.values = matrix->values;
    solver->factorize(on_pattern);
    std::vector<double> x(n + m);
    Eigen::Map<Eigen::VectorXd>(x.data(), n)     = a;
    Eigen::Map<Eigen::VectorXd>(x.data() + n, m) = b;
    solver->solve(x.data());
    return Eigen::Map<const Eigen::VectorXd>(x.data(), n);
  }



  double
  Assembly::close_gaps(Place &at)
  {
    constexpr unsigned int most_steps = 300;
    Eigen::VectorXd        g          = gaps_at(state_at(at));
    double                 damping    = 1;
    for (unsigned int i = 0; i < most_steps; ++i)
      {
        const double size = g.norm();
        if (!(size > smallest_gap))
          break;
        const Eigen::SparseMatrix<double> W = weights_at(at), G = rows_at(state_at(at));
        const double                      mu = std::max(damping * size * size, smallest_mu);
        Eigen::VectorXd                   step;
        try
          {
            step = solve(W, G, mu, Eigen::VectorXd::Zero(n_open), -g);
          }
        catch (const SingularMatrix &)
          {
            // Levenberg and Marquardt: with more damping the matrix is regular
            damping = std::max(10 * damping, 1e-10 / (size * size));
            continue;
          }
        const double largest = step.lpNorm<Eigen::Infinity>();
        if (largest > longest_step)
          step *= longest_step / largest;
        const Place           next   = moved(at, step);
        const Eigen::VectorXd g_next = gaps_at(state_at(next));
        const double promised = size * size - (g + G * step).squaredNorm(), gained = size * size - g_next.squaredNorm();
        // Armijo's condition: a step must gain a part of what the linear model promises
        if (!(gained > 1e-4 * promised))
          {
            // below round-off nothing becomes better; elsewhere shorter steps do
            if (size < no_gap || largest < 1e-13 || damping > 1e20)
              break;
            damping *= 8;
            continue;
          }
        if (gained > 0.7 * promised)
          damping = std::max(damping / 8, 1e-8);
        // a gap that stays: downhill there is none
        const bool is_stuck = size > no_gap && gained < 1e-13 * size * size;
        at                  = next;
        g                   = g_next;
        if (is_stuck)
          break;
      }
    return g.lpNorm<Eigen::Infinity>();
  }



  void
  Assembly::approach(Place &at)
  {
    constexpr unsigned int most_steps = 400;
    for (unsigned int i = 0; i < most_steps; ++i)
      {
        const Eigen::VectorXd gradient = gradient_at(at);
        const State           state    = state_at(at);
        const Eigen::VectorXd step =
          solve(weights_at(at), rows_at(state), smallest_mu, -gradient, Eigen::VectorXd::Zero(target.size()));
        const double slope = gradient.dot(step), largest = step.lpNorm<Eigen::Infinity>();
        // at the minimum, or as near as rotations are known; else backtracking with Armijo's condition
        if (!(slope < 0) || largest < 1e-11)
          return;
        const double before   = distance_at(at);
        bool         is_lower = false;
        for (double t = std::min(1., longest_step / largest); t > 1e-7 && !is_lower; t /= 2)
          {
            Place next = moved(at, t * step);
            is_lower   = close_gaps(next) < no_gap && distance_at(next) < before + 1e-4 * t * slope;
            if (is_lower)
              at = std::move(next);
          }
        if (!is_lower)
          return;
      }
  }



  Assembly::Place
  Assembly::shaken(unsigned int seed) const
  {
    // the first starts are near to the drawing, later ones anywhere
    const double    amplitude = 0.2 * seed;
    Eigen::VectorXd step(n_open);
    seed = 7919 * seed + 1;
    for (int i = 0; i < step.size(); ++i)
      step(i) = amplitude * next_random(seed);
    for (unsigned int p = 1; p < of_piece.size(); ++p)
      if (!of_piece[p].is_fixed)
        step.segment<3>(column[6 * (p - 1)]) *= 0.3;
    for (unsigned int c = 0; c < system.layout.n_coordinates; ++c)
      step(column[pieces.column_of_coordinate(c)]) = 0;
    return moved(place, step);
  }



  bool
  Assembly::close()
  {
    Place  best = place;
    double left = close_gaps(best);
    if (left > no_gap)
      {
        double nearest = std::numeric_limits<double>::infinity();
        for (unsigned int seed = 1; seed <= n_other_starts; ++seed)
          {
            Place        other      = shaken(seed);
            const double other_left = close_gaps(other);
            if (other_left > no_gap || distance_at(other) > nearest)
              continue;
            start   = seed;
            nearest = distance_at(other);
            best    = other;
            left    = other_left;
          }
      }
    if (left < no_gap)
      approach(best);
    place = best;
    return left < no_gap;
  }
} // namespace samara
