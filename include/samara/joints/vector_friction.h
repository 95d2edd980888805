#ifndef samara_joints_vector_friction_h
#define samara_joints_vector_friction_h

#include <samara/joints/contact_entries.h>
#include <samara/joints/contact_terms.h>
#include <samara/model/model.h>

namespace samara
{
  /**
   * Dry friction against several free motions of a joint at once, by their common speed, so that it acts against the
   * slip whatever its direction:
   *
   *     in a plane    w = (ḋ₁, ḋ₂)                     of the origin of B, seen from A; the two displacements
   *     of a ball     w = r (ω_B − ω_A) in axes of A    r the "Friction radius"
   *
   * The angular velocities are rates of three unknowns of its own, with rows for velocities alone. What presses are the
   * reactions of the joint's locked displacements, and the "Friction preload".
   *
   * Of a ball r is the arm of all turns alike, as where the pressure is spread over the shell: N on one spot would
   * leave turns about its normal free.
   */
  class VectorFriction
  {
  public:
    enum class Of
    {
      plane,
      ball
    };

    explicit VectorFriction(Of of);
    ~VectorFriction();

    /** The subsection "displacement" or "rotation" of the joint. */
    void add_parameters(Parameters &joint);

    /** Whether the joint has it: add_parameters() was called. */
    bool
    is_declared() const
    {
      return has_entries;
    }

    /** Whether the user asks for it. */
    bool
    is_given() const
    {
      return entries.is_given();
    }

    /** Check the entries, and add unknowns. @p displacements: the coordinates of both of them, in a plane. */
    void
    initialize(Model &model, const Item &joint, const Parameters &prm, const std::vector<unsigned int> &displacements);

    /** Add the terms. @p multipliers: of the locked displacements. */
    void connect(Layout                          &layout,
                 const Item                      &joint,
                 const Frame                     &a,
                 const Frame                     &b,
                 const std::vector<unsigned int> &multipliers);

    /** The same of a ball with rows of its own for the three unknowns that turn as it does, from first_turn() on. */
    void connect(Layout                          &layout,
                 const Item                      &joint,
                 std::unique_ptr<Constraint>      rows,
                 const std::vector<unsigned int> &multipliers);
    unsigned int
    first_turn() const
    {
      return coordinates.front();
    }

  private:
    void add_to(Layout &layout, const Item &joint, const std::vector<unsigned int> &multipliers);

    const Of        of;
    bool            has_entries = false;
    FrictionEntries entries;
    FrictionLaw     law;

    std::vector<unsigned int> coordinates, bristles;

    /** Of a ball. @{ */
    class Turns;
    std::unique_ptr<Constraint> turns;
    /** @} */
    ContactTerms terms;

    std::string
    motion() const
    {
      return of == Of::ball ? "rotation" : "displacement";
    }
  };
} // namespace samara

#endif
