#ifndef samara_model_signal_h
#define samara_model_signal_h

#include <samara/model/frame.h>
#include <samara/model/state.h>

#include <complex>
#include <limits>
#include <memory>
#include <vector>

namespace samara
{
  class Model;

  /**
   * A number that the model tells of itself and that laws may depend on, with its derivatives: a coordinate of a joint,
   * the velocity of a point, a state of first order, a reaction. In SI units, angles in rad.
   */
  class Signal
  {
  public:
    virtual ~Signal() = default;

    /** @name The unknowns on which it depends @{ */
    std::vector<Frame>        frames; ///< by the twists of their nodes
    std::vector<unsigned int> coordinates, states, multipliers;
    /** @} */

    virtual double               value(const Point<double> &) const               = 0;
    virtual std::complex<double> value(const Point<std::complex<double>> &) const = 0;

    /** Frames are found by bodies; this makes them those of the layout. To be called once, when it is made. */
    virtual void resolve(const Model &model);

    /** See Term::pieces(). */
    virtual void
    pieces(const Point<double> &, std::vector<double> & /*pieces*/) const
    {}

    /** See Term::next_corner(). */
    virtual double
    next_corner(double /*from*/, double /*to*/) const
    {
      return std::numeric_limits<double>::infinity();
    }

    /** Its rate, of a signal that depends on states alone: from their rates. */
    virtual double
    rate(const Point<double> &) const
    {
      return 0;
    }

    /**
     * Its derivatives by these unknowns in the order above, 6 a frame, are added: those by increments of the nodes (in
     * the nodes' axes), coordinates, states and multipliers to @p by_place; those by twists y and rates of coordinates
     * to the same places of @p by_velocity.
     */
    virtual void add_gradient(const Point<double> &, double *by_place, double *by_velocity) const = 0;
  };



  using SignalPointer = std::shared_ptr<Signal>;

  /** A coordinate of a joint, more by @p offset, or its rate. */
  SignalPointer coordinate_signal(unsigned int coordinate, double offset);
  SignalPointer rate_signal(unsigned int coordinate);

  SignalPointer state_signal(unsigned int state);

  /**
   * "position", "displacement", "velocity" or "angular velocity" and one of the directions x, y, z of a frame that is
   * at
   * @p x_reference in the reference configuration; null if it is none of these.
   */
  SignalPointer frame_signal(const std::string &quantity, const Frame &frame, const Vector3 &x_reference);
} // namespace samara

#endif
