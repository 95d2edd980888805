#ifndef samara_cosserat_kernel_h
#define samara_cosserat_kernel_h

#include <samara/rotation/rotation.h>

#include <vector>

namespace samara
{
  /**
   * The algebra of a Cosserat continuum at one point, along one parameter direction: what beams and shells share.
   *
   * With positions x and directors d_k interpolated componentwise, ( )' the derivative in that direction:
   *
   *     Γ = dᵀ x'         K = axial(dᵀ d'),  i.e. K_k = ½ (d_j · d_i' − d_i · d_j') for (k, i, j) cyclic
   *
   * Both are quadratic in the nodal x_a, D_a. Virtual displacements and increments are twists (u, θ) in the nodes' own
   * frames: δx_a = D_a u, δD_a = D_a θ~. With P = D_aᵀ d, P' = D_aᵀ d', w = D_aᵀ x', V = N P' − N' P, the six columns
   * of node a are
   *
   *     B_a = [ N' Pᵀ   N w~             ]
   *           [ 0       ½ (V − tr(V) I)  ]
   *
   * (doc/theory/element.md.)
   */
  namespace kernel
  {
    template <typename Number>
    struct NodeValues
    {
      Vec3<Number> x;
      Mat3<Number> D;
    };

    template <typename Number>
    struct PointValues
    {
      Vec3<Number> dx; ///< x'
      Mat3<Number> d, dd; ///< directors and their derivatives, as columns
    };



    template <typename Number>
    PointValues<Number>
    interpolate(const std::vector<NodeValues<Number>> &nodes, const double *N, const double *dN)
    {
      // x and the directors side by side, as the compiler likes it
      static_assert(sizeof(NodeValues<Number>) == 12 * sizeof(Number), "no gaps");
      Number value[12] = {}, derivative[12] = {};
      for (unsigned int a = 0; a < nodes.size(); ++a)
        {
          const Number *const node = nodes[a].x.data();
          const double        N_a = N[a], dN_a = dN[a];
          for (unsigned int i = 0; i < 12; ++i)
            {
              value[i] += N_a * node[i];
              derivative[i] += dN_a * node[i];
            }
        }
      PointValues<Number> p;
      p.dx = Eigen::Map<const Vec3<Number>>(derivative);
      p.d  = Eigen::Map<const Mat3<Number>>(value + 3);
      p.dd = Eigen::Map<const Mat3<Number>>(derivative + 3);
      return p;
    }



    /** (Γ, K) */
    template <typename Number>
    Vec6<Number>
    strain(const PointValues<Number> &p)
    {
      Vec6<Number> e;
      e << p.d.transpose() * p.dx, axial_of_product(p.d, p.dd);
      return e;
    }



    /** How (Γ, K) changes when positions and directors change by @p v (x' by v.dx, ...). */
    template <typename Number>
    Vec6<Number>
    strain_rate(const PointValues<Number> &p, const PointValues<Number> &v)
    {
      Vec6<Number> e;
      e << v.d.transpose() * p.dx + p.d.transpose() * v.dx, axial_of_product(v.d, p.dd) + axial_of_product(p.d, v.dd);
      return e;
    }



    /** Forces conjugate to x', d and d' from section forces s = (n, m). */
    template <typename Number>
    PointValues<Number>
    force(const PointValues<Number> &p, const Vec6<Number> &s)
    {
      const Vec3<Number> n = s.template head<3>(), m = s.template tail<3>();
      const Mat3<Number> m_skew = Number(0.5) * skew(m);
      return {p.d * n, p.dx * n.transpose() - p.dd * m_skew, p.d * m_skew};
    }



    /** B_a, see above; @p scale multiplies all of it. */
    template <typename Block>
    void
    strain_matrix(const PointValues<double> &p, const Matrix3 &D, const double N, const double dN, Block &&B)
    {
      const Matrix3 P       = transpose_times(D, p.d), P_prime = transpose_times(D, p.dd);
      const Vector3 w       = N * (D.transpose() * p.dx);
      const double  half_tr = 0.5 * (N * P_prime.trace() - dN * P.trace());
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          {
            B(i, j)         = dN * P(j, i);
            B(i + 3, j)     = 0;
            B(i + 3, j + 3) = 0.5 * (N * P_prime(i, j) - dN * P(i, j)) - (i == j ? half_tr : 0.);
          }
      B.template topRightCorner<3, 3>() = skew(w);
    }



    /**
     * Geometric stiffness of a pair of nodes (a, b) without the part of a alone: derivative of the forces on a with
     * respect to the twist of b at fixed section forces, summed over the points of the element,
     * @p n_ab = Σ N'_a N_b n, @p n_ba = Σ N_a N'_b n and @p m_ab = Σ (N_a N'_b − N'_a N_b) m.
     */
    template <typename Block>
    void
    add_geometric_pair(const Matrix3 &R_ab, const Vector3 &n_ab, const Vector3 &n_ba, const Vector3 &m_ab, Block &&K)
    {
      const Vector3 a = axial(R_ab), r = 0.5 * (R_ab.transpose() * m_ab);
      for (int i = 0; i < 3; ++i)
        {
          // a row of −R n~ is n × that row of R; a column of n~ R is n × that column of R
          const Vector3 row = cross(n_ab, R_ab.row(i).transpose()), column = cross(n_ba, R_ab.col(i));
          for (int j = 0; j < 3; ++j)
            {
              K(i, j + 3) += row(j);
              K(j + 3, i) += column(j);
              K(i + 3, j + 3) += m_ab(i) * a(j);
            }
        }
      K(3, 4) -= r(2);
      K(4, 3) += r(2);
      K(3, 5) += r(1);
      K(5, 3) -= r(1);
      K(4, 5) -= r(0);
      K(5, 4) += r(0);
    }



    /**
     * The part of one node: its forces turn with it. @p F is the total director force D_aᵀ F_a (columns: the forces on
     * d₁ d₂ d₃) and @p f the force on x, both in the node's frame.
     */
    inline Matrix6
    geometric_node(const Vector3 &f, const Matrix3 &F)
    {
      // torque 2 axial(Dᵀ F); δ(Dᵀ F) = −θ~ Dᵀ F at fixed F, and 2 axial(θ~ F) = (tr(F) I − F) θ
      Matrix6 K                   = Matrix6::Zero();
      K.topRightCorner<3, 3>()    = skew(f);
      K.bottomRightCorner<3, 3>() = F - F.trace() * Matrix3::Identity();
      return K;
    }
  } // namespace kernel
} // namespace samara

#endif
