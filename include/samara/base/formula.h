#ifndef samara_base_formula_h
#define samara_base_formula_h

#include <samara/base/look_up.h>

#include <string>
#include <vector>

namespace samara
{
  /**
   * An expression of one or several variables, compiled, and differentiated exactly while it is evaluated.
   *
   * Differences would make noise of the accelerations of a prescribed motion, and nonsense of them at a switch such as
   * "t < 1 ? 0 : t - 1". The language is that of muParser, which knows neither derivatives nor dimensions: + - * / ^,
   * comparisons, && ||, ?:, and functions; and saturate(x, lo, hi), deadband(x, width), and table("file.csv", x), see
   * LookUp.
   *
   * The program is a list of instructions for a stack, with jumps around the branch of ?: that is not taken. Evaluation
   * allocates nothing and may be done by several threads at once.
   */
  class Formula
  {
  public:
    explicit Formula(double constant = 0);

    /** Throws std::invalid_argument if @p text is not an expression of these variables. */
    Formula(const std::string &text, const std::vector<std::string> &variables);

    /** The same of one variable, of which one may ask for corners, too. */
    Formula(const std::string &text, const std::string &variable)
      : Formula(text, std::vector<std::string>(1, variable))
    {}

    Jet
    operator()(const double x) const
    {
      return at(&x, 0);
    }

    /** With its derivatives by variable @p i. */
    Jet at(const double *variables, unsigned int i) const;

    struct Dimensions
    {
      Dimension result        = {{0, 0, 0, 0, 0}};
      bool      is_consistent = true; ///< nothing is added to, or compared with, what has another dimension
    };

    /**
     * The dimension of the result for variables of the given ones, from all branches of ?:. Angles are numbers: where
     * one meets a number, none is left. A zero that does not depend on @p free variables has any dimension, and a
     * number may be compared with anything.
     *
     * @param values of the variables, which matter where one is a power
     */
    Dimensions dimensions(const std::vector<double>    &values,
                          const std::vector<Dimension> &of_variables,
                          const std::vector<bool>      &free) const;

    /** Whether no variable occurs. */
    bool is_constant() const;

    /** Whether the variable occurs. */
    bool uses(unsigned int i) const;

    /** Whether there is anything that switches, as a comparison does. */
    bool
    switches() const
    {
      return has_pieces;
    }

    /** On which of its pieces each operation is that is done there: equal where nothing has switched in between. */
    void pieces(const double *variables, std::vector<double> &result) const;

    /** The parts of the formula that switch and depend on the first variable alone, as formulas of it. */
    std::vector<Formula> switches_of_first_variable() const;

    /**
     * The first x in [from, to] where a comparison changes sides, the argument of abs() or sign() its sign, min() or
     * max() its choice, floor(), ceil() or rint() its value, atan2() its half plane, all only where they count (not in
     * a branch of ?: that is not taken); infinity if there is none. See ScalarFunction::next_corner().
     *
     * Costs next to nothing far from a switch if what is compared is linear in x, also by parts, as in t < 1 or
     * min(1, max(0, t/2)): the places were computed with the program.
     */
    double next_corner(double from, double to) const;

  private:
    /**
     * Push a number, push the variable, replace the last arguments on the stack by the result of an operation, or skip
     * some of the instructions that follow, always or if the number on the top, which is taken away, is zero.
     */
    struct Instruction
    {
      enum Kind
      {
        number,
        variable,
        operation,
        look_up,
        skip,
        skip_if_zero
      };
      Kind                kind;
      double              value       = 0;
      const JetOperation *op          = nullptr;
      unsigned int        n_arguments = 0;
      unsigned int        n_skipped   = 0;
      unsigned int        index       = 0; ///< of the variable

      std::shared_ptr<const LookUp> table = nullptr;

      /** Of an operation or a table. */
      Jet
      result(const Jet *arguments) const
      {
        return table ? (*table)(arguments) : op->apply(arguments, n_arguments);
      }
      bool
      has_pieces() const
      {
        return table || (op != nullptr && op->piece != nullptr);
      }
      double
      piece_at(const Jet *arguments) const
      {
        return table ? table->piece(arguments) : op->piece(arguments, n_arguments);
      }
    };

    class Compiler;

    /** Deep enough for any expression somebody writes; longer ones are refused. */
    static constexpr unsigned int stack_size = 64;

    /** Run the program; @p visit is told of each operation, with its arguments, before it is done. */
    template <typename Visit>
    Jet run(const double *variables, unsigned int i, const Visit &visit) const;

    /** Fill in what follows about the program, without running it. */
    void find_switches();

    struct Interval
    {
      double begin, end;
    };

    std::vector<Instruction> program;
    bool                     has_pieces   = false;
    bool                     places_known = false; ///< nothing switches outside of these places
    std::vector<Interval>    places; ///< where something may switch, as narrow as round-off allows, by their ends
  };
} // namespace samara

#endif
