#include <samara/model/frame_probe.h>

#include <map>

namespace samara
{
  namespace
  {
    using Vector = std::function<Vector3(const FrameMotion &)>;

    struct Quantity
    {
      std::string unit, directions;
      Vector      vector;
    };

    const std::map<std::string, Quantity> &
    quantities()
    {
      static const double                          degrees = 180. / M_PI;
      static const std::map<std::string, Quantity> all     = {
        {"position", {"m", "xyz", [](const FrameMotion &m) { return m.x; }}},
        {"displacement", {"m", "xyz", [](const FrameMotion &m) -> Vector3 { return m.x - m.x_reference; }}},
        {"velocity", {"m/s", "xyz", [](const FrameMotion &m) { return m.velocity; }}},
        {"angular velocity", {"rad/s", "xyz", [](const FrameMotion &m) { return m.angular_velocity; }}},
        {"rotation",
         {"deg",
          "xyz",
          [](const FrameMotion &m) -> Vector3 {
            return degrees * vector_of_rotation(m.D * m.D_reference.transpose());
          }}},
        {"angle", {"deg", "123", [](const FrameMotion &m) -> Vector3 {
                     return degrees * angles_of_rotation(m.D_reference.transpose() * m.D, "321").reverse();
                   }}}};
      return all;
    }
  } // namespace



  std::optional<Probe>
  frame_probe(const std::string &quantity, const std::function<FrameMotion(const State &)> &motion)
  {
    for (const auto &[name, q] : quantities())
      for (unsigned int i = 0; i < 3; ++i)
        if (quantity == name + " " + q.directions[i])
          {
            const Vector vector = q.vector;
            return Probe{quantity, q.unit, [=](const State &state) { return vector(motion(state))(i); }};
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
