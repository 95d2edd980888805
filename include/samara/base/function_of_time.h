#ifndef samara_base_function_of_time_h
#define samara_base_function_of_time_h

#include <samara/base/formula.h>

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
   * (see Formula). At a corner of a table the slope is that to the right. Values are copied, nothing is shared.
   */
  class ScalarFunction
  {
  public:
    ScalarFunction(double constant, const std::string &variable);

    /** Throws std::invalid_argument if @p text cannot be read. */
    ScalarFunction(const std::string &text, const std::string &variable);

    double operator()(double x) const;

    double derivative(double x) const;

    double second_derivative(double x) const;

    /** Constant, and zero: what acts through this function can be left out. */
    bool is_zero() const;

    bool is_constant() const;

    /** Text that reads as this function. */
    const std::string &text() const;

    /** The words with which a table begins. */
    static const std::string table_prefix;

  private:
    Jet table_value(double x) const;

    Jet evaluate(double x) const;

    std::string                            source;
    Formula                                formula;
    std::vector<std::pair<double, double>> table; ///< empty if the formula counts
  };



  /** What is prescribed in time: a function of t [s]. */
  class FunctionOfTime : public ScalarFunction
  {
  public:
    FunctionOfTime(const double constant = 0)
      : ScalarFunction(constant, "t")
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
      : ScalarFunction(constant, "s")
    {}

    explicit Expression(const std::string &text)
      : ScalarFunction(text, "s")
    {}
  };
} // namespace samara

#endif
