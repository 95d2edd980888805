#ifndef samara_output_write_matrices_h
#define samara_output_write_matrices_h

#include <Eigen/Dense>

#include <string>
#include <utility>
#include <vector>

namespace samara
{
  /**
   * Write a HDF5 file with a 2-D dataset of doubles for each matrix, and a 1-D dataset of texts for each list. HDF5
   * counts dimensions from the slowest one; a matrix of m rows and n columns is m × n there, as h5py reads it. MATLAB
   * turns dimensions round, A = h5read(file, '/A')'. A matrix without rows or columns is an empty dataset.
   *
   * Written beside the file and put in its place when it is complete. @throws std::runtime_error with the file's name
   */
  void write_matrices(const std::string                                                   &file,
                      const std::vector<std::pair<std::string, Eigen::MatrixXd>>          &matrices,
                      const std::vector<std::pair<std::string, std::vector<std::string>>> &texts);
} // namespace samara

#endif
