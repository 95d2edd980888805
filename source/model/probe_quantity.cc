#include <samara/model/model.h>
#include <samara/model/probe_quantity.h>

#include <algorithm>
#include <cctype>

namespace samara
{
  UnreadExpression
  Value<UnreadExpression>::read(const std::string &text, const std::string &, const Quantities &quantities)
  {
    return {text, std::make_shared<const Quantities>(quantities)};
  }



  PatternPointer
  Value<UnreadExpression>::pattern()
  {
    return std::make_unique<dealii::Patterns::Anything>();
  }



  void
  ProbeQuantity::add_parameters(Parameters &prm)
  {
    prm.add(
      "Value",
      value,
      "Expression of probes, constants and numbers with units: flow.thrust/(rho*pi*R^2*(Omega*R)^2). Angles are in "
      "rad in it.");
    prm.add("Unit", unit, "Unit of the result, kN or deg; 1: a number.");
  }



  void
  ProbeQuantity::initialize(Model &m)
  {
    model = &m;
    if (!parameters.require("Value", m.complaints))
      return;
    try
      {
        Quantities::unit(unit);
      }
    catch (const std::invalid_argument &problem)
      {
        m.complaints.add(parameters.where("Unit"), problem.what());
      }
  }



  void
  ProbeQuantity::connect(Layout &)
  {
    try
      {
        make(); // what is wrong in it is told whether it is recorded or not
      }
    catch (const std::invalid_argument &problem)
      {
        model->complaints.add(parameters.where("Value"), problem.what());
      }
  }



  namespace
  {
    bool
    is_letter_of_word(const char c)
    {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
    }

    /** The longest name that stands in @p text at @p at, and no word goes on behind it; "" if there is none. */
    std::string
    longest_name_at(const std::string &text, const std::size_t at, const std::vector<std::string> &names)
    {
      std::string longest;
      for (const auto &name : names)
        if (name.size() > longest.size() && text.compare(at, name.size(), name) == 0 &&
            (at + name.size() == text.size() || !is_letter_of_word(text[at + name.size()])))
          longest = name;
      return longest;
    }

    /** Where the letters, digits, blanks and dots end that may be those of a path. */
    std::size_t
    end_of_path(const std::string &text, std::size_t at)
    {
      while (at < text.size() && (is_letter_of_word(text[at]) || text[at] == ' ' || text[at] == '.'))
        ++at;
      return at;
    }

    /** What a probe is in as an expression has it. */
    std::string
    unit_of_probe(const std::string &unit)
    {
      return unit == "deg" ? "rad" : unit == "deg/s" ? "rad/s" : unit.empty() || unit == "-" ? "1" : unit;
    }

    double
    factor_of_probe(const std::string &unit)
    {
      return unit == "deg" || unit == "deg/s" ? M_PI / 180 : 1.;
    }
  } // namespace



  std::size_t
  ProbeQuantity::find_probe(const std::string &object,
                            const std::size_t  begin,
                            const std::size_t  after_object,
                            ProbesInText      &found) const
  {
    const std::string &text    = value.text;
    const bool         is_path = after_object < text.size() && text[after_object] == '.';
    std::string        fault;
    // a name that an operator does not end may go on with words that are no part of it
    for (std::size_t stop = is_path ? end_of_path(text, after_object) : after_object;;)
      {
        try
          {
            const std::string path  = object + trim(text.substr(after_object, stop - after_object));
            const Probe       probe = model->probe(path);
            const auto        last  = text.find_last_not_of(' ', stop - 1) + 1;
            found.push_back({{begin, last, path, unit_of_probe(probe.unit)}, probe});
            return last;
          }
        catch (const FollowUp &)
          {
            throw;
          }
        catch (const std::invalid_argument &problem)
          {
            fault = fault.empty() ? problem.what() : fault;
          }
        if (!is_path)
          return begin; // a constant may have the name of an object
        const auto cut = text.find_last_of(" .", stop - 1);
        if (cut == std::string::npos || cut <= after_object)
          throw std::invalid_argument("<" + text + ">: " + fault);
        stop = cut;
      }
  }



  ProbeQuantity::ProbesInText
  ProbeQuantity::find_probes() const
  {
    const std::string       &text  = value.text;
    const std::string        scope = scope_of(name);
    std::vector<std::string> names;
    for (const auto &item : model->items)
      {
        names.push_back(item->name);
        if (!scope.empty() && item->name.compare(0, scope.size(), scope) == 0)
          names.push_back(item->name.substr(scope.size()));
      }
    for (const auto &[subsystem, mount] : model->mounts)
      names.push_back(subsystem);
    ProbesInText found;
    for (std::size_t i = 0; i < text.size(); ++i)
      {
        if (!is_letter_of_word(text[i]) || std::isdigit(static_cast<unsigned char>(text[i])) != 0 ||
            (i > 0 && (is_letter_of_word(text[i - 1]) || text[i - 1] == '.')))
          continue;
        const std::string given   = longest_name_at(text, i, names);
        const auto        end     = i + given.size();
        const bool        is_path = end < text.size() && text[end] == '.';
        if (given.empty() || (!is_path && (end < text.size() && text[end] == '(')))
          continue;
        const std::string full = model->is_item(scope + given) ? scope + given : given;
        if (const auto end_of_probe = find_probe(full, i, end, found); end_of_probe > i)
          i = end_of_probe - 1;
      }
    return found;
  }



  Probe
  ProbeQuantity::make() const
  {
    if (is_in_use)
      throw std::invalid_argument("<" + name + "> is, in the end, made of itself");
    struct Use
    {
      bool &flag;
      explicit Use(bool &flag)
        : flag(flag)
      {
        flag = true;
      }
      ~Use()
      {
        flag = false;
      }
    } use(is_in_use);

    const ProbesInText              found = find_probes();
    std::vector<SignalNames::Found> signals;
    for (const auto &[signal, probe] : found)
      signals.push_back(signal);
    if (signals.empty())
      throw std::invalid_argument("<" + value.text + "> names no probe: what does not change is a constant");
    const Law law = value.quantities->law_of(value.text, signals, unit);
    // in the order of the law, in which no path comes twice
    struct Part
    {
      std::function<double(const State &)> value;
      double                               factor;
    };
    std::vector<Part> parts;
    for (const auto &path : law.signals())
      for (const auto &[signal, probe] : found)
        if (signal.path == path)
          {
            parts.push_back({probe.value, factor_of_probe(probe.unit)});
            break;
          }
    const double size = Quantities::unit(unit).si;
    return {name, unit, [law, parts, size](const State &state) {
              std::vector<double> variables = {state.time};
              for (const auto &part : parts)
                variables.push_back(part.factor * part.value(state));
              return law.value(variables.data()) / size;
            }};
  }



  std::optional<Probe>
  ProbeQuantity::probe(const std::string &path) const
  {
    if (!path.empty())
      return {};
    return make();
  }



  std::vector<std::string>
  ProbeQuantity::probe_names() const
  {
    return {""};
  }
} // namespace samara
