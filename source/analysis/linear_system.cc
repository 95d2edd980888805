#include <samara/analysis/controls.h>
#include <samara/analysis/linear_system_matrices.h>
#include <samara/base/dense.h>
#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/output/write_matrices.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Modes that are found to see whether coefficients are constant. */
    constexpr unsigned int modes_to_look_at = 6;
  } // namespace



  std::vector<Eigen::MatrixXcd>
  LinearSystem::responses(const std::vector<double> &frequencies) const
  {
    using Complex = std::complex<double>;
    std::vector<Eigen::MatrixXcd> result;
    if (A.rows() == 0)
      return std::vector<Eigen::MatrixXcd>(frequencies.size(), D.cast<Complex>());
    const Schur<Eigen::MatrixXcd> schur = complex_schur(A);
    const Eigen::MatrixXcd        B_s = schur.U.adjoint() * B.cast<Complex>(), C_s = C.cast<Complex>() * schur.U;
    for (const double frequency : frequencies)
      {
        Eigen::MatrixXcd T = -schur.T;
        T.diagonal().array() += Complex(0, frequency);
        result.push_back(C_s * T.triangularView<Eigen::Upper>().solve(B_s) + D.cast<Complex>());
      }
    return result;
  }



  std::vector<double>
  logarithmic_frequencies(const double lowest, const double highest, const unsigned int n)
  {
    std::vector<double> result;
    for (unsigned int i = 0; highest > 0 && i < n; ++i)
      result.push_back(lowest * std::pow(highest / lowest, i / (n - 1.)));
    return result;
  }



  void
  check_frequencies(const Parameters &parameters, const double lowest, const double highest, Complaints &complaints)
  {
    if (highest > 0 && !(lowest > 0 && lowest < highest))
      complaints.add(parameters.where("Lowest frequency"),
                     "the <Lowest frequency> must be positive and below the <Highest frequency>");
  }



  void
  LinearSystemAnalysis::add_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    n_modes = modes_to_look_at;
    prm.add("Inputs",
            inputs,
            "Names of controls, states of type <control>, that laws of forces and moments depend on; not given: all.");
    prm.add("Lowest frequency", lowest_frequency, "Of the frequency response [rad/s].", Double(0));
    prm.add("Highest frequency", highest_frequency, "Of the frequency response; 0: there is none [rad/s].", Double(0));
    prm.add("Frequencies", n_frequencies, "Number of frequencies, as far apart on a logarithmic scale.", Integer(2));
    prm.add("Most states",
            most_states,
            "More are refused: matrices are dense, and time grows with the cube.",
            Integer(1));
    prm.add("Hold rotations",
            hold,
            "Whether joints in steady rotation keep their speed, or are free to follow the motion.");
  }



  void
  LinearSystemAnalysis::check(const std::vector<double> &rotor_speeds, Complaints &complaints) const
  {
    check_frequencies(parameters, lowest_frequency, highest_frequency, complaints);
    if (!rotor_speeds.empty())
      complaints.add(parameters.where(),
                     "a state space belongs to one speed; let a study vary the speed in place of <Rotor speeds>");
  }



  std::vector<double>
  LinearSystemAnalysis::frequencies() const
  {
    return logarithmic_frequencies(lowest_frequency, highest_frequency, n_frequencies);
  }



  std::vector<unsigned int>
  LinearSystemAnalysis::states_of_inputs(const System &system) const
  {
    const auto result = controls_by_name(system, inputs, parameters);
    if (result.empty())
      throw InputError(parameters.where() +
                       ": linear system: there are no inputs: make a state of type <control> for each, and let the law "
                       "of a force depend on it");
    return result;
  }



  void
  LinearSystemAnalysis::check_inputs(const System                    &system,
                                     const Linearization             &linearization,
                                     const std::vector<unsigned int> &numbers) const
  {
    const Pattern &pattern = *linearization.S.pattern;
    for (const unsigned int input : numbers)
      {
        const int column = system.layout.of_state(input);
        for (int k = pattern.column_start[column]; k < pattern.column_start[column + 1]; ++k)
          if (const int row = pattern.rows[k] - int(linearization.n_kinematic);
              row >= 0 && linearization.S.values[k] != 0.)
            throw InputError(
              parameters.where("Inputs") + ": <" + system.model.states[input].name + "> prescribes a motion (" +
              system.layout.name_of_multiplier(row) +
              "), whose acceleration would be an input, too.\n  Let it be the rest angle of a spring and a "
              "damper, or of a state that follows it: an actuator has both");
      }
  }



  void
  LinearSystemAnalysis::run(Context &context)
  {
    const System &system  = context.system;
    const auto    numbers = states_of_inputs(system), controls = states_of_controls(system);
    if (!system.layout.nonholonomic.empty())
      throw InputError(parameters.where() + ": linear system: what rolls has constraints on velocities alone, " +
                       system.layout.name_of_multiplier(system.layout.nonholonomic[0]) +
                       ", for which there is none here");
    const Steady        steady = analyse(context);
    const Linearization with_inputs(system, steady.state, steady.spins, Linearization::Controls::free);
    check_inputs(system, with_inputs, numbers);
    const LinearSystemSource source{system, steady.state, steady.spins, with_inputs, numbers, controls, most_states};
    space = {};
    for (const unsigned int i : numbers)
      {
        space.inputs.push_back(system.model.states[i].name);
        space.input_units.push_back(system.model.states[i].unit);
        space.input_values.push_back(steady.state.states[i]);
      }
    for (const auto &probe : context.probes)
      {
        space.outputs.push_back(probe.name);
        space.output_units.push_back(probe.unit);
      }
    Eigen::MatrixXd basis;
    find_dynamics(source, space, basis);
    find_outputs(source, basis, context.probes, space);
    context.log.line("linear system: " + std::to_string(space.A.rows()) + " states (" +
                     std::to_string(space.n_positions) + " positions and their rates, " +
                     std::to_string(space.A.rows() - 2 * int(space.n_positions)) + " of first order), " +
                     std::to_string(space.B.cols()) + " inputs, " + std::to_string(space.C.rows()) + " outputs");
    if (space.outputs.empty())
      context.log.warning("linear system", "there are no <Probes> in subsection Output: C and D have no rows");
    if (!context.folder.empty())
      write(context);
  }



  void
  LinearSystemAnalysis::write(const Context &context) const
  {
    const auto column = [](const std::vector<double> &values) {
      return Eigen::MatrixXd(Eigen::Map<const Eigen::VectorXd>(values.data(), values.size()));
    };
    write_matrices(context.folder + "/linear_system.h5",
                   {{"A", space.A},
                    {"B", space.B},
                    {"C", space.C},
                    {"D", space.D},
                    {"input values", column(space.input_values)},
                    {"output values", column(space.output_values)}},
                   {{"inputs", space.inputs},
                    {"input units", space.input_units},
                    {"outputs", space.outputs},
                    {"output units", space.output_units}});
    if (highest_frequency > 0)
      space.write_responses(frequencies(), context.folder + "/frequency_response.csv");
  }



  void
  LinearSystem::write_responses(const std::vector<double> &frequencies, const std::string &file) const
  {
    Table      table({"frequency [rad/s]", "input", "output", "unit", "real", "imaginary", "amplitude", "phase [deg]"});
    const auto all = responses(frequencies);
    for (unsigned int j = 0; j < inputs.size(); ++j)
      for (unsigned int i = 0; i < outputs.size(); ++i)
        for (unsigned int k = 0; k < frequencies.size(); ++k)
          {
            const std::complex<double> H = all[k](i, j);
            table.add_row({frequencies[k],
                           inputs[j],
                           outputs[i],
                           output_units[i] + "/" + (input_units[j].empty() ? "1" : input_units[j]),
                           H.real(),
                           H.imag(),
                           std::abs(H),
                           std::arg(H) * 180 / M_PI});
          }
    table.write(file);
  }



  void
  LinearSystemAnalysis::finish(Context &)
  {}
} // namespace samara
