#include <samara/analysis/verification.h>
#include <samara/base/text.h>
#include <samara/output/file.h>
#include <samara/study/study.h>
#include <samara/study/verification_studies.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace samara
{
  namespace
  {
    std::string
    content_of(const std::string &file)
    {
      std::ifstream      in(file);
      std::ostringstream text;
      text << in.rdbuf();
      return text.str();
    }



    /** What was found of the elements, as a table of Markdown. */
    std::string
    table_of(const VerificationAnalysis &analysis)
    {
      const auto         text = [](const double number) { return number_to_text("%.1e", number); };
      std::ostringstream out;
      out << "Errors of the tangent " << text(analysis.error_of_tangent) << ", of damping "
          << text(analysis.error_of_damping) << ", of rates of strains " << text(analysis.error_of_rates) << ".\n\n"
          << "| item | kind | strains | motions without strain | change in rigid motion | third difference |\n"
          << "|---|---|---|---|---|---|\n";
      for (const auto &row : analysis.rows)
        out << "| " << row.name << " | " << row.kind << " | " << row.n_strains << " | " << row.n_free_motions << " | "
            << text(row.change_in_motion) << " | " << text(row.third_difference) << " |\n";
      return out.str();
    }
  } // namespace



  void
  run_verification_studies(const Options                                     &options,
                           const Input                                       &input,
                           const std::string                                 &folder,
                           const std::function<void(const Options &, Log &)> &run,
                           Log                                               &log)
  {
    namespace fs = std::filesystem;
    for (const auto &item : input.analyses)
      {
        const auto *const analysis = dynamic_cast<const VerificationAnalysis *>(item.get());
        if (analysis == nullptr || analysis->studies.empty())
          continue;
        std::string report = "# " + (input.title.empty() ? options.model : input.title) + "\n\n" + table_of(*analysis);
        for (const auto &study : analysis->studies)
          {
            Options of_study = options;
            of_study.model   = (fs::path(options.model).parent_path() / study).string();
            // a check of it is a run of its own; here it has to be one
            if (!Study::is_study(InputFile(of_study.model).outline))
              throw InputError(analysis->parameters.where("Studies") + ": <" + study + "> is no study");
            if (options.check)
              continue;
            of_study.output    = (fs::path(folder) / fs::path(study).stem()).string();
            of_study.overrides = {};
            run(of_study, log);
            report += "\n## " + fs::path(study).stem().string() + "\n\n```\n" +
                      content_of(of_study.output + "/study.txt") + "```\n";
          }
        if (!options.check)
          replace_file(folder + "/report.md", report);
      }
  }
} // namespace samara
