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



  /** A function or operator that may stand in a Formula: computes a jet from the jets of its arguments. */
  struct JetOperation
  {
    using Function = Jet (*)(const Jet *arguments, unsigned int n_arguments);

    /** Numbers the pieces of a function that has jumps or corners between them: abs() has one on each side of 0. */
    using Piece = double (*)(const Jet *arguments, unsigned int n_arguments);

    std::string  name;
    unsigned int min_arguments;
    unsigned int max_arguments;
    Function     apply;
    unsigned int precedence = 0;       ///< of a binary operator; the larger binds closer
    Piece        piece      = nullptr; ///< null: smooth wherever it is finite
  };

  /** sin(), max(), ... The names and meanings are those of muParser. */
  const std::vector<JetOperation> &jet_functions();

  /** The binary operators + - * / ^ < <= > >= == != && || with the precedence they have in muParser. */
  const std::vector<JetOperation> &jet_operators();

  /** -x */
  Jet jet_negative(const Jet *arguments, unsigned int);
} // namespace samara

#endif
