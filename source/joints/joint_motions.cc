// What users say of the motions that a joint leaves free.

#include <samara/joints/joint.h>

#include <algorithm>

namespace samara
{
  void
  FreeMotion::add_parameters(Parameters &prm)
  {
    using dealii::Patterns::Double;
    const bool        turns = is_angle();
    const std::string what  = turns       ? "Angle" :
                              is_length() ? "Length" :
                                            "Displacement",
                      unit = turns ? "[rad]" : "[m]", stiffness = turns ? "[N*m/rad]" : "[N/m]",
                      none = " a stop is touched; not given: there is none " + unit + ".";
    prm.add("Spring", spring, "Stiffness " + stiffness + ".", Double(0));
    prm.add("Rest",
            rest,
            is_length() ? "Length without force; not given: that in the reference configuration [m]." :
                          what + " at which the spring is free of " + (turns ? "moment " : "force ") + unit + ".");
    prm.add(turns ? "Spring moment" : "Spring force",
            spring_law,
            std::string("With which a nonlinear spring pulls back: an expression of this motion alone, whose energy ") +
              "steps in time keep exactly " + (turns ? "[N*m]." : "[N]."));
    prm.add("Damper",
            damping,
            std::string("Viscous damping, not negative; an expression of time t and signals is a law of the ") +
              (turns ? "moment [N*m*s/rad]." : "force [N*s/m]."));
    prm.add("Lower stop", lower_stop, what + " below which" + none);
    prm.add("Upper stop", upper_stop, what + " above which" + none);
    stop.add_parameters(prm, "Stop ", turns);
    if (may_rub)
      friction.add_parameters(prm, true, turns);
    if (turns)
      {
        prm.add("Moment",
                force,
                "Moment on body B, its reaction on body A; an expression of time t and signals [N*m].");
        prm.add("Prescribed",
                prescribed,
                "Prescribed angle of B seen from A; an expression of time t and of states [rad].");
      }
    else if (is_length())
      {
        prm.add("Force", force, "Force that pushes the two points apart; an expression of time t and signals [N].");
        prm.add("Prescribed", prescribed, "Prescribed length; an expression of time t and of states [m].");
      }
    else
      {
        prm.add("Force", force, "Force on body B, its reaction on body A; an expression of time t and signals [N].");
        prm.add("Prescribed",
                prescribed,
                "Prescribed displacement of B seen from A; an expression of time t and of states [m].");
      }
  }



  void
  FreeMotion::check_parameters(const Parameters &prm, Complaints &complaints, const bool stops_at_ends)
  {
    is_prescribed  = prm.is_set("Prescribed");
    has_lower_stop = prm.is_set("Lower stop");
    has_upper_stop = prm.is_set("Upper stop");
    if (!has_lower_stop && !has_upper_stop && !stops_at_ends)
      ContactEntries::refuse_all(
        prm, "Stop ", "the " + name, "there is no stop; give a <Lower stop> or an <Upper stop>", complaints);
    if (prm.is_set("Rest") && !prm.is_set("Spring"))
      complaints.add(prm.where("Rest"),
                     "the " + name + ": <Rest> does nothing: it is that of a <Spring>, and there is none");
    if (may_rub)
      FrictionEntries::refuse_unused(prm, "the " + name, complaints);
    if (damping.is_constant())
      damper = damping.of_time()(0.);
    if (damper < 0)
      complaints.add(prm.where("Damper"), "the <Damper> of the " + name + " must not be negative");
    if ((has_lower_stop || has_upper_stop) && !stop.is_given())
      complaints.add(prm.where(prm.is_set("Stop stiffness") ? "Stop stiffness" :
                               has_upper_stop               ? "Upper stop" :
                                                              "Lower stop"),
                     "the stop of the " + name + " needs a <Stop stiffness> above zero");
    stop_law = stop.law(prm, "Stop ", "the stop of the " + name, complaints);
    if (friction.is_given())
      friction_law = friction.law(prm, "friction of the " + name, complaints);
    if (has_lower_stop && has_upper_stop && lower_stop >= upper_stop)
      complaints.add(prm.where("Upper stop"), "the <Upper stop> of the " + name + " must be above its <Lower stop>");
  }



  bool
  FreeMotion::is_used() const
  {
    return spring != 0 || !damping.is_zero() || !spring_law.is_zero() || !force.is_zero() || is_prescribed ||
           has_lower_stop || has_upper_stop || friction.is_given();
  }



  void
  Joint::check_friction(Model &model, const FreeMotion &motion)
  {
    const Parameters &prm      = parameters.subsection(motion.name);
    const auto        complain = [&](const std::string &entry, const std::string &text) {
      model.complaints.add(prm.where(entry), "joint <" + name + ">: " + text);
    };
    if (motion.is_angle() && motion.friction.radius == 0)
      complain("Friction", "the friction of the " + motion.name + " needs a <Friction radius> above zero");
    if (motion.friction.preload == 0 && std::none_of(locked.begin(), locked.end(), [](const Locked &l) {
          return l.function.kind == PairFunction::gap;
        }))
      complain("Friction",
               "nothing presses along the " + motion.name + ": there is no friction without a <Friction preload>");
  }



  void
  Joint::find_nonlinear_spring(Model &model, FreeMotion &motion)
  {
    const std::string own = name + "." + motion.name;
    try
      {
        if (motion.spring_law.signals() != std::vector<std::string>{own})
          throw std::invalid_argument("it must be an expression of <" + own +
                                      "> and of nothing else; other forces are a <" +
                                      (motion.is_angle() ? "Moment" : "Force") + ">.");
        motion.nonlinear_spring = std::make_unique<SpringLaw>(motion.spring_law.of_signal(), motion.reference);
      }
    catch (const std::invalid_argument &problem)
      {
        const std::string entry = motion.is_angle() ? "Spring moment" : "Spring force";
        model.complaints.add(parameters.subsection(motion.name).where(entry),
                             "<" + entry + "> of joint <" + name + ">: " + problem.what());
      }
  }
} // namespace samara
