#ifndef samara_analysis_section_map_h
#define samara_analysis_section_map_h

#include <samara/analysis/repeated_parts.h>
#include <samara/base/tell_progress.h>
#include <samara/time/period_map.h>

#include <complex>
#include <functional>

namespace samara
{
  /**
   * What a change of a periodic motion becomes in one Q-th of the period, S = P Φ(T/Q), where P renumbers what is
   * repeated Q times (RepeatedParts); Q = 1 without. S^Q is the map over the whole period, its multipliers are those of
   * S to the power of Q. (doc/theory/floquet.md)
   *
   * Controls keep their values: increments have none, neither do images. Each would be a multiplier 1.
   */
  class SectionMap
  {
  public:
    /** @p settings: of the section, with its own length in time and steps. */
    SectionMap(const System &system, const PeriodSettings &settings, const RepeatedParts &parts);

    /** What lacks to periodicity: the largest number of a gap over its scale, and whose unknown it is. */
    struct Gap
    {
      double       size    = 0;
      unsigned int unknown = 0;
    };

    /**
     * Go on from @p start for @p most periods, or until the gap of a section is not above @p enough. The steps of the
     * section before are kept, and axes aligned, so that apply() is defined.
     */
    void settle(const State &start, unsigned int most, double enough);

    /**
     * Newton's method on periodicity, from the section that is kept: x solves (I − S) x = P(end) − start, by GMRES;
     * steps that do not come nearer are halved, and given up. At most @p most of them, or until the gap is not above @p
     * enough.
     */
    void correct(unsigned int most, double enough);

    Gap          gap;                ///< of the section that is kept
    unsigned int n_sections_run = 0; ///< by settle()
    unsigned int n_corrections  = 0; ///< by correct()

    /** Replace an increment x of the start by S x. */
    void apply(double *x);

    TellProgress listener; ///< hears what is done with the map, and how far that is; may be empty

    /** From now on the products with the map are for this: "columns of the map"; @p most of them, 0: nobody knows. */
    void begin(const std::string &doing, unsigned int most = 0);

    /**
     * Whether what comes behind the section is as S says: a random change is carried through the other sections of the
     * period, or without symmetry through another period, and compared. Relative to its size; ≈ 1 if it is not so. Or
     * what the motion itself lacks to periodicity there, if that is more.
     */
    double difference_behind();

    /**
     * An increment and its images at all steps of the whole period, n() steps a section: f(i, re, im) for i from 0 to
     * Q n(), real and imaginary part. @p value is the eigenvalue of S that belongs to it.
     */
    void follow(const Eigen::VectorXcd                                                       &shape,
                std::complex<double>                                                          value,
                const std::function<void(unsigned int i, const Eigen::VectorXcd &increment)> &f);

    /** A basis of all increments that the constraints allow at the start; columns in terms of scales(). */
    Eigen::MatrixXd basis();
    /** The same at another state. */
    Eigen::MatrixXd basis_at(const State &state);

    /** An increment without its controls, which keep their values. */
    void keep_controls(double *x) const;

    /** What counts as one of each number of an increment. */
    const std::vector<double> &
    scales() const
    {
      return scale;
    }

    const System &system;
    PeriodMap     map;
    const RepeatedParts &
    repeated() const
    {
      return parts;
    }

  private:
    RepeatedParts                   parts;
    std::string                     doing;
    unsigned int                    n_products = 0, most_products = 0; ///< since begin()
    std::vector<double>             scale;
    const std::vector<unsigned int> kept; ///< entries of an increment that belong to controls

    void                tell(const std::string &text) const;
    void                keep(const State &start);
    bool                step_nearer(const std::vector<double> &x);
    std::vector<double> solve_for_correction(const std::vector<double> &lacking);
    Gap                 gap_between(const State &start, const State &end) const;
    double              scaled_norm(const std::vector<double> &x) const;
  };
} // namespace samara

#endif
