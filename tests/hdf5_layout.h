#ifndef samara_tests_hdf5_layout_h
#define samara_tests_hdf5_layout_h

#include <samara/output/hdf5.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace samara
{
  /** A file of matrices as MATLAB's h5read and h5py see it: plain datasets at the top, of doubles or of texts. */
  class PlainFile
  {
  public:
    explicit PlainFile(const std::string &name)
      : file(H5Fopen(name.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), &H5Fclose)
    {}

    /** Names of all that is there; what is no dataset fails. */
    std::set<std::string>
    names() const
    {
      std::set<std::string> result;
      hdf5::check(H5Literate(
        file,
        H5_INDEX_NAME,
        H5_ITER_INC,
        nullptr,
        [](hid_t, const char *name, const H5L_info_t *, void *all) {
          static_cast<std::set<std::string> *>(all)->insert(name);
          return herr_t(0);
        },
        &result));
      for (const auto &name : result)
        {
          const hdf5::Handle object(H5Oopen(file, name.c_str(), H5P_DEFAULT), &H5Oclose);
          EXPECT_EQ(H5Iget_type(object), H5I_DATASET) << name;
        }
      return result;
    }

    /**
     * What `h5read(file, name)'` is in MATLAB: numbers as they lie in the file fill columns, dimensions the other way
     * round, and are transposed. They must be doubles of eight bytes, unpacked.
     */
    Eigen::MatrixXd
    matrix(const std::string &name) const
    {
      const hdf5::Handle dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), &H5Dclose);
      const hdf5::Handle type(H5Dget_type(dataset), &H5Tclose), properties(H5Dget_create_plist(dataset), &H5Pclose);
      EXPECT_GT(H5Tequal(type, H5T_IEEE_F64LE), 0) << name;
      EXPECT_EQ(H5Pget_layout(properties), H5D_CONTIGUOUS) << name;
      EXPECT_EQ(H5Pget_nfilters(properties), 0) << name;
      const std::vector<hsize_t> sizes = sizes_of(dataset);
      EXPECT_EQ(sizes.size(), 2u) << name;
      Eigen::MatrixXd as_matlab_reads(sizes.at(1), sizes.at(0));
      if (as_matlab_reads.size() > 0)
        hdf5::check(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, as_matlab_reads.data()));
      return as_matlab_reads.transpose();
    }

    /** Texts of one length, a vector. */
    std::vector<std::string>
    texts(const std::string &name) const
    {
      const hdf5::Handle dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), &H5Dclose);
      const hdf5::Handle type(H5Dget_type(dataset), &H5Tclose);
      EXPECT_EQ(H5Tget_class(type), H5T_STRING) << name;
      EXPECT_EQ(H5Tis_variable_str(type), 0) << name;
      const std::vector<hsize_t> sizes = sizes_of(dataset);
      EXPECT_EQ(sizes.size(), 1u) << name;
      const std::size_t length = H5Tget_size(type);
      std::string       all(length * sizes.at(0), '?');
      hdf5::check(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()));
      std::vector<std::string> result;
      for (std::size_t i = 0; i < sizes[0]; ++i)
        result.emplace_back(all.substr(i * length, length).c_str());
      return result;
    }

  private:
    const hdf5::Quiet  quiet;
    const hdf5::Handle file;

    static std::vector<hsize_t>
    sizes_of(const hid_t dataset)
    {
      const hdf5::Handle   space(H5Dget_space(dataset), &H5Sclose);
      std::vector<hsize_t> sizes(H5Sget_simple_extent_ndims(space));
      H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
      return sizes;
    }
  };
} // namespace samara

#endif
