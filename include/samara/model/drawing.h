#ifndef samara_model_drawing_h
#define samara_model_drawing_h

#include <samara/model/field.h>
#include <samara/model/state.h>

#include <array>
#include <deque>
#include <functional>
#include <string>
#include <vector>

namespace samara
{
  class Model;
  class Item;
  struct Frame;

  /** Where something drawn is and how it moves there. Vectors are in the inertial frame. */
  struct Sample
  {
    Vector3 x            = Vector3::Zero();     ///< [m]
    Matrix3 D            = Matrix3::Identity(); ///< triad; for beams d₁ is along the axis
    Vector3 displacement = Vector3::Zero();     ///< from the reference position [m]
    Vector3 velocity     = Vector3::Zero();     ///< [m/s]
    Vector3 spin         = Vector3::Zero();     ///< angular velocity [rad/s]
    int     node         = -1;                  ///< of the model, that it is rigidly attached to; −1: none
  };



  /**
   * A picture of the model: points, lines and quadrilaterals with fields, all in one file. Items draw themselves, with
   * solid shapes or as patches; each object gets a number by which it can be selected and coloured.
   *
   * What is known is known at samples: their displacements and velocities, and fields by name, see field(). Corners are
   * the points of the picture. The corners of a solid shape are more than its samples, and show what is known there:
   * the memory is in proportion to the number of points.
   */
  struct Drawing
  {
    /**
     * What is kept of what is drawn. A motion on a page has the corners, cells and names of its first picture: of the
     * others samples do. Items draw alike whatever is kept, so that drawings of one model have equal counts.
     */
    enum class Content
    {
      everything,
      samples, ///< with fields at them; of corners, cells and objects their numbers
      places   ///< the same without fields, for differences of two drawings
    };

    /** @p model: for sample(); the others do without. */
    explicit Drawing(const Model *model = nullptr, const Content content = Content::everything)
      : model(model)
      , content(content)
    {}

    struct Corner
    {
      Vector3      x; ///< [m]
      unsigned int sample, object;
    };

    /**
     * A point, a line or a quadrilateral. The corners of a quadrilateral go round it; those of solid shapes
     * counter-clockwise for who looks from outside.
     */
    struct Cell
    {
      unsigned int                dimension; ///< 0, 1, 2
      std::array<unsigned int, 4> corners;   ///< the first n_corners()

      unsigned int
      n_corners() const
      {
        return 1u << dimension;
      }
    };

    std::vector<Sample>      samples;
    std::vector<Corner>      corners;
    std::vector<Cell>        cells;
    std::vector<std::string> objects;
    std::vector<const Item *> items; ///< that drew them, one an object, or fewer; set by System::draw()
    std::deque<Field>        fields; ///< a deque, so that those who fill one may ask for another

    /** Where joints hold bodies: not drawn. What moves rigidly with a body is seen from there. */
    std::vector<Sample> attachments;

    /** How many there are, kept or not. @{ */
    std::size_t
    n_corners() const
    {
      return corners.size() + corners_left_out;
    }

    std::size_t
    n_cells() const
    {
      return cells.size() + cells_left_out;
    }

    std::size_t
    n_objects() const
    {
      return objects.size() + objects_left_out;
    }
    /** @} */

    /** Whether names, corners and cells are kept. */
    bool
    has_corners() const
    {
      return content == Content::everything;
    }

    /** Whether fields are kept; who needs long to evaluate one asks. */
    bool
    has_fields() const
    {
      return content != Content::places;
    }

    /** What a drawing with this content would have kept of this one. */
    Drawing only(Content content) const;

    /** Count corners and cells that are not kept; whether that is so, and they need not be made. */
    bool leaves_out(std::size_t n_corners, std::size_t n_cells);

    /** Everything drawn from now on belongs to this object. */
    void begin_object(const std::string &name);

    /** A frame of a body is held here; see attachments. */
    void attach(const Frame &frame, const State &state);

    /** A frame as it is, and how it moves, in a state of the model. */
    Sample sample(const Frame &frame, const State &state) const;

    /** Where the samples and cells of a patch or shape begin: its i-th sample is number first_sample + i. */
    struct Place
    {
      unsigned int first_sample, first_cell;
    };

    /** @name Patches, whose corners are their samples. All are open, and seen from both sides. @{ */
    /** Cells of one dimension between @p of_patch: 2^dimension numbers of samples for each, counted from 0. */
    Place patch(unsigned int dimension, const std::vector<Sample> &of_patch, const std::vector<unsigned int> &cells);
    /**
     * The nodes of an element of order p, (p + 1)² of them, or any other grid of n_1 × n_2 samples, those along
     * direction 1 next to each other, as (n_1 − 1)(n_2 − 1) quadrilaterals; as n_1 − 1 lines if n_2 is 1; as a point
     * if n_1 is 1, too.
     */
    Place grid(unsigned int n_1, unsigned int n_2, const std::vector<Sample> &nodes);
    /** @} */

    /** @name Solid shapes @{ */
    /**
     * A beam: a surface through the closed @p outlines, one outline per sample, given by points (y₂, y₃) [m] of the
     * section in the sample's triad. There are two samples at least, and all outlines have the same number of points.
     * Ends are closed.
     */
    Place tube(const std::vector<Sample> &axis, const std::vector<std::vector<Eigen::Vector2d>> &outlines);

    /** The same with an outline asked for only where corners are kept; of the first its number of points counts. */
    Place tube(const std::vector<Sample>                                               &axis,
               const std::function<std::vector<Eigen::Vector2d>(const unsigned int i)> &outline);

    /** A closed cylinder about the sample's axis @p axis (0, 1, 2), centred at the sample [m]. */
    void cylinder(const Sample &centre, unsigned int axis, double radius, double length);
    void sphere(const Sample &centre, double radius);
    /** Full side lengths along the sample's axes [m]. */
    void box(const Sample &centre, const Vector3 &sides);
    /** A thin bar between two points [m]. */
    void bar(const Sample &from, const Sample &to, double radius);
    /** @} */

    /**
     * The field of this name at samples, or on cells; made if there is none. Fill it by Field::set(); where nothing is
     * set it is not a number. Objects of different kinds share fields by asking for the same one.
     *
     * @throws dealii::ExcMessage if there is one of that name with another unit or other components: two things would
     * be one in the picture.
     */
    Field &field(const std::string              &name,
                 const std::string              &unit,
                 const std::vector<std::string> &components  = {},
                 bool                            is_on_cells = false);

  private:
    const Model *model;
    Content      content;
    std::size_t  corners_left_out = 0, cells_left_out = 0, objects_left_out = 0;
  };



  /** Corners of a circle, an ellipse or a rectangle for Drawing::tube(). */
  std::vector<Eigen::Vector2d> ellipse_outline(double radius_2, double radius_3, unsigned int n_points = 12);
  std::vector<Eigen::Vector2d> rectangle_outline(double width_2, double width_3);
} // namespace samara

#endif
