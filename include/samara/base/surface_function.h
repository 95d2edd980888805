#ifndef samara_base_surface_function_h
#define samara_base_surface_function_h

#include <samara/base/value.h>

namespace samara
{
  /** A function of the two coordinates u and v of a patch, as users write it: an expression, in SI units. */
  class SurfaceFunction
  {
  public:
    SurfaceFunction(const double constant = 0)
      : source(number_to_text(constant))
      , formula(constant)
    {}

    /** Throws std::invalid_argument if @p text is not an expression of u and v. */
    explicit SurfaceFunction(const std::string &text)
      : source(text)
      , formula(text, std::vector<std::string>{"u", "v"})
    {}

    double
    operator()(const double u, const double v) const
    {
      const double at[2] = {u, v};
      return formula.at(at, 0).value;
    }

    /** Text that reads as this function. */
    const std::string &
    text() const
    {
      return source;
    }

  private:
    std::string source;
    Formula     formula;
  };



  template <>
  struct Value<SurfaceFunction>
  {
    static constexpr char separator = ',';
    static constexpr bool has_unit  = true;

    static SurfaceFunction
    read(const std::string &text, const std::string &unit, const Quantities &quantities)
    {
      return SurfaceFunction(quantities.expression(text, unit, {"u", "v"}));
    }

    static std::string
    write(const SurfaceFunction &value)
    {
      return value.text();
    }

    static PatternPointer
    pattern()
    {
      return std::make_unique<dealii::Patterns::Anything>();
    }
  };
} // namespace samara

#endif
