#ifndef samara_joints_contact_entries_h
#define samara_joints_contact_entries_h

#include <samara/base/contact_law.h>
#include <samara/base/friction_law.h>
#include <samara/base/parameters.h>

#include <string>
#include <vector>

namespace samara
{
  /** What users say of the law of a stop or a contact. */
  struct ContactEntries
  {
    double     stiffness = 0, damping = 0, exponent = 1, restitution = 1, speed = 0;
    Expression force;

    /**
     * The entries "<prefix>stiffness", "... damping", "... exponent", "... restitution", "... speed", "... force"; @p
     * turns: of a rotation. An empty prefix makes capitals.
     */
    void add_parameters(Parameters &prm, const std::string &prefix, bool turns);

    /** Whether something presses at all. */
    bool
    is_given() const
    {
      return stiffness != 0 || !force.is_zero();
    }

    /** The law; complains, behind @p whose, about what makes no sense. */
    ContactLaw
    law(const Parameters &prm, const std::string &prefix, const std::string &whose, Complaints &complaints) const;

    /** Complain, behind @p whose, of each entry that is given though there is nothing to touch: @p why. */
    static void refuse_all(const Parameters  &prm,
                           const std::string &prefix,
                           const std::string &whose,
                           const std::string &why,
                           Complaints        &complaints);

  private:
    static std::string speed_name(const std::string &prefix);
    static std::string name(const std::string &prefix, const std::string &what);
    ContactLaw         by_expression(const Parameters  &prm,
                                     const std::string &prefix,
                                     const std::string &whose,
                                     Complaints        &complaints) const;
  };



  /** What users say of dry friction. */
  struct FrictionEntries
  {
    double kinetic = 0, breakaway = 0, stribeck_speed = 0, sticking_speed = 1e-4, preload = 0, radius = 0,
           bristle_stiffness = 0, bristle_damping = 0;

    /** @p with_preload: not only what presses by itself; @p turns: of a rotation, with a radius. */
    void add_parameters(Parameters &prm, bool with_preload, bool turns);

    bool
    is_given() const
    {
      return kinetic != 0 || breakaway != 0;
    }

    /** The law; complains, behind @p whose, about what makes no sense. */
    FrictionLaw law(const Parameters &prm, const std::string &whose, Complaints &complaints) const;

    /**
     * Complain, behind @p whose, of what is given of friction without saying how large it is: it would do nothing. @p
     * more: further entries that only friction needs, @p but: one that something else needs.
     */
    static void refuse_unused(const Parameters               &prm,
                              const std::string              &whose,
                              Complaints                     &complaints,
                              const std::vector<std::string> &more = {},
                              const std::string              &but  = "");
  };
} // namespace samara

#endif
