#ifndef samara_base_quantity_h
#define samara_base_quantity_h

#include <samara/base/errors.h>
#include <samara/base/evaluation.h>
#include <samara/base/law.h>

#include <map>
#include <string>
#include <vector>

namespace samara
{
  /**
   * Reads numbers as people write them: with units ("6.0 ft", "1e6 lb*ft^2", "45 deg"), with named constants, and as
   * expressions of both ("2*L + 3 in"). All results are in SI units.
   *
   * - White space multiplies: "6 ft" is 6*ft, and "(1 - cos(t)) N" is (1 - cos(t))*N. It binds like `*`, so that
   *   "1/2 m" is half a metre.
   * - What is a pure number when evaluated is taken to be in the declared unit.
   * - Zero is zero in every unit.
   * - An angle is a number: N*m/rad is N*m. But deg, rev and rpm convert to rad and rad/s, and to give Hz for rad/s or
   *   rpm for Hz is refused, because nobody can tell whether a factor of 2 pi is meant.
   * - A constant may have the name of a unit, see Evaluation.
   * - `lb` is a mass. If that contradicts the declared unit and a force agrees with it, it is a force.
   *
   * How dimensions are found is told at Formula::dimensions().
   *
   * Faults of the text are thrown as std::invalid_argument with a message for the user, without a place.
   */
  class Quantities
  {
  public:
    /** Knows the units, and the constants pi, e and g0. */
    Quantities();

    /** Define a constant. It may use units and constants defined before and keeps its dimension. */
    void
    add_constant(const std::string &name, const std::string &text, const std::string &where, Complaints &complaints);

    /** The same where @p text is read as @p reader understands it. */
    void add_constant(const std::string &name,
                      const std::string &text,
                      const std::string &where,
                      const Quantities  &reader,
                      Complaints        &complaints);

    /**
     * Define a function of time, which stands wherever t may stand, in the dimension that it has. It may use constants
     * and functions defined before.
     */
    void
    add_function(const std::string &name, const std::string &text, const std::string &where, Complaints &complaints);

    /**
     * Texts that stand in place of "${name}", of constants that are texts in quotes and of arguments of parts. Those of
     * a subsystem hide those around it.
     */
    std::map<std::string, std::string> texts;

    /**
     * @p text with these texts, and with values of constants in SI units, in place of each "${name}".
     * @throws std::invalid_argument saying what there is, FollowUp if the constant is faulty
     */
    std::string with_texts(const std::string &text) const;

    /** From now on constants may have the names of those that there are, and then hide them: a subsystem begins. */
    void begin_subsystem();

    /** The value of @p text in SI, which must have the dimension of @p unit; "" for @p unit accepts any dimension. */
    double number(const std::string &text, const std::string &unit) const;

    /**
     * @p text in which all units and constants are replaced by their values in SI; functions and @p variables remain. A
     * variable hides a unit of that name: with the variable s, 3 N*s is no momentum. "table: x1 y1; x2 y2; ..." is
     * converted number by number; write "x1, y1" if the numbers have units or are expressions.
     *
     * The dimension is checked as far as it is certain. A variable may count as a pure number or be in its natural
     * unit (t in seconds, s in metres): "3 m/s * t" and "3 m * t" are both lengths.
     */
    std::string
    expression(const std::string &text, const std::string &unit, const std::vector<std::string> &variables) const;

    /**
     * A law of time and of signals. Signals are in their units, t is in seconds; each may count as a pure number, too.
     * Where the dimensions do not fit otherwise, a number and the unit behind it are one: "v / 0.01 m/s" is v/(0.01
     * m/s).
     */
    Law law(const std::string &text, const std::string &unit) const;

    /** The same of signals that somebody else has @p found in @p text, in the axes in which they are. */
    Law law_of(const std::string &text, const std::vector<SignalNames::Found> &found, const std::string &unit) const;

    /** Why no state, and no function, can be called @p name; "" if one can. */
    std::string fault_of_state(const std::string &name) const;

    /** What laws may name. */
    SignalNames signals;

    /** Whether @p text contains the name of a unit. */
    bool names_a_unit(const std::string &text) const;

    /** A product of units, "kN*m". @throws std::invalid_argument if it is none */
    static Quantity unit(const std::string &text);

    /** Whether @p text is a product of SI units, which a bare number can be in. For checks of declared units. */
    static bool is_si_unit(const std::string &text);

    /** All that may stand in an expression: units, constants, functions. */
    std::vector<std::string> known_words() const;

  private:
    /** Why nothing can be called @p name; "" if it can. */
    std::string fault_of_name(const std::string &name) const;

    Law law_of(const std::string                     &text,
               const std::vector<SignalNames::Found> &found,
               const std::string                     &unit,
               const Placement                       &placement) const;

    std::string
    expression_of_table(const std::string &rows, const std::string &unit, const std::string &variable) const;

    KnownWords words;
  };
} // namespace samara

#endif
