#ifndef samara_cosserat_beam_h
#define samara_cosserat_beam_h

#include <samara/cosserat/cosserat.h>
#include <samara/cosserat/curve.h>
#include <samara/cosserat/initial_velocity.h>
#include <samara/cosserat/section.h>

namespace samara
{
  /**
   * A geometrically exact composite beam: Cosserat<1> on a reference line with sections.
   *
   * Section axes: d₁ tangent, d₂ d₃ across as "Axis 2" and "Twist" say. Strains Γ₁ axial, Γ₂ Γ₃ shear, K₁ twist, K₂ K₃
   * bending; a positive K₂ bends d₁ towards −d₃, a positive K₃ towards d₂. Order 2p in nodal displacements, rotations
   * and frequencies for degree p with p Gauss points; no locking at any slenderness.
   */
  class Beam : public Cosserat<1>
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;
    void connect(Layout &layout) override;

    /** start, end, middle, the user's frames, each at a node. */
    Frame                    frame(const std::string &point) const override;
    std::vector<std::string> points() const override;
    std::vector<Station>     stations() const override;

    /** The points above or "at x" (relative abscissa), then position, displacement, ... see probe_names(). */
    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;
    void                     draw(const State &state, Drawing &drawing) const override;

    /** All nodes take part in the rigid motion about the start that the user gives, see InitialVelocity. */
    void add_initial_velocities(State &state) const override;

    double
    length() const
    {
      return curve->length();
    }

  private:
    // entries
    std::string                shape = "polyline";
    std::vector<Vector3>       corner_points;
    std::array<Expression, 3>  expressions;
    Vector3                    axis_2 = Vector3::Zero();
    Expression                 twist;
    unsigned int               n_elements_wanted = 4, degree = 3;
    std::string                section_name;
    std::vector<std::string>   frame_names;
    std::vector<double>        viscosity = {0}, damping_ratio = {0};
    double                     damping_frequency = 0;
    bool                       rigid             = false;
    InitialVelocity            initial_velocity;

    std::unique_ptr<Curve> curve;
    const Section         *section = nullptr;
    Model                 *model   = nullptr;

    struct Cell
    {
      double start, end; ///< arc length [m]
    };
    std::vector<Cell>            cells;
    std::vector<Frame>           node_frames;
    std::vector<double>          node_abscissae;
    std::map<std::string, double> named; ///< arc length of named points

    bool                find_curve();
    std::vector<double> element_ends();
    void                make_nodes_and_elements(const std::vector<double> &ends);
    Material            material_at(double s) const;
    Vector6             relaxation_times() const;
    Matrix3             triad_at(double s, double inside) const;
    std::vector<unsigned int> materials_of_cell(const Cell &cell);

    /** Arc length of a named point or of "at x"; nothing if there is none. @throws std::invalid_argument if x is wrong
     */
    std::optional<double> abscissa_of(const std::string &point) const;
    int                   node_at(double s) const;

    /** Everything known at an arc length: strains and section forces are polynomials through the Gauss points. */
    struct Local
    {
      Sample  sample;
      Matrix3 D_reference;
      Vector3 spin         = Vector3::Zero(); ///< inertial axes [rad/s]
      Vector6 acceleration = Vector6::Zero(); ///< inertial axes [m/s², rad/s²]
      Vector6 strain, stress;                 ///< in section axes
    };
    Local local(const State &state, double s) const;
  };
} // namespace samara

#endif
