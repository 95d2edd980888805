#include <samara/base/text.h>
#include <samara/cosserat/initial_fields.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    Vector3
    at(const std::array<Expression, 3> &field, const double s)
    {
      return {field[0](s), field[1](s), field[2](s)};
    }

    Vector3
    slope(const std::array<Expression, 3> &field, const double s)
    {
      return {field[0].derivative(s), field[1].derivative(s), field[2].derivative(s)};
    }
  } // namespace



  void
  InitialFields::add_parameters(Parameters &prm)
  {
    const std::string of = ", of the arc length s in metres, inertial components, at the start of a simulation";
    prm.add("Velocity field", velocity, "Velocities along the beam beside the rigid motion above" + of + " [m/s].");
    prm.add("Angular velocity field",
            angular_velocity,
            "The same for sections; not given: those that keep them normal to the line [rad/s].");
    prm.add("Displacement field",
            displacement,
            "Displacements along the beam" + of + " without a static analysis [m].");
    prm.add("Rotation field",
            rotation,
            "Rotation vectors of sections; not given: those that keep them normal to the line [rad].");
    for (const std::string entry : {"Velocity field", "Angular velocity field", "Displacement field", "Rotation field"})
      prm.turns(entry, Turning::direction);
  }



  void
  InitialFields::check(const std::vector<Frame>  &frames,
                       const std::vector<double> &abscissae,
                       const Item                &body,
                       Complaints                &complaints) const
  {
    const auto largest = [&](const std::array<Expression, 3> &field) {
      double most = 0;
      for (const double s : abscissae)
        most = std::max(most, at(field, s).norm());
      return most;
    };
    for (const auto &[entry, field] : {std::make_pair("Velocity field", &velocity),
                                       std::make_pair("Angular velocity field", &angular_velocity),
                                       std::make_pair("Displacement field", &displacement),
                                       std::make_pair("Rotation field", &rotation)})
      {
        const double size = largest(*field);
        if (body.parameters.is_set(entry) && !frames.empty() &&
            std::all_of(frames.begin(), frames.end(), [&](const Frame &frame) { return frame.node == frames[0].node; }))
          complaints.add(body.parameters.where(entry),
                         body.kind + " <" + body.name + "> is rigid; a <" + entry + "> along it makes no sense");
        if (!std::isfinite(size))
          complaints.add(body.parameters.where(entry), std::string("<") + entry + "> is not finite on the beam");
        for (unsigned int i = 0; i < frames.size(); ++i)
          if (frames[i].node == 0 && at(*field, abscissae[i]).norm() > 1e-9 * size)
            {
              complaints.add(body.parameters.where(entry),
                             body.kind + " <" + body.name + "> is welded to the ground at s = " +
                               number_to_text("%.6g", abscissae[i]) + " m, where the <" + entry + "> must be zero");
              break;
            }
      }
  }



  void
  InitialFields::add_places(const std::vector<Frame>                     &frames,
                            const std::vector<double>                    &abscissae,
                            const std::vector<Vector3>                   &tangents,
                            const Item                                   &body,
                            const State                                  &state,
                            std::map<unsigned int, InitialMotion::Place> &places) const
  {
    if (!body.parameters.is_set("Displacement field") && !body.parameters.is_set("Rotation field"))
      return;
    for (unsigned int i = 0; i < frames.size(); ++i)
      if (const unsigned int n = frames[i].node; n != 0)
        {
          const double  s = abscissae[i];
          const Vector3 t = tangents[i], x = frames[i].position(state.q.data());
          const Matrix3 R = body.parameters.is_set("Rotation field") ?
                              rotation_of_vector(at(rotation, s)) :
                              Eigen::Quaterniond::FromTwoVectors(t, t + slope(displacement, s)).toRotationMatrix();
          places[n]       = {x + at(displacement, s) + R * (state.position(n) - x), R * state.triad(n)};
        }
  }



  void
  InitialFields::add_twists(const std::vector<Frame>        &frames,
                            const std::vector<double>       &abscissae,
                            const std::vector<Vector3>      &tangents,
                            const Item                      &body,
                            const State                     &state,
                            std::map<unsigned int, Vector6> &twists) const
  {
    if (!body.parameters.is_set("Velocity field") && !body.parameters.is_set("Angular velocity field"))
      return;
    for (unsigned int i = 0; i < frames.size(); ++i)
      if (const unsigned int n = frames[i].node; n != 0)
        {
          const double  s = abscissae[i];
          const Vector3 w = body.parameters.is_set("Angular velocity field") ?
                              at(angular_velocity, s) :
                              Vector3(tangents[i].cross(slope(velocity, s)));
          const Vector3 v = at(velocity, s) + w.cross(state.position(n) - frames[i].position(state.q.data()));
          const Matrix3 D = state.triad(n);
          twists[n] << D.transpose() * v, D.transpose() * w;
        }
  }
} // namespace samara
