#ifndef samara_output_history_h
#define samara_output_history_h

#include <chrono>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace samara
{
  /**
   * Numbers that are recorded while an analysis runs, one row a step, in two files of the same content:
   *
   *     FOLDER/NAME.csv    with a header such as `t [s],shaft 1.middle.displacement y [m]`; grows by whole rows, about
   *                        every 0.2 s, so that a run can be watched and a killed one has its history
   *     FOLDER/NAME.h5     a 1-D dataset a column under the column's name, with the attribute `unit`; made from the CSV
   *                        file at the end, until then there is none
   *
   * Numbers have 15 significant digits. Rows are not kept in memory.
   *
   * What cannot be written is a std::runtime_error with the name of the file; nothing can be added then.
   */
  class History
  {
  public:
    /**
     * Makes the folder if there is none. @p columns are names and units; the header leaves out the unit of pure
     * numbers, "" or "1".
     *
     * The history begins afresh, or, with @p resume_after, goes on behind the rows of an existing CSV file: those up to
     * the first one whose number in the first column is larger. The rest is cut off, a last line without an end too.
     * If there is no such file the history begins afresh. If it has other columns, rows that are not numbers, or another
     * number of rows to be kept than @p n_expected, that is an InputError, and the file stays as it is.
     */
    History(const std::string                                      &folder,
            const std::string                                      &name,
            const std::vector<std::pair<std::string, std::string>> &columns,
            const std::optional<double>                            &resume_after = std::nullopt,
            const std::optional<std::uint64_t>                     &n_expected   = std::nullopt);

    History(const History &)            = delete;
    History &operator=(const History &) = delete;

    /** finish(), but with failures only reported: a destructor must not throw. */
    ~History();

    /**
     * One number a column. The row is in the file 0.2 s later at the latest, provided that rows go on to be added: a
     * killed program may lose the rows of its last 0.2 s, and the last row.
     *
     * @throws NotConverged naming the column if a number is not finite; the last @p n_optional ones may be missing, nan.
     */
    void add(const std::vector<double> &row, unsigned int n_optional = 0);

    /**
     * Write all rows, and with @p wait bring them to the disk, so that they outlive the machine. Call it before write_checkpoint(): otherwise rows before the checkpoint may be
     * missing when a killed run is continued.
     */
    void flush(bool wait = true);

    /** Rows there are, with those that were kept. */
    std::uint64_t
    size() const
    {
      return n_rows;
    }

    /** Flush and write the HDF5 file. No rows can follow. A second call does nothing. */
    void finish();

  private:
    bool keep_rows(double resume_after, const std::optional<std::uint64_t> &n_expected);
    void write_lines();
    void write_hdf5_file() const;

    const std::vector<std::pair<std::string, std::string>> columns;
    const std::string                                      csv_file, hdf5_file, header;

    std::ofstream                         csv;
    std::string                           lines; ///< not yet in the file
    std::chrono::steady_clock::time_point time_of_writing;
    std::uint64_t                         n_rows   = 0;
    bool                                  finished = false;
  };
} // namespace samara

#endif
