#ifndef samara_base_outline_reader_h
#define samara_base_outline_reader_h

#include <samara/base/outline.h>

#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace samara
{
  /**
   * Reads .prm files into an Outline, line by line. After a mistake it goes on with the next line. Time grows with the
   * size of the file and not faster: all that was said is found by its hash.
   */
  class OutlineReader
  {
  public:
    /**
     * By their indentation subsections are matched with their ends once it is known that some have none, or that there
     * are ends too many: then one mistake costs one subsection, and not the rest of the file.
     */
    explicit OutlineReader(Complaints &complaints, bool by_indentation = false);

    /** Read a file into the empty @p root. @p asked_at is the place of an `include`, or "". */
    void read_file(const std::string &filename, const std::string &asked_at, Outline &root);

    /** The same from a text; @p filename is for `where` and `include`. */
    void read(const std::string &text, const std::string &filename, Outline &root);

    unsigned int n_unmatched = 0;     ///< subsections without end, and ends without subsection
    bool         is_indented = false; ///< whether anything is

  private:
    /** What a section has already: numbers of entries and sections by their names. */
    struct Names
    {
      std::unordered_map<std::string, std::size_t> entries, sections;
      std::vector<std::unique_ptr<Names>>          inside; ///< of each section
      std::map<std::string, std::string>           opened; ///< where, by file
    };

    /** A subsection around the line being read. */
    struct Open
    {
      Outline     *section;
      Names       *names;
      std::string  opened_at;
      unsigned int indentation;
    };

    void read_lines(const std::string &text, const std::string &filename);

    void read_statement(const std::string &line, const std::string &filename, const std::string &place);

    void begin_subsection(const std::string &name, const std::string &filename, const std::string &place);

    void end_subsection(const std::string &place);

    void set_entry(const std::string &text, const std::string &place);

    void include(const std::string &text, const std::string &filename, const std::string &place);

    /** Close what stands further to the right, or, @p or_equal, as far as this line, and complain about it. */
    void close_unmatched(bool or_equal);

    void close_last_without_end();

    /** Whether @p place is in the file being read or in one that includes it. */
    bool is_in_open_file(const std::string &place) const;

    bool has_open() const;

    Complaints              &complaints;
    const bool               by_indentation;
    std::vector<Open>        open;
    std::vector<std::size_t> base_depth; ///< how many were open where each file began
    std::vector<std::string> files;      ///< being read, the innermost last
    unsigned int             indentation = 0, n_files = 0, n_too_deep = 0;
    std::size_t              n_bytes = 0;
  };
} // namespace samara

#endif
