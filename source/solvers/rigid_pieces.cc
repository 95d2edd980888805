#include <samara/base/disjoint_sets.h>
#include <samara/solvers/rigid_pieces.h>

namespace samara
{
  RigidPieces::RigidPieces(const System &system, const double length)
    : system(system)
    , length(length)
    , piece(system.layout.n_nodes)
    , twist(system.layout.n_nodes, Matrix6::Zero())
  {
    DisjointSets groups(system.layout.n_nodes);
    for (const auto &nodes : system.rigid_nodes())
      for (const auto node : nodes)
        {
          const unsigned int a = groups.root_of(nodes[0]), b = groups.root_of(node);
          groups.join(std::max(a, b), std::min(a, b)); // the ground stays a root
        }
    for (unsigned int node = 1; node < piece.size(); ++node)
      piece[node] = groups.root_of(node) == node ? n_pieces++ : piece[groups.root_of(node)];
  }



  void
  RigidPieces::renew(const State &state)
  {
    std::vector<Vector3>      middle(n_pieces, Vector3::Zero());
    std::vector<unsigned int> n(n_pieces, 0);
    for (unsigned int node = 0; node < piece.size(); ++node)
      {
        middle[piece[node]] += state.position(node);
        ++n[piece[node]];
      }
    for (unsigned int node = 1; node < piece.size(); ++node)
      {
        const Matrix3 Dt  = state.triad(node).transpose();
        const Vector3 arm = state.position(node) - middle[piece[node]] / n[piece[node]];
        twist[node] << length * Dt, -Dt * skew(arm), Matrix3::Zero(), Dt;
      }
  }



  void
  RigidPieces::add_twist(const unsigned int node,
                         const Row6        &coefficients,
                         Eigen::MatrixXd   &A,
                         const unsigned int row) const
  {
    if (piece[node] > 0)
      A.block<1, 6>(row, column_of_node(node)) += coefficients * twist[node];
  }



  std::vector<double>
  RigidPieces::velocities(const Eigen::VectorXd &x) const
  {
    std::vector<double> y(system.size(), 0.);
    for (unsigned int node = 1; node < piece.size(); ++node)
      if (piece[node] > 0)
        {
          Eigen::Map<Vector6> twist_of_node(&y[system.layout.of_node(node)]);
          twist_of_node = twist[node] * x.segment<6>(column_of_node(node));
        }
    for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
      y[system.layout.of_coordinate(i)] = coordinate_unit(i) * x(column_of_coordinate(i));
    return y;
  }
} // namespace samara
