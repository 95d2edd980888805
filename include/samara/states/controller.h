#ifndef samara_states_controller_h
#define samara_states_controller_h

#include <samara/model/compound_signal.h>
#include <samara/model/response.h>

namespace samara
{
  /**
   * What has states of first order ż_i = g_i of its own, which nobody names, and outputs y_j that laws may name: the
   * first by its own name, "pilot"; of several each by a number, "pilot_1", "pilot_2". g and y are signals of the
   * states and of laws that are its inputs.
   */
  class Controller : public Item, public Evaluated<Controller, StateEquation>
  {
  public:
    void find_signals(Model &model) override;
    void connect(Layout &layout) override;

    template <typename Number>
    void   residual_at(const Point<Number> &point, Number *r) const;
    void   tangent(const Point<double> &point, SparseMatrix &K) const override;
    void   damping(const Point<double> &point, SparseMatrix &C) const override;
    double next_corner(double from, double to) const override;
    void   pieces(const Point<double> &point, std::vector<double> &result) const override;

    /** Output "" or "1", "2", …: the second part of a name with a number. */
    std::shared_ptr<Signal> signal(Model &model, const std::string &path) override;
    std::optional<Probe>    probe(const std::string &path) const override;

  protected:
    std::string unit; ///< of the outputs

    /** Bind "Unit", what the outputs are in. */
    void add_unit(Parameters &prm);
    /** Complain if it is none. */
    void check_unit(Model &model, const std::string &entry, const std::string &given) const;

    /** Make one more state. To be called from initialize(). */
    void add_state(Model &model, const std::string &what, const std::string &unit, double initial, double scale);

    /** @name What a kind of controller says @{ */
    /** Its laws, and the entries where they stand. */
    struct Input
    {
      std::string entry;
      const Law  *law;
    };
    virtual std::vector<Input> inputs() const = 0;

    virtual unsigned int
    n_outputs() const
    {
      return 1;
    }

    /** The rate of a state, and an output. */
    virtual SignalPointer rate(Model &model, unsigned int i) const   = 0;
    virtual SignalPointer output(Model &model, unsigned int i) const = 0;
    /** @} */

    /** A state as a signal. */
    SignalPointer
    state(const unsigned int i) const
    {
      return state_signal(numbers[i]);
    }

    std::vector<unsigned int> numbers; ///< of its states among those of the model

  private:
    std::vector<Response>      rates;
    std::vector<SignalPointer> outputs; ///< for probes
    std::vector<unsigned int>  rows;
    Block                      block;
    bool                       is_asked = false; ///< for an output that is being made

    /** Which output "", "1", "2" is; nothing if there is none. */
    std::optional<unsigned int> output_number(const std::string &path) const;
  };

  extern template class Evaluated<Controller, StateEquation>;



  /**
   * u = K_p e + I + D between limits, with the error e = target − signal,
   *
   *     İ = K_i e + (u − v)/T_t          v = K_p e + I + D before it is limited
   *     D = K_d (e − f)/T_f,   ḟ = (e − f)/T_f,   or −K_d times the signal's own rate where that is given
   *
   * The second term of İ acts beyond the limits alone: the integral is led back there in the time T_t and does not wind
   * up (back-calculation; Åström & Hägglund, Advanced PID Control, 2006, section 3.5).
   */
  class PidController : public Controller
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;

  protected:
    std::vector<Input> inputs() const override;
    SignalPointer      rate(Model &model, unsigned int i) const override;
    SignalPointer      output(Model &model, unsigned int i) const override;

  private:
    Law         signal_law, target, signal_rate;
    std::string signal_unit;
    double      proportional = 0, integral = 0, derivative = 0, filter_time = 0, tracking_time = 0;
    double      lower = 0, upper = 0, initial = 0, scale = 1;
    bool        is_limited = false, has_signal_rate = false;
    int         integral_state = -1, filter_state = -1; ///< among its own

    SignalPointer error(Model &model) const;
    SignalPointer unlimited(Model &model) const;
  };



  /** ẋ = A x + B u, y = C x + D u with the values of laws u. */
  class LinearController : public Controller
  {
  protected:
    Eigen::MatrixXd  A, B, C, D;
    std::vector<Law> laws;

    void add_states(Model &model, const Eigen::VectorXd &initial, double scale);

    unsigned int
    n_outputs() const override
    {
      return C.rows();
    }
    SignalPointer rate(Model &model, unsigned int i) const override;
    SignalPointer output(Model &model, unsigned int i) const override;

    /** a·x + b·u; a law is not looked at where its factor is zero. */
    SignalPointer combination(Model &model, const Eigen::RowVectorXd &a, const Eigen::RowVectorXd &b) const;
  };



  /** The matrices as they are given. */
  class StateSpace : public LinearController
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;

  protected:
    std::vector<Input> inputs() const override;

  private:
    std::vector<std::vector<double>> given_A, given_B, given_C, given_D;
    std::vector<double>              initial;
    double                           scale = 1;
  };



  /**
   * y = N(s)/D(s) u, in controllable form, with time in units of 1/ω, ω = |d_0/d_n|^(1/n): states are of the size of
   * the input, as long as it changes slowly.
   */
  class TransferFunction : public LinearController
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;

  protected:
    std::vector<Input> inputs() const override;

  private:
    std::vector<double> numerator, denominator;
    Law                 input;
    double              scale = 1;
  };



  /**
   * y(t) = u(t − T), as the Padé approximant of e^(−sT) of degree n − 1 over n, whose states are the Legendre
   * coefficients of the input over the time T (Voelker & Eliasmith, Neural Comput. 30, 2018, section 2.2):
   *
   *     T ẋ_i = Σ_j a_ij x_j + (2i + 1) (−1)^i u,   a_ij = (2i + 1) (−1 for i < j, (−1)^(i−j+1) otherwise),   y = Σ x_i
   *
   * It is strictly proper: nothing goes through at once.
   */
  class Delay : public LinearController
  {
  public:
    void add_parameters(Parameters &prm) override;
    void initialize(Model &model) override;

  protected:
    std::vector<Input> inputs() const override;

  private:
    Law          input;
    double       time = 0, initial = 0, scale = 1;
    unsigned int order = 4;
  };
} // namespace samara

#endif
