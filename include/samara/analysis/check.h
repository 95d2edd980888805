#ifndef samara_analysis_check_h
#define samara_analysis_check_h

#include <samara/model/system.h>

namespace samara
{
  /**
   * Refuse groups of contacts of which matrices do not hold all pairs: statics would not converge, modes be wrong.
   * @throws InputError
   */
  void require_couplings(const System &system, bool for_statics = false);

  /** Refuse a state in which lines touch side by side: which places of theirs do is not determined. @throws
   * NotConverged
   */
  void require_nearest_places(const System &system, const State &state);

  /** What can be said of a model before anything is computed with it, in its reference configuration. */
  struct ModelCheck
  {
    System::MassProperties       mass{};
    unsigned int                 n_free_motions = 0;
    std::vector<std::string>     free_motions; ///< for each: the bodies and joints that move most
    std::vector<Eigen::VectorXd> shapes;       ///< and its velocities, of all unknowns but multipliers
    std::vector<std::string>     massless;     ///< the same for those among them that have neither inertia nor damping

    /** Constraints that say what others say already: sentences, one for each loop or loops that share joints. */
    std::vector<std::string>  redundant;
    std::vector<unsigned int> redundant_multipliers;
    Eigen::MatrixXd           combinations;   ///< of rows, that depend on each other, one column for each
    State                     generic;        ///< a place near the reference configuration, where these are so
    std::vector<std::string>  contradictions; ///< combinations that prescribed motions cannot obey

    /** All of it for people. */
    std::string text(const System &system, const std::string &file) const;

    /** What can move freely, for the message of an analysis that found no solution. */
    std::string free_motions_text() const;

    /** What moves freely without inertia, so that its motion is not determined; empty if nothing does. */
    std::string massless_text() const;

    /** What is redundant, for the log of a run. */
    std::string redundancy_text() const;

    /** What contradicts what. */
    std::string complaint() const;

    /** Add "not unique" to the units of probes whose values are a matter of convention: least norm. Whether there are
     * any. */
    bool mark(std::vector<Probe> &probes) const;

    /** A complaint about laws and friction that depend on forces of constraints that are not unique; empty if there are
     * none. */
    std::string complaint_about_laws(const System &system) const;
  };

  ModelCheck check_model(const System &system);

  /** "joint foot", ...: what messages call these. */
  std::vector<std::string> titles_of(const std::vector<const Item *> &items);

  /** "a, b, c and 5 more": six names at most. */
  std::string join_some(const std::vector<std::string> &names);

  /** Redundant rows in the reference configuration and a little further on, see RedundantRows. */
  void find_redundant(const System &system, ModelCheck &check);

  /** Motions without strain that no constraint prevents, by inverse iteration on the saddle matrix of rigid pieces. */
  void find_free_motions(const System &system, ModelCheck &check);
} // namespace samara

#endif
