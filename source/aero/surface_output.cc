// What can be asked of a surface, and how it is drawn.

#include <samara/aero/surface.h>

#include <algorithm>
#include <array>
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

    /** Their values, in this order. */
    std::array<double, 10>
    values_at_station(const SectionFlow<double> &flow, const double induced)
    {
      return {{flow.alpha * 180 / M_PI,
               flow.mach,
               flow.speed,
               flow.lift,
               flow.drag,
               flow.moment,
               flow.loads(2),
               flow.loads(1),
               flow.loads(3),
               induced}};
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
    if (path == "induced power")
      return Probe{path, "W", [this](const State &state) {
                     return air_loads(state, Vector3::Zero(), Vector3::Zero()).induced;
                   }};
    if (path == "profile power")
      return Probe{path, "W", [this](const State &state) {
                     return air_loads(state, Vector3::Zero(), Vector3::Zero()).profile;
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
                       const auto &at = at_element(*in, state.point()).stations[nearest - in->stations.data()];
                       return values_at_station(at.flow, at.induced)[k];
                     }};
    return {};
  }



  std::vector<std::string>
  Surface::probe_names() const
  {
    std::vector<std::string> names = {"power", "induced power", "profile power"};
    for (const std::string quantity : {"force", "moment"})
      for (const char i : {'x', 'y', 'z'})
        names.push_back(quantity + " " + i);
    for (const auto &quantity : quantities_of_station())
      names.push_back("at s." + quantity.first);
    return names;
  }



  std::vector<Doubt>
  Surface::doubts(const State &state) const
  {
    std::vector<Doubt> result = known_doubts;
    if (inflow == nullptr || inflow->part_below_ground(state) == 0) // it tells of the disk
      add_doubt_of_ground(state, result);
    for (const auto &element : elements)
      {
        const auto &all = at_element(element, state.point());
        for (unsigned int i = 0; i < element.stations.size(); ++i)
          {
            const SectionOfWing &section = element.stations[i].section;
            const double         knows   = section.share > 0 ?
                                             std::min(section.airfoil->highest_mach(), section.next->highest_mach()) :
                                             section.airfoil->highest_mach();
            if (const double mach = all.stations[i].flow.mach; mach > knows)
              {
                result.push_back({"Mach number",
                                  "the air meets <" + name +
                                    "> at s = " + number_to_text("%.4g", element.stations[i].s) + " m with Mach " +
                                    number_to_text("%.3g", mach) + ", and <" + section.airfoil->name +
                                    "> is that of Mach " + number_to_text("%.3g", knows) +
                                    " beyond it: drag and moments of shock waves are not in the loads"});
                return result;
              }
          }
      }
    return result;
  }



  double
  Surface::azimuth(const AtStation<double> &at, const Vector3 &centre) const
  {
    // the direction of azimuth zero does not turn about the thrust axis, be the hub one that turns or not; where that
    // axis tilts it goes with it, the shortest way
    const Vector3 e3 = at.thrust_axis.normalized(), from = inflow->axis_zero, k = from.cross(e3),
                  zero = inflow->azimuth_zero, r = at.place - centre;
    const double  c = from.dot(e3);
    const Vector3 tilt =
                    c > -1 + 1e-12 ? Vector3(k.cross(zero) + k.cross(k.cross(zero)) / (1 + c)) : Vector3(0., 0., 0.),
                  e1   = zero + tilt;
    const double angle = std::atan2(r.dot(e3.cross(e1)), r.dot(e1)) * 180 / M_PI;
    return angle < 0 ? angle + 360 : angle;
  }



  namespace
  {
    /** NACA 0012 about its quarter [m], from the trailing edge round the nose; x from the leading edge. */
    std::vector<Eigen::Vector2d>
    outline_of_airfoil(const double chord)
    {
      const double                 x[] = {1, 0.8, 0.6, 0.4, 0.2, 0.1, 0.03, 0};
      const double                 t[] = {0, 0.026, 0.0456, 0.058, 0.0574, 0.0468, 0.0288, 0};
      std::vector<Eigen::Vector2d> outline;
      for (int i = 0; i < 8; ++i)
        outline.emplace_back(chord * (0.25 - x[i]), chord * t[i]);
      for (int i = 6; i > 0; --i)
        outline.emplace_back(chord * (0.25 - x[i]), -chord * t[i]);
      return outline;
    }



    /** The force of the section in its plane, square to the air that it meets there and along it, inertial axes [N/m]. */
    template <typename AtStation>
    std::array<Vector3, 2>
    lift_and_drag(const AtStation &at)
    {
      const Vector3 w     = Vector3(at.V(1) * at.axes.e2 + at.V(2) * at.axes.e3).normalized(),
                    force = at.flow.loads(1) * at.axes.e2 + at.flow.loads(2) * at.axes.e3, drag = force.dot(w) * w;
      return {{force - drag, drag}};
    }
  } // namespace



  void
  Surface::draw(const State &state, Drawing &drawing) const
  {
    std::vector<Sample>                       axis;
    std::vector<double>                       chords;
    std::vector<std::array<double, 10>>       values;
    std::vector<std::array<double, 2>>        places;
    std::vector<std::array<Vector3, 2>>       loads; // lift and drag
    for (const auto &element : elements)
      {
        const auto &all = at_element(element, state.point());
        const auto &g   = all.g;
        for (unsigned int i = 0; i < element.stations.size(); ++i)
          {
            const Station &station = element.stations[i];
            const auto    &at      = all.stations[i];
            Sample         sample;
            sample.x = at.place;
            sample.D << at.axes.e1, at.axes.e2, at.axes.e3;
            sample.velocity = g.frames.velocity(station.N, station.quarter);
            sample.spin     = at.spin;
            // rigidly enough attached to the nearer node, for who asks of which body it is
            sample.node = element.frames[std::max_element(station.N.begin(), station.N.end()) - station.N.begin()].node;
            axis.push_back(sample);
            chords.push_back(station.section.chord);
            if (!drawing.has_fields())
              continue;
            loads.push_back(lift_and_drag(at));
            values.push_back(values_at_station(at.flow, at.induced));
            if (inflow != nullptr)
              places.push_back({{at.on_disk.head<2>().norm(), azimuth(at, g.frames.x.back())}});
          }
      }
    if (axis.size() < 2)
      return;
    drawing.begin_object(name);
    const auto         outline = [&](const unsigned int i) { return outline_of_airfoil(chords[i]); };
    const unsigned int first   = drawing.tube(axis, outline).first_sample;
    if (!drawing.has_fields())
      return;
    const auto         set_field = [&](const std::string &quantity, const std::string &unit, const auto &of_station) {
      Field &field = drawing.field(quantity, unit);
      for (unsigned int i = 0; i < axis.size(); ++i)
        field.set(first + i, of_station(i));
    };
    for (unsigned int k = 0; k < quantities_of_station().size(); ++k)
      set_field(quantities_of_station()[k].first, quantities_of_station()[k].second, [&](const unsigned int i) {
        return values[i][k];
      });
    for (unsigned int k = 0; k < 2; ++k)
      {
        Field &field = drawing.field(k == 0 ? "lift" : "drag", "N/m", inertial_axes);
        for (unsigned int i = 0; i < axis.size(); ++i)
          field.set(first + i, loads[i][k]);
      }
    if (inflow == nullptr)
      return;
    set_field("radius", "m", [&](const unsigned int i) { return places[i][0]; });
    set_field("azimuth", "deg", [&](const unsigned int i) { return places[i][1]; });
  }
} // namespace samara
