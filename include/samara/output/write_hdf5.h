#ifndef samara_output_write_hdf5_h
#define samara_output_write_hdf5_h

#include <string>
#include <utility>
#include <vector>

namespace samara
{
  /**
   * Write a HDF5 file with one 1-D dataset of doubles a column. @p columns are names and units; the unit becomes the
   * text attribute `unit`. A name with "/" becomes a dataset in a group, which is read under the same name; of columns
   * with the same name the first is written. Throws a std::runtime_error with the name of the file if that fails.
   */
  void write_hdf5(const std::string                                      &file,
                  const std::vector<std::pair<std::string, std::string>> &columns,
                  const std::vector<std::vector<double>>                 &values);
} // namespace samara

#endif
