#ifndef samara_joints_rail_h
#define samara_joints_rail_h

#include <samara/model/surface_curve.h>

#include <algorithm>
#include <array>
#include <limits>

namespace samara
{
  /** A place of a rail: position x [m] and directors d_k as columns, with their derivatives by the abscissa. */
  template <typename Number>
  struct RailPlace
  {
    std::array<Vec3<Number>, 3> x; ///< x, x', x''
    std::array<Mat3<Number>, 3> d; ///< d, d', d''
  };



  /**
   * The line of a body along which something slides: at the abscissa S [m], on the piece of the body that S is in,
   *
   *     x(S) = Σ N_a(S) x_a        d_k(S) = Σ N_a(S) d_k^a
   *
   * with the frames a of the piece and the polynomials N_a of Lagrange through their abscissae: what the body itself
   * interpolates; on a curve of a shell through points that have shares of its frames (LinePiece). Both are linear in
   * the coordinates of the nodes; the d_k are not of unit length, nor normal to each other. Where two pieces meet, x is
   * continuous, and the slopes x' and d_k' have jumps [x'] that vanish as the mesh is refined. Within ε = a
   * ten-thousandth of the shorter piece on both sides of such a place S_e the slope turns steadily:
   *
   *     x(S) + φ(S) [x'],   φ = ε/4 (1 − |S − S_e|/ε)²
   *
   * has no jump of its slope, is x(S) outside, and by ε/4 [x'] off at most. What slides is turned by it, not hit, with
   * an acceleration that is steady: one step of any number of stages follows it.
   *
   * Beyond both ends of the body x and d_k go on straight, with the slopes of the end.
   */
  class Rail
  {
  public:
    static constexpr unsigned int most_frames = 49, most_points = 33;

    /** The pieces in the order of their abscissae; at least one. */
    explicit Rail(std::vector<LinePiece> pieces);

    /** Take the frames to the nodes that are left after welding. */
    void resolve(const Model &model);

    const std::vector<LinePiece> &
    pieces() const
    {
      return spans;
    }
    double
    start() const
    {
      return spans.front().start;
    }
    double
    end() const
    {
      return spans.back().end;
    }
    double
    length() const
    {
      return end() - start();
    }

    /** How far beyond an end S is [m]; 0 on the body. */
    double
    beyond(const double S) const
    {
      return std::max({S - end(), start() - S, 0.});
    }

    /** The piece that S is in; the first or the last one beyond the ends. */
    unsigned int piece_at(double S) const;

    /** Where two pieces meet: the range within which the slope turns. */
    struct Turn
    {
      double from, to;
    };
    /** Of pieces @p i and i + 1. */
    Turn turn(unsigned int i) const;

    /** N_a, N_a', N_a'' of the frames of a piece. */
    template <typename Number>
    struct Weights
    {
      unsigned int                                   piece;
      std::array<std::array<Number, most_frames>, 3> of;
    };
    /** The weights at S: of the piece that it is in, and, where slopes turn, of the other one. */
    template <typename Number>
    struct AllWeights
    {
      unsigned int                   n = 1;
      std::array<Weights<Number>, 2> parts;

      const Weights<Number> *
      begin() const
      {
        return parts.data();
      }
      const Weights<Number> *
      end() const
      {
        return parts.data() + n;
      }
    };
    template <typename Number>
    AllWeights<Number> weights(const Number &S) const;

    template <typename Number>
    RailPlace<Number> place(const AllWeights<Number> &weights, const Number *q) const;

    /** The abscissa of the nearest point to @p x, where a function tells the positions of frames. */
    template <typename Position>
    double nearest(const Position &position, const Vector3 &x) const;

    /** Position, directors and derivatives from functions that tell positions and triads of frames. */
    template <typename Position, typename Triad>
    RailPlace<double> place_of(const Position &position, const Triad &triad, double S) const;

    /** Where the directors before and behind an end of two pieces differ: its abscissa; NaN if nowhere. Only
     * @p n of them are looked at. */
    double first_corner(const Model &model, unsigned int n) const;

  private:
    std::vector<LinePiece> spans;

    template <typename Number>
    Weights<Number> of_piece(unsigned int piece, const Number &S) const;
    /** Add φ [x'] where pieces @p i and i + 1 meet. */
    template <typename Number>
    void turn_slope(unsigned int i, const Number &S, AllWeights<Number> &weights) const;
    template <typename Number, typename Position, typename Triad>
    RailPlace<Number> place_with(const AllWeights<Number> &weights, const Position &position, const Triad &triad) const;
  };



  template <typename Number>
  Rail::Weights<Number>
  Rail::of_piece(const unsigned int piece, const Number &S) const
  {
    const LinePiece                               &span = spans[piece];
    const std::vector<double>                     &s    = span.abscissae;
    std::array<std::array<Number, most_points>, 3> L;
    Weights<Number>                                result;
    result.piece = piece;
    for (unsigned int a = 0; a < s.size(); ++a)
      {
        Number value(1), slope(0), curvature(0);
        for (unsigned int b = 0; b < s.size(); ++b)
          if (b != a)
            {
              const double g = 1 / (s[a] - s[b]);
              const Number f = (S - s[b]) * g;
              curvature      = curvature * f + 2. * g * slope;
              slope          = slope * f + g * value;
              value          = value * f;
            }
        L[0][a] = value;
        L[1][a] = slope;
        L[2][a] = curvature;
      }
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int a = 0; a < span.frames.size(); ++a)
        if (span.shares.size() == 0)
          result.of[i][a] = L[i][a];
        else
          {
            result.of[i][a] = 0;
            for (unsigned int k = 0; k < s.size(); ++k)
              result.of[i][a] += span.shares(a, k) * L[i][k];
          }
    return result;
  }



  template <typename Number>
  void
  Rail::turn_slope(const unsigned int i, const Number &S, AllWeights<Number> &weights) const
  {
    const double S_e = spans[i].end, epsilon = 0.5 * (turn(i).to - turn(i).from);
    const double side = std::real(S) < S_e ? -1. : 1.;
    const Number t    = (S - S_e) / epsilon * side; // its size
    const std::array<Number, 3> phi = {
      {0.25 * epsilon * (1. - t) * (1. - t), -0.5 * side * (1. - t), Number(0.5 / epsilon)}};
    weights.n                            = 2;
    weights.parts[1].piece               = weights.parts[0].piece == i ? i + 1 : i;
    const unsigned int n                 = spans[weights.parts[1].piece].frames.size();
    for (auto &values : weights.parts[1].of)
      std::fill_n(values.begin(), n, Number(0));
    for (Weights<Number> &part : weights.parts)
      {
        const Weights<double> at_end = of_piece<double>(part.piece, S_e);
        const double          sign   = part.piece == i ? -1. : 1.;
        for (unsigned int k = 0; k < 3; ++k)
          for (unsigned int a = 0; a < spans[part.piece].frames.size(); ++a)
            part.of[k][a] += sign * at_end.of[1][a] * phi[k];
      }
  }



  template <typename Number>
  Rail::AllWeights<Number>
  Rail::weights(const Number &S) const
  {
    const double       real  = std::real(S);
    const unsigned int piece = piece_at(real);
    AllWeights<Number> result;
    if (beyond(real) > 0)
      {
        const Number at        = real > end() ? end() : start();
        Weights<Number> &part  = result.parts[0];
        part                   = of_piece(piece, at);
        for (unsigned int a = 0; a < spans[piece].frames.size(); ++a)
          {
            part.of[0][a] += part.of[1][a] * (S - at);
            part.of[2][a] = 0;
          }
        return result;
      }
    result.parts[0] = of_piece(piece, S);
    if (piece > 0 && real < turn(piece - 1).to)
      turn_slope(piece - 1, S, result);
    else if (piece + 1 < spans.size() && real > turn(piece).from)
      turn_slope(piece, S, result);
    return result;
  }



  template <typename Number>
  RailPlace<Number>
  Rail::place(const AllWeights<Number> &weights, const Number *q) const
  {
    return place_with<Number>(
      weights, [&](const Frame &f) { return f.position(q); }, [&](const Frame &f) { return f.triad(q); });
  }



  template <typename Number, typename Position, typename Triad>
  RailPlace<Number>
  Rail::place_with(const AllWeights<Number> &weights, const Position &position, const Triad &triad) const
  {
    RailPlace<Number> result;
    for (unsigned int i = 0; i < 3; ++i)
      {
        result.x[i].setZero();
        result.d[i].setZero();
      }
    for (const Weights<Number> &part : weights)
      {
        const std::vector<Frame> &frames = spans[part.piece].frames;
        for (unsigned int a = 0; a < frames.size(); ++a)
          {
            const Vec3<Number> x = position(frames[a]);
            const Mat3<Number> D = triad(frames[a]);
            for (unsigned int i = 0; i < 3; ++i)
              {
                result.x[i] += part.of[i][a] * x;
                result.d[i] += part.of[i][a] * D;
              }
          }
      }
    return result;
  }



  template <typename Position, typename Triad>
  RailPlace<double>
  Rail::place_of(const Position &position, const Triad &triad, const double S) const
  {
    return place_with<double>(weights(S), position, triad);
  }



  template <typename Position>
  double
  Rail::nearest(const Position &position, const Vector3 &x) const
  {
    // the nearest of many points, from there Newton's method on (x(S) − x)·x'(S) = 0, not beyond the ends
    constexpr unsigned int samples = 40, most_steps = 30;
    const auto             no_axes = [](const Frame &) { return Matrix3::Zero(); };
    double                 best = start(), least = std::numeric_limits<double>::infinity();
    for (const LinePiece &span : spans)
      for (unsigned int i = 0; i <= samples; ++i)
        {
          const double S        = span.start + (span.end - span.start) * i / samples;
          const double distance = (place_of(position, no_axes, S).x[0] - x).squaredNorm();
          if (distance < least)
            {
              least = distance;
              best  = S;
            }
        }
    for (unsigned int i = 0; i < most_steps; ++i)
      {
        const auto    at       = place_of(position, no_axes, best);
        const Vector3 from_x   = at.x[0] - x;
        const double  slope    = at.x[1].squaredNorm() + from_x.dot(at.x[2]);
        const double  step     = from_x.dot(at.x[1]) / (slope > 0 ? slope : at.x[1].squaredNorm());
        const double  next     = std::min(std::max(best - step, start()), end());
        const double  distance = (place_of(position, no_axes, next).x[0] - x).squaredNorm();
        if (!(distance < least) && i > 0)
          break;
        least = distance;
        best  = next;
      }
    return best;
  }
} // namespace samara

#endif
