#ifndef samara_tests_time_random_mechanisms_h
#define samara_tests_time_random_mechanisms_h

// Random mechanisms with stops, and what a run of one is judged by. A seed gives the same mechanism everywhere.

#include <samara/base/errors.h>
#include <samara/time/stepper.h>

#include "systems.h"

namespace samara
{
  class RandomMechanism
  {
  public:
    RandomMechanism(const unsigned int seed, const bool with_stops, const bool with_beams = false)
      : seed(seed)
      , with_stops(with_stops)
      , with_beams(with_beams)
    {
      const unsigned int n_bodies = 1 + number() % 5;
      for (unsigned int i = 0; i < n_bodies; ++i)
        add_body(i);
      if (uniform(0, 1) < 0.3)
        joints += systems::joint("strut",
                                 "spring",
                                 "set Body A = ground\n set Body B = " + parent + "\n" +
                                   systems::motion("length", " set Spring = " + text(uniform(0, 50)) + "\n"));
      else if (parent != "ground" && uniform(0, 1) < 0.2)
        joints += systems::joint("rod", "distance", "set Body A = ground\n set Body B = " + parent + "\n");
      n_stages = 1 + number() % 3;
      rho      = std::vector<double>{1., 0.5, 0.}[number() % 3];
      h        = std::vector<double>{0.05, 0.02, 0.005}[number() % 3];
    }

    std::string
    model() const
    {
      return "subsection Sections\n" + sections + "end\n" + systems::model(bodies, joints, systems::gravity);
    }

    std::string
    name() const
    {
      return "mechanism " + std::to_string(seed) + " with s = " + std::to_string(n_stages) + ", rho = " + text(rho) +
             ", h = " + text(h);
    }

    const unsigned int seed;
    const bool         with_stops, with_beams;
    unsigned int       n_stages = 2;
    double             rho = 1, h = 0.01;

  private:
    std::string   bodies, joints, sections, parent = "ground";
    std::uint64_t state = 0;

    /** xorshift64*: the same on all machines. */
    std::uint64_t
    number()
    {
      if (state == 0)
        state = 0x9E3779B97F4A7C15u * (seed + 1);
      state ^= state >> 12;
      state ^= state << 25;
      state ^= state >> 27;
      return (state * 0x2545F4914F6CDD1Du) >> 20;
    }
    double
    uniform(const double from, const double to)
    {
      return from + (to - from) * double(number() % (1u << 30)) / double(1u << 30);
    }
    static std::string
    text(const double x)
    {
      char buffer[40];
      std::snprintf(buffer, sizeof buffer, "%.6g", x);
      return buffer;
    }
    std::string
    vector(const double size)
    {
      const std::string x = text(uniform(-size, size)), y = text(uniform(-size, size)), z = text(uniform(-size, size));
      return x + ", " + y + ", " + z;
    }

    std::string
    motion(const std::string &name, const double reach, const double mass)
    {
      std::string entries;
      if (uniform(0, 1) < 0.3)
        entries += " set Spring = " + text(uniform(1, 100)) + "\n";
      if (uniform(0, 1) < 0.3)
        entries += " set Damper = " + text(uniform(0.01, 1)) + "\n";
      const std::string w = text(uniform(1, 10));
      if (uniform(0, 1) < 0.1)
        entries += " set Prescribed = " + text(0.5 * reach) + "*sin(" + w + "*t)\n";
      else if (uniform(0, 1) < 0.1)
        entries += std::string(name[0] == 'r' ? " set Moment = " : " set Force = ") + text(uniform(-5, 5) * mass) +
                   "*cos(" + w + "*t)\n";
      if (with_stops)
        {
          const double k = std::pow(10., uniform(2, 7)), upper = reach * uniform(0, 1),
                       lower = -reach * uniform(0.05, 1);
          entries += " set Lower stop = " + text(lower) + "\n set Upper stop = " + text(upper) +
                     "\n set Stop stiffness = " + text(k) + "\n";
          if (uniform(0, 1) < 0.5)
            entries += " set Stop damping = " + text(uniform(0.01, 2) * std::sqrt(k * mass)) + "\n";
        }
      return systems::motion(name, entries);
    }

    /** Of random slenderness, from soft as rubber to hard as steel. */
    void
    add_beam(const std::string &me, const unsigned int i)
    {
      const double EA = std::pow(10., uniform(3, 8)), EI = EA * std::pow(10., uniform(-4, -1.5)), m = uniform(0.2, 3),
                   inertia = m * EI / EA;
      sections += "  subsection s" + me + "\n set Type = engineering constants\n set EA = " + text(EA) +
                  "\n set GA2 = " + text(0.4 * EA) + "\n set GA3 = " + text(0.4 * EA) +
                  "\n set GJ = " + text(0.8 * EI) + "\n set EI2 = " + text(EI) + "\n set EI3 = " + text(2 * EI) +
                  "\n set Mass = " + text(m) + "\n set I2 = " + text(inertia) + "\n set I3 = " + text(2 * inertia) +
                  "\n end\n";
      const std::string  spin     = vector(uniform(0, 6));
      const unsigned int degree   = 1 + number() % 3;
      const unsigned int elements = 1 + number() % 4;
      bodies += "  subsection " + me + "\n set Type = beam\n set Elements = " + std::to_string(elements) +
                "\n set Degree = " + std::to_string(degree) + "\n set Section = s" + me +
                "\n set Points = " + text(0.1 + i) + ", 0, 0; " + text(1.1 + i) +
                ", 0, 0\n set Angular velocity = " + spin + "\n end\n";
    }

    void
    add_body(const unsigned int i)
    {
      const std::string me = "b" + std::to_string(i);
      if (uniform(0, 1) < 0.2)
        parent = "ground";
      const double m = std::pow(10., uniform(-1, 1)), a = 0.05 + 0.1 * uniform(0, 1), b = a * uniform(0.8, 1.2),
                   c            = a * uniform(0.8, 1.2);
      const bool        is_beam = with_beams && uniform(0, 1) < 0.5;
      const std::string ends = "set Body A = " + parent + "\n set Body B = " + me + (is_beam ? ".start" : ".centre") +
                               "\n set Position = " + text(0.1 + i) + ", 0, 0\n";
      parent = me + (is_beam ? ".end" : ".centre");
      if (is_beam)
        add_beam(me, i);
      else
        {
          const std::string velocity = vector(uniform(0, 3)), spin = vector(uniform(0, 6)), centre = vector(0.1);
          const std::string z = text(uniform(-0.3, 0.3)), y = text(uniform(-0.3, 0.3));
          bodies += systems::rigid_body(me,
                                        "set Mass = " + text(m) + "\n set Inertia = " + text(m * a) + ", " +
                                          text(m * b) + ", " + text(m * c) + "\n set Position = " + text(0.6 + i) +
                                          ", " + y + ", " + z + "\n set Centre of mass = " + centre +
                                          "\n set Angular velocity = " + spin + "\n set Velocity = " + velocity + "\n");
        }
      const std::string axis = " set Axis = " + vector(1) + "\n";
      // the motions one by one: an expression may draw its numbers in any order
      const std::string joint = "j" + std::to_string(i);
      const auto        add   = [&](const std::string &type, const std::string &entries) {
        joints += systems::joint(joint, type, ends + entries);
      };
      std::string one, two, three;
      switch (number() % 7)
        {
          case 0:
          case 1:
            return add("revolute", axis + motion("rotation", 1, 0.3 * m));
          case 2:
            return add("prismatic", axis + motion("displacement", 0.4, m));
          case 3:
            two = motion("rotation 2", 1, 0.3 * m);
            one = motion("rotation 1", 1, 0.3 * m);
            return add("universal", " set Axis = 0, 1, 0\n set Second axis = 0, 0, 1\n" + one + two);
          case 4:
            two = motion("rotation", 1, 0.3 * m);
            one = motion("displacement", 0.4, m);
            return add("cylindrical", axis + one + two);
          case 5:
            three = motion("rotation", 1, 0.3 * m);
            two   = motion("displacement 2", 0.4, m);
            one   = motion("displacement 1", 0.4, m);
            return add("planar", axis + one + two + three);
          default:
            add("spherical", "");
        }
    }
  };



  /** What the run of a mechanism did. */
  struct Course
  {
    bool                is_finished = false;
    std::string         problem;
    unsigned int        n_steps = 0, n_failed = 0, n_touches = 0, n_iterations = 0, n_factorizations = 0;
    double              balance        = 0; ///< what the account of all steps leaves, relative to the largest energy
    double              worst_step     = 0; ///< the same of the worst step
    double              worst_drive    = 0; ///< work of constraints in a step where nothing drives, relative
    double              gap            = 0; ///< of the constraints at the end [m] or [rad]
    double              least_loss     = 0; ///< of a step, damper or numerical, relative
    double              largest_energy = 0;
    std::vector<double> steps; ///< error of each step's account, relative to the largest energy at the end
  };

  inline Course
  course_of(const RandomMechanism &mechanism, const unsigned int n_steps, const double tolerance = 1e-10)
  {
    Course          course;
    const Scene     scene(mechanism.model());
    const System   &system = scene.system;
    StageIntegrator integrator(system, Tableau(mechanism.n_stages, mechanism.rho), tolerance);
    Stepper         stepper(system, integrator, mechanism.h, 1e-10);
    State           state = start_of({"", "", 0, 0}, system);
    system.stresses(state, state.stress);
    double before = energy_of(system, state) + potential_of(system, state), balance = 0, drive_work = 0,
           largest         = energy_of(system, state);
    const double potential = potential_of(system, state);
    try
      {
        for (const double end = n_steps * mechanism.h; state.time < end * (1 - 1e-12);)
          {
            const double  old = potential_of(system, state);
            const Advance a   = stepper.advance(state, end);
            const double  now = potential_of(system, state), after = energy_of(system, state) + now,
                         error = after - before - (a.step.work_of_loads + now - old) - a.step.work_of_drives +
                                 a.step.viscous_loss + a.step.dissipated;
            drive_work += a.step.work_of_drives;
            largest = std::max({largest, energy_of(system, state), std::abs(now - potential), std::abs(drive_work)});
            balance += error;
            before             = after;
            course.balance     = std::max(course.balance, std::abs(balance));
            course.worst_drive = std::max(course.worst_drive, std::abs(a.step.work_of_drives));
            course.least_loss  = std::min({course.least_loss, a.step.viscous_loss, a.step.dissipated});
            course.n_failed += a.n_failed;
            course.n_touches += a.step.touches.size();
            course.steps.push_back(std::abs(error));
            ++course.n_steps;
            if (course.n_steps > 200 * n_steps)
              throw NotConverged("it hangs");
          }
        course.is_finished = true;
      }
    catch (const NotConverged &problem)
      {
        course.problem = problem.what();
      }
    course.n_iterations     = integrator.n_iterations;
    course.n_factorizations = integrator.n_factorizations;
    course.gap              = largest_gap(system, state);
    // some are locked: what does not move has the energy of 1 kg with a centimetre a second
    largest               = std::max(largest, 5e-5);
    course.largest_energy = largest;
    course.balance /= largest;
    course.worst_drive /= largest;
    course.least_loss /= largest;
    for (double &e : course.steps)
      course.worst_step = std::max(course.worst_step, e /= largest);
    return course;
  }
} // namespace samara

#endif
