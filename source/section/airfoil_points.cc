// Points of airfoils: by digits, and from files.

#include <samara/base/number_in_file.h>
#include <samara/base/text.h>
#include <samara/base/text_file.h>
#include <samara/section/airfoil_outline.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace samara
{
  std::vector<dealii::Point<2>>
  naca_points(const std::string &digits, const bool sharp)
  {
    if (digits.size() != 4 ||
        !std::all_of(digits.begin(), digits.end(), [](const char c) { return c >= '0' && c <= '9'; }))
      throw std::invalid_argument("<" + digits + "> is no airfoil of NACA's four-digit series; one is 2418");
    const double m = (digits[0] - '0') / 100., p = (digits[1] - '0') / 10., t = std::stoi(digits.substr(2)) / 100.;
    if (!(t > 0))
      throw std::invalid_argument("NACA <" + digits + "> has no thickness");
    if ((m > 0) != (p > 0))
      throw std::invalid_argument("NACA <" + digits +
                                  ">: the first two digits, camber and where it is largest, are "
                                  "both zero or both above it");
    const double       last = sharp ? 0.1036 : 0.1015;
    const unsigned int n    = 160;
    const auto         side = [&](const double x, const double sign) {
      const double half = 5 * t * (0.2969 * std::sqrt(x) - x * (0.1260 + x * (0.3516 - x * (0.2843 - x * last))));
      double       camber = 0, slope = 0;
      if (m > 0)
        {
          const double q = x < p ? p : 1 - p;
          camber         = m / (q * q) * (x < p ? 2 * p * x - x * x : 1 - 2 * p + 2 * p * x - x * x);
          slope          = 2 * m / (q * q) * (p - x);
        }
      // thickness is across the camber line
      const double c = 1 / std::sqrt(1 + slope * slope);
      return dealii::Point<2>(x - sign * half * slope * c, camber + sign * half * c);
    };
    std::vector<dealii::Point<2>> result;
    for (unsigned int i = 0; i <= 2 * n; ++i)
      {
        // from the trailing edge to the nose and back; √x is the smooth parameter at the nose
        const double u = 1 - double(i) / n, r = std::sin(0.5 * M_PI * u);
        result.push_back(side(r * r, i < n ? 1 : -1));
      }
    return result;
  }



  namespace
  {
    struct PairOnLine
    {
      double      x, y;
      std::size_t line;
    };

    /** Lines with two numbers; words only before the first of them. */
    std::vector<PairOnLine>
    pairs_of(const std::string &file)
    {
      std::istringstream      in(text_of_file(file));
      std::vector<PairOnLine> result;
      std::string             line;
      for (std::size_t number = 1; std::getline(in, line); ++number)
        {
          line = line.substr(0, line.find_first_of("#!"));
          std::replace(line.begin(), line.end(), ',', ' ');
          std::istringstream  words(line);
          std::string         word;
          std::vector<double> numbers;
          bool                is_text = false;
          while (words >> word)
            {
              double x = 0;
              is_text  = is_text || !fault_of_number(word, x).empty();
              numbers.push_back(x);
            }
          if (numbers.empty() || (is_text && result.empty()))
            continue;
          if (is_text || numbers.size() != 2)
            throw std::invalid_argument(file + ":" + std::to_string(number) +
                                        ": here should be two numbers, x/c and y/c of a point of the airfoil");
          result.push_back({numbers[0], numbers[1], number});
        }
      return result;
    }
  } // namespace



  std::vector<dealii::Point<2>>
  read_airfoil(const std::string &file)
  {
    const auto pairs = pairs_of(file);
    if (pairs.empty())
      throw std::invalid_argument(file + ": there are no points of an airfoil in it");
    std::vector<dealii::Point<2>> result;
    const bool                    is_by_sides = pairs.front().x > 1.5 && pairs.front().y > 1.5;
    for (std::size_t i = is_by_sides ? 1 : 0; i < pairs.size(); ++i)
      {
        if (std::abs(pairs[i].x) > 1.5 || std::abs(pairs[i].y) > 1.5)
          throw std::invalid_argument(file + ":" + std::to_string(pairs[i].line) +
                                      ": coordinates of an airfoil are fractions of its chord, x from 0 to 1");
        result.emplace_back(pairs[i].x, pairs[i].y);
      }
    if (!is_by_sides)
      return result;
    const double upper = pairs.front().x, lower = pairs.front().y;
    if (upper + lower != result.size() || upper != std::floor(upper))
      throw std::invalid_argument(file + ":" + std::to_string(pairs.front().line) + ": this line says that there are " +
                                  number_to_text(upper) + " and " + number_to_text(lower) +
                                  " points on the two sides, and there are " + std::to_string(result.size()));
    std::reverse(result.begin(), result.begin() + static_cast<std::ptrdiff_t>(upper));
    return result;
  }
} // namespace samara
