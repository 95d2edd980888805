#ifndef samara_program_entry_tables_h
#define samara_program_entry_tables_h

#include <samara/base/parameters.h>

#include <ostream>
#include <string>
#include <vector>

namespace samara
{
  /** What a table has in place of the default of an entry that must be given. */
  inline const std::string required = "must be given";

  /** A line of a table of entries: "rotation 1 / Spring", its default, its unit, what it means. */
  struct EntryRow
  {
    std::string path, standard, unit, meaning;

    /** As it is written in Markdown: the unit stands behind the default, "0 N/m", or alone, "in N/m". */
    std::string text() const;

    /** The path without the number of a motion: what "rotation 1" and "rotation 2" have is the same. */
    std::string plain_path() const;

    /** Whether the other one says the same of the same entry. */
    bool says_as(const EntryRow &other) const;
  };

  /** "Mass [kg]. One of: a, b." without the unit, which has a column of its own. */
  std::string without_unit(std::string meaning);

  /** The entries of an object, units in their column alone. */
  std::vector<EntryRow> rows_of(const Parameters &parameters);

  void print_rows(std::ostream &out, const std::vector<EntryRow> &rows);

  /**
   * Tables of the kinds of one group in which nothing is said twice: what at least three kinds have stands in a table
   * of its own; of what a kind before has there are the names, with a link.
   */
  class EntryTables
  {
  public:
    /** @p noun is that of the group, "joint". Kinds are added in the order in which they are printed. */
    explicit EntryTables(const std::string &noun);

    void add(const std::string &kind, std::vector<EntryRow> rows);

    /** What several kinds have, with a heading; nothing if there is nothing. */
    void print_shared(std::ostream &out) const;

    void print(std::ostream &out, const std::string &kind) const;

  private:
    struct Kind
    {
      std::string           name;
      std::vector<EntryRow> rows;
    };

    std::string       noun;
    std::vector<Kind> kinds;

    /** What at least three kinds have; of an entry that they do not all mean alike, what most of them mean. */
    std::vector<EntryRow> shared() const;

    /** That of the kinds before number @p k that has most of @p rows; -1 if none has at least three. */
    int like(unsigned int k, const std::vector<EntryRow> &rows) const;
  };
} // namespace samara

#endif
