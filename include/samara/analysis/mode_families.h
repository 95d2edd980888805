#ifndef samara_analysis_mode_families_h
#define samara_analysis_mode_families_h

#include <samara/analysis/mode_content.h>
#include <samara/solvers/eigen.h>

namespace samara
{
  /**
   * Parts that do not feel each other, as blades on a hub that is held, have equal modes, of which any combination is
   * one. Replace those by combinations that are one pattern each, collective, progressive, regressive, differential
   * (ContentOfModes), as far as there are such.
   *
   * @p modes: of the steady motion in @p state, in order of |λ|; with |λ1 − λ2| ≤ 1e-6 |λ1| they count as equal.
   */
  void
  separate_patterns(const System &system, const RepeatedParts &parts, const State &state, std::vector<Mode> &modes);

  /** What the repeated parts do in modes of a steady motion, as in those of a periodic one. */
  std::vector<ModeContent>
  contents_of(const System &system, const RepeatedParts &parts, const State &state, const std::vector<Mode> &modes);
} // namespace samara

#endif
