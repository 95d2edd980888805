#ifndef samara_loads_skeleton_h
#define samara_loads_skeleton_h

#include <samara/model/layout.h>

namespace samara
{
  /**
   * A load to copy; doc/how_to/load.md tells how. It is tested (tests/skeleton), but not in the catalogue.
   *
   * The drag of a bluff body at a point that moves with the velocity v through air with the wind w:
   *
   *     f = −½ ρ S |v_r| v_r,   v_r = v − w
   *
   * S is the drag coefficient times the area [m²]. It has no moment about the point and no potential; the work that it
   * does is counted with that of the loads. Load steps multiply f as they do all loads. Complains in initialize() about
   * a point that is not there.
   */
  class PointDrag : public Item, public Evaluated<PointDrag, Force>
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;
    void connect(Layout &layout) override;

    template <typename Number>
    void residual_at(const Point<Number> &point, Number *r) const;
    void tangent(const Point<double> &point, SparseMatrix &K) const override;
    void damping(const Point<double> &point, SparseMatrix &C) const override;

  private:
    std::string at;
    double      drag_area = 0, density = 1.225;
    Vector3     wind = Vector3::Zero();

    Frame frame;
    Block block; ///< where the forces on the frame go

    /** v_r in the axes of the frame. */
    template <typename Number>
    Vec3<Number> relative_velocity(const Point<Number> &point) const;

    /** ∂(−f)/∂v_r, both in the axes of the frame. */
    Matrix3 slope(const Point<double> &point) const;
  };

  // instantiated where the template of the class is defined
  extern template class Evaluated<PointDrag, Force>;
} // namespace samara

#endif
