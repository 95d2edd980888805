#ifndef samara_tests_time_contact_motion_h
#define samara_tests_time_contact_motion_h

// Motions with contacts and friction: run, and what their energies did.

#include <samara/time/stepper.h>

#include "systems.h"

namespace samara
{
  /** Energies are relative to the largest kinetic, strain and potential energy above the least at the start. */
  struct ContactMotion
  {
    State        state;
    double       drift = 0, up = 0, viscous_loss = 0, friction_loss = 0, least_loss = 0, dissipated = 0, creep = 0;
    double       work_of_drives = 0, largest = 0;
    unsigned int n_steps = 0, n_failed = 0, n_iterations = 0, n_exact = 0;
  };

  /** From the start of a model to time @p end, with a look at each step. */
  inline ContactMotion
  contact_motion(const System                                         &system,
                 const Tableau                                        &tableau,
                 const double                                          h,
                 const double                                          end,
                 const std::function<void(const State &, StepResult)> &look      = nullptr,
                 const double                                          tolerance = 1e-13)
  {
    StageIntegrator integrator(system, tableau, tolerance);
    Stepper         stepper(system, integrator, h, 1e-9);
    ContactMotion   run;
    run.state           = start_of({"", "", 0, 0}, system);
    const double start  = total_energy(system, run.state);
    double       before = start;
    run.largest         = system.energy(run.state).kinetic;
    while (run.state.time < end)
      {
        const Advance a = stepper.advance(run.state, end);
        run.viscous_loss += a.step.viscous_loss;
        run.friction_loss += a.step.friction_loss;
        run.least_loss = std::min({run.least_loss, a.step.viscous_loss, a.step.friction_loss});
        run.dissipated += a.step.dissipated;
        run.work_of_drives += a.step.work_of_drives;
        for (const double creep : a.step.creep)
          run.creep = std::max(run.creep, creep);
        const double now = total_energy(system, run.state) + run.viscous_loss + run.friction_loss - run.work_of_drives;
        run.largest      = std::max(run.largest, system.energy(run.state).kinetic);
        run.drift        = std::max(run.drift, std::abs(now + run.dissipated - start));
        run.up           = std::max(run.up, now - before);
        before           = now;
        run.n_failed += a.n_failed;
        ++run.n_steps;
        if (look)
          look(run.state, a.step);
      }
    run.n_iterations = integrator.n_iterations;
    run.n_exact      = integrator.n_exact_steps;
    run.drift /= run.largest;
    run.up /= run.largest;
    return run;
  }

  inline std::string
  number_of(const double x)
  {
    char text[40];
    std::snprintf(text, sizeof text, "%.15g", x);
    return text;
  }

  /** A homogeneous ball of mass 1 kg. */
  inline std::string
  ball(const std::string &name, const double radius, const Vector3 &x, const Vector3 &v, const Vector3 &spin)
  {
    const auto list = [](const Vector3 &a) {
      return number_of(a(0)) + ", " + number_of(a(1)) + ", " + number_of(a(2));
    };
    const std::string J = number_of(0.4 * radius * radius);
    return systems::rigid_body(name,
                               "set Mass = 1\n set Inertia = " + J + ", " + J + ", " + J +
                                 "\n set Position = " + list(x) + "\n" + systems::moving(list(v), list(spin)));
  }
} // namespace samara

#endif
