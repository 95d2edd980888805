// State spaces about periodic motions: entries, the motion, and what is told; the matrices stand in
// periodic_linear_system_matrices.cc.

#include <samara/analysis/controls.h>
#include <samara/analysis/period_of_rotors.h>
#include <samara/analysis/periodic_linear_system.h>
#include <samara/analysis/start_of_motion.h>
#include <samara/base/dense.h>
#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/output/write_matrices.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    constexpr double settled_orbit = 1e-10, doubtful_orbit = 1e-6; ///< gaps, as in floquet

    /** Matrices of the samples below each other. */
    Eigen::MatrixXd
    stacked(const std::vector<Eigen::MatrixXd> &matrices)
    {
      const auto     &first = matrices.front();
      Eigen::MatrixXd result(first.rows() * matrices.size(), first.cols());
      for (unsigned int k = 0; k < matrices.size(); ++k)
        result.middleRows(k * first.rows(), first.rows()) = matrices[k];
      return result;
    }
  } // namespace



  void
  PeriodicLinearSystemAnalysis::add_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    prm.add("Period", period, "Of the motion; not given: a turn of the steady rotation [s].", Double(0));
    prm.add("Samples", n_samples, "Matrices a period; between them inputs keep still.", Integer(1));
    prm.add("Steps", n_steps, "Steps of the integrator between samples.", Integer(1));
    prm.add("Stages", n_stages, "Stages of the integrator, 1 to 3.", Integer(1, 3));
    prm.add("Spectral radius", spectral_radius, "Of the integrator at infinite frequency [1].", Double(0, 1));
    prm.add("Newton tolerance", newton_tolerance, "Of the steps, see dynamic analysis [1].", Double(0));
    prm.add("Iterations", max_iterations, "Most Newton iterations with one factorisation.", Integer(2));
    prm.add("Inputs",
            inputs,
            "Names of controls, states of type <control>, that laws of forces and moments depend on; not given: all.");
    prm.add(
      "Symmetry",
      symmetry,
      "Names of repeated parts, each where the next one was a part of the period before, for multiblade coordinates: "
      "blade 1, blade 2, blade 3; groups behind semicolons.");
    prm.add("Turning", turning, "Names of bodies and joints that turn with the repeated parts and are not repeated.");
    prm.add("Settle", most_periods, "Most periods that the motion is given to become periodic by itself.", Integer(1));
    prm.add("Corrections", most_corrections, "Most steps of Newton's method on periodicity after that.", Integer(0));
    prm.add(
      "Largest gap",
      largest_gap,
      "What a motion may lack to periodicity, parts of the model's length, radians and the largest speed; more is "
      "refused [1].",
      Double(0));
    prm.add("Lowest frequency", lowest_frequency, "Of the frequency response of the mean [rad/s].", Double(0));
    prm.add("Highest frequency",
            highest_frequency,
            "Of the frequency response of the mean; 0: there is none [rad/s].",
            Double(0));
    prm.add("Frequencies", n_frequencies, "Number of frequencies, as far apart on a logarithmic scale.", Integer(2));
    prm.add("Most states", most_states, "More are refused: matrices are dense.", Integer(1));
  }



  void
  PeriodicLinearSystemAnalysis::check(const std::vector<double> &rotor_speeds, Complaints &complaints) const
  {
    const auto complain = [&](const std::string &entry, const std::string &text) {
      complaints.add(parameters.where(entry), text);
    };
    if (!(period > 0) && parameters.is_set("Period"))
      complain("Period", "the <Period> must be positive");
    if (!(newton_tolerance > 0))
      complain("Newton tolerance", "the <Newton tolerance> must be positive");
    check_frequencies(parameters, lowest_frequency, highest_frequency, complaints);
    if (trim(symmetry).empty() && !turning.empty())
      complain("Turning", "<Turning> belongs to a <Symmetry>: which parts are repeated");
    if (!trim(symmetry).empty())
      if (const auto n = split_top_level(split_top_level(symmetry, ';')[0], ',').size(); n_samples % n != 0)
        complain("Samples", "the <Samples> must be a multiple of the " + std::to_string(n) + " repeated parts");
    if (!rotor_speeds.empty())
      complaints.add(parameters.where(),
                     "a state space belongs to one speed; let a study vary the speed in place of <Rotor speeds>");
  }



  RepeatedParts
  PeriodicLinearSystemAnalysis::repeated_parts(const System &system) const
  {
    try
      {
        return RepeatedParts(system, groups_of_names(symmetry), turning);
      }
    catch (const std::invalid_argument &problem)
      {
        throw InputError(parameters.where("Symmetry") + ": " + problem.what());
      }
  }



  std::vector<State>
  PeriodicLinearSystemAnalysis::find_motion(const Context &context, SectionMap &whole, PeriodMap &sample)
  {
    const State first = motion_or_start(context, {parameters.where(), 0.});
    whole.settle(first, most_periods, settled_orbit);
    whole.correct(most_corrections, settled_orbit);
    gap                    = whole.gap.size;
    const std::string text = "the motion lacks " + number_to_text("%.1e", gap) + " to periodicity, most at " +
                             context.system.layout.name_of(whole.gap.unknown);
    if (!(gap <= largest_gap))
      throw NotConverged("periodic linear system: " + text +
                         ".\n  Is the <Period> right? Damping lets it settle (<Settle>, or trim before)");
    if (gap > doubtful_orbit)
      context.log.warning("periodic linear system", text + "; so much do the matrices lack, too");
    std::vector<State> states = {whole.map.states().front()};
    for (unsigned int k = 0; k < n_samples; ++k)
      states.push_back(sample.march(states.back()));
    return states;
  }



  void
  PeriodicLinearSystemAnalysis::run(Context &context)
  {
    Complaints complaints;
    check(context.sweep, complaints);
    complaints.throw_if_any();
    find_period(period, parameters, context);
    const System      &system  = context.system;
    const auto         numbers = controls_by_name(system, inputs, parameters);
    const unsigned int n       = n_samples * n_steps;
    SectionMap         whole(system,
                     {period, n, n_stages, spectral_radius, newton_tolerance, max_iterations},
                     RepeatedParts(system));
    PeriodMap          sample(system,
                     {period / n_samples, n_steps, n_stages, spectral_radius, newton_tolerance, max_iterations});
    space        = {};
    space.period = period;
    try
      {
        const auto states   = find_motion(context, whole, sample);
        space.start         = states.front().time;
        orbit               = states.front();
        RepeatedParts parts = repeated_parts(system);
        if (parts.n() > 1)
          parts.align(states.front(), states[n_samples / parts.n()]);
        std::vector<Eigen::MatrixXd> bases, transformations;
        find_bases(whole, states, Multiblade(system, parts), bases, transformations);
        find_dynamics(system, whole.scales(), sample, states, bases, numbers);
        find_outputs(context, whole.scales(), states, bases, numbers);
      }
    catch (const NotConverged &problem)
      {
        const std::string text = problem.what();
        throw NotConverged(text.find("periodic linear system") == 0 ? text : "periodic linear system: " + text);
      }
    find_averages();
    tell(context);
    if (!context.folder.empty())
      write(context);
  }



  void
  PeriodicLinearSystemAnalysis::tell(Context &context) const
  {
    context.log.line("periodic linear system: " + std::to_string(space.A[0].rows()) + " states, " +
                     std::to_string(space.inputs.size()) + " inputs, " + std::to_string(space.outputs.size()) +
                     " outputs, " + std::to_string(n_samples) + " samples a period; largest multiplier " +
                     number_to_text("%.10g", std::abs(space.multipliers()[0])));
    context.log.line("  over the period A changes by " + number_to_text("%.2g", space.variation()) + " of A - 1");
    if (space.averaged.A.rows() == 0)
      return context.log.warning(
        "periodic linear system",
        "there are no averages: something turns by half a cycle in a sample, or dies away in it; "
        "take more <Samples>");
    const Eigen::VectorXcd lambda = general_eigenvalues(space.averaged.A);
    context.log.line("  averaged: the least damped motion grows by exp(" +
                     number_to_text("%.6g", lambda.real().maxCoeff()) + " 1/s t)");
    if (context.probes.empty())
      context.log.warning("periodic linear system", "there are no <Probes> in subsection Output: C and D have no rows");
  }



  void
  PeriodicLinearSystemAnalysis::write(const Context &context) const
  {
    const auto column = [](const std::vector<double> &values) {
      return Eigen::MatrixXd(Eigen::Map<const Eigen::VectorXd>(values.data(), values.size()));
    };
    std::vector<double> times;
    for (unsigned int k = 0; k < n_samples; ++k)
      times.push_back(space.start + k * period / n_samples);
    const auto      multipliers = space.multipliers();
    Eigen::MatrixXd of_period(multipliers.size(), 2);
    for (unsigned int i = 0; i < multipliers.size(); ++i)
      of_period.row(i) << multipliers[i].real(), multipliers[i].imag();
    write_matrices(context.folder + "/periodic_linear_system.h5",
                   {{"A", stacked(space.A)},
                    {"B", stacked(space.B)},
                    {"C", stacked(space.C)},
                    {"D", stacked(space.D)},
                    {"averaged A", space.averaged.A},
                    {"averaged B", space.averaged.B},
                    {"averaged C", space.averaged.C},
                    {"averaged D", space.averaged.D},
                    {"times", column(times)},
                    {"multipliers", of_period},
                    {"input values", column(space.input_values)},
                    {"output values", space.output_values}},
                   {{"inputs", space.inputs},
                    {"input units", space.input_units},
                    {"outputs", space.outputs},
                    {"output units", space.output_units}});
    if (highest_frequency > 0 && space.averaged.A.rows() > 0)
      space.averaged.write_responses(logarithmic_frequencies(lowest_frequency, highest_frequency, n_frequencies),
                                     context.folder + "/frequency_response.csv");
  }
} // namespace samara
