// Redundant rows for people: which joints they belong to, and which prescribed motions contradict each other.

#include <samara/solvers/redundant_rows.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace samara
{
  std::vector<int>
  RedundantRows::contradictions(const State &state)
  {
    const Eigen::MatrixXd X         = combinations(state);
    const auto            values_at = [&](const double time) {
      State at = state;
      at.time  = time;
      std::vector<double> r(n + m + 6, 0.);
      system.add_gaps(at.point(), r.data());
      return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(r.data() + n, m));
    };
    // as long as prescribed motions are small, below a hundredth, X is that of the start: shorter and shorter times
    const Eigen::VectorXd start  = values_at(state.time);
    Eigen::VectorXd       change = start;
    double                dt     = 1;
    do
      {
        change = values_at(state.time + dt) - start;
        dt /= 10;
      }
    while (change.cwiseAbs().maxCoeff() > 1e-2 && dt > 1e-12);
    std::vector<int> result;
    for (int j = 0; j < X.cols(); ++j)
      {
        // entries that are round-off are none; terms that cancel but for a tenth of their sizes agree, as those of X
        // that has turned a little since the start
        const double terms = change.cwiseProduct(X.col(j)).cwiseAbs().sum(),
                     noise = 1e-6 * X.col(j).lpNorm<Eigen::Infinity>() * change.lpNorm<Eigen::Infinity>();
        if (terms > noise && std::abs(change.dot(X.col(j))) > 0.1 * terms)
          result.push_back(j);
      }
    return result;
  }



  std::string
  RedundantRows::names(const Eigen::MatrixXd &X, const int j) const
  {
    const double                                     largest = X.col(j).cwiseAbs().maxCoeff();
    std::vector<std::pair<const Item *, std::string>> parts;
    for (int i = 0; i < m; ++i)
      if (std::abs(X(i, j)) > 1e-6 * largest)
        {
          const auto &[owner, row] = system.layout.rows_of_multipliers[i];
          if (parts.empty() || parts.back().first != owner)
            parts.emplace_back(owner, row);
          else
            parts.back().second += ", " + row;
        }
    std::string text;
    for (const auto &[owner, row] : parts)
      text += (text.empty() ? "" : "; ") + owner->title() + (row.empty() ? "" : " (" + row + ")");
    return text;
  }



  std::vector<RedundantRows::Loop>
  RedundantRows::loops(const Eigen::MatrixXd &X) const
  {
    std::vector<Loop> result;
    for (int j = 0; j < X.cols(); ++j)
      {
        Loop         loop{{}, 1};
        const double largest = X.col(j).cwiseAbs().maxCoeff();
        for (int i = 0; i < m; ++i)
          if (std::abs(X(i, j)) > 1e-6 * largest)
            if (const Item &owner = system.layout.owner_of_multiplier(i);
                loop.joints.empty() || loop.joints.back() != &owner)
              loop.joints.push_back(&owner);
        // joined with those before that share a joint
        for (auto other = result.begin(); other != result.end();)
          if (std::any_of(other->joints.begin(), other->joints.end(), [&](const Item *const joint) {
                return std::find(loop.joints.begin(), loop.joints.end(), joint) != loop.joints.end();
              }))
            {
              for (const auto *const joint : loop.joints)
                if (std::find(other->joints.begin(), other->joints.end(), joint) == other->joints.end())
                  other->joints.push_back(joint);
              loop.joints = other->joints;
              loop.n_redundant += other->n_redundant;
              other = result.erase(other);
            }
          else
            ++other;
        result.push_back(loop);
      }
    return result;
  }
} // namespace samara
