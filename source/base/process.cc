#include <samara/base/interrupt.h>
#include <samara/base/process.h>

#include <sys/resource.h>
#include <sys/wait.h>
#ifdef __linux__
#  include <sys/prctl.h>
#endif
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <stdexcept>
#include <thread>

namespace samara
{
  namespace
  {
    /** In the new process. No destructor of the old one's objects runs here. */
    [[noreturn]] void
    begin(const std::function<int()> &work, const char *const output, const char *const errors)
    {
      setpgid(0, 0);
#ifdef __linux__
      prctl(PR_SET_PDEATHSIG, SIGTERM);
#endif
      forget_interrupts();
      const int in  = open("/dev/null", O_RDONLY);
      const int out = open(output, O_WRONLY | O_CREAT | O_TRUNC, 0644);
      const int err = open(errors, O_WRONLY | O_CREAT | O_TRUNC, 0644);
      if (in < 0 || out < 0 || err < 0 || dup2(in, 0) < 0 || dup2(out, 1) < 0 || dup2(err, 2) < 0)
        _exit(126);
      int code = 127;
      try
        {
          code = work();
        }
      catch (...)
        {
          std::cerr << "the work of another process threw an exception\n";
        }
      std::cout.flush();
      std::cerr.flush();
      std::fflush(nullptr);
      _exit(code);
    }
  } // namespace



  Process::Process(const std::function<int()> &work, const std::string &output, const std::string &errors)
    : start(std::chrono::steady_clock::now())
  {
    // what is not yet written would be written twice
    std::cout.flush();
    std::cerr.flush();
    std::fflush(nullptr);
    pid = fork();
    if (pid < 0)
      throw std::runtime_error(std::string("cannot start another process: ") + std::strerror(errno));
    if (pid == 0)
      begin(work, output.c_str(), errors.c_str());
    setpgid(pid, pid); // it does the same; whoever comes first
  }



  Process::~Process()
  {
    if (ended)
      return;
    kill(-pid, SIGKILL);
    waitpid(pid, nullptr, 0);
  }



  bool
  Process::has_ended()
  {
    if (ended)
      return true;
    rusage      usage  = {};
    const pid_t result = wait4(pid, &status, WNOHANG, &usage);
    if (result == 0 || (result < 0 && errno == EINTR))
      return false;
    ended                 = true;
    const auto seconds_of = [](const timeval &t) { return t.tv_sec + 1e-6 * t.tv_usec; };
    cpu                   = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
    return true;
  }



  void
  Process::send(const int signal) const
  {
    if (!ended)
      kill(-pid, signal);
  }



  double
  Process::seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }



  int
  Process::exit_code() const
  {
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }



  int
  Process::signal() const
  {
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  }



  double
  Process::cpu_seconds() const
  {
    return cpu;
  }



  void
  end_all(const std::vector<Process *> &processes)
  {
    constexpr std::chrono::seconds longest_patience(5);
    for (const auto *process : processes)
      process->send(SIGTERM);
    const auto asked_at = std::chrono::steady_clock::now();
    for (auto *process : processes)
      while (!process->has_ended() && std::chrono::steady_clock::now() - asked_at < longest_patience)
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
} // namespace samara
