#include <samara/base/placed.h>
#include <samara/base/text.h>

namespace samara
{
  namespace
  {
    /** c·texts + offset as an expression; one component alone stays as it is. */
    std::string
    combination(const std::array<std::string, 3> &texts, const Eigen::RowVector3d &c, const double offset)
    {
      std::string sum;
      for (unsigned int j = 0; j < 3; ++j)
        if (c(j) != 0 && texts[j] != "0")
          {
            if (c(j) == 1 && offset == 0 && c.squaredNorm() == 1)
              return texts[j];
            const std::string factor = c(j) == 1 ? "" : "(" + number_to_text(c(j)) + ")*";
            sum += (sum.empty() ? "" : " + ") + factor + "(" + texts[j] + ")";
          }
      if (sum.empty())
        return number_to_text(offset);
      return offset == 0 ? sum : sum + " + (" + number_to_text(offset) + ")";
    }

    /** The same of three functions: constants become a constant. */
    template <typename Function>
    std::array<Function, 3>
    placed_functions(const std::array<Function, 3> &f, const Placement &placement, const bool is_position)
    {
      std::array<std::string, 3> texts;
      for (unsigned int j = 0; j < 3; ++j)
        texts[j] = f[j].is_constant() ? number_to_text(f[j](0.)) : f[j].formula_text();
      std::array<Function, 3> result;
      for (unsigned int i = 0; i < 3; ++i)
        {
          const Eigen::RowVector3d c      = placement.rotation.row(i);
          const double             offset = is_position ? placement.origin(i) : 0.;
          bool                     is_constant = true;
          double                   value       = offset;
          for (unsigned int j = 0; j < 3; ++j)
            if (c(j) != 0)
              {
                is_constant = is_constant && f[j].is_constant();
                value += f[j].is_constant() ? c(j) * f[j](0.) : 0.;
              }
          result[i] = is_constant ? Function(value) : Function(combination(texts, c, offset));
        }
      return result;
    }
  } // namespace



  Eigen::Vector3d
  Placed<Eigen::Vector3d>::of(const Eigen::Vector3d &value, const Placement &placement, const bool is_position)
  {
    return is_position ? placement.point(value) : Eigen::Vector3d(placement.rotation * value);
  }



  std::vector<Eigen::Vector3d>
  Placed<std::vector<Eigen::Vector3d>>::of(const std::vector<Eigen::Vector3d> &value,
                                           const Placement                    &placement,
                                           const bool                          is_position)
  {
    std::vector<Eigen::Vector3d> result;
    for (const auto &x : value)
      result.push_back(Placed<Eigen::Vector3d>::of(x, placement, is_position));
    return result;
  }



  std::array<Expression, 3>
  Placed<std::array<Expression, 3>>::of(const std::array<Expression, 3> &value,
                                        const Placement                 &placement,
                                        const bool                       is_position)
  {
    return placed_functions(value, placement, is_position);
  }



  std::array<FunctionOfTime, 3>
  Placed<std::array<FunctionOfTime, 3>>::of(const std::array<FunctionOfTime, 3> &value,
                                            const Placement                     &placement,
                                            const bool                           is_position)
  {
    return placed_functions(value, placement, is_position);
  }



  std::array<Law, 3>
  Placed<std::array<Law, 3>>::of(const std::array<Law, 3> &value, const Placement &placement, const bool is_position)
  {
    std::array<Law, 3> result;
    for (unsigned int i = 0; i < 3; ++i)
      result[i] = Law::combination(value, placement.rotation.row(i), is_position ? placement.origin(i) : 0.);
    return result;
  }
} // namespace samara
