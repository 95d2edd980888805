#ifndef samara_aero_air_h
#define samara_aero_air_h

#include <samara/base/function_of_time.h>
#include <samara/model/model.h>

#include <array>

namespace samara
{
  /**
   * The air in which surfaces move: its density, the speed of sound, and the wind w(x, t), inertial components [m/s].
   *
   * The wind is the same everywhere, or grows with the height z above the ground as (z/z_ref)^p; below a thousandth of
   * z_ref it is what it is there.
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

    template <typename Number>
    Vec3<Number>
    wind(const Vec3<Number> &x, const double time) const
    {
      Vec3<Number> result;
      const Number factor = profile(x(2));
      for (unsigned int i = 0; i < 3; ++i)
        result(i) = factor * components[i](time);
      return result;
    }

    /** ∂w/∂z; the wind does not change with x and y. */
    Vector3 gradient(double z, double time) const;

    /** The first time in (from, to) at which the wind has a corner. */
    double next_corner(double from, double to) const;

    /** The only air of the model, or that of this name. @throws std::invalid_argument, FollowUp */
    static const Air &of(const Model &model, const std::string &name);

  private:
    std::array<FunctionOfTime, 3> components;
    double                        exponent = 0, reference_height = 10, ground = 0;

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

    static constexpr double lowest = 1e-3;
  };
} // namespace samara

#endif
