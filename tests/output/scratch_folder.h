#ifndef samara_tests_output_scratch_folder_h
#define samara_tests_output_scratch_folder_h

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <thread>

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
template <typename Action, typename = std::enable_if_t<std::is_invocable_v<const Action &>>>
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



inline bool
contains(const std::string &text, const std::string &piece)
{
  return text.find(piece) != std::string::npos;
}



/** A file that is always full, under a name of ours. */
inline void
make_full(const std::string &file)
{
  std::filesystem::create_symlink("/dev/full", file);
}



/** While it lives, files cannot grow beyond this size: like a disk that fills. */
class FileSizeLimit
{
public:
  explicit FileSizeLimit(const rlim_t bytes)
    : handler(std::signal(SIGXFSZ, SIG_IGN))
  {
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit limit = {bytes, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }

  ~FileSizeLimit()
  {
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
  }

private:
  void (*handler)(int);
  rlimit before;
};



/** Do this in a process of its own, which is killed after a while without warning. */
template <typename Action>
void
do_and_kill(const Action &action, const std::chrono::milliseconds after)
{
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0)
    {
      action();
      _exit(0);
    }
  std::this_thread::sleep_for(after);
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status)) << "it ended before it was killed";
}

#endif
