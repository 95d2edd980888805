#ifndef samara_cosserat_element_lanes_h
#define samara_cosserat_element_lanes_h

#include <samara/base/lanes.h>
#include <samara/cosserat/element_table.h>
#include <samara/cosserat/kernel.h>
#include <samara/model/linear_strains.h>

#include <array>
#include <memory>
#include <vector>

namespace samara
{
  template <int dim>
  class Cosserat;

  /**
   * Elements of one or of several bodies side by side, four of one degree at once: their strains, rates of strains and
   * forces. Where lanes hold one number, std::complex<double>, elements are computed one by one.
   *
   * Pointers to strains, rates and stresses start where the places of the bodies' strains are counted from.
   */
  template <int dim>
  class ElementLanes
  {
  public:
    /** From this many batches on threads are faster (doc/benchmarks/sizes.md). */
    static constexpr unsigned int worth_threads = 100;

    /** A body, and the place of its first strain. */
    struct Part
    {
      const Cosserat<dim> *body;
      unsigned int         first_strain;
    };

    ElementLanes() = default;
    /** The bodies stay where they are, and keep their elements. */
    explicit ElementLanes(const std::vector<Part> &parts);

    /** Strains, those of the reference configurations subtracted. */
    template <typename Number>
    void strains(const Point<Number> &point, Number *e) const;
    void strain_rates(const Point<double> &point, double *rates) const;

    /** Add the forces of these stresses to the global @p r. */
    template <typename Number>
    void add_forces(const Point<Number> &point, const Number *stress, Number *r) const;

    /** strain_rates() and add_forces(): what both need of a point is found once. */
    void add_forces_and_rates(const Point<double> &point, const double *stress, double *r, double *rates) const;

    /** The lanes must stay where they are. */
    std::unique_ptr<LinearStrains> linear_strains() const;

  private:
    static constexpr unsigned int n          = 6 * dim; ///< strains at a point
    static constexpr unsigned int most_nodes = ElementTable<dim>::most_nodes, most_tied = ElementTable<dim>::most_tied;

    std::vector<Part> parts;

    struct Lane
    {
      const Cosserat<dim> *body;
      unsigned int         element, first_strain;
    };

    /** Elements of one degree that are computed at once. */
    struct Batch
    {
      std::vector<Lane>         lanes;
      std::vector<unsigned int> nodes; ///< of all lanes at each node of an element; the last element fills up

      /** A frame of an element that is not the node itself. */
      struct Arm
      {
        unsigned int a, lane;
      };
      std::vector<Arm> arms;

      /** Of the points of an element, in all lanes: the weight, and of a beam its T. */
      std::vector<FourDoubles> weights, T;
    };
    std::vector<Batch> batches, single_elements; ///< of doubles, of other numbers
    unsigned int       most_nodes_of_element = 0;

    static const auto              &element_of(const Lane &lane);
    static const ElementTable<dim> &table_of(const Batch &batch);

    static Batch make_batch(const std::vector<Lane> &lanes, unsigned int n_lanes);

    template <typename Number>
    const std::vector<Batch> &
    batches_of() const
    {
      return Lanes<Number>::size > 1 ? batches : single_elements;
    }

    /** Call f(batch, number of nodes) for all batches. */
    template <typename Number, typename Function>
    void for_batches(const Function &f) const;

    /** Call f(i, number of nodes, forces of each element, 6 a node) for all batches i and add what comes out to the
     * global @p r. */
    template <typename Number, typename Function>
    void add_batches(const Function &f, Number *r) const;

    /** Positions and triads of the nodes of a batch. */
    template <typename Number>
    static void
    gather_lanes(const Batch &batch, const Number *q, kernel::NodeValues<typename Lanes<Number>::type> *nodes);

    /** The nodes' twists, in their own frames. */
    static void gather_twists(const Batch &batch, const double *y, Vec6<Lanes<double>::type> *twists);

    /** @name One batch; @p N is its number of nodes an element if that is known when compiling, else 0. @{ */
    template <int N, typename Number>
    static void batch_strains(const Batch &batch, const Point<Number> &point, Number *e);
    template <int N>
    static void batch_strain_rates(const Batch &batch, const Point<double> &point, double *rates);
    template <int N, typename Number>
    static void batch_forces(const Batch                                     &batch,
                             const Point<Number>                             &point,
                             const Number                                    *stress,
                             const std::array<Number *, Lanes<Number>::size> &forces);

    template <int N>
    static void batch_forces_and_rates(const Batch                   &batch,
                                       const Point<double>           &point,
                                       const double                  *stress,
                                       const std::array<double *, 4> &forces,
                                       double                        *rates);

    /** Section forces at the tying points from the stresses of the model. */
    template <typename Number>
    static void batch_to_tying(const Batch &batch, const Number *stress, Vec6<typename Lanes<Number>::type> *tied);

    /** Strains of the elements of a batch at their integration points from those at the tying points. */
    template <typename Number>
    static void batch_to_points(const Batch &batch, const Vec6<typename Lanes<Number>::type> *tied, Number *e);
    /** @} */

    class StoredStrains;
  };



  extern template class ElementLanes<1>;
  extern template class ElementLanes<2>;
} // namespace samara

#endif
