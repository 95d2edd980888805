/*
 * Problem:   a shaft in two bearings, one of them above the other, that is bent by a load and turned about the line
 *            between them; the same held in one place only; drawings of samples alone, of all kinds of items
 * Reference: its ends, which the rigid motion takes to where they are: a bent shaft stays in its bearings when its bend
 * is magnified; the triad of the one place; whole drawings of the same states
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



/** Kinds with shapes of their own: beams, shells with layers, wings, inflows, bodies, springs, contacts, curves. */
TEST(ReportDrawings, SamplesAloneAreThoseOfWholeDrawings)
{
  unsigned int n_fields = 0;
  for (const std::string name : {"rotorcraft/tail_rotor_transmission",
                                 "rotorcraft/flapping_rotor",
                                 "examples/shells/laminate",
                                 "examples/spring",
                                 "examples/springs_in_fixed_axes",
                                 "examples/distance",
                                 "examples/rolling_disc",
                                 "examples/rolling_ball",
                                 "examples/knife_edge",
                                 "examples/ball_on_plane",
                                 "examples/ellipsoid_on_plane",
                                 "examples/point_on_curve",
                                 "examples/sliding_point",
                                 "examples/flexible_joint",
                                 "examples/trapeze",
                                 "examples/in_plane",
                                 "examples/prismatic",
                                 "examples/universal",
                                 "examples/spherical"})
    {
      SCOPED_TRACE(name);
      Scene         scene("prm/" + name + ".prm");
      const State   state = scene.system.reference();
      const Drawing whole = scene.system.draw(state);
      ASSERT_GT(whole.corners.size(), 0u);
      const DrawnModel model(scene.system.model, whole, whole);
      for (const auto content : {Drawing::Content::samples, Drawing::Content::places})
        for (const Drawing &part : {scene.system.draw(state, content), whole.only(content)})
          {
            EXPECT_TRUE(part.corners.empty() && part.cells.empty() && part.objects.empty() && part.attachments.empty());
            EXPECT_EQ(whole.corners.size(), part.n_corners());
            EXPECT_EQ(whole.cells.size(), part.n_cells());
            EXPECT_EQ(whole.objects.size(), part.n_objects());
            EXPECT_EQ(whole.items, part.items);
            EXPECT_TRUE(model.fits(part));
            EXPECT_EQ(model.motion(whole), model.motion(part));
            EXPECT_EQ(model.rigid_motions(whole), model.rigid_motions(part));
            if (content == Drawing::Content::places)
              continue;
            ASSERT_EQ(whole.fields.size(), part.fields.size());
            for (unsigned int f = 0; f < whole.fields.size(); ++f)
              {
                const Field &a = whole.fields[f], &b = part.fields[f];
                EXPECT_EQ(a.name, b.name);
                ASSERT_EQ(a.end(), b.end());
                for (unsigned int s = 0; s < a.end(); ++s)
                  for (unsigned int d = 0; d < a.n_components(); ++d)
                    EXPECT_TRUE(a(s, d) == b(s, d) || (std::isnan(a(s, d)) && std::isnan(b(s, d))));
                ++n_fields;
              }
          }
    }
  EXPECT_GT(n_fields, 60u);
}



/** Two meshes of as many points are two models: drawings that no items have made are told apart by their names. */
TEST(ReportDrawings, DrawingsWithoutItemsAreToldApartByName)
{
  const auto drawn = [](const std::string &name, const double size) {
    Drawing drawing;
    drawing.begin_object(name);
    drawing.box(Sample(), Vector3::Constant(size));
    return drawing;
  };
  const Model      none;
  const Drawing    one = drawn("one", 1), other = drawn("other", 2);
  const DrawnModel model(none, one, Drawing());
  EXPECT_TRUE(model.fits(one));
  EXPECT_FALSE(model.fits(other));
  EXPECT_FALSE(model.fits(other.only(Drawing::Content::samples)));
}
