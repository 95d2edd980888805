// The shipped swash-plate: the pitch of each blade against the geometry of plate, scissors and links.

#include <samara/analysis/dynamic.h>

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  constexpr double height = 0.5, horn_x = 0.289, horn_y = -0.181;

  Matrix3
  turn(const unsigned int axis, const double angle)
  {
    return Eigen::AngleAxisd(angle, Vector3::Unit(axis)).toRotationMatrix();
  }

  /** Where f is zero, near @p x. */
  template <typename Function>
  double
  root(const Function &f, double x)
  {
    for (unsigned int i = 0; i < 60; ++i)
      {
        const double slope = (f(x + 1e-6) - f(x - 1e-6)) / 2e-6, step = f(x) / slope;
        x -= step;
        if (std::abs(step) < 1e-15)
          break;
      }
    return x;
  }

  /**
   * Pitch of the blade that is @p ahead of the shaft's angle @p psi, with the plate at @p collective, tilted about the
   * slider's x by @p tilt_1, and then about its own y by @p tilt_2.
   */
  double
  pitch(const double ahead, const double psi, const double collective, const double tilt_1, const double tilt_2)
  {
    const Vector3 centre(0, 0, collective - height);
    const Matrix3 plate = turn(0, tilt_1) * turn(1, tilt_2);
    // the scissors keep the ball in the plane of the shaft's axis that turns with it
    const Vector3 normal = turn(2, psi) * Vector3::UnitY();
    const double  chi = root([&](const double x) { return normal.dot(plate * turn(2, x) * Vector3(-0.2, 0, 0)); }, psi);
    const Vector3 on_plate = centre + plate * turn(2, chi + ahead) * Vector3(horn_x, horn_y, 0);
    return root(
      [&](const double theta) {
        const Vector3 horn = turn(2, psi + ahead) * Vector3(horn_x, horn_y * std::cos(theta), horn_y * std::sin(theta));
        return (horn - on_plate).norm() - height;
      },
      0.);
  }
} // namespace



TEST(SwashPlate, PitchFollowsFromGeometry)
{
  Scene scene("prm/rotorcraft/swash_plate.prm", {"Dynamic/End time = 0.12"});
  EXPECT_TRUE(scene.input.assembled && scene.input.assembled->has_moved()); // links are drawn 2 mm too low
  constexpr double degrees = M_PI / 180;
  double           worst = 0, largest = 0, smallest = 0;
  unsigned int     n_steps  = 0;
  auto            &dynamics = scene.analysis<DynamicAnalysis>();
  dynamics.observer         = [&](const State &state) {
    const auto   value = [&](const std::string &probe) { return scene.input.model.probe(probe).value(state); };
    const double psi = degrees * value("drive.rotation"), up = value("slide.displacement"),
                 tilt_1 = degrees * value("gimbal.rotation 1"), tilt_2 = degrees * value("gimbal.rotation 2");
    EXPECT_NEAR(psi, 27 * state.time, 1e-9);
    for (unsigned int blade = 0; blade < 4; ++blade)
      {
        const double angle = degrees * value("blade " + std::to_string(blade + 1) + ":pitch.rotation");
        worst              = std::max(worst, std::abs(angle - pitch(blade * M_PI / 2, psi, up, tilt_1, tilt_2)));
        largest            = std::max(largest, angle);
        smallest           = std::min(smallest, angle);
      }
    ++n_steps;
  };
  dynamics.start(scene.context);
  dynamics.run(scene.context);
  EXPECT_GE(n_steps, 60u);
  EXPECT_LT(worst, 1e-9);
  // 0.01198 m at a horn of 0.181 m are 3.8 degrees; the cyclic parts make between them what they make of 0.34 m and
  // 0.018 rad
  EXPECT_GT(largest - smallest, 3 * degrees);
  EXPECT_LT(largest - smallest, 8 * degrees);
}
