#ifndef samara_tests_catalogue_catalogued_h
#define samara_tests_catalogue_catalogued_h

#include <gtest/gtest.h>

#include <set>

#include "analysis_models.h"
#include "models.h"
#include "outcome.h"

namespace samara
{
  /** An entry, "rotation / Spring", another value for it, and what else is different in both runs. */
  struct Change
  {
    std::string              entry, value;
    std::vector<std::string> with       = {};
    bool                     is_refusal = false; ///< the other value is one that forbids something
    std::vector<std::string> also       = {};    ///< what must be different with the other value
  };
  using Changes = std::vector<Change>;

  /** Entries by kind, from the documentation that users read. */
  inline std::map<std::string, std::set<std::string>>
  documented_entries()
  {
    std::ostringstream text;
    print_reference(text, "everything");
    std::istringstream                           lines(text.str());
    std::map<std::string, std::set<std::string>> entries;
    std::string                                  kind;
    bool                                         in_table = false;
    for (std::string line; std::getline(lines, line);)
      {
        if (line.rfind("### ", 0) == 0)
          kind = line.substr(4);
        else if (line == "## The model")
          kind = "model";
        else if (line == "## Subsystems")
          kind = "subsystem";
        else if (line == "## Studies")
          kind = "study";
        else if (line.find("`subsection Methods`") != std::string::npos)
          kind = "method";
        in_table = line.rfind("| entry |", 0) == 0 || (in_table && line.rfind("|", 0) == 0);
        const bool is_part = kind.find('/') != std::string::npos; // tests/contrib/test_parts
        if (in_table && !is_part && line.rfind("| entry |", 0) != 0 && line.rfind("|-", 0) != 0)
          entries[kind].insert(line.substr(2, line.find(" |", 2) - 2));
      }
    return entries;
  }



  /** What the entries of a free motion are worth trying with; the lengths of springs are 2 m. @p rubs: with friction.
   */
  inline Changes
  changes_of_motion(const std::string &motion, const std::string &object, const bool rubs)
  {
    const bool        is_angle = motion.substr(0, 8) == "rotation", is_length = motion == "length";
    const std::string path = object + "/" + motion + "/", spring = path + "Spring = 7",
                      stiff = path + "Stop stiffness = 50", own = object.substr(object.find('/') + 1) + "." + motion,
                      upper                 = path + "Upper stop = " + (is_length ? "0.1" : "-0.1"),
                      lower                 = path + "Lower stop = " + (is_length ? "9" : "0.05");
    Changes                        changes  = {{"Spring", "5", {spring, path + "Rest = 0.3"}},
                                               {"Rest", "0.4", {spring}},
                                               {is_angle ? "Spring moment" : "Spring force", "2 + 5*" + own},
                                               {"Damper", "0.5"},
                                               {"Lower stop", is_length ? "10" : "0.1", {lower, stiff}},
                                               {"Upper stop", is_length ? "0.2" : "-0.2", {upper, stiff}},
                                               {"Stop stiffness", "80", {upper, stiff}},
                                               {"Stop damping", "3", {upper, stiff}},
                                               {is_angle ? "Moment" : "Force", "2"},
                                               {"Prescribed", is_length ? "2 + 0.3*t" : "0.3*t"}};
    const std::vector<std::string> bounces  = {upper, stiff, path + "Stop restitution = 0.5", path + "Stop speed = 1"},
                                   by_force = {upper, path + "Stop force = 50*s"};
    changes.push_back({"Stop exponent", "1.5", {upper, stiff}});
    changes.push_back({"Stop restitution", "0.8", bounces});
    changes.push_back({"Stop speed", "2", bounces});
    changes.push_back({"Stop force", "80*s", by_force});
    if (rubs)
      {
        std::vector<std::string> slips = {path + "Friction = 0.3", path + "Friction preload = 100"};
        if (is_angle)
          slips.push_back(path + "Friction radius = 0.1");
        std::vector<std::string> sticks = slips;
        sticks.insert(sticks.end(), {path + "Static friction = 0.5", path + "Stribeck speed = 0.5"});
        changes.push_back({"Friction", "0.4", slips});
        changes.push_back({"Friction preload", "50", slips});
        if (is_angle)
          changes.push_back({"Friction radius", "0.2", slips});
        changes.push_back({"Static friction", "0.6", sticks});
        changes.push_back({"Stribeck speed", "0.8", sticks});
        changes.push_back({"Sticking speed", "0.01", slips});
        changes.push_back({"Bristle stiffness", "300", slips});
        slips.push_back(path + "Bristle stiffness = 200");
        changes.push_back({"Bristle damping", "20", slips});
      }
    for (auto &change : changes)
      change.entry = motion + " / " + change.entry;
    return changes;
  }

  /** What the entries of a contact of bodies are worth trying with; it has a stiffness, and is touched. */
  inline Changes
  changes_of_contact(const std::string &object)
  {
    const std::string              path    = object + "/";
    const std::vector<std::string> bounces = {path + "Restitution = 0.5", path + "Impact speed = 1"},
                                   slips   = {path + "Friction = 0.3"};
    std::vector<std::string> sticks = slips, bends = slips;
    sticks.insert(sticks.end(), {path + "Static friction = 0.5", path + "Stribeck speed = 0.5"});
    bends.push_back(path + "Bristle stiffness = 200");
    return {{"Body A", "ground"},
            {"Body B", "b.other"},
            {"Axis 1", "0.3, 1, 0.2", slips},
            {"Stiffness", "200"},
            {"Damping", "3"},
            {"Exponent", "1.5"},
            {"Restitution", "0.8", bounces},
            {"Impact speed", "2", bounces},
            {"Force", "100*s", {}, true},
            {"Friction", "0.4", slips},
            {"Static friction", "0.6", sticks},
            {"Stribeck speed", "0.8", sticks},
            {"Sticking speed", "0.01", slips},
            {"Bristle stiffness", "300", slips},
            {"Bristle damping", "20", bends},
            {"Rolling friction", "0.2"},
            {"Turning friction", "0.2"}};
  }

  inline Changes
  joined(Changes a, const std::vector<Changes> &others)
  {
    for (const auto &b : others)
      a.insert(a.end(), b.begin(), b.end());
    return a;
  }



  /** Runs models with one entry after the other set to something else. */
  class Catalogued : public testing::Test
  {
  protected:
    /** Whether each change of an object's entries, but for those with a @p reason, makes a difference in @p model. */
    void
    check(const std::string                        &kind,
          const std::string                        &model,
          const std::string                        &object,
          const Changes                            &changes,
          const std::map<std::string, std::string> &reasons = {})
    {
      std::set<std::string> listed;
      for (const auto &reason : reasons)
        listed.insert(reason.first);
      for (const auto &change : changes)
        {
          listed.insert(change.entry);
          std::string path = (object.empty() ? "" : object + "/") + change.entry;
          path             = std::regex_replace(path, std::regex(" / "), "/");
          auto overrides   = change.with;
          overrides.push_back(path + " = " + change.value);
          overrides.insert(overrides.end(), change.also.begin(), change.also.end());
          const Outcome &before = outcome(model, change.with),
                        after(with_subsections(model, overrides), overrides, files);
          EXPECT_FALSE(before.refused) << kind << ", " << change.entry << ": " << before.text.substr(0, 500);
          EXPECT_EQ(after.refused, change.is_refusal)
            << kind << ", " << change.entry << ": " << after.text.substr(0, 500);
          EXPECT_NE(before.text, after.text)
            << kind << ": <" << change.entry << " = " << change.value << "> changes nothing";
        }
      EXPECT_EQ(listed, documented_entries()[kind])
        << kind << ": list every entry, with a value that makes a difference";
    }

    /** The same for a kind of joint, with @p motions that it leaves free. */
    void
    check_joint(const std::string              &kind,
                const std::string              &entries,
                const std::string              &probes,
                const Changes                  &changes,
                const std::vector<std::string> &motions = {})
    {
      std::vector<Changes> of_motions;
      for (const auto &motion : motions)
        of_motions.push_back(
          changes_of_motion(motion, "Joints/it", kind != "screw" && motion.find("displacement ") != 0));
      check(kind, models::joint(kind, entries, probes), "Joints/it", joined(changes, of_motions));
    }

    std::map<std::string, std::string> files; ///< that models name

  private:
    std::map<std::string, Outcome> outcomes;

    /** Overrides find only subsections that are there: empty ones for the motions that they name. */
    static std::string
    with_subsections(std::string model, const std::vector<std::string> &overrides)
    {
      const std::regex      motion("Joints/it/([^/=]+)/.*");
      std::set<std::string> names;
      for (const auto &override : overrides)
        {
          std::smatch match;
          if (std::regex_match(override, match, motion))
            names.insert(match[1]);
        }
      const auto place = model.find('\n', model.find("  subsection it\n")) + 1;
      for (const auto &name : names)
        if (model.find("subsection " + name + "\n") == std::string::npos)
          model.insert(place, "    subsection " + name + "\n    end\n");
      return model;
    }

    const Outcome &
    outcome(const std::string &model, const std::vector<std::string> &overrides)
    {
      std::string key = model;
      for (const auto &override : overrides)
        key += override + "\n";
      const auto found = outcomes.find(key);
      if (found != outcomes.end())
        return found->second;
      return outcomes.emplace(key, Outcome(with_subsections(model, overrides), overrides, files)).first->second;
    }
  };
} // namespace samara

#endif
