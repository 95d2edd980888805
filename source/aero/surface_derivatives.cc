// Matrices of a surface: its loads and the rates of its states.

#include <samara/aero/surface_derivatives.h>

namespace samara
{
  using internal::Change;



  /**
   * In air at rest the equations of annular inflow are of second order in their states, which statics would not leave:
   * Newton's first step is one through air that moves.
   */
  void
  Surface::add_still_air(const Station           &station,
                         const Gathered<double>  &g,
                         const AtStation<double> &at,
                         Eigen::MatrixXd         &K) const
  {
    const auto       theory    = annular->within(g.radius);
    constexpr double that_fast = 4e4; // in least speeds: some per cents of that of the blade, as in hover
    const double     least     = std::sqrt(theory.least_square(at.relative));
    if (theory.mass_flow(in_annulus(station, g, at), 1., at.relative) > 1.01 * least)
      return;
    const unsigned int row = 6 * g.frames.D.size() + station.first_flow;
    for (unsigned int i = 0; i < AnnularMomentum::n_states; ++i)
      K(row + i, row + i) += 2 * that_fast * least / (theory.apparent_mass * theory.radius);
  }



  Eigen::Matrix<double, 5, AnnularMomentum::n_inputs>
  Surface::slopes_of_annulus(const Station &station, const Gathered<double> &g, const AtStation<double> &at) const
  {
    const Matrix3 &H = g.frames.D.back();
    return annular->within(g.radius).derivatives(in_annulus(station, g, at),
                                                 H.transpose() * at.relative,
                                                 H.transpose() * at.force,
                                                 station.width);
  }



  void
  Surface::differentiate(const Station           &station,
                         const Gathered<double>  &g,
                         const AtStation<double> &at,
                         const Point<double>     &point,
                         Eigen::MatrixXd         &K,
                         Eigen::MatrixXd         &C) const
  {
    const unsigned int n_twists = 6 * g.frames.D.size(), n_states = K.cols() - n_twists, n_lags = g.lags.size();
    const bool         has_lags = station.unsteady != Unsteady::quasi_steady,
               has_stall        = station.unsteady == Unsteady::dynamic_stall;
    Derivatives d(n_twists, n_states);
    d.of_frames(station, g.frames, at.axes);
    if (air->varies_in_space())
      d.of_wind(station, g, air->gradient(g.frames.position(station.N, station.three_quarters), point.time));
    Eigen::Matrix<double, 5, AnnularMomentum::n_inputs> annular_slopes;
    if (inflow != nullptr)
      d.of_hub(g, at);
    const Change<5> disk =
      inflow == nullptr ? Change<5>(0, 0) : Derivatives::of_disk(*inflow, g, n_lags, point, n_twists, n_states);
    if (annular != nullptr)
      {
        annular_slopes = slopes_of_annulus(station, g, at);
        d.of_annulus(station, g, at, annular_slopes);
      }
    else if (external != nullptr)
      d.of_external(*external, g, at, n_lags, disk);
    else if (inflow != nullptr)
      d.of_inflow(*inflow, g, at, n_lags, disk);
    Matrix3 E;
    E << at.axes.e1, at.axes.e2, at.axes.e3;
    d.of_flow(at, E);
    Eigen::Matrix<double, 4, 7> J =
      section_tangent(station.section, *air, at.V, at.upwash, at.separated, at.kept, at.turning, at.flow);
    // (c/2) Ω₁, Ω₁ = e₁·ω
    Change<1> turning = d.of_turning(at, E);
    d.loads.add<1>(0.5 * station.section.chord * J.col(6), turning);
    if (inflow != nullptr && inflow->corrections.has_tip_loss)
      d.of_tips(*inflow, g, at, disk, J.col(5));
    if (has_stall)
      d.loads.states.col(station.first_lag + 3) += J.col(4);
    if (has_lags)
      for (unsigned int i = 0; i < lags::n; ++i)
        d.loads.states.col(station.first_lag + i) += lags::A[i] * J.col(3);
    J.col(2) += (has_lags ? 1 - lags::A[0] - lags::A[1] : 1.) * J.col(3);
    d.loads.add<3>(J.leftCols<3>(), d.V);
    d.of_forces(at, E);
    if (!has_virtual_mass)
      turning.add<1>(Eigen::Matrix<double, 1, 1>::Ones(), Change<1>(turning));
    if (!has_virtual_mass && inflow != nullptr)
      turning.add<1>(-Eigen::Matrix<double, 1, 1>::Ones(), d.of_carried_round(station, g, at));
    d.of_pitching(station, at, E, turning);
    if (station.virtual_mass > 0)
      d.of_virtual_mass(station, at, E);

    d.add_node_rows(station, g, at, -point.factor * station.weight, K, C);
    if (has_lags)
      d.add_lag_rows(station, g, at, *air, compressible_lags, K, C);
    if (has_stall)
      d.add_stall_rows(station, g, at, *air, separation_lags, K, C);

    if (annular != nullptr)
      {
        d.add_flow_rows(station, g, at, annular_slopes, K, C);
        add_still_air(station, g, at, K);
      }
    if (inflow != nullptr && !inflow->states.empty())
      d.add_inflow_rows(station, g, at, *inflow, external != nullptr ? &disk : nullptr, K, C);
  }



  const Surface::AtElement<double> &
  Surface::matrices(const Element &element, const Point<double> &point) const
  {
    AtElement<double> &all = at_element(element, point);
    if (all.K.size() > 0)
      return all;
    all.K.setZero(element.block.size(), element.block.size());
    all.C = all.K;
    for (unsigned int i = 0; i < element.stations.size(); ++i)
      differentiate(element.stations[i], all.g, all.stations[i], point, all.K, all.C);
    for (unsigned int a = 0; a < element.virtual_mass.size(); ++a)
      all.C.block<6, 6>(6 * a, 6 * a) -= gyroscopic_tangent(element.virtual_mass[a], all.g.frames.y[a]);
    return all;
  }



  void
  Surface::add_matrix(const Point<double> &point, const bool by_velocity, SparseMatrix &A) const
  {
    Eigen::MatrixXd local;
    for (const auto &element : elements)
      {
        const auto &all = matrices(element, point);
        local           = by_velocity ? all.C : all.K;
        if (!by_velocity) // δy = ζ̇ + ad_y ζ
          for (unsigned int a = 0; a < all.g.frames.y.size(); ++a)
            local.middleCols<6>(6 * a) += all.C.middleCols<6>(6 * a) * ad(all.g.frames.y[a]);
        element.block.add(local, A);
      }
  }



  void
  Surface::Loads::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    surface->add_matrix(point, false, K);
  }



  void
  Surface::Loads::damping(const Point<double> &point, SparseMatrix &C) const
  {
    surface->add_matrix(point, true, C);
  }
} // namespace samara
