#ifndef samara_base_law_h
#define samara_base_law_h

#include <samara/base/function_of_time.h>
#include <samara/base/placement.h>

#include <Eigen/Dense>

#include <array>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace samara
{
  class Quantities;

  /**
   * A number that depends on time and on signals of the model, as users write it:
   *
   *     -200 N * tanh(slider.displacement rate / 0.01 m/s)
   *
   * A signal is what an object of the model tells of itself, "slider.displacement rate", or a state of first order,
   * "filter". A law without signals is a function of time. Numbers are in SI units; angles in rad.
   *
   * Copies share what was read: models have many laws, and most of them are zero.
   */
  class Law
  {
  public:
    Law(double constant = 0);

    explicit Law(const FunctionOfTime &function);

    /**
     * @p text in SI units with a word for each of the @p signals in place of its path, see Law::word().
     * @throws std::invalid_argument if it cannot be read
     */
    Law(const std::string &text, const std::vector<std::string> &signals);

    /** What words of signals begin with; users do not write it. */
    static const std::string reserved;

    /** The word that stands for signal @p i. */
    static std::string
    word(const unsigned int i)
    {
      return reserved + std::to_string(i);
    }

    /** @p text with the paths in place of these words. */
    static std::string with_paths(std::string text, const std::vector<std::string> &paths);

    /** The paths of the signals it depends on; none for a function of time. */
    const std::vector<std::string> &
    signals() const
    {
      return parts->paths;
    }

    bool
    depends_on_state() const
    {
      return !parts->paths.empty();
    }

    /** For a law without signals. */
    const FunctionOfTime &of_time() const;

    /** For a law of one signal. @throws std::invalid_argument if it depends on time or on another signal, too */
    ScalarFunction of_signal() const;

    /** Its value where the variables are time and then the signals. */
    double
    value(const double *variables) const
    {
      return parts->formula.at(variables, 0).value;
    }

    /** Its derivative by variable @p i: 0 time, 1 the first signal. */
    double
    derivative(const double *variables, const unsigned int i) const
    {
      return parts->formula.at(variables, i).first;
    }

    /** On which of its pieces each operation is that has some, see Formula. */
    void
    pieces(const double *variables, std::vector<double> &result) const
    {
      parts->formula.pieces(variables, result);
    }

    bool
    has_pieces() const
    {
      return parts->formula.switches();
    }

    /** Whether it acts at all. */
    bool
    is_zero() const
    {
      return parts->paths.empty() && parts->time_function.is_zero();
    }

    bool
    is_constant() const
    {
      return parts->paths.empty() && parts->time_function.is_constant();
    }

    /**
     * The next corner in time, see ScalarFunction::next_corner(); of a law with signals where something switches that
     * depends on time alone.
     */
    double next_corner(double from, double to) const;

    /** The product of this law and a signal. */
    Law times(const std::string &path) const;

    /** Σ cⱼ lawsⱼ + offset, in SI units. */
    static Law combination(const std::array<Law, 3> &laws, const Eigen::RowVector3d &c, double offset);

    /** Text in SI units that reads as this law. */
    const std::string &text() const;

  private:
    struct Parts
    {
      FunctionOfTime              time_function;
      Formula                     formula;
      std::string                 words, source; ///< the text with words for the signals, and with their paths
      std::vector<std::string>    paths;
      std::vector<ScalarFunction> switches_of_time; ///< parts of the formula
    };
    std::shared_ptr<const Parts> parts;
  };



  /**
   * What may be named in laws: the objects of a model, whose signals are known by the words they end with, and the
   * states of first order with their units. In a subsystem, its objects and states have short names, too, and
   * components x, y, z are those along its axes.
   */
  class SignalNames
  {
  public:
    SignalNames() = default;

    /** Those of @p around, which many subsystems share, and short names to be added. */
    explicit SignalNames(std::shared_ptr<const SignalNames> around);

    void add_object(const std::string &name);
    void add_state(const std::string &name, const std::string &unit);

    /** Let @p short_name stand for the object, or the state, of that full name, which has been added before. */
    void add_short_object(const std::string &short_name, const std::string &name);
    void add_short_state(const std::string &short_name, const std::string &name);

    /** Where the group of objects stands whose laws are read. */
    Placement placement;

    /** The unit of a state; empty: it is a number. */
    std::string unit_of_state(const std::string &name) const;

    /** A signal in a text: where it stands, its full path with single blanks, and its SI unit. */
    struct Found
    {
      std::size_t begin, end;
      std::string path, unit;
    };

    /** The signal of an @p object that is named at @p begin, what it is of it after @p after_object. */
    static Found
    signal_of_object(const std::string &text, std::size_t begin, const std::string &object, std::size_t after_object);

    /** All signals in @p text. @throws std::invalid_argument if an object is named whose signal is not known */
    std::vector<Found> find(const std::string &text) const;

    /** The unit of a quantity, "displacement rate": "m/s". Empty if it is not known. */
    static std::string unit_of(const std::string &quantity);

    /** All quantities that signals may be. */
    static std::vector<std::string> known_quantities();

  private:
    struct State
    {
      std::string name, unit;
    };
    /** The full name of what is called so, and the state; null if there is none. */
    const std::string *object_called(const std::string &name) const;
    const State       *state_called(const std::string &name) const;

    std::shared_ptr<const SignalNames>           around;      ///< null: nothing is shared
    std::unordered_map<std::string, std::string> objects;     ///< full names, by what they are called
    std::unordered_map<std::string, State>       states;      ///< the same
    std::vector<std::string>                     long_states; ///< names that are more than one word
    std::size_t                                  longest = 0; ///< of what objects are called
  };
} // namespace samara

#endif
