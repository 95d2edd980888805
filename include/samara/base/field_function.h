#ifndef samara_base_field_function_h
#define samara_base_field_function_h

#include <samara/base/value.h>

#include <memory>

namespace samara
{
  /**
   * A function of the place x, y, z [m] and of time t [s], as users write it: an expression, or a table over t. All in
   * SI units. Copies share what was read.
   */
  class FieldFunction
  {
  public:
    FieldFunction(double constant = 0);

    /** Throws std::invalid_argument if @p text is neither a table nor an expression of x, y, z and t. */
    explicit FieldFunction(const std::string &text);

    double
    operator()(const Eigen::Vector3d &x, const double t) const
    {
      const double at[4] = {t, x(0), x(1), x(2)};
      return parts->formula.at(at, 0).value;
    }

    /** By x, y, z. Exact; where something switches, that of the piece it is on. */
    Eigen::Vector3d gradient(const Eigen::Vector3d &x, double t) const;

    bool
    is_zero() const
    {
      return parts->is_zero;
    }

    bool
    depends_on_place() const
    {
      return parts->depends_on_place;
    }

    /** Whether something switches that depends on the place. */
    bool
    switches_in_place() const
    {
      return parts->depends_on_place && parts->formula.switches();
    }

    /** On which of its pieces each operation is that has some, appended; see Formula. */
    void pieces(const Eigen::Vector3d &x, double t, std::vector<double> &result) const;

    /** The first corner in (from, to) of what depends on time alone, see ScalarFunction::next_corner(). */
    double next_corner(double from, double to) const;

    /** Text that reads as this function. */
    const std::string &
    text() const
    {
      return parts->source;
    }

    /** x, y, z and t, in the order in which formulas have them. */
    static const std::vector<std::string> variables;

  private:
    struct Parts
    {
      std::string                 source;
      Formula                     formula;
      bool                        is_zero = false, depends_on_place = false;
      std::vector<ScalarFunction> of_time; ///< what has corners that depend on time alone
    };
    std::shared_ptr<const Parts> parts;
  };



  template <>
  struct Value<FieldFunction>
  {
    static constexpr char separator = ',';
    static constexpr bool has_unit  = true;

    static FieldFunction  read(const std::string &text, const std::string &unit, const Quantities &quantities);
    static std::string    write(const FieldFunction &value);
    static PatternPointer pattern();
  };
} // namespace samara

#endif
