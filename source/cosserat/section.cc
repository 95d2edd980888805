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



  SectionValues
  interpolate(const SectionValues &a, const SectionValues &b, const double w)
  {
    SectionValues v{(1 - w) * a.stiffness + w * b.stiffness, (1 - w) * a.inertia + w * b.inertia, a.outline};
    if (a.outline.size() == b.outline.size())
      for (unsigned int i = 0; i < v.outline.size(); ++i)
        v.outline[i] = (1 - w) * a.outline[i] + w * b.outline[i];
    return v;
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
        const SectionValues v = at(x);
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
  EngineeringSection::at(const double) const
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
  MatrixSection::at(const double) const
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
        values.push_back(model.find<Section>(section, "section").at(0));
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
        values.push_back(c.values());
      }
    if (abscissae.size() != values.size())
      throw std::invalid_argument("the table has no column <x>");
  }



  SectionValues
  TableSection::at(const double x) const
  {
    unsigned int i = 0;
    while (i + 2 < abscissae.size() && abscissae[i + 1] <= x)
      ++i;
    const double length = abscissae[i + 1] - abscissae[i];
    const double w      = length > 0 ? (x - abscissae[i]) / length : 1.;
    return interpolate(values[i], values[i + 1], std::min(1., std::max(0., w)));
  }



  std::vector<double>
  TableSection::kinks() const
  {
    return abscissae;
  }



  void
  RectangularSection::add_parameters(Parameters &prm)
  {
    using dealii::Patterns::Double;
    prm.add("E", E, "Young's modulus [Pa].", Double(0));
    prm.add("Poisson ratio", nu, "Poisson's ratio [1].", Double(-1, 0.5));
    prm.add("Density", density, "Density [kg/m^3].", Double(0));
    prm.add("Width 2", width_2, "Side along axis 2 [m].", Double(0));
    prm.add("Width 3", width_3, "Side along axis 3 [m].", Double(0));
    prm.add("Shear factor", shear_factor, "Shear stiffness is this times G times the area [1].", Double(0, 1));
  }



  SectionValues
  RectangularSection::at(const double) const
  {
    const double G = E / (2 * (1 + nu)), A = width_2 * width_3;
    const double long_side = std::max(width_2, width_3), short_side = std::min(width_2, width_3);
    // Saint-Venant's series for the torsion constant: the sum of tanh(k x)/k^5 over odd k, as that of 1/k^5, known, less a
    // part that converges exponentially
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
    SectionValues v = c.values();
    v.outline       = rectangle_outline(width_2, width_3);
    return v;
  }



  void
  TubularSection::add_parameters(Parameters &prm)
  {
    using dealii::Patterns::Double;
    prm.add("E", E, "Young's modulus [Pa].", Double(0));
    prm.add("Poisson ratio", nu, "Poisson's ratio [1].", Double(-1, 0.5));
    prm.add("Density", density, "Density [kg/m^3].", Double(0));
    prm.add("Outer radius", outer, "Outer radius [m].", Double(0));
    prm.add("Inner radius", inner, "Inner radius, zero for a rod [m].", Double(0));
    prm.add("Shear factor", shear_factor, "Shear stiffness is this times G times the area; 0: by Cowper [1].", Double(0, 1));
  }



  void
  TubularSection::check(Model &model) const
  {
    if (inner >= outer)
      model.complaints.add(parameters.where("Inner radius"), "the inner radius must be smaller than the outer one");
    else
      Section::check(model);
  }



  SectionValues
  TubularSection::at(const double) const
  {
    const double G = E / (2 * (1 + nu)), A = M_PI * (outer * outer - inner * inner),
                 I = M_PI / 4 * (std::pow(outer, 4) - std::pow(inner, 4));
    const double m = inner / outer, q = std::pow(1 + m * m, 2);
    const double cowper = 6 * (1 + nu) * q / ((7 + 6 * nu) * q + (20 + 12 * nu) * m * m);

    EngineeringConstants c;
    c.EA  = E * A;
    c.GA2 = c.GA3 = (shear_factor > 0 ? shear_factor : cowper) * G * A;
    c.GJ          = 2 * G * I;
    c.EI2 = c.EI3 = E * I;
    c.mass        = density * A;
    c.I2 = c.I3     = density * I;
    SectionValues v = c.values();
    v.outline       = ellipse_outline(outer, outer);
    return v;
  }
} // namespace samara
