// The constraints of joints that slide along beams.

#include <samara/joints/sliding_values.h>

#include <limits>

namespace samara
{
  class SlidingJoint::Rows : public Evaluated<SlidingJoint::Rows, Constraint>
  {
  public:
    explicit Rows(const SlidingJoint &joint)
      : joint(joint)
      , motion(joint.free.front())
      , rail(*joint.rail)
    {}

    template <typename Number>
    void   residual_at(const Point<Number> &point, Number *r) const;
    void   tangent(const Point<double> &point, SparseMatrix &K) const override;
    void   rates(const Point<double> &point, double *rates) const override;
    void   time_rates(const Point<double> &point, double *rates) const override;
    void   second_rates(const Point<double> &point, double *rates) const override;
    double next_corner(double from, double to) const override;
    void   pieces(const Point<double> &point, std::vector<double> &result) const override;

  private:
    const SlidingJoint &joint;
    const FreeMotion   &motion;
    const Rail         &rail;

    /** In statics nothing leaves: an iterate far away is no solution. */
    template <typename Number>
    bool
    has_left(const Point<Number> &point) const
    {
      return !point.held && joint.is_far(std::real(point.coordinates[joint.coordinate()]));
    }
    /** What stands for all rows then. */
    void add_tangent_of_parked(SparseMatrix &K) const;

    template <typename Number>
    Number
    abscissa(const Point<Number> &point) const
    {
      return joint.start + point.coordinates[joint.coordinate()];
    }

    template <typename Number>
    SlidingForces<Number> forces(const Number *multipliers, const Number &sigma) const;
  };



  template <typename Number>
  SlidingForces<Number>
  SlidingJoint::Rows::forces(const Number *multipliers, const Number &sigma) const
  {
    SlidingForces<Number> result;
    result.force = joint.axes_of_rows * Eigen::Map<const Vec3<Number>>(multipliers);
    for (unsigned int i = 0; i < joint.cosines.size(); ++i)
      {
        const auto c = joint.coefficients(joint.cosines[i], sigma);
        for (unsigned int n = 0; n < 3; ++n)
          result.A[n] += multipliers[3 + i] * c[n];
      }
    return result;
  }



  template <typename Number>
  void
  SlidingJoint::Rows::residual_at(const Point<Number> &point, Number *r) const
  {
    const Number        S = abscissa(point), sigma = point.coordinates[joint.coordinate()];
    const Number *const lambda = point.multipliers + joint.first_multiplier;

    thread_local Eigen::Matrix<Number, Eigen::Dynamic, 1> local;
    if (has_left(point))
      {
        const unsigned int s = 6 * rail.pieces()[0].frames.size() + 6;
        local.setZero(s + 1 + joint.n_rows);
        local(s)     = lambda[0];
        local(s + 1) = sigma - joint.parked(joint.has_left_at_end(std::real(sigma)));
        return joint.blocks[0].add(local, r);
      }
    const SlidingValues<Number> values(rail, joint.frame_b, S, point);
    const auto                  f = forces(lambda, sigma);
    for (const Rail::Weights<Number> &part : values.weights)
      {
        const std::vector<Frame> &frames = rail.pieces()[part.piece].frames;
        const unsigned int        b = 6 * frames.size(), first = b + 7;
        local.setZero(first + joint.n_rows);
        f.add_to_rail(values, part, frames, local);
        if (&part == values.weights.begin())
          {
            local.template segment<7>(b)     = f.of_b_and_s(values);
            local.template segment<3>(first) = joint.axes_of_rows.transpose() * (values.x_b - values.at.x[0]);
            const Mat3<Number> M             = values.cosines(0);
            for (unsigned int i = 0; i < joint.cosines.size(); ++i)
              local(first + 3 + i) = product<Number>(joint.coefficients(joint.cosines[i], sigma)[0], M);
            if (rail.beyond(std::real(S)) > most_beyond * rail.length())
              local(first - 1) = std::numeric_limits<double>::quiet_NaN(); // it has left the beam: no solution
          }
        joint.blocks[part.piece].add(local, r);
      }
    if (!motion.is_prescribed)
      return;
    r[joint.block.row(13)] += sigma - motion.prescribed_at(point);
    r[joint.block.row(12)] += lambda[joint.n_rows];
  }



  void
  add_turns_of_rail(const Rail                  &rail,
                    const SlidingValues<double> &values,
                    const Rail::Weights<double> &part,
                    const SlidingForces<double> &f,
                    const double                *q,
                    Eigen::MatrixXd             &K)
  {
    const std::vector<Frame> &frames = rail.pieces()[part.piece].frames;
    const unsigned int        b = 6 * frames.size(), s = b + 6;
    const Matrix3             EA = values.E * f.A[0], EA_1 = values.E * f.A[1];
    for (unsigned int a = 0; a < frames.size(); ++a)
      {
        const Matrix3 to_frame = frames[a].triad(q).transpose(), H = to_frame * EA, R = to_frame * values.E;
        const Vector3 force = to_frame * f.force;
        const double  w = part.of[0][a], w_1 = part.of[1][a];
        K.block<3, 3>(6 * a, 6 * a + 3) -= w * skew(force);
        K.block<3, 3>(6 * a + 3, 6 * a + 3) += w * change_of_moment(H);
        Matrix3 with_b = Matrix3::Zero(); // of the forces on d_k by turns of E
        for (int i = 0; i < 3; ++i)
          for (int k = 0; k < 3; ++k)
            if (f.A[0](i, k) != 0)
              with_b -= w * f.A[0](i, k) * skew(Vector3::Unit(k)) * R * skew(Vector3::Unit(i));
        K.block<3, 3>(6 * a + 3, b + 3) += with_b;
        K.block<3, 3>(b + 3, 6 * a + 3) += with_b.transpose();
        Vector6 with_s;
        with_s << -w_1 * force, moment_of<double>(w_1 * H + w * to_frame * EA_1);
        K.block<6, 1>(6 * a, s) += with_s;
        K.block<1, 6>(s, 6 * a) += with_s.transpose();
      }
  }



  void
  add_turns_of_b(const SlidingValues<double> &values,
                 const SlidingForces<double> &f,
                 const unsigned int           b,
                 Eigen::MatrixXd             &K)
  {
    const unsigned int s = b + 6;
    const Vector3      with_s =
      moment_of<double>(values.cosines(1) * f.A[0].transpose() + values.cosines(0) * f.A[1].transpose());
    K.block<3, 3>(b, b + 3) += skew((values.E.transpose() * f.force).eval());
    K.block<3, 3>(b + 3, b + 3) += change_of_moment(values.cosines(0) * f.A[0].transpose());
    K.block<3, 1>(b + 3, s) += with_s;
    K.block<1, 3>(s, b + 3) += with_s.transpose();
    K(s, s) += product<double>(f.A[0], values.cosines(2)) + 2 * product<double>(f.A[1], values.cosines(1)) +
               product<double>(f.A[2], values.cosines(0)) - f.force.dot(values.at.x[2]);
  }



  void
  SlidingJoint::Rows::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    const double sigma = point.coordinates[joint.coordinate()];
    if (has_left(point))
      return add_tangent_of_parked(K);
    const SlidingValues<double> values(rail, joint.frame_b, abscissa(point), point);
    const auto                  f = forces(point.multipliers + joint.first_multiplier, sigma);

    thread_local Eigen::MatrixXd local;
    for (const Rail::Weights<double> &part : values.weights)
      {
        const std::vector<Frame> &frames = rail.pieces()[part.piece].frames;
        const unsigned int        b = 6 * frames.size(), first = b + 7;
        const bool                is_first = &part == values.weights.begin();
        local.setZero(first + joint.n_rows, first + joint.n_rows);
        add_turns_of_rail(rail, values, part, f, point.q, local);
        if (is_first)
          add_turns_of_b(values, f, b, local);
        for (unsigned int i = 0; i < joint.n_rows; ++i)
          {
            std::array<double, 6> one = {};
            one[i]                    = 1;
            const auto gradient       = forces(one.data(), sigma);
            gradient.add_to_rail(values, part, frames, local.col(first + i));
            if (is_first)
              local.col(first + i).segment<7>(b) += gradient.of_b_and_s(values);
          }
        local.bottomLeftCorner(joint.n_rows, first) = local.topRightCorner(first, joint.n_rows).transpose();
        joint.blocks[part.piece].add(local, K);
      }
    if (!motion.is_prescribed)
      return;
    if (motion.drive)
      motion.drive->add_tangent(point, Eigen::VectorXd::Constant(1, -point.factor), K);
    joint.block.add_entry(12, 13, 1., K);
    joint.block.add_entry(13, 12, 1., K);
  }



  void
  SlidingJoint::Rows::add_tangent_of_parked(SparseMatrix &K) const
  {
    const unsigned int s     = 6 * rail.pieces()[0].frames.size() + 6;
    Eigen::MatrixXd    local = Eigen::MatrixXd::Zero(s + 1 + joint.n_rows, s + 1 + joint.n_rows);
    local(s, s + 1) = local(s + 1, s) = 1;
    for (unsigned int i = 1; i < joint.n_rows; ++i)
      local(s + 1 + i, s + 1 + i) = 1;
    joint.blocks[0].add(local, K);
    if (motion.is_prescribed)
      joint.block.add_entry(13, 13, 1., K);
  }



  void
  SlidingJoint::Rows::rates(const Point<double> &point, double *rates) const
  {
    const double sigma = point.coordinates[joint.coordinate()], v = point.rates[joint.coordinate()];
    if (has_left(point))
      {
        rates[joint.first_multiplier] = v;
        return;
      }
    const SlidingValues<double> values(rail, joint.frame_b, abscissa(point), point);
    const SlidingRates          rate(values, rail, joint.frame_b, v, point);
    const Vector6               twist_b = joint.frame_b.twist(point.y);
    double *const               g       = rates + joint.first_multiplier;
    Eigen::Map<Vector3>(g, 3)           = joint.axes_of_rows.transpose() * (values.E * twist_b.head<3>() - rate.x);
    for (unsigned int i = 0; i < joint.cosines.size(); ++i)
      {
        const auto c = joint.coefficients(joint.cosines[i], sigma);
        g[3 + i]     = product<double>(c[0], rate.cosines) + v * product<double>(c[1], values.cosines(0));
      }
    if (motion.is_prescribed)
      g[joint.n_rows] = v - motion.prescribed_rate(point);
  }



  void
  SlidingJoint::Rows::time_rates(const Point<double> &point, double *rates) const
  {
    if (motion.is_prescribed && !has_left(point))
      rates[joint.first_multiplier + joint.n_rows] = -motion.prescribed_rate(point);
  }



  void
  SlidingJoint::Rows::second_rates(const Point<double> &point, double *rates) const
  {
    if (has_left(point))
      return;
    const double                sigma = point.coordinates[joint.coordinate()], v = point.rates[joint.coordinate()];
    const SlidingValues<double> values(rail, joint.frame_b, abscissa(point), point);
    const SlidingRates          rate(values, rail, joint.frame_b, v, point);
    const SlidingSecondRates    second(values, rail, joint.frame_b, v, point);
    const Vector6               y = joint.frame_b.twist(point.y);
    double *const               g = rates + joint.first_multiplier;
    Eigen::Map<Vector3>(g, 3) =
      joint.axes_of_rows.transpose() * (values.E * cross(y.tail<3>().eval(), y.head<3>().eval()) - second.x);
    for (unsigned int i = 0; i < joint.cosines.size(); ++i)
      {
        const auto c = joint.coefficients(joint.cosines[i], sigma);
        g[3 + i]     = product<double>(c[0], second.cosines) + 2 * v * product<double>(c[1], rate.cosines) +
                   v * v * product<double>(c[2], values.cosines(0));
      }
    if (motion.is_prescribed)
      g[joint.n_rows] = -motion.prescribed_second_rate(point);
  }



  double
  SlidingJoint::Rows::next_corner(const double from, const double to) const
  {
    return motion.prescribed.next_corner(from, to);
  }



  void
  SlidingJoint::Rows::pieces(const Point<double> &point, std::vector<double> &result) const
  {
    if (motion.drive)
      motion.drive->pieces(point, result);
  }



  template <typename Number>
  Vec3<Number>
  SlidingJoint::tangent_in_rows(const Point<Number> &point) const
  {
    const Number sigma = point.coordinates[coordinate()];
    if (!point.held && is_far(std::real(sigma)))
      return Vec3<Number>::Zero();
    const Number       S       = start + sigma;
    const Vec3<Number> tangent = axes_of_rows.transpose() * rail->place(rail->weights(S), point.q).x[1];
    const Number       square  = tangent.cwiseProduct(tangent).sum();
    return tangent / std::sqrt(square);
  }



  void
  SlidingJoint::add_pressing(std::vector<unsigned int> &multipliers) const
  {
    // the rows of the position, and those of both tilts behind them
    for (unsigned int i = 0; i < (bearing_length > 0 ? 5 : 3); ++i)
      multipliers.push_back(first_multiplier + i);
  }



  template <typename Number>
  PressingParts<Number>
  SlidingJoint::parts_at(const Point<Number> &point) const
  {
    const Vec3<Number>    t      = tangent_in_rows(point);
    const Mat3<Number>    across = Mat3<Number>::Identity() - t * t.transpose();
    PressingParts<Number> parts;
    if (bearing_length == 0)
      {
        parts.add(3) = across;
        return parts;
      }
    // multipliers of the position are the force of B on A; those of the tilts make the moment λ₄ E₃ − λ₅ E₂ on B, and
    // that times E₁ is λ₄ E₂ + λ₅ E₃
    const Mat3<Number> E = axes_of_rows.transpose() * frame_b.triad(point.q);
    for (const double side : {-1., 1.})
      {
        auto &part                   = parts.add(5);
        part.template leftCols<3>()  = -0.5 * across;
        part.template rightCols<2>() = side / bearing_length * across * E.template rightCols<2>();
      }
    return parts;
  }



  template <typename Number>
  PressingParts<Number>
  SlidingJoint::parts_of(const Layout::Friction &friction, const Point<Number> &point) const
  {
    if (!is_of_thread(friction))
      return parts_at(point);
    PressingParts<Number> parts;
    auto                 &part = parts.add(2); // nothing presses on what has left
    if (point.held || !is_far(std::real(point.coordinates[coordinate()])))
      part.row(0) = thread.axial_force(turn).template cast<Number>();
    return parts;
  }



  PressingParts<double>
  SlidingJoint::pressing_parts(const Layout::Friction &friction, const Point<double> &point) const
  {
    return parts_of(friction, point);
  }



  PressingParts<std::complex<double>>
  SlidingJoint::pressing_parts(const Layout::Friction &friction, const Point<std::complex<double>> &point) const
  {
    return parts_of(friction, point);
  }



  void
  SlidingJoint::connect_turning(Layout &layout)
  {
    const FreeMotion &motion = free.front();
    turning.reset();
    if (!motion.beside.empty())
      {
        turning = make_turns(layout, 1, motion.beside.front(), motion.friction.radius);
        layout.add(*this, *turning);
      }
    if (ball.is_declared() && ball.is_given())
      ball.connect(layout,
                   *this,
                   make_turns(layout, 3, ball.first_turn(), 1.),
                   {first_multiplier, first_multiplier + 1, first_multiplier + 2});
    if (has_thread && turn != 0)
      thread.connect_nut(layout, *this, coordinate(), first_multiplier + 5, turn);
  }



  void
  SlidingJoint::connect(Layout &layout)
  {
    rail->resolve(layout.model);
    frame_a = layout.model.resolved(frame_a);
    frame_b = layout.model.resolved(frame_b);
    if (!check_bodies())
      return;
    used = {&free.front()};
    rows.clear();
    for (const std::string i : {"1", "2", "3"})
      rows.push_back("displacement " + i);
    for (const Cosine &c : cosines)
      rows.push_back(c.name);
    n_rows = rows.size();
    if (free.front().is_prescribed)
      rows.push_back("prescribed displacement");
    first_multiplier = layout.add_multipliers(*this, rows);

    // a rail couples the frames of each of its pieces, not those of all of them with each other
    std::vector<unsigned int> multipliers(n_rows);
    for (unsigned int i = 0; i < n_rows; ++i)
      {
        multipliers[i] = first_multiplier + i;
        layout.corrections.push_back({multipliers[i], coordinate()});
      }
    blocks.assign(rail->pieces().size(), {});
    for (unsigned int i = 0; i < blocks.size(); ++i)
      {
        std::vector<Frame> frames = rail->pieces()[i].frames;
        frames.push_back(frame_b);
        layout.couple(blocks[i], frames, {coordinate()}, multipliers);
      }
    const unsigned int        row = first_multiplier + n_rows;
    std::vector<unsigned int> prescribed;
    if (free.front().is_prescribed)
      {
        if (free.front().drive)
          free.front().drive->connect(layout, {{}, {}, {}, {row}});
        model->prescribed[coordinate()] = row;
        prescribed                      = {row};
      }
    layout.couple(block, {{frame_a.node}, {frame_b.node}}, {coordinate()}, prescribed);
    term = std::make_unique<Rows>(*this);
    layout.add(*this, *term);
    add_stops(layout);
    add_springs(layout);
    connect_turning(layout);
    add_friction(layout);
  }
} // namespace samara
