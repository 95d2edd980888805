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

    /** Why a stability limit at a state is likely to be one of the item's mesh alone; empty if it is not. */
    virtual std::string
    why_no_limit(const State &) const
    {
      return {};
    }

    /** An energy that the item's mesh leaves out at a state, of what is elastic there [J]. */
    struct Energies
    {
      double left_out = 0, elastic = 0;
    };
    virtual Energies
    energies(const State &) const
    {
      return {};
    }

    /** What the largest of the energies in a run, one over the other, say; empty if that is little. */
    virtual std::string
    doubt_of_run(const Energies & /*largest*/) const
    {
      return {};
    }
  };
} // namespace samara

#endif
