#ifndef samara_model_contact_pair_h
#define samara_model_contact_pair_h

#include <samara/base/contact_law.h>
#include <samara/base/friction_law.h>
#include <samara/rotation/rotation.h>

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
  };



  /** Where the two sides are and how they move; inertial components. */
  template <typename Number>
  struct PairPlaces
  {
    Vec3<Number> x_a, axis, x_b;                      ///< [m], [1], [m]
    Vec3<Number> v_a, spin_a, axis_rate, v_b, spin_b; ///< [m/s], [rad/s], [1/s], [m/s], [rad/s]
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
              const Number along = dot(p.axis, delta);
              of_place -= along * p.axis;
              of_axis = -along * delta;
              phi -= 0.5 * along * along;
            }
          distance = Number(sqrt(Number(2. * phi)));
          gap      = shape.hollow ? Number(distance + shape.radius_b - shape.radius_a) :
                                    Number(shape.radius_a + shape.radius_b - distance);
        }
      rate   = Number(dot(of_place, moving) + dot(of_axis, p.axis_rate));
      normal = Number(-shape.sign() / distance) * of_place;
      arm_b  = Number(0.5 * gap - shape.radius_b) * normal;
      arm_a  = delta + arm_b;
      whole  = moving + cross_of(p.spin_b, arm_b) - cross_of(p.spin_a, arm_a);
      slip   = whole - dot(normal, whole) * normal;
    }

    /** Without conjugation of complex numbers. */
    static Number
    dot(const Vec3<Number> &a, const Vec3<Number> &b)
    {
      return Number(a(0) * b(0) + a(1) * b(1) + a(2) * b(2));
    }
  };



  /** What a pair adds to the residual: minus the forces and moments on both sides, and what does work on E. */
  template <typename Number>
  struct ContactForces
  {
    Vec3<Number> force_a, moment_a, on_axis, force_b, moment_b;

    /** @p along_phi: against dφ, f sign/d; @p viscous: friction is −viscous·slip on B [N s/m]. */
    ContactForces(const PairMeasure<Number> &m, const Number &along_phi, const Number &viscous)
    {
      const Vec3<Number> rub = viscous * m.slip;
      force_b                = along_phi * m.of_place + rub;
      force_a                = -force_b;
      moment_b               = cross_of(m.arm_b, rub);
      moment_a               = -cross_of(m.arm_a, rub);
      on_axis                = along_phi * m.of_axis;
    }
  };



  /** Forces at a state, where each pair acts by its own gap and rate: f = U'(g) + damper ≥ 0, friction N = f. */
  template <typename Number>
  ContactForces<Number>
  forces_at_state(const PairMeasure<Number> &m,
                  const PairShape           &shape,
                  const ContactLaw          &law,
                  const double               part,
                  const FrictionLaw         *friction)
  {
    // the law is one of doubles: its value and slopes go on in numbers with derivatives
    const double g    = value_of(m.gap);
    const Number rate = Number(shape.sign() * m.rate / m.distance);
    const double r    = value_of(rate);
    const auto   d    = law.damper(g, r);
    const Number f =
      Number(part * (law.force(g) + d.force + (law.slope(g) + d.by_gap) * (m.gap - g) + d.by_rate * (rate - r)));
    Number viscous(0);
    if (friction != nullptr)
      viscous = Number(f * (*friction)(Number(PairMeasure<Number>::dot(m.slip, m.slip))).c);
    return ContactForces<Number>(m, Number(f * shape.sign() / m.distance), viscous);
  }
} // namespace samara

#endif
