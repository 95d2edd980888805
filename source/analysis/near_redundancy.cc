#include <samara/analysis/check.h>
#include <samara/analysis/near_redundancy.h>
#include <samara/base/dense.h>
#include <samara/base/disjoint_sets.h>
#include <samara/base/text.h>
#include <samara/solvers/newton.h>
#include <samara/solvers/redundant_rows.h>
#include <samara/solvers/rigid_pieces.h>

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** A row that is nearer than this to the span of others nearly says what they say. */
    constexpr double nearly = 1e-3;

    /** How far a small motion goes [rad, or parts of the model's size]: at singular positions rows become independent.
     */
    constexpr double small_motion = 0.01;

    /** Up to this many rows dense elimination takes less than a second. */
    constexpr unsigned int few_rows = 300;
  } // namespace



  /** Rows of G in use, each scaled to length 1, lengths divided by the size of the model. */
  class ScaledRows
  {
  public:
    ScaledRows(const System &system, const std::vector<unsigned int> &left_out)
      : system(system)
      , length(model_length(system.model))
      , K(system.layout.pattern)
      , number(system.layout.of_multiplier(0), -1)
    {
      const Layout &layout = system.layout;
      for (unsigned int i = 0; i < layout.n_multipliers; ++i)
        if (std::find(left_out.begin(), left_out.end(), i) == left_out.end())
          rows.push_back(i);
      for (const auto row : rows)
        for (int k = K.pattern->column_start[layout.of_multiplier(row)];
             k < K.pattern->column_start[layout.of_multiplier(row) + 1];
             ++k)
          if (const int i = K.pattern->rows[k]; i < layout.n_kinematic() && number[i] < 0)
            {
              number[i] = unknowns.size();
              unknowns.push_back(i);
              unit.push_back(layout.is_length(i) ? 1. : length);
            }
    }

    /** One column for each row; those that say nothing are zero. */
    Eigen::SparseMatrix<double>
    transposed(const State &state)
    {
      K.clear();
      system.add_constraint_tangent(state.point(), K);
      Eigen::SparseMatrix<double>         Gt(unknowns.size(), rows.size());
      std::vector<Eigen::Triplet<double>> entries;
      scale = Eigen::VectorXd::Zero(rows.size());
      for (unsigned int j = 0; j < rows.size(); ++j)
        {
          const int  column = system.layout.of_multiplier(rows[j]);
          const auto begin  = entries.size();
          double     norm   = 0;
          for (int k = K.pattern->column_start[column]; k < K.pattern->column_start[column + 1]; ++k)
            if (K.pattern->rows[k] < system.layout.n_kinematic())
              {
                const int i = number[K.pattern->rows[k]];
                entries.emplace_back(i, j, K.values[k] / unit[i]);
                norm = std::hypot(norm, entries.back().value());
              }
          if (norm > 0)
            scale(j) = 1 / norm;
          for (auto e = begin; e < entries.size(); ++e)
            entries[e] = {entries[e].row(), entries[e].col(), scale(j) * entries[e].value()};
        }
      Gt.setFromTriplets(entries.begin(), entries.end());
      return Gt;
    }

    const System             &system;
    const double              length;
    SparseMatrix              K;
    std::vector<int>          number;   ///< of an unknown among those below; -1 if no row has it
    std::vector<int>          unknowns; ///< that rows have entries for
    std::vector<double>       unit;     ///< of each
    std::vector<unsigned int> rows;
    Eigen::VectorXd           scale; ///< of each row, 1/|row|; 0 if it has no entry
  };



  namespace
  {
    /** Whether constraints close a loop of nodes that are not one rigid piece. Without one there is nothing to agree.
     */
    bool
    has_loop(const System &system)
    {
      const RigidPieces         pieces(system, 1);
      const Layout             &layout  = system.layout;
      const Pattern            &pattern = *layout.pattern;
      DisjointSets              groups(layout.n_nodes);
      std::vector<unsigned int> ends;
      for (unsigned int i = 0; i < layout.n_multipliers; ++i)
        {
          const int column = layout.of_multiplier(i);
          for (int k = pattern.column_start[column]; k < pattern.column_start[column + 1]; ++k)
            if (pattern.rows[k] < layout.of_coordinate(0))
              ends.push_back(pieces.column_of_node(1 + pattern.rows[k] / 6) / 6 + 1);
          if (i + 1 < layout.n_multipliers && &layout.owner_of_multiplier(i) == &layout.owner_of_multiplier(i + 1))
            continue;
          // all rows of one joint are known; of one piece alone the other end is the ground
          std::sort(ends.begin(), ends.end());
          ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
          if (ends.size() == 1)
            ends.push_back(0);
          for (unsigned int k = 1; k < ends.size(); ++k)
            {
              if (groups.root_of(ends[0]) == groups.root_of(ends[k]))
                return true;
              groups.join(ends[k], ends[0]);
            }
          ends.clear();
        }
      return false;
    }



    /** Columns of @p Gt by their numbers, in two parts: those far from the span of others, and the rest. */
    std::pair<std::vector<int>, std::vector<int>>
    far_and_near(const Eigen::MatrixXd &Gt)
    {
      const PivotedQr  qr(Gt);
      std::vector<int> far, near;
      for (int k = 0; k < Gt.cols(); ++k)
        {
          const int j = qr.column(k);
          if (k < Gt.rows() && qr.pivot(k) > nearly)
            far.push_back(j);
          else if (!Gt.col(j).isZero(0.))
            near.push_back(j);
        }
      return {far, near};
    }



    /** The state after a small motion that the rows in @p far allow; the state itself if they allow none. */
    State
    moved(const State &state, ScaledRows &rows, const std::vector<int> &far)
    {
      const System   &system = rows.system;
      State           result = state;
      Eigen::VectorXd x(rows.unknowns.size()); // scaled velocity
      for (int i = 0; i < x.size(); ++i)
        x(i) = std::sin(1. + 1.7 * i);
      // first along the constraints, then Newton's method back to them: quadratic, a few steps are enough
      for (unsigned int iteration = 0; iteration < 6; ++iteration)
        {
          const Eigen::MatrixXd Gt = Eigen::MatrixXd(rows.transposed(result))(Eigen::all, far);
          const SymmetricSolve  of_normal(Gt.transpose() * Gt);
          if (iteration == 0)
            x -= Gt * of_normal.solve(Gt.transpose() * x);
          else
            {
              // back to where the rows hold
              std::vector<double> r(system.size() + 6, 0.);
              system.add_gaps(result.point(), r.data());
              Eigen::VectorXd g(far.size());
              for (unsigned int j = 0; j < far.size(); ++j)
                g(j) = r[system.layout.of_multiplier(rows.rows[far[j]])] * rows.scale(far[j]);
              x = -Gt * of_normal.solve(g);
            }
          std::vector<double> z(system.size(), 0.);
          for (int i = 0; i < x.size(); ++i)
            z[rows.unknowns[i]] = x(i) / rows.unit[i];
          // a structure, of which round-off is left; or back on the constraints, to round-off
          const double size = size_of_step(system, z, rows.length);
          if (iteration == 0 ? !(size > 1e-9) : size < 1e-12)
            break;
          if (iteration == 0)
            for (auto &value : z)
              value *= small_motion / size;
          system.update(result, z);
        }
      return result;
    }
  } // namespace



  std::string
  nearly_redundant_text(const System &system, const std::vector<unsigned int> &left_out)
  {
    if (system.layout.n_multipliers > few_rows + left_out.size() || !has_loop(system))
      return "";
    ScaledRows rows(system, left_out);
    State      state = system.reference();
    state.left_out.clear();
    system.add_initial_velocities(state);
    const auto [far, near] = far_and_near(rows.transposed(state));
    if (near.empty())
      return "";
    // at a singular position they are near for a moment only
    const State           there = moved(state, rows, far);
    const Eigen::MatrixXd Gt(rows.transposed(there)), span = Gt(Eigen::all, far), rest = Gt(Eigen::all, near);
    const Eigen::MatrixXd X        = SymmetricSolve(span.transpose() * span).solve(span.transpose() * rest),
                          distance = rest - span * X;
    std::vector<const Item *> joints;
    double                    largest = 0;
    unsigned int              count   = 0;
    const auto                add     = [&](const int j) {
      if (const Item &owner = system.layout.owner_of_multiplier(rows.rows[j]);
          std::find(joints.begin(), joints.end(), &owner) == joints.end())
        joints.push_back(&owner);
    };
    for (unsigned int j = 0; j < near.size(); ++j)
      {
        const double d = distance.col(j).norm();
        if (there.q == state.q || d > nearly)
          continue;
        ++count;
        largest = std::max(largest, d);
        for (unsigned int i = 0; i < far.size(); ++i)
          if (std::abs(X(i, j)) > 0.01 * X.col(j).lpNorm<Eigen::Infinity>()) // named are those that matter
            add(far[i]);
        add(near[j]);
      }
    if (count == 0)
      return "";
    return join_some(titles_of(joints)) + ": " + std::to_string(count) +
           (count == 1 ? " constraint nearly says" : " constraints nearly say") + " what the others say, to " +
           number_to_text("%.1g", largest) +
           ". Only as a structure do they all hold. If something should move there, places or axes are rounded or wrong: give all their "
           "digits, or the joints more freedom (spherical or cylindrical instead of revolute)";
  }



  namespace
  {
    /** Up to this many rows a look takes a fraction of a step; of that many singular values, the smallest, it tells. */
    constexpr unsigned int most_rows = 120, n_followed = 4;

    /** How far something moves between two looks at least and at most [rad, or parts of the model's size]. */
    constexpr double nearest_look = 0.02, farthest_look = 0.2;

    /** The next look is where the smallest singular value could have lost this part, at the rate of the last motion. */
    constexpr double part_between_looks = 0.25, least_rate = 0.25;

    /** A position is singular to round-off, or next to a singular one. */
    constexpr double is_zero = 1e-7, is_next = 0.02;

    /** Parts of the largest entry below which a row has no part in a combination. */
    constexpr double no_part_in_it = 0.02;
  } // namespace



  /** The rows in use, for one choice of those that are left out, and the smallest singular values at the last look. */
  class SingularPositions::Rows : public ScaledRows
  {
  public:
    Rows(const System &system, const std::vector<unsigned int> &left_out)
      : ScaledRows(system, left_out)
      , left_out(left_out)
      , v(Eigen::MatrixXd::Zero(rows.size(), std::min<std::size_t>(rows.size(), n_followed)))
    {
      for (int i = 0; i < v.size(); ++i)
        v.data()[i] = std::sin(1. + 1.7 * i);
    }

    /** Inverse iteration on G Gᵀ with a few vectors, which begins with those of the last look. */
    void
    find(const State &state)
    {
      constexpr double       shift = 1e-13, enough = 1e-2;
      constexpr unsigned int most_iterations = 20;

      const Eigen::SparseMatrix<double> Gt = transposed(state);
      Eigen::SparseMatrix<double>       one(rows.size(), rows.size());
      one.setIdentity();
      // what says nothing, as the rows of a joint that has let go, is no dependence
      Eigen::SparseMatrix<double> of_silent(rows.size(), rows.size());
      for (int i = 0; i < scale.size(); ++i)
        if (scale(i) == 0)
          of_silent.insert(i, i) = 1;
      const Eigen::SparseMatrix<double> A       = Eigen::SparseMatrix<double>(Gt.transpose() * Gt) + of_silent,
                                        shifted = A + shift * one;
      if (sigma.size() == 0)
        factors.analyzePattern(shifted);
      factors.factorize(shifted);
      Eigen::VectorXd squares = Eigen::VectorXd::Constant(v.cols(), -1);
      for (unsigned int iteration = 0; iteration < most_iterations; ++iteration)
        {
          v = orthonormal_columns(factors.solve(v));

          const HermitianEigen<double> ritz = symmetric_eigen(v.transpose() * (A * v));
          v                                 = v * ritz.vectors;
          const double before = squares(0);
          squares             = ritz.values;
          if (std::abs(squares(0) - before) < enough * squares(0) + shift)
            break;
        }
      u     = Gt * v;
      sigma = u.colwise().norm();
      for (int k = 0; k < sigma.size(); ++k)
        if (sigma(k) > 0)
          u.col(k) /= sigma(k);
    }

    const std::vector<unsigned int> left_out;
    Eigen::MatrixXd                 u, v;  ///< of the smallest singular values: G v = σ u
    Eigen::VectorXd                 sigma; ///< increasing; empty before the first look

  private:
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors;
  };



  SingularPositions::SingularPositions(const System &system)
    : system(system)
    , is_watched(system.layout.n_multipliers > 0 && system.layout.n_multipliers <= most_rows && has_loop(system))
  {}



  SingularPositions::~SingularPositions() = default;



  std::string
  SingularPositions::joints_of(const Eigen::VectorXd &combination) const
  {
    std::vector<const Item *> joints;
    for (int i = 0; i < combination.size(); ++i)
      if (std::abs(combination(i)) > no_part_in_it * combination.cwiseAbs().maxCoeff())
        if (const Item &owner = system.layout.owner_of_multiplier(rows->rows[i]);
            std::find(joints.begin(), joints.end(), &owner) == joints.end())
          joints.push_back(&owner);
    return join_some(titles_of(joints));
  }



  double
  SingularPositions::motion(const State &state) const
  {
    double result = 0;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      result = std::max({result,
                         (state.position(node) - last.position(node)).norm() / rows->length,
                         (state.triad(node) - last.triad(node)).norm()});
    return result;
  }



  void
  SingularPositions::look(const State &state)
  {
    if (!is_watched)
      return;
    const bool   goes_on = rows && rows->left_out == state.left_out;
    const double moved   = goes_on ? motion(state) : 0;
    if (goes_on && moved < until_next_look)
      return;
    if (!goes_on)
      rows = std::make_unique<Rows>(system, state.left_out);
    const Eigen::VectorXd sigma = rows->sigma;
    const Eigen::MatrixXd u = rows->u, v = rows->v;
    rows->find(state);
    const auto      n_passings = passings.size();
    Eigen::VectorXd together;
    for (int k = 0; k < rows->sigma.size() && goes_on; ++k)
      {
        // the one of the last look that has become this one
        constexpr double clearly = 0.7;
        int              before  = -1;
        for (int j = 0; j < sigma.size(); ++j)
          if (std::abs(rows->u.col(k).dot(u.col(j))) > clearly && std::abs(rows->v.col(k).dot(v.col(j))) > clearly)
            before = j;
        if (before < 0 || rows->u.col(k).dot(u.col(before)) * rows->v.col(k).dot(v.col(before)) > 0)
          continue;
        const double sum = sigma(before) + rows->sigma(k);
        if (!(sum > is_zero)) // a rank that is lost always is none that passes
          continue;
        const double time = last.time + (state.time - last.time) * sigma(before) / sum;
        // loops that pass together, to a hundredth of the way since the last look, are one position
        const bool is_same =
          n_passings < passings.size() && std::abs(time - passings.back().time) < 1e-2 * (state.time - last.time);
        together = is_same ? together.cwiseMax(rows->v.col(k).cwiseAbs()).eval() : rows->v.col(k).cwiseAbs().eval();
        if (is_same)
          passings.back().joints = joints_of(together);
        else
          passings.push_back({time, joints_of(together)});
      }
    last = state;

    const double smallest = rows->sigma.minCoeff();
    const double rate     = goes_on ? std::max(least_rate, std::abs(smallest - sigma.minCoeff()) / moved) : 1;
    until_next_look       = std::clamp(part_between_looks * smallest / rate, nearest_look, farthest_look);
  }



  std::string
  SingularPositions::text() const
  {
    if (passings.empty())
      return "";
    constexpr unsigned int most = 5;
    std::string            text = "  singular positions are passed " + std::to_string(passings.size()) +
                       (passings.size() == 1 ? " time" : " times") +
                       ", where the mechanism could go on in another way:";
    for (unsigned int i = 0; i < passings.size() && i < most; ++i)
      text += "\n    t = " + number_to_text("%.5g", passings[i].time) + " s: " + passings[i].joints;
    if (passings.size() > most)
      text += "\n    ... the last one at t = " + number_to_text("%.5g", passings.back().time) + " s";
    return text;
  }



  std::string
  SingularPositions::near() const
  {
    if (!rows)
      return "";
    for (int k = 0; k < rows->sigma.size(); ++k)
      if (rows->sigma(k) > is_zero && rows->sigma(k) < is_next)
        return joints_of(rows->v.col(k));
    return "";
  }
} // namespace samara
