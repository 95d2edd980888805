#include <samara/base/text.h>
#include <samara/base/text_file.h>
#include <samara/study/study_quantity.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <stdexcept>

namespace samara
{
  namespace
  {
    constexpr unsigned int points_of_interpolation = 6;

    /** "tip.displacement y [m]" -> "tip.displacement y" */
    std::string
    without_unit(const std::string &column)
    {
      const auto bracket = column.rfind('[');
      return trim(bracket != std::string::npos && trim(column).back() == ']' ? column.substr(0, bracket) : column);
    }



    unsigned int
    index_of(const std::vector<std::string> &names, const std::string &wanted, const std::string &file)
    {
      std::vector<std::string> bare;
      for (const auto &name : names)
        bare.push_back(without_unit(name));
      if (const auto found = std::find(bare.begin(), bare.end(), wanted); found != bare.end())
        return found - bare.begin();
      if (const auto whole = std::find(names.begin(), names.end(), wanted); whole != names.end())
        return whole - names.begin();
      if (names.size() == 2)
        return 1;
      throw std::runtime_error(file + " has no column <" + wanted + ">" + did_you_mean(wanted, bare));
    }
  } // namespace



  Series
  read_series(const std::string &file, const std::string &column)
  {
    std::ifstream in(file);
    std::string   line;
    if (!in || !std::getline(in, line))
      throw std::runtime_error("cannot read " + file);
    const auto         names  = csv_fields(line);
    const unsigned int wanted = index_of(names, column, file);
    Series             series;
    while (std::getline(in, line))
      {
        const auto fields = csv_fields(line);
        double     x = 0, y = 0;
        if (fields.size() == names.size() && text_to_number(trim(fields[0]), x))
          {
            series.x.push_back(x);
            series.y.push_back(text_to_number(trim(fields[wanted]), y) ? y : std::nan(""));
          }
      }
    if (series.x.empty())
      throw std::runtime_error(file + " has no rows of numbers");
    return series;
  }



  double
  Series::at(const double place) const
  {
    const double slack = 1e-9 * std::max(std::abs(x.back() - x.front()), std::abs(place));
    if (place < x.front() - slack || place > x.back() + slack)
      throw std::runtime_error("the reference says nothing at " + number_to_text(place) + ": it goes from " +
                               number_to_text(x.front()) + " to " + number_to_text(x.back()));
    std::size_t right = std::lower_bound(x.begin(), x.end(), place - slack) - x.begin();
    right             = std::min(right, x.size() - 1);
    if (std::abs(x[right] - place) <= slack)
      return y[right];

    // Neville's scheme through the nearest points; a place that is there twice, at an event, counts once
    std::vector<double> nodes, values;
    std::size_t         left = right;
    while (nodes.size() < points_of_interpolation && (left > 0 || right < x.size()))
      {
        const bool to_the_left = right == x.size() || (left > 0 && place - x[left - 1] < x[right] - place);
        const auto i           = to_the_left ? --left : right++;
        const bool is_there =
          std::any_of(nodes.begin(), nodes.end(), [&](const double node) { return std::abs(node - x[i]) <= slack; });
        if (!is_there)
          {
            nodes.push_back(x[i]);
            values.push_back(y[i]);
          }
      }
    for (std::size_t level = 1; level < nodes.size(); ++level)
      for (std::size_t i = 0; i + level < nodes.size(); ++i)
        values[i] =
          ((place - nodes[i + level]) * values[i] + (nodes[i] - place) * values[i + 1]) / (nodes[i] - nodes[i + level]);
    return values[0];
  }



  double
  norm_of(const Series &series, const std::string &norm)
  {
    const auto &[x, y] = series;
    if (norm == "final")
      return y.back();
    double largest = 0, integral = 0;
    for (std::size_t i = 0; i < y.size(); ++i)
      {
        if (std::isnan(y[i]))
          return y[i];
        largest = std::max(largest, std::abs(y[i]));
        if (i > 0)
          integral += (x[i] - x[i - 1]) * (y[i] * y[i] + y[i - 1] * y[i - 1]) / 2;
      }
    if (norm == "largest")
      return largest;
    return x.back() > x.front() ? std::sqrt(integral / (x.back() - x.front())) : std::abs(y.back());
  }



  double
  distance(const Series &series, const Series &reference, const std::string &norm)
  {
    Series difference = series;
    if (norm == "final")
      return std::abs(series.y.back() - reference.at(series.x.back()));
    for (std::size_t i = 0; i < series.x.size(); ++i)
      difference.y[i] -= reference.at(series.x[i]);
    return norm_of(difference, norm);
  }



  StudyQuantity::StudyQuantity(const std::string &text)
  {
    const std::vector<std::string> sources = {"static", "dynamic", "energy", "modal", "floquet"};
    const auto                     colon   = text.find(':');
    source                                 = trim(text.substr(0, colon));
    name                                   = colon == std::string::npos ? "" : trim(text.substr(colon + 1));
    if (std::find(sources.begin(), sources.end(), source) == sources.end())
      throw std::invalid_argument("<" + source + "> has no results" + did_you_mean(source, sources) +
                                  " Write for instance <dynamic: tip.displacement y> or <modal: frequency 1>.");
    if (name.empty())
      throw std::invalid_argument("<" + text + "> names no quantity; write for instance <" +
                                  (source == "modal"   ? "modal: frequency 1" :
                                   source == "floquet" ? "floquet: multiplier 1" :
                                                         source + ": tip.displacement y") +
                                  ">.");
    if (!is_of_modes())
      return;
    const auto blank  = name.rfind(' ');
    double     number = 0;
    if (blank == std::string::npos || !text_to_number(name.substr(blank + 1), number) || number < 1 ||
        number != std::floor(number))
      throw std::invalid_argument("<" + name + "> does not say which mode; write for instance <" + source +
                                  ": frequency 1>.");
    mode = static_cast<unsigned int>(number);
    name = trim(name.substr(0, blank));
    const std::vector<std::string> names =
      source == "modal" ?
        std::vector<std::string>{"frequency", "damping ratio", "real", "imaginary", "growth rate"} :
        std::vector<std::string>{"multiplier", "growth rate", "frequency", "frequency mod period", "damping ratio"};
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw std::invalid_argument("a mode has no <" + name + ">" + did_you_mean(name, names));
  }



  std::vector<std::string>
  StudyQuantity::overrides() const
  {
    std::vector<std::string> result = {"Output/Pictures = false", "Output/Report = false"};
    if (source == "static" || source == "dynamic")
      result.push_back("Output/Probes = " + name);
    return result;
  }



  std::string
  StudyQuantity::analysis() const
  {
    return source == "energy" ? "dynamic" : source;
  }



  Series
  StudyQuantity::read(const std::string &folder) const
  {
    if (!is_of_modes())
      return read_series(folder + "/" + (source == "energy" ? "dynamic_energy" : source) + ".csv", name);
    const bool is_ordered = source == "modal" && name == "growth rate"; // modes.csv is in the order of frequencies
    Series     modes =
      read_series(folder + (source == "modal" ? "/modes.csv" : "/floquet.csv"), is_ordered ? "real" : name);
    if (is_ordered)
      std::sort(modes.y.begin(), modes.y.end(), std::greater<double>());
    if (mode > modes.y.size())
      throw std::runtime_error("there are " + std::to_string(modes.y.size()) + " modes, not " + std::to_string(mode));
    return {{0.}, {modes.y[mode - 1]}};
  }
} // namespace samara
