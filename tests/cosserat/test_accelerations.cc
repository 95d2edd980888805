// Probes of accelerations. The reference is motion itself: all nodes are made to move along some smooth x(t) and D(t),
// and what a probe of acceleration says is the rate of what the probe of velocity says, and that the rate of the place.
// Differences of sixth order: 1e-9. A steady rotation has the closed form ω × (ω × r): 1e-13.

#include <gtest/gtest.h>

#include "bodies.h"

using namespace samara;

namespace
{
  constexpr double h = 0.01;

  template <typename Function>
  auto
  rate(const Function &f, const double t)
  {
    using Value     = decltype(f(t));
    const Value sum = 45 * (f(t + h) - f(t - h)) - 9 * (f(t + 2 * h) - f(t - 2 * h)) + (f(t + 3 * h) - f(t - 3 * h));
    return Value(sum / (60 * h));
  }

  /** Place and triad of a node, by its number; the ground does not move. */
  Vector3
  place(const Model &model, const unsigned int node, const double t)
  {
    const double k = node == 0 ? 0 : 1;
    return model.nodes[node].x + k * Vector3(std::sin(2 * t + node), t * t + 0.1 * node * t, std::cos(t - 0.3 * node));
  }

  Matrix3
  triad(const Model &model, const unsigned int node, const double t)
  {
    const double k = node == 0 ? 0 : 1;
    return model.nodes[node].D *
           rotation_of_vector(k * Vector3(t - 0.2 * node, std::sin(t + 0.4 * node), 0.6 * t * t + 0.1 * node));
  }

  Vector6
  twist(const Model &model, const unsigned int node, const double t)
  {
    const Matrix3 D = triad(model, node, t);
    const Matrix3 W = D.transpose() * rate([&](const double t) { return triad(model, node, t); }, t);
    Vector6       y;
    y << D.transpose() * rate([&](const double t) { return place(model, node, t); }, t), axial(W);
    return y;
  }

  void
  move(Scene &scene, const double t)
  {
    const Model &model = scene.input.model;
    State       &state = scene.context.state;
    state.accelerations.assign(6 * model.nodes.size() + model.coordinates.size(), 0.);
    for (unsigned int node = 0; node < model.nodes.size(); ++node)
      {
        Eigen::Map<Vector3>(&state.q[12 * node])     = place(model, node, t);
        Eigen::Map<Matrix3>(&state.q[12 * node + 3]) = triad(model, node, t);
        Eigen::Map<Vector6>(&state.y[6 * node])      = twist(model, node, t);
        Eigen::Map<Vector6>(&state.accelerations[6 * node]) =
          rate([&](const double t) { return twist(model, node, t); }, t);
      }
  }

  std::vector<std::string>
  all_points()
  {
    auto points = points_of_bodies;
    points.insert(points.end(), points_of_rod.begin(), points_of_rod.end());
    return points;
  }



  TEST(Accelerations, AreRatesOfVelocities)
  {
    for (const auto &joints : {weld_rod_to_ground, weld_rod_to_plate})
      {
        Scene        scene(bodies("", "", "", joints));
        const double t = 0.4;
        for (const auto &point : all_points())
          {
            const auto at = [&](const std::string &quantity) {
              return [&, quantity](const double t) {
                move(scene, t);
                return vector_of(scene, point + "." + quantity);
              };
            };
            EXPECT_LT((at("velocity")(t) - rate(at("position"), t)).norm(), 1e-9) << point;
            EXPECT_LT((at("acceleration")(t) - rate(at("velocity"), t)).norm(), 1e-9) << point;
            EXPECT_LT((at("angular acceleration")(t) - rate(at("angular velocity"), t)).norm(), 1e-9) << point;
            if (point != "rod.start" || joints == weld_rod_to_plate)
              {
                EXPECT_GT(at("acceleration")(t).norm(), 0.1) << point;
              }
          }
      }
  }



  /** Twists in the nodes' axes do not change then; the ground turns too. */
  TEST(Accelerations, OfASteadyRotationPointToItsAxis)
  {
    Scene         scene(bodies("", "", "", weld_rod_to_ground));
    State        &state = scene.context.state;
    const Vector3 w(2, -1, 3), at(0.2, 0.3, -0.4);
    for (auto &motion : state.motion)
      motion = {w, Vector3::Zero(), at};
    scene.system.update_twists(state);
    for (const auto &point : all_points())
      EXPECT_EQ(Vector3(vector_of(scene, point + ".acceleration")), Vector3::Zero()) << "not known";

    state.accelerations.assign(state.y.size(), 0.);
    for (const auto &point : all_points())
      {
        const Vector3 expected = w.cross(w.cross(vector_of(scene, point + ".position") - at));
        EXPECT_LT((vector_of(scene, point + ".acceleration") - expected).norm(), 1e-13 * expected.norm()) << point;
        EXPECT_EQ(Vector3(vector_of(scene, point + ".angular acceleration")), Vector3::Zero()) << point;
      }
  }



  TEST(Accelerations, HaveUnits)
  {
    const Scene scene(bodies("", "", ""));
    EXPECT_EQ(scene.input.model.probe("ball.acceleration x").unit, "m/s^2");
    EXPECT_EQ(scene.input.model.probe("rod.end.angular acceleration z").unit, "rad/s^2");
    EXPECT_THROW(scene.input.model.probe("rod.end.angular acceleration 1"), std::invalid_argument);
  }
} // namespace
