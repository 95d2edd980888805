#include <samara/base/jet.h>
#include <samara/base/text.h>
#include <samara/base/tokens.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>

namespace samara
{
  namespace
  {
    // who reads what this makes goes as deep as it is nested, and has a stack that ends
    constexpr std::size_t  most_tokens         = 5000;
    constexpr unsigned int deepest_parenthesis = 1000;

    bool
    is_digit(const char c)
    {
      return std::isdigit(static_cast<unsigned char>(c)) != 0;
    }

    bool
    is_letter(const char c)
    {
      return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
    }

    /** The length of the number at @p i: digits with a point and an exponent, if digits follow the e. */
    std::size_t
    number_length(const std::string &text, const std::size_t begin)
    {
      std::size_t i      = begin;
      const auto  digits = [&]() {
        while (i < text.size() && is_digit(text[i]))
          ++i;
      };
      digits();
      if (i < text.size() && text[i] == '.')
        ++i;
      digits();
      if (i < text.size() && (text[i] == 'e' || text[i] == 'E'))
        {
          const bool signed_exponent = i + 1 < text.size() && (text[i + 1] == '+' || text[i + 1] == '-');
          const auto first           = i + (signed_exponent ? 2 : 1);
          if (first < text.size() && is_digit(text[first]))
            {
              i = first;
              digits();
            }
        }
      return i - begin;
    }

    std::size_t
    word_length(const std::string &text, const std::size_t begin)
    {
      std::size_t i = begin;
      while (i < text.size() && (is_letter(text[i]) || is_digit(text[i])))
        ++i;
      return i - begin;
    }

    /** The length of the operator at @p i, or 0 if there is none. */
    std::size_t
    symbol_length(const std::string &text, const std::size_t i)
    {
      for (const std::string two : {"<=", ">=", "==", "!=", "&&", "||"})
        if (text.compare(i, 2, two) == 0)
          return 2;
      return std::string("+-*/^()<>,?:").find(text[i]) == std::string::npos ? 0 : 1;
    }

    /** One character to be shown, which takes several bytes if it is not ASCII. */
    std::string
    character_at(const std::string &text, const std::size_t i)
    {
      std::size_t end = i + 1;
      while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0u) == 0x80u)
        ++end;
      return text.substr(i, end - i);
    }

    Token
    token_at(const std::string &text, const std::size_t i)
    {
      const char c = text[i];
      if (is_digit(c) || (c == '.' && i + 1 < text.size() && is_digit(text[i + 1])))
        return {Token::number, text.substr(i, number_length(text, i))};
      if (is_letter(c))
        return {Token::word, text.substr(i, word_length(text, i))};
      if (c == '%')
        return {Token::word, "%"};
      if (c == '"')
        {
          const auto end = text.find('"', i + 1);
          if (end == std::string::npos)
            throw std::invalid_argument("<" + text + ">: a <\"> is not closed.");
          return {Token::string, text.substr(i, end + 1 - i)};
        }
      if (const auto length = symbol_length(text, i))
        return {Token::symbol, text.substr(i, length)};
      throw std::invalid_argument("<" + text + ">: <" + character_at(text, i) + "> has no meaning here.");
    }

    bool
    is_symbol(const Token &token, const char *const symbol)
    {
      return token.kind == Token::symbol && token.text == symbol;
    }

    bool
    ends_operand(const Token &token)
    {
      return token.kind == Token::number || token.kind == Token::word || is_symbol(token, ")");
    }

    bool
    begins_operand(const Token &token)
    {
      return (token.kind != Token::symbol && token.kind != Token::string) || is_symbol(token, "(");
    }

    std::vector<Token>
    plain_tokens(const std::string &text)
    {
      std::vector<Token> tokens;
      bool               after_blank = false;
      for (std::size_t i = 0; i < text.size();)
        if (std::isspace(static_cast<unsigned char>(text[i])))
          {
            after_blank = true;
            ++i;
          }
        else
          {
            tokens.push_back(token_at(text, i));
            tokens.back().after_blank = after_blank;
            after_blank               = false;
            i += tokens.back().text.size();
          }
      return tokens;
    }

    void
    mark_functions(const std::string &text, std::vector<Token> &tokens)
    {
      const auto functions = function_names();
      for (std::size_t i = 0; i + 1 < tokens.size(); ++i)
        if (tokens[i].kind == Token::word && is_symbol(tokens[i + 1], "("))
          {
            const auto &name = tokens[i].text;
            if (std::find(functions.begin(), functions.end(), name) != functions.end())
              tokens[i].kind = Token::function;
            else if (!tokens[i + 1].after_blank && name != "%")
              throw std::invalid_argument("<" + text + ">: <" + name + "> is not a function" +
                                          did_you_mean(name, functions) + " To multiply, write <" + name + "*(...)>.");
          }
    }

    void
    check_parentheses(const std::string &text, const std::vector<Token> &tokens)
    {
      if (tokens.size() > most_tokens)
        throw std::invalid_argument("<" + text + ">: this is too long; name parts of it as constants.");
      unsigned int depth = 0;
      for (const auto &token : tokens)
        {
          if (depth == 0 && is_symbol(token, ")"))
            throw std::invalid_argument("<" + text + ">: a <)> has no <(>.");
          depth += is_symbol(token, "(") - is_symbol(token, ")");
          if (depth > deepest_parenthesis)
            throw std::invalid_argument("<" + text + ">: parentheses are nested too deeply.");
        }
      if (depth > 0)
        throw std::invalid_argument("<" + text + ">: a <(> is not closed.");
    }
  } // namespace



  const std::string table_function = "table";



  std::vector<Token>
  tokens_of(const std::string &text)
  {
    auto tokens = plain_tokens(text);
    if (tokens.empty())
      throw std::invalid_argument("a value is missing.");
    mark_functions(text, tokens);
    for (std::size_t i = 0; i < tokens.size(); ++i)
      if (tokens[i].kind == Token::string && (i < 2 || tokens[i - 2].kind != Token::function ||
                                              tokens[i - 2].text != table_function || !is_symbol(tokens[i - 1], "(")))
        throw std::invalid_argument("<" + text + ">: the name of a file stands in <table(\"file.csv\", x)> only.");
    check_parentheses(text, tokens);

    std::vector<Token> complete;
    for (const auto &token : tokens)
      {
        if (!complete.empty() && ends_operand(complete.back()) && begins_operand(token))
          {
            if (token.kind == Token::number)
              throw std::invalid_argument("<" + text + ">: an operator is missing before <" + token.text + ">.");
            complete.push_back({Token::symbol, "*", false, true});
          }
        complete.push_back(token);
      }
    return complete;
  }



  TableCall
  table_call(const std::vector<Token> &tokens, const std::size_t at)
  {
    const auto fail = [](const std::string &why) { throw std::invalid_argument("<table>: " + why); };
    TableCall  call;
    if (at + 2 >= tokens.size() || tokens[at + 2].kind != Token::string)
      fail("the name of a file is wanted first, <table(\"file.csv\", x)>.");
    const std::string &quoted = tokens[at + 2].text;
    call.file                 = quoted.substr(1, quoted.size() - 2);

    // parentheses are known to be closed
    std::size_t  i = at + 3, begin = i + 1;
    unsigned int depth = 1;
    if (!is_symbol(tokens[i], ","))
      fail("a <,> is wanted behind the name of the file.");
    for (++i; depth > 0; ++i)
      {
        depth += is_symbol(tokens[i], "(") - is_symbol(tokens[i], ")");
        if (depth > (is_symbol(tokens[i], ",") ? 1 : 0))
          continue;
        call.arguments.emplace_back(begin, i);
        begin = i + 1;
      }
    call.end = i;

    const auto &last = call.arguments.back();
    if (last.second == last.first + 1 && tokens[last.first].kind == Token::word &&
        (tokens[last.first].text == "cubic" || tokens[last.first].text == "linear"))
      {
        call.is_cubic = tokens[last.first].text == "cubic";
        call.arguments.pop_back();
      }
    if (call.arguments.empty() || call.arguments.size() > 2)
      fail("one or two arguments are wanted behind the name of the file, not " + std::to_string(call.arguments.size()) +
           ".");
    if (call.is_cubic && call.arguments.size() == 2)
      fail("<cubic> is of one argument; of two it is linear in each.");
    return call;
  }



  std::string
  with_tables_beside(const std::string &text, const std::string &where)
  {
    std::string result;
    std::size_t from = 0;
    for (std::size_t open = 0; (open = text.find('"', from)) != std::string::npos;)
      {
        const std::size_t close = text.find('"', open + 1);
        if (close == std::string::npos)
          break;
        const std::string before = trim(text.substr(0, open));
        const bool        is_of_table =
          before.size() > table_function.size() && before.back() == '(' &&
          trim(before.substr(0, before.size() - 1)).rfind(table_function) + table_function.size() ==
            trim(before.substr(0, before.size() - 1)).size();
        std::string name = text.substr(open + 1, close - open - 1);
        if (is_of_table && !trim(name).empty())
          {
            std::error_code ignored;
            name                = file_beside(where.substr(0, where.rfind(':')), trim(name));
            const auto absolute = std::filesystem::absolute(name, ignored);
            name                = ignored ? name : absolute.string();
          }
        result += text.substr(from, open - from) + '"' + name + '"';
        from = close + 1;
      }
    return result + text.substr(from);
  }



  std::vector<std::string>
  function_names()
  {
    std::vector<std::string> names;
    for (const auto &function : jet_functions())
      names.push_back(function.name);
    names.push_back(table_function);
    return names;
  }
} // namespace samara
