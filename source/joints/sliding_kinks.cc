// How much too stiff a beam is that a joint clamps within an element.

#include <samara/base/text.h>
#include <samara/joints/sliding.h>
#include <samara/model/kinks.h>

#include <cmath>

namespace samara
{
  SlidingJoint::Energies
  SlidingJoint::energies(const State &state) const
  {
    const auto *const line = dynamic_cast<const HasKinks *>(body_of_rail);
    if (line == nullptr || has_left(state))
      return {};
    const double S = start + state.coordinates[coordinate()];
    return {line->lacking(S, action_on_b(state)), 2 * line->elastic_energy(state)};
  }



  std::string
  SlidingJoint::doubt_of_run(const Energies &largest) const
  {
    // relative error of the displacement under the load, exact in linear statics; the energy there is lacks it, too
    constexpr double told  = 0.01;
    const double     whole = largest.elastic + largest.left_out, error = whole > 0 ? largest.left_out / whole : 0;
    if (!(error > told))
      return "";
    double longest = 0;
    for (const LinePiece &piece : rail->pieces())
      longest = std::max(longest, piece.end - piece.start);
    const double enough = std::ceil(rail->length() / longest * error / told);
    return "joint <" + name + "> clamps the beam <" + body_a + "> within an element of " +
           number_to_text("%.3g", longest) + " m, whose moments cannot jump there: the beam is up to " +
           number_to_text("%.2g", 100 * error) + " % too stiff, frequencies are up to " +
           number_to_text("%.2g", 50 * error) +
           " % too high. Where the joint slides this comes and goes from element to element, and errors of a motion "
           "become several times as large. It is of first order in the length of elements, whatever their <Degree>: some " +
           number_to_text("%.0f", enough) +
           " <Elements> of one length give 1 %, and one that ends at the joint makes none";
  }
} // namespace samara
