#include <samara/joints/pair.h>

#include <deal.II/base/exceptions.h>

namespace samara
{
  namespace
  {
    /** The velocity of the frame's origin, inertial components, from the nodal twists. */
    Vector3
    velocity(const Frame &frame, const double *q, const double *y)
    {
      const double *const D = q + 12 * frame.node + 3, *const v = y + 6 * frame.node, *const w = v + 3;
      const Vector3 &r  = frame.arm;
      const double   v1 = v[0] + w[1] * r(2) - w[2] * r(1), v2 = v[1] + w[2] * r(0) - w[0] * r(2),
                   v3 = v[2] + w[0] * r(1) - w[1] * r(0);
      return {D[0] * v1 + D[3] * v2 + D[6] * v3, D[1] * v1 + D[4] * v2 + D[7] * v3, D[2] * v1 + D[5] * v2 + D[8] * v3};
    }



    /** The second derivative of its place at constant twists, D (w × u) with u its velocity in the node's axes. */
    Vector3
    centripetal(const Frame &frame, const double *q, const double *y)
    {
      const Eigen::Map<const Matrix3> D(q + 12 * frame.node + 3);
      const Eigen::Map<const Vector3> v(y + 6 * frame.node), w(y + 6 * frame.node + 3);
      return D * cross(w, Vector3(v + cross(w, frame.arm)));
    }



    /** Its angular velocity in its own axes. */
    Vector3
    spin(const Frame &frame, const double *y)
    {
      const double *const w = y + 6 * frame.node + 3;
      const Matrix3      &Q = frame.rotation;
      return {Q(0, 0) * w[0] + Q(1, 0) * w[1] + Q(2, 0) * w[2],
              Q(0, 1) * w[0] + Q(1, 1) * w[1] + Q(2, 1) * w[2],
              Q(0, 2) * w[0] + Q(1, 2) * w[1] + Q(2, 2) * w[2]};
    }



    /** Add H − tr(H) I: the derivative of a moment Σ e_i × h_i, h_i = Dᵀf_i the columns of H, with constant f_i. */
    template <typename Block>
    void
    add_turning(const Matrix3 &H, Block &&K)
    {
      K += H;
      K.diagonal().array() -= H.trace();
    }



    Matrix3
    triad_of_node(const Frame &frame, const double *q)
    {
      return Eigen::Map<const Matrix3>(q + 12 * frame.node + 3);
    }
  } // namespace



  PairRates::PairRates(const PairValues<double> &pair, const double *y)
    : gap(velocity(pair.b, pair.q, y) - velocity(pair.a, pair.q, y))
    , gaps(pair.in_axes_of_a(gap))
    , spin_a(spin(pair.a, y))
    , spin_b(spin(pair.b, y))
  {
    // (ω_A × e_i)·AᵀΔ
    gaps += cross(pair.gaps, spin_a);
  }



  PairSecondRates::PairSecondRates(const PairValues<double> &pair,
                                   const PairRates          &rates,
                                   const double             *y,
                                   const bool                with_axes_of_b)
    : gap(centripetal(pair.b, pair.q, y) - centripetal(pair.a, pair.q, y))
  {
    // A' = A ω~: (AᵀΔ)'' = ω × (ω × AᵀΔ) − 2 ω × AᵀΔ' + AᵀΔ''
    const Vector3 &w = rates.spin_a, &w_b = rates.spin_b;
    gaps = pair.in_axes_of_a(gap) + cross(w, Vector3(cross(w, pair.gaps) - 2 * pair.in_axes_of_a(rates.gap)));
    if (!with_axes_of_b)
      return;
    // C = AᵀB, C' = C ω_B~ − ω_A~ C, C'' the same of C'
    const auto turned = [&](const Matrix3 &C) {
      Matrix3 result;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          {
            const int i1 = next_axis(i), i2 = next_axis(i1), j1 = next_axis(j), j2 = next_axis(j1);
            result(i, j) = C(i, j1) * w_b(j2) - C(i, j2) * w_b(j1) - w(i1) * C(i2, j) + w(i2) * C(i1, j);
          }
      return result;
    };
    cosines = turned(turned(pair.cosines));
  }



  PairTangent::PairTangent(const PairValues<double> &pair)
    : pair(pair)
  {}



  void
  PairTangent::add(const PairFunction &function, const double factor)
  {
    AssertIndexRange(function.i, 3);
    AssertIndexRange(function.j, 3);
    forces.add(function, pair, factor);
    if (function.kind != PairFunction::cosine)
      return;
    // −e_i~ AᵀB e_j~
    const unsigned int i = function.i, j = function.j, i1 = next_axis(i), i2 = next_axis(i1), j1 = next_axis(j),
                       j2 = next_axis(j1);
    const Matrix3 &AB     = pair.cosines;
    has_cosines           = true;
    factors(i, j) += factor;
    turns(i1, j1) += factor * AB(i2, j2);
    turns(i1, j2) -= factor * AB(i2, j1);
    turns(i2, j1) -= factor * AB(i1, j2);
    turns(i2, j2) += factor * AB(i1, j1);
  }



  void
  PairTangent::add_to(Matrix12 &K) const
  {
    const Frame  &a = pair.a, &b = pair.b;
    const Vector3 f = forces.on_b(pair), f_a = -pair.in_a(f), f_b = pair.in_b(f);
    K.block<3, 3>(0, 3) += skew(f_a);
    K.block<3, 3>(6, 9) += skew(f_b);
    // nodes turn under constant forces: Σ e_i × h_i of the frames, h_i the columns of H
    Matrix3 H_a = pair.gaps * forces.gaps.transpose(), H_b = Matrix3::Zero();
    if (has_cosines)
      {
        const Matrix3 Q_b_transposed = b.rotation.transpose(), turned = a.rotation * turns * Q_b_transposed;
        K.block<3, 3>(3, 9) += turned;
        K.block<3, 3>(9, 3) += turned.transpose();
        H_a += pair.cosines * factors.transpose();
        H_b = b.rotation * transpose_times(pair.cosines, factors) * Q_b_transposed;
      }
    add_turning(a.rotation * H_a * a.rotation.transpose() + f_a * a.arm.transpose(), K.block<3, 3>(3, 3));
    add_turning(H_b + f_b * b.arm.transpose(), K.block<3, 3>(9, 9));
    add_gaps(K);
    if (forces.distance_2 != 0)
      add_distance(K);
  }



  void
  PairTangent::add_gaps(Matrix12 &K) const
  {
    // Σ factor δE_iᴬ·δΔ with D_Aᵀ δE_iᴬ = D_AᵀD_A (θ_A × p), δΔ = D_B (u_B − r_B~ θ_B) − D_A (u_A − r_A~ θ_A)
    const Frame  &a = pair.a, &b = pair.b;
    const Matrix3 D_a = triad_of_node(a, pair.q), D_b = triad_of_node(b, pair.q);
    const Vector3 p    = a.rotation * forces.gaps;
    const Matrix3 to_a = skew(p) * transpose_times(D_a, D_a), to_b = skew(p) * transpose_times(D_a, D_b),
                  arm_a = to_a * skew(a.arm), arm_b = to_b * skew(b.arm);
    K.block<3, 3>(3, 0) -= to_a;
    K.block<3, 3>(0, 3) -= to_a.transpose();
    K.block<3, 3>(3, 3) += arm_a + arm_a.transpose();
    K.block<3, 3>(3, 6) += to_b;
    K.block<3, 3>(6, 3) += to_b.transpose();
    K.block<3, 3>(3, 9) -= arm_b;
    K.block<3, 3>(9, 3) -= arm_b.transpose();
  }



  void
  PairTangent::add_distance(Matrix12 &K) const
  {
    // δΔ = G (u_A, θ_A, u_B, θ_B)
    const Matrix3                D_a = triad_of_node(pair.a, pair.q), D_b = triad_of_node(pair.b, pair.q);
    Eigen::Matrix<double, 3, 12> G;
    G << -D_a, D_a * skew(pair.a.arm), D_b, -D_b * skew(pair.b.arm);
    K += 2 * forces.distance_2 * G.transpose() * G;
  }



  void
  PairVelocity::add_derivative(const PairValues<double> &p, const double f, Matrix12 &K) const
  {
    const Matrix3 D_a = triad_of_node(p.a, p.q), D_b = triad_of_node(p.b, p.q), AB = transpose_times(D_a, D_b);
    if (kind == rolling)
      {
        const Vector3 k = cross(Vector3::Unit(2), Vector3::Unit(i));
        PairTangent   gap(p);
        gap.add({PairFunction::gap, i}, f);
        gap.add_to(K);
        K.block<3, 3>(9, 3) += f * radius * AB.transpose() * skew((p.a.rotation * k).eval());
        K.block<3, 3>(9, 9) -= f * radius * skew(p.in_b(p.A * k));
      }
    else
      {
        // c = D_Aᵀ E_iᴮ: δc = c~ θ_A + C θ_B; g = D_Aᵀ Δ: δg = g~ θ_A + G, G = D_AᵀD_B (u_B − r_B~ θ_B) − D_AᵀD_A
        // (u_A − r_A~ θ_A)
        const Matrix3 c = skew((p.a.rotation * p.cosines.col(i)).eval()), C = -AB * skew(p.b.rotation.col(i)),
                      g = skew(p.in_a(p.gap)), r_a = skew(p.a.arm), r_b = skew(p.b.arm), AA = transpose_times(D_a, D_a),
                      lever = g + r_a;
        K.block<3, 3>(0, 3) -= f * c;
        K.block<3, 3>(0, 9) -= f * C;
        K.block<3, 3>(3, 0) -= f * c * AA;
        K.block<3, 3>(3, 3) += f * (c * (g + AA * r_a) - lever * c);
        K.block<3, 3>(3, 6) += f * c * AB;
        K.block<3, 3>(3, 9) -= f * (c * AB * r_b + lever * C);
      }
  }
} // namespace samara
