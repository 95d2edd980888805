#include <samara/joints/flexible_joint.h>
#include <samara/joints/joint.h>
#include <samara/model/drawing.h>
#include <samara/model/strain_rows.h>
#include <samara/rotation/matrix6.h>

#include <algorithm>
#include <array>

namespace samara
{
  void
  FlexibleJoint::add_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    prm.add("Body A", body_a, "First frame: body.point, or ground.");
    prm.add("Body B", body_b, "Second frame; strains are those of B seen from A.");
    prm.add("Position", position, "Place of the joint in the reference configuration; default: that of frame B [m].");
    prm.add("Gap", gap, documentation_of_gap, Selection("refused|allowed"));
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
    prm.turns("Position", Turning::given_position);
    prm.turns("Axis", Turning::direction);
    prm.turns("Axis 2", Turning::direction);
    for (const std::string entry : {"Stiffness", "Rotational stiffness", "Damping", "Rotational damping"})
      prm.turns(entry, Turning::own_axes);
  }



  void
  FlexibleJoint::be_placed(const Placement &placement)
  {
    // the axis that is chosen where none is given is chosen in the axes of the subsystem
    if (axis_2.isZero(0.))
      parameters.assign("Axis 2", Vector3(triad_about(axis).col(0)));
    Item::be_placed(placement);
  }



  void
  FlexibleJoint::be_moved(const MotionOf &motion_of)
  {
    be_placed(motion_of(body_a));
  }



  std::vector<Frame>
  FlexibleJoint::connected_frames() const
  {
    return {frame_a, frame_b};
  }



  void
  FlexibleJoint::initialize(Model &m)
  {
    model           = &m;
    const auto ends = ends_of_joint(m, *this, body_a, body_b);
    if (!ends)
      return;
    check_gap(m, *this, *ends, body_a, body_b, gap);
    if (gaps == Gaps::open)
      m.weld((*ends)[0], (*ends)[1]); // without strain in the reference configuration: the two bodies go together
    if (!parameters.is_set("Position"))
      position = m.position((*ends)[1]);
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
    if (symmetric_eigenvalues6(C)(0) < -1e-12 * C.norm())
      m.complaints.add(parameters.where("Coupling"), "the stiffness matrix has a negative eigenvalue");
  }



  void
  FlexibleJoint::connect(Layout &layout)
  {
    frame_a = layout.model.resolved(frame_a);
    frame_b = layout.model.resolved(frame_b);
    if (gaps == Gaps::open)
      return;
    if (!check_ends(*model, *this, frame_a, frame_b, "<" + body_a + "> and <" + body_b + ">"))
      return;
    layout.couple(block, {{frame_a.node}, {frame_b.node}}); // derivatives are in the twists of the nodes
    layout.add(*this, *this);
  }



  namespace
  {
    /** Call @p use(i, factor, function) for the functions of each strain i: rotations are the difference of two. */
    template <typename Use>
    void
    for_each_function(const Use &use)
    {
      for (unsigned int i = 0; i < 3; ++i)
        {
          const unsigned int j = (i + 1) % 3, k = (i + 2) % 3;
          use(i, 1., PairFunction{PairFunction::gap, i});
          use(3 + i, 0.5, PairFunction{PairFunction::cosine, k, j});
          use(3 + i, -0.5, PairFunction{PairFunction::cosine, j, k});
        }
    }
  } // namespace



  template <typename Number>
  void
  FlexibleJoint::strains_at(const Point<Number> &point, Number *e) const
  {
    const PairValues<Number> pair(frame_a, frame_b, point.q);
    std::fill(e, e + 6, Number(0));
    for_each_function([&](const unsigned int i, const double factor, const PairFunction &function) {
      e[i] += factor * function.value(pair);
    });
  }



  void
  FlexibleJoint::strain_rates(const Point<double> &point, double *rates) const
  {
    const PairValues<double> pair(frame_a, frame_b, point.q);
    const PairRates          change(pair, point.y);
    std::fill(rates, rates + 6, 0.);
    for_each_function([&](const unsigned int i, const double factor, const PairFunction &function) {
      rates[i] += factor * function.rate(pair, change);
    });
  }



  template <typename Number>
  void
  FlexibleJoint::stresses_of(const Number *e, const Number *rates, Number *stress) const
  {
    Eigen::Map<Vec6<Number>>{stress} =
      C.cast<Number>() * Eigen::Map<const Vec6<Number>>(e) + C_d.cast<Number>() * Eigen::Map<const Vec6<Number>>(rates);
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
    const PairValues<Number> pair(frame_a, frame_b, point.q, point.q_of_forces());
    const Number *const      stress = point.stress + first_strain;
    PairForces<Number>       forces;
    for_each_function([&](const unsigned int i, const double factor, const PairFunction &function) {
      forces.add(function, pair, factor * stress[i]);
    });
    forces.add_to_nodes(pair, r + block.row(0), r + block.row(6));
  }



  void
  FlexibleJoint::add(const Point<double> &point, const Matrix6 &C, const bool geometric, SparseMatrix &matrix) const
  {
    const PairValues<double> pair(frame_a, frame_b, point.q);
    const double *const      stress = point.stress + first_strain;
    PairTangent              twists(pair);
    std::array<Vector12, 6>  gradients;
    gradients.fill(Vector12::Zero());
    for_each_function([&](const unsigned int i, const double factor, const PairFunction &function) {
      function.add_gradient(pair, factor, gradients[i]);
      twists.add(function, factor * stress[i]);
    });
    Matrix12 K = Matrix12::Zero();
    for (unsigned int i = 0; i < 6; ++i)
      {
        Vector12 force = Vector12::Zero();
        for (unsigned int j = 0; j < 6; ++j)
          force += C(i, j) * gradients[j];
        K.noalias() += gradients[i] * force.transpose();
      }
    if (geometric)
      twists.add_to(K);
    block.add_twists(K, matrix);
  }



  void
  FlexibleJoint::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    add(point, point.material ? C : Matrix6(Matrix6::Zero()), true, K);
  }



  void
  FlexibleJoint::damping(const Point<double> &point, SparseMatrix &matrix) const
  {
    if (is_viscous() && point.material)
      add(point, C_d, false, matrix);
  }



  void
  FlexibleJoint::strain_rows(const Point<double> &point, StrainRows &rows) const
  {
    const PairValues<double> pair(frame_a, frame_b, point.q);
    Eigen::Matrix<double, 6, 12, Eigen::RowMajor> B = Eigen::Matrix<double, 6, 12, Eigen::RowMajor>::Zero();
    for_each_function([&](const unsigned int i, const double factor, const PairFunction &function) {
      Vector12 gradient = Vector12::Zero();
      function.add_gradient(pair, factor, gradient);
      B.row(i) += gradient.transpose();
    });
    rows.add_point(first_strain, 1., C, C_d);
    for (unsigned int i = 0; i < 6; ++i)
      {
        rows.begin_row();
        for (unsigned int j = 0; j < 12; ++j)
          rows.add_entry(block.row(j), B(i, j));
      }
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
    drawing.begin_object(name);
    drawing.attach(frame_a, state);
    drawing.attach(frame_b, state);
    drawing.cylinder(drawing.sample(frame_a, state), 0, 0.05, 0.02);
  }



  template class Evaluated<FlexibleJoint, Deformation>;
  template class EvaluatedDeformation<FlexibleJoint>;
} // namespace samara
