#include <samara/aero/annular_inflow.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  Eigen::Matrix<double, 5, AnnularMomentum::n_inputs>
  AnnularMomentum::derivatives(const Place<double> &at,
                               const Vector3       &relative,
                               const Vector3       &f,
                               const double         width) const
  {
    using Complex         = std::complex<double>;
    constexpr double step = 1e-30;

    Eigen::Matrix<double, 5, n_inputs> J;
    for (unsigned int k = 0; k < n_inputs; ++k)
      {
        Place<Complex> p;
        p.x              = at.x.cast<Complex>();
        p.free           = at.free.cast<Complex>();
        p.w              = at.w;
        p.v              = at.v;
        Vec3<Complex>  a = relative.cast<Complex>(), g = f.cast<Complex>();
        Complex *const inputs[n_inputs] = {
          &p.x(0), &p.x(1), &p.free(0), &p.free(1), &p.free(2), &p.w, &p.v, &a(0), &a(1), &a(2), &g(0), &g(1), &g(2)};
        *inputs[k] += Complex(0, step);
        J.col(k).head<3>() = k < 7 ? Vector3(induced(p).imag() / step) : Vector3(Vector3::Zero());
        const auto r       = rates(p, a, g, width);
        J(3, k)            = r[0].imag() / step;
        J(4, k)            = r[1].imag() / step;
      }
    return J;
  }



  void
  AnnularInflow::add_parameters(Parameters &prm)
  {
    using namespace dealii::Patterns;
    Inflow::add_parameters(prm);
    prm.add("Blades",
            given_blades,
            "How many blades the rotor has; 0: as many as surfaces name this inflow.",
            Integer(0, 100));
    prm.add("Tip loss",
            tip_loss,
            "What the flow round tips costs: Prandtl's factor of the momentum, or nothing.",
            Selection("Prandtl|none"));
    prm.add("Root",
            theory.root,
            "Radius at which blades begin, for Prandtl's factor there; 0: no loss at roots [m].",
            Double(0));
    prm.add("Swirl", theory.has_swirl, "Whether the torque of the blades turns the air.");
    prm.add("Skew",
            skew,
            "How inflow grows downwind where air comes from the side: by Pitt and Peters, or not.",
            Selection("Pitt-Peters|none"));
    prm.add("Apparent mass",
            theory.apparent_mass,
            "Of an annulus, divided by density, area and the radius of the disk: how slowly inflow follows loads [1].",
            Double(1e-12));
    prm.add("Ground effect",
            ground_effect,
            "There is none: annuli know nothing of each other, and the ground acts on the flow of the whole disk.",
            Selection("none|Cheeseman-Bennett"));
    prm.add("Initial", initial, "Inflow of all stations at the start; statics find theirs [m/s].");
  }



  void
  AnnularInflow::initialize(Model &model)
  {
    Inflow::initialize(model);
    theory.has_tip_loss = tip_loss == "Prandtl";
    theory.has_skew     = skew == "Pitt-Peters";
    theory.radius       = radius;
    if (radius > 0 && theory.root >= radius)
      model.complaints.add(parameters.where("Root"), "the radius of the root is not less than that of the disk");
    if (ground_effect != "none")
      model.complaints.add(parameters.where("Ground effect"),
                           "<" + name +
                             "> is an annular inflow, whose annuli know nothing of each other: the ground acts on the "
                             "flow of the whole disk, which <uniform inflow>, <Pitt-Peters inflow> and <Peters-He "
                             "inflow> have");
    if (air == nullptr)
      return;
    theory.density     = air->density;
    theory.least_speed = 1e-12 * air->speed_of_sound;
  }



  void
  AnnularInflow::connect(Layout &layout)
  {
    Inflow::connect(layout);
    theory.blades = given_blades > 0 ? given_blades : std::max<std::size_t>(1, surfaces.size());
  }



  void
  AnnularInflow::add_station(const unsigned int state, const double r, const double width)
  {
    Assert(r > 0 && width > 0, dealii::ExcMessage("An annulus has an area."));
    annuli.push_back({state, r * width});
  }



  std::vector<Doubt>
  AnnularInflow::doubts(const State &state) const
  {
    std::vector<Doubt> result = Inflow::doubts(state);
    const Matrix3      H      = hub.triad(state.q.data());
    const Vector3      u =
      H.transpose() * (air->wind(hub.position(state.q.data()), state.time) - H * hub.twist(state.y.data()).head<3>());
    const double R = radius_at(state.time), thrust = surfaces.empty() ? 0. : H.col(2).dot(loads(state).force);
    if (thrust * u(2) > 0) // the air comes from where the wake goes
      {
        const auto   text  = [](const double x) { return number_to_text("%.3g", x); };
        const double hover = std::sqrt(std::abs(thrust) / (2 * air->density * M_PI)) / R,
                     ratio = std::abs(u(2)) / hover;
        // C_T = 2 at the square root of two: no air passes the disk any more
        if (ratio > 0.3 && ratio < std::sqrt(2.) && u.head<2>().norm() < hover)
          result.push_back({"vortex rings",
                            "the air meets the wake of <" + name + "> with " + text(std::abs(u(2))) + " m/s, " +
                              text(ratio) +
                              " of its flow in hover: from 0.3 to 1.4 there are vortex rings, which annular momentum "
                              "bridges and does not describe. Results may be wrong there"});
      }
    return result;
  }



  double
  AnnularInflow::mean(const State &state) const
  {
    double sum = 0, area = 0;
    for (const auto &annulus : annuli)
      {
        sum += annulus.area * state.states[annulus.state];
        area += annulus.area;
      }
    return area > 0 ? sum / area : 0.;
  }
} // namespace samara
