#include <samara/analysis/check.h>
#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/model/contact_group.h>
#include <samara/solvers/redundant_rows.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace samara
{
  namespace
  {
    /** "model.prm:12: ", where a motion is prescribed that has a row in this combination. */
    std::string
    place_of_prescribed(const System &system, const Eigen::VectorXd &combination)
    {
      // below is round-off of the elimination that found the combination
      for (const auto &[coordinate, row] : system.model.prescribed)
        if (std::abs(combination(row)) > 1e-6 * combination.cwiseAbs().maxCoeff())
          return system.layout.owner_of_multiplier(row).parameters.where() + ": ";
      return "";
    }
  } // namespace



  std::vector<std::string>
  titles_of(const std::vector<const Item *> &items)
  {
    std::vector<std::string> titles;
    for (const auto *const item : items)
      titles.push_back(item->title());
    return titles;
  }



  std::string
  join_some(const std::vector<std::string> &names)
  {
    constexpr std::size_t          most = 6;
    const std::vector<std::string> some(names.begin(), names.begin() + std::min(most, names.size()));
    return join(some, ", ") + (names.size() > most ? " and " + std::to_string(names.size() - most) + " more" : "");
  }



  void
  require_couplings(const System &system, const bool for_statics)
  {
    for (const ContactGroup *group : system.layout.contact_groups)
      if (group->has_bristles() && !for_statics)
        throw InputError(group->item->parameters.where() + ": " + group->name +
                         " has bristles, which come and go with touches; the matrices of modes and linear systems do "
                         "not know them: they would be wrong. Take a <Sticking speed>, or single contacts");
      else if (!group->is_coupled)
        throw InputError(
          group->item->parameters.where() + ": " + group->name +
          " may touch in more pairs of nodes than the matrices of statics and modes hold (a thousand): make "
          "smaller groups, or let a damped motion come to rest");
  }



  void
  require_nearest_places(const System &system, const State &state)
  {
    for (const ContactGroup *group : system.layout.contact_groups)
      if (group->has_nearest_places())
        if (const std::string pair = group->without_nearest_places(state.q.data()); !pair.empty())
          throw NotConverged(group->item->parameters.where() + ": " + group->name + ": the nearest places of " + pair +
                             " are not determined, as where beams are parallel: there is no force between them that "
                             "could be told. Cross them by more than 0.01 rad");
  }



  void
  find_redundant(const System &system, ModelCheck &check)
  {
    State state = system.reference();
    state.left_out.clear();
    system.add_initial_velocities(state);
    RedundantRows rows(system);
    check.redundant_multipliers = rows.find(state);
    if (check.redundant_multipliers.empty())
      return;
    check.generic      = rows.generic_place();
    check.combinations = rows.combinations(check.generic);
    for (const int j : rows.contradictions(check.generic))
      check.contradictions.push_back(place_of_prescribed(system, check.combinations.col(j)) +
                                     "these constraints contradict each other: " + rows.names(check.combinations, j));
    for (const auto &loop : rows.loops(check.combinations))
      check.redundant.push_back(join_some(titles_of(loop.joints)) + ": " + std::to_string(loop.n_redundant) +
                                (loop.n_redundant == 1 ? " constraint says" : " constraints say") +
                                " what the others say already");
  }



  namespace
  {
    /** One line for all motions of the same bodies. */
    std::string
    list_of(const std::vector<std::string> &motions, const std::string &indent)
    {
      std::string text;
      for (auto motion = motions.begin(); motion != motions.end(); ++motion)
        {
          const auto n = std::count(motions.begin(), motions.end(), *motion);
          if (std::find(motions.begin(), motion, *motion) == motion)
            text += indent + "moving: " + *motion + (n > 1 ? " (" + std::to_string(n) + " motions)" : "");
        }
      return text;
    }
  } // namespace



  ModelCheck
  check_model(const System &system)
  {
    ModelCheck check;
    check.mass = system.mass_properties(system.reference());
    find_redundant(system, check);
    find_free_motions(system, check);
    return check;
  }



  std::string
  ModelCheck::text(const System &system, const std::string &file) const
  {
    const Layout         &layout = system.layout;
    const Eigen::IOFormat vector(8, 0, ", ", ", ", "", "", "(", ")"), rows(8, 0, ", ", "\n                    ");
    std::ostringstream    out;
    out << file << ": no mistakes found\n"
        << "  unknowns          " << layout.n_unknowns() << ": 6 for each of " << layout.n_nodes - 1 << " nodes, "
        << layout.n_coordinates << " joint coordinates, "
        << (layout.n_states > 0 ? std::to_string(layout.n_states) + " states of first order, " : "")
        << layout.n_multipliers << " multipliers (constraints)\n"
        << "  total mass        " << mass.mass << " kg\n"
        << "  centre of mass    " << mass.centre.transpose().format(vector) << " m\n"
        << "  inertia about it  " << mass.inertia.format(rows) << " kg m^2\n"
        << "  free motions      " << n_free_motions;
    out << list_of(free_motions, "\n                    ");
    if (!massless.empty())
      out << "\n  without inertia   " << massless.size() << list_of(massless, "\n                    ");
    out << "\n  redundant         " << redundant_multipliers.size();
    for (const auto &constraint : redundant)
      out << "\n                    " << constraint;
    return out.str();
  }



  std::string
  ModelCheck::free_motions_text() const
  {
    return "In the reference configuration " + std::to_string(n_free_motions) +
           (n_free_motions == 1 ? " motion is" : " motions are") +
           " free, those of steady rotations among them:" + list_of(free_motions, "\n    ");
  }



  std::string
  ModelCheck::massless_text() const
  {
    if (massless.empty())
      return "";
    return "Nothing determines how this moves, for it is free and has neither inertia nor damping:" +
           list_of(massless, "\n    ") +
           "\n    Give it an inertia (that of a section about its axis is <I2> + <I3>), or hold it";
  }



  std::string
  ModelCheck::redundancy_text() const
  {
    std::string text = std::to_string(redundant_multipliers.size()) +
                       (redundant_multipliers.size() == 1 ? " constraint is" : " constraints are") +
                       " redundant and left out; motions do not depend on it, reactions are not unique there:";
    for (const auto &loop : redundant)
      text += "\n    " + loop;
    return text;
  }



  std::string
  ModelCheck::complaint() const
  {
    std::string text;
    for (const auto &combination : contradictions)
      text += (text.empty() ? "" : "\n") + combination;
    return text +
           "\n  Not all of them can hold while prescribed motions go on: leave out one of these, or give a joint of the "
           "loop more freedom (spherical or cylindrical instead of revolute).";
  }



  std::string
  ModelCheck::complaint_about_laws(const System &system) const
  {
    const auto not_unique = [&](const auto &multipliers) {
      std::vector<unsigned int> rows;
      for (const unsigned int i : multipliers)
        for (int j = 0; j < combinations.cols(); ++j)
          if (std::abs(combinations(i, j)) > 1e-6 * combinations.col(j).cwiseAbs().maxCoeff() &&
              std::find(rows.begin(), rows.end(), i) == rows.end())
            rows.push_back(i);
      return rows;
    };
    const auto complaint = [&](const Item                      &place,
                               const std::string               &who,
                               const std::vector<unsigned int> &rows,
                               const std::string               &or_else) {
      std::vector<std::string> names;
      for (const unsigned int i : rows)
        names.push_back(system.layout.name_of_multiplier(i));
      return place.parameters.where() + ": " + who +
             " depends on forces that are not unique, because others could be in their place: " + join_some(names) +
             ". Give a joint of the loop more freedom (spherical or cylindrical instead of revolute), or " + or_else;
    };
    if (const auto rows = not_unique(system.layout.multipliers_in_laws); !rows.empty())
      return complaint(system.layout.owner_of_multiplier(rows.front()), "an expression", rows, "take another signal");
    for (const auto &friction : system.layout.frictions)
      if (const auto rows = not_unique(friction.multipliers); !rows.empty())
        return complaint(*friction.owner, friction.name, rows, "take away the joint that repeats it");
    return "";
  }



  bool
  ModelCheck::mark(std::vector<Probe> &probes) const
  {
    bool is_any = false;
    if (redundant_multipliers.empty())
      return is_any;
    for (auto &probe : probes)
      for (int j = 0; j < combinations.cols(); ++j)
        {
          State with = generic, without = generic;
          for (unsigned int i = 0; i < with.multipliers.size(); ++i)
            {
              without.multipliers[i] = 0;
              with.multipliers[i]    = combinations(i, j);
            }
          // combinations have entries of about one: a probe that sees them changes by as much
          if (std::abs(probe.value(with) - probe.value(without)) > 1e-6)
            {
              probe.unit += ", not unique";
              is_any = true;
              break;
            }
        }
    return is_any;
  }
} // namespace samara
