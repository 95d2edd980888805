#include <samara/base/text.h>
#include <samara/joints/support.h>
#include <samara/model/surface.h>

#include <algorithm>

namespace samara
{
  namespace
  {
    const std::array<const char *, 6> names_of_fixed = {
      {"displacement 1", "displacement 2", "displacement 3", "rotation 1", "rotation 2", "rotation 3"}};

    /** The part of @p e that is in none of the directions @p held, which are any; zero if there is none. */
    Vector3
    beyond(const Vector3 &e, const std::vector<Vector3> &held)
    {
      Eigen::MatrixXd A(3, held.size());
      for (unsigned int i = 0; i < held.size(); ++i)
        A.col(i) = held[i];
      if (held.empty())
        return e;
      const Vector3 rest = e - A * A.completeOrthogonalDecomposition().solve(e);
      return rest.norm() < 1e-9 ? Vector3(Vector3::Zero()) : rest;
    }
  } // namespace



  void
  Support::add_parameters(Parameters &prm)
  {
    prm.add(
      "Along",
      places,
      "Points of bodies, edges and regions of shells, that are held at the ground: plate.edge u0, plate.region pad.");
    prm.add(
      "Fixed",
      fixed_entries,
      "What is held, in the axes below: all, or any of displacement 1, displacement 2, displacement 3, rotation 1, "
      "rotation 2, rotation 3.");
    prm.add("Axis", axis, "Direction of axis 3 of the support, inertial components [1].");
    prm.add("Axis 1", axis_1, "Direction near which axis 1 lies; 0, 0, 0: as near to x as can be [1].");
    prm.turns("Axis", Turning::direction);
    prm.turns("Axis 1", Turning::direction);
  }



  Matrix3
  Support::triad() const
  {
    Assert(!axis.isZero(0.), dealii::ExcMessage("an axis of no length"));
    const Vector3 e3   = axis.normalized();
    Vector3       near = axis_1;
    if (near.isZero(0.))
      near = std::abs(e3(0)) < 0.9 ? Vector3::UnitX() : Vector3::UnitY();
    else if (near.cross(e3).norm() < 1e-6 * near.norm())
      throw std::invalid_argument("<Axis 1> is along <Axis>");
    return triad_about(axis, near);
  }



  void
  Support::be_placed(const Placement &placement)
  {
    // the axis that is chosen where none is given is one of the subsystem
    if (axis_1.isZero(0.))
      parameters.assign("Axis 1", Vector3(triad().col(0)));
    Item::be_placed(placement);
  }



  bool
  Support::read_fixed()
  {
    for (const auto &entry : fixed_entries)
      {
        if (entry == "all")
          {
            fixed.fill(true);
            continue;
          }
        const auto found = std::find(names_of_fixed.begin(), names_of_fixed.end(), entry);
        if (found == names_of_fixed.end())
          throw std::invalid_argument(
            "there is no <" + entry + "> that could be held" +
            did_you_mean(entry, std::vector<std::string>(names_of_fixed.begin(), names_of_fixed.end())));
        fixed[found - names_of_fixed.begin()] = true;
      }
    return std::any_of(fixed.begin(), fixed.end(), [](const bool f) { return f; });
  }



  void
  Support::initialize(Model &m)
  {
    model             = &m;
    std::string where = "Fixed";
    try
      {
        if (!parameters.require("Along", m.complaints))
          return;
        if (!read_fixed())
          throw std::invalid_argument("support <" + name + "> holds nothing");
        where = "Axis";
        axes  = triad();
        where = "Along";
        for (const auto &place : places)
          add_frames(place);
      }
    catch (const std::invalid_argument &problem)
      {
        m.complaints.add(parameters.where(where), problem.what());
      }
    if (std::all_of(fixed.begin(), fixed.end(), [](const bool f) { return f; }))
      {
        for (const auto &node : nodes)
          m.weld(m.ground(), node.frame);
        nodes.clear();
      }
  }



  void
  Support::add_frames(const std::string &path)
  {
    const auto        dot   = path.find('.');
    const std::string body  = trim(path.substr(0, dot)),
                      point = dot == std::string::npos ? "" : trim(path.substr(dot + 1));
    std::vector<Frame> frames;
    Body              &found   = model->find<Body>(body, "body");
    const auto *const  surface = dynamic_cast<const SurfaceBody *>(&found);
    const auto         edges   = surface == nullptr ? std::vector<std::string>() : surface->edges();
    const auto         regions = surface == nullptr ? std::vector<std::string>() : surface->regions();
    if (std::find(edges.begin(), edges.end(), point) != edges.end())
      for (const auto &span : surface->edge(point))
        frames.insert(frames.end(), span.frames.begin(), span.frames.end());
    else if (std::find(regions.begin(), regions.end(), point) != regions.end())
      for (const auto &share : surface->region(point))
        frames.push_back(share.frame);
    else
      try
        {
          frames.push_back(found.frame(point));
        }
      catch (const std::invalid_argument &problem)
        {
          if (edges.empty())
            throw;
          throw std::invalid_argument(std::string(problem.what()) + "; its edges are <" + join(edges, ">, <") + ">");
        }
    for (const auto &frame : frames)
      {
        const Vector3 x        = model->position(frame);
        const bool    is_there = std::any_of(nodes.begin(), nodes.end(), [&](const Node &other) {
          return other.frame.node == frame.node && (other.place - x).norm() < 1e-12 * (1 + x.norm());
        });
        if (frame.node == 0 || is_there)
          continue;
        nodes.emplace_back();
        nodes.back().ground = model->frame_at(model->ground(), x, axes);
        nodes.back().frame  = model->frame_at(frame, x, axes);
        nodes.back().place  = x;
      }
  }



  void
  Support::choose_functions(Node &node, const Layout &layout) const
  {
    // what supports before this one hold there
    std::vector<Vector3> displacements, rotations;
    for (const auto &item : layout.model.items)
      {
        if (item.get() == this)
          break;
        if (const auto *const other = dynamic_cast<const Support *>(item.get()))
          for (const auto &n : other->nodes)
            if (n.frame.node == node.frame.node)
              {
                rotations.insert(rotations.end(), n.rotations.begin(), n.rotations.end());
                if ((n.place - node.place).norm() < 1e-12 * (1 + node.place.norm()))
                  displacements.insert(displacements.end(), n.displacements.begin(), n.displacements.end());
              }
      }
    for (unsigned int i = 0; i < 3; ++i)
      if (fixed[i] && !beyond(axes.col(i), displacements).isZero(0.))
        {
          node.functions.push_back({PairFunction::gap, i});
          node.force_axes.push_back(i);
          displacements.emplace_back(axes.col(i));
          node.displacements.emplace_back(axes.col(i));
        }
    std::vector<unsigned int> turns;
    for (unsigned int k = 0; k < 3; ++k)
      if (fixed[3 + k] && !beyond(axes.col(k), rotations).isZero(0.))
        {
          turns.push_back(k);
          rotations.emplace_back(axes.col(k));
          node.rotations.emplace_back(axes.col(k));
        }
    const auto lock = [&](const unsigned int i, const unsigned int j) {
      node.functions.push_back({PairFunction::cosine, i, j});
      node.force_axes.push_back(-1);
    };
    if (turns.size() == 3)
      {
        lock(2, 0);
        lock(2, 1);
        lock(0, 1);
      }
    else if (turns.size() == 2)
      {
        const unsigned int k = 3 - turns[0] - turns[1];
        lock(next_axis(k), k);
        lock(next_axis(next_axis(k)), k);
      }
    else if (turns.size() == 1)
      lock(next_axis(turns[0]), next_axis(next_axis(turns[0])));
  }



  void
  Support::connect(Layout &layout)
  {
    for (auto &node : nodes)
      node.frame = layout.model.resolved(node.frame);
    // what other joints have welded to the ground is held already
    nodes.erase(std::remove_if(nodes.begin(), nodes.end(), [](const Node &node) { return node.frame.node == 0; }),
                nodes.end());
    bool any = false;
    for (auto &node : nodes)
      {
        choose_functions(node, layout);
        std::vector<std::string>  rows;
        std::vector<unsigned int> multipliers;
        for (unsigned int i = 0; i < node.functions.size(); ++i)
          rows.push_back(node.force_axes[i] >= 0 ? names_of_fixed[node.force_axes[i]] : "rotation");
        node.first_multiplier = layout.add_multipliers(*this, rows);
        for (unsigned int i = 0; i < rows.size(); ++i)
          multipliers.push_back(node.first_multiplier + i);
        layout.couple(node.block, {node.ground, node.frame}, {}, multipliers);
        any = any || !rows.empty();
      }
    if (any)
      layout.add(*this, *this);
  }



  template <bool with_forces, typename Number>
  void
  Support::evaluate(const Point<Number> &point, Number *r) const
  {
    for (const auto &node : nodes)
      {
        const PairValues<Number> pair(node.ground, node.frame, point.q, point.q_of_forces());
        PairForces<Number>       forces;
        for (unsigned int i = 0; i < node.functions.size(); ++i)
          {
            r[node.block.row(12 + i)] += node.functions[i].value(pair);
            if constexpr (with_forces)
              forces.add(node.functions[i], pair, point.multipliers[node.first_multiplier + i]);
          }
        if constexpr (with_forces)
          forces.add_to_nodes(pair, r + node.block.row(0), r + node.block.row(6));
      }
  }



  template <typename Number>
  void
  Support::residual_at(const Point<Number> &point, Number *r) const
  {
    evaluate<true>(point, r);
  }



  void
  Support::constraints(const Point<double> &point, double *r) const
  {
    evaluate<false>(point, r);
  }



  void
  Support::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    for (const auto &node : nodes)
      {
        const PairValues<double> pair(node.ground, node.frame, point.q);
        PairTangent              twists(pair);
        bool                     has_forces = false;
        for (unsigned int i = 0; i < node.functions.size(); ++i)
          {
            const double lambda = point.multipliers[node.first_multiplier + i];
            Vector12     g      = Vector12::Zero();
            node.functions[i].add_gradient(pair, 1., g);
            node.block.add_border(12 + i, g, K);
            twists.add(node.functions[i], lambda);
            has_forces = has_forces || lambda != 0;
          }
        if (!has_forces)
          continue;
        Matrix12 H = Matrix12::Zero();
        twists.add_to(H);
        node.block.add_twists(H, K);
      }
  }



  void
  Support::rates(const Point<double> &point, double *rates) const
  {
    for (const auto &node : nodes)
      {
        const PairValues<double> pair(node.ground, node.frame, point.q);
        const PairRates          change(pair, point.y);
        for (unsigned int i = 0; i < node.functions.size(); ++i)
          rates[node.first_multiplier + i] = node.functions[i].rate(pair, change);
      }
  }



  void
  Support::second_rates(const Point<double> &point, double *rates) const
  {
    for (const auto &node : nodes)
      {
        const PairValues<double> pair(node.ground, node.frame, point.q);
        const PairRates          change(pair, point.y);
        const PairSecondRates    second(pair, change, point.y);
        for (unsigned int i = 0; i < node.functions.size(); ++i)
          rates[node.first_multiplier + i] = node.functions[i].second_rate(pair, change, second);
      }
  }



  std::optional<Probe>
  Support::probe(const std::string &path) const
  {
    for (int i = 0; i < 3; ++i)
      if (path == "force " + std::to_string(i + 1))
        {
          if (nodes.empty())
            throw std::invalid_argument("support <" + name +
                                        "> has made its nodes a part of the ground, and knows no <" + path +
                                        ">; hold what it holds by two supports");
          return Probe{path, "N", [this, i](const State &state) {
                         double sum = 0;
                         for (const auto &node : nodes)
                           for (unsigned int k = 0; k < node.functions.size(); ++k)
                             if (node.force_axes[k] == i)
                               sum -= state.multipliers[node.first_multiplier + k];
                         return sum;
                       }};
        }
    return {};
  }



  std::vector<std::string>
  Support::probe_names() const
  {
    return {"force 1", "force 2", "force 3"};
  }



  template class Evaluated<Support, Constraint>;
} // namespace samara
