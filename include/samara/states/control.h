#ifndef samara_states_control_h
#define samara_states_control_h

#include <samara/model/counted_states.h>
#include <samara/model/terms.h>

namespace samara
{
  /**
   * A control: a number that keeps its value in motion, ż = 0, until trim chooses another one (doc/theory/trim.md). The
   * collective angle of a rotor, the throttle. Laws name it like any state.
   *
   * In statics it has the value that the file gives, (value − z)/(1 s) = 0.
   */
  class Control : public Item, public Evaluated<Control, StateEquation>, public HasCountedStates
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;
    void connect(Layout &layout) override;

    template <typename Number>
    void residual_at(const Point<Number> &point, Number *r) const;
    void tangent(const Point<double> &point, SparseMatrix &K) const override;
    void damping(const Point<double> &point, SparseMatrix &C) const override;

    /** The control itself, "" for its path is its name, in its unit. */
    std::optional<Probe> probe(const std::string &path) const override;

    bool
    is_control() const override
    {
      return true;
    }

    /** Controls never decide on steps. */
    std::vector<CountedStates>
    counted_states() const override
    {
      return {{{number}, {1.}, 0.}};
    }

  private:
    double      value = 0, scale = 1;
    std::string unit;

    unsigned int number = 0, row = 0;
    Block        block; ///< of the control alone
  };

  // instantiated where the template of the class is defined
  extern template class Evaluated<Control, StateEquation>;
} // namespace samara

#endif
