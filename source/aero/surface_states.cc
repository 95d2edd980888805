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
    for (const auto &element : elements)
      for (const auto &station : element.stations)
        {
          if (const double r = on_disk(station, element).head<2>().norm(); r > (1 + 1e-6) * inflow->radius)
            {
              model->complaints.add(parameters.where("Inflow"),
                                    "the surface is outside of the disk of <" + inflow_name +
                                      ">: at s = " + number_to_text("%.4g", station.s) + " m it is " +
                                      number_to_text("%.4g", r) + " m from the axis, and the radius is " +
                                      number_to_text("%.4g", inflow->radius) + " m");
              return;
            }
        }
  }



  void
  Surface::add_states(Station &station, Element &element)
  {
    static const std::array<std::array<std::string, 2>, 4> names = {
      {{{"lag 1", "m/s"}}, {{"lag 2", "m/s"}}, {{"angle of pressure", "rad"}}, {{"separation", "1"}}}};
    station.first_lag = element.lags.size();
    for (unsigned int i = 0; i < states_of(unsteady); ++i)
      element.lags.push_back(
        model->add_state(name + ", " + names[i][0] + " at s = " + number_to_text("%.4g", station.s),
                         names[i][1],
                         i == 3 ? 1. : 0., // attached at the start
                         1.));
    if (unsteady == Unsteady::dynamic_stall)
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
    station.first_flow = element.lags.size();
    for (const std::string axis : {"against the thrust axis", "against the azimuth"})
      element.lags.push_back(model->add_state(
        name + ", inflow " + axis + at, "m/s", element.lags.size() == station.first_flow ? flow.initial : 0., 1.));
    flow.add_station(element.lags[station.first_flow], r, station.width * station.weight);
  }
} // namespace samara
