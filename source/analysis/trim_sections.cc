// Trim over a Q-th of the period: what is repeated, and whether it is.

#include <samara/analysis/trim_run.h>
#include <samara/base/errors.h>
#include <samara/base/text.h>

#include <cmath>
#include <stdexcept>

namespace samara
{
  namespace
  {
    /** What a section may differ by from one in which parts have changed places, in scales. */
    constexpr double allowed_asymmetry = 1e-6;

    /** What is more than that and an error of the steps falls at least so many times with half of the step. */
    constexpr double least_fall = 4;

    /** Of a section's turn: what turns by more must be named. */
    constexpr double share_of_turn = 0.5;
  } // namespace



  void
  TrimAnalysis::Run::use_symmetry(const State &moving)
  {
    const auto groups = groups_of_names(trim.symmetry);
    if (groups.empty())
      return;
    try
      {
        parts.reset();
        parts.emplace(system, groups, trim.turning);
        parts->align_as_built(moving);
        motion->repeat(*parts);
      }
    catch (const std::invalid_argument &problem)
      {
        throw InputError(trim.parameters.where("Symmetry") + ": " + problem.what());
      }
    require_turning(moving);
  }



  void
  TrimAnalysis::Run::require_turning(const State &moving) const
  {
    const double section = trim.period / parts->n(), turn = share_of_turn * 2 * M_PI / parts->n();
    const auto   check = [&](const std::string &name, const double speed) {
      if (const double angle = std::abs(std::remainder(speed * section, 2 * M_PI)); angle > turn)
        throw InputError(trim.parameters.where("Turning") + ": <" + name + "> turns by " +
                         number_to_text("%.4g", angle * 180 / M_PI) + " degrees in 1/" + std::to_string(parts->n()) +
                         " of the period, and is not repeated; name it among the <Turning>, with the joint that turns "
                           "it");
    };
    for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
      if (system.model.coordinate_units[i] == "rad" && parts->next_of_coordinate(i) == i &&
          !parts->coordinate_only_turns(i))
        check(system.model.coordinates[i], moving.rates[i]);
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      if (parts->next_of_node(node) == node && !parts->only_turns(node))
        check(system.model.nodes[node].name, Eigen::Map<const Vector3>(&moving.y[6 * node + 3]).norm());
  }



  namespace
  {
    /** By how much a section that begins as one from @p start to @p end with parts in each other's places ends
     * otherwise. */
    PeriodicMotion::Largest
    asymmetry_of(const System        &system,
                 const RepeatedParts &parts,
                 PeriodicMotion      &motion,
                 const State         &start,
                 const State         &end)
    {
      State behind = motion.in_next_section(start);
      motion.turn(behind);
      behind = parts.renumbered(parts.renumbered(behind));
      return motion.largest(increment(system, end, behind, true));
    }
  } // namespace



  void
  TrimAnalysis::Run::check_symmetry(const Look &first)
  {
    if (!parts)
      return;
    const auto largest = asymmetry_of(system, *parts, *motion, first.start, first.end);
    if (largest.size <= allowed_asymmetry)
      return;
    // joints choose axes of their constraints, and errors of steps depend on them
    const auto finer = make_motion(2 * trim.n_steps);
    finer->repeat(*parts);
    State end = first.start;
    finer->turn(end);
    const double      of_finer  = asymmetry_of(system, *parts, *finer, first.start, parts->renumbered(end)).size;
    const std::string different = "with the parts in each other's places the motion is different by " +
                                  number_to_text("%.1e", largest.size) + " after 1/" + std::to_string(parts->n()) +
                                  " of the period, most at " + motion->name_of(largest.entry) +
                                  ", and with half of the "
                                  "step by " +
                                  number_to_text("%.1e", of_finer);
    if (!(of_finer <= largest.size / least_fall))
      fail(
        "the <Symmetry> is none: " + different +
        ".\n  All parts must be alike, in the order in which they come round, and so must be what carries them, what "
        "acts on them, and their laws; if they are not, leave out the <Symmetry>");
    asymmetry = largest.size;
    context.log.warning("trim",
                        different +
                          ": so much of what is found is an error of the steps; more <Steps> make it smaller");
  }
} // namespace samara
