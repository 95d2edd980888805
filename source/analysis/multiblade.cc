#include <samara/analysis/multiblade.h>
#include <samara/time/increment.h>

#include <cmath>

namespace samara
{
  Multiblade::Multiblade(const System &system, const RepeatedParts &parts)
    : system(system)
    , parts(parts)
  {
    const Layout      &layout = system.layout;
    const unsigned int n      = size_of_increment(layout);
    if (parts.n() == 1)
      return;
    shifts.push_back(Eigen::MatrixXd::Identity(n, n));
    for (unsigned int k = 1; k < parts.n(); ++k)
      {
        Eigen::MatrixXd shift = shifts.back();
        for (unsigned int j = 0; j < n; ++j)
          parts.apply_inverse(shift.col(j).data());
        shifts.push_back(shift);
      }
    const unsigned int        velocities = layout.of_multiplier(0);
    std::vector<unsigned int> next, entry;
    for (unsigned int i = 0; i < layout.n_nodes; ++i)
      {
        next.push_back(parts.next_of_node(i));
        entry.push_back(i == 0 ? 0 : layout.of_node(i));
      }
    add_chains(next, entry, 6);
    for (auto &e : entry)
      e += velocities;
    add_chains(next, entry, 6);
    next.clear();
    entry.clear();
    for (unsigned int i = 0; i < layout.n_coordinates; ++i)
      {
        next.push_back(parts.next_of_coordinate(i));
        entry.push_back(layout.of_coordinate(i));
      }
    add_chains(next, entry, 1);
    for (auto &e : entry)
      e += velocities;
    add_chains(next, entry, 1);
    next.clear();
    entry.clear();
    for (unsigned int i = 0; i < layout.n_states; ++i)
      {
        next.push_back(parts.next_of_state(i));
        entry.push_back(layout.of_state(i));
      }
    add_chains(next, entry, 1);
  }



  void
  Multiblade::add_chains(const std::vector<unsigned int> &next,
                         const std::vector<unsigned int> &first_entry,
                         const unsigned int               n)
  {
    std::vector<bool> is_done(next.size(), false);
    for (unsigned int i = 0; i < next.size(); ++i)
      {
        if (is_done[i] || next[i] == i)
          continue;
        std::vector<unsigned int> members;
        for (unsigned int k = i; !is_done[k]; k = next[k])
          {
            is_done[k] = true;
            members.push_back(k);
          }
        for (unsigned int c = 0; c < n; ++c)
          {
            chains.emplace_back();
            for (const unsigned int k : members)
              chains.back().push_back(first_entry[k] + c);
          }
      }
  }



  // Coleman's transformation, with factors that make it orthonormal: u_0 = Σ u_k/√Q, u_nc = √(2/Q) Σ u_k cos n ψ_k,
  // ...; all parts are seen in axes of the first, by shifts[k]
  Eigen::MatrixXd
  Multiblade::at(const State &state, const double phase) const
  {
    const Layout      &layout = system.layout;
    const unsigned int n = size_of_increment(layout), Q = parts.n(), velocities = layout.of_multiplier(0);
    Eigen::MatrixXd    M = Eigen::MatrixXd::Identity(n, n);
    if (Q == 1)
      return M;
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      if (parts.only_turns(node))
        for (const unsigned int first : {0u, 3u, velocities, velocities + 3})
          M.block<3, 3>(first + layout.of_node(node), first + layout.of_node(node)) = state.triad(node);
    for (const auto &chain : chains)
      for (unsigned int m = 0; m < Q; ++m)
        {
          auto row = M.row(chain[m]);
          row.setZero();
          // mean; cosines and sines of 1, 2, ...; the differential one of an even number last
          const unsigned int harmonic = (m + 1) / 2;
          for (unsigned int k = 0; k < Q; ++k)
            {
              const double angle  = harmonic * (phase + 2 * M_PI * k / Q);
              const double factor = m == 0            ? std::sqrt(1. / Q) :
                                    2 * harmonic == Q ? (k % 2 == 0 ? 1 : -1) * std::sqrt(1. / Q) :
                                    m % 2 == 1        ? std::sqrt(2. / Q) * std::cos(angle) :
                                                        std::sqrt(2. / Q) * std::sin(angle);
              row += factor * shifts[k].row(chain[0]);
            }
        }
    return M;
  }
} // namespace samara
