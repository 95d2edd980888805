#ifndef samara_tests_output_scratch_folder_h
#define samara_tests_output_scratch_folder_h

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

/** An empty folder for one test, gone afterwards. */
class ScratchFolder
{
public:
  ScratchFolder()
    : path(testing::TempDir() + "samara_" + testing::UnitTest::GetInstance()->current_test_info()->name() + "_" +
           std::to_string(getpid()))
  {
    std::filesystem::create_directories(path);
  }

  ~ScratchFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }

  const std::string path;
};



inline std::string
content_of(const std::string &file)
{
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}



/** What @p action says when it throws a std::runtime_error. */
template <typename Action>
std::string
complaint_of(const Action &action)
{
  try
    {
      action();
    }
  catch (const std::runtime_error &error)
    {
      return error.what();
    }
  return "no complaint";
}

#endif
