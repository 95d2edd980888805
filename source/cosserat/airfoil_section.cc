#include <samara/base/refused_pictures.h>
#include <samara/base/text.h>
#include <samara/cosserat/airfoil_section.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace samara
{
  using dealii::Patterns::Double;
  using dealii::Patterns::Selection;

  namespace
  {
    double
    fraction_of_chord(const std::string &text, const Quantities &quantities, const std::string &whole)
    {
      const double x = quantities.number(text, "");
      if (!(x >= 0 && x <= 1))
        throw std::invalid_argument(
          "<" + whole + ">: positions are fractions of the chord, from 0 at the nose to 1, and <" + text + "> is not.");
      return x;
    }
  } // namespace



  AirfoilRangeText
  Value<AirfoilRangeText>::read(const std::string &text, const std::string &, const Quantities &quantities)
  {
    const auto pieces = split_top_level(text, ',');
    if (pieces.size() != 4 || pieces[3].empty())
      throw std::invalid_argument("<" + text +
                                  ">: a range of the skin is written <side, from, to, layup>, as <upper, 0.15, 0.5, "
                                  "cap>; the next one behind a semicolon.");
    if (pieces[0] != "lower" && pieces[0] != "upper" && pieces[0] != "both")
      throw std::invalid_argument("<" + pieces[0] + "> in <" + text + "> is no side" +
                                  did_you_mean(pieces[0], {"lower", "upper", "both"}));
    const AirfoilRangeText result{pieces[0],
                                  fraction_of_chord(pieces[1], quantities, text),
                                  fraction_of_chord(pieces[2], quantities, text),
                                  pieces[3]};
    if (!(result.from < result.to))
      throw std::invalid_argument("<" + text + ">: a range goes from its front to its back, from < to.");
    return result;
  }



  std::string
  Value<AirfoilRangeText>::write(const AirfoilRangeText &value)
  {
    return value.side + ", " + number_to_text(value.from) + ", " + number_to_text(value.to) + ", " + value.layup;
  }



  PatternPointer
  Value<AirfoilRangeText>::pattern()
  {
    return std::make_unique<dealii::Patterns::Anything>();
  }



  AirfoilWebText
  Value<AirfoilWebText>::read(const std::string &text, const std::string &, const Quantities &quantities)
  {
    const auto pieces = split_top_level(text, ',');
    if ((pieces.size() != 2 && pieces.size() != 3) || pieces.back().empty())
      throw std::invalid_argument(
        "<" + text +
        ">: a web is written <x/c, layup>, as <0.25, web>, or <x/c below, x/c above, layup>; the "
        "next one behind a semicolon.");
    return {fraction_of_chord(pieces[0], quantities, text),
            fraction_of_chord(pieces[pieces.size() - 2], quantities, text),
            pieces.back()};
  }



  std::string
  Value<AirfoilWebText>::write(const AirfoilWebText &value)
  {
    return number_to_text(value.lower) + ", " + (value.lower == value.upper ? "" : number_to_text(value.upper) + ", ") +
           value.layup;
  }



  PatternPointer
  Value<AirfoilWebText>::pattern()
  {
    return std::make_unique<dealii::Patterns::Anything>();
  }



  void
  AirfoilSection::add_parameters(Parameters &prm)
  {
    prm.add("NACA", naca, "The outline by the digits of NACA's four-digit series: 2418.");
    prm.add("NACA trailing edge",
            naca_edge,
            "Blunt as the series has it, or sharp, closed by the last coefficient.",
            Selection("blunt|sharp"));
    prm.add_file("Coordinates",
                 file,
                 "Or a text file with the outline: x/c and y/c on each line, from the trailing edge round the nose and "
                 "back, or each side from the nose. Relative to the .prm file that says it.");
    prm.add("Chord", chord, "Chord [m].", Double(0));
    prm.add("Origin", origin, "Where on the chord the origin is, from 0 at the nose to 1 [1].");
    prm.add("Layup",
            layup,
            "Name of the layup of the skin, the first ply outside; angles turn from axis 1 towards the way "
            "from the trailing edge along the lower side round the nose and back.");
    prm.add("Material", material, "Or name of the material of the skin.");
    prm.add("Thickness", thickness, "Of the skin, where there is no layup [m].", Double(0));
    prm.add(
      "Skins",
      skins,
      "Parts with another layup in place of that of the skin: side, from, to, layup; ... with lower, upper or both "
      "sides and fractions of the chord, as <both, 0.5, 0.9, sandwich>. Later ones count where they overlap.");
    prm.add("Spar caps", caps, "Layups on the inside of the skin, written likewise.");
    prm.add(
      "Webs",
      webs,
      "x/c of the middle and layup of each web, or x/c below, above and layup; ... The first ply is on the side of "
      "the trailing edge; angles turn from axis 1 towards -3.");
    prm.add(
      "Trailing edge material",
      trailing_material,
      "Of the block behind the skins, where they come near each other; not given: that of the skin, if it is one.");
    prm.add("Trailing edge from",
            trailing_from,
            "Where that block begins, a fraction of the chord; 0: where half a skin is left between the skins [1].",
            Double(0, 1));
    prm.add(
      "Trailing edge skins",
      skins_run_on,
      "Whether the skins run on into that block, their plies ever thinner with it, and its material is between them "
      "alone.");
    prm.add("Nose material", nose_material, "Of a weight that fills the nose inside of the skin.");
    prm.add("Nose to", nose_to, "As far as here, a fraction of the chord [1].", Double(0, 1));
    AnalysedSection::add_parameters(prm);
  }



  std::shared_ptr<const AirfoilOutline>
  AirfoilSection::make_outline(Model &model) const
  {
    const std::string entry = naca.empty() ? "Coordinates" : "NACA";
    if (naca.empty() == file.empty())
      {
        model.complaints.add(parameters.where(entry), "section <" + name + ">: give either <NACA> or <Coordinates>");
        return nullptr;
      }
    if (naca.empty() && parameters.is_set("NACA trailing edge"))
      model.complaints.add(parameters.where("NACA trailing edge"),
                           "<NACA trailing edge> has no effect where <Coordinates> are given");
    if (!is_positive(model, "Chord", chord))
      return nullptr;
    try
      {
        return std::make_shared<AirfoilOutline>(
          naca.empty() ? read_airfoil(file) : naca_points(naca, naca_edge == "sharp"), chord, origin);
      }
    catch (const std::invalid_argument &problem)
      {
        const std::string what = problem.what();
        model.complaints.add(parameters.where(entry),
                             naca.empty() && what.find(file) == std::string::npos ? file + ": " + what : what);
        return nullptr;
      }
  }



  Wall
  AirfoilSection::layup_of(Model             &model,
                           SectionShape      &shape,
                           const std::string &entry,
                           const std::string &of_part) const
  {
    Wall result;
    try
      {
        for (const Layup::Ply &ply : model.find<Layup>(of_part, "layup").plies())
          result.push_back({material_number(model, shape, entry, ply.material->name), ply.angle, ply.thickness});
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where(entry), problem.what());
      }
    return result;
  }



  void
  AirfoilSection::add_ranges(Model                               &model,
                             SectionShape                        &shape,
                             const std::string                   &entry,
                             const std::vector<AirfoilRangeText> &texts,
                             AirfoilDesign                       &design) const
  {
    for (const auto &text : texts)
      design.ranges.push_back({text.side != "upper",
                               text.side != "lower",
                               text.from,
                               text.to,
                               layup_of(model, shape, entry, text.layup),
                               entry == "Spar caps"});
  }



  AirfoilDesign
  AirfoilSection::make_design(Model &model, SectionShape &shape) const
  {
    AirfoilDesign design;
    if (!layup.empty() && !material.empty())
      model.complaints.add(parameters.where("Layup"), "give either <Material> or <Layup>");
    design.skin = wall(model, shape, "Layup", layup, material, "Thickness", thickness);
    add_ranges(model, shape, "Skins", skins, design);
    add_ranges(model, shape, "Spar caps", caps, design);
    for (const auto &web : webs)
      design.webs.push_back({web.lower, web.upper, layup_of(model, shape, "Webs", web.layup)});
    if (trailing_material.empty() && material.empty())
      model.complaints.add(parameters.where("Trailing edge material"),
                           "section <" + name + "> needs a <Trailing edge material>, of the block behind the skins");
    else
      design.trailing_material = material_number(model,
                                                 shape,
                                                 trailing_material.empty() ? "Material" : "Trailing edge material",
                                                 trailing_material.empty() ? material : trailing_material);
    if (trailing_from > 0)
      design.trailing_from = trailing_from;
    design.skins_run_on = skins_run_on;
    if (nose_material.empty() != (nose_to == 0))
      model.complaints.add(parameters.where(nose_material.empty() ? "Nose to" : "Nose material"),
                           "a weight in the nose needs both <Nose material> and <Nose to>");
    else if (!nose_material.empty())
      {
        design.nose_material = material_number(model, shape, "Nose material", nose_material);
        design.nose_to       = nose_to;
      }
    design.fineness = fineness();
    return design;
  }



  SectionShape
  AirfoilSection::make_shape(Model &model)
  {
    SectionShape        result;
    const auto          before  = model.complaints.count();
    const auto          outline = make_outline(model);
    const AirfoilDesign design  = make_design(model, result);
    if (model.complaints.count() != before)
      return result;
    std::string picture;
    try
      {
        const AirfoilMesh mesh(outline, design);
        result.patches           = mesh.patches;
        result.finest            = mesh.finest;
        constexpr unsigned int n = 120;
        for (unsigned int i = 0; i < n; ++i)
          {
            const auto x = outline->place(outline->length() * i / (n - 1));
            result.outline.emplace_back(x[0], x[1]);
          }
        picture = mesh.picture("section " + name);
        try_mesh(result);
      }
    catch (const std::invalid_argument &problem)
      {
        if (const auto *const fault = dynamic_cast<const AirfoilFault *>(&problem))
          picture = fault->picture;
        const std::string folder = folder_of_refused_pictures();
        std::error_code   is_no_folder;
        if (!folder.empty())
          std::filesystem::create_directories(folder, is_no_folder);
        std::string drawn = folder.empty() ? "section_" : folder + "/section_";
        for (const char c : name)
          drawn += std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' ? c : '_';
        drawn += ".svg";
        std::ofstream file_of_picture(drawn);
        const bool    is_drawn = static_cast<bool>(file_of_picture << picture << std::flush);
        throw std::invalid_argument("section <" + name + ">: " + problem.what() + (is_drawn ? "; see " + drawn : ""));
      }
    return result;
  }
} // namespace samara
