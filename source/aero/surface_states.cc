// The states of a surface, and its place on the disk of its inflow.

#include <samara/aero/surface.h>

#include <array>
#include <cmath>

namespace samara
{
  /** Its quarter chord in the frame of the inflow's hub, reference configuration. */
  Vector3
  Surface::on_disk(const Station &station, const Element &element) const
  {
    Vector3 x = Vector3::Zero();
    for (unsigned int a = 0; a < element.frames.size(); ++a)
      x += station.N[a] * (model->position(element.frames[a]) + model->triad(element.frames[a]) * station.quarter);
    return model->triad(inflow->hub).transpose() * (x - model->position(inflow->hub));
  }



  void
  Surface::check_disk() const
  {
    struct Place
    {
      double s, r, chord;
    };
    const auto places_of = [](const Surface &surface) {
      std::vector<Place> places;
      for (const auto &element : surface.elements)
        for (const auto &station : element.stations)
          places.push_back({station.s, surface.on_disk(station, element).head<2>().norm(), station.section.chord});
      return places;
    };
    const auto complain = [this](const std::string &text) { model->complaints.add(parameters.where("Inflow"), text); };
    const auto text     = [](const double x) { return number_to_text("%.4g", x); };
    const auto places   = places_of(*this);
    for (const auto &place : places)
      if (place.r > (1 + 1e-6) * inflow->radius)
        return complain("the surface is outside of the disk of <" + inflow_name + ">: at s = " + text(place.s) +
                        " m it is " + text(place.r) + " m from the axis, and the radius is " + text(inflow->radius) +
                        " m");

    // annuli, wakes and tips count the surfaces as blades
    const bool counts_blades = inflow->corrections.has_tip_loss ||
                               dynamic_cast<const AnnularInflow *>(inflow) != nullptr ||
                               dynamic_cast<const ExternalInflow *>(inflow) != nullptr;
    const auto *const other =
      inflow->surfaces.empty() ? nullptr : dynamic_cast<const Surface *>(inflow->surfaces.front());
    if (!counts_blades || inflow->parameters.is_set("Blades") || other == nullptr)
      return;
    const auto        others = places_of(*other);
    const std::string how =
      ", and <" + inflow_name +
      "> counts them as one rotor's: <Blades> of it says how many blades there are, if surfaces are "
      "parts of blades or stand for several";
    if (places.empty() || others.empty())
      return;
    if (places.size() != others.size())
      return complain("the blades of <" + inflow_name + "> differ: <" + name + "> has " +
                      std::to_string(places.size()) + " stations and <" + other->name + "> " +
                      std::to_string(others.size()) + how);
    for (unsigned int i = 0; i < places.size(); ++i)
      if (std::abs(places[i].r - others[i].r) > 1e-4 * inflow->radius ||
          std::abs(places[i].chord - others[i].chord) > 1e-4 * others[i].chord)
        return complain("the blades of <" + inflow_name + "> differ: at the station s = " + text(places[i].s) +
                        " m the radius of <" + name + "> is " + text(places[i].r) + " m and its chord " +
                        text(places[i].chord) + " m, of <" + other->name + "> " + text(others[i].r) + " m and " +
                        text(others[i].chord) + " m" + how);
  }



  void
  Surface::add_states(Station &station, Element &element)
  {
    static const std::array<std::array<std::string, 2>, 4> names = {
      {{{"lag 1", "m/s"}}, {{"lag 2", "m/s"}}, {{"angle of pressure", "rad"}}, {{"separation", "1"}}}};
    station.first_lag = element.lags.size();
    station.unsteady  = unsteady;
    if (unsteady == Unsteady::dynamic_stall && !station.lifts)
      {
        // what never lifts does not stall: nor does its lift follow late
        station.unsteady = Unsteady::quasi_steady;
        without_lift.push_back(station.s);
        airfoil_without_lift = station.section.airfoil->name;
      }
    for (unsigned int i = 0; i < states_of(station.unsteady); ++i)
      element.lags.push_back(
        model->add_state(name + ", " + names[i][0] + " at s = " + number_to_text("%.4g", station.s),
                         names[i][1],
                         i == 3 ? 1. : 0., // attached at the start
                         i < 2 ? air->small_speed() : 1.));
    if (station.unsteady == Unsteady::dynamic_stall)
      {
        const SectionOfWing section = station.section;
        station.section.separation =
          std::make_shared<Separation>([section](const double alpha) { return section.coefficients(alpha, 0.).lift; });
      }
  }



  /** @throws std::invalid_argument if it does not lie across the annuli */
  void
  Surface::add_flow(Station &station, Element &element, AnnularInflow &flow)
  {
    Vector3 along = Vector3::Zero();
    for (unsigned int a = 0; a < element.frames.size(); ++a)
      along += station.N[a] * (model->triad(element.frames[a]) * station.along);
    const Vector3     seen = on_disk(station, element), e1 = model->triad(flow.hub).transpose() * along.normalized();
    const double      r  = seen.head<2>().norm();
    const std::string at = " at s = " + number_to_text("%.4g", station.s);
    station.width        = r > 0 ? std::abs(e1.head<2>().dot(seen.head<2>())) / r : 0.;
    if (r < 1e-3 * flow.radius || station.width < 0.1)
      throw std::invalid_argument("annular inflow is for blades that lie across annuli of the disk of <" + flow.name +
                                  ">, and away from its axis: not the surface" + at + " m");
    station.radius     = r;
    station.first_flow = element.lags.size();
    for (const std::string axis : {"against the thrust axis", "against the azimuth"})
      element.lags.push_back(model->add_state(name + ", inflow " + axis + at,
                                              "m/s",
                                              element.lags.size() == station.first_flow ? flow.initial : 0.,
                                              air->small_speed()));
    flow.add_station(element.lags[station.first_flow], r, station.width * station.weight);
  }



  std::vector<CountedStates>
  Surface::counted_states() const
  {
    CountedStates of_lags, angles, separations, flows;
    const auto    add = [](CountedStates &group, const unsigned int state, const double metric) {
      group.states.push_back(state);
      group.metric.push_back(metric);
    };
    for (const auto &element : elements)
      for (const auto &station : element.stations)
        {
          const double chord = station.section.chord, area = chord * station.weight;
          const auto   state = [&](const unsigned int i) { return element.lags[station.first_lag + i]; };
          for (unsigned int i = 0; i < lags::n && i < states_of(station.unsteady); ++i)
            add(of_lags, state(i), chord * area);
          if (station.unsteady == Unsteady::dynamic_stall)
            {
              add(angles, state(lags::n), area);
              add(separations, state(lags::n + 1), area);
            }
          for (unsigned int i = 0; i < AnnularMomentum::n_states && annular != nullptr; ++i)
            add(flows, element.lags[station.first_flow + i], station.weight * station.width * station.radius);
        }
    std::vector<CountedStates> groups;
    for (auto *const group : {&of_lags, &angles, &separations, &flows})
      if (!group->states.empty())
        groups.push_back(std::move(*group));
    return groups;
  }
} // namespace samara
