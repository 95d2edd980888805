#ifndef samara_base_outline_h
#define samara_base_outline_h

#include <samara/base/errors.h>

#include <string>
#include <vector>

namespace samara
{
  /**
   * The skeleton of a .prm file: its subsections and entries in the order of the file, with the place of each.
   *
   * dealii::ParameterHandler wants every subsection declared before it parses. The outline comes first and says which
   * named bodies, joints and loads there are, so that they can be constructed and declare what they need. Values are
   * raw text and never interpreted here, except for three words that concern the skeleton itself. A "{" stands in
   * "${name}" only, for which the text of a constant is taken later.
   *
   * - `include file` (quotes optional) reads another file in its place. A relative name is relative to the including
   *   file. A file may override what it has included, but nothing may be set twice in one file.
   * - `set Copy of = sibling` inside a named subsection copies the entries and, recursively, the subsections of the
   *   subsection of that name beside it. What the copy says itself overrides what it copies.
   * - `#` starts a comment; `\` at the end of a line continues it.
   */
  struct Outline
  {
    struct Entry
    {
      std::string name;
      std::string value;
      std::string where;             ///< "file:line"
      bool        inherited = false; ///< came here by `Copy of`
    };

    std::string          name;
    std::string          where;             ///< "file:line"; for the whole file its first line
    std::vector<Entry>   entries;           ///< own ones first, then those inherited
    std::vector<Outline> sections;          ///< the same
    bool                 inherited = false; ///< came here by `Copy of`, all of it

    /** Of a whole file: subsections and ends do not match, and its indentation does not tell where. */
    bool is_broken = false;

    /** Read a file and everything it includes, and resolve `Copy of`. Whatever is wrong goes to @p complaints. */
    static Outline of_file(const std::string &filename, Complaints &complaints);

    /** The same; throws an InputError if anything is wrong. */
    static Outline of_file(const std::string &filename);

    /** The same from text; @p filename is what `where` shall say, and what `include` is relative to. */
    static Outline of_text(const std::string &text, const std::string &filename, Complaints &complaints);

    /** The subsection of that name, or nullptr. */
    const Outline *section(const std::string &wanted) const;

    /** The entry of that name, or nullptr. */
    const Entry *entry(const std::string &wanted) const;

    /** The value of an entry, or @p otherwise if there is no such entry. */
    std::string value(const std::string &wanted, const std::string &otherwise = "") const;

    /** The names of the subsections, in order. */
    std::vector<std::string> section_names() const;

    /**
     * Override one entry from the command line: "Bodies/shaft 1/Degree = 4". A named object must exist; its entries and
     * the subsections in it need not. Copies follow their originals. To be called on the outline of a whole file.
     */
    void set(const std::string &path_and_value, Complaints &complaints);

    /** Take what @p other says, which has the last word: its entries, and its subsections into those of the same name.
     */
    void merge(const Outline &other);

    /** Whether a text has a "{" that does not stand in "${name}". */
    static bool has_stray_brace(const std::string &text);

    /** (Re-)do all `Copy of` below here: forget what was inherited, and inherit anew. */
    void resolve_copies(Complaints &complaints);
  };
} // namespace samara

#endif
