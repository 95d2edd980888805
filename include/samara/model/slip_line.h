#ifndef samara_model_slip_line_h
#define samara_model_slip_line_h

#include <samara/model/layout.h>

#include <algorithm>
#include <complex>

namespace samara
{
  /**
   * What items have along which something slips, and that hold it there by three multipliers, a force: what that has
   * along the line does not press.
   */
  class HasSlipLine
  {
  public:
    virtual ~HasSlipLine() = default;

    /** The first of the three. */
    virtual unsigned int multiplier_of_force() const = 0;

    /** Of the line, as the multipliers see it, of length one; zero where nothing is held. @{ */
    virtual Vector3                    direction_of_slip(const Point<double> &point) const               = 0;
    virtual Vec3<std::complex<double>> direction_of_slip(const Point<std::complex<double>> &point) const = 0;
    /** @} */
  };



  /** The item by whose multipliers a friction is pressed, if it has such a line; nullptr: they press as they are. */
  inline const HasSlipLine *
  slip_line_of(const Layout &layout, const Layout::Friction &friction)
  {
    // rows of a line that bends have corrections: few others are looked for among the items
    const auto is_corrected = [&](const Layout::Correction &c) { return c.multiplier == friction.multipliers[0]; };
    if (friction.multipliers.size() != 3 ||
        std::none_of(layout.corrections.begin(), layout.corrections.end(), is_corrected))
      return nullptr;
    for (const auto &item : layout.model.items)
      if (const auto *const line = dynamic_cast<const HasSlipLine *>(item.get());
          line != nullptr && line->multiplier_of_force() == friction.multipliers[0])
        return line;
    return nullptr;
  }
} // namespace samara

#endif
