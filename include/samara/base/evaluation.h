#ifndef samara_base_evaluation_h
#define samara_base_evaluation_h

#include <samara/base/tokens.h>
#include <samara/base/units.h>

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace mu
{
  class Parser;
}

namespace samara
{
  /** What a word in an expression stands for. `lb`, and what is computed from it, has two readings: mass and force. */
  struct Meaning
  {
    std::array<Quantity, 2> readings;
    bool                    is_unit   = false;
    bool                    is_faulty = false; ///< a constant that could not be read: who uses it throws a FollowUp
    bool                    is_outer  = false; ///< a constant outside of the subsystem, where another may have its name
  };



  /**
   * One expression with units, ready to be evaluated and measured by muParser.
   *
   * The dimension is found by evaluating with rescaled base units: if metres count double and the result becomes four
   * times itself, it is an area; if the factors for twice and eight times are not powers that agree, lengths were added
   * to something else. Powers of two scale without any rounding, so that the finding does not depend on the numbers.
   *
   * Functions that choose among their arguments, min(), max(), saturate(), deadband(), would hide what they do not
   * choose. They are measured as sums of their arguments with some factors, and tables as functions that are no power
   * of theirs: such numbers have dimensions, but values of their own (has_stand_ins()).
   */
  class Evaluation
  {
  public:
    /** Faults of @p text are thrown as std::invalid_argument. Variables hide other words. */
    Evaluation(const std::string                      &text,
               const std::map<std::string, Meaning>   &words,
               const std::map<std::string, Dimension> &variables = {});

    ~Evaluation();

    struct Measure
    {
      double    value = 0; ///< in SI units; of an expression with variables, at some point
      Dimension dimension{{0, 0, 0, 0, 0}};
      bool      is_consistent = true; ///< the dimension is meaningful
    };

    /**
     * Evaluate and measure. With @p natural_units, variables have the dimensions given for them, with @p natural_time t
     * has; otherwise they are pure numbers.
     */
    Measure measure(unsigned int reading, bool natural_units = false, bool natural_time = false) const;

    /** Whether the two readings may differ. */
    bool is_ambiguous() const;

    bool has_variables() const;

    bool has_units() const;

    /** Whether what is measured has another value than the text: that of a Formula of si_text() is the right one. */
    bool has_stand_ins() const;

    /** Whether @p word, which is no variable, is used. */
    bool uses(const std::string &word) const;

    /** The text with numbers in place of all words except variables. */
    std::string si_text(unsigned int reading) const;

  private:
    /** A word, or a variable, and the number that muParser sees. */
    struct Used
    {
      std::string name;
      Meaning     meaning;
      bool        is_variable;
      Dimension   natural; ///< of a variable
      double      seen = 0;
    };

    /** Append the tokens from @p begin to @p end to what is measured. */
    void replace_tables(std::size_t begin, std::size_t end);

    /** A word for a unit of a table. */
    Token word_of_table(const Dimension &unit);

    void collect_words(const std::map<std::string, Meaning> &words, const std::map<std::string, Dimension> &variables);

    void prepare_parser();

    /** Which variables have their dimensions. */
    struct Natural
    {
      bool units, time;
    };
    double value(unsigned int reading, Natural natural, double variable, unsigned int base, double scale) const;

    const std::string              text;
    std::vector<Token>             tokens;
    std::vector<Token>             measured;        ///< the same without tables
    std::map<std::string, Meaning> units_of_tables; ///< by words that stand in what is measured
    mutable std::vector<Used>      used;            ///< muParser points into it
    std::unique_ptr<mu::Parser>    parser;
  };
} // namespace samara

#endif
