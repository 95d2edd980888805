#ifndef samara_joints_buffer_h
#define samara_joints_buffer_h

#include <samara/joints/contact_entries.h>
#include <samara/joints/contact_terms.h>
#include <samara/joints/sliding.h>

namespace samara
{
  /**
   * Between two that slide on one beam, which cannot pass each other. With their abscissae S_A and S_B, and the length
   * L of the buffer along the beam, the gap
   *
   *     g = σ (S_B − S_A) − L,   σ = ±1 the order in the reference configuration
   *
   * less that of the reference configuration is an unknown c [m] with the row σ (d_B − d_A) − c = 0 of the
   * displacements d of both joints. It has a stop where g = 0, whose law is that of all stops (doc/theory/contact.md):
   * it presses where g < 0. The force along the beam on one is that on the other, reversed; the multiplier is the force
   * [N], positive where it presses both apart.
   */
  class Buffer : public Item, public Evaluated<Buffer, Constraint>
  {
  public:
    std::string
    noun() const override
    {
      return "buffer";
    }

    void add_parameters(Parameters &prm) override;

    /** Complains about joints that do not slide on one beam, and of a contact without stiffness. */
    void initialize(Model &model) override;

    /** Complains about two that press into each other in the reference configuration. */
    void connect(Layout &layout) override;
    void tangent(const Point<double> &point, SparseMatrix &K) const override;
    void rates(const Point<double> &point, double *rates) const override;

    /** None: it is linear in the coordinates. */
    void
    second_rates(const Point<double> &, double *) const override
    {}

    template <typename Number>
    void residual_at(const Point<Number> &point, Number *r) const;

    /** "gap" [m], "gap rate" [m/s], "force" [N]. */
    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;

  private:
    std::string                         joint_a, joint_b;
    double                              length = 0; ///< [m]
    ContactEntries                      contact;
    ContactLaw                          law;
    std::array<const SlidingJoint *, 2> joints      = {{nullptr, nullptr}};
    double                              order       = 1;           ///< σ
    double                              gap         = 0;           ///< in the reference configuration [m]
    std::array<unsigned int, 3>         coordinates = {{0, 0, 0}}; ///< of A, of B, c
    unsigned int                        multiplier  = 0;
    Block                               block;
    ContactTerms                        stop;

    std::array<double, 3>
    slopes() const
    {
      return {{-order, order, -1.}};
    }
    bool   find_joints(Model &model);
    void   complain(Model &model, const std::string &entry, const std::string &text) const;
    Model *model = nullptr;
  };

  extern template class Evaluated<Buffer, Constraint>;
} // namespace samara

#endif
