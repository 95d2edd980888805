// What can be asked of a surface, and how it is drawn.

#include <samara/aero/surface.h>

#include <cmath>

namespace samara
{
  namespace
  {
    /** The quantities of a station and their units. */
    const std::vector<std::pair<std::string, std::string>> &
    quantities_of_station()
    {
      static const std::vector<std::pair<std::string, std::string>> quantities = {{"angle of attack", "deg"},
                                                                                  {"Mach", "1"},
                                                                                  {"speed", "m/s"},
                                                                                  {"lift coefficient", "1"},
                                                                                  {"drag coefficient", "1"},
                                                                                  {"moment coefficient", "1"},
                                                                                  {"normal force", "N/m"},
                                                                                  {"chord force", "N/m"},
                                                                                  {"moment", "N"},
                                                                                  {"inflow", "m/s"}};
      return quantities;
    }

    /** Direction x, y, z at the end of "force x"; nothing if there is none. */
    std::optional<unsigned int>
    direction_of(const std::string &path, const std::string &quantity)
    {
      const std::string names = "xyz";
      if (path.size() != quantity.size() + 2 || path.rfind(quantity + " ", 0) != 0 ||
          names.find(path.back()) == std::string::npos)
        return {};
      return names.find(path.back());
    }
  } // namespace



  std::optional<Probe>
  Surface::probe(const std::string &path) const
  {
    if (const auto i = direction_of(path, "force"))
      return Probe{path, "N", [this, i](const State &state) {
                     return air_loads(state, Vector3::Zero(), Vector3::Zero()).force(*i);
                   }};
    if (const auto i = direction_of(path, "moment"))
      return Probe{path, "N m", [this, i](const State &state) {
                     return air_loads(state, Vector3::Zero(), Vector3::Zero()).moment(*i);
                   }};
    if (path == "power")
      return Probe{path, "W", [this](const State &state) {
                     return air_loads(state, Vector3::Zero(), Vector3::Zero()).power;
                   }};

    // "at s.quantity": of the station that is nearest
    const auto        dot      = path.rfind('.');
    const std::string quantity = dot == std::string::npos ? "" : trim(path.substr(dot + 1));
    double            s        = 0;
    if (dot == std::string::npos || path.rfind("at ", 0) != 0 || !text_to_number(trim(path.substr(3, dot - 3)), s))
      return {};
    const Element *in      = nullptr;
    const Station *nearest = nullptr;
    for (const auto &element : elements)
      for (const auto &station : element.stations)
        if (nearest == nullptr || std::abs(station.s - s) < std::abs(nearest->s - s))
          {
            in      = &element;
            nearest = &station;
          }
    for (unsigned int k = 0; k < quantities_of_station().size() && nearest != nullptr; ++k)
      if (quantity == quantities_of_station()[k].first)
        return Probe{path, quantities_of_station()[k].second, [this, in, nearest, k](const State &state) {
                       const auto   at       = evaluate(*nearest, gather(*in, state.point()), state.time);
                       const double values[] = {at.flow.alpha * 180 / M_PI,
                                                at.flow.mach,
                                                at.flow.speed,
                                                at.flow.lift,
                                                at.flow.drag,
                                                at.flow.moment,
                                                at.flow.loads(2),
                                                at.flow.loads(1),
                                                at.flow.loads(3),
                                                at.induced};
                       return values[k];
                     }};
    return {};
  }



  std::vector<std::string>
  Surface::probe_names() const
  {
    std::vector<std::string> names = {"power"};
    for (const std::string quantity : {"force", "moment"})
      for (const char i : {'x', 'y', 'z'})
        names.push_back(quantity + " " + i);
    for (const auto &quantity : quantities_of_station())
      names.push_back("at s." + quantity.first);
    return names;
  }



  void
  Surface::draw(const State &state, Drawing &drawing) const
  {
    // NACA 0012, from the trailing edge round the nose, x from the leading edge
    const double                 x[] = {1, 0.8, 0.6, 0.4, 0.2, 0.1, 0.03, 0};
    const double                 t[] = {0, 0.026, 0.0456, 0.058, 0.0574, 0.0468, 0.0288, 0};
    std::vector<Eigen::Vector2d> unit;
    for (int i = 0; i < 8; ++i)
      unit.push_back({0.25 - x[i], t[i]});
    for (int i = 6; i > 0; --i)
      unit.push_back({0.25 - x[i], -t[i]});
    std::vector<Sample>                       axis;
    std::vector<std::vector<Eigen::Vector2d>> outlines;
    for (const auto &element : elements)
      {
        const auto g = gather(element, state.point());
        for (const auto &station : element.stations)
          {
            const auto at = evaluate(station, g, state.time);
            Sample     sample;
            sample.x = at.place;
            sample.D << at.axes.e1, at.axes.e2, at.axes.e3;
            sample.velocity = g.frames.velocity(station.N, station.quarter);
            axis.push_back(sample);
            outlines.push_back(unit);
            for (auto &corner : outlines.back())
              corner *= station.section.chord;
          }
      }
    if (axis.size() < 2)
      return;
    drawing.begin_object(name);
    drawing.tube(axis, outlines);
  }
} // namespace samara
