#ifndef samara_report_csv_columns_h
#define samara_report_csv_columns_h

#include <map>
#include <string>
#include <vector>

namespace samara
{
  /** A table that is in a CSV file: columns of numbers, and of words where one field is no number. */
  struct CsvColumns
  {
    struct Column
    {
      std::string              name, unit;
      bool                     is_text = false;
      std::vector<double>      numbers; ///< not a number where a field is empty
      std::vector<std::string> words;   ///< of text
    };

    std::vector<Column> columns;
    std::size_t         n_rows = 0;

    /** Nothing if the file cannot be read. A last line without an end, of a run that goes on or was killed, is left
     * out. */
    static CsvColumns read(const std::string &file);

    /** The same of a file that has been read before and has more rows now; of one that is another now, from its start.
     */
    void go_on(const std::string &file);

    /**
     * Numbers of the rows to be shown so that about @p most_numbers remain: rows with the least and the largest of a
     * column in each of equal pieces, the first and the last. All if there are no more.
     */
    std::vector<std::size_t> kept(std::size_t most_numbers) const;

  private:
    std::size_t n_bytes = 0; ///< of the file that are read
    std::string last_bytes;  ///< of those

    void add(const std::string &text);
  };



  /** Histories that a run goes on with: each row is read once, however often a page is written. */
  class GrowingTables
  {
  public:
    /** As the file is now; until the next call. */
    const CsvColumns &read(const std::string &file);

  private:
    std::map<std::string, CsvColumns> tables;
  };
} // namespace samara

#endif
