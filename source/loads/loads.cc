#include <samara/loads/loads.h>

#include <algorithm>

namespace samara
{
  namespace
  {
    template <typename Point>
    Vector3
    value(const VectorOfTime &f, const Point &point)
    {
      return point.factor * Vector3(f[0](point.time), f[1](point.time), f[2](point.time));
    }

    double
    first_corner(const VectorOfTime &f, const double from, const double to)
    {
      return std::min({f[0].next_corner(from, to), f[1].next_corner(from, to), f[2].next_corner(from, to)});
    }

    bool
    is_constant(const VectorOfTime &f)
    {
      return std::all_of(f.begin(), f.end(), [](const auto &component) { return component.is_constant(); });
    }

    /** For Block::add(), which changes it; memory is not asked for again. */
    template <typename Number>
    Eigen::Matrix<Number, Eigen::Dynamic, 1> &
    local_residual()
    {
      static thread_local Eigen::Matrix<Number, Eigen::Dynamic, 1> local(6);
      return local;
    }

    Eigen::MatrixXd &
    local_tangent()
    {
      static thread_local Eigen::MatrixXd local(6, 6);
      local.setZero();
      return local;
    }
  } // namespace



  void
  Gravity::add_parameters(Parameters &prm)
  {
    prm.add("Acceleration", acceleration, "Components, functions of time t [m/s^2].");
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
    auto         &local = local_residual<Number>();
    const Vector3 a     = value(acceleration, point);
    for (unsigned int node = 1; node < blocks.size(); ++node)
      {
        const Mat3<Number>                D      = Frame{node}.triad(point.q);
        const Eigen::Matrix<Number, 3, 1> a_node = D.transpose() * a;
        local.noalias()                          = -model->nodes[node].inertia.leftCols<3>() * a_node;
        blocks[node].add(local, r);
      }
  }



  void
  Gravity::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    const Vector3 a = value(acceleration, point);
    for (unsigned int node = 1; node < blocks.size(); ++node)
      {
        const Matrix3 D      = Frame{node}.triad(point.q);
        auto         &local  = local_tangent();
        local.rightCols<3>() = -model->nodes[node].inertia.leftCols<3>() * skew((D.transpose() * a).eval());
        blocks[node].add(local, K);
      }
  }



  double
  Gravity::potential_energy(const Point<double> &point) const
  {
    if (!is_constant(acceleration))
      return 0;
    double        energy = 0;
    const Vector3 a      = value(acceleration, point);
    for (unsigned int node = 1; node < blocks.size(); ++node)
      {
        // m (x + D c), with m c~ in the inertia
        const Matrix6 &M = model->nodes[node].inertia;
        const Frame    frame{node};
        const Vector3  moment =
          M(0, 0) * frame.position(point.q) + frame.triad(point.q) * axial(M.bottomLeftCorner<3, 3>());
        energy -= a.dot(moment);
      }
    return energy;
  }



  double
  Gravity::next_corner(const double from, const double to) const
  {
    return first_corner(acceleration, from, to);
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
    is_follower = axes == "body";
    for (auto &load : points)
      {
        load.weight *= shape(load.abscissa);
        load.frame = layout.model.resolved(load.frame);
        layout.couple(load.block, {load.frame});
      }
  }



  template <typename Number>
  void
  WrenchLoad::residual_at(const Point<Number> &point, Number *r) const
  {
    auto         &local = local_residual<Number>();
    const Vector3 f = value(force, point), m = value(moment, point);
    for (const auto &load : points)
      {
        if (is_follower)
          local << (-load.weight * f).template cast<Number>(), (-load.weight * m).template cast<Number>();
        else
          {
            const Mat3<Number> D = load.frame.triad(point.q);
            local << -load.weight * (D.transpose() * f), -load.weight * (D.transpose() * m);
          }
        load.block.add(local, r);
      }
  }



  void
  WrenchLoad::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    if (is_follower)
      return;
    const Vector3 f = value(force, point), m = value(moment, point);
    for (const auto &load : points)
      {
        const Matrix3 D                 = load.frame.triad(point.q);
        auto         &local             = local_tangent();
        local.topRightCorner<3, 3>()    = -load.weight * skew((D.transpose() * f).eval());
        local.bottomRightCorner<3, 3>() = -load.weight * skew((D.transpose() * m).eval());
        load.block.add(local, K);
      }
  }



  double
  WrenchLoad::next_corner(const double from, const double to) const
  {
    return std::min(first_corner(force, from, to), first_corner(moment, from, to));
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
        if (points.empty())
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
    prm.add("Joint",
            joint,
            "Joint whose rotation has this speed: a name, or name.rotation; empty: the whole model turns.");
    prm.add("Azimuth", azimuth, "Angle at which the joint is held in statics [rad].");
    prm.add("Axis", rotation.axis, "Axis about which the whole model turns, ground included [1].");
    prm.add("Through", rotation.through, "A point of this axis [m].");
  }



  void
  SteadyRotation::initialize(Model &m)
  {
    model         = &m;
    rotation.name = name;
    for (const std::string entry : {"Axis", "Through", "Azimuth"})
      if (parameters.is_set(entry) && joint.empty() == (entry == "Azimuth"))
        m.complaints.add(parameters.where(entry),
                         "steady rotation <" + name + "> turns " +
                           (joint.empty() ? "the whole model: there is no <Joint> to hold at" :
                                            "at the <Joint>, which says about which axis; leave out") +
                           " the <" + entry + ">");
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
