// What dimension a formula has.

#include <samara/base/formula.h>

#include <algorithm>

namespace samara
{
  namespace
  {
    constexpr Dimension number_alone = {{0, 0, 0, 0, 0}};

    /** A value, its dimension, and whether a free variable is in it. */
    struct Measured
    {
      double    value     = 0;
      Dimension dimension = number_alone;
      bool      is_free   = false;

      /** A zero has any dimension, unless it is one by chance. */
      bool
      is_zero() const
      {
        return value == 0 && !is_free;
      }
      bool
      is_number() const
      {
        return is_zero() || same_but_angle(dimension, number_alone);
      }
    };

    Dimension
    combined(const Dimension &a, const Dimension &b, const double factor_of_a, const double factor_of_b)
    {
      Dimension result;
      for (unsigned int i = 0; i < result.size(); ++i)
        result[i] = factor_of_a * a[i] + factor_of_b * b[i];
      return result;
    }

    /** The dimension that all of @p x have; false if there is none. */
    bool
    find_common(const std::vector<Measured> &x, Dimension &common)
    {
      common     = number_alone;
      bool first = true;
      for (const auto &one : x)
        if (!one.is_zero())
          {
            if (!first && !same_but_angle(one.dimension, common))
              return false;
            const double angle = one.dimension[angle_exponent];
            if (first)
              common = one.dimension;
            else if (angle != common[angle_exponent])
              common[angle_exponent] = 0;
            first = false;
          }
      return true;
    }

    /** The dimension of @p operation on @p x; false if it does not take them. */
    bool
    find_result(const JetOperation &operation, const std::vector<Measured> &x, Dimension &result)
    {
      const auto is_number = [](const Measured &one) { return one.is_number(); };
      result               = number_alone;
      Dimension ignored;
      switch (operation.rule)
        {
          case DimensionRule::numbers:
            return std::all_of(x.begin(), x.end(), is_number);
          case DimensionRule::alike:
            return find_common(x, result);
          case DimensionRule::ratio:
            return find_common(x, ignored);
          case DimensionRule::comparison:
            return std::any_of(x.begin(), x.end(), is_number) || find_common(x, ignored);
          case DimensionRule::any:
            return true;
          case DimensionRule::product:
            result = combined(x[0].dimension, x[1].dimension, 1, 1);
            return true;
          case DimensionRule::quotient:
            result = combined(x[0].dimension, x[1].dimension, 1, -1);
            return true;
          case DimensionRule::square_root:
            result = combined(x[0].dimension, number_alone, 0.5, 0);
            return true;
          case DimensionRule::power:
            // two to the time that passes is a number, a length to it is nothing
            if (!x[1].is_free)
              result = combined(x[0].dimension, number_alone, x[1].value, 0);
            return x[1].is_number() && (!x[1].is_free || x[0].is_number());
        }
      return false;
    }

    /** The dimension of a table's value; false if its arguments are not those of its columns. */
    bool
    find_result(const LookUp &table, const std::vector<Measured> &x, Dimension &result)
    {
      const auto &columns = table.dimensions();
      result              = columns.back();
      for (std::size_t i = 0; i < x.size(); ++i)
        if (!x[i].is_zero() && !same_but_angle(x[i].dimension, columns[i]))
          return false;
      return true;
    }

    /** What @p instruction makes of @p x; what does not fit makes @p is_consistent false. */
    template <typename Instruction>
    Measured
    result_of(const Instruction &instruction, const std::vector<Measured> &x, bool &is_consistent)
    {
      std::vector<Jet> arguments;
      Measured         result;
      for (const auto &one : x)
        {
          arguments.push_back({one.value, 0, 0});
          result.is_free = result.is_free || one.is_free;
        }
      result.value  = instruction.result(arguments.data()).value;
      is_consistent = (instruction.table ? find_result(*instruction.table, x, result.dimension) :
                                           find_result(*instruction.op, x, result.dimension)) &&
                      is_consistent;
      return result;
    }

    /** The first branch of a ?:, which is on the stack until the second one has been measured. */
    struct FirstBranch
    {
      std::size_t end_of_second;
      Measured    condition, result;
    };

    /** A bare number in one branch has the dimension of the other: "copy == 1 ? 0.01 : damper". */
    Measured
    either(const FirstBranch &first, const Measured &second, bool &is_consistent)
    {
      Measured result;
      if (first.result.is_number() || second.is_number())
        result.dimension = first.result.is_number() ? second.dimension : first.result.dimension;
      else
        is_consistent = find_common({first.result, second}, result.dimension) && is_consistent;
      result.value   = first.condition.value != 0 ? first.result.value : second.value;
      result.is_free = first.condition.is_free || first.result.is_free || second.is_free;
      return result;
    }
  } // namespace



  Formula::Dimensions
  Formula::dimensions(const std::vector<double>    &values,
                      const std::vector<Dimension> &of_variables,
                      const std::vector<bool>      &free) const
  {
    Dimensions               all;
    std::vector<Measured>    stack, conditions;
    std::vector<FirstBranch> branches;
    const auto               take = [](std::vector<Measured> &from) {
      const Measured last = from.back();
      from.pop_back();
      return last;
    };
    for (std::size_t i = 0; i <= program.size(); ++i)
      {
        for (; !branches.empty() && branches.back().end_of_second == i; branches.pop_back())
          stack.back() = either(branches.back(), stack.back(), all.is_consistent);
        if (i == program.size())
          break;
        const Instruction &instruction = program[i];
        const auto         k           = instruction.index;
        switch (instruction.kind)
          {
            case Instruction::number:
              stack.push_back({instruction.value});
              break;
            case Instruction::variable:
              stack.push_back({values[k], of_variables[k], free[k]});
              break;
            case Instruction::skip_if_zero:
              conditions.push_back(take(stack));
              break;
            case Instruction::skip:
              branches.push_back({i + instruction.n_skipped + 1, take(conditions), take(stack)});
              break;
            case Instruction::operation:
            case Instruction::look_up:
              const std::vector<Measured> x(stack.end() - instruction.n_arguments, stack.end());
              stack.resize(stack.size() - x.size());
              stack.push_back(result_of(instruction, x, all.is_consistent));
          }
      }
    all.result = stack.back().dimension;
    return all;
  }
} // namespace samara
