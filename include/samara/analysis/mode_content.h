#ifndef samara_analysis_mode_content_h
#define samara_analysis_mode_content_h

#include <samara/analysis/blade_motion.h>
#include <samara/analysis/repeated_parts.h>

#include <complex>

namespace samara
{
  /** What a mode is by its content, for rotors: words, and how much of it they say. */
  struct ModeContent
  {
    /** "flap 1", "lag 2", "torsion 1": the motion with most kinetic energy, and how many parts of alternating sign it
     * has along the blade; "flap-lag" if none has 60 %; "support" if most is in what is not repeated; empty: not known.
     */
    std::string family;
    double      family_share = 0; ///< of the kinetic energy, in air of what stands for it (Weighing)

    /** "collective", "progressive", "regressive", "cyclic" (both at once), "differential", "progressive 2", …; "mixed"
     * if none has three quarters. */
    std::string pattern;
    double      pattern_share = 0; ///< of the kinetic energy of the repeated parts
  };



  /**
   * Names modes of a rotor by what its repeated parts, the blades, do: along the axis about which they turn (flap), in
   * its direction of turning (lag), about their own length (torsion); all alike (collective), one behind the other as a
   * wave that goes round with the rotor as seen from it (progressive) or against it (regressive), or each against the
   * next one (differential). Shares are of kinetic energy, mean over the time that is given.
   */
  class ContentOfModes
  {
  public:
    /** @p orbit: states over a section of the period, or more; nothing is named without repeated parts that turn. */
    ContentOfModes(const System &system, const RepeatedParts &parts, const std::vector<State> &orbit);

    /**
     * Of increments of a mode at the states of the orbit, p(t) times any phase; behind those there may be more, which
     * are not looked at. @p frequency: of the mode as blades feel it, with its sign [rad/s]. @p left: the left vector
     * of a mode of a steady motion, with which families are weighed (Weighing); empty: there is none.
     */
    ModeContent
    of(const std::vector<Eigen::VectorXcd> &increments, double frequency, const Eigen::VectorXcd &left = {}) const;

    /**
     * Of motions at the first state, columns of @p shapes, the energy of the repeated parts in each pattern, m = 0 to
     * Q − 1 as in doc/theory/floquet.md: yᴴ E_m y of the combination y. Empty if nothing is named.
     */
    std::vector<Eigen::MatrixXcd> energies_of_patterns(const Eigen::MatrixXcd &shapes) const;

  private:
    using Complex = std::complex<double>;
    /** Displacements along axis, circle, radius, and rotations about circle, axis, radius. */
    using Motion = Eigen::Matrix<Complex, 6, 1>;

    const System                          &system;
    const std::vector<State>              &orbit;
    unsigned int                           n_parts;
    std::vector<std::vector<unsigned int>> chains; ///< nodes that become each other, in the order of the parts
    Vector3                                axis = Vector3::Zero(), centre = Vector3::Zero();

    void        find_axis();
    Motion      motion_of(const State &state, const Eigen::VectorXcd &x, unsigned int node, bool in_energy) const;
    std::string number_along(const State &state, const Eigen::VectorXcd &x, unsigned int family) const;
    std::string name_of_pattern(const std::vector<double> &energies, double frequency, double &share) const;
    double      energy_of_others(const Weighing &weighing, const Eigen::VectorXcd &x) const;
  };
} // namespace samara

#endif
