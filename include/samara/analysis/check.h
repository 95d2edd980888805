#ifndef samara_analysis_check_h
#define samara_analysis_check_h

#include <samara/model/system.h>

namespace samara
{
  /** What can be said of a model before anything is computed with it, in its reference configuration. */
  struct ModelCheck
  {
    System::MassProperties   mass;
    unsigned int             n_free_motions = 0;
    std::vector<std::string> free_motions; ///< for each: the bodies and joints that move most

    /** Constraints that say what others say already, each with the others it repeats. */
    std::vector<std::string>  redundant;
    std::vector<unsigned int> redundant_multipliers;

    /** All of it for people. */
    std::string text(const System &system, const std::string &file) const;

    /** What can move freely, for the message of an analysis that found no solution. */
    std::string free_motions_text() const;

    /** What is wrong with the redundant constraints and what to do. */
    std::string complaint(const std::string &file) const;
  };

  ModelCheck check_model(const System &system);

  /** Redundant rows by a rank-revealing (column-pivoted QR) factorisation of the constraint matrix. */
  void find_redundant(const System &system, ModelCheck &check);

  /** Motions without strain that no constraint prevents, by inverse iteration on the saddle matrix. */
  void find_free_motions(const System &system, ModelCheck &check);
} // namespace samara

#endif
