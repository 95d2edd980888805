#ifndef samara_section_patches_h
#define samara_section_patches_h

#include <samara/section/section_mesh.h>

namespace samara
{
  /** n equal intervals of (0, 1). */
  std::vector<double> equal_intervals(unsigned int n);

  /**
   * A wall that is seen from outside with its thickness inwards: @p outer and @p inner are its two faces over u in (0,
   * 1), and between them lie plies of the given relative thicknesses, the outermost first. @p n cells along the wall,
   * @p per_ply through each ply.
   */
  SectionPatch wall_patch(const std::function<dealii::Point<2>(double)> &outer,
                          const std::function<dealii::Point<2>(double)> &inner,
                          unsigned int                                   n,
                          const std::vector<double>                     &thicknesses,
                          const std::vector<Ply>                        &plies,
                          unsigned int                                   per_ply = 1);

  /** @name Sections of one material, about the origin @{ */
  std::vector<SectionPatch> rectangle_patches(double width_2, double width_3, unsigned int n_2, unsigned int n_3);
  /** With half axes; n cells a side of the square that is bent to it. */
  std::vector<SectionPatch> ellipse_patches(double radius_2, double radius_3, unsigned int n);
  std::vector<SectionPatch> ring_patches(double inner, double outer, unsigned int n_around, unsigned int n_through);
  /** @} */

  /**
   * A box with one layup a wall, bottom, right, top, left, the plies from outside to inside; corners are mitred.
   * Tangents of the layers go round counter-clockwise, for who looks against axis 1.
   */
  std::vector<SectionPatch> box_patches(double                                 width_2,
                                        double                                 width_3,
                                        double                                 thickness,
                                        const std::array<std::vector<Ply>, 4> &plies,
                                        unsigned int                           n,
                                        unsigned int                           per_ply = 1);
} // namespace samara

#endif
