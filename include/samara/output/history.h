#ifndef samara_output_history_h
#define samara_output_history_h

#include <samara/output/table.h>

#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace samara
{
  /**
   * Numbers that are recorded while an analysis runs, one row a step, in two files of the same content:
   *
   *     FOLDER/NAME.csv    with a header such as `t [s],shaft 1.middle.displacement y [m]`; each row is on the disk
   *                        when add() returns, so that a run can be watched and a killed one has its history
   *     FOLDER/NAME.h5     a 1-D dataset a column under the column's name, with the attribute `unit`
   *
   * What cannot be written is a std::runtime_error with the name of the file.
   */
  class History
  {
  public:
    /**
     * Makes the folder if there is none. @p columns are names and units; the header leaves out the unit of pure
     * numbers, "" or "1".
     */
    History(const std::string                                      &folder,
            const std::string                                      &name,
            const std::vector<std::pair<std::string, std::string>> &columns);

    History(const History &)            = delete;
    History &operator=(const History &) = delete;

    /** finish(), but with failures only reported: a destructor must not throw. */
    ~History();

    /** One number a column. They are written with 15 significant digits. */
    void add(const std::vector<double> &row);

    /** Write the HDF5 file. No rows can follow. A second call does nothing. */
    void finish();

  private:
    const std::string                                      folder, name;
    const std::vector<std::pair<std::string, std::string>> columns;
    std::vector<std::vector<double>>                       values; ///< a vector a column
    std::ofstream                                          csv;
    bool                                                   finished = false;
  };
} // namespace samara

#endif
