#include <samara/aero/momentum_inflow.h>
#include <samara/aero/station.h>
#include <samara/base/dense.h>
#include <samara/base/errors.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  void
  MomentumInflow::add_parameters(Parameters &prm)
  {
    Inflow::add_parameters(prm);
    prm.add("Initial", initial, "Mean inflow at the start; statics find theirs [m/s].");
    prm.add("Ground effect",
            ground_effect,
            "How the ground of the air, a plane, reduces the inflow: by the image of a source, of use from half a "
            "radius above it on.",
            dealii::Patterns::Selection("none|Cheeseman-Bennett"));
    add_tip_loss(prm);
    add_interference(prm);
  }



  void
  MomentumInflow::add_apparent_mass(Parameters &prm)
  {
    apparent_mass = 8 / (3 * M_PI);
    gives_mass    = true;
    prm.add(
      "Apparent mass",
      apparent_mass,
      "Of the mean flow, divided by density, area and radius of the disk: 8/(3 pi) is that of a rigid disk, "
      "128/(75 pi) the other one of Pitt and Peters; the less, the sooner inflow follows thrust: at once if it is "
      "zero [1].",
      dealii::Patterns::Double(0));
  }



  void
  PetersHeInflow::add_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    MomentumInflow::add_parameters(prm);
    prm.add("Harmonics", harmonics, "Highest harmonic of the azimuth.", Integer(0, 20));
    prm.add("Power",
            power,
            "Highest power of the radius in the shapes, at least the highest harmonic: 4 and 8 make 33 states.",
            Integer(0, 40));
    prm.add(
      "Mass flow",
      mass_flow,
      "What the total flow through the disk carries away: the pressure of a uniform load, which makes the mean flow "
      "that of momentum theory, or the first state, as in the literature.",
      Selection("uniform load|first state"));
  }



  void
  MomentumInflow::initialize(Model &model)
  {
    Inflow::initialize(model);
    try
      {
        theory = make();
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where("Power"), problem.what());
        return;
      }
    is_algebraic = gives_mass && apparent_mass == 0;
    if (is_algebraic) // of 0 = g the mass is a mere factor; air that grows with its disk is a part of it
      theory.stretch.row(0).setZero();
    else if (gives_mass)
      theory.apparent_mass[0] = apparent_mass;
    disk = theory.disk;
    if (air == nullptr)
      return;
    corrections.has_ground = ground_effect == "Cheeseman-Bennett";
    corrections.ground     = air->ground;
    if (corrections.has_ground && model.position(hub)(2) <= air->ground)
      model.complaints.add(parameters.where("Ground effect"),
                           "the hub of <" + name + "> is not above the ground, which is at z = " +
                             number_to_text("%.4g", air->ground) + " m: <Ground> of the air says where it is");
    // a uniform flow: of radial functions φ, one for each n, the sum of a_n φ_n is 1 where all of them are taken; the
    // first state alone has the mean flow that is given
    const FiniteStateInflow::Flow<double> unit =
      theory.flow<double>(Eigen::VectorXd::Unit(theory.size(), 0), {0., 0., 0., 0.}, radius, 1e-300);
    for (unsigned int k = 0; k < theory.size(); ++k)
      {
        const auto &shape = disk.shapes[k];
        states.push_back(model.add_state(name + ", state " + std::to_string(k + 1) + " (harmonic " +
                                           std::to_string(shape.m) +
                                           (shape.m == 0  ? "" :
                                            shape.is_sine ? ", sine" :
                                                            ", cosine") +
                                           ")",
                                         "m/s",
                                         k == 0 ? initial / unit.nu : 0.,
                                         0.1 * air->small_speed()));
        model.states.back().is_algebraic = k == 0 && is_algebraic;
        load_weights.push_back(theory.load_weights[k] / (air->density * std::pow(radius, 3) * theory.apparent_mass[k]));
      }
  }



  void
  MomentumInflow::connect(Layout &layout)
  {
    Inflow::connect(layout);
    std::vector<unsigned int> coupled = states;
    for (const unsigned int k : neighbour_states())
      coupled.push_back(k);
    layout.couple(block, {hub}, {}, {}, coupled);
    layout.add(*this, *this);
  }



  double
  MomentumInflow::least_speed() const
  {
    // some centimetres a second: it rounds |λ| off, and is far below the flow of any rotor that carries something
    return 1e-4 * air->speed_of_sound;
  }



  template <typename Number>
  FiniteStateInflow::Vector<Number>
  MomentumInflow::values(const Point<Number> &point) const
  {
    FiniteStateInflow::Vector<Number> z(states.size());
    for (unsigned int k = 0; k < states.size(); ++k)
      z(k) = point.states[states[k]];
    return z;
  }



  template <typename Number>
  FiniteStateInflow::Flight<Number>
  MomentumInflow::flight(const Point<Number> &point) const
  {
    const Mat3<Number> H     = axes_in_air(hub, point);
    const Vec6<Number> twist = hub.template twist<Number>(point.y);
    const Vec3<Number> wind  = air->wind(hub.position(point.q), point.time);
    const Vec3<Number> v     = H.transpose() * (wind - H * twist.template head<3>());
    return {v(0),
            v(1),
            from_neighbours(point) - v(2),
            twist(5),
            point.held ? 0. : growth_at(point.time)}; // statics: a radius that stays
  }



  template <typename Number>
  void
  MomentumInflow::residual_at(const Point<Number> &point, Number *r) const
  {
    const auto flow = theory.flow(values(point), flight(point), radius_at(point.time), least_speed());
    Eigen::Matrix<Number, Eigen::Dynamic, 1> local = Eigen::Matrix<Number, Eigen::Dynamic, 1>::Zero(block.size());
    local.segment(6, states.size())                = -flow.rate;
    block.add(local, r);
  }



  void
  MomentumInflow::differentiate(const Point<double> &point, Eigen::MatrixXd &K, Eigen::MatrixXd &C) const
  {
    const unsigned int n    = states.size();
    const auto         z    = values(point);
    const auto         f    = flight(point);
    const double       R    = radius_at(point.time);
    const auto         flow = theory.flow(z, f, R, least_speed());
    const auto         d    = theory.derivatives(flow, z, f, R, least_speed());
    const Matrix3      H    = hub.triad(point.q);
    const Vector6      y    = hub.twist(point.y);
    const Vector3      x = hub.position(point.q), s = air->wind(x, point.time) - H * y.head<3>();

    // v = Hᵀ s, s = wind − H y
    Eigen::Matrix<double, 3, 6> place = Eigen::Matrix<double, 3, 6>::Zero(), twist = place;
    place.leftCols<3>()  = H.transpose() * air->gradient(x, point.time) * H;
    place.rightCols<3>() = skew(Vector3(H.transpose() * s)) + H.transpose() * H * skew(Vector3(y.head<3>()));
    twist.leftCols<3>()  = -H.transpose() * H;

    Eigen::MatrixXd by_v = d.by_flight.leftCols<3>();
    by_v.col(2) *= -1; // λ_f = −v₃
    K.setZero(block.size(), block.size());
    C                   = K;
    K.block(6, 0, n, 6) = -by_v * place;
    C.block(6, 0, n, 6) = -by_v * twist;
    C.col(5).segment(6, n) -= d.by_flight.col(3);
    K.block(6, 6, n, n) = -d.by_z;
    unsigned int column = 6 + n;
    for_states_of_neighbours([&](const double c) { K.col(column++).segment(6, n) = -c * d.by_flight.col(2); });
    // in air at rest the equations are of second order in z, which statics would not leave: Newton's first step is one
    // through air that moves. In motions a flow without mass has nothing but its own slope
    if (flow.V_T < 0.1 * least_speed() && (point.held || !is_algebraic))
      if (const double still = still_speed(point); flow.V_T < 0.1 * still)
        {
          const Eigen::MatrixXd inverse = samara::inverse(theory.influence(flow.X_x, flow.X_y));
          for (unsigned int k = 0; k < n; ++k)
            K.row(6 + k).segment(6, n) += 100 * still / (R * theory.apparent_mass[k]) * inverse.row(k);
        }
  }



  namespace
  {
    /** The angular velocity of what a frame moves with. */
    Vector3
    spin_of(const Frame &frame, const Point<double> &point)
    {
      return Frame{frame.node}.triad(point.q) * Frame{frame.node}.twist(point.y).tail<3>();
    }
  } // namespace



  /** Below a tenth of it air is at rest: least_speed(), and far below the flow of hover however slowly blades turn. */
  double
  MomentumInflow::still_speed(const Point<double> &point) const
  {
    constexpr double of_tips = 4e-4, smallest = 1e-12; // of the speed of tips, a hundredth of the flow of hover
    double           fastest = 0;
    for (const auto *surface : surfaces)
      fastest = std::max(fastest, spin_of(surface->carrier(), point).norm() * radius_at(point.time));
    return fastest > 0 ? std::clamp(of_tips * fastest, smallest * least_speed(), least_speed()) : least_speed();
  }



  void
  MomentumInflow::check_axes(const Point<double> &point) const
  {
    // blades that feather or flap a little, as the equilibrium of one azimuth may have them, still turn with it
    constexpr double share_of_spin = 0.1;
    const bool has_harmonics =
      std::any_of(disk.shapes.begin(), disk.shapes.end(), [](const auto &shape) { return shape.m > 0; });
    for (const auto *surface : surfaces)
      {
        const Vector3 spin = spin_of(surface->carrier(), point);
        if (has_harmonics && (spin - spin_of(hub, point)).norm() > share_of_spin * spin.norm())
          throw InputError(parameters.where("Hub") + ": the hub of inflow <" + name +
                           "> does not turn with its blades: steady harmonics are those in axes that do; name a point "
                           "that turns");
      }
  }



  void
  MomentumInflow::tangent(const Point<double> &point, SparseMatrix &A) const
  {
    if (point.held) // statics
      check_axes(point);
    Eigen::MatrixXd K, C;
    differentiate(point, K, C);
    K.leftCols<6>() += C.leftCols<6>() * ad(hub.twist(point.y));
    block.add(K, A);
  }



  void
  MomentumInflow::damping(const Point<double> &point, SparseMatrix &A) const
  {
    Eigen::MatrixXd K, C;
    differentiate(point, K, C);
    block.add(C, A);
  }



  std::vector<Doubt>
  MomentumInflow::doubts(const State &state) const
  {
    const auto         point  = state.point();
    const auto         f      = flight(point);
    const Vector3      e3     = hub.triad(point.q).col(2);
    const auto         text   = [](const double x) { return number_to_text("%.3g", x); };
    const double       R      = radius_at(state.time);
    std::vector<Doubt> result = Inflow::doubts(state);
    if (const double thrust = f.lambda_f < 0 && !surfaces.empty() ? e3.dot(loads(state).force) : 0.; thrust > 0)
      {
        const double hover = std::sqrt(thrust / (2 * air->density * M_PI)) / R, ratio = f.lambda_f / hover;
        const bool   is_axial = std::hypot(f.mu_x, f.mu_y) < hover;
        if (is_axial && ratio <= -2 && f.lambda_f + mean(state) > 0)
          result.push_back({"flow of hover",
                            "the rotor of <" + name + "> descends with " + text(-f.lambda_f) + " m/s, " + text(-ratio) +
                              " of its flow in hover, and air still flows down through it: this is the continuation of "
                              "hover, and the flow of a windmill is another solution. Results may be wrong there"});
        if (is_axial && ratio > -2 && ratio < -0.3)
          result.push_back({"vortex rings",
                            "the rotor of <" + name + "> descends with " + text(-f.lambda_f) +
                              " m/s into its own wake, " + text(-ratio) +
                              " of its flow in hover: from 0.3 to 2 there are vortex rings, of which momentum theory "
                              "knows nothing. Results may be wrong there"});
      }
    // with too few stations for its shapes there is a root of Newton's method in which nothing passes the disk
    constexpr double nothing = 0.01; // of the flow of its shapes
    double           largest = 0;
    for (const unsigned int k : states)
      largest = std::max(largest, std::abs(state.states[k]));
    if (std::hypot(f.mu_x, f.mu_y, f.lambda_f) < nothing * largest &&
        theory.flow(values(point), f, R, least_speed()).V_T < nothing * largest)
      result.push_back(
        {"no mean flow",
         "the shapes of <" + name + "> have a flow of up to " + text(largest) +
           " m/s, and none of it passes the disk as a whole: this is no flow of a rotor. Give the surfaces "
           "more <Stations>, or the inflow fewer shapes"});
    if (!corrections.has_ground)
      return result;
    if (const double height = hub.position(point.q)(2) - corrections.ground; height < 0.5 * R)
      result.push_back({"low hub",
                        "the hub of <" + name + "> is " + text(height) +
                          " m above the ground, less than half a radius: what <Ground effect> says there is continued "
                          "from above, and no more than a guess"});
    if (e3(2) < std::cos(M_PI / 6))
      result.push_back({"tilted disk",
                        "the thrust axis of <" + name + "> leans by " +
                          text(std::acos(std::clamp(e3(2), -1., 1.)) * 180 / M_PI) +
                          " deg: <Ground effect> is that of a disk that is parallel to the ground"});
    return result;
  }



  std::vector<CountedStates>
  MomentumInflow::counted_states() const
  {
    CountedStates group;
    for (unsigned int k = is_algebraic ? 1 : 0; k < states.size(); ++k)
      {
        group.states.push_back(states[k]);
        group.metric.push_back(theory.apparent_mass[k] / theory.load_weights[k]);
      }
    return {group};
  }



  double
  MomentumInflow::mean(const State &state) const
  {
    const auto point = state.point();
    return theory.flow(values(point), flight(point), radius_at(state.time), least_speed()).nu;
  }



  template class Evaluated<MomentumInflow, StateEquation>;
} // namespace samara
