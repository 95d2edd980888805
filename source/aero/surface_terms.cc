// Loads of a surface, and the rates of its states; their derivatives stand in surface_derivatives.cc.

#include <samara/aero/surface.h>

#include <algorithm>
#include <type_traits>
#include <utility>

namespace samara
{
  template <typename Number>
  void
  Surface::gather(const Element &element, const Point<Number> &point, Gathered<Number> &g) const
  {
    g.frames.gather(element.frames, point);
    g.rates.clear();
    for (unsigned int a = 0; a < g.frames.D.size(); ++a)
      g.rates.emplace_back(g.frames.D[a], g.frames.y[a]);
    if (inflow != nullptr)
      {
        g.frames.add(inflow->hub, point);
        // distances from the hub are those of the bodies, which turn as their axes do
        if (point.reciprocal != nullptr)
          for (unsigned int a = 0; a < element.frames.size(); ++a)
            {
              const Vec3<Number> from_hub = g.frames.x[a] - g.frames.x.back();
              g.frames.x[a] =
                g.frames.x.back() +
                g.frames.D[a] * Vec3<Number>(element.frames[a].triad(point.reciprocal).transpose() * from_hub);
            }
      }
    g.lags.clear();
    for (const unsigned int i : element.lags)
      g.lags.push_back(point.states[i]);
    if (!air->varies_in_space())
      g.wind = air->wind(Vec3<Number>(Vec3<Number>::Zero()), point.time);
    g.near   = Number(1);
    g.others = Number(0);
    g.amplitudes.clear();
    if (inflow == nullptr)
      return;
    g.radius = inflow->radius_at(point.time);
    g.amplitudes.resize(inflow->n_amplitudes());
    inflow->amplitudes(point, g.amplitudes.data());
    g.others = inflow->from_neighbours(point);
    if (inflow->corrections.any())
      g.disk = inflow->flow_through_disk(
        g.frames.x.back(), g.frames.D.back(), g.frames.y.back(), g.amplitudes.data(), g.others, point.time);
    if (inflow->corrections.has_ground)
      g.near = inflow->corrections.ground_factor(g.disk, g.radius);
  }



  template <typename Number>
  Number
  Surface::carried_round(const Gathered<Number> &g, const AtStation<Number> &at, const Vec3<Number> &place) const
  {
    const Mat3<Number> &H     = g.frames.D.back();
    const Vec3<Number>  round = cross(at.thrust_axis, Vec3<Number>(place - g.frames.x.back())),
                       v      = at.air - at.relative - H * g.frames.y.back().template head<3>();
    return dot(round, v) / (dot(round, round) + square_near_axis(g.radius)) * dot(at.thrust_axis, at.axes.e1);
  }



  /** The couple of a section that turns: see the comment of the class. */
  template <typename Number>
  void
  Surface::add_pitching(const Station              &station,
                        const Gathered<Number>     &g,
                        const AlongElement<Number> &along,
                        AtStation<Number>          &at) const
  {
    const Number turning = dot(at.axes.e1, at.spin);
    at.pitching          = has_virtual_mass ? turning : Number(2. * turning);
    if (!has_virtual_mass && inflow != nullptr)
      at.pitching -= carried_round(g, at, Vec3<Number>(along.x + along.F * station.three_quarters));
    // it damps from wherever the air comes
    const Number speed = std::real(at.V(1)) > 0 ? at.V(1) : Number(-at.V(1));
    at.moment -= station.pitch_damping * speed * at.pitching * at.axes.e1;
  }



  template <typename Number>
  Surface::AtStation<Number>
  Surface::evaluate(const Station &station, const Gathered<Number> &g, const double time, Number *const shapes) const
  {
    const AlongElement<Number> along(station.N, g.frames, g.rates);
    AtStation<Number>          at(station, along);
    at.place = along.x + along.F * station.quarter;
    // where the velocity of the section counts, that of the air does
    Vec3<Number> wind =
      air->varies_in_space() ? air->wind(Vec3<Number>(along.x + along.F * station.three_quarters), time) : g.wind;
    if (inflow != nullptr)
      {
        // as seen from the hub, whose frame is the last one
        const Mat3<Number> &H = g.frames.D.back();
        at.on_disk            = H.transpose() * (at.place - g.frames.x.back());
        at.thrust_axis        = H.col(2);
        if (annular != nullptr)
          {
            at.free    = H.transpose() * (wind - H * g.frames.y.back().template head<3>());
            at.added   = annular->within(g.radius).induced(in_annulus(station, g, at));
            at.induced = -at.added(2);
            wind += H * at.added;
          }
        at.shapes = shapes;
        if (external != nullptr)
          {
            at.added   = external->velocity(at.on_disk, g.disk, g.amplitudes.data());
            at.induced = -at.added(2);
            wind += H * at.added;
            external->drives(at.on_disk, g.disk, shapes);
          }
        inflow->disk.evaluate(Number(at.on_disk(0) / g.radius), Number(at.on_disk(1) / g.radius), shapes);
        Number sum(0);
        for (unsigned int k = 0; k < inflow->disk.shapes.size(); ++k)
          sum += g.amplitudes[k] * shapes[k];
        at.induced += g.near * sum + g.others;
        if (annular == nullptr && external == nullptr)
          wind -= at.induced * at.thrust_axis;
      }
    at.air  = wind;
    at.spin = along.spin;
    if (inflow != nullptr && inflow->corrections.has_tip_loss)
      at.kept = inflow->corrections.tip_factor(
        at.on_disk(0), at.on_disk(1), Number(g.disk(2) + g.disk(3)), dot(at.spin, at.thrust_axis), g.radius);
    at.relative             = at.air - (along.v + along.W * station.three_quarters);
    at.V                    = at.axes.components(at.relative);
    const Number *const lag = g.lags.data() + station.first_lag;
    at.upwash = station.unsteady == Unsteady::quasi_steady ? at.V(2) : lags::effective_upwash(at.V(2), lag);
    if (station.unsteady == Unsteady::dynamic_stall)
      at.separated = lag[3];
    const Vec3<Number> w = at.axes.components(at.spin);
    at.turning           = 0.5 * station.section.chord * w(0);
    at.flow              = section_flow(station.section, *air, at.V, at.upwash, at.separated, at.kept, at.turning);
    const auto &l        = at.flow.loads;
    at.force             = l(0) * at.axes.e1 + l(1) * at.axes.e2 + l(2) * at.axes.e3;
    at.moment            = l(3) * at.axes.e1;
    // (ω × e₃)·u = Ω₂ u₁ − Ω₁ u₂
    const Vec3<Number> u = at.axes.components(at.air);
    const double       m = station.virtual_mass;
    at.middle_force      = m * (w(1) * u(0) - w(0) * u(1)) * at.axes.e3;
    add_pitching(station, g, along, at);
    return at;
  }



  namespace
  {
    /** Dᵀ f */
    template <typename Number>
    Vec3<Number>
    seen(const Mat3<Number> &D, const Vec3<Number> &f)
    {
      return D.transpose() * f;
    }
  } // namespace



  namespace
  {
    /** Number by number; what is not a number is equal to nothing. */
    template <typename Vectors>
    bool
    are_equal(const Vectors &a, const Vectors &b)
    {
      if (a.size() != b.size())
        return false;
      for (unsigned int i = 0; i < a.size(); ++i)
        if (!(a[i] == b[i]))
          return false;
      return true;
    }
  } // namespace



  template <typename Number>
  Surface::AtElement<Number> &
  Surface::at_element(const Element &element, const Point<Number> &point) const
  {
    thread_local Gathered<Number> g;
    gather(element, point, g);
    constexpr bool is_real = std::is_same_v<Number, double>;
    const auto     kept    = [&]() -> AtElement<Number>        &{
      thread_local AtElement<Number> other;
      if constexpr (is_real)
        return element.last;
      else
        return other;
    };
    AtElement<Number> &at = kept();
    if (is_real && at.stations.size() == element.stations.size() && at.time == point.time &&
        at.factor == point.factor && are_equal(at.g.frames.x, g.frames.x) && are_equal(at.g.frames.D, g.frames.D) &&
        are_equal(at.g.frames.y, g.frames.y) && are_equal(at.g.lags, g.lags) &&
        are_equal(at.g.amplitudes, g.amplitudes) && at.g.others == g.others)
      return at;
    std::swap(at.g, g);
    at.time   = point.time;
    at.factor = point.factor;
    at.K.resize(0, 0);
    at.C.resize(0, 0);
    const unsigned int n = at.g.amplitudes.size();
    at.shapes.resize(n * element.stations.size());
    at.stations.clear();
    for (unsigned int i = 0; i < element.stations.size(); ++i)
      at.stations.push_back(evaluate(element.stations[i], at.g, point.time, at.shapes.data() + i * n));
    return at;
  }



  template <typename Number>
  void
  Surface::add_rates(const Station           &station,
                     const Gathered<Number>  &g,
                     const AtStation<Number> &at,
                     Rows<Number>            &local) const
  {
    const unsigned int first_lag = 6 * g.frames.D.size(), first_inflow = first_lag + g.lags.size();
    const Number       U = lags::speed(at.V, *air), speed = 2 / station.section.chord * U,
                 speed_of_lags = 2 / station.section.chord * lags::speed_of_lags(U, *air, compressible_lags);
    for (unsigned int i = 0; i < lags::n && station.unsteady != Unsteady::quasi_steady; ++i)
      {
        const unsigned int k = station.first_lag + i;
        local(first_lag + k) -= lags::b[i] * speed_of_lags * (at.V(2) - g.lags[k]);
      }
    if (station.unsteady == Unsteady::dynamic_stall)
      {
        const unsigned int k     = station.first_lag + lags::n;
        const Number       angle = g.lags[k], lack = lags::angle_between(angle, at.flow.alpha);
        const auto         v = station.section.separation->at(std::real(angle));
        const Number       f = internal::continued(v.place, v.place_alpha, 0., angle, Number(0));
        local(first_lag + k) -= speed / separation_lags.pressure * lack;
        local(first_lag + k + 1) -= speed / separation_lags.boundary_layer * (f - g.lags[k + 1]);
      }
    if (annular != nullptr)
      {
        const Mat3<Number> &H    = g.frames.D.back();
        const auto          rate = annular->within(g.radius).rates(in_annulus(station, g, at),
                                                          Vec3<Number>(H.transpose() * at.relative),
                                                          Vec3<Number>(H.transpose() * at.force),
                                                          station.width);
        for (unsigned int i = 0; i < AnnularMomentum::n_states; ++i)
          local(first_lag + station.first_flow + i) -= rate[i];
      }
    if (inflow == nullptr || inflow->states.empty())
      return;
    const Number thrust = inflow->factor_of_loads(g.radius) * station.weight * dot(at.force, at.thrust_axis);
    for (unsigned int k = 0; k < inflow->load_weights.size(); ++k)
      local(first_inflow + k) -= inflow->load_weights[k] * thrust * at.shapes[k];
  }



  template <typename Number>
  void
  Surface::Loads::residual_at(const Point<Number> &point, Number *r) const
  {
    thread_local Rows<Number> local;
    for (const auto &element : surface->elements)
      {
        const auto &all = surface->at_element(element, point);
        local.setZero(element.block.size());
        for (unsigned int i = 0; i < element.stations.size(); ++i)
          {
            const Station &station = element.stations[i];
            const auto    &at      = all.stations[i];
            const double   weight  = -point.factor * station.weight;
            for (unsigned int a = 0; a < station.N.size(); ++a)
              {
                const Mat3<Number> &D = all.g.frames.D[a];
                const Vec3<Number>  f = seen(D, at.force), m = seen(D, at.moment), h = seen(D, at.middle_force);
                local.template segment<3>(6 * a) += weight * station.N[a] * (f + h);
                local.template segment<3>(6 * a + 3) +=
                  weight * station.N[a] * (cross(station.quarter, f) + cross(station.middle(), h) + m);
              }
          }
        // what the equations of motion would say of the mass of the air beyond M ẏ
        for (unsigned int a = 0; a < element.virtual_mass.size(); ++a)
          local.template segment<6>(6 * a) +=
            ad_star<Number>(all.g.frames.y[a], element.virtual_mass[a] * all.g.frames.y[a]);
        element.block.add(local, r);
      }
  }



  template <typename Number>
  void
  Surface::Rates::residual_at(const Point<Number> &point, Number *r) const
  {
    thread_local Rows<Number> local;
    for (const auto &element : surface->elements)
      {
        const auto &all = surface->at_element(element, point);
        local.setZero(element.block.size());
        for (unsigned int i = 0; i < element.stations.size(); ++i)
          surface->add_rates(element.stations[i], all.g, all.stations[i], local);
        element.block.add(local, r);
      }
  }



  double
  Surface::Loads::next_corner(const double from, const double to) const
  {
    double corner = surface->air->next_corner(from, to);
    if (surface->inflow == nullptr)
      return corner;
    for (const auto &neighbour : surface->inflow->neighbours)
      corner = std::min(corner, neighbour.inflow->next_corner(from, to));
    return std::min(corner, surface->inflow->next_corner(from, to));
  }



  void
  Surface::Loads::pieces(const Point<double> &point, std::vector<double> &pieces) const
  {
    if (!surface->air->switches_in_place())
      return;
    for (const auto &element : surface->elements)
      {
        FramesInState<double> frames;
        frames.gather(element.frames, point);
        for (const auto &station : element.stations)
          surface->air->pieces(frames.position(station.N, station.three_quarters), point.time, pieces);
      }
  }



  double
  Surface::beyond_stations() const
  {
    double first = panels.back(), last = panels.front();
    for (const auto &element : elements)
      for (const auto &station : element.stations)
        {
          first = std::min(first, station.s);
          last  = std::max(last, station.s);
        }
    return std::max(first - panels.front(), panels.back() - last);
  }



  double
  Surface::reach(const State &state, const Vector3 &centre, const Vector3 &axis) const
  {
    double largest = 0;
    for (const auto &element : elements)
      {
        const auto &all = at_element(element, state.point());
        for (const auto &at : all.stations)
          largest = std::max(largest, (at.place - centre).cross(axis).norm());
      }
    return largest;
  }



  double
  Surface::area() const
  {
    double sum = 0;
    for (const auto &element : elements)
      for (const auto &station : element.stations)
        sum += station.weight * station.section.chord;
    return sum;
  }



  AirLoads
  Surface::air_loads(const State &state, const Vector3 &centre, const Vector3 &carried) const
  {
    return air_loads_at(state.point(), centre, carried);
  }



  AirPower
  Surface::air_power(const Point<double> &point) const
  {
    const AirLoads loads = air_loads_at(point, Vector3::Zero(), Vector3::Zero());
    return {loads.induced, loads.profile};
  }



  AirLoads
  Surface::air_loads_at(const Point<double> &point, const Vector3 &centre, const Vector3 &carried) const
  {
    AirLoads sum;
    for (const auto &element : elements)
      {
        const auto &all = at_element(element, point);
        for (unsigned int i = 0; i < element.stations.size(); ++i)
          {
            const Station &station = element.stations[i];
            const auto    &at      = all.stations[i];
            const auto    &g       = all.g;
            const Vector3  f = station.weight * at.force, m = station.weight * at.moment,
                          h = station.weight * at.middle_force, middle = g.frames.position(station.N, station.middle());
            sum.force += f + h;
            sum.moment += (at.place - centre).cross(f) + (middle - centre).cross(h) + m;
            sum.power += f.dot(g.frames.velocity(station.N, station.quarter) - carried) +
                         h.dot(g.frames.velocity(station.N, station.middle()) - carried) + m.dot(at.spin);
            if (inflow != nullptr)
              sum.induced -= f.dot(annular != nullptr || external != nullptr ? Vector3(g.frames.D.back() * at.added) :
                                                                               Vector3(-at.induced * at.thrust_axis));
            // lift is normal to the flow at the bound vortex, so this is the drag's alone
            const Vector3 flow_at_vortex(at.V(0) + 0.5 * station.section.chord * at.spin.dot(at.axes.e3),
                                         at.V(1),
                                         at.upwash - at.turning);
            sum.profile += station.weight * at.flow.loads.head<3>().dot(flow_at_vortex);
          }
      }
    return sum;
  }



  template class Evaluated<Surface::Loads, Force>;
  template class Evaluated<Surface::Rates, StateEquation>;
  template Surface::AtElement<double> &Surface::at_element(const Element &, const Point<double> &) const;
} // namespace samara
