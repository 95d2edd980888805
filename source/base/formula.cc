#include <samara/base/formula.h>
#include <samara/base/text.h>
#include <samara/base/tokens.h>

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

namespace samara
{
  /** Recursive descent: each function reads one kind of phrase and appends the instructions that compute it. */
  class Formula::Compiler
  {
  public:
    Compiler(const std::string &text, const std::vector<std::string> &variables)
      : text(text)
      , variables(variables)
      , tokens(tokens_of(text))
    {}

    std::vector<Instruction>
    compile()
    {
      choice();
      if (position != tokens.size())
        fail(tokens[position].text == "," ? "one number is wanted here" :
                                            "cannot go on at <" + tokens[position].text + ">");
      return program;
    }

  private:
    /** condition ? this : that, as: condition, skip_if_zero, this, skip, that */
    void
    choice()
    {
      const auto first = program.size();
      operations(1);
      if (!accept("?"))
        return;
      const auto branch = append_skip(Instruction::skip_if_zero);
      choice();
      expect(":");
      const auto jump = append_skip(Instruction::skip);
      choice();
      program[branch].n_skipped = jump - branch;
      program[jump].n_skipped   = program.size() - jump - 1;
      if (branch == first + 1 && program[first].kind == Instruction::number)
        keep_branch(first, branch, jump);
      else
        n_settled = program.size();
    }

    /** The condition is a number: only one of the branches is left. */
    void
    keep_branch(const std::size_t first, const std::size_t branch, const std::size_t jump)
    {
      const bool holds = program[first].value != 0;
      const auto begin = program.begin();
      if (holds)
        program.erase(begin + jump, program.end());
      program.erase(begin + first, begin + (holds ? branch : jump) + 1);
      if (program.size() > first + 1)
        n_settled = program.size();
      else
        n_settled = std::min(n_settled, first);
    }

    /** Operands with binary operators between them that bind at least as close as @p precedence. */
    void
    operations(const unsigned int precedence)
    {
      signed_operand();
      while (const JetOperation *op = operator_here(precedence))
        {
          ++position;
          operations(op->precedence + 1);
          append(*op, 2);
        }
    }

    /** A sign binds weaker than a power: -2^2 is -4. */
    void
    signed_operand()
    {
      if (accept("-"))
        {
          signed_operand();
          append(jet_negative(), 1);
        }
      else if (accept("+"))
        signed_operand();
      else
        power();
    }

    /** 2^3^2 is 2^9, and 2^-1 a half. */
    void
    power()
    {
      operand();
      const JetOperation *op = operator_here(power_precedence);
      if (op != nullptr)
        {
          ++position;
          signed_operand();
          append(*op, 2);
        }
    }

    void
    operand()
    {
      if (position == tokens.size())
        fail("something is missing at the end");
      const Token token = tokens[position++];
      if (token.kind == Token::number)
        append_number(token.text);
      else if (token.kind == Token::function)
        function_call(token.text);
      else if (token.kind == Token::word)
        append_variable(token.text);
      else if (token.text == "(")
        {
          choice();
          expect(")");
        }
      else
        fail("a number is missing before <" + token.text + ">");
    }

    void
    function_call(const std::string &name)
    {
      if (name == table_function)
        return look_up();
      const auto &all = jet_functions();
      const auto  f   = std::find_if(all.begin(), all.end(), [&](const auto &g) { return g.name == name; });
      expect("(");
      unsigned int n = 0;
      do
        {
          choice();
          ++n;
        }
      while (accept(","));
      expect(")");
      if (n < f->min_arguments || n > f->max_arguments)
        fail("<" + name + "> does not take " + std::to_string(n) + (n == 1 ? " argument" : " arguments"));
      const auto is_number = [&](const unsigned int i) {
        return program.size() >= n_settled + n && program[program.size() - i].kind == Instruction::number;
      };
      if (name == "saturate" && is_number(1) && is_number(2) && program.end()[-2].value > program.end()[-1].value)
        fail("the lower limit of <saturate> is above the upper one");
      if (name == "deadband" && is_number(1) && program.back().value < 0)
        fail("the width of <deadband> is negative");
      append(*f, n);
    }

    /** Its name has been read. */
    void
    look_up()
    {
      const TableCall call = table_call(tokens, position - 1);
      for (const auto &[begin, end] : call.arguments)
        {
          position = begin;
          choice();
          if (position != end)
            fail("cannot go on at <" + tokens[position].text + ">");
        }
      position = call.end;
      Instruction instruction{Instruction::look_up};
      instruction.n_arguments = call.arguments.size();
      instruction.table       = LookUp::of_file(call.file, instruction.n_arguments, call.is_cubic);
      append(instruction);
    }

    const JetOperation *
    operator_here(const unsigned int precedence) const
    {
      if (position < tokens.size() && tokens[position].kind == Token::symbol)
        for (const auto &op : jet_operators())
          if (op.name == tokens[position].text && op.precedence >= precedence)
            return &op;
      return nullptr;
    }

    bool
    accept(const std::string &symbol)
    {
      const bool here =
        position < tokens.size() && tokens[position].kind == Token::symbol && tokens[position].text == symbol;
      position += here ? 1 : 0;
      return here;
    }

    void
    expect(const std::string &symbol)
    {
      if (!accept(symbol))
        fail("a <" + symbol + "> is missing");
    }

    void
    append_number(const std::string &digits)
    {
      double value = 0;
      if (!text_to_number(digits, value))
        fail("<" + digits + "> is too large or too small a number");
      grow();
      program.push_back({Instruction::number, value});
    }

    void
    append_variable(const std::string &name)
    {
      const auto found = std::find(variables.begin(), variables.end(), name);
      if (found == variables.end())
        fail("<" + name + "> is not known" + (variables.empty() ? "" : "; the variable is <" + variables[0] + ">"));
      grow();
      program.push_back({Instruction::variable});
      program.back().index = found - variables.begin();
    }

    /** What is skipped is not known yet. The number on top goes: a condition, or the other branch has its own. */
    std::size_t
    append_skip(const Instruction::Kind kind)
    {
      --depth;
      program.push_back({kind});
      return program.size() - 1;
    }

    /**
     * What is constant is computed now. That saves time, and keeps the derivatives of a part like sqrt(0), which do not
     * exist, out of the derivatives of the whole. A number at the end of a branch is no constant.
     */
    void
    append(const Instruction &instruction)
    {
      const unsigned int n = instruction.n_arguments;
      depth -= n - 1;
      const auto is_number = [](const Instruction &i) { return i.kind == Instruction::number; };
      const auto first     = program.end() - n;
      if (program.size() < n_settled + n || !std::all_of(first, program.end(), is_number))
        return program.push_back(instruction);

      std::vector<Jet> arguments;
      for (auto i = first; i != program.end(); ++i)
        arguments.push_back({i->value, 0, 0});
      program.erase(first, program.end());
      program.push_back({Instruction::number, instruction.result(arguments.data()).value});
    }

    void
    append(const JetOperation &operation, const unsigned int n_arguments)
    {
      append({Instruction::operation, 0, &operation, n_arguments});
    }

    void
    grow()
    {
      if (++depth > stack_size)
        fail("this is too long; name parts of it as constants");
    }

    [[noreturn]] void
    fail(const std::string &why) const
    {
      throw std::invalid_argument("<" + text + ">: " + why + ".");
    }

    static constexpr unsigned int power_precedence = 6;

    const std::string              text;
    const std::vector<std::string> variables;
    const std::vector<Token>       tokens;
    std::size_t                    position = 0;
    unsigned int                   depth    = 0;
    std::vector<Instruction>       program;
    std::size_t                    n_settled = 0; ///< instructions up to the end of the last ?:, not to be looked into
  };



  Formula::Formula(const double constant)
    : program{{Instruction::number, constant}}
  {}



  Formula::Formula(const std::string &text, const std::vector<std::string> &variables)
    : program(Compiler(text, variables).compile())
  {
    find_switches();
  }



  template <typename Visit>
  Jet
  Formula::run(const double *const variables, const unsigned int i, const Visit &visit) const
  {
    std::array<Jet, stack_size + 1> stack;
    Jet                            *top = stack.data();
    for (auto instruction = program.begin(); instruction != program.end(); ++instruction)
      switch (instruction->kind)
        {
          case Instruction::number:
            *top++ = {instruction->value, 0, 0};
            break;
          case Instruction::variable:
            *top++ = {variables[instruction->index], instruction->index == i ? 1. : 0., 0};
            break;
          case Instruction::operation:
          case Instruction::look_up:
            top -= instruction->n_arguments;
            visit(*instruction, top);
            *top = instruction->result(top);
            ++top;
            break;
          case Instruction::skip:
            instruction += instruction->n_skipped;
            break;
          case Instruction::skip_if_zero:
            --top;
            instruction += top->value == 0 ? instruction->n_skipped : 0;
            break;
        }
    return stack[0];
  }



  Jet
  Formula::at(const double *const variables, const unsigned int i) const
  {
    return run(variables, i, [](const Instruction &, const Jet *) {});
  }



  bool
  Formula::is_constant() const
  {
    return std::none_of(program.begin(), program.end(), [](const Instruction &i) {
      return i.kind == Instruction::variable;
    });
  }



  bool
  Formula::uses(const unsigned int i) const
  {
    return std::any_of(program.begin(), program.end(), [&](const Instruction &instruction) {
      return instruction.kind == Instruction::variable && instruction.index == i;
    });
  }



  void
  Formula::pieces(const double *const variables, std::vector<double> &result) const
  {
    result.clear();
    run(variables, 0, [&](const Instruction &instruction, const Jet *const arguments) {
      if (instruction.has_pieces())
        result.push_back(instruction.piece_at(arguments));
    });
  }



  double
  Formula::next_corner(const double from, const double to) const
  {
    const double none = std::numeric_limits<double>::infinity();
    if (!has_pieces || (places_known && std::none_of(places.begin(), places.end(), [&](const Interval &place) {
                          return place.begin <= to && place.end >= from;
                        })))
      return none;
    std::vector<double> here, there;
    pieces(&from, here);
    const auto is_here = [&](const double x) {
      pieces(&x, there);
      return there == here;
    };

    double     left = from, right = to;
    const auto is_here_up_to = [&](const double x) {
      right = x;
      if (!is_here(x))
        return false;
      left = x;
      return true;
    };
    bool is_none = true;
    if (places_known)
      {
        for (auto place = places.begin(); is_none && place != places.end(); ++place)
          if (place->end > from && place->end < to)
            is_none = is_here_up_to(place->end);
      }
    else
      {
        const unsigned int n_places = 64;
        for (unsigned int k = 1; is_none && k < n_places; ++k)
          is_none = is_here_up_to(from + k * (to - from) / n_places);
      }
    if (is_none && is_here_up_to(to))
      return none;

    // down to neighbouring numbers; the limit is for a corner at 0, which has too many neighbours
    for (unsigned int i = 0; i < 200; ++i)
      {
        const double middle = left + 0.5 * (right - left);
        if (middle <= left || middle >= right)
          break;
        (is_here(middle) ? left : right) = middle;
      }
    return right;
  }
} // namespace samara
