#ifndef samara_aero_station_h
#define samara_aero_station_h

#include <samara/aero/inflow.h>
#include <samara/aero/section_loads.h>
#include <samara/rotation/nearest_rotation.h>

#include <cmath>
#include <complex>
#include <vector>

namespace samara
{
  /** How the effective upwash follows that at three quarters of the chord. */
  enum class Unsteady
  {
    quasi_steady, ///< at once
    two_lags,     ///< R. T. Jones's approximation of Wagner's function, two states a station
    dynamic_stall ///< the same, and two states of the flow that separates
  };



  /**
   * A place of a surface at which its loads are computed, and for how much of the span they count: a Gauss point of a
   * piece of a panel that lies on one element.
   *
   * Everything at it is interpolated from the frames of the element it lies in, with shape values N_a: x = Σ N_a x_a
   * and the directors F = Σ N_a D_a, which are not orthonormal between nodes. A point at the arm r, constant components
   * in F, is at x + F r and has the exact velocity Σ N_a D_a (v_a + Ω_a × r).
   */
  struct Station
  {
    double              s = 0, weight = 0; ///< abscissa, and length of span for which it counts [m]
    std::vector<double> N;
    Vector3       quarter = Vector3::Zero(), three_quarters = Vector3::Zero(); ///< arms of these points of the chord
    Vector3       along = Vector3::Zero(), chordwise = Vector3::Zero();        ///< g₁, g₂ of section axes, in F
    SectionOfWing section;
    double        virtual_mass  = 0;    ///< of the air moved along, per length; zero if it does not count [kg/m]
    bool          lifts         = true; ///< false of a cylinder, a rod
    double        pitch_damping = 0;    ///< ηπρc³/16, couple by speed and turning; zero of what does not lift [kg]
    Unsteady      unsteady      = Unsteady::quasi_steady;
    unsigned int  first_lag     = 0; ///< of its states among those of the element
    unsigned int  first_flow    = 0; ///< of those of an annular inflow, likewise
    double        width         = 1; ///< dr/ds of the line on the disk of an annular inflow, reference configuration
    double        radius        = 0; ///< of the quarter chord on that disk [m], reference configuration

    /** Of the point at half chord. */
    Vector3
    middle() const
    {
      return 0.5 * (quarter + three_quarters);
    }
  };



  /** States of a station. */
  constexpr unsigned int
  states_of(const Unsteady unsteady)
  {
    return unsteady == Unsteady::quasi_steady ? 0 : unsteady == Unsteady::two_lags ? 2 : 4;
  }



  /** @name Two lags, and dynamic stall
   * w = (1 − A₁ − A₂) V₃ + A₁ x₁ + A₂ x₂ with ẋ_i = b_i U/(c/2) (V₃ − x_i): R. T. Jones, NACA Report 681 (1940).
   * Where the air rests U is not below 10⁻⁴ of the speed of sound, so that the states are not lost: √(U² + U₀²).
   * Dynamic stall (Risø-R-1354, see Separation): an angle α_p that follows α, T_p α̇_p = U/(c/2) (α − α_p), and a place
   * of separation that follows that of steady flow at α_p, T_f ẋ = U/(c/2) (f(α_p) − x): SeparationLags.
   * @{
   */
  namespace lags
  {
    constexpr unsigned int n   = 2;
    constexpr double       A[] = {0.165, 0.335}, b[] = {0.0455, 0.3}, most_mach = 0.9;

    template <typename Number>
    Number
    effective_upwash(const Number &upwash, const Number *x)
    {
      return (1 - A[0] - A[1]) * upwash + A[0] * x[0] + A[1] * x[1];
    }

    /** √(V₂² + V₃² + U₀²) */
    template <typename Number>
    Number
    speed(const Vec3<Number> &V, const Air &air)
    {
      using std::sqrt;
      const double least = 1e-4 * air.speed_of_sound;
      return sqrt(V(1) * V(1) + V(2) * V(2) + least * least);
    }

    /** U (1 − M²), with M not above 0.9: lift follows more slowly in air that is compressed (J. G. Leishman, Principles
     * of Helicopter Aerodynamics, 2006, section 8.10). Without @p compressible U alone. */
    template <typename Number>
    Number
    speed_of_lags(const Number &U, const Air &air, const bool compressible)
    {
      const Number M = U / air.speed_of_sound;
      return compressible ? Number(U * (1. - (std::real(M) < most_mach ? Number(M * M) : most_mach * most_mach))) : U;
    }

    /** Its derivative by U. */
    inline double
    slope_of_speed_of_lags(const double U, const Air &air, const bool compressible)
    {
      const double M = U / air.speed_of_sound;
      return !compressible ? 1. : M < most_mach ? 1 - 3 * M * M : 1 - most_mach * most_mach;
    }

    /** b − a, less full turns. */
    template <typename Number>
    Number
    angle_between(const Number &a, const Number &b)
    {
      return b - a - 2 * M_PI * std::round((std::real(b) - std::real(a)) / (2 * M_PI));
    }
  } // namespace lags
  /** @} */



  /** T_p and T_f, in half chords that the air passes. */
  struct SeparationLags
  {
    double pressure = 1.7, boundary_layer = 3;
  };



  /**
   * The axes of a frame in which air is seen. In stages of steps that turn those of the node are not orthonormal, and
   * velocities D y would be too small: the nearest ones that are turn with the body, and steady rotation in air is an
   * equilibrium of the step, too (doc/theory/steady_rotation.md).
   */
  template <typename Number>
  Mat3<Number>
  axes_in_air(const Frame &frame, const Point<Number> &point)
  {
    if (point.nearest != nullptr)
      return frame.triad(point.nearest);
    const Mat3<Number> D = frame.triad(point.q);
    return point.reciprocal == nullptr ? D : nearest_rotation(D);
  }



  /** The frames of an element in a state: the parts of a Point that stations need. */
  template <typename Number>
  struct FramesInState
  {
    std::vector<Vec3<Number>> x;
    std::vector<Mat3<Number>> D;
    std::vector<Vec6<Number>> y; ///< twists in the frames' own axes

    void
    gather(const std::vector<Frame> &frames, const Point<Number> &point)
    {
      x.clear();
      D.clear();
      y.clear();
      for (const auto &frame : frames)
        add(frame, point);
    }

    void
    add(const Frame &frame, const Point<Number> &point)
    {
      x.push_back(frame.position(point.q));
      D.push_back(axes_in_air(frame, point));
      y.push_back(frame.twist(point.y));
    }

    /** Σ N_a (x_a + D_a r) */
    Vec3<Number>
    position(const std::vector<double> &N, const Vector3 &r) const
    {
      Vec3<Number> sum = Vec3<Number>::Zero();
      for (unsigned int a = 0; a < N.size(); ++a)
        sum += N[a] * (x[a] + D[a] * r);
      return sum;
    }

    /** Σ N_a D_a Ω_a */
    Vec3<Number>
    spin(const std::vector<double> &N) const
    {
      Vec3<Number> sum = Vec3<Number>::Zero();
      for (unsigned int a = 0; a < N.size(); ++a)
        sum += N[a] * (D[a] * y[a].template tail<3>());
      return sum;
    }

    /** Σ N_a D_a (v_a + Ω_a × r) */
    Vec3<Number>
    velocity(const std::vector<double> &N, const Vector3 &r) const
    {
      Vec3<Number> sum = Vec3<Number>::Zero();
      for (unsigned int a = 0; a < N.size(); ++a)
        sum += N[a] * (D[a] * (y[a].template head<3>() + cross(Vec3<Number>(y[a].template tail<3>()), r)));
      return sum;
    }
  };



  /** What a station interpolates of them, summed once: x, F, and the velocity of the arm r as v + W r. */
  template <typename Number>
  struct AlongElement
  {
    Vec3<Number> x = Vec3<Number>::Zero(), v = Vec3<Number>::Zero(), spin = Vec3<Number>::Zero();
    Mat3<Number> F = Mat3<Number>::Zero(), W = Mat3<Number>::Zero();

    /** Of one frame: D v, D Ω and D Ω~. */
    struct AtFrame
    {
      Vec3<Number> v, spin;
      Mat3<Number> W;

      AtFrame(const Mat3<Number> &D, const Vec6<Number> &y)
      {
        const Vec3<Number> w = y.template tail<3>();
        v                    = D * y.template head<3>();
        spin                 = D * w;
        W << D.col(1) * w(2) - D.col(2) * w(1), D.col(2) * w(0) - D.col(0) * w(2), D.col(0) * w(1) - D.col(1) * w(0);
      }
    };

    AlongElement(const std::vector<double> &N, const FramesInState<Number> &frames, const std::vector<AtFrame> &rates)
    {
      for (unsigned int a = 0; a < N.size(); ++a)
        {
          x += N[a] * frames.x[a];
          F += N[a] * frames.D[a];
          v += N[a] * rates[a].v;
          spin += N[a] * rates[a].spin;
          W += N[a] * rates[a].W;
        }
    }
  };



  /**
   * Orthonormal axes of a section from the directors: e₂ along g₂ = F ê₂, e₃ along g₁ × e₂, e₁ = e₂ × e₃.
   */
  template <typename Number>
  struct SectionAxes
  {
    Vec3<Number> g1, e1, e2, e3;
    Number       length_2, length_3; ///< |g₂|, |g₁ × e₂|

    SectionAxes(const Vec3<Number> &g1, const Vec3<Number> &g2)
      : g1(g1)
    {
      using std::sqrt;
      length_2             = sqrt(dot(g2, g2));
      e2                   = g2 / length_2;
      const Vec3<Number> n = cross(g1, e2);
      length_3             = sqrt(dot(n, n));
      e3                   = n / length_3;
      e1                   = cross(e2, e3);
    }

    /** Components of a spatial vector. */
    Vec3<Number>
    components(const Vec3<Number> &v) const
    {
      return {dot(e1, v), dot(e2, v), dot(e3, v)};
    }

    /** The spatial vector by which they turn when the directors change g₁ and g₂ by these increments. */
    Vec3<Number>
    rotation(const Vec3<Number> &dg1, const Vec3<Number> &dg2) const
    {
      const Vec3<Number> de2 = (dg2 - e2 * dot(e2, dg2)) / length_2;
      const Vec3<Number> dn  = cross(dg1, e2) + cross(g1, de2);
      const Vec3<Number> de3 = (dn - e3 * dot(e3, dn)) / length_3;
      return e1 * dot(de2, e3) + e2 * dot(de3, e1) - e3 * dot(de2, e1);
    }
  };
} // namespace samara

#endif
