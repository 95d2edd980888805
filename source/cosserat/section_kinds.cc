#include <samara/base/text.h>
#include <samara/cosserat/section_kinds.h>
#include <samara/cosserat/section_loft.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  using dealii::Patterns::Double;



  void
  ClosedFormSection::add_parameters(Parameters &prm)
  {
    prm.add("E", E, "Young's modulus [Pa].", Double(0));
    prm.add("Poisson ratio", nu, "Poisson's ratio [1].", Double(-1, 0.5));
    prm.add("Density", density, "Density [kg/m^3].", Double(0));
    prm.add(
      "Material",
      material,
      "Instead of the three above: name of a material; stiffness and inertia are then found by warping analysis.");
    AnalysedSection::add_parameters(prm);
  }



  bool
  ClosedFormSection::is_analysed() const
  {
    return !material.empty() || !layup.empty();
  }



  void
  ClosedFormSection::initialize(Model &model)
  {
    // what would have no effect
    const std::vector<std::string> of_closed_form = {"E", "Poisson ratio", "Density", "Shear factor"},
                                   of_analysis    = {"Degree",
                                                     "Elements",
                                                     "Elements per ply",
                                                     "Position",
                                                     "Rotation",
                                                     "Initial curvature"};
    for (const auto &entry : is_analysed() ? of_closed_form : of_analysis)
      if (parameters.is_set(entry))
        model.complaints.add(parameters.where(entry),
                             is_analysed() ?
                               "<" + entry + "> has no effect where a <Material> or <Layup> is named" :
                               "<" + entry +
                                 "> belongs to the analysis of a section, which needs a <Material> or <Layup>");
    AnalysedSection::initialize(model);
  }



  SectionValues
  ClosedFormSection::at(const double x, const Vector3 &curvature) const
  {
    return is_analysed() ? AnalysedSection::at(x, curvature) : closed_form();
  }



  std::vector<Eigen::Vector2d>
  ClosedFormSection::outline(const double x) const
  {
    if (is_analysed())
      return AnalysedSection::outline(x);
    if (drawn.empty())
      drawn = closed_form().outline;
    return drawn;
  }



  std::unique_ptr<const SectionLoft>
  ClosedFormSection::loft_to(const Section &other) const
  {
    const auto *const that = dynamic_cast<const ClosedFormSection *>(&other);
    if (that == nullptr || is_analysed() || that->is_analysed())
      return AnalysedSection::loft_to(other);
    return has_trapeze == that->has_trapeze ? loft_in_closed_form(*that) : nullptr;
  }



  namespace
  {
    double
    linear(const double a, const double b, const double w)
    {
      return (1 - w) * a + w * b;
    }
  } // namespace



  void
  ClosedFormSection::mix(const ClosedFormSection &a, const ClosedFormSection &b, const double w)
  {
    E            = linear(a.E, b.E, w);
    nu           = linear(a.nu, b.nu, w);
    density      = linear(a.density, b.density, w);
    shear_factor = linear(a.shear_factor, b.shear_factor, w);
    has_trapeze  = a.has_trapeze;
  }



  std::vector<Remark>
  ClosedFormSection::remarks() const
  {
    constexpr double little = 1e-3;
    if (is_analysed() || parameters.is_set("Shear factor"))
      return {};
    const Matrix6               C  = closed_form().stiffness;
    const double                GA = C(0, 0) / (2 * (1 + nu));
    const std::array<double, 2> k  = shear_factors_of_energy();
    if (std::max(std::abs(k[0] * GA / C(1, 1) - 1), std::abs(k[1] * GA / C(2, 2) - 1)) < little)
      return {};
    const auto text = [](const double x) { return number_to_text("%.4g", x); };
    return {{Remark::of_check,
             "section " + name + ": GA2 and GA3 have the usual shear factor " + text(C(1, 1) / GA) +
               "; an analysis by <Material> has those of the energy of the warping, which Poisson's ratio changes: " +
               text(k[0]) + " and " + text(k[1])}};
  }



  RectangularSection::RectangularSection()
    : ClosedFormSection(5. / 6)
  {}



  void
  RectangularSection::add_parameters(Parameters &prm)
  {
    prm.add("Width 2", width_2, "Side along axis 2 [m].", Double(0));
    prm.add("Width 3", width_3, "Side along axis 3; not with a layup, which has its thickness [m].", Double(0));
    prm.add(
      "Shear factor",
      shear_factor,
      "Shear stiffness is this times G times the area; by <Material> it is that of the energy of the warping, which "
      "the report tells [1].",
      Double(0, 1));
    prm.add("Layup", layup, "Or name of a layup, its plies stacked along axis 3, the first one lowest.");
    ClosedFormSection::add_parameters(prm);
  }



  SectionValues
  RectangularSection::closed_form() const
  {
    const double G = E / (2 * (1 + nu)), A = width_2 * width_3;
    const double long_side = std::max(width_2, width_3), short_side = std::min(width_2, width_3);
    // Saint-Venant's series for the torsion constant: the sum of tanh(k x)/k^5 over odd k, as that of 1/k^5, known,
    // less a part that converges exponentially
    double series = 31. / 32. * 1.0369277551433699;
    for (unsigned int k = 1; k < 40 && short_side > 0; k += 2)
      series -= (1 - std::tanh(k * M_PI * long_side / (2 * short_side))) / std::pow(k, 5);
    const double ratio = long_side > 0 ? short_side / long_side : 0;
    const double J     = long_side * std::pow(short_side, 3) * (1. / 3. - 64. / std::pow(M_PI, 5) * ratio * series);

    EngineeringConstants c;
    c.EA  = E * A;
    c.GA2 = c.GA3 = shear_factor * G * A;
    c.GJ          = G * J;
    c.EI2         = E * width_2 * std::pow(width_3, 3) / 12;
    c.EI3         = E * width_3 * std::pow(width_2, 3) / 12;
    c.mass        = density * A;
    c.I2          = density * width_2 * std::pow(width_3, 3) / 12;
    c.I3          = density * width_3 * std::pow(width_2, 3) / 12;
    // ∫ E r² dA and ∫ E r⁴ dA
    if (has_trapeze)
      {
        c.trapeze_coupling = c.EI2 + c.EI3;
        c.trapeze_stiffness =
          E * A * (std::pow(width_2, 4) / 80 + std::pow(width_2 * width_3, 2) / 72 + std::pow(width_3, 4) / 80);
      }
    SectionValues v = c.values();
    v.outline       = rectangle_outline(width_2, width_3);
    return v;
  }



  std::array<double, 2>
  RectangularSection::shear_factors_of_energy() const
  {
    // Renton, Int. J. Solids Struct. 27 (1991) 1409, of a force along the side h, b being the other one
    const auto factor = [&](const double b, const double h) {
      double series = 0;
      for (unsigned int n = 1; n < 40; ++n)
        series += std::tanh(n * M_PI * h / b) / std::pow(n, 5);
      return 1 /
             (1.2 + std::pow(nu / (1 + nu), 2) * std::pow(b / h, 4) * (0.2 - 18 / std::pow(M_PI, 5) * b / h * series));
    };
    return {{factor(width_3, width_2), factor(width_2, width_3)}};
  }



  std::unique_ptr<const SectionLoft>
  RectangularSection::loft_in_closed_form(const ClosedFormSection &other) const
  {
    const auto *const that = dynamic_cast<const RectangularSection *>(&other);
    if (that == nullptr)
      return nullptr;
    return std::make_unique<ClosedFormLoft>([this, that](const double w) {
      RectangularSection there;
      there.mix(*this, *that, w);
      there.width_2 = linear(width_2, that->width_2, w);
      there.width_3 = linear(width_3, that->width_3, w);
      return there.closed_form();
    });
  }



  SectionShape
  RectangularSection::make_shape(Model &model)
  {
    SectionShape result;
    if (!layup.empty() && !material.empty())
      model.complaints.add(parameters.where("Layup"), "give either <Material> or <Layup>");
    const Wall   plies  = wall(model, result, "Layup", layup, material, "Width 3", width_3);
    const double height = thickness_of(plies);
    if (!is_positive(model, "Width 2", width_2) || plies.empty())
      return result;
    const Fineness f = fineness();
    if (layup.empty())
      {
        // cells as nearly square as half their number across allows
        const double       longest = std::max(width_2, height);
        const unsigned int least   = (f.along + 1) / 2;
        const auto         number  = [&](const double side) {
          return std::max<unsigned int>(least, std::lround(f.along * side / longest));
        };
        result.patches = rectangle_patches(width_2, height, number(width_2), number(height) * f.per_ply);
        result.finest  = std::min(width_2 / number(width_2), height / number(height)) / f.per_ply;
      }
    else
      {
        result.patches = strip_patches(width_2, plies, f);
        result.finest  = finest_of({plies}, width_2);
      }
    result.outline = rectangle_outline(width_2, height);
    return result;
  }



  TubularSection::TubularSection()
    : ClosedFormSection(0)
  {}



  void
  TubularSection::add_parameters(Parameters &prm)
  {
    prm.add("Outer radius", outer, "Outer radius [m].", Double(0));
    prm.add("Inner radius", inner, "Inner radius, zero for a rod; not with a layup [m].", Double(0));
    prm.add(
      "Shear factor",
      shear_factor,
      "Shear stiffness is this times G times the area; 0: by Cowper; by <Material> it is that of the energy of the "
      "warping, which the report tells [1].",
      Double(0, 1));
    prm.add("Layup",
            layup,
            "Or name of the layup of the wall, the first ply outside; angles turn towards the tangent.");
    ClosedFormSection::add_parameters(prm);
  }



  void
  TubularSection::check(Model &model) const
  {
    if (inner >= outer)
      model.complaints.add(parameters.where("Inner radius"), "the inner radius must be smaller than the outer one");
    else
      AnalysedSection::check(model);
  }



  SectionValues
  TubularSection::closed_form() const
  {
    const double G = E / (2 * (1 + nu)), A = M_PI * (outer * outer - inner * inner),
                 I = M_PI / 4 * (std::pow(outer, 4) - std::pow(inner, 4));
    // shear factor of a hollow circle: Cowper, J. Appl. Mech. 33 (1966) 335
    const double m = inner / outer, q = std::pow(1 + m * m, 2);
    const double cowper = 6 * (1 + nu) * q / ((7 + 6 * nu) * q + (20 + 12 * nu) * m * m);

    EngineeringConstants c;
    c.EA  = E * A;
    c.GA2 = c.GA3 = (shear_factor > 0 ? shear_factor : cowper) * G * A;
    c.GJ          = 2 * G * I;
    c.EI2 = c.EI3 = E * I;
    c.mass        = density * A;
    c.I2 = c.I3 = density * I;
    if (has_trapeze)
      {
        c.trapeze_coupling  = 2 * c.EI2;
        c.trapeze_stiffness = E * M_PI / 3 * (std::pow(outer, 6) - std::pow(inner, 6));
      }
    SectionValues v = c.values();
    v.trapeze       = with_margin(v.trapeze, v.stiffness); // a thin wall is all at one distance
    v.outline       = ellipse_outline(outer, outer);
    return v;
  }



  std::array<double, 2>
  TubularSection::shear_factors_of_energy() const
  {
    // likewise; a half for a thin tube, whose shear is that of a membrane
    const double m = inner * inner / (outer * outer), sum = std::pow(1 + m, 2);
    const double factor =
      6 * std::pow(1 + nu, 2) * sum / ((7 + 14 * nu + 8 * nu * nu) * sum + (20 + 40 * nu + 16 * nu * nu) * m);
    return {{factor, factor}};
  }



  std::unique_ptr<const SectionLoft>
  TubularSection::loft_in_closed_form(const ClosedFormSection &other) const
  {
    // without a shear factor it is Cowper's, between which and a given one there is nothing
    const auto *const that = dynamic_cast<const TubularSection *>(&other);
    if (that == nullptr || (shear_factor > 0) != (that->shear_factor > 0))
      return nullptr;
    return std::make_unique<ClosedFormLoft>([this, that](const double w) {
      TubularSection there;
      there.mix(*this, *that, w);
      there.outer = linear(outer, that->outer, w);
      there.inner = linear(inner, that->inner, w);
      return there.closed_form();
    });
  }



  SectionShape
  TubularSection::make_shape(Model &model)
  {
    SectionShape result;
    if (!layup.empty() && !material.empty())
      model.complaints.add(parameters.where("Layup"), "give either <Material> or <Layup>");
    if (!is_positive(model, "Outer radius", outer))
      return result;
    result.outline = ellipse_outline(outer, outer);
    if (layup.empty() && inner == 0)
      {
        material_number(model, result, "Material", material);
        result.patches = ellipse_patches(outer, outer, std::max(2u, fineness().along / 2));
        result.finest  = outer / fineness().along;
        return result;
      }
    if (layup.empty() && inner >= outer)
      {
        model.complaints.add(parameters.where("Inner radius"), "the inner radius must be smaller than the outer one");
        return result;
      }
    const Wall plies = wall(model, result, "Layup", layup, material, "Inner radius", outer - inner);
    if (plies.empty())
      return result;
    if (thickness_of(plies) > 0.99 * outer)
      {
        model.complaints.add(parameters.where("Layup"), "the layup is thicker than the tube's radius");
        return result;
      }
    result.patches = ring_patches(outer, plies, fineness());
    result.finest  = finest_of({plies}, 2 * M_PI * (outer - thickness_of(plies)) / 2);
    return result;
  }



  void
  EllipticSection::add_parameters(Parameters &prm)
  {
    prm.add("Radius 2", radius_2, "Half axis along axis 2 [m].", Double(0));
    prm.add("Radius 3", radius_3, "Half axis along axis 3 [m].", Double(0));
    prm.add("Material", material, "Name of the material.");
    AnalysedSection::add_parameters(prm);
  }



  SectionShape
  EllipticSection::make_shape(Model &model)
  {
    SectionShape result;
    const bool   has_2 = is_positive(model, "Radius 2", radius_2), has_3 = is_positive(model, "Radius 3", radius_3);
    if (!parameters.require("Material", model.complaints) || !has_2 || !has_3)
      return result;
    material_number(model, result, "Material", material);
    const unsigned int n = std::max(2u, fineness().along);
    result.patches       = ellipse_patches(radius_2, radius_3, n);
    result.finest        = std::min(radius_2, radius_3) / n;
    result.outline       = ellipse_outline(radius_2, radius_3);
    return result;
  }



  namespace
  {
    const std::array<const char *, 4> sides_of_box = {{"bottom", "right", "top", "left"}};
  }



  void
  BoxSection::add_parameters(Parameters &prm)
  {
    prm.add("Width 2", width_2, "Between the outer faces along axis 2 [m].", Double(0));
    prm.add("Width 3", width_3, "Between the outer faces along axis 3 [m].", Double(0));
    prm.add("Thickness", thickness, "Of all walls, where there is no layup [m].", Double(0));
    prm.add("Material", material, "Name of the material, where there is no layup.");
    prm.add("Layup",
            layup,
            "Name of the layup of all walls, the first ply outside; angles turn from axis 1 towards the way round the "
            "section, from axis 2 to axis 3.");
    for (unsigned int w = 0; w < 4; ++w)
      prm.add(std::string("Layup of ") + sides_of_box[w], layups[w], "Layup of this wall, if it has its own.");
    AnalysedSection::add_parameters(prm);
  }



  SectionShape
  BoxSection::make_shape(Model &model)
  {
    SectionShape      result;
    std::vector<Wall> walls;
    const bool        has_2 = is_positive(model, "Width 2", width_2), has_3 = is_positive(model, "Width 3", width_3);
    for (unsigned int w = 0; w < 4; ++w)
      {
        const bool is_own = !layups[w].empty();
        walls.push_back(wall(model,
                             result,
                             is_own ? std::string("Layup of ") + sides_of_box[w] : "Layup",
                             is_own ? layups[w] : layup,
                             material,
                             "Thickness",
                             thickness));
        if (walls.back().empty())
          return result;
      }
    if (!has_2 || !has_3)
      return result;
    const double x = width_2 / 2, y = width_3 / 2;
    result.patches = wall_patches({{-x, -y}, {x, -y}, {x, y}, {-x, y}}, walls, fineness());
    result.finest  = finest_of(walls, std::max(width_2, width_3));
    result.outline = rectangle_outline(width_2, width_3);
    return result;
  }



  void
  ISection::add_parameters(Parameters &prm)
  {
    prm.add("Height", height, "Between the outer faces of the flanges, along axis 3 [m].", Double(0));
    prm.add("Lower width", lower_width, "Of the lower flange, along axis 2 [m].", Double(0));
    prm.add("Upper width", upper_width, "Of the upper flange; not given: as the lower one [m].", Double(0));
    prm.add("Lower thickness", lower_thickness, "Of the lower flange [m].", Double(0));
    prm.add("Upper thickness", upper_thickness, "Of the upper flange; not given: as the lower one [m].", Double(0));
    prm.add("Web thickness", web_thickness, "Of the web [m].", Double(0));
    prm.add("Material", material, "Name of the material, where there is no layup.");
    prm.add("Lower layup", lower_layup, "Of the lower flange, the first ply outside; angles turn towards +2.");
    prm.add("Upper layup", upper_layup, "Of the upper flange, the first ply outside; angles turn towards -2.");
    prm.add("Web layup", web_layup, "Of the web, the first ply on the side of -2; angles turn towards -3.");
    AnalysedSection::add_parameters(prm);
  }



  SectionShape
  ISection::make_shape(Model &model)
  {
    SectionShape              result;
    const double              t_upper = parameters.is_set("Upper thickness") ? upper_thickness : lower_thickness;
    const std::string         upper   = parameters.is_set("Upper thickness") ? "Upper thickness" : "Lower thickness";
    const std::array<Wall, 2> flanges = {
      {wall(model, result, "Lower layup", lower_layup, material, "Lower thickness", lower_thickness),
       wall(model,
            result,
            "Upper layup",
            upper_layup,
            material,
            upper_layup.empty() ? upper : "Upper thickness",
            t_upper)}};
    const Wall   web   = wall(model, result, "Web layup", web_layup, material, "Web thickness", web_thickness);
    const bool   has_h = is_positive(model, "Height", height), has_b = is_positive(model, "Lower width", lower_width);
    const double b[2] = {lower_width, parameters.is_set("Upper width") ? upper_width : lower_width};
    if (!has_h || !has_b || !is_positive(model, "Upper width", b[1]) || web.empty() || flanges[0].empty() ||
        flanges[1].empty())
      return result;
    result.patches = I_patches(height, {{b[0], b[1]}}, flanges, web, fineness());
    result.finest  = finest_of({flanges[0], flanges[1], web}, std::max({height, b[0], b[1]}));
    const double t = thickness_of(web) / 2, y = height / 2, low = -y + thickness_of(flanges[0]),
                 high = y - thickness_of(flanges[1]);
    for (const auto &x : std::vector<std::array<double, 2>>{{{-b[0] / 2, -y}},
                                                            {{b[0] / 2, -y}},
                                                            {{b[0] / 2, low}},
                                                            {{t, low}},
                                                            {{t, high}},
                                                            {{b[1] / 2, high}},
                                                            {{b[1] / 2, y}},
                                                            {{-b[1] / 2, y}},
                                                            {{-b[1] / 2, high}},
                                                            {{-t, high}},
                                                            {{-t, low}},
                                                            {{-b[0] / 2, low}}})
      result.outline.emplace_back(x[0], x[1]);
    return result;
  }



  void
  ChannelSection::add_parameters(Parameters &prm)
  {
    prm.add("Height", height, "Between the outer faces of the flanges, along axis 3 [m].", Double(0));
    prm.add("Width", width, "From the outer face of the web to the ends of the flanges, along axis 2 [m].", Double(0));
    prm.add("Flange thickness", flange_thickness, "Of both flanges [m].", Double(0));
    prm.add("Web thickness", web_thickness, "Of the web [m].", Double(0));
    prm.add("Material", material, "Name of the material, where there is no layup.");
    prm.add("Upper layup", upper_layup, "Of the upper flange, the first ply outside; angles turn towards -2.");
    prm.add("Web layup", web_layup, "Of the web, the first ply outside; angles turn towards -3.");
    prm.add("Lower layup", lower_layup, "Of the lower flange, the first ply outside; angles turn towards +2.");
    AnalysedSection::add_parameters(prm);
  }



  SectionShape
  ChannelSection::make_shape(Model &model)
  {
    SectionShape            result;
    const std::vector<Wall> walls = {
      wall(model, result, "Upper layup", upper_layup, material, "Flange thickness", flange_thickness),
      wall(model, result, "Web layup", web_layup, material, "Web thickness", web_thickness),
      wall(model, result, "Lower layup", lower_layup, material, "Flange thickness", flange_thickness)};
    const bool has_h = is_positive(model, "Height", height), has_w = is_positive(model, "Width", width);
    if (!has_h || !has_w || walls[0].empty() || walls[1].empty() || walls[2].empty())
      return result;
    const double y = height / 2, top = y - thickness_of(walls[0]), bottom = -y + thickness_of(walls[2]),
                 t = thickness_of(walls[1]);
    if (!(top - bottom > 1e-6 * height))
      throw std::invalid_argument("the flanges are as thick as the section is high: nothing is left between them");
    result.patches = wall_patches({{width, y}, {0, y}, {0, -y}, {width, -y}}, walls, fineness());
    result.finest  = finest_of(walls, std::max(width, height));
    for (const auto &x : std::vector<std::array<double, 2>>{{{0, -y}},
                                                            {{width, -y}},
                                                            {{width, bottom}},
                                                            {{t, bottom}},
                                                            {{t, top}},
                                                            {{width, top}},
                                                            {{width, y}},
                                                            {{0, y}}})
      result.outline.emplace_back(x[0], x[1]);
    return result;
  }
} // namespace samara
