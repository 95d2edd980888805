#ifndef samara_tests_floquet_models_h
#define samara_tests_floquet_models_h

#include <string>

namespace samara
{
  /** Shipped models. */
  namespace floquet_models
  {
    const std::string pendulum = "prm/examples/floquet/mathieu_pendulum.prm",
                      hammond  = "prm/examples/floquet/hammond_rotor.prm",
                      shaft    = "prm/examples/floquet/unsymmetric_shaft.prm",
                      flap_lag = "prm/examples/floquet/flap_lag_forward_flight.prm",
                      blade    = "prm/examples/laws/lag_damper.prm";
  } // namespace floquet_models
} // namespace samara

#endif
