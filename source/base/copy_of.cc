#include <samara/base/outline.h>
#include <samara/base/text.h>

#include <algorithm>
#include <set>
#include <unordered_map>
#include <unordered_set>

/** @file `set Copy of = sibling` */
namespace samara
{
  namespace
  {
    void
    forget_inherited(Outline &section)
    {
      const auto is_inherited = [](const auto &thing) { return thing.inherited; };
      auto      &entries      = section.entries;
      auto      &sections     = section.sections;
      entries.erase(std::remove_if(entries.begin(), entries.end(), is_inherited), entries.end());
      sections.erase(std::remove_if(sections.begin(), sections.end(), is_inherited), sections.end());
      for (auto &s : sections)
        forget_inherited(s);
    }

    constexpr std::size_t most_inherited = 1'000'000; ///< entries and subsections: copies of copies can fill any memory

    /** Give @p copy all that @p original has and it has not; nothing more once @p n_inherited is too large. */
    void
    inherit(Outline &copy, const Outline &original, std::size_t &n_inherited)
    {
      n_inherited += original.entries.size() + original.sections.size();
      if (n_inherited > most_inherited)
        return;
      std::unordered_set<std::string> own;
      for (const auto &entry : copy.entries)
        own.insert(entry.name);
      for (auto entry : original.entries)
        if (own.count(entry.name) == 0)
          {
            entry.inherited = true;
            copy.entries.push_back(entry);
          }
      std::unordered_map<std::string, std::size_t> numbers;
      for (std::size_t i = 0; i < copy.sections.size(); ++i)
        numbers.emplace(copy.sections[i].name, i);
      for (const auto &theirs : original.sections)
        {
          const auto ours = numbers.emplace(theirs.name, copy.sections.size());
          if (ours.second)
            {
              copy.sections.emplace_back();
              copy.sections.back().name      = theirs.name;
              copy.sections.back().where     = theirs.where;
              copy.sections.back().inherited = true;
            }
          inherit(copy.sections[ours.first->second], theirs, n_inherited);
        }
    }

    /** The subsections of one section, copying from each other. */
    class Siblings
    {
    public:
      Siblings(std::vector<Outline> &sections, std::size_t &n_inherited, Complaints &complaints)
        : sections(sections)
        , n_inherited(n_inherited)
        , complaints(complaints)
      {}

      void
      resolve()
      {
        for (std::size_t i = 0; i < sections.size(); ++i)
          numbers.emplace(sections[i].name, i);
        for (auto &s : sections)
          resolve(s);
      }

    private:
      /** The original, if it is there. */
      Outline *
      original_of(const Outline::Entry &asked)
      {
        const auto found = numbers.find(asked.value);
        return found == numbers.end() ? nullptr : &sections[found->second];
      }

      /** From copy to original as far as it goes, which may be further than a recursion could, and back. */
      void
      resolve(Outline &section)
      {
        std::vector<Outline *> chain;
        for (Outline *next = &section; next != nullptr && done.count(next) == 0;)
          {
            const Outline::Entry *const asked = next->entry("Copy of");
            if (asked == nullptr)
              break;
            if (!in_progress.insert(next).second)
              {
                complaints.add(asked->where, "<" + next->name + "> is, in the end, a copy of itself.");
                break;
              }
            chain.push_back(next);
            if (original_of(*asked) == nullptr)
              complain(*next, *asked);
            next = original_of(*asked);
          }
        for (auto copy = chain.rbegin(); copy != chain.rend(); ++copy)
          {
            const Outline::Entry asked    = *(*copy)->entry("Copy of"); // which moves while we inherit
            Outline *const       original = original_of(asked);
            if (original != nullptr && original != *copy)
              inherit(**copy, *original, n_inherited);
            if (n_inherited > most_inherited)
              complaints.add(asked.where, "there are too many copies of copies; this one is not made.");
            done.insert(*copy);
          }
      }

      void
      complain(const Outline &section, const Outline::Entry &wanted)
      {
        std::vector<std::string> others;
        if (may_suggest())
          for (const auto &s : sections)
            if (&s != &section)
              others.push_back(s.name);
        complaints.add(wanted.where,
                       "<" + section.name + ">: there is no <" + wanted.value + "> beside it to copy" +
                         did_you_mean(wanted.value, others));
      }

      std::vector<Outline> &sections;
      std::size_t          &n_inherited;
      Complaints           &complaints;

      std::unordered_map<std::string, std::size_t> numbers; ///< of the sections, by name

      std::set<const Outline *> in_progress, done;
    };

    /** First the sections beside each other, then what is in them: nested copies see all that was inherited. */
    void
    resolve_level(Outline &parent, std::size_t &n_inherited, Complaints &complaints)
    {
      Siblings(parent.sections, n_inherited, complaints).resolve();
      for (auto &s : parent.sections)
        resolve_level(s, n_inherited, complaints);
    }
  } // namespace



  void
  Outline::resolve_copies(Complaints &complaints)
  {
    forget_inherited(*this);
    std::size_t n_inherited = 0;
    resolve_level(*this, n_inherited, complaints);
  }
} // namespace samara
