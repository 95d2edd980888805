#include <samara/states/skeleton.h>

namespace samara
{
  void
  Servo::add_parameters(Parameters &prm)
  {
    // Numbers above zero start where doubles do: zero itself is refused, with the line of the entry.
    const dealii::Patterns::Double positive(1e-300);
    add_unit(prm);
    prm.add("Signal", signal_law, "What is followed, in the unit of the output: an expression of time t and signals.");
    prm.add("Lag", lag, "Time constant [s].", positive);
    prm.add("Largest rate", largest_rate, "Of the output, in its unit a second.", positive);
    prm.add("Initial", initial, "Output at the start, in its unit.");
    prm.add("Scale", scale, "Size of the output below which its changes do not count for convergence.", positive);

    // These have the unit that the entry <Unit> names: it is known when the file is read.
    const auto own_unit = [this](const Quantities &quantities) {
      const std::string given = quantities.signals.unit_of_state(name);
      return given.empty() ? "1" : "(" + given + ")";
    };
    for (const std::string entry : {"Signal", "Initial", "Scale"})
      prm.take_unit(entry, own_unit);
    prm.take_unit("Largest rate", [=](const Quantities &quantities) { return own_unit(quantities) + "/s"; });
  }



  void
  Servo::initialize(Model &model)
  {
    check_unit(model, "Unit", unit);
    parameters.require("Signal", model.complaints);
    add_state(model, "position", unit, initial, scale);
  }



  std::vector<Controller::Input>
  Servo::inputs() const
  {
    return {{"Signal", &signal_law}};
  }



  SignalPointer
  Servo::rate(Model &model, const unsigned int i) const
  {
    // Derivatives, corners in time and the switching at the limits come with the signals it is made of.
    const auto wanted = sum_of_signals({{1 / lag, signal_of_law(signal_law, model)}, {-1 / lag, state(i)}});
    return saturated_signal(wanted, -largest_rate, largest_rate);
  }



  SignalPointer
  Servo::output(Model &, unsigned int) const
  {
    return state(0);
  }
} // namespace samara
