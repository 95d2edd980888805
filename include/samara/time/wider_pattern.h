#ifndef samara_time_wider_pattern_h
#define samara_time_wider_pattern_h

#include <samara/model/matrix.h>

#include <utility>

namespace samara
{
  /**
   * @p pattern with the 6 × 6 blocks of more nodes, (row, column), sorted, which it may have or not; @p from: of each
   * entry its number in @p pattern, or −1.
   */
  std::shared_ptr<const Pattern> wider_pattern(const Pattern                                            &pattern,
                                               const std::vector<std::pair<unsigned int, unsigned int>> &couplings,
                                               std::vector<int>                                         &from);
} // namespace samara

#endif
