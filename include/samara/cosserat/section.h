#ifndef samara_cosserat_section_h
#define samara_cosserat_section_h

#include <samara/model/model.h>
#include <samara/section/trapeze.h>

#include <memory>

namespace samara
{
  /**
   * What a beam needs to know of its cross-section at one abscissa, in the section's axes: 1 along the beam's reference
   * line, 2 and 3 across.
   */
  struct SectionValues
  {
    /** Section forces (N₁ N₂ N₃ M₁ M₂ M₃) from strains (Γ₁ Γ₂ Γ₃ K₁ K₂ K₃) [N, N m, N m²]. */
    Matrix6 stiffness = Matrix6::Zero();

    /** Per length: [m I, −m c~; m c~, J], J about the reference line [kg/m, kg, kg m]. */
    Matrix6 inertia = Matrix6::Zero();

    /** Corners (y₂, y₃) of the outline that is drawn [m]. */
    std::vector<Eigen::Vector2d> outline;

    /** What tension does to torsion, if that is wanted. */
    Trapeze trapeze = {};
  };

  /** The ellipse that is drawn for a section: with the half axes given, or those of a solid one of these stiffnesses.
   */
  std::vector<Eigen::Vector2d> drawn_outline(const std::vector<double> &radii, const Matrix6 &stiffness);

  /** (1 − w) a + w b */
  SectionValues interpolate(const SectionValues &a, const SectionValues &b, double w);

  /** The same of outlines with as many corners; @p a if there are not. */
  std::vector<Eigen::Vector2d>
  interpolate(const std::vector<Eigen::Vector2d> &a, const std::vector<Eigen::Vector2d> &b, double w);



  /** What is not physical about stiffness or inertia of @p what, "section <tip>"; "" if nothing is. */
  std::string fault_of(const SectionValues &values, const std::string &what);



  class AnalysedSection;
  class AnalysedShape;
  class SectionLoft;



  /** What stresses at a place of a beam are found with. */
  struct StressedSection
  {
    std::string                          name;            ///< of the section, "root", or "root to tip"
    std::shared_ptr<const AnalysedShape> shape;           ///< never null
    bool                                 is_there = true; ///< the section of the place itself, not that of a station
    double                               weight   = 1;    ///< of its stresses; of all those at a place one in sum
  };



  /** A named cross-section that beams refer to. It adds nothing to the system by itself. */
  class Section : public Item
  {
  public:
    void initialize(Model &model) override;

    /**
     * Values at the relative abscissa @p x from 0 (start of the beam) to 1 (its end). @p curvature is the initial twist
     * and curvature (k₁ k₂ k₃) of the reference line there, in the axes of the section [rad/m].
     * @throws std::invalid_argument if there is no such section with this curvature
     */
    virtual SectionValues at(double x, const Vector3 &curvature) const = 0;

    /** The same; where there is a jump at @p x, on the side on which @p inside lies. */
    virtual SectionValues
    at_side(const double x, const double /*inside*/, const Vector3 &curvature) const
    {
      return at(x, curvature);
    }

    /** Whether at() depends on the curvature. */
    virtual bool
    depends_on_curvature() const
    {
      return false;
    }

    /** Corners (y₂, y₃) of the outline that is drawn at @p x [m]. */
    virtual std::vector<Eigen::Vector2d>
    outline(const double x) const
    {
      return at(x, Vector3::Zero()).outline;
    }

    /** This, if its stresses can be found; null if not, and of what varies along a beam. */
    virtual const AnalysedSection *
    analysed() const
    {
      return nullptr;
    }

    /**
     * What stresses at @p x are found with, at a jump on the side on which @p inside lies: the section there, or both
     * stations beside, weighted, where they are not of one kind. Empty if a beam has no stresses there.
     */
    virtual std::vector<StressedSection>
    stressed(double /*x*/, double /*inside*/) const
    {
      return {};
    }

    /**
     * The sections between this one and @p other, if their shapes are of one kind; null if they are not, and where
     * there are no shapes: then matrices are linear.
     */
    virtual std::unique_ptr<const SectionLoft> loft_to(const Section &other) const;

    /** Relative abscissae at which the values have kinks, where elements should end. */
    virtual std::vector<double>
    kinks() const
    {
      return {};
    }

    /** Whether the section says how it is rotated about axis 1. */
    virtual bool
    has_twist() const
    {
      return false;
    }

    /** That rotation, in addition to the one of the beam; at a jump on the side on which @p inside lies [rad]. */
    virtual double
    twist(const double /*x*/, const double /*inside*/) const
    {
      return 0;
    }

    /** Relative abscissae where it jumps: there an element must end. */
    virtual std::vector<double>
    jumps_of_twist() const
    {
      return {};
    }

    /** The initial twists and curvatures for which the section is known, or has been asked so far. */
    virtual std::vector<Vector3>
    curvatures() const
    {
      return std::vector<Vector3>(1, Vector3::Zero());
    }

    /** Damping that comes with the section: viscous stress is these times the rate of elastic stress [s]. */
    virtual Vector6
    damping() const
    {
      return Vector6::Zero();
    }

    /**
     * This section for a beam of that length [m]: tables may have abscissae in metres. It lives as long as this one.
     * @throws std::invalid_argument if it does not reach from the start of the beam to its end
     */
    virtual const Section &
    along(const double /*length*/) const
    {
      return *this;
    }

  protected:
    /** Complain about what is not physical. */
    virtual void check(Model &model) const;
  };



  /** Stiffnesses and masses by their engineering names, with the positions of the centres. */
  struct EngineeringConstants
  {
    double              EA = 0, GA2 = 0, GA3 = 0, GJ = 0, EI2 = 0, EI3 = 0, EI23 = 0;
    double              mass = 0, I2 = 0, I3 = 0, I23 = 0;
    std::vector<double> shear_centre = {0, 0}, tension_centre = {0, 0}, mass_centre = {0, 0};
    std::vector<double> drawn_radii; ///< half axes of the ellipse that is drawn; empty: from the stiffnesses
    double trapeze_coupling = 0, trapeze_stiffness = 0; ///< ∫E r² dA, ∫E r⁴ dA about the shear centre [N m², N m⁴]

    void          add_parameters(Parameters &prm);
    SectionValues values() const;
  };



  /**
   * Engineering constants. The axial strain of the tension centre (y₂, y₃) is Γ₁ + y₃ K₂ − y₂ K₃, the shear strains of
   * the shear centre Γ₂ − y₃ K₁ and Γ₃ + y₂ K₁; EI₂, EI₃ refer to the tension centre, GJ to the shear centre, I₂ = ∫ρ
   * y₃², I₃ = ∫ρ y₂² to the mass centre.
   */
  class EngineeringSection : public Section
  {
  public:
    void          add_parameters(Parameters &prm) override;
    SectionValues at(double x, const Vector3 &curvature) const override;

  private:
    EngineeringConstants constants;
  };



  /** Full 6×6 matrices of stiffness (or compliance) and inertia: 36 numbers by rows, or 21 of the upper triangle, or 6.
   */
  class MatrixSection : public Section
  {
  public:
    void          add_parameters(Parameters &prm) override;
    void          initialize(Model &model) override;
    SectionValues at(double x, const Vector3 &curvature) const override;

  private:
    std::vector<double> stiffness, compliance, inertia, drawn_radii, trapeze_coupling;
    double              trapeze_stiffness = 0;
    SectionValues       values;
  };
} // namespace samara

#endif
