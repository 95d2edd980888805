#ifndef samara_model_drawing_h
#define samara_model_drawing_h

#include <samara/rotation/rotation.h>

#include <array>
#include <string>
#include <vector>

namespace samara
{
  /** A point of a drawn body with what is known there. Vectors are in the inertial frame, strains in the section's. */
  struct Sample
  {
    Vector3 x            = Vector3::Zero();     ///< [m]
    Matrix3 D            = Matrix3::Identity(); ///< triad; for beams d₁ is along the axis
    Vector3 displacement = Vector3::Zero();     ///< from the reference position [m]
    Vector3 force        = Vector3::Zero();     ///< section force [N]
    Vector3 moment       = Vector3::Zero();     ///< section moment [N m]
    Vector3 strain       = Vector3::Zero();     ///< Γ₁ Γ₂ Γ₃
    Vector3 curvature    = Vector3::Zero();     ///< K₁ K₂ K₃ [1/m]
    Vector3 velocity     = Vector3::Zero();     ///< [m/s]
  };



  /**
   * A picture of the model: surfaces made of quadrilaterals, so that all of it goes into one file of one cell type.
   * Items draw themselves with the shapes below; each object gets a number by which it can be selected and
   * coloured. Quadrilaterals of one object share their points, and points share what is known of the sample they belong
   * to: the memory is in proportion to the number of points.
   */
  struct Drawing
  {
    struct Corner
    {
      Vector3      x; ///< [m]
      unsigned int sample, object;
    };
    /** Corners go round it, counter-clockwise for who looks from outside. */
    using Quad = std::array<unsigned int, 4>;

    std::vector<Sample>      samples;
    std::vector<Corner>      corners;
    std::vector<Quad>        quads;
    std::vector<std::string> objects;

    /** Everything drawn from now on belongs to this object. */
    void begin_object(const std::string &name);

    /**
     * A beam: a surface through the closed @p outlines, one outline per sample, given by points (y₂, y₃) [m] of the
     * section in the sample's triad. All outlines have the same number of points. Ends are closed.
     */
    void tube(const std::vector<Sample> &axis, const std::vector<std::vector<Eigen::Vector2d>> &outlines);

    /** A closed cylinder about the sample's axis @p axis (0, 1, 2), centred at the sample [m]. */
    void cylinder(const Sample &centre, unsigned int axis, double radius, double length);
    void sphere(const Sample &centre, double radius);
    /** Full side lengths along the sample's axes [m]. */
    void box(const Sample &centre, const Vector3 &sides);
    /** A thin bar between two points [m]. */
    void bar(const Sample &from, const Sample &to, double radius);
  };



  /** Corners of a circle, an ellipse or a rectangle for Drawing::tube(). */
  std::vector<Eigen::Vector2d> ellipse_outline(double radius_2, double radius_3, unsigned int n_points = 12);
  std::vector<Eigen::Vector2d> rectangle_outline(double width_2, double width_3);
} // namespace samara

#endif
