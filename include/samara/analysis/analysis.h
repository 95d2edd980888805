#ifndef samara_analysis_analysis_h
#define samara_analysis_analysis_h

#include <samara/base/log.h>
#include <samara/model/doubts.h>
#include <samara/model/system.h>

#include <map>
#include <memory>
#include <optional>
#include <set>

namespace samara
{
  class ReportPage;

  /** What an analysis starts from, and leaves for the next one. */
  struct Context
  {
    const System       &system;
    Log                &log;
    std::string         folder; ///< of the results
    std::vector<Probe>  probes;
    bool                pictures = true;
    State               state;
    std::vector<double> speeds;                 ///< of the model's rotations at present [rad/s]
    std::vector<double> sweep;                  ///< rotor speeds to go through, of the first rotation; empty: none
    bool                is_equilibrium = false; ///< whether the state has been found by a static analysis
    bool                restart        = false; ///< go on from a checkpoint in the folder
    bool                least_norm     = true;  ///< whether probes show reactions that are not unique

    ReportPage *page = nullptr; ///< what is drawn is shown there, too; null: none

    /** All entries as used, see Input::used(), for checkpoints. */
    std::shared_ptr<const std::string> used = std::make_shared<const std::string>();

    /**
     * Whether pictures are to be made here: of a sweep only at the model's own speed, or the last one if that is not
     * among them.
     */
    bool is_shown() const;

    /** The present speed of the first rotation with as many digits as tell it from the others of the sweep. */
    std::string name_of_speed() const;

    /** All rotations in proportion to their own speeds, so that the first has @p speed. */
    std::vector<double> speeds_at(double speed) const;
  };



  /** One kind of analysis: reads its subsection, then advances the context. */
  class Analysis
  {
  public:
    virtual ~Analysis() = default;

    Parameters parameters;

    virtual void add_parameters(Parameters &prm) = 0;

    /** Complain about settings that do not fit each other, before anything is computed. */
    virtual void
    check(const std::vector<double> & /*rotor_speeds*/, Complaints &) const
    {}

    /** Whether it writes checkpoints that a run can be continued from; the analyses before it are left out then. */
    virtual bool
    can_restart() const
    {
      return false;
    }

    /**
     * Whether it belongs to one speed, as a motion does: it and what comes behind it are not repeated in a sweep, see
     * n_swept().
     */
    virtual bool
    is_of_one_speed() const
    {
      return false;
    }

    /** Before the first of several runs of a sweep. */
    virtual void
    start(Context &)
    {}
    /** At the context's speeds. */
    virtual void run(Context &context) = 0;

    /** Whether it wants something that moves. Otherwise it can do with a model that has no bodies. */
    virtual bool
    needs_bodies() const
    {
      return true;
    }
    /** In place of run() for a model without bodies, of which there is no system. */
    virtual void
    run_without_bodies(const Model &, const std::string & /*folder*/, bool /*pictures*/, Log &)
    {
      AssertThrow(false, dealii::ExcMessage("This analysis needs bodies."));
    }

    /** What the last run took; not a number what is not counted. */
    struct Effort
    {
      double steps, iterations, factorizations;
    };
    /** Nothing from analyses that go no steps, or have not run. */
    virtual std::optional<Effort>
    effort() const
    {
      return {};
    }

    /** After the last one. */
    virtual void
    finish(Context &)
    {}
  };

  /**
   * How many of the analyses of a run are done at each speed of a sweep: those before the first one that is of one
   * speed. Then the whole run follows at the model's own speed. If nothing stands before it all of them are, and it
   * refuses the sweep.
   */
  unsigned int n_swept(const std::vector<std::unique_ptr<Analysis>> &analyses);

  /**
   * Warn once of each item whose mesh is too coarse for a state, see Item::coarse_place(), and once of each doubt of an
   * item whose theory does not hold there, see Doubtful; and at the end of what all states together say.
   */
  class CoarseMeshes
  {
  public:
    /** @p when: "static, load factor 0.5" */
    void check(const Context &context, const State &state, const std::string &when);

    /** What all states so far together say; once of each item. */
    void conclude(const Context &context, const std::string &when);

  private:
    std::set<const Item *>                         warned;
    std::set<std::pair<const Item *, std::string>> doubted;

    std::map<const Doubtful *, Doubtful::Energies> largest; ///< of the run
  };

  /** What must not be nor come out of an analysis: @throws NotConverged naming an unknown that is not finite. */
  void require_finite_state(const System &system, const State &state);

  /** A number for the names of files and for messages: 12.5, 1e+06. */
  std::string short_text(double number);
} // namespace samara

#endif
