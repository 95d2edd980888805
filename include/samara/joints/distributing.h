#ifndef samara_joints_distributing_h
#define samara_joints_distributing_h

#include <samara/model/system.h>

namespace samara
{
  /**
   * Attaches a body to edges of shells so softly that they deform as if they were free: the mean motion of the edges is
   * that of a frame B of the body at their centroid. With shares w_a of the length, Σ w_a = 1, frames a of the nodes
   * and B with the same axes at first, places r_a in B of the reference configuration,
   *
   *     Σ w_a x_a − x_B = 0          s_k · E_j − s_j · E_k = 0,  (i, j, k) cyclic,
   *     s_k = Σ w_a (r_ak x_a + ½ κ d_k^a),  κ = h²/12
   *
   * E the axes of B, d those of the nodes, h the thickness. Rigid motions satisfy all six; force and moment are shared
   * by least squares, f_a = w_a (λ + E M r_a), M = −μ~. Where the edges are one straight line it is the rotations of
   * the nodes that hold the turn about it. All six are quadratic. Multipliers: the force λ on B [N], and μ.
   */
  class Distributing : public Item, public Evaluated<Distributing, Constraint>
  {
  public:
    std::string
    noun() const override
    {
      return "joint";
    }

    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;
    void connect(Layout &layout) override;

    void tangent(const Point<double> &point, SparseMatrix &K) const override;
    void rates(const Point<double> &point, double *rates) const override;
    void second_rates(const Point<double> &point, double *rates) const override;

    template <typename Number>
    void residual_at(const Point<Number> &point, Number *r) const;

    /** "force 1" to "moment 3": of the edges on the body, at the centroid, in inertial axes [N, N m]. */
    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;

  private:
    std::vector<std::string> edges;
    std::string              body;

    struct Node
    {
      Frame   frame;
      double  weight;       ///< w_a
      Vector3 place;        ///< r_a [m]
      double  of_axes = 0;  ///< ½ κ w_a [m²]
      Block   block   = {}; ///< of the frame, B, and the multipliers
    };
    std::vector<Node> nodes;
    bool              is_of_areas = false; ///< whether shares are of areas, not of lengths
    Frame             b;
    Block             block; ///< of B and the multipliers
    unsigned int      first_multiplier = 0;

    /** Add the nodes of an edge or a region, and their shares of its @p size, its length or area. */
    void read_part(const std::string &path, Model &model, double &size, Vector3 &centroid);

    /** s₁ s₂ s₃ as columns. */
    template <typename Number>
    Mat3<Number> moments(const Number *q) const;
  };

  extern template class Evaluated<Distributing, Constraint>;
} // namespace samara

#endif
