#include <samara/base/formula.h>
#include <samara/base/text.h>
#include <samara/base/tokens.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace samara
{
  /** Recursive descent: each function reads one kind of phrase and appends the instructions that compute it. */
  class Formula::Compiler
  {
  public:
    Compiler(const std::string &text, const std::string &variable)
      : text(text)
      , variable(variable)
      , tokens(tokens_of(text))
    {}

    std::vector<Instruction>
    compile()
    {
      choice();
      if (position != tokens.size())
        fail("cannot go on at <" + tokens[position].text + ">");
      return program;
    }

  private:
    /** condition ? this : that */
    void
    choice()
    {
      operations(1);
      if (accept("?"))
        {
          choice();
          expect(":");
          choice();
          append(jet_choice, 3);
        }
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
          append(op->apply, 2);
        }
    }

    /** A sign binds weaker than a power: -2^2 is -4. */
    void
    signed_operand()
    {
      if (accept("-"))
        {
          signed_operand();
          append(jet_negative, 1);
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
          append(op->apply, 2);
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
      else if (token.kind == Token::word && token.text == variable)
        append_variable();
      else if (token.kind == Token::word)
        fail("<" + token.text + "> is not known; the variable is <" + variable + ">");
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
      append(f->apply, n);
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
      program.push_back({Instruction::number, value, nullptr, 0});
    }

    void
    append_variable()
    {
      grow();
      program.push_back({Instruction::variable, 0, nullptr, 0});
    }

    /**
     * What is constant is computed now. That saves time, and keeps the derivatives of a part like sqrt(0), which do not
     * exist, out of the derivatives of the whole.
     */
    void
    append(const JetOperation::Function apply, const unsigned int n_arguments)
    {
      depth -= n_arguments - 1;
      const auto is_number = [](const Instruction &i) { return i.kind == Instruction::number; };
      const auto first     = program.end() - n_arguments;
      if (!std::all_of(first, program.end(), is_number))
        return program.push_back({Instruction::operation, 0, apply, n_arguments});

      std::vector<Jet> arguments;
      for (auto i = first; i != program.end(); ++i)
        arguments.push_back({i->value, 0, 0});
      program.erase(first, program.end());
      program.push_back({Instruction::number, apply(arguments.data(), n_arguments).value, nullptr, 0});
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

    const std::string        text;
    const std::string        variable;
    const std::vector<Token> tokens;
    std::size_t              position = 0;
    unsigned int             depth    = 0;
    std::vector<Instruction> program;
  };



  Formula::Formula(const double constant)
    : program{{Instruction::number, constant, nullptr, 0}}
  {}



  Formula::Formula(const std::string &text, const std::string &variable)
    : program(Compiler(text, variable).compile())
  {}



  Jet
  Formula::operator()(const double x) const
  {
    std::array<Jet, stack_size + 1> stack;
    Jet                            *top = stack.data();
    for (const auto &instruction : program)
      switch (instruction.kind)
        {
          case Instruction::number:
            *top++ = {instruction.value, 0, 0};
            break;
          case Instruction::variable:
            *top++ = {x, 1, 0};
            break;
          case Instruction::operation:
            top -= instruction.n_arguments;
            *top = instruction.apply(top, instruction.n_arguments);
            ++top;
            break;
        }
    return stack[0];
  }



  bool
  Formula::is_constant() const
  {
    return std::none_of(program.begin(), program.end(), [](const Instruction &i) {
      return i.kind == Instruction::variable;
    });
  }
} // namespace samara
