// What slides along flexible beams in motion, against solutions that share nothing with it: a mass that crosses a
// bridge, a beam that is pushed out of a guide and drawn in, beads that friction brakes, orders of the abscissa, steps
// across many ends of elements, and motions that are awkward.

#include <samara/analysis/dynamic.h>
#include <samara/time/projection.h>
#include <samara/time/stage_integrator.h>
#include <samara/time/stepper.h>

#include "../reference.h"
#include "../scene.h"
#include <gtest/gtest.h>

using namespace samara;

namespace
{
  /** A beam of 1 kg/m along x, called rod, a bead on it, and what holds them. */
  struct BeadOnBeam
  {
    std::string  EA = "400", EI = "8", inertia = "0.01", points = "0, 0, 0; 2, 0, 0", rod = " set Elements = 4\n";
    std::string  mass = "0.5", place = "0.3, 0, 0", bead, kind = "point", slider, displacement, bodies, joints, loads;
    double       end = 0.1, step = 0.01, radius = 1;
    unsigned int stages = 2;
    std::string  dynamic;

    std::string
    text() const
    {
      return "subsection Sections\n subsection s\n set Type = engineering constants\n set EA = " + EA +
             "\n set GA2 = " + EA + "\n set GA3 = " + EA + "\n set GJ = " + EI + "\n set EI2 = " + EI +
             "\n set EI3 = " + EI + "\n set Mass = 1\n set I2 = " + inertia + "\n set I3 = " + inertia +
             "\n end\nend\nsubsection Bodies\n subsection rod\n set Type = beam\n set Section = s\n set Points = " +
             points + "\n" + rod + " end\n subsection bead\n set Type = rigid body\n set Mass = " + mass +
             "\n set Inertia = 0.1, 0.1, 0.1\n set Position = " + place + "\n" + bead + " end\n" + bodies +
             "end\nsubsection Joints\n" + joints + " subsection slide\n set Type = sliding " + kind +
             "\n set Body A = rod\n set Body B = bead\n" + slider + " subsection displacement\n" + displacement +
             " end\n end\nend\nsubsection Loads\n" + loads + "end\nset Analyses = dynamic\nsubsection Dynamic\n" +
             " set End time = " + number_to_text(end) + "\n set Step = " + number_to_text(step) +
             "\n set Stages = " + std::to_string(stages) + "\n set Spectral radius = " + number_to_text(radius) +
             "\n set Newton tolerance = 1e-12\n" + dynamic + "end\n";
    }

    std::unique_ptr<Scene>
    run(const std::function<void(const Scene &, const State &)> &observe = nullptr) const
    {
      auto  scene    = std::make_unique<Scene>(text());
      auto &analysis = scene->analysis<DynamicAnalysis>();
      analysis.start(scene->context);
      if (observe)
        analysis.observer = [&](const State &state) { observe(*scene, state); };
      analysis.run(scene->context);
      return scene;
    }
  };

  const std::string hinge_of_rod =
    " subsection hinge\n set Type = revolute\n set Body A = ground\n set Body B = rod.start\n set Axis = 0, 0, 1\n end\n";
  const std::string clamp_of_rod =
    " subsection clamp\n set Type = rigid\n set Body A = ground\n set Body B = rod.start\n end\n";

  double
  abscissa(const Scene &scene, const State &state)
  {
    return scene.input.model.probe("slide.arc length").value(state);
  }

  /** A soft beam on a hinge that nobody drives, and a bead with 6 m/s. */
  BeadOnBeam
  soft_beam()
  {
    BeadOnBeam b;
    b.rod    = " set Elements = 4\n set Degree = 2\n set Angular velocity = 0, 0, 2\n";
    b.joints = hinge_of_rod;
    b.place  = "0.451, 0, 0";
    b.bead   = " set Velocity = 6, 0.9, 0\n";
    return b;
  }
} // namespace



// A mass of half the beam's crosses a bridge: middle and mass against the equations of up to 80 modes, extrapolated.
TEST(SlidingInMotion, MassOnABridge)
{
  BeadOnBeam b;
  b.EA           = "1e10";
  b.EI           = "40";
  b.inertia      = "1e-9";
  b.rod          = " set Elements = 10\n set Degree = 6\n";
  b.place        = "0, 0, 0";
  b.bead         = " set Velocity = 3, 0, 0\n";
  b.displacement = " set Prescribed = 3*t\n";
  b.joints =
    " subsection left\n set Type = revolute\n set Body A = ground\n set Body B = rod.start\n set Axis = 0, 1, 0\n end\n"
    " subsection right\n set Type = in line\n set Body A = ground\n set Body B = rod.end\n set Axis = 1, 0, 0\n end\n";
  b.loads              = " subsection push\n set Type = point load\n set At = bead\n set Force = 0, 0, -5e-3\n end\n";
  b.end                = 0.2;
  b.step               = 0.001;
  b.stages             = 3;
  const auto   rows    = reference_rows("beams/mass_on_a_bridge.csv");
  const auto   scene   = b.run();
  const double largest = std::abs(std::stod(rows.back().at("middle")));
  for (const auto &row : rows)
    if (std::abs(std::stod(row.at("t")) - b.end) < 1e-9)
      {
        EXPECT_NEAR(scene->value("rod.middle.position z"), std::stod(row.at("middle")), 1e-6 * largest);
        EXPECT_NEAR(scene->value("bead.position z"), std::stod(row.at("mass")), 1e-6 * largest);
        return;
      }
  FAIL();
}



namespace
{
  /**
   * A beam of 1 kg/m and 40 N m² that comes out of a guide with the speed v, under a force at its end that is small and
   * constant: w = Σ q_n(t) φ_n(x/l), l = l₀ + v t, with the modes of a cantilever, by Hamilton's equations of
   * T = ½ m ∫ (∂w/∂t + v ∂w/∂x)² dx (Tabarrok, Leech & Kim, J. Franklin Inst. 297 (1974) 201), method of Runge and
   * Kutta.
   */
  class ComingOut
  {
  public:
    static constexpr unsigned int N = 8;
    using Vector                    = Eigen::Matrix<double, N, 1>;
    using Matrix                    = Eigen::Matrix<double, N, N>;

    ComingOut(const double length, const double v, const double force)
      : l0(length)
      , v(v)
      , force(force)
    {
      for (unsigned int n = 0; n < N; ++n)
        {
          double x = n == 0 ? 1.875 : (n + 0.5) * M_PI;
          for (unsigned int i = 0; i < 50; ++i)
            x += (std::cos(x) + 1 / std::cosh(x)) / (std::sin(x) + std::tanh(x) / std::cosh(x));
          beta(n) = x;
        }
      constexpr unsigned int intervals = 2000; // midpoint rule, its error 1e-6 of the highest mode's
      G.setZero();
      H.setZero();
      for (unsigned int i = 0; i < intervals; ++i)
        {
          const double xi         = (i + 0.5) / intervals;
          const auto [phi, slope] = at(xi);
          G += phi * slope.transpose() * (1 - xi) / intervals;
          H += slope * slope.transpose() * std::pow(1 - xi, 2) / intervals;
        }
      tip = at(1).first;
    }

    /** Deflection of the end [m], and what the guide's drive has done [J], at the time T. */
    std::pair<double, double>
    after(const double T) const
    {
      Vector                 q = Vector::Zero(), p = Vector::Zero();
      constexpr unsigned int steps = 4000;
      const double           h     = T / steps;
      for (unsigned int i = 0; i < steps; ++i)
        {
          const auto rates = [&](const double t, const Vector &a, const Vector &b) {
            const double l  = l0 + v * t;
            const Vector qd = b / l - v / l * (G * a);
            return std::pair<Vector, Vector>(qd,
                                             l * (v / l * (G.transpose() * qd) + v * v / (l * l) * (H * a)) -
                                               EI / (l * l * l) * beta.array().pow(4).matrix().cwiseProduct(a) +
                                               force * tip);
          };
          const double t          = i * h;
          const auto [qd_1, pd_1] = rates(t, q, p);
          const auto [qd_2, pd_2] = rates(t + h / 2, q + h / 2 * qd_1, p + h / 2 * pd_1);
          const auto [qd_3, pd_3] = rates(t + h / 2, q + h / 2 * qd_2, p + h / 2 * pd_2);
          const auto [qd_4, pd_4] = rates(t + h, q + h * qd_3, p + h * pd_3);
          q += h / 6 * (qd_1 + 2 * qd_2 + 2 * qd_3 + qd_4);
          p += h / 6 * (pd_1 + 2 * pd_2 + 2 * pd_3 + pd_4);
        }
      const double l      = l0 + v * T;
      const Vector qd     = p / l - v / l * (G * q);
      const double energy = 0.5 * l * (qd.dot(qd) + 2 * v / l * qd.dot(G * q) + v * v / (l * l) * q.dot(H * q)) +
                            0.5 * EI / (l * l * l) * beta.array().pow(4).matrix().cwiseProduct(q).dot(q);
      return {tip.dot(q), energy - force * tip.dot(q)};
    }

  private:
    static constexpr double EI = 40;
    const double            l0, v, force;
    Vector                  beta, tip;
    Matrix                  G, H;

    /** Modes and their slopes, without differences of large numbers. */
    std::pair<Vector, Vector>
    at(const double xi) const
    {
      Vector phi, slope;
      for (unsigned int n = 0; n < N; ++n)
        {
          const double b = beta(n), z = b * xi, s = (std::cosh(b) + std::cos(b)) / (std::sinh(b) + std::sin(b));
          phi(n)   = std::exp(-z) + (1 - s) * std::sinh(z) - std::cos(z) + s * std::sin(z);
          slope(n) = b * (-std::exp(-z) + (1 - s) * std::cosh(z) + std::sin(z) + s * std::cos(z));
        }
      return {phi, slope};
    }
  };
} // namespace



// A beam that is pushed out of a fixed guide, and one that is drawn in: its end, and the work of the drive against
// EI κ²/2 at the guide. Within an element the curvature cannot jump: errors go with the size of elements.
TEST(SlidingInMotion, TelescopingBeam)
{
  for (const double v : {1., -1.})
    {
      const ComingOut exact(v > 0 ? 1 : 1.3, v, 1e-3);
      const double    T = 0.3, largest = 1.5e-5;
      const auto [w, work] = exact.after(T);
      std::vector<double> errors;
      for (const unsigned int n : {8u, 24u})
        {
          BeadOnBeam b;
          b.EA      = "1e8";
          b.EI      = "40";
          b.inertia = "1e-8";
          b.points  = v > 0 ? "-1, 0, 0; 1, 0, 0" : "-1, 0, 0; 1.3, 0, 0";
          b.rod = " set Elements = " + std::to_string(n) + "\n set Degree = 3\n set Velocity = " + number_to_text(v) +
                  ", 0, 0\n";
          b.place  = "0, 0, 0";
          b.kind   = "prismatic";
          b.joints = " subsection post\n set Type = rigid\n set Body A = ground\n set Body B = bead\n end\n";
          b.loads  = " subsection push\n set Type = point load\n set At = rod.end\n set Force = 0, 0, 1e-3\n end\n";
          b.displacement       = " set Prescribed = " + number_to_text(-v) + "*t\n";
          b.end                = T;
          b.step               = 0.01;
          b.stages             = 3;
          const auto  scene    = b.run();
          const auto &analysis = scene->analysis<DynamicAnalysis>();
          errors.push_back(std::abs(scene->value("rod.end.position z") - w));
          EXPECT_LT(analysis.report.largest_balance, 1e-12);
          if (n == 24)
            {
              EXPECT_NEAR(analysis.budget.drives / work, 1, 0.07) << v;
            }
        }
      EXPECT_LT(errors[1], 0.025 * largest) << v;
      EXPECT_LT(errors[1], 0.5 * errors[0]) << v;
    }
}



// On a wire across gravity, N = m g, whatever acts along it: a spring with k/m = ω² is slower by 2 μ g/ω² in each half
// of a period, π/ω, and without it a bead goes v²/(2 μ g). All it had is friction loss; bristles hold it, without
// creep.
TEST(SlidingInMotion, FrictionOfReactions)
{
  constexpr double g = 9.80665, mu = 0.2;
  BeadOnBeam       b;
  b.rod    = " set Rigid = true\n set Elements = 1\n";
  b.points = "0, 0, 0; 4, 0, 0";
  b.joints = clamp_of_rod;
  b.place  = "2, 0, 0";
  b.loads  = " subsection weight\n set Type = gravity\n end\n";
  for (const unsigned int s : {1u, 2u, 3u})
    {
      BeadOnBeam spring   = b;
      spring.displacement = " set Friction = 0.2\n set Sticking speed = 1e-6\n set Spring = 20\n set Rest = 0.8\n";
      const double omega = std::sqrt(40.), period = 2 * M_PI / omega;
      spring.end       = 0.5 * period;
      spring.step      = spring.end / 60;
      spring.radius    = s == 1 ? 1 : 0.5;
      spring.stages    = s;
      const auto scene = spring.run();
      // from −0.8 to 0.8 − 2 μ g/ω², seen from where the spring is free
      EXPECT_NEAR(scene->value("slide.displacement"), 1.6 - 2 * mu * g / 40, s == 1 ? 2e-3 : 2e-4) << s;
      const auto &budget = scene->analysis<DynamicAnalysis>().budget;
      EXPECT_NEAR(budget.friction, mu * 0.5 * g * scene->value("slide.displacement"), 1e-3) << s;
      EXPECT_LT(scene->analysis<DynamicAnalysis>().report.largest_balance, 1e-12);
    }
  for (const std::string sticking : {" set Sticking speed = 1e-6\n",
                                     " set Bristle stiffness = 1e5\n"
                                     " set Bristle damping = 100\n"})
    {
      BeadOnBeam thrown   = b;
      thrown.bead         = " set Velocity = 1.5, 0, 0\n";
      thrown.displacement = " set Friction = 0.2\n" + sticking;
      thrown.end          = 1.5;
      thrown.radius       = 0.5;
      const auto scene    = thrown.run();
      EXPECT_NEAR(scene->value("slide.displacement"), 2.25 / (2 * mu * g), 2e-3) << sticking;
      EXPECT_LT(std::abs(scene->value("slide.displacement rate")), 1e-7) << sticking;
      const auto &budget = scene->analysis<DynamicAnalysis>().budget;
      EXPECT_NEAR(budget.friction + budget.dissipated, 0.25 * 2.25, 1e-4) << sticking;
    }
}



// Round a hoop without weight N = m v²/R: v = v₀/(1 + μ v₀ t/R), on a beam that is a quarter of a circle.
TEST(SlidingInMotion, FrictionOnAHoop)
{
  for (const unsigned int s : {2u, 3u})
    {
      BeadOnBeam b;
      b.rod    = " set Shape = arc\n set Rigid = true\n set Elements = 6\n set Degree = 4\n set Axis 2 = 0, 0, 1\n";
      b.points = "1, 0, 0; 0.70710678118654752, 0.70710678118654752, 0; 0, 1, 0";
      b.place  = "1, 0, 0";
      b.bead   = " set Velocity = 0, 2, 0\n";
      b.joints = clamp_of_rod;
      b.displacement     = " set Friction = 0.3\n set Sticking speed = 1e-6\n";
      b.end              = 0.7;
      b.step             = 0.01;
      b.stages           = s;
      const auto   scene = b.run();
      const double way   = std::log(1 + 0.3 * 2 * b.end) / 0.3;
      EXPECT_NEAR(scene->value("slide.arc length"), way, 1e-4) << s;
      EXPECT_NEAR(scene->value("slide.displacement rate"), 2 / (1 + 0.3 * 2 * b.end), 5e-3) << s;
      EXPECT_LT(scene->analysis<DynamicAnalysis>().report.largest_balance, 1e-11);
    }
}



// Abscissa and places on a soft beam of one element: orders 2, 4, 6 without dissipation, 1, 3, 5 with it.
TEST(SlidingInMotion, OrdersOfTheAbscissa)
{
  const auto values = [](const unsigned int s, const double radius, const double h) {
    BeadOnBeam b     = soft_beam();
    b.inertia        = "0.3"; // nothing faster than these steps
    b.rod            = " set Elements = 1\n set Degree = 3\n set Angular velocity = 0, 0, 4\n";
    b.bead           = " set Velocity = 3, 1.804, 0\n";
    b.stages         = s;
    b.radius         = radius;
    b.end            = 0.32;
    b.step           = h;
    const auto scene = b.run();
    return std::array<double, 2>{scene->value("slide.arc length"), scene->value("bead.position y")};
  };
  const auto exact = values(3, 1, 0.0016);
  for (const unsigned int s : {1u, 2u, 3u})
    for (const double radius : {1., 0.})
      {
        const double h = s == 3 && radius == 1 ? 0.016 : 0.008; // above round-off
        const auto   a = values(s, radius, h), b = values(s, radius, h / 2);
        for (unsigned int i = 0; i < 2; ++i)
          EXPECT_NEAR(std::log2(std::abs(a[i] - exact[i]) / std::abs(b[i] - exact[i])),
                      2. * s - (radius < 1 ? 1 : 0),
                      0.45)
            << "s = " << s << ", rho = " << radius << (i == 0 ? ", S" : ", y");
      }
}



namespace
{
  /** The largest violation of a constraint. */
  double
  gap_of_rows(const System &system, const State &state)
  {
    std::vector<double> r(system.size() + 6, 0.);
    State               free = state;
    free.held                = false;
    system.add_gaps(free.point(), r.data());
    double gap = 0;
    for (unsigned int i = 0; i < system.layout.n_multipliers; ++i)
      gap = std::max(gap, std::abs(r[system.layout.of_multiplier(i)]));
    return gap;
  }

  /** The abscissa of the soft beam's bead at @p T, by a stepper, which looks at ends of elements, or by the integrator
   * alone; @p observe is called with it after each step. */
  double
  abscissa_after(
    const double                               T,
    const double                               h,
    const unsigned int                         s,
    const bool                                 with_events,
    const std::function<void(const double S)> &observe = [](double) {})
  {
    Scene           scene(soft_beam().text());
    StageIntegrator integrator(scene.system, Tableau(s, 1.), 1e-13);
    Stepper         stepper(scene.system, integrator, h, 1e-9);
    State           state = scene.system.reference();
    scene.system.add_initial_velocities(state);
    Projection(scene.system).velocities(state);
    if (with_events)
      while (state.time < T)
        {
          const double  before  = scene.system.energy(state).kinetic + scene.system.energy(state).strain;
          const Advance advance = stepper.advance(state, T);
          const auto    energy  = scene.system.energy(state);
          // what keeps the work of rows that are not quadratic fades out where a step moves by 1e-7 of the model, and
          // close to an end such steps may happen
          const double allowed = advance.h < 1e-6 ? 1e-9 : 1e-11;
          EXPECT_LT(std::abs(energy.kinetic + energy.strain - before + advance.step.dissipated), allowed * before);
          EXPECT_LT(gap_of_rows(scene.system, state), 1e-12);
          observe(abscissa(scene, state));
        }
    else
      for (unsigned int i = 0; i < std::lround(T / h); ++i)
        EXPECT_TRUE(integrator.step(state, h).converged);
    return abscissa(scene, state);
  }
} // namespace



// Steps end on both sides of each end of an element, also where one step would pass three of them. Steps that go across
// as they like are less exact, and do not become better with their order.
TEST(SlidingInMotion, StepsEndWhereElementsDo)
{
  constexpr double T = 0.2, width = 1.02e-4 * 0.5;
  for (const double h : {0.01, 0.2})
    {
      std::array<std::array<unsigned int, 2>, 3> n{};
      abscissa_after(T, h, 3, true, [&](const double S) {
        for (unsigned int i = 0; i < 3; ++i)
          if (const double off = S - 0.5 * (i + 1); std::abs(off) < width)
            ++n[i][off > 0];
      });
      for (unsigned int i = 0; i < 3; ++i)
        for (const unsigned int steps : n[i])
          EXPECT_GE(steps, 1u) << h << " " << i;
    }
  const double        exact = abscissa_after(T, 0.00125, 3, true);
  std::vector<double> events, across;
  for (const double h : {0.01, 0.005, 0.0025})
    {
      events.push_back(std::abs(abscissa_after(T, h, 3, true) - exact));
      across.push_back(std::abs(abscissa_after(T, h, 3, false) - exact));
    }
  EXPECT_GT(std::log2(events[0] / events[2]) / 2, 5);
  EXPECT_LT(events[2], 1e-8);
  EXPECT_GT(across[2], 1e-5);
}



// What the energy misses in a step across an end of an element is what Newton's method leaves, and no more: with a
// tolerance of 1e-15 it is round-off, in the steps to an end, within its range and behind as within elements. (Energies
// of this soft beam, with strains of differences of places, are known to 1e-14.)
TEST(SlidingInMotion, EnergyOfStepsAcrossEnds)
{
  for (const unsigned int s : {2u, 3u})
    {
      Scene           scene(soft_beam().text());
      StageIntegrator integrator(scene.system, Tableau(s, 1.), 1e-15);
      Stepper         stepper(scene.system, integrator, 0.01, 1e-9);
      State           state = scene.system.reference();
      scene.system.add_initial_velocities(state);
      Projection(scene.system).velocities(state);
      unsigned int n_across = 0;
      double       worst = 0, worst_across = 0;
      while (state.time < 0.2)
        {
          const auto energy_of = [&]() {
            return scene.system.energy(state).kinetic + scene.system.energy(state).strain;
          };
          const double before = energy_of(), S = abscissa(scene, state);
          stepper.advance(state, 0.2);
          const double error     = std::abs(energy_of() / before - 1);
          bool         is_across = false;
          for (const double end : {0.5, 1., 1.5})
            is_across = is_across || (S < end && abscissa(scene, state) > end);
          n_across += is_across;
          (is_across ? worst_across : worst) = std::max(error, is_across ? worst_across : worst);
        }
      EXPECT_EQ(n_across, 3u) << s;
      EXPECT_LT(worst_across, 1e-13) << s;
      EXPECT_LT(worst, 1e-13) << s;
    }
}



// What is awkward: a bead that comes to an end of an element, turns there and goes back, and one that rests there.
TEST(SlidingInMotion, TurnsBackAtAnEndOfAnElement)
{
  // on a spring about 0.8 m: from 0.6 to exactly 1 m, where elements meet, and back
  for (const double beyond : {-1e-5, 0., 1e-5})
    {
      BeadOnBeam b;
      b.rod               = " set Rigid = false\n set Elements = 2\n set Degree = 2\n";
      b.EA                = "1e7";
      b.EI                = "1e5";
      b.joints            = clamp_of_rod;
      b.place             = "0.6, 0, 0";
      b.displacement      = " set Spring = 50\n set Rest = " + number_to_text(0.2 + beyond / 2) + "\n";
      b.stages            = 3;
      b.end               = 2 * M_PI / 10;
      b.step              = b.end / 40;
      double     farthest = 0;
      const auto scene =
        b.run([&](const Scene &model, const State &state) { farthest = std::max(farthest, abscissa(model, state)); });
      EXPECT_NEAR(farthest, 1 + beyond, 1e-6) << beyond;
      EXPECT_NEAR(scene->value("slide.arc length"), 0.6, 1e-6) << beyond;
      EXPECT_LT(scene->analysis<DynamicAnalysis>().report.largest_balance, 1e-11);
    }
}



// 200 m/s along a soft beam that turns, two beads in one element that pass each other, and adaptive steps: energy and
// constraints hold, and the motion is that of short steps.
TEST(SlidingInMotion, FastAndTwoInOneElement)
{
  BeadOnBeam fast  = soft_beam();
  fast.bead        = " set Velocity = 200, 0.9, 0\n";
  fast.end         = 0.0075;
  fast.step        = 0.005;
  fast.stages      = 3;
  const auto flown = fast.run();
  EXPECT_LT(flown->analysis<DynamicAnalysis>().report.largest_balance, 1e-12);
  EXPECT_NEAR(flown->value("slide.arc length"), 0.451 + 1.5, 0.02);

  BeadOnBeam two = soft_beam();
  two.rod        = " set Elements = 1\n set Degree = 3\n set Angular velocity = 0, 0, 2\n";
  two.bead       = " set Velocity = 2, 0.9, 0\n";
  two.bodies     = " subsection other\n set Type = rigid body\n set Mass = 0.3\n set Inertia = 0.1, 0.1, 0.1\n"
                   " set Position = 1.2, 0, 0\n set Velocity = -2, 2.4, 0\n end\n";
  two.joints += " subsection second\n set Type = sliding point\n set Body A = rod\n set Body B = other\n end\n";
  two.end             = 0.3;
  two.stages          = 3;
  two.step            = 0.002;
  const auto exact    = two.run();
  two.step            = 0.01;
  two.dynamic         = " set Tolerance = 1e-5\n";
  const auto adaptive = two.run();
  EXPECT_GT(exact->value("slide.arc length"), exact->value("second.arc length"));
  for (const char *probe : {"slide.arc length", "second.arc length", "bead.position y", "rod.end.position y"})
    EXPECT_NEAR(adaptive->value(probe), exact->value(probe), 1e-4) << probe;
  EXPECT_LT(adaptive->analysis<DynamicAnalysis>().report.largest_balance, 1e-11);
}
