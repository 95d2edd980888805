#ifndef samara_joints_contacts_item_h
#define samara_joints_contacts_item_h

#include <samara/joints/contact_entries.h>
#include <samara/model/contact_group.h>
#include <samara/model/system.h>

#include <deque>
#include <set>

namespace samara
{
  /**
   * Bodies of which any two may touch: balls, planes, cylinders, hollow balls, and beams on planes, cylinders and in
   * hollow balls (ContactGroup). At a state their forces are a load with a potential; steps take them apart
   * (time/stage_contacts.h).
   *
   * Planes are half spaces and cylinders are endless. A beam is a row of places, each with its share of the length.
   */
  class ContactsItem : public Item, public Evaluated<ContactsItem, Force>
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;
    void connect(Layout &layout) override;

    bool
    acts_on_whole_model() const override
    {
      return true;
    }

    void tangent(const Point<double> &point, SparseMatrix &K) const override;
    void damping(const Point<double> &point, SparseMatrix &C) const override;
    bool
    has_potential() const override
    {
      return true;
    }
    double
    potential_energy(const Point<double> &point) const override
    {
      return group.energy(point.q) + (point.bristles != nullptr ? group.energy_of(*point.bristles) : 0.);
    }

    template <typename Number>
    void residual_at(const Point<Number> &point, Number *r) const;

    /**
     * "touched", the number of pairs that touch; "depth", the largest penetration [m]; "energy" [J]; "<body>.force x"
     * ... "z" and "ground.force x" ..., of the contacts of this group on that body [N].
     */
    std::optional<Probe>     probe(const std::string &path) const override;
    std::vector<std::string> probe_names() const override;

  private:
    std::vector<std::string> balls, planes, cylinders, tubes, hollow_balls, beams, rods;
    double                   ball_radius = 0, line_stiffness = 0;
    unsigned int             stations = 4;
    std::string              touching = "all", overlap = "refused";
    std::vector<std::string> law_entries;
    double                   rolling = 0, turning = 0;
    ContactEntries           contact;
    FrictionEntries          friction;
    ContactGroup             group;
    Model                   *model = nullptr;
    std::vector<int>         of_node; ///< first unknown of each node
    std::deque<Block>        blocks;  ///< to declare couplings

    struct Shape;
    void complain(const std::string &entry, const std::string &text) const;
    void add_balls();
    void
    add_surfaces(const std::vector<std::string> &texts, const std::string &entry, PairShape::Kind kind, bool hollow);
    void add_beams();
    /** Lines of one straight piece, both of its ends on the same body. */
    void add_rods();
    /** How many lines there are, of beams and rods. */
    std::size_t
    n_lines() const
    {
      return beams.size() + rods.size();
    }
    /** Where pieces meet at an angle that is no error of the mesh: abscissa of the first such place; 0 if there is
     * none. */
    double corner_of(const std::vector<Span> &spans) const;
    void   check_law();
    /** Whether beams may pass cylinders between stations. */
    void check_stations() const;
    /** Complain of entries for which there is nothing in the group. */
    void refuse_unused() const;
    void add_laws();
    /** Which law is that of which bodies. @p sides: the two names of each entry. */
    void assign_laws(const std::vector<std::array<std::string, 2>> &sides);
    void refuse_overlaps(const Layout &layout) const;
    void couple_pairs(Layout &layout);
    void add_nodes_of_lines(std::set<std::pair<unsigned int, unsigned int>> &pairs) const;
    template <typename Do>
    void for_touching(const double *q, const Do &what) const;
    template <typename Add>
    void    add_to_matrix(const Point<double> &point, SparseMatrix &A, const Add &value) const;
    Vector3 force_on(const Item *body, const State &state) const;
    /** Bristles of a pair at a state that knows some; null elsewhere. */
    const BentBristles *bent_at(const ContactGroup::Pair &pair, const PairBristles *bristles, BentBristles &bent) const;
  };

  template <typename Do>
  void
  ContactsItem::for_touching(const double *const q, const Do &what) const
  {
    thread_local std::vector<ContactGroup::Pair> pairs;
    thread_local ContactGroup::Margins           margins;
    group.find_pairs(q, nullptr, 0, pairs, margins);
    for (const auto &pair : pairs)
      what(pair);
  }



  extern template class Evaluated<ContactsItem, Force>;
} // namespace samara

#endif
