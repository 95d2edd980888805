#include <samara/joints/fixed_springs.h>
#include <samara/joints/joint.h>
#include <samara/model/drawing.h>
#include <samara/model/strain_rows.h>

namespace samara
{
  void
  FixedSprings::add_parameters(Parameters &prm)
  {
    const dealii::Patterns::List three(dealii::Patterns::Double(0), 3, 3);
    prm.add("Body A", body_a, "First point: body.point, or ground.");
    prm.add("Body B",
            body_b,
            "Second point; where it is seen from the first one in the reference configuration, there is no force.");
    prm.add("Axis", axis, "Direction of axis 1, fixed in space [1].");
    prm.add("Axis 2", axis_2, "Direction near which axis 2 lies; 0, 0, 0: any [1].");
    prm.add("Stiffness", stiffness, "Of the springs along the three axes [N/m].", three);
    prm.add("Damping", viscosity, "Of the dampers along the three axes [N*s/m].", three);
    prm.turns("Axis", Turning::direction);
    prm.turns("Axis 2", Turning::direction);
    prm.turns("Stiffness", Turning::own_axes);
    prm.turns("Damping", Turning::own_axes);
  }



  void
  FixedSprings::be_placed(const Placement &placement)
  {
    if (axis_2.isZero(0.))
      parameters.assign("Axis 2", Vector3(triad_about(axis).col(0)));
    Item::be_placed(placement);
  }



  void
  FixedSprings::initialize(Model &m)
  {
    model           = &m;
    const auto ends = ends_of_joint(m, *this, body_a, body_b);
    if (!ends)
      return;
    try
      {
        const Matrix3 T = triad_about(axis, axis_2); // its axis 3 becomes axis 1
        E << T.col(2), T.col(0), T.col(1);
      }
    catch (const std::invalid_argument &problem)
      {
        return m.complaints.add(parameters.where("Axis"), problem.what());
      }
    frame_a   = (*ends)[0];
    frame_b   = (*ends)[1];
    reference = m.position(frame_b) - m.position(frame_a);
  }



  void
  FixedSprings::connect(Layout &layout)
  {
    frame_a = layout.model.resolved(frame_a);
    frame_b = layout.model.resolved(frame_b);
    if (!check_ends(*model, *this, frame_a, frame_b, "<" + body_a + "> and <" + body_b + ">"))
      return;
    layout.couple(block, {{frame_a.node}, {frame_b.node}}); // derivatives are in the twists of the nodes
    layout.add(*this, *this);
  }



  template <typename Number>
  void
  FixedSprings::strains_at(const Point<Number> &point, Number *e) const
  {
    // E_i·(Δ − Δ₀)
    const Vec3<Number> change = frame_b.position(point.q) - frame_a.position(point.q) - reference.cast<Number>();
    for (unsigned int i = 0; i < 3; ++i)
      e[i] = E(0, i) * change(0) + E(1, i) * change(1) + E(2, i) * change(2);
  }



  Eigen::Matrix<double, 3, 12>
  FixedSprings::gradients(const double *q) const
  {
    Eigen::Matrix<double, 3, 12> B;
    for (unsigned int i = 0; i < 3; ++i)
      {
        const Vector3 e = E.col(i), a = frame_a.in_node<double>(q, e), b = frame_b.in_node<double>(q, e);
        B.row(i) << -a.transpose(), -frame_a.arm.cross(a).transpose(), b.transpose(), frame_b.arm.cross(b).transpose();
      }
    return B;
  }



  void
  FixedSprings::strain_rates(const Point<double> &point, double *rates) const
  {
    const auto B = gradients(point.q);
    for (unsigned int i = 0; i < 3; ++i)
      rates[i] = B.row(i).head<6>().dot(Eigen::Map<const Vector6>(point.y + 6 * frame_a.node)) +
                 B.row(i).tail<6>().dot(Eigen::Map<const Vector6>(point.y + 6 * frame_b.node));
  }



  template <typename Number>
  void
  FixedSprings::stresses_of(const Number *e, const Number *rates, Number *stress) const
  {
    for (unsigned int i = 0; i < 3; ++i)
      stress[i] = stiffness(i) * e[i] + viscosity(i) * rates[i];
  }



  double
  FixedSprings::strain_energy(const double *e) const
  {
    const Eigen::Map<const Vector3> strain(e);
    return 0.5 * strain.dot(stiffness.asDiagonal() * strain);
  }



  template <typename Number>
  void
  FixedSprings::residual_at(const Point<Number> &point, Number *r) const
  {
    const Number *const stress = point.stress + first_strain;
    Vec3<Number>        f;
    for (unsigned int k = 0; k < 3; ++k)
      f(k) = E(k, 0) * stress[0] + E(k, 1) * stress[1] + E(k, 2) * stress[2];
    const Vec3<Number> none = Vec3<Number>::Zero();
    frame_a.add_force(point.q_of_forces(), Vec3<Number>(-f), none, r + block.row(0));
    frame_b.add_force(point.q_of_forces(), f, none, r + block.row(6));
  }



  void
  FixedSprings::tangent(const Point<double> &point, SparseMatrix &matrix) const
  {
    const double *const stress = point.stress + first_strain;
    const auto          B      = gradients(point.q);
    Matrix12            K      = Matrix12::Zero();
    if (point.material)
      K = B.transpose() * stiffness.asDiagonal() * B;
    // the force keeps its direction while the nodes turn: δ(Dᵀf) = (Dᵀf)~ θ
    const Vector3 f = E * Vector3(stress[0], stress[1], stress[2]);
    for (const bool is_b : {false, true})
      {
        const Frame  &frame = is_b ? frame_b : frame_a;
        const Matrix3 turn  = skew(frame.in_node<double>(point.q, is_b ? f : Vector3(-f)));
        const int     first = is_b ? 6 : 0;
        K.block<3, 3>(first, first + 3) += turn;
        K.block<3, 3>(first + 3, first + 3) += skew(frame.arm) * turn;
      }
    block.add_twists(K, matrix);
  }



  void
  FixedSprings::damping(const Point<double> &point, SparseMatrix &matrix) const
  {
    if (!is_viscous() || !point.material)
      return;
    const auto B = gradients(point.q);
    block.add_twists(B.transpose() * viscosity.asDiagonal() * B, matrix);
  }



  void
  FixedSprings::strain_rows(const Point<double> &point, StrainRows &rows) const
  {
    const auto B = gradients(point.q);
    rows.add_point(first_strain, 1., Matrix3(stiffness.asDiagonal()), Matrix3(viscosity.asDiagonal()));
    for (unsigned int i = 0; i < 3; ++i)
      {
        rows.begin_row();
        for (unsigned int j = 0; j < 12; ++j)
          rows.add_entry(block.row(j), B(i, j));
      }
  }



  std::optional<Probe>
  FixedSprings::probe(const std::string &path) const
  {
    for (unsigned int i = 0; i < 3; ++i)
      if (path == "force " + std::to_string(i + 1))
        return Probe{path, "N", [=](const State &state) { return state.stress[first_strain + i]; }};
      else if (path == "strain " + std::to_string(i + 1))
        return Probe{path, "m", [=](const State &state) {
                       double e[3];
                       strains_at(state.point(), e);
                       return e[i];
                     }};
    return {};
  }



  std::vector<std::string>
  FixedSprings::probe_names() const
  {
    return {"force 1", "force 2", "force 3", "strain 1", "strain 2", "strain 3"};
  }



  void
  FixedSprings::draw(const State &state, Drawing &drawing) const
  {
    drawing.begin_object(name);
    drawing.bar(drawing.sample(frame_a, state), drawing.sample(frame_b, state), 0.02 * std::max(0.1, reference.norm()));
  }



  template class Evaluated<FixedSprings, Deformation>;
  template class EvaluatedDeformation<FixedSprings>;
} // namespace samara
