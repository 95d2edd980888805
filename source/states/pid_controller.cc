#include <samara/states/controller.h>

#include <deal.II/base/exceptions.h>

#include <cmath>

namespace samara
{
  namespace
  {
    std::string
    in_parentheses(const std::string &unit)
    {
      return unit.empty() ? "1" : "(" + unit + ")";
    }
  } // namespace



  void
  PidController::add_parameters(Parameters &prm)
  {
    using dealii::Patterns::Double;
    prm.add("Signal", signal_law, "What is controlled: an expression of time t and signals, in the signal unit.");
    prm.add("Signal unit", signal_unit, "SI unit of the signal: rad, m/s; empty: a number.");
    prm.add("Target", target, "What the signal is to be, in its unit: an expression of time t and signals.");
    prm.add(
      "Signal rate",
      signal_rate,
      "Rate of the signal, if it is known: an expression such as hinge.rotation rate. The derivative part is then "
      "the gain times less this rate, without a filter.");
    add_unit(prm);
    prm.add("Proportional gain", proportional, "Output by error, in its unit by the signal unit.");
    prm.add("Integral gain", integral, "Growth of the output by error, in unit/(signal unit s).");
    prm.add("Derivative gain", derivative, "Output by rate of the error, in unit s/signal unit.");
    prm.add("Filter time", filter_time, "Time constant of the filter of the derivative part [s].", Double(0));
    prm.add("Lower limit", lower, "Least output, in its unit; not given: there is none.");
    prm.add("Upper limit", upper, "Largest output, in its unit; not given: there is none.");
    prm.add("Tracking time",
            tracking_time,
            "Beyond a limit the integral is led back in this time; 0: the root of the derivative by the integral gain, "
            "without derivative part the proportional by the integral gain [s].",
            Double(0));
    prm.add("Initial", initial, "The integral part at the start, in the unit of the output.");
    prm.add("Scale",
            scale,
            "Size of the output, in its unit, below which its changes do not count for convergence.",
            Double(1e-300));

    const auto of_output = [this](const Quantities &q) { return in_parentheses(q.signals.unit_of_state(name)); };
    const auto of_signal = [this](const Quantities &q) {
      return in_parentheses(q.signals.unit_of_state(name + " input"));
    };
    for (const std::string entry : {"Signal", "Target"})
      prm.take_unit(entry, of_signal);
    prm.take_unit("Signal rate", [=](const Quantities &q) { return of_signal(q) + "/s"; });
    prm.take_unit("Proportional gain", [=](const Quantities &q) { return of_output(q) + "/" + of_signal(q); });
    prm.take_unit("Integral gain", [=](const Quantities &q) { return of_output(q) + "/" + of_signal(q) + "/s"; });
    prm.take_unit("Derivative gain", [=](const Quantities &q) { return of_output(q) + "*s/" + of_signal(q); });
    for (const std::string entry : {"Lower limit", "Upper limit", "Initial", "Scale"})
      prm.take_unit(entry, of_output);
  }



  void
  PidController::initialize(Model &model)
  {
    const auto complain = [&](const std::string &entry, const std::string &text) {
      model.complaints.add(parameters.where(entry), text);
    };
    check_unit(model, "Unit", unit);
    check_unit(model, "Signal unit", signal_unit);
    parameters.require("Signal", model.complaints);
    has_signal_rate = parameters.is_set("Signal rate");
    is_limited      = parameters.is_set("Lower limit") || parameters.is_set("Upper limit");
    if (!parameters.is_set("Lower limit"))
      lower = -std::numeric_limits<double>::infinity();
    if (!parameters.is_set("Upper limit"))
      upper = std::numeric_limits<double>::infinity();
    if (lower >= upper)
      complain("Upper limit", "the <Upper limit> must be above the <Lower limit>");
    if (proportional == 0 && integral == 0 && derivative == 0)
      complain("Proportional gain", "all gains of <" + name + "> are zero");
    if (derivative != 0 && !has_signal_rate && filter_time == 0)
      complain("Filter time", "the derivative part needs a <Filter time> above zero, or the <Signal rate>");
    // T_t = √(T_i T_d), or T_i without derivative part: Åström & Hägglund, PID Controllers, 1995
    if (is_limited && integral != 0 && tracking_time == 0)
      {
        tracking_time = derivative / integral > 0 ? std::sqrt(derivative / integral) : proportional / integral;
        if (!(tracking_time > 0))
          complain("Tracking time", "these gains propose no <Tracking time>; give one above zero");
      }
    if (integral != 0)
      {
        integral_state = numbers.size();
        add_state(model, "integral", unit, initial, scale);
      }
    if (derivative != 0 && !has_signal_rate)
      {
        filter_state = numbers.size();
        add_state(model, "filter", signal_unit, 0, scale / std::abs(derivative / filter_time));
      }
  }



  std::vector<Controller::Input>
  PidController::inputs() const
  {
    return {{"Signal", &signal_law}, {"Target", &target}, {"Signal rate", &signal_rate}};
  }



  SignalPointer
  PidController::error(Model &model) const
  {
    return sum_of_signals({{1., signal_of_law(target, model)}, {-1., signal_of_law(signal_law, model)}});
  }



  SignalPointer
  PidController::unlimited(Model &model) const
  {
    // v = K_p e + I + K_d (e − f)/T_f, or − K_d times the rate of the signal
    const double         per_lag  = filter_state < 0 ? 0. : derivative / filter_time;
    std::vector<Summand> summands = {{proportional + per_lag, error(model)}};
    if (integral_state >= 0)
      summands.push_back({1., state(integral_state)});
    if (filter_state >= 0)
      summands.push_back({-per_lag, state(filter_state)});
    if (has_signal_rate)
      summands.push_back({-derivative, signal_of_law(signal_rate, model)});
    return sum_of_signals(summands);
  }



  SignalPointer
  PidController::output(Model &model, unsigned int) const
  {
    return is_limited ? saturated_signal(unlimited(model), lower, upper) : unlimited(model);
  }



  SignalPointer
  PidController::rate(Model &model, const unsigned int i) const
  {
    Assert(static_cast<int>(i) == filter_state || static_cast<int>(i) == integral_state,
           dealii::ExcMessage("A state is that of the filter or of the integral."));
    // ḟ = (e − f)/T_f; İ = K_i e + (u − v)/T_t, which leads I back while u is at a limit
    if (static_cast<int>(i) == filter_state)
      return sum_of_signals({{1 / filter_time, error(model)}, {-1 / filter_time, state(i)}});
    std::vector<Summand> summands = {{integral, error(model)}};
    if (is_limited)
      {
        const SignalPointer before_limits = unlimited(model);
        summands.push_back({1 / tracking_time, saturated_signal(before_limits, lower, upper)});
        summands.push_back({-1 / tracking_time, before_limits});
      }
    return sum_of_signals(summands);
  }
} // namespace samara
