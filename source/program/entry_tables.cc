#include <samara/base/text.h>
#include <samara/program/entry_tables.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>

namespace samara
{
  namespace
  {
    constexpr unsigned int few = 3; // entries or kinds from which on a link is shorter than what it leads to

    const std::string head = "| entry | default | meaning |\n|---|---|---|\n";



    bool
    has(const std::vector<EntryRow> &rows, const EntryRow &row)
    {
      return std::any_of(rows.begin(), rows.end(), [&](const EntryRow &r) { return r.says_as(row); });
    }



    /** The subsection of a path, "rotation 1", or nothing. */
    std::string
    subsection_of(const std::string &path)
    {
      const auto at = path.rfind(" / ");
      return at == std::string::npos ? "" : path.substr(0, at);
    }



    /** The name of a heading in a link, as GitHub makes it. */
    std::string
    anchor_of(const std::string &heading)
    {
      std::string anchor;
      for (const unsigned char c : heading)
        if (c == ' ' || c == '-')
          anchor += '-';
        else if (std::isalnum(c) != 0 || c == '_')
          anchor += static_cast<char>(std::tolower(c));
      return anchor;
    }



    unsigned int
    n_in(const std::vector<EntryRow> &rows, const std::string &section)
    {
      return std::count_if(rows.begin(), rows.end(), [&](const EntryRow &row) {
        return subsection_of(row.path) == section;
      });
    }



    /** "`Body A`, `Axis`; in `rotation 1` and `rotation 2`: `Spring`, `Damper`" of rows; "all" where it is all that is
     * known. */
    std::string
    names_of(const std::vector<EntryRow> &rows, const std::vector<EntryRow> &known)
    {
      std::vector<std::pair<std::string, std::string>> sections; // with the names in each
      for (const auto &row : rows)
        {
          const std::string section = subsection_of(row.path);
          const std::string name    = "`" + (section.empty() ? row.path : row.path.substr(section.size() + 3)) + "`";
          const auto        known =
            std::find_if(sections.begin(), sections.end(), [&](const auto &other) { return other.first == section; });
          if (known == sections.end())
            sections.emplace_back(section, name);
          else
            known->second += ", " + name;
        }
      for (auto &[section, names] : sections)
        if (const std::string plain = subsection_of(EntryRow{section + " / x", "", "", ""}.plain_path());
            !section.empty() && n_in(rows, section) == n_in(known, plain))
          names = "all";
      std::vector<std::string> parts;
      std::set<std::string>    told;
      for (const auto &[section, names] : sections)
        if (section.empty())
          parts.push_back(names);
        else if (told.insert(names).second)
          {
            std::vector<std::string> alike;
            for (const auto &other : sections)
              if (other.second == names && !other.first.empty())
                alike.push_back("`" + other.first + "`");
            parts.push_back("in " + join(alike, " and ") + ": " + names);
          }
      return join(parts, "; ");
    }
  } // namespace



  std::string
  without_unit(std::string meaning)
  {
    const auto close = meaning.rfind("].");
    const auto open  = meaning.rfind(" [", close);
    if (close != std::string::npos && open != std::string::npos)
      meaning.erase(open, close + 1 - open);
    return meaning;
  }



  std::string
  EntryRow::text() const
  {
    const bool  is_value = !standard.empty() && standard != required;
    std::string value    = standard;
    if (!unit.empty())
      value += is_value ? " " + unit : (value.empty() ? "in " : ", in ") + unit;
    return "| " + path + " | " + value + " | " + meaning + " |\n";
  }



  std::string
  EntryRow::plain_path() const
  {
    std::string section = subsection_of(path);
    if (section.empty())
      return path;
    const std::string name = path.substr(section.size());
    if (section.size() > 2 && section[section.size() - 2] == ' ' &&
        std::isdigit(static_cast<unsigned char>(section.back())) != 0)
      section.resize(section.size() - 2);
    return section + name;
  }



  bool
  EntryRow::says_as(const EntryRow &other) const
  {
    return plain_path() == other.plain_path() && standard == other.standard && unit == other.unit &&
           meaning == other.meaning;
  }



  std::vector<EntryRow>
  rows_of(const Parameters &parameters)
  {
    std::stringstream text;
    parameters.document(text);
    std::vector<EntryRow> rows;
    std::string           line;
    std::getline(text, line);
    std::getline(text, line); // the head of the table
    while (std::getline(text, line))
      {
        std::vector<std::string> cells;
        for (std::size_t begin = 2, end = 0; end + 2 != line.size(); begin = end + 3)
          {
            end = line.find(" | ", begin - 1);
            end = std::min(end, line.size() - 2);
            cells.push_back(line.substr(begin, std::max(end, begin) - begin));
          }
        cells.resize(4);
        rows.push_back({cells[0], cells[1], cells[2], without_unit(cells[3])});
      }
    return rows;
  }



  void
  print_rows(std::ostream &out, const std::vector<EntryRow> &rows)
  {
    out << head;
    for (const auto &row : rows)
      out << row.text();
  }



  EntryTables::EntryTables(const std::string &noun)
    : noun(noun)
  {}



  void
  EntryTables::add(const std::string &kind, std::vector<EntryRow> rows)
  {
    kinds.push_back({kind, std::move(rows)});
  }



  std::vector<EntryRow>
  EntryTables::shared() const
  {
    struct Count
    {
      EntryRow     row;
      unsigned int n_kinds;
    };
    std::vector<Count> counts;
    for (const auto &kind : kinds)
      {
        std::vector<EntryRow> own;
        for (auto row : kind.rows)
          if (row.path = row.plain_path(); !has(own, row))
            own.push_back(row);
        for (const auto &row : own)
          {
            const auto known =
              std::find_if(counts.begin(), counts.end(), [&](const Count &c) { return c.row.says_as(row); });
            if (known == counts.end())
              counts.push_back({row, 1});
            else
              ++known->n_kinds;
          }
      }
    std::vector<EntryRow> result;
    for (const auto &count : counts)
      {
        const bool most = std::none_of(counts.begin(), counts.end(), [&](const Count &c) {
          return c.row.path == count.row.path &&
                 (c.n_kinds > count.n_kinds || (c.n_kinds == count.n_kinds && &c < &count));
        });
        if (count.n_kinds >= few && most)
          result.push_back(count.row);
      }
    if (result.size() < few)
      return {};
    // those of one motion stand together
    std::stable_sort(result.begin(), result.end(), [](const EntryRow &a, const EntryRow &b) {
      return subsection_of(a.path) < subsection_of(b.path);
    });
    return result;
  }



  int
  EntryTables::like(const unsigned int k, const std::vector<EntryRow> &rows) const
  {
    int         best = -1;
    std::size_t most = few - 1;
    for (unsigned int j = 0; j < k; ++j)
      {
        const std::size_t n =
          std::count_if(rows.begin(), rows.end(), [&](const EntryRow &row) { return has(kinds[j].rows, row); });
        if (n > most)
          {
            most = n;
            best = j;
          }
      }
    return best;
  }



  void
  EntryTables::print_shared(std::ostream &out) const
  {
    const auto rows = shared();
    if (rows.empty())
      return;
    out << "### Several kinds of " << noun
        << "\n\nThe entries that several kinds have; each kind names those that it has.\n\n";
    print_rows(out, rows);
    out << '\n';
  }



  void
  EntryTables::print(std::ostream &out, const std::string &kind) const
  {
    const auto known = shared();
    const auto k     = std::find_if(kinds.begin(), kinds.end(), [&](const Kind &other) { return other.name == kind; });
    const auto split = [](const std::vector<EntryRow> &rows, const std::vector<EntryRow> &of) {
      std::vector<EntryRow> in, out;
      for (const auto &row : rows)
        (has(of, row) ? in : out).push_back(row);
      return std::make_pair(in, out);
    };
    auto [common, own] = split(k->rows, known);
    const int before   = like(k - kinds.begin(), own);
    if (before >= 0)
      {
        const auto [alike, rest] = split(own, kinds[before].rows);
        const std::string &name  = kinds[before].name;
        out << "As in [" << name << "](#" << anchor_of(name) << "): " << names_of(alike, {}) << ".\n\n";
        own = rest;
      }
    if (!common.empty())
      out << "As in [several kinds](#" << anchor_of("Several kinds of " + noun) << "): " << names_of(common, known)
          << ".\n\n";
    if (!own.empty())
      {
        print_rows(out, own);
        out << '\n';
      }
  }
} // namespace samara
