// Processes beside this one: how they end is told, and none is left behind.

#include <samara/base/process.h>

#include "../output/scratch_folder.h"

#include <unistd.h>

using namespace samara;

namespace
{
  /** A shell in place of this program. */
  int
  shell(const std::string &command)
  {
    return execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
  }

  struct Shell
  {
    ScratchFolder folder;
    Process       process;

    explicit Shell(const std::string &command)
      : process([&]() { return shell(command); }, folder.path + "/out", folder.path + "/err")
    {}

    void
    wait()
    {
      while (!process.has_ended())
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  };
} // namespace



TEST(Process, OutputAndExitCode)
{
  Shell shell("echo 'one two'; echo three >&2; exit 3");
  shell.wait();
  EXPECT_EQ(shell.process.exit_code(), 3);
  EXPECT_EQ(shell.process.signal(), 0);
  EXPECT_EQ(content_of(shell.folder.path + "/out"), "one two\n");
  EXPECT_EQ(content_of(shell.folder.path + "/err"), "three\n");
}



TEST(Process, Signals)
{
  Shell crashes("kill -SEGV $$");
  crashes.wait();
  EXPECT_EQ(crashes.process.signal(), SIGSEGV);
  EXPECT_EQ(crashes.process.exit_code(), -1);

  // what it has started ends with it
  Shell sleeps("sleep 60 & echo $! > " + crashes.folder.path + "/pid; wait");
  while (content_of(crashes.folder.path + "/pid").empty())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_FALSE(sleeps.process.has_ended());
  sleeps.process.send(SIGTERM);
  sleeps.wait();
  EXPECT_EQ(sleeps.process.signal(), SIGTERM);
}



// What is printed goes to its files, and what stood in a buffer before is not printed twice.
TEST(Process, WorkOfThisProgram)
{
  const ScratchFolder folder;
  std::cout << "before" << std::flush;
  std::cout << " ";
  const int seven = 7;
  Process   returns([&]() { return std::cout << "seven", seven; }, folder.path + "/out", folder.path + "/err");
  Process   throws([]() -> int { throw std::runtime_error("a mistake"); }, folder.path + "/out2", folder.path + "/err2");
  Process   cannot([]() { return 0; }, folder.path + "/none/out", folder.path + "/err3");
  for (auto *const process : {&returns, &throws, &cannot})
    while (!process->has_ended())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(returns.exit_code(), 7);
  EXPECT_EQ(content_of(folder.path + "/out"), "seven");
  EXPECT_EQ(throws.exit_code(), 127);
  EXPECT_FALSE(content_of(folder.path + "/err2").empty());
  EXPECT_EQ(cannot.exit_code(), 126);
}



TEST(Process, TimeOfTheProcessorIsNotTimeAsleep)
{
  Shell works("i=0; while [ $i -lt 20000 ]; do i=$((i+1)); done"), sleeps("sleep 0.3");
  works.wait();
  sleeps.wait();
  EXPECT_GT(works.process.cpu_seconds(), 0);
  EXPECT_LT(sleeps.process.cpu_seconds(), 0.2);
}



TEST(Process, DoesNotOutliveItsObject)
{
  const ScratchFolder folder;
  pid_t               pid = 0;
  {
    Process process([&]() { return shell("echo $$ > " + folder.path + "/pid; sleep 60"); },
                    folder.path + "/out",
                    folder.path + "/err");
    while (content_of(folder.path + "/pid").empty())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    pid = std::stoi(content_of(folder.path + "/pid"));
    EXPECT_EQ(kill(pid, 0), 0);
  }
  EXPECT_EQ(kill(pid, 0), -1);
}
