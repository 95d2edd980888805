// What users say of contacts between bodies, what they are told of them, and their pictures.

#include <samara/base/text.h>
#include <samara/joints/body_contact.h>
#include <samara/model/drawing.h>
#include <samara/model/probe_needs.h>

#include <cmath>

namespace samara
{
  void
  BodyContact::add_entries(Parameters        &prm,
                           const std::string &body_a_is,
                           const std::string &position_is,
                           const std::string &axis_is)
  {
    prm.add("Body A", body_a, body_a_is + ": body.point, or ground.");
    prm.add("Body B", body_b, "Body with the ball: body.point at its centre.");
    prm.add("Position", position, position_is + " in the reference configuration; default: the place of frame A [m].");
    prm.add("Axis", axis, axis_is + ", joint axis 3, inertial components [1].");
    prm.add("Axis 1", axis_1, "Direction near which joint axis 1 lies; 0, 0, 0: any [1].");
    prm.turns("Position", Turning::given_position);
    prm.turns("Axis", Turning::direction);
    prm.turns("Axis 1", Turning::direction);
    prm.add("Radius", radius, "Radius of the ball on body B [m].", dealii::Patterns::Double(0));
    contact.add_parameters(prm, "", false);
    friction.add_parameters(prm, false, false);
  }



  void
  BallOnPlane::add_parameters(Parameters &prm)
  {
    add_entries(prm, "Body with the plane", "A point of the plane", "Normal of the plane, towards the ball");
  }



  void
  BallOnBall::add_parameters(Parameters &prm)
  {
    add_entries(prm,
                "Body with the other ball",
                "The centre of the other ball",
                "Direction in which friction 3 is told; the ball has none itself");
    prm.add("Radius A", radius_a, "Radius of the ball on body A [m].", dealii::Patterns::Double(0));
    prm.add("Side",
            side,
            "Where the ball on body B is: outside of the other, or inside, if that is hollow.",
            dealii::Patterns::Selection("outside|inside"));
  }



  void
  BallOnCylinder::add_parameters(Parameters &prm)
  {
    add_entries(prm, "Body with the cylinder", "A point of the axis of the cylinder", "Axis of the cylinder");
    prm.add("Radius A", radius_a, "Radius of the cylinder [m].", dealii::Patterns::Double(0));
    prm.add("Side",
            side,
            "Where the ball is: outside of the cylinder, or inside, if that is hollow.",
            dealii::Patterns::Selection("outside|inside"));
  }



  bool
  BodyContact::check_entries(Model &m)
  {
    const auto complain = [&](const std::string &entry, const std::string &text) {
      m.complaints.add(parameters.where(entry), "joint <" + name + ">: " + text);
    };
    bool is_good = parameters.require("Radius", m.complaints);
    if (is_good && radius == 0)
      {
        complain("Radius", "the ball must have a radius above zero");
        is_good = false;
      }
    if (surface != Surface::plane)
      {
        if (!parameters.require("Radius A", m.complaints))
          return false;
        if (radius_a == 0 || (side == "inside" && radius_a <= radius))
          {
            complain("Radius A",
                     radius_a == 0 ? "the <Radius A> must be above zero" :
                                     "what the ball is inside of must be larger than it");
            is_good = false;
          }
      }
    if (!contact.is_given())
      {
        complain("Stiffness", "the contact needs a <Stiffness> above zero");
        is_good = false;
      }
    law = contact.law(parameters, "", "joint <" + name + ">", m.complaints);
    if (friction.is_given())
      friction_law = friction.law(parameters, "joint <" + name + ">", m.complaints);
    return is_good;
  }



  void
  BodyContact::measure(Model &m, const Vector3 &gaps)
  {
    const auto complain = [&](const std::string &text) {
      m.complaints.add(parameters.where("Position"), "joint <" + name + ">: " + text);
    };
    const double d = surface == Surface::plane ? gaps(2) :
                     surface == Surface::ball  ? gaps.norm() :
                                                 std::hypot(gaps(0), gaps(1));
    direction      = side == "inside" ? 1. : -1.;
    touching       = surface == Surface::plane ? radius : radius_a - direction * radius;
    start          = {gaps(0), gaps(1), d};
    if (surface != Surface::plane && d < 1e-6 * touching)
      complain(
        "the centre of the ball must not be at the centre, or on the axis, of what it is to touch: from there no "
        "direction leads away");
    else if (direction * (d - touching) > radius)
      complain("the ball presses into " + body_a + " by " + number_to_text("%.4g", direction * (d - touching)) +
               " m in the reference configuration, more than its radius: is it on the right side?");
  }



  void
  BodyContact::initialize(Model &m)
  {
    model            = &m;
    const auto ends  = ends_of_joint(m, *this, body_a, body_b);
    const bool is_ok = check_entries(m);
    if (!ends || !is_ok)
      return;
    Matrix3 E;
    try
      {
        E = axes();
      }
    catch (const std::invalid_argument &problem)
      {
        return m.complaints.add(parameters.where("Axis"), "joint <" + name + ">: " + problem.what());
      }
    if (!parameters.is_set("Position"))
      position = m.position((*ends)[0]);
    const Vector3 centre = m.position((*ends)[1]);
    measure(m, E.transpose() * (centre - position));
    frame_a    = m.frame_at((*ends)[0], position, E);
    frame_b    = m.frame_at((*ends)[1], centre, E);
    n_measures = surface == Surface::cylinder ? 3 : 1;
    n_slips    = !friction.is_given() ? 0 : surface == Surface::ball ? 3 : 2;
    for (unsigned int i = 0; i < n_measures; ++i)
      {
        const unsigned int number =
          m.add_coordinate(name + (i + 1 < n_measures ? ".place " + std::to_string(i + 1) : ".distance"), "m");
        if (i == 0)
          coordinate = number;
      }
    for (unsigned int i = 0; i < n_slips; ++i)
      m.add_coordinate(name + ".slip " + std::to_string(i + 1), "m");
  }



  void
  BodyContact::connect(Layout &layout)
  {
    frame_a = layout.model.resolved(frame_a);
    frame_b = layout.model.resolved(frame_b);
    if (!check_ends(*model, *this, frame_a, frame_b, "<" + body_a + "> and <" + body_b + ">"))
      return;
    std::vector<std::string>  names;
    std::vector<unsigned int> coordinates, multipliers, slips;
    for (unsigned int i = 0; i < n_measures; ++i)
      names.push_back("joint " + name + ", measure of the " +
                      (i + 1 < n_measures ? "place " + std::to_string(i + 1) : "distance"));
    for (unsigned int i = 0; i < n_slips; ++i)
      {
        names.push_back("joint " + name + ", slip " + std::to_string(i + 1));
        slips.push_back(coordinate + n_measures + i);
      }
    first_multiplier = layout.add_multipliers(names);
    for (unsigned int i = 0; i < names.size(); ++i)
      {
        coordinates.push_back(coordinate + i);
        multipliers.push_back(first_multiplier + i);
      }
    for (unsigned int i = n_measures; i < names.size(); ++i)
      layout.nonholonomic.push_back(first_multiplier + i);
    layout.couple(own_block, {{frame_a.node}, {frame_b.node}}, coordinates, multipliers);
    make_term();
    layout.add(*this, *term);

    forces.clear();
    const unsigned int stop = forces.add_stop(
      layout,
      *this,
      {coordinate + n_measures - 1, touching - start(2), direction, law, true, "joint " + name + ", contact"});
    if (n_slips == 0)
      return;
    Layout::Friction f;
    f.coordinates = slips;
    f.law         = friction_law;
    f.stop        = stop;
    f.name        = "joint " + name + ", friction of the contact";
    forces.add_friction(layout, *this, f);
  }



  double
  BodyContact::distance(const State &state) const
  {
    return state.coordinates[coordinate + n_measures - 1] + start(2);
  }



  std::optional<Probe>
  BodyContact::probe(const std::string &path) const
  {
    const unsigned int last = coordinate + n_measures - 1;
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
                     const double lambda = state.multipliers[first_multiplier + n_measures - 1];
                     return direction * lambda * (surface == Surface::plane ? 1. : distance(state) / start(2));
                   }};
    if (n_slips == 0)
      return {};
    if (path == "slip")
      return Probe{path, "m/s", OfVelocities{{[this](const State &state) {
                     return Eigen::Map<const Eigen::VectorXd>(&state.rates[coordinate + n_measures], n_slips).norm();
                   }}}};
    if (path == "friction")
      return Probe{path, "N", [this](const State &state) { return friction_on_b(state).norm(); }};
    for (unsigned int i = 0; i < 3; ++i)
      if (path == "friction " + std::to_string(i + 1))
        return Probe{path, "N", [this, i](const State &state) { return friction_on_b(state)(i); }};
    return {};
  }



  std::vector<std::string>
  BodyContact::probe_names() const
  {
    std::vector<std::string> names = {"gap", "gap rate", "force"};
    if (n_slips > 0)
      names.insert(names.end(), {"slip", "friction", "friction 1", "friction 2", "friction 3"});
    return names;
  }



  void
  BodyContact::draw(const State &state, Drawing &drawing) const
  {
    const Sample ball       = drawing.sample(frame_b, state);
    Sample       surface_at = drawing.sample(frame_a, state);
    drawing.begin_object(name);
    drawing.sphere(ball, radius);
    const Vector3 E3 = surface_at.D.col(2);
    if (surface == Surface::plane)
      {
        // a piece of the plane below the ball; it goes along with that
        const Vector3 to_ball = ball.x - surface_at.x;
        surface_at.x += to_ball - (E3.dot(to_ball) + 0.02 * radius) * E3;
        drawing.box(surface_at, radius * Vector3(2, 2, 0.04));
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
