#include <samara/base/composite_rule.h>
#include <samara/rotation/matrix6.h>
#include <samara/section/cross_section.h>
#include <samara/section/elasticity.h>
#include <samara/section/trapeze.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace samara
{
  namespace
  {
    /** Rows of S: a displacement's derivative along the beam is ε₁₁, 2ε₁₂, 2ε₁₃. */
    constexpr int row_of_S[3] = {0, 5, 4};



    /** Z = [I, −x~]: what a strain of the reference line is at the distance x = (0, x₂, x₃). */
    Eigen::Matrix<double, 3, 6>
    shift_by(const dealii::Tensor<1, 2> &x)
    {
      Eigen::Matrix<double, 3, 6> Z;
      Z << Matrix3::Identity(), -skew(Vector3(0, x[0], x[1]));
      return Z;
    }



    /**
     * The strains (Γ, K) at the distance @p x from a point, from those at the point. Transposed, it takes forces (F, M)
     * about the one at x to those about the point.
     */
    Matrix6
    strains_at(const dealii::Tensor<1, 2> &x)
    {
      Matrix6 result                = Matrix6::Identity();
      result.topRightCorner<3, 3>() = -skew(Vector3(0, x[0], x[1]));
      return result;
    }



    Matrix6
    S_times(const Eigen::Matrix<double, 3, 6> &Z)
    {
      Matrix6 result = Matrix6::Zero();
      for (int i = 0; i < 3; ++i)
        result.row(row_of_S[i]) = Z.row(i);
      return result;
    }



    /** Strains of the nodal displacements at a point, (6, 3 n): B_k, and S N. */
    struct Operators
    {
      Eigen::MatrixXd B, SN;

      explicit Operators(const unsigned int n)
        : B(Eigen::MatrixXd::Zero(6, n))
        , SN(Eigen::MatrixXd::Zero(6, n))
      {}

      void
      fill(const dealii::FEValues<2> &values, const unsigned int q, const Vector3 &k, const double root_g)
      {
        const dealii::Point<2> x      = values.quadrature_point(q);
        const Matrix3          k_skew = skew(k);
        for (unsigned int a = 0; a < values.get_fe().n_dofs_per_cell(); ++a)
          {
            const unsigned int i     = values.get_fe().system_to_component_index(a).first;
            const double       N     = values.shape_value(a, q);
            const auto         dN    = values.shape_grad(a, q);
            const double       turns = k(0) * (x[1] * dN[0] - x[0] * dN[1]);
            B.col(a).setZero();
            SN.col(a).setZero();
            SN(row_of_S[i], a) = N;
            for (int j = 0; j < 3; ++j)
              B(row_of_S[j], a) = (k_skew(j, i) * N + (int(i) == j ? turns : 0.)) / root_g;
            if (i == 0)
              {
                B(5, a) += dN[0];
                B(4, a) += dN[1];
              }
            else
              {
                B(i, a) += dN[i - 1];
                B(3, a) += dN[2 - i];
              }
          }
      }
    };



    double
    root_g(const Vector3 &k, const dealii::Point<2> &x)
    {
      return 1 - x[0] * k(2) + x[1] * k(1);
    }



    Eigen::Matrix2d
    jacobian(const dealii::FEValues<2> &values, const unsigned int q)
    {
      Eigen::Matrix2d J;
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = 0; j < 2; ++j)
          J(i, j) = values.jacobian(q)[i][j];
      return J;
    }



    /** A matrix of zeros with the entries that the pattern names, in ascending order in each row. */
    SectionMatrix
    zeros(const dealii::DynamicSparsityPattern &pattern)
    {
      SectionMatrix result(pattern.n_rows(), pattern.n_cols());
      result.resizeNonZeros(pattern.n_nonzero_elements());
      int *row = result.outerIndexPtr(), *column = result.innerIndexPtr();
      for (unsigned int i = 0; i < pattern.n_rows(); ++i)
        {
          for (auto entry = pattern.begin(i); entry != pattern.end(i); ++entry)
            *column++ = entry->column();
          row[i + 1] = column - result.innerIndexPtr();
        }
      std::fill_n(result.valuePtr(), result.nonZeros(), 0.);
      return result;
    }



    /** Add three matrices of a cell to those of one pattern. */
    void
    add_cell(const std::vector<dealii::types::global_dof_index> &numbers,
             const std::array<const Eigen::MatrixXd *, 3>       &from,
             const std::array<SectionMatrix *, 3>               &to)
    {
      const unsigned int                            n = numbers.size();
      static thread_local std::vector<unsigned int> order;
      order.resize(n);
      std::iota(order.begin(), order.end(), 0u);
      std::sort(order.begin(), order.end(), [&](const unsigned int a, const unsigned int b) {
        return numbers[a] < numbers[b];
      });
      const int *const column = to[0]->innerIndexPtr();
      for (const unsigned int a : order)
        {
          // the columns of a row ascend, and so do those of the cell: one walk along the row meets all of them
          int place = to[0]->outerIndexPtr()[numbers[a]];
          for (const unsigned int b : order)
            {
              while (column[place] != static_cast<int>(numbers[b]))
                ++place;
              for (unsigned int matrix = 0; matrix < 3; ++matrix)
                to[matrix]->valuePtr()[place] += (*from[matrix])(a, b);
            }
        }
    }



    /**
     * The integrals of a cell. Those of all points stand one below the other, for large products are fast; of S N there
     * are only the rows that are not zero.
     */
    class CellIntegrals
    {
    public:
      CellIntegrals(const dealii::FiniteElement<2> &fe, const unsigned int n_points)
        : E(fe.n_dofs_per_cell(), fe.n_dofs_per_cell())
        , C(E)
        , M(E)
        , R(E.rows(), 6)
        , L(E.rows(), 6)
        , fe(fe)
        , at(E.rows())
        , B(6 * n_points, E.rows())
        , SN(3 * n_points, E.rows())
        , QB(6 * n_points, E.rows())
        , QSN(6 * n_points, E.rows())
        , rows_of_QSN(3 * n_points, E.rows())
        , QSZ(6 * n_points, 6)
        , rows_of_QSZ(3 * n_points, 6)
      {}

      Eigen::MatrixXd E, C, M, R, L;

      /** Take point @p q with Z and the stiffness @p Q there; Q S Z of it is returned. */
      Matrix6
      add(const dealii::FEValues<2>         &values,
          const unsigned int                 q,
          const Vector3                     &k,
          const double                       g,
          const Matrix6                     &Q,
          const Eigen::Matrix<double, 3, 6> &Z)
      {
        const double w = values.JxW(q);
        at.fill(values, q, k, g);
        const Matrix6 QSZ_q               = Q * S_times(Z);
        B.middleRows<6>(6 * q)            = at.B;
        QB.middleRows<6>(6 * q).noalias() = (w * g * Q) * at.B;
        QSZ.middleRows<6>(6 * q)          = w * QSZ_q;
        for (unsigned int a = 0; a < fe.n_dofs_per_cell(); ++a)
          {
            const int row             = row_of_S[fe.system_to_component_index(a).first];
            QSN.block<6, 1>(6 * q, a) = w * at.SN(row, a) * Q.col(row);
          }
        for (int i = 0; i < 3; ++i)
          {
            SN.row(3 * q + i)          = at.SN.row(row_of_S[i]);
            rows_of_QSN.row(3 * q + i) = QSN.row(6 * q + row_of_S[i]) / g;
            rows_of_QSZ.row(3 * q + i) = w / g * QSZ_q.row(row_of_S[i]);
          }
        return QSZ_q;
      }

      /** When all points have been added. */
      void
      multiply()
      {
        E.noalias() = B.transpose() * QB;
        C.noalias() = B.transpose() * QSN;
        M.noalias() = SN.transpose() * rows_of_QSN;
        R.noalias() = B.transpose() * QSZ;
        L.noalias() = SN.transpose() * rows_of_QSZ;
      }

    private:
      const dealii::FiniteElement<2> &fe;
      Operators                       at;
      Eigen::MatrixXd                 B, SN, QB, QSN, rows_of_QSN, QSZ, rows_of_QSZ;
    };



    /** The larger part of the two compliances in shear that is due to torsion by the force's distance from its centre.
     */
    double
    part_of_torsion(const Matrix6 &F)
    {
      return std::max(F(1, 3) * F(1, 3) / F(1, 1), F(2, 3) * F(2, 3) / F(2, 2)) / F(3, 3);
    }



    /** What is left of the warping when the rigid motion nearest to it, by least squares, is taken away. */
    void
    remove_rigid_motions(std::vector<CrossSection::StressPoint> &points)
    {
      Matrix6                sum = Matrix6::Zero(), of_warping = Matrix6::Zero();
      const dealii::Point<2> near = points.front().place;
      for (const auto &point : points)
        {
          const auto Z = shift_by(point.place - near);
          sum += point.weight * Z.transpose() * Z;
          of_warping += point.weight * Z.transpose() * point.warping;
        }
      const Matrix6 motion = symmetric_inverse(sum) * of_warping;
      for (auto &point : points)
        point.warping -= shift_by(point.place - near) * motion;
    }
  } // namespace



  CrossSection::CrossSection(const SectionMesh                  &mesh,
                             const std::vector<SectionMaterial> &materials,
                             const Vector3                      &curvature)
    : mesh(mesh)
    , materials(materials)
    , k(curvature)
    , fe(dealii::FE_Q<2>(mesh.degree), 3)
    , dofs(mesh.triangulation)
  {
    const auto &vertices = mesh.triangulation.get_vertices();
    for (const auto &x : vertices)
      centre += x / double(vertices.size());
    find_T();
    dofs.distribute_dofs(fe);
    assemble();
    find_pins();
    solve();
    Matrix6 F = compliance_about_centre();
    // where most of the compliance in shear is that of torsion, as in thin open sections, its round-off is that of
    // torsion, too; about the shear centre they part
    if (part_of_torsion(F) > 0.5)
      {
        constexpr double enough = 1e-12, largest = 1e-6;
        for (unsigned int i = 0; i < 3 && part_of_torsion(F) > enough; ++i)
          {
            move_centre(shear_centre(F));
            solve();
            F = compliance_about_centre();
          }
        // nothing but round-off couples them there
        if (!(part_of_torsion(F) < largest))
          throw std::invalid_argument("the analysis of the section is lost in round-off: its walls are too thin for an "
                                      "open section of their width");
      }
    set_stiffness(F);
    forget_integrals();
  }



  void
  CrossSection::assemble()
  {
    dealii::DynamicSparsityPattern pattern(dofs.n_dofs());
    dealii::DoFTools::make_sparsity_pattern(dofs, pattern);
    E = zeros(pattern);
    C = E;
    M = E;
    R = Columns::Zero(dofs.n_dofs(), 6);
    L = R;
    inertia.setZero();

    const dealii::QGauss<2>                      quadrature(mesh.degree + 1);
    dealii::FEValues<2>                          values(mesh.mapping,
                               fe,
                               quadrature,
                               dealii::update_values | dealii::update_gradients | dealii::update_quadrature_points |
                                 dealii::update_JxW_values | dealii::update_jacobians);
    CellIntegrals                                integrals(fe, quadrature.size());
    std::vector<dealii::types::global_dof_index> numbers(fe.n_dofs_per_cell());
    for (const auto &cell : dofs.active_cell_iterators())
      {
        values.reinit(cell);
        const unsigned int     index    = cell->active_cell_index();
        const SectionMaterial &material = materials.at(mesh.ply(index).material);
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            const dealii::Point<2> place = values.quadrature_point(q);
            const double           g = root_g(k, place), w = values.JxW(q);
            if (!(g > 0.01))
              throw std::invalid_argument("the curvature of the beam is too large for the depth of the section: its "
                                          "centre lies in the section or near it");
            const Matrix6 Q =
              elasticity::turned(material.stiffness, mesh.material_axes(index, place, jacobian(values, q)));
            const Eigen::Matrix<double, 3, 6> Z = shift_by(place - centre), Z_of_line = shift_by(place);
            A += w / g * S_times(Z).transpose() * integrals.add(values, q, k, g, Q, Z);
            inertia += w * g * material.density * Z_of_line.transpose() * Z_of_line;
            area += w;
          }
        integrals.multiply();
        cell->get_dof_indices(numbers);
        add_cell(numbers, {{&integrals.E, &integrals.C, &integrals.M}}, {{&E, &C, &M}});
        for (unsigned int i = 0; i < numbers.size(); ++i)
          {
            R.row(numbers[i]) += integrals.R.row(i);
            L.row(numbers[i]) += integrals.L.row(i);
          }
      }
  }



  void
  CrossSection::find_pins()
  {
    // all three displacements at one node, two at the node farthest from it, one at the node farthest from their line:
    // no rigid motion is left, and statics alone gives the reactions
    std::vector<dealii::Point<2>> places(dofs.n_dofs());
    dealii::DoFTools::map_dofs_to_support_points(mesh.mapping, dofs, places);
    std::array<std::vector<unsigned int>, 3> of_component;
    const auto                               masks = dealii::DoFTools::locally_owned_dofs_per_component(dofs);
    for (unsigned int d = 0; d < 3; ++d)
      for (const auto i : masks[d])
        of_component[d].push_back(i);
    const auto farthest = [&](const auto &distance) {
      unsigned int best = 0;
      for (unsigned int i = 0; i < of_component[0].size(); ++i)
        if (distance(places[of_component[0][i]]) > distance(places[of_component[0][best]]) * (1 + 1e-9))
          best = i;
      return places[of_component[0][best]];
    };
    const auto unknown_at = [&](const dealii::Point<2> &x, const unsigned int d) {
      unsigned int best = of_component[d][0];
      for (const auto i : of_component[d])
        if (places[i].distance(x) < places[best].distance(x))
          best = i;
      return best;
    };
    dealii::Point<2> middle;
    for (const auto i : of_component[0])
      middle += places[i] / double(of_component[0].size());
    const auto first  = farthest([&](const dealii::Point<2> &x) { return x.distance(middle); });
    const auto second = farthest([&](const dealii::Point<2> &x) { return x.distance(first); });
    const auto line   = second - first;
    const auto third  = farthest([&](const dealii::Point<2> &x) {
      const auto r = x - first;
      return std::abs(line[0] * r[1] - line[1] * r[0]);
    });
    // of the second node the displacement across the line that is larger there
    const unsigned int across = std::abs(line[0]) > std::abs(line[1]) ? 2 : 1;
    pinned                    = {{unknown_at(first, 0),
                                  unknown_at(first, 1),
                                  unknown_at(first, 2),
                                  unknown_at(second, 0),
                                  unknown_at(second, across),
                                  unknown_at(third, 0)}};
  }



  CrossSection::Columns
  CrossSection::times(const SectionMatrix &matrix, const Columns &x, const bool transposed) const
  {
    // all columns in one pass through the matrix
    using Rows        = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;
    const Rows from   = x;
    Rows       result = Rows::Zero(x.rows(), 6);
    for (unsigned int i = 0; i < x.rows(); ++i)
      for (SectionMatrix::InnerIterator entry(matrix, i); entry; ++entry)
        if (transposed)
          result.row(entry.col()) += entry.value() * from.row(i);
        else
          result.row(i) += entry.value() * from.row(entry.col());
    return result;
  }



  /**
   * T of ϑ' = −T ϑ about the centre c: M' + k × M + r' × F = 0, r' = e₁ + k × c being the way of c along the beam.
   */
  void
  CrossSection::find_T()
  {
    T.setZero();
    T.topLeftCorner<3, 3>() = T.bottomRightCorner<3, 3>() = skew(k);
    T.bottomLeftCorner<3, 3>() = skew(Vector3(1, 0, 0) + k.cross(Vector3(0, centre[0], centre[1])));
  }



  void
  CrossSection::move_centre(const Eigen::Vector2d &by)
  {
    const dealii::Tensor<1, 2> way({by(0), by(1)});
    // strains of the old centre from those of the new one: Z, and what is linear in it, change by this on the right
    const Matrix6 back = strains_at(-way);
    centre += way;
    R = R * back;
    L = L * back;
    A = back.transpose() * A * back;
    find_T();
  }



  Matrix6
  CrossSection::compliance_about_centre()
  {
    const Columns XT = X * T, XTT = XT * T, EX = times(E, X), CXT = times(C, XT), MXT = times(M, XT);
    const Columns rest = EX + times(C, XT, true) - CXT - times(M, XTT) + R * Y + L * Y * T;
    const Columns RY   = R * Y;
    reaction           = rest.cwiseAbs().maxCoeff() / RY.cwiseAbs().maxCoeff();
    // measured: at 1e-9 all is well, at 1e-6 stiffnesses in shear are off by factors
    constexpr double round_off = 1e-7;
    if (!(reaction < round_off))
      throw std::invalid_argument("the analysis of the section is lost in round-off: its cells are too thin for their "
                                  "length; give a lower <Degree>, more <Elements> or thicker plies");

    const Matrix6 half =
      Y.transpose() * (R.transpose() * X) - Y.transpose() * (L.transpose() * XT) - X.transpose() * CXT;
    const Matrix6 F = Y.transpose() * A * Y + X.transpose() * EX + XT.transpose() * MXT + half + half.transpose();
    return 0.5 * (F + F.transpose());
  }



  void
  CrossSection::set_stiffness(const Matrix6 &F)
  {
    // strains of the line are those of the centre at the distance −c, and the other way round
    const Matrix6 of_line = strains_at(-centre), of_centre = strains_at(centre);
    const Matrix6 K = positive_inverse(F);
    compliance      = of_line * F * of_line.transpose();
    stiffness       = of_centre.transpose() * K * of_centre;
    compliance      = (0.5 * (compliance + compliance.transpose())).eval();
    stiffness       = (0.5 * (stiffness + stiffness.transpose())).eval();
  }



  void
  CrossSection::forget_integrals()
  {
    for (auto *const matrix : {&E, &C, &M})
      *matrix = SectionMatrix();
    R.resize(0, 6);
    L.resize(0, 6);
  }



  std::vector<CrossSection::StressPoint>
  CrossSection::points() const
  {
    return points(dealii::QGauss<2>(mesh.degree + 1));
  }



  namespace
  {
    /** Determinant of the Jacobian of a mapping, by differences to the inside of the cell: at a corner of 180 degrees,
     * as discs have them, or of a little more, where deal.II refuses to look. */
    double
    determinant_at(const dealii::Mapping<2>                             &mapping,
                   const dealii::Triangulation<2>::cell_iterator &cell,
                   const dealii::Point<2>                               &unit)
    {
      constexpr double       step = 1e-6; // half of the digits
      const dealii::Point<2> here = mapping.transform_unit_to_real_cell(cell, unit);
      dealii::Tensor<1, 2>   columns[2];
      for (unsigned int d = 0; d < 2; ++d)
        {
          dealii::Point<2> next = unit;
          const double     h    = unit[d] > 0.5 ? -step : step;
          next[d] += h;
          columns[d] = (mapping.transform_unit_to_real_cell(cell, next) - here) / h;
        }
      return columns[0][0] * columns[1][1] - columns[0][1] * columns[1][0];
    }



    bool
    is_on_an_edge(const dealii::Point<2> &unit)
    {
      return unit[0] == 0 || unit[0] == 1 || unit[1] == 0 || unit[1] == 1;
    }



    /** Numbers of places of a quadrature at which a cell is so distorted that there are no gradients. */
    std::vector<unsigned int>
    distorted_places(const dealii::Mapping<2>                             &mapping,
                     const dealii::Triangulation<2>::cell_iterator &cell,
                     const dealii::Quadrature<2>                          &places)
    {
      constexpr double          least = 1e-3; // of the area
      std::vector<unsigned int> result;
      for (unsigned int q = 0; q < places.size(); ++q)
        if (is_on_an_edge(places.point(q)) &&
            !(determinant_at(mapping, cell, places.point(q)) > least * cell->measure()))
          result.push_back(q);
      return result;
    }



    /** The same places but for some, in place of which the middle of the cell stands. */
    dealii::Quadrature<2>
    with_middles(const dealii::Quadrature<2> &places, const std::vector<unsigned int> &some)
    {
      std::vector<dealii::Point<2>> points = places.get_points();
      for (const auto q : some)
        points[q] = {0.5, 0.5};
      return dealii::Quadrature<2>(points, places.get_weights());
    }
  } // namespace



  std::vector<CrossSection::StressPoint>
  CrossSection::points(const dealii::Quadrature<2> &quadrature) const
  {
    std::vector<StressPoint> result;
    const auto flags = dealii::update_values | dealii::update_gradients | dealii::update_quadrature_points |
                       dealii::update_JxW_values | dealii::update_jacobians;
    dealii::FEValues<2> values(mesh.mapping, fe, quadrature, flags);
    for (const auto &cell : dofs.active_cell_iterators())
      {
        const auto distorted = distorted_places(mesh.mapping, cell, quadrature);
        if (distorted.empty())
          {
            add_points(values, cell, result);
            continue;
          }
        dealii::FEValues<2> elsewhere(mesh.mapping, fe, with_middles(quadrature, distorted), flags);
        add_points(elsewhere, cell, result);
        for (const auto q : distorted)
          {
            StressPoint &point = result[result.size() - quadrature.size() + q];
            point.place        = mesh.mapping.transform_unit_to_real_cell(cell, quadrature.point(q));
            point.weight       = 0;
          }
      }
    remove_rigid_motions(result);
    return result;
  }



  void
  CrossSection::add_points(dealii::FEValues<2>                               &values,
                           const dealii::DoFHandler<2>::active_cell_iterator &cell,
                           std::vector<StressPoint>                          &result) const
  {
    const Columns                                XT = X * T;
    const unsigned int                           n  = fe.n_dofs_per_cell();
    Operators                                    at(n);
    Columns                                      X_cell(n, 6), XT_cell(n, 6);
    std::vector<dealii::types::global_dof_index> numbers(n);
    const Eigen::Vector2d                        of_shear = shear_centre(compliance);
    const Matrix6                                forces   = strains_at(-centre).transpose(); // about the centre
    values.reinit(cell);
    cell->get_dof_indices(numbers);
    for (unsigned int i = 0; i < n; ++i)
      {
        X_cell.row(i)  = X.row(numbers[i]);
        XT_cell.row(i) = XT.row(numbers[i]);
      }
    const unsigned int index = cell->active_cell_index();
    for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
      {
        StressPoint point;
        point.cell   = index;
        point.place  = values.quadrature_point(q);
        point.weight = values.JxW(q);
        point.axes   = mesh.material_axes(index, point.place, jacobian(values, q));
        point.C      = elasticity::turned(materials.at(mesh.ply(index).material).stiffness, point.axes);
        point.helix  = (Eigen::Vector2d(point.place[0], point.place[1]) - of_shear).squaredNorm() /
                      symmetric_solution(point.C, Vector6::Unit(0))(0);
        const double g = root_g(k, point.place);
        at.fill(values, q, k, g);
        const auto Z = shift_by(point.place - centre);
        point.strain = (S_times(Z) * Y / g + at.B * X_cell - at.SN * XT_cell / g) * forces;
        point.warping.setZero();
        for (unsigned int i = 0; i < n; ++i)
          point.warping.row(fe.system_to_component_index(i).first) += values.shape_value(i, q) * X_cell.row(i);
        point.warping = (point.warping * forces).eval();
        result.push_back(point);
      }
  }



  std::vector<CrossSection::StressPoint>
  CrossSection::extrapolated(const dealii::Quadrature<2> &places) const
  {
    // at a corner of nearly 180 degrees, as those of a disc, there are no gradients
    constexpr double         degenerate = 0.3; // over the mean of the Jacobian of a cell
    const unsigned int       n_line = mesh.degree + 1, n = n_line * n_line, n_places = places.size();
    std::vector<StressPoint> result = points(places);
    const auto               known  = points();
    std::vector<double>      line;
    const dealii::QGauss<1>  gauss(n_line);
    for (const auto &point : gauss.get_points())
      line.push_back(point[0]);
    Eigen::MatrixXd values(n_places, n); // of the polynomials of the points of integration
    for (unsigned int q = 0; q < n_places; ++q)
      for (unsigned int i = 0; i < n; ++i)
        values(q, i) = lagrange(line, i % n_line, places.point(q)[0]) * lagrange(line, i / n_line, places.point(q)[1]);
    for (unsigned int cell = 0; cell < known.size() / n; ++cell)
      {
        double area = 0;
        for (unsigned int i = 0; i < n; ++i)
          area += known[cell * n + i].weight;
        for (unsigned int q = 0; q < n_places; ++q)
          if (StressPoint &there = result[cell * n_places + q]; there.weight < degenerate * area * places.weight(q))
            {
              there.strain.setZero();
              there.warping.setZero();
              for (unsigned int i = 0; i < n; ++i)
                {
                  there.strain += values(q, i) * known[cell * n + i].strain;
                  there.warping += values(q, i) * known[cell * n + i].warping;
                }
            }
      }
    return result;
  }



  std::vector<CrossSection::StressPoint>
  CrossSection::points_with_faces() const
  {
    const unsigned int n = mesh.degree + 2;
    return extrapolated(dealii::QGaussLobatto<2>(n % 2 == 0 ? n + 1 : n));
  }



  Vector6
  CrossSection::stress_in_material(const StressPoint &point, const Vector6 &forces, const double helix)
  {
    return elasticity::turn_of_stress(point.axes.transpose()) * stress(point, forces, helix);
  }
} // namespace samara
