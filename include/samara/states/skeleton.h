#ifndef samara_states_skeleton_h
#define samara_states_skeleton_h

#include <samara/states/controller.h>

namespace samara
{
  /**
   * A controller to copy; doc/how_to/state.md tells how. It is tested (tests/skeleton), but not in the catalogue.
   *
   * An actuator that follows its signal u with a lag T, and not faster than a rate r:
   *
   *     ż = min(max((u − z)/T, −r), r)          output: z
   *
   * u, z and r/s have the unit of the output. In statics z = u, which is found from a start within the limits of the
   * rate only: beyond, ż does not depend on z, and there is no equilibrium that Newton's method could see. Complains in initialize() about a unit that is none,
   * and about a signal that is not given.
   */
  class Servo : public Controller
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;

  protected:
    std::vector<Input> inputs() const override;
    SignalPointer      rate(Model &model, unsigned int i) const override;
    SignalPointer      output(Model &model, unsigned int i) const override;

  private:
    Law    signal_law;
    double lag = 0.1, largest_rate = 1, initial = 0, scale = 1;
  };
} // namespace samara

#endif
