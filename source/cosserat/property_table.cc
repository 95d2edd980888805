#include <samara/base/number_in_file.h>
#include <samara/base/quantity.h>
#include <samara/base/text.h>
#include <samara/base/text_file.h>
#include <samara/cosserat/property_table.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace samara
{
  namespace
  {
    /** What can be in a column, with its SI unit. */
    const std::map<std::string, std::string> property_units = {{"EA", "N"},
                                                               {"GA2", "N"},
                                                               {"GA3", "N"},
                                                               {"GJ", "N*m^2"},
                                                               {"EI2", "N*m^2"},
                                                               {"EI3", "N*m^2"},
                                                               {"EI23", "N*m^2"},
                                                               {"mass", "kg/m"},
                                                               {"I2", "kg*m"},
                                                               {"I3", "kg*m"},
                                                               {"I23", "kg*m"},
                                                               {"y2 shear", "m"},
                                                               {"y3 shear", "m"},
                                                               {"y2 tension", "m"},
                                                               {"y3 tension", "m"},
                                                               {"y2 mass", "m"},
                                                               {"y3 mass", "m"},
                                                               {"twist", "rad"}};

    const std::string of_surfaces = "chord"; ///< a column for lines of air, which does not matter here
  } // namespace



  PropertyTable::PropertyTable(const std::string &file, const double radius)
    : file(file)
    , radius(radius)
  {
    std::istringstream in(text_of_file(file));
    std::string        line;
    for (unsigned int number = 1; std::getline(in, line); ++number)
      {
        lines.push_back(line);
        const std::string content = trim(line.substr(0, line.find('#')));
        if (content.empty())
          continue;
        if (names.empty())
          read_header(content);
        else
          read_line(content, " in " + file + ":" + std::to_string(number));
      }
    if (abscissae.size() < 2)
      throw std::invalid_argument("a table needs at least two stations in ascending order, which " + file + " has not");
  }



  void
  PropertyTable::read_header(const std::string &line)
  {
    const std::string where = " in " + file;
    for (const auto &cell : split_top_level(line, ','))
      read_column(cell, where);
    if (std::find(names.begin(), names.end(), "") == names.end())
      throw std::invalid_argument("the table has no column <x>, relative, and none <s [m]>" + where);
    if (columns.empty())
      throw std::invalid_argument("the table has no column but the abscissae" + where);
  }



  void
  PropertyTable::read_column(const std::string &cell, const std::string &where)
  {
    const auto        bracket = std::min(cell.find('['), cell.size());
    const std::string name    = trim(cell.substr(0, bracket));
    std::string       unit;
    if (bracket < cell.size())
      {
        if (cell.back() != ']')
          throw std::invalid_argument("<" + cell + ">" + where + ": a unit stands in brackets, <EA [N]>");
        unit = trim(cell.substr(bracket + 1, cell.size() - bracket - 2));
      }
    const bool is_part_of_radius = name == "r/R", is_of_others = name == of_surfaces;
    const bool is_abscissa = name == "x" || name == "s" || name == "r" || is_part_of_radius;
    const auto known       = property_units.find(name);
    if (is_part_of_radius && !(radius > 0))
      throw std::invalid_argument("the column <r/R>" + where + " needs the <Radius>");
    if (!is_abscissa && !is_of_others && known == property_units.end())
      {
        std::vector<std::string> all = {"x", "s", "r", "r/R"};
        for (const auto &column : property_units)
          all.push_back(column.first);
        throw std::invalid_argument("there is no column <" + name + "> in a table of section properties" +
                                    did_you_mean(name, all));
      }
    if (std::find(names.begin(), names.end(), is_abscissa ? "" : name) != names.end())
      throw std::invalid_argument("<" + name + "> is twice" + where);
    const bool is_number = is_part_of_radius ? false :
                           unit.empty()      ? name == "x" :
                                               unit == "-" || unit == "1" || unit == "%";
    if (is_abscissa)
      is_relative = is_number;
    else
      columns[name];
    if (is_part_of_radius)
      {
        names.emplace_back();
        factors.push_back(radius);
        return;
      }
    const std::string si_unit = is_of_others ? "m" : !is_abscissa ? known->second : is_relative ? "1" : "m";
    names.push_back(is_abscissa ? "" : name);
    try
      {
        factors.push_back(unit.empty() || unit == "-" ? 1. : Quantities().number("1 " + unit, si_unit));
      }
    catch (const std::invalid_argument &problem)
      {
        throw std::invalid_argument("<" + cell + ">" + where + ": " + problem.what());
      }
  }



  void
  PropertyTable::read_line(const std::string &line, const std::string &place)
  {
    const auto cells = split_top_level(line, ',');
    if (cells.size() != names.size())
      throw std::invalid_argument("<" + line + ">" + place + " has not as many numbers as the first line has names");
    for (unsigned int i = 0; i < cells.size(); ++i)
      {
        double number = 0;
        if (const std::string fault = fault_of_number(cells[i], number); !fault.empty())
          throw std::invalid_argument("<" + cells[i] + ">" + place + " " + fault);
        (names[i].empty() ? abscissae : columns[names[i]]).push_back(number * factors[i]);
      }
    const auto n = abscissae.size();
    if (n > 1 && abscissae[n - 1] < abscissae[n - 2])
      throw std::invalid_argument("a table needs at least two stations in ascending order, which ends" + place);
    if (n > 2 && abscissae[n - 1] == abscissae[n - 3])
      throw std::invalid_argument("there are more than two stations at the same abscissa" + place);
  }



  double
  PropertyTable::at(const std::string &column, const double x, const bool from_below) const
  {
    const auto &y     = columns.at(column);
    const auto  begin = abscissae.begin(), end = abscissae.end();
    const auto  right = from_below ? std::lower_bound(begin, end, x) : std::upper_bound(begin, end, x);
    if (right == begin)
      return y.front();
    if (right == end)
      return y.back();
    const auto   i = right - begin;
    const double w = (x - abscissae[i - 1]) / (abscissae[i] - abscissae[i - 1]);
    return (1 - w) * y[i - 1] + w * y[i];
  }
} // namespace samara
