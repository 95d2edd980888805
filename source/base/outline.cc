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



  bool
  Outline::has_stray_brace(const std::string &text)
  {
    for (std::size_t at = 0; (at = text.find('{', at)) != std::string::npos; ++at)
      if (at == 0 || text[at - 1] != '$')
        return true;
    return false;
  }



  void
  Outline::merge(const Outline &other)
  {
    for (const auto &entry : other.entries)
      {
        const auto mine =
          std::find_if(entries.begin(), entries.end(), [&](const Entry &e) { return e.name == entry.name; });
        if (mine == entries.end())
          entries.push_back(entry);
        else
          *mine = entry;
      }
    for (const auto &inner : other.sections)
      {
        const auto mine =
          std::find_if(sections.begin(), sections.end(), [&](const Outline &s) { return s.name == inner.name; });
        if (mine == sections.end())
          sections.push_back(inner);
        else
          mine->merge(inner);
      }
  }



  namespace
  {
    Outline *
    open_section(Outline &around, const std::string &name, const std::string &where)
    {
      around.sections.emplace_back();
      around.sections.back().name  = name;
      around.sections.back().where = where;
      return &around.sections.back();
    }
  } // namespace



  void
  Outline::set(const std::string &path_and_value, Complaints &complaints)
  {
    const std::string where = "--set";
    const auto        equal = path_and_value.find('=');
    if (equal == std::string::npos)
      return complaints.add(where, "<" + path_and_value + "> has no '='; write \"Section/name/Entry = value\".");

    const std::string path  = trim(path_and_value.substr(0, equal));
    const std::string value = trim(path_and_value.substr(equal + 1));
    if (has_stray_brace(value))
      return complaints.add(where, "<" + path + ">: a value must not contain '{', except in <${name}>.");
    if (std::any_of(value.begin(), value.end(), [](const unsigned char c) { return c < 0x20 && c != '\t'; }))
      return complaints.add(where, "<" + path + ">: there is a control character in <" + value + ">.");

    Outline     *target = this;
    std::size_t  begin  = 0;
    unsigned int depth  = 0;
    for (auto slash = path.find('/'); slash != std::string::npos; slash = path.find('/', begin))
      {
        const std::string step = trim(path.substr(begin, slash - begin));
        const auto        next = std::find_if(target->sections.begin(), target->sections.end(), [&](const Outline &s) {
          return s.name == step;
        });
        // an object of a subsystem, or a subsection in an object: who reads these knows whether there is one
        const bool is_opened = (depth >= 1 && step.find(':') != std::string::npos) || depth >= 2;
        ++depth;
        if (next == target->sections.end() && (!is_opened || step.empty()))
          return complaints.add(where,
                                "<" + path + ">: there is no subsection <" + step + ">" +
                                  did_you_mean(step, target->section_names()));
        begin             = slash + 1;
        target            = next != target->sections.end() ? &*next : open_section(*target, step, where);
        target->inherited = false; // it now says something of its own
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
