// A strip, half shell and half beam, against the beam alone, under all six loads at its end.

#include "../complex_step.h"
#include <gtest/gtest.h>

#include "models.h"

using namespace samara;

namespace
{
  const std::vector<std::string> probes =
    {"displacement x", "displacement y", "displacement z", "rotation x", "rotation y", "rotation z"};

  std::string
  beam(const std::string &from)
  {
    return " subsection b\n  set Type = beam\n  set Points = " + from +
           ", 0, 0; 10, 0, 0\n  set Axis 2 = 0, 1, 0\n  set Section = strip\n  set Elements = 2\n end\n";
  }

  std::string
  load(const unsigned int i)
  {
    const std::string unit = i % 3 == 0 ? "1e-3, 0, 0" : i % 3 == 1 ? "0, 1e-3, 0" : "0, 0, 1e-3";
    return "subsection Loads\n subsection f\n  set Type = point load\n  set At = b.end\n  set " +
           std::string(i < 3 ? "Force" : "Moment") + " = " + unit + "\n end\nend\n";
  }

  const std::string section =
    "subsection Sections\n subsection strip\n  set Type = rectangle\n  set E = 1.2e6\n"
    "  set Poisson ratio = 0\n  set Width 2 = 1\n  set Width 3 = 0.1\n  set Density = 1\n end\nend\n";

  std::vector<double>
  end_of(const std::string &model)
  {
    Scene scene(model);
    scene.equilibrium();
    std::vector<double> result;
    for (const auto &probe : probes)
      result.push_back(scene.value("b.end." + probe));
    return result;
  }

  /** With the given joint between the shell s and the beam b. */
  std::string
  half_shell(const std::string &joint, const std::string &entries = "")
  {
    ShellModel model;
    model.patches    = "5*u, v - 0.5, 0";
    model.elements   = "3, 2";
    model.E          = 1.2e6;
    model.nu         = 0;
    model.thickness  = 0.1;
    model.entries    = entries;
    std::string text = model.text();
    text.erase(text.find("subsection Joints"));
    text.erase(text.rfind("end\n"));
    return section + text + beam("5") + "end\nsubsection Joints\n" + support("root", "s.edge u0", "all") +
           " subsection j\n" + joint + " end\nend\n";
  }
} // namespace



TEST(ShellCouplings, HalfShellHalfBeamIsTheBeam)
{
  const std::string all = section + "subsection Bodies\n" + beam("0") +
                          "end\nsubsection Joints\n subsection root\n  set Type = rigid\n  set Body A = ground\n"
                          "  set Body B = b.start\n end\nend\n";
  const std::string soft  = half_shell("  set Type = distributing\n  set Along = s.edge u1\n  set Body = b.start\n"),
                    stiff = half_shell("  set Type = rigid\n  set Body A = s.tip\n  set Body B = b.start\n",
                                       "  set Rigid edges = tip at edge u1\n");
  for (unsigned int i = 0; i < 6; ++i)
    {
      const auto   exact   = end_of(all + load(i));
      const double largest = std::abs(*std::max_element(exact.begin(), exact.end(), [](const double a, const double b) {
        return std::abs(a) < std::abs(b);
      }));
      // torsion: the shell is stiffer than Saint-Venant's bar, as its root does not warp, by a tenth over this length
      const double tolerance = i == 3 ? 0.06 : 3e-3;
      for (const auto &model : {soft, stiff})
        {
          const auto found = end_of(model + load(i));
          for (unsigned int k = 0; k < 6; ++k)
            EXPECT_NEAR(found[k], exact[k], tolerance * largest) << "load " << i << ", " << probes[k];
        }
    }
}



TEST(ShellCouplings, DistributingJointCarriesForceAndMoment)
{
  Scene scene(half_shell("  set Type = distributing\n  set Along = s.edge u1\n  set Body = b.start\n") + load(2));
  scene.equilibrium();
  EXPECT_NEAR(scene.value("j.force 3"), -1e-3, 1e-9); // of the edge on the beam
  EXPECT_NEAR(scene.value("j.moment 2"), 5e-3, 1e-8);
  EXPECT_NEAR(scene.value("j.force 1"), 0., 1e-9);
}
