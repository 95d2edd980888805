#ifndef samara_analysis_line_of_air_h
#define samara_analysis_line_of_air_h

#include <samara/analysis/analysis.h>
#include <samara/model/load_of_air.h>

namespace samara
{
  /**
   * One line of the log behind an analysis about how the air meets what moves in it: the largest angle of attack, the
   * part of the disk (of the span, where there is no inflow) beyond stall, the largest Mach number. And a warning where
   * most stations are met from behind.
   */
  class LineOfAir
  {
  public:
    void add(const System &system, const State &state);

    /** Nothing of a model without air. @p analysis: "static" */
    void tell(const Context &context, const std::string &analysis) const;

  private:
    FlowSeen seen;
  };
} // namespace samara

#endif
