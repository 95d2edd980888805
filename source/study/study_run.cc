#include <samara/base/interrupt.h>
#include <samara/base/text.h>
#include <samara/output/file.h>
#include <samara/study/study.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <thread>

namespace samara
{
  namespace
  {
    const char *const time_limit_text = "time limit of ";

    /** The first line of what a member complained about; the lines behind it are advice. */
    std::string
    complaint_in(const std::string &file)
    {
      std::ifstream in(file);
      std::string   line;
      while (std::getline(in, line))
        if (line.find_first_not_of(" -*=\t\r") != std::string::npos)
          {
            line = trim(line);
            // not within a letter of several bytes
            std::size_t end = 160;
            while (end < line.size() && (line[end] & 0xC0) == 0x80)
              ++end;
            return line.size() > end ? line.substr(0, end) + " ..." : line;
          }
      return "";
    }



    std::string
    reason_of(const Process &process, const std::string &folder)
    {
      if (process.signal() != 0)
        return "killed by signal " + std::to_string(process.signal()) + " (" + strsignal(process.signal()) + ")";
      const std::string said = complaint_in(folder + "/errors.txt");
      return said.empty() ? "exit code " + std::to_string(process.exit_code()) : said;
    }



    /**
     * What says that a member needs no further run: its fingerprint, the processor's time, and why it fails, a line
     * each.
     */
    void
    write_record(const StudyMember &member)
    {
      replace_file(member.folder + "/member.txt",
                   member.fingerprint + '\n' + number_to_text(member.result.cpu_seconds) + '\n' + member.result.reason +
                     '\n');
    }



    /** Whether there is such a record for this member as it is now; the result is read then. */
    bool
    read_record(StudyMember &member, const double time_limit)
    {
      std::ifstream in(member.folder + "/member.txt");
      std::string   fingerprint, seconds, reason;
      if (!std::getline(in, fingerprint) || !std::getline(in, seconds) || !std::getline(in, reason) ||
          fingerprint != member.fingerprint)
        return false;
      const std::size_t n = std::strlen(time_limit_text);
      if (reason.compare(0, n, time_limit_text) == 0 &&
          (time_limit == 0 || time_limit > std::strtod(reason.c_str() + n, nullptr)))
        return false;
      if (reason.empty() && !std::filesystem::is_regular_file(member.folder + "/summary.csv"))
        return false;
      member.result.finished = reason.empty();
      member.result.reason   = reason;
      text_to_number(seconds, member.result.cpu_seconds);
      return true;
    }



    Options
    options_of(const StudyMember &member)
    {
      Options options;
      options.model  = member.model;
      options.output = member.folder;
      // times of members are compared, and members run side by side
      options.overrides = {"Threads = 1"};
      for (const auto &override : member.override_texts())
        options.overrides.push_back(override);
      return options;
    }



    /** The command for people who want to repeat it. */
    std::string
    command_text(const StudyMember &member)
    {
      std::string text = "samara '" + member.model + "' --set 'Threads = 1'";
      for (const auto &override : member.override_texts())
        text += " --set '" + override + '\'';
      return text + '\n';
    }



    /** Members that run side by side, each in a process of its own. */
    class Crew
    {
    public:
      Crew(const Study &study, const Program &program, Log &log, const unsigned int n_done)
        : study(study)
        , program(program)
        , log(log)
        , n_done(n_done)
      {}

      std::size_t
      size() const
      {
        return running.size();
      }

      void start(StudyMember &member);
      /** Finish those that have ended, and end those that have run for too long. */
      void look();
      /** Ask all to end. @throws Interrupted */
      [[noreturn]] void stop() const;

    private:
      struct Running
      {
        StudyMember             *member;
        std::unique_ptr<Process> process;
      };
      const Study         &study;
      const Program       &program;
      Log                 &log;
      unsigned int         n_done;
      std::vector<Running> running;

      void finish(const Running &run);
    };



    void
    Crew::start(StudyMember &member)
    {
      // nothing may be left of an earlier run: what is read must be this one's
      std::filesystem::remove_all(member.folder);
      make_folder(member.folder);
      replace_file(member.folder + "/command.txt", command_text(member));
      running.push_back({&member,
                         std::make_unique<Process>([&]() { return program(options_of(member)); },
                                                   member.folder + "/log.txt",
                                                   member.folder + "/errors.txt")});
    }



    void
    Crew::finish(const Running &run)
    {
      StudyMember &member       = *run.member;
      member.result.cpu_seconds = run.process->cpu_seconds();
      member.result.finished    = run.process->exit_code() == 0;
      if (!member.result.finished && member.result.reason.empty())
        member.result.reason = reason_of(*run.process, member.folder);
      if (member.result.finished)
        member.result.reason.clear();
      write_record(member);
      const auto &methods = study.methods;
      log.line("  " + std::to_string(++n_done) + "/" + std::to_string(study.members.size()) + "  " +
               (member.method < methods.size() ? methods[member.method]->name + ", " : std::string()) +
               (member.label.empty() ? "one run" : member.label) + ": " +
               (member.result.finished ? number_to_field(run.process->seconds(), 3) + " s" :
                                         "fails: " + member.result.reason));
    }



    void
    Crew::look()
    {
      for (auto run = running.begin(); run != running.end();)
        if (run->process->has_ended())
          {
            finish(*run);
            run = running.erase(run);
          }
        else
          {
            if (study.time_limit > 0 && run->process->seconds() > study.time_limit &&
                run->member->result.reason.empty())
              {
                run->member->result.reason = time_limit_text + number_to_text(study.time_limit) + " s";
                run->process->send(SIGKILL);
              }
            ++run;
          }
    }



    void
    Crew::stop() const
    {
      std::vector<Process *> processes;
      for (const auto &run : running)
        processes.push_back(run.process.get());
      end_all(processes);
      throw Interrupted("interrupted: " + std::to_string(n_done) + " of " + std::to_string(study.members.size()) +
                        " members are done; the same command goes on with the others");
    }
  } // namespace



  void
  Study::run(const std::string &folder, const unsigned int n_jobs, const Program &program, Log &log)
  {
    for (auto &member : members)
      member.folder = folder + "/" + member.folder;
    make_folder(folder);
    run_members(n_jobs, program, log);
    evaluate();
    report(folder, log);

    unsigned int n_failing = 0;
    for (const auto &member : members)
      n_failing += !member.result.finished;
    if (reference_member >= 0 && !members[reference_member].result.finished)
      throw NotConverged("the run that the others are compared with fails: " + members[reference_member].result.reason);
    if (n_failing == members.size())
      throw NotConverged((n_failing == 1 ? "the only member fails: " :
                                           "all " + std::to_string(n_failing) + " members fail; the first one: ") +
                         members[0].result.reason);
    if (n_failing > 0)
      log.warning("",
                  std::to_string(n_failing) + " of " + std::to_string(members.size()) +
                    (n_failing == 1 ? " members fails" : " members fail"));
    log.line("results are in " + folder);
  }



  void
  Study::run_members(const unsigned int n_jobs, const Program &program, Log &log)
  {
    std::vector<StudyMember *> waiting;
    for (auto &member : members)
      if (!read_record(member, time_limit))
        waiting.push_back(&member);
    const std::size_t n_kept = members.size() - waiting.size();
    log.line((title.empty() ? file : title) + ": " + std::to_string(members.size()) + " members" +
             (n_kept > 0 ? ", " + std::to_string(n_kept) + " kept from before" : ""));
    std::reverse(waiting.begin(), waiting.end());

    InterruptGuard interrupt;
    Crew           crew(*this, program, log, n_kept);
    while (!waiting.empty() || crew.size() > 0)
      {
        for (; !waiting.empty() && crew.size() < std::max(1u, n_jobs); waiting.pop_back())
          crew.start(*waiting.back());
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        if (interrupt.was_interrupted())
          crew.stop();
        crew.look();
      }
  }


  void
  Study::evaluate()
  {
    std::vector<Series> series(members.size());
    for (unsigned int i = 0; i < members.size(); ++i)
      {
        StudyResult &result = members[i].result;
        if (!result.finished)
          continue;
        try
          {
            const auto number = [&](const std::string &name) {
              return read_series(members[i].folder + "/summary.csv", name).y[0];
            };
            result.unknowns       = number("unknowns");
            result.seconds        = number("processor time");
            result.steps          = number("steps");
            result.iterations     = number("iterations");
            result.factorizations = number("factorizations");
            series[i]             = quantity.read(members[i].folder);
            result.value          = norm_of(series[i], norm);
            if (!std::isfinite(result.value))
              throw std::runtime_error("the quantity is not a number");
          }
        catch (const std::runtime_error &problem)
          {
            result.finished = false;
            result.reason   = problem.what();
          }
      }
    compare(series);
  }



  void
  Study::compare(const std::vector<Series> &series)
  {
    double number = 0;
    Series exact;
    bool   is_series = true;
    if (reference_member >= 0)
      {
        if (!members[reference_member].result.finished)
          return;
        exact = series[reference_member];
      }
    else if (!reference_file.empty())
      exact = read_series(reference_file, reference_column);
    else
      {
        is_series = false;
        text_to_number(reference, number);
      }
    const double scale = is_series ? std::abs(norm_of(exact, norm)) : std::abs(number);
    if (error_kind == "relative" && !(scale > 0))
      throw InputError(settings.where("Error") +
                       ": the reference is zero, and no error relative to it; set Error = absolute");

    const StudyMember *previous = nullptr;
    for (unsigned int i = 0; i < members.size(); ++i)
      {
        StudyResult &result = members[i].result;
        if (!result.finished || static_cast<int>(i) == reference_member)
          continue;
        try
          {
            result.error = is_series ? distance(series[i], exact, norm) : std::abs(result.value - number);
            if (error_kind == "relative")
              result.error /= scale;
          }
        catch (const std::runtime_error &problem)
          {
            result.finished = false;
            result.reason   = problem.what();
            continue;
          }
        if (previous != nullptr && previous->method == members[i].method)
          result.rate = std::log(previous->result.error / result.error) /
                        std::abs(std::log(members[i].refinement() / previous->refinement()));
        previous = &members[i];
      }
  }
} // namespace samara
