#ifndef samara_output_write_hdf5_h
#define samara_output_write_hdf5_h

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace samara
{
  /**
   * Write a HDF5 file with one 1-D dataset of @p n_rows doubles a column. @p columns are names and units; the unit
   * becomes the text attribute `unit`. A name with "/" becomes a dataset in a group, which is read under the same name;
   * of columns with the same name the first is written.
   *
   * The values come in blocks: @p next_block gives a vector a column, all of the same length, until there are n_rows.
   *
   * The file is complete, or what it was before. Throws a std::runtime_error with the name of the file if it cannot be
   * written, or if next_block throws one.
   */
  void write_hdf5(const std::string                                             &file,
                  const std::vector<std::pair<std::string, std::string>>        &columns,
                  std::uint64_t                                                  n_rows,
                  const std::function<void(std::vector<std::vector<double>> &)> &next_block);
} // namespace samara

#endif
