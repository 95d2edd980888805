// How what slides along a beam turns against the section where it is: unknowns for its friction.

#include <samara/joints/sliding_values.h>

namespace samara
{
  /**
   * Unknowns u whose rates are those of turns of B against the section of the beam where it is, with M = EᵀD(S):
   *
   *     r E_i·(ω_B − ω(S)) − u̇_i = 0,     E_i·(ω_B − ω(S)) = −½ (Ĝ_i M) : Ṁ,     Ĝ_i the cross product with e_i
   *
   * Ṁ is the whole rate, that by S among it: where the beam is bent or twisted B turns by sliding alone. These are
   * constraints on velocities alone. They need no M that is orthonormal; u is a turn [rad] with r = 1, or a way [m].
   */
  class SlidingJoint::Turns : public Evaluated<SlidingJoint::Turns, Constraint>
  {
  public:
    /** About the first @p n axes of B. */
    Turns(Layout             &layout,
          const SlidingJoint &joint,
          const unsigned int  n,
          const unsigned int  first_coordinate,
          const double        radius)
      : joint(joint)
      , rail(*joint.rail)
      , n(n)
      , coordinate(first_coordinate)
      , radius(radius)
    {
      std::vector<std::string> names;
      for (unsigned int i = 0; i < n; ++i)
        names.push_back("turn about axis " + std::to_string(i + 1));
      multiplier                            = layout.add_multipliers(joint, names);
      std::vector<unsigned int> coordinates = {joint.coordinate()}, multipliers;
      for (unsigned int i = 0; i < n; ++i)
        {
          coordinates.push_back(coordinate + i);
          multipliers.push_back(multiplier + i);
          layout.nonholonomic.push_back(multiplier + i);
        }
      blocks.resize(rail.pieces().size());
      for (unsigned int i = 0; i < blocks.size(); ++i)
        {
          std::vector<Frame> frames = rail.pieces()[i].frames;
          frames.push_back(joint.frame_b);
          layout.couple(blocks[i], frames, coordinates, multipliers);
        }
    }

    template <typename Number>
    void
    residual_at(const Point<Number> &point, Number *r) const
    {
      const Number *const                                   lambda = point.multipliers + multiplier;
      thread_local Eigen::Matrix<Number, Eigen::Dynamic, 1> local;
      if (has_left(point))
        {
          const unsigned int u = 6 * rail.pieces()[0].frames.size() + 7;
          local.setZero(u + 2 * n);
          for (unsigned int i = 0; i < n; ++i)
            local(u + i) = -lambda[i];
          return blocks[0].add(local, r);
        }
      const SlidingValues<Number> values(rail, joint.frame_b, abscissa(point), point);
      const auto                  f = forces(values, lambda);
      for (const Rail::Weights<Number> &part : values.weights)
        {
          const std::vector<Frame> &frames = rail.pieces()[part.piece].frames;
          const unsigned int        b      = 6 * frames.size();
          local.setZero(b + 7 + 2 * n);
          f.add_to_rail(values, part, frames, local);
          if (&part == values.weights.begin())
            {
              local.template segment<7>(b) = f.of_b_and_s(values);
              for (unsigned int i = 0; i < n; ++i)
                local(b + 7 + i) = -lambda[i];
            }
          blocks[part.piece].add(local, r);
        }
    }

    void
    tangent(const Point<double> &point, SparseMatrix &K) const override
    {
      thread_local Eigen::MatrixXd local;
      if (has_left(point))
        {
          const unsigned int u = 6 * rail.pieces()[0].frames.size() + 7;
          local.setZero(u + 2 * n, u + 2 * n);
          add_rates_of_u(u, local);
          return blocks[0].add(local, K);
        }
      const SlidingValues<double> values(rail, joint.frame_b, abscissa(point), point);
      const auto                  f = forces(values, point.multipliers + multiplier);
      for (const Rail::Weights<double> &part : values.weights)
        {
          const std::vector<Frame> &frames = rail.pieces()[part.piece].frames;
          const unsigned int        b = 6 * frames.size(), u = b + 7;
          const bool                is_first = &part == values.weights.begin();
          local.setZero(u + 2 * n, u + 2 * n);
          add_turns_of_rail(rail, values, part, f, point.q, local);
          if (is_first)
            {
              add_turns_of_b(values, f, b, local);
              add_rates_of_u(u, local);
            }
          for (unsigned int i = 0; i < n; ++i)
            {
              std::array<double, 3> one = {};
              one[i]                    = 1;
              const auto gradient       = forces(values, one.data());
              auto       column         = local.col(u + n + i);
              gradient.add_to_rail(values, part, frames, column);
              if (is_first)
                column.segment<7>(b) += gradient.of_b_and_s(values);
            }
          local.block(u + n, 0, n, u) = local.block(0, u + n, u, n).transpose();
          add_changes_of_factors(values, part, point, is_first, local);
          blocks[part.piece].add(local, K);
        }
    }

    void
    rates(const Point<double> &point, double *rates) const override
    {
      for (unsigned int i = 0; i < n; ++i)
        rates[multiplier + i] = -point.rates[coordinate + i];
      if (has_left(point))
        return;
      const SlidingValues<double> values(rail, joint.frame_b, abscissa(point), point);
      const SlidingRates          rate(values, rail, joint.frame_b, point.rates[joint.coordinate()], point);
      const Matrix3               M = values.cosines(0);
      for (unsigned int i = 0; i < n; ++i)
        {
          const Matrix3 A = -0.5 * radius * skew(Vector3::Unit(i)) * M;
          rates[multiplier + i] += product<double>(A, rate.cosines);
        }
    }

    void
    second_rates(const Point<double> &point, double *rates) const override
    {
      if (has_left(point))
        return;
      // Ȧ : Ṁ = −½ r (Ĝ_i Ṁ) : Ṁ vanishes
      const SlidingValues<double> values(rail, joint.frame_b, abscissa(point), point);
      const SlidingSecondRates    second(values, rail, joint.frame_b, point.rates[joint.coordinate()], point);
      const Matrix3               M = values.cosines(0);
      for (unsigned int i = 0; i < n; ++i)
        rates[multiplier + i] = product<double>(-0.5 * radius * skew(Vector3::Unit(i)) * M, second.cosines);
    }

  private:
    const SlidingJoint &joint;
    const Rail         &rail;
    const unsigned int  n, coordinate;
    const double        radius;
    unsigned int        multiplier;
    std::vector<Block>  blocks; ///< of each piece: twists of its frames and of B, S, u, multipliers

    template <typename Number>
    bool
    has_left(const Point<Number> &point) const
    {
      return !point.held && joint.is_far(std::real(point.coordinates[joint.coordinate()]));
    }

    template <typename Number>
    Number
    abscissa(const Point<Number> &point) const
    {
      return joint.start + point.coordinates[joint.coordinate()];
    }

    /** −½ r Σ λ_i Ĝ_i */
    template <typename Number>
    Mat3<Number>
    left_factor(const Number *lambda) const
    {
      Vec3<Number> along = Vec3<Number>::Zero();
      for (unsigned int i = 0; i < n; ++i)
        along(i) = -0.5 * radius * lambda[i];
      return skew(along);
    }

    template <typename Number>
    SlidingForces<Number>
    forces(const SlidingValues<Number> &values, const Number *lambda) const
    {
      SlidingForces<Number> result;
      result.A[0] = left_factor(lambda) * (values.E_of_forces.transpose() * values.at.d[0]);
      return result;
    }

    /** Rows u̇_i, and the forces of their multipliers, where u begins with @p u. */
    void
    add_rates_of_u(const unsigned int u, Eigen::MatrixXd &K) const
    {
      for (unsigned int i = 0; i < n; ++i)
        K(u + i, u + n + i) = K(u + n + i, u + i) = -1;
    }

    /** That the factors A = L M of Ṁ change with M. (What two pieces have in common where slopes turn is left out.) */
    void
    add_changes_of_factors(const SlidingValues<double> &values,
                           const Rail::Weights<double> &part,
                           const Point<double>         &point,
                           const bool                   is_first,
                           Eigen::MatrixXd             &K) const
    {
      const std::vector<Frame> &frames = rail.pieces()[part.piece].frames;
      const unsigned int        b      = 6 * frames.size();
      const Matrix3             L      = left_factor(point.multipliers + multiplier);
      Eigen::MatrixXd           slopes = Eigen::MatrixXd::Zero(b + 7, 9); // of M_jk
      for (unsigned int j = 0; j < 3; ++j)
        for (unsigned int k = 0; k < 3; ++k)
          {
            SlidingForces<double> one;
            one.A[0](j, k) = 1;
            auto column    = slopes.col(3 * j + k);
            one.add_to_rail(values, part, frames, column);
            column.segment<7>(b) += one.of_b_and_s(values);
          }
      Eigen::MatrixXd change = Eigen::MatrixXd::Zero(b + 7, b + 7);
      for (unsigned int j = 0; j < 3; ++j)
        for (unsigned int l = 0; l < 3; ++l)
          for (unsigned int k = 0; k < 3 && L(j, l) != 0; ++k)
            change += L(j, l) * slopes.col(3 * j + k) * slopes.col(3 * l + k).transpose();
      if (!is_first)
        change.bottomRightCorner<7, 7>().setZero();
      K.topLeftCorner(b + 7, b + 7) += change;
    }
  };



  std::unique_ptr<Constraint>
  SlidingJoint::make_turns(Layout &layout, const unsigned int n, const unsigned int first, const double radius) const
  {
    return std::make_unique<Turns>(layout, *this, n, first, radius);
  }
} // namespace samara
