#ifndef samara_joints_rolling_disc_h
#define samara_joints_rolling_disc_h

#include <samara/joints/joint.h>

namespace samara
{
  /**
   * A thin disc, a wheel that may tilt, of radius R [m], fixed to body B with its centre at the place x_B of that frame
   * and its axle a along "Axle", rolls without slipping with its edge on a plane of body A: the one through "Position"
   * and normal to n ("Axis", joint axis 3), which points to the side of the disc. With the angle θ between n and a,
   * whose cosine c and sine s are unknowns, Δ from "Position" to the centre, w the velocity of the centre against the
   * material of body A there, ω the angular velocity against A, t = n × a and l = a − c n, both of length s:
   *
   *     tilt          n·a − c = 0
   *     height        n·Δ − R s = 0
   *     angle         ½ (c² + s² − 1) = 0
   *     no slip       t·w + R s a·ω = 0         along the track
   *                   l·w − R s t·ω = 0         across it
   *
   * So everything is quadratic; the last two hold for velocities alone. The disc is held to the plane whichever way the
   * force goes: "force 3" is negative if it would lift off, and nobody checks that friction suffices. It must not lie
   * flat: there the equations are singular.
   */
  class RollingDisc : public Joint
  {
  public:
    void add_parameters(Parameters &prm) override;
    void be_moved(const MotionOf &motion_of) override;
    void initialize(Model &model) override;
    void connect(Layout &layout) override;
    void draw(const State &state, Drawing &drawing) const override;

    /**
     * "tilt", θ less a right angle, 0 where the disc stands upright [deg], and "tilt rate" [rad/s]; "displacement 1,
     * 2", where on the plane the contact is, from "Position" along axes 1, 2 of A [m]; forces of the plane on the disc
     * at the contact [N]: "force 1, 2, 3" along the axes of A, and the parts of friction "force along" the track, t,
     * and "force across" it, l, to the side where the axle points.
     */
    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;

  private:
    class Constraints;

    double                      radius     = 0;
    Vector3                     axle       = Vector3::Zero();
    double                      start      = 0; ///< θ in the reference configuration [rad]
    unsigned int                coordinate = 0; ///< c less its reference, and behind it s
    std::unique_ptr<Constraint> term;
    Block                       own_block; ///< 12 twists, 2 coordinates, 5 multipliers

    /** θ and its rate. */
    double theta(const State &state) const;
    double rate(const State &state) const;

    /** From "Position" to the contact, and the force of the plane on the disc there; along the axes of A [m, N]. */
    Vector3 contact(const State &state) const;
    Vector3 force(const State &state) const;
  };
} // namespace samara

#endif
