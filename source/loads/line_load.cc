#include <samara/base/composite_rule.h>
#include <samara/base/text.h>
#include <samara/loads/loads.h>
#include <samara/loads/surface_loads.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  void
  LineLoad::add_parameters(Parameters &prm)
  {
    prm.add("Body", body, "Beam, or shell, along which it acts.");
    prm.add("Edge", edge, "Of a shell: the edge along which it acts, edge u0.");
    prm.add("Force", force, "Components per length, expressions of time t and signals [N/m].");
    prm.add("Moment", moment, "Components per length, expressions of time t and signals [N].");
    prm.add("Variation", variation, "Factor along the beam, a function of the arc length s in metres [1].");
    add_axes_parameter(prm);
  }



  void
  LineLoad::initialize(Model &model)
  {
    if (!parameters.require("Body", model.complaints))
      return;
    std::string where = "Body";
    try
      {
        const Body &found = model.find<Body>(body, "body");
        if (parameters.is_set("Edge"))
          where = "Edge";
        const auto along = parameters.is_set("Edge") ? surface_body(model, body).edge(edge) : found.spans();
        if (along.empty() && dynamic_cast<const SurfaceBody *>(&found) != nullptr)
          throw std::invalid_argument("say along which <Edge> of shell <" + body + "> the load acts");
        if (along.empty())
          throw std::invalid_argument("body <" + body + "> has no length along which a load could act");
        where = "Variation";
        bool acts = false;
        for (const auto &span : along)
          acts = add_span(span) || acts;
        // a peak between all points of the rule is not seen; that nothing is left of a load is
        if (!acts && !variation.is_constant())
          throw std::invalid_argument("the variation is zero wherever it was looked at: the load would act nowhere, or "
                                      "on so short a part that it cannot be found; use a point load, or a comparison "
                                      "such as s > 1 && s < 1.001 ? 1 : 0, whose jumps are found");
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where(where), problem.what());
      }
  }



  namespace
  {
    constexpr unsigned int points_a_piece = 10; // exact for the products of two polynomials of degree 6 and one of 7

    /** ∫ p ds and ∫ |p| ds */
    std::pair<double, double>
    integrals(const Expression &p, const std::vector<double> &breaks)
    {
      std::pair<double, double> sums;
      for (const auto &[s, ds] : composite_rule(breaks, points_a_piece))
        {
          sums.first += p(s) * ds;
          sums.second += std::abs(p(s)) * ds;
        }
      return sums;
    }

    /** Add breaks between @p a and @p b, and @p b, until the rule is exact to round-off: narrow peaks, roots. */
    void
    refine(const Expression    &p,
           const double         a,
           const double         b,
           double              &size, // ∫ |p| ds, as far as it has been seen
           const unsigned int   depth,
           std::vector<double> &breaks)
    {
      constexpr unsigned int most   = 30;
      const double           middle = 0.5 * (a + b);
      const auto             halves = integrals(p, {a, middle, b});
      const double           error  = std::abs(integrals(p, {a, b}).first - halves.first);
      size                          = std::max(size, halves.second);
      if (error <= 1e-13 * size || (depth == most && error <= 1e-6 * size))
        {
          breaks.push_back(b);
          return;
        }
      if (depth == most || breaks.size() > 5000 || !std::isfinite(error))
        throw std::invalid_argument("the variation cannot be integrated from s = " + number_to_text(a) + " m to " +
                                    number_to_text(b) + " m: it is not finite there, or varies too fast");
      refine(p, a, middle, size, depth + 1, breaks);
      refine(p, middle, b, size, depth + 1, breaks);
    }

    /** The ends of a span, jumps and corners of @p p on it, and what refine() adds. */
    std::vector<double>
    breaks_of(const Expression &p, const Span &span)
    {
      double              size = integrals(p, {span.start, 0.5 * (span.start + span.end), span.end}).second;
      std::vector<double> breaks(1, span.start);
      while (breaks.back() < span.end)
        refine(p, breaks.back(), std::min(p.next_corner(breaks.back(), span.end), span.end), size, 0, breaks);
      return breaks;
    }
  } // namespace



  bool
  LineLoad::add_span(const Span &span)
  {
    const unsigned int n        = span.frames.size();
    AssertDimension(span.abscissae.size(), n);
    Eigen::VectorXd    weights  = Eigen::VectorXd::Zero(n), N(n);
    Eigen::MatrixXd    products = Eigen::MatrixXd::Zero(n, n);
    for (const auto &[s, ds] : composite_rule(breaks_of(variation, span), points_a_piece))
      {
        for (unsigned int a = 0; a < n; ++a)
          N(a) = lagrange(span.abscissae, a, s);
        weights += variation(s) * ds * N;
        products += variation(s) * ds * N * N.transpose();
      }
    add_part(span.frames, weights, products);
    return (weights.array() != 0).any() || (products.array() != 0).any();
  }
} // namespace samara
