/*
 * Problem:   histories and series of pictures of a run that was killed and continued
 * Reference: the files of a run that was not
 */

#include <samara/base/errors.h>
#include <samara/output/history.h>
#include <samara/output/pictures.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "scratch_folder.h"

using namespace samara;

namespace
{
  const std::vector<std::pair<std::string, std::string>> resumed_columns = {{"t", "s"}, {"line\nbreak, comma", "m"}};

  constexpr double end = std::numeric_limits<double>::infinity();



  /** Times with more digits than the files have; rounding to 15 digits goes up for some and down for others. */
  double
  time_of(const unsigned int row)
  {
    return row / 7.;
  }



  void
  add_rows(History &history, const unsigned int begin, const unsigned int end)
  {
    for (unsigned int i = begin; i < end; ++i)
      history.add({time_of(i), std::sin(i)});
  }



  Drawing
  box_at(const double x)
  {
    Sample sample;
    sample.x = {x, 0, 0};
    Drawing drawing;
    drawing.begin_object("box");
    drawing.box(sample, {1, 1, 1});
    return drawing;
  }



  void
  add_pictures(Pictures &pictures, const unsigned int begin, const unsigned int end)
  {
    for (unsigned int i = begin; i < end; ++i)
      pictures.add(box_at(i), time_of(i));
    pictures.finish();
  }
} // namespace



TEST(Resume, HistoryIsThatOfAnUninterruptedRun)
{
  const ScratchFolder folder;
  {
    History whole(folder.path, "whole", resumed_columns);
    add_rows(whole, 0, 10000);
  }
  for (const unsigned int checkpoint : {0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u, 4096u, 8999u})
    {
      {
        History killed(folder.path, "killed", resumed_columns);
        add_rows(killed, 0, 9000);
      }
      std::ofstream(folder.path + "/killed.csv", std::ios::app) << "1285.7142857";
      {
        History resumed(folder.path, "killed", resumed_columns, time_of(checkpoint));
        EXPECT_FALSE(std::filesystem::exists(folder.path + "/killed.h5"));
        add_rows(resumed, checkpoint + 1, 10000);
      }
      EXPECT_TRUE(content_of(folder.path + "/killed.csv") == content_of(folder.path + "/whole.csv")) << checkpoint;
      EXPECT_TRUE(content_of(folder.path + "/killed.h5") == content_of(folder.path + "/whole.h5")) << checkpoint;
    }
}



TEST(Resume, HistoryCutAtAnyByte)
{
  const ScratchFolder folder;
  const std::string   file = folder.path + "/h.csv";
  {
    History history(folder.path, "h", resumed_columns);
    add_rows(history, 0, 4);
  }
  const std::string whole  = content_of(file);
  const std::size_t header = whole.find("0,0\n");
  for (std::size_t size = 0; size <= whole.size(); ++size)
    {
      std::ofstream(file) << whole.substr(0, size);
      History(folder.path, "h", resumed_columns, end);
      const std::size_t last_end = std::max(whole.substr(0, size).rfind('\n') + 1, header);
      EXPECT_EQ(content_of(file), whole.substr(0, size < header ? header : last_end)) << size;
    }
}



TEST(Resume, HistoryOfAKilledProcess)
{
  const ScratchFolder folder;
  const std::string   file = folder.path + "/h.csv";
  do_and_kill(
    [&] {
      History history(folder.path, "h", resumed_columns);
      add_rows(history, 0, std::numeric_limits<unsigned int>::max());
    },
    std::chrono::milliseconds(300));
  EXPECT_FALSE(std::filesystem::exists(folder.path + "/h.h5"));
  {
    History resumed(folder.path, "h", resumed_columns, time_of(99));
    add_rows(resumed, 100, 200);
  }
  {
    History whole(folder.path, "whole", resumed_columns);
    add_rows(whole, 0, 200);
  }
  EXPECT_EQ(content_of(file), content_of(folder.path + "/whole.csv"));
}



TEST(Resume, HistoryWithoutFileBeginsAfresh)
{
  const ScratchFolder folder;
  {
    History history(folder.path + "/new", "h", resumed_columns, 1.);
    add_rows(history, 8, 9);
  }
  EXPECT_EQ(content_of(folder.path + "/new/h.csv"),
            "t [s],\"line\nbreak, comma [m]\"\n1.14285714285714,0.989358246623382\n");
}



TEST(Resume, HistoryWithOtherColumnsIsRefusedAndStays)
{
  const ScratchFolder folder;
  const std::string   file    = folder.path + "/h.csv";
  const std::string   content = "t [s],v [m/s]\n0,1\n";
  std::ofstream(file) << content;
  std::ofstream(folder.path + "/h.h5") << "its twin";

  EXPECT_THROW(History(folder.path, "h", resumed_columns, 1.), InputError);
  EXPECT_EQ(complaint_of([&] { History(folder.path, "h", resumed_columns, 1.); }),
            file + " has other columns, so that the run cannot be continued in it. Were the probes changed? Remove the "
                   "file, or start without --restart.");
  EXPECT_EQ(content_of(file), content);
  EXPECT_EQ(content_of(folder.path + "/h.h5"), "its twin");
}



TEST(Resume, HistoryWithRowsThatAreNotNumbersIsRefusedAndStays)
{
  const ScratchFolder folder;
  const std::string   file = folder.path + "/h.csv";
  for (const std::string row : {"1;2", "1,2,3", "1", "", "1,", "1,x", "1,2 ", "1,2\r"})
    {
      const std::string content = "t [s],u [m]\n0,0\n" + row + "\n2,2\n";
      std::ofstream(file) << content;
      EXPECT_THROW(History(folder.path, "h", {{"t", "s"}, {"u", "m"}}, 5.), InputError) << row;
      const std::string complaint = complaint_of([&] { History(folder.path, "h", {{"t", "s"}, {"u", "m"}}, 5.); });
      EXPECT_TRUE(contains(complaint, file + ": row 2 is not 2 numbers")) << complaint;
      EXPECT_EQ(content_of(file), content);
    }
}



TEST(Resume, PicturesAreThoseOfAnUninterruptedRun)
{
  const ScratchFolder folder;
  Pictures            whole(folder.path + "/whole", "dynamic");
  add_pictures(whole, 0, 12);
  for (unsigned int checkpoint = 0; checkpoint < 9; ++checkpoint)
    {
      Pictures killed(folder.path + "/killed", "dynamic");
      add_pictures(killed, 0, 9);
      Pictures resumed(folder.path + "/killed", "dynamic", time_of(checkpoint));
      add_pictures(resumed, checkpoint + 1, 12);

      for (const auto &entry : std::filesystem::recursive_directory_iterator(folder.path + "/whole"))
        if (entry.is_regular_file())
          {
            const std::string file = std::filesystem::relative(entry.path(), folder.path + "/whole");
            EXPECT_TRUE(content_of(folder.path + "/killed/" + file) == content_of(entry.path())) << file;
          }
    }
}



TEST(Resume, PicturesThatAreTooLateAreNotInTheSeries)
{
  const ScratchFolder folder;
  {
    Pictures pictures(folder.path, "dynamic");
    add_pictures(pictures, 0, 5);
  }
  const Pictures    resumed(folder.path, "dynamic", time_of(2));
  const std::string series = content_of(folder.path + "/dynamic.pvd");
  EXPECT_TRUE(contains(series, "dynamic.0002.vtu"));
  EXPECT_FALSE(contains(series, "dynamic.0003.vtu"));
}



TEST(Resume, PicturesWithoutSeriesBeginAfresh)
{
  const ScratchFolder folder;
  Pictures            pictures(folder.path, "dynamic", 3.);
  EXPECT_FALSE(std::filesystem::exists(folder.path + "/dynamic.pvd"));
  pictures.add(box_at(0), 4);
  pictures.finish();
  EXPECT_TRUE(std::filesystem::exists(folder.path + "/pictures/dynamic.0000.vtu"));
}



TEST(Resume, PicturesOfOthersAreRefusedAndStay)
{
  const ScratchFolder folder;
  const std::string   file = folder.path + "/dynamic.pvd";
  for (const std::string line : {"nothing",
                                 "<DataSet timestep=\"0\" file=\"other.vtu\"/>",
                                 "<DataSet timestep=\"x\" file=\"pictures/dynamic.0000.vtu\"/>",
                                 "<DataSet timestep=\"0\" file=\"pictures/dynamic.0001.vtu\"/>",
                                 "<DataSet file=\"pictures/dynamic.0000.vtu\"/>"})
    {
      std::ofstream(file) << line;
      EXPECT_THROW(Pictures(folder.path, "dynamic", 1.), InputError) << line;
      EXPECT_TRUE(contains(complaint_of([&] { Pictures(folder.path, "dynamic", 1.); }), file));
      EXPECT_EQ(content_of(file), line);
    }
}
