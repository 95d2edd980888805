// Strains, their rates and forces of elements, four of them at once.

#include <samara/base/threads.h>
#include <samara/cosserat/cosserat.h>

namespace samara
{
  namespace
  {
    /** Call @p f with the number of nodes of an element as a constant if it is a beam of degree 1 to 6, else with 0. */
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
          case 7:
            return f(std::integral_constant<int, 7>());
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
    const auto &all = Lanes<Number>::size > 1 ? batches : single_elements;
    parallel_for(all.size(), worth_threads, [&](const unsigned int begin, const unsigned int end) {
      for (unsigned int i = begin; i < end; ++i)
        with_size<dim>(elements[all[i].first].table->n_nodes, [&](const auto N) { f(all[i], N); });
    });
  }



  template <int dim>
  template <typename Number, typename Function>
  void
  Cosserat<dim>::add_batches(const Function &f, Number *r) const
  {
    constexpr unsigned int size = Lanes<Number>::size;
    const auto            &all  = size > 1 ? batches : single_elements;
    // what is computed side by side is added in order: the sum does not depend on the number of threads
    const unsigned int                                           at_once = all.size() < worth_threads ? 1 : all.size();
    static thread_local std::vector<Number>                      values;
    static thread_local Eigen::Matrix<Number, Eigen::Dynamic, 1> local;
    values.resize(at_once * size * 6 * most_nodes_of_element);
    Number *const first = values.data();
    for (unsigned int start = 0; start < all.size(); start += at_once)
      {
        const auto values_of = [&](const unsigned int i, const unsigned int lane) {
          return first + ((i - start) * size + lane) * 6 * most_nodes_of_element;
        };
        parallel_for(at_once, worth_threads, [&](const unsigned int begin, const unsigned int end) {
          for (unsigned int i = start + begin; i < start + end; ++i)
            {
              std::array<Number *, size> to;
              for (unsigned int l = 0; l < size; ++l)
                to[l] = values_of(i, l);
              with_size<dim>(elements[all[i].first].table->n_nodes, [&](const auto N) { f(i, N, to); });
            }
        });
        for (unsigned int i = start; i < start + at_once; ++i)
          for (unsigned int l = 0; l < all[i].size; ++l)
            {
              const Element &element = elements[all[i].first + l];
              local =
                Eigen::Map<const Eigen::Matrix<Number, Eigen::Dynamic, 1>>(values_of(i, l), 6 * element.table->n_nodes);
              element.block.add(local, r);
            }
      }
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
    const auto &all = Lanes<Number>::size > 1 ? batches : single_elements;
    add_batches([&](const unsigned int i, const auto N, const auto &to) { batch_residual<N>(all[i], point, to); }, r);
  }


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
      parallel_for(first.size(), worth_threads, [&](const unsigned int begin, const unsigned int end) {
        RowMajor &of_element = body.scratch().B;
        for (unsigned int i = begin; i < end; ++i)
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
      });
    }

    void
    strains(const double *y, const double *, double *e) const override
    {
      parallel_for(first.size(), worth_threads, [&](const unsigned int begin, const unsigned int end) {
        for (unsigned int i = begin; i < end; ++i)
          batch_strains(i, y, e);
      });
    }

    void
    add_forces(const double *stress, double *r) const override
    {
      body.add_batches([&](const unsigned int i, auto, const auto &to) { batch_forces(i, stress, to); }, r);
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

    const Cosserat           &body;
    std::vector<NodeMatrix>   B;     ///< by batches, points, nodes
    std::vector<unsigned int> first; ///< of each batch

    const ElementTable<dim> &
    table_of(const Batch &batch) const
    {
      return *body.elements[batch.first].table;
    }

    void
    batch_strains(const unsigned int i, const double *y, double *e) const
    {
      const Batch             &batch = body.batches[i];
      const ElementTable<dim> &t     = table_of(batch);
      Vec6<Lane>               twists[most_nodes];
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

    void
    batch_forces(const unsigned int i, const double *stress, const std::array<double *, 4> &to) const
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
      Lanes<double>::store(6 * t.n_nodes, forces[0].data(), to);
    }
  };



  template <int dim>
  std::unique_ptr<LinearStrains>
  Cosserat<dim>::linear_strains() const
  {
    return std::make_unique<StoredStrains>(*this);
  }



  template void Cosserat<1>::strains_at(const Point<double> &, double *) const;
  template void Cosserat<1>::residual_at(const Point<double> &, double *) const;
  template void Cosserat<1>::strains_at(const Point<std::complex<double>> &, std::complex<double> *) const;
  template void Cosserat<1>::residual_at(const Point<std::complex<double>> &, std::complex<double> *) const;
  template void Cosserat<1>::gather_twists(const Batch &, const double *, Vec6<FourDoubles> *) const;
  template void Cosserat<1>::strain_rates(const Point<double> &, double *) const;
  template std::unique_ptr<LinearStrains> Cosserat<1>::linear_strains() const;
  template void                           Cosserat<2>::strains_at(const Point<double> &, double *) const;
  template void                           Cosserat<2>::residual_at(const Point<double> &, double *) const;
  template void Cosserat<2>::strains_at(const Point<std::complex<double>> &, std::complex<double> *) const;
  template void Cosserat<2>::residual_at(const Point<std::complex<double>> &, std::complex<double> *) const;
  template void Cosserat<2>::gather_twists(const Batch &, const double *, Vec6<FourDoubles> *) const;
  template void Cosserat<2>::strain_rates(const Point<double> &, double *) const;
  template std::unique_ptr<LinearStrains> Cosserat<2>::linear_strains() const;
} // namespace samara
