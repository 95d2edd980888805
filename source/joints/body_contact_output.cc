// What users are told of contacts between bodies, and their pictures.

#include <samara/joints/body_contact.h>
#include <samara/model/drawing.h>
#include <samara/model/probe_needs.h>

#include <cmath>

namespace samara
{
  double
  BodyContact::distance(const State &state) const
  {
    return state.coordinates[coordinate + n_measures() - 1] + measures.back().start;
  }



  double
  BodyContact::size_of_rates(const State &state, const unsigned int first, const unsigned int n) const
  {
    return Eigen::Map<const Eigen::VectorXd>(state.rates.data() + coordinate + n_measures() + first, n).norm();
  }



  std::optional<Probe>
  BodyContact::probe(const std::string &path) const
  {
    const unsigned int last = coordinate + n_measures() - 1;
    if (path == "gap")
      return Probe{path, "m", OfPlaces{[this](const State &state) {
                     return direction * (touching - distance(state));
                   }}};
    if (path == "gap rate")
      return Probe{path,
                   "m/s",
                   OfVelocities{{[this, last](const State &state) { return -direction * state.rates[last]; }}}};
    if (path == "force")
      return Probe{path, "N", [this](const State &state) {
                     const double lambda = state.multipliers[first_multiplier + n_measures() - 1];
                     return direction * lambda *
                            (measures.back().is_root ? distance(state) / measures.back().start : 1.);
                   }};
    if (path == "slip" && n_slips > 0)
      return Probe{path,
                   "m/s",
                   OfVelocities{{[this](const State &state) { return size_of_rates(state, 0, n_slips); }}}};
    if (path == "rolling rate" && n_rolls > 0)
      return Probe{path,
                   "rad/s",
                   OfVelocities{{[this](const State &state) { return size_of_rates(state, n_slips, n_rolls); }}}};
    for (const bool is_moment : {false, true})
      {
        const std::string what = is_moment ? "moment" : "friction", unit = is_moment ? "N*m" : "N";
        if (is_moment ? n_rolls + n_turns == 0 : n_slips == 0)
          continue;
        if (path == what)
          return Probe{path, unit, [this, is_moment](const State &state) {
                         return resistance_on_b(state, is_moment).norm();
                       }};
        for (unsigned int i = 0; i < 3; ++i)
          if (path == what + " " + std::to_string(i + 1))
            return Probe{path, unit, [this, is_moment, i](const State &state) {
                           return resistance_on_b(state, is_moment)(i);
                         }};
      }
    return {};
  }



  std::vector<std::string>
  BodyContact::probe_names() const
  {
    std::vector<std::string> names = {"gap", "gap rate", "force"};
    if (n_slips > 0)
      names.insert(names.end(), {"slip", "friction", "friction 1", "friction 2", "friction 3"});
    if (n_rolls > 0)
      names.push_back("rolling rate");
    if (n_rolls + n_turns > 0)
      names.insert(names.end(), {"moment", "moment 1", "moment 2", "moment 3"});
    return names;
  }



  namespace
  {
    /** What a ball of radius @p rounding covers whose centre is in the ellipsoid, but for the curvature of corners. */
    void
    draw_ellipsoid(const Sample &centre, const Vector3 &semi_axes, const double rounding, Drawing &drawing)
    {
      constexpr unsigned int                    n_outlines = 13;
      std::vector<Sample>                       along(n_outlines, centre);
      std::vector<std::vector<Eigen::Vector2d>> outlines;
      const Vector3                             a = semi_axes.array() + rounding;
      for (unsigned int i = 0; i < n_outlines; ++i)
        {
          const double angle = M_PI * (i + 0.25) / (n_outlines - 0.5);
          along[i].x -= std::cos(angle) * a(0) * centre.D.col(0);
          outlines.push_back(ellipse_outline(std::sin(angle) * a(1), std::sin(angle) * a(2)));
        }
      drawing.tube(along, outlines);
    }
  } // namespace



  void
  BodyContact::draw(const State &state, Drawing &drawing) const
  {
    const Sample ball       = drawing.sample(frame_b, state);
    Sample       surface_at = drawing.sample(frame_a, state);
    drawing.begin_object(name);
    if (surface == Surface::ellipsoid)
      draw_ellipsoid(ball, semi_axes, radius, drawing);
    else
      drawing.sphere(ball, radius);
    const Vector3 E3 = surface_at.D.col(2);
    if (surface == Surface::plane || surface == Surface::ellipsoid)
      {
        // a piece of the plane below the ball; it goes along with that
        const Vector3 to_ball = ball.x - surface_at.x;
        surface_at.x += to_ball - (E3.dot(to_ball) + 0.02 * arm) * E3;
        drawing.box(surface_at, arm * Vector3(2, 2, 0.04));
      }
    else if (side == "outside" && surface == Surface::ball)
      drawing.sphere(surface_at, radius_a);
    else if (side == "outside")
      {
        surface_at.x += E3 * E3.dot(ball.x - surface_at.x);
        drawing.cylinder(surface_at, 2, radius_a, 4 * radius);
      }
  }
} // namespace samara
