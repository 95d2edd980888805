#ifndef samara_section_layup_h
#define samara_section_layup_h

#include <samara/section/laminate.h>
#include <samara/section/material.h>

namespace samara
{
  /** A line of a layup as it is written: "carbon, [0/±45]s, 0.127 mm", plies of one material and thickness. */
  struct PlyText
  {
    std::string material, angles;
    double      thickness; ///< of each ply [m]
  };

  template <>
  struct Value<PlyText>
  {
    static constexpr char separator = ';';
    static constexpr bool has_unit  = true;

    static PlyText read(const std::string &text, const std::string &unit, const Quantities &quantities);

    static std::string write(const PlyText &value);

    static PatternPointer pattern();
  };



  /**
   * A named layup that sections and shells refer to: plies one upon the other, the first one at the bottom of a shell,
   * or at the outside of a section. Angles turn from axis 1 towards axis 2 of the laminate, axis 3 pointing from the
   * first ply to the last.
   */
  class Layup : public Item
  {
  public:
    struct Ply
    {
      const SectionMaterial *material;
      double                 angle;     ///< [rad]
      double                 thickness; ///< [m]
    };

    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;

    const std::vector<Ply> &
    plies() const
    {
      return own;
    }

    double thickness() const;

    /** As a shell needs it, from the bottom. */
    std::vector<Lamina> laminae() const;

  private:
    std::string          material, angles;
    double               ply_thickness = 0;
    std::vector<PlyText> lines;
    bool                 is_symmetric = false;
    std::vector<Ply>     own;

    void add(const PlyText &line, Model &model);
  };
} // namespace samara

#endif
