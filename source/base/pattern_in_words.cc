#include <samara/base/pattern_in_words.h>
#include <samara/base/text.h>

namespace samara
{
  std::vector<std::string>
  choices_of(const dealii::Patterns::PatternBase &pattern)
  {
    if (dynamic_cast<const dealii::Patterns::Selection *>(&pattern) == nullptr)
      return {};
    const std::string head = "[Selection ", text = pattern.description(dealii::Patterns::PatternBase::Machine);
    if (text.compare(0, head.size(), head) != 0)
      return {}; // Bool is a Selection, too
    return split_top_level(text.substr(head.size(), text.rfind(']') - head.size()), '|');
  }



  namespace
  {
    /** "three", as long as one would write it so. */
    std::string
    count_in_words(const std::string &number)
    {
      const std::string words[] = {"no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine"};
      return number.size() == 1 ? words[number[0] - '0'] : number;
    }

    std::string
    between(const std::string &text, const std::string &begin, const std::string &end)
    {
      const auto first = text.find(begin), last = text.rfind(end);
      return first == std::string::npos || last == std::string::npos ?
               "" :
               text.substr(first + begin.size(), last - first - begin.size());
    }

    /** "a number of at least 0" for "[Double 0...MAX_DOUBLE (inclusive)]", as deal.II tells it to machines. */
    std::string
    described_in_words(const std::string &pattern)
    {
      const auto starts = [&](const std::string &head) { return pattern.compare(0, head.size(), head) == 0; };
      const auto bounds = [](const std::string &range) -> std::pair<std::string, std::string> {
        const auto dots = range.find("...");
        return dots == std::string::npos ? std::make_pair("", "") :
                                           std::make_pair(range.substr(0, dots), range.substr(dots + 3));
      };
      if (starts("[Double") || starts("[Integer"))
        {
          const bool        is_double = starts("[Double");
          const std::string largest   = is_double ? "MAX_DOUBLE" : "2147483647";
          const auto [low, high] =
            bounds(between(pattern, is_double ? "[Double " : "[Integer range ", " (inclusive)]"));
          const bool has_low  = !low.empty() && low != "-MAX_DOUBLE" && low != "-2147483648",
                     has_high = !high.empty() && high != largest;
          return (is_double ? "a number" : "a whole number") + (has_low && has_high ? " from " + low + " to " + high :
                                                                has_low             ? " of at least " + low :
                                                                has_high            ? " of at most " + high :
                                                                                      "");
        }
      if (starts("[List of <"))
        {
          std::string each = described_in_words(between(pattern, "[List of <", "> of length "));
          const auto [low, high] =
            bounds(between(pattern.substr(pattern.rfind("> of length ")), "> of length ", " (inclusive)"));
          if (const auto number = each.find("number"); starts("[List of <[List"))
            each = "lists of " + each;
          else if (number != std::string::npos)
            each = each.insert(number + 6, "s").substr(2); // without "a "
          if (low == "1" && high == "1")
            return described_in_words(between(pattern, "[List of <", "> of length "));
          if (low == high)
            return count_in_words(low) + " " + each;
          if (high != std::to_string(dealii::Patterns::List::max_int_value))
            return count_in_words(low) + " to " + count_in_words(high) + " " + each;
          return (low == "0" ? "" : count_in_words(low) + " or more ") + each;
        }
      return starts("[Bool") ? "true or false" : pattern;
    }
  } // namespace



  std::string
  in_words(const dealii::Patterns::PatternBase &pattern)
  {
    return described_in_words(pattern.description(dealii::Patterns::PatternBase::Machine));
  }
} // namespace samara
