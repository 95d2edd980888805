#ifndef samara_tests_straight_beam_h
#define samara_tests_straight_beam_h

#include <samara/solvers/mixed_matrix.h>

#include <deal.II/base/quadrature_lib.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <cmath>
#include <map>

namespace samara
{
  using Exact = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<40>, boost::multiprecision::et_off>;

  /**
   * A straight beam along x, clamped at x = 0, that turns steadily about z with the tension ½ μW²(L² − x²): flap
   * motions (w, θ) of elements of degree p, Lobatto nodes with lumped masses, p Gauss points with the strains w' + θ
   * and θ'. Everything is written by hand here: assembled for the code to be tested, and solved again in 40 digits.
   */
  struct StraightBeam
  {
    unsigned int        n_elements, degree;
    double              L = 1, EI = 1, GA, mass = 1, W = 0;
    unsigned int        n; ///< unknowns
    std::vector<double> x, node_mass;

    struct Row
    {
      std::vector<std::pair<unsigned int, double>> entries;
      double                                       stiffness;
    };
    std::vector<Row>                                        rows;
    std::map<std::pair<unsigned int, unsigned int>, double> S;

    StraightBeam(const unsigned int n_elements,
                 const unsigned int degree,
                 const double       ratio,
                 const double       W = 0,
                 const double       L = 1)
      : n_elements(n_elements)
      , degree(degree)
      , L(L)
      , GA(ratio / (L * L))
      , W(W / (L * L))
      , n(2 * n_elements * degree)
    {
      const dealii::QGaussLobatto<1> lobatto(degree + 1);
      const dealii::QGauss<1>        gauss(degree);
      const double                   h = L / n_elements;
      x.assign(n_elements * degree + 1, 0.);
      node_mass = x;
      for (unsigned int e = 0; e < n_elements; ++e)
        {
          for (unsigned int a = 0; a <= degree; ++a)
            {
              x[e * degree + a] = h * (e + lobatto.point(a)(0));
              node_mass[e * degree + a] += mass * h * lobatto.weight(a);
            }
          for (unsigned int g = 0; g < degree; ++g)
            add_point(e, lobatto.get_points(), gauss.point(g)(0), h * gauss.weight(g), h);
        }
    }

    /** w and θ of the nodes but the first. */
    void
    add_point(const unsigned int                   e,
              const std::vector<dealii::Point<1>> &nodes,
              const double                         s,
              const double                         weight,
              const double                         h)
    {
      Row          shear{{}, GA * weight}, bending{{}, EI * weight};
      const double at = h * (e + s), T = 0.5 * mass * W * W * (L * L - at * at) * weight;
      for (unsigned int a = 0; a < nodes.size(); ++a)
        {
          double N = 1, dN = 0;
          for (unsigned int b = 0; b < nodes.size(); ++b)
            if (b != a)
              {
                double product = 1 / (nodes[a](0) - nodes[b](0));
                N *= (s - nodes[b](0)) * product;
                for (unsigned int c = 0; c < nodes.size(); ++c)
                  if (c != a && c != b)
                    product *= (s - nodes[c](0)) / (nodes[a](0) - nodes[c](0));
                dN += product;
              }
          dN /= h;
          const unsigned int node = e * degree + a;
          if (node == 0)
            continue;
          shear.entries.push_back({2 * node - 2, dN});
          shear.entries.push_back({2 * node - 1, N});
          bending.entries.push_back({2 * node - 1, dN});
        }
      // tension on w' θ, and on θ²: the energy of a section force that turns with the section
      for (const auto &[i, a] : shear.entries)
        for (const auto &[j, b] : shear.entries)
          if (i % 2 == 0 && j % 2 == 1)
            {
              S[{i, j}] -= T * a * b;
              S[{j, i}] -= T * a * b;
            }
          else if (i % 2 == 1 && j == i)
            S[{i, i}] -= T * a;
      rows.push_back(shear);
      rows.push_back(bending);
    }

    LinearMotion
    motion() const
    {
      auto pattern = std::make_shared<Pattern>();
      pattern->column_start.push_back(0);
      std::map<std::pair<unsigned int, unsigned int>, double> by_column;
      for (unsigned int i = 0; i < n; ++i)
        by_column[{i, i}] = 0;
      for (const auto &[place, value] : S)
        by_column[{place.second, place.first}] += value;
      std::vector<double> values;
      for (unsigned int j = 0; j < n; ++j)
        {
          for (auto it = by_column.lower_bound({j, 0}); it != by_column.end() && it->first.first == j; ++it)
            {
              pattern->rows.push_back(it->first.second);
              values.push_back(it->second);
            }
          pattern->column_start.push_back(pattern->rows.size());
        }
      SparseMatrix M(pattern), G(pattern), K(pattern);
      std::copy(values.begin(), values.end(), K.values.begin());
      StrainRows strains(n);
      for (unsigned int i = 0; i < rows.size(); ++i)
        {
          if (i % 2 == 0)
            strains.add_point(i,
                              1.,
                              Eigen::Matrix2d(Eigen::Vector2d(rows[i].stiffness, rows[i + 1].stiffness).asDiagonal()),
                              Eigen::Matrix2d(Eigen::Matrix2d::Zero()));
          strains.begin_row();
          for (const auto &[column, value] : rows[i].entries)
            strains.add_entry(column, value);
        }
      std::vector<double> units(n, 1.);
      for (unsigned int i = 0; i < n; i += 2)
        {
          M.values[pattern->position(i, i)] = node_mass[i / 2 + 1];
          units[i]                          = L;
        }
      return {M, G, K, strains, {}, n, units};
    }

    /** The frequency near @p guess of the same numbers, in 40 digits: inverse iteration with the banded LDLᵀ. */
    Exact
    exact_frequency(const Exact &guess) const
    {
      const unsigned int              band = 2 * degree + 1;
      std::vector<std::vector<Exact>> K(n, std::vector<Exact>(band + 1, Exact(0)));
      for (const auto &row : rows)
        for (const auto &[i, a] : row.entries)
          for (const auto &[j, b] : row.entries)
            if (i >= j)
              K[i][i - j] += Exact(row.stiffness) * Exact(a) * Exact(b);
      for (const auto &[place, value] : S)
        if (place.first >= place.second)
          K[place.first][place.first - place.second] += Exact(value);
      Exact              square = guess * guess * (1 - Exact(1e-3));
      std::vector<Exact> z(n);
      for (unsigned int i = 0; i < n; ++i)
        z[i] = std::sin(1. + i);
      for (unsigned int round = 0; round < 4; ++round)
        {
          auto F = K;
          for (unsigned int i = 0; i < n; i += 2)
            F[i][0] -= square * Exact(node_mass[i / 2 + 1]);
          for (unsigned int i = 0; i < n; ++i)
            {
              for (unsigned int d = std::min(band, i); d > 0; --d)
                {
                  const unsigned int j = i - d;
                  for (unsigned int k = std::max({int(i) - int(band), int(j) - int(band), 0}); k < j; ++k)
                    F[i][d] -= F[i][i - k] * F[j][j - k] * F[k][0];
                  F[i][d] /= F[j][0];
                }
              for (unsigned int k = std::max(int(i) - int(band), 0); k < i; ++k)
                F[i][0] -= F[i][i - k] * F[i][i - k] * F[k][0];
            }
          Exact shift;
          for (unsigned int step = 0; step < (round == 0 ? 6 : 2); ++step)
            {
              std::vector<Exact> y(n, Exact(0));
              for (unsigned int i = 0; i < n; i += 2)
                y[i] = Exact(node_mass[i / 2 + 1]) * z[i];
              std::vector<Exact> v = y;
              for (unsigned int i = 0; i < n; ++i)
                for (unsigned int d = 1; d <= std::min(band, i); ++d)
                  v[i] -= F[i][d] * v[i - d];
              for (unsigned int i = 0; i < n; ++i)
                v[i] /= F[i][0];
              for (unsigned int i = n; i-- > 0;)
                for (unsigned int d = 1; d <= std::min(band, n - 1 - i); ++d)
                  v[i] -= F[i + d][d] * v[i + d];
              Exact vy = 0, vMv = 0, top = 0;
              for (unsigned int i = 0; i < n; ++i)
                {
                  vy += v[i] * y[i];
                  vMv += (i % 2 == 0 ? Exact(node_mass[i / 2 + 1]) : Exact(0)) * v[i] * v[i];
                  top = std::max(top, Exact(abs(v[i])));
                }
              shift = vy / vMv;
              for (unsigned int i = 0; i < n; ++i)
                z[i] = v[i] / top;
            }
          square += shift;
        }
      return sqrt(square);
    }
  };
} // namespace samara

#endif
