#ifndef samara_analysis_trim_run_h
#define samara_analysis_trim_run_h

#include <samara/analysis/line_of_air.h>
#include <samara/analysis/trim.h>

#include <deque>
#include <limits>

namespace samara
{
  /** What lasts as long as a search for trim does; controls and averages in SI units. */
  class TrimAnalysis::Run
  {
  public:
    /** @throws InputError for what is no control or no target */
    Run(TrimAnalysis &trim, Context &context);

    /** Find trim, leave it in the context and write it. @throws NotConverged, with the best that was found there */
    void go();

    /** The same from a motion near by, controls within their limits. */
    void go_on(const State &near);

    /** Which targets the controls move least about a motion that is trimmed, and which controls are at a limit. */
    std::string weakness(const State &orbit);

    struct Limit
    {
      std::string name;
      double      value, lower, upper;
    };
    /** Controls of a state, and how far they may go. */
    std::vector<Limit> limits(const State &now) const;

  private:
    using VectorX = Eigen::VectorXd;

    struct Control
    {
      std::string  name, unit;
      unsigned int state = 0; ///< its number
      double       lower = 0, upper = 0, scale = 1;
    };
    struct Target
    {
      std::string name, unit;
      double      value = 0, scale = 1, factor = 1; ///< factor: of the probe's unit in SI
    };

    /** A turn, and how far it is from trim. */
    struct Look
    {
      State               start, end;
      VectorX             averages;
      std::vector<double> gap;    ///< see PeriodicMotion::gap()
      std::vector<double> turned; ///< whole turns of the joint coordinates, taken back from the end [rad]
      double              miss = std::numeric_limits<double>::infinity(), largest_gap = miss; ///< in scales
      unsigned int        worst_target = 0, worst_gap = 0;

      double
      size() const
      {
        return std::max(miss, largest_gap);
      }
    };

    TrimAnalysis                   &trim;
    Context                        &context;
    const System                   &system;
    std::vector<Control>            controls;
    std::vector<Target>             targets;
    std::optional<RepeatedParts>    parts;  ///< with a symmetry
    std::unique_ptr<PeriodicMotion> motion; ///< its turns are sections then
    std::unique_ptr<PeriodicMotion> whole;  ///< periods, in the end
    State                           state;  ///< at the start of the next period
    Look                            best;
    std::optional<Table>            history;
    unsigned int                    n_looks = 0;
    /**
     * What products with the Jacobian have told so far, that of the last step of Newton's method first: J u = q with
     * orthonormal q. The next step begins with it: u for q, and nothing changed across all q, is nearly J⁻¹ there.
     */
    struct Known
    {
      std::vector<VectorX> q, u;
    };
    Known               known;
    unsigned int        n_without_tangent = 0; ///< turns one after another that had none: on some a stop is touched
    double              tolerance         = 0; ///< that of the entries, and less where a motion drifts
    double              asymmetry         = 0; ///< by which steps treat the repeated parts differently, in scales
    LineOfAir           air;                   ///< of that period
    std::vector<double> gap_behind;            ///< of the period in which what was found has been confirmed

    std::vector<PeriodAverage>      find_targets();
    std::unique_ptr<PeriodicMotion> make_motion(unsigned int n_steps);
    /** Turns that were marched, sections as parts of them. */
    double                   turns() const;
    void                     find_controls();
    std::vector<std::string> columns() const;

    /** @name Motions @{ */
    void search();
    void start();
    void require_controls(const State &now) const;
    Look look(const State &from, const PeriodicMotion::Observer &observer = {});
    Look settled(State from);
    bool is_trimmed(const Look &look) const;
    /** From a look at a motion near by to one that is trimmed, by the method that is given. */
    Look by_method(const Look &now);
    /** @name Drift: trim_drift.cc @{ */
    /** The same until nothing drifts, confirmed: a gap that hardly falls from turn to turn belongs to an orbit far
     * away. */
    Look without_drift(const Look &now);
    /** How far the orbit is from the end of confirm(), by how the gap falls from turn to turn, in scales. */
    double distance_of_orbit(State now);
    /** The same by another step of Newton's method, which knows what controls do. */
    double size_of_newton_step(const Look &found);
    /** @} */
    /** @name Sections: trim_sections.cc @{ */
    /** Turns become sections of the repeated parts. @p moving: how things turn. @throws InputError */
    void use_symmetry(const State &moving);
    /** What turns without being named is refused. @throws InputError */
    void require_turning(const State &moving) const;
    /**
     * Whether the section behind a look is the same with the parts in each other's places; a difference that falls with
     * the step is the steps' own. @throws NotConverged
     */
    void check_symmetry(const Look &first);
    /** @} */
    VectorX controls_of(const State &state) const;
    VectorX wanted() const;
    VectorX averages_in_si(const std::vector<double> &averages) const;
    void    set_controls(State &state, const VectorX &values) const;
    /** The share of a change @p du that limits leave, up to 1. */
    double within_limits(const VectorX &u, const VectorX &du) const;
    /** @} */

    /** @name Methods, each from a settled motion to a look that is trimmed @{ */
    Look newton_krylov(Look now);
    Look discrete(Look now);
    Look auto_pilot(Look now);

    /** Periodicity and targets in scales; in the rows of controls stand the targets. */
    VectorX residual(const Look &look) const;
    State   moved(const State &from, const VectorX &x, double factor) const;
    VectorX newton_step(const Look &now, const VectorX &r, double forcing);
    /** @name Products with the Jacobian of residual() @{ */
    VectorX by_difference(const Look &now, const VectorX &r, const VectorX &direction);
    VectorX by_tangent(const VectorX &direction);
    /** @} */
    /** x with J x = −r to @p forcing |r|, or as near as <Most products> lead. */
    VectorX solve(const std::function<VectorX(const VectorX &)> &product, const VectorX &r, double forcing);
    /** Keep directions u and their images q for the next step. */
    void remember(const Known &products);
    /** ∂ȳ/∂u of settled motions. */
    Eigen::MatrixXd control_matrix(const Look &now);
    VectorX         solve(const Eigen::MatrixXd &J, const VectorX &y) const;
    /** @} */

    /** @name What is said @{ */
    void tell(const Look &look);
    /** "flow.thrust is off by 1.2 N", of the target that is missed by most, in scales. */
    std::string text_of_miss(const Look &look) const;
    /** What of J cannot be solved: a control without effect, a target that nothing moves; empty if it can. */
    std::string fault_of(const Eigen::MatrixXd &J) const;
    std::string at_limits(const VectorX &u) const;
    /** Which targets the controls move least. */
    std::string       hardest_of(const Eigen::MatrixXd &J) const;
    Eigen::MatrixXd   in_scales(const Eigen::MatrixXd &J) const;
    [[noreturn]] void fail(const std::string &why);
    /** The same with what of the control matrix explains it. */
    [[noreturn]] void fail_with_reason(const Look &now, const std::string &why);
    void              leave(const Look &look);
    void              write(const Look &look) const;
    /**
     * A whole period more, in time. Returns its end, from which the period can begin again; nothing if it does not come
     * back, @p why says how.
     */
    std::optional<State> confirm(const Look &look, std::string &why);
    /** @} */
  };
} // namespace samara

#endif
