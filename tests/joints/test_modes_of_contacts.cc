// Motions counted by modes: of what rolls, touches, sticks, of supports and joints along edges. What is free has no
// frequency; what a contact, a bristle or the weight on a round surface holds has one of a closed form.
//
// A body of 2 kg without symmetry lies on what it touches, pressed in as deep as its weight does it, or a little above.

#include "../scene.h"
#include <gtest/gtest.h>

#include <algorithm>

using namespace samara;

namespace
{
  constexpr double weight_of_body = 2 * 9.80665, stiffness_of_touch = 1e5, depth_of_body = weight_of_body / 1e5;

  struct CountedModes
  {
    std::string         text;
    unsigned int        n_free; ///< modes without a frequency
    std::vector<double> frequencies = {};
    bool is_loaded = false; ///< about the equilibrium of statics; others are in equilibrium as they are drawn
  };

  std::string
  number_in_text(const double x)
  {
    std::ostringstream text;
    text.precision(17);
    text << x;
    return text.str();
  }

  /** @p bodies besides the body <b> of inertia 0.3, 0.4, 0.5 with its centre at the height @p z. */
  std::string
  with_body(const double z, const std::string &joints, const std::string &bodies = "", const bool has_weight = true)
  {
    return "subsection Bodies\n subsection b\n set Type = rigid body\n set Mass = 2\n set Inertia = 0.3, 0.4, 0.5\n"
           " set Position = 0, 0, " +
           number_in_text(z) + "\n end\n" + bodies + "end\nsubsection Joints\n" + joints + "end\n" +
           (has_weight ? "subsection Loads\n subsection weight\n set Type = gravity\n end\nend\n" : "");
  }

  std::string
  joint_of(const std::string &kind, const std::string &entries)
  {
    return " subsection j\n set Type = " + kind + "\n" + entries + " end\n";
  }

  std::string
  touching_ground(const std::string &kind, const std::string &entries)
  {
    return joint_of(kind, " set Body A = ground\n set Body B = b\n set Stiffness = 1e5\n" + entries);
  }

  /** A plate of steel, free but for @p joints, and the body a little off its edge. */
  std::string
  with_plate(const std::string &joints)
  {
    return with_body(0.1,
                     joints,
                     " subsection s\n set Type = shell\n set Patches = u, 0.5*v, 0\n set Elements = 2, 2\n"
                     " set Degree = 2\n set E = 2e11\n set Poisson ratio = 0.3\n set Density = 7800\n"
                     " set Thickness = 0.02\n end\n",
                     false);
  }

  std::string
  held(const std::string &along, const std::string &fixed)
  {
    return joint_of("support", " set Along = " + along + "\n set Fixed = " + fixed + "\n");
  }

  const std::string clamped_body =
                      " subsection clamp\n set Type = rigid\n set Body A = ground\n set Body B = b\n end\n",
                    of_edge = " set Along = s.edge u1\n set Body = b\n", ball_of_02 = " set Radius = 0.2\n",
                    on_floor = " set Position = 0, 0, 0\n" + ball_of_02;

  /** The body as a ball of 0.2 m, or as an egg that is as high, under its weight, or without it a little apart. */
  std::map<std::string, CountedModes>
  touching_kinds()
  {
    const double k = stiffness_of_touch, up = std::sqrt(k / 2), sunk = 0.2 - depth_of_body, hung = -0.3 - depth_of_body,
                 swing = std::sqrt(9.80665 / (0.3 + depth_of_body));
    const auto rocking = [&](const double a, const double J) {
      return std::sqrt(weight_of_body * (a * a - 0.04) / 0.2 / J);
    };
    // turned about axis 1 it rocks over the semi-axis 2, and the other way round
    const std::vector<double> rocks = {rocking(0.25, 0.3), rocking(0.3, 0.4), up},
                              rolls = {std::sqrt(500 * (0.5 + 0.04 / 0.4)), std::sqrt(500 * (0.5 + 0.04 / 0.3)), up};
    const std::string bowl          = " set Position = 0, 0, 0\n set Radius A = 0.5\n set Side = inside\n" + ball_of_02,
                      egg           = " set Position = 0, 0, 0\n set Semi-axes = 0.3, 0.25, 0.2\n",
                      bent          = " set Friction = 0.3\n set Bristle stiffness = 500\n",
                      group         = " set Stiffness = 1e5\n set Balls = b radius 0.2\n set Overlap = allowed\n";
    return {
      {"ball on plane", {with_body(sunk, touching_ground("ball on plane", on_floor)), 5, {up}}},
      {"ball on plane, apart", {with_body(0.21, touching_ground("ball on plane", on_floor), "", false), 6, {}}},
      {"ball in a hollow ball", {with_body(hung, touching_ground("ball on ball", bowl)), 3, {swing, swing, up}}},
      {"ball in a hollow ball, apart", {with_body(-0.29, touching_ground("ball on ball", bowl), "", false), 6, {}}},
      {"ball in a tube",
       {with_body(hung, touching_ground("ball on cylinder", bowl + " set Axis = 0, 1, 0\n")), 4, {swing, up}}},
      {"ball in a tube, apart",
       {with_body(-0.29, touching_ground("ball on cylinder", bowl + " set Axis = 0, 1, 0\n"), "", false), 6, {}}},
      {"ellipsoid on plane", {with_body(sunk, touching_ground("ellipsoid on plane", egg)), 3, rocks}},
      {"ellipsoid on plane, apart", {with_body(0.21, touching_ground("ellipsoid on plane", egg), "", false), 6, {}}},
      {"contacts, plane",
       {with_body(sunk, joint_of("contacts", group + " set Planes = ground at 0 0 0 normal 0 0 1\n")), 5, {up}}},
      {"contacts, hollow ball",
       {with_body(hung, joint_of("contacts", group + " set Hollow balls = ground at 0 0 0 radius 0.5\n")),
        3,
        {swing, swing, up}}},
      {"contacts, tube",
       {with_body(hung, joint_of("contacts", group + " set Tubes = ground at 0 0 0 axis 0 1 0 radius 0.5\n")),
        4,
        {swing, up}}},
      {"contacts, apart",
       {with_body(0.21, joint_of("contacts", group + " set Planes = ground at 0 0 0 normal 0 0 1\n"), "", false),
        6,
        {}}},
      // what sticks rolls in two directions and turns on the spot; each bristle is a state without a rate
      {"bristles", {with_body(sunk, touching_ground("ball on plane", on_floor + bent)), 3 + 2, rolls}},
    };
  }

  /** What touches rods, at places that move along them. The ball lies in the trough of two rods, pressed by f against
   * each at an angle ψ; a rod on the body lies across one of the ground, held by weak springs. */
  std::map<std::string, CountedModes>
  at_nearest_places()
  {
    const double k = stiffness_of_touch, psi = 0.6, f = weight_of_body / (2 * std::cos(psi)), D = 0.5 - f / k,
                 s = std::sin(psi), c = std::cos(psi);
    const auto rod = [](const double x, const double z) {
      return "ground from " + number_in_text(x) + " -1 " + number_in_text(z) + " to " + number_in_text(x) + " 1 " +
             number_in_text(z) + " radius 0.3";
    };
    // across: D is what the axes are apart; coordinates x along the body's rod and θ about the one of the ground
    const double k_x = 500, k_y = 300, k_t = 40, D_2 = 0.5 - depth_of_body;
    const double a = k_x / 2, b = (k_t + weight_of_body * D_2) / 0.4, e = weight_of_body * weight_of_body / (2 * 0.4),
                 root      = std::sqrt(std::pow((a - b) / 2, 2) + e);
    const std::string bush = " subsection bush\n set Type = flexible joint\n set Body A = ground\n set Body B = b\n"
                             " set Axis = 1, 0, 0\n set Axis 2 = 0, 1, 0\n set Stiffness = 500, 300, 0\n"
                             " set Rotational stiffness = 40, 40, 40\n end\n";
    return {
      {"ball in the trough of two rods",
       {with_body(0,
                  joint_of("contacts",
                           " set Stiffness = 1e5\n set Overlap = allowed\n set Balls = b radius 0.2\n set Rods = " +
                             rod(-D * s, -D * c) + ", " + rod(D * s, -D * c) + "\n")),
        4,
        {std::sqrt((2 * k * c * c - 2 * f / D * s * s) / 2), std::sqrt((2 * k * s * s - 2 * f / D * c * c) / 2)}}},
      {"rod across a rod",
       {with_body(0,
                  bush + joint_of("contacts",
                                  " set Stiffness = 1e5\n set Overlap = allowed\n"
                                  " set Rods = b from -1 0 0 to 1 0 0 radius 0.2, " +
                                    rod(0, -D_2) + "\n")),
        0,
        {std::sqrt(k / 2),
         std::sqrt(k_y / 2),
         std::sqrt(k_t / 0.3),
         std::sqrt(k_t / 0.5),
         std::sqrt((a + b) / 2 + root),
         std::sqrt((a + b) / 2 - root)}}},
    };
  }

  std::map<std::string, CountedModes>
  other_kinds()
  {
    const std::string points = "displacement 1, displacement 2, displacement 3";
    return {
      {"rolling disc",
       {with_body(0.2,
                  joint_of("rolling disc",
                           " set Body A = ground\n set Body B = b\n set Axle = 1, 0, 0.2\n set Radius = 0.2\n"),
                  "",
                  false),
        3}},
      {"rolling ball",
       {with_body(0.2, joint_of("rolling ball", " set Body A = ground\n set Body B = b\n" + ball_of_02), "", false),
        3}},
      {"knife edge", {with_body(0, joint_of("knife edge", " set Body A = ground\n set Body B = b\n"), "", false), 5}},
      {"support of an edge: a hinge", {with_plate(clamped_body + held("s.edge u0", points)), 1}},
      {"support of a point: a ball joint", {with_plate(clamped_body + held("s.at 0.5 0.5", points)), 3}},
      {"support of all edges from below", {with_plate(clamped_body + held("s.boundary", "displacement 3")), 3}},
      {"support that clamps", {with_plate(clamped_body + held("s.edge u0", "all")), 0}},
      {"distributing, both free", {with_plate(joint_of("distributing", of_edge)), 6}},
      {"distributing, the body held", {with_plate(clamped_body + joint_of("distributing", of_edge)), 0}},
      {"distributing, an edge supported",
       {with_plate(joint_of("distributing", of_edge) +
                   " subsection root\n set Type = support\n set Along = s.edge u0\n"
                   " set Fixed = " +
                   points + "\n end\n"),
        1}},
    };
  }

  /** Two wheels of 2 kg m² that turn about one axis, and the play of 0.02 rad between them. */
  std::string
  wheels(const std::string &of_A, const std::string &of_B, const std::string &loads)
  {
    std::string bodies, hinges;
    for (const auto &[name, motion] : {std::pair(std::string("A"), of_A), {"B", of_B}})
      {
        bodies += " subsection " + name + "\n set Type = rigid body\n set Mass = 1\n set Inertia = 1, 1, 2\n end\n";
        hinges += " subsection hinge " + name + "\n set Type = revolute\n set Body A = ground\n set Body B = " + name +
                  "\n set Axis = 0, 0, 1\n subsection rotation\n" + motion + " end\n end\n";
      }
    return "subsection Bodies\n" + bodies + "end\nsubsection Joints\n" + hinges +
           " subsection teeth\n set Type = gear\n set Joint A = hinge A\n set Joint B = hinge B\n set Ratio = -1\n"
           " set Backlash = 0.02\n set Mesh stiffness = 100\n end\nend\n" +
           loads;
  }

  void
  expect_modes(const std::string &name, const CountedModes &expected)
  {
    SCOPED_TRACE(name);
    Scene scene("set Analyses = " + std::string(expected.is_loaded ? "static, modal" : "modal") + "\n" + expected.text);
    if (expected.is_loaded)
      scene.equilibrium();
    unsigned int        n_free = 0;
    std::vector<double> found;
    for (const Mode &mode : scene.modes())
      if (mode.frequency() < 1e-3)
        ++n_free;
      else
        found.push_back(mode.frequency());
    EXPECT_EQ(n_free, expected.n_free);
    std::sort(found.begin(), found.end());
    auto wanted = expected.frequencies;
    std::sort(wanted.begin(), wanted.end());
    if (!wanted.empty())
      {
        EXPECT_EQ(found.size(), wanted.size());
      }
    for (unsigned int i = 0; i < std::min(wanted.size(), found.size()); ++i)
      EXPECT_NEAR(found[i] / wanted[i], 1, 1e-3);
  }
} // namespace



TEST(ModesOfContacts, CountMotionsOfWhatTouches)
{
  for (const auto &[name, expected] : touching_kinds())
    expect_modes(name, expected);
}



TEST(ModesOfContacts, AtNearestPlaces)
{
  for (const auto &[name, expected] : at_nearest_places())
    expect_modes(name, expected);
}



TEST(ModesOfContacts, CountMotionsOfWhatRollsAndOfEdges)
{
  for (const auto &[name, expected] : other_kinds())
    expect_modes(name, expected);
}



// Within the play two wheels are free of each other; on a flank the mesh is a spring between them.
TEST(ModesOfContacts, GearWithBacklash)
{
  const std::string torque       = "subsection Loads\n subsection torque\n set Type = point load\n set At = B\n"
                                   " set Moment = 0, 0, 3\n end\nend\n";
  const auto        without_sign = [](const std::string &text, const double frequency) {
    return CountedModes{text, 0, {frequency}, true};
  };
  expect_modes("apart", {wheels("", "", ""), 2});
  expect_modes("apart, on a spring",
               without_sign(wheels(" set Prescribed = 0\n", " set Spring = 50\n", ""), std::sqrt(50 / 2.)));
  expect_modes("touching",
               without_sign(wheels(" set Prescribed = 0\n", " set Spring = 50\n", torque), std::sqrt(150 / 2.)));
}



// A single friction with bristles in a joint: what it holds swings on them.
TEST(ModesOfContacts, BristlesOfAJoint)
{
  expect_modes("bristles",
               {with_body(0,
                          joint_of("prismatic",
                                   " set Body A = ground\n set Body B = b\n set Axis = 1, 0, 0\n subsection "
                                   "displacement\n set Friction = 0.3\n set Friction preload = 10\n"
                                   " set Bristle stiffness = 50\n end\n"),
                          "",
                          false),
                1, // the state of the bristle
                {5}});
}
