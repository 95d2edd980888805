#include <samara/analysis/controls.h>
#include <samara/analysis/section_map.h>
#include <samara/base/dense.h>
#include <samara/base/errors.h>
#include <samara/base/interrupt.h>
#include <samara/base/text.h>

#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace samara
{
  namespace
  {
    constexpr double       smallest_part = 0.05; ///< of a Newton step
    constexpr unsigned int most_of_step  = 100;  ///< products for one

    /** Of a change that is carried on, over its size at the start, below which it is not compared any more. */
    constexpr double least_size = 1e-8;



    /** Where in an increment controls are, which keep their values: what they change is no motion. */
    std::vector<unsigned int>
    entries_of_controls(const System &system)
    {
      std::vector<unsigned int> result = states_of_controls(system);
      for (auto &i : result)
        i = system.layout.of_state(i);
      return result;
    }
  } // namespace



  SectionMap::SectionMap(const System &system, const PeriodSettings &settings, const RepeatedParts &parts)
    : system(system)
    , map(system, settings)
    , parts(parts)
    , scale(scales_of_increment(system, settings.period * parts.n() / (2 * M_PI)))
    , kept(entries_of_controls(system))
  {}



  void
  SectionMap::tell(const std::string &text) const
  {
    if (listener)
      listener(text);
  }



  void
  SectionMap::begin(const std::string &what, const unsigned int most)
  {
    doing         = what;
    n_products    = 0;
    most_products = most;
    tell(doing);
  }



  SectionMap::Gap
  SectionMap::gap_between(const State &start, const State &end) const
  {
    const std::vector<double> x = parts.gap(start, end);
    // speeds count by the largest that there are
    double       speed       = 1;
    unsigned int n_positions = system.layout.of_multiplier(0);
    for (int i = 0; i < system.layout.of_coordinate(0); ++i)
      speed = std::max(speed, std::abs(start.y[6 + i]) / scale[n_positions + i]);
    Gap result;
    for (unsigned int i = 0; i < x.size(); ++i)
      {
        const double size = std::abs(x[i]) / scale[i] / (i < n_positions ? 1. : speed);
        if (!(size <= result.size))
          result = {size, i < n_positions ? i : i - n_positions};
        if (!std::isfinite(size))
          break; // nothing is larger
      }
    return result;
  }



  void
  SectionMap::keep(const State &start)
  {
    const State end = map.linearize(start);
    parts.align(start, end);
    gap = gap_between(start, end);
  }



  void
  SectionMap::settle(const State &start, const unsigned int most, const double enough)
  {
    State state = start;
    map.project(state);
    for (unsigned int i = 0;; ++i)
      {
        throw_if_interrupted();
        tell("the motion settles, period " + std::to_string(i / parts.n() + 1) + " of at most " +
             std::to_string(std::max(1u, most)) +
             (i > 0 ? ", it lacks " + number_to_text("%.1e", gap.size) + " to periodicity" : std::string()));
        const bool  is_last = i + 1 >= std::max(1u, most) * parts.n();
        const State before  = state;
        state               = map.march(before);
        parts.align(before, state);
        gap            = gap_between(before, state);
        n_sections_run = i + 1;
        if (is_last || gap.size <= enough || !std::isfinite(gap.size))
          return keep(before);
      }
  }



  void
  SectionMap::correct(const unsigned int most, const double enough)
  {
    while (n_corrections < most && gap.size > enough)
      {
        begin("correction " + std::to_string(n_corrections + 1) + " of the motion, which lacks " +
                number_to_text("%.1e", gap.size) + " to periodicity",
              most_of_step);
        if (!step_nearer(solve_for_correction(parts.gap(map.states().front(), map.states().back()))))
          return;
        ++n_corrections;
      }
  }



  bool
  SectionMap::step_nearer(const std::vector<double> &x)
  {
    const State start = map.states().front(), end = map.states().back();
    bool        is_kept = true;
    for (double factor = 1; factor > smallest_part; factor /= 2)
      try
        {
          throw_if_interrupted();
          State trial = moved(system, start, x.data(), factor);
          map.project(trial);
          const State there = map.march(trial);
          parts.align(trial, there);
          // a tenth of what the linear map promises
          if (gap_between(trial, there).size < (1 - 0.1 * factor) * gap.size)
            {
              is_kept = false; // a step may have a solution and no tangent
              keep(trial);
              return true;
            }
        }
      catch (const NotConverged &)
        {
          // too far
        }
    if (!is_kept)
      keep(start);
    else
      parts.align(start, end);
    return false;
  }



  std::vector<double>
  SectionMap::solve_for_correction(const std::vector<double> &lacking)
  {
    struct Matrix
    {
      SectionMap &map;

      void
      vmult(dealii::Vector<double> &to, const dealii::Vector<double> &from) const
      {
        std::vector<double> x(from.size());
        for (unsigned int i = 0; i < x.size(); ++i)
          x[i] = from[i] * map.scale[i];
        map.apply(x.data());
        for (unsigned int i = 0; i < x.size(); ++i)
          to[i] = from[i] - x[i] / map.scale[i];
      }
    };
    dealii::Vector<double> right(lacking.size()), solution(lacking.size());
    for (unsigned int i = 0; i < right.size(); ++i)
      right[i] = lacking[i] / scale[i];
    dealii::SolverControl control(most_of_step, 1e-6 * right.l2_norm(), false, false);
    dealii::SolverGMRES<dealii::Vector<double>>::AdditionalData data(most_of_step + 2);
    dealii::SolverGMRES<dealii::Vector<double>>                 gmres(control, data);
    try
      {
        gmres.solve(Matrix{*this}, solution, right, dealii::PreconditionIdentity());
      }
    catch (const dealii::SolverControl::NoConvergence &)
      {
        // what has been reached may lead nearer
      }
    std::vector<double> x(right.size());
    for (unsigned int i = 0; i < x.size(); ++i)
      x[i] = solution[i] * scale[i];
    return x;
  }



  void
  SectionMap::apply(double *x)
  {
    throw_if_interrupted();
    ++n_products;
    tell(doing + ", " + std::to_string(n_products) +
         (most_products > 0 ? " of at most " + std::to_string(most_products) : std::string()) +
         " products with the map over " + (parts.n() > 1 ? "a part of the period" : "the period"));
    keep_controls(x);
    map.apply(x);
    parts.apply(x);
    keep_controls(x);
  }



  void
  SectionMap::keep_controls(double *x) const
  {
    for (const auto i : kept)
      x[i] = 0;
  }



  double
  SectionMap::scaled_norm(const std::vector<double> &x) const
  {
    double sum = 0;
    for (unsigned int i = 0; i < x.size(); ++i)
      sum += (x[i] / scale[i]) * (x[i] / scale[i]);
    return std::sqrt(sum);
  }



  double
  SectionMap::difference_behind()
  {
    std::mt19937                           generator(map.size());
    std::uniform_real_distribution<double> number(-1., 1.);
    std::vector<double>                    by_map(map.size());
    for (unsigned int i = 0; i < by_map.size(); ++i)
      by_map[i] = number(generator) * scale[i];
    keep_controls(by_map.data());
    const double        first   = scaled_norm(by_map);
    std::vector<double> carried = by_map;
    map.apply(carried.data());
    apply(by_map.data());
    State  state  = map.states().back();
    double result = 0;
    for (unsigned int j = 1; j < std::max(2u, parts.n()); ++j)
      {
        throw_if_interrupted();
        const State before = state;
        state              = map.carry(before, carried.data());
        apply(by_map.data());
        std::vector<double> back = carried;
        for (unsigned int i = 0; i <= j; ++i)
          parts.apply(back.data());
        // of what has all but died away only round-off is left
        const double size = std::max(scaled_norm(by_map), least_size * first);
        for (unsigned int i = 0; i < back.size(); ++i)
          back[i] -= by_map[i];
        result = std::max(result, scaled_norm(back) / size);
        // one period can be closed under any load, and the next one is not if that load is another then
        parts.align(before, state);
        result = std::max(result, gap_between(before, state).size);
        parts.align(map.states().front(), map.states().back());
      }
    return result;
  }



  void
  SectionMap::follow(const Eigen::VectorXcd                                                       &shape,
                     const std::complex<double>                                                    value,
                     const std::function<void(unsigned int i, const Eigen::VectorXcd &increment)> &f)
  {
    const unsigned int            n = map.settings.n_steps;
    std::vector<Eigen::VectorXcd> images;
    Eigen::VectorXd               re = shape.real(), im = shape.imag();
    const bool                    is_real = im.isZero(0.);
    for (unsigned int i = 0; i < n; ++i)
      {
        images.push_back(re.cast<std::complex<double>>() + std::complex<double>(0, 1) * im);
        map.apply_step(re.data(), i);
        if (!is_real)
          map.apply_step(im.data(), i);
      }
    // behind the section: Φ(s) P⁻¹ S v = σ P⁻¹ Φ(s) v
    for (unsigned int part = 0; part < parts.n(); ++part)
      {
        for (unsigned int i = 0; i < n; ++i)
          f(part * n + i, images[i]);
        for (auto &image : images)
          {
            re = image.real();
            im = image.imag();
            parts.apply_inverse(re.data());
            parts.apply_inverse(im.data());
            image = value * (re.cast<std::complex<double>>() + std::complex<double>(0, 1) * im);
          }
      }
  }



  Eigen::MatrixXd
  SectionMap::basis()
  {
    return basis_at(map.states().front());
  }



  Eigen::MatrixXd
  SectionMap::basis_at(const State &start)
  {
    const Layout       &layout      = system.layout;
    const unsigned int  n_positions = layout.of_multiplier(0), n_velocities = layout.n_kinematic();
    SparseMatrix        K(layout.pattern);
    std::vector<double> no_multipliers(layout.n_multipliers, 0.);
    Point<double>       point = start.point();
    point.held                = false;
    point.multipliers         = no_multipliers.data();
    system.add_constraint_tangent(point, K);
    Eigen::MatrixXd G = Eigen::MatrixXd::Zero(layout.n_multipliers, n_positions);
    for (unsigned int j = 0; j < n_positions; ++j)
      for (int k = K.pattern->column_start[j]; k < K.pattern->column_start[j + 1]; ++k)
        if (const int i = K.pattern->rows[k] - int(n_positions); i >= 0)
          G(i, j) = K.values[k] * scale[j];
    for (unsigned int i = 0; i < layout.n_multipliers; ++i)
      if (const double norm = G.row(i).norm(); norm > 0)
        G.row(i) /= norm;

    const auto kernel = [](const Eigen::MatrixXd &A) {
      // rows have length one: a pivot below is a row that the others imply
      const PivotedQr qr(A.transpose(), 1e-10);
      return Eigen::MatrixXd(qr.Q().rightCols(A.cols() - qr.rank()));
    };
    Eigen::MatrixXd of_positions   = Eigen::MatrixXd::Zero(G.rows() + kept.size(), n_positions);
    of_positions.topRows(G.rows()) = G;
    for (const auto i : layout.nonholonomic)
      of_positions.row(i).setZero();
    for (unsigned int i = 0; i < kept.size(); ++i)
      of_positions(G.rows() + i, kept[i]) = 1;
    const Eigen::MatrixXd positions = kernel(of_positions), velocities = kernel(G.leftCols(n_velocities));
    Eigen::MatrixXd       result = Eigen::MatrixXd::Zero(map.size(), positions.cols() + velocities.cols());
    for (int j = 0; j < positions.cols(); ++j)
      {
        std::vector<double> x(map.size(), 0.);
        for (unsigned int i = 0; i < n_positions; ++i)
          x[i] = positions(i, j) * scale[i];
        map.project_increment(start, x.data());
        for (unsigned int i = 0; i < x.size(); ++i)
          result(i, j) = x[i] / scale[i];
      }
    result.bottomRightCorner(n_velocities, velocities.cols()) = velocities;
    return orthonormal_columns(result);
  }
} // namespace samara
