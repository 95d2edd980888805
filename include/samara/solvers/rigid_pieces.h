#ifndef samara_solvers_rigid_pieces_h
#define samara_solvers_rigid_pieces_h

#include <samara/model/relative_motion.h>
#include <samara/model/system.h>

namespace samara
{
  using Row6 = Eigen::Matrix<double, 1, 6>;

  /**
   * The pieces that a model falls into if nothing within them may be strained: the nodes that its items tie
   * together, and single ones. What moves with the ground is piece 0.
   *
   * Unknowns of their motions, in this order: (v/L, ω) of each piece but the ground, v at the middle of its nodes, L
   * the length of the model; rates of joint coordinates, displacements over L. All are [1/s], in inertial axes.
   */
  class RigidPieces
  {
  public:
    RigidPieces(const System &system, double length);

    unsigned int
    n_unknowns() const
    {
      return 6 * (n_pieces - 1) + system.layout.n_coordinates;
    }
    /** Whether any piece has more than one node: it could be strained. */
    bool
    are_flexible() const
    {
      return n_pieces < system.layout.n_nodes;
    }

    /** Look at another state: where the middles are. */
    void renew(const State &state);

    /** Add @p coefficients times the twist of @p node, in its own axes, to a row of a matrix in the pieces' unknowns.
     */
    void add_twist(unsigned int node, const Row6 &coefficients, Eigen::MatrixXd &A, unsigned int row) const;

    /** The factor of a coordinate's rate in the unknowns, and its column. */
    double
    coordinate_unit(const unsigned int i) const
    {
      return system.layout.scale_of(system.layout.of_coordinate(i), length);
    }
    unsigned int
    column_of_coordinate(const unsigned int i) const
    {
      return 6 * (n_pieces - 1) + i;
    }
    /** The six columns of the piece of a node; negative for the ground. */
    int
    column_of_node(const unsigned int node) const
    {
      return 6 * (static_cast<int>(piece[node]) - 1);
    }

    /** The twist of a node, in its own axes, from the unknowns of its piece. */
    const Matrix6 &
    twist_of_node(const unsigned int node) const
    {
      return twist[node];
    }

    /** Velocities of all unknowns of the system (twists, rates) from those of the pieces. */
    std::vector<double> velocities(const Eigen::VectorXd &x) const;

  private:
    const System             &system;
    const double              length;
    unsigned int              n_pieces = 1;
    std::vector<unsigned int> piece; // of each node
    std::vector<Matrix6>      twist; // of each node from the unknowns of its piece
  };
} // namespace samara

#endif
