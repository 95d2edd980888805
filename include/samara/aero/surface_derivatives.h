#ifndef samara_aero_surface_derivatives_h
#define samara_aero_surface_derivatives_h

#include <samara/aero/surface.h>

namespace samara
{
  namespace internal
  {
    /** A number's derivatives by increments of frames, by twists and by states. */
    template <int rows>
    struct Change
    {
      Eigen::Matrix<double, rows, Eigen::Dynamic> place, twist, states;

      Change(const unsigned int n_twists, const unsigned int n_states)
        : place(Eigen::Matrix<double, rows, Eigen::Dynamic>::Zero(rows, n_twists))
        , twist(place)
        , states(Eigen::Matrix<double, rows, Eigen::Dynamic>::Zero(rows, n_states))
      {}

      /** += A other */
      template <int other_rows>
      void
      add(const Eigen::Matrix<double, rows, other_rows> &A, const Change<other_rows> &other)
      {
        place += A * other.place;
        twist += A * other.twist;
        states += A * other.states;
      }
    };
  } // namespace internal



  using internal::Change;

  /** How what is known at a station changes. */
  struct Surface::Derivatives
  {
    template <int rows>
    using Change = internal::Change<rows>;

    Change<3>                                turn;          ///< spatial rotation of the section axes
    Change<3>                                air, spin;     ///< of the air's velocity, of the section's spin; inertial
    Change<3>                                relative, V;   ///< of the relative air, inertial, and in section axes
    Change<3>                                on_disk, axis; ///< in the hub's frame; of the thrust axis
    Change<3>                                free;          ///< of the air without annular inflow, in the hub's axes
    Change<3>                                place;         ///< of the quarter chord
    Change<4>                                loads;
    Change<3>                                force, moment, middle_force;
    Eigen::Matrix<double, Eigen::Dynamic, 3> by_place; ///< of the shapes, by on_disk
    Eigen::Matrix<double, Eigen::Dynamic, 5> by_flow;  ///< the same by the flow through the disk; or nothing

    Derivatives(const unsigned int n_twists, const unsigned int n_states)
      : turn(n_twists, n_states)
      , air(n_twists, n_states)
      , spin(n_twists, n_states)
      , relative(n_twists, n_states)
      , V(n_twists, n_states)
      , on_disk(n_twists, n_states)
      , axis(n_twists, n_states)
      , free(n_twists, n_states)
      , place(n_twists, n_states)
      , loads(n_twists, n_states)
      , force(n_twists, n_states)
      , moment(n_twists, n_states)
      , middle_force(n_twists, n_states)
    {}

    /** Section axes, place and velocity follow the frames of the element. */
    void
    of_frames(const Station &station, const FramesInState<double> &frames, const SectionAxes<double> &axes)
    {
      for (unsigned int a = 0; a < station.N.size(); ++a)
        {
          const Matrix3 ND = station.N[a] * frames.D[a];
          const Vector3 v = frames.y[a].head<3>(), w = frames.y[a].tail<3>(), u = v + w.cross(station.three_quarters);
          for (unsigned int k = 0; k < 3; ++k)
            {
              const unsigned int linear = 6 * a + k, angular = linear + 3;
              const Vector3      e        = Vector3::Unit(k);
              turn.place.col(angular)     = axes.rotation(ND * e.cross(station.along), ND * e.cross(station.chordwise));
              place.place.col(linear)     = ND.col(k);
              place.place.col(angular)    = ND * e.cross(station.quarter);
              relative.place.col(angular) = -ND * e.cross(u);
              relative.twist.col(linear)  = -ND.col(k);
              relative.twist.col(angular) = -ND * e.cross(station.three_quarters);
              spin.place.col(angular)     = ND * e.cross(w);
              spin.twist.col(angular)     = ND.col(k);
            }
        }
    }

    /** The relative air, inertial and in the section's axes @p E. */
    void
    of_flow(const AtStation<double> &at, const Matrix3 &E)
    {
      relative.add<3>(Matrix3::Identity(), air);
      V.add<3>(E.transpose(), relative);
      V.add<3>(E.transpose() * skew(at.relative), turn);
    }

    /** Force and moment, inertial, of the loads in the section's axes @p E. */
    void
    of_forces(const AtStation<double> &at, const Matrix3 &E)
    {
      force.add<4>((Eigen::Matrix<double, 3, 4>() << E, Vector3::Zero()).finished(), loads);
      force.add<3>(-skew(at.force), turn);
      moment.add<4>((Eigen::Matrix<double, 3, 4>() << Matrix3::Zero(), at.axes.e1).finished(), loads);
      moment.add<3>(-skew(at.moment), turn);
    }

    /** Forces and moments on the nodes, N_a D_aᵀ f and N_a (r_¼ × D_aᵀ f + D_aᵀ m), times @p weight. */
    void
    add_node_rows(const Station           &station,
                  const Gathered<double>  &g,
                  const AtStation<double> &at,
                  const double             weight,
                  Eigen::MatrixXd         &K,
                  Eigen::MatrixXd         &C) const
    {
      const unsigned int n_twists = turn.place.cols();
      const Matrix3      arm = skew(station.quarter), middle = skew(station.middle());
      for (unsigned int a = 0; a < station.N.size(); ++a)
        {
          const Matrix3 D = weight * station.N[a] * g.frames.D[a].transpose();
          const Vector3 f = D * at.force, m = D * at.moment, h = D * at.middle_force;
          const auto    add =
            [&](Eigen::MatrixXd &A, const unsigned int first, const auto &force, const auto &half, const auto &moment) {
              A.block(6 * a, first, 3, force.cols()) += D * (force + half);
              A.block(6 * a + 3, first, 3, force.cols()) += arm * D * force + middle * D * half + D * moment;
            };
          add(K, 0, force.place, middle_force.place, moment.place);
          add(K, n_twists, force.states, middle_force.states, moment.states);
          add(C, 0, force.twist, middle_force.twist, moment.twist);
          K.block<3, 3>(6 * a, 6 * a + 3) += skew(Vector3(f + h));
          K.block<3, 3>(6 * a + 3, 6 * a + 3) += arm * skew(f) + middle * skew(h) + skew(m);
        }
    }

    /** Rates of the lags, b_i U/(c/2) (V₃ − x_i), U reduced by the Mach number if the lags are @p compressible. */
    void
    add_lag_rows(const Station           &station,
                 const Gathered<double>  &g,
                 const AtStation<double> &at,
                 const Air               &air,
                 const bool               compressible,
                 Eigen::MatrixXd         &K,
                 Eigen::MatrixXd         &C) const
    {
      const unsigned int n_twists = turn.place.cols(), n_states = turn.states.cols();
      const double       speed = lags::speed(at.V, air), U = lags::speed_of_lags(speed, air, compressible),
                   by_speed = lags::slope_of_speed_of_lags(speed, air, compressible) / speed;
      for (unsigned int i = 0; i < lags::n; ++i)
        {
          const unsigned int       k = station.first_lag + i, row = n_twists + k;
          const double             rate = -lags::b[i] * 2 / station.section.chord, lack = at.V(2) - g.lags[k];
          const Eigen::RowVector3d slope =
            rate * Eigen::RowVector3d(0., lack * by_speed * at.V(1), lack * by_speed * at.V(2) + U);
          K.row(row).head(n_twists) += slope * V.place;
          K.row(row).tail(n_states) += slope * V.states;
          K(row, row) -= rate * U;
          C.row(row).head(n_twists) += slope * V.twist;
        }
    }

    /** What the lift puts into the states of the inflow, of the @p inflow; by the flow through the @p disk, too, if
     * shapes depend on it. */
    void
    add_inflow_rows(const Station           &station,
                    const Gathered<double>  &g,
                    const AtStation<double> &at,
                    const Inflow            &inflow,
                    const Change<5> *const   disk,
                    Eigen::MatrixXd         &K,
                    Eigen::MatrixXd         &C) const
    {
      const unsigned int n_twists = turn.place.cols(), n_states = turn.states.cols();
      Change<1>          thrust(n_twists, n_states);
      thrust.add<3>(at.thrust_axis.transpose(), force);
      thrust.add<3>(at.force.transpose(), axis);
      const double       F = at.force.dot(at.thrust_axis), factor = inflow.factor_of_loads(g.radius);
      const unsigned int first = n_twists + g.lags.size();
      for (unsigned int k = 0; k < g.amplitudes.size(); ++k)
        {
          const double             c     = -station.weight * factor * inflow.load_weights[k];
          const Eigen::RowVector3d slope = c * F * by_place.row(k);
          K.row(first + k).head(n_twists) += c * at.shapes[k] * thrust.place + slope * on_disk.place;
          K.row(first + k).tail(n_states) += c * at.shapes[k] * thrust.states;
          C.row(first + k).head(n_twists) += c * at.shapes[k] * thrust.twist;
          if (disk != nullptr)
            {
              K.row(first + k).head(n_twists) += c * F * by_flow.row(k) * disk->place;
              C.row(first + k).head(n_twists) += c * F * by_flow.row(k) * disk->twist;
            }
        }
    }

    /** Rates of the angle of pressure and of the place of separation. */
    void
    add_stall_rows(const Station           &station,
                   const Gathered<double>  &g,
                   const AtStation<double> &at,
                   const Air               &air,
                   const SeparationLags    &T,
                   Eigen::MatrixXd         &K,
                   Eigen::MatrixXd         &C) const
    {
      const unsigned int n_twists = turn.place.cols(), n_states = turn.states.cols(), k = station.first_lag + lags::n,
                         row             = n_twists + k;
      const double             per_chord = 2 / station.section.chord, U = lags::speed(at.V, air), speed = per_chord * U;
      const Eigen::RowVector3d dspeed = per_chord * Eigen::RowVector3d(0., at.V(1) / U, at.V(2) / U);
      // α = atan2(w, −V₂), w = (1 − A₁ − A₂) V₃ + A₁ x₁ + A₂ x₂
      const double             square = at.V(1) * at.V(1) + at.upwash * at.upwash;
      const double             by_w = square > 0 ? -at.V(1) / square : 0., by_V2 = square > 0 ? at.upwash / square : 0.;
      const Eigen::RowVector3d dalpha(0., by_V2, by_w * (1 - lags::A[0] - lags::A[1]));
      const double             angle = g.lags[k], lack = lags::angle_between(angle, at.flow.alpha), x = g.lags[k + 1];
      const auto               v = station.section.separation->at(angle);

      const Eigen::RowVector3d first  = -(speed * dalpha + lack * dspeed) / T.pressure,
                               second = -(v.place - x) / T.boundary_layer * dspeed;
      for (unsigned int i = 0; i < 2; ++i)
        {
          const Eigen::RowVector3d &slope = i == 0 ? first : second;
          K.row(row + i).head(n_twists) += slope * V.place;
          K.row(row + i).tail(n_states) += slope * V.states;
          C.row(row + i).head(n_twists) += slope * V.twist;
        }
      for (unsigned int i = 0; i < lags::n; ++i)
        K(row, n_twists + station.first_lag + i) -= speed / T.pressure * by_w * lags::A[i];
      K(row, row) += speed / T.pressure;
      K(row + 1, row) -= speed / T.boundary_layer * v.place_alpha;
      K(row + 1, row + 1) += speed / T.boundary_layer;
    }

    /** The couple of pitching, but for its direction. */
    void
    of_pitching(const Station &station, const AtStation<double> &at, const Matrix3 &E, const Change<1> &pitching)
    {
      const double sign = at.V(1) > 0 ? -1 : 1, c = station.pitch_damping;
      moment.add<3>(c * sign * at.pitching * E.col(0) * Eigen::RowVector3d::Unit(1), V);
      moment.add<1>(c * sign * at.V(1) * E.col(0), pitching);
    }

    /** Ω₁ = e₁·ω */
    Change<1>
    of_turning(const AtStation<double> &at, const Matrix3 &E) const
    {
      Change<1> turning(turn.place.cols(), turn.states.cols());
      turning.add<3>(E.col(0).transpose(), spin);
      turning.add<3>(E.col(0).transpose() * skew(at.spin), turn);
      return turning;
    }

    /** What of it is that of a section carried round the thrust axis n, κ n·e₁ with κ = (n × r)·v/|n × r|². */
    Change<1>
    of_carried_round(const Station &station, const Gathered<double> &g, const AtStation<double> &at) const
    {
      const Matrix3     &H     = g.frames.D.back();
      const unsigned int first = 6 * (g.frames.D.size() - 1);
      const Vector3      v_hub = g.frames.y.back().head<3>(), n = at.thrust_axis, e1 = at.axes.e1,
                    r = g.frames.position(station.N, station.three_quarters) - g.frames.x.back(), p = n.cross(r),
                    v = at.air - at.relative - H * v_hub;
      Change<3> dr(turn.place.cols(), turn.states.cols()), dv = dr, dp = dr;
      for (unsigned int a = 0; a < station.N.size(); ++a)
        {
          const Matrix3 ND = station.N[a] * g.frames.D[a];
          dr.place.middleCols<3>(6 * a) += ND;
          dr.place.middleCols<3>(6 * a + 3) -= ND * skew(station.three_quarters);
        }
      dr.place.middleCols<3>(first) -= H;
      dv.add<3>(Matrix3::Identity(), air);
      dv.add<3>(-Matrix3::Identity(), relative);
      dv.place.middleCols<3>(first + 3) += H * skew(v_hub);
      dv.twist.middleCols<3>(first) -= H;
      dp.add<3>(-skew(r), axis);
      dp.add<3>(skew(n), dr);
      const double square = p.squaredNorm() + square_near_axis(g.radius), kappa = p.dot(v) / square, along = n.dot(e1);
      Change<1>    carried(turn.place.cols(), turn.states.cols());
      carried.add<3>(along / square * (v - 2 * kappa * p).transpose(), dp);
      carried.add<3>(along / square * p.transpose(), dv);
      carried.add<3>(kappa * e1.transpose(), axis);
      carried.add<3>(-kappa * n.transpose() * skew(e1), turn);
      return carried;
    }

    /** What of the virtual mass is a load. */
    void
    of_virtual_mass(const Station &station, const AtStation<double> &at, const Matrix3 &E)
    {
      const Vector3 u = E.transpose() * at.air, w                 = E.transpose() * at.spin;
      Change<3>     du(turn.place.cols(), turn.states.cols()), dw = du;
      du.add<3>(E.transpose(), air);
      du.add<3>(E.transpose() * skew(at.air), turn);
      dw.add<3>(E.transpose(), spin);
      dw.add<3>(E.transpose() * skew(at.spin), turn);
      const double  m  = station.virtual_mass;
      const Vector3 e3 = E.col(2);
      middle_force.add<3>(m * e3 * Eigen::RowVector3d(w(1), -w(0), 0.), du);
      middle_force.add<3>(m * e3 * Eigen::RowVector3d(-u(1), u(0), 0.), dw);
      middle_force.add<3>(-skew(at.middle_force), turn);
    }

    /** The place on the disk and the thrust axis follow the hub, the last frame. */
    void
    of_hub(const Gathered<double> &g, const AtStation<double> &at)
    {
      const Matrix3     &H     = g.frames.D.back();
      const unsigned int first = 6 * (g.frames.D.size() - 1);
      on_disk.add<3>(H.transpose(), place);
      on_disk.place.middleCols<3>(first) -= H.transpose() * H;
      on_disk.place.middleCols<3>(first + 3) += skew(at.on_disk);
      axis.place.middleCols<3>(first + 3) -= H * skew(Vector3::Unit(2));
    }

    /** As seen from the hub: δ(Hᵀa). */
    static Change<3>
    seen(const Change<3> &a, const Gathered<double> &g, const Vector3 &components)
    {
      const Matrix3 &H = g.frames.D.back();
      Change<3>      result(a.place.cols(), a.states.cols());
      result.add<3>(H.transpose(), a);
      result.place.middleCols<3>(6 * (g.frames.D.size() - 1) + 3) += skew(components);
      return result;
    }

    /** Annular inflow follows the place on the disk, the free air and its own states; J is AnnularMomentum's. */
    void
    of_annulus(const Station                                             &station,
               const Gathered<double>                                    &g,
               const AtStation<double>                                   &at,
               const Eigen::Matrix<double, 5, AnnularMomentum::n_inputs> &J)
    {
      const Matrix3     &H     = g.frames.D.back();
      const unsigned int first = 6 * (g.frames.D.size() - 1);
      const Vector3      v     = g.frames.y.back().head<3>();
      free                     = seen(air, g, at.free);
      free.place.middleCols<3>(first + 3) += H.transpose() * H * skew(v);
      free.twist.middleCols<3>(first) -= H.transpose() * H;
      Change<3> added(turn.place.cols(), turn.states.cols());
      added.add<3>((Matrix3() << J.topLeftCorner<3, 2>(), Vector3::Zero()).finished(), on_disk);
      added.add<3>(J.block<3, 3>(0, 2), free);
      added.states.middleCols<2>(station.first_flow) += J.block<3, 2>(0, 5);
      air.add<3>(H, added);
      air.place.middleCols<3>(first + 3) -= H * skew(at.added);
    }

    /** Rates of its states. */
    void
    add_flow_rows(const Station                                             &station,
                  const Gathered<double>                                    &g,
                  const AtStation<double>                                   &at,
                  const Eigen::Matrix<double, 5, AnnularMomentum::n_inputs> &J,
                  Eigen::MatrixXd                                           &K,
                  Eigen::MatrixXd                                           &C) const
    {
      const Matrix3     &H        = g.frames.D.back();
      const unsigned int n_twists = turn.place.cols(), row = n_twists + station.first_flow;
      const auto         slopes = J.bottomRows<2>();
      Change<2>          rate(n_twists, turn.states.cols());
      rate.add<3>((Eigen::Matrix<double, 2, 3>() << slopes.leftCols<2>(), Eigen::Vector2d::Zero()).finished(), on_disk);
      rate.add<3>(slopes.middleCols<3>(2), free);
      rate.add<3>(slopes.middleCols<3>(7), seen(relative, g, H.transpose() * at.relative));
      rate.add<3>(slopes.middleCols<3>(10), seen(force, g, H.transpose() * at.force));
      rate.states.middleCols<2>(station.first_flow) += slopes.middleCols<2>(5);
      K.middleRows<2>(row).leftCols(n_twists) -= rate.place;
      K.middleRows<2>(row).rightCols(turn.states.cols()) -= rate.states;
      C.middleRows<2>(row).leftCols(n_twists) -= rate.twist;
    }

    /** The inflow follows the place on the disk and its own states. */
    void
    of_inflow(const Inflow            &inflow,
              const Gathered<double>  &g,
              const AtStation<double> &at,
              const unsigned int       first_state,
              const Change<5>         &disk)
    {
      const unsigned int n = g.amplitudes.size();
      Eigen::VectorXd    by_x(n), by_y(n);
      inflow.disk.gradients(at.on_disk(0) / g.radius, at.on_disk(1) / g.radius, by_x.data(), by_y.data());
      by_x /= g.radius;
      by_y /= g.radius;
      by_place.resize(n, 3);
      by_place << by_x, by_y, Eigen::VectorXd::Zero(n);
      const Eigen::Map<const Eigen::VectorXd> z(g.amplitudes.data(), n), phi(at.shapes, n);
      air.add<3>(-at.induced * Matrix3::Identity(), axis);
      air.add<3>(-at.thrust_axis * g.near * Eigen::RowVector3d(z.dot(by_x), z.dot(by_y), 0.), on_disk);
      if (!inflow.states.empty())
        air.states.middleCols(first_state, n) -= at.thrust_axis * g.near * phi.transpose();
      unsigned int column = first_state + inflow.states.size();
      inflow.for_states_of_neighbours([&](const double c) { air.states.col(column++) -= c * at.thrust_axis; });
      if (inflow.corrections.has_ground)
        air.add<5>(-at.thrust_axis * z.dot(phi) * inflow.corrections.ground_slopes(g.disk, g.radius), disk);
    }

    /** The flow of a theory of its own follows the place, the flow through the disk and its states. */
    void
    of_external(const ExternalInflow    &inflow,
                const Gathered<double>  &g,
                const AtStation<double> &at,
                const unsigned int       first_state,
                const Change<5>         &disk)
    {
      const auto     e = inflow.derivatives(at.on_disk, g.disk, g.amplitudes);
      const Matrix3 &H = g.frames.D.back();
      Change<3>      added(turn.place.cols(), turn.states.cols());
      added.add<3>(e.velocity.leftCols<3>(), on_disk);
      added.add<5>(e.velocity.rightCols<5>(), disk);
      added.states.middleCols(first_state, e.by_states.cols()) += e.by_states;
      air.add<3>(H, added);
      air.place.middleCols<3>(6 * (g.frames.D.size() - 1) + 3) -= H * skew(at.added);
      by_place = e.drives.leftCols<3>();
      by_flow  = e.drives.rightCols<5>();
    }

    /** How the flow through the disk as a whole changes, with the hub and the inflow's states. */
    static Change<5>
    of_disk(const Inflow           &inflow,
            const Gathered<double> &g,
            const unsigned int      first_state,
            const Point<double>    &point,
            const unsigned int      n_twists,
            const unsigned int      n_states)
    {
      Change<5> disk(n_twists, n_states);
      if (!inflow.corrections.any())
        return disk;
      const Matrix3     &H = g.frames.D.back();
      const Vector3     &x = g.frames.x.back(), v = g.frames.y.back().head<3>();
      const unsigned int first = 6 * (g.frames.D.size() - 1), n = inflow.states.size();
      const Vector3      s    = inflow.air->wind(x, point.time) - H * v;
      const Matrix3      sign = Vector3(1., 1., -1.).asDiagonal(), HtH = H.transpose() * H;
      disk.place.block<3, 3>(0, first)     = sign * H.transpose() * inflow.air->gradient(x, point.time) * H;
      disk.place.block<3, 3>(0, first + 3) = sign * (skew(Vector3(H.transpose() * s)) + HtH * skew(v));
      disk.twist.block<3, 3>(0, first)     = -sign * HtH;
      disk.place.block<1, 3>(4, first)     = H.row(2);
      unsigned int column                  = first_state + n;
      inflow.for_states_of_neighbours([&](const double c) { disk.states(2, column++) += c; });
      if (n > 0 && inflow.corrections.averages.size() == n)
        disk.states.row(3).segment(first_state, n) =
          Eigen::Map<const Eigen::RowVectorXd>(inflow.corrections.averages.data(), n);
      return disk;
    }

    /** What tips leave of the lift: @p by_kept are the loads' slopes. */
    void
    of_tips(const Inflow            &inflow,
            const Gathered<double>  &g,
            const AtStation<double> &at,
            const Change<5>         &disk,
            const Eigen::Vector4d   &by_kept)
    {
      const auto slopes = inflow.corrections.tip_slopes(
        at.on_disk(0), at.on_disk(1), g.disk(2) + g.disk(3), at.spin.dot(at.thrust_axis), g.radius);
      loads.add<3>(by_kept * Eigen::RowVector3d(slopes(0), slopes(1), 0.), on_disk);
      Eigen::Matrix<double, 1, 5> through = Eigen::Matrix<double, 1, 5>::Zero();
      through(2) = through(3) = slopes(2);
      loads.add<5>(by_kept * through, disk);
      loads.add<3>(by_kept * slopes(3) * at.thrust_axis.transpose(), spin);
      loads.add<3>(by_kept * slopes(3) * at.spin.transpose(), axis);
    }

    /** The air where the flow is met, if it is not the same everywhere. */
    void
    of_wind(const Station &station, const Gathered<double> &g, const Matrix3 &gradient)
    {
      for (unsigned int a = 0; a < station.N.size(); ++a)
        {
          const Matrix3 GD = station.N[a] * gradient * g.frames.D[a];
          air.place.middleCols<3>(6 * a) += GD;
          air.place.middleCols<3>(6 * a + 3) -= GD * skew(station.three_quarters);
        }
    }
  };
} // namespace samara

#endif
