// Trim by continuation in constants of the model.

#include <samara/analysis/trim_path.h>
#include <samara/base/errors.h>
#include <samara/base/text.h>

#include <cmath>

namespace samara
{
  namespace
  {
    constexpr double first_step_of_path = 0.25, shortest_step_of_path = 1. / 64; ///< of the way

    std::vector<std::string>
    columns_of_path(const TrimAnalysis &trim)
    {
      std::vector<std::string> result = {"share", "turns"};
      for (const auto &c : trim.continuation)
        result.push_back(c.constant);
      for (const auto &control : trim.controls)
        result.push_back(control.name);
      return result;
    }
  } // namespace



  TrimAnalysis::Path::Path(TrimAnalysis &trim, Context &context)
    : trim(trim)
    , context(context)
    , table(columns_of_path(trim))
  {}



  std::string
  TrimAnalysis::Path::values_at(const double share) const
  {
    std::vector<std::string> texts;
    for (const auto &c : trim.continuation)
      texts.push_back(c.constant + " = " + number_to_text("%.6g", c.first + share * (c.last - c.first)));
    return join(texts, ", ");
  }



  std::shared_ptr<TrimVariant>
  TrimAnalysis::Path::model_at(const double share) const
  {
    std::vector<std::pair<std::string, double>> parts;
    for (const auto &c : trim.continuation)
      parts.emplace_back(c.constant, (c.first + share * (c.last - c.first)) / c.last);
    std::shared_ptr<TrimVariant> result = trim.variant(parts);
    const Layout                &theirs = result->context().system.layout, &ours = context.system.layout;
    if (result->context().system.size() != context.system.size() || theirs.n_states != ours.n_states ||
        theirs.n_coordinates != ours.n_coordinates || theirs.n_nodes != ours.n_nodes)
      throw InputError(trim.parameters.where("Continue") + ": with " + values_at(share) +
                       " the model has other unknowns; a motion can only be led on in the same ones");
    return result;
  }



  State
  TrimAnalysis::Path::predicted(const double share) const
  {
    const Found &last = found.back();
    if (found.size() == 1)
      return last.state;
    const Found &before = found.front();
    const auto   change = increment(context.system, before.state, last.state, true);
    return moved(context.system, last.state, change.data(), (share - last.share) / (last.share - before.share));
  }



  void
  TrimAnalysis::Path::keep(const Found &next, TrimAnalysis &of)
  {
    turns += of.report.turns;
    std::vector<Table::Cell> row = {next.share, of.report.turns};
    for (const auto &c : trim.continuation)
      row.emplace_back(c.first + next.share * (c.last - c.first));
    for (const double u : of.report.controls)
      row.emplace_back(u);
    table.add_row(row);
    if (!context.folder.empty())
      table.write(context.folder + "/trim_path.csv");
    Eigen::VectorXd u(of.report.controls.size());
    for (unsigned int j = 0; j < u.size(); ++j)
      for (const auto &state : context.system.model.states)
        if (state.name == trim.controls[j].name)
          u(j) = of.report.controls[j] / state.scale;
    controls_at.emplace_back(next.share, u);
    found.push_back(next);
    if (found.size() > 2)
      found.erase(found.begin());
    context.log.progress("trim: found at " + values_at(next.share) + " in " + short_text(of.report.turns) + " turns");
  }



  void
  TrimAnalysis::Path::begin()
  {
    const auto model = model_at(0);
    try
      {
        model->lead_up();
        Run(model->trim(), model->context()).go();
      }
    catch (const NotConverged &problem)
      {
        throw NotConverged("trim: the continuation has no beginning: with " + values_at(0) + ": " + problem.what());
      }
    keep({0., model->context().state, model}, model->trim());
  }



  void
  TrimAnalysis::Path::advance(const double share)
  {
    const State near = predicted(share);
    if (share == 1)
      {
        Run(trim, context).go_on(near);
        return keep({share, context.state, nullptr}, trim);
      }
    const auto model = model_at(share);
    Run(model->trim(), model->context()).go_on(near);
    keep({share, model->context().state, model}, model->trim());
  }



  std::string
  TrimAnalysis::Path::limits_ahead() const
  {
    if (found.size() < 2)
      return "";
    const Found &last   = found.back();
    const auto   limits = [](const Found &f) { return Run(f.model->trim(), f.model->context()).limits(f.state); };
    const auto   before = limits(found.front()), now = limits(last);
    std::string  text;
    for (unsigned int j = 0; j < now.size(); ++j)
      {
        const double rate  = (now[j].value - before[j].value) / (last.share - found.front().share);
        const double share = last.share + ((rate > 0 ? now[j].upper : now[j].lower) - now[j].value) / rate;
        if (rate != 0 && share < 1)
          text += "; <" + now[j].name + "> is at " + number_to_text("%.6g", now[j].value) +
                  " there and goes on to its " + (rate > 0 ? "upper" : "lower") + " limit, reached at about " +
                  values_at(share);
      }
    return text;
  }



  std::string
  TrimAnalysis::Path::limit_point(const double beyond) const
  {
    const unsigned int n = controls_at.size();
    if (n < 3)
      return "";
    // controls go as the root of what is left of the way: the point for which the last three lie on one parabola
    const auto &[s_1, u_1] = controls_at[n - 3];
    const auto &[s_2, u_2] = controls_at[n - 2];
    const auto &[s_3, u_3] = controls_at[n - 1];
    const double wanted = (u_3 - u_2).norm() / (u_2 - u_1).norm(), first = s_1, second = s_2, third = s_3;
    const auto   ratio = [=](const double at) {
      return (std::sqrt(at - second) - std::sqrt(at - third)) / (std::sqrt(at - first) - std::sqrt(at - second));
    };
    double lower = third, upper = beyond + shortest_step_of_path;
    if (!(wanted < ratio(lower) && wanted > ratio(upper)))
      return ""; // slower, or faster, as towards an asymptote
    for (unsigned int i = 0; i < 50; ++i)
      (ratio((lower + upper) / 2) > wanted ? lower : upper) = (lower + upper) / 2;
    return "; on the way there controls change ever faster, as they do before a limit point, which would be at about " +
           values_at(upper) +
           ": there the path turns round, and beyond it there is no motion that goes on from this one";
  }



  void
  TrimAnalysis::Path::stop(const double beyond, const std::string &why)
  {
    const Found &last = found.back();
    std::string  text = "trim: the continuation stops at " + values_at(last.share) + "; at " + values_at(beyond) +
                       " nothing is found any more: " + why + "\n  about the motion at " + values_at(last.share) + ": ";
    try
      {
        text += Run(last.model->trim(), last.model->context()).weakness(last.state);
      }
    catch (const NotConverged &)
      {
        text += "it does not go on by itself, so that what controls do is not known";
      }
    throw NotConverged(text + limit_point(beyond) + limits_ahead());
  }



  void
  TrimAnalysis::Path::go()
  {
    context.log.line("trim: by continuation from " + values_at(0));
    begin();
    for (double step = first_step_of_path; found.back().share < 1;)
      {
        const double share = std::min(1., found.back().share + step);
        try
          {
            advance(share);
            step *= 2;
          }
        catch (const NotConverged &problem)
          {
            if (step <= shortest_step_of_path)
              stop(share, problem.what());
            step /= 2;
            context.log.line("trim: not found at " + values_at(share) + ", a shorter step");
          }
      }
    trim.report.turns = turns;
    context.log.line("trim: by continuation, in " + short_text(turns) +
                     " turns that were found, beside those that failed");
  }
} // namespace samara
