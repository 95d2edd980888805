// B of elements, and the matrices made of it.

#include <samara/base/threads.h>
#include <samara/cosserat/cosserat.h>
#include <samara/model/strain_rows.h>

namespace samara
{
  namespace
  {
    /** Call @p f with the number of columns of B as a constant: of beams of degree 1 to 6; else, of shells, with 0. */
    template <typename Function>
    void
    with_columns(const unsigned int n_columns, const Function &f)
    {
      switch (n_columns)
        {
          case 12:
            return f(std::integral_constant<int, 12>());
          case 18:
            return f(std::integral_constant<int, 18>());
          case 24:
            return f(std::integral_constant<int, 24>());
          case 30:
            return f(std::integral_constant<int, 30>());
          case 36:
            return f(std::integral_constant<int, 36>());
          case 42:
            return f(std::integral_constant<int, 42>());
          default:
            return f(std::integral_constant<int, 0>());
        }
    }

    /** K += Bᵀ A: a column of K stays in registers. */
    void
    add_transpose_product(const RowMajor &B, const RowMajor &A, Eigen::MatrixXd &K)
    {
      with_columns(B.cols(), [&](const auto n_columns) {
        if constexpr (n_columns == 0)
          K.noalias() += B.transpose() * A;
        else
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
      });
    }

    /** The rows of C B from @p first on: of a section few entries of C are not zero. */
    template <int n>
    void
    multiply(const Eigen::Matrix<double, n, n> &C, const RowMajor &B, const unsigned int first, RowMajor &CB)
    {
      with_columns(B.cols(), [&](const auto n_columns) {
        if constexpr (n_columns == 0)
          CB.template middleRows<n>(first).noalias() = C.lazyProduct(B.template middleRows<n>(first));
        else
          {
            using Row = Eigen::Matrix<double, n_columns, 1>;
            for (int i = 0; i < n; ++i)
              {
                Row sum = C(i, 0) * Eigen::Map<const Row>(&B(first, 0));
                for (int j = 1; j < n; ++j)
                  if (C(i, j) != 0)
                    sum += C(i, j) * Eigen::Map<const Row>(&B(first + j, 0));
                Eigen::Map<Row>(&CB(first + i, 0)) = sum;
              }
          }
      });
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
  void
  Cosserat<dim>::strain_matrix(const unsigned int element, RowMajor &B_element) const
  {
    // at the points where strains are sampled: beams integrate there, shells interpolate from there and turn components
    // into the axes of the integration points by T (doc/theory/shell.md)
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
                for (unsigned int beta = 0; beta < dim && t.interpolation[alpha](g, k) != 0.; ++beta)
                  B.template middleRows<6>(6 * beta) += point.T(beta, alpha) * t.interpolation[alpha](g, k) *
                                                        s.B_tied.template middleRows<6>(6 * (alpha * t.n_tying + k));
          }
      }
  }



  template <int dim>
  void
  Cosserat<dim>::add_material(const unsigned int element, MatrixN Material::*which, Eigen::MatrixXd &K) const
  {
    add_stiffness(
      element, [&](const unsigned int g) -> const MatrixN & { return materials[points[g].material].*which; }, K);
  }



  template <int dim>
  template <typename Stiffness>
  void
  Cosserat<dim>::add_stiffness(const unsigned int element, const Stiffness &stiffness, Eigen::MatrixXd &K) const
  {
    const ElementTable<dim> &t = *elements[element].table;
    Scratch                 &s = scratch();
    s.B.resize(n * t.n_points, 6 * t.n_nodes);
    s.CB.resize(n * t.n_points, 6 * t.n_nodes);
    strain_matrix(element, s.B);
    for (unsigned int g = 0; g < t.n_points; ++g)
      {
        const unsigned int number = elements[element].first_point + g;
        multiply<n>(points[number].weight * stiffness(number), s.B, n * g, s.CB);
      }
    add_transpose_product(s.B, s.CB, K);
  }



  template <int dim>
  void
  Cosserat<dim>::add_geometric(const unsigned int element, const Vec6<double> *tied, Eigen::MatrixXd &K) const
  {
    // n_ab, m_ab and the forces of nodes: doc/theory/element.md, the tangent
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
  template <typename Function>
  void
  Cosserat<dim>::add_matrices(SparseMatrix &A, const Function &f, const Point<double> &point) const
  {
    // so many that their matrices stay in the cache until they are added, in order
    const unsigned int                               at_once = n_elements() < 4 * worth_threads ? 1 : worth_threads;
    static thread_local std::vector<Eigen::MatrixXd> values;
    values.resize(std::max<std::size_t>(values.size(), at_once));
    Eigen::MatrixXd *const first = values.data();
    for (unsigned int start = 0; start < n_elements(); start += at_once)
      {
        const unsigned int n_now = std::min(at_once, n_elements() - start);
        parallel_for(n_now, worth_threads, [&](const unsigned int begin, const unsigned int end) {
          for (unsigned int i = begin; i < end; ++i)
            {
              const unsigned int n_columns = 6 * elements[start + i].table->n_nodes;
              interpolate_element(start + i, point.q);
              first[i].setZero(n_columns, n_columns);
              f(start + i, first[i]);
            }
        });
        for (unsigned int i = 0; i < n_now; ++i)
          elements[start + i].block.add(first[i], A);
      }
  }



  template <int dim>
  void
  Cosserat<dim>::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    const double *stress = point.stress + this->first_strain;
    add_matrices(
      K,
      [&](const unsigned int i, Eigen::MatrixXd &K_element) {
        Scratch &s = scratch();
        to_tying(i, stress + n * elements[i].first_point, s.tied.data());
        if (point.material)
          add_material(i, &Material::stiffness, K_element);
        add_geometric(i, s.tied.data(), K_element);
      },
      point);
  }



  template <int dim>
  void
  Cosserat<dim>::add_tangent(const Point<double> &point,
                             const MatrixN *const C,
                             const double *const  forces,
                             SparseMatrix        &K) const
  {
    add_matrices(
      K,
      [&](const unsigned int i, Eigen::MatrixXd &K_element) {
        Scratch &s = scratch();
        to_tying(i, forces + n * elements[i].first_point, s.tied.data());
        if (C != nullptr)
          add_stiffness(
            i, [&](const unsigned int g) -> const MatrixN & { return C[g]; }, K_element);
        add_geometric(i, s.tied.data(), K_element);
      },
      point);
  }



  template <int dim>
  void
  Cosserat<dim>::damping(const Point<double> &point, SparseMatrix &C) const
  {
    if (!is_viscous() || !point.material)
      return;
    add_matrices(
      C,
      [&](const unsigned int i, Eigen::MatrixXd &C_element) { add_material(i, &Material::viscosity, C_element); },
      point);
  }



  template <int dim>
  void
  Cosserat<dim>::strain_rows(const Point<double> &point, StrainRows &rows) const
  {
    for_strain_matrices(point, [&](const unsigned int g, const Block &block, const auto &B) {
      const Material &material = materials[points[g].material];
      rows.add_point(this->first_strain + n * g, points[g].weight, material.stiffness, material.viscosity);
      for (unsigned int row = 0; row < n; ++row)
        {
          rows.begin_row();
          for (int j = 0; j < B.cols(); ++j)
            rows.add_entry(block.row(j), B(row, j));
        }
    });
  }



  template void Cosserat<1>::strain_rows(const Point<double> &, StrainRows &) const;
  template void Cosserat<2>::strain_rows(const Point<double> &, StrainRows &) const;
  template void Cosserat<1>::add_material(unsigned int, MatrixN Material::*, Eigen::MatrixXd &) const;
  template void Cosserat<1>::add_geometric(unsigned int, const Vec6<double> *, Eigen::MatrixXd &) const;
  template void Cosserat<1>::tangent(const Point<double> &, SparseMatrix &) const;
  template void Cosserat<1>::add_tangent(const Point<double> &, const MatrixN *, const double *, SparseMatrix &) const;
  template void Cosserat<1>::damping(const Point<double> &, SparseMatrix &) const;
  template void Cosserat<1>::interpolate_element(unsigned int, const double *) const;
  template void Cosserat<1>::strain_matrix(unsigned int, RowMajor &) const;
  template void Cosserat<2>::add_material(unsigned int, MatrixN Material::*, Eigen::MatrixXd &) const;
  template void Cosserat<2>::add_geometric(unsigned int, const Vec6<double> *, Eigen::MatrixXd &) const;
  template void Cosserat<2>::tangent(const Point<double> &, SparseMatrix &) const;
  template void Cosserat<2>::add_tangent(const Point<double> &, const MatrixN *, const double *, SparseMatrix &) const;
  template void Cosserat<2>::damping(const Point<double> &, SparseMatrix &) const;
  template void Cosserat<2>::interpolate_element(unsigned int, const double *) const;
  template void Cosserat<2>::strain_matrix(unsigned int, RowMajor &) const;
} // namespace samara
