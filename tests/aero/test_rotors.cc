// Several rotors in one model, mirrored, turned as a whole, with shafts that tilt and radii that change.

#include <samara/aero/finite_state.h>
#include <samara/model/doubts.h>
#include <samara/model/drawing.h>
#include <samara/rotation/rotation.h>
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
  std::string
  text_of(const Vector3 &x)
  {
    return number_to_text(x(0)) + ", " + number_to_text(x(1)) + ", " + number_to_text(x(2));
  }

  /** Two rigid blades on a hub that turns with 30 rad/s on a nacelle. */
  struct Rotor
  {
    std::string name   = "";
    Vector3     centre = Vector3::Zero();
    int         sense  = 1;                   ///< −1: clockwise, all mirrored at the plane y = 0
    Matrix3     turn   = Matrix3::Identity(); ///< of the rotor as a whole
    std::string inflow = "Pitt-Peters inflow", radius = "3";
    std::string surface = "    set Unsteady = two lags\n";
    std::string twist   = "12 deg - 1.5 deg*s";
    std::string nacelle = "rigid"; ///< joint on the ground, and its entries
    bool        steady  = false;   ///< turns in a load, for statics, and not in a prescribed motion

    Vector3
    vector(const double x, const double y, const double z) const
    {
      return turn * Vector3(x, sense * y, z);
    }

    std::string
    bodies() const
    {
      const Vector3 spin = turn * Vector3(0, 0, 30. * sense);
      return subsection("nacelle" + name,
                        "    set Type = rigid body\n    set Mass = 20\n    set Inertia = 4, 4, 4\n    set Position = " +
                          text_of(centre) + "\n") +
             subsection("rotor" + name,
                        "    set Type = rigid body\n    set Mass = 5\n    set Inertia = 2, 2, 4\n    set Position = " +
                          text_of(centre) + "\n    set Angular velocity = " + text_of(spin) + "\n");
    }

    std::string
    joints() const
    {
      return subsection("mast" + name,
                        "    set Type = " + nacelle + "\n    set Body A = ground\n    set Body B = nacelle" + name +
                          ".centre\n") +
             subsection("shaft" + name,
                        "    set Type = revolute\n    set Body A = nacelle" + name + "\n    set Body B = rotor" + name +
                          ".centre\n    set Axis = " + text_of(turn * Vector3(0, 0, sense)) + "\n" +
                          (steady ? "" : "    subsection rotation\n      set Prescribed = 30*t\n    end\n"));
    }

    std::string
    loads() const
    {
      return steady ?
               subsection("turning" + name,
                          "    set Type = steady rotation\n    set Joint = shaft" + name + "\n    set Speed = 30\n") :
               "";
    }

    std::string
    aerodynamics() const
    {
      return subsection("flow" + name,
                        "    set Type = " + inflow + "\n    set Hub = " + (steady ? "rotor" : "nacelle") + name +
                          ".centre\n    set Axis = " + text_of(vector(0, 0, 1)) +
                          "\n    set Direction = " + text_of(vector(1, 0, 0)) + "\n    set Radius = " + radius + "\n");
    }

    std::string
    surfaces() const
    {
      std::string result;
      for (const int k : {0, 1})
        {
          const double s = k == 0 ? 1 : -1;
          result += subsection("blade " + std::to_string(k + 1) + name,
                               "    set Body = rotor" + name +
                                 "\n    set Line = " + text_of(centre + vector(0.6 * s, 0, 0.05)) + "; " +
                                 text_of(centre + vector(3 * s, 0, 0.15)) + "\n    set Leading edge = " +
                                 text_of(vector(0, s, 0)) + "\n    set Upper side = " + text_of(vector(0, 0, 1)) +
                                 "\n    set Chord = 0.2\n    set Twist = " + twist +
                                 "\n    set Airfoils = full\n"
                                 "    set Quarter chord = 0.03\n    set Inflow = flow" +
                                 name + "\n" + surface);
        }
      return result;
    }
  };

  std::string
  model_of(const std::vector<Rotor> &rotors, const std::string &wind, const std::string &of_air = "")
  {
    std::string bodies, joints, loads, aerodynamics = air(wind, of_air), surfaces;
    for (const auto &rotor : rotors)
      {
        bodies += rotor.bodies();
        joints += rotor.joints();
        loads += rotor.loads();
        aerodynamics += rotor.aerodynamics();
        surfaces += rotor.surfaces();
      }
    return subsection("Bodies", bodies) + subsection("Joints", joints) + subsection("Loads", loads) + airfoils() +
           subsection("Aerodynamics", aerodynamics) + subsection("Surfaces", surfaces);
  }

  /** The state of a motion from the reference configuration, after @p n steps of @p h. */
  void
  fly(Scene &scene, const double h, const unsigned int n)
  {
    State state = scene.system.reference();
    scene.system.add_initial_velocities(state);
    Projection(scene.system).velocities(state);
    state.held          = false;
    const Record record = run(scene.system, state, Tableau(3, 1.), h, n);
    EXPECT_EQ(record.n_steps, n);
    scene.context.state = record.state;
    Projection(scene.system).velocities(scene.context.state);
  }

  std::vector<double>
  values(const Scene &scene, const std::string &name)
  {
    std::vector<double> result;
    for (const std::string probe : {"thrust", "torque", "power", "mean", "force 1", "force 2", "moment 1", "moment 2"})
      result.push_back(scene.value("flow" + name + "." + probe));
    return result;
  }

  const std::vector<std::string> inflows = {"Pitt-Peters inflow",
                                            "Peters-He inflow\n    set Harmonics = 2\n    set Power = 4",
                                            "annular inflow\n    set Initial = 5"};
} // namespace



// Rotors know nothing of each other: each does what it does alone, beside another one of another theory.
TEST(SeveralRotors, EachAsIfAlone)
{
  const std::string wind = "14, 2, -1", shear = "    set Shear exponent = 0.2\n    set Ground = -20\n";
  Rotor             left, right;
  left.name    = " a";
  left.centre  = Vector3(0, 40, 3);
  left.inflow  = inflows[1];
  right.name   = " b";
  right.sense  = -1;
  right.centre = Vector3(5, -40, 0);
  Scene both(model_of({left, right}, wind, shear)), one(model_of({left}, wind, shear)),
    other(model_of({right}, wind, shear));
  for (Scene *const scene : {&both, &one, &other})
    fly(*scene, 0.004, 12);
  for (const auto &[scene, name] : {std::make_pair(&one, " a"), std::make_pair(&other, " b")})
    {
      const auto alone = values(*scene, name), beside = values(both, name);
      EXPECT_GT(std::abs(alone[0]), 100.);
      for (unsigned int i = 0; i < alone.size(); ++i)
        EXPECT_NEAR(alone[i], beside[i], 1e-9 * std::abs(alone[0])) << name << " " << i;
    }
}



// A clockwise rotor is the mirror image of an anticlockwise one; hover of both in one model is a static solution.
TEST(SeveralRotors, Mirrored)
{
  for (const auto &inflow : inflows)
    {
      Rotor left, right;
      left.name   = " a";
      left.centre = Vector3(0, 9, 0);
      left.inflow = right.inflow = inflow;
      left.surface = right.surface = "    set Unsteady = dynamic stall\n";
      right.name                   = " b";
      right.sense                  = -1;
      right.centre                 = Vector3(0, -9, 0);
      Scene flight(model_of({left, right}, "14, 0, -1"));
      fly(flight, 0.004, 12);
      const auto   a = values(flight, " a"), b = values(flight, " b");
      const double signs[] = {1, -1, 1, 1, 1, -1, -1, 1}; // of torque, side force, roll moment
      for (unsigned int i = 0; i < a.size(); ++i)
        // the hub's axis 2 of <Direction> and <Axis> is the same for both
        EXPECT_NEAR(a[i], signs[i] * b[i], 1e-9 * std::abs(a[0])) << inflow << i;
      left.steady = right.steady = true;
      Scene hover(model_of({left, right}, "0, 0, 0"));
      hover.equilibrium();
      EXPECT_GT(hover.value("flow a.thrust"), 100.);
      EXPECT_NEAR(hover.value("flow a.thrust"), hover.value("flow b.thrust"), 1e-7 * hover.value("flow a.thrust"));
      EXPECT_NEAR(hover.value("flow a.torque"), -hover.value("flow b.torque"), 1e-7 * hover.value("flow a.thrust"));
    }
}



// Rotor, wind and all turned together about any axis: the same loads in the hub's axes.
TEST(SeveralRotors, TurnedAsAWhole)
{
  const Matrix3 Q = rotation_of_vector(Vector3(0.9, -1.3, 0.7));
  const Vector3 w(14, 3, -2);
  for (const auto &inflow : inflows)
    for (const std::string unsteady : {"quasi-steady", "two lags\n    set Virtual mass = true", "dynamic stall"})
      {
        Rotor straight;
        straight.inflow  = inflow;
        straight.surface = "    set Unsteady = " + unsteady + "\n";
        Rotor turned     = straight;
        turned.turn      = Q;
        turned.centre    = Vector3(7, -3, 4);
        Scene one(model_of({straight}, text_of(w))), other(model_of({turned}, text_of(Q * w)));
        fly(one, 0.004, 10);
        fly(other, 0.004, 10);
        const auto a = values(one, ""), b = values(other, "");
        for (unsigned int i = 0; i < a.size(); ++i)
          EXPECT_NEAR(a[i], b[i], 1e-8 * std::abs(a[0])) << inflow << unsteady << i;
      }
}



namespace
{
  /** A rotor in a wind from ahead whose nacelle goes from hover to a propeller within 0.3 s. */
  Rotor
  tiltrotor(const std::string &inflow)
  {
    Rotor rotor;
    rotor.inflow  = inflow;
    rotor.nacelle = "revolute\n    set Axis = 0, 1, 0\n    subsection rotation\n      set Prescribed = "
                    "-90 deg*(t < 0.3 ? (t/0.3)^3*(10 - 15*(t/0.3) + 6*(t/0.3)^2) : 1)\n    end\n";
    rotor.twist   = "55 deg - 12 deg*s";
    return rotor;
  }
} // namespace



// A nacelle that tilts: the inflow goes with it, whether its axes turn with the rotor or not, and ends as that of a
// propeller that has been one from the start.
TEST(TiltingShaft, FromHoverToPropeller)
{
  for (const auto &inflow : inflows)
    {
      Scene       fixed(model_of({tiltrotor(inflow)}, "40, 0, 0"));
      std::string text = model_of({tiltrotor(inflow)}, "40, 0, 0");
      text.replace(text.find("Hub = nacelle"), 13, "Hub = rotor");
      Scene turning(text);
      fly(fixed, 0.005, 40);
      fly(turning, 0.005, 40);
      const double T = fixed.value("flow.thrust");
      EXPECT_GT(std::abs(T), 100.);
      for (const std::string probe : {"flow.thrust", "flow.torque", "blade 1.force x", "blade 2.force z", "flow.mean"})
        EXPECT_NEAR(fixed.value(probe), turning.value(probe), 1e-5 * std::abs(T)) << inflow << probe;

      fly(fixed, 0.005, 200);
      Rotor propeller   = tiltrotor(inflow);
      propeller.nacelle = "rigid";
      propeller.turn    = rotation_of_vector(Vector3(0, -M_PI / 2, 0));
      propeller.steady  = true;
      Scene ahead(model_of({propeller}, "40, 0, 0"));
      ahead.equilibrium();
      for (const std::string probe : {"thrust", "torque", "power", "mean"})
        EXPECT_NEAR(fixed.value("flow." + probe),
                    ahead.value("flow." + probe),
                    1e-5 * std::abs(ahead.value("flow." + probe)))
          << inflow << probe;
    }
}



// Steady at the time when they are propellers: an iterate without a mean inflow shortens the step and ends nothing.
TEST(TiltingShaft, EquilibriumOfPropellers)
{
  Scene scene("prm/examples/aero/tilting_rotors.prm", {"Static/Time = 4 s"});
  scene.equilibrium();
  EXPECT_NE(scene.stream.str().find("there is no mean inflow"), std::string::npos);
  const double thrust = scene.value("flow left.thrust");
  EXPECT_GT(std::abs(thrust), 1.);
  EXPECT_NEAR(scene.value("flow right.thrust"), thrust, 1e-7 * std::abs(thrust)); // its mirror image
}



// Maps of what is at a station over radius and azimuth: the azimuth's zero tilts with the thrust axis.
TEST(TiltingShaft, AzimuthsOfMaps)
{
  for (const double angle : {-30., -90., -120.})
    {
      Rotor rotor = tiltrotor(inflows[0]);
      rotor.nacelle =
        "revolute\n    set Axis = 0, 1, 0\n    subsection rotation\n      set Prescribed = " + number_to_text(angle) +
        " deg*t/(0.04 s)\n    end\n";
      Scene scene(model_of({rotor}, "40, 0, 0"));
      fly(scene, 0.004, 10);
      Drawing drawing(&scene.input.model);
      for (const auto &item : scene.input.model.items)
        if (item->name == "blade 1")
          item->draw(scene.context.state, drawing);
      bool is_found = false;
      for (const auto &field : drawing.fields)
        if (field.name == "azimuth")
          {
            is_found = true;
            for (unsigned int i = 0; i < field.end(); ++i)
              EXPECT_NEAR(field(i), 30 * 0.04 * 180 / M_PI, 3.); // the quarter chord lies ahead
          }
      EXPECT_TRUE(is_found);
    }
}



// C: a flow whose states obey ż = (Ṙ/R) C z stays as it is at every place while the disk grows.
TEST(ChangingRadius, FlowAtAPlaceStays)
{
  const double growth = 0.7;
  for (const auto &inflow :
       {FiniteStateInflow::uniform(), FiniteStateInflow::pitt_peters(), FiniteStateInflow::peters_he(3, 7)})
    {
      const unsigned int n = inflow.size();
      Eigen::VectorXd    z(n), by_x(n), by_y(n), phi(n);
      for (unsigned int k = 0; k < n; ++k)
        z(k) = std::sin(1. + 2.3 * k);
      FiniteStateInflow::Flight<double> still{1., 2., 3., 0.}, growing = still;
      growing.growth = growth;
      const Eigen::VectorXd rate =
        inflow.flow<double>(z, growing, 2., 1e-3).rate - inflow.flow<double>(z, still, 2., 1e-3).rate;
      for (const auto &[x, y] : {std::make_pair(0.3, 0.5), std::make_pair(-0.8, 0.1), std::make_pair(0.02, -0.6)})
        {
          inflow.disk.evaluate(x, y, phi.data());
          inflow.disk.gradients(x, y, by_x.data(), by_y.data());
          // d/dt of Σ z φ(x/R) at a place
          EXPECT_NEAR(rate.dot(phi), growth * z.dot(x * by_x + y * by_y), 1e-11);
        }
    }
}



// The momentum of the air in a disk that grows: T = ρ (8/3) R³ ẇ + 2ρπR² V w, step by step against Runge and Kutta's
// method.
TEST(ChangingRadius, MomentumBalance)
{
  const auto radius = [](const double t) { return 3 + 0.5 * (1 - std::cos(20 * t)); };
  Rotor      rotor;
  rotor.inflow       = "uniform inflow\n    set Initial = 4";
  rotor.radius       = "3 + 0.5*(1 - cos(20*t))";
  rotor.surface      = "    set Unsteady = quasi-steady\n";
  const double climb = 2, rho = 1.225;
  Scene        scene(model_of({rotor}, "0, 0, -2"));
  fly(scene, 0.0025, 60);
  const double end = scene.context.state.time;
  EXPECT_NEAR(end, 0.15, 1e-12);
  // thrust with the inflow w, whatever the azimuth
  State      at     = scene.context.state;
  const auto thrust = [&](const double w) {
    at.states[0] = w;
    return scene.input.model.probe("flow.thrust").value(at);
  };
  const auto rate = [&](const double t, const double w) {
    const double R = radius(t);
    return (thrust(w) - 2 * rho * M_PI * R * R * (climb + w) * w) / (8. / 3 * rho * R * R * R);
  };
  double             w = 4;
  const unsigned int n = 300;
  const double       h = end / n;
  for (unsigned int i = 0; i < n; ++i)
    {
      const double t = i * h, k1 = rate(t, w), k2 = rate(t + h / 2, w + h / 2 * k1),
                   k3 = rate(t + h / 2, w + h / 2 * k2), k4 = rate(t + h, w + h * k3);
      w += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
  EXPECT_NEAR(scene.value("flow.state 1"), w, 1e-5 * w);
  EXPECT_GT(std::abs(w - 4), 0.3);
}



// Statics see the radius of their time; the mean flow is that of momentum theory in it.
TEST(ChangingRadius, EquilibriumAtATime)
{
  for (const auto &inflow : {inflows[0], inflows[1]})
    {
      Rotor rotor;
      rotor.inflow = inflow;
      rotor.radius = "table: 0 3; 1 3.6";
      rotor.steady = true;
      Scene scene("set Analyses = static\nsubsection Static\n  set Time = 0.5\nend\n" + model_of({rotor}, "0, 0, 0"));
      scene.equilibrium();
      rotor.radius = "3.3";
      Scene same(model_of({rotor}, "0, 0, 0"));
      same.equilibrium();
      const double T = scene.value("flow.thrust"), A = M_PI * 3.3 * 3.3;
      EXPECT_NEAR(T, same.value("flow.thrust"), 1e-9 * T);
      EXPECT_NEAR(scene.value("flow.mean"), std::sqrt(T / (2 * 1.225 * A)), 1e-7);
    }
}



TEST(ChangingRadius, Derivatives)
{
  for (const std::string inflow : {"uniform inflow\n    set Tip loss = Prandtl",
                                   "Peters-He inflow\n    set Harmonics = 2\n    set Power = 4\n"
                                   "    set Ground effect = Cheeseman-Bennett",
                                   "annular inflow"})
    {
      Rotor rotor;
      rotor.inflow = inflow;
      rotor.radius = "3 + 0.5*(1 - cos(20*(t + 1)))";
      rotor.steady = true;
      const Scene       scene(model_of({rotor}, "10, 2, -1", "    set Ground = -6\n"));
      const ComplexStep step(scene.system, false, false, true);
      EXPECT_LT(step.error_of_tangent(), 1e-12) << inflow;
      EXPECT_LT(step.error_of_damping(), 1e-12) << inflow;
    }
}



TEST(ChangingRadius, RefusesWhatItCannotBe)
{
  Rotor rotor;
  rotor.radius = "0";
  EXPECT_NE(complaint_of(model_of({rotor}, "0, 0, 0")).find("must be positive, and is 0 m"), std::string::npos);
  rotor.radius = "3*t";
  EXPECT_NE(complaint_of(model_of({rotor}, "0, 0, 0")).find("is 0 m at t = 0"), std::string::npos);
  rotor.inflow = "helical wake\n    set Speed = 30";
  rotor.radius = "3 + t";
  EXPECT_NE(complaint_of(model_of({rotor}, "0, 0, 0")).find("whose radius stays"), std::string::npos);
  rotor.inflow = "annular inflow\n    set Ground effect = Cheeseman-Bennett";
  EXPECT_NE(complaint_of(model_of({rotor}, "0, 0, 0")).find("annuli know nothing of each other"), std::string::npos);
  // blades that stay where the disk shrinks are doubted, and a radius that vanishes is told
  rotor.inflow = inflows[1];
  rotor.radius = "3 - 20*t";
  Scene scene(model_of({rotor}, "0, 0, 0"));
  fly(scene, 0.001, 10);
  std::string doubts;
  for (const auto &item : scene.input.model.items)
    if (const auto *const doubtful = dynamic_cast<const Doubtful *>(item.get()))
      for (const auto &doubt : doubtful->doubts(scene.context.state))
        doubts += doubt.text;
  EXPECT_NE(doubts.find("blades reach beyond the disk of <flow>"), std::string::npos) << doubts;
  rotor.steady = true;
  Scene late("set Analyses = static\nsubsection Static\n  set Time = 0.2\nend\n" + model_of({rotor}, "0, 0, 0"));
  EXPECT_THROW(late.equilibrium(), InputError);
}



// The disk of an inflow is drawn where it is, as large as it is, with the flow that blades meet there.
TEST(PictureOfInflow, DiskThatTiltsAndGrows)
{
  Rotor rotor  = tiltrotor(inflows[1]);
  rotor.radius = "3 + 10*t";
  rotor.nacelle =
    "revolute\n    set Axis = 0, 1, 0\n    subsection rotation\n      set Prescribed = -90 deg*t/(0.04 s)\n    end\n";
  Scene scene(model_of({rotor}, "40, 0, 0"));
  fly(scene, 0.004, 10);
  Drawing drawing(&scene.input.model);
  for (const auto &item : scene.input.model.items)
    if (item->name == "flow")
      item->draw(scene.context.state, drawing);
  ASSERT_EQ(drawing.fields.size(), 1u);
  double             largest = 0, sum = 0;
  const unsigned int n = drawing.samples.size();
  ASSERT_GT(n, 100u);
  for (unsigned int i = 0; i < n; ++i)
    {
      EXPECT_LT(std::abs(drawing.samples[i].x(0)), 1e-9); // the thrust axis is x
      largest = std::max(largest, drawing.samples[i].x.norm());
      sum += std::abs(drawing.fields[0](i));
    }
  EXPECT_NEAR(largest, 3.4, 1e-9);
  EXPECT_GT(sum / n, 0.1);
  // where the first blade's station is, by the station nearest to 1 m along it
  const double  at_blade = scene.value("blade 1.at 1.inflow");
  double        nearest = 1e300, flow = 0;
  const double  azimuth = 30 * 0.04;
  const Vector3 station = 1.6 * Vector3(0, std::sin(azimuth), std::cos(azimuth));
  for (unsigned int i = 0; i < n; ++i)
    if (const double d = (drawing.samples[i].x - station).norm(); d < nearest)
      {
        nearest = d;
        flow    = drawing.fields[0](i);
      }
  EXPECT_LT(nearest, 0.3);
  EXPECT_NEAR(flow, at_blade, 0.3 * std::abs(at_blade) + 0.2);
}



// Faster than the airfoil knows.
TEST(Doubts, OfMachNumbers)
{
  for (const bool is_slow : {true, false})
    {
      Rotor rotor;
      rotor.steady = true;
      // stations are at up to 3 m, at 30 rad/s
      Scene       scene(model_of({rotor}, "0, 0, 0", is_slow ? "" : "    set Speed of sound = 85\n"));
      std::string doubts;
      scene.equilibrium();
      for (const auto &item : scene.input.model.items)
        if (const auto *const doubtful = dynamic_cast<const Doubtful *>(item.get()))
          for (const auto &doubt : doubtful->doubts(scene.context.state))
            doubts += doubt.text;
      EXPECT_EQ(doubts.find("and <full> is that of Mach 0.9 beyond it") == std::string::npos, is_slow) << doubts;
    }
}



// The rotor of the NREL 5 MW turbine, blades without torsion, against OpenFAST with its own speeds, pitch and mean wind
// across the disk: github.com/ebranlard/welib, commit 1690c3c, data/NREL5MW/NREL5MW_Oper.csv
// (doc/applications/nrel_5mw.md).
TEST(AnnularInflow, WindTurbineAgainstAnotherCode)
{
  struct Row
  {
    double wind, speed, pitch, thrust, torque; ///< m/s, 1/min, deg, kN, kN m
  };
  const std::string data = std::string(SAMARA_SOURCE_DIR) + "/prm/rotorcraft/nrel_5mw/";
  for (const Row &row : {Row{7.9242, 9.1311, 0, 379.51, 1946.9},
                         Row{11.885, 12.1003, 3.4514, 596.23, 4180.84},
                         Row{24.7641, 12.1001, 22.96, 273.49, 4176.03}})
    {
      const auto set = [](const std::string &name, const double value, const std::string &unit) {
        return "Constants/" + name + " = " + number_to_text(value) + unit;
      };
      Scene scene("prm/rotorcraft/nrel_5mw.prm",
                  {set("wind", row.wind, " m/s"),
                   set("Omega", row.speed, "*2*pi/60"),
                   set("pitch", row.pitch, " deg"),
                   "Sections/blade of the report/File = " + data + "blade.csv, " + data + "torsion_stiff.csv"});
      scene.equilibrium();
      EXPECT_NEAR(scene.value("flow.thrust") / 1e3, row.thrust, 0.0305 * row.thrust) << row.wind;
      EXPECT_NEAR(-scene.value("flow.torque") / 1e3, row.torque, 0.03 * row.torque) << row.wind;
    }
}
