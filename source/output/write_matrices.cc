#include <samara/output/hdf5.h>
#include <samara/output/write_matrices.h>

#include <algorithm>

namespace samara
{
  namespace
  {
    using Matrices = std::vector<std::pair<std::string, Eigen::MatrixXd>>;
    using Texts    = std::vector<std::pair<std::string, std::vector<std::string>>>;



    hdf5::Handle
    dataset_of(const hid_t file, const std::string &name, const hid_t type, const std::vector<hsize_t> &sizes)
    {
      const hdf5::Handle properties(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
      hdf5::check(H5Pset_obj_track_times(properties, 0)); // equal runs leave equal files
      const hdf5::Handle space(H5Screate_simple(sizes.size(), sizes.data(), nullptr), &H5Sclose);
      return {H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT), &H5Dclose};
    }



    void
    write_matrix(const hid_t file, const std::string &name, const Eigen::MatrixXd &matrix)
    {
      const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> by_rows = matrix;
      hdf5::Handle                                                                 dataset =
        dataset_of(file, name, H5T_NATIVE_DOUBLE, {hsize_t(matrix.rows()), hsize_t(matrix.cols())});
      if (matrix.size() > 0)
        hdf5::check(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, by_rows.data()));
      dataset.close();
    }



    /** Texts of one length, filled with zeros. */
    void
    write_texts(const hid_t file, const std::string &name, const std::vector<std::string> &texts)
    {
      std::size_t length = 1;
      for (const auto &text : texts)
        length = std::max(length, text.size() + 1);
      std::string all(length * texts.size(), '\0');
      for (std::size_t i = 0; i < texts.size(); ++i)
        all.replace(i * length, texts[i].size(), texts[i]);
      const hdf5::Handle type(H5Tcopy(H5T_C_S1), &H5Tclose);
      hdf5::check(H5Tset_size(type, length));
      hdf5::check(H5Tset_cset(type, H5T_CSET_UTF8));
      hdf5::Handle dataset = dataset_of(file, name, type, {hsize_t(texts.size())});
      if (!texts.empty())
        hdf5::check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()));
      dataset.close();
    }
  } // namespace



  void
  write_matrices(const std::string &file, const Matrices &matrices, const Texts &texts)
  {
    hdf5::write_file(file, [&](const hid_t part) {
      for (const auto &[name, matrix] : matrices)
        write_matrix(part, name, matrix);
      for (const auto &[name, text] : texts)
        write_texts(part, name, text);
    });
  }
} // namespace samara
