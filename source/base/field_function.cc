#include <samara/base/field_function.h>

#include <algorithm>
#include <limits>

namespace samara
{
  const std::vector<std::string> FieldFunction::variables = {"t", "x", "y", "z"};



  FieldFunction::FieldFunction(const double constant)
  {
    auto own     = std::make_shared<Parts>();
    own->source  = number_to_text(constant);
    own->formula = Formula(constant);
    own->is_zero = constant == 0;
    parts        = own;
  }



  FieldFunction::FieldFunction(const std::string &text)
  {
    const std::string &table    = ScalarFunction::table_prefix;
    const bool         is_table = trim(text).compare(0, table.size(), table) == 0;

    auto own     = std::make_shared<Parts>();
    own->source  = text;
    own->formula = Formula(is_table ? ScalarFunction(trim(text), "t").formula_text() : text, variables);
    for (unsigned int i = 1; i < variables.size(); ++i)
      own->depends_on_place = own->depends_on_place || own->formula.uses(i);
    if (own->formula.is_constant())
      own->is_zero = own->formula.at(std::array<double, 4>{}.data(), 0).value == 0;
    else if (!own->depends_on_place)
      own->of_time.emplace_back(trim(text), "t");
    else
      for (const auto &part : own->formula.switches_of_first_variable())
        own->of_time.emplace_back(part);
    parts = own;
  }



  Eigen::Vector3d
  FieldFunction::gradient(const Eigen::Vector3d &x, const double t) const
  {
    Eigen::Vector3d result = Eigen::Vector3d::Zero();
    const double    at[4]  = {t, x(0), x(1), x(2)};
    for (unsigned int i = 1; i < 4 && parts->depends_on_place; ++i)
      if (parts->formula.uses(i))
        result(i - 1) = parts->formula.at(at, i).first;
    return result;
  }



  void
  FieldFunction::pieces(const Eigen::Vector3d &x, const double t, std::vector<double> &result) const
  {
    const double        at[4] = {t, x(0), x(1), x(2)};
    std::vector<double> own;
    parts->formula.pieces(at, own);
    result.insert(result.end(), own.begin(), own.end());
  }



  double
  FieldFunction::next_corner(const double from, const double to) const
  {
    double first = std::numeric_limits<double>::infinity();
    for (const auto &function : parts->of_time)
      first = std::min(first, function.next_corner(from, to));
    return first;
  }



  FieldFunction
  Value<FieldFunction>::read(const std::string &text, const std::string &unit, const Quantities &quantities)
  {
    return FieldFunction(quantities.expression(text, unit, FieldFunction::variables));
  }



  std::string
  Value<FieldFunction>::write(const FieldFunction &value)
  {
    return value.text();
  }



  PatternPointer
  Value<FieldFunction>::pattern()
  {
    return std::make_unique<dealii::Patterns::Anything>();
  }
} // namespace samara
