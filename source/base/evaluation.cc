#include <samara/base/errors.h>
#include <samara/base/evaluation.h>
#include <samara/base/text.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace samara
{
  KnownWords::KnownWords(std::map<std::string, Meaning> outermost)
    : innermost(std::make_shared<Layer>(Layer{std::move(outermost), nullptr}))
  {}



  const Meaning *
  KnownWords::find(const std::string &name) const
  {
    for (const Layer *layer = innermost.get(); layer != nullptr; layer = layer->around.get())
      if (const auto word = layer->words.find(name); word != layer->words.end())
        return &word->second;
    return nullptr;
  }



  bool
  KnownWords::is_outer(const std::string &name) const
  {
    if (innermost->words.count(name) > 0)
      return false;
    for (const Layer *layer = innermost->around.get(); layer != nullptr; layer = layer->around.get())
      if (layer->words.count(name) > 0)
        return layer->around != nullptr;
    return false;
  }



  void
  KnownWords::set(const std::string &name, const Meaning &meaning)
  {
    if (innermost.use_count() > 1)
      innermost = std::make_shared<Layer>(*innermost);
    innermost->words[name] = meaning;
  }



  void
  KnownWords::begin_layer()
  {
    innermost = std::make_shared<Layer>(Layer{{}, innermost});
  }



  std::vector<std::string>
  KnownWords::names() const
  {
    std::set<std::string> all;
    for (const Layer *layer = innermost.get(); layer != nullptr; layer = layer->around.get())
      for (const auto &word : layer->words)
        all.insert(word.first);
    return {all.begin(), all.end()};
  }



  Evaluation::Evaluation(const std::string                      &text,
                         const KnownWords                       &words,
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
  Evaluation::collect_words(const KnownWords &words, const std::map<std::string, Dimension> &variables)
  {
    for (const auto &token : tokens)
      {
        const bool is_known =
          std::any_of(used.begin(), used.end(), [&](const Used &u) { return u.name == token.text; });
        if (token.kind != Token::word || is_known || token.text == "cubic" || token.text == "linear") // kinds of tables
          continue;

        const Meaning *const word = words.find(token.text);
        if (const auto variable = variables.find(token.text); variable != variables.end())
          used.push_back({token.text, Meaning(), true, variable->second});
        else if (word != nullptr && word->is_faulty)
          throw FollowUp();
        else if (word != nullptr)
          used.push_back({token.text, *word, false, {}});
        else
          {
            auto candidates = function_names();
            for (const auto &variable : variables)
              candidates.push_back(variable.first);
            if (may_suggest())
              for (const auto &known : words.names())
                candidates.push_back(known);
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



  bool
  Evaluation::is_bare_percentage() const
  {
    return uses("%") &&
           std::all_of(used.begin(), used.end(), [](const Used &u) { return u.is_variable || u.meaning.is_unit; });
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
