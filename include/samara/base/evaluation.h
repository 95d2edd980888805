#ifndef samara_base_evaluation_h
#define samara_base_evaluation_h

#include <samara/base/formula.h>
#include <samara/base/tokens.h>

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace samara
{
  /** What a word in an expression stands for. `lb`, and what is computed from it, has two readings: mass and force. */
  struct Meaning
  {
    std::array<Quantity, 2> readings;
    bool                    is_unit   = false;
    bool                    is_faulty = false; ///< a constant that could not be read: who uses it throws a FollowUp
    std::string             of_time   = {};    ///< of a function of time with a name: its text in SI units
  };



  /**
   * What words stand for, one layer around the other: units and universal constants, constants of the model, of a
   * subsystem, of one in it. A word is looked up from the innermost layer outwards. Layers are shared by copies of it,
   * of which there may be thousands; one that is changed becomes the copy's own.
   */
  class KnownWords
  {
  public:
    explicit KnownWords(std::map<std::string, Meaning> outermost);

    /** What a word stands for; null if it is not known. */
    const Meaning *find(const std::string &name) const;

    /** The unit of that name, whatever constants hide it; null if there is none. */
    const Meaning *find_unit(const std::string &name) const;

    /** Whether it stands in a layer around the innermost one, but not in the outermost: it may be hidden. */
    bool is_outer(const std::string &name) const;

    /** Let a word stand for something in the innermost layer, which hides what it stands for around it. */
    void set(const std::string &name, const Meaning &meaning);

    /** Begin a layer in the present one. */
    void begin_layer();

    /** All there are, in alphabetical order. */
    std::vector<std::string> names() const;

  private:
    struct Layer
    {
      std::map<std::string, Meaning> words;
      std::shared_ptr<const Layer>   around; ///< null of the outermost
    };
    std::shared_ptr<Layer> innermost;
  };



  /**
   * One expression with units, ready to be evaluated and measured: a Formula whose variables are its words.
   *
   * A constant may have the name of a unit. Then the name is the unit directly behind a number, "3 m", and the constant
   * elsewhere, "P*m", "h/2". What goes on from a unit, "3 N/m*h", or from parentheses by a blank, could be either, and
   * is refused with both readings; "(3 N/m)", with nothing else in its parentheses, is in units.
   */
  class Evaluation
  {
  public:
    /** Faults of @p text are thrown as std::invalid_argument. Variables hide other words. */
    Evaluation(const std::string                      &text,
               const KnownWords                       &words,
               const std::map<std::string, Dimension> &variables = {});

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

    /** Whether @p word, which is no variable, is used. */
    bool uses(const std::string &word) const;

    /** Whether it is a percentage of nothing that has a name: "100 %", "2*50 % rad". */
    bool is_bare_percentage() const;

    /** The text with numbers in place of all words except variables. */
    std::string si_text(unsigned int reading) const;

  private:
    /** A word or a variable. */
    struct Used
    {
      std::string name;
      Meaning     meaning;
      bool        is_variable;
      Dimension   natural; ///< of a variable
    };

    void collect_words(const KnownWords &words, const std::map<std::string, Dimension> &variables);

    const std::string  text; ///< as the user wrote it
    std::vector<Token> tokens;
    std::vector<Used>  used; ///< in the order of the formula's variables
    Formula            formula;
  };
} // namespace samara

#endif
