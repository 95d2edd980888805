#ifndef samara_model_algebraic_states_h
#define samara_model_algebraic_states_h

#include <samara/model/model.h>

#include <vector>

namespace samara
{
  /**
   * An item that says which of its states of first order have no rates: 0 = g(q, y, z, t) in place of ż = g. They
   * follow at once, at every stage of a step; what they were before does not matter.
   */
  class HasAlgebraicStates
  {
  public:
    virtual ~HasAlgebraicStates() = default;

    /** Their numbers; known when the item is initialized. */
    virtual std::vector<unsigned int> algebraic_states() const = 0;
  };



  /** Numbers of those of all items. */
  inline std::vector<unsigned int>
  algebraic_states(const Model &model)
  {
    std::vector<unsigned int> result;
    if (!model.states.empty())
      for (const auto &item : model.items)
        if (const auto *const with = dynamic_cast<const HasAlgebraicStates *>(item.get()))
          for (const unsigned int i : with->algebraic_states())
            result.push_back(i);
    return result;
  }
} // namespace samara

#endif
