#include <samara/base/errors.h>
#include <samara/output/compressor.h>
#include <samara/output/file.h>
#include <samara/report/csv_columns.h>
#include <samara/report/page_sources.h>
#include <samara/report/write_report.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

namespace samara
{
  namespace
  {
    namespace fs = std::filesystem;

    const std::string first_line = "samara report data 1\n";

    /** Numbers of a table that a page has; of the motion of a run, of other tables, and while it runs. */
    constexpr std::size_t most_of_motion = 800000, most_of_others = 200000, fewer_while_it_runs = 4;

    std::string
    content_of(const std::string &file)
    {
      std::ifstream     in(file, std::ios::binary);
      std::stringstream text;
      text << in.rdbuf();
      return text.str();
    }



    std::string
    numbered(const std::string &folder, const unsigned int n)
    {
      return folder + "/report." + (n > 0 ? std::to_string(n) + "." : std::string()) + "data";
    }



    /** What a page is made of: streams as base64, and what refers to them. */
    struct Page
    {
      std::vector<std::string> streams;

      std::size_t
      add(const std::string &bytes)
      {
        streams.emplace_back();
        add_base64(reinterpret_cast<const unsigned char *>(bytes.data()), bytes.size(), streams.back());
        return streams.size() - 1;
      }
    };



    /** Names of tables that were there before a run, as JSON; @p only_before: that nobody has written since that. */
    struct EarlierTables
    {
      std::string                       names;
      std::optional<fs::file_time_type> only_before;

      EarlierTables(const std::string &head, const std::string &file, const bool is_last)
      {
        // no text of JSON has plain quotes in it
        const std::string mark = "\"earlier\":[";
        if (const std::size_t at = head.find(mark); at != std::string::npos)
          names = head.substr(at, head.find(']', at) - at);
        // what a run has left that was killed, or gone on from, was written before its tables
        if (!is_last || head.find("\"state\":\"running\"") != std::string::npos)
          only_before = fs::last_write_time(file);
      }

      bool
      has(const fs::path &table) const
      {
        return names.find(json_text(table.stem().string())) != std::string::npos &&
               (!only_before || fs::last_write_time(table) <= *only_before);
      }
    };



    /** Of all runs of a folder, the earliest first: [{"stream":0,"data":{...}},...] */
    std::string
    drawings_of(const std::string &folder, Page &page, std::vector<EarlierTables> &earlier)
    {
      std::vector<std::string> files;
      for (unsigned int n = 1; fs::exists(numbered(folder, n)); ++n)
        files.push_back(numbered(folder, n));
      files.push_back(numbered(folder, 0));
      std::string text;
      for (const auto &file : files)
        {
          const std::string content = content_of(file);
          const std::size_t end     = content.find('\n', first_line.size());
          if (content.compare(0, first_line.size(), first_line) != 0 || end == std::string::npos)
            continue;
          const std::string head = content.substr(first_line.size(), end - first_line.size());
          earlier.emplace_back(head, file, &file == &files.back());
          text += (text.empty() ? "" : ",") + ("{\"stream\":" + std::to_string(page.add(content.substr(end + 1)))) +
                  ",\"data\":" + head + "}";
        }
      return "[" + text + "]";
    }



    std::string
    json_of(const CsvColumns &table, const std::size_t most, const bool with_all_bits, ArrayStream &stream)
    {
      const auto  rows = table.kept(most);
      std::string text =
        "{\"rows\":" + std::to_string(table.n_rows) + ",\"kept\":" + std::to_string(rows.size()) + ",\"columns\":[";
      for (const auto &column : table.columns)
        {
          text += (&column == &table.columns.front() ? "[" : ",[") + json_text(column.name) + "," +
                  json_text(column.unit) + ",";
          if (column.is_text)
            {
              for (std::size_t i = 0; i < rows.size(); ++i)
                text += (i > 0 ? "," : "[") + json_text(column.words[rows[i]]);
              text += rows.empty() ? "[]]" : "]]";
              continue;
            }
          std::vector<double> numbers;
          for (const std::size_t i : rows)
            numbers.push_back(column.numbers[i]);
          text += with_all_bits ? stream.add(numbers, {numbers.size()}) :
                                  stream.add(std::vector<float>(numbers.begin(), numbers.end()), {numbers.size()});
          text += "]";
        }
      return text + "]}";
    }



    /** Tables of a folder in the order of their names. */
    std::vector<fs::path>
    tables_in(const std::string &folder)
    {
      std::vector<fs::path> files;
      std::error_code       ignored;
      for (const auto &entry : fs::directory_iterator(folder, ignored))
        if (entry.path().extension() == ".csv")
          files.push_back(entry.path());
      std::sort(files.begin(), files.end());
      return files;
    }



    /** {"dynamic":{...},...}, and how many there are. */
    std::string
    tables_of(const std::vector<fs::path> &files,
              const bool                   is_live,
              GrowingTables *const         growing,
              ArrayStream                 &stream,
              std::size_t                 &n_tables)
    {
      std::string text;
      for (const auto &file : files)
        {
          const std::string name  = file.stem().string();
          const bool is_kept      = growing != nullptr && name.compare(0, 7, "dynamic") == 0; // others are written anew
          const CsvColumns  own   = is_kept ? CsvColumns() : CsvColumns::read(file.string());
          const CsvColumns &table = is_kept ? growing->read(file.string()) : own;
          if (table.columns.empty())
            continue;
          // sums of energies and sizes of steps are looked at, not looked up
          const bool  is_side = (name == "dynamic_energy" || name == "dynamic_steps") && table.n_rows > 1000;
          std::size_t most    = name == "dynamic" ? most_of_motion : most_of_others;
          if (is_live)
            most /= fewer_while_it_runs;
          text += (text.empty() ? "" : ",") + json_text(name) + ":" + json_of(table, most, !is_side, stream);
          ++n_tables;
        }
      return "{" + text + "}";
    }



    std::string
    result_of(const std::string &folder, const bool is_live, GrowingTables *const growing, Page &page)
    {
      ArrayStream                stream;
      std::size_t                n_tables = 0;
      std::vector<EarlierTables> earlier;
      const std::string          drawings = drawings_of(folder, page, earlier);
      std::vector<fs::path>      files    = tables_in(folder);
      // tables that an earlier run has left in the folder would be taken for those of this one
      const auto  first = std::stable_partition(files.begin(), files.end(), [&](const fs::path &file) {
        return std::none_of(earlier.begin(), earlier.end(), [&](const EarlierTables &e) { return e.has(file); });
      });
      std::string not_shown;
      for (auto file = first; file != files.end(); ++file)
        not_shown += (not_shown.empty() ? "" : ",") + json_text(file->filename().string());
      files.erase(first, files.end());
      const std::string tables = tables_of(files, is_live, growing, stream, n_tables),
                        used = content_of(folder + "/used.prm"), log = content_of(folder + "/run.log");
      if (drawings == "[]" && n_tables == 0 && used.empty())
        throw InputError("samara: there are no results in " + folder + ". --report wants folders of results.");
      const std::string name = fs::weakly_canonical(folder).filename().string();
      return "{\"name\":" + json_text(name) + ",\"drawings\":" + drawings +
             ",\"stream\":" + std::to_string(page.add(stream.deflated())) + ",\"tables\":" + tables + ",\"earlier\":[" +
             not_shown + "],\"used\":" + json_text(used) + ",\"log\":" + json_text(log) + "}";
    }
  } // namespace



  void
  write_report(const std::vector<std::string> &folders,
               const std::string              &file,
               const bool                      is_live,
               GrowingTables *const            growing)
  {
    Page        page;
    std::string head = std::string("{\"version\":1,\"live\":") + (is_live ? "true" : "false") + ",\"results\":[";
    for (const auto &folder : folders)
      head += (&folder == &folders.front() ? "" : ",") + result_of(folder, is_live, growing, page);
    head += "]}";
    std::string data;
    for (std::size_t i = 0; i < page.streams.size(); ++i)
      data += "<script type=\"text/plain\" id=\"data" + std::to_string(i) + "\">" + page.streams[i] + "</script>\n";
    // the template is cut at its marks: a text that looks like one of them is no mark
    std::string       content;
    const std::string frame = page_frame();
    std::size_t       at    = 0;
    for (const auto &[mark, text] : {std::make_pair(std::string("@STYLE@"), page_style()),
                                     std::make_pair(std::string("@HEADER@"), head),
                                     std::make_pair(std::string("@DATA@"), data),
                                     std::make_pair(std::string("@SCRIPT@"), page_script())})
      {
        const std::size_t next = frame.find(mark, at);
        content.append(frame, at, next - at);
        content += text;
        at = next + mark.size();
      }
    content.append(frame, at, std::string::npos);
    replace_file(file, content);
  }



  void
  write_report_data(const std::string &folder, const std::string &json, const ArrayStream &stream)
  {
    replace_file(folder + "/report.data", first_line + json + "\n" + stream.deflated());
  }



  void
  keep_earlier_data(const std::string &folder, const bool goes_on)
  {
    std::error_code ignored;
    fs::remove(folder + "/report.html", ignored);
    if (goes_on)
      {
        unsigned int n = 1;
        while (fs::exists(numbered(folder, n)))
          ++n;
        fs::rename(numbered(folder, 0), numbered(folder, n), ignored);
        return;
      }
    for (unsigned int n = 0; n == 0 || fs::exists(numbered(folder, n)); ++n)
      fs::remove(numbered(folder, n), ignored);
  }
} // namespace samara
