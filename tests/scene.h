#ifndef samara_tests_scene_h
#define samara_tests_scene_h

#include <samara/analysis/check.h>
#include <samara/analysis/modal.h>
#include <samara/analysis/static.h>
#include <samara/input/input.h>

#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <sstream>

namespace samara
{
  /** A model read from the text of a .prm file, or from a shipped file, ready to be analysed without any output. */
  class Scene
  {
    struct TemporaryFile
    {
      std::string name;

      explicit TemporaryFile(const std::string &text)
        : name("scene_" + std::to_string(getpid()) + "_" + std::to_string(counter()++) + ".prm")
      {
        std::ofstream(name) << text;
      }
      ~TemporaryFile()
      {
        std::remove(name.c_str());
      }
      static unsigned int &
      counter()
      {
        static unsigned int n = 0;
        return n;
      }
    };
    std::unique_ptr<TemporaryFile> file;

    /** With the settings of the input in use, as in a run. */
    static Model &
    model_of(Input &input)
    {
      input.use_settings();
      return input.model;
    }

  public:
    /** @p source is the text of an input file, or the name of one that is shipped, "prm/benchmarks/roll_up.prm". */
    explicit Scene(const std::string &source, const std::vector<std::string> &overrides = {})
      : file(source.find('\n') == std::string::npos ? nullptr : new TemporaryFile(source))
      , input(Catalogue(), file ? file->name : std::string(SAMARA_SOURCE_DIR) + "/" + source, overrides)
      , system(model_of(input))
      , log(stream)
      , context{system, log, "", {}, false, without_redundant(), {}, {}}
    {
      for (const auto &rotation : input.model.rotations)
        context.speeds.push_back(rotation.speed);
    }

    Input              input;
    System             system;
    std::ostringstream stream; ///< what the analyses tell
    Log                log;
    Context            context;

    /** The reference state, with redundant constraints left out as in a run. */
    State
    without_redundant()
    {
      ModelCheck check;
      find_redundant(system, check);
      system.drop(check.redundant_multipliers);
      return system.reference();
    }

    /** The first analysis of a kind as the file sets it; one with default settings if the file asks for none. */
    template <typename Kind>
    Kind &
    analysis()
    {
      for (const auto &a : input.analyses)
        if (auto *const wanted = dynamic_cast<Kind *>(a.get()))
          return *wanted;
      const auto known = Catalogue().analyses;
      for (const auto &kind : known.kinds())
        if (auto made = known.make(kind); dynamic_cast<Kind *>(made.get()) != nullptr)
          {
            input.analyses.push_back(std::move(made));
            return static_cast<Kind &>(*input.analyses.back());
          }
      throw std::logic_error("the catalogue has no such analysis");
    }

    /** Static equilibrium from the present state; throws NotConverged. */
    const State &
    equilibrium()
    {
      auto &a = analysis<StaticAnalysis>();
      a.start(context);
      a.run(context);
      return context.state;
    }

    /** Modes about the present state, sorted by |λ|. */
    const std::vector<Mode> &
    modes()
    {
      auto &a = analysis<ModalAnalysis>();
      a.run(context);
      return a.modes;
    }

    /** The value of a probe such as "beam.end.displacement y" in the present state. */
    double
    value(const std::string &probe) const
    {
      return input.model.probe(probe).value(context.state);
    }
  };



  /** What is said of a faulty model; "" if it is right. */
  inline std::string
  complaint_of(const std::string &model)
  {
    try
      {
        Scene scene(model);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace samara

#endif
