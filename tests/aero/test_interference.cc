// Rotors that feel each other's mean flow, the mass of the mean flow, and the bound of the wake's skew.

#include <samara/aero/finite_state.h>
#include <samara/time/projection.h>
#include <samara/time/stage_integrator.h>

#include "../complex_step.h"
#include "../scene.h"
#include "../time/systems.h"
#include <gtest/gtest.h>

#include "models.h"

using namespace samara;
using namespace samara::aero_models;

namespace
{
  const double rho = 1.225, disk_area = M_PI * 9;

  /** Of a rotor and its inflow, whose names end with @p name. */
  struct CoaxialRotor
  {
    std::string name, inflow, entries; ///< entries of the inflow
    double      collective = 12;       ///< at the axis [deg]
    int         sense      = 1;        ///< of the rotation about z
  };

  /** Two-bladed rotors about one axis that turn steadily with 30 rad/s; rigid blades from 0.6 to 3 m. */
  std::string
  coaxial(const std::vector<CoaxialRotor> &rotors, const std::string &wind = "0, 0, 0", const std::string &more = "")
  {
    std::string bodies, joints, loads, aerodynamics = air(wind, "    set Ground = -6\n"), surfaces;
    for (const auto &rotor : rotors)
      {
        const std::string body = "rotor" + rotor.name;
        bodies += subsection(body,
                             "    set Type = rigid body\n    set Mass = 5\n    set Inertia = 2, 2, 4\n"
                             "    set Angular velocity = 0, 0, " +
                               std::to_string(30 * rotor.sense) + "\n");
        joints += subsection("shaft" + rotor.name,
                             "    set Type = revolute\n    set Body A = ground\n    set Body B = " + body +
                               ".centre\n    set Axis = 0, 0, " + std::to_string(rotor.sense) + "\n");
        loads +=
          subsection("turning" + rotor.name,
                     "    set Type = steady rotation\n    set Joint = shaft" + rotor.name + "\n    set Speed = 30\n");
        aerodynamics += subsection("flow" + rotor.name,
                                   "    set Type = " + rotor.inflow + "\n    set Hub = " + body +
                                     ".centre\n    set Axis = 0, 0, 1\n    set Radius = 3\n" + rotor.entries);
        for (const int end : {1, -1})
          surfaces += subsection(
            "blade " + std::to_string(end) + rotor.name,
            "    set Body = " + body + "\n    set Line = " + number_to_text(0.6 * end) + ", 0, 0; " +
              number_to_text(3. * end) + ", 0, 0\n    set Leading edge = 0, " + std::to_string(end * rotor.sense) +
              ", 0\n    set Upper side = 0, 0, 1\n    set Chord = 0.2\n    set Twist = " +
              number_to_text(rotor.collective) +
              " deg - 1.5 deg*s\n    set Airfoils = plain\n    set Unsteady = quasi-steady\n    set Inflow = flow" +
              rotor.name + "\n");
      }
    return subsection("Bodies", bodies) + subsection("Joints", joints) + subsection("Loads", loads) + airfoils() +
           subsection("Aerodynamics", aerodynamics + more) + subsection("Surfaces", surfaces);
  }

  std::string
  feels(const std::string &other, const double factor)
  {
    return "    set Interference = " + other + "\n    set Interference factors = " + number_to_text(factor) + "\n";
  }

  const std::vector<std::string> kinds = {"uniform inflow",
                                          "Pitt-Peters inflow",
                                          "Peters-He inflow\n    set Harmonics = 0\n    set Power = 0"};

  /** w̄ over the mean flow of momentum theory in hover: 9/8 where the pressure has one shape. */
  double
  disk_average(const std::string &inflow)
  {
    return inflow.find("Peters-He") == std::string::npos ? 1. : 9. / 8;
  }
} // namespace



// Two rotors in one plane, each in the whole flow of the other: together they have the momentum of one that makes both
// thrusts, T = 2ρA (v₁ + v₂) v₁, and √2 times the induced power of two that are alone.
TEST(Interference, CoaxialRotorsByMomentum)
{
  for (const auto &inflow : kinds)
    for (const double climb : {0., 3.})
      {
        const double one = 1 / disk_average(inflow);
        Scene        scene(coaxial({{" a", inflow, feels("flow b", one)}, {" b", inflow, feels("flow a", one), 12, -1}},
                            "0, 0, " + number_to_text(-climb)));
        scene.equilibrium();
        const double T = scene.value("flow a.thrust"), v = scene.value("flow a.mean");
        EXPECT_GT(T, 100.);
        EXPECT_NEAR(scene.value("flow b.thrust"), T, 1e-8 * T) << inflow;
        EXPECT_NEAR(T, 2 * rho * disk_area * (climb + 2 * v) * v, (climb > 0 ? 1e-6 : 1e-8) * T) << inflow;
        if (inflow == "uniform inflow" && climb == 0)
          {
            EXPECT_NEAR(scene.value("flow a.induced power"),
                        std::sqrt(2.) * T * std::sqrt(T / (2 * rho * disk_area)),
                        1e-8 * T * v);
          }
      }
}



// An upper rotor that knows nothing of the lower one, which is in 1.4 times its flow.
TEST(Interference, LowerRotorInTheWakeOfTheUpper)
{
  for (const auto &inflow : kinds)
    {
      Scene scene(coaxial({{" a", inflow, ""}, {" b", inflow, feels("flow a", 1.4), 13, -1}}));
      scene.equilibrium();
      Scene alone(coaxial({{" a", inflow, ""}}));
      alone.equilibrium();
      const double T_a = scene.value("flow a.thrust"), T_b = scene.value("flow b.thrust"),
                   v_a = scene.value("flow a.mean"), v_b = scene.value("flow b.mean");
      EXPECT_NEAR(T_a, alone.value("flow a.thrust"), 1e-9 * T_a);
      EXPECT_NEAR(T_b, 2 * rho * disk_area * (v_b + 1.4 * disk_average(inflow) * v_a) * v_b, 1e-8 * T_b) << inflow;
      EXPECT_LT(v_b, 0.8 * v_a);
    }
}



// A flow that is given is felt as one that is found; so is the flow that tips meet.
TEST(Interference, GivenFlowIsAClimb)
{
  const std::string given = subsection(
    "given",
    "    set Type = prescribed inflow\n    set Hub = ground\n    set Radius = 7\n    set Velocity = 3, 9, 9\n");
  for (const std::string tips : {"", "    set Tip loss = Prandtl\n"})
    {
      Scene felt(coaxial({{" a", "Pitt-Peters inflow", tips + feels("given", 2.)}}, "0, 0, 0", given)),
        climbing(coaxial({{" a", "Pitt-Peters inflow", tips}}, "0, 0, -6"));
      felt.equilibrium();
      climbing.equilibrium();
      for (const std::string probe : {"thrust", "torque", "mean", "profile power"})
        EXPECT_NEAR(felt.value("flow a." + probe), climbing.value("flow a." + probe), 1e-6) << probe;
      // what the neighbour adds is part of the induced power, and not of a climb's
      EXPECT_NEAR(felt.value("flow a.induced power"),
                  climbing.value("flow a.induced power") + 6 * climbing.value("flow a.thrust"),
                  1e-6 * felt.value("flow a.induced power"));
    }
}



TEST(Interference, DerivativesAgainstComplexSteps)
{
  const std::string given = subsection(
    "given",
    "    set Type = prescribed inflow\n    set Hub = ground\n    set Radius = 7\n    set Velocity = 3, 1, 2\n");
  const std::string others =
    "    set Interference = flow b, given\n    set Interference factors = 0.7, -0.3\n    set Tip loss = Prandtl\n";
  const Scene scene(
    coaxial({{" a", "Peters-He inflow\n    set Harmonics = 2\n    set Power = 4", others},
             {" b", "Pitt-Peters inflow", feels("flow a", 1.3) + "    set Ground effect = Cheeseman-Bennett\n", 9, -1}},
            "12, 3, -1\n    set Gust = sin(x + y), 0, 2*cos(x*z)",
            given));
  const ComplexStep step(scene.system, false, false, true);
  EXPECT_LT(step.error_of_tangent(), 1e-12);
  EXPECT_LT(step.error_of_damping(), 1e-12);
}



TEST(Interference, RefusesWhatItCannotBe)
{
  const auto complaint = [](const std::string &entries, const std::string &second) {
    return complaint_of(coaxial({{" a", "Pitt-Peters inflow", entries}, {" b", second, ""}}));
  };
  EXPECT_NE(complaint("    set Interference = flow b\n", "uniform inflow").find("names 1 inflows, and there are 0"),
            std::string::npos);
  EXPECT_NE(complaint(feels("flow a", 1.), "uniform inflow").find("names itself"), std::string::npos);
  EXPECT_NE(complaint("    set Interference = flow b, flow b\n    set Interference factors = 1, 1\n", "uniform inflow")
              .find("<flow b> twice"),
            std::string::npos);
  EXPECT_NE(complaint(feels("flow b", 1.), "annular inflow").find("no sum of shapes"), std::string::npos);
  EXPECT_NE(complaint(feels("flow c", 1.), "uniform inflow").find("flow c"), std::string::npos);
}



// ρ M A R ẇ + 2ρA w² = T while a rotor starts in air at rest: M as given, and with hardly any the flow of each moment
// is the root of its thrust (Glauert's, without a time constant).
TEST(MomentumInflow, ApparentMass)
{
  for (const std::string inflow : {"uniform inflow", "Pitt-Peters inflow"})
    for (const double M : {8 / (3 * M_PI), 128 / (75 * M_PI), 1e-4})
      {
        Scene scene(
          coaxial({{" a", inflow, "    set Initial = 4\n    set Apparent mass = " + number_to_text(M) + "\n"}},
                  "0, 0, -2"));
        State state = scene.system.reference();
        scene.system.add_initial_velocities(state);
        Projection(scene.system).velocities(state);
        const auto of = [&](const std::string &probe, const State &at) {
          return scene.input.model.probe("flow a." + probe).value(at);
        };
        const double w = state.states[0], T = of("thrust", state);
        EXPECT_NEAR(of("mean", state), w, 1e-10);
        state.held        = false;
        const double h    = 1e-6 * M;
        const Record next = run(scene.system, state, Tableau(2, 1.), h, 1);
        const double rate = (next.state.states[0] - w) / h;
        EXPECT_NEAR(rate, (T / (rho * disk_area) - 2 * (2 + w) * w) / (3 * M), 1e-3 * std::abs(rate)) << inflow << M;
        if (M > 0.01)
          continue;
        // some fifty time constants later
        const Record settled = run(scene.system, state, Tableau(2, 0.5), 2e-5, 30);
        const double flow    = of("mean", settled.state);
        EXPECT_NEAR(of("thrust", settled.state), 2 * rho * disk_area * (2 + flow) * flow, 1e-3 * T) << inflow;
        EXPECT_GT(std::abs(flow - 4), 0.1);
      }
}



// On the branch of momentum theory that hover belongs to, the flow through the disk is not less than √2 − 1 of that of
// hover as long as the rotor descends no faster than twice that: nothing has to keep V_T away from zero.
TEST(FiniteStateInflow, SteadyDescentNeedsNoBoundOfTheFlow)
{
  const auto   inflow = FiniteStateInflow::uniform();
  const double hover = 5, R = 3;
  for (const double descent : {0., 0.5, 1., 1.5, 2.})
    {
      const double          s = -descent * hover, nu = -s / 2 + std::sqrt(s * s / 4 + hover * hover);
      const Eigen::VectorXd z    = Eigen::VectorXd::Constant(1, nu);
      const auto            flow = inflow.flow<double>(z, {0., 0., s, 0.}, R, 1e-3);
      EXPECT_GE(flow.V_T, (std::sqrt(2.) - 1) * hover * (1 - 1e-12));
      // R M ż = T/(ρA) − 2 V_T ν with T/(2ρA) = ν_h²
      EXPECT_NEAR(flow.rate(0) + 2 * hover * hover / (R * inflow.apparent_mass[0]), 0., 1e-9);
    }
}



// A wake in the plane of the disk: X stays below one, L can be inverted, and derivatives are those of the rates.
TEST(FiniteStateInflow, WakeInThePlaneOfTheDisk)
{
  const double least = 0.034, R = 3;
  for (const auto &inflow : {FiniteStateInflow::pitt_peters(), FiniteStateInflow::peters_he(4, 8)})
    {
      Eigen::VectorXd z = Eigen::VectorXd::LinSpaced(inflow.size(), 1., 0.3);
      // λ = λ_f + ν = 0
      FiniteStateInflow::Flight<double> flight{50., 20., 0., 0.};
      for (unsigned int i = 0; i < 200; ++i)
        flight.lambda_f = -inflow.flow<double>(z, flight, R, least).nu;
      const auto flow = inflow.flow<double>(z, flight, R, least);
      EXPECT_LT(std::abs(flow.lambda), 1e-9);
      const double X = std::hypot(flow.X_x, flow.X_y);
      EXPECT_LT(X, 1 - 0.5 * least / std::hypot(50., 20.));
      EXPECT_GT(2 * std::atan(X) * 180 / M_PI, 89.9);
      const auto      d = inflow.derivatives(flow, z, flight, R, least);
      Eigen::VectorXd numeric(inflow.size());
      for (unsigned int j = 0; j < 3; ++j)
        {
          auto z_c = FiniteStateInflow::Vector<std::complex<double>>(z.cast<std::complex<double>>());
          z_c(j) += std::complex<double>(0, 1e-30);
          const FiniteStateInflow::Flight<std::complex<double>> complex{50., 20., flight.lambda_f, 0.};
          numeric = inflow.flow<std::complex<double>>(z_c, complex, R, least).rate.imag() / 1e-30;
          EXPECT_LT((numeric - d.by_z.col(j)).norm(), 1e-8 * numeric.norm());
        }
    }
}
