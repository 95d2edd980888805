// What is doubtful of a surface: copies, twins, too few stations; and where it is below the ground.

#include <samara/aero/momentum_inflow.h>
#include <samara/aero/surface.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace samara
{
  namespace
  {
    std::string
    short_number(const double x)
    {
      return number_to_text("%.3g", x);
    }

    /** "<a>, <b> and <c>" */
    std::string
    list_of_surfaces(const std::vector<const Item *> &items)
    {
      std::string text;
      for (unsigned int i = 0; i < items.size(); ++i)
        text += (i == 0 ? "<" : i + 1 == items.size() ? " and <" : ", <") + items[i]->name + ">";
      return text;
    }

    /** Of a place from the line between two others, and nothing beyond their ends. */
    double
    distance_from_line(const Vector3 &x, const Vector3 &from, const Vector3 &to)
    {
      const Vector3 along = to - from;
      const double  share = along.isZero(0.) ? 0. : std::clamp((x - from).dot(along) / along.squaredNorm(), 0., 1.);
      return (x - from - share * along).norm();
    }
  } // namespace



  void
  Surface::find_places()
  {
    for (const auto &element : elements)
      for (const auto &station : element.stations)
        {
          Place place{Vector3::Zero(), station.section.chord, station.weight};
          for (unsigned int a = 0; a < station.N.size(); ++a)
            place.x +=
              station.N[a] * (model->position(element.frames[a]) + model->triad(element.frames[a]) * station.quarter);
          places.push_back(place);
        }
  }



  /** Of several blades of a rotor one is told. */
  bool
  Surface::is_told_of_another(const std::string &about) const
  {
    for (const auto &item : model->items)
      {
        if (item.get() == this)
          return false;
        const auto *const other = dynamic_cast<const Surface *>(item.get());
        if (other != nullptr && other->inflow == inflow && other->elements.size() == elements.size() &&
            std::any_of(other->known_doubts.begin(), other->known_doubts.end(), [&](const Doubt &doubt) {
              return doubt.about == about;
            }))
          return true;
      }
    return false;
  }



  void
  Surface::find_doubts()
  {
    add_doubt_of_copies();
    if (!is_told_of_another("power"))
      add_doubt_of_power();
    if (!is_told_of_another("lags"))
      add_doubt_of_lags();
    if (!without_lift.empty() && !is_told_of_another("no lift"))
      known_doubts.push_back({"no lift",
                              "<" + airfoil_without_lift + "> of <" + name +
                                "> has no lift, at s = " + short_number(without_lift.front()) +
                                (without_lift.size() > 1 ? " to " + short_number(without_lift.back()) : "") +
                                " m: the flow is quasi-steady there, without dynamic stall"});
  }



  /** A surface before this one on the same line: a copy that was not moved. */
  void
  Surface::add_doubt_of_copies()
  {
    constexpr double same = 0.01; // of a chord
    for (const auto &item : model->items)
      {
        if (item.get() == this)
          return;
        const auto *const other = dynamic_cast<const Surface *>(item.get());
        if (other == nullptr || other->air != air || other->is_faulty)
          continue;
        const auto &line    = other->places;
        double      overlap = 0;
        for (const auto &place : places)
          for (unsigned int i = 0; i < line.size(); ++i)
            if (distance_from_line(place.x, line[i].x, line[std::min<std::size_t>(i + 1, line.size() - 1)].x) <
                same * std::min(place.chord, line[i].chord))
              {
                overlap += place.weight;
                break;
              }
        if (overlap > 0)
          known_doubts.push_back({"copy of " + other->name,
                                  "<" + name + "> and <" + other->name + "> lie on one line, " + short_number(overlap) +
                                    " m of it: the air acts on it twice. Is one a copy that has kept the <Body> or the "
                                    "<Line> of the other?"});
      }
  }



  /** Surfaces like this one, as far from the axis of an inflow, that live in it while this one does not. */
  void
  Surface::add_doubt_of_twins()
  {
    constexpr double same = 1e-3; // of a radius, of a chord
    if (inflow != nullptr)
      return;
    std::vector<const Item *> twins;
    const Inflow             *of_twins = nullptr;
    for (const auto &item : model->items)
      {
        const auto *const other = dynamic_cast<const Surface *>(item.get());
        if (other == nullptr || other->inflow == nullptr || other->is_faulty ||
            (of_twins != nullptr && other->inflow != of_twins))
          continue;
        const auto   &there = other->places;
        const Vector3 hub = other->inflow->centre_zero, axis = other->inflow->axis_zero;
        const double  R     = other->inflow->radius;
        bool          alike = there.size() == places.size();
        for (unsigned int i = 0; alike && i < there.size(); ++i)
          {
            const Vector3 a = places[i].x - hub, b = there[i].x - hub;
            alike = std::abs(axis.cross(a).norm() - axis.cross(b).norm()) < same * R &&
                    std::abs(axis.dot(a) - axis.dot(b)) < same * R &&
                    std::abs(places[i].chord - there[i].chord) < same * there[i].chord;
          }
        if (!alike)
          continue;
        twins.push_back(other);
        of_twins = other->inflow;
      }
    if (!twins.empty())
      known_doubts.push_back(
        {"twins",
         "<" + name + "> has no <Inflow>, and " + list_of_surfaces(twins) +
           (twins.size() > 1 ? ", which are like it, have" : ", which is like it, has") + " <" + of_twins->name +
           ">: it meets the air as if no rotor were there, and its thrust, one of " + std::to_string(twins.size() + 1) +
           " blades, does not drive the flow. Say Inflow = " + of_twins->name});
  }



  /** Whether stations integrate what the highest powers of the radius do to themselves: r φ². */
  void
  Surface::add_doubt_of_power()
  {
    constexpr double       allowed  = 0.1;
    constexpr unsigned int n_exact  = 24; // for powers up to 40, DiskShapes of Peters and He
    const auto *const      momentum = dynamic_cast<const MomentumInflow *>(inflow);
    if (momentum == nullptr)
      return;
    const auto         &shapes = inflow->disk.shapes;
    std::vector<double> phi(shapes.size()), exact(shapes.size(), 0.), found(shapes.size(), 0.);
    const auto          add = [&](const Station &station, const Element &element, std::vector<double> &sums) {
      const double r = on_disk(station, element).head<2>().norm() / inflow->radius;
      inflow->disk.evaluate(r, 0., phi.data());
      for (unsigned int k = 0; k < phi.size(); ++k)
        sums[k] += station.weight * r * phi[k] * phi[k];
    };
    for (const auto &element : elements)
      for (const auto &station : element.stations)
        add(station, element, found);
    // the line of a beam is smooth on its elements
    std::vector<double> pieces = panels;
    for (const auto &element : elements)
      if (element.abscissae.front() > panels.front() && element.abscissae.front() < panels.back())
        pieces.push_back(element.abscissae.front());
    std::sort(pieces.begin(), pieces.end());
    for (const auto &point : composite_rule(pieces, n_exact))
      if (point.weight > 0)
        {
          const auto &element = elements[element_at(point.x)];
          add(station_at(point.x, point.weight, element), element, exact);
        }
    double       most  = 0;
    unsigned int power = 0;
    for (unsigned int k = 0; k < shapes.size(); ++k)
      if (const double error = exact[k] > 0 ? std::abs(found[k] / exact[k] - 1) : 0.; error > most)
        {
          most  = error;
          power = shapes[k].m + 2 * (shapes[k].c.size() - 1);
        }
    if (most > allowed)
      known_doubts.push_back({"power",
                              "the stations of <" + name + "> do not resolve <" + inflow->name +
                                ">: they integrate the effect of its power " + std::to_string(power) +
                                " of the radius on itself with an error of " + short_number(100 * most) +
                                " %. Thrust and flow may be wrong by as much. With Stations = " +
                                std::to_string(power + 1) + " they are exact on one panel"});
  }



  void
  Surface::add_doubt_of_lags()
  {
    constexpr unsigned int most_states = 3; // of Pitt and Peters: doc/theory/aerodynamics.md, unsteady flow
    if (unsteady == Unsteady::quasi_steady || inflow == nullptr || inflow->states.size() <= most_states)
      return;
    unsigned int harmonics = 0;
    for (const auto &shape : inflow->disk.shapes)
      harmonics = std::max(harmonics, shape.m);
    if (harmonics < 2)
      return;
    known_doubts.push_back({"lags",
                            "<" + name + "> has two lags a station, and <" + inflow->name + "> has " +
                              std::to_string(inflow->states.size()) + " states up to the harmonic " +
                              std::to_string(harmonics) +
                              ": both are the wake that blades shed, and unsteady lift is reduced twice. " +
                              (unsteady == Unsteady::two_lags ? "Set Unsteady = quasi-steady, or take an" : "Take an") +
                              " inflow of three states"});
  }



  namespace
  {
    /** The angle behind which lift falls, from zero on in steps of this sign; infinite if it does not fall. */
    double
    stall_angle(const SectionOfWing &section, const double mach, const double sign)
    {
      constexpr double step = M_PI / 360, fall = 0.02; // what a table's noise may be
      constexpr int    most = 120;                     // 60 degrees
      double           best = -1e300, angle = 0;
      for (int i = 0; i <= most; ++i)
        {
          const double lift = sign * section.coefficients(sign * i * step, mach).lift;
          if (lift > best)
            {
              best  = lift;
              angle = sign * i * step;
            }
          else if (lift < best - fall)
            return angle;
        }
      return sign * std::numeric_limits<double>::infinity();
    }
  } // namespace



  bool
  Surface::is_stalled(const unsigned int   station,
                      const SectionOfWing &section,
                      const double         alpha,
                      const double         mach) const
  {
    if (stall_angles.size() <= station)
      stall_angles.resize(station + 1);
    auto              &of_station = stall_angles[station];
    constexpr double   tenth      = 0.1;
    const unsigned int i          = std::min<double>(std::lround(mach / tenth), of_station.size() - 1.);
    StallAngles       &angles     = of_station[i];
    if (!angles.is_known)
      angles = {true, stall_angle(section, i * tenth, -1), stall_angle(section, i * tenth, 1)};
    return alpha < angles.low || alpha > angles.high;
  }



  void
  Surface::see_flow(const State &state, FlowSeen &seen) const
  {
    constexpr double slow    = 1e-2; // of the fastest: there angles are an accident
    double           fastest = 0;
    for (const auto &element : elements)
      for (const auto &at : at_element(element, state.point()).stations)
        fastest = std::max(fastest, at.flow.speed);
    unsigned int number = 0;
    for (const auto &element : elements)
      {
        const auto &all = at_element(element, state.point());
        for (unsigned int i = 0; i < element.stations.size(); ++i, ++number)
          {
            const Station &station = element.stations[i];
            const auto    &at      = all.stations[i];
            if (at.flow.speed == 0 || at.flow.speed < slow * fastest)
              continue;
            const double angle = std::abs(at.flow.alpha);
            ++seen.stations;
            seen.backwards += angle > M_PI / 2 ? 1 : 0;
            seen.mach = std::max(seen.mach, at.flow.mach);
            if (angle > seen.angle || seen.where.empty())
              {
                seen.angle = angle;
                seen.where = "<" + name + "> at s = " + short_number(station.s) + " m";
              }
            const double stalled = is_stalled(number, station.section, at.flow.alpha, at.flow.mach) ? 1 : 0,
                         area    = inflow != nullptr ? station.weight * at.on_disk.head<2>().norm() : station.weight;
            (inflow != nullptr ? seen.disk : seen.span) += area;
            (inflow != nullptr ? seen.disk_stalled : seen.span_stalled) += stalled * area;
          }
      }
  }



  void
  Surface::add_doubt_of_ground(const State &state, std::vector<Doubt> &doubts) const
  {
    unsigned int n = 0, n_below = 0;
    double       lowest = air->ground;
    for (const auto &element : elements)
      for (const auto &at : at_element(element, state.point()).stations)
        {
          ++n;
          n_below += air->is_below_wind(at.place(2)) ? 1 : 0;
          lowest = std::min(lowest, at.place(2));
        }
    if (n_below > 0)
      doubts.push_back({"ground",
                        std::to_string(n_below) + " of " + std::to_string(n) + " stations of <" + name +
                          "> are on or below the ground, which is at z = " + short_number(air->ground) +
                          " m: the lowest is at z = " + short_number(lowest) +
                          " m. A wind with <Shear exponent> is none "
                          "there. <Ground> of <" +
                          air->name + "> says where the ground is"});
  }
} // namespace samara
