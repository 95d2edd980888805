#include <samara/base/number_in_file.h>
#include <samara/base/value.h>

#include <cmath>
#include <limits>

namespace samara
{
  namespace
  {
    namespace Patterns = dealii::Patterns;

    template <typename Integer>
    Integer
    whole_number(const std::string &text, const std::string &unit, const Quantities &quantities)
    {
      const double number = quantities.number(text, unit);
      if (number != std::round(number))
        throw std::invalid_argument("<" + text + "> is not a whole number.");
      if (number < std::numeric_limits<Integer>::min() || number > std::numeric_limits<Integer>::max())
        throw std::invalid_argument("<" + text + "> is not a number from " +
                                    std::to_string(std::numeric_limits<Integer>::min()) + " to " +
                                    std::to_string(std::numeric_limits<Integer>::max()) + ".");
      return static_cast<Integer>(number);
    }

    /** The position of the parenthesis that closes the one at the beginning. */
    std::size_t
    closing_parenthesis(const std::string &text)
    {
      int depth = 0;
      for (std::size_t i = 0; i < text.size(); ++i)
        {
          depth += (text[i] == '(') - (text[i] == ')');
          if (depth == 0)
            return i;
        }
      return std::string::npos;
    }
  } // namespace



  std::vector<std::string>
  elements_of_list(const std::string &text, const char separator)
  {
    auto elements = split_top_level(text, separator);
    if (elements.size() != 1 || elements[0].empty() || elements[0][0] != '(')
      return elements;

    // All in parentheses? Then what follows them is for each element.
    const std::string &all   = elements[0];
    const auto         close = closing_parenthesis(all);
    if (close == std::string::npos)
      return elements;
    const std::string inner = all.substr(1, close - 1);
    const std::string unit  = all.substr(close + 1);
    const auto        parts = split_top_level(inner, separator);
    if (parts.size() < 2)
      return elements;
    elements.clear();
    for (const auto &part : parts)
      elements.push_back("(" + part + ")" + unit);
    return elements;
  }



  void
  check_units_of_list(const std::vector<std::string> &elements, const Quantities &quantities)
  {
    bool any_with = false, any_without = false;
    for (const auto &element : elements)
      {
        double     plain    = 0;
        const bool is_plain = text_to_number(element, plain);
        any_with            = any_with || (!is_plain && quantities.names_a_unit(element));
        any_without         = any_without || (is_plain && plain != 0);
      }
    if (any_with && any_without)
      throw std::invalid_argument("<" + join(elements, ", ") +
                                  ">: some numbers have a unit and some have none; for one unit, write <(a, b) unit>.");
  }



  PatternPointer
  pattern_of_list(const dealii::Patterns::PatternBase &element,
                  const unsigned int                   min_elements,
                  const unsigned int                   max_elements,
                  const char                           separator)
  {
    if (dynamic_cast<const Patterns::Anything *>(&element) != nullptr)
      return element.clone();
    return std::make_unique<Patterns::List>(element, min_elements, max_elements, std::string(1, separator));
  }



  namespace
  {
    /** Whether @p text names what a model does. */
    bool
    names_signals(const std::string &text, const Quantities &quantities)
    {
      try
        {
          return !quantities.signals.find(text).empty();
        }
      catch (const std::invalid_argument &)
        {
          return false;
        }
    }

    double
    constant_number(const std::string &text, const std::string &unit, const Quantities &quantities)
    {
      try
        {
          return quantities.number(text, unit);
        }
      catch (const std::invalid_argument &)
        {
          if (names_signals(text, quantities))
            throw std::invalid_argument(
              "<" + text +
              ">: this number must not change. What depends on the motion is a <Force> or <Moment>, in place of a damper, "
              "say, or a <Spring force> or <Spring moment>, whose energy is kept.");
          throw;
        }
    }
  } // namespace



  double
  Value<double>::read(const std::string &text, const std::string &unit, const Quantities &quantities)
  {
    constexpr double most   = largest_number;
    const double     number = constant_number(text, unit, quantities);
    if (std::abs(number) > most || (number != 0 && std::abs(number) < 1 / most))
      throw std::invalid_argument("<" + text + "> is too " + (std::abs(number) > most ? "large" : "small") +
                                  " to compute with: sizes lie between 1e-100 and 1e100 in SI units, or are 0.");
    return number;
  }



  std::string
  Value<double>::write(const double value)
  {
    return number_to_text(value);
  }



  PatternPointer
  Value<double>::pattern()
  {
    return std::make_unique<Patterns::Double>();
  }



  int
  Value<int>::read(const std::string &text, const std::string &unit, const Quantities &quantities)
  {
    return whole_number<int>(text, unit, quantities);
  }



  std::string
  Value<int>::write(const int value)
  {
    return std::to_string(value);
  }



  PatternPointer
  Value<int>::pattern()
  {
    return std::make_unique<Patterns::Integer>();
  }



  unsigned int
  Value<unsigned int>::read(const std::string &text, const std::string &unit, const Quantities &quantities)
  {
    return whole_number<unsigned int>(text, unit, quantities);
  }



  std::string
  Value<unsigned int>::write(const unsigned int value)
  {
    return std::to_string(value);
  }



  PatternPointer
  Value<unsigned int>::pattern()
  {
    return std::make_unique<Patterns::Integer>(0);
  }



  bool
  Value<bool>::read(const std::string &text, const std::string &, const Quantities &quantities)
  {
    if (text == "true" || text == "yes")
      return true;
    if (text == "false" || text == "no")
      return false;
    double number = 0;
    try
      {
        number = text_to_number(text, number) ? number : quantities.number(text, "1");
      }
    catch (const FollowUp &)
      {
        throw;
      }
    catch (const std::invalid_argument &)
      {
        throw std::invalid_argument("<" + text + "> is neither true nor false.");
      }
    if (number != 0 && number != 1)
      throw std::invalid_argument("<" + text + "> is neither true nor false.");
    return number == 1;
  }



  std::string
  Value<bool>::write(const bool value)
  {
    return value ? "true" : "false";
  }



  PatternPointer
  Value<bool>::pattern()
  {
    return std::make_unique<Patterns::Bool>();
  }



  std::string
  Value<std::string>::read(const std::string &text, const std::string &, const Quantities &)
  {
    return text;
  }



  std::string
  Value<std::string>::write(const std::string &value)
  {
    return value;
  }



  PatternPointer
  Value<std::string>::pattern()
  {
    return std::make_unique<Patterns::Anything>();
  }



  Eigen::Vector3d
  Value<Eigen::Vector3d>::read(const std::string &text, const std::string &unit, const Quantities &quantities)
  {
    const auto x = Value<std::array<double, 3>>::read(text, unit, quantities);
    return {x[0], x[1], x[2]};
  }



  std::string
  Value<Eigen::Vector3d>::write(const Eigen::Vector3d &value)
  {
    return Value<std::array<double, 3>>::write({{value[0], value[1], value[2]}});
  }



  PatternPointer
  Value<Eigen::Vector3d>::pattern()
  {
    return Value<std::array<double, 3>>::pattern();
  }



  FunctionOfTime
  Value<FunctionOfTime>::read(const std::string &text, const std::string &unit, const Quantities &quantities)
  {
    return FunctionOfTime(quantities.expression(text, unit, {"t"}));
  }



  std::string
  Value<FunctionOfTime>::write(const FunctionOfTime &value)
  {
    return value.text();
  }



  PatternPointer
  Value<FunctionOfTime>::pattern()
  {
    return std::make_unique<Patterns::Anything>();
  }



  Law
  Value<Law>::read(const std::string &text, const std::string &unit, const Quantities &quantities)
  {
    return quantities.law(text, unit);
  }



  std::string
  Value<Law>::write(const Law &value)
  {
    return value.text();
  }



  PatternPointer
  Value<Law>::pattern()
  {
    return std::make_unique<Patterns::Anything>();
  }



  Expression
  Value<Expression>::read(const std::string &text, const std::string &unit, const Quantities &quantities)
  {
    return Expression(quantities.expression(text, unit, {"s"}));
  }



  std::string
  Value<Expression>::write(const Expression &value)
  {
    return value.text();
  }



  PatternPointer
  Value<Expression>::pattern()
  {
    return std::make_unique<Patterns::Anything>();
  }
} // namespace samara
