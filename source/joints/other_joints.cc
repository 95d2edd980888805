#include <samara/joints/other_joints.h>

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
    axis                = Vector3::UnitX();
    Joint::add_parameters(prm);
    prm.add("Second axis", second_axis, "Direction of the axis on body B, at a right angle to the first [1].");
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
    prm.add("Reaction", reaction_wanted, "Keep both nodes and make the forces and moments between them unknowns.");
  }



  void
  Rigid::initialize(Model &model)
  {
    if (reaction_wanted)
      return Joint::initialize(model);
    if (const auto ends = ends_of_joint(model, *this, body_a, body_b))
      model.weld((*ends)[0], (*ends)[1]);
  }



  void
  Rigid::connect(Layout &layout)
  {
    if (reaction_wanted)
      Joint::connect(layout);
  }

  void
  Rigid::residual(const Point<double> &point, double *r) const
  {
    if (reaction_wanted)
      Joint::residual(point, r);
  }

  void
  Rigid::residual(const Point<std::complex<double>> &point, std::complex<double> *r) const
  {
    if (reaction_wanted)
      Joint::residual(point, r);
  }

  void
  Rigid::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    if (reaction_wanted)
      Joint::tangent(point, K);
  }

  void
  Rigid::damping(const Point<double> &point, SparseMatrix &C) const
  {
    if (reaction_wanted)
      Joint::damping(point, C);
  }

  void
  Rigid::constraint_rates(const Point<double> &point, double *rates) const
  {
    if (reaction_wanted)
      Joint::constraint_rates(point, rates);
  }

  std::optional<Probe>
  Rigid::probe(const std::string &path) const
  {
    if (!reaction_wanted && (path.substr(0, 6) == "force " || path.substr(0, 7) == "moment "))
      throw std::invalid_argument("joint <" + name + "> has made one body of two, and knows no <" + path +
                                  ">; set Reaction = true there");
    return Joint::probe(path);
  }



  void
  Rigid::draw(const State &, Drawing &) const
  {}



  void
  Spring::add_parameters(Parameters &prm)
  {
    free.emplace_back();
    free.back().name  = "length";
    free.back().unit  = "m";
    free.back().first = {PairFunction::squared_distance};
    Joint::add_parameters(prm);
  }



  void
  Spring::place(Model &model, const Frame &a, const Frame &b)
  {
    // the ground has no points of its own
    frame_a            = a.node == 0 && parameters.is_set("Position") ? model.frame_at(a, position, Matrix3::Identity()) : a;
    frame_b            = b;
    FreeMotion &motion = free[0];
    motion.reference   = (model.position(frame_b) - model.position(frame_a)).norm();
    if (motion.reference == 0)
      throw std::invalid_argument("the two points of a spring must not coincide: it would have no direction");
    // what users say of the length is the length itself, the coordinate is its change
    motion.rest = parameters.subsection("length").is_set("Rest") ? motion.rest - motion.reference : 0.;
    motion.lower_stop -= motion.reference;
    motion.upper_stop -= motion.reference;
  }



  std::optional<Probe>
  Spring::probe(const std::string &path) const
  {
    if (path != "force")
      return Joint::probe(path);
    const FreeMotion &motion = free[0];
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
    Sample a, b;
    a.x = frame_a.position(state.q.data());
    b.x = frame_b.position(state.q.data());
    drawing.begin_object(name);
    drawing.bar(a, b, 0.02 * free[0].reference);
  }



  void
  Distance::add_parameters(Parameters &prm)
  {
    locked.push_back({{PairFunction::squared_distance}, "distance"});
    Joint::add_parameters(prm);
    prm.add("Length", length, "Length of the rod; 0: the distance in the reference configuration [m].",
            dealii::Patterns::Double(0));
  }



  void
  Distance::place(Model &model, const Frame &a, const Frame &b)
  {
    frame_a                = a;
    frame_b                = b;
    const double reference = (model.position(b) - model.position(a)).norm();
    if (length == 0)
      length = reference;
    if (reference == 0)
      throw std::invalid_argument("the two points of a distance joint must not coincide: it would have no direction");
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
    Sample a, b;
    a.x = frame_a.position(state.q.data());
    b.x = frame_b.position(state.q.data());
    drawing.begin_object(name);
    drawing.bar(a, b, 0.01 * length);
  }



  void
  Gear::add_parameters(Parameters &prm)
  {
    prm.add("Joint A", joint_a, "Joint whose rotation drives: a name, or name.rotation.");
    prm.add("Joint B", joint_b, "Joint whose rotation follows.");
    prm.add("Ratio", ratio, "Rotation of B per rotation of A, each seen from its own body A; negative: opposite sense [1].");
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
  }



  void
  Gear::connect(Layout &layout)
  {
    multiplier = layout.add_multipliers({"gear " + name});
    layout.couple(block, {}, {coordinates[0], coordinates[1]}, {multiplier});
  }



  template <typename Number>
  void
  Gear::residual_at(const Point<Number> &point, Number *r) const
  {
    const Number                             lambda = point.multipliers[multiplier];
    Eigen::Matrix<Number, Eigen::Dynamic, 1> local(3);
    local << -ratio * lambda, lambda, point.coordinates[coordinates[1]] - ratio * point.coordinates[coordinates[0]];
    block.add(local, r);
  }



  void
  Gear::tangent(const Point<double> &, SparseMatrix &K) const
  {
    Eigen::MatrixXd local = Eigen::MatrixXd::Zero(3, 3);
    local(0, 2) = local(2, 0) = -ratio;
    local(1, 2) = local(2, 1) = 1;
    block.add(local, K);
  }



  void
  Gear::constraint_rates(const Point<double> &point, double *rates) const
  {
    rates[multiplier] = point.rates[coordinates[1]] - ratio * point.rates[coordinates[0]];
  }



  std::optional<Probe>
  Gear::probe(const std::string &path) const
  {
    if (path != "moment")
      return {};
    return Probe{path, "N m", [this](const State &state) { return -state.multipliers[multiplier]; }};
  }



  std::vector<std::string>
  Gear::probe_names() const
  {
    return {"moment"};
  }



  void
  FlexibleJoint::add_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    prm.add("Body A", body_a, "First frame: body.point, or ground.");
    prm.add("Body B", body_b, "Second frame; strains are those of B seen from A.");
    prm.add("Position", position, "Place of the joint in the reference configuration; default: that of frame B [m].");
    prm.add("Axis", axis, "Direction of axis 1 in the reference configuration, inertial components [1].");
    prm.add("Axis 2", axis_2, "Direction near which axis 2 lies; 0, 0, 0: any [1].");
    const List three(Double(0), 3, 3);
    prm.add("Stiffness", stiffness, "Of the axial and two transverse springs [N/m].", three);
    prm.add("Rotational stiffness",
            rotational_stiffness,
            "Of the springs in torsion and two bendings [N*m/rad].",
            three);
    prm.add("Damping", viscosity, "Of the axial and two transverse dampers [N*s/m].", three);
    prm.add("Rotational damping",
            rotational_viscosity,
            "Of the dampers in torsion and two bendings [N*m*s/rad].",
            three);
    prm.add(
      "Coupling",
      coupling,
      "Couplings of the six stiffnesses, displacements first: the 15 numbers of the upper triangle by rows, without "
      "the diagonal, in SI units.");
  }



  void
  FlexibleJoint::initialize(Model &m)
  {
    model           = &m;
    const auto ends = ends_of_joint(m, *this, body_a, body_b);
    if (!ends)
      return;
    if (!parameters.is_set("Position"))
      position = m.position((*ends)[1]);
    if (axis.isZero(0.))
      return m.complaints.add(parameters.where("Axis"), "the axis must not be zero");
    // triad_about() gives axis 3; turned so that it becomes axis 1 and "Axis 2" stays the second
    const Matrix3 E = triad_about(axis, axis_2);
    Matrix3       D;
    D.col(0) = E.col(2);
    D.col(1) = E.col(0);
    D.col(2) = E.col(1);
    frame_a  = m.frame_at((*ends)[0], position, D);
    frame_b  = m.frame_at((*ends)[1], position, D);

    C = C_d = Matrix6::Zero();
    C.diagonal() << stiffness, rotational_stiffness;
    C_d.diagonal() << viscosity, rotational_viscosity;
    if (!coupling.empty() && coupling.size() != 15)
      m.complaints.add(parameters.where("Coupling"), "give 15 numbers, not " + std::to_string(coupling.size()));
    else if (!coupling.empty())
      for (unsigned int i = 0, k = 0; i < 6; ++i)
        for (unsigned int j = i + 1; j < 6; ++j, ++k)
          C(i, j) = C(j, i) = coupling[k];
    if (Eigen::SelfAdjointEigenSolver<Matrix6>(C).eigenvalues()(0) < -1e-12 * C.norm())
      m.complaints.add(parameters.where("Coupling"), "the stiffness matrix has a negative eigenvalue");
  }



  void
  FlexibleJoint::connect(Layout &layout)
  {
    frame_a = layout.model.resolved(frame_a);
    frame_b = layout.model.resolved(frame_b);
    if (check_ends(*model, *this, frame_a, frame_b, "<" + body_a + "> and <" + body_b + ">"))
      layout.couple(block, {frame_a, frame_b});
  }



  std::vector<std::pair<double, PairFunction>>
  FlexibleJoint::functions(const unsigned int i)
  {
    if (i < 3)
      return {{1., {PairFunction::gap, i}}};
    const unsigned int j = (i + 1) % 3, k = (i + 2) % 3;
    return {{0.5, {PairFunction::cosine, k, j}}, {-0.5, {PairFunction::cosine, j, k}}};
  }



  template <typename Number>
  Eigen::Matrix<Number, 6, 12>
  FlexibleJoint::gradients(const PairValues<Number> &pair) const
  {
    Eigen::Matrix<Number, 12, 6> B = Eigen::Matrix<Number, 12, 6>::Zero();
    for (unsigned int i = 0; i < 6; ++i)
      for (const auto &[factor, function] : functions(i))
        function.add_gradient(pair, Number(factor), B.col(i));
    return B.transpose();
  }



  template <typename Number>
  void
  FlexibleJoint::strains_at(const Point<Number> &point, Number *e) const
  {
    const PairValues<Number> pair(frame_a, frame_b, point.q);
    for (unsigned int i = 0; i < 6; ++i)
      {
        e[i] = 0;
        for (const auto &[factor, function] : functions(i))
          e[i] += factor * function.value(pair);
      }
  }



  void
  FlexibleJoint::strain_rates(const Point<double> &point, double *rates) const
  {
    const PairValues<double>    pair(frame_a, frame_b, point.q);
    Eigen::Matrix<double, 12, 1> y;
    y << frame_a.twist(point.y), frame_b.twist(point.y);
    Eigen::Map<Vector6>{rates} = gradients(pair) * y;
  }



  template <typename Number>
  void
  FlexibleJoint::stresses_of(const Number *e, const Number *rates, Number *stress) const
  {
    Eigen::Map<Vec6<Number>>{stress} = C.cast<Number>() * Eigen::Map<const Vec6<Number>>(e) +
                                       C_d.cast<Number>() * Eigen::Map<const Vec6<Number>>(rates);
  }



  double
  FlexibleJoint::strain_energy(const double *e) const
  {
    const Eigen::Map<const Vector6> strain(e);
    return 0.5 * strain.dot(C * strain);
  }



  template <typename Number>
  void
  FlexibleJoint::residual_at(const Point<Number> &point, Number *r) const
  {
    const PairValues<Number>                 pair(frame_a, frame_b, point.q);
    Eigen::Matrix<Number, Eigen::Dynamic, 1> local =
      gradients(pair).transpose() * Eigen::Map<const Vec6<Number>>(point.stress + first_strain);
    block.add(local, r);
  }



  void
  FlexibleJoint::add(const Point<double> &point, const Matrix6 &C, const bool geometric, SparseMatrix &K) const
  {
    const PairValues<double> pair(frame_a, frame_b, point.q);
    const auto               B     = gradients(pair);
    Eigen::MatrixXd          local = B.transpose() * C * B;
    if (geometric)
      for (unsigned int i = 0; i < 6; ++i)
        for (const auto &[factor, function] : functions(i))
          function.add_second_derivative(pair, factor * point.stress[first_strain + i], local);
    block.add(local, K);
  }



  void
  FlexibleJoint::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    add(point, C, true, K);
  }



  void
  FlexibleJoint::damping(const Point<double> &point, SparseMatrix &matrix) const
  {
    add(point, C_d, false, matrix);
  }



  std::optional<Probe>
  FlexibleJoint::probe(const std::string &path) const
  {
    for (unsigned int i = 0; i < 6; ++i)
      if (path == "force " + std::to_string(i + 1))
        return Probe{path, i < 3 ? "N" : "N m", [=](const State &state) { return state.stress[first_strain + i]; }};
      else if (path == "strain " + std::to_string(i + 1))
        return Probe{path, i < 3 ? "m" : "1", [=](const State &state) {
                       double e[6];
                       strains_at(state.point(), e);
                       return e[i];
                     }};
    return {};
  }



  std::vector<std::string>
  FlexibleJoint::probe_names() const
  {
    std::vector<std::string> names;
    for (const std::string what : {"force ", "strain "})
      for (unsigned int i = 1; i <= 6; ++i)
        names.push_back(what + std::to_string(i));
    return names;
  }



  void
  FlexibleJoint::draw(const State &state, Drawing &drawing) const
  {
    Sample a;
    a.x = frame_a.position(state.q.data());
    a.D = frame_a.triad(state.q.data());
    drawing.begin_object(name);
    drawing.cylinder(a, 0, 0.05, 0.02);
  }



  template class Evaluated<Gear>;
  template class Evaluated<FlexibleJoint>;
} // namespace samara
