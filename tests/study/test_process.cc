// Programs that run beside this one: how they end is told, and none is left behind.

#include <samara/base/process.h>

#include "../output/scratch_folder.h"

using namespace samara;

namespace
{
  struct Shell
  {
    ScratchFolder folder;
    Process       process;

    explicit Shell(const std::string &command)
      : process({"/bin/sh", "-c", command}, folder.path + "/out", folder.path + "/err")
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



TEST(Process, MissingProgram)
{
  const ScratchFolder folder;
  Process             process({"/no/such/program"}, folder.path + "/out", folder.path + "/err");
  while (!process.has_ended())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(process.exit_code(), 127);
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
    Process process({"/bin/sh", "-c", "echo $$ > " + folder.path + "/pid; sleep 60"},
                    folder.path + "/out",
                    folder.path + "/err");
    while (content_of(folder.path + "/pid").empty())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    pid = std::stoi(content_of(folder.path + "/pid"));
    EXPECT_EQ(kill(pid, 0), 0);
  }
  EXPECT_EQ(kill(pid, 0), -1);
}
