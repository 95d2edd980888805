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



  const Meaning *
  KnownWords::find_unit(const std::string &name) const
  {
    const Layer *outermost = innermost.get();
    while (outermost->around)
      outermost = outermost->around.get();
    const auto word = outermost->words.find(name);
    return word != outermost->words.end() && word->second.is_unit ? &word->second : nullptr;
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



  namespace
  {
    const std::string hidden_unit = "unit_of_"; ///< begins the word of a unit whose name is a constant's, too

    bool
    is_operator(const Token &token, const std::string &symbols)
    {
      return token.kind == Token::symbol && token.text.size() == 1 && symbols.find(token.text) != std::string::npos;
    }



    /** Which words of an expression are units although constants have their names, see Evaluation. */
    class HiddenUnits
    {
    public:
      HiddenUnits(const std::string                      &text,
                  std::vector<Token>                     &tokens,
                  const KnownWords                       &words,
                  const std::map<std::string, Dimension> &variables)
        : text(text)
        , tokens(tokens)
        , words(words)
        , variables(variables)
      {
        for (std::size_t i = 0; i < tokens.size(); ++i)
          if (tokens[i].kind == Token::word)
            decide(i);
      }

      bool any = false; ///< whether a token was given another text

    private:
      const std::string                      &text;
      std::vector<Token>                     &tokens;
      const KnownWords                       &words;
      const std::map<std::string, Dimension> &variables;

      bool
      is_unit(const std::size_t i) const
      {
        return tokens[i].kind == Token::word && variables.count(tokens[i].text) == 0 &&
               (tokens[i].text.rfind(hidden_unit, 0) == 0 || words.find_unit(tokens[i].text) != nullptr);
      }

      bool
      is_twofold(const std::size_t i) const
      {
        const Meaning *const word = words.find(tokens[i].text);
        return is_unit(i) && word != nullptr && !word->is_unit;
      }

      /** The number with which units behind it begin that go on to the operator before @p i; none: tokens.size(). */
      std::size_t
      number_of_units_before(std::size_t i) const
      {
        while (i >= 2)
          {
            i -= 2; // the operand before an operator
            if (tokens[i].kind == Token::number && i >= 2 && is_operator(tokens[i - 1], "^") && is_unit(i - 2))
              i -= 2; // a power of a unit
            else if (tokens[i].kind == Token::number)
              return i;
            if (!is_unit(i) || i == 0 || !is_operator(tokens[i - 1], "*/"))
              break;
          }
        return tokens.size();
      }

      /** One behind the units that go on from the word @p i. */
      std::size_t
      end_of_units(std::size_t i) const
      {
        for (++i; i + 1 < tokens.size();)
          if ((is_operator(tokens[i], "*/") && is_unit(i + 1)) ||
              (is_operator(tokens[i], "^") && tokens[i + 1].kind == Token::number))
            i += 2;
          else
            break;
        return i;
      }

      void
      decide(const std::size_t i)
      {
        if (!is_twofold(i) || i < 2 || !is_operator(tokens[i - 1], "*/"))
          return;
        const bool        is_implied = tokens[i - 1].is_implied;
        const std::string name       = tokens[i].text;
        bool              is_unit    = is_implied && tokens[i - 2].kind == Token::number;
        if (const auto number = number_of_units_before(i); !is_unit && number < tokens.size() && number + 2 < i)
          {
            const auto end = end_of_units(i);
            is_unit        = number > 0 && is_operator(tokens[number - 1], "(") && end < tokens.size() &&
                      is_operator(tokens[end], ")") && (number < 2 || tokens[number - 2].kind != Token::function);
            if (!is_unit)
              refuse(name,
                     "(" + joined(number, i + 1) + ")",
                     "(" + joined(number, i - 1) + ")" + tokens[i - 1].text + name);
          }
        else if (!is_unit && is_implied)
          refuse(name, "... * (1 " + name + ")", "... * " + name);
        if (!is_unit)
          return;
        tokens[i].text = hidden_unit + name;
        any            = true;
      }

      [[noreturn]] void
      refuse(const std::string &name, const std::string &of_unit, const std::string &of_constant) const
      {
        throw std::invalid_argument("<" + text + ">: <" + name + "> is a unit and a constant of this model. Write <" +
                                    of_unit + "> for the unit, <" + of_constant + "> for the constant.");
      }

      std::string
      joined(const std::size_t begin, const std::size_t end) const
      {
        std::string result;
        for (std::size_t i = begin; i < end; ++i)
          {
            const bool is_hidden = tokens[i].text.rfind(hidden_unit, 0) == 0;
            result += tokens[i].is_implied ? " " :
                      is_hidden            ? tokens[i].text.substr(hidden_unit.size()) :
                                             tokens[i].text;
          }
        return result;
      }
    };



    /** A text that has these tokens. */
    std::string
    text_of(const std::vector<Token> &tokens)
    {
      std::string result;
      for (const auto &token : tokens)
        result += token.text + (token.kind == Token::function ? "" : " ");
      return result;
    }
  } // namespace



  Evaluation::Evaluation(const std::string                      &text,
                         const KnownWords                       &words,
                         const std::map<std::string, Dimension> &variables)
    : text(text)
    , tokens(tokens_of(text))
  {
    const bool any_hidden = HiddenUnits(text, tokens, words, variables).any;
    collect_words(words, variables);
    std::vector<std::string> names;
    for (const auto &u : used)
      names.push_back(u.name);
    formula = Formula(any_hidden ? text_of(tokens) : text, names);
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

        const bool           is_hidden = token.text.rfind(hidden_unit, 0) == 0;
        const Meaning *const word =
          is_hidden ? words.find_unit(token.text.substr(hidden_unit.size())) : words.find(token.text);
        if (const auto variable = variables.find(token.text); variable != variables.end())
          {
            if (word != nullptr && !word->is_unit && words.find_unit(token.text) != nullptr)
              throw std::invalid_argument("<" + text + ">: <" + token.text + "> is " +
                                          (token.text == "t" ? "the time" : "a variable") +
                                          " here, and a constant of this model: give the constant another name.");
            used.push_back({token.text, Meaning(), true, variable->second});
          }
        else if (word != nullptr && word->is_faulty)
          throw FollowUp();
        else if (word != nullptr && !word->of_time.empty())
          {
            if (variables.count("t") == 0)
              throw std::invalid_argument("<" + text + ">: <" + token.text +
                                          "> is a function of time, and this does not change with time.");
            used.push_back({token.text, *word, true, word->readings[0].dimension});
          }
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
                        !u.meaning.of_time.empty()                     ? u.natural :
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
    return std::any_of(used.begin(), used.end(), [&](const Used &u) {
      return !u.is_variable && (u.name == word || (u.meaning.is_unit && u.name == hidden_unit + word));
    });
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
        if (token.kind != Token::word || u == used.end()) // "cubic" is no word that is used
          result += token.text;
        else if (u->is_variable)
          result += u->meaning.of_time.empty() ? token.text : "(" + u->meaning.of_time + ")";
        else
          {
            const std::string number = number_to_text(u->meaning.readings[reading].si);
            result += number[0] == '-' ? "(" + number + ")" : number;
          }
      }
    return result;
  }
} // namespace samara
