#ifndef samara_model_compound_signal_h
#define samara_model_compound_signal_h

#include <samara/base/law.h>
#include <samara/model/signal.h>

namespace samara
{
  /**
   * A number that is made of signals, f(t, s_1, …, s_n), and is a signal itself: the output of a controller. Its
   * derivatives are those of f times those of its parts.
   */
  class CompoundSignal : public Signal
  {
  public:
    explicit CompoundSignal(const std::vector<SignalPointer> &parts);

    double               value(const Point<double> &point) const override;
    std::complex<double> value(const Point<std::complex<double>> &point) const override;
    double               rate(const Point<double> &point) const override;
    void                 add_gradient(const Point<double> &point, double *by_place, double *by_velocity) const override;
    void                 resolve(const Model &model) override;
    void                 pieces(const Point<double> &point, std::vector<double> &result) const override;
    double               next_corner(double from, double to) const override;

  protected:
    /** f where the variables are time and then the parts. */
    virtual double f(const double *variables) const = 0;

    /** Its derivative by variable @p i: 0 time, 1 the first part. */
    virtual double slope(const double *variables, unsigned int i) const = 0;

    /** On which of its pieces f is. */
    virtual void
    own_pieces(const double * /*variables*/, std::vector<double> & /*result*/) const
    {}

    virtual double
    own_next_corner(double /*from*/, double /*to*/) const
    {
      return std::numeric_limits<double>::infinity();
    }

  private:
    std::vector<SignalPointer> parts;

    std::vector<double> variables(const Point<double> &point) const;
    void                gather();
  };



  /** Σ c_i s_i */
  struct Summand
  {
    double        factor;
    SignalPointer signal;
  };
  SignalPointer sum_of_signals(const std::vector<Summand> &summands);

  /** Between two limits. */
  SignalPointer saturated_signal(const SignalPointer &signal, double lower, double upper);

  /** A law, with its signals found in the model. @throws std::invalid_argument, FollowUp as Model::signal() */
  SignalPointer signal_of_law(const Law &law, Model &model);
} // namespace samara

#endif
