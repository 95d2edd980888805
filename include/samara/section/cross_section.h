#ifndef samara_section_cross_section_h
#define samara_section_cross_section_h

#include <samara/section/material.h>
#include <samara/section/section_mesh.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>

#include <Eigen/SparseCore>

namespace samara
{
  /** E, C or M of a section's warping, row by row, the columns of each in ascending order. */
  using SectionMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  /**
   * Cross-section analysis of a prismatic, twisted or curved beam: a warping analysis of dimension 2.
   *
   * The reference line has the constant twist k₁ and curvatures k₂, k₃ in the section's axes, √g = 1 − x₂k₃ + x₃k₂. A
   * displacement is a rigid motion of the section plus a warping w = N X ϑ, linear in the section forces
   * ϑ = (F₁ F₂ F₃ M₁ M₂ M₃); e = (Γ, K) = Y ϑ. Equilibrium of the nodes and of the section, ϑ' = −T ϑ, give
   *
   *     E X + (Cᵀ − C) X T − M X T² + R Y + L Y T = 0          Rᵀ X − Lᵀ X T + A Y = I
   *
   * T has the eigenvalues 0, ±i|k|: one real Cholesky factorisation, and for k ≠ 0 one complex one. The stiffness is
   * the inverse of the energy at unit forces. It holds for any |k| times the depth below one, with all couplings; away
   * from the ends, at small strains.
   *
   * Source: Giavotto et al. 1983 (k = 0); Borri & Merlini 1986; doc/theory/cross_section.md.
   */
  class CrossSection
  {
  public:
    /**
     * @param curvature (k₁, k₂, k₃) [rad/m]
     * @throws std::invalid_argument if the curvature is too large for the depth, a material has no positive energy, or
     * walls are so thin that round-off has more of the answer than they.
     */
    CrossSection(const SectionMesh                  &mesh,
                 const std::vector<SectionMaterial> &materials,
                 const Vector3                      &curvature = Vector3::Zero());

    Matrix6 compliance; ///< strains (Γ₁ Γ₂ Γ₃ K₁ K₂ K₃) of unit forces
    Matrix6 stiffness;  ///< its inverse [N, N m, N m²]
    Matrix6 inertia;    ///< per length of the reference line: [m I, −m c~; m c~, J] [kg/m, kg, kg m]
    double  area = 0;   ///< [m²]

    /** Largest nodal force where the section is pinned, relative to the others: zero but for round-off. */
    double reaction = 0;

    /** What is known at a point of the section; stresses follow from the section forces ϑ. */
    struct StressPoint
    {
      unsigned int                cell;
      dealii::Point<2>            place;   ///< [m]
      double                      weight;  ///< of the quadrature times area, √g not included [m²]
      Eigen::Matrix<double, 3, 6> warping; ///< displacements of unit section forces, along the axes of the section
      Matrix6                     strain;  ///< Voigt strains of unit section forces, in the axes of the section
      Matrix6                     C;       ///< Voigt stiffness there
      double  helix; ///< stress 11 of a fibre that twist makes longer, of K₁²/2 (trapeze.h) [Pa m²]
      Matrix3 axes;  ///< of the material, columns in the axes of the section
    };

    /**
     * The points of a quadrature on all cells, cell by cell. Warping is that without a mean displacement nor rotation.
     */
    std::vector<StressPoint> points(const dealii::Quadrature<2> &quadrature) const;

    /** The same; where a cell is degenerate strains are the polynomials through those of its points of integration. */
    std::vector<StressPoint> extrapolated(const dealii::Quadrature<2> &places) const;

    /** Those of Gauss and Lobatto, faces and middles of cells among them; extrapolated. */
    std::vector<StressPoint> points_with_faces() const;

    /** Those of integration. */
    std::vector<StressPoint> points() const;

    /** Voigt stresses at a point in the axes of the section, @p helix: K₁²/2 of a section with a Trapeze [Pa]. */
    static Vector6
    stress(const StressPoint &point, const Vector6 &forces, const double helix = 0)
    {
      return point.C * (point.strain * forces) + point.helix * helix * Vector6::Unit(0);
    }
    /** The same in the axes of the material. */
    static Vector6 stress_in_material(const StressPoint &point, const Vector6 &forces, double helix = 0);

    unsigned int
    n_unknowns() const
    {
      return dofs.n_dofs();
    }

  private:
    using Columns = Eigen::Matrix<double, Eigen::Dynamic, 6>;

    const SectionMesh                 &mesh;
    const std::vector<SectionMaterial> materials;
    const Vector3                      k;
    dealii::FESystem<2>                fe;
    dealii::DoFHandler<2>              dofs;

    // Forces and strains within are those about a centre that is not the reference line, Γ + K × c: about a line far
    // away, torsion, which may be soft, would spoil the digits of shear. Nothing else changes, for twist and curvature
    // are those of the line itself.
    dealii::Tensor<1, 2> centre;

    // the integrals, named as in the equations above
    SectionMatrix               E, C, M;
    Columns                     R, L;
    Matrix6                     A = Matrix6::Zero(), T;
    std::array<unsigned int, 6> pinned; ///< unknowns that are held, statically determinate
    Columns                     X;
    Matrix6                     Y;

    void    assemble();
    void    find_pins();
    void    find_T();
    void    solve();
    void    move_centre(const Eigen::Vector2d &by);
    Matrix6 compliance_about_centre();
    void    set_stiffness(const Matrix6 &F);
    void    forget_integrals();
    void    add_points(dealii::FEValues<2>                               &values,
                       const dealii::DoFHandler<2>::active_cell_iterator &cell,
                       std::vector<StressPoint>                          &result) const;
    Columns times(const SectionMatrix &matrix, const Columns &x, bool transposed = false) const;
  };
} // namespace samara

#endif
