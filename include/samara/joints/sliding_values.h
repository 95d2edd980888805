#ifndef samara_joints_sliding_values_h
#define samara_joints_sliding_values_h

// What the rows of sliding joints are made of: products of the axes of B and the directors of the rail.

#include <samara/joints/moment_of.h>
#include <samara/joints/sliding.h>

namespace samara
{
  /** The change of moment_of(H) by a turn θ under forces that stand still: H − tr(H) I. */
  inline Matrix3
  change_of_moment(const Matrix3 &H)
  {
    return H - H.trace() * Matrix3::Identity();
  }

  template <typename Number>
  Number
  product(const Mat3<Number> &a, const Mat3<Number> &b)
  {
    return a.cwiseProduct(b).sum();
  }

  /** The rail and the frame of B at a configuration. */
  template <typename Number>
  struct SlidingValues
  {
    Rail::AllWeights<Number> weights;
    RailPlace<Number>        at;
    Vec3<Number>             x_b;
    Mat3<Number>             E;
    const Number            *q_of_forces; ///< see Point::q_of_forces()
    Mat3<Number>             E_of_forces;

    SlidingValues(const Rail &rail, const Frame &b, const Number &S, const Point<Number> &point)
      : weights(rail.weights(S))
      , at(rail.place(weights, point.q))
      , x_b(b.position(point.q))
      , E(b.triad(point.q))
      , q_of_forces(point.q_of_forces())
      , E_of_forces(b.triad(q_of_forces))
    {}

    /** Σ of E_i·d_k, of the derivative @p n of d by S. */
    Mat3<Number>
    cosines(const unsigned int n) const
    {
      return E.transpose() * at.d[n];
    }
  };

  /** Multipliers as a force on B and the factors of E_i·d_k, with their derivatives by S. */
  template <typename Number>
  struct SlidingForces
  {
    Vec3<Number>                force = Vec3<Number>::Zero();
    std::array<Mat3<Number>, 3> A     = {{Mat3<Number>::Zero(), Mat3<Number>::Zero(), Mat3<Number>::Zero()}};

    /** Add the gradient by the twists of the frames of one part of the rail. */
    template <typename Vector>
    void
    add_to_rail(const SlidingValues<Number> &values,
                const Rail::Weights<Number> &part,
                const std::vector<Frame>    &frames,
                Vector                     &&r) const
    {
      const Mat3<Number> EA = values.E * A[0];
      for (unsigned int a = 0; a < frames.size(); ++a)
        {
          const Mat3<Number> to_frame = frames[a].triad(values.q_of_forces).transpose();
          r.template segment<3>(6 * a) -= part.of[0][a] * (to_frame * force);
          r.template segment<3>(6 * a + 3) += part.of[0][a] * moment_of<Number>(to_frame * EA);
        }
    }

    /** That by the twist of B and by S. */
    Eigen::Matrix<Number, 7, 1>
    of_b_and_s(const SlidingValues<Number> &values) const
    {
      Eigen::Matrix<Number, 7, 1> r;
      r << values.E_of_forces.transpose() * force,
        moment_of<Number>(values.E_of_forces.transpose() * values.at.d[0] * A[0].transpose()),
        product<Number>(A[0], values.cosines(1)) + product<Number>(A[1], values.cosines(0)) -
          force.cwiseProduct(values.at.x[1]).sum();
      return r;
    }
  };



  /**
   * What turns of the frames, and motions of S, change of the gradient: what the frames of a part of the rail feel, and
   * what B and S feel, whose unknowns begin with @p b. @{
   */
  void add_turns_of_rail(const Rail                  &rail,
                         const SlidingValues<double> &values,
                         const Rail::Weights<double> &part,
                         const SlidingForces<double> &forces,
                         const double                *q,
                         Eigen::MatrixXd             &K);
  void add_turns_of_b(const SlidingValues<double> &values,
                      const SlidingForces<double> &forces,
                      unsigned int                 b,
                      Eigen::MatrixXd             &K);
  /** @} */



  /** Rates of the place and the directors of the rail where B is, with v = Ṡ, and of the products E_i·d_k. */
  struct SlidingRates
  {
    Vector3 x;
    Matrix3 cosines;

    SlidingRates(const SlidingValues<double> &values,
                 const Rail                  &rail,
                 const Frame                 &b,
                 const double                 v,
                 const Point<double>         &point)
      : x(v * values.at.x[1])
    {
      Matrix3 d = v * values.at.d[1];
      for (const Rail::Weights<double> &part : values.weights)
        {
          const std::vector<Frame> &frames = rail.pieces()[part.piece].frames;
          for (unsigned int a = 0; a < frames.size(); ++a)
            {
              const Vector6 twist = frames[a].twist(point.y);
              const Matrix3 D     = frames[a].triad(point.q);
              x += part.of[0][a] * (D * twist.head<3>());
              d += part.of[0][a] * (D * skew(twist.tail<3>()));
            }
        }
      const Matrix3 E = values.E * skew(b.twist(point.y).tail<3>());
      cosines         = E.transpose() * values.at.d[0] + values.E.transpose() * d;
    }
  };



  /** How those change while Ṡ and the twists stay as they are. */
  struct SlidingSecondRates
  {
    Vector3 x;
    Matrix3 cosines;

    SlidingSecondRates(const SlidingValues<double> &values,
                       const Rail                  &rail,
                       const Frame                 &b,
                       const double                 v,
                       const Point<double>         &point)
      : x(v * v * values.at.x[2])
    {
      // of N(S) x: N'' v² x + 2 N' v ẋ + N ẍ, where ẋ = D u, ẍ = D ω~u; of directors the same
      Matrix3 d_rate = v * values.at.d[1], d = v * v * values.at.d[2];
      for (const Rail::Weights<double> &part : values.weights)
        {
          const std::vector<Frame> &frames = rail.pieces()[part.piece].frames;
          for (unsigned int a = 0; a < frames.size(); ++a)
            {
              const Vector6 twist = frames[a].twist(point.y);
              const Matrix3 D = frames[a].triad(point.q), spin = skew(twist.tail<3>()), D_rate = D * spin;
              const double  N = part.of[0][a], N_rate = 2 * v * part.of[1][a];
              x += N_rate * (D * twist.head<3>()) + N * (D_rate * twist.head<3>());
              d_rate += N * D_rate;
              d += N_rate * D_rate + N * D_rate * spin;
            }
        }
      const Matrix3 spin_b = skew(b.twist(point.y).tail<3>()), E = values.E * spin_b;
      cosines = (E * spin_b).transpose() * values.at.d[0] + 2 * E.transpose() * d_rate + values.E.transpose() * d;
    }
  };
} // namespace samara

#endif
