#include <samara/base/fault_of_text.h>
#include <samara/base/function_of_time.h>
#include <samara/base/quantity.h>
#include <samara/base/text.h>
#include <samara/base/value.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace samara
{
  namespace
  {
    std::map<std::string, Meaning>
    units_and_universal_constants()
    {
      std::map<std::string, Meaning> words;
      for (const auto &unit : units())
        words[unit.name] = {{{unit.quantity, unit.quantity}}, true};
      for (const auto &constant : universal_constants())
        words[constant.name] = {{{constant.quantity, constant.quantity}}, false};
      words["lb"].readings[1] = words["lbf"].readings[0];
      return words;
    }

    const KnownWords &
    known_to_all()
    {
      static const KnownWords words(units_and_universal_constants());
      return words;
    }

    Meaning
    faulty_meaning()
    {
      Meaning nothing;
      nothing.is_faulty = true;
      return nothing;
    }

    bool
    is_in_quotes(const std::string &text)
    {
      return text.size() >= 2 && text.front() == '"' && text.find('"', 1) + 1 == text.size();
    }

    /**
     * The text that "a", or n > 2 ? "a" : "b", stands for with the numbers that @p reader knows; nothing if @p text is
     * no text.
     */
    std::optional<std::string>
    chosen_text(const std::string &text, const Quantities &reader)
    {
      if (is_in_quotes(text))
        return text.substr(1, text.size() - 2);
      const auto question = text.find('?'), quote = text.find('"');
      if (question == std::string::npos || quote == std::string::npos || quote < question ||
          !trim(text.substr(question + 1, quote - question - 1)).empty())
        return {};
      const auto end   = text.find('"', quote + 1);
      const auto colon = text.find(':', std::min(end, text.size()));
      if (colon == std::string::npos || !trim(text.substr(end + 1, colon - end - 1)).empty())
        return {};
      const auto otherwise = chosen_text(trim(text.substr(colon + 1)), reader);
      if (!otherwise)
        throw std::invalid_argument("<" + text + ">: a text is chosen like this: <n > 2 ? \"this\" : \"that\">.");
      const bool holds = Value<bool>::read(trim(text.substr(0, question)), "1", reader);
      return holds ? text.substr(quote + 1, end - quote - 1) : *otherwise;
    }

    bool
    is_pure(const Dimension &dimension)
    {
      return same_but_angle(dimension, Dimension{{0, 0, 0, 0, 0}});
    }

    bool
    fits(const Evaluation::Measure &measure, const Dimension &wanted)
    {
      if (measure.value == 0)
        return true;
      if (!is_pure(measure.dimension))
        return same_but_angle(measure.dimension, wanted);
      // A bare number takes the declared unit. An angle is a number, but no length.
      return is_pure(wanted) || std::abs(measure.dimension[angle_exponent]) < 1e-6;
    }

    /** 5 Hz are 31.4 rad/s if a revolution is meant, and 5 rad/s if it is just 1/s: refuse to guess. */
    void
    check_cycles(const std::string &text, const Evaluation &evaluation, const Evaluation &unit)
    {
      const auto turns = [](const Evaluation &e) {
        return e.uses("rad") || e.uses("deg") || e.uses("rev") || e.uses("rpm");
      };
      if (evaluation.uses("Hz") && !unit.uses("Hz") && turns(unit))
        throw std::invalid_argument("<" + text + ">: write rev/s or rad/s, <Hz> could mean either.");
      if (unit.uses("Hz") && turns(evaluation))
        throw std::invalid_argument("<" + text + ">: cycles a second are wanted; write them in <Hz>.");
    }

    /** A bare number takes the declared unit, but of 100 % nobody knows what they are parts of. */
    void
    check_percent(const std::string         &text,
                  const Evaluation          &evaluation,
                  const Evaluation::Measure &measure,
                  const std::string         &unit)
    {
      const bool is_bare = is_pure(measure.dimension) && std::abs(measure.dimension[angle_exponent]) < 1e-6;
      if (is_bare && evaluation.is_bare_percentage() && !unit.empty() && unit != "1")
        throw std::invalid_argument("<" + text + ">: % of what? In [" + unit +
                                    "] write the part times what it is a part of, <100 %*Omega>.");
    }

    /**
     * The reading of `lb` under which the evaluation has the dimension of @p unit; "" wants no particular one. With
     * variables, dimensions that are not consistent are accepted unless it is @p strict.
     */
    unsigned int
    fitting_reading(const std::string &text,
                    const Evaluation  &evaluation,
                    const std::string &unit,
                    const bool         strict = false)
    {
      const Evaluation declared(unit.empty() ? "1" : unit, known_to_all());
      const auto       wanted = declared.measure(0).dimension;
      check_cycles(text, evaluation, declared);

      Dimension found{{0, 0, 0, 0, 0}};
      bool      is_found = false;
      for (const unsigned int reading : {0, 1})
        for (const auto &[natural_units, natural_time] :
             std::initializer_list<std::pair<bool, bool>>{{false, false}, {true, true}, {true, false}, {false, true}})
          if (const auto measure = evaluation.measure(reading, natural_units, natural_time); measure.is_consistent)
            {
              if (unit.empty() || fits(measure, wanted))
                {
                  check_percent(text, evaluation, measure, unit);
                  return reading;
                }
              if (!is_found)
                found = measure.dimension;
              is_found = true;
            }

      if (is_found)
        throw std::invalid_argument("<" + text + "> is " + describe(found) + ", but " +
                                    (unit.empty() || unit == "1" ? "a number without unit" : "[" + unit + "]") +
                                    " is wanted.");
      if (!evaluation.has_variables() || strict)
        throw std::invalid_argument("<" + text + "> mixes dimensions; give each number its unit.");
      if (evaluation.is_ambiguous())
        throw std::invalid_argument("<" + text + ">: <lb> could be a mass or a force; write lbf if it is a force, " +
                                    "and give each number its unit.");
      return 0;
    }

    double
    checked_value(const std::string &text, const Evaluation &evaluation, const std::string &unit)
    {
      for (const unsigned int reading : {0, 1})
        if (!std::isfinite(evaluation.measure(reading).value))
          throw std::invalid_argument("<" + text + "> is not a finite number.");
      return evaluation.measure(fitting_reading(text, evaluation, unit)).value;
    }
  } // namespace



  Quantities::Quantities()
    : words(known_to_all())
  {
    words.begin_layer();
  }



  void
  Quantities::add_constant(const std::string &name,
                           const std::string &text,
                           const std::string &where,
                           Complaints        &complaints)
  {
    add_constant(name, text, where, *this, complaints);
  }



  void
  Quantities::add_constant(const std::string &name,
                           const std::string &given,
                           const std::string &where,
                           const Quantities  &reader,
                           Complaints        &complaints)
  {
    try
      {
        const std::string text = reader.with_texts(given);
        if (const auto fault = fault_of_name(name); !fault.empty())
          throw std::invalid_argument(fault);
        texts.erase(name); // of a subsystem around
        if (const auto chosen = chosen_text(text, reader))
          {
            texts[name] = *chosen;
            return;
          }

        const Evaluation evaluation(with_tables_beside(text, where), reader.words);
        checked_value(text, evaluation, "");

        // What contradicts itself in one reading is meant in the other one.
        std::array<Evaluation::Measure, 2> m{{evaluation.measure(0), evaluation.measure(1)}};
        for (const unsigned int i : {0, 1})
          if (!m[i].is_consistent)
            m[i] = m[1 - i];
        words.set(name, {{{{m[0].value, m[0].dimension}, {m[1].value, m[1].dimension}}}, false});
      }
    catch (const FollowUp &)
      {
        words.set(name, faulty_meaning());
      }
    catch (const std::invalid_argument &e)
      {
        complaints.add(where, "constant <" + name + ">: " + e.what());
        if (const Meaning *const word = words.find(name); word == nullptr || word->is_unit)
          words.set(name, faulty_meaning());
      }
  }



  void
  Quantities::add_function(const std::string &name,
                           const std::string &text,
                           const std::string &where,
                           Complaints        &complaints)
  {
    try
      {
        if (const auto fault = fault_of_state(name); !fault.empty())
          throw std::invalid_argument(fault);
        if (trim(text).rfind(ScalarFunction::table_prefix, 0) == 0)
          throw std::invalid_argument("a table stands in a file here, <table(\"file.csv\", t)>.");
        const std::string with_files = with_tables_beside(text, where);
        const Evaluation  evaluation(with_files, words, {{"t", {{0, 0, 1, 0, 0}}}});
        // with t in seconds, or with t as a number
        for (const bool natural_time : {true, false})
          for (const unsigned int reading : {0, 1})
            if (const auto measure = evaluation.measure(reading, natural_time, natural_time); measure.is_consistent)
              {
                Meaning meaning;
                meaning.readings.fill({1, measure.dimension});
                meaning.of_time = evaluation.si_text(reading);
                FunctionOfTime check(meaning.of_time); // refuses what cannot be read
                words.set(name, meaning);
                return;
              }
        throw std::invalid_argument("<" + text + "> mixes dimensions; give each number its unit.");
      }
    catch (const FollowUp &)
      {
        words.set(name, faulty_meaning());
      }
    catch (const std::invalid_argument &e)
      {
        complaints.add(where, "function <" + name + ">: " + e.what());
        if (words.find(name) == nullptr)
          words.set(name, faulty_meaning());
      }
  }



  std::string
  Quantities::with_texts(const std::string &text) const
  {
    std::string result;
    std::size_t from = 0;
    for (std::size_t open = 0; (open = text.find("${", from)) != std::string::npos;)
      {
        const auto close = text.find('}', open);
        if (close == std::string::npos)
          throw std::invalid_argument("<" + text + ">: a <${> is not closed.");
        const std::string name = trim(text.substr(open + 2, close - open - 2));
        result += text.substr(from, open - from);
        from             = close + 1;
        const auto known = texts.find(name);
        const auto word  = words.find(name);
        if (known != texts.end() && known->second.rfind(fault_of_text, 0) == 0)
          throw std::invalid_argument(known->second.substr(fault_of_text.size()));
        else if (known != texts.end())
          result += known->second;
        else if (word != nullptr && word->is_faulty)
          throw FollowUp();
        else if (word != nullptr && !word->is_unit && word->of_time.empty())
          result += number_to_text(word->readings[0].si);
        else
          {
            std::vector<std::string> names;
            for (const auto &[one, value] : texts)
              names.push_back(one);
            throw std::invalid_argument("<" + text + ">: there is no text <" + name + ">" + did_you_mean(name, names) +
                                        " A constant is a text if it is in quotes.");
          }
      }
    return result + text.substr(from);
  }



  void
  Quantities::begin_subsystem()
  {
    words.begin_layer();
  }



  std::string
  Quantities::fault_of_state(const std::string &name) const
  {
    const Meaning *const word = words.find(name);
    return name == "t"                                   ? "<t> is the time; choose another." :
           name.find(Law::reserved) != std::string::npos ? "choose another name." :
           word != nullptr && word->is_unit              ? "there is a unit of that name; choose another." :
           word != nullptr && name == "e"                ? "there is already a constant of that name." :
                                                           fault_of_name(name);
  }



  std::string
  Quantities::fault_of_name(const std::string &name) const
  {
    const std::string letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";
    if (name.empty() || letters.find(name[0]) == std::string::npos ||
        name.find_first_not_of(letters + "0123456789") != std::string::npos)
      return "a name consists of letters, digits and _, and does not begin with a digit.";

    if (name == "cubic" || name == "linear")
      return "tables are <" + name + ">; choose another.";
    const auto functions = function_names();
    if (std::find(functions.begin(), functions.end(), name) != functions.end())
      return "there is a function of that name; choose another.";
    // units may be hidden, and so may e, which is the offset of a hinge as often as 2.718
    const Meaning *const word = words.find(name);
    if (word == nullptr || word->is_faulty || word->is_unit || words.is_outer(name))
      return "";
    const bool is_euler = name == "e" && word == known_to_all().find("e");
    return is_euler ? "" : "there is already a constant of that name.";
  }



  double
  Quantities::number(const std::string &text, const std::string &unit) const
  {
    double plain = 0;
    if (text_to_number(trim(text), plain))
      return plain;
    return checked_value(text, Evaluation(text, words), unit);
  }



  std::string
  Quantities::expression(const std::string              &text,
                         const std::string              &unit,
                         const std::vector<std::string> &variables) const
  {
    const std::string &prefix  = ScalarFunction::table_prefix;
    const std::string  trimmed = trim(text);
    if (trimmed.compare(0, prefix.size(), prefix) == 0)
      return expression_of_table(trimmed.substr(prefix.size()), unit, variables.empty() ? "" : variables[0]);

    const Dimension a_number = {{0, 0, 0, 0, 0}}, a_length = {{1, 0, 0, 0, 0}}, a_time = {{0, 0, 1, 0, 0}};
    std::map<std::string, Dimension> dimensions;
    for (const auto &name : variables)
      dimensions[name] = name == "t"                                              ? a_time :
                         name == "s" || name == "x" || name == "y" || name == "z" ? a_length :
                                                                                    a_number;
    const Evaluation evaluation(trimmed, words, dimensions);
    if (!evaluation.has_variables())
      return number_to_text(number(trimmed, unit));
    const std::string result = evaluation.si_text(fitting_reading(trimmed, evaluation, unit));
    // a function of time with a name may be a number
    const bool is_number = !Evaluation(result, known_to_all(), dimensions).has_variables();
    return is_number ? number_to_text(Quantities().number(result, "")) : result;
  }



  namespace
  {
    /** Parentheses about each number and the units behind it: "a / 2 m/s" becomes "a / (2 m/s)". */
    std::string
    with_units_tied(const std::string &text, const KnownWords &words)
    {
      const auto tokens  = tokens_of(text);
      const auto is_unit = [&](const Token &token) {
        const Meaning *const word = words.find(token.text);
        return token.kind == Token::word && word != nullptr && word->is_unit;
      };
      std::string result;
      for (std::size_t i = 0; i < tokens.size(); ++i)
        {
          std::size_t end = i + 1;
          // number * unit, and then * / ^ with units and numbers as powers, as long as units follow
          if (tokens[i].kind == Token::number && i + 2 < tokens.size() && tokens[i + 1].text == "*" &&
              is_unit(tokens[i + 2]))
            {
              end = i + 3;
              for (;;)
                if (end + 1 < tokens.size() && (tokens[end].text == "*" || tokens[end].text == "/") &&
                    is_unit(tokens[end + 1]))
                  end += 2;
                else if (end + 1 < tokens.size() && tokens[end].text == "^" && tokens[end + 1].kind == Token::number)
                  end += 2;
                else
                  break;
            }
          const bool ties = end > i + 1;
          result += ties ? "(" : "";
          for (; i < end; ++i)
            result += tokens[i].text + (tokens[i].kind == Token::function ? "" : " ");
          result += ties ? ") " : "";
          --i;
        }
      return result;
    }



    /** Whether two laws of the same signals have different values at some places. */
    bool
    differ(const Law &a, const Law &b)
    {
      for (const double size : {0.6180339887, 3.3166247904, 17.2626765016})
        {
          std::vector<double> x;
          for (unsigned int i = 0; i <= a.signals().size(); ++i)
            x.push_back(size * (1 + 0.7320508076 * i));
          const double at_a = a.value(x.data()), at_b = b.value(x.data());
          if (std::abs(at_a - at_b) > 1e-12 * std::max(std::abs(at_a), std::abs(at_b)))
            return true;
        }
      return false;
    }
  } // namespace



  namespace
  {
    /**
     * @p text, in SI units with a word for each signal, as a law: a component along an axis of a subsystem is the sum
     * of those along inertial axes, of which the model knows: eᵢ·v = Σⱼ Rⱼᵢ vⱼ, and eᵢ·(x − x₀) of a position.
     */
    Law
    in_inertial_axes(const std::string &text, const std::vector<std::string> &local_paths, const Placement &placement)
    {
      if (placement.is_identity())
        return Law(text, local_paths);
      const std::string        axes = "xyz";
      std::vector<std::string> paths, sums;
      const auto               word_of = [&](const std::string &path) {
        const auto known = std::find(paths.begin(), paths.end(), path) - paths.begin();
        if (known == static_cast<std::ptrdiff_t>(paths.size()))
          paths.push_back(path);
        return Law::word(known);
      };
      for (const auto &path : local_paths)
        {
          const auto n = path.size();
          const auto i = axes.find(path.back());
          if (i == std::string::npos || n < 2 || path[n - 2] != ' ' || path.find('.') == std::string::npos)
            {
              sums.push_back(word_of(path));
              continue;
            }
          std::string sum;
          for (unsigned int j = 0; j < 3; ++j)
            if (const double r = placement.rotation(j, i); r != 0)
              sum += (sum.empty() ? "" : " + ") + (r == 1 ? "" : "(" + number_to_text(r) + ")*") +
                     word_of(path.substr(0, n - 1) + axes[j]);
          const bool   is_place = n > 11 && path.compare(n - 11, 10, ".position ") == 0;
          const double along    = placement.origin.dot(placement.rotation.col(i));
          sums.push_back("(" + sum + (is_place && along != 0 ? " - (" + number_to_text(along) + ")" : "") + ")");
        }
      return Law(Law::with_paths(text, sums), paths);
    }
  } // namespace



  Law
  Quantities::law(const std::string &text, const std::string &unit) const
  {
    const auto found = signals.find(text);
    if (!found.empty() && text.find(Law::reserved) != std::string::npos)
      throw std::invalid_argument("<" + text + ">: <" + Law::reserved + "> must not be in a name here.");
    if (found.empty())
      return Law(FunctionOfTime(expression(text, unit, {"t"})));
    return law_of(text, found, unit, signals.placement);
  }



  Law
  Quantities::law_of(const std::string                     &text,
                     const std::vector<SignalNames::Found> &found,
                     const std::string                     &unit) const
  {
    return law_of(text, found, unit, Placement());
  }



  Law
  Quantities::law_of(const std::string                     &text,
                     const std::vector<SignalNames::Found> &found,
                     const std::string                     &unit,
                     const Placement                       &placement) const
  {
    // a word in place of each signal
    std::vector<std::string>         paths;
    std::map<std::string, Dimension> dimensions = {{"t", {{0, 0, 1, 0, 0}}}};
    std::string                      with_words;
    std::size_t                      from = 0;
    for (const auto &signal : found)
      {
        const auto         known = std::find(paths.begin(), paths.end(), signal.path);
        const unsigned int i     = known - paths.begin();
        if (known == paths.end())
          {
            paths.push_back(signal.path);
            dimensions[Law::word(i)] =
              Evaluation(signal.unit.empty() ? "1" : signal.unit, known_to_all()).measure(0).dimension;
          }
        with_words += text.substr(from, signal.begin - from) + Law::word(i);
        from = signal.end;
      }
    with_words += text.substr(from);

    // a number and the units behind it may be one; where that makes a difference, one of the readings must not fit
    std::vector<Law>         readings;
    std::vector<std::string> problems;
    for (const auto &candidate : {trim(with_words), trim(with_units_tied(with_words, words))})
      try
        {
          const Evaluation evaluation(candidate, words, dimensions);
          readings.push_back(
            in_inertial_axes(evaluation.si_text(fitting_reading(candidate, evaluation, unit, true)), paths, placement));
        }
      catch (const std::invalid_argument &problem)
        {
          problems.push_back(problem.what());
        }
    if (readings.empty())
      throw std::invalid_argument(Law::with_paths(problems[0], paths));
    if (readings.size() == 2 && differ(readings[0], readings[1]))
      throw std::invalid_argument("<" + text +
                                  "> can be read in two ways; put parentheses around a number and its unit, (5 deg/s), "
                                  "or around what is divided.");
    return readings[0];
  }



  std::string
  Quantities::expression_of_table(const std::string &rows, const std::string &unit, const std::string &variable) const
  {
    std::vector<std::string> si_rows;
    for (const auto &row : split_top_level(rows, ';'))
      {
        auto pair = split_top_level(row, ',');
        if (pair.size() == 1)
          {
            const auto blank = std::min(row.find_first_of(" \t"), row.size());
            pair             = {row.substr(0, blank), trim(row.substr(blank))};
          }
        if (pair.size() != 2 || pair[1].empty())
          throw std::invalid_argument("<" + row + "> in a table must be two numbers; write <x, y> if they have units.");
        const std::string unit_of_x = variable == "t" ? "s" : "";
        si_rows.push_back(number_to_text(number(pair[0], unit_of_x)) + " " + number_to_text(number(pair[1], unit)));
      }
    const std::string table = ScalarFunction::table_prefix + " " + join(si_rows, "; ");
    ScalarFunction(table, variable); // refuses points that are out of order
    return table;
  }



  bool
  Quantities::names_a_unit(const std::string &text) const
  {
    double plain = 0;
    return !text_to_number(trim(text), plain) && Evaluation(text, words).has_units();
  }



  Quantity
  Quantities::unit(const std::string &text)
  {
    const Evaluation evaluation(text, known_to_all());
    const auto       measure = evaluation.measure(0);
    if (!measure.is_consistent || !(measure.value > 0) || !std::isfinite(measure.value))
      throw std::invalid_argument("<" + text + "> is not a unit.");
    return {measure.value, measure.dimension};
  }



  bool
  Quantities::is_si_unit(const std::string &text)
  {
    // asked for each entry of each object, always about the same few
    static std::map<std::string, bool> answers;
    const auto                         answer = answers.emplace(text, false);
    if (answer.second)
      try
        {
          const Evaluation evaluation(text, known_to_all());
          const auto       measure = evaluation.measure(0);
          answer.first->second = measure.is_consistent && std::abs(measure.value - 1) < 1e-12 && !evaluation.uses("lb");
        }
      catch (const std::invalid_argument &)
        {}
    return answer.first->second;
  }



  std::vector<std::string>
  Quantities::known_words() const
  {
    auto names = function_names();
    for (const auto &word : words.names())
      names.push_back(word);
    return names;
  }
} // namespace samara
