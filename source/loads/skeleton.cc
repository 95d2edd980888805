#include <samara/loads/skeleton.h>

namespace samara
{
  void
  PointDrag::add_parameters(Parameters &prm)
  {
    prm.add("At", at, "Where it acts: body.point.");
    prm.add("Drag area", drag_area, "Drag coefficient times area [m^2].", dealii::Patterns::Double(0));
    prm.add("Density", density, "Of the air [kg/m^3].", dealii::Patterns::Double(0));
    prm.add("Wind", wind, "Velocity of the air, inertial components [m/s].");
    prm.turns("Wind", Turning::direction); // with a subsystem in which the load stands
  }



  void
  PointDrag::initialize(Model &model)
  {
    // What users can get wrong is a complaint at the line of the entry, not an exception: all are reported at once.
    try
      {
        if (parameters.require("At", model.complaints))
          frame = model.frame(at);
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where("At"), problem.what());
      }
  }



  void
  PointDrag::connect(Layout &layout)
  {
    frame = layout.model.resolved(frame); // welds have merged nodes since
    layout.couple(block, {frame});
    layout.add(*this, *this);
  }



  template <typename Number>
  Vec3<Number>
  PointDrag::relative_velocity(const Point<Number> &point) const
  {
    return frame.twist(point.y).template head<3>() - frame.triad(point.q).transpose() * wind;
  }



  template <typename Number>
  void
  PointDrag::residual_at(const Point<Number> &point, Number *r) const
  {
    using std::sqrt;
    const Vec3<Number> v = relative_velocity(point);
    // not v.norm(), which conjugates: derivatives come from complex numbers
    Eigen::Matrix<Number, Eigen::Dynamic, 1> local(6);
    local.setZero();
    local.template head<3>() = 0.5 * point.factor * density * drag_area * sqrt(dot(v, v)) * v;
    block.add(local, r);
  }



  Matrix3
  PointDrag::slope(const Point<double> &point) const
  {
    const Vector3 v     = relative_velocity(point);
    const double  speed = v.norm();
    if (speed == 0.)
      return Matrix3::Zero();
    return 0.5 * point.factor * density * drag_area * (speed * Matrix3::Identity() + v * v.transpose() / speed);
  }



  void
  PointDrag::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    // With δy = ζ̇ + ad_y ζ, δ(Dᵀw) = (Dᵀw) × θ: what is not ζ̇ belongs to the tangent.
    const Vector6   y     = frame.twist(point.y);
    const Matrix3   D     = frame.triad(point.q);
    Eigen::MatrixXd local = Eigen::MatrixXd::Zero(6, 6);
    local.topRows<3>()    = slope(point) * ad(y).topRows<3>();
    local.topRightCorner<3, 3>() -= slope(point) * skew((D.transpose() * wind).eval());
    block.add(local, K);
  }



  void
  PointDrag::damping(const Point<double> &point, SparseMatrix &C) const
  {
    Eigen::MatrixXd local       = Eigen::MatrixXd::Zero(6, 6);
    local.topLeftCorner<3, 3>() = slope(point);
    block.add(local, C);
  }



  template class Evaluated<PointDrag, Force>;
} // namespace samara
