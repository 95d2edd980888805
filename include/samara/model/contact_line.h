#ifndef samara_model_contact_line_h
#define samara_model_contact_line_h

#include <samara/model/model.h>

#include <optional>

namespace samara
{
  /** A frame, and its part of a place x = Σ w_a x_a. */
  struct WeightedFrame
  {
    Frame  frame;
    double weight;
  };



  /** The line of a beam, polynomials through its nodes, and the radius of what is around it. */
  struct ContactLine
  {
    std::vector<Span> spans;
    double            radius; ///< [m]
    const Item       *body;
    std::string       name;
    unsigned int      likeness = 0; ///< of the body, for the laws

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

    /** A place on it: the piece, and the arc length in the reference configuration. */
    struct Place
    {
      unsigned int piece;
      double       s;
    };

    /** Position, and derivatives by s. */
    struct Local
    {
      Vector3 x, slope, curvature;
    };
    Local local(const Place &place, const double *q) const;

    /** The frames of a place, appended; in @p slopes what the weights grow by per way along the line [1/m]. */
    void
    add_frames(const Place &place, std::vector<WeightedFrame> &frames, std::vector<double> *slopes = nullptr) const;
  };



  /** Two lines, or a point in place of the first. */
  struct LinesOrPoint
  {
    const ContactLine *b; ///< null: a point
    Vector3            point;
    const ContactLine *a;
  };

  /** Places whose distance is locally the least. */
  struct NearestPlaces
  {
    ContactLine::Place b{0, 0}, a{0, 0};
    double             distance = 0; ///< [m]
    bool is_parallel = false;        ///< along so nearly parallel lines (0.01 rad) that the places are not determined

    /**
     * Inverse of the second derivatives of ½ d² by the arc lengths of b and a: the places go by minus that times what
     * the first ones change by when lines move. Zero of those that are held, and where they are not determined.
     */
    Eigen::Matrix2d inverse = Eigen::Matrix2d::Zero();
  };

  /**
   * The places nearest to each other, by Newton's method from these; they may go over to other pieces, and stop at the
   * ends. Nothing if it does not find a minimum.
   */
  std::optional<NearestPlaces> nearest_places(const LinesOrPoint &lines, NearestPlaces from, const double *q);
} // namespace samara

#endif
