// Models with other values of constants, for trim by continuation.

#include <samara/analysis/check.h>
#include <samara/analysis/trim.h>
#include <samara/base/text.h>
#include <samara/study/trim_variants.h>

#include <sstream>

namespace samara
{
  namespace
  {
    class VariantOfFile : public TrimVariant
    {
    public:
      VariantOfFile(const std::string &file, const std::vector<std::string> &overrides)
        : input(Catalogue(), file, overrides)
        , system(input.assemble())
        , log(said, true)
        , whole{*system, log, "", {}, false, start(), {}, {}}
      {
        for (const auto &rotation : input.model.rotations)
          whole.speeds.push_back(rotation.speed);
      }

      Context &
      context() override
      {
        return whole;
      }

      TrimAnalysis &
      trim() override
      {
        for (const auto &analysis : input.analyses)
          if (auto *const found = dynamic_cast<TrimAnalysis *>(analysis.get()))
            return *found;
        throw std::logic_error("a variant of a model with trim has none");
      }

      void
      lead_up() override
      {
        for (const auto &analysis : input.analyses)
          {
            if (dynamic_cast<TrimAnalysis *>(analysis.get()) != nullptr)
              return;
            analysis->start(whole);
            analysis->run(whole);
          }
      }

    private:
      Input                   input;
      std::unique_ptr<System> system;
      std::ostringstream      said;
      Log                     log;
      Context                 whole;

      State
      start()
      {
        ModelCheck check;
        find_redundant(*system, check);
        system->drop(check.redundant_multipliers);
        return system->reference();
      }
    };
  } // namespace



  void
  let_trim_continue(const Input &input, const std::string &file, const std::vector<std::string> &overrides)
  {
    for (const auto &analysis : input.analyses)
      if (auto *const trim = dynamic_cast<TrimAnalysis *>(analysis.get()))
        trim->variant = [file, overrides](const std::vector<std::pair<std::string, double>> &parts) {
          InputFile text(file);
          for (const auto &override : overrides)
            text.outline.set(override, text.complaints);
          const Outline *const     constants = text.outline.section("Constants");
          std::vector<std::string> all       = overrides;
          all.push_back("Trim/Continue = ");
          for (const auto &[name, part] : parts)
            all.push_back("Constants/" + name + " = (" + (constants == nullptr ? "" : constants->value(name)) + ")*" +
                          number_to_text("%.17g", part));
          return std::make_unique<VariantOfFile>(file, all);
        };
  }
} // namespace samara
