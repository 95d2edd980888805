#ifndef samara_states_first_order_h
#define samara_states_first_order_h

#include <samara/model/counted_states.h>
#include <samara/model/response.h>

namespace samara
{
  /**
   * A state of first order, ż = g with a law g of time, signals and states: a filter, a lag, an actuator, the integral
   * of a controller. Statics look for the z at which g vanishes (the paper has no such states; doc/theory/states.md).
   */
  class FirstOrder : public Item, public Evaluated<FirstOrder, StateEquation>, public HasCountedStates
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;
    void find_signals(Model &model) override;
    void connect(Layout &layout) override;

    template <typename Number>
    void   residual_at(const Point<Number> &point, Number *r) const;
    void   tangent(const Point<double> &point, SparseMatrix &K) const override;
    void   damping(const Point<double> &point, SparseMatrix &C) const override;
    double next_corner(double from, double to) const override;
    void   pieces(const Point<double> &point, std::vector<double> &result) const override;

    /** The state itself, "" for its path is its name, in its unit. */
    std::optional<Probe> probe(const std::string &path) const override;

    /** With its weight, if there is one. */
    std::vector<CountedStates>
    counted_states() const override
    {
      return weight > 0 ? std::vector<CountedStates>{{{number}, {1.}, weight}} : std::vector<CountedStates>{};
    }

  private:
    Law         rate;
    double      initial = 0, scale = 1, weight = 0;
    std::string unit;

    unsigned int              number = 0, row = 0;
    std::unique_ptr<Response> response; ///< of the rate, if it depends on the model's state
    Block                     block;    ///< of the state alone
  };

  // instantiated where the template of the class is defined
  extern template class Evaluated<FirstOrder, StateEquation>;
} // namespace samara

#endif
