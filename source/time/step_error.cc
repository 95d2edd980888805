#include <samara/time/step_error.h>

#include <samara/rotation/matrix6.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace samara
{
  namespace
  {
    /**
     * How often vibration that is nearly resolved may be set free in a run, measured: with 5 a spin-up was 80 times its
     * tolerance off, without a bound steps stayed as short as its waves.
     */
    constexpr double excitations = 30;

    /** Of what a node carries, about the node [m]. */
    double
    radius_of_gyration(const Matrix6 &inertia)
    {
      const double mass = inertia(0, 0);
      if (!(mass > 0))
        return 0;
      return std::sqrt(symmetric_eigenvalues3(inertia.bottomRightCorner<3, 3>())(2) /
                       mass);
    }
    /** Lowest and highest coordinates of all nodes but the ground. */
    std::pair<Vector3, Vector3>
    box_of(const Model &model)
    {
      Vector3 low = model.nodes.back().x, high = low;
      for (unsigned int node = 1; node < model.nodes.size(); ++node)
        {
          low  = low.cwiseMin(model.nodes[node].x);
          high = high.cwiseMax(model.nodes[node].x);
        }
      return {low, high};
    }

    /** Of each node to the nearest other one that is elsewhere, the ground's apart; infinite if there is none [m]. */
    std::vector<double>
    distances_to_next(const Model &model)
    {
      // in the order along the longest side, no farther than the nearest so far
      const auto   box  = box_of(model);
      const double same = 1e-9 * StepError::length_of(model);
      int          axis = 0;
      (box.second - box.first).maxCoeff(&axis);
      std::vector<unsigned int> order(model.nodes.size() - 1);
      std::iota(order.begin(), order.end(), 1);
      std::sort(order.begin(), order.end(), [&](const unsigned int a, const unsigned int b) {
        return model.nodes[a].x(axis) < model.nodes[b].x(axis);
      });
      std::vector<double> distance(model.nodes.size(), std::numeric_limits<double>::infinity());
      const int           n = order.size();
      for (int i = 0; i < n; ++i)
        for (const int direction : {-1, 1})
          for (int j = i + direction; j >= 0 && j < n; j += direction)
            {
              double       &nearest = distance[order[i]];
              const Vector3 d       = model.nodes[order[j]].x - model.nodes[order[i]].x;
              if (std::abs(d(axis)) > nearest)
                break;
              if (d.norm() > same)
                nearest = std::min(nearest, d.norm());
            }
      return distance;
    }
  } // namespace



  double
  StepError::length_of(const Model &model)
  {
    const auto [low, high] = box_of(model);
    if (const double extension = (high - low).norm(); extension > 0)
      return extension;
    const double distance = (high - model.nodes[0].x).norm();
    return distance > 0 ? distance : 1.;
  }



  StepError::StepError(const System &system, const Tableau &tableau)
    : of_states(system, tableau)
    , system(system)
    , tableau(tableau)
    , relation(tableau)
  {
    for (const auto &node : system.model.nodes)
      radius.push_back(radius_of_gyration(node.inertia));
    const std::vector<double> distance = distances_to_next(system.model);
    for (unsigned int node = 1; node < radius.size(); ++node)
      radius[node] = std::min(radius[node], 0.5 * distance[node]);
  }



  double
  StepError::size(const std::vector<double> &displacement) const
  {
    double square = 0;
    for (unsigned int node = 1; node < radius.size() && 6 * node <= displacement.size(); ++node)
      {
        const Eigen::Map<const Vector3> x(&displacement[6 * node - 6]), angle(&displacement[6 * node - 3]);
        square = std::max(square, x.squaredNorm() + std::pow(radius[node], 2) * angle.squaredNorm());
      }
    return std::sqrt(square);
  }



  double
  StepError::largest_displacement(const State &state) const
  {
    double largest = 0;
    for (unsigned int node = 1; node < radius.size(); ++node)
      largest = std::max(largest, (state.position(node) - system.model.nodes[node].x).norm());
    return largest;
  }



  double
  StepError::rotation(const State &end, const std::vector<double> &driven, const double h) const
  {
    std::vector<Vector3> drives(1, Vector3::Zero());
    for (unsigned int node = 1; node < radius.size() && 6 * node < driven.size(); ++node)
      if (const Eigen::Map<const Vector3> spin(&driven[6 * node + 3]); spin.norm() > 0)
        drives.push_back(end.triad(node) * spin);
    const unsigned int order   = 2 * tableau.s + 1;
    const double       factor  = relation.leading() / (4 * order);
    double             largest = 0;
    for (unsigned int node = 1; node < radius.size(); ++node)
      {
        const Eigen::Map<const Vector3> v(&end.y[6 * node]), spin(&end.y[6 * node + 3]);
        const double                    turning = spin.norm();
        if (!(turning > 0))
          continue;
        const Vector3 inertial = end.triad(node) * spin;
        double        rate     = turning;
        for (const Vector3 &drive : drives)
          rate = std::min(rate, (inertial - drive).norm());
        largest = std::max(largest, factor * std::pow(h * rate, order) * std::max(radius[node], v.norm() / turning));
      }
    return largest;
  }



  double
  StepError::advance(const Scale &from, const StepDifference::Field &field, const double h, Scale &to) const
  {
    const double power = std::pow(h, 2 * tableau.s);
    to                 = from;
    to.step            = h;
    to.last            = field.rate;
    for (double &d : to.last)
      d /= power;
    const double q = size(field.displacement) / power, v = size(to.last);
    double       a = v / h;
    if (!from.last.empty())
      {
        std::vector<double> change = to.last;
        for (unsigned int i = 0; i < change.size(); ++i)
          change[i] = (change[i] - from.last[i]) / (0.5 * (h + from.step));
        a = size(change);
      }
    const double keep = from.tau > 0 ? std::exp(-h / (2 * from.tau)) : 0.;
    to.weight         = keep * from.weight + h;
    to.q_squares      = keep * from.q_squares + h * q * q;
    to.v_squares      = keep * from.v_squares + h * v * v;
    to.a_squares      = keep * from.a_squares + h * a * a;
    const auto scale  = [&](const double over, const double under) {
      return std::clamp(under > 0 ? std::sqrt(over / under) : 1e6 * h, h / 30, 1e6 * h);
    };
    // displacements say it of what strains, rates of what only gravity or inertia brings back
    const double of_q = scale(to.q_squares, to.v_squares), of_v = scale(to.v_squares, to.a_squares);
    to.tau = std::max(of_q, std::min(of_v, scale(1, std::pow(field.frequency, 2))));
    // where the error of a motion passes through zero, the rest of its oscillation counts
    const double q_square = std::max(q * q, to.q_squares / to.weight),
                 v_square = std::max(v * v, to.v_squares / to.weight);
    to.amplitude = 2 * power * std::sqrt(q_square + of_q * of_q * v_square) / relation.value(std::pow(h / of_q, 2));
    return power * std::sqrt((std::pow(tableau.alpha, 2) + std::pow(relation.phase() * h / to.tau, 2)) *
                             (q_square + to.tau * to.tau * v_square));
  }



  double
  StepError::of_step(const State &end, const StepDifference &difference, const double h, const double duration)
  {
    double error         = advance(all, difference.neighbour, h, next_all);
    next_resolved        = resolved;
    next_resolved_at_end = resolved_at_end;
    const auto of_part   = [&](const Scale &from, const StepDifference::Field &field, Scale &to) {
      if (field.rate.empty())
        return 0.;
      const double part = advance(from, field, h, to);
      return std::min(part, 2 * excitations * to.amplitude * h / duration);
    };
    if (!difference.resolved.rate.empty())
      error = std::max({std::min(error, 2 * next_all.amplitude * h / duration),
                        of_part(resolved, difference.resolved, next_resolved),
                        of_part(resolved_at_end, difference.resolved_at_end, next_resolved_at_end)});
    if (!difference.load.empty())
      error += std::max(size(difference.load), next_all.tau * size(difference.load_rate));
    return error + rotation(end, difference.driven, h);
  }



  double
  StepError::shift(const State          &end,
                   const StepDifference &difference,
                   const double          dissipated,
                   const double          energy,
                   const double          remaining) const
  {
    if (system.layout.n_strains > 0 || !(dissipated > 0) || !(energy > 0))
      return 0;
    double kinetic = 0, change = 0, speed = 0;
    for (unsigned int node = 1; node < radius.size(); ++node)
      {
        const Matrix6                  &M = system.model.nodes[node].inertia;
        const Eigen::Map<const Vector6> y(&end.y[6 * node]), v(&difference.neighbour.rate[6 * node - 6]);
        kinetic += y.dot(M * y);
        change += v.dot(M * v);
        speed = std::max(speed, y.head<3>().norm());
      }
    return speed * remaining * std::min(dissipated, tableau.alpha * std::sqrt(kinetic * change)) / (4 * energy);
  }



  void
  StepError::accept()
  {
    std::swap(all, next_all);
    std::swap(resolved, next_resolved);
    std::swap(resolved_at_end, next_resolved_at_end);
    of_states.accept();
  }



  std::vector<double>
  StepError::memory() const
  {
    std::vector<double> values;
    for (const Scale *const scale : {&all, &resolved, &resolved_at_end})
      {
        for (const double value :
             {scale->step, scale->weight, scale->q_squares, scale->v_squares, scale->a_squares, scale->tau})
          values.push_back(value);
        values.push_back(scale->last.size());
        values.insert(values.end(), scale->last.begin(), scale->last.end());
      }
    const std::vector<double> states = of_states.memory();
    values.insert(values.end(), states.begin(), states.end());
    return values;
  }



  void
  StepError::set_memory(const std::vector<double> &memory)
  {
    auto next = memory.begin();
    for (Scale *const scale : {&all, &resolved, &resolved_at_end})
      {
        for (double *const value :
             {&scale->step, &scale->weight, &scale->q_squares, &scale->v_squares, &scale->a_squares, &scale->tau})
          *value = *next++;
        const auto size = static_cast<std::ptrdiff_t>(*next++);
        scale->last.assign(next, next + size);
        next += size;
      }
    of_states.set_memory(next);
  }
} // namespace samara
