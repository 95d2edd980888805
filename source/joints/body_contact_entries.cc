// What users say of contacts between bodies, and what becomes of it.

#include <samara/base/text.h>
#include <samara/joints/body_contact.h>

#include <cmath>

namespace samara
{
  void
  BodyContact::add_common_entries(Parameters        &prm,
                                  const std::string &body_a_is,
                                  const std::string &body_b_is,
                                  const std::string &position_is,
                                  const std::string &axis_is)
  {
    prm.add("Body A", body_a, body_a_is + ": body.point, or ground.");
    prm.add("Body B", body_b, body_b_is + ": body.point at its centre.");
    prm.add("Position", position, position_is + " in the reference configuration; default: the place of frame A [m].");
    prm.add("Axis", axis, axis_is + ", joint axis 3, inertial components [1].");
    prm.add("Axis 1", axis_1, "Direction near which joint axis 1 lies; 0, 0, 0: any [1].");
    prm.turns("Position", Turning::given_position);
    prm.turns("Axis", Turning::direction);
    prm.turns("Axis 1", Turning::direction);
    contact.add_parameters(prm, "", false);
    friction.add_parameters(prm, false, false);
    const std::string of_arm =
      surface == Surface::ellipsoid ? "the largest semi-axis with the rounding" : "the <Radius>";
    prm.add("Rolling friction",
            rolling,
            "Moment against rolling as part of the force that presses times " + of_arm + " [1].",
            dealii::Patterns::Double(0));
    prm.add("Turning friction",
            turning,
            "The same about the normal of the surfaces, against turning on the spot [1].",
            dealii::Patterns::Double(0));
  }



  void
  BodyContact::add_entries(Parameters        &prm,
                           const std::string &body_a_is,
                           const std::string &position_is,
                           const std::string &axis_is)
  {
    add_common_entries(prm, body_a_is, "Body with the ball", position_is, axis_is);
    prm.add("Radius", radius, "Radius of the ball on body B [m].", dealii::Patterns::Double(0));
  }



  void
  EllipsoidOnPlane::add_parameters(Parameters &prm)
  {
    add_common_entries(prm,
                       "Body with the plane",
                       "Body with the ellipsoid",
                       "A point of the plane",
                       "Normal of the plane, towards the ellipsoid");
    prm.add("Semi-axes",
            semi_axes,
            "Of the ellipsoid, along its three axes; one may be zero, if there is a <Rounding> or not: a disc [m].");
    prm.add("Rounding",
            radius,
            "Radius of a ball whose centre is everywhere in the ellipsoid: what it covers is the shape [m].",
            dealii::Patterns::Double(0));
    prm.add(
      "Axis on B",
      axis_b,
      "Third axis of the ellipsoid, inertial components in the reference configuration; default: the one of frame "
      "B [1].");
    prm.add("Axis 1 on B", axis_b_1, "Direction near which its first axis lies, to be given with the third one [1].");
    prm.turns("Semi-axes", Turning::own_axes);
    prm.turns("Axis on B", Turning::direction);
    prm.turns("Axis 1 on B", Turning::direction);
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



  void
  BodyContact::complain(Model &m, const std::string &entry, const std::string &text) const
  {
    m.complaints.add(parameters.where(entry), "joint <" + name + ">: " + text);
  }



  bool
  BodyContact::check_shape(Model &m)
  {
    if (surface == Surface::ellipsoid)
      {
        if (!parameters.require("Semi-axes", m.complaints))
          return false;
        if (semi_axes.minCoeff() < 0 || (semi_axes.array() > 0).count() < 2)
          {
            complain(m, "Semi-axes", "the <Semi-axes> must not be negative, and at most one of them may be zero");
            return false;
          }
        if (axis_b.isZero(0.) != axis_b_1.isZero(0.))
          {
            complain(m, "Axis on B", "the <Axis on B> and the <Axis 1 on B> belong together");
            return false;
          }
        return true;
      }
    bool is_good = parameters.require("Radius", m.complaints);
    if (is_good && radius == 0)
      {
        complain(m, "Radius", "the ball must have a radius above zero");
        is_good = false;
      }
    if (surface == Surface::plane)
      return is_good;
    if (!parameters.require("Radius A", m.complaints))
      return false;
    if (radius_a == 0 || (side == "inside" && radius_a <= radius))
      {
        complain(m,
                 "Radius A",
                 radius_a == 0 ? "the <Radius A> must be above zero" :
                                 "what the ball is inside of must be larger than it");
        is_good = false;
      }
    return is_good;
  }



  bool
  BodyContact::check_entries(Model &m)
  {
    bool is_good = check_shape(m);
    if (!contact.is_given())
      {
        complain(m, "Stiffness", "the contact needs a <Stiffness> above zero");
        is_good = false;
      }
    law = contact.law(parameters, "", "joint <" + name + ">", m.complaints);
    if (friction.is_given())
      friction_law = friction.law(parameters, "joint <" + name + ">", m.complaints);
    else
      friction.refuse_unused(
        parameters, "joint <" + name + ">", m.complaints, {}, rolling > 0 || turning > 0 ? "Sticking speed" : "");
    if ((rolling > 0 || turning > 0) && friction.sticking_speed == 0)
      complain(m, "Sticking speed", "the <Sticking speed> must be above zero");
    return is_good;
  }



  void
  BodyContact::measure(Model &m, const Vector3 &gaps, const Matrix3 &cosines)
  {
    using F     = PairFunction;
    direction   = side == "inside" ? 1. : -1.;
    touching    = surface == Surface::plane || surface == Surface::ellipsoid ? radius : radius_a - direction * radius;
    arm         = radius;
    double half = radius; // of what is between the centre and the surface
    measures.clear();
    switch (surface)
      {
        case Surface::plane:
          measures = {{"distance", "m", gaps(2), F{F::gap, 2}}};
          break;
        case Surface::ball:
          measures = {{"distance", "m", gaps.norm(), F{F::squared_distance}, true}};
          break;
        case Surface::cylinder:
          measures = {{"place 1", "m", gaps(0), F{F::gap, 0}},
                      {"place 2", "m", gaps(1), F{F::gap, 1}},
                      {"distance", "m", std::hypot(gaps(0), gaps(1)), {}, true, {{0, 1.}, {1, 1.}}}};
          break;
        case Surface::ellipsoid:
          {
            const Vector3 normal = cosines.row(2), a_2 = semi_axes.cwiseAbs2();
            const double  h = std::sqrt(a_2.dot(normal.cwiseAbs2()));
            for (unsigned int j = 0; j < 3; ++j)
              measures.push_back({"cosine " + std::to_string(j + 1), "1", normal(j), F{F::cosine, 2, j}});
            measures.push_back({"height", "m", h, {}, true, {{0, a_2(0)}, {1, a_2(1)}, {2, a_2(2)}}});
            measures.push_back({"distance", "m", gaps(2) - h, F{F::gap, 2}, false, {}, 3});
            half += h;
            arm += semi_axes.maxCoeff();
            if (h < 1e-6 * semi_axes.maxCoeff())
              return complain(m,
                              "Semi-axes",
                              "a disc that lies flat on the plane touches it everywhere, not at a point");
          }
      }
    const double d = measures.back().start;
    if (measures.back().is_root && d < 1e-6 * touching)
      complain(
        m,
        "Position",
        "the centre of the ball must not be at the centre, or on the axis, of what it is to touch: from there no "
        "direction leads away");
    else if (direction * (d - touching) > half)
      complain(m,
               "Position",
               std::string("the ") + (surface == Surface::ellipsoid ? "ellipsoid" : "ball") + " presses into " +
                 body_a + " by " + number_to_text("%.4g", direction * (d - touching)) +
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
    Matrix3 E, B;
    for (const bool is_b : {false, true})
      try
        {
          if (!is_b)
            E = axes();
          else
            B = surface != Surface::ellipsoid ? E :
                axis_b.isZero(0.)             ? m.triad((*ends)[1]) :
                                                triad_about(axis_b, axis_b_1);
        }
      catch (const std::invalid_argument &problem)
        {
          return complain(m, is_b ? "Axis on B" : "Axis", problem.what());
        }
    if (!parameters.is_set("Position"))
      position = m.position((*ends)[0]);
    const Vector3 centre = m.position((*ends)[1]);
    measure(m, E.transpose() * (centre - position), E.transpose() * B);
    frame_a = m.frame_at((*ends)[0], position, E);
    frame_b = m.frame_at((*ends)[1], centre, B);
    add_unknowns(m);
  }



  void
  BodyContact::add_unknowns(Model &m)
  {
    const unsigned int n_directions = surface == Surface::ball ? 3 : 2;
    n_slips                         = friction.is_given() ? n_directions : 0;
    n_rolls                         = rolling > 0 ? n_directions : 0;
    n_turns                         = turning > 0 ? 1 : 0;
    for (unsigned int i = 0; i < n_measures(); ++i)
      {
        const unsigned int number = m.add_coordinate(name + "." + measures[i].name, measures[i].unit);
        if (i == 0)
          coordinate = number;
      }
    for (unsigned int i = 0; i < n_slips; ++i)
      m.add_coordinate(name + ".slip " + std::to_string(i + 1), "m");
    for (unsigned int i = 0; i < n_rolls; ++i)
      m.add_coordinate(name + ".rolling " + std::to_string(i + 1), "rad");
    for (unsigned int i = 0; i < n_turns; ++i)
      m.add_coordinate(name + ".turning", "rad");
    for (unsigned int i = 0; i < n_slips && friction_law.has_bristles(); ++i)
      bristles.push_back(m.add_state(name + ".bristles " + std::to_string(i + 1), "m", 0., 1.));
  }



  void
  BodyContact::connect(Layout &layout)
  {
    frame_a = layout.model.resolved(frame_a);
    frame_b = layout.model.resolved(frame_b);
    if (!check_ends(*model, *this, frame_a, frame_b, "<" + body_a + "> and <" + body_b + ">"))
      return;
    std::vector<std::string>  names;
    std::vector<unsigned int> coordinates, multipliers;
    for (const Measure &m : measures)
      names.push_back("measure of the " + m.name);
    for (unsigned int i = 0; i < n_slips; ++i)
      names.push_back("slip " + std::to_string(i + 1));
    for (unsigned int i = 0; i < n_rolls; ++i)
      names.push_back("rolling " + std::to_string(i + 1));
    for (unsigned int i = 0; i < n_turns; ++i)
      names.push_back("turning");
    first_multiplier = layout.add_multipliers(*this, names);
    for (unsigned int i = 0; i < names.size(); ++i)
      {
        coordinates.push_back(coordinate + i);
        multipliers.push_back(first_multiplier + i);
      }
    // a root is found on its other branch, too: a disc that has lain flat, a ball behind the centre, would touch
    // nothing
    for (unsigned int i = 0; i < n_measures(); ++i)
      if (measures[i].is_root)
        model->lengths[coordinate + i] = measures[i].start;
    for (unsigned int i = n_measures(); i < names.size(); ++i)
      layout.nonholonomic.push_back(first_multiplier + i);
    layout.couple(own_block, {{frame_a.node}, {frame_b.node}}, coordinates, multipliers);
    make_term();
    layout.add(*this, *term);

    forces.clear();
    const Measure &last = measures.back();
    add_frictions(
      layout,
      forces.add_stop(
        layout,
        *this,
        {coordinate + n_measures() - 1, touching - last.start, direction, law, true, "joint " + name + ", contact"}));
  }



  void
  BodyContact::add_frictions(Layout &layout, const unsigned int stop)
  {
    unsigned int first = coordinate + n_measures();
    const auto add = [&](const unsigned int n, const FrictionLaw &by, const double with_arm, const std::string &what) {
      if (n == 0)
        return;
      Layout::Friction f;
      for (unsigned int i = 0; i < n; ++i)
        f.coordinates.push_back(first++);
      f.arm  = with_arm;
      f.law  = by;
      f.stop = stop;
      f.name = "joint " + name + ", " + what;
      if (by.has_bristles())
        f.states = bristles;
      forces.add_friction(layout, *this, f);
    };
    const auto of_moment = [&](const double coefficient) {
      FrictionLaw by;
      by.kinetic = by.breakaway = coefficient;
      by.sticking_speed         = friction.sticking_speed;
      return by;
    };
    add(n_slips, friction_law, 1., "friction of the contact");
    add(n_rolls, of_moment(rolling), arm, "resistance to rolling");
    add(n_turns, of_moment(turning), arm, "resistance to turning");
  }
} // namespace samara
