#include <samara/aero/airfoil_table.h>
#include <samara/base/text_file.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Slopes of values @p y at @p x: weighted harmonic means, zero at extrema; periodic from −π to π. */
    Eigen::VectorXd
    monotone_slopes(const std::vector<double> &x, const Eigen::VectorXd &y)
    {
      const unsigned int n    = x.size();
      const auto         mean = [](const double h0, const double h1, const double d0, const double d1) {
        if (d0 * d1 <= 0)
          return 0.;
        const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
        return (w0 + w1) / (w0 / d0 + w1 / d1);
      };
      const auto      h = [&](const unsigned int i) { return x[i + 1] - x[i]; };
      const auto      d = [&](const unsigned int i) { return (y(i + 1) - y(i)) / h(i); };
      Eigen::VectorXd slopes(n);
      for (unsigned int i = 1; i + 1 < n; ++i)
        slopes(i) = mean(h(i - 1), h(i), d(i - 1), d(i));
      slopes(0) = slopes(n - 1) = mean(h(n - 2), h(0), d(n - 2), d(0));
      return slopes;
    }
  } // namespace



  AirfoilTable::AirfoilTable(const std::vector<double> &angles,
                             const std::vector<double> &machs,
                             const Eigen::MatrixXd     &values)
    : angles(angles)
    , machs(machs)
    , values(values)
    , slopes(values.rows(), values.cols())
  {
    Assert(angles.size() >= 2 && !machs.empty(), dealii::ExcMessage("A table has two angles and a Mach number."));
    AssertDimension(values.rows(), angles.size());
    AssertDimension(values.cols(), machs.size());
    Assert(std::is_sorted(angles.begin(), angles.end()) && std::is_sorted(machs.begin(), machs.end()),
           dealii::ExcMessage("Angles and Mach numbers of a table increase."));
    for (unsigned int j = 0; j < machs.size(); ++j)
      slopes.col(j) = monotone_slopes(angles, values.col(j));
  }



  namespace
  {
    /** The interval of @p x, increasing, in which @p at is; its first number. */
    unsigned int
    interval_of(const std::vector<double> &x, const double at)
    {
      const auto above = std::upper_bound(x.begin() + 1, x.end() - 1, at);
      return above - x.begin() - 1;
    }
  } // namespace



  AirfoilTable::Value
  AirfoilTable::at(const double alpha, const double mach) const
  {
    unsigned int j = 0, next = 0;
    double       u = 0, per_mach = 0;
    if (machs.size() > 1)
      {
        j        = interval_of(machs, mach);
        next     = j + 1;
        per_mach = 1 / (machs[next] - machs[j]);
        u        = std::min(1., std::max(0., (mach - machs[j]) * per_mach));
        if (mach < machs.front() || mach > machs.back())
          per_mach = 0;
      }
    const unsigned int i = interval_of(angles, alpha);
    const double       h = angles[i + 1] - angles[i], t = (alpha - angles[i]) / h, t2 = t * t, t3 = t2 * t;
    const double       b[] = {2 * t3 - 3 * t2 + 1, 3 * t2 - 2 * t3, h * (t3 - 2 * t2 + t), h * (t3 - t2)};
    const double       d[] = {6 * (t2 - t) / h, 6 * (t - t2) / h, 3 * t2 - 4 * t + 1, 3 * t2 - 2 * t};
    const auto         sum = [&](const double *w, const unsigned int column) {
      return w[0] * values(i, column) + w[1] * values(i + 1, column) + w[2] * slopes(i, column) +
             w[3] * slopes(i + 1, column);
    };
    const double here = sum(b, j), there = sum(b, next);
    return {(1 - u) * here + u * there, (1 - u) * sum(d, j) + u * sum(d, next), per_mach * (there - here)};
  }



  void
  TabulatedAirfoil::add_parameters(Parameters &prm)
  {
    prm.add_file("File", file, "File with the tables, relative to the .prm file that says it.");
    prm.add(
      "Beyond",
      beyond_text,
      "What is done with tables that do not reach from -180 to 180 degrees: they are refused, or their coefficients "
      "stay constant beyond the last angles.",
      dealii::Patterns::Selection("refuse|constant"));
  }



  void
  TabulatedAirfoil::initialize(Model &model)
  {
    if (!parameters.require("File", model.complaints))
      return;
    try
      {
        tables = read(text_of_file(file));
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where("File"), problem.what());
      }
  }



  double
  TabulatedAirfoil::highest_mach() const
  {
    return std::min(tables.lift.highest_mach(), tables.drag.highest_mach());
  }



  Coefficients
  TabulatedAirfoil::at(const double alpha, const double mach) const
  {
    const AirfoilTable::Value l = tables.lift.at(alpha, mach), d = tables.drag.at(alpha, mach),
                              m = tables.moment.at(alpha, mach);
    return {l.value, d.value, m.value, l.alpha, d.alpha, m.alpha, l.mach, d.mach, m.mach};
  }



  void
  AeroDynAirfoil::add_parameters(Parameters &prm)
  {
    TabulatedAirfoil::add_parameters(prm);
    prm.add("Table",
            which,
            "Which of the tables of the file, for several Reynolds numbers.",
            dealii::Patterns::Integer(1));
  }
} // namespace samara
