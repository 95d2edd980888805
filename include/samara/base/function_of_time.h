#ifndef samara_base_function_of_time_h
#define samara_base_function_of_time_h

#include <samara/base/formula.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace samara
{
  /**
   * A function of one variable that users write: a constant, an expression of the variable, or a table
   * "table: x1 y1; x2 y2; ..." that is linear between its points and constant beyond the first and the last.
   *
   * Everything is in SI units; Quantities::expression() makes such text from what a user wrote. Derivatives are exact
   * (see Formula). At a corner of a table the slope is that to the right. Copies share what was read; a number alone
   * needs nothing but itself: models have many functions, and most of them are zero.
   */
  class ScalarFunction
  {
  public:
    ScalarFunction(double constant);

    /** Throws std::invalid_argument if @p text cannot be read. */
    ScalarFunction(const std::string &text, const std::string &variable);

    explicit ScalarFunction(const Formula &formula);

    double
    operator()(const double x) const
    {
      return constant ? at_zero : evaluate(x).value;
    }

    double derivative(double x) const;

    double second_derivative(double x) const;

    /**
     * The first corner x in (from, to): a place where the function or its derivative may jump. Corners are the points
     * of a table, and the places where a formula switches by a comparison, abs(), sign(), min(), max(), floor(),
     * ceil(), rint() or atan2(). Infinity if there is none. A corner within 1e-12 max(1, |x|) of an end of the interval
     * counts as lying at that end and is not found. So one can ask again from the last corner, and steps that end at
     * corners do not get that short.
     *
     * Corners are exact to round-off. None is missed where the compared expressions are linear in the variable, also by
     * parts: t < 1, or min(1, max(0, t/2)). Other formulas are sampled at 64 points of the interval, which must be
     * finite. Then a switch is found for certain if the formula is on another piece at @p to than at @p from. Two
     * switches, forth and back, are missed if they lie between neighbouring samples. A condition that holds at single
     * points only is missed, too; but t == 1 is found, as a change of sides. Poles (1/t, tan(t), ln(t)) and ends of the
     * domain (sqrt(t) at 0) are not corners. Jumps of second and higher derivatives are found only where something
     * switches: t < 1 ? 0 : (t - 1)^2 has a corner at 1, though value and slope do not jump there.
     */
    double next_corner(double from, double to) const;

    /** Constant, and zero: what acts through this function can be left out. */
    bool is_zero() const;

    bool
    is_constant() const
    {
      return constant;
    }

    /** Text that reads as this function. */
    std::string text() const;

    /** The same as an expression of the variable, which a table is not: piece by piece, behind comparisons. */
    std::string formula_text() const;

    /** The words with which a table begins. */
    static const std::string table_prefix;

  private:
    struct Parts;

    Jet evaluate(double x) const;

    std::shared_ptr<const Parts> parts; ///< null for a number
    bool                         constant = true;
    double                       at_zero; ///< the value there; of a constant, everywhere
  };



  /** What is prescribed in time: a function of t [s]. */
  class FunctionOfTime : public ScalarFunction
  {
  public:
    FunctionOfTime(const double constant = 0)
      : ScalarFunction(constant)
    {}

    explicit FunctionOfTime(const std::string &text)
      : ScalarFunction(text, "t")
    {}
  };



  /** What varies along a body: a function of the coordinate s. */
  class Expression : public ScalarFunction
  {
  public:
    Expression(const double constant = 0)
      : ScalarFunction(constant)
    {}

    explicit Expression(const std::string &text)
      : ScalarFunction(text, "s")
    {}
  };
} // namespace samara

#endif
