#include <samara/base/outline.h>
#include <samara/base/outline_reader.h>
#include <samara/base/text.h>

#include <algorithm>

namespace samara
{
  namespace
  {
    /** Read by @p read; a second time by indentation if subsections and ends do not match, where that explains it. */
    template <typename Read>
    Outline
    read_outline(const std::string &filename, const Read &read, Complaints &complaints)
    {
      const auto attempt = [&](const bool by_indentation, Outline &root, Complaints &found, unsigned int &n_unmatched) {
        OutlineReader reader(found, by_indentation);
        root.where = filename + ":1";
        read(reader, root);
        n_unmatched = reader.n_unmatched;
        return reader.is_indented;
      };
      Outline      root;
      Complaints   found;
      unsigned int n_unmatched = 0;
      const bool   is_indented = attempt(false, root, found, n_unmatched);
      root.is_broken           = n_unmatched > 0;
      if (root.is_broken && is_indented)
        {
          Outline      other;
          Complaints   found_there;
          unsigned int n_there = 0;
          attempt(true, other, found_there, n_there);
          if (n_there > 0 && n_there <= 2 * n_unmatched + 2)
            {
              root  = std::move(other);
              found = std::move(found_there); // which knows the same inclusions
            }
        }
      complaints.add_all(found.all());
      complaints.note_inclusions_of(found);
      root.resolve_copies(complaints);
      return root;
    }
  } // namespace



  Outline
  Outline::of_file(const std::string &filename, Complaints &complaints)
  {
    const auto read = [&](OutlineReader &reader, Outline &root) { reader.read_file(filename, "", root); };
    return read_outline(filename, read, complaints);
  }



  Outline
  Outline::of_file(const std::string &filename)
  {
    Complaints complaints;
    Outline    root = of_file(filename, complaints);
    complaints.throw_if_any();
    return root;
  }



  Outline
  Outline::of_text(const std::string &text, const std::string &filename, Complaints &complaints)
  {
    const auto read = [&](OutlineReader &reader, Outline &root) { reader.read(text, filename, root); };
    return read_outline(filename, read, complaints);
  }



  const Outline *
  Outline::section(const std::string &wanted) const
  {
    const auto s = std::find_if(sections.begin(), sections.end(), [&](const Outline &s) { return s.name == wanted; });
    return s == sections.end() ? nullptr : &*s;
  }



  const Outline::Entry *
  Outline::entry(const std::string &wanted) const
  {
    const auto e = std::find_if(entries.begin(), entries.end(), [&](const Entry &e) { return e.name == wanted; });
    return e == entries.end() ? nullptr : &*e;
  }



  std::string
  Outline::value(const std::string &wanted, const std::string &otherwise) const
  {
    const Entry *const e = entry(wanted);
    return e == nullptr ? otherwise : e->value;
  }



  std::vector<std::string>
  Outline::section_names() const
  {
    std::vector<std::string> names;
    for (const auto &s : sections)
      names.push_back(s.name);
    return names;
  }



  void
  Outline::set(const std::string &path_and_value, Complaints &complaints)
  {
    const std::string where = "--set";
    const auto        equal = path_and_value.find('=');
    if (equal == std::string::npos)
      return complaints.add(where, "<" + path_and_value + "> has no '='; write \"Section/name/Entry = value\".");

    const std::string path  = trim(path_and_value.substr(0, equal));
    const std::string value = trim(path_and_value.substr(equal + 1));
    if (value.find('{') != std::string::npos)
      return complaints.add(where, "<" + path + ">: a value must not contain '{'.");
    if (std::any_of(value.begin(), value.end(), [](const unsigned char c) { return c < 0x20 && c != '\t'; }))
      return complaints.add(where, "<" + path + ">: there is a control character in <" + value + ">.");

    Outline    *target = this;
    std::size_t begin  = 0;
    for (auto slash = path.find('/'); slash != std::string::npos; slash = path.find('/', begin))
      {
        const std::string step = trim(path.substr(begin, slash - begin));
        const auto        next = std::find_if(target->sections.begin(), target->sections.end(), [&](const Outline &s) {
          return s.name == step;
        });
        if (next == target->sections.end() && target != this && step.find(':') != std::string::npos)
          { // an object of a subsystem; who expands subsystems knows whether there is one
            target->sections.emplace_back();
            target        = &target->sections.back();
            target->name  = step;
            target->where = where;
            begin         = slash + 1;
            continue;
          }
        if (next == target->sections.end())
          return complaints.add(where,
                                "<" + path + ">: there is no subsection <" + step + ">" +
                                  did_you_mean(step, target->section_names()));
        next->inherited = false; // it now says something of its own
        target          = &*next;
        begin           = slash + 1;
      }

    const std::string name = trim(path.substr(begin));
    if (name.empty())
      return complaints.add(where, "<" + path_and_value + "> does not name an entry.");
    const auto e =
      std::find_if(target->entries.begin(), target->entries.end(), [&](const Entry &e) { return e.name == name; });
    if (e == target->entries.end() && target->name == "Constants")
      {
        std::vector<std::string> names;
        for (const auto &entry : target->entries)
          names.push_back(entry.name);
        return complaints.add(where,
                              "<" + path + ">: there is no constant <" + name + "> that this could change" +
                                did_you_mean(name, names));
      }
    if (e == target->entries.end())
      target->entries.push_back({name, value, where});
    else
      *e = {name, value, where};
    resolve_copies(complaints);
  }
} // namespace samara
