#include <samara/analysis/line_of_air.h>
#include <samara/base/text.h>

#include <cmath>

namespace samara
{
  void
  LineOfAir::add(const System &system, const State &state)
  {
    for (const auto &item : system.model.items)
      if (const auto *const in_air = dynamic_cast<const LoadOfAir *>(item.get()))
        in_air->see_flow(state, seen);
  }



  void
  LineOfAir::tell(const Context &context, const std::string &analysis) const
  {
    if (seen.stations == 0)
      return;
    const auto   text    = [](const double x) { return number_to_text("%.3g", x); };
    const bool   is_disk = seen.disk > 0;
    const double part    = is_disk ? seen.disk_stalled / seen.disk : seen.span_stalled / seen.span;
    context.log.line("  " + analysis + ": air: angle of attack up to " + text(seen.angle * 180 / M_PI) + " deg (" +
                     seen.where + "), " + text(100 * part) + " % of the " + (is_disk ? "disk" : "span") +
                     " beyond stall, Mach number up to " + text(seen.mach));
    if (2 * seen.backwards > seen.stations)
      context.log.warning(analysis,
                          "the air comes from behind, with an angle of attack of more than 90 deg, to " +
                            text(100. * seen.backwards / seen.stations) +
                            " % of the stations of surfaces: they move backwards. Look at <Leading edge> and <Upper "
                            "side>, at the sign of speeds, and whether angles are in degrees (8 deg; 8 alone is rad)");
  }
} // namespace samara
