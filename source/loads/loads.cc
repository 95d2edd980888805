#include <samara/base/composite_rule.h>
#include <samara/loads/loads.h>

#include <algorithm>
#include <cmath>

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

    template <typename Functions>
    double
    first_corner(const Functions &f, const double from, const double to)
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
    layout.add(*this, *this);
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



  bool
  Gravity::has_potential() const
  {
    return is_constant(acceleration);
  }



  double
  Gravity::potential_energy(const Point<double> &point) const
  {
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
  WrenchLoad::find_signals(Model &model)
  {
    const auto find = [&](Responses &responses, const unsigned int first) {
      for (unsigned int i = first; i < first + 3; ++i)
        if (const Law &law = i < 3 ? force[i] : moment[i - 3]; law.depends_on_state())
          responses[i] = std::make_unique<Response>(law, model);
    };
    const auto any = [](const std::array<Law, 3> &laws) {
      return std::any_of(laws.begin(), laws.end(), [](const Law &law) { return law.depends_on_state(); });
    };
    depends_on_state = any(force) || any(moment);
    for (const bool is_force : {true, false})
      try
        {
          const unsigned int first = is_force ? 0 : 3;
          for (auto &load : points)
            find(load.responses, first);
          for (auto &span : spans)
            find(span.responses, first);
        }
      catch (const std::invalid_argument &problem)
        {
          model.complaints.add(parameters.where(is_force ? "Force" : "Moment"), problem.what());
        }
  }



  void
  WrenchLoad::connect(Layout &layout)
  {
    const auto connect_to = [&](const std::vector<Frame> &frames, Block &block, Responses &responses) {
      layout.couple(block, frames);
      for (auto &response : responses)
        if (response)
          response->connect(layout, {frames, {}, {}, {}});
    };
    for (auto &load : points)
      {
        load.frame = layout.model.resolved(load.frame);
        connect_to({load.frame}, load.block, load.responses);
      }
    for (auto &span : spans)
      {
        for (auto &frame : span.frames)
          frame = layout.model.resolved(frame);
        connect_to(span.frames, span.block, span.responses);
      }
    layout.add(*this, *this);
  }



  template <typename Number>
  Vec6<Number>
  WrenchLoad::wrench(const Responses &responses, const Point<Number> &point) const
  {
    Vec6<Number> result;
    for (unsigned int i = 0; i < 6; ++i)
      result(i) = point.factor * (responses[i] ? (*responses[i])(point) :
                                                 Number((i < 3 ? force[i] : moment[i - 3]).of_time()(point.time)));
    return result;
  }



  template <typename Number>
  void
  WrenchLoad::local_residual(const AtPoint &load, const Vec6<Number> &wrench, const Number *q, Local<Number> &r) const
  {
    const Vec3<Number> f = -load.weight * wrench.template head<3>(), m = -load.weight * wrench.template tail<3>();
    r.resize(6);
    if (is_follower())
      r << f, m;
    else
      {
        const Mat3<Number> D = load.frame.triad(q);
        r << D.transpose() * f, D.transpose() * m;
      }
  }



  template <typename Number>
  void
  WrenchLoad::local_residual(const AlongSpan &span, const Vec6<Number> &wrench, const Number *q, Local<Number> &r) const
  {
    r.resize(6 * span.frames.size());
    for (unsigned int a = 0; a < span.frames.size(); ++a)
      {
        Mat3<Number> d = Mat3<Number>::Zero(); // ∫ N_a p d ds
        for (unsigned int b = 0; b < span.frames.size(); ++b)
          d += span.products(a, b) * span.frames[b].triad(q);
        const Mat3<Number> seen = -span.frames[a].triad(q).transpose() * d;
        r.template segment<6>(6 * a) << seen * wrench.template head<3>(), seen * wrench.template tail<3>();
      }
  }



  template <typename Number>
  void
  WrenchLoad::residual_at(const Point<Number> &point, Number *r) const
  {
    // Block::add() changes it; memory is not asked for again
    static thread_local Local<Number> local;
    const auto                        add = [&](const auto &parts) {
      for (const auto &part : parts)
        {
          local_residual(part, wrench(part.responses, point), point.q, local);
          part.block.add(local, r);
        }
    };
    add(points);
    add(spans);
  }



  template <typename Part>
  void
  WrenchLoad::add_responses(const Part &part, const Point<double> &point, const bool by_velocity, SparseMatrix &A) const
  {
    Local<double> coefficients;
    for (unsigned int i = 0; i < 6; ++i)
      if (part.responses[i])
        {
          local_residual(part, Vector6(point.factor * Vector6::Unit(i)), point.q, coefficients);
          if (by_velocity)
            part.responses[i]->add_damping(point, coefficients, A);
          else
            part.responses[i]->add_tangent(point, coefficients, A);
        }
  }



  void
  WrenchLoad::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    for (const auto &span : spans)
      {
        const Vector6 w = wrench(span.responses, point);
        add_tangent(span, w.head<3>(), w.tail<3>(), point.q, K);
        add_responses(span, point, false, K);
      }
    for (const auto &load : points)
      {
        if (!is_follower())
          {
            const Matrix3 D                 = load.frame.triad(point.q);
            const Vector6 w                 = wrench(load.responses, point);
            auto         &local             = local_tangent();
            local.topRightCorner<3, 3>()    = -load.weight * skew((D.transpose() * w.head<3>()).eval());
            local.bottomRightCorner<3, 3>() = -load.weight * skew((D.transpose() * w.tail<3>()).eval());
            load.block.add(local, K);
          }
        add_responses(load, point, false, K);
      }
  }



  void
  WrenchLoad::damping(const Point<double> &point, SparseMatrix &C) const
  {
    if (!depends_on_state)
      return;
    for (const auto &span : spans)
      add_responses(span, point, true, C);
    for (const auto &load : points)
      add_responses(load, point, true, C);
  }



  void
  WrenchLoad::pieces(const Point<double> &point, std::vector<double> &result) const
  {
    // the laws are the same at all points
    const Responses *const responses = !points.empty() ? &points[0].responses :
                                       !spans.empty()  ? &spans[0].responses :
                                                         nullptr;
    for (unsigned int i = 0; i < 6 && responses != nullptr; ++i)
      if ((*responses)[i])
        (*responses)[i]->pieces(point, result);
  }



  void
  WrenchLoad::add_tangent(const AlongSpan &span, const Vector3 &f, const Vector3 &m, const double *q, SparseMatrix &K)
    const
  {
    // −δ(D_aᵀ W_ab D_b f) with δD = D θ~
    static thread_local Eigen::MatrixXd local;
    local.setZero(6 * span.frames.size(), 6 * span.frames.size());
    for (unsigned int a = 0; a < span.frames.size(); ++a)
      {
        const Matrix3 D_a = span.frames[a].triad(q);
        for (unsigned int b = 0; b < span.frames.size(); ++b)
          {
            const Matrix3 W = span.products(a, b) * D_a.transpose() * span.frames[b].triad(q);
            local.block<3, 3>(6 * a, 6 * b + 3) += W * skew(f);
            local.block<3, 3>(6 * a + 3, 6 * b + 3) += W * skew(m);
            local.block<3, 3>(6 * a, 6 * a + 3) -= skew((W * f).eval());
            local.block<3, 3>(6 * a + 3, 6 * a + 3) -= skew((W * m).eval());
          }
      }
    span.block.add(local, K);
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
    prm.add("Force", force, "Components, expressions of time t and signals [N].");
    prm.add("Moment", moment, "Components, expressions of time t and signals [N*m].");
    add_axes_parameter(prm);
  }



  void
  ConcentratedLoad::initialize(Model &model)
  {
    try
      {
        if (parameters.require("At", model.complaints))
          points.push_back({model.frame(at), 1.});
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
    prm.add("Force", force, "Components per length, expressions of time t and signals [N/m].");
    prm.add("Moment", moment, "Components per length, expressions of time t and signals [N].");
    prm.add("Variation", variation, "Factor along the beam, a function of the arc length s in metres [1].");
    add_axes_parameter(prm);
  }



  void
  LineLoad::initialize(Model &model)
  {
    if (!parameters.require("Body", model.complaints))
      return;
    std::string where = "Body";
    try
      {
        const auto along = model.find<Body>(body, "body").spans();
        if (along.empty())
          throw std::invalid_argument("body <" + body + "> has no length along which a load could act");
        where = "Variation";
        for (const auto &span : along)
          add_span(span);
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where(where), problem.what());
      }
  }



  namespace
  {
    constexpr unsigned int points_a_piece = 10; // exact for the products of two polynomials of degree 6 and one of 7

    /** ∫ p ds and ∫ |p| ds */
    std::pair<double, double>
    integrals(const Expression &p, const std::vector<double> &breaks)
    {
      std::pair<double, double> sums;
      for (const auto &[s, ds] : composite_rule(breaks, points_a_piece))
        {
          sums.first += p(s) * ds;
          sums.second += std::abs(p(s)) * ds;
        }
      return sums;
    }

    /** Add breaks between @p a and @p b, and @p b, until the rule is exact to round-off: narrow peaks, roots. */
    void
    refine(const Expression    &p,
           const double         a,
           const double         b,
           double              &size, // ∫ |p| ds, as far as it has been seen
           const unsigned int   depth,
           std::vector<double> &breaks)
    {
      constexpr unsigned int most   = 30;
      const double           middle = 0.5 * (a + b);
      const auto             halves = integrals(p, {a, middle, b});
      const double           error  = std::abs(integrals(p, {a, b}).first - halves.first);
      size                          = std::max(size, halves.second);
      if (error <= 1e-13 * size || (depth == most && error <= 1e-6 * size))
        {
          breaks.push_back(b);
          return;
        }
      if (depth == most || breaks.size() > 5000 || !std::isfinite(error))
        throw std::invalid_argument("the variation cannot be integrated from s = " + number_to_text(a) + " m to " +
                                    number_to_text(b) + " m: it is not finite there, or varies too fast");
      refine(p, a, middle, size, depth + 1, breaks);
      refine(p, middle, b, size, depth + 1, breaks);
    }

    /** The ends of a span, jumps and corners of @p p on it, and what refine() adds. */
    std::vector<double>
    breaks_of(const Expression &p, const Span &span)
    {
      double              size = integrals(p, {span.start, 0.5 * (span.start + span.end), span.end}).second;
      std::vector<double> breaks(1, span.start);
      while (breaks.back() < span.end)
        refine(p, breaks.back(), std::min(p.next_corner(breaks.back(), span.end), span.end), size, 0, breaks);
      return breaks;
    }
  } // namespace



  void
  LineLoad::add_span(const Span &span)
  {
    const unsigned int n        = span.frames.size();
    Eigen::VectorXd    weights  = Eigen::VectorXd::Zero(n), N(n);
    Eigen::MatrixXd    products = Eigen::MatrixXd::Zero(n, n);
    for (const auto &[s, ds] : composite_rule(breaks_of(variation, span), points_a_piece))
      {
        for (unsigned int a = 0; a < n; ++a)
          N(a) = lagrange(span.abscissae, a, s);
        weights += variation(s) * ds * N;
        products += variation(s) * ds * N * N.transpose();
      }
    if (is_follower())
      spans.push_back({span.frames, products});
    else
      for (unsigned int a = 0; a < n; ++a)
        points.push_back({span.frames[a], weights(a)});
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
    layout.add(*this, *this);
  }



  template <typename Number>
  void
  SteadyRotation::residual_at(const Point<Number> &point, Number *r) const
  {
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
    Eigen::MatrixXd local(2, 2);
    if (point.held)
      local << 0, 1, 1, 0;
    else
      local << 0, 0, 0, 1;
    block.add(local, K);
  }



  template class Evaluated<Gravity, Force>;
  template class Evaluated<WrenchLoad, Force>;
  template class Evaluated<SteadyRotation, Constraint>;
} // namespace samara
