#include <samara/analysis/analysis.h>

#include <sstream>

namespace samara
{
  std::vector<double>
  Context::speeds_at(const double speed) const
  {
    std::vector<double> result;
    const auto         &rotations = system.model.rotations;
    for (const auto &rotation : rotations)
      result.push_back(rotations[0].speed != 0. ? rotation.speed / rotations[0].speed * speed : speed);
    return result;
  }



  std::string
  short_text(const double number)
  {
    std::ostringstream text;
    text << number;
    return text.str();
  }
} // namespace samara
