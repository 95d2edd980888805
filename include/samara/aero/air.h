#ifndef samara_aero_air_h
#define samara_aero_air_h

#include <samara/base/field_function.h>
#include <samara/model/model.h>

#include <array>
#include <complex>

namespace samara
{
  /**
   * The air in which surfaces move: its density, the speed of sound, and the wind w(x, t), inertial components [m/s].
   *
   * The wind is the same everywhere, or grows with the height z above the ground as (z/z_ref)^p; below a thousandth of
   * z_ref it is what it is there. A gust, any function of place and time, is added to it.
   */
  class Air : public Item
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;

    bool
    acts_on_whole_model() const override
    {
      return true;
    }

    double density = 1.225, speed_of_sound = 340.3; ///< [kg/m^3], [m/s]
    double ground = 0;                              ///< inertial coordinate z [m]

    /** A speed that is small in all units, 1 m/s in the air of the default: below it changes of flows do not count. */
    double
    small_speed() const
    {
      return speed_of_sound / 340.3;
    }

    template <typename Number>
    Vec3<Number>
    wind(const Vec3<Number> &x, const double time) const
    {
      Vec3<Number> result;
      const Number factor = profile(x(2));
      for (unsigned int i = 0; i < 3; ++i)
        result(i) = factor * components[i](time);
      if (has_gust)
        add_gust(x, time, result);
      return result;
    }

    /** Whether the wind is not the same everywhere. */
    bool
    varies_in_space() const
    {
      return exponent != 0 || gust_varies;
    }

    /** Whether the wind grows with the height. */
    bool
    has_shear() const
    {
      return exponent != 0;
    }

    /** Whether the wind grows with the height and the inertial coordinate @p z is so low that it has no height there.
     */
    bool
    is_below_wind(const double z) const
    {
      return exponent != 0 && !(z - ground > lowest * reference_height);
    }

    /** ∂wᵢ/∂xⱼ [1/s] */
    Matrix3 gradient(const Vector3 &x, double time) const;

    /** The first time in (from, to) at which the wind has a corner that does not depend on the place. */
    double next_corner(double from, double to) const;

    bool
    switches_in_place() const
    {
      return gust_switches;
    }

    /** On which pieces the gust is at a place where it switches by the place, see Term::pieces(). */
    void pieces(const Vector3 &x, double time, std::vector<double> &result) const;

    /** The only air of the model, or that of this name. @throws std::invalid_argument, FollowUp */
    static const Air &of(const Model &model, const std::string &name);

  private:
    std::array<FunctionOfTime, 3> components;
    std::array<FieldFunction, 3>  gust;
    bool                          has_gust = false, gust_varies = false, gust_switches = false;
    double                        exponent = 0, reference_height = 10;

    template <typename Number>
    Number
    profile(const Number &z) const
    {
      using std::pow;
      const Number height = (z - ground) / reference_height;
      if (exponent == 0)
        return Number(1);
      return std::real(height) > lowest ? Number(pow(height, exponent)) : Number(std::pow(lowest, exponent));
    }

    void
    add_gust(const Vector3 &x, const double time, Vector3 &wind) const
    {
      for (unsigned int i = 0; i < 3; ++i)
        wind(i) += gust[i](x, time);
    }

    /** Continued by its gradient along imaginary parts so small that their squares are lost. */
    void
    add_gust(const Vec3<std::complex<double>> &x, const double time, Vec3<std::complex<double>> &wind) const
    {
      for (unsigned int i = 0; i < 3; ++i)
        wind(i) += std::complex<double>(gust[i](x.real(), time), gust[i].gradient(x.real(), time).dot(x.imag()));
    }

    static constexpr double lowest = 1e-3;
  };
} // namespace samara

#endif
