// Where a formula may switch from one of its pieces to another, found without running it.

#include <samara/base/formula.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** value + slope x, and the sums of the sizes of what was added up to each, for round-off. */
    struct Line
    {
      double value = 0, slope = 0, value_size = 0, slope_size = 0;
    };

    /** What a number of the program may be, one of these; none of them: anything. */
    using Lines = std::vector<Line>;

    /** More are not followed. */
    constexpr std::size_t most_lines = 16;

    Line
    scaled(const Line &a, const double factor)
    {
      return {factor * a.value, factor * a.slope, std::abs(factor) * a.value_size, std::abs(factor) * a.slope_size};
    }

    Line
    sum(const Line &a, const Line &b)
    {
      return {a.value + b.value, a.slope + b.slope, a.value_size + b.value_size, a.slope_size + b.slope_size};
    }

    /** One or the other; anything if one of them may be. */
    Lines
    either(Lines a, const Lines &b)
    {
      if (a.empty() || b.empty() || a.size() + b.size() > most_lines)
        return {};
      a.insert(a.end(), b.begin(), b.end());
      return a;
    }

    /** f(a, b) of all pairs; @p f returns whether the result is a line. */
    template <typename F>
    Lines
    combined(const Lines &a, const Lines &b, const F &f)
    {
      Lines result;
      if (a.size() * b.size() <= most_lines)
        for (const auto &x : a)
          for (const auto &y : b)
            {
              Line z;
              if (!f(x, y, z))
                return {};
              result.push_back(z);
            }
      return result;
    }

    /** Of an operation without pieces. */
    Lines
    smooth_result(const std::string &name, const std::vector<Lines> &arguments)
    {
      const Lines &a = arguments[0], &b = arguments.back();
      if (name == "+" || name == "-")
        return combined(a, b, [&](const Line &x, const Line &y, Line &z) {
          z = sum(x, name == "+" ? y : scaled(y, -1));
          return true;
        });
      if (name == "*")
        return combined(a, b, [](const Line &x, const Line &y, Line &z) {
          z = y.slope_size == 0 ? scaled(x, y.value) : scaled(y, x.value);
          return x.slope_size == 0 || y.slope_size == 0;
        });
      if (name == "/")
        return combined(a, b, [](const Line &x, const Line &y, Line &z) {
          z = scaled(x, 1 / y.value);
          return y.slope_size == 0;
        });
      return {};
    }

    /** Of an operation with pieces: on each of them a line. */
    Lines
    result_by_pieces(const std::string &name, const std::vector<Lines> &arguments)
    {
      Lines result = arguments[0];
      if (name == "saturate" || name == "min" || name == "max")
        for (std::size_t i = 1; i < arguments.size(); ++i)
          result = either(result, arguments[i]);
      else if (name == "abs")
        for (const auto &line : arguments[0])
          result.push_back(scaled(line, -1));
      else if (name == "deadband")
        result = either({Line()}, either(smooth_result("+", arguments), smooth_result("-", arguments)));
      else
        result = {{-1, 0, 1, 0}, {0, 0, 0, 0}, {1, 0, 1, 0}}; // sign() and comparisons
      return result;
    }

    /** The lines of @p a with the other sign. */
    Lines
    opposite(const Lines &a)
    {
      return smooth_result("*", {a, {{-1, 0, 1, 0}}});
    }

    Lines
    constant_line(const double value)
    {
      return {{value, 0, std::abs(value), 0}};
    }


    /** Runs a program with lines in place of numbers and collects where arguments of what switches are equal. */
    template <typename Instruction, typename Interval>
    class SwitchFinder
    {
    public:
      SwitchFinder(const std::vector<Instruction> &program, std::vector<Interval> &places)
        : program(program)
        , places(places)
      {}

      bool are_known = true; ///< nothing switches outside of the places

      void
      run()
      {
        for (std::size_t i = 0; i < program.size(); ++i)
          {
            const Instruction &instruction = program[i];
            for (; !first_branches.empty() && first_branches.back().first == i; first_branches.pop_back())
              stack.back() = either(stack.back(), first_branches.back().second);
            if (instruction.kind == Instruction::number)
              stack.push_back(constant_line(instruction.value));
            else if (instruction.kind == Instruction::variable && instruction.index == 0)
              stack.push_back({{0, 1, 0, 1}});
            else if (instruction.kind == Instruction::variable)
              stack.push_back({}); // of another variable: anything
            else if (instruction.kind == Instruction::skip_if_zero)
              stack.pop_back();
            else if (instruction.kind == Instruction::skip)
              {
                first_branches.emplace_back(i + instruction.n_skipped + 1, stack.back());
                stack.pop_back();
              }
            else
              {
                const std::vector<Lines> arguments(stack.end() - instruction.n_arguments, stack.end());
                stack.resize(stack.size() - instruction.n_arguments);
                stack.push_back(result_of(instruction, arguments));
              }
          }
      }

    private:
      const std::vector<Instruction>            &program;
      std::vector<Interval>                     &places;
      std::vector<Lines>                         stack;
      std::vector<std::pair<std::size_t, Lines>> first_branches; ///< and where the second ones end

      static std::string
      name_of(const Instruction &i)
      {
        return i.op != nullptr ? i.op->name : "";
      }

      void
      add_places(const Lines &a, const Lines &b)
      {
        are_known = are_known && !a.empty() && !b.empty();
        for (const auto &x : a)
          for (const auto &y : b)
            if (const Line d = sum(x, scaled(y, -1)); d.slope_size != 0)
              {
                const double place  = -d.value / d.slope,
                             margin = 1e-12 * (d.value_size + d.slope_size * std::abs(place)) / std::abs(d.slope);
                are_known           = are_known && std::isfinite(place) && std::isfinite(margin);
                places.push_back({place - margin, place + margin});
              }
      }

      Lines
      result_of(const Instruction &instruction, const std::vector<Lines> &arguments)
      {
        const std::string name = name_of(instruction);
        if (instruction.table)
          {
            for (unsigned int j = 0; j < arguments.size(); ++j)
              for (const double corner : instruction.table->corners(j))
                add_places(arguments[j], constant_line(corner));
            return {};
          }
        if (name == "negative")
          return opposite(arguments[0]);
        if (!instruction.has_pieces())
          return smooth_result(name, arguments);
        add_places_of_pieces(name, arguments);
        return result_by_pieces(name, arguments);
      }

      void
      add_places_of_pieces(const std::string &name, const std::vector<Lines> &arguments)
      {
        if (name == "abs" || name == "sign")
          add_places(arguments[0], {Line()});
        else if (name == "saturate" || name == "deadband")
          {
            add_places(arguments[0], arguments[1]);
            add_places(arguments[0], name == "saturate" ? arguments[2] : opposite(arguments[1]));
          }
        else if (name.find_first_of("<>=!") == 0 || name == "min" || name == "max")
          {
            for (std::size_t j = 1; j < arguments.size(); ++j)
              for (std::size_t k = 0; k < j; ++k)
                add_places(arguments[k], arguments[j]);
          }
        else
          are_known = false; // floor() and the like switch again and again
      }
    };
  } // namespace



  void
  Formula::find_switches()
  {
    has_pieces = std::any_of(program.begin(), program.end(), [](const Instruction &i) { return i.has_pieces(); });
    if (!has_pieces)
      return;
    SwitchFinder<Instruction, Interval> finder(program, places);
    finder.run();
    places_known = finder.are_known;
    if (!places_known)
      places.clear();
    std::sort(places.begin(), places.end(), [](const Interval &a, const Interval &b) { return a.end < b.end; });
  }



  std::vector<Formula>
  Formula::switches_of_first_variable() const
  {
    // what is on the stack: where its instructions begin, and whether other variables occur in them
    struct Part
    {
      std::size_t begin;
      bool        has_others;
    };
    struct Branch
    {
      std::size_t end; ///< of the second one
      Part        both;
    };
    std::vector<Part>    stack, conditions;
    std::vector<Branch>  branches;
    std::vector<Formula> result;
    for (std::size_t i = 0; i < program.size(); ++i)
      {
        const Instruction &instruction = program[i];
        for (; !branches.empty() && branches.back().end == i; branches.pop_back())
          stack.back() = {branches.back().both.begin, branches.back().both.has_others || stack.back().has_others};
        if (instruction.kind == Instruction::number || instruction.kind == Instruction::variable)
          stack.push_back({i, instruction.kind == Instruction::variable && instruction.index > 0});
        else if (instruction.kind == Instruction::skip_if_zero)
          {
            conditions.push_back(stack.back());
            stack.pop_back();
          }
        else if (instruction.kind == Instruction::skip)
          {
            const Part condition = conditions.back();
            conditions.pop_back();
            branches.push_back(
              {i + instruction.n_skipped + 1, {condition.begin, condition.has_others || stack.back().has_others}});
            stack.pop_back();
          }
        else
          {
            Part part = stack[stack.size() - instruction.n_arguments];
            for (unsigned int k = 1; k < instruction.n_arguments; ++k)
              part.has_others = part.has_others || stack[stack.size() - k].has_others;
            part.has_others = part.has_others || stack.back().has_others;
            stack.resize(stack.size() - instruction.n_arguments);
            stack.push_back(part);
            if (instruction.has_pieces() && !part.has_others)
              {
                Formula formula;
                formula.program.assign(program.begin() + part.begin, program.begin() + i + 1);
                formula.find_switches();
                if (!formula.is_constant())
                  result.push_back(formula);
              }
          }
      }
    return result;
  }
} // namespace samara
