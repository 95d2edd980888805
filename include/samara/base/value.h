#ifndef samara_base_value_h
#define samara_base_value_h

#include <samara/base/function_of_time.h>
#include <samara/base/quantity.h>
#include <samara/base/text.h>

#include <deal.II/base/patterns.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace samara
{
  /**
   * How a variable of type T is written in a .prm file.
   *
   * - read() makes the value from what the user wrote, in the declared unit; throws std::invalid_argument.
   * - write() gives text that reads as this value, in SI units. This is what patterns are matched with and what is
   *   printed.
   * - pattern() is what must hold if nobody says more.
   * - separator is what stands between several of them.
   * - has_unit says whether a unit can be declared for it.
   */
  template <typename T>
  struct Value;

  using PatternPointer = std::unique_ptr<dealii::Patterns::PatternBase>;

  /**
   * The elements of a list, with a unit given for all of them handed to each: "(1, 2, 3) ft" becomes "(1) ft", ... A
   * list where some non-zero numbers have a unit and others have none is refused: "1, 2, 3 ft" was hardly meant so.
   */
  std::vector<std::string> elements_of_list(const std::string &text, char separator);

  void check_units_of_list(const std::vector<std::string> &elements, const Quantities &quantities);

  /** A list of something; just anything if the elements are anything, for dealii::Patterns::List splits atan2(1, 2). */
  PatternPointer pattern_of_list(const dealii::Patterns::PatternBase &element,
                                 unsigned int                         min_elements,
                                 unsigned int                         max_elements,
                                 char                                 separator);



  template <>
  struct Value<double>
  {
    static constexpr char separator = ',';
    static constexpr bool has_unit  = true;

    static double read(const std::string &text, const std::string &unit, const Quantities &quantities);

    static std::string write(double value);

    static PatternPointer pattern();
  };



  template <>
  struct Value<int>
  {
    static constexpr char separator = ',';
    static constexpr bool has_unit  = true;

    static int read(const std::string &text, const std::string &unit, const Quantities &quantities);

    static std::string write(int value);

    static PatternPointer pattern();
  };



  template <>
  struct Value<unsigned int>
  {
    static constexpr char separator = ',';
    static constexpr bool has_unit  = true;

    static unsigned int read(const std::string &text, const std::string &unit, const Quantities &quantities);

    static std::string write(unsigned int value);

    static PatternPointer pattern();
  };



  /** true or yes, false or no. */
  template <>
  struct Value<bool>
  {
    static constexpr char separator = ',';
    static constexpr bool has_unit  = false;

    static bool read(const std::string &text, const std::string &unit, const Quantities &quantities);

    static std::string write(bool value);

    static PatternPointer pattern();
  };



  template <>
  struct Value<std::string>
  {
    static constexpr char separator = ',';
    static constexpr bool has_unit  = false;

    static std::string read(const std::string &text, const std::string &unit, const Quantities &quantities);

    static std::string write(const std::string &value);

    static PatternPointer pattern();
  };



  /** Three numbers: "1, 0, 0" or "(1, 0, 0) ft". */
  template <>
  struct Value<Eigen::Vector3d>
  {
    static constexpr char separator = ';';
    static constexpr bool has_unit  = true;

    static Eigen::Vector3d read(const std::string &text, const std::string &unit, const Quantities &quantities);

    static std::string write(const Eigen::Vector3d &value);

    static PatternPointer pattern();
  };



  template <>
  struct Value<FunctionOfTime>
  {
    static constexpr char separator = ',';
    static constexpr bool has_unit  = true;

    static FunctionOfTime read(const std::string &text, const std::string &unit, const Quantities &quantities);

    static std::string write(const FunctionOfTime &value);

    static PatternPointer pattern();
  };



  template <>
  struct Value<Law>
  {
    static constexpr char separator = ',';
    static constexpr bool has_unit  = true;

    static Law read(const std::string &text, const std::string &unit, const Quantities &quantities);

    static std::string write(const Law &value);

    static PatternPointer pattern();
  };



  template <>
  struct Value<Expression>
  {
    static constexpr char separator = ',';
    static constexpr bool has_unit  = true;

    static Expression read(const std::string &text, const std::string &unit, const Quantities &quantities);

    static std::string write(const Expression &value);

    static PatternPointer pattern();
  };



  /** Any number of values; none if the text is empty. */
  template <typename T>
  struct Value<std::vector<T>>
  {
    static constexpr char separator = ';';
    static constexpr bool has_unit  = Value<T>::has_unit;

    static std::vector<T>
    read(const std::string &text, const std::string &unit, const Quantities &quantities)
    {
      const auto elements = elements_of_list(text, Value<T>::separator);
      if (std::is_same<T, double>::value)
        check_units_of_list(elements, quantities);
      std::vector<T> values;
      for (const auto &element : elements)
        if (element.empty())
          throw std::invalid_argument("<" + text + ">: an element of the list is missing.");
        else
          values.push_back(Value<T>::read(element, unit, quantities));
      return values;
    }

    static std::string
    write(const std::vector<T> &values)
    {
      std::vector<std::string> texts;
      for (const auto &value : values)
        texts.push_back(Value<T>::write(value));
      return join(texts, std::string(1, Value<T>::separator) + " ");
    }

    static PatternPointer
    pattern()
    {
      return pattern_of_list(*Value<T>::pattern(), 0, dealii::Patterns::List::max_int_value, Value<T>::separator);
    }
  };



  /** Exactly @p n values. */
  template <typename T, std::size_t n>
  struct Value<std::array<T, n>>
  {
    static constexpr char separator = ';';
    static constexpr bool has_unit  = Value<T>::has_unit;

    static std::array<T, n>
    read(const std::string &text, const std::string &unit, const Quantities &quantities)
    {
      const auto values = Value<std::vector<T>>::read(text, unit, quantities);
      if (values.size() != n)
        throw std::invalid_argument("<" + text + ">: " + std::to_string(n) + " values are wanted, not " +
                                    std::to_string(values.size()) + ".");
      std::array<T, n> array;
      std::copy(values.begin(), values.end(), array.begin());
      return array;
    }

    static std::string
    write(const std::array<T, n> &values)
    {
      return Value<std::vector<T>>::write(std::vector<T>(values.begin(), values.end()));
    }

    static PatternPointer
    pattern()
    {
      return pattern_of_list(*Value<T>::pattern(), n, n, Value<T>::separator);
    }
  };
} // namespace samara

#endif
