#ifndef tests_reference_h
#define tests_reference_h

#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace samara
{
  /** The rows of tests/reference/@p file by the names of their columns; lines that begin with # are left out. */
  inline std::vector<std::map<std::string, std::string>>
  reference_rows(const std::string &file)
  {
    std::ifstream in(SAMARA_SOURCE_DIR "/tests/reference/" + file);
    if (!in)
      throw std::runtime_error("no tests/reference/" + file);
    const auto cells_of = [](const std::string &line) {
      std::vector<std::string> cells;
      std::istringstream       text(line);
      for (std::string cell; std::getline(text, cell, ',');)
        cells.push_back(cell);
      return cells;
    };
    std::vector<std::string>                        names;
    std::vector<std::map<std::string, std::string>> rows;
    for (std::string line; std::getline(in, line);)
      {
        if (line.empty() || line[0] == '#')
          continue;
        const auto cells = cells_of(line);
        if (names.empty())
          {
            names = cells;
            continue;
          }
        rows.emplace_back();
        for (std::size_t i = 0; i < cells.size() && i < names.size(); ++i)
          rows.back()[names[i]] = cells[i];
      }
    return rows;
  }
} // namespace samara

#endif
