#ifndef samara_model_slip_line_h
#define samara_model_slip_line_h

#include <samara/model/state.h>

#include <complex>

namespace samara
{
  /**
   * What items have along which something slips, and that hold it there by three multipliers, a force: what that has
   * along the line does not press (Layout::Friction::line).
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

} // namespace samara

#endif
