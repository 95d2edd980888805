// Runs of fixed steps that hardly get on: which of them are ended, and what is said.

#include <samara/base/errors.h>
#include <samara/time/stepper.h>

#include <gtest/gtest.h>

#include "systems.h"

using namespace samara;
using namespace samara::systems;

namespace
{
  /** Takes steps up to a size, of which nothing moves. */
  class Reluctant : public Integrator
  {
  public:
    explicit Reluctant(const double largest)
      : largest(largest)
    {}

    StepResult
    step(State &state, const double h) override
    {
      StepResult result;
      result.converged = h <= largest;
      if (result.converged)
        state.time += h;
      return result;
    }

  private:
    const double largest;
  };

  struct Crawl
  {
    unsigned int n_steps = 0;
    double       time    = 0;
    std::string  problem;
  };

  /** Two steps of 1 s of an integrator that takes no more than @p largest; a new stepper every 500, as in long runs. */
  Crawl
  crawl(const double largest)
  {
    const Scene scene(model(rigid_body("a", "set Mass = 2\n set Inertia = 1, 1, 1\n"),
                            joint("slide",
                                  "prismatic",
                                  "set Body A = ground\n set Body B = a.centre\n" +
                                    motion("displacement", " set Prescribed = 0.1*t\n"))));
    Reluctant   integrator(largest);
    const auto  make         = [&]() { return std::make_unique<Stepper>(scene.system, integrator, 1., 1e-12); };
    auto        stepper      = make();
    State       state        = start_of({"", "", 0, 0}, scene.system);
    state.multipliers.back() = 1e9;
    Crawl result;
    try
      {
        for (; state.time < 2 && result.n_steps < 100000; ++result.n_steps)
          {
            stepper->advance(state, 2);
            if (result.n_steps % 500 == 499)
              {
                const Stepper::Memory memory = stepper->memory();
                stepper                      = make();
                stepper->set_memory(memory, true);
              }
          }
      }
    catch (const NotConverged &error)
      {
        result.problem = error.what();
      }
    result.time = state.time;
    return result;
  }
} // namespace



// Ten thousand steps in the time of one are much, and go on; a hundred thousand do not.
TEST(Stepper, CrawlingRunsEnd)
{
  const Crawl hard = crawl(1.3e-4), hopeless = crawl(1e-5);
  EXPECT_EQ(hard.time, 2) << hard.problem;
  EXPECT_GT(hard.n_steps, 10000u);
  EXPECT_LT(hopeless.n_steps, 2200u);
  EXPECT_NE(hopeless.problem.find("2000 steps together have not come as far as 0.1 times a step of 1 s"),
            std::string::npos)
    << hopeless.problem;
  EXPECT_NE(hopeless.problem.find("the largest reaction, 1e+09 N or N m, is at joint slide (prescribed displacement)"),
            std::string::npos)
    << hopeless.problem;
  EXPECT_NE(hopeless.problem.find("beyond a dead centre"), std::string::npos) << hopeless.problem;
}
