#ifndef samara_cosserat_analysed_section_h
#define samara_cosserat_analysed_section_h

#include <samara/cosserat/analysed_shape.h>
#include <samara/section/layup.h>

namespace samara
{
  /**
   * A section of which shape and materials are given, and the stiffness is found by warping analysis, with the initial
   * twist and curvature of the beam that uses it: doc/theory/cross_section.md. What was found is kept, by what the
   * section consists of and by curvature, for all sections of the program.
   *
   * A kind of shape declares its entries and makes a SectionShape about its own origin; Position and Rotation put it
   * into the axes of the beam.
   */
  class AnalysedSection : public Section
  {
  public:
    void                         add_parameters(Parameters &prm) override;
    void                         initialize(Model &model) override;
    SectionValues                at(double x, const Vector3 &curvature) const override;
    bool                         depends_on_curvature() const override;
    std::vector<Eigen::Vector2d> outline(double x) const override;

    /** With stresses; @p more_degrees: than the section's entry says. @throws std::invalid_argument */
    std::unique_ptr<SectionAnalysis> analyse(const Vector3 &curvature, unsigned int more_degrees = 0) const;

    /** Those for which beams have asked so far, without round-off; (0, 0, 0) if none has. */
    std::vector<Vector3> curvatures() const override;

    /** Whether the section is found by analysis: some shapes have a closed form, too. */
    virtual bool
    is_analysed() const
    {
      return true;
    }

    const AnalysedSection *
    analysed() const override
    {
      return is_analysed() ? this : nullptr;
    }
    std::vector<StressedSection>       stressed(double x, double inside) const override;
    std::unique_ptr<const SectionLoft> loft_to(const Section &other) const override;

  protected:
    /** @throws std::invalid_argument if there is no such shape; faulty entries get a complaint before. */
    virtual SectionShape make_shape(Model &model) = 0;

    void check(Model &model) const override;

    /** @name For shapes @{ */
    Fineness fineness() const;

    /** Whether tension stiffens torsion. */
    bool has_trapeze = false;

    /**
     * Returns how many corners of cells lie on sides of others, as SectionMesh says. @throws std::invalid_argument if
     * there is no mesh of the shape: a cell is turned inside out, ...
     */
    unsigned int try_mesh(const SectionShape &shape) const;

    /** Of the elements. */
    unsigned int
    own_degree() const
    {
      return degree;
    }

    /** The smallest cell of walls of which the longest is @p longest [m]. */
    double finest_of(const std::vector<Wall> &walls, double longest) const;

    /**
     * The wall that the entry @p layup_entry names, or of the one material and the thickness; its materials are added
     * to those of @p shape. Nothing, with a complaint, if what is given does not make a wall.
     */
    Wall wall(Model             &model,
              SectionShape      &shape,
              const std::string &layup_entry,
              const std::string &layup,
              const std::string &material,
              const std::string &thickness_entry,
              double             thickness) const;

    /** The number of the material among those of the shape. */
    unsigned int
    material_number(Model &model, SectionShape &shape, const std::string &entry, const std::string &name) const;

    /** Complain about an entry that must be above zero and is not. */
    bool is_positive(Model &model, const std::string &entry, double value) const;
    /** @} */

  private:
    unsigned int        degree = 3, elements = 8, per_ply = 1;
    std::vector<double> position     = {0, 0};
    double              rotation     = 0;
    std::string         curvature_of = "beam";

    std::shared_ptr<const AnalysedShape> placed; ///< in the axes of the beam; null if it is not analysed

    mutable std::vector<Vector3> asked;

    void place(SectionShape &shape) const;
  };
} // namespace samara

#endif
