// The fields of surfaces and disks in pictures are the loads, in closed form.

#include <samara/model/drawing.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include "models.h"

using namespace samara;
using namespace samara::aero_models;

namespace
{
  /** The object @p name in the state of the scene. */
  Drawing
  drawing_of(const Scene &scene, const std::string &name)
  {
    Drawing drawing(&scene.input.model);
    for (const auto &item : scene.input.model.items)
      if (item->name == name)
        item->draw(scene.context.state, drawing);
    return drawing;
  }

  const Field &
  field_of(const Drawing &drawing, const std::string &name)
  {
    for (const auto &field : drawing.fields)
      if (field.name == name)
        return field;
    throw std::runtime_error("no field " + name);
  }

  /** Round-off of fields, which have numbers of single precision. */
  constexpr double single = 2e-7;

  /** The two points of Gauss's rule on (0, 1). */
  const std::array<double, 2> gauss = {{0.5 - 0.5 / std::sqrt(3.), 0.5 + 0.5 / std::sqrt(3.)}};
} // namespace



// A tapered, twisted wing in steady flow: every field at every station.
TEST(LoadsInPictures, TaperedWing)
{
  const double U = 30, rho = 1.225;
  Scene        scene(rigid_wing(air("30, 0, 0"),
                         "    set Chord = 0.6 - 0.1*s\n    set Twist = 0.02 + 0.03*s\n    set Airfoils = plain\n"
                                "    set Unsteady = quasi-steady\n    set Stations = 2\n    set Breaks = 2\n"));
  const auto   drawing = drawing_of(scene, "it");
  ASSERT_EQ(drawing.samples.size(), 4u);
  for (unsigned int i = 0; i < 4; ++i)
    {
      const double s = 2 * gauss[i % 2] + 2 * (i / 2), c = 0.6 - 0.1 * s, alpha = 0.02 + 0.03 * s,
                   sine = std::sin(alpha), lift = 2 * M_PI * sine * std::cos(alpha),
                   drag = 0.01 + 0.02 * sine + 0.5 * sine * sine, moment = -0.02 + 0.1 * sine,
                   q = 0.5 * rho * U * U * c;
      const auto is  = [&](const std::string &name, const double value) {
        EXPECT_NEAR(field_of(drawing, name)(i), value, single * (1 + std::abs(value))) << name << i;
      };
      is("angle of attack", alpha * 180 / M_PI);
      is("Mach", U / 340.3);
      is("speed", U);
      is("lift coefficient", lift);
      is("drag coefficient", drag);
      is("moment coefficient", moment);
      // along the section's own axes: to the upper side, and to the leading edge
      is("normal force", q * (lift * std::cos(alpha) + drag * sine));
      is("chord force", q * (lift * sine - drag * std::cos(alpha)));
      is("moment", q * c * moment);
      is("inflow", 0.);
      // at the quarter chord, where the loads act
      EXPECT_NEAR(drawing.samples[i].x(1), s - 1, 1e-12);
      EXPECT_NEAR(drawing.samples[i].x(2), 0., 1e-12);
    }
}



// Blades in a flow that is given, w₀ + r/R (w_c cos ψ + w_s sin ψ): radius, azimuth, flow and angle of attack on the
// blades, and the same flow on the web of the disk.
TEST(LoadsInPictures, BladesAndTheirDisk)
{
  const double      R = 3, spin = 30;
  const std::string flow =
    "  subsection flow\n    set Type = prescribed inflow\n    set Hub = ground\n    set Direction "
    "= 1, 0, 0\n    set Radius = 3\n    set Velocity = 4, 1.5, -0.7\n  end\n";
  Scene scene(
    turning_rotor(4,
                  "    set Chord = 0.2\n    set Twist = 0.12\n    set Airfoils = plain\n    set Stations = 2\n",
                  airfoils(),
                  air("0, 0, 0") + flow));
  scene.equilibrium();
  const auto given = [&](const double r, const double psi) {
    return 4 + r / R * (1.5 * std::cos(psi) - 0.7 * std::sin(psi));
  };
  for (unsigned int k = 0; k < 4; ++k)
    {
      const auto drawing = drawing_of(scene, "blade " + std::to_string(k + 1));
      ASSERT_EQ(drawing.samples.size(), 2u);
      for (unsigned int i = 0; i < 2; ++i)
        {
          const double r = 0.6 + 2.4 * gauss[i], w = given(r, k * M_PI / 2);
          EXPECT_NEAR(field_of(drawing, "radius")(i), r, 4 * single);
          EXPECT_NEAR(std::remainder(field_of(drawing, "azimuth")(i) - 90. * k, 360.), 0., 360 * single);
          EXPECT_NEAR(field_of(drawing, "inflow")(i), w, 8 * single);
          EXPECT_NEAR(field_of(drawing, "angle of attack")(i) * M_PI / 180, 0.12 - std::atan2(w, spin * r), single);
        }
    }
  const auto disk = drawing_of(scene, "flow");
  ASSERT_GT(disk.samples.size(), 100u);
  double largest = 0;
  for (unsigned int i = 0; i < disk.samples.size(); ++i)
    {
      const Vector3 x = disk.samples[i].x;
      const double  r = x.head<2>().norm();
      EXPECT_NEAR(field_of(disk, "inflow")(i), given(r, std::atan2(x(1), x(0))), 8 * single);
      largest = std::max(largest, r);
    }
  EXPECT_NEAR(largest, R, 1e-9);
}
