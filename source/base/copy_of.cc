#include <samara/base/outline.h>
#include <samara/base/text.h>

#include <algorithm>
#include <set>

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

    /** Give @p copy all that @p original has and it has not. */
    void
    inherit(Outline &copy, const Outline &original)
    {
      for (auto entry : original.entries)
        if (copy.entry(entry.name) == nullptr)
          {
            entry.inherited = true;
            copy.entries.push_back(entry);
          }
      for (const auto &theirs : original.sections)
        {
          auto &sections = copy.sections;
          auto  ours =
            std::find_if(sections.begin(), sections.end(), [&](const Outline &s) { return s.name == theirs.name; });
          if (ours == sections.end())
            {
              ours            = sections.emplace(sections.end());
              ours->name      = theirs.name;
              ours->where     = theirs.where;
              ours->inherited = true;
            }
          inherit(*ours, theirs);
        }
    }

    /** The subsections of one section, copying from each other. */
    class Siblings
    {
    public:
      Siblings(std::vector<Outline> &sections, Complaints &complaints)
        : sections(sections)
        , complaints(complaints)
      {}

      void
      resolve()
      {
        for (auto &s : sections)
          resolve(s);
      }

    private:
      void
      resolve(Outline &section)
      {
        const Outline::Entry *const asked = section.entry("Copy of");
        if (asked == nullptr || done.count(&section) > 0)
          return;
        if (!in_progress.insert(&section).second)
          return complaints.add(asked->where, "<" + section.name + "> is, in the end, a copy of itself.");

        const Outline::Entry wanted = *asked; // which moves while we inherit
        const auto           original =
          std::find_if(sections.begin(), sections.end(), [&](const Outline &s) { return s.name == wanted.value; });
        if (original == sections.end())
          complain(section, wanted);
        else
          {
            resolve(*original);
            if (&*original != &section)
              inherit(section, *original);
          }
        done.insert(&section);
      }

      void
      complain(const Outline &section, const Outline::Entry &wanted)
      {
        std::vector<std::string> others;
        for (const auto &s : sections)
          if (&s != &section)
            others.push_back(s.name);
        complaints.add(wanted.where,
                       "<" + section.name + ">: there is no <" + wanted.value + "> beside it to copy" +
                         did_you_mean(wanted.value, others));
      }

      std::vector<Outline>     &sections;
      Complaints               &complaints;
      std::set<const Outline *> in_progress, done;
    };

    /** First the sections beside each other, then what is in them: nested copies see all that was inherited. */
    void
    resolve_level(Outline &parent, Complaints &complaints)
    {
      Siblings(parent.sections, complaints).resolve();
      for (auto &s : parent.sections)
        resolve_level(s, complaints);
    }
  } // namespace



  void
  Outline::resolve_copies(Complaints &complaints)
  {
    forget_inherited(*this);
    resolve_level(*this, complaints);
  }
} // namespace samara
