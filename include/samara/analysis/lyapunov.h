#ifndef samara_analysis_lyapunov_h
#define samara_analysis_lyapunov_h

#include <samara/analysis/analysis.h>
#include <samara/time/period_map.h>

namespace samara
{
  /**
   * Lyapunov exponents: the mean rates at which small changes of a motion grow, of motions that need not be periodic
   * (doc/theory/floquet.md). Changes are taken through the exact tangents of the steps and made orthonormal again after
   * each interval, X_{i+1} R = Φ_i X_i; exponents are the means of ln R_jj over the time of an interval (Benettin,
   * Galgani, Giorgilli and Strelcyn, Meccanica 15, 1980).
   *
   * The motion goes on from the context's, or begins as a dynamic analysis does, and settles first. The scatter told is
   * the standard error of ten parts of the time. Writes lyapunov.csv and lyapunov_history.csv; leaves the state as it
   * was.
   *
   * @throws NotConverged where steps have no solution or no tangent, or more exponents are asked for than changes can
   * be told apart.
   */
  class LyapunovAnalysis : public Analysis
  {
  public:
    void add_parameters(Parameters &prm) override;
    void check(const std::vector<double> &rotor_speeds, Complaints &complaints) const override;
    void run(Context &context) override;

    std::vector<double> exponents, scatter; ///< of the last run, largest first [1/s]

    std::optional<Effort>
    effort() const override
    {
      return spent;
    }

    /** After which part of the growth is as much lost as it was: Kaplan and Yorke; nan if those known do not reach it.
     */
    double dimension() const;

    // entries
    double       step = 0, duration = 0, settle = 0, spectral_radius = 1, newton_tolerance = 1e-12;
    unsigned int n_wanted = 2, n_between = 10, n_stages = 3, max_iterations = 50;

  private:
    std::optional<Effort> spent;
    using Columns = std::vector<std::vector<double>>;

    Columns             first_columns(const System &system, const std::vector<double> &scale) const;
    std::vector<double> grow(PeriodMap &map, const std::vector<double> &scale, Columns &columns) const;
    void                sort_and_tell(const Context &context, const std::vector<std::vector<double>> &growth);
    void write(const Context &context, const std::vector<std::vector<double>> &growth, double begin) const;
  };
} // namespace samara

#endif
