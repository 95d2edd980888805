#include <samara/base/law.h>
#include <samara/base/quoted.h>
#include <samara/base/text.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <map>
#include <stdexcept>

namespace samara
{
  const std::string Law::reserved = "_signal_";



  std::string
  Law::with_paths(std::string text, const std::vector<std::string> &paths)
  {
    // in one pass: what is put in is not looked at again, and word(1) is the beginning of word(10)
    for (std::size_t at = 0; (at = text.find(reserved, at)) != std::string::npos;)
      {
        const std::size_t digits = at + reserved.size(),
                          end    = std::min(text.find_first_not_of("0123456789", digits), text.size());
        const std::string &path  = paths.at(std::stoul(text.substr(digits, end - digits)));
        text.replace(at, end - at, path);
        at += path.size();
      }
    return text;
  }



  Law::Law(const double constant)
  {
    static const Law zero(FunctionOfTime(0));
    parts = constant == 0 ? zero.parts : Law(FunctionOfTime(constant)).parts;
  }



  Law::Law(const FunctionOfTime &function)
  {
    Parts own;
    own.time_function = function;
    own.source        = function.text();
    parts             = std::make_shared<const Parts>(std::move(own));
  }



  Law::Law(const std::string &text, const std::vector<std::string> &signals)
  {
    if (signals.empty())
      {
        *this = Law(FunctionOfTime(text));
        return;
      }
    Parts                    own;
    std::vector<std::string> variables = {"t"};
    for (unsigned int i = 0; i < signals.size(); ++i)
      variables.push_back(word(i));
    own.words   = text;
    own.paths   = signals;
    own.formula = Formula(text, variables);
    own.source  = with_paths(text, signals);
    for (const auto &part : own.formula.switches_of_first_variable())
      own.switches_of_time.emplace_back(part);
    parts = std::make_shared<const Parts>(std::move(own));
  }



  Law
  Law::times(const std::string &path) const
  {
    std::vector<std::string> all = signals();
    const std::string        own = all.empty() ? of_time().formula_text() : parts->words;
    const unsigned int       i   = std::find(all.begin(), all.end(), path) - all.begin();
    if (i == all.size())
      all.push_back(path);
    return Law("(" + own + ")*" + word(i), all);
  }



  Law
  Law::combination(const std::array<Law, 3> &laws, const Eigen::RowVector3d &c, const double offset)
  {
    std::vector<std::string> all, terms;
    double                   constant = offset;
    for (unsigned int j = 0; j < 3; ++j)
      if (c(j) != 0 && laws[j].is_constant())
        constant += c(j) * laws[j].of_time()(0.);
      else if (c(j) != 0)
        {
          const auto              &own  = laws[j].signals();
          std::string              term = own.empty() ? laws[j].of_time().formula_text() : laws[j].parts->words;
          std::vector<std::string> among_all; // words of its signals
          for (const auto &path : own)
            {
              if (std::find(all.begin(), all.end(), path) == all.end())
                all.push_back(path);
              among_all.push_back(word(std::find(all.begin(), all.end(), path) - all.begin()));
            }
          term = with_paths(term, among_all);
          terms.push_back(c(j) == 1 ? "(" + term + ")" : "(" + number_to_text(c(j)) + ")*(" + term + ")");
        }
    if (terms.empty())
      return Law(constant);
    if (constant != 0)
      terms.push_back("(" + number_to_text(constant) + ")");
    if (terms.size() == 1 && c.squaredNorm() == 1)
      for (unsigned int j = 0; j < 3; ++j)
        if (c(j) == 1)
          return laws[j];
    const std::string sum = join(terms, " + ");
    return all.empty() ? Law(FunctionOfTime(sum)) : Law(sum, all);
  }



  const FunctionOfTime &
  Law::of_time() const
  {
    Assert(parts->paths.empty(), dealii::ExcMessage("The law depends on the state."));
    return parts->time_function;
  }



  ScalarFunction
  Law::of_signal() const
  {
    if (parts->paths.size() != 1 || parts->formula.uses(0))
      throw std::invalid_argument("<" + text() + "> must depend on one motion, and on nothing else.");
    return ScalarFunction(parts->words, word(0));
  }



  double
  Law::next_corner(const double from, const double to) const
  {
    if (parts->paths.empty())
      return parts->time_function.next_corner(from, to);
    double first = std::numeric_limits<double>::infinity();
    for (const auto &part : parts->switches_of_time)
      first = std::min(first, part.next_corner(from, to));
    return first;
  }



  const std::string &
  Law::text() const
  {
    return parts->source;
  }



  namespace
  {
    const std::map<std::string, std::string> &
    units_of_quantities()
    {
      static const std::map<std::string, std::string> units = []() {
        std::map<std::string, std::string> all;
        const auto                         of_directions = [&](const std::string &name, const std::string &unit) {
          for (const std::string direction : {" x", " y", " z"})
            all[name + direction] = unit;
        };
        of_directions("position", "m");
        of_directions("displacement", "m");
        of_directions("velocity", "m/s");
        of_directions("angular velocity", "rad/s");
        for (const std::string number : {"", " 1", " 2", " 3"})
          {
            all["rotation" + number]               = "rad";
            all["rotation" + number + " rate"]     = "rad/s";
            all["displacement" + number]           = "m";
            all["displacement" + number + " rate"] = "m/s";
            all["force" + number]                  = "N";
            all["moment" + number]                 = "N*m";
          }
        all["length"]      = "m";
        all["length rate"] = "m/s";
        return all;
      }();
      return units;
    }

    bool
    is_word_character(const char c)
    {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
    }

    /** Whether @p text has @p words at @p at, whatever the white space between them; @p end is then where they end. */
    bool
    has_words(const std::string &text, const std::size_t at, const std::string &words, std::size_t &end)
    {
      std::size_t i = at;
      for (const char c : words)
        if (c == ' ')
          {
            const std::size_t begin = i;
            while (i < text.size() && std::isspace(static_cast<unsigned char>(text[i])) != 0)
              ++i;
            if (i == begin)
              return false;
          }
        else if (i == text.size() || text[i++] != c)
          return false;
      end = i;
      return i == text.size() || !is_word_character(text[i]);
    }

    std::string
    with_single_blanks(const std::string &text)
    {
      std::string result;
      for (const char c : text)
        if (std::isspace(static_cast<unsigned char>(c)) == 0)
          result += c;
        else if (!result.empty() && result.back() != ' ')
          result += ' ';
      return result;
    }

    /** Where the point "tip" of "tip.velocity x" ends, with its dot; @p at if there is no point. */
    std::size_t
    end_of_point(const std::string &text, const std::size_t at)
    {
      std::size_t i = at, end = at;
      for (; i < text.size(); ++i)
        if (text[i] == '.')
          {
            if (i + 1 < text.size() && std::isalpha(static_cast<unsigned char>(text[i + 1])) != 0)
              end = i + 1;
          }
        else if (!is_word_character(text[i]) && text[i] != ' ')
          break;
      return end;
    }
  } // namespace



  SignalNames::SignalNames(std::shared_ptr<const SignalNames> shared)
    : around(std::move(shared))
    , longest(around->longest)
  {}



  const std::string *
  SignalNames::object_called(const std::string &name) const
  {
    if (const auto found = objects.find(name); found != objects.end())
      return &found->second;
    return around ? around->object_called(name) : nullptr;
  }



  const SignalNames::State *
  SignalNames::state_called(const std::string &name) const
  {
    if (const auto found = states.find(name); found != states.end())
      return &found->second;
    return around ? around->state_called(name) : nullptr;
  }



  void
  SignalNames::add_object(const std::string &name)
  {
    add_short_object(name, name);
  }



  void
  SignalNames::add_short_object(const std::string &short_name, const std::string &name)
  {
    objects[short_name] = name;
    longest             = std::max(longest, short_name.size());
  }



  void
  SignalNames::add_state(const std::string &name, const std::string &unit)
  {
    states[name] = {name, unit};
    if (!std::all_of(name.begin(), name.end(), is_word_character))
      long_states.push_back(name);
  }



  void
  SignalNames::add_short_state(const std::string &short_name, const std::string &name)
  {
    const State *const known = state_called(name);
    Assert(known != nullptr, dealii::ExcMessage("The state <" + name + "> has been added before."));
    states[short_name] = *known;
  }



  std::string
  SignalNames::unit_of_state(const std::string &name) const
  {
    const State *const found = state_called(name);
    return found == nullptr ? "" : found->unit;
  }



  std::string
  SignalNames::unit_of(const std::string &quantity)
  {
    const auto found = units_of_quantities().find(quantity);
    return found == units_of_quantities().end() ? "" : found->second;
  }



  std::vector<std::string>
  SignalNames::known_quantities()
  {
    std::vector<std::string> names;
    for (const auto &[name, unit] : units_of_quantities())
      names.push_back(name);
    return names;
  }



  SignalNames::Found
  SignalNames::signal_of_object(const std::string &text,
                                const std::size_t  begin,
                                const std::string &object,
                                const std::size_t  after_object)
  {
    const std::size_t quantity = end_of_point(text, after_object);
    std::string       longest;
    std::size_t       end_of_longest = quantity, end = quantity;
    for (const auto &[name, unit] : units_of_quantities())
      if (name.size() > longest.size() && has_words(text, quantity, name, end))
        {
          longest        = name;
          end_of_longest = end;
        }
    if (longest.empty())
      {
        std::size_t stop = quantity;
        while (stop < text.size() && (is_word_character(text[stop]) || text[stop] == ' '))
          ++stop;
        const std::string given = trim(text.substr(quantity, stop - quantity));
        const std::string which = "<" + text + ">: <" + given + "> of <" + object + "> cannot stand in an expression";
        if (given.find("acceleration") != std::string::npos)
          throw std::invalid_argument(
            which + ": forces that depend on accelerations change what accelerations there are. Take a sensor with a "
                    "lag: a state <follower> of the velocity v, Rate = (v - follower)/T, and (v - follower)/T for the "
                    "acceleration.");
        throw std::invalid_argument(which + did_you_mean(given, known_quantities()));
      }
    return {begin,
            end_of_longest,
            object + "." + text.substr(after_object, quantity - after_object) + longest,
            unit_of(longest)};
  }



  std::vector<SignalNames::Found>
  SignalNames::find(const std::string &text) const
  {
    std::vector<Found> result;
    std::size_t        dot = text.find('.');
    for (std::size_t i = 0; i < text.size(); ++i)
      {
        if (const auto end = end_of_quoted(text, i); end != std::string::npos)
          i = end; // the name of a file
        const bool begins_word = is_word_character(text[i]) && std::isdigit(static_cast<unsigned char>(text[i])) == 0 &&
                                 (i == 0 || (!is_word_character(text[i - 1]) && text[i - 1] != '.'));
        if (!begins_word)
          continue;
        // the name of an object goes up to a dot, that of a state is a word
        if (dot < i) // the next one stays, or texts of thousands of words would be gone through for each of them
          dot = text.find('.', i);
        const std::string object =
          dot == std::string::npos || dot - i > 2 * longest ? "" : with_single_blanks(text.substr(i, dot - i));
        if (const std::string *const known = object_called(object))
          {
            result.push_back(signal_of_object(text, i, *known, dot + 1));
            i = result.back().end - 1;
            continue;
          }
        std::size_t end = i, end_of_longest = i;
        for (const auto &name : (around ? *around : *this).long_states)
          if (has_words(text, i, name, end) && end > end_of_longest)
            {
              if (result.empty() || result.back().begin != i)
                result.emplace_back();
              result.back() = {i, end_of_longest = end, name, unit_of_state(name)};
            }
        if (end_of_longest > i)
          {
            i = end_of_longest - 1;
            continue;
          }
        end = i;
        while (end < text.size() && is_word_character(text[end]))
          ++end;
        const State *const state = state_called(text.substr(i, end - i));
        if (state != nullptr && (end == text.size() || text[end] != '('))
          result.push_back({i, end, state->name, state->unit});
        i = end - 1;
      }
    return result;
  }
} // namespace samara
