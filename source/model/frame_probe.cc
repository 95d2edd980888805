#include <samara/model/frame_probe.h>
#include <samara/model/probe_needs.h>

#include <map>

namespace samara
{
  namespace
  {
    using Vector = std::function<Vector3(const FrameMotion &)>;

    struct Quantity
    {
      std::string  unit, directions;
      unsigned int order; ///< of the derivative by time
      Vector       vector;
    };

    const std::map<std::string, Quantity> &
    quantities()
    {
      static const double                          degrees = 180. / M_PI;
      static const std::map<std::string, Quantity> all     = {
            {"position", {"m", "xyz", 0, [](const FrameMotion &m) { return m.x; }}},
            {"displacement", {"m", "xyz", 0, [](const FrameMotion &m) -> Vector3 { return m.x - m.x_reference; }}},
            {"velocity", {"m/s", "xyz", 1, [](const FrameMotion &m) { return m.velocity; }}},
            {"angular velocity", {"rad/s", "xyz", 1, [](const FrameMotion &m) { return m.angular_velocity; }}},
            {"acceleration", {"m/s^2", "xyz", 2, [](const FrameMotion &m) { return m.acceleration; }}},
            {"angular acceleration", {"rad/s^2", "xyz", 2, [](const FrameMotion &m) { return m.angular_acceleration; }}},
            {"rotation",
             {"deg",
              "xyz",
              0,
              [](const FrameMotion &m) -> Vector3 {
            return degrees * vector_of_rotation(m.D * m.D_reference.transpose());
          }}},
            {"angle", {"deg", "123", 0, [](const FrameMotion &m) -> Vector3 {
                     return degrees * angles_of_rotation(m.D_reference.transpose() * m.D, "321").reverse();
                   }}}};
      return all;
    }
  } // namespace



  FrameMotion
  FrameMotion::of(const Frame &frame, const Vector3 &x_reference, const Matrix3 &D_reference, const State &state)
  {
    const Matrix3 D = frame.triad(state.q.data());
    const Vector6 y = frame.twist(state.y.data()), a = frame_acceleration(frame, state);
    return {frame.position(state.q.data()),
            x_reference,
            D,
            D_reference,
            D * y.head<3>(),
            D * y.tail<3>(),
            a.head<3>(),
            a.tail<3>()};
  }



  FrameMotion
  FrameMotion::seen_from(const FrameMotion &other) const
  {
    const Matrix3 Q = other.D * other.D_reference.transpose();
    const Vector3 r = x - other.x, w = other.angular_velocity, v = velocity - other.velocity - w.cross(r);
    FrameMotion   seen    = *this;
    seen.x                = other.x_reference + Q.transpose() * r;
    seen.D                = Q.transpose() * D;
    seen.velocity         = Q.transpose() * v;
    seen.angular_velocity = Q.transpose() * (angular_velocity - w);
    seen.acceleration     = Q.transpose() * (acceleration - other.acceleration - other.angular_acceleration.cross(r) -
                                         w.cross(w.cross(r)) - 2 * w.cross(v));
    seen.angular_acceleration =
      Q.transpose() * (angular_acceleration - other.angular_acceleration - w.cross(angular_velocity));
    return seen;
  }



  Vector6
  frame_acceleration(const Frame &frame, const State &state)
  {
    if (state.accelerations.empty())
      return Vector6::Zero();
    const Matrix3 D = frame.triad(state.q.data());
    const Vector6 y = frame.twist(state.y.data()), rate = frame.twist(state.accelerations.data());
    Vector6       a;
    a << D * (rate.head<3>() + cross(y.tail<3>(), y.head<3>())), D * rate.tail<3>();
    return a;
  }



  std::optional<Probe>
  frame_probe(const std::string &quantity, const std::function<FrameMotion(const State &)> &motion)
  {
    for (const auto &[name, q] : quantities())
      for (unsigned int i = 0; i < 3; ++i)
        if (quantity == name + " " + q.directions[i])
          {
            const OfPlaces of_places{
              [vector = q.vector, motion, i](const State &state) { return vector(motion(state))(i); }};
            if (q.order == 0)
              return Probe{quantity, q.unit, of_places};
            if (q.order == 1)
              return Probe{quantity, q.unit, OfVelocities{of_places}};
            return Probe{quantity, q.unit, of_places.value};
          }
    return {};
  }



  std::vector<std::string>
  frame_quantities()
  {
    std::vector<std::string> names;
    for (const auto &[name, q] : quantities())
      for (const char direction : q.directions)
        names.push_back(name + " " + direction);
    return names;
  }
} // namespace samara
