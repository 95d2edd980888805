// What is told of modes: tables, the fan, pictures, and whether they grow.

#include <samara/analysis/draw_shape.h>
#include <samara/analysis/modal.h>
#include <samara/analysis/negative_directions.h>
#include <samara/analysis/progress.h>
#include <samara/base/text.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace samara
{
  namespace
  {
    /** "modes 1, 2 grow, the fastest e-fold in 0.4 s (damping ratio -0.01)", far above round-off; empty if none does.
     */
    std::string
    text_of_growth(const std::vector<Mode> &modes)
    {
      std::vector<std::string> numbers;
      double                   fastest = 0, ratio = 0;
      for (unsigned int i = 0; i < modes.size(); ++i)
        if (const double size = std::abs(modes[i].lambda);
            modes[i].lambda.real() > std::max(1e-7, 100 * modes[i].error) * size)
          {
            numbers.push_back(std::to_string(i + 1));
            if (modes[i].lambda.real() > fastest)
              {
                fastest = modes[i].lambda.real();
                ratio   = modes[i].damping_ratio();
              }
          }
      if (numbers.empty())
        return "";
      return (numbers.size() > 1 ? "modes " + join_some(numbers) + " grow, the fastest" :
                                   "mode " + numbers[0] + " grows") +
             " e-fold in " + short_text(1 / fastest) + " s (damping ratio " + short_text(ratio) + ")";
    }
  } // namespace



  void
  ModalAnalysis::tell_instability(const Context &context, const Steady &steady) const
  {
    State held                        = steady.state;
    held.held                         = true;
    const NegativeDirections negative = negative_directions(context.system, held);
    const std::string        growth   = text_of_growth(modes),
                      at              = context.sweep.empty() ? "" : "at " + short_text(context.speeds[0]) + " rad/s ";
    if (negative.number == 0 && growth.empty())
      return;
    if (negative.number == 0)
      return context.log.warning(
        "modal", at + "the state is unstable, by flutter, friction or a law, not by its stiffness: " + growth);
    const std::string text = at + negative.text(context.system);
    if (!growth.empty())
      context.log.warning("modal", text + "; " + growth);
    else if (negative.are_unstable())
      context.log.warning("modal",
                          text + "; the motion that grows is not among these modes: ask for more, or set the <Shift>");
    else
      context.log.line("  modal: " + text + "; none of these modes grows" +
                       (negative.turning == NegativeDirections::Turning::as_one ?
                          ": gyroscopic forces hold those in which it is negative" :
                          ""));
  }



  void
  ModalAnalysis::add_to_fan(const Context &context)
  {
    if (!fan)
      fan = std::make_unique<Table>(std::vector<std::string>{"speed [rad/s]",
                                                             "branch",
                                                             "frequency [rad/s]",
                                                             "damping ratio",
                                                             "real [1/s]",
                                                             "imaginary [rad/s]",
                                                             "family",
                                                             "pattern",
                                                             "mode"});
    for (unsigned int i = 0; i < modes.size(); ++i)
      fan->add_row({context.speeds[0],
                    branches[i],
                    modes[i].frequency(),
                    modes[i].damping_ratio(),
                    modes[i].lambda.real(),
                    modes[i].lambda.imag(),
                    contents.empty() ? "" : contents[i].family,
                    contents.empty() ? "" : contents[i].pattern,
                    i + 1});
  }



  std::vector<std::pair<std::string, double>>
  participation(const System &system, const Mode &mode)
  {
    std::map<std::string, double> energy;
    double                        total = 0;
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const Eigen::Matrix<std::complex<double>, 6, 1> z = mode.shape.segment<6>(system.layout.of_node(node));
        const double e = (z.adjoint() * system.model.nodes[node].inertia * z)(0, 0).real();
        energy[system.model.nodes[node].name] += e;
        total += e;
      }
    std::vector<std::pair<std::string, double>> shares;
    for (const auto &[name, e] : energy)
      shares.emplace_back(name, total > 0 ? e / total : 0.);
    std::sort(shares.begin(), shares.end(), [](const auto &a, const auto &b) { return a.second > b.second; });
    return shares;
  }



  void
  ModalAnalysis::report(Context &context) const
  {
    Table table({"mode",
                 "frequency [rad/s]",
                 "frequency [Hz]",
                 "damping ratio",
                 "real [1/s]",
                 "imaginary [rad/s]",
                 "estimated relative error",
                 "family",
                 "share of family",
                 "pattern",
                 "share of pattern"});
    for (unsigned int i = 0; i < modes.size(); ++i)
      {
        const Mode       &m       = modes[i];
        const ModeContent content = contents.empty() ? ModeContent() : contents[i];
        table.add_row({i + 1,
                       m.frequency(),
                       m.frequency() / (2 * M_PI),
                       m.damping_ratio(),
                       m.lambda.real(),
                       m.lambda.imag(),
                       m.error,
                       content.family,
                       content.family_share,
                       content.pattern,
                       content.pattern_share});
        std::ostringstream line;
        line << "  mode " << i + 1 << ": ";
        if (m.is_free())
          line << "0 rad/s, a free motion  (";
        else
          line << short_text(m.frequency()) << " rad/s, damping ratio "
               << short_text(std::abs(m.damping_ratio()) < 10 * m.error + 1e-10 ? 0. : m.damping_ratio()) << "  (";
        if (!content.family.empty())
          line << content.family << (content.pattern.empty() ? "" : ", ") << content.pattern << "; ";
        // the first, and up to two others with 2 % and more
        const auto shares = participation(context.system, m);
        for (unsigned int k = 0; k < std::min<unsigned int>(3, shares.size()) && (k == 0 || shares[k].second > 0.02);
             ++k)
          line << (k > 0 ? ", " : "") << shares[k].first << " " << std::lround(100 * shares[k].second) << " %";
        context.log.line(line.str() + ")");
      }
    if (context.folder.empty())
      return;
    if (!context.sweep.empty())
      table.write(context.folder + "/modes_" + context.name_of_speed() + ".csv");
    if (context.is_shown())
      table.write(context.folder + "/modes.csv");
  }



  void
  ModalAnalysis::animate(const Context &context) const
  {
    const bool         is_shown = context.is_shown();
    const unsigned int n        = std::min<unsigned int>(n_animations, modes.size());
    Progress           progress(context.log, "modal", "drawings", nullptr);
    const auto         tell = [&](const unsigned int k, const unsigned int of, const std::string &where) {
      progress("drawing of mode " + std::to_string(k + 1) + " of " + std::to_string(of) + where);
    };
    for (unsigned int k = 0; k < n && context.pictures && is_shown; ++k)
      {
        tell(k, n, " for ParaView");
        draw_shape(context.system,
                   context.state,
                   modes[k].shape,
                   modes[k].lambda.imag() > 0 ? 2 * M_PI / modes[k].lambda.imag() : 1.,
                   context.folder,
                   "mode_" + std::to_string(k + 1));
      }
    // on the page all modes; those of the speed that is shown keep their room
    for (unsigned int k = 0; k < modes.size() && context.page != nullptr; ++k)
      {
        tell(k, modes.size(), " for the report");
        if (!context.page->has_room_for(is_shown ? 1 : modes.size() + 1))
          continue;
        ReportPage::Shape what;
        what.name    = "mode_" + std::to_string(k + 1) + (is_shown ? "" : " at " + context.name_of_speed() + " rad/s");
        what.number  = k + 1;
        what.lambda  = modes[k].lambda;
        what.is_main = is_shown;
        if (!context.sweep.empty())
          what.speed = context.speeds[0];
        show_shape(context.system, context.state, modes[k].shape, what, *context.page);
        context.page->watch("modal: drawing of mode " + std::to_string(k + 1) + " of " + std::to_string(modes.size()));
      }
  }



  void
  ModalAnalysis::finish(Context &context)
  {
    if (fan && !context.folder.empty())
      fan->write(context.folder + "/fan.csv");
  }
} // namespace samara
