#ifndef samara_model_contact_pair_h
#define samara_model_contact_pair_h

#include <samara/base/contact_law.h>
#include <samara/base/friction_law.h>
#include <samara/rotation/rotation.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace samara
{
  /**
   * The shapes of a pair: a ball B of radius r, or a place on the line of a beam, and a surface A.
   *
   *     plane       φ = E·Δ                      gap g = r − φ
   *     ball        φ = ½ Δ·Δ                    d = √(2φ),  g = R + r − d, or d + r − R inside of a hollow one
   *     cylinder    φ = ½ (Δ·Δ − (E·Δ)²)         the same, d the distance from the axis
   *
   * with Δ from the point of A to the centre of B and the unit vector E of A, normal or axis. g is positive where they
   * press into each other. φ is quadratic in places and triads of nodes, of a cylinder if its axis keeps its direction:
   * the work of forces along its gradient over a step is then exact (time/stage_contacts.h).
   */
  struct PairShape
  {
    enum Kind
    {
      plane,
      ball,
      cylinder
    };
    Kind   kind;
    bool   hollow;   ///< B is inside
    double radius_a; ///< R [m]; none of a plane
    double radius_b; ///< r [m]

    /** Sign of dg/dφ. */
    double
    sign() const
    {
      return hollow ? 1. : -1.;
    }

    /** φ and the gap that belong to one another. @{ */
    double
    phi_at(const double gap) const
    {
      const double distance = hollow ? gap + radius_a - radius_b : radius_a + radius_b - gap;
      return kind == plane ? radius_b - gap : 0.5 * distance * distance;
    }
    double
    gap_at(const double phi) const
    {
      if (kind == plane)
        return radius_b - phi;
      return gap_of(std::sqrt(2 * phi));
    }
    /** @} */

    /** The gap of what is not a plane, at the distance d. */
    template <typename Number>
    Number
    gap_of(const Number &distance) const
    {
      return hollow ? Number(distance + radius_b - radius_a) : Number(radius_a + radius_b - distance);
    }
  };



  /** Where the two sides are and how they move; inertial components. */
  template <typename Number>
  struct PairPlaces
  {
    Vec3<Number> x_a, axis, x_b;                      ///< [m], [1], [m]
    Vec3<Number> v_a, spin_a, axis_rate, v_b, spin_b; ///< [m/s], [rad/s], [1/s], [m/s], [rad/s]
    Vec3<Number> dual_axis; ///< in stages that turn D⁻ᵀ of the axis in A: what is along it is seen as at rest; else E
  };



  /** a × b, of complex numbers without the conjugation that Eigen's has. */
  template <typename Number>
  Vec3<Number>
  cross_of(const Vec3<Number> &a, const Vec3<Number> &b)
  {
    return {Number(a(1) * b(2) - a(2) * b(1)), Number(a(2) * b(0) - a(0) * b(2)), Number(a(0) * b(1) - a(1) * b(0))};
  }



  /** The value of a number that may have derivatives. */
  inline double
  value_of(const double x)
  {
    return x;
  }
  inline double
  value_of(const std::complex<double> &x)
  {
    return x.real();
  }
  template <typename Number>
  auto
  value_of(const Number &x) -> decltype(x.value())
  {
    return x.value();
  }



  /** What follows from it: the gap, its gradient, and the slip. */
  template <typename Number>
  struct PairMeasure
  {
    Number       phi, rate;    ///< φ and its rate
    Number       distance;     ///< d; 1 of a plane, so that dg/dφ = sign/d
    Number       gap;          ///< g [m], positive where it is pressed
    Vec3<Number> of_place;     ///< ∂φ/∂x_b = −∂φ/∂x_a
    Vec3<Number> of_axis;      ///< ∂φ/∂E
    Vec3<Number> normal;       ///< in which B is pressed [1]
    Vec3<Number> arm_a, arm_b; ///< from both to the place where forces of friction act, halfway between the surfaces
    Vec3<Number> slip, whole;  ///< of B against A there, in the tangent plane; with its part along the normal [m/s]
    Vec3<Number> roll, spin;   ///< angular velocity of B against A in the tangent plane, and along the normal [rad/s]

    PairMeasure(const PairShape &shape, const PairPlaces<Number> &p)
    {
      using std::sqrt;
      const Vec3<Number> delta = p.x_b - p.x_a, moving = p.v_b - p.v_a;
      distance = Number(1);
      of_axis.setZero();
      if (shape.kind == PairShape::plane)
        {
          phi      = dot(p.axis, delta);
          of_place = p.axis;
          of_axis  = delta;
          gap      = Number(shape.radius_b - phi);
        }
      else
        {
          of_place = delta;
          phi      = Number(0.5 * dot(delta, delta));
          if (shape.kind == PairShape::cylinder)
            {
              const Number along = dot(p.dual_axis, delta);
              of_place -= along * p.axis;
              of_axis = -along * delta;
              phi -= 0.5 * along * dot(p.axis, delta);
            }
          distance = Number(sqrt(Number(2. * phi)));
          gap      = shape.gap_of(distance);
        }
      rate   = Number(dot(of_place, moving) + dot(of_axis, p.axis_rate));
      normal = Number(-shape.sign() / distance) * of_place;
      arm_b  = Number(0.5 * gap - shape.radius_b) * normal;
      arm_a  = delta + arm_b;
      whole  = moving + cross_of(p.spin_b, arm_b) - cross_of(p.spin_a, arm_a);
      slip   = whole - dot(normal, whole) * normal;
      spin   = p.spin_b - p.spin_a;
      roll   = spin - dot(normal, spin) * normal;
      spin -= roll;
    }

    /** Without conjugation of complex numbers. */
    static Number
    dot(const Vec3<Number> &a, const Vec3<Number> &b)
    {
      return Number(a(0) * b(0) + a(1) * b(1) + a(2) * b(2));
    }
  };



  /**
   * What acts between two bodies of a group: of balls, and of beams per length; friction, and the coefficients of what
   * resists rolling and turning on the spot, each with the sticking speed of the friction.
   */
  struct PairLaw
  {
    ContactLaw  law, line_law;
    FrictionLaw friction;
    bool        has_friction = false;     ///< or resistance
    double      rolling = 0, turning = 0; ///< [1]
  };



  /** Bristles of a pair at some time, and for how long they bend from there on [s]: what Newton's method is told. */
  struct BentBristles
  {
    Vector3 deflection = Vector3::Zero(); ///< [m]
    double  part       = 1;               ///< of the stiffness and damping of the law
    double  h          = 0;
  };



  /** Force of bristles against the slip @p w under the force @p n that presses, at a state: σ₀ z + σ₁(w) ż. */
  template <typename Number>
  Vec3<Number>
  force_of_bristles(const FrictionLaw &law, const BentBristles &bent, const Vec3<Number> &w, const Number &n)
  {
    using std::sqrt;
    const double sigma_0 = bent.part * law.bristle_stiffness, sigma_1 = bent.part * law.bristle_damping;
    const Number square(w(0) * w(0) + w(1) * w(1) + w(2) * w(2));
    const Number size = value_of(square) > 0 ? Number(sqrt(square)) : Number(0. * square),
                 G    = Number(n * law.coefficient(square).c);
    if (!(value_of(G) > 0))
      return Vec3<Number>(Number(0. * square), Number(0. * square), Number(0. * square));
    const Vec3<Number> z    = bent.deflection.cast<Number>();
    const Vec3<Number> rate = w - Number(sigma_0 * size / G) * z;
    return Number(sigma_0) * z + Number(4. * sigma_1 * G / (4. * G + sigma_1 * size)) * rate;
  }



  /** Factors of slip [N s/m] and of both parts of the relative angular velocity [N m s], none of them negative. */
  template <typename Number>
  struct PairDampers
  {
    Number slip = Number(0), roll = Number(0), spin = Number(0);

    PairDampers() = default;

    /** For the force @p n that presses: friction N c, if not bristles rub (@p with_slip is false), and N μ R²/√(|R ω|²
     * + ε²) with the radius R of the ball, or of the smaller one of two. */
    PairDampers(const PairMeasure<Number> &m,
                const PairShape           &shape,
                const PairLaw             &law,
                const Number              &n,
                const bool                 with_slip = true)
    {
      using std::sqrt;
      const auto square = [](const Vec3<Number> &v) { return Number(PairMeasure<Number>::dot(v, v)); };
      if (with_slip)
        slip = Number(n * law.friction(square(m.slip)).c);
      const double R =
        shape.kind == PairShape::ball && !shape.hollow ? std::min(shape.radius_a, shape.radius_b) : shape.radius_b;
      const double e_2    = law.friction.sticking_speed * law.friction.sticking_speed;
      const auto   resist = [&](const double mu, const Vec3<Number> &omega) {
        return Number(mu * R * R * n / sqrt(Number(R * R * square(omega) + e_2)));
      };
      if (law.rolling > 0)
        roll = resist(law.rolling, m.roll);
      if (law.turning > 0)
        spin = resist(law.turning, m.spin);
    }

    /** The power that they take [W]. */
    Number
    power(const PairMeasure<Number> &m) const
    {
      const auto dot = &PairMeasure<Number>::dot;
      return Number(slip * dot(m.slip, m.whole) + roll * dot(m.roll, m.roll) + spin * dot(m.spin, m.spin));
    }
  };



  /** What a pair adds to the residual: minus the forces and moments on both sides, and what does work on E. */
  template <typename Number>
  struct ContactForces
  {
    Vec3<Number> force_a, moment_a, on_axis, force_b, moment_b;

    /** @p along_phi: against dφ, f sign/d; friction and resistance on B are minus the dampers times their rates. */
    ContactForces(const PairMeasure<Number> &m, const Number &along_phi, const PairDampers<Number> &dampers)
    {
      const Vec3<Number> rub = dampers.slip * m.slip, resisted = dampers.roll * m.roll + dampers.spin * m.spin;
      force_b  = along_phi * m.of_place + rub;
      force_a  = -force_b;
      moment_b = cross_of(m.arm_b, rub) + resisted;
      moment_a = -cross_of(m.arm_a, rub) - resisted;
      on_axis  = along_phi * m.of_axis;
    }

    /** Another force on A, and minus it on B, where they touch: that of bristles. */
    void
    add_rub(const PairMeasure<Number> &m, const Vec3<Number> &rub)
    {
      force_b += rub;
      force_a -= rub;
      moment_b += cross_of(m.arm_b, rub);
      moment_a -= cross_of(m.arm_a, rub);
    }
  };



  /** Forces at a state, where each pair acts by its own gap and rate: f = U'(g) + damper ≥ 0, friction N = f. Where @p
   * bent is null bristles are not known: what slips is rubbed as they do in the long run, without them. */
  template <typename Number>
  ContactForces<Number>
  forces_at_state(const PairMeasure<Number> &m,
                  const PairShape           &shape,
                  const ContactLaw          &law,
                  const double               part,
                  const PairLaw             &of_bodies,
                  const BentBristles        *bent = nullptr)
  {
    // the law is one of doubles: its value and slopes go on in numbers with derivatives
    const double g    = value_of(m.gap);
    const Number rate = Number(shape.sign() * m.rate / m.distance);
    const double r    = value_of(rate);
    const auto   d    = law.damper(g, r);
    const Number f =
      Number(part * (law.force(g) + d.force + (law.slope(g) + d.by_gap) * (m.gap - g) + d.by_rate * (rate - r)));
    const bool has_bristles = bent != nullptr && of_bodies.friction.has_bristles();
    const auto dampers =
      of_bodies.has_friction ? PairDampers<Number>(m, shape, of_bodies, f, !has_bristles) : PairDampers<Number>();
    ContactForces<Number> forces(m, Number(f * shape.sign() / m.distance), dampers);
    if (has_bristles)
      forces.add_rub(m, force_of_bristles<Number>(of_bodies.friction, *bent, m.slip, f));
    return forces;
  }
} // namespace samara

#endif
