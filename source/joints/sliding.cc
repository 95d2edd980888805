// What users say of joints that slide along beams, where they are, and what is told of them.

#include <samara/base/text.h>
#include <samara/joints/sliding.h>
#include <samara/model/drawing.h>
#include <samara/model/probe_needs.h>
#include <samara/model/signal.h>
#include <samara/model/surface.h>
#include <samara/model/surface_curve.h>

#include <cmath>
#include <complex>

namespace samara
{
  namespace
  {
    /** d₁ and d₂ made orthonormal, and what is normal to both. */
    Matrix3
    orthonormal(const Matrix3 &d)
    {
      return triad(d.col(0), d.col(1));
    }
  } // namespace



  void
  SlidingJoint::add_parameters(Parameters &prm)
  {
    prm.add("Body A", body_a, "The beam, without a point; or a line of a shell, shell.edge u0 or shell.line v 0.5.");
    prm.add("Body B", body_b, "Frame that slides along it: body.point, or ground.");
    prm.add("Position",
            position,
            "Place on the beam where the joint is in the reference configuration; default: that of frame B [m].");
    prm.add(
      "Gap",
      gap,
      "Whether that place may be off the beam; allowed: the joint is at the nearest point of it, a rigid arm goes "
      "to frame B.",
      dealii::Patterns::Selection("refused|allowed"));
    prm.add(
      "At the ends",
      ends,
      "What is at the ends of the beam: the end of the run; stops, with the <Stop stiffness> and what else is said of "
      "stops of the displacement; or that B leaves the beam there, and nothing holds it any more (in time).",
      dealii::Patterns::Selection("end the run|stop|leave"));
    prm.turns("Position", Turning::given_position);
    free_displacement(0);
    add_motions(prm);
  }



  void
  SlidingPoint::add_parameters(Parameters &prm)
  {
    SlidingJoint::add_parameters(prm);
    ball.add_parameters(prm);
  }



  void
  SlidingSleeve::add_parameters(Parameters &prm)
  {
    cosines = {{1, 0, false, "rotation 3"}, {2, 0, false, "rotation 2"}};
    SlidingJoint::add_parameters(prm);
    add_bearing_length(prm);
    has_bore = true;
    prm.subsection("displacement")
      .add(
        "Friction radius",
        free.front().friction.radius,
        "Radius of the bore, where friction acts against the slip of sliding and of turning about the beam together; 0: "
        "against sliding alone [m].",
        dealii::Patterns::Double(0));
  }



  void
  SlidingPrismatic::add_parameters(Parameters &prm)
  {
    cosines = {{1, 0, false, "rotation 3"}, {2, 0, false, "rotation 2"}, {2, 1, false, "rotation 1"}};
    SlidingJoint::add_parameters(prm);
    add_bearing_length(prm);
  }



  void
  SlidingScrew::add_parameters(Parameters &prm)
  {
    cosines = {{1, 0, false, "rotation 3"}, {2, 0, false, "rotation 2"}, {1, 1, true, "rotation 1"}};
    SlidingJoint::add_parameters(prm);
    add_bearing_length(prm);
    prm.add("Turn per length",
            turn,
            "Rotation of B about axis 1 of the beam against its sections, right-handed, per length it slides towards "
            "the end of the beam [rad/m].");
    has_thread = true;
    thread.add_parameters(prm);
  }



  void
  SlidingJoint::initialize(Model &m)
  {
    model = &m;
    Frame b;
    bool  are_known = parameters.require("Body A", m.complaints);
    are_known       = parameters.require("Body B", m.complaints) && are_known && find_rail(m);
    if (parameters.is_set("Body B"))
      try
        {
          b = m.frame(body_b);
        }
      catch (const std::invalid_argument &problem)
        {
          complain(m, "Body B", problem.what());
          are_known = false;
        }
    if (!are_known || !find_start(m, b) || !check_corners(m))
      return;
    const auto at =
      rail->place_of([&](const Frame &f) { return m.position(f); }, [&](const Frame &f) { return m.triad(f); }, start);
    const Matrix3 E = orthonormal(at.d[0]);
    axes_of_rows    = E;
    frame_a         = m.frame_at(rail->pieces()[rail->piece_at(start)].frames.front(), at.x[0], E);
    frame_b         = m.frame_at(b, at.x[0], E);
    free.front().check_parameters(parameters.subsection("displacement"), m.complaints, ends == "stop");
    check_bearing_length(m);
    if (ends == "stop")
      add_stops_at_ends(m);
    if (may_leave())
      check_leaving(m);
    use_coordinate(m, "displacement");
    free.front().add_bristles(m, name);
    initialize_turning(m);
  }



  void
  SlidingJoint::initialize_turning(Model &m)
  {
    FreeMotion &motion = free.front();
    motion.beside.clear();
    motion.bristles_beside.clear();
    if (has_bore && motion.friction.is_given() && motion.friction.radius > 0)
      {
        motion.beside = {m.add_coordinate(name + ".slip round the beam", "m")};
        if (motion.friction_law.has_bristles())
          motion.bristles_beside = {m.add_state(name + ".bristles round the beam", "m", 0., 1.)};
      }
    if (has_thread)
      thread.initialize(m, *this, parameters.subsection("thread"));
    if (has_thread && thread.is_given() && turn == 0)
      m.complaints.add(parameters.subsection("thread").where("Friction"),
                       "joint <" + name + ">: without a <Turn per length> there is no thread that could rub");
    if (!ball.is_declared())
      return;
    ball.initialize(m, *this, parameters.subsection("rotation"), {});
    if (ball.is_given() && body_a.find('.') != std::string::npos)
      m.complaints.add(parameters.subsection("rotation").where("Friction"),
                       "joint <" + name +
                         ">: against what would it turn? The axes of a shell do not follow its lines. Let a rigid body "
                         "without mass slide there, with a <spherical> joint on it that rubs");
  }



  void
  SlidingJoint::add_stops_at_ends(Model &m)
  {
    FreeMotion &motion = free.front();
    if (!motion.stop.is_given())
      return complain(m,
                      "At the ends",
                      "joint <" + name + ">: stops at the ends need a <Stop stiffness> above zero, in <displacement>");
    if (!motion.has_lower_stop)
      motion.lower_stop = rail->start() - start;
    if (!motion.has_upper_stop)
      motion.upper_stop = rail->end() - start;
    motion.has_lower_stop = motion.has_upper_stop = true;
  }



  bool
  SlidingJoint::find_rail(Model &m)
  {
    try
      {
        const auto dot = body_a.find('.');
        body_of_rail   = &m.find<Body>(trim(body_a.substr(0, dot)), "body");
        std::vector<LinePiece> pieces;
        if (dot != std::string::npos)
          pieces = line_of_shell(trim(body_a.substr(dot + 1)));
        else
          for (const Span &span : body_of_rail->spans())
            pieces.emplace_back(span);
        if (pieces.empty())
          throw std::invalid_argument(
            "<" + body_a + "> is no beam: there is no line along which something could slide" +
            (dynamic_cast<const SurfaceBody *>(body_of_rail) == nullptr ?
               "" :
               "; of a shell say which, <" + body_a + ".edge u0> or <" + body_a + ".line v 0.5>"));
        rail = std::make_unique<Rail>(std::move(pieces));
        return true;
      }
    catch (const std::invalid_argument &problem)
      {
        complain(m, "Body A", problem.what());
        return false;
      }
  }



  std::vector<LinePiece>
  SlidingJoint::line_of_shell(const std::string &line) const
  {
    const auto *const shell = dynamic_cast<const SurfaceBody *>(body_of_rail);
    if (shell == nullptr)
      throw std::invalid_argument("<" + body_a + ">: what slides along the whole of <" + body_of_rail->name +
                                  "> has <Body A = " + body_of_rail->name + ">, without a point");
    if (!cosines.empty())
      throw std::invalid_argument("along <" + body_a +
                                  "> only a <sliding point> goes: the axes of a shell do not follow its lines");
    if (const auto *const with_curves = dynamic_cast<const HasCurves *>(body_of_rail))
      return with_curves->curve(line);
    std::vector<LinePiece> pieces;
    for (const Span &span : shell->edge(line))
      pieces.emplace_back(span);
    return pieces;
  }



  bool
  SlidingJoint::find_start(Model &m, const Frame &b)
  {
    // drawings are rounded, as those of other joints are: the place is then the nearest point of the beam
    constexpr double rounding    = 1e-5;
    const auto       position_of = [&](const Frame &f) { return m.position(f); };
    const Vector3    x           = parameters.is_set("Position") ? position : m.position(b);
    start                        = rail->nearest(position_of, x);
    const Vector3 on_rail        = rail
                              ->place_of(
                                position_of, [](const Frame &) { return Matrix3::Zero(); }, start)
                              .x[0];
    if (gap == "allowed" || (on_rail - x).norm() <= rounding * std::max(rail->length(), box_diagonal(m)))
      return true;
    complain(m,
             parameters.is_set("Position") ? "Position" : "Body B",
             "joint <" + name + ">: the beam <" + body_a + "> is " + number_to_text("%.6g", (on_rail - x).norm()) +
               " m away from " + (parameters.is_set("Position") ? "its <Position>" : "<" + body_b + ">") +
               ". If a rigid arm is meant, say where on the beam the joint is by <Position>, or <Gap = allowed>");
    return false;
  }



  bool
  SlidingJoint::check_corners(Model &m)
  {
    // directors that are looked at: of a sleeve the first one, which is not turned by twist
    const unsigned int n = cosines.empty() ? 0 : cosines.size() < 3 ? 1 : 3;
    const double       s = n == 0 ? NAN : rail->first_corner(m, n);
    if (std::isnan(s))
      return true;
    complain(m,
             "Body A",
             "joint <" + name + ">: the sections of beam <" + body_a + "> have a corner or a jump of their twist at " +
               number_to_text("%.6g", s) + " m from its start, which only a <sliding point> can pass");
    return false;
  }



  bool
  SlidingJoint::check_bodies()
  {
    bool is_part = false, all_on_ground = true;
    for (const Span &span : rail->pieces())
      for (const Frame &frame : span.frames)
        {
          is_part       = is_part || (frame.node == frame_b.node && frame.node != 0);
          all_on_ground = all_on_ground && frame.node == 0;
        }
    if (is_part)
      complain(*model, "Body B", "joint <" + name + ">: <" + body_b + "> is welded to the beam <" + body_a + ">");
    else if (all_on_ground && frame_b.node == 0)
      complain(*model, "Body B", "joint <" + name + ">: the beam and <" + body_b + "> are both welded to the ground");
    else
      return true;
    return false;
  }



  /** The size of the force between the beam and B [N]. It has no derivative where it is zero; there, 0 is taken. */
  class SlidingJoint::Reaction : public Signal
  {
  public:
    explicit Reaction(const SlidingJoint &joint)
      : joint(joint)
    {
      multipliers = {0}; // not known yet, but there are some
    }

    void
    resolve(const Model &) override
    {
      const unsigned int first = joint.first_multiplier;
      multipliers              = {first, first + 1, first + 2};
    }
    double
    value(const Point<double> &point) const override
    {
      return size(point);
    }
    std::complex<double>
    value(const Point<std::complex<double>> &point) const override
    {
      return size(point);
    }
    void
    add_gradient(const Point<double> &point, double *const by_place, double *) const override
    {
      if (const double f = size(point); f > 0)
        for (unsigned int i = 0; i < 3; ++i)
          by_place[i] += point.multipliers[multipliers[i]] / f;
    }

  private:
    const SlidingJoint &joint;

    template <typename Number>
    Number
    size(const Point<Number> &point) const
    {
      Number sum(0);
      if (joint.is_far(std::real(point.coordinates[joint.coordinate()])))
        return sum;
      for (const auto i : multipliers)
        sum += point.multipliers[i] * point.multipliers[i];
      return std::sqrt(sum);
    }
  };



  std::shared_ptr<Signal>
  SlidingJoint::signal(Model &, const std::string &path)
  {
    if (path == "force")
      return std::make_shared<Reaction>(*this);
    return path == "displacement"      ? displacement_signal() :
           path == "displacement rate" ? rate_signal(coordinate()) :
                                         nullptr;
  }



  void
  SlidingJoint::add_relative_rates(const double *q, std::vector<RelativeRate> &rates) const
  {
    // of B against a frame of the beam's node at S, as if it were rigid there
    const auto    position_of = [&](const Frame &f) { return f.position(q); };
    const auto    triad_of    = [&](const Frame &f) { return f.triad(q); };
    const double  S           = rail->nearest(position_of, frame_b.position(q));
    const auto    at          = rail->place_of(position_of, triad_of, S);
    const Frame  &of_piece    = rail->pieces()[rail->piece_at(S)].frames.front();
    const Matrix3 D           = of_piece.triad(q);
    const Frame   a =
      of_piece.then(D.transpose() * (at.x[0] - of_piece.position(q)), D.transpose() * orthonormal(at.d[0]));
    const PairValues<double> pair(a, frame_b, q, false);
    Vector12                 g = Vector12::Zero();
    PairFunction{PairFunction::gap, 0}.add_gradient(pair, 1., g);
    RelativeRate rate;
    rate.name      = name + ".displacement";
    rate.a         = a.node;
    rate.b         = frame_b.node;
    rate.on_a      = g.head<6>();
    rate.on_b      = g.tail<6>();
    rate.in_metres = true;
    rate.line      = RelativeRate::direction;
    rate.node      = a.node;
    rate.along     = a.triad(q).col(0);
    rate.through   = a.position(q);
    rates.push_back(rate);
    if (cosines.size() < 3)
      add_turns(a, cosines.empty() ? 3 : 1, q, rates);
  }



  std::vector<Bend>
  SlidingJoint::bends() const
  {
    std::vector<Bend> result;
    for (unsigned int i = 0; i + 1 < rail->pieces().size(); ++i)
      result.push_back({coordinate(), rail->turn(i).from - start, rail->turn(i).to - start});
    return result;
  }



  Vector6
  SlidingJoint::action_on_b(const State &state) const
  {
    if (has_left(state))
      return Vector6::Zero();
    const double        S  = start + state.coordinates[coordinate()];
    const auto          at = rail->place(rail->weights(S), state.q.data());
    const Matrix3       E = frame_b.triad(state.q.data()), axes = orthonormal(at.d[0]);
    const double *const lambda = &state.multipliers[first_multiplier];
    Matrix3             A      = Matrix3::Zero();
    for (unsigned int r = 3; r < n_rows; ++r)
      A += lambda[r] * coefficients(cosines[r - 3], S - start)[0];
    Vector3 moment = Vector3::Zero();
    for (unsigned int k = 0; k < 3; ++k)
      moment += at.d[0].col(k).cross(E * A.col(k));
    Vector6 result;
    result << -axes.transpose() * axes_of_rows * Eigen::Map<const Vector3>(lambda), axes.transpose() * moment;
    return result;
  }



  std::optional<Probe>
  SlidingJoint::probe(const std::string &path) const
  {
    if (path == "displacement" || path == "arc length")
      return Probe{path, "m", OfPlaces{[this, from = path == "displacement" ? 0. : start](const State &state) {
                     return from + displacement(state.coordinates[coordinate()]);
                   }}};
    if (path == "attached" && may_leave())
      return Probe{path, "1", OfPlaces{[this](const State &state) { return has_left(state) ? 0. : 1.; }}};
    if (path == "displacement rate")
      return Probe{path, "m/s", OfVelocities{{[this](const State &state) { return state.rates[coordinate()]; }}}};
    if (path == "force")
      return Probe{path, "N", [this](const State &state) { return action_on_b(state).head<3>().norm(); }};
    for (unsigned int i = 0; i < 6; ++i)
      if (path == (i < 3 ? "force " : "moment ") + std::to_string(i % 3 + 1))
        return Probe{path, i < 3 ? "N" : "N m", [this, i](const State &state) { return action_on_b(state)(i); }};
    return {};
  }



  std::vector<std::string>
  SlidingJoint::probe_names() const
  {
    std::vector<std::string> names = {
      "displacement", "displacement rate", "arc length", "force", "force 1", "force 2", "force 3"};
    if (!cosines.empty())
      names.insert(names.end(), {"moment 1", "moment 2", "moment 3"});
    if (may_leave())
      names.push_back("attached");
    return names;
  }



  void
  SlidingJoint::draw(const State &state, Drawing &drawing) const
  {
    drawing.begin_object(name);
    drawing.attach(frame_b, state);
    const Sample at = drawing.sample(frame_b, state);
    if (cosines.empty())
      drawing.sphere(at, 0.01 * rail->length());
    else
      drawing.cylinder(at, 0, 0.01 * rail->length(), 0.04 * rail->length());
  }
} // namespace samara
