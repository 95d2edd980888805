// What the stress across the layers of a shell follows from: the balance along the normal inside of each cell.

#include <samara/base/composite_rule.h>
#include <samara/base/dense.h>
#include <samara/cosserat/shell.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  void
  Shell::find_loads_on_surface()
  {
    for (const auto &item : model->items)
      {
        const auto *const load = dynamic_cast<const SurfaceLoad *>(item.get());
        if (load == nullptr || load->loaded_body() != this)
          continue;
        LoadOnSurface found{load, std::vector<bool>(n_elements(), load->loaded_region().empty())};
        if (!load->loaded_region().empty())
          for (const unsigned int cell : cells_of(load->loaded_region()))
            found.acts_on[cell] = true;
        loads_on_surface.push_back(found);
      }
  }



  void
  Shell::make_rule_across()
  {
    const auto          is_inside = [](const double x) { return 1e-9 < x && x < 1 - 1e-9; };
    std::vector<double> along; // unit coordinates of the nodes inside of a side
    for (const auto &node : table->nodes)
      if (is_inside(node[0]) && node[1] < 1e-9)
        along.push_back(node[0]);
    std::sort(along.begin(), along.end());
    const auto index = [&](const double x) {
      unsigned int i = 0;
      while (std::abs(along[i] - x) > 1e-9)
        ++i;
      return i;
    };
    for (unsigned int a = 0; a < table->n_nodes; ++a)
      if (const auto &node = table->nodes[a]; is_inside(node[0]) && is_inside(node[1]))
        {
          inner_nodes.push_back(a);
          inner_to_points.conservativeResize(table->n_points, inner_nodes.size());
          for (unsigned int g = 0; g < table->n_points; ++g)
            inner_to_points(g, inner_nodes.size() - 1) = lagrange(along, index(node[0]), table->points[g][0]) *
                                                         lagrange(along, index(node[1]), table->points[g][1]);
        }

    if (inner_nodes.empty())
      return; // of degree 1: see knows_across()
    // as polynomials of these nodes, in the least squares: shear along a direction is known to one degree less than
    // places, and its derivative to two
    const Eigen::MatrixXd weighed = inner_to_points.transpose() * table->weights.asDiagonal();
    for (unsigned int i = 0; i < 2; ++i)
      slopes_at_points[i] =
        inner_to_points * Cholesky(weighed * inner_to_points).solve(weighed * table->gradient_at_points[i] * to_nodes);
  }



  bool
  Shell::knows_across() const
  {
    return degree > 1 && joins();
  }



  Eigen::MatrixXd
  Shell::recovered_at_points(const unsigned int element, const State &state) const
  {
    const unsigned int n_points = table->n_points;
    Eigen::MatrixXd    result   = Eigen::MatrixXd::Zero(n_recovered, n_points);
    result.topRows<n>() =
      Eigen::Map<const Eigen::MatrixXd>(&state.stress[first_strain + n * elements[element].first_point], n, n_points);
    if (knows_across())
      {
        add_shear_gradients(element, result);
        add_curvatures(element, state, result);
        add_pressures(element, state, result);
      }
    return result;
  }



  Eigen::MatrixXd
  Shell::recovered_at_nodes(const unsigned int element, const State &state) const
  {
    return recovered_at_points(element, state) * to_nodes.transpose();
  }



  Shell::Recovered
  Shell::mean_recovered(const unsigned int node, const State &state) const
  {
    Recovered    sum   = Recovered::Zero();
    unsigned int count = 0;
    for (unsigned int i = 0; i < n_elements(); ++i)
      for (unsigned int a = 0; a < table->n_nodes; ++a)
        if (is_of_node(i, a, node))
          {
            sum += recovered_at_points(i, state) * to_nodes.row(a).transpose();
            ++count;
          }
    return count == 0 ? sum : Recovered(sum / count);
  }



  void
  Shell::add_shear_gradients(const unsigned int element, Eigen::MatrixXd &recovered) const
  {
    // the divergence of a tangent vector, (J v^i),ᵢ / J, is exact whatever axes it is written in: v^i = T_αi v_α
    const IntegrationPoint *const at = &integration_points()[elements[element].first_point];
    Eigen::MatrixXd               flux[2]; // of each part (α, γ) along the two unit coordinates
    for (unsigned int i = 0; i < 2; ++i)
      {
        flux[i].resize(table->n_points, 4);
        for (unsigned int g = 0; g < table->n_points; ++g)
          for (unsigned int alpha = 0; alpha < 2; ++alpha)
            for (unsigned int gamma = 0; gamma < 2; ++gamma)
              flux[i](g, alpha + 2 * gamma) =
                at[g].weight / table->weights(g) * at[g].T(alpha, i) * recovered(6 * gamma + 2, g);
      }
    const Eigen::MatrixXd divergence = slopes_at_points[0] * flux[0] + slopes_at_points[1] * flux[1];
    for (unsigned int g = 0; g < table->n_points; ++g)
      recovered.col(g).segment<4>(row_of_gradient) = table->weights(g) / at[g].weight * divergence.row(g).transpose();
  }



  void
  Shell::add_curvatures(const unsigned int element, const State &state, Eigen::MatrixXd &recovered) const
  {
    VectorN e[most_nodes];
    element_strains(element, state.q.data(), e[0].data());
    for (unsigned int g = 0; g < table->n_points; ++g)
      {
        // d₃,α = d (K_α × e₃)
        const VectorN whole = e[g] + integration_points()[elements[element].first_point + g].reference;
        recovered.col(g).segment<3>(row_of_curvature) << whole(4), whole(10) - whole(3), -whole(9);
      }
  }



  void
  Shell::add_pressures(const unsigned int element, const State &state, Eigen::MatrixXd &recovered) const
  {
    const ElementTable<2>        &t  = *table;
    const IntegrationPoint *const at = &integration_points()[elements[element].first_point];
    kernel::NodeValues<double>    nodes[most_nodes];
    std::vector<SurfaceTraction>  tractions;
    gather(element, state.q.data(), nodes);
    for (const auto &on_surface : loads_on_surface)
      if (on_surface.acts_on[element])
        tractions.push_back(on_surface.load->traction(state.point()));

    Eigen::Matrix3Xd loads = Eigen::Matrix3Xd::Zero(3, t.n_points);
    for (unsigned int g = 0; g < t.n_points && !tractions.empty(); ++g)
      {
        Matrix3 axes = Matrix3::Zero();
        Vector3 x[2] = {Vector3::Zero(), Vector3::Zero()};
        for (unsigned int a = 0; a < t.n_nodes; ++a)
          {
            axes += t.value_at_points(g, a) * nodes[a].D;
            for (unsigned int i = 0; i < 2; ++i)
              x[i] += t.gradient_at_points[i](g, a) * nodes[a].x;
          }
        const Vector3 area = t.weights(g) / at[g].weight * cross(x[0], x[1]);
        for (const auto &traction : tractions)
          {
            const Vector3 load   = traction.at(axes, area);
            const double  normal = load.dot(area) / area.norm();
            loads.col(g) += at[g].weight * load;
            recovered(normal > 0 ? row_of_bottom : row_of_top, g) += std::abs(normal);
          }
      }
    const Eigen::VectorXd inner   = inertia_at_inner_nodes(element, nodes, loads, recovered);
    recovered.row(row_of_inertia) = (inner_to_points * inner).transpose();
  }



  Eigen::VectorXd
  Shell::inertia_at_inner_nodes(const unsigned int                element,
                                const kernel::NodeValues<double> *nodes,
                                const Eigen::Matrix3Xd           &loads,
                                const Eigen::MatrixXd            &recovered) const
  {
    const ElementTable<2>        &t  = *table;
    const IntegrationPoint *const at = &integration_points()[elements[element].first_point];
    Eigen::Matrix3Xd              forces(3, inner_nodes.size()); // of the loads less those of the stresses
    for (unsigned int k = 0; k < inner_nodes.size(); ++k)
      forces.col(k) = loads * t.value_at_points.col(inner_nodes[k]);
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int s = 0; s < t.n_tying; ++s)
        {
          const unsigned int row   = i * t.n_tying + s;
          Vector3            force = Vector3::Zero();
          Matrix3            axes  = Matrix3::Zero();
          for (unsigned int g = 0; g < t.n_points; ++g)
            force += at[g].weight * t.interpolation[i](g, s) *
                     (at[g].T(0, i) * recovered.col(g).segment<3>(0) + at[g].T(1, i) * recovered.col(g).segment<3>(6));
          for (unsigned int a = 0; a < t.n_nodes; ++a)
            axes += t.N(row, a) * nodes[a].D;
          for (unsigned int k = 0; k < inner_nodes.size(); ++k)
            forces.col(k) -= t.dN(row, inner_nodes[k]) * axes * force;
        }
    Eigen::VectorXd result(inner_nodes.size());
    for (unsigned int k = 0; k < inner_nodes.size(); ++k)
      {
        const unsigned int a = inner_nodes[k];
        const auto         g = mesh->tangents(mesh->cells[element], a);
        result(k)            = nodes[a].D.col(2).dot(forces.col(k)) / (t.node_weights(a) * cross(g[0], g[1]).norm());
      }
    return result;
  }
} // namespace samara
