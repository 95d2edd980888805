#ifndef samara_analysis_trim_path_h
#define samara_analysis_trim_path_h

#include <samara/analysis/trim_run.h>

namespace samara
{
  /**
   * Trim by continuation: constants c = c₀ + s (c₁ − c₀), s from 0 to 1. The model is read again for each s, so that
   * all that depends on them does: wind, targets, weights. Each search begins on the line through the last two motions;
   * where it fails, the step is halved, down to a 64th of the way.
   */
  class TrimAnalysis::Path
  {
  public:
    Path(TrimAnalysis &trim, Context &context);

    /** @throws NotConverged with the values that were reached, the targets that are out of reach, and limits */
    void go();

  private:
    /** A motion that was found. */
    struct Found
    {
      double                       share = 0;
      State                        state;
      std::shared_ptr<TrimVariant> model;
    };

    TrimAnalysis      &trim;
    Context           &context;
    std::vector<Found> found; ///< the last two
    Table              table;
    double             turns = 0;
    /** Shares of the way and controls in their scales, of all that was found. */
    std::vector<std::pair<double, Eigen::VectorXd>> controls_at;

    /** The model at @p share of the way. @throws InputError if it has other unknowns */
    std::shared_ptr<TrimVariant> model_at(double share) const;
    State                        predicted(double share) const;
    /** Where the constants are: "mu = 0.25". */
    std::string values_at(double share) const;
    void        begin();
    /** Search at a share of the way, the last one in the model itself. @throws NotConverged */
    void advance(double share);
    void keep(const Found &next, TrimAnalysis &of);
    /** Where controls, which change ever faster, would turn round, if they do before @p beyond; empty if not. */
    std::string limit_point(double beyond) const;
    /** Controls that reach a limit soon, if they go on as they have from one value to the next. */
    std::string       limits_ahead() const;
    [[noreturn]] void stop(double beyond, const std::string &why);
  };
} // namespace samara

#endif
