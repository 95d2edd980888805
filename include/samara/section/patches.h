#ifndef samara_section_patches_h
#define samara_section_patches_h

#include <samara/section/section_mesh.h>

namespace samara
{
  /** n equal intervals of (0, 1). */
  std::vector<double> equal_intervals(unsigned int n);

  /** @name Sections of one material, about the origin @{ */
  std::vector<SectionPatch> rectangle_patches(double width_2, double width_3, unsigned int n_2, unsigned int n_3);
  /** With half axes; n cells a side of the square that is bent to it. */
  std::vector<SectionPatch> ellipse_patches(double radius_2, double radius_3, unsigned int n);
  std::vector<SectionPatch> ring_patches(double inner, double outer, unsigned int n_around, unsigned int n_through);
  /** @} */
} // namespace samara

#endif
