#include <samara/model/model.h>
#include <samara/section/layup.h>

#include <cmath>

namespace samara
{
  PlyText
  Value<PlyText>::read(const std::string &text, const std::string &unit, const Quantities &quantities)
  {
    const auto pieces = split_top_level(text, ',');
    if (pieces.size() != 3 || pieces[0].empty() || pieces[1].empty())
      throw std::invalid_argument("<" + text +
                                  ">: plies are written <material, angles, thickness>, as <carbon, "
                                  "[0/45]s, 0.125 mm>; the next ones behind a semicolon.");
    layup_angles(pieces[1]);
    const double thickness = quantities.number(pieces[2], unit);
    if (!(thickness > 0) || !std::isfinite(thickness))
      throw std::invalid_argument("<" + text + ">: a ply needs a thickness above zero.");
    return {pieces[0], pieces[1], thickness};
  }



  std::string
  Value<PlyText>::write(const PlyText &value)
  {
    return value.material + ", " + value.angles + ", " + number_to_text(value.thickness);
  }



  PatternPointer
  Value<PlyText>::pattern()
  {
    return std::make_unique<dealii::Patterns::Anything>();
  }



  void
  Layup::add_parameters(Parameters &prm)
  {
    prm.add("Material", material, "Name of the material of all plies.");
    prm.add("Angles",
            angles,
            "Angles of the plies in degrees, the first one at the bottom of a shell or the outside of a section: "
            "[0/45/-45/90]s, 0/90_3, [±30]_2; positive from axis 1 towards axis 2.");
    prm.add("Ply thickness", ply_thickness, "Thickness of each ply [m].", dealii::Patterns::Double(0));
    prm.add(
      "Plies",
      lines,
      "Instead, for plies of different kinds: material, angles, thickness of each; ... as <glass, ±45, 0.3 mm; foam, "
      "0, 8 mm> [m].");
    prm.add("Symmetric", is_symmetric, "Whether the plies given are followed by themselves in the opposite order.");
  }



  void
  Layup::add(const PlyText &line, Model &model)
  {
    const SectionMaterial &m = model.find<Material>(line.material, "material").properties();
    for (const double angle : layup_angles(line.angles))
      own.push_back({&m, angle * M_PI / 180, line.thickness});
  }



  void
  Layup::initialize(Model &model)
  {
    const bool  is_short = !material.empty() || !angles.empty() || ply_thickness > 0;
    std::string entry    = is_short ? "Material" : "Plies";
    try
      {
        if (is_short != lines.empty())
          throw std::invalid_argument("give either <Plies>, or <Material>, <Angles> and <Ply thickness>");
        for (const PlyText &line : lines)
          add(line, model);
        if (is_short)
          {
            for (const char *const wanted : {"Material", "Angles", "Ply thickness"})
              if (!parameters.require(wanted, model.complaints))
                return;
            if (!(ply_thickness > 0))
              {
                entry = "Ply thickness";
                throw std::invalid_argument("a ply needs a thickness above zero");
              }
            const SectionMaterial &m = model.find<Material>(material, "material").properties();
            entry                    = "Angles";
            for (const double angle : layup_angles(angles))
              own.push_back({&m, angle * M_PI / 180, ply_thickness});
          }
        for (std::size_t i = own.size(); is_symmetric && i > 0; --i)
          own.push_back(Ply(own[i - 1]));
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where(entry), problem.what());
      }
  }



  double
  Layup::thickness() const
  {
    double sum = 0;
    for (const Ply &ply : own)
      sum += ply.thickness;
    return sum;
  }



  std::vector<Lamina>
  Layup::laminae() const
  {
    std::vector<Lamina> result;
    for (const Ply &ply : own)
      result.push_back({ply.material->stiffness, ply.angle, ply.thickness, ply.material->density});
    return result;
  }
} // namespace samara
