#include <samara/analysis/check.h>
#include <samara/analysis/finite_matrix.h>
#include <samara/analysis/modal.h>
#include <samara/analysis/mode_families.h>
#include <samara/analysis/mode_names.h>
#include <samara/analysis/moving_axes.h>
#include <samara/analysis/progress.h>
#include <samara/base/errors.h>
#include <samara/solvers/newton.h>
#include <samara/solvers/steady_motion.h>

#include <algorithm>

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

    const auto linearized = [&](const std::vector<Vector3> &spins) {
      const Progress progress(context.log,
                              "modal",
                              "linearised motion of " + std::to_string(system.size()) + " unknowns",
                              context.page);
      return Linearization(system, state, spins);
    };
    Linearization linearization = linearized({});
    for (const auto *const A : {&linearization.M, &linearization.gyroscopic, &linearization.S})
      require_finite_matrix(system, *A);
    check_mass(system, linearization);
    try
      {
        const MovingAxes seen(system, state, linearization, axes);
        if (!seen.spins().empty())
          linearization = linearized(seen.spins());
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
    if (!context.folder.empty())
      animate(context);
  }



  namespace
  {
    /** A state with the rotations of the model: at rest, too, flap is what it is in rotation, and waves go round. */
    State
    with_rotations(const Context &context, State state)
    {
      set_steady_motion(context.system, state, context.speeds_at(1.));
      return state;
    }
  } // namespace



  void
  ModalAnalysis::name_families(const Context &context)
  {
    if (context.system.model.rotations.empty())
      return;
    const ModeNames by_content(context.system, with_rotations(context, context.state));
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
        if (!context.system.model.rotations.empty())
          find_left_vectors(steady.linearization, modes);
        name_families(context);
        return;
      }
    try
      {
        const RepeatedParts parts(context.system, groups, {});
        const bool          at_rest =
          std::all_of(context.speeds.begin(), context.speeds.end(), [](const double speed) { return speed == 0.; });
        const State seen = at_rest ? with_rotations(context, steady.state) : steady.state;
        separate_patterns(context.system, parts, seen, modes);
        branches = tracking.follow(modes, steady.linearization.M); // which puts equal modes in the order of branches
        find_left_vectors(steady.linearization, modes);
        contents = contents_of(context.system, parts, seen, modes);
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



  void
  ModalAnalysis::find(const Context &context, const Linearization &linearization)
  {
    const auto found = [&]() {
      Progress progress(context.log, "modal", std::to_string(n_modes) + " modes", context.page);
      return find_modes(linearization, n_modes, shift == 0. ? std::optional<double>() : shift, progress.teller());
    };
    const Modes result = found();
    modes              = result.found;
    if (result.is_all)
      context.log.line("  modal: only " + std::to_string(modes.size()) + " of " + std::to_string(n_modes) +
                       " modes are there: no other motion moves mass, or all lie a million times higher");
  }
} // namespace samara
