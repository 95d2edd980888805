// What automatic_mesh.h asks of shells: their mesh, and how two solutions of them differ.

#include <samara/base/composite_rule.h>
#include <samara/base/dense.h>
#include <samara/cosserat/shell.h>

#include <deal.II/base/polynomial.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  double
  Shell::wanted_error() const
  {
    return rigid || !mesh_entries.empty() ? 0. : elements_entry.error;
  }



  std::vector<PatchMesh>
  Shell::patch_meshes() const
  {
    std::vector<PatchMesh> result;
    for (const auto &patch : mesh->patch_cells)
      result.push_back(patch.mesh);
    return result;
  }



  Shell::Refined
  Shell::refined(const std::vector<CellError> &errors, const double part) const
  {
    if (mesh->patch_cells.empty())
      return {{}, refinements + 1};
    const auto          strips = mesh->strips();
    std::vector<double> sums, counts;
    for (unsigned int i = 0; i < strips.size(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
        {
          const unsigned int strip = strips[i][d];
          sums.resize(std::max<std::size_t>(sums.size(), strip + 1), 0.);
          counts.resize(sums.size(), 0.);
          sums[strip] += errors[i].across[d];
          counts[strip] += 1; // a cut costs as many cells
        }
    double largest = 0;
    for (unsigned int k = 0; k < sums.size(); ++k)
      largest = std::max(largest, sums[k] / counts[k]);
    std::vector<bool> cut;
    for (unsigned int k = 0; k < sums.size(); ++k)
      cut.push_back(sums[k] / counts[k] >= part * largest);
    return {mesh->refined(cut), refinements};
  }



  Eigen::VectorXd
  Shell::energy_samples(const double *e, const Shell &finer) const
  {
    const auto line = [](const ElementTable<2> &t) {
      std::vector<double> x;
      for (unsigned int g = 0; g <= t.degree; ++g)
        x.push_back(t.points[g][0]);
      return x;
    };
    const std::vector<double>                own = line(*table);
    std::vector<Eigen::Matrix<double, n, n>> roots; // of the stiffness
    for (const auto &material : finer.materials)
      roots.push_back(Cholesky(material.stiffness).upper());
    const auto     &points = finer.integration_points();
    Eigen::VectorXd result(n * points.size());
    for (unsigned int i = 0; i < finer.n_elements(); ++i)
      for (unsigned int g = 0; g < finer.table->n_points; ++g)
        {
          const unsigned int index = finer.elements[i].first_point + g;
          const auto        &unit  = finer.table->points[g];
          const auto         at    = finer.mesh->same_place({i, {unit[0], unit[1]}}, *mesh);
          VectorN            there = VectorN::Zero();
          for (unsigned int b = 0; b < own.size(); ++b)
            for (unsigned int a = 0; a < own.size(); ++a)
              there += lagrange(own, a, at.xi[0]) * lagrange(own, b, at.xi[1]) *
                       Eigen::Map<const VectorN>(e + n * (elements[at.cell].first_point + a + b * own.size()));
          result.segment<n>(n * index) = std::sqrt(points[index].weight) * (roots[points[index].material] * there);
        }
    return result;
  }



  std::vector<Shell::CellError>
  Shell::errors_of_cells(const Eigen::VectorXd &difference) const
  {
    const unsigned int m = table->degree + 1;
    // of orthonormal polynomials on (0, 1), at Gauss points with the roots of their weights: an orthogonal matrix
    Eigen::MatrixXd L(m, m);
    for (unsigned int k = 0; k < m; ++k)
      for (unsigned int g = 0; g < m; ++g)
        {
          double weight = 0; // along a line, from those of the square
          for (unsigned int other = 0; other < m; ++other)
            weight += table->weights(g + m * other);
          L(k, g) = std::sqrt(weight) * dealii::Polynomials::Legendre(k).value(table->points[g][0]);
        }
    std::vector<CellError> result(n_elements());
    for (unsigned int i = 0; i < n_elements(); ++i)
      {
        double both = 0, along[2] = {0, 0};
        for (unsigned int k = 0; k < n; ++k)
          {
            Eigen::MatrixXd values(m, m);
            for (unsigned int g = 0; g < m * m; ++g)
              values(g % m, g / m) = difference(n * (elements[i].first_point + g) + k);
            const Eigen::MatrixXd a = L * values * L.transpose();
            both += a.squaredNorm();
            // what the polynomials of one degree less lack along each coordinate
            along[0] += a.bottomRows(m > 2 ? 2 : 1).squaredNorm();
            along[1] += a.rightCols(m > 2 ? 2 : 1).squaredNorm();
          }
        const double sum = along[0] + along[1];
        result[i].error  = both;
        for (unsigned int d = 0; d < 2; ++d)
          result[i].across[d] = sum > 0 ? both * along[d] / sum : 0.5 * both;
      }
    return result;
  }
} // namespace samara
