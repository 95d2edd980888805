#include <samara/analysis/harmonics.h>
#include <samara/analysis/period_of_rotors.h>
#include <samara/analysis/start_of_motion.h>
#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/output/table.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Gaps below which a motion is not let settle further, and above which one is warned about. @{ */
    constexpr double closed_gap = 1e-10, doubtful_gap_of_period = 1e-6;
    /** @} */

    constexpr unsigned int loads_of_joint = 6;
  } // namespace



  double
  HarmonicsAnalysis::Series::mean() const
  {
    double sum = 0;
    for (const double y : values)
      sum += y;
    return sum / values.size();
  }



  std::array<double, 2>
  HarmonicsAnalysis::Series::harmonic(const unsigned int n, const double start) const
  {
    // sums over the ends of the steps: exact for periodic functions whose harmonics the steps can tell apart
    std::array<double, 2> result = {0., 0.};
    for (unsigned int i = 0; i < values.size(); ++i)
      {
        const double angle = n * (start + 2 * M_PI * (i + 1) / values.size());
        result[0] += 2 * values[i] * std::cos(angle) / values.size();
        result[1] += 2 * values[i] * std::sin(angle) / values.size();
      }
    return result;
  }



  void
  HarmonicsAnalysis::add_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    prm.add("Period", period, "Of the motion; not given: a turn of the steady rotation [s].", Double(0));
    prm.add("Harmonics", n_harmonics, "How many are told; twice as many are less than the <Steps>.", Integer(1));
    prm.add(
      "Loads of",
      joints,
      "Joints whose forces and moments are told in axes of body A and in these turned by the joint's rotation, as hub "
      "loads: shaft. The probes of Output are told besides.");
    prm.add("Steps", n_steps, "Steps a period.", Integer(3));
    prm.add("Stages", n_stages, "Stages of the integrator, 1 to 3.", Integer(1, 3));
    prm.add("Spectral radius", spectral_radius, "Of the integrator at infinite frequency [1].", Double(0, 1));
    prm.add("Newton tolerance", newton_tolerance, "Of the steps, see dynamic analysis [1].", Double(0));
    prm.add("Iterations", max_iterations, "Most Newton iterations with one factorisation.", Integer(2));
    prm.add("Settle",
            most_periods,
            "Most periods that the motion is given to become periodic by itself before the one that is told.",
            Integer(0));
    prm.add(
      "Largest gap",
      largest_gap,
      "What a motion may lack to periodicity, parts of the model's length, radians and these over T/2 pi; more is "
      "refused [1].",
      Double(0));
  }



  void
  HarmonicsAnalysis::check(const std::vector<double> &rotor_speeds, Complaints &complaints) const
  {
    if (!(period > 0) && parameters.is_set("Period"))
      complaints.add(parameters.where("Period"), "the <Period> must be positive");
    if (2 * n_harmonics >= n_steps)
      complaints.add(parameters.where("Harmonics"),
                     std::to_string(n_harmonics) + " <Harmonics> need more than " + std::to_string(2 * n_harmonics) +
                       " <Steps> a period");
    if (!(newton_tolerance > 0))
      complaints.add(parameters.where("Newton tolerance"), "the <Newton tolerance> must be positive");
    if (!rotor_speeds.empty())
      complaints.add(parameters.where(), "a period belongs to one speed; leave out <Rotor speeds>, or the analysis");
  }



  std::vector<HarmonicsAnalysis::Load>
  HarmonicsAnalysis::find_loads(const Model &model, std::vector<PeriodAverage> &averages) const
  {
    std::vector<Load> result;
    for (const auto &joint : joints)
      {
        result.push_back({joint, static_cast<unsigned int>(averages.size())});
        try
          {
            for (const std::string path :
                 {"force 1", "force 2", "force 3", "moment 1", "moment 2", "moment 3", "rotation"})
              {
                averages.push_back({PeriodAverage::mean, 0, model.probe(joint + "." + path)});
                if (averages.back().probe.unit.find("unique") != std::string::npos)
                  throw std::invalid_argument("its loads are not unique, as constraints are redundant there");
              }
          }
        catch (const std::invalid_argument &problem)
          {
            throw InputError(parameters.where("Loads of") + ": <" + joint + ">: " + problem.what() +
                             ".\n  Loads in turning axes are those of a joint with one rotation, about its axis 3, and "
                             "all forces and moments: a revolute whose rotation is prescribed, or has a moment");
          }
      }
    return result;
  }



  void
  HarmonicsAnalysis::check_gap(const Context        &context,
                               const PeriodicMotion &motion,
                               const State          &start,
                               const State          &end)
  {
    const auto largest = motion.largest(motion.gap(start, end));
    gap                = largest.size;
    const std::string text =
      "the motion lacks " + number_to_text("%.1e", gap) + " to periodicity, most at " + motion.name_of(largest.entry);
    if (!(gap <= largest_gap))
      throw NotConverged(
        "harmonics: " + text +
        ".\n  Harmonics belong to a motion that repeats itself. Is the <Period> right? Damping lets it "
        "settle (<Settle>, or trim before)");
    if (gap > doubtful_gap_of_period)
      context.log.warning("harmonics", text + "; so much do harmonics lack, too");
  }



  void
  HarmonicsAnalysis::add_loads(const Load &load, const std::vector<std::vector<double>> &values)
  {
    for (const bool is_turning : {false, true})
      for (unsigned int k = 0; k < loads_of_joint; ++k)
        {
          Series s{load.joint + (k < 3 ? ".force " : ".moment ") + std::to_string(k % 3 + 1),
                   is_turning ? "turning" : "standing",
                   k < 3 ? "N" : "N m",
                   {}};
          for (const auto &v : values)
            {
              const double *const F = v.data() + load.first + (k < 3 ? 0 : 3);
              const double        a = is_turning ? v[load.first + loads_of_joint] * M_PI / 180 : 0.;
              s.values.push_back(k % 3 == 0 ? std::cos(a) * F[0] + std::sin(a) * F[1] :
                                 k % 3 == 1 ? std::cos(a) * F[1] - std::sin(a) * F[0] :
                                              F[2]);
            }
          series.push_back(s);
        }
  }



  void
  HarmonicsAnalysis::run(Context &context)
  {
    Complaints complaints;
    check(context.sweep, complaints);
    complaints.throw_if_any();
    find_period(period, parameters, context);
    series.clear();
    std::vector<PeriodAverage> averages;
    for (const auto &probe : context.probes)
      averages.push_back({PeriodAverage::mean, 0, probe});
    const auto loads = find_loads(context.system.model, averages);

    // the fourth is for BDF alone
    const IntegratorSettings         settings{spectral_radius, newton_tolerance, max_iterations, 1e-4, n_stages};
    PeriodicMotion                   motion(context, period, n_steps, settings, averages);
    State                            start = motion_or_start(context, {parameters.where(), 0.}), end = start;
    std::vector<std::vector<double>> values;
    for (unsigned int i = 0; i <= most_periods; ++i)
      {
        if (i > 0)
          start = end;
        end = start;
        values.clear();
        motion.turn(end, [&](State &, unsigned int, const std::vector<double> &y) { values.push_back(y); });
        if (motion.largest(motion.gap(start, end)).size < closed_gap)
          break;
      }
    check_gap(context, motion, start, end);
    phase = 2 * M_PI * start.time / period;
    for (unsigned int k = 0; k < context.probes.size(); ++k)
      {
        series.push_back({context.probes[k].name, "", context.probes[k].unit, {}});
        for (const auto &v : values)
          series.back().values.push_back(v[k]);
      }
    for (const auto &load : loads)
      add_loads(load, values);
    spent = Effort{double(motion.n_marched), double(motion.n_iterations), double(motion.n_factorizations)};
    if (!context.folder.empty())
      write(context);
    context.log.line("harmonics: " + std::to_string(n_harmonics) + " harmonics of " + std::to_string(series.size()) +
                     " quantities of a motion that is periodic to " + number_to_text("%.1e", gap));
  }



  void
  HarmonicsAnalysis::write(const Context &context) const
  {
    Table table({"quantity", "axes", "unit", "harmonic", "cosine", "sine", "amplitude", "phase [deg]"});
    for (const auto &s : series)
      {
        table.add_row({s.name, s.axes, s.unit, 0, s.mean(), 0., std::abs(s.mean()), 0.});
        for (unsigned int n = 1; n <= n_harmonics; ++n)
          {
            const auto [a, b] = s.harmonic(n, phase);
            table.add_row({s.name, s.axes, s.unit, n, a, b, std::hypot(a, b), std::atan2(b, a) * 180 / M_PI});
          }
      }
    table.write(context.folder + "/harmonics.csv");
  }
} // namespace samara
