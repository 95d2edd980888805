// What a Floquet analysis tells: floquet.csv and its lines, the motion it was left with, pictures.

#include <samara/analysis/floquet.h>
#include <samara/analysis/progress.h>
#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/model/probe_needs.h>
#include <samara/output/pictures.h>
#include <samara/report/report_page.h>
#include <samara/time/projection.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace samara
{
  namespace
  {
    /** |multiplier| − 1 that does not tell, nor does a smaller one than its error: free motions, and what is not
     * damped.
     */
    constexpr double undecided = 1e-6;



    std::string
    line_of_mode(const FloquetMode &m, const unsigned int number)
    {
      std::ostringstream line;
      line << "  mode " << number << ": |multiplier| " << number_to_text("%.8g", std::abs(m.multiplier))
           << ", growth rate " << number_to_text("%.6g", m.growth()) << " 1/s, "
           << number_to_text("%.6g", m.frequency()) << " rad/s  (";
      if (!m.content.family.empty())
        line << m.content.family << ", " << m.content.pattern << "; ";
      // the first, and up to two others with 2 % and more
      if (!m.shares.empty() && m.shares[0].second > 0)
        for (unsigned int k = 0; k < std::min<std::size_t>(3, m.shares.size()); ++k)
          if (k == 0 || m.shares[k].second > 0.02)
            line << (k > 0 ? ", " : "") << m.shares[k].first << " " << std::lround(100 * m.shares[k].second) << " %";
      return line.str() + ")";
    }



    /** What the steps do to a mode, if it matters. */
    std::string
    text_of_steps(const FloquetMode &m, const double h, const double T)
    {
      // 1 % of the exponent is worth a warning (doc/theory/floquet.md); exponents below a thousandth a period are zero
      if (std::abs(m.scheme_error) > 0.01 * std::max(std::abs(m.exponent), 1e-3 / T))
        return " is not resolved: there are " + number_to_text("%.2g", 2 * M_PI / (m.rate * h)) +
               " steps a cycle; take more <Steps>";
      if (-m.scheme_error.real() > 0.01 * std::abs(m.growth()) + 1e-9 * m.frequency())
        return ": the steps add a damping of about " + number_to_text("%.2g", -m.scheme_error.real()) +
               " 1/s; take more <Steps>, or <Spectral radius = 1>";
      return "";
    }



    const std::vector<std::string> columns_of_modes = {"mode",
                                                       "multiplier",
                                                       "multiplier real",
                                                       "multiplier imaginary",
                                                       "growth rate [1/s]",
                                                       "frequency [rad/s]",
                                                       "frequency mod period [rad/s]",
                                                       "damping ratio",
                                                       "steps a cycle",
                                                       "growth error by steps [1/s]",
                                                       "frequency error by steps [rad/s]",
                                                       "residual",
                                                       "most in",
                                                       "share",
                                                       "family",
                                                       "share of family",
                                                       "pattern",
                                                       "share of pattern"};



    void
    add_mode(const FloquetMode &m, const unsigned int number, const double h, const double T, Table &table)
    {
      const bool has_share = !m.shares.empty() && m.shares[0].second > 0;
      table.add_row({number,
                     std::abs(m.multiplier),
                     m.multiplier.real(),
                     m.multiplier.imag(),
                     m.growth(),
                     m.frequency(),
                     std::abs(std::arg(m.multiplier)) / T,
                     std::abs(m.exponent) > 0 ? -m.growth() / std::abs(m.exponent) : 0.,
                     Table::Cell::optional(m.rate > 0 ? 2 * M_PI / (m.rate * h) : std::nan("")),
                     m.scheme_error.real(),
                     m.scheme_error.imag(),
                     m.residual,
                     has_share ? m.shares[0].first : "",
                     has_share ? m.shares[0].second : 0.,
                     m.content.family,
                     m.content.family_share,
                     m.content.pattern,
                     m.content.pattern_share});
    }
  } // namespace



  void
  FloquetAnalysis::tell_stability(const Context &context, const FloquetModes &found) const
  {
    const FloquetMode *largest = &modes.front(), *growing = nullptr;
    bool               decays = true;
    for (const auto &mode : modes)
      {
        const double size = std::abs(mode.multiplier), margin = std::max(undecided, mode.error);
        if (size > std::abs(largest->multiplier))
          largest = &mode;
        if (size > 1 + margin && (growing == nullptr || size > std::abs(growing->multiplier)))
          growing = &mode;
        decays = decays && size < 1 - margin;
      }
    const auto text_of = [](const FloquetMode &mode) {
      const std::string value = number_to_text("%.10g", std::abs(mode.multiplier));
      return value + (mode.error > undecided ? ", known to " + number_to_text("%.0e", mode.error) : "");
    };
    if (growing != nullptr)
      return context.log.line("  the motion is unstable: the largest multiplier is " + text_of(*growing));
    const std::string value = text_of(*largest);
    if (found.n_looked_for > 0)
      return context.log.line("  of these slow modes none grows, the largest multiplier is " + value +
                              "; faster ones have not been looked at");
    context.log.line(std::string("  the motion is ") +
                     (decays ? "stable" : "neither stable nor unstable to first order") +
                     ": the largest multiplier is " + value);
  }



  void
  FloquetAnalysis::tell_lost_modes(const Context &context, const FloquetModes &found) const
  {
    if (found.n_lost > 0)
      context.log.line("  modes that decay to round-off between sections are not told: " +
                       std::to_string(found.n_lost) + " directions of those at the start, as if coefficients stayed");
  }



  void
  FloquetAnalysis::report(const Context &context, const FloquetModes &found, const double T) const
  {
    const unsigned int parts = is_by_sections() ? groups()[0].size() : 1;
    const double       h     = T / n_steps;
    context.log.line("floquet: period " + number_to_text("%.6g", T) + " s, " + std::to_string(n_steps) +
                     " steps, periodic to " + number_to_text("%.1e", gap) + "; " +
                     (found.is_all           ? "all modes from " :
                      found.n_looked_for > 0 ? "slow modes from " :
                                               "largest multipliers from ") +
                     std::to_string(found.n_columns) + " directions, each through " +
                     (parts > 1 ? "1/" + std::to_string(parts) + " of the period" : std::string("the period")));
    Table table(columns_of_modes);
    for (unsigned int i = 0; i < modes.size(); ++i)
      {
        add_mode(modes[i], i + 1, h, T, table);
        context.log.line(line_of_mode(modes[i], i + 1));
        if (const std::string text = text_of_steps(modes[i], h, T); !text.empty())
          context.log.warning("floquet", "mode " + std::to_string(i + 1) + text);
      }
    tell_lost_modes(context, found);
    tell_stability(context, found);
    if (context.folder.empty())
      return;
    if (!context.sweep.empty())
      table.write(context.folder + "/floquet_" + context.name_of_speed() + ".csv");
    if (context.is_shown())
      table.write(context.folder + "/floquet.csv");
  }



  /** Leave the motion that was reached last, though it is no periodic one. */
  void
  FloquetAnalysis::keep_motion(Context &context, const SectionMap &map) const
  {
    context.state          = map.map.states().front();
    context.is_equilibrium = false;
    if (context.folder.empty())
      return;
    const Layout            &layout  = context.system.layout;
    std::vector<std::string> columns = {"t [s]"};
    const auto               add     = [&](const std::string &name, const std::string &unit) {
      columns.push_back(name + " [" + (unit.empty() ? "1" : unit) + "]");
    };
    for (unsigned int i = 0; i < layout.n_coordinates; ++i)
      add(layout.model.coordinates[i], layout.unit_of(layout.of_coordinate(i)));
    for (unsigned int i = 0; i < layout.n_states; ++i)
      add(layout.model.states[i].name, layout.unit_of(layout.of_state(i)));
    for (const auto &probe : context.probes)
      add(probe.name, probe.unit);
    Table            table(columns);
    const ProbeNeeds needs(context.probes);
    Projection       projection(context.system);
    for (State state : map.map.states())
      {
        std::vector<Table::Cell> row = {state.time};
        row.insert(row.end(), state.coordinates.begin(), state.coordinates.end());
        row.insert(row.end(), state.states.begin(), state.states.end());
        bool is_known = true;
        try
          {
            projection.report(state, needs.forces); // algebraic states, too
          }
        catch (const SingularMatrix &)
          {
            is_known = false; // which is not what is to be told here
          }
        for (const auto &probe : context.probes)
          row.push_back(Table::Cell::optional(is_known ? probe.value(state) : std::nan("")));
        table.add_row(row);
      }
    table.write(context.folder + "/floquet_orbit.csv");
  }



  void
  FloquetAnalysis::add_to_speeds(const Context &context, const double T)
  {
    if (!of_speeds)
      of_speeds = std::make_unique<Table>(std::vector<std::string>{"speed [rad/s]",
                                                                   "branch",
                                                                   "multiplier",
                                                                   "growth rate [1/s]",
                                                                   "frequency [rad/s]",
                                                                   "frequency mod period [rad/s]",
                                                                   "family",
                                                                   "pattern",
                                                                   "mode"});
    std::vector<Mode> shapes;
    for (const auto &mode : modes)
      {
        Mode shape;
        shape.lambda = {mode.growth(), std::abs(std::arg(mode.multiplier)) / T}; // which is what shapes belong to
        shape.shape  = mode.shape.head(context.system.layout.n_kinematic());
        shapes.push_back(shape);
      }
    SparseMatrix M(context.system.layout.pattern);
    context.system.mass(M);
    const auto branches = tracking.follow(shapes, M, M_PI / T);
    for (unsigned int i = 0; i < modes.size(); ++i)
      of_speeds->add_row({context.speeds[0],
                          branches[i],
                          std::abs(modes[i].multiplier),
                          modes[i].growth(),
                          modes[i].frequency(),
                          std::abs(std::arg(modes[i].multiplier)) / T,
                          modes[i].content.family,
                          modes[i].content.pattern,
                          i + 1});
  }



  void
  FloquetAnalysis::animate(const Context &context, SectionMap &map) const
  {
    const unsigned int n = std::min<unsigned int>(n_animations, modes.size());
    Progress           progress(context.log, "floquet", "drawings", nullptr);
    for (unsigned int k = 0; k < n; ++k)
      {
        const std::string doing = "drawing of mode " + std::to_string(k + 1) + " of " + std::to_string(n);
        progress(doing);
        if (context.page != nullptr)
          context.page->watch("floquet: " + doing);
        animate(context, map, k);
      }
  }



  void
  FloquetAnalysis::animate(const Context &context, SectionMap &map, const unsigned int k) const
  {
    const System                 &system = context.system;
    const FloquetMode            &mode   = modes[k];
    std::vector<Eigen::VectorXcd> images;
    map.follow(mode.shape, mode.of_section, [&](const unsigned int, const Eigen::VectorXcd &x) {
      images.push_back(x);
    });
    // without growth, the largest displacement a twentieth of the model
    images.resize(map.map.settings.n_steps);
    double largest = 0;
    for (unsigned int i = 0; i < images.size(); ++i)
      {
        images[i] *= std::exp(-mode.growth() * map.map.settings.period / map.map.settings.n_steps * double(i));
        for (int j = 0; j < system.layout.of_coordinate(0); ++j)
          largest = std::max(largest, std::abs(images[i](j)) / map.scales()[j]);
      }
    if (!(largest > 0))
      return;
    for (auto &image : images)
      image *= 0.05 / largest;
    if (context.page != nullptr && context.page->draws())
      show(context, map, images, k);
    if (!context.pictures)
      return;
    Pictures pictures(context.folder, "floquet_" + std::to_string(k + 1));
    for (unsigned int i = 0; i < images.size(); ++i)
      {
        const Eigen::VectorXd x     = images[i].real();
        const State          &state = map.map.states()[i];
        pictures.add(system.draw(moved(system, state, x.data())), state.time);
      }
    pictures.finish();
  }



  void
  FloquetAnalysis::show(const Context                       &context,
                        SectionMap                          &map,
                        const std::vector<Eigen::VectorXcd> &images,
                        const unsigned int                   k) const
  {
    constexpr unsigned int most_pictures = 72;   // of a period: each five degrees of a turn
    constexpr double       epsilon       = 1e-4; // see show_shape()
    const unsigned int     every         = (images.size() + most_pictures - 1) / most_pictures;
    ReportPage::Shape      what;
    what.name   = "floquet_" + std::to_string(k + 1);
    what.number = k + 1;
    what.period = map.map.settings.period;
    what.turn   = std::arg(modes[k].multiplier);
    what.lambda = {modes[k].growth(), modes[k].frequency()};
    if (!context.sweep.empty())
      what.speed = context.speeds[0];
    for (unsigned int i = 0; i < images.size(); i += every)
      {
        const State &state = map.map.states()[i];
        const auto   at    = [&](const std::complex<double> &factor) {
          const Eigen::VectorXd x = (images[i] * factor).real();
          return context.system.draw(moved(context.system, state, x.data()), Drawing::Content::places);
        };
        const auto mean = [&](const Drawing::Content content) { return context.system.draw(state, content); };
        const std::complex<double> turned(0, epsilon);
        context.page->add_to_shape(
          what, state.time, mean, {{at(epsilon), at(-epsilon), at(turned), at(-turned)}}, epsilon);
      }
  }



  void
  FloquetAnalysis::finish(Context &context)
  {
    if (of_speeds && !context.folder.empty())
      of_speeds->write(context.folder + "/floquet_speeds.csv");
  }
} // namespace samara
