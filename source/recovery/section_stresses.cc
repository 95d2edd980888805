// What the analysis of sections tells of stresses.

#include <samara/analysis/dynamic.h>
#include <samara/base/text.h>
#include <samara/output/file.h>
#include <samara/output/table.h>
#include <samara/recovery/section_report.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <tuple>

namespace samara
{
  namespace
  {
    using Extremes = SectionStresses::Extremes;

    const std::vector<std::string> columns_of_extremes = {"stress 11 [Pa]",
                                                          "stress 22 [Pa]",
                                                          "stress 33 [Pa]",
                                                          "stress 23 [Pa]",
                                                          "stress 13 [Pa]",
                                                          "stress 12 [Pa]",
                                                          "von Mises stress [Pa]",
                                                          "index of max stress",
                                                          "index of Tsai-Wu",
                                                          "index of Hashin",
                                                          "index of von Mises"};



    void
    add_extremes(std::vector<Table::Cell> &row, const Extremes &extremes)
    {
      for (int i = 0; i < 6; ++i)
        row.emplace_back(extremes.stress(i));
      row.emplace_back(extremes.von_mises_stress);
      const FailureIndices &indices = extremes.indices;
      for (const double index : {indices.max_stress, indices.tsai_wu, indices.hashin, indices.von_mises})
        row.push_back(Table::Cell::optional(index < 0 ? std::nan("") : index));
    }



    const std::string change_of_stresses = "change with one degree more";

    Table
    table_with(std::vector<std::string> columns, const std::vector<std::string> &last)
    {
      columns.insert(columns.end(), columns_of_extremes.begin(), columns_of_extremes.end());
      columns.insert(columns.end(), last.begin(), last.end());
      return Table(columns);
    }



    /** Nothing, if the equations of the finer analysis are lost in round-off. */
    std::shared_ptr<const SectionStresses>
    with_one_degree_more(const AnalysedShape &shape, const Vector3 &curvature)
    {
      try
        {
          const auto analysis = shape.analyse(curvature, 1);
          return std::make_shared<SectionStresses>(analysis->section, analysis->mesh, analysis->shape.materials);
        }
      catch (const std::invalid_argument &)
        {
          return nullptr;
        }
    }



    /** Of the largest von Mises stress and of the largest index, relative to the finer ones. */
    double
    largest_change(const Extremes &own, const Extremes &finer)
    {
      const auto change = [](const double x, const double y) { return y > 0 ? std::abs(x - y) / y : 0.; };
      return std::max(change(own.von_mises_stress, finer.von_mises_stress),
                      change(own.indices.largest(), finer.indices.largest()));
    }



    /** A layer of cells of a wall, which are of one ply. */
    struct Layer
    {
      std::string  wall;   ///< its name, or its number from 1
      unsigned int number; ///< from 1
      Ply          ply;
      Extremes     extremes;
    };

    /** Stresses by layers, the walls in the order of the shape. */
    std::vector<Layer>
    layers_of(const SectionAnalysis &analysis, const Vector6 &forces, const double helix)
    {
      // cells are numbered patch by patch, layer by layer
      std::vector<Layer>        layers;
      std::vector<unsigned int> layer_of_cell;
      const auto               &patches = analysis.shape.patches;
      std::map<std::tuple<std::string, unsigned int, unsigned int, double>, unsigned int> of_group;
      for (unsigned int k = 0; k < patches.size(); ++k)
        for (unsigned int j = 0; j + 1 < patches[k].v.size(); ++j)
          {
            const std::string &group = patches[k].group;
            const Ply          ply   = patches[k].ply(0, j);
            unsigned int       layer = layers.size();
            if (!group.empty())
              layer = of_group.emplace(std::make_tuple(group, j, ply.material, ply.angle), layer).first->second;
            if (layer == layers.size())
              layers.push_back({group.empty() ? std::to_string(k + 1) : group, j + 1, ply, {}});
            layer_of_cell.insert(layer_of_cell.end(), patches[k].u.size() - 1, layer);
          }
      for (const auto &point : analysis.section.points_with_faces())
        {
          const Ply &ply   = analysis.mesh.ply(point.cell);
          Layer     &layer = layers.at(layer_of_cell.at(point.cell));
          AssertThrow(ply.material == layer.ply.material && ply.angle == layer.ply.angle,
                      dealii::ExcMessage("a layer of a section has more than one ply"));
          layer.extremes.add(analysis.shape.materials[ply.material].strengths,
                             CrossSection::stress_in_material(point, forces, helix));
        }
      return layers;
    }
  } // namespace



  SectionReport::StressedPlace
  SectionReport::place_named(const std::string &place, const Context &context)
  {
    std::string name, at;
    const auto  dot    = place.find('.');
    const bool  has_at = split_at(place, name, at) && name.find('.') == std::string::npos;
    if (!has_at && dot == std::string::npos)
      throw std::invalid_argument("a place is written <blade at 0.3> or <blade.root>, not <" + place + ">");
    const Beam &beam = context.system.model.find<Beam>(has_at ? name : trim(place.substr(0, dot)), "beam");
    return {place,
            place,
            beam.station(context.state, has_at ? "at " + at : trim(place.substr(dot + 1))),
            context.state.time};
  }



  void
  SectionReport::watch(const Model &model, const std::vector<std::unique_ptr<Analysis>> &analyses)
  {
    for (const auto &name : names_of_watched)
      try
        {
          watched.push_back(std::make_shared<LargestStress>(model.find<Beam>(name, "beam"), criterion));
        }
      catch (const std::invalid_argument &problem)
        {
          throw InputError(parameters.where("Largest of") + ": " + problem.what());
        }
    for (const auto &analysis : analyses)
      {
        if (analysis.get() == this)
          return; // motions behind it are not looked at
        if (auto *const motion = dynamic_cast<DynamicAnalysis *>(analysis.get()); motion != nullptr && !watched.empty())
          {
            sees_motion       = true;
            const auto before = motion->observer;
            motion->observer  = [this, before](const State &state) {
              if (before)
                before(state);
              look(state);
            };
          }
      }
  }



  void
  SectionReport::look(const State &state)
  {
    try
      {
        for (const auto &one : watched)
          one->look(state);
      }
    catch (const std::invalid_argument &problem)
      {
        throw InputError(parameters.where("Largest of") + ": " + problem.what());
      }
  }



  void
  SectionReport::report_stresses(const Context &context)
  {
    std::vector<StressedPlace> wanted;
    try
      {
        for (const auto &place : places)
          wanted.push_back(place_named(place, context));
      }
    catch (const std::invalid_argument &problem)
      {
        throw InputError(parameters.where("Stresses at") + ": " + problem.what());
      }
    for (auto &one : watched)
      {
        if (!sees_motion)
          one = std::make_shared<LargestStress>(one->beam, criterion); // at another speed
        if (!one->found)
          look(context.state);
        const auto &f = *one->found;
        wanted.push_back({one->beam.name + " at " + number_to_text(f.x), one->beam.name + " largest", f.there, f.time});
        context.log.line("Beam " + one->beam.name + ", t = " + short_text(one->first_time) + " to " +
                         short_text(one->last_time) + " s: the index of failure, " + criterion + ", is largest at " +
                         number_to_text(f.x) + " of its length, t = " + short_text(f.time) +
                         " s: " + number_to_text("%.6g", f.index));
      }

    tell_stresses(context, wanted);
  }



  void
  SectionReport::tell_stresses(const Context &context, const std::vector<StressedPlace> &wanted) const
  {
    Table whole = table_with(
            {"place", "time [s]", "section", "F1 [N]", "F2 [N]", "F3 [N]", "M1 [N m]", "M2 [N m]", "M3 [N m]"},
            {change_of_stresses}),
          plies = table_with({"place", "time [s]", "section", "wall", "layer", "material", "angle [deg]"}, {});
    FileNames files;
    for (const StressedPlace &place : wanted)
      {
        const Beam::Station                     &here = place.there;
        std::vector<std::pair<double, Extremes>> of_sections, finer;
        std::vector<std::string>                 names;
        std::vector<BeamStresses::Part>          parts;
        const auto nearest = std::max_element(here.parts.begin(), here.parts.end(), [](const auto &a, const auto &b) {
          return a.section.weight < b.section.weight;
        });
        for (const StressPart &part : here.parts)
          {
            const auto    analysis = part.section.shape->analyse(here.curvature);
            const Vector6 forces   = part.forces * here.linear_forces;
            Extremes      of_all;
            for (const auto &layer : layers_of(*analysis, forces, here.helix))
              {
                std::vector<Table::Cell> of_ply = {place.name,
                                                   place.time,
                                                   part.section.name,
                                                   layer.wall,
                                                   std::to_string(layer.number),
                                                   analysis->shape.materials[layer.ply.material].name,
                                                   layer.ply.angle * 180 / M_PI};
                add_extremes(of_ply, layer.extremes);
                plies.add_row(of_ply);
                of_all.add(layer.extremes);
              }
            names.push_back(part.section.name);
            of_sections.emplace_back(part.section.weight, of_all);
            parts.push_back({part, section_stresses_of(*part.section.shape, here.curvature)});
            if (const auto more = with_one_degree_more(*part.section.shape, here.curvature))
              finer.emplace_back(part.section.weight, more->extremes(forces, here.helix));
            if (context.page != nullptr && context.is_shown() && &part == &*nearest)
              context.page->add("stresses " + place.name, 0, drawing_of_stresses(*analysis, forces, here.helix, part.section.name));
            if (context.pictures && context.is_shown() && &part == &*nearest)
              replace_file(context.folder + "/stresses_" + files.next(place.file) + ".vtu",
                           picture_of_stresses(*analysis, forces, here.helix, here.x, here.D));
          }
        const Extremes           of_all = mean_of(of_sections);
        std::vector<Table::Cell> row    = {place.name, place.time, join(names, ", ")};
        for (int i = 0; i < 6; ++i)
          row.emplace_back(here.forces(i));
        add_extremes(row, of_all);
        row.push_back(Table::Cell::optional(
          finer.size() == of_sections.size() ? largest_change(of_all, mean_of(finer)) : std::nan("")));
        whole.add_row(row);
        if (const std::string text = BeamStresses(parts).disagreement(here.linear_forces, here.helix); !text.empty())
          context.log.warning(parameters.where(), place.name + ": " + text);
      }
    whole.write(context.folder + "/stresses.csv");
    plies.write(context.folder + "/stresses_of_plies.csv");
    std::ostringstream text;
    whole.print(text);
    context.log.line(text.str());
  }
} // namespace samara
