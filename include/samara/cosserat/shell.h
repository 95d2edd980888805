#ifndef samara_cosserat_shell_h
#define samara_cosserat_shell_h

#include <samara/cosserat/cosserat.h>
#include <samara/cosserat/initial_velocity.h>
#include <samara/cosserat/region_layup.h>
#include <samara/cosserat/shell_curve.h>
#include <samara/cosserat/shell_mesh.h>
#include <samara/model/doubts.h>
#include <samara/model/relative_motion.h>
#include <samara/model/remarks.h>
#include <samara/model/surface_curve.h>
#include <samara/model/surface_load.h>
#include <samara/section/extremes_by_name.h>
#include <samara/section/laminate.h>
#include <samara/section/recovery.h>

#include <map>
#include <utility>

namespace samara
{
  /**
   * A geometrically exact shell: Cosserat<2> on a reference surface with a laminate, shear-flexible, with large
   * displacements and rotations.
   *
   * Axes: d₃ normal to the surface (g₁ × g₂ of the cells), d₁ the projection of "Axis 1" on the tangent plane, d₂ = d₃
   * × d₁. Of the twelve strains Γ_α1 Γ_α2 Γ_α3 K_α1 K_α2 K_α3 along the directions α = 1, 2 those of a plate are
   *
   *     ε₁₁ = Γ₁₁   γ₁₂ = Γ₁₂ + Γ₂₁   ε₂₂ = Γ₂₂   κ₁₁ = K₁₂   2κ₁₂ = K₂₂ − K₁₁   κ₂₂ = −K₂₁   γ₁₃ = Γ₁₃   γ₂₃ = Γ₂₃
   *
   * Of the rest, Γ₁₂ − Γ₂₁ (drilling), K₁₃ and K₂₃ have a stiffness of a tenth of that in shear, so that they stay
   * small, the last two more in large cells, so that tension leaves them stable; K₁₁ + K₂₂ has none. Normals at nodes
   * are those of the interpolated surface, averaged over cells whose normals differ by less than the crease angle;
   * where more meet, they share the node, each with a triad of its own.
   *
   * Order 2p in frequencies; no locking, though degree 2 is slow in very thin curved shells. Degree 1 is refused where
   * a cell is no parallelogram. Mass at the nodes by the Gauss–Lobatto rule; rotary inertia also about the normal.
   *
   * Source: doc/theory/shell.md.
   */
  class Shell : public Cosserat<2>,
                public SurfaceBody,
                public HasCurves,
                public RelativeMotions,
                public Doubtful,
                public HasRemarks
  {
  public:
    void add_parameters(Parameters &prm) override;

    /** How many nodes of a mesh file lie at the places of others, and what becomes of them. */
    std::vector<Remark> remarks() const override;
    void                be_placed(const Placement &placement) override;
    void                initialize(Model &model) override;
    void                connect(Layout &layout) override;

    /** Those of the entries "Frames" and "Rigid edges"; "point NAME" of a mesh file; "at u v" on the first patch or
     * "at x y z", where a node is. */
    Frame                    frame(const std::string &point) const override;
    std::vector<std::string> points() const override;

    std::vector<SurfaceCell> surface(const std::string &region) const override;
    std::vector<Span>        edge(const std::string &name) const override;
    std::vector<std::string> edges() const override;
    std::vector<AreaShare>   region(const std::string &name) const override;
    std::vector<std::string> regions() const override;
    /** Of the entry "Curves", or a straight line in u and v. */
    std::vector<LinePiece> curve(const std::string &path) const override;
    double                 thickness() const override;
    /** The cell that is longest for its tension, if it is too long. */
    std::string coarse_place(const State &state) const override;

    /**
     * The angle [rad] by which a cell is bent as the highest polynomial that it has: the largest, over lines along both
     * of its unit coordinates, of the highest coefficients of curvature, as in Beam::turn().
     */
    double fold(unsigned int cell, const State &state) const;
    /** The cell with the largest fold() and what would do; empty if that is no more than @p most [rad]. */
    std::string folded_place(const State &state, double most) const;

    /** Of a laminate so thick for how it is bent that shear warps it, if stresses of layers are asked for. */
    std::vector<Doubt> doubts(const State &state) const override;
    /** Where a fold is too sharp for its cell, which catches at the ends of cells; see fold(). */
    std::string why_no_limit(const State &state) const override;

    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;
    void                     draw(const State &state, Drawing &drawing) const override;

    std::vector<unsigned int> rigid_nodes() const override;

    /** @name Automatic meshes, see automatic_mesh.h @{ */
    /** The wanted relative error of the strains if the mesh is to be found; 0 if not, or if it has been. */
    double                 wanted_error() const;
    std::vector<PatchMesh> patch_meshes() const;

    unsigned int
    degree_of_elements() const
    {
      return degree;
    }
    unsigned int
    n_refinements() const
    {
      return refinements;
    }

    /**
     * Strains @p e of this shell at the points of integration of another one with the same patches or cells, whose
     * cells each are part of one of this, times the root of the other's stiffness and weights: of their square half is
     * the energy.
     */
    Eigen::VectorXd energy_samples(const double *e, const Shell &finer) const;

    /** Square of the error of a cell, and what cuts across its first and second unit coordinate take away of it. */
    struct CellError
    {
      double error = 0, across[2] = {0, 0};
    };
    /** From the difference of two energy_samples() at the points of this shell. */
    std::vector<CellError> errors_of_cells(const Eigen::VectorXd &difference) const;

    /** A finer mesh: of patches the one whose strips are cut where errors per cell have this part of the largest; else
     * each cell cut once more. */
    struct Refined
    {
      std::vector<PatchMesh> patches;
      unsigned int           refinements;
    };
    Refined refined(const std::vector<CellError> &errors, double part) const;
    /** @} */

    /** Whether a point is one node of a flexible shell that is on none of its rigid edges. */
    bool is_single_node(const std::string &point) const;
    void add_initial_velocities(State &state) const override;

  protected:
    /** As Cosserat: whether strains are those of the class. */
    bool
    joins() const override
    {
      return true;
    }

    unsigned int degree         = 3;     ///< entry
    bool         takes_any_cell = false; ///< see ShellMesh

  private:
    // entries
    std::vector<std::array<SurfaceFunction, 3>> patch_entries;
    ShellElements                               elements_entry;
    std::vector<PatchMesh>                      mesh_entries;
    bool                                        merges = true;
    std::string                                 of_coincident; ///< ImportedMesh::take_coincident()
    std::string                                 grid, grid_arguments, mesh_file;
    bool                                        is_curved   = true;
    unsigned int                                refinements = 0;
    double                                      crease      = 20 * M_PI / 180;
    Vector3                                     axis_1      = Vector3::Zero();
    std::string                                 layup_name;
    std::vector<std::string>                    patch_layups;
    std::vector<RegionLayup>                    region_layups;
    std::string                                 transverse_shear = "equilibrium";
    double                                      E = 0, nu = 0, density = 0, thickness_entry = 0, offset = 0;
    double                                      relaxation_time = 0;
    std::vector<std::string>                    frame_entries, rigid_edges;
    std::vector<ShellCurve>                     curve_entries;
    bool                                        rigid        = false;
    bool                                        shows_layers = false;
    InitialVelocity                             initial_velocity;

    Model                              *model = nullptr;
    std::vector<Laminate>               laminates;        ///< one, or one of each patch, or of each region
    std::vector<unsigned int>           laminate_of_cell; ///< empty if there is one
    std::string                         groups_of_file;   ///< " m.msh has no physical groups."; "" without a file
    std::vector<std::vector<Strengths>> strengths;        ///< of the layers of each laminate
    std::vector<Matrix6>                compliances;      ///< inverses of ABD
    /** Numbers of materials by that of the laminate and the stiffness about the normal. */
    std::map<std::pair<unsigned int, long>, unsigned int> material_numbers;
    std::unique_ptr<ShellMesh>                            mesh;
    std::shared_ptr<const SurfaceRule>                    rule;
    Eigen::MatrixXd to_nodes; ///< values at the nodes of a cell from those at its integration points

    /** The nodes of a cell that are on none of its sides, and values at the integration points from those there. */
    std::vector<unsigned int> inner_nodes;
    Eigen::MatrixXd           inner_to_points;
    /** Derivatives by the unit coordinates at the integration points, from the values there: polynomials of
     * inner_nodes. */
    Eigen::MatrixXd slopes_at_points[2];

    struct LoadOnSurface
    {
      const SurfaceLoad *load;
      std::vector<bool>  acts_on; ///< cells
    };
    std::vector<LoadOnSurface> loads_on_surface;

    /** Of each node of the mesh, with the axes of the first cell there. */
    std::vector<Frame> node_frames;

    /** A point that has a name, or has been asked for. */
    struct NamedPoint
    {
      Frame   frame;
      Vector3 x;         ///< reference position [m]
      Matrix3 D;         ///< reference axes
      int     node = -1; ///< of the mesh; negative if it is none
    };
    std::map<std::string, NamedPoint> named;
    std::vector<Matrix3>              node_axes; ///< of the reference configuration, of the nodes of the mesh

    void add_material_parameters(Parameters &prm);
    void make_laminates();
    void add_laminate(const std::string &entry, const std::string &layup);
    bool make_mesh();
    /** The cells of a region that has a name, "region skin" or "skin". @throws std::invalid_argument if there is none.
     */
    const std::vector<unsigned int> &cells_of(const std::string &region) const;
    void                             distribute_laminates();
    /** Of a patch, as entries say. */
    PatchMesh   mesh_of_patch(unsigned int patch) const;
    std::string complaint_about_elements() const;
    void        make_rule();
    void        make_rule_across();
    void        find_loads_on_surface();
    /** @param about_normal of K₁₃ and K₂₃ [N m] */
    MatrixN stiffness(const Laminate &laminate, double about_normal) const;
    /** Of K₁₃ and K₂₃ in a cell [N m]. */
    double stiffness_about_normal(unsigned int cell) const;
    /** Number of the material of a cell, made where there is none like it. */
    unsigned int material_of(unsigned int cell);
    Matrix6      inertia(const Laminate &laminate) const; ///< per area, in the axes of the surface
    /** Number of the laminate of a cell. */
    unsigned int laminate_of(unsigned int cell) const;
    void         make_nodes_and_elements();
    void         name_points();
    void         check_curves();
    void         make_rigid_edges();
    void         make_rigid_edge(const std::string &point, const std::string &place);

    /** Unit normals of the cells at their nodes, averaged over cells within the crease angle. */
    std::vector<std::vector<Vector3>> normals() const;
    /** Axes of a cell at its nodes. @throws std::invalid_argument if "Axis 1" is normal to it, or nearly so. */
    std::vector<Matrix3> triads(unsigned int cell, const std::vector<Vector3> &normals) const;

    NamedPoint point_of(unsigned int node) const;
    /** The node of the mesh at "0.5 0" or "1 0.2 0.3". @throws std::invalid_argument if there is none. */
    unsigned int node_at(const std::string &place) const;
    /** The node of "point tip". @throws std::invalid_argument if there is none, or several. */
    unsigned int node_of_point(const std::string &name) const;
    /** The straight line in u and v of "line u 0.3" or "from a to 0.7 0.2". @throws std::invalid_argument */
    ShellCurve straight_line(const std::string &path) const;
    /** Where on which patch a point is, "0.2 0.3" or one with a name: all that it may be. */
    std::vector<ShellMesh::Origin> origins_of(const std::string &point) const;

    /** Whether @p point is written as a named point is, or as "at ...". */
    bool is_place(const std::string &point) const;
    /** A named point, or "at ...". @throws std::invalid_argument */
    NamedPoint point_named(const std::string &point) const;

    /** Section forces from stresses, see below, as fields at as many samples. */
    void draw_section_forces(const std::vector<VectorN> &stresses, unsigned int first_sample, Drawing &drawing) const;

    /** Whether node @p a of an element is the node @p node of the mesh, and has its axes. */
    bool is_of_node(unsigned int element, unsigned int a, unsigned int node) const;

    /** @name Stresses C e of twelve strains at a node of an element, at a node of the mesh: the mean over the cells
     * there with its axes @{ */
    VectorN stress_at_node(unsigned int element, unsigned int a, const State &state) const;
    VectorN mean_stress(unsigned int node, const State &state) const;
    /** @} */

    /**
     * What the stresses of layers follow from: the twelve stresses C e, and below them Laminate::Across in the order of
     * these rows; zero where knows_across() is false.
     */
    static constexpr unsigned int row_of_gradient = n, row_of_curvature = n + 4, row_of_bottom = n + 7,
                                  row_of_top = n + 8, row_of_inertia = n + 9, n_recovered = n + 10;
    using Recovered = Eigen::Matrix<double, n_recovered, 1>;

    /** @name One column for each integration point or node of an element; of a node of the mesh the mean, see above @{
     */
    Eigen::MatrixXd recovered_at_points(unsigned int element, const State &state) const;
    Eigen::MatrixXd recovered_at_nodes(unsigned int element, const State &state) const;
    Recovered       mean_recovered(unsigned int node, const State &state) const;
    /** @} */

    /** Its parts, of an element: from the polynomials through the shear forces at the integration points, ... */
    void add_shear_gradients(unsigned int element, Eigen::MatrixXd &recovered) const;
    void add_curvatures(unsigned int element, const State &state, Eigen::MatrixXd &recovered) const;
    void add_pressures(unsigned int element, const State &state, Eigen::MatrixXd &recovered) const;
    /**
     * What the loads on the surface leave of the forces of the stresses at the inner nodes, along d₃ and over the area
     * of the node: mass times the acceleration less gravity [Pa]. No other cell and no edge has a part in these nodes.
     * @param loads at the integration points, their weights included [N].
     */
    Eigen::VectorXd inertia_at_inner_nodes(unsigned int                      element,
                                           const kernel::NodeValues<double> *nodes,
                                           const Eigen::Matrix3Xd           &loads,
                                           const Eigen::MatrixXd            &recovered) const;

    /** Strains of the plate in the middle of its thickness, in the order of the @p laminate, and shear forces [N/m]. */
    struct PlateState
    {
      unsigned int     laminate;
      Vector6          strains;
      Eigen::Vector2d  shear;
      Laminate::Across across;
    };
    PlateState plate_state(const Recovered &recovered, unsigned int laminate) const;

    /** The stress that is only known of elements of degree two and more, whose strains are those of this class. */
    static constexpr const char *across_the_layers = "stress 33";
    bool                         knows_across() const;

    /** In the axes of the material. */
    Vector6 layer_stress(const PlateState &at, unsigned int layer, double z) const;

    /** Of the layer, or of all if it is negative, at a place, or over the surface. @{ */
    SectionStresses::Extremes layer_extremes(const PlateState &at, int layer) const;
    /** @} */

    /** The largest of a quantity over the surface, and about how well it is known: the term that cells have no more. */
    struct Peak
    {
      double value, error;
    };
    /** At the integration points and the nodes of each cell, by the polynomials of the cell. */
    Peak peak_over_surface(const ExtremeByName &quantity, int layer, const State &state) const;
    /** Values at the nodes and at the integration points from those at the latter; by lower degrees. */
    Eigen::MatrixXd to_samples, to_samples_of_less[2];
    /** How far a value is off, from those that polynomials of one and of two degrees less have. */
    static double next_term(double here, double with_less, double with_least);
    void            make_samples();

    mutable bool are_stresses_asked = false; ///< by a probe
    /** The laminate of all cells at a node. @throws std::invalid_argument if they have several */
    unsigned int laminate_at(unsigned int node) const;

    /** From "layer 2", counted from 1 at the bottom; -1 for "layers". @throws std::invalid_argument */
    int layer_named(const std::string &name) const;

    /** Of stresses and indices of failure; @p point: "layers", "tip", "tip.layer 2". */
    std::optional<Probe>
    layer_probe(const std::string &path, const std::string &point, const std::string &quantity) const;

    /** Of all layers at a point: the largest von Mises stress, and the index of failure where it is largest. */
    struct WorstLayer
    {
      double von_mises = 0, index = -1;
      int    layer = -1; ///< none if no strengths are known
    };
    WorstLayer worst_layer(const PlateState &at) const;
    /**
     * Strains, and the largest of stresses and indices of failure, as draw_section_forces(); how well these are known
     * by states @p with_less terms along the cell (to_samples_of_less).
     */
    void draw_worst_layers(const std::vector<PlateState> &states,
                           const std::vector<PlateState>  with_less[2],
                           unsigned int                   first_sample,
                           Drawing                       &drawing) const;
    /**
     * Each layer as three surfaces, at its bottom, middle and top, where probes look for what is largest, with what
     * they find there; the nodes of an element in this order.
     */
    void draw_layers(const std::vector<unsigned int> &order, const State &state, Drawing &drawing) const;
  };
} // namespace samara

#endif
