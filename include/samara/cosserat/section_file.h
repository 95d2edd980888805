#ifndef samara_cosserat_section_file_h
#define samara_cosserat_section_file_h

#include <samara/cosserat/section.h>

namespace samara
{
  /**
   * The text of a section that people and FileSection read: lines <name [unit] number> of what engineers call its
   * numbers, and blocks of lines of numbers below a line that begins with their name: `Stiffness` and `Inertia`, 6×6,
   * in the order of SectionValues, `Outline`, 2 a line, which may be left out. What stands behind # is left out; SI
   * units.
   */
  struct SectionFile
  {
    std::string   name;
    Vector3       curvature = Vector3::Zero(); ///< initial twist and curvature it was found with [1/m]
    SectionValues values;

    /** Further lines <name [unit] number> for people, by name and number. */
    std::vector<std::pair<std::string, double>> remarks = {};

    /** With @p digits behind the point of the matrices: 16 can be read back without loss. */
    std::string write(int digits) const;

    /**
     * @throws std::invalid_argument saying file, line and what is wrong there: a block that is missing or has other
     * numbers than it must, a matrix that is not symmetric, a number for people that is not that of the matrices.
     */
    static SectionFile read(const std::string &file);
  };



  /** A section from a file that `Analyses = section` has written, or one like it. */
  class FileSection : public Section
  {
  public:
    void                         add_parameters(Parameters &prm) override;
    void                         initialize(Model &model) override;
    SectionValues                at(double x, const Vector3 &curvature) const override;
    bool                         depends_on_curvature() const override;
    std::vector<Eigen::Vector2d> outline(double x) const override;
    std::vector<Vector3>         curvatures() const override;

  private:
    std::string file, for_curvature = "of the file";
    SectionFile own;
    double      size = 0; ///< of the section, to which curvatures are compared [m]
  };
} // namespace samara

#endif
