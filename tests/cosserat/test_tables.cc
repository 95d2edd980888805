// Tables of section properties as engineers have them: abscissae that are lengths, units in the first line, several
// files with stations of their own, jumps, twist.

#include "../output/scratch_folder.h"
#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  struct Files : ScratchFolder
  {
    /** Write a file and return its name. */
    std::string
    file(const std::string &name, const std::string &content) const
    {
      std::ofstream(path + "/" + name) << content;
      return path + "/" + name;
    }
  };

  /** A cantilever of 2 m along x with a table as its section, pushed by 1 N at its end along z. */
  std::string
  cantilever(const std::string &table, const std::string &beam = "")
  {
    return "set Analyses = static\nsubsection Sections\n subsection it\n set Type = table\n" + table +
           " end\nend\nsubsection Bodies\n subsection beam\n set Type = beam\n set Points = 0.5, 0, 0; 2.5, 0, 0\n"
           " set Axis 2 = 0, 1, 0\n set Section = it\n" +
           beam +
           " end\nend\nsubsection Joints\n subsection clamp\n set Type = rigid\n set Body A = ground\n set Body B = beam.start\n"
           " end\nend\nsubsection Loads\n subsection push\n set Type = point load\n set At = beam.end\n"
           " set Force = 0, 0, 1e-3\n end\nend\n";
  }

  double
  mass(const Scene &scene)
  {
    double sum = 0;
    for (const auto &node : scene.input.model.nodes)
      sum += node.inertia(0, 0);
    return sum;
  }

  double
  deflection(const std::string &model)
  {
    Scene scene(model);
    scene.equilibrium();
    return scene.value("beam.end.displacement z");
  }

  const std::string names = "EA, GA2, GA3, GJ, EI2, EI3, mass, I2, I3";
} // namespace



TEST(Tables, LengthsAndUnitsAreThoseOfRelativeNumbers)
{
  const Files       files;
  const double      inch = 0.0254, lbf = 4.4482216152605, lb = 0.45359237;
  const auto        text = [](const double x) { return number_to_text(x); };
  const std::string si   = files.file(
    "si.csv",
    "x, " + names +
      "\n0, 1e6, 5e5, 4e5, 20, 30, 40, 2, 0.01, 0.02\n0.3, 2e6, 5e5, 4e5, 25, 50, 40, 3, 0.01, 0.02\n1, 1e6, 4e5, 4e5, 20, 30, 20, 1, 0.01, 0.01\n");
  const auto row = [&](const double s, const std::array<double, 9> &v) {
    std::string  line    = text(s / inch);
    const double units[] = {lbf, lbf, lbf, lbf * inch * inch, lbf * inch * inch, 1, lb / inch, 1, lb * inch};
    for (unsigned int i = 0; i < 9; ++i)
      line += ", " + text(v[i] / units[i]);
    return line + "\n";
  };
  const std::string us = files.file(
    "us.csv",
    "# by radius\nr [in], EA [lbf], GA2 [lbf], GA3 [lbf], GJ [lbf*in^2], EI2 [lb*in^2], EI3, mass [lb/in], I2, I3 [lb*in]\n" +
      row(0.5, {1e6, 5e5, 4e5, 20, 30, 40, 2, 0.01, 0.02}) + row(1.1, {2e6, 5e5, 4e5, 25, 50, 40, 3, 0.01, 0.02}) +
      row(2.5, {1e6, 4e5, 4e5, 20, 30, 20, 1, 0.01, 0.01}));
  const std::string a = cantilever("set File = " + si + "\n"),
                    b = cantilever("set File = " + us + "\n set Start = 0.5 m\n");
  EXPECT_NEAR(deflection(a), deflection(b), 1e-12 * deflection(a));
  EXPECT_NEAR(mass(Scene(a)), mass(Scene(b)), 1e-12);
  // ∫ of a trapezium: 0.6 m from 2 to 3 kg/m and 1.4 m from 3 to 1
  EXPECT_NEAR(mass(Scene(a)), 0.6 * 2.5 + 1.4 * 2, 1e-13);
}



TEST(Tables, FilesHaveTheirOwnStations)
{
  const Files files;
  const std::string
    stiff = files.file(
      "stiff.csv",
      "s, EA, GA2, GA3, GJ, EI2, EI3\n0, 1e6, 5e5, 4e5, 20, 30, 40\n0.8, 1e6, 5e5, 4e5, 20, 50, 40\n2, 1e6, 5e5, 4e5, 20, 26, 40\n"),
    heavy =
      files.file("heavy.csv",
                 "x [%], mass, I2, I3\n0, 2, 0.01, 0.02\n70, 2, 0.01, 0.02\n70, 5, 0.01, 0.02\n100, 4, 0.01, 0.02\n"),
    both = files.file(
      "both.csv",
      "x, " + names +
        "\n0, 1e6, 5e5, 4e5, 20, 30, 40, 2, 0.01, 0.02\n0.4, 1e6, 5e5, 4e5, 20, 50, 40, 2, 0.01, 0.02\n"
        "0.7, 1e6, 5e5, 4e5, 20, 38, 40, 2, 0.01, 0.02\n0.7, 1e6, 5e5, 4e5, 20, 38, 40, 5, 0.01, 0.02\n1, 1e6, 5e5, 4e5, 20, 26, 40, 4, 0.01, 0.02\n");
  const std::string two = cantilever("set File = " + stiff + ", " + heavy + "\n"),
                    one = cantilever("set File = " + both + "\n");
  EXPECT_NEAR(deflection(two), deflection(one), 1e-11 * deflection(one));
  EXPECT_NEAR(mass(Scene(two)), 1.4 * 2 + 0.6 * 4.5, 1e-13);
  EXPECT_NEAR(mass(Scene(one)), 1.4 * 2 + 0.6 * 4.5, 1e-13);
}



// A bar of two pieces: δ = P (L³ − b³)/(3 EI₁) + P b³/(3 EI₂) + P a/GA₁ + P b/GA₂, b the outer piece; where elements
// end at the jump and where they do not.
TEST(Tables, Jumps)
{
  const Files       files;
  const std::string table =
    files.file("jump.csv",
               "s, " + names +
                 "\n0, 1e6, 5e5, 4e5, 20, 30, 40, 2, 0.01, 0.02\n1.3, 1e6, 5e5, 4e5, 20, 30, 40, 2, 0.01, 0.02\n"
                 "1.3, 1e6, 5e5, 1e5, 20, 6, 40, 1, 0.01, 0.02\n2, 1e6, 5e5, 1e5, 20, 6, 40, 1, 0.01, 0.02\n");
  const double P = 1e-3, b = 0.7, L = 2;
  const double exact =
    P * (std::pow(L, 3) - std::pow(b, 3)) / (3 * 30) + P * std::pow(b, 3) / (3 * 6) + P * (L - b) / 4e5 + P * b / 1e5;
  EXPECT_NEAR(deflection(cantilever("set File = " + table + "\n")), exact, 1e-8 * exact);
  EXPECT_NEAR(deflection(cantilever("set File = " + table + "\n", "set Elements = 1\n set Degree = 3\n")),
              exact,
              2e-2 * exact);
  EXPECT_NEAR(mass(Scene(cantilever("set File = " + table + "\n"))), 1.3 * 2 + 0.7, 1e-13);
  EXPECT_NEAR(mass(Scene(cantilever("set File = " + table + "\n", "set Elements = 1\n"))), 1.3 * 2 + 0.7, 1e-13);
}



// Twist from a table is that of the beam's entry; where it jumps, an element ends however few there are.
TEST(Tables, Twist)
{
  const Files       files;
  const std::string head   = "s, EA, GA2, GA3, GJ, EI2, EI3, mass, I2, I3, twist [deg]\n",
                    values = ", 1e6, 5e5, 4e5, 20, 30, 80, 2, 0.01, 0.02, ";
  const std::string linear = files.file("linear.csv", head + "0" + values + "10\n2" + values + "40\n"),
                    plain  = files.file(
                      "plain.csv",
                      "s, " + names +
                        "\n0, 1e6, 5e5, 4e5, 20, 30, 80, 2, 0.01, 0.02\n2, 1e6, 5e5, 4e5, 20, 30, 80, 2, 0.01, 0.02\n"),
                    jump = files.file("jump.csv",
                                      head + "0" + values + "0\n1.3" + values + "0\n1.3" + values + "90\n2" + values +
                                        "90\n");
  EXPECT_NEAR(deflection(cantilever("set File = " + linear + "\n")),
              deflection(cantilever("set File = " + plain + "\n", "set Twist = (10 + 15*s) deg\n")),
              1e-15);
  // the outer piece is bent about its other axis
  const double P = 1e-3, exact = P * (8 - 0.343) / (3 * 30) + P * 0.343 / (3 * 80) + P * 1.3 / 4e5 + P * 0.7 / 5e5;
  for (const std::string elements : {"", "set Elements = 2\n"})
    {
      EXPECT_NEAR(deflection(cantilever("set File = " + jump + "\n", elements)), exact, 1e-8 * exact);
      EXPECT_NEAR(deflection(cantilever("set File = " + plain + "\n",
                                        "set Twist = table: 0 0 deg; 1.3 0 deg; 1.3, 90 deg; 2, 90 deg\n" + elements)),
                  exact,
                  1e-8 * exact);
    }
}



TEST(Tables, Refusals)
{
  const Files files;
  const auto  said = [&](const std::string &content, const std::string &more = "", const std::string &beam = "") {
    return complaint_of(cantilever("set File = " + files.file("t.csv", content) + more + "\n", beam));
  };
  const std::string row = ", 1e6, 5e5, 4e5, 20, 30, 40, 2, 0.01, 0.02";
  const auto        has = [](const std::string &text, const std::string &piece) {
    EXPECT_NE(text.find(piece), std::string::npos) << text;
  };
  EXPECT_EQ(said("s, " + names + "\n0" + row + "\n2" + row + "\n"), "");
  has(said("s, " + names + "\n0" + row + "\n1.9" + row + "\n"), "goes from 0 to 1.9 m, and the beam from 0 to 2 m");
  has(said("s, " + names + "\n0" + row + "\n2" + row + "\n", "\nset Start = 0.5"), "and the beam from 0.5 to 2.5 m");
  has(said("x, " + names + "\n0.1" + row + "\n1" + row + "\n"), "goes from 0.1 to 1, and the beam from 0 to 1");
  has(
    complaint_of(cantilever(
      "set Stations = a at 0, a at 0.9\n end\n subsection a\n set Type = tube\n set E = 1e9\n set Density = 1\n set Outer radius = 0.1\n")),
    "go from 0 to 0.9 of the beam");
  has(
    complaint_of(cantilever(
      "set Stations = a at 0 m, a at 1.9 m\n end\n subsection a\n set Type = tube\n set E = 1e9\n set Density = 1\n set Outer radius = 0.1\n")),
    "go from 0 to 0.95 of the beam");
  has(
    complaint_of(cantilever(
      "set Stations = a at 0.5, a at 2 m\n end\n subsection a\n set Type = tube\n set E = 1e9\n set Density = 1\n set Outer radius = 0.1\n")),
    "some stations have a length");
  EXPECT_EQ(
    complaint_of(cantilever(
      "set Stations = a at 0, a at 200 cm\n end\n subsection a\n set Type = tube\n set E = 1e9\n set Density = 1\n set Outer radius = 0.1\n")),
    "");
  has(said("x [kg], " + names + "\n0" + row + "\n1" + row + "\n"), "[kg]");
  has(said("x, EA [m], GA2\n0, 1, 1\n1, 1, 1\n"), "EA [m]");
  has(said("x, EA, EA\n0, 1, 1\n1, 1, 1\n"), "<EA> is twice");
  has(said("x, EI1\n0, 1\n1, 1\n"), "there is no column <EI1>");
  has(said("EA\n1\n1\n"), "no column <x>");
  has(said("x, " + names + "\n0" + row + "\n0.5" + row + "\n0.5" + row + "\n0.5" + row + "\n1" + row + "\n"),
      "more than two stations");
  has(said("x, " + names + "\n0" + row + "\n0.5" + row + "\n0.4" + row + "\n1" + row + "\n"), "ascending");
  has(said("x, " + names + "\n0" + row + "\n0.5, 1e6, 5e5, 4e5, 20, -30, 40, 2, 0, 0\n1" + row + "\n"),
      "not positive definite");
  has(said("x, " + names + "\n0" + row + "\n1" + row + "\n", "\nset Start = 1"), "<Start> has no effect");
  has(said("x, " + names + ", twist\n0" + row + ", 0\n1" + row + ", 1\n", "", "set Twist = s\n"), "leave out one");
  has(said("x, " + names + "\n0" + row + "\n1, nan, 5e5, 4e5, 20, 30, 40, 2, 0.01, 0.02\n"), "is not a number");
}
