#include <samara/base/text.h>
#include <samara/joints/point_on_curve.h>
#include <samara/model/drawing.h>
#include <samara/model/signal.h>

#include <cmath>

namespace samara
{
  /** The three constraints. */
  class PointOnCurve::Constraints : public Evaluated<PointOnCurve::Constraints, Constraint>
  {
  public:
    explicit Constraints(const PointOnCurve &joint)
      : joint(joint)
    {}

    template <typename Number>
    void
    residual_at(const Point<Number> &point, Number *r) const
    {
      // rows E_iᴬ·Δ − c_i(σ); the equation of σ, −Σ λ_i t_i: no force along the curve
      const PairValues<Number> pair(joint.frame_a, joint.frame_b, point.q, point.q_of_forces(), false);
      PairForces<Number>       forces;
      const Number *const      lambda = point.multipliers + joint.first_multiplier;
      const Number             sigma  = point.coordinates[joint.coordinate] + joint.start;
      const GuideCurve::At     at     = joint.at(std::real(sigma));
      const Number             beyond = sigma - std::real(sigma); // of a complex step: to first order it is exact
      for (unsigned int k = 0; k < 3; ++k)
        {
          forces.add({PairFunction::gap, k}, pair, lambda[k]);
          r[joint.own_block.row(13 + k)] += pair.gaps(k) - at.x(k) - at.tangent(k) * beyond;
          r[joint.own_block.row(12)] -= (at.tangent(k) + at.curvature(k) * beyond) * lambda[k];
        }
      forces.add_to_nodes(pair, r + joint.own_block.row(0), r + joint.own_block.row(6));
    }

    void
    tangent(const Point<double> &point, SparseMatrix &K) const override
    {
      const PairValues<double> pair(joint.frame_a, joint.frame_b, point.q, false);
      const GuideCurve::At     at     = joint.at(point.coordinates[joint.coordinate] + joint.start);
      const double *const      lambda = point.multipliers + joint.first_multiplier;
      PairTangent              twists(pair);
      Matrix12                 H         = Matrix12::Zero();
      double                   curvature = 0;
      for (unsigned int k = 0; k < 3; ++k)
        {
          const PairFunction gap{PairFunction::gap, k};
          Vector12           g = Vector12::Zero();
          gap.add_gradient(pair, 1., g);
          twists.add(gap, lambda[k]);
          joint.own_block.add_border(13 + k, g, K);
          joint.own_block.add_entry(12, 13 + k, -at.tangent(k), K);
          joint.own_block.add_entry(13 + k, 12, -at.tangent(k), K);
          curvature += at.curvature(k) * lambda[k];
        }
      joint.own_block.add_entry(12, 12, -curvature, K);
      twists.add_to(H);
      joint.own_block.add_twists(H, K);
    }

    void
    rates(const Point<double> &point, double *rates) const override
    {
      const PairValues<double> pair(joint.frame_a, joint.frame_b, point.q, false);
      const PairRates          change(pair, point.y);
      const GuideCurve::At     at = joint.at(point.coordinates[joint.coordinate] + joint.start);
      for (unsigned int k = 0; k < 3; ++k)
        rates[joint.first_multiplier + k] = change.gaps(k) - at.tangent(k) * point.rates[joint.coordinate];
    }

    void
    second_rates(const Point<double> &point, double *rates) const override
    {
      const PairValues<double> pair(joint.frame_a, joint.frame_b, point.q, false);
      const PairRates          change(pair, point.y);
      const PairSecondRates    second(pair, change, point.y, false);
      const GuideCurve::At     at    = joint.at(point.coordinates[joint.coordinate] + joint.start);
      const double             speed = point.rates[joint.coordinate];
      for (unsigned int k = 0; k < 3; ++k)
        rates[joint.first_multiplier + k] = second.gaps(k) - at.curvature(k) * speed * speed;
    }

  private:
    const PointOnCurve &joint;
  };



  void
  PointOnCurve::add_parameters(Parameters &prm)
  {
    prm.add("Body A", body_a, "Body with the curve: body.point, or ground.");
    prm.add("Body B", body_b, "Body with the point: body.point.");
    prm.add(
      "Expressions",
      expressions,
      "x, y, z of the curve in the reference configuration, as smooth functions of s from 0 to 1; beyond its ends "
      "it goes on straight [m].");
    prm.add("Axis", axis, "Direction of joint axis 3 in the reference configuration, inertial components [1].");
    prm.add("Axis 1", axis_1, "Direction near which joint axis 1 lies; 0, 0, 0: any [1].");
    prm.turns("Expressions", Turning::position);
    prm.turns("Axis", Turning::direction);
    prm.turns("Axis 1", Turning::direction);
    friction.add_parameters(prm.subsection("displacement"), true, false);
    ball.add_parameters(prm);
  }



  void
  PointOnCurve::initialize(Model &m)
  {
    model           = &m;
    const auto ends = ends_of_joint(m, *this, body_a, body_b);
    if (!parameters.require("Expressions", m.complaints) || !ends)
      return;
    try
      {
        E = axes();
      }
    catch (const std::invalid_argument &problem)
      {
        return m.complaints.add(parameters.where("Axis"), problem.what());
      }
    try
      {
        curve = std::make_unique<GuideCurve>(expressions);
      }
    catch (const std::invalid_argument &problem)
      {
        return m.complaints.add(parameters.where("Expressions"), "joint <" + name + ">: " + problem.what());
      }
    // drawings are rounded, as those of other joints are: the point is then the nearest one of the curve
    constexpr double rounding = 1e-5;
    const Vector3    x        = m.position((*ends)[1]);
    start                     = curve->nearest(x);
    const Vector3 on_curve    = curve->at(start).x;
    if ((on_curve - x).norm() > rounding * std::max(curve->length(), box_diagonal(m)))
      return m.complaints.add(parameters.where("Expressions"),
                              "joint <" + name + ">: the curve is " + number_to_text("%.6g", (on_curve - x).norm()) +
                                " m away from <" + body_b + ">");
    // at the point, not at the model's origin: between its ends a step has axes that are not of unit length, and an arm
    // of some length would be counted with them
    origin     = on_curve;
    frame_a    = m.frame_at((*ends)[0], origin, E);
    frame_b    = m.frame_at((*ends)[1], origin, E);
    coordinate = m.add_coordinate(name + ".displacement", "m");

    const Parameters &along = parameters.subsection("displacement");
    const std::string whose = "joint <" + name + ">, displacement";
    bristles.clear();
    if (friction.is_given())
      friction_law = friction.law(along, whose, m.complaints);
    else
      FrictionEntries::refuse_unused(along, whose, m.complaints);
    if (friction.is_given() && friction_law.has_bristles())
      bristles = {static_cast<unsigned int>(m.add_state(name + ".displacement bristles", "m", 0., 1.))};
    ball.initialize(m, *this, parameters.subsection("rotation"), {});
  }



  void
  PointOnCurve::connect(Layout &layout)
  {
    frame_a = layout.model.resolved(frame_a);
    frame_b = layout.model.resolved(frame_b);
    if (!check_ends(*model, *this, frame_a, frame_b, "<" + body_a + "> and <" + body_b + ">"))
      return;
    first_multiplier = layout.add_multipliers(*this, {"curve 1", "curve 2", "curve 3"});
    layout.couple(own_block,
                  {{frame_a.node}, {frame_b.node}},
                  {coordinate},
                  {first_multiplier, first_multiplier + 1, first_multiplier + 2});
    for (unsigned int k = 0; k < 3; ++k)
      layout.corrections.push_back({first_multiplier + k, coordinate});
    term = std::make_unique<Constraints>(*this);
    layout.add(*this, *term);
    add_friction_along(layout);
    ball.connect(layout, *this, frame_a, frame_b, {first_multiplier, first_multiplier + 1, first_multiplier + 2});
  }



  void
  PointOnCurve::add_friction_along(Layout &layout)
  {
    rubbing.clear();
    if (!friction.is_given())
      return;
    Layout::Friction along;
    along.coordinates = {coordinate};
    along.states      = bristles;
    along.law         = friction_law;
    along.preload     = friction.preload;
    along.multipliers = {first_multiplier, first_multiplier + 1, first_multiplier + 2};
    along.name        = "joint " + name + ", friction of the displacement";
    rubbing.add_friction(layout, *this, along);
  }



  template <typename Number>
  PressingParts<Number>
  PointOnCurve::parts_at(const Point<Number> &point) const
  {
    const Number         sigma  = point.coordinates[coordinate] + start;
    const GuideCurve::At along  = at(std::real(sigma));
    const Number         beyond = sigma - std::real(sigma); // of a complex step
    Vec3<Number>         t;
    for (unsigned int k = 0; k < 3; ++k)
      t(k) = along.tangent(k) + along.curvature(k) * beyond;
    PressingParts<Number> parts;
    parts.add(3) = Mat3<Number>::Identity() - t * t.transpose();
    return parts;
  }



  PressingParts<double>
  PointOnCurve::pressing_parts(const Layout::Friction &, const Point<double> &point) const
  {
    return parts_at(point);
  }



  PressingParts<std::complex<double>>
  PointOnCurve::pressing_parts(const Layout::Friction &, const Point<std::complex<double>> &point) const
  {
    return parts_at(point);
  }



  std::optional<unsigned int>
  PointOnCurve::use_coordinate(Model &, const std::string &motion)
  {
    return motion.empty() || motion == "displacement" ? std::optional<unsigned int>(coordinate) : std::nullopt;
  }



  std::shared_ptr<Signal>
  PointOnCurve::signal(Model &, const std::string &path)
  {
    return path == "displacement"      ? coordinate_signal(coordinate, 0.) :
           path == "displacement rate" ? rate_signal(coordinate) :
                                         nullptr;
  }



  void
  PointOnCurve::add_relative_rates(const double *q, std::vector<RelativeRate> &rates) const
  {
    add_turns(q, rates);
    // along the curve, where the point is
    const PairValues<double> pair(frame_a, frame_b, q, false);
    const Vector3            t = at(curve->nearest(origin + E * pair.gaps)).tangent;
    Vector12                 g = Vector12::Zero();
    for (unsigned int k = 0; k < 3; ++k)
      PairFunction{PairFunction::gap, k}.add_gradient(pair, t(k), g);
    RelativeRate rate;
    rate.name      = name + ".displacement";
    rate.a         = frame_a.node;
    rate.b         = frame_b.node;
    rate.on_a      = g.head<6>();
    rate.on_b      = g.tail<6>();
    rate.in_metres = true;
    rates.push_back(rate);
  }



  std::optional<Probe>
  PointOnCurve::probe(const std::string &path) const
  {
    if (path == "displacement" || path == "arc length")
      return Probe{path, "m", [this, from = path == "displacement" ? 0. : start](const State &state) {
                     return from + state.coordinates[coordinate];
                   }};
    if (path == "displacement rate")
      return Probe{path, "m/s", [this](const State &state) { return state.rates[coordinate]; }};
    if (path == "force")
      return Probe{path, "N", [this](const State &state) { return force(state).norm(); }};
    for (unsigned int k = 0; k < 3; ++k)
      if (path == "force " + std::to_string(k + 1))
        return Probe{path, "N", [this, k](const State &state) { return force(state)(k); }};
    return {};
  }



  GuideCurve::At
  PointOnCurve::at(const double sigma) const
  {
    const GuideCurve::At along_x = curve->at(sigma);
    return {E.transpose() * (along_x.x - origin), E.transpose() * along_x.tangent, E.transpose() * along_x.curvature};
  }



  Vector3
  PointOnCurve::force(const State &state) const
  {
    return -Eigen::Map<const Vector3>(&state.multipliers[first_multiplier]);
  }



  std::vector<std::string>
  PointOnCurve::probe_names() const
  {
    return {"displacement", "displacement rate", "arc length", "force", "force 1", "force 2", "force 3"};
  }



  void
  PointOnCurve::draw(const State &state, Drawing &drawing) const
  {
    constexpr unsigned int n = 60;
    const Vector3          o = frame_a.position(state.q.data());
    const Matrix3          A = frame_a.triad(state.q.data());
    drawing.begin_object(name);
    Sample from = drawing.sample(frame_a, state), to = from;
    for (unsigned int i = 0; i < n; ++i)
      {
        from.x = o + A * at(curve->length() * i / n).x;
        to.x   = o + A * at(curve->length() * (i + 1) / n).x;
        drawing.bar(from, to, 0.002 * curve->length());
      }
    drawing.sphere(drawing.sample(frame_b, state), 0.008 * curve->length());
  }
} // namespace samara
