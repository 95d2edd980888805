/*
 * Problem:   a short composite beam, clamped at one end and pulled, bent and twisted by a traction at the other
 * Reference: the beam as a solid, solved here with elements of deal.II; stresses in the middle, two widths and a half
 * from both ends, where Saint-Venant's solution should hold
 */

#include <samara/section/cross_section.h>
#include <samara/section/elasticity.h>
#include <samara/section/shapes.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <Eigen/CholmodSupport>
#include <gtest/gtest.h>

#include <cmath>

using namespace samara;

namespace
{
  constexpr double       solid_width = 1, solid_height = 1, solid_length = 5;
  constexpr unsigned int across = 4, along = 11, solid_degree = 2;

  /** Two plies of glass, 30 and -15 degrees, one upon the other. */
  SectionMaterial
  glass()
  {
    return {elasticity::stiffness({42, 12, 12, 4.5, 4.5, 4.3, 0.28, 0.28, 0.4}), 1.};
  }
  const Wall two_plies = {{0, 30 * M_PI / 180, solid_height / 2}, {0, -15 * M_PI / 180, solid_height / 2}};

  Matrix6
  stiffness_at(const double x3)
  {
    const double c = std::cos(two_plies[x3 > 0].angle), s = std::sin(two_plies[x3 > 0].angle);
    Matrix3      axes;
    axes << c, -s, 0, s, c, 0, 0, 0, 1;
    return elasticity::turned(glass().stiffness, axes);
  }

  /** Voigt strains of a gradient of one component. */
  Vector6
  strains_of(const unsigned int component, const dealii::Tensor<1, 3> &g)
  {
    Vector6 e = Vector6::Zero();
    e(component) += g[component];
    constexpr unsigned int shear[3][3] = {{0, 5, 4}, {5, 0, 3}, {4, 3, 0}};
    for (unsigned int d = 0; d < 3; ++d)
      if (d != component)
        e(shear[component][d]) += g[d];
    return e;
  }

  /** The solid. Stresses at points of its middle plane. */
  class Solid
  {
  public:
    Solid(const Vector3 &traction)
      : fe(dealii::FE_Q<3>(solid_degree), 3)
      , dofs(grid)
    {
      dealii::GridGenerator::subdivided_hyper_rectangle(grid,
                                                        {along, across, across},
                                                        {0, -solid_width / 2, -solid_height / 2},
                                                        {solid_length, solid_width / 2, solid_height / 2});
      dofs.distribute_dofs(fe);
      const unsigned int      n = fe.n_dofs_per_cell();
      const dealii::QGauss<3> quadrature(solid_degree + 1);
      const dealii::QGauss<2> of_faces(solid_degree + 1);
      dealii::FEValues<3>     values(
        fe, quadrature, dealii::update_gradients | dealii::update_quadrature_points | dealii::update_JxW_values);
      dealii::FEFaceValues<3>             face_values(fe, of_faces, dealii::update_values | dealii::update_JxW_values);
      std::vector<Eigen::Triplet<double>> entries;
      Eigen::VectorXd                     load = Eigen::VectorXd::Zero(dofs.n_dofs());
      std::vector<bool>                   is_held(dofs.n_dofs(), false);
      std::vector<dealii::types::global_dof_index> numbers(n), of_face(fe.n_dofs_per_face());
      Eigen::MatrixXd                              B(6, n), K(n, n);
      for (const auto &cell : dofs.active_cell_iterators())
        {
          values.reinit(cell);
          cell->get_dof_indices(numbers);
          K.setZero();
          const Matrix6 C = stiffness_at(cell->center()[2]);
          for (unsigned int q = 0; q < quadrature.size(); ++q)
            {
              for (unsigned int a = 0; a < n; ++a)
                B.col(a) = strains_of(fe.system_to_component_index(a).first, values.shape_grad(a, q));
              K.noalias() += values.JxW(q) * B.transpose() * (C * B);
            }
          for (unsigned int a = 0; a < n; ++a)
            for (unsigned int b = 0; b < n; ++b)
              if (numbers[a] >= numbers[b])
                entries.emplace_back(numbers[a], numbers[b], K(a, b));
          for (const unsigned int f : {0u, 1u})
            if (cell->at_boundary(f))
              {
                if (f == 0)
                  {
                    cell->face(f)->get_dof_indices(of_face);
                    for (const auto i : of_face)
                      is_held[i] = true;
                    continue;
                  }
                face_values.reinit(cell, f);
                for (unsigned int a = 0; a < n; ++a)
                  for (unsigned int q = 0; q < of_faces.size(); ++q)
                    load(numbers[a]) += face_values.JxW(q) * face_values.shape_value(a, q) *
                                        traction(fe.system_to_component_index(a).first);
              }
        }
      Eigen::SparseMatrix<double> lower(dofs.n_dofs(), dofs.n_dofs());
      for (auto &entry : entries)
        if (is_held[entry.row()] || is_held[entry.col()])
          entry = {entry.row(), entry.col(), entry.row() == entry.col() ? 1. : 0.};
      lower.setFromTriplets(entries.begin(), entries.end());
      for (unsigned int i = 0; i < dofs.n_dofs(); ++i)
        if (is_held[i])
          load(i) = 0;
      u = Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower>(lower).solve(load);
    }

    Vector6
    stress_in_the_middle(const dealii::Point<2> &place) const
    {
      const double h = solid_length / along;
      for (const auto &cell : dofs.active_cell_iterators())
        if (std::abs(cell->center()[0] - solid_length / 2) < h / 4 &&
            cell->point_inside({solid_length / 2, place[0], place[1]}))
          {
            const dealii::Point<3> x(solid_length / 2, place[0], place[1]), low = cell->vertex(0),
                                                                            high = cell->vertex(7);
            dealii::Point<3> unit;
            for (unsigned int d = 0; d < 3; ++d)
              unit[d] = (x[d] - low[d]) / (high[d] - low[d]);
            dealii::FEValues<3> values(fe, dealii::Quadrature<3>(unit), dealii::update_gradients);
            values.reinit(typename dealii::Triangulation<3>::cell_iterator(cell));
            std::vector<dealii::types::global_dof_index> numbers(fe.n_dofs_per_cell());
            cell->get_dof_indices(numbers);
            Vector6 e = Vector6::Zero();
            for (unsigned int a = 0; a < numbers.size(); ++a)
              e += u(numbers[a]) * strains_of(fe.system_to_component_index(a).first, values.shape_grad(a, 0));
            return stiffness_at(cell->center()[2]) * e;
          }
      throw std::logic_error("no cell there");
    }

  private:
    dealii::Triangulation<3> grid;
    dealii::FESystem<3>      fe;
    dealii::DoFHandler<3>    dofs;
    Eigen::VectorXd          u;
  };
} // namespace



TEST(SolidBeam, RecoveredStressesAreThoseOfTheSolid)
{
  const SectionMesh  mesh(strip_patches(solid_width, two_plies, {across, across / 2}), solid_degree, 1e-6);
  const CrossSection section(mesh, {glass()});
  const Vector3      traction(3, 0.5, 1);
  const Solid        solid(traction);

  const double area = solid_width * solid_height, arm = solid_length / 2;
  Vector6      forces;
  forces << area * traction, arm * area * Vector3(1, 0, 0).cross(traction);
  double largest = 0, difference = 0, in_shear = 0;
  for (const auto &point : section.points())
    {
      const Vector6 own = CrossSection::stress(point, forces), wanted = solid.stress_in_the_middle(point.place);
      largest    = std::max(largest, wanted.cwiseAbs().maxCoeff());
      in_shear   = std::max(in_shear, wanted.tail<3>().cwiseAbs().maxCoeff());
      difference = std::max(difference, (own - wanted).cwiseAbs().maxCoeff());
    }
  EXPECT_LT(difference, 0.01 * largest);
  EXPECT_GT(in_shear, 0.1 * largest) << "plies of unlike angles shear";
}
