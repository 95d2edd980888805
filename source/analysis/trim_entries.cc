// The entries of trim: how they are written, and which of them do not fit each other.

#include <samara/analysis/trim.h>
#include <samara/base/text.h>

#include <stdexcept>

namespace samara
{
  LateNumber::LateNumber(const std::string &text, const Quantities &quantities)
    : text(text)
    , plain(quantities.number(text, ""))
  {
    // units and constants as they are where this stands
    const auto reader = std::make_shared<const Quantities>(quantities);
    in                = [text, reader](const std::string &unit) { return reader->number(text, unit); };
  }



  LateNumber
  Value<LateNumber>::read(const std::string &text, const std::string &, const Quantities &quantities)
  {
    return LateNumber(text, quantities);
  }



  std::string
  Value<LateNumber>::write(const LateNumber &value)
  {
    return number_to_text(value.plain);
  }



  PatternPointer
  Value<LateNumber>::pattern()
  {
    return std::make_unique<dealii::Patterns::Anything>();
  }



  TrimControl
  Value<TrimControl>::read(const std::string &text, const std::string &, const Quantities &quantities)
  {
    const std::string from = " from ", to = " to ";
    TrimControl       control;
    std::string       rest = text;
    if (const auto at = rest.rfind(to); at != std::string::npos)
      {
        control.upper = LateNumber(trim(rest.substr(at + to.size())), quantities);
        rest.resize(at);
      }
    if (const auto at = rest.rfind(from); at != std::string::npos)
      {
        control.lower = LateNumber(trim(rest.substr(at + from.size())), quantities);
        rest.resize(at);
      }
    control.name = trim(rest);
    if (control.name.empty())
      throw std::invalid_argument("<" + text + ">: a control is written <name>, or <name from -5 deg to 20 deg>");
    return control;
  }



  std::string
  Value<TrimControl>::write(const TrimControl &value)
  {
    return value.name + (value.lower.text.empty() ? "" : " from " + number_to_text(value.lower.plain)) +
           (value.upper.text.empty() ? "" : " to " + number_to_text(value.upper.plain));
  }



  PatternPointer
  Value<TrimControl>::pattern()
  {
    return std::make_unique<dealii::Patterns::Anything>();
  }



  TrimTarget
  Value<TrimTarget>::read(const std::string &text, const std::string &, const Quantities &quantities)
  {
    const auto faulty = [&]() {
      return std::invalid_argument("<" + text +
                                   ">: a target is written <probe = value>, <cos 1 of probe = value> or <sin 1 of "
                                   "probe = value>");
    };
    const auto at = text.rfind('=');
    if (at == std::string::npos)
      throw faulty();
    TrimTarget target;
    target.probe = trim(text.substr(0, at));
    target.value = LateNumber(trim(text.substr(at + 1)), quantities);
    for (const auto &[word, part] : {std::make_pair("cos ", PeriodAverage::cosine), {"sin ", PeriodAverage::sine}})
      if (target.probe.rfind(word, 0) == 0)
        {
          const auto  of       = target.probe.find(" of ");
          double      harmonic = 0;
          std::string number   = of == std::string::npos ? "" : trim(target.probe.substr(4, of - 4));
          if (!text_to_number(number, harmonic) || harmonic < 1 || harmonic > 1000 || harmonic != int(harmonic))
            throw faulty();
          target.part     = part;
          target.harmonic = int(harmonic);
          target.probe    = trim(target.probe.substr(of + 4));
        }
    if (target.probe.empty())
      throw faulty();
    return target;
  }



  std::string
  Value<TrimTarget>::write(const TrimTarget &value)
  {
    const std::string harmonic = std::to_string(value.harmonic) + " of ";
    return (value.part == PeriodAverage::mean   ? "" :
            value.part == PeriodAverage::cosine ? "cos " + harmonic :
                                                  "sin " + harmonic) +
           value.probe + " = " + number_to_text(value.value.plain);
  }



  PatternPointer
  Value<TrimTarget>::pattern()
  {
    return std::make_unique<dealii::Patterns::Anything>();
  }



  TrimContinuation
  Value<TrimContinuation>::read(const std::string &text, const std::string &, const Quantities &quantities)
  {
    const std::string from = " from ";
    const auto        at   = text.find(from);
    if (at == std::string::npos)
      throw std::invalid_argument("<" + text + ">: a continuation is written <constant from value>, mu from 0.1");
    TrimContinuation  result;
    const std::string first = trim(text.substr(at + from.size()));
    result.constant         = trim(text.substr(0, at));
    if (result.constant.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789") !=
        std::string::npos)
      throw std::invalid_argument("<" + result.constant + "> is not the name of a constant");
    result.last  = quantities.number(result.constant, "");
    result.first = quantities.number(first, "");
    // both must have one dimension
    quantities.number("(" + result.constant + ") + (" + first + ")", "");
    if (result.last == 0)
      throw std::invalid_argument("the constant <" + result.constant +
                                  "> is zero: values on the way there are parts of it; give it a small one");
    if (result.first == result.last)
      throw std::invalid_argument("the constant <" + result.constant + "> has this value already");
    return result;
  }



  std::string
  Value<TrimContinuation>::write(const TrimContinuation &)
  {
    return "";
  }



  PatternPointer
  Value<TrimContinuation>::pattern()
  {
    return std::make_unique<dealii::Patterns::Anything>();
  }



  void
  TrimAnalysis::add_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    prm.add("Controls",
            controls,
            "States of first order that keep still, as those of type <control>, with their limits: collective from -5 "
            "deg to 20 deg, lateral, longitudinal.");
    prm.add(
      "Targets",
      targets,
      "As many probes, means over a period or harmonics 2/T times the integral of y cos(n 2 pi t/T), and the "
      "values they shall have: flow.thrust = 30 kN, cos 1 of flap.rotation = 0 deg, sin 1 of flap.rotation = 0 deg.");
    prm.add(
      "Scales",
      scales,
      "One for each target: what the tolerance is a part of. Not given: the values wanted, none of which may be zero "
      "then.");
    prm.add(
      "Continue",
      continuation,
      "Constants of the model, and the values from which they are led to their own, together, if the search fails at "
      "once: mu from 0.1, with everything that depends on mu. Each step begins with the motions of those before it.");
    prm.add("Period", period, "Of the motion; not given: a turn of the steady rotation [s].");
    prm.add("Steps", n_steps, "Time steps a period.", Integer(4));
    prm.add("Method",
            method,
            "Newton-Krylov: periodicity and targets at once; discrete: settle, correct, settle; auto-pilot: controls "
            "follow the mean over the last period while the motion goes on.",
            Selection("Newton-Krylov|discrete|auto-pilot"));
    prm.add(
      "Symmetry",
      symmetry,
      "Names of repeated parts, each where the next one was a part of the period before, groups behind semicolons: "
      "blade 1, blade 2; lag 1, lag 2. Turns are over that part of the period then, and parts are renumbered behind it. "
      "Belongs to a part what has its name in its own.");
    prm.add("Turning", turning, "Names of bodies and joints that turn with the repeated parts and are not repeated.");
    prm.add("Start time", start_time, "Time at which the period starts, and the orbit is left [s].");
    prm.add("Settle", settle, "Periods before the first look, and of discrete corrections after each.", Integer(1));
    prm.add("Most turns", most_turns, "Periods after which trim is given up.", Integer(1));
    prm.add(
      "Tolerance",
      tolerance,
      "Of targets, as a part of their <Scales>; and of the periodicity, as a part of the model's length, rad, and "
      "these over T/2 pi [1].",
      Double(0, 1));
    prm.add("Time constant", time_constant, "Of the auto-pilot, in periods [1].", Double(0));
    prm.add("Most products",
            most_products,
            "Of Newton-Krylov: dimensions of a Krylov space, each of which costs a product with the tangent of a "
            "period, or a period where that is not there. With a <Symmetry>, of whole periods.",
            Integer(1));
    prm.add("Stages", n_stages, "Stages of the integrator, 1 to 3.", Integer(1, 3));
    prm.add("Spectral radius",
            spectral_radius,
            "Of the integrator at infinite frequency, below 1: what does not obey the constraints must die away within "
            "a period [1].",
            Double(0, 1));
    prm.add("Newton tolerance",
            newton_tolerance,
            "Of the steps: change of velocities, relative to the largest [1].",
            Double(0));
    prm.add("Iterations", max_iterations, "Most Newton iterations of a step with one factorisation.", Integer(2));
  }



  namespace
  {
    /** Whether a zero is one of an angle, whose scale is a radian. */
    bool
    is_angle(const std::string &text)
    {
      const auto ends_with = [&](const std::string &unit) {
        return text.size() > unit.size() && text.compare(text.size() - unit.size(), unit.size(), unit) == 0;
      };
      return ends_with("deg") || ends_with("rad");
    }
  } // namespace



  void
  TrimAnalysis::check(const std::vector<double> &rotor_speeds, Complaints &complaints) const
  {
    const auto complain = [&](const std::string &entry, const std::string &text) {
      complaints.add(parameters.where(entry), text);
    };
    if (controls.empty())
      complain("Controls", "trim needs <Controls>");
    else if (controls.size() != targets.size())
      complain("Targets",
               "there are " + std::to_string(controls.size()) + " <Controls> and " + std::to_string(targets.size()) +
                 " <Targets>: as many are needed");
    for (unsigned int i = 0; i < controls.size(); ++i)
      for (unsigned int j = 0; j < i; ++j)
        if (controls[i].name == controls[j].name)
          complain("Controls", "<" + controls[i].name + "> is there twice");
    if (!(period > 0) && parameters.is_set("Period"))
      complain("Period", "the <Period> must be positive");
    if (!scales.empty() && scales.size() != targets.size())
      complain("Scales",
               "there are " + std::to_string(targets.size()) + " <Targets> and " + std::to_string(scales.size()) +
                 " <Scales>");
    for (const auto &target : targets)
      if (scales.empty() && target.value.plain == 0 && !is_angle(target.value.text))
        {
          complain("Targets",
                   "the target <" + target.probe +
                     "> shall be zero: of what the tolerance is a part nobody can tell; give <Scales>");
          break;
        }
    if (!(tolerance > 0))
      complain("Tolerance", "the <Tolerance> must be positive");
    if (!(newton_tolerance > 0))
      complain("Newton tolerance", "the <Newton tolerance> must be positive");
    // jumps of controls die away with ρ∞ⁿ, n steps a turn: of 0.95 and 36 steps a sixth is left
    if (!(spectral_radius <= 0.95))
      complain("Spectral radius", "trim needs a <Spectral radius> of at most 0.95");
    if (!(time_constant > 0))
      complain("Time constant", "the <Time constant> must be positive");
    for (const auto &target : targets)
      if (2 * target.harmonic >= n_steps)
        complain("Targets",
                 "harmonic " + std::to_string(target.harmonic) + " of <" + target.probe + "> needs more than " +
                   std::to_string(2 * target.harmonic) + " <Steps> a period");
    if (symmetry.empty() && !turning.empty())
      complain("Turning", "<Turning> belongs to a <Symmetry>: which parts are repeated");
    if (const auto groups = groups_of_names(symmetry); !groups.empty() && n_steps % groups[0].size() != 0)
      complain("Steps",
               "the <Steps> must be a multiple of the " + std::to_string(groups[0].size()) + " repeated parts");
    if (!rotor_speeds.empty())
      complaints.add(parameters.where(), "trim is found at one speed; leave out <Rotor speeds>, or the analysis");
  }
} // namespace samara
