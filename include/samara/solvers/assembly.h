#ifndef samara_solvers_assembly_h
#define samara_solvers_assembly_h

#include <samara/model/moved.h>
#include <samara/solvers/linear.h>
#include <samara/solvers/rigid_pieces.h>

#include <Eigen/SparseCore>

namespace samara
{
  /**
   * How the bodies of a model that is drawn roughly are moved until its constraints hold (doc/theory/assembly.md).
   *
   * Nothing is strained: the pieces of the model move as rigid bodies, those that beams hold together as one. Of all
   * places at which the constraints hold that one is taken which is nearest to the drawing, in the distance
   *
   *     D² = Σ w (|c − c₀|² + ℓ² ϑ²)
   *
   * over all pieces, c the middle of the places where a piece is held [m], ℓ the mean distance of these from it [m], ϑ
   * the angle by which the piece has turned [rad], w its weight [1]. It is found from the drawing downhill: first the
   * gaps close (Levenberg–Marquardt), then D decreases among the places without gaps. The branch is that which is
   * reached so. Where gaps stay, some more starts near the drawing are tried.
   *
   * Rows between relative motions, of drives, gears and pitches, keep what they are in the drawing. Rows of velocities
   * alone say nothing.
   */
  class Assembly
  {
  public:
    /**
     * @p system as it is drawn, see Gaps::open. @p weights of all nodes, those of a piece the largest of its
     * nodes; pieces with a node among @p fixed stay.
     */
    Assembly(const System &system, const std::vector<double> &weights, const std::vector<bool> &fixed);

    /** Look for the place; returns whether the constraints hold there. */
    bool close();

    /** Whether the drawing needs nothing. */
    bool fits() const;

    /** How a node has moved from the drawing: x ↦ x₀ + R x. Of one that has not it is the identity. */
    Placement motion_of(unsigned int node) const;

    /** Of the model [m]. */
    double
    size() const
    {
      return length;
    }

    /** D [m], now. */
    double distance() const;

    /** From which start it has been found: 0 the drawing itself. */
    unsigned int start = 0;

    /** A joint, or what else has constraints, with its largest gap. */
    struct Gap
    {
      std::string name;
      double      drawn = 0, now = 0;         ///< between the points of a joint, as far as it holds them [m]
      double      drawn_angle = 0, angle = 0; ///< between axes [rad], and of relative motions in gears and pitches
    };
    std::vector<Gap> gaps() const;

    /** A length between two places where a body is held, and how much longer it would have to be for no gap [m]. */
    struct Remedy
    {
      std::string what;
      double      length = 0, change = 0;
    };

    /** Of gaps that stay: joints that pull against each other there, in the order of the loop if it is one. */
    std::vector<std::string> loop() const;
    /** Lengths that would mend it, to first order; those first that would have to change least. */
    std::vector<Remedy> remedies() const;

  private:
    struct Piece
    {
      Vector3 middle = Vector3::Zero(), centre = Vector3::Zero(); ///< of its nodes, of where it is held: drawn [m]
      double  length = 0, weight = 1;
      bool    is_fixed = false;
    };
    /** Where everything is: of each piece its turn and where its middle is; all joint coordinates. */
    struct Place
    {
      std::vector<Matrix3> turn;
      std::vector<Vector3> middle;
      std::vector<double>  coordinates;
    };

    const System                  &system;
    const State                    drawn;
    const double                   length;
    RigidPieces                    pieces;
    std::vector<Piece>             of_piece;
    std::vector<int>               column;     ///< of each of the pieces' unknowns among those that may change, or -1
    unsigned int                   n_open = 0; ///< of these
    std::vector<double>            target;     ///< of each row
    std::vector<double>            drawn_coordinates;
    std::vector<bool>              is_out;     ///< rows that say nothing
    std::vector<double>            scale;      ///< of each row, see row_scale()
    std::vector<double>            per_length; ///< of each row, how much it changes with a displacement; 0 of angles
    Place                          place;
    std::unique_ptr<LinearSolver>  solver;
    std::shared_ptr<const Pattern> pattern;

    unsigned int
    piece_of_node(const unsigned int node) const
    {
      return pieces.column_of_node(node) / 6 + 1;
    }
    void find_pieces(const std::vector<double> &weights, const std::vector<bool> &fixed);
    /** Coordinates as they are drawn, and what rows between them are then. */
    void  read_coordinates();
    State state_at(const Place &at) const;
    /** Where the drawing has everything. */
    Place drawing() const;
    /** Gaps of all rows, scaled to parts of the model's length. */
    Eigen::VectorXd gaps_at(const State &state) const;
    /** G of the unknowns that may change, scaled. */
    Eigen::SparseMatrix<double> rows_at(const State &state);
    /** Half the square of D over the length of the model; its matrix and its gradient. */
    double                      distance_at(const Place &at) const;
    Eigen::SparseMatrix<double> weights_at(const Place &at) const;
    Eigen::VectorXd             gradient_at(const Place &at) const;
    /** [W Gᵀ; G −μ] (δ, λ) = (a, b); returns δ. */
    Eigen::VectorXd solve(const Eigen::SparseMatrix<double> &W,
                          const Eigen::SparseMatrix<double> &G,
                          double                             mu,
                          const Eigen::VectorXd             &a,
                          const Eigen::VectorXd             &b);
    Place           moved(const Place &from, const Eigen::VectorXd &step) const;

    /** Move until there is no gap, or it no longer becomes smaller; returns what is left of it [1]. */
    double close_gaps(Place &at);
    /** From a place without gaps to the nearest one. */
    void  approach(Place &at);
    Place shaken(unsigned int seed) const;

    /** Forces that the gaps make: of each row, per length [1/m]; of a joint on a node. */
    Eigen::VectorXd pull() const;
    Vector3         pull_on(unsigned int node, const std::vector<unsigned int> &rows, const Eigen::VectorXd &y) const;
    std::vector<unsigned int> rows_of(const Item &item) const;
    std::string               name_of_piece(unsigned int piece) const;
    mutable SparseMatrix      K;
  };



  /** The frames of all points of a body; of a beam those at which an element ends. After connect(). */
  std::vector<Frame> frames_of(const Body &body);
} // namespace samara

#endif
