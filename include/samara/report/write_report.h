#ifndef samara_report_write_report_h
#define samara_report_write_report_h

#include <samara/report/array_stream.h>
#include <samara/report/csv_columns.h>

#include <string>
#include <vector>

namespace samara
{
  /**
   * Write the page of one folder of results, or of several beside each other: one file that needs nothing else and asks
   * for nothing. What it shows is in the folders:
   *
   *     report.data, report.1.data ...    what is drawn; none: there is no drawing
   *     *.csv                             tables; of large ones those rows are kept that have the least and the largest
   *                                       value of a column in a piece of time
   *     used.prm, run.log                 the model as used, all messages
   *
   * Tables of an earlier run of the same folder are not shown, as far as report.data says which these are.
   *
   * Who writes the page of one run again and again keeps the histories that it has read in @p growing.
   *
   * A page @p is_live loads itself again while it is open. The file takes the place of the old one when it is complete.
   * @throws CannotWrite; InputError if a folder has none of these files
   */
  void write_report(const std::vector<std::string> &folders,
                    const std::string              &file,
                    bool                            is_live = false,
                    GrowingTables                  *growing = nullptr);

  /** FOLDER/report.data: a line that says what it is, one of JSON, and the stream. */
  void write_report_data(const std::string &folder, const std::string &json, const ArrayStream &stream);

  /** Before a run: what an earlier one has drawn goes, or, if this one goes on behind it, gets a number. Its page goes.
   */
  void keep_earlier_data(const std::string &folder, bool goes_on);
} // namespace samara

#endif
