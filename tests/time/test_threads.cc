// Threads change nothing but the time: sums are made in the same order.

#include <samara/base/threads.h>
#include <samara/time/stage_integrator.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <atomic>
#include <vector>

using namespace samara;

namespace
{
  /** 2000 quadratic elements, so that all loops are worth threads, bent, viscous and hinged, that begin to fall. */
  const std::string long_beams = R"(
subsection Sections
  subsection s
    set Type = rectangle
    set E = 70e9
    set Density = 2700
    set Width 2 = 0.02
    set Width 3 = 0.03
  end
end
subsection Bodies
  subsection a
    set Type = beam
    set Shape = arc
    set Points = 0, 0, 0; 5, 2, 0; 10, 0, 0
    set Elements = 1000
    set Degree = 2
    set Section = s
    set Damping = 1e-3
  end
  subsection b
    set Type = beam
    set Points = 10, 0, 0; 20, 0, 0
    set Elements = 1000
    set Degree = 2
    set Section = s
  end
end
subsection Joints
  subsection hinge
    set Type = revolute
    set Body A = a.end
    set Body B = b.start
  end
end
subsection Loads
  subsection weight
    set Type = gravity
  end
  subsection push
    set Type = point load
    set At = a.start
    set Force = 0, 5, 10
  end
end
)";

  /** After two steps. */
  State
  begun_to_fall(const unsigned int stages, const unsigned int n_threads)
  {
    set_threads(n_threads);
    const Scene     scene(long_beams);
    StageIntegrator integrator(scene.system, Tableau(stages, 0.5));
    State           state = scene.system.reference();
    for (unsigned int i = 0; i < 2; ++i)
      EXPECT_TRUE(integrator.step(state, 0.002).converged);
    return state;
  }
} // namespace



class Threads : public testing::Test
{
protected:
  void
  TearDown() override
  {
    set_threads(1);
  }
};



TEST_F(Threads, DoNotChangeAnything)
{
  for (const unsigned int stages : {1, 2, 3})
    {
      SCOPED_TRACE(stages);
      const State one = begun_to_fall(stages, 1), three = begun_to_fall(stages, 3);
      EXPECT_EQ(one.q, three.q);
      EXPECT_EQ(one.y, three.y);
      EXPECT_EQ(one.stress, three.stress);
      EXPECT_EQ(one.multipliers, three.multipliers);
    }
}



TEST_F(Threads, EveryIndexOnce)
{
  set_threads(3);
  for (const unsigned int n : {0, 1, 2, 99, 100, 1001})
    {
      std::vector<std::atomic<int>> calls(n);
      parallel_for(n, 100, [&](const unsigned int begin, const unsigned int end) {
        for (unsigned int i = begin; i < end; ++i)
          ++calls[i];
      });
      for (const auto &c : calls)
        EXPECT_EQ(c, 1);
    }
}



TEST_F(Threads, ExceptionsReachTheCaller)
{
  set_threads(3);
  EXPECT_THROW(parallel_for(1000,
                            100,
                            [](unsigned int, const unsigned int end) {
                              if (end == 1000) // one of them, however the range is divided
                                throw std::runtime_error("in a thread");
                            }),
               std::runtime_error);
}



// The real and the complex factors of three stages are made in two threads, but MUMPS does one thing at a time.
TEST_F(Threads, MumpsWithThreeStages)
{
  Scene scene(long_beams, {"Bodies/a/Elements = 200", "Bodies/b/Elements = 200"});
  ASSERT_GT(scene.system.size(), 2000u);
  set_threads(2);
  use_library(Library::mumps);
  State           state = scene.context.state;
  StageIntegrator integrator(scene.system, Tableau(3, 0.5));
  use_library(Library::automatic);
  for (unsigned int i = 0; i < 3; ++i)
    {
      integrator.forget_history();
      ASSERT_TRUE(integrator.step(state, 1e-3).converged);
    }
}
