#ifndef samara_analysis_near_redundancy_h
#define samara_analysis_near_redundancy_h

#include <samara/model/system.h>

namespace samara
{
  /**
   * What to tell of a loop that could move, but for constraints that nearly say what others say
   * (doc/theory/redundant.md): places or axes that are rounded, or a fault of assembly, make a structure of a
   * mechanism. Empty if there is none, or if the model has more than some 300 constraints. @p left_out are the rows
   * that are redundant.
   */
  std::string nearly_redundant_text(const System &system, const std::vector<unsigned int> &left_out);
} // namespace samara

#endif
