// What an assembly has to say of gaps: where they are, which joints pull against each other, what would mend it.

#include <samara/solvers/assembly.h>
#include <samara/solvers/redundant_rows.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace samara
{
  namespace
  {
    /** Parts of the largest force below which a joint or a length has none in a loop. */
    constexpr double no_part = 1e-3;

    /** The two frames that an item connects; none if it is no such item. */
    std::vector<Frame>
    ends_of(const Item &item)
    {
      const auto *const connection = dynamic_cast<const Connection *>(&item);
      return connection == nullptr ? std::vector<Frame>() : connection->connected_frames();
    }
  } // namespace



  std::vector<Frame>
  frames_of(const Body &body)
  {
    std::vector<Frame> frames;
    for (const auto &point : body.points())
      try
        {
          frames.push_back(body.frame(point));
        }
      catch (const std::invalid_argument &)
        {} // the middle of a beam, in an element
    return frames;
  }



  std::vector<unsigned int>
  Assembly::rows_of(const Item &item) const
  {
    std::vector<unsigned int> rows;
    for (unsigned int i = 0; i < system.layout.n_multipliers; ++i)
      if (&system.layout.owner_of_multiplier(i) == &item)
        rows.push_back(i);
    return rows;
  }



  std::vector<Assembly::Gap>
  Assembly::gaps() const
  {
    const Eigen::VectorXd then = gaps_at(state_at(drawing())), now = gaps_at(state_at(place));
    std::vector<Gap>      result;
    const Item           *last = nullptr;
    for (int i = 0; i < now.size(); ++i)
      {
        const Item &owner = system.layout.owner_of_multiplier(i);
        if (&owner != last)
          result.push_back({owner.title()});
        last = &owner;
        if (!(scale[i] > 0))
          continue;
        Gap       &of_owner = result.back();
        const auto add      = [&](const double g, double &by_length, double &by_angle) {
          // squares of components
          double &sum = per_length[i] > 0 ? by_length : by_angle;
          sum         = std::hypot(sum, g / (scale[i] * (per_length[i] > 0 ? per_length[i] : 1.)));
        };
        add(then(i), of_owner.drawn, of_owner.drawn_angle);
        add(now(i), of_owner.now, of_owner.angle);
      }
    return result;
  }



  std::string
  Assembly::name_of_piece(const unsigned int piece) const
  {
    if (piece == 0)
      return "ground";
    std::string name;
    for (const auto &item : system.model.items)
      if (const auto *const body = dynamic_cast<const Body *>(item.get()))
        if (const auto frames = frames_of(*body); !frames.empty() && piece_of_node(frames[0].node) == piece)
          name += (name.empty() ? "" : " with ") + body->name;
    return name.empty() ? "node" : name;
  }



  Eigen::VectorXd
  Assembly::pull() const
  {
    // the gradient of half the squares of the scaled gaps, as multipliers of the rows as they are
    Eigen::VectorXd y = gaps_at(state_at(place));
    for (int i = 0; i < y.size(); ++i)
      y(i) *= scale[i];
    return y;
  }



  Vector3
  Assembly::pull_on(const unsigned int node, const std::vector<unsigned int> &rows, const Eigen::VectorXd &y) const
  {
    Vector3   force = Vector3::Zero(); // in the axes of the node
    const int first = system.layout.of_node(node);
    for (const auto i : rows)
      for (int l = 0; l < 3; ++l)
        if (const int k = K.pattern->position(first + l, system.layout.of_multiplier(i)); k >= 0)
          force(l) += K.values[k] * y(i);
    return state_at(place).triad(node) * force;
  }



  std::vector<std::string>
  Assembly::loop() const
  {
    struct Edge
    {
      std::string  name;
      unsigned int a, b;
      double       pull;
    };
    const State           state = state_at(place);
    const Eigen::VectorXd y     = pull();
    const Eigen::VectorXd g     = gaps_at(state);
    std::vector<Edge>     edges;
    double                largest = 0;
    for (const auto *const item : system.layout.joints)
      {
        double size = 0;
        for (const auto i : rows_of(*item))
          size = std::max(size, std::abs(g(i)));
        const auto frames = ends_of(*item);
        const auto piece = [&](const unsigned int i) { return frames.size() == 2 ? piece_of_node(frames[i].node) : 0; };
        edges.push_back({item->name, piece(0), piece(1), size});
        largest = std::max(largest, size);
      }
    edges.erase(std::remove_if(edges.begin(), edges.end(), [&](const Edge &e) { return e.pull < no_part * largest; }),
                edges.end());
    // round the loop, as long as one joint follows from the other
    std::vector<std::string> result;
    unsigned int             at = edges.empty() ? 0 : edges[0].a;
    while (!edges.empty())
      {
        auto next = std::find_if(edges.begin(), edges.end(), [&](const Edge &e) { return e.a == at || e.b == at; });
        if (next == edges.end())
          next = edges.begin();
        if (next->a != at && next->b != at)
          at = next->a;
        result.push_back("<" + name_of_piece(at) + ">");
        result.push_back(next->name);
        at = next->a == at ? next->b : next->a;
        edges.erase(next);
      }
    if (!result.empty())
      result.push_back("<" + name_of_piece(at) + ">");
    return result;
  }



  std::vector<Assembly::Remedy>
  Assembly::remedies() const
  {
    const State           state = state_at(place);
    const Eigen::VectorXd y = pull(), g = gaps_at(state);
    K.clear();
    system.add_constraint_tangent(state.point(), K);
    struct Hold
    {
      std::string joint;
      Vector3     at, force; ///< on the piece [1/m]
    };
    std::map<unsigned int, std::vector<Hold>> holds;
    std::vector<Remedy>                       result;
    const auto add = [&](const std::string &what, const double present, const double slope) {
      // ½ g² falls by g²/2 · 2 to first order of |g|
      if (std::abs(slope) * present > no_part * g.squaredNorm())
        result.push_back({what, present, -g.squaredNorm() / slope});
    };
    for (const auto *const item : system.layout.joints)
      {
        const auto frames = ends_of(*item);
        const auto rows   = rows_of(*item);
        if (frames.size() != 2)
          continue;
        for (const unsigned int i : {0, 1})
          {
            // the ground has no rows: what pulls on it is what pulls on the other end
            const Frame  &frame = frames[i], &other = frames[1 - i];
            const Vector3 force =
              frame.node != 0 ? pull_on(frame.node, rows, y) : Vector3(-pull_on(other.node, rows, y));
            holds[piece_of_node(frame.node)].push_back({item->name, frame.position(state.q.data()), force});
          }
        if (item->kind == "distance")
          {
            const Vector3 line = frames[1].position(state.q.data()) - frames[0].position(state.q.data());
            const bool    is_b = frames[1].node != 0;
            const Vector3 pull = (is_b ? 1. : -1.) * pull_on(frames[is_b ? 1 : 0].node, rows, y);
            add("length of <" + item->name + ">", line.norm(), -pull.dot(line.normalized()));
          }
      }
    for (const auto &[piece, of_piece] : holds)
      for (unsigned int i = 0; i < of_piece.size(); ++i)
        for (unsigned int j = i + 1; j < of_piece.size(); ++j)
          if (const Vector3 line = of_piece[j].at - of_piece[i].at; line.norm() > 1e-6 * length)
            add((piece == 0 ? "distance on the ground from <" : "length of <" + name_of_piece(piece) + "> from <") +
                  of_piece[i].joint + "> to <" + of_piece[j].joint + ">",
                line.norm(),
                of_piece[j].force.dot(line.normalized()));
    std::stable_sort(result.begin(), result.end(), [](const Remedy &a, const Remedy &b) {
      return std::abs(a.change) < std::abs(b.change);
    });
    return result;
  }
} // namespace samara
