#ifndef samara_section_material_h
#define samara_section_material_h

#include <samara/model/item.h>
#include <samara/section/elasticity.h>

namespace samara
{
  /** Largest stresses of a material in its own axes, all above zero; zero: not known [Pa]. */
  struct Strengths
  {
    Vector3 tensile     = Vector3::Zero(); ///< along 1, 2, 3
    Vector3 compressive = Vector3::Zero(); ///< along 1, 2, 3
    Vector3 shear       = Vector3::Zero(); ///< 12, 13, 23
    double  yield       = 0;               ///< of von Mises' stress
  };



  /** What a section, a ply or a shell is made of. */
  struct SectionMaterial
  {
    Matrix6     stiffness = Matrix6::Zero(); ///< in the axes of the material, Voigt order 11 22 33 23 13 12 [Pa]
    double      density   = 0;               ///< [kg/m³]
    std::string name      = "";
    Strengths   strengths = {};
  };



  /** A named material that layups, sections and shells refer to. It adds nothing to the system by itself. */
  class Material : public Item
  {
  public:
    void initialize(Model &model) override;

    const SectionMaterial &
    properties() const
    {
      return own;
    }

  protected:
    /** Entries that all kinds have; @p numbers: of a strength, 1 or 3. */
    void add_common(Parameters &prm, bool is_isotropic);

    /** @throws std::invalid_argument if the matrix is not positive definite */
    virtual Matrix6 stiffness() const = 0;

    /** The entry to name when stiffness() throws. */
    virtual std::string blamed_entry() const = 0;

  private:
    double              density = 0, yield = 0;
    std::vector<double> tensile, compressive, shear;
    SectionMaterial     own;

    bool
    read_strength(const std::string &entry, const std::vector<double> &given, Vector3 &strength, Model &model) const;
  };



  /** E and ν. Strengths are the same in all directions. */
  class IsotropicMaterial : public Material
  {
  public:
    void add_parameters(Parameters &prm) override;

  private:
    double E = 0, nu = 0.3;

    Matrix6     stiffness() const override;
    std::string blamed_entry() const override;
  };



  /**
   * Nine constants, 1 along the fibres; what is left out is as in a material that is the same in all directions across
   * them: E₃ = E₂, G₁₃ = G₁₂, ν₁₃ = ν₁₂, G₂₃ = E₂/2/(1 + ν₂₃).
   */
  class OrthotropicMaterial : public Material
  {
  public:
    void add_parameters(Parameters &prm) override;

  private:
    elasticity::Orthotropic given{0, 0, 0, 0, 0, 0, 0, 0, 0};

    Matrix6     stiffness() const override;
    std::string blamed_entry() const override;
  };



  /** All 21 constants: the stiffness, or its inverse. */
  class AnisotropicMaterial : public Material
  {
  public:
    void add_parameters(Parameters &prm) override;

  private:
    std::vector<double> given_stiffness, given_compliance;

    Matrix6     stiffness() const override;
    std::string blamed_entry() const override;
  };
} // namespace samara

#endif
