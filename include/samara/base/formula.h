#ifndef samara_base_formula_h
#define samara_base_formula_h

#include <samara/base/jet.h>

#include <string>
#include <vector>

namespace samara
{
  /**
   * An expression of one variable, compiled, and differentiated exactly while it is evaluated.
   *
   * muParser, which reads all other numbers (see Quantities), evaluates but cannot differentiate; differences would
   * make noise of the accelerations of a prescribed motion, and nonsense of them at a switch such as "t < 1 ? 0 : t -
   * 1". The language is that of muParser: + - * / ^, comparisons, && ||, ?:, and functions.
   *
   * The program is a list of instructions for a stack. Both branches of ?: are evaluated and one is taken. Evaluation
   * allocates nothing and may be done by several threads at once.
   */
  class Formula
  {
  public:
    explicit Formula(double constant = 0);

    /** Throws std::invalid_argument if @p text is not an expression of @p variable. */
    Formula(const std::string &text, const std::string &variable);

    Jet operator()(double x) const;

    /** Whether the variable does not occur. */
    bool is_constant() const;

  private:
    /** Push a number, push the variable, or replace the last arguments on the stack by the result of an operation. */
    struct Instruction
    {
      enum Kind
      {
        number,
        variable,
        operation
      };
      Kind                   kind;
      double                 value       = 0;
      JetOperation::Function apply       = nullptr;
      unsigned int           n_arguments = 0;
    };

    class Compiler;

    /** Deep enough for any expression somebody writes; longer ones are refused. */
    static constexpr unsigned int stack_size = 64;

    std::vector<Instruction> program;
  };
} // namespace samara

#endif
