#include <samara/base/disjoint_sets.h>
#include <samara/base/text.h>
#include <samara/input/mechanism_graph.h>
#include <samara/model/moved.h>
#include <samara/rotation/matrix6.h>
#include <samara/solvers/assembly.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <sstream>

namespace samara
{
  namespace
  {
    constexpr unsigned int nowhere = std::numeric_limits<unsigned int>::max();

    /** Text between quotation marks of a dot file. */
    std::string
    quoted(const std::string &text)
    {
      std::string result = "\"";
      for (const char c : text)
        result += (c == '"' || c == '\\') ? std::string("\\") + c : std::string(1, c);
      return result + "\"";
    }

    /** Text of an XML file. */
    std::string
    for_xml(const std::string &text)
    {
      std::string result;
      for (const char c : text)
        result += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
      return result;
    }

    /** From places to points of a picture of so many pixels: along the two directions in which places are spread most.
     */
    class View
    {
    public:
      View(const std::vector<Vector3> &places, const double pixels, const double margin)
        : margin(margin)
      {
        for (const auto &x : places)
          middle += x / places.size();
        Matrix3 spread = Matrix3::Zero();
        for (const auto &x : places)
          spread += (x - middle) * (x - middle).transpose();
        const Matrix3 E = symmetric_eigenvectors3(spread); // of the smallest first
        // of the coordinate axes that which is nearest to the view goes up, or to the right
        axes.row(0) = E.col(2).transpose();
        axes.row(1) = E.col(1).transpose();
        if (axes.col(2).norm() < 0.1) // seen along z: x to the right
          axes << 1, 0, 0, 0, 1, 0;
        else
          {
            axes.row(1) = (Vector3::UnitZ() - E.col(0)(2) * E.col(0)).normalized().transpose();
            axes.row(0) = Vector3(axes.row(1).transpose().cross(Vector3(E.col(0)))).transpose();
            axes.row(0) *= axes.row(0).sum() < 0 ? -1 : 1;
          }
        for (const auto &x : places)
          {
            const Eigen::Vector2d p = axes * (x - middle);
            low                     = low.cwiseMin(p);
            high                    = high.cwiseMax(p);
          }
        scale = pixels / std::max((high - low).maxCoeff(), 1e-12);
      }

      Eigen::Vector2d
      operator()(const Vector3 &x) const
      {
        const Eigen::Vector2d p = axes * (x - middle);
        return {margin + scale * (p(0) - low(0)), margin + scale * (high(1) - p(1))};
      }

      Eigen::Vector2d
      size() const
      {
        return scale * (high - low) + Eigen::Vector2d(2 * margin, 2 * margin);
      }

    private:
      double                      margin, scale = 1;
      Vector3                     middle = Vector3::Zero();
      Eigen::Matrix<double, 2, 3> axes;
      Eigen::Vector2d             low = Eigen::Vector2d::Zero(), high = Eigen::Vector2d::Zero();
    };
  } // namespace



  MechanismGraph::MechanismGraph(const System &system)
  {
    const Model &model = system.model;
    DisjointSets groups(system.layout.n_nodes);
    for (const auto &nodes : system.rigid_nodes())
      for (const auto node : nodes)
        {
          const unsigned int a = groups.root_of(nodes[0]), b = groups.root_of(node);
          groups.join(std::max(a, b), std::min(a, b)); // the ground stays a root
        }
    std::vector<unsigned int> number(system.layout.n_nodes, nowhere);
    const auto                vertex_of = [&](const unsigned int node) {
      unsigned int &vertex = number[groups.root_of(node)];
      if (vertex == nowhere)
        {
          vertex = vertices.size();
          vertices.push_back({node == 0 ? "ground" : ""});
        }
      return vertex;
    };
    vertex_of(0);
    for (const auto &item : model.items)
      if (const auto *const body = dynamic_cast<const Body *>(item.get()))
        {
          const auto frames = frames_of(*body);
          if (frames.empty())
            continue;
          const unsigned int vertex = vertex_of(frames[0].node);
          std::string       &name   = vertices[vertex].name;
          if (vertex > 0)
            name += (name.empty() ? "" : ", ") + body->name;
        }
    const State state = system.reference();
    for (const auto &item : model.items)
      if (const auto *const connection = dynamic_cast<const Connection *>(item.get()))
        if (const auto frames = connection->connected_frames(); frames.size() == 2)
          {
            const auto &joints = system.layout.joints;
            edges.push_back({item->name,
                             item->kind,
                             vertex_of(frames[0].node),
                             vertex_of(frames[1].node),
                             frames[0].position(state.q.data()),
                             frames[1].position(state.q.data()),
                             item->kind != "spring" && item->kind != "springs in fixed axes" &&
                               item->kind != "flexible joint" &&
                               std::find(joints.begin(), joints.end(), item.get()) != joints.end()});
          }
    find_loops();
  }



  void
  MechanismGraph::find_loops()
  {
    // a tree from the ground, breadth first; each edge that is not in it closes a loop
    std::vector<std::vector<unsigned int>> at(vertices.size());
    for (unsigned int e = 0; e < edges.size(); ++e)
      if (edges[e].constrains && edges[e].a != edges[e].b)
        {
          at[edges[e].a].push_back(e);
          at[edges[e].b].push_back(e);
        }
    std::vector<unsigned int> above(vertices.size(), nowhere), depth(vertices.size(), nowhere);
    std::vector<bool>         is_in_tree(edges.size(), false);
    const auto                other = [&](const unsigned int e, const unsigned int v) {
      return edges[e].a == v ? edges[e].b : edges[e].a;
    };
    for (unsigned int root = 0; root < vertices.size(); ++root)
      {
        if (depth[root] != nowhere)
          continue;
        depth[root] = 0;
        std::deque<unsigned int> next{root};
        for (; !next.empty(); next.pop_front())
          for (const auto e : at[next.front()])
            if (const unsigned int v = other(e, next.front()); depth[v] == nowhere)
              {
                depth[v]      = depth[next.front()] + 1;
                above[v]      = e;
                is_in_tree[e] = true;
                next.push_back(v);
              }
      }
    for (unsigned int e = 0; e < edges.size(); ++e)
      {
        if (!edges[e].constrains || edges[e].a == edges[e].b || is_in_tree[e])
          continue;
        std::vector<unsigned int> down, up;
        unsigned int              a = edges[e].a, b = edges[e].b;
        while (a != b)
          {
            unsigned int &lower = depth[a] >= depth[b] ? a : b;
            (&lower == &a ? up : down).push_back(above[lower]);
            lower = other(above[lower], lower);
          }
        Loop loop{a, {up.rbegin(), up.rend()}};
        loop.edges.push_back(e);
        loop.edges.insert(loop.edges.end(), down.begin(), down.end());
        loops.push_back(loop);
      }
  }



  std::string
  MechanismGraph::text(const Loop &loop) const
  {
    unsigned int at     = loop.start;
    std::string  result = vertices[at].name;
    for (const auto e : loop.edges)
      {
        at = edges[e].a == at ? edges[e].b : edges[e].a;
        result += " - <" + edges[e].name + "> - " + vertices[at].name;
      }
    return result;
  }



  std::string
  MechanismGraph::text() const
  {
    constexpr unsigned int most   = 10;
    std::string            result = "  loops             " + std::to_string(loops.size());
    for (unsigned int i = 0; i < loops.size() && i < most; ++i)
      result += "\n                    " + text(loops[i]);
    if (loops.size() > most)
      result += "\n                    and " + std::to_string(loops.size() - most) + " more";
    return result;
  }



  std::string
  MechanismGraph::dot() const
  {
    std::ostringstream out;
    out << "graph mechanism {\n  node [shape=box];\n";
    for (unsigned int v = 0; v < vertices.size(); ++v)
      out << "  b" << v << " [label=" << quoted(vertices[v].name) << (v == 0 ? ", style=filled" : "") << "];\n";
    for (const auto &edge : edges)
      out << "  b" << edge.a << " -- b" << edge.b << " [label=" << quoted(edge.name + " (" + edge.kind + ")")
          << (edge.constrains ? "" : ", style=dashed") << "];\n";
    out << "}\n";
    return out.str();
  }



  namespace
  {
    /** The lines and words of a picture, at points of space. */
    class Sketch
    {
    public:
      explicit Sketch(const std::vector<Vector3> &places)
        : view(places, 800, 80)
      {
        out.precision(6);
        out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << view.size()(0) << "\" height=\""
            << view.size()(1)
            << "\" font-family=\"sans-serif\" font-size=\"13\">\n"
               "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
      }

      void
      line(const Vector3 &a, const Vector3 &b, const std::string &style)
      {
        const auto p = view(a), q = view(b);
        out << "<line x1=\"" << p(0) << "\" y1=\"" << p(1) << "\" x2=\"" << q(0) << "\" y2=\"" << q(1) << "\" " << style
            << "/>\n";
      }

      void
      words(const Vector3 &at, const double right, const double down, const std::string &style, const std::string &text)
      {
        const auto p = view(at);
        out << "<text x=\"" << p(0) + right << "\" y=\"" << p(1) + down << "\" " << style << ">" << for_xml(text)
            << "</text>\n";
      }

      void
      ground(const Vector3 &at)
      {
        const auto p = view(at);
        out << "<path d=\"M" << p(0) << " " << p(1) << " l-9 15 h18 z\" fill=\"none\" stroke=\"black\"/>\n";
      }

      void
      circle(const Vector3 &at, const std::string &fill)
      {
        const auto p = view(at);
        out << "<circle cx=\"" << p(0) << "\" cy=\"" << p(1) << "\" r=\"5\" fill=\"" << fill
            << "\" stroke=\"black\"/>\n";
      }

      std::string
      text() const
      {
        return out.str() + "</svg>\n";
      }

    private:
      const View         view;
      std::ostringstream out;
    };
  } // namespace



  std::string
  MechanismGraph::svg() const
  {
    static const std::vector<std::string> colours = {"#d62728", "#1f77b4", "#2ca02c", "#9467bd", "#ff7f0e", "#17becf"};
    std::vector<Vector3>                  places;
    std::vector<std::vector<Vector3>>     held(vertices.size());
    for (const auto &edge : edges)
      {
        held[edge.a].push_back(edge.at_a);
        held[edge.b].push_back(edge.at_b);
        places.push_back(edge.at_a);
        places.push_back(edge.at_b);
      }
    if (places.empty())
      places.emplace_back(Vector3::Zero());
    Sketch sketch(places);
    // bodies: between the places where they are held
    for (unsigned int v = 1; v < vertices.size(); ++v)
      {
        if (held[v].empty())
          continue;
        Vector3 middle = Vector3::Zero();
        for (const auto &x : held[v])
          middle += x / held[v].size();
        for (const auto &x : held[v])
          sketch.line(middle, x, "stroke=\"#888\" stroke-width=\"5\" stroke-linecap=\"round\"");
        sketch.words(middle, 6, -8, "fill=\"#555\" font-style=\"italic\"", vertices[v].name);
      }
    // loops: through the middles of bodies, each in its colour and a little beside the others
    for (unsigned int i = 0; i < loops.size(); ++i)
      for (unsigned int k = 0; k < loops[i].edges.size(); ++k)
        {
          const Edge &edge = edges[loops[i].edges[k]];
          const auto &next = edges[loops[i].edges[(k + 1) % loops[i].edges.size()]];
          const bool  via_ground =
            (edge.a == 0 || edge.b == 0) && (next.a == 0 || next.b == 0) && k + 1 == loops[i].edges.size();
          sketch.line(edge.at_b,
                      next.at_b,
                      "stroke=\"" + colours[i % colours.size()] + "\" stroke-width=\"1.5\"" +
                        (via_ground ? " stroke-dasharray=\"6 4\"" : ""));
        }
    for (const auto &edge : edges)
      {
        if ((edge.at_b - edge.at_a).norm() > 0)
          sketch.line(edge.at_a, edge.at_b, "stroke=\"black\" stroke-dasharray=\"2 3\"");
        if (edge.a == 0 || edge.b == 0)
          sketch.ground(edge.at_b);
        sketch.circle(edge.at_b, edge.constrains ? "white" : "#ddd");
        sketch.words(edge.at_b, 9, 16, "", edge.name + " (" + edge.kind + ")");
      }
    return sketch.text();
  }
} // namespace samara
