#ifndef samara_solvers_part_without_h
#define samara_solvers_part_without_h

#include <samara/model/system.h>

namespace samara
{
  /**
   * Those entries of a pattern of the system's size that couple anything while multipliers are left out: of their rows
   * and columns only the diagonal. Factors of it cost what they would if the model did not have these rows.
   */
  template <typename Keep>
  PartOfPattern
  part_without(const Layout &layout, const Pattern &all, const std::vector<unsigned int> &left_out, const Keep &keep)
  {
    std::vector<bool> is_out(all.size(), false);
    for (const auto i : left_out)
      is_out[layout.of_multiplier(i)] = true;
    return PartOfPattern(all,
                         [&](const int i, const int j) { return i == j || (!is_out[i] && !is_out[j] && keep(i, j)); });
  }
} // namespace samara

#endif
