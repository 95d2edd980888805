#ifndef samara_cosserat_cosserat_h
#define samara_cosserat_cosserat_h

#include <samara/cosserat/element_lanes.h>
#include <samara/cosserat/element_table.h>
#include <samara/cosserat/kernel.h>
#include <samara/model/system.h>

#include <array>
#include <memory>

namespace samara
{
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /**
   * Finite elements of a Cosserat continuum of dimension @p dim: a beam (1) or a shell (2). A position and a triad at
   * every point, 6 dim strains, a 6×6 inertia. Energy ½ ∫ eᵀ C e with a symmetric positive definite C; inertia lumped
   * at the nodes by the Gauss–Lobatto rule.
   *
   * A derived class (Beam) knows geometry and material: it fills @p table, the elements with add_element(), and that is
   * all; everything that is computed is here. Strains at a point are those of direction 1, then 2: for a beam
   * Γ₁ Γ₂ Γ₃ [1], K₁ K₂ K₃ [1/m] in the section axes d₁ (tangent) d₂ d₃, minus their reference values; stresses are the
   * conjugate section forces [N] and moments [N m].
   *
   * Source: the paper, section 2.1 and [20]; interpolation of directors: Romero & Armero 2002, Betsch & Steinmann 2002.
   */
  template <int dim>
  class Cosserat : public Body, public EvaluatedDeformation<Cosserat<dim>>
  {
  public:
    static constexpr int          dimension = dim;
    static constexpr unsigned int n         = 6 * dim; ///< strains at a point
    using VectorN                           = Eigen::Matrix<double, n, 1>;
    using MatrixN                           = Eigen::Matrix<double, n, n>;

    void connect(Layout &layout) override;

    unsigned int
    n_strains() const override
    {
      return n * points.size();
    }
    void   strain_rates(const Point<double> &point, double *rates) const override;
    void   strain_rates_and_residual(const Point<double> &point, double *rates, double *r) const override;
    void   tangent(const Point<double> &point, SparseMatrix &K) const override;
    void   damping(const Point<double> &point, SparseMatrix &C) const override;
    void   strain_rows(const Point<double> &point, StrainRows &rows) const override;
    double power(const double *stress, const double *rates) const override;
    double strain_energy(const double *e) const override;
    bool   is_viscous() const override;

    std::unique_ptr<LinearStrains> linear_strains() const override;
    std::unique_ptr<Deformation>   joined(std::vector<const Deformation *> &terms) const override;

    template <typename Number>
    void strains_at(const Point<Number> &point, Number *e) const;
    template <typename Number>
    void stresses_of(const Number *e, const Number *rates, Number *stress) const;
    template <typename Number>
    void residual_at(const Point<Number> &point, Number *r) const;

    /** Elements that deform. */
    unsigned int
    n_elements() const
    {
      return is_rigid ? 0 : elements.size();
    }

  protected:
    /** Stiffness and viscosity (per rate of strain) of a point. */
    struct Material
    {
      MatrixN stiffness, viscosity;
    };
    std::vector<Material> materials;
    bool                  has_viscous_material = false; ///< any of them, known once connected

    /** Of the elements that are added next: elements of one body may have different degrees. */
    std::shared_ptr<const ElementTable<dim>> table;

    /**
     * One more element on frames, one for each node of the table; @p material_of_point gives the index of a material
     * for each integration point. Reference strains follow from the frames' places in the model.
     */
    void add_element(const Model                     &model,
                     const std::vector<Frame>        &frames,
                     const std::vector<unsigned int> &material_of_point);

    /** Positions and triads of an element's nodes in a state. */
    template <typename Number>
    void gather(unsigned int element, const Number *q, kernel::NodeValues<Number> *nodes) const;

    /** Strains of one element at its integration points, 6 dim each, those of its first point first. */
    void element_strains(unsigned int element, const double *q, double *e) const;
    /** The same from its nodes. An element with other strains overrides it, see prototype.h. */
    virtual void element_strains(unsigned int element, const kernel::NodeValues<double> *nodes, double *e) const;

    /** No element has more nodes. */
    static constexpr unsigned int most_nodes = ElementTable<dim>::most_nodes;

    struct Element
    {
      std::vector<Frame> frames;
      bool               all_nodes = true; ///< no frame is offset from its node
      Block              block;

      std::shared_ptr<const ElementTable<dim>> table;
      unsigned int                             first_point; ///< of integration, among those of the body
    };
    std::vector<Element> elements;

    using LocalMap = Eigen::Matrix<double, dim, dim>;

    /** Integration points of all elements, one after another. */
    struct IntegrationPoint
    {
      double       weight;    ///< [m] or [m²]
      LocalMap     T;         ///< from derivatives by unit coordinates to derivatives by length in the local axes
      VectorN      reference; ///< strain of the reference configuration
      unsigned int material;
    };
    const std::vector<IntegrationPoint> &
    integration_points() const
    {
      return points;
    }

    /** Take the elements out of all computations: their nodes are welded together, and they serve for drawing only. */
    void make_rigid();

    bool is_rigid = false;

  private:
    friend class TensionTorsion; // an energy more of the same strains
    friend class ElementLanes<dim>;

    /** Whether strains and forces are those of this class, which may be computed together with those of other bodies.
     */
    virtual bool
    joins() const
    {
      return true;
    }

    std::vector<IntegrationPoint> points;

    /** Add BᵀCB with @p C of each integration point (null: none) and the geometric part of these section forces. */
    void add_tangent(const Point<double> &point, const MatrixN *C, const double *forces, SparseMatrix &K) const;

    /** Call f(number of the integration point, block, B there by unknowns of nodes) for all of them. */
    template <typename Function>
    void for_strain_matrices(const Point<double> &point, const Function &f) const;

    static constexpr unsigned int most_tied = ElementTable<dim>::most_tied;

    /** Strains of an element at its integration points from those at the tying points. */
    template <typename Number>
    void to_points(unsigned int element, const Vec6<Number> *tied, Number *e) const;

    /** Section forces at the tying points, weights included, from stresses at the integration points. */
    template <typename Number>
    void to_tying(unsigned int element, const Number *stress, Vec6<Number> *tied) const;

    ElementLanes<dim> lanes; ///< its own elements

    /** Strains of the reference configuration, so that there they are zero to the last digit. */
    void take_reference(const Model &model);

    template <typename Number>
    void subtract_reference(Number *e) const;

    /** Call f(i, matrix) for all elements i, interpolated, and add the matrices to @p A. */
    template <typename Function>
    void add_matrices(SparseMatrix &A, const Function &f, const Point<double> &point) const;

    static constexpr unsigned int worth_threads = ElementLanes<dim>::worth_threads;

    /** Positions and triads of an element's nodes, and what is interpolated from them at the tying points, into
     * scratch(). */
    void interpolate_element(unsigned int element, const double *q) const;

    /** B of an element at its integration points from what is in scratch(), rows of 6 dim. */
    void strain_matrix(unsigned int element, RowMajor &B) const;

    void add_material(unsigned int element, MatrixN Material::*which, Eigen::MatrixXd &K) const;
    /** The same with a stiffness of each integration point of the body, given by its number. */
    template <typename Stiffness>
    void add_stiffness(unsigned int element, const Stiffness &stiffness, Eigen::MatrixXd &K) const;
    void add_geometric(unsigned int element, const Vec6<double> *tied, Eigen::MatrixXd &K) const;

    /** Work space of one element, kept so that the loop over elements allocates nothing. */
    struct Scratch
    {
      std::array<kernel::NodeValues<double>, most_nodes> nodes;
      std::array<kernel::PointValues<double>, most_tied> at;
      std::array<Vec6<double>, most_tied>                tied;
      std::vector<kernel::PointValues<double>>           forces; // on the nodes
      RowMajor                                           B_tied, B, CB;
      std::vector<Vector3>                               n, m; // sums over the points for pairs of nodes
    };
    static Scratch &scratch();
  };

  template <int dim>
  template <typename Function>
  void
  Cosserat<dim>::for_strain_matrices(const Point<double> &point, const Function &f) const
  {
    RowMajor &B = scratch().B;
    for (unsigned int i = 0; i < n_elements(); ++i)
      {
        const Element &element = elements[i];
        interpolate_element(i, point.q);
        B.resize(n * element.table->n_points, 6 * element.table->n_nodes);
        strain_matrix(i, B);
        element.block.to_nodes(B);
        for (unsigned int g = 0; g < element.table->n_points; ++g)
          f(element.first_point + g, element.block, B.template middleRows<n>(n * g));
      }
  }



  extern template class Cosserat<1>;
  extern template class Cosserat<2>;
  extern template class Evaluated<Cosserat<1>, Deformation>;
  extern template class EvaluatedDeformation<Cosserat<1>>;
  extern template class Evaluated<Cosserat<2>, Deformation>;
  extern template class EvaluatedDeformation<Cosserat<2>>;
} // namespace samara

#endif
