// Steps that turn far: steady rotation is an equilibrium of each of them, momentum is kept, and motion near steady
// rotation is as exact as its own frequency wants, whatever the speed (doc/theory/steady_rotation.md, "In time").
//
// Expected, from the theory: forces of an equilibrium stay what they are, to what the iteration leaves; linear momentum
// and energy to round-off; angular momentum to the order of the scheme. The models of tests/reference/rotation are
// those with which the theory was tried: with forces in the axes of the stages, the root force of the turning rod swung
// between 9934 and 14 879 N.

#include <samara/time/stage_rotation.h>

#include "systems.h"

using namespace samara;

namespace
{
  /** Largest changes of stresses and multipliers in 20 steps, relative to the largest of each, and what it took. */
  struct Changes
  {
    double       stress = 0, multiplier = 0, iterations = 0;
    unsigned int n_steps = 0;
    std::string  refusal; ///< of the step that was not
  };

  Changes
  changes_of(const System &system, const State &start, const Tableau &tableau, const double h, const double tolerance)
  {
    StageIntegrator integrator(system, tableau, tolerance);
    State           state = start;
    Changes         result;
    const auto      change = [](const std::vector<double> &now, const std::vector<double> &before) {
      double most = 1e-300, difference = 0;
      for (std::size_t i = 0; i < now.size(); ++i)
        {
          most       = std::max(most, std::abs(before[i]));
          difference = std::max(difference, std::abs(now[i] - before[i]));
        }
      return difference / most;
    };
    for (; result.n_steps < 20; ++result.n_steps)
      {
        const StepResult step = integrator.step(state, h);
        result.refusal        = step.refusal;
        if (!step.converged)
          break;
        State now = state;
        Projection(system).accelerations(now);
        result.iterations += step.iterations / 20.;
        result.stress     = std::max(result.stress, change(state.stress, start.stress));
        result.multiplier = std::max(result.multiplier, change(now.multipliers, start.multipliers));
      }
    return result;
  }

  struct TurningModel
  {
    std::string file;
    double      speed;      ///< [rad/s]
    bool        has_hinges; ///< with one stage only half a radian a step, see the page
    bool        rows_turn;  ///< the shaft's moment acts about axes of its body B, the ground here: it turns in them
  };
} // namespace



TEST(TurningSteps, KeepTheForcesOfEquilibria)
{
  const TurningModel models[] = {{"turning_rod", 30, false, false},
                                 {"rod_with_tip", 30, false, false},
                                 {"plate_skew", 10, false, true},
                                 {"flap_hinge", 30, true, false},
                                 {"articulated_rotor", 30, true, false}};
  for (const TurningModel &model : models)
    {
      SCOPED_TRACE(model.file);
      Scene       scene("tests/reference/rotation/" + model.file + ".prm");
      const State start = scene.equilibrium();
      for_all_members([&](const Tableau &tableau) {
        for (const double turn : {0.125, 0.25, 0.5, 1.})
          {
            if (model.has_hinges && tableau.s == 1 && turn > 0.5)
              continue;
            SCOPED_TRACE("a step turns by " + std::to_string(turn) + " rad");
            const Changes c = changes_of(scene.system, start, tableau, turn / model.speed, 1e-10);
            EXPECT_EQ(c.n_steps, 20u) << c.refusal;
            EXPECT_LT(c.stress, 1e-8);
            if (!model.rows_turn)
              EXPECT_LT(c.multiplier, 1e-8);
            EXPECT_LT(c.iterations, 2.6);
          }
      });
    }
}



namespace
{
  /** A hub that turns about z, and what carries a body out of line at x = 1; springs hold what is free. */
  std::string
  hub_with(const std::string &joints, const std::string &more = "", const std::string &shaft = "0, 0, 1")
  {
    using namespace systems;
    return model(
      rigid_body("hub",
                 "set Mass = 5\n set Inertia = 0.5, 0.6, 1\n set Position = 0.1, 0, 0\n"
                 " set Frames = pivot at 0 0 0, seat at 1 0 0, up at 0.8 0 0.3, aside at 0.7 0.4 0\n") +
        rigid_body("b", second + " set Frames = root at 1 0 0, up at 1.4 0.1 0.3, aside at 1.3 0.5 0.1\n") + more,
      joint("shaft", "revolute", "set Body A = ground\n set Body B = hub.pivot\n set Axis = " + shaft + "\n") + joints,
      "  subsection r\n set Type = steady rotation\n set Joint = shaft\n set Speed = 10\n end\n");
  }

  const std::string ends = "set Body A = hub.seat\n set Body B = b.root\n set Position = 1, 0, 0\n";

  /** A body that slides outwards on the hub, until its ball touches. */
  const std::string sliding_out = systems::joint("j",
                                                 "prismatic",
                                                 ends + " set Axis = 1, 0.2, 0.3\n" +
                                                   systems::motion("displacement", systems::spring("30", "0"))),
                    ball = "set Balls = b\n set Ball radius = 0.1\n set Overlap = allowed\n set Stiffness = 2e4\n";
} // namespace



TEST(TurningSteps, KeepTheForcesOfAllJoints)
{
  using namespace systems;
  const std::pair<std::string, std::string> models[] = {
    {"revolute",
     hub_with(
       joint("j", "revolute", ends + " set Axis = 0, 1, 0.2\n" + motion("rotation", spring("300", "0", "0.4"))))},
    {"revolute about a slanted shaft",
     hub_with(joint("j", "revolute", ends + " set Axis = 0, 1, 0.2\n" + motion("rotation", spring("300", "0", "0.4"))),
              "",
              "0.3, -0.2, 1")},
    {"universal",
     hub_with(joint("j",
                    "universal",
                    ends + " set Axis = 0, 1, 0\n set Second axis = 0, 0, 1\n" +
                      motion("rotation 1", spring("300", "0", "0.2")) +
                      motion("rotation 2", spring("400", "0", "0.1"))))},
    {"universal with a twist",
     hub_with(joint("j",
                    "universal",
                    ends + " set Axis = 1, 0, 0\n set Second axis = 0, 1, 0.3\n" +
                      motion("rotation 1", spring("300", "0", "0.2")) +
                      motion("rotation 2", spring("400", "0", "0.1"))))},
    {"cylindrical",
     hub_with(joint("j",
                    "cylindrical",
                    ends + " set Axis = 1, 0.2, 0\n" + motion("displacement", spring("3000", "0", "0.1")) +
                      motion("rotation", spring("300", "0", "0.4"))))},
    {"prismatic",
     hub_with(joint(
       "j", "prismatic", ends + " set Axis = 1, 0.2, 0.3\n" + motion("displacement", spring("3000", "0", "0.1"))))},
    {"screw",
     hub_with(
       joint("j",
             "screw",
             ends + " set Axis = 1, 0.2, 0.3\n set Pitch = 0.05\n" + motion("rotation", spring("300", "0", "0.4"))))},
    {"planar",
     hub_with(joint("j",
                    "planar",
                    ends + " set Axis = 0.2, 1, 0\n" + motion("displacement 1", spring("3000", "0", "0.1")) +
                      motion("displacement 2", spring("3000", "0", "0")) +
                      motion("rotation", spring("300", "0", "0.4"))))},
    {"flexible",
     hub_with(joint("j",
                    "flexible joint",
                    ends + " set Stiffness = 3000, 4000, 5000\n"
                           " set Rotational stiffness = 200, 300, 400\n"))},
    {"spherical with rods",
     hub_with(joint("j", "spherical", ends) + joint("rod", "distance", "set Body A = hub.up\n set Body B = b.up\n") +
              joint("strut",
                    "spring",
                    "set Body A = hub.aside\n set Body B = b.aside\n" + motion("length", spring("60000", "0", "0.6"))) +
              joint("strap",
                    "spring",
                    "set Body A = hub.up\n set Body B = b.aside\n" + motion("length", spring("40000", "0", "0.75"))))},
    {"constant velocity",
     hub_with(joint("j", "constant velocity", ends + " set Axis = 1, 0.1, 0\n") +
              joint("strut",
                    "spring",
                    "set Body A = hub.aside\n set Body B = b.aside\n" + motion("length", spring("60000", "0", "0.6"))) +
              joint("strap",
                    "spring",
                    "set Body A = hub.up\n set Body B = b.aside\n" + motion("length", spring("40000", "0", "0.75"))))},
    {"ball on a plane of a group",
     hub_with(sliding_out + joint("wall", "contacts", ball + " set Planes = hub at 1.6 0 0 normal -1 0.1 0.2\n"))},
    {"ball in a tube of a group",
     hub_with(sliding_out +
              joint("wall", "contacts", ball + " set Tubes = hub at 1.2 0 0 axis 0.1 0.2 1 radius 0.4\n"))},
    {"ball on a ball of a group",
     hub_with(sliding_out + joint("wall", "contacts", ball + " set Hollow balls = hub at 1.2 0 0 radius 0.4\n"))},
    {"gears about a turning pin",
     hub_with(
       joint("j", "revolute", ends + " set Axis = 0, 1, 0.2\n") +
         joint("pin",
               "revolute",
               "set Body A = hub.seat\n set Body B = wheel.centre\n set Axis = 1, 0, 0.5\n set Position = 1, 0, 0\n" +
                 motion("rotation", spring("500", "0", "0.3"))) +
         joint("gear", "gear", "set Joint A = j\n set Joint B = pin\n set Ratio = -2\n"),
       rigid_body(
         "wheel",
         "set Mass = 1\n set Position = 1, 0, 0\n set Inertia = 0.05, 0.06, 0.07\n set Centre of mass = 0.1, 0.2, 0\n"))},
  };
  for (const auto &[name, text] : models)
    {
      SCOPED_TRACE(name);
      Scene       scene(text);
      const State start = scene.equilibrium();
      // forces of contacts are differences of places, known to round-off
      const double tolerance = scene.system.layout.contact_groups.empty() ? 1e-12 : 1e-10;
      for_all_members([&](const Tableau &tableau) {
        for (const double turn : {0.25, 0.5, 1.})
          {
            if (tableau.s == 1 && turn > 0.5)
              continue;
            SCOPED_TRACE("a step turns by " + std::to_string(turn) + " rad");
            const Changes c = changes_of(scene.system, start, tableau, turn / 10, tolerance);
            EXPECT_EQ(c.n_steps, 20u) << c.refusal;
            EXPECT_LT(c.multiplier, 1e-8);
          }
      });
    }
}



// A force that follows the body is given in its axes, and stays as it is: it is not seen in reciprocal ones.
TEST(TurningSteps, KeepTheForcesUnderLoadsThatFollow)
{
  std::ifstream     file(std::string(SAMARA_SOURCE_DIR) + "/tests/reference/rotation/turning_rod.prm");
  std::stringstream text;
  text << file.rdbuf();
  const std::string loads = "subsection Loads\n";
  std::string       with  = text.str();
  with.insert(with.find(loads) + loads.size(),
              " subsection push\n set Type = point load\n set At = rod.end\n set Axes = body\n"
              " set Force = -200 N, 0 N, 50 N\n end\n");
  Scene       scene(with);
  const State start = scene.equilibrium();
  for_all_members([&](const Tableau &tableau) {
    const Changes c = changes_of(scene.system, start, tableau, 1. / 30, 1e-11);
    EXPECT_EQ(c.n_steps, 20u) << c.refusal;
    EXPECT_LT(c.stress, 1e-8);
  });
}



// Air sees velocities and distances of the bodies, not those of the shorter triads of the stages. The shaft is driven
// by the angle that the stages of Gauss turn it by, Padé's approximation of exp(iz): with another one the speed is
// another.
TEST(TurningSteps, KeepTheForcesInAir)
{
  constexpr double speed = 30;
  for (const unsigned int s : {1, 2, 3})
    for (const double z : {0.25, 0.5, 1.})
      {
        SCOPED_TRACE("s = " + std::to_string(s) + ", a step turns by " + std::to_string(z) + " rad");
        const double half = s == 1 ? z / 2 :
                            s == 2 ? z / 2 / (1 - z * z / 12) :
                                     (z / 2 - z * z * z / 120) / (1 - z * z / 10);
        Scene        scene("tests/reference/rotation/blade_in_air.prm",
                    {"Constants/rate = " + number_to_text("%.17g", 2 * std::atan(half) / z * speed) + " rad/s"});
        const State  start = scene.equilibrium();
        for (const double rho : {1., 0.5, 0.})
          {
            const Changes c = changes_of(scene.system, start, Tableau(s, rho), z / speed, 1e-11);
            EXPECT_EQ(c.n_steps, 20u) << rho;
            EXPECT_LT(c.stress, 1e-8) << rho;
            EXPECT_LT(c.multiplier, 1e-8) << rho;
          }
      }
}



// Linear momentum of what is free is kept by every step, of each set of bodies by itself; energy, too.
TEST(TurningSteps, KeepMomentum)
{
  Scene        scene("tests/reference/rotation/thrown_rod.prm");
  MovingSystem thrown{"thrown rod", "", 0.025, 0};
  const State  start = start_of(thrown, scene.system);
  for (const unsigned int s : {1, 2, 3})
    {
      SCOPED_TRACE("s = " + std::to_string(s));
      StageIntegrator integrator(scene.system, Tableau(s, 1.), 1e-13);
      const Record    r      = run(scene.system, start, integrator, thrown.h, 2000);
      const Vector6   before = momentum_of(scene.system, start), after = momentum_of(scene.system, r.state);
      ASSERT_EQ(r.n_steps, 2000u);
      EXPECT_LT((after - before).head<3>().norm(), 1e-11 * before.head<3>().norm() * 10);
      EXPECT_NEAR(energy_of(scene.system, r.state) / energy_of(scene.system, start), 1., 1e-11 * 10);
      // angular momentum is cubic in what Gauss integrates
      const double turn = (after - before).tail<3>().norm() / before.tail<3>().norm();
      EXPECT_LT(turn, s == 1 ? 0.5 : s == 2 ? 1e-3 : 1e-5);
    }
}



TEST(TurningSteps, KeepMomentumOfJointedBodies)
{
  using namespace systems;
  for (const std::string kind : {"spherical", "revolute", "universal"})
    {
      SCOPED_TRACE(kind);
      const MovingSystem what = pair(kind, kind == "revolute" ? slanted : "");
      const Scene        scene(what.text);
      const State        start = start_of(what, scene.system);
      for_all_members([&](const Tableau &tableau) {
        const Record  r      = run(scene.system, start, tableau, what.h, 200);
        const Vector6 before = momentum_of(scene.system, start), after = momentum_of(scene.system, r.state);
        ASSERT_EQ(r.n_steps, 200u);
        EXPECT_LT(r.balance, 1e-11);
        // D p is quadratic: only stages of Gauss integrate it exactly
        if (tableau.alpha == 0)
          EXPECT_LT((after - before).head<3>().norm(), 1e-11 * before.head<3>().norm());
      });
    }
}
