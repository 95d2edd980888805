#include <samara/base/dense.h>
#include <samara/solvers/newton.h>
#include <samara/solvers/redundant_rows.h>
#include <samara/solvers/row_scale.h>

#include <Eigen/SparseQR>

#include <algorithm>
#include <cmath>
#include <map>

namespace samara
{
  namespace
  {
    /** A row that is nearer than this to the span of others, in the first position, may repeat them. */
    constexpr double dependent = 1e-5;

    /** How far a small motion goes [rad, or parts of the model's size]. */
    constexpr double small_motion = 0.01;

    /** After it a row must not be further than this from the span of others to be redundant: that is small_motion^1.5.
     */
    constexpr double still_dependent = 1e-3;

    /** Largest entry of the combinations that is left as it is. */
    constexpr double good = 2;

    /** How far things move until a choice is looked at again [rad, or parts of the model's size]. */
    constexpr double least_motion = 0.1, most_motion = 0.5;

    /** Up to this many rows dense elimination takes less than a second. */
    constexpr int few_rows = 300;
  } // namespace



  RedundantRows::RedundantRows(const System &system)
    : system(system)
    , n(system.layout.of_multiplier(0))
    , m(system.layout.n_multipliers)
    , length(model_length(system.model))
    , K(system.layout.pattern)
    , unit(n, 1.)
    , scale(m, 0.)
    , is_absent(m, false)
    , no_multipliers(m, 0.)
  {
    for (int i = 0; i < system.layout.n_kinematic(); ++i)
      unit[i] = system.layout.is_length(i) ? 1. : length;
  }



  void
  RedundantRows::assemble(const State &state)
  {
    K.clear();
    Point<double> point = state.point();
    point.multipliers   = no_multipliers.data(); // the rows alone
    system.add_constraint_tangent(point, K);
    for (int i = 0; i < m; ++i)
      {
        scale[i]     = row_scale(system.layout, K, i, length);
        is_absent[i] = scale[i] == 0 && K.values[K.pattern->position(n + i, n + i)] != 0;
      }
  }



  bool
  RedundantRows::exchange(std::vector<unsigned int> &left_out)
  {
    bool has_changed = false;
    for (;;)
      {
        const Entry largest = largest_entry();
        if (!(largest.size > good) || !(largest.size < singular))
          return has_changed;
        swap(left_out, largest.row, largest.column);
        has_changed = true;
        ++n_exchanges;
      }
  }



  void
  RedundantRows::swap(std::vector<unsigned int> &left_out, const int i, const int j)
  {
    // X ← X X[rows]⁻¹ with row i for the one that was left out
    const Eigen::VectorXd column = X.col(j) / X(i, j);
    Eigen::RowVectorXd    change = X.row(i);
    change(j) -= 1;
    for (int l = 0; l < X.cols(); ++l)
      if (change(l) != 0.)
        {
          X.col(l) -= column * change(l);
          find_rows_of(l);
        }
    left_out[j]   = i;
    left_out_of_X = left_out;
  }



  bool
  RedundantRows::is_good_swap(const int i, const int j) const
  {
    for (int l = 0; l < X.cols(); ++l)
      if (const double change = (X(i, l) - (l == j ? 1. : 0.)) / X(i, j);
          std::abs(change) > 1e-12 && !((X.col(l) - X.col(j) * change).lpNorm<Eigen::Infinity>() <= good))
        return false;
    return true;
  }



  void
  RedundantRows::spread(std::vector<unsigned int> &left_out)
  {
    // what the rows of one joint cost: how many are kept, times the unknowns they couple
    std::vector<int> joint(m, 0), n_kept;
    const Item      *last = nullptr;
    for (int i = 0; i < m; ++i)
      {
        const Item &owner = system.layout.owner_of_multiplier(i);
        if (&owner != last)
          n_kept.push_back(0);
        last     = &owner;
        joint[i] = n_kept.size() - 1;
        ++n_kept.back();
      }
    for (const auto i : left_out)
      --n_kept[joint[i]];
    const auto n_entries = [&](const int i) {
      return K.pattern->column_start[n + i + 1] - K.pattern->column_start[n + i];
    };
    for (unsigned int j = 0; j < left_out.size(); ++j)
      {
        const int now  = left_out[j];
        int       best = now, largest = (n_kept[joint[now]] + 1) * n_entries(now);
        for (int i = 0; i < m; ++i)
          if (const int cost = n_kept[joint[i]] * n_entries(i);
              cost > largest && 1 / std::abs(X(i, j)) <= good && is_good_swap(i, j))
            {
              best    = i;
              largest = cost;
            }
        if (best == now)
          continue;
        swap(left_out, best, j);
        ++n_kept[joint[now]];
        --n_kept[joint[best]];
      }
  }



  double
  RedundantRows::motion_since_look(const State &state) const
  {
    if (checked.left_out != state.left_out || checked.held != state.held || checked.q.size() != state.q.size())
      return std::nan("");
    double largest = 0;
    for (unsigned int i = 0; i < state.q.size(); ++i)
      largest = std::max(largest, std::abs(state.q[i] - checked.q[i]) / (i % 12 < 3 ? length : 1.));
    return largest;
  }



  double
  RedundantRows::motion_until_next(const Entries &before, const double motion) const
  {
    if (before.rows != rows_of || *std::max_element(independence.begin(), independence.end()) > exact)
      return least_motion;
    double change = 0;
    for (unsigned int j = 0; j < rows_of.size(); ++j)
      for (unsigned int k = 0; k < rows_of[j].size(); ++k)
        change = std::max(change, std::abs(X(rows_of[j][k], j) - before.values[j][k]));
    // half of what they may still grow by as they do now
    return std::clamp(0.5 * (good - largest_entry().size) * motion / change, least_motion, most_motion);
  }



  void
  RedundantRows::take_in_independent(std::vector<unsigned int> &left_out)
  {
    // one after the other, as one may say what others lack, too
    while (!left_out.empty())
      {
        factorize(left_out);
        find_combinations(left_out);
        const auto largest = std::max_element(independence.begin(), independence.end());
        if (*largest < still_dependent)
          return;
        left_out.erase(left_out.begin() + (largest - independence.begin()));
      }
  }



  void
  RedundantRows::keep_forces(State &state, const std::vector<unsigned int> &left_out) const
  {
    // λ − X λ[left out]: the same forces, and zero on the rows left out
    Eigen::VectorXd of_left_out(left_out.size());
    for (unsigned int j = 0; j < left_out.size(); ++j)
      of_left_out(j) = state.multipliers[left_out[j]] / scale[left_out[j]];
    if (of_left_out.isZero(0.))
      return;
    const Eigen::VectorXd change = X * of_left_out;
    for (int i = 0; i < m; ++i)
      state.multipliers[i] -= scale[i] * change(i);
    for (const auto i : left_out)
      state.multipliers[i] = 0;
  }



  bool
  RedundantRows::choose(State &state)
  {
    const double motion = motion_since_look(state);
    if (state.left_out.empty() || motion <= next_motion)
      return false;
    if (!rounding.is_known)
      measure_rounding(state);
    Entries before;
    if (std::isfinite(motion) && left_out_of_X == state.left_out)
      before = entries();
    next_motion  = least_motion;
    checked.q    = state.q;
    checked.held = state.held;
    assemble(state);
    auto left_out = state.left_out;
    try
      {
        factorize(left_out);
        find_combinations(left_out);
        // at a singular position the rows kept have combinations of their own: nothing can be said there
        if (largest_entry().size < singular)
          {
            if (*std::max_element(independence.begin(), independence.end()) > still_dependent)
              take_in_independent(left_out);
            if (!left_out.empty())
              {
                if (!exchange(left_out) && left_out == state.left_out)
                  next_motion = motion_until_next(before, motion);
                keep_forces(state, left_out);
              }
          }
      }
    catch (const SingularMatrix &)
      {
        left_out = state.left_out;
      }
    std::sort(left_out.begin(), left_out.end());
    const bool has_changed = left_out != state.left_out;
    state.left_out = checked.left_out = left_out;
    return has_changed;
  }



  bool
  RedundantRows::is_certainly_independent()
  {
    try
      {
        factorize({});
        // a dependent row, 1e-5 of its length away from the others at most, would make it smaller
        return std::all_of(scale.begin(), scale.end(), [](const double s) { return s > 0; }) &&
               solver->reciprocal_condition() > 1e-8;
      }
    catch (const SingularMatrix &)
      {
        return false;
      }
  }



  std::vector<unsigned int>
  RedundantRows::dependent_rows()
  {
    // columns of Gᵀ by elimination with a choice of columns: those that are left depend on the others
    std::vector<unsigned int> rows;
    const auto                rest = [&](const int rank, const auto &column) {
      for (int k = rank; k < m; ++k)
        if (const unsigned int i = column(k); !is_absent[i])
          rows.push_back(i);
    };
    // of the unknowns only those that have a part in constraints
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<int>                    number(n, -1);
    int                                 n_used = 0;
    for (int j = 0; j < m; ++j)
      for (int k = K.pattern->column_start[n + j]; k < K.pattern->column_start[n + j + 1]; ++k)
        if (const int i = K.pattern->rows[k]; i < n && K.values[k] != 0.)
          {
            if (number[i] < 0)
              number[i] = n_used++;
            entries.emplace_back(number[i], j, K.values[k] * scale[j] / unit[i]);
          }
    Eigen::SparseMatrix<double> Gt(n_used, m);
    Gt.setFromTriplets(entries.begin(), entries.end());
    if (m <= few_rows)
      {
        const PivotedQr qr(Gt, dependent);
        rest(qr.rank(), [&](const int k) { return qr.column(k); });
      }
    else if (!is_certainly_independent())
      {
        Gt.makeCompressed();
        Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> qr;
        qr.setPivotThreshold(dependent);
        qr.compute(Gt);
        rest(qr.rank(), [&](const int k) { return qr.colsPermutation().indices()(k); });
      }
    std::sort(rows.begin(), rows.end());
    return rows;
  }



  State
  RedundantRows::moved(const State &state, const std::vector<unsigned int> &left_out)
  {
    // along the velocity of the state, or any other that the rows kept allow, and back to where they hold
    std::vector<double> b(n + m, 0.), z(n + m, 0.);
    const auto          set = [&](const auto &velocity) {
      std::fill(b.begin(), b.end(), 0.);
      for (int i = 0; i < n; ++i)
        b[i] = velocity(i) * unit[i];
      solver->solve(b.data());
      for (int i = 0; i < n; ++i)
        z[i] = b[i] / unit[i];
      return size_of_step(system, z, length);
    };
    const int  n_twists = system.layout.of_coordinate(0);
    const int  n_moving = system.layout.n_kinematic();
    double     size     = set([&](const int i) {
      return i < n_twists ? state.y[6 + i] : i < n_moving ? state.rates[i - n_twists] : 0.;
    });
    const auto any      = [&](const int i) { return i < n_moving ? std::sin(1. + 1.7 * i) / unit[i] : 0.; };
    if (size == 0)
      size = set(any);
    auto out = left_out;
    if (size == 0)
      {
        // all that could move is prescribed: what is redundant does not depend on drives
        for (const auto &prescribed : system.model.prescribed)
          out.push_back(prescribed.second);
        factorize(out);
        size = set(any);
      }
    State result    = state;
    result.left_out = {};
    // below is what round-off leaves of a random velocity
    if (!(size > 1e-9))
      return result; // a structure
    for (auto &value : z)
      value *= small_motion / size;
    std::fill(z.begin() + n, z.end(), 0.);
    system.update(result, z);
    close(result, out);
    return result;
  }



  void
  RedundantRows::close(State &state, const std::vector<unsigned int> &left_out)
  {
    std::vector<double> r, b(n + m), z(n + m, 0.);
    for (unsigned int iteration = 0; iteration < 8; ++iteration)
      {
        assemble(state);
        factorize(left_out);
        r.assign(n + m + 6, 0.);
        system.add_gaps(state.point(), r.data());
        std::fill(b.begin(), b.end(), 0.);
        for (int i = 0; i < m; ++i)
          b[n + i] = -r[n + i] * scale[i];
        for (const auto i : left_out)
          b[n + i] = 0;
        solver->solve(b.data());
        for (int i = 0; i < n; ++i)
          z[i] = b[i] / unit[i];
        system.update(state, z);
        if (size_of_step(system, z, length) < 1e-12)
          return;
      }
  }



  std::vector<unsigned int>
  RedundantRows::find(const State &state)
  {
    if (m == 0)
      return {};
    assemble(state);
    auto rows = dependent_rows();
    if (rows.empty())
      return rows;
    generic          = state; // if nothing better is found
    generic.left_out = rows;
    try
      {
        factorize(rows);
        generic = moved(state, rows);
        assemble(generic);
        take_in_independent(rows);
      }
    catch (const SingularMatrix &)
      {
        return rows; // what elimination said must do
      }
    if (!rows.empty() && X.cwiseAbs().maxCoeff() < singular)
      {
        exchange(rows);
        spread(rows);
      }
    std::sort(rows.begin(), rows.end());
    generic.left_out = rows;
    return rows;
  }



  std::vector<unsigned int>
  RedundantRows::dependent_here(const State &state)
  {
    assemble(state);
    return dependent_rows();
  }
} // namespace samara
