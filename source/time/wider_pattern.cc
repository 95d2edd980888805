#include <samara/time/wider_pattern.h>

namespace samara
{
  std::shared_ptr<const Pattern>
  wider_pattern(const Pattern                                            &pattern,
                const std::vector<std::pair<unsigned int, unsigned int>> &couplings,
                std::vector<int>                                         &from)
  {
    std::vector<std::vector<int>> more(pattern.size()); // rows of each column
    for (const auto &[a, b] : couplings)
      for (int j = 0; j < 6; ++j)
        for (int i = 0; i < 6; ++i)
          more[6 * (b - 1) + j].push_back(6 * (a - 1) + i);
    auto result = std::make_shared<Pattern>();
    from.clear();
    result->column_start.push_back(0);
    for (int j = 0; j < pattern.size(); ++j)
      {
        auto       next = more[j].begin();
        const auto fill = [&](const int before) {
          for (; next != more[j].end() && *next < before; ++next)
            {
              result->rows.push_back(*next);
              from.push_back(-1);
            }
        };
        for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
          {
            fill(pattern.rows[k]);
            if (next != more[j].end() && *next == pattern.rows[k])
              ++next;
            result->rows.push_back(pattern.rows[k]);
            from.push_back(k);
          }
        fill(pattern.size());
        result->column_start.push_back(result->rows.size());
      }
    return result;
  }
} // namespace samara
