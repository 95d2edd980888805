#include <samara/base/text.h>
#include <samara/joints/contact_entries.h>

#include <cctype>
#include <cmath>

namespace samara
{
  std::string
  ContactEntries::name(const std::string &prefix, const std::string &what)
  {
    std::string result = prefix + what;
    result[0]          = std::toupper(result[0]);
    return result;
  }



  std::string
  ContactEntries::speed_name(const std::string &prefix)
  {
    return prefix.empty() ? "Impact speed" : name(prefix, "speed");
  }



  void
  ContactEntries::refuse_all(const Parameters  &prm,
                             const std::string &prefix,
                             const std::string &whose,
                             const std::string &why,
                             Complaints        &complaints)
  {
    for (const std::string &entry : {name(prefix, "stiffness"),
                                     name(prefix, "damping"),
                                     name(prefix, "exponent"),
                                     name(prefix, "restitution"),
                                     speed_name(prefix),
                                     name(prefix, "force")})
      if (prm.is_set(entry))
        complaints.add(prm.where(entry), whose + ": <" + entry + "> does nothing: " + why);
  }



  void
  ContactEntries::add_parameters(Parameters &prm, const std::string &prefix, const bool turns)
  {
    using dealii::Patterns::Double;
    const bool        is_stop = !prefix.empty();
    const std::string of = is_stop ? "of the stops" : "of the contact", k = turns ? "[N*m/rad]" : "[N/m]",
                      damping_s = turns ? "[N*m*s/rad]" : "[N*s/m]";
    prm.add(name(prefix, "stiffness"),
            stiffness,
            "Stiffness k " + of + ": the " + (turns ? "moment is k g (g/1 rad)^(n-1)" : "force is k g (g/1 m)^(n-1)") +
              " of the penetration g, n the exponent " + k + ".",
            Double(0));
    prm.add(name(prefix, "damping"),
            damping,
            "Viscous damping while " + std::string(is_stop ? "a stop" : "it") + " is touched " + damping_s + ".",
            Double(0));
    prm.add(name(prefix, "exponent"), exponent, "Exponent n of the force: 1 linear, 1.5 Hertz [1].", Double(1));
    prm.add(name(prefix, "restitution"),
            restitution,
            std::string("Part of its speed with which a body alone leaves; the damping of Hunt and Crossley that ") +
              "does it at the " + (is_stop ? "stop" : "impact") + " speed; 1: none [1].",
            Double(0, 1));
    prm.add(speed_name(prefix),
            speed,
            std::string("Speed of the impact at which the restitution holds ") + (turns ? "[rad/s]." : "[m/s]."),
            Double(0));
    prm.add(name(prefix, "force"),
            force,
            std::string("In place of stiffness and exponent: ") + (turns ? "moment" : "force") +
              " as an expression of the penetration s, zero at s = 0 " + (turns ? "[N*m]." : "[N]."));
  }



  ContactLaw
  ContactEntries::by_expression(const Parameters  &prm,
                                const std::string &prefix,
                                const std::string &whose,
                                Complaints        &complaints) const
  {
    const std::string entry = name(prefix, "force");
    ContactLaw        law;
    for (const std::string what : {"stiffness", "exponent"})
      if (prm.is_set(name(prefix, what)))
        complaints.add(prm.where(name(prefix, what)),
                       whose + ": <" + name(prefix, what) + "> has no place beside a <" + entry + ">");
    // a jump at the touch would be a force of the sign of round-off; one that pulls is no contact
    const double reference = std::abs(force(1e-3));
    if (std::abs(force(0)) > 1e-9 * reference)
      complaints.add(prm.where(entry), whose + ": the <" + entry + "> must be zero at s = 0, where the contact begins");
    for (const double s : {1e-9, 1e-6, 1e-4, 1e-3, 1e-2})
      if (!(force(s) >= 0))
        {
          complaints.add(prm.where(entry),
                         whose + ": the <" + entry + "> pulls at s = " + number_to_text(s) +
                           "; positive is what presses against the penetration");
          break;
        }
    law.expression = std::make_shared<const SpringLaw>(force, 0.);
    return law;
  }



  ContactLaw
  ContactEntries::law(const Parameters  &prm,
                      const std::string &prefix,
                      const std::string &whose,
                      Complaints        &complaints) const
  {
    const std::string speed_entry = speed_name(prefix), restitution_entry = name(prefix, "restitution");
    ContactLaw        law;
    if (prm.is_set(speed_entry) && !prm.is_set(restitution_entry))
      complaints.add(prm.where(speed_entry),
                     whose + ": <" + speed_entry + "> does nothing: it is that at which a <" + restitution_entry +
                       "> holds, and none is given");
    if (!force.is_zero())
      law = by_expression(prm, prefix, whose, complaints);
    law.stiffness = stiffness;
    law.exponent  = exponent;
    law.damping   = damping;
    if (restitution == 1)
      return law;
    if (restitution == 0)
      complaints.add(prm.where(restitution_entry),
                     whose + ": a <" + restitution_entry +
                       "> of zero would need an infinite damping; a small one, or <" + name(prefix, "damping") +
                       ">, is possible");
    else if (speed == 0)
      complaints.add(prm.where(restitution_entry),
                     whose + ": the <" + restitution_entry + "> holds at some <" + speed_entry +
                       ">, which must be given, above zero");
    else
      law.factor = hunt_crossley_factor(restitution, speed);
    return law;
  }



  void
  FrictionEntries::add_parameters(Parameters &prm, const bool with_preload, const bool turns)
  {
    using dealii::Patterns::Double;
    prm.add("Friction", kinetic, "Coefficient of dry friction while it slips [1].", Double(0));
    prm.add("Static friction", breakaway, "Coefficient at which slip begins; not given: that of slip [1].", Double(0));
    prm.add("Stribeck speed", stribeck_speed, "Slip at which the one goes over into the other [m/s].", Double(0));
    prm.add("Sticking speed",
            sticking_speed,
            "Slip below which friction is proportional to it; what should stick creeps with a part of it [m/s].",
            Double(0));
    prm.add("Bristle stiffness",
            bristle_stiffness,
            "Of bristles that bend until they slip, in place of a sticking speed: what sticks does not creep [N/m].",
            Double(0));
    prm.add("Bristle damping", bristle_damping, "Of bristles that bend [N*s/m].", Double(0));
    if (turns)
      prm.add("Friction radius", radius, "Arm of the friction: the radius of the pin [m].", Double(0));
    if (with_preload)
      prm.add("Friction preload", preload, "Force that presses besides the reactions of the joint [N].", Double(0));
  }



  void
  FrictionEntries::refuse_unused(const Parameters               &prm,
                                 const std::string              &whose,
                                 Complaints                     &complaints,
                                 const std::vector<std::string> &more,
                                 const std::string              &but)
  {
    if (prm.is_set("Friction") || prm.is_set("Static friction"))
      return;
    std::vector<std::string> entries = {"Stribeck speed",
                                        "Sticking speed",
                                        "Bristle stiffness",
                                        "Bristle damping",
                                        "Friction radius",
                                        "Friction preload"};
    entries.insert(entries.end(), more.begin(), more.end());
    for (const auto &entry : entries)
      if (entry != but && prm.has(entry) && prm.is_set(entry))
        complaints.add(prm.where(entry),
                       whose + ": <" + entry +
                         "> does nothing: it is for friction, and there is none; give a <Friction>");
  }



  FrictionLaw
  FrictionEntries::law(const Parameters &prm, const std::string &whose, Complaints &complaints) const
  {
    FrictionLaw law;
    law.kinetic           = kinetic;
    law.breakaway         = prm.is_set("Static friction") ? breakaway : kinetic;
    law.stribeck_speed    = stribeck_speed > 0 ? stribeck_speed : 1;
    law.sticking_speed    = sticking_speed;
    law.bristle_stiffness = bristle_stiffness;
    law.bristle_damping   = bristle_damping;
    if (prm.is_set("Bristle stiffness") && bristle_stiffness == 0)
      complaints.add(prm.where("Bristle stiffness"), whose + ": the <Bristle stiffness> must be above zero");
    else if (bristle_damping > 0 && bristle_stiffness == 0)
      complaints.add(prm.where("Bristle damping"), whose + ": a <Bristle damping> needs a <Bristle stiffness>");
    if (law.has_bristles())
      {
        if (prm.is_set("Sticking speed"))
          complaints.add(prm.where("Sticking speed"),
                         whose + ": bristles stick; the <Sticking speed> has no place beside a <Bristle stiffness>");
        law.sticking_speed = 0;
      }
    else if (sticking_speed == 0)
      complaints.add(prm.where("Sticking speed"), whose + ": the <Sticking speed> must be above zero");
    if (prm.is_set("Stribeck speed") && !prm.is_set("Static friction"))
      complaints.add(prm.where("Stribeck speed"),
                     whose +
                       ": the <Stribeck speed> does nothing: it leads from a <Static friction> to the <Friction>, and "
                       "none is given");
    if (law.breakaway < law.kinetic)
      complaints.add(prm.where("Static friction"),
                     whose + ": the <Static friction> must not be below the <Friction> of what slips");
    else if (law.breakaway > law.kinetic)
      {
        if (stribeck_speed == 0)
          complaints.add(prm.where("Static friction"),
                         whose + ": a <Static friction> above the <Friction> needs a <Stribeck speed> above zero");
        else if (!law.has_bristles() && stribeck_speed < 10 * sticking_speed)
          complaints.add(prm.where("Stribeck speed"),
                         whose + ": the <Stribeck speed> must be ten times the <Sticking speed> at least, or the peak "
                                 "of the friction is lost; a hundred times is better");
      }
    return law;
  }
} // namespace samara
