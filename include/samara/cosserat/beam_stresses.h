#ifndef samara_cosserat_beam_stresses_h
#define samara_cosserat_beam_stresses_h

#include <samara/cosserat/analysed_shape.h>
#include <samara/section/recovery.h>

namespace samara
{
  /** A section that stresses at a place of a beam come from. */
  struct StressPart
  {
    StressedSection section;
    Matrix6 forces = Matrix6::Identity(); ///< its section forces under the strains of the place, from those there
  };



  /**
   * Stresses at a place of a beam from its section forces: those of the section there; or, between two stations that
   * are not of one kind, the mean by distance of what either has under the strains e = C⁻¹N of the place, C being the
   * stiffness of the beam there.
   */
  class BeamStresses
  {
  public:
    using Extremes = SectionStresses::Extremes;
    struct Part
    {
      StressPart                             of;
      std::shared_ptr<const SectionStresses> stresses;
    };

    explicit BeamStresses(const std::vector<Part> &parts)
      : parts(parts)
    {}

    /** @p forces without those of helical fibres [N, N m], @p helix as in SectionStresses. */
    Extremes extremes(const Vector6 &forces, double helix) const;

    /**
     * "its stations <root> and <tip>, ..., disagree by 35 %: ...", if the largest von Mises stresses or indices of two
     * of them differ by more than a tenth; else "".
     */
    std::string disagreement(const Vector6 &forces, double helix) const;

  private:
    std::vector<Part> parts;
  };



  /** Stresses of a shape with this curvature of the line. @throws std::invalid_argument */
  std::shared_ptr<const SectionStresses> section_stresses_of(const AnalysedShape &shape, const Vector3 &curvature);
} // namespace samara

#endif
