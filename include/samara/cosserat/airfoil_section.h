#ifndef samara_cosserat_airfoil_section_h
#define samara_cosserat_airfoil_section_h

#include <samara/cosserat/analysed_section.h>
#include <samara/section/airfoil_mesh.h>

namespace samara
{
  /** A layup from one place of the chord to another, "upper, 0.15, 0.5, cap"; sides: lower, upper, both. */
  struct AirfoilRangeText
  {
    std::string side;
    double      from, to;
    std::string layup;
  };

  template <>
  struct Value<AirfoilRangeText>
  {
    static constexpr char separator = ';';
    static constexpr bool has_unit  = false;

    static AirfoilRangeText read(const std::string &text, const std::string &unit, const Quantities &quantities);
    static std::string      write(const AirfoilRangeText &value);
    static PatternPointer   pattern();
  };



  /** A web of a layup at x/c, "0.25, web", or leaning, x/c below and above, "0.25, 0.27, web". */
  struct AirfoilWebText
  {
    double      lower, upper;
    std::string layup;
  };

  template <>
  struct Value<AirfoilWebText>
  {
    static constexpr char separator = ';';
    static constexpr bool has_unit  = false;

    static AirfoilWebText read(const std::string &text, const std::string &unit, const Quantities &quantities);
    static std::string    write(const AirfoilWebText &value);
    static PatternPointer pattern();
  };



  /**
   * An airfoil of skins, spar caps, webs, a weight in the nose and a solid trailing edge: AirfoilMesh. The nose looks
   * along +2, the upper side along +3; the origin is on the chord.
   */
  class AirfoilSection : public AnalysedSection
  {
  public:
    void add_parameters(Parameters &prm) override;

  private:
    std::string                   naca, naca_edge = "blunt", file, layup, material, trailing_material, nose_material;
    double                        chord = 0, origin = 0.25, thickness = 0, trailing_from = 0, nose_to = 0;
    bool                          skins_run_on = false;
    std::vector<AirfoilRangeText> skins, caps;
    std::vector<AirfoilWebText>   webs;

    SectionShape make_shape(Model &model) override;

    std::shared_ptr<const AirfoilOutline> make_outline(Model &model) const;
    AirfoilDesign                         make_design(Model &model, SectionShape &shape) const;
    Wall layup_of(Model &model, SectionShape &shape, const std::string &entry, const std::string &name) const;
    void add_ranges(Model                               &model,
                    SectionShape                        &shape,
                    const std::string                   &entry,
                    const std::vector<AirfoilRangeText> &texts,
                    AirfoilDesign                       &design) const;
  };
} // namespace samara

#endif
