#ifndef samara_section_shape_between_h
#define samara_section_shape_between_h

#include <samara/section/shapes.h>

#include <optional>

namespace samara
{
  /**
   * The shape at the share @p w of the way from @p a, 0, to @p b, 1, where straight lines lead from each point of a to
   * that of b with the same parameters: a ruled solid, so that a rectangle stays one and a wall its plies. Where one of
   * them has more cells in a row of one ply, so many there are.
   *
   * Nothing, if they are not of one kind: patches, their names or plies, or materials differ, or layers of a patch have
   * a direction of their own.
   */
  std::optional<SectionShape> shape_between(const SectionShape &a, const SectionShape &b, double w);
} // namespace samara

#endif
