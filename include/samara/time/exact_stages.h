#ifndef samara_time_exact_stages_h
#define samara_time_exact_stages_h

#include <samara/model/system.h>
#include <samara/solvers/linear.h>
#include <samara/time/tableau.h>

namespace samara
{
  /**
   * Newton's matrix of all s stages of a step at once, each linearised at its own place: s·n unknowns, the changes of
   * twists δy, of rates of coordinates, and h δλ. Where one matrix for all stages does not converge, as in a step
   * across a singular position (doc/theory/integrators.md), it does.
   *
   * The velocities of all stages l displace stage k, δQ_k = N(Q_k) ζ_k, by ζ_k = Σ_l U_kl δy_l, from
   *
   *     δQ_k = h Σ_l a_kl [ N(δQ_l) y_l + N(Q_l) δy_l ],        ζ̇_k = δy_k − ad_{y_k} ζ_k
   *
   * With C_k and K_k of all terms at stage k at fixed stress, and the stresses of strains that are integrated from
   * their rates, e_k = e_i + h Σ_l a_α,kl ė_l,
   *
   *     δr_k = M Σ_l w_kl δy_l/h + δ(−ad*_{y_k} M y_k) + C_k ζ̇_k + K_k ζ_k + B_kᵀ δσ_k + G_kᵀ δλ_k
   *     δσ_k = C h Σ_l a_α,kl δė_l + C_d δė_k       δė_l = B_l ζ̇_l + Ḃ_l ζ_l
   *     δġ_k = G_k ζ̇_k + Ġ_k ζ_k
   *
   * States of first order have ż as unknowns, δz_k = h Σ_l a_α,kl δż_l.
   *
   * Forces that are seen in reciprocal triads (StageRotation) are linearised in the triads themselves: in steps that
   * turn the matrix is that of the equations to 1 − r_k.
   */
  class ExactStages
  {
  public:
    /** Nodes, (row, column), that are coupled by what is added by add_pair(), besides the pattern of the layout. */
    using Couplings = std::vector<std::pair<unsigned int, unsigned int>>;

    ExactStages(const System &system, const Tableau &tableau, const Couplings &couplings = {});

    /** The matrix at these stages; multipliers that are not active are kept. */
    void assemble(const std::vector<Point<double>> &stages, double h, const std::vector<bool> &is_active);

    /**
     * For forces that couple stages: row @p i of the residual of stage @p k changes by @p value times the change of
     * unknown
     * @p j, a velocity, of stage @p l. To be called between assemble() and solve().
     */
    void add(unsigned int k, unsigned int i, unsigned int l, unsigned int j, double value);

    /**
     * Add a block of the tangent @p K and the damping matrix @p C of stage @p k, of forces that depend on places as
     * they are in the stages: rows of node @p a, columns of node @p b. False if the pattern does not have it.
     */
    bool add_pair(unsigned int k, unsigned int a, unsigned int b, const Matrix6 &K, const Matrix6 &C);

    /**
     * Factorise, and replace the residuals of all stages by the changes of velocities and multipliers that make them
     * zero, n numbers a stage. @throws SingularMatrix
     */
    void solve(std::vector<std::vector<double>> &residuals);

    /** ζ of what the stress sees, with a_α in place of a, and ζ̇ of stage @p k: of the changes that solve() found. */
    void displacements(unsigned int                            k,
                       const std::vector<std::vector<double>> &changes,
                       std::vector<double>                    &zeta_alpha,
                       std::vector<double>                    &zeta_rate) const;

  private:
    const System                  &system;
    const Tableau                 &tableau;
    std::shared_ptr<const Pattern> single; ///< of one stage, with what pairs couple
    std::vector<int>  in_single; ///< where entries of the layout's pattern are in it; empty: they are the same
    SparseMatrix      matrix, K, C, M, K_ahead, K_behind;
    std::vector<bool> active;              ///< multipliers
    std::vector<int>  kept;                ///< entries of the matrix that couple these and what moves; empty: all
    std::unique_ptr<SparseMatrix> of_kept; ///< none if all are kept
    std::unique_ptr<LinearSolver> solver;
    double                        h = 0;
    std::vector<double>           x, moved_q, moved_coordinates;

    /** B and Ḃ of the strains of one point of material at all stages, by blocks of columns: nodes and coordinates. */
    struct Strains
    {
      StrainRows::Point of;
      struct Block
      {
        unsigned int                 first, width;    ///< unknowns
        std::vector<Eigen::MatrixXd> B, B_dot, rates; ///< of stages; rates: δė_l by δy_m, number s l + m
      };
      std::vector<Block> blocks;
    };

    /** Blocks [k][l] of the displacements and their rates by changes of velocities: of one node, or of one coordinate.
     */
    struct Kinematics
    {
      Eigen::MatrixXd U, U_alpha, V; ///< 6s × 6s, s × s; U by a, U_alpha by a_α, V of ζ̇
    };
    std::vector<Kinematics> kinematics; ///< of all nodes but the ground
    Kinematics              of_coordinates, of_states;

    Eigen::MatrixXd displacement_of_node(const std::vector<Point<double>> &stages, unsigned int node) const;
    void            find_kinematics(const std::vector<Point<double>> &stages);
    void            linearize(const Point<double> &stage);
    /** Add BᵀC δe + BᵀC_d δė of all strains. */
    void add_material(const std::vector<Point<double>> &stages);
    void add_material(const std::vector<StrainRows> &rows, Strains &strains);
    /** Add @p factor times the rows of a stage to B or Ḃ of all points' strains. */
    void gather(const StrainRows            &rows,
                unsigned int                 stage,
                double                       factor,
                std::vector<Eigen::MatrixXd> Strains::Block::*which,
                std::vector<Strains>                         &strains) const;
    const Kinematics &
    kinematics_of(const unsigned int unknown) const
    {
      return unknown < static_cast<unsigned int>(system.layout.of_coordinate(0)) ? kinematics[unknown / 6] :
                                                                                   of_coordinates;
    }
    /** The stage, @p dt along its velocities. */
    Point<double> moved(const Point<double> &stage, double dt);
    void          constraints_moved(const Point<double> &stage, double dt, SparseMatrix &result);
    void          add_columns(unsigned int k, unsigned int first, unsigned int width, const Kinematics &kinematics);
    /** Places in the layout's pattern, and in that of one stage. */
    int place(unsigned int k, int position, unsigned int l, unsigned int column) const;
    int place_in_single(unsigned int k, int position, unsigned int l, unsigned int column) const;
    int
    place_of(const int position) const
    {
      return in_single.empty() ? position : in_single[position];
    }
    /** Solver without rows and columns of multipliers that are not active: of them only the diagonal. */
    void make_solver_of(const std::vector<bool> &is_active);
  };
} // namespace samara

#endif
