#include <samara/base/composite_rule.h>
#include <samara/cosserat/element_table.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>

namespace samara
{
  using namespace dealii;

  namespace
  {
    /** Product of a rule along direction @p alpha with another one across; for dim 1 the first alone. */
    template <int dim>
    std::vector<dealii::Point<dim>>
    product_points(const Quadrature<1> &along, const Quadrature<1> &across, const unsigned int alpha)
    {
      std::vector<dealii::Point<dim>> result;
      for (unsigned int j = 0; j < (dim == 1 ? 1 : across.size()); ++j)
        for (unsigned int i = 0; i < along.size(); ++i)
          {
            dealii::Point<dim> x;
            x[alpha] = along.point(i)[0];
            if (dim == 2)
              x[1 - alpha] = across.point(j)[0];
            result.push_back(x);
          }
      return result;
    }



    /** Values at @p points of what is known at product_points(): polynomials of Lagrange, (points, product points). */
    template <int dim>
    Eigen::MatrixXd
    interpolation_from_products(const Quadrature<1>                   &along,
                                const Quadrature<1>                   &across,
                                const unsigned int                     alpha,
                                const std::vector<dealii::Point<dim>> &points)
    {
      const auto abscissae = [](const Quadrature<1> &rule) {
        std::vector<double> x;
        for (const auto &point : rule.get_points())
          x.push_back(point[0]);
        return x;
      };
      const std::vector<double> x = abscissae(along), y = abscissae(across);
      Eigen::MatrixXd           L(points.size(), x.size() * (dim == 1 ? 1 : y.size()));
      for (unsigned int g = 0; g < L.rows(); ++g)
        for (unsigned int t = 0; t < L.cols(); ++t)
          {
            L(g, t) = lagrange(x, t % x.size(), points[g][alpha]);
            if (dim == 2)
              L(g, t) *= lagrange(y, t / x.size(), points[g][1 - alpha]);
          }
      return L;
    }
  } // namespace



  template <int dim>
  ElementTable<dim>::ElementTable(const unsigned int degree)
    : degree(degree)
  {
    Assert(degree >= 1, ExcMessage("An element has a degree of at least one."));
    const FE_Q<dim> fe(degree);
    n_nodes = fe.n_dofs_per_cell();
    nodes   = fe.get_unit_support_points();

    const QGaussLobatto<1> lobatto(degree + 1);
    node_weights = Eigen::VectorXd::Ones(n_nodes);
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int i = 0; i <= degree; ++i)
          if (std::abs(lobatto.point(i)[0] - nodes[a][d]) < 1e-10)
            node_weights(a) *= lobatto.weight(i);

    const QGauss<1>       along(degree), across(degree + 1);
    const Quadrature<dim> rule = dim == 1 ? QGauss<dim>(degree) : QGauss<dim>(degree + 1);
    points                     = rule.get_points();
    n_points                   = rule.size();
    weights                    = Eigen::Map<const Eigen::VectorXd>(rule.get_weights().data(), n_points);
    value_at_points.resize(n_points, n_nodes);
    for (unsigned int g = 0; g < n_points; ++g)
      for (unsigned int a = 0; a < n_nodes; ++a)
        value_at_points(g, a) = fe.shape_value(a, points[g]);

    for (unsigned int alpha = 0; alpha < dim; ++alpha)
      {
        const auto tying = product_points<dim>(along, across, alpha);
        n_tying          = tying.size();
        N.conservativeResize((alpha + 1) * n_tying, n_nodes);
        dN.conservativeResize((alpha + 1) * n_tying, n_nodes);
        for (unsigned int t = 0; t < n_tying; ++t)
          for (unsigned int a = 0; a < n_nodes; ++a)
            {
              N(alpha * n_tying + t, a)  = fe.shape_value(a, tying[t]);
              dN(alpha * n_tying + t, a) = fe.shape_grad(a, tying[t])[alpha];
            }

        interpolation.push_back(interpolation_from_products<dim>(along, across, alpha, points));

        Eigen::MatrixXd at_points(n_points, n_nodes), at_nodes(n_nodes, n_nodes);
        for (unsigned int a = 0; a < n_nodes; ++a)
          {
            for (unsigned int g = 0; g < n_points; ++g)
              at_points(g, a) = fe.shape_grad(a, points[g])[alpha];
            for (unsigned int b = 0; b < n_nodes; ++b)
              at_nodes(b, a) = fe.shape_grad(a, nodes[b])[alpha];
          }
        gradient_at_points.push_back(at_points);
        gradient_at_nodes.push_back(at_nodes);
      }
  }



  template struct ElementTable<1>;
  template struct ElementTable<2>;
} // namespace samara
