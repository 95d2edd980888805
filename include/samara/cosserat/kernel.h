#ifndef samara_cosserat_kernel_h
#define samara_cosserat_kernel_h

#include <samara/base/lanes.h>
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
      Vec3<Number> dx;    ///< x'
      Mat3<Number> d, dd; ///< directors and their derivatives, as columns
    };



    /** Values at a point from those of @p n_nodes nodes; @p N is that number if it is known when compiling, else 0. */
    template <int N = 0, typename Number>
    PointValues<Number>
    interpolate(const NodeValues<Number> *nodes, const unsigned int n_nodes, const double *shape, const double *slope)
    {
      const unsigned int  n = N > 0 ? N : n_nodes;
      PointValues<Number> p;
      for (unsigned int i = 0; i < 3; ++i)
        {
          p.dx(i) = slope[0] * nodes[0].x(i);
          for (unsigned int a = 1; a < n; ++a)
            p.dx(i) += slope[a] * nodes[a].x(i);
        }
      for (unsigned int i = 0; i < 9; ++i)
        {
          Number d = shape[0] * nodes[0].D.data()[i], dd = slope[0] * nodes[0].D.data()[i];
          for (unsigned int a = 1; a < n; ++a)
            {
              d += shape[a] * nodes[a].D.data()[i];
              dd += slope[a] * nodes[a].D.data()[i];
            }
          p.d.data()[i]  = d;
          p.dd.data()[i] = dd;
        }
      return p;
    }



    /** Velocities of a node's position and directors from its twist (v, Ω): D v and D Ω~. */
    template <typename Number>
    NodeValues<Number>
    node_rates(const Mat3<Number> &D, const Vec6<Number> &y)
    {
      NodeValues<Number> rates;
      for (int i = 0; i < 3; ++i)
        {
          rates.x(i)    = D(i, 0) * y(0) + D(i, 1) * y(1) + D(i, 2) * y(2);
          rates.D(i, 0) = D(i, 1) * y(5) - D(i, 2) * y(4);
          rates.D(i, 1) = D(i, 2) * y(3) - D(i, 0) * y(5);
          rates.D(i, 2) = D(i, 0) * y(4) - D(i, 1) * y(3);
        }
      return rates;
    }



    /**
     * Force and moment on a node in its own frame, (Dᵀ f, 2 axial(Dᵀ F)), from forces conjugate to x and directors; with
     * the reciprocal directors for D where triads are not orthonormal.
     */
    template <typename Number>
    Vec6<Number>
    node_forces(const Mat3<Number> &D, const NodeValues<Number> &forces_on)
    {
      const Vec3<Number> &f       = forces_on.x;
      const Mat3<Number> &F       = forces_on.D;
      const auto          product = [&](const int i, const int j) {
        return D(0, i) * F(0, j) + D(1, i) * F(1, j) + D(2, i) * F(2, j);
      };
      Vec6<Number> forces;
      for (int i = 0; i < 3; ++i)
        forces(i) = D(0, i) * f(0) + D(1, i) * f(1) + D(2, i) * f(2);
      forces(3) = product(2, 1) - product(1, 2);
      forces(4) = product(0, 2) - product(2, 0);
      forces(5) = product(1, 0) - product(0, 1);
      return forces;
    }



    /** (Γ, K) */
    template <typename Number>
    Vec6<Number>
    strain(const PointValues<Number> &p)
    {
      const auto product = [](const Mat3<Number> &A, const int i, const auto &b) -> Number {
        return A(0, i) * b(0) + A(1, i) * b(1) + A(2, i) * b(2);
      };
      Vec6<Number> e;
      for (int i = 0; i < 3; ++i)
        e(i) = product(p.d, i, p.dx);
      e(3) = Number(0.5) * (product(p.d, 2, p.dd.col(1)) - product(p.d, 1, p.dd.col(2)));
      e(4) = Number(0.5) * (product(p.d, 0, p.dd.col(2)) - product(p.d, 2, p.dd.col(0)));
      e(5) = Number(0.5) * (product(p.d, 1, p.dd.col(0)) - product(p.d, 0, p.dd.col(1)));
      return e;
    }



    /** How (Γ, K) changes when positions and directors change by @p v (x' by v.dx, ...). */
    template <typename Number>
    Vec6<Number>
    strain_rate(const PointValues<Number> &p, const PointValues<Number> &v)
    {
      const auto product = [](const Mat3<Number> &A, const int i, const auto &b) -> Number {
        return A(0, i) * b(0) + A(1, i) * b(1) + A(2, i) * b(2);
      };
      const auto rate = [&](const int i, const int j) {
        return product(v.d, i, p.dd.col(j)) + product(p.d, i, v.dd.col(j));
      };
      Vec6<Number> e;
      for (int i = 0; i < 3; ++i)
        e(i) = product(v.d, i, p.dx) + product(p.d, i, v.dx);
      e(3) = Number(0.5) * (rate(2, 1) - rate(1, 2));
      e(4) = Number(0.5) * (rate(0, 2) - rate(2, 0));
      e(5) = Number(0.5) * (rate(1, 0) - rate(0, 1));
      return e;
    }



    /** Forces conjugate to x', d and d' from section forces s = (n, m). */
    template <typename Number>
    PointValues<Number>
    force(const PointValues<Number> &p, const Vec6<Number> &s)
    {
      const Vec3<Number> n = s.template head<3>(), m = Number(0.5) * s.template tail<3>();
      // a row of A m~ is that row of A crossed with m
      PointValues<Number> f;
      for (int i = 0; i < 3; ++i)
        {
          f.dx(i)    = p.d(i, 0) * n(0) + p.d(i, 1) * n(1) + p.d(i, 2) * n(2);
          f.d(i, 0)  = p.dx(i) * n(0) - (p.dd(i, 1) * m(2) - p.dd(i, 2) * m(1));
          f.d(i, 1)  = p.dx(i) * n(1) - (p.dd(i, 2) * m(0) - p.dd(i, 0) * m(2));
          f.d(i, 2)  = p.dx(i) * n(2) - (p.dd(i, 0) * m(1) - p.dd(i, 1) * m(0));
          f.dd(i, 0) = p.d(i, 1) * m(2) - p.d(i, 2) * m(1);
          f.dd(i, 1) = p.d(i, 2) * m(0) - p.d(i, 0) * m(2);
          f.dd(i, 2) = p.d(i, 0) * m(1) - p.d(i, 1) * m(0);
        }
      return f;
    }



    /** What a point's @p force is at a node with these values of its shape function, added. */
    template <typename Number>
    void
    add_to_node(const PointValues<Number> &force, const double shape, const double slope, NodeValues<Number> &node)
    {
      for (int i = 0; i < 3; ++i)
        node.x(i) += slope * force.dx(i);
      for (int i = 0; i < 9; ++i)
        node.D.data()[i] += shape * force.d.data()[i] + slope * force.dd.data()[i];
    }



    /** B_a, see above; @p scale multiplies all of it. */
    template <typename Block>
    void
    strain_matrix(const PointValues<double> &p, const Matrix3 &D, const double N, const double dN, Block &&B)
    {
      const Matrix3 P = transpose_times(D, p.d), P_prime = transpose_times(D, p.dd);
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
