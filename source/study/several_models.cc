#include <samara/base/errors.h>
#include <samara/base/interrupt.h>
#include <samara/base/process.h>
#include <samara/study/several_models.h>

#include <unistd.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <thread>

namespace samara
{
  namespace
  {
    /** One of the models, and two files of what it tells. */
    struct OneOfSeveral
    {
      Options                  options;
      std::string              told, complained;
      std::unique_ptr<Process> process;
    };



    /** The options of each model. */
    std::vector<OneOfSeveral>
    one_by_one(const Options &options)
    {
      const std::string scratch =
        (std::filesystem::temp_directory_path() / "samara_").string() + std::to_string(getpid());
      std::vector<OneOfSeveral>          result;
      std::map<std::string, std::string> model_of; // folder
      for (const auto &model : options.several)
        {
          OneOfSeveral one;
          one.options                  = options;
          one.options.several          = {};
          one.options.model            = model;
          const std::string stem       = std::filesystem::path(model).stem().string();
          const auto [other, is_first] = model_of.emplace(stem, model);
          if (!is_first)
            throw InputError("samara: the results of " + other->second + " and of " + model +
                             " would be in the same folder, " + stem + "; run them one after the other with --output");
          if (!options.output.empty())
            one.options.output = options.output + "/" + stem;
          one.told       = scratch + "_" + std::to_string(result.size()) + ".out";
          one.complained = scratch + "_" + std::to_string(result.size()) + ".err";
          result.push_back(std::move(one));
        }
      return result;
    }



    /** To the terminal, and away with it. */
    void
    pass_on(const std::string &file, std::ostream &out)
    {
      std::ifstream in(file);
      // an empty file would spoil the stream
      if (in.peek() != std::ifstream::traits_type::eof())
        out << in.rdbuf();
      out.flush();
      in.close();
      std::error_code ignored;
      std::filesystem::remove(file, ignored);
    }



    int
    finish(const OneOfSeveral &one)
    {
      std::cout << "== " << one.options.model << '\n';
      pass_on(one.told, std::cout);
      pass_on(one.complained, std::cerr);
      const int signal = one.process->signal();
      if (signal == 0)
        return one.process->exit_code();
      std::cerr << one.options.model << ": killed by signal " << signal << " (" << strsignal(signal) << ")\n";
      return internal_error;
    }



    /** All write what they have, and that is told. */
    void
    stop(const std::vector<OneOfSeveral *> &running)
    {
      std::vector<Process *> processes;
      for (const auto *one : running)
        processes.push_back(one->process.get());
      end_all(processes);
      for (const auto *one : running)
        {
          pass_on(one->told, std::cout);
          pass_on(one->complained, std::cerr);
        }
    }
  } // namespace



  int
  execute_all(const Options &options, const Program &program)
  {
    auto                        all = one_by_one(options);
    const InterruptGuard        interrupt;
    std::vector<OneOfSeveral *> running;
    std::size_t                 next = 0;
    int                         code = success;
    while (next < all.size() || !running.empty())
      {
        while (next < all.size() && running.size() < std::max(1u, options.jobs))
          {
            OneOfSeveral &one = all[next++];
            one.process = std::make_unique<Process>([&]() { return program(one.options); }, one.told, one.complained);
            running.push_back(&one);
          }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        if (interrupt.was_interrupted())
          {
            stop(running);
            throw Interrupted("interrupted: " + std::to_string(next - running.size()) + " of " +
                              std::to_string(all.size()) + " models are done");
          }
        for (auto one = running.begin(); one != running.end();)
          if ((*one)->process->has_ended())
            {
              code = std::max(code, finish(**one));
              one  = running.erase(one);
            }
          else
            ++one;
      }
    return code;
  }
} // namespace samara
