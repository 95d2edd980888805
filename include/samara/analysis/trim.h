#ifndef samara_analysis_trim_h
#define samara_analysis_trim_h

#include <samara/analysis/periodic_motion.h>
#include <samara/output/table.h>

#include <Eigen/Dense>

#include <array>

namespace samara
{
  /** A number with a unit that is known later: SI value with the dimension of a unit, as the file understands it. */
  struct LateNumber
  {
    std::string                                text;      ///< as given; empty: not given
    double                                     plain = 0; ///< SI
    std::function<double(const std::string &)> in;        ///< @throws std::invalid_argument for a wrong dimension

    LateNumber() = default;
    LateNumber(const std::string &text, const Quantities &quantities);
  };

  /** "collective from -5 deg to 20 deg": the name of a state and its limits, which may be left out. */
  struct TrimControl
  {
    std::string name;
    LateNumber  lower, upper;
  };

  /** "cos 1 of flap.rotation = 0 deg": a mean, or a harmonic, of a probe and the value it shall have. */
  struct TrimTarget
  {
    std::string         probe;
    PeriodAverage::Part part     = PeriodAverage::mean;
    unsigned int        harmonic = 0;
    LateNumber          value;
  };

  /** "mu from 0.1": a constant of the model, its value in SI units at the start of a continuation and as the file has
   * it. */
  struct TrimContinuation
  {
    std::string constant;
    double      first = 0, last = 0;
  };

  class TrimAnalysis;

  /** The model with other values of constants, before its trim. */
  class TrimVariant
  {
  public:
    virtual ~TrimVariant()          = default;
    virtual Context      &context() = 0;
    virtual TrimAnalysis &trim()    = 0;

    /** What comes before trim in the list of analyses. */
    virtual void lead_up() = 0;
  };

  template <>
  struct Value<TrimContinuation>
  {
    static constexpr char separator = ',';
    static constexpr bool has_unit  = false;

    static TrimContinuation read(const std::string &text, const std::string &unit, const Quantities &quantities);
    /** Nothing: what is written has no constants any more. */
    static std::string    write(const TrimContinuation &value);
    static PatternPointer pattern();
  };

  template <>
  struct Value<TrimControl>
  {
    static constexpr char separator = ',';
    static constexpr bool has_unit  = false;

    static TrimControl    read(const std::string &text, const std::string &unit, const Quantities &quantities);
    static std::string    write(const TrimControl &value);
    static PatternPointer pattern();
  };

  template <>
  struct Value<TrimTarget>
  {
    static constexpr char separator = ',';
    static constexpr bool has_unit  = false;

    static TrimTarget     read(const std::string &text, const std::string &unit, const Quantities &quantities);
    static std::string    write(const TrimTarget &value);
    static PatternPointer pattern();
  };

  template <>
  struct Value<LateNumber>
  {
    static constexpr char separator = ',';
    static constexpr bool has_unit  = false;

    static LateNumber     read(const std::string &text, const std::string &unit, const Quantities &quantities);
    static std::string    write(const LateNumber &value);
    static PatternPointer pattern();
  };



  /**
   * Trim: the values of controls, states of first order that keep still, for which a periodic motion meets as many
   * targets, means or harmonics of probes over a period (the paper, section 4.4; doc/theory/trim.md).
   *
   *   Newton-Krylov  periodicity and targets at once, (x(T) − x(0), ȳ − y*) = 0 for (x(0), u), by Newton's method with
   *                  GMRES on products with the exact tangent of a period, or where it has none, differences
   *   discrete       lets the motion settle for some turns, corrects u ← u − J⁻¹(ȳ − y*), and J by Broyden's update
   *   auto-pilot     u̇ = −(1/τ) J⁻¹(ȳ − y*), ȳ over the last period
   *
   * If a search fails and there is a <Continue>, a constant of the model goes from another value to that of the file,
   * in steps that are halved where a search fails, each from the motions found before (doc/theory/trim.md).
   *
   * With a <Symmetry> a turn is a Q-th of the period, behind which the Q repeated parts are renumbered
   * (PeriodicMotion, RepeatedParts); that they are alike is tested before and behind the search, on whole periods.
   *
   * The latter two begin with J from differences of settled motions. The motion starts as that of a dynamic analysis
   * does. The state that is left, at the <Start time>, lies on the orbit: dynamic goes on from there.
   *
   * Writes trim.csv, controls and targets, and trim_history.csv. @throws InputError for what is no control or no
   * target, NotConverged for targets that cannot be met, with the best state that was reached in the context.
   */
  class TrimAnalysis : public Analysis
  {
  public:
    void add_parameters(Parameters &prm) override;
    void check(const std::vector<double> &rotor_speeds, Complaints &complaints) const override;
    void run(Context &context) override;

    std::optional<Effort>
    effort() const override
    {
      return report.effort;
    }

    /** What the last run has found. */
    struct Report
    {
      std::vector<double>   controls, averages; ///< SI
      double                turns       = 0;
      unsigned int          products    = 0; ///< with the exact tangent of a turn, or of a section
      double                periodicity = 0; ///< largest gap of the orbit, in scales
      double                miss        = 0; ///< of the worst target, in scales
      unsigned int          iterations  = 0;
      std::optional<Effort> effort;
    };
    Report report;

    // entries
    std::vector<TrimControl> controls;
    std::vector<TrimTarget>  targets;
    std::vector<LateNumber>  scales;

    std::vector<TrimContinuation> continuation;
    /** A model whose constants are these parts of what the file says; set by who reads files. */
    std::function<std::unique_ptr<TrimVariant>(const std::vector<std::pair<std::string, double>> &)> variant;

    std::string              method = "Newton-Krylov", symmetry;
    std::vector<std::string> turning;
    double period = 0, start_time = 0, tolerance = 1e-8, spectral_radius = 0.5, newton_tolerance = 1e-12,
           time_constant = 2;
    unsigned int n_steps = 60, n_stages = 3, settle = 3, most_turns = 200, max_iterations = 50, most_products = 60;

  private:
    class Run;
    class Path;
  };
} // namespace samara

#endif
