#ifndef samara_joints_support_h
#define samara_joints_support_h

#include <samara/joints/pair.h>
#include <samara/model/system.h>

#include <array>
#include <vector>

namespace samara
{
  /**
   * Holds points, and all nodes along edges of shells, on the ground: hinged edges, rollers, planes of symmetry. Each
   * node keeps the chosen displacements and rotations in the axes of the support at their reference values:
   *
   *     displacement i      E_i · (x − X) = 0
   *     one rotation k      e_i of the ground stays normal to e_j of the node, (k, i, j) cyclic
   *     two rotations       e_k of the node, k the free one, stays along e_k of the ground
   *     three rotations     the node keeps its axes
   *
   * What another support of the model holds already is left out, as at the corners where two planes of symmetry meet.
   * If all six are held by one support, nodes are welded to the ground and cost nothing. Force 1 2 3: the sum of the
   * forces on the body along the axes of the support [N].
   */
  class Support : public Item, public Evaluated<Support, Constraint>
  {
  public:
    std::string
    noun() const override
    {
      return "support";
    }

    void add_parameters(Parameters &prm) override;
    void be_placed(const Placement &placement) override;
    void initialize(Model &model) override;
    void connect(Layout &layout) override;

    template <typename Number>
    void residual_at(const Point<Number> &point, Number *r) const;
    void constraints(const Point<double> &point, double *r) const override;
    void tangent(const Point<double> &point, SparseMatrix &K) const override;
    void rates(const Point<double> &point, double *rates) const override;
    void second_rates(const Point<double> &point, double *rates) const override;

    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;

  private:
    /** Axes of the support. @throws std::invalid_argument */
    Matrix3                  triad() const;
    std::vector<std::string> places, fixed_entries = {"all"};
    Vector3                  axis = Vector3::UnitZ(), axis_1 = Vector3::Zero();

    Matrix3             axes = Matrix3::Identity();
    std::array<bool, 6> fixed{{}}; ///< displacements, then rotations
    const Model        *model = nullptr;

    struct Node
    {
      Frame                     ground, frame; ///< both with the axes of the support, at the place of the node
      Vector3                   place;         ///< [m], reference
      std::vector<PairFunction> functions;
      std::vector<int>          force_axes; ///< of the functions; negative for rotations
      unsigned int              first_multiplier = 0;
      Block                     block;

      /** Directions of what it keeps from moving and from turning; inertial axes. */
      std::vector<Vector3> displacements, rotations;
    };
    std::vector<Node> nodes;

    bool read_fixed();
    void add_frames(const std::string &path);
    void choose_functions(Node &node, const Layout &layout) const;

    template <bool with_forces, typename Number>
    void evaluate(const Point<Number> &point, Number *r) const;
  };

  extern template class Evaluated<Support, Constraint>;
} // namespace samara

#endif
