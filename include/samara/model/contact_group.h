#ifndef samara_model_contact_group_h
#define samara_model_contact_group_h

#include <samara/model/contact_line.h>
#include <samara/model/contact_pair.h>
#include <samara/model/frame.h>
#include <samara/model/state.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

namespace samara
{
  class Item;

  /**
   * Bodies of which any two may touch. Nothing of a pair is an unknown: which pairs are near is searched for, and their
   * forces have a potential in the gap, see PairShape.
   *
   * Beads are balls, and places along beams with a share of its length, whose line is surrounded by the radius;
   * surfaces are planes (half spaces), endless cylinders, from outside or inside, and hollow balls. Beads touch
   * surfaces, and balls touch balls.
   */
  class ContactGroup
  {
  public:
    struct Bead
    {
      std::vector<WeightedFrame> place;
      double                     radius; ///< [m]
      double                     part;   ///< of a beam: share of the length [m] that stiffness is told per; 1 of a ball
      bool                       is_ball;
      const Item                *body; ///< null of the ground
      std::string                name;
      unsigned int               likeness = 0; ///< of the body: which laws name it
      double                     share    = 1; ///< of a beam: its part of the length, and so of the bristles
    };

    struct Surface
    {
      PairShape::Kind kind;
      bool            hollow;
      Frame           frame;  ///< its axis 3 is the normal or the axis
      double          radius; ///< [m]; none of a plane
      const Item     *body;
      std::string     name;
      unsigned int    likeness = 0;
    };

    std::vector<Bead>        beads;
    std::vector<Surface>     surfaces;
    std::vector<ContactLine> lines; ///< beams, which balls and other beams touch at nearest places
    bool                     balls_touch_balls = true;

    /** The first is that of all pairs for which there is no other. */
    std::vector<PairLaw> laws = {{}};
    std::vector<std::vector<unsigned int>>
      law_of_likes; ///< number of the law by the likeness of both bodies, if several

    std::string  name; ///< for messages: "contacts <pile>"
    const Item  *item       = nullptr;
    unsigned int number     = 0;     ///< among the groups of the layout
    bool         is_coupled = false; ///< all its pairs are in the pattern of the layout: for statics and modes

    /** A bead and a surface, or another ball, or a place of a line; or places of two lines. B is the first. */
    struct Pair
    {
      unsigned int  bead, other; ///< numbers among those
      bool          with_surface;
      bool          b_is_line = false, a_is_line = false;
      NearestPlaces nearest = {}; ///< of lines, where the pair was found
    };

    /** Whether the two can move against each other, and are not of one body. */
    bool is_possible(const Pair &pair) const;

    /** How far beads and surfaces may go before pairs that are not listed can touch [m]. */
    struct Margins
    {
      std::vector<double> beads, surfaces, lines;
      double              reach = 0; ///< of the group, by which the turn of a surface counts [m]
    };

    /**
     * The pairs that can touch within a step of @p h [s]: nearer than both sides come by one and a half times their
     * speeds, and a little more for what accelerates. Every bead and surface has its own margin: one that is fast is
     * paired with many, the others are not. With h = 0 the pairs that touch. Pairs are sorted, as numbers of a run do
     * not depend on the way to find them.
     */
    void find_pairs(const double *q, const double *y, double h, std::vector<Pair> &pairs, Margins &margins) const;

    PairShape   shape(const Pair &pair) const;
    std::string name_of(const Pair &pair) const;
    /** Of the two bodies. */
    const PairLaw &
    bodies_of(const Pair &pair) const
    {
      if (law_of_likes.empty())
        return laws.front();
      const unsigned int b = pair.b_is_line ? lines[pair.bead].likeness : beads[pair.bead].likeness,
                         a = pair.with_surface ? surfaces[pair.other].likeness :
                             pair.a_is_line    ? lines[pair.other].likeness :
                                                 beads[pair.other].likeness;
      return laws[law_of_likes[b][a]];
    }
    const ContactLaw &
    law_of(const Pair &pair) const
    {
      const PairLaw &of_bodies = bodies_of(pair);
      return is_station(pair) ? of_bodies.line_law : of_bodies.law;
    }
    double
    part_of(const Pair &pair) const
    {
      return is_station(pair) ? beads[pair.bead].part : 1.;
    }
    /** Of the bristles of its law. */
    double
    share_of(const Pair &pair) const
    {
      return is_station(pair) ? beads[pair.bead].share : 1.;
    }
    bool
    has_bristles() const
    {
      return std::any_of(laws.begin(), laws.end(), [](const PairLaw &law) { return law.friction.has_bristles(); });
    }

    /** @name Bristles that are bent (contact_bristles.cc) @{ */
    static unsigned int
    kind_of(const Pair &pair)
    {
      return (pair.with_surface ? 1u : 0u) + (pair.b_is_line ? 2u : 0u) + (pair.a_is_line ? 4u : 0u);
    }
    PairBristle bristle_of(const Pair &pair, const Vector3 &deflection) const;
    /** Those of this pair; null if it has none. */
    const PairBristle *find_bristle(const Pair &pair, const PairBristles &bristles) const;
    /** ½ σ₀ |z|² of one of this group [J]. */
    double energy_of(const PairBristle &bristle) const;
    double energy_of(const PairBristles &bristles) const;
    /** @} */

    bool
    has_friction() const
    {
      return std::any_of(laws.begin(), laws.end(), [](const PairLaw &law) { return law.has_friction; });
    }

    /** The frames that both sides of a pair move with. */
    struct Sides
    {
      std::vector<WeightedFrame> b, a;
      bool                       is_parallel = false; ///< nearest places are not determined

      /** Of nearest places: how weights change as these move along their lines [1/m], and NearestPlaces::inverse. */
      std::vector<double> slopes_b, slopes_a;
      Eigen::Matrix2d     inverse = Eigen::Matrix2d::Zero();
    };
    /** Those at @p q; false if nearest places of lines are not found. */
    bool find_sides(const Pair &pair, const double *q, Sides &sides) const;

    /** Where a pair is, and how it moves if @p y is not null. Places on lines move with their material; of complex
     * numbers, moved by imaginary steps from where the sides were found, to where they are nearest then. */
    template <typename Number>
    PairPlaces<Number> places(const Pair   &pair,
                              const Sides  &sides,
                              const Number *q,
                              const Number *y,
                              const Number *q_of_forces = nullptr) const;

    /** The gap alone, for what is not moved; NaN if there is none. */
    double gap(const Pair &pair, const double *q) const;

    /** Add forces of a pair to a residual; @p of_node: where in @p r the six of a node are. */
    template <typename Number, typename OfNode>
    void add_forces(const Pair                  &pair,
                    const Sides                 &sides,
                    const ContactForces<Number> &forces,
                    const Number                *q,
                    const OfNode                &of_node,
                    Number                      *r) const;

    /** Derivatives of the residual of a pair at a state by ζ and ζ̇ of the nodes: add(node of row, node of column, K,
     * C). */
    using AddBlocks = std::function<void(unsigned int, unsigned int, const Matrix6 &K, const Matrix6 &C)>;
    void add_matrices(const Pair          &pair,
                      const Point<double> &point,
                      const AddBlocks     &add,
                      const BentBristles  *bent = nullptr) const;

    /** U of all pairs [J], by a search of its own. */
    double energy(const double *q) const;

    /** All nodes of a pair's sides; of lines those of the pieces where it was found. */
    void nodes_of(const Pair &pair, std::vector<unsigned int> &nodes) const;

    /** Whether places of lines may be nearest to others. */
    bool has_nearest_places() const;

    /** A pair that touches, or may, and whose nearest places are not determined; empty if there is none. */
    std::string without_nearest_places(const double *q) const;

    /** Speed at the centre of a bead [m/s], and its place. */
    Vector3 position(const Bead &bead, const double *q) const;

  private:
    Vector3 velocity(const Bead &bead, const double *q, const double *y) const;
    struct Search;
    void find_among_bounded(const double               *q,
                            const double               *y,
                            double                      h,
                            const std::vector<Vector3> &x,
                            std::vector<Pair>          &pairs,
                            Margins                    &margins) const;
    void find_bounded(const Search &search, std::vector<Pair> &pairs) const;
    void find_on_lines(const Search &search, unsigned int i, unsigned int j, std::vector<Pair> &pairs) const;
    bool
    is_station(const Pair &pair) const
    {
      return !pair.b_is_line && !beads[pair.bead].is_ball;
    }

    /** How far nearest places of b and a go along their lines with imaginary steps of q; nothing of real numbers. */
    template <typename Number>
    static std::array<Number, 2> ways_along_lines(const Sides &sides, const Number *q);

    /** The weight of a frame of a side whose place has gone so far. */
    template <typename Number>
    static Number
    weight_behind(const std::vector<WeightedFrame> &side,
                  const std::vector<double>        &slopes,
                  const unsigned int                i,
                  const Number                     &way)
    {
      return slopes.empty() ? Number(side[i].weight) : Number(side[i].weight + slopes[i] * way);
    }
  };



  template <typename Number>
  std::array<Number, 2>
  ContactGroup::ways_along_lines(const Sides &sides, const Number *const q)
  {
    if constexpr (!std::is_same<Number, double>::value)
      if (!sides.inverse.isZero(0.))
        {
          // the derivatives of ½ |Δ|² by the abscissae are zero where the places were found
          Vec3<Number> delta = Vec3<Number>::Zero(), slope_b = delta, slope_a = delta;
          for (unsigned int i = 0; i < sides.b.size(); ++i)
            {
              const Vec3<Number> x = sides.b[i].frame.position(q);
              delta += sides.b[i].weight * x;
              slope_b += (sides.slopes_b.empty() ? 0. : sides.slopes_b[i]) * x;
            }
          for (unsigned int i = 0; i < sides.a.size(); ++i)
            {
              const Vec3<Number> x = sides.a[i].frame.position(q);
              delta -= sides.a[i].weight * x;
              slope_a += (sides.slopes_a.empty() ? 0. : sides.slopes_a[i]) * x;
            }
          const double by_b = PairMeasure<Number>::dot(delta, slope_b).imag(),
                       by_a = -PairMeasure<Number>::dot(delta, slope_a).imag();
          return {{Number(0, -(sides.inverse(0, 0) * by_b + sides.inverse(0, 1) * by_a)),
                   Number(0, -(sides.inverse(1, 0) * by_b + sides.inverse(1, 1) * by_a))}};
        }
    return {{Number(0), Number(0)}};
  }



  template <typename Number>
  PairPlaces<Number>
  ContactGroup::places(const Pair   &pair,
                       const Sides  &sides,
                       const Number *q,
                       const Number *y,
                       const Number *q_of_forces) const
  {
    PairPlaces<Number> p;
    const Vec3<Number> none = Vec3<Number>::Zero();
    p.x_b = p.v_b = p.spin_b = p.x_a = p.v_a = p.spin_a = p.axis = p.axis_rate = p.dual_axis = none;
    const auto turned = [&](const unsigned int node, const Vec3<Number> &v) -> Vec3<Number> {
      return Frame{node}.triad(q) * v;
    };
    const auto spin_of = [&](const unsigned int node) {
      return Vec3<Number>(y[6 * node + 3], y[6 * node + 4], y[6 * node + 5]);
    };
    const auto speed_of = [&](const Frame &f) -> Vec3<Number> {
      const Number *const v   = y + 6 * f.node;
      const Vec3<Number>  arm = f.arm.cast<Number>();
      return turned(f.node, Vec3<Number>(v[0], v[1], v[2]) + cross_of(spin_of(f.node), arm));
    };
    const auto ways = ways_along_lines(sides, q);
    const auto add  = [&](const std::vector<WeightedFrame> &side,
                         const std::vector<double>        &slopes,
                         const Number                     &way,
                         Vec3<Number>                     &x,
                         Vec3<Number>                     &v,
                         Vec3<Number>                     &spin) {
      for (unsigned int i = 0; i < side.size(); ++i)
        {
          const Frame &frame  = side[i].frame;
          const Number weight = weight_behind(side, slopes, i, way);
          x += weight * frame.position(q);
          if (y == nullptr)
            continue;
          v += weight * speed_of(frame);
          spin += weight * turned(frame.node, spin_of(frame.node));
        }
    };
    add(sides.b, sides.slopes_b, ways[0], p.x_b, p.v_b, p.spin_b);
    add(sides.a, sides.slopes_a, ways[1], p.x_a, p.v_a, p.spin_a);
    if (!pair.with_surface)
      return p;
    const Frame       &a = sides.a[0].frame;
    const Vec3<Number> e = a.rotation.col(2).cast<Number>();
    p.axis               = turned(a.node, e);
    p.dual_axis          = q_of_forces != nullptr ? Vec3<Number>(Frame{a.node}.triad(q_of_forces) * e) : p.axis;
    if (y != nullptr)
      p.axis_rate = turned(a.node, cross_of(spin_of(a.node), e));
    return p;
  }



  template <typename Number, typename OfNode>
  void
  ContactGroup::add_forces(const Pair                  &pair,
                           const Sides                 &sides,
                           const ContactForces<Number> &f,
                           const Number                *q,
                           const OfNode                &of_node,
                           Number                      *r) const
  {
    const auto add =
      [&](const Frame &frame, const Number &weight, const Vec3<Number> &force, const Vec3<Number> &in_node) {
        const Vec3<Number> local = weight * frame.in_node(q, force);
        const Vec3<Number> about = cross_of<Number>(frame.arm.cast<Number>(), local) + weight * in_node;
        Number *const      to    = r + of_node(frame.node);
        for (int i = 0; i < 3; ++i)
          {
            to[i] += local(i);
            to[3 + i] += about(i);
          }
      };
    const auto ways = ways_along_lines(sides, q);
    for (unsigned int i = 0; i < sides.b.size(); ++i)
      {
        const Frame &frame = sides.b[i].frame;
        add(frame, weight_behind(sides.b, sides.slopes_b, i, ways[0]), f.force_b, frame.in_node(q, f.moment_b));
      }
    for (unsigned int i = 0; i < sides.a.size(); ++i)
      {
        const Frame &frame  = sides.a[i].frame;
        Vec3<Number> moment = frame.in_node(q, f.moment_a);
        if (pair.with_surface)
          moment += cross_of<Number>(frame.rotation.col(2).template cast<Number>(), frame.in_node(q, f.on_axis));
        add(frame, weight_behind(sides.a, sides.slopes_a, i, ways[1]), f.force_a, moment);
      }
  }
} // namespace samara

#endif
