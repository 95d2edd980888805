// What a wrong name was perhaps meant to be.

#include <samara/base/text.h>

#include <algorithm>
#include <cstdint>
#include <map>

namespace samara
{
  namespace
  {
    std::string
    lower_case(std::string text)
    {
      for (char &c : text)
        if (c >= 'A' && c <= 'Z')
          c = static_cast<char>(c - 'A' + 'a');
      return text;
    }



    /** A name, and what other programs call it. */
    const std::vector<std::pair<std::string, std::string>> rows_of_synonyms = {
      {"rigid", "weld, welded, fixed, fix, clamp, clamped, lock, bracket"},
      {"revolute", "pin, hinge, pivot, rotary, bearing, rotational"},
      {"spherical", "ball, socket, ball joint, ball and socket"},
      {"prismatic", "slider, slide, translational, translation, linear"},
      {"universal", "cardan, hooke, u joint, gimbal"},
      {"screw", "helical"},
      {"planar", "plane"},
      {"distance", "rod, link, massless rod"},
      {"flexible joint", "bushing, bush, elastic joint"},
      {"spring", "damper, spring damper"},
      {"rolling ball", "rolling, wheel"},
      {"knife edge", "skate"},
      {"gear", "gears"},
      {"beam", "rod, bar, cable, shaft, blade, flexible body, elastic body"},
      {"rigid body", "mass, point mass, lumped mass, body, rigid"},
      {"tube", "pipe, circle, circular, round"},
      {"rectangle", "box"},
      {"matrices", "matrix, stiffness, stiffness matrix"},
      {"gravity", "weight"},
      {"point load", "force, moment, torque"},
      {"line load", "distributed load, pressure"},
      {"steady rotation", "rotation, spin"},
      {"static", "equilibrium, statics"},
      {"dynamic", "transient, dynamics, time, simulation"},
      {"modal", "eigenvalues, frequencies, modes, vibration"},
      {"E", "young's modulus, youngs modulus, elastic modulus, modulus"},
      {"Density", "rho"},
      {"Poisson ratio", "nu, poisson's ratio"},
      {"Width 2", "width"},
      {"Width 3", "height"},
      {"Outer radius", "radius"},
      {"Position", "origin, location"},
      {"Section", "material, cross section"},
      {"Spring", "stiffness"},
      {"Damper", "damping"},
      {"Body A", "parent, body 1"},
      {"Body B", "child, body 2"},
      {"Elements", "number of elements"},
      {"Points", "nodes"},
      {"Degree", "order"},
      {"Step", "time step, step size, dt"},
      {"End time", "duration, final time, tend"},
      {"Speed", "omega, rpm, angular speed"},
      {"Azimuth", "angle"},
      {"At", "body, point"},
      {"Bodies", "links, parts, elements"},
      {"Sections", "materials"},
      {"Joints", "connections, constraints"},
      {"Loads", "forces"},
      {"Constants", "parameters, variables"},
      {"Output", "sensors, results"}};

    /** The names that a word of another program may stand for, in the order above. */
    const std::multimap<std::string, std::string> &
    synonyms()
    {
      static const auto all = []() {
        std::multimap<std::string, std::string> result;
        for (const auto &[name, words] : rows_of_synonyms)
          for (const auto &word : split_top_level(words, ','))
            result.emplace(word, name);
        return result;
      }();
      return all;
    }



    constexpr std::size_t   longest_word = 200; ///< with more letters it is no mistyped word
    constexpr std::uint64_t most_comparisons =
      100'000'000; ///< of letters, in all: ten thousand mistakes need no advice

    std::uint64_t n_comparisons = 0; ///< so far

    /** The candidate with the fewest letters to change; "" if too many would have to be. */
    std::string
    nearest_of(const std::string &wrong, const std::vector<std::string> &candidates)
    {
      // Beyond this distance a suggestion is a riddle; and a word of which no letter is kept is no suggestion at all.
      const auto  size     = wrong.size();
      const auto  accepted = size == 0 ? 0 : std::min(1 + size / 3, size - 1);
      std::string nearest;
      std::size_t smallest = accepted + 1;
      n_comparisons += candidates.size();
      for (const auto &candidate : candidates)
        {
          const auto more = std::max(size, candidate.size()), less = std::min(size, candidate.size());
          if (more - less >= smallest || more > longest_word || !may_suggest())
            continue;
          n_comparisons += size * candidate.size();
          const auto distance = edit_distance(lower_case(wrong), lower_case(candidate));
          if (distance < smallest)
            {
              smallest = distance;
              nearest  = candidate;
            }
        }
      return nearest;
    }

    std::string
    synonym_of(const std::string &wrong, const std::vector<std::string> &candidates)
    {
      std::string word = wrong.size() > longest_word ? "" : lower_case(wrong);
      std::replace(word.begin(), word.end(), '_', ' ');
      std::replace(word.begin(), word.end(), '-', ' ');
      if (const auto joint = word.find(" joint"); joint != std::string::npos && synonyms().count(word) == 0)
        word.erase(joint);
      const auto [begin, end] = synonyms().equal_range(word);
      for (auto meant = begin; meant != end; ++meant)
        if (std::find(candidates.begin(), candidates.end(), meant->second) != candidates.end())
          return meant->second;
      return "";
    }
  } // namespace



  bool
  may_suggest()
  {
    return n_comparisons < most_comparisons;
  }



  std::string
  did_you_mean(const std::string &wrong, const std::vector<std::string> &candidates)
  {
    std::string meant = synonym_of(wrong, candidates);
    if (meant.empty())
      meant = nearest_of(wrong, candidates);
    if (!meant.empty())
      return "; did you mean <" + meant + ">?";
    if (!candidates.empty() && candidates.size() <= 12)
      return "; known: " + join(candidates, ", ") + ".";
    return ".";
  }
} // namespace samara
