// What users say of a static analysis.

#include <samara/analysis/static.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  void
  StaticAnalysis::add_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    prm.add("Load steps",
            initial_steps,
            "Number of load steps to begin with; they grow and shrink by themselves.",
            Integer(1));
    prm.add("Smallest step", smallest_step, "Fraction of the load below which a step is given up [1].", Double(0, 1));
    prm.add(
      "Stability limits",
      stability_limits,
      "Where the tangent matrix becomes singular, at a limit point or a bifurcation: stop there, or pass and follow what "
      "Newton's method finds beyond. Not watched when parts rotate.",
      Selection("stop|pass"));
    prm.add(
      "Load factor",
      load_factor,
      "Factor of all loads and prescribed motions, a function of s that goes from 0 to 1 in the load steps, which "
      "then do not grow and end at its corners: table: 0 0; 0.5 1; 1 0 loads and unloads [1].");
    prm.add("Time", time, "Time at which functions of time are taken [s].");
    prm.add("Tolerance",
            tolerance,
            "Newton stops when displacements, relative to the size of the model, and rotations change by less [1].",
            Double(0));
    prm.add("Iterations", max_iterations, "Most Newton iterations in a step.", Integer(1));
    add_path_parameters(prm);
  }



  void
  StaticAnalysis::check(const std::vector<double> &rotor_speeds, Complaints &complaints) const
  {
    if (parameters.is_set("Load factor"))
      check_load_factor(rotor_speeds, complaints);
    if (!(tolerance > 0))
      complaints.add(parameters.where("Tolerance"), "the <Tolerance> must be positive");
    if (!(smallest_step > 0))
      complaints.add(parameters.where("Smallest step"), "the <Smallest step> must be positive");
  }



  void
  StaticAnalysis::check_load_factor(const std::vector<double> &rotor_speeds, Complaints &complaints) const
  {
    const auto complain = [&](const std::string &text) { complaints.add(parameters.where("Load factor"), text); };
    if (!(std::abs(load_factor(0.)) <= 1e-12))
      complain("the <Load factor> must begin with 0, where nothing is loaded, not with " + short_text(load_factor(0.)));
    // a corner changes the value by its slope times as little; a jump by more
    constexpr double beside = 1e-9;
    for (double s = load_factor.next_corner(0., 1.); s < 1.; s = load_factor.next_corner(s, 1.))
      if (!(std::abs(load_factor(s + beside) - load_factor(s - beside)) <= 1e-6))
        {
          complain("the <Load factor> must not jump, as it does at s = " + short_text(s));
          break;
        }
    if (path == "arc length")
      complain("a path by its arc length finds the load factor itself; leave out the <Load factor>");
    if (!rotor_speeds.empty())
      complain("a <Load factor> cannot be followed at each of the <Rotor speeds>");
  }
} // namespace samara
