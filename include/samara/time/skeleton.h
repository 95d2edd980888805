#ifndef samara_time_skeleton_h
#define samara_time_skeleton_h

#include <samara/time/integrator.h>
#include <samara/time/projection.h>

namespace samara
{
  /**
   * An integrator to copy; doc/how_to/integrator.md tells how. It is tested (tests/skeleton), but not in the catalogue.
   *
   * The explicit midpoint rule on the group of the nodal frames, with accelerations a from the equations of motion and
   * the constraints' second rates:
   *
   *     q½ = q exp((h/2) y),     y½ = P (y + (h/2) a(q, y))
   *     q' = q exp(h y½),        y' = P (y + h a(q½, y½))
   *
   * P projects velocities on those that the constraints allow where they are. Of second order; stable for h ω < 2 at most.
   * Errors of the constraints on positions add up: they are of second order, too. It does not find the moment of
   * corners within a step. Accounts of energy are those of samara::rivals: what is missing was dissipated, and may be
   * negative.
   */
  class ExplicitMidpoint : public Integrator
  {
  public:
    /** Of the settings it takes none. */
    ExplicitMidpoint(const System &system, const IntegratorSettings &settings);

    StepResult step(State &state, double h) override;

  private:
    const System &system;
    Projection    projection;

    /** @p start, with nodes and coordinates moved for the time @p h along @p path, by the accelerations @p a. */
    State moved(const State &start, const State &path, const std::vector<double> &a, double h) const;
  };
} // namespace samara

#endif
