#include <samara/model/model.h>
#include <samara/model/signal.h>

#include <string>

namespace samara
{
  void
  Signal::resolve(const Model &model)
  {
    for (auto &frame : frames)
      frame = model.resolved(frame);
  }



  namespace
  {
    /** Writes value() for both number types from the template value_at() that @p Derived has. */
    template <typename Derived>
    class EvaluatedSignal : public Signal
    {
    public:
      double
      value(const Point<double> &point) const override
      {
        return static_cast<const Derived &>(*this).value_at(point);
      }
      std::complex<double>
      value(const Point<std::complex<double>> &point) const override
      {
        return static_cast<const Derived &>(*this).value_at(point);
      }
    };



    /** One number of the state: a coordinate of a joint, more by an offset, its rate, a state of first order. */
    class NumberSignal : public EvaluatedSignal<NumberSignal>
    {
    public:
      enum Kind
      {
        coordinate,
        coordinate_rate,
        state
      };

      NumberSignal(const Kind kind, const unsigned int number, const double offset = 0)
        : kind(kind)
        , number(number)
        , offset(offset)
      {
        (kind == state ? states : coordinates) = {number};
      }

      template <typename Number>
      Number
      value_at(const Point<Number> &point) const
      {
        return (kind == coordinate      ? point.coordinates :
                kind == coordinate_rate ? point.rates :
                                          point.states)[number] +
               offset;
      }

      double
      rate(const Point<double> &point) const override
      {
        return kind == state ? point.state_rates[number] : 0.;
      }

      void
      add_gradient(const Point<double> &, double *by_place, double *by_velocity) const override
      {
        (kind == coordinate_rate ? by_velocity : by_place)[0] += 1;
      }

    private:
      Kind         kind;
      unsigned int number;
      double       offset;
    };



    /** The motion of a point in a direction of the inertial frame. */
    class FrameSignal : public EvaluatedSignal<FrameSignal>
    {
    public:
      enum Kind
      {
        position,
        velocity,
        angular_velocity
      };

      FrameSignal(const Kind kind, const Frame &frame, const unsigned int direction, const double offset)
        : kind(kind)
        , direction(direction)
        , offset(offset)
      {
        frames = {frame};
      }

      template <typename Number>
      Number
      value_at(const Point<Number> &point) const
      {
        const Frame &frame = frames[0];
        if (kind == position)
          return frame.position(point.q)(direction) + offset;
        // of the node's twist, with the arm for the velocity of the point
        const Vec6<Number> twist =
          Frame{frame.node, kind == velocity ? frame.arm : Vector3::Zero().eval()}.twist(point.y);
        const Mat3<Number> D = Frame{frame.node}.triad(point.q);
        Number             sum(0);
        for (int i = 0; i < 3; ++i)
          sum += D(direction, i) * twist(kind == velocity ? i : 3 + i);
        return sum;
      }

      void
      add_gradient(const Point<double> &point, double *by_place, double *by_velocity) const override
      {
        // with e a row of D: δ(e·w) = e·(θ × w) + e·δw, θ the turn of the node
        const Frame  &frame = frames[0];
        const Matrix3 D     = Frame{frame.node}.triad(point.q);
        const Vector3 e     = D.row(direction).transpose();
        const auto    add   = [](double *to, const Vector3 &v) { Eigen::Map<Vector3>(to) += v; };
        if (kind == position)
          {
            add(by_place, e);
            add(by_place + 3, frame.arm.cross(e));
            return;
          }
        const Vector6 y    = Eigen::Map<const Vector6>(point.y + 6 * frame.node);
        const Vector3 spin = y.tail<3>(), w = kind == velocity ? Vector3(y.head<3>() + spin.cross(frame.arm)) : spin;
        add(by_place + 3, w.cross(e));
        if (kind == angular_velocity)
          return add(by_velocity + 3, e);
        add(by_velocity, e);
        add(by_velocity + 3, frame.arm.cross(e));
      }

    private:
      Kind         kind;
      unsigned int direction;
      double       offset;
    };
  } // namespace



  SignalPointer
  coordinate_signal(const unsigned int coordinate, const double offset)
  {
    return std::make_shared<NumberSignal>(NumberSignal::coordinate, coordinate, offset);
  }



  SignalPointer
  rate_signal(const unsigned int coordinate)
  {
    return std::make_shared<NumberSignal>(NumberSignal::coordinate_rate, coordinate);
  }



  SignalPointer
  state_signal(const unsigned int state)
  {
    return std::make_shared<NumberSignal>(NumberSignal::state, state);
  }



  SignalPointer
  frame_signal(const std::string &quantity, const Frame &frame, const Vector3 &x_reference)
  {
    const auto        blank     = quantity.rfind(' ');
    const std::string what      = quantity.substr(0, blank),
                      direction = blank == std::string::npos ? "" : quantity.substr(blank + 1);
    const std::size_t i         = std::string("xyz").find(direction);
    if (direction.size() != 1 || i == std::string::npos)
      return nullptr;
    if (what == "position")
      return std::make_shared<FrameSignal>(FrameSignal::position, frame, i, 0.);
    if (what == "displacement")
      return std::make_shared<FrameSignal>(FrameSignal::position, frame, i, -x_reference(i));
    if (what == "velocity")
      return std::make_shared<FrameSignal>(FrameSignal::velocity, frame, i, 0.);
    if (what == "angular velocity")
      return std::make_shared<FrameSignal>(FrameSignal::angular_velocity, frame, i, 0.);
    return nullptr;
  }
} // namespace samara
