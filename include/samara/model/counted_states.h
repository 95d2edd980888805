#ifndef samara_model_counted_states_h
#define samara_model_counted_states_h

#include <samara/model/model.h>

#include <vector>

namespace samara
{
  /**
   * States of first order whose error adaptive steps control together: √(Σ P δz²) in parts of the largest √(Σ P z²)
   * there was, times the weight. P makes an energy of them where they have one; only its ratios matter.
   */
  struct CountedStates
  {
    std::vector<unsigned int> states;     ///< their numbers
    std::vector<double>       metric;     ///< P, one a state
    double                    weight = 1; ///< zero: they are known not to count, as controls
  };



  /** An item that says which of its states of first order count for the length of steps. Others do not. */
  class HasCountedStates
  {
  public:
    virtual ~HasCountedStates() = default;

    /** Known when the item is initialized. */
    virtual std::vector<CountedStates> counted_states() const = 0;
  };



  /** Those of all items. */
  inline std::vector<CountedStates>
  counted_states(const Model &model)
  {
    std::vector<CountedStates> result;
    for (const auto &item : model.items)
      if (const auto *const counted = dynamic_cast<const HasCountedStates *>(item.get()))
        for (auto &group : counted->counted_states())
          result.push_back(std::move(group));
    return result;
  }
} // namespace samara

#endif
