// Adaptive steps in air: states of inflow and airfoils count, so that loads at the end of a run follow the tolerance
// even where nothing moves that a step could be wrong about.
//
// Reference: the same model with fine fixed steps of three stages (self).

#include <samara/analysis/dynamic.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include "models.h"

using namespace samara;
using namespace samara::aero_models;

namespace
{
  /** Two blades with an angle of 8 degrees that turn at 30 rad/s, driven; nothing is free to move. Air that is at rest
   * at the start, as after a step of the collective angle, is set in motion by them. */
  std::string
  rotor_that_starts(const std::string &inflow, const std::string &unsteady)
  {
    return "subsection Bodies\n" + turning_hub("rotor") + "end\nsubsection Joints" + driven_shaft("rotor") + "end\n" +
           airfoils() +
           subsection("Aerodynamics",
                      air("0, 0, -1") + subsection("flow",
                                                   "    set Type = " + inflow +
                                                     "\n    set Hub = ground\n    set Axis = 0, 0, 1\n"
                                                     "    set Radius = 3\n")) +
           subsection("Surfaces",
                      subsection("blade 1",
                                 "    set Body = rotor\n    set Line = 0.5, 0, 0; 3, 0, 0\n"
                                 "    set Leading edge = 0, 1, 0\n    set Chord = 0.2\n    set Twist = 8 deg\n"
                                 "    set Airfoils = plain\n    set Inflow = flow\n    set Unsteady = " +
                                   unsteady + "\n") +
                        subsection("blade 2",
                                   "    set Body = rotor\n    set Line = -0.5, 0, 0; -3, 0, 0\n"
                                   "    set Leading edge = 0, -1, 0\n    set Chord = 0.2\n    set Twist = 8 deg\n"
                                   "    set Airfoils = plain\n    set Inflow = flow\n    set Unsteady = " +
                                     unsteady + "\n"));
  }

  /** A stiff wing that is driven through the air with 30 m/s, and meets gusts at a reduced frequency of 0.13. */
  std::string
  wing_in_gusts(const std::string &unsteady)
  {
    return R"(
subsection Bodies
  subsection wing
    set Type     = rigid body
    set Mass     = 5
    set Inertia  = 1, 1, 2
    set Velocity = 30, 0, 0
  end
end
subsection Joints
  subsection drive
    set Type   = prismatic
    set Body A = ground
    set Body B = wing.centre
    set Axis   = 1, 0, 0
    subsection displacement
      set Prescribed = 30*t
    end
  end
end
)" + airfoils() +
           subsection("Aerodynamics", air("0, 0, 3*sin(40*t)")) +
           subsection("Surfaces",
                      subsection("wing",
                                 "    set Body = wing\n    set Line = 0, -1, 0; 0, 1, 0\n"
                                 "    set Leading edge = 1, 0, 0\n    set Chord = 0.2\n    set Twist = 8 deg\n"
                                 "    set Airfoils = full\n    set Unsteady = " +
                                   unsteady + "\n"));
  }

  struct AdaptiveRun
  {
    double                  value; ///< of the probe at the end
    DynamicAnalysis::Report report;
    bool                    warns; ///< of states that do not count
  };

  AdaptiveRun
  run_of(const std::string &model, const std::string &probe, const double T, const std::string &entries)
  {
    Scene scene(model + "set Analyses = dynamic\nsubsection Dynamic\n set End time = " + std::to_string(T) + "\n" +
                entries + "end\n");
    auto &dynamic = scene.analysis<DynamicAnalysis>();
    State reported; // with velocities that obey the drive
    dynamic.observer = [&](const State &state) { reported = state; };
    dynamic.start(scene.context);
    dynamic.run(scene.context);
    return {scene.input.model.probe(probe).value(reported),
            dynamic.report,
            scene.stream.str().find("not count") != std::string::npos};
  }

  /** Errors at the end over tolerance and @p size below @p most, and more steps for smaller tolerances. */
  void
  expect_what_the_tolerance_says(const std::string              &model,
                                 const std::string              &probe,
                                 const double                    T,
                                 const double                    size,
                                 const double                    most,
                                 const std::vector<std::string> &tolerances)
  {
    const double exact =
      run_of(model,
             probe,
             T,
             " set Step = " + std::to_string(T / 800) + "\n set Stages = 3\n set Newton tolerance = 1e-12\n")
        .value;
    for (const auto &[stages, radius] : {std::pair("2", "0.5"), {"3", "0"}, {"2", "1"}})
      {
        unsigned int n_before    = 0;
        double       first_error = 0, last_error = 0;
        for (const std::string &tolerance : tolerances)
          {
            SCOPED_TRACE(std::string("s = ") + stages + ", rho = " + radius + ", tolerance " + tolerance);
            const AdaptiveRun run =
              run_of(model,
                     probe,
                     T,
                     " set Step control = adaptive\n set Step = " + std::to_string(T / 20) +
                       "\n set Tolerance = " + tolerance + "\n set Stages = " + stages +
                       "\n set Newton tolerance = 1e-12\n set Spectral radius = " + radius + "\n");
            last_error = std::abs(run.value - exact) / size;
            if (n_before == 0)
              first_error = last_error;
            EXPECT_LT(last_error, most * std::stod(tolerance)) << run.report.n_steps << " steps";
            EXPECT_GE(run.report.n_steps, n_before);
            EXPECT_FALSE(run.warns);
            EXPECT_LT(run.report.error / run.report.length, std::stod(tolerance));
            n_before = run.report.n_steps;
          }
        EXPECT_LT(last_error, 0.1 * first_error); // three decades of the tolerance
      }
  }
} // namespace



// The thrust falls as the air gets going; its error is a part of this fall. The apparent mass is small, so that steps
// are decided by the inflow and not by how far blades turn.
TEST(AdaptiveInAir, ThrustOfARotorThatSetsAirInMotion)
{
  const std::string model = rotor_that_starts("uniform inflow\n    set Apparent mass = 0.05", "quasi-steady");
  const double      fall  = std::abs(run_of(model, "flow.thrust", 1e-4, " set Step = 1e-4\n").value -
                               run_of(model, "flow.thrust", 0.05, " set Step = 1e-3\n").value);
  EXPECT_GT(fall, 100.);
  expect_what_the_tolerance_says(model, "flow.thrust", 0.05, fall, 0.05, {"1e-3", "1e-4", "1e-5", "1e-6"});
}



// Lift of lags in gusts, which forget their errors.
TEST(AdaptiveInAir, LiftOfAWingInGusts)
{
  const std::string model = wing_in_gusts("two lags");
  const double      lift  = std::abs(run_of(model, "wing.force z", 0.03, " set Step = 1e-4\n").value);
  EXPECT_GT(lift, 10.);
  expect_what_the_tolerance_says(model, "wing.force z", 0.3, lift, 0.1, {"1e-2", "1e-3", "1e-4", "1e-5"});
}



// States that are of the air in all its kinds count; others are told of by name.
TEST(AdaptiveInAir, AllKindsOfStatesCount)
{
  const std::string adaptive = " set Step control = adaptive\n set Step = 1e-3\n set Tolerance = 1e-3\n";
  for (const std::string inflow :
       {"Pitt-Peters inflow",
        "Peters-He inflow\n    set Harmonics = 2\n    set Power = 4",
        "annular inflow",
        "helical wake\n    set Speed = 30\n    set Transport = 5\n    set Nodes = 2\n    set Turns = 1\n"
        "    set Segments = 8\n    set Root = 0.5"})
    for (const std::string unsteady : {"two lags", "dynamic stall"})
      {
        const AdaptiveRun run = run_of(rotor_that_starts(inflow, unsteady), "flow.thrust", 0.1, adaptive);
        EXPECT_FALSE(run.warns) << inflow << unsteady;
        EXPECT_GT(run.report.n_steps, 10u) << inflow << unsteady; // what is largest is a tenth of the run
      }
  const std::string filter = "subsection States\n subsection filter\n set Rate = (1 - filter)/(0.1 s)\n end\nend\n";
  EXPECT_TRUE(run_of(filter + wing_in_gusts("two lags"), "wing.force z", 0.01, adaptive).warns);
}



// Glauert's equation T = 2ρA V_T w holds at once where the apparent mass is next to nothing, and late where it is that
// of a disk.
TEST(AdaptiveInAir, UniformInflowWithoutApparentMass)
{
  const auto miss = [](const std::string &mass) {
    Scene scene(rotor_that_starts("uniform inflow" + mass, "quasi-steady") +
                "set Analyses = dynamic\nsubsection Dynamic\n set End time = 0.05\n set Step = 0.005\n"
                " set Spectral radius = 0\nend\n");
    scene.analysis<DynamicAnalysis>().run(scene.context);
    const auto value = [&](const std::string &probe) {
      return scene.input.model.probe(probe).value(scene.context.state);
    };
    const double w = value("flow.mean"), V = 1 + w, A = M_PI * 9, thrust = value("flow.thrust");
    return std::abs(2 * 1.225 * A * V * w - thrust) / thrust;
  };
  EXPECT_LT(miss("\n    set Apparent mass = 1e-7"), 1e-6);
  EXPECT_GT(miss(""), 0.1);
}
