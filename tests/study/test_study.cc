// Parameter studies as a user runs them: orders equal the theory, members fail alone, what is finished is kept, and the
// cheapest level is found. The members run in processes of their own.

#include <samara/base/interrupt.h>
#include <samara/program/program.h>
#include <samara/study/study.h>

#include "../output/scratch_folder.h"
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <sstream>

using namespace samara;

namespace
{
  const std::string models = SAMARA_SOURCE_DIR "/prm/benchmarks/";

  /** A study in a folder of its own. */
  struct Case
  {
    ScratchFolder      folder;
    Program            program = execute;
    std::ostringstream said;

    std::string
    file() const
    {
      return folder.path + "/study.prm";
    }

    void
    write(const std::string &text) const
    {
      std::ofstream(file()) << "set Analyses = study\n" << text;
    }

    /** Run it; returns its members with their results. */
    std::vector<StudyMember>
    run(const std::string &results = "results", const unsigned int n_jobs = 1)
    {
      Log   log(said);
      Study study(file(), InputFile(file()));
      study.run(folder.path + "/" + results, n_jobs, program, log);
      return study.members;
    }

    std::string
    result(const std::string &name) const
    {
      return content_of(folder.path + "/results/" + name);
    }

    /** A program that does @p before each time, and then what the real one does. */
    void
    wrap(const std::function<void(const Options &)> &before)
    {
      program = [before](const Options &options) {
        before(options);
        return execute(options);
      };
    }

    /** One more line in the file `calls`. */
    void
    count_call() const
    {
      std::ofstream(folder.path + "/calls", std::ios::app) << '\n';
    }

    unsigned int
    n_calls() const
    {
      const std::string calls = content_of(folder.path + "/calls");
      return std::count(calls.begin(), calls.end(), '\n');
    }
  };

  bool
  sets_five_elements(const Options &options)
  {
    return std::any_of(options.overrides.begin(), options.overrides.end(), [](const std::string &override) {
      return contains(override, "Elements = 5");
    });
  }



  /** The elastica of prm/benchmarks against the elliptic integrals, for @p values of the number of elements. */
  std::string
  elastica(const std::string &values, const std::string &methods = "", const std::string &settings = "")
  {
    return "set Model = " + models + "elastica.prm\n" +
           "subsection Study\n  set Quantity = static: beam.end.displacement z\n  set Reference = -0.8106090248815\n"
           "  set Vary = Bodies/beam/Elements\n  set Values = " +
           values + "\n" + settings + "end\n" + methods;
  }

  const std::string degrees = "subsection Methods\n  subsection p1\n    set Overrides = Bodies/beam/Degree = 1\n  end\n"
                              "  subsection p2\n    set Overrides = Bodies/beam/Degree = 2\n  end\nend\n";
} // namespace



// Beams: order 2 p in displacements. -j 2 gives the same numbers.
TEST(Study, CantileverConvergesWithOrderTwoP)
{
  Case study;
  study.write(elastica("8, 16, 32", degrees));
  const auto members = study.run();
  ASSERT_EQ(members.size(), 6u);
  EXPECT_NEAR(members[2].result.rate, 2, 0.1);
  EXPECT_NEAR(members[5].result.rate, 4, 0.1);
  EXPECT_TRUE(std::isnan(members[0].result.rate) && std::isnan(members[3].result.rate)); // nothing before them
  for (const auto &member : members)
    EXPECT_EQ(member.result.unknowns, 6 * member.number * (member.method + 1)) << member.label; // the start is clamped

  // deal.II's table has the same rates
  char rate[16];
  for (const unsigned int i : {1, 2, 4, 5})
    {
      std::snprintf(rate, sizeof rate, " %.2f ", members[i].result.rate);
      EXPECT_TRUE(contains(study.result("study.txt"), rate)) << rate << study.result("study.txt");
    }
  EXPECT_TRUE(std::filesystem::exists(study.folder.path + "/results/study.h5"));

  const auto side_by_side = study.run("parallel", 2);
  for (unsigned int i = 0; i < members.size(); ++i)
    {
      EXPECT_EQ(side_by_side[i].label, members[i].label);
      EXPECT_EQ(side_by_side[i].result.value, members[i].result.value);
      EXPECT_EQ(side_by_side[i].result.error, members[i].result.error);
    }
}



// Integrators: order 2 s with a spectral radius of 1, 2 s - 1 below; of the whole history, against a run of its own
// whose rows are at other times than those of the members.
TEST(Study, PendulumConvergesWithTheOrderOfTheIntegrator)
{
  Case study;
  study.write(
    "set Model = " + models +
    "dynamics/simple_pendulum.prm\n"
    "subsection Study\n  set Quantity = dynamic: mass.position x\n  set Norm = RMS\n"
    "  set Overrides = Dynamic/End time = 2\n  set Reference overrides = Dynamic/Stages = 3; Dynamic/Step = 0.0083\n"
    "  set Vary = Dynamic/Step\n  set Values = 0.1, 0.05, 0.025\nend\n"
    "subsection Methods\n  subsection order 4\n    set Overrides = Dynamic/Stages = 2; Dynamic/Spectral radius = 1\n"
    "  end\n  subsection order 3\n    set Overrides = Dynamic/Stages = 2; Dynamic/Spectral radius = 0\n  end\nend\n");
  const auto members = study.run();
  ASSERT_EQ(members.size(), 7u);
  EXPECT_NEAR(members[2].result.rate, 4, 0.15);
  EXPECT_NEAR(members[5].result.rate, 3, 0.15);
  EXPECT_EQ(members[6].label, "reference");
  EXPECT_TRUE(std::isnan(members[6].result.error));
  EXPECT_EQ(members[2].result.steps, 80);
}



// Without anything else to compare with, the last value of the first method is the reference, and has no error itself.
TEST(Study, FinestOfTheMembersIsTheReference)
{
  Case        study;
  std::string text = elastica("8, 16, 32");
  text.replace(text.find("-0.8106090248815"), 16, "finest");
  study.write(text);
  const auto members = study.run();
  EXPECT_NEAR(members[0].result.error, std::abs(members[0].result.value / members[2].result.value - 1), 1e-12);
  EXPECT_TRUE(std::isnan(members[2].result.error));
}



// Levels go from the coarsest to the finest: the last one of all is the reference then.
TEST(Study, FinestLevelIsTheReference)
{
  Case        study;
  std::string text = elastica("8, 16",
                              "subsection Levels\n  subsection a\n  end\n  subsection b\n  end\nend\n",
                              "  set Tolerance = 1e-3\n");
  text.replace(text.find("-0.8106090248815"), 16, "finest");
  study.write(text);
  EXPECT_EQ(Study(study.file(), InputFile(study.file())).reference_member, 3);
}



// A member that does not converge, and one that crashes: each says why, and the others arrive.
TEST(Study, MembersFailAlone)
{
  Case study;
  study.wrap([](const Options &options) {
    if (sets_five_elements(options))
      {
        std::signal(SIGSEGV, SIG_DFL);
        std::raise(SIGSEGV);
      }
  });
  study.write(elastica("4, 5",
                       "subsection Methods\n  subsection good\n  end\n  subsection bad\n"
                       "    set Overrides = Static/Iterations = 1\n    set Values = 4\n  end\nend\n"));
  const auto members = study.run();
  ASSERT_EQ(members.size(), 3u);
  EXPECT_TRUE(members[0].result.finished);
  EXPECT_LT(members[0].result.error, 1e-4);
  EXPECT_TRUE(contains(members[1].result.reason, "killed by signal 11")) << members[1].result.reason;
  EXPECT_TRUE(contains(members[2].result.reason, "no equilibrium found")) << members[2].result.reason;
  EXPECT_TRUE(contains(study.said.str(), "warning: 2 of 3 members fail"));
  EXPECT_TRUE(contains(study.result("study.txt"), "Elements = 5 fails: killed by signal 11"));
  EXPECT_TRUE(contains(study.result("study.csv"), "fails: static analysis: no equilibrium found"));
}



TEST(Study, AllMembersFailing)
{
  Case study;
  study.write(elastica("4, 5", "", "  set Overrides = Static/Iterations = 1\n"));
  const std::string complaint = complaint_of([&]() { study.run(); });
  EXPECT_TRUE(contains(complaint, "all 2 members fail; the first one: static analysis")) << complaint;
  EXPECT_THROW(study.run(), NotConverged); // exit code 3
}



// What is finished is not run again, unless its overrides or the model have changed; nor is what failed, unless it was
// the time limit, and there is more time now.
TEST(Study, KeepsWhatIsFinished)
{
  Case study;
  study.wrap([&](const Options &) { study.count_call(); });
  const std::string model = study.folder.path + "/model.prm";
  std::filesystem::copy_file(models + "elastica.prm", model);
  const auto write = [&](const std::string &values, const std::string &settings) {
    std::string text = elastica(values, "", settings);
    text.replace(text.find(models + "elastica.prm"), models.size() + 12, "model.prm");
    study.write(text);
  };
  write("4, 5", "");
  const auto first = study.run();
  EXPECT_EQ(study.n_calls(), 2u);
  const auto again = study.run();
  EXPECT_EQ(study.n_calls(), 2u);
  EXPECT_EQ(again[1].result.error, first[1].result.error);
  EXPECT_EQ(again[1].result.cpu_seconds, first[1].result.cpu_seconds);

  write("4, 5, 6", "");
  study.run();
  EXPECT_EQ(study.n_calls(), 3u);

  std::filesystem::remove(study.folder.path + "/results/members/model_5/summary.csv");
  study.run();
  EXPECT_EQ(study.n_calls(), 4u);

  write("4", "  set Overrides = Bodies/beam/Degree = 2\n");
  EXPECT_NE(study.run()[0].result.value, first[0].result.value);
  EXPECT_EQ(study.n_calls(), 5u);

  std::ofstream(model, std::ios::app) << "subsection Static\n  set Load steps = 2\nend\n";
  study.run();
  EXPECT_EQ(study.n_calls(), 6u);

  std::ofstream(model, std::ios::app) << "\n# only a comment\n";
  study.run();
  EXPECT_EQ(study.n_calls(), 6u);
}



// What a model says is also what stands in the files that it names: as a whole entry, or in an expression.
TEST(Study, RunsAgainWhereTablesHaveChanged)
{
  Case study;
  study.wrap([&](const Options &) { study.count_call(); });
  const auto write = [&](const std::string &file, const std::string &text) {
    std::ofstream(study.folder.path + "/" + file) << text;
  };
  const std::string stiffness = ",1e6,1e6,1,1,1,1,1,1\n";
  const auto        strip     = [&](const std::string &EA) {
    write("strip.csv", "x,EA,GA2,GA3,GJ,EI2,EI3,mass,I2,I3\n0," + EA + stiffness + "1," + EA + stiffness);
  };
  std::string text = content_of(models + "elastica.prm");
  const auto  cut  = [&](const std::string &from, const std::string &to, const std::string &by) {
    const auto at = text.find(from);
    text.replace(at, text.find(to, at) - at, by);
  };
  cut("set Type = engineering", "  end", "set Type = table\n    set File = strip.csv\n");
  cut("-alpha", "\n", "table(\"force.csv\", 1 s)");
  write("model.prm", text);
  write("force.csv", "time [s], force [N]\n0, -1\n2, -1\n");
  strip("1e6");
  std::string settings = elastica("4");
  settings.replace(settings.find(models), models.size() + 12, "model.prm");
  study.write(settings);

  const double soft = study.run()[0].result.value;
  EXPECT_EQ(study.run()[0].result.value, soft);
  EXPECT_EQ(study.n_calls(), 1u);
  write("force.csv", "time [s], force [N]\n0, -2\n2, -2\n");
  EXPECT_LT(study.run()[0].result.value, 1.2 * soft);
  EXPECT_EQ(study.n_calls(), 2u);
  strip("2e6");
  study.run();
  EXPECT_EQ(study.n_calls(), 3u);
}


TEST(Study, MoreTimeForWhatRanOutOfIt)
{
  Case study;
  study.wrap([&](const Options &) {
    study.count_call();
    if (!std::filesystem::exists(study.folder.path + "/quick"))
      sleep(60);
  });
  study.write(elastica("4", "", "  set Time limit = 0.2\n"));
  for (unsigned int i = 0; i < 2; ++i)
    EXPECT_EQ(complaint_of([&]() { study.run(); }), "the only member fails: time limit of 0.2 s");
  EXPECT_EQ(study.n_calls(), 1u);
  std::ofstream(study.folder.path + "/quick") << "";
  study.write(elastica("4", "", "  set Time limit = 300\n"));
  EXPECT_TRUE(study.run()[0].result.finished);
  EXPECT_EQ(study.n_calls(), 2u);
}



// Ctrl-C in the second member: the first one stays, the second is done anew.
TEST(Study, GoesOnAfterAnInterruption)
{
  Case study;
  study.wrap([&](const Options &options) {
    study.count_call();
    if (sets_five_elements(options))
      {
        kill(getppid(), SIGINT);
        sleep(60);
      }
  });
  study.write(elastica("4, 5, 6"));
  EXPECT_THROW(study.run(), Interrupted);
  EXPECT_EQ(study.n_calls(), 2u);
  study.wrap([&](const Options &) { study.count_call(); });
  const auto members = study.run();
  EXPECT_EQ(study.n_calls(), 4u);
  for (const auto &member : members)
    EXPECT_TRUE(member.result.finished);
}



// Levels p = 1, 2, 3: the first misses the tolerance with all its meshes, the others meet it with one; by unknowns p =
// 3 with 4 elements (72) is cheaper than p = 2 with 16 (192).
TEST(Study, LadderPicksTheCheapestLevel)
{
  Case study;
  study.write(
    elastica("4, 16, 32",
             "subsection Levels\n  subsection p1\n    set Overrides = Bodies/beam/Degree = 1\n    set Values = 16, 32\n"
             "  end\n  subsection p2\n    set Overrides = Bodies/beam/Degree = 2\n  end\n"
             "  subsection p3\n    set Overrides = Bodies/beam/Degree = 3\n  end\nend\n",
             "  set Tolerance = 1e-3\n  set Cost = unknowns\n"));
  study.run("results", 2);
  EXPECT_TRUE(contains(study.result("study.txt"), "The cheapest level that meets the tolerance: p3, Elements = 4\n"))
    << study.result("study.txt");
  const std::string ladder = study.result("study_ladder.csv");
  EXPECT_TRUE(contains(ladder, "\np1,Elements = 32,")) << ladder;
  EXPECT_TRUE(contains(ladder, ",192,0.001,misses\np2,Elements = 16,")) << ladder;
  EXPECT_TRUE(contains(ladder, ",192,0.001,meets\np3,Elements = 4,")) << ladder;
  EXPECT_TRUE(contains(ladder, ",72,0.001,cheapest\n")) << ladder;

  std::string text = content_of(study.file());
  text.replace(text.find("Tolerance = 1e-3"), 16, "Tolerance = 1e-9");
  std::ofstream(study.file()) << text;
  study.run("results");
  EXPECT_TRUE(contains(study.result("study.txt"), "No level meets the tolerance.\n"));
}



// Several entries with one list of values; an override that changes what a body is: the beam's own entries are then
// forgotten, and those of the rigid body are new.
TEST(Study, OverridesReachEverything)
{
  Case study;
  study.write(
    "set Model = " + models +
    "uniform_load.prm\nsubsection Study\n  set Quantity = dynamic: beam.centre.displacement z\n"
    "  set Reference = -9.80665/2\n  set Vary = Dynamic/Step; Dynamic/End time\n  set Values = 0.5, 0.25; 1, 1\n"
    "  set Overrides = Analyses = dynamic; Bodies/beam/Type = rigid body; Bodies/beam/Mass = 3; "
    "Bodies/beam/Inertia = 1, 1, 1; Joints/clamp/Type = prismatic; Joints/clamp/Axis = 0, 0, 1; "
    "Joints/clamp/Body B = beam.centre; Loads/weight/Type = gravity\nend\n");
  // a number, not an expression, is a reference
  EXPECT_TRUE(contains(complaint_of([&]() { study.run(); }), "<-9.80665/2> is not a number"));
  std::string text = content_of(study.file());
  text.replace(text.find("-9.80665/2"), 10, "-4.903325");
  std::ofstream(study.file()) << text;
  for (const auto &member : study.run())
    EXPECT_LT(member.result.error, 1e-12) << member.label; // free fall along the slide
}
