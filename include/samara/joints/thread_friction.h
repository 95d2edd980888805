#ifndef samara_joints_thread_friction_h
#define samara_joints_thread_friction_h

#include <samara/joints/contact_entries.h>
#include <samara/joints/contact_terms.h>
#include <samara/model/model.h>

namespace samara
{
  /**
   * Dry friction of a screw's thread, against the slip u of its flanks along the helix. With the mean radius r and the
   * lead angle λ, tan λ = p/r, of the pitch p [m/rad],
   *
   *     u̇ = sin λ ḋ + r cos λ θ̇        N = (|F| + preload)/(cos λ cos β_n)        tan β_n = tan β cos λ
   *
   * F is what the row of the pitch holds along the axis, β the flank angle. u is an unknown with a linear row: forces
   * on d and θ follow from it, so that N is normal to the flanks and friction along them. A load along the axis slides
   * down where tan λ > μ/cos β_n, and the torque that lifts W is W r tan(λ + arctan(μ/cos β_n)).
   *
   * A nut on a beam turns by p' times the way S that it slides: u̇ = Ṡ/sin λ, tan λ = 1/(|p'| r). There the row of the
   * turning holds the moment, with the multiplier κ, and the row of u the friction, with the multiplier ν; the force
   * along the axis that is normal to the flanks is F = −p' (κ − sgn(p') r cos λ ν).
   */
  class ThreadFriction
  {
  public:
    ThreadFriction();
    ~ThreadFriction();

    /** Whether the user asks for it. */
    bool
    is_given() const
    {
      return entries.is_given();
    }

    /** The subsection "thread" of the screw. */
    void add_parameters(Parameters &screw);

    /** Check the entries, and add unknowns. @p prm: that subsection. */
    void initialize(Model &model, const Item &joint, const Parameters &prm);

    /** Add the terms. @p row: the multiplier of the pitch, d − p θ = 0. */
    void connect(Layout      &layout,
                 const Item  &joint,
                 unsigned int displacement,
                 unsigned int rotation,
                 unsigned int row,
                 double       pitch);

    /** The same of a nut on a beam. @p row: the multiplier of its turning; @p turn: p' [rad/m]. */
    void connect_nut(Layout &layout, const Item &joint, unsigned int displacement, unsigned int row, double turn);

    /** The factors of κ and ν in the force along the axis of a nut on a beam, which is normal to the flanks. */
    Eigen::RowVector2d axial_force(double turn) const;

  private:
    void add_friction(Layout &layout, const Item &joint, double lead, const std::vector<unsigned int> &multipliers);

    FrictionEntries entries;
    FrictionLaw     law;
    double          radius = 0, flank_angle = 0; ///< [m], [rad]
    int             slip = -1, bristles = -1;    ///< coordinate and state; negative: there is none

    class Slip;
    std::unique_ptr<Constraint> term;
    ContactTerms                terms;
  };
} // namespace samara

#endif
