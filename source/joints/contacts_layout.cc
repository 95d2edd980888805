// How a group of contacts enters the layout, and what it must not be like there.

#include <samara/base/text.h>
#include <samara/joints/contacts_item.h>

#include <algorithm>
#include <set>

namespace samara
{
  namespace
  {
    /** So many pairs of nodes are in the matrices of statics and modes. */
    constexpr unsigned int most_couplings = 1000;
  } // namespace



  void
  ContactsItem::refuse_overlaps(const Layout &layout) const
  {
    std::vector<double> q;
    for (const auto &node : layout.model.nodes)
      {
        q.insert(q.end(), node.x.data(), node.x.data() + 3);
        q.insert(q.end(), node.D.data(), node.D.data() + 9);
      }
    constexpr double   most_of_radii = 0.5; // as in steps: deeper in, it is not sure to which side they push
    unsigned int       n             = 0;
    double             deepest       = 0;
    bool               is_too_deep   = false;
    ContactGroup::Pair worst{};
    for_touching(q.data(), [&](const ContactGroup::Pair &pair) {
      const PairShape shape = group.shape(pair);
      const double    gap   = group.gap(pair, q.data());
      if (gap < 1e-9 * shape.radius_b)
        return;
      ++n;
      const bool too_deep =
        shape.kind != PairShape::plane && !shape.hollow && gap > most_of_radii * (shape.radius_a + shape.radius_b);
      if (is_too_deep ? !(too_deep && gap > deepest) : !(too_deep || gap > deepest))
        return;
      deepest     = gap;
      worst       = pair;
      is_too_deep = too_deep;
    });
    if (is_too_deep)
      complain("Overlap",
               group.name_of(worst) + " press into each other by " + number_to_text("%.4g", deepest) +
                 " m in the reference configuration, more than half of their radii: to which side they push is not "
                 "sure. Move them apart, or, if a joint holds them together, put them into different groups");
    else if (n > 0 && overlap == "refused")
      complain("Overlap",
               group.name_of(worst) + " press into each other by " + number_to_text("%.4g", deepest) +
                 " m in the reference configuration" +
                 (n > 1 ? ", and " + std::to_string(n - 1) + " other pairs by less" : "") +
                 ": move them apart, or let <Overlap = allowed> if that is meant");
  }



  /** Nearest places may be anywhere on a beam: its nodes with those of all that it may touch. */
  void
  ContactsItem::add_nodes_of_lines(std::set<std::pair<unsigned int, unsigned int>> &pairs) const
  {
    if (!group.has_nearest_places())
      return;
    std::vector<std::vector<unsigned int>> groups;
    for (const auto &line : group.lines)
      {
        groups.emplace_back();
        for (const auto &span : line.spans)
          for (const auto &frame : span.frames)
            groups.back().push_back(frame.node);
      }
    const std::size_t n_lines = groups.size();
    for (const auto &bead : group.beads)
      if (bead.is_ball)
        groups.push_back({bead.place.front().frame.node});
    for (std::size_t i = 0; i < n_lines && pairs.size() <= most_couplings; ++i)
      for (std::size_t j = i; j < groups.size() && pairs.size() <= most_couplings; ++j)
        for (const auto a : groups[i])
          for (const auto b : groups[j])
            if (a != 0 && b != 0 && a != b)
              pairs.emplace(std::min(a, b), std::max(a, b));
  }



  void
  ContactsItem::couple_pairs(Layout &layout)
  {
    std::set<std::pair<unsigned int, unsigned int>> pairs;
    std::vector<unsigned int>                       nodes;
    bool                                            is_any = false;
    const auto                                      add    = [&](const ContactGroup::Pair &pair) {
      if (!group.is_possible(pair))
        return;
      is_any = true;
      if (pairs.size() > most_couplings)
        return;
      group.nodes_of(pair, nodes);
      for (const auto a : nodes)
        for (const auto b : nodes)
          if (a != 0 && b != 0 && a < b)
            pairs.emplace(a, b);
    };
    for (unsigned int i = 0; i < group.beads.size() && pairs.size() <= most_couplings; ++i)
      {
        for (unsigned int j = 0; j < group.surfaces.size(); ++j)
          add({i, j, true});
        for (unsigned int j = i + 1; j < group.beads.size() && group.beads[i].is_ball && group.balls_touch_balls; ++j)
          add({i, j, false});
      }
    add_nodes_of_lines(pairs);
    is_any = is_any || group.has_nearest_places();
    if (!is_any)
      return complain(
        "Balls",
        "no two of these can touch: give <Balls> or <Beams>, and others, or <Planes> and the like, of other bodies");
    group.is_coupled = pairs.size() <= most_couplings;
    if (!group.is_coupled)
      return;
    for (const auto &[a, b] : pairs)
      {
        blocks.emplace_back();
        layout.couple(blocks.back(), {Frame{a}, Frame{b}});
      }
  }



  void
  ContactsItem::connect(Layout &layout)
  {
    for (auto &bead : group.beads)
      for (auto &place : bead.place)
        place.frame = layout.model.resolved(place.frame);
    for (auto &line : group.lines)
      for (auto &span : line.spans)
        for (auto &frame : span.frames)
          frame = layout.model.resolved(frame);
    for (auto &surface : group.surfaces)
      surface.frame = layout.model.resolved(surface.frame);
    const unsigned int n_nodes = layout.model.nodes.size();
    of_node.resize(n_nodes);
    layout.when_numbered([this, &layout]() {
      for (unsigned int node = 0; node < of_node.size(); ++node)
        of_node[node] = layout.of_node(node);
    });
    couple_pairs(layout);
    refuse_overlaps(layout);
    layout.add(*this, *this);
    group.number = layout.contact_groups.size();
    layout.contact_groups.push_back(&group);
  }
} // namespace samara
