#ifndef samara_cosserat_mesh_section_h
#define samara_cosserat_mesh_section_h

#include <samara/cosserat/analysed_section.h>
#include <samara/cosserat/imported_mesh.h>
#include <samara/model/remarks.h>

namespace samara
{
  /**
   * What a group of cells is made of, "spar, carbon, 30, 90": name of the group, material, angle of the fibres in the
   * layer and direction of the layer, in degrees from axis 2 towards axis 3 or the name of a curve it follows.
   */
  struct MeshGroupText
  {
    std::string group, material;
    double      angle = 0; ///< [deg]
    std::string layer = "0";
  };

  template <>
  struct Value<MeshGroupText>
  {
    static constexpr char separator = ';';
    static constexpr bool has_unit  = false;

    static MeshGroupText  read(const std::string &text, const std::string &unit, const Quantities &quantities);
    static std::string    write(const MeshGroupText &value);
    static PatternPointer pattern();
  };



  /**
   * A section of quadrilaterals and triangles of a file, straight or of second order. Where there are triangles all
   * cells are divided, a triangle into three and a quadrilateral into four.
   */
  class MeshSection : public AnalysedSection, public HasRemarks
  {
  public:
    void add_parameters(Parameters &prm) override;

    /**
     * How many nodes of the file lie at the places of others, or on sides of cells that do not have them, and what
     * becomes of them; and that curved sides become straight.
     */
    std::vector<Remark> remarks() const override;

  private:
    std::string                file;
    std::vector<MeshGroupText> groups;
    double                     scale  = 1;
    bool                       merges = false;
    std::string                of_coincident; ///< ImportedMesh::take_coincident()
    std::vector<Remark>        of_sides;      ///< of free sides that touch, and of curved ones

    SectionShape make_shape(Model &model) override;

    std::vector<unsigned int> groups_of_cells(const ImportedMesh &mesh) const;
    void                      add_cells(const ImportedMesh &mesh, Model &model, SectionShape &shape) const;
  };
} // namespace samara

#endif
