#ifndef samara_analysis_model_changes_h
#define samara_analysis_model_changes_h

#include <string>
#include <vector>

namespace samara
{
  /** Entries that differ between two models, each as "Bodies/rod/Degree: 3 before, 4 now". */
  struct ModelChanges
  {
    std::vector<std::string> harmless; ///< a motion can go on with them: how far, how accurate, what is written
    std::vector<std::string> refused;  ///< it would be that of another model

    /** Whether one of the harmless ones is the entry <Step>, ... of subsection Dynamic. */
    bool touches(const std::string &entry) const;
  };

  /** @p before and @p now: all entries as used, as Input::print() writes them. */
  ModelChanges changes_of_model(const std::string &before, const std::string &now);
} // namespace samara

#endif
