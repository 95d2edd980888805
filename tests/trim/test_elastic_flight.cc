/*
 * Problem:   trim of the SA 330's rotor in flight with elastic blades, few stations and steps
 * Reference: the same rotor with rigid blades, and the controls of the public deck, 13.45, 2.17 and -7.16 degrees,
 * which belong to a disk that flaps against its shaft by an angle that is not given (doc/applications/puma_trim.md)
 */

#include <samara/analysis/trim.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>

using namespace samara;

namespace
{
  /** Controls in degrees: collective, cosine, sine; turns. */
  struct Flight
  {
    double collective, cosine, sine, turns;

    explicit Flight(const std::string &model)
    {
      Scene scene(model, {"Subsystems/blade/Surfaces/blade/Stations = 1", "Trim/Steps = 24", "Trim/Tolerance = 1e-6"});
      auto &trim = scene.analysis<TrimAnalysis>();
      trim.run(scene.context);
      const auto &found = trim.report.controls;
      collective        = found.at(0) * 180 / M_PI;
      cosine            = found.at(1) * 180 / M_PI;
      sine              = found.at(2) * 180 / M_PI;
      turns             = trim.report.turns;
    }
  };
} // namespace



// Blades that bend and twist need a little more collective and less lateral cyclic, which is the way to the deck's;
// they cone outside of the hinge. No first harmonics of flapping leave less longitudinal cyclic than the deck's disk
// has.
TEST(ElasticFlight, ControlsBesideRigidBladesAndTheDeck)
{
  const Flight elastic("prm/rotorcraft/puma_elastic_flight.prm"), rigid("prm/rotorcraft/puma_flight.prm");
  EXPECT_LE(elastic.turns, 20);
  EXPECT_NEAR(elastic.collective, 13.45, 1.2);
  EXPECT_NEAR(elastic.cosine, 2.17, 0.6);
  EXPECT_GT(elastic.sine, -7.16 + 1.5);
  EXPECT_GT(elastic.collective, rigid.collective);
  EXPECT_NEAR(elastic.collective, rigid.collective, 0.6);
  EXPECT_LT(elastic.cosine, rigid.cosine - 0.3);
  EXPECT_GT(elastic.cosine, rigid.cosine - 1.0);
  EXPECT_NEAR(elastic.sine, rigid.sine, 0.5);
}
