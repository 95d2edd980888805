#include <samara/base/text.h>
#include <samara/cosserat/section_stations.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Stations that are as near as this are one, and a table may be so much shorter than the beam: of its length. */
    constexpr double rounding = 1e-6;

    /** Relative abscissae of all stations on the beam, with its ends; no two but for round-off. */
    std::vector<double>
    union_of_stations(const std::vector<PropertyTable> &tables, const double start, const double length)
    {
      std::vector<double> all = {0., 1.};
      for (const auto &table : tables)
        for (const double a : table.abscissae)
          if (const double x = table.is_relative ? a : (a - start) / length; x > rounding && x < 1 - rounding)
            all.push_back(x);
      std::sort(all.begin(), all.end());
      const auto are_same = [](const double a, const double b) { return b - a < rounding; };
      all.erase(std::unique(all.begin(), all.end(), are_same), all.end());
      return all;
    }

    void
    check_range(const PropertyTable &table, const double start, const double length)
    {
      const double from = table.is_relative ? 0. : start, to = table.is_relative ? 1. : start + length,
                   margin = rounding * (table.is_relative ? 1. : length);
      if (table.abscissae.front() > from + margin || table.abscissae.back() < to - margin)
        throw std::invalid_argument("the table " + table.file + " goes from " +
                                    number_to_text("%.9g", table.abscissae.front()) + " to " +
                                    number_to_text("%.9g", table.abscissae.back()) + (table.is_relative ? "" : " m") +
                                    ", and the beam from " + number_to_text("%.9g", from) + " to " +
                                    number_to_text("%.9g", to) + (table.is_relative ? " (relative)" : " m"));
    }

    /** All that the tables say at the relative abscissa @p x, twist included. */
    std::map<std::string, double>
    numbers_at(const std::vector<PropertyTable> &tables,
               const double                      start,
               const double                      length,
               const double                      x,
               const bool                        from_below)
    {
      std::map<std::string, double> numbers;
      for (const auto &table : tables)
        {
          // the table's own abscissa of a station that is there but for rounding; of several the outer ones
          const double wanted = table.is_relative ? x : start + x * length,
                       margin = rounding * (table.is_relative ? 1. : length);
          double place        = wanted;
          for (const double a : table.abscissae)
            if (std::abs(a - wanted) <= margin)
              {
                place = a;
                if (from_below)
                  break;
              }
          for (const auto &column : table.columns)
            numbers[column.first] = table.at(column.first, place, from_below);
        }
      return numbers;
    }

    SectionValues
    values_of(const std::map<std::string, double> &numbers)
    {
      EngineeringConstants                  c;
      const std::map<std::string, double *> variables = {{"EA", &c.EA},
                                                         {"GA2", &c.GA2},
                                                         {"GA3", &c.GA3},
                                                         {"GJ", &c.GJ},
                                                         {"EI2", &c.EI2},
                                                         {"EI3", &c.EI3},
                                                         {"EI23", &c.EI23},
                                                         {"mass", &c.mass},
                                                         {"I2", &c.I2},
                                                         {"I3", &c.I3},
                                                         {"I23", &c.I23},
                                                         {"y2 shear", &c.shear_centre[0]},
                                                         {"y3 shear", &c.shear_centre[1]},
                                                         {"y2 tension", &c.tension_centre[0]},
                                                         {"y3 tension", &c.tension_centre[1]},
                                                         {"y2 mass", &c.mass_centre[0]},
                                                         {"y3 mass", &c.mass_centre[1]}};
      for (const auto &[name, number] : numbers)
        if (const auto variable = variables.find(name); variable != variables.end())
          *variable->second = number;
      return c.values();
    }

    SectionValues
    values_at(const SectionStations::Station &station, const Vector3 &curvature)
    {
      return station.section != nullptr ? station.section->at(0, curvature) : station.values;
    }

    std::vector<Eigen::Vector2d>
    outline_at(const SectionStations::Station &station)
    {
      return station.section != nullptr ? station.section->outline(0) : station.values.outline;
    }
  } // namespace



  SectionStations::SectionStations(const std::vector<PropertyTable> &tables, const double start, const double length)
  {
    for (const auto &table : tables)
      check_range(table, start, length);
    for (const double x : union_of_stations(tables, start, length))
      {
        const auto below = numbers_at(tables, start, length, x, true),
                   above = numbers_at(tables, start, length, x, false);
        const auto add   = [&](const std::map<std::string, double> &numbers) {
          const auto twist = numbers.find("twist");
          stations.push_back({x, nullptr, values_of(numbers), twist == numbers.end() ? 0. : twist->second});
        };
        if (x > 0)
          add(below);
        if (x == 0 || (x < 1 && above != below))
          add(above);
      }
  }



  SectionStations::SectionStations(const std::vector<Station> &stations)
    : stations(stations)
  {
    if (stations.front().x > rounding || stations.back().x < 1 - rounding)
      throw std::invalid_argument("the stations go from " + number_to_text("%.9g", stations.front().x) + " to " +
                                  number_to_text("%.9g", stations.back().x) +
                                  " of the beam, not from its start, 0, to its end, 1");
  }



  std::pair<unsigned int, double>
  SectionStations::piece(const double x, const double inside) const
  {
    const double beside = x + 1e-9 * (inside - x);
    unsigned int i      = 0;
    while (i + 2 < stations.size() && stations[i + 1].x <= beside)
      ++i;
    const double length = stations[i + 1].x - stations[i].x;
    const double w      = length > 0 ? (x - stations[i].x) / length : 1.;
    return {i, std::min(1., std::max(0., w))};
  }



  SectionValues
  SectionStations::at(const double x, const Vector3 &curvature) const
  {
    return at_side(x, x, curvature);
  }



  SectionValues
  SectionStations::at_side(const double x, const double inside, const Vector3 &curvature) const
  {
    const auto [i, w] = piece(x, inside);
    if (const auto *const loft = between(i))
      return loft->at(w, curvature);
    const SectionValues before = values_at(stations[i], curvature);
    if (stations[i].section != nullptr && stations[i].section == stations[i + 1].section)
      return before;
    return interpolate(before, values_at(stations[i + 1], curvature), w);
  }



  const SectionLoft *
  SectionStations::between(const unsigned int i) const
  {
    const Station &a = stations[i], &b = stations[i + 1];
    if (a.section == nullptr || b.section == nullptr || a.section == b.section)
      return nullptr;
    auto known = made.find(i);
    if (known == made.end())
      known = made.emplace(i, Between{a.section->loft_to(*b.section)}).first;
    return known->second.loft.get();
  }



  bool
  SectionStations::depends_on_curvature() const
  {
    return std::any_of(stations.begin(), stations.end(), [](const Station &s) {
      return s.section != nullptr && s.section->depends_on_curvature();
    });
  }



  std::vector<Eigen::Vector2d>
  SectionStations::outline(const double x) const
  {
    const auto [i, w] = piece(x, x);
    return interpolate(outline_at(stations[i]), outline_at(stations[i + 1]), w);
  }



  std::vector<StressedSection>
  SectionStations::stressed(const double x, const double inside) const
  {
    const auto [i, w]      = piece(x, inside);
    const Section *const a = stations[i].section, *const b = stations[i + 1].section;
    if (a == b || w == 0 || w == 1)
      return w == 1 && b != nullptr ? b->stressed(0, 0) :
             a != nullptr           ? a->stressed(0, 0) :
                                      std::vector<StressedSection>();
    if (const auto *const loft = between(i))
      if (const auto shape = loft->shape(w))
        return {{a->name + " to " + b->name, shape}};
    std::vector<StressedSection> result;
    for (const bool is_before : {true, false})
      if (const Section *const station = is_before ? a : b; station != nullptr)
        for (StressedSection part : station->stressed(0, 0))
          {
            part.is_there = false;
            part.weight   = is_before ? 1 - w : w;
            result.push_back(part);
          }
    if (result.size() == 1)
      {
        // nothing is known of the other one, which has no shape: this one counts where it is the nearer
        if (result[0].weight < 0.5)
          return {};
        result[0].weight = 1;
      }
    return result;
  }



  std::vector<double>
  SectionStations::kinks() const
  {
    std::vector<double> inside;
    for (const auto &s : stations)
      if (s.x >= 0 && s.x <= 1)
        inside.push_back(s.x);
    return inside;
  }



  bool
  SectionStations::has_twist() const
  {
    return std::any_of(stations.begin(), stations.end(), [](const Station &s) { return s.twist != 0; });
  }



  double
  SectionStations::twist(const double x, const double inside) const
  {
    const auto [i, w] = piece(x, inside);
    return (1 - w) * stations[i].twist + w * stations[i + 1].twist;
  }



  std::vector<double>
  SectionStations::jumps_of_twist() const
  {
    std::vector<double> jumps;
    for (unsigned int i = 0; i + 1 < stations.size(); ++i)
      if (stations[i].x == stations[i + 1].x && stations[i].twist != stations[i + 1].twist)
        jumps.push_back(stations[i].x);
    return jumps;
  }



  std::string
  SectionStations::fault(const std::string &what) const
  {
    for (const auto &s : stations)
      if (s.section == nullptr) // a section has complained itself
        if (const std::string fault =
              fault_of(s.values, what + " at the relative abscissa " + number_to_text("%.6g", s.x));
            !fault.empty())
          return fault;
    return "";
  }
} // namespace samara
