#include <samara/section/extremes_by_name.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace samara
{
  namespace
  {
    constexpr int n_stresses = 7;
  }



  std::vector<std::string>
  ExtremeByName::names()
  {
    return {"stress 11",
            "stress 22",
            "stress 33",
            "stress 23",
            "stress 13",
            "stress 12",
            "von Mises stress",
            "max stress index",
            "Tsai-Wu index",
            "Hashin index",
            "von Mises index"};
  }



  ExtremeByName::ExtremeByName(const std::string &name)
  {
    const auto all   = names();
    const auto found = std::find(all.begin(), all.end(), name);
    number           = found == all.end() ? -1 : static_cast<int>(found - all.begin());
  }



  std::string
  ExtremeByName::unit() const
  {
    return number < n_stresses ? "Pa" : "1";
  }



  double
  ExtremeByName::of(const SectionStresses::Extremes &e) const
  {
    Assert(is_known(), dealii::ExcMessage("There is no such quantity."));
    const FailureIndices &f = e.indices;
    switch (number)
      {
        case 6:
          return e.von_mises_stress;
        case 7:
          return f.max_stress;
        case 8:
          return f.tsai_wu;
        case 9:
          return f.hashin;
        case 10:
          return f.von_mises;
        default:
          return e.stress(number);
      }
  }
} // namespace samara
