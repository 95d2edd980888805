#include <samara/analysis/check.h>
#include <samara/analysis/draw_shape.h>
#include <samara/analysis/finite_matrix.h>
#include <samara/analysis/modal.h>
#include <samara/analysis/mode_families.h>
#include <samara/analysis/mode_names.h>
#include <samara/analysis/moving_axes.h>
#include <samara/analysis/negative_directions.h>
#include <samara/analysis/prescribed_motion.h>
#include <samara/analysis/steady_loads.h>
#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/solvers/newton.h>
#include <samara/solvers/steady_motion.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace samara
{
  void
  ModalAnalysis::add_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    prm.add("Modes", n_modes, "Number of modes, those of lowest frequency.", Integer(1));
    prm.add(
      "Shift",
      shift,
      "Modes nearest to this real number are found; 0: those of lowest frequency, about a number found from the model "
      "[rad/s].");
    prm.add("Hold rotations",
            hold,
            "Whether joints in steady rotation keep their speed, or are free to follow the motion.");
    prm.add("Axes",
            axes,
            "Axes in which small motions are seen: turning with each body; fixed in space at the moment of the state; "
            "automatic: those in which coefficients are constant; where there are none, modes are refused.",
            Selection("automatic|turning|fixed"));
    prm.add(
      "Unsteady motion",
      unsteady,
      "Where parts do not turn steadily, as a universal joint on a bend, or where loads change as they turn, as a weight "
      "across a shaft: refuse, or allow, and find the modes of the moment, if it is known that little changes.",
      Selection("refuse|allow"));
    prm.add("Symmetry",
            symmetry,
            "Names of repeated parts in the order in which they come round, groups behind semicolons, as of a Floquet "
            "analysis: blade 1, blade 2; lag 1, lag 2. Modes have names by what these do.");
    prm.add("Animations", n_animations, "Number of modes for which a moving picture is written.", Integer(0));
  }



  ModalAnalysis::Steady
  ModalAnalysis::analyse(Context &context)
  {
    const System &system = context.system;
    OtherMotion   other;
    if (!context.is_equilibrium)
      {
        const std::vector<double> twists = context.state.y;
        set_steady_motion(system, context.state, context.speeds);
        // in a sweep the state before is that of the speed before
        if (twists != left)
          other = other_motion(system, context.state, twists);
        left = context.state.y;
        system.stresses(context.state, context.state.stress);
      }
    require_finite_state(system, context.state);
    const bool is_steady = check_motion(context);
    State      state     = context.state;
    check_equilibrium(system, state);
    state.held = hold;
    if (is_steady)
      check_loads(context, state);
    if (!state.left_out.empty())
      RedundantRows(system).choose(state);

    Linearization linearization(system, state);
    for (const auto *const A : {&linearization.M, &linearization.gyroscopic, &linearization.S})
      require_finite_matrix(system, *A);
    check_mass(system, linearization);
    try
      {
        const MovingAxes seen(system, state, linearization, axes);
        if (!seen.spins().empty())
          linearization = Linearization(system, state, seen.spins());
        find(context, linearization);
        check_other_motion(context, other);
        check_prescribed(context, state);
        check_axes(context, seen);
        return {state, seen.spins(), linearization};
      }
    catch (const SingularMatrix &singular)
      {
        throw NotConverged(
          "modal analysis: the matrix is singular at " +
          (singular.unknown < 0 ? std::string("an unknown") : system.layout.name_of(singular.unknown)) +
          ".\n  A constraint is there twice, or something has neither mass nor stiffness; or the <Shift> is an "
          "eigenvalue.");
      }
  }



  void
  ModalAnalysis::run(Context &context)
  {
    const Steady steady = analyse(context);
    name(context, steady);
    report(context);
    check_errors(context);
    tell_instability(context, steady);
    if (!context.sweep.empty())
      add_to_fan(context);
    if (context.pictures && context.is_shown() && !context.folder.empty())
      for (unsigned int k = 0; k < std::min<unsigned int>(n_animations, modes.size()); ++k)
        animate(context, k);
  }



  void
  ModalAnalysis::name_families(const Context &context)
  {
    if (context.system.model.rotations.empty())
      return;
    State turning = context.state; // at rest, too, flap is what it is in rotation
    set_steady_motion(context.system, turning, context.speeds_at(1.));
    const ModeNames by_content(context.system, turning);
    for (const auto &mode : modes)
      {
        contents.emplace_back();
        contents.back().family = by_content.of(mode);
      }
  }



  void
  ModalAnalysis::name(const Context &context, const Steady &steady)
  {
    contents.clear();
    const auto groups = groups_of_names(symmetry);
    if (groups.empty())
      {
        branches = tracking.follow(modes, steady.linearization.M);
        name_families(context);
        return;
      }
    try
      {
        const RepeatedParts parts(context.system, groups, {});
        separate_patterns(context.system, parts, steady.state, modes);
        branches = tracking.follow(modes, steady.linearization.M); // which puts equal modes in the order of branches
        contents = contents_of(context.system, parts, steady.state, modes);
      }
    catch (const std::invalid_argument &problem)
      {
        throw InputError(parameters.where("Symmetry") + ": " + problem.what());
      }
    if (!modes.empty() &&
        std::all_of(contents.begin(), contents.end(), [](const ModeContent &c) { return c.family.empty(); }))
      context.log.warning(
        "modal", "modes have no names by their content: the parts of the <Symmetry> do not turn about one axis");
  }



  bool
  ModalAnalysis::check_motion(const Context &context) const
  {
    State              turning = context.state;
    const SteadyMotion motion  = set_steady_motion(context.system, turning, context.speeds);
    if (motion.is_steady())
      return true;
    const std::string why =
      "parts do not turn steadily: " + why_not_steady(context.system, turning, context.speeds, motion);
    refuse_unsteady(context, why);
    return false;
  }



  ModalAnalysis::OtherMotion
  ModalAnalysis::other_motion(const System &system, const State &steady, const std::vector<double> &twists)
  {
    OtherMotion result;
    // nothing has moved yet: velocities at the start belong to a dynamic analysis
    if (std::all_of(twists.begin(), twists.end(), [](const double v) { return v == 0.; }))
      return result;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const auto spin_of = [&](const std::vector<double> &y) {
          return Eigen::Map<const Vector6>(&y[6 * node]).tail<3>();
        };
        const double difference = (spin_of(twists) - spin_of(steady.y)).norm();
        if (difference > result.spin)
          {
            const std::string unknown = system.layout.name_of(system.layout.of_node(node));
            result                    = {difference, unknown.substr(0, unknown.rfind(", "))};
          }
      }
    return result;
  }



  void
  ModalAnalysis::check_other_motion(const Context &context, const OtherMotion &other) const
  {
    constexpr double allowed = 1e-3; // of a mode's frequency: what gyroscopic terms of that spin change
    for (const auto &mode : modes)
      if (mode.frequency() > 0 && other.spin > allowed * mode.frequency())
        {
          const std::string why = "the state before moves otherwise than steadily, " + other.place + " turns with " +
                                  short_text(other.spin) + " rad/s more or less than the rotations of the model say";
          if (unsteady == "refuse")
            refuse_unsteady(context, why);
          return context.log.warning("modal", why + "; modes have no gyroscopic terms of that");
        }
  }



  void
  ModalAnalysis::check_prescribed(const Context &context, const State &state) const
  {
    constexpr double    allowed = 1e-6; // of a mode's frequency
    std::vector<double> times   = times_to_look(state);
    const bool          turns   = !times.empty();
    times.insert(times.begin(), 0.);
    double slowest = std::numeric_limits<double>::infinity();
    for (const auto &mode : modes)
      if (mode.frequency() > 0)
        {
          slowest = std::min(slowest, mode.frequency());
          times.insert(times.end(), {1. / mode.frequency(), 2.4 / mode.frequency()});
        }
    const PrescribedMotion other = prescribed_beside(context.system, state, times);
    if (!(other.rate > allowed * slowest))
      return;
    const std::string why =
      "<" + other.name + "> is prescribed to move, with up to " + short_text(other.rate) +
      (turns ? " rad/s, beside the steady rotation" : " rad/s or lengths of the model per second");
    if (turns)
      refuse_unsteady(context, why);
    else
      context.log.line("  modal: " + why + "; modes are those while it is held where it is");
  }



  void
  ModalAnalysis::check_loads(const Context &context, const State &state) const
  {
    const ChangingLoads loads = changing_loads(context.system, state);
    if (loads.change_modes())
      refuse_unsteady(context, loads.text());
  }



  void
  ModalAnalysis::refuse_unsteady(const Context &context, const std::string &why) const
  {
    if (unsteady == "refuse")
      throw InputError(
        (parameters.where().empty() ? "" : parameters.where() + ": ") + "modal analysis: " + why +
        ".\n  Modes belong to a motion that stays as it is. If they are wanted for the moment nevertheless, set "
        "Unsteady motion = allow in subsection Modal.");
    context.log.line("  modal: " + why + "; modes are those of this moment");
  }



  void
  ModalAnalysis::check_equilibrium(const System &system, State &state) const
  {
    Imbalance imbalance;
    try
      {
        imbalance = balance_stresses(system, state);
      }
    catch (const SingularMatrix &)
      {
        return; // find() says where
      }
    if (imbalance.is_large())
      throw NotConverged(
        "modal analysis: the state is not an equilibrium: loads or inertia forces act that its stresses do not "
        "balance.\n  Modes would be those of a state that does not last. Find the equilibrium first: set Analyses = "
        "static, modal.");
  }



  void
  ModalAnalysis::check_mass(const System &system, const Linearization &linearization) const
  {
    const auto &values      = linearization.M.values;
    const bool  is_massless = std::all_of(values.begin(), values.end(), [](const double m) { return m == 0.; });
    if (is_massless && system.layout.n_states == 0)
      throw NotConverged(
        "modal analysis: nothing that can move has mass.\n  Give the sections a density or mass, or the "
        "rigid bodies a mass.");
  }



  void
  ModalAnalysis::find(const Context &context, const Linearization &linearization)
  {
    const Modes result = find_modes(linearization, n_modes, shift == 0. ? std::optional<double>() : shift);
    modes              = result.found;
    if (result.is_all)
      context.log.line("  modal: only " + std::to_string(modes.size()) + " of " + std::to_string(n_modes) +
                       " modes are there: no other motion moves mass, or all lie a million times higher");
  }



  namespace
  {
    /** How modes of a moment differ from those of others; empty if they do not. */
    std::string
    text_of_changes(const std::vector<Mode> &modes, const std::vector<double> &changes)
    {
      unsigned int n = 0, most = 0;
      for (unsigned int i = 0; i < modes.size(); ++i)
        // what the estimate of the error allows is no change (doc/theory/modes.md, parts that turn against each other)
        if (!(changes[i] <= 1e-5 + 10 * modes[i].error))
          {
            ++n;
            if (!(changes[i] <= changes[most]))
              most = i;
          }
      if (n == 0)
        return "";
      return std::to_string(n) + " of " + std::to_string(modes.size()) + " modes of this moment do not last: mode " +
             std::to_string(most + 1) + " at " + short_text(modes[most].frequency()) + " rad/s changes " +
             (changes[most] < 1 ? "by up to " + number_to_text("%.2g", 100 * changes[most]) + " %" :
                                  "by more than itself");
    }
  } // namespace



  void
  ModalAnalysis::check_axes(const Context &context, const MovingAxes &seen) const
  {
    if (!seen.are_looked_at())
      return;
    const std::string of_modes = text_of_changes(modes, seen.changes(modes)), of_all = seen.text_of_change();
    if (of_modes.empty() && of_all.empty())
      {
        context.log.line("  modal: coefficients are constant in " + seen.text());
        return;
      }
    const std::string why = of_all + (of_all.empty() || of_modes.empty() ? "" : "; ") + of_modes;
    if (axes != "automatic")
      context.log.warning("modal", why);
    else if (unsteady == "refuse")
      throw InputError(
        (parameters.where().empty() ? "" : parameters.where() + ": ") + "modal analysis: " + why +
        ".\n  Coefficients are periodic: there are no modes, but multipliers of a periodic motion, which Analyses = floquet "
        "finds. For modes of this moment set Axes = turning or Axes = fixed in subsection Modal, or Unsteady motion = "
        "allow for axes in which least changes.");
    else
      context.log.line("  modal: " + why + "; modes are those of this moment in " + seen.text());
  }



  void
  ModalAnalysis::check_errors(const Context &context) const
  {
    for (unsigned int i = 0; i < modes.size(); ++i)
      {
        const std::string text = "mode " + std::to_string(i + 1) + " at " + short_text(modes[i].frequency()) +
                                 " rad/s has an estimated error of " + short_text(100 * modes[i].error) + " %";
        // beyond 1 % a mode is no result; above 1e-6, where 1e-14 is usual, the model is worth a look
        if (!(modes[i].error < 1e-2))
          throw NotConverged(
            "modal analysis: " + text +
            ".\n  It is lost in round-off. Set the <Shift> to about its frequency, ask for fewer modes, or "
            "look for stiffnesses and masses that differ by many orders of magnitude.");
        if (modes[i].error > 1e-6)
          context.log.warning("modal", text + "; set the <Shift> to about its frequency, or ask for fewer modes");
      }
  }



  namespace
  {
    /** "modes 1, 2 grow, the fastest by 2.7 in 0.4 s", far above round-off; empty if none does. */
    std::string
    text_of_growth(const std::vector<Mode> &modes)
    {
      std::vector<std::string> numbers;
      double                   fastest = 0;
      for (unsigned int i = 0; i < modes.size(); ++i)
        if (const double size = std::abs(modes[i].lambda);
            modes[i].lambda.real() > std::max(1e-7, 100 * modes[i].error) * size)
          {
            numbers.push_back(std::to_string(i + 1));
            fastest = std::max(fastest, modes[i].lambda.real());
          }
      if (numbers.empty())
        return "";
      return (numbers.size() > 1 ? "modes " + join_some(numbers) + " grow" : "mode " + numbers[0] + " grows") +
             " by a factor of 2.718 in " + short_text(1 / fastest) + " s";
    }
  } // namespace



  void
  ModalAnalysis::tell_instability(const Context &context, const Steady &steady) const
  {
    State held                        = steady.state;
    held.held                         = true;
    const NegativeDirections negative = negative_directions(context.system, held);
    const std::string        growth   = text_of_growth(modes),
                      at              = context.sweep.empty() ? "" : "at " + short_text(context.speeds[0]) + " rad/s ";
    if (negative.number == 0 && growth.empty())
      return;
    if (negative.number == 0)
      return context.log.warning("modal", at + "the state is unstable, though not by its stiffness: " + growth);
    const std::string text = at + negative.text(context.system);
    if (!growth.empty())
      context.log.warning("modal", text + "; " + growth);
    else if (negative.are_unstable())
      context.log.warning("modal",
                          text + "; the motion that grows is not among these modes: ask for more, or set the <Shift>");
    else
      context.log.line("  modal: " + text + "; none of these modes grows" +
                       (negative.turning == NegativeDirections::Turning::as_one ?
                          ": gyroscopic forces hold those in which it is negative" :
                          ""));
  }



  void
  ModalAnalysis::add_to_fan(const Context &context)
  {
    if (!fan)
      fan = std::make_unique<Table>(std::vector<std::string>{"speed [rad/s]",
                                                             "branch",
                                                             "frequency [rad/s]",
                                                             "damping ratio",
                                                             "real [1/s]",
                                                             "imaginary [rad/s]",
                                                             "family",
                                                             "pattern"});
    for (unsigned int i = 0; i < modes.size(); ++i)
      fan->add_row({context.speeds[0],
                    branches[i],
                    modes[i].frequency(),
                    modes[i].damping_ratio(),
                    modes[i].lambda.real(),
                    modes[i].lambda.imag(),
                    contents.empty() ? "" : contents[i].family,
                    contents.empty() ? "" : contents[i].pattern});
  }



  std::vector<std::pair<std::string, double>>
  participation(const System &system, const Mode &mode)
  {
    std::map<std::string, double> energy;
    double                        total = 0;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const Eigen::Matrix<std::complex<double>, 6, 1> z = mode.shape.segment<6>(system.layout.of_node(node));
        const double e = (z.adjoint() * system.model.nodes[node].inertia * z)(0, 0).real();
        energy[system.model.nodes[node].name] += e;
        total += e;
      }
    std::vector<std::pair<std::string, double>> shares;
    for (const auto &[name, e] : energy)
      shares.emplace_back(name, total > 0 ? e / total : 0.);
    std::sort(shares.begin(), shares.end(), [](const auto &a, const auto &b) { return a.second > b.second; });
    return shares;
  }



  void
  ModalAnalysis::report(Context &context) const
  {
    Table table({"mode",
                 "frequency [rad/s]",
                 "frequency [Hz]",
                 "damping ratio",
                 "real [1/s]",
                 "imaginary [rad/s]",
                 "estimated relative error",
                 "family",
                 "share of family",
                 "pattern",
                 "share of pattern"});
    for (unsigned int i = 0; i < modes.size(); ++i)
      {
        const Mode       &m       = modes[i];
        const ModeContent content = contents.empty() ? ModeContent() : contents[i];
        table.add_row({i + 1,
                       m.frequency(),
                       m.frequency() / (2 * M_PI),
                       m.damping_ratio(),
                       m.lambda.real(),
                       m.lambda.imag(),
                       m.error,
                       content.family,
                       content.family_share,
                       content.pattern,
                       content.pattern_share});
        std::ostringstream line;
        line << "  mode " << i + 1 << ": ";
        if (m.is_free())
          line << "0 rad/s, a free motion  (";
        else
          line << short_text(m.frequency()) << " rad/s, damping ratio "
               << short_text(std::abs(m.damping_ratio()) < 10 * m.error + 1e-10 ? 0. : m.damping_ratio()) << "  (";
        if (!content.family.empty())
          line << content.family << (content.pattern.empty() ? "" : ", ") << content.pattern << "; ";
        // the first, and up to two others with 2 % and more
        const auto shares = participation(context.system, m);
        for (unsigned int k = 0; k < std::min<unsigned int>(3, shares.size()) && (k == 0 || shares[k].second > 0.02);
             ++k)
          line << (k > 0 ? ", " : "") << shares[k].first << " " << std::lround(100 * shares[k].second) << " %";
        context.log.line(line.str() + ")");
      }
    if (context.folder.empty())
      return;
    if (!context.sweep.empty())
      table.write(context.folder + "/modes_" + short_text(context.speeds[0]) + ".csv");
    if (context.is_shown())
      table.write(context.folder + "/modes.csv");
  }



  void
  ModalAnalysis::animate(const Context &context, const unsigned int k) const
  {
    const double period = modes[k].lambda.imag() > 0 ? 2 * M_PI / modes[k].lambda.imag() : 1.;
    draw_shape(context.system, context.state, modes[k].shape, period, context.folder, "mode_" + std::to_string(k + 1));
  }



  void
  ModalAnalysis::finish(Context &context)
  {
    if (fan && !context.folder.empty())
      fan->write(context.folder + "/fan.csv");
  }
} // namespace samara
