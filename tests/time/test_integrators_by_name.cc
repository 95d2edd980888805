// Integrators are what the catalogue says: one that is added there can be named in a model, and is told of in the
// entry.

#include <samara/analysis/dynamic.h>

#include <sstream>

#include "systems.h"

using namespace samara;

namespace
{
  /** Nothing moves, whatever pushes. */
  class Rest : public Integrator
  {
  public:
    Rest(const System &, const IntegratorSettings &)
    {}

    StepResult
    step(State &state, const double h) override
    {
      std::fill(state.y.begin(), state.y.end(), 0.);
      state.time += h;
      ++n_steps;
      StepResult result;
      result.converged = true;
      return result;
    }
  };
} // namespace



TEST(Integrators, AreThoseOfTheCatalogue)
{
  Catalogue catalogue;
  catalogue.integrators->add<Rest>("rest", "for a test");
  const auto analysis = catalogue.analyses.make("dynamic");
  auto      &dynamic  = dynamic_cast<DynamicAnalysis &>(*analysis);
  Parameters parameters("Dynamic", "analysis");
  dynamic.add_parameters(parameters);
  std::ostringstream text;
  parameters.document(text);
  EXPECT_NE(text.str().find("rest: for a test"), std::string::npos) << text.str();

  Scene scene(
    systems::model(systems::rigid_body("a", systems::offset + systems::moving("0.3, -0.5, 1", "1, 2, -1.5")), ""));
  dynamic.integrator     = "rest";
  dynamic.end_time       = 0.1;
  dynamic.step           = 0.01;
  dynamic.energy_balance = "warn";
  dynamic.run(scene.context);
  EXPECT_EQ(dynamic.effort()->steps, 10);
  EXPECT_EQ(scene.context.state.position(1), scene.system.reference().position(1));

  dynamic.integrator = "of nobody";
  EXPECT_THROW(dynamic.run(scene.context), InputError);
}
