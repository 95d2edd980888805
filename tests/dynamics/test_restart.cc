// Runs that are killed and go on from their checkpoint have the files of one that was not, byte by byte. Checkpoints of
// another model are refused with a list of what differs.

#include <samara/analysis/dynamic.h>
#include <samara/base/errors.h>

#include "../output/scratch_folder.h"
#include "../scene.h"
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

using namespace samara;

namespace
{
  /** A flexible rod on a hinge, with a rigid body hinged to its end that has a spring; both fall. */
  const std::string pendulum = R"(
set Analyses = dynamic
subsection Sections
  subsection s
    set Type = tube
    set E = 2e9
    set Density = 1000
    set Outer radius = 0.02
  end
  subsection other
    set Type = tube
    set E = 2e9
    set Density = 1000
    set Outer radius = 0.02
  end
end
subsection Bodies
  subsection rod
    set Type = beam
    set Points = 0, 0, 0; 1, 0, 0
    set Section = s
    set Elements = 2
    set Damping = 1e-4
  end
  subsection bob
    set Type = rigid body
    set Mass = 1
    set Inertia = 0.1, 0.1, 0.1
    set Position = 1, 0, 0
  end
end
subsection Joints
  subsection hinge
    set Type = revolute
    set Body A = ground
    set Body B = rod.start
    set Axis = 0, 1, 0
  end
  subsection pin
    set Type = revolute
    set Body A = rod.end
    set Body B = bob
    set Axis = 0, 1, 0
    subsection rotation
      set Spring = 3
      set Damper = 0.1
    end
  end
end
subsection Loads
  subsection g
    set Type = gravity
  end
  subsection push
    set Type = point load
    set At = rod.end
    set Force = 0, 0, t < 0.1234 ? 5 : 0
  end
end
subsection Output
  set Probes = rod.end.position x, rod.end.acceleration z, rod.start.moment 2, pin.rotation, hinge.force 1
end
subsection Dynamic
  set End time = 0.6
  set Step = 0.005
  set Pictures = 7
end
)";

  /** A plate, a shell, that a strap with the trapeze effect holds at a hinge; both swing and twist. */
  const std::string strap = R"(
set Analyses = dynamic
subsection Sections
  subsection s
    set Type = engineering constants
    set EA = 1e6
    set GA2 = 4e5
    set GA3 = 4e5
    set GJ = 2
    set EI2 = 5
    set EI3 = 40
    set Mass = 0.1
    set I2 = 1e-6
    set I3 = 1e-5
    set Trapeze coupling = 80
    set Trapeze stiffness = 0.02
  end
end
subsection Bodies
  subsection plate
    set Type = shell
    set Patches = 1 + 0.5*u, 0.2*v - 0.1, 0
    set Elements = 2, 1
    set Degree = 2
    set E = 70e9
    set Thickness = 2e-3
    set Density = 2700
    set Rigid edges = root at edge u0
  end
  subsection strap
    set Type = beam
    set Points = 0, 0, 0; 1, 0, 0
    set Section = s
    set Elements = 2
  end
end
subsection Joints
  subsection hinge
    set Type = revolute
    set Body A = ground
    set Body B = strap.start
    set Axis = 0, 1, 0
  end
  subsection seam
    set Type = rigid
    set Body A = strap.end
    set Body B = plate.root
  end
end
subsection Loads
  subsection g
    set Type = gravity
  end
  subsection push
    set Type = point load
    set At = strap.end
    set Moment = 2, 0, 0
  end
end
subsection Output
  set Probes = strap.end.position z, plate.root.angle 1, strap.start.moment 1
end
subsection Dynamic
  set End time = 0.12
  set Step = 0.002
  set Pictures = 3
end
)";

  /** Thrown in the middle of a run: what is not yet written is lost with it. */
  struct Killed
  {};

  /** A run of @p text into @p folder, ended by force at the time @p killed; every fresh start is written. */
  void
  run_until_killed(const std::string              &text,
                   const std::string              &folder,
                   const std::vector<std::string> &overrides,
                   const bool                      restart,
                   const double                    killed = 1e300,
                   const unsigned int              every  = 23)
  {
    Scene scene(text, overrides);
    scene.context.folder                = folder;
    scene.context.probes                = scene.input.make_probes();
    scene.context.restart               = restart;
    scene.context.used                  = scene.input.used();
    auto &dynamic                       = scene.analysis<DynamicAnalysis>();
    dynamic.fresh_every                 = every;
    dynamic.seconds_between_checkpoints = 0;
    dynamic.observer                    = [&](const State &state) {
      if (state.time > killed)
        throw Killed();
    };
    dynamic.start(scene.context);
    dynamic.run(scene.context);
    dynamic.finish(scene.context);
  }

  void
  expect_same_files(const std::string &a, const std::string &b, const std::string &where)
  {
    for (const std::string file : {"dynamic.csv", "dynamic_energy.csv", "dynamic_steps.csv", "dynamic.pvd"})
      EXPECT_EQ(content_of(a + "/" + file), content_of(b + "/" + file)) << file << ", " << where;
  }

  std::string
  refusal(const std::string &folder, const std::vector<std::string> &overrides, const std::string &text = pendulum)
  {
    try
      {
        run_until_killed(text, folder, overrides, true);
      }
    catch (const InputError &problem)
      {
        return problem.what();
      }
    return "";
  }
} // namespace



TEST(Restart, KilledRunsGoOnToTheLastBit)
{
  for (const std::string stages : {"1", "2", "3"})
    for (const std::string control : {"fixed", "adaptive"})
      {
        const std::vector<std::string> settings = {"Dynamic/Stages = " + stages,
                                                   "Dynamic/Step control = " + control,
                                                   stages == "1" ? "Dynamic/Spectral radius = 1" :
                                                                   "Dynamic/Spectral radius = 0.5",
                                                   "Dynamic/Tolerance = 1e-3"};
        const ScratchFolder            scratch;
        const std::string              whole = scratch.path + "/whole";
        run_until_killed(pendulum, whole, settings, false);
        for (const double killed : {0.01, 0.2, 0.55})
          {
            const std::string folder = scratch.path + "/" + std::to_string(killed);
            const std::string where  = stages + " stages, " + control + ", killed at " + std::to_string(killed);
            EXPECT_THROW(run_until_killed(pendulum, folder, settings, false, killed), Killed) << where;
            EXPECT_NE(content_of(whole + "/dynamic.csv"), content_of(folder + "/dynamic.csv")) << where;
            run_until_killed(pendulum, folder, settings, true);
            expect_same_files(whole, folder, where);
          }
      }
}



// The section of the strap has stresses that are not linear in strains; the shell has factors of another kind.
TEST(Restart, OfAShellOnAStrapWithTheTrapezeEffect)
{
  for (const std::string control : {"fixed", "adaptive"})
    {
      const std::vector<std::string> settings = {"Dynamic/Stages = 1",
                                                 "Dynamic/Spectral radius = 1",
                                                 "Dynamic/Step control = " + control,
                                                 "Dynamic/Tolerance = 1e-3"};
      const ScratchFolder            scratch;
      const std::string              whole = scratch.path + "/whole", folder = scratch.path + "/folder";
      run_until_killed(strap, whole, settings, false);
      EXPECT_THROW(run_until_killed(strap, folder, settings, false, 0.07), Killed);
      run_until_killed(strap, folder, settings, true);
      expect_same_files(whole, folder, control);
    }
}



TEST(Restart, KilledAgainAndAgain)
{
  const ScratchFolder scratch;
  const std::string   whole = scratch.path + "/whole", folder = scratch.path + "/folder";
  run_until_killed(pendulum, whole, {}, false);
  EXPECT_THROW(run_until_killed(pendulum, folder, {}, false, 0.3), Killed);
  for (const double killed : {0.35, 0.36, 0.5})
    EXPECT_THROW(run_until_killed(pendulum, folder, {}, true, killed), Killed);
  run_until_killed(pendulum, folder, {}, true);
  expect_same_files(whole, folder, "killed four times");
}



TEST(Restart, FinishedRunsGoOnBeyondTheirEnd)
{
  // the largest adaptive step and the time for which the tolerance holds follow the end unless they are given
  for (const std::string control : {"fixed", "adaptive"})
    {
      const std::vector<std::string> settings = {"Dynamic/Step control = " + control,
                                                 "Dynamic/Largest step = 0.02",
                                                 "Dynamic/Tolerance holds for = 0.6",
                                                 "Dynamic/Tolerance = 1e-3",
                                                 "Output/Pictures = false"};
      auto                           shorter  = settings;
      shorter.push_back("Dynamic/End time = 0.3331");
      const ScratchFolder scratch;
      const std::string   whole = scratch.path + "/whole", folder = scratch.path + "/folder";
      run_until_killed(pendulum, whole, settings, false);
      run_until_killed(pendulum, folder, shorter, false);
      run_until_killed(pendulum, folder, settings, true);
      for (const std::string file : {"dynamic.csv", "dynamic_energy.csv", "dynamic_steps.csv"})
        EXPECT_EQ(content_of(whole + "/" + file), content_of(folder + "/" + file)) << file << ", " << control;
    }
}



TEST(Restart, OtherModelsAreRefused)
{
  const ScratchFolder folder;
  EXPECT_THROW(run_until_killed(pendulum, folder.path, {}, false, 0.3), Killed);
  const std::string before = content_of(folder.path + "/dynamic.csv");
  for (const auto &[entry, value] : {std::make_pair("Sections/s/E", "3e9"),
                                     {"Bodies/bob/Mass", "2"},
                                     {"Bodies/bob/Position", "1, 0, 0.1"},
                                     {"Bodies/rod/Elements", "3"},
                                     {"Bodies/rod/Degree", "2"},
                                     {"Bodies/rod/Damping", "0"},
                                     {"Bodies/rod/Section", "other"},
                                     {"Joints/pin/Axis", "1, 0, 0"},
                                     {"Joints/pin/rotation/Spring", "4"},
                                     {"Loads/g/Acceleration", "0, 0, -1"},
                                     {"Loads/push/Force", "0, 0, t"},
                                     {"Dynamic/Start time", "0.01"}})
    {
      const std::string complaint = refusal(folder.path, {std::string(entry) + " = " + value});
      EXPECT_NE(complaint.find("belongs to another model"), std::string::npos) << entry << ": " << complaint;
      EXPECT_NE(complaint.find(std::string(entry) + ": "), std::string::npos) << complaint;
    }
  EXPECT_EQ(content_of(folder.path + "/dynamic.csv"), before);
}



TEST(Restart, ContentsOfTablesBelongToTheModel)
{
  const ScratchFolder folder;
  const std::string   table = folder.path + "/blade.csv";
  std::filesystem::create_directories(folder.path);
  const auto write = [&](const std::string &E) {
    std::ofstream(table) << "x,EA,GA2,GA3,GJ,EI2,EI3,mass,I2,I3\n0,1e6,1e6,1e6,100,100,100,1,1e-3,1e-3\n"
                         << "1,1e6,1e6,1e6,100," << E << ",100,1,1e-3,1e-3\n";
  };
  std::string       text = pendulum;
  const std::string tube = "set Type = tube\n    set E = 2e9\n    set Density = 1000\n    set Outer radius = 0.02\n";
  text.replace(text.find(tube),
               tube.size(),
               "set Type = table\n    set File = " + std::filesystem::absolute(table).string() + "\n");
  write("100");
  EXPECT_THROW(run_until_killed(text, folder.path, {}, false, 0.3), Killed);
  write("101");
  const std::string complaint = refusal(folder.path, {}, text);
  EXPECT_NE(complaint.find("Sections/s/line 3 of the file"), std::string::npos) << complaint;
  write("100");
  EXPECT_EQ(refusal(folder.path, {}, text), "");
}



// So do those of tables in expressions, and of all other files that a model names.
TEST(Restart, ContentsOfFilesInExpressionsBelongToTheModel)
{
  const ScratchFolder folder;
  const std::string   table = folder.path + "/push.csv";
  std::filesystem::create_directories(folder.path);
  const auto write = [&](const std::string &force) {
    std::ofstream(table) << "time [s], force [N]\n0, 0\n9, " << force << "\n";
  };
  const std::string text = pendulum + "subsection States\n  subsection z\n    set Rate = table(\"" +
                           std::filesystem::absolute(table).string() + "\", t) / (1 N s)\n  end\nend\n";
  write("1");
  EXPECT_THROW(run_until_killed(text, folder.path, {}, false, 0.3), Killed);
  write("2");
  const std::string complaint = refusal(folder.path, {}, text);
  EXPECT_NE(complaint.find("Contents of " + std::filesystem::absolute(table).string()), std::string::npos) << complaint;
  write("1");
  EXPECT_EQ(refusal(folder.path, {}, text), "");
}



TEST(Restart, HarmlessChangesAreTold)
{
  const ScratchFolder folder;
  EXPECT_THROW(run_until_killed(pendulum, folder.path, {}, false, 0.3), Killed);
  Scene scene(pendulum, {"Dynamic/End time = 0.4", "Dynamic/Stages = 1", "Title = New"});
  scene.context.folder  = folder.path;
  scene.context.probes  = scene.input.make_probes();
  scene.context.restart = true;
  scene.context.used    = scene.input.used();
  scene.analysis<DynamicAnalysis>().run(scene.context);
  for (const std::string line :
       {"Dynamic/End time: 0.6 before, 0.4 now", "Dynamic/Stages: 3 before, 1 now", "Title: nothing before"})
    EXPECT_NE(scene.stream.str().find(line), std::string::npos) << scene.stream.str();
}



TEST(Restart, TablesMustHaveTheirRows)
{
  for (const std::string table : {"dynamic.csv", "dynamic_energy.csv", "dynamic_steps.csv"})
    {
      const ScratchFolder folder;
      EXPECT_THROW(run_until_killed(pendulum, folder.path, {}, false, 0.4), Killed);
      const std::string file = folder.path + "/" + table, text = content_of(file);
      // without its fourth line
      std::size_t begin = 0;
      for (unsigned int i = 0; i < 3; ++i)
        begin = text.find('\n', begin) + 1;
      std::ofstream(file, std::ios::binary) << text.substr(0, begin) + text.substr(text.find('\n', begin) + 1);
      const std::string complaint = refusal(folder.path, {});
      EXPECT_NE(complaint.find(table + " has "), std::string::npos) << complaint;
      EXPECT_NE(complaint.find("not the"), std::string::npos) << complaint;
      std::filesystem::remove(file);
      EXPECT_NE(refusal(folder.path, {}).find(table + " has 0 rows"), std::string::npos);
    }
}
