#include <samara/analysis/controls.h>
#include <samara/analysis/lyapunov.h>
#include <samara/analysis/start_of_motion.h>
#include <samara/base/errors.h>
#include <samara/base/interrupt.h>
#include <samara/base/text.h>
#include <samara/output/table.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace samara
{
  namespace
  {
    /** Parts of the time, whose means tell the scatter. */
    constexpr unsigned int n_batches = 10;

    /** What is left of a change without those before it, relative: less is round-off. */
    constexpr double least_remainder = 1e-11;

    constexpr unsigned int most_rows_of_history = 1000;

    double
    dot_of(const std::vector<double> &a, const std::vector<double> &b)
    {
      return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
    }
  } // namespace



  void
  LyapunovAnalysis::add_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    prm.add("Exponents", n_wanted, "Number of exponents, largest first.", Integer(1));
    prm.add("Step", step, "Time step [s].", Double(0));
    prm.add(
      "Steps between",
      n_between,
      "Steps after which changes are made orthonormal again: few enough that the fastest does not hide the others.",
      Integer(1));
    prm.add("Settle",
            settle,
            "Time in which the motion and the directions of its changes settle before growth counts [s].",
            Double(0));
    prm.add("Duration", duration, "Time over which growth is averaged [s].", Double(0));
    prm.add("Stages", n_stages, "Stages of the integrator, 1 to 3.", Integer(1, 3));
    prm.add("Spectral radius",
            spectral_radius,
            "Of the integrator at infinite frequency: less than 1 adds damping to all exponents [1].",
            Double(0, 1));
    prm.add("Newton tolerance", newton_tolerance, "Of the steps, see dynamic analysis [1].", Double(0));
    prm.add("Iterations", max_iterations, "Most Newton iterations with one factorisation.", Integer(2));
  }



  void
  LyapunovAnalysis::check(const std::vector<double> &rotor_speeds, Complaints &complaints) const
  {
    if (!(step > 0))
      complaints.add(parameters.where("Step"), "the <Step> must be positive");
    if (!(duration >= n_batches * n_between * step))
      complaints.add(parameters.where("Duration"),
                     "the <Duration> must be " + std::to_string(n_batches) + " times the <Steps between> at least");
    if (!(newton_tolerance > 0))
      complaints.add(parameters.where("Newton tolerance"), "the <Newton tolerance> must be positive");
    if (!rotor_speeds.empty())
      complaints.add(parameters.where(),
                     "exponents belong to one motion; let a study vary it in place of <Rotor speeds>");
  }



  LyapunovAnalysis::Columns
  LyapunovAnalysis::first_columns(const System &system, const std::vector<double> &scale) const
  {
    // any start will do; controls keep their values, and are no part of the motion
    std::mt19937 random(1);
    const auto   controls = states_of_controls(system);
    Columns      columns(n_wanted, std::vector<double>(scale.size()));
    for (auto &x : columns)
      {
        for (unsigned int i = 0; i < x.size(); ++i)
          x[i] = scale[i] * (double(random()) / random.max() - 0.5);
        for (const unsigned int i : controls)
          x[system.layout.of_state(i)] = 0;
      }
    return columns;
  }



  std::vector<double>
  LyapunovAnalysis::grow(PeriodMap &map, const std::vector<double> &scale, Columns &columns) const
  {
    std::vector<double> result;
    for (unsigned int j = 0; j < columns.size(); ++j)
      {
        auto &x = columns[j];
        map.apply(x.data());
        for (unsigned int i = 0; i < x.size(); ++i)
          x[i] /= scale[i];
        const double before = std::sqrt(dot_of(x, x));
        for (unsigned int pass = 0; pass < 2; ++pass)
          for (unsigned int k = 0; k < j; ++k)
            {
              double part = 0;
              for (unsigned int i = 0; i < x.size(); ++i)
                part += x[i] * columns[k][i] / scale[i];
              for (unsigned int i = 0; i < x.size(); ++i)
                x[i] -= part * columns[k][i] / scale[i];
            }
        const double size = std::sqrt(dot_of(x, x));
        if (!(size > least_remainder * before) || !std::isfinite(size))
          throw NotConverged(
            "lyapunov analysis: exponent " + std::to_string(j + 1) +
            " cannot be told from those before it.\n  There are as many as the constraints leave: two a "
            "degree of freedom and one a state of first order; what dies away at once needs less <Steps "
            "between>");
        result.push_back(std::log(size));
        for (unsigned int i = 0; i < x.size(); ++i)
          x[i] *= scale[i] / size;
      }
    return result;
  }



  void
  LyapunovAnalysis::run(Context &context)
  {
    Complaints complaints;
    check(context.sweep, complaints);
    complaints.throw_if_any();
    const System &system   = context.system;
    const double  interval = n_between * step;
    const auto    scale    = scales_of_increment(system, interval);
    PeriodMap     map(system, {interval, n_between, n_stages, spectral_radius, newton_tolerance, max_iterations});
    State         state   = motion_or_start(context, {parameters.where(), 0.});
    const double  begin   = state.time + settle;
    auto          columns = first_columns(system, scale);
    // the first interval makes changes what the constraints allow
    const auto n_settle = std::max(1u, static_cast<unsigned int>(std::ceil(settle / interval - 1e-9)));
    const auto n        = static_cast<unsigned int>(std::ceil(duration / interval - 1e-9));
    std::vector<std::vector<double>> growth;
    double                           n_factorizations = 0;
    for (unsigned int i = 0; i < n_settle + n; ++i)
      {
        throw_if_interrupted();
        try
          {
            state = map.linearize(state);
          }
        catch (const NotConverged &problem)
          {
            throw NotConverged(std::string("lyapunov analysis: ") + problem.what());
          }
        n_factorizations += map.n_factorizations();
        const auto now = grow(map, scale, columns);
        if (i >= n_settle)
          growth.push_back(now);
      }
    spent = Effort{double(n_settle + n) * n_between, double(map.n_iterations), n_factorizations};
    sort_and_tell(context, growth);
    if (!context.folder.empty())
      write(context, growth, begin);
  }



  void
  LyapunovAnalysis::sort_and_tell(const Context &context, const std::vector<std::vector<double>> &growth)
  {
    const double                           interval = n_between * step;
    std::vector<std::pair<double, double>> found;
    for (unsigned int j = 0; j < n_wanted; ++j)
      {
        std::vector<double> means;
        for (unsigned int b = 0; b < n_batches; ++b)
          {
            const std::size_t first = b * growth.size() / n_batches, last = (b + 1) * growth.size() / n_batches;
            double            sum = 0;
            for (std::size_t i = first; i < last; ++i)
              sum += growth[i][j];
            means.push_back(sum / (interval * (last - first)));
          }
        double mean = 0, squares = 0;
        for (const auto &g : growth)
          mean += g[j] / (interval * growth.size());
        for (const double m : means)
          squares += (m - mean) * (m - mean);
        found.emplace_back(mean, std::sqrt(squares / (n_batches * (n_batches - 1.))));
      }
    std::stable_sort(found.begin(), found.end(), [](const auto &a, const auto &b) { return a.first > b.first; });
    exponents.clear();
    scatter.clear();
    for (const auto &[mean, error] : found)
      {
        exponents.push_back(mean);
        scatter.push_back(error);
        context.log.line("  exponent " + std::to_string(exponents.size()) + ": " + number_to_text("%.6g", mean) +
                         " +- " + number_to_text("%.2g", error) + " 1/s");
      }
    context.log.line("lyapunov: over " + number_to_text("%.6g", interval * growth.size()) + " s; " +
                     // three standard errors
                     (exponents[0] > 3 * scatter[0] && exponents[0] > 0 ? "small changes grow" :
                      exponents[0] < -3 * scatter[0]                    ? "small changes die away" :
                                                                          "the largest exponent is not told from zero"));
    if (const double d = dimension(); std::isfinite(d))
      context.log.line("  dimension by Kaplan and Yorke: " + number_to_text("%.4g", d));
  }



  double
  LyapunovAnalysis::dimension() const
  {
    double sum = 0;
    for (unsigned int j = 0; j < exponents.size(); ++j)
      {
        if (sum + exponents[j] < 0)
          return j + sum / std::abs(exponents[j]);
        sum += exponents[j];
      }
    return std::numeric_limits<double>::quiet_NaN();
  }



  void
  LyapunovAnalysis::write(const Context                          &context,
                          const std::vector<std::vector<double>> &growth,
                          const double                            begin) const
  {
    Table table({"exponent", "growth rate [1/s]", "scatter [1/s]"});
    for (unsigned int j = 0; j < exponents.size(); ++j)
      table.add_row({j + 1, exponents[j], scatter[j]});
    table.write(context.folder + "/lyapunov.csv");

    std::vector<std::string> columns = {"time [s]"};
    for (unsigned int j = 0; j < n_wanted; ++j)
      columns.push_back("mean growth rate " + std::to_string(j + 1) + " [1/s]");
    Table               history(columns);
    const double        interval = n_between * step;
    const std::size_t   every    = 1 + growth.size() / most_rows_of_history;
    std::vector<double> sums(n_wanted, 0.);
    for (std::size_t i = 0; i < growth.size(); ++i)
      {
        for (unsigned int j = 0; j < n_wanted; ++j)
          sums[j] += growth[i][j];
        if ((i + 1) % every != 0 && i + 1 != growth.size())
          continue;
        std::vector<double> row = {begin + (i + 1) * interval};
        for (const double sum : sums)
          row.push_back(sum / ((i + 1) * interval));
        history.add_row(row);
      }
    history.write(context.folder + "/lyapunov_history.csv");
  }
} // namespace samara
