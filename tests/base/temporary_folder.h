#ifndef samara_tests_base_temporary_folder_h
#define samara_tests_base_temporary_folder_h

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace samara
{
  /** A folder for the files of one test, which goes away with it. */
  class TemporaryFolder
  {
  public:
    TemporaryFolder()
    {
      const auto *const test = ::testing::UnitTest::GetInstance()->current_test_info();
      folder                 = std::filesystem::temp_directory_path() /
               ("samara_" + std::string(test->name()) + "_" + std::to_string(::getpid()));
      std::filesystem::create_directories(folder);
    }

    ~TemporaryFolder()
    {
      std::error_code ignored;
      std::filesystem::remove_all(folder, ignored);
    }

    TemporaryFolder(const TemporaryFolder &)            = delete;
    TemporaryFolder &operator=(const TemporaryFolder &) = delete;

    /** Write a file and return its full name. */
    std::string
    write(const std::string &name, const std::string &text) const
    {
      std::filesystem::create_directories((folder / name).parent_path());
      std::ofstream(folder / name) << text;
      return path(name);
    }

    std::string
    path(const std::string &name) const
    {
      return (folder / name).string();
    }

  private:
    std::filesystem::path folder;
  };
} // namespace samara

#endif
