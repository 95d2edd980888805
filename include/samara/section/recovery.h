#ifndef samara_section_recovery_h
#define samara_section_recovery_h

#include <samara/section/cross_section.h>

namespace samara
{
  /**
   * How near a stress is to failure: the load over the load at which the criterion is met, all stresses in proportion.
   * One means failure. Negative: the strengths that the criterion needs are not all known.
   */
  struct FailureIndices
  {
    double max_stress = -1; ///< the largest of stress over strength; tension, pressure and shear, those that are known
    double tsai_wu    = -1; ///< Tsai & Wu 1971, F₁₂ = −½√(F₁₁F₂₂) and likewise for 13 and 23
    double hashin     = -1; ///< Hashin 1980, the largest of fibre and matrix, tension and pressure
    double von_mises  = -1; ///< von Mises' stress over the yield stress

    /** The largest that is known. */
    double largest() const;
  };

  /** @p stress in the axes of the material, Voigt order 11 22 33 23 13 12 [Pa]. */
  FailureIndices failure_indices(const Strengths &strengths, const Vector6 &stress);

  /** [Pa] */
  double von_mises_stress(const Vector6 &stress);



  /** Stresses of a section in the axes of its materials, on the faces of its cells too, from section forces. */
  class SectionStresses
  {
  public:
    SectionStresses(const CrossSection                 &section,
                    const SectionMesh                  &mesh,
                    const std::vector<SectionMaterial> &materials);

    /** What is largest over the points, each by itself. */
    struct Extremes
    {
      Vector6        stress = Vector6::Zero(); ///< of the largest modulus, with its sign; axes of the material [Pa]
      double         von_mises_stress = 0;     ///< [Pa]
      FailureIndices indices;

      /** Of one point more; @p stress in the axes of the material. */
      void add(const Strengths &strengths, const Vector6 &stress);
      /** Of other points. */
      void add(const Extremes &others);
    };
    /** @p helix: K₁²/2 where the section has a Trapeze [1/m²]. */
    Extremes extremes(const Vector6 &forces, double helix = 0) const;

  private:
    struct Point
    {
      Matrix6      stress; ///< in the axes of the material, of unit section forces
      Vector6      helix;  ///< the same of K₁²/2 [Pa m²]
      unsigned int material;
    };
    std::vector<Point>     points;
    std::vector<Strengths> strengths;
  };

  /**
   * The mean of what is largest in several sections, with weights of sum one: of moduli, with the sign of the one that
   * counts most. An index that one of them does not know is not known.
   */
  SectionStresses::Extremes mean_of(const std::vector<std::pair<double, SectionStresses::Extremes>> &weighted);
} // namespace samara

#endif
