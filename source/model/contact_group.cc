// What a group of bodies that may touch is; how pairs are found stands in contact_search.cc.

#include <samara/base/text.h>
#include <samara/model/contact_group.h>

#include <unsupported/Eigen/AutoDiff>

#include <algorithm>
#include <limits>

namespace samara
{
  bool
  ContactGroup::is_possible(const Pair &pair) const
  {
    if (!pair.with_surface &&
        (is_station(pair) || !balls_touch_balls || (!pair.a_is_line && !beads[pair.other].is_ball)))
      return false;
    const Item *const        body  = pair.b_is_line ? lines[pair.bead].body : beads[pair.bead].body,
                      *const other = pair.with_surface ? surfaces[pair.other].body :
                                     pair.a_is_line    ? lines[pair.other].body :
                                                         beads[pair.other].body;
    if (body == other)
      return false;
    if (pair.a_is_line || pair.b_is_line)
      return true;
    const unsigned int node =
      pair.with_surface ? surfaces[pair.other].frame.node : beads[pair.other].place[0].frame.node;
    for (const auto &[frame, weight] : beads[pair.bead].place)
      if (frame.node != node)
        return true;
    return false;
  }



  PairShape
  ContactGroup::shape(const Pair &pair) const
  {
    const double r = pair.b_is_line ? lines[pair.bead].radius : beads[pair.bead].radius;
    if (!pair.with_surface)
      return {PairShape::ball, false, pair.a_is_line ? lines[pair.other].radius : beads[pair.other].radius, r};
    const Surface &surface = surfaces[pair.other];
    return {surface.kind, surface.hollow, surface.radius, r};
  }



  bool
  ContactGroup::find_sides(const Pair &pair, const double *const q, Sides &sides) const
  {
    sides.b.clear();
    sides.a.clear();
    sides.slopes_b.clear();
    sides.slopes_a.clear();
    sides.is_parallel = false;
    sides.inverse.setZero();
    if (pair.a_is_line)
      {
        const ContactLine &line_a = lines[pair.other], *const line_b = pair.b_is_line ? &lines[pair.bead] : nullptr;
        const auto found =
          nearest_places({line_b, line_b != nullptr ? Vector3::Zero() : position(beads[pair.bead], q), &line_a},
                         pair.nearest,
                         q);
        if (!found)
          return false;
        sides.is_parallel = found->is_parallel;
        sides.inverse     = found->inverse;
        line_a.add_frames(found->a, sides.a, &sides.slopes_a);
        if (line_b != nullptr)
          line_b->add_frames(found->b, sides.b, &sides.slopes_b);
      }
    else if (pair.with_surface)
      sides.a.push_back({surfaces[pair.other].frame, 1.});
    else
      sides.a = beads[pair.other].place;
    if (!pair.b_is_line)
      sides.b = beads[pair.bead].place;
    return true;
  }



  double
  ContactGroup::gap(const Pair &pair, const double *const q) const
  {
    thread_local Sides sides;
    if (!find_sides(pair, q, sides))
      return std::numeric_limits<double>::quiet_NaN();
    return PairMeasure<double>(shape(pair), places<double>(pair, sides, q, nullptr)).gap;
  }



  bool
  ContactGroup::has_nearest_places() const
  {
    const auto is_ball = [](const Bead &bead) { return bead.is_ball; };
    return balls_touch_balls && !lines.empty() &&
           (lines.size() > 1 || std::any_of(beads.begin(), beads.end(), is_ball));
  }



  std::string
  ContactGroup::without_nearest_places(const double *const q) const
  {
    std::vector<Pair> pairs;
    Margins           margins;
    Sides             sides;
    find_pairs(q, nullptr, 0, pairs, margins);
    for (const Pair &pair : pairs)
      if (!find_sides(pair, q, sides) || sides.is_parallel)
        return name_of(pair);
    return "";
  }



  std::string
  ContactGroup::name_of(const Pair &pair) const
  {
    const auto at = [](const ContactLine &line, const ContactLine::Place &place) {
      return line.name + " at s = " + number_to_text("%.4g", place.s) + " m";
    };
    return (pair.b_is_line ? at(lines[pair.bead], pair.nearest.b) : beads[pair.bead].name) + " and " +
           (pair.with_surface ? surfaces[pair.other].name :
            pair.a_is_line    ? at(lines[pair.other], pair.nearest.a) :
                                beads[pair.other].name);
  }



  void
  ContactGroup::nodes_of(const Pair &pair, std::vector<unsigned int> &nodes) const
  {
    Sides sides;
    nodes.clear();
    if (pair.a_is_line)
      {
        lines[pair.other].add_frames(pair.nearest.a, sides.a);
        if (pair.b_is_line)
          lines[pair.bead].add_frames(pair.nearest.b, sides.b);
        else
          sides.b = beads[pair.bead].place;
      }
    else
      find_sides(pair, nullptr, sides); // places are not looked at
    for (const auto *const side : {&sides.b, &sides.a})
      for (const auto &[frame, weight] : *side)
        nodes.push_back(frame.node);
  }



  Vector3
  ContactGroup::position(const Bead &bead, const double *const q) const
  {
    Vector3 x = Vector3::Zero();
    for (const auto &[frame, weight] : bead.place)
      x += weight * frame.position(q);
    return x;
  }



  Vector3
  ContactGroup::velocity(const Bead &bead, const double *const q, const double *const y) const
  {
    Vector3 v = Vector3::Zero();
    for (const auto &[frame, weight] : bead.place)
      {
        const Eigen::Map<const Vector3> speed(y + 6 * frame.node), spin(y + 6 * frame.node + 3);
        v += weight * Frame{frame.node}.triad(q) * (speed + spin.cross(frame.arm));
      }
    return v;
  }



  namespace
  {
    // local unknowns of a pair: increments of x_b, x_a, E, and of v_b, ω_b, v_a, ω_a, Ė
    constexpr int n_places = 9, n_local = 24, n_forces = 15;
    using Dual        = Eigen::AutoDiffScalar<Eigen::Matrix<double, n_local, 1>>;
    using LocalMatrix = Eigen::Matrix<double, n_forces, n_local>;

    /** Bristles that bend in a step from where they are: force, and its slopes by slip, way and normal force. */
    struct BristleSlopes
    {
      Vector3 force = Vector3::Zero(), by_normal = Vector3::Zero();
      Matrix3 by_slip = Matrix3::Zero(), by_way = Matrix3::Zero();

      /** As one implicit step of Euler: (1/h + r) z = w + z_i/h, r = σ₀|w|/G. What sticks is a spring. */
      BristleSlopes(const FrictionLaw &law, const BentBristles &bent, const Vector3 &w, const double n)
      {
        const double sigma_0 = bent.part * law.bristle_stiffness, sigma_1 = bent.part * law.bristle_damping,
                     size = w.norm(), G = n * law.coefficient(size * size).c;
        if (!(G > 0))
          return;
        const double   turned = bent.h * sigma_0 * size / G; // h r
        const Vector3 &z      = bent.deflection;
        Matrix3        A      = Matrix3::Identity();
        if (size > 0)
          A -= sigma_0 / (G * size) * z * w.transpose();
        A /= 1 + turned;
        force     = force_of_bristles<double>(law, bent, w, n);
        by_normal = turned / (1 + turned) / n * force;
        if (turned < 1)
          {
            by_way  = sigma_0 * A;
            by_slip = sigma_1 * A;
          }
        else
          by_slip = (sigma_0 * bent.h + sigma_1) * A;
      }
    };

    Vec3<Dual>
    variable(const Vector3 &v, const int first)
    {
      Vec3<Dual> result;
      for (int i = 0; i < 3; ++i)
        result(i) = Dual(v(i), n_local, first + i);
      return result;
    }

    /** Forces on B and A as in ContactForces, force_b, moment_b, force_a, moment_a, on_axis, and their derivatives. */
    struct LocalForces
    {
      Eigen::Matrix<double, n_forces, 1> value;
      LocalMatrix                        slope;
      LocalMatrix                        by_way; ///< in the columns of velocities: by the ways, of bristles
      bool                               is_touched, has_ways = false;

      LocalForces(const ContactGroup       &group,
                  const ContactGroup::Pair &pair,
                  const PairPlaces<double> &p,
                  const BentBristles       *bent)
      {
        const PairPlaces<Dual>  places{variable(p.x_a, 3),
                                      variable(p.axis, 6),
                                      variable(p.x_b, 0),
                                      variable(p.v_a, 15),
                                      variable(p.spin_a, 18),
                                      variable(p.axis_rate, 21),
                                      variable(p.v_b, 9),
                                      variable(p.spin_b, 12),
                                      variable(p.axis, 6)};
        const PairShape         shape = group.shape(pair);
        const PairMeasure<Dual> measure(shape, places);
        is_touched               = measure.gap.value() > 0;
        const PairLaw &of_bodies = group.bodies_of(pair);
        const bool     rubs      = bent != nullptr && is_touched && of_bodies.friction.has_bristles();
        PairLaw        smooth    = of_bodies;
        if (rubs)
          {
            // bristles are added below
            smooth.friction.kinetic = smooth.friction.breakaway = 0;
            smooth.friction.bristle_stiffness                   = 0;
          }
        auto f = forces_at_state(measure, shape, group.law_of(pair), group.part_of(pair), smooth);
        if (rubs)
          add_bristles(of_bodies.friction, *bent, measure, f);
        take(f, [&](const int i, const Dual &number) {
          value(i)     = number.value();
          slope.row(i) = number.derivatives().transpose();
        });
      }

    private:
      template <typename Take>
      static void
      take(const ContactForces<Dual> &f, const Take &what)
      {
        const std::array<const Vec3<Dual> *, 5> all{{&f.force_b, &f.moment_b, &f.force_a, &f.moment_a, &f.on_axis}};
        for (int i = 0; i < n_forces; ++i)
          what(i, (*all[i / 3])(i % 3));
      }

      static Vector3
      value_of_vector(const Vec3<Dual> &v)
      {
        return {v(0).value(), v(1).value(), v(2).value()};
      }

      void
      add_bristles(const FrictionLaw       &law,
                   const BentBristles      &bent,
                   const PairMeasure<Dual> &measure,
                   ContactForces<Dual>     &f)
      {
        // the force that presses, from the residual that has nothing else along the normal
        const Dual          n = Dual(-PairMeasure<Dual>::dot(f.force_b, measure.normal));
        const Vector3       w = value_of_vector(measure.slip);
        const BristleSlopes slopes(law, bent, w, n.value());
        Vec3<Dual>          rub, way;
        for (int i = 0; i < 3; ++i)
          {
            rub(i) = Dual(slopes.force(i) + slopes.by_normal(i) * (n - n.value()));
            way(i) = Dual(0. * n);
            for (int j = 0; j < 3; ++j)
              {
                rub(i) += slopes.by_slip(i, j) * (measure.slip(j) - w(j));
                way(i) += slopes.by_way(i, j) * measure.slip(j);
              }
          }
        f.add_rub(measure, rub);
        has_ways = slopes.by_way.squaredNorm() > 0;
        if (!has_ways)
          return;
        ContactForces<Dual> of_ways(measure, Dual(0. * n), PairDampers<Dual>());
        of_ways.add_rub(measure, way);
        take(of_ways, [&](const int i, const Dual &number) { by_way.row(i) = number.derivatives().transpose(); });
        by_way.leftCols<n_places>().setZero();
      }
    };

    /** A node of a pair, and its part of the local unknowns and forces. */
    struct NodeOfPair
    {
      unsigned int node;
      /** Changes of the local unknowns by ζ and by ζ̇; forces of the node by the local ones. */
      Eigen::Matrix<double, n_local, 6> by_place = Eigen::Matrix<double, n_local, 6>::Zero(),
                                        by_rate  = Eigen::Matrix<double, n_local, 6>::Zero();
      Eigen::Matrix<double, 6, n_forces> force   = Eigen::Matrix<double, 6, n_forces>::Zero();
      Matrix6                            turn    = Matrix6::Zero(); ///< forces keep their direction, axes turn

      NodeOfPair(const Frame         &frame,
                 const double         weight,
                 const bool           is_b,
                 const Vector3       *e, ///< the axis in the node; null if there is none
                 const Point<double> &point,
                 const LocalForces   &local)
        : node(frame.node)
      {
        const Matrix3 D    = Frame{node}.triad(point.q),
                      spin = skew(Vector3(Eigen::Map<const Vector3>(point.y + 6 * node + 3)));
        Eigen::Matrix<double, 3, 6> place;
        place << D, -D * skew(frame.arm);
        place *= weight;
        Eigen::Matrix<double, 3, 6> place_rate;
        place_rate << D * spin, -D * spin * skew(frame.arm);
        place_rate *= weight;
        const int x = is_b ? 0 : 3, v = is_b ? 9 : 15;
        by_place.middleRows<3>(x)                   = place;
        by_place.middleRows<3>(v)                   = place_rate;
        by_rate.middleRows<3>(v)                    = place;
        by_rate.middleRows<3>(v + 3).rightCols<3>() = weight * D;
        const int     f                             = is_b ? 0 : 6;
        const Matrix3 A                             = weight * D.transpose();
        force.block<3, 3>(0, f)                     = A;
        force.block<3, 3>(3, f)                     = skew(frame.arm) * A;
        force.block<3, 3>(3, f + 3)                 = A;
        const Matrix3 turn_f                        = skew(Vector3(A * local.value.segment<3>(f))),
                      turn_m                        = skew(Vector3(A * local.value.segment<3>(f + 3)));
        turn.block<3, 3>(0, 3)                      = turn_f;
        turn.block<3, 3>(3, 3)                      = skew(frame.arm) * turn_f + turn_m;
        if (e == nullptr)
          return;
        // E = D e: δE = −D e~ θ, and Ė = D Ω~ e: δĖ = −D Ω~ e~ θ − D e~ θ̇
        const Matrix3 e_skew        = skew(*e);
        by_place.block<3, 3>(6, 3)  = -D * e_skew;
        by_place.block<3, 3>(21, 3) = -D * spin * e_skew;
        by_rate.block<3, 3>(21, 3)  = -D * e_skew;
        force.block<3, 3>(3, 12)    = e_skew * D.transpose();
        turn.block<3, 3>(3, 3) += e_skew * skew(Vector3(D.transpose() * local.value.segment<3>(12)));
      }
    };



    /** Nearest places go along their lines as nodes move: by the derivatives of ½ |Δ|² by both abscissae staying zero.
     */
    struct MovingPlaces
    {
      Vector3                           delta = Vector3::Zero(), slope_b = Vector3::Zero(), slope_a = Vector3::Zero();
      Eigen::Matrix<double, n_local, 2> changes = Eigen::Matrix<double, n_local, 2>::Zero(); ///< of local unknowns

      /** Of a node: ways of b and a by ζ, and its forces by the way of its own side. */
      struct OfNode
      {
        Eigen::Matrix<double, 2, 6> ways  = Eigen::Matrix<double, 2, 6>::Zero();
        Vector6                     force = Vector6::Zero();
      };
      std::vector<OfNode> nodes; ///< of a, then of b

      MovingPlaces(const ContactGroup::Sides &sides,
                   const PairPlaces<double>  &places,
                   const Point<double>       &point,
                   const LocalForces         &local)
      {
        if (sides.inverse.isZero(0.))
          return;
        delta = places.x_b - places.x_a;
        add_changes(sides.b, sides.slopes_b, point, true);
        add_changes(sides.a, sides.slopes_a, point, false);
        nodes.resize(sides.a.size() + sides.b.size());
        for (unsigned int i = 0; i < sides.a.size(); ++i)
          set_node(sides.a[i], slope_at(sides.slopes_a, i), false, sides.inverse, point, local, nodes[i]);
        for (unsigned int i = 0; i < sides.b.size(); ++i)
          set_node(
            sides.b[i], slope_at(sides.slopes_b, i), true, sides.inverse, point, local, nodes[sides.a.size() + i]);
      }

    private:
      static double
      slope_at(const std::vector<double> &slopes, const unsigned int i)
      {
        return slopes.empty() ? 0. : slopes[i];
      }

      void
      add_changes(const std::vector<WeightedFrame> &side,
                  const std::vector<double>        &slopes,
                  const Point<double>              &point,
                  const bool                        is_b)
      {
        const int x = is_b ? 0 : 3, v = is_b ? 9 : 15, column = is_b ? 0 : 1;
        for (unsigned int i = 0; i < slopes.size(); ++i)
          {
            const Frame                    &frame = side[i].frame;
            const Matrix3                   D     = Frame{frame.node}.triad(point.q);
            const Eigen::Map<const Vector3> speed(point.y + 6 * frame.node), spin(point.y + 6 * frame.node + 3);
            const Vector3                   along = slopes[i] * frame.position(point.q);
            (is_b ? slope_b : slope_a) += along;
            changes.col(column).segment<3>(x) += along;
            changes.col(column).segment<3>(v) += slopes[i] * D * (speed + spin.cross(frame.arm));
            changes.col(column).segment<3>(v + 3) += slopes[i] * D * spin;
          }
      }

      void
      set_node(const WeightedFrame   &of,
               const double           slope,
               const bool             is_b,
               const Eigen::Matrix2d &inverse,
               const Point<double>   &point,
               const LocalForces     &local,
               OfNode                &node) const
      {
        const Frame                &frame = of.frame;
        const Matrix3               D     = Frame{frame.node}.triad(point.q);
        Eigen::Matrix<double, 3, 6> place;
        place << D, -D * skew(frame.arm);
        const double                sign = is_b ? of.weight : -of.weight;
        Eigen::Matrix<double, 2, 6> first; // of the derivatives of ½ |Δ|²
        first.row(0)        = (sign * slope_b + (is_b ? slope : 0.) * delta).transpose() * place;
        first.row(1)        = (-sign * slope_a - (is_b ? 0. : slope) * delta).transpose() * place;
        node.ways           = -inverse * first;
        const int     f     = is_b ? 0 : 6;
        const Vector3 force = D.transpose() * local.value.segment<3>(f);
        node.force << force, Vector3(frame.arm.cross(force)) + D.transpose() * local.value.segment<3>(f + 3);
        node.force *= slope;
      }
    };
  } // namespace



  void
  ContactGroup::add_matrices(const Pair          &pair,
                             const Point<double> &point,
                             const AddBlocks     &add,
                             const BentBristles  *bent) const
  {
    Sides sides;
    if (!find_sides(pair, point.q, sides))
      return;
    const auto        at = places(pair, sides, point.q, point.y);
    const LocalForces local(*this, pair, at, bent);
    if (!local.is_touched)
      return;
    const MovingPlaces      moving(sides, at, point, local);
    const Vector3           e = sides.a[0].frame.rotation.col(2);
    std::vector<NodeOfPair> nodes;
    nodes.reserve(sides.a.size() + sides.b.size());
    for (const auto &[frame, weight] : sides.a)
      nodes.emplace_back(frame, weight, false, pair.with_surface ? &e : nullptr, point, local);
    for (const auto &[frame, weight] : sides.b)
      nodes.emplace_back(frame, weight, true, nullptr, point, local);
    for (unsigned int i = 0; i < nodes.size(); ++i)
      for (unsigned int j = 0; j < nodes.size(); ++j)
        {
          const NodeOfPair                       &row = nodes[i], &column = nodes[j];
          const Eigen::Matrix<double, 6, n_local> slope = row.force * local.slope;
          Matrix6                                 K     = slope * column.by_place;
          if (!moving.nodes.empty())
            K += slope * moving.changes * moving.nodes[j].ways +
                 moving.nodes[i].force * moving.nodes[j].ways.row(i < sides.a.size() ? 1 : 0);
          if (local.has_ways)
            K += row.force * local.by_way * column.by_rate;
          if (i == j)
            K += row.turn;
          add(row.node, column.node, K, slope * column.by_rate);
        }
  }
} // namespace samara
