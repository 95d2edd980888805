#ifndef samara_report_drawn_model_h
#define samara_report_drawn_model_h

#include <samara/model/drawing.h>
#include <samara/report/array_stream.h>

namespace samara
{
  class Model;

  /**
   * What all drawings of a model share: corners in the axes of their samples, cells, names of objects. A drawing is
   * then known by the places and turns of its samples, 7 numbers each, and can be drawn with its deformation magnified:
   * the rigid motion of each body is taken away, what is left is multiplied.
   *
   * That motion goes through the places where joints hold the body. Of two and more it is the fit through these, turned
   * about a line as the sections there; of one its triad; of none the best fit to the whole body. Halves of joints go
   * with the bodies they belong to.
   */
  class DrawnModel
  {
  public:
    /** @p first with corners. @p reference: the undeformed model, drawn alike if it has as many samples and corners. */
    DrawnModel(const Model &model, const Drawing &first, const Drawing &reference);

    /** Whether a drawing shows the same objects with as many samples, corners and cells. */
    bool fits(const Drawing &drawing) const;

    std::size_t
    n_samples() const
    {
      return sample_object.size();
    }

    std::size_t
    n_objects() const
    {
      return names.size();
    }

    /** Of each sample x, y, z [m] and the unit quaternion x, y, z, w of its axes. */
    std::vector<float> motion(const Drawing &drawing) const;

    /** Of each object x, y, z [m] and the quaternion of its rigid motion since the reference: X ↦ x + R X. */
    std::vector<float> rigid_motions(const Drawing &drawing) const;

    /** Largest side of the box about the undeformed model [m]. */
    double size() const;

    /** Of each number of motion(), places [m] and quaternions [1], the largest step in which a page may count it. @{ */
    std::vector<float> steps_of_places() const;
    std::vector<float> steps_of_turns() const;
    /** @} */

    /** JSON; the arrays go into the stream. */
    std::string json(ArrayStream &stream) const;

  private:
    std::vector<float>         local; ///< three numbers a corner [m]
    std::vector<std::uint32_t> corner_sample, sample_object, quadrilaterals, lines;
    std::vector<std::string>   names, subsections, kinds;
    std::vector<const Item *>  items;    ///< that drew the objects, for drawings without names
    std::vector<int>           carriers; ///< of each sample: the object whose rigid motion it takes part in, −1: none
    std::size_t                n_cells;
    std::vector<Sample>        undeformed;
    std::vector<std::vector<unsigned int>> anchors; ///< of each object, samples that say its rigid motion
    std::vector<bool>                      is_held; ///< of each object, whether those are where joints hold it

    void find_carriers(const Model &model, const Drawing &first);
    void find_anchors(const Drawing &reference);
  };

  /**
   * The rotation R with b ≈ R a, of points without their means and triads, each triad counting as an arm of @p arm [m]:
   * it makes Σ |b − R a|² + arm² Σ |D − R D₀|² least. The identity if nothing says more.
   */
  Matrix3 fitted_rotation(const std::vector<Vector3> &a,
                          const std::vector<Vector3> &b,
                          const std::vector<Matrix3> &turns,
                          double                      arm);
} // namespace samara

#endif
