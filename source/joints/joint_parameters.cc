// What users say of a joint, and where its frames are.

#include <samara/base/text.h>
#include <samara/joints/joint.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace samara
{
  std::optional<std::array<Frame, 2>>
  ends_of_joint(Model &model, const Item &joint, const std::string &body_a, const std::string &body_b)
  {
    std::array<Frame, 2> ends;
    bool                 are_known = true;
    for (unsigned int i = 0; i < 2; ++i)
      {
        const std::string entry = i == 0 ? "Body A" : "Body B";
        try
          {
            if (joint.parameters.require(entry, model.complaints))
              ends[i] = model.frame(i == 0 ? body_a : body_b);
            else
              are_known = false;
          }
        catch (const std::invalid_argument &problem)
          {
            model.complaints.add(joint.parameters.where(entry), problem.what());
            are_known = false;
          }
      }
    if (!are_known)
      return {};
    if (ends[0].node != ends[1].node)
      return ends;
    // a body that could not be made has complained already; its frames are those of the ground
    if (ends[0].node != 0 || (body_a == "ground" && body_b == "ground"))
      model.complaints.add(joint.parameters.where("Body B"),
                           "joint <" + joint.name + "> connects a body to itself: <" + body_a + "> and <" + body_b +
                             "> cannot move against each other");
    return {};
  }



  const char *const documentation_of_gap =
    "Whether the two points that are named may be apart in the reference configuration where no Position is given; "
    "allowed: the joint is at frame B, a rigid arm goes to frame A.";
  const char *const documentation_of_closed_gap =
    " Closed: the bodies are moved until the points meet; Position, where it is given, is then that of the point on A, or "
    "on B if that is the ground or named without a point.";



  namespace
  {
    /** Whether a path names a point; a rigid body may be held anywhere: its centre is the body itself. */
    bool
    is_point(const std::string &path)
    {
      const auto dot = path.find('.');
      return dot != std::string::npos && trim(path.substr(dot + 1)) != "centre";
    }

    /** "<rod.end> at (1, 0, 0)" */
    std::string
    place_to_text(const std::string &point, const std::string &at, const Vector3 &x)
    {
      std::ostringstream text;
      text << "<" << point << "> " << at << " (" << x(0) + 0. << ", " << x(1) + 0. << ", " << x(2) + 0. << ")"; // no -0
      return text.str();
    }
  } // namespace



  void
  check_gap(Model                      &model,
            const Item                 &joint,
            const std::array<Frame, 2> &ends,
            const std::string          &body_a,
            const std::string          &body_b,
            const std::string          &gap)
  {
    // drawings are rounded: what is smaller, in proportion to the model, is not meant
    constexpr double rounding = 1e-5;
    if (gap == "allowed" || joint.parameters.is_set("Position") || !is_point(body_a) || !is_point(body_b))
      return;
    const Vector3 a = model.position(ends[0]), b = model.position(ends[1]);
    const double  distance = (b - a).norm();
    if (distance <= 1e-12 * b.norm() || distance <= rounding * box_diagonal(model))
      return;
    std::ostringstream how_far;
    how_far << distance << " m apart: ";
    model.complaints.add(joint.parameters.where("Body B"),
                         "joint <" + joint.name + ">: the points it connects are " + how_far.str() +
                           place_to_text(body_a, "is at", a) + ", " + place_to_text(body_b, "at", b) +
                           ". Let them meet, or name other points; if a rigid arm is meant, say where the joint is by "
                           "<Position>, or <Gap = allowed>: then it is at <" +
                           body_b +
                           ">; if the drawing is rough, <Gap = closed> moves the bodies until the points meet");
  }



  bool
  check_ends(Model &model, const Item &joint, const Frame &a, const Frame &b, const std::string &between)
  {
    if (a.node != b.node)
      return true;
    model.complaints.add(joint.parameters.where("Body B"),
                         "joint <" + joint.name + ">: " + between + " are " +
                           (a.node == 0 ? "both welded to the ground" : "welded together") +
                           " by rigid joints and cannot move against each other");
    return false;
  }



  void
  Joint::add_parameters(Parameters &prm)
  {
    add_ends(prm);
    prm.add("Axis", axis, "Direction of joint axis 3 in the reference configuration, inertial components [1].");
    prm.add("Axis 1", axis_1, "Direction near which joint axis 1 lies; 0, 0, 0: any [1].");
    prm.turns("Axis", Turning::direction);
    prm.turns("Axis 1", Turning::direction);
    const bool aligns = !free.empty() && std::any_of(locked.begin(), locked.end(), [](const Locked &l) {
      return l.function.kind == PairFunction::cosine && l.function.i == 2;
    });
    if (aligns)
      {
        prm.add("Axis on B",
                axis_on_b,
                "Direction of joint axis 3 on body B as that is drawn, if its drawing is turned and Gap = closed is to "
                "turn it; 0, 0, 0: that of Axis [1].");
        prm.turns("Axis on B", Turning::direction);
      }
    add_motions(prm);
  }



  void
  Joint::be_placed(const Placement &placement)
  {
    // the axis that is chosen where none is given is chosen in the axes of the subsystem
    if (parameters.has("Axis 1") && axis_1.isZero(0.))
      parameters.assign("Axis 1", Vector3(triad_about(axis).col(0)));
    Item::be_placed(placement);
  }



  void
  Joint::be_moved(const MotionOf &motion_of)
  {
    const Vector3   drawn_axis = axis_on_b, drawn_position = position;
    const Placement of_b = motion_of(body_b);
    be_placed(motion_of(body_a));
    if (!axis_on_b.isZero(0.))
      parameters.assign("Axis on B", Vector3(of_b.rotation * drawn_axis));
    if (position_is_on_b())
      parameters.assign("Position", of_b.point(drawn_position));
  }



  bool
  Joint::position_is_on_b() const
  {
    return gap == "closed" && (parameters.has("Position") && parameters.is_set("Position")) && is_point(body_a) &&
           !is_point(body_b);
  }



  bool
  Joint::closes_gap() const
  {
    return gap == "closed" || (closes_all_gaps && gap == "refused" && parameters.has("Gap") &&
                               !(parameters.has("Position") && parameters.is_set("Position")));
  }



  void
  Joint::add_ends(Parameters &prm)
  {
    prm.add("Body A", body_a, "First frame: body.point, or ground.");
    prm.add("Body B", body_b, "Second frame; relative motions are those of B seen from A.");
    prm.add("Position", position, "Place of the joint in the reference configuration; default: that of frame B [m].");
    prm.add("Gap",
            gap,
            std::string(documentation_of_gap) + documentation_of_closed_gap,
            dealii::Patterns::Selection("refused|allowed|closed"));
    prm.turns("Position", Turning::given_position);
  }



  void
  Joint::add_two_points(Parameters &prm)
  {
    prm.add("Body A", body_a, "First point: body.point, or ground.");
    prm.add("Body B", body_b, "Second point.");
    prm.add("Position",
            position,
            "Place of the end on body A in the reference configuration; default: that of frame A [m].");
    prm.turns("Position", Turning::given_position);
    add_motions(prm);
  }



  Frame
  Joint::end_on_a(const Model &model, const Frame &a) const
  {
    return parameters.is_set("Position") ? model.frame_at(a, position, Matrix3::Identity()) : a;
  }



  void
  Joint::add_motions(Parameters &prm)
  {
    // on a plane friction acts against the slip in both directions at once, on a thread along it: subsection <thread>
    const auto is_displacement = [](const FreeMotion &m) { return m.first.kind == PairFunction::gap; };
    const bool is_on_plane     = std::count_if(free.begin(), free.end(), is_displacement) > 1;
    for (auto &motion : free)
      {
        motion.may_rub = !is_screw && !(is_on_plane && is_displacement(motion));
        motion.add_parameters(prm.subsection(motion.name));
      }
  }



  void
  Joint::lock_displacement(const unsigned int i)
  {
    locked.push_back({{PairFunction::gap, i}, "displacement " + std::to_string(i + 1), 0., i});
  }



  void
  Joint::lock_rotation(const unsigned int i, const unsigned int j)
  {
    // the multiplier is a moment of B on A about E_j × E_i, which is plus or minus the third axis
    const unsigned int k    = 3 - i - j;
    const double       sign = (i + 1) % 3 == j ? 1. : -1.;
    locked.push_back({{PairFunction::cosine, i, j}, "rotation " + std::to_string(k + 1), 0., k, sign});
  }



  void
  Joint::lock_twist()
  {
    locked.push_back({{PairFunction::cosine, 0, 1}, "rotation 3", 0., 2, 1.});
    locked.back().less = PairFunction{PairFunction::cosine, 1, 0};
  }



  FreeMotion &
  Joint::free_displacement(const unsigned int i, const std::string &name)
  {
    free.emplace_back();
    free.back().name  = name;
    free.back().unit  = "m";
    free.back().first = {PairFunction::gap, i};
    free.back().axis  = i;
    return free.back();
  }



  FreeMotion &
  Joint::free_rotation_about_3(const std::string &name)
  {
    free.emplace_back();
    free.back().name   = name;
    free.back().unit   = "rad";
    free.back().first  = {PairFunction::cosine, 0, 0};
    free.back().second = {PairFunction::cosine, 1, 0};
    return free.back();
  }



  Matrix3
  Joint::axes() const
  {
    Assert(!axis.isZero(0.), dealii::ExcMessage("an axis of no length"));
    return triad_about(axis, axis_1);
  }



  void
  Joint::place_apart(Model &model, const Frame &a, const Frame &b)
  {
    const Matrix3 E    = axes();
    Vector3       at_a = model.position(a), at_b = model.position(b);
    if (parameters.is_set("Position"))
      {
        at_a = position_is_on_b() ? at_a : position;
        at_b = is_point(body_b) ? at_b : position;
      }
    else if (!is_point(body_a) || !is_point(body_b))
      at_a = at_b; // where the other is held is not said
    frame_a = model.frame_at(a, at_a, E);
    if (axis_on_b.isZero(0.))
      frame_b = model.frame_at(b, at_b, E);
    else
      {
        const auto turn = Eigen::Quaterniond::FromTwoVectors(E.col(2), axis_on_b);
        frame_b         = model.frame_at(b, at_b, turn.toRotationMatrix() * E);
      }
  }



  void
  Joint::check_axis_on_b(Model &model) const
  {
    constexpr double rounding = 1e-5;
    if (!axis_on_b.isZero(0.) && axis.normalized().cross(axis_on_b.normalized()).norm() > rounding)
      complain(
        model,
        "Axis on B",
        "joint <" + name +
          ">: its axes on the two bodies are not parallel; with <Gap = closed> the bodies are turned until they are");
  }



  void
  Joint::place(Model &model, const Frame &a, const Frame &b)
  {
    const bool closes = closes_gap();
    if (closes && gaps == Gaps::open)
      return place_apart(model, a, b);
    check_axis_on_b(model);
    if (!closes || gaps != Gaps::closed)
      check_gap(model, *this, {a, b}, body_a, body_b, gap);
    else
      {
        // the bodies have been moved: now the points must meet, in the directions that the joint holds
        place_apart(model, a, b);
        constexpr double rounding = 1e-5; // as in check_gap()
        const Vector3    apart    = axes().transpose() * (model.position(frame_b) - model.position(frame_a));
        for (const auto &l : locked)
          if (l.function.kind == PairFunction::gap &&
              !(std::abs(apart(l.function.i)) <= rounding * box_diagonal(model)))
            return complain(model,
                            "Gap",
                            "joint <" + name + ">: the assembly has left a gap of " +
                              number_to_text("%.3g", std::abs(apart(l.function.i))) + " m; draw its bodies nearer");
      }
    if (!parameters.is_set("Position"))
      position = model.position(b);
    const Matrix3 E = axes();
    frame_a         = model.frame_at(a, position, E);
    frame_b         = model.frame_at(b, position, E);
  }



  void
  Joint::complain(Model &model, const std::string &entry, const std::string &text) const
  {
    model.complaints.add(parameters.where(entry), text);
  }



  void
  Joint::initialize(Model &m)
  {
    model           = &m;
    const auto ends = ends_of_joint(m, *this, body_a, body_b);
    if (!ends)
      return;
    try
      {
        place(m, (*ends)[0], (*ends)[1]);
      }
    catch (const std::invalid_argument &problem)
      {
        return complain(m, "Axis", problem.what());
      }
    for (auto &motion : free)
      {
        motion.check_parameters(parameters.subsection(motion.name), m.complaints);
        if (motion.is_used() || is_screw)
          use_coordinate(m, motion.name);
        if (motion.friction.is_given())
          check_friction(m, motion);
        motion.add_bristles(m, name);
      }
    check_bearing_length(m);
  }



  void
  Joint::find_signals(Model &model)
  {
    const auto find =
      [&](const FreeMotion &motion, const std::string &entry, const Law &law) -> std::unique_ptr<Response> {
      if (law.depends_on_state())
        try
          {
            return std::make_unique<Response>(law, model);
          }
        catch (const std::invalid_argument &problem)
          {
            model.complaints.add(parameters.subsection(motion.name).where(entry), problem.what());
          }
      return nullptr;
    };
    for (auto &motion : free)
      {
        if (!motion.spring_law.is_zero())
          find_nonlinear_spring(model, motion);
        // of a damper that is a law, the force is one
        if (!motion.damping.is_constant() &&
            (!motion.damping.depends_on_state() || find(motion, "Damper", motion.damping)))
          motion.force = Law::combination({motion.force, motion.damping.times(name + "." + motion.name + " rate"), {}},
                                          Eigen::RowVector3d(1, -1, 0),
                                          0);
        motion.response = find(motion, motion.is_angle() ? "Moment" : "Force", motion.force);
        motion.drive    = find(motion, "Prescribed", motion.prescribed);
        if (motion.drive && !motion.drive->is_of_states())
          model.complaints.add(
            parameters.subsection(motion.name).where("Prescribed"),
            "what is prescribed may depend on time and on states of first order only; let a state follow the "
            "motion, or a force");
      }
  }



  std::shared_ptr<Signal>
  Joint::signal(Model &model, const std::string &path)
  {
    const std::string rate = " rate";
    const bool is_rate = path.size() > rate.size() && path.compare(path.size() - rate.size(), rate.size(), rate) == 0;
    const std::string wanted = is_rate ? path.substr(0, path.size() - rate.size()) : path;
    for (const auto &motion : free)
      if (motion.name == wanted)
        {
          const unsigned int i = *use_coordinate(model, wanted);
          return is_rate ? rate_signal(i) : coordinate_signal(i, motion.reference);
        }
    if (path == "force")
      return tension();
    for (const bool is_moment : {false, true})
      for (unsigned int i = 0; i < 3; ++i)
        if (path == (is_moment ? "moment " : "force ") + std::to_string(i + 1))
          return reaction(is_moment, i);
    return nullptr;
  }



  std::optional<unsigned int>
  Joint::use_coordinate(Model &model, const std::string &wanted)
  {
    for (auto &motion : free)
      if (motion.name == wanted || (wanted.empty() && free.size() == 1))
        {
          if (motion.coordinate < 0)
            motion.coordinate = model.add_coordinate(name + "." + motion.name, motion.unit);
          return motion.coordinate;
        }
    return {};
  }



  std::vector<std::string>
  Joint::rotation_names() const
  {
    std::vector<std::string> names;
    for (const auto &motion : free)
      if (motion.is_angle())
        names.push_back(motion.name);
    return names;
  }
} // namespace samara
