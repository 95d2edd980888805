// Virtual mass at the nodes of elements on which the chord tapers fast, or which the surface leaves.

#include <samara/aero/surface.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include "models.h"

using namespace samara;
using namespace samara::aero_models;

namespace
{
  /** A straight blade of 10 m in one element, its chord from 1.8 to 0.5 m, and more entries of the surface. */
  std::string
  tapered(const unsigned int degree, const std::string &entries)
  {
    return R"(
subsection Sections
  subsection bar
    set Type         = tube
    set E            = 1e9
    set Density      = 800
    set Outer radius = 0.05
  end
end
subsection Bodies
  subsection wing
    set Type     = beam
    set Points   = 0, 0, 0; 10, 0, 0
    set Axis 2   = 0, 1, 0
    set Section  = bar
    set Elements = 1
    set Degree   = )" +
           std::to_string(degree) + "\n  end\nend\n" + airfoils() + subsection("Aerodynamics", air("0, 0, 0")) +
           subsection("Surfaces",
                      subsection("it",
                                 "    set Body = wing\n    set Airfoils = plain\n    set Virtual mass = true\n" +
                                   entries));
  }
} // namespace



// Mass and first moment are those of πρc²/4 to quadrature, and no node has a negative mass.
TEST(VirtualMass, OfTaperedBladesIsNowhereNegative)
{
  const auto integral = [](const double from, const double to, const auto &f) {
    constexpr unsigned int n   = 100000;
    double                 sum = 0;
    for (unsigned int i = 0; i < n; ++i)
      sum += f(from + (i + 0.5) * (to - from) / n) * (to - from) / n;
    return sum;
  };
  for (const unsigned int degree : {2, 3, 4, 6})
    for (const double start : {0., 3.7})
      {
        // all of the taper within a part of the element
        const auto           chord = [](const double s) { return s < 6 ? 1.8 : s < 8 ? 1.8 - 0.65 * (s - 6) : 0.5; };
        const Scene          scene(tapered(degree,
                                  "    set Chord = table: 0 1.8; 6 1.8; 8 0.5; 10 0.5\n    set Range = " +
                                    number_to_text(start) + ", 10\n"));
        std::vector<Matrix6> of_nodes(scene.system.layout.n_nodes, Matrix6::Zero());
        scene.input.model.find<Surface>("it", "surface").add_virtual_mass(of_nodes);
        double     mass = 0, moment = 0, least = 0;
        const auto m = [&](const double s) { return M_PI / 4 * 1.225 * chord(s) * chord(s); };
        for (unsigned int node = 1; node < of_nodes.size(); ++node)
          {
            const double of_node = of_nodes[node].topLeftCorner<3, 3>().trace();
            mass += of_node;
            moment += of_node * scene.context.state.q[12 * node];
            for (unsigned int i = 0; i < 6; ++i)
              least = std::min(least, of_nodes[node](i, i));
          }
        const double exact = integral(start, 10, m);
        EXPECT_NEAR(mass, exact, 1e-6 * exact) << degree << " " << start;
        EXPECT_NEAR(moment, integral(start, 10, [&](const double s) { return s * m(s); }), 1e-5 * exact) << degree;
        EXPECT_GE(least, -1e-9 * exact) << degree << " " << start;
      }
}
