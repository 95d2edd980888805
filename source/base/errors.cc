#include <samara/base/errors.h>

#include <algorithm>

namespace samara
{
  namespace
  {
    std::string
    joined(const std::vector<std::string> &lines)
    {
      std::string all;
      for (const auto &line : lines)
        all += (all.empty() ? "" : "\n") + line;
      return all;
    }
  } // namespace



  InputError::InputError(const std::string &complaint)
    : InputError(std::vector<std::string>{complaint})
  {}



  InputError::InputError(const std::vector<std::string> &complaints)
    : std::runtime_error(joined(complaints))
    , complaints(complaints)
  {}



  void
  Complaints::add(const std::string &where, const std::string &text)
  {
    const std::string complaint = where.empty() ? text : where + ": " + text;
    if (std::find(complaints.begin(), complaints.end(), complaint) == complaints.end())
      complaints.push_back(complaint);
  }



  bool
  Complaints::empty() const
  {
    return complaints.empty();
  }



  const std::vector<std::string> &
  Complaints::all() const
  {
    return complaints;
  }



  void
  Complaints::throw_if_any() const
  {
    if (!complaints.empty())
      throw InputError(complaints);
  }
} // namespace samara
