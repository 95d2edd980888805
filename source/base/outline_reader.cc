#include <samara/base/outline_reader.h>
#include <samara/base/text.h>
#include <samara/base/text_file.h>

#include <algorithm>
#include <filesystem>

namespace samara
{
  namespace
  {
    namespace fs = std::filesystem;

    // of files within files, and subsections within subsections: more is a mistake, and would fill the memory
    constexpr std::size_t deepest_include = 50, deepest_section = 50, most_files = 10'000,
                          most_bytes = std::size_t(512) << 20;

    /** One physical line without comment and trailing white space. */
    bool
    get_line(const std::string &text, std::size_t &position, std::string &line)
    {
      if (position >= text.size())
        return false;
      const auto end = std::min(text.find('\n', position), text.size());
      line.assign(text, position, end - position);
      position = end + 1;
      line.resize(std::min(line.find('#'), line.size()));
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

    /** How many columns of white space begin the line. */
    unsigned int
    indentation_of(const std::string &line)
    {
      unsigned int columns = 0;
      for (const char c : line)
        if (c == ' ')
          ++columns;
        else if (c == '\t')
          columns = columns / 8 * 8 + 8;
        else
          break;
      return columns;
    }

    bool
    is_control_character(const char c)
    {
      return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7f;
    }
  } // namespace



  OutlineReader::OutlineReader(Complaints &complaints, const bool by_indentation)
    : complaints(complaints)
    , by_indentation(by_indentation)
  {}



  void
  OutlineReader::read_file(const std::string &filename, const std::string &asked_at, Outline &root)
  {
    try
      {
        const std::string text = text_of_file(filename);
        n_bytes += text.size();
        if (++n_files > most_files || n_bytes > most_bytes)
          throw std::invalid_argument("there are too many files included in each other.");
        read(text, filename, root);
      }
    catch (const std::invalid_argument &problem)
      {
        complaints.add(asked_at, problem.what());
      }
  }



  void
  OutlineReader::read(const std::string &text, const std::string &filename, Outline &root)
  {
    Names      names_of_root;
    const bool is_included = !open.empty();
    if (!is_included)
      open.push_back({&root, &names_of_root, filename, 0});
    files.push_back(filename);
    base_depth.push_back(open.size());

    read_lines(text, filename);
    while (has_open())
      close_last_without_end();
    n_too_deep = 0;

    base_depth.pop_back();
    files.pop_back();
    if (!is_included)
      open.pop_back();
  }



  void
  OutlineReader::read_lines(const std::string &text, const std::string &filename)
  {
    std::string line, more;
    std::size_t position = 0;
    for (unsigned int number = 1; get_line(text, position, line); ++number)
      {
        const std::string place = filename + ":" + std::to_string(number);
        while (!line.empty() && line.back() == '\\')
          {
            line.pop_back();
            if (!get_line(text, position, more))
              break;
            line += trim(more);
            ++number;
          }
        indentation        = indentation_of(line);
        is_indented        = is_indented || (indentation > 0 && indentation < line.size());
        line               = trim(line);
        const auto control = std::find_if(line.begin(), line.end(), is_control_character);
        if (control == line.end())
          read_statement(line, filename, place);
        else
          complaints.add(place, "<" + std::string(1, *control) + "> is a control character; is this a text file?");
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
    else if (n_too_deep > 0)
      return;
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
    if (by_indentation)
      close_unmatched(true);
    if (name.empty())
      complaints.add(place, "this subsection has no name.");
    if (open.size() > deepest_section)
      {
        if (n_too_deep++ == 0)
          complaints.add(place,
                         "subsections are nested more than " + std::to_string(deepest_section) +
                           " deep; has an 'end' been forgotten?");
        return;
      }

    // The same subsection may be opened by several files, which merge, but only once by each.
    auto      &siblings = open.back().section->sections;
    auto      &names    = *open.back().names;
    const auto twin     = names.sections.emplace(name, siblings.size());
    if (twin.second)
      {
        siblings.emplace_back();
        siblings.back().name  = name;
        siblings.back().where = place;
        names.inside.push_back(std::make_unique<Names>());
      }
    const auto number = twin.first->second;
    Names     &inside = *names.inside[number];
    open.push_back({&siblings[number], &inside, place, indentation});

    const auto first = inside.opened.insert({filename, place});
    if (!first.second && !name.empty())
      complaints.add(place, "subsection <" + name + "> was already opened at " + first.first->second + ".");
  }



  void
  OutlineReader::end_subsection(const std::string &place)
  {
    if (n_too_deep > 0)
      {
        --n_too_deep;
        return;
      }
    if (by_indentation)
      close_unmatched(false);
    if (has_open() && (!by_indentation || indentation == open.back().indentation))
      {
        open.pop_back();
        return;
      }
    ++n_unmatched;
    complaints.add(place, "this 'end' closes no subsection of this file.");
  }



  void
  OutlineReader::close_unmatched(const bool or_equal)
  {
    while (has_open() &&
           (open.back().indentation > indentation || (or_equal && open.back().indentation == indentation)))
      close_last_without_end();
  }



  void
  OutlineReader::close_last_without_end()
  {
    ++n_unmatched;
    complaints.add(open.back().opened_at, "subsection <" + open.back().section->name + "> has no 'end'.");
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
    if (Outline::has_stray_brace(value))
      return complaints.add(place, "<" + name + ">: a value must not contain '{', except in <${name}>.");

    auto      &entries = open.back().section->entries;
    const auto twin    = open.back().names->entries.emplace(name, entries.size());
    if (twin.second)
      {
        entries.push_back({name, value, place});
        return;
      }
    auto &before = entries[twin.first->second];
    if (is_in_open_file(before.where))
      complaints.add(place, "<" + name + "> was already set at " + before.where + ".");
    else
      before = {name, value, place};
  }



  void
  OutlineReader::include(const std::string &text, const std::string &filename, const std::string &place)
  {
    if (text.empty())
      return complaints.add(place, "this 'include' names no file.");
    const std::string included = file_beside(filename, text);
    if (files.size() >= deepest_include)
      return complaints.add(place, "files include each other more than " + std::to_string(deepest_include) + " deep.");
    if (std::any_of(files.begin(), files.end(), [&](const std::string &f) { return same_file(f, included); }))
      return complaints.add(place,
                            "<" + included + "> includes itself: " + join(files, " -> ") + " -> " + included + ".");
    complaints.note_inclusion(included, place);
    read_file(included, place, *open.back().section);
  }



  bool
  OutlineReader::is_in_open_file(const std::string &place) const
  {
    const std::string file = place.substr(0, place.rfind(':'));
    return std::find(files.begin(), files.end(), file) != files.end();
  }



  bool
  OutlineReader::has_open() const
  {
    return open.size() > base_depth.back();
  }
} // namespace samara
