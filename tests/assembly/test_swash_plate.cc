// The shipped swash-plate: the pitch of each blade against the geometry of plate, scissors and links.

#include <samara/analysis/dynamic.h>
#include <samara/base/text.h>

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

  /** Where a body is. */
  struct Place
  {
    Vector3 x;
    Matrix3 D;
  };

  /**
   * Pitch of the blade that is @p ahead of the hub's axis 1, with the lower plate at @p plate. The scissors keep the
   * ball in the plane of the hub's axis that turns with it; @p near is an angle of the upper plate near that.
   */
  double
  pitch(const double ahead, const Place &hub, const Place &plate, const double near)
  {
    const auto   ball = [&](const double x) -> Vector3 { return plate.x + plate.D * turn(2, x) * Vector3(-0.2, 0, 0); };
    const double chi  = root([&](const double x) { return hub.D.col(1).dot(ball(x) - hub.x); }, near);
    const Vector3 on_plate = plate.x + plate.D * turn(2, chi + ahead) * Vector3(horn_x, horn_y, 0);
    return root(
      [&](const double theta) {
        const Vector3 horn =
          hub.x + hub.D * turn(2, ahead) * Vector3(horn_x, horn_y * std::cos(theta), horn_y * std::sin(theta));
        return (horn - on_plate).norm() - height;
      },
      0.);
  }

  constexpr double degrees = M_PI / 180;

  /** Where a body is at a state, drawn along the inertial axes. */
  Place
  place_of(const Model &model, const State &state, const std::string &point)
  {
    Vector3 x, rotation;
    for (int i = 0; i < 3; ++i)
      {
        x(i)        = model.probe(point + ".position " + "xyz"[i]).value(state);
        rotation(i) = degrees * model.probe(point + ".rotation " + "xyz"[i]).value(state);
      }
    const double  angle = rotation.norm();
    const Matrix3 D =
      angle > 0 ? Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix() : Matrix3(Matrix3::Identity());
    return {x, D};
  }
} // namespace



TEST(SwashPlate, PitchFollowsFromGeometry)
{
  Scene scene("prm/rotorcraft/swash_plate.prm", {"Dynamic/End time = 0.12"});
  EXPECT_TRUE(scene.input.assembled && scene.input.assembled->has_moved()); // scissors are drawn millimetres off
  double       worst = 0, largest = 0, smallest = 0;
  unsigned int n_steps  = 0;
  auto        &dynamics = scene.analysis<DynamicAnalysis>();
  dynamics.observer     = [&](const State &state) {
    const auto   value = [&](const std::string &probe) { return scene.input.model.probe(probe).value(state); };
    const double psi = degrees * value("hub:shaft.rotation"), up = value("plate:slide.displacement"),
                 tilt_1 = degrees * value("plate:gimbal.rotation 1"), tilt_2 = degrees * value("plate:gimbal.rotation 2");
    EXPECT_NEAR(psi, 27 * state.time, 1e-9);
    const Place hub{Vector3::Zero(), turn(2, psi)},
      plate{Vector3(0, 0, up - height), turn(0, tilt_1) * turn(1, tilt_2)};
    for (unsigned int blade = 0; blade < 4; ++blade)
      {
        const double angle = degrees * value("blade " + std::to_string(blade + 1) + ":pitch.rotation");
        worst              = std::max(worst, std::abs(angle - pitch(blade * M_PI / 2, hub, plate, psi)));
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



// Scissors of three revolutes have parallel axes: the upper plate could slide and tilt about one of them, and a plate that
// is tilted needs both tilts once a turn. The run says which constraints contradict each other.
TEST(SwashPlate, LocksWithThreeRevolutes)
{
  Scene scene("prm/rotorcraft/swash_plate.prm", {"Joints/plate:ball/Type = revolute", "Joints/plate:ball/Axis = 0, 1, 0"});
  auto &dynamics = scene.analysis<DynamicAnalysis>();
  dynamics.start(scene.context);
  try
    {
      dynamics.run(scene.context);
      FAIL();
    }
  catch (const NotConverged &problem)
    {
      const std::string text = problem.what();
      EXPECT_NE(text.find("contradict each other"), std::string::npos) << text;
      EXPECT_NE(text.find("joint plate:knee"), std::string::npos) << text;
    }
}



// The plates slide along a shaft that bends: the slider is on the polynomials through the shaft's nodes and square to
// its sections, held by its finger, and the pitch is that of hub and slider where they are.
TEST(SwashPlate, FollowsAFlexibleShaft)
{
  Scene  scene("prm/rotorcraft/swash_plate_flexible_shaft.prm", {"Dynamic/End time = 0.1"});
  double worst = 0, off = 0, leaning = 0, moved = 0;
  auto  &dynamics   = scene.analysis<DynamicAnalysis>();
  dynamics.observer = [&](const State &state) {
    const Model &model = scene.input.model;
    const auto   value = [&](const std::string &probe) { return model.probe(probe).value(state); };
    const Place  hub = place_of(model, state, "hub"), slider = place_of(model, state, "plate:slider");

    // the shaft, 1 m and five elements of degree 3 on Gauss-Lobatto nodes
    const double S = value("plate:slide.arc length"), xi = (S - 0.4) / 0.2;
    const double nodes[4] = {0, 0.5 - std::sqrt(0.05), 0.5 + std::sqrt(0.05), 1};
    Vector3      x = Vector3::Zero(), along = Vector3::Zero();
    ASSERT_TRUE(xi > 0 && xi < 1);
    for (int a = 0; a < 4; ++a)
      {
        double N = 1;
        for (int b = 0; b < 4; ++b)
          N *= b != a ? (xi - nodes[b]) / (nodes[a] - nodes[b]) : 1;
        const Place node = place_of(model, state, "shaft.at " + number_to_text("%.17g", 0.4 + 0.2 * nodes[a]));
        x += N * node.x;
        along += N * node.D.col(2);
      }
    off = std::max({off,
                    (slider.x - x).norm(),
                    std::abs(slider.D.col(0).dot(along)),
                    std::abs(slider.D.col(1).dot(along)),
                    std::abs(slider.x.y() + 0.3 * slider.D(1, 0)), // the finger, in its slot
                    std::abs(S - 0.5 - value("plate:slide.displacement"))});

    const Place plate{slider.x,
                      slider.D * turn(0, degrees * value("plate:gimbal.rotation 1")) *
                        turn(1, degrees * value("plate:gimbal.rotation 2"))};
    for (unsigned int blade = 0; blade < 4; ++blade)
      worst = std::max(worst,
                       std::abs(degrees * value("blade " + std::to_string(blade + 1) + ":pitch.rotation") -
                                pitch(blade * M_PI / 2, hub, plate, 27 * state.time)));
    leaning = std::max(leaning, std::acos(slider.D(2, 2)));
    moved   = std::max(moved, hub.x.norm());
  };
  dynamics.start(scene.context);
  dynamics.run(scene.context);
  EXPECT_LT(worst, 1e-9);
  EXPECT_LT(off, 1e-10);
  // P L^3/(3 EI) = 8.4 mm, and half way up 3/8 of P L^2/EI = 9.5 mrad; swinging to less than twice that
  EXPECT_GT(moved, 0.004);
  EXPECT_LT(moved, 0.02);
  EXPECT_GT(leaning, 0.004);
}
