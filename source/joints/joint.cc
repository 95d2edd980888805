#include <samara/joints/joint.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    Vector12
    gradient(const PairFunction &function, const PairValues<double> &pair)
    {
      Vector12 g = Vector12::Zero();
      function.add_gradient(pair, 1., g);
      return g;
    }
  } // namespace



  void
  Joint::connect(Layout &layout)
  {
    frame_a = layout.model.resolved(frame_a);
    frame_b = layout.model.resolved(frame_b);
    if (!check_ends(*model, *this, frame_a, frame_b, "<" + body_a + "> and <" + body_b + ">"))
      return;
    rows.clear();
    used.clear();
    stops.clear();
    for (const auto &l : locked)
      rows.push_back("joint " + name + ", " + l.name);
    std::vector<unsigned int> coordinates;
    for (auto &motion : free)
      if (motion.coordinate >= 0)
        {
          used.push_back(&motion);
          coordinates.push_back(motion.coordinate);
          rows.push_back("joint " + name + ", measure of the " + motion.name);
        }
    for (const auto *motion : used)
      if (motion->is_prescribed)
        rows.push_back("joint " + name + ", prescribed " + motion->name);
    if (is_screw)
      rows.push_back("joint " + name + ", pitch");
    for (const auto &s : no_slip)
      rows.push_back("joint " + name + ", " + s.name);
    for (unsigned int i = 0; i < used.size(); ++i)
      {
        if (used[i]->has_lower_stop)
          stops.push_back({i, used[i]->lower_stop, -1.});
        if (used[i]->has_upper_stop)
          stops.push_back({i, used[i]->upper_stop, 1.});
      }
    for (const Stop &s : stops)
      {
        const FreeMotion &m = *used[s.motion];
        layout.stops.push_back({static_cast<unsigned int>(m.coordinate),
                                s.place,
                                s.side,
                                m.stop_stiffness,
                                m.stop_damping,
                                "joint " + name + (s.side > 0 ? ", upper" : ", lower") + " stop of the " + m.name});
      }

    first_multiplier = layout.add_multipliers(rows);
    first_row        = layout.of_multiplier(first_multiplier);
    std::vector<unsigned int> multipliers(rows.size());
    for (unsigned int i = 0; i < rows.size(); ++i)
      multipliers[i] = first_multiplier + i;
    with_axes_of_b = !no_slip.empty() || std::any_of(used.begin(), used.end(), [](auto *m) { return m->is_angle(); }) ||
                     std::any_of(locked.begin(), locked.end(), [](const Locked &l) {
                       return l.function.kind == PairFunction::cosine;
                     });
    // derivatives are in the twists of the nodes themselves
    layout.couple(block, {{frame_a.node}, {frame_b.node}}, coordinates, multipliers);
    unsigned int row = first_multiplier + locked.size() + used.size();
    for (const auto *motion : used)
      if (motion->is_prescribed)
        model->prescribed[motion->coordinate] = row++;
    for (unsigned int i = 0; i < used.size(); ++i)
      if (used[i]->is_angle())
        {
          const unsigned int multiplier = first_multiplier + locked.size() + i;
          layout.angles.push_back(multiplier);
          if (!used[i]->is_prescribed)
            layout.corrections.push_back({multiplier, static_cast<unsigned int>(used[i]->coordinate)});
        }
    for (unsigned int i = rows.size() - no_slip.size(); i < rows.size(); ++i)
      layout.nonholonomic.push_back(multipliers[i]);
  }



  double
  Joint::next_corner(const double from, const double to) const
  {
    double corner = std::numeric_limits<double>::infinity();
    for (const auto *m : used)
      corner = std::min({corner, m->force.next_corner(from, to), m->prescribed.next_corner(from, to)});
    return corner;
  }



  template <bool with_forces, typename Number>
  void
  Joint::evaluate(const Point<Number> &point, Number *r) const
  {
    const PairValues<Number> pair(frame_a, frame_b, point.q, with_axes_of_b);
    PairForces<Number>       forces;
    const Number *const lambda = point.multipliers + first_multiplier, *const stress = point.stress + first_strain;
    Number *const g   = r + first_row;
    unsigned int  row = 0;

    for (const auto &l : locked)
      {
        g[row] += l.function.value(pair) - l.value;
        if constexpr (with_forces)
          if (lambda[row] != Number(0)) // most of a joint's rows may be left out
            forces.add(l.function, pair, lambda[row]);
        ++row;
      }
    for (unsigned int i = 0; i < used.size(); ++i, ++row)
      {
        const FreeMotion &m          = *used[i];
        const Number     &coordinate = point.coordinates[m.coordinate];
        g[row] += m.measure(pair, coordinate);
        if constexpr (with_forces)
          {
            const auto of = m.derivatives(pair, coordinate);
            r[block.row(12 + i)] += stress[i] - point.factor * m.force(point.time) + lambda[row] * of.slope;
            forces.add(m.first, pair, lambda[row] * of.first);
            if (m.is_angle())
              forces.add(m.second, pair, lambda[row] * of.second);
          }
      }
    for (unsigned int i = 0; i < used.size(); ++i)
      if (used[i]->is_prescribed)
        {
          const FreeMotion &m = *used[i];
          g[row] += point.coordinates[m.coordinate] + m.reference - point.factor * m.prescribed(point.time);
          if constexpr (with_forces)
            r[block.row(12 + i)] += lambda[row];
          ++row;
        }
    if (is_screw)
      {
        g[row] += point.coordinates[used[0]->coordinate] - pitch * point.coordinates[used[1]->coordinate];
        if constexpr (with_forces)
          {
            r[block.row(12)] += lambda[row];
            r[block.row(13)] -= pitch * lambda[row];
          }
        ++row;
      }
    if constexpr (with_forces)
      {
        // a damper that would pull is cut
        for (unsigned int i = 0; i < stops.size(); ++i)
          if (stops[i].side * std::real(stress[used.size() + i]) > 0)
            r[block.row(12 + stops[i].motion)] += touches(point, i) * stress[used.size() + i];
        add_no_slip_forces(pair, lambda + row, r);
        forces.add_to_nodes(pair, r + block.row(0), r + block.row(6));
      }
  }



  template <typename Number>
  void
  Joint::add_no_slip_forces(const PairValues<Number> &pair, const Number *lambda, Number *r) const
  {
    if (no_slip.empty())
      return;
    using Twists = Eigen::Matrix<Number, 12, 1>;
    Twists force = Twists::Zero();
    for (const auto &s : no_slip)
      s.velocity.add_coefficients(pair, *lambda++, force);
    Eigen::Map<Vec6<Number>>(r + block.row(0)) += force.template head<6>();
    Eigen::Map<Vec6<Number>>(r + block.row(6)) += force.template tail<6>();
  }



  template <typename Number>
  void
  Joint::residual_at(const Point<Number> &point, Number *r) const
  {
    evaluate<true>(point, r);
  }



  void
  Joint::constraints(const Point<double> &point, double *r) const
  {
    evaluate<false>(point, r);
  }



  void
  Joint::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    const PairValues<double> pair(frame_a, frame_b, point.q, with_axes_of_b);
    PairTangent              twists(pair);
    Matrix12                 H      = Matrix12::Zero();
    const double            *lambda = point.multipliers + first_multiplier;
    const bool   has_forces         = std::any_of(lambda, lambda + rows.size(), [](const double l) { return l != 0.; });
    unsigned int row                = 12 + used.size();
    const auto   add_symmetric      = [&](const unsigned int i, const unsigned int j, const double value) {
      block.add_entry(i, j, value, K);
      block.add_entry(j, i, value, K);
    };

    for (const auto &l : locked)
      {
        twists.add(l.function, *lambda++);
        block.add_border(row++, gradient(l.function, pair), K);
      }
    for (unsigned int i = 12; i < 12 + used.size(); ++i, ++lambda, ++row)
      {
        const FreeMotion &m     = *used[i - 12];
        const auto        of    = m.derivatives(pair, point.coordinates[m.coordinate]);
        const Vector12    first = gradient(m.first, pair);
        Vector12          g     = of.first * first;
        block.add_entry(i, i, (point.material ? m.spring : 0.) + *lambda * of.curvature, K);
        add_symmetric(i, row, of.slope);
        twists.add(m.first, *lambda * of.first);
        if (m.is_angle())
          {
            const Vector12 second = gradient(m.second, pair);
            g += of.second * second;
            twists.add(m.second, *lambda * of.second);
            H += first * (*lambda * (of.first_first * first + of.first_second * second)).transpose() +
                 second * (*lambda * (of.first_second * first + of.second_second * second)).transpose();
          }
        block.add_border(row, g, K);
      }
    for (unsigned int i = 0; i < used.size(); ++i)
      if (used[i]->is_prescribed)
        {
          add_symmetric(12 + i, row++, 1.);
          ++lambda;
        }
    if (is_screw)
      {
        add_symmetric(12, row, 1.);
        add_symmetric(13, row++, -pitch);
        ++lambda;
      }
    for (const auto &s : no_slip)
      {
        Vector12 coefficients = Vector12::Zero();
        s.velocity.add_coefficients(pair, 1., coefficients);
        s.velocity.add_derivative(pair, *lambda++, H);
        block.add_border(row++, coefficients, K);
      }
    for (unsigned int i = 0; i < stops.size() && point.material; ++i)
      {
        const unsigned int k = 12 + stops[i].motion;
        block.add_entry(k, k, touches(point, i) * used[stops[i].motion]->stop_stiffness, K);
      }
    // without forces the constraints alone are wanted
    if (!has_forces)
      return;
    twists.add_to(H);
    block.add_twists(H, K);
  }



  void
  Joint::constraint_rates(const Point<double> &point, double *rates) const
  {
    const PairValues<double> pair(frame_a, frame_b, point.q, with_axes_of_b);
    const PairRates          change(pair, point.y);
    double                  *g = rates + first_multiplier;
    for (const auto &l : locked)
      *g++ = l.function.rate(pair, change);
    for (const auto *m : used)
      {
        const auto of = m->derivatives(pair, point.coordinates[m->coordinate]);
        *g            = of.slope * point.rates[m->coordinate] + of.first * m->first.rate(pair, change);
        if (m->is_angle())
          *g += of.second * m->second.rate(pair, change);
        ++g;
      }
    for (const auto *m : used)
      if (m->is_prescribed)
        *g++ = point.rates[m->coordinate] - point.factor * m->prescribed.derivative(point.time);
    if (is_screw)
      *g++ = point.rates[used[0]->coordinate] - pitch * point.rates[used[1]->coordinate];
    for (const auto &s : no_slip)
      {
        Vector12 b = Vector12::Zero();
        s.velocity.add_coefficients(pair, 1., b);
        *g++ = b.head<6>().dot(Eigen::Map<const Vector6>(point.y + 6 * frame_a.node)) +
               b.tail<6>().dot(Eigen::Map<const Vector6>(point.y + 6 * frame_b.node));
      }
  }



  void
  Joint::constraint_time_rates(const Point<double> &point, double *rates) const
  {
    unsigned int row = first_multiplier + locked.size() + used.size();
    for (const auto *m : used)
      if (m->is_prescribed)
        rates[row++] = -point.factor * m->prescribed.derivative(point.time);
  }



  void
  Joint::follow_angles(State &state) const
  {
    if (std::none_of(used.begin(), used.end(), [](const FreeMotion *m) { return m->is_angle(); }))
      return;
    const PairValues<double> pair(frame_a, frame_b, state.q.data());
    for (const auto *m : used)
      if (m->is_angle())
        {
          double &angle = state.coordinates[m->coordinate];
          angle         = in_turn_of(m->angle(pair), angle);
        }
  }



  bool
  Joint::has_loads() const
  {
    return std::any_of(used.begin(), used.end(), [](const FreeMotion *m) { return !m->force.is_zero(); });
  }



  template class Evaluated<Joint>;
  template void Joint::residual_at(const Point<double> &, double *) const;
  template void Joint::residual_at(const Point<std::complex<double>> &, std::complex<double> *) const;
} // namespace samara
