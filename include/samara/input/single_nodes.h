#ifndef samara_input_single_nodes_h
#define samara_input_single_nodes_h

#include <samara/model/model.h>

namespace samara
{
  /**
   * Warnings of moments that go into a single node of a shell: of joints that hold or drive a rotation there, and of
   * moments at a point. A shell that is flexible in shear turns under them as much as the mesh is fine: the rotation
   * has no limit, and what is computed depends on the size of an element. Forces at a node are left to who reads the
   * manual: their deflection grows with the logarithm of the number of elements.
   */
  std::vector<std::string> moments_at_single_nodes(const Model &model);
} // namespace samara

#endif
