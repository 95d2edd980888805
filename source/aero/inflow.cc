#include <samara/aero/inflow.h>
#include <samara/base/errors.h>
#include <samara/model/drawing.h>
#include <samara/model/probe_needs.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace samara
{
  void
  Inflow::add_parameters(Parameters &prm)
  {
    prm.add("Hub", hub_name, "Point at the centre of the disk, body.point: the axes of the inflow move with it.");
    prm.add("Axis",
            axis,
            "Thrust axis in the reference configuration, inertial components; 0, 0, 0: axis 3 of the hub [1].");
    prm.add("Direction",
            direction,
            "Direction near which azimuth zero lies in the reference configuration; 0, 0, 0: any [1].");
    prm.add(
      "Radius",
      given_radius,
      "Radius of the disk, a function of time t where blades are drawn in and out: the shapes of the flow grow with "
      "it [m].");
    prm.add("Air", air_name, "Name of the air; needed only if there are several.");
    prm.turns("Axis", Turning::direction);
    prm.turns("Direction", Turning::direction);
  }



  void
  Inflow::add_tip_loss(Parameters &prm)
  {
    using namespace dealii::Patterns;
    has_factor_of_tips = true;
    prm.add("Tip loss",
            tip_loss,
            "Whether Prandtl's factor reduces the lift of blades at tips and roots. Not together with harmonics up to "
            "the number of blades, which have the loss in them.",
            Selection("none|Prandtl"));
    prm.add("Root",
            corrections.root,
            "Radius at which blades begin, for Prandtl's factor there; 0: no loss at roots [m].",
            Double(0));
    prm.add("Blades",
            given_blades,
            "How many blades the rotor has, for Prandtl's factor; 0: as many as surfaces name this inflow.",
            Integer(0, 100));
  }



  void
  Inflow::add_interference(Parameters &prm)
  {
    prm.add(
      "Interference",
      neighbour_names,
      "Other inflows, sums of shapes, that are felt on this disk: the mean flow of each over its own disk comes in "
      "addition, uniform and against the thrust axis here.");
    prm.add("Interference factors",
            neighbour_factors,
            "What the mean flow of each is multiplied by: about 1 between rotors in one plane, up to 2 far down in a "
            "wake [1].");
  }



  void
  Inflow::find_neighbours(Model &model)
  {
    if (neighbour_names.size() != neighbour_factors.size())
      {
        model.complaints.add(parameters.where("Interference factors"),
                             "<Interference> of <" + name + "> names " + std::to_string(neighbour_names.size()) +
                               " inflows, and there are " + std::to_string(neighbour_factors.size()) +
                               " <Interference factors>");
        return;
      }
    for (unsigned int i = 0; i < neighbour_names.size(); ++i)
      try
        {
          const auto &other = model.find<Inflow>(neighbour_names[i], "inflow");
          const bool  twice = std::any_of(neighbours.begin(), neighbours.end(), [&](const Neighbour &neighbour) {
            return neighbour.inflow == &other;
          });
          if (&other == this || twice)
            throw std::invalid_argument("<" + name + "> names " + (twice ? "<" + other.name + "> twice" : "itself"));
          if (!other.is_sum_of_shapes())
            throw std::invalid_argument("<" + other.name +
                                        "> is no sum of shapes on a disk, and has no mean flow that others could feel");
          neighbours.push_back({&other, neighbour_factors[i]});
        }
      catch (const std::invalid_argument &problem)
        {
          model.complaints.add(parameters.where("Interference"), problem.what());
        }
  }



  std::vector<unsigned int>
  Inflow::neighbour_states() const
  {
    std::vector<unsigned int> numbers;
    for (const auto &neighbour : neighbours)
      numbers.insert(numbers.end(), neighbour.inflow->states.begin(), neighbour.inflow->states.end());
    return numbers;
  }



  void
  Inflow::be_placed(const Placement &placement)
  {
    // the azimuth that is chosen where none is given is one of the subsystem
    if (!axis.isZero(0.) && direction.isZero(0.))
      parameters.assign("Direction", Vector3(triad_about(axis, direction).col(0)));
    Item::be_placed(placement);
  }



  void
  Inflow::initialize(Model &model)
  {
    if (!parameters.require("Hub", model.complaints))
      return;
    parameters.require("Radius", model.complaints);
    radius = given_radius(0.);
    varies = !given_radius.is_constant();
    if (!(radius > 0) || !std::isfinite(radius))
      model.complaints.add(parameters.where("Radius"),
                           "the radius of the disk of <" + name + "> must be positive, and is " +
                             number_to_text("%.6g", radius) + " m" + (varies ? " at t = 0" : ""));
    std::string where = "Hub";
    try
      {
        const Frame given = model.frame(hub_name);
        where             = "Air";
        air               = &Air::of(model, air_name);
        const Vector3 e3  = axis.isZero(0.) ? Vector3(model.triad(given).col(2)) : axis;
        const Vector3 e1  = !direction.isZero(0.) ? direction :
                            axis.isZero(0.)       ? Vector3(model.triad(given).col(0)) :
                                                    Vector3::Zero();
        if (e3.normalized().cross(e1).norm() < 1e-9 * e1.norm())
          {
            model.complaints.add(parameters.where("Direction"),
                                 "the direction of azimuth zero is along the thrust axis");
            return;
          }
        hub                      = model.frame_at(given, model.position(given), triad_about(e3, e1));
        azimuth_zero             = triad_about(e3, e1).col(0);
        axis_zero                = e3.normalized();
        centre_zero              = model.position(given);
        corrections.has_tip_loss = tip_loss == "Prandtl";
        corrections.least_speed  = 1e-7 * air->speed_of_sound; // keeps quotients smooth where air is at rest
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where(where), problem.what());
      }
    find_neighbours(model);
    if (radius > 0 && corrections.root >= radius)
      model.complaints.add(parameters.where("Root"), "<Root> of <" + name + "> is not less than its <Radius>");
    for (const std::string entry : {"Root", "Blades"})
      if (has_factor_of_tips && tip_loss == "none" && parameters.is_set(entry))
        model.complaints.add(parameters.where(entry),
                             "<" + entry + "> of <" + name + "> is for <Tip loss = Prandtl>, and there is none");
  }



  void
  Inflow::connect(Layout &layout)
  {
    hub                = layout.model.resolved(hub);
    corrections.blades = given_blades > 0 ? given_blades : std::max<std::size_t>(1, surfaces.size());
    corrections.averages.clear();
    for (const auto &shape : disk.shapes) // 2 ∫ r^{2j} r dr
      {
        corrections.averages.push_back(0.);
        for (unsigned int j = 0; j < shape.c.size() && shape.m == 0; ++j)
          corrections.averages.back() += shape.c[j] / (j + 1.);
      }
  }



  double
  Inflow::radius_at(const double time) const
  {
    if (!varies)
      return radius;
    const double R = given_radius(time);
    if (!(R > 0) || !std::isfinite(R))
      throw InputError(parameters.where("Radius") + ": the radius of the disk of <" + name +
                       "> must be positive, and is " + number_to_text("%.6g", R) +
                       " m at t = " + number_to_text("%.6g", time) + " s");
    return R;
  }



  double
  Inflow::growth_at(const double time) const
  {
    return varies ? given_radius.derivative(time) / radius_at(time) : 0.;
  }



  std::vector<Doubt>
  Inflow::doubts(const State &state) const
  {
    std::vector<Doubt> result;
    add_doubt_of_radius(state, result);
    add_doubt_of_ground(state, result);
    return result;
  }



  double
  Inflow::part_below_ground(const State &state) const
  {
    if (!air->has_shear())
      return 0;
    // the disk reaches down to R times the sine of its lean below the hub
    constexpr double horizontal = 1e-6;
    const double     lean = hub.triad(state.q.data()).col(2).normalized().head<2>().norm(), R = radius_at(state.time),
                 z = hub.position(state.q.data())(2), height = z - air->ground;
    if (std::abs(height) >= lean * R || lean < horizontal)
      return air->is_below_wind(z) ? 1. : 0.;
    const double x = height / (lean * R); // of the chord in which the ground cuts the disk, in radii from the centre
    return (std::acos(x) - x * std::sqrt(1 - x * x)) / M_PI;
  }



  void
  Inflow::add_doubt_of_ground(const State &state, std::vector<Doubt> &doubts) const
  {
    const double part = part_below_ground(state), z = hub.position(state.q.data())(2);
    if (part > 0)
      doubts.push_back({"ground",
                        number_to_text("%.3g", 100 * part) + " % of the disk of <" + name +
                          "> are on or below the ground, which is at z = " + number_to_text("%.3g", air->ground) +
                          " m: its hub is at z = " + number_to_text("%.3g", std::abs(z) < 1e-9 * radius ? 0. : z) + // not its round-off
                          " m. A wind with <Shear exponent> is none there. <Ground> of <" + air->name +
                          "> says where the ground is"});
  }



  /** Blades that reach beyond the disk, where shapes and tips know nothing, or end far inside of it. */
  void
  Inflow::add_doubt_of_radius(const State &state, std::vector<Doubt> &doubts) const
  {
    constexpr double least_part = 0.9; // of the radius: thrust of hover is some 2 % too large
    const double     R          = radius_at(state.time);
    const Vector3    axis = hub.triad(state.q.data()).col(2).normalized(), centre = hub.position(state.q.data());
    double           tip = 0;
    for (const auto *surface : surfaces)
      tip = std::max(tip, surface->reach(state, centre, axis) + surface->beyond_stations());
    if (!surfaces.empty() && tip < least_part * R)
      doubts.push_back({"large disk",
                        "the disk of <" + name + "> has a <Radius> of " + number_to_text("%.4g", R) +
                          " m, and its blades end " + number_to_text("%.4g", tip) + " m from the axis: a disk of " +
                          number_to_text("%.3g", R * R / (tip * tip)) +
                          " times their area needs less inflow for the same thrust, and thrust is too large. The "
                          "radius is that of the tips"});
    for (const auto *surface : surfaces)
      if (const double r = surface->reach(state, centre, axis); r > 1.01 * R)
        {
          doubts.push_back({"disk",
                            "blades reach beyond the disk of <" + name + ">: a station is " +
                              number_to_text("%.4g", r) + " m from the axis, and the radius is " +
                              number_to_text("%.4g", R) +
                              " m. The inflow there is continued from inside, which may be "
                              "far too much; <Radius> may be a function of time"});
          return;
        }
  }



  AirLoads
  Inflow::loads(const State &state) const
  {
    const Vector3 centre  = hub.position(state.q.data()),
                  carried = hub.triad(state.q.data()) * hub.twist(state.y.data()).head<3>();
    AirLoads sum;
    for (const auto *surface : surfaces)
      {
        const AirLoads part = surface->air_loads(state, centre, carried);
        sum.force += part.force;
        sum.moment += part.moment;
        sum.power += part.power;
        sum.induced += part.induced;
        sum.profile += part.profile;
      }
    return sum;
  }



  namespace
  {
    /** Numbers of a rotor without dimension, of which each program has its own: these are those of helicopters, and of
     * turbines. */
    enum class Coefficient
    {
      thrust,         ///< C_T = T/(ρπR²(ΩR)²)
      torque,         ///< C_Q = Q/(ρπR³(ΩR)²)
      power,          ///< C_P = P/(ρπR²(ΩR)³)
      advance_ratio,  ///< μ = V cos α/(ΩR), of the air along the disk
      inflow_ratio,   ///< λ = (V sin α + w̄)/(ΩR), of the air through the disk
      solidity,       ///< σ = ∫ c ds/(πR²)
      wind_thrust,    ///< T/(½ρV²πR²), by the wind
      wind_power,     ///< what the rotor takes from the air, −P/(½ρV³πR²)
      tip_speed_ratio ///< ΩR/V
    };

    const std::vector<std::pair<std::string, Coefficient>> rotor_coefficients = {
      {"thrust coefficient", Coefficient::thrust},
      {"torque coefficient", Coefficient::torque},
      {"power coefficient", Coefficient::power},
      {"advance ratio", Coefficient::advance_ratio},
      {"inflow ratio", Coefficient::inflow_ratio},
      {"solidity", Coefficient::solidity},
      {"wind thrust coefficient", Coefficient::wind_thrust},
      {"wind power coefficient", Coefficient::wind_power},
      {"tip speed ratio", Coefficient::tip_speed_ratio}};

    const std::string over_solidity = " over solidity"; ///< behind the first three

    /** a/b, and 0 where nothing turns, or no wind blows */
    double
    quotient(const double a, const double b)
    {
      return b > 0 ? a / b : 0.;
    }

    /** What coefficients are made of, in axes of the hub. */
    struct RotorNumbers
    {
      double  thrust, torque, power; ///< [N, N m, W]
      double  speed, radius;         ///< |Ω| [rad/s], R [m]
      double  density, area;         ///< of the air [kg/m³], of the blades [m²]
      double  mean;                  ///< w̄ [m/s]
      Vector3 air;                   ///< velocity of the undisturbed air against the hub [m/s]

      double
      coefficient(const Coefficient wanted) const
      {
        const double disk = M_PI * radius * radius, tip = speed * radius, V = air.norm();
        const double by_tip = density * disk * tip * tip, by_wind = density * disk * V * V / 2;
        switch (wanted)
          {
            case Coefficient::thrust:
              return quotient(thrust, by_tip);
            case Coefficient::torque:
              return quotient(torque, by_tip * radius);
            case Coefficient::power:
              return quotient(power, by_tip * tip);
            case Coefficient::advance_ratio:
              return quotient(air.head<2>().norm(), tip);
            case Coefficient::inflow_ratio:
              return quotient(mean - air(2), tip);
            case Coefficient::solidity:
              return area / disk;
            case Coefficient::wind_thrust:
              return quotient(thrust, by_wind);
            case Coefficient::wind_power:
              return quotient(-power, by_wind * V);
            case Coefficient::tip_speed_ratio:
              return quotient(tip, V);
          }
        return 0;
      }
    };
  } // namespace



  double
  Inflow::speed(const State &state) const
  {
    const Vector3 axis = hub.triad(state.q.data()).col(2);
    double        sum  = 0;
    for (const auto *surface : surfaces)
      {
        const Frame carrier = surface->carrier();
        sum += axis.dot(carrier.triad(state.q.data()) * carrier.twist(state.y.data()).tail<3>());
      }
    return surfaces.empty() ? 0. : sum / surfaces.size();
  }



  std::optional<Probe>
  Inflow::coefficient_probe(const std::string &path) const
  {
    for (const auto &[name, wanted] : rotor_coefficients)
      for (const bool is_over_solidity : {false, true})
        if (path == (is_over_solidity ? name + over_solidity : name) &&
            (!is_over_solidity || wanted <= Coefficient::power))
          return Probe{path, "1", OfVelocities{{[this, wanted = wanted, is_over_solidity](const State &s) {
                         const Matrix3  H   = hub.triad(s.q.data());
                         const Vector3  x   = hub.position(s.q.data());
                         const AirLoads sum = loads(s);
                         RotorNumbers   rotor;
                         rotor.thrust  = H.col(2).dot(sum.force);
                         rotor.torque  = -H.col(2).dot(sum.moment);
                         rotor.power   = -sum.power;
                         rotor.speed   = std::abs(speed(s));
                         rotor.radius  = radius_at(s.time);
                         rotor.density = air->density;
                         rotor.area    = 0;
                         for (const auto *surface : surfaces)
                           rotor.area += surface->area();
                         rotor.mean = mean(s);
                         rotor.air  = H.transpose() * (air->wind(x, s.time) - H * hub.twist(s.y.data()).head<3>());
                         const double value = rotor.coefficient(wanted);
                         return is_over_solidity ? quotient(value, rotor.coefficient(Coefficient::solidity)) : value;
                       }}}};
    return {};
  }



  std::optional<Probe>
  Inflow::probe(const std::string &path) const
  {
    const auto axes = [this](const State &state) { return hub.triad(state.q.data()); };
    const auto part = [&](const std::string &quantity) {
      return path.size() == quantity.size() + 2 && path.rfind(quantity + " ", 0) == 0 ?
               std::string("123").find(path.back()) :
               std::string::npos;
    };
    if (path == "thrust")
      return Probe{path, "N", OfVelocities{{[=](const State &s) { return axes(s).col(2).dot(loads(s).force); }}}};
    if (path == "torque")
      return Probe{path, "N m", OfVelocities{{[=](const State &s) { return -axes(s).col(2).dot(loads(s).moment); }}}};
    if (path == "power")
      return Probe{path, "W", OfVelocities{{[=](const State &s) { return -loads(s).power; }}}};
    if (path == "induced power")
      return Probe{path, "W", OfVelocities{{[=](const State &s) { return loads(s).induced; }}}};
    if (path == "profile power")
      return Probe{path, "W", OfVelocities{{[=](const State &s) { return loads(s).profile; }}}};
    if (path == "figure of merit")
      return Probe{path, "1", OfVelocities{{[=](const State &s) {
                     const AirLoads sum    = loads(s);
                     const double   thrust = axes(s).col(2).dot(sum.force), R = radius_at(s.time);
                     // that of a rotor that hovers: where it does not lift, or is driven by the air, there is none
                     return thrust > 0 && sum.power < 0 ?
                              thrust * std::sqrt(thrust / (2 * air->density * M_PI * R * R)) / -sum.power :
                              0.;
                   }}}};
    if (path == "mean")
      return Probe{path, "m/s", [=](const State &s) { return mean(s); }};
    if (const auto i = part("force"); i != std::string::npos)
      return Probe{path, "N", OfVelocities{{[=](const State &s) { return axes(s).col(i).dot(loads(s).force); }}}};
    if (const auto i = part("moment"); i != std::string::npos)
      return Probe{path, "N m", OfVelocities{{[=](const State &s) { return axes(s).col(i).dot(loads(s).moment); }}}};
    for (unsigned int k = 0; k < states.size(); ++k)
      if (path == "state " + std::to_string(k + 1))
        return Probe{path, "m/s", [=](const State &s) { return s.states[states[k]]; }};
    return coefficient_probe(path);
  }



  std::vector<std::string>
  Inflow::probe_names() const
  {
    std::vector<std::string> names = {
      "thrust", "torque", "power", "induced power", "profile power", "figure of merit", "mean"};
    for (const auto &[name, coefficient] : rotor_coefficients)
      names.push_back(name);
    for (const auto &[name, coefficient] : rotor_coefficients)
      if (coefficient <= Coefficient::power)
        names.push_back(name + over_solidity);
    for (const std::string quantity : {"force", "moment"})
      for (const char i : {'1', '2', '3'})
        names.push_back(quantity + " " + i);
    for (unsigned int k = 0; k < states.size(); ++k)
      names.push_back("state " + std::to_string(k + 1));
    return names;
  }



  void
  Inflow::draw(const State &state, Drawing &drawing) const
  {
    constexpr unsigned int n_around = 48, n_out = 8;
    if (disk.shapes.empty() || surfaces.empty())
      return;
    const auto          point = state.point();
    const Matrix3       H     = hub.triad(point.q);
    const Vector3       x     = hub.position(point.q);
    const Vector6       twist = hub.twist(point.y);
    const double        R     = radius_at(state.time);
    std::vector<double> z(n_amplitudes()), phi(n_amplitudes());
    amplitudes(point, z.data());
    const double        others = from_neighbours(point);
    const double        near   = corrections.has_ground ?
                                   corrections.ground_factor(flow_through_disk(x, H, twist, z.data(), others, state.time), R) :
                                   1.;
    std::vector<Sample> samples;
    std::vector<double> flow;
    for (unsigned int j = 0; j <= n_out; ++j)
      for (unsigned int i = 0; i <= n_around; ++i)
        {
          const double  r = double(j) / n_out, psi = 2 * M_PI * i / n_around;
          const Vector3 place(r * std::cos(psi), r * std::sin(psi), 0.);
          Sample        sample;
          sample.x        = x + H * (R * place);
          sample.D        = H;
          sample.velocity = H * (twist.head<3>() + twist.tail<3>().cross(R * place));
          samples.push_back(sample);
          if (!drawing.has_fields())
            continue;
          disk.evaluate(place(0), place(1), phi.data());
          flow.push_back(others + near * std::inner_product(z.begin(), z.end(), phi.begin(), 0.));
        }
    drawing.begin_object(name);
    // a web of circles and spokes, which hides no blades
    std::vector<unsigned int> lines;
    for (unsigned int j = 0; j <= n_out; ++j)
      for (unsigned int i = 0; i <= n_around; ++i)
        {
          const unsigned int here = j * (n_around + 1) + i;
          if (j > 0 && i < n_around)
            lines.insert(lines.end(), {here, here + 1});
          if (j < n_out && i % 2 == 0 && i < n_around)
            lines.insert(lines.end(), {here, here + n_around + 1});
        }
    const unsigned int first = drawing.patch(1, samples, lines).first_sample;
    if (!drawing.has_fields())
      return;
    Field &field = drawing.field("inflow", "m/s");
    for (unsigned int i = 0; i < flow.size(); ++i)
      field.set(first + i, flow[i]);
  }



  void
  PrescribedInflow::add_parameters(Parameters &prm)
  {
    Inflow::add_parameters(prm);
    prm.add(
      "Velocity",
      components,
      "w0, wc, ws: flow against the thrust axis, and how much more it is at the edge at azimuth 0 and 90 degrees, "
      "functions of time t [m/s].");
    prm.turns("Velocity", Turning::own_axes);
    add_tip_loss(prm);
    add_interference(prm);
  }



  void
  PrescribedInflow::initialize(Model &model)
  {
    Inflow::initialize(model);
    disk.shapes = {{0, false, {1.}}, {1, false, {1.}}, {1, true, {1.}}};
  }



  double
  PrescribedInflow::prescribed(const unsigned int k, const double time) const
  {
    AssertIndexRange(k, components.size());
    return components[k](time);
  }



  double
  PrescribedInflow::mean(const State &state) const
  {
    return components[0](state.time);
  }



  double
  PrescribedInflow::next_corner(const double from, const double to) const
  {
    return std::min({Inflow::next_corner(from, to),
                     components[0].next_corner(from, to),
                     components[1].next_corner(from, to),
                     components[2].next_corner(from, to)});
  }
} // namespace samara
