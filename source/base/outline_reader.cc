#include <samara/base/outline_reader.h>
#include <samara/base/text.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace samara
{
  namespace
  {
    namespace fs = std::filesystem;

    /** One physical line without comment and trailing white space. */
    bool
    get_line(std::istream &in, std::string &line)
    {
      if (!std::getline(in, line))
        return false;
      line = line.substr(0, line.find('#'));
      line.erase(line.find_last_not_of(" \t\r\n") + 1);
      return true;
    }

    bool
    same_file(const std::string &a, const std::string &b)
    {
      std::error_code ignored;
      return a == b || fs::equivalent(a, b, ignored);
    }

    /** Remove quotes, if the name is in quotes. */
    std::string
    unquoted(const std::string &text)
    {
      const bool is_quoted = text.size() >= 2 && text.front() == text.back() && (text[0] == '"' || text[0] == '\'');
      return is_quoted ? text.substr(1, text.size() - 2) : text;
    }
  } // namespace



  OutlineReader::OutlineReader(Complaints &complaints)
    : complaints(complaints)
  {}



  void
  OutlineReader::read_file(const std::string &filename, const std::string &asked_at, Outline &root)
  {
    std::ifstream in(filename);
    if (!in || fs::is_directory(filename))
      complaints.add(asked_at, "cannot open the file <" + filename + ">.");
    else
      read(in, filename, root);
  }



  void
  OutlineReader::read(std::istream &in, const std::string &filename, Outline &root)
  {
    const bool is_included = !open.empty();
    if (!is_included)
      open.push_back(&root);
    files.push_back(filename);
    base_depth.push_back(open.size());

    read_lines(in, filename);
    for (; open.size() > base_depth.back(); open.pop_back())
      complaints.add(opened.at({path(), filename}), "subsection <" + open.back()->name + "> has no 'end'.");

    base_depth.pop_back();
    files.pop_back();
    if (!is_included)
      open.pop_back();
  }



  void
  OutlineReader::read_lines(std::istream &in, const std::string &filename)
  {
    std::string line, more;
    for (unsigned int number = 1; get_line(in, line); ++number)
      {
        const std::string place = filename + ":" + std::to_string(number);
        while (!line.empty() && line.back() == '\\')
          {
            line.pop_back();
            if (!get_line(in, more))
              break;
            line += trim(more);
            ++number;
          }
        read_statement(trim(line), filename, place);
      }
  }



  void
  OutlineReader::read_statement(const std::string &line, const std::string &filename, const std::string &place)
  {
    if (line.empty())
      return;
    const auto        blank   = std::min(line.find_first_of(" \t"), line.size());
    const std::string keyword = line.substr(0, blank);
    const std::string rest    = trim(line.substr(blank));

    if (keyword == "subsection" || keyword == "SUBSECTION")
      begin_subsection(rest, filename, place);
    else if (line == "end" || line == "END")
      end_subsection(place);
    else if (keyword == "set" || keyword == "SET")
      set_entry(rest, place);
    else if (keyword == "include" || keyword == "INCLUDE")
      include(unquoted(rest), filename, place);
    else
      complaints.add(place, "expected 'set', 'subsection', 'end' or 'include', found <" + line + ">.");
  }



  void
  OutlineReader::begin_subsection(const std::string &name, const std::string &filename, const std::string &place)
  {
    if (name.empty())
      complaints.add(place, "this subsection has no name.");

    // The same subsection may be opened by several files, which merge, but only once by each.
    auto &siblings = open.back()->sections;
    auto  twin     = std::find_if(siblings.begin(), siblings.end(), [&](const Outline &s) { return s.name == name; });
    if (twin == siblings.end())
      {
        twin        = siblings.emplace(siblings.end());
        twin->name  = name;
        twin->where = place;
      }
    open.push_back(&*twin);

    const auto first = opened.insert({{path(), filename}, place});
    if (!first.second && !name.empty())
      complaints.add(place, "subsection <" + name + "> was already opened at " + first.first->second + ".");
  }



  void
  OutlineReader::end_subsection(const std::string &place)
  {
    if (open.size() == base_depth.back())
      complaints.add(place, "this 'end' closes no subsection of this file.");
    else
      open.pop_back();
  }



  void
  OutlineReader::set_entry(const std::string &text, const std::string &place)
  {
    const auto equal = text.find('=');
    if (equal == std::string::npos)
      return complaints.add(place, "this 'set' has no '='.");
    const std::string name  = trim(text.substr(0, equal));
    const std::string value = trim(text.substr(equal + 1));
    if (name.empty())
      return complaints.add(place, "this 'set' has no name before the '='.");
    if (value.find('{') != std::string::npos)
      return complaints.add(place, "<" + name + ">: a value must not contain '{'.");

    auto      &entries = open.back()->entries;
    const auto twin =
      std::find_if(entries.begin(), entries.end(), [&](const Outline::Entry &e) { return e.name == name; });
    if (twin == entries.end())
      entries.push_back({name, value, place});
    else if (is_in_open_file(twin->where))
      complaints.add(place, "<" + name + "> was already set at " + twin->where + ".");
    else
      *twin = {name, value, place};
  }



  void
  OutlineReader::include(const std::string &text, const std::string &filename, const std::string &place)
  {
    if (text.empty())
      return complaints.add(place, "this 'include' names no file.");
    const std::string included = (fs::path(filename).parent_path() / text).lexically_normal().string();
    if (std::any_of(files.begin(), files.end(), [&](const std::string &f) { return same_file(f, included); }))
      return complaints.add(place,
                            "<" + included + "> includes itself: " + join(files, " -> ") + " -> " + included + ".");
    read_file(included, place, *open.back());
  }



  bool
  OutlineReader::is_in_open_file(const std::string &place) const
  {
    const std::string file = place.substr(0, place.rfind(':'));
    return std::find(files.begin(), files.end(), file) != files.end();
  }



  std::string
  OutlineReader::path() const
  {
    std::string path;
    for (const Outline *section : open)
      path += section->name + "\n"; // which is in no name
    return path;
  }
} // namespace samara
