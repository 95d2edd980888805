// Where stresses of the layers of a shell are largest, how well they are known there, and where shear warps a laminate.

#include <samara/base/text.h>
#include <samara/cosserat/shell.h>

#include <deal.II/base/polynomial.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  void
  Shell::make_samples()
  {
    const unsigned int n_points = table->n_points;
    to_samples.resize(table->n_nodes + n_points, n_points);
    to_samples << to_nodes, Eigen::MatrixXd::Identity(n_points, n_points);
    std::vector<dealii::Point<2>> places = table->nodes;
    places.insert(places.end(), table->points.begin(), table->points.end());
    // in the least squares, by products of n orthonormal polynomials in both directions
    const auto products = [](const std::vector<dealii::Point<2>> &at, const unsigned int n_along) {
      Eigen::MatrixXd result(at.size(), n_along * n_along);
      for (unsigned int j = 0; j < n_along; ++j)
        for (unsigned int i = 0; i < n_along; ++i)
          for (unsigned int k = 0; k < at.size(); ++k)
            result(k, i + n_along * j) =
              dealii::Polynomials::Legendre(i).value(at[k][0]) * dealii::Polynomials::Legendre(j).value(at[k][1]);
      return result;
    };
    // curvatures along a direction are of degree p − 1: without the last term of that, and the last two
    for (unsigned int left_out = 0; left_out < 2; ++left_out)
      {
        const unsigned int n_along = degree > 1 + left_out ? degree - 1 - left_out : 0;
        to_samples_of_less[left_out] =
          products(places, n_along) * (products(table->points, n_along).transpose() * table->weights.asDiagonal());
      }
  }



  double
  Shell::next_term(const double here, const double with_less, const double with_least)
  {
    // of the series by degree, if it goes on as the last two terms do
    const double first = std::abs(with_less), last = std::abs(std::abs(here) - first),
                 before = std::abs(first - std::abs(with_least));
    return last < before ? last * last / before : last;
  }



  Shell::Peak
  Shell::peak_over_surface(const ExtremeByName &quantity, const int layer, const State &state) const
  {
    Peak result{0, 0};
    bool is_first = true;
    for (unsigned int i = 0; i < n_elements(); ++i)
      {
        const unsigned int    laminate  = laminate_of(i);
        const Eigen::MatrixXd at_points = recovered_at_points(i, state), there = at_points * to_samples.transpose();
        const auto            value = [&](const Recovered &at) {
          return quantity.of(layer_extremes(plate_state(at, laminate), layer));
        };
        for (unsigned int k = 0; k < there.cols(); ++k)
          if (const double here = value(there.col(k)); is_first || std::abs(here) > std::abs(result.value))
            {
              const auto with_less = [&](const unsigned int i) {
                return value(at_points * to_samples_of_less[i].row(k).transpose());
              };
              result   = {here, next_term(here, with_less(0), with_less(1))};
              is_first = false;
            }
      }
    return result;
  }



  std::vector<Doubt>
  Shell::doubts(const State &state) const
  {
    // a share of the bending below which a direction does not count, and an error from which on it is told
    constexpr double least_share = 0.1, told = 0.02;
    if (!are_stresses_asked && !shows_layers)
      return {};
    std::vector<Eigen::Array2d> bending(laminates.size(), Eigen::Array2d::Zero()), shear = bending;
    for (unsigned int i = 0; i < n_elements(); ++i)
      for (unsigned int g = 0; g < table->n_points; ++g)
        {
          const unsigned int index    = elements[i].first_point + g;
          Recovered          s        = Recovered::Zero();
          s.head<n>()                 = Eigen::Map<const VectorN>(&state.stress[first_strain + n * index]);
          const unsigned int    l     = laminate_of(i);
          const PlateState      at    = plate_state(s, l);
          const Vector3         kappa = at.strains.tail<3>(), M = laminates[l].free_bending() * kappa;
          const Eigen::Vector2d gamma  = laminates[l].shear.inverse() * at.shear;
          const double          weight = integration_points()[index].weight;
          bending[l] += weight * Eigen::Array2d(std::abs(M(0) * kappa(0)), std::abs(M(2) * kappa(2)));
          shear[l] += weight * (at.shear.array() * gamma.array()).abs();
        }
    double worst = 0, ratio = 0;
    for (unsigned int l = 0; l < laminates.size(); ++l)
      for (unsigned int alpha = 0; alpha < 2; ++alpha)
        if (bending[l](alpha) > least_share * bending[l].sum())
          {
            const double r = shear[l](alpha) / bending[l](alpha), added = laminates[l].warping(alpha) * r;
            // what is missing, of what is there
            if (const double error = added / (1 + added); error > worst)
              {
                worst = error;
                ratio = r;
              }
          }
    if (!(worst > told))
      return {};
    return {{"thickness",
             "shell <" + name + "> is thick for how it is bent: shear has " + number_to_text("%.2g", ratio) +
               " times the energy of bending, and warps the laminate. Stresses along the layers are up to some " +
               number_to_text("%.0f", 100 * worst) +
               " % too low at its faces; no theory of plates with one shear angle knows them better. Count on so much "
               "more, or take a model of solids there. Deflections are right"}};
  }
} // namespace samara
