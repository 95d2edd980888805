#include <samara/base/text.h>
#include <samara/joints/contacts_item.h>

#include <algorithm>
#include <complex>

namespace samara
{
  namespace
  {
    std::vector<double>
    real_of(const double *q, const unsigned int n)
    {
      return {q, q + n};
    }
    std::vector<double>
    real_of(const std::complex<double> *q, const unsigned int n)
    {
      std::vector<double> result(n);
      for (unsigned int i = 0; i < n; ++i)
        result[i] = q[i].real();
      return result;
    }
  } // namespace



  const BentBristles *
  ContactsItem::bent_at(const ContactGroup::Pair &pair, const PairBristles *const bristles, BentBristles &bent) const
  {
    if (bristles == nullptr || bristles->empty() || !group.bodies_of(pair).friction.has_bristles())
      return nullptr;
    const PairBristle *const found = group.find_bristle(pair, *bristles);
    bent.deflection                = found != nullptr ? found->deflection : Vector3::Zero();
    bent.part                      = group.share_of(pair);
    return &bent;
  }



  template <typename Number>
  void
  ContactsItem::residual_at(const Point<Number> &point, Number *const r) const
  {
    if (!point.stops)
      return;
    const std::vector<double> q = real_of(point.q, 12 * of_node.size());
    for_touching(q.data(), [&](const ContactGroup::Pair &pair) {
      const PairShape     shape = group.shape(pair);
      ContactGroup::Sides sides;
      if (!group.find_sides(pair, q.data(), sides))
        return;
      const PairMeasure<Number> measure(shape, group.places(pair, sides, point.q, point.y));
      BentBristles              bent;
      group.add_forces(
        pair,
        sides,
        forces_at_state(measure,
                        shape,
                        group.law_of(pair),
                        group.part_of(pair),
                        group.bodies_of(pair),
                        bent_at(pair, point.bristles, bent)),
        point.q,
        [&](const unsigned int node) { return of_node[node]; },
        r);
    });
  }



  template <typename Add>
  void
  ContactsItem::add_to_matrix(const Point<double> &point, SparseMatrix &A, const Add &value) const
  {
    if (!point.stops)
      return;
    for_touching(point.q, [&](const ContactGroup::Pair &pair) {
      group.add_matrices(pair,
                         point,
                         [&](const unsigned int a, const unsigned int b, const Matrix6 &K, const Matrix6 &C) {
                           if (a == 0 || b == 0)
                             return;
                           for (int j = 0; j < 6; ++j)
                             if (const int at = A.pattern->position(of_node[a], of_node[b] + j); at >= 0)
                               for (int i = 0; i < 6; ++i)
                                 A.values[at + i] += value(K, C)(i, j);
                         });
    });
  }



  void
  ContactsItem::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    add_to_matrix(point, K, [](const Matrix6 &of_place, const Matrix6 &) -> const Matrix6 & { return of_place; });
  }



  void
  ContactsItem::damping(const Point<double> &point, SparseMatrix &C) const
  {
    const auto has_rates = [](const PairLaw &law) {
      return law.has_friction || law.law.has_damping() || law.line_law.has_damping();
    };
    if (std::any_of(group.laws.begin(), group.laws.end(), has_rates))
      add_to_matrix(point, C, [](const Matrix6 &, const Matrix6 &of_rate) -> const Matrix6 & { return of_rate; });
  }



  Vector3
  ContactsItem::force_on(const Item *const body, const State &state) const
  {
    Vector3    sum   = Vector3::Zero();
    const auto point = state.point();
    for_touching(point.q, [&](const ContactGroup::Pair &pair) {
      const PairShape     shape = group.shape(pair);
      ContactGroup::Sides sides;
      if (!group.find_sides(pair, point.q, sides))
        return;
      const PairMeasure<double> measure(shape, group.places(pair, sides, point.q, point.y));
      BentBristles              bent;
      const auto                forces = forces_at_state(measure,
                                          shape,
                                          group.law_of(pair),
                                          group.part_of(pair),
                                          group.bodies_of(pair),
                                          bent_at(pair, point.bristles, bent));
      if ((pair.b_is_line ? group.lines[pair.bead].body : group.beads[pair.bead].body) == body)
        sum -= forces.force_b;
      if ((pair.with_surface ? group.surfaces[pair.other].body :
           pair.a_is_line    ? group.lines[pair.other].body :
                               group.beads[pair.other].body) == body)
        sum -= forces.force_a;
    });
    return sum;
  }



  std::optional<Probe>
  ContactsItem::probe(const std::string &path) const
  {
    const auto count = [=](const State &state, const bool depth) {
      double n = 0, deepest = 0;
      for_touching(state.q.data(), [&](const ContactGroup::Pair &pair) {
        const double gap = group.gap(pair, state.q.data());
        n += gap > 0;
        deepest = std::max(deepest, gap);
      });
      return depth ? deepest : n;
    };
    if (path == "touched")
      return Probe{path, "1", [=](const State &state) { return count(state, false); }};
    if (path == "depth")
      return Probe{path, "m", [=](const State &state) { return count(state, true); }};
    if (path == "energy")
      return Probe{path, "J", [=](const State &state) { return group.energy(state.q.data()); }};
    const auto dot = path.rfind(".force ");
    if (dot == std::string::npos || dot + 8 != path.size() || path.back() < 'x' || path.back() > 'z')
      return {};
    const std::string name = path.substr(0, dot);
    const Item       *body = nullptr;
    for (const auto &item : model->items)
      if (item->name == name && dynamic_cast<const Body *>(item.get()) != nullptr)
        body = item.get();
    if (body == nullptr && name != "ground")
      return {};
    const int i = path.back() - 'x';
    return Probe{path, "N", [=](const State &state) { return force_on(body, state)(i); }};
  }



  std::vector<std::string>
  ContactsItem::probe_names() const
  {
    std::vector<std::string> names = {"touched", "depth", "energy"}, bodies;
    for (const auto &surface : group.surfaces)
      bodies.push_back(surface.body != nullptr ? surface.body->name : "ground");
    for (const auto &bead : group.beads)
      bodies.push_back(bead.body != nullptr ? bead.body->name : "ground");
    for (const auto &line : group.lines)
      bodies.push_back(line.body != nullptr ? line.body->name : "ground");
    std::sort(bodies.begin(), bodies.end());
    bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
    for (const auto &body : bodies)
      for (const std::string direction : {"x", "y", "z"})
        names.push_back(body + ".force " + direction);
    return names;
  }



  template class Evaluated<ContactsItem, Force>;
} // namespace samara
