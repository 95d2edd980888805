#ifndef samara_time_stage_contacts_h
#define samara_time_stage_contacts_h

#include <samara/model/contact_group.h>
#include <samara/time/integrator.h>
#include <samara/time/stage_stops.h>

namespace samara
{
  /**
   * Contacts of groups in the stages of a step. Each near pair acts in each stage by its own gap, nothing is located or
   * switched. With φ of PairShape and D = (d_i + d_f)/2 the rates
   *
   *     r_k = ± φ̇_k/D          h Σ b r = ± (d_f² − d_i²)/(2 D) = g_f − g_i
   *
   * to round-off, as φ is quadratic: forces ± f_k/D along the gradient of φ, with f_k of contact_forces(), do the work
   * U_f − U_i and lose what the damper does.
   *
   * Where φ is not quadratic, at nearest places and with axes that turn, a small force along the relative velocity does
   * what is missing.
   *
   * What is not so is refused, and the step halved: something has gone farther than pairs were searched for; the
   * potential of a search of its own at the end is not what the forces of the pairs have worked (a touch that no pair
   * has led to); a ball has gone through another between two stages; one presses so deep
   * that it would come out on the other side. The account of a step takes the potential of that search, not the work.
   */
  class StageContacts
  {
  public:
    StageContacts(const System &system, const Tableau &tableau);

    bool
    is_empty() const
    {
      return system.layout.contact_groups.empty();
    }

    /** Search for pairs that are near in a step of @p h from here. */
    void start(const State &state, double h);

    /** Bristles of what touches at the end of the step that was accepted. */
    void finish(State &state) const;

    /**
     * Add the forces to the residuals; @p end: places at the end of the step. In steps that turn they are seen in
     * reciprocal axes; @p in_axes gets them in the axes of nodes, too, where their work is what it ought to be.
     */
    void evaluate(const std::vector<Point<double>> &stages,
                  const double                     *end,
                  double                            h,
                  const std::vector<double *>      &residuals,
                  const std::vector<double *>      &in_axes = {});

    /** Why this step is no good, of which evaluate() was the last iteration; empty if it is. @p allowed: energy [J]. */
    std::string refusal(const std::vector<Point<double>> &stages, const double *end, double allowed) const;

    /** Add losses, and the work by the potential; to be called behind refusal(). */
    void account(StepResult &result) const;

    /** Name of a pair that is touched in the step; empty if none is. */
    std::string touched() const;

    /** @name Matrices @{ */
    /** Nodes that pairs couple and that are not in the pattern of the layout, as (row, column), sorted; both ways. */
    using Couplings = std::vector<std::pair<unsigned int, unsigned int>>;
    Couplings couplings() const;

    /** Blocks of the pairs touched at a point, see ContactGroup::add_matrices(). */
    void add_matrices(const Point<double> &point, const ContactGroup::AddBlocks &add, int stage = -1) const;
    /** @} */

  private:
    const System  &system;
    const Tableau &tableau;

    /** A near pair in the step. */
    struct Near
    {
      const ContactGroup *group;
      ContactGroup::Pair  pair;
      double              gap, distance;                       ///< at the start
      bool                is_touched = false, is_lost = false; ///< no nearest places
      double              friction_loss = 0;
      StopForces          forces        = {}; ///< of the last evaluation
      int                 bristles      = -1; ///< number among these, if it has some
    };
    std::vector<Near> near;

    /** Bristles of a near pair in the step, inertial components; see stage_contact_bristles.cc. */
    struct Bristles
    {
      Vector3                normal, start;                           ///< at the start
      unsigned int           node;                                    ///< of A, with which they turn about the normal
      std::array<Vector3, 3> stages = {};                             ///< of the last evaluation
      Vector3                end    = Vector3::Zero();                ///< zero where nothing touches any more
      double                 loss = 0, elastic = 0;                   ///< [J]; elastic: change of ½ σ₀ |z|²
      double                 dissipated     = 0;                      ///< by the tableau [J]
      bool                   touches_at_end = false, is_lost = false; ///< the normal turned too far
    };
    std::vector<Bristles> bristles;
    double                step = 0, lost_at_start = 0; ///< [s]; energy of bristles whose pair is not found again [J]

    void start_bristles(const State &state, Near &pair, const PairMeasure<double> &m);
    void find_lost_bristles(const State &state);
    void straighten(const Near &pair);
    /** Forces against the slips of the stages, in @p rub; what they do to energies. */
    void rub(const Near                       &pair,
             const std::vector<Point<double>> &stages,
             const double                     *end,
             const PairMeasure<double>        &at_end,
             double                            h,
             std::array<Vec3<double>, 3>      &rub);

    struct GroupAtStart
    {
      ContactGroup::Margins margins;
      double                energy = 0; ///< [J]
    };
    std::vector<GroupAtStart>       groups;
    std::vector<double>             q_start;
    mutable std::vector<double>     change_of_energy; ///< of groups, by a search at the end [J]
    std::vector<ContactGroup::Pair> found;
    /** Of the pair at hand. @{ */
    std::vector<PairMeasure<double>>   measures_of_stages;
    ContactGroup::Sides                sides;
    std::array<ContactGroup::Sides, 3> sides_of_stages;
    /** @} */

    void        evaluate(Near                             &pair,
                         const std::vector<Point<double>> &stages,
                         const double                     *end,
                         double                            h,
                         const std::vector<double *>      &residuals,
                         const std::vector<double *>      &in_axes);
    std::string moved_too_far(const std::vector<Point<double>> &stages, const double *end) const;
    std::string passed_unseen(const std::vector<Point<double>> &stages, const double *end) const;
    std::string energy_missing(const double *end, double allowed) const;
  };
} // namespace samara

#endif
