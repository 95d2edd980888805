#include <samara/aero/helical_wake.h>
#include <samara/base/errors.h>

#include <algorithm>

namespace samara
{
  void
  HelicalWake::add_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    ExternalInflow::add_parameters(prm);
    prm.add("Speed",
            speed,
            "Angular speed of the blades about the thrust axis, negative where they turn the other way [rad/s].");
    prm.add("Transport",
            transport,
            "Speed with which the wake leaves the disk in addition to the free air: about the mean inflow [m/s].");
    prm.add("Root", root, "Radius at which blades begin [m].", Double(0));
    prm.add("Blades",
            given_blades,
            "How many blades the rotor has; 0: as many as surfaces name this inflow.",
            Integer(0, 100));
    prm.add("Nodes", n_nodes, "Places along the radius at which there are circulations.", Integer(1, 100));
    prm.add("Core",
            core,
            "Radius of the cores of vortex lines; 0: three quarters of the distance between nodes [m].",
            Double(0));
    prm.add("Turns", turns, "How many turns of the wake there are.", Integer(1, 1000));
    prm.add("Segments", segments, "Straight segments of each turn of a vortex line.", Integer(6, 1000));
  }



  std::vector<std::pair<std::string, std::string>>
  HelicalWake::names_of_states(Model &)
  {
    if (speed == 0)
      throw std::invalid_argument("<Speed> is needed: a rotor that stands still has no helical wake");
    if (root >= radius)
      throw std::invalid_argument("<Root> is not less than <Radius>");
    if (core == 0)
      core = 0.75 * width();
    std::vector<std::pair<std::string, std::string>> names;
    for (unsigned int k = 0; k < n_nodes; ++k)
      names.emplace_back("circulation at r = " + number_to_text("%.4g", root + (k + 0.5) * width()), "m^2/s");
    return names;
  }



  template <typename Number>
  void
  HelicalWake::add_lines(const Vec3<Number> &x, const Flow<Number> &flow, Number *A) const
  {
    using std::sqrt;
    const unsigned int n_ages = turns * segments, Q = corrections.blades;
    const double       step = 2 * M_PI / segments, sense = speed > 0 ? 1 : -1, dt = step / std::abs(speed);
    const Number       r = sqrt(x(0) * x(0) + x(1) * x(1));

    thread_local VortexLine<Number>  line;
    thread_local std::vector<Number> cosine, sine;
    line.resize(n_ages + 1);
    cosine.resize(n_ages + 1);
    sine.resize(n_ages + 1);
    std::fill(A, A + 3 * n_nodes, Number(0));
    for (unsigned int q = 0; q < Q; ++q)
      {
        // along the blade, and how it stood before
        const double c_q = std::cos(2 * M_PI * q / Q), s_q = std::sin(2 * M_PI * q / Q);
        const Number c = (c_q * x(0) - s_q * x(1)) / r, s = (s_q * x(0) + c_q * x(1)) / r;
        for (unsigned int i = 0; i <= n_ages; ++i)
          {
            const double age = i * step, c_i = std::cos(age), s_i = -sense * std::sin(age);
            cosine[i] = c * c_i - s * s_i;
            sine[i]   = s * c_i + c * s_i;
            line.z[i] = -(flow(2) + transport) * (i * dt);
          }
        for (unsigned int j = 0; j <= n_nodes; ++j)
          {
            const double a = root + j * width();
            for (unsigned int i = 0; i <= n_ages; ++i)
              {
                line.x[i] = a * cosine[i] + flow(0) * (i * dt);
                line.y[i] = a * sine[i] + flow(1) * (i * dt);
              }
            // a trailing vortex has the difference of the circulations on both sides of it
            const Vec3<Number> v = sense * induced_velocity(x, line, core);
            for (unsigned int i = 0; i < 3; ++i)
              {
                if (j > 0) // the node within
                  A[3 * (j - 1) + i] += v(i);
                if (j < n_nodes)
                  A[3 * j + i] -= v(i);
              }
          }
      }
  }



  template <typename Number>
  std::pair<unsigned int, Number>
  HelicalWake::node_of(const Number &r) const
  {
    const Number at = (r - root) / width() - 0.5;
    if (std::real(at) <= 0)
      return {0, Number(0)};
    const unsigned int k = static_cast<unsigned int>(std::real(at));
    return k + 1 < n_nodes ? std::make_pair(k, Number(at - double(k))) : std::make_pair(n_nodes - 1, Number(0));
  }



  template <typename Number>
  void
  HelicalWake::circulation(const Vec3<Number> &x, Number *b) const
  {
    using std::sqrt;
    // Kutta & Joukowski: lift per length over ρ |Ω| r, shared between the two nodes beside the station
    const Number r = sqrt(x(0) * x(0) + x(1) * x(1)), unit = 1. / (air->density * std::abs(speed) * r);
    std::fill(b, b + n_nodes, Number(0));
    const auto [k, share] = node_of(r);
    b[k]                  = unit * (1. - share) / reach[k];
    if (k + 1 < n_nodes)
      b[k + 1] = unit * share / reach[k + 1];
  }



  void
  HelicalWake::connect(Layout &layout)
  {
    ExternalInflow::connect(layout);
    reach.assign(n_nodes, 0.);
    for (const auto &[x, length] : stations)
      {
        const auto [k, share] = node_of(x.head<2>().norm());
        reach[k] += (1 - share) * length;
        if (k + 1 < n_nodes)
          reach[k + 1] += share * length;
      }
    for (unsigned int k = 0; k < n_nodes && !stations.empty(); ++k)
      if (reach[k] < 1e-3 * width())
        throw InputError(parameters.where("Nodes") + ": no station of the blades is near the node of <" + name +
                         "> at r = " + number_to_text("%.4g", root + (k + 0.5) * width()) +
                         " m: give the surfaces more <Stations>, or the wake fewer <Nodes>");
  }



  std::vector<Doubt>
  HelicalWake::doubts(const State &state) const
  {
    const auto         point  = state.point();
    const Vector3      e3     = hub.triad(point.q).col(2);
    const auto         text   = [](const double x) { return number_to_text("%.3g", x); };
    std::vector<Doubt> result = Inflow::doubts(state);
    for (const auto *surface : surfaces)
      {
        const Frame  frame = surface->carrier();
        const double spin  = e3.dot(frame.triad(point.q) * frame.twist(point.y).tail<3>());
        if (std::abs(spin - speed) > 0.02 * std::abs(speed))
          {
            result.push_back({"speed",
                              "the blades of <" + name + "> turn with " + text(spin) +
                                " rad/s about its thrust axis, and its wake was left with <Speed>, " + text(speed) +
                                " rad/s: it is another rotor's"});
            break;
          }
      }
    if (const double w = mean(state);
        std::abs(w) > 1e-3 * std::abs(speed) * radius && std::abs(w - transport) > 0.3 * std::abs(transport))
      result.push_back({"transport",
                        "the wake of <" + name + "> leaves with <Transport>, " + text(transport) +
                          " m/s, and induces " + text(w) + " m/s on the disk: the two should be about the same"});
    return result;
  }



  double
  HelicalWake::mean(const State &state) const
  {
    const auto          point = state.point();
    std::vector<double> z;
    for (const unsigned int k : states)
      z.push_back(point.states[k]);
    const Flow<double> flow =
      flow_through_disk(hub.position(point.q), hub.triad(point.q), hub.twist(point.y), z.data(), 0., point.time);
    double             sum = 0;
    const unsigned int n   = 20;
    for (unsigned int i = 0; i < n; ++i) // rings of equal area
      sum -= velocity<double>(Vector3(radius * std::sqrt((i + 0.5) / n), 0., 0.), flow, z.data())(2) / n;
    return sum;
  }
} // namespace samara
