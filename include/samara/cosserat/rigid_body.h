#ifndef samara_cosserat_rigid_body_h
#define samara_cosserat_rigid_body_h

#include <samara/cosserat/initial_velocity.h>

namespace samara
{
  /**
   * A rigid body: one node, the Cosserat continuum of dimension 0. The node stands at "Position"; the centre of mass may
   * be off it. The inertia tensor is about the centre of mass, in the body's axes.
   */
  class RigidBody : public Body
  {
  public:
    void add_parameters(Parameters &prm) override;
    void be_placed(const Placement &placement) override;
    void initialize(Model &model) override;
    void connect(Layout &layout) override;

    /** "centre" (the node), "centre of mass" and the user's frames. */
    Frame                    frame(const std::string &point) const override;
    std::vector<std::string> points() const override;
    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;
    void                     draw(const State &state, Drawing &drawing) const override;

    /** The rigid motion about the node that the user gives, see InitialVelocity. */
    void add_initial_velocities(State &state) const override;

  private:
    double                   mass = 0;
    Vector3                  position = Vector3::Zero(), centre_of_mass = Vector3::Zero(), rotation = Vector3::Zero();
    std::vector<double>      inertia = {0, 0, 0};
    std::vector<std::string> frame_entries;
    std::string              sequence = "321", shape = "automatic";
    std::vector<double>      size;
    InitialVelocity          initial_velocity;
    Complaints              *complaints = nullptr; ///< of the model

    struct Point
    {
      Frame   frame;
      Vector3 x; ///< reference
      Matrix3 D;
    };
    std::map<std::string, Point> named;

    /** Read "name at x y z" [m]; returns whether that is what the text is. */
    static bool read_frame(const std::string &text, std::string &point, Vector3 &x);

    void read_frames(Model &model, const Frame &node);
  };
} // namespace samara

#endif
