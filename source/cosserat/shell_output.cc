// What others ask of a shell: points, edges, its surface, probes, a picture.

#include <samara/base/text.h>
#include <samara/cosserat/shell.h>
#include <samara/model/frame_probe.h>
#include <samara/section/extremes_by_name.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <sstream>

namespace samara
{
  Shell::NamedPoint
  Shell::point_of(const unsigned int node) const
  {
    return {node_frames[node], mesh->nodes[node], node_axes[node], static_cast<int>(node)};
  }



  unsigned int
  Shell::node_of_point(const std::string &point) const
  {
    const auto found = mesh->points.find(point);
    if (found == mesh->points.end())
      {
        std::vector<std::string> known;
        for (const auto &other : mesh->points)
          known.push_back(other.first);
        throw std::invalid_argument("shell <" + name + "> has no point <" + point + ">" + did_you_mean(point, known) +
                                    groups_of_file);
      }
    if (found->second.size() != 1)
      throw std::invalid_argument("<" + point + "> of shell <" + name + "> is " +
                                  (found->second.empty() ? "no corner of a quadrilateral" :
                                                           std::to_string(found->second.size()) + " nodes, not one"));
    return found->second[0];
  }



  unsigned int
  Shell::node_at(const std::string &text) const
  {
    if (text.compare(0, 6, "point ") == 0)
      return node_of_point(text);
    std::vector<double> numbers;
    std::istringstream  words(text);
    std::string         word;
    double              number = 0;
    while (words >> word)
      numbers.push_back(text_to_number(word, number) ? number : std::nan(""));
    if ((numbers.size() != 2 && numbers.size() != 3) ||
        std::any_of(numbers.begin(), numbers.end(), [](const double x) { return !std::isfinite(x); }))
      throw std::invalid_argument("a place on a shell is written <at u v> or <at x y z>, with plain numbers, or <at "
                                  "point NAME> of a mesh file, not <at " +
                                  text + ">");
    int        nearest  = -1;
    double     distance = 0;
    const auto look     = [&](const unsigned int node, const double d) {
      if (nearest < 0 || d < distance)
        {
          nearest  = node;
          distance = d;
        }
    };
    if (numbers.size() == 3)
      {
        const Vector3 x(numbers[0], numbers[1], numbers[2]);
        const double  size = mesh->size();
        for (unsigned int i = 0; i < mesh->nodes.size(); ++i)
          look(i, (mesh->nodes[i] - x).norm() / size);
      }
    else
      for (const auto &origin : mesh->origins)
        if (origin.patch == 0)
          look(origin.node, std::hypot(origin.u - numbers[0], origin.v - numbers[1]));
    if (nearest < 0)
      throw std::invalid_argument("shell <" + name + "> has no patch with coordinates u and v: write <at x y z>");
    if (distance > 1e-6)
      {
        std::ostringstream message;
        message << "shell <" << name << "> has no node at <" << text << ">; the nearest is at ("
                << mesh->nodes[nearest].transpose() << ")";
        throw std::invalid_argument(message.str());
      }
    return nearest;
  }



  Shell::NamedPoint
  Shell::point_named(const std::string &point) const
  {
    const auto found = named.find(point);
    if (found != named.end())
      return found->second;
    if (point.compare(0, 3, "at ") == 0)
      return point_of(node_at(point.substr(3)));
    if (point.compare(0, 6, "point ") == 0)
      return point_of(node_of_point(point));
    auto known = points();
    known.push_back("at 0.5 0");
    throw std::invalid_argument("shell <" + name + "> has no point <" + point + ">" + did_you_mean(point, known));
  }



  Frame
  Shell::frame(const std::string &point) const
  {
    return node_frames.empty() ? Frame{} : point_named(point).frame; // if empty it has complained already
  }



  std::vector<std::string>
  Shell::points() const
  {
    std::vector<std::string> names;
    for (const auto &point : named)
      names.push_back(point.first);
    if (mesh != nullptr)
      for (const auto &point : mesh->points)
        if (point.second.size() == 1)
          names.push_back(point.first);
    return names;
  }



  std::vector<SurfaceCell>
  Shell::surface(const std::string &region_name) const
  {
    std::vector<SurfaceCell> cells;
    if (node_frames.empty())
      return cells;
    if (region_name.empty())
      for (const auto &element : elements)
        cells.push_back({element.frames, rule});
    else
      for (const unsigned int cell : cells_of(region_name))
        cells.push_back({elements[cell].frames, rule});
    return cells;
  }



  const std::vector<unsigned int> &
  Shell::cells_of(const std::string &region_name) const
  {
    for (const std::string prefix : {"", "region "})
      if (const auto found = mesh->regions.find(prefix + region_name); found != mesh->regions.end())
        return found->second;
    throw std::invalid_argument("shell <" + name + "> has no region <" + region_name + ">" +
                                did_you_mean(region_name, regions()) + groups_of_file);
  }



  std::vector<std::string>
  Shell::regions() const
  {
    std::vector<std::string> names;
    if (mesh != nullptr)
      for (const auto &one : mesh->regions)
        names.push_back(one.first);
    return names;
  }



  std::vector<SurfaceBody::AreaShare>
  Shell::region(const std::string &region_name) const
  {
    std::vector<AreaShare> shares;
    if (node_frames.empty())
      return shares;
    cells_of(region_name); // that it is there
    for (const auto &[node, area] :
         mesh->shares_of(mesh->regions.count(region_name) > 0 ? region_name : "region " + region_name))
      shares.push_back({node_frames[node], area});
    return shares;
  }



  std::vector<std::string>
  Shell::edges() const
  {
    std::vector<std::string> names;
    if (mesh != nullptr)
      for (const auto &edge : mesh->edges)
        names.push_back(edge.first);
    return names;
  }



  double
  Shell::thickness() const
  {
    double largest = 0;
    for (const auto &laminate : laminates)
      largest = std::max(largest, laminate.thickness);
    return largest;
  }



  std::vector<Span>
  Shell::edge(const std::string &edge_name) const
  {
    if (node_frames.empty())
      return {};
    if (edge_name.compare(0, 5, "line ") == 0)
      mesh->name_line(edge_name);
    if (mesh->edges.count(edge_name) == 0)
      throw std::invalid_argument("shell <" + name + "> has no edge <" + edge_name + ">" +
                                  did_you_mean(edge_name, edges()) + groups_of_file);
    std::vector<Span> spans;
    double            s = 0;
    for (const auto &step : mesh->walk(edge_name))
      {
        const auto &all = mesh->cells[step.cell].nodes;
        Span        span;
        for (const auto node : step.nodes)
          span.frames.push_back(elements[step.cell].frames[std::find(all.begin(), all.end(), node) - all.begin()]);
        for (const double along : mesh->abscissae_of(step.nodes))
          span.abscissae.push_back(s + along);
        span.start = s;
        span.end = s = span.abscissae.back();
        spans.push_back(span);
      }
    return spans;
  }



  bool
  Shell::is_place(const std::string &point) const
  {
    return named.count(point) > 0 || point.compare(0, 3, "at ") == 0 || point.compare(0, 6, "point ") == 0;
  }



  bool
  Shell::is_single_node(const std::string &point) const
  {
    if (rigid || node_frames.empty() || !is_place(point))
      return false;
    const NamedPoint at = point_named(point);
    if (at.node < 0)
      return false;
    for (const auto &text : rigid_edges)
      if (std::string name_of_edge, place; split_at(text, name_of_edge, place))
        if (mesh->shares_of(place).count(at.node) > 0)
          return false;
    return true;
  }



  bool
  Shell::is_of_node(const unsigned int element, const unsigned int a, const unsigned int node) const
  {
    return mesh->cells[element].nodes[a] == node &&
           (elements[element].frames[a].rotation - node_frames[node].rotation).norm() <= 0.02;
  }



  Shell::VectorN
  Shell::mean_stress(const unsigned int node, const State &state) const
  {
    VectorN      sum   = VectorN::Zero();
    unsigned int count = 0;
    for (unsigned int i = 0; i < n_elements(); ++i)
      for (unsigned int a = 0; a < table->n_nodes; ++a)
        if (is_of_node(i, a, node))
          {
            sum += stress_at_node(i, a, state);
            ++count;
          }
    return count == 0 ? sum : VectorN(sum / count);
  }



  namespace
  {
    /** Section forces of a plate as weights of Γ_αi (0 to 2, 6 to 8) and K_αi (3 to 5, 9 to 11) of the stresses. */
    struct PlateForce
    {
      const char                         *name, *unit;
      std::vector<std::pair<int, double>> weights;
    };
    const std::array<PlateForce, 8> plate_forces = {{{"force 11", "N/m", {{0, 1}}},
                                                     {"force 22", "N/m", {{7, 1}}},
                                                     {"force 12", "N/m", {{1, 0.5}, {6, 0.5}}},
                                                     {"moment 11", "N", {{4, 1}}},
                                                     {"moment 22", "N", {{9, -1}}},
                                                     {"moment 12", "N", {{10, 0.5}, {3, -0.5}}},
                                                     {"shear 1", "N/m", {{2, 1}}},
                                                     {"shear 2", "N/m", {{8, 1}}}}};
  } // namespace



  std::optional<Probe>
  Shell::probe(const std::string &path) const
  {
    const auto dot = path.rfind('.');
    if (dot == std::string::npos || node_frames.empty())
      return {};
    const std::string point = trim(path.substr(0, dot)), quantity = trim(path.substr(dot + 1));
    if (auto of_layers = layer_probe(path, point, quantity))
      return of_layers;
    // "at 0.5 0" has dots of its own, and may be asked for without a quantity
    if (!is_place(point))
      return {};
    const NamedPoint at = point_named(point);
    for (const auto &force : plate_forces)
      if (quantity == force.name && at.node >= 0)
        {
          if (rigid)
            throw std::invalid_argument("shell <" + name + "> is rigid: its section forces are not known");
          VectorN weights = VectorN::Zero();
          for (const auto &[row, weight] : force.weights)
            weights(row) = weight;
          return Probe{path, force.unit, [=](const State &state) { return weights.dot(mean_stress(at.node, state)); }};
        }
    // frames are known for good when the model is connected, after probes are checked
    return frame_probe(quantity, [this, point, at](const State &state) {
      const Frame frame = at.node >= 0 ? node_frames[at.node] : named.at(point).frame;
      return FrameMotion::of(frame, at.x, at.D, state);
    });
  }



  std::vector<std::string>
  Shell::probe_names() const
  {
    auto quantities = frame_quantities();
    for (const auto &force : plate_forces)
      quantities.push_back(force.name);
    auto of_layers = ExtremeByName::names();
    if (!knows_across())
      of_layers.erase(std::find(of_layers.begin(), of_layers.end(), across_the_layers));
    quantities.insert(quantities.end(), of_layers.begin(), of_layers.end());
    auto places = points();
    places.push_back("at 0 0");
    std::vector<std::string> names;
    for (const auto &q : of_layers)
      names.push_back("layers." + q);
    for (const auto &point : places)
      for (const auto &q : quantities)
        names.push_back(point + "." + q);
    return names;
  }



  void
  Shell::draw(const State &state, Drawing &drawing) const
  {
    if (node_frames.empty())
      return;
    drawing.begin_object(name);
    // the nodes of a cell by rows of equal second coordinate
    std::vector<unsigned int> order(table->n_nodes);
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](const unsigned int a, const unsigned int b) {
      const auto &x = table->nodes[a], &y = table->nodes[b];
      return std::abs(x[1] - y[1]) > 1e-12 ? x[1] < y[1] : x[0] < y[0];
    });
    // each cell has points of its own: section forces jump between cells, and axes at corners
    std::vector<Sample>     samples(table->n_nodes);
    std::vector<VectorN>    stresses(table->n_nodes);
    std::vector<PlateState> states(table->n_nodes), with_less[2] = {states, states};
    for (unsigned int i = 0; i < elements.size(); ++i)
      {
        for (unsigned int k = 0; k < order.size(); ++k)
          samples[k] = drawing.sample(elements[i].frames[order[k]], state);
        const unsigned int first = drawing.grid(degree + 1, degree + 1, samples).first_sample;
        if (i < n_elements() && drawing.has_fields())
          {
            const Eigen::MatrixXd at_points = recovered_at_points(i, state),
                                  at_nodes  = at_points * to_nodes.transpose();
            for (unsigned int k = 0; k < order.size(); ++k)
              {
                stresses[k] = at_nodes.col(order[k]).head<n>();
                states[k]   = plate_state(at_nodes.col(order[k]), laminate_of(i));
                for (unsigned int j = 0; j < 2; ++j)
                  with_less[j][k] =
                    plate_state(at_points * to_samples_of_less[j].row(order[k]).transpose(), laminate_of(i));
              }
            draw_section_forces(stresses, first, drawing);
            draw_worst_layers(states, with_less, first, drawing);
          }
      }
    if (shows_layers)
      draw_layers(order, state, drawing);
  }



  void
  Shell::draw_section_forces(const std::vector<VectorN> &stresses,
                             const unsigned int          first_sample,
                             Drawing                    &drawing) const
  {
    // those of plate_forces: three forces, three moments, two shear forces
    Field *const fields[3] = {&drawing.field("membrane force", "N/m", {"11", "22", "12"}),
                              &drawing.field("bending moment", "N", {"11", "22", "12"}),
                              &drawing.field("shear force", "N/m", {"1", "2"})};
    for (unsigned int k = 0; k < stresses.size(); ++k)
      {
        std::array<double, 8> values;
        for (unsigned int i = 0; i < 8; ++i)
          {
            values[i] = 0;
            for (const auto &[row, weight] : plate_forces[i].weights)
              values[i] += weight * stresses[k](row);
          }
        for (unsigned int f = 0; f < 3; ++f)
          fields[f]->set(first_sample + k,
                         std::vector<double>(values.begin() + 3 * f, values.begin() + std::min(8u, 3 * f + 3)));
      }
  }
} // namespace samara
