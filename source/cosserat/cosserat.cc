#include <samara/base/threads.h>
#include <samara/cosserat/cosserat.h>

#include <algorithm>

namespace samara
{
  template <int dim>
  void
  Cosserat<dim>::add_element(const Model                     &model,
                             const std::vector<Frame>        &frames,
                             const std::vector<unsigned int> &material_of_point)
  {
    const ElementTable<dim> &t = *table;
    elements.push_back({frames, true, {}, table, static_cast<unsigned int>(points.size())});

    std::vector<kernel::NodeValues<double>> nodes(t.n_nodes);
    for (unsigned int a = 0; a < t.n_nodes; ++a)
      nodes[a] = {model.position(frames[a]), model.triad(frames[a])};

    for (unsigned int g = 0; g < t.n_points; ++g)
      {
        // derivatives of position by the unit coordinates
        Eigen::Matrix<double, 3, dim> dx = Eigen::Matrix<double, 3, dim>::Zero();
        for (unsigned int a = 0; a < t.n_nodes; ++a)
          for (unsigned int alpha = 0; alpha < dim; ++alpha)
            dx.col(alpha) += t.gradient_at_points[alpha](g, a) * nodes[a].x;
        IntegrationPoint point;
        point.material = material_of_point[g];
        if constexpr (dim == 1)
          {
            point.T(0, 0) = 1. / dx.norm();
            point.weight  = t.weights(g) * dx.norm();
          }
        else
          {
            // directions of the derivatives: director 1 there, made tangent to the surface, so that they are those of
            // the components
            Vector3 d_1 = Vector3::Zero();
            for (unsigned int a = 0; a < t.n_nodes; ++a)
              d_1 += t.value_at_points(g, a) * nodes[a].D.col(0);
            const Vector3               normal = dx.col(0).cross(dx.col(1)).normalized();
            Eigen::Matrix<double, 3, 2> axes;
            axes.col(0)  = (d_1 - normal * normal.dot(d_1)).normalized();
            axes.col(1)  = normal.cross(axes.col(0));
            point.T      = (axes.transpose() * dx).inverse().transpose();
            point.weight = t.weights(g) * dx.col(0).cross(dx.col(1)).norm();
          }
        point.reference.setZero();
        points.push_back(point);
      }
  }



  template <int dim>
  void
  Cosserat<dim>::connect(Layout &layout)
  {
    for (auto &element : elements)
      {
        for (auto &frame : element.frames)
          {
            frame             = layout.model.resolved(frame);
            element.all_nodes = element.all_nodes && frame.is_node();
          }
        if (!is_rigid)
          layout.couple(element.block, element.frames);
      }
    lanes = ElementLanes<dim>({{this, 0}});
    take_reference(layout.model);
    has_viscous_material = std::any_of(materials.begin(), materials.end(), [](const Material &material) {
      return !material.viscosity.isZero(0.);
    });
    if (n_elements() > 0)
      layout.add(*this, *this);
  }



  template <int dim>
  void
  Cosserat<dim>::take_reference(const Model &model)
  {
    // by the very instructions that will compute strains: of a stiff element the round-off of others would be a stress
    // Only its own nodes are written, and read: models of many bodies would go through all nodes for each.
    const std::unique_ptr<double[]> q(new double[12 * model.nodes.size()]);
    for (const auto &element : elements)
      for (const auto &frame : element.frames)
        {
          const auto &node = model.nodes[frame.node];
          std::copy_n(node.x.data(), 3, &q[12 * frame.node]);
          std::copy_n(node.D.data(), 9, &q[12 * frame.node + 3]);
        }
    std::vector<double>   e(n * points.size());
    samara::Point<double> reference;
    reference.q = q.get();
    this->strains(reference, e.data());
    for (unsigned int g = 0; g < points.size(); ++g)
      points[g].reference += Eigen::Map<const VectorN>(&e[n * g]); // zero before
  }



  template <int dim>
  void
  Cosserat<dim>::make_rigid()
  {
    is_rigid = true;
    points.clear();
  }



  template <int dim>
  typename Cosserat<dim>::Scratch &
  Cosserat<dim>::scratch()
  {
    static thread_local Scratch s;
    return s;
  }



  template <int dim>
  template <typename Number>
  void
  Cosserat<dim>::gather(const unsigned int element, const Number *q, kernel::NodeValues<Number> *nodes) const
  {
    const Element &el = elements[element];
    if (el.all_nodes)
      for (unsigned int a = 0; a < el.frames.size(); ++a)
        std::copy_n(q + 12 * el.frames[a].node, 12, nodes[a].x.data());
    else
      for (unsigned int a = 0; a < el.frames.size(); ++a)
        nodes[a] = {el.frames[a].position(q), el.frames[a].triad(q)};
  }



  template <int dim>
  void
  Cosserat<dim>::element_strains(const unsigned int element, const double *q, double *e) const
  {
    kernel::NodeValues<double> nodes[most_nodes];
    gather(element, q, nodes);
    element_strains(element, nodes, e);
  }



  template <int dim>
  void
  Cosserat<dim>::element_strains(const unsigned int element, const kernel::NodeValues<double> *nodes, double *e) const
  {
    const ElementTable<dim> &t = *elements[element].table;
    Vec6<double>             tied[most_tied];
    for (unsigned int k = 0; k < dim * t.n_tying; ++k)
      tied[k] = kernel::strain(kernel::interpolate(nodes, t.n_nodes, &t.N(k, 0), &t.dN(k, 0)));
    to_points(element, tied, e);
    for (unsigned int g = 0; g < t.n_points; ++g)
      Eigen::Map<VectorN>(e + n * g) -= points[elements[element].first_point + g].reference;
  }



  template <int dim>
  template <typename Number>
  void
  Cosserat<dim>::subtract_reference(Number *e) const
  {
    for (unsigned int g = 0; g < points.size(); ++g)
      Eigen::Map<Eigen::Matrix<Number, n, 1>>(e + n * g) -= points[g].reference;
  }



  template <int dim>
  template <typename Number>
  void
  Cosserat<dim>::strains_at(const Point<Number> &point, Number *e) const
  {
    lanes.strains(point, e);
  }



  template <int dim>
  void
  Cosserat<dim>::strain_rates(const Point<double> &point, double *rates) const
  {
    lanes.strain_rates(point, rates);
  }



  template <int dim>
  void
  Cosserat<dim>::strain_rates_and_residual(const Point<double> &point, double *rates, double *r) const
  {
    if (joins())
      lanes.add_forces_and_rates(point, point.stress + this->first_strain, r, rates);
    else
      Deformation::strain_rates_and_residual(point, rates, r);
  }



  template <int dim>
  template <typename Number>
  void
  Cosserat<dim>::residual_at(const Point<Number> &point, Number *r) const
  {
    lanes.add_forces(point, point.stress + this->first_strain, r);
  }



  template <int dim>
  std::unique_ptr<LinearStrains>
  Cosserat<dim>::linear_strains() const
  {
    return lanes.linear_strains();
  }



  template <int dim>
  template <typename Number>
  void
  Cosserat<dim>::to_points(const unsigned int element, const Vec6<Number> *tied, Number *e) const
  {
    // strains by unit coordinates, interpolated from where they are sampled, then turned to axes of length by T
    const ElementTable<dim> &t = *elements[element].table;
    for (unsigned int g = 0; g < t.n_points; ++g)
      {
        const IntegrationPoint                   &point = points[elements[element].first_point + g];
        Eigen::Map<Eigen::Matrix<Number, 6, dim>> e_g(e + n * g);
        Eigen::Matrix<Number, 6, dim>             covariant;
        for (unsigned int alpha = 0; alpha < dim; ++alpha)
          if constexpr (dim == 1)
            covariant.col(0) = tied[g];
          else
            {
              covariant.col(alpha).setZero();
              for (unsigned int k = 0; k < t.n_tying; ++k)
                covariant.col(alpha) += t.interpolation[alpha](g, k) * tied[alpha * t.n_tying + k];
            }
        e_g = covariant * point.T.transpose();
      }
  }



  template <int dim>
  template <typename Number>
  void
  Cosserat<dim>::to_tying(const unsigned int element, const Number *stress, Vec6<Number> *tied) const
  {
    // the transpose of to_points(), so that forces there do the work of the stresses; weights are in it
    const ElementTable<dim> &t = *elements[element].table;
    if constexpr (dim > 1)
      std::fill_n(tied, dim * t.n_tying, Vec6<Number>::Zero());
    for (unsigned int g = 0; g < t.n_points; ++g)
      {
        const IntegrationPoint             &point = points[elements[element].first_point + g];
        const Eigen::Matrix<Number, 6, dim> s =
          Eigen::Map<const Eigen::Matrix<Number, 6, dim>>(stress + n * g) * (point.weight * point.T);
        if constexpr (dim == 1)
          tied[g] = s;
        else
          for (unsigned int alpha = 0; alpha < dim; ++alpha)
            for (unsigned int k = 0; k < t.n_tying; ++k)
              tied[alpha * t.n_tying + k] += t.interpolation[alpha](g, k) * s.col(alpha);
      }
  }


  template <int dim>
  template <typename Number>
  void
  Cosserat<dim>::stresses_of(const Number *e, const Number *rates, Number *stress) const
  {
    using Vector = Eigen::Matrix<Number, n, 1>;
    parallel_for(points.size(), 16 * worth_threads, [&](const unsigned int begin, const unsigned int end) {
      for (unsigned int g = begin; g < end; ++g)
        {
          const Material    &material = materials[points[g].material];
          Eigen::Map<Vector> s(stress + n * g);
          s.noalias() = material.stiffness.template cast<Number>() * Eigen::Map<const Vector>(e + n * g);
          if (has_viscous_material)
            s.noalias() += material.viscosity.template cast<Number>() * Eigen::Map<const Vector>(rates + n * g);
        }
    });
  }



  template <int dim>
  bool
  Cosserat<dim>::is_viscous() const
  {
    return has_viscous_material;
  }



  template <int dim>
  double
  Cosserat<dim>::power(const double *stress, const double *rates) const
  {
    double sum = 0;
    for (unsigned int g = 0; g < points.size(); ++g)
      sum += points[g].weight * Eigen::Map<const VectorN>(stress + n * g).dot(Eigen::Map<const VectorN>(rates + n * g));
    return sum;
  }



  template <int dim>
  double
  Cosserat<dim>::strain_energy(const double *e) const
  {
    double energy = 0;
    for (unsigned int g = 0; g < points.size(); ++g)
      {
        const Eigen::Map<const VectorN> e_g(e + n * g);
        energy += 0.5 * points[g].weight * e_g.dot(materials[points[g].material].stiffness * e_g);
      }
    return energy;
  }



  template void Cosserat<1>::gather(unsigned int, const double *, kernel::NodeValues<double> *) const;
  template void Cosserat<2>::gather(unsigned int, const double *, kernel::NodeValues<double> *) const;
  template void Cosserat<1>::subtract_reference(double *) const;
  template void Cosserat<1>::subtract_reference(std::complex<double> *) const;
  template void Cosserat<2>::subtract_reference(double *) const;
  template void Cosserat<2>::subtract_reference(std::complex<double> *) const;
  template void Cosserat<1>::strains_at(const Point<double> &, double *) const;
  template void Cosserat<1>::to_points(unsigned int, const Vec6<double> *, double *) const;
  template void Cosserat<1>::to_tying(unsigned int, const double *, Vec6<double> *) const;
  template void Cosserat<1>::to_points(unsigned int, const Vec6<std::complex<double>> *, std::complex<double> *) const;
  template void Cosserat<1>::to_tying(unsigned int, const std::complex<double> *, Vec6<std::complex<double>> *) const;
  template void Cosserat<2>::to_points(unsigned int, const Vec6<double> *, double *) const;
  template void Cosserat<2>::to_tying(unsigned int, const double *, Vec6<double> *) const;
  template void Cosserat<2>::to_points(unsigned int, const Vec6<std::complex<double>> *, std::complex<double> *) const;
  template void Cosserat<2>::to_tying(unsigned int, const std::complex<double> *, Vec6<std::complex<double>> *) const;

  template class Cosserat<1>;
  template class Cosserat<2>;
  template class Evaluated<Cosserat<1>, Deformation>;
  template class EvaluatedDeformation<Cosserat<1>>;
  template class Evaluated<Cosserat<2>, Deformation>;
  template class EvaluatedDeformation<Cosserat<2>>;
} // namespace samara
