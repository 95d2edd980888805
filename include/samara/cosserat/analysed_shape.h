#ifndef samara_cosserat_analysed_shape_h
#define samara_cosserat_analysed_shape_h

#include <samara/cosserat/section.h>
#include <samara/section/cross_section.h>
#include <samara/section/shapes.h>

namespace samara
{
  /** @throws std::invalid_argument if there is no mesh of the shape: a cell is turned inside out, ... */
  std::unique_ptr<SectionMesh> mesh_of(const SectionShape &shape, unsigned int degree);



  /** A section with its mesh, warping and stresses. */
  struct SectionAnalysis
  {
    /** @throws std::invalid_argument saying what is wrong with the shape, the materials or the curvature */
    SectionAnalysis(const SectionShape &shape, unsigned int degree, const Vector3 &curvature);

    const SectionShape                       shape;
    const std::unique_ptr<const SectionMesh> own_mesh;
    const SectionMesh                       &mesh;
    const CrossSection                       section;
  };



  /**
   * A shape in the axes of a beam, and how it is analysed. Values are kept for the whole program, by what the section
   * consists of and by curvature.
   */
  class AnalysedShape
  {
  public:
    /** @p has_trapeze: whether tension stiffens torsion; @p sees_curvature: or the line is taken for straight. */
    AnalysedShape(const SectionShape &shape, unsigned int degree, bool has_trapeze, bool sees_curvature);

    const SectionShape shape;
    const unsigned int degree;
    const bool         has_trapeze, sees_curvature;

    /** @p curvature (k₁ k₂ k₃) without round-off, or zero if it is not seen [rad/m]. */
    Vector3 seen(const Vector3 &curvature) const;

    /** @throws std::invalid_argument as SectionAnalysis does */
    SectionValues values(const Vector3 &curvature) const;

    /** With stresses. @throws std::invalid_argument */
    std::unique_ptr<SectionAnalysis> analyse(const Vector3 &curvature, unsigned int more_degrees = 0) const;

  private:
    double      size = 0; ///< largest distance from the reference line [m]
    std::string content;  ///< of all that the values depend on but for the curvature, as a key
  };
} // namespace samara

#endif
