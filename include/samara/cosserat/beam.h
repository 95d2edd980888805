#ifndef samara_cosserat_beam_h
#define samara_cosserat_beam_h

#include <samara/cosserat/beam_mesh.h>
#include <samara/cosserat/beam_stresses.h>
#include <samara/cosserat/cosserat.h>
#include <samara/cosserat/curve.h>
#include <samara/cosserat/initial_fields.h>
#include <samara/cosserat/initial_velocity.h>
#include <samara/cosserat/section.h>
#include <samara/cosserat/tension_torsion.h>
#include <samara/model/doubts.h>
#include <samara/model/drawing.h>
#include <samara/model/kinks.h>
#include <samara/model/relative_motion.h>
#include <samara/model/remarks.h>

#include <algorithm>

namespace samara
{
  /**
   * A geometrically exact composite beam: Cosserat<1> on a reference line with sections.
   *
   * Section axes: d₁ tangent, d₂ d₃ across as "Axis 2" and "Twist" say. Strains Γ₁ axial, Γ₂ Γ₃ shear, K₁ twist, K₂ K₃
   * bending; a positive K₂ bends d₁ towards −d₃, a positive K₃ towards d₂. Order 2p in nodal displacements, rotations
   * and frequencies for degree p with p Gauss points; no locking at any slenderness. Elements of one beam may have
   * different degrees; a mesh that meets an error is found by automatic_mesh.h.
   */
  class Beam : public Cosserat<1>,
               public RelativeMotions,
               public InitialMotion,
               public HasStrainProducts,
               public HasKinks,
               public Doubtful,
               public HasRemarks
  {
  public:
    void add_parameters(Parameters &prm) override;
    void be_placed(const Placement &placement) override;
    void initialize(Model &model) override;
    void connect(Layout &layout) override;

    /** start, end, middle, the user's frames, each at a node. */
    Frame                    frame(const std::string &point) const override;
    std::vector<std::string> points() const override;
    std::vector<Span>        spans() const override;

    /** The points above or "at x" (relative abscissa), then position, displacement, ... see probe_names(). */
    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;
    void                     draw(const State &state, Drawing &drawing) const override;

    std::string coarse_place(const State &state) const override;

    /** Places of probes where two stations of a table disagree on the stresses. */
    std::vector<Doubt> doubts(const State &state) const override;

    /** What error_of_sections() means. */
    std::vector<Remark> remarks() const override;

    /**
     * How far the compliance that elements have is from that of the section along the beam: the largest relative
     * difference of ∫F_ii q ds, for section forces that are constant or grow from either end. So much a displacement
     * by forces at an end is wrong. Zero of a section that has no stations.
     */
    double error_of_sections() const;

    /** Angles of an element, by which one sees that it is too long (doc/theory/element.md). */
    struct Turn
    {
      double between_ends; ///< relative rotation of its end sections [rad]
      double
        unresolved; ///< h times the highest Legendre coefficient of the curvatures on it, orthonormal on (0, 1) [rad]
    };
    /** Of element @p i; @p e: strains of this beam. */
    Turn turn(unsigned int i, const State &state, const double *e) const;

    /** Those of tension that stiffens torsion. */
    void add_strain_products(std::vector<StrainProduct> &products) const override;

    double lacking(double S, const Vector6 &wrench) const override;
    double elastic_energy(const State &state) const override;

    /** All nodes. */
    std::vector<unsigned int> rigid_nodes() const override;

    /** All nodes take part in the rigid motion about the start that the user gives, see InitialVelocity. */
    void add_initial_velocities(State &state) const override;

    /** See InitialFields. */
    void add_velocity_fields(const State &state, std::map<unsigned int, Vector6> &twists) const override;
    void add_displacement_fields(const State &state, std::map<unsigned int, Place> &places) const override;

    double
    length() const
    {
      return curve->length();
    }

    /** The wanted relative error of the strains if the mesh is to be found automatically; 0 if not, or if it has been.
     */
    double
    wanted_error() const
    {
      return rigid || !mesh_texts.empty() ? 0. : elements_wish.error;
    }

    std::vector<MeshElement> mesh() const;

    /** What stresses at a place follow from. */
    struct Station
    {
      std::vector<StressPart> parts;     ///< the section there, or the stations beside if they are not of one kind
      Vector3                 curvature; ///< initial twist and curvature of the reference line [rad/m]
      Vector6                 forces;    ///< of the section, as probes tell them [N, N m]
      Vector6 linear_forces; ///< without those of helical fibres (Trapeze): stresses of small strains [N, N m]
      double  helix;         ///< K₁²/2 where the section has a Trapeze, else 0 [1/m²]
      Vector3 x;             ///< place of the reference line [m]
      Matrix3 D;             ///< axes of the section
    };
    /**
     * At a named point or "at 0.3", where sections jump on the side on which the relative abscissa @p inside lies.
     * @throws std::invalid_argument if there is no such point, or no section that was analysed
     */
    Station station(const State &state, const std::string &point, std::optional<double> inside = {}) const;

    /** The section at a relative abscissa. */
    struct SectionThere
    {
      double        x;
      SectionValues values;
    };
    /**
     * Where the values have kinks, and where elements end and inside of them if they depend on curvature; one before
     * and one behind a jump.
     */
    std::vector<SectionThere> sections_along() const;

    /** Viscous stress is these times the rate of elastic stress [s]. */
    Vector6 relaxation_times() const;

    /**
     * The strains @p e of this beam at its integration points as coefficients of Legendre polynomials, k = 0 ... p − 1,
     * on each element: column k is √h Rᵀ a_k for e = Σ a_k L_k, L_k orthonormal on (0, 1), C = R Rᵀ the stiffness at
     * the middle and h the length of the element, so that ∫ eᵀ C e is the sum of all squares [√J].
     */
    std::vector<Eigen::MatrixXd> legendre_coefficients(const double *e) const;

    /**
     * How far the interpolated reference triads are from the exact ones at the integration points of an element of the
     * given @p degree between the relative abscissae @p start and @p end [rad].
     */
    double geometry_error(double start, double end, unsigned int degree) const;

    /** Whether tension stiffens its torsion. */
    bool
    has_trapeze() const
    {
      return std::any_of(trapezes.begin(), trapezes.end(), [](const Trapeze &t) { return t.is_there(); });
    }

  protected:
    unsigned int degree = 3; ///< entry

  private:
    // entries
    std::string               shape = "polyline";
    std::vector<Vector3>      corner_points;
    std::array<Expression, 3> expressions;
    Vector3                   axis_2 = Vector3::Zero();
    Expression                twist;
    ElementsWish              elements_wish;
    std::vector<std::string>  mesh_texts;
    std::string               section_name;
    std::vector<std::string>  frame_names;
    std::vector<double>       viscosity = {0}, damping_ratio = {0};
    double                    damping_frequency = 0;
    bool                      rigid             = false;
    InitialVelocity           initial_velocity;
    InitialFields             initial_fields;

    std::unique_ptr<Curve> curve;
    const Section         *section = nullptr;
    Model                 *model   = nullptr;

    struct Cell
    {
      double       start, end; ///< arc length [m]
      unsigned int degree;
    };
    std::vector<Cell>             cells;
    std::vector<Frame>            node_frames;
    std::vector<double>           node_abscissae;
    std::vector<double>           kinks; ///< arc lengths where section or twist have one; elements need not end there
    std::map<std::string, double> named; ///< arc length of named points
    Matrix6                       last_stiffness = Matrix6::Zero(); ///< of the material that was made last

    std::vector<Trapeze>            trapezes;        ///< one a material; those that are not there have zeros
    std::unique_ptr<TensionTorsion> tension_torsion; ///< null: none of them is there

    /** ∫F_ii q ds of the diagonal of the compliance, a column each q: of the section, and of the elements' points. */
    struct SectionSums
    {
      Eigen::Matrix<double, 6, 3> exact     = Eigen::Matrix<double, 6, 3>::Zero(),
                                  of_points = Eigen::Matrix<double, 6, 3>::Zero();
    };
    SectionSums             section_sums;
    static constexpr double much_error_of_sections = 1e-3; ///< there elements are moved, and a run warns

    static constexpr double least_jump_of_twist = 1e-6; ///< over 2e-9 of the length, where it is no slope [rad]

    /** d₁ at the nodes. */
    std::vector<Vector3> tangents(const State &state) const;

    std::string          make_curve(); ///< returns what is wrong with the entries
    bool                 find_curve();
    std::vector<double>  find_breaks();
    std::vector<double>  element_ends(const std::vector<double> &breaks) const;
    std::vector<double>  moved_to_kinks(std::vector<double> ends, const std::vector<double> &breaks) const;
    bool                 take_mesh(const std::vector<double> &breaks);
    void                 make_cells();
    void                 make_nodes_and_elements();
    bool                 find_kinks();
    std::vector<double>  kinks_inside(const Cell &cell) const;
    Vector3              initial_curvature(const Cell &cell, double s) const;
    SectionValues        section_at(const Cell &cell, double s) const;
    std::vector<Matrix6> stiffnesses_of(const Cell &cell, const ElementTable<1> &of_degree) const;
    std::vector<Matrix6> inertias_of(const Cell &cell) const;
    void add_to_sums(const Cell &cell, const ElementTable<1> &of_degree, const std::vector<Matrix6> &stiffnesses);

    /** error_of_sections() of cells that may still be changed. */
    double                    error_of_cells();
    Material                  material_of(const Matrix6 &stiffness, const Trapeze &trapeze) const;
    std::vector<Trapeze>      trapezes_of(const Cell &cell, const std::vector<Matrix6> &stiffnesses) const;
    Matrix3                   triad_at(double s, double inside) const;
    std::vector<unsigned int> materials_of_cell(const Cell &cell);

    /** Arc length of a named point or of "at x"; nothing if there is none. @throws std::invalid_argument if x is wrong
     */
    std::optional<double> abscissa_of(const std::string &point) const;
    int                   node_at(double s) const;

    /** What stresses at an arc length follow from, and the curvature there. @throws std::invalid_argument */
    std::pair<std::vector<StressPart>, Vector3> stressed_at(double s, std::optional<double> inside = {}) const;
    std::optional<Probe> stress_probe(const std::string &path, const std::string &quantity, double s) const;

    /** Places that probes ask for stresses, by relative abscissa. */
    mutable std::map<double, std::shared_ptr<const BeamStresses>> probed;

    /** "beam <name> from s to s", relative abscissae. */
    std::string range_of(const Cell &cell) const;
    /** Of the first element too long for its tension, and how much too long; empty if none is. @p e: strains. */
    std::string tensioned_place(const double *e) const;

    /** Everything known at an arc length: strains and section forces are polynomials through the Gauss points. */
    struct Local
    {
      Sample  sample;
      Matrix3 D_reference;
      Vector3 spin         = Vector3::Zero(); ///< inertial axes [rad/s]
      Vector6 acceleration = Vector6::Zero(); ///< inertial axes [m/s², rad/s²]
      Vector6 strain, stress;                 ///< in section axes
      Vector6 helical = Vector6::Zero();      ///< the part of the stress that is TensionTorsion::helical_forces()
    };
    /** At the abscissa @p s; strains and stresses, and what follows from them in the sample, if they are wanted. */
    Local local(const State &state, double s, bool with_strains = true) const;

    /** K₁²/2, if fibres that it makes longer are strained [1/m²]. */
    double helix_of(const Local &here) const;
  };
} // namespace samara

#endif
