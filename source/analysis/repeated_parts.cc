#include <samara/analysis/repeated_parts.h>
#include <samara/base/dense.h>
#include <samara/base/text.h>
#include <samara/solvers/newton.h>
#include <samara/time/increment.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

namespace samara
{
  std::vector<std::vector<std::string>>
  groups_of_names(const std::string &text)
  {
    std::vector<std::vector<std::string>> result;
    if (!trim(text).empty())
      for (const auto &group : split_top_level(text, ';'))
        {
          result.emplace_back();
          for (const auto &name : split_top_level(group, ','))
            result.back().push_back(trim(name));
        }
    return result;
  }



  namespace
  {
    /** Where @p part stands in @p name as a word of its own, "blade 1" not in "blade 10"; npos: nowhere. */
    std::size_t
    find_word(const std::string &name, const std::string &part)
    {
      const auto is_of_word = [&](const std::size_t i) {
        return i < name.size() && std::isalnum(static_cast<unsigned char>(name[i]));
      };
      for (auto at = name.find(part); at != std::string::npos; at = name.find(part, at + 1))
        if ((at == 0 || !is_of_word(at - 1)) && !is_of_word(at + part.size()))
          return at;
      return std::string::npos;
    }



    /** Whether a node or a coordinate, "hub" or "shaft.rotation", is of the object @p part, or in the subsystem. */
    bool
    is_of_object(const std::string &name, const std::string &part)
    {
      const std::string owner = name.substr(0, name.find('.')); // names of objects have no dot
      return owner == part || owner.compare(0, part.size() + 1, part + subsystem_separator) == 0;
    }



    /** What is called by names: nodes, of which several have one name, coordinates, states. */
    struct Named
    {
      std::vector<std::string>                         names;
      std::map<std::string, std::vector<unsigned int>> by_name;

      explicit Named(const std::vector<std::string> &names)
        : names(names)
      {
        for (unsigned int i = 0; i < names.size(); ++i)
          by_name[names[i]].push_back(i);
      }
    };



    using Groups = std::vector<std::vector<std::string>>;

    /** The name with the next part in place of one; empty if no part is in it. Longer names of parts go first. */
    std::string
    next_name(const std::string &name, const Groups &groups, std::set<std::string> &seen)
    {
      std::string part, next;
      for (const auto &group : groups)
        for (unsigned int k = 0; k < group.size(); ++k)
          if (group[k].size() > part.size() && find_word(name, group[k]) != std::string::npos)
            {
              part = group[k];
              next = group[(k + 1) % group.size()];
            }
      if (part.empty())
        return "";
      seen.insert(part);
      std::string result = name;
      return result.replace(find_word(name, part), part.size(), next);
    }



    /** What each becomes. @throws std::invalid_argument for one without counterpart. */
    std::vector<unsigned int>
    successors(const Named &all, const Groups &groups, std::set<std::string> &seen, const std::string &noun)
    {
      std::vector<unsigned int> result(all.names.size());
      for (const auto &[name, numbers] : all.by_name)
        {
          const std::string next = next_name(name, groups, seen);
          if (next.empty())
            {
              for (const auto i : numbers)
                result[i] = i;
              continue;
            }
          const auto of_next = all.by_name.find(next);
          if (of_next == all.by_name.end() || of_next->second.size() != numbers.size())
            throw std::invalid_argument(
              noun + " of <" + name + "> should become that of <" + next + ">, which has " +
              (of_next == all.by_name.end() ? "none" : std::to_string(of_next->second.size())) + " in place of " +
              std::to_string(numbers.size()) +
              (noun == "a coordinate" ?
                 "; if only a probe or a law asks for it, ask for those of all parts" :
                 "; are parts welded to each other? Then what joins them should stand before them "
                 "in the file"));
          for (unsigned int k = 0; k < numbers.size(); ++k)
            result[numbers[k]] = of_next->second[k];
        }
      return result;
    }



    template <typename Things>
    std::vector<std::string>
    names_of(const Things &things)
    {
      std::vector<std::string> names;
      for (const auto &thing : things)
        names.push_back(thing.name);
      return names;
    }



    /** Angle of @p R to the nearest multiple of @p part, with its axis. */
    Vector3
    rotation_beyond_parts(const Matrix3 &R, const double part)
    {
      const Vector3 r     = vector_of_rotation(R);
      const double  angle = r.norm();
      return angle > 0 ? Vector3(r / angle * std::remainder(angle, part)) : Vector3::Zero();
    }
  } // namespace



  RepeatedParts::RepeatedParts(const System &system)
    : RepeatedParts(system, {}, {})
  {}



  RepeatedParts::RepeatedParts(const System &system, const Groups &groups, const std::vector<std::string> &turning)
    : system(system)
    , node_turns(system.layout.n_nodes, false)
    , coordinate_turns(system.layout.n_coordinates, false)
    , turns_by(system.layout.n_coordinates, 0.)
    , axes(system.layout.n_nodes, Matrix3::Identity())
  {
    for (const auto &group : groups)
      if (group.size() < 2 || group.size() != groups[0].size())
        throw std::invalid_argument("all groups of repeated parts must have the same number of names, two or more");
    if (!groups.empty())
      n_parts = groups[0].size();
    std::set<std::string> seen;
    const Named           nodes(names_of(system.model.nodes)), coordinates(system.model.coordinates);
    node_becomes       = successors(nodes, groups, seen, "a node");
    coordinate_becomes = successors(coordinates, groups, seen, "a coordinate");
    state_becomes      = successors(Named(names_of(system.model.states)), groups, seen, "a state");
    for (const auto &group : groups)
      for (const auto &part : group)
        if (seen.count(part) == 0)
          throw std::invalid_argument("nothing that moves belongs to <" + part + ">" + did_you_mean(part, nodes.names));

    for (unsigned int i = 0; i < node_becomes.size(); ++i)
      node_turns[i] = node_becomes[i] != i;
    for (const auto &part : turning)
      find_turning(part);
  }



  void
  RepeatedParts::find_turning(const std::string &part)
  {
    std::vector<std::string> nodes = names_of(system.model.nodes), coordinates = system.model.coordinates;
    const auto               is_its_own = [&](const std::string &name) { return is_of_object(name, part); };
    // <plate> is the plate and what is in the subsystem of that name; only if nothing is called so, the <swash plate>
    const bool has_owner = std::any_of(nodes.begin() + 1, nodes.end(), is_its_own) ||
                           std::any_of(coordinates.begin(), coordinates.end(), is_its_own);
    const auto is_meant = [&](const std::string &name) {
      return has_owner ? is_its_own(name) : find_word(name, part) != std::string::npos;
    };
    bool is_known = false;
    for (unsigned int i = 1; i < nodes.size(); ++i)
      if (is_meant(nodes[i]))
        node_turns[i] = is_known = true;
    for (unsigned int i = 0; i < coordinates.size(); ++i)
      if (is_meant(coordinates[i]))
        {
          is_known            = true;
          coordinate_turns[i] = system.model.coordinate_units[i] == "rad"; // what slides does not turn
        }
    if (!is_known)
      throw std::invalid_argument("nothing that moves is called <" + part + ">" + did_you_mean(part, nodes));
  }



  void
  RepeatedParts::align(const State &start, const State &end)
  {
    for (unsigned int node = 1; node < axes.size(); ++node)
      if (node_turns[node])
        axes[node] = start.triad(node_becomes[node]).transpose() * end.triad(node);
  }



  Matrix3
  RepeatedParts::turn_as_built(const State &moving) const
  {
    const auto &nodes  = system.model.nodes;
    Vector3     centre = Vector3::Zero();
    double      n      = 0;
    for (unsigned int i = 1; i < nodes.size(); ++i)
      if (node_becomes[i] != i)
        {
          centre += nodes[i].x;
          ++n;
        }
    centre /= std::max(n, 1.);
    const Vector3 spin = spin_of_parts(moving);
    Matrix3 H = Matrix3::Zero();
    for (unsigned int i = 1; i < nodes.size(); ++i)
      if (node_becomes[i] != i)
        H += (nodes[i].x - centre) * (nodes[node_becomes[i]].x - centre).transpose();
    SingularValues svd   = singular_values(H);
    const Vector3  sizes = svd.sizes;
    if (sizes(1) < 1e-6 * sizes(0) || !(sizes(0) > 0))
      {
        // all on one line, as two straight blades: what they turn about tells the rest
        const Vector3 line = svd.U.col(0), across = spin - line * line.dot(spin);
        if (!(across.norm() > 0) || !(sizes(0) > 0))
          throw std::invalid_argument("nothing tells how one part comes to the place of the next: all of them lie on "
                                      "one line, and do not turn at the start");
        H += sizes(0) * across.normalized() * across.normalized().transpose();
        svd = singular_values(H);
      }
    Matrix3 sense     = Matrix3::Identity();
    sense(2, 2)       = Matrix3(svd.V).determinant() * Matrix3(svd.U).determinant() > 0 ? 1 : -1;
    const Matrix3 R   = svd.V * sense * svd.U.transpose();
    const double  out = n_parts > 2 ? vector_of_rotation(R).dot(spin) : 1.;
    if (spin.norm() > 0 && !(out > 0))
      throw std::invalid_argument("parts stand in another order than that in which they come round: each must be named "
                                  "before the one whose place it takes");
    return R;
  }



  void
  RepeatedParts::require_places(const Matrix3 &turn) const
  {
    const auto &nodes  = system.model.nodes;
    Vector3     centre = Vector3::Zero();
    double      n      = 0;
    for (unsigned int i = 1; i < nodes.size(); ++i)
      if (node_becomes[i] != i)
        {
          centre += nodes[i].x;
          ++n;
        }
    centre /= std::max(n, 1.);
    for (unsigned int i = 1; i < nodes.size(); ++i)
      if (node_becomes[i] != i)
        {
          const auto  &next = nodes[node_becomes[i]];
          const double off  = (centre + turn * (nodes[i].x - centre) - next.x).norm();
          if (off > 1e-3 * model_length(system.model))
            throw std::invalid_argument("<" + nodes[i].name + ">, turned by " + number_to_text("%.4g", 360. / n_parts) +
                                        " degrees, is " + number_to_text("%.3g", off) + " m away from <" + next.name +
                                        ">, whose place it should take");
        }
  }



  void
  RepeatedParts::align_as_built(const State &moving)
  {
    if (n_parts == 1)
      return;
    const Matrix3 R = turn_as_built(moving);
    if (const double angle = vector_of_rotation(R).norm(); std::abs(angle - 2 * M_PI / n_parts) > 1e-3)
      throw std::invalid_argument("each part is " + number_to_text("%.4g", angle * 180 / M_PI) +
                                  " degrees from the next one, and not " + number_to_text("%.4g", 360. / n_parts));
    require_places(R);
    const auto &nodes = system.model.nodes;
    for (unsigned int node = 1; node < axes.size(); ++node)
      if (node_turns[node])
        axes[node] = nodes[node_becomes[node]].D.transpose() * R * nodes[node].D;
    // what turns k times as fast as the parts turns by k of their n-th turns; what stands, as the angle of a link, by
    // none
    const double speed = spin_of_parts(moving).norm();
    for (unsigned int i = 0; i < turns_by.size(); ++i)
      if (coordinate_turns[i])
        {
          const double times = speed > 0 ? std::round(std::abs(moving.rates[i]) / speed) : 1.;
          turns_by[i]        = std::copysign(times * 2 * M_PI / n_parts, moving.rates[i]);
        }
  }



  Vector3
  RepeatedParts::spin_of_parts(const State &moving) const
  {
    Vector3 sum = Vector3::Zero();
    double  n   = 0;
    for (unsigned int i = 1; i < node_becomes.size(); ++i)
      if (node_becomes[i] != i)
        {
          sum += system.model.nodes[i].D * Eigen::Map<const Vector3>(&moving.y[6 * i + 3]);
          ++n;
        }
    return sum / std::max(n, 1.);
  }



  State
  RepeatedParts::renumbered(const State &state, const bool forward) const
  {
    State result = state;
    if (n_parts == 1)
      return result;
    result.accelerations.clear();
    for (unsigned int node = 1; node < axes.size(); ++node)
      {
        const unsigned int  from = forward ? node : node_becomes[node], to = forward ? node_becomes[node] : node;
        const Matrix3       A = forward ? axes[node] : Matrix3(axes[node].transpose());
        Eigen::Map<Vector3> place(&result.q[12 * to]);
        place                                       = state.position(from);
        Eigen::Map<Matrix3>(&result.q[12 * to + 3]) = state.triad(from) * A.transpose();
        for (const int part : {0, 3})
          Eigen::Map<Vector3>(&result.y[6 * to + part]) = A * Eigen::Map<const Vector3>(&state.y[6 * from + part]);
      }
    for (unsigned int i = 0; i < coordinate_becomes.size(); ++i)
      {
        const unsigned int from = forward ? i : coordinate_becomes[i], to = forward ? coordinate_becomes[i] : i;
        result.coordinates[to] = state.coordinates[from] - (forward ? 1 : -1) * turns_by[i];
        result.rates[to]       = state.rates[from];
      }
    for (unsigned int i = 0; i < state_becomes.size(); ++i)
      {
        const unsigned int from = forward ? i : state_becomes[i], to = forward ? state_becomes[i] : i;
        result.states[to] = state.states[from];
        if (!state.state_rates.empty())
          result.state_rates[to] = state.state_rates[from];
      }
    system.stresses(result, result.stress);
    return result;
  }



  void
  RepeatedParts::apply(double *x) const
  {
    exchange(x, true);
  }



  void
  RepeatedParts::apply_inverse(double *x) const
  {
    exchange(x, false);
  }



  void
  RepeatedParts::exchange(double *x, const bool forward) const
  {
    if (n_parts == 1)
      return;
    const Layout             &layout = system.layout;
    const std::vector<double> before(x, x + size_of_increment(layout));
    const auto                ends = [&](const unsigned int i, const std::vector<unsigned int> &becomes) {
      return forward ? std::make_pair(i, becomes[i]) : std::make_pair(becomes[i], i);
    };
    for (const int velocities : {0, layout.of_multiplier(0)})
      {
        for (unsigned int node = 1; node < layout.n_nodes; ++node)
          {
            const auto [from, to] = ends(node, node_becomes);
            const Matrix3 R       = forward ? axes[node] : Matrix3(axes[node].transpose());
            for (const int part : {0, 3})
              Eigen::Map<Vector3>(x + velocities + layout.of_node(to) + part).noalias() =
                R * Eigen::Map<const Vector3>(&before[velocities + layout.of_node(from) + part]);
          }
        for (unsigned int i = 0; i < layout.n_coordinates; ++i)
          {
            const auto [from, to]                    = ends(i, coordinate_becomes);
            x[velocities + layout.of_coordinate(to)] = before[velocities + layout.of_coordinate(from)];
          }
      }
    for (unsigned int i = 0; i < layout.n_states; ++i)
      {
        const auto [from, to]  = ends(i, state_becomes);
        x[layout.of_state(to)] = before[layout.of_state(from)];
      }
  }



  std::vector<double>
  RepeatedParts::gap(const State &start, const State &end) const
  {
    if (n_parts == 1)
      return increment(system, start, end, true);
    const Layout       &layout = system.layout;
    std::vector<double> x(size_of_increment(layout), 0.);
    double *const       velocities = x.data() + layout.of_multiplier(0);
    const double        turn       = 2 * M_PI / n_parts;
    for (unsigned int node = 1; node < layout.n_nodes; ++node)
      {
        const unsigned int  to = node_becomes[node];
        const Matrix3       D = start.triad(to), relative = D.transpose() * end.triad(node);
        Eigen::Map<Vector6> place(&x[layout.of_node(to)]), velocity(velocities + layout.of_node(to));
        place.head<3>() = D.transpose() * (end.position(node) - start.position(to));
        place.tail<3>() = node_turns[node] ? rotation_beyond_parts(relative, turn) : vector_of_rotation(relative);
        const Eigen::Map<const Vector3> v(&end.y[6 * node]), spin(&end.y[6 * node + 3]);
        velocity << axes[node] * v, axes[node] * spin;
        velocity -= Eigen::Map<const Vector6>(&start.y[6 * to]);
      }
    for (unsigned int i = 0; i < layout.n_coordinates; ++i)
      {
        const unsigned int to     = coordinate_becomes[i];
        double             change = end.coordinates[i] - start.coordinates[to];
        if (system.model.coordinate_units[i] == "rad")
          change = std::remainder(change, coordinate_turns[i] ? turn : 2 * M_PI);
        x[layout.of_coordinate(to)]          = change;
        velocities[layout.of_coordinate(to)] = end.rates[i] - start.rates[to];
      }
    for (unsigned int i = 0; i < layout.n_states; ++i)
      x[layout.of_state(state_becomes[i])] = end.states[i] - start.states[state_becomes[i]];
    return x;
  }
} // namespace samara
