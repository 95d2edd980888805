/*
 * Problem:   HDF5 files that are laid out by hand
 * Reference: what the HDF5 library reads, checksums of all headers included
 */

#include <samara/output/file.h>
#include <samara/output/plain_hdf5.h>
#include <samara/output/write_hdf5.h>

#include <gtest/gtest.h>
#include <hdf5.h>

#include <numeric>
#include <stdexcept>

#include "scratch_folder.h"

using namespace samara;

namespace
{
  /** Numbers of a dataset, read as this type. */
  template <typename Number>
  std::vector<Number>
  numbers_of_dataset(const hid_t file, const std::string &name, const hid_t type)
  {
    const hid_t dataset = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
    EXPECT_GE(dataset, 0) << name;
    const hid_t         space = H5Dget_space(dataset);
    std::vector<Number> values(H5Sget_simple_extent_npoints(space));
    EXPECT_TRUE(values.empty() || H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0) << name;
    H5Sclose(space);
    H5Dclose(dataset);
    return values;
  }



  std::string
  bytes_of(const std::vector<double> &values)
  {
    return std::string(reinterpret_cast<const char *>(values.data()), sizeof(double) * values.size());
  }



  hsize_t
  n_links(const hid_t file, const std::string &group)
  {
    H5G_info_t info{};
    EXPECT_GE(H5Gget_info_by_name(file, group.c_str(), &info, H5P_DEFAULT), 0);
    return info.nlinks;
  }
} // namespace



/** Headers of every length, so that each way to end a checksum is taken; groups in groups; nothing; characters. */
TEST(PlainHdf5, LibraryReadsWhatWasPutIn)
{
  const ScratchFolder      folder;
  const std::string        path = folder.path + "/plain.h5", characters = "from \x01 to \x7f";
  PlainHdf5                file;
  std::vector<std::string> names, contents;
  for (unsigned int i = 1; i <= 100; ++i)
    {
      names.push_back((i % 3 == 0 ? "a/b/" : i % 3 == 1 ? "a/" : "") + std::string(i, 'x'));
      contents.push_back(bytes_of(std::vector<double>(i % 7, 1. / i)));
      EXPECT_EQ(file.add(names.back(), PlainHdf5::Kind::real, i % 7, "unit", std::string(i % 13, 'm')), i - 1);
    }
  file.add("text", PlainHdf5::Kind::character, characters.size());
  contents.push_back(characters);
  replace_file(path, file.image(contents));

  const hid_t handle = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(handle, 0);
  for (unsigned int i = 1; i <= 100; ++i)
    EXPECT_EQ(numbers_of_dataset<double>(handle, names[i - 1], H5T_NATIVE_DOUBLE), std::vector<double>(i % 7, 1. / i));
  const auto text = numbers_of_dataset<char>(handle, "text", H5T_NATIVE_CHAR);
  EXPECT_EQ(std::string(text.begin(), text.end()), characters);
  EXPECT_EQ(n_links(handle, "/"), 33u + 2); // every third, <a> and <text>
  EXPECT_EQ(n_links(handle, "/a"), 34u + 1);
  EXPECT_EQ(n_links(handle, "/a/b"), 33u);
  H5Fclose(handle);
}



/** In one block and in several; more columns than the library keeps in a header by itself. */
TEST(PlainHdf5, BlocksMakeTheSameFileAsTheWhole)
{
  const ScratchFolder                              folder;
  constexpr unsigned int                           n_columns = 300, n_rows = 12;
  std::vector<std::pair<std::string, std::string>> columns;
  for (unsigned int c = 0; c < n_columns; ++c)
    columns.emplace_back("body " + std::to_string(c) + ".position x", "m");
  std::string whole;
  for (const unsigned int rows : {n_rows, 4u, 1u})
    {
      double next = 0;
      write_hdf5(folder.path + "/h.h5", columns, n_rows, [&](std::vector<std::vector<double>> &block) {
        for (unsigned int c = 0; c < n_columns; ++c)
          {
            block[c].resize(rows);
            std::iota(block[c].begin(), block[c].end(), 1000. * c + next);
          }
        next += rows;
      });
      if (rows == n_rows)
        whole = content_of(folder.path + "/h.h5");
      EXPECT_TRUE(content_of(folder.path + "/h.h5") == whole) << rows;
    }
  const hid_t handle = H5Fopen((folder.path + "/h.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  EXPECT_EQ(n_links(handle, "/"), n_columns);
  for (const unsigned int c : {0u, 123u, 299u})
    {
      std::vector<double> values(n_rows);
      std::iota(values.begin(), values.end(), 1000. * c);
      EXPECT_EQ(numbers_of_dataset<double>(handle, columns[c].first, H5T_NATIVE_DOUBLE), values);
    }
  H5Fclose(handle);
}



TEST(PlainHdf5, WhatHasNoPlaceIsRefused)
{
  const auto real = PlainHdf5::Kind::real;
  PlainHdf5  file;
  file.add("a/b", real, 1);
  EXPECT_THROW(file.add("a/b", real, 1), std::runtime_error);
  EXPECT_THROW(file.add("/a//b", real, 1), std::runtime_error); // as the library reads it
  EXPECT_THROW(file.add("a", real, 1), std::runtime_error);
  EXPECT_THROW(file.add("a/b/c", real, 1), std::runtime_error);
  EXPECT_THROW(file.add("", real, 1), std::runtime_error);
  EXPECT_THROW(file.add("./", real, 1), std::runtime_error);
  file.add("long", real, 1, "name", std::string(70000, 'x'));
  EXPECT_THROW(file.head(), std::runtime_error);
}
