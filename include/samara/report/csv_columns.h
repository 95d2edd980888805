#ifndef samara_report_csv_columns_h
#define samara_report_csv_columns_h

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

    /**
     * Numbers of the rows to be shown so that about @p most_numbers remain: rows with the least and the largest of a
     * column in each of equal pieces, the first and the last. All if there are no more.
     */
    std::vector<std::size_t> kept(std::size_t most_numbers) const;
  };
} // namespace samara

#endif
