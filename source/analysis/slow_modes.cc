#include <samara/analysis/linearization.h>
#include <samara/analysis/slow_modes.h>
#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/rotation/matrix6.h>
#include <samara/solvers/eigen.h>
#include <samara/solvers/eigen_system.h>
#include <samara/solvers/redundant_rows.h>
#include <samara/time/projection.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    using Complex = std::complex<double>;
    using Eigen::MatrixXd, Eigen::VectorXd, Eigen::VectorXcd;

    /** Modes of the linearised motion that are asked for at once, and most of them. @{ */
    constexpr unsigned int first_modes = 24, most_modes = 400;
    /** @} */

    /** Modes up to this many times the highest frequency are in the space at the start: what slow ones bend. */
    constexpr double margin = 1.5;

    /** What has more of its norm than this in the slow modes at the start is one of them; but not if its velocities are
     * so many times faster than the slow ones: a direction that dies in a step lies anywhere. @{ */
    constexpr double least_share = 0.5, too_fast = 3;
    /** @} */

    /** Multipliers from here on do not decay. */
    constexpr double no_decay = 1 - 1e-6;

    /** Parts of vectors that are left outside of a space, over their norm, below which they are round-off. */
    constexpr double round_off_of_bases = 1e-10;



    /** All modes at the start of the period with |λ| up to @p highest. */
    std::vector<Mode>
    modes_at_start(const SectionMap &map, const double highest)
    {
      State      state = map.map.states().front();
      Projection projection(map.system);
      projection.report(state, true); // reactions stiffen, and steps do not leave them
      state.held = false;
      if (!state.left_out.empty())
        RedundantRows(map.system).choose(state);
      const Linearization motion(map.system, state);
      for (unsigned int n = first_modes;; n *= 2)
        {
          Modes      modes  = find_modes(motion, n, {});
          const auto beyond = std::find_if(modes.found.begin(), modes.found.end(), [&](const Mode &m) {
            return m.frequency() > highest;
          });
          if (beyond == modes.found.end() && !modes.is_all && n < most_modes)
            continue;
          if (beyond == modes.found.end() && !modes.is_all)
            throw NotConverged("there are more than " + std::to_string(n) + " modes below " +
                               number_to_text("%.4g", highest) + " rad/s; set a lower <Highest frequency>");
          modes.found.erase(beyond, modes.found.end());
          return modes.found;
        }
    }



    /** The increment (ζ, δy) that a mode is at its start: δy = ζ̇ + ad_y ζ. */
    VectorXcd
    increment_of(const SectionMap &map, const Mode &mode)
    {
      const Layout      &layout = map.system.layout;
      const State       &state  = map.map.states().front();
      const unsigned int first  = map.map.first_velocity();
      VectorXcd          x      = VectorXcd::Zero(map.map.size());
      x.head(first)             = mode.shape;
      for (unsigned int node = 1; node < layout.n_nodes; ++node)
        {
          const Eigen::Matrix<Complex, 6, 1> zeta = mode.shape.segment<6>(layout.of_node(node));
          x.segment<6>(first + layout.of_node(node)) =
            mode.lambda * zeta + ad(Eigen::Map<const Vector6>(&state.y[6 * node])).cast<Complex>() * zeta;
        }
      for (unsigned int i = 0; i < layout.n_coordinates; ++i)
        x(first + layout.of_coordinate(i)) = mode.lambda * mode.shape(layout.of_coordinate(i));
      return x;
    }



    VectorXcd
    scales_of(const SectionMap &map)
    {
      return Eigen::Map<const VectorXd>(map.scales().data(), map.scales().size()).cast<Complex>();
    }



    /**
     * Coordinates of increments x whose squares are kinetic energies: of velocities ζ̇ = δy − ad_y ζ, and of
     * displacements at the highest slow frequency; states over their scales. In these slow modes are nearly orthogonal
     * to fast ones, so that a small residual means a small error, and of multipliers one of its square. Among stiff
     * modes numbers over plain scales are hundreds of times less telling. What has no mass counts by a little.
     */
    class EnergyCoordinates
    {
    public:
      EnergyCoordinates(const SectionMap &map, const double highest)
        : layout(map.system.layout)
        , state(map.map.states().front())
        , first(map.map.first_velocity())
        , highest(highest)
        , weights(map.map.size())
      {
        double mass = 0;
        for (const auto &node : map.system.model.nodes)
          mass += node.inertia(0, 0);
        if (!(mass > 0))
          mass = 1;
        // one is the motion of all of the mass by the length of the model, at the highest frequency
        const double length = map.scales()[0], unit = mass * length * length * highest * highest;
        for (int i = 0; i < weights.size(); ++i)
          weights(i) = (i >= layout.n_kinematic() && i < int(first) ? 1. : least_weight) / map.scales()[i];
        for (unsigned int node = 1; node < layout.n_nodes; ++node)
          {
            Matrix6 inertia = map.system.model.nodes[node].inertia / unit;
            for (unsigned int i = 0; i < 6; ++i)
              inertia(i, i) += std::pow(weights(layout.of_node(node) + i) / highest, 2);
            roots.push_back(cholesky_upper(inertia));
          }
      }

      template <typename Vector>
      Vector
      from_increment(const Vector &x) const
      {
        using Number = typename Vector::Scalar;
        Vector z     = x.cwiseProduct(weights.cast<Number>());
        for (unsigned int node = 1; node < layout.n_nodes; ++node)
          {
            const int  row             = layout.of_node(node);
            const auto U               = roots[node - 1].cast<Number>();
            z.template segment<6>(row) = highest * (U * x.template segment<6>(row));
            z.template segment<6>(first + row) =
              U * (x.template segment<6>(first + row) - ad_of(node).cast<Number>() * x.template segment<6>(row));
          }
        return z;
      }

      template <typename Vector>
      Vector
      to_increment(const Vector &z) const
      {
        using Number = typename Vector::Scalar;
        Vector x     = z.cwiseQuotient(weights.cast<Number>());
        for (unsigned int node = 1; node < layout.n_nodes; ++node)
          {
            const int                         row  = layout.of_node(node);
            const Eigen::Matrix<Number, 6, 6> U    = roots[node - 1].cast<Number>();
            const Eigen::Matrix<Number, 6, 1> zeta = U.template triangularView<Eigen::Upper>().solve(
              Eigen::Matrix<Number, 6, 1>(z.template segment<6>(row) / highest));
            x.template segment<6>(row)         = zeta;
            x.template segment<6>(first + row) = U.template triangularView<Eigen::Upper>().solve(
                                                   Eigen::Matrix<Number, 6, 1>(z.template segment<6>(first + row))) +
                                                 ad_of(node).cast<Number>() * zeta;
          }
        return x;
      }

      /** Root mean square of velocities over that of displacements, by energy [rad/s]. */
      double
      rate(const VectorXcd &z) const
      {
        const int    n             = layout.of_coordinate(0);
        const double displacements = z.head(n).norm() / highest, velocities = z.segment(first, n).norm();
        return displacements > 0 ? velocities / displacements : 0.;
      }

    private:
      static constexpr double least_weight = 1e-4;

      const Layout        &layout;
      const State         &state;
      const unsigned int   first;
      const double         highest;
      VectorXd             weights; ///< of what is no node
      std::vector<Matrix6> roots;   ///< U of each node, UᵀU = M

      Matrix6
      ad_of(const unsigned int node) const
      {
        return ad(Eigen::Map<const Vector6>(&state.y[6 * node]));
      }
    };



    /** The map projected on a growing space: orthonormal columns V in coordinates of energy, and their images. */
    class Projected
    {
    public:
      Projected(SectionMap &map, const double highest)
        : energy(map, highest)
        , map(map)
        , V(map.map.size(), 0)
        , images(map.map.size(), 0)
      {}

      const EnergyCoordinates energy;

      /** Take a vector in, unless it lies in the space; returns whether it did not. */
      bool
      add(VectorXd x)
      {
        const double before = x.norm();
        for (unsigned int pass = 0; pass < 2; ++pass)
          x -= V * (V.transpose() * x).eval();
        if (!(x.norm() > round_off_of_bases * before))
          return false;
        V.conservativeResize(Eigen::NoChange, V.cols() + 1);
        V.rightCols(1) = x.normalized();
        return true;
      }

      /** Carry what is new through the section. */
      void
      carry()
      {
        for (int j = images.cols(); j < V.cols(); ++j)
          {
            VectorXd x = energy.to_increment(VectorXd(V.col(j)));
            map.apply(x.data());
            if (!x.allFinite())
              throw NotConverged("the map over the period gives what is not a number");
            images.conservativeResize(Eigen::NoChange, j + 1);
            images.col(j) = energy.from_increment(x);
          }
      }

      struct Pair
      {
        Complex   value;
        VectorXcd vector, residual; ///< unit norm; S v − σ v
        double    change = 1;       ///< of σ since the space has grown last, relative
        /** Either may be small by itself: a residual where left vectors are large, a change where nothing is new. */
        double
        error() const
        {
          return std::max(residual.norm() / std::max(std::abs(value), 1e-300), change);
        }
      };

      /**
       * Of pairs the one with Im σ ≥ 0: those with a share in the first @p n_first columns, largest σ first, until they
       * span as many dimensions, a pair two and what is real one; and all others that do not decay. Where coefficients
       * change much, modes are not as many as at the start: a pair becomes two real multipliers, more inflow is slow,
       * and what is left out must be what is damped most, never one that grows.
       */
      std::vector<Pair>
      pairs(const unsigned int n_first, const double highest) const
      {
        const MatrixXd    H        = V.transpose() * images;
        const EigenSystem spectrum = eigen_system_of(H);
        std::vector<Pair> result;
        for (int i = 0; i < H.cols(); ++i)
          {
            const VectorXcd y     = spectrum.vectors.col(i).normalized();
            const double    share = y.head(n_first).norm();
            if (spectrum.values(i).imag() < 0 || share < least_share)
              continue;
            Pair pair{spectrum.values(i), V * y, {}};
            pair.residual = images * y - pair.value * pair.vector;
            if (energy.rate(pair.vector) <= too_fast * highest)
              result.push_back(pair);
          }
        std::stable_sort(result.begin(), result.end(), [](const Pair &a, const Pair &b) {
          return std::abs(a.value) > std::abs(b.value);
        });
        unsigned int n         = 0;
        const auto   is_beyond = [&](const Pair &pair) {
          const bool beyond = n >= n_first;
          n += pair.value.imag() > 0 ? 2 : 1;
          return beyond && std::abs(pair.value) < no_decay;
        };
        std::vector<Pair> kept;
        for (auto &pair : result)
          if (!is_beyond(pair))
            kept.push_back(std::move(pair));
        return kept;
      }

      unsigned int
      size() const
      {
        return V.cols();
      }

    private:
      SectionMap &map;
      MatrixXd    V, images;
    };



    /** The real increments that a mode spans at its start: two of a pair, and of a free motion. */
    std::vector<VectorXd>
    columns_of(SectionMap &map, const Mode &mode)
    {
      const VectorXcd       x     = increment_of(map, mode);
      std::vector<VectorXd> parts = {x.real(), x.imag()};
      if (mode.is_free())
        {
          parts[1].setZero();
          parts[1].tail(map.system.layout.n_kinematic()) = mode.shape.real().head(map.system.layout.n_kinematic());
        }
      std::vector<VectorXd> result;
      for (auto &part : parts)
        {
          map.keep_controls(part.data());
          if (part.isZero(0.))
            continue;
          map.map.project_increment(map.map.states().front(), part.data());
          result.push_back(part);
        }
      return result;
    }



    /** Whether a mode is that of a control, which keeps its value. */
    bool
    is_of_control(const SectionMap &map, const Mode &mode)
    {
      VectorXd x                = VectorXd::Zero(map.map.size());
      x.head(mode.shape.size()) = mode.shape.cwiseAbs();
      const VectorXd before     = x;
      map.keep_controls(x.data());
      return x != before && mode.is_free();
    }



    /** Columns of slow modes in front, those of the margin behind them; returns how many are slow. */
    unsigned int
    add_modes(SectionMap &map, const std::vector<Mode> &modes, const double highest, Projected &space)
    {
      unsigned int n_slow = 0;
      for (const auto &mode : modes)
        {
          for (const auto &column : columns_of(map, mode))
            space.add(space.energy.from_increment(column));
          if (mode.frequency() <= highest)
            n_slow = space.size();
        }
      return n_slow;
    }



    /** By how much each value is away from the nearest one before. */
    void
    find_changes(const std::vector<Projected::Pair> &before, std::vector<Projected::Pair> &pairs)
    {
      for (auto &pair : pairs)
        for (const auto &other : before)
          pair.change =
            std::min(pair.change, std::abs(pair.value - other.value) / std::max(std::abs(pair.value), 1e-300));
    }



    /** Let the space grow by the residuals of all that has not come to the tolerance; returns whether it did. */
    bool
    grow(Projected &space, const std::vector<Projected::Pair> &pairs, const SlowModes &which)
    {
      bool has_grown = false;
      for (const auto &pair : pairs)
        if (pair.error() > which.tolerance && space.size() < which.most_columns)
          {
            has_grown = space.add(pair.residual.real()) || has_grown;
            if (pair.value.imag() > 0)
              has_grown = space.add(pair.residual.imag()) || has_grown;
          }
      return has_grown;
    }
  } // namespace



  FloquetModes
  slow_floquet_modes(SectionMap &map, const SlowModes &which)
  {
    std::vector<Mode> modes;
    try
      {
        modes = modes_at_start(map, margin * which.highest);
      }
    catch (const SingularMatrix &singular)
      {
        throw NotConverged(
          "there are no modes at the start of the period to begin with: the matrix is singular" +
          (singular.unknown >= 0 ? " at " + map.system.layout.name_of(singular.unknown) : std::string()));
      }
    FloquetModes result;
    for (const auto &mode : modes)
      result.n_looked_for += mode.frequency() <= which.highest && !is_of_control(map, mode);
    if (result.n_looked_for == 0)
      throw NotConverged("nothing at the start of the period is as slow as the <Highest frequency>, " +
                         number_to_text("%.4g", which.highest) + " rad/s");
    Projected                    space(map, which.highest);
    const unsigned int           n_first = add_modes(map, modes, which.highest, space);
    std::vector<Projected::Pair> pairs;
    do
      {
        space.carry();
        const auto before = pairs;
        pairs             = space.pairs(n_first, which.highest);
        find_changes(before, pairs);
      }
    while (grow(space, pairs, which));
    if (space.size() < which.most_columns) // there is nothing else that could change them
      for (auto &pair : pairs)
        if (pair.error() > which.tolerance)
          pair.change = 0;

    result.n_columns = space.size();
    for (const auto &pair : pairs)
      if (pair.error() <= which.tolerance)
        {
          const VectorXcd x = space.energy.to_increment(pair.vector);
          result.found.push_back(mode_of(map, pair.value, x.cwiseQuotient(scales_of(map)), pair.residual.norm()));
        }
      else
        {
          ++result.n_open;
          result.largest_residual = std::max(result.largest_residual, pair.error());
        }
    if (pairs.empty())
      throw NotConverged(
        "none of the " + std::to_string(result.n_looked_for) +
        " slow modes that there are at the start of the period, as if coefficients stayed, is slow over "
        "all of it; take a larger <Highest frequency>");
    if (result.found.empty())
      throw NotConverged("none of " + std::to_string(result.n_looked_for) + " slow modes comes to the tolerance with " +
                         std::to_string(space.size()) + " columns; residuals are up to " +
                         number_to_text("%.1e", result.largest_residual));
    double largest = 0;
    for (const auto &mode : result.found)
      largest = std::max(largest, std::abs(mode.of_section));
    put_in_order(result, largest);
    return result;
  }
} // namespace samara
