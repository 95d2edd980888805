#ifndef samara_model_virtual_mass_h
#define samara_model_virtual_mass_h

#include <samara/model/model.h>

namespace samara
{
  /**
   * An item that adds to the inertia of nodes what is not theirs: the mass of air or water that is moved along. It has
   * momentum and energy, but no weight, and is no part of the mass of the model.
   */
  class VirtualMass
  {
  public:
    virtual ~VirtualMass() = default;

    /** Add what it has added to the nodes' inertia, in the frames of the nodes that are left: a matrix for each node.
     */
    virtual void add_virtual_mass(std::vector<Matrix6> &of_nodes) const = 0;
  };



  /** Of all items that are connected: for each node what has no weight; empty if there is none. */
  inline std::vector<Matrix6>
  virtual_mass(const Model &model)
  {
    std::vector<Matrix6> of_nodes;
    for (const auto &item : model.items)
      if (const auto *const air = dynamic_cast<const VirtualMass *>(item.get()))
        {
          of_nodes.resize(model.nodes.size(), Matrix6::Zero());
          air->add_virtual_mass(of_nodes);
        }
    return of_nodes;
  }
} // namespace samara

#endif
