#include <samara/loads/loads.h>

#include <algorithm>
#include <limits>

namespace samara
{
  void
  Gravity::add_parameters(Parameters &prm)
  {
    prm.add("Acceleration", acceleration, "Of gravity [m/s^2].");
  }



  void
  Gravity::initialize(Model &m)
  {
    model = &m;
  }



  void
  Gravity::connect(Layout &layout)
  {
    blocks.resize(layout.n_nodes);
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      layout.couple(blocks[node], {Frame{node}});
  }



  template <typename Number>
  void
  Gravity::residual_at(const Point<Number> &point, Number *r) const
  {
    Eigen::Matrix<Number, Eigen::Dynamic, 1> local(6);
    for (unsigned int node = 1; node < blocks.size(); ++node)
      {
        const Mat3<Number> D = Frame{node}.triad(point.q);
        local = -model->nodes[node].inertia.leftCols<3>() * (D.transpose() * (point.factor * acceleration));
        blocks[node].add(local, r);
      }
  }



  void
  Gravity::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    Eigen::MatrixXd local(6, 6);
    for (unsigned int node = 1; node < blocks.size(); ++node)
      {
        const Matrix3 D = Frame{node}.triad(point.q);
        local.setZero();
        local.rightCols<3>() = -model->nodes[node].inertia.leftCols<3>() *
                               skew((D.transpose() * (point.factor * acceleration)).eval());
        blocks[node].add(local, K);
      }
  }



  double
  Gravity::potential_energy(const Point<double> &point) const
  {
    double energy = 0;
    for (unsigned int node = 1; node < blocks.size(); ++node)
      {
        // m (x + D c), with m c~ in the inertia
        const Matrix6 &M      = model->nodes[node].inertia;
        const Frame    frame{node};
        const Vector3  moment = M(0, 0) * frame.position(point.q) +
                               frame.triad(point.q) * axial(M.bottomLeftCorner<3, 3>());
        energy -= point.factor * acceleration.dot(moment);
      }
    return energy;
  }



  void
  WrenchLoad::add_axes_parameter(Parameters &prm)
  {
    prm.add("Axes",
            axes,
            "Axes of the components: inertial (a dead load) or body (a follower load).",
            dealii::Patterns::Selection("inertial|body"));
  }



  void
  WrenchLoad::connect(Layout &layout)
  {
    for (auto &load : points)
      {
        load.frame = layout.model.resolved(load.frame);
        layout.couple(load.block, {load.frame});
      }
  }



  template <typename Number>
  void
  WrenchLoad::residual_at(const Point<Number> &point, Number *r) const
  {
    Eigen::Matrix<Number, Eigen::Dynamic, 1> local(6);
    for (const auto &load : points)
      {
        const Vector3      f = vector(force, load, point.time, point.factor), m = vector(moment, load, point.time, point.factor);
        const Mat3<Number> D = axes == "body" ? Mat3<Number>(Mat3<Number>::Identity()) : load.frame.triad(point.q);
        local << -D.transpose() * f, -D.transpose() * m;
        load.block.add(local, r);
      }
  }



  void
  WrenchLoad::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    if (axes == "body")
      return;
    Eigen::MatrixXd local(6, 6);
    for (const auto &load : points)
      {
        const Matrix3 D = load.frame.triad(point.q);
        local.setZero();
        local.topRightCorner<3, 3>() =
          -skew((D.transpose() * vector(force, load, point.time, point.factor)).eval());
        local.bottomRightCorner<3, 3>() =
          -skew((D.transpose() * vector(moment, load, point.time, point.factor)).eval());
        load.block.add(local, K);
      }
  }



  double
  WrenchLoad::next_corner(const double from, const double to) const
  {
    double first = std::numeric_limits<double>::infinity();
    for (unsigned int i = 0; i < 3; ++i)
      first = std::min({first, force[i].next_corner(from, to), moment[i].next_corner(from, to)});
    return first;
  }



  void
  ConcentratedLoad::add_parameters(Parameters &prm)
  {
    prm.add("At", at, "Where it acts: body.point.");
    prm.add("Force", force, "Components, functions of time t [N].");
    prm.add("Moment", moment, "Components, functions of time t [N*m].");
    add_axes_parameter(prm);
  }



  void
  ConcentratedLoad::initialize(Model &model)
  {
    try
      {
        if (parameters.require("At", model.complaints))
          points.push_back({model.frame(at), 1., 0., {}});
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where("At"), problem.what());
      }
  }



  void
  LineLoad::add_parameters(Parameters &prm)
  {
    prm.add("Body", body, "Beam along which it acts.");
    prm.add("Force", force, "Components per length, functions of time t [N/m].");
    prm.add("Moment", moment, "Components per length, functions of time t [N].");
    prm.add("Variation", variation, "Factor along the beam, a function of the arc length s in metres [1].");
    add_axes_parameter(prm);
  }



  void
  LineLoad::initialize(Model &model)
  {
    if (!parameters.require("Body", model.complaints))
      return;
    try
      {
        for (const auto &station : model.find<Body>(body, "body").stations())
          points.push_back({station.frame, station.weight, station.abscissa, {}});
        if (points.empty() && model.complaints.empty())
          throw std::invalid_argument("body <" + body + "> has no length along which a load could act");
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where("Body"), problem.what());
      }
  }



  void
  SteadyRotation::add_parameters(Parameters &prm)
  {
    prm.add("Speed", rotation.speed, "Speed of rotation [rad/s].");
    prm.add("Joint", joint, "Joint whose rotation has this speed: a name, or name.rotation; empty: the whole model turns.");
    prm.add("Azimuth", azimuth, "Angle at which the joint is held in statics [rad].");
    prm.add("Axis", rotation.axis, "Axis about which the whole model turns, ground included [1].");
    prm.add("Through", rotation.through, "A point of this axis [m].");
  }



  void
  SteadyRotation::initialize(Model &m)
  {
    model         = &m;
    rotation.name = name;
    if (!joint.empty())
      try
        {
          rotation.coordinate = m.use_rotation(joint);
          for (const auto &other : m.rotations)
            if (other.coordinate == rotation.coordinate)
              throw std::invalid_argument("steady rotation <" + other.name + "> says already how <" + joint +
                                          "> turns");
        }
      catch (const std::invalid_argument &problem)
        {
          m.complaints.add(parameters.where("Joint"), problem.what());
        }
    else if (rotation.axis.isZero(0.))
      m.complaints.add(parameters.where("Axis"), "the axis must not be zero");
    m.rotations.push_back(rotation);
  }



  void
  SteadyRotation::connect(Layout &layout)
  {
    if (rotation.coordinate < 0)
      return;
    const auto prescribed = model->prescribed.find(rotation.coordinate);
    holding               = prescribed == model->prescribed.end();
    if (!holding)
      {
        if (parameters.is_set("Azimuth"))
          model->complaints.add(parameters.where("Azimuth"),
                                "the angle of <" + joint + "> is prescribed there; leave out the <Azimuth>");
        model->holds.push_back(prescribed->second);
        return;
      }
    multiplier = layout.add_multipliers({"steady rotation " + name});
    model->holds.push_back(multiplier);
    layout.couple(block, {}, {static_cast<unsigned int>(rotation.coordinate)}, {multiplier});
  }



  template <typename Number>
  void
  SteadyRotation::residual_at(const Point<Number> &point, Number *r) const
  {
    if (!holding)
      return;
    const Number                             lambda = point.multipliers[multiplier];
    Eigen::Matrix<Number, Eigen::Dynamic, 1> local(2);
    if (point.held)
      local << lambda, point.coordinates[rotation.coordinate] - azimuth;
    else
      local << Number(0), lambda;
    block.add(local, r);
  }



  void
  SteadyRotation::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    if (!holding)
      return;
    Eigen::MatrixXd local(2, 2);
    if (point.held)
      local << 0, 1, 1, 0;
    else
      local << 0, 0, 0, 1;
    block.add(local, K);
  }



  template class Evaluated<Gravity>;
  template class Evaluated<WrenchLoad>;
  template class Evaluated<SteadyRotation>;
} // namespace samara
