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
        // derivatives of position by the unit coordinates in the axes of the first node's tangent plane
        Eigen::Matrix<double, 3, dim> dx = Eigen::Matrix<double, 3, dim>::Zero();
        Matrix3                       d  = Matrix3::Zero();
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
            // local axes: director 1 of the element's middle, made tangent to the surface
            for (const auto &node : nodes)
              d += node.D;
            const Vector3               normal = dx.col(0).cross(dx.col(1)).normalized();
            Eigen::Matrix<double, 3, 2> axes;
            axes.col(0)  = (d.col(0) - normal * normal.dot(d.col(0))).normalized();
            axes.col(1)  = normal.cross(axes.col(0));
            point.T      = (axes.transpose() * dx).inverse().transpose();
            point.weight = t.weights(g) * dx.col(0).cross(dx.col(1)).norm();
          }
        point.reference.setZero();
        points.push_back(point);
      }

    Vec6<double> tied[most_tied];
    for (unsigned int k = 0; k < dim * t.n_tying; ++k)
      tied[k] = kernel::strain(kernel::interpolate(nodes.data(), t.n_nodes, &t.N(k, 0), &t.dN(k, 0)));
    std::vector<double> e(n * t.n_points);
    to_points(elements.size() - 1, tied, e.data());
    for (unsigned int g = 0; g < t.n_points; ++g)
      points[elements.back().first_point + g].reference = Eigen::Map<VectorN>(&e[n * g]);
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
    make_batches();
    is_viscous = std::any_of(materials.begin(), materials.end(), [](const Material &material) {
      return !material.viscosity.isZero(0.);
    });
  }



  template <int dim>
  void
  Cosserat<dim>::make_batches()
  {
    batches.clear();
    single_elements.clear();
    constexpr unsigned int most = Lanes<double>::size;
    for (unsigned int i = 0, end = 0; i < n_elements(); i = end)
      {
        while (end < n_elements() && end < i + most && elements[end].table == elements[i].table)
          ++end;
        batches.push_back(make_batch(i, end - i, most));
      }
    for (unsigned int i = 0; i < n_elements(); ++i)
      single_elements.push_back(make_batch(i, 1, 1));
  }



  template <int dim>
  typename Cosserat<dim>::Batch
  Cosserat<dim>::make_batch(const unsigned int first, const unsigned int size, const unsigned int n_lanes) const
  {
    Batch batch{first, size, {}, {}};
    for (unsigned int a = 0; a < elements[first].frames.size(); ++a)
      for (unsigned int l = 0; l < n_lanes; ++l)
        {
          const Frame &frame = elements[first + std::min(l, size - 1)].frames[a];
          batch.nodes.push_back(frame.node);
          if (l < size && !frame.is_node())
            batch.arms.push_back({a, l});
        }
    return batch;
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
  template <typename Number>
  void
  Cosserat<dim>::to_points(const unsigned int element, const Vec6<Number> *tied, Number *e) const
  {
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



  namespace
  {
    /** Call @p f with the number of nodes of an element as a constant if it is a beam of degree 1 to 5, else with 0. */
    template <int dim, typename Function>
    void
    with_size(const unsigned int n_nodes, const Function &f)
    {
      switch (dim == 1 ? n_nodes : 0)
        {
          case 2:
            return f(std::integral_constant<int, 2>());
          case 3:
            return f(std::integral_constant<int, 3>());
          case 4:
            return f(std::integral_constant<int, 4>());
          case 5:
            return f(std::integral_constant<int, 5>());
          case 6:
            return f(std::integral_constant<int, 6>());
          default:
            return f(std::integral_constant<int, 0>());
        }
    }
  } // namespace



  template <int dim>
  template <typename Number, typename Function>
  void
  Cosserat<dim>::for_batches(const Function &f) const
  {
    for (const Batch &batch : Lanes<Number>::size > 1 ? batches : single_elements)
      with_size<dim>(elements[batch.first].table->n_nodes, [&](const auto N) { f(batch, N); });
  }



  template <int dim>
  template <typename Number>
  void
  Cosserat<dim>::gather_lanes(const Batch                                      &batch,
                              const Number                                     *q,
                              kernel::NodeValues<typename Lanes<Number>::type> *nodes) const
  {
    constexpr unsigned int     size = Lanes<Number>::size;
    kernel::NodeValues<Number> of_frames[size];
    auto                       arm = batch.arms.begin();
    for (unsigned int a = 0; size * a < batch.nodes.size(); ++a)
      {
        std::array<const Number *, size> from;
        for (unsigned int l = 0; l < size; ++l)
          from[l] = q + 12 * batch.nodes[size * a + l];
        for (; arm != batch.arms.end() && arm->a == a; ++arm)
          {
            const Frame &frame   = elements[batch.first + arm->lane].frames[a];
            of_frames[arm->lane] = {frame.position(q), frame.triad(q)};
            from[arm->lane]      = of_frames[arm->lane].x.data();
          }
        Lanes<Number>::load(12, from, nodes[a].x.data());
      }
  }



  template <int dim>
  void
  Cosserat<dim>::gather_twists(const Batch &batch, const double *y, Vec6<Lanes<double>::type> *twists) const
  {
    constexpr unsigned int size = Lanes<double>::size;
    Vector6                of_frames[size];
    auto                   arm = batch.arms.begin();
    for (unsigned int a = 0; size * a < batch.nodes.size(); ++a)
      {
        std::array<const double *, size> from;
        for (unsigned int l = 0; l < size; ++l)
          from[l] = y + 6 * batch.nodes[size * a + l];
        for (; arm != batch.arms.end() && arm->a == a; ++arm)
          {
            of_frames[arm->lane] = elements[batch.first + arm->lane].frames[a].twist(y);
            from[arm->lane]      = of_frames[arm->lane].data();
          }
        Lanes<double>::load(6, from, twists[a].data());
      }
  }



  template <int dim>
  template <typename Number>
  void
  Cosserat<dim>::batch_to_points(const Batch &batch, const Vec6<typename Lanes<Number>::type> *tied, Number *e) const
  {
    const unsigned int n_tied = dim * elements[batch.first].table->n_tying;
    std::array<std::array<Vec6<Number>, most_tied>, Lanes<Number>::size> of_lane;
    std::array<Number *, Lanes<Number>::size>                            to;
    for (unsigned int k = 0; k < n_tied; ++k)
      {
        for (unsigned int l = 0; l < to.size(); ++l)
          to[l] = of_lane[l][k].data();
        Lanes<Number>::store(6, tied[k].data(), to);
      }
    for (unsigned int l = 0; l < batch.size; ++l)
      to_points(batch.first + l, of_lane[l].data(), e + n * elements[batch.first + l].first_point);
  }



  template <int dim>
  template <int N, typename Number>
  void
  Cosserat<dim>::batch_strains(const Batch &batch, const Point<Number> &point, Number *e) const
  {
    using Lane                 = typename Lanes<Number>::type;
    const ElementTable<dim> &t = *elements[batch.first].table;
    kernel::NodeValues<Lane> nodes[N > 0 ? N : most_nodes];
    Vec6<Lane>               tied[most_tied];
    gather_lanes(batch, point.q, nodes);
    for (unsigned int k = 0; k < dim * t.n_tying; ++k)
      tied[k] = kernel::strain(kernel::interpolate<N>(nodes, t.n_nodes, &t.N(k, 0), &t.dN(k, 0)));
    batch_to_points(batch, tied, e);
  }



  template <int dim>
  template <typename Number>
  void
  Cosserat<dim>::strains_at(const Point<Number> &point, Number *e) const
  {
    for_batches<Number>([&](const Batch &batch, const auto N) { batch_strains<N>(batch, point, e); });
    for (unsigned int g = 0; g < points.size(); ++g)
      Eigen::Map<Eigen::Matrix<Number, n, 1>>(e + n * g) -= points[g].reference;
  }



  template <int dim>
  template <int N>
  void
  Cosserat<dim>::batch_strain_rates(const Batch &batch, const Point<double> &point, double *rates) const
  {
    using Lane                 = Lanes<double>::type;
    const ElementTable<dim> &t = *elements[batch.first].table;
    kernel::NodeValues<Lane> nodes[N > 0 ? N : most_nodes], velocities[N > 0 ? N : most_nodes];
    Vec6<Lane>               twists[N > 0 ? N : most_nodes], tied[most_tied];
    gather_lanes(batch, point.q, nodes);
    gather_twists(batch, point.y, twists);
    for (unsigned int a = 0; a < t.n_nodes; ++a)
      velocities[a] = kernel::node_rates(nodes[a].D, twists[a]);
    for (unsigned int k = 0; k < dim * t.n_tying; ++k)
      tied[k] = kernel::strain_rate(kernel::interpolate<N>(nodes, t.n_nodes, &t.N(k, 0), &t.dN(k, 0)),
                                    kernel::interpolate<N>(velocities, t.n_nodes, &t.N(k, 0), &t.dN(k, 0)));
    batch_to_points(batch, tied, rates);
  }



  template <int dim>
  void
  Cosserat<dim>::strain_rates(const Point<double> &point, double *rates) const
  {
    for_batches<double>([&](const Batch &batch, const auto N) { batch_strain_rates<N>(batch, point, rates); });
  }



  template <int dim>
  template <typename Number>
  void
  Cosserat<dim>::stresses_of(const Number *e, const Number *rates, Number *stress) const
  {
    using Vector = Eigen::Matrix<Number, n, 1>;
    for (unsigned int g = 0; g < points.size(); ++g)
      {
        const Material    &material = materials[points[g].material];
        Eigen::Map<Vector> s(stress + n * g);
        s.noalias() = material.stiffness.template cast<Number>() * Eigen::Map<const Vector>(e + n * g);
        if (is_viscous)
          s.noalias() += material.viscosity.template cast<Number>() * Eigen::Map<const Vector>(rates + n * g);
      }
  }



  template <int dim>
  bool
  Cosserat<dim>::has_damping() const
  {
    return is_viscous && !is_rigid;
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



  template <int dim>
  template <int N, typename Number>
  void
  Cosserat<dim>::batch_residual(const Batch                                     &batch,
                                const Point<Number>                             &point,
                                const std::array<Number *, Lanes<Number>::size> &local) const
  {
    using Lane                       = typename Lanes<Number>::type;
    constexpr unsigned int   size    = Lanes<Number>::size;
    const ElementTable<dim> &t       = *elements[batch.first].table;
    const unsigned int       n_nodes = N > 0 ? N : t.n_nodes;

    std::array<std::array<Vec6<Number>, most_tied>, size> tied;
    for (unsigned int l = 0; l < batch.size; ++l)
      to_tying(batch.first + l,
               point.stress + this->first_strain + n * elements[batch.first + l].first_point,
               tied[l].data());

    kernel::NodeValues<Lane> nodes[N > 0 ? N : most_nodes], forces[N > 0 ? N : most_nodes];
    gather_lanes(batch, point.q, nodes);
    for (unsigned int a = 0; a < n_nodes; ++a)
      forces[a] = {Vec3<Lane>::Zero(), Mat3<Lane>::Zero()};
    for (unsigned int k = 0; k < dim * t.n_tying; ++k)
      {
        std::array<const Number *, size> from;
        for (unsigned int l = 0; l < size; ++l)
          from[l] = tied[std::min(l, batch.size - 1)][k].data();
        Vec6<Lane> s;
        Lanes<Number>::load(6, from, s.data());
        const auto force = kernel::force(kernel::interpolate<N>(nodes, n_nodes, &t.N(k, 0), &t.dN(k, 0)), s);
        for (unsigned int a = 0; a < n_nodes; ++a)
          kernel::add_to_node(force, t.N(k, a), t.dN(k, a), forces[a]);
      }
    Lane result[6 * (N > 0 ? N : most_nodes)];
    for (unsigned int a = 0; a < n_nodes; ++a)
      Eigen::Map<Vec6<Lane>>{result + 6 *a} = kernel::node_forces(nodes[a].D, forces[a]);
    Lanes<Number>::store(6 * n_nodes, result, local);
  }



  template <int dim>
  template <typename Number>
  void
  Cosserat<dim>::residual_at(const Point<Number> &point, Number *r) const
  {
    static thread_local std::array<Eigen::Matrix<Number, Eigen::Dynamic, 1>, Lanes<Number>::size> local;
    for_batches<Number>([&](const Batch &batch, const auto N) {
      std::array<Number *, Lanes<Number>::size> to;
      for (unsigned int l = 0; l < to.size(); ++l)
        {
          local[l].resize(6 * elements[batch.first].table->n_nodes);
          to[l] = local[l].data();
        }
      batch_residual<N>(batch, point, to);
      for (unsigned int l = 0; l < batch.size; ++l)
        elements[batch.first + l].block.add(local[l], r);
    });
  }



  namespace
  {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    /** K += Bᵀ A with the number of columns known: a column of K stays in registers. */
    template <int n_columns>
    void
    add_transpose_product_of(const RowMajor &B, const RowMajor &A, Eigen::MatrixXd &K)
    {
      using Column = Eigen::Matrix<double, n_columns, 1>;
      for (int j = 0; j < n_columns; ++j)
        {
          Column sum = Eigen::Map<const Column>(K.col(j).data());
          for (int i = 0; i < B.rows(); ++i)
            sum += A(i, j) * Eigen::Map<const Column>(&B(i, 0));
          Eigen::Map<Column>(K.col(j).data()) = sum;
        }
    }

    /** K += Bᵀ A; beams of degree 1 to 5 have 12 to 36 columns, shells more. */
    void
    add_transpose_product(const RowMajor &B, const RowMajor &A, Eigen::MatrixXd &K)
    {
      switch (B.cols())
        {
          case 12:
            return add_transpose_product_of<12>(B, A, K);
          case 18:
            return add_transpose_product_of<18>(B, A, K);
          case 24:
            return add_transpose_product_of<24>(B, A, K);
          case 30:
            return add_transpose_product_of<30>(B, A, K);
          case 36:
            return add_transpose_product_of<36>(B, A, K);
          default:
            K.noalias() += B.transpose() * A;
        }
    }
  } // namespace



  template <int dim>
  void
  Cosserat<dim>::interpolate_element(const unsigned int element, const double *q) const
  {
    const ElementTable<dim> &t = *elements[element].table;
    Scratch                 &s = scratch();
    gather(element, q, s.nodes.data());
    for (unsigned int k = 0; k < dim * t.n_tying; ++k)
      s.at[k] = kernel::interpolate(s.nodes.data(), t.n_nodes, &t.N(k, 0), &t.dN(k, 0));
  }



  template <int dim>
  template <typename Matrix>
  void
  Cosserat<dim>::strain_matrix(const unsigned int element, Matrix &&B_element) const
  {
    const ElementTable<dim> &t = *elements[element].table;
    Scratch                 &s = scratch();
    s.B_tied.resize(6 * dim * t.n_tying, 6 * t.n_nodes);
    for (unsigned int k = 0; k < dim * t.n_tying; ++k)
      for (unsigned int a = 0; a < t.n_nodes; ++a)
        kernel::strain_matrix(
          s.at[k], s.nodes[a].D, t.N(k, a), t.dN(k, a), s.B_tied.template block<6, 6>(6 * k, 6 * a));
    for (unsigned int g = 0; g < t.n_points; ++g)
      {
        const IntegrationPoint &point = points[elements[element].first_point + g];
        auto                    B     = B_element.template middleRows<n>(n * g);
        if constexpr (dim == 1)
          B = point.T(0, 0) * s.B_tied.template middleRows<6>(6 * g);
        else
          {
            B.setZero();
            for (unsigned int alpha = 0; alpha < dim; ++alpha)
              for (unsigned int k = 0; k < t.n_tying; ++k)
                for (unsigned int beta = 0; beta < dim; ++beta)
                  B.template middleRows<6>(6 * beta) += point.T(beta, alpha) * t.interpolation[alpha](g, k) *
                                                        s.B_tied.template middleRows<6>(6 * (alpha * t.n_tying + k));
          }
      }
  }



  /** B of all elements, four of them side by side. */
  template <int dim>
  class Cosserat<dim>::StoredStrains : public LinearStrains
  {
  public:
    explicit StoredStrains(const Cosserat &body)
      : body(body)
    {
      for (const auto &batch : body.batches)
        {
          first.push_back(B.size());
          B.resize(B.size() + table_of(batch).n_points * table_of(batch).n_nodes);
        }
    }

    void
    renew(const Point<double> &point) override
    {
      RowMajor &of_element = body.scratch().B;
      for (unsigned int i = 0; i < first.size(); ++i)
        for (unsigned int l = 0; l < body.batches[i].size; ++l)
          {
            const ElementTable<dim> &t = table_of(body.batches[i]);
            of_element.resize(n * t.n_points, 6 * t.n_nodes);
            body.interpolate_element(body.batches[i].first + l, point.q);
            body.strain_matrix(body.batches[i].first + l, of_element);
            for (unsigned int g = 0; g < t.n_points; ++g)
              for (unsigned int a = 0; a < t.n_nodes; ++a)
                B[first[i] + g * t.n_nodes + a].set(l, of_element.template block<n, 6>(n * g, 6 * a));
          }
    }

    void
    strains(const double *y, const double *, double *e) const override
    {
      Vec6<Lane> twists[most_nodes];
      for (unsigned int i = 0; i < first.size(); ++i)
        {
          const Batch             &batch = body.batches[i];
          const ElementTable<dim> &t     = table_of(batch);
          body.gather_twists(batch, y, twists);
          for (unsigned int g = 0; g < t.n_points; ++g)
            {
              Eigen::Matrix<Lane, n, 1> sum = Eigen::Matrix<Lane, n, 1>::Zero();
              for (unsigned int a = 0; a < t.n_nodes; ++a)
                B[first[i] + g * t.n_nodes + a].add_strains(twists[a], sum);
              double                  not_wanted[n];
              std::array<double *, 4> to;
              for (unsigned int l = 0; l < to.size(); ++l)
                to[l] = l < batch.size ? e + n * (body.elements[batch.first + l].first_point + g) : not_wanted;
              Lanes<double>::store(n, sum.data(), to);
            }
        }
    }

    void
    add_forces(const double *stress, double *r) const override
    {
      for (unsigned int i = 0; i < first.size(); ++i)
        {
          const Batch             &batch = body.batches[i];
          const ElementTable<dim> &t     = table_of(batch);
          Vec6<Lane>               forces[most_nodes];
          for (unsigned int a = 0; a < t.n_nodes; ++a)
            forces[a].setZero();
          for (unsigned int g = 0; g < t.n_points; ++g)
            {
              VectorN                       weighted[4];
              std::array<const double *, 4> from;
              for (unsigned int l = 0; l < 4; ++l)
                {
                  const unsigned int point = body.elements[batch.first + std::min(l, batch.size - 1)].first_point + g;
                  weighted[l]              = body.points[point].weight * Eigen::Map<const VectorN>(stress + n * point);
                  from[l]                  = weighted[l].data();
                }
              Eigen::Matrix<Lane, n, 1> s;
              Lanes<double>::load(n, from, s.data());
              for (unsigned int a = 0; a < t.n_nodes; ++a)
                B[first[i] + g * t.n_nodes + a].add_forces(s, forces[a]);
            }
          std::array<double *, 4> to;
          for (unsigned int l = 0; l < 4; ++l)
            {
              local[l].resize(6 * t.n_nodes);
              to[l] = local[l].data();
            }
          Lanes<double>::store(6 * t.n_nodes, forces[0].data(), to);
          for (unsigned int l = 0; l < batch.size; ++l)
            body.elements[batch.first + l].block.add(local[l], r);
        }
    }

  private:
    using Lane = Lanes<double>::type;

    /** B of one node at one point: displacements do not change curvatures, which leaves three quarters. */
    struct NodeMatrix
    {
      Lane values[dim][3][9] = {};

      void
      set(const unsigned int lane, const Eigen::Matrix<double, n, 6> &B_node)
      {
        for (unsigned int alpha = 0; alpha < dim; ++alpha)
          for (unsigned int i = 0; i < 3; ++i)
            {
              for (unsigned int j = 0; j < 6; ++j)
                values[alpha][i][j].values[lane] = B_node(6 * alpha + i, j);
              for (unsigned int j = 0; j < 3; ++j)
                values[alpha][i][6 + j].values[lane] = B_node(6 * alpha + 3 + i, 3 + j);
            }
      }

      void
      add_strains(const Vec6<Lane> &z, Eigen::Matrix<Lane, n, 1> &e) const
      {
        for (unsigned int alpha = 0; alpha < dim; ++alpha)
          for (unsigned int i = 0; i < 3; ++i)
            {
              const Lane *const b = values[alpha][i];
              e(6 * alpha + i) += b[0] * z(0) + b[1] * z(1) + b[2] * z(2) + b[3] * z(3) + b[4] * z(4) + b[5] * z(5);
              e(6 * alpha + 3 + i) += b[6] * z(3) + b[7] * z(4) + b[8] * z(5);
            }
      }

      void
      add_forces(const Eigen::Matrix<Lane, n, 1> &s, Vec6<Lane> &f) const
      {
        for (unsigned int alpha = 0; alpha < dim; ++alpha)
          for (unsigned int j = 0; j < 3; ++j)
            {
              const auto &b = values[alpha];
              const Lane *N = &s(6 * alpha), *const M = N + 3;
              f(j) += b[0][j] * N[0] + b[1][j] * N[1] + b[2][j] * N[2];
              f(3 + j) += b[0][3 + j] * N[0] + b[1][3 + j] * N[1] + b[2][3 + j] * N[2] + b[0][6 + j] * M[0] +
                          b[1][6 + j] * M[1] + b[2][6 + j] * M[2];
            }
      }
    };

    const Cosserat                        &body;
    std::vector<NodeMatrix>                B;     ///< by batches, points, nodes
    std::vector<unsigned int>              first; ///< of each batch
    mutable std::array<Eigen::VectorXd, 4> local;

    const ElementTable<dim> &
    table_of(const Batch &batch) const
    {
      return *body.elements[batch.first].table;
    }
  };



  template <int dim>
  std::unique_ptr<LinearStrains>
  Cosserat<dim>::linear_strains() const
  {
    return std::make_unique<StoredStrains>(*this);
  }



  template <int dim>
  void
  Cosserat<dim>::add_material(const unsigned int element, MatrixN Material::*which, Eigen::MatrixXd &K) const
  {
    const ElementTable<dim> &t = *elements[element].table;
    Scratch                 &s = scratch();
    s.B.resize(n * t.n_points, 6 * t.n_nodes);
    s.CB.resize(n * t.n_points, 6 * t.n_nodes);
    strain_matrix(element, s.B);
    for (unsigned int g = 0; g < t.n_points; ++g)
      {
        const IntegrationPoint &point = points[elements[element].first_point + g];
        const MatrixN           C     = point.weight * (materials[point.material].*which);
        auto                    CB    = s.CB.template middleRows<n>(n * g);
        CB.noalias()                  = C.lazyProduct(s.B.template middleRows<n>(n * g));
      }
    add_transpose_product(s.B, s.CB, K);
  }



  template <int dim>
  void
  Cosserat<dim>::add_geometric(const unsigned int element, const Vec6<double> *tied, Eigen::MatrixXd &K) const
  {
    const ElementTable<dim> &t = *elements[element].table;
    Scratch                 &s = scratch();
    const unsigned int       N = t.n_nodes;
    s.n.assign(N * N, Vector3::Zero());
    s.m.assign(N * N, Vector3::Zero());
    s.forces.assign(N, {Vector3::Zero(), Matrix3::Zero(), Matrix3::Zero()});
    for (unsigned int k = 0; k < dim * t.n_tying; ++k)
      {
        const auto    force = kernel::force(s.at[k], tied[k]);
        const Vector3 n_k = tied[k].template head<3>(), m_k = tied[k].template tail<3>();
        for (unsigned int a = 0; a < N; ++a)
          {
            const double N_a = t.N(k, a), dN_a = t.dN(k, a);
            s.forces[a].dx += dN_a * force.dx;
            s.forces[a].d += N_a * force.d + dN_a * force.dd;
            for (unsigned int b = 0; b < N; ++b)
              {
                s.n[N * a + b] += dN_a * t.N(k, b) * n_k;
                s.m[N * a + b] += (N_a * t.dN(k, b) - dN_a * t.N(k, b)) * m_k;
              }
          }
      }
    for (unsigned int a = 0; a < N; ++a)
      {
        const Matrix3 &D = s.nodes[a].D;
        K.block<6, 6>(6 * a, 6 * a) +=
          kernel::geometric_node(D.transpose() * s.forces[a].dx, transpose_times(D, s.forces[a].d));
        for (unsigned int b = 0; b < N; ++b)
          kernel::add_geometric_pair(transpose_times(D, s.nodes[b].D),
                                     s.n[N * a + b],
                                     s.n[N * b + a],
                                     s.m[N * a + b],
                                     K.block<6, 6>(6 * a, 6 * b));
      }
  }



  template <int dim>
  void
  Cosserat<dim>::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    Scratch      &s      = scratch();
    const double *stress = point.stress + this->first_strain;
    for (unsigned int i = 0; i < n_elements(); ++i)
      {
        const ElementTable<dim> &t = *elements[i].table;
        interpolate_element(i, point.q);
        to_tying(i, stress + n * elements[i].first_point, s.tied.data());
        s.K.setZero(6 * t.n_nodes, 6 * t.n_nodes);
        add_material(i, &Material::stiffness, s.K);
        add_geometric(i, s.tied.data(), s.K);
        elements[i].block.add(s.K, K);
      }
  }



  template <int dim>
  void
  Cosserat<dim>::damping(const Point<double> &point, SparseMatrix &C) const
  {
    if (!has_damping())
      return;
    Scratch &s = scratch();
    for (unsigned int i = 0; i < n_elements(); ++i)
      {
        const ElementTable<dim> &t = *elements[i].table;
        interpolate_element(i, point.q);
        s.K.setZero(6 * t.n_nodes, 6 * t.n_nodes);
        add_material(i, &Material::viscosity, s.K);
        elements[i].block.add(s.K, C);
      }
  }



  template class Cosserat<1>;
  template class Cosserat<2>;
  template class Evaluated<Cosserat<1>, Body>;
  template class Evaluated<Cosserat<2>, Body>;
} // namespace samara
