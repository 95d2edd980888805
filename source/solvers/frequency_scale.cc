#include <samara/solvers/arnoldi.h>
#include <samara/solvers/frequency_scale.h>
#include <samara/solvers/undamped.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Add the diagonal of BᵀCB with the stiffness of each point's softest strain, in the motion's units. */
    void
    add_soft_stiffness(const LinearMotion &motion, std::vector<double> &K)
    {
      const SparseRows &B = motion.strains.B;
      for (const auto &p : motion.strains.points)
        {
          const auto          C       = motion.strains.C(p);
          double              softest = 0;
          std::vector<double> size_of_row(p.size, 0.);
          for (unsigned int i = 0; i < p.size; ++i)
            {
              for (unsigned int k = B.start[p.first_row + i]; k < B.start[p.first_row + i + 1]; ++k)
                size_of_row[i] += std::pow(B.values[k] * motion.units[B.columns[k]], 2);
              const double stiffness = p.weight * std::abs(C(i, i)) * size_of_row[i];
              if (stiffness > 0 && (softest == 0 || stiffness < softest))
                softest = stiffness;
            }
          for (unsigned int i = 0; i < p.size; ++i)
            if (C(i, i) != 0.)
              for (unsigned int k = B.start[p.first_row + i]; k < B.start[p.first_row + i + 1]; ++k)
                K[B.columns[k]] += softest / size_of_row[i] * std::pow(B.values[k] * motion.units[B.columns[k]], 2);
        }
    }

    double
    diagonal(const SparseMatrix &A, const unsigned int i)
    {
      const int k = A.pattern->position(i, i);
      return k < 0 ? 0. : A.values[k];
    }

    double
    mass(const LinearMotion &motion, const unsigned int i)
    {
      return diagonal(motion.M, i) * std::pow(motion.units[i], 2);
    }

    bool
    has_mass(const LinearMotion &motion, const unsigned int i)
    {
      return mass(motion, i) > 0;
    }

    /** |S/M| of an unknown [1/s²] */
    double
    geometric_square(const LinearMotion &motion, const unsigned int i)
    {
      return std::abs(diagonal(motion.S, i)) * std::pow(motion.units[i], 2) / mass(motion, i);
    }

    /** Give f all |Γ/M| of an unknown and others with mass, in the motion's units [1/s]; states have rows of other
     * units. */
    template <typename Function>
    void
    for_rates(const LinearMotion &motion, const unsigned int i, const Function &f)
    {
      const Pattern &p = *motion.gyroscopic.pattern;
      for (int k = p.column_start[i]; k < p.column_start[i + 1]; ++k)
        if (p.rows[k] < static_cast<int>(motion.n_kinematic) && has_mass(motion, p.rows[k]))
          f(std::abs(motion.gyroscopic.values[k]) * motion.units[p.rows[k]] * motion.units[i] / mass(motion, i));
    }

    /** What is smaller, relative to the terms that make it, is round-off of what carries nothing. */
    constexpr double rounds = 1e-13;
  } // namespace



  double
  frequency_scale(const LinearMotion &motion)
  {
    const unsigned int  n = motion.n_kinematic;
    std::vector<double> K(n, 0.);
    add_soft_stiffness(motion, K);
    double elastic = 0, other = 0, largest_square = motion.acceleration, largest_rate = 0;
    for (unsigned int i = 0; i < n; ++i)
      if (has_mass(motion, i))
        {
          largest_square = std::max(largest_square, geometric_square(motion, i));
          for_rates(motion, i, [&](const double rate) { largest_rate = std::max(largest_rate, rate); });
        }
    largest_square = std::max(largest_square, largest_rate * largest_rate);
    for (unsigned int i = 0; i < n; ++i)
      {
        if (!has_mass(motion, i))
          continue;
        const auto lower = [](double &least, const double square, const double round_off) {
          if (square > round_off && (least == 0 || square < least))
            least = square;
        };
        lower(elastic, K[i] / mass(motion, i), 0.);
        lower(other, geometric_square(motion, i), rounds * largest_square);
        for_rates(motion, i, [&](const double rate) { lower(other, rate * rate, rounds * largest_square); });
      }
    // N nodes are one behind the other in a beam, and √N in a shell, whose points have more than six strains
    const auto  &points   = motion.strains.points;
    const bool   is_shell = std::any_of(points.begin(), points.end(), [](const auto &p) { return p.size > 6; });
    const double nodes    = std::max(1., n / 6.);
    if (elastic > 0)
      return std::sqrt(elastic) / (is_shell ? nodes : nodes * nodes);
    return other > 0 ? 0.3 * std::sqrt(other) : 1.; // nothing has a frequency
  }



  namespace
  {
    /** What rough eigenvalues about a shift σ show. */
    struct Spectrum
    {
      double lowest     = 0;     ///< the smallest |λ| that is not zero, nor far below the others; 0 if there is none
      double least      = 0;     ///< the smallest |λ| that is not zero
      bool   is_blurred = false; ///< whether something is much nearer to zero than to σ, where it cannot be told apart
    };

    /** A rough |λ|, by how much it may be wrong, and |ν| relative to the largest one. */
    struct RoughValue
    {
      double size, doubt, share;
    };

    std::vector<RoughValue>
    rough_values(const ShiftInvert &op)
    {
      const unsigned int      enough = std::min(32u, op.size() - 1); // twelve may be free motions
      std::vector<RoughValue> result;
      if (op.is_undamped())
        {
          BlockLanczos lanczos(op, 4);
          if (lanczos.expand(enough))
            {
              for (unsigned int i = 0; i < lanczos.size(); ++i)
                {
                  const double theta = std::abs(lanczos.values[i]), doubt = lanczos.residuals[i] / (theta * theta);
                  const double size = std::sqrt(std::abs(1 / lanczos.values[i] - op.shift() * op.shift()));
                  // each frequency is there twice, as in the first-order form
                  for (unsigned int twice = 0; twice < 2; ++twice)
                    result.push_back(
                      {size, std::min(doubt / size, std::sqrt(doubt)), std::sqrt(theta / std::abs(lanczos.values[0]))});
                }
              return result;
            }
        }
      Arnoldi arnoldi([&](const double *x, double *y) { op.apply(x, y); }, op.size(), 1);
      arnoldi.expand(enough);
      for (unsigned int i = 0; i < arnoldi.size(); ++i)
        {
          const double nu = std::abs(arnoldi.values[i]);
          result.push_back({std::abs(op.shift() + 1. / arnoldi.values[i]),
                            arnoldi.residuals[i] / (nu * nu),
                            nu / std::abs(arnoldi.values[0])});
        }
      return result;
    }

    Spectrum
    spectrum_near(const ShiftInvert &op)
    {
      const double        sigma = std::abs(op.shift());
      Spectrum            result;
      std::vector<double> sizes;
      for (const auto &[size, doubt, share] : rough_values(op))
        {
          if (size + doubt < 1e-6 * sigma || share < 1e-6)
            continue; // a free motion; nothing that has mass
          if (doubt < 0.1 * size)
            sizes.push_back(size);
          else if (size < 0.3 * sigma)
            result.is_blurred = true;
        }
      std::sort(sizes.begin(), sizes.end());
      // frequencies far below all others are near to a stability limit, or of pendulums: no measure of the model; or
      // the six free motions of one body, each there twice, that round-off has moved away from zero
      const std::size_t most  = std::max<std::size_t>(sizes.size() / 2, 12);
      unsigned int      first = 0;
      for (unsigned int i = 0; i + 1 < sizes.size() && i < most && first == 0; ++i)
        if (sizes[i + 1] > 30 * sizes[i])
          first = i + 1;
      if (!sizes.empty())
        {
          result.lowest = sizes[first];
          result.least  = sizes[0];
        }
      return result;
    }
  } // namespace



  double
  set_by_lowest_frequency(const LinearMotion &motion, ShiftInvert &op, const std::optional<double> shift)
  {
    const double scale = frequency_scale(motion);
    double       sigma = shift ? *shift : scale, foretold = 0;
    Spectrum     seen;
    for (unsigned int round = 0; round < 12; ++round)
      {
        op.set(sigma, sigma != 0. ? std::abs(sigma) : scale);
        op.tell("lowest frequency, round " + std::to_string(round + 1));
        const Spectrum before = seen;
        seen                  = spectrum_near(op);
        // what moves away as the shift comes nearer was an infinite eigenvalue: those below it are the motion's
        if (foretold > 0 && !(seen.lowest < 3 * foretold))
          {
            seen.lowest = before.least;
            sigma       = 0.3 * seen.lowest;
            break;
          }
        foretold              = 0;
        const bool is_far_off = seen.lowest > 0 ? sigma > seen.lowest || sigma < 0.03 * seen.lowest : seen.is_blurred;
        if (shift || !is_far_off)
          break;
        if (sigma < seen.lowest)
          foretold = seen.lowest;
        sigma = seen.lowest > 0 ? 0.3 * seen.lowest : sigma / 30;
      }
    const double lowest = seen.lowest > 0 ? seen.lowest : std::max(std::abs(sigma), scale);
    const double unit   = shift ? std::max(std::abs(*shift), lowest) : lowest;
    op.set(sigma, unit);
    return unit;
  }
} // namespace samara
