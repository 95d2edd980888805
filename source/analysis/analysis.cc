#include <samara/analysis/analysis.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
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



  bool
  Context::is_shown() const
  {
    if (sweep.empty())
      return true;
    Assert(!system.model.rotations.empty(), dealii::ExcMessage("There are speeds, but nothing rotates."));
    const double nominal = system.model.rotations[0].speed;
    const bool   within  = std::find(sweep.begin(), sweep.end(), nominal) != sweep.end();
    return speeds[0] == (within ? nominal : sweep.back());
  }



  std::string
  short_text(const double number)
  {
    std::ostringstream text;
    text << number;
    return text.str();
  }
} // namespace samara
