#include <samara/joints/rail.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace samara
{
  Rail::Rail(std::vector<LinePiece> pieces)
    : spans(std::move(pieces))
  {
    Assert(!spans.empty(), dealii::ExcMessage("A rail has one piece at least."));
    for ([[maybe_unused]] const LinePiece &span : spans)
      {
        AssertIndexRange(span.frames.size(), most_frames + 1);
        AssertIndexRange(span.abscissae.size(), most_points + 1);
        Assert(span.shares.size() == 0 ? span.frames.size() == span.abscissae.size() :
                                         span.frames.size() * span.abscissae.size() == std::size_t(span.shares.size()),
               dealii::ExcMessage("A point of a rail is a frame, or has shares of all of them."));
      }
  }



  void
  Rail::resolve(const Model &model)
  {
    for (LinePiece &span : spans)
      for (Frame &frame : span.frames)
        frame = model.resolved(frame);
  }



  unsigned int
  Rail::piece_at(const double S) const
  {
    const auto after = std::upper_bound(spans.begin(), spans.end(), S, [](const double s, const LinePiece &span) {
      return s < span.end;
    });
    return std::min<std::size_t>(after - spans.begin(), spans.size() - 1);
  }



  Rail::Turn
  Rail::turn(const unsigned int i) const
  {
    constexpr double half_width = 1e-4;
    const double     end        = spans[i].end;
    const double     epsilon    = half_width * std::min(end - spans[i].start, spans[i + 1].end - end);
    return {end - epsilon, end + epsilon};
  }



  double
  Rail::first_corner(const Model &model, const unsigned int n) const
  {
    constexpr double rounding = 1e-9;
    for (unsigned int i = 0; i + 1 < spans.size(); ++i)
      {
        // the frame at which a piece ends is not the last one of all elements
        const auto at = [&](const Span &span, const double s) {
          const auto nearer = [&](const double a, const double b) { return std::abs(a - s) < std::abs(b - s); };
          const auto it     = std::min_element(span.abscissae.begin(), span.abscissae.end(), nearer);
          return Matrix3(model.triad(span.frames[it - span.abscissae.begin()]));
        };
        const Matrix3 before = at(spans[i], spans[i].end), behind = at(spans[i + 1], spans[i + 1].start);
        if ((before - behind).leftCols(n).norm() > rounding)
          return spans[i].end;
      }
    return std::numeric_limits<double>::quiet_NaN();
  }
} // namespace samara
