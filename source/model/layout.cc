#include <samara/model/layout.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <sstream>

namespace samara
{
  Layout::Layout(Model &model)
    : model(model)
  {
    model.close();
    n_nodes       = model.nodes.size();
    n_coordinates = model.coordinates.size();
    n_states      = model.states.size();
    for (auto &c : model.items)
      {
        const std::size_t constraints_before = constraints.size();
        c->connect(*this);
        if (constraints.size() > constraints_before)
          joints.push_back(c.get());
      }
    model.complaints.throw_if_any();
    for (const auto &action : actions)
      action();
    actions.clear();

    for (const auto &c : couplings)
      number_rows(c);
    make_pattern();
    for (const auto &c : couplings)
      find_positions(*c.block);
    couplings.clear();
  }



  void
  Layout::add(const Item &item, Deformation &term)
  {
    term.item         = &item;
    term.first_strain = n_strains;
    n_strains += term.n_strains();
    deformations.push_back(&term);
  }



  void
  Layout::add(const Item &item, Constraint &term)
  {
    term.item = &item;
    constraints.push_back(&term);
  }



  void
  Layout::add(const Item &item, Force &term)
  {
    term.item = &item;
    forces.push_back(&term);
  }



  void
  Layout::add(const Item &item, StateEquation &term)
  {
    term.item = &item;
    state_equations.push_back(&term);
  }



  const Item &
  Layout::item_of_strain(const unsigned int strain) const
  {
    AssertIndexRange(strain, n_strains);
    const auto after =
      std::upper_bound(deformations.begin(), deformations.end(), strain, [](const unsigned int i, const auto *d) {
        return i < d->first_strain;
      });
    return *(*(after - 1))->item;
  }



  unsigned int
  Layout::add_multipliers(const Item &owner, const std::vector<std::string> &parts)
  {
    Assert(pattern == nullptr, dealii::ExcMessage("Multipliers are added in Item::connect()."));
    for (const auto &part : parts)
      rows_of_multipliers.push_back({&owner, part});
    n_multipliers = rows_of_multipliers.size();
    return n_multipliers - parts.size();
  }



  std::string
  Layout::name_of_multiplier(const unsigned int i) const
  {
    AssertIndexRange(i, n_multipliers);
    const auto &[owner, part] = rows_of_multipliers[i];
    return owner->title() + (part.empty() ? "" : ", " + part);
  }



  void
  Layout::couple(Block                           &block,
                 const std::vector<Frame>        &frames,
                 const std::vector<unsigned int> &coordinates,
                 const std::vector<unsigned int> &multipliers,
                 const std::vector<unsigned int> &states)
  {
    Assert(pattern == nullptr, dealii::ExcMessage("Unknowns are coupled in Item::connect()."));
    for ([[maybe_unused]] const auto &frame : frames)
      AssertIndexRange(frame.node, n_nodes);
    for ([[maybe_unused]] const auto i : coordinates)
      AssertIndexRange(i, n_coordinates);
    for ([[maybe_unused]] const auto i : multipliers)
      AssertIndexRange(i, n_multipliers);
    for ([[maybe_unused]] const auto i : states)
      AssertIndexRange(i, n_states);
    couplings.push_back({&block, frames, coordinates, states, multipliers});
  }



  void
  Layout::when_numbered(const std::function<void()> &action)
  {
    actions.push_back(action);
  }



  void
  Layout::number_rows(const Coupling &c) const
  {
    Block &block   = *c.block;
    block          = {};
    block.n_frames = c.frames.size();
    for (unsigned int i = 0; i < c.frames.size(); ++i)
      {
        for (unsigned int k = 0; k < 6; ++k)
          block.rows.push_back(of_node(c.frames[i].node) + k);
        if (!c.frames[i].is_node())
          block.transfers.emplace_back(i, twist_transfer(c.frames[i].arm, c.frames[i].rotation));
      }
    for (const auto i : c.coordinates)
      block.rows.push_back(of_coordinate(i));
    for (const auto i : c.states)
      block.rows.push_back(of_state(i));
    for (const auto i : c.multipliers)
      block.rows.push_back(of_multiplier(i));
  }



  void
  Layout::make_pattern()
  {
    // the six unknowns of a node are coupled alike: one group; all others are one each
    const int                     n = n_unknowns(), n_twists = of_coordinate(0), n_groups = n_twists / 6 + n - n_twists;
    std::vector<std::vector<int>> coupled(n_groups);
    for (int group = 0; group < n_groups; ++group)
      coupled[group].push_back(group);
    std::vector<int> groups;
    for (const auto &c : couplings)
      {
        groups.clear();
        for (const int row : c.block->rows)
          if (row < n && (row >= n_twists || row % 6 == 0))
            groups.push_back(row < n_twists ? row / 6 : n_twists / 6 + row - n_twists);
        for (const int group : groups)
          coupled[group].insert(coupled[group].end(), groups.begin(), groups.end());
      }
    const auto  size_of   = [=](const int group) { return group < n_twists / 6 ? 6 : 1; };
    std::size_t n_entries = 0;
    for (int group = 0; group < n_groups; ++group)
      {
        auto &others = coupled[group];
        std::sort(others.begin(), others.end());
        others.erase(std::unique(others.begin(), others.end()), others.end());
        for (const int other : others)
          n_entries += size_of(group) * size_of(other);
      }

    auto result = std::make_shared<Pattern>();
    result->rows.reserve(n_entries);
    result->column_start.reserve(n + 1);
    result->column_start.push_back(0);
    for (int group = 0; group < n_groups; ++group)
      for (int column = 0; column < size_of(group); ++column)
        {
          for (const int other : coupled[group])
            for (int k = 0; k < size_of(other); ++k)
              result->rows.push_back(other < n_twists / 6 ? 6 * other + k : n_twists + other - n_twists / 6);
          result->column_start.push_back(result->rows.size());
        }
    pattern = result;
  }



  void
  Layout::find_positions(Block &block) const
  {
    const int n = n_unknowns();
    block.positions.reserve(block.size() * block.size());
    for (const int j : block.rows)
      for (const int i : block.rows)
        block.positions.push_back(i < n && j < n ? pattern->position(i, j) : pattern->n_nonzeros());
  }



  std::string
  Layout::unit_of(const int unknown) const
  {
    return unknown >= of_multiplier(0) ? "" :
           unknown >= of_state(0)      ? model.states[unknown - of_state(0)].unit :
           is_length(unknown)          ? "m" :
                                         "rad";
  }



  std::string
  Layout::name_of(const unsigned int unknown) const
  {
    static const std::array<std::string, 6> directions = {
      {"displacement 1", "displacement 2", "displacement 3", "rotation 1", "rotation 2", "rotation 3"}};
    const unsigned int first_coordinate = of_coordinate(0), first_state = of_state(0),
                       first_multiplier = of_multiplier(0);
    if (unknown >= first_multiplier)
      return name_of_multiplier(unknown - first_multiplier);
    if (unknown >= first_state)
      return "state " + model.states[unknown - first_state].name;
    if (unknown >= first_coordinate)
      return model.coordinates[unknown - first_coordinate];
    const auto        &node = model.nodes[1 + unknown / 6];
    std::ostringstream text;
    text << node.name << " at (" << node.x.transpose() << "), " << directions[unknown % 6];
    return text.str();
  }
} // namespace samara
