#ifndef samara_section_shapes_h
#define samara_section_shapes_h

#include <samara/section/material.h>
#include <samara/section/patches.h>

namespace samara
{
  /** A cross-section before it is analysed: its parts, what they are made of, and how it is drawn. */
  struct SectionShape
  {
    std::vector<SectionPatch>    patches;
    std::vector<SectionMaterial> materials;
    std::vector<Eigen::Vector2d> outline;    ///< of what is drawn of a beam, counter-clockwise [m]
    double                       finest = 0; ///< the smallest length that matters, for points that are one [m]
  };

  /** A layer of a wall; the first one of a wall is the outermost. */
  struct WallPly
  {
    unsigned int material;
    double       angle;     ///< [rad], see Ply
    double       thickness; ///< [m]
  };
  using Wall = std::vector<WallPly>;

  double thickness_of(const Wall &wall);

  /** How fine the mesh is. */
  struct Fineness
  {
    unsigned int along   = 8; ///< cells along the longest wall, at least two along the others
    unsigned int per_ply = 1; ///< cells through each ply
  };

  /**
   * Straight walls from corner to corner, the corners being those of the outer faces; a wall lies on the left of the
   * way from its first corner to its second, and walls that meet are mitred. A ring of walls if there are as many walls
   * as corners, a chain if there is one less. All walls have their plies at the same relative depths, where one of them
   * has: cells are cut there in all.
   *
   * @throws std::invalid_argument if a wall is longer on one face than it can be: too thick for its length.
   */
  std::vector<SectionPatch>
  wall_patches(const std::vector<dealii::Point<2>> &corners, const std::vector<Wall> &walls, const Fineness &fineness);

  /** A circular ring of one wall. */
  std::vector<SectionPatch> ring_patches(double outer_radius, const Wall &wall, const Fineness &fineness);

  /** Plies on one another along axis 3, the first one lowest; centred at the origin. */
  std::vector<SectionPatch> strip_patches(double width_2, const Wall &wall, const Fineness &fineness);

  /**
   * An I, centred between the outer faces of the flanges, web on axis 3: lower and upper flange of their own widths,
   * plies from outside to inside; plies of the web from the side of −2 to that of +2.
   *
   * @throws std::invalid_argument if the web is thicker than a flange is wide, or the flanges overlap
   */
  std::vector<SectionPatch> I_patches(double                       height,
                                      const std::array<double, 2> &widths,
                                      const std::array<Wall, 2>   &flanges,
                                      const Wall                  &web,
                                      const Fineness              &fineness);
} // namespace samara

#endif
