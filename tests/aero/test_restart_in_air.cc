// Runs in air that are killed go on from their checkpoint to the last bit: gusts, ground, wakes, lags, dynamic stall.

#include <samara/analysis/dynamic.h>

#include "../output/scratch_folder.h"
#include "../scene.h"
#include <gtest/gtest.h>

#include "models.h"

using namespace samara;
using namespace samara::aero_models;

namespace
{
  struct KilledInAir
  {};

  /** Five fixed steps, or adaptive ones over the same time, ended by force after @p killed; the tables that were left.
   */
  std::string
  tables_of_run(const std::string &text,
                const std::string &folder,
                const std::string &control,
                const bool         restart,
                const double       killed = 1e300)
  {
    Scene scene(
      text + "subsection Output\n  set Probes = flow.thrust, flow.mean, it.force z\nend\n" +
        "set Analyses = dynamic\nsubsection Dynamic\n  set End time = 0.02\n  set Step = 0.004\n"
        "  set Stages = 2\n  set Tolerance = 1e-3\n  set Pictures = 0\n  set Inconsistent velocities = project\nend\n",
      {"Dynamic/Step control = " + control});
    scene.context.folder                = folder;
    scene.context.probes                = scene.input.make_probes();
    scene.context.restart               = restart;
    scene.context.used                  = scene.input.used();
    auto &dynamic                       = scene.analysis<DynamicAnalysis>();
    dynamic.fresh_every                 = 2;
    dynamic.seconds_between_checkpoints = 0;
    dynamic.observer                    = [&](const State &state) {
      if (state.time > killed)
        throw KilledInAir();
    };
    dynamic.start(scene.context);
    dynamic.run(scene.context);
    dynamic.finish(scene.context);
    return content_of(folder + "/dynamic.csv") + content_of(folder + "/dynamic_energy.csv");
  }

  /** An elastic blade on a free body under an inflow, with the entries of its surface, its inflow and its air. */
  std::string
  flying(const std::string &inflow, const std::string &surface, const std::string &more_air)
  {
    return blade(air("25, 3, -4", more_air) +
                   subsection("flow",
                              "    set Type = " + inflow +
                                "\n    set Hub = hub.off\n    set Axis = 0.1, 0, 1\n    set Radius = 6\n"),
                 "    set Chord = 0.3\n    set Airfoils = full\n    set Inflow = flow\n    set Stations = 2\n" +
                   surface);
  }
} // namespace



TEST(RestartInAir, GoesOnToTheLastBit)
{
  const std::string gust   = "    set Gust = 0, 0, x < 30*t - 0.1 ? 3 : 3*cos(x - 30*t)\n",
                    ground = "    set Ground = -5\n";
  for (const auto &[name, text] : std::vector<std::pair<std::string, std::string>>{
         {"gust and dynamic stall",
          flying("Pitt-Peters inflow\n    set Initial = 2", "    set Unsteady = dynamic stall\n", gust)},
         {"ground, tips and lags",
          flying("Peters-He inflow\n    set Harmonics = 2\n    set Power = 3\n    set Initial = 2\n"
                 "    set Ground effect = Cheeseman-Bennett\n    set Tip loss = Prandtl\n    set Blades = 2",
                 "    set Virtual mass = true\n",
                 ground)},
         {"wake",
          flying("helical wake\n    set Speed = 5\n    set Transport = 7\n    set Nodes = 2\n    set Turns = 1\n"
                 "    set Segments = 8\n    set Root = 0.5",
                 "    set Unsteady = quasi-steady\n",
                 gust)}})
    for (const std::string control : {"fixed", "adaptive"})
      {
        const ScratchFolder scratch;
        const std::string   whole = tables_of_run(text, scratch.path + "/whole", control, false);
        const std::string   half  = scratch.path + "/half";
        EXPECT_THROW(tables_of_run(text, half, control, false, 0.011), KilledInAir) << name << control;
        EXPECT_EQ(tables_of_run(text, half, control, true), whole) << name << ", " << control;
      }
}
