#ifndef samara_cosserat_skeleton_h
#define samara_cosserat_skeleton_h

#include <samara/model/system.h>

namespace samara
{
  /**
   * An element to copy; doc/how_to/element.md tells how. It is tested (tests/skeleton), but not in the catalogue.
   *
   * A strut: an elastic, viscous line between points A and B of two bodies, with ball joints at both ends. With the gap
   * Δ = x_B − x_A and the length L of the strut free of stress,
   *
   *     e = (Δ·Δ − L²) / (2 L²)     σ = EA L (e + τ ė)     energy ½ EA L e²
   *
   * e is the strain of Green and Lagrange [1], quadratic in the coordinates; σ [N m] is what does work on e. The force
   * that pulls the ends together is σ |Δ| / L². Positive is tension; a strut under pressure does not buckle, a slack
   * cable it is not. Half of the mass is at each end.
   *
   * Complains in initialize() about points that do not exist, that coincide, or that belong to one body.
   */
  class Strut : public Item, public EvaluatedDeformation<Strut>
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;
    void connect(Layout &layout) override;

    unsigned int
    n_strains() const override
    {
      return 1;
    }
    void   strain_rates(const Point<double> &point, double *rates) const override;
    void   tangent(const Point<double> &point, SparseMatrix &K) const override;
    void   damping(const Point<double> &point, SparseMatrix &C) const override;
    double strain_energy(const double *e) const override;
    bool
    is_viscous() const override
    {
      return relaxation_time != 0;
    }

    template <typename Number>
    void strains_at(const Point<Number> &point, Number *e) const;
    template <typename Number>
    void stresses_of(const Number *e, const Number *rates, Number *stress) const;
    template <typename Number>
    void residual_at(const Point<Number> &point, Number *r) const;

    /** "strain", "force" (tension positive) */
    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;
    void                     draw(const State &state, Drawing &drawing) const override;

  private:
    std::string point_a, point_b;
    double      EA = 0, length = 0, mass = 0, relaxation_time = 0;
    Frame       frame_a, frame_b;
    Block       block;

    /** B, the derivative of e with respect to the twists (u_A, θ_A, u_B, θ_B) of the two frames in their own axes. */
    template <typename Number>
    Eigen::Matrix<Number, 12, 1> gradient(const Number *q, const Number *q_of_forces) const;
  };

  // instantiated where the templates of the classes are defined
  extern template class Evaluated<Strut, Deformation>;
  extern template class EvaluatedDeformation<Strut>;
} // namespace samara

#endif
