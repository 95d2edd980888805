#include <samara/base/quantity.h>
#include <samara/base/text.h>
#include <samara/cosserat/table_section.h>

#include <algorithm>
#include <filesystem>

namespace samara
{
  void
  TableSection::add_parameters(Parameters &prm)
  {
    prm.add(
      "Stations",
      station_texts,
      "Sections at abscissae: root at 0, tip at 1, or root at 0 m, tip at 7.5 m. Without a unit they are relative to "
      "the beam. In between the shape is linear where both are of one kind, as two boxes of the same layups, and "
      "elsewhere stiffness and inertia are. Two sections at the same abscissa make a jump.");
    prm.add_file(
      "File",
      file_names,
      "Instead of stations: CSV files, each with stations of its own, whose first line names the columns and "
      "their units: x (relative abscissa), s or r [m], or r/R, and any of EA, GA2, GA3, GJ, EI2, EI3, EI23, mass, I2, "
      "I3, I23, y2 shear, y3 shear, y2 tension, y3 tension, y2 mass, y3 mass, twist; SI units where none is "
      "given. Two lines with the same abscissa make a jump. Relative to the .prm file that says it.");
    prm.add(
      "Start",
      start,
      "Abscissa of the start of the beam in tables whose abscissae are lengths, or r/R: its distance from the axis "
      "of the rotor, where r is counted from there [m].");
    prm.add("Radius", radius, "Radius R of a table over r/R [m].", dealii::Patterns::Double(0));
  }



  void
  TableSection::initialize(Model &model)
  {
    try
      {
        if (station_texts.empty() == file_names.empty())
          throw std::invalid_argument("give either <Stations> or <File>");
        file_names.empty() ? read_stations(model) : read_files();
        if (fits_all_beams())
          along(1.);
      }
    catch (const std::invalid_argument &problem)
      {
        return model.complaints.add(parameters.where(file_names.empty() ? "Stations" : "File"), problem.what());
      }
    if (fits_all_beams() && parameters.is_set("Start"))
      model.complaints.add(parameters.where("Start"), "<Start> has no effect: the abscissae of the table are relative");
  }



  void
  TableSection::read_stations(Model &model)
  {
    const auto wrong = [](const std::string &text) {
      throw std::invalid_argument("a station is written <section at x> with x from 0 (start) to 1 (end), or with a "
                                  "length, not <" +
                                  text + ">");
    };
    bool has_length = false, has_number = false;
    for (const auto &text : station_texts)
      {
        std::string section, place;
        double      x = 0;
        if (!split_at(text, section, place))
          wrong(text);
        if (text_to_number(place, x))
          has_number = has_number || x != 0; // zero is zero in metres, too
        else
          try
            {
              x          = Quantities().number(place, "m");
              has_length = true;
            }
          catch (const std::invalid_argument &)
            {
              wrong(text);
            }
        if (!has_length && (x < 0 || x > 1))
          wrong(text);
        if (has_length && has_number)
          throw std::invalid_argument("<" + text + ">: some stations have a length and some have none");
        const auto &there = model.find<Section>(section, "section");
        if (!there.damping().isZero(0.))
          throw std::invalid_argument("the station <" + section +
                                      "> varies along a beam and has damping: a beam names it");
        stations.push_back({x, &there, {}, 0.});
      }
    is_relative = !has_length;
    for (unsigned int i = 2; i < stations.size(); ++i)
      if (stations[i].x == stations[i - 2].x)
        throw std::invalid_argument("there are more than two stations at the same abscissa");
    const auto is_before = [](const auto &a, const auto &b) { return a.x < b.x; };
    if (stations.size() < 2 || !std::is_sorted(stations.begin(), stations.end(), is_before))
      throw std::invalid_argument("a table needs at least two stations in ascending order");
  }



  void
  TableSection::read_files()
  {
    std::error_code ignored;
    files = std::filesystem::exists(file_names, ignored) ? std::vector<std::string>{file_names} :
                                                           split_top_level(file_names, ',');
    std::map<std::string, std::string> columns;
    for (const auto &file : files)
      {
        tables.emplace_back(file, radius);
        for (const auto &column : tables.back().columns)
          if (const auto first = columns.emplace(column.first, file); !first.second)
            throw std::invalid_argument("the column <" + column.first + "> is in " + first.first->second + " and in " +
                                        file);
      }
  }



  bool
  TableSection::fits_all_beams() const
  {
    return is_relative &&
           std::all_of(tables.begin(), tables.end(), [](const auto &table) { return table.is_relative; });
  }



  std::unique_ptr<const SectionStations>
  TableSection::make(const double length) const
  {
    if (!tables.empty())
      {
        auto result = std::make_unique<SectionStations>(tables, start, length);
        if (const std::string fault = result->fault("section <" + name + ">"); !fault.empty())
          throw std::invalid_argument(fault);
        return result;
      }
    auto relative = stations;
    if (!is_relative)
      for (auto &station : relative)
        station.x = (station.x - start) / length;
    return std::make_unique<SectionStations>(relative);
  }



  const Section &
  TableSection::along(const double length) const
  {
    for (const auto &station : stations)
      if (const auto *const table = dynamic_cast<const TableSection *>(station.section);
          table != nullptr && !table->fits_all_beams())
        throw std::invalid_argument("the station <" + table->name +
                                    "> is itself a table whose abscissae are lengths: it belongs to a beam");
      else if (station.section != nullptr && (table != nullptr || !station.section->kinks().empty()))
        throw std::invalid_argument("the station <" + station.section->name +
                                    "> varies along a beam itself: a station is one section, a beam names what varies");
    auto &one = made[fits_all_beams() ? 1. : length];
    if (one == nullptr)
      one = make(length);
    return *one;
  }



  const Section &
  TableSection::of_all_beams() const
  {
    if (!fits_all_beams())
      throw std::invalid_argument("the abscissae of the table <" + name + "> are lengths: it belongs to a beam");
    return along(1.);
  }



  bool
  TableSection::has_twist() const
  {
    return std::any_of(tables.begin(), tables.end(), [](const auto &table) {
      return table.columns.count("twist") > 0;
    });
  }



  SectionValues
  TableSection::at(const double x, const Vector3 &curvature) const
  {
    return of_all_beams().at(x, curvature);
  }



  bool
  TableSection::depends_on_curvature() const
  {
    return std::any_of(stations.begin(), stations.end(), [](const auto &s) {
      return s.section->depends_on_curvature();
    });
  }



  std::vector<Eigen::Vector2d>
  TableSection::outline(const double x) const
  {
    return of_all_beams().outline(x);
  }



  std::vector<StressedSection>
  TableSection::stressed(const double x, const double inside) const
  {
    return of_all_beams().stressed(x, inside);
  }



  std::vector<double>
  TableSection::kinks() const
  {
    return of_all_beams().kinks();
  }



  std::vector<std::string>
  TableSection::lines_of_files() const
  {
    std::vector<std::string> all;
    for (const auto &table : tables)
      all.insert(all.end(), table.lines.begin(), table.lines.end());
    return all;
  }
} // namespace samara
