#include <samara/base/errors.h>
#include <samara/base/text.h>

#include <algorithm>
#include <map>
#include <tuple>

namespace samara
{
  namespace
  {
    constexpr std::size_t most_shown = 1000, most_kept = 100'000; ///< complaints; nobody reads more

    /** The file and the line of "file:line: what is wrong"; the line is 0 if there is none. */
    std::pair<std::string, unsigned long>
    place_of(const std::string &complaint)
    {
      for (auto colon = complaint.find(':'); colon != std::string::npos; colon = complaint.find(':', colon + 1))
        {
          const auto digits = std::min(complaint.find_first_not_of("0123456789", colon + 1), complaint.size());
          if (digits > colon + 1 && digits < colon + 10 && complaint.compare(digits, 2, ": ") == 0)
            return {complaint.substr(0, colon), std::stoul(complaint.substr(colon + 1, digits - colon - 1))};
        }
      return {"", 0};
    }

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



  std::vector<std::string>
  with_place(const std::vector<std::string> &complaints, const std::string &where)
  {
    auto result = complaints;
    for (auto &complaint : result)
      if (place_of(complaint).second == 0)
        complaint = where + ": " + complaint;
    return result;
  }



  void
  Complaints::add(const std::string &where, const std::string &text)
  {
    if (text.empty())
      ++n_follow_ups;
    else
      add_all({where.empty() ? readable(text) : where + ": " + readable(text)});
  }



  void
  Complaints::add_all(const std::vector<std::string> &others)
  {
    for (const auto &complaint : others)
      if (complaints.size() >= most_kept)
        ++n_follow_ups; // too many to be kept
      else if (known.insert(complaint).second)
        complaints.push_back(complaint);
      else
        ++n_follow_ups; // known, but another object may have it, too
  }



  void
  Complaints::doubt(const std::string &where, const std::string &text)
  {
    const std::string all = where.empty() ? readable(text) : where + ": " + readable(text);
    if (std::find(doubtful.begin(), doubtful.end(), all) == doubtful.end())
      doubtful.push_back(all);
  }



  bool
  Complaints::empty() const
  {
    return complaints.empty();
  }



  std::size_t
  Complaints::count() const
  {
    return complaints.size() + n_follow_ups;
  }



  std::vector<std::string>
  Complaints::all() const
  {
    using Key =
      std::tuple<std::size_t, unsigned long, std::size_t>; // number of the file, line, number of the complaint
    std::map<std::string, std::size_t> files;
    std::vector<Key>                   order;
    for (std::size_t i = 0; i < complaints.size(); ++i)
      {
        const auto [file, line] = place_of(complaints[i]);
        order.emplace_back(files.emplace(file, files.size()).first->second, line, i);
      }
    std::sort(order.begin(), order.end());
    std::vector<std::string> result;
    for (const auto &key : order)
      result.push_back(complaints[std::get<2>(key)]);
    return result;
  }



  void
  Complaints::note_inclusion(const std::string &file, const std::string &place)
  {
    auto &places = inclusions[file];
    if (std::find(places.begin(), places.end(), place) == places.end())
      places.push_back(place);
  }



  void
  Complaints::note_inclusions_of(const Complaints &other)
  {
    for (const auto &[file, places] : other.inclusions)
      for (const auto &place : places)
        note_inclusion(file, place);
  }



  std::string
  Complaints::chain_of(const std::string &file, const unsigned int depth) const
  {
    constexpr std::size_t most_places = 3, deepest = 50;
    const auto            found = inclusions.find(file);
    if (found == inclusions.end() || depth > deepest)
      return "";
    const auto &places = found->second;
    std::string text;
    for (std::size_t i = 0; i < std::min(places.size(), most_places); ++i)
      text += (i == 0 ? "" : ", and at ") + places[i];
    if (places.size() > most_places)
      text += " and " + std::to_string(places.size() - most_places) + " more places";
    const std::string around = chain_of(place_of(places[0] + ": ").first, depth + 1);
    return " (included at " + text + around + ")";
  }



  void
  Complaints::throw_if_any() const
  {
    if (complaints.empty())
      return;
    auto shown = all();
    for (auto &complaint : shown)
      complaint += chain_of(place_of(complaint).first);
    if (shown.size() > most_shown)
      {
        shown.resize(most_shown);
        shown.push_back("... and " + std::string(complaints.size() < most_kept ? "" : "more than ") +
                        std::to_string(complaints.size() - most_shown) + " more mistakes.");
      }
    throw InputError(shown);
  }
} // namespace samara
