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

    /** What has more of its norm than this in the slow modes at the start may be one of them; but not if its velocities
     * are so many times faster than the slow ones: a direction that dies in a step lies anywhere. @{ */
    constexpr double least_share = 0.5, too_fast = 3;
    /** @} */

    /** Multipliers of the section that are smaller, over the largest, are lost in round-off of its steps. */
    constexpr double lost_over_section = 1e-10;

    /** Displacements that are less of an increment's size say nothing of how fast it is. */
    constexpr double least_displacement = 1e-6;

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
          Modes      modes  = find_modes(motion, n, {}, map.listener);
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
        const int n = layout.of_coordinate(0);
        return has_displacements(z) ? z.segment(first, n).norm() / z.head(n).norm() * highest : 0.;
      }

      /** (ζ, ζ̇)/(ζ, ζ), by energy: λ where ζ̇ = λ ζ, as coefficients are constant [1/s]. */
      Complex
      quotient(const VectorXcd &z) const
      {
        const int n = layout.of_coordinate(0);
        return has_displacements(z) ? z.head(n).dot(z.segment(first, n)) / z.head(n).squaredNorm() * highest : 0.;
      }

    private:
      static constexpr double least_weight = 1e-4;

      const Layout        &layout;
      const State         &state;
      const unsigned int   first;
      const double         highest;
      VectorXd             weights; ///< of what is no node
      std::vector<Matrix6> roots;   ///< U of each node, UᵀU = M

      bool
      has_displacements(const VectorXcd &z) const
      {
        return z.head(layout.of_coordinate(0)).norm() > least_displacement * z.norm();
      }

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
        double    share  = 0;       ///< of the norm, in the slow modes at the start
        double    size   = 0;       ///< |λ|, of the λ + i 2π k/T that is nearest to the quotient [1/s]
        double    change = 1;       ///< of σ since the space has grown last, relative
        /** Either may be small by itself: a residual where left vectors are large, a change where nothing is new. */
        double
        error() const
        {
          return std::max(residual.norm() / std::max(std::abs(value), 1e-300), change);
        }
        unsigned int
        n_dimensions() const
        {
          return value.imag() > 0 ? 2 : 1;
        }
      };

      /**
       * Of pairs the one with Im σ ≥ 0: all with |λ| up to @p highest; of those with a share in the first @p n_first
       * columns the slowest, until all span as many dimensions, a pair two and what is real one; and those of them that
       * do not decay. The steps may damp fast ones less than slow ones are damped: how large σ is tells nothing. Where
       * coefficients change much, modes are not as many as at the start: a pair becomes two real multipliers.
       */
      std::vector<Pair>
      pairs(const unsigned int n_first, const double highest) const
      {
        std::vector<Pair> result;
        double            largest = 0;
        for (auto &pair : all_pairs(n_first))
          {
            largest           = std::max(largest, std::abs(pair.value));
            const double rate = energy.rate(pair.vector);
            if ((pair.share >= least_share && rate <= too_fast * highest) || (pair.size <= highest && rate <= highest))
              result.push_back(std::move(pair));
          }
        std::stable_sort(result.begin(), result.end(), [](const Pair &a, const Pair &b) { return a.size < b.size; });
        unsigned int      n = 0;
        std::vector<Pair> kept;
        for (auto &pair : result)
          if (std::abs(pair.value) > lost_over_section * largest &&
              (pair.size <= highest || n < n_first || std::abs(pair.value) >= no_decay))
            {
              n += pair.n_dimensions();
              kept.push_back(std::move(pair));
            }
        return kept;
      }

      unsigned int
      size() const
      {
        return V.cols();
      }

      MatrixXd
      projected() const
      {
        return V.transpose() * images;
      }

    private:
      SectionMap &map;
      MatrixXd    V, images;

      Pair
      pair_of(const Complex value, const VectorXcd &y, const unsigned int n_first) const
      {
        Pair pair{value, V * y, images * y, y.head(n_first).norm()};
        pair.residual -= value * pair.vector;
        const double  section   = map.map.settings.period;
        const Complex principal = std::log(value) / section;
        // parts that come round in patterns turn σ by fractions of a turn
        const double turn   = 2 * M_PI / (section * map.repeated().n()),
                     beyond = turn * std::round((energy.quotient(pair.vector).imag() - principal.imag()) / turn);
        pair.size           = std::abs(principal + Complex(0, beyond));
        return pair;
      }

      /** One of each pair, real ones by themselves. */
      std::vector<Pair>
      all_pairs(const unsigned int n_first) const
      {
        const EigenSystem spectrum = eigen_system_of(projected());
        std::vector<Pair> result;
        for (int i = 0; i < V.cols(); ++i)
          {
            const Complex value = spectrum.values(i);
            if (value.imag() < 0 || value == 0.)
              continue;
            const VectorXcd y    = spectrum.vectors.col(i).normalized();
            Pair            pair = pair_of(value, y, n_first);
            // a real one that is there twice is a pair as far as both are not known exactly: two vectors of their plane
            const VectorXd first = y.real().normalized(), rest = y.imag() - first * first.dot(y.imag());
            if (value.imag() > 0 && value.imag() <= pair.residual.norm() && rest.norm() > round_off_of_bases)
              for (const VectorXd &vector : {first, VectorXd(rest.normalized())})
                result.push_back(pair_of(value.real(), vector.cast<Complex>(), n_first));
            else
              result.push_back(std::move(pair));
          }
        return result;
      }
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
    /** Dimensions of slow modes at the start that decay so fast over the section that no step keeps them. */
    unsigned int
    n_lost(const SectionMap &map, const std::vector<Mode> &modes, const double highest)
    {
      unsigned int n = 0;
      for (const auto &mode : modes)
        if (mode.frequency() <= highest && mode.lambda.real() * map.map.settings.period < std::log(lost_over_section))
          n += mode.lambda.imag() > 0 ? 2 : 1;
      return n;
    }



    /** @throws NotConverged if slow modes are missing that the start has, or have not come to the tolerance */
    void
    require_all(const std::vector<Projected::Pair> &pairs,
                const unsigned int                  n_expected,
                const SlowModes                    &which,
                const unsigned int                  n_columns)
    {
      unsigned int n = 0, n_open = 0;
      double       largest = 0;
      for (const auto &pair : pairs)
        {
          n += pair.n_dimensions();
          if (pair.error() > which.tolerance && pair.size <= which.highest)
            {
              ++n_open;
              largest = std::max(largest, pair.error());
            }
        }
      const std::string below = " below the <Highest frequency>, " + number_to_text("%.4g", which.highest) + " rad/s, ";
      if (n_open > 0)
        throw NotConverged(std::to_string(n_open) + " modes" + below + "have not come to the <Tolerance> with " +
                           std::to_string(n_columns) + " columns: residuals are up to " +
                           number_to_text("%.1e", largest) +
                           ".\n  Take a lower <Highest frequency>, or a <Tolerance> above that");
      if (n < n_expected)
        throw NotConverged(
          "modes" + below + "are missing: there are " + std::to_string(n_expected) +
          " directions of them at the start, of pairs two, and " + std::to_string(n) +
          " over the period.\n  Take another <Highest frequency>, more <Steps>, or Method = classical");
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
      result.n_looked_for += mode.frequency() <= which.highest;
    if (result.n_looked_for == 0)
      throw NotConverged("nothing at the start of the period is as slow as the <Highest frequency>, " +
                         number_to_text("%.4g", which.highest) + " rad/s");
    Projected                    space(map, which.highest);
    const unsigned int           n_first = add_modes(map, modes, which.highest, space);
    std::vector<Projected::Pair> pairs;
    do
      {
        map.begin(std::to_string(result.n_looked_for) + " slow modes in a space of " + std::to_string(space.size()) +
                  " columns");
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
    result.n_lost    = n_lost(map, modes, which.highest);
    if (pairs.empty() && result.n_lost < n_first)
      throw NotConverged("none of the " + std::to_string(result.n_looked_for) +
                         " slow modes at the start of the period, as if coefficients stayed, is slow over all of it; "
                         "take a larger <Highest frequency>");
    require_all(pairs, n_first - std::min(n_first, result.n_lost), which, space.size());
    for (const auto &pair : pairs)
      if (pair.error() <= which.tolerance)
        {
          const VectorXcd x = space.energy.to_increment(pair.vector);
          result.found.push_back(mode_of(map, pair.value, x.cwiseQuotient(scales_of(map)), pair.residual.norm()));
        }
    double largest = 0;
    for (const auto &mode : result.found)
      largest = std::max(largest, std::abs(mode.of_section));
    put_in_order(result, largest);
    estimate_errors(map, space.projected(), map.map.settings.tangent_tolerance, result);
    return result;
  }
} // namespace samara
