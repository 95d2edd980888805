#include <samara/base/text.h>
#include <samara/base/text_file.h>
#include <samara/cosserat/section.h>
#include <samara/model/drawing.h>
#include <samara/section/symmetric_matrix.h>

#include <cmath>
#include <sstream>

namespace samara
{
  std::vector<Eigen::Vector2d>
  drawn_outline(const std::vector<double> &radii, const Matrix6 &C)
  {
    if (radii.size() == 2)
      return ellipse_outline(radii[0], radii[1]);
    const auto radius = [&](const double EI) { return C(0, 0) > 0 && EI > 0 ? 2 * std::sqrt(EI / C(0, 0)) : 0.01; };
    return ellipse_outline(radius(C(5, 5)), radius(C(4, 4)));
  }



  std::vector<Eigen::Vector2d>
  interpolate(const std::vector<Eigen::Vector2d> &a, const std::vector<Eigen::Vector2d> &b, const double w)
  {
    std::vector<Eigen::Vector2d> result = a;
    if (a.size() == b.size())
      for (unsigned int i = 0; i < a.size(); ++i)
        result[i] = (1 - w) * a[i] + w * b[i];
    return result;
  }



  SectionValues
  interpolate(const SectionValues &a, const SectionValues &b, const double w)
  {
    return {(1 - w) * a.stiffness + w * b.stiffness,
            (1 - w) * a.inertia + w * b.inertia,
            interpolate(a.outline, b.outline, w)};
  }



  void
  Section::initialize(Model &model)
  {
    check(model);
  }



  void
  Section::check(Model &model) const
  {
    for (const double x : {0., 1.})
      {
        const SectionValues v = at(x, Vector3::Zero());
        if (Eigen::SelfAdjointEigenSolver<Matrix6>(v.stiffness).eigenvalues()(0) <= 0.)
          model.complaints.add(parameters.where(),
                               "the stiffness of section <" + name +
                                 "> is not positive definite: every one of EA, GA2, GA3, GJ, EI2, EI3 must be "
                                 "positive, and couplings must be small enough");
        else if (Eigen::SelfAdjointEigenSolver<Matrix6>(v.inertia).eigenvalues()(0) < -1e-12 * v.inertia.norm())
          model.complaints.add(parameters.where(),
                               "the inertia of section <" + name + "> is not positive semidefinite");
        else
          continue;
        return;
      }
  }



  void
  EngineeringConstants::add_parameters(Parameters &prm)
  {
    using dealii::Patterns::Double;
    using dealii::Patterns::List;
    const List two(Double(), 2, 2);
    prm.add("EA", EA, "Axial stiffness [N].", Double(0));
    prm.add("GA2", GA2, "Shear stiffness in direction 2, shear factor included [N].", Double(0));
    prm.add("GA3", GA3, "Shear stiffness in direction 3, shear factor included [N].", Double(0));
    prm.add("GJ", GJ, "Torsional stiffness [N*m^2].", Double(0));
    prm.add("EI2", EI2, "Stiffness in bending about axis 2 (curvature K2) [N*m^2].", Double(0));
    prm.add("EI3", EI3, "Stiffness in bending about axis 3 (curvature K3) [N*m^2].", Double(0));
    prm.add("EI23", EI23, "Coupling of the two bendings: M2 = EI2 K2 + EI23 K3 [N*m^2].");
    prm.add("Shear centre", shear_centre, "Its coordinates 2 and 3 in the section [m].", two);
    prm.add("Tension centre", tension_centre, "Its coordinates 2 and 3 in the section [m].", two);
    prm.add("Mass", mass, "Mass per length [kg/m].", Double(0));
    prm.add("Mass centre", mass_centre, "Its coordinates 2 and 3 in the section [m].", two);
    prm.add("I2", I2, "Mass moment of inertia per length about axis 2 through the mass centre [kg*m].", Double(0));
    prm.add("I3", I3, "Mass moment of inertia per length about axis 3 through the mass centre [kg*m].", Double(0));
    prm.add("I23", I23, "Mass product of inertia per length, integral of density y2 y3 [kg*m].");
    prm.add("Drawn radii", drawn_radii, "Half axes along 2 and 3 of the ellipse that is drawn; default: from EI/EA [m].");
  }



  SectionValues
  EngineeringConstants::values() const
  {
    Matrix6 centres = Matrix6::Identity(); // from strains of the reference line to those of the centres
    centres(0, 4)   = tension_centre[1];
    centres(0, 5)   = -tension_centre[0];
    centres(1, 3)   = -shear_centre[1];
    centres(2, 3)   = shear_centre[0];
    Matrix6 C       = Vector6(EA, GA2, GA3, GJ, EI2, EI3).asDiagonal();
    C(4, 5) = C(5, 4) = EI23;

    SectionValues v;
    v.stiffness = centres.transpose() * C * centres;

    Matrix3 J;
    J << I2 + I3, 0, 0, 0, I2, -I23, 0, -I23, I3;
    v.inertia.topLeftCorner<3, 3>()     = mass * Matrix3::Identity();
    v.inertia.bottomRightCorner<3, 3>() = J;
    const Matrix6 T = twist_transfer({0, mass_centre[0], mass_centre[1]}, Matrix3::Identity());
    v.inertia       = T.transpose() * v.inertia * T;

    v.outline = drawn_outline(drawn_radii, v.stiffness);
    return v;
  }



  void
  EngineeringSection::add_parameters(Parameters &prm)
  {
    constants.add_parameters(prm);
  }



  SectionValues
  EngineeringSection::at(const double, const Vector3 &) const
  {
    return constants.values();
  }



  void
  MatrixSection::add_parameters(Parameters &prm)
  {
    prm.add("Stiffness",
            stiffness,
            "6x6 matrix, SI units, order Gamma1 Gamma2 Gamma3 K1 K2 K3: 36 numbers by rows, 21 of the upper triangle by "
            "rows, or 6 of the diagonal.");
    prm.add("Compliance", compliance, "Its inverse, instead of the stiffness: 36, 21 or 6 numbers, SI units.");
    prm.add("Inertia",
            inertia,
            "6x6 matrix per length about the reference line, rows (m I, -m c~) and (m c~, J), SI units: 36, 21 or 6 numbers.");
    prm.add("Drawn radii", drawn_radii, "Half axes along 2 and 3 of the ellipse that is drawn; default: from EI/EA [m].");
  }



  void
  MatrixSection::initialize(Model &model)
  {
    const std::string given = compliance.empty() ? "Stiffness" : "Compliance";
    try
      {
        if (stiffness.empty() == compliance.empty())
          throw std::invalid_argument("give either <Stiffness> or <Compliance>");
        values.stiffness = symmetric_matrix(stiffness.empty() ? compliance : stiffness);
        if (stiffness.empty())
          values.stiffness = values.stiffness.inverse().eval();
        values.outline = drawn_outline(drawn_radii, values.stiffness);
        if (!inertia.empty())
          values.inertia = symmetric_matrix(inertia);
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where(given), problem.what());
        return;
      }
    check(model);
  }



  SectionValues
  MatrixSection::at(const double, const Vector3 &) const
  {
    return values;
  }



  void
  TableSection::add_parameters(Parameters &prm)
  {
    prm.add("Stations",
            stations,
            "Sections at relative abscissae, linear in between: root at 0, tip at 1. Two sections at the same abscissa "
            "make a jump.");
    prm.add_file(
            "File",
            file,
            "Instead of stations: a CSV file whose first line names the columns: x (relative abscissa) and any of EA, "
            "GA2, GA3, GJ, EI2, EI3, EI23, mass, I2, I3, I23, y2 shear, y3 shear, y2 tension, y3 tension, y2 mass, y3 mass, "
            "in SI units; relative to the .prm file that says it.");
  }



  void
  TableSection::initialize(Model &model)
  {
    try
      {
        if (stations.empty() == file.empty())
          throw std::invalid_argument("give either <Stations> or <File>");
        stations.empty() ? read_file(model) : read_stations(model);
        if (abscissae.size() < 2 || !std::is_sorted(abscissae.begin(), abscissae.end()))
          throw std::invalid_argument("a table needs at least two stations in ascending order");
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where(file.empty() ? "Stations" : "File"), problem.what());
        return;
      }
    check(model);
  }



  void
  TableSection::read_stations(Model &model)
  {
    for (const auto &station : stations)
      {
        std::string section, place;
        double      x = 0;
        if (!split_at(station, section, place) || !text_to_number(place, x) || x < 0 || x > 1)
          throw std::invalid_argument("a station is written <section at x> with x from 0 (start) to 1 (end), not <" +
                                      station + ">");
        abscissae.push_back(x);
        const auto &found = model.find<Section>(section, "section");
        values.push_back([&found](const Vector3 &curvature) { return found.at(0, curvature); });
        outlines.push_back(found.outline(0));
        sections.push_back(&found);
        uses_curvature = uses_curvature || found.depends_on_curvature();
      }
  }



  void
  TableSection::read_file(Model &)
  {
    std::istringstream in(text_of_file(file));
    std::string        line;
    std::getline(in, line);
    const auto columns = split_top_level(line, ',');
    lines.push_back(line);
    for (unsigned int number = 2; std::getline(in, line); ++number)
      {
        const std::string place = " in " + file + ":" + std::to_string(number);
        lines.push_back(line);
        EngineeringConstants c;
        const std::map<std::string, double *> variables = {
          {"EA", &c.EA},     {"GA2", &c.GA2},   {"GA3", &c.GA3}, {"GJ", &c.GJ},
          {"EI2", &c.EI2},   {"EI3", &c.EI3},   {"EI23", &c.EI23}, {"mass", &c.mass},
          {"I2", &c.I2},     {"I3", &c.I3},     {"I23", &c.I23},
          {"y2 shear", &c.shear_centre[0]},     {"y3 shear", &c.shear_centre[1]},
          {"y2 tension", &c.tension_centre[0]}, {"y3 tension", &c.tension_centre[1]},
          {"y2 mass", &c.mass_centre[0]},       {"y3 mass", &c.mass_centre[1]}};
        const auto cells = split_top_level(line, ',');
        if (cells.empty())
          continue;
        if (cells.size() != columns.size())
          throw std::invalid_argument("<" + line + ">" + place + " has not as many numbers as the first line has names");
        for (unsigned int i = 0; i < cells.size(); ++i)
          {
            double number = 0;
            if (!text_to_number(cells[i], number))
              throw std::invalid_argument("<" + cells[i] + ">" + place + " is not a number");
            if (columns[i] == "x")
              abscissae.push_back(number);
            else if (variables.count(columns[i]) == 1)
              *variables.at(columns[i]) = number;
            else
              throw std::invalid_argument("there is no column <" + columns[i] + "> in a table of section properties");
          }
        values.push_back([v = c.values()](const Vector3 &) { return v; });
        outlines.push_back(c.values().outline);
      }
    if (abscissae.size() != values.size())
      throw std::invalid_argument("the table has no column <x>");
  }



  std::pair<unsigned int, double>
  TableSection::interval(const double x) const
  {
    unsigned int i = 0;
    while (i + 2 < abscissae.size() && abscissae[i + 1] <= x)
      ++i;
    const double length = abscissae[i + 1] - abscissae[i];
    const double w      = length > 0 ? (x - abscissae[i]) / length : 1.;
    return {i, std::min(1., std::max(0., w))};
  }



  SectionValues
  TableSection::at(const double x, const Vector3 &curvature) const
  {
    const auto [i, w] = interval(x);
    return interpolate(values[i](curvature), values[i + 1](curvature), w);
  }



  std::vector<Eigen::Vector2d>
  TableSection::outline(const double x) const
  {
    const auto [i, w] = interval(x);
    return interpolate(outlines[i], outlines[i + 1], w);
  }



  const AnalysedSection *
  TableSection::nearest(const double x) const
  {
    const auto [i, w] = interval(x);
    return sections.empty() ? nullptr : sections[w < 0.5 ? i : i + 1]->nearest(0);
  }



  bool
  TableSection::depends_on_curvature() const
  {
    return uses_curvature;
  }



  std::vector<double>
  TableSection::kinks() const
  {
    return abscissae;
  }
} // namespace samara
