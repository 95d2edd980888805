#ifndef samara_cosserat_prototype_functions_h
#define samara_cosserat_prototype_functions_h

// The functions of Prototype (prototype.h).

namespace samara
{
  namespace prototype
  {
    /** A derivative, without its own derivatives if it has any. */
    inline double
    value_of(const double derivative)
    {
      return derivative;
    }
    template <typename Number, int n>
    double
    value_of(const Differential<Number, n> &derivative)
    {
      return value_of(derivative.val());
    }
  } // namespace prototype



  template <typename Derived, typename Base, int degree_of_elements>
  void
  Prototype<Derived, Base, degree_of_elements>::initialize(Model &model)
  {
    Base::initialize(model);
    for (const auto &e : this->elements)
      if (e.table->n_nodes != n_nodes)
        return model.complaints.add(this->parameters.where("Degree"),
                                    this->kind + " <" + this->name + "> has elements of degree " +
                                      std::to_string(degree_of_elements) + ", and no others");
    if constexpr (dim == 1)
      if (this->has_trapeze())
        model.complaints.add(this->parameters.where("Section"),
                             this->kind + " <" + this->name +
                               "> has strains of its own, and the trapeze effect of its section belongs to those of a "
                               "<beam>: take a beam, or a section without <Trapeze effect> and <Trapeze coupling>");
  }



  template <typename Derived, typename Base, int degree_of_elements>
  PrototypeElement<Prototype<Derived, Base, degree_of_elements>::dim>
  Prototype<Derived, Base, degree_of_elements>::element(const unsigned int i) const
  {
    const auto           &el = this->elements[i];
    PrototypeElement<dim> result{*el.table, {}};
    for (unsigned int g = 0; g < el.table->n_points; ++g)
      result.T.push_back(this->integration_points()[el.first_point + g].T);
    return result;
  }



  template <typename Derived, typename Base, int degree_of_elements>
  template <typename Number>
  typename Prototype<Derived, Base, degree_of_elements>::template Nodes<Number>
  Prototype<Derived, Base, degree_of_elements>::nodes_of(const unsigned int i, const Number *q) const
  {
    Nodes<Number> nodes;
    for (unsigned int a = 0; a < n_nodes; ++a)
      nodes[a] = {this->elements[i].frames[a].position(q), this->elements[i].frames[a].triad(q)};
    return nodes;
  }



  template <typename Derived, typename Base, int degree_of_elements>
  template <typename Number>
  std::vector<Number>
  Prototype<Derived, Base, degree_of_elements>::strains_at_nodes(const unsigned int i, const Nodes<Number> &nodes) const
  {
    std::vector<Number> e(n * this->elements[i].table->n_points, Number(0.));
    self().strains_of(element(i), nodes.data(), e.data());
    return e;
  }



  template <typename Derived, typename Base, int degree_of_elements>
  template <typename Number>
  typename Prototype<Derived, Base, degree_of_elements>::template Nodes<
    Differential<Number, Prototype<Derived, Base, degree_of_elements>::N>>
  Prototype<Derived, Base, degree_of_elements>::varied(const Nodes<Number> &nodes, const Nodes<Number> &axes)
  {
    using Varied = Differential<Number, N>;
    Nodes<Varied> result;
    for (unsigned int a = 0; a < n_nodes; ++a)
      {
        // each entry depends on three of the twists: its derivatives are written at once
        const Mat3<Number> &D = nodes[a].D, &E = axes[a].D;
        for (int i = 0; i < 3; ++i)
          {
            Varied x(N, nodes[a].x(i));
            for (int k = 0; k < 3; ++k)
              x.fastAccessDx(6 * a + k) = E(i, k);
            result[a].x(i) = x;
            // column j of E θ~ is e_k θ_l − e_l θ_k for (j, k, l) cyclic
            for (int j = 0; j < 3; ++j)
              {
                const int k = (j + 1) % 3, l = (j + 2) % 3;
                Varied    d(N, D(i, j));
                d.fastAccessDx(6 * a + 3 + l) = E(i, k);
                d.fastAccessDx(6 * a + 3 + k) = -E(i, l);
                result[a].D(i, j)             = d;
              }
          }
      }
    return result;
  }



  template <typename Derived, typename Base, int degree_of_elements>
  void
  Prototype<Derived, Base, degree_of_elements>::element_strains(const unsigned int                i,
                                                                const kernel::NodeValues<double> *nodes,
                                                                double                           *e) const
  {
    Nodes<double> own;
    std::copy_n(nodes, n_nodes, own.begin());
    const auto strains = strains_at_nodes<double>(i, own);
    for (unsigned int k = 0; k < strains.size(); ++k)
      e[k] = strains[k] - this->integration_points()[this->elements[i].first_point + k / n].reference(k % n);
  }



  template <typename Derived, typename Base, int degree_of_elements>
  template <typename Number>
  void
  Prototype<Derived, Base, degree_of_elements>::all_strains(const Point<Number> &point, Number *e) const
  {
    for (unsigned int i = 0; i < this->n_elements(); ++i)
      {
        const unsigned int first   = this->elements[i].first_point;
        const auto         strains = strains_at_nodes<Number>(i, nodes_of(i, point.q));
        for (unsigned int k = 0; k < strains.size(); ++k)
          e[n * first + k] = strains[k] - this->integration_points()[first + k / n].reference(k % n);
      }
  }



  template <typename Derived, typename Base, int degree_of_elements>
  void
  Prototype<Derived, Base, degree_of_elements>::strain_rates(const Point<double> &point, double *rates) const
  {
    using Moving = Differential<double, 1>; // by time
    for (unsigned int i = 0; i < this->n_elements(); ++i)
      {
        const auto    nodes = nodes_of(i, point.q);
        Nodes<Moving> moving;
        for (unsigned int a = 0; a < n_nodes; ++a)
          {
            const auto v = kernel::node_rates(nodes[a].D, this->elements[i].frames[a].twist(point.y));
            for (int k = 0; k < 3; ++k)
              {
                moving[a].x(k)                 = Moving(1, nodes[a].x(k));
                moving[a].x(k).fastAccessDx(0) = v.x(k);
              }
            for (int k = 0; k < 9; ++k)
              {
                moving[a].D(k)                 = Moving(1, nodes[a].D(k));
                moving[a].D(k).fastAccessDx(0) = v.D(k);
              }
          }
        const auto e = strains_at_nodes<Moving>(i, moving);
        for (unsigned int k = 0; k < e.size(); ++k)
          rates[n * this->elements[i].first_point + k] = e[k].dx(0);
      }
  }



  template <typename Derived, typename Base, int degree_of_elements>
  template <typename Number>
  void
  Prototype<Derived, Base, degree_of_elements>::add_residual(const Point<Number> &point, Number *r) const
  {
    Eigen::Matrix<Number, Eigen::Dynamic, 1> local(N);
    for (unsigned int i = 0; i < this->n_elements(); ++i)
      {
        const unsigned int first = this->elements[i].first_point;
        const auto         e     = strains_at_nodes<Differential<Number, N>>(
          i, varied(nodes_of(i, point.q), nodes_of(i, point.q_of_forces())));
        local.setZero();
        for (unsigned int k = 0; k < e.size(); ++k)
          {
            const Number stress =
              this->integration_points()[first + k / n].weight * point.stress[this->first_strain + n * first + k];
            for (int j = 0; j < N; ++j)
              local(j) += e[k].dx(j) * stress;
          }
        this->elements[i].block.add(local, r);
      }
  }



  template <typename Derived, typename Base, int degree_of_elements>
  template <typename Number>
  Eigen::MatrixXd
  Prototype<Derived, Base, degree_of_elements>::material_part(const unsigned int i,
                                                              MatrixN Base::Material::*const which,
                                                              const std::vector<Number>     &e) const
  {
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(N, N), B(n, N);
    for (unsigned int g = 0; g < this->elements[i].table->n_points; ++g)
      {
        const auto &at = this->integration_points()[this->elements[i].first_point + g];
        for (unsigned int k = 0; k < n; ++k)
          for (int j = 0; j < N; ++j)
            B(k, j) = prototype::value_of(e[n * g + k].dx(j));
        K += at.weight * B.transpose() * (this->materials[at.material].*which) * B;
      }
    return K;
  }



  template <typename Derived, typename Base, int degree_of_elements>
  void
  Prototype<Derived, Base, degree_of_elements>::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    using First  = Differential<double, N>;
    using Second = Differential<First, N>;
    for (unsigned int i = 0; i < this->n_elements(); ++i)
      {
        // moved twice: forces act in the axes of the nodes, which have turned by the first increment already
        const auto      e     = strains_at_nodes<Second>(i, varied(varied(nodes_of(i, point.q))));
        Eigen::MatrixXd local = material_part(i, &Base::Material::stiffness, e);
        for (unsigned int k = 0; k < e.size(); ++k)
          {
            const unsigned int strain = n * this->elements[i].first_point + k;
            const double       stress =
              this->integration_points()[strain / n].weight * point.stress[this->first_strain + strain];
            for (int a = 0; a < N; ++a)
              for (int b = 0; b < N; ++b)
                local(a, b) += stress * e[k].dx(a).dx(b);
          }
        this->elements[i].block.add(local, K);
      }
  }



  template <typename Derived, typename Base, int degree_of_elements>
  void
  Prototype<Derived, Base, degree_of_elements>::damping(const Point<double> &point, SparseMatrix &C) const
  {
    if (!this->is_viscous())
      return;
    for (unsigned int i = 0; i < this->n_elements(); ++i)
      {
        const auto      e     = strains_at_nodes<Differential<double, N>>(i, varied(nodes_of(i, point.q)));
        Eigen::MatrixXd local = material_part(i, &Base::Material::viscosity, e);
        this->elements[i].block.add(local, C);
      }
  }
} // namespace samara

#endif
