#ifndef samara_time_rivals_h
#define samara_time_rivals_h

#include <samara/time/integrator.h>

#include <memory>
#include <string>
#include <vector>

namespace samara
{
  /** What the rivals can be told. */
  struct RivalSettings
  {
    double       spectral_radius  = 0.5;   ///< at infinite frequency; of generalised alpha and energy decaying
    double       newton_tolerance = 1e-10; ///< as that of StageIntegrator
    unsigned int max_iterations   = 50;
    double       tolerance        = 1e-4; ///< relative, of positions, triads and velocities; of BDF
  };



  /** Names that make_rival() knows. */
  const std::vector<std::string> &rival_names();

  /**
   * Integrators of others on the same unknowns, for comparison (doc/theory/rivals.md): "generalised alpha",
   * "trapezoidal", "energy decaying", "BDF index 2", "BDF index 1".
   *
   * Their accounts of energy: work of loads with a potential is what the potential loses; that of others, the work of
   * drives and the viscous loss are quadratures of the powers at the ends of the steps (of IDA's own steps for BDF).
   * `dissipated` is the energy that is missing then. It may be negative: a rival may gain energy.
   *
   * @throws std::invalid_argument for another name.
   */
  std::unique_ptr<Integrator> make_rival(const std::string &name, const System &system, const RivalSettings &settings);
} // namespace samara

#endif
