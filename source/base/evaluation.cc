#include <samara/base/errors.h>
#include <samara/base/evaluation.h>
#include <samara/base/look_up.h>
#include <samara/base/text.h>

#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace samara
{
  namespace
  {
    std::string
    reason(const mu::Parser::exception_type &e)
    {
      switch (e.GetCode())
        {
          case mu::ecUNEXPECTED_EOF:
            return "something is missing at the end";
          case mu::ecTOO_FEW_PARAMS:
            return "a function has too few arguments";
          case mu::ecTOO_MANY_PARAMS:
          case mu::ecUNEXPECTED_ARG:
            return "there is a comma too many";
          default:
            return "this is not an expression";
        }
    }
  } // namespace



  namespace
  {
    // factors of no meaning, so that nothing cancels
    double
    sum_of_choice(const double *const arguments, const int n)
    {
      double sum = 0, factor = 1;
      for (int i = 0; i < n; ++i, factor += 0.4142135624)
        sum += factor * arguments[i];
      return sum;
    }

    double
    sum_of_two(const double x, const double width)
    {
      return x + 0.4142135624 * width;
    }

    double
    sum_of_three(const double x, const double lower, const double upper)
    {
      return x + 0.4142135624 * lower + 0.3660254038 * upper;
    }
  } // namespace



  Evaluation::Evaluation(const std::string                      &text,
                         const std::map<std::string, Meaning>   &words,
                         const std::map<std::string, Dimension> &variables)
    : text(text)
    , tokens(tokens_of(text))
    , parser(std::make_unique<mu::Parser>())
  {
    replace_tables(0, tokens.size());
    collect_words(words, variables);
    prepare_parser();
  }



  Evaluation::~Evaluation() = default;



  void
  Evaluation::replace_tables(const std::size_t begin, const std::size_t end)
  {
    for (std::size_t i = begin; i < end; ++i)
      if (tokens[i].kind != Token::function || tokens[i].text != table_function)
        measured.push_back(tokens[i]);
      else
        {
          // unit * (2.7 + sin(x / unit of x) + sin(y / unit of y)): never zero, no power of anything
          const TableCall call   = table_call(tokens, i);
          const auto      units  = LookUp::of_file(call.file, call.arguments.size(), call.is_cubic)->dimensions();
          const auto      symbol = [&](const char *const text) { measured.push_back({Token::symbol, text}); };
          symbol("(");
          measured.push_back(word_of_table(units.back()));
          symbol("*");
          symbol("(");
          measured.push_back({Token::number, "2.7"});
          for (std::size_t k = 0; k < call.arguments.size(); ++k)
            {
              symbol("+");
              measured.push_back({Token::function, "sin"});
              symbol("(");
              symbol("(");
              replace_tables(call.arguments[k].first, call.arguments[k].second);
              symbol(")");
              symbol("/");
              measured.push_back(word_of_table(units[k]));
              symbol(")");
            }
          symbol(")");
          symbol(")");
          i = call.end - 1;
        }
  }



  Token
  Evaluation::word_of_table(const Dimension &unit)
  {
    const std::string name = "_table_" + std::to_string(units_of_tables.size());
    units_of_tables[name]  = {{{{1, unit}, {1, unit}}}};
    return {Token::word, name};
  }



  void
  Evaluation::collect_words(const std::map<std::string, Meaning>   &words,
                            const std::map<std::string, Dimension> &variables)
  {
    for (const auto &token : measured)
      {
        const bool is_known =
          std::any_of(used.begin(), used.end(), [&](const Used &u) { return u.name == token.text; });
        if (token.kind != Token::word || is_known)
          continue;

        const auto word = words.find(token.text);
        if (const auto unit = units_of_tables.find(token.text); unit != units_of_tables.end())
          used.push_back({token.text, unit->second, false, {}});
        else if (const auto variable = variables.find(token.text); variable != variables.end())
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



  void
  Evaluation::prepare_parser()
  {
    parser->DefineFun("floor", static_cast<double (*)(double)>(std::floor));
    parser->DefineFun("ceil", static_cast<double (*)(double)>(std::ceil));

    parser->DefineFun("saturate", sum_of_three);
    parser->DefineFun("deadband", sum_of_two);
    for (const auto *const name : {"min", "max"})
      parser->DefineFun(name, sum_of_choice);

    // Names of our own, because some units are called like functions of muParser, and % like nothing it knows.
    const auto alias = [](const std::size_t i) { return "word_" + std::to_string(i); };
    for (std::size_t i = 0; i < used.size(); ++i)
      parser->DefineVar(alias(i), &used[i].seen);

    std::string expression;
    for (const auto &token : measured)
      {
        const auto u = std::find_if(used.begin(), used.end(), [&](const Used &u) { return u.name == token.text; });
        expression += token.kind == Token::word ? alias(u - used.begin()) : token.text;
        if (token.kind != Token::function) // after which muParser wants to see the parenthesis
          expression += " ";
      }
    try
      {
        parser->SetExpr(expression);
        parser->Eval();
        if (parser->GetNumResults() != 1)
          throw std::invalid_argument("<" + text + ">: one number is wanted here.");
      }
    catch (const mu::Parser::exception_type &e)
      {
        throw std::invalid_argument("<" + text + ">: " + reason(e) + ".");
      }
  }



  double
  Evaluation::value(const unsigned int reading,
                    const Natural      natural,
                    const double       variable,
                    const unsigned int base,
                    const double       scale) const
  {
    // different ones, or differences of variables would vanish
    double factor = 1;
    for (auto &u : used)
      if (u.is_variable)
        {
          u.seen =
            factor * variable * ((u.name == "t" ? natural.time : natural.units) ? std::pow(scale, u.natural[base]) : 1);
          factor += 0.7320508076;
        }
      else
        u.seen = u.meaning.readings[reading].si * std::pow(scale, u.meaning.readings[reading].dimension[base]);
    return parser->Eval();
  }



  Evaluation::Measure
  Evaluation::measure(const unsigned int reading, const bool natural_units, const bool natural_time) const
  {
    const Natural natural = {natural_units, natural_time};
    // Where variables are chosen such that something is there: many functions are zero at the beginning, or later.
    Measure result;
    double  variable = 0;
    for (const double x : {0.6180339887, 0.0141421356, 3.3166247904, 17.2626765016})
      {
        variable     = x;
        result.value = value(reading, natural, variable, 0, 1);
        if (!has_variables() || (std::isfinite(result.value) && result.value != 0))
          break;
      }

    for (unsigned int base = 0; base < result.dimension.size(); ++base)
      {
        const double twice   = value(reading, natural, variable, base, 2);
        const double eight   = value(reading, natural, variable, base, 8);
        const bool   is_zero = result.value == 0 && twice == 0 && eight == 0;
        const double power   = is_zero ? 0 : std::log2(twice / result.value);
        const bool   agrees  = is_zero || std::abs(std::log2(eight / result.value) - 3 * power) < 1e-9;
        if (agrees)
          result.dimension[base] = power;
        else if (base != angle_exponent) // sin(30 deg) is all right: the angle is a number
          result.is_consistent = false;
      }
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
  Evaluation::has_stand_ins() const
  {
    return std::any_of(tokens.begin(), tokens.end(), [](const Token &token) {
      return token.kind == Token::function && (token.text == "min" || token.text == "max" || token.text == "saturate" ||
                                               token.text == "deadband" || token.text == table_function);
    });
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
