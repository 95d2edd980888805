#ifndef samara_model_surface_load_h
#define samara_model_surface_load_h

#include <samara/model/surface.h>

namespace samara
{
  /** What presses, pulls or rubs on a surface at a time: a force per area. */
  struct SurfaceTraction
  {
    double  pressure  = 0;               ///< per deformed area, along its normal [Pa]
    Vector3 dead      = Vector3::Zero(); ///< per area of the reference surface, inertial components [Pa]
    Vector3 following = Vector3::Zero(); ///< the same along the axes of the surface [Pa]

    /**
     * Per area of the reference surface, inertial components, where the surface has these @p axes and its deformed area
     * vector over the area of the reference surface is @p area.
     */
    Vector3
    at(const Matrix3 &axes, const Vector3 &area) const
    {
      return pressure * area + dead + axes * following;
    }
  };



  /** A load that acts evenly on the surface of a body: the body has to know it to tell the stresses below it. */
  class SurfaceLoad
  {
  public:
    virtual ~SurfaceLoad() = default;

    /** The body; null if there is none. */
    virtual const SurfaceBody *loaded_body() const = 0;

    /** Its region, "" for all of it. */
    virtual const std::string &loaded_region() const = 0;

    virtual SurfaceTraction traction(const Point<double> &point) const = 0;
  };
} // namespace samara

#endif
