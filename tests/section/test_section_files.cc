/*
 * Problem:   sections and blades in files: written, read back, and read from another program's format
 * Reference: what was written; the blade of the NREL 5 MW turbine as OpenFAST gives it (tests/reference/sections);
 * matrices of the BeamDyn manual for given centres
 */

#include <samara/cosserat/beam.h>
#include <samara/cosserat/beamdyn_file.h>
#include <samara/cosserat/section_file.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "stiffness.h"

using namespace samara;

namespace
{
  /** A file that is there while the object is. */
  struct TextFile
  {
    std::string name;

    explicit TextFile(const std::string &text)
      : name("section_file_" + std::to_string(getpid()) + "_" + std::to_string(counter()++))
    {
      std::ofstream(name) << text;
    }
    ~TextFile()
    {
      std::remove(name.c_str());
    }
    static unsigned int &
    counter()
    {
      static unsigned int n = 0;
      return n;
    }
  };



  /** What is said about a text; "" if it can be read. */
  template <typename Read>
  std::string
  said_of(const std::string &text, const Read &read)
  {
    const TextFile file(text);
    try
      {
        read(file.name);
        return "";
      }
    catch (const std::invalid_argument &problem)
      {
        return problem.what();
      }
  }

  std::string
  complaint_of_section(const std::string &text)
  {
    return said_of(text, [](const std::string &file) { SectionFile::read(file); });
  }

  std::string
  complaint_of_blade(const std::string &text)
  {
    return said_of(text, [](const std::string &file) { BeamDynBlade::read(file, 1e-3); });
  }



  std::string
  replaced(std::string text, const std::string &from, const std::string &to)
  {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  }



  /** A full stiffness, and the inertia of a plane section off its axis. */
  SectionValues
  random_section(const unsigned int seed)
  {
    std::mt19937                           generator(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    const Vector6                          size(1e7, 4e6, 3e6, 50, 40, 90);
    Matrix6                                A;
    for (int i = 0; i < 36; ++i)
      A.data()[i] = 0.2 * number(generator);
    A += Matrix6::Identity();
    SectionValues v;
    v.stiffness = size.cwiseSqrt().asDiagonal() * (A * A.transpose()).eval() * size.cwiseSqrt().asDiagonal();
    v.stiffness = (0.5 * (v.stiffness + v.stiffness.transpose())).eval();
    EngineeringConstants c;
    c.EA = c.GA2 = c.GA3 = c.GJ = c.EI2 = c.EI3 = 1;
    c.mass                                      = 3 + number(generator);
    c.I2                                        = 0.02;
    c.I3                                        = 0.05 + 0.01 * number(generator);
    c.I23                                       = 0.004;
    c.mass_centre                               = {0.1 * number(generator), 0.1 * number(generator)};
    v.inertia                                   = c.values().inertia;
    return v;
  }



  /** A clamped beam of 10 m along x with the section <s>, a force and a moment at its end. */
  std::string
  loaded_cantilever(const std::string &section, const std::string &of_beam = "")
  {
    return R"(
set Analyses = static
subsection Materials
  subsection ply
    set Type = orthotropic
    set E1   = 140 GPa
    set E2   = 10 GPa
    set G12  = 6 GPa
    set nu12 = 0.3
    set Density = 1600
  end
end
subsection Layups
  subsection wall
    set Material      = ply
    set Angles        = 15_2
    set Ply thickness = 3 mm
  end
end
subsection Sections
  subsection s
)" + section +
           "  end\nend\nsubsection Bodies\n  subsection beam\n    set Type = beam\n    set Section = s\n"
           "    set Points = 0, 0, 0; 10, 0, 0\n" +
           of_beam + R"(  end
end
subsection Joints
  subsection clamp
    set Type   = rigid
    set Body A = ground
    set Body B = beam.start
  end
end
subsection Loads
  subsection push
    set Type   = point load
    set At     = beam.end
    set Force  = 100, 2000, 1000
    set Moment = 500, 0, 0
  end
end
)";
  }

  const std::string laminated_box =
    "    set Type = box\n    set Width 2 = 0.4\n    set Width 3 = 0.2\n    set Layup = wall\n"
    "    set Elements = 3\n    set Degree = 2\n    set Position = 0.03, -0.02\n";



  const Beam &
  beam_of(const Scene &scene)
  {
    return scene.input.model.find<Beam>("beam", "beam");
  }



  Vector3
  end_of_loaded(Scene &scene)
  {
    scene.equilibrium();
    return {scene.value("beam.end.position x"), scene.value("beam.end.position y"), scene.value("beam.end.position z")};
  }



  /** A blade file of BeamDyn, written as OpenFAST's, from the list of the NREL blade. */
  std::string
  nrel_blade()
  {
    std::ostringstream text;
    text << "   ------- BEAMDYN V1.00.* INDIVIDUAL BLADE INPUT FILE --------------------------\n NREL 5MW Blade\n"
            "------ Blade Parameters --------------------------------------------------------\n"
            "49                      station_total    - Number of blade input stations (-)\n"
            "1                       damp_type        - Damping type (switch) {0: none, 1: stiffness-proportional, 2: "
            "modal}\n"
            "------ Stiffness-Proportional Damping [used only if damp_type=1] ---------------\n"
            "   mu1        mu2        mu3        mu4        mu5        mu6\n"
            "   (-)        (-)        (-)        (-)        (-)        (-)\n"
            "1.0E-03    1.0E-03    1.0E-03     0.0014      0.0022     0.0022\n"
            "------ Modal Damping [used only if damp_type=2] --------------------------------\n"
            "4                        n_modes    - Number of modal damping coefficients (-)\n"
            "0.01 0.02 0.03 0.04      zeta       - Damping coefficients for mode 1 through n_modes\n"
            "------ Distributed Properties --------------------------------------------------\n";
    for (const auto &row : reference_rows("sections/nrel_5mw_blade.csv"))
      {
        text << "  " << row.at("x") << "\n";
        for (const auto &names :
             std::vector<std::array<std::string, 6>>{{{"GAx", "GAy", "EA", "EIxx", "EIyy", "GJ"}},
                                                     {{"mass", "mass", "mass", "Ixx", "Iyy", "Izz"}}})
          {
            for (int i = 0; i < 6; ++i)
              {
                for (int j = 0; j < 6; ++j)
                  text << "   " << (i == j ? row.at(names[i]) : "0.000000E+00");
                text << "\n";
              }
            text << "\n";
          }
      }
    return text.str();
  }
} // namespace



TEST(SectionFiles, WhatIsWrittenIsReadBackExactly)
{
  SectionFile written{"a b", Vector3(0.1, -0.02, 0.3), random_section(1)};
  written.values.outline = {{0.1, 0.2}, {-0.1, 0.2}, {1. / 3, -0.2}};
  written.remarks        = {{"area [m^2]", 0.7}};
  const TextFile    file(written.write(16));
  const SectionFile read = SectionFile::read(file.name);
  EXPECT_EQ(read.name, "a b");
  EXPECT_EQ(read.curvature, written.curvature);
  EXPECT_EQ(read.values.stiffness, written.values.stiffness);
  EXPECT_EQ(read.values.inertia, written.values.inertia);
  ASSERT_EQ(read.values.outline.size(), 3u);
  EXPECT_EQ(read.values.outline[2], written.values.outline[2]);
}



TEST(SectionFiles, ABeamOfAFileIsThatOfTheShape)
{
  Scene             of_shape(loaded_cantilever(laminated_box));
  const auto       &section = of_shape.input.model.find<Section>("s", "section");
  const SectionFile written{"s", Vector3::Zero(), section.at(0, Vector3::Zero())};
  const TextFile    file(written.write(16));
  Scene             of_file(loaded_cantilever("    set Type = file\n    set File = " + file.name + "\n"));
  const Vector3     x = end_of_loaded(of_shape);
  EXPECT_GT((x - Vector3(10, 0, 0)).norm(), 0.1);
  EXPECT_LT((end_of_loaded(of_file) - x).norm(), 1e-12);
  EXPECT_EQ(of_file.input.model.find<Section>("s", "section").outline(0).size(), 4u);
}



TEST(SectionFiles, HandMadeFilesNeedTheTwoMatricesOnly)
{
  const TextFile    file("Stiffness\n1e7 0 0 0 0 0\n0 4e6 0 0 0 0 # shear\n0 0 3e6 0 0 0\n0 0 0 50 0 0\n0 0 0 0 40 0\n"
                         "0 0 0 0 0 90\n\nInertia\n3 0 0 0 0 0\n0 3 0 0 0 0\n0 0 3 0 0 0\n0 0 0 0.3 0 0\n0 0 0 0 0.1 0\n"
                         "0 0 0 0 0 0.2\n");
  const SectionFile read = SectionFile::read(file.name);
  EXPECT_EQ(read.values.stiffness(1, 1), 4e6);
  EXPECT_EQ(read.values.inertia(5, 5), 0.2);
  EXPECT_GT(read.values.outline.size(), 3u); // that of a solid ellipse
}



TEST(SectionFiles, WhatIsWrongIsToldWithItsLine)
{
  const std::string text = SectionFile{"s", Vector3::Zero(), random_section(2)}.write(16);
  const auto        line = [&](const std::string &word) {
    const auto at = text.find(word);
    return ":" + std::to_string(1 + std::count(text.begin(), text.begin() + at, '\n')) + ": ";
  };
  const auto expect = [&](const std::string &changed, const std::string &said) {
    EXPECT_NE(complaint_of_section(changed).find(said), std::string::npos)
      << said << ", not " << complaint_of_section(changed);
  };
  EXPECT_EQ(complaint_of_section(text), "");
  // a number for people that somebody has changed, in the hope that it counts
  for (const std::string name : {"EA [N]", "GJ [N m^2]", "larger EI [N m^2]", "mass [kg/m]", "shear centre 3 [m]"})
    expect(replaced(text, name + std::string(38 - name.size(), ' '), name + "  3"),
           line(name) + "<" + name.substr(0, name.find(" [")));
  expect(replaced(text, "Stiffness:", "Stuff"), "begins with <Stiffness>");
  expect(replaced(text, "Inertia per", "Stiffness"), line("Inertia") + "this block is there twice");
  expect(replaced(text, "\nInertia", "1 2 3\nInertia"), "here should be 6 numbers");
  const auto row = text.rfind('\n', text.size() - 2);
  expect(text.substr(0, row + 1), line("Inertia") + "below this line there should be 6 lines");
  // one entry beside the diagonal
  auto       lopsided = text;
  const auto entry    = lopsided.find('\n', lopsided.find("Stiffness")) + 1 + 25;
  lopsided.replace(entry, 25, "   9.9999999999999999e+06");
  expect(lopsided, line("Stiffness") + "the matrix is not symmetric");
  expect(replaced(text, "[1/m]: 0", "[1/m]: x"), line("Initial") + "here should be three numbers");
  EXPECT_THROW(SectionFile::read("no such file"), std::invalid_argument);
}



TEST(SectionFiles, AFileIsForItsOwnCurvature)
{
  const auto twisted = [](const std::string &entries) {
    const SectionFile written{"s", Vector3(0.05, 0, 0), random_section(3)};
    const TextFile    file(written.write(16));
    const Scene       scene(loaded_cantilever("    set Type = file\n    set File = " + file.name + "\n" + entries,
                                        "    set Twist = 0.05*s\n"));
    return beam_of(scene).sections_along().front().values.stiffness;
  };
  EXPECT_EQ(twisted(""), random_section(3).stiffness);
  const auto straight = [](const std::string &entries) {
    const SectionFile written{"s", Vector3(0.05, 0, 0), random_section(3)};
    const TextFile    file(written.write(16));
    return std::make_unique<Scene>(
      loaded_cantilever("    set Type = file\n    set File = " + file.name + "\n" + entries));
  };
  EXPECT_ANY_THROW(straight(""));
  EXPECT_NO_THROW(straight("    set Initial curvature = any\n"));
}



TEST(BeamDynFiles, ThePublishedBladeIsRead)
{
  const TextFile file(nrel_blade());
  const auto     blade = BeamDynBlade::read(file.name, 1e-3);
  const auto     rows  = reference_rows("sections/nrel_5mw_blade.csv");
  ASSERT_EQ(blade.stations.size(), rows.size());
  for (unsigned int k = 0; k < rows.size(); ++k)
    {
      const auto                       &s           = blade.stations[k];
      const std::array<const char *, 6> of_axes_123 = {{"EA", "GAx", "GAy", "GJ", "EIxx", "EIyy"}};
      EXPECT_EQ(s.x, std::stod(rows[k].at("x")));
      for (int i = 0; i < 6; ++i)
        EXPECT_EQ(s.stiffness(i, i), std::stod(rows[k].at(of_axes_123[i])));
      EXPECT_EQ(s.inertia(0, 0), std::stod(rows[k].at("mass")));
      EXPECT_EQ(s.inertia(3, 3), std::stod(rows[k].at("Izz")));
      EXPECT_EQ(s.inertia(4, 4), std::stod(rows[k].at("Ixx")));
    }
  Vector6 mu;
  mu << 1e-3, 1e-3, 1e-3, 0.0022, 0.0014, 0.0022; // of extension, shears, torsion, bending about x, about y
  EXPECT_EQ(blade.damping, mu);

  // its mass, and that it is stiffer edgewise than flapwise, which is along its axis 2
  Scene scene(
    loaded_cantilever("    set Type = BeamDyn\n    set File = " + file.name + "\n", "    set Elements = 12\n"));
  EXPECT_EQ(beam_of(scene).relaxation_times(), mu);
  double mass = 0;
  for (unsigned int k = 0; k + 1 < rows.size(); ++k)
    mass += 0.5 * (blade.stations[k + 1].x - blade.stations[k].x) *
            (blade.stations[k].inertia(0, 0) + blade.stations[k + 1].inertia(0, 0));
  EXPECT_NEAR(61.5 * mass, 16844.752, 1e-3);
}



TEST(BeamDynFiles, WhatIsWrittenIsReadBack)
{
  BeamDynBlade written;
  for (unsigned int k = 0; k < 4; ++k)
    {
      const auto v = random_section(10 + k);
      written.stations.push_back({k / 3., v.stiffness, v.inertia});
    }
  written.stations[2].x = written.stations[1].x; // a jump
  written.damping << 1, 2, 3, 4, 5, 6;
  const TextFile file(written.write("random"));
  const auto     read = BeamDynBlade::read(file.name, 1e-12);
  ASSERT_EQ(read.stations.size(), 4u);
  EXPECT_EQ(read.damping, written.damping);
  for (unsigned int k = 0; k < 4; ++k)
    {
      EXPECT_NEAR(read.stations[k].x, written.stations[k].x - (k == 1 ? 1e-6 : 0), 1e-14);
      EXPECT_LT((read.stations[k].stiffness - written.stations[k].stiffness).norm(),
                1e-14 * read.stations[k].stiffness.norm());
      EXPECT_LT((read.stations[k].inertia - written.stations[k].inertia).norm(),
                1e-14 * read.stations[k].inertia.norm());
    }
}



// The manual's mass matrix has −m Y at 16, m X at 26, m Y at 34; a tension centre (X, Y) gives EA Y at 34, −EA X at 35.
TEST(BeamDynFiles, CentresAreWhereTheManualHasThem)
{
  EngineeringConstants c;
  c.EA             = 1000;
  c.GA2            = 20;
  c.GA3            = 30;
  c.GJ             = 4;
  c.EI2            = 5;
  c.EI3            = 6;
  c.mass           = 7;
  c.I2             = 0.2;
  c.I3             = 0.3;
  c.tension_centre = {0.03, 0.05};
  c.mass_centre    = {0.2, 0.1};
  const auto   v   = c.values();
  BeamDynBlade blade;
  blade.stations = {{0, v.stiffness, v.inertia}, {1, v.stiffness, v.inertia}};
  std::istringstream  text(blade.write("centres"));
  std::vector<double> numbers;
  for (std::string line; std::getline(text, line);)
    if (line.find("DISTRIBUTED") != std::string::npos)
      break;
  for (double x = 0; text >> x;)
    numbers.push_back(x);
  ASSERT_EQ(numbers.size(), 2u * 73);
  const auto K = [&](const int i, const int j) { return numbers[1 + 6 * (i - 1) + j - 1]; };
  const auto M = [&](const int i, const int j) { return numbers[37 + 6 * (i - 1) + j - 1]; };
  EXPECT_NEAR(K(1, 1), 20, 1e-12);
  EXPECT_NEAR(K(2, 2), 30, 1e-12);
  EXPECT_NEAR(K(3, 4), 1000 * 0.05, 1e-12);
  EXPECT_NEAR(K(3, 5), -1000 * 0.03, 1e-12);
  EXPECT_NEAR(K(4, 4), 5 + 1000 * 0.05 * 0.05, 1e-12);
  EXPECT_NEAR(M(1, 6), -7 * 0.1, 1e-12);
  EXPECT_NEAR(M(2, 6), 7 * 0.2, 1e-12);
  EXPECT_NEAR(M(3, 4), 7 * 0.1, 1e-12);
  EXPECT_NEAR(M(3, 5), -7 * 0.2, 1e-12);
  EXPECT_NEAR(M(4, 4), 0.2 + 7 * 0.01, 1e-12);
  EXPECT_NEAR(M(4, 4) + M(5, 5), M(6, 6), 1e-12);
}



// A tapered beam with a jump and the beam of the file that is written of it bend alike.
TEST(BeamDynFiles, ABeamThatIsWrittenBendsAsBefore)
{
  const std::string table = R"(    set Type     = table
    set Stations = root at 0, root at 0.4, tip at 0.4, root at 1
  end
  subsection root
    set Type = engineering constants
    set EA   = 1e9
    set GA2  = 1e8
    set GA3  = 2e8
    set GJ   = 1e6
    set EI2  = 2e6
    set EI3  = 5e6
    set EI23 = 1e6
    set Shear centre = 0.05, 0.02
    set Mass = 12
    set I2   = 0.1
    set I3   = 0.3
    set Mass centre = 0.1, 0.03
  end
  subsection tip
    set Copy of = root
    set EI2     = 1e6
    set GJ      = 5e5
)";
  Scene first(loaded_cantilever(table, "    set Damping = 0.1, 0.2, 0.3, 0.4, 0.5, 0.6\n    set Elements = 5\n"));
  BeamDynBlade blade;
  for (const auto &there : beam_of(first).sections_along())
    blade.stations.push_back({there.x, there.values.stiffness, there.values.inertia});
  blade.damping = beam_of(first).relaxation_times();
  ASSERT_EQ(blade.stations.size(), 4u);
  const TextFile    file(blade.write("tapered"));
  const std::string section = "    set Type = BeamDyn\n    set File = " + file.name + "\n";
  Scene             second(loaded_cantilever(section, "    set Elements = 5\n"));
  EXPECT_EQ(beam_of(second).relaxation_times(), beam_of(first).relaxation_times());
  const Vector3 x = end_of_loaded(first);
  EXPECT_GT((x - Vector3(10, 0, 0)).norm(), 0.05);
  EXPECT_LT((end_of_loaded(second) - x).norm(), 1e-10); // the jump, written as a slope over 1e-6, is one again
  EXPECT_EQ(beam_of(second).sections_along().size(), 4u);
  // what the beam says of its damping counts
  const Scene third(loaded_cantilever(section, "    set Damping = 0.7\n"));
  EXPECT_EQ(beam_of(third).relaxation_times(), Vector6(Vector6::Constant(0.7)));
}



TEST(BeamDynFiles, WhatIsWrongIsToldWithItsLine)
{
  BeamDynBlade blade;
  for (unsigned int k = 0; k < 3; ++k)
    {
      const auto v = random_section(20 + k);
      blade.stations.push_back({k / 2., v.stiffness, v.inertia});
    }
  blade.damping.setConstant(0.01);
  const std::string text = blade.write("a blade");
  EXPECT_EQ(complaint_of_blade(text), "");
  const auto expect = [&](const std::string &changed, const std::string &said) {
    EXPECT_NE(complaint_of_blade(changed).find(said), std::string::npos)
      << said << ", not " << complaint_of_blade(changed);
  };
  expect(replaced(text, "\n1   damp_type", "\n2   damp_type"), ":5: damping of modes");
  expect(replaced(text, "\n3   station", "\n4   station"), "the file ends too early");
  expect(replaced(text, "\n3   station", "\n2   station"), "the last station must be at 1");
  expect(replaced(text, "  0.500000000000000\n", "  1.500000000000000\n"), "must follow each other in ascending order");
  expect(replaced(text, "  0.000000000000000\n", "  0.100000000000000\n"), ":11: the first station must be at 0");
  expect(text + "\n 1 2 3\n", "more lines than those of 3 stations");
  const auto second_row = text.find('\n', text.find('\n', text.find("  0.500000000000000")) + 1);
  expect(text.substr(0, second_row) + " 1.5" + text.substr(second_row), ":27: here should be 6 numbers");
  expect(replaced(text, "  0.500000000000000\n", "  0.500000000000000 0.6\n"), "here should be 1 number, not");
  expect(replaced(text, "DISTRIBUTED", "DISTURBED"), "no line with <distributed properties>");
  expect(replaced(text, " 1.0", " x.0"), "number");

  auto wrong = blade;
  wrong.stations[1].inertia(3, 3) *= 1.01;
  expect(wrong.write("a blade"), ":26: the mass matrix of the station at 0.5 is not that of a plane section: I44 = ");
  wrong                           = blade;
  wrong.stations[2].inertia(1, 1) = 1.1 * wrong.stations[2].inertia(0, 0);
  expect(wrong.write("a blade"), "the station at 1 is not that of a plane section");
  wrong = blade;
  wrong.stations[0].stiffness *= -1;
  expect(wrong.write("a blade"), ":11: the stiffness of the station at 0 is not positive definite");
  wrong = blade;
  wrong.stations[0].stiffness(0, 1) += 1e6;
  expect(wrong.write("a blade"), ":12: below: the matrix is not symmetric");
  wrong            = blade;
  wrong.damping(2) = -1;
  expect(wrong.write("a blade"), "a damping coefficient must not be negative");
}
