// What a search for trim says: on its way, where it fails and why, and what it leaves.

#include <samara/analysis/trim_run.h>
#include <samara/base/dense.h>
#include <samara/base/errors.h>
#include <samara/base/text.h>

#include <cmath>

namespace samara
{
  namespace
  {
    constexpr double without_effect = 1e-6; ///< of the largest effect
  }



  void
  TrimAnalysis::Run::tell(const Look &look)
  {
    if (look.size() < best.size() || n_looks == 0)
      best = look;
    ++n_looks;
    std::vector<Table::Cell> row = {turns(), look.largest_gap, look.miss};
    const VectorX            u   = controls_of(look.start);
    for (unsigned int j = 0; j < controls.size(); ++j)
      row.emplace_back(u(j));
    for (unsigned int k = 0; k < targets.size(); ++k)
      row.emplace_back(look.averages(k) / targets[k].factor);
    history->add_row(row);
    context.log.progress("trim: turn " + short_text(turns()) + ", periodic to " +
                         number_to_text("%.1e", look.largest_gap) + " (" + motion->name_of(look.worst_gap) + "), " +
                         text_of_miss(look));
  }



  std::string
  TrimAnalysis::Run::text_of_miss(const Look &look) const
  {
    const Target &worst = targets[look.worst_target];
    return worst.name + " is off by " +
           number_to_text("%.2g", std::abs(look.averages(look.worst_target) - worst.value) / worst.factor) + " " +
           worst.unit;
  }



  Eigen::MatrixXd
  TrimAnalysis::Run::in_scales(const Eigen::MatrixXd &J) const
  {
    Eigen::MatrixXd scaled = J;
    for (unsigned int k = 0; k < targets.size(); ++k)
      for (unsigned int j = 0; j < controls.size(); ++j)
        scaled(k, j) *= controls[j].scale / targets[k].scale;
    return scaled;
  }



  std::string
  TrimAnalysis::Run::fault_of(const Eigen::MatrixXd &J) const
  {
    const unsigned int    n       = controls.size();
    const Eigen::MatrixXd scaled  = in_scales(J);
    const double          largest = scaled.cwiseAbs().maxCoeff();
    for (unsigned int j = 0; j < n; ++j)
      if (!(scaled.col(j).cwiseAbs().maxCoeff() > without_effect * largest))
        return "the control <" + controls[j].name + "> has no effect on any target";
    for (unsigned int k = 0; k < n; ++k)
      if (!(scaled.row(k).cwiseAbs().maxCoeff() > without_effect * largest))
        return "no control has an effect on the target <" + targets[k].name + ">";
    const SingularValues svd = singular_values(scaled);
    if (svd.sizes(n - 1) > without_effect * svd.sizes(0))
      return "";
    const auto names_in = [&](const VectorX &v, const auto &all) {
      std::vector<std::string> names;
      for (unsigned int i = 0; i < n; ++i)
        if (std::abs(v(i)) > 0.1 * v.cwiseAbs().maxCoeff())
          names.push_back("<" + all[i].name + ">");
      return join(names, ", ");
    };
    return "the matrix of the controls is singular: a combination of the controls " +
           names_in(svd.V.col(n - 1), controls) + " has no effect, and a combination of the targets " +
           names_in(svd.U.col(n - 1), targets) + " cannot be met";
  }



  std::string
  TrimAnalysis::Run::hardest_of(const Eigen::MatrixXd &J) const
  {
    const unsigned int   n    = controls.size();
    const SingularValues svd  = singular_values(in_scales(J));
    const auto           list = [&](const VectorX &v, const auto &all) {
      std::vector<std::string> parts;
      for (unsigned int i = 0; i < n; ++i)
        if (std::abs(v(i)) > 0.1 * v.cwiseAbs().maxCoeff())
          parts.push_back(number_to_text("%.2f", v(i)) + " <" + all[i].name + ">");
      return join(parts, ", ");
    };
    const auto &s = svd.sizes;
    return "hardest to move are, in scales, the targets " + list(svd.U.col(n - 1), targets) + ", which the controls " +
           list(svd.V.col(n - 1), controls) + " move by " + number_to_text("%.2g", s(n - 1)) +
           "; the easiest are moved by " + number_to_text("%.2g", s(0));
  }



  std::string
  TrimAnalysis::Run::weakness(const State &orbit)
  {
    use_symmetry(orbit);
    const Look            now = look(orbit);
    const Eigen::MatrixXd J   = control_matrix(now);
    if (const std::string fault = fault_of(J); !fault.empty())
      return fault;
    const std::string limits = at_limits(controls_of(orbit));
    return hardest_of(J) + (limits.empty() ? "" : "; " + limits);
  }



  std::vector<TrimAnalysis::Run::Limit>
  TrimAnalysis::Run::limits(const State &now) const
  {
    std::vector<Limit> result;
    for (const auto &control : controls)
      result.push_back({control.name, now.states[control.state], control.lower, control.upper});
    return result;
  }



  std::string
  TrimAnalysis::Run::at_limits(const VectorX &u) const
  {
    std::string text;
    for (unsigned int j = 0; j < controls.size(); ++j)
      {
        const double width = 1e-6 * controls[j].scale;
        if (u(j) <= controls[j].lower + width || u(j) >= controls[j].upper - width)
          text += (text.empty() ? "" : ", ") +
                  ("<" + controls[j].name + "> is at its " + (u(j) <= controls[j].lower + width ? "lower" : "upper") +
                   " limit, " + number_to_text("%.6g", u(j)) + " " + controls[j].unit);
      }
    return text;
  }



  void
  TrimAnalysis::Run::fail(const std::string &why)
  {
    std::string text = "trim: " + why;
    if (n_looks > 0)
      {
        leave(best);
        write(best);
        const Target &worst = targets[best.worst_target];
        text += "\n  the best motion that was reached is kept: it is periodic to " +
                number_to_text("%.1e", best.largest_gap) + " (" + motion->name_of(best.worst_gap) +
                "), and targets are missed: <" + worst.name + "> is " +
                number_to_text("%.6g", best.averages(best.worst_target) / worst.factor) + " instead of " +
                number_to_text("%.6g", worst.value / worst.factor) + " " + worst.unit;
        if (const std::string limits = at_limits(controls_of(best.start)); !limits.empty())
          text += "; " + limits;
      }
    throw NotConverged(text);
  }



  void
  TrimAnalysis::Run::fail_with_reason(const Look &now, const std::string &why)
  {
    std::string reason;
    if (at_limits(controls_of(now.start)).empty())
      try
        {
          // what is at its limit needs no other explanation
          const Eigen::MatrixXd J = control_matrix(settled(now.end));
          reason                  = fault_of(J);
          if (reason.empty())
            reason = hardest_of(J);
        }
      catch (const NotConverged &)
        {
          // nothing moves on from there: then there is no matrix either
        }
    fail(why + (reason.empty() ? "" : ": " + reason));
  }



  void
  TrimAnalysis::Run::leave(const Look &look)
  {
    // the end lies on the constraints
    context.state          = look.end;
    context.is_equilibrium = false;

    const VectorX u         = controls_of(look.start);
    trim.report.controls    = {u.data(), u.data() + u.size()};
    trim.report.averages    = {look.averages.data(), look.averages.data() + look.averages.size()};
    trim.report.turns       = turns();
    trim.report.products    = motion->n_applied;
    trim.report.periodicity = look.largest_gap;
    trim.report.miss        = look.miss;
    trim.report.iterations  = n_looks;
    trim.report.effort =
      Effort{double(motion->n_marched), double(motion->n_iterations), double(motion->n_factorizations)};
  }



  void
  TrimAnalysis::Run::write(const Look &look) const
  {
    if (context.folder.empty())
      return;
    Table         table({"what", "name", "value", "unit", "wanted or lower limit", "upper limit"});
    const auto    limit = [](const double x) { return std::isfinite(x) ? x : std::nan(""); };
    const VectorX u     = controls_of(look.start);
    for (unsigned int j = 0; j < controls.size(); ++j)
      table.add_row({"control",
                     controls[j].name,
                     u(j),
                     controls[j].unit,
                     Table::Cell::optional(limit(controls[j].lower)),
                     Table::Cell::optional(limit(controls[j].upper))});
    for (unsigned int k = 0; k < targets.size(); ++k)
      table.add_row({"target",
                     targets[k].name,
                     look.averages(k) / targets[k].factor,
                     targets[k].unit,
                     targets[k].value / targets[k].factor,
                     Table::Cell::optional(std::nan(""))});
    table.write(context.folder + "/trim.csv");
    history->write(context.folder + "/trim_history.csv");
  }



  std::optional<State>
  TrimAnalysis::Run::confirm(const Look &look, std::string &why)
  {
    // time goes on here, while all turns before were over the same time
    State next = look.end;
    next.time += trim.period;
    for (unsigned int i = 0; i < system.layout.n_coordinates; ++i)
      next.coordinates[i] += look.turned[i];
    State end = next;
    if (parts && !whole)
      whole = make_motion(trim.n_steps);
    PeriodicMotion &of_turn = parts ? *whole : *motion;
    air                     = {};
    const auto averages =
      averages_in_si(of_turn.turn(end, [this](const State &now, const unsigned int, const std::vector<double> &) {
        air.add(system, now);
      }));
    gap_behind         = of_turn.gap(next, end);
    const auto largest = of_turn.largest(gap_behind);
    double     miss    = 0;
    for (unsigned int k = 0; k < targets.size(); ++k)
      miss = std::max(miss, std::abs(averages(k) - targets[k].value) / targets[k].scale);
    // of the turn behind the one that was found: what grows slowly, or is not quite settled, may still be the orbit
    if (const double size = std::max(largest.size, miss); !(size < 100 * trim.tolerance + 10 * asymmetry))
      {
        why = "the motion comes back after " + std::string(parts ? "a section of " : "") +
              "the period from t = " + number_to_text("%.6g", look.start.time) + " s, but not after the next one" +
              (parts ? " as a whole" : "") + ", by " + number_to_text("%.1e", size) + " of the scales, most " +
              motion->name_of(largest.entry) + ": something that acts does not have this <Period>" +
              (parts ? " or this <Symmetry>" : "") + ", or what was found is not stable";
        return {};
      }
    of_turn.begin_again(look.start, end);
    return end;
  }
} // namespace samara
