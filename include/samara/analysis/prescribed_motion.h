#ifndef samara_analysis_prescribed_motion_h
#define samara_analysis_prescribed_motion_h

#include <samara/model/system.h>

#include <string>
#include <vector>

namespace samara
{
  /** A motion that a joint prescribes and that is no part of the steady motion of a state. */
  struct PrescribedMotion
  {
    std::string name;     ///< of the joint's motion, "blade 1:pitch.rotation"; empty: there is none
    double      rate = 0; ///< the largest that was seen [rad/s, or lengths of the model per second]
  };

  /**
   * The fastest of what is prescribed at these @p times from that of the state on, beside its steady motion: the cyclic
   * pitch of a blade, a support that is shaken. Of joints that a steady rotation turns only what varies counts, as
   * their speed is the rotation's.
   */
  PrescribedMotion prescribed_beside(const System &system, const State &state, const std::vector<double> &times);

  /**
   * What to say where a joint is prescribed to turn on and on, Omega*t, and the model has no steady rotation: an
   * analysis that takes the rotor as it stands, and the load to add. Empty if there is no such joint. @p what is the
   * rest of a sentence, "these are the modes".
   */
  std::string about_stopped_rotor(const System &system, const State &state, const std::string &what);
} // namespace samara

#endif
