#ifndef samara_input_single_nodes_h
#define samara_input_single_nodes_h

#include <samara/model/model.h>

namespace samara
{
  /**
   * Warnings of what goes into a single node of a shell, of joints and of loads at a point. A shell that is flexible in
   * shear turns under a moment there as much as the mesh is fine: the rotation has no limit, and what is computed
   * depends on the size of an element. Under a force its deflection grows with the logarithm of the number of elements.
   */
  std::vector<std::string> loads_at_single_nodes(const Model &model);
} // namespace samara

#endif
