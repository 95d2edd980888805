#ifndef samara_section_airfoil_outline_h
#define samara_section_airfoil_outline_h

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace samara
{
  /** A cubic spline through points of the plane, twice continuously differentiable in the sum of the chords. */
  class PlaneSpline
  {
  public:
    /** Two points at least; at the ends the third derivative is zero. */
    explicit PlaneSpline(const std::vector<dealii::Point<2>> &points);

    double
    length() const
    {
      return s.back();
    }

    /** Derivative number @p order, 0 to 2, with respect to the sum of chords. */
    dealii::Point<2> at(double s, unsigned int order = 0) const;

  private:
    std::vector<double>           s;
    std::vector<dealii::Point<2>> x, second;
  };



  /**
   * The outline of an airfoil in the plane (y₂, y₃) of a section: nose towards +2, upper side towards +3, run through
   * counter-clockwise, from the trailing edge along the lower side round the nose and back along the upper side.
   * Splines end at kinks of more than 30° behind 5 % of the chord.
   *
   * A point is named by its side and x/c, from 0 at the nose to 1 at the trailing edge.
   */
  class AirfoilOutline
  {
  public:
    /**
     * @param points (x/c, y/c) from the trailing edge to the nose and back, in either direction
     * @param chord [m]
     * @param origin x/c of what is to be the origin of the section
     * @throws std::invalid_argument if this is no airfoil: too few points, not from 0 to 1, sides that turn back or
     * that cross, an edge at the nose
     */
    AirfoilOutline(std::vector<dealii::Point<2>> points, double chord, double origin);

    const double chord; ///< [m]

    /** Place at s from 0 to length() [m]. */
    dealii::Point<2> place(double s) const;
    /**
     * The direction inwards, of length one but at kinks, where it ends on the bisector, and in folds: depth is across
     * the sides.
     */
    dealii::Point<2> inwards(double s) const;
    /** Above zero where the outline is convex [1/m]. */
    double curvature(double s) const;

    double length() const;
    double
    nose() const
    {
      return s_nose;
    }

    /** s of the point on the @p upper or lower side. */
    double at(bool upper, double x) const;
    double x_of(const dealii::Point<2> &place) const;

    /** s of the kinks. */
    const std::vector<double> &
    kinks() const
    {
      return ends_within;
    }

    /** Of the trailing edge; zero: sharp [m]. What is below 1e-4 of the chord is closed. */
    double trailing_edge() const;

    /** Where a wall is thicker than the outline is round, and the line at its depth runs back and crosses itself. */
    struct Fold
    {
      double from, to;    ///< s within which depth leans
      double last, first; ///< s of the outline's points in front and behind that have one inner face's corner
      double corner;      ///< s of what leads to the corner of the inner face
      double thickness;   ///< of the wall [m]
      double part; ///< length of the inner face, of that of the outline, from one to the other; below least_part: none
    };
    /** The least part of its length on the outline that a cell keeps on the inner face of a fold. */
    static constexpr double least_part = 0.1;

    /** The fold about @p tightest, where the outline turns most, of a wall that reaches from @p a to @p b. */
    Fold find_fold(double a, double b, double tightest, double thickness) const;
    /**
     * From now on depth leans in @p fold: at its thickness it reaches the points of the inner face, which are as far
     * from the outline, in even steps; what runs back is left out. Between, depths are less by the square of the angle
     * by which it leans, times 1 − thickness × curvature.
     */
    void add_fold(const Fold &fold);

  private:
    /** A fold, and s of the points of its inner face whose distances along it are even. */
    struct EvenFold
    {
      Fold                fold;
      std::vector<double> before, behind; ///< from the beginning to the corner, from there to the end
    };
    std::vector<EvenFold> folds;

    /** Without folds. */
    dealii::Point<2>         across(double s) const;
    dealii::Point<2>         of_inner_face(const EvenFold &even, double s) const;
    double                   origin;
    std::vector<PlaneSpline> pieces;
    std::vector<double>      starts, ends_within;
    std::vector<double>      turn; ///< at the end of each piece but the last, tan of half the angle
    double                   s_nose = 0;

    unsigned int piece_at(double s) const;
    void         find_nose();
    void         check() const;
  };



  /** @name Points of an airfoil, (x/c, y/c), from the trailing edge along the upper side round the nose and back @{ */

  /**
   * By the digits of NACA's four-digit series, as "2418"; its trailing edge is blunt, 0.21 % of the chord a 10 % of
   * thickness. With @p sharp the last coefficient of the thickness is such that it is closed, −0.1036.
   *
   * Source: Jacobs, Ward & Pinkerton, NACA Report 460 (1933). @throws std::invalid_argument if they are no such digits
   */
  std::vector<dealii::Point<2>> naca_points(const std::string &digits, bool sharp);

  /**
   * From a file with two numbers a line, x/c and y/c; lines of words at the beginning, and what stands behind # or !,
   * are left out. From the trailing edge round the nose and back, or (a first line with the numbers of points) each
   * side from the nose to the trailing edge.
   *
   * @throws std::invalid_argument naming file and line
   */
  std::vector<dealii::Point<2>> read_airfoil(const std::string &file);
  /** @} */
} // namespace samara

#endif
