// The transverse shear stiffness of a laminate by its energy of second order.

#include <samara/section/laminate.h>

#include <samara/base/dense.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>

#include <stdexcept>

namespace samara
{
  namespace
  {
    using Six = Eigen::Matrix<double, Eigen::Dynamic, 6>;

    /** Integrals of the warping through the thickness; named as those of a section, for derivatives along 1 and 2. */
    struct ThroughThickness
    {
      Eigen::MatrixXd E, H, C[2], M[2][2];
      Six             R, L[2];
    };

    /** Voigt strains of the derivative of a displacement along axis @p d. */
    Eigen::Matrix<double, 6, 3>
    strains_of_derivative(const unsigned int d)
    {
      constexpr unsigned int      row[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
      Eigen::Matrix<double, 6, 3> S         = Eigen::Matrix<double, 6, 3>::Zero();
      for (unsigned int i = 0; i < 3; ++i)
        S(row[d][i], i) = 1;
      return S;
    }



    /** Of layers from the bottom to the top, each with its stiffness. */
    ThroughThickness
    integrals_of(const std::vector<std::pair<Matrix6, std::array<double, 2>>> &layers)
    {
      constexpr unsigned int  p = 4;
      const dealii::FE_Q<1>   fe(p);
      const dealii::QGauss<1> quadrature(p + 1);
      const auto              points = fe.get_unit_support_points();
      const unsigned int      n      = 3 * (p * layers.size() + 1);
      ThroughThickness        t;
      t.E = Eigen::MatrixXd::Zero(n, n);
      t.H = Eigen::MatrixXd::Zero(n, 3);
      t.R = Six::Zero(n, 6);
      for (unsigned int a = 0; a < 2; ++a)
        {
          t.C[a] = t.E;
          t.L[a] = t.R;
          for (unsigned int b = 0; b < 2; ++b)
            t.M[a][b] = t.E;
        }
      const Eigen::Matrix<double, 6, 3> S[3] = {strains_of_derivative(0),
                                                strains_of_derivative(1),
                                                strains_of_derivative(2)};
      for (unsigned int e = 0; e < layers.size(); ++e)
        {
          const auto &[Q, ends] = layers[e];
          const double    h     = ends[1] - ends[0];
          Eigen::MatrixXd B(6, 3 * (p + 1)), SN[2] = {B, B}, N(3, 3 * (p + 1));
          for (unsigned int q = 0; q < quadrature.size(); ++q)
            {
              const double x = quadrature.point(q)[0], w = quadrature.weight(q) * h, z = ends[0] + h * x;
              N.setZero();
              for (unsigned int i = 0; i <= p; ++i)
                {
                  // nodes in ascending order
                  const unsigned int at    = 3 * static_cast<unsigned int>(std::lround(
                                                std::count_if(points.begin(), points.end(), [&](const auto &other) {
                                                  return other[0] < points[i][0];
                                                })));
                  const double       value = fe.shape_value(i, quadrature.point(q));
                  B.middleCols(at, 3)      = fe.shape_grad(i, quadrature.point(q))[0] / h * S[2];
                  SN[0].middleCols(at, 3)  = value * S[0];
                  SN[1].middleCols(at, 3)  = value * S[1];
                  N.middleCols(at, 3)      = value * Matrix3::Identity();
                }
              Matrix6 G = Matrix6::Zero(); // strains of the plate's
              G(0, 0) = G(5, 1) = G(1, 2) = 1;
              G(0, 3) = G(5, 4) = G(1, 5) = z;
              const unsigned int first = 3 * p * e, m = 3 * (p + 1);
              t.E.block(first, first, m, m) += w * B.transpose() * Q * B;
              t.R.middleRows(first, m) += w * B.transpose() * Q * G;
              t.H.middleRows(first, m) += w * N.transpose();
              for (unsigned int a = 0; a < 2; ++a)
                {
                  t.C[a].block(first, first, m, m) += w * B.transpose() * Q * SN[a];
                  t.L[a].middleRows(first, m) += w * SN[a].transpose() * Q * G;
                  for (unsigned int b = 0; b < 2; ++b)
                    t.M[a][b].block(first, first, m, m) += w * SN[a].transpose() * Q * SN[b];
                }
            }
        }
      return t;
    }



    /** T₁₁, the symmetric part of T₁₂, T₂₂: the energy of second order of strains that change along 1 and 2. */
    std::array<Matrix6, 3>
    energy_of_second_order(const ThroughThickness &t)
    {
      const unsigned int n            = t.E.rows();
      Eigen::MatrixXd    bordered     = Eigen::MatrixXd::Zero(n + 3, n + 3); // without a mean displacement
      bordered.topLeftCorner(n, n)    = t.E;
      bordered.topRightCorner(n, 3)   = t.H;
      bordered.bottomLeftCorner(3, n) = t.H.transpose();
      // the rows of displacements and those of means have other units
      const double scale = t.E.diagonal().maxCoeff() / t.H.cwiseAbs().maxCoeff();
      bordered.topRightCorner(n, 3) *= scale;
      bordered.bottomLeftCorner(3, n) *= scale;
      const Lu   factors(bordered);
      const auto solve = [&](const Six &right) {
        Eigen::MatrixXd b = Eigen::MatrixXd::Zero(n + 3, 6);
        b.topRows(n)      = right;
        return Six(factors.solve(b).topRows(n));
      };
      const Six V0 = -solve(t.R);
      Six       right[2], V[2];
      for (unsigned int a = 0; a < 2; ++a)
        {
          right[a] = (t.C[a].transpose() - t.C[a]) * V0 + t.L[a];
          V[a]     = solve(right[a]);
        }
      const auto T = [&](const unsigned int a, const unsigned int b) {
        return Matrix6(V0.transpose() * t.M[a][b] * V0 - V[a].transpose() * right[b]);
      };
      const Matrix6 mixed = 0.5 * (T(0, 1) + T(1, 0).transpose());
      return {{T(0, 0), Matrix6(0.5 * (mixed + mixed.transpose())), T(1, 1)}};
    }
  } // namespace



  void
  Laminate::find_asymptotic_shear()
  {
    std::vector<std::pair<Matrix6, std::array<double, 2>>> given;
    for (const Layer &layer : layers)
      given.push_back({layer.stiffness, {{layer.bottom, layer.top}}});
    const auto T = energy_of_second_order(integrals_of(given));

    // T_ab + ABD D_a F D_bᵀ ABD − (ABD B_a L_b + transposed) as small as possible in F = G⁻¹ and L₁, L₂
    Eigen::Matrix<double, 6, 2> D[2], B[2];
    for (unsigned int a = 0; a < 2; ++a)
      {
        D[a].setZero();
        B[a].setZero();
        for (unsigned int i = 0; i < 2; ++i)
          {
            D[a](3 + a + i, i) = 1;
            B[a](a + i, i)     = 1;
          }
        D[a] = (ABD * D[a]).eval();
        B[a] = (ABD * B[a]).eval();
      }
    const Vector6   scale    = ABD.diagonal().cwiseSqrt().cwiseInverse();
    constexpr int   first[3] = {0, 0, 1}, second[3] = {0, 1, 1};
    Eigen::MatrixXd A(3 * 36, 27);
    Eigen::VectorXd right(3 * 36);
    const auto      row = [&](const int block, const Matrix6 &X) {
      const Matrix6 both   = block == 1 ? Matrix6(std::sqrt(0.5) * (X + X.transpose())) : X;
      const Matrix6 scaled = scale.asDiagonal() * both * scale.asDiagonal();
      return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(scaled.data(), 36));
    };
    for (int block = 0; block < 3; ++block)
      {
        const int a = first[block], b = second[block];
        right.segment(36 * block, 36) = -row(block, T[block]);
        for (int k = 0; k < 3; ++k)
          {
            Eigen::Matrix2d F = Eigen::Matrix2d::Zero();
            F(k == 2, k > 0) = F(k > 0, k == 2) = 1;
            A.block(36 * block, k, 36, 1)       = row(block, D[a] * F * D[b].transpose());
          }
        for (int k = 0; k < 24; ++k)
          {
            Eigen::Matrix<double, 2, 6> L[2];
            L[0].setZero();
            L[1].setZero();
            L[k / 12](k / 6 % 2, k % 6)       = 1;
            A.block(36 * block, 3 + k, 36, 1) = -row(block, B[a] * L[b] + Matrix6(B[b] * L[a]).transpose());
          }
      }
    // shear flexibilities are many powers of ten from the others: columns of one length
    const Eigen::VectorXd lengths = A.colwise().norm().cwiseMax(1e-300);
    A                             = A * lengths.cwiseInverse().asDiagonal();
    const Eigen::VectorXd x = MinimumNorm(A, 1e-11).solve(right).cwiseQuotient(lengths);
    Eigen::Matrix2d       F;
    F << x(0), x(1), x(1), x(2);
    if (!(F(0, 0) > 0 && F.determinant() > 0))
      throw std::invalid_argument(
        "the asymptotic rule finds no positive stiffness in transverse shear: use the rule of equilibrium");
    shear = F.inverse();
  }
} // namespace samara
