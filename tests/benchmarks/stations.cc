// A blade from a table of 21 stations with scatter in elements that do not end at them: the table of
// doc/theory/section.md. Errors of the deflection under its own weight and of the first and third frequency, against 4
// elements of degree 4 between neighbouring stations.

#include "../scene.h"

#include <cmath>
#include <cstdio>

using namespace samara;

namespace
{
  constexpr unsigned int n_stations = 21;

  std::string
  blade()
  {
    std::string sections, stations;
    for (unsigned int i = 0; i < n_stations; ++i)
      {
        const double x = i / (n_stations - 1.), scatter = 1 + 0.2 * std::sin(7. * i), chord = (1 - 0.5 * x) * scatter;
        char         text[500];
        std::snprintf(text,
                      sizeof text,
                      "subsection s%u\n set Type = engineering constants\n set EA = %.17g\n set GA2 = %.17g\n"
                      " set GA3 = %.17g\n set GJ = %.17g\n set EI2 = %.17g\n set EI3 = %.17g\n set Mass = %.17g\n"
                      " set I2 = %.17g\n set I3 = %.17g\nend\n",
                      i,
                      1e8 * chord,
                      4e7 * chord,
                      4e7 * chord,
                      1e5 * std::pow(chord, 3),
                      1e5 * std::pow(chord, 3),
                      2e6 * std::pow(chord, 3),
                      10 * chord,
                      0.01 * std::pow(chord, 3),
                      0.1 * std::pow(chord, 3));
        sections += text;
        std::snprintf(text, sizeof text, "%ss%u at %.17g", i > 0 ? ", " : "", i, x);
        stations += text;
      }
    return "set Analyses = static, modal\nsubsection Sections\n" + sections +
           "subsection table\n set Type = table\n set Stations = " + stations +
           "\nend\nend\nsubsection Bodies\n subsection blade\n set Type = beam\n set Points = 0, 0, 0; 5, 0, 0\n"
           " set Axis 2 = 0, 1, 0\n set Section = table\n end\nend\nsubsection Joints\n subsection root\n set Type = rigid\n"
           " set Body A = ground\n set Body B = blade.start\n end\nend\nsubsection Loads\n subsection weight\n"
           " set Type = gravity\n set Acceleration = 0, 0, -0.01\n end\nend\n";
  }

  std::array<double, 3>
  results(const unsigned int degree, const unsigned int elements)
  {
    Scene scene(blade(),
                {"Bodies/blade/Degree = " + std::to_string(degree),
                 "Bodies/blade/Elements = " + std::to_string(elements)});
    scene.equilibrium();
    const auto &modes = scene.modes();
    return {{scene.value("blade.end.displacement z"), modes[0].frequency(), modes[2].frequency()}};
  }
} // namespace

int
main()
{
  const auto exact = results(4, 4 * (n_stations - 1));
  std::printf(
    "| degree | elements | unknowns | deflection | first frequency | third frequency |\n|---|---|---|---|---|---|\n");
  for (const unsigned int degree : {1, 2, 3, 4, 5, 6})
    for (const unsigned int elements : {1, 2, 4, 8, 20, 40})
      {
        const auto r = results(degree, elements);
        std::printf("| %u | %u | %u |", degree, elements, 6 * degree * elements);
        for (unsigned int i = 0; i < 3; ++i)
          std::printf(" %.1e |", std::abs(r[i] / exact[i] - 1));
        std::printf("\n");
      }
}
