#include <samara/base/text.h>
#include <samara/cosserat/rigid_body.h>
#include <samara/model/drawing.h>
#include <samara/model/frame_probe.h>
#include <samara/model/system.h>
#include <samara/rotation/matrix6.h>

#include <cmath>
#include <sstream>

namespace samara
{
  void
  RigidBody::add_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    prm.add("Mass", mass, "Mass [kg].", Double(0));
    prm.add("Position", position, "Reference position of the body's node [m].");
    prm.add("Rotation", rotation, "Reference orientation: three angles in the sequence below [rad].");
    prm.add("Rotation sequence", sequence, "Axes of the three rotations, each about the axis turned by those before.");
    prm.add("Centre of mass", centre_of_mass, "Place of the centre of mass seen from the node, in the body's axes [m].");
    prm.add("Inertia",
            inertia,
            "Moments of inertia about the centre of mass in the body's axes: J11, J22, J33 or J11, J22, J33, J12, J13, J23, "
            "where J12 = -integral of y1 y2 dm [kg*m^2].",
            List(Double(), 3, 6));
    prm.add("Frames", frame_entries, "Points others can attach to, in inertial coordinates: name at x y z, name at x y z [m].");
    initial_velocity.add_parameters(prm, "node");
    prm.add("Shape",
            shape,
            "How the body is drawn; automatic: a sphere as heavy as steel, with bars to its frames.",
            Selection("automatic|none|sphere|box|cylinder 1|cylinder 2|cylinder 3"));
    prm.add("Size", size, "Of the drawn shape: radius; or three sides; or radius, length [m].");
    prm.turns("Position", Turning::position);
    prm.turns("Rotation", Turning::own_axes); // see be_placed()
    prm.turns("Centre of mass", Turning::own_axes);
  }



  void
  RigidBody::be_placed(const Placement &placement)
  {
    Item::be_placed(placement);
    try
      {
        const Matrix3 D = rotation_of_angles(rotation, sequence);
        if (placement.rotation != Matrix3::Identity())
          parameters.assign("Rotation", angles_of_rotation(placement.rotation * D, sequence));
      }
    catch (const std::invalid_argument &)
      {
        return; // initialize() complains about the sequence
      }
    std::vector<std::string> placed;
    for (const auto &text : frame_entries)
      {
        std::string point;
        Vector3     x;
        if (!read_frame(text, point, x))
          return; // read_frames() complains
        x = placement.point(x);
        placed.push_back(point + " at " + number_to_text(x(0)) + " " + number_to_text(x(1)) + " " +
                         number_to_text(x(2)));
      }
    if (!placed.empty())
      parameters.assign("Frames", placed);
  }



  bool
  RigidBody::read_frame(const std::string &text, std::string &point, Vector3 &x)
  {
    std::string        place, word, rest;
    bool               is_frame = split_at(text, point, place);
    std::istringstream words(place);
    for (unsigned int i = 0; i < 3; ++i)
      is_frame = is_frame && (words >> word) && text_to_number(word, x(i));
    return is_frame && !(words >> rest);
  }



  void
  RigidBody::initialize(Model &model)
  {
    complaints = &model.complaints;
    Matrix3 D;
    try
      {
        D = rotation_of_angles(rotation, sequence);
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where("Rotation sequence"), problem.what());
        return;
      }
    if (inertia.size() != 3 && inertia.size() != 6)
      {
        model.complaints.add(parameters.where("Inertia"), "give three numbers or six");
        return;
      }
    const Frame node = model.add_node(name, position, D);

    Matrix3 J = Vector3(inertia[0], inertia[1], inertia[2]).asDiagonal();
    if (inertia.size() == 6)
      {
        J(0, 1) = J(1, 0) = inertia[3];
        J(0, 2) = J(2, 0) = inertia[4];
        J(1, 2) = J(2, 1) = inertia[5];
      }
    // J₁ + J₂ − J₃ = 2 ∫ y₃² dm, and so on; but for round-off of given numbers
    const Vector3 principal = symmetric_eigenvalues3(J);
    if (principal(0) < -1e-12 * J.norm() || principal(2) > (principal(0) + principal(1)) * (1 + 1e-9) + 1e-300)
      model.complaints.add(parameters.where("Inertia"),
                           "no body has these moments of inertia: each principal one must be at most the sum of the "
                           "other two, and none negative");
    Matrix6 M = Matrix6::Zero();
    M.topLeftCorner<3, 3>()     = mass * Matrix3::Identity();
    M.bottomRightCorner<3, 3>() = J;
    model.add_inertia(node.then(centre_of_mass), M);

    named["centre"]         = {node, position, D};
    named["centre of mass"] = {node.then(centre_of_mass), position + D * centre_of_mass, D};
    read_frames(model, node);
  }



  void
  RigidBody::read_frames(Model &model, const Frame &node)
  {
    const Matrix3 D = model.triad(node);
    for (const auto &text : frame_entries)
      {
        std::string point;
        Vector3     x;
        if (!read_frame(text, point, x))
          model.complaints.add(parameters.where("Frames"),
                               "a frame is written <name at x y z>, plain numbers in metres, not <" + text + ">");
        else if (!named.insert({point, {model.frame_at(node, x, D), x, D}}).second)
          model.complaints.add(parameters.where("Frames"),
                               "rigid body <" + name + "> has a point <" + point + "> already");
      }
  }



  void
  RigidBody::connect(Layout &layout)
  {
    for (auto &point : named)
      point.second.frame = layout.model.resolved(point.second.frame);
    if (!named.empty())
      initial_velocity.check({named.at("centre").frame}, *this, *complaints);
  }



  void
  RigidBody::add_initial_velocities(State &state) const
  {
    initial_velocity.assign({named.at("centre").frame}, *this, state);
  }



  Frame
  RigidBody::frame(const std::string &point) const
  {
    const auto found = named.find(point.empty() ? "centre" : point);
    if (found != named.end())
      return found->second.frame;
    if (named.empty())
      return {}; // the body could not be made; it has complained already
    throw std::invalid_argument("rigid body <" + name + "> has no point <" + point + ">" + did_you_mean(point, points()));
  }



  std::vector<std::string>
  RigidBody::points() const
  {
    std::vector<std::string> names;
    for (const auto &point : named)
      names.push_back(point.first);
    return names;
  }



  std::optional<Probe>
  RigidBody::probe(const std::string &path) const
  {
    const auto dot = path.rfind('.');
    const auto found =
      named.find(dot == std::string::npos ? "centre" : trim(path.substr(0, dot)));
    if (found == named.end())
      return {};
    const Point point = found->second;
    return frame_probe(trim(path.substr(dot == std::string::npos ? 0 : dot + 1)),
                       [=](const State &state) { return FrameMotion::of(point.frame, point.x, point.D, state); });
  }



  std::vector<std::string>
  RigidBody::probe_names() const
  {
    std::vector<std::string> names = frame_quantities();
    for (const auto &point : points())
      for (const auto &quantity : frame_quantities())
        names.push_back(point + "." + quantity);
    return names;
  }



  void
  RigidBody::draw(const State &state, Drawing &drawing) const
  {
    if (shape == "none" || named.empty())
      return;
    const Sample centre = drawing.sample(named.at("centre of mass").frame, state);
    // steel of 7800 kg/m³, but nothing too small to be seen
    const double radius = !size.empty() ? size[0] : std::max(0.02, std::cbrt(mass / 7800. / (4. / 3. * M_PI)));
    drawing.begin_object(name);
    if (shape == "box")
      drawing.box(centre, size.size() == 3 ? Vector3(size[0], size[1], size[2]) : Vector3::Constant(2 * radius).eval());
    else if (shape.substr(0, 8) == "cylinder")
      drawing.cylinder(centre, shape.back() - '1', radius, size.size() > 1 ? size[1] : radius);
    else
      drawing.sphere(centre, radius);
    for (const auto &point : named)
      {
        const Sample end = drawing.sample(point.second.frame, state);
        if ((end.x - centre.x).norm() > 1.01 * radius)
          drawing.bar(centre, end, 0.2 * radius);
      }
  }
} // namespace samara
