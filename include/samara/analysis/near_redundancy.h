#ifndef samara_analysis_near_redundancy_h
#define samara_analysis_near_redundancy_h

#include <samara/model/system.h>

namespace samara
{
  /**
   * What to tell of a loop that could move, but for constraints that nearly say what others say
   * (doc/theory/redundant.md): places or axes that are rounded, or a fault of assembly, make a structure of a
   * mechanism. Empty if there is none, or if the model has more than some 300 constraints. @p left_out are the rows
   * that are redundant.
   */
  std::string nearly_redundant_text(const System &system, const std::vector<unsigned int> &left_out);



  /**
   * Watches a motion for singular positions: those at which more constraints depend on each other than elsewhere, so
   * that the mechanism could go on in several ways, or is locked there. A singular value σ of the rows in use, each
   * scaled to length 1, passes zero there. Its vectors are followed from one look to the next: a sign that changes
   * tells a passing, however long the steps are in comparison with it, and the time follows from a straight line.
   *
   * Models without loops have none; those with more than some hundred constraints are not watched.
   */
  class SingularPositions
  {
  public:
    explicit SingularPositions(const System &system);
    ~SingularPositions();

    struct Passing
    {
      double      time;
      std::string joints; ///< whose constraints depend on each other there
    };
    std::vector<Passing> passings;

    /** To be called after each step; looks where something has moved so far that the smallest σ may have become
     * smaller. */
    void look(const State &state);

    /** What to say of all of them; empty if there were none. */
    std::string text() const;

    /** Whether the position at the last look is next to a singular one, and which joints make it; empty if not. */
    std::string near() const;

  private:
    class Rows;
    const System         &system;
    bool                  is_watched;
    std::unique_ptr<Rows> rows;
    State                 last; ///< where it was looked last

    double until_next_look = 0; ///< how far something may move before [rad, or parts of the model's size]

    /** How far something is from where it was at the last look, likewise. */
    double motion(const State &state) const;

    std::string joints_of(const Eigen::VectorXd &combination) const;
  };
} // namespace samara

#endif
