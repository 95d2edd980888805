#include <samara/base/text.h>
#include <samara/cosserat/beam.h>
#include <samara/cosserat/beamdyn_file.h>
#include <samara/cosserat/section_file.h>
#include <samara/cosserat/table_section.h>
#include <samara/model/remarks.h>
#include <samara/output/file.h>
#include <samara/output/table.h>
#include <samara/output/write_hdf5.h>
#include <samara/recovery/section_report.h>
#include <samara/rotation/matrix6.h>
#include <samara/section/section_constants.h>

#include <algorithm>

namespace samara
{
  namespace
  {
    /** A section with one curvature, and what is known of it. */
    struct Row
    {
      std::string                                 name;
      Vector3                                     curvature = Vector3::Zero();
      SectionValues                               values;
      double                                      area = std::nan(""), unknowns = std::nan(""), change = std::nan("");
      std::vector<std::pair<std::string, double>> materials = {}; ///< and their areas [m²]
    };

    /** Numbers of a section and their units: what engineers call them, between others. */
    std::vector<SectionConstants::Named>
    numbers_of(const Row &row)
    {
      std::vector<SectionConstants::Named> result = {{"k1", "1/m", row.curvature(0)},
                                                     {"k2", "1/m", row.curvature(1)},
                                                     {"k3", "1/m", row.curvature(2)},
                                                     {"area", "m^2", row.area}};
      for (const auto &one : SectionConstants(inverse6(row.values.stiffness), row.values.inertia).list())
        result.push_back(one);
      result.push_back({"unknowns", "", row.unknowns});
      result.push_back({"change with one degree more", "", row.change});
      return result;
    }



    /** Largest difference of two stiffnesses relative to the diagonal. */
    double
    difference(const Matrix6 &a, const Matrix6 &b)
    {
      const Vector6 size = b.diagonal().cwiseSqrt();
      return ((a - b).array() / (size * size.transpose()).array()).abs().maxCoeff();
    }



    /** What only an analysis tells. */
    void
    add_analysis(Row &row, const AnalysedSection &section, const SectionAnalysis &own)
    {
      row.area     = own.section.area;
      row.unknowns = own.section.n_unknowns();
      try
        {
          row.change = difference(section.analyse(row.curvature, 1)->section.stiffness, row.values.stiffness);
        }
      catch (const std::invalid_argument &)
        {
          // with one degree more the equations may be lost in round-off: then there is nothing to compare with
        }
      std::vector<double> areas(own.shape.materials.size(), 0.);
      for (const auto &point : own.section.points())
        areas[own.mesh.ply(point.cell).material] += point.weight;
      for (unsigned int i = 0; i < areas.size(); ++i)
        row.materials.emplace_back(own.shape.materials[i].name, areas[i]);
    }



    SectionFile
    file_of(const Row &row)
    {
      SectionFile result{row.name, row.curvature, row.values};
      result.remarks = {{"area [m^2]", row.area},
                        {"unknowns", row.unknowns},
                        {"change with one degree more", row.change}};
      for (const auto &[material, area] : row.materials)
        result.remarks.emplace_back("area of " + material + " [m^2]", area);
      return result;
    }
  } // namespace



  void
  SectionReport::add_parameters(Parameters &prm)
  {
    prm.add("Sections", names, "Names of the sections to report; not given: all.");
    prm.add("Stresses at",
            places,
            "Places of beams where stresses are recovered in the state reached: blade at 0.3, blade.root, ...");
    prm.add("Largest of",
            names_of_watched,
            "Names of beams of which stresses are recovered where and when an index of failure has been largest in the "
            "motion before, at all reported times, at the ends and in the middle of all elements; without a motion in "
            "the state reached. Besides stresses.csv they stand in stresses_<beam>_largest.vtu.");
    prm.add("Criterion",
            criterion,
            "The index that counts there; largest: of those that all materials have strengths for.",
            dealii::Patterns::Selection("largest|max stress|Tsai-Wu|Hashin|von Mises"));
    prm.add(
      "BeamDyn files",
      beamdyn_beams,
      "Names of beams whose sections are written as blade files of BeamDyn, <beam>_beamdyn.dat: stations where the "
      "sections have kinks, in the axes of the sections.");
  }



  namespace
  {
    bool
    is_along_a_beam(const Section &section)
    {
      return dynamic_cast<const TableSection *>(&section) != nullptr ||
             dynamic_cast<const BeamDynSection *>(&section) != nullptr;
    }
  } // namespace



  std::vector<const Section *>
  SectionReport::wanted(const Model &model) const
  {
    std::vector<const Section *> result;
    try
      {
        for (const auto &name : names)
          result.push_back(&model.find<Section>(name, "section"));
        for (const auto *const section : result)
          if (is_along_a_beam(*section))
            throw std::invalid_argument("<" + section->name + "> is a table: name the sections at its stations");
      }
    catch (const std::invalid_argument &problem)
      {
        throw InputError(parameters.where("Sections") + ": " + problem.what());
      }
    if (names.empty())
      for (const auto &item : model.items)
        if (const auto *const section = dynamic_cast<const Section *>(item.get()))
          if (!is_along_a_beam(*section))
            result.push_back(section);
    if (result.empty() && places.empty() && names_of_watched.empty() && beamdyn_beams.empty())
      throw InputError(parameters.where() + ": the model has no section to report");
    return result;
  }



  namespace
  {
    /** A section with one curvature; its files but for the tables are written. */
    Row
    report_one(const std::string &name,
               const std::string &file,
               const Section     &section,
               const Vector3     &curvature,
               const std::string &folder,
               const bool         pictures,
               ReportPage *const  page)
    {
      Row row{name, curvature, section.at(0, curvature)};
      if (const auto *const analysed = section.analysed())
        {
          const auto analysis = analysed->analyse(curvature);
          add_analysis(row, *analysed, *analysis);
          if (pictures)
            replace_file(folder + "/section_" + file + ".vtu", picture_of(*analysis));
          if (page != nullptr)
            page->add("section " + name, 0, drawing_of(*analysis, name));
        }
      replace_file(folder + "/section_" + file + ".txt", file_of(row).write(16));
      return row;
    }
  } // namespace



  void
  SectionReport::report(const Model       &model,
                        const std::string &folder,
                        const bool         pictures,
                        ReportPage *const  page,
                        Log               &log) const
  {
    constexpr std::size_t most = 4; // a curved beam has many curvatures
    std::vector<Row>      rows;
    FileNames             files;
    for (const Section *const section : wanted(model))
      {
        if (const auto *const teller = dynamic_cast<const HasRemarks *>(section))
          for (const auto &remark : teller->remarks())
            if (remark.level == Remark::of_check)
              log.line(remark.text);
        const auto curvatures = section->curvatures();
        for (std::size_t i = 0; i < std::min(most, curvatures.size()); ++i)
          {
            const std::string name = section->name + (i == 0 ? "" : " " + std::to_string(i + 1)),
                              file = files.next(name);
            if (file != file_name_of(name))
              log.line("Section " + name + " is in section_" + file +
                       ".txt: names of files have other characters, and another section takes that without a number");
            rows.push_back(report_one(name, file, *section, curvatures[i], folder, pictures, page));
            SectionFile shown = file_of(rows.back());
            shown.values.outline.clear();
            log.line(shown.write(10));
          }
        if (curvatures.size() > most)
          log.line("Section " + section->name + ": beams use it with " + std::to_string(curvatures.size() - most) +
                   " more curvatures, which are not reported");
      }

    if (rows.empty())
      return;
    std::vector<std::string>                         header = {"section"};
    std::vector<std::pair<std::string, std::string>> columns;
    for (const auto &[name, unit, number, is_vague] : numbers_of(rows.front()))
      {
        columns.emplace_back(name, unit);
        header.push_back(unit.empty() ? name : name + " [" + unit + "]");
      }
    Table                            table(header);
    std::vector<std::vector<double>> block(columns.size());
    for (const Row &row : rows)
      {
        const auto               numbers = numbers_of(row);
        std::vector<Table::Cell> cells   = {row.name};
        for (unsigned int i = 0; i < numbers.size(); ++i)
          {
            block[i].push_back(numbers[i].number);
            cells.push_back(Table::Cell::optional(numbers[i].number));
          }
        table.add_row(cells);
      }
    table.write(folder + "/sections.csv");
    write_hdf5(folder + "/sections.h5", columns, rows.size(), [&](std::vector<std::vector<double>> &next) {
      next = block;
    });
  }



  void
  SectionReport::run(Context &context)
  {
    if (context.folder.empty())
      return;
    report(context.system.model,
           context.folder,
           context.pictures && context.is_shown(),
           context.is_shown() ? context.page : nullptr,
           context.log);
    write_beamdyn_files(context);
    if (!places.empty() || !watched.empty())
      report_stresses(context);
  }



  void
  SectionReport::run_without_bodies(const Model &model, const std::string &folder, const bool pictures, Log &log)
  {
    if (!names_of_watched.empty())
      throw InputError(parameters.where("Largest of") + ": there is no beam in the model where stresses could be");
    if (!places.empty())
      throw InputError(parameters.where("Stresses at") + ": there is no beam in the model where stresses could be");
    if (!beamdyn_beams.empty())
      throw InputError(parameters.where("BeamDyn files") + ": there is no beam in the model");
    report(model, folder, pictures, page, log);
  }



  void
  SectionReport::write_beamdyn_files(const Context &context) const
  {
    FileNames files;
    for (const auto &name : beamdyn_beams)
      try
        {
          const Beam  &beam = context.system.model.find<Beam>(name, "beam");
          BeamDynBlade blade;
          blade.damping = beam.relaxation_times();
          for (const auto &there : beam.sections_along())
            blade.stations.push_back({there.x, there.values.stiffness, there.values.inertia});
          if (beam.has_trapeze())
            context.log.line("Beam " + name + ": BeamDyn knows no trapeze effect, its file is without it");
          const std::string file = context.folder + "/" + files.next(name) + "_beamdyn.dat";
          replace_file(file, blade.write("Beam " + name + ", length " + number_to_text("%.9g", beam.length()) + " m"));
          context.log.line("Beam " + name + ": " + std::to_string(blade.stations.size()) + " stations for BeamDyn in " +
                           file);
        }
      catch (const std::invalid_argument &problem)
        {
          throw InputError(parameters.where("BeamDyn files") + ": " + problem.what());
        }
  }
} // namespace samara
