#ifndef samara_cosserat_prototype_h
#define samara_cosserat_prototype_h

#include <samara/base/differentiation.h>
#include <samara/cosserat/cosserat.h>

#include <complex>

namespace samara
{
  /** What the strains of a prototype may know of an element beside its nodes. */
  template <int dim>
  struct PrototypeElement
  {
    const ElementTable<dim> &table; ///< shape functions of the degree

    /** At each integration point: from derivatives by unit coordinates to derivatives by length in the local axes. */
    std::vector<Eigen::Matrix<double, dim, dim>> T;

    /** Value of shape function @p a at integration point @p g. */
    double
    value(const unsigned int g, const unsigned int a) const
    {
      return table.value_at_points(g, a);
    }

    /** Its derivative by length along the local axis @p alpha [1/m]. */
    double
    slope(const unsigned int g, const unsigned int a, const unsigned int alpha) const
    {
      double sum = 0;
      for (unsigned int beta = 0; beta < dim; ++beta)
        sum += T[g](alpha, beta) * table.gradient_at_points[beta](g, a);
      return sum;
    }
  };



  /**
   * A beam or a shell of which only the strains are written: everything else, meshes, sections, loads, analyses,
   * output, is that of @p Base, Beam or Shell, and derivatives are found by automatic differentiation.
   * doc/how_to/element.md has the way from here to an element that is fast.
   *
   * The derived class, whose elements have (degree_of_elements + 1)^dim nodes, has
   *
   *     template <typename Number>
   *     void strains_of(const PrototypeElement<dim> &element, const kernel::NodeValues<Number> *nodes, Number *e)
   * const;
   *
   * which gives the 6 dim strains at all integration points, those of the first point first, in the order of Cosserat.
   * Those of the reference configuration need not be zero; they are subtracted. The nodes' triads may be a little off
   * from orthonormal.
   *
   * Energy: a step keeps it to round-off only if strains are quadratic in places and triads of the nodes. Others miss
   * what the step misses: order 2 s, as tests/skeleton shows. `Analyses = verification` tells which they are.
   *
   * Speed: with n = 6 times the nodes of an element, a residual costs n evaluations of the strains, a matrix n².
   */
  template <typename Derived, typename Base, int degree_of_elements>
  class Prototype : public Base
  {
  public:
    static constexpr int          dim     = Base::dimension;
    static constexpr unsigned int n_nodes = (degree_of_elements + 1) * (dim == 1 ? 1 : degree_of_elements + 1);

    Prototype()
    {
      Base::degree = degree_of_elements;
    }

    void initialize(Model &model) override;

    void
    strains(const Point<double> &point, double *e) const override
    {
      all_strains(point, e);
    }
    void
    strains(const Point<std::complex<double>> &point, std::complex<double> *e) const override
    {
      all_strains(point, e);
    }
    void strain_rates(const Point<double> &point, double *rates) const override;
    void
    residual(const Point<double> &point, double *r) const override
    {
      add_residual(point, r);
    }
    void
    residual(const Point<std::complex<double>> &point, std::complex<double> *r) const override
    {
      add_residual(point, r);
    }
    void tangent(const Point<double> &point, SparseMatrix &K) const override;
    void damping(const Point<double> &point, SparseMatrix &C) const override;

    /** The matrices hold everything: no rows are offered, and none are stored. */
    void
    strain_rows(const Point<double> &, StrainRows &) const override
    {}
    std::unique_ptr<LinearStrains>
    linear_strains() const override
    {
      return Deformation::linear_strains();
    }

  protected:
    void element_strains(unsigned int i, const kernel::NodeValues<double> *nodes, double *e) const override;

  private:
    bool
    joins() const override
    {
      return false;
    }

    static constexpr unsigned int n = 6 * dim;     ///< strains at a point
    static constexpr int          N = 6 * n_nodes; ///< twists of an element
    template <typename Number>
    using Nodes = std::array<kernel::NodeValues<Number>, n_nodes>;

    const Derived &
    self() const
    {
      return static_cast<const Derived &>(*this);
    }

    PrototypeElement<dim> element(unsigned int i) const;
    template <typename Number>
    Nodes<Number> nodes_of(unsigned int i, const Number *q) const;

    /** Strains of element @p i, those of the reference not subtracted. */
    template <typename Number>
    std::vector<Number> strains_at_nodes(unsigned int i, const Nodes<Number> &nodes) const;

    /** Nodes moved by as many unknown twists of theirs, x + E u, D + E θ~, in their own axes E = D or those @p axes. */
    template <typename Number>
    static Nodes<Differential<Number, N>> varied(const Nodes<Number> &nodes, const Nodes<Number> &axes);
    template <typename Number>
    static Nodes<Differential<Number, N>>
    varied(const Nodes<Number> &nodes)
    {
      return varied(nodes, nodes);
    }

    template <typename Number>
    void all_strains(const Point<Number> &point, Number *e) const;
    template <typename Number>
    void add_residual(const Point<Number> &point, Number *r) const;

    using MatrixN = typename Base::MatrixN;
    /** BᵀCB of an element with C = @p which of its materials, the derivatives @p e of its strains given. */
    template <typename Number>
    Eigen::MatrixXd material_part(unsigned int i, MatrixN Base::Material::*which, const std::vector<Number> &e) const;
  };
} // namespace samara

#include <samara/cosserat/prototype_functions.h>

#endif
