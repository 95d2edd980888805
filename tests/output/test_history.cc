/*
 * Problem:   histories and tables
 * Reference: the numbers that were put in; 15 significant digits
 */

#include <samara/base/errors.h>
#include <samara/output/history.h>
#include <samara/output/table.h>

#include <hdf5.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <sstream>

#include "scratch_folder.h"

using namespace samara;

namespace
{
  const std::vector<std::pair<std::string, std::string>> history_columns = {{"t", "s"},
                                                                            {"shaft 1.middle.displacement y", "m"},
                                                                            {"force, \"old\"", "N"},
                                                                            {"load factor", "1"}};

  const std::vector<std::pair<std::string, std::string>> columns_of_two = {{"t", "s"}, {"u", "m"}};

  const std::vector<std::vector<double>> rows = {{0, 1. / 3, -1e-300, 1}, {0.1, std::sqrt(2.), 1e300, 2}};



  std::vector<double>
  read_dataset(const std::string &file, const std::string &name, std::string &unit)
  {
    const hid_t handle  = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const hid_t dataset = H5Dopen2(handle, name.c_str(), H5P_DEFAULT);
    const hid_t space   = H5Dget_space(dataset);
    EXPECT_EQ(H5Sget_simple_extent_ndims(space), 1);

    std::vector<double> values(H5Sget_simple_extent_npoints(space));
    EXPECT_GE(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);

    const hid_t       attribute = H5Aopen(dataset, "unit", H5P_DEFAULT);
    const hid_t       type      = H5Aget_type(attribute);
    std::vector<char> text(H5Tget_size(type) + 1, '\0');
    EXPECT_GE(H5Aread(attribute, type, text.data()), 0);
    unit = text.data();

    H5Tclose(type);
    H5Aclose(attribute);
    H5Sclose(space);
    H5Dclose(dataset);
    H5Fclose(handle);
    return values;
  }
} // namespace



TEST(History, CsvHasTheRows)
{
  const ScratchFolder folder;
  History             history(folder.path + "/new/folder", "dynamic", history_columns);
  const std::string   file   = folder.path + "/new/folder/dynamic.csv";
  const std::string   header = "t [s],shaft 1.middle.displacement y [m],\"force, \"\"old\"\" [N]\",load factor\n";
  EXPECT_EQ(content_of(file), header);

  history.add(rows[0]);
  history.flush();
  EXPECT_EQ(content_of(file), header + "0,0.333333333333333,-1e-300,1\n");
  history.add(rows[1]);
  history.finish();
  EXPECT_EQ(content_of(file), header + "0,0.333333333333333,-1e-300,1\n0.1,1.4142135623731,1e+300,2\n");
}



TEST(History, CsvCanBeWatched)
{
  const ScratchFolder folder;
  History             history(folder.path, "h", {{"t", ""}});
  history.add({1});
  std::this_thread::sleep_for(std::chrono::milliseconds(250));
  history.add({2});
  EXPECT_EQ(content_of(folder.path + "/h.csv"), "t\n1\n2\n");
}



TEST(History, Hdf5HasTheSameNumbersAndUnits)
{
  const ScratchFolder folder;
  {
    History history(folder.path, "dynamic", history_columns);
    for (const auto &row : rows)
      history.add(row);
  }
  for (unsigned int c = 0; c < history_columns.size(); ++c)
    {
      std::string               unit;
      const std::vector<double> values = read_dataset(folder.path + "/dynamic.h5", history_columns[c].first, unit);
      ASSERT_EQ(values.size(), rows.size());
      for (unsigned int r = 0; r < rows.size(); ++r)
        EXPECT_LE(std::abs(values[r] - rows[r][c]), 5e-15 * std::abs(rows[r][c]));
      EXPECT_EQ(unit, history_columns[c].second);
    }
}



TEST(History, Hdf5HasAllRowsOfALongRun)
{
  const ScratchFolder folder;
  const unsigned int  n_rows = 10000; // several blocks and a piece
  {
    History history(folder.path, "h", {{"t", "s"}, {"square", "s^2"}});
    for (unsigned int i = 0; i < n_rows; ++i)
      history.add({double(i), double(i) * i});
  }
  std::string               unit;
  const std::vector<double> squares = read_dataset(folder.path + "/h.h5", "square", unit);
  ASSERT_EQ(squares.size(), n_rows);
  for (unsigned int i = 0; i < n_rows; ++i)
    EXPECT_EQ(squares[i], double(i) * i);
}



TEST(History, NumbersAtTheEndsOfTheRange)
{
  const ScratchFolder folder;
  const double        inf = std::numeric_limits<double>::infinity();
  const double largest = std::numeric_limits<double>::max(), smallest = std::numeric_limits<double>::denorm_min();
  History      history(folder.path, "h", {{"x", ""}});
  for (const double x : {smallest, -largest, -0.})
    history.add({x});
  history.finish();

  std::string               unit;
  const std::vector<double> values = read_dataset(folder.path + "/h.h5", "x", unit);
  ASSERT_EQ(values.size(), 3u);
  EXPECT_EQ(values[0], smallest);
  EXPECT_EQ(values[1], -inf); // rounded to 15 digits it is out of the range
  EXPECT_TRUE(values[2] == 0 && std::signbit(values[2]));
}



TEST(History, NumbersThatAreNotFiniteEndTheRun)
{
  const ScratchFolder folder;
  for (const double x : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    {
      History history(folder.path, "h", {{"t", "s"}, {"rod.end.force 1", "N"}, {"second estimate", ""}});
      history.add({1, 2, 3});
      const std::string complaint = complaint_of([&] { history.add({1.5, x, 3}); });
      EXPECT_NE(complaint.find("h.csv, row 2, t = 1.5: <rod.end.force 1> is not a finite number"), std::string::npos)
        << complaint;
      EXPECT_THROW(history.add({x, 2, 3}), NotConverged);
      EXPECT_THROW(history.add({1, 2, x}), NotConverged);
      history.add({1, 2, x}, 1); // may be missing
    }
  Table table({"mode", "frequency"});
  EXPECT_THROW(table.add_row({3, std::nan("")}), NotConverged);
  table.add_row({3, Table::Cell::optional(std::nan(""))});
}



TEST(History, WithoutRowsAndWithStrangeNames)
{
  const ScratchFolder folder;
  History             history(folder.path, "h", {{"lift/drag", ""}, {"γ̇", "rad/s"}, {"γ̇", "rad/s"}});
  history.finish();

  std::string unit;
  EXPECT_TRUE(read_dataset(folder.path + "/h.h5", "lift/drag", unit).empty());
  EXPECT_TRUE(read_dataset(folder.path + "/h.h5", "γ̇", unit).empty());
  EXPECT_EQ(unit, "rad/s");
}



TEST(History, RowOfTheWrongLengthAndRowAfterTheEnd)
{
  const ScratchFolder folder;
  History             history(folder.path, "dynamic", history_columns);
  EXPECT_ANY_THROW(history.add({1, 2}));
  history.finish();
  history.finish();
  EXPECT_ANY_THROW(history.add(rows[0]));
}



TEST(History, FolderThatCannotBeMadeIsNamed)
{
  const ScratchFolder folder;
  const std::string   file = folder.path + "/file";
  std::ofstream(file) << "in the way";

  const std::string complaint = complaint_of([&] { History(file + "/results", "dynamic", history_columns); });
  EXPECT_NE(complaint.find("cannot write " + file + "/results"), std::string::npos) << complaint;
}



TEST(History, FullDiskIsNamed)
{
  if (!std::filesystem::exists("/dev/full"))
    GTEST_SKIP() << "no /dev/full here";
  const ScratchFolder folder;
  make_full(folder.path + "/dynamic.csv");

  const std::string complaint = complaint_of([&] { History(folder.path, "dynamic", history_columns); });
  EXPECT_EQ(complaint, "cannot write " + folder.path + "/dynamic.csv: No space left on device.");
}



TEST(History, Hdf5ThatCannotBeWrittenIsNamedAndTheDestructorDoesNotThrow)
{
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.path + "/dynamic.h5");

  const auto        history   = std::make_unique<History>(folder.path, "dynamic", history_columns);
  const std::string complaint = complaint_of([&] { history->finish(); });
  EXPECT_NE(complaint.find(folder.path + "/dynamic.h5"), std::string::npos) << complaint;

  testing::internal::CaptureStderr();
  {
    History other(folder.path, "dynamic", history_columns);
  }
  EXPECT_NE(testing::internal::GetCapturedStderr().find(folder.path + "/dynamic.h5"), std::string::npos);
}



TEST(History, DiskThatFillsIsNamedAndWholeRowsStay)
{
  const ScratchFolder folder;
  const std::string   file    = folder.path + "/h.csv";
  const auto          history = std::make_unique<History>(folder.path, "h", columns_of_two);
  std::string         complaint;
  {
    const FileSizeLimit limit(100000);
    complaint = complaint_of([&] {
      for (unsigned int i = 0;; ++i)
        history->add({0.5 * i, 1. / 3});
    });
  }
  EXPECT_EQ(complaint, "cannot write " + file + ": File too large.");
  EXPECT_EQ(content_of(file).substr(0, 32), "t [s],u [m]\n0,0.333333333333333\n");
  EXPECT_ANY_THROW(history->add({0, 0}));
  EXPECT_FALSE(std::filesystem::exists(folder.path + "/h.h5"));
}



TEST(History, DiskThatFillsWhileHdf5IsWritten)
{
  const ScratchFolder folder;
  for (const unsigned int limit : {50000, 100000, 160000})
    {
      History history(folder.path, "h", columns_of_two);
      for (unsigned int i = 0; i < 10000; ++i)
        history.add({0, 0}); // 4 bytes in the CSV file, 16 in the HDF5 file
      const FileSizeLimit full(limit);
      EXPECT_EQ(complaint_of([&] { history.finish(); }), "cannot write " + folder.path + "/h.h5: File too large.");
      EXPECT_FALSE(std::filesystem::exists(folder.path + "/h.h5"));
      EXPECT_FALSE(std::filesystem::exists(folder.path + "/h.h5.part"));
    }
}



TEST(History, CsvThatIsTakenAwayIsNamed)
{
  const ScratchFolder folder;
  History             history(folder.path, "h", columns_of_two);
  history.add({0, 0});
  history.flush();
  std::ofstream(folder.path + "/h.csv") << "t [s],u [m]\n";
  const std::string complaint = complaint_of([&] { history.finish(); });
  EXPECT_EQ(complaint,
            "cannot write " + folder.path + "/h.h5: " + folder.path + "/h.csv was changed while the analysis ran.");
}



TEST(History, Hdf5OfAnEarlierRunIsGone)
{
  const ScratchFolder folder;
  History(folder.path, "h", columns_of_two);
  EXPECT_TRUE(std::filesystem::exists(folder.path + "/h.h5"));
  const History history(folder.path, "h", columns_of_two);
  EXPECT_FALSE(std::filesystem::exists(folder.path + "/h.h5"));
}



TEST(Table, FileHasTwelveDigits)
{
  const ScratchFolder folder;
  Table               table({"mode", "frequency [Hz]", "shape"});
  table.add_row({1, 1. / 3, "flap, first"});
  table.add_row({2u, 1e7 / 3, std::string("lag")});
  table.write(folder.path + "/modes.csv");
  EXPECT_EQ(content_of(folder.path + "/modes.csv"),
            "mode,frequency [Hz],shape\n1,0.333333333333,\"flap, first\"\n2,3333333.33333,lag\n");
  EXPECT_FALSE(std::filesystem::exists(folder.path + "/modes.csv.part"));
}



TEST(Table, TerminalHasAlignedColumns)
{
  Table table({"mode", "ω [rad/s]", "shape"});
  table.add_row({1, 1. / 3, "flap"});
  table.add_row({10, 1e7 / 3, "λ"});

  std::ostringstream out;
  table.print(out);
  EXPECT_EQ(out.str(),
            "mode    ω [rad/s]  shape\n"
            "   1     0.333333  flap\n"
            "  10  3.33333e+06  λ\n");
}



TEST(Table, RowsOfTextsAndOfNumbers)
{
  const ScratchFolder folder;
  Table               table({"a", "b"});
  table.add_row({"x", "y"});
  table.add_row({0, 1});
  table.add_row(std::vector<std::string>{"u", "v"});
  table.add_row(std::vector<double>{0.5, -2});
  EXPECT_ANY_THROW(table.add_row({1, 2, 3}));
  table.write(folder.path + "/t.csv");
  EXPECT_EQ(content_of(folder.path + "/t.csv"), "a,b\nx,y\n0,1\nu,v\n0.5,-2\n");
}



TEST(Table, FileThatCannotBeWrittenIsNamedAndTheOldOneStays)
{
  if (!std::filesystem::exists("/dev/full"))
    GTEST_SKIP() << "no /dev/full here";
  const ScratchFolder folder;
  const std::string   file = folder.path + "/t.csv";
  Table               table({"a"});
  table.write(file);
  make_full(file + ".part");

  const std::string complaint = complaint_of([&] { table.write(file); });
  EXPECT_EQ(complaint, "cannot write " + file + ": No space left on device.");
  EXPECT_EQ(content_of(file), "a\n");
}
