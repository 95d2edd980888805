#include <samara/base/errors.h>
#include <samara/base/evaluation.h>
#include <samara/base/text.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace samara
{
  Evaluation::Evaluation(const std::string                      &text,
                         const std::map<std::string, Meaning>   &words,
                         const std::map<std::string, Dimension> &variables)
    : text(text)
    , tokens(tokens_of(text))
  {
    collect_words(words, variables);
    std::vector<std::string> names;
    for (const auto &u : used)
      names.push_back(u.name);
    formula = Formula(text, names);
  }



  void
  Evaluation::collect_words(const std::map<std::string, Meaning>   &words,
                            const std::map<std::string, Dimension> &variables)
  {
    for (const auto &token : tokens)
      {
        const bool is_known =
          std::any_of(used.begin(), used.end(), [&](const Used &u) { return u.name == token.text; });
        if (token.kind != Token::word || is_known || token.text == "cubic" || token.text == "linear") // kinds of tables
          continue;

        const auto word = words.find(token.text);
        if (const auto variable = variables.find(token.text); variable != variables.end())
          used.push_back({token.text, Meaning(), true, variable->second});
        else if (word != words.end() && word->second.is_faulty)
          throw FollowUp();
        else if (word != words.end())
          used.push_back({token.text, word->second, false, {}});
        else
          {
            auto candidates = function_names();
            for (const auto &variable : variables)
              candidates.push_back(variable.first);
            if (may_suggest())
              for (const auto &known : words)
                candidates.push_back(known.first);
            throw std::invalid_argument("<" + text + ">: <" + token.text +
                                        "> is neither a constant nor a unit nor a function" +
                                        did_you_mean(token.text, candidates));
          }
      }
  }



  Evaluation::Measure
  Evaluation::measure(const unsigned int reading, const bool natural_units, const bool natural_time) const
  {
    std::vector<double>    values(used.size());
    std::vector<Dimension> dimensions(used.size());
    std::vector<bool>      free(used.size());
    for (std::size_t i = 0; i < used.size(); ++i)
      {
        const Used &u = used[i];
        free[i]       = u.is_variable;
        values[i]     = u.meaning.readings[reading].si;
        dimensions[i] = !u.is_variable                                 ? u.meaning.readings[reading].dimension :
                        (u.name == "t" ? natural_time : natural_units) ? u.natural :
                                                                         Dimension{{0, 0, 0, 0, 0}};
      }
    // Where variables are chosen such that something is there: many functions are zero at the beginning, or later.
    Measure result;
    for (const double x : {0.6180339887, 0.0141421356, 3.3166247904, 17.2626765016})
      {
        double factor = 1; // different ones, or differences of variables would vanish
        for (std::size_t i = 0; i < used.size(); ++i)
          if (free[i])
            {
              values[i] = factor * x;
              factor += 0.7320508076;
            }
        result.value = formula.at(values.data(), 0).value;
        if (!has_variables() || (std::isfinite(result.value) && result.value != 0))
          break;
      }
    const auto found     = formula.dimensions(values, dimensions, free);
    result.dimension     = found.result;
    result.is_consistent = found.is_consistent;
    return result;
  }



  bool
  Evaluation::is_ambiguous() const
  {
    return std::any_of(used.begin(), used.end(), [](const Used &u) {
      return u.meaning.readings[0].si != u.meaning.readings[1].si;
    });
  }



  bool
  Evaluation::has_variables() const
  {
    return std::any_of(used.begin(), used.end(), [](const Used &u) { return u.is_variable; });
  }



  bool
  Evaluation::has_units() const
  {
    return std::any_of(used.begin(), used.end(), [](const Used &u) { return u.meaning.is_unit; });
  }



  bool
  Evaluation::uses(const std::string &word) const
  {
    return std::any_of(used.begin(), used.end(), [&](const Used &u) { return !u.is_variable && u.name == word; });
  }



  std::string
  Evaluation::si_text(const unsigned int reading) const
  {
    std::string result;
    for (const auto &token : tokens)
      {
        const auto u = std::find_if(used.begin(), used.end(), [&](const Used &u) { return u.name == token.text; });
        if (token.kind != Token::word || u == used.end() || u->is_variable) // "cubic" is no word that is used
          result += token.text;
        else
          {
            const std::string number = number_to_text(u->meaning.readings[reading].si);
            result += number[0] == '-' ? "(" + number + ")" : number;
          }
      }
    return result;
  }
} // namespace samara
