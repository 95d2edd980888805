#include <samara/cosserat/skeleton.h>
#include <samara/model/drawing.h>

namespace samara
{
  void
  Strut::add_parameters(Parameters &prm)
  {
    using dealii::Patterns::Double;
    prm.add("Point A", point_a, "One end: body.point, or ground.");
    prm.add("Point B", point_b, "The other end.");
    prm.add("EA", EA, "Axial stiffness [N].", Double(0));
    prm.add("Length", length, "Length free of stress; 0: the distance in the reference configuration [m].", Double(0));
    prm.add("Mass", mass, "Mass per length [kg/m].", Double(0));
    prm.add("Damping", relaxation_time, "Viscous stress is this time times the rate of elastic stress [s].", Double(0));
  }



  void
  Strut::initialize(Model &model)
  {
    // Names become references. What is wrong is said at the line of the entry, and reading goes on.
    for (const bool first : {true, false})
      try
        {
          (first ? frame_a : frame_b) = model.frame(first ? point_a : point_b);
        }
      catch (const std::invalid_argument &problem)
        {
          return model.complaints.add(parameters.where(first ? "Point A" : "Point B"), problem.what());
        }
    const double distance = (model.position(frame_b) - model.position(frame_a)).norm();
    if (frame_a.node == frame_b.node)
      return model.complaints.add(parameters.where("Point B"), "strut <" + name + "> connects a body to itself");
    if (distance == 0.)
      return model.complaints.add(parameters.where("Point B"),
                                  "the ends of strut <" + name + "> coincide: it would have no direction");
    if (length == 0.)
      length = distance;

    // Inertia belongs to nodes and is added once, here.
    Matrix6 M               = Matrix6::Zero();
    M.topLeftCorner<3, 3>() = 0.5 * mass * length * Matrix3::Identity();
    model.add_inertia(frame_a, M);
    model.add_inertia(frame_b, M);
  }



  void
  Strut::connect(Layout &layout)
  {
    // Welds have merged nodes: take the frames again, and say which unknowns meet in the local matrices, 12 twists.
    frame_a = layout.model.resolved(frame_a);
    frame_b = layout.model.resolved(frame_b);
    layout.couple(block, {frame_a, frame_b});
    layout.add(*this, *this); // the strut is its own term
  }



  template <typename Number>
  Eigen::Matrix<Number, 12, 1>
  Strut::gradient(const Number *q, const Number *q_of_forces) const
  {
    // δΔ = D_B u_B − D_A u_A; as a force it is seen in reciprocal axes
    const Vec3<Number>           gap = frame_b.position(q) - frame_a.position(q);
    Eigen::Matrix<Number, 12, 1> B   = Eigen::Matrix<Number, 12, 1>::Zero();
    B.template segment<3>(0)         = -(frame_a.triad(q_of_forces).transpose() * gap) / (length * length);
    B.template segment<3>(6)         = frame_b.triad(q_of_forces).transpose() * gap / (length * length);
    return B;
  }



  template <typename Number>
  void
  Strut::strains_at(const Point<Number> &point, Number *e) const
  {
    const Vec3<Number> gap = frame_b.position(point.q) - frame_a.position(point.q);
    e[0]                   = 0.5 * (dot(gap, gap) / (length * length) - 1.);
  }



  void
  Strut::strain_rates(const Point<double> &point, double *rates) const
  {
    Eigen::Matrix<double, 12, 1> y;
    y << frame_a.twist(point.y), frame_b.twist(point.y);
    rates[0] = gradient(point.q, point.q).dot(y);
  }



  template <typename Number>
  void
  Strut::stresses_of(const Number *e, const Number *rates, Number *stress) const
  {
    stress[0] = EA * length * (e[0] + relaxation_time * rates[0]);
  }



  double
  Strut::strain_energy(const double *e) const
  {
    return 0.5 * EA * length * e[0] * e[0];
  }



  template <typename Number>
  void
  Strut::residual_at(const Point<Number> &point, Number *r) const
  {
    Eigen::Matrix<Number, Eigen::Dynamic, 1> local =
      gradient(point.q, point.q_of_forces()) * point.stress[first_strain];
    block.add(local, r);
  }



  void
  Strut::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    // Bᵀ C B, and the change of B at the stress that the point has
    const auto      B     = gradient(point.q, point.q);
    Eigen::MatrixXd local = EA * length * B * B.transpose();

    const Matrix3 A = frame_a.triad(point.q), D = frame_b.triad(point.q);
    const Vector3 gap = frame_b.position(point.q) - frame_a.position(point.q);
    const double  s   = point.stress[first_strain] / (length * length);
    local.block<3, 3>(0, 0) += s * A.transpose() * A;
    local.block<3, 3>(0, 3) -= s * skew((A.transpose() * gap).eval());
    local.block<3, 3>(0, 6) -= s * A.transpose() * D;
    local.block<3, 3>(6, 0) -= s * D.transpose() * A;
    local.block<3, 3>(6, 6) += s * D.transpose() * D;
    local.block<3, 3>(6, 9) += s * skew((D.transpose() * gap).eval());
    block.add(local, K);
  }



  void
  Strut::damping(const Point<double> &point, SparseMatrix &C) const
  {
    const auto      B     = gradient(point.q, point.q);
    Eigen::MatrixXd local = EA * length * relaxation_time * B * B.transpose();
    block.add(local, C);
  }



  std::optional<Probe>
  Strut::probe(const std::string &path) const
  {
    if (path == "strain")
      return Probe{path, "1", [this](const State &state) {
                     double e;
                     strains_at(state.point(), &e);
                     return e;
                   }};
    if (path == "force")
      return Probe{path, "N", [this](const State &state) {
                     const Vector3 gap = frame_b.position(state.q.data()) - frame_a.position(state.q.data());
                     return state.stress[first_strain] * gap.norm() / (length * length);
                   }};
    return {};
  }



  std::vector<std::string>
  Strut::probe_names() const
  {
    return {"strain", "force"};
  }



  void
  Strut::draw(const State &state, Drawing &drawing) const
  {
    drawing.begin_object(name);
    drawing.bar(drawing.sample(frame_a, state), drawing.sample(frame_b, state), 0.01 * length);
  }



  template class Evaluated<Strut, Deformation>;
  template class EvaluatedDeformation<Strut>;
} // namespace samara
