#ifndef samara_base_outline_reader_h
#define samara_base_outline_reader_h

#include <samara/base/outline.h>

#include <istream>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace samara
{
  /** Reads .prm files into an Outline, line by line. After a mistake it goes on with the next line. */
  class OutlineReader
  {
  public:
    explicit OutlineReader(Complaints &complaints);

    /** Read a file into @p root, which may have something already. @p asked_at is the place of an `include`, or "". */
    void read_file(const std::string &filename, const std::string &asked_at, Outline &root);

    /** The same from a stream; @p filename is for `where` and `include`. */
    void read(std::istream &in, const std::string &filename, Outline &root);

  private:
    void read_lines(std::istream &in, const std::string &filename);

    void read_statement(const std::string &line, const std::string &filename, const std::string &place);

    void begin_subsection(const std::string &name, const std::string &filename, const std::string &place);

    void end_subsection(const std::string &place);

    void set_entry(const std::string &text, const std::string &place);

    void include(const std::string &text, const std::string &filename, const std::string &place);

    /** Whether @p place is in the file being read or in one that includes it. */
    bool is_in_open_file(const std::string &place) const;

    std::string path() const;

    Complaints              &complaints;
    std::vector<Outline *>   open;       ///< the subsections around the line being read
    std::vector<std::size_t> base_depth; ///< how many were open where each file began
    std::vector<std::string> files;      ///< being read, the innermost last

    /** Where each subsection was opened, by path and file. */
    std::map<std::pair<std::string, std::string>, std::string> opened;
  };
} // namespace samara

#endif
