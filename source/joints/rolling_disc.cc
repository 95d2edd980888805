#include <samara/base/text.h>
#include <samara/joints/rolling_disc.h>
#include <samara/model/drawing.h>

#include <cmath>

namespace samara
{
  namespace
  {
    const PairFunction disc_tilt{PairFunction::cosine, 2, 2}, disc_height{PairFunction::gap, 2};

    /** The disc and the plane at one configuration, c and s being unknowns of their own; inertial components. */
    template <typename Number>
    struct DiscOnPlane
    {
      const PairValues<Number> &pair;
      Number                    radius, sine, cosine;
      Vec3<Number>              normal, axle, along, across; ///< n, a, t, l

      DiscOnPlane(const PairValues<Number> &pair, const double radius, const Number &cosine, const Number &sine)
        : pair(pair)
        , radius(radius)
        , sine(sine)
        , cosine(cosine)
        , normal(pair.A.col(2))
        , axle(pair.b.triad(pair.q).col(2))
        , along(cross(normal, axle))
        , across(axle - normal * cosine)
      {}

      /** Force on the disc [N] and moment on it about its centre [N m] of the multipliers of no slip. */
      Vec3<Number>
      force(const Number *lambda) const
      {
        return along * lambda[0] + across * lambda[1];
      }
      Vec3<Number>
      moment(const Number *lambda) const
      {
        return axle * (lambda[0] * radius * sine) - along * (lambda[1] * radius * sine);
      }

      /** Add them, and their reactions on the plane, to the residual of the two nodes. */
      void
      add_forces(const Number *lambda, Number *at_a, Number *at_b) const
      {
        const Vec3<Number> f = force(lambda), m = moment(lambda), none = Vec3<Number>::Zero(),
                           m_a = pair.in_a(Vec3<Number>(-cross(pair.gap, f) - m)), m_b = pair.in_b(m);
        pair.a.add_force(pair.q_of_forces, Vec3<Number>(-f), none, at_a);
        pair.b.add_force(pair.q_of_forces, f, none, at_b);
        for (unsigned int i = 0; i < 3; ++i)
          {
            at_a[3 + i] += m_a(i);
            at_b[3 + i] += m_b(i);
          }
      }

      /** The coefficients of the twists in one of the two velocities at the contact. */
      Vector12
      coefficients(const unsigned int i) const
      {
        const double unit[2] = {i == 0 ? 1. : 0., i == 1 ? 1. : 0.};
        Vector12     b       = Vector12::Zero();
        add_forces(unit, b.data(), b.data() + 6);
        return b;
      }
    };



    /** The derivative of DiscOnPlane<double>::add_forces() by the twists, and in the last columns by c and s. */
    Eigen::Matrix<double, 12, 14>
    derivative_of_forces(const DiscOnPlane<double> &at, const double *lambda)
    {
      using Rows                        = Eigen::Matrix<double, 3, 14>;
      const Frame                    &a = at.pair.a, &b = at.pair.b;
      const double                   *q = at.pair.q;
      const Eigen::Map<const Matrix3> D_a(q + 12 * a.node + 3), D_b(q + 12 * b.node + 3);
      // δn = D_A (θ_A × n), δΔ = D_B (u_B − r_B~ θ_B) − D_A (u_A − r_A~ θ_A)
      Rows normal = Rows::Zero(), axle = Rows::Zero(), gap = Rows::Zero(), along, across, force, moment, moment_a;
      normal.middleCols<3>(3) = -D_a * skew(a.rotation.col(2).eval());
      axle.middleCols<3>(9)   = -D_b * skew(b.rotation.col(2).eval());
      gap << -D_a, D_a * skew(a.arm), D_b, -D_b * skew(b.arm), Vector3::Zero(), Vector3::Zero();
      along  = skew(at.normal) * axle - skew(at.axle) * normal;
      across = axle - at.cosine * normal;
      across.col(12) -= at.normal;
      force  = lambda[0] * along + lambda[1] * across;
      moment = at.radius * at.sine * (lambda[0] * axle - lambda[1] * along);
      moment.col(13) += at.radius * (lambda[0] * at.axle - lambda[1] * at.along);
      const Vector3 f = at.force(lambda), m = at.moment(lambda);
      moment_a = skew(f) * gap - skew(at.pair.gap) * force - moment;

      // δ(Dᵀv) = Dᵀδv + (Dᵀv)~ θ
      const auto in_node = [](const auto &D, const Vector3 &v, const Rows &change, const int turn) {
        Rows result = D.transpose() * change;
        result.template middleCols<3>(turn) += skew((D.transpose() * v).eval());
        return result;
      };
      const Rows                    f_a = in_node(D_a, -f, -force, 3), f_b = in_node(D_b, f, force, 9);
      Eigen::Matrix<double, 12, 14> K;
      K << f_a, skew(a.arm) * f_a + in_node(D_a, -at.pair.gap.cross(f) - m, moment_a, 3), f_b,
        skew(b.arm) * f_b + in_node(D_b, m, moment, 9);
      return K;
    }
  } // namespace



  /** Three constraints on places and two on velocities. */
  class RollingDisc::Constraints : public Evaluated<RollingDisc::Constraints, Constraint>
  {
  public:
    explicit Constraints(const RollingDisc &joint)
      : joint(joint)
    {}

    template <typename Number>
    void
    residual_at(const Point<Number> &point, Number *r) const
    {
      // rows of tilt, height and angle, and equations of c and s: doc/theory/joints.md, rolling disc; rows of
      // velocities have no residual
      const PairValues<Number> pair(joint.frame_a, joint.frame_b, point.q, point.q_of_forces());
      const auto               at     = disc_at(pair, point);
      const Number *const      lambda = point.multipliers + joint.first_multiplier;
      const Block             &block  = joint.own_block;
      PairForces<Number>       forces;
      forces.add(disc_tilt, pair, lambda[0]);
      forces.add(disc_height, pair, lambda[1]);
      forces.add_to_nodes(pair, r + block.row(0), r + block.row(6));
      at.add_forces(lambda + 3, r + block.row(0), r + block.row(6));
      r[block.row(12)] += lambda[2] * at.cosine - lambda[0];
      r[block.row(13)] += lambda[2] * at.sine - lambda[1] * at.radius;
      r[block.row(14)] += disc_tilt.value(pair) - at.cosine;
      r[block.row(15)] += disc_height.value(pair) - at.radius * at.sine;
      r[block.row(16)] += 0.5 * (at.cosine * at.cosine + at.sine * at.sine - 1.);
    }

    void
    tangent(const Point<double> &point, SparseMatrix &K) const override
    {
      const PairValues<double> pair(joint.frame_a, joint.frame_b, point.q);
      const auto               at     = disc_at(pair, point);
      const double *const      lambda = point.multipliers + joint.first_multiplier;
      const Block             &block  = joint.own_block;
      PairTangent              twists(pair);
      Matrix12                 H    = Matrix12::Zero();
      Vector12                 tilt = Vector12::Zero(), height = Vector12::Zero();
      twists.add(disc_tilt, lambda[0]);
      twists.add(disc_height, lambda[1]);
      twists.add_to(H);
      const auto slip = derivative_of_forces(at, lambda + 3);
      H += slip.leftCols<12>();
      block.add_twists(H, K);
      for (unsigned int i = 0; i < 12; ++i)
        for (const unsigned int j : {12, 13})
          block.add_entry(i, j, slip(i, j), K);

      disc_tilt.add_gradient(pair, 1., tilt);
      disc_height.add_gradient(pair, 1., height);
      block.add_border(14, tilt, K);
      block.add_border(15, height, K);
      block.add_border(17, at.coefficients(0), K);
      block.add_border(18, at.coefficients(1), K);
      const auto add_symmetric = [&](const unsigned int i, const unsigned int j, const double value) {
        block.add_entry(i, j, value, K);
        block.add_entry(j, i, value, K);
      };
      add_symmetric(12, 14, -1.);
      add_symmetric(13, 15, -at.radius);
      add_symmetric(12, 16, at.cosine);
      add_symmetric(13, 16, at.sine);
      block.add_entry(12, 12, lambda[2], K);
      block.add_entry(13, 13, lambda[2], K);
    }

    void
    rates(const Point<double> &point, double *rates) const override
    {
      const PairValues<double>        pair(joint.frame_a, joint.frame_b, point.q);
      const PairRates                 change(pair, point.y);
      const auto                      at        = disc_at(pair, point);
      const double *const             change_of = point.rates + joint.coordinate;
      double *const                   g         = rates + joint.first_multiplier;
      const Eigen::Map<const Vector6> y_a(point.y + 6 * joint.frame_a.node), y_b(point.y + 6 * joint.frame_b.node);
      g[0] = disc_tilt.rate(pair, change) - change_of[0];
      g[1] = disc_height.rate(pair, change) - at.radius * change_of[1];
      g[2] = at.cosine * change_of[0] + at.sine * change_of[1];
      for (const unsigned int i : {0, 1})
        {
          const Vector12 b = at.coefficients(i);
          g[3 + i]         = b.head<6>().dot(y_a) + b.tail<6>().dot(y_b);
        }
    }

    void
    second_rates(const Point<double> &point, double *rates) const override
    {
      const PairValues<double>     pair(joint.frame_a, joint.frame_b, point.q);
      const PairRates              change(pair, point.y);
      const PairSecondRates        second(pair, change, point.y);
      const auto                   at = disc_at(pair, point);
      Eigen::Matrix<double, 14, 1> y; // twists, and the rates of c and s
      y << Eigen::Map<const Vector6>(point.y + 6 * joint.frame_a.node),
        Eigen::Map<const Vector6>(point.y + 6 * joint.frame_b.node),
        Eigen::Map<const Eigen::Vector2d>(point.rates + joint.coordinate);
      double *const g = rates + joint.first_multiplier;
      g[0]            = disc_tilt.second_rate(pair, change, second);
      g[1]            = disc_height.second_rate(pair, change, second);
      g[2]            = y.tail<2>().squaredNorm();
      for (const unsigned int i : {0, 1})
        {
          const double unit[2] = {i == 0 ? 1. : 0., i == 1 ? 1. : 0.};
          g[3 + i]             = y.head<12>().dot(derivative_of_forces(at, unit) * y);
        }
    }

  private:
    const RollingDisc &joint;

    template <typename Number>
    DiscOnPlane<Number>
    disc_at(const PairValues<Number> &pair, const Point<Number> &point) const
    {
      const Number *const change = point.coordinates + joint.coordinate;
      return {pair, joint.radius, change[0] + std::cos(joint.start), change[1] + std::sin(joint.start)};
    }
  };



  void
  RollingDisc::add_parameters(Parameters &prm)
  {
    prm.add("Body A", body_a, "Body with the plane: body.point, or ground.");
    prm.add("Body B", body_b, "Body with the disc: body.point at its centre.");
    prm.add("Radius", radius, "Radius of the disc [m].", dealii::Patterns::Double(0));
    prm.add("Position",
            position,
            "A point of the plane in the reference configuration; default: where the disc touches it [m].");
    prm.add(
      "Axis",
      axis,
      "Normal of the plane (joint axis 3) in the reference configuration, towards the disc, inertial components [1].");
    prm.add("Axis 1", axis_1, "Direction near which joint axis 1 lies; 0, 0, 0: any [1].");
    prm.add("Axle",
            axle,
            "Direction of the axle, fixed to body B, in the reference configuration, inertial components [1].");
    prm.turns("Position", Turning::given_position);
    prm.turns("Axis", Turning::direction);
    prm.turns("Axis 1", Turning::direction);
    prm.turns("Axle", Turning::direction);
  }



  void
  RollingDisc::be_moved(const MotionOf &motion_of)
  {
    const Vector3 drawn = axle;
    Joint::be_moved(motion_of);
    parameters.assign("Axle", Vector3(motion_of(body_b).rotation * drawn));
  }



  void
  RollingDisc::initialize(Model &m)
  {
    model               = &m;
    const auto ends     = ends_of_joint(m, *this, body_a, body_b);
    const bool has_size = parameters.require("Radius", m.complaints),
               has_axle = parameters.require("Axle", m.complaints);
    if (!has_size || !has_axle || !ends)
      return;
    const auto complain = [&](const std::string &entry, const std::string &text) {
      m.complaints.add(parameters.where(entry), "joint <" + name + ">: " + text);
    };
    if (radius == 0.)
      return complain("Radius", "the disc must have a radius above zero");
    if (axle.isZero(0.))
      return complain("Axle", "the axle must not be zero");
    const Matrix3    E = axes();
    const Vector3    n = E.col(2), a = axle.normalized(), centre = m.position((*ends)[1]);
    constexpr double least_tilt = 1e-3; // of the sine, below which the disc lies flat
    start                       = std::atan2(n.cross(a).norm(), n.dot(a));
    if (std::sin(start) < least_tilt)
      return complain("Axle", "the disc must not lie flat on the plane");
    const double height = radius * std::sin(start);
    if (!parameters.is_set("Position"))
      position = centre - radius * (n - std::cos(start) * a) / std::sin(start);
    if (const double distance = n.dot(centre - position); std::abs(distance - height) > 1e-9 * radius)
      return complain("Position",
                      "the centre of the disc is " + number_to_text(distance) +
                        " m above the plane (to the side where <Axis> points), not " + number_to_text(height) +
                        " m, where its edge touches it; without a <Position> the plane is put there");
    // on the plane to round-off: heights are kept from what they are in the reference configuration
    position += (n.dot(centre - position) - height) * n;
    frame_a    = m.frame_at((*ends)[0], position, E);
    frame_b    = m.frame_at((*ends)[1], centre, triad_about(a));
    coordinate = m.add_coordinate(name + ".cosine of the tilt", "1");
    m.add_coordinate(name + ".sine of the tilt", "1");
  }



  void
  RollingDisc::connect(Layout &layout)
  {
    frame_a = layout.model.resolved(frame_a);
    frame_b = layout.model.resolved(frame_b);
    if (!check_ends(*model, *this, frame_a, frame_b, "<" + body_a + "> and <" + body_b + ">"))
      return;
    first_multiplier     = layout.add_multipliers(*this,
                                              {"measure of the tilt",
                                                   "distance from the plane",
                                                   "cosine and sine of the tilt",
                                                   "rolling along",
                                                   "rolling across"});
    const unsigned int m = first_multiplier;
    layout.couple(own_block,
                  {{frame_a.node}, {frame_b.node}},
                  {coordinate, coordinate + 1},
                  {m, m + 1, m + 2, m + 3, m + 4});
    layout.nonholonomic.push_back(m + 3);
    layout.nonholonomic.push_back(m + 4);
    term = std::make_unique<Constraints>(*this);
    layout.add(*this, *term);
  }



  double
  RollingDisc::theta(const State &state) const
  {
    return std::atan2(state.coordinates[coordinate + 1] + std::sin(start),
                      state.coordinates[coordinate] + std::cos(start));
  }



  double
  RollingDisc::rate(const State &state) const
  {
    const double angle = theta(state);
    return std::cos(angle) * state.rates[coordinate + 1] - std::sin(angle) * state.rates[coordinate];
  }



  Vector3
  RollingDisc::contact(const State &state) const
  {
    const PairValues<double>  pair(frame_a, frame_b, state.q.data());
    const DiscOnPlane<double> at(pair, radius, std::cos(theta(state)), std::sin(theta(state)));
    return pair.in_axes_of_a(pair.gap - radius / at.sine * (at.normal - at.cosine * at.axle));
  }



  Vector3
  RollingDisc::force(const State &state) const
  {
    const PairValues<double>  pair(frame_a, frame_b, state.q.data());
    const DiscOnPlane<double> at(pair, radius, std::cos(theta(state)), std::sin(theta(state)));
    const double *const       lambda = &state.multipliers[first_multiplier];
    return pair.in_axes_of_a(-at.force(lambda + 3)) - lambda[1] * Vector3::UnitZ();
  }



  std::optional<Probe>
  RollingDisc::probe(const std::string &path) const
  {
    if (path == "tilt")
      return Probe{path, "deg", [this](const State &state) { return theta(state) * 180 / M_PI - 90; }};
    if (path == "tilt rate")
      return Probe{path, "rad/s", [this](const State &state) { return rate(state); }};
    for (unsigned int i = 0; i < 3; ++i)
      if (path == "force " + std::to_string(i + 1))
        return Probe{path, "N", [this, i](const State &state) { return force(state)(i); }};
      else if (i < 2 && path == "displacement " + std::to_string(i + 1))
        return Probe{path, "m", [this, i](const State &state) { return contact(state)(i); }};
    for (const unsigned int i : {0, 1})
      if (path == (i == 0 ? "force along" : "force across"))
        return Probe{path, "N", [this, i](const State &state) {
                       return -state.multipliers[first_multiplier + 3 + i] * std::sin(theta(state));
                     }};
    return {};
  }



  std::vector<std::string>
  RollingDisc::probe_names() const
  {
    return {"tilt",
            "tilt rate",
            "displacement 1",
            "displacement 2",
            "force 1",
            "force 2",
            "force 3",
            "force along",
            "force across"};
  }



  void
  RollingDisc::draw(const State &state, Drawing &drawing) const
  {
    const Sample disc  = drawing.sample(frame_b, state);
    Sample       plate = disc;
    plate.D            = frame_a.triad(state.q.data());
    drawing.begin_object(name);
    drawing.cylinder(disc, 2, radius, 0.02 * radius);
    // a piece of the plane, below the disc
    const Vector3 n = plate.D.col(2);
    plate.x         = disc.x - (n.dot(disc.x - frame_a.position(state.q.data())) + 0.02 * radius) * n;
    drawing.box(plate, radius * Vector3(2, 2, 0.04));
  }
} // namespace samara
