#include <samara/base/text.h>
#include <samara/joints/rolling.h>
#include <samara/model/drawing.h>

#include <cmath>

namespace samara
{
  void
  RollingBall::add_parameters(Parameters &prm)
  {
    locked.push_back({{PairFunction::gap, 2}, "distance from the plane", 0., 2});
    no_slip.push_back({{PairVelocity::rolling, 0}, "rolling 1", 0});
    no_slip.push_back({{PairVelocity::rolling, 1}, "rolling 2", 1});
    prm.add("Body A", body_a, "Body with the plane: body.point, or ground.");
    prm.add("Body B", body_b, "The ball: body.point at its centre.");
    prm.add("Radius", radius, "Radius of the ball [m].", dealii::Patterns::Double(0));
    prm.add("Position",
            position,
            "A point of the plane in the reference configuration; default: that below the ball [m].");
    prm.add(
      "Axis",
      axis,
      "Normal of the plane (joint axis 3) in the reference configuration, towards the ball, inertial components [1].");
    prm.add("Axis 1", axis_1, "Direction near which joint axis 1 lies; 0, 0, 0: any [1].");
    prm.turns("Position", Turning::given_position);
    prm.turns("Axis", Turning::direction);
    prm.turns("Axis 1", Turning::direction);
  }



  void
  RollingBall::initialize(Model &model)
  {
    if (!parameters.require("Radius", model.complaints))
      return;
    if (radius == 0.)
      return model.complaints.add(parameters.where("Radius"),
                                  "joint <" + name + ">: the ball must have a radius above zero");
    Joint::initialize(model);
  }



  void
  RollingBall::place(Model &model, const Frame &a, const Frame &b)
  {
    const Matrix3 E      = axes();
    const Vector3 centre = model.position(b);
    if (!parameters.is_set("Position"))
      position = centre - radius * E.col(2);
    frame_a = model.frame_at(a, position, E);
    frame_b = model.frame_at(b, centre, E);
    for (auto &s : no_slip)
      s.velocity.radius = radius;

    const double distance = E.col(2).dot(centre - position);
    locked[0].value       = distance;
    if (parameters.is_set("Position") && std::abs(distance - radius) > 1e-9 * radius)
      model.complaints.add(parameters.where("Position"),
                           "joint <" + name + ">: the centre of the ball is " + number_to_text(distance) +
                             " m above the plane (to the side where <Axis> points), not its radius, " +
                             number_to_text(radius) + " m; without a <Position> the plane is put there");
  }



  std::optional<Probe>
  RollingBall::probe(const std::string &path) const
  {
    for (const unsigned int i : {0, 1})
      if (path == "displacement " + std::to_string(i + 1))
        return Probe{
          path, "m", [this, i](const State &state) {
            return PairFunction{PairFunction::gap, i}.value(PairValues<double>(frame_a, frame_b, state.q.data()));
          }};
    return Joint::probe(path);
  }



  std::vector<std::string>
  RollingBall::probe_names() const
  {
    std::vector<std::string> names = Joint::probe_names();
    names.insert(names.begin(), {"displacement 1", "displacement 2"});
    return names;
  }



  void
  RollingBall::draw(const State &state, Drawing &drawing) const
  {
    const Sample ball = drawing.sample(frame_b, state);
    drawing.begin_object(name);
    drawing.sphere(ball, radius);
    // a piece of the plane, where the ball touches it; it goes along with the ball
    Sample plate = ball;
    plate.D      = frame_a.triad(state.q.data());
    plate.x      = ball.x - 1.02 * radius * plate.D.col(2);
    drawing.box(plate, radius * Vector3(2, 2, 0.04));
  }



  void
  KnifeEdge::add_parameters(Parameters &prm)
  {
    no_slip.push_back({{PairVelocity::skating, 0}, "velocity across the blade", 0});
    axis = Vector3::UnitX();
    gap  = "allowed"; // the blade may be anywhere on body A
    prm.add("Body A", body_a, "Body on which the blade moves: body.point, or ground.");
    prm.add("Body B", body_b, "Body with the blade.");
    prm.add("Position", position, "Place of the blade in the reference configuration; default: that of frame B [m].");
    prm.add(
      "Axis",
      axis,
      "Direction across the blade (joint axis 1), fixed to body B, in the reference configuration, inertial components "
      "[1].");
    prm.turns("Position", Turning::given_position);
    prm.turns("Axis", Turning::direction);
  }



  void
  KnifeEdge::be_moved(const MotionOf &motion_of)
  {
    be_placed(motion_of(body_b));
  }



  Matrix3
  KnifeEdge::axes() const
  {
    // axis 3 becomes axis 1
    const Matrix3 E = Joint::axes();
    Matrix3       D;
    D << E.col(2), E.col(0), E.col(1);
    return D;
  }



  void
  KnifeEdge::draw(const State &state, Drawing &drawing) const
  {
    drawing.begin_object(name);
    drawing.cylinder(drawing.sample(frame_b, state), 0, draw_size, 0.1 * draw_size);
  }
} // namespace samara
