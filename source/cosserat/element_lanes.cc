#include <samara/base/threads.h>
#include <samara/cosserat/cosserat.h>
#include <samara/cosserat/element_lanes.h>

#include <algorithm>
#include <functional>
#include <map>

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
  const auto &
  ElementLanes<dim>::element_of(const Lane &lane)
  {
    return lane.body->elements[lane.element];
  }



  template <int dim>
  const ElementTable<dim> &
  ElementLanes<dim>::table_of(const Batch &batch)
  {
    return *element_of(batch.lanes[0]).table;
  }



  template <int dim>
  ElementLanes<dim>::ElementLanes(const std::vector<Part> &parts)
    : parts(parts)
  {
    // elements of a degree fill lanes in the order of the bodies, whichever body they are of
    constexpr unsigned int                    most = Lanes<double>::size;
    std::map<unsigned int, std::vector<Lane>> waiting;
    for (const auto &part : parts)
      for (unsigned int i = 0; i < part.body->n_elements(); ++i)
        {
          const auto &element = part.body->elements[i];
          const Lane  lane{part.body, i, part.first_strain + n * element.first_point};
          single_elements.push_back(make_batch({lane}, 1));
          most_nodes_of_element = std::max(most_nodes_of_element, element.table->n_nodes);

          auto &lanes = waiting[element.table->degree];
          lanes.push_back(lane);
          if (lanes.size() == most)
            {
              batches.push_back(make_batch(lanes, most));
              lanes.clear();
            }
        }
    for (const auto &[degree, lanes] : waiting)
      if (!lanes.empty())
        batches.push_back(make_batch(lanes, most));
  }



  template <int dim>
  typename ElementLanes<dim>::Batch
  ElementLanes<dim>::make_batch(const std::vector<Lane> &lanes, const unsigned int n_lanes)
  {
    Batch batch{lanes, {}, {}, {}, {}};
    for (unsigned int a = 0; a < element_of(lanes[0]).frames.size(); ++a)
      for (unsigned int l = 0; l < n_lanes; ++l)
        {
          const Frame &frame = element_of(lanes[std::min<unsigned int>(l, lanes.size() - 1)]).frames[a];
          batch.nodes.push_back(frame.node);
          if (l < lanes.size() && !frame.is_node())
            batch.arms.push_back({a, l});
        }
    for (unsigned int g = 0; n_lanes > 1 && g < element_of(lanes[0]).table->n_points; ++g)
      {
        batch.weights.emplace_back(0.);
        batch.T.emplace_back(0.);
        for (unsigned int l = 0; l < n_lanes; ++l)
          {
            const Lane &lane           = lanes[std::min<unsigned int>(l, lanes.size() - 1)];
            const auto &point          = lane.body->points[element_of(lane).first_point + g];
            batch.weights[g].values[l] = point.weight;
            batch.T[g].values[l]       = point.T(0, 0);
          }
      }
    return batch;
  }



  template <int dim>
  template <typename Number, typename Function>
  void
  ElementLanes<dim>::for_batches(const Function &f) const
  {
    const auto &all  = batches_of<Number>();
    const auto  part = [&](const unsigned int begin, const unsigned int end) {
      for (unsigned int i = begin; i < end; ++i)
        with_size<dim>(table_of(all[i]).n_nodes, [&](const auto N) { f(all[i], N); });
    };
    parallel_for(all.size(), worth_threads, std::cref(part)); // a reference needs no memory of its own
  }



  template <int dim>
  template <typename Number, typename Function>
  void
  ElementLanes<dim>::add_batches(const Function &f, Number *r) const
  {
    constexpr unsigned int size = Lanes<Number>::size;
    const auto            &all  = batches_of<Number>();
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
        const auto part = [&](const unsigned int begin, const unsigned int end) {
          for (unsigned int i = start + begin; i < start + end; ++i)
            {
              std::array<Number *, size> to;
              for (unsigned int l = 0; l < size; ++l)
                to[l] = values_of(i, l);
              with_size<dim>(table_of(all[i]).n_nodes, [&](const auto N) { f(i, N, to); });
            }
        };
        parallel_for(at_once, worth_threads, std::cref(part));
        for (unsigned int i = start; i < start + at_once; ++i)
          {
            unsigned int with_arms = 0; // lanes, as bits
            for (const auto &arm : all[i].arms)
              with_arms |= 1u << arm.lane;
            for (unsigned int l = 0; l < all[i].lanes.size(); ++l)
              {
                const auto         &element = element_of(all[i].lanes[l]);
                const unsigned int  n_nodes = element.table->n_nodes;
                const Number *const from    = values_of(i, l);
                if (with_arms >> l & 1)
                  {
                    local = Eigen::Map<const Eigen::Matrix<Number, Eigen::Dynamic, 1>>(from, 6 * n_nodes);
                    element.block.add(local, r);
                  }
                else
                  for (unsigned int a = 0; a < n_nodes; ++a)
                    Eigen::Map<Vec6<Number>>(r + element.block.row(6 * a)) +=
                      Eigen::Map<const Vec6<Number>>(from + 6 * a);
              }
          }
      }
  }



  template <int dim>
  template <typename Number>
  void
  ElementLanes<dim>::gather_lanes(const Batch                                      &batch,
                                  const Number                                     *q,
                                  kernel::NodeValues<typename Lanes<Number>::type> *nodes)
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
            const Frame &frame   = element_of(batch.lanes[arm->lane]).frames[a];
            of_frames[arm->lane] = {frame.position(q), frame.triad(q)};
            from[arm->lane]      = of_frames[arm->lane].x.data();
          }
        Lanes<Number>::load(12, from, nodes[a].x.data());
      }
  }



  template <int dim>
  void
  ElementLanes<dim>::gather_twists(const Batch &batch, const double *y, Vec6<Lanes<double>::type> *twists)
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
            of_frames[arm->lane] = element_of(batch.lanes[arm->lane]).frames[a].twist(y);
            from[arm->lane]      = of_frames[arm->lane].data();
          }
        Lanes<double>::load(6, from, twists[a].data());
      }
  }



  template <int dim>
  template <typename Number>
  void
  ElementLanes<dim>::batch_to_points(const Batch &batch, const Vec6<typename Lanes<Number>::type> *tied, Number *e)
  {
    const unsigned int                        n_tied = dim * table_of(batch).n_tying;
    std::array<Number *, Lanes<Number>::size> to;
    if constexpr (dim == 1 && Lanes<Number>::size > 1)
      {
        // Cosserat::to_points() of all lanes: strains by the unit coordinate become those by length
        Number not_wanted[6];
        for (unsigned int g = 0; g < n_tied; ++g)
          {
            const Vec6<FourDoubles> e_g = batch.T[g] * tied[g];
            for (unsigned int l = 0; l < to.size(); ++l)
              to[l] = l < batch.lanes.size() ? e + batch.lanes[l].first_strain + 6 * g : not_wanted;
            Lanes<Number>::store(6, e_g.data(), to);
          }
        return;
      }
    std::array<std::array<Vec6<Number>, most_tied>, Lanes<Number>::size> of_lane;
    for (unsigned int k = 0; k < n_tied; ++k)
      {
        for (unsigned int l = 0; l < to.size(); ++l)
          to[l] = of_lane[l][k].data();
        Lanes<Number>::store(6, tied[k].data(), to);
      }
    for (unsigned int l = 0; l < batch.lanes.size(); ++l)
      {
        const Lane &lane = batch.lanes[l];
        lane.body->to_points(lane.element, of_lane[l].data(), e + lane.first_strain);
      }
  }



  template <int dim>
  template <typename Number>
  void
  ElementLanes<dim>::batch_to_tying(const Batch &batch, const Number *stress, Vec6<typename Lanes<Number>::type> *tied)
  {
    constexpr unsigned int           size   = Lanes<Number>::size;
    const unsigned int               n_tied = dim * table_of(batch).n_tying;
    std::array<const Number *, size> from;
    if constexpr (dim == 1 && size > 1)
      {
        for (unsigned int g = 0; g < n_tied; ++g)
          {
            for (unsigned int l = 0; l < size; ++l)
              from[l] = stress + batch.lanes[std::min<unsigned int>(l, batch.lanes.size() - 1)].first_strain + 6 * g;
            Lanes<Number>::load(6, from, tied[g].data());
            tied[g] *= batch.weights[g] * batch.T[g];
          }
        return;
      }
    std::array<std::array<Vec6<Number>, most_tied>, size> of_lane;
    for (unsigned int l = 0; l < batch.lanes.size(); ++l)
      {
        const Lane &lane = batch.lanes[l];
        lane.body->to_tying(lane.element, stress + lane.first_strain, of_lane[l].data());
      }
    for (unsigned int k = 0; k < n_tied; ++k)
      {
        for (unsigned int l = 0; l < size; ++l)
          from[l] = of_lane[std::min<unsigned int>(l, batch.lanes.size() - 1)][k].data();
        Lanes<Number>::load(6, from, tied[k].data());
      }
  }



  template <int dim>
  template <int N, typename Number>
  void
  ElementLanes<dim>::batch_strains(const Batch &batch, const Point<Number> &point, Number *e)
  {
    using Number_in_lanes                 = typename Lanes<Number>::type;
    const ElementTable<dim>            &t = table_of(batch);
    kernel::NodeValues<Number_in_lanes> nodes[N > 0 ? N : most_nodes];
    Vec6<Number_in_lanes>               tied[most_tied];
    gather_lanes(batch, point.q, nodes);
    for (unsigned int k = 0; k < dim * t.n_tying; ++k)
      tied[k] = kernel::strain(kernel::interpolate<N>(nodes, t.n_nodes, &t.N(k, 0), &t.dN(k, 0)));
    batch_to_points(batch, tied, e);
  }



  template <int dim>
  template <typename Number>
  void
  ElementLanes<dim>::strains(const Point<Number> &point, Number *e) const
  {
    for_batches<Number>([&](const Batch &batch, const auto N) { batch_strains<N>(batch, point, e); });
    for (const auto &part : parts)
      part.body->subtract_reference(e + part.first_strain);
  }



  template <int dim>
  template <int N>
  void
  ElementLanes<dim>::batch_strain_rates(const Batch &batch, const Point<double> &point, double *rates)
  {
    const ElementTable<dim>        &t = table_of(batch);
    kernel::NodeValues<FourDoubles> nodes[N > 0 ? N : most_nodes], velocities[N > 0 ? N : most_nodes];
    Vec6<FourDoubles>               twists[N > 0 ? N : most_nodes], tied[most_tied];
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
  ElementLanes<dim>::strain_rates(const Point<double> &point, double *rates) const
  {
    for_batches<double>([&](const Batch &batch, const auto N) { batch_strain_rates<N>(batch, point, rates); });
  }



  template <int dim>
  template <int N, typename Number>
  void
  ElementLanes<dim>::batch_forces(const Batch                                     &batch,
                                  const Point<Number>                             &point,
                                  const Number                                    *stress,
                                  const std::array<Number *, Lanes<Number>::size> &local)
  {
    using Number_in_lanes            = typename Lanes<Number>::type;
    const ElementTable<dim> &t       = table_of(batch);
    const unsigned int       n_nodes = N > 0 ? N : t.n_nodes;

    Vec6<Number_in_lanes> tied[most_tied];
    batch_to_tying(batch, stress, tied);
    kernel::NodeValues<Number_in_lanes> nodes[N > 0 ? N : most_nodes], forces[N > 0 ? N : most_nodes];
    gather_lanes(batch, point.q, nodes);
    for (unsigned int a = 0; a < n_nodes; ++a)
      forces[a] = {Vec3<Number_in_lanes>::Zero(), Mat3<Number_in_lanes>::Zero()};
    for (unsigned int k = 0; k < dim * t.n_tying; ++k)
      {
        const auto force = kernel::force(kernel::interpolate<N>(nodes, n_nodes, &t.N(k, 0), &t.dN(k, 0)), tied[k]);
        for (unsigned int a = 0; a < n_nodes; ++a)
          kernel::add_to_node(force, t.N(k, a), t.dN(k, a), forces[a]);
      }
    if (point.reciprocal != nullptr)
      gather_lanes(batch, point.reciprocal, nodes);
    Number_in_lanes result[6 * (N > 0 ? N : most_nodes)];
    for (unsigned int a = 0; a < n_nodes; ++a)
      Eigen::Map<Vec6<Number_in_lanes>>{result + 6 *a} = kernel::node_forces(nodes[a].D, forces[a]);
    Lanes<Number>::store(6 * n_nodes, result, local);
  }



  template <int dim>
  template <typename Number>
  void
  ElementLanes<dim>::add_forces(const Point<Number> &point, const Number *stress, Number *r) const
  {
    const auto &all = batches_of<Number>();
    add_batches([&](const unsigned int i, const auto N, const auto &to) { batch_forces<N>(all[i], point, stress, to); },
                r);
  }



  template <int dim>
  template <int N>
  void
  ElementLanes<dim>::batch_forces_and_rates(const Batch                   &batch,
                                            const Point<double>           &point,
                                            const double                  *stress,
                                            const std::array<double *, 4> &local,
                                            double                        *rates)
  {
    const ElementTable<dim>        &t       = table_of(batch);
    const unsigned int              n_nodes = N > 0 ? N : t.n_nodes;
    kernel::NodeValues<FourDoubles> nodes[N > 0 ? N : most_nodes], velocities[N > 0 ? N : most_nodes],
      forces[N > 0 ? N : most_nodes];
    Vec6<FourDoubles> twists[N > 0 ? N : most_nodes], tied[most_tied], stresses[most_tied];
    gather_lanes(batch, point.q, nodes);
    gather_twists(batch, point.y, twists);
    batch_to_tying(batch, stress, stresses);
    for (unsigned int a = 0; a < n_nodes; ++a)
      {
        velocities[a] = kernel::node_rates(nodes[a].D, twists[a]);
        forces[a]     = {Vec3<FourDoubles>::Zero(), Mat3<FourDoubles>::Zero()};
      }
    for (unsigned int k = 0; k < dim * t.n_tying; ++k)
      {
        const auto at = kernel::interpolate<N>(nodes, n_nodes, &t.N(k, 0), &t.dN(k, 0));
        tied[k]       = kernel::strain_rate(at, kernel::interpolate<N>(velocities, n_nodes, &t.N(k, 0), &t.dN(k, 0)));
        const auto force = kernel::force(at, stresses[k]);
        for (unsigned int a = 0; a < n_nodes; ++a)
          kernel::add_to_node(force, t.N(k, a), t.dN(k, a), forces[a]);
      }
    if (point.reciprocal != nullptr)
      gather_lanes(batch, point.reciprocal, nodes);
    FourDoubles result[6 * (N > 0 ? N : most_nodes)];
    for (unsigned int a = 0; a < n_nodes; ++a)
      Eigen::Map<Vec6<FourDoubles>>{result + 6 *a} = kernel::node_forces(nodes[a].D, forces[a]);
    Lanes<double>::store(6 * n_nodes, result, local);
    batch_to_points(batch, tied, rates);
  }



  template <int dim>
  void
  ElementLanes<dim>::add_forces_and_rates(const Point<double> &point,
                                          const double        *stress,
                                          double              *r,
                                          double              *rates) const
  {
    add_batches([&](const unsigned int i,
                    const auto         N,
                    const auto        &to) { batch_forces_and_rates<N>(batches[i], point, stress, to, rates); },
                r);
  }



  template <int dim>
  class ElementLanes<dim>::StoredStrains : public LinearStrains
  {
  public:
    explicit StoredStrains(const ElementLanes &elements)
      : elements(elements)
    {
      for (const auto &batch : elements.batches)
        {
          first.push_back(B.size());
          B.resize(B.size() + table_of(batch).n_points * table_of(batch).n_nodes);
        }
    }

    void
    renew(const Point<double> &point) override
    {
      parallel_for(first.size(), worth_threads, [&](const unsigned int begin, const unsigned int end) {
        RowMajor &of_element = Cosserat<dim>::scratch().B;
        for (unsigned int i = begin; i < end; ++i)
          for (unsigned int l = 0; l < elements.batches[i].lanes.size(); ++l)
            {
              const Lane              &lane = elements.batches[i].lanes[l];
              const ElementTable<dim> &t    = table_of(elements.batches[i]);
              of_element.resize(n * t.n_points, 6 * t.n_nodes);
              lane.body->interpolate_element(lane.element, point.q);
              lane.body->strain_matrix(lane.element, of_element);
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
      elements.add_batches([&](const unsigned int i, auto, const auto &to) { batch_forces(i, stress, to); }, r);
    }

  private:
    /** B of one node at one point: displacements do not change curvatures, which leaves three quarters. */
    struct NodeMatrix
    {
      FourDoubles values[dim][3][9] = {};

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
      add_strains(const Vec6<FourDoubles> &z, Eigen::Matrix<FourDoubles, n, 1> &e) const
      {
        for (unsigned int alpha = 0; alpha < dim; ++alpha)
          for (unsigned int i = 0; i < 3; ++i)
            {
              const FourDoubles *const b = values[alpha][i];
              e(6 * alpha + i) += b[0] * z(0) + b[1] * z(1) + b[2] * z(2) + b[3] * z(3) + b[4] * z(4) + b[5] * z(5);
              e(6 * alpha + 3 + i) += b[6] * z(3) + b[7] * z(4) + b[8] * z(5);
            }
      }

      void
      add_forces(const Eigen::Matrix<FourDoubles, n, 1> &s, Vec6<FourDoubles> &f) const
      {
        for (unsigned int alpha = 0; alpha < dim; ++alpha)
          for (unsigned int j = 0; j < 3; ++j)
            {
              const auto        &b = values[alpha];
              const FourDoubles *N = &s(6 * alpha), *const M = N + 3;
              f(j) += b[0][j] * N[0] + b[1][j] * N[1] + b[2][j] * N[2];
              f(3 + j) += b[0][3 + j] * N[0] + b[1][3 + j] * N[1] + b[2][3 + j] * N[2] + b[0][6 + j] * M[0] +
                          b[1][6 + j] * M[1] + b[2][6 + j] * M[2];
            }
      }
    };

    const ElementLanes       &elements;
    std::vector<NodeMatrix>   B;     ///< by batches, points, nodes
    std::vector<unsigned int> first; ///< of each batch

    void
    batch_strains(const unsigned int i, const double *y, double *e) const
    {
      const Batch             &batch = elements.batches[i];
      const ElementTable<dim> &t     = table_of(batch);
      Vec6<FourDoubles>        twists[most_nodes];
      gather_twists(batch, y, twists);
      for (unsigned int g = 0; g < t.n_points; ++g)
        {
          Eigen::Matrix<FourDoubles, n, 1> sum = Eigen::Matrix<FourDoubles, n, 1>::Zero();
          for (unsigned int a = 0; a < t.n_nodes; ++a)
            B[first[i] + g * t.n_nodes + a].add_strains(twists[a], sum);
          double                  not_wanted[n];
          std::array<double *, 4> to;
          for (unsigned int l = 0; l < to.size(); ++l)
            to[l] = l < batch.lanes.size() ? e + batch.lanes[l].first_strain + n * g : not_wanted;
          Lanes<double>::store(n, sum.data(), to);
        }
    }

    void
    batch_forces(const unsigned int i, const double *stress, const std::array<double *, 4> &to) const
    {
      const Batch             &batch = elements.batches[i];
      const ElementTable<dim> &t     = table_of(batch);
      Vec6<FourDoubles>        forces[most_nodes];
      for (unsigned int a = 0; a < t.n_nodes; ++a)
        forces[a].setZero();
      for (unsigned int g = 0; g < t.n_points; ++g)
        {
          std::array<const double *, 4> from;
          for (unsigned int l = 0; l < 4; ++l)
            from[l] = stress + batch.lanes[std::min<unsigned int>(l, batch.lanes.size() - 1)].first_strain + n * g;
          Eigen::Matrix<FourDoubles, n, 1> s;
          Lanes<double>::load(n, from, s.data());
          s *= batch.weights[g];
          for (unsigned int a = 0; a < t.n_nodes; ++a)
            B[first[i] + g * t.n_nodes + a].add_forces(s, forces[a]);
        }
      Lanes<double>::store(6 * t.n_nodes, forces[0].data(), to);
    }
  };



  template <int dim>
  std::unique_ptr<LinearStrains>
  ElementLanes<dim>::linear_strains() const
  {
    return std::make_unique<StoredStrains>(*this);
  }



  template class ElementLanes<1>;
  template class ElementLanes<2>;
  template void ElementLanes<1>::strains(const Point<double> &, double *) const;
  template void ElementLanes<1>::strains(const Point<std::complex<double>> &, std::complex<double> *) const;
  template void ElementLanes<1>::add_forces(const Point<double> &, const double *, double *) const;
  template void ElementLanes<1>::add_forces(const Point<std::complex<double>> &,
                                            const std::complex<double> *,
                                            std::complex<double> *) const;
  template void ElementLanes<2>::strains(const Point<double> &, double *) const;
  template void ElementLanes<2>::strains(const Point<std::complex<double>> &, std::complex<double> *) const;
  template void ElementLanes<2>::add_forces(const Point<double> &, const double *, double *) const;
  template void ElementLanes<2>::add_forces(const Point<std::complex<double>> &,
                                            const std::complex<double> *,
                                            std::complex<double> *) const;
} // namespace samara
