#ifndef samara_model_remarks_h
#define samara_model_remarks_h

#include <string>
#include <vector>

namespace samara
{
  /** What is to be known of how an item was made, before anything is computed with it. */
  struct Remark
  {
    enum Level
    {
      of_check, ///< told by --check
      line,     ///< and at the start of each run
      warning
    };
    Level       level;
    std::string text; ///< whole sentences, the item's name in them
  };



  /** An item that has remarks. */
  class HasRemarks
  {
  public:
    virtual ~HasRemarks() = default;

    virtual std::vector<Remark> remarks() const = 0;
  };
} // namespace samara

#endif
