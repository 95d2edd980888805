#ifndef samara_cosserat_section_kinds_h
#define samara_cosserat_section_kinds_h

#include <samara/cosserat/analysed_section.h>
#include <samara/model/remarks.h>

namespace samara
{
  /**
   * A shape that has a closed form for an isotropic material given by E, ν and density, and is analysed if a material
   * or a layup is named instead.
   */
  class ClosedFormSection : public AnalysedSection, public HasRemarks
  {
  public:
    /** That an analysis has other shear factors, and which, where that makes a difference. */
    std::vector<Remark> remarks() const override;

    void                         add_parameters(Parameters &prm) override;
    void                         initialize(Model &model) override;
    SectionValues                at(double x, const Vector3 &curvature) const override;
    std::vector<Eigen::Vector2d> outline(double x) const override;
    bool                         is_analysed() const override;

    std::unique_ptr<const SectionLoft> loft_to(const Section &other) const override;

  protected:
    double      E = 0, nu = 0.3, density = 0, shear_factor;
    std::string material, layup;

    explicit ClosedFormSection(const double shear_factor)
      : shear_factor(shear_factor)
    {}

    /** What concerns G, shear factors and density is done by the caller of this. */
    virtual SectionValues closed_form() const = 0;

    /** Shear factors 2 and 3 of the energy of the warping in Saint-Venant's flexure, as the analysis has them. */
    virtual std::array<double, 2> shear_factors_of_energy() const = 0;

    /** closed_form() between this and @p other of the same kind, lengths and material linear; null if there is none. */
    virtual std::unique_ptr<const SectionLoft> loft_in_closed_form(const ClosedFormSection &other) const = 0;

    /** Material, factors and effects of this, in part those of @p other. */
    void mix(const ClosedFormSection &a, const ClosedFormSection &b, double w);

  private:
    mutable std::vector<Eigen::Vector2d> drawn; ///< the outline, once it has been asked for: a beam does at each sample
  };



  /**
   * A solid rectangle, or a strip of plies stacked along axis 3. In closed form: Saint-Venant torsion constant, shear
   * factor 5/6.
   */
  class RectangularSection : public ClosedFormSection
  {
  public:
    RectangularSection();
    void add_parameters(Parameters &prm) override;

  private:
    double width_2 = 0, width_3 = 0;

    SectionValues                      closed_form() const override;
    std::array<double, 2>              shear_factors_of_energy() const override;
    std::unique_ptr<const SectionLoft> loft_in_closed_form(const ClosedFormSection &other) const override;
    SectionShape                       make_shape(Model &model) override;
  };



  /** A circular tube (or rod); in closed form with the shear factor of Cowper (1966). */
  class TubularSection : public ClosedFormSection
  {
  public:
    TubularSection();
    void add_parameters(Parameters &prm) override;

  private:
    double outer = 0, inner = 0;

    void                               check(Model &model) const override;
    SectionValues                      closed_form() const override;
    std::array<double, 2>              shear_factors_of_energy() const override;
    std::unique_ptr<const SectionLoft> loft_in_closed_form(const ClosedFormSection &other) const override;
    SectionShape                       make_shape(Model &model) override;
  };



  /** A solid ellipse of one material. */
  class EllipticSection : public AnalysedSection
  {
  public:
    void add_parameters(Parameters &prm) override;

  private:
    std::string material;
    double      radius_2 = 0, radius_3 = 0;

    SectionShape make_shape(Model &model) override;
  };



  /** A hollow rectangle with four walls, mitred at the corners; origin in the middle of the outer faces. */
  class BoxSection : public AnalysedSection
  {
  public:
    void add_parameters(Parameters &prm) override;

  private:
    std::string                material, layup;
    std::array<std::string, 4> layups; ///< bottom, right, top, left
    double                     width_2 = 0, width_3 = 0, thickness = 0;

    SectionShape make_shape(Model &model) override;
  };



  /** Two flanges along axis 2 and a web along axis 3 between them; origin at half the height on the web's middle. */
  class ISection : public AnalysedSection
  {
  public:
    void add_parameters(Parameters &prm) override;

  private:
    std::string material, lower_layup, upper_layup, web_layup;
    double height = 0, lower_width = 0, upper_width = 0, lower_thickness = 0, upper_thickness = 0, web_thickness = 0;

    SectionShape make_shape(Model &model) override;
  };



  /** A channel open towards +2: web at −2, flanges along axis 2; origin at half the height on the web's outer face. */
  class ChannelSection : public AnalysedSection
  {
  public:
    void add_parameters(Parameters &prm) override;

  private:
    std::string material, lower_layup, upper_layup, web_layup;
    double      height = 0, width = 0, flange_thickness = 0, web_thickness = 0;

    SectionShape make_shape(Model &model) override;
  };
} // namespace samara

#endif
