#include <samara/base/text.h>
#include <samara/model/frame_probe.h>
#include <samara/model/model.h>
#include <samara/model/output_name.h>
#include <samara/model/relative_motion.h>
#include <samara/model/signal.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <stdexcept>

namespace samara
{
  std::shared_ptr<Signal>
  Body::signal(Model &model, const std::string &path)
  {
    const auto        dot      = path.rfind('.');
    const std::string point    = dot == std::string::npos ? "" : trim(path.substr(0, dot)),
                      quantity = dot == std::string::npos ? path : trim(path.substr(dot + 1));
    const Frame at             = frame(point);
    return frame_signal(quantity, at, model.position(at));
  }



  Model::Model()
  {
    add_node("ground", Vector3::Zero(), Matrix3::Identity());
  }



  Frame
  Model::ground() const
  {
    return {};
  }



  Frame
  Model::add_node(const std::string &name, const Vector3 &x, const Matrix3 &D)
  {
    nodes.push_back({name, x, D, Matrix6::Zero()});
    parent.push_back({static_cast<unsigned int>(nodes.size() - 1)});
    return parent.back();
  }



  void
  Model::add_inertia(const Frame &frame, const Matrix6 &M)
  {
    const Matrix6 T = twist_transfer(frame.arm, frame.rotation);
    nodes[frame.node].inertia += T.transpose() * M * T;
  }



  Frame
  Model::root_of(const Frame &frame) const
  {
    Frame f = frame;
    while (parent[f.node].node != f.node)
      f = parent[f.node].then(f.arm, f.rotation);
    return f;
  }



  void
  Model::weld(const Frame &a, const Frame &b)
  {
    Frame A = root_of(a), B = root_of(b);
    if (B.node < A.node) // the ground must stay a root
      std::swap(A, B);
    if (A.node == B.node)
      return; // already rigidly connected
    const Node &n = nodes[A.node], &m = nodes[B.node];
    parent[B.node] = {A.node, n.D.transpose() * (m.x - n.x), n.D.transpose() * m.D};
    // axes that agree to round-off are the same axes, and a node without arm is the node itself
    if (parent[B.node].arm.norm() < 1e-12 * (1. + n.x.norm()))
      parent[B.node].arm.setZero();
    if ((parent[B.node].rotation - Matrix3::Identity()).norm() < 1e-14)
      parent[B.node].rotation.setIdentity();
  }



  unsigned int
  Model::add_coordinate(const std::string &name, const std::string &unit)
  {
    coordinates.push_back(name);
    coordinate_units.push_back(unit);
    return coordinates.size() - 1;
  }



  int
  Model::negative_length(const std::vector<double> &values) const
  {
    for (const auto &[coordinate, length] : lengths)
      if (values[coordinate] < -length)
        return coordinate;
    return -1;
  }



  unsigned int
  Model::add_state(const std::string &name, const std::string &unit, const double initial, const double scale)
  {
    states.push_back({name, unit, initial, scale, false});
    return states.size() - 1;
  }



  bool
  split_number(const std::string &path, std::string &name, std::string &number)
  {
    const auto bar = path.rfind('_');
    if (bar == std::string::npos || bar + 1 == path.size() ||
        path.find_first_not_of("0123456789", bar + 1) != std::string::npos)
      return false;
    name   = path.substr(0, bar);
    number = path.substr(bar + 1);
    return true;
  }



  std::shared_ptr<Signal>
  Model::signal(const std::string &path)
  {
    for (unsigned int i = 0; i < states.size(); ++i)
      if (states[i].name == path)
        {
          const auto &all  = named(path);
          laws_name_states = laws_name_states || std::none_of(all.begin(), all.end(), [](const Item *const item) {
                               return item->is_control();
                             });
          return state_signal(i);
        }
    const auto  dot  = path.find('.');
    std::string name = trim(path.substr(0, dot)), rest = dot == std::string::npos ? "" : trim(path.substr(dot + 1));
    const auto  all = full_names(name);
    if (dot == std::string::npos &&
        std::all_of(all.begin(), all.end(), [&](const auto &full_name) { return named(full_name).empty(); }))
      split_number(path, name, rest);
    for (const auto &full_name : full_names(name))
      for (auto *const item : named(full_name))
        {
          if (item->is_faulty)
            throw FollowUp();
          if (auto signal = item->signal(*this, rest))
            {
              const bool is_of_motion =
                dynamic_cast<const Body *>(item) != nullptr || dynamic_cast<const RelativeMotions *>(item) != nullptr;
              laws_name_states = laws_name_states || !is_of_motion;
              return signal;
            }
        }
    find<Item>(name, "object"); // complains if there is none
    throw std::invalid_argument("<" + name + "> has no <" + rest + "> that an expression could depend on");
  }



  void
  Model::close()
  {
    if (!kept_as.empty())
      throw std::logic_error("A model belongs to one system, whose numbers its items have: read it again for another.");
    // a node is welded to one with a smaller number, of which the root is known by then: chains of welds may be long
    for (unsigned int i = 0; i < nodes.size(); ++i)
      if (parent[i].node != i)
        parent[i] = parent[parent[i].node].then(parent[i].arm, parent[i].rotation);

    std::vector<Node> kept;
    kept_as.assign(nodes.size(), -1);
    for (unsigned int i = 0; i < nodes.size(); ++i)
      if (parent[i].node == i)
        {
          kept_as[i] = kept.size();
          kept.push_back(nodes[i]);
        }
    for (unsigned int i = 0; i < nodes.size(); ++i)
      if (parent[i].node != i)
        {
          const Frame   root = root_of({i});
          const Matrix6 T    = twist_transfer(root.arm, root.rotation);
          kept[kept_as[root.node]].inertia += T.transpose() * nodes[i].inertia * T;
        }
    nodes = kept;
  }



  Frame
  Model::resolved(const Frame &frame) const
  {
    Assert(!kept_as.empty(), dealii::ExcMessage("resolved() before close()"));
    Frame root = root_of(frame);
    root.node  = kept_as[root.node];
    return root;
  }



  Vector3
  Model::position(const Frame &frame) const
  {
    Assert(kept_as.empty(), dealii::ExcMessage("reference positions are asked for before close()"));
    return nodes[frame.node].x + nodes[frame.node].D * frame.arm;
  }



  Matrix3
  Model::triad(const Frame &frame) const
  {
    Assert(kept_as.empty(), dealii::ExcMessage("reference triads are asked for before close()"));
    return nodes[frame.node].D * frame.rotation;
  }



  Frame
  Model::frame_at(const Frame &frame, const Vector3 &x, const Matrix3 &D) const
  {
    const Node &n = nodes[frame.node];
    return {frame.node, n.D.transpose() * (x - n.x), n.D.transpose() * D};
  }



  const std::vector<Item *> &
  Model::named(const std::string &name) const
  {
    for (; n_indexed < items.size(); ++n_indexed)
      items_by_name[items[n_indexed]->name].push_back(items[n_indexed].get());
    static const std::vector<Item *> none;
    const auto                       found = items_by_name.find(name);
    return found == items_by_name.end() ? none : found->second;
  }



  std::vector<std::string>
  Model::full_names(const std::string &name) const
  {
    if (!name.empty() && name[0] == subsystem_separator)
      return {name.substr(1)};
    std::vector<std::string> names;
    for (std::string prefix = scope; !prefix.empty(); prefix = scope_of(prefix.substr(0, prefix.size() - 1)))
      names.push_back(prefix + name);
    names.push_back(name);
    return names;
  }



  std::string
  scope_of(const std::string &full_name)
  {
    const auto end = full_name.rfind(subsystem_separator);
    return end == std::string::npos ? "" : full_name.substr(0, end + 1);
  }



  std::string
  Model::where_inactive(const std::string &full_name) const
  {
    if (const auto found = inactive.find(full_name); found != inactive.end())
      return found->second;
    // of a subsystem that is left out nobody knows what is in it, nor how many copies there are
    for (std::size_t end = full_name.find(subsystem_separator); end != std::string::npos;
         end             = full_name.find(subsystem_separator, end + 1))
      for (const auto &[name, where] : inactive)
        if (name.back() == subsystem_separator)
          {
                        const std::string subsystem = name.substr(0, name.size() - 1);
                        std::string       rest      = full_name.substr(0, end);
                        if (rest.rfind(subsystem, 0) != 0)
              continue;
            rest = trim(rest.substr(subsystem.size()));
                        if (rest.find_first_not_of("0123456789") == std::string::npos)
              return where;
          }
    return "";
  }



  void
  Model::refuse(const std::string &name, const std::string &noun, const std::vector<const Item *> &others) const
  {
    for (const auto &full_name : full_names(name))
      if (const std::string where = where_inactive(full_name); !where.empty())
        throw std::invalid_argument("<" + full_name + "> is left out: it is not <Active>, see " + where);
    std::vector<std::string> names;
    for (const auto *const c : others)
      names.push_back(c->name.compare(0, scope.size(), scope) == 0 ? c->name.substr(scope.size()) : c->name);
    throw std::invalid_argument("there is no " + noun + " <" + name + ">" + did_you_mean(name, names));
  }



  std::string
  Model::mounted(const std::string &name) const
  {
    for (const auto &full_name : full_names(name))
      {
        if (!named(full_name).empty() || unmade.count(full_name) > 0)
          return name;
        if (const auto mount = mounts.find(full_name); mount != mounts.end())
          return subsystem_separator + mount->second;
      }
    return name;
  }



  Frame
  Model::frame(const std::string &path) const
  {
    if (path == "ground")
      return ground();
    const auto        dot  = path.find('.');
    const std::string name = mounted(trim(path.substr(0, dot)));
    return find<Body>(name, "body").frame(dot == std::string::npos ? "" : trim(path.substr(dot + 1)));
  }



  unsigned int
  Model::use_rotation(const std::string &path)
  {
    const auto        dot    = path.find('.');
    const std::string name   = trim(path.substr(0, dot)),
                      motion = dot == std::string::npos ? "" : trim(path.substr(dot + 1));
    Item *joint              = &find<Item>(name, "joint");
    for (auto *const c : named(joint->name)) // a body may have the same name
      if (!c->rotation_names().empty())
        joint = c;
    const auto rotations = joint->rotation_names();
    if (rotations.empty())
      throw std::invalid_argument(joint->kind + " <" + name + "> has no free rotation that could be used");
    if (motion.empty() && rotations.size() > 1)
      throw std::invalid_argument(joint->kind + " <" + name + "> has several rotations: write <" + name + "." +
                                  join(rotations, "> or <" + name + ".") + ">");
    const std::string wanted = motion.empty() ? rotations[0] : motion;
    if (std::find(rotations.begin(), rotations.end(), wanted) == rotations.end())
      throw std::invalid_argument(joint->kind + " <" + name + "> has no free rotation <" + motion + ">" +
                                  did_you_mean(motion, rotations));
    return joint->use_coordinate(*this, wanted).value();
  }



  Probe
  Model::probe(const std::string &path) const
  {
    const std::string seen_from = " seen from ";
    if (const auto seen = path.rfind(seen_from); seen != std::string::npos)
      return probe_seen_from(trim(path.substr(0, seen)), trim(path.substr(seen + seen_from.size())));
    const auto  dot  = path.find('.');
    std::string name = trim(path.substr(0, dot)), rest = dot == std::string::npos ? "" : trim(path.substr(dot + 1));
    if (dot == std::string::npos && named(name).empty())
      split_number(path, name, rest);
    if (const std::string mount = mounted(name); mount != name && dot != std::string::npos)
      name = mount.substr(1);
    // a section and a body may have the same name; the section has nothing to tell
    std::vector<std::string> known;
    for (const auto *const c : named(name)) // paths of probes are full: they head the columns of results
      {
        if (c->is_faulty)
          throw FollowUp();
        if (auto probe = c->probe(rest))
          {
            probe->name = path;
            return *probe;
          }
        for (const auto &candidate : c->probe_names())
          known.push_back(candidate);
      }
    find<Item>(name, "body or joint"); // complains if there is none
    throw std::invalid_argument("<" + name + "> has no <" + rest + ">" + did_you_mean(rest, known));
  }



  std::function<FrameMotion(const State &)>
  Model::motion_of(const Frame &frame) const
  {
    Assert(!kept_as.empty(), dealii::ExcMessage("motion_of() before close()"));
    const Node   &node = nodes[frame.node];
    const Vector3 x    = node.x + node.D * frame.arm;
    const Matrix3 D    = node.D * frame.rotation;
    return [frame, x, D](const State &state) { return FrameMotion::of(frame, x, D, state); };
  }



  Probe
  Model::probe_seen_from(const std::string &path, const std::string &observer) const
  {
    const auto        dot      = path.rfind('.');
    const std::string point    = trim(path.substr(0, dot)),
                      quantity = dot == std::string::npos ? "" : trim(path.substr(dot + 1));
    const auto known           = frame_quantities();
    if (std::find(known.begin(), known.end(), quantity) == known.end())
      throw std::invalid_argument("<" + path + "> cannot be seen from <" + observer + ">: motions of points can, " +
                                  "<body.point.displacement x>" + did_you_mean(quantity, known));
    const auto motion = motion_of(frame(point)), of_observer = motion_of(frame(observer));
    auto       probe = frame_probe(quantity, [motion, of_observer](const State &state) {
      return motion(state).seen_from(of_observer(state));
    });
    probe->name      = path + " seen from " + observer;
    return *probe;
  }



  double
  box_diagonal(const Model &model)
  {
    Vector3 low = model.nodes[0].x, high = low;
    for (const auto &node : model.nodes)
      {
        low  = low.cwiseMin(node.x);
        high = high.cwiseMax(node.x);
      }
    return (high - low).norm();
  }
} // namespace samara
