#ifndef samara_section_extremes_by_name_h
#define samara_section_extremes_by_name_h

#include <samara/section/recovery.h>

#include <string>
#include <vector>

namespace samara
{
  /** What probes ask of stresses: "stress 11", ..., "von Mises stress", and indices of failure, "Tsai-Wu index". */
  class ExtremeByName
  {
  public:
    /** All names, in the order in which they are told. */
    static std::vector<std::string> names();

    explicit ExtremeByName(const std::string &name);

    /** Whether it is one of them. */
    bool
    is_known() const
    {
      return number >= 0;
    }

    /** Pa, or 1 of an index. */
    std::string unit() const;

    /** Negative of an index whose strengths are not known. */
    double of(const SectionStresses::Extremes &extremes) const;

  private:
    int number;
  };
} // namespace samara

#endif
