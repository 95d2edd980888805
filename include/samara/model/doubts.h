#ifndef samara_model_doubts_h
#define samara_model_doubts_h

#include <samara/model/state.h>

#include <string>
#include <vector>

namespace samara
{
  /** A reason why results at a state may be wrong. Of the same object and the same matter one is told once a run. */
  struct Doubt
  {
    std::string about; ///< in a word, for who counts
    std::string text;  ///< whole sentences: what is the case, why it matters, what to do
  };



  /** An item whose theory does not hold in every state. */
  class Doubtful
  {
  public:
    virtual ~Doubtful() = default;

    /** Asked when a state is recorded, not within steps. */
    virtual std::vector<Doubt> doubts(const State &state) const = 0;
  };
} // namespace samara

#endif
