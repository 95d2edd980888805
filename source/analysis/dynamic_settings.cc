// The entries of a dynamic analysis, and which of them do not fit each other.

#include <samara/analysis/dynamic.h>
#include <samara/base/text.h>

namespace samara
{
  namespace
  {
    constexpr double most_steps = 1e10; ///< of a run: nobody waits for more
  }



  DynamicAnalysis::DynamicAnalysis(const std::shared_ptr<const Integrators> &integrators)
    : integrators(integrators)
  {}



  bool
  DynamicAnalysis::is_family() const
  {
    return integrators->abilities_of(integrator).is_family;
  }



  void
  DynamicAnalysis::add_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    add_step_parameters(prm);
    add_integrator_parameters(prm);
    prm.add(
      "Inconsistent velocities",
      inconsistent,
      "Velocities at the start that the constraints do not allow: project them on those that are allowed, nearest in "
      "kinetic energy, and say so; or refuse them.",
      Selection("project|refuse"));
    prm.add("Output every", output_every, "Steps from one row of the histories to the next.", Integer(1));
    prm.add("Pictures", n_pictures, "Number of pictures of the moving model, at equal times.", Integer(0));
    prm.add(
      "Second estimate",
      second_estimate,
      "Repeat each step by two half ones and write how far they are apart: an independent estimate of the error, at "
      "three times the cost.");
    prm.add("Checkpoint interval",
            seconds_between_checkpoints,
            "Seconds of computing between two checkpoints for --restart [s].",
            Double(0));
  }



  void
  DynamicAnalysis::add_step_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    prm.add("Start time", start_time, "Time at the start [s].");
    prm.add("End time", end_time, "Time at the end [s].");
    prm.add("Step", step, "Time step; of adaptive steps the first one [s].", Double(0));
    prm.add(
      "Step control",
      control,
      "fixed, or adaptive: steps are as long as the tolerance allows, judged by what a neighbour in the integrator "
      "family would have done. Either way steps end at corners of loads, and are halved where no solution is found.",
      Selection("fixed|adaptive"));
    prm.add("Tolerance",
            tolerance,
            "Of adaptive steps: error of positions at the end of the run over the <Length>; of BDF: relative "
            "tolerance [1].",
            Double(0, 1));
    prm.add("Tolerance holds for",
            tolerance_holds_for,
            "Of adaptive steps: time over which errors may add up to the tolerance, such as a period that repeats; 0: "
            "all of the run [s].",
            Double(0));
    prm.add(
      "Length",
      length,
      "Of adaptive steps: what the tolerance is a part of, if no displacement is larger; 0: the largest extension "
      "of the model. For small vibration of something large: that of the vibration [m].",
      Double(0));
    prm.add("Smallest step", smallest_step, "Step below which the run is given up [s].", Double(0));
    prm.add("Largest step", largest_step, "Of adaptive steps; 0: a tenth of the whole time [s].", Double(0));
  }



  void
  DynamicAnalysis::add_integrator_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    prm.add("Integrator",
            integrator,
            integrators->what_they_are() + ". All but the family are here for comparison, with fixed steps.",
            Selection(join(integrators->names(), "|")));
    prm.add(
      "Stages",
      n_stages,
      "Stages of the integrator, 1 to 3: order 2 s for spectral radius 1, otherwise 2 s - 1. One stage: the midpoint rule.",
      Integer(1, 3));
    prm.add("Spectral radius",
            spectral_radius,
            "At infinite frequency: 1 preserves energy, less damps what the step cannot resolve; 0 most [1].",
            Double(0, 1));
    prm.add(
      "Newton tolerance",
      newton_tolerance,
      "Newton's method stops when velocities change by less, relative to the largest, and the energy statement is "
      "satisfied to this part of the energy [1].",
      Double(0));
    prm.add(
      "Energy balance",
      energy_balance,
      "What to do when the energy account misses more than the Newton tolerance explains: refuse the results, which "
      "are written, with exit code 3; or warn.",
      Selection("refuse|warn"));
    prm.add("Iterations", max_iterations, "Most Newton iterations with one factorisation.", Integer(2));
  }



  void
  DynamicAnalysis::check(const std::vector<double> &rotor_speeds, Complaints &complaints) const
  {
    const auto complain = [&](const std::string &entry, const std::string &text) {
      complaints.add(parameters.where(entry), text);
    };
    if (!(end_time > start_time))
      complain("End time", "the <End time> must be later than the <Start time>");
    if (!(step > 0))
      complain("Step", "the <Step> must be positive");
    else if ((end_time - start_time) / step > most_steps)
      complain("Step",
               "with this <Step> there are " + short_text((end_time - start_time) / step) + " steps to the <End time>");
    if (!(newton_tolerance > 0))
      complain("Newton tolerance", "the <Newton tolerance> must be positive");
    if (!rotor_speeds.empty())
      complaints.add(parameters.where(),
                     "a dynamic analysis starts at one speed; leave out <Rotor speeds>, or the analysis");
    if (control != "adaptive")
      return;
    if (!is_family())
      complain("Integrator",
               "<Step control = adaptive> judges steps by neighbours in the integrator family; take fixed "
               "steps with the integrator <" +
                 integrator + ">");
    if (!(tolerance > 0 && tolerance < 1))
      complain("Tolerance", "the <Tolerance> of adaptive steps lies between 0 and 1");
    // limits by what was measured: doc/theory/step_control.md, the controller, and doc/benchmarks/tolerance.md
    if (n_stages == 1 && spectral_radius < 1 && tolerance < 1e-2)
      complain(
        "Stages",
        "one stage with a <Spectral radius> below 1 is of the first order: adaptive steps would be of the size of "
        "the tolerance; take two <Stages> or more");
    else if (n_stages == 1 && tolerance < 1e-5)
      complain(
        "Stages",
        "adaptive steps of one stage are of the second order: for a <Tolerance> below 1e-5 they would be tens of "
        "thousands, whose estimates do not add up to it; take two <Stages> or more");
    if (!(smallest_step > 0))
      complain("Smallest step", "the <Smallest step> of adaptive steps must be positive");
    else if (largest_step > 0 && smallest_step > largest_step)
      complain("Smallest step", "the <Smallest step> must not be larger than the <Largest step>");
  }
} // namespace samara
