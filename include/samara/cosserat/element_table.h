#ifndef samara_cosserat_element_table_h
#define samara_cosserat_element_table_h

#include <Eigen/Dense>

#include <deal.II/base/point.h>

#include <vector>

namespace samara
{
  /**
   * Values of the shape functions of one degree, the same for all elements: FE_Q(p) on Gauss–Lobatto nodes.
   *
   * Strains of direction α are sampled at tying points, p Gauss points along α times p + 1 across, and interpolated to
   * the (p+1)^(dim−1) · ... integration points. For dim = 1 both are the p Gauss points (reduced integration, no
   * locking); for dim = 2 this is the line-reduced assumed strain.
   */
  template <int dim>
  struct ElementTable
  {
    /** No element has more nodes, or more tying points of all directions. */
    static constexpr unsigned int most_nodes = dim == 1 ? 7 : 49,
                                  most_tied  = dim == 1 ? most_nodes - 1 : 2 * most_nodes;

    explicit ElementTable(unsigned int degree);

    unsigned int degree, n_nodes, n_points, n_tying; ///< tying points per direction

    std::vector<dealii::Point<dim>> nodes; ///< on the unit cell, in the order of FE_Q
    Eigen::VectorXd                 node_weights; ///< Gauss–Lobatto weights: lumped inertia

    std::vector<dealii::Point<dim>> points; ///< of integration
    Eigen::VectorXd                 weights;

    /** At tying points, row t + α n_tying: shape values and derivatives with respect to the unit coordinate α. */
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> N, dN;

    /** interpolation[α](g, t): weight of tying point t of direction α at integration point g. */
    std::vector<Eigen::MatrixXd> interpolation;

    /** Values of all shape functions at integration points, (point, node). */
    Eigen::MatrixXd value_at_points;

    /** Derivatives of all shape functions at integration points and at nodes, (point, node) for each direction. */
    std::vector<Eigen::MatrixXd> gradient_at_points, gradient_at_nodes;
  };
} // namespace samara

#endif
