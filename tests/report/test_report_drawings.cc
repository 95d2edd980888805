/*
 * Problem:   a shaft in two bearings, one of them above the other, that is bent by a load and turned about the line
 *            between them; the same held in one place only
 * Reference: its ends, which the rigid motion takes to where they are: a bent shaft stays in its bearings when its bend
 * is magnified; the triad of the one place
 */

#include <samara/report/drawn_model.h>

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  const char *const shaft = R"(
subsection Sections
  subsection round
    set Type         = tube
    set E            = 210 GPa
    set Density      = 7800
    set Outer radius = 0.02
  end
end
subsection Bodies
  subsection shaft
    set Type     = beam
    set Points   = 0, 0, 0; 1, 0.2, 0.1; 2, 0, 0
    set Section  = round
    set Elements = 4
  end
end
subsection Joints
  subsection left
    set Type   = spherical
    set Body A = ground
    set Body B = shaft.start
  end
  subsection right
    set Type   = in line
    set Body A = ground
    set Body B = shaft.end
    set Axis   = 1, 0, 0
  end
end
)";
} // namespace



TEST(ReportDrawings, BentShaftStaysInItsBearings)
{
  Scene scene(std::string(shaft) + "subsection Loads\n  subsection weight\n    set Type = gravity\n  end\nend\n");
  const System &system    = scene.system;
  const Drawing reference = system.draw(system.reference());
  ASSERT_EQ(4u, reference.attachments.size());
  State               state = system.reference();
  std::vector<double> z(system.size(), 0.);
  for (unsigned int node = 1; node < system.layout.n_nodes; ++node) // bends more at one end, and turns
    {
      const Vector3 x                    = state.position(node);
      z[system.layout.of_node(node) + 1] = 0.3 * std::sin(M_PI * x(0) / 2);
      z[system.layout.of_node(node) + 2] = -0.2 * x(0) * (2 - x(0)) * x(0);
      z[system.layout.of_node(node) + 3] = 0.6;
      z[system.layout.of_node(node) + 5] = 0.3 * std::cos(M_PI * x(0) / 2);
    }
  system.update(state, z);
  const Drawing    drawing = system.draw(state);
  const DrawnModel model(system.model, drawing, reference);
  ASSERT_EQ("shaft", drawing.objects[0]);
  const auto               rigid = model.rigid_motions(drawing);
  const Eigen::Quaterniond q(rigid[6], rigid[3], rigid[4], rigid[5]);
  const auto moved = [&](const Vector3 &x) -> Vector3 { return Vector3(rigid[0], rigid[1], rigid[2]) + q * x; };
  std::vector<unsigned int> ends;
  double                    largest = 0;
  for (unsigned int s = 0; s < drawing.samples.size(); ++s)
    {
      const double x = reference.samples[s].x(0), off = (moved(reference.samples[s].x) - drawing.samples[s].x).norm();
      if (drawing.corners[12 * s].object > 0)
        break;
      if (x < 1e-9 || x > 2 - 1e-9)
        {
          ends.push_back(s);
          EXPECT_LT(off, 1e-6); // single precision, and the shortening of the bend, of which there is none
        }
      largest = std::max(largest, off);
    }
  EXPECT_EQ(2u, ends.size());
  EXPECT_GT(largest, 0.2);
}
