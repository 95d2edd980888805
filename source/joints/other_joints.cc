#include <samara/joints/other_joints.h>
#include <samara/model/drawing.h>

#include <cmath>

namespace samara
{
  void
  Universal::add_parameters(Parameters &prm)
  {
    for (const unsigned int i : {0, 1, 2})
      lock_displacement(i);
    lock_rotation(0, 1);
    FreeMotion &about_1 = free_rotation_about_3("rotation 1");
    about_1.first       = {PairFunction::cosine, 1, 1};
    about_1.second      = {PairFunction::cosine, 2, 1};
    about_1.axis        = 0;
    FreeMotion &about_2 = free_rotation_about_3("rotation 2");
    about_2.first       = {PairFunction::cosine, 0, 0};
    about_2.second      = {PairFunction::cosine, 0, 2};
    about_2.axis        = 1;
    about_2.is_on_b     = true;
    axis                = Vector3::UnitX();
    add_ends(prm);
    prm.add("Axis",
            axis,
            "Direction of the axis on body A (joint axis 1) in the reference configuration, inertial components [1].");
    prm.add("Second axis", second_axis, "Direction of the axis on body B (joint axis 2), " + angle_of_axes() + " [1].");
    prm.turns("Axis", Turning::direction);
    prm.turns("Second axis", Turning::direction);
    add_motions(prm);
  }



  void
  Universal::be_moved(const MotionOf &motion_of)
  {
    const Vector3 drawn = second_axis;
    Joint::be_moved(motion_of);
    parameters.assign("Second axis", Vector3(motion_of(body_b).rotation * drawn));
  }



  Matrix3
  Universal::axes() const
  {
    if (std::abs(axis.normalized().dot(second_axis.normalized())) > 1e-6)
      throw std::invalid_argument("the two axes of a universal joint must be at a right angle");
    return triad(axis, second_axis);
  }



  void
  Rigid::add_parameters(Parameters &prm)
  {
    for (const unsigned int i : {0, 1, 2})
      lock_displacement(i);
    lock_rotation(2, 0);
    lock_rotation(2, 1);
    lock_rotation(0, 1);
    Joint::add_parameters(prm);
    prm.add(
      "Reaction",
      reaction_wanted,
      "Keep both nodes and make the forces and moments between them unknowns: at Position, in the axes of Axis and "
      "Axis 1, which have no effect otherwise.");
  }



  void
  Rigid::initialize(Model &model)
  {
    // two bodies that are drawn apart keep two nodes until it is known where they meet
    const bool closes = closes_gap();
    if (reaction_wanted || (closes && gaps == Gaps::open))
      {
        is_weld = false;
        return Joint::initialize(model);
      }
    const auto ends = ends_of_joint(model, *this, body_a, body_b);
    if (!ends)
      return;
    if (!closes || gaps != Gaps::closed)
      check_gap(model, *this, *ends, body_a, body_b, gap);
    frame_a = (*ends)[0];
    frame_b = (*ends)[1];
    model.weld(frame_a, frame_b);
  }



  void
  Rigid::connect(Layout &layout)
  {
    if (!is_weld)
      return Joint::connect(layout);
    frame_a = layout.model.resolved(frame_a);
    frame_b = layout.model.resolved(frame_b);
  }



  std::vector<Frame>
  Rigid::connected_frames() const
  {
    return is_weld ? std::vector<Frame>() : Joint::connected_frames();
  }



  std::optional<Probe>
  Rigid::probe(const std::string &path) const
  {
    check_reaction(path);
    return Joint::probe(path);
  }



  std::shared_ptr<Signal>
  Rigid::signal(Model &model, const std::string &path)
  {
    check_reaction(path);
    return Joint::signal(model, path);
  }



  void
  Rigid::check_reaction(const std::string &path) const
  {
    if (!reaction_wanted && (path.substr(0, 6) == "force " || path.substr(0, 7) == "moment "))
      throw std::invalid_argument("joint <" + name + "> has made one body of two, and knows no <" + path +
                                  ">; set Reaction = true there");
  }



  void
  Rigid::draw(const State &state, Drawing &drawing) const
  {
    if (!is_weld)
      return Joint::draw(state, drawing);
    const auto reaches = [this](const Frame &frame) { return frame.node > 0 && frame.arm.norm() > draw_size; };
    if (reaches(frame_a) || reaches(frame_b))
      drawing.begin_object(name);
    draw_arms(state, drawing);
  }



  void
  Spring::add_parameters(Parameters &prm)
  {
    free.emplace_back();
    free.back().name  = "length";
    free.back().unit  = "m";
    free.back().first = {PairFunction::squared_distance};
    add_two_points(prm);
  }



  void
  Spring::place(Model &model, const Frame &a, const Frame &b)
  {
    frame_a            = end_on_a(model, a);
    frame_b            = b;
    FreeMotion &motion = free.front();
    motion.reference   = (model.position(frame_b) - model.position(frame_a)).norm();
    if (motion.reference == 0)
      model.complaints.add(parameters.where("Position"),
                           "the two points of a spring must not coincide: it would have no direction");
    // what users say of the length is the length itself, the coordinate is its change since the reference
    motion.rest = parameters.subsection("length").is_set("Rest") ? motion.rest - motion.reference : 0.;
    motion.lower_stop -= motion.reference;
    motion.upper_stop -= motion.reference;
  }



  std::optional<Probe>
  Spring::probe(const std::string &path) const
  {
    if (path != "force")
      return Joint::probe(path);
    const FreeMotion &motion = free.front();
    if (motion.coordinate < 0)
      return {};
    return Probe{path, "N", [this, &motion](const State &state) {
                   return state.multipliers[first_multiplier] * motion.lever(state.coordinates[motion.coordinate]);
                 }};
  }



  std::vector<std::string>
  Spring::probe_names() const
  {
    return {"length", "length rate", "force"};
  }



  void
  Spring::draw(const State &state, Drawing &drawing) const
  {
    // a zigzag, which has its lines whatever the length
    constexpr unsigned int n      = 10;
    const double           radius = 0.008 * free.front().reference, width = 0.05 * free.front().reference;
    const Sample           a = drawing.sample(frame_a, state), b = drawing.sample(frame_b, state);
    const Vector3          span = b.x - a.x;
    drawing.begin_object(name);
    if (span.norm() == 0)
      return;
    const Vector3 e  = span.unitOrthogonal();
    const auto    at = [&](const unsigned int k) {
      const double u = double(k) / n;
      Sample       point;
      point.x            = a.x + u * span + (k < 2 || k > n - 2 ? 0. : k % 2 == 0 ? width : -width) * e;
      point.displacement = (1 - u) * a.displacement + u * b.displacement;
      point.velocity     = (1 - u) * a.velocity + u * b.velocity;
      return point;
    };
    for (unsigned int k = 0; k < n; ++k)
      drawing.bar(at(k), at(k + 1), radius);
  }



  void
  Distance::add_parameters(Parameters &prm)
  {
    locked.push_back({{PairFunction::squared_distance}, "distance"});
    add_two_points(prm);
    prm.add("Length",
            length,
            "Length of the rod; 0: the distance in the reference configuration [m].",
            dealii::Patterns::Double(0));
  }



  void
  Distance::place(Model &model, const Frame &a, const Frame &b)
  {
    frame_a                = end_on_a(model, a);
    frame_b                = b;
    const double reference = (model.position(frame_b) - model.position(frame_a)).norm();
    if (length == 0)
      length = reference;
    if (reference == 0)
      model.complaints.add(parameters.where("Position"),
                           "the two points of a distance joint must not coincide: it would have no direction");
    locked[0].value = length * length;
  }



  std::optional<Probe>
  Distance::probe(const std::string &path) const
  {
    if (path != "force")
      return {};
    return Probe{path, "N", [this](const State &state) { return 2 * length * state.multipliers[first_multiplier]; }};
  }



  std::vector<std::string>
  Distance::probe_names() const
  {
    return {"force"};
  }



  void
  Distance::draw(const State &state, Drawing &drawing) const
  {
    drawing.begin_object(name);
    drawing.attach(frame_a, state);
    drawing.attach(frame_b, state);
    drawing.bar(drawing.sample(frame_a, state), drawing.sample(frame_b, state), 0.01 * length);
  }



  void
  Gear::add_parameters(Parameters &prm)
  {
    prm.add("Joint A", joint_a, "Joint whose rotation drives: a name, or name.rotation.");
    prm.add("Joint B", joint_b, "Joint whose rotation follows.");
    prm.add("Ratio",
            ratio,
            "Rotation of B per rotation of A, each seen from its own body A; negative: opposite sense [1].");
    prm.add("Backlash",
            backlash,
            "By which B can turn to and fro while A is held; not given: the teeth are rigid and have none [rad].",
            dealii::Patterns::Double(0));
    mesh.add_parameters(prm, "Mesh ", true);
    prm.add(
      "Efficiency",
      efficiency,
      "Part of the power that arrives at B where A drives; 2 - 1/Efficiency of it arrives at A where B drives. What "
      "is lost is friction of the teeth; 1: none [1].",
      dealii::Patterns::Double(0, 1));
    prm.add("Pitch radius",
            pitch_radius,
            "Of the wheel on A, at which the sticking speed holds [m].",
            dealii::Patterns::Double(0));
    prm.add(
      "Sticking speed",
      sticking_speed,
      "Speed at the pitch radius of A below which friction is proportional to it; what should stick creeps with a "
      "part of it [m/s].",
      dealii::Patterns::Double(0));
  }



  void
  Gear::check_efficiency(Model &model) const
  {
    const auto complain = [&](const std::string &entry, const std::string &text) {
      model.complaints.add(parameters.where(entry), "gear <" + name + ">: " + text);
    };
    if (efficiency == 0)
      complain("Efficiency", "the <Efficiency> must be above zero");
    else if (efficiency < 1)
      for (const std::string entry : {"Pitch radius", "Sticking speed"})
        if ((entry == "Pitch radius" ? pitch_radius : sticking_speed) == 0)
          complain(parameters.is_set(entry) ? entry : "Efficiency",
                   "an <Efficiency> below 1 needs a <" + entry + "> above zero");
    if (!parameters.is_set("Efficiency"))
      for (const std::string entry : {"Pitch radius", "Sticking speed"})
        if (parameters.is_set(entry))
          complain(entry,
                   "<" + entry + "> does nothing: it is for friction of the teeth; give an <Efficiency> below 1");
  }



  void
  Gear::initialize(Model &model)
  {
    bool are_known = true;
    for (const bool first : {true, false})
      try
        {
          if (parameters.require(first ? "Joint A" : "Joint B", model.complaints))
            coordinates[first ? 0 : 1] = model.use_rotation(first ? joint_a : joint_b);
          else
            are_known = false;
        }
      catch (const std::invalid_argument &problem)
        {
          model.complaints.add(parameters.where(first ? "Joint A" : "Joint B"), problem.what());
          are_known = false;
        }
    if (are_known && coordinates[0] == coordinates[1])
      model.complaints.add(parameters.where("Joint B"), "gear <" + name + "> connects a rotation to itself");
    check_efficiency(model);
    has_backlash = parameters.is_set("Backlash");
    if (!has_backlash)
      return ContactEntries::refuse_all(parameters,
                                        "Mesh ",
                                        "gear <" + name + ">",
                                        "teeth that are not rigid need a <Backlash> above zero",
                                        model.complaints);
    if (backlash == 0)
      model.complaints.add(parameters.where("Backlash"), "gear <" + name + ">: the <Backlash> must be above zero");
    if (!mesh.is_given())
      model.complaints.add(parameters.where("Backlash"),
                           "gear <" + name + ">: with a <Backlash> the teeth need a <Mesh stiffness> above zero");
    law            = mesh.law(parameters, "Mesh ", "gear <" + name + ">", model.complaints);
    coordinates[2] = model.add_coordinate(name + ".play", "rad");
  }



  void
  Gear::connect(Layout &layout)
  {
    multiplier = layout.add_multipliers(*this, {""});
    row        = has_backlash ? 3 : 2;
    layout.couple(block, {}, {coordinates, coordinates + row}, {multiplier});
    layout.add(*this, *this);
    teeth.clear();
    if (has_backlash)
      for (const double side : {-1., 1.})
        teeth.add_stop(layout,
                       *this,
                       {coordinates[2],
                        0.5 * side * backlash,
                        side,
                        law,
                        true,
                        "gear " + name + (side > 0 ? ", teeth in front" : ", teeth behind")});
    add_friction(layout);
  }



  void
  Gear::add_friction(Layout &layout)
  {
    if (efficiency == 1 || efficiency == 0 || pitch_radius == 0)
      return;
    // the multiplier is the moment on B: the law's coefficient makes the force at the pitch radius of A
    Layout::Friction friction;
    friction.coordinates        = {coordinates[0]};
    friction.arm                = pitch_radius;
    friction.law.kinetic        = (1 / efficiency - 1) * std::abs(ratio) / pitch_radius;
    friction.law.breakaway      = friction.law.kinetic;
    friction.law.sticking_speed = sticking_speed;
    friction.multipliers        = {multiplier};
    friction.name               = "gear " + name + ", friction of the teeth";
    teeth.add_friction(layout, *this, friction);
  }



  // g = θ_B − n θ_A, with backlash less the play: the play is a coordinate between the stops of the two flanks
  template <typename Number>
  void
  Gear::residual_at(const Point<Number> &point, Number *r) const
  {
    const Number lambda = point.multipliers[multiplier];
    r[block.row(0)] -= ratio * lambda;
    r[block.row(1)] += lambda;
    r[block.row(row)] += point.coordinates[coordinates[1]] - ratio * point.coordinates[coordinates[0]];
    if (!has_backlash)
      return;
    r[block.row(2)] -= lambda;
    r[block.row(row)] -= point.coordinates[coordinates[2]];
  }



  void
  Gear::tangent(const Point<double> &, SparseMatrix &K) const
  {
    const double slopes[] = {-ratio, 1., -1.};
    for (unsigned int i = 0; i < row; ++i)
      {
        block.add_entry(i, row, slopes[i], K);
        block.add_entry(row, i, slopes[i], K);
      }
  }



  void
  Gear::rates(const Point<double> &point, double *rates) const
  {
    rates[multiplier] = point.rates[coordinates[1]] - ratio * point.rates[coordinates[0]];
    if (has_backlash)
      rates[multiplier] -= point.rates[coordinates[2]];
  }



  std::optional<Probe>
  Gear::probe(const std::string &path) const
  {
    if (path == "play" && has_backlash)
      return Probe{path, "deg", [this](const State &state) { return state.coordinates[coordinates[2]] * 180 / M_PI; }};
    if (path != "moment")
      return {};
    return Probe{path, "N m", [this](const State &state) { return -state.multipliers[multiplier]; }};
  }



  std::vector<std::string>
  Gear::probe_names() const
  {
    return has_backlash ? std::vector<std::string>{"moment", "play"} : std::vector<std::string>{"moment"};
  }



  template class Evaluated<Gear, Constraint>;
} // namespace samara
