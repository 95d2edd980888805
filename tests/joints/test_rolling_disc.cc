// Rolling disc: velocities at the contact in any state, and steady rolling on a circle.

#include <samara/analysis/dynamic.h>

#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  const double R = 0.3, gravity = 9.80665;

  std::string
  disc_on_table(const std::string &joint)
  {
    return "subsection Bodies\n subsection table\n set Type = rigid body\n set Mass = 3\n set Inertia = 1, 2, 2.5\n"
           " set Position = 0.2, -0.1, 0.4\n set Rotation = 0.3, -0.2, 0.5\n end\n"
           " subsection disc\n set Type = rigid body\n set Mass = 2\n set Inertia = 1, 1.5, 2\n"
           " set Position = 1, 0.7, 0.3\n set Rotation = -0.6, 0.4, 0.1\n set Frames = middle at 0.8 0.9 0.5\n end\nend\n"
           "subsection Joints\n subsection j\n set Type = rolling disc\n set Body A = table\n set Body B = disc.middle\n" +
           joint + " end\nend\n";
  }

  const std::string tilted = "set Axis = 1, 2, 2\n set Axis 1 = 1, 0, 0\n set Axle = 2, -1, 1\n set Radius = 0.3\n";
} // namespace



// t·v and l·v of the material of the disc against that of the table, both at the lowest point of the edge.
TEST(RollingDisc, VelocitiesAtTheContact)
{
  Scene               scene(disc_on_table(tilted));
  const State         start = scene.system.reference();
  State               state = start;
  std::vector<double> z(scene.system.size());
  for (unsigned int i = 0; i < z.size(); ++i)
    z[i] = 0.5 * std::sin(1.3 * i + 0.2);
  scene.system.update(state, z);
  for (unsigned int i = 6; i < state.y.size(); ++i)
    state.y[i] = std::cos(2.1 * i);
  const auto turn = [&](const unsigned int node) { return Matrix3(state.triad(node) * start.triad(node).transpose()); };
  const auto moved = [&](const unsigned int node, const Vector3 &x) {
    return Vector3(state.position(node) + turn(node) * (x - start.position(node)));
  };
  const auto velocity = [&](const unsigned int node, const Vector3 &x) {
    const Vector3 spin = state.triad(node) * Eigen::Map<const Vector3>(&state.y[6 * node + 3]);
    return Vector3(state.triad(node) * Eigen::Map<const Vector3>(&state.y[6 * node]) +
                   spin.cross(x - state.position(node)));
  };
  const Vector3 n = turn(1) * Vector3(1, 2, 2).normalized(), a = turn(2) * Vector3(2, -1, 1).normalized();
  const double  cosine = n.dot(a), start_cosine = Vector3(1, 2, 2).normalized().dot(Vector3(2, -1, 1).normalized());
  const double  sine   = std::sqrt(1 - cosine * cosine);
  state.coordinates[0] = cosine - start_cosine;
  state.coordinates[1] = sine - std::sqrt(1 - start_cosine * start_cosine);

  const Vector3       centre  = moved(2, {0.8, 0.9, 0.5});
  const Vector3       contact = centre - R * (n - cosine * a) / std::sqrt(1 - cosine * cosine);
  const Vector3       v       = velocity(2, contact) - velocity(1, contact);
  std::vector<double> rates(scene.system.layout.n_multipliers);
  scene.system.constraint_rates(state.point(), rates.data());
  EXPECT_NEAR(rates[3], n.cross(a).dot(v), 1e-13);
  EXPECT_NEAR(rates[4], (a - cosine * n).dot(v), 1e-13);

  // forces: one at the contact on the disc, its opposite on the table, if nothing turns the angle
  state.multipliers    = {0, 5, 0, -3, 2};
  state.multipliers[2] = state.multipliers[1] * R / sine;
  state.multipliers[0] = state.multipliers[2] * cosine;
  std::vector<double> r(scene.system.size() + 6, 0.);
  scene.system.add_constraints(state.point(), r.data());
  for (const unsigned int i : {0, 1})
    EXPECT_NEAR(r[scene.system.layout.of_coordinate(i)], 0, 1e-13);
  const auto wrench = [&](const unsigned int node) {
    const int     i = scene.system.layout.of_node(node);
    const Matrix3 D = state.triad(node);
    const Vector3 f = -D * Eigen::Map<const Vector3>(&r[i]), m = -D * Eigen::Map<const Vector3>(&r[i + 3]);
    return std::make_pair(f, Vector3(m + (state.position(node) - contact).cross(f)));
  };
  const auto [force, moment]     = wrench(2);
  const auto [reaction, counter] = wrench(1);
  EXPECT_LT(moment.norm(), 1e-13);
  EXPECT_LT(counter.norm(), 1e-13);
  EXPECT_LT((force + reaction).norm(), 1e-13);
  const Matrix3 E     = turn(1) * triad_about({1, 2, 2}, {1, 0, 0});
  const auto    probe = [&](const std::string &path) { return scene.input.model.probe("j." + path).value(state); };
  for (unsigned int i = 0; i < 3; ++i)
    EXPECT_NEAR(probe("force " + std::to_string(i + 1)), E.col(i).dot(force), 1e-13);
  EXPECT_NEAR(probe("force along"), n.cross(a).dot(force) / sine, 1e-13);
  EXPECT_NEAR(probe("force across"), (a - cosine * n).dot(force) / sine, 1e-13);
  // the place of the contact on the table, from that in the reference configuration
  const Vector3 n_0 = Vector3(1, 2, 2).normalized(), a_0 = Vector3(2, -1, 1).normalized(),
                first = Vector3(0.8, 0.9, 0.5) - R * (n_0 - start_cosine * a_0) / n_0.cross(a_0).norm();
  for (unsigned int i = 0; i < 2; ++i)
    EXPECT_NEAR(probe("displacement " + std::to_string(i + 1)), E.col(i).dot(contact - moved(1, first)), 1e-13);
}



// A disc of mass m, moments A, A, C, rolls on a circle: its axle keeps the angle θ to the vertical and turns about it
// with Ω, and the spin p about the axle, seen from rest, obeys (C + m R²) Ω p sin θ = A Ω² sin θ cos θ − m g R cos θ
// (angular momentum about the centre). The centre goes with R p round a circle, and the plane carries m g.
TEST(RollingDisc, SteadyRollingOnACircle)
{
  const double  m = 1.2, A = 0.03, C = 0.054, theta = 1.1, Omega = 4, s = std::sin(theta), c = std::cos(theta);
  const double  p = (A * Omega * Omega * s * c - m * gravity * R * c) / ((C + m * R * R) * Omega * s);
  const Vector3 n(0, 0, 1), a(s, 0, c), u = (n - c * a) / s, spin = Omega * s * u + p * a, v = -R * p * n.cross(a) / s;
  const auto    text = [](const Vector3 &x) {
    return number_to_text(x(0)) + ", " + number_to_text(x(1)) + ", " + number_to_text(x(2));
  };
  for (const double radius_of_spectrum : {1., 0.5})
    {
      Scene scene(
        "set Analyses = dynamic\nsubsection Bodies\n subsection disc\n set Type = rigid body\n set Mass = 1.2\n"
        " set Inertia = 0.03, 0.03, 0.054\n set Position = 0, 0, " +
        number_to_text(R * s) + "\n set Rotation = 0, " + number_to_text(theta) + ", 0\n set Velocity = " + text(v) +
        "\n set Angular velocity = " + text(spin) +
        "\n end\nend\nsubsection Joints\n subsection edge\n set Type = rolling disc\n set Body A = ground\n"
        " set Body B = disc\n set Axle = " +
        text(a) +
        "\n set Radius = 0.3\n end\nend\nsubsection Loads\n subsection gravity\n set Type = gravity\n end\nend\n"
        "subsection Dynamic\n set End time = 1.5\n set Step = 0.01\n set Inconsistent velocities = refuse\n"
        " set Spectral radius = " +
        number_to_text(radius_of_spectrum) + "\nend\n");
      auto &dynamic = scene.analysis<DynamicAnalysis>();
      dynamic.start(scene.context);
      dynamic.run(scene.context);
      EXPECT_NEAR(scene.value("edge.tilt"), theta * 180 / M_PI - 90, 1e-5);
      EXPECT_NEAR(scene.value("edge.force 3"), m * gravity, 1e-4);
      // friction pulls to the middle of the circle, across the track and to the side where the axle points down
      EXPECT_NEAR(scene.value("edge.force along"), 0, 1e-4);
      EXPECT_NEAR(std::abs(scene.value("edge.force across")), m * v.norm() * Omega, 1e-4);
      EXPECT_NEAR(std::hypot(scene.value("edge.force 1"), scene.value("edge.force 2")), m * v.norm() * Omega, 1e-4);
      // round the centre of the circle, which is where n × v points
      const Vector3 to_centre = n.cross(v) / Omega, start(0, 0, R * s);
      const Matrix3 turned    = rotation_of_vector(1.5 * Omega * n);
      const Vector3 expected  = start + to_centre - turned * to_centre;
      const Vector3 x(scene.value("disc.position x"), scene.value("disc.position y"), scene.value("disc.position z"));
      EXPECT_LT((x - expected).norm(), 1e-6);
    }
}



// Disc and table are free: what the table gives the disc takes, and no energy is lost.
TEST(RollingDisc, OnAFreeTable)
{
  const auto momenta_at = [](const std::string &end_time, double &tilt) {
    std::string text = "set Analyses = dynamic\n" + disc_on_table(tilted) +
                       "subsection Dynamic\n set End time = " + end_time +
                       "\n set Step = 0.01\n set Spectral radius = 1\nend\n";
    text.insert(text.find(" set Frames"), " set Angular velocity = 1, 2, -1.5\n set Velocity = 0.2, -0.3, 0.1\n");
    Scene scene(text);
    auto &dynamic = scene.analysis<DynamicAnalysis>();
    dynamic.start(scene.context);
    dynamic.run(scene.context);
    tilt                            = scene.value("j.tilt");
    Eigen::Matrix<double, 7, 1> sum = Eigen::Matrix<double, 7, 1>::Zero();
    for (const unsigned int node : {1, 2})
      {
        const State  &state = scene.context.state;
        const Matrix3 D     = state.triad(node);
        const double  mass  = node == 1 ? 3 : 2;
        const Vector3 u(&state.y[6 * node]), w(&state.y[6 * node + 3]),
          p = mass * D * u, l = (node == 1 ? Vector3(1, 2, 2.5) : Vector3(1, 1.5, 2)).cwiseProduct(w);
        sum.head<3>() += p;
        sum.segment<3>(3) += D * l + state.position(node).cross(p);
        sum(6) += 0.5 * (mass * u.squaredNorm() + w.dot(l));
      }
    return sum;
  };
  double     first_tilt = 0, tilt = 0;
  const auto before = momenta_at("0.01", first_tilt), after = momenta_at("0.3", tilt);
  EXPECT_GT(std::abs(tilt - first_tilt), 1.);
  EXPECT_LT((after - before).head<6>().norm(), 1e-8 * before.norm());
  EXPECT_NEAR(after(6), before(6), 1e-8 * before(6));
}



TEST(RollingDisc, Refusals)
{
  EXPECT_EQ(complaint_of(disc_on_table(tilted)), "");
  EXPECT_NE(
    complaint_of(disc_on_table("set Axis = 1, 2, 2\n set Axle = 1, 2, 2\n set Radius = 0.3\n")).find("lie flat"),
    std::string::npos);
  EXPECT_NE(complaint_of(disc_on_table("set Axis = 1, 2, 2\n set Radius = 0.3\n")).find("<Axle> must be given"),
            std::string::npos);
  EXPECT_NE(complaint_of(disc_on_table(tilted + "set Position = 3, 3, 3\n")).find("above the plane"),
            std::string::npos);
  EXPECT_NE(complaint_of(disc_on_table("set Axle = 1, 0, 0\n set Radius = 0\n")).find("above zero"), std::string::npos);
}
