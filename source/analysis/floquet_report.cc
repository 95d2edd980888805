// What a Floquet analysis tells: floquet.csv, and its lines.

#include <samara/analysis/floquet.h>
#include <samara/base/text.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace samara
{
  namespace
  {
    /** |multiplier| − 1 that does not tell: free motions, and what is not damped. */
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
    double largest = 0;
    for (const auto &mode : modes)
      largest = std::max(largest, std::abs(mode.multiplier));
    const std::string value = number_to_text("%.10g", largest);
    if (largest > 1 + undecided)
      return context.log.line("  the motion is unstable: the largest multiplier is " + value);
    if (found.n_looked_for > 0)
      return context.log.line("  of these slow modes none grows, the largest multiplier is " + value +
                              "; faster ones have not been looked at");
    context.log.line(std::string("  the motion is ") +
                     (largest < 1 - undecided ? "stable" : "neither stable nor unstable to first order") +
                     ": the largest multiplier is " + value);
  }



  void
  FloquetAnalysis::tell_open_modes(const Context &context, const FloquetModes &found) const
  {
    if (found.n_looked_for == 0)
      return;
    if (found.n_open > 0)
      context.log.warning("floquet",
                          std::to_string(found.n_open) + " slow modes have not come to the <Tolerance> with " +
                            std::to_string(found.n_columns) + " columns, and are left out: residuals are up to " +
                            number_to_text("%.1e", found.largest_residual));
    if (found.found.size() + found.n_open < found.n_looked_for)
      context.log.line("  at the start of the period, as if coefficients stayed, there are " +
                       std::to_string(found.n_looked_for) + " slow modes; over the period " +
                       std::to_string(found.found.size() + found.n_open) + " are mostly of these");
  }



  void
  FloquetAnalysis::report(const Context &context, const FloquetModes &found, const double T) const
  {
    const unsigned int parts = is_by_sections() ? groups()[0].size() : 1;
    const double       h     = T / n_steps;
    context.log.line("floquet: period " + number_to_text("%.6g", T) + " s, " + std::to_string(n_steps) +
                     " steps, periodic to " + number_to_text("%.1e", gap) + "; " +
                     (found.is_all           ? "all " :
                      found.n_looked_for > 0 ? "slow modes, " :
                                               "Arnoldi's method, ") +
                     std::to_string(found.n_columns) + " columns of the map over " +
                     (parts > 1 ? "a part of " + std::to_string(parts) : std::string("the period")));
    Table table(columns_of_modes);
    for (unsigned int i = 0; i < modes.size(); ++i)
      {
        add_mode(modes[i], i + 1, h, T, table);
        context.log.line(line_of_mode(modes[i], i + 1));
        if (const std::string text = text_of_steps(modes[i], h, T); !text.empty())
          context.log.warning("floquet", "mode " + std::to_string(i + 1) + text);
      }
    tell_open_modes(context, found);
    tell_stability(context, found);
    if (context.folder.empty())
      return;
    if (!context.sweep.empty())
      table.write(context.folder + "/floquet_" + short_text(context.speeds[0]) + ".csv");
    if (context.is_shown())
      table.write(context.folder + "/floquet.csv");
  }
} // namespace samara
