#ifndef samara_base_jet_h
#define samara_base_jet_h

#include <string>
#include <vector>

namespace samara
{
  /** A value with its first and second derivative. */
  struct Jet
  {
    double value  = 0;
    double first  = 0;
    double second = 0;
  };



  /** What an operation asks of the dimensions of its arguments, and the dimension of its result. */
  enum class DimensionRule
  {
    numbers,    ///< numbers, or angles; a number: sin()
    alike,      ///< all the same, and that of the result: +
    ratio,      ///< all the same; a number: atan2()
    comparison, ///< all the same, or one of them a number; a number: <
    any,        ///< whatever it is; a number: sign()
    product,    ///< *
    quotient,   ///< /
    power,      ///< ^
    square_root ///< half of it
  };



  /** A function or operator that may stand in a Formula: computes a jet from the jets of its arguments. */
  struct JetOperation
  {
    using Function = Jet (*)(const Jet *arguments, unsigned int n_arguments);

    /** Numbers the pieces of a function that has jumps or corners between them: abs() has one on each side of 0. */
    using Piece = double (*)(const Jet *arguments, unsigned int n_arguments);

    std::string   name;
    unsigned int  min_arguments;
    unsigned int  max_arguments;
    Function      apply;
    unsigned int  precedence = 0;       ///< of a binary operator; the larger binds closer
    Piece         piece      = nullptr; ///< null: smooth wherever it is finite
    DimensionRule rule       = DimensionRule::numbers;
  };

  /** sin(), max(), ... Names and meanings are those of muParser where it has them, which a test compares. */
  const std::vector<JetOperation> &jet_functions();

  /** The binary operators + - * / ^ < <= > >= == != && || with the precedence they have in muParser. */
  const std::vector<JetOperation> &jet_operators();

  /** -x, called "negative" */
  const JetOperation &jet_negative();
} // namespace samara

#endif
