#include <samara/cosserat/section_loft.h>
#include <samara/section/shape_between.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Sum of values with weights; the outline is that of the first. */
    SectionValues
    combined(const std::vector<SectionValues> &values, const std::vector<double> &weights)
    {
      SectionValues result;
      for (unsigned int j = 0; j < values.size(); ++j)
        {
          result.stiffness += weights[j] * values[j].stiffness;
          result.inertia += weights[j] * values[j].inertia;
          result.trapeze.coupling += weights[j] * values[j].trapeze.coupling;
          result.trapeze.stiffness += weights[j] * values[j].trapeze.stiffness;
        }
      return result;
    }



    double
    largest_difference(const Matrix6 &x, const Matrix6 &y)
    {
      // numbers of different units: against the diagonal, which is zero of an inertia without mass
      const Vector6 size = y.diagonal().cwiseAbs().cwiseSqrt();
      double        most = 0;
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
          if (x(i, j) != y(i, j))
            most = std::max(most, std::abs(x(i, j) - y(i, j)) / std::max(size(i) * size(j), 1e-300));
      return most;
    }
  } // namespace



  std::unique_ptr<const SectionLoft>
  AnalysedLoft::make(const std::shared_ptr<const AnalysedShape> &a, const std::shared_ptr<const AnalysedShape> &b)
  {
    if (a->degree != b->degree || a->has_trapeze != b->has_trapeze || a->sees_curvature != b->sees_curvature)
      return nullptr;
    std::unique_ptr<AnalysedLoft> result(new AnalysedLoft(a, b));
    const auto                    middle = shape_between(a->shape, b->shape, 0.5);
    if (!middle)
      return nullptr;
    try
      {
        mesh_of(*middle, a->degree);
      }
    catch (const std::invalid_argument &)
      {
        return nullptr; // parts lie otherwise in the one than in the other
      }
    return result;
  }



  std::shared_ptr<const AnalysedShape>
  AnalysedLoft::shape(const double w) const
  {
    return std::make_shared<AnalysedShape>(*shape_between(a->shape, b->shape, w),
                                           a->degree,
                                           a->has_trapeze,
                                           a->sees_curvature);
  }



  SectionValues
  AnalysedLoft::Polynomial::at(const double there) const
  {
    // the barycentric form: weights of Chebyshev's points alternate, those of the ends are a half
    std::vector<double> weights(w.size(), 0.);
    double              sum = 0;
    for (unsigned int j = 0; j < w.size(); ++j)
      {
        if (there == w[j])
          return values[j];
        weights[j] = (j % 2 == 0 ? 1. : -1.) * (j == 0 || j + 1 == w.size() ? 0.5 : 1.) / (there - w[j]);
        sum += weights[j];
      }
    for (double &weight : weights)
      weight /= sum;
    return combined(values, weights);
  }



  AnalysedLoft::Polynomial
  AnalysedLoft::find(const Vector3 &curvature) const
  {
    constexpr unsigned int most      = 16;
    constexpr double       enough    = 1e-6;
    const auto             values_at = [&](const double w) { return shape(w)->values(curvature); };
    Polynomial             known{{0., 1.}, {values_at(0), values_at(1)}};
    for (unsigned int n = 2; n <= most; n *= 2)
      {
        Polynomial next;
        double     error = 0;
        for (unsigned int j = 0; j <= n; ++j)
          {
            next.w.push_back(j == n ? 1. : 0.5 * (1 - std::cos(M_PI * j / n)));
            if (j % 2 == 0)
              {
                next.w.back() = known.w[j / 2];
                next.values.push_back(known.values[j / 2]);
                continue;
              }
            next.values.push_back(values_at(next.w.back()));
            const SectionValues guess = known.at(next.w.back());
            error                     = std::max({error,
                                                  largest_difference(guess.stiffness, next.values.back().stiffness),
                                                  largest_difference(guess.inertia, next.values.back().inertia)});
          }
        known = next;
        if (error < enough)
          break;
      }
    return known;
  }



  SectionValues
  AnalysedLoft::at(const double w, const Vector3 &curvature) const
  {
    constexpr std::size_t       few   = 3; // curvatures: of more, each place has one
    const Vector3               k     = a->seen(curvature);
    const std::array<double, 3> key   = {{k(0), k(1), k(2)}};
    auto                        known = of_curvature.find(key);
    if (known == of_curvature.end() && of_curvature.size() >= few)
      return shape(w)->values(k);
    if (known == of_curvature.end())
      known = of_curvature.emplace(key, find(k)).first;
    SectionValues result = known->second.at(w);
    result.outline       = interpolate(a->shape.outline, b->shape.outline, w);
    return result;
  }
} // namespace samara
